//! Contacts as constraints: pairs that are nearer to each other than their thickness are pushed apart.
//!
//! Each contact is a [row](super::rows) of the closest points at the start of the step. On a fine mesh neighbours at rest may be
//! nearer than the thickness. Then the thickness of such a pair is at most half its distance at rest, or the mesh would lock, and
//! [less](super::neighbours). A tangled pair has no such distance at rest, and the distance of the two sides of a tear is zero.
//! They come apart to at least the thickness of neighbours.
//!
//! Contacts with a body are those with its [surface](super::cones).
//!
//! **Only necessary work.** The step computes the closest points of a pair when its turn to push comes. It does not if the
//! direction that the pair stores keeps it at its thickness by then. Where cloth lies on something, each vertex has many pairs,
//! and a push or two correct all of them. On a figure that walks in a shirt a third of the pairs that would come too near by
//! themselves are left. A pair without a stored direction always needs its closest points. If many have none, as after a
//! checkpoint, the step finds [several at once](Known).

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
    /// The places of the candidates that may need a push, in order.
    open: Vec<u32>,
    /// The pairs of cloth with itself, and the pairs with a body.
    of: [Class; 2],
    memory: Memory,
    /// The number of sweeps so far.
    sweeps: u32,
}

/// The contacts with bodies, or those of cloth.
#[derive(Debug, Default)]
struct Class {
    /// The places of the candidates that may need a push, in order.
    open: Vec<u32>,
    /// The state of each of them.
    found: Vec<Found>,
    rows: Vec<Row>,
    /// The places of the rows, in the order of the candidates.
    order: Vec<u32>,
    /// The candidates that begin with a push, and their rows.
    begun: Vec<(u32, u32)>,
    /// The other candidates; the field exists to use its memory again.
    others: Vec<u32>,
    /// True if each has had its first turn.
    is_found: bool,
}

impl Class {
    /// Finds the order of the rows, unless it is known.
    fn put_rows_in_order(&mut self) {
        if self.order.len() == self.rows.len() {
            return;
        }
        self.order.clear();
        let row = |turn: &Found| if let Found::Row(row) = *turn { Some(row) } else { None };
        self.order.extend(self.found.iter().filter_map(row));
    }

    /// Gives the candidates that begin with a push their places among those that may need one.
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

/// The result of a candidate's turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Found {
    /// The stored direction has kept the pair apart so far.
    Kept,
    /// The pair is not near, or is no contact.
    Nothing,
    /// The pair has a row, at this place.
    Row(u32),
}

/// The rules by which pairs become contacts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rules<'a> {
    pub(super) settings: &'a ContactSettings,
    /// The tangled pairs, which are not pushed.
    pub(super) exempt: &'a Exempt,
    /// The position of each vertex at rest, which limits the thickness of neighbours.
    pub(super) rest: &'a [DVec3],
    /// The error of gaps between positions of this step.
    pub(super) error: GapError<f64>,
    /// The processor instructions that find closest points.
    pub(super) level: Level,
    /// True for vertices that seams hold, in scenes with one solve a step.
    pub(super) sewn: &'a [bool],
    /// The normal cones of surfaces.
    pub(super) cones: &'a Cones,
    /// The number of the cloth's vertices; bodies' vertices come after them.
    pub(super) cloth_vertices: u32,
}

impl Rules<'_> {
    /// Returns whether both sides of a pair have a vertex that a seam holds.
    fn are_sewn(&self, pair: &Candidate) -> bool {
        let of_first = match pair.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        };
        let (first, second) = pair.vertices.split_at(of_first);
        [first, second].into_iter().all(|side| side.iter().any(|&vertex| self.sewn[vertex as usize]))
    }
}

/// The distance, in thicknesses, beyond which a pair needs no row at the first guess. A solve moves vertices away from there.
const ROOM: f64 = 1.25;

