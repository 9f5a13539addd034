//! Loose edges in a step: ropes, laces and fringes that resist being stretched and bent.
//!
//! ```text
//! loose edges ──▶ runs, from where one begins, ends or branches to the next ──▶ pieces ──▶ each solved at once, in O(vertices)
//! ```
//!
//! A pull goes along a rope faster than along cloth, and there is but one way for it: what one sweep over the edges does is forgotten
//! before it arrives (a rope of 200 edges would be as soft as rubber). But edges one after the other give equations in which each vertex
//! knows only its neighbours, and elimination from one end to the other solves these exactly. So each piece of a rope does one implicit step of
//! its own: [`Stretching`], and [`Bending`]. Pieces that meet at a vertex follow each other.

mod bending;
mod stretching;

pub(crate) use bending::Bending;
pub(crate) use stretching::Stretching;
