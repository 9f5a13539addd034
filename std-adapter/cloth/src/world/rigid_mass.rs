//! The mass of a rigid body, from its mesh.
//!
//! A closed surface is a solid of even density: mass, centre and inertia are those of the tetrahedra from a point to its
//! triangles. An open one, which has no inside, is a thin shell of even mass per area.

use crate::input::{AIR_DENSITY, Field, MASS, ValueError};
use crate::model::rigid::{Freedom, RigidState, outer};
use crate::model::triangle_edges::is_closed;
use selvedge::Mesh;
use selvedge_core::glam::{DMat3, DVec3};

/// How heavy a [free](crate::FreeMotion) body is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyMass {
    /// A mass, in kg.
    Mass(f64),
    /// A density, in kg/m³. The mesh must be closed.
    Density(f64),
}

crate::identify!(enum BodyMass { 0 => Mass(mass), 1 => Density(density) });

pub(super) const MASS_FIELD: Field = Field::new("mass", MASS, 1e-6, 1e6);
pub(super) const DENSITY_FIELD: Field = Field::new("density", AIR_DENSITY, 1e-2, 1e5);

/// The mass of a rigid body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RigidMass {
    /// The mass, in kg.
    pub(crate) mass: f64,
    /// The centre of mass at rest.
    pub(crate) centre: DVec3,
    /// The inertia about it in the axes of the body, in kg·m².
    pub(crate) inertia: DMat3,
}

/// Sums over the parts of a body of even density.
struct Sums {
    /// The volume or area, its first moment, and its second moments.
    size: f64,
    first: DVec3,
    second: DMat3,
}

impl Sums {
    /// Adds a simplex of so many corners, from its corners and its volume or area.
    fn add(&mut self, corners: &[DVec3], size: f64) {
        let count = corners.len() as f64;
        let sum: DVec3 = corners.iter().sum();
        self.size += size;
        self.first += sum * (size / count);
        // ∫x·xᵀ of a simplex with n corners is (Σ v·vᵀ + s·sᵀ)·size/(n(n + 1)), with the sum s of its corners.
        let own = corners
            .iter()
            .fold(outer(sum, sum), |all, &corner| all + outer(corner, corner));
        self.second += own * (size / (count * (count + 1.0)));
    }
}

impl RigidMass {
    /// Finds the mass of a body from its mesh.
    ///
    /// # Errors
    /// Returns an error if the mesh is open but has a density, or has no size.
    pub(crate) fn new(mass: BodyMass, mesh: &Mesh) -> Result<Self, ValueError> {
        let Mesh { positions, triangles } = mesh;
        let is_closed = is_closed(triangles);
        let reference = positions.iter().sum::<DVec3>() / positions.len().max(1) as f64;
        let mut sums = Sums {
            size: 0.0,
            first: DVec3::ZERO,
            second: DMat3::ZERO,
        };
        for triangle in triangles {
            let [a, b, c] = triangle.map(|vertex| positions[vertex as usize] - reference);
            if is_closed {
                sums.add(&[DVec3::ZERO, a, b, c], a.dot(b.cross(c)) / 6.0);
            } else {
                sums.add(&[a, b, c], 0.5 * (b - a).cross(c - a).length());
            }
        }
        // A surface that faces inwards has the same inside.
        let Sums { size, first, second } = sums;
        let all = match mass {
            BodyMass::Mass(mass) => mass,
            BodyMass::Density(_) if !is_closed => {
                let message = "the mesh has open edges and encloses nothing, so it has no density: close it (`weld` merges vertices \
                               in the same place), or give its `mass`";
                return Err(ValueError::new(DENSITY_FIELD.name, message));
            }
            BodyMass::Density(density) => density * size.abs(),
        };
        let centre = first / size;
        let second = (second * size.recip() - outer(centre, centre)) * all;
        let trace = second.x_axis.x + second.y_axis.y + second.z_axis.z;
        let inertia = DMat3::from_diagonal(DVec3::splat(trace)) - second;
        let is_of_size = all > 0.0 && centre.is_finite() && inertia.determinant() > 0.0 && inertia.is_finite();
        if !is_of_size {
            let name = match mass {
                BodyMass::Mass(_) => MASS_FIELD.name,
                BodyMass::Density(_) => DENSITY_FIELD.name,
            };
            return Err(ValueError::new(
                name,
                "a free body needs a mesh with an area, which is not a line",
            ));
        }
        Ok(Self {
            mass: all,
            centre: centre + reference,
            inertia,
        })
    }
}

