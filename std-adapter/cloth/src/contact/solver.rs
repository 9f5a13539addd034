//! Contact in the form that the simulation calls: pairs that are near, for the solve, and then the [certified pass](super::pass).

use super::candidate::{Candidate, time_of_impact_of};
use super::candidates::{Candidates, candidates};
use super::cones::NormalCones;
use super::crossing::{Crossing, PairKey};
use super::exempt::{Exempt, Tangle};
use super::impact_zones::ImpactZones;
use super::near::{ContactRules, GoesOn, ProximityPair, visit_near};
use super::relaxation::Relaxation;
use super::report::{ContactCounts, ContactSeconds};
use super::settings::ContactSettings;
use crate::model::step::{Carrier, FREE, TimeStep};
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
    /// The normal cones of surfaces.
    cones: NormalCones,
    cloth_vertices: u32,
    /// The vertices that seams hold together, in both orders.
    joints: Vec<[u32; 2]>,
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
    /// `rest` and `carriers` are of all vertices, the cloth's first; `are_free` says which bodies the solve moves. `topology` is
    /// of all triangles, and the cloth's loose edges. Steps mostly take `time_step` seconds.
    pub(crate) fn new(
        mut settings: ContactSettings,
        topology: Topology,
        rest: &[DVec3],
        carriers: &[Carrier],
        (cloth_vertices, are_free): (usize, &[bool]),
        time_step: f64,
    ) -> Self {
        Self {
            cones: NormalCones::new(&topology),
            cloth_vertices: cloth_vertices as u32,
            joints: Vec::new(),
            candidates: candidates(&mut settings, topology, rest, carriers, (cloth_vertices, are_free), time_step),
            settings,
            carriers: carriers.to_vec(),
            rest: rest.to_vec(),
            error: GapError::from_largest_coordinate(0.0),
            level: best_level(),
            moved: vec![false; rest.len()],
            places: Vec::new(),
            relaxation: Relaxation::default(),
            zones: ImpactZones::default(),
            exempt: Exempt::new(are_free.len()),
            pushes: true,
            counts: ContactCounts::default(),
            stages: ContactSeconds::default(),
        }
    }

    /// The largest separation that pairs with bodies keep, in metres; `None` if no effect keeps them apart.
    pub(crate) fn separation_from_bodies(&self) -> Option<f64> {
        self.settings.largest(true).map(|own| own.separation)
    }

    /// Returns whether one of these vertices is near a body or pin for which `is_held` holds.
    pub(crate) fn meets(&self, vertices: &[bool], is_held: impl Fn(Carrier) -> bool) -> bool {
        let has = |pair: &Candidate| pair.vertices.iter().any(|&vertex| vertices[vertex as usize]);
        let meets = |pair: &Candidate| {
            let carriers = pair.vertices.iter().map(|&vertex| self.carriers[vertex as usize]);
            { carriers }.any(|carrier| carrier != FREE && is_held(carrier))
        };
        self.candidates.list.iter().any(|pair| has(pair) && meets(pair))
    }

    /// Names vertices that seams hold together.
    pub(crate) fn sew(&mut self, joints: impl Iterator<Item = [u32; 2]>) {
        self.joints
            .extend(joints.flat_map(|[one, other]| [[one, other], [other, one]]));
        self.joints.sort_unstable();
    }

    /// Discards the data of the steps before; the next step is expected to lead from `start` to `end` in `h` seconds.
    pub(crate) fn refresh(&mut self, start: &[DVec3], end: &[DVec3], h: f64) {
        let begin = Clock::now();
        self.candidates.refresh(start, end, h);
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

    /// Finds the candidates of a step, and visits those that may be nearer than their thickness at its end, each with its
    /// distance at the start: `guess` has the positions at which the solve begins, and `goal` those to which everything but
    /// contact leads. `goes_on` tests pairs that have left the surface of a body.
    pub(crate) fn visit_near(
        &mut self,
        step: &TimeStep<'_>,
        [guess, goal]: [&[DVec3]; 2],
        goes_on: GoesOn<'_>,
        visit: &mut dyn FnMut(PairKey, bool, ProximityPair, f64),
    ) {
        let begin = Clock::now();
        // What comes fast is near only at the end of the step.
        self.candidates.cover(step.start, guess, step.h);
        self.stages.candidates += begin.elapsed().as_secs_f64();
        let begin = Clock::now();
        self.error = gap_error(&self.candidates, [step.start, guess]).larger(gap_error(&self.candidates, [goal, goal]));
        if self.pushes {
            let (pairs, rules) = self.parts();
            visit_near(pairs, rules, step, [guess, goal], goes_on, &mut |pair, near, distance| {
                visit(pair.key(), pair.data.is_with_body(), near, distance);
            });
        }
        self.stages.constraints += begin.elapsed().as_secs_f64();
    }

    /// The candidates, and the rules by which they become contacts.
    fn parts(&mut self) -> (&mut [Candidate], ContactRules<'_>) {
        let rules = ContactRules {
            settings: &self.settings,
            exempt: &self.exempt,
            rest: &self.rest,
            error: self.error,
            joints: &self.joints,
            cones: &self.cones,
            cloth_vertices: self.cloth_vertices,
        };
        (&mut self.candidates.list, rules)
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
