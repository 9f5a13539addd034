//! Writes what core's whole numbers return, for numbers at which carries, borrows and signs fail most easily.
//!
//! Loops over words have no symbols. So `verification/proofs/Words.v` and `Integers.v` have them as functions of lists and prove
//! these right for all numbers, and `Samples.v` computes the same results as core for these. The source files are core's own.

#![allow(
    clippy::duplicate_mod,
    reason = "functions on words are private to the module of whole numbers"
)]

#[allow(dead_code, unreachable_pub, reason = "core uses the rest")]
#[path = "../../../../core/src/kernels/exact/integer/mod.rs"]
mod integer;
#[allow(dead_code, unreachable_pub, reason = "core uses the rest")]
#[path = "../../../../core/src/kernels/exact/integer/limbs.rs"]
mod limbs;
#[path = "../../../../core/src/kernels/exact/integer/tiny.rs"]
mod tiny;

use integer::{Integer, Space, Whole, Words};
use limbs::{Word, multiply_significant_words, without_repeated_sign, without_zeros_below, write_sum};
use selvedge_core::kernels::exact::{control_value_signs, touches};
use selvedge_core::{Motion, PairKind, PrimitivePair, Scalar};
use std::cmp::Ordering;
use std::fmt::{Display, Write};
use tiny::Tiny;

const HEAD: &str = "\
(* What core/src/kernels/exact returns: whole numbers in words of 64 bits; all numbers of a few tiny words; signs and verdicts of
   the pairs that fuzzing keeps. Written from the code by verification/traced/src/kernels/exact.rs. *)
From Coq Require Import ZArith List.
Import ListNotations.
Open Scope Z_scope.

";

/// The encodings of the kept inputs of the fuzz target `exact_signs`, whose test keeps them up to date.
const KEPT_PAIRS: &str = include_str!("../../kept_pairs.txt");

/// The words at which carries, borrows and signs change.
const WORDS: [u64; 5] = [0, 1, i64::MAX as u64, 1 << 63, u64::MAX];

pub(crate) fn text() -> String {
    let mut text = String::from(HEAD);
    tiny_numbers(&mut text);
    fixed_widths(&mut text);
    in_a_space(&mut text);
    shifted(&mut text);
    kept_pairs(&mut text);
    text
}

fn define(name: &str, rows: &[String], text: &mut String) {
    writeln!(text, "Definition {name} := [\n{}\n].", rows.join(";\n")).expect("a string");
}

fn list(numbers: impl IntoIterator<Item = impl Display>) -> String {
    let numbers: Vec<String> = numbers.into_iter().map(|number| number.to_string()).collect();
    format!("[{}]", numbers.join("; "))
}

fn tiny_list<const BITS: u32>(words: &[Tiny<BITS>]) -> String {
    list(words.iter().map(|word| word.0))
}

fn sign_of(sign: Ordering) -> &'static str {
    match sign {
        Ordering::Less => "Lt",
        Ordering::Equal => "Eq",
        Ordering::Greater => "Gt",
    }
}

/// Returns all numbers of at most `length` words.
fn all_tiny<const BITS: u32>(length: usize) -> Vec<Vec<Tiny<BITS>>> {
    let mut all = vec![Vec::new()];
    let mut last = all.clone();
    for _ in 0..length {
        last = last
            .iter()
            .flat_map(|words| (0..Tiny::<BITS>::SIZE).map(|word| [words.as_slice(), &[Tiny(word)]].concat()))
            .collect();
        all.extend(last.iter().cloned());
    }
    all
}

/// Sums, differences and products of all numbers of at most two words of two bits; the significant words of all numbers of
/// nine words of one bit, of which a group of eight is left out, and of less than three.
fn tiny_numbers(text: &mut String) {
    let numbers = all_tiny::<2>(2);
    let mut rows = Vec::new();
    for a in &numbers {
        for b in &numbers {
            let [mut sum, mut difference] = [(); 2].map(|()| vec![Tiny::ONES; a.len().max(b.len()) + 1]);
            write_sum(a, b, Tiny::ZERO, &mut sum);
            write_sum(a, b, Tiny::ONES, &mut difference);
            let mut product = vec![Tiny::ONES; a.len() + b.len()];
            multiply_significant_words(a, b, &mut product);
            let results = [&sum, &difference].map(|words| without_repeated_sign(words));
            let lists = [a.as_slice(), b, results[0], results[1], &product].map(tiny_list);
            rows.push(format!("({})", lists.join(", ")));
        }
    }
    define("tiny", &rows, text);

    let rows: Vec<String> = all_tiny::<1>(9)
        .iter()
        .filter(|words| words.len() < 3 || words.len() == 9)
        .map(|words| {
            let (zeros, above) = without_zeros_below(words);
            let lists = [words.as_slice(), without_repeated_sign(words), above].map(tiny_list);
            format!("({}, {zeros}%nat)", lists.join(", "))
        })
        .collect();
    define("significant", &rows, text);
}

