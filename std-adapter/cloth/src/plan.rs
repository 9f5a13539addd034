//! What a step consists of, put together by the effects that a scene calls for.
//!
//! Each effect registers what it does into one of the phases below and owns its data. A phase without entries does not exist;
//! effects run in the order of the registry, not of the file.

use super::contact::ContactSettings;
use super::scene::{Pose, RigidMotion, World};
use selvedge_core::glam::DVec3;
use std::fmt::Debug;

/// What all phases of one step read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StepInput<'a> {
    /// The time at the start of the step, in seconds.
    pub(crate) time: f64,
    /// Its length in seconds.
    pub(crate) h: f64,
    /// Positions at the start.
    pub(crate) start: &'a [DVec3],
    /// Per vertex, in 1/kg; zero where the motion is prescribed.
    pub(crate) inverse_masses: &'a [f64],
    /// Where each frame is at the start and at the end.
    pub(crate) poses: &'a [[Pose; 2]],
}

/// Changes velocities before positions are predicted.
pub(crate) trait Force: Debug + Send {
    fn apply(&mut self, step: &StepInput<'_>, velocities: &mut [DVec3]);
}

/// Moves predicted positions towards where they should be.
pub(crate) trait Constraint: Debug + Send {
    fn project(&mut self, step: &StepInput<'_>, positions: &mut [DVec3], touches: &mut Touches);
}

/// One contact that pushed, for friction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Touch {
    pub(crate) vertices: [u32; 4],
    /// Of each vertex in the relative motion; their sum over both sides is zero if both are vertices.
    pub(crate) weights: [f64; 4],
    pub(crate) normal: DVec3,
    /// By how much the contact moved its two sides apart.
    pub(crate) push: f64,
    /// How far the other side moves in this step, if it is no vertex.
    pub(crate) drift: DVec3,
}

/// The contacts that pushed in this step, in order, if anybody wants to know.
#[derive(Debug, Default)]
pub(crate) struct Touches {
    /// Whether friction asks for them.
    pub(crate) wanted: bool,
    pub(crate) list: Vec<Touch>,
}

impl Touches {
    #[inline]
    pub(crate) fn record(&mut self, touch: impl FnOnce() -> Touch) {
        if self.wanted {
            self.list.push(touch());
        }
    }
}

/// Where a vertex's prescribed motion comes from: an index into [`Plan::frames`].
pub(crate) type Frame = u32;
/// The vertex moves freely.
pub(crate) const FREE: Frame = u32::MAX;

/// An entry of a phase and the effect that it belongs to.
#[derive(Debug)]
pub(crate) struct Entry<T: ?Sized> {
    /// Index into the scene's effects.
    pub(crate) effect: usize,
    pub(crate) action: Box<T>,
}

/// What the effects have registered.
#[derive(Debug)]
pub(crate) struct Plan<'a> {
    pub(crate) world: World<'a>,
    /// The effect that is registering.
    pub(crate) effect: usize,
    /// Of all cloth vertices, in 1/kg.
    pub(crate) inverse_masses: Vec<f64>,
    /// Of all cloth vertices.
    pub(crate) carriers: Vec<Frame>,
    /// Bodies' motions, then those of pins.
    pub(crate) frames: Vec<RigidMotion>,
    pub(crate) forces: Vec<Entry<dyn Force>>,
    pub(crate) constraints: Vec<Entry<dyn Constraint>>,
    pub(crate) contact: ContactSettings,
    pub(crate) friction: Vec<Entry<dyn Constraint>>,
}

impl<'a> Plan<'a> {
    /// A plan without any effect.
    pub(crate) fn new(world: World<'a>) -> Self {
        Self {
            world,
            effect: 0,
            inverse_masses: masses(world).into_iter().map(f64::recip).collect(),
            carriers: vec![FREE; world.cloth.mesh.positions.len()],
            frames: world.bodies.iter().map(|body| body.motion.clone()).collect(),
            forces: Vec::new(),
            constraints: Vec::new(),
            contact: ContactSettings::default(),
            friction: Vec::new(),
        }
    }

    pub(crate) fn add_force(&mut self, force: impl Force + 'static) {
        self.forces.push(Entry {
            effect: self.effect,
            action: Box::new(force),
        });
    }

    pub(crate) fn add_constraint(&mut self, constraint: impl Constraint + 'static) {
        self.constraints.push(Entry {
            effect: self.effect,
            action: Box::new(constraint),
        });
    }

    /// Runs after all contacts.
    pub(crate) fn add_friction(&mut self, friction: impl Constraint + 'static) {
        self.friction.push(Entry {
            effect: self.effect,
            action: Box::new(friction),
        });
    }

    /// Prescribes the motion of a cloth vertex.
    pub(crate) fn pin(&mut self, vertex: u32, frame: Frame) {
        self.inverse_masses[vertex as usize] = 0.0;
        self.carriers[vertex as usize] = frame;
    }
}

/// The mass of each cloth vertex: a third of its triangles', in kg.
pub(crate) fn masses(world: World<'_>) -> Vec<f64> {
    let mesh = &world.cloth.mesh;
    let mut masses = vec![0.0; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        let mass = world.cloth.density * 0.5 * (b - a).cross(c - a).length();
        for &vertex in triangle {
            masses[vertex as usize] += mass / 3.0;
        }
    }
    masses
}
