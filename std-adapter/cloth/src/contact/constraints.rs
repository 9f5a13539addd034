//! Contacts as constraints: pairs that are nearer to each other than their thickness are pushed apart.
//!
//! Each contact is a [row](super::rows) of the closest points at the start of the step. On a fine mesh neighbours at rest may be nearer than the
//! thickness. Then the thickness of such a pair is at most half its distance at rest, or the mesh would lock, and [less](super::neighbours). What was
//! tangled has no such distance at rest, and the two sides of a tear have none at all: they come apart to at least the thickness of neighbours.
//!
//! Contacts with a body are those with its [surface](super::cones).
//!
//! **Only where it matters.** Closest points are found when it is the turn of a pair to push, and not if the direction that it remembers
//! keeps it at its thickness by then: where cloth lies on something each vertex has many pairs, and a push or two see to all of them. On a
//! figure that walks in a shirt a third of the pairs that would come too near by themselves are left. A pair that remembers no direction is
//! not kept by any: where that is so of many, as after a checkpoint, closest points are found of [several at once](Known).

use super::candidate::{Aim, Candidate, ClosestOfSome};
use super::cones::Cones;
use super::crossing::PairKey;
use super::exempt::Exempt;
use super::neighbours::{are_neighbours, at_rest};
use super::rows::{Memory, ProximityPair, Row};
use super::settings::{ContactSettings, MARGIN, Thickness};
use crate::model::step::{TimeStep, Touches};
use crate::model::touches::LEAST_MISSING;
use selvedge::PairKind;
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
    /// Pairs of cloth with itself, and pairs with a body.
    of: [Class; 2],
    memory: Memory,
    /// Sweeps so far.
    sweeps: u32,
}

/// Contacts with bodies, or those of cloth.
#[derive(Debug, Default)]
struct Class {
    /// The candidates that may have to be pushed, by their places, in order.
    open: Vec<u32>,
    /// Of each of them what it is.
    found: Vec<Found>,
    rows: Vec<Row>,
    /// Candidates that begin with a push, and their rows.
    begun: Vec<(u32, u32)>,
    /// The candidates without those; kept for its memory.
    others: Vec<u32>,
    /// Whether all have had their turn once.
    is_found: bool,
}

impl Class {
    /// Gives the candidates that begin with a push their places among those that may have to be pushed.
    fn merge(&mut self) {
        let Self {
            open,
            found,
            begun,
            others,
            ..
        } = self;
        if begun.is_empty() {
            return;
        }
        begun.sort_unstable();
        std::mem::swap(open, others);
        open.clear();
        let mut own = begun.drain(..).peekable();
        for place in others.drain(..) {
            while let Some((before, row)) = own.next_if(|&(own, _)| own < place) {
                open.push(before);
                found.push(Found::Row(row));
            }
            let row = own.next_if(|&(own, _)| own == place);
            open.push(place);
            found.push(row.map_or(Found::Kept, |(_, row)| Found::Row(row)));
        }
        for (place, row) in own {
            open.push(place);
            found.push(Found::Row(row));
        }
    }
}

/// What came of a candidate's turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Found {
    /// The direction that it remembers keeps it apart so far.
    Kept,
    /// It is not near, or is no contact.
    Nothing,
    /// Its place among the rows.
    Row(u32),
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
    /// Of bodies.
    pub(super) cones: &'a Cones,
    /// Vertices from here on are bodies'.
    pub(super) cloth_vertices: u32,
}

/// What starts within this may come within `aim`.
fn reach(aim: f64) -> f64 {
    aim * (1.0 + MARGIN)
}

impl Contacts {
    pub(super) fn clear(&mut self) {
        self.open.clear();
        for class in &mut self.of {
            class.open.clear();
            class.found.clear();
            class.rows.clear();
            class.is_found = false;
        }
        self.sweeps = 0;
    }

    /// Forgets what pushed in the last step as well.
    pub(super) fn forget(&mut self) {
        self.clear();
        self.memory.clear();
    }

