//! The data that a simulation derives from a scene's meshes and effects: at the start, and again after cloth has torn.

use super::errors::SetupError;
use super::free_bodies::OfFreeBodies;
use super::loads::Supports;
use super::momentum::Pieces;
use crate::contact::ContactSolver;
use crate::contact::smooth_body::SmoothBody;
use crate::effects::plan::{ActingForce, Entry, OfCloths, Plan};
use crate::model::step::{Carrier, FREE, Memory, MovedAnchor};
use crate::model::tearing::Tearable;
use crate::model::triangle_edges::edges_of;
use crate::scene::{Scene, append};
use crate::solve::{Solve, Term};
use crate::world::{Cloth, Kinematic};
use selvedge::{Mesh, Topology};
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// The data that a simulation derives from a scene's meshes and effects.
#[derive(Debug)]
pub(super) struct Assembly {
    /// The names of the effects, in the order in which they run.
    pub(super) effects: Vec<&'static str>,
    pub(super) vertices_of_cloths: Vec<Range<usize>>,
    pub(super) body_vertices: Vec<Range<usize>>,
    pub(super) cloth_vertices: usize,
    pub(super) cloth_triangles: usize,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) loose_edges: Vec<[u32; 2]>,
    /// The positions of all vertices at rest: the cloths' and the bodies' as in their meshes.
    pub(super) rest: Vec<DVec3>,
    pub(super) inverse_masses: Vec<f64>,
    /// Whose motion each vertex follows.
    pub(super) carriers: Vec<Carrier>,
    /// The motions of bodies, then those of pins.
    pub(super) motions: Vec<Kinematic>,
    /// The carrier of each group of pins.
    pub(super) pins: Vec<Carrier>,
    pub(super) supports: Supports,
    pub(super) forces: Vec<ActingForce>,
    pub(super) contact: Option<ContactSolver>,
    pub(super) tearable: Vec<Tearable>,
    /// The one solve of each step.
    pub(super) solve: Solve,
    pub(super) smooth_bodies: Vec<SmoothBody>,
    /// The rate at which still air slows each vertex, in 1/s; empty without air.
    pub(super) drag: Vec<f64>,
    /// The coefficient of friction.
    pub(super) friction_coefficient: f64,
    pub(super) of_free_bodies: OfFreeBodies,
    /// The pieces of all cloths; each keeps its momentum.
    pub(super) pieces: Pieces,
    /// The mean length of the cloths' edges at rest, in metres, each counted once for each triangle.
    pub(super) mean_edge: f64,
}

impl Assembly {
    /// Makes the data of a valid scene.
    ///
    /// # Errors
    /// Returns an error if it has too many triangles, or no cloth.
    pub(super) fn of(scene: &Scene) -> Result<Self, SetupError> {
        let mut plan = Plan::new(scene.parts()?);
        let effects = scene.called().register(&mut plan);
        let Plan {
            mut inverse_masses,
            mut carriers,
            mut motions,
            pins,
            pinned,
            attachment_groups,
            forces,
            contact,
            tearable,
            ties,
            mut terms,
            of_cloths,
            hinges,
            smooth_bodies,
            drag,
            friction_coefficient,
            gravity,
            ..
        } = plan;
        let mut rows_of_ropes = Vec::new();
        for OfCloths { membranes, ropes } in of_cloths {
            rows_of_ropes.extend(ropes.iter().flat_map(|(_, ropes)| ropes.rows().to_vec()));
            terms.extend(membranes.map(|(effect, membranes)| Entry::of(effect, Box::new(membranes) as Box<dyn Term>)));
            terms.extend(ropes.map(|(effect, ropes)| Entry::of(effect, Box::new(ropes) as Box<dyn Term>)));
        }
        for row in &mut rows_of_ropes {
            extend_to_ties(row, &ties);
        }
        terms.sort_by_key(|entry| entry.effect);
        let mut all = Mesh::default();
        let vertices_of_cloths: Vec<_> = scene.cloths.iter().map(|cloth| append(&mut all, &cloth.mesh)).collect();
        let (cloth_vertices, cloth_triangles) = (all.positions.len(), all.triangles.len());
        let mut body_vertices = Vec::with_capacity(scene.bodies.len());
        for (carrier, body) in scene.bodies.iter().enumerate() {
            body_vertices.push(append(&mut all, &body.mesh));
            carriers.resize(all.positions.len(), carrier as Carrier);
        }
        let Mesh {
            positions: rest,
            triangles,
        } = all;
        inverse_masses.resize(rest.len(), 0.0);
        let loose_edges = scene.all_loose_edges();
        take_riders(scene, &mut motions, &carriers[..cloth_vertices]);
        let are_free: Vec<bool> = { motions[..scene.bodies.len()].iter() }.map(Kinematic::is_free).collect();
        let contact = contact.asks_for_any().then(|| {
            let topology = Topology::with_loose_features(rest.len(), triangles.clone(), &loose_edges, &[])?;
            let (rest, time_step) = (&rest, scene.time_step);
            Ok::<_, SetupError>(ContactSolver::new(
                contact,
                topology,
                rest,
                &carriers,
                (cloth_vertices, &without_engine(&motions[..scene.bodies.len()])),
                time_step,
            ))
        });
        let mut contact = contact.transpose()?;
        if let Some(contact) = &mut contact {
            contact.sew(terms.iter().flat_map(|entry| entry.action.joints()));
        }
        let joints: Vec<[u32; 2]> = terms.iter().flat_map(|entry| entry.action.joints()).collect();
        let edges = edges_of(&triangles[..cloth_triangles])
            .chain(loose_edges.iter().copied())
            .chain(joints);
        let (mean_edge, cloth) = (mean_length(edges.clone(), &rest), &triangles[..cloth_triangles]);
        let counts = [cloth_vertices, are_free.iter().filter(|is_free| **is_free).count()];
        let solve = Solve::new(terms, scene.accuracy, cloth, &hinges, &rows_of_ropes, counts);
        let rides = |vertex: usize| carriers[vertex] != FREE && are_free.get(carriers[vertex] as usize) == Some(&true);
        let pieces = Pieces::new(&inverse_masses[..cloth_vertices], rides, edges);
        Ok(Self {
            effects,
            contact,
            vertices_of_cloths,
            body_vertices,
            cloth_vertices,
            cloth_triangles,
            triangles,
            loose_edges,
            inverse_masses,
            carriers,
            motions,
            pins,
            supports: Supports::new(pinned, attachment_groups, &scene.cloths),
            forces,
            tearable,
            solve,
            smooth_bodies,
            drag,
            friction_coefficient,
            of_free_bodies: OfFreeBodies { gravity, rest: false },
            pieces,
            mean_edge,
            rest,
        })
    }

