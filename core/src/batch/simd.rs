//! `f32` and `f64` vectors as [`Lanes`], and how rows become lanes.

use super::{LANES, Level, Mask, Test, VertexRow};
use crate::lanes::Lanes;
use crate::points::{EdgeAndEdge, PairPoints, PairShape, Shape, VertexAndFace};
use crate::vector::Vector;
use fearless_simd::{
    ExtractToken, Simd, SimdBase, SimdCombine, SimdMask, dispatch, f32x8, f32x16, f64x8,
};

/// What [`Scalar`](crate::Scalar) needs to go sixteen at a time.
///
/// The method is not generic, so that its many kernels (for each instruction set, test and shape) are compiled once, in
/// this crate, and not in every crate that calls it.
pub trait BatchScalar: Copy {
    /// Which of sixteen pairs `test` culls.
    #[doc(hidden)]
    fn sixteen(level: Level, shape: Shape, test: Test, pairs: &Sixteen<'_, Self>) -> Mask;
}

/// The rows of sixteen pairs' four points.
pub(crate) type Sixteen<'a, S> = [[&'a VertexRow<S>; 4]; LANES];

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
        let pairs: &Sixteen<'_, _> = $pairs;
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
    fn sixteen(level: Level, shape: Shape, test: Test, pairs: &Sixteen<'_, f32>) -> Mask {
        dispatch!(level, simd => match shape {
            Shape::VertexFace => sixteen_f32::<_, VertexAndFace>(simd, test, pairs),
            Shape::EdgeEdge => sixteen_f32::<_, EdgeAndEdge>(simd, test, pairs),
        })
    }
}

impl BatchScalar for f64 {
    fn sixteen(level: Level, shape: Shape, test: Test, pairs: &Sixteen<'_, f64>) -> Mask {
        dispatch!(level, simd => match shape {
            Shape::VertexFace => sixteen_f64::<_, VertexAndFace>(simd, test, pairs),
            Shape::EdgeEdge => sixteen_f64::<_, EdgeAndEdge>(simd, test, pairs),
        })
    }
}

#[inline(always)]
fn sixteen_f32<V: Simd, P: PairShape>(simd: V, test: Test, pairs: &Sixteen<'_, f32>) -> Mask {
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

/// Eight pairs at a time: what an AVX-512 register holds.
#[inline(always)]
fn sixteen_f64<V: Simd, P: PairShape>(simd: V, test: Test, pairs: &Sixteen<'_, f64>) -> Mask {
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
