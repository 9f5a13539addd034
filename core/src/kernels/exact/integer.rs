//! Whole numbers in two's complement, the lowest word first: arrays where the compiler knows the width, which for a few words is
//! quickest; else slices of as many words as a number needs, out of one space.

use core::cmp::Ordering;
use core::mem;

/// Whatever is written down in words.
pub(super) trait Whole: Copy {
    const ZERO: Self;

    fn words(&self) -> Words<'_>;

    #[inline(always)]
    fn sign(&self) -> Ordering {
        self.words().sign()
    }
}

/// A whole number of `N` words.
///
/// Every result is taken modulo 2^(64·words): it is the exact one where that fits, which is for [`kernel`](super::kernel) to show.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Integer<const N: usize>([u64; N]);

impl<const N: usize> Integer<N> {
    /// `significand` · 2^`shift`.
    #[inline(always)]
    pub(super) fn shifted(significand: i64, shift: u32) -> Self {
        if N == 1 {
            // The same, with less to do.
            return Self([(significand << (shift % 64)).cast_unsigned(); N]);
        }
        let mut words = [0; N];
        write_shifted(&mut words, significand, shift);
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
        subtract(&mut difference, &other.0, u64::MAX);
        Self(difference)
    }

    /// The product, in as many words as both factors have.
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
            // In line is faster for a few words; for many it would only be more code.
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

/// A whole number as its words without those above that only repeat the sign: zero has none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Words<'a>(&'a [u64]);

impl Whole for Words<'_> {
    const ZERO: Self = Self(&[]);

    #[inline(always)]
    fn words(&self) -> Words<'_> {
        *self
    }
}

impl<'a> Words<'a> {
    /// The number of these words.
    #[inline(always)]
    fn new(words: &'a [u64]) -> Self {
        Self(without_repeated_sign(words))
    }

    /// How the number compares with zero.
    #[inline(always)]
    pub(super) fn sign(self) -> Ordering {
        match self.0.last() {
            None => Ordering::Equal,
            Some(&top) if top.cast_signed() < 0 => Ordering::Less,
            Some(_) => Ordering::Greater,
        }
    }

    /// The number, if it has one word at most.
    #[inline(always)]
    const fn single(self) -> Option<i128> {
        match *self.0 {
            [] => Some(0),
            [word] => Some(word.cast_signed() as i128),
            _ => None,
        }
    }

    /// The number, if it has two words at most.
    #[inline(always)]
    const fn small(self) -> Option<i128> {
        match *self.0 {
            [low, high] => Some(((high as u128) << 64 | low as u128).cast_signed()),
            _ => self.single(),
        }
    }

    #[inline(always)]
    pub(super) const fn is_zero(self) -> bool {
        self.0.is_empty()
    }

    /// The least number of bits beside the sign: the number is in [−2ᵇ, 2ᵇ).
    #[inline(always)]
    pub(super) fn bits(self) -> u32 {
        match self.0.last() {
            Some(top) => 64 * self.0.len() as u32 - (top ^ sign_word(self.0)).leading_zeros(),
            None => 0,
        }
    }

    /// How many of the lowest bits are zero; none where the number is.
    #[inline(always)]
    pub(super) fn trailing_zeros(self) -> u32 {
        let (zeros, above) = without_zeros_below(self.0);
        64 * zeros as u32 + above.first().map_or(0, |word| word.trailing_zeros())
    }

    /// The lowest word of the number divided by 2^`dropped`, rounded down.
    #[inline(always)]
    pub(super) fn word_above(self, dropped: u32) -> u64 {
        let (sign, first) = (sign_word(self.0), (dropped / 64) as usize);
        let word = |index| self.0.get(index).copied().unwrap_or(sign);
        ((u128::from(word(first + 1)) << 64 | u128::from(word(first))) >> (dropped % 64)) as u64
    }
}

/// Space for numbers, each of which has it as long as the space lives: nothing is given back but by [`scratch`](Self::scratch).
///
/// That there is enough is for `contact` to show.
#[derive(Debug)]
pub(super) struct Space<'a>(&'a mut [u64]);

