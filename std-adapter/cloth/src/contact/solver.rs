//! Contact in the form that the simulation calls: constraints in the solver, then the [certified pass](super::pass).

use super::candidate::{Candidate, time_of_impact_of};
use super::candidates::{Candidates, candidates};
use super::cones::Cones;
use super::constraints::{Contacts, Rules};
use super::crossing::{Crossing, PairKey};
use super::exempt::{Exempt, Tangle};
use super::impact_zones::ImpactZones;
use super::relaxation::Relaxation;
use super::report::{ContactCounts, ContactSeconds};
use super::rows::ProximityPair;
use super::settings::ContactSettings;
use crate::model::step::{Carrier, TimeStep, Touches};
use crate::model::touches::LEAST_MISSING;
use selvedge::clock::Clock;
use selvedge::simd::{Level, best_level};
use selvedge::{StepError, Topology};
use selvedge_core::glam::DVec3;
use selvedge_core::separation::carried::is_too_near;
use selvedge_core::separation::gap::GapError;

/// The state of contact; it exists only if an effect requests contacts.
#[derive(Debug)]
pub(crate) struct ContactSolver {
    pub(crate) settings: ContactSettings,
    pub(super) candidates: Candidates,
    /// Whose motion each vertex follows.
    pub(super) carriers: Vec<Carrier>,
    /// The position of each vertex at rest, which limits the thickness of neighbours.
    pub(super) rest: Vec<DVec3>,
    /// The error of gaps between positions of this step.
    pub(super) error: GapError<f64>,
    pub(super) level: Level,
    contacts: Contacts,
    /// The candidates that begin with a push, and the push; the field exists to use its memory again.
    begun: Vec<(usize, f64)>,
    /// The normal cones of surfaces.
    cones: Cones,
    cloth_vertices: u32,
    /// True for vertices that constraints hold together among contacts.
    held_together: Vec<bool>,
    /// True for vertices that seams hold, in scenes with one solve a step.
    sewn: Vec<bool>,
    pub(super) moved: Vec<bool>,
    /// The candidates to test after vertices have moved; the field exists to use its memory again.
    pub(super) places: Vec<usize>,
    pub(super) relaxation: Relaxation,
    pub(super) zones: ImpactZones,
    /// The pairs that certificates leave out.
    pub(super) exempt: Exempt,
    /// True if contacts push; they do not during untangling, since they would push tangled cloth to the wrong side.
    pub(super) pushes: bool,
    pub(crate) counts: ContactCounts,
    pub(crate) stages: ContactSeconds,
}

impl ContactSolver {
    /// `rest` and `carriers` are of all vertices, the cloth's first; `topology` is of all triangles, and the cloth's loose edges. Steps mostly
    /// take `time_step` seconds.
    pub(crate) fn new(
        mut settings: ContactSettings,
        topology: Topology,
        rest: &[DVec3],
        carriers: &[Carrier],
        cloth_vertices: usize,
        bodies: usize,
        time_step: f64,
    ) -> Self {
        Self {
            cones: Cones::new(&topology),
            cloth_vertices: cloth_vertices as u32,
            held_together: vec![false; rest.len()],
            sewn: vec![false; rest.len()],
            candidates: candidates(&mut settings, topology, rest, carriers, cloth_vertices, time_step),
            settings,
            carriers: carriers.to_vec(),
            rest: rest.to_vec(),
            error: GapError::from_largest_coordinate(0.0),
            level: best_level(),
            contacts: Contacts::default(),
            begun: Vec::new(),
            moved: vec![false; rest.len()],
            places: Vec::new(),
            relaxation: Relaxation::default(),
            zones: ImpactZones::default(),
            exempt: Exempt::new(bodies),
            pushes: true,
            counts: ContactCounts::default(),
            stages: ContactSeconds::default(),
        }
    }

    /// Names vertices that seams hold.
    pub(crate) fn sew(&mut self, vertices: impl Iterator<Item = u32>) {
        vertices.for_each(|vertex| self.sewn[vertex as usize] = true);
    }

    /// Names vertices that constraints hold together among contacts.
    pub(crate) fn hold_together(&mut self, vertices: impl Iterator<Item = u32>) {
        vertices.for_each(|vertex| self.held_together[vertex as usize] = true);
    }

    /// Discards the data of the steps before; the next step is expected to lead from `start` to `end` in `h` seconds.
    pub(crate) fn refresh(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        let begin = Clock::now();
        self.candidates.refresh(start, end, h);
        self.contacts.forget();
        self.stages.candidates += begin.elapsed().as_secs_f64();
    }

