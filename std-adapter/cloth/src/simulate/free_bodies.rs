//! Free bodies in a step: into the solve, and back out of it.

use super::state::{FASTEST, limited};
use crate::contact::smooth_body::SmoothBody;
use crate::model::rigid::RigidMotion;
use crate::model::step::Carrier;
use crate::solve::Solve;
use crate::solve::prediction::MotionHistory;
use crate::solve::rigid::{OnBody, RigidBodies};
use crate::solve::rigid_body::{RigidBody, StepOfBody};
use crate::world::{Kinematic, Pose};
use selvedge_core::glam::DVec3;
use std::ops::Range;

/// The acceleration of free bodies besides that of contacts, and whether they rest.
#[derive(Clone, Copy, Debug)]
pub(super) struct OfFreeBodies {
    /// The acceleration, in m/s².
    pub(super) gravity: DVec3,
    /// True if they rest, as during untangling.
    pub(super) rest: bool,
}

/// Puts the free bodies into a solve of `h` seconds, at its first guess, and their poses there into `poses`.
pub(super) fn begin(
    solve: &mut Solve,
    (motions, body_vertices, of_bodies): (&[Kinematic], &[Range<usize>], OfFreeBodies),
    (h, history): (f64, &MotionHistory),
    cloth_vertices: usize,
    poses: &mut [[Pose; 2]],
) {
    let step = StepOfBody {
        h,
        gravity: of_bodies.gravity,
        may_be_second: solve.accuracy.is_of_second_order() && history.was_as_long_as(h),
        before: history.last_step_seconds(),
    };
    let free = motions.iter().zip(body_vertices).enumerate();
    let free = free.filter_map(|(carrier, (motion, vertices))| Some((carrier, motion.free()?, vertices)));
    let free = free.filter(|_| !of_bodies.rest);
    let bodies = free.map(|(carrier, free, vertices)| RigidBody::new(carrier, vertices.clone(), free, step));
    solve.bodies.begin(bodies.collect(), cloth_vertices);
    set_poses(&solve.bodies, poses);
}

/// Writes the vertices of free bodies at the first guess, and where everything but contact leads.
pub(super) fn put(bodies: &RigidBodies, guess: &mut [DVec3], goal: &mut [DVec3]) {
    bodies.put(guess);
    bodies.all.iter().for_each(|body| body.goal().put(goal));
}

/// Replaces the poses of free bodies by those of the guess.
fn set_poses(bodies: &RigidBodies, poses: &mut [[Pose; 2]]) {
    for body in &bodies.all {
        let pose = poses[body.carrier][0];
        let RigidMotion {
            centre,
            displacement,
            turn,
            ..
        } = body.motion;
        let (axis, angle) = (turn.normalize_or(DVec3::Z), turn.length());
        poses[body.carrier] = [(0.0, DVec3::ZERO), (angle, displacement)]
            .map(|(angle, displacement)| pose.about(centre).turned_and_moved(axis, angle, displacement));
    }
}

/// Lets rows push the free bodies that they meet, and sends other bodies to their goals. `start` has the positions at the start
/// of the step, and `x` those of the first guess.
pub(super) fn touch(solve: &mut Solve, carriers: &[Carrier], smooth: &[SmoothBody], start: &[DVec3], x: &mut [DVec3]) {
    let Solve { bodies, rows, .. } = solve;
    if bodies.is_empty() {
        return;
    }
    for row in rows {
        let mut sides: Vec<OnBody> = Vec::new();
        if let Some(body) = row.smooth_body() {
            sides.push(OnBody {
                carrier: smooth[body].carrier,
                side: -1.0,
                point: start[row.vertices[0] as usize],
            });
        } else {
            for side in [1.0, -1.0] {
                let own = || row.parts().filter(|(_, weight)| weight * side > 0.0);
                let Some((first, _)) = own().next() else { continue };
                let point = own().map(|(vertex, weight)| start[vertex] * weight.abs()).sum();
                let carrier = carriers[first] as usize;
                let body = bodies.of_carrier(carrier);
                if body.is_some_and(|body| body.motion.vertices.contains(&first)) {
                    sides.push(OnBody { carrier, side, point });
                }
            }
        }
        let off = (!row.is_smooth()).then(|| row.normal * row.rest);
        row.touches = bodies.touch(&sides, off);
        row.refresh(bodies);
    }
    bodies.send_untouched(x);
}

/// Ends a solve of `h` seconds: sends bodies that nothing presses to their goals, and shortens moves to those of the largest
/// speed. Returns which bodies are pressed.
pub(super) fn settle(solve: &mut Solve, h: f64, x: &mut [DVec3]) -> Vec<bool> {
    let Solve { bodies, rows, .. } = solve;
    let pushing = rows.iter().filter(|row| row.push > 0.0);
    let mut are_pressed = bodies.are_pressed(pushing.map(|row| row.touches));
    // Pinned cloth pulls.
    for (is_pressed, body) in are_pressed.iter_mut().zip(&bodies.all) {
        *is_pressed |= !body.motion.riders.is_empty();
    }
    bodies.send(&are_pressed, x);
    for body in &mut bodies.all {
        let displacement = limited(body.motion.displacement, FASTEST * h);
        if displacement != body.motion.displacement {
            body.place(RigidMotion {
                displacement,
                ..body.motion.clone()
            });
            body.motion.put(x);
        }
    }
    are_pressed
}

/// Takes the motions with which the certificate has left bodies. Bodies that it has held back count as pressed.
pub(super) fn hold(bodies: &mut RigidBodies, certified: Vec<RigidMotion>, are_pressed: &mut [bool]) {
    for ((body, certified), is_pressed) in bodies.all.iter_mut().zip(certified).zip(are_pressed) {
        if !certified.leads_where(&body.motion) {
            body.place(certified);
            *is_pressed = true;
        }
    }
}

/// Takes the motion of an accepted step of `h` seconds. `are_pressed` says which bodies something presses.
pub(super) fn accept(motions: &mut [Kinematic], bodies: &RigidBodies, h: f64, are_pressed: &[bool], velocities: &mut [DVec3]) {
    for (body, &is_pressed) in bodies.all.iter().zip(are_pressed) {
        let Some(free) = motions[body.carrier].free_mut() else {
            continue;
        };
        let state = body.end(h, is_pressed);
        free.before = std::mem::replace(&mut free.state, state);
        free.is_first_order = is_pressed;
        let spin = free.spin_of(&state);
        for (vertex, &point) in body.motion.members().zip(&*body.motion.points) {
            velocities[vertex] = state.velocity + spin.cross(state.rotation * point);
        }
    }
}
