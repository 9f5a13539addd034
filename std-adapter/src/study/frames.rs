//! A mesh in motion, frame by frame.

use crate::glam::DVec3;
use crate::mesh::Topology;

/// A sequence of frames of one mesh; a step leads from each frame to the next.
pub trait Frames {
    /// What the motion is called in reports: a scene's name, or the files.
    fn name(&self) -> String;
    /// The mesh.
    fn topology(&self) -> &Topology;
    /// How many steps there are: one less than frames.
    fn step_count(&self) -> usize;
    /// Replaces `positions` by those of frame 0 to [`step_count`](Self::step_count), in the caller's length unit.
    fn positions(&self, frame: usize, positions: &mut Vec<DVec3>);
}

/// One step from one frame to another.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoFrames {
    /// What the step is called in reports.
    pub name: String,
    /// The mesh.
    pub topology: Topology,
    /// Positions at time 0.
    pub start: Vec<DVec3>,
    /// Positions at time 1.
    pub end: Vec<DVec3>,
}

impl Frames for TwoFrames {
    fn name(&self) -> String {
        self.name.clone()
    }

    fn topology(&self) -> &Topology {
        &self.topology
    }

    fn step_count(&self) -> usize {
        1
    }

    fn positions(&self, frame: usize, positions: &mut Vec<DVec3>) {
        positions.clone_from(if frame == 0 { &self.start } else { &self.end });
    }
}
