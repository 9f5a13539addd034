//! Impact zones: cloth that moves together so that a step can be accepted (Provot 1997, who moves each as a rigid body; Harmon et al.
//! 2008, who let what is inside slide).
//!
//! The vertices of a zone follow a common motion D, and only their motion relative to it is scaled by s: x → x + D + s·(y − x − D).
//! Two vertices of one zone keep the difference of their original motions on [0, s], plus a common translation; so a pair inside a
//! zone is free exactly if s is before its time of impact on the path x → y − D. A zone's D is its mean motion, which keeps its
//! momentum, or that of the body or pin (its carrier) that it touches, which keeps it on the body. With s = 0 a zone is carried
//! rigidly.

use super::candidate::{Candidate, time_of_impact_of};
use crate::step::{Carrier, FREE};
use selvedge_core::glam::DVec3;

/// How much of a time of impact a zone takes up, level by level; at the last level nothing.
const SHARES: [f64; 4] = [0.9, 0.45, 0.2, 0.0];
const LAST_LEVEL: usize = SHARES.len() - 1;

/// The step cannot be made: two carriers pull at one zone, or a zone that is carried rigidly is still not free.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut;

#[derive(Clone, Debug)]
struct ImpactZone {
    members: Vec<u32>,
    scale: f64,
    level: usize,
    carrier: Carrier,
    /// Its mean motion, if it has no carrier.
    mean: DVec3,
    changed: bool,
    raised: bool,
}

/// The zones of one step; at first each vertex is its own.
#[derive(Debug, Default)]
pub(super) struct ImpactZones {
    /// Of each vertex; `u32::MAX` if it is still alone.
    zone_of: Vec<u32>,
    zones: Vec<ImpactZone>,
}

/// What zones are made from: the motion that was wanted.
#[derive(Clone, Copy)]
pub(super) struct Motions<'a> {
    pub(super) start: &'a [DVec3],
    pub(super) wanted: &'a [DVec3],
    pub(super) inverse_masses: &'a [f64],
    /// Of each vertex, with carriers that do not move in this step taken for one.
    pub(super) carriers: &'a [Carrier],
    /// Where a carrier takes a point in this step.
    pub(super) carry: &'a dyn Fn(Carrier, DVec3) -> DVec3,
}

impl ImpactZones {
    pub(super) fn reset(&mut self, vertices: usize) {
        self.zone_of.clear();
        self.zone_of.resize(vertices, u32::MAX);
        self.zones.clear();
    }

    /// Vertices that do not get all of their motion.
    pub(super) fn held(&self) -> usize {
        let held = self.zones.iter().filter(|zone| zone.scale < 1.0);
        held.map(|zone| zone.members.len()).sum()
    }

    fn zone(&mut self, vertex: u32) -> usize {
        let zone = &mut self.zone_of[vertex as usize];
        if *zone == u32::MAX {
            *zone = self.zones.len() as u32;
            self.zones.push(ImpactZone {
                members: vec![vertex],
                scale: 1.0,
                level: 0,
                carrier: FREE,
                mean: DVec3::ZERO,
                changed: false,
                raised: false,
            });
        }
        *zone as usize
    }

    /// Deals with the pairs that are not free, in order: merges their zones, or slows down the one that a pair is inside of.
    /// Writes new positions of the vertices concerned to `end`.
    pub(super) fn resolve(
        &mut self,
        pairs: &[&Candidate],
        separation: impl Fn(&Candidate) -> f64,
        motions: Motions<'_>,
        end: &mut [DVec3],
        scratch: &mut Vec<DVec3>,
    ) -> Result<(), Cut> {
        let inside: Vec<bool> = pairs.iter().map(|pair| self.is_inside(pair, motions.carriers)).collect();
        for (pair, _) in pairs.iter().zip(&inside).filter(|(_, inside)| !**inside) {
            self.merge(pair, motions.carriers)?;
        }
        for (pair, _) in pairs.iter().zip(&inside).filter(|(_, inside)| **inside) {
            let zone = self.zone_of_pair(pair, motions.carriers).ok_or(Cut)?;
            let zone = &mut self.zones[zone];
            zone.changed = true;
            if !zone.raised {
                if zone.level == LAST_LEVEL {
                    return Err(Cut);
                }
                zone.raised = true;
                zone.level += 1;
            }
        }
        self.find_means(motions);
        for pair in pairs {
            let Some(index) = self.zone_of_pair(pair, motions.carriers) else {
                return Err(Cut);
            };
            if self.zones[index].level == LAST_LEVEL {
                self.zones[index].scale = 0.0;
                continue;
            }
            // The relative path. `scratch` is only right where this pair's vertices are.
            scratch.resize(end.len(), DVec3::ZERO);
            for vertex in pair.vertices.map(|v| v as usize) {
                let common = self.common(vertex, index, motions);
                scratch[vertex] = motions.wanted[vertex] - common;
            }
            if let Some(time) = time_of_impact_of(pair, [motions.start, scratch], separation(pair)) {
                let zone = &mut self.zones[index];
                zone.scale = zone.scale.min(SHARES[zone.level] * time);
            }
        }
        for index in 0..self.zones.len() {
            if !std::mem::take(&mut self.zones[index].changed) {
                continue;
            }
            self.zones[index].raised = false;
            let scale = self.zones[index].scale;
            for &vertex in &self.zones[index].members {
                let vertex = vertex as usize;
                let start = motions.start[vertex];
                let common = self.common(vertex, index, motions);
                end[vertex] = (start + common) + (motions.wanted[vertex] - start - common) * scale;
            }
        }
        Ok(())
    }

