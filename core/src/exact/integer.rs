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
    pub(super) const ZERO: Self = Self([0; N]);

    /// `significand` · 2^`shift`.
    #[inline(always)]
    pub(super) fn shifted(significand: i64, shift: u32) -> Self {
        let (first, within) = ((shift / 64) as usize, shift % 64);
        if N == 1 {
            // The same, with less to do.
            return Self([(significand << within).cast_unsigned(); N]);
        }
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
            (*word, carry) = add_with_carry(*word, added, carry);
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
        // In line is faster for a few words; for many it would only be more code.
        if N <= 2 {
            self.product(other)
        } else if N + M < 10 {
            self.product_out_of_line(other)
        } else {
            self.product_of_significant_words(other)
        }
    }

    #[inline(never)]
    fn product_out_of_line<const M: usize, const R: usize>(&self, other: &Integer<M>) -> Integer<R> {
        self.product(other)
    }

    /// The same with less to do where most words are zero or mere sign: numbers have many words when one pair's coordinates
    /// differ in size by hundreds of powers of two, and then each of them has few words of its own.
    #[inline(never)]
    fn product_of_significant_words<const M: usize, const R: usize>(&self, other: &Integer<M>) -> Integer<R> {
        const { assert!(R == N + M, "a product has the words of both factors") };
        let (zeros_of_a, a) = self.significant_words();
        let (zeros_of_b, b) = other.significant_words();
        let mut product = [0; R];
        // All of these words exist, since R = N + M; so nothing is lost by the default.
        let (own, extension) = product
            .get_mut(zeros_of_a + zeros_of_b..)
            .and_then(|words| words.split_at_mut_checked(a.len() + b.len()))
            .unwrap_or_default();
        multiply_signed(a, b, own);
        extension.fill(sign_word(own));
        Integer(product)
    }

    /// How many low words are zero, and the others without those above that only repeat the sign.
    #[inline(always)]
    fn significant_words(&self) -> (usize, &[u64]) {
        let sign = self.sign_word();
        let mut words = self.0.as_slice();
        while let [rest @ .., below, top] = words
            && *top == sign
            && sign_word(&[*below]) == sign
        {
            words = words.get(..=rest.len()).unwrap_or_default();
        }
        let mut zeros = 0;
        while let [0, rest @ ..] = words {
            (zeros, words) = (zeros + 1, rest);
        }
        (zeros, words)
    }

    #[inline(always)]
    fn product<const M: usize, const R: usize>(&self, other: &Integer<M>) -> Integer<R> {
        const { assert!(R == N + M, "a product has the words of both factors") };
        let mut product = [0; R];
        multiply_signed(&self.0, &other.0, &mut product);
        Integer(product)
    }

    /// All ones if negative, else zero.
    #[inline(always)]
    fn sign_word(&self) -> u64 {
        sign_word(&self.0)
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

    /// Whether the number is negative, and the words of its magnitude, the lowest first.
    #[inline(always)]
    pub(super) fn sign_and_magnitude(&self) -> (bool, [u64; N]) {
        if self.sign_word() == 0 {
            return (false, self.0);
        }
        let mut magnitude = [0; N];
        subtract(magnitude.iter_mut(), &self.0, u64::MAX);
        (true, magnitude)
    }

    /// The leading words of the magnitude.
    #[inline]
    pub(super) fn leading(&self) -> Leading {
        let (_, magnitude) = self.sign_and_magnitude();
        let mut words = magnitude.iter().rev().copied().skip_while(|&word| word == 0);
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

/// x + y + `carry` without what the word cannot hold, and whether there is such. (The standard library's `carrying_add` is younger than
/// the oldest compiler we support.)
#[inline(always)]
pub(super) const fn add_with_carry(x: u64, y: u64, carry: bool) -> (u64, bool) {
    let (partial, first) = x.overflowing_add(y);
    let (whole, second) = partial.overflowing_add(carry as u64);
    (whole, first | second)
}

/// x − y − `borrow`, with 2⁶⁴ more where that is negative, and whether it is.
#[inline(always)]
pub(super) const fn subtract_with_borrow(x: u64, y: u64, borrow: bool) -> (u64, bool) {
    let (partial, first) = x.overflowing_sub(y);
    let (whole, second) = partial.overflowing_sub(borrow as u64);
    (whole, first | second)
}

/// All ones if the number of these words, the lowest first, is negative, else zero.
#[inline(always)]
fn sign_word(words: &[u64]) -> u64 {
    let top = words.last().copied().unwrap_or(0);
    (top.cast_signed() >> 63).cast_unsigned()
}

/// The product of two numbers by their words into `product`, which has the words of both and is zero.
#[inline(always)]
fn multiply_signed(a: &[u64], b: &[u64], product: &mut [u64]) {
    for (i, &x) in a.iter().enumerate() {
        // All of these words exist, so nothing is lost by the default.
        let (row, above) = product
            .get_mut(i..)
            .and_then(|words| words.split_at_mut_checked(b.len()))
            .unwrap_or_default();
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
    // That read a negative factor −x as 2^(64·words) − x, which is the other factor times 2^(64·words) too much.
    subtract(product.iter_mut().skip(a.len()), b, sign_word(a));
    subtract(product.iter_mut().skip(b.len()), a, sign_word(b));
}

/// Subtracts `other`, each word masked by `mask`, from the words `from`; a borrow beyond the last is dropped.
#[inline(always)]
fn subtract<'a>(from: impl Iterator<Item = &'a mut u64>, other: &[u64], mask: u64) {
    let mut borrow = false;
    for (&subtracted, word) in other.iter().zip(from) {
        (*word, borrow) = subtract_with_borrow(*word, subtracted & mask, borrow);
    }
}

#[cfg(test)]
mod tests {
    use super::{Integer, Leading};
    use core::cmp::Ordering;

    /// Where carries and signs go wrong.
    const NUMBERS: [i128; 13] = [
        0,
        1,
        -1,
        2,
        -2,
        u64::MAX as i128,
        -(u64::MAX as i128),
        1 << 64,
        -(1 << 64),
        i64::MIN as i128,
        i128::MAX,
        i128::MIN,
        0x0123_4567_89ab_cdef_fedc_ba98_7654_3210,
    ];

    fn integer(number: i128) -> Integer<2> {
        Integer([number as u64, (number >> 64) as u64])
    }

    fn shifted<const N: usize>(significand: i64, shift: u32) -> Integer<N> {
        Integer::shifted(significand, shift)
    }

    #[test]
    fn sums_differences_and_signs_are_those_of_the_built_in_type() {
        for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
            let (x, y) = (integer(a), integer(b));
            assert_eq!(x.plus(&y), integer(a.wrapping_add(b)), "{a} + {b}");
            assert_eq!(x.minus(&y), integer(a.wrapping_sub(b)), "{a} - {b}");
            assert_eq!(x.sign(), a.cmp(&0), "{a}");
        }
    }

    #[test]
    fn products_are_those_of_the_built_in_type() {
        for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
            let product: Integer<4> = integer(a).times(&integer(b));
            let Integer([low, high, ..]) = product;
            assert_eq!(Integer([low, high]), integer(a.wrapping_mul(b)), "{a} · {b}");
            // All of it for smaller numbers: below.
            let sign = a.signum() * b.signum();
            assert_eq!(product.sign(), sign.cmp(&0), "{a} · {b}");
        }
        // (2⁶⁴ − 1)·2¹⁰⁰ times −2¹²⁶, word by word.
        let a: Integer<3> = shifted::<3>(1, 164).minus(&shifted(1, 100));
        let product: Integer<5> = a.times(&shifted::<2>(-1, 126));
        assert_eq!(product, shifted::<5>(1, 226).minus(&shifted(1, 290)));
    }

    #[test]
    fn wide_products_of_shifted_numbers_are_shifted_products() {
        for (a, b) in [(3, 5), (-3, 5), (3, -5), (-3, -5), (i64::MAX, i64::MIN)] {
            for (i, j) in [(0, 0), (1, 63), (64, 65), (190, 120)] {
                let product: Integer<9> = shifted::<4>(a, i).times(&shifted::<5>(b, j));
                let Integer([low, high]) = integer(i128::from(a) * i128::from(b));
                let mut expected = Integer([0; 9]);
                for (word, part) in [(0, low & 0xffff_ffff), (32, low >> 32)] {
                    expected = expected.plus(&shifted(part.cast_signed(), i + j + word));
                }
                expected = expected.plus(&shifted(high.cast_signed(), i + j + 64));
                assert_eq!(product, expected, "{a} · 2^{i} times {b} · 2^{j}");
            }
        }
    }

    #[test]
    fn the_product_of_significant_words_is_the_product() {
        let for_each_number = |visit: &dyn Fn(&Integer<6>)| {
            visit(&Integer::ZERO);
            for significand in [1, -1, 3, -3, i64::MAX, i64::MIN] {
                for shift in [0, 1, 63, 64, 127, 128, 200, 256, 319, 320] {
                    let number = shifted(significand, shift);
                    visit(&number);
                    visit(&number.minus(&shifted(1, 0)));
                    visit(&number.plus(&shifted(significand, 7)));
                }
            }
        };
        for_each_number(&|a| {
            for_each_number(&|b| {
                let expected: Integer<12> = a.product(b);
                assert_eq!(a.product_of_significant_words(b), expected, "{a:?} · {b:?}");
            });
        });
    }

    #[test]
    fn leading_words_are_those_of_the_magnitude() {
        let leading = |words, followed_by, is_cut| Leading {
            words,
            followed_by,
            is_cut,
        };
        assert_eq!(shifted::<4>(0, 0).leading(), leading(0, 0, false));
        assert_eq!(shifted::<4>(-7, 0).leading(), leading(7, 0, false));
        assert_eq!(shifted::<4>(-7, 64).leading(), leading(7 << 64, 0, false));
        let long = shifted::<4>(-7, 192).minus(&shifted(1, 0));
        assert_eq!(long.leading(), leading(7 << 64, 128, true));
        assert_eq!(shifted::<4>(7, 192).leading(), leading(7 << 64, 128, false));
        assert_eq!(shifted::<4>(1, 0).sign(), Ordering::Greater);
    }
}
