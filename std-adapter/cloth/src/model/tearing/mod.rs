//! Cloth that tears along its edges.
//!
//! ```text
//! positions ─▶ tension of each triangle ─▶ load of each edge ─▶ edges above their strength ─▶ vertices whose fans they part ─▶ copies, opened a little
//!              loads                                            choice                        fans                             opening
//! ```
//!
//! A **fan** of a vertex is what hangs together of its triangles by edges that are not torn. A vertex of which torn edges make more fans than
//! there were is split: one fan keeps it, each other gets a copy. So a tear begins at the border with one edge, within the cloth with two at a
//! vertex, and goes on from its ends; when it comes to the border a piece falls off. Pinned vertices are never split.
//!
//! That is fracture after O'Brien and Hodgins 1999 without remeshing, the split snapped to edges as Müller and Gross 2004 snap it to faces (both
//! from memory): where a tear goes depends on the mesh as far as its edges go. Here the load is that of each edge instead of an eigenvector at a
//! vertex, so that a strength can be compared with what is measured of a fabric's seams and tears, in newtons for each metre.
//!
//! **At most an edge a step at each end of a tear**: what a tear does to the loads around it is known after the next step only. Of edges that
//! share a triangle at a split vertex the one tears that is loaded most.

mod choice;
mod fans;
mod loads;
mod opening;

pub(crate) use choice::Tear;
pub(crate) use loads::Tearable;
pub(crate) use opening::open;

/// An edge that has torn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TornEdge {
    /// The cloth, in the order of the scene.
    pub cloth: usize,
    /// Its ends, as the cloth's mesh in the scene numbers them.
    pub vertices: [u32; 2],
    /// When the step had ended after which it tore, in seconds.
    pub time: f64,
    /// What it was loaded with, in N for each metre of its length at rest.
    pub load: f64,
}
