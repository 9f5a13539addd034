//! Cloth simulations whose bodies follow entities.

use crate::error::tell;
use crate::place::{Place, Places};
use crate::seen::write;
use crate::shape::{RenderMeshError, Shape, positions_of, triangles_of};
use crate::{EngineBody, SelvedgeError, SelvedgeProblem};
use bevy_asset::{Assets, RenderAssetUsages};
use bevy_ecs::component::Component;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::MessageWriter;
use bevy_ecs::system::{Query, Res, ResMut};
use bevy_mesh::{Indices, Mesh, Mesh3d, PrimitiveTopology};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use selvedge::glam::{DMat3, DVec3};
use selvedge_cloth::{
    Body, BodyMotion, Cloth, FrameError, FrameSteps, Placement, Scene, Simulation, TeleportError, Tubes, ValueError,
    vertex_normals,
};
use std::collections::BTreeMap;

/// A simulation of cloth that runs in each fixed step, from a [`Scene`] made in code or read from a file.
///
/// The scene is in world coordinates, in metres. Its bodies can [follow](Self::led_by) entities. The positions and normals of the
/// cloth are written into the entity's own `Mesh3d`, if it has one. This is a mesh from [`mesh_of`], from [`mesh_of_cloths`], or
/// the one that was passed to [`cloth_of_mesh`]. No other entity should have the same mesh. The entity's `Transform` does not
/// move the cloth.
///
/// When cloth tears, its mesh receives one vertex per corner of a triangle, with all attributes. This needs the triangles in the
/// cloth's order, as [`cloth_of_mesh`] and [`mesh_of`] have them.
///
/// A fixed step is a [frame](Simulation::advance): it takes as many steps as the cloth needs, and the scene's own time step has
/// no part in it.
///
/// ```
/// use bevy_ecs::world::World;
/// use bevy_transform::components::Transform;
/// use selvedge_bevy::ClothSimulation;
/// use selvedge_bevy::selvedge_cloth::{Body, Cloth, OnBlocked, Scene, effects::*, glam::DVec3};
///
/// let mut world = World::new();
/// let ball = world.spawn(Transform::default()).id();
/// let corner = DVec3::new(-0.15, 0.12, -0.15);
/// let mut scene = Scene::new(Cloth::sheet(corner, [DVec3::Z * 0.3, DVec3::X * 0.3], [20, 20], 0.2)?, 4e-3);
/// scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.1, 24)?);
/// scene.add(Gravity { acceleration: DVec3::NEG_Y * 9.81 }).add(Stretch::isotropic(1000.0));
/// scene.add(BodyContact(Thickness::new(4e-3))).add(SelfCollision(Thickness::new(4e-3)));
/// scene.on_blocked = OnBlocked::Yield;
/// world.spawn(ClothSimulation::new(scene).led_by(0, ball));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Component, Debug)]
#[require(Transform)]
pub struct ClothSimulation {
    state: State,
    /// The entities that bodies follow, by the index of the body.
    leaders: BTreeMap<usize, Entity>,
    /// The entities that follow free bodies, by the index of the body.
    followers: BTreeMap<usize, Entity>,
    threads: usize,
    /// The tubes of cloths with loose edges, by the index of the cloth, once it runs.
    tubes: Vec<(usize, Tubes)>,
    /// The cloth's vertex of each vertex of the rendered mesh.
    vertices: Option<Vec<u32>>,
    /// The number of torn edges when this list was made.
    torn: usize,
    normals: Vec<DVec3>,
    /// The seconds of the last fixed step, if the cloth has made it.
    advanced: Option<f64>,
    told: BTreeMap<Part, SelvedgeError>,
}

#[derive(Debug)]
enum State {
    /// The scene, until the first step.
    Planned(Box<Scene>),
    Running(Box<Simulation>),
    /// The last state, if the simulation ever ran.
    Ended(Option<Box<Simulation>>),
}

/// The subject of a problem. Each problem is reported once until it is fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Part {
    Whole,
    TimeStep,
    Seen,
    Body(usize),
    Follower(usize),
}

