//! Free rigid bodies: their mass, and their state.
//!
//! A closed surface is a solid of even density: mass, centre and inertia are those of the tetrahedra from a point to its
//! triangles. An open one, which has no inside, is a thin shell of even mass per area.

use super::placement::Placement;
use crate::input::{AIR_DENSITY, ANGULAR_SPEED, Field, MASS, SPEED, SceneError, Table, ValueError};
use crate::model::rigid::{Freedom, NUMBERS, RigidState};
use crate::model::triangle_edges::is_closed;
use selvedge::Mesh;
use selvedge_core::glam::{DMat3, DVec3};
use std::sync::Arc;

/// How heavy a [free](FreeMotion) body is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum BodyMass {
    /// A mass, in kg.
    Mass(f64),
    /// A density, in kg/m³. The mesh must be closed.
    Density(f64),
}

/// The motion of a free rigid body: gravity, contact and friction move it, in the same solve as the cloth.
///
/// Its inertia is that of its mesh: of a solid of even density if the mesh is closed, and of a thin shell if it is open. It meets
/// cloth and other bodies at the thickness of [body contact](crate::effects::BodyContact).
///
/// ```
/// use selvedge_cloth::glam::DVec3;
/// use selvedge_cloth::{Body, BodyMass, FreeMotion};
///
/// let mut ball = Body::ball("ball", DVec3::Z, 0.1, 24)?;
/// let motion = FreeMotion::new(BodyMass::Mass(0.5));
/// ball.motion = FreeMotion { velocity: DVec3::X, ..motion }.into();
/// # Ok::<(), selvedge_cloth::ValueError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreeMotion {
    /// The mass or the density.
    pub mass: BodyMass,
    /// The placement of the mesh at the start.
    pub placement: Placement,
    /// The velocity of the centre of mass at the start, in m/s.
    pub velocity: DVec3,
    /// The angular velocity at the start, in rad/s.
    pub spin: DVec3,
    /// The axes along which and about which it does not move.
    pub locked: LockedAxes,
}

/// The axes of the scene along which, and about which, a [free](FreeMotion) body does not move. A door turns about one axis:
///
/// ```
/// use selvedge_cloth::LockedAxes;
///
/// let door = LockedAxes { translation: [true; 3], rotation: [true, true, false] };
/// assert_ne!(door, LockedAxes::default());
/// ```
///
/// It turns about its centre of mass. Where the certificate moves a body together with what it touches, a lock gives way by that.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LockedAxes {
    /// True for each axis, x, y and z, along which the centre of mass does not move.
    pub translation: [bool; 3],
    /// True for each axis, x, y and z, about which the body does not turn.
    pub rotation: [bool; 3],
}

/// The names of axes in scene files, with their places in `translation` and, after those, in `rotation`.
const AXES: [(&str, usize); 6] = [
    ("x", 0),
    ("y", 1),
    ("z", 2),
    ("rotation_x", 3),
    ("rotation_y", 4),
    ("rotation_z", 5),
];

impl LockedAxes {
    fn freedom(self) -> Freedom {
        let [translation, rotation] =
            [self.translation, self.rotation].map(|locked| DVec3::from(locked.map(|is_locked| f64::from(u8::from(!is_locked)))));
        Freedom { translation, rotation }
    }
}

crate::identify!(enum BodyMass { 0 => Mass(mass), 1 => Density(density) });
crate::identify!(FreeMotion {
    mass,
    placement,
    velocity,
    spin,
    locked
});
crate::identify!(LockedAxes { translation, rotation });

const MASS_FIELD: Field = Field::new("mass", MASS, 1e-6, 1e6);
const DENSITY_FIELD: Field = Field::new("density", AIR_DENSITY, 1e-2, 1e5);
const VELOCITY: Field = Field::vector("velocity", SPEED, 1e2);
const LOCKED: &str = "locked";
const SPIN: Field = Field::vector("spin", ANGULAR_SPEED, 1e3);

