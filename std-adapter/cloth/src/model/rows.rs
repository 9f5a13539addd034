//! The second derivative of an energy of triangles, as sparse rows in single precision.

use crate::world::Incidence;
use selvedge::parallel;
use selvedge_core::glam::{Mat3A, Vec3A};

/// The pairs of corners of a triangle.
pub(super) const PAIRS: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];
/// The number of vertices that are worth several threads.
pub(super) const WORTH_THREADS: usize = 2048;

/// The second derivative of E. A row has the blocks between a vertex and its neighbours. The vertex's own block is minus their sum,
/// since E does not change if all vertices move by the same.
#[derive(Debug)]
pub(super) struct Rows {
    /// The neighbours of each vertex.
    neighbours: Incidence<u32>,
    blocks: Vec<Mat3A>,
    /// The blocks of each triangle's [`PAIRS`], from the first to the second corner and back.
    places: Vec<[[u32; 2]; 3]>,
}

impl Rows {
    /// Makes rows of zeros.
    pub(super) fn new(triangles: impl Iterator<Item = [u32; 3]> + Clone, vertex_count: usize) -> Self {
        let pairs = triangles.flat_map(|vertices| PAIRS.map(|pair| pair.map(|corner| vertices[corner])));
        let mut links: Vec<[u32; 2]> = pairs.clone().flat_map(|[one, other]| [[one, other], [other, one]]).collect();
        links.sort_unstable();
        links.dedup();
        let place = |link: [u32; 2]| links.partition_point(|&other| other < link) as u32;
        let places: Vec<_> = pairs.map(|[one, other]| [place([one, other]), place([other, one])]).collect();
        Self {
            places: places.as_chunks().0.to_vec(),
            neighbours: Incidence::new(vertex_count, || links.iter().map(|&[vertex, other]| (vertex, other))),
            blocks: vec![Mat3A::ZERO; links.len()],
        }
    }

    /// Sets all blocks to zero.
    pub(super) fn clear(&mut self) {
        self.blocks.fill(Mat3A::ZERO);
    }

    /// Adds the blocks between the [`PAIRS`] of a triangle.
    #[inline]
    pub(super) fn add(&mut self, triangle: usize, blocks: [Mat3A; 3]) {
        for (block, [there, back]) in blocks.into_iter().zip(self.places[triangle]) {
            self.blocks[there as usize] += block;
            self.blocks[back as usize] += block.transpose();
        }
    }

    /// Finds the product of the second derivative and these masses on the diagonal with moves.
    pub(super) fn multiply(&self, masses: &[[f32; 2]], moves: &[Vec3A], product: &mut [Vec3A]) {
        let multiply = |vertex: usize, product: &mut Vec3A| {
            let own = moves[vertex];
            let blocks = &self.blocks[self.neighbours.range(vertex)];
            let others = self.neighbours.of(vertex).iter().zip(blocks);
            *product = others.fold(own * masses[vertex][0], |sum, (&other, block)| {
                sum + *block * (moves[other as usize] - own)
            });
        };
        if product.len() < WORTH_THREADS {
            for (vertex, product) in product.iter_mut().enumerate() {
                multiply(vertex, product);
            }
        } else {
            parallel::for_each(product, multiply);
        }
    }
}

/// Returns a·bᵀ.
#[inline]
pub(super) fn product(a: Vec3A, b: Vec3A) -> Mat3A {
    Mat3A::from_cols(a * b.x, a * b.y, a * b.z)
}
