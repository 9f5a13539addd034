//! A substep: a whole step, or a part of one after a cut.
//!
//! ```text
//! begin ─▶ predict ─▶ rows ─▶ solve ─▶ momentum ─▶ certify ─▶ remember
//! ```

use super::added_forces::AddedForces;
use super::assembly::Assembly;
use super::free_bodies;
use super::loads::Solved;
use super::measures::EffectTime;
use super::momentum::{self, Motion};
use super::simulation::{Simulation, Work};
use super::state::{FASTEST, limited};
use crate::contact::smooth_body::{OF_MESH, SmoothBody, away};
use crate::contact::{Blocker, ContactSolver, ProximityPair};
use crate::effects::plan::ActingForce;
use crate::model::length::turned_into_plane;
use crate::model::rigid::RigidMotion;
use crate::model::step::{Carrier, FREE, TimeStep};
use crate::solve::prediction::{self, MotionHistory};
use crate::solve::rigid::RigidBodies;
use crate::solve::rigid_body::Correction;
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

/// The largest energy that the certificate may add to a step, over that of the motion: cloth that is held back is stretched, and
/// stiff cloth throws that back as motion. Law of the energy of stiff sheets that are thrown on a bar.
///
/// A step whose solve is not finished is not refused for it: layers jam there, and shorter steps jam as well. With 0.1 as with
/// 0.05, about one step in a thousand of sheets that are thrown on bodies is cut.
const MOST_GAIN: f64 = 0.05;

/// Says whether an overstretched step is accepted. The certificate has held vertices back in it, so that edges are over their
/// limit, or store [much energy](MOST_GAIN). Two shorter steps find the contacts in time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Overstretched {
    Refused,
    Accepted,
}

/// Buffers of a substep, and the motion before it.
#[derive(Debug, Default)]
pub(super) struct SubstepWork {
    pub(super) history: MotionHistory,
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
    /// Advances the cloth by `h` seconds, and bodies and pins by `clock_seconds` of their clock.
    ///
    /// # Errors
    /// Returns an error if no motion is found that is certainly free, or if the certificate leaves an edge over its limit and
    /// `overstretched` refuses that. Then nothing has changed.
    pub(super) fn attempt(&mut self, h: f64, clock_seconds: f64, overstretched: Overstretched) -> Result<(), Blocker> {
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
            of_free_bodies,
            body_vertices,
            cloth_vertices,
            ..
        } = made;
        let Work { poses, substep, .. } = work;
        let count = *cloth_vertices;
        let times = [state.clock, state.clock + clock_seconds];
        poses.clear();
        poses.extend({ motions.iter() }.map(|motion| times.map(|time| motion.pose(time))));
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
        put_kinematic(motions, carriers, carried, times[1], ends);
        let order = (&drag[..], solve.accuracy.is_of_second_order());
        let bodies = (&motions[..], &body_vertices[..], *of_free_bodies);
        free_bodies::begin(solve, bodies, (h, history), count, poses);
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
        prediction::predict(prediction, &step, history, both, order, ends, count);
        prediction::guess(x, &step, history, both, ends, count);
        free_bodies::put(&solve.bodies, x, &mut prediction.goal);
        collect_rows(
            solve,
            (smooth_bodies, carriers),
            contact,
            &step,
            [x, &prediction.goal],
            *friction_coefficient,
        );
        solve.remind_rows(h);
        free_bodies::touch(solve, carriers, smooth_bodies, step.start, x);
        prediction::hold_pressed(&solve.rows, &step, x, count);
        let follow = |row: &mut ContactRow, x: &[DVec3], bodies: &mut RigidBodies| {
            follow_smooth(row, &step, smooth_bodies, x, bodies);
        };
        begin_smooth(&mut solve.rows, &follow, x, &mut solve.bodies);
        let outcome = solve.run(&step, prediction, x, &follow);
        for entry in &mut solve.terms {
            effects[entry.effect].seconds += std::mem::take(&mut entry.seconds);
        }
        let is_solved = outcome.map_err(|_| refusal(&step))?.is_finished;