impl FreeMotion {
    /// Keys of a table that describes a free motion.
    pub(super) const KEYS: [&'static str; 5] = [MASS_FIELD.name, DENSITY_FIELD.name, VELOCITY.name, SPIN.name, LOCKED];

    /// Returns a motion that starts at rest.
    #[must_use]
    pub const fn new(mass: BodyMass) -> Self {
        Self {
            mass,
            placement: Placement::at(DVec3::ZERO),
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
            locked: LockedAxes {
                translation: [false; 3],
                rotation: [false; 3],
            },
        }
    }

    /// Returns whether a table describes a free motion.
    pub(super) fn is_in(table: &Table<'_>) -> bool {
        Self::KEYS.into_iter().any(|key| table.has(key))
    }

    pub(super) fn read(table: &Table<'_>) -> Result<Self, SceneError> {
        let mass = match (table.number(&MASS_FIELD)?, table.number(&DENSITY_FIELD)?) {
            (Some(mass), None) => BodyMass::Mass(mass),
            (None, Some(density)) => BodyMass::Density(density),
            (Some(_), Some(_)) => {
                let message = "a body has `mass` or `density`, not both".to_owned();
                return Err(table.error(DENSITY_FIELD.name, message));
            }
            (None, None) => {
                let given = [VELOCITY.name, SPIN.name, LOCKED].into_iter().find(|key| table.has(key));
                let key = given.unwrap_or(VELOCITY.name);
                let message = format!("`{key}` is for free bodies: it needs `mass` or `density`");
                return Err(table.error(key, message));
            }
        };
        let mut locked = LockedAxes::default();
        for axis in table.choices(LOCKED, &AXES)? {
            let axes = if axis < 3 {
                &mut locked.translation
            } else {
                &mut locked.rotation
            };
            axes[axis % 3] = true;
        }
        Ok(Self {
            locked,
            velocity: table.vector(&VELOCITY)?.unwrap_or_default(),
            spin: table.vector(&SPIN)?.unwrap_or_default(),
            ..Self::new(mass)
        })
    }

    pub(super) fn check(&self, mesh: &Mesh) -> Result<(), ValueError> {
        match self.mass {
            BodyMass::Mass(mass) => MASS_FIELD.check(mass)?,
            BodyMass::Density(density) => DENSITY_FIELD.check(density)?,
        }
        self.placement.checked()?;
        VELOCITY.check_vector(self.velocity)?;
        SPIN.check_vector(self.spin)?;
        RigidMass::new(self.mass, mesh).map(drop)
    }
}

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
        let own = corners.iter().fold(outer(sum), |all, &corner| all + outer(corner));
        self.second += own * (size / (count * (count + 1.0)));
    }
}

fn outer(vector: DVec3) -> DMat3 {
    DMat3::from_cols(vector * vector.x, vector * vector.y, vector * vector.z)
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
        let second = (second * size.recip() - outer(centre)) * all;
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
    fn with(&self, points: &[(DVec3, f64)]) -> Self {
        let moment = |(place, mass): &(DVec3, f64)| *place * *mass;
        let mass = self.mass + points.iter().map(|(_, mass)| mass).sum::<f64>();
        let centre = (self.centre * self.mass + points.iter().map(moment).sum::<DVec3>()) / mass;
        // The inertia of a point at the arm q is m·(q²·1 − q·qᵀ).
        let of_point = |place: DVec3, mass: f64| {
            let arm = place - centre;
            (DMat3::from_diagonal(DVec3::splat(arm.length_squared())) - outer(arm)) * mass
        };
        let own = self.inertia + of_point(self.centre, self.mass);
        let inertia = points.iter().fold(own, |sum, &(place, mass)| sum + of_point(place, mass));
        Self { mass, centre, inertia }
    }

    /// Returns the angular velocity in a state, in rad/s.
    fn spin(&self, state: &RigidState, freedom: &Freedom) -> DVec3 {
        freedom.inverse_inertia(&state.turned(&self.inertia)) * state.momentum
    }
}

/// The numbers of a body that change from step to step: two states, and the order of the next step.
pub(crate) const KEPT: usize = 2 * NUMBERS + 1;

/// A free body in motion.
#[derive(Clone, Debug)]
pub(crate) struct Free {
    pub(crate) mass: RigidMass,
    pub(crate) freedom: Freedom,
    /// The vertices of cloth that are pinned to the body.
    pub(crate) riders: Arc<[u32]>,
    /// Its vertices and those in the axes of the body, from its centre of mass.
    pub(crate) points: Arc<[DVec3]>,
    pub(crate) state: RigidState,
    /// The state one step before.
    pub(crate) before: RigidState,
    /// True if the next step is of first order.
    pub(crate) is_first_order: bool,
}

