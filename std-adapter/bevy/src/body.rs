//! The components of colliding entities.

use bevy_asset::Handle;
use bevy_ecs::component::Component;
use bevy_mesh::Mesh;
use bevy_transform::components::Transform;
use selvedge::Groups;

/// An entity whose mesh collides. The mesh is that of its [`CollisionMesh`], or otherwise of its `Mesh3d`.
///
/// It takes part from the first fixed step in which it has a loaded mesh, and starts where it is then.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[require(Transform, CollisionGroups)]
pub enum CollisionBody {
    /// The body rests. A new `Transform` places it elsewhere, without contacts on the way.
    #[default]
    Fixed,
    /// The body moves as a rigid body, with its `Transform` and those of its ancestors. A step leads from its place at the end of
    /// the previous step to its current place. Vertices move on arcs if it rotates. Its pivot, the mesh's origin, moves straight.
    ///
    /// Make it `Fixed` for a step to place it elsewhere without contacts on the way.
    ///
    /// While its scale changes, its vertices move straight, and its hierarchies are built again in each step.
    Rigid,
    /// The body deforms. Each vertex moves straight from its previous to its current position; the mesh and the `Transform` may
    /// change in each step. The body can meet itself.
    Deforming,
}

/// The mesh that collides, if it differs from the rendered one, such as a coarser mesh.
#[derive(Component, Clone, Debug)]
pub struct CollisionMesh(pub Handle<Mesh>);

/// The bodies that this one can collide with; the default is all. A [`Deforming`](CollisionBody::Deforming) body does not meet
/// itself if it is in none of the groups that it collides with.
///
/// ```
/// use selvedge_bevy::{CollisionGroups, Groups};
///
/// const FIGURE: u32 = 1;
/// const CLOTH: u32 = 2;
/// // Parts of a figure that may overlap each other.
/// let part = CollisionGroups(Groups::new(FIGURE, CLOTH));
/// assert!(!part.0.collide(part.0));
/// ```
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CollisionGroups(pub Groups);
