//! Tears between two steps, at edges that are loaded above their strength ([`tearing`](crate::model::tearing)).
//!
//! ```text
//! torn edges ─▶ cloths with copies of vertices ─▶ all data that depend on meshes, again ─▶ opened a little ─▶ is it free? ─▶ taken
//!                       ▲                                                                                        └▶ less, then fewer
//!                       └────────────────────────────────────────────────────────────────────────────────────────────┘
//! ```
//!
//! New data are derived from the original scene with the new meshes of its cloths; the state of the simulation is carried over.

use super::assembly::Assembly;
use super::checkpoint::{CHECKPOINT_STEPS, CheckpointError, TornCloth};
use super::simulation::Simulation;
use super::tearing::{Copies, Meshes, Numbering, Retorn, Tearing};
use crate::model::step::{FREE, Memory};
use crate::model::tearing::{Tear, TornEdge, open};
use crate::world::Cloth;
use selvedge::clock::Clock;
use selvedge_core::glam::DVec3;
use std::collections::BTreeMap;

/// The share of its shortest edge by which the copies of a vertex move apart; later values are for when there is no room.
const OPENINGS: [f64; 3] = [0.05, 0.01, 0.001];

/// Tears that had no room to open are tried again after each step whose number is a multiple of this. A try makes all data again
/// that depend on meshes, which takes as long as several steps.
const TRIED_AGAIN: u64 = 20;

// So no tear waits at a checkpoint, and checkpoints need no record of waiting tears.
const _: () = assert!(CHECKPOINT_STEPS.is_multiple_of(TRIED_AGAIN));

impl Simulation {
    /// The edges that have torn so far, in this order; empty without [`Tearing`](crate::effects::Tearing).
    #[must_use]
    pub fn torn_edges(&self) -> &[TornEdge] {
        self.tearing.as_ref().map_or(&[], |tearing| &tearing.torn)
    }

    /// The vertices of a torn cloth that have been copied, in the order of the copies, which are the last of [its
    /// vertices](Self::vertices_of_cloth). The original of a copy comes before it, and may be a copy itself. Empty if the cloth
    /// has not torn, or there is no such cloth.
    #[must_use]
    pub fn copied_vertices(&self, cloth: usize) -> &[u32] {
        let tearing = self.tearing.as_ref();
        let torn = tearing.and_then(|tearing| tearing.scene.cloths.get(cloth));
        torn.map_or(&[], Cloth::copy_sources)
    }

    /// Tears edges that are loaded above their strength, unless pairs are exempt from certificates.
    pub(super) fn tear(&mut self) {
        let Some(mut tearing) = self.tearing.take() else { return };
        if self.is_apart() {
            let begin = Clock::now();
            self.tear_what_is_loaded(&mut tearing);
            if let Some(tearable) = self.made.tearable.first() {
                self.effects[tearable.effect].seconds += begin.elapsed().as_secs_f64();
            }
        }
        if self.state.step.is_multiple_of(TRIED_AGAIN) {
            tearing.waiting.clear();
        }
        self.tearing = Some(tearing);
    }

    fn tear_what_is_loaded(&mut self, tearing: &mut Tearing) {
        let mut tears = Vec::new();
        for tearable in &mut self.made.tearable {
            let cloth = tearable.cloth;
            let own = self.made.vertices_of_cloths[cloth].clone();
            let carriers = &self.made.carriers[own.clone()];
            let may_split = |vertex: u32| carriers[vertex as usize] == FREE && !tearing.waiting.contains(&(cloth, vertex));
            tears.extend(tearable.tears(&self.state.positions[own], may_split));
        }
        while !tears.is_empty() {
            let Some((meshes, copies)) = tearing.cut(&tears, &self.numbering()) else {
                return tearing.put_off(&tears);
            };
            let Meshes { cloths, from } = meshes;
            let whole = tearing.scene.cloths.clone();
            let Some(mut made) = tearing.assemble(cloths) else {
                return tearing.put_off(&tears);
            };
            match self.opened(&mut made, &tears, &copies, &from) {
                Ok(positions) => {
                    self.note(&mut tearing.torn, &tears, &tearing.scene.cloths);
                    self.adopt(made, &from, tearing.wind);
                    self.state.positions = positions;
                    if let Some(contact) = &mut self.made.contact {
                        self.state.begin_anew(contact, self.time_step);
                    }
                    return;
                }
                Err(in_the_way) => {
                    tearing.scene.cloths = whole;
                    let has_room = |tear: &Tear| {
                        let first = self.made.vertices_of_cloths[tear.cloth].start as u32;
                        !tear.around.iter().any(|vertex| in_the_way.contains(&(first + vertex)))
                    };
                    let (left, put_off): (Vec<Tear>, Vec<Tear>) = tears.into_iter().partition(has_room);
                    if put_off.is_empty() {
                        return tearing.put_off(&left);
                    }
                    tearing.put_off(&put_off);
                    tears = left;
                }
            }
        }
    }

    /// The positions of all vertices when the tears have opened; if they cannot open, the vertices, with their new numbers, that
    /// are in the way.
    fn opened(&self, made: &mut Assembly, tears: &[Tear], copies: &Copies, from: &[u32]) -> Result<Vec<DVec3>, Vec<u32>> {
        let closed = gathered(&self.state.positions, from);
        let mut in_the_way = Vec::new();
        for share in OPENINGS {
            let mut positions = closed.clone();
            for tear in tears {
                let first = made.vertices_of_cloths[tear.cloth].start as u32;
                let before = self.triangles_before(tear.cloth);
                let copy = |vertex, place| first + copies.get(&(tear.cloth, vertex, place)).copied().unwrap_or(vertex);
                let triangle = |index: u32| made.triangles[before + index as usize];
                open(tear, share, &made.inverse_masses, copy, triangle, &mut positions);
            }
            in_the_way = match &mut made.contact {
                Some(contact) => contact.in_the_way([&closed, &positions], from, self.time_step),
                None => Vec::new(),
            };
            if in_the_way.is_empty() {
                return Ok(positions);
            }
        }
        Err(in_the_way.into_iter().map(|vertex| from[vertex as usize]).collect())
    }

