//! Impact zones: parts of the cloth that move together (Provot 1997). Their motion is certainly free, and from it each vertex
//! then goes as far as it [may](super::truncation).
//!
//! A zone moves with its mean, which keeps its momentum. If it touches a body or pin (its carrier), it moves with that, which
//! keeps it on the body. No motion suits a zone that touches two carriers; it rests.
//!
//! A free body is in a zone as a whole. Its first vertex stands for all.

use super::candidate::Candidate;
use crate::model::rigid::RigidMotion;
use crate::model::step::{Carrier, FREE, TimeStep};
use selvedge::Components;
use selvedge_core::glam::DVec3;

/// A zone without carrier: it touches two carriers, or one that does not keep its shape.
pub(super) const TORN: Carrier = FREE - 1;

/// The zones of one step; at first there are none.
#[derive(Debug, Default)]
pub(super) struct ImpactZones {
    zones: Components,
    /// The carrier of each zone, at its first vertex.
    carriers: Vec<Carrier>,
    /// The members of all zones, and for each vertex whether it is one.
    members: Vec<u32>,
    is_member: Vec<bool>,
    /// The mass and momentum of each zone, at its first vertex, in the unit of the wanted displacements.
    sums: Vec<(f64, DVec3)>,
    /// The vertex that stands for each one: the first of a free body, or the vertex itself. Empty without free bodies.
    stands_for: Vec<u32>,
}

impl ImpactZones {
    pub(super) fn reset(&mut self, vertices: usize, bodies: &[RigidMotion]) {
        self.stands_for.clear();
        if !bodies.is_empty() {
            self.stands_for.extend(0..vertices as u32);
        }
        for body in bodies {
            body.members()
                .for_each(|vertex| self.stands_for[vertex] = body.vertices.start as u32);
        }
        self.zones = Components::new(vertices);
        self.is_member.clear();
        self.is_member.resize(vertices, false);
        self.carriers.clear();
        self.carriers.resize(vertices, FREE);
        self.members.clear();
    }

    /// Joins the cloth of a pair to one zone, with the carrier of the rest of the pair; `carriers` has an entry for each vertex.
    /// Returns whether the zones have changed.
    ///
    /// A change adds a vertex to a zone, joins two zones, or gives a zone a carrier, or a second one. There are fewer than four
    /// changes for each vertex.
    pub(super) fn join(&mut self, pair: &Candidate, carriers: &[Carrier]) -> bool {
        let mut has_changed = false;
        let mut one = None;
        for vertex in pair.vertices {
            if carriers[vertex as usize] == FREE {
                let vertex = self.stands_for.get(vertex as usize).copied().unwrap_or(vertex);
                if !std::mem::replace(&mut self.is_member[vertex as usize], true) {
                    self.members.push(vertex);
                    has_changed = true;
                }
                let first = self.zones.first(vertex);
                let other = *one.get_or_insert(first);
                if first != other {
                    self.zones.join(first, other);
                    let (low, high) = (first.min(other), first.max(other));
                    self.carriers[low as usize] = common(self.carriers[low as usize], self.carriers[high as usize]);
                    one = Some(low);
                    has_changed = true;
                }
            }
        }
        let Some(zone) = one else { return has_changed };
        let carrier = &mut self.carriers[zone as usize];
        let before = *carrier;
        *carrier = pair
            .vertices
            .iter()
            .fold(before, |carrier, &vertex| common(carrier, carriers[vertex as usize]));
        has_changed | (*carrier != before)
    }

    /// Moves the members of each zone from the start of the step with its carrier or its mean. A zone with two carriers does not
    /// move. Marks those whose positions change. Both positions come with the motions of free bodies.
    pub(super) fn carry(
        &mut self,
        step: &TimeStep<'_>,
        (wanted, wanted_bodies): (&[DVec3], &[RigidMotion]),
        (positions, bodies): (&mut [DVec3], &mut [RigidMotion]),
        moved: &mut [bool],
    ) {
        self.members.sort_unstable();
        let members = std::mem::take(&mut self.members);
        self.sums.clear();
        self.sums.resize(positions.len(), (0.0, DVec3::ZERO));
        for &member in &members {
            let zone = self.zones.first(member) as usize;
            let (mass, displacement) = match body_of(wanted_bodies, member) {
                Some(body) => (wanted_bodies[body].mass, wanted_bodies[body].displacement),
                None => {
                    let displacement = wanted[member as usize] - step.start[member as usize];
                    (1.0 / step.inverse_masses[member as usize], displacement)
                }
            };
            let (all, momentum) = &mut self.sums[zone];
            *all += mass;
            *momentum += displacement * mass;
        }
        for &member in &members {
            let zone = self.zones.first(member) as usize;
            let (mass, momentum) = self.sums[zone];
            let carrier = self.carriers[zone];
            let carried = |start: DVec3| match carrier {
                FREE => start + momentum / mass,
                TORN => start,
                carrier => {
                    let [before, now] = &step.poses[carrier as usize];
                    before.carry(now, start)
                }
            };
            let mut moving = vec![member as usize];
            if let Some(body) = body_of(bodies, member) {
                let body = &mut bodies[body];
                moving = body.members().collect();
                body.displacement = carried(body.centre) - body.centre;
                body.turn = match carrier {
                    FREE | TORN => DVec3::ZERO,
                    carrier => {
                        let [before, now] = &step.poses[carrier as usize];
                        before.turn_until(now)
                    }
                };
            }
            for vertex in moving {
                let carried = carried(step.start[vertex]);
                moved[vertex] |= positions[vertex] != carried;
                positions[vertex] = carried;
            }
        }
        self.members = members;
    }
}

