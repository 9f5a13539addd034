//! Pairs that are near: the contacts of a step, which become [rows](crate::solve) of its solve.
//!
//! Each contact has the direction and the weights of the closest points at the start of the step, or, for what comes from afar,
//! where it first comes near on the way to the first guess. (The plane of a far pair would hold what passes by.) On a fine mesh
//! neighbours at rest may be nearer than the thickness. Then the thickness of such a pair is at most half its distance at rest,
//! or the mesh would lock, and [less](super::neighbours). A tangled pair has no such distance at rest, and the distance of
//! the two sides of a tear is zero. They come apart to at least the thickness of neighbours.
//!
//! Contacts with a body are those with its [surface](super::cones), and those at rest, which may [leave](GoesOn) it by little.
//!
//! **Only necessary work.** The step computes the closest points of a pair only if the direction that the pair stores does not
//! keep it at its thickness.

use super::PairKey;
use super::candidate::{Aim, Candidate};
use super::cones::NormalCones;
use super::exempt::Exempt;
use super::neighbours::{are_neighbours, at_rest};
use super::settings::{ContactSettings, MARGIN, Thickness};
use crate::model::length::larger;
use crate::model::step::TimeStep;
use selvedge::PairKind;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::closest::ClosestPoints;
use selvedge_core::separation::gap::{GapError, distance_from_below};
use selvedge_core::separation::largest_coordinate;
use std::array;

/// A pair that is near at the start of a step, and that may come nearer than its thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ProximityPair {
    /// Vertex and face, or first edge and second edge; the cloth's vertices, then those of bodies.
    pub vertices: [u32; 4],
    /// The weight of each vertex in the way between the closest points. Weights are positive on the first side, where they add up
    /// to one, and negative on the other.
    pub weights: [f64; 4],
    /// The direction from the second side to the first, of length one.
    pub normal: DVec3,
    /// The distance at which contact aims, in metres.
    pub thickness: f64,
}

/// The rules by which pairs become contacts.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactRules<'a> {
    pub(super) settings: &'a ContactSettings,
    /// The tangled pairs, which are not pushed.
    pub(super) exempt: &'a Exempt,
    /// The position of each vertex at rest, which limits the thickness of neighbours.
    pub(super) rest: &'a [DVec3],
    /// The error of gaps between positions of this step.
    pub(super) error: GapError<f64>,
    /// The vertices that seams hold together, in both orders.
    pub(super) joints: &'a [[u32; 2]],
    /// The normal cones of surfaces.
    pub(super) cones: &'a NormalCones,
    /// The number of the cloth's vertices; bodies' vertices come after them.
    pub(super) cloth_vertices: u32,
}

impl ContactRules<'_> {
    /// Returns whether both sides of a pair have a vertex that a seam holds.
    fn are_sewn(&self, pair: &Candidate) -> bool {
        pair.sides()
            .into_iter()
            .all(|side| side.iter().any(|&vertex| !self.joined_to(vertex).is_empty()))
    }

    /// Returns whether a seam holds a vertex of one side and one of the other side together.
    fn are_joined(&self, pair: &Candidate) -> bool {
        let [first, second] = pair.sides();
        let mut joints = first.iter().flat_map(|&vertex| self.joined_to(vertex));
        joints.any(|[_, other]| second.contains(other))
    }

    /// Returns whether the first side of a pair is a body's.
    fn is_body_first(&self, pair: &Candidate) -> bool {
        let [_, second] = pair.sides();
        pair.data.is_with_body() && second[0] < self.cloth_vertices
    }

    /// Returns whether both sides of a pair are of bodies.
    fn are_bodies(&self, pair: &Candidate) -> bool {
        pair.sides().iter().all(|side| side[0] >= self.cloth_vertices)
    }

    /// Returns the joints of a vertex.
    fn joined_to(&self, vertex: u32) -> &[[u32; 2]] {
        let from = self.joints.partition_point(|[one, _]| *one < vertex);
        let count = self.joints[from..].partition_point(|[one, _]| *one == vertex);
        &self.joints[from..from + count]
    }
}

/// The share of the thickness of neighbours at which a pair aims whose sides a seam joins. Such a pair turns about the seam,
/// which holds its ends at the thickness. Its direction leads anywhere, and at the whole thickness the two press on each other.
/// Law of the bag: one of irregular triangles trembles by 0.29 m/s at 4 ms with the whole thickness, and by 0.11 with half.
const OF_JOINED: f64 = 0.5;

/// The distance, in thicknesses, beyond which a pair needs no row at the first guess. A solve moves vertices away from there.
const ROOM: f64 = 1.25;

/// The distance within which a pair must start if it may come within `aim`.
fn reach(aim: f64) -> f64 {
    aim * (1.0 + MARGIN)
}

/// A test of a pair with a body that has left the [cone](super::cones) of the body's surface: does it go on as a contact? It gets
/// the pair's key, its vertices, and its distance in thicknesses.
pub(crate) type GoesOn<'a> = &'a dyn Fn(PairKey, [u32; 4], f64) -> bool;

