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
    /// Loads one part of two rows, which are the same if a register holds a part of one; the first is part 0.
    fn part(token: Self::Token, rows: [&VertexRow<Self::Scalar>; 2], part: usize) -> Self::Part;
    /// Transposes rows to lanes of start and end. `row` returns a part of the rows of two lanes; the result is `None` if `row`
    /// returns it.
    fn columns(token: Self::Token, row: impl Fn([usize; 2], usize) -> Option<Self::Part>) -> Option<[Vector<Self>; 2]>;
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
                    token,
                    #[inline(always)]
                    |[one, other], part| {
                        let one = rows.get(indices[(first + one) % LANES][$point] as usize)?;
                        let other = rows.get(indices[(first + other) % LANES][$point] as usize)?;
                        Some(L::part(token, [one, other], part))
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
        token,
        #[inline(always)]
        |[one, other], part| {
            let ([from, to], [other_from, other_to]) =
                (ends(indices[(first + one) % LANES]), ends(indices[(first + other) % LANES]));
            let (from, to) = (rows.get(from as usize)?, rows.get(to as usize)?);
            let (other_from, other_to) = (rows.get(other_from as usize)?, rows.get(other_to as usize)?);
            Some(L::part(token, [to, other_to], part) - L::part(token, [from, other_from], part))
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
            fn part((): (), [row, _]: [&VertexRow<$scalar>; 2], _: usize) -> Row<$scalar> {
                let [x, y, z, _, u, v, w, _] = row.0;
                Row([Vector::new(x, y, z), Vector::new(u, v, w)])
            }

            #[inline(always)]
            fn columns((): (), row: impl Fn([usize; 2], usize) -> Option<Row<$scalar>>) -> Option<[Vector<Self>; 2]> {
                Some(row([0, 0], 0)?.0)
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

    /// Interleaves the lower halves of two registers, and their upper halves: the results have what [`two`] has of each half.
    /// AVX2 has one instruction for each result, and needs two more to interleave the whole registers.
    #[inline(always)]
    fn two_by_halves<V: Simd>([a, b]: [f32x8<V>; 2]) -> [f32x8<V>; 2] {
        let ((a, a_4), (b, b_4)) = (a.split(), b.split());
        let ([first, second], [first_4, second_4]) = (two([a, b]), two([a_4, b_4]));
        [first.combine(first_4), second.combine(second_4)]
    }

    /// Transposes the halves of four registers.
    #[inline(always)]
    fn four_by_halves<V: Simd>([a, b, c, d]: [f32x8<V>; 4]) -> [f32x8<V>; 4] {
        let ([ac, ac_2], [bd, bd_2]) = (two_by_halves([a, c]), two_by_halves([b, d]));
        let ([x, y], [z, w]) = (two_by_halves([ac, bd]), two_by_halves([ac_2, bd_2]));
        [x, y, z, w]
    }

    /// Implements [`Chunk`] for a vector of `$width` numbers. `$load` loads a part, and the macro `$columns` transposes parts.
    macro_rules! vector {
        ($vector:ident, $scalar:ident, $width:literal, $part:ident, $load:ident, $columns:ident) => {
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
                fn part(simd: V, rows: [&VertexRow<$scalar>; 2], part: usize) -> $part<V> {
                    $load(simd, rows, part)
                }

                #[inline(always)]
                fn columns(simd: V, row: impl Fn([usize; 2], usize) -> Option<$part<V>>) -> Option<[Vector<Self>; 2]> {
                    let _ = simd;
                    $columns!(simd, row)
                }
            }
        };
    }

    /// Defines a function that returns one part of the first row, whose `$parts` parts all have the same width.
    macro_rules! part_of_one {
        ($name:ident, $part:ident, $scalar:ident, $parts:literal) => {
            #[inline(always)]
            fn $name<V: Simd>(simd: V, [row, _]: [&VertexRow<$scalar>; 2], part: usize) -> $part<V> {
                $part::load_array_ref(simd, &row.0.as_chunks().0[part % $parts])
            }
        };
    }

    part_of_one!(quarter_of_doubles, f64x2, f64, 4);
    part_of_one!(half_of_doubles, f64x4, f64, 2);
    part_of_one!(half_of_floats, f32x4, f32, 2);
    part_of_one!(whole_of_doubles, f64x8, f64, 1);

    /// Returns one half of both rows.
    #[inline(always)]
    fn two_halves<V: Simd>(simd: V, [one, other]: [&VertexRow<f32>; 2], half: usize) -> f32x8<V> {
        let [one, other] = [one.0.as_chunks().0[half % 2], other.0.as_chunks().0[half % 2]];
        f32x4::load_array_ref(simd, &one).combine(f32x4::load_array_ref(simd, &other))
    }

    /// The part that is a whole row, where a part may also be a half of two.
    const WHOLE: usize = 2;

    /// Returns the first row for [`WHOLE`], otherwise one half of both.
    #[inline(always)]
    fn row_or_two_halves<V: Simd>(simd: V, rows: [&VertexRow<f32>; 2], part: usize) -> f32x8<V> {
        if part == WHOLE {
            f32x8::load_array_ref(simd, &rows[0].0)
        } else {
            two_halves(simd, rows, part)
        }
    }

    /// Returns whether registers hold sixteen `f32`; otherwise one of that width is two of 256 bits, each of which has two
    /// halves.
    #[inline(always)]
    fn has_registers_of_sixteen(simd: impl Simd) -> bool {
        #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
        let has_them = matches!(simd.level(), fearless_simd::Level::Avx512(_));
        #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
        let (has_them, _) = (false, simd);
        has_them
    }

    macro_rules! two_wide {
        ($simd:ident, $row:ident) => {{
            let [x, y] = two([$row([0, 0], 0)?, $row([1, 1], 0)?]);
            let [z, _] = two([$row([0, 0], 1)?, $row([1, 1], 1)?]);
            let [u, v] = two([$row([0, 0], 2)?, $row([1, 1], 2)?]);
            let [w, _] = two([$row([0, 0], 3)?, $row([1, 1], 3)?]);
            Some([Vector::new(x, y, z), Vector::new(u, v, w)])
        }};
    }

    macro_rules! four_wide {
        ($simd:ident, $row:ident) => {{
            let [x, y, z, _] = four([$row([0, 0], 0)?, $row([1, 1], 0)?, $row([2, 2], 0)?, $row([3, 3], 0)?]);
            let [u, v, w, _] = four([$row([0, 0], 1)?, $row([1, 1], 1)?, $row([2, 2], 1)?, $row([3, 3], 1)?]);
            Some([Vector::new(x, y, z), Vector::new(u, v, w)])
        }};
    }

    macro_rules! eight_wide {
        ($simd:ident, $row:ident) => {{
            let [a, b, c, d] = [$row([0, 0], 0)?, $row([1, 1], 0)?, $row([2, 2], 0)?, $row([3, 3], 0)?];
            let [e, f, g, h] = [$row([4, 4], 0)?, $row([5, 5], 0)?, $row([6, 6], 0)?, $row([7, 7], 0)?];
            let [x, y, z, _, u, v, w, _] = eight([a, b, c, d, e, f, g, h]);
            Some([Vector::new(x, y, z), Vector::new(u, v, w)])
        }};
    }

    #[inline(always)]
    fn combined<V: Simd>(low: Vector<f32x8<V>>, high: Vector<f32x8<V>>) -> Vector<f32x16<V>> {
        Vector::new(low.x.combine(high.x), low.y.combine(high.y), low.z.combine(high.z))
    }

    /// A register holds a half of the rows of pairs k and k + 4, from `first` on, and after transposition a column of eight
    /// pairs.
    macro_rules! eight_from {
        ($row:ident, $first:literal) => {{
            macro_rules! two {
                ($lane:literal, $half:literal) => {
                    $row([$first + $lane, $first + $lane + 4], $half)?
                };
            }
            let [x, y, z, _] = four_by_halves([two!(0, 0), two!(1, 0), two!(2, 0), two!(3, 0)]);
            let [u, v, w, _] = four_by_halves([two!(0, 1), two!(1, 1), two!(2, 1), two!(3, 1)]);
            [Vector::new(x, y, z), Vector::new(u, v, w)]
        }};
    }

    macro_rules! two_by_four_wide {
        ($simd:ident, $row:ident) => {
            Some(eight_from!($row, 0))
        };
    }

    /// A register holds the rows of pairs k and k + 8, and after transposition two columns of eight pairs.
    macro_rules! sixteen_wide {
        ($row:ident) => {{
            macro_rules! two {
                ($lane:literal) => {
                    $row([$lane, $lane], WHOLE)?.combine($row([$lane + 8, $lane + 8], WHOLE)?)
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
                combined(Vector::new(x, y, z), Vector::new(x_8, y_8, z_8)),
                combined(Vector::new(u, v, w), Vector::new(u_8, v_8, w_8)),
            ])
        }};
    }

    macro_rules! two_by_eight_wide {
        ($simd:ident, $row:ident) => {{
            if has_registers_of_sixteen($simd) {
                sixteen_wide!($row)
            } else {
                let ([start, end], [start_8, end_8]) = (eight_from!($row, 0), eight_from!($row, 8));
                Some([combined(start, start_8), combined(end, end_8)])
            }
        }};
    }

    vector!(f64x2, f64, 2, f64x2, quarter_of_doubles, two_wide);
    vector!(f64x4, f64, 4, f64x4, half_of_doubles, four_wide);
    vector!(f32x4, f32, 4, f32x4, half_of_floats, four_wide);
    vector!(f64x8, f64, 8, f64x8, whole_of_doubles, eight_wide);
    vector!(f32x8, f32, 8, f32x8, two_halves, two_by_four_wide);
    vector!(f32x16, f32, 16, f32x8, row_or_two_halves, two_by_eight_wide);
}