impl ClothSimulation {
    /// Creates a simulation of a scene, on one thread. It starts in the first fixed step in which all followed entities have a
    /// place; errors are reported then.
    #[must_use]
    pub fn new(scene: Scene) -> Self {
        Self {
            state: State::Planned(Box::new(scene)),
            leaders: BTreeMap::new(),
            followers: BTreeMap::new(),
            threads: 1,
            tubes: Vec::new(),
            vertices: None,
            torn: 0,
            normals: Vec::new(),
            advanced: None,
            told: BTreeMap::new(),
        }
    }

    /// Lets a body of the scene, given by its index, follow an entity. Its `BodyMotion` becomes [`Driven`](BodyMotion::Driven),
    /// from the entity's place at the start.
    ///
    /// If the entity is a body of a physics engine with an [`EngineBody`](crate::EngineBody), cloth pushes it. Otherwise the body
    /// moves in a fixed step to the place of the entity at a constant rate, and rotates the short way about the entity's
    /// origin. An entity that jumps is a problem, and the cloth rests until it is back: call [`teleport`](Self::teleport). If the
    /// entity loses its `Transform` or is despawned, the body stays where it is.
    #[must_use]
    pub fn led_by(mut self, body: usize, entity: Entity) -> Self {
        self.leaders.insert(body, entity);
        self
    }

    /// Lets an entity follow a free body of the scene, given by its index: one with a [`FreeMotion`](selvedge_cloth::FreeMotion),
    /// or with a `mass` or a `density` in a file.
    ///
    /// After each fixed step, before contacts are found, the entity's `Transform` is where the body is; its scale stays. So the
    /// entity may show the body's mesh ([`mesh_of`]) and be a [`CollisionBody`](crate::CollisionBody). Its ancestors may move.
    #[must_use]
    pub fn followed_by(mut self, body: usize, entity: Entity) -> Self {
        self.followers.insert(body, entity);
        self
    }

    /// Sets the number of threads (0: one for each core). It changes no bit of the result.
    #[must_use]
    pub const fn on_threads(mut self, threads: usize) -> Self {
        self.threads = threads;
        self
    }

    /// Returns the simulation; `None` until it has started, and if it could not start. Its
    /// [`mean_body_load`](Simulation::mean_body_load) is the force and the torque of the cloth on a body in the last fixed step,
    /// and its [`body_motion`](Simulation::body_motion) the velocity and the spin of a free body.
    #[must_use]
    pub fn simulation(&self) -> Option<&Simulation> {
        match &self.state {
            State::Planned(_) => None,
            State::Running(simulation) => Some(simulation),
            State::Ended(simulation) => simulation.as_deref(),
        }
    }

    /// Returns the simulation, to set the wind, to [push](Simulation::add_force) vertices in the next fixed step, or to move pins
    /// and deforming bodies. The plugin runs the steps.
    #[must_use]
    pub fn simulation_mut(&mut self) -> Option<&mut Simulation> {
        match &mut self.state {
            State::Planned(_) => None,
            State::Running(simulation) => Some(simulation),
            State::Ended(simulation) => simulation.as_deref_mut(),
        }
    }

    /// Moves all bodies that [follow](Self::led_by) entities elsewhere at once, and with them the cloth that hangs on them and
    /// `cloths`, given by their indices, such as a garment without pins. See [`Simulation::teleport`]. It does nothing before the
    /// simulation has started.
    ///
    /// Move the entities by the same `by` in the same fixed step: a body that has to follow faster than 100 m/s stays, and is
    /// reported.
    ///
    /// # Errors
    /// Returns an error, and changes nothing, if something else holds the cloth, or there is no room.
    pub fn teleport(&mut self, cloths: &[usize], by: Placement) -> Result<(), TeleportError> {
        let bodies: Vec<usize> = self.leaders.keys().copied().collect();
        match &mut self.state {
            State::Running(simulation) => simulation.teleport(&bodies, cloths, by),
            State::Planned(_) | State::Ended(_) => Ok(()),
        }
    }

    /// Returns the tubes of ropes, laces and fringes, by the index of their cloth.
    pub(crate) fn tubes(&self) -> &[(usize, Tubes)] {
        &self.tubes
    }

