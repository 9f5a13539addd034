//! Whole numbers of a fixed width.

use core::cmp::Ordering;

/// A whole number of `N` words in two's complement, the lowest word first.
///
/// Every result is taken modulo 2^(64·N): it is the exact one where that fits, which is for
/// [`kernel`](super::kernel) to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Integer<const N: usize>([u64; N]);

/// The magnitude of a number as its two leading words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Leading {
    /// At least 2⁶⁴ unless all of the number is here.
    pub(super) words: u128,
    /// How many bits follow.
    pub(super) followed_by: i32,
    /// Whether any of those is set.
    pub(super) is_cut: bool,
}

impl<const N: usize> Integer<N> {
    /// `significand` · 2^`shift`.
    #[inline(always)]
    pub(super) fn shifted(significand: i64, shift: u32) -> Self {
        let (first, within) = ((shift / 64) as usize, shift % 64);
        let wide = i128::from(significand) << within;
        let (low, high) = (wide as u64, (wide >> 64) as u64);
        let sign = (significand >> 63) as u64;
        let mut words = [0; N];
        for (i, word) in words.iter_mut().enumerate() {
            *word = if i < first {
                0
            } else if i == first {
                low
            } else if i == first + 1 {
                high
            } else {
                sign
            };
        }
        Self(words)
    }

    #[inline(always)]
    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut sum = self.0;
        let mut carry = false;
        for (word, &added) in sum.iter_mut().zip(&other.0) {
            let (partial, first) = word.overflowing_add(added);
            let (whole, second) = partial.overflowing_add(carry.into());
            (*word, carry) = (whole, first | second);
        }
        Self(sum)
    }

    #[inline(always)]
    pub(super) fn minus(&self, other: &Self) -> Self {
        let mut difference = self.0;
        subtract(difference.iter_mut(), &other.0, u64::MAX);
        Self(difference)
    }

    /// The exact product.
    #[inline(always)]
    pub(super) fn times<const M: usize, const R: usize>(&self, other: &Integer<M>) -> Integer<R> {
        const { assert!(R == N + M, "a product has the words of both factors") };
        let mut product = [0; R];
        for (i, &x) in self.0.iter().enumerate() {
            let mut row = product.iter_mut().skip(i);
            let mut carry = 0;
            for (&y, word) in other.0.iter().zip(row.by_ref()) {
                // (2⁶⁴ − 1)² + 2·(2⁶⁴ − 1) = 2¹²⁸ − 1.
                let sum = u128::from(x) * u128::from(y) + u128::from(*word) + u128::from(carry);
                (*word, carry) = (sum as u64, (sum >> 64) as u64);
            }
            if let Some(word) = row.next() {
                *word = carry;
            }
        }
        // That read a negative factor −x as 2^(64·N) − x, which is the other factor times 2^(64·N) too much.
        subtract(product.iter_mut().skip(N), &other.0, self.sign_word());
        subtract(product.iter_mut().skip(M), &self.0, other.sign_word());
        Integer(product)
    }

    /// All ones if negative, else zero.
    #[inline(always)]
    fn sign_word(&self) -> u64 {
        let top = self.0.last().copied().unwrap_or(0);
        (top.cast_signed() >> 63).cast_unsigned()
    }

    /// How the number compares with zero.
    #[inline(always)]
    pub(super) fn sign(&self) -> Ordering {
        if self.sign_word() != 0 {
            return Ordering::Less;
        }
        let bits = self.0.iter().fold(0, |bits, word| bits | word);
        bits.cmp(&0)
    }

    /// The leading words of the magnitude.
    #[inline]
    pub(super) fn leading(&self) -> Leading {
        let mut magnitude = self.0;
        if self.sign_word() != 0 {
            magnitude = [0; N];
            subtract(magnitude.iter_mut(), &self.0, u64::MAX);
        }
        let mut words = magnitude
            .iter()
            .rev()
            .copied()
            .skip_while(|&word| word == 0);
        let high = words.next().unwrap_or(0);
        let Some(low) = words.next() else {
            return Leading {
                words: high.into(),
                followed_by: 0,
                is_cut: false,
            };
        };
        let (mut followed_by, mut rest) = (0, 0);
        for word in words {
            followed_by += 64;
            rest |= word;
        }
        Leading {
            words: u128::from(high) << 64 | u128::from(low),
            followed_by,
            is_cut: rest != 0,
        }
    }
}

/// Subtracts `other`, each word masked by `mask`, from the words `from`; a borrow beyond the last is dropped.
#[inline(always)]
fn subtract<'a>(from: impl Iterator<Item = &'a mut u64>, other: &[u64], mask: u64) {
    let mut borrow = false;
    for (&subtracted, word) in other.iter().zip(from) {
        let (partial, first) = word.overflowing_sub(subtracted & mask);
        let (whole, second) = partial.overflowing_sub(borrow.into());
        (*word, borrow) = (whole, first | second);
    }
}