/// The distance within which a pair must start if it may come within `aim`.
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
            class.order.clear();
            class.is_found = false;
        }
        self.sweeps = 0;
    }

    /// Forgets also what pushed in the last step.
    pub(super) fn forget(&mut self) {
        self.clear();
        self.memory.clear();
    }

    /// Stores what has pushed, after a step that was accepted.
    pub(super) fn remember(&mut self, held_together: &[bool], touches: &Touches, h: f64) {
        let rows = self.of.iter().flat_map(|class| &class.rows);
        self.memory.remember(rows, held_together, touches, h);
    }

    /// The pairs that pushed in the last step, and the push with which each begins a step of `h` seconds.
    pub(super) fn remembered(&self, h: f64) -> impl Iterator<Item = (PairKey, f64)> {
        self.memory.begin(h)
    }

    /// Lets the candidates at these places begin with a push, given over their mobility. They keep their turns in the order of
    /// all candidates, since the result depends on that order a little.
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

    /// Replaces the contacts by the pairs that are near at the start of the step. It leaves out a pair if the direction that kept
    /// it apart there also suffices at the predicted end of the step.
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

    /// Visits the pairs that may be nearer than their thickness at the end of a step: those that the direction which they store does
    /// not keep apart at the first guess, with room to spare, and where everything but contact leads.
    pub(super) fn visit_near(
        pairs: &mut [Candidate],
        rules: Rules<'_>,
        step: &TimeStep<'_>,
        [guess, goal]: [&[DVec3]; 2],
        visit: &mut dyn FnMut(&Candidate, ProximityPair, f64),
    ) {
        for pair in pairs {
            let aim = pair.data.aim.length();
            let wide = ROOM * aim;
            let gap = f64::from(pair.gap());
            // No pair beyond the reach of the search is near; most candidates are kept apart by far.
            if pair.is_kept_at(wide, guess) && pair.is_kept_at(aim, goal) || rules.exempt.is_tangled(pair) {
                continue;
            }
            let moves = pair.vertices.map(|vertex| guess[vertex as usize] - step.start[vertex as usize]);
            let closing = moves.iter().map(|own| own.distance_squared(moves[0])).fold(0.0, f64::max).sqrt();
            if gap > wide.max(aim + closing) + 0.25 * closing {
                continue;
            }
            if let Some((near, distance)) = near_within(pair, None, rules, step, aim + closing) {
                visit(pair, near, distance);
            }
        }
    }

    /// Finds the contacts that are too near at the start of the step, and records how much each is too near, before anything
    /// pushes. No body near the cloth moves by more than `closing`.
    pub(super) fn find_missing(
        &mut self,
        pairs: &mut [Candidate],
        rules: Rules<'_>,
        (step, positions): (&TimeStep<'_>, &[DVec3]),
        closing: f64,
        touches: &mut Touches,
    ) {
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

    /// Pushes once along the contacts with bodies, or along those of cloth; returns how many push for the first time.
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
                    // A pair without a stored direction is not kept apart.
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
                    let row = &mut rows[row as usize];
                    let had_pushed = row.has_pushed();
                    row.settle(step, positions);
                    pushed += u64::from(!had_pushed && row.has_pushed());
                }
            }
        }
        pushed
    }

    /// Lets each contact push or take back once, in one order and then in the other. Returns the largest change.
    pub(super) fn sweep(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3]) -> f64 {
        let is_reversed = self.sweeps.is_multiple_of(2);
        let mut largest = 0.0_f64;
        for with_body in [!is_reversed, is_reversed] {
            let class = &mut self.of[usize::from(with_body)];
            class.put_rows_in_order();
            let Class { order, rows, .. } = class;
            let settle = |&row: &u32| {
                let change = rows[row as usize].settle(step, positions);
                if change > largest {
                    largest = change;
                }
            };
            if is_reversed {
                order.iter().rev().for_each(settle);
            } else {
                order.iter().for_each(settle);
            }
        }
        self.sweeps += 1;
        largest
    }

    /// Moves the rest distances of all contacts with the shift.
    pub(super) fn follow_shift(&mut self, step: &TimeStep<'_>, positions: &[DVec3], touches: &Touches) {
        let rows = self.of.iter_mut().flat_map(|class| &mut class.rows);
        rows.for_each(|row| row.follow_shift(step, positions, touches));
    }

    /// Records what pushes now; friction reads this.
    pub(super) fn record(&mut self, touches: &mut Touches) {
        let rows = self.of.iter_mut().rev().flat_map(|class| &mut class.rows);
        rows.for_each(|row| row.record(touches));
    }

    /// The pairs that were near, and not yet kept apart, at their turn: those with bodies first.
    pub(super) fn near_pairs(&self) -> impl Iterator<Item = ProximityPair> {
        self.of.iter().rev().flat_map(|class| &class.rows).map(|row| row.near)
    }
}

/// Returns whether a pair may need a push. It uses no branch, since no branch here could be predicted.
#[inline(always)]
fn is_open(pair: &Candidate, predicted: &[DVec3]) -> bool {
    let aim = pair.data.aim.length();
    let is_near = f64::from(pair.gap()) <= reach(aim);
    // A pair that is not near counts as kept.
    let distance = select_unpredictable(is_near, aim, f64::NEG_INFINITY);
    !pair.is_kept_at(distance, predicted)
}

