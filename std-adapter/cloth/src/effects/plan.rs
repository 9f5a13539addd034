//! The plan of a step. Effects register with it.
//!
//! Each effect adds forces and terms, which own their data. What no effect adds costs nothing. Effects register in the order of
//! the registry; the file's order does not matter.
//!
//! An effect that acts on each cloth by itself registers once for each. Its forces see the vertices of that cloth alone.

use super::air::Drag;
use crate::contact::ContactSettings;
use crate::contact::smooth_body::SmoothBody;
use crate::model::bending::{PlacedHinge, Yield};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Carrier, FREE, Force, TimeStep};
use crate::model::tearing::Tearable;
use crate::solve::Term;
use crate::solve::air::{Blowing, InAir};
use crate::solve::bending::Bending;
use crate::solve::membranes::Membranes;
use crate::solve::ropes::Ropes;
use crate::solve::walls::{Filling, Walls};
use crate::world::{BodyMotion, Cloth, Kinematic, SceneParts};
use selvedge::clock::Clock;
use selvedge_core::glam::DVec3;
use std::ops::Range;

#[derive(Debug)]
pub(crate) struct Entry<T: ?Sized> {
    /// Index into the scene's effects.
    pub(crate) effect: usize,
    pub(crate) action: Box<T>,
    /// The seconds that it has taken since they were last counted.
    pub(crate) seconds: f64,
}

impl<T: ?Sized> Entry<T> {
    pub(crate) const fn of(effect: usize, action: Box<T>) -> Self {
        Self {
            effect,
            action,
            seconds: 0.0,
        }
    }

    /// Calls the action, and counts its time.
    pub(crate) fn timed<R>(&mut self, call: impl FnOnce(&mut T) -> R) -> R {
        let begin = Clock::now();
        let result = call(&mut self.action);
        self.seconds += begin.elapsed().as_secs_f64();
        result
    }
}

/// A force, and the vertices that it sees.
#[derive(Debug)]
pub(crate) struct ActingForce {
    /// Index into the scene's effects.
    pub(crate) effect: usize,
    /// The vertices of its cloth; `None` for all vertices of the scene.
    vertices: Option<Range<usize>>,
    force: Box<dyn Force>,
}

impl ActingForce {
    /// Lets the force change velocities; `step` and `velocities` are of the whole scene.
    pub(crate) fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let seen = self.seen(velocities.len());
        let step = TimeStep {
            start: &step.start[seen.clone()],
            inverse_masses: &step.inverse_masses[seen.clone()],
            ..*step
        };
        self.force.apply(&step, &mut velocities[seen]);
    }

    pub(crate) fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let seen = self.seen(now.positions.len());
        self.force.energy(&Configuration {
            positions: &now.positions[seen.clone()],
            inverse_masses: &now.inverse_masses[seen],
        })
    }

    fn seen(&self, all: usize) -> Range<usize> {
        self.vertices.clone().unwrap_or(0..all)
    }
}

/// Properties of a cloth that its effects announce before any of them registers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fabric {
    /// Stretch stiffness of warp and weft, in N/m.
    pub(crate) stretch: Option<[f64; 2]>,
    /// The distance that the cloth keeps from itself, in metres.
    pub(crate) thickness: Option<f64>,
    /// The point at which folds become permanent.
    pub(crate) folds: Option<Yield>,
}

/// The terms that several effects of a cloth make together, each with the effect that asked for it first.
#[derive(Debug, Default)]
pub(crate) struct OfCloths {
    pub(crate) membranes: Option<(usize, Membranes)>,
    pub(crate) ropes: Option<(usize, Ropes)>,
}

/// The parts of a step, which effects register.
#[derive(Debug)]
pub struct Plan<'a> {
    pub(crate) scene: SceneParts<'a>,
    pub(crate) effect: usize,
    /// The cloth on which it acts; `None` for the whole scene.
    cloth: Option<usize>,
    pub(crate) fabrics: Vec<Fabric>,
    /// The range of each cloth's vertices among the scene's.
    vertices: Vec<Range<usize>>,
    /// The inverse masses of the vertices of all cloths, in 1/kg.
    pub(crate) inverse_masses: Vec<f64>,
    /// The carriers of the vertices of all cloths.
    pub(crate) carriers: Vec<Carrier>,
    /// Motions of bodies, then those of pins.
    pub(crate) motions: Vec<Kinematic>,
    pub(crate) pins: Vec<Carrier>,
    /// The vertices of each group of pins.
    pub(crate) pinned: Vec<Vec<u32>>,
    pub(crate) attachment_groups: usize,
    /// Single vertices that seams join; ropes need to know them.
    pub(crate) ties: Vec<[u32; 2]>,
    pub(crate) forces: Vec<ActingForce>,
    pub(crate) contact: ContactSettings,
    pub(crate) tearable: Vec<Tearable>,
    /// The terms of the solve, besides those of membranes and ropes.
    pub(crate) terms: Vec<Entry<dyn Term>>,
    /// The membranes and the ropes of each cloth that has any, and the effect that asked for them first.
    pub(crate) of_cloths: Vec<OfCloths>,
    /// The hinges of all cloths: vertices, weights and stiffness.
    pub(crate) hinges: Vec<([u32; 4], [f64; 4], f64)>,
    pub(crate) smooth_bodies: Vec<SmoothBody>,
    /// The rate at which still air slows each vertex, in 1/s; empty without air.
    pub(crate) drag: Vec<f64>,
    /// The coefficient of friction.
    pub(crate) friction_coefficient: f64,
    /// The acceleration of free bodies, in m/s².
    pub(crate) gravity: DVec3,
}

