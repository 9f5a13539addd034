//! Parts of a mesh, such as bodies, that may be far from all else.
//!
//! A part is far in a step if, along an axis, the box of its paths keeps more than twice the reach from that of the vertices of
//! no part. Then it has no pair within the reach; the factor of two covers the rounding of the difference. Until the next full
//! search, a far part counts nowhere: it has no listed pair, does not stray, and no rounding bound covers it. So it changes
//! neither the list nor the steps of searches. A part that comes near is taken for strayed, and stays near until the next full
//! search, since listed pairs may have its vertices.

use selvedge_core::glam::DVec3;
use selvedge_core::separation::largest_coordinate;
use std::ops::Range;

/// The parts, and which of them are near.
#[derive(Debug, Default)]
pub(super) struct Parts {
    /// The vertices of each part; no pair of a part and itself is needed.
    parts: Vec<Range<usize>>,
    /// For each part, whether it is near.
    are_near: Vec<bool>,
    /// The vertices of no part.
    others: Vec<Range<usize>>,
    /// For each vertex, whether it is of no part or of a near one; empty without parts.
    near: Vec<bool>,
    /// The parts that the last [`update`](Self::update) found to have come near.
    come: Vec<usize>,
    /// The distance of far parts along an axis.
    distance: f64,
}

impl Parts {
    /// `parts` are ascending and disjoint ranges of so many vertices, with which pairs within `reach` are looked for.
    pub(super) fn new(parts: Vec<Range<usize>>, vertices: usize, reach: f64) -> Self {
        let starts = std::iter::once(0).chain(parts.iter().map(|part| part.end));
        let ends = parts.iter().map(|part| part.start).chain([vertices]);
        Self {
            are_near: vec![true; parts.len()],
            others: starts.zip(ends).map(|(start, end)| start..end).collect(),
            near: if parts.is_empty() { Vec::new() } else { vec![true; vertices] },
            come: Vec::new(),
            distance: 2.0 * reach,
            parts,
        }
    }

    /// Finds which parts are near in a motion.
    pub(super) fn begin(&mut self, motion: [&[DVec3]; 2]) {
        self.are_near.fill(false);
        self.near.fill(true);
        self.update(motion);
        self.come.clear();
        for (part, _) in self.parts.iter().zip(&self.are_near).filter(|(_, is_near)| !**is_near) {
            self.near[part.clone()].fill(false);
        }
    }

    /// Finds which far parts have come near in a motion.
    pub(super) fn update(&mut self, motion: [&[DVec3]; 2]) {
        self.come.clear();
        if self.are_near.iter().all(|&is_near| is_near) {
            return;
        }
        let bounds = |range: &Range<usize>, bounds: [DVec3; 2]| {
            let points = motion.into_iter().flat_map(|positions| &positions[range.clone()]);
            points.fold(bounds, |[low, high], &point| [low.min(point), high.max(point)])
        };
        let empty = [DVec3::INFINITY, DVec3::NEG_INFINITY];
        let [low, high] = self.others.iter().fold(empty, |all, range| bounds(range, all));
        for part in 0..self.parts.len() {
            if self.are_near[part] {
                continue;
            }
            let [own_low, own_high] = bounds(&self.parts[part], empty);
            let gap = (low - own_high).max(own_low - high);
            // A NaN is not far; minima and maxima may drop it.
            let is_far = gap.cmpgt(DVec3::splat(self.distance)).any();
            let is_finite = || {
                motion
                    .iter()
                    .all(|all| all[self.parts[part].clone()].iter().all(|point| point.is_finite()))
            };
            if !(is_far && is_finite()) {
                self.are_near[part] = true;
                self.near[self.parts[part].clone()].fill(true);
                self.come.push(part);
            }
        }
    }

    /// The far parts.
    pub(super) fn far(&self) -> impl Iterator<Item = Range<usize>> {
        let parts = self.parts.iter().zip(&self.are_near);
        parts.filter(|(_, is_near)| !**is_near).map(|(part, _)| part.clone())
    }

    /// Corrects which vertices have strayed: those of far parts have not, and those of parts that have just come near have.
    pub(super) fn correct(&self, strayed: &mut [bool]) {
        self.far().for_each(|part| strayed[part].fill(false));
        self.come
            .iter()
            .for_each(|&part| strayed[self.parts[part].clone()].fill(true));
    }

    /// Returns whether a vertex is of no far part.
    #[inline(always)]
    pub(super) fn is_near(&self, vertex: u32) -> bool {
        self.near.is_empty() || self.near[vertex as usize]
    }

    /// Returns the number of vertices of no far part, of all these.
    pub(super) fn count(&self, vertices: usize) -> usize {
        vertices - self.far().map(|part| part.len()).sum::<usize>()
    }

    /// Returns the largest coordinate of vertices of no far part; infinite if one is not finite.
    pub(super) fn largest(&self, positions: &[DVec3]) -> f64 {
        if self.parts.is_empty() {
            return largest_coordinate(positions);
        }
        let near = self.parts.iter().zip(&self.are_near).filter(|(_, is_near)| **is_near);
        let ranges = self.others.iter().chain(near.map(|(part, _)| part));
        ranges
            .map(|range| largest_coordinate(&positions[range.clone()]))
            .fold(0.0, f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_is_far_until_it_comes_near_and_then_near_until_the_next_search() {
        let mut parts = Parts::new(vec![1..3, 4..5], 5, 0.5);
        let at = |first: f64, second: f64| [0.0, first, first + 1.0, 0.1, second].map(|x| DVec3::X * x);
        let near = |parts: &Parts| [0, 1, 2, 3, 4].map(|vertex| parts.is_near(vertex));
        parts.begin([&at(9.0, 0.0), &at(9.0, 1.0)]);
        assert_eq!(near(&parts), [true, false, false, true, true]);
        assert_eq!((parts.count(5), parts.largest(&at(9.0, 1.0))), (3, 1.0));
        let mut strayed = [false, true, true, true, false];
        parts.correct(&mut strayed);
        assert_eq!(strayed, [false, false, false, true, false]);
        parts.update([&at(9.0, 0.0), &at(1.0, 99.0)]);
        parts.correct(&mut strayed);
        assert_eq!(strayed, [false, true, true, true, false]);
        parts.update([&at(9.0, 99.0); 2]);
        assert_eq!((parts.count(5), parts.largest(&at(9.0, 99.0))), (5, 99.0));
        parts.begin([&at(9.0, 99.0), &at(9.0, f64::NAN)]);
        assert_eq!(near(&parts), [true, false, false, true, true]);
        assert_eq!(parts.largest(&at(9.0, f64::NAN)), f64::INFINITY);
    }
}
