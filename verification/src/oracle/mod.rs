//! Exact answers for points that move linearly during a step, and for meshes at rest.
//!
//! Every `f64` is a rational number, so each question below has one true answer, and these functions
//! give it: no rounding, no tolerance, no case left out. They are total over finite input:
//! zero-length edges, zero-area triangles, parallel edges, coplanar motion and no motion at all
//! included; NaN and infinities panic.
//!
//! | question | function |
//! |---|---|
//! | are four moving points coplanar at some time in \[0, 1\]? | [`coplanar`] |
//! | does a primitive pair collide, and when first? | [`collides`] |
//! | does it come within a distance, and when first? | [`within`], [`first_within`] |
//! | is it within a distance at some time, or where it rests? | [`within_at`], [`within_at_rest`] |
//! | do two triangles at rest intersect? | [`triangles_intersect`] |
//! | which triangles of a mesh intersect? | [`mesh_self_intersections`], [`mesh_intersections`] |
//! | and which ropes, at rest and on their way? | [`intersections_with_loose_edges`], [`edges_that_meet`] |
//!
//! The method is kept apart from that of `selvedge-core`: numbers of any length are rug's, coordinates are scaled to integers, motions
//! are polynomials in the time `t` by powers of `t`, roots are counted with Sturm's theorem, and a
//! time that is irrational is a polynomial together with an interval that holds one of its roots
//! ([`AlgebraicTime`]). Of meshes at rest most pairs are settled by Shewchuk's exact signs first
//! ([`triangles_intersect_by_signs`]).

mod algebraic;
mod collision;
mod geometry;
mod mesh;
mod motion;
mod polynomial;
mod ropes;
mod separation;
mod signs;

pub use algebraic::AlgebraicTime;
pub use collision::{collides, coplanar, touches_at};
pub use mesh::{mesh_intersections, mesh_self_intersections, triangles_intersect};
pub use motion::{Pair, PairKind};
pub use polynomial::Polynomial;
pub use ropes::{edges_that_meet, intersections_with_loose_edges};
pub use separation::{first_within, within, within_at, within_at_rest};
pub use signs::triangles_intersect_by_signs;