    /// Exempts edges and faces that meet after [`refresh`](Self::refresh), and pairs that are nearer than rounding can
    /// distinguish, and returns them. Each stays exempt, with [the pairs about it](super::exempt), until it is apart.
    ///
    /// # Errors
    /// Returns an error if a position is not finite.
    pub(crate) fn tolerate(&mut self, positions: &[DVec3]) -> Result<Vec<Crossing>, StepError> {
        let mut tangle = Tangle::new(self.candidates.interest(), positions.len());
        let error = gap_error(&self.candidates, [positions; 2]);
        let touches = |pair: &&Candidate| {
            let distance = pair.distance_from_below(positions, error);
            if distance > 0.0 {
                is_too_near(distance, error)
            } else {
                time_of_impact_of(pair, [positions, positions], 0.0).is_some()
            }
        };
        let touching: Vec<&Candidate> = self.candidates.list.iter().filter(touches).collect();
        let parting = touching.iter().map(|pair| pair.key()).collect();
        tangle.look(self.candidates.interest(), parting, positions)?;
        let mut crossings = tangle.crossings().to_vec();
        let besides = touching.into_iter().filter(|pair| !tangle.links(pair));
        crossings.extend(besides.map(|pair| Crossing::of_touching(pair, positions)));
        self.exempt.tangle = (!tangle.is_empty()).then_some(tangle);
        Ok(crossings)
    }

    /// Sets up the contacts of a step that leads, before contact, from `start` to `predicted`.
    pub(crate) fn prepare(&mut self, start: &[DVec3], predicted: &[DVec3]) {
        let begin = Clock::now();
        self.error = gap_error(&self.candidates, [start, predicted]);
        if self.pushes {
            let (contacts, pairs, rules) = self.parts();
            contacts.collect(pairs, rules, predicted);
        } else {
            self.contacts.clear();
        }
        self.stages.constraints += begin.elapsed().as_secs_f64();
    }

    /// Visits the pairs that may be nearer than their thickness at the end of a step, each with its distance at the start: `guess`
    /// has the positions at which the solve begins, and `goal` those to which everything but contact leads.
    pub(crate) fn visit_near(
        &mut self,
        step: &TimeStep<'_>,
        [guess, goal]: [&[DVec3]; 2],
        visit: &mut dyn FnMut(PairKey, bool, ProximityPair, f64),
    ) {
        let begin = Clock::now();
        self.error = gap_error(&self.candidates, [step.start, guess]).larger(gap_error(&self.candidates, [goal, goal]));
        if self.pushes {
            let (_, pairs, rules) = self.parts();
            Contacts::visit_near(pairs, rules, step, [guess, goal], &mut |pair, near, distance| {
                visit(pair.key(), pair.data.is_with_body(), near, distance);
            });
        }
        self.stages.constraints += begin.elapsed().as_secs_f64();
    }

    /// Pushes pairs apart that are too near: of cloth and bodies, or of cloth and cloth.
    pub(crate) fn push(&mut self, with_body: bool, step: &TimeStep<'_>, positions: &mut [DVec3]) {
        let (contacts, pairs, rules) = self.parts();
        let pushed = contacts.push(with_body, pairs, rules, (step, positions));
        self.counts.pushed += pushed;
    }

