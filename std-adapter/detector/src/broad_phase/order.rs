//! Orders items so that consecutive ones lie close together.

use crate::parallel;

/// The number of items in a group of the lowest level.
pub const LEAF: usize = 16;

/// Shorter slices are not split between threads.
const SEQUENTIAL: usize = 4096;

/// An item and its position.
#[derive(Clone, Copy, Debug)]
pub struct Centre {
    /// The position; finite.
    pub position: [f32; 3],
    /// The number of the item.
    pub item: u32,
}

/// Orders items so that groups of LEAF · BRANCHESᵏ consecutive ones lie close together.
///
/// It splits at the median along the longest axis, recursively, but always between two groups of the largest size of which more than one fits.
///
/// ```
/// use selvedge::broad_phase::{Centre, order};
///
/// let mut centres: Vec<_> = (0..64).map(|item| Centre { position: [(item % 8) as f32, (item / 8) as f32, 0.0], item }).collect();
/// order::<16>(&mut centres);
/// // The first sixteen are a quarter of the square.
/// assert!(centres[..16].iter().all(|centre| centre.position[0] < 4.0 && centre.position[1] < 4.0));
/// ```
pub fn order<const BRANCHES: usize>(centres: &mut [Centre]) {
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
        parallel::both(|| order::<BRANCHES>(left), || order::<BRANCHES>(right));
    } else {
        order::<BRANCHES>(left);
        order::<BRANCHES>(right);
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
    // Halves, so that the difference of finite numbers is finite.
    let extent = |axis: usize| 0.5 * upper[axis] - 0.5 * lower[axis];
    (1..3).fold(0, |longest, axis| if extent(axis) > extent(longest) { axis } else { longest })
}
