//! Pins: vertices that keyframes, a body, or the caller move. Hard pins make them kinematic; [soft pins](super::soft_pins) pull
//! them with springs.

pub use super::selection::PinMotion;

use super::registration::{Effect, Registration, Scope};
use super::selection::{check_body, check_vertices, group_keys, placed, read_motion, read_vertices};
use super::soft_pins::{OfGroup, SoftPins};
use crate::effects::plan::Plan;
use crate::input::{Field, MEMBRANE_STIFFNESS, RATIO, ValueError};
use crate::model::step::Carrier;
use crate::solve::springs::Held;
use crate::world::{BodyMotion, KeyframeMotion, NO_VERTEX, SceneParts};

const STIFFNESS: Field = Field::new("stiffness", MEMBRANE_STIFFNESS, 1e-6, 1e9);
const WEIGHT: Field = Field::new("weights", RATIO, 0.0, 1.0);

pub(super) const REGISTRATION: Registration = Registration::new(&["group"], |table, world| {
    let mut pins = Pins::default();
    let mut taken = Taken::new(world);
    for table in table.tables("group")? {
        table.expect_keys(&group_keys(&[STIFFNESS.name, WEIGHT.name]))?;
        let group = PinGroup {
            stiffness: table.number(&STIFFNESS)?,
            weights: table.numbers(&WEIGHT)?.unwrap_or_default(),
            ..PinGroup::new(read_vertices(&table, world)?, read_motion(&table, world)?)
        };
        pins.groups.push(group);
        let checked = pins.check_group(pins.groups.len() - 1, world, &mut taken);
        checked.map_err(|error| placed(&table, error))?;
    }
    Ok(Box::new(pins))
});

/// Vertices of the cloth that follow a prescribed motion. Forces do not move them, unless the pins are
/// [soft](PinGroup::stiffness).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pins {
    /// Groups of vertices. A hard pin may be in several groups if their motions are the same and not driven, such as the corner
    /// of two sides. The forces of soft pins at one vertex add up.
    pub groups: Vec<PinGroup>,
}

/// The group of each vertex with a hard pin so far.
struct Taken(Vec<Option<usize>>);

impl Taken {
    fn new(world: &SceneParts<'_>) -> Self {
        Self(vec![None; world.cloth_vertices()])
    }
}

impl Pins {
    /// Checks a group against those before it, and marks its vertices as taken.
    fn check_group(&self, index: usize, world: &SceneParts<'_>, taken: &mut Taken) -> Result<(), ValueError> {
        let group = &self.groups[index];
        let mut is_own = vec![false; taken.0.len()];
        check_vertices(&group.vertices, &mut is_own, "pinned")?;
        let is_driven = matches!(&group.motion, PinMotion::Own(BodyMotion::Driven(_)));
        group.check_softness()?;
        for (place, &vertex) in group.vertices.iter().enumerate() {
            if group.soft_stiffness(place).is_some() {
                continue;
            }
            let before = taken.0[vertex as usize].replace(index);
            if before.is_some_and(|before| is_driven || self.groups[before].motion != group.motion) {
                let message = format!("vertex {vertex} is pinned twice, with different motions");
                return Err(ValueError::new("vertices", message));
            }
        }
        group.check(world)
    }
}

/// A group of pinned vertices with a common motion.
///
/// ```
/// use selvedge_cloth::effects::{Gravity, PinGroup, Pins, RopeStretch};
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Cloth, Scene, Simulation};
///
/// // Soft pins carry a rope of 10 g. They pull with 5 N/m at one end, and with half of that at the other.
/// let rope = Cloth::rope(&[DVec3::ZERO, DVec3::X], 1, 0.01)?;
/// let mut scene = Scene::new(rope, 4e-3);
/// scene.add(Gravity::default()).add(RopeStretch::new(1000.0));
/// let ends = PinGroup { stiffness: Some(5.0), weights: vec![1.0, 0.5], ..PinGroup::resting([0, 1]) };
/// scene.add(Pins { groups: vec![ends] });
/// let mut simulation = Simulation::new(scene, 1)?;
/// while simulation.time() < 20.0 {
///     simulation.step()?;
/// }
/// let sag = 0.005 * 9.81 / 5.0;
/// let [first, second] = [0, 1].map(|end| -simulation.positions()[end].z);
/// assert!((first / sag - 1.0).abs() < 1e-3 && (second / sag - 2.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PinGroup {
    /// The vertices, as the scene numbers them through all cloths. [`Scene::part`](crate::Scene::part) returns named ones.
    pub vertices: Vec<u32>,
    /// The motion. Hard pins have it themselves; soft pins pull towards it.
    pub motion: PinMotion,
    /// The stiffness in N/m of a soft pin of weight 1; `None` if the pins are hard.
    ///
    /// A soft pin is a spring without damping between its vertex and the place where a hard pin would hold the vertex. It pulls
    /// with its stiffness, times its weight, times the distance.
    pub stiffness: Option<f64>,
    /// A weight from 0 to 1 for each of the vertices, in their order; empty if all are 1. A vertex of weight 0 is free. Hard pins
    /// have weights of 0 and 1 only.
    pub weights: Vec<f64>,
}

