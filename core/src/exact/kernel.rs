//! The control values of the signed volume as whole numbers of three times the coordinates' width.
//!
//! # Head-room
//! Coordinates of at most 64·N − 3 bits and a sign differ by less than 2ᵐ, m = 64·N − 2. Components of n₀ and n₁ are
//! then below 2·2²ᵐ, those of h below 4·2²ᵐ, those of n₀ + h and h + n₁ below 6·2²ᵐ < 2^(2m+3): with a sign 128·N
//! bits. k₀ and k₃ are below 6·2³ᵐ, 3k₁ and 3k₂ below 3·4·2³ᵐ + 3·2·2³ᵐ = 18·2³ᵐ < 2^(3m+5): with a sign 192·N bits.
//! So nothing overflows in 2·N and 3·N words.

use super::aligned::{AlignedPair, Edges, Units};
use super::integer::Integer;
use core::ops::ControlFlow;

/// The widest coordinates for which `N` words serve.
const fn bits_in<const N: usize>() -> u32 {
    64 * N as u32 - 3
}

/// How many words a coordinate has.
#[derive(Clone, Copy, Debug)]
pub(super) enum Width {
    Words1,
    Words2,
    Words5,
    Words33,
}

impl Width {
    /// The narrowest that serves.
    #[inline(always)]
    pub(super) fn of(pair: &AlignedPair) -> Self {
        // f64 ranges over 2,098 bits, f32 over 277.
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

/// What is to be done with the control values.
pub(super) trait Judge {
    /// Whether the control value of this index is to be computed.
    fn wants(&self, index: usize) -> bool;

    /// A control value, and the normal that bounds it as the module's documentation says: both tripled for the middle
    /// ones, whose indices are 1 and 2.
    fn judge<const N2: usize, const N3: usize>(
        &mut self,
        index: usize,
        value: &Integer<N3>,
        normal: impl FnOnce() -> [Integer<N2>; 3],
        units: Units,
    ) -> ControlFlow<()>;
}

/// Hands the control values to `judge`, the cheap ones first, until it breaks off.
#[inline(always)]
pub(super) fn judge(pair: &AlignedPair, judge: &mut impl Judge) -> ControlFlow<()> {
    match Width::of(pair) {
        Width::Words1 => in_words::<1, 2, 3>(pair, judge),
        Width::Words2 => in_words::<2, 4, 6>(pair, judge),
        Width::Words5 => in_words::<5, 10, 15>(pair, judge),
        Width::Words33 => in_words::<33, 66, 99>(pair, judge),
    }
}

/// The same with coordinates of `N` words; `N2` = 2·`N`, `N3` = 3·`N`.
///
/// Out of line, so that a call pays for the stack of its own width only.
#[inline(never)]
pub(super) fn in_words<const N: usize, const N2: usize, const N3: usize>(
    pair: &AlignedPair,
    judge: &mut impl Judge,
) -> ControlFlow<()> {
    let units = pair.units;
    let [start, end]: [Edges<N>; 2] = pair.edges();
    let n0 = cross::<N, N2>(&start.b, &start.c);
    if judge.wants(0) {
        judge.judge(0, &dot::<N, N2, N3>(&start.p, &n0), || n0, units)?;
    }
    let n1 = cross::<N, N2>(&end.b, &end.c);
    if judge.wants(3) {
        judge.judge(3, &dot::<N, N2, N3>(&end.p, &n1), || n1, units)?;
    }
    if !(judge.wants(1) || judge.wants(2)) {
        return ControlFlow::Continue(());
    }
    let h = sum(&cross::<N, N2>(&start.b, &end.c), &cross(&end.b, &start.c));
    if judge.wants(1) {
        let value = dot::<N, N2, N3>(&start.p, &h).plus(&dot(&end.p, &n0));
        judge.judge(1, &value, || sum(&n0, &h), units)?;
    }
    if judge.wants(2) {
        let value = dot::<N, N2, N3>(&end.p, &h).plus(&dot(&start.p, &n1));
        judge.judge(2, &value, || sum(&h, &n1), units)?;
    }
    ControlFlow::Continue(())
}

#[inline(always)]
fn cross<const N: usize, const N2: usize>([ax, ay, az]: &[Integer<N>; 3], [bx, by, bz]: &[Integer<N>; 3]) -> [Integer<N2>; 3] {
    [
        ay.times(bz).minus(&az.times(by)),
        az.times(bx).minus(&ax.times(bz)),
        ax.times(by).minus(&ay.times(bx)),
    ]
}

#[inline(always)]
fn dot<const N: usize, const N2: usize, const N3: usize>(
    [ax, ay, az]: &[Integer<N>; 3],
    [bx, by, bz]: &[Integer<N2>; 3],
) -> Integer<N3> {
    ax.times(bx).plus(&ay.times(by)).plus(&az.times(bz))
}

#[inline(always)]
fn sum<const N: usize>([ax, ay, az]: &[Integer<N>; 3], [bx, by, bz]: &[Integer<N>; 3]) -> [Integer<N>; 3] {
    [ax.plus(bx), ay.plus(by), az.plus(bz)]
}

#[cfg(test)]
mod tests {
    use super::bits_in;

    /// The smallest width that serves is taken: more would only take longer.
    #[test]
    fn a_width_serves_for_all_its_bits_but_the_head_room() {
        assert_eq!([bits_in::<1>(), bits_in::<2>(), bits_in::<5>()], [61, 125, 317]);
    }
}
