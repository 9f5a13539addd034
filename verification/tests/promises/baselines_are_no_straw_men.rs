//! The methods that others published, where rounding is no concern: then they have to be right, or the comparison with them is worth
//! nothing.

use proptest::prelude::*;
use selvedge_core::PairKind;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_laboratory::baselines::{additive, bernstein_sign, cubic, tight_inclusion};
use selvedge_verification::generator::{PairCase, check};
use selvedge_verification::oracle::collides;

/// Coordinates anywhere from −1 to 1, all different: half of the pairs are coplanar at some time, one in twenty touch, and
/// hardly any so closely that rounding to 53 bits could matter.
fn any_pairs(kind: PairKind) -> impl Strategy<Value = PairCase<f64>> + Clone {
    let coordinate = || -1.0..1.0_f64;
    let position = move || [coordinate(), coordinate(), coordinate()];
    let motion = move || [position(), position()];
    [motion(), motion(), motion(), motion()].prop_map(move |points| PairCase::new(kind, points))
}

/// Asks each method about pairs of either kind, and tells `judge` the truth, and what a method says.
fn compare(
    cases: u32,
    vertex_face: fn(&PairCase<f64>) -> bool,
    edge_edge: fn(&PairCase<f64>) -> bool,
    is_allowed: fn(truth: bool, answer: bool) -> bool,
) {
    for (kind, asked) in [(PairKind::VertexFace, vertex_face), (PairKind::EdgeEdge, edge_edge)] {
        check(cases, any_pairs(kind), |pair| {
            let (truth, answer) = (collides(&pair.question()).is_some(), asked(pair));
            prop_assert!(is_allowed(truth, answer), "{truth}, answered {answer}");
            Ok(())
        });
    }
}

fn equal(truth: bool, answer: bool) -> bool {
    truth == answer
}

/// Those with a tolerance may sound a false alarm.
fn no_miss(truth: bool, answer: bool) -> bool {
    answer || !truth
}

#[test]
fn the_plain_cubic_decides_pairs_in_general_position() {
    compare(
        20_000,
        |pair| cubic::vertex_face(&pair.vertex_face()).is_some(),
        |pair| cubic::edge_edge(&pair.edge_edge()).is_some(),
        equal,
    );
}

#[test]
fn signs_of_polynomials_decide_pairs_in_general_position() {
    compare(
        20_000,
        |pair| bernstein_sign::touches(&pair.vertex_face()),
        |pair| bernstein_sign::touches(&pair.edge_edge()),
        equal,
    );
}

#[test]
fn tight_inclusion_misses_nothing() {
    const LIMITS: Limits<f64> = Limits {
        tolerance: 1e-6,
        separation: 0.0,
    };
    compare(
        2_000,
        |pair| tight_inclusion::time_of_impact(&pair.vertex_face(), &LIMITS) != Impact::Never,
        |pair| tight_inclusion::time_of_impact(&pair.edge_edge(), &LIMITS) != Impact::Never,
        no_miss,
    );
}

#[test]
fn additive_advancement_misses_nothing_in_general_position() {
    compare(
        2_000,
        |pair| additive::time_of_impact(&pair.vertex_face(), 0.0) != Impact::Never,
        |pair| additive::time_of_impact(&pair.edge_edge(), 0.0) != Impact::Never,
        no_miss,
    );
}
