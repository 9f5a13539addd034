//! Exact answers for points that move linearly during a step, and for meshes at rest.
//!
//! Every `f64` is a rational number, so each question below has one true answer. These functions return it, without rounding or
//! tolerance, for all finite input. This includes edges of no length, triangles of no area, parallel edges, coplanar motion and
//! no motion. They panic on NaN and infinity.
//!
//! | question | function |
//! |---|---|
//! | are four moving points coplanar at some time in \[0, 1\]? | [`are_ever_coplanar`] |
//! | does a primitive pair collide, and when first? | [`collides`] |
//! | does it come within a distance, and when first? | [`within`], [`first_within`] |
//! | is it within a distance at some time, or where it rests? | [`within_at`], [`within_at_rest`] |
//! | do two triangles at rest intersect? | [`triangles_intersect`] |
//! | which triangles of a mesh intersect? | [`mesh_self_intersections`], [`mesh_intersections`] |
//! | and which ropes, at rest and on their way? | [`intersections_with_loose_edges`], [`edges_that_meet`] |
//! | which signs have the control values of the volume, and which separations do they exceed? | [`InRationals`] |
//! | does a segment meet a box? | [`segment_meets_box`] |
//! | where is a point of a rotating body? | `arcs` (feature `screw-motions`), in numbers of 256 bits |
//!
//! The method shares nothing with that of `selvedge-core`. Numbers of any length are rug's, and coordinates are scaled to
//! integers. Motions are polynomials in the time `t`, by powers of `t`, and Sturm's theorem counts their roots. An irrational
//! time is a polynomial together with an interval that holds one of its roots ([`AlgebraicTime`]). Shewchuk's exact signs decide
//! most pairs of a mesh at rest first ([`triangles_intersect_by_signs`]).

mod algebraic;
#[cfg(feature = "screw-motions")]
pub mod arcs;
mod collision;
mod geometry;
mod mesh;
mod motion;
mod polynomial;
mod ropes;
mod segment;
mod separation;
mod signs;
pub(crate) mod volume;

pub use algebraic::AlgebraicTime;
pub use collision::{are_ever_coplanar, collides, touches_at};
pub use mesh::{mesh_intersections, mesh_self_intersections, triangles_intersect};
pub use motion::{Pair, PairKind, points_of_first, side_of};
pub use polynomial::Polynomial;
pub use ropes::{edges_that_meet, intersections_with_loose_edges};
pub use segment::segment_meets_box;
pub use separation::{first_within, within, within_at, within_at_rest};
pub use signs::triangles_intersect_by_signs;
pub use volume::{InRationals, rational};
