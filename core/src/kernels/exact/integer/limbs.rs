//! Arithmetic on words: 64 bits each, the lowest first.

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

/// Returns x + y + `carry` modulo 2⁶⁴, and the carry. (The standard library's `carrying_add` is newer than the oldest supported
/// compiler.)
#[inline(always)]
pub(super) const fn add_with_carry(x: u64, y: u64, carry: bool) -> (u64, bool) {
    let (partial, first) = x.overflowing_add(y);
    let (whole, second) = partial.overflowing_add(carry as u64);
    (whole, first | second)
}

/// Returns x − y − `borrow` modulo 2⁶⁴, and the borrow.
#[inline(always)]
pub(super) const fn subtract_with_borrow(x: u64, y: u64, borrow: bool) -> (u64, bool) {
    let (partial, first) = x.overflowing_sub(y);
    let (whole, second) = partial.overflowing_sub(borrow as u64);
    (whole, first | second)
}

/// Returns all ones if the number of these words is negative, otherwise zero.
#[inline(always)]
pub(super) fn sign_word(words: &[u64]) -> u64 {
    let top = words.last().copied().unwrap_or(0);
    (top.cast_signed() >> 63).cast_unsigned()
}

/// Returns the words without those above that only repeat the sign.
#[inline(always)]
pub(super) fn without_repeated_sign(mut words: &[u64]) -> &[u64] {
    // Groups of eight come first: the compiler makes them a comparison of a few registers.
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

/// Returns the number of lowest words that are zero, and the other words.
#[inline(always)]
pub(super) fn without_zeros_below(words: &[u64]) -> (usize, &[u64]) {
    let zeros = words.iter().position(|&word| word != 0).unwrap_or(words.len());
    (zeros, words.get(zeros..).unwrap_or_default())
}

/// Writes the product of two numbers, read as unsigned, to `product`, which has the words of both.
///
/// A negative number −x is read as 2^(64·words) − x, which adds the other factor times 2^(64·words).
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

/// Writes the product of any two numbers to `product`, which has the words of both. It does less where most words are zero or
/// repeat the sign. Numbers have many words when one pair's coordinates differ in size by hundreds of powers of two, and then
/// each has few significant words.
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
