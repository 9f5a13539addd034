//! `f32` and `f64` vectors as [`Lanes`], and how rows become lanes.

use super::{LANES, Mask, Test, VertexRow};
use crate::lanes::Lanes;
use crate::points::{PairPoints, PairShape};
use crate::vector::Vector;
use fearless_simd::{ExtractToken, Simd, SimdBase, SimdCombine, SimdMask, f32x8, f32x16, f64x8};

/// What [`Scalar`](crate::Scalar) needs to go sixteen at a time.
pub trait BatchScalar: Copy {
    /// Runs `test` on sixteen pairs.
    #[doc(hidden)]
    fn sixteen<V: Simd, P: PairShape>(
        simd: V,
        test: Test,
        pairs: &[[&VertexRow<Self>; 4]; LANES],
    ) -> Mask;
}

macro_rules! lanes {
    ($vector:ident, $scalar:ty) => {
        impl<V: Simd> Lanes for $vector<V> {
            type Scalar = $scalar;
            type Mask = <Self as SimdBase<V>>::Mask;

            #[inline(always)]
            fn splat(self, value: $scalar) -> Self {
                <Self as SimdBase<V>>::splat(self.token(), value)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                <Self as SimdBase<V>>::abs(self)
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                <Self as SimdBase<V>>::max(self, other)
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                <Self as SimdBase<V>>::min(self, other)
            }

            #[inline(always)]
            fn greater(self, other: Self) -> Self::Mask {
                self.simd_gt(other)
            }
        }
    };
}

/// The rows of one point of eight pairs.
macro_rules! load_rows {
    ($vector:ident, $simd:expr, $pairs:expr, $first:expr, $point:expr) => {{
        let pairs: &[[&VertexRow<_>; 4]; LANES] = $pairs;
        [
            $vector::load_array_ref($simd, &pairs[$first][$point].0),
            $vector::load_array_ref($simd, &pairs[$first + 1][$point].0),
            $vector::load_array_ref($simd, &pairs[$first + 2][$point].0),
            $vector::load_array_ref($simd, &pairs[$first + 3][$point].0),
            $vector::load_array_ref($simd, &pairs[$first + 4][$point].0),
            $vector::load_array_ref($simd, &pairs[$first + 5][$point].0),
            $vector::load_array_ref($simd, &pairs[$first + 6][$point].0),
            $vector::load_array_ref($simd, &pairs[$first + 7][$point].0),
        ]
    }};
}

lanes!(f32x16, f32);
lanes!(f64x8, f64);

impl BatchScalar for f32 {
    #[inline(always)]
    fn sixteen<V: Simd, P: PairShape>(
        simd: V,
        test: Test,
        pairs: &[[&VertexRow<f32>; 4]; LANES],
    ) -> Mask {
        macro_rules! columns {
            ($point:expr) => {{
                let low = transposed(load_rows!(f32x8, simd, pairs, 0, $point));
                let high = transposed(load_rows!(f32x8, simd, pairs, 8, $point));
                let [a, b, c, d, e, f, g, h] = low;
                let [i, j, k, l, m, n, o, p] = high;
                [
                    a.combine(i),
                    b.combine(j),
                    c.combine(k),
                    d.combine(l),
                    e.combine(m),
                    f.combine(n),
                    g.combine(o),
                    h.combine(p),
                ]
            }};
        }
        let columns = [columns!(0), columns!(1), columns!(2), columns!(3)];
        test.on::<P, f32x16<V>>(&points(columns)).to_bitmask() as Mask
    }
}

impl BatchScalar for f64 {
    #[inline(always)]
    fn sixteen<V: Simd, P: PairShape>(
        simd: V,
        test: Test,
        pairs: &[[&VertexRow<f64>; 4]; LANES],
    ) -> Mask {
        macro_rules! eight {
            ($first:expr) => {{
                let columns = [
                    transposed(load_rows!(f64x8, simd, pairs, $first, 0)),
                    transposed(load_rows!(f64x8, simd, pairs, $first, 1)),
                    transposed(load_rows!(f64x8, simd, pairs, $first, 2)),
                    transposed(load_rows!(f64x8, simd, pairs, $first, 3)),
                ];
                test.on::<P, f64x8<V>>(&points(columns)).to_bitmask() as Mask
            }};
        }
        eight!(0) | eight!(8) << 8
    }
}

/// The four points from the transposed rows of each.
#[inline(always)]
fn points<L: Lanes>(columns: [[L; 8]; 4]) -> PairPoints<L> {
    let [
        [ax, ay, az, _, au, av, aw, _],
        [bx, by, bz, _, bu, bv, bw, _],
        c,
        d,
    ] = columns;
    let ([cx, cy, cz, _, cu, cv, cw, _], [dx, dy, dz, _, du, dv, dw, _]) = (c, d);
    PairPoints {
        start: [
            Vector::new(ax, ay, az),
            Vector::new(bx, by, bz),
            Vector::new(cx, cy, cz),
            Vector::new(dx, dy, dz),
        ],
        end: [
            Vector::new(au, av, aw),
            Vector::new(bu, bv, bw),
            Vector::new(cu, cv, cw),
            Vector::new(du, dv, dw),
        ],
    }
}

/// Transposes eight rows of eight by three rounds of interleaving row k with row k + 4:
///
/// ```text
/// rows        a0 a1 … a7, b0 b1 … b7, …, h0 h1 … h7
/// 1 round     a0 e0 a1 e1 …               (rows a, e)
/// 2 rounds    a0 c0 e0 g0 a1 c1 e1 g1     (rows a, c, e, g)
/// 3 rounds    a0 b0 c0 d0 e0 f0 g0 h0     column 0
/// ```
#[inline(always)]
fn transposed<V: Simd, T: SimdBase<V>>(mut rows: [T; 8]) -> [T; 8] {
    for _ in 0..3 {
        let [a, b, c, d, e, f, g, h] = rows;
        let (row_0, row_1) = a.interleave(e);
        let (row_2, row_3) = b.interleave(f);
        let (row_4, row_5) = c.interleave(g);
        let (row_6, row_7) = d.interleave(h);
        rows = [row_0, row_1, row_2, row_3, row_4, row_5, row_6, row_7];
    }
    rows
}
