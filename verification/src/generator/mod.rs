//! One generator of inputs, for the property tests and for the fuzz targets.
//!
//! A case is made from bytes by [`Choices`]: from random ones in a property test ([`pairs`], [`meshes`] and their
//! like are proptest strategies), from the fuzzer's in a fuzz target ([`PairCase::from_bytes`]). It is biased to what
//! breaks floating-point geometry: equal, nearly equal, collinear and coplanar points, coordinates in common, huge, tiny and
//! subnormal numbers, neighbours in the last place, shapes far from the origin that hardly move, pairs that touch or are
//! coplanar at a chosen time, 0 and 1 included, exactly ([`Moment`]).
//!
//! What fails is simplified number by number, and printed as Rust that makes the same pair.

mod case;
mod choices;
mod mesh;
mod moment;
mod numbers;
mod pairs;
mod screw;
mod strategy;

pub use case::{PairCase, side_of};
pub use choices::Choices;
pub use mesh::MeshCase;
pub use moment::{Meeting, Moment};
pub use numbers::Format;
pub(crate) use numbers::power_of_two;
pub use screw::{Screw, vector};
pub use strategy::{FromChoices, Simplification, Simplify, check, from_choices};

use proptest::prelude::Strategy;
use selvedge_core::PairKind;

/// Pairs with finite coordinates.
pub fn pairs<S: Format>(kind: PairKind) -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(move |choices| PairCase::choose(kind, choices))
}

/// Pairs of either kind with finite coordinates.
pub fn pairs_of_any_kind<S: Format>() -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(|choices| PairCase::choose(any_kind(choices), choices))
}

/// Pairs of either kind with at least one coordinate that is NaN, infinite, or the largest there is.
pub fn extraordinary_pairs<S: Format>() -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(|choices| PairCase::choose_any(any_kind(choices), choices))
}

/// Pairs of either kind that touch at a known time.
pub fn touching_pairs<S: Format>() -> impl Strategy<Value = Moment<S>> + Clone {
    from_choices(|choices| Moment::choose(any_kind(choices), Meeting::Touching, choices))
}

/// Pairs of either kind that are coplanar at a known time.
pub fn coplanar_pairs<S: Format>() -> impl Strategy<Value = Moment<S>> + Clone {
    from_choices(|choices| Moment::choose(any_kind(choices), Meeting::Coplanar, choices))
}

/// Vertices whose paths pass an edge of the face's box as closely as can be.
pub fn grazes_of_a_box<S: Format>() -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(PairCase::choose_graze_of_a_box)
}

/// Small meshes in motion.
pub fn meshes<S: Format>() -> impl Strategy<Value = MeshCase<S>> + Clone {
    from_choices(MeshCase::choose)
}

fn any_kind(choices: &mut Choices<'_>) -> PairKind {
    choices.pick(&[PairKind::VertexFace, PairKind::EdgeEdge])
}
