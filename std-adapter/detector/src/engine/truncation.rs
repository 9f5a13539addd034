//! Truncates a step: each vertex goes as far as its own neighbourhood allows, instead of all stopping at the earliest contact.
//!
//! ```text
//! wanted step   ─▶ contacts ─ none ─▶ it is free
//!                     │
//!                     ▼
//! each contact     planes between its two sets: shares of displacements (core's truncation); the second time, its vertices rest
//! vertices         the least of their shares
//! their pairs      from the boxes that whole displacements sweep: contacts again ─▶ repeat until there are none
//! ```
//!
//! **The result is free.** A pair that swept boxes exclude keeps its distance wherever each vertex ends in the box of its path.
//! Every other pair passes the certified tests for the final ends of its vertices. It does so in the last round, or in an earlier
//! one after which none of its vertices changed.
//!
//! **It ends.** Every contact found in a round is a pair that moves. The first time, its planes lower the shares of its vertices,
//! or its vertices rest at once; the second time they rest. A resting pair is not tested again. So each pair takes at most two
//! rounds.
//!
//! **Pairs in contact at the start** stay in contact for every share. Their vertices rest, so that they come no nearer, and they
//! are counted.

use super::mesh_engine::MeshEngine;
use super::question::Question;
use crate::mesh::Topology;
use crate::parallel::Workers;
use crate::step::{Contact, Step, StepError, Truncation};
use selvedge_core::Motion;
use selvedge_core::PairKind;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::closest::ClosestPoints;
use selvedge_core::separation::gap::GapError;
use selvedge_core::separation::largest_coordinate;
use selvedge_core::separation::truncation::most_shares;
use std::collections::BTreeSet;

/// A step that is being truncated.
struct Held<'a> {
    start: &'a [DVec3],
    wanted: &'a [DVec3],
    /// The distance that pairs keep, with a margin so that the elementary test confirms it.
    distance: f64,
    error: GapError<f64>,
    /// The share of its displacement that each vertex goes.
    shares: Vec<f64>,
    /// True for vertices whose share changed in this round.
    changed: Vec<bool>,
    /// Pairs whose planes have been used.
    parted: BTreeSet<(PairKind, [u32; 2])>,
}

impl Held<'_> {
    /// Holds back the vertices of a pair that comes into contact on the way to its present ends.
    fn hold(&mut self, contact: &Contact<f64>, vertices: [u32; 4], end: &[DVec3]) {
        let is_new = self.parted.insert((contact.kind, contact.pair));
        let shares = if is_new { self.planes(contact, vertices, end) } else { None };
        let lowers = |shares: &[f64; 4]| {
            vertices
                .iter()
                .zip(shares)
                .any(|(&v, &share)| share < self.shares[v as usize])
        };
        let shares = shares.filter(lowers).unwrap_or([0.0; 4]);
        for (vertex, share) in vertices.into_iter().zip(shares) {
            let vertex = vertex as usize;
            if share < self.shares[vertex] {
                self.shares[vertex] = share;
                self.changed[vertex] = true;
            }
        }
    }

    /// Returns shares by planes through the pair's closest points, for the plane with the largest smallest share. The points are
    /// those at the start, at its contact or at the wanted ends.
    fn planes(&self, contact: &Contact<f64>, vertices: [u32; 4], end: &[DVec3]) -> Option<[f64; 4]> {
        let at = |positions: &[DVec3]| vertices.map(|vertex| positions[vertex as usize]);
        let (start, wanted, end) = (at(self.start), at(self.wanted), at(end));
        let mut met = start;
        for corner in 0..4 {
            met[corner] = Motion::new(start[corner], end[corner]).at(contact.time);
        }
        let directions = [start, met, wanted].map(|points| ClosestPoints::from_points(contact.kind, points).direction);
        let most = most_shares(contact.kind, [start, wanted], directions, self.distance, self.error);
        most.map(|(_, shares)| shares)
    }
}

