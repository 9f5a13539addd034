//! The broad phase's boxes, in `f32` for either format of the positions.
//!
//! Boxes must overlap whenever the exact ones do. A coordinate x becomes fl₃₂(fl(x − m)), where m is a middle of the mesh. Both
//! roundings are monotone: x ≤ y implies that x's image is at most y's. Two boxes overlap if each one's lower bound is at most
//! the other's upper bound, on each axis. Boxes that overlap therefore still do after the mapping, **without rounding outwards**.
//! Some pairs that were narrowly apart may be added; the primitive box tests see the exact positions. Subtracting m first keeps
//! `f32` precise for a mesh far from the origin.

use crate::broad_phase::SweptBox;
use selvedge::parallel;
use selvedge_core::Scalar;
use selvedge_core::boxes::Aabb;
use selvedge_core::boxes::mapping::image;

pub(super) fn map_boxes<S: Scalar>(mapped: &mut Vec<SweptBox>, boxes: &[Aabb<S>]) {
    let middle = middle(boxes);
    parallel::fill(mapped, boxes, |swept| {
        let map = |bounds: [S; 3]| [0, 1, 2].map(|axis| image(bounds[axis].to_f64() - middle[axis]));
        SweptBox {
            lower: map(swept.lower),
            upper: map(swept.upper),
        }
    });
}

/// Returns the middle of all boxes; zero if that overflows.
fn middle<S: Scalar>(boxes: &[Aabb<S>]) -> [f64; 3] {
    let all = boxes.iter().fold(Aabb::empty(), |all, swept| all.merged(swept));
    [0, 1, 2].map(|axis| {
        let middle = 0.5 * (all.lower[axis].to_f64() + all.upper[axis].to_f64());
        if middle.is_finite() { middle } else { 0.0 }
    })
}
