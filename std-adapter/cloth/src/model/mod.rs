//! The mechanics of cloth and seams: the parts that effects put into a step.

pub(crate) mod bending;
pub(crate) mod edge_lengths;
pub(crate) mod energy;
pub(crate) mod length;
pub(crate) mod membrane;
pub(crate) mod rigid;
pub(crate) mod step;
pub(crate) mod stitches;
pub(crate) mod tearing;
pub(crate) mod triangle_edges;
