//! Chunks of sixteen pairs: as many as a vector register holds, or one.

use super::mask::{LANES, Mask};
use super::rows::VertexRow;
use super::sixteen::Sixteen;
use crate::lanes::Lanes;
use crate::points::PairPoints;
use crate::scalar::Scalar;
use crate::vector::Vector;
use core::ops::Sub;

/// Lanes that load from rows and tiles, and store. Chunks of sixteen pairs begin at `first`, a multiple of the width.
pub(super) trait Chunk: Lanes<Scalar: Scalar> {
    /// The proof that the machine has the instructions.
    type Token: Copy;
    /// The part of a [`VertexRow`] that a register holds, at most all of it.
    type Part: Copy + Sub<Output = Self::Part>;

    const WIDTH: usize;

    /// Loads the numbers from `first` on.
    fn load(token: Self::Token, numbers: &[Self::Scalar; LANES], first: usize) -> Self;
    /// Stores the numbers from `first` on.
    fn store(self, numbers: &mut [Self::Scalar; LANES], first: usize);
    fn bits(mask: Self::Mask) -> Mask;
    /// Loads one part of a row; the first is part 0.
    fn part(token: Self::Token, row: &VertexRow<Self::Scalar>, part: usize) -> Self::Part;
    /// Transposes rows to lanes of start and end. `row` returns a row by lane and part; the result is `None` if `row` returns it.
    fn columns(row: impl Fn(usize, usize) -> Option<Self::Part>) -> Option<[Vector<Self>; 2]>;
}

/// Loads the points of the pairs from `first` on. Returns `None` if an index is not in the rows.
#[inline(always)]
pub(super) fn points<L: Chunk>(token: L::Token, pairs: Sixteen<'_, L::Scalar>, first: usize) -> Option<PairPoints<L>> {
    // This is a macro, since a closure that is not inlined has none of the machine's instructions.
    macro_rules! point {
        ($point:literal) => {
            match pairs {
                Sixteen::Tile(tile) => tile.0[$point].each_ref().map(
                    #[inline(always)]
                    |[x, y, z]| {
                        Vector::new(
                            L::load(token, x, first),
                            L::load(token, y, first),
                            L::load(token, z, first),
                        )
                    },
                ),
                Sixteen::Mesh { rows, indices } => L::columns(
                    #[inline(always)]
                    |lane, part| {
                        let row = rows.get(indices[(first + lane) % LANES][$point] as usize)?;
                        Some(L::part(token, row, part))
                    },
                )?,
            }
        };
    }
    let ([a, e], [b, f], [c, g], [d, h]) = (point!(0), point!(1), point!(2), point!(3));
    Some(PairPoints {
        start: [a, b, c, d],
        end: [e, f, g, h],
    })
}

/// Returns, for each pair from `first` on, the difference of two points, the second minus the first. `ends` selects them from the
/// pair's four indices. Returns `None` if an index is not in the rows.
///
/// Rows are subtracted before they are transposed: one subtraction for start and end, and three edges to transpose instead of
/// four points.
#[inline(always)]
pub(super) fn edge<L: Chunk>(
    token: L::Token,
    rows: &[VertexRow<L::Scalar>],
    indices: &[[u32; 4]; LANES],
    first: usize,
    ends: impl Fn([u32; 4]) -> [u32; 2],
) -> Option<[Vector<L>; 2]> {
    L::columns(
        #[inline(always)]
        |lane, part| {
            let [from, to] = ends(indices[(first + lane) % LANES]);
            let (from, to) = (rows.get(from as usize)?, rows.get(to as usize)?);
            Some(L::part(token, to, part) - L::part(token, from, part))
        },
    )
}

/// The start and the end of a vertex, or of a difference of two, for one lane alone.
#[derive(Clone, Copy)]
pub(super) struct Row<S>([Vector<S>; 2]);

impl<S: Lanes> Sub for Row<S> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self([self.0[0] - other.0[0], self.0[1] - other.0[1]])
    }
}

