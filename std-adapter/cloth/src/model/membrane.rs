//! The triangles of a cloth and their stretch, as effects in the plane of the cloth use them.

use crate::world::Cloth;
use selvedge::Adjacency;
use selvedge_core::glam::{DVec2, DVec3};

/// The material directions of a triangle of cloth (Baraff and Witkin 1998). Positions xᵢ give the images w_u = Σaᵢxᵢ of a unit of
/// warp and w_v = Σbᵢxᵢ of a unit of weft. At rest both have length one and are perpendicular. The three coefficients of each sum
/// to zero, so only the last two are stored.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Membrane {
    pub(crate) a: [f64; 2],
    pub(crate) b: [f64; 2],
}

/// Returns Σcᵢxᵢ.
#[inline(always)]
pub(crate) fn image(c: [f64; 2], x: [DVec3; 3]) -> DVec3 {
    (x[1] - x[0]) * c[0] + (x[2] - x[0]) * c[1]
}

/// Returns all three coefficients.
#[inline(always)]
pub(crate) fn all(c: [f64; 2]) -> [f64; 3] {
    [-c[0] - c[1], c[0], c[1]]
}

impl Membrane {
    /// Makes the material directions of a triangle at rest from two sides that start at its first vertex, along warp and weft.
    pub(crate) fn new(first: DVec2, second: DVec2) -> Self {
        let scale = 1.0 / first.perp_dot(second);
        Self {
            a: [second.y * scale, -first.y * scale],
            b: [-second.x * scale, first.x * scale],
        }
    }
}

/// Returns the directions of warp and weft in a triangle with these two sides. The warp is projected into the triangle; if it is
/// perpendicular, a side replaces it.
pub(crate) fn warp_and_weft(first: DVec3, second: DVec3, warp: DVec3) -> [DVec3; 2] {
    let normal = first.cross(second).normalize();
    let along = warp - normal * normal.dot(warp);
    let along = if along.length() > 1e-3 * warp.length() {
        along.normalize()
    } else {
        first.normalize()
    };
    [along, normal.cross(along)]
}

/// A triangle of cloth at rest, in its plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flat {
    pub(crate) membrane: Membrane,
    /// The directions of warp and weft.
    directions: [DVec3; 2],
    /// The area, in m².
    pub(crate) area: f64,
}

impl Flat {
    pub(crate) fn new(cloth: &Cloth, triangle: [u32; 3]) -> Self {
        let [p, q, r] = triangle.map(|v| cloth.mesh.positions[v as usize]);
        let (first, second) = (q - p, r - p);
        let directions = warp_and_weft(first, second, cloth.warp);
        let [first_flat, second_flat] = [first, second].map(|side| along(directions, side));
        Self {
            membrane: Membrane::new(first_flat, second_flat),
            directions,
            area: 0.5 * first.cross(second).length(),
        }
    }

    /// Returns the components along warp and weft of the unit vector perpendicular to one of the sides.
    pub(crate) fn across(&self, side: DVec3) -> DVec2 {
        along(self.directions, side).normalize_or_zero().perp()
    }
}

fn along([warp, weft]: [DVec3; 2], side: DVec3) -> DVec2 {
    DVec2::new(side.dot(warp), side.dot(weft))
}

/// Returns the triangles of each vertex, with the share of each in the vertex's mass.
pub(crate) fn triangles_around(cloth: &Cloth) -> Adjacency<(u32, f64)> {
    let mesh = &cloth.mesh;
    let area = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        (b - a).cross(c - a).length()
    };
    let areas: Vec<f64> = mesh.triangles.iter().map(area).collect();
    let all = mesh.triangles.iter().zip(&areas).zip(0..);
    let corners = || {
        all.clone()
            .flat_map(|((triangle, &area), index)| triangle.map(|vertex| (vertex, (index, area))))
    };
    let mut around = Adjacency::new(mesh.positions.len(), corners);
    // The weight of loose edges, as an area of cloth. A vertex has a sixth of each of the areas summed here, which are twice
    // those of the triangles.
    let mut of_edges = vec![0.0; around.len()];
    for edge in cloth.topology.loose_edges() {
        let [a, b] = edge.map(|v| mesh.positions[v as usize]);
        let as_area = 3.0 * cloth.linear_density * a.distance(b) / cloth.density;
        edge.iter().for_each(|&vertex| of_edges[vertex as usize] += as_area);
    }
    for (vertex, of_edges) in of_edges.into_iter().enumerate() {
        let own = around.of_mut(vertex);
        let all = own.iter().map(|(_, area)| area).sum::<f64>() + of_edges;
        own.iter_mut().for_each(|(_, share)| *share /= all);
    }
    around
}
