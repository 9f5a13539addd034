//! Loose edges in a step: ropes, laces and fringes with stretch and bending resistance.
//!
//! ```text
//! loose edges ──▶ runs, from where one begins, ends or branches to the next ──▶ pieces ──▶ each solved directly, in O(vertices)
//! ```
//!
//! A pull travels along a rope faster than along cloth, and only one way. One sweep over the edges would lose it (a rope of 200
//! edges would be as soft as rubber). But in the equations of a row of edges each vertex couples only with its neighbours.
//! Elimination from one end to the other solves them exactly. So each piece of a rope does one implicit step of its own:
//! [`Stretching`], then [`Bending`]. Pieces that meet at a vertex are solved one after the other.

mod bending;
mod stretching;

pub(crate) use bending::Bending;
pub(crate) use stretching::Stretching;
