//! The forces of all hinges at once, −Q·x: a sparse symmetric matrix, by rows.

use super::hinge::Hinge;
use crate::incidence::Incidence;
use crate::schedule::On;
use selvedge::verification::parallel;
use selvedge_core::glam::DVec3;

/// Rows of Q without the diagonal: a row sums to zero.
#[derive(Debug)]
pub(super) struct Forces {
    starts: Vec<u32>,
    /// Of each row, sorted.
    entries: Vec<(u32, f64)>,
}

impl Forces {
    pub(super) fn new(hinges: &[On<Hinge, 4>], vertex_count: usize) -> Self {
        let entries = || {
            hinges.iter().flat_map(|(vertices, hinge)| {
                let ends = (0..4).flat_map(|k| (0..4).filter(move |&l| l != k).map(move |l| (k, l)));
                ends.map(|(k, l)| {
                    let value = hinge.coefficient * hinge.weights[k] * hinge.weights[l];
                    (vertices[k], (vertices[l], value))
                })
            })
        };
        let mut rows = Incidence::new(vertex_count, entries);
        let mut forces = Self {
            starts: vec![0],
            entries: Vec::new(),
        };
        for vertex in 0..vertex_count {
            let row = rows.of_mut(vertex);
            // Stable, so that sums are the same bits every time.
            row.sort_by_key(|(other, _)| *other);
            for same in row.chunk_by(|a, b| a.0 == b.0) {
                forces.entries.push((same[0].0, same.iter().map(|(_, value)| value).sum()));
            }
            forces.starts.push(forces.entries.len() as u32);
        }
        forces
    }

    /// Vertices.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    fn row(&self, vertex: usize) -> &[(u32, f64)] {
        &self.entries[self.starts[vertex] as usize..self.starts[vertex + 1] as usize]
    }

    /// The largest sum of absolute values of a row of M⁻¹Q.
    pub(super) fn fastest(&self, inverse_masses: &[f64]) -> f64 {
        let sum = |vertex: usize| {
            let row = self.row(vertex).iter().map(|(_, value)| *value);
            let diagonal = row.clone().sum::<f64>().abs();
            inverse_masses[vertex] * (diagonal + row.map(f64::abs).sum::<f64>())
        };
        (0..self.len()).map(sum).fold(0.0, f64::max)
    }

    /// On a vertex.
    #[inline(always)]
    fn on(&self, vertex: usize, positions: &[DVec3]) -> DVec3 {
        let own = positions[vertex];
        let mut force = DVec3::ZERO;
        for &(other, value) in self.row(vertex) {
            force += (own - positions[other as usize]) * value;
        }
        force
    }

    /// ½x·Q·x, in J, not negative whatever is rounded. About the first vertex: forces have no sum, and differences fewer digits to lose.
    pub(super) fn energy(&self, positions: &[DVec3]) -> f64 {
        let of = |vertex: usize| (positions[vertex] - positions[0]).dot(self.on(vertex, positions));
        (-0.5 * (0..self.len()).map(of).sum::<f64>()).max(0.0)
    }

    /// Calls `action` with each vertex, the force on it and its place in `results`.
    pub(super) fn for_each(&self, positions: &[DVec3], results: &mut [DVec3], action: impl Fn(usize, DVec3, &mut DVec3) + Sync) {
        parallel::for_each(results, |vertex, result| action(vertex, self.on(vertex, positions), result));
    }
}