/// Visits the pairs that may be nearer than their thickness at the end of a step: those that the direction which they store does
/// not keep apart at the first guess, with room to spare, and where everything but contact leads.
pub(super) fn visit_near(
    pairs: &mut [Candidate],
    rules: ContactRules<'_>,
    step: &TimeStep<'_>,
    [guess, goal]: [&[DVec3]; 2],
    goes_on: GoesOn<'_>,
    visit: &mut dyn FnMut(&Candidate, ProximityPair, f64),
) {
    for pair in pairs {
        let aim = pair.data.aim.length();
        let wide = ROOM * aim;
        let gap = f64::from(pair.gap());
        // Of what comes from afar only contacts with bodies have rows: cloth that flies at cloth seldom keeps to its first guess.
        if gap > reach(aim) && !pair.data.is_with_body() {
            continue;
        }
        // No pair beyond the reach of the search is near; most candidates are kept apart by far.
        if pair.is_kept_at(wide, guess) && pair.is_kept_at(aim, goal) || rules.exempt.is_tangled(pair) {
            continue;
        }
        let moves = pair
            .vertices
            .map(|vertex| guess[vertex as usize] - step.start[vertex as usize]);
        let closing = moves
            .iter()
            .map(|own| own.distance_squared(moves[0]))
            .fold(0.0, larger)
            .sqrt();
        if gap > wide.max(aim + closing) + 0.25 * closing {
            continue;
        }
        if let Some((near, distance)) = near_on_path(pair, rules, [step.start, guess], closing, goes_on) {
            visit(pair, near, distance);
        }
    }
}

/// The largest number of places at which a pair is looked at on its way to the first guess. They are a thickness apart on ways of
/// up to so many thicknesses, so that no pair comes near between two of them. On a longer way one may; the certificate holds it.
const MOST_PLACES: f64 = 16.0;

/// Returns the closest points where a pair first comes near on a straight way on which its vertices move apart by up to
/// `closing`. Where it passes through, they are those at the start.
fn first_near(pair: &Candidate, [start, guess]: [&[DVec3]; 2], closing: f64, at_start: ClosestPoints) -> Option<ClosestPoints> {
    let aim = pair.data.aim.length();
    let places = (closing / aim).ceil().clamp(1.0, MOST_PLACES);
    let (from, to) = (pair.points(start), pair.points(guess));
    for place in 1..=places as u32 {
        let time = f64::from(place) / places;
        let closest = ClosestPoints::from_points(pair.kind, array::from_fn(|k| from[k].lerp(to[k], time)));
        let has_turned = closest.direction.dot(at_start.direction) <= 0.0;
        if has_turned && closest.distance() <= closing / places {
            return Some(at_start);
        }
        if !has_turned && closest.distance() <= ROOM * aim {
            return Some(closest);
        }
    }
    None
}

/// The share of its thickness by which a pair slides in a step before its tangent plane may be that at the [guess](at_guess).
/// A pair that slides less has nearly the same plane there: law of the tablecloth.
const FAST: f64 = 0.1;
/// The share of its thickness below which a pair is squeezed. It keeps its plane: law of the pinched cloth. A load presses less.
const SQUEEZED: f64 = 0.95;

/// Returns the closest points at the first guess, if the pair slides to there more than it comes nearer, and is farther apart
/// there than the tangent plane at the start says. That plane would hold back what slides past an edge or a corner: law of the
/// tablecloth that is pulled away under a plate. What comes nearer keeps its plane, since the guess may be far beyond the other
/// side.
fn at_guess(pair: &Candidate, [start, guess]: [&[DVec3]; 2], at_start: ClosestPoints) -> Option<ClosestPoints> {
    let aim = pair.data.aim.length();
    let image = |points: [DVec3; 4]| -> DVec3 {
        points
            .iter()
            .zip(at_start.weights)
            .map(|(point, weight)| *point * weight)
            .sum()
    };
    let (points, normal) = (pair.points(guess), at_start.direction);
    let apart = image(points);
    let moved = apart - image(pair.points(start));
    let nearer = moved.dot(normal).abs();
    let slides = (moved.length_squared() - nearer * nearer).max(0.0).sqrt();
    if at_start.distance() < SQUEEZED * aim || apart.dot(normal) >= aim || slides <= nearer.max(FAST * aim) {
        return None;
    }
    let closest = ClosestPoints::from_points(pair.kind, points);
    (closest.distance() > apart.dot(normal) && closest.direction.dot(normal) > 0.0).then_some(closest)
}