    /// Returns the entities that bodies follow.
    #[cfg(any(feature = "avian", feature = "rapier"))]
    pub(crate) fn leading_entities(&self) -> impl Iterator<Item = Entity> {
        self.leaders.values().copied()
    }

    /// Returns the bodies that cloth pushes in a physics engine, with their entities.
    pub(crate) fn pushed(&self) -> impl Iterator<Item = (usize, Entity)> {
        let simulation = self.simulation();
        let leaders = self.leaders.iter().map(|(&body, &entity)| (body, entity));
        leaders.filter(move |(body, _)| simulation.is_some_and(|simulation| simulation.proxy_load(*body).is_some()))
    }

    /// Returns the seconds of the last fixed step, if the cloth has made it.
    pub(crate) const fn advanced(&self) -> Option<f64> {
        self.advanced
    }

    pub(crate) const fn followers(&self) -> &BTreeMap<usize, Entity> {
        &self.followers
    }

    /// Returns the error unless it was the last report on the entity that follows this body.
    pub(crate) fn is_new_of_follower(&mut self, body: usize, result: Result<(), SelvedgeError>) -> Option<SelvedgeError> {
        self.is_new(Part::Follower(body), result)
    }

    /// Returns whether it has stopped: its set-up failed, or it is blocked and its scene stops then.
    #[must_use]
    pub const fn has_ended(&self) -> bool {
        matches!(self.state, State::Ended(_))
    }

    /// Returns whether this differs from the last report on that subject.
    fn is_new(&mut self, part: Part, result: Result<(), SelvedgeError>) -> Option<SelvedgeError> {
        match result {
            Ok(()) => {
                self.told.remove(&part);
                None
            }
            Err(error) if self.told.get(&part) == Some(&error) => None,
            Err(error) => {
                self.told.insert(part, error.clone());
                Some(error)
            }
        }
    }
}

/// Creates a Bevy mesh for rendering from [`Cloth::mesh`] or a body's mesh: positions, smooth normals and triangles. The material
/// of a cloth should be double-sided.
#[must_use]
pub fn mesh_of(mesh: &selvedge::Mesh) -> Mesh {
    let mut normals = Vec::new();
    vertex_normals(&mesh.positions, &mesh.triangles, &mut normals);
    let rounded = |all: &[DVec3]| -> Vec<[f32; 3]> { all.iter().map(|own| own.as_vec3().to_array()).collect() };
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::all())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, rounded(&mesh.positions))
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, rounded(&normals))
        .with_inserted_indices(Indices::U32(mesh.triangles.as_flattened().to_vec()))
}

/// Creates a Bevy mesh with all cloths of a scene, one after the other. Ropes have no triangles; [`RopesOf`](crate::RopesOf)
/// shows them.
#[must_use]
pub fn mesh_of_cloths(scene: &Scene) -> Mesh {
    let mut all = selvedge::Mesh::new(Vec::new(), Vec::new());
    for own in scene.cloths.iter().map(Cloth::mesh) {
        let first = all.positions.len() as u32;
        all.positions.extend(&own.positions);
        all.triangles
            .extend(own.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex)));
    }
    mesh_of(&all)
}

/// Creates a cloth at rest from a Bevy mesh, in metres and in world coordinates. Vertices at the same position become one vertex,
/// in the order of the first of each. `warp` and `density` are those of [`Cloth::from_mesh`].
///
/// # Errors
/// Returns an error if the mesh does not consist of triangles with positions, or cannot be cloth.
pub fn cloth_of_mesh(mesh: &Mesh, warp: DVec3, density: f64) -> Result<Cloth, ClothMeshError> {
    Ok(Cloth::from_mesh(joined(mesh)?, warp, density)?)
}

/// Creates a body from a Bevy mesh. It can [follow](ClothSimulation::led_by) the entity with that mesh.
///
/// # Errors
/// Returns an error if the mesh does not consist of triangles with positions.
pub fn body_of_mesh(name: &str, mesh: &Mesh) -> Result<Body, RenderMeshError> {
    Ok(Body::from_mesh(name, joined(mesh)?))
}