macro_rules! one_lane {
    ($scalar:ident) => {
        impl Chunk for $scalar {
            type Token = ();
            type Part = Row<$scalar>;

            const WIDTH: usize = 1;

            #[inline(always)]
            fn load((): (), numbers: &[$scalar; LANES], first: usize) -> Self {
                numbers[first % LANES]
            }

            #[inline(always)]
            fn store(self, numbers: &mut [$scalar; LANES], first: usize) {
                numbers[first % LANES] = self;
            }

            #[inline(always)]
            fn bits(mask: bool) -> Mask {
                mask.into()
            }

            #[inline(always)]
            fn part((): (), row: &VertexRow<$scalar>, _: usize) -> Row<$scalar> {
                let [x, y, z, _, u, v, w, _] = row.0;
                Row([Vector::new(x, y, z), Vector::new(u, v, w)])
            }

            #[inline(always)]
            fn columns(row: impl Fn(usize, usize) -> Option<Row<$scalar>>) -> Option<[Vector<Self>; 2]> {
                Some(row(0, 0)?.0)
            }
        }
    };
}

one_lane!(f32);
one_lane!(f64);

#[cfg(not(unoptimised))]
mod vectors {
    use super::Chunk;
    use crate::batch::mask::{LANES, Mask};
    use crate::batch::rows::VertexRow;
    use crate::vector::Vector;
    use fearless_simd::{Simd, SimdBase, SimdCombine, SimdMask, SimdSplit, f32x4, f32x8, f32x16, f64x2, f64x4, f64x8};

    /// Transposes N rows of N numbers by log₂ N rounds of interleaving row k with row k + N/2. For N = 8:
    ///
    /// ```text
    /// rows        a0 a1 … a7, b0 b1 … b7, …, h0 h1 … h7
    /// 1 round     a0 e0 a1 e1 …               (rows a, e)
    /// 2 rounds    a0 c0 e0 g0 a1 c1 e1 g1     (rows a, c, e, g)
    /// 3 rounds    a0 b0 c0 d0 e0 f0 g0 h0     column 0
    /// ```
    ///
    /// If rows have 2N numbers, each result holds two columns, 0 and 1 first.
    #[inline(always)]
    fn two<V: Simd, T: SimdBase<V>>([a, b]: [T; 2]) -> [T; 2] {
        let (first, second) = a.interleave(b);
        [first, second]
    }

    #[inline(always)]
    fn four<V: Simd, T: SimdBase<V>>([a, b, c, d]: [T; 4]) -> [T; 4] {
        let ([ac, ac_2], [bd, bd_2]) = (two([a, c]), two([b, d]));
        let ([x, y], [z, w]) = (two([ac, bd]), two([ac_2, bd_2]));
        [x, y, z, w]
    }

    #[inline(always)]
    fn eight<V: Simd, T: SimdBase<V>>([a, b, c, d, e, f, g, h]: [T; 8]) -> [T; 8] {
        let ([ae, ae_2], [bf, bf_2]) = (two([a, e]), two([b, f]));
        let ([cg, cg_2], [dh, dh_2]) = (two([c, g]), two([d, h]));
        let ([p, q, r, s], [t, u, v, w]) = (four([ae, bf, cg, dh]), four([ae_2, bf_2, cg_2, dh_2]));
        [p, q, r, s, t, u, v, w]
    }

