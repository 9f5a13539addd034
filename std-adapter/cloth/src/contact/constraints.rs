//! Contacts as constraints: pairs that are nearer to each other than their thickness are pushed apart.
//!
//! A constraint is C = n·Σwᵢxᵢ − h ≥ 0 with the direction n and the weights w of the closest points at the start of the step. A pair that
//! starts nearer than that comes apart at [`RECOVERY`] at most, whatever the length of the step: a push must not become a
//! velocity. On a fine mesh neighbours at rest may be nearer than the thickness; such a pair's is at most half its distance at rest,
//! or the mesh would lock, and [less](super::neighbours). What was tangled has no such distance at rest: it comes
//! apart to at least the thickness of neighbours.

use super::candidate::Candidate;
use super::exempt::Exempt;
use super::neighbours::{are_neighbours, at_rest};
use super::settings::{ContactSettings, MARGIN, RECOVERY, Thickness};
use crate::step::{TimeStep, Touch, Touches};
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::gap::GapError;

#[derive(Clone, Copy, Debug)]
pub(super) struct ContactConstraint {
    pair: NearPair,
    with_body: bool,
}

/// A pair that is near at the start of a step, and would come nearer than its thickness.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearPair {
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
}

/// Replaces `constraints` by those of the pairs that are near at the start of the step, and that the direction which kept them apart
/// there does not keep at their thickness at its predicted end.
pub(super) fn collect(
    constraints: &mut Vec<ContactConstraint>,
    pairs: &mut [Candidate],
    rules: Rules<'_>,
    [start, predicted]: [&[DVec3]; 2],
    h: f64,
    error: GapError<f64>,
) {
    constraints.clear();
    parallel::map_chunks(
        pairs,
        |_, pairs, constraints: &mut Vec<ContactConstraint>| {
            let near = pairs.iter_mut();
            constraints.extend(near.filter_map(|pair| constraint(pair, rules, [start, predicted], h, error)));
        },
        constraints,
        |all, own| all.extend(own),
    );
}

/// The constraint of a pair, if it needs one.
#[inline(always)]
fn constraint(
    pair: &mut Candidate,
    rules: Rules<'_>,
    [start, predicted]: [&[DVec3]; 2],
    h: f64,
    error: GapError<f64>,
) -> Option<ContactConstraint> {
    let own = rules.settings.of(pair)?;
    if rules.exempt.is_tangled(pair) {
        return None;
    }
    // The pair's own, once it is known.
    let aim = match f64::from(pair.data.thickness) {
        0.0 => own.thickness,
        known => known,
    };
    let reach = aim * (1.0 + MARGIN);
    if f64::from(pair.gap()) > reach || pair.is_kept_at(aim, predicted) {
        return None;
    }
    let closest = pair.closest(start);
    pair.refresh(closest.direction, start, error);
    let distance = closest.distance();
    if distance > reach || closest.direction == DVec3::ZERO {
        return None;
    }
    if pair.data.thickness == 0.0 {
        pair.data.thickness = thickness_of(pair, rules, own) as f32;
    }
    Some(ContactConstraint {
        pair: NearPair {
            vertices: pair.vertices,
            weights: closest.weights,
            normal: closest.direction,
            thickness: f64::from(pair.data.thickness).min(distance + RECOVERY * h),
        },
        with_body: pair.data.is_with_body(),
    })
}

/// The thickness that a pair can have: the one that is asked for, but for neighbours in one cloth.
fn thickness_of(pair: &Candidate, rules: Rules<'_>, asked: Thickness) -> f64 {
    let Rules { settings, exempt, rest } = rules;
    let Thickness { thickness, .. } = asked;
    let [one, .., other] = pair.vertices;
    if pair.data.is_with_body() || !settings.are_of_one_cloth(one, other) {
        return thickness;
    }
    let are_near = || are_neighbours(pair.kind, pair.points(rest), at_rest(asked));
    let own = if settings.has_neighbours && are_near() {
        asked.of_neighbours()
    } else {
        thickness
    };
    let own = own.min(0.5 * pair.closest(rest).distance());
    if exempt.is_parting(pair) {
        own.max(asked.of_neighbours())
    } else {
        own
    }
}

/// The pairs that constraints are on.
pub(super) fn near_pairs(constraints: &[ContactConstraint]) -> impl Iterator<Item = NearPair> {
    constraints.iter().map(|constraint| constraint.pair)
}

/// Pushes once along the constraints of bodies, or of the cloth with itself.
pub(super) fn project(
    constraints: &[ContactConstraint],
    with_body: bool,
    step: &TimeStep<'_>,
    positions: &mut [DVec3],
    touches: &mut Touches,
) -> u64 {
    let mut pushed = 0;
    for ContactConstraint { pair: constraint, .. } in constraints.iter().filter(|constraint| constraint.with_body == with_body) {
        let vertices = constraint.vertices.map(|v| v as usize);
        let mut mobility = 0.0;
        let mut distance = -constraint.thickness;
        for (vertex, weight) in vertices.into_iter().zip(constraint.weights) {
            distance += weight * constraint.normal.dot(positions[vertex]);
            mobility += step.inverse_masses[vertex] * weight * weight;
        }
        if distance >= 0.0 || !(mobility > 0.0) {
            continue;
        }
        pushed += 1;
        let push = -distance;
        let along = constraint.normal * (push / mobility);
        for (vertex, weight) in vertices.into_iter().zip(constraint.weights) {
            positions[vertex] += along * (step.inverse_masses[vertex] * weight);
        }
        touches.record(|| Touch {
            vertices: constraint.vertices,
            weights: constraint.weights,
            normal: constraint.normal,
            push,
            drift: DVec3::ZERO,
        });
    }
    pushed
}
