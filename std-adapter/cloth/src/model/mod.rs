//! The mechanics of cloth, ropes and seams: the parts that effects put into a step.

pub(crate) mod bending;
pub(crate) mod edge_lengths;
pub(crate) mod elasticity;
pub(crate) mod energy;
pub(crate) mod hierarchy;
pub(crate) mod length;
pub(crate) mod membrane;
pub(crate) mod mobility;
pub(crate) mod rope;
mod rows;
pub(crate) mod schedule;
pub(crate) mod step;
pub(crate) mod stitches;
pub(crate) mod tearing;
pub(crate) mod touches;