impl Free {
    /// Makes a body at the start of its motion. Scenes are checked earlier; a mesh without mass becomes a point.
    pub(super) fn new(motion: &FreeMotion, mesh: &Mesh) -> Self {
        let mass = RigidMass::new(motion.mass, mesh).unwrap_or(RigidMass {
            mass: 1.0,
            centre: DVec3::ZERO,
            inertia: DMat3::IDENTITY,
        });
        let freedom = motion.locked.freedom();
        let placement = motion.placement.checked().unwrap_or(motion.placement);
        let mut state = RigidState {
            rotation: placement.rotation,
            centre: placement.apply(mass.centre),
            velocity: motion.velocity * freedom.translation,
            momentum: DVec3::ZERO,
        };
        state.momentum = state.turned(&mass.inertia) * (motion.spin * freedom.rotation);
        Self {
            mass,
            freedom,
            riders: Arc::new([]),
            points: mesh.positions.iter().map(|&point| point - mass.centre).collect(),
            state,
            before: state,
            is_first_order: true,
        }
    }

    /// Takes vertices of cloth that are pinned to the body, each with its position at the start and its mass in kg. They belong
    /// to the body from now on: its mass, its centre and its inertia are those of all.
    pub(crate) fn take_riders(&mut self, riders: &[(u32, DVec3, f64)]) {
        let placement = self.placement();
        let before = self.mass;
        let at = riders
            .iter()
            .map(|&(_, position, mass)| (placement.apply_inverse(position), mass));
        let at: Vec<(DVec3, f64)> = at.collect();
        self.mass = before.with(&at);
        let shift = before.centre - self.mass.centre;
        let own = self.points.iter().map(|&point| point + shift);
        self.points = own.chain(at.iter().map(|(point, _)| *point - self.mass.centre)).collect();
        self.riders = riders.iter().map(|(vertex, ..)| *vertex).collect();
        let spin = before.spin(&self.state, &self.freedom);
        let arm = self.state.rotation * -shift;
        self.state.centre += arm;
        self.state.velocity += spin.cross(arm) * self.freedom.translation;
        self.state.momentum = self.state.turned(&self.mass.inertia) * spin;
        self.before = self.state;
    }

    /// Takes over the motion of the same body.
    pub(crate) fn take_over(&mut self, other: &Self) {
        (self.state, self.before) = (other.state, other.before);
        self.is_first_order = other.is_first_order;
    }

    /// Returns the placement of the mesh.
    pub(crate) fn placement(&self) -> Placement {
        let RigidState { rotation, centre, .. } = self.state;
        Placement::new(rotation, centre - rotation * self.mass.centre)
    }

    /// Returns the longest distance of a vertex from the centre of mass, in m.
    pub(crate) fn radius(&self) -> f64 {
        self.points
            .iter()
            .map(|point| point.length_squared())
            .fold(0.0, f64::max)
            .sqrt()
    }

    /// Returns the energy of its motion, in J.
    pub(crate) fn kinetic_energy(&self) -> f64 {
        let RigidState { velocity, momentum, .. } = self.state;
        0.5 * self.mass.mass * velocity.length_squared() + 0.5 * momentum.dot(self.spin_of(&self.state))
    }

    /// Returns all that changes from step to step, for checkpoints.
    pub(crate) fn numbers(&self) -> [f64; KEPT] {
        let mut numbers = [f64::from(u8::from(self.is_first_order)); KEPT];
        numbers[..NUMBERS].copy_from_slice(&self.state.numbers());
        numbers[NUMBERS..2 * NUMBERS].copy_from_slice(&self.before.numbers());
        numbers
    }

    /// Restores what [`numbers`](Self::numbers) returned.
    pub(crate) fn recall(&mut self, numbers: &[f64; KEPT]) {
        let part = |first: usize| std::array::from_fn(|k| numbers[first + k]);
        (self.state, self.before) = (RigidState::from_numbers(part(0)), RigidState::from_numbers(part(NUMBERS)));
        self.is_first_order = numbers[KEPT - 1] != 0.0;
    }

    /// Returns the angular velocity in one of its states, in rad/s.
    pub(crate) fn spin_of(&self, state: &RigidState) -> DVec3 {
        self.mass.spin(state, &self.freedom)
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
