//! Words of a few bits. Of these, all numbers can be tried.

use super::limbs::Word;
use core::ops::{BitAnd, BitOr, BitXor};

/// A word of `BITS` bits, at most four.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Tiny<const BITS: u32>(pub(super) u8);

impl<const BITS: u32> Tiny<BITS> {
    pub(super) const SIZE: u8 = 1 << BITS;

    const fn halves(number: u8) -> (Self, Self) {
        (Self(number % Self::SIZE), Self(number / Self::SIZE))
    }
}

impl<const BITS: u32> BitAnd for Tiny<BITS> {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

impl<const BITS: u32> BitOr for Tiny<BITS> {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl<const BITS: u32> BitXor for Tiny<BITS> {
    type Output = Self;
    fn bitxor(self, other: Self) -> Self {
        Self(self.0 ^ other.0)
    }
}

impl<const BITS: u32> Word for Tiny<BITS> {
    const ZERO: Self = Self(0);
    const ONES: Self = Self(Self::SIZE - 1);

    fn overflowing_add(self, other: Self) -> (Self, bool) {
        let (low, high) = Self::halves(self.0 + other.0);
        (low, high.0 != 0)
    }

    fn overflowing_sub(self, other: Self) -> (Self, bool) {
        (Self::halves(Self::SIZE + self.0 - other.0).0, self.0 < other.0)
    }

    fn from_carry(carry: bool) -> Self {
        Self(carry.into())
    }

    fn multiply_add(self, factor: Self, word: Self, carry: Self) -> (Self, Self) {
        Self::halves(self.0 * factor.0 + word.0 + carry.0)
    }

    fn repeated_top(self) -> Self {
        if self.0 < Self::SIZE / 2 { Self::ZERO } else { Self::ONES }
    }
}
