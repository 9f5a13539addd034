//! The names that most promises use.

pub(crate) use super::environment::Environment;
pub(crate) use proptest::prelude::*;
pub(crate) use proptest::test_runner::TestCaseResult;
pub(crate) use rug::Rational;
pub(crate) use selvedge::simd::{available_levels, best_level};
pub(crate) use selvedge::{CollisionDetector, Contact, Criterion, Position, StepError, Threads, Topology};
pub(crate) use selvedge_core::batch::{LANES, Level, VertexRow};
pub(crate) use selvedge_core::boxes::Aabb;
pub(crate) use selvedge_core::elementary::{Impact, Limits, Reason, advance::time_of_impact_within};
pub(crate) use selvedge_core::filter::{Filter, Tier};
pub(crate) use selvedge_core::glam::DVec3;
pub(crate) use selvedge_core::kernels::coplanarity::{MovingTetrahedron, is_in_range};
pub(crate) use selvedge_core::kernels::vector::Vector;
pub(crate) use selvedge_core::separation::{closest::ClosestPoints, largest_coordinate};
pub(crate) use selvedge_core::{Motion, PairKind, PrimitivePair, Scalar, Verdict};
pub(crate) use selvedge_verification::culling::{CertifiedTest, verdict};
pub(crate) use selvedge_verification::formats;
pub(crate) use selvedge_verification::generator::*;
pub(crate) use selvedge_verification::oracle::{Pair, are_ever_coplanar, collides, first_within, rational, within, within_at};
pub(crate) use std::cell::Cell;
pub(crate) use std::collections::{BTreeMap, BTreeSet};
