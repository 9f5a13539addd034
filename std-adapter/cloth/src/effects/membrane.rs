//! What the effects in the plane of the cloth have in common.

use crate::schedule::On;
use crate::world::Cloth;
use selvedge_core::glam::DVec3;

/// The material directions of a triangle of cloth (Baraff and Witkin 1998): positions xᵢ give the images
/// w_u = Σaᵢxᵢ of a unit of warp and w_v = Σbᵢxᵢ of a unit of weft. At rest both have length one and are perpendicular. The
/// coefficients of each sum to zero: of three, the last two are here.
#[derive(Clone, Copy, Debug)]
pub(super) struct Membrane {
    pub(super) a: [f64; 2],
    pub(super) b: [f64; 2],
}

/// Σcᵢxᵢ.
#[inline(always)]
pub(super) fn image(c: [f64; 2], x: [DVec3; 3]) -> DVec3 {
    (x[1] - x[0]) * c[0] + (x[2] - x[0]) * c[1]
}

/// All three coefficients.
#[inline(always)]
pub(super) fn all(c: [f64; 2]) -> [f64; 3] {
    [-c[0] - c[1], c[0], c[1]]
}

/// A constraint for each triangle, made from its material directions and its area at rest, in m².
pub(super) fn of_triangles<C>(cloth: &Cloth, constraint: impl Fn(Membrane, f64) -> C) -> Vec<On<C, 3>> {
    let make = |&vertices: &[u32; 3]| {
        let [p, q, r] = vertices.map(|v| cloth.mesh.positions[v as usize]);
        let (first, second) = (q - p, r - p);
        let cross = first.cross(second);
        let normal = cross.normalize();
        // The warp as far as it lies in the triangle; a side where it does not.
        let along = cloth.warp - normal * normal.dot(cloth.warp);
        let along = if along.length() > 1e-3 * cloth.warp.length() {
            along.normalize()
        } else {
            first.normalize()
        };
        let across = normal.cross(along);
        let (pu, pv) = (first.dot(along), first.dot(across));
        let (qu, qv) = (second.dot(along), second.dot(across));
        let scale = 1.0 / (pu * qv - qu * pv);
        let membrane = Membrane {
            a: [qv * scale, -pv * scale],
            b: [-qu * scale, pu * scale],
        };
        (vertices, constraint(membrane, 0.5 * cross.length()))
    };
    cloth.mesh.triangles.iter().map(make).collect()
}

/// The triangles of each vertex, and the share of each in the vertex's mass.
#[derive(Debug)]
pub(super) struct Incidence {
    starts: Vec<u32>,
    triangles: Vec<(u32, f64)>,
}

impl Incidence {
    pub(super) fn new(cloth: &Cloth) -> Self {
        let mesh = &cloth.mesh;
        let mut starts = vec![0_u32; mesh.positions.len() + 1];
        for &vertex in mesh.triangles.iter().flatten() {
            starts[vertex as usize + 1] += 1;
        }
        for vertex in 1..starts.len() {
            starts[vertex] += starts[vertex - 1];
        }
        let mut next = starts.clone();
        let mut triangles = vec![(0, 0.0); mesh.triangles.len() * 3];
        for (index, triangle) in mesh.triangles.iter().enumerate() {
            let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
            let area = (b - a).cross(c - a).length();
            for &vertex in triangle {
                let place = &mut next[vertex as usize];
                triangles[*place as usize] = (index as u32, area);
                *place += 1;
            }
        }
        let mut incidence = Self { starts, triangles };
        for vertex in 0..incidence.len() {
            let range = incidence.range(vertex);
            let around = &mut incidence.triangles[range];
            let all: f64 = around.iter().map(|(_, area)| area).sum();
            around.iter_mut().for_each(|(_, share)| *share /= all);
        }
        incidence
    }

    /// Vertices.
    pub(super) fn len(&self) -> usize {
        self.starts.len() - 1
    }

    pub(super) fn of(&self, vertex: usize) -> &[(u32, f64)] {
        &self.triangles[self.range(vertex)]
    }

    fn range(&self, vertex: usize) -> std::ops::Range<usize> {
        self.starts[vertex] as usize..self.starts[vertex + 1] as usize
    }
}
