//! Normal cones: they show which closest points of a body lie on its surface, and not only on one of its faces or edges.
//!
//! A flat body of many triangles has many edges and vertices that do not matter to cloth that slides on it. A push from such an
//! edge would be oblique: it would hold the cloth back and throw it up. Let d be the way from the closest point of a feature to
//! the cloth. It is in the feature's *normal cone* if no way along the surface leads nearer to the cloth:
//!
//! * a vertex: d·e ≤ 0 for each edge e that leaves it;
//! * an edge: d·p ≤ 0 for each face beside it, with p in the face, perpendicular to the edge, towards the face;
//! * a face: always, as d is its normal.
//!
//! **It is safe to drop the others.** If the way leaves the cone, another feature of the body is strictly nearer to the same
//! cloth. That feature makes another pair, and the nearest of all such pairs is never dropped. This also holds for concave, open
//! and non-manifold surfaces. The test looks at edges and faces one by one, and needs no normals and no orientation. It concerns
//! pushes alone: certificates look at every pair.
//!
//! Cones are those of surfaces at the start of the step, so that bodies may change their shape.
//!
//! **A contact at rest goes on.** Taut cloth lies along faces of a body's mesh. An edge beside such a face has a cone that ends
//! at the face's normal, and the cloth lies there. Such a contact would come and go from step to step, and the cloth would
//! tremble: an irregular bag around two balls moved by 14 cm/s (law of the bag). So a contact that pushed in the last step pushes
//! on. Its direction [turns into the cone](NormalCones::turn_into), to the normal of a face beside it. So it does not push
//! obliquely.
//!
//! **Cloth against cloth.** Oblique pushes make layers that lie on each other slide and tremble. But a fold lies beside itself,
//! and cones on both sides would drop the pairs that keep it open, since the way along the cloth leads through the fold. So the
//! test looks at the face of a vertex-face pair alone, which keeps all pairs whose foot is inside the face. It leaves out edges
//! that cross, and these push. Where an end of an edge is closest, that vertex pushes against the faces beside the other edge.

use crate::model::length::length;
use selvedge::Topology;
use selvedge_core::glam::DVec3;

/// Weights below this count as zero: the closest point is on the feature without that vertex.
const LEAST_WEIGHT: f64 = 1e-9;
/// The sine of the angle up to which a way counts as within the cone. Faces in a plane have a sine of zero, apart from rounding.
/// This is about 10⁻¹⁶ times coordinates over distance, below this value for coordinates up to 10⁷ times the distance.
const TOLERANCE: f64 = 1e-6;
const NONE: u32 = u32::MAX;

/// The edges that leave each vertex of a mesh, with the faces beside them.
#[derive(Debug, Default)]
pub(super) struct NormalCones {
    /// The index of the first spoke of each vertex, and the end of all spokes.
    first: Vec<u32>,
    spokes: Vec<Spoke>,
}

/// An edge from a vertex, and up to two corners opposite it; an edge with more faces has several spokes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Spoke {
    to: u32,
    opposite: [u32; 2],
}

impl NormalCones {
    /// Finds the spokes of all vertices.
    pub(super) fn new(topology: &Topology) -> Self {
        let mut sides: Vec<[u32; 3]> = Vec::new();
        for &[a, b, c] in topology.triangles() {
            for [from, to, opposite] in [[a, b, c], [b, c, a], [c, a, b]] {
                sides.push([from, to, opposite]);
                sides.push([to, from, opposite]);
            }
        }
        sides.sort_unstable();
        let mut cones = Self::default();
        let mut sides = sides.chunk_by(|one, other| one[..2] == other[..2]).peekable();
        for vertex in 0..topology.vertex_count() as u32 {
            cones.first.push(cones.spokes.len() as u32);
            while let Some(own) = sides.next_if(|own| own[0][0] == vertex) {
                for two in own.chunks(2) {
                    cones.spokes.push(Spoke {
                        to: own[0][1],
                        opposite: [two[0][2], two.get(1).map_or(NONE, |side| side[2])],
                    });
                }
            }
        }
        cones.first.push(cones.spokes.len() as u32);
        cones
    }