impl PinGroup {
    /// Moves vertices with hard pins.
    #[must_use]
    pub fn new(vertices: impl Into<Vec<u32>>, motion: PinMotion) -> Self {
        Self {
            vertices: vertices.into(),
            motion,
            stiffness: None,
            weights: Vec::new(),
        }
    }

    /// Holds vertices at their initial positions, with hard pins.
    #[must_use]
    pub fn resting(vertices: impl Into<Vec<u32>>) -> Self {
        Self::new(vertices, PinMotion::Own(KeyframeMotion::resting().into()))
    }

    /// Returns the stiffness of a soft pin, by its place in the group: zero if the vertex is free, and `None` if the pin is hard.
    pub(super) fn soft_stiffness(&self, place: usize) -> Option<f64> {
        let weight = self.weights.get(place).copied().unwrap_or(1.0);
        match self.stiffness {
            Some(stiffness) => Some(stiffness * weight),
            None if weight == 1.0 => None,
            None => Some(0.0),
        }
    }

    fn check_softness(&self) -> Result<(), ValueError> {
        self.stiffness.map_or(Ok(()), |stiffness| STIFFNESS.check(stiffness))?;
        let [weights, vertices] = [self.weights.len(), self.vertices.len()];
        if weights != 0 && weights != vertices {
            let message = format!(
                "`weights` has {weights} numbers for {vertices} vertices: give one number for each vertex, in the order of the \
                 vertices"
            );
            return Err(ValueError::new("weights", message));
        }
        for (vertex, &weight) in self.vertices.iter().zip(&self.weights) {
            WEIGHT.check(weight).map_err(|error| {
                let message = format!("{}, at vertex {vertex}", error.message);
                ValueError::new("weights", message)
            })?;
            if self.stiffness.is_none() && weight > 0.0 && weight < 1.0 {
                let message = format!(
                    "vertex {vertex} has the weight {weight}, which needs soft pins: give `stiffness` in N/m, or weights of 0 \
                     and 1 only"
                );
                return Err(ValueError::new("weights", message));
            }
        }
        Ok(())
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        match &self.motion {
            &PinMotion::Body(body) => {
                check_body(body, world)?;
                match &world.bodies[body].motion {
                    BodyMotion::Keyframes(motion) => motion.check_speed(&world.positions_of(&self.vertices)),
                    BodyMotion::Animated(_) => {
                        let name = &world.bodies[body].name;
                        let message = format!("pins cannot follow '{name}', which deforms; give them a motion of their own");
                        Err(ValueError::new("follow", message))
                    }
                    BodyMotion::Free(_) if (0..self.vertices.len()).any(|place| self.soft_stiffness(place).is_some()) => {
                        let name = &world.bodies[body].name;
                        let message = format!(
                            "soft pins cannot follow '{name}', which moves freely (it has a mass): leave out `stiffness` and \
                             `weights`, so that the vertices move with it"
                        );
                        Err(ValueError::new("follow", message))
                    }
                    BodyMotion::Driven(_) | BodyMotion::Free(_) => Ok(()),
                }
            }
            PinMotion::Own(motion) => motion.check(&world.positions_of(&self.vertices), world.time_step),
        }
    }
}

crate::identify!(Pins { groups });
crate::identify!(PinGroup {
    vertices,
    motion,
    stiffness,
    weights
});

impl Effect for Pins {
    fn name(&self) -> &'static str {
        "pins"
    }

    fn scope(&self) -> Scope {
        Scope::Scene
    }

    fn check(&self, world: &SceneParts<'_>) -> Result<(), ValueError> {
        if self.groups.is_empty() {
            return Err(ValueError::new("group", "pins need at least one [[effects.pins.group]]"));
        }
        let mut taken = Taken::new(world);
        (0..self.groups.len()).try_for_each(|index| self.check_group(index, world, &mut taken))
    }

    fn register(&self, plan: &mut Plan<'_>) {
        let mut soft = SoftPins::default();
        for (index, group) in self.groups.iter().enumerate() {
            let (mut moved, mut hard, mut pins) = (Vec::new(), Vec::new(), Vec::new());
            for (place, vertex) in plan.scene.numbered(&group.vertices).into_iter().enumerate() {
                let stiffness = group.soft_stiffness(place);
                moved.push(if stiffness.is_none() { vertex } else { NO_VERTEX });
                match stiffness {
                    None => hard.push(vertex),
                    Some(stiffness) if stiffness > 0.0 => pins.push((place as u32, vertex, stiffness)),
                    Some(_) => {}
                }
            }
            let carrier = match &group.motion {
                PinMotion::Body(body) => *body as Carrier,
                PinMotion::Own(motion) => plan.add_motion(motion.clone(), moved),
            };
            plan.pins.push(carrier);
            hard.iter().for_each(|&vertex| plan.pin(vertex, carrier));
            plan.pinned.push(hard);
            let of_group = OfGroup {
                group: index,
                motion: &group.motion,
                carrier,
                pins,
            };
            soft.add(of_group, plan);
        }
        if !soft.is_empty() {
            plan.add_term(Held::new(soft));
        }
    }
}
