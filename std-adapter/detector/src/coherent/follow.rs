//! The near pairs of a detector's steps. Pairs that no remembered direction keeps apart go to the elementary test.
//!
//! **No contact is missed.** A pair outside the list keeps its distance while no vertex strays too far ([`near`](super::near)).
//! Every step measures the strays at its end, and also at its start unless it starts exactly where the last step ended. The
//! distance is the separation and twice the tolerance, so a pair that is proven apart here is not a contact of the elementary
//! test either.

use super::interest::{CLASSES, Class, Interest, Reach};
use super::near::NearPairs;
use super::pair::NearPair;
use crate::broad_phase::mapping_within;
use crate::mesh::Topology;
use crate::parallel;
use crate::step::{CollisionFilter, Motions};
use selvedge_core::PairKind;
use selvedge_core::Scalar;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::gap::GapError;
use selvedge_core::separation::largest_coordinate;
use std::sync::Arc;

/// The length by which the search for pairs exceeds their distance, in mean edges. A larger value gives longer lists that last
/// longer.
const BEYOND: f64 = 0.1;
/// The largest number of steps to look ahead. With 6 there are a third more searches, and with 12 nearly twice as many for
/// strayed vertices; both take longer.
const FARTHEST: u32 = 8;

/// The cost of a listed pair in a step, in units of the cost of finding a pair. It is an estimate, since most pairs need no
/// attention.
const UPKEEP: f64 = 0.1;

/// The bound from which on distances and edges are not used, since sums of them might overflow.
pub(crate) const ENORMOUS: f64 = 1e100;

/// The interest in pairs with a moving vertex.
#[derive(Debug)]
struct OfMoving(Option<Vec<bool>>);

impl Interest for OfMoving {
    type Data = ();

    #[inline(always)]
    fn class(&self, _: PairKind, _: [u32; 4]) -> usize {
        0
    }

    fn about(&self, _: PairKind, vertices: [u32; 4]) -> Option<()> {
        let moves = |moving: &Vec<bool>| vertices.iter().any(|&vertex| moving[vertex as usize]);
        self.0.as_ref().is_none_or(moves).then_some(())
    }
}

/// The near pairs of one step after another; see the [module](self). The answers for a step do not depend on earlier steps.
#[derive(Debug)]
pub(crate) struct Followed {
    moving: Option<Vec<bool>>,
    filter: Option<Arc<CollisionFilter>>,
    /// True for vertices with a triangle.
    used: Vec<bool>,
    /// The near pairs, made in the first step.
    near: Option<NearPairs<OfMoving>>,
    /// The distance of the pairs in the list.
    distance: f64,
    /// The last step.
    before: [Vec<DVec3>; 2],
    step: [Vec<DVec3>; 2],
    /// The pairs that may come within the distance, VF and EE.
    pub(crate) open: [Vec<[u32; 2]>; 2],
    /// True if all positions of vertices that have a triangle are `f32` numbers.
    pub(crate) is_single: bool,
}

impl Followed {
    pub(crate) fn new(moving: Option<Vec<bool>>, filter: Option<Arc<CollisionFilter>>) -> Self {
        Self {
            moving,
            filter,
            used: Vec::new(),
            near: None,
            distance: 0.0,
            before: Default::default(),
            step: Default::default(),
            open: Default::default(),
            is_single: false,
        }
    }

    pub(crate) fn statistics(&self) -> super::near::NearStatistics {
        self.near.as_ref().map_or_else(Default::default, |near| near.statistics())
    }

    pub(crate) fn count(&self) -> usize {
        self.near.as_ref().map_or(0, |near| near.list.len())
    }

    /// Finds the pairs of a step that may come within `distance` by directions, and within `separation` by the boxes of a new
    /// detector. The separation is not larger than the distance, and positions are finite.
    ///
    /// Returns false if that needs more than `memory_limit` bytes. The list is then empty, and the next step finds it again.
    #[must_use]
    pub(crate) fn find(
        &mut self,
        topology: &Arc<Topology>,
        motions: &dyn Motions,
        [distance, separation]: [f64; 2],
        memory_limit: u64,
    ) -> bool {
        std::mem::swap(&mut self.before, &mut self.step);
        if self.used.is_empty() {
            self.used.resize(motions.len(), false);
            topology
                .triangles()
                .iter()
                .flatten()
                .for_each(|&vertex| self.used[vertex as usize] = true);
        }
        self.is_single = take(motions, &self.used, &mut self.step);
        let continues = self.step[0] == self.before[1];
        self.cover(topology, distance, continues, memory_limit);
        if self.near.as_ref().is_some_and(NearPairs::is_over_memory_limit) {
            self.near = None;
            return false;
        }
        self.find_open(motions, separation, continues);
        true
    }

