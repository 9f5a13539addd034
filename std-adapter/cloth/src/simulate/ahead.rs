//! The speed of bodies and pins, and of the anchors of soft pins, in the frame that begins.

use super::assembly::Assembly;
use super::state::State;
use crate::model::length::{larger, length};
use crate::model::step::{Carrier, FREE, MovedAnchor};
use crate::world::{Kinematic, put_kinematic};
use selvedge_core::glam::DVec3;

/// The number of places at which bodies and pins are looked at on their way through a frame. A motion that begins or ends within
/// a frame is seen, and one that does not turn round is followed: tests of frames.
const PLACES: u32 = 4;

/// Buffers of the look ahead.
#[derive(Debug, Default)]
pub(super) struct Ahead {
    speeds: Vec<f64>,
    from: Vec<DVec3>,
    to: Vec<DVec3>,
}

/// Raises the speeds of vertices to those of their anchors, which move from `place` to where their motions have been put at a
/// time of the clock.
fn follow_anchors(
    anchors: &mut [MovedAnchor],
    motions: &[Kinematic],
    (clock, between): (f64, f64),
    mean: DVec3,
    speeds: &mut [f64],
) {
    for anchor in anchors {
        let motion = &motions[anchor.carrier as usize];
        let to = motion
            .point(&motion.pose(clock), anchor.index, anchor.rest)
            .unwrap_or(anchor.place);
        let speed = &mut speeds[anchor.vertex as usize];
        *speed = speed.max(((to - anchor.place) / between - mean).length());
        anchor.place = to;
    }
}

impl Ahead {
    /// Returns the speed of each vertex relative to `mean`: of cloth and free bodies as it is, and of other bodies, pins and
    /// anchors the largest on their way through a frame of so many seconds.
    pub(super) fn speeds(&mut self, state: &State, made: &mut Assembly, carried: &[DVec3], seconds: f64, mean: DVec3) -> &[f64] {
        let Self { speeds, from, to } = self;
        let mut anchors = made.anchors();
        let Assembly { carriers, motions, .. } = made;
        let is_free = |carrier: Carrier| motions.get(carrier as usize).is_some_and(Kinematic::is_free);
        let of_what_is_solved = |(velocity, carrier): (&DVec3, &Carrier)| match *carrier {
            carrier if carrier == FREE || is_free(carrier) => length(*velocity - mean),
            _ => 0.0,
        };
        speeds.clear();
        speeds.extend(state.velocities.iter().zip(&*carriers).map(of_what_is_solved));
        from.clone_from(&state.positions);
        let between = seconds / f64::from(PLACES);
        for place in 1..=PLACES {
            let clock = state.clock + between * f64::from(place);
            to.clone_from(&state.positions);
            put_kinematic(motions, carriers, carried, clock, to);
            for (vertex, speed) in speeds.iter_mut().enumerate().filter(|(vertex, _)| carriers[*vertex] != FREE) {
                *speed = larger(*speed, length((to[vertex] - from[vertex]) / between - mean));
            }
            follow_anchors(&mut anchors, motions, (clock, between), mean, speeds);
            std::mem::swap(from, to);
        }
        speeds
    }
}
