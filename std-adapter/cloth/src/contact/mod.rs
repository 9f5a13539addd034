//! Contact: cloth with itself and with bodies.
//!
//! | module | what it does |
//! |---|---|
//! | `settings` | what effects ask for |
//! | `candidates` | which pairs are looked at, followed from step to step by the detector; `neighbours`: those near each other at rest |
//! | `candidate` | one pair: what contact keeps of it, its certified time of impact |
//! | `constraints`, `rows` | contacts as constraints of the solver |
//! | `cones` | which contacts are with a body's surface |
//! | `pass` | no step is accepted that is not certified |
//! | `relaxation`, `impact_zones`, `truncation` | what is done about a step that is not |
//! | `solver` | all of it, as the simulation calls it |
//! | `crossing` | where surfaces pass through each other |
//! | `exempt` | what has left the promise: bodies that were let pass, what was tangled where the simulation started |
//! | `contours`, `sides`, `incidence` | which way to go for what is tangled to come apart |
//! | `opening` | whether cloth that has torn may open |
//! | `untangling` | that, as the simulation calls it before its first step |
//! | `report` | what was counted, what it took, what was in the way |
//!
//! Pairs may be left out of forces, never out of certificates: neighbours on the mesh are pairs like any other.

mod candidate;
mod candidates;
mod cones;
mod constraints;
mod contours;
mod crossing;
mod exempt;
mod impact_zones;
mod neighbours;
mod opening;
mod pass;
mod relaxation;
mod report;
mod rows;
mod separations;
mod settings;
mod sides;
mod solver;
mod truncation;
mod untangling;

pub use crossing::Crossing;
pub(crate) use crossing::PairKey;
pub(crate) use pass::LARGEST_TURN;
pub(crate) use report::Blocker;
pub use report::{ContactCounts, ContactSeconds};
pub use rows::ProximityPair;
pub(crate) use settings::ContactSettings;
pub use settings::Thickness;
pub(crate) use solver::ContactSolver;
