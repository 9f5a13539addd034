//! Gives the hierarchies the boxes of a step.

use super::{BoxFit, Hierarchies, Scope, State};
use crate::parallel;
use crate::step::Motions;
use selvedge_core::batch::VertexRow;
use selvedge_core::boxes::mapping::Mapping;
use selvedge_core::boxes::{Aabb, moving::MovingBox};

impl Hierarchies {
    /// Takes the positions of a step. It builds the hierarchies first if there are none, or if that pays.
    pub(crate) fn fit_boxes(&mut self, motions: &dyn Motions, fit: &BoxFit) {
        let is_whole = self.scope != Scope::Narrowed;
        let builds = self.state == State::Empty || is_whole && self.are_degraded();
        // The rounding of boxes follows from the extent.
        if builds || self.scope == Scope::All {
            self.extent = extent(motions);
        }
        if builds {
            self.build(motions);
        }
        self.state = match self.state {
            State::Empty | State::Built if is_whole => State::New,
            State::Empty | State::Built => State::Built,
            State::New | State::Refitted => State::Refitted,
        };
        let mapping = fit.mapping(motions, &self.extent);
        self.refit(motions, mapping);
        self.fit = *fit;
    }

    fn refit(&mut self, motions: &dyn Motions, mapping: Mapping) {
        // Resting vertices keep their rows and boxes.
        let only_moving = self.moving.is_some() && self.scope != Scope::All && self.resting == Some(mapping);
        let vertices = &self.vertices.primitives;
        let rows = self.rows.resize(vertices.len());
        self.boxes.resize(vertices.len(), MovingBox::empty());
        let moving = self.moving.as_deref().filter(|_| only_moving);
        parallel::for_each_chunk_with_chunk(rows, &mut self.boxes, VERTICES, |first, rows, boxes| {
            let of_boxes = rows.iter_mut().zip(boxes).zip(&vertices[first..]);
            for ((own_row, moving_box), &vertex) in of_boxes {
                let vertex = vertex as usize;
                if moving.is_none_or(|moving| moving[vertex]) {
                    let motion = motions.motion(vertex);
                    *own_row = VertexRow::new(motion);
                    *moving_box = mapping.vertex(motion.start.into(), motion.end.into());
                }
            }
        });
        self.vertices.refit(&self.boxes, only_moving);
        self.edges.refit(&self.boxes, only_moving);
        self.faces.refit(&self.boxes, only_moving);
        self.resting = Some(mapping);
    }
}

/// The number of vertices that one thread refits at a time.
const VERTICES: usize = 1024;

/// Returns the mapping of boxes that hold all points within `separation`, as in the first step of a detector.
pub(crate) fn mapping_within(motions: &dyn Motions, separation: f64) -> Mapping {
    let fit = BoxFit {
        separation,
        ..BoxFit::default()
    };
    fit.mapping(motions, &extent(motions))
}

/// Returns the box of all positions of both frames.
fn extent(motions: &dyn Motions) -> Aabb<f64> {
    let mut extent = Aabb::<f64>::empty();
    for vertex in 0..motions.len() {
        let motion = motions.motion(vertex);
        for position in [motion.start, motion.end] {
            for (axis, x) in position.to_array().into_iter().enumerate() {
                // `min` and `max` are calls on WebAssembly.
                let (lower, upper) = (extent.lower[axis], extent.upper[axis]);
                extent.lower[axis] = if x < lower { x } else { lower };
                extent.upper[axis] = if x > upper { x } else { upper };
            }
        }
    }
    extent
}
