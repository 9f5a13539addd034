//! The time of impact comes with a proof that holds in exact numbers, and the checker of proofs accepts no false claim.

use crate::support::prelude::*;
use selvedge_core::elementary::advance::{WITNESS_PARTS, time_of_impact, witness};
use selvedge_verification::witness::Claim;

/// A pair, its separation, and choices for an alteration.
#[derive(Clone, Debug)]
struct Case<S: Format> {
    pair: PairCase<S>,
    separation: S,
    alteration: Vec<u8>,
}

impl<S: Format> Simplify for Case<S> {
    fn attempts(&self) -> usize {
        1 + self.pair.attempts()
    }

    fn simpler(&self, attempt: usize) -> Option<Self> {
        let mut simpler = self.clone();
        match attempt {
            0 if self.separation != S::ZERO => simpler.separation = S::ZERO,
            0 => return None,
            _ => simpler.pair = self.pair.simpler(attempt - 1)?,
        }
        Some(simpler)
    }
}

/// Chooses any pair, or one that slides, without a separation or with one of about the size of its distance.
fn cases<S: Format>() -> impl Strategy<Value = Case<S>> + Clone {
    from_choices(|choices| {
        let alteration = (0..64).map(|_| choices.below(256) as u8).collect();
        let kind = choices.pick(&PairKind::ALL);
        let slides = choices.once_in(2);
        let pair = if slides {
            PairCase::choose_sliding(kind, choices)
        } else {
            PairCase::choose(kind, choices)
        };
        let nearly = S::exact(1, -choices.pick(&[1, 3, 10, 17, 23]));
        Case {
            separation: choices.pick(&[S::ZERO, S::ZERO, nearly]),
            alteration,
            pair,
        }
    })
}

fn answer<S: Format>(case: &Case<S>) -> (Impact<S>, Claim) {
    let limits = Limits::within(case.separation);
    let pair = case.pair.pair();
    let (impact, witness) = witness(&pair, &limits);
    (impact, Claim::new(&pair, case.separation, impact, &witness))
}

/// The proof holds, and the answer is that without a proof, unless rounds run out or coordinates differ too much.
fn is_proven<S: Format>(case: &Case<S>) -> TestCaseResult {
    let (impact, claim) = answer(case);
    prop_assert!(claim.parts.len() <= WITNESS_PARTS);
    if case.pair.is_finite() {
        prop_assert!(claim.is_proven(), "{impact:?}: {claim:?}");
    } else {
        prop_assert_eq!(impact.time(), Some(S::ZERO));
    }
    let limits = Limits::within(case.separation);
    let asks_more = matches!(
        impact,
        Impact::Possible {
            reason: Reason::LastResort | Reason::OutOfRange,
            ..
        }
    );
    let without = time_of_impact(&case.pair.pair(), &limits);
    prop_assert!(asks_more || format!("{impact:?}") == format!("{without:?}"), "{without:?}");
    Ok(())
}

formats!(every_answer_is_proven is is_proven(20_000, cases()));

/// Returns the question of a claim for the oracle.
fn question(claim: &Claim) -> Pair {
    let frame = |end: usize| claim.points.map(|ends| ends[end]);
    Pair::new(claim.kind, frame(0), frame(1))
}

/// Returns whether the claim is true, by the oracle.
fn is_true(claim: &Claim) -> bool {
    let first = if claim.separation == 0.0 {
        collides(&question(claim))
    } else {
        first_within(&question(claim), claim.separation)
    };
    // Up to time zero nothing is claimed.
    claim.until == 0.0 || first.is_none_or(|first| first.cmp_f64(claim.until).is_gt())
}

/// Returns the next number. After zero it returns a number that is not tiny, since the oracle would take minutes.
fn next(number: f64) -> f64 {
    if number == 0.0 { 0.5_f64.powi(30) } else { number.next_up() }
}

/// Changes the claim, or its proof, once.
fn altered(mut claim: Claim, choices: &mut Choices<'_>) -> Claim {
    let part = choices.below(claim.parts.len().max(1) as u32) as usize;
    let axis = choices.below(3) as usize;
    match choices.below(8) {
        0 | 1 => {
            let (point, end) = (choices.below(4) as usize, choices.below(2) as usize);
            let other = claim.points[choices.below(4) as usize][choices.below(2) as usize][axis];
            let number = &mut claim.points[point][end][axis];
            *number = choices.pick(&[0.0, other, -*number, next(*number)]);
        }
        2 => claim.until = 1.0,
        3 => {
            // To the end, or by one place beyond the first contact.
            let question = question(&claim);
            let contact = collides(&question).map_or(1.0, |first| first.to_f64_down().next_up().min(1.0));
            claim.until = choices.pick(&[1.0, contact]);
            if let Some(last) = claim.parts.last_mut() {
                last.until = claim.until;
            }
        }
        4 => claim.separation = choices.pick(&[next(claim.separation), claim.separation * 2.0, 0.125]),
        5 => {
            claim.parts.truncate(part);
        }
        6 => {
            // The proof of another part, or the volume's.
            if let Some(changed) = claim.parts.get_mut(part) {
                changed.directions.truncate(choices.below(3) as usize);
            }
            claim.until = choices.pick(&[claim.until, 1.0]);
            if let Some(last) = claim.parts.last_mut() {
                last.until = claim.until;
            }
        }
        _ => {
            if let Some(w) = claim.parts.get_mut(part).and_then(|part| part.directions.first_mut()) {
                w[axis] = choices.pick(&[0.0, -w[axis], w[axis].next_up(), 1.0]);
            }
            claim.until = choices.pick(&[claim.until, 1.0]);
        }
    }
    claim
}

/// Accepted claims are true. Counts the false ones.
fn no_false_claim_is_accepted<S: Format>(case: &Case<S>, untrue: &Cell<u32>) -> TestCaseResult {
    let numbers = case.pair.coordinates().map(|x| x.to_f64().abs()).filter(|&x| x > 0.0);
    let (smallest, largest) = numbers.fold((1.0_f64, 1.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    // With other sizes the oracle may take minutes.
    if !case.pair.is_finite() || largest / smallest > 1e30 {
        return Ok(());
    }
    let (_, claim) = answer(case);
    let mut choices = Choices::new(&case.alteration);
    for _ in 0..4 {
        let altered = altered(claim.clone(), &mut choices);
        let is_true = is_true(&altered);
        untrue.set(untrue.get() + u32::from(!is_true));
        prop_assert!(is_true || !altered.is_proven(), "{altered:?}");
    }
    Ok(())
}

fn accepts_no_false_claim<S: Format>() {
    let untrue = Cell::new(0);
    check(5_000, cases::<S>(), |case| no_false_claim_is_accepted(case, &untrue));
    assert!(untrue.get() > 3_000, "{}", untrue.get());
}

formats!(accepts_no_false_claim);
