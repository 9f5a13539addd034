//! Contacts as constraints: pairs that are nearer to each other than their thickness are pushed apart.
//!
//! A constraint is C = n·Σwᵢxᵢ − h ≥ 0 with the direction n and the weights w of the closest points at the start of the step. A pair that
//! starts nearer than that comes apart at [`RECOVERY`] at most, whatever the length of the step: a push must not become a
//! velocity. On a fine mesh neighbours at rest may be nearer than the thickness; such a pair's is at most half its distance at rest,
//! or the mesh would lock, and [less](super::neighbours). What was tangled has no such distance at rest, and the two sides of a tear have none
//! at all: they come apart to at least the thickness of neighbours.
//!
//! **Only where it matters.** ClosestPoints points are found when it is the turn of a pair to push, and not if the direction that it remembers
//! keeps it at its thickness by then: where cloth lies on something each vertex has many pairs, and a push or two see to all of them. On a
//! figure that walks in a shirt a third of the pairs that would come too near by themselves are left. A pair that remembers no direction is
//! not kept by any: where that is so of many, as after a checkpoint, closest points are found of [several at once](Known).

use super::candidate::{Aim, Candidate, ClosestOfSome};
use super::exempt::Exempt;
use super::neighbours::{are_neighbours, at_rest};
use super::settings::{ContactSettings, MARGIN, RECOVERY, Thickness};
use crate::model::step::{TimeStep, Touch, Touches, mobility};
use selvedge::parallel;
use selvedge::parallel::append_selected;
use selvedge::simd::Level;
use selvedge_core::batch::LANES;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::closest::ClosestPoints;
use selvedge_core::separation::gap::{GapError, distance_from_below};
use selvedge_core::separation::largest_coordinate;
use std::hint::select_unpredictable;

/// The contacts of a step.
#[derive(Debug, Default)]
pub(super) struct Contacts {
    /// The candidates that may have to be pushed, by their places, in order, as they are found.
    open: Vec<u32>,
    /// The same as they are pushed: pairs of cloth with itself, and pairs with a body.
    open_of: [Vec<u32>; 2],
    /// Those of them that were near, and not kept apart yet, when it was their turn.
    near: Vec<ProximityPair>,
}

/// A pair that is near at the start of a step, and was not seen to be kept at its thickness by what pushed before it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProximityPair {
    /// Vertex and face, or first edge and second edge; the cloth's vertices, then those of bodies.
    pub vertices: [u32; 4],
    /// Of each vertex in the way between the closest points: positive on the first side, where they add up to one, negative on the other.
    pub weights: [f64; 4],
    /// From the second side to the first, of length one.
    pub normal: DVec3,
    /// How far apart the pair is to be, in metres.
    pub thickness: f64,
}

/// What is asked of pairs.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules<'a> {
    pub(super) settings: &'a ContactSettings,
    /// Those that are not pushed: what is tangled.
    pub(super) exempt: &'a Exempt,
    /// Of each vertex, for the thickness that neighbours can have.
    pub(super) rest: &'a [DVec3],
    /// Of gaps between positions of this step.
    pub(super) error: GapError<f64>,
    /// The instructions by which closest points are found.
    pub(super) level: Level,
}

/// What starts within this may come within `aim`.
fn reach(aim: f64) -> f64 {
    aim * (1.0 + MARGIN)
}

impl Contacts {
    pub(super) fn clear(&mut self) {
        self.open.clear();
        self.open_of.iter_mut().for_each(Vec::clear);
        self.near.clear();
    }

    /// Replaces them by those of the pairs that are near at the start of the step, and that the direction which kept them apart there does
    /// not keep at their thickness at its predicted end.
    pub(super) fn collect(&mut self, pairs: &mut [Candidate], rules: Rules<'_>, predicted: &[DVec3]) {
        self.clear();
        parallel::map_chunks(
            pairs,
            |first, pairs, open: &mut Vec<u32>| {
                append_selected(open, pairs, |place, pair| (is_open(pair, predicted), (first + place) as u32));
            },
            &mut self.open,
            |all, own| all.extend(own),
        );
        if rules.exempt.has_tangle() {
            self.open.retain(|&place| !rules.exempt.is_tangled(&pairs[place as usize]));
        }
        for &place in &self.open {
            self.open_of[usize::from(pairs[place as usize].data.is_with_body())].push(place);
        }
    }

