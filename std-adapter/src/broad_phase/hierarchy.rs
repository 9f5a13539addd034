//! An order of the triangles in which groups of consecutive ones lie close together, and the groups' boxes.

use super::SweptBox;
use super::candidates::{Bounds, EMPTY, bounds, union};
use crate::parallel;

/// Triangles in a group of the lowest level.
pub(super) const LEAF: usize = 16;
/// Groups in a group of the next level.
pub(super) const BRANCHES: usize = 8;

/// Slices shorter than this are not split between threads.
const SEQUENTIAL: usize = 4096;

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

#[derive(Clone, Copy, Debug)]
struct Centre {
    position: [f32; 3],
    triangle: u32,
}

impl Hierarchy {
    pub(super) fn len(&self) -> usize {
        self.triangles.len()
    }

    /// Finds the order. [`Self::refit`] must follow.
    pub(super) fn build(&mut self, boxes: &[SweptBox]) {
        self.centres.clear();
        self.centres
            .extend((0..).zip(boxes).map(|(triangle, swept)| Centre {
                position: centre(swept),
                triangle,
            }));
        order(&mut self.centres);

        self.triangles.clear();
        self.triangles
            .extend(self.centres.iter().map(|centre| centre.triangle));
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
            level
                .groups
                .extend(self.triangles.chunks(size).map(|group| Group {
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
        parallel::for_each_with_chunk(
            &mut leaves.groups,
            &mut self.bounds,
            LEAF,
            |index, group, inside| {
                group.bounds = EMPTY;
                for (own, &triangle) in inside.iter_mut().zip(&triangles[index * LEAF..]) {
                    *own = bounds(&boxes[triangle as usize]);
                    group.bounds = union(&group.bounds, own);
                }
            },
        );
        let mut below = &leaves.groups;
        for level in upper {
            for (group, children) in level.groups.iter_mut().zip(below.chunks(BRANCHES)) {
                group.bounds = children
                    .iter()
                    .fold(EMPTY, |all, child| union(&all, &child.bounds));
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

/// Splits at the median along the longest axis, again and again, but always between two groups of the
/// largest size that fits in more than once.
fn order(centres: &mut [Centre]) {
    if centres.len() <= LEAF {
        return;
    }
    let mut size = LEAF;
    while size * BRANCHES < centres.len() {
        size *= BRANCHES;
    }
    let middle = centres.len().div_ceil(size) / 2 * size;
    let axis = longest_axis(centres);
    centres.select_nth_unstable_by(middle, |a, b| a.position[axis].total_cmp(&b.position[axis]));
    let (left, right) = centres.split_at_mut(middle);
    if left.len() + right.len() > SEQUENTIAL {
        parallel::both(|| order(left), || order(right));
    } else {
        order(left);
        order(right);
    }
}

fn longest_axis(centres: &[Centre]) -> usize {
    let mut lower = [f32::INFINITY; 3];
    let mut upper = [f32::NEG_INFINITY; 3];
    for centre in centres {
        for axis in 0..3 {
            let x = centre.position[axis];
            lower[axis] = if x < lower[axis] { x } else { lower[axis] };
            upper[axis] = if x > upper[axis] { x } else { upper[axis] };
        }
    }
    // Halved, so that the difference of finite numbers is finite.
    let extent = |axis: usize| 0.5 * upper[axis] - 0.5 * lower[axis];
    (1..3).fold(0, |longest, axis| {
        if extent(axis) > extent(longest) {
            axis
        } else {
            longest
        }
    })
}
