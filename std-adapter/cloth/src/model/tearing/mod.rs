//! Tearing of cloth along its edges.
//!
//! ```text
//! positions ─▶ tension of each triangle ─▶ load of each edge ─▶ edges above their strength ─▶ vertices with more fans ─▶ copies, opened a little
//!              loads                                            choice                        fans                       opening
//! ```
//!
//! A **fan** of a vertex is a group of its triangles connected by edges that are not torn. A vertex is split if torn edges
//! increase the number of its fans: one fan keeps it, each other gets a copy. So a tear begins with one edge at the border, or
//! with two at a vertex within the cloth. It advances from its ends. A piece falls off when the tear reaches the border. Pinned
//! vertices are never split.
//!
//! This is fracture after O'Brien and Hodgins 1999 without remeshing. Splits are snapped to edges as Müller and Gross 2004 snap
//! them to faces (both from memory). So the path of a tear depends on the mesh. Each edge has a load, instead of an eigenvector
//! at a vertex. So a strength can be compared with measured strengths of seams and tears, in newtons per metre.
//!
//! **At most an edge per step at each end of a tear**, since a tear changes the loads around it only in the next step. If several
//! edges share a triangle at a split vertex, the most loaded one tears.

mod choice;
mod fans;
mod loads;
mod opening;

pub(crate) use choice::Tear;
pub(crate) use loads::Tearable;
pub(crate) use opening::open;

use serde::{Deserialize, Serialize};

/// An edge that has torn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TornEdge {
    /// The cloth's index in the scene.
    pub cloth: usize,
    /// Its ends, as the cloth's mesh in the scene numbers them.
    pub vertices: [u32; 2],
    /// The end of the step after which it tore, in seconds.
    pub time: f64,
    /// Its load, in N per metre of its length at rest.
    pub load: f64,
}
