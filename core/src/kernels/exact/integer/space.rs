use super::limbs::{multiply_significant_words, write_sum};
use super::words::{Whole, Words};
use core::mem;

/// Space for numbers. Each number keeps its words as long as the space lives; only [`scratch`](Self::scratch) gives words back.
///
/// The module `contact` shows that there is enough.
#[derive(Debug)]
pub(in crate::kernels::exact) struct Space<'a>(&'a mut [u64]);

impl<'a> Space<'a> {
    pub(in crate::kernels::exact) const fn new(words: &'a mut [u64]) -> Self {
        Self(words)
    }

    /// Returns the remaining space, for as long as the borrow lasts.
    #[inline(always)]
    pub(in crate::kernels::exact) const fn scratch(&mut self) -> Space<'_> {
        Space(self.0)
    }

    #[inline(always)]
    fn take(&mut self, length: usize) -> &'a mut [u64] {
        debug_assert!(length <= self.0.len(), "there is enough space");
        let (taken, rest) = mem::take(&mut self.0).split_at_mut_checked(length).unwrap_or_default();
        self.0 = rest;
        taken
    }

    /// Returns `significand` · 2^`shift`. Zero needs no space.
    #[inline(never)]
    pub(in crate::kernels::exact) fn shifted(&mut self, significand: i64, shift: u32) -> Words<'a> {
        if significand == 0 {
            return Words::ZERO;
        }
        let words = self.take((shift / 64) as usize + 2);
        let wide = i128::from(significand) << (shift % 64);
        if let [zeros @ .., low, high] = words {
            zeros.fill(0);
            (*low, *high) = (wide as u64, (wide >> 64) as u64);
        }
        Words::new(words)
    }

    #[inline(always)]
    fn double(&mut self, number: i128) -> Words<'a> {
        let words = self.take(2);
        if let [low, high] = words {
            (*low, *high) = (number as u64, (number >> 64) as u64);
        }
        let length = if number == 0 {
            0
        } else if number == i128::from(number as i64) {
            1
        } else {
            2
        };
        Words(words.get(..length).unwrap_or_default())
    }

    #[inline(never)]
    pub(in crate::kernels::exact) fn plus(&mut self, a: Words<'_>, b: Words<'_>) -> Words<'a> {
        match a.small().zip(b.small()).and_then(|(a, b)| a.checked_add(b)) {
            Some(sum) => self.double(sum),
            None => self.sum(a.0, b.0, 0),
        }
    }

    #[inline(never)]
    pub(in crate::kernels::exact) fn minus(&mut self, a: Words<'_>, b: Words<'_>) -> Words<'a> {
        match a.small().zip(b.small()).and_then(|(a, b)| a.checked_sub(b)) {
            Some(difference) => self.double(difference),
            None => self.sum(a.0, b.0, u64::MAX),
        }
    }

    pub(in crate::kernels::exact) fn negated(&mut self, a: Words<'_>) -> Words<'a> {
        self.minus(Words::ZERO, a)
    }

    pub(in crate::kernels::exact) fn doubled(&mut self, a: Words<'_>) -> Words<'a> {
        self.plus(a, a)
    }

    pub(in crate::kernels::exact) fn tripled(&mut self, a: Words<'_>) -> Words<'a> {
        let doubled = self.doubled(a);
        self.plus(doubled, a)
    }

    /// Returns a + b, or, with all ones for `mask`, a − b.
    #[inline(always)]
    fn sum(&mut self, a: &[u64], b: &[u64], mask: u64) -> Words<'a> {
        let words = self.take(a.len().max(b.len()) + 1);
        write_sum(a, b, mask, words);
        Words::new(words)
    }

    #[inline(never)]
    pub(in crate::kernels::exact) fn times(&mut self, a: Words<'_>, b: Words<'_>) -> Words<'a> {
        match (a.0, b.0) {
            ([], _) | (_, []) => return Words::ZERO,
            (&[a], &[b]) => return self.double(i128::from(a.cast_signed()) * i128::from(b.cast_signed())),
            _ => {}
        }
        let words = self.take(a.0.len() + b.0.len());
        multiply_significant_words(a.0, b.0, words);
        Words::new(words)
    }

    #[inline(never)]
    pub(in crate::kernels::exact) fn sum_of_products(&mut self, products: [[Words<'_>; 2]; 3]) -> Words<'a> {
        let length = products.iter().map(|[a, b]| a.0.len() + b.0.len()).max().unwrap_or(0);
        let words = self.take(length + 2);
        let mut scratch = self.scratch();
        let [x, y, z] = products.map(|[a, b]| scratch.times(a, b));
        let sum = scratch.plus(x, y);
        Space(words).plus(sum, z)
    }

    /// Returns a·d − b·c.
    #[inline(never)]
    pub(in crate::kernels::exact) fn minor(&mut self, a: Words<'_>, b: Words<'_>, c: Words<'_>, d: Words<'_>) -> Words<'a> {
        if let (Some(a), Some(b), Some(c), Some(d)) = (a.single(), b.single(), c.single(), d.single()) {
            // The result is less than 2¹²⁶ + 2¹²⁶: both products are at most 2¹²⁶, and none is −2¹²⁶.
            return self.double(a * d - b * c);
        }
        let words = self.take((a.0.len() + d.0.len()).max(b.0.len() + c.0.len()) + 1);
        let mut scratch = self.scratch();
        let (x, y) = (scratch.times(a, d), scratch.times(b, c));
        Space(words).minus(x, y)
    }
}