        mark_pressed(&solve.rows, count, is_pressed);
        let mut are_pressed = free_bodies::settle(solve, h, x);
        limit_moves(&step, &carriers[..count], x);
        prediction::velocities(prediction, &step, x, is_pressed, velocities);
        for row in &mut solve.rows {
            row.remove_recovery(h, step.inverse_masses, velocities, &mut solve.bodies);
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
        let keeps_momentum = solve.is_inner() && (pieces.may_move(&step) || !solve.bodies.is_empty());
        let motion = Motion {
            forced,
            velocities: &state.velocities,
            history,
            prediction,
        };
        let is_held = solve.bodies.is_any_locked(&are_pressed) || { solve.rows.iter() }.any(|row| momentum::is_held(row, count));
        if keeps_momentum {
            let pressed = (&is_pressed[..], is_held);
            let with_bodies = (&mut solve.bodies, &are_pressed[..]);
            pieces.keep_momentum(&step, &motion, pressed, Correction::Motion, (x, velocities), with_bodies);
        }
        is_moved.clear();
        is_moved.resize(step.start.len(), false);
        if let Some(contact) = contact {
            let mut certified: Vec<RigidMotion> = solve.bodies.all.iter().map(|body| body.motion.clone()).collect();
            let motions_of_bodies = ([&mut *x, ends], &mut certified[..]);
            certify(
                contact,
                solve,
                &step,
                overstretched,
                motions_of_bodies,
                (is_moved, velocities, prediction, is_solved),
            )?;
            free_bodies::hold(&mut solve.bodies, certified, &mut are_pressed);
            let may_be_held = |body: Carrier| !solve.bodies.has(body);
            if keeps_momentum && !is_held && is_moved.contains(&true) && !contact.meets(is_moved, may_be_held) {
                for (pressed, moved) in is_pressed.iter_mut().zip(&*is_moved) {
                    *pressed |= *moved;
                }
                let pressed = (&is_pressed[..], is_held);
                let with_bodies = (&mut solve.bodies, &are_pressed[..]);
                pieces.keep_momentum(&step, &motion, pressed, Correction::Velocity, (x, velocities), with_bodies);
            }
        }
        solve.accept(is_moved, h);
        for entry in &mut solve.terms {
            if let Some(memory) = entry.action.memory_mut() {
                memory.settle(&step, x);
            }
        }
        let are_first_order = is_pressed.iter().zip(&*is_moved).map(|(pressed, moved)| *pressed || *moved);
        history.is_first_order.clear();
        history.is_first_order.extend(are_first_order);
        history.record(&state.positions, &state.velocities, h);
        free_bodies::accept(motions, &solve.bodies, h, &are_pressed, velocities);
        std::mem::swap(&mut state.velocities, velocities);
        std::mem::swap(&mut state.positions, x);
        state.clock += clock_seconds;
        loads.accept(h);
        Ok(())
    }
}

