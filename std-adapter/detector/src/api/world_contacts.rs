//! Contacts between the meshes of a world.

use crate::engine::world::MeshHandle;
use crate::step::Contact;
use selvedge_core::narrowing::rounded_down;
use selvedge_core::separation::geometry::Geometry;
use selvedge_core::{PairKind, Scalar};

/// A pair of a [`World`](crate::World) that may touch during the step, with the time of its contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldContact<S> {
    /// Vertex–face or edge–edge.
    pub kind: PairKind,
    /// The mesh of the vertex and that of the face, or those of the two edges with the smaller handle first. A mesh that meets
    /// itself comes twice.
    pub meshes: [MeshHandle; 2],
    /// The vertex and the face, or the two edges, as their own meshes number them. Two edges of one mesh come with the smaller
    /// number first.
    pub pair: [u32; 2],
    /// The time in [0, 1] of the step. It is never after the exact time, and hardly before it, as for
    /// [`Contact::time`](crate::Contact::time).
    pub time: S,
}

/// Two primitives of a [`World`](crate::World), their vertices, and their closest points at some time, in `f64` for either format
/// of positions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WorldContactGeometry {
    /// Vertex–face or edge–edge.
    pub kind: PairKind,
    /// The meshes of the [contact](WorldContact::meshes).
    pub meshes: [MeshHandle; 2],
    /// The pair of the [contact](WorldContact::pair).
    pub pair: [u32; 2],
    /// The vertex and the corners of the face, or the ends of both edges, as their own meshes number them.
    pub vertices: [u32; 4],
    /// Points, weights, normal, distance and speed, with the guarantees for [straight
    /// motion](selvedge_core::separation::geometry) or, if a mesh turns, for [arcs](selvedge_core::paths::geometry).
    pub geometry: Geometry,
}

/// Returns a contact in the format of the positions, with its meshes.
pub(super) fn of_meshes<S: Scalar>(meshes: [MeshHandle; 2], contact: &Contact<f64>) -> WorldContact<S> {
    WorldContact {
        kind: contact.kind,
        meshes,
        pair: contact.pair,
        time: rounded_down(contact.time),
    }
}
