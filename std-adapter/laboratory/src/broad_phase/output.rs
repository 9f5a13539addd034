//! Puts the partners of all triangles in a row.

use super::buffer::with_headroom;
use super::hierarchy::Hierarchy;
use super::traversal::Traversal;
use selvedge::parallel;

/// Fewer triangles than this are not split between threads.
const SEQUENTIAL: usize = 4096;

/// Replaces `pairs` by every triangle with each of its partners, in order. `offsets` is scratch.
pub(super) fn concatenate(hierarchy: &Hierarchy, traversal: &Traversal, offsets: &mut Vec<usize>, pairs: &mut Vec<[u32; 2]>) {
    let mut total = 0;
    offsets.clear();
    offsets.extend(hierarchy.positions.iter().map(|&position| {
        let offset = total;
        total += traversal.count(position as usize);
        offset
    }));
    if pairs.capacity() < total {
        pairs.reserve_exact(with_headroom(total) - pairs.len());
    }
    // What is left from the last step is overwritten.
    pairs.resize(total, [0; 2]);
    Concatenation {
        hierarchy,
        traversal,
        offsets,
    }
    .write(0, hierarchy.len(), pairs);
}

struct Concatenation<'a> {
    hierarchy: &'a Hierarchy,
    traversal: &'a Traversal,
    offsets: &'a [usize],
}

impl Concatenation<'_> {
    /// Writes the pairs of the triangles from `first` up to `end`.
    fn write(&self, first: usize, end: usize, pairs: &mut [[u32; 2]]) {
        if end - first > SEQUENTIAL && parallel::has_many_threads() {
            let middle = first.midpoint(end);
            let (left, right) = pairs.split_at_mut(self.offsets[middle] - self.offsets[first]);
            parallel::both(|| self.write(first, middle, left), || self.write(middle, end, right));
            return;
        }
        let mut rest = pairs;
        for triangle in first..end {
            let partners = self.traversal.partners(self.hierarchy.positions[triangle] as usize);
            let (own, others) = rest.split_at_mut(partners.len());
            for (pair, &partner) in own.iter_mut().zip(partners) {
                *pair = [triangle as u32, partner];
            }
            rest = others;
        }
    }
}
