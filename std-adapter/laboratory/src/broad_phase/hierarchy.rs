//! An order of the triangles in which groups of consecutive ones lie close together, and the groups' boxes.

use super::SweptBox;
use super::candidates::{Bounds, EMPTY, bounds, union};
use selvedge::broad_phase::{Centre, LEAF, order};
use selvedge::parallel;

/// Groups in a group of the next level.
pub(super) const BRANCHES: usize = 8;

/// All groups of a size; the last one may be smaller.
#[derive(Debug, Default)]
pub(super) struct Level {
    /// Triangles in a group.
    pub(super) size: usize,
    pub(super) groups: Vec<Group>,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    pub(super) bounds: Bounds,
    /// The least triangle inside.
    pub(super) first: u32,
}

/// The order, and one level of groups for each size `LEAF * BRANCHES^k` up to the first that holds all.
#[derive(Debug, Default)]
pub(super) struct Hierarchy {
    /// The triangle at each position. In order within a group of the lowest level.
    pub(super) triangles: Vec<u32>,
    /// The position of each triangle.
    pub(super) positions: Vec<u32>,
    /// The smallest groups first.
    pub(super) levels: Vec<Level>,
    /// Boxes by position.
    pub(super) bounds: Vec<Bounds>,
    /// Scratch for the build.
    centres: Vec<Centre>,
}

impl Hierarchy {
    pub(super) fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Finds the order. [`Self::refit`] must follow.
    pub(super) fn build(&mut self, boxes: &[SweptBox]) {
        self.centres.clear();
        self.centres.extend((0..).zip(boxes).map(|(triangle, swept)| Centre {
            position: centre(swept),
            item: triangle,
        }));
        order::<BRANCHES>(&mut self.centres);

        self.triangles.clear();
        self.triangles.extend(self.centres.iter().map(|centre| centre.item));
        for leaf in self.triangles.chunks_mut(LEAF) {
            leaf.sort_unstable();
        }
        self.positions.resize(boxes.len(), 0);
        for (position, &triangle) in (0..).zip(&self.triangles) {
            self.positions[triangle as usize] = position;
        }
        self.bounds.resize(boxes.len(), EMPTY);
        self.lay_out_levels();
    }

    fn lay_out_levels(&mut self) {
        let mut size = LEAF;
        let mut count = 0;
        loop {
            if self.levels.len() == count {
                self.levels.push(Level::default());
            }
            let level = &mut self.levels[count];
            level.size = size;
            level.groups.clear();
            level.groups.extend(self.triangles.chunks(size).map(|group| Group {
                bounds: EMPTY,
                first: group.iter().copied().min().unwrap_or(u32::MAX),
            }));
            count += 1;
            if size >= self.triangles.len() {
                break;
            }
            size = size.saturating_mul(BRANCHES);
        }
        self.levels.truncate(count);
    }

    /// Gives all groups the boxes of their triangles.
    pub(super) fn refit(&mut self, boxes: &[SweptBox]) {
        let Some((leaves, upper)) = self.levels.split_first_mut() else {
            return;
        };
        let triangles = &self.triangles;
        parallel::for_each_with_chunk(&mut leaves.groups, &mut self.bounds, LEAF, |index, group, inside| {
            group.bounds = EMPTY;
            for (own, &triangle) in inside.iter_mut().zip(&triangles[index * LEAF..]) {
                *own = bounds(&boxes[triangle as usize]);
                group.bounds = union(&group.bounds, own);
            }
        });
        let mut below = &leaves.groups;
        for level in upper {
            for (group, children) in level.groups.iter_mut().zip(below.chunks(BRANCHES)) {
                group.bounds = children.iter().fold(EMPTY, |all, child| union(&all, &child.bounds));
            }
            below = &level.groups;
        }
    }
}

/// The centre of a box; zero along an axis where it is not finite.
fn centre(swept: &SweptBox) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let centre = 0.5 * swept.lower[axis] + 0.5 * swept.upper[axis];
        if centre.is_finite() { centre } else { 0.0 }
    })
}
