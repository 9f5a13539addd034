//! Whole numbers of a fixed width.

use core::cmp::Ordering;

/// A whole number of `N` words in two's complement, the lowest word first.
///
/// Every result is taken modulo 2^(64·words): it is the exact one where that fits, which is for [`kernel`](super::kernel) and
/// `contact` to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Integer<const N: usize>([u64; N]);

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

    #[inline(always)]
    pub(super) fn negated(&self) -> Self {
        Self::ZERO.minus(self)
    }

    #[inline(always)]
    pub(super) fn doubled(&self) -> Self {
        self.plus(self)
    }

    /// The product, in any number of words.
    #[inline(always)]
    pub(super) fn times<const M: usize, const R: usize>(&self, other: &Integer<M>) -> Integer<R> {
        let mut product = [0; R];
        // In line is faster for a few words; for many it would only be more code.
        if N <= 2 {
            multiply(&self.0, &other.0, &mut product, R < N + M);
        } else {
            multiply_significant_words(&self.0, &other.0, &mut product);
        }
        Integer(product)
    }

    /// The same number in more words.
    #[inline(always)]
    pub(super) fn widened<const R: usize>(&self) -> Integer<R> {
        let mut words = [self.sign_word(); R];
        for (word, &own) in words.iter_mut().zip(&self.0) {
            *word = own;
        }
        Integer(words)
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

    #[inline(always)]
    pub(super) fn is_zero(&self) -> bool {
        self.sign().is_eq()
    }

    #[inline(always)]
    pub(super) fn magnitude(&self) -> Self {
        if self.sign().is_lt() { self.negated() } else { *self }
    }

    /// The least number of bits beside the sign: the number is in [−2ᵇ, 2ᵇ).
    #[inline(always)]
    pub(super) fn bits(&self) -> u32 {
        let words = without_repeated_sign(&self.0);
        match words.last() {
            Some(top) => 64 * words.len() as u32 - (top ^ self.sign_word()).leading_zeros(),
            None => 0,
        }
    }

    /// How many of the lowest bits are zero; all of them where the number is.
    #[inline(always)]
    pub(super) fn trailing_zeros(&self) -> u32 {
        let zeros = leading_zero_words(&self.0);
        64 * zeros as u32 + self.0.get(zeros).map_or(0, |word| word.trailing_zeros())
    }

    /// The lowest word of the number divided by 2^`dropped`, rounded down.
    #[inline(always)]
    pub(super) fn word_above(&self, dropped: u32) -> u64 {
        let words = self.0.get((dropped / 64) as usize..).unwrap_or_default();
        let mut words = words.iter().copied().chain(core::iter::repeat(self.sign_word()));
        let [low, high] = [(); 2].map(|()| words.next().unwrap_or_default());
        ((u128::from(high) << 64 | u128::from(low)) >> (dropped % 64)) as u64
    }
}

/// x + y + `carry` without what the word cannot hold, and whether there is such. (The standard library's `carrying_add` is younger than
/// the oldest compiler we support.)
#[inline(always)]
const fn add_with_carry(x: u64, y: u64, carry: bool) -> (u64, bool) {
    let (partial, first) = x.overflowing_add(y);
    let (whole, second) = partial.overflowing_add(carry as u64);
    (whole, first | second)
}

