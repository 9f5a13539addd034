//! Selvedge answers every case of the conformance suite. No contact is missed, no time is late, and no pair is reported that
//! stays farther apart than documented. This holds in `f64` and `f32`, for one pair alone, side by side on every instruction set,
//! and by a detector.

use crate::support::prelude::*;
use crate::support::sweeps::side_by_side;
use selvedge_core::elementary::advance::time_of_impact;
use selvedge_core::elementary::{ContactVerdict, contact};
use selvedge_verification::conformance::{Case, CaseQuestion};

/// The cases of a question that a format holds exactly.
fn cases<S: Format>(question: CaseQuestion) -> Vec<Case> {
    let mut cases = Case::read_all().expect("the suite's files");
    cases.retain(|case| case.question == question && (S::PRECISION == 53 || case.format == "f32"));
    assert!(cases.len() > 500, "only {} cases", cases.len());
    cases
}

fn points<S: Format>(case: &Case) -> [Vec<[S; 3]>; 2] {
    case.positions()
        .map(|end| end.iter().map(|point| point.map(S::from_f64)).collect())
}

fn pairs<S: Format>(case: &Case) -> Vec<PairCase<S>> {
    let [start, end] = points(case);
    let pair = |(kind, vertices): (PairKind, [u32; 4])| {
        PairCase::new(kind, vertices.map(|vertex| [start[vertex as usize], end[vertex as usize]]))
    };
    case.pairs().into_iter().map(pair).collect()
}

/// Returns the distance below which a case may be reported although it does not touch: tolerance, and 192 units of rounding of
/// all lengths.
fn reach<S: Format>(case: &Case) -> f64 {
    let [start, end] = case.positions();
    let largest = |axis: usize| {
        let axis = start.iter().chain(&end).map(|point| point[axis]);
        let (low, high) = axis.fold((f64::MAX, f64::MIN), |(low, high), x| (low.min(x), high.max(x)));
        2.0 * (high - low).min(f64::MAX / 2.0)
    };
    let tolerance = Limits::<S>::default().tolerance.to_f64();
    let (unit, tiny) = if S::PRECISION == 53 {
        (2f64.powi(-53), 2f64.powi(-500))
    } else {
        (2f64.powi(-24), 2f64.powi(-60))
    };
    // Each length is multiplied on its own: the largest ones would overflow as a sum.
    let hidden = |length: f64| 192.0 * unit * length;
    tolerance + hidden(tolerance) + hidden(largest(0)) + hidden(largest(1)) + hidden(largest(2)) + tiny
}

/// Checks a time from which contact is not excluded, or `None`.
fn is_right<S: Format>(case: &Case, time: Option<S>, how: &str) {
    let id = &case.id;
    match (case.touches, time) {
        (None, time) => assert!(time.is_some(), "{id}, {how}: excluded though a number is not finite"),
        (Some(true), time) => {
            let time = time.unwrap_or_else(|| panic!("{id}, {how}: missed")).to_f64();
            let first = case.first.expect("the time of a case in motion");
            assert!(time <= first[0].0, "{id}, {how}: {time} is later than {}", first[0].0);
        }
        (Some(false), Some(_)) => {
            let distance = case.distance.expect("the distance of a case apart")[0].0;
            assert!(
                distance <= reach::<S>(case),
                "{id}, {how}: reported at a distance of {distance}"
            );
        }
        (Some(false), None) => {}
    }
}

fn earliest<S: Format>(impacts: &[Impact<S>]) -> Option<S> {
    let times = impacts.iter().filter_map(Impact::time);
    times.min_by(|a, b| a.partial_cmp(b).expect("times are numbers"))
}

fn pairs_are_answered<S: Format>(question: CaseQuestion, kind: PairKind) {
    let cases = cases::<S>(question);
    let all: Vec<_> = cases.iter().map(|case| pairs::<S>(case)[0]).collect();
    for (case, pair) in cases.iter().zip(&all) {
        let pair = pair.pair();
        let verdict = match case.touches {
            None => ContactVerdict::Undefined,
            Some(true) => ContactVerdict::Happens,
            Some(false) => ContactVerdict::Never,
        };
        assert_eq!(contact(&pair), verdict, "{}", case.id);
        is_right(case, time_of_impact(&pair, &Limits::default()).time(), "alone");
    }
    for (name, level) in available_levels() {
        for (case, impact) in cases.iter().zip(side_by_side(level, kind, &all, &Limits::default())) {
            is_right(case, impact.time(), name);
        }
    }
}

#[test]
fn pairs_alone_and_side_by_side() {
    for (question, kind) in [
        (CaseQuestion::VertexFace, PairKind::VertexFace),
        (CaseQuestion::EdgeEdge, PairKind::EdgeEdge),
    ] {
        pairs_are_answered::<f64>(question, kind);
        pairs_are_answered::<f32>(question, kind);
    }
}

fn detector_answers<S: Format>(question: CaseQuestion)
where
    [S; 3]: Position<Scalar = S>,
{
    for case in cases::<S>(question) {
        let id = &case.id;
        let [start, end] = points::<S>(&case);
        let topology = Topology::new(start.len(), case.triangles()).expect("valid triangles");
        let mut detector = CollisionDetector::new(topology);
        let mut intersects = || detector.has_intersections(&start).expect("finite positions");
        match case.question {
            CaseQuestion::Triangles | CaseQuestion::Meshes => {
                assert_eq!(Some(intersects()), case.touches, "{id}");
                continue;
            }
            CaseQuestion::MovingTriangle if intersects() => {
                let first = case.first.expect("a contact");
                assert_eq!(Rational::from_f64(first[1].0), Some(Rational::new()), "{id}");
                continue;
            }
            _ => {}
        }
        let first = detector.earliest(&start, &end).expect("finite positions");
        is_right(&case, first.map(|first| first.time), "detector");
        let tolerance = Limits::default().tolerance;
        detector
            .set_criterion(Criterion::Touching { tolerance })
            .expect("a valid tolerance");
        let first = detector.earliest(&start, &end).expect("finite positions");
        assert_eq!(Some(first.is_some()), case.touches, "{id}, exactly");
        is_right(&case, first.map(|first| first.time), "exact detector");
    }
}

#[test]
fn triangles_and_meshes_by_a_detector() {
    for question in [
        CaseQuestion::Triangles,
        CaseQuestion::Meshes,
        CaseQuestion::MovingTriangle,
        CaseQuestion::MovingMesh,
    ] {
        detector_answers::<f64>(question);
        detector_answers::<f32>(question);
    }
}

/// One pair alone gives the batch's earliest time or an earlier one, so the two are compared where a mesh has many pairs.
#[test]
fn meshes_pair_by_pair() {
    for case in cases::<f64>(CaseQuestion::MovingMesh) {
        let impacts: Vec<_> = pairs::<f64>(&case)
            .iter()
            .map(|pair| time_of_impact(&pair.pair(), &Limits::default()))
            .collect();
        is_right(&case, earliest(&impacts), "pair by pair");
    }
}
