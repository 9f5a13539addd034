//! A substep: a whole step, or a part of one after a cut.
//!
//! ```text
//! begin ─▶ predict ─▶ rows ─▶ solve ─▶ momentum ─▶ certify ─▶ remember
//! ```

use super::added_forces::AddedForces;
use super::assembly::Assembly;
use super::loads::Solved;
use super::measures::EffectTime;
use super::momentum::Motion;
use super::simulation::{Simulation, Work};
use super::state::{FASTEST, limited};
use crate::contact::smooth_body::{OF_MESH, SmoothBody, away};
use crate::contact::{Blocker, ContactSolver, ProximityPair};
use crate::effects::plan::ActingForce;
use crate::model::step::{Carrier, FREE, TimeStep};
use crate::solve::prediction::{self, History};
use crate::solve::{ContactRow, Prediction, RowKey, Solve};
use crate::world::put_kinematic;
use selvedge::PairKind;
use selvedge::clock::Clock;
use selvedge_core::glam::DVec3;

/// A smooth body has rows with vertices that may come within this many thicknesses of it.
const REACH: f64 = 1.5;

/// How long an edge may be over its limit where the certificate has held vertices back. Law of the jerk, and the longest edge of
/// all shipped scenes.
const OVER_LIMIT: f64 = 1.02;

/// What happens to an overstretched step. The certificate has held vertices back in it, so that edges are over their limit. Two
/// shorter steps find the contacts in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Overstretched {
    Refused,
    Accepted,
}

/// Buffers of a substep, and the motion before it.
#[derive(Debug, Default)]
pub(super) struct SubstepWork {
    pub(super) history: History,
    prediction: Prediction,
    forced: Vec<DVec3>,
    /// The positions of kinematic vertices at the end of the step.
    ends: Vec<DVec3>,
    x: Vec<DVec3>,
    is_pressed: Vec<bool>,
    is_moved: Vec<bool>,
    velocities: Vec<DVec3>,
}

impl Simulation {
    /// Advances the cloth by `h` seconds, and bodies and pins by `ticks` seconds of their clock.
    ///
    /// # Errors
    /// Returns an error if no motion is found that is certainly free, or if the certificate leaves an edge over its limit and
    /// `overstretched` refuses that. Then nothing has changed.
    pub(super) fn attempt(&mut self, h: f64, ticks: f64, overstretched: Overstretched) -> Result<(), Blocker> {
        let Self {
            state,
            work,
            carried,
            effects,
            made,
            time_step,
            loads,
            added_forces,
            ..
        } = self;
        let Assembly {
            inverse_masses,
            carriers,
            contact,
            motions,
            forces,
            pieces,
            solve,
            smooth_bodies,
            drag,
            supports,
            friction_coefficient,
            cloth_vertices,
            ..
        } = made;
        let Work { poses, substep, .. } = work;
        let count = *cloth_vertices;
        let clock = state.clock;
        poses.clear();
        poses.extend(
            motions
                .iter()
                .map(|motion| [clock, clock + ticks].map(|time| motion.pose(time))),
        );
        let SubstepWork {
            history,
            prediction,
            forced,
            ends,
            x,
            is_pressed,
            is_moved,
            velocities,
        } = substep;
        ends.clone_from(&state.positions);
        put_kinematic(motions, carriers, carried, clock + ticks, ends);
        let step = TimeStep {
            time: state.time(*time_step),
            h,
            start: &state.positions,
            inverse_masses,
            poses,
            motions,
        };
        forced.clone_from(&state.velocities);
        apply_forces((forces, added_forces), &step, forced, effects);
        let both = [&state.velocities[..], &forced[..]];
        let order = (&drag[..], solve.accuracy.is_of_second_order());
        prediction::predict(prediction, &step, history, both, order, ends, count);
        prediction::guess(x, &step, history, both, ends, count);
        collect_rows(
            solve,
            (smooth_bodies, carriers),
            contact,
            &step,
            [x, &prediction.goal],
            *friction_coefficient,
        );
        solve.remind_rows(h);
        prediction::hold_pressed(&solve.rows, &step, x, count);
        let follow = |row: &mut ContactRow, x: &[DVec3]| follow_smooth(row, &step, smooth_bodies, x);
        begin_smooth(&mut solve.rows, &step, smooth_bodies, x);
        let outcome = solve.run(&step, prediction, x, &follow);
        for entry in &mut solve.terms {
            effects[entry.effect].seconds += std::mem::take(&mut entry.seconds);
        }
        outcome.map_err(|_| refusal(&step))?;

        is_pressed.clear();
        is_pressed.resize(count, false);
        for row in solve.rows.iter().filter(|row| row.push > 0.0) {
            row.parts()
                .filter(|(vertex, _)| *vertex < count)
                .for_each(|(vertex, _)| is_pressed[vertex] = true);
        }
        limit_moves(&step, &carriers[..count], x);
        prediction::velocities(prediction, &step, x, is_pressed, velocities);
        for row in &mut solve.rows {
            row.remove_recovery(h, step.inverse_masses, velocities);
        }
        loads.measure(
            &Solved {
                solve,
                step: &step,
                velocities: &state.velocities,
                x,
                carriers,
                smooth_bodies,
                supports,
                drag,
                added_forces,
                cloth_vertices: count,
            },
            forces,
        );
        if solve.is_inner() && pieces.may_move(&step) {
            let is_body_near = solve.rows.iter().any(|row| row.push > 0.0 && row.is_with_body);
            let motion = Motion {
                forced,
                velocities: &state.velocities,
                history,
                prediction,
            };
            pieces.keep_momentum(&step, &motion, (is_pressed, is_body_near), x, velocities);
        }
        is_moved.clear();
        is_moved.resize(step.start.len(), false);
        if let Some(contact) = contact {
            certify(contact, solve, &step, overstretched, [x, ends], (is_moved, velocities))?;
        }
        solve.accept(is_moved, h);
        for entry in &mut solve.terms {
            if let Some(memory) = entry.action.memory_mut() {
                memory.settle(&step, x);
            }
        }
        history.is_first_order.clear();
        history
            .is_first_order
            .extend(is_pressed.iter().zip(&*is_moved).map(|(pressed, moved)| *pressed || *moved));
        history.record(&state.positions, &state.velocities, h);
        std::mem::swap(&mut state.velocities, velocities);
        std::mem::swap(&mut state.positions, x);
        state.clock += ticks;
        loads.accept(h);
        Ok(())
    }
}

