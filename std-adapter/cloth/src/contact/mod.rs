//! Contact: cloth with itself and with bodies.
//!
//! | module | what it does |
//! |---|---|
//! | `detect` | candidate pairs: the one place that knows the broad phase |
//! | `horizon` | for how many steps they are good |
//! | `sieve` | candidates that keep apart until the next search, neighbours on the mesh among them |
//! | `pair` | one pair: the direction that keeps it apart, the certified time of impact |
//! | `rows` | contacts as constraints of the solver |
//! | `pass`, `zones` | no step is accepted that is not certified |
//! | `start` | whether triangles pass through each other where a simulation starts |
//!
//! Pairs may be left out of forces, never out of certificates: neighbours on the mesh are pairs like any other.

mod closest;
mod detect;
mod horizon;
mod pair;
mod pass;
mod rows;
mod sieve;
mod start;
mod zones;

pub use pass::ContactCounts;
pub(crate) use pass::LARGEST_TURN;
pub(super) use rows::RECOVERY;

use super::plan::{Frame, StepInput, Touches};
use super::scene::table::Table;
use super::scene::{LENGTH, SceneError};
use detect::{Detector, Wanted};
use horizon::Horizon;
use pair::Pair;
use rows::Row;
use selvedge::PairKind;
use selvedge::{Topology, TopologyError};
use selvedge_core::glam::DVec3;
use selvedge_core::separation::course::room;
use selvedge_core::separation::gap::GapError;
use sieve::{Distances, Neighbours};
use std::sync::Arc;
use std::time::Instant;
use zones::Zones;

/// What the effects ask for: each with its index among the scene's effects.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ContactSettings {
    /// Cloth with itself.
    pub(crate) cloth: Option<(usize, Thickness)>,
    /// Cloth with bodies.
    pub(crate) bodies: Option<(usize, Thickness)>,
    /// The largest thickness of [neighbours](sieve), in metres, if they have one of their own.
    pub(crate) neighbours: Option<f64>,
}

/// Two distances: one that contacts aim at, and a smaller one that every step is certified to keep.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Thickness {
    /// In metres.
    pub(crate) thickness: f64,
    /// In metres. The gap between the two is what keeps repairs of a step rare.
    pub(crate) separation: f64,
}

impl Blocker {
    /// The pair that is in the way, in words.
    pub(crate) fn pair(&self) -> String {
        pass::described(self.kind, self.vertices)
    }
}

impl ContactSeconds {
    /// Each stage's, in the order of the data flow.
    #[must_use]
    pub fn stages(&self) -> [(&'static str, f64); 4] {
        [
            ("candidate pairs", self.candidates),
            ("contact set-up", self.rows),
            ("certificates", self.certificates),
            ("repairs", self.repairs),
        ]
    }
}

impl Thickness {
    pub(crate) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let thickness = table.required_number("thickness", LENGTH, 1e-5..=0.1)?;
        let separation = table.number("separation", LENGTH, 1e-6..=0.1)?;
        let separation = separation.unwrap_or(0.1 * thickness);
        if separation > 0.9 * thickness {
            let message =
                format!("`separation` is {separation} m, but must be at most nine tenths of the thickness, {thickness} m");
            return Err(table.error("separation", message));
        }
        Ok(Self { thickness, separation })
    }

    /// Both, as settings of an effect.
    pub(crate) fn settings(&self) -> Vec<(&'static str, String)> {
        vec![
            ("thickness", LENGTH.written_short(self.thickness)),
            ("separation", LENGTH.written_short(self.separation)),
        ]
    }
}

impl ContactSettings {
    /// What a pair has to keep.
    fn of(&self, pair: &Pair) -> Option<Thickness> {
        let settings = if pair.is_with_body() { self.bodies } else { self.cloth };
        settings.map(|(_, thickness)| thickness)
    }

    /// The thickness that a pair can have: `thickness`, but for neighbours.
    fn thickness_of(&self, pair: &Pair, thickness: f64, rest: &[DVec3]) -> f64 {
        if pair.is_with_body() {
            return thickness;
        }
        let own = match self.neighbours {
            Some(smaller) if pair.are_neighbours(rest, NEIGHBOURS_AT_REST * thickness) => smaller,
            _ => thickness,
        };
        own.min(0.5 * pair.closest(rest).distance())
    }