/// Returns the place of the free body for which this vertex stands.
fn body_of(bodies: &[RigidMotion], vertex: u32) -> Option<usize> {
    bodies.iter().position(|body| body.vertices.start == vertex as usize)
}

/// The carrier of a zone that touches both.
fn common(a: Carrier, b: Carrier) -> Carrier {
    match (a, b) {
        (FREE, carrier) | (carrier, FREE) => carrier,
        (a, b) if a == b => a,
        _ => TORN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::candidate::{Aim, OfPair};
    use crate::world::KeyframeMotion;
    use selvedge::PairKind;

    fn pair(vertices: [u32; 4]) -> Candidate {
        Candidate::new(
            PairKind::EdgeEdge,
            [0, 1],
            vertices,
            OfPair {
                aim: Aim::requested(0.0),
                body: FREE,
            },
        )
    }

    /// The positions to which zones of these pairs move: eight vertices of cloth, one of a body that rests, one of another body.
    fn carried(pairs: &[[u32; 4]]) -> Vec<DVec3> {
        let start: Vec<DVec3> = (0..10).map(|vertex| DVec3::X * f64::from(vertex)).collect();
        let wanted: Vec<DVec3> = (0..10).map(|vertex| start[vertex] + DVec3::Z * vertex as f64).collect();
        let mut carriers = [FREE; 10];
        (carriers[8], carriers[9]) = (0, 1);
        let mut inverse_masses = [1.0; 10];
        inverse_masses[8..].fill(0.0);
        let rest = [KeyframeMotion::resting().pose(0.0); 2];
        let step = TimeStep {
            time: 0.0,
            h: 1.0,
            start: &start,
            inverse_masses: &inverse_masses,
            poses: &[rest, rest],
            motions: &[],
        };
        let mut zones = ImpactZones::default();
        zones.reset(10, &[]);
        for &vertices in pairs {
            assert!(zones.join(&pair(vertices), &carriers));
            assert!(!zones.join(&pair(vertices), &carriers), "all is as it was");
        }
        let (mut positions, mut moved) = (wanted.clone(), [false; 10]);
        zones.carry(&step, (&wanted, &[]), (&mut positions, &mut []), &mut moved);
        for vertex in 0..10 {
            assert_eq!(moved[vertex], positions[vertex] != wanted[vertex]);
        }
        positions
            .iter()
            .zip(&start)
            .map(|(position, start)| position - start)
            .collect()
    }

    #[test]
    fn a_zone_moves_as_its_mean_and_as_its_carrier_and_not_at_all_where_two_pull() {
        let along = |heights: [f64; 8]| heights.map(|height| DVec3::Z * height);
        assert_eq!(carried(&[])[..8], along([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]));
        assert_eq!(carried(&[[0, 1, 2, 3]])[..8], along([1.5, 1.5, 1.5, 1.5, 4.0, 5.0, 6.0, 7.0]));
        assert_eq!(carried(&[[0, 1, 2, 3], [4, 5, 6, 7], [1, 2, 4, 5]])[..8], along([3.5; 8]));
        let on_body = along([0.0, 0.0, 0.0, 0.0, 4.0, 5.0, 6.0, 7.0]);
        assert_eq!(carried(&[[0, 1, 2, 3], [3, 2, 8, 8]])[..8], on_body);
        let torn = along([0.0, 0.0, 0.0, 0.0, 5.5, 5.5, 5.5, 5.5]);
        assert_eq!(carried(&[[0, 1, 8, 8], [2, 3, 9, 9], [4, 5, 6, 7], [1, 2, 1, 2]])[..8], torn);
    }
}
