//! Arithmetic on words, the lowest first.
//!
//! Each loop is written once for words of any size. The code has words of 64 bits; tests run all numbers of a few words of two
//! bits. `verification/proofs/Words.v` has the same loops, and proves them for words of any size.

use core::ops::{BitAnd, BitOr, BitXor};

/// A word of a number.
pub(super) trait Word: Copy + PartialEq + BitAnd<Output = Self> + BitOr<Output = Self> + BitXor<Output = Self> {
    const ZERO: Self;
    /// All bits are ones.
    const ONES: Self;

    /// Returns the sum modulo 2^bits, and whether it overflows.
    fn overflowing_add(self, other: Self) -> (Self, bool);
    /// Returns the difference modulo 2^bits, and whether it is negative.
    fn overflowing_sub(self, other: Self) -> (Self, bool);
    /// Returns one for a carry, otherwise zero.
    fn from_carry(carry: bool) -> Self;
    /// Returns the low and the high word of self · `factor` + `word` + `carry`, which two words always hold:
    /// (2⁶⁴ − 1)² + 2·(2⁶⁴ − 1) = 2¹²⁸ − 1.
    fn multiply_add(self, factor: Self, word: Self, carry: Self) -> (Self, Self);
    /// Returns all ones if the top bit is set, otherwise zero.
    fn repeated_top(self) -> Self;
}

impl Word for u64 {
    const ZERO: Self = 0;
    const ONES: Self = Self::MAX;

    #[inline(always)]
    fn overflowing_add(self, other: Self) -> (Self, bool) {
        self.overflowing_add(other)
    }

    #[inline(always)]
    fn overflowing_sub(self, other: Self) -> (Self, bool) {
        self.overflowing_sub(other)
    }

    #[inline(always)]
    fn from_carry(carry: bool) -> Self {
        carry.into()
    }

    #[inline(always)]
    fn multiply_add(self, factor: Self, word: Self, carry: Self) -> (Self, Self) {
        let sum = u128::from(self) * u128::from(factor) + u128::from(word) + u128::from(carry);
        (sum as Self, (sum >> 64) as Self)
    }

    #[inline(always)]
    fn repeated_top(self) -> Self {
        (self.cast_signed() >> 63).cast_unsigned()
    }
}

#[inline(always)]
pub(super) fn write_shifted(words: &mut [u64], significand: i64, shift: u32) {
    let (first, within) = ((shift / 64) as usize, shift % 64);
    let wide = i128::from(significand) << within;
    let (low, high) = (wide as u64, (wide >> 64) as u64);
    let sign = (significand >> 63) as u64;
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
}

/// Returns x + y + `carry` modulo 2^bits, and the carry. (The standard library's `carrying_add` is newer than the oldest
/// supported compiler.)
#[inline(always)]
pub(super) fn add_with_carry<W: Word>(x: W, y: W, carry: bool) -> (W, bool) {
    let (partial, first) = x.overflowing_add(y);
    let (whole, second) = partial.overflowing_add(W::from_carry(carry));
    (whole, first | second)
}

/// Returns x − y − `borrow` modulo 2^bits, and the borrow.
#[inline(always)]
pub(super) fn subtract_with_borrow<W: Word>(x: W, y: W, borrow: bool) -> (W, bool) {
    let (partial, first) = x.overflowing_sub(y);
    let (whole, second) = partial.overflowing_sub(W::from_carry(borrow));
    (whole, first | second)
}

/// Returns all ones if the number of these words is negative, otherwise zero.
#[inline(always)]
pub(super) fn sign_word<W: Word>(words: &[W]) -> W {
    words.last().copied().unwrap_or(W::ZERO).repeated_top()
}

/// Returns the words without those above that only repeat the sign.
#[inline(always)]
pub(super) fn without_repeated_sign<W: Word>(mut words: &[W]) -> &[W] {
    // Groups of eight come first: the compiler makes them a comparison of a few registers.
    while let Some((below, eight)) = words.split_last_chunk::<8>()
        && eight.iter().fold(W::ZERO, |bits, &word| bits | (word ^ sign_word(below))) == W::ZERO
    {
        words = below;
    }
    while let Some((&top, below)) = words.split_last()
        && top == sign_word(below)
    {
        words = below;
    }
    words
}

/// Returns the number of lowest words that are zero, and the other words.
#[inline(always)]
pub(super) fn without_zeros_below<W: Word>(words: &[W]) -> (usize, &[W]) {
    let zeros = words.iter().position(|&word| word != W::ZERO).unwrap_or(words.len());
    (zeros, words.get(zeros..).unwrap_or_default())
}