/// Returns the pair with its distance at the start of the step, if it is a contact on the way to the first guess.
fn near_on_path(
    pair: &mut Candidate,
    rules: ContactRules<'_>,
    path: [&[DVec3]; 2],
    closing: f64,
    goes_on: GoesOn<'_>,
) -> Option<(ProximityPair, f64)> {
    let [start, _] = path;
    let mut closest = pair.closest(start);
    pair.refresh(closest.direction, start, rules.error);
    let (mut distance, aim) = (closest.distance(), pair.data.aim.length());
    if distance > reach(aim).max(aim + closing) || closest.direction == DVec3::ZERO {
        return None;
    }
    if distance > reach(aim) {
        if !pair.data.is_with_body() {
            return None;
        }
        closest = first_near(pair, path, closing, closest)?;
    }
    if pair.data.is_with_body() && closing > FAST * aim {
        closest = at_guess(pair, path, closest).unwrap_or(closest);
    }
    if !pair.data.aim.is_computed() {
        pair.data.aim = Aim::computed(thickness_of(pair, rules)?);
    }
    let mut normal = closest.direction;
    if rules.are_bodies(pair) {
        normal = of_two_surfaces(pair, &closest, rules, start)?;
        distance *= normal.dot(closest.direction);
    } else if !is_of_surface(pair, &closest, rules, start) {
        if !(pair.data.is_with_body() && goes_on(pair.key(), pair.vertices, distance / aim)) {
            return None;
        }
        normal = turned_to_surface(pair, &closest, rules, start)?;
        distance *= normal.dot(closest.direction);
    }
    let near = ProximityPair {
        vertices: pair.vertices,
        weights: closest.weights,
        normal,
        thickness: pair.data.aim.length(),
    };
    Some((near, distance))
}

/// Returns whether a contact is one of [surfaces](super::cones), and not only of faces and edges of theirs: the point of a body
/// is the closest point of its surface. Between cloth and cloth this rule holds for the face that a vertex meets. Edges push
/// where they cross. Where an end of an edge is closest, its vertex and the other edge's face push.
fn is_of_surface(pair: &Candidate, closest: &ClosestPoints, rules: ContactRules<'_>, positions: &[DVec3]) -> bool {
    let ContactRules { cones, .. } = rules;
    if pair.kind == PairKind::EdgeEdge && !pair.data.is_with_body() {
        let [first, second] = pair.sides();
        let (of_first, of_second) = closest.weights.split_at(first.len());
        return [(first, of_first), (second, of_second)]
            .into_iter()
            .all(|(edge, weights)| NormalCones::are_all(weights) || !cones.is_beside_a_face(edge));
    }
    let (vertices, weights, direction) = side_with_cone(pair, closest, rules);
    cones.contain(vertices, weights, positions, direction)
}

/// The cosine of the angle by which the direction of two bodies may turn into their cones. A direction that would turn farther
/// belongs to another contact, which is nearer: law of the boxes that stand on each other.
const LEAST_COSINE: f64 = 0.99;

/// Returns the direction of a pair of two bodies, turned a little into the cones of both; `None` if that is not possible. Boxes
/// that stand on each other touch where the cones of their corners and edges end, and a tilt by rounding would leave the cones.
fn of_two_surfaces(pair: &Candidate, closest: &ClosestPoints, rules: ContactRules<'_>, positions: &[DVec3]) -> Option<DVec3> {
    let [first, second] = pair.sides();
    let (of_first, of_second) = closest.weights.split_at(first.len());
    let into = |vertices: &[u32], weights: &[f64], direction: DVec3| {
        if rules.cones.contain(vertices, weights, positions, direction) {
            return Some(direction);
        }
        rules.cones.turn_into(vertices, weights, positions, direction)
    };
    let normal = into(second, of_second, closest.direction)?;
    let normal = -into(first, of_first, -normal)?;
    let is_of_both = rules.cones.contain(second, of_second, positions, normal);
    (is_of_both && normal.dot(closest.direction) >= LEAST_COSINE).then_some(normal)
}

/// Returns the direction of a pair with a body, turned into the cone of the body's side; `None` if that is not possible.
fn turned_to_surface(pair: &Candidate, closest: &ClosestPoints, rules: ContactRules<'_>, positions: &[DVec3]) -> Option<DVec3> {
    let (vertices, weights, direction) = side_with_cone(pair, closest, rules);
    let turned = rules.cones.turn_into(vertices, weights, positions, direction)?;
    Some(if rules.is_body_first(pair) { -turned } else { turned })
}

/// Returns the vertices and weights of a body's side, or of the second side of two cloths', and the direction from it to the
/// other side.
fn side_with_cone<'a>(pair: &'a Candidate, closest: &'a ClosestPoints, rules: ContactRules<'_>) -> (&'a [u32], &'a [f64], DVec3) {
    let [first, second] = pair.sides();
    let (of_first, of_second) = closest.weights.split_at(first.len());
    if rules.is_body_first(pair) {
        (first, of_first, -closest.direction)
    } else {
        (second, of_second, closest.direction)
    }
}

/// The thickness that a pair can have: the requested one, except for neighbours in one cloth.
fn thickness_of(pair: &Candidate, rules: ContactRules<'_>) -> Option<f64> {
    let ContactRules {
        settings, exempt, rest, ..
    } = rules;
    let asked = settings.of(pair)?;
    let Thickness { thickness, .. } = asked;
    let [one, .., other] = pair.vertices;
    if pair.data.is_with_body() {
        return Some(thickness);
    }
    if rules.are_joined(pair) {
        return Some(OF_JOINED * asked.of_neighbours());
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
    let closest = pair.closest(rest);
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