    /// The number of triangles of the cloths before this one.
    fn triangles_before(&self, cloth: usize) -> usize {
        let first = self.made.vertices_of_cloths[cloth].start as u32;
        self.made.triangles[..self.made.cloth_triangles].partition_point(|triangle| triangle[0] < first)
    }

    fn note(&self, torn: &mut Vec<TornEdge>, tears: &[Tear], cloths: &[Cloth]) {
        let time = self.time();
        for tear in tears {
            torn.extend(tear.edges.iter().map(|&(edge, load)| TornEdge {
                cloth: tear.cloth,
                vertices: edge.map(|end| cloths[tear.cloth].as_made(end)),
                time,
                load,
            }));
        }
    }

    fn numbering(&self) -> Numbering {
        let firsts = self.made.vertices_of_cloths.iter().map(|vertices| vertices.start as u32);
        Numbering {
            first_of_cloths: firsts.collect(),
            bodies: self.made.cloth_vertices as u32..self.state.positions.len() as u32,
        }
    }

    /// Continues with the data of other meshes; `from` gives the old vertex of each vertex, or its original. New vertices start
    /// at the place of their originals.
    fn adopt(&mut self, made: Assembly, from: &[u32], wind: Option<DVec3>) {
        let before = std::mem::replace(&mut self.made, made);
        let memories = self.made.memories().zip(before.memories());
        let numbers: Vec<f64> = memories.flat_map(|(new, old)| carried_over(new, old)).collect();
        self.recall(&numbers);
        for (new, old) in self.made.motions.iter_mut().zip(before.motions) {
            new.take_over(old);
        }
        if let (Some(new), Some(old)) = (&mut self.made.contact, &before.contact) {
            new.take_over(old, from);
        }
        self.added_forces.renumber(from);
        self.carried = gathered(&self.carried, from);
        self.state.positions = gathered(&self.state.positions, from);
        self.state.velocities = gathered(&self.state.velocities, from);
        if let Some(wind) = wind {
            for term in &mut self.made.solve.terms {
                term.action.set_wind(wind);
            }
        }
    }

    /// The tears for a checkpoint; `None` if nothing tears.
    pub(super) fn torn_cloths(&self) -> Option<(Vec<TornCloth>, Vec<TornEdge>)> {
        let tearing = self.tearing.as_ref()?;
        let of = |cloth: &Cloth| TornCloth {
            copied: cloth.copy_sources().to_vec(),
            triangles: cloth.mesh.triangles.clone(),
        };
        Some((tearing.scene.cloths.iter().map(of).collect(), tearing.torn.clone()))
    }

    /// Makes the data of a checkpoint's cloths.
    ///
    /// # Errors
    /// Returns an error if these are not the scene's cloths.
    pub(super) fn torn_as(&mut self, torn: Vec<TornCloth>) -> Result<Retorn, CheckpointError> {
        let numbering = self.numbering();
        let tearing = self.tearing.as_mut().ok_or(CheckpointError::Damaged)?;
        let whole = tearing.scene.cloths.clone();
        if torn.len() != whole.len() {
            return Err(CheckpointError::Damaged);
        }
        let mut cloths = whole.clone();
        let mut from = Vec::new();
        for ((cloth, torn), first) in cloths.iter_mut().zip(torn).zip(numbering.first_of_cloths) {
            if !torn.is_torn_from(cloth) {
                return Err(CheckpointError::Damaged);
            }
            cloth
                .tear(torn.copied, torn.triangles)
                .map_err(|_| CheckpointError::Damaged)?;
            let all = 0..cloth.mesh.positions.len() as u32;
            from.extend(all.map(|vertex| first + cloth.as_made(vertex)));
        }
        from.extend(numbering.bodies);
        let made = tearing.assemble(cloths).ok_or(CheckpointError::Damaged)?;
        let cloths = std::mem::replace(&mut tearing.scene.cloths, whole);
        Ok(Retorn { made, cloths, from })
    }

    /// Continues with the data of a checkpoint's cloths.
    pub(super) fn adopt_torn(&mut self, Retorn { made, cloths, from }: Retorn, torn: Vec<TornEdge>) {
        if let Some(tearing) = &mut self.tearing {
            (tearing.scene.cloths, tearing.torn) = (cloths, torn);
            tearing.waiting.clear();
            let wind = tearing.wind;
            self.adopt(made, &from, wind);
        }
    }
}

fn gathered<T: Copy>(all: &[T], from: &[u32]) -> Vec<T> {
    from.iter().map(|&vertex| all[vertex as usize]).collect()
}

/// The numbers of the memory `new`: those of `old` with the same keys, and its own for other keys.
fn carried_over(new: &dyn Memory, old: &dyn Memory) -> Vec<f64> {
    let (keys, mut known, before) = (new.keys(), new.numbers(), old.numbers());
    if keys.is_empty() {
        return if before.len() == known.len() { before } else { known };
    }
    // Collecting would add the code of a sort to the program.
    let mut known_before: BTreeMap<[u32; 4], f64> = BTreeMap::new();
    known_before.extend(old.keys().into_iter().zip(before));
    for (key, number) in keys.iter().zip(&mut known) {
        *number = known_before.get(key).copied().unwrap_or(*number);
    }
    known
}