/// Writes a pair's sum and difference of one width.
fn sums<const N: usize>(a: &Integer<N>, b: &Integer<N>, rows: &mut Vec<String>) {
    let lists = [a, b, &a.plus(b), &a.minus(b)].map(|number| list(number.0));
    rows.push(format!("({}, {})", lists.join(", "), sign_of(a.sign())));
}

fn product<const N: usize, const M: usize, const R: usize>(a: &Integer<N>, b: &Integer<M>, rows: &mut Vec<String>) {
    let product: Integer<R> = a.times(b);
    rows.push(format!("({}, {}, {})", list(a.0), list(b.0), list(product.0)));
}

fn fixed_widths(text: &mut String) {
    let ones = WORDS.map(|word| Integer([word]));
    let twos = WORDS.map(|low| WORDS.map(|high| Integer([low, high]))).concat();
    let hard = [[1, 0], [u64::MAX; 2], [0, 1 << 63], [u64::MAX, i64::MAX as u64], [1 << 63, 0]].map(Integer);
    let wide = |low: u64, middle: u64, high: u64| Integer([low, middle, middle, high, high]);
    let fives = [
        wide(0, 0, 0),
        wide(1, 0, 0),
        wide(0, 1, 0),
        wide(0, u64::MAX, u64::MAX),
        wide(u64::MAX, u64::MAX, u64::MAX),
        wide(0, 0, 1 << 63),
        wide(u64::MAX, u64::MAX, i64::MAX as u64),
        wide(1, 1 << 63, 1),
    ];
    let [mut of_sums, mut of_products] = [const { Vec::new() }; 2];
    for a in &ones {
        for b in &ones {
            sums(a, b, &mut of_sums);
            product::<1, 1, 2>(a, b, &mut of_products);
        }
        for b in &twos {
            product::<1, 2, 3>(a, b, &mut of_products);
        }
    }
    for a in &twos {
        for b in &hard {
            sums(a, b, &mut of_sums);
            product::<2, 2, 4>(a, b, &mut of_products);
        }
    }
    for a in &fives {
        for b in &fives {
            sums(a, b, &mut of_sums);
            product::<5, 5, 10>(a, b, &mut of_products);
        }
        for b in &hard {
            product::<5, 2, 7>(a, b, &mut of_products);
        }
    }
    define("fixed_sums", &of_sums, text);
    define("fixed_products", &of_products, text);
}

/// The numbers in a space: none, one and two words, some with zeros below and some of many words.
fn numbers<'a>(space: &mut Space<'a>) -> Vec<Words<'a>> {
    let mut numbers = vec![Words::ZERO];
    for (significand, shifts) in [
        (1, [0, 63, 64, 576]),
        (-1, [0, 63, 64, 576]),
        (i64::MAX, [0, 1, 64, 200]),
        (i64::MIN, [0, 1, 64, 200]),
    ] {
        numbers.extend(shifts.map(|shift| space.shifted(significand, shift)));
    }
    let one = space.shifted(1, 0);
    for (significand, shift) in [(1, 64), (-1, 64), (1, 127), (1, 576)] {
        let number = space.shifted(significand, shift);
        numbers.push(space.minus(number, one));
    }
    numbers
}

