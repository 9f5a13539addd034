//! Contacts between the entities of a Bevy world.

use crate::error::tell;
use crate::place::{Place, Places};
use crate::shape::{Shape, positions_of, triangles_of};
use crate::{CollisionBody, CollisionGroups, CollisionMesh, RenderMeshError, SelvedgeError, SelvedgeProblem};
use bevy_asset::{AssetEvent, AssetId, Assets};
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::{Message, MessageReader, MessageWriter};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Query, Res, ResMut};
use bevy_mesh::{Mesh, Mesh3d};
use selvedge::glam::DVec3;
use selvedge::{
    Criterion, DEFAULT_MEMORY_LIMIT, Geometry, Groups, MeshHandle, MeshMotion, PairKind, Threads, World, WorldContact,
    WorldContactGeometry, WorldError,
};
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::{Arc, Weak};

/// The settings of the search for contacts. They may change at any time.
#[derive(Resource, Clone, Copy, Debug)]
pub struct CollisionSettings {
    /// The criterion for a contact, in the unit of Bevy's positions. The default is that bodies touch.
    pub criterion: Criterion<f64>,
    /// The threads. The default is the one that runs the system. Contacts and their order do not depend on it.
    pub threads: Threads,
    /// The largest number of candidate pairs of a step. By default there is no limit.
    pub pair_limit: Option<u64>,
    /// The most memory that the contacts of a step may take, in bytes; by default 2 GiB. `None` is no limit.
    pub memory_limit: Option<u64>,
}

impl Default for CollisionSettings {
    fn default() -> Self {
        Self {
            criterion: Criterion::default(),
            threads: Threads::default(),
            pair_limit: None,
            memory_limit: Some(DEFAULT_MEMORY_LIMIT),
        }
    }
}

/// A contact of two bodies, or of one with itself, in this fixed step. No contact is missed.
///
/// One touch often gives several contacts: one for each vertex–face or edge–edge pair that meets.
#[derive(Message, Clone, Copy, Debug, PartialEq)]
pub struct CollisionContact {
    /// The kind of pair: vertex–face or edge–edge.
    pub kind: PairKind,
    /// The bodies of the vertex and of the face, or of the two edges. They may have been despawned since.
    pub entities: [Entity; 2],
    /// The vertex and the corners of the face, or the ends of both edges, with the numbers of their meshes. If several vertices
    /// have the same position, it is the first.
    pub vertices: [u32; 4],
    /// The time in [0, 1] of the step. It is never after the exact time.
    pub time: f64,
    /// The geometry at that time in Bevy's world: the closest points of both sides with their barycentric weights, the normal,
    /// and the speed along it. The normal points from the second side to the first; the unit of speed is lengths per fixed step.
    /// See [its guarantees](selvedge::core::separation::geometry).
    pub geometry: Geometry,
}

/// The bodies that take part.
#[derive(Resource, Default)]
pub(crate) struct Collisions {
    world: World<DVec3>,
    /// The bodies in the order of their motions, which is the same on each run.
    bodies: BTreeMap<Entity, Body>,
    entities: HashMap<MeshHandle, Entity>,
    /// The last reports about bodies that do not take part or lag behind.
    problems: BTreeMap<Entity, SelvedgeError>,
    refused: HashMap<AssetId<Mesh>, RenderMeshError>,
    shapes: HashMap<AssetId<Mesh>, Weak<Shape>>,
    found: Vec<WorldContact<f64>>,
    geometries: Vec<WorldContactGeometry>,
}

struct Body {
    handle: MeshHandle,
    source: Source,
    shape: Arc<Shape>,
    /// The form with which the body's shape was inserted.
    inserted: Place,
    /// The place at the end of the last step.
    place: Place,
    /// The vertices of a deforming body at the end of the last step.
    positions: Vec<DVec3>,
    /// True if the place must be set, even if the body does not move.
    is_new: bool,
}

#[derive(Clone, Copy)]
struct Source {
    kind: CollisionBody,
    mesh: AssetId<Mesh>,
    groups: Groups,
}

enum BodyPath {
    Rigid(Place),
    /// A straight motion of each point, while the body moves to a place and its mesh's vertices to positions.
    Straight {
        points: [Vec<DVec3>; 2],
        place: Place,
        positions: Vec<DVec3>,
    },
}

type Wanted<'a> = (
    Entity,
    &'a CollisionBody,
    &'a CollisionGroups,
    Option<&'a CollisionMesh>,
    Option<&'a Mesh3d>,
);