    /// D at a vertex, as zone `index` has it.
    fn common(&self, vertex: usize, index: usize, motions: Motions<'_>) -> DVec3 {
        let zone = &self.zones[index];
        match zone.carrier {
            FREE => zone.mean,
            carrier => (motions.carry)(carrier, motions.start[vertex]) - motions.start[vertex],
        }
    }

    /// Whether the pair's cloth is in one zone already, and that has the carrier of whatever else the pair touches.
    fn is_inside(&mut self, pair: &Candidate, carriers: &[Carrier]) -> bool {
        let mut one = None;
        for &vertex in &pair.vertices {
            if carriers[vertex as usize] == FREE {
                let zone = self.zone(vertex);
                if *one.get_or_insert(zone) != zone {
                    return false;
                }
            }
        }
        let Some(zone) = one else { return true };
        let others = pair.vertices.iter().map(|&v| carriers[v as usize]);
        let carrier = self.zones[zone].carrier;
        others.filter(|&other| other != FREE).all(|other| other == carrier)
    }

    /// The zone of the pair's cloth; `None` if all of the pair is kinematic.
    fn zone_of_pair(&self, pair: &Candidate, carriers: &[Carrier]) -> Option<usize> {
        let mut free = pair.vertices.iter().filter(|&&v| carriers[v as usize] == FREE);
        free.next().map(|&v| self.zone_of[v as usize] as usize)
    }

    fn merge(&mut self, pair: &Candidate, carriers: &[Carrier]) -> Result<(), Cut> {
        let mut into = None;
        for &vertex in pair.vertices.iter().filter(|&&v| carriers[v as usize] == FREE) {
            let zone = self.zone(vertex);
            into = Some(match into {
                None => zone,
                Some(other) => self.union(other, zone)?,
            });
        }
        let Some(zone) = into else { return Err(Cut) };
        for carrier in pair.vertices.map(|v| carriers[v as usize]) {
            let own = &mut self.zones[zone].carrier;
            *own = common_carrier(*own, carrier)?;
        }
        self.zones[zone].changed = true;
        Ok(())
    }

    fn union(&mut self, a: usize, b: usize) -> Result<usize, Cut> {
        if a == b {
            return Ok(a);
        }
        let carrier = common_carrier(self.zones[a].carrier, self.zones[b].carrier)?;
        let (large, small) = if self.zones[a].members.len() >= self.zones[b].members.len() {
            (a, b)
        } else {
            (b, a)
        };
        let moved = std::mem::take(&mut self.zones[small].members);
        for &vertex in &moved {
            self.zone_of[vertex as usize] = large as u32;
        }
        let (scale, level) = (self.zones[small].scale, self.zones[small].level);
        self.zones[small].changed = false;
        let zone = &mut self.zones[large];
        zone.members.extend(moved);
        zone.scale = zone.scale.min(scale);
        zone.level = zone.level.max(level);
        zone.carrier = carrier;
        Ok(large)
    }

    fn find_means(&mut self, motions: Motions<'_>) {
        let changed = self.zones.iter_mut().filter(|zone| zone.changed && zone.carrier == FREE);
        for zone in changed {
            let (mut mass, mut momentum) = (0.0, DVec3::ZERO);
            for vertex in zone.members.iter().map(|&v| v as usize) {
                let own = 1.0 / motions.inverse_masses[vertex];
                mass += own;
                momentum += (motions.wanted[vertex] - motions.start[vertex]) * own;
            }
            zone.mean = momentum / mass;
        }
    }
}

/// The carrier of a zone that touches both.
fn common_carrier(a: Carrier, b: Carrier) -> Result<Carrier, Cut> {
    match (a, b) {
        (FREE, carrier) | (carrier, FREE) => Ok(carrier),
        (a, b) if a == b => Ok(a),
        _ => Err(Cut),
    }
}