    fn all(&self) -> impl Iterator<Item = Thickness> {
        [self.cloth, self.bodies]
            .into_iter()
            .flatten()
            .map(|(_, thickness)| thickness)
    }
}

/// How far beyond the thickness candidates are looked for, in thicknesses: more makes longer lists that last longer. Measured on the
/// arm sleeve: from 0.2 to 0.7 a step costs the same within a tenth.
const REACH: f64 = 0.3;
/// The same on a fine mesh, which has a small thickness for the way that a vertex goes in a step.
const REACH_OF_FINE: f64 = 0.6;
/// Pairs of cloth are neighbours if their boxes are nearer at rest than this, in thicknesses: among them are all whose thickness is
/// half their distance at rest.
const NEIGHBOURS_AT_REST: f64 = 2.0;
/// Where the largest thickness of neighbours lies, between the separation and the thickness. On a sleeve of 134,000 triangles
/// three quarters of the pairs within the reach are neighbours that are not within theirs.
const NEIGHBOURS: f64 = 0.2;

/// Why a step could not be made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blocker {
    /// In seconds.
    pub time: f64,
    /// Of the pair that is in the way.
    pub kind: PairKind,
    /// Its vertices, those of bodies after the cloth's.
    pub vertices: [u32; 4],
    /// The body in the way; `None` if it is a pin, or the cloth itself.
    pub body: Option<usize>,
}

/// Seconds of what effects share.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactSeconds {
    /// Finding candidate pairs.
    pub candidates: f64,
    /// Setting up contacts as constraints.
    pub rows: f64,
    /// Proving pairs free.
    pub certificates: f64,
    /// Repairing steps that are not free.
    pub repairs: f64,
}

/// Everything that contact needs, made only if an effect asks for it.
#[derive(Debug)]
pub(crate) struct Contact {
    pub(crate) settings: ContactSettings,
    detector: Detector,
    /// Of each vertex: whose motion it follows.
    carriers: Vec<Frame>,
    /// Of each vertex, for the thickness that neighbours can have.
    rest: Vec<DVec3>,
    /// How far vertices may stray along each axis, for candidates to hold every pair within the thickness.
    slack: f64,
    /// The same for every pair that may come within the separation.
    room: f64,
    horizon: Horizon,
    /// Of gaps between positions of this step.
    error: GapError<f64>,
    /// Pairs near the state, each with what is known of it.
    pairs: Vec<Pair>,
    /// Where new ones are put.
    found: Vec<Pair>,
    rows: Vec<Row>,
    moved: Vec<bool>,
    strayed: Vec<bool>,
    zones: Zones,
    /// Bodies whose pairs have left the promise.
    yielding: Vec<bool>,
    pub(crate) counts: ContactCounts,
    pub(crate) stages: ContactSeconds,
}