/// Marks the vertices of cloth that rows push.
fn mark_pressed(rows: &[ContactRow], count: usize, is_pressed: &mut Vec<bool>) {
    is_pressed.clear();
    is_pressed.resize(count, false);
    let parts = rows.iter().filter(|row| row.push > 0.0).flat_map(ContactRow::parts);
    parts
        .filter(|(vertex, _)| *vertex < count)
        .for_each(|(vertex, _)| is_pressed[vertex] = true);
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
    solve: &mut Solve,
    step: &TimeStep<'_>,
    overstretched: Overstretched,
    ([x, wanted], bodies): ([&mut Vec<DVec3>; 2], &mut [RigidMotion]),
    (is_moved, velocities, prediction, is_solved): (&mut [bool], &mut [DVec3], &Prediction, bool),
) -> Result<(), Blocker> {
    wanted.clone_from(x);
    contact.certify(step, x, bodies)?;
    for (vertex, is_moved) in is_moved.iter_mut().enumerate() {
        *is_moved = wanted[vertex] != x[vertex];
        if *is_moved {
            velocities[vertex] += (x[vertex] - wanted[vertex]) / step.h;
        }
    }
    if overstretched == Overstretched::Refused && is_moved.contains(&true) {
        let over = |positions: &[DVec3]| solve.longest_over_limit(positions).unwrap_or(0.0);
        let is_overlong = over(x) > OVER_LIMIT.max(over(wanted)) && over(step.start) <= OVER_LIMIT;
        let mut gains_much = || {
            let gained = solve.energy(prediction, x) - solve.energy(prediction, wanted);
            gained > MOST_GAIN * solve.motion(prediction, wanted)
        };
        if is_overlong || is_solved && gains_much() {
            return Err(refusal(step));
        }
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
    // Bodies' vertices come after the cloths'.
    let cloth_vertices = solve.bodies.first_slot;
    let (rows, bodies, was_at_rest) = solve.begin_rows();
    collect_smooth_rows(rows, smooth_bodies, step, [guess, goal], friction);
    let Some(contact) = contact else { return };
    let is_on_free_body = |vertex: u32| bodies.all.iter().any(|body| body.motion.moves(vertex));
    let is_smooth = |vertices: [u32; 4]| {
        let [a, b, c, d] = vertices;
        let carrier = carriers[a.max(b).max(c.max(d)) as usize];
        // Two bodies have no rows of their smooth surfaces.
        if a.min(b).min(c.min(d)) as usize >= cloth_vertices {
            return false;
        }
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
            // Its own rows stop vertices that come from afar. Tangent planes would hold them off the surface.
            let mut of_cloth = vertices
                .into_iter()
                .zip(weights)
                .filter(|(vertex, _)| (*vertex as usize) < cloth_vertices);
            let is_vertex = of_cloth.any(|(_, weight)| weight.abs() == 1.0);
            if is_vertex && distance > REACH * thickness {
                return;
            }
            thickness *= OF_MESH;
        }
        // What the solve moves is at the start, and other bodies are at their ends.
        let at = |vertex: u32| {
            if step.inverse_masses[vertex as usize] > 0.0 || is_on_free_body(vertex) {
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
fn begin_smooth(
    rows: &mut [ContactRow],
    follow: &dyn Fn(&mut ContactRow, &[DVec3], &mut RigidBodies),
    x: &mut [DVec3],
    bodies: &mut RigidBodies,
) {
    for row in rows.iter_mut().filter(|row| row.is_smooth()) {
        if row.push > 0.0 && row.is_at_bound() {
            // It slides along the surface, and not off it.
            let vertex = row.vertices[0] as usize;
            follow(row, x, bodies);
            let gap = row.gap(x);
            x[vertex] -= row.normal * gap;
        }
        follow(row, x, bodies);
    }
}

/// Finds the normal of a smooth body again, and the rest distance along it.
fn follow_smooth(row: &mut ContactRow, step: &TimeStep<'_>, smooth_bodies: &[SmoothBody], x: &[DVec3], bodies: &mut RigidBodies) {
    let RowKey::Smooth(vertex, body) = row.key else { return };
    let body = &smooth_bodies[body as usize];
    let [before, now] = &step.poses[body.carrier];
    let axis = match bodies.of_carrier(body.carrier) {
        Some(free) => body.axis(before).map(|end| free.carry(end)),
        None => body.axis(now),
    };
    let at = x[vertex as usize];
    let (normal, distance) = away(axis, at);
    if normal == DVec3::ZERO {
        return;
    }
    row.normal = normal;
    row.rest = normal.dot(at) - distance + row.reach;
    row.grip = turned_into_plane(row.grip, normal);
    if row.is_on_free_body() {
        let points = [distance - row.reach, distance].map(|back| at - normal * back);
        bodies.follow(row.touches, points);
        row.refresh(bodies);
    }
}
