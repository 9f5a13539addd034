//! Orders items so that consecutive ones lie close together.

use crate::parallel;

/// The number of items in a group of the lowest level.
pub(super) const LEAF: usize = 16;

/// The length below which slices are not split between threads.
const SEQUENTIAL: usize = 4096;

#[derive(Clone, Copy, Debug)]
pub(super) struct Centre {
    /// The position, which is finite.
    pub(super) position: [f32; 3],
    pub(super) item: u32,
}

/// Orders items so that groups of 16ᵏ consecutive ones lie close together.
///
/// It splits at the median along the longest axis, recursively, but always between two groups of the largest size of which more
/// than one fits.
pub(super) fn order(centres: &mut [Centre]) {
    if centres.len() <= LEAF {
        return;
    }
    let mut size = LEAF;
    while size * LEAF < centres.len() {
        size *= LEAF;
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
    // Halves keep the difference of finite numbers finite.
    let extent = |axis: usize| 0.5 * upper[axis] - 0.5 * lower[axis];
    (1..3).fold(0, |longest, axis| if extent(axis) > extent(longest) { axis } else { longest })
}