    /// Lets the contacts that pushed in the last step begin with that push.
    pub(crate) fn begin(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3]) {
        if !self.pushes {
            return;
        }
        let mut places = std::mem::take(&mut self.begun);
        places.clear();
        let remembered = self.contacts.remembered(step.h);
        places.extend(remembered.filter_map(|(key, push)| Some((self.candidates.place_of(key)?, push))));
        let (contacts, pairs, rules) = self.parts();
        contacts.begin(&places, pairs, rules, (step, positions));
        self.counts.pushed += places.len() as u64;
        self.begun = places;
    }

    /// Stores what has pushed, after a step that was accepted.
    pub(crate) fn remember(&mut self, touches: &Touches, h: f64) {
        self.contacts.remember(&self.held_together, touches, h);
    }

    /// Records by how much contacts miss their thickness at the start of the step.
    pub(crate) fn find_missing(&mut self, step: &TimeStep<'_>, positions: &[DVec3], touches: &mut Touches) {
        let ways = step.start.iter().zip(positions).zip(step.inverse_masses);
        let near = (0..)
            .zip(ways)
            .filter(|(vertex, (_, mass))| **mass == 0.0 && self.candidates.may_have(*vertex));
        let squared = near.map(|(_, ((start, end), _))| start.distance_squared(*end));
        let closing = squared.fold(0.0, f64::max).sqrt();
        let (contacts, pairs, rules) = self.parts();
        contacts.find_missing(pairs, rules, (step, positions), closing, touches);
    }

    /// Moves the rest distances of contacts with the shift.
    pub(crate) fn follow_shift(&mut self, step: &TimeStep<'_>, positions: &[DVec3], touches: &Touches) {
        self.contacts.follow_shift(step, positions, touches);
    }

    /// Lets each contact push or take back once. Returns the largest change, in metres.
    pub(crate) fn sweep(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3]) -> f64 {
        self.contacts.sweep(step, positions)
    }

    /// Returns whether a contact pushed in the last step and is remembered.
    pub(crate) fn has_memory(&self) -> bool {
        self.contacts.remembered(1.0).next().is_some()
    }

    /// The largest change that is not worth another sweep, in metres.
    pub(crate) fn negligible(&self) -> f64 {
        let largest = [false, true].map(|with_body| self.settings.largest(with_body));
        let thickness = largest.into_iter().flatten().map(|largest| largest.thickness);
        LEAST_MISSING * thickness.fold(0.0, f64::max)
    }

    /// Records what pushes now; friction reads this.
    pub(crate) fn record(&mut self, touches: &mut Touches) {
        self.contacts.record(touches);
    }

    /// The contacts, their candidates, and the rules for them.
    fn parts(&mut self) -> (&mut Contacts, &mut [Candidate], Rules<'_>) {
        let rules = Rules {
            settings: &self.settings,
            exempt: &self.exempt,
            rest: &self.rest,
            error: self.error,
            level: self.level,
            sewn: &self.sewn,
            cones: &self.cones,
            cloth_vertices: self.cloth_vertices,
        };
        (&mut self.contacts, &mut self.candidates.list, rules)
    }

    /// The pairs that came near in the last part of a step.
    pub(crate) fn near_pairs(&self) -> impl Iterator<Item = ProximityPair> {
        self.contacts.near_pairs()
    }

    /// The number of exempt pairs of a tangle among those that the last step looked at.
    pub(crate) fn tolerated_pairs(&self) -> usize {
        let count = |tangle: &Tangle| self.candidates.list.iter().filter(|pair| tangle.has(pair)).count();
        self.exempt.tangle.as_ref().map_or(0, count)
    }

    /// Exempts a body's pairs until it is apart from the cloth.
    pub(crate) fn let_pass(&mut self, body: usize) {
        self.exempt.yielding[body] = true;
    }

    /// The pairs that certificates leave out.
    pub(crate) fn exempt(&self) -> &Exempt {
        &self.exempt
    }

    /// Sets the bodies whose pairs are exempt.
    pub(crate) fn set_yielding(&mut self, yielding: &[bool]) {
        self.exempt.yielding.copy_from_slice(yielding);
    }

    /// Sets the pairs that [`Exempt::parting`] returns, with all vertices at `positions`. Returns false, and changes nothing, if
    /// there are no such pairs.
    pub(crate) fn set_parting(&mut self, parting: Option<&[PairKey]>, positions: &[DVec3]) -> bool {
        let interest = self.candidates.interest();
        let Some(parting) = parting else {
            self.exempt.tangle = None;
            return true;
        };
        if !(parting.is_sorted() && parting.iter().all(|key| interest.has(key))) {
            return false;
        }
        let mut tangle = Tangle::new(interest, positions.len());
        let is_known = tangle.look(interest, parting.to_vec(), positions).is_ok();
        if is_known {
            self.exempt.tangle = Some(tangle);
        }
        is_known
    }

    /// Ends the exemption of pairs that are apart by their separation. A coarse mesh may pass through another one with all its
    /// vertices and edges far from those of the other. The exact test covers this case.
    pub(crate) fn take_back(&mut self, positions: &[DVec3]) {
        let Self {
            exempt,
            candidates,
            settings,
            error,
            ..
        } = self;
        let is_apart = |pair: &Candidate| {
            let separation = settings.of(pair).map_or(0.0, |t| t.separation);
            pair.distance_from_below(positions, *error) > separation
        };
        for (body, yielding) in exempt.yielding.iter_mut().enumerate() {
            if *yielding {
                let mut pairs = candidates.list.iter().filter(|pair| pair.data.body == body as Carrier);
                *yielding = !pairs.all(is_apart) || candidates.interest().passes_through(body as Carrier, positions);
            }
        }
        if let Some(tangle) = &mut exempt.tangle {
            tangle.take_back(candidates, positions, is_apart);
            exempt.tangle.take_if(|tangle| tangle.is_empty());
        }
    }
}

/// Returns the error of gaps of candidates between these positions. A NaN coordinate gives no bound.
pub(super) fn gap_error(candidates: &Candidates, motion: [&[DVec3]; 2]) -> GapError<f64> {
    let [first, second] = motion.map(|positions| candidates.largest_coordinate(positions));
    GapError::from_largest_coordinate(first.max(second))
}
