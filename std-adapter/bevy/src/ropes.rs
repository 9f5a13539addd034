//! Ropes, laces and fringes of a cloth, rendered as tubes.

use crate::cloth::ClothSimulation;
use crate::error::tell;
use crate::place::Places;
use crate::seen::write;
use crate::{SelvedgeError, SelvedgeProblem};
use bevy_asset::{AssetId, Assets};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::MessageWriter;
use bevy_ecs::system::{Query, ResMut};
use bevy_mesh::{Indices, Mesh, Mesh3d, PrimitiveTopology};
use bevy_transform::components::Transform;
use selvedge::glam::DVec3;
use selvedge_cloth::{Simulation, Tubes, vertex_normals};

/// Shows the ropes, laces and fringes of another entity's [`ClothSimulation`] in the `Mesh3d` of this one, as closed tubes. Their
/// diameter is the distance that `self_collision` keeps.
///
/// The mesh is replaced when the simulation starts, by triangles with positions and normals, and written in each step. The
/// entity's `Transform` does not move the ropes.
///
/// ```
/// use bevy_asset::{Assets, RenderAssetUsages};
/// use bevy_ecs::world::World;
/// use bevy_mesh::{Mesh, Mesh3d, PrimitiveTopology};
/// use selvedge_bevy::{ClothSimulation, RopesOf};
/// use selvedge_bevy::selvedge_cloth::{Cloth, Scene, effects::*, glam::DVec3};
///
/// let mut world = World::new();
/// let mut meshes = Assets::<Mesh>::default();
/// let mut scene = Scene::new(Cloth::rope(&[DVec3::ZERO, DVec3::X], 40, 0.05)?, 4e-3);
/// scene.add(Gravity { acceleration: DVec3::NEG_Y * 9.81 }).add(RopeStretch::new(1e4));
/// scene.add(SelfCollision(Thickness::new(8e-3)));
/// let rope = world.spawn(ClothSimulation::new(scene)).id();
/// let seen = meshes.add(Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::all()));
/// world.spawn((RopesOf::new(rope), Mesh3d(seen)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Component, Debug)]
#[require(Transform)]
pub struct RopesOf {
    cloth: Entity,
    /// The tubes of these triangles. They change if the entity receives another simulation.
    tubes: Vec<(usize, Tubes)>,
    made: Option<AssetId<Mesh>>,
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<DVec3>,
    /// The last problem.
    told: Option<SelvedgeError>,
}

impl RopesOf {
    /// Shows the ropes of this entity's cloth.
    #[must_use]
    pub const fn new(cloth: Entity) -> Self {
        Self {
            cloth,
            tubes: Vec::new(),
            made: None,
            positions: Vec::new(),
            triangles: Vec::new(),
            normals: Vec::new(),
            told: None,
        }
    }

    /// Returns the entity whose ropes it shows.
    #[must_use]
    pub const fn cloth(&self) -> Entity {
        self.cloth
    }

    fn look(&mut self, tubes: &[(usize, Tubes)], simulation: &Simulation) {
        self.positions.clear();
        let is_new = self.tubes != tubes;
        if is_new {
            self.tubes = tubes.to_vec();
            self.made = None;
            self.triangles.clear();
        }
        for (cloth, own) in tubes {
            let vertices = simulation.vertices_of_cloth(*cloth).unwrap_or_default();
            if is_new {
                self.triangles.extend(own.triangles(self.positions.len() as u32));
            }
            own.place(&simulation.positions()[vertices], &mut self.positions);
        }
        vertex_normals(&self.positions, &self.triangles, &mut self.normals);
    }

    /// Returns the mesh. Creates it again unless it has these triangles.
    fn prepare(&mut self, id: AssetId<Mesh>, mesh: &mut Mesh) {
        let corners = mesh.try_indices().map_or(0, Indices::len);
        if self.made != Some(id) || corners != 3 * self.triangles.len() {
            *mesh = Mesh::new(PrimitiveTopology::TriangleList, mesh.asset_usage)
                .with_inserted_indices(Indices::U32(self.triangles.as_flattened().to_vec()));
            self.made = Some(id);
        }
    }
}

pub(crate) fn show_ropes(
    mut all: Query<'_, '_, (Entity, &mut RopesOf, &Mesh3d)>,
    cloths: Query<'_, '_, &ClothSimulation>,
    places: Places<'_, '_>,
    mut meshes: ResMut<'_, Assets<Mesh>>,
    mut problems: MessageWriter<'_, SelvedgeProblem>,
) {
    for (entity, mut ropes, seen) in &mut all {
        let ropes = &mut *ropes;
        let result = match cloths.get(ropes.cloth) {
            Err(_) => Err(SelvedgeError::NoCloth { entity: ropes.cloth }),
            Ok(cloth) => match cloth.simulation() {
                None => Ok(()),
                Some(_) if cloth.tubes().is_empty() => Err(SelvedgeError::NoRopes { entity: ropes.cloth }),
                Some(simulation) => places.of(entity).and_then(|place| match meshes.get_mut(&seen.0) {
                    None => Ok(()),
                    Some(mut mesh) => {
                        ropes.look(cloth.tubes(), simulation);
                        ropes.prepare(seen.0.id(), &mut mesh);
                        let vertices = ropes.positions.iter().copied().zip(ropes.normals.iter().copied());
                        write(&mut mesh, place, vertices)
                    }
                }),
            },
        };
        let error = result.err();
        if ropes.told != error {
            ropes.told.clone_from(&error);
            if let Some(error) = error {
                tell(&mut problems, Some(entity), error);
            }
        }
    }
}