/// The reason why a Bevy mesh cannot be cloth.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ClothMeshError {
    /// The mesh cannot be read.
    #[error("the mesh cannot be cloth: {0}")]
    Mesh(#[from] RenderMeshError),
    /// The cloth is invalid, for example because of triangles without area.
    #[error(transparent)]
    Value(#[from] ValueError),
}

fn joined(mesh: &Mesh) -> Result<selvedge::Mesh, RenderMeshError> {
    let shape = Shape::of(mesh)?;
    let positions = positions_of(mesh)?
        .iter()
        .map(|position| DVec3::from_array(position.map(f64::from)));
    Ok(selvedge::Mesh::new(
        shape.of_points(&positions.collect::<Vec<_>>()),
        shape.topology.triangles().to_vec(),
    ))
}

/// Moves bodies to their entities, runs the steps, and writes meshes.
pub(crate) fn step_cloths(
    mut cloths: Query<'_, '_, (Entity, &mut ClothSimulation, Option<&Mesh3d>)>,
    places: Places<'_, '_>,
    engine_bodies: Query<'_, '_, &EngineBody>,
    time: Res<'_, Time<Fixed>>,
    mut meshes: ResMut<'_, Assets<Mesh>>,
    mut problems: MessageWriter<'_, SelvedgeProblem>,
) {
    let fixed = time.timestep().as_secs_f64();
    for (entity, mut cloth, seen) in &mut cloths {
        let mut met = Met::new();
        let leading = cloth.leading(&places, &engine_bodies, &mut met);
        cloth.advance(&leading, fixed, &mut met);
        if let (Some(_), Some(seen)) = (cloth.simulation(), seen) {
            let written = places.of(entity).and_then(|place| match meshes.get_mut(&seen.0) {
                Some(mut mesh) => cloth.write(place, &mut mesh),
                None => Ok(()),
            });
            met.insert(Part::Seen, written);
        }
        for (part, result) in met {
            if let Some(error) = cloth.is_new(part, result) {
                tell(&mut problems, Some(entity), error);
            }
        }
    }
}

/// The placements of entities that bodies follow, and their bodies in a physics engine.
type Leading = BTreeMap<usize, (Placement, Option<EngineBody>)>;

/// The attempts of a fixed step and their results.
type Met = BTreeMap<Part, Result<(), SelvedgeError>>;

impl ClothSimulation {
    fn leading(&self, places: &Places<'_, '_>, engine_bodies: &Query<'_, '_, &EngineBody>, met: &mut Met) -> Leading {
        let mut leading = Leading::new();
        for (&body, &leader) in &self.leaders {
            let place = places.of(leader).and_then(|place| {
                let is_unscaled = place.has_form_of(&Place {
                    form: DMat3::IDENTITY,
                    ..place
                });
                if is_unscaled {
                    Ok(place)
                } else {
                    Err(SelvedgeError::ScaledLeader { entity: leader })
                }
            });
            let result = place.map(|place| {
                let (rotation, translation) = place.pose();
                let engine_body = engine_bodies.get(leader).ok().copied();
                // An engine may know the mass only after its next step.
                if engine_body.is_none_or(|engine_body| engine_body.mass > 0.0) {
                    leading.insert(body, (Placement { rotation, translation }, engine_body));
                }
            });
            met.insert(Part::Body(body), result);
        }
        leading
    }

    /// Runs through a fixed step of this many seconds.
    fn advance(&mut self, leading: &Leading, fixed: f64, met: &mut Met) {
        self.advanced = None;
        if matches!(self.state, State::Planned(_)) && leading.len() == self.leaders.len() {
            let result = self.start(leading);
            met.insert(Part::Whole, result);
        }
        let State::Running(simulation) = &mut self.state else {
            return;
        };
        for (&body, &(goal, engine_body)) in leading {
            let led = match engine_body.filter(|_| simulation.proxy_load(body).is_some()) {
                Some(engine_body) => simulation.bring_body(body, engine_body.brought(goal)),
                None => simulation.place_body(body, goal),
            };
            if let Err(error) = led {
                met.insert(Part::Body(body), Err(SelvedgeError::Lead(error)));
            }
        }
        let frame = match simulation.advance(fixed) {
            Ok(FrameSteps { steps, needed }) if steps < needed => Err(SelvedgeError::ShortOfSteps { steps, needed }),
            Ok(_) => Ok(()),
            Err(FrameError::Seconds(error)) => Err(SelvedgeError::FixedStep(error)),
            // The next fixed step may bring the entity back, or teleport the body.
            Err(FrameError::Blocked(blocked)) if blocked.speed.is_some() => {
                met.insert(Part::Whole, Err(SelvedgeError::TooFast(blocked)));
                return;
            }
            Err(FrameError::Blocked(blocked)) => {
                met.insert(Part::Whole, Err(SelvedgeError::Blocked(blocked)));
                if let State::Running(simulation) = std::mem::replace(&mut self.state, State::Ended(None)) {
                    self.state = State::Ended(Some(simulation));
                }
                return;
            }
        };
        self.advanced = Some(fixed);
        met.insert(Part::TimeStep, frame);
    }

    fn start(&mut self, leading: &Leading) -> Result<(), SelvedgeError> {
        let State::Planned(mut scene) = std::mem::replace(&mut self.state, State::Ended(None)) else {
            return Ok(());
        };
        let bodies = scene.bodies.len();
        for (&body, &(placement, engine_body)) in leading {
            let Some(own) = scene.bodies.get_mut(body) else {
                return Err(SelvedgeError::NoBody { body, bodies });
            };
            own.motion = match engine_body {
                Some(engine_body) => engine_body.proxy(placement).into(),
                None => BodyMotion::Driven(placement),
            };
        }
        let tubes = (0..scene.cloths.len()).filter_map(|cloth| Some((cloth, Tubes::from_scene(&scene, cloth)?)));
        self.tubes = tubes.collect();
        let simulation = Simulation::new(*scene, self.threads).map_err(|error| SelvedgeError::Setup(error.to_string()))?;
        self.state = State::Running(Box::new(simulation));
        Ok(())
    }

    /// Writes the cloth into the rendered mesh, which is at `place`.
    fn write(&mut self, place: Place, mesh: &mut Mesh) -> Result<(), SelvedgeError> {
        let Self {
            state,
            vertices,
            torn,
            normals,
            ..
        } = self;
        let (State::Running(simulation) | State::Ended(Some(simulation))) = state else {
            return Ok(());
        };
        let cloth = &simulation.positions()[..simulation.cloth_vertices()];
        let has_torn = simulation.torn_edges().len();
        let is_known = |seen: usize| vertices.as_ref().is_some_and(|vertices| vertices.len() == seen);
        if has_torn != *torn || has_torn > 0 && !is_known(positions_of(mesh)?.len()) {
            *vertices = Some(tear(mesh, simulation)?);
            *torn = has_torn;
        }
        let seen = positions_of(mesh)?.len();
        if vertices.as_ref().is_none_or(|vertices| vertices.len() != seen) {
            *vertices = None;
            let own = if seen == cloth.len() {
                (0..seen as u32).collect()
            } else {
                let shape = Shape::of(mesh)?;
                if shape.vertices.len() != cloth.len() {
                    return Err(SelvedgeError::OtherMesh {
                        seen,
                        cloth: cloth.len(),
                    });
                }
                shape.points
            };
            *vertices = Some(own);
        }
        let of_vertices = vertices.as_deref().unwrap_or_default();
        vertex_normals(cloth, &simulation.triangles()[..simulation.cloth_triangles()], normals);
        let corners = of_vertices
            .iter()
            .map(|&vertex| (cloth[vertex as usize], normals[vertex as usize]));
        write(mesh, place, corners)
    }
}

/// Gives each corner of a mesh a vertex of its own, so that it can tear anywhere. Returns the cloth's vertex of each.
fn tear(mesh: &mut Mesh, simulation: &Simulation) -> Result<Vec<u32>, SelvedgeError> {
    let triangles = &simulation.triangles()[..simulation.cloth_triangles()];
    let seen = triangles_of(mesh)?.len();
    if seen != triangles.len() {
        return Err(SelvedgeError::OtherMesh {
            seen: positions_of(mesh)?.len(),
            cloth: simulation.cloth_vertices(),
        });
    }
    mesh.try_duplicate_vertices().map_err(|_| RenderMeshError::OnlyRendered)?;
    Ok(triangles.as_flattened().to_vec())
}
