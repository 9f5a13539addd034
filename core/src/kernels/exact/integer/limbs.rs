//! Arithmetic on words: 64 bits each, the lowest first.

/// Writes `significand` · 2^`shift`.
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
pub(super) fn sign_word(words: &[u64]) -> u64 {
    let top = words.last().copied().unwrap_or(0);
    (top.cast_signed() >> 63).cast_unsigned()
}

/// The words without those above that only repeat the sign.
#[inline(always)]
pub(super) fn without_repeated_sign(mut words: &[u64]) -> &[u64] {
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
pub(super) fn without_zeros_below(words: &[u64]) -> (usize, &[u64]) {
    let zeros = words.iter().position(|&word| word != 0).unwrap_or(words.len());
    (zeros, words.get(zeros..).unwrap_or_default())
}

/// The product of two numbers that are not negative by their words into `product`, which has the words of both.
///
/// It reads a negative number −x as 2^(64·words) − x: that is the other factor times 2^(64·words) too much.
#[inline(always)]
pub(super) fn multiply(a: &[u64], b: &[u64], product: &mut [u64]) {
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
pub(super) fn multiply_significant_words(a: &[u64], b: &[u64], product: &mut [u64]) {
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
pub(super) fn subtract(from: &mut [u64], other: &[u64], mask: u64) {
    let mut borrow = false;
    for (&subtracted, word) in other.iter().zip(from) {
        (*word, borrow) = subtract_with_borrow(*word, subtracted & mask, borrow);
    }
}
