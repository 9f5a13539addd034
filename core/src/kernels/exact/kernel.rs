//! The control values of the signed volume as whole numbers of three times the coordinates' width.
//!
//! # Head-room
//! Coordinates of at most 64·N − 3 bits and a sign differ by less than 2ᵐ, m = 64·N − 2. Components of n₀ and n₁ are
//! then below 2·2²ᵐ, those of h below 4·2²ᵐ, those of n₀ + h and h + n₁ below 6·2²ᵐ < 2^(2m+3): with a sign 128·N
//! bits. k₀ and k₃ are below 6·2³ᵐ, 3k₁ and 3k₂ below 3·4·2³ᵐ + 3·2·2³ᵐ = 18·2³ᵐ < 2^(3m+5): with a sign 192·N bits.
//! So nothing overflows in 2·N and 3·N words.

use super::aligned::AlignedPair;
use super::integer::{Integer, Space, Whole, Words};
use crate::PairKind;
use core::ops::ControlFlow;

/// The number of bits of the widest coordinates that `N` words serve.
const fn bits_in<const N: usize>() -> u32 {
    64 * N as u32 - 3
}

/// The number of words of a coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) enum Width {
    Words1,
    Words2,
    Words5,
    Words33,
}

impl Width {
    /// Returns the narrowest sufficient width.
    #[inline(always)]
    pub(super) fn of(pair: &AlignedPair) -> Self {
        // An f64 ranges over 2,098 bits, an f32 over 277.
        let bits = pair.bits();
        if bits <= bits_in::<1>() {
            Self::Words1
        } else if bits <= bits_in::<2>() {
            Self::Words2
        } else if bits <= bits_in::<5>() {
            Self::Words5
        } else {
            Self::Words33
        }
    }
}

/// The exact arithmetic of coordinates, of products of two, and of products of three.
pub(super) trait Arithmetic {
    /// A coordinate, or a difference of two.
    type One: Whole;
    /// A sum of products of two.
    type Two: Whole;
    /// A sum of products of three.
    type Three: Whole;

    fn shifted(&mut self, significand: i64, shift: u32) -> Self::One;
    fn difference(&mut self, a: &Self::One, b: &Self::One) -> Self::One;
    fn cross(&mut self, a: &[Self::One; 3], b: &[Self::One; 3]) -> [Self::Two; 3];
    fn sum(&mut self, a: &[Self::Two; 3], b: &[Self::Two; 3]) -> [Self::Two; 3];
    fn dot(&mut self, a: &[Self::One; 3], b: &[Self::Two; 3]) -> Self::Three;
    fn sum_of_three(&mut self, a: &Self::Three, b: &Self::Three) -> Self::Three;

    #[inline(always)]
    fn coordinates(&mut self, pair: &AlignedPair) -> [[Self::One; 8]; 3] {
        pair.coordinates(|significand, shift| self.shifted(significand, shift))
    }
}

/// Arithmetic for coordinates of `N` words; `N2` = 2·`N`, `N3` = 3·`N`.
pub(super) struct Fixed<const N: usize, const N2: usize, const N3: usize>;

impl<const N: usize, const N2: usize, const N3: usize> Arithmetic for Fixed<N, N2, N3> {
    type One = Integer<N>;
    type Two = Integer<N2>;
    type Three = Integer<N3>;

    #[inline(always)]
    fn shifted(&mut self, significand: i64, shift: u32) -> Integer<N> {
        Integer::shifted(significand, shift)
    }

    #[inline(always)]
    fn difference(&mut self, a: &Integer<N>, b: &Integer<N>) -> Integer<N> {
        a.minus(b)
    }

    #[inline(never)]
    fn cross(&mut self, [ax, ay, az]: &[Integer<N>; 3], [bx, by, bz]: &[Integer<N>; 3]) -> [Integer<N2>; 3] {
        [
            ay.times(bz).minus(&az.times(by)),
            az.times(bx).minus(&ax.times(bz)),
            ax.times(by).minus(&ay.times(bx)),
        ]
    }

