//! Contact of cloth with itself and with bodies.
//!
//! | module | contents |
//! |---|---|
//! | `settings` | the distances that effects request |
//! | `candidates` | the pairs that contact looks at, which the detector follows from step to step; `neighbours`: pairs that are
//! near each other at rest |
//! | `candidate` | one pair: the data stored for it, and its certified time of impact |
//! | `near` | the pairs that are near, which the solve keeps apart |
//! | `smooth_body` | capsules and balls |
//! | `cones` | the contacts of surfaces |
//! | `pass` | the certificate of each step |
//! | `relaxation`, `mobility`, `impact_zones`, `truncation` | repairs of steps that are not free |
//! | `solver` | contact, in the form that the simulation calls |
//! | `crossing` | edges and faces that pass through each other |
//! | `exempt` | pairs without certificate: bodies that were let pass, and what was tangled at the start of the simulation |
//! | `contours`, `sides` | the directions in which tangled cloth comes apart |
//! | `opening` | whether torn cloth may open |
//! | `untangling` | untangling, in the form that the simulation calls before its first step |
//! | `report` | counts, times, and reasons why a step failed |
//!
//! Contacts may leave pairs out, certificates never: neighbours on the mesh are pairs like any other.

mod candidate;
mod candidates;
mod cones;
mod contours;
mod crossing;
mod exempt;
mod impact_zones;
mod mobility;
mod near;
mod neighbours;
mod opening;
mod pass;
mod relaxation;
mod report;
mod separations;
mod settings;
mod sides;
pub(crate) mod smooth_body;
mod solver;
mod truncation;
mod untangling;

pub use crossing::Crossing;
pub(crate) use crossing::PairKey;
pub use near::ProximityPair;
pub(crate) use report::Blocker;
pub use report::{ContactCounts, ContactSeconds};
pub(crate) use settings::ContactSettings;
pub use settings::Thickness;
pub(crate) use solver::ContactSolver;
