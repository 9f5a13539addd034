//! Ropes in the [preconditioner](super::preconditioner): rows of vertices, each linked with the next two, in double precision.
//!
//! A rope's stiffness may be a million times its mass, and a pull passes through all of it in a step. Blocks alone need as many
//! iterations as the rope has vertices; its band needs one.

use super::matrix::Matrix;
use selvedge_core::glam::{DMat3, DVec3, Vec3A};

const NONE: u32 = u32::MAX;

/// All bands, one after the other. A vertex belongs to one band.
#[derive(Debug, Default)]
pub(super) struct Bands {
    vertices: Vec<u32>,
    /// The band of each of them.
    band: Vec<u32>,
    /// The place of each vertex of the scene among these; `NONE` for others.
    places: Vec<u32>,
    /// The blocks of the ropes for each vertex, and between it and the next two.
    own: Vec<DMat3>,
    next: [Vec<DMat3>; 2],
}

/// The factors L·D·Lᵀ of the bands.
#[derive(Debug, Default)]
pub(super) struct BandFactors {
    /// The inverse of D.
    inverse: Vec<DMat3>,
    /// The blocks of L one and two below the diagonal.
    lower: [Vec<DMat3>; 2],
    /// The blocks of L·D one below the diagonal.
    beside: Vec<DMat3>,
    work: Vec<DVec3>,
}

impl Bands {
    /// Makes bands of successive vertices. A vertex of several rows belongs to the first.
    pub(super) fn new(rows: &[Vec<u32>], vertex_count: usize) -> Self {
        let mut bands = Self {
            places: if rows.is_empty() {
                Vec::new()
            } else {
                vec![NONE; vertex_count]
            },
            ..Self::default()
        };
        for (band, row) in (0..).zip(rows) {
            for &vertex in row {
                let place = &mut bands.places[vertex as usize];
                if *place == NONE {
                    *place = bands.vertices.len() as u32;
                    bands.vertices.push(vertex);
                    bands.band.push(band);
                }
            }
        }
        bands.clear();
        bands
    }

    pub(super) fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    pub(super) fn clear(&mut self) {
        for blocks in [&mut self.own].into_iter().chain(&mut self.next) {
            blocks.clear();
            blocks.resize(self.vertices.len(), DMat3::ZERO);
        }
    }

    /// Returns whether all these vertices belong to bands.
    pub(super) fn have(&self, vertices: &[u32]) -> bool {
        let place = |vertex: &u32| self.places.get(*vertex as usize).copied();
        vertices.iter().all(|vertex| place(vertex).is_some_and(|place| place != NONE))
    }

    /// Adds JᵀKJ, without the blocks between vertices that are not near in one band.
    pub(super) fn add(&mut self, vertices: &[u32], weights: &[f64], stiffness: DMat3) {
        for (i, (&vertex, weight)) in vertices.iter().zip(weights).enumerate() {
            let place = self.places[vertex as usize] as usize;
            self.own[place] += stiffness * (weight * weight);
            for (&other, other_weight) in vertices.iter().zip(weights).skip(i + 1) {
                let other = self.places[other as usize] as usize;
                let (first, by) = (place.min(other), place.abs_diff(other));
                if (1..=2).contains(&by) && self.band[place] == self.band[other] {
                    self.next[by - 1][first] += stiffness * (weight * other_weight);
                }
            }
        }
    }

    /// The block between a vertex and the one that comes `by` later.
    fn between(&self, place: usize, by: usize, matrix: &Matrix) -> DMat3 {
        let is_free = |place: usize| !matrix.is_fixed[self.vertices[place] as usize];
        if self.band[place] == self.band[place + by] && is_free(place) && is_free(place + by) {
            self.next[by - 1][place]
        } else {
            DMat3::ZERO
        }
    }
}

impl BandFactors {
    /// Factorises the bands of a matrix.
    pub(super) fn factorise(&mut self, matrix: &Matrix) {
        let bands = &matrix.bands;
        for blocks in [&mut self.inverse, &mut self.beside].into_iter().chain(&mut self.lower) {
            blocks.resize(bands.vertices.len(), DMat3::ZERO);
        }
        for k in 0..bands.vertices.len() {
            let vertex = bands.vertices[k] as usize;
            let mut own = matrix.beside_ropes[vertex].as_dmat3() + bands.own[k];
            if k >= 2 {
                let above = bands.between(k - 2, 2, matrix);
                self.lower[1][k] = above.transpose() * self.inverse[k - 2];
                own -= self.lower[1][k] * above;
            }
            if k >= 1 {
                let mut rest = bands.between(k - 1, 1, matrix).transpose();
                if k >= 2 {
                    rest -= self.lower[1][k] * self.beside[k - 1].transpose();
                }
                self.beside[k] = rest;
                self.lower[0][k] = rest * self.inverse[k - 1];
                own -= self.lower[0][k] * rest.transpose();
            }
            // Rounding differences of the other half would grow from vertex to vertex.
            own = (own + own.transpose()) * 0.5;
            let inverse = if matrix.is_fixed[vertex] { DMat3::ZERO } else { own.inverse() };
            self.inverse[k] = if inverse.is_finite() { inverse } else { DMat3::ZERO };
        }
    }

    /// Replaces the image of the bands' vertices by the solution for this residual.
    pub(super) fn solve(&mut self, bands: &Bands, residual: &[Vec3A], image: &mut [Vec3A]) {
        let Self {
            inverse, lower, work, ..
        } = self;
        work.clear();
        for (k, &vertex) in bands.vertices.iter().enumerate() {
            let mut value = residual[vertex as usize].as_dvec3();
            for by in 1..=k.min(2) {
                value -= lower[by - 1][k] * work[k - by];
            }
            work.push(value);
        }
        for k in (0..work.len()).rev() {
            let mut value = inverse[k] * work[k];
            for by in 1..=2 {
                if let Some(&after) = work.get(k + by) {
                    value -= lower[by - 1][k + by].transpose() * after;
                }
            }
            work[k] = value;
            image[bands.vertices[k] as usize] = value.as_vec3a();
        }
    }
}
