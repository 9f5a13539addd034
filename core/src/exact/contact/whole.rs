//! Whole numbers of no more words than they need, up to a capacity.

use crate::exact::integer::{Integer, add_with_carry, subtract_with_borrow};
use core::cmp::Ordering;

/// A whole number of at most `C` words: sign and magnitude.
///
/// Where sums and products are longer than their capacity, what is beyond is lost; that nothing is, is for the callers to show.
/// Work goes with the words in use, not with the capacity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Whole<const C: usize> {
    is_negative: bool,
    /// How many words are in use: the last of them is not zero. Zero has none, and is not negative.
    length: usize,
    /// The lowest first; zero from `length` on.
    words: [u64; C],
}

impl<const C: usize> Whole<C> {
    pub(super) const ZERO: Self = Self {
        is_negative: false,
        length: 0,
        words: [0; C],
    };

    /// The same number.
    #[inline(always)]
    pub(super) fn new<const N: usize>(integer: &Integer<N>) -> Self {
        let (is_negative, magnitude) = integer.sign_and_magnitude();
        let mut words = [0; C];
        for (word, digit) in words.iter_mut().zip(magnitude) {
            *word = digit;
        }
        Self::trimmed(is_negative, words, N)
    }

    /// With at most `length` words in use.
    #[inline(always)]
    fn trimmed(is_negative: bool, words: [u64; C], length: usize) -> Self {
        let mut length = length.min(C);
        while let Some(last) = length.checked_sub(1)
            && words.get(last) == Some(&0)
        {
            length = last;
        }
        Self {
            is_negative: is_negative && length > 0,
            length,
            words,
        }
    }

    /// The same number, with another capacity.
    #[inline(always)]
    pub(super) fn widened<const R: usize>(&self) -> Whole<R> {
        let mut words = [0; R];
        for (word, &digit) in words.iter_mut().zip(self.digits()) {
            *word = digit;
        }
        Whole::trimmed(self.is_negative, words, self.length)
    }

    #[inline(always)]
    fn digits(&self) -> &[u64] {
        self.words.get(..self.length).unwrap_or_default()
    }

    /// The least number of bits that hold the magnitude.
    #[inline(always)]
    pub(super) fn bits(&self) -> u32 {
        match self.digits().split_last() {
            Some((last, below)) => 64 * below.len() as u32 + 64 - last.leading_zeros(),
            None => 0,
        }
    }

    /// The lowest word of the magnitude without its lowest `dropped` bits.
    #[inline(always)]
    pub(super) fn magnitude_without(&self, dropped: u32) -> u64 {
        let mut words = self.digits().iter().skip((dropped / 64) as usize).copied();
        let (low, high) = (words.next().unwrap_or(0), words.next().unwrap_or(0));
        ((u128::from(high) << 64 | u128::from(low)) >> (dropped % 64)) as u64
    }

    /// How the number compares with zero.
    #[inline(always)]
    pub(super) const fn sign(&self) -> Ordering {
        match (self.length, self.is_negative) {
            (0, _) => Ordering::Equal,
            (_, true) => Ordering::Less,
            (_, false) => Ordering::Greater,
        }
    }

    #[inline(always)]
    pub(super) const fn is_zero(&self) -> bool {
        self.length == 0
    }

    #[inline(always)]
    pub(super) fn negated(mut self) -> Self {
        self.is_negative = !self.is_negative && self.length > 0;
        self
    }

    #[inline(always)]
    pub(super) fn plus<const M: usize, const R: usize>(&self, other: &Whole<M>) -> Whole<R> {
        self.sum(other, other.is_negative)
    }

    #[inline(always)]
    pub(super) fn minus<const M: usize, const R: usize>(&self, other: &Whole<M>) -> Whole<R> {
        self.sum(other, !other.is_negative)
    }

    /// The sum with a number of the other's magnitude.
    fn sum<const M: usize, const R: usize>(&self, other: &Whole<M>, other_is_negative: bool) -> Whole<R> {
        let (a, b) = (self.digits(), other.digits());
        let order = compare(a, b);
        let (larger, smaller, is_negative) = if order.is_ge() {
            (a, b, self.is_negative)
        } else {
            (b, a, other_is_negative)
        };
        if self.is_negative == other_is_negative {
            sum_of_magnitudes(larger, smaller, is_negative)
        } else {
            difference_of_magnitudes(larger, smaller, is_negative)
        }
    }

    pub(super) fn times<const M: usize, const R: usize>(&self, other: &Whole<M>) -> Whole<R> {
        let (a, b) = (self.digits(), other.digits());
        let mut words = [0; R];
        for (i, &x) in a.iter().enumerate() {
            let Some((row, above)) = words.get_mut(i..).and_then(|words| words.split_at_mut_checked(b.len())) else {
                break;
            };
            let mut carry = 0;
            for (&y, word) in b.iter().zip(row) {
                // (2⁶⁴ − 1)² + 2·(2⁶⁴ − 1) = 2¹²⁸ − 1.
                let sum = u128::from(x) * u128::from(y) + u128::from(*word) + u128::from(carry);
                (*word, carry) = (sum as u64, (sum >> 64) as u64);
            }
            if let Some(word) = above.first_mut() {
                *word = carry;
            }
        }
        Whole::trimmed(self.is_negative != other.is_negative, words, a.len() + b.len())
    }

