//! Untangling of a tangled start, before the first step.
//!
//! ```text
//! what meets ─▶ ways that shorten it ─▶ solve ─▶ certified pass, without what meets ─▶ what meets now … until nothing does
//!                                        └─▶ then contacts push until all is apart by its separation, and the cloth relaxes
//! ```
//!
//! Where that does not end, [bodies shrink and grow](super::growth).
//!
//! Untangling makes steps without forces, inertia and time. Bodies and pins rest, and each step starts at rest and moves vertices
//! along [the way out](crate::contact) by at most [`REACH`]. So stretch, shear, bending and strain limits keep the cloth
//! together. New pairs meet only next to those that meet already.

use super::errors::SetupError;
use super::simulation::Simulation;
use super::substep::Overstretched;
use super::tangled::{Tangled, Untangled, UntanglingEnd, UntanglingProgress};
use crate::contact::Crossing;
use selvedge::clock::Clock;
use selvedge_core::glam::DVec3;

/// The largest move of a vertex in a step, in mean distances of vertices of the finest cloth. It takes several steps to cross a
/// triangle.
const REACH: f64 = 0.3;
/// The number of tries of a step, each with half the reach.
const TRIES: u32 = 7;
/// The largest number of steps that move vertices out.
const MOST: u32 = 1000;
/// Untangling stops if the number of intersections has had no new minimum for this many steps. Garments that come apart in the
/// tests need less than a third of that.
const HOPELESS: u32 = 200;
/// The largest number of steps in which the cloth relaxes. It has relaxed if the longest edge has not become shorter by the share
/// [`RELAXING`] in [`PATIENCE`] steps.
const MOST_RELAXING: u32 = 500;
const PATIENCE: u32 = 20;
const RELAXING: f64 = 0.01;

impl Simulation {
    pub(super) fn is_apart(&self) -> bool {
        self.made.contact.as_ref().is_none_or(|contact| contact.exempt().is_empty())
    }

    /// Starts contact at the present positions, and returns what meets.
    pub(super) fn begin_contact(&mut self) -> Result<Vec<Crossing>, SetupError> {
        let Some(contact) = &mut self.made.contact else {
            return Ok(Vec::new());
        };
        self.state.begin_anew(contact, self.time_step);
        Ok(contact.tolerate(&self.state.positions)?)
    }

    /// Checks the state after untangling like any start.
    pub(super) fn check_untangled(&mut self, untangled: Untangled) -> Result<(), SetupError> {
        if let Some(contact) = &mut self.made.contact {
            contact.end_untangling(&self.state.positions);
        }
        let crossings = self.begin_contact()?;
        if !crossings.is_empty() {
            return Err(self.tangled(crossings, Some(untangled)));
        }
        self.untangled = Some(untangled);
        Ok(())
    }

    /// Returns the error that some edges and faces meet, perhaps after untangling.
    pub(super) fn tangled(&self, crossings: Vec<Crossing>, untangled: Option<Untangled>) -> SetupError {
        SetupError::Tangled(Box::new(Tangled {
            pinned: Tangled::pinned_of(&crossings, &self.made.carriers[..self.made.cloth_vertices]),
            crossings,
            numbers_in_files: self.mesh_in_files().number_of,
            mesh: self.mesh(),
            cloth_triangles: self.made.cloth_triangles,
            body_names: self.body_names.clone(),
            untangled,
        }))
    }

