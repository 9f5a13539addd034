//! Tests each loop over words on all numbers of a few words of one or two bits, against built-in numbers.

extern crate std;

use super::limbs::{
    Word, add, multiply, multiply_significant_words, sign_word, subtract, without_repeated_sign, without_zeros_below, write_sum,
};
use super::tiny::Tiny;
use std::vec;
use std::vec::Vec;

/// Returns all numbers of `length` words.
fn numbers<const BITS: u32>(length: usize) -> impl Iterator<Item = Vec<Tiny<BITS>>> {
    let digit = |number: u32, index: usize| Tiny((number >> (BITS * index as u32)) as u8 % Tiny::<BITS>::SIZE);
    (0..1 << (BITS * length as u32)).map(move |number| (0..length).map(|index| digit(number, index)).collect())
}

fn up_to<const BITS: u32>(length: usize) -> Vec<Vec<Tiny<BITS>>> {
    (0..=length).flat_map(numbers).collect()
}

fn modulus<const BITS: u32>(words: &[Tiny<BITS>]) -> i64 {
    1 << (BITS as usize * words.len())
}

fn natural<const BITS: u32>(words: &[Tiny<BITS>]) -> i64 {
    let size = i64::from(Tiny::<BITS>::SIZE);
    words.iter().rev().fold(0, |above, word| above * size + i64::from(word.0))
}

fn signed<const BITS: u32>(words: &[Tiny<BITS>]) -> i64 {
    let number = natural(words);
    if 2 * number < modulus(words) {
        number
    } else {
        number - modulus(words)
    }
}

/// Words whose contents must not matter.
fn unwritten<const BITS: u32>(length: usize) -> Vec<Tiny<BITS>> {
    vec![Tiny::ONES; length]
}

fn sums_and_products_are_exact<const BITS: u32>(length: usize) {
    let numbers = up_to::<BITS>(length);
    for a in &numbers {
        for b in &numbers {
            for (mask, expected) in [(Tiny::ZERO, signed(a) + signed(b)), (Tiny::ONES, signed(a) - signed(b))] {
                let mut sum = unwritten(a.len().max(b.len()) + 1);
                write_sum(a, b, mask, &mut sum);
                assert_eq!(signed(&sum), expected, "{a:?}, {b:?}, {mask:?}");
            }
            let mut product = unwritten(a.len() + b.len());
            multiply_significant_words(a, b, &mut product);
            assert_eq!(signed(&product), signed(a) * signed(b), "{a:?} · {b:?}");
            if a.is_empty() || b.is_empty() {
                continue;
            }
            multiply(a, b, &mut product);
            assert_eq!(natural(&product), natural(a) * natural(b), "{a:?} · {b:?}");
        }
    }
}

#[test]
fn sums_and_products_of_all_tiny_numbers_are_exact() {
    sums_and_products_are_exact::<1>(9);
    sums_and_products_are_exact::<2>(5);
    sums_and_products_are_exact::<3>(3);
}

#[test]
fn sums_and_differences_of_one_width_are_exact_modulo_two_to_their_bits() {
    for length in 0..=4 {
        for a in numbers::<2>(length) {
            for b in numbers::<2>(length) {
                let (mut sum, mut difference) = (a.clone(), a.clone());
                add(&mut sum, &b);
                subtract(&mut difference, &b, Tiny::ONES);
                let reduced = |number: i64| number.rem_euclid(modulus(&a));
                assert_eq!(natural(&sum), reduced(natural(&a) + natural(&b)), "{a:?} + {b:?}");
                assert_eq!(natural(&difference), reduced(natural(&a) - natural(&b)), "{a:?} - {b:?}");
                subtract(&mut difference, &b, Tiny::ZERO);
                assert_eq!(
                    natural(&difference),
                    reduced(natural(&a) - natural(&b)),
                    "zero was subtracted"
                );
            }
        }
    }
}

fn significant_words_are_the_number<const BITS: u32>(length: usize) {
    for words in up_to::<BITS>(length) {
        let significant = without_repeated_sign(&words);
        assert_eq!(signed(significant), signed(&words), "{words:?}");
        if let Some((&top, below)) = significant.split_last() {
            assert_ne!(top, sign_word(below), "{words:?}");
        }
        let (zeros, above) = without_zeros_below(&words);
        assert!(words.iter().take(zeros).all(|word| word.0 == 0), "{words:?}");
        assert!(above.first().is_none_or(|word| word.0 != 0), "{words:?}");
        assert_eq!(zeros + above.len(), words.len(), "{words:?}");
    }
}

/// From eight words on, whole groups are left out, and from sixteen on two.
#[test]
fn significant_words_of_all_tiny_numbers_are_the_number() {
    significant_words_are_the_number::<1>(17);
    significant_words_are_the_number::<2>(9);
}
