//! Runs of the time of impact, for `verification/proofs/Replayed.v`: pairs, the records of their rounds, and the answered times.
//!
//! The pairs are found by a search that is the same each time: for each kind, format and separation those whose records have each
//! proof that a round can have, and one with many rounds.

use crate::Text;
use selvedge_core::elementary::advance::{Proof, WitnessPart, witness};
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::{Motion, PairKind, PrimitivePair, Scalar};
use std::fmt::Write;

const HEAD: &str = "\
(* Runs of the time of impact: coordinates, a separation, the answered time, and the record.
   Written from the code by verification/traced/src/runs.rs. A number is its digits and an exponent. *)
From Coq Require Import ZArith List.
From Selvedge Require Import Replay.
Import ListNotations.
Open Scope Z_scope.

";

/// The number of pairs that are tried for each kind, format and separation.
const TRIED: u32 = 100_000;

/// The largest number of parts of a record, so that Coq takes seconds.
const MOST_PARTS: usize = 14;

/// The smallest number of parts of a record with many rounds.
const MANY_PARTS: usize = 9;

pub(crate) fn file() -> Text {
    let mut text = String::from(HEAD);
    runs::<f32>("single", &mut text);
    runs::<f64>("double", &mut text);
    ("Runs.v".to_owned(), text)
}

/// A feature of a record: a proof that it has, or many parts.
type Feature<S> = (&'static str, fn(&[WitnessPart<S>]) -> bool);

fn has<S: Scalar>(parts: &[WitnessPart<S>], is_such: impl Fn(&WitnessPart<S>) -> bool) -> bool {
    parts.len() > 1 && parts.iter().any(is_such)
}

fn runs<S: Scalar>(name: &str, text: &mut String) {
    let features: [Feature<S>; 8] = [
        (
            "along an axis",
            |parts| matches!(parts, [WitnessPart { proof: Proof::Held(w), .. }] if w.iter().filter(|&&x| x == S::ZERO).count() == 2),
        ),
        ("volume throughout", |parts| {
            parts.len() == 1 && parts[0].proof == Proof::Volume
        }),
        ("held", |parts| {
            has(parts, |part| matches!(part.proof, Proof::Held(_)) && part.until < S::ONE)
        }),
        ("turning", |parts| has(parts, |part| matches!(part.proof, Proof::Turning(_)))),
        ("curving", |parts| has(parts, |part| matches!(part.proof, Proof::Curving(_)))),
        ("clipped", |parts| {
            has(parts, |part| part.proof == Proof::Volume && part.until < S::ONE)
        }),
        ("volume to the end", |parts| {
            has(parts, |part| part.proof == Proof::Volume && part.until == S::ONE)
        }),
        ("many rounds", |parts| parts.len() >= MANY_PARTS),
    ];
    for (kind, of) in [
        (PairKind::VertexFace, "a_vertex_and_a_face"),
        (PairKind::EdgeEdge, "two_edges"),
    ] {
        let mut found = Vec::new();
        for is_separated in [false, true] {
            let mut numbers = Numbers(1);
            let mut missing = features.to_vec();
            for _ in 0..TRIED {
                if missing.is_empty() {
                    break;
                }
                let pair = slides::<S>(kind, &mut numbers);
                let separation = if is_separated {
                    S::from_f64((-10.0_f64).exp2() * numbers.next().abs())
                } else {
                    S::ZERO
                };
                let limits = Limits {
                    tolerance: S::from_f64((-20.0_f64).exp2()),
                    separation,
                };
                let (impact, witness) = witness(&pair, &limits);
                let parts = witness.parts();
                let before = missing.len();
                if parts.len() <= MOST_PARTS {
                    missing.retain(|(_, is_present)| !is_present(parts));
                }
                if missing.len() < before {
                    found.push(run(&pair, separation, impact, parts));
                }
            }
            let names: Vec<&str> = missing.iter().map(|(name, _)| *name).collect();
            assert!(names.is_empty(), "no {} {of} (separated: {is_separated}): {names:?}", S::NAME);
        }
        writeln!(text, "Definition {name}_{of} := [\n{}\n].", found.join(";\n")).expect("a string");
    }
}

fn run<S: Scalar>(pair: &PrimitivePair<S>, separation: S, impact: Impact<S>, parts: &[WitnessPart<S>]) -> String {
    let ends = pair.motions.iter().flat_map(|motion| [motion.start, motion.end]);
    let coordinates: Vec<String> = ends.flat_map(|end| -> [S; 3] { end.into() }).map(number).collect();
    let answer = number(impact.time().unwrap_or(S::ONE));
    let record: Vec<String> = parts.iter().map(part).collect();
    format!(
        "Run [{}] {} {answer} [{}]",
        coordinates.join("; "),
        number(separation),
        record.join("; ")
    )
}

fn part<S: Scalar>(part: &WitnessPart<S>) -> String {
    let vector = |w: [S; 3]| format!("({})", w.map(number).join(", "));
    let until = number(part.until);
    match part.proof {
        Proof::Volume => format!("({until}, Volume)"),
        Proof::Held(w) => format!("({until}, HeldAlong {})", vector(w)),
        Proof::Turning(ends) => format!("({until}, TurningTo {})", ends.map(vector).join(" ")),
        Proof::Curving(curve) => format!("({until}, CurvingTo {})", curve.map(vector).join(" ")),
    }
}

/// Returns the digits and the exponent of a number, the digits odd or zero.
fn number<S: Scalar>(x: S) -> String {
    let bits = x.to_f64().to_bits();
    let field = (bits >> 52 & 0x7ff) as i32;
    let fraction = bits & ((1 << 52) - 1);
    let (digits, exponent) = if field == 0 {
        (fraction, -1074)
    } else {
        (fraction | 1 << 52, field - 1075)
    };
    if digits == 0 {
        return "(0, 0)".to_owned();
    }
    let zeros = digits.trailing_zeros();
    let sign = if bits >> 63 == 1 { "-" } else { "" };
    format!("({sign}{}, {})", digits >> zeros, exponent + zeros as i32)
}

/// Numbers that look random, the same each time.
struct Numbers(u64);

impl Numbers {
    /// Returns a number in [-1, 1).
    fn next(&mut self) -> f64 {
        // A generator by Marsaglia.
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 * (-52.0_f64).exp2() - 1.0
    }

    fn point(&mut self) -> [f64; 3] {
        [(); 3].map(|()| self.next())
    }
}

/// Makes a pair whose first set slides along the second, or falls on it. Both may turn.
fn slides<S: Scalar>(kind: PairKind, numbers: &mut Numbers) -> PrimitivePair<S> {
    let mut points = [(); 4].map(|()| [(); 2].map(|()| numbers.point()));
    let height = (15.0 * numbers.next() - 15.0).exp2();
    let (target, movers) = match kind {
        PairKind::VertexFace => ([1, 2, 3], 0..1),
        PairKind::EdgeEdge => ([2, 3, 3], 0..2),
    };
    for mover in movers {
        for end in 0..2 {
            let [a, b] = [numbers.next().abs(), numbers.next().abs()];
            let weights = [1.0 - a, a * (1.0 - b), a * b];
            let away = numbers.point();
            for axis in 0..3 {
                let on = (0..3).map(|k| weights[k] * points[target[k]][end][axis]).sum::<f64>();
                points[mover][end][axis] = on + height * away[axis];
            }
        }
    }
    let position = |point: [f64; 3]| -> S::Vector { point.map(S::from_f64).into() };
    PrimitivePair::new(
        kind,
        points.map(|[start, end]| Motion {
            start: position(start),
            end: position(end),
        }),
    )
}
