//! What a step consists of, put together by the effects that a scene calls for.
//!
//! Each effect registers what it does into one of the phases below and owns its data. A phase without entries does not exist;
//! effects run in the order of the registry, not of the file.
//!
//! Where there are several cloths, an effect that acts on each by itself registers once for each. What it does then is
//! [shown](super::of_cloth) the vertices of that cloth alone; where there is one cloth it sees everything, and nothing stands in between.

use super::of_cloth::OfCloth;
use crate::contact::ContactSettings;
use crate::model::bending::Yield;
use crate::model::hierarchy::{Hierarchy, Level};
use crate::model::step::{Carrier, Constraint, FREE, Force};
use crate::model::stitches::Tie;
use crate::model::tearing::Tearable;
use crate::world::{BodyMotion, Cloth, Kinematic, SceneParts};
use selvedge_core::glam::DVec3;
use std::ops::Range;
use std::sync::Arc;

/// An entry of a phase and the effect that it belongs to.
#[derive(Debug)]
pub(crate) struct Entry<T: ?Sized> {
    /// Index into the scene's effects.
    pub(crate) effect: usize,
    pub(crate) action: Box<T>,
}

/// What the scene's effects say of the fabric before any of them registers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fabric {
    /// How stiff warp and weft are, in N/m; `None`: no effect makes them so.
    pub(crate) stretch: Option<[f64; 2]>,
    /// How stiff the angle between warp and weft is, in N/m; `None`: no effect makes it so.
    pub(crate) shear: Option<f64>,
    /// What it keeps from itself, in metres; `None`: no effect makes it so.
    pub(crate) thickness: Option<f64>,
    /// When folds stay; `None`: never.
    pub(crate) folds: Option<Yield>,
}

/// What a step consists of: effects put into it what they do.
#[derive(Debug)]
pub struct Plan<'a> {
    pub(crate) scene: SceneParts<'a>,
    /// The effect that is registering.
    pub(crate) effect: usize,
    /// The cloth that it acts on; `None`: the whole scene.
    cloth: Option<usize>,
    /// Of each cloth.
    pub(crate) fabrics: Vec<Fabric>,
    /// Of each cloth, its vertices among the scene's.
    vertices: Vec<Range<usize>>,
    /// Of the vertices of all cloths, in 1/kg.
    pub(crate) inverse_masses: Vec<f64>,
    /// Of the vertices of all cloths.
    pub(crate) carriers: Vec<Carrier>,
    /// Bodies' motions, then those of pins.
    pub(crate) motions: Vec<Kinematic>,
    /// Of each group of pins.
    pub(crate) pins: Vec<Carrier>,
    /// Single vertices that seams join: those of ropes are to know of it.
    pub(crate) ties: Vec<Tie>,
    pub(crate) forces: Vec<Entry<dyn Force>>,
    pub(crate) constraints: Vec<Entry<dyn Constraint>>,
    pub(crate) contact: ContactSettings,
    pub(crate) friction: Vec<Entry<dyn Constraint>>,
    /// Of cloths that may tear.
    pub(crate) tearable: Vec<Tearable>,
    /// Of each cloth: made for the first effect that asks for levels.
    hierarchies: Vec<Option<Hierarchy<'a>>>,
}

impl<'a> Plan<'a> {
    /// A plan without any effect.
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
            friction: Vec::new(),
            tearable: Vec::new(),
        }
    }

    /// Lets an effect register, by its index: for one of the cloths, or for the whole scene.
    pub(crate) fn begin(&mut self, effect: usize, cloth: Option<usize>) {
        (self.effect, self.cloth) = (effect, cloth);
        self.scene = self.scene.of_cloth(cloth);
    }

    /// The cloth that the registering effect acts on: the first if it acts on the whole scene.
    pub(crate) fn cloth(&self) -> usize {
        self.cloth.unwrap_or(0)
    }

    /// What the effects say of the cloth that the registering one acts on.
    pub(crate) fn fabric(&self) -> Fabric {
        self.fabrics[self.cloth()]
    }

    /// Of the vertices that the registering effect sees of cloth, in 1/kg.
    pub(crate) fn inverse_masses(&self) -> &[f64] {
        match self.cloth {
            Some(cloth) => &self.inverse_masses[self.vertices[cloth].clone()],
            None => &self.inverse_masses,
        }
    }

    /// The vertices of the cloth that the registering effect acts on, if there are others.
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

    /// What it acts on.
    #[must_use]
    pub fn scene(&self) -> SceneParts<'a> {
        self.scene
    }

    /// The mass of each vertex of the cloth that it acts on, in kg: a third of its triangles', and half of its loose edges'.
    #[must_use]
    pub fn masses(&self) -> Vec<f64> {
        self.scene.cloth.masses()
    }

    /// Forces act in the order in which effects put them here, before anything else.
    pub fn add_force(&mut self, force: impl Force + 'static) {
        let force: Box<dyn Force> = match self.part() {
            Some(vertices) => Box::new(OfCloth::new(vertices, force)),
            None => Box::new(force),
        };
        self.forces.push(self.entry(force));
    }

    /// Constraints act in the order in which effects put them here, after forces and before contact.
    pub fn add_constraint(&mut self, constraint: impl Constraint + 'static) {
        let constraint: Box<dyn Constraint> = match self.part() {
            Some(vertices) => Box::new(OfCloth::new(vertices, constraint)),
            None => Box::new(constraint),
        };
        self.constraints.push(self.entry(constraint));
    }

    /// The same, of a constraint that knows vertices as the scene numbers them.
    pub(crate) fn add_constraint_on_scene(&mut self, constraint: impl Constraint + 'static) {
        self.constraints.push(self.entry(Box::new(constraint)));
    }

    /// The number in the scene of the first vertex of the cloth that it acts on.
    pub(crate) fn first_vertex(&self) -> u32 {
        self.part().map_or(0, |vertices| vertices.start as u32)
    }

    /// Runs after all contacts.
    pub(crate) fn add_friction(&mut self, friction: impl Constraint + 'static) {
        self.friction.push(self.entry(Box::new(friction)));
    }

    /// Tears the cloth that it acts on.
    pub(crate) fn add_tearable(&mut self, tearable: Tearable) {
        self.tearable.push(tearable.placed(self.effect, self.cloth()));
    }

    /// Coarser levels of the cloth that it acts on, from fine to coarse, whose seeds are no farther apart than `coarsest`: the `most` finest of them.
    ///
    /// Pins are known: they register before.
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

    /// Where all vertices are at the start, but for pinned ones: those of cloths, then the bodies'.
    pub(crate) fn start(&mut self) -> Vec<DVec3> {
        let cloths = self.scene.cloths.iter();
        let mut positions: Vec<DVec3> = cloths.flat_map(|cloth| cloth.mesh.positions.iter().copied()).collect();
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

    /// The triangles of a body, on all vertices.
    pub(crate) fn triangles_of(&self, body: usize) -> Vec<[u32; 3]> {
        let before = &self.scene.bodies[..body];
        let of_bodies: usize = before.iter().map(|body| body.mesh.positions.len()).sum();
        let first = (self.scene.cloth_vertices() + of_bodies) as u32;
        let own = self.scene.bodies[body].mesh.triangles.iter();
        own.map(|triangle| triangle.map(|vertex| first + vertex)).collect()
    }

    /// Adds what moves these vertices.
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
