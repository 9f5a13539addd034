//! Pressure on a cloth.
//!
//! V = ⅙Σ a·(b × c) is the volume that the triangles enclose. A pressure p stores −p·V, and pushes each corner by p/6·(b − a) ×
//! (c − a), a third of the triangle's share. This is the gradient of the volume where the border is closed or held.
//!
//! * **A given pressure**: −p·V. If vertices at an open border move, alone or with a free body, the push has no potential. Then
//!   it is constant within a Newton step.
//! * **A gas** with the bulk modulus K and the volume V₀ without pressure: ½K(V − V₀)²/V₀.
//!
//! **Second derivative.** The block between corners i and j with the third corner k is ±p/6·[x_k − (x_i + x_j)/2]×, and none for
//! a corner itself. It is indefinite, but cancels the stiffness that tension pretends for turns of the surface; so it is used for
//! taut closed cloth, and left out where it makes the matrix indefinite. A gas adds K/V₀·∇V·∇Vᵀ.

use super::matrix::{Matrix, PAIRS};
use super::term::{Prediction, Renewed, Term};
use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::TimeStep;
use crate::model::triangle_edges::{edges_of, undirected};
use crate::world::{Cloth, Kinematic};
use selvedge_core::glam::{DVec3, Mat3A, Vec3A};
use std::fmt::Debug;

/// What fills a cloth.
pub(crate) trait Filling: Debug + Send + Sync {
    /// Returns what fills the cloth at the end of a step, at this time in seconds.
    fn at(&self, time: f64) -> Gas;
}

/// A gas in a cloth.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Gas {
    /// A pressure in Pa, above that of the air.
    Pressure(f64),
    /// A bulk modulus in Pa, and the volume without pressure, in m³.
    Volume { modulus: f64, volume: f64 },
}

/// The walls of a cloth under pressure.
#[derive(Debug)]
pub(crate) struct Walls<F> {
    filling: F,
    triangles: Vec<[u32; 3]>,
    first_triangle: usize,
    /// The cloth's first vertex, and the vertex after its last.
    vertices: [usize; 2],
    /// The vertices of open edges, in order.
    border: Vec<u32>,
    gas: Gas,
    /// True if the solve moves a vertex of the border.
    is_open: bool,
    /// The volume, its gradient, and the pressure at the last positions, or where the push was renewed last.
    volume: f64,
    of_volume: Vec<DVec3>,
    pressure: f64,
}

impl<F> Walls<F> {
    pub(crate) fn new(filling: F, cloth: &Cloth, first_vertex: u32, first_triangle: usize) -> Self {
        let first = first_vertex as usize;
        let triangles = &cloth.mesh.triangles;
        let mut edges: Vec<_> = edges_of(triangles).map(undirected).collect();
        edges.sort_unstable();
        let open = edges.chunk_by(|one, other| one == other).filter(|same| same.len() == 1);
        let mut border: Vec<u32> = open.flat_map(|same| same[0]).map(|vertex| vertex + first_vertex).collect();
        border.sort_unstable();
        border.dedup();
        Self {
            filling,
            border,
            triangles: triangles
                .iter()
                .map(|corners| corners.map(|vertex| vertex + first_vertex))
                .collect(),
            first_triangle,
            vertices: [first, first + cloth.mesh.positions.len()],
            gas: Gas::Pressure(0.0),
            is_open: false,
            volume: 0.0,
            of_volume: Vec::new(),
            pressure: 0.0,
        }
    }

    /// Finds volume, gradient and pressure.
    fn look(&mut self, x: &[DVec3]) {
        let [first, end] = self.vertices;
        self.of_volume.clear();
        self.of_volume.resize(end - first, DVec3::ZERO);
        let origin = x[self.origin()];
        let mut volume = 0.0;
        for corners in &self.triangles {
            let [a, b, c] = corners.map(|vertex| x[vertex as usize]);
            volume += (a - origin).dot((b - origin).cross(c - origin));
            let third = (b - a).cross(c - a) / 6.0;
            for &vertex in corners {
                self.of_volume[vertex as usize - first] += third;
            }
        }
        self.volume = volume / 6.0;
        self.pressure = match self.gas {
            Gas::Pressure(pressure) => pressure,
            Gas::Volume { modulus, volume } => -modulus * (self.volume - volume) / volume,
        };
    }

    /// Returns the vertex to which volumes are relative, so that they do not depend on the cloth's position. The volume of a
    /// cloth with a border depends on this vertex, too, but no push comes from that. So it must not move within a step: it is a
    /// vertex of the border, which is held.
    fn origin(&self) -> usize {
        self.border.first().map_or(self.vertices[0], |&vertex| vertex as usize)
    }

