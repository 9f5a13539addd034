//! Coherent motion: finds near pairs for several steps at once and follows them from step to step.
//!
//! A [`CollisionDetector`](crate::CollisionDetector::set_coherent) does this by itself. Use [`NearPairs`] directly in a solver
//! that handles contact. The solver decides which pairs are of [interest](Interest), stores data with each, and keeps pairs apart
//! by stored directions.
//!
//! ```text
//! now and then   hierarchies of moving boxes ─▶ sieve ─▶ the list of near pairs, good for some steps of the expected motion
//! every step     few vertices stray from it: find their pairs again; many stray: find all pairs again
//!                each pair: do its vertices stray far enough? does the remembered direction hold? does another one?
//! remaining      open pairs
//! ```
//!
//! ```
//! use selvedge::coherent::{CLASSES, Class, Interest, NearPairs, Reach};
//! use selvedge::core::separation::gap::GapError;
//! use selvedge::{PairKind, Topology, glam::DVec3};
//! use std::sync::Arc;
//!
//! /// Takes all pairs, and counts for each the steps in which it is held apart.
//! struct All;
//!
//! impl Interest for All {
//!     type Data = u32;
//!
//!     fn class(&self, _: PairKind, _: [u32; 4]) -> usize {
//!         0
//!     }
//!
//!     fn about(&self, _: PairKind, _: [u32; 4]) -> Option<u32> {
//!         Some(0)
//!     }
//! }
//!
//! // A triangle slides above another one.
//! let frame = |step: u32| {
//!     let by = f64::from(step) * DVec3::X * 0.01;
//!     let above = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| corner + DVec3::Z * 0.1 + by);
//!     [[DVec3::ZERO, DVec3::X, DVec3::Y], above].concat()
//! };
//! let topology = Arc::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
//! let reach = Reach {
//!     classes: [Class { distance: 0.15, margin: 0.0 }; CLASSES],
//!     beyond: 0.02,
//!     spare: 0.0,
//!     farthest: 8,
//!     upkeep: 0.1,
//!     is_graded: false,
//! };
//! let mut near = NearPairs::new(topology, All, vec![true; 6], reach)?;
//! let error = GapError::from_largest_coordinate(2.0);
//! for step in 0..20 {
//!     let (start, end) = (frame(step), frame(step + 1));
//!     // The list now holds every pair that comes within the distance.
//!     near.cover(&start, &end, 1.0);
//!     for pair in &mut near.list {
//!         assert!(pair.keeps_apart([&start, &end], 0.05, error));
//!         pair.data += 1;
//!     }
//!     near.advance(1.0);
//! }
//! assert!(near.statistics().searches < 20);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! | source file | contents |
//! |---|---|
//! | `search` | finds near pairs: hierarchies of moving boxes, then the sieve |
//! | `sieve` | drops pairs that keep apart until the next search |
//! | `ahead`, `horizon`, `near` | the number of steps to look ahead, the steps for which pairs are good, and their list |
//! | `parts` | parts of the mesh that are too far from the rest to have pairs |
//! | `known` | looks up pairs that are found again |
//! | `pair` | one pair, and the direction that keeps it apart |
//! | `follow` | the near pairs of a [`CollisionDetector`](crate::CollisionDetector) |
//!
//! All certificates are [core's](selvedge_core::separation): directions, clearances and courses, with their derivations.

mod ahead;
mod follow;
mod horizon;
mod interest;
mod known;
mod near;
mod pair;
mod parts;
mod search;
mod sieve;

pub(crate) use follow::{ENORMOUS, Followed};
pub use interest::{CLASSES, Class, Interest, Reach};
pub use near::{NearPairs, NearStatistics};
pub use pair::NearPair;