/// Applies forces to velocities, and counts the time of their effects.
fn apply_forces(
    (forces, added_forces): (&mut [ActingForce], &AddedForces),
    step: &TimeStep<'_>,
    velocities: &mut [DVec3],
    effects: &mut [EffectTime],
) {
    for entry in forces {
        let begin = Clock::now();
        entry.apply(step, velocities);
        effects[entry.effect].seconds += begin.elapsed().as_secs_f64();
    }
    added_forces.apply(step, velocities);
    velocities
        .iter_mut()
        .for_each(|velocity| *velocity = limited(*velocity, FASTEST));
}

/// Shortens the moves of free vertices to those of the largest speed.
fn limit_moves(step: &TimeStep<'_>, carriers: &[Carrier], x: &mut [DVec3]) {
    for ((position, &start), _) in { x.iter_mut().zip(step.start) }
        .zip(carriers)
        .filter(|(_, carrier)| **carrier == FREE)
    {
        *position = start + limited(*position - start, FASTEST * step.h);
    }
}

/// Certifies the step to `x`: vertices that meet something stop before it. `wanted` becomes where all wanted to be.
fn certify(
    contact: &mut ContactSolver,
    solve: &Solve,
    step: &TimeStep<'_>,
    overstretched: Overstretched,
    [x, wanted]: [&mut Vec<DVec3>; 2],
    (is_moved, velocities): (&mut [bool], &mut [DVec3]),
) -> Result<(), Blocker> {
    wanted.clone_from(x);
    contact.certify(step, x)?;
    for (vertex, is_moved) in is_moved.iter_mut().enumerate() {
        *is_moved = wanted[vertex] != x[vertex];
        if *is_moved {
            velocities[vertex] += (x[vertex] - wanted[vertex]) / step.h;
        }
    }
    let over = |positions: &[DVec3]| solve.longest_over_limit(positions).unwrap_or(0.0);
    let is_refused = overstretched == Overstretched::Refused
        && is_moved.contains(&true)
        && over(x) > OVER_LIMIT.max(over(wanted))
        && over(step.start) <= OVER_LIMIT;
    if is_refused {
        return Err(refusal(step));
    }
    contact.counts.pushed += solve.rows.iter().filter(|row| row.push > 0.0).count() as u64;
    Ok(())
}

/// The blocker of a step whose energy is not finite, or that is made in parts instead.
const fn refusal(step: &TimeStep<'_>) -> Blocker {
    Blocker {
        time: step.time,
        kind: PairKind::VertexFace,
        vertices: [0; 4],
        body: None,
    }
}