    #[inline(always)]
    fn sum(&mut self, [ax, ay, az]: &[Integer<N2>; 3], [bx, by, bz]: &[Integer<N2>; 3]) -> [Integer<N2>; 3] {
        [ax.plus(bx), ay.plus(by), az.plus(bz)]
    }

    #[inline(never)]
    fn dot(&mut self, [ax, ay, az]: &[Integer<N>; 3], [bx, by, bz]: &[Integer<N2>; 3]) -> Integer<N3> {
        ax.times(bx).plus(&ay.times(by)).plus(&az.times(bz))
    }

    #[inline(always)]
    fn sum_of_three(&mut self, a: &Integer<N3>, b: &Integer<N3>) -> Integer<N3> {
        a.plus(b)
    }
}

impl<'a> Arithmetic for Space<'a> {
    type One = Words<'a>;
    type Two = Words<'a>;
    type Three = Words<'a>;

    fn shifted(&mut self, significand: i64, shift: u32) -> Words<'a> {
        Space::shifted(self, significand, shift)
    }

    fn difference(&mut self, a: &Words<'a>, b: &Words<'a>) -> Words<'a> {
        self.minus(*a, *b)
    }

    fn cross(&mut self, &[ax, ay, az]: &[Words<'a>; 3], &[bx, by, bz]: &[Words<'a>; 3]) -> [Words<'a>; 3] {
        [
            self.minor(ay, az, by, bz),
            self.minor(az, ax, bz, bx),
            self.minor(ax, ay, bx, by),
        ]
    }

    fn sum(&mut self, &[ax, ay, az]: &[Words<'a>; 3], &[bx, by, bz]: &[Words<'a>; 3]) -> [Words<'a>; 3] {
        [self.plus(ax, bx), self.plus(ay, by), self.plus(az, bz)]
    }

    fn dot(&mut self, &[ax, ay, az]: &[Words<'a>; 3], &[bx, by, bz]: &[Words<'a>; 3]) -> Words<'a> {
        self.sum_of_products([[ax, bx], [ay, by], [az, bz]])
    }

    fn sum_of_three(&mut self, a: &Words<'a>, b: &Words<'a>) -> Words<'a> {
        self.plus(*a, *b)
    }
}

/// Returns the number of words of [`Space`] that coordinates of `N` words need. There are 24 coordinates and 18 edges of N + 1,
/// and 12 components of n₀, n₁ and the parts of h, and 9 of sums of those, of 2·N + 1. Six products of vectors and two sums of
/// them take 3·N + 2. One product of vectors takes 12·N + 1 while it is computed.
pub(super) const fn space(n: usize) -> usize {
    42 * (n + 1) + 21 * (2 * n + 1) + 6 * (3 * n + 2) + 2 * (3 * n + 3) + 12 * n + 1
}

/// A consumer of the control values.
pub(super) trait Judge<A: Arithmetic> {
    /// Returns whether it needs the control value of this index.
    fn wants(&self, index: usize) -> bool;

    /// Receives a control value, and the normal that bounds it (see the module's documentation). Both are tripled for the middle
    /// ones, whose indices are 1 and 2.
    fn judge(
        &mut self,
        arithmetic: &mut A,
        index: usize,
        value: &A::Three,
        normal: impl FnOnce(&mut A) -> [A::Two; 3],
    ) -> ControlFlow<()>;
}

/// The two vectors b and c that span the normal, and p to the other primitive, at one end of the step.
struct Edges<T> {
    b: [T; 3],
    c: [T; 3],
    p: [T; 3],
}

#[inline(always)]
fn edges<A: Arithmetic>(kind: PairKind, [x, y, z]: &[[A::One; 8]; 3], arithmetic: &mut A) -> [Edges<A::One>; 2] {
    let mut ends = |&[a, b, c, d, e, f, g, h]: &[A::One; 8]| {
        [
            differences(kind, [a, b, c, d], arithmetic),
            differences(kind, [e, f, g, h], arithmetic),
        ]
    };
    let ([x0, x1], [y0, y1], [z0, z1]) = (ends(x), ends(y), ends(z));
    let edges = |[x, y, z]: [[A::One; 3]; 3]| Edges {
        b: [x[0], y[0], z[0]],
        c: [x[1], y[1], z[1]],
        p: [x[2], y[2], z[2]],
    };
    [edges([x0, y0, z0]), edges([x1, y1, z1])]
}

