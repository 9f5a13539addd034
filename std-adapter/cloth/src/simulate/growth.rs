//! Untangling where contours have no slope, as on upright walls, and of garments that are smaller than their body.
//!
//! ```text
//! a body that cloth passes through ─▶ shrinks until it is off the cloth ─▶ grows back in certified steps, and pushes the cloth out
//! ```
//!
//! **Shrinking.** The vertices of the body move to the mean of their neighbours, again and again: limbs become thin, and what is
//! round stays round, so a garment stays around its limb. If that never leaves the cloth, the body shrinks towards its vertex
//! that is farthest from cloth. The shrunken body may pass through itself, which is no concern of cloth.
//!
//! **Growing.** No time passes. Each step starts at rest, and the body moves straight by about as much as cloth can follow. A
//! step that is not certified is cut, or the body waits for the cloth to relax.

use super::simulation::Simulation;
use crate::scene::OnBlocked;
use crate::world::{BodyMotion, Kinematic, Placement};
use selvedge_core::glam::DVec3;
use std::collections::BTreeSet;
use std::ops::Range;

/// The rounds of smoothing that are tried, one after the other.
const SMOOTHINGS: [u32; 6] = [2, 5, 15, 50, 150, 500];
/// The size of a body that has shrunk towards one of its vertices.
const SMALLEST: f64 = 0.01;
/// The move of a body in a step, in mean distances of vertices of the finest cloth.
const PACE: f64 = 0.25;
const MOST_STEPS: usize = 4000;
/// Growing stops after so many steps in which the body had to wait.
const MOST_WAITS: u32 = 100;

impl Simulation {
    /// Pushes the cloth out of bodies that it passes through. Returns whether no body passes through cloth any more; otherwise
    /// all is as it was.
    pub(super) fn grow_bodies(&mut self, spacing: f64) -> bool {
        let bodies: BTreeSet<usize> = self.crossings().iter().filter_map(|crossing| crossing.body).collect();
        if bodies.is_empty() {
            return false;
        }
        let (before, on_blocked, is_fresh) = (self.state.clone(), self.on_blocked, self.is_fresh);
        // Nothing tears before the first step.
        let tearing = self.tearing.take();
        self.on_blocked = OnBlocked::Hold;
        let free = bodies.iter().all(|&body| self.grow(body, spacing));
        (self.on_blocked, self.is_fresh, self.tearing) = (on_blocked, is_fresh, tearing);
        let positions = std::mem::replace(&mut self.state, before).positions;
        if free {
            self.state.positions = positions;
        }
        self.look_again() && free
    }

    /// Finds the present crossings. Returns false if a position is not finite.
    pub(super) fn look_again(&mut self) -> bool {
        let Some(contact) = &mut self.made.contact else {
            return true;
        };
        self.state.begin_anew(contact, self.time_step);
        contact.tolerate(&self.state.positions).is_ok()
    }

    fn passes_through_cloth(&self, body: usize) -> bool {
        self.crossings().iter().any(|crossing| crossing.body == Some(body))
    }

    /// Lets one body shrink and grow.
    fn grow(&mut self, body: usize, spacing: f64) -> bool {
        let own = self.made.body_vertices[body].clone();
        let full = self.state.positions[own.clone()].to_vec();
        let around = neighbours(&self.made.triangles[self.made.cloth_triangles..], &own);
        let mut shrunken = full.clone();
        let mut rounds = 0;
        for &wanted in &SMOOTHINGS {
            for _ in rounds..wanted {
                smooth(&mut shrunken, &around);
            }
            rounds = wanted;
            if self.starts_free(body, &own, &shrunken) {
                return self.grow_from(body, &own, [&shrunken, &full], spacing);
            }
        }
        let cloth = &self.state.positions[..self.made.cloth_vertices];
        let room = |point: &DVec3| {
            cloth
                .iter()
                .map(|other| point.distance_squared(*other))
                .fold(f64::INFINITY, f64::min)
        };
        let Some(&centre) = full.iter().max_by(|one, other| room(one).total_cmp(&room(other))) else {
            return false;
        };
        let small: Vec<DVec3> = full.iter().map(|point| centre.lerp(*point, SMALLEST)).collect();
        self.starts_free(body, &own, &small) && self.grow_from(body, &own, [&small, &full], spacing)
    }

