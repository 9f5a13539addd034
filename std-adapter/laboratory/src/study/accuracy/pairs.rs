use crate::methods::Preset;
use crate::pipeline::Pipeline;
use crate::study::Frames;
use selvedge::PairKind;
use selvedge::glam::DVec3;
use selvedge_core::batch::VertexRow;
use selvedge_core::{Motion, Scalar};
use std::error::Error;

/// The number of consecutive pairs in a sample, so that neighbours stay neighbours.
const RUN: usize = 1024;

/// Vertex–face and edge–edge pairs of moving points, on which every filter is measured.
#[derive(Clone, Debug, PartialEq)]
pub struct PairSet {
    /// The name of the set.
    pub name: String,
    /// The moving points, at the start and at the end of the step.
    pub points: Vec<[DVec3; 2]>,
    /// The vertex–face pairs, as indices into `points`: vertex, face.
    pub vertex_face: Vec<[u32; 4]>,
    /// The edge–edge pairs, as indices into `points`: first edge, second edge.
    pub edge_edge: Vec<[u32; 4]>,
    /// The number of pairs before sampling.
    pub drawn_from: usize,
}

impl PairSet {
    pub(super) fn new(name: String) -> Self {
        Self {
            name,
            points: Vec::new(),
            vertex_face: Vec::new(),
            edge_edge: Vec::new(),
            drawn_from: 0,
        }
    }

    pub(super) fn by_kind(&self) -> [(PairKind, &[[u32; 4]]); 2] {
        [
            (PairKind::VertexFace, &self.vertex_face),
            (PairKind::EdgeEdge, &self.edge_edge),
        ]
    }

    /// Collects the primitive pairs of some steps, as they come from broad phase and distribution, each pair once. A step is the
    /// frame from which it starts, and an offset of all positions.
    ///
    /// If there are more than `pairs`, evenly spaced runs of pairs are taken, as many of each step.
    ///
    /// # Errors
    /// Returns an error if threads cannot be started or a frame is not finite.
    pub fn from_steps(
        name: String,
        frames: &dyn Frames,
        steps: &[(usize, DVec3)],
        pairs: usize,
    ) -> Result<Self, Box<dyn Error + Send + Sync>> {
        let topology = frames.topology();
        let stages = Preset::Curtis2008.stages();
        let mut pipeline = Pipeline::<f64>::new(topology.clone(), stages, 0)?;
        pipeline.keep_candidates(true);
        let mut set = Self::new(name);
        let (mut start, mut end) = (Vec::new(), Vec::new());
        for &(frame, offset) in steps {
            frames.step(frame, &mut start, &mut end);
            pipeline.step(&start, &end)?;
            let first = set.points.len() as u32;
            let moving = start.iter().zip(&end);
            set.points.extend(moving.map(|(&start, &end)| [start + offset, end + offset]));

            let candidates = |kind| pipeline.candidates(kind);
            let count = candidates(PairKind::VertexFace).len() + candidates(PairKind::EdgeEdge).len();
            set.drawn_from += count;
            let share = (pairs as f64 / steps.len() as f64 / count as f64).min(1.0);
            for (kind, indices) in [
                (PairKind::VertexFace, &mut set.vertex_face),
                (PairKind::EdgeEdge, &mut set.edge_edge),
            ] {
                let all = candidates(kind);
                let wanted = (share * all.len() as f64).round() as usize;
                let drawn = sample(all, wanted);
                indices.extend(drawn.map(|&pair| {
                    let vertices = topology.vertices_of(kind, pair);
                    vertices.map(|vertex| first + vertex)
                }));
            }
        }
        Ok(set)
    }

    /// Returns the points in the format `S`, rounded where necessary.
    pub fn rows<S: Scalar>(&self) -> Vec<VertexRow<S>> {
        let rounded = |point: DVec3| S::Vector::from(point.to_array().map(S::from_f64));
        let motions = self.points.iter().map(|&[start, end]| Motion {
            start: rounded(start),
            end: rounded(end),
        });
        motions.map(VertexRow::new).collect()
    }

    /// Returns the number of pairs.
    pub fn pairs(&self) -> usize {
        self.vertex_face.len() + self.edge_edge.len()
    }
}

/// Returns this many items in evenly spaced runs, or all of them if there are no more.
fn sample<T>(items: &[T], wanted: usize) -> impl Iterator<Item = &T> {
    let wanted = wanted.min(items.len());
    let skipped = items.len() - wanted;
    let runs = wanted.div_ceil(RUN).max(1);
    (0..runs).flat_map(move |run| {
        let before = |run: usize| run * wanted / runs;
        let first = before(run) + run * skipped / runs;
        items[first..].iter().take(before(run + 1) - before(run))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::ArmFrames;

    #[test]
    fn a_sample_is_runs_in_order_and_all_if_there_are_no_more() {
        let items: Vec<usize> = (0..10_000).collect();
        for wanted in [0, 1, 1023, 1025, 2500, 9999, 10_000, 20_000] {
            let drawn: Vec<usize> = sample(&items, wanted).copied().collect();
            assert_eq!(drawn.len(), wanted.min(items.len()), "{wanted}");
            assert!(drawn.is_sorted_by(|a, b| a < b), "{wanted}");
            let breaks = drawn.windows(2).filter(|pair| pair[1] != pair[0] + 1);
            assert!(breaks.count() <= wanted / RUN, "{wanted}");
        }
    }

    #[test]
    fn steps_add_their_pairs_and_an_offset_moves_them() {
        let arm = ArmFrames::new(1, 60).unwrap();
        let set = |steps: &[(usize, DVec3)], pairs| PairSet::from_steps("arm".to_owned(), &arm, steps, pairs).unwrap();
        let all = usize::MAX;
        let (one, other) = (set(&[(50, DVec3::ZERO)], all), set(&[(55, DVec3::X)], all));
        let both = set(&[(50, DVec3::ZERO), (55, DVec3::X)], all);
        assert_eq!(one.pairs(), one.drawn_from);
        assert_eq!(both.pairs(), one.pairs() + other.pairs());
        assert_eq!(both.points, [one.points.clone(), other.points.clone()].concat());
        let last = both.edge_edge.last().unwrap().map(|index| index as usize);
        let expected = other.edge_edge.last().unwrap().map(|index| index as usize);
        assert_eq!(
            last.map(|index| both.points[index]),
            expected.map(|index| other.points[index])
        );

        let few = set(&[(50, DVec3::ZERO), (55, DVec3::X)], 1000);
        assert_eq!(few.drawn_from, both.drawn_from);
        assert!((998..=1002).contains(&few.pairs()), "{}", few.pairs());
    }
}
