//! Whole numbers in two's complement, the lowest word first.
//!
//! [`Integer`] is an array, for widths that the compiler knows: the fastest form for a few words. [`Words`] is a slice of as many
//! words as the number needs, out of one [`Space`].

#[cfg(test)]
mod all_tiny_numbers;
mod limbs;
mod space;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tiny;
mod words;

pub(super) use space::Space;
pub(super) use words::{Whole, Words};

use core::cmp::Ordering;
use limbs::{add, multiply, multiply_significant_words, sign_word, subtract, write_shifted};

/// A whole number of `N` words.
///
/// Every result is taken modulo 2^(64·words). It is exact if it fits, which [`kernel`](super::kernel) shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Integer<const N: usize>(pub(super) [u64; N]);

impl<const N: usize> Integer<N> {
    #[inline(always)]
    pub(super) fn shifted(significand: i64, shift: u32) -> Self {
        if N == 1 {
            // This gives the same result with less work.
            return Self([(significand << (shift % 64)).cast_unsigned(); N]);
        }
        let mut words = [0; N];
        write_shifted(&mut words, significand, shift);
        Self(words)
    }

    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut sum = self.0;
        add(&mut sum, &other.0);
        Self(sum)
    }

    #[inline(always)]
    pub(super) fn minus(&self, other: &Self) -> Self {
        let mut difference = self.0;
        subtract(&mut difference, &other.0, u64::MAX);
        Self(difference)
    }

    /// Returns the product, in as many words as both factors have.
    #[inline(always)]
    pub(super) fn times<const M: usize, const R: usize>(&self, other: &Integer<M>) -> Integer<R> {
        const { assert!(R == N + M, "a product has the words of both factors") };
        let mut product = [0; R];
        match (self.0.as_slice(), other.0.as_slice(), product.as_mut_slice()) {
            (&[a], &[b], [low, high]) => {
                let product = i128::from(a.cast_signed()) * i128::from(b.cast_signed());
                (*low, *high) = (product as u64, (product >> 64) as u64);
            }
            (&[a], &[b0, b1], [low, middle, high]) => {
                let a = i128::from(a.cast_signed());
                let below = a * i128::from(b0);
                let above = a * i128::from(b1.cast_signed()) + (below >> 64);
                (*low, *middle, *high) = (below as u64, above as u64, (above >> 64) as u64);
            }
            // Inline code is faster for a few words; for many it would only be larger.
            (a, b, product) if N > 2 => multiply_significant_words(a, b, product),
            (a, b, product) => {
                multiply(a, b, product);
                subtract(product.get_mut(N..).unwrap_or_default(), b, sign_word(a));
                subtract(product.get_mut(M..).unwrap_or_default(), a, sign_word(b));
            }
        }
        Integer(product)
    }
}

impl<const N: usize> Whole for Integer<N> {
    const ZERO: Self = Self([0; N]);

    #[inline(always)]
    fn words(&self) -> Words<'_> {
        Words::new(&self.0)
    }

    #[inline(always)]
    fn sign(&self) -> Ordering {
        if sign_word(&self.0) != 0 {
            return Ordering::Less;
        }
        let bits = self.0.iter().fold(0, |bits, word| bits | word);
        bits.cmp(&0)
    }
}
