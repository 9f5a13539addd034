//! Truncation: if a relaxation leaves pairs that are not free, each vertex goes as far on its way as it may.
//!
//! **The base** is a motion for which every pair is free. At first it is the relaxed one. The cloth of pairs that are not free is
//! carried together ([`impact_zones`](super::impact_zones)), and then that of further pairs which are not free. A zone that is
//! carried rigidly is free ([`pass`](super::pass)). A zone with two carriers can follow neither: it stays where it was when the
//! step began. There only pairs with parts that the carriers move are not free; those few are relaxed, and the pairs that they
//! push. A relaxation from the *wanted* place would not end for jammed cloth: thousands of pairs pull it in all directions.
//! (`violent.toml` with a thousand times its stiffness, 200 steps from a state with up to 12,000 pairs of 800 triangles that are
//! not free in a step. From the wanted place steps were cut into up to 64 parts, and a step took more than 2.5 s. From the start
//! there were 21 cuts, and a step takes 0.5 s.)
//!
//! **Truncation.** From the base each vertex moves towards its place after the relaxation, by a share that is the least in any of
//! its pairs: [core's lemma](selvedge_core::separation::truncation). Bodies and pins have the share 1, and reach their keyframes
//! exactly. A free body has the least share of its vertices, of its way and of its turn. No promise depends on the shares. Every
//! pair with a vertex that moves is certified at last, and the vertices of those that are not free return to the base.
//!
//! **It ends.** Each round of [`find_base`](ContactSolver::find_base) changes the zones, or is the last one, with a bounded
//! number of rounds of relaxation ([`EFFORT`]). The zones can change no more than four times for each vertex. There are
//! [`PASSES`] passes of shares. After them each round returns at least one vertex to the base, where it stays, or is the last
//! one. With all vertices at the base all pairs are free.

use super::impact_zones::TORN;
use super::pass::Effort;
use super::report::Blocker;
use super::solver::ContactSolver;
use crate::model::length::length;
use crate::model::rigid::RigidMotion;
use crate::model::step::{Carrier, FREE, TimeStep};
use selvedge_core::Motion;
use selvedge_core::glam::DVec3;

/// The effort of a base's relaxation. The active set grows from a few pairs outward, layer by layer, so it may grow often. In the
/// steps that were looked at, it grew at most 14 times if it ended. With few pairs rounds are cheap; 60 were too few for some
/// hundred pairs. If rounds do not end, the relaxation would move all that is near, and a shorter step finds its base sooner.
const EFFORT: Effort = Effort {
    closures: 40,
    rounds: 1000,
    gives_up: true,
};
/// The number of passes of shares, each of the rest of the way: the second pass has other directions, as vertices have moved.
const PASSES: usize = 2;
/// A vertex that loses more of its motion than this counts as held back.
const LOSS: f64 = 0.1;

impl ContactSolver {
    /// Moves `end`, which equals `wanted` at first, to a base: a motion for which every pair is free. Its zones have all vertices
    /// at which the two differ.
    pub(super) fn find_base(
        &mut self,
        mut open: Vec<usize>,
        step: &TimeStep<'_>,
        wanted: (&[DVec3], &[RigidMotion]),
        (end, bodies): (&mut [DVec3], &mut [RigidMotion]),
    ) -> Result<(), Blocker> {
        let carriers = self.carriers_of_the_step(step, bodies);
        self.zones.reset(end.len(), bodies);
        while !open.is_empty() {
            self.counts.zone_rounds += 1;
            let mut has_changed = false;
            for &index in &open {
                has_changed |= self.zones.join(&self.candidates.list[index], &carriers);
            }
            if !has_changed {
                // No zone has changed: these pairs are between two carriers.
                open = self.relax(open, EFFORT, step, end);
                if !open.is_empty() {
                    return Err(self.blocker(&open, step));
                }
                break;
            }
            self.zones.carry(step, wanted, (end, bodies), &mut self.moved);
            open = self.check_moved(&open, step, end);
        }
        Ok(())
    }