impl<'a> Space<'a> {
    pub(super) const fn new(words: &'a mut [u64]) -> Self {
        Self(words)
    }

    /// What is left, for as long as the borrow lasts.
    #[inline(always)]
    pub(super) const fn scratch(&mut self) -> Space<'_> {
        Space(self.0)
    }

    #[inline(always)]
    fn take(&mut self, length: usize) -> &'a mut [u64] {
        debug_assert!(length <= self.0.len(), "there is enough space");
        let (taken, rest) = mem::take(&mut self.0).split_at_mut_checked(length).unwrap_or_default();
        self.0 = rest;
        taken
    }

    /// `significand` · 2^`shift`; zero whatever the shift.
    #[inline(never)]
    pub(super) fn shifted(&mut self, significand: i64, shift: u32) -> Words<'a> {
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

    /// A number of two words.
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
    pub(super) fn plus(&mut self, a: Words<'_>, b: Words<'_>) -> Words<'a> {
        match a.small().zip(b.small()).and_then(|(a, b)| a.checked_add(b)) {
            Some(sum) => self.double(sum),
            None => self.sum(a.0, b.0, 0),
        }
    }

    #[inline(never)]
    pub(super) fn minus(&mut self, a: Words<'_>, b: Words<'_>) -> Words<'a> {
        match a.small().zip(b.small()).and_then(|(a, b)| a.checked_sub(b)) {
            Some(difference) => self.double(difference),
            None => self.sum(a.0, b.0, u64::MAX),
        }
    }

    pub(super) fn negated(&mut self, a: Words<'_>) -> Words<'a> {
        self.minus(Words::ZERO, a)
    }

    pub(super) fn doubled(&mut self, a: Words<'_>) -> Words<'a> {
        self.plus(a, a)
    }

    pub(super) fn tripled(&mut self, a: Words<'_>) -> Words<'a> {
        let doubled = self.doubled(a);
        self.plus(doubled, a)
    }

    /// a + b, or with all ones for `mask` a − b, which is a plus the complement of b, plus one.
    #[inline(always)]
    fn sum(&mut self, a: &[u64], b: &[u64], mask: u64) -> Words<'a> {
        let ((long, long_mask), (short, short_mask)) = if a.len() >= b.len() {
            ((a, 0), (b, mask))
        } else {
            ((b, mask), (a, 0))
        };
        let words = self.take(long.len() + 1);
        let mut carry = mask != 0;
        for ((sum, x), y) in words.iter_mut().zip(long).zip(short) {
            (*sum, carry) = add_with_carry(x ^ long_mask, y ^ short_mask, carry);
        }
        let sign_of_short = sign_word(short) ^ short_mask;
        if let (Some([above @ .., top]), Some(rest)) = (words.get_mut(short.len()..), long.get(short.len()..)) {
            for (sum, x) in above.iter_mut().zip(rest) {
                (*sum, carry) = add_with_carry(x ^ long_mask, sign_of_short, carry);
            }
            *top = add_with_carry(sign_word(long) ^ long_mask, sign_of_short, carry).0;
        }
        Words::new(words)
    }

    /// The product.
    #[inline(never)]
    pub(super) fn times(&mut self, a: Words<'_>, b: Words<'_>) -> Words<'a> {
        match (a.0, b.0) {
            ([], _) | (_, []) => return Words::ZERO,
            (&[a], &[b]) => return self.double(i128::from(a.cast_signed()) * i128::from(b.cast_signed())),
            _ => {}
        }
        let words = self.take(a.0.len() + b.0.len());
        multiply_significant_words(a.0, b.0, words);
        Words::new(words)
    }

    /// The sum of three products.
    #[inline(never)]
    pub(super) fn sum_of_products(&mut self, products: [[Words<'_>; 2]; 3]) -> Words<'a> {
        let length = products.iter().map(|[a, b]| a.0.len() + b.0.len()).max().unwrap_or(0);
        let words = self.take(length + 2);
        let mut scratch = self.scratch();
        let [x, y, z] = products.map(|[a, b]| scratch.times(a, b));
        let sum = scratch.plus(x, y);
        Space(words).plus(sum, z)
    }

    /// a·d − b·c.
    #[inline(never)]
    pub(super) fn minor(&mut self, a: Words<'_>, b: Words<'_>, c: Words<'_>, d: Words<'_>) -> Words<'a> {
        if let (Some(a), Some(b), Some(c), Some(d)) = (a.single(), b.single(), c.single(), d.single()) {
            // Less than 2¹²⁶ + 2¹²⁶: both products are 2¹²⁶ at most, and −2¹²⁶ is none.
            return self.double(a * d - b * c);
        }
        let words = self.take((a.0.len() + d.0.len()).max(b.0.len() + c.0.len()) + 1);
        let mut scratch = self.scratch();
        let (x, y) = (scratch.times(a, d), scratch.times(b, c));
        Space(words).minus(x, y)
    }
}

/// Writes `significand` · 2^`shift`.
#[inline(always)]
fn write_shifted(words: &mut [u64], significand: i64, shift: u32) {
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
fn without_repeated_sign(mut words: &[u64]) -> &[u64] {
    // By eights first, which the compiler makes a comparison of a few registers.
    while let Some((below, eight)) = words.split_last_chunk::<8>()
        && eight.iter().fold(0, |bits, word| bits | (word ^ sign_word(below))) == 0
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

/// How many of the lowest words are zero, and the others.
#[inline(always)]
fn without_zeros_below(words: &[u64]) -> (usize, &[u64]) {
    let zeros = words.iter().position(|&word| word != 0).unwrap_or(words.len());
    (zeros, words.get(zeros..).unwrap_or_default())
}

/// The product of two numbers that are not negative by their words into `product`, which has the words of both.
///
/// It reads a negative number −x as 2^(64·words) − x: that is the other factor times 2^(64·words) too much.
#[inline(always)]
fn multiply(a: &[u64], b: &[u64], product: &mut [u64]) {
    if let (Some((&x, _)), Some((row, above))) = (a.split_first(), product.split_at_mut_checked(b.len())) {
        let mut carry = 0;
        for (&y, word) in b.iter().zip(row) {
            let sum = u128::from(x) * u128::from(y) + u128::from(carry);
            (*word, carry) = (sum as u64, (sum >> 64) as u64);
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
}

/// The product of any two numbers into `product`, which has the words of both: less to do where most words are zero or mere sign. Numbers
/// have many words when one pair's coordinates differ in size by hundreds of powers of two, and then each of them has few of its own.
#[inline(never)]
fn multiply_significant_words(a: &[u64], b: &[u64], product: &mut [u64]) {
    let (zeros_of_a, a) = without_zeros_below(without_repeated_sign(a));
    let (zeros_of_b, b) = without_zeros_below(without_repeated_sign(b));
    if a.is_empty() || b.is_empty() {
        return product.fill(0);
    }
    let zeros = zeros_of_a + zeros_of_b;
    let (below, product) = product.split_at_mut_checked(zeros).unwrap_or_default();
    for word in below {
        *word = 0;
    }
    let (product, above) = product.split_at_mut_checked(a.len() + b.len()).unwrap_or_default();
    multiply(a, b, product);
    if sign_word(a) != 0 {
        subtract(product.get_mut(a.len()..).unwrap_or_default(), b, u64::MAX);
    }
    if sign_word(b) != 0 {
        subtract(product.get_mut(b.len()..).unwrap_or_default(), a, u64::MAX);
    }
    let sign = sign_word(product);
    for word in above {
        *word = sign;
    }
}

/// Subtracts `other`, each word masked by `mask`, from the words `from`; a borrow beyond the last is dropped.
#[inline(always)]
fn subtract(from: &mut [u64], other: &[u64], mask: u64) {
    let mut borrow = false;
    for (&subtracted, word) in other.iter().zip(from) {
        (*word, borrow) = subtract_with_borrow(*word, subtracted & mask, borrow);
    }
}

#[cfg(test)]
mod tests {
    use super::{Integer, Space, Whole, Words, multiply_significant_words};

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

    /// The same number in more words, or the lowest of its words.
    fn resized<const R: usize>(number: Words<'_>) -> Integer<R> {
        let sign = if number.sign().is_lt() { u64::MAX } else { 0 };
        let mut words = [sign; R];
        for (word, &own) in words.iter_mut().zip(number.0) {
            *word = own;
        }
        Integer(words)
    }

    /// What `compute` makes in a space.
    fn in_space<const R: usize>(compute: impl for<'a> Fn(&mut Space<'a>) -> Words<'a>) -> Integer<R> {
        // Not zero, so that no word is left to chance.
        resized(compute(&mut Space::new(&mut [0x5555; 100])))
    }

    #[test]
    fn sums_differences_and_signs_are_those_of_the_built_in_type() {
        for (a, b) in NUMBERS.iter().flat_map(|&a| NUMBERS.map(|b| (a, b))) {
            let (x, y) = (integer(a), integer(b));
            let (p, q) = (x.words(), y.words());
            let (sum, difference) = (integer(a.wrapping_add(b)), integer(a.wrapping_sub(b)));
            assert_eq!(x.plus(&y), sum, "{a} + {b}");
            assert_eq!(x.minus(&y), difference, "{a} - {b}");
            assert_eq!(in_space::<2>(|space| space.plus(p, q)), sum, "{a} + {b}");
            assert_eq!(in_space::<2>(|space| space.minus(p, q)), difference, "{a} - {b}");
            assert_eq!(x.sign(), a.cmp(&0), "{a}");
            assert_eq!(p.sign(), a.cmp(&0), "{a}");
            assert_eq!(p.is_zero(), a == 0, "{a}");
            assert_eq!(in_space::<2>(|space| space.negated(p)), integer(a.wrapping_neg()), "{a}");
            assert_eq!(in_space::<2>(|space| space.doubled(p)), integer(a.wrapping_mul(2)), "{a}");
            assert_eq!(in_space::<2>(|space| space.tripled(p)), integer(a.wrapping_mul(3)), "{a}");
        }
    }

    #[test]
    fn sums_of_many_words_are_those_of_fixed_width() {
        for_each_number(&|a| {
            for_each_number(&|b| {
                let (p, q): (Integer<7>, Integer<7>) = (resized(a.words()), resized(b.words()));
                let sum = in_space::<7>(|space| space.plus(a.words(), b.words()));
                let difference = in_space::<7>(|space| space.minus(a.words(), b.words()));
                assert_eq!((sum, difference), (p.plus(&q), p.minus(&q)), "{a:?}, {b:?}");
            });
        });
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
            assert_eq!(
                in_space::<4>(|space| space.times(integer(a).words(), integer(b).words())),
                product
            );
            // One word by one, and by two.
            let short = Integer([a as u64]);
            let of_short = i128::from((a as u64).cast_signed()) * i128::from((b as u64).cast_signed());
            assert_eq!(short.times::<1, 2>(&Integer([b as u64])), integer(of_short));
            let (expected, product): (Integer<4>, Integer<3>) =
                (resized::<2>(short.words()).times(&integer(b)), short.times(&integer(b)));
            assert_eq!(resized::<4>(product.words()), expected, "{short:?} · {b}");
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

    /// By rows of 32 bits, of magnitudes.
    fn slow_product(a: &Integer<6>, b: &Integer<6>) -> Integer<12> {
        let magnitude = |x: &Integer<6>| if x.sign().is_lt() { Integer::ZERO.minus(x) } else { *x };
        let halves = |x: Integer<6>| x.0.into_iter().flat_map(|word| [word & 0xffff_ffff, word >> 32]);
        let mut product = Integer::<12>::ZERO;
        for (i, x) in halves(magnitude(a)).enumerate() {
            for (j, y) in halves(magnitude(b)).enumerate() {
                for (k, half) in [(x * y) & 0xffff_ffff, (x * y) >> 32].into_iter().enumerate() {
                    let place = 32 * (i + j + k) as u32;
                    // Nothing is above: a magnitude has a bit less than its words.
                    if half != 0 {
                        product = product.plus(&shifted(half.cast_signed(), place));
                    }
                }
            }
        }
        if a.sign() == b.sign() {
            product
        } else {
            Integer::ZERO.minus(&product)
        }
    }

    #[test]
    fn the_product_of_significant_words_is_the_product() {
        for_each_number(&|a| {
            for_each_number(&|b| {
                let expected = slow_product(a, b);
                let mut product = [0x5555; 12];
                multiply_significant_words(&a.0, &b.0, &mut product);
                assert_eq!(Integer(product), expected, "{a:?} · {b:?}");
                assert_eq!(a.times::<6, 12>(b), expected, "{a:?} · {b:?}");
                assert_eq!(
                    in_space::<12>(|space| space.times(a.words(), b.words())),
                    expected,
                    "{a:?} · {b:?}"
                );
            });
        });
    }

    #[test]
    fn minors_and_sums_of_products_are_those_of_products() {
        let numbers = [0, 1, -1, i64::MAX, i64::MIN].map(|x| shifted::<6>(x, 0));
        let others = [shifted(3, 70), shifted(-5, 130), shifted(i64::MIN, 0), Integer::ZERO];
        for (a, b) in numbers.iter().flat_map(|a| numbers.map(|b| (a, b))) {
            for (c, d) in numbers
                .iter()
                .chain(&others)
                .flat_map(|c| others.iter().chain(&numbers).map(move |d| (c, d)))
            {
                let [ad, bc]: [Integer<12>; 2] = [a.times(d), b.times(c)];
                let [p, q, r, s] = [a, &b, c, d].map(|x| x.words());
                assert_eq!(
                    in_space::<12>(|space| space.minor(p, q, r, s)),
                    ad.minus(&bc),
                    "{a:?} {b:?} {c:?} {d:?}"
                );
                let sum = in_space::<12>(|space| space.sum_of_products([[p, s], [q, r], [r, s]]));
                assert_eq!(sum, ad.plus(&bc).plus(&c.times(d)), "{a:?} {b:?} {c:?} {d:?}");
            }
        }
    }

    #[test]
    fn a_shifted_number_is_the_same_in_a_space() {
        for significand in [0, 1, -1, i64::MAX, i64::MIN] {
            for shift in [0, 1, 63, 64, 100, 200] {
                let expected: Integer<5> = shifted(significand, shift);
                assert_eq!(
                    in_space::<5>(|space| space.shifted(significand, shift)),
                    expected,
                    "{significand} · 2^{shift}"
                );
            }
        }
    }

    #[test]
    fn zero_takes_no_space_however_far_it_is_shifted() {
        let mut words = [0; 2];
        let mut space = Space::new(&mut words);
        assert!(space.shifted(0, u32::MAX).is_zero());
        assert_eq!(resized::<1>(space.shifted(5, 0)), Integer([5]));
    }

    #[test]
    fn bits_are_those_beside_the_sign_and_zeros_those_below() {
        for number in NUMBERS {
            let repeated = if number < 0 {
                number.leading_ones()
            } else {
                number.leading_zeros()
            };
            let wide: Integer<5> = resized(integer(number).words());
            for words in [integer(number).words(), wide.words()] {
                assert_eq!(words.bits(), 128 - repeated, "{number}");
                assert_eq!(
                    words.trailing_zeros(),
                    if number == 0 { 0 } else { number.trailing_zeros() },
                    "{number}"
                );
            }
        }
    }

    #[test]
    fn the_word_above_some_bits_is_that_of_the_number_rounded_down() {
        for number in NUMBERS {
            let number_in_words = integer(number);
            for dropped in 0..128 {
                let expected = (number >> dropped) as u64;
                assert_eq!(number_in_words.words().word_above(dropped), expected, "{number}, {dropped}");
            }
            assert_eq!(number_in_words.words().word_above(300), (number >> 127) as u64, "{number}");
        }
    }
}
