//! Contact: cloth with itself and with bodies.
//!
//! | module | what it does |
//! |---|---|
//! | `settings` | what effects ask for |
//! | `search` | candidate pairs: the one place that knows the broad phase |
//! | `sieve` | candidates that keep apart until the next search, neighbours on the mesh among them |
//! | `horizon`, `candidates` | for how many steps they are good, and the list of them |
//! | `candidate`, `closest` | one pair: the direction that keeps it apart, the certified time of impact |
//! | `constraints` | contacts as constraints of the solver |
//! | `pass`, `impact_zones` | no step is accepted that is not certified |
//! | `solver` | all of it, as the simulation calls it |
//! | `start` | whether triangles pass through each other where a simulation starts |
//! | `report` | what was counted, what it took, what was in the way |
//!
//! Pairs may be left out of forces, never out of certificates: neighbours on the mesh are pairs like any other.

mod candidate;
mod candidates;
mod closest;
mod constraints;
mod horizon;
mod impact_zones;
mod pass;
mod report;
mod search;
mod settings;
mod sieve;
mod solver;
mod start;

pub(crate) use pass::LARGEST_TURN;
pub use report::{Blocker, ContactCounts, ContactSeconds};
pub(crate) use settings::{ContactSettings, RECOVERY, Thickness};
pub(crate) use solver::ContactSolver;