    /// Makes the list valid for the step.
    fn cover(&mut self, topology: &Arc<Topology>, distance: f64, continues: bool, memory_limit: u64) {
        let [start, end] = [&self.step[0][..], &self.step[1][..]];
        if let Some(near) = self.near.as_mut().filter(|_| self.distance == distance) {
            let steps = start.iter().zip(end).zip(self.before[0].iter().zip(&self.before[1]));
            near.set_memory_limit(memory_limit);
            near.set_bends(steps.map(|((&start, &end), (&from, &to))| (end - start) - (to - from)));
            if continues || start != self.before[0] {
                near.advance(1.0);
            }
            if continues {
                near.cover(start, end, 1.0);
            } else {
                near.cover_from(start, end, 1.0);
            }
            return;
        }
        self.distance = distance;
        let reach = Reach {
            classes: [Class { distance, margin: 0.0 }; CLASSES],
            beyond: BEYOND * mean_edge(topology, start),
            spare: 0.0,
            is_graded: true,
            farthest: FARTHEST,
            upkeep: UPKEEP,
        };
        let wanted = self.moving.clone().unwrap_or_else(|| vec![true; start.len()]);
        let interest = OfMoving(self.moving.clone());
        let new = NearPairs::new(Arc::clone(topology), interest, wanted, reach);
        let near = self.near.insert(new.expect("edges are lengths"));
        near.set_filter(self.filter.clone());
        near.set_memory_limit(memory_limit);
        near.cover(start, end, 1.0);
    }

    /// Finds the listed pairs that no direction keeps apart and whose boxes are near.
    fn find_open(&mut self, motions: &dyn Motions, separation: f64, continues: bool) {
        let [start, end] = [&self.step[0][..], &self.step[1][..]];
        let distance = self.distance;
        let Some(near) = &mut self.near else { return };
        if !continues {
            near.find_strays(start, 0.0);
        }
        near.find_strays(end, 1.0);
        let strays = std::mem::take(&mut near.strays);

        // This is four times the error that is needed: the elementary test gives up on pairs nearer than 20u of their size, and
        // reports a contact.
        let largest = largest_coordinate(start).max(largest_coordinate(end));
        let error = GapError::from_largest_coordinate(4.0 * largest);
        let mapping = mapping_within(motions, separation);
        let is_open = |pair: &mut NearPair<()>| {
            if !pair.needs_attention(&strays) {
                if pair.gap() > f32::NEG_INFINITY {
                    pair.forget_gap();
                }
                return false;
            }
            if continues && pair.stays_apart(end, distance, error) || pair.keeps_apart([start, end], distance, error) {
                return false;
            }
            let [a, b, c, d] = pair.vertices.map(|vertex| {
                let vertex = vertex as usize;
                mapping.vertex(start[vertex].into(), end[vertex].into())
            });
            !match pair.kind {
                PairKind::VertexFace => a.is_apart_from(&b.merged(&c).merged(&d)),
                PairKind::EdgeEdge => a.merged(&b).is_apart_from(&c.merged(&d)),
            }
        };
        self.open.iter_mut().for_each(Vec::clear);
        parallel::map_chunks(
            &mut near.list,
            |_, pairs, open: &mut [Vec<[u32; 2]>; 2]| {
                for pair in pairs {
                    if is_open(pair) {
                        open[pair.kind as usize].push(pair.pair);
                    }
                }
            },
            &mut self.open,
            |all, share| all.iter_mut().zip(share).for_each(|(all, share)| all.extend(share)),
        );
        near.strays = strays;
        // Pairs that were added to the list come after the others.
        self.open.iter_mut().for_each(|pairs| pairs.sort());
    }
}

/// Replaces both lists by the positions. Returns whether those of all used vertices are `f32` numbers.
fn take(motions: &dyn Motions, used: &[bool], [start, end]: &mut [Vec<DVec3>; 2]) -> bool {
    let mut are_single = true;
    start.clear();
    end.clear();
    for (vertex, &is_used) in used.iter().enumerate() {
        let motion = motions.motion(vertex);
        let is_single = |position: DVec3| position.to_array().iter().all(|&x| f32::from_f64(x).to_f64() == x);
        are_single &= !is_used || is_single(motion.start) && is_single(motion.end);
        start.push(motion.start);
        end.push(motion.end);
    }
    are_single
}

fn mean_edge(topology: &Topology, positions: &[DVec3]) -> f64 {
    let edges = topology.edges();
    let length = |&[a, b]: &[u32; 2]| positions[a as usize].distance(positions[b as usize]);
    let mean = edges.iter().map(length).sum::<f64>() / edges.len().max(1) as f64;
    if mean < ENORMOUS { mean } else { 0.0 }
}