/// Inserts and removes bodies, moves them to their current places, and writes the contacts.
pub(crate) fn find_contacts(
    mut collisions: ResMut<'_, Collisions>,
    settings: Res<'_, CollisionSettings>,
    meshes: Res<'_, Assets<Mesh>>,
    mut changes: MessageReader<'_, '_, AssetEvent<Mesh>>,
    wanted: Query<'_, '_, Wanted<'static>>,
    places: Places<'_, '_>,
    (mut contacts, mut problems): (MessageWriter<'_, CollisionContact>, MessageWriter<'_, SelvedgeProblem>),
) {
    let collisions = &mut *collisions;
    if settings.is_changed() {
        for error in collisions.set(&settings) {
            tell(&mut problems, None, SelvedgeError::Setting(error));
        }
    }
    let changed = changes.read().filter_map(|event| match *event {
        AssetEvent::Added { id } | AssetEvent::Modified { id } | AssetEvent::Removed { id } => Some(id),
        AssetEvent::Unused { .. } | AssetEvent::LoadedWithDependencies { .. } => None,
    });
    let changed: HashSet<AssetId<Mesh>> = changed.collect();
    collisions.forget(&changed);

    // Bevy's order of entities depends on what else was spawned.
    let mut all: Vec<Wanted<'_>> = wanted.iter().collect();
    all.sort_unstable_by_key(|&(entity, ..)| entity);
    collisions.keep_only(&all);

    let mut paths = Vec::new();
    let mut met: BTreeMap<Entity, SelvedgeError> = BTreeMap::new();
    for &wanted in &all {
        let entity = wanted.0;
        let place = places.of(entity);
        match place.and_then(|place| collisions.path(wanted, place, &meshes, &changed)) {
            Ok(Some(path)) => paths.push((entity, path)),
            Ok(None) => {}
            Err(error) => {
                met.insert(entity, error);
            }
        }
    }
    let result = collisions.run(&mut paths, &mut met);
    collisions.adopt(paths);
    for (&entity, error) in &met {
        // The problem recurs in each step until it is fixed, but it is reported once.
        if collisions.problems.get(&entity) != Some(error) {
            tell(&mut problems, Some(entity), error.clone());
        }
    }
    collisions.problems = met;
    match result {
        Ok(()) => drop(contacts.write_batch(collisions.contacts())),
        Err(error) => tell(&mut problems, None, SelvedgeError::Step(error)),
    }
}

impl Collisions {
    /// Applies the settings. Returns the reasons why some were refused.
    fn set(&mut self, settings: &CollisionSettings) -> Vec<String> {
        self.world.set_pair_limit(settings.pair_limit);
        self.world.set_memory_limit(settings.memory_limit);
        let criterion = self
            .world
            .set_criterion(settings.criterion)
            .err()
            .map(|error| error.to_string());
        let threads = self.world.set_threads(settings.threads).err().map(|error| error.to_string());
        criterion.into_iter().chain(threads).collect()
    }

    fn forget(&mut self, changed: &HashSet<AssetId<Mesh>>) {
        self.refused.retain(|mesh, _| !changed.contains(mesh));
        self.shapes
            .retain(|mesh, shape| !changed.contains(mesh) && shape.strong_count() > 0);
    }

