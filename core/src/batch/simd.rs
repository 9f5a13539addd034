//! `f32` and `f64` vectors as [`Lanes`], and how rows and tiles become lanes.

use super::{Kernel, LANES, Level, Mask, Tile, VertexRow};
use crate::coplanarity::MovingTetrahedron;
use crate::filter::certified::{Decision, decide};
use crate::lanes::Lanes;
use crate::points::{EdgeAndEdge, PairPoints, PairShape, Shape, VertexAndFace};
use crate::vector::Vector;
use fearless_simd::{
    ExtractToken, Simd, SimdBase, SimdCombine, SimdFloat, SimdMask, dispatch, f32x8, f32x16, f64x8,
};

/// What [`Scalar`](crate::Scalar) needs to go sixteen at a time.
///
/// The method is not generic, so that its many kernels (for each instruction set, test and shape) are compiled once, in
/// this crate, and not in every crate that calls it.
pub trait BatchScalar: Copy {
    /// What `kernel` says of sixteen pairs.
    #[doc(hidden)]
    fn sixteen(
        level: Level,
        shape: Shape,
        kernel: Kernel<Self>,
        pairs: Sixteen<'_, Self>,
    ) -> Decision<Mask>;
}

/// Sixteen pairs' four points.
#[doc(hidden)]
#[derive(Clone, Copy, Debug)]
pub enum Sixteen<'a, S> {
    Rows(&'a Rows<'a, S>),
    Tile(&'a Tile<S>),
}

/// The rows of sixteen pairs' four points.
pub(crate) type Rows<'a, S> = [[&'a VertexRow<S>; 4]; LANES];

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

/// `$row` of eight pairs, transposed: eight numbers of one kind in each vector.
macro_rules! columns_of_eight {
    ($pairs:expr, $first:expr, |$pair:ident| $row:expr) => {{
        macro_rules! row {
            ($index:expr) => {{
                let $pair = &$pairs[$first + $index];
                $row
            }};
        }
        transposed([
            row!(0),
            row!(1),
            row!(2),
            row!(3),
            row!(4),
            row!(5),
            row!(6),
            row!(7),
        ])
    }};
}

/// The same of sixteen `f32` pairs, or of eight `f64` pairs from `$first` on. The fourth and the last column are padding.
macro_rules! columns {
    (f32, $pairs:expr, $first:expr, |$pair:ident| $row:expr) => {{
        let [a, b, c, _, d, e, f, _] = columns_of_eight!($pairs, $first, |$pair| $row);
        let [g, h, i, _, j, k, l, _] = columns_of_eight!($pairs, $first + 8, |$pair| $row);
        [
            Vector::new(a.combine(g), b.combine(h), c.combine(i)),
            Vector::new(d.combine(j), e.combine(k), f.combine(l)),
        ]
    }};
    (f64, $pairs:expr, $first:expr, |$pair:ident| $row:expr) => {{
        // An index from `$first` on would be checked, and could panic.
        let half = if $first == 0 {
            $pairs.first_chunk::<8>()
        } else {
            $pairs.last_chunk::<8>()
        };
        let Some(half) = half else {
            return Decision {
                culled: 0,
                opposite: 0,
            };
        };
        let [a, b, c, _, d, e, f, _] = columns_of_eight!(half, 0, |$pair| $row);
        [Vector::new(a, b, c), Vector::new(d, e, f)]
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
        ) -> Decision<Mask> {
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
            macro_rules! point_of_rows {
                ($rows:expr, $point:expr) => {
                    columns!($scalar, $rows, first, |pair| $row::load_array_ref(
                        simd,
                        &pair[$point].0
                    ))
                };
            }
            // Rows are subtracted before they are transposed: three edges to transpose instead of four points, and start and
            // end in one subtraction.
            macro_rules! edge_of_rows {
                ($rows:expr, $point:expr) => {
                    columns!($scalar, $rows, first, |pair| {
                        let points = P::volume_points([0, 1, 2, 3]);
                        $row::load_array_ref(simd, &pair[points[$point]].0)
                            - $row::load_array_ref(simd, &pair[points[0]].0)
                    })
                };
            }
            match kernel {
                Kernel::Boxes(test) => {
                    let points: PairPoints<$lanes<V>> = match pairs {
                        Sixteen::Tile(tile) => points_of_tile!(tile),
                        Sixteen::Rows(rows) => {
                            let (a, b) = (point_of_rows!(rows, 0), point_of_rows!(rows, 1));
                            let (c, d) = (point_of_rows!(rows, 2), point_of_rows!(rows, 3));
                            PairPoints {
                                start: [a[0], b[0], c[0], d[0]],
                                end: [a[1], b[1], c[1], d[1]],
                            }
                        }
                    };
                    Decision {
                        culled: test.on::<P, _>(&points).to_bitmask() as Mask,
                        opposite: 0,
                    }
                }
                Kernel::Bounded(bound, separation) => {
                    let tetrahedron: MovingTetrahedron<$lanes<V>> = match pairs {
                        Sixteen::Tile(tile) => points_of_tile!(tile).tetrahedron::<P>(),
                        Sixteen::Rows(rows) => MovingTetrahedron {
                            b: edge_of_rows!(rows, 1),
                            c: edge_of_rows!(rows, 2),
                            p: edge_of_rows!(rows, 3),
                        },
                    };
                    let separation = match separation {
                        Some(separation) => {
                            Some(<$lanes<V> as SimdBase<V>>::splat(simd, separation))
                        }
                        None => None,
                    };
                    let decision = decide::<P, _>(bound, &tetrahedron, separation);
                    Decision {
                        culled: decision.culled.to_bitmask() as Mask,
                        opposite: decision.opposite.to_bitmask() as Mask,
                    }
                }
            }
        }
    };
}

kernel!(f32, sixteen_f32, f32x8, f32x16);
kernel!(f64, eight_f64, f64x8, f64x8);

impl BatchScalar for f32 {
    fn sixteen(
        level: Level,
        shape: Shape,
        kernel: Kernel<f32>,
        pairs: Sixteen<'_, f32>,
    ) -> Decision<Mask> {
        dispatch!(level, simd => match shape {
            Shape::VertexFace => sixteen_f32::<_, VertexAndFace>(simd, kernel, pairs, 0),
            Shape::EdgeEdge => sixteen_f32::<_, EdgeAndEdge>(simd, kernel, pairs, 0),
        })
    }
}

impl BatchScalar for f64 {
    fn sixteen(
        level: Level,
        shape: Shape,
        kernel: Kernel<f64>,
        pairs: Sixteen<'_, f64>,
    ) -> Decision<Mask> {
        dispatch!(level, simd => match shape {
            Shape::VertexFace => sixteen_f64::<_, VertexAndFace>(simd, kernel, pairs),
            Shape::EdgeEdge => sixteen_f64::<_, EdgeAndEdge>(simd, kernel, pairs),
        })
    }
}

/// Eight pairs at a time: what an AVX-512 register holds.
#[inline(always)]
fn sixteen_f64<V: Simd, P: PairShape>(
    simd: V,
    kernel: Kernel<f64>,
    pairs: Sixteen<'_, f64>,
) -> Decision<Mask> {
    let mut both = Decision {
        culled: 0,
        opposite: 0,
    };
    // A loop, lest the code be there twice.
    for first in [0, 8] {
        let eight = eight_f64::<V, P>(simd, kernel, pairs, first);
        both.culled |= eight.culled << first;
        both.opposite |= eight.opposite << first;
    }
    both
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
