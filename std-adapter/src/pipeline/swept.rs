//! The broad phase's boxes: `f32` whatever the positions are.
//!
//! Boxes must overlap whenever the exact ones do. A coordinate x becomes fl₃₂(fl(x − m)), m a middle of the mesh. Both
//! roundings are monotone: x ≤ y implies that x's image is at most y's. Two boxes overlap if each one's lower bound is at
//! most the other's upper bound, on each axis; so boxes that overlap still do after the mapping, **without rounding
//! outwards**. Some pairs that were narrowly apart may be added; the primitive box tests see the exact positions. Taking m
//! off first keeps `f32` precise for a mesh that is far from the origin.

use crate::broad_phase::SweptBox;
use crate::mesh::Topology;
use crate::parallel;
use selvedge_core::boxes::Aabb;
use selvedge_core::{Motion, Scalar};

/// Replaces `boxes` by the mapped swept box of each triangle.
pub(super) fn triangle_boxes<S: Scalar>(
    boxes: &mut Vec<SweptBox>,
    topology: &Topology,
    motions: &[Motion<S>],
) {
    let middle = middle(motions);
    parallel::fill(boxes, topology.triangles(), |triangle| {
        let swept = Aabb::swept(&triangle.map(|vertex| motions[vertex as usize]));
        let map = |bounds: [S; 3]| {
            [0, 1, 2].map(|axis| nearest_f32(bounds[axis].to_f64() - middle[axis]))
        };
        SweptBox {
            lower: map(swept.lower),
            upper: map(swept.upper),
        }
    });
}

#[allow(
    clippy::cast_possible_truncation,
    reason = "rounding to nearest is monotone, which is all that is needed"
)]
fn nearest_f32(value: f64) -> f32 {
    value as f32
}

/// About the middle of the start positions; zero where that overflows.
fn middle<S: Scalar>(motions: &[Motion<S>]) -> [f64; 3] {
    let mut lower = [f64::INFINITY; 3];
    let mut upper = [f64::NEG_INFINITY; 3];
    for motion in motions {
        let position: [S; 3] = motion.start.into();
        for axis in 0..3 {
            lower[axis] = lower[axis].min(position[axis].to_f64());
            upper[axis] = upper[axis].max(position[axis].to_f64());
        }
    }
    [0, 1, 2].map(|axis| {
        let middle = 0.5 * (lower[axis] + upper[axis]);
        if middle.is_finite() { middle } else { 0.0 }
    })
}