/// Makes the rows of a step, whose solve begins at `guess`; everything but contact leads to `goal`.
fn collect_rows(
    solve: &mut Solve,
    (smooth_bodies, carriers): (&[SmoothBody], &[Carrier]),
    contact: &mut Option<ContactSolver>,
    step: &TimeStep<'_>,
    [guess, goal]: [&[DVec3]; 2],
    friction: f64,
) {
    let (rows, was_at_rest) = solve.begin_rows();
    collect_smooth_rows(rows, smooth_bodies, step, [guess, goal], friction);
    let Some(contact) = contact else { return };
    // Bodies' vertices come after the cloths'.
    let is_smooth = |vertices: [u32; 4]| {
        let [a, b, c, d] = vertices;
        let carrier = carriers[a.max(b).max(c.max(d)) as usize];
        let own = smooth_bodies.iter().map(|body| body.carrier);
        { own }.any(|own| own == carrier as usize && step.poses[own][1].is_rigid())
    };
    let goes_on = |key, vertices, thicknesses: f64| {
        let aim = if is_smooth(vertices) { OF_MESH } else { 1.0 };
        was_at_rest(key, thicknesses / aim)
    };
    contact.visit_near(step, [guess, goal], &goes_on, &mut |key, is_with_body, near, distance| {
        let ProximityPair {
            vertices,
            weights,
            normal,
            mut thickness,
        } = near;
        if is_with_body && is_smooth(vertices) {
            // Its own rows stop what comes from afar, whose tangent planes would hold it off the surface.
            if distance > REACH * thickness {
                return;
            }
            thickness *= OF_MESH;
        }
        // Bodies are at their ends in the guess, and the cloth at the start.
        let at = |vertex: u32| {
            if step.inverse_masses[vertex as usize] > 0.0 {
                step.start[vertex as usize]
            } else {
                guess[vertex as usize]
            }
        };
        let left = vertices
            .into_iter()
            .zip(weights)
            .map(|(vertex, weight)| weight * normal.dot(at(vertex)))
            .sum();
        rows.push(ContactRow {
            thickness,
            is_with_body,
            distance,
            left,
            friction,
            ..ContactRow::new(RowKey::Pair(key), vertices, weights, normal, step.start)
        });
    });
}

/// Adds the rows of vertices and smooth bodies.
fn collect_smooth_rows(
    rows: &mut Vec<ContactRow>,
    smooth_bodies: &[SmoothBody],
    step: &TimeStep<'_>,
    [guess, goal]: [&[DVec3]; 2],
    friction: f64,
) {
    for (index, body) in smooth_bodies.iter().enumerate() {
        let [before, now] = step.poses[body.carrier];
        if !now.is_rigid() {
            continue;
        }
        let [axis_before, axis] = [&before, &now].map(|pose| body.axis(pose));
        let far = body.radius + REACH * body.thickness;
        for vertex in body.vertices.clone().filter(|&vertex| step.inverse_masses[vertex] > 0.0) {
            let start = step.start[vertex];
            let [at_start, at_guess, at_goal] =
                [(axis_before, start), (axis, guess[vertex]), (axis, goal[vertex])].map(|(axis, point)| away(axis, point).1);
            if at_start.min(at_guess).min(at_goal) > far {
                continue;
            }
            let (normal, _) = away(axis, guess[vertex]);
            let key = RowKey::Smooth(vertex as u32, index as u32);
            rows.push(ContactRow {
                thickness: body.thickness,
                is_with_body: true,
                distance: at_start - body.radius,
                left: away(axis, start).1 - body.radius,
                radius: body.radius,
                drift: before.carry(&now, start) - start,
                friction,
                ..ContactRow::new(key, [vertex as u32; 4], [1.0, 0.0, 0.0, 0.0], normal, step.start)
            });
        }
    }
}

/// Prepares the rows of smooth bodies for a solve that begins at `x`.
fn begin_smooth(rows: &mut [ContactRow], step: &TimeStep<'_>, smooth_bodies: &[SmoothBody], x: &mut [DVec3]) {
    for row in rows.iter_mut().filter(|row| row.is_smooth()) {
        if row.push > 0.0 && row.is_at_bound() {
            // It slides along the surface, and not off it.
            let vertex = row.vertices[0] as usize;
            follow_smooth(row, step, smooth_bodies, x);
            let gap = row.gap(x);
            x[vertex] -= row.normal * gap;
        }
        follow_smooth(row, step, smooth_bodies, x);
    }
}

/// Finds the normal of a smooth body again, and the rest distance along it.
fn follow_smooth(row: &mut ContactRow, step: &TimeStep<'_>, smooth_bodies: &[SmoothBody], x: &[DVec3]) {
    let RowKey::Smooth(vertex, body) = row.key else { return };
    let body = &smooth_bodies[body as usize];
    let axis = body.axis(&step.poses[body.carrier][1]);
    let at = x[vertex as usize];
    let (normal, distance) = away(axis, at);
    if normal == DVec3::ZERO {
        return;
    }
    row.normal = normal;
    row.rest = normal.dot(at) - distance + row.reach;
    row.grip -= normal * row.grip.dot(normal);
}
