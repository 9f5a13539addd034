//! Untangling in the form that the simulation calls before its first step.

use super::contours::Contours;
use super::solver::ContactSolver;
use crate::model::step::FREE;
use crate::model::triangle_edges::is_closed;
use selvedge::Topology;
use selvedge_core::glam::DVec3;

/// The directions in which tangled cloth comes apart.
#[derive(Debug)]
pub(crate) struct Untangler {
    contours: Contours,
    /// The sign of the normals of each body's triangles that point outwards; zero if the body is not closed.
    outward: Vec<f64>,
}

impl ContactSolver {
    /// Makes the untangler of these positions.
    pub(crate) fn untangler(&self, positions: &[DVec3]) -> Untangler {
        let interest = self.candidates.interest();
        let topology = interest.topology();
        let mut triangles = vec![Vec::new(); self.exempt.yielding.len()];
        for triangle in topology.triangles() {
            let body = interest.body(triangle[0]);
            if body != FREE {
                triangles[body as usize].push(*triangle);
            }
        }
        Untangler {
            contours: Contours::new(topology, positions),
            outward: triangles.iter().map(|own| outward(own, positions)).collect(),
        }
    }

    /// Ends untangling: from here on the present distances count as distances at rest, which those of the scene cannot. Counts
    /// and times start at zero.
    pub(crate) fn end_untangling(&mut self, positions: &[DVec3]) {
        self.rest.copy_from_slice(positions);
        self.pushes = true;
        (self.counts, self.stages) = Default::default();
    }

    /// Sets whether contacts push.
    pub(crate) fn set_pushes(&mut self, pushes: bool) {
        self.pushes = pushes;
    }
}

impl Untangler {
    /// Replaces `directions` by the direction in which each vertex should move; see [`Contours::find_directions`].
    pub(crate) fn find_directions(&mut self, contact: &ContactSolver, positions: &[DVec3], directions: &mut [DVec3]) {
        let interest = contact.candidates.interest();
        let topology: &Topology = interest.topology();
        let outward = |vertex: u32| match interest.body(vertex) {
            FREE => 0.0,
            body => self.outward[body as usize],
        };
        self.contours
            .find_directions(topology, contact.exempt.intersections(), positions, outward, directions);
    }
}

/// See [`Untangler`].
fn outward(triangles: &[[u32; 3]], positions: &[DVec3]) -> f64 {
    let volume = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
        a.cross(b).dot(c)
    };
    let volume: f64 = triangles.iter().map(volume).sum();
    if is_closed(triangles) && volume != 0.0 {
        volume.signum()
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::capsule;

    #[test]
    fn the_way_out_of_a_body_is_known_if_it_is_closed() {
        let mesh = capsule([DVec3::ZERO, DVec3::X], 0.3, 12);
        assert_eq!(outward(&mesh.triangles, &mesh.positions), 1.0);
        let turned: Vec<_> = mesh.triangles.iter().map(|&[a, b, c]| [a, c, b]).collect();
        assert_eq!(outward(&turned, &mesh.positions), -1.0);
        assert_eq!(outward(&mesh.triangles[1..], &mesh.positions), 0.0);
        let mixed = [&mesh.triangles[..5], &turned[5..]].concat();
        assert_eq!(outward(&mixed, &mesh.positions), 0.0);
    }
}
