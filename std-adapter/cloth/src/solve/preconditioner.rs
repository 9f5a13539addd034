//! An approximate inverse of the [matrix](super::matrix): the inverse block of each vertex.
//!
//! For ropes it is the inverse of their [bands](super::bands).

use super::bands::BandFactors;
use super::matrix::{Matrix, dot};
use selvedge_core::glam::{Mat3A, Vec3A};

/// The preconditioner.
#[derive(Debug, Default)]
pub(super) struct Preconditioner {
    inverse: Vec<Mat3A>,
    factors: BandFactors,
    /// W·g for each rank-one part of the matrix, with W the rest of the preconditioner.
    ranks: Vec<(f64, Vec<Vec3A>)>,
}

impl Preconditioner {
    /// Finds the inverses for a matrix.
    pub(super) fn prepare(&mut self, matrix: &Matrix) {
        self.inverse.clear();
        let blocks = matrix.diagonal.iter().zip(&matrix.is_fixed);
        self.inverse
            .extend(blocks.map(|(block, is_fixed)| if *is_fixed { Mat3A::ZERO } else { inverse(block) }));
        self.factors.factorise(matrix);
        self.ranks.clear();
        for rank in &matrix.ranks[..matrix.used_ranks] {
            let mut image = vec![Vec3A::ZERO; self.inverse.len()];
            self.apply(matrix, &rank.direction, &mut image);
            let whole = rank.factor / (1.0 + rank.factor * dot(&rank.direction, &image));
            self.ranks.push((whole, image));
        }
    }

    /// Finds W·r.
    pub(super) fn apply(&mut self, matrix: &Matrix, residual: &[Vec3A], image: &mut [Vec3A]) {
        for ((image, inverse), residual) in image.iter_mut().zip(&self.inverse).zip(residual) {
            *image = *inverse * *residual;
        }
        self.factors.solve(&matrix.bands, residual, image);
        // Sherman and Morrison: (W⁻¹ + β·g·gᵀ)⁻¹ = W − β·Wg·(Wg)ᵀ/(1 + β·g·Wg).
        for (factor, of_rank) in &self.ranks {
            let by = (factor * dot(of_rank, residual)) as f32;
            for (image, of_rank) in image.iter_mut().zip(of_rank) {
                *image -= *of_rank * by;
            }
        }
    }

    /// Returns rᵀWr, an estimate of twice the energy by which a step would fall.
    pub(super) fn measure(&mut self, matrix: &Matrix, residual: &[Vec3A], image: &mut [Vec3A]) -> f64 {
        if self.ranks.is_empty() && matrix.bands.is_empty() {
            // One pass over the vectors.
            let mut sum = 0.0;
            for ((image, inverse), residual) in image.iter_mut().zip(&self.inverse).zip(residual) {
                *image = *inverse * *residual;
                sum += f64::from(image.dot(*residual));
            }
            return sum;
        }
        self.apply(matrix, residual, image);
        dot(residual, image)
    }
}

/// The inverse of a symmetric positive definite block; zero if rounding or an overflow has made it something else.
fn inverse(block: &Mat3A) -> Mat3A {
    let inverse = block.inverse();
    if inverse.is_finite() { inverse } else { Mat3A::ZERO }
}