impl<'a> Plan<'a> {
    pub(crate) fn new(scene: SceneParts<'a>) -> Self {
        let count = scene.cloth_vertices();
        let mut first = count as u32;
        let motions = scene.bodies.iter().map(|body| {
            let vertices = first..first + body.mesh.positions.len() as u32;
            first = vertices.end;
            Kinematic::of_body(body, vertices.collect())
        });
        Self {
            motions: motions.collect(),
            pins: Vec::new(),
            pinned: Vec::new(),
            attachment_groups: 0,
            ties: Vec::new(),
            scene,
            effect: 0,
            cloth: None,
            fabrics: Vec::new(),
            vertices: scene.vertices_of_cloths().collect(),
            inverse_masses: scene.cloths.iter().flat_map(Cloth::masses).map(f64::recip).collect(),
            carriers: vec![FREE; count],
            forces: Vec::new(),
            contact: ContactSettings::new(scene.cloths.iter().map(|cloth| cloth.mesh.positions.len())),
            tearable: Vec::new(),
            terms: Vec::new(),
            of_cloths: scene.cloths.iter().map(|_| OfCloths::default()).collect(),
            hinges: Vec::new(),
            smooth_bodies: Vec::new(),
            drag: Vec::new(),
            friction_coefficient: 0.0,
            gravity: DVec3::ZERO,
        }
    }

    /// Begins the registration of an effect, by its index, for one of the cloths or for the whole scene.
    pub(crate) fn begin(&mut self, effect: usize, cloth: Option<usize>) {
        (self.effect, self.cloth) = (effect, cloth);
        self.scene = self.scene.of_cloth(cloth);
    }

    /// Returns the cloth on which the registering effect acts; the first if it acts on the whole scene.
    pub(crate) fn cloth(&self) -> usize {
        self.cloth.unwrap_or(0)
    }

    pub(crate) fn fabric(&self) -> Fabric {
        self.fabrics[self.cloth()]
    }

    /// Returns the vertices of the cloth on which the registering effect acts, as the scene numbers them; those of all cloths if
    /// it acts on the whole scene.
    #[must_use]
    pub fn vertices(&self) -> Range<usize> {
        self.cloth
            .map_or(0..self.inverse_masses.len(), |cloth| self.vertices[cloth].clone())
    }

    fn entry<T: ?Sized>(&self, action: Box<T>) -> Entry<T> {
        Entry::of(self.effect, action)
    }

