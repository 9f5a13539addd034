use super::limbs::{sign_word, without_repeated_sign, without_zeros_below};
use core::cmp::Ordering;

pub(in crate::kernels::exact) trait Whole: Copy {
    const ZERO: Self;

    fn words(&self) -> Words<'_>;

    #[inline(always)]
    fn sign(&self) -> Ordering {
        self.words().sign()
    }
}

/// A whole number as its words, without those above that only repeat the sign: zero has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::kernels::exact) struct Words<'a>(pub(in crate::kernels::exact) &'a [u64]);

impl Whole for Words<'_> {
    const ZERO: Self = Self(&[]);

    #[inline(always)]
    fn words(&self) -> Words<'_> {
        *self
    }
}

impl<'a> Words<'a> {
    #[inline(always)]
    pub(super) fn new(words: &'a [u64]) -> Self {
        Self(without_repeated_sign(words))
    }

    #[inline(always)]
    pub(in crate::kernels::exact) fn sign(self) -> Ordering {
        match self.0.last() {
            None => Ordering::Equal,
            Some(&top) if top.cast_signed() < 0 => Ordering::Less,
            Some(_) => Ordering::Greater,
        }
    }

    /// Returns the number, if it has at most one word.
    #[inline(always)]
    pub(super) const fn single(self) -> Option<i128> {
        match *self.0 {
            [] => Some(0),
            [word] => Some(word.cast_signed() as i128),
            _ => None,
        }
    }

    /// Returns the number, if it has at most two words.
    #[inline(always)]
    pub(super) const fn small(self) -> Option<i128> {
        match *self.0 {
            [low, high] => Some(((high as u128) << 64 | low as u128).cast_signed()),
            _ => self.single(),
        }
    }

    #[inline(always)]
    pub(in crate::kernels::exact) const fn is_zero(self) -> bool {
        self.0.is_empty()
    }

    /// Returns the least number of bits b beside the sign: the number is in [−2ᵇ, 2ᵇ).
    #[inline(always)]
    pub(in crate::kernels::exact) fn bits(self) -> u32 {
        match self.0.last() {
            Some(top) => 64 * self.0.len() as u32 - (top ^ sign_word(self.0)).leading_zeros(),
            None => 0,
        }
    }

    /// Returns the number of lowest bits that are zero; 0 for zero.
    #[inline(always)]
    pub(in crate::kernels::exact) fn trailing_zeros(self) -> u32 {
        let (zeros, above) = without_zeros_below(self.0);
        64 * zeros as u32 + above.first().map_or(0, |word| word.trailing_zeros())
    }

    /// Returns the lowest word of the number divided by 2^`dropped`, rounded down.
    #[inline(always)]
    pub(in crate::kernels::exact) fn word_above(self, dropped: u32) -> u64 {
        let (sign, first) = (sign_word(self.0), (dropped / 64) as usize);
        let word = |index| self.0.get(index).copied().unwrap_or(sign);
        ((u128::from(word(first + 1)) << 64 | u128::from(word(first))) >> (dropped % 64)) as u64
    }
}