    /// Puts a body to these positions, and returns whether it does not pass through cloth there.
    fn starts_free(&mut self, body: usize, own: &Range<usize>, positions: &[DVec3]) -> bool {
        self.state.positions[own.clone()].copy_from_slice(positions);
        self.look_again() && !self.passes_through_cloth(body)
    }

    /// Moves a body from one shape to another in certified steps.
    fn grow_from(&mut self, body: usize, own: &Range<usize>, [from, to]: [&[DVec3]; 2], spacing: f64) -> bool {
        let driven = BodyMotion::Driven(Placement::default());
        let vertices = (own.start as u32..own.end as u32).collect();
        let motion = std::mem::replace(&mut self.made.motions[body], Kinematic::new(driven, vertices));
        let farthest = from.iter().zip(to).map(|(from, to)| from.distance(*to)).fold(0.0, f64::max);
        let steps = ((farthest / (PACE * spacing)).ceil() as usize).clamp(1, MOST_STEPS);
        let (mut step, mut waits) = (1, 0);
        while step <= steps && waits < MOST_WAITS {
            let share = step as f64 / steps as f64;
            // The last step ends exactly at the full size.
            let goal = from
                .iter()
                .zip(to)
                .map(|(from, to)| if step < steps { from.lerp(*to, share) } else { *to });
            let goal: Vec<DVec3> = goal.collect();
            if let Some(driven) = self.made.motions[body].driven_mut() {
                driven.lead_points_to(goal.clone());
            }
            self.state.velocities.fill(DVec3::ZERO);
            if self.step().is_err() {
                break;
            }
            if self.state.positions[own.clone()] == goal {
                step += 1;
            } else {
                waits += 1;
            }
        }
        self.made.motions[body] = motion;
        self.look_again() && step > steps && !self.passes_through_cloth(body)
    }
}

/// Returns for each vertex of a body its neighbours, numbered within the body.
fn neighbours(triangles: &[[u32; 3]], own: &Range<usize>) -> Vec<Vec<usize>> {
    let mut around = vec![BTreeSet::new(); own.len()];
    let inside = |corners: &&[u32; 3]| corners.iter().all(|&corner| own.contains(&(corner as usize)));
    for corners in triangles.iter().filter(inside) {
        let [a, b, c] = corners.map(|corner| corner as usize - own.start);
        for (vertex, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
            around[vertex].extend(others);
        }
    }
    around.into_iter().map(|own| own.into_iter().collect()).collect()
}

/// Moves each vertex half of the way to the mean of its neighbours.
fn smooth(positions: &mut Vec<DVec3>, around: &[Vec<usize>]) {
    let mean = |own: &[usize]| own.iter().map(|&other| positions[other]).sum::<DVec3>() / own.len() as f64;
    let moved = positions.iter().zip(around);
    let moved = moved.map(|(&point, own)| if own.is_empty() { point } else { point.midpoint(mean(own)) });
    *positions = moved.collect();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::tube;

    #[test]
    fn a_limb_becomes_thin_and_stays_where_it_is() {
        let mesh = tube([DVec3::ZERO, DVec3::Z], 0.1, [12, 30]);
        let own = 5..5 + mesh.positions.len();
        let triangles: Vec<_> = mesh.triangles.iter().map(|t| t.map(|vertex| vertex + 5)).collect();
        let around = neighbours(&triangles, &own);
        assert!(around.iter().all(|own| own.len() >= 4));
        let mut positions = mesh.positions.clone();
        (0..30).for_each(|_| smooth(&mut positions, &around));
        let middle = &positions[12 * 15..12 * 16];
        assert!(
            middle
                .iter()
                .all(|p| p.with_z(0.0).length() < 0.06 && (p.z - 0.5).abs() < 0.05)
        );
    }
}
