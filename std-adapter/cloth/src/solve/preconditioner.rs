//! An approximate inverse of the [matrix](super::matrix): the inverse block of each vertex.
//!
//! For ropes it is the inverse of their [bands](super::bands), and for a free body that of its [block](super::coupled).

use super::bands::BandFactors;
use super::coupled::BodyFactors;
use super::linear::Vectors;
use super::matrix::{Matrix, dot};
use selvedge_core::glam::{Mat3A, Vec3A};

/// The preconditioner.
#[derive(Debug, Default)]
pub(super) struct Preconditioner {
    inverse: Vec<Mat3A>,
    factors: BandFactors,
    of_bodies: BodyFactors,
    /// W·g for each rank-one part of the matrix, with W the rest of the preconditioner.
    ranks: Vec<(f64, Vec<Vec3A>)>,
}

impl Preconditioner {
    /// Finds the inverses for a matrix.
    pub(super) fn prepare(&mut self, matrix: &Matrix) {
        self.inverse.clear();
        self.inverse
            .extend((0..matrix.diagonal.len()).map(|vertex| inverse(matrix, vertex)));
        self.factors.factorise(matrix);
        self.of_bodies.factorise(&matrix.coupled, &matrix.diagonal);
        self.ranks.clear();
        for rank in &matrix.ranks[..matrix.used_ranks] {
            let mut image = vec![Vec3A::ZERO; self.inverse.len()];
            self.apply(matrix, &rank.direction, &mut image);
            let whole = rank.factor / (1.0 + rank.factor * dot(&rank.direction, &image));
            self.ranks.push((whole, image));
        }
    }

    /// Finds the inverses again after a change of contacts.
    pub(super) fn renew(&mut self, matrix: &Matrix) {
        if !self.is_of_vertices(matrix) {
            self.prepare(matrix);
            return;
        }
        for &vertex in &matrix.pressed {
            self.inverse[vertex as usize] = inverse(matrix, vertex as usize);
        }
        self.of_bodies.factorise(&matrix.coupled, &matrix.diagonal);
    }

    /// Returns whether it consists of the inverse blocks alone.
    fn is_of_vertices(&self, matrix: &Matrix) -> bool {
        self.ranks.is_empty() && matrix.bands.is_empty()
    }

    /// Finds W·r.
    pub(super) fn apply(&mut self, matrix: &Matrix, residual: &[Vec3A], image: &mut [Vec3A]) {
        for ((image, inverse), residual) in image.iter_mut().zip(&self.inverse).zip(residual) {
            *image = *inverse * *residual;
        }
        self.factors.solve(&matrix.bands, residual, image);
        self.of_bodies.solve(residual, image);
        // Sherman and Morrison: (W⁻¹ + β·g·gᵀ)⁻¹ = W − β·Wg·(Wg)ᵀ/(1 + β·g·Wg).
        for (factor, of_rank) in &self.ranks {
            let by = (factor * dot(of_rank, residual)) as f32;
            for (image, of_rank) in image.iter_mut().zip(of_rank) {
                *image -= *of_rank * by;
            }
        }
    }

    /// Returns rᵀWr, an estimate of twice the energy by which a step would fall, and finds W·r.
    pub(super) fn measure(&mut self, matrix: &Matrix, residual: &[Vec3A], image: &mut [Vec3A]) -> f64 {
        self.apply(matrix, residual, image);
        dot(residual, image)
    }

    /// Adds `step` times the direction to the moves, takes `step` times its product from the residual, and returns its
    /// [measure](Self::measure).
    pub(super) fn follow(&mut self, matrix: &Matrix, step: f32, vectors: &mut Vectors) -> f64 {
        let Vectors {
            residual,
            moves,
            image,
            direction,
            product,
        } = vectors;
        let mut sum = 0.0;
        let read = direction.iter().zip(&*product).zip(&self.inverse);
        let written = moves.iter_mut().zip(residual.iter_mut()).zip(image.iter_mut());
        // One pass over the vectors.
        for (((direction, product), inverse), ((moved, residual), image)) in read.zip(written) {
            *moved += *direction * step;
            *residual -= *product * step;
            *image = *inverse * *residual;
            sum += f64::from(image.dot(*residual));
        }
        if self.is_of_vertices(matrix) {
            return sum + self.of_bodies.solve(residual, image);
        }
        self.measure(matrix, residual, image)
    }
}

/// The inverse of a symmetric positive definite block; zero for a fixed vertex, or if rounding or an overflow has made it
/// something else.
fn inverse(matrix: &Matrix, vertex: usize) -> Mat3A {
    if matrix.is_fixed[vertex] {
        return Mat3A::ZERO;
    }
    let inverse = matrix.diagonal[vertex].inverse();
    if inverse.is_finite() { inverse } else { Mat3A::ZERO }
}