    /// Removes bodies that were despawned or have lost a component.
    fn keep_only(&mut self, wanted: &[Wanted<'_>]) {
        let is_wanted = |entity: &Entity| wanted.binary_search_by_key(entity, |&(own, ..)| own).is_ok();
        let gone: Vec<Entity> = self.bodies.keys().filter(|entity| !is_wanted(entity)).copied().collect();
        for entity in gone {
            self.remove(entity);
        }
    }

    fn remove(&mut self, entity: Entity) -> Option<Body> {
        let body = self.bodies.remove(&entity)?;
        self.entities.remove(&body.handle);
        // The mesh exists: only this function removes meshes.
        let _ = self.world.remove(body.handle);
        Some(body)
    }

    /// Returns the motion of a body to its current `place`; `None` if it rests or its mesh is not loaded.
    fn path(
        &mut self,
        (entity, &kind, groups, own, seen): Wanted<'_>,
        place: Place,
        meshes: &Assets<Mesh>,
        changed: &HashSet<AssetId<Mesh>>,
    ) -> Result<Option<BodyPath>, SelvedgeError> {
        let id = own.map(|mesh| mesh.0.id()).or(seen.map(|mesh| mesh.0.id()));
        let Some((id, mesh)) = id.and_then(|id| Some((id, meshes.get(id)?))) else {
            self.remove(entity);
            return Ok(None);
        };
        let stays = |body: &Body| {
            let is_as_it_was = || match kind {
                CollisionBody::Fixed => body.place == place && !changed.contains(&id),
                CollisionBody::Rigid => body.place.has_form_of(&body.inserted) && !changed.contains(&id),
                CollisionBody::Deforming => !changed.contains(&id) || triangles_of(mesh).as_ref() == Ok(&body.shape.triangles),
            };
            body.source.kind == kind && body.source.mesh == id && is_as_it_was()
        };
        if !self.bodies.get(&entity).is_some_and(stays) {
            let last = self.remove(entity);
            // A rigid body with a new form or mesh continues from its previous place.
            let last = last.filter(|body| [kind, body.source.kind] == [CollisionBody::Rigid; 2]);
            let shape = self.shape(id, mesh)?;
            let start = last.map_or(place, |body| body.place);
            let positions = positions_of(mesh)?.iter().map(|&position| match kind {
                CollisionBody::Rigid => start.formed(position),
                CollisionBody::Fixed | CollisionBody::Deforming => start.apply(position),
            });
            self.insert(
                entity,
                Source {
                    kind,
                    mesh: id,
                    groups: groups.0,
                },
                shape,
                positions.collect(),
                start,
            )?;
        }
        let Some(body) = self.bodies.get_mut(&entity) else {
            return Ok(None);
        };
        if body.source.groups != groups.0 && self.world.set_groups(body.handle, groups.0).is_ok() {
            body.source.groups = groups.0;
        }
        match kind {
            CollisionBody::Fixed => Ok(None),
            CollisionBody::Rigid => Ok(body.rigid_path(place, mesh)?),
            CollisionBody::Deforming => self.deforming_path(entity, place, positions_of(mesh)?),
        }
    }

    /// Returns the shape of a mesh, which all its bodies share.
    fn shape(&mut self, id: AssetId<Mesh>, mesh: &Mesh) -> Result<Arc<Shape>, RenderMeshError> {
        if let Some(error) = self.refused.get(&id) {
            return Err(error.clone());
        }
        // Bevy reports a changed mesh in the next frame.
        let has_all = |shape: &Arc<Shape>| positions_of(mesh).is_ok_and(|positions| positions.len() == shape.points.len());
        if let Some(shape) = self.shapes.get(&id).and_then(Weak::upgrade).filter(has_all) {
            return Ok(shape);
        }
        let shape = Shape::of(mesh).map(Arc::new);
        match &shape {
            Ok(shape) => drop(self.shapes.insert(id, Arc::downgrade(shape))),
            Err(error) => drop(self.refused.insert(id, error.clone())),
        }
        shape
    }

    /// Inserts a body with its vertices at these positions.
    fn insert(
        &mut self,
        entity: Entity,
        source: Source,
        shape: Arc<Shape>,
        positions: Vec<DVec3>,
        place: Place,
    ) -> Result<(), SelvedgeError> {
        let points = shape.of_points(&positions);
        let handle = self.world.insert(Arc::clone(&shape.topology), &points, source.groups);
        let handle = handle.map_err(SelvedgeError::World)?;
        self.entities.insert(handle, entity);
        let is_deforming = source.kind == CollisionBody::Deforming;
        let body = Body {
            handle,
            source,
            shape,
            inserted: place,
            place,
            positions: if is_deforming { positions } else { Vec::new() },
            is_new: true,
        };
        self.bodies.insert(entity, body);
        Ok(())
    }

    fn deforming_path(&mut self, entity: Entity, place: Place, mesh: &[[f32; 3]]) -> Result<Option<BodyPath>, SelvedgeError> {
        let ends: Vec<DVec3> = mesh.iter().map(|&position| place.apply(position)).collect();
        let Some(body) = self.bodies.get(&entity) else {
            return Ok(None);
        };
        if ends.len() != body.shape.points.len() {
            // The shape has changed, which is known in the next frame.
            return Ok(None);
        }
        if body.positions == ends && !body.is_new {
            return Ok(None);
        }
        if !body.shape.is_together(&ends) {
            // Vertices that shared a point have come apart.
            let Some(last) = self.remove(entity) else { return Ok(None) };
            let keys = last.shape.points.iter().zip(&ends);
            let keys = keys.map(|(&point, end)| (point, (end + DVec3::ZERO).to_array().map(f64::to_bits)));
            let shape = Shape::new(last.shape.triangles.clone(), keys)?;
            self.insert(entity, last.source, Arc::new(shape), last.positions, last.place)?;
        }
        Ok(self.bodies.get(&entity).map(|body| BodyPath::Straight {
            points: [body.shape.of_points(&body.positions), body.shape.of_points(&ends)],
            place,
            positions: ends,
        }))
    }

    /// Finds the contacts. A body whose motion is refused stays where it is and is listed in `met`.
    fn run(&mut self, paths: &mut Vec<(Entity, BodyPath)>, met: &mut BTreeMap<Entity, SelvedgeError>) -> Result<(), WorldError> {
        loop {
            let motions = paths.iter().filter_map(|(entity, path)| {
                let body = self.bodies.get(entity)?;
                let motion = match path {
                    BodyPath::Rigid(place) => MeshMotion::Rigid {
                        start: body.place.pose(),
                        end: place.pose(),
                    },
                    BodyPath::Straight {
                        points: [start, end], ..
                    } => MeshMotion::Deforming { start, end },
                };
                Some((body.handle, motion))
            });
            let motions: Vec<_> = motions.collect();
            let Err(error) = self.world.contacts(&motions, &mut self.found) else {
                return self.world.contact_geometries(&self.found, &mut self.geometries);
            };
            let at_fault = match error {
                WorldError::BadPositions { mesh, .. } | WorldError::BadPose { mesh } => self.entities.get(&mesh).copied(),
                _ => None,
            };
            let Some(entity) = at_fault else {
                self.found.clear();
                self.geometries.clear();
                return Err(error);
            };
            paths.retain(|&(own, _)| own != entity);
            met.insert(entity, SelvedgeError::World(error));
            if self.bodies.get(&entity).is_some_and(|body| body.is_new) {
                // The body has left the place where it was inserted.
                self.remove(entity);
            }
        }
    }

    /// Makes the end of this step the start of the next.
    fn adopt(&mut self, paths: Vec<(Entity, BodyPath)>) {
        for (entity, path) in paths {
            let Some(body) = self.bodies.get_mut(&entity) else { continue };
            body.is_new = false;
            match path {
                BodyPath::Rigid(place) => body.place = place,
                BodyPath::Straight { place, positions, .. } => (body.place, body.positions) = (place, positions),
            }
        }
    }

    fn contacts(&self) -> impl Iterator<Item = CollisionContact> {
        self.found.iter().zip(&self.geometries).filter_map(|(contact, found)| {
            let [first, second] = contact.meshes.map(|mesh| self.entities.get(&mesh));
            let entities = [*first?, *second?];
            let [first, second] = entities.map(|entity| self.bodies.get(&entity));
            let bodies = [first?, second?];
            // A rigid body whose scale changes has the motion of a deforming one.
            if entities[0] == entities[1] && bodies[0].source.kind != CollisionBody::Deforming {
                return None;
            }
            let [a, b, c, d] = found.vertices;
            // For a vertex and a face, the second point belongs to the other side.
            let second = bodies[usize::from(contact.kind == PairKind::VertexFace)];
            Some(CollisionContact {
                kind: contact.kind,
                entities,
                vertices: [
                    bodies[0].vertex(a),
                    second.vertex(b),
                    bodies[1].vertex(c),
                    bodies[1].vertex(d),
                ],
                time: contact.time,
                geometry: found.geometry,
            })
        })
    }
}

impl Body {
    fn rigid_path(&self, place: Place, mesh: &Mesh) -> Result<Option<BodyPath>, RenderMeshError> {
        if place == self.place && !self.is_new {
            return Ok(None);
        }
        if place.has_form_of(&self.inserted) {
            return Ok(Some(BodyPath::Rigid(place)));
        }
        let mesh = positions_of(mesh)?;
        if mesh.len() != self.shape.points.len() {
            // The shape has changed; an event of the next frame reports it.
            return Ok(None);
        }
        let points = [self.place, place].map(|place| {
            let vertices = self.shape.vertices.iter();
            vertices.map(|&vertex| place.apply(mesh[vertex as usize])).collect()
        });
        Ok(Some(BodyPath::Straight {
            points,
            place,
            positions: Vec::new(),
        }))
    }

    /// Returns the first vertex of a point.
    fn vertex(&self, point: u32) -> u32 {
        self.shape.vertices[point as usize]
    }
}