    /// Untangles; the caller checks the result.
    pub(super) fn untangle(&mut self, spacing: f64, tell: &mut (dyn FnMut(UntanglingProgress) + Send)) -> Untangled {
        let begin = Clock::now();
        let forces = std::mem::take(&mut self.made.forces);
        let loads = self.made.solve.take_loads();
        self.made.of_free_bodies.rest = true;
        let velocities = self.state.velocities.clone();
        let start = self.state.positions.clone();
        let times = self.effects.clone();
        let memories = self.memory_numbers();
        let crossings = self.crossings().len();
        let threads = std::mem::take(&mut self.threads);
        let (mut steps, mut end) = threads.run(|| self.pull_apart(REACH * spacing, tell));
        self.threads = threads;
        if end != UntanglingEnd::Free {
            // It starts over, since what has been tried may have made it worse.
            let pulled = std::mem::replace(&mut self.state.positions, start.clone());
            self.look_again();
            if self.grow_bodies(spacing) {
                let threads = std::mem::take(&mut self.threads);
                let mut tell = |now: UntanglingProgress| {
                    tell(UntanglingProgress {
                        steps: steps + now.steps,
                        ..now
                    });
                };
                let (more, then) = threads.run(|| self.pull_apart(REACH * spacing, &mut tell));
                self.threads = threads;
                (steps, end) = (steps + more, then);
            } else {
                self.state.positions = pulled;
                self.look_again();
            }
        }
        (self.made.forces, self.effects) = (forces, times);
        self.made.solve.give_loads(loads);
        self.made.of_free_bodies.rest = false;
        self.state.velocities = velocities;
        // No joint breaks, and no fold stays, before the first step.
        self.recall(&memories);
        let moved = start.iter().zip(&self.state.positions);
        Untangled {
            crossings,
            left: self.crossings().len(),
            steps,
            end,
            stretch: self.edge_stretch(),
            farthest: moved.map(|(start, end)| start.distance(*end)).fold(0.0, f64::max),
            seconds: begin.elapsed().as_secs_f64(),
        }
    }

    /// Makes the steps of untangling. Returns their number and the reason why they ended.
    fn pull_apart(&mut self, reach: f64, tell: &mut (dyn FnMut(UntanglingProgress) + Send)) -> (u32, UntanglingEnd) {
        let mut directions = vec![DVec3::ZERO; self.state.positions.len()];
        let Some(contact) = &self.made.contact else {
            return (0, UntanglingEnd::Free);
        };
        let mut untangler = contact.untangler(&self.state.positions);
        let (mut pulled, mut relaxed) = (0, 0);
        let (mut fewest, mut at_fewest) = (usize::MAX, 0);
        let (mut best, mut at_best) = (f64::INFINITY, 0);
        let end = loop {
            let crossings = self.crossings().len();
            tell(UntanglingProgress {
                steps: pulled + relaxed,
                crossings,
            });
            let is_tangled = crossings > 0;
            if is_tangled {
                if crossings < fewest {
                    (fewest, at_fewest) = (crossings, pulled);
                }
                if pulled == MOST {
                    break UntanglingEnd::StepLimit;
                }
                if pulled - at_fewest >= HOPELESS {
                    break UntanglingEnd::NoProgress;
                }
                pulled += 1;
            } else {
                let longest = self.edge_stretch().largest;
                if longest < best * (1.0 - RELAXING) {
                    (best, at_best) = (longest, relaxed);
                }
                let is_relaxed = relaxed - at_best >= PATIENCE && self.is_apart();
                if is_relaxed || relaxed == MOST_RELAXING {
                    break UntanglingEnd::Free;
                }
                relaxed += 1;
            }
            let Some(contact) = &mut self.made.contact else {
                break UntanglingEnd::Free;
            };
            contact.set_pushes(!is_tangled);
            untangler.find_directions(contact, &self.state.positions, &mut directions);
            if !self.lead(&directions, reach) {
                break if is_tangled {
                    UntanglingEnd::Stuck
                } else {
                    UntanglingEnd::Free
                };
            }
        };
        (pulled + relaxed, end)
    }

    /// Makes a step that moves vertices along their ways, by at most `reach`, or by less if that is not possible. Returns false
    /// if no step is possible.
    fn lead(&mut self, directions: &[DVec3], mut reach: f64) -> bool {
        let h = self.time_step;
        for _ in 0..TRIES {
            for (velocity, direction) in self.state.velocities.iter_mut().zip(directions) {
                // The move is small where the pull is small, and the full reach where it is large.
                *velocity = *direction * (reach / (1.0 + direction.length_squared()).sqrt() / h);
            }
            if self.attempt(h, 0.0, Overstretched::Accepted).is_ok() {
                if let Some(contact) = &mut self.made.contact {
                    contact.take_back(&self.state.positions);
                }
                return true;
            }
            reach *= 0.5;
        }
        false
    }
}