    macro_rules! vector {
        ($vector:ident, $scalar:ident, $width:literal, $part:ident, $parts:literal, |$row:ident| $columns:expr) => {
            impl<V: Simd> Chunk for $vector<V> {
                type Token = V;
                type Part = $part<V>;

                const WIDTH: usize = $width;

                #[inline(always)]
                fn load(simd: V, numbers: &[$scalar; LANES], first: usize) -> Self {
                    let chunks = numbers.as_chunks::<$width>().0;
                    Self::load_array_ref(simd, &chunks[first / $width % (LANES / $width)])
                }

                #[inline(always)]
                fn store(self, numbers: &mut [$scalar; LANES], first: usize) {
                    let chunks = numbers.as_chunks_mut::<$width>().0;
                    chunks[first / $width % (LANES / $width)] = self.to_array();
                }

                #[inline(always)]
                fn bits(mask: Self::Mask) -> Mask {
                    mask.to_bitmask() as Mask
                }

                #[inline(always)]
                fn part(simd: V, row: &VertexRow<$scalar>, part: usize) -> $part<V> {
                    $part::load_array_ref(simd, &row.0.as_chunks().0[part % $parts])
                }

                #[inline(always)]
                fn columns($row: impl Fn(usize, usize) -> Option<$part<V>>) -> Option<[Vector<Self>; 2]> {
                    $columns
                }
            }
        };
    }

    macro_rules! two_wide {
        ($row:ident) => {{
            let [x, y] = two([$row(0, 0)?, $row(1, 0)?]);
            let [z, _] = two([$row(0, 1)?, $row(1, 1)?]);
            let [u, v] = two([$row(0, 2)?, $row(1, 2)?]);
            let [w, _] = two([$row(0, 3)?, $row(1, 3)?]);
            Some([Vector::new(x, y, z), Vector::new(u, v, w)])
        }};
    }

    macro_rules! four_wide {
        ($row:ident) => {{
            let [x, y, z, _] = four([$row(0, 0)?, $row(1, 0)?, $row(2, 0)?, $row(3, 0)?]);
            let [u, v, w, _] = four([$row(0, 1)?, $row(1, 1)?, $row(2, 1)?, $row(3, 1)?]);
            Some([Vector::new(x, y, z), Vector::new(u, v, w)])
        }};
    }

    macro_rules! eight_wide {
        ($row:ident) => {{
            let [a, b, c, d] = [$row(0, 0)?, $row(1, 0)?, $row(2, 0)?, $row(3, 0)?];
            let [e, f, g, h] = [$row(4, 0)?, $row(5, 0)?, $row(6, 0)?, $row(7, 0)?];
            let [x, y, z, _, u, v, w, _] = eight([a, b, c, d, e, f, g, h]);
            Some([Vector::new(x, y, z), Vector::new(u, v, w)])
        }};
    }

    /// A register holds the rows of pairs k and k + 8, and after transposition two columns of eight pairs.
    macro_rules! sixteen_wide {
        ($row:ident) => {{
            macro_rules! two {
                ($lane:literal) => {
                    $row($lane, 0)?.combine($row($lane + 8, 0)?)
                };
            }
            let [a, b, c, d] = [two!(0), two!(1), two!(2), two!(3)];
            let [e, f, g, h] = [two!(4), two!(5), two!(6), two!(7)];
            let [xy, z, uv, w, xy_8, z_8, uv_8, w_8] = eight([a, b, c, d, e, f, g, h]);
            let ((x, y), (x_8, y_8)) = (xy.split(), xy_8.split());
            let ((u, v), (u_8, v_8)) = (uv.split(), uv_8.split());
            let ((z, _), (z_8, _)) = (z.split(), z_8.split());
            let ((w, _), (w_8, _)) = (w.split(), w_8.split());
            Some([
                Vector::new(x.combine(x_8), y.combine(y_8), z.combine(z_8)),
                Vector::new(u.combine(u_8), v.combine(v_8), w.combine(w_8)),
            ])
        }};
    }

    vector!(f64x2, f64, 2, f64x2, 4, |row| two_wide!(row));
    vector!(f64x4, f64, 4, f64x4, 2, |row| four_wide!(row));
    vector!(f32x4, f32, 4, f32x4, 2, |row| four_wide!(row));
    vector!(f64x8, f64, 8, f64x8, 1, |row| eight_wide!(row));
    vector!(f32x8, f32, 8, f32x8, 1, |row| eight_wide!(row));
    vector!(f32x16, f32, 16, f32x8, 1, |row| sixteen_wide!(row));
}