fn in_a_space(text: &mut String) {
    let mut words = vec![0x5555; 100_000];
    let mut space = Space::new(&mut words);
    let numbers = numbers(&mut space);
    let [mut of_operations, mut of_minors, mut of_parts] = [const { Vec::new() }; 3];
    for &a in &numbers {
        for &b in &numbers {
            let mut space = space.scratch();
            let results = [a, b, space.plus(a, b), space.minus(a, b), space.times(a, b)];
            of_operations.push(format!("({})", results.map(|number| list(number.0)).join(", ")));
        }
        let above = [0, 1, 63, 64, 100].map(|dropped| a.word_above(dropped));
        of_parts.push(format!(
            "({}, {}, {}, {})",
            list(a.0),
            sign_of(a.sign()),
            a.bits(),
            list(above)
        ));
    }
    let small = [0, 1, -1, i64::MAX, i64::MIN].map(|significand| space.shifted(significand, 0));
    let [first, second] = [(3, 70), (i64::MIN, 130)].map(|(significand, shift)| space.shifted(significand, shift));
    for a in small {
        for b in small {
            for [c, d] in [[a, b], [b, b], [small[4], small[3]], [first, b], [second, first]] {
                let mut space = space.scratch();
                let results = [
                    a,
                    b,
                    c,
                    d,
                    space.minor(a, b, c, d),
                    space.sum_of_products([[a, d], [b, c], [c, d]]),
                    space.tripled(a),
                    space.negated(d),
                ];
                of_minors.push(format!("({})", results.map(|number| list(number.0)).join(", ")));
            }
        }
    }
    define("in_space", &of_operations, text);
    define("in_space_minors", &of_minors, text);
    define("in_space_parts", &of_parts, text);
}

/// Significands shifted into one word, two and five, as far as they fit, and in a space.
fn shifted(text: &mut String) {
    let mut rows = Vec::new();
    let mut words = vec![0x5555; 1000];
    for significand in [0, 1, -1, (1 << 53) - 1, 1 - (1 << 53)] {
        for shift in [0, 1, 8, 9, 63, 64, 65, 72, 127, 128, 200, 264] {
            let mut space = Space::new(&mut words);
            rows.push(format!(
                "({significand}, {shift}, {}, {}, {}, {})",
                list(Integer::<1>::shifted(significand, shift).0),
                list(Integer::<2>::shifted(significand, shift).0),
                list(Integer::<5>::shifted(significand, shift).0),
                list(space.shifted(significand, shift).0)
            ));
        }
    }
    define("shifted", &rows, text);
}

/// Makes a pair of the encodings axis by axis.
fn pair<S: Scalar>(kind: PairKind, encodings: &[u64], number: impl Fn(u64) -> S) -> PrimitivePair<S> {
    let position = |point: usize| {
        let [x, y, z] = [0, 8, 16].map(|axis| number(encodings[axis + point]));
        S::Vector::from([x, y, z])
    };
    let motions = [0, 1, 2, 3].map(|point| Motion::new(position(point), position(4 + point)));
    PrimitivePair { kind, motions }
}

/// Writes the kept pairs with their signs and verdicts.
fn kept_pairs(text: &mut String) {
    let mut rows = Vec::new();
    for line in KEPT_PAIRS.lines() {
        let mut words = line.split(' ');
        let [kind, format] = [(); 2].map(|()| words.next().expect("a kind and a format"));
        let encodings: Vec<u64> = words
            .map(|word| u64::from_str_radix(word, 16).expect("an encoding"))
            .collect();
        let pair_kind = PairKind::ALL
            .into_iter()
            .find(|known| format!("{known:?}") == kind)
            .expect("a kind of pair");
        let (signs, verdict) = match format {
            "f32" => answers(&pair(pair_kind, &encodings, |encoding| f32::from_bits(encoding as u32))),
            "f64" => answers(&pair(pair_kind, &encodings, f64::from_bits)),
            other => panic!("a number format: {other}"),
        };
        let axes: Vec<String> = encodings.chunks(8).map(list).collect();
        rows.push(format!(
            "({}, {}, {}, {signs}, {verdict})",
            format == "f64",
            pair_kind == PairKind::EdgeEdge,
            axes.join(", ")
        ));
    }
    define("kept", &rows, text);
}

fn answers<S: Scalar>(pair: &PrimitivePair<S>) -> (String, String) {
    let signs = control_value_signs(pair).map_or("None".to_owned(), |signs| format!("Some {}", list(signs.map(sign_of))));
    let verdict = touches(pair).map_or("None".to_owned(), |touches| format!("Some {touches}"));
    (signs, verdict)
}