    fn of(&self, vertex: u32) -> &[Spoke] {
        let vertex = vertex as usize;
        &self.spokes[self.first[vertex] as usize..self.first[vertex + 1] as usize]
    }

    /// Returns whether all vertices with these weights take part: none of them is only an end.
    pub(super) fn are_all(weights: &[f64]) -> bool {
        weights.iter().all(|weight| weight.abs() > LEAST_WEIGHT)
    }

    /// Returns whether an edge belongs to a face; a loose one does not.
    pub(super) fn is_beside_a_face(&self, edge: &[u32]) -> bool {
        self.of(edge[0]).iter().any(|spoke| spoke.to == edge[1])
    }

    /// Returns whether a direction is in the normal cone at the point with these weights of these vertices.
    pub(super) fn contain(&self, vertices: &[u32], weights: &[f64], positions: &[DVec3], direction: DVec3) -> bool {
        self.all_tangents(vertices, weights, positions, |tangent| {
            direction.dot(tangent) <= TOLERANCE * length(tangent)
        })
    }

    /// Turns a direction into the normal cone at the point with these weights of these vertices: it loses what leads along the
    /// surface. A direction in the cone stays as it is. Returns `None` if the result is not in the cone, or the surface is flat
    /// there.
    pub(super) fn turn_into(&self, vertices: &[u32], weights: &[f64], positions: &[DVec3], direction: DVec3) -> Option<DVec3> {
        let mut turned = direction;
        self.all_tangents(vertices, weights, positions, |tangent| {
            turned -= tangent * (turned.dot(tangent).max(0.0) / tangent.length_squared());
            true
        });
        let turned = turned.normalize_or_zero();
        let is_flat = self.all_tangents(vertices, weights, positions, |tangent| {
            turned.dot(tangent) >= -TOLERANCE * length(tangent)
        });
        (!is_flat && self.contain(vertices, weights, positions, turned)).then_some(turned)
    }