    fn energy_now(&self, x: &[DVec3]) -> f64 {
        let [first, end] = self.vertices;
        match self.gas {
            Gas::Pressure(_) if self.is_open => {
                let each = self.of_volume.iter().zip(&x[first..end]);
                -self.pressure * each.map(|(of_volume, x)| of_volume.dot(*x)).sum::<f64>()
            }
            Gas::Pressure(pressure) => -pressure * self.volume,
            Gas::Volume { modulus, volume } => 0.5 * modulus * (self.volume - volume).powi(2) / volume,
        }
    }

    fn push(&self, by: f64, gradient: &mut [DVec3]) {
        let [first, end] = self.vertices;
        for (gradient, of_volume) in gradient[first..end].iter_mut().zip(&self.of_volume) {
            *gradient -= *of_volume * (by * self.pressure);
        }
    }
}

impl<F: Filling> Term for Walls<F> {
    fn begin(&mut self, step: &TimeStep<'_>, prediction: &Prediction, x: &[DVec3]) {
        self.gas = self.filling.at(step.time + step.h);
        let is_free = |vertex: &u32| prediction.masses[*vertex as usize] > 0.0;
        // The solve also moves what is pinned to a free body.
        let riders = step
            .motions
            .iter()
            .filter_map(Kinematic::free)
            .flat_map(|body| body.riders.iter());
        let mut riding = riders.filter(|rider| self.border.binary_search(rider).is_ok());
        let moves = self.border.iter().any(is_free) || riding.next().is_some();
        self.is_open = matches!(self.gas, Gas::Pressure(_)) && moves;
        self.look(x);
    }

    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        if !self.is_open {
            self.look(x);
        }
        self.push(1.0, gradient);
        self.energy_now(x)
    }

    fn curvature(&mut self, x: &[DVec3], matrix: &mut Matrix) {
        let [first, end] = self.vertices;
        if let Gas::Volume { modulus, volume } = self.gas {
            let of_volume = &self.of_volume;
            matrix.add_rank_one(modulus / volume.abs(), |direction| {
                for (direction, own) in direction[first..end].iter_mut().zip(of_volume) {
                    *direction = own.as_vec3a();
                }
            });
        }
        if self.is_open || self.pressure <= 0.0 || !matrix.may_be_indefinite {
            return;
        }
        let scale = self.pressure / 6.0;
        for (place, corners) in self.triangles.iter().enumerate() {
            let at = corners.map(|vertex| x[vertex as usize]);
            let block = |[i, j]: [usize; 2]| {
                let sign = if (j + 3 - i) % 3 == 1 { scale } else { -scale };
                cross_matrix(((at[3 - i - j] - (at[i] + at[j]) * 0.5) * sign).as_vec3a())
            };
            let blocks = PAIRS.map(block);
            for (block, [i, j]) in blocks.into_iter().zip(PAIRS) {
                // A corner itself has no block, but the triangle's blocks imply one.
                matrix.add_own(corners[i], block);
                matrix.add_own(corners[j], block.transpose());
            }
            matrix.add_triangle(self.first_triangle + place, blocks);
        }
    }

    fn renew(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> Renewed {
        if !self.is_open {
            return Renewed::default();
        }
        let before = self.energy_now(x);
        self.push(-1.0, gradient);
        self.look(x);
        self.push(1.0, gradient);
        Renewed {
            energy: self.energy_now(x) - before,
            error: 0.0,
        }
    }

    fn is_load(&self) -> bool {
        matches!(self.gas, Gas::Pressure(_))
    }

    /// A closed cloth feels neither a force nor a moment.
    fn is_inner(&self) -> bool {
        self.border.is_empty()
    }

    fn energy(&self, now: &Configuration<'_>, own: usize) -> Vec<(usize, StoredEnergy)> {
        let Gas::Volume { modulus, volume } = self.filling.at(0.0) else {
            return Vec::new();
        };
        let origin = now.positions[self.origin()];
        let parts = self.triangles.iter().map(|corners| {
            let [a, b, c] = corners.map(|vertex| now.positions[vertex as usize] - origin);
            a.dot(b.cross(c))
        });
        let excess = parts.sum::<f64>() / 6.0 - volume;
        vec![(own, StoredEnergy::Elastic(0.5 * modulus * excess * excess / volume.abs()))]
    }
}

/// Returns the matrix of a×.
fn cross_matrix(a: Vec3A) -> Mat3A {
    Mat3A::from_cols(
        Vec3A::new(0.0, a.z, -a.y),
        Vec3A::new(-a.z, 0.0, a.x),
        Vec3A::new(a.y, -a.x, 0.0),
    )
}