    /// Pushes once along the contacts with bodies, or along those of cloth; returns how many pushed.
    pub(super) fn push(
        &mut self,
        with_body: bool,
        pairs: &mut [Candidate],
        rules: Rules<'_>,
        (step, positions): (&TimeStep<'_>, &mut [DVec3]),
        touches: &mut Touches,
    ) -> u64 {
        let mut pushed = 0;
        let mut known = Known::default();
        for places in self.open_of[usize::from(with_body)].chunks(LANES) {
            let are_known = known.find(places, pairs, rules, step.start);
            for (lane, &place) in places.iter().enumerate() {
                let pair = &mut pairs[place as usize];
                let found = are_known.then_some((&known, lane));
                // What remembers nothing is not kept.
                if found.is_none() && is_kept(pair, positions) {
                    continue;
                }
                if let Some(near) = near(pair, found, rules, step) {
                    pushed += u64::from(project(&near, step, positions, touches));
                    self.near.push(near);
                }
            }
        }
        pushed
    }

    /// Those that were near, and not kept apart yet, when it was their turn.
    pub(super) fn near_pairs(&self) -> impl Iterator<Item = ProximityPair> {
        self.near.iter().copied()
    }
}

/// Whether a pair may have to be pushed. Without a branch, which nobody could foretell.
#[inline(always)]
fn is_open(pair: &Candidate, predicted: &[DVec3]) -> bool {
    let aim = pair.data.aim.length();
    let is_near = f64::from(pair.gap()) <= reach(aim);
    // What is not near is kept at that.
    let distance = select_unpredictable(is_near, aim, f64::NEG_INFINITY);
    !pair.is_kept_at(distance, predicted)
}

/// Whether the direction that a pair remembers keeps it at its thickness.
#[inline(always)]
fn is_kept(pair: &Candidate, positions: &[DVec3]) -> bool {
    pair.is_kept_at(pair.data.aim.length(), positions)
}

/// Where up to sixteen pairs are closest, if that is found at once.
#[derive(Default)]
struct Known {
    at_start: ClosestOfSome,
    /// Not of pairs with a body.
    at_rest: ClosestOfSome,
}

impl Known {
    /// Finds it if all are of one kind and remember no direction, so that their closest points are needed whatever is pushed before them; few of
    /// others' are. Returns whether it did.
    fn find(&mut self, places: &[u32], pairs: &[Candidate], rules: Rules<'_>, start: &[DVec3]) -> bool {
        let asked = || places.iter().map(|&place| &pairs[place as usize]);
        let Some(Candidate { kind, data, .. }) = asked().next() else {
            return false;
        };
        if !asked().all(|pair| pair.kind == *kind && pair.remembers_nothing()) {
            return false;
        }
        self.at_start.find(rules.level, asked(), start);
        if !data.is_with_body() {
            self.at_rest.find(rules.level, asked(), rules.rest);
        }
        true
    }
}

/// The pair as it is at the start of the step, if it is near there. `known` may say where it is closest, at a place in it.
fn near(pair: &mut Candidate, known: Option<(&Known, usize)>, rules: Rules<'_>, step: &TimeStep<'_>) -> Option<ProximityPair> {
    let closest = match known {
        Some((known, place)) => &known.at_start.found()[place],
        None => &pair.closest(step.start),
    };
    pair.refresh(closest.direction, step.start, rules.error);
    let distance = closest.distance();
    if distance > reach(pair.data.aim.length()) || closest.direction == DVec3::ZERO {
        return None;
    }
    if !pair.data.aim.is_own() {
        let at_rest = || known.map_or_else(|| pair.closest(rules.rest), |(known, place)| known.at_rest.found()[place]);
        pair.data.aim = Aim::own(thickness_of(pair, at_rest, rules)?);
    }
    Some(ProximityPair {
        vertices: pair.vertices,
        weights: closest.weights,
        normal: closest.direction,
        thickness: pair.data.aim.length().min(distance + RECOVERY * step.h),
    })
}

/// The thickness that a pair can have: the one that is asked for, but for neighbours in one cloth.
fn thickness_of(pair: &Candidate, closest_at_rest: impl FnOnce() -> ClosestPoints, rules: Rules<'_>) -> Option<f64> {
    let Rules {
        settings, exempt, rest, ..
    } = rules;
    let asked = settings.of(pair)?;
    let Thickness { thickness, .. } = asked;
    let [one, .., other] = pair.vertices;
    if pair.data.is_with_body() || !settings.are_of_one_cloth(one, other) {
        return Some(thickness);
    }
    let are_near = || are_neighbours(pair.kind, pair.points(rest), at_rest(asked));
    let own = if settings.has_neighbours && are_near() {
        asked.of_neighbours()
    } else {
        thickness
    };
    let closest = closest_at_rest();
    let own = own.min(0.5 * closest.distance());
    let has_torn = || {
        let points = pair.points(rest);
        let error = GapError::from_largest_coordinate(largest_coordinate(&points));
        distance_from_below(pair.kind, points, closest.direction, error) == 0.0
    };
    Some(if exempt.is_parting(pair) || has_torn() {
        own.max(asked.of_neighbours())
    } else {
        own
    })
}

/// Pushes a pair apart, if it is too near; whether it was.
fn project(pair: &ProximityPair, step: &TimeStep<'_>, positions: &mut [DVec3], touches: &mut Touches) -> bool {
    let vertices = pair.vertices.map(|v| v as usize);
    let mut distance = -pair.thickness;
    for (vertex, weight) in vertices.into_iter().zip(pair.weights) {
        distance += weight * pair.normal.dot(positions[vertex]);
    }
    let mobility = mobility(step.inverse_masses, pair.vertices, pair.weights);
    if distance >= 0.0 || !(mobility > 0.0) {
        return false;
    }
    let push = -distance;
    let along = pair.normal * (push / mobility);
    for (vertex, weight) in vertices.into_iter().zip(pair.weights) {
        positions[vertex] += along * (step.inverse_masses[vertex] * weight);
    }
    touches.record(|| Touch {
        vertices: pair.vertices,
        weights: pair.weights,
        normal: pair.normal,
        push,
        drift: DVec3::ZERO,
    });
    true
}