    /// Remembers what has pushed, as the step was made.
    pub(super) fn remember(&mut self, touches: &Touches, h: f64) {
        self.memory.remember(self.of.iter().flat_map(|class| &class.rows), touches, h);
    }

    /// What pushed in the last step, and what it begins a step of `h` seconds with.
    pub(super) fn remembered(&self, h: f64) -> impl Iterator<Item = (PairKey, f64)> {
        self.memory.begin(h)
    }

    /// Lets the candidates at these places begin with a push over their mobility. Their turns stay in the order of all candidates, since the
    /// result depends on it a little.
    pub(super) fn begin(
        &mut self,
        places: &[(usize, f64)],
        pairs: &mut [Candidate],
        rules: Rules<'_>,
        (step, positions): (&TimeStep<'_>, &mut [DVec3]),
    ) {
        for &(place, push) in places {
            let pair = &mut pairs[place];
            if rules.exempt.is_tangled(pair) {
                continue;
            }
            if let Some((near, distance)) = near(pair, None, rules, step) {
                let class = &mut self.of[usize::from(pair.data.is_with_body())];
                let mut row = Row::new(pair.key(), near, distance, step);
                row.begin_with(push, step, positions);
                class.begun.push((place as u32, class.rows.len() as u32));
                class.rows.push(row);
            }
        }
        self.of.iter_mut().for_each(Class::merge);
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
            let with_body = pairs[place as usize].data.is_with_body();
            self.of[usize::from(with_body)].open.push(place);
        }
    }

