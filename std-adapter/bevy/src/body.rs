//! The components of what collides.

use bevy_asset::Handle;
use bevy_ecs::component::Component;
use bevy_mesh::Mesh;
use bevy_transform::components::Transform;
use selvedge::Groups;

/// An entity whose mesh collides: that of its [`CollisionMesh`], or else of its `Mesh3d`.
///
/// It takes part from the first fixed step on in which it has both, and its mesh is loaded; where it is then is where it starts.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq, Eq)]
#[require(Transform, CollisionGroups)]
pub enum CollisionBody {
    /// Stays where it is. A new `Transform` puts it elsewhere, without a way in between on which it would meet anything.
    #[default]
    Fixed,
    /// Moves as one body, with its `Transform` and those of its ancestors: in a step from where it was at the end of the step before to where it is
    /// now, on arcs if it turns. Its pivot, the mesh's origin, moves straight.
    ///
    /// To put it elsewhere without a way in between let it be `Fixed` for a step.
    ///
    /// While its scale changes its vertices move straight, and its hierarchies are built anew each step.
    Rigid,
    /// Each vertex moves straight from where it was to where it is now: the mesh's positions may change each step, and so may its `Transform`.
    /// It can meet itself.
    Deforming,
}

/// The mesh that collides, where it is not the one that is seen: a coarser one, say.
#[derive(Component, Clone, Debug)]
pub struct CollisionMesh(pub Handle<Mesh>);

/// Which other bodies this one is looked at with; at first all. With itself as well: a [`Deforming`](CollisionBody::Deforming) body that is in
/// no group that it collides with does not meet itself.
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
