//! The motion of each vertex, as the lanes read it.
//!
//! There are always rows in `f64`, which hold positions of either format exactly. If all positions are `f32` numbers, there are
//! rows in `f32` too. Proofs in `f32`, with sixteen pairs in a register, then hold for the positions themselves, and only open
//! pairs need `f64`.

use crate::parallel;
use crate::step::Motions;
use selvedge_core::batch::VertexRow;
use selvedge_core::{Motion, Scalar};
use std::sync::atomic::{AtomicBool, Ordering};

#[derive(Debug, Default)]
pub(crate) struct Rows {
    double: Vec<VertexRow<f64>>,
    single: Vec<VertexRow<f32>>,
    has_single: bool,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct RowSlices<'a> {
    pub(crate) double: &'a [VertexRow<f64>],
    pub(crate) single: Option<&'a [VertexRow<f32>]>,
}

impl Rows {
    pub(crate) fn slices(&self) -> RowSlices<'_> {
        RowSlices {
            double: self.double(),
            single: self.single(),
        }
    }

    pub(crate) fn double(&self) -> &[VertexRow<f64>] {
        &self.double
    }

    /// Returns the same rows in `f32`, if [`narrow`](Self::narrow) found that exact.
    pub(crate) fn single(&self) -> Option<&[VertexRow<f32>]> {
        self.has_single.then_some(&self.single)
    }

    /// Copies all rows of `other`, those in `f32` included, to the places from `first` on.
    pub(crate) fn put(&mut self, first: usize, other: &Self) {
        let end = first + other.double.len();
        if self.double.len() < end {
            self.resize(end);
        }
        self.double[first..end].copy_from_slice(&other.double);
        if let Some(single) = other.single() {
            let nowhere = VertexRow::new(Motion::resting(Default::default()));
            self.single.resize(self.double.len(), nowhere);
            self.single[first..end].copy_from_slice(single);
        }
    }

    /// Returns the rows that were [put](Self::put), in `f32` too if the caller says that all have them.
    pub(crate) fn put_slices(&self, are_single: bool) -> RowSlices<'_> {
        RowSlices {
            double: self.double(),
            single: are_single.then_some(&self.single),
        }
    }

    pub(crate) fn clear(&mut self) {
        self.double.clear();
        self.has_single = false;
    }

    pub(crate) fn resize(&mut self, vertices: usize) -> &mut [VertexRow<f64>] {
        let unknown = Motion::resting(Default::default());
        self.double.resize(vertices, VertexRow::new(unknown));
        self.has_single = false;
        &mut self.double
    }

    pub(crate) fn set(&mut self, motions: &dyn Motions) {
        self.clear();
        self.double
            .extend((0..motions.len()).map(|vertex| VertexRow::new(motions.motion(vertex))));
    }

    /// Replaces the rows of some vertices; the other rows have no meaning. If all positions are `f32` numbers, it makes rows in
    /// `f32` too.
    pub(crate) fn set_some(&mut self, motions: &dyn Motions, vertices: impl Iterator<Item = u32>, are_single: bool) {
        self.resize(motions.len());
        self.single
            .resize(motions.len(), VertexRow::new(Motion::resting(Default::default())));
        self.has_single = are_single;
        for vertex in vertices {
            let vertex = vertex as usize;
            let row = VertexRow::new(motions.motion(vertex));
            self.double[vertex] = row;
            if are_single {
                self.has_single &= narrowed(&[row], &mut self.single[vertex..=vertex]);
            }
        }
    }

    /// Makes rows in `f32` if all positions are such numbers.
    pub(crate) fn narrow(&mut self) {
        let are_exact = AtomicBool::new(true);
        let nowhere = VertexRow::new(Motion::resting(Default::default()));
        self.single.resize(self.double.len(), nowhere);
        parallel::for_each_chunk_with_chunk(&mut self.single, &mut self.double, VERTICES, |_, single, double| {
            if are_exact.load(Ordering::Relaxed) && !narrowed(double, single) {
                are_exact.store(false, Ordering::Relaxed);
            }
        });
        self.has_single = are_exact.into_inner();
    }
}

/// The number of vertices that one thread narrows at a time.
const VERTICES: usize = 4096;

/// Replaces `single` by `double` as long as that is exact. Returns whether all rows are exact. On a thread that flushes subnormal
/// numbers, rows with such numbers are not.
fn narrowed(double: &[VertexRow<f64>], single: &mut [VertexRow<f32>]) -> bool {
    double.iter().zip(single).all(|(double, single)| {
        let motion = double.motion();
        let mut is_exact = true;
        let mut narrow = |[x, y, z]: [f64; 3]| {
            let [u, v, w] = [f32::from_f64(x), f32::from_f64(y), f32::from_f64(z)];
            is_exact &= u.to_f64() == x && v.to_f64() == y && w.to_f64() == z;
            [u, v, w].into()
        };
        let (start, end) = (narrow(motion.start.into()), narrow(motion.end.into()));
        *single = VertexRow::new(Motion::new(start, end));
        is_exact
    })
}