    /// Finds the contacts that are too near at the start of the step, and records what they miss, before anything pushes.
    pub(super) fn find_missing(
        &mut self,
        pairs: &mut [Candidate],
        rules: Rules<'_>,
        (step, positions): (&TimeStep<'_>, &[DVec3]),
        touches: &mut Touches,
    ) {
        let closing = farthest_way(step, positions);
        for class in self.of.iter_mut().rev() {
            class.found.resize(class.open.len(), Found::Kept);
            for (&place, turn) in class.open.iter().zip(&mut class.found) {
                let pair = &mut pairs[place as usize];
                let closing = if pair.data.is_with_body() { closing } else { 0.0 };
                if *turn == Found::Kept && may_miss(pair, closing) && !is_kept(pair, positions) {
                    *turn = match near(pair, None, rules, step) {
                        Some((near, distance)) => {
                            class.rows.push(Row::new(pair.key(), near, distance, step));
                            Found::Row(class.rows.len() as u32 - 1)
                        }
                        None => Found::Nothing,
                    };
                }
                if let Found::Row(row) = *turn {
                    class.rows[row as usize].record_missing(step, positions, touches);
                }
            }
        }
    }

    /// Pushes once along the contacts with bodies, or along those of cloth; returns how many push that did not before.
    pub(super) fn push(
        &mut self,
        with_body: bool,
        pairs: &mut [Candidate],
        rules: Rules<'_>,
        (step, positions): (&TimeStep<'_>, &mut [DVec3]),
    ) -> u64 {
        let Class {
            open,
            found: turns,
            rows,
            is_found,
            ..
        } = &mut self.of[usize::from(with_body)];
        let is_first = !std::mem::replace(is_found, true);
        turns.resize(open.len(), Found::Kept);
        let mut pushed = 0;
        let mut known = Known::default();
        for (places, turns) in open.chunks(LANES).zip(turns.chunks_mut(LANES)) {
            let are_known = is_first && known.find(places, pairs, rules, step.start);
            for (lane, (&place, turn)) in places.iter().zip(turns).enumerate() {
                if *turn == Found::Kept {
                    let pair = &mut pairs[place as usize];
                    let found = are_known.then_some((&known, lane));
                    // What remembers nothing is not kept.
                    if found.is_none() && is_kept(pair, positions) {
                        continue;
                    }
                    *turn = match near(pair, found, rules, step) {
                        Some((near, distance)) => {
                            rows.push(Row::new(pair.key(), near, distance, step));
                            Found::Row(rows.len() as u32 - 1)
                        }
                        None => Found::Nothing,
                    };
                }
                if let Found::Row(row) = *turn {
                    pushed += u64::from(rows[row as usize].settle(step, positions));
                }
            }
        }
        pushed
    }

    /// Lets the contacts that were found push or take back, once each, in one order and then in the other.
    pub(super) fn sweep(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3]) {
        let is_reversed = self.sweeps.is_multiple_of(2);
        for with_body in [!is_reversed, is_reversed] {
            let Class { found, rows, .. } = &mut self.of[usize::from(with_body)];
            let mut settle = |turn: &Found| {
                if let Found::Row(row) = *turn {
                    rows[row as usize].settle(step, positions);
                }
            };
            if is_reversed {
                found.iter().rev().for_each(&mut settle);
            } else {
                found.iter().for_each(&mut settle);
            }
        }
        self.sweeps += 1;
    }

    /// Lets all contacts follow the shift.
    pub(super) fn follow_shift(&mut self, step: &TimeStep<'_>, positions: &[DVec3], touches: &Touches) {
        let rows = self.of.iter_mut().flat_map(|class| &mut class.rows);
        rows.for_each(|row| row.follow_shift(step, positions, touches));
    }

    /// Records what pushes now, for friction.
    pub(super) fn record(&mut self, touches: &mut Touches) {
        let rows = self.of.iter_mut().rev().flat_map(|class| &mut class.rows);
        rows.for_each(|row| row.record(touches));
    }

    /// The pairs that were near, and not kept apart yet, when it was their turn: those with bodies first.
    pub(super) fn near_pairs(&self) -> impl Iterator<Item = ProximityPair> {
        self.of.iter().rev().flat_map(|class| &class.rows).map(|row| row.near)
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

/// Whether a pair may be nearer than its thickness at the start of the step, as far as it remembers, or is when bodies have come nearer by `closing`.
#[inline(always)]
fn may_miss(pair: &Candidate, closing: f64) -> bool {
    f64::from(pair.gap()) < (1.0 - LEAST_MISSING) * pair.data.aim.length() + closing
}

/// How far the fastest kinematic vertex goes in the step.
fn farthest_way(step: &TimeStep<'_>, positions: &[DVec3]) -> f64 {
    let ways = step.start.iter().zip(positions).zip(step.inverse_masses);
    let kinematic = ways.filter(|(_, inverse_mass)| **inverse_mass == 0.0);
    let squared = kinematic.map(|((start, end), _)| start.distance_squared(*end));
    squared.fold(0.0, f64::max).sqrt()
}

/// Whether the direction that a pair remembers keeps it at its thickness, but for what is not worth a push.
#[inline(always)]
fn is_kept(pair: &Candidate, positions: &[DVec3]) -> bool {
    pair.is_kept_at((1.0 - LEAST_MISSING) * pair.data.aim.length(), positions)
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

/// The pair as it is at the start of the step, and its distance, if it is a contact there. `known` may say where it is closest, at a place in it.
fn near(
    pair: &mut Candidate,
    known: Option<(&Known, usize)>,
    rules: Rules<'_>,
    step: &TimeStep<'_>,
) -> Option<(ProximityPair, f64)> {
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
    if pair.data.is_with_body() && !is_of_surface(pair, closest, rules, step.start) {
        return None;
    }
    let near = ProximityPair {
        vertices: pair.vertices,
        weights: closest.weights,
        normal: closest.direction,
        thickness: pair.data.aim.length(),
    };
    Some((near, distance))
}

/// Whether the point of the body is the closest of its [surface](super::cones), and not only of one of its faces or edges.
fn is_of_surface(pair: &Candidate, closest: &ClosestPoints, rules: Rules<'_>, positions: &[DVec3]) -> bool {
    let of_first = match pair.kind {
        PairKind::VertexFace => 1,
        PairKind::EdgeEdge => 2,
    };
    let (first, second) = pair.vertices.split_at(of_first);
    let (of_first, of_second) = closest.weights.split_at(of_first);
    if second[0] >= rules.cloth_vertices {
        rules.cones.contain(second, of_second, positions, closest.direction)
    } else {
        rules.cones.contain(first, of_first, positions, -closest.direction)
    }
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
