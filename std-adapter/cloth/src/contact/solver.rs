//! Contact as the simulation calls it: constraints in the solver, then the [certified pass](super::pass).

use super::candidate::{Candidate, time_of_impact_of};
use super::candidates::{Candidates, candidates};
use super::constraints::{self, ContactConstraint, NearPair};
use super::impact_zones::ImpactZones;
use super::relaxation::Relaxation;
use super::report::{ContactCounts, ContactSeconds, described};
use super::settings::ContactSettings;
use crate::step::{Carrier, TimeStep, Touches};
use selvedge::TopologyError;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::gap::GapError;
use selvedge_core::separation::largest_coordinate;
use selvedge_core::verification::lanes::Lanes;
use std::time::Instant;

/// Everything that contact needs, made only if an effect asks for it.
#[derive(Debug)]
pub(crate) struct ContactSolver {
    pub(crate) settings: ContactSettings,
    pub(super) candidates: Candidates,
    /// Of each vertex: whose motion it follows.
    pub(super) carriers: Vec<Carrier>,
    /// Of each vertex, for the thickness that neighbours can have.
    rest: Vec<DVec3>,
    /// Of gaps between positions of this step.
    pub(super) error: GapError<f64>,
    constraints: Vec<ContactConstraint>,
    pub(super) moved: Vec<bool>,
    pub(super) relaxation: Relaxation,
    pub(super) zones: ImpactZones,
    /// Bodies whose pairs have left the promise.
    pub(super) yielding: Vec<bool>,
    pub(crate) counts: ContactCounts,
    pub(crate) stages: ContactSeconds,
}

impl ContactSolver {
    /// `None` if no effect asks for contact. `rest` and `carriers` are of all vertices, the cloth's first.
    pub(crate) fn new(
        mut settings: ContactSettings,
        triangles: &[[u32; 3]],
        rest: &[DVec3],
        carriers: &[Carrier],
        cloth_vertices: usize,
        bodies: usize,
    ) -> Result<Option<Self>, TopologyError> {
        if settings.all().next().is_none() {
            return Ok(None);
        }
        Ok(Some(Self {
            candidates: candidates(&mut settings, triangles, rest, carriers, cloth_vertices)?,
            settings,
            carriers: carriers.to_vec(),
            rest: rest.to_vec(),
            error: GapError::of_coordinates(0.0),
            constraints: Vec::new(),
            moved: vec![false; rest.len()],
            relaxation: Relaxation::default(),
            zones: ImpactZones::default(),
            yielding: vec![false; bodies],
            counts: ContactCounts::default(),
            stages: ContactSeconds::default(),
        }))
    }

    /// Forgets the steps before; the next one is expected to lead from `start` to `end` in `h` seconds.
    pub(crate) fn refresh(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        let begin = Instant::now();
        self.candidates.refresh(start, end, h);
        self.stages.candidates += begin.elapsed().as_secs_f64();
    }

    /// The first pair that touches, after [`refresh`](Self::refresh), or the first edge that passes through a face.
    pub(crate) fn first_touching(&self, positions: &[DVec3]) -> Option<String> {
        let error = gap_error(positions, positions);
        let touching = self.candidates.list.iter().find(|pair| {
            pair.distance_from_below(positions, error) == 0.0 && time_of_impact_of(pair, [positions, positions], 0.0).is_some()
        });
        touching
            .map(|pair| described(pair.kind, pair.vertices))
            .or_else(|| self.candidates.interest().first_crossing(positions))
    }

    /// Sets up the contacts of a step of `h` seconds that so far leads to `predicted`.
    pub(crate) fn prepare(&mut self, start: &[DVec3], predicted: &[DVec3], h: f64) {
        let begin = Instant::now();
        self.error = gap_error(start, predicted);
        let Self {
            constraints,
            candidates,
            settings,
            rest,
            error,
            ..
        } = self;
        constraints::collect(
            constraints,
            &mut candidates.list,
            settings,
            rest,
            [start, predicted],
            h,
            *error,
        );
        self.stages.constraints += begin.elapsed().as_secs_f64();
    }

    /// Pushes apart what is too near: cloth and bodies, or cloth and cloth.
    pub(crate) fn push(&mut self, with_body: bool, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) {
        self.counts.pushed += constraints::project(&self.constraints, with_body, step, positions, touches);
    }

    /// The pairs that the last part of a step had constraints on.
    pub(crate) fn near_pairs(&self) -> impl Iterator<Item = NearPair> {
        constraints::near_pairs(&self.constraints)
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

    /// Takes bodies back into the promise that are apart from the cloth by their separation. A coarse mesh may pass through another one
    /// with all its vertices and edges far from the other's: that is asked for by itself.
    pub(crate) fn take_back(&mut self, positions: &[DVec3]) {
        for body in 0..self.yielding.len() {
            if !self.yielding[body] {
                continue;
            }
            let pairs = self.candidates.list.iter().filter(|pair| pair.data.body == body as Carrier);
            let is_apart = |pair: &Candidate| {
                let separation = self.settings.of(pair).map_or(0.0, |t| t.separation);
                pair.distance_from_below(positions, self.error) > separation
            };
            let is_apart = pairs.clone().all(is_apart) && !self.candidates.interest().passes_through(body as Carrier, positions);
            self.yielding[body] = !is_apart;
        }
    }
}

/// Of gaps between these positions.
pub(super) fn gap_error(start: &[DVec3], end: &[DVec3]) -> GapError<f64> {
    GapError::of_coordinates(largest_coordinate(start).larger(largest_coordinate(end)))
}
