//! Writes the results of core's conversions of times and lengths, for numbers at and beside each boundary of the formats.
//!
//! They work on the bits of numbers, which symbols do not have. So `verification/proofs/Narrowing.v` has them as functions of
//! encodings, proves these right for all numbers, and computes the same results as core for these.

use selvedge_core::elementary::Limits;
use selvedge_core::narrowing::{limits_in_f64, rounded_down, rounded_up};
use std::fmt::Write;

const HEAD: &str = "\
(* What core/src/narrowing.rs returns, as encodings.
   Written from the code by verification/traced/src/narrowed.rs. *)
From Coq Require Import ZArith List.
Import ListNotations.
Open Scope Z_scope.

";

/// The exponent fields of `f64` where the formats begin and end, and near one.
const DOUBLE_FIELDS: [u64; 15] = [0, 1, 2, 895, 896, 897, 898, 1022, 1023, 1024, 1149, 1150, 1151, 2045, 2046];
const SINGLE_FIELDS: [u32; 8] = [0, 1, 2, 126, 127, 128, 253, 254];

pub(crate) fn text() -> String {
    let mut text = String::from(HEAD);
    let last = 1 << 29;
    let fractions = [0, 1, last - 1, last, last + 1, 1 << 51, (1 << 52) - last, (1 << 52) - 1];
    let doubles = DOUBLE_FIELDS
        .into_iter()
        .flat_map(|field| fractions.map(|fraction| field << 52 | fraction));
    let rows = doubles.chain([f64::INFINITY, f64::NAN].map(f64::to_bits)).map(|bits| {
        let value = f64::from_bits(bits);
        let [down, up] = [rounded_down::<f32>(value), rounded_up(value)].map(f32::to_bits);
        let [same, raised] = [rounded_down::<f64>(value), rounded_up(value)].map(f64::to_bits);
        format!("({bits}, {down}, {up}, {same}, {raised})")
    });
    list("narrowed", rows, &mut text);

    let fractions = [0, 1, 2, 3, 1 << 22, (1 << 23) - 1];
    let singles = SINGLE_FIELDS
        .into_iter()
        .flat_map(|field| fractions.map(|fraction| field << 23 | fraction));
    let rows = singles.chain([f32::INFINITY, f32::NAN].map(f32::to_bits)).map(|bits| {
        let length = f32::from_bits(bits);
        let Limits { tolerance, separation } = limits_in_f64(&Limits {
            tolerance: length,
            separation: length,
        });
        let [tolerance, separation] = [tolerance, separation].map(f64::to_bits);
        format!("({bits}, {tolerance}, {separation})")
    });
    list("widened", rows, &mut text);
    text
}

fn list(name: &str, rows: impl Iterator<Item = String>, text: &mut String) {
    let rows: Vec<String> = rows.collect();
    writeln!(text, "Definition {name} := [\n{}\n].", rows.join(";\n")).expect("a string");
}