impl Contact {
    /// `None` if no effect asks for contact. `rest` and `carriers` are of all vertices, the cloth's first.
    pub(crate) fn new(
        mut settings: ContactSettings,
        triangles: &[[u32; 3]],
        rest: &[DVec3],
        carriers: &[Frame],
        cloth_vertices: usize,
        bodies: usize,
    ) -> Result<Option<Self>, TopologyError> {
        if settings.all().next().is_none() {
            return Ok(None);
        }
        let largest = |pick: fn(Thickness) -> f64| settings.all().map(pick).fold(0.0, f64::max);
        let thickness = largest(|thickness| thickness.thickness);
        let separation = largest(|thickness| thickness.separation);
        let wanted = Wanted {
            cloth: settings.cloth.is_some(),
            bodies: settings.bodies.is_some(),
        };
        let topology = Arc::new(Topology::new(rest.len(), triangles.to_vec())?);
        let mut beyond = thickness * REACH;
        let mut neighbours = None;
        if let Some((_, own)) = settings.cloth {
            let at_rest = NEIGHBOURS_AT_REST * own.thickness;
            if sieve::are_many(&topology, rest, cloth_vertices, at_rest) {
                beyond = thickness * REACH_OF_FINE;
                let smaller = own.separation + NEIGHBOURS * (own.thickness - own.separation);
                settings.neighbours = Some(smaller);
                neighbours = Some(Neighbours {
                    at_rest,
                    thickness: smaller,
                });
            }
        }
        let distances = Distances {
            thickness,
            beyond,
            neighbours,
        };
        let least = settings.neighbours.unwrap_or(thickness);
        Ok(Some(Self {
            detector: Detector::new(topology, rest, carriers, cloth_vertices, distances, wanted),
            settings,
            slack: room(beyond, 0.0),
            room: room(beyond, least - separation),
            carriers: carriers.to_vec(),
            rest: rest.to_vec(),
            horizon: Horizon::new(neighbours.is_some()),
            error: GapError::of_coordinates(0.0),
            pairs: Vec::new(),
            found: Vec::new(),
            rows: Vec::new(),
            moved: vec![false; rest.len()],
            strayed: Vec::new(),
            zones: Zones::default(),
            yielding: vec![false; bodies],
            counts: ContactCounts::default(),
            stages: ContactSeconds::default(),
        }))
    }

    /// Forgets everything but the positions: a simulation that goes on from here, and one that is resumed here, are alike.
    pub(crate) fn refresh(&mut self, positions: &[DVec3]) {
        self.pairs.clear();
        self.detector.forget();
        self.horizon.forget();
        self.find_candidates(positions, positions, 1.0);
        self.horizon.forget();
    }

    /// The first pair that touches, after [`refresh`](Self::refresh), or the first edge that passes through a face.
    pub(crate) fn first_touching(&self, positions: &[DVec3]) -> Option<String> {
        let error = pass::error(positions, positions);
        let touching = self.pairs.iter().find(|pair| {
            pair.distance_from_below(positions, error) == 0.0 && pair.time_of_impact([positions, positions], 0.0).is_some()
        });
        touching
            .map(|pair| pass::described(pair.kind, pair.vertices))
            .or_else(|| self.detector.first_crossing(positions))
    }

    /// Sets up the contacts of a step of `h` seconds that so far leads to `predicted`.
    pub(crate) fn prepare(&mut self, start: &[DVec3], predicted: &[DVec3], h: f64) {
        let begin = Instant::now();
        self.error = pass::error(start, predicted);
        let Self {
            rows,
            pairs,
            settings,
            rest,
            error,
            ..
        } = self;
        rows::collect(rows, pairs, settings, rest, [start, predicted], h, *error);
        self.stages.rows += begin.elapsed().as_secs_f64();
    }

    /// Pushes apart what is too near: cloth and bodies, or cloth and cloth.
    pub(crate) fn push(&mut self, with_body: bool, step: &StepInput<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        self.counts.pushed += rows::project(&self.rows, with_body, step, positions, touches);
    }

    /// Takes a body's pairs out of the promise until it is apart from the cloth.
    pub(crate) fn let_pass(&mut self, body: usize) {
        self.yielding[body] = true;
    }

    /// Of each body, whether its pairs have left the promise.
    pub(crate) fn yielding(&self) -> &[bool] {
        &self.yielding
    }

    /// Sets what [`yielding`](Self::yielding) says.
    pub(crate) fn set_yielding(&mut self, yielding: &[bool]) {
        self.yielding.copy_from_slice(yielding);
    }

    /// Takes bodies back into the promise that are apart from the cloth by their separation.
    pub(crate) fn take_back(&mut self, positions: &[DVec3]) {
        for body in 0..self.yielding.len() {
            if !self.yielding[body] {
                continue;
            }
            let pairs = self.pairs.iter().filter(|pair| pair.body == body as Frame);
            let is_apart = |pair: &Pair| {
                let separation = self.settings.of(pair).map_or(0.0, |t| t.separation);
                pair.distance_from_below(positions, self.error) > separation
            };
            self.yielding[body] = !pairs.clone().all(is_apart);
        }
    }
}
