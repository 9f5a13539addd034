//! `f32` and `f64` vectors as [`Lanes`], and how rows and tiles become lanes.

use super::advance::{LaneRound, Round, RoundQuestion, round};
use super::{Kernel, LANES, Level, Mask, Tile, VertexRow};
use crate::PairKind;
use crate::coplanarity::MovingTetrahedron;
use crate::filter::certified::{Decision, decide};
use crate::lanes::Lanes;
use crate::points::{EdgeAndEdge, PairPoints, PairShape, VertexAndFace};
use crate::vector::Vector;
use fearless_simd::{ExtractToken, Select, Simd, SimdBase, SimdCombine, SimdFloat, SimdMask, SimdSplit, f32x8, f32x16, f64x8};

/// What [`Scalar`](crate::Scalar) needs to go sixteen at a time.
///
/// The method is not generic, so that its many kernels (for each instruction set, test and kind) are compiled once, in
/// this crate, and not in every crate that calls it.
pub trait BatchScalar: Copy {
    /// What `kernel` says of sixteen pairs. `None` if an index is not in the rows.
    #[doc(hidden)]
    fn sixteen(level: Level, kind: PairKind, kernel: Kernel<Self>, pairs: Sixteen<'_, Self>) -> Option<Decision<Mask>>;

    /// One round of advancing for sixteen pairs, from their times on. `None` if an index is not in the rows.
    #[doc(hidden)]
    fn round(
        level: Level,
        kind: PairKind,
        question: &RoundQuestion<Self>,
        rows: &[VertexRow<Self>],
        indices: &[[u32; 4]; LANES],
        times: &mut [Self; LANES],
    ) -> Option<Round>;
}

/// What advancing needs beyond [`Lanes`].
pub(super) trait Quotients: Lanes {
    /// `self / divisor`, lane by lane.
    fn over(self, divisor: Self) -> Self;
    /// One or the other, lane by lane.
    fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self;
    /// The lanes that are false.
    fn not(mask: Self::Mask) -> Self::Mask;
}

/// Sixteen pairs' four points.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Sixteen<'a, S> {
    /// Indices of rows.
    Mesh {
        rows: &'a [VertexRow<S>],
        indices: &'a [[u32; 4]; LANES],
    },
    Tile(&'a Tile<S>),
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
            fn any(mask: Self::Mask) -> bool {
                mask.any_true()
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
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

lanes!(f32x16, f32);
lanes!(f64x8, f64);

macro_rules! quotients {
    ($vector:ident) => {
        impl<V: Simd> Quotients for $vector<V> {
            #[inline(always)]
            fn over(self, divisor: Self) -> Self {
                self / divisor
            }

            #[inline(always)]
            fn select(mask: Self::Mask, if_true: Self, if_false: Self) -> Self {
                mask.select(if_true, if_false)
            }

            #[inline(always)]
            fn not(mask: Self::Mask) -> Self::Mask {
                !mask
            }
        }
    };
}

quotients!(f32x16);
quotients!(f64x8);

/// Start and end of one point, or of one edge, of sixteen `f32` pairs, or of eight `f64` pairs from `$first` on. `$row` is
/// such a row of the pair whose indices are `$pair`.
///
/// `f32`: a vector holds the rows of pairs k and k + 8, and after transposition two columns of eight pairs.
macro_rules! columns {
    (f32, $indices:expr, $first:expr, |$pair:ident| $row:expr) => {{
        macro_rules! rows {
            ($index:expr) => {{
                let low = {
                    let $pair = &$indices[$first + $index];
                    $row
                };
                let $pair = &$indices[$first + $index + 8];
                low.combine($row)
            }};
        }
        let [xy, z, uv, w, xy_8, z_8, uv_8, w_8] =
            transposed([rows!(0), rows!(1), rows!(2), rows!(3), rows!(4), rows!(5), rows!(6), rows!(7)]);
        let ((x, y), (x_8, y_8)) = (xy.split(), xy_8.split());
        let ((u, v), (u_8, v_8)) = (uv.split(), uv_8.split());
        let (z, w) = (z.split().0, w.split().0);
        let (z_8, w_8) = (z_8.split().0, w_8.split().0);
        [
            Vector::new(x.combine(x_8), y.combine(y_8), z.combine(z_8)),
            Vector::new(u.combine(u_8), v.combine(v_8), w.combine(w_8)),
        ]
    }};
    (f64, $indices:expr, $first:expr, |$pair:ident| $row:expr) => {{
        macro_rules! row {
            ($index:expr) => {{
                let $pair = &$indices[$first + $index];
                $row
            }};
        }
        // The fourth column and the last are padding.
        let [x, y, z, _, u, v, w, _] = transposed([row!(0), row!(1), row!(2), row!(3), row!(4), row!(5), row!(6), row!(7)]);
        [Vector::new(x, y, z), Vector::new(u, v, w)]
    }};
}

/// One coordinate of a tile's pairs, from lane `$first` on.
macro_rules! coordinate {
    (f32, $simd:expr, $numbers:expr, $first:expr) => {
        f32x16::load_array_ref($simd, $numbers)
    };
    (f64, $simd:expr, $numbers:expr, $first:expr) => {{
        let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = *$numbers;
        f64x8::load_array(
            $simd,
            if $first == 0 {
                [a, b, c, d, e, f, g, h]
            } else {
                [i, j, k, l, m, n, o, p]
            },
        )
    }};
}

/// The kernel of one format: `$lanes` holds as many pairs as it looks at in one go, from the pair `$first` on.
macro_rules! kernel {
    ($scalar:ident, $name:ident, $row:ident, $lanes:ident) => {
        #[inline(always)]
        fn $name<V: Simd, P: PairShape>(
            simd: V,
            kernel: Kernel<$scalar>,
            pairs: Sixteen<'_, $scalar>,
            first: usize,
        ) -> Option<Decision<Mask>> {
            macro_rules! point_of_tile {
                ($point:expr) => {{
                    let [[x, y, z], [u, v, w]] = $point;
                    [
                        Vector::new(
                            coordinate!($scalar, simd, x, first),
                            coordinate!($scalar, simd, y, first),
                            coordinate!($scalar, simd, z, first),
                        ),
                        Vector::new(
                            coordinate!($scalar, simd, u, first),
                            coordinate!($scalar, simd, v, first),
                            coordinate!($scalar, simd, w, first),
                        ),
                    ]
                }};
            }
            macro_rules! points_of_tile {
                ($tile:expr) => {{
                    let [a, b, c, d] = &$tile.0;
                    let (a, b) = (point_of_tile!(a), point_of_tile!(b));
                    let (c, d) = (point_of_tile!(c), point_of_tile!(d));
                    PairPoints {
                        start: [a[0], b[0], c[0], d[0]],
                        end: [a[1], b[1], c[1], d[1]],
                    }
                }};
            }
            macro_rules! row_of {
                ($rows:expr, $index:expr) => {
                    $row::load_array_ref(simd, &$rows.get($index as usize)?.0)
                };
            }
            macro_rules! point_of_rows {
                ($rows:expr, $indices:expr, $point:expr) => {
                    columns!($scalar, $indices, first, |pair| row_of!($rows, pair[$point]))
                };
            }
            // Rows are subtracted before they are transposed: three edges to transpose instead of four points, and start and
            // end in one subtraction.
            macro_rules! edge_of_rows {
                ($rows:expr, $indices:expr, $point:expr) => {
                    columns!($scalar, $indices, first, |pair| {
                        let points = P::volume_points(*pair);
                        row_of!($rows, points[$point]) - row_of!($rows, points[0])
                    })
                };
            }
            match kernel {
                Kernel::Points(test) => {
                    let points: PairPoints<$lanes<V>> = match pairs {
                        Sixteen::Tile(tile) => points_of_tile!(tile),
                        Sixteen::Mesh { rows, indices } => {
                            let a = point_of_rows!(rows, indices, 0);
                            let b = point_of_rows!(rows, indices, 1);
                            let c = point_of_rows!(rows, indices, 2);
                            let d = point_of_rows!(rows, indices, 3);
                            PairPoints {
                                start: [a[0], b[0], c[0], d[0]],
                                end: [a[1], b[1], c[1], d[1]],
                            }
                        }
                    };
                    Some(Decision {
                        culled: test.on::<P, _>(&points).to_bitmask() as Mask,
                        settled: 0,
                    })
                }
                Kernel::Bounded(bound, separation) => {
                    let tetrahedron: MovingTetrahedron<$lanes<V>> = match pairs {
                        Sixteen::Tile(tile) => points_of_tile!(tile).tetrahedron::<P>(),
                        Sixteen::Mesh { rows, indices } => MovingTetrahedron {
                            b: edge_of_rows!(rows, indices, 1),
                            c: edge_of_rows!(rows, indices, 2),
                            p: edge_of_rows!(rows, indices, 3),
                        },
                    };
                    let separation = match separation {
                        Some(separation) => Some(<$lanes<V> as SimdBase<V>>::splat(simd, separation)),
                        None => None,
                    };
                    let decision = decide::<P, _>(bound, &tetrahedron, separation);
                    Some(Decision {
                        culled: decision.culled.to_bitmask() as Mask,
                        settled: decision.settled.to_bitmask() as Mask,
                    })
                }
            }
        }
    };
}

/// A round of advancing for one format: `$lanes` holds as many pairs as it looks at in one go, from the pair `$first` on.
macro_rules! round_kernel {
    ($scalar:ident, $name:ident, $row:ident, $lanes:ident) => {
        #[inline(always)]
        fn $name<V: Simd, P: PairShape>(
            simd: V,
            question: &RoundQuestion<$scalar>,
            rows: &[VertexRow<$scalar>],
            indices: &[[u32; 4]; LANES],
            times: $lanes<V>,
            first: usize,
        ) -> Option<LaneRound<$lanes<V>>> {
            macro_rules! point {
                ($point:expr) => {
                    columns!($scalar, indices, first, |pair| $row::load_array_ref(
                        simd,
                        &rows.get(pair[$point] as usize)?.0
                    ))
                };
            }
            let (a, b, c, d) = (point!(0), point!(1), point!(2), point!(3));
            let points = PairPoints {
                start: [a[0], b[0], c[0], d[0]],
                end: [a[1], b[1], c[1], d[1]],
            };
            Some(round::<P, _>(&points, times, question))
        }
    };
}

round_kernel!(f32, round_f32, f32x8, f32x16);
round_kernel!(f64, round_f64, f64x8, f64x8);

kernel!(f32, sixteen_f32, f32x8, f32x16);
kernel!(f64, eight_f64, f64x8, f64x8);

/// Runs `$op` with a token `$simd` for `$level`.
///
/// On x86 without code of its own for SSE4.2, which has next to nothing over SSE2 for these kernels: that would take half as long
/// again to compile.
macro_rules! vectorized {
    ($level:expr, $simd:ident => $op:expr) => {{
        #[cfg(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2"))]
        {
            let level: Level = $level;
            if let Some($simd) = level.as_avx512() {
                $simd.vectorize(#[inline(always)] || $op)
            } else if let Some($simd) = level.as_avx2() {
                $simd.vectorize(#[inline(always)] || $op)
            } else {
                // Every level has SSE2 here.
                let $simd = level.as_sse2()?;
                $simd.vectorize(#[inline(always)] || $op)
            }
        }
        #[cfg(not(all(any(target_arch = "x86", target_arch = "x86_64"), target_feature = "sse2")))]
        {
            fearless_simd::dispatch!($level, $simd => $op)
        }
    }};
}

impl BatchScalar for f32 {
    fn sixteen(level: Level, kind: PairKind, kernel: Kernel<f32>, pairs: Sixteen<'_, f32>) -> Option<Decision<Mask>> {
        vectorized!(level, simd => match kind {
            PairKind::VertexFace => sixteen_f32::<_, VertexAndFace>(simd, kernel, pairs, 0),
            PairKind::EdgeEdge => sixteen_f32::<_, EdgeAndEdge>(simd, kernel, pairs, 0),
        })
    }

    fn round(
        level: Level,
        kind: PairKind,
        question: &RoundQuestion<f32>,
        rows: &[VertexRow<f32>],
        indices: &[[u32; 4]; LANES],
        times: &mut [f32; LANES],
    ) -> Option<Round> {
        vectorized!(level, simd => {
            let from = f32x16::load_array_ref(simd, times);
            let all = match kind {
                PairKind::VertexFace => round_f32::<_, VertexAndFace>(simd, question, rows, indices, from, 0),
                PairKind::EdgeEdge => round_f32::<_, EdgeAndEdge>(simd, question, rows, indices, from, 0),
            }?;
            *times = all.time.to_array();
            Some(Round {
                apart: all.apart.to_bitmask() as Mask,
                near: all.near.to_bitmask() as Mask,
                stuck: all.stuck.to_bitmask() as Mask,
            })
        })
    }
}

impl BatchScalar for f64 {
    fn sixteen(level: Level, kind: PairKind, kernel: Kernel<f64>, pairs: Sixteen<'_, f64>) -> Option<Decision<Mask>> {
        vectorized!(level, simd => match kind {
            PairKind::VertexFace => sixteen_f64::<_, VertexAndFace>(simd, kernel, pairs),
            PairKind::EdgeEdge => sixteen_f64::<_, EdgeAndEdge>(simd, kernel, pairs),
        })
    }

    fn round(
        level: Level,
        kind: PairKind,
        question: &RoundQuestion<f64>,
        rows: &[VertexRow<f64>],
        indices: &[[u32; 4]; LANES],
        times: &mut [f64; LANES],
    ) -> Option<Round> {
        vectorized!(level, simd => match kind {
            PairKind::VertexFace => {
                sixteen_rounds_f64::<_, VertexAndFace>(simd, question, rows, indices, times)
            }
            PairKind::EdgeEdge => {
                sixteen_rounds_f64::<_, EdgeAndEdge>(simd, question, rows, indices, times)
            }
        })
    }
}

/// Eight pairs at a time: what an AVX-512 register holds.
#[inline(always)]
fn sixteen_f64<V: Simd, P: PairShape>(simd: V, kernel: Kernel<f64>, pairs: Sixteen<'_, f64>) -> Option<Decision<Mask>> {
    let low = eight_f64::<V, P>(simd, kernel, pairs, 0)?;
    let high = eight_f64::<V, P>(simd, kernel, pairs, 8)?;
    Some(Decision {
        culled: low.culled | high.culled << 8,
        settled: low.settled | high.settled << 8,
    })
}

/// Eight pairs at a time.
#[inline(always)]
fn sixteen_rounds_f64<V: Simd, P: PairShape>(
    simd: V,
    question: &RoundQuestion<f64>,
    rows: &[VertexRow<f64>],
    indices: &[[u32; 4]; LANES],
    times: &mut [f64; LANES],
) -> Option<Round> {
    let [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = *times;
    let from = f64x8::load_array(simd, [a, b, c, d, e, f, g, h]);
    let low = round_f64::<V, P>(simd, question, rows, indices, from, 0)?;
    let from = f64x8::load_array(simd, [i, j, k, l, m, n, o, p]);
    let high = round_f64::<V, P>(simd, question, rows, indices, from, 8)?;
    let [a, b, c, d, e, f, g, h] = low.time.to_array();
    let [i, j, k, l, m, n, o, p] = high.time.to_array();
    *times = [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p];
    macro_rules! both {
        ($mask:ident) => {
            low.$mask.to_bitmask() as Mask | (high.$mask.to_bitmask() as Mask) << 8
        };
    }
    Some(Round {
        apart: both!(apart),
        near: both!(near),
        stuck: both!(stuck),
    })
}

/// Transposes eight rows by three rounds of interleaving row k with row k + 4:
///
/// ```text
/// rows        a0 a1 … a7, b0 b1 … b7, …, h0 h1 … h7
/// 1 round     a0 e0 a1 e1 …               (rows a, e)
/// 2 rounds    a0 c0 e0 g0 a1 c1 e1 g1     (rows a, c, e, g)
/// 3 rounds    a0 b0 c0 d0 e0 f0 g0 h0     column 0
/// ```
///
/// Of rows of sixteen each result holds two columns, 0 and 1 the first.
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