/// Adds `other` to the words `to`; a carry beyond the last is dropped.
#[inline(always)]
pub(super) fn add<W: Word>(to: &mut [W], other: &[W]) {
    let mut carry = false;
    for (word, &added) in to.iter_mut().zip(other) {
        (*word, carry) = add_with_carry(*word, added, carry);
    }
}

/// Subtracts `other`, each word masked by `mask`, from the words `from`; a borrow beyond the last is dropped.
#[inline(always)]
pub(super) fn subtract<W: Word>(from: &mut [W], other: &[W], mask: W) {
    let mut borrow = false;
    for (&subtracted, word) in other.iter().zip(from) {
        (*word, borrow) = subtract_with_borrow(*word, subtracted & mask, borrow);
    }
}

/// Writes a + b, or, with all ones for `mask`, a − b: a plus the complement of b, plus one. `words` has one more than the longer
/// of the two.
#[inline(always)]
pub(super) fn write_sum<W: Word>(a: &[W], b: &[W], mask: W, words: &mut [W]) {
    let ((long, long_mask), (short, short_mask)) = if a.len() >= b.len() {
        ((a, W::ZERO), (b, mask))
    } else {
        ((b, mask), (a, W::ZERO))
    };
    let mut carry = mask != W::ZERO;
    for ((sum, &x), &y) in words.iter_mut().zip(long).zip(short) {
        (*sum, carry) = add_with_carry(x ^ long_mask, y ^ short_mask, carry);
    }
    let sign_of_short = sign_word(short) ^ short_mask;
    if let (Some([above @ .., top]), Some(rest)) = (words.get_mut(short.len()..), long.get(short.len()..)) {
        for (sum, &x) in above.iter_mut().zip(rest) {
            (*sum, carry) = add_with_carry(x ^ long_mask, sign_of_short, carry);
        }
        *top = add_with_carry(sign_word(long) ^ long_mask, sign_of_short, carry).0;
    }
}

/// Writes the product of two numbers, read as unsigned, to `product`, which has the words of both.
///
/// A negative number −x is read as 2^(bits·words) − x, which adds the other factor times 2^(bits·words).
#[inline(always)]
pub(super) fn multiply<W: Word>(a: &[W], b: &[W], product: &mut [W]) {
    if let (Some((&x, _)), Some((row, above))) = (a.split_first(), product.split_at_mut_checked(b.len())) {
        let mut carry = W::ZERO;
        for (&y, word) in b.iter().zip(row) {
            (*word, carry) = x.multiply_add(y, W::ZERO, carry);
        }
        if let Some(word) = above.first_mut() {
            *word = carry;
        }
    }
    for (i, &x) in a.iter().enumerate().skip(1) {
        let (row, above) = product
            .get_mut(i..)
            .and_then(|words| words.split_at_mut_checked(b.len()))
            .unwrap_or_default();
        let mut carry = W::ZERO;
        for (&y, word) in b.iter().zip(row) {
            (*word, carry) = x.multiply_add(y, *word, carry);
        }
        if let Some(word) = above.first_mut() {
            *word = carry;
        }
    }
}

/// Writes the product of any two numbers to `product`, which has the words of both. It does less where most words are zero or
/// repeat the sign. Numbers have many words when one pair's coordinates differ in size by hundreds of powers of two, and then
/// each has few significant words.
#[inline(never)]
pub(super) fn multiply_significant_words<W: Word>(a: &[W], b: &[W], product: &mut [W]) {
    let (zeros_of_a, a) = without_zeros_below(without_repeated_sign(a));
    let (zeros_of_b, b) = without_zeros_below(without_repeated_sign(b));
    if a.is_empty() || b.is_empty() {
        return product.fill(W::ZERO);
    }
    let zeros = zeros_of_a + zeros_of_b;
    let (below, product) = product.split_at_mut_checked(zeros).unwrap_or_default();
    for word in below {
        *word = W::ZERO;
    }
    let (product, above) = product.split_at_mut_checked(a.len() + b.len()).unwrap_or_default();
    multiply(a, b, product);
    if sign_word(a) != W::ZERO {
        subtract(product.get_mut(a.len()..).unwrap_or_default(), b, W::ONES);
    }
    if sign_word(b) != W::ZERO {
        subtract(product.get_mut(b.len()..).unwrap_or_default(), a, W::ONES);
    }
    let sign = sign_word(product);
    for word in above {
        *word = sign;
    }
}