/// Returns b, c, p along one axis.
#[inline(always)]
fn differences<A: Arithmetic>(kind: PairKind, points: [A::One; 4], arithmetic: &mut A) -> [A::One; 3] {
    let mut minus = |a, b| arithmetic.difference(a, b);
    match kind {
        PairKind::VertexFace => {
            let [vertex, a, b, c] = &points;
            [minus(b, a), minus(c, a), minus(vertex, a)]
        }
        PairKind::EdgeEdge => {
            let [u, v, k, l] = &points;
            [minus(v, u), minus(l, k), minus(u, k)]
        }
    }
}

/// Passes the control values to `judge`, the cheap ones first, until it stops.
#[inline(always)]
pub(super) fn judge<A: Arithmetic>(
    kind: PairKind,
    coordinates: &[[A::One; 8]; 3],
    arithmetic: &mut A,
    judge: &mut impl Judge<A>,
) -> ControlFlow<()> {
    let [start, end] = edges(kind, coordinates, arithmetic);
    let n0 = arithmetic.cross(&start.b, &start.c);
    if judge.wants(0) {
        let value = arithmetic.dot(&start.p, &n0);
        judge.judge(arithmetic, 0, &value, |_| n0)?;
    }
    let n1 = arithmetic.cross(&end.b, &end.c);
    if judge.wants(3) {
        let value = arithmetic.dot(&end.p, &n1);
        judge.judge(arithmetic, 3, &value, |_| n1)?;
    }
    if !(judge.wants(1) || judge.wants(2)) {
        return ControlFlow::Continue(());
    }
    let (one_part, other_part) = (arithmetic.cross(&start.b, &end.c), arithmetic.cross(&end.b, &start.c));
    let h = arithmetic.sum(&one_part, &other_part);
    if judge.wants(1) {
        let (of_h, of_n0) = (arithmetic.dot(&start.p, &h), arithmetic.dot(&end.p, &n0));
        let value = arithmetic.sum_of_three(&of_h, &of_n0);
        judge.judge(arithmetic, 1, &value, |arithmetic| arithmetic.sum(&n0, &h))?;
    }
    if judge.wants(2) {
        let (of_h, of_n1) = (arithmetic.dot(&end.p, &h), arithmetic.dot(&start.p, &n1));
        let value = arithmetic.sum_of_three(&of_h, &of_n1);
        judge.judge(arithmetic, 2, &value, |arithmetic| arithmetic.sum(&h, &n1))?;
    }
    ControlFlow::Continue(())
}

/// Collects the control values.
struct Noted<T>([T; 4]);

impl<A: Arithmetic> Judge<A> for Noted<A::Three> {
    #[inline(always)]
    fn wants(&self, _: usize) -> bool {
        true
    }

    #[inline(always)]
    fn judge(&mut self, _: &mut A, index: usize, value: &A::Three, _: impl FnOnce(&mut A) -> [A::Two; 3]) -> ControlFlow<()> {
        if let Some(noted) = self.0.get_mut(index) {
            *noted = *value;
        }
        ControlFlow::Continue(())
    }
}

/// Returns the control values k₀, 3k₁, 3k₂, k₃.
#[inline(never)]
pub(super) fn control_values<A: Arithmetic>(kind: PairKind, coordinates: &[[A::One; 8]; 3], arithmetic: &mut A) -> [A::Three; 4] {
    let mut values = Noted([A::Three::ZERO; 4]);
    // `Noted` never stops early.
    let _ = judge(kind, coordinates, arithmetic, &mut values);
    values.0
}

#[cfg(test)]
mod tests {
    use super::bits_in;

    /// The smallest sufficient width is taken, since a larger one would take longer.
    #[test]
    fn a_width_serves_for_all_its_bits_but_the_head_room() {
        assert_eq!([bits_in::<1>(), bits_in::<2>(), bits_in::<5>()], [61, 125, 317]);
    }
}