impl Held<'_> {
    /// Replaces `open` by the candidates that move and have a vertex whose share changed in this round.
    fn find_open(&self, topology: &Topology, end: &[DVec3], candidates: &[Vec<[u32; 2]>; 2], open: &mut [Vec<[u32; 2]>; 2]) {
        for kind in PairKind::ALL {
            let open = &mut open[kind as usize];
            open.clear();
            open.extend(candidates[kind as usize].iter().filter(|&&pair| {
                let vertices = topology.vertices_of(kind, pair).map(|vertex| vertex as usize);
                let moves = vertices.iter().any(|&vertex| end[vertex] != self.start[vertex]);
                moves && vertices.iter().any(|&vertex| self.changed[vertex])
            }));
        }
    }
}

impl MeshEngine {
    /// Replaces `end` by the ends of a step that is free of contact, except for pairs that are in contact at the start. `round`
    /// rounds a position to the caller's format, between the same two numbers.
    pub(crate) fn truncate(
        &mut self,
        threads: &Workers,
        [start, wanted]: [&[DVec3]; 2],
        question: &Question,
        round: fn(DVec3) -> DVec3,
        end: &mut Vec<DVec3>,
    ) -> Result<Truncation, StepError> {
        end.clear();
        end.extend_from_slice(wanted);
        let mut contacts = Vec::new();
        self.run(threads, &Step::of_finite(start, end), question);
        self.result()?;
        self.collect_contacts(&mut contacts);
        let mut truncation = Truncation {
            rounds: 1,
            ..Truncation::default()
        };
        if contacts.is_empty() {
            return Ok(truncation);
        }

        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        let separation = question.limits.separation;
        let whole = Step::of_finite(start, wanted);
        self.candidates(threads, &whole, separation, true, [&mut vertex_face, &mut edge_edge]);
        self.result()?;
        let candidates = [vertex_face, edge_edge];
        let largest = largest_coordinate(start).max(largest_coordinate(wanted));
        let mut held = Held {
            start,
            wanted,
            distance: separation + 2.0 * question.limits.tolerance,
            error: GapError::from_largest_coordinate(largest),
            shares: vec![1.0; start.len()],
            changed: vec![false; start.len()],
            parted: BTreeSet::new(),
        };
        let mut open = [Vec::new(), Vec::new()];
        while !contacts.is_empty() {
            held.changed.fill(false);
            for contact in &contacts {
                let vertices = self.topology().vertices_of(contact.kind, contact.pair);
                held.hold(contact, vertices, end);
            }
            for vertex in (0..end.len()).filter(|&vertex| held.changed[vertex]) {
                end[vertex] = round(Motion::new(start[vertex], wanted[vertex]).at(held.shares[vertex]));
            }
            held.find_open(self.topology(), end, &candidates, &mut open);
            self.contacts_among(threads, [start, end], question, &open, &mut contacts)?;
            truncation.rounds += 1;
        }

        // Pairs in contact at the start were found in the first round.
        open.iter_mut().for_each(Vec::clear);
        for &(kind, pair) in &held.parted {
            let vertices = self.topology().vertices_of(kind, pair).map(|vertex| vertex as usize);
            if vertices.iter().all(|&vertex| end[vertex] == start[vertex]) {
                open[kind as usize].push(pair);
            }
        }
        self.contacts_among(threads, [start, end], question, &open, &mut contacts)?;
        truncation.in_contact = contacts.len();
        truncation.held_back = held.shares.iter().filter(|&&share| share < 1.0).count();
        Ok(truncation)
    }

    /// Replaces `contacts` by those of listed pairs.
    fn contacts_among(
        &mut self,
        threads: &Workers,
        [start, end]: [&[DVec3]; 2],
        question: &Question,
        [vertex_face, edge_edge]: &[Vec<[u32; 2]>; 2],
        contacts: &mut Vec<Contact<f64>>,
    ) -> Result<(), StepError> {
        let step = Step::of_finite(start, end);
        self.run_on(threads, &step, question, [vertex_face, edge_edge])?;
        self.collect_contacts(contacts);
        self.result()
    }
}