    /// Returns the scene on which the effect acts.
    #[must_use]
    pub fn scene(&self) -> SceneParts<'a> {
        self.scene
    }

    /// Returns the mass of each vertex of the cloth, in kg: a third of its triangles' mass and half of its loose edges' mass.
    #[must_use]
    pub fn masses(&self) -> Vec<f64> {
        self.scene.cloth.masses()
    }

    /// Adds a term of the energy that a step minimises. It numbers vertices as the scene does, whatever
    /// [`vertices`](Self::vertices) it acts on.
    pub fn add_term(&mut self, term: impl Term + 'static) {
        self.terms.push(self.entry(Box::new(term)));
    }

    /// Returns the first triangle of the cloth among those of all cloths.
    fn first_triangle(&self) -> usize {
        self.scene.cloths[..self.cloth()]
            .iter()
            .map(|cloth| cloth.mesh.triangles.len())
            .sum()
    }

    /// Returns the membranes of the cloth.
    pub(crate) fn membranes(&mut self) -> &mut Membranes {
        let (effect, cloth, first) = (self.effect, self.scene.cloth, self.first_vertex());
        let first_triangle = self.first_triangle();
        let own = self.cloth();
        let membranes = self.of_cloths[own]
            .membranes
            .get_or_insert_with(|| (effect, Membranes::new(cloth, first, first_triangle)));
        &mut membranes.1
    }

    /// Returns the ropes of the cloth.
    pub(crate) fn ropes(&mut self) -> &mut Ropes {
        let (effect, cloth, first) = (self.effect, self.scene.cloth, self.first_vertex());
        let own = self.cloth();
        &mut self.of_cloths[own]
            .ropes
            .get_or_insert_with(|| (effect, Ropes::new(cloth, first)))
            .1
    }

    /// Adds the bending of the cloth.
    pub(crate) fn add_bending(&mut self, hinges: &[PlacedHinge], folds: Option<(Yield, &[u32])>) {
        let bending = Bending::new(hinges, self.first_vertex(), self.scene.cloth.mesh.positions.len(), folds);
        self.hinges.extend(bending.constant());
        self.add_term(bending);
    }

    /// Adds a pressure or a gas inside the cloth.
    pub(crate) fn add_walls(&mut self, filling: impl Filling + 'static) {
        let walls = Walls::new(filling, self.scene.cloth, self.first_vertex(), self.first_triangle());
        self.add_term(walls);
    }

    /// Adds air that pushes the cloth.
    pub(crate) fn add_air(&mut self, air: impl Blowing + 'static, drag: Drag) {
        let (cloth, first) = (self.scene.cloth, self.first_vertex());
        let triangles = cloth
            .mesh
            .triangles
            .iter()
            .map(|corners| corners.map(|vertex| vertex + first));
        let edges = cloth.topology.loose_edges().map(|ends| ends.map(|vertex| vertex + first));
        let triangles = (self.first_triangle(), triangles.collect());
        self.add_term(InAir::new(
            air,
            [drag.over(1.0), drag.rope_diameter],
            triangles,
            edges.collect(),
        ));
    }

    /// Adds a rate, in 1/s, at which still air slows the cloth.
    pub(crate) fn add_drag(&mut self, rate: f64) {
        self.drag.resize(self.inverse_masses.len(), 0.0);
        let own = self.vertices();
        self.drag[own].iter_mut().for_each(|drag| *drag += rate);
    }

    /// Adds a force. Forces run first in a step, in the order of these calls. A force of an effect on one cloth sees the vertices
    /// of that cloth alone.
    pub fn add_force(&mut self, force: impl Force + 'static) {
        self.forces.push(ActingForce {
            effect: self.effect,
            vertices: self.cloth.map(|cloth| self.vertices[cloth].clone()),
            force: Box::new(force),
        });
    }

    /// Returns the number in the scene of the cloth's first vertex.
    pub(crate) fn first_vertex(&self) -> u32 {
        self.vertices().start as u32
    }

    pub(crate) fn add_tearable(&mut self, tearable: Tearable) {
        self.tearable.push(tearable.placed(self.effect, self.cloth()));
    }

    /// Returns the initial positions of all vertices, cloths' then bodies', except for pinned ones.
    pub(crate) fn start(&mut self) -> Vec<DVec3> {
        let cloths = self.scene.cloths.iter();
        let mut positions: Vec<DVec3> = cloths.flat_map(|cloth| cloth.start().iter().copied()).collect();
        for (body, motion) in self.scene.bodies.iter().zip(&self.motions) {
            let pose = motion.pose(0.0);
            let place = |&point: &DVec3| if pose.is_rigid() { pose.apply(point) } else { point };
            positions.extend(body.mesh.positions.iter().map(place));
        }
        for motion in &mut self.motions[..self.scene.bodies.len()] {
            motion.put(0.0, &mut positions);
        }
        positions
    }

    /// Returns the first vertex of a body, as the scene numbers vertices.
    pub(crate) fn first_vertex_of(&self, body: usize) -> u32 {
        let before = &self.scene.bodies[..body];
        let of_bodies: usize = before.iter().map(|body| body.mesh.positions.len()).sum();
        (self.scene.cloth_vertices() + of_bodies) as u32
    }

    /// Returns the triangles of a body, as the scene numbers vertices.
    pub(crate) fn triangles_of(&self, body: usize) -> Vec<[u32; 3]> {
        let first = self.first_vertex_of(body);
        let own = self.scene.bodies[body].mesh.triangles.iter();
        own.map(|triangle| triangle.map(|vertex| first + vertex)).collect()
    }

    pub(crate) fn add_motion(&mut self, motion: BodyMotion, vertices: Vec<u32>) -> Carrier {
        self.motions.push(Kinematic::new(motion, vertices));
        self.motions.len() as Carrier - 1
    }

    /// Makes a vertex of cloth kinematic.
    pub(crate) fn pin(&mut self, vertex: u32, carrier: Carrier) {
        self.inverse_masses[vertex as usize] = 0.0;
        self.carriers[vertex as usize] = carrier;
    }
}
