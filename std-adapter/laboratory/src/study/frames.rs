//! A mesh in motion, step by step.

use selvedge::Topology;
use selvedge::glam::DVec3;

/// The steps of one mesh, each from one frame to another. A step need not begin where the last one ends.
pub trait Frames {
    /// Returns the name of the motion in reports: a scene's name, or the files.
    fn name(&self) -> String;
    /// Returns the mesh.
    fn topology(&self) -> &Topology;
    /// Returns the number of steps.
    fn step_count(&self) -> usize;
    /// Replaces `start` and `end` by the positions before and after a step, in the caller's length unit. The step is below
    /// [`step_count`](Self::step_count).
    fn step(&self, step: usize, start: &mut Vec<DVec3>, end: &mut Vec<DVec3>);
}

/// One step from one frame to another.
#[derive(Clone, Debug, PartialEq)]
pub struct TwoFrames {
    /// The name of the step in reports.
    pub name: String,
    /// The mesh.
    pub topology: Topology,
    /// The positions at time 0.
    pub start: Vec<DVec3>,
    /// The positions at time 1.
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

    fn step(&self, _: usize, start: &mut Vec<DVec3>, end: &mut Vec<DVec3>) {
        start.clone_from(&self.start);
        end.clone_from(&self.end);
    }
}
