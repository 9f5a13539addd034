//! The plan of a step. Effects register with it.
//!
//! Each effect puts forces and constraints into the phases below, and owns their data. A phase without entries costs nothing.
//! Effects run in the order of the registry; the file's order does not matter.
//!
//! An effect that acts on each cloth by itself registers once for each, and [sees](super::of_cloth) the vertices of that cloth
//! alone. In a scene of one cloth it sees everything, without any indirection.

use super::air::Drag;
use super::of_cloth::OfCloth;
use crate::contact::ContactSettings;
use crate::contact::smooth_body::SmoothBody;
use crate::model::bending::{Hinge, Yield};
use crate::model::hierarchy::{Hierarchy, Level};
use crate::model::schedule::On;
use crate::model::step::{Carrier, Constraint, FREE, Force};
use crate::model::stitches::Tie;
use crate::model::tearing::Tearable;
use crate::solve::air::{Blowing, InAir};
use crate::solve::bending::Bending;
use crate::solve::membranes::Membranes;
use crate::solve::ropes::Ropes;
use crate::solve::walls::{Filling, Walls};
use crate::solve::{Accuracy, Term};
use crate::world::{BodyMotion, Cloth, Kinematic, SceneParts};
use selvedge_core::glam::DVec3;
use std::ops::Range;
use std::sync::Arc;

#[derive(Debug)]
pub(crate) struct Entry<T: ?Sized> {
    /// Index into the scene's effects.
    pub(crate) effect: usize,
    pub(crate) action: Box<T>,
}

impl<T: ?Sized> Entry<T> {
    pub(crate) const fn of(effect: usize, action: Box<T>) -> Self {
        Self { effect, action }
    }
}

/// Properties of a cloth that its effects announce before any of them registers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fabric {
    /// Stretch stiffness of warp and weft, in N/m.
    pub(crate) stretch: Option<[f64; 2]>,
    /// Stiffness of the angle between warp and weft, in N/m.
    pub(crate) shear: Option<f64>,
    /// True if the stretch of the cloth is limited.
    pub(crate) is_limited: bool,
    /// True if stretch and shear are [solved together](crate::model::elasticity).
    pub(crate) is_solved_together: bool,
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
    /// Single vertices that seams join; ropes need to know them.
    pub(crate) ties: Vec<Tie>,
    pub(crate) forces: Vec<Entry<dyn Force>>,
    pub(crate) constraints: Vec<Entry<dyn Constraint>>,
    pub(crate) contact: ContactSettings,
    pub(crate) pushes: Vec<Entry<dyn Constraint>>,
    pub(crate) friction: Vec<Entry<dyn Constraint>>,
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
    accuracy: Option<Accuracy>,
    /// The hierarchies of levels by cloth, made for the first effect that needs them.
    hierarchies: Vec<Option<Hierarchy<'a>>>,
}