/// Returns whether a pair may be nearer than its thickness, judged by its stored direction. This is at the start of the step, or
/// after bodies have come nearer by `closing`.
#[inline(always)]
fn may_miss(pair: &Candidate, closing: f64) -> bool {
    f64::from(pair.gap()) < (1.0 - LEAST_MISSING) * pair.data.aim.length() + closing
}

/// Returns whether the direction that a pair stores keeps it at its thickness, up to a difference that is not worth a push.
#[inline(always)]
fn is_kept(pair: &Candidate, positions: &[DVec3]) -> bool {
    pair.is_kept_at((1.0 - LEAST_MISSING) * pair.data.aim.length(), positions)
}

/// The closest points of up to sixteen pairs, if the step finds them all at once.
#[derive(Default)]
struct Known {
    at_start: ClosestOfSome,
    /// The closest points at rest; empty for pairs with a body.
    at_rest: ClosestOfSome,
}

impl Known {
    /// Finds the closest points if all pairs are of one kind and store no direction. Then all of them are needed, whatever is
    /// pushed first, and otherwise few. Returns whether it did.
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

/// The pair at the start of the step, and its distance, if it is a contact there. `known` may hold its closest points, at a
/// place.
fn near(
    pair: &mut Candidate,
    known: Option<(&Known, usize)>,
    rules: Rules<'_>,
    step: &TimeStep<'_>,
) -> Option<(ProximityPair, f64)> {
    near_within(pair, known, rules, step, 0.0)
}

/// As [`near`], for pairs within a distance, or within reach.
fn near_within(
    pair: &mut Candidate,
    known: Option<(&Known, usize)>,
    rules: Rules<'_>,
    step: &TimeStep<'_>,
    within: f64,
) -> Option<(ProximityPair, f64)> {
    let closest = match known {
        Some((known, place)) => &known.at_start.found()[place],
        None => &pair.closest(step.start),
    };
    pair.refresh(closest.direction, step.start, rules.error);
    let distance = closest.distance();
    if distance > reach(pair.data.aim.length()).max(within) || closest.direction == DVec3::ZERO {
        return None;
    }
    if !pair.data.aim.is_own() {
        let at_rest = || known.map_or_else(|| pair.closest(rules.rest), |(known, place)| known.at_rest.found()[place]);
        pair.data.aim = Aim::own(thickness_of(pair, at_rest, rules)?);
    }
    if !is_of_surface(pair, closest, rules, step.start) {
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

/// Returns whether a contact is one of [surfaces](super::cones), and not only of faces and edges of theirs: the point of a body is the
/// closest point of its surface. Between cloth and cloth this rule holds for the face that a vertex meets. Edges push where they cross.
/// Where an end of an edge is closest, its vertex and the other edge's face push.
fn is_of_surface(pair: &Candidate, closest: &ClosestPoints, rules: Rules<'_>, positions: &[DVec3]) -> bool {
    let Rules { cones, .. } = rules;
    let of_first = match pair.kind {
        PairKind::VertexFace => 1,
        PairKind::EdgeEdge => 2,
    };
    let (first, second) = pair.vertices.split_at(of_first);
    let (of_first, of_second) = closest.weights.split_at(of_first);
    if pair.kind == PairKind::EdgeEdge && !pair.data.is_with_body() {
        return [(first, of_first), (second, of_second)]
            .into_iter()
            .all(|(edge, weights)| Cones::are_all(weights) || !cones.is_beside_a_face(edge));
    }
    if pair.data.is_with_body() && second[0] < rules.cloth_vertices {
        cones.contain(first, of_first, positions, -closest.direction)
    } else {
        cones.contain(second, of_second, positions, closest.direction)
    }
}

/// The thickness that a pair can have: the requested one, except for neighbours in one cloth.
fn thickness_of(pair: &Candidate, closest_at_rest: impl FnOnce() -> ClosestPoints, rules: Rules<'_>) -> Option<f64> {
    let Rules {
        settings, exempt, rest, ..
    } = rules;
    let asked = settings.of(pair)?;
    let Thickness { thickness, .. } = asked;
    let [one, .., other] = pair.vertices;
    if pair.data.is_with_body() {
        return Some(thickness);
    }
    if rules.are_sewn(pair) {
        return Some(asked.of_neighbours());
    }
    if !settings.are_of_one_cloth(one, other) {
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