    /// Moves `end`, which is a base, as far towards `wanted` as each vertex may go.
    pub(super) fn truncate(
        &mut self,
        step: &TimeStep<'_>,
        (wanted, wanted_bodies): (&[DVec3], &[RigidMotion]),
        (end, bodies): (&mut [DVec3], &mut [RigidMotion]),
    ) -> Result<(), Blocker> {
        let start = step.start;
        let (base, base_bodies) = (end.to_vec(), bodies.to_vec());
        let differs: Vec<bool> = base.iter().zip(wanted).map(|(base, wanted)| base != wanted).collect();
        let (mut shares, mut places) = (Vec::new(), Vec::new());
        self.candidates.find_places(&differs, &mut places);
        for _ in 0..PASSES {
            shares.clear();
            shares.resize(end.len(), 1.0_f64);
            for &index in &places {
                let pair = &self.candidates.list[index];
                if self.separation(pair).is_none() {
                    continue;
                }
                let kept = self.kept(pair, start);
                let pair = &mut self.candidates.list[index];
                let own = pair.shares(start, [end, wanted], kept, self.error);
                for (vertex, own) in pair.vertices.into_iter().zip(own) {
                    let share = &mut shares[vertex as usize];
                    // A NaN share counts, and keeps the vertex in place.
                    *share = if *share < own { *share } else { own };
                }
            }
            for vertex in (0..end.len()).filter(|&vertex| differs[vertex] && self.carriers[vertex] == FREE) {
                end[vertex] = Motion::new(end[vertex], wanted[vertex]).at(shares[vertex]);
            }
            for (body, wanted_body) in bodies.iter_mut().zip(wanted_bodies) {
                let share = body.members().map(|vertex| shares[vertex]).fold(1.0, f64::min);
                if share >= 1.0 {
                    *body = wanted_body.clone();
                    body.members().for_each(|vertex| end[vertex] = wanted[vertex]);
                } else if body.members().all(|vertex| shares[vertex] > 0.0) {
                    // NaN keeps the body in place.
                    *body = body.between(wanted_body, share);
                    body.put(end);
                }
            }
        }
        self.moved.copy_from_slice(&differs);
        let mut open = self.check_moved(&[], step, end);
        while !open.is_empty() {
            let mut has_changed = false;
            for &index in &open {
                for vertex in self.candidates.list[index].vertices.map(|vertex| vertex as usize) {
                    if end[vertex] != base[vertex] {
                        end[vertex] = base[vertex];
                        self.moved[vertex] = true;
                        has_changed = true;
                    }
                }
            }
            for (body, base_body) in bodies.iter_mut().zip(&base_bodies) {
                // Some of its vertices are back.
                let is_back = !body.leads_where(base_body) && body.members().any(|vertex| self.moved[vertex]);
                if is_back {
                    *body = base_body.clone();
                    for vertex in body.members() {
                        end[vertex] = base[vertex];
                        self.moved[vertex] = true;
                    }
                }
            }
            if !has_changed {
                return Err(self.blocker(&open, step));
            }
            open = self.check_moved(&open, step, end);
        }
        for vertex in 0..end.len() {
            let lost = length(wanted[vertex] - end[vertex]);
            self.counts.held += u64::from(lost > LOSS * length(wanted[vertex] - start[vertex]));
        }
        Ok(())
    }

    /// Each vertex's carrier. Those that rest in this step count as one: a zone may touch any number of them. Free bodies have
    /// none.
    fn carriers_of_the_step(&self, step: &TimeStep<'_>, bodies: &[RigidMotion]) -> Vec<Carrier> {
        let rests = |carrier: usize| step.poses[carrier][0] == step.poses[carrier][1];
        let first_at_rest = (0..step.poses.len()).find(|&carrier| rests(carrier));
        let of_step = |&carrier: &Carrier| match first_at_rest {
            _ if carrier == FREE => FREE,
            Some(first) if rests(carrier as usize) => first as Carrier,
            // A body that changes its shape carries no zone.
            _ if !step.poses[carrier as usize][1].is_rigid() => TORN,
            _ => carrier,
        };
        let mut carriers: Vec<Carrier> = self.carriers.iter().map(of_step).collect();
        let members = bodies.iter().flat_map(RigidMotion::members);
        members.for_each(|vertex| carriers[vertex] = FREE);
        carriers
    }
}