impl RigidMass {
    /// Returns the mass of a body with points of these masses, in kg, at these places in its axes.
    pub(super) fn with(&self, points: &[(DVec3, f64)]) -> Self {
        let moment = |(place, mass): &(DVec3, f64)| *place * *mass;
        let mass = self.mass + points.iter().map(|(_, mass)| mass).sum::<f64>();
        let centre = (self.centre * self.mass + points.iter().map(moment).sum::<DVec3>()) / mass;
        // The inertia of a point at the arm q is m·(q²·1 − q·qᵀ).
        let of_point = |place: DVec3, mass: f64| {
            let arm = place - centre;
            (DMat3::from_diagonal(DVec3::splat(arm.length_squared())) - outer(arm, arm)) * mass
        };
        let own = self.inertia + of_point(self.centre, self.mass);
        let inertia = points.iter().fold(own, |sum, &(place, mass)| sum + of_point(place, mass));
        Self { mass, centre, inertia }
    }

    /// Returns the angular velocity in a state, in rad/s.
    pub(super) fn spin(&self, state: &RigidState, freedom: &Freedom) -> DVec3 {
        freedom.inverse_inertia(&state.turned(&self.inertia)) * state.momentum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::shapes;

    /// A box of these sides whose lowest corner is at `corner`, facing outwards.
    fn cuboid(corner: DVec3, sides: DVec3) -> Mesh {
        let at = |k: usize| corner + sides * DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64);
        let quads = [
            [0, 2, 3, 1],
            [4, 5, 7, 6],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 4, 6, 2],
            [1, 3, 7, 5],
        ];
        let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]);
        Mesh::new((0..8).map(at).collect(), triangles.collect())
    }

    #[test]
    fn a_box_has_the_mass_the_centre_and_the_inertia_of_the_text_book() {
        let sides = DVec3::new(0.1, 0.2, 0.3);
        let own = RigidMass::new(BodyMass::Density(500.0), &cuboid(DVec3::new(5.0, -3.0, 1.0), sides)).unwrap();
        let mass = 500.0 * 0.006;
        assert!((own.mass - mass).abs() < 1e-12);
        assert!(own.centre.distance(DVec3::new(5.05, -2.9, 1.15)) < 1e-14);
        let [x, y, z] = (sides * sides).to_array();
        let diagonal = DVec3::new(y + z, z + x, x + y) * (mass / 12.0);
        let difference = own.inertia - DMat3::from_diagonal(diagonal);
        assert!(difference.to_cols_array().iter().all(|number| number.abs() < 1e-12));
        let mut inwards = cuboid(DVec3::new(5.0, -3.0, 1.0), sides);
        inwards.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        let inwards = RigidMass::new(BodyMass::Mass(mass), &inwards).unwrap();
        assert!((inwards.inertia.x_axis.x - diagonal.x).abs() < 1e-12);
    }

    #[test]
    fn an_open_sheet_is_a_plate_which_has_a_mass_but_no_density() {
        let plate = shapes::sheet(DVec3::ZERO, [DVec3::X * 0.2, DVec3::Y * 0.4], [3, 5]);
        let own = RigidMass::new(BodyMass::Mass(3.0), &plate).unwrap();
        assert!(own.centre.distance(DVec3::new(0.1, 0.2, 0.0)) < 1e-14);
        let expected = DVec3::new(0.16, 0.04, 0.2) * (3.0 / 12.0);
        let difference = own.inertia - DMat3::from_diagonal(expected);
        assert!(difference.to_cols_array().iter().all(|number| number.abs() < 1e-12));
        let error = RigidMass::new(BodyMass::Density(3.0), &plate).unwrap_err();
        assert_eq!(error.field, "density");
        let line = Mesh::new([0.0, 1.0, 2.0].map(|x| DVec3::X * x).to_vec(), vec![[0, 1, 2]]);
        assert!(RigidMass::new(BodyMass::Mass(1.0), &line).is_err());
    }
}
