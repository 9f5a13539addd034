//! The triangles of a cloth and their stretch, as effects in the plane of the cloth use them.

use crate::model::schedule::On;
use crate::world::Cloth;
use crate::world::Incidence;
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

/// Makes a constraint for each triangle from its material directions and its area at rest, in m².
pub(crate) fn of_triangles<C>(cloth: &Cloth, constraint: impl Fn(Membrane, f64) -> C) -> Vec<On<C, 3>> {
    let make = |&vertices: &[u32; 3]| {
        let Flat { membrane, area, .. } = Flat::new(cloth, vertices);
        (vertices, constraint(membrane, area))
    };
    cloth.mesh.triangles.iter().map(make).collect()
}

/// The stretch of a triangle: its square is middle + half·cos 2φ + shear·sin 2φ at an angle of φ to the warp.
///
/// A deformation takes warp and weft to w_u and w_v, and the direction d to d_u·w_u + d_v·w_v. So squares are a quadratic form of
/// d, [[w_u·w_u, w_u·w_v], [w_u·w_v, w_v·w_v]]. Its first eigenvector is the principal direction, in which the stretch is
/// largest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SquaredStretch {
    middle: f64,
    half: f64,
    shear: f64,
}

impl SquaredStretch {
    #[inline(always)]
    pub(crate) fn new(membrane: Membrane, x: [DVec3; 3]) -> Self {
        let (warp, weft) = (image(membrane.a, x), image(membrane.b, x));
        let (uu, uv, vv) = (warp.dot(warp), warp.dot(weft), weft.dot(weft));
        Self {
            middle: 0.5 * (uu + vv),
            half: 0.5 * (uu - vv),
            shear: uv,
        }
    }

    /// Returns an upper bound of the squared stretch, since a length is at most the sum of its parts.
    #[inline(always)]
    pub(crate) fn bound(self) -> f64 {
        self.middle + self.half.abs() + self.shear.abs()
    }

    /// Returns the square of the largest stretch.
    #[inline(always)]
    pub(crate) fn largest(self) -> f64 {
        self.middle + (self.half * self.half + self.shear * self.shear).sqrt()
    }

    /// Returns the largest stretch, not squared, and a vector of some length in its direction, along warp and weft. The vector is
    /// the one of the eigenvector's two forms that does not cancel.
    #[inline(always)]
    pub(crate) fn principal(self) -> (f64, [f64; 2]) {
        let Self { middle, half, shear } = self;
        let spread = (half * half + shear * shear).sqrt();
        let direction = match (half >= 0.0, spread > 0.0) {
            (_, false) => [1.0, 0.0],
            (true, _) => [half + spread, shear],
            (false, _) => [shear, spread - half],
        };
        ((middle + spread).sqrt(), direction)
    }
}

/// Returns the triangles of each vertex, with the share of each in the vertex's mass.
pub(crate) fn triangles_around(cloth: &Cloth) -> Incidence<(u32, f64)> {
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
    let mut around = Incidence::new(mesh.positions.len(), corners);
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
