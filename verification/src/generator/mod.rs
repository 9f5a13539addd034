//! The generator of inputs for the property tests and the fuzz targets.
//!
//! [`Choices`] makes a case from bytes. They are random in a property test ([`pairs`], [`meshes`] and similar functions are
//! proptest strategies), and the fuzzer's in a fuzz target ([`PairCase::from_bytes`]). Cases are biased to inputs that break
//! floating-point geometry. Examples are equal, nearly equal, collinear and coplanar points, and equal coordinates. Others are
//! huge, tiny and subnormal numbers, neighbours in the last place, and shapes far from the origin that hardly move. Some pairs
//! exactly touch or are exactly coplanar at a chosen time, 0 and 1 included ([`MeetingPair`]).
//!
//! A failing case is simplified number by number, and printed as Rust that makes it.

mod case;
mod choices;
mod mesh;
mod moment;
mod numbers;
mod pairs;
mod screw;
mod sliding;
mod strategy;
mod tube;

pub use crate::oracle::{points_of_first, side_of};
pub use case::PairCase;
pub use choices::Choices;
pub use mesh::{MeshCase, MeshPair, all_pairs, with_kinds};
pub use moment::{Meeting, MeetingPair};
pub use numbers::Format;
pub use screw::{Screw, vector};
pub use strategy::{FromChoices, Simplification, Simplify, check, config, from_choices};
pub use tube::BendingTube;

use proptest::prelude::Strategy;
use selvedge_core::PairKind;

/// Generates pairs with finite coordinates.
pub fn pairs<S: Format>(kind: PairKind) -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(move |choices| PairCase::choose(kind, choices))
}

/// Generates pairs of either kind with finite coordinates.
pub fn pairs_of_any_kind<S: Format>() -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(|choices| PairCase::choose(any_kind(choices), choices))
}

/// Generates pairs of either kind with at least one coordinate that is NaN, infinite, or the largest number.
pub fn extraordinary_pairs<S: Format>() -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(|choices| PairCase::choose_any(any_kind(choices), choices))
}

/// Generates pairs of either kind that touch at a known time.
pub fn touching_pairs<S: Format>() -> impl Strategy<Value = MeetingPair<S>> + Clone {
    from_choices(|choices| MeetingPair::choose(any_kind(choices), Meeting::Touching, choices))
}

/// Generates pairs of either kind that are coplanar at a known time.
pub fn coplanar_pairs<S: Format>() -> impl Strategy<Value = MeetingPair<S>> + Clone {
    from_choices(|choices| MeetingPair::choose(any_kind(choices), Meeting::Coplanar, choices))
}

/// Generates pairs of either kind that slide: points of one set travel closely beside a corner, a side or the face of the other.
pub fn sliding_pairs<S: Format>() -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(|choices| PairCase::choose_sliding(any_kind(choices), choices))
}

/// Generates vertices whose paths pass an edge of the face's box as closely as possible.
pub fn grazes_of_a_box<S: Format>() -> impl Strategy<Value = PairCase<S>> + Clone {
    from_choices(PairCase::choose_graze_of_a_box)
}

pub fn meshes<S: Format>() -> impl Strategy<Value = MeshCase<S>> + Clone {
    from_choices(MeshCase::choose)
}

fn any_kind(choices: &mut Choices<'_>) -> PairKind {
    choices.pick(&PairKind::ALL)
}