/// x − y − `borrow`, with 2⁶⁴ more where that is negative, and whether it is.
#[inline(always)]
const fn subtract_with_borrow(x: u64, y: u64, borrow: bool) -> (u64, bool) {
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

/// The words without those above that only repeat the sign.
#[inline(always)]
fn without_repeated_sign(words: &[u64]) -> &[u64] {
    let sign = sign_word(words);
    let mut length = words.len();
    // By eights first, which the compiler makes a comparison of a few registers.
    while let Some(below) = length.checked_sub(8)
        && let Some(eight) = words.get(below..length)
        && eight.iter().fold(0, |bits, word| bits | (word ^ sign)) == 0
    {
        length = below;
    }
    while let Some(below) = length.checked_sub(1)
        && words.get(below) == Some(&sign)
    {
        length = below;
    }
    let significant = words.get(..length).unwrap_or_default();
    if sign_word(significant) == sign {
        significant
    } else {
        words.get(..=length).unwrap_or_default()
    }
}

/// How many of the lowest words are zero.
#[inline(always)]
fn leading_zero_words(words: &[u64]) -> usize {
    words.iter().position(|&word| word != 0).unwrap_or(words.len())
}

/// How many of the lowest words are zero, and the others without those above that only repeat the sign.
#[inline(always)]
fn significant_words(words: &[u64]) -> (usize, &[u64]) {
    let words = without_repeated_sign(words);
    let zeros = leading_zero_words(words);
    (zeros, words.get(zeros..).unwrap_or_default())
}

/// The product of two numbers by their words into `product`, which is zero, and may lack words only if `is_cut`.
#[inline(always)]
fn multiply(a: &[u64], b: &[u64], product: &mut [u64], is_cut: bool) {
    for (i, &x) in a.iter().enumerate() {
        let length = if is_cut {
            b.len().min(product.len().saturating_sub(i))
        } else {
            b.len()
        };
        let (row, above) = product
            .get_mut(i..)
            .and_then(|words| words.split_at_mut_checked(length))
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
    if let Some((own, above)) = product.split_at_mut_checked(a.len() + b.len()) {
        above.fill(sign_word(own));
    }
}

/// The same with less to do where most words are zero or mere sign: numbers have many words when one pair's coordinates
/// differ in size by hundreds of powers of two, and then each of them has few words of its own.
#[inline(never)]
fn multiply_significant_words<const N: usize, const M: usize, const R: usize>(
    a: &[u64; N],
    b: &[u64; M],
    product: &mut [u64; R],
) {
    let (zeros_of_a, a) = significant_words(a);
    let (zeros_of_b, b) = significant_words(b);
    multiply(
        a,
        b,
        product.get_mut(zeros_of_a + zeros_of_b..).unwrap_or_default(),
        R < N + M,
    );
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
    use super::{Integer, multiply, multiply_significant_words};

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
            assert_eq!(x.is_zero(), a == 0, "{a}");
            assert_eq!(x.negated(), integer(a.wrapping_neg()), "{a}");
            assert_eq!(x.magnitude(), integer(a.wrapping_abs()), "{a}");
            assert_eq!(x.doubled(), integer(a.wrapping_mul(2)), "{a}");
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

    /// Numbers with zeros below, or with repeated signs above, or with neither.
    fn for_each_number(visit: &dyn Fn(&Integer<6>)) {
        visit(&Integer::ZERO);
        for significand in [1, -1, 3, -3, i64::MAX, i64::MIN] {
            for shift in [0, 1, 63, 64, 127, 128, 200, 256, 319, 320] {
                let number = shifted(significand, shift);
                visit(&number);
                visit(&number.minus(&shifted(1, 0)));
                visit(&number.plus(&shifted(significand, 7)));
            }
        }
    }

    #[test]
    fn the_product_of_significant_words_is_the_product() {
        for_each_number(&|a| {
            for_each_number(&|b| {
                let [mut expected, mut product] = [[0; 12]; 2];
                multiply(&a.0, &b.0, &mut expected, false);
                multiply_significant_words(&a.0, &b.0, &mut product);
                assert_eq!(product, expected, "{a:?} · {b:?}");
            });
        });
    }

    #[test]
    fn in_more_words_a_product_is_the_same_number_and_in_fewer_what_is_left_of_it() {
        for_each_number(&|a| {
            for_each_number(&|b| {
                let product: Integer<12> = a.times(b);
                assert_eq!(a.times::<6, 20>(b), product.widened(), "{a:?} · {b:?}");
                let cut: Integer<7> = a.times(b);
                assert_eq!(cut.0.as_slice(), &product.0[..7], "{a:?} · {b:?}");
                let cut: Integer<3> = a.times(b);
                assert_eq!(cut.0.as_slice(), &product.0[..3], "{a:?} · {b:?}");
            });
        });
        for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
            let product: Integer<4> = integer(a).times(&integer(b));
            assert_eq!(integer(a).times::<2, 9>(&integer(b)), product.widened(), "{a} · {b}");
            assert_eq!(integer(a).times::<2, 2>(&integer(b)), integer(a.wrapping_mul(b)), "{a} · {b}");
        }
    }

    #[test]
    fn products_are_distributive() {
        for_each_number(&|a| {
            for_each_number(&|b| {
                let (b, c): (Integer<7>, Integer<7>) = (b.widened(), shifted(-5, 130));
                let product: Integer<13> = a.times(&b.plus(&c));
                assert_eq!(product, a.times::<7, 13>(&b).plus(&a.times(&c)), "{a:?} · ({b:?} + {c:?})");
            });
        });
    }

    #[test]
    fn in_more_words_a_number_is_the_same() {
        for number in NUMBERS {
            let Integer([low, high]) = integer(number);
            let sign = (number >> 127) as u64;
            assert_eq!(integer(number).widened(), Integer([low, high, sign, sign]), "{number}");
        }
    }

    #[test]
    fn bits_are_those_beside_the_sign_and_zeros_those_below() {
        for number in NUMBERS {
            let repeated = if number < 0 {
                number.leading_ones()
            } else {
                number.leading_zeros()
            };
            assert_eq!(integer(number).bits(), 128 - repeated, "{number}");
            assert_eq!(integer(number).widened::<5>().bits(), 128 - repeated, "{number}");
            assert_eq!(integer(number).trailing_zeros(), number.trailing_zeros(), "{number}");
        }
    }

    #[test]
    fn the_word_above_some_bits_is_that_of_the_number_rounded_down() {
        for number in NUMBERS {
            for dropped in 0..128 {
                let expected = (number >> dropped) as u64;
                assert_eq!(integer(number).word_above(dropped), expected, "{number}, {dropped}");
            }
            assert_eq!(integer(number).word_above(300), (number >> 127) as u64, "{number}");
        }
    }
}