    /// Returns whether something is true of all ways along the surface from the point with these weights of these vertices.
    fn all_tangents(
        &self,
        vertices: &[u32],
        weights: &[f64],
        positions: &[DVec3],
        mut is_true: impl FnMut(DVec3) -> bool,
    ) -> bool {
        let mut on = [NONE; 3];
        let mut count = 0;
        for (&vertex, &weight) in vertices.iter().zip(weights) {
            if weight.abs() > LEAST_WEIGHT {
                on[count] = vertex;
                count += 1;
            }
        }
        let at = |vertex: u32| positions[vertex as usize];
        match on[..count] {
            [vertex] => self.of(vertex).iter().all(|spoke| is_true(at(spoke.to) - at(vertex))),
            [from, to] => {
                let edge = at(to) - at(from);
                let squared = edge.length_squared();
                let beside = self.of(from).iter().filter(|spoke| spoke.to == to);
                let mut opposite = beside.flat_map(|spoke| spoke.opposite).filter(|&vertex| vertex != NONE);
                opposite.all(|vertex| {
                    let tangent = at(vertex) - at(from);
                    is_true(tangent - edge * (tangent.dot(edge) / squared))
                })
            }
            _ => true,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles beside the edge from 0 to 1, with these other corners.
    fn ridge(left: DVec3, right: DVec3) -> (NormalCones, Vec<DVec3>) {
        let topology = Topology::new(4, vec![[0, 1, 2], [1, 0, 3]]).unwrap();
        (NormalCones::new(&topology), vec![DVec3::ZERO, DVec3::Y, left, right])
    }

    fn contains(ridge: &(NormalCones, Vec<DVec3>), direction: DVec3) -> [bool; 2] {
        let (cones, positions) = ridge;
        let direction = direction.normalize();
        let contain = |weights: &[f64]| cones.contain(&[0, 1, 2], weights, positions, direction);
        [contain(&[0.5, 0.5, 0.0]), contain(&[1.0, 0.0, 0.0])]
    }

    #[test]
    fn an_edge_in_a_plane_has_the_normal_alone_and_a_ridge_what_is_between_its_normals() {
        let flat = ridge(DVec3::new(-1.0, 0.5, 0.0), DVec3::new(1.0, 0.5, 0.0));
        assert_eq!(contains(&flat, DVec3::Z), [true; 2]);
        assert_eq!(contains(&flat, -DVec3::Z), [true; 2], "from below as well");
        assert_eq!(contains(&flat, DVec3::new(0.01, 0.0, 1.0)), [false; 2]);
        let convex = ridge(DVec3::new(-1.0, 0.5, -1.0), DVec3::new(1.0, 0.5, -1.0));
        assert!(contains(&convex, DVec3::new(0.9, 0.0, 1.0))[0]);
        assert!(!contains(&convex, DVec3::new(1.1, 0.0, 1.0))[0]);
        assert!(contains(&convex, DVec3::new(0.0, -0.5, 1.0))[1], "beyond the end of the edge");
        let concave = ridge(DVec3::new(-1.0, 0.5, 1.0), DVec3::new(1.0, 0.5, 1.0));
        assert!(!contains(&concave, DVec3::Z)[0]);
    }

    #[test]
    fn a_direction_turns_into_a_cone_and_stays_there_and_a_flat_or_concave_edge_has_none() {
        let turn = |(cones, positions): &(NormalCones, Vec<DVec3>), direction: DVec3| {
            cones.turn_into(&[0, 1, 2], &[0.5, 0.5, 0.0], positions, direction.normalize())
        };
        let convex = ridge(DVec3::new(-1.0, 0.5, -1.0), DVec3::new(1.0, 0.5, -1.0));
        let normal = DVec3::new(1.0, 0.0, 1.0).normalize();
        let turned = turn(&convex, DVec3::new(1.2, 0.0, 1.0)).unwrap();
        assert!(
            turned.distance(normal) < 1e-12,
            "the normal of the face that is nearer: {turned}"
        );
        let within = DVec3::new(0.5, 0.0, 1.0).normalize();
        assert!(turn(&convex, within).unwrap().distance(within) < 1e-12);
        let flat = ridge(DVec3::new(-1.0, 0.5, 0.0), DVec3::new(1.0, 0.5, 0.0));
        assert_eq!(turn(&flat, DVec3::new(0.1, 0.0, 1.0)), None);
        let concave = ridge(DVec3::new(-1.0, 0.5, 1.0), DVec3::new(1.0, 0.5, 1.0));
        assert_eq!(turn(&concave, DVec3::Z), None);
    }

    #[test]
    fn an_open_edge_has_a_half_space_and_three_faces_are_all_asked() {
        let open = Topology::new(3, vec![[0, 1, 2]]).unwrap();
        let cones = NormalCones::new(&open);
        let positions = [DVec3::ZERO, DVec3::Y, DVec3::new(1.0, 0.5, 0.0)];
        let contain = |direction: DVec3| cones.contain(&[0, 1, 2], &[0.5, 0.5, 0.0], &positions, direction.normalize());
        assert!(contain(-DVec3::X) && contain(DVec3::Z) && !contain(DVec3::new(0.1, 0.0, 1.0)));
        let three = Topology::new(5, vec![[0, 1, 2], [0, 1, 3], [1, 0, 4]]).unwrap();
        let cones = NormalCones::new(&three);
        let at = |x: f64, z: f64| DVec3::new(x, 0.5, z);
        for last in [at(0.0, 1.0), at(-1.0, 0.2)] {
            let positions = [DVec3::ZERO, DVec3::Y, at(-1.0, -1.0), at(1.0, -1.0), last];
            let up = cones.contain(&[0, 1, 2], &[0.5, 0.5, 0.0], &positions, DVec3::Z);
            assert!(!up, "a third face leads up: {last}");
        }
        let without = [DVec3::ZERO, DVec3::Y, at(-1.0, -1.0), at(1.0, -1.0), at(0.0, -1.0)];
        assert!(cones.contain(&[0, 1, 2], &[0.5, 0.5, 0.0], &without, DVec3::Z));
    }
}
