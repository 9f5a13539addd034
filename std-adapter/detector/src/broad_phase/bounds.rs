//! The bounds of moving boxes, which a refit merges four at a time.

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
pub(super) use plain::Bounds;
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
pub(super) use simd128::Bounds;

#[cfg(not(all(target_arch = "wasm32", target_feature = "simd128")))]
mod plain {
    use selvedge_core::boxes::Aabb;
    use selvedge_core::boxes::moving::MovingBox;

    /// The bounds of a moving box, upper ones negated. So merging takes the smaller of each two, four at a time.
    #[derive(Clone, Copy)]
    pub(in super::super) struct Bounds([f32; 12]);

    impl Bounds {
        #[inline(always)]
        pub(in super::super) const fn new(moving: &MovingBox<f32>) -> Self {
            let ([a, b, c], [d, e, f]) = (moving.start.lower, moving.start.upper);
            let ([g, h, i], [j, k, l]) = (moving.end.lower, moving.end.upper);
            Self([a, b, c, -d, -e, -f, g, h, i, -j, -k, -l])
        }

        #[inline(always)]
        pub(in super::super) const fn moving_box(&self) -> MovingBox<f32> {
            let [a, b, c, d, e, f, g, h, i, j, k, l] = self.0;
            MovingBox {
                start: Aabb {
                    lower: [a, b, c],
                    upper: [-d, -e, -f],
                },
                end: Aabb {
                    lower: [g, h, i],
                    upper: [-j, -k, -l],
                },
            }
        }

        /// Grows to the bounds of both. There is no NaN in a box.
        #[inline(always)]
        pub(in super::super) fn merge(&mut self, other: &Self) {
            for (own, &other) in self.0.iter_mut().zip(&other.0) {
                *own = if other < *own { other } else { *own };
            }
        }
    }
}

/// The same in WebAssembly's vectors. The compiler makes twelve comparisons of the plain loop there, which engines turn into as
/// many branches.
#[cfg(all(target_arch = "wasm32", target_feature = "simd128"))]
mod simd128 {
    use core::arch::wasm32::{f32x4, f32x4_extract_lane, f32x4_pmax, f32x4_pmin, i32x4_shuffle, v128};
    use selvedge_core::boxes::Aabb;
    use selvedge_core::boxes::moving::MovingBox;

    /// The bounds of a moving box, in the order of its fields.
    #[derive(Clone, Copy)]
    pub(in super::super) struct Bounds([v128; 3]);

    impl Bounds {
        #[inline(always)]
        pub(in super::super) fn new(moving: &MovingBox<f32>) -> Self {
            let ([a, b, c], [d, e, f]) = (moving.start.lower, moving.start.upper);
            let ([g, h, i], [j, k, l]) = (moving.end.lower, moving.end.upper);
            Self([f32x4(a, b, c, d), f32x4(e, f, g, h), f32x4(i, j, k, l)])
        }

        #[inline(always)]
        pub(in super::super) fn moving_box(&self) -> MovingBox<f32> {
            let [[a, b, c, d], [e, f, g, h], [i, j, k, l]] = self.0.map(|row| {
                [
                    f32x4_extract_lane::<0>(row),
                    f32x4_extract_lane::<1>(row),
                    f32x4_extract_lane::<2>(row),
                    f32x4_extract_lane::<3>(row),
                ]
            });
            MovingBox {
                start: Aabb {
                    lower: [a, b, c],
                    upper: [d, e, f],
                },
                end: Aabb {
                    lower: [g, h, i],
                    upper: [j, k, l],
                },
            }
        }

        /// Grows to the bounds of both. There is no NaN in a box.
        #[inline(always)]
        pub(in super::super) fn merge(&mut self, other: &Self) {
            let [first, second, third] = self.0;
            let lower = |own, other| f32x4_pmin(own, other);
            let upper = |own, other| f32x4_pmax(own, other);
            let [a, b, c] = other.0;
            self.0 = [
                i32x4_shuffle::<0, 1, 2, 7>(lower(first, a), upper(first, a)),
                i32x4_shuffle::<4, 5, 2, 3>(lower(second, b), upper(second, b)),
                i32x4_shuffle::<0, 5, 6, 7>(lower(third, c), upper(third, c)),
            ];
        }
    }
}