    /// The product with a small number that is not negative.
    #[inline(always)]
    pub(super) fn times_small<const R: usize>(&self, factor: u8) -> Whole<R> {
        let mut words = [0; R];
        let mut carry = 0;
        let (digits, factor) = (self.digits(), u128::from(factor));
        // One digit more, for the last carry.
        for (word, &digit) in words.iter_mut().zip(digits.iter().chain(&[0])) {
            let sum = u128::from(digit) * factor + u128::from(carry);
            (*word, carry) = (sum as u64, (sum >> 64) as u64);
        }
        Whole::trimmed(self.is_negative, words, digits.len() + 1)
    }
}

/// Compares magnitudes whose last words are not zero.
#[inline(always)]
fn compare(a: &[u64], b: &[u64]) -> Ordering {
    a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev()))
}

#[inline(always)]
fn sum_of_magnitudes<const R: usize>(larger: &[u64], smaller: &[u64], is_negative: bool) -> Whole<R> {
    let mut words = [0; R];
    let mut carry = false;
    let digits = larger.iter().chain(&[0]);
    let others = smaller.iter().chain(core::iter::repeat(&0));
    for ((word, &x), &y) in words.iter_mut().zip(digits).zip(others) {
        (*word, carry) = add_with_carry(x, y, carry);
    }
    Whole::trimmed(is_negative, words, larger.len() + 1)
}

#[inline(always)]
fn difference_of_magnitudes<const R: usize>(larger: &[u64], smaller: &[u64], is_negative: bool) -> Whole<R> {
    let mut words = [0; R];
    let mut borrow = false;
    let others = smaller.iter().chain(core::iter::repeat(&0));
    for ((word, &x), &y) in words.iter_mut().zip(larger).zip(others) {
        (*word, borrow) = subtract_with_borrow(x, y, borrow);
    }
    Whole::trimmed(is_negative, words, larger.len())
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::Whole;
    use crate::exact::integer::Integer;
    use std::format;

    /// Where carries, lengths and signs go wrong.
    const NUMBERS: [i128; 15] = [
        0,
        1,
        -1,
        3,
        -3,
        u64::MAX as i128,
        -(u64::MAX as i128),
        1 << 64,
        -(1 << 64),
        (1 << 64) + 1,
        i64::MIN as i128,
        i128::MAX >> 2,
        -(i128::MAX >> 2),
        (i128::MAX >> 2) - 1,
        0x0123_4567_89ab_cdef_0edc_ba98_7654_3210,
    ];

    fn whole(number: i128) -> Whole<4> {
        let magnitude = number.unsigned_abs();
        let words = [magnitude as u64, (magnitude >> 64) as u64, 0, 0];
        Whole::trimmed(number < 0, words, 2)
    }

    fn assert_same<const A: usize, const B: usize>(a: &Whole<A>, b: &Whole<B>, what: &str) {
        assert_eq!(a.digits(), b.digits(), "{what}");
        assert_eq!(a.sign(), b.sign(), "{what}");
    }

    #[test]
    fn sums_differences_and_signs_are_those_of_the_built_in_type() {
        for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
            let (x, y) = (whole(a), whole(b));
            assert_same::<3, 4>(&x.plus(&y), &whole(a + b), &format!("{a} + {b}"));
            assert_same::<3, 4>(&x.minus(&y), &whole(a - b), &format!("{a} - {b}"));
            assert_eq!(x.sign(), a.cmp(&0), "{a}");
            assert_same(&x.negated(), &whole(-a), &format!("-{a}"));
            assert_same::<3, 4>(&whole(a / 6).times_small(6), &whole(a / 6 * 6), &format!("6 · {}", a / 6));
        }
    }

    #[test]
    fn zero_is_not_negative() {
        assert!(!Whole::<4>::ZERO.negated().is_negative);
        assert!(!Whole::<4>::trimmed(true, [0; 4], 4).is_negative);
    }

    #[test]
    fn the_lowest_word_of_what_is_left_is_that_of_the_shifted_magnitude() {
        let number = 0x0123_4567_89ab_cdef_0edc_ba98_7654_3210_i128;
        for dropped in (0..128).step_by(3) {
            let expected = (number >> dropped) as u64;
            assert_eq!(whole(number).magnitude_without(dropped), expected, "{dropped}");
        }
    }

    #[test]
    fn products_are_distributive_and_those_of_the_built_in_type_where_it_reaches() {
        for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
            let product: Whole<4> = whole(a).times(&whole(b));
            if let Some(expected) = a.checked_mul(b) {
                assert_same(&product, &whole(expected), &format!("{a} · {b}"));
            }
            for c in NUMBERS {
                let (left, right): (Whole<5>, Whole<5>) = (whole(a).times(&whole(b)), whole(a).times(&whole(c)));
                let sum: Whole<3> = whole(b).plus(&whole(c));
                let product: Whole<5> = whole(a).times(&sum);
                assert_same::<5, 5>(&product, &left.plus(&right), &format!("{a} · ({b} + {c})"));
            }
        }
    }

    #[test]
    fn an_integer_stays_the_same_number() {
        for significand in [0, 1, -1, i64::MAX, i64::MIN] {
            for shift in [0, 1, 63, 64, 100] {
                let number: Whole<4> = Whole::new(&Integer::<3>::shifted(significand, shift));
                let mut expected = whole(significand.into());
                for _ in 0..shift {
                    expected = expected.times_small(2);
                }
                assert_same(&number, &expected, &format!("{significand} · 2^{shift}"));
            }
        }
    }
}