impl<'a> Plan<'a> {
    pub(crate) fn new(scene: SceneParts<'a>) -> Self {
        let count = scene.cloth_vertices();
        let mut first = count as u32;
        let motions = scene.bodies.iter().map(|body| {
            let vertices = first..first + body.mesh.positions.len() as u32;
            first = vertices.end;
            Kinematic::new(body.motion.clone(), vertices.collect())
        });
        Self {
            motions: motions.collect(),
            pins: Vec::new(),
            ties: Vec::new(),
            scene,
            effect: 0,
            cloth: None,
            fabrics: Vec::new(),
            vertices: scene.vertices_of_cloths().collect(),
            hierarchies: scene.cloths.iter().map(|_| None).collect(),
            inverse_masses: scene.cloths.iter().flat_map(Cloth::masses).map(f64::recip).collect(),
            carriers: vec![FREE; count],
            forces: Vec::new(),
            constraints: Vec::new(),
            contact: ContactSettings::new(scene.cloths.iter().map(|cloth| cloth.mesh.positions.len())),
            pushes: Vec::new(),
            friction: Vec::new(),
            tearable: Vec::new(),
            terms: Vec::new(),
            of_cloths: scene.cloths.iter().map(|_| OfCloths::default()).collect(),
            hinges: Vec::new(),
            smooth_bodies: Vec::new(),
            drag: Vec::new(),
            friction_coefficient: 0.0,
            accuracy: scene.accuracy,
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

    /// Returns the inverse masses, in 1/kg, of the vertices that the registering effect sees.
    pub(crate) fn inverse_masses(&self) -> &[f64] {
        match self.cloth {
            Some(cloth) => &self.inverse_masses[self.vertices[cloth].clone()],
            None => &self.inverse_masses,
        }
    }

    /// Returns the vertices of the cloth on which the registering effect acts, if there are several cloths.
    fn part(&self) -> Option<Range<usize>> {
        let cloth = self.cloth.filter(|_| self.vertices.len() > 1)?;
        Some(self.vertices[cloth].clone())
    }

    fn entry<T: ?Sized>(&self, action: Box<T>) -> Entry<T> {
        Entry {
            effect: self.effect,
            action,
        }
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

    /// Returns whether the scene has one solve a step.
    pub(crate) fn solves_at_once(&self) -> bool {
        self.accuracy.is_some()
    }

    /// Adds a term of the energy that a step minimises. It numbers vertices as the scene does.
    pub fn add_term(&mut self, term: impl Term + 'static) {
        self.terms.push(self.entry(Box::new(term)));
    }

    /// Returns the first triangle of the cloth among those of all cloths.
    fn first_triangle(&self) -> usize {
        self.scene.cloths[..self.cloth()].iter().map(|cloth| cloth.mesh.triangles.len()).sum()
    }

    /// Returns the membranes of the cloth.
    pub(crate) fn membranes(&mut self) -> &mut Membranes {
        let (effect, cloth, first) = (self.effect, self.scene.cloth, self.first_vertex());
        let first_triangle = self.first_triangle();
        let own = self.cloth();
        let membranes = self.of_cloths[own].membranes.get_or_insert_with(|| (effect, Membranes::new(cloth, first, first_triangle)));
        &mut membranes.1
    }

    /// Returns the ropes of the cloth.
    pub(crate) fn ropes(&mut self) -> &mut Ropes {
        let (effect, cloth, first) = (self.effect, self.scene.cloth, self.first_vertex());
        let own = self.cloth();
        &mut self.of_cloths[own].ropes.get_or_insert_with(|| (effect, Ropes::new(cloth, first))).1
    }

    /// Adds the bending of the cloth.
    pub(crate) fn add_bending(&mut self, hinges: &[On<Hinge, 4>], folds: Option<(Yield, &[u32])>) {
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
        let triangles = cloth.mesh.triangles.iter().map(|corners| corners.map(|vertex| vertex + first));
        let edges = cloth.topology.loose_edges().map(|ends| ends.map(|vertex| vertex + first));
        let triangles = (self.first_triangle(), triangles.collect());
        self.add_term(InAir::new(air, [drag.over(1.0), drag.rope_diameter], triangles, edges.collect()));
    }

    /// Adds a rate, in 1/s, at which still air slows the cloth.
    pub(crate) fn add_drag(&mut self, rate: f64) {
        let all = 0..self.inverse_masses.len();
        self.drag.resize(all.len(), 0.0);
        let own = self.part().unwrap_or(all);
        self.drag[own].iter_mut().for_each(|drag| *drag += rate);
    }

    /// Adds a force. Forces run first in a step, in the order of these calls.
    pub fn add_force(&mut self, force: impl Force + 'static) {
        let force: Box<dyn Force> = match self.part() {
            Some(vertices) => Box::new(OfCloth::new(vertices, force)),
            None => Box::new(force),
        };
        self.forces.push(self.entry(force));
    }

    /// Adds a constraint. Constraints run after forces and before contact, in the order of these calls.
    pub fn add_constraint(&mut self, constraint: impl Constraint + 'static) {
        let constraint: Box<dyn Constraint> = match self.part() {
            Some(vertices) => Box::new(OfCloth::new(vertices, constraint)),
            None => Box::new(constraint),
        };
        self.constraints.push(self.entry(constraint));
    }

    /// Adds a constraint that numbers vertices as the scene does.
    pub(crate) fn add_constraint_on_scene(&mut self, constraint: impl Constraint + 'static) {
        self.constraints.push(self.entry(Box::new(constraint)));
    }

    /// Returns the number in the scene of the cloth's first vertex.
    pub(crate) fn first_vertex(&self) -> u32 {
        self.part().map_or(0, |vertices| vertices.start as u32)
    }

    /// Adds a constraint that runs after all others, whenever contacts push. It numbers vertices as the scene does.
    pub(crate) fn add_push(&mut self, push: impl Constraint + 'static) {
        self.pushes.push(self.entry(Box::new(push)));
    }

    /// Adds a constraint that runs after all contacts.
    pub(crate) fn add_friction(&mut self, friction: impl Constraint + 'static) {
        self.friction.push(self.entry(Box::new(friction)));
    }

    pub(crate) fn add_tearable(&mut self, tearable: Tearable) {
        self.tearable.push(tearable.placed(self.effect, self.cloth()));
    }

    /// Returns coarser levels of the cloth, from fine to coarse, with seeds at most `coarsest` apart; only the `most` finest of
    /// them.
    ///
    /// Pins register earlier, so the levels know them.
    pub(crate) fn levels(&mut self, coarsest: f64, most: Option<u32>) -> Vec<Arc<Level>> {
        if most == Some(0) || coarsest <= 0.0 {
            return Vec::new();
        }
        let scene = self.scene;
        let is_pinned: Vec<bool> = self.inverse_masses().iter().map(|&inverse| inverse == 0.0).collect();
        let make = || Hierarchy::new(scene.cloth, scene.cloth.masses(), is_pinned);
        let cloth = self.cloth();
        let hierarchy = &mut self.hierarchies[cloth];
        let mut levels = hierarchy.get_or_insert_with(make).levels_to(coarsest);
        levels.truncate(most.map_or(usize::MAX, |most| most as usize));
        levels
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

    /// Returns the triangles of a body, as the scene numbers vertices.
    pub(crate) fn triangles_of(&self, body: usize) -> Vec<[u32; 3]> {
        let before = &self.scene.bodies[..body];
        let of_bodies: usize = before.iter().map(|body| body.mesh.positions.len()).sum();
        let first = (self.scene.cloth_vertices() + of_bodies) as u32;
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
