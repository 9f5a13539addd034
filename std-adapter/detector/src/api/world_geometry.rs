//! The geometry of contacts between the meshes of a world.

use super::world::World;
use super::world_contacts::{WorldContact, WorldContactGeometry};
use super::world_error::WorldError;
use crate::engine::world::{VertexPath, vertex_paths, vertices_of};
use crate::parallel;
use crate::step::StepError;
use selvedge_core::paths::{self, Path};
use selvedge_core::separation::geometry::geometry;
use selvedge_core::{Position, PrimitivePair, Scalar};

impl<P: Position> World<P> {
    /// Returns the geometry of a contact of the last step, at its time.
    ///
    /// The world keeps the motions of the last step only. For straight motion the result is that of a
    /// [detector](crate::CollisionDetector::contact_geometry) for the two meshes as one, bit for bit.
    ///
    /// ```
    /// use selvedge::glam::{DQuat, DVec3};
    /// use selvedge::{Groups, MeshMotion, Topology, World};
    ///
    /// // A plank tips over, and its tip comes down on a floor.
    /// let mut world = World::<DVec3>::new();
    /// let floor = [DVec3::new(-9.0, -9.0, 0.0), DVec3::new(9.0, -9.0, 0.0), DVec3::new(0.0, 9.0, 0.0)];
    /// let floor = world.insert(Topology::new(3, vec![[0, 1, 2]])?, &floor, Groups::ALL)?;
    /// let plank = [DVec3::new(-2.0, 0.1, 0.0), DVec3::new(-2.0, -0.1, 0.0), DVec3::new(2.0, 0.0, 0.0)];
    /// let plank = world.insert(Topology::new(3, vec![[0, 1, 2]])?, &plank, Groups::ALL)?;
    /// let start = (DQuat::IDENTITY, DVec3::Z);
    /// let end = (DQuat::from_rotation_y(1.0), DVec3::Z);
    ///
    /// let first = world.earliest(&[(plank, MeshMotion::Rigid { start, end })])?.expect("a contact");
    /// let found = world.contact_geometry(&first)?;
    /// assert_eq!((found.meshes, found.vertices), ([plank, floor], [2, 0, 1, 2]));
    /// // Straight up from the floor at the tip, which is √3 from the middle and has a speed of √3.
    /// assert_eq!(found.geometry.normal, Some(DVec3::Z));
    /// assert!((found.geometry.points[0] - 3.0_f64.sqrt() * DVec3::X).length() < 1e-5);
    /// assert!((found.geometry.speed + 3.0_f64.sqrt()).abs() < 1e-5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if a mesh was removed, the two meshes do not have the pair, or the time is not in [0, 1].
    pub fn contact_geometry(&self, contact: &WorldContact<P::Scalar>) -> Result<WorldContactGeometry, WorldError> {
        let vertices = self.vertices_in_step(contact)?;
        let &WorldContact { kind, meshes, pair, .. } = contact;
        let [first, second] = meshes.map(|mesh| self.mesh(mesh));
        let both = [first?, second?];
        let turning = both.map(|mesh| mesh.moves.turning());
        let paths = vertex_paths(both.map(|mesh| &mesh.hierarchies), &turning, kind, vertices);
        let time = contact.time.to_f64();
        let geometry = match paths.each_ref().map(VertexPath::straight) {
            [Some(a), Some(b), Some(c), Some(d)] => {
                let motions = [a, b, c, d];
                geometry(&PrimitivePair { kind, motions }, time)
            }
            _ => paths::geometry(kind, paths.each_ref().map(|path| path as &dyn Path), time),
        };
        Ok(WorldContactGeometry {
            kind,
            meshes,
            pair,
            vertices,
            geometry,
        })
    }

    /// Returns the vertices of a contact, numbered as in their meshes: the vertex and the face's corners, or the ends of both
    /// edges.
    ///
    /// # Errors
    /// Returns an error if a mesh was removed, or the two meshes do not have the pair.
    pub fn vertices_of(&self, contact: &WorldContact<P::Scalar>) -> Result<[u32; 4], WorldError> {
        let [first, second] = contact.meshes.map(|mesh| self.mesh(mesh));
        let hierarchies = [&first?.hierarchies, &second?.hierarchies];
        let &WorldContact { kind, pair, .. } = contact;
        vertices_of(hierarchies, kind, pair).ok_or(WorldError::Step(StepError::NoSuchPair { kind, pair }))
    }

    /// Replaces `geometries` by those of many contacts of the last step, in their order, on the world's threads.
    ///
    /// Nothing is allocated if `geometries` has room.
    ///
    /// # Errors
    /// Returns the errors of [`contact_geometry`](Self::contact_geometry), for the first invalid contact. `geometries` then
    /// stays.
    pub fn contact_geometries(
        &self,
        contacts: &[WorldContact<P::Scalar>],
        geometries: &mut Vec<WorldContactGeometry>,
    ) -> Result<(), WorldError> {
        contacts
            .iter()
            .try_for_each(|contact| self.vertices_in_step(contact).map(drop))?;
        let known = |contact: &WorldContact<P::Scalar>| self.contact_geometry(contact).expect("checked above");
        self.workers.run(|| parallel::fill(geometries, contacts, known));
        Ok(())
    }

    fn vertices_in_step(&self, contact: &WorldContact<P::Scalar>) -> Result<[u32; 4], WorldError> {
        let vertices = self.vertices_of(contact)?;
        let time = contact.time.to_f64();
        if !(0.0..=1.0).contains(&time) {
            return Err(StepError::BadTime { time }.into());
        }
        Ok(vertices)
    }
}
