//! Contacts as constraints: pairs that are nearer to each other than their thickness are pushed apart.
//!
//! A row is C = n·Σwᵢxᵢ − h ≥ 0 with the direction n and the weights w of the closest points at the start of the step. A pair that
//! starts nearer than that comes apart at [`RECOVERY`] at most, whatever the length of the step: a push must not become a
//! velocity. On a fine mesh neighbours at rest may be nearer than the thickness; such a pair's is at most half its distance at rest,
//! or the mesh would lock, and [less](super::sieve).

use super::pair::Pair;
use super::{ContactSettings, Thickness};
use crate::plan::{StepInput, Touch, Touches};
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::gap::GapError;

/// Pairs that start this much farther apart than their thickness get a row too if they come near.
pub(super) const MARGIN: f64 = 2.0 / 3.0;
/// How fast what is too near comes apart, in m/s.
pub(crate) const RECOVERY: f64 = 1.0;

#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    vertices: [u32; 4],
    weights: [f64; 4],
    normal: DVec3,
    thickness: f64,
    with_body: bool,
}

/// Replaces `rows` by those of the pairs that are near at the start of the step, and that the direction which kept them apart
/// there does not keep at their thickness at its predicted end.
pub(super) fn collect(
    rows: &mut Vec<Row>,
    pairs: &mut [Pair],
    settings: &ContactSettings,
    rest: &[DVec3],
    [start, predicted]: [&[DVec3]; 2],
    h: f64,
    error: GapError<f64>,
) {
    rows.clear();
    parallel::map_chunks(
        pairs,
        |_, pairs, rows: &mut Vec<Row>| {
            let near = pairs.iter_mut();
            rows.extend(near.filter_map(|pair| row(pair, settings, rest, [start, predicted], h, error)));
        },
        rows,
        |all, own| all.extend(own),
    );
}

/// The row of a pair, if it needs one.
#[inline(always)]
fn row(
    pair: &mut Pair,
    settings: &ContactSettings,
    rest: &[DVec3],
    [start, predicted]: [&[DVec3]; 2],
    h: f64,
    error: GapError<f64>,
) -> Option<Row> {
    let Thickness { thickness, .. } = settings.of(pair)?;
    // The pair's own, once it is known.
    let aim = match f64::from(pair.thickness) {
        0.0 => thickness,
        own => own,
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
    if pair.thickness == 0.0 {
        pair.thickness = settings.thickness_of(pair, thickness, rest) as f32;
    }
    Some(Row {
        vertices: pair.vertices,
        weights: closest.weights,
        normal: closest.direction,
        thickness: f64::from(pair.thickness).min(distance + RECOVERY * h),
        with_body: pair.is_with_body(),
    })
}

/// Pushes once along the rows of bodies, or of the cloth with itself.
pub(super) fn project(
    rows: &[Row],
    with_body: bool,
    step: &StepInput<'_>,
    positions: &mut [DVec3],
    touches: &mut Touches,
) -> u64 {
    let mut pushed = 0;
    for row in rows.iter().filter(|row| row.with_body == with_body) {
        let vertices = row.vertices.map(|v| v as usize);
        let mut mobility = 0.0;
        let mut distance = -row.thickness;
        for (vertex, weight) in vertices.into_iter().zip(row.weights) {
            distance += weight * row.normal.dot(positions[vertex]);
            mobility += step.inverse_masses[vertex] * weight * weight;
        }
        if distance >= 0.0 || !(mobility > 0.0) {
            continue;
        }
        pushed += 1;
        let push = -distance;
        let along = row.normal * (push / mobility);
        for (vertex, weight) in vertices.into_iter().zip(row.weights) {
            positions[vertex] += along * (step.inverse_masses[vertex] * weight);
        }
        touches.record(|| Touch {
            vertices: row.vertices,
            weights: row.weights,
            normal: row.normal,
            push,
            drift: DVec3::ZERO,
        });
    }
    pushed
}