    /// The memories of its terms.
    pub(super) fn memories(&self) -> impl Iterator<Item = &dyn Memory> {
        self.solve.terms.iter().filter_map(|entry| entry.action.memory())
    }

    /// Returns the anchors that follow motions; none without soft pins.
    pub(super) fn anchors(&self) -> Vec<MovedAnchor> {
        self.memories().flat_map(Memory::anchors).collect()
    }

    /// The same, to change them.
    pub(super) fn memories_mut(&mut self) -> impl Iterator<Item = &mut dyn Memory> {
        self.solve.terms.iter_mut().filter_map(|entry| entry.action.memory_mut())
    }
}

/// Returns for each body whether the solve alone moves it.
fn without_engine(bodies: &[Kinematic]) -> Vec<bool> {
    let is_proxy = |body: &Kinematic| body.free().is_some_and(|free| free.proxy.is_some());
    bodies.iter().map(|body| body.is_free() && !is_proxy(body)).collect()
}

/// Gives free bodies the vertices of cloth that are pinned to them. `carriers` are those of the cloths' vertices.
fn take_riders(scene: &Scene, motions: &mut [Kinematic], carriers: &[Carrier]) {
    if !motions.iter().any(Kinematic::is_free) {
        return;
    }
    let start = scene.cloths.iter().flat_map(|cloth| cloth.start().to_vec());
    let masses = scene.cloths.iter().flat_map(Cloth::masses);
    let all: Vec<_> = (0_u32..).zip(start).zip(masses).zip(carriers).collect();
    for (body, motion) in motions.iter_mut().enumerate() {
        let Some(free) = motion.free_mut() else { continue };
        let own = all.iter().filter(|(_, carrier)| **carrier as usize == body);
        let own: Vec<_> = own
            .map(|(((vertex, position), mass), _)| (*vertex, *position, *mass))
            .collect();
        if !own.is_empty() {
            free.take_riders(&own);
        }
    }
}

/// Adds the vertices to which the ends of a rope are tied.
fn extend_to_ties(row: &mut Vec<u32>, ties: &[[u32; 2]]) {
    let partner = |end: u32, row: &[u32]| {
        let others = ties.iter().filter(|tie| tie.contains(&end)).flatten().copied();
        { others }.find(|other| !row.contains(other))
    };
    if let Some(other) = row.last().and_then(|&end| partner(end, row)) {
        row.push(other);
    }
    if let Some(other) = row.first().and_then(|&end| partner(end, row)) {
        row.insert(0, other);
    }
}

/// Returns the mean length of edges, in metres.
fn mean_length(edges: impl Iterator<Item = [u32; 2]>, rest: &[DVec3]) -> f64 {
    let lengths = edges.map(|[a, b]| rest[a as usize].distance(rest[b as usize]));
    let (sum, count) = lengths.fold((0.0, 0.0), |(sum, count), length| (sum + length, count + 1.0));
    sum / count
}
