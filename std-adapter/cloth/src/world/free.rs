//! Free rigid bodies: their motion in a scene, and their state.

use super::placement::Placement;
use super::proxy::{PROXY_NUMBERS, Proxy, SPIN, VELOCITY, check_speeds};
use super::rigid_mass::{BodyMass, DENSITY_FIELD, MASS_FIELD, RigidMass};
use crate::input::{SceneError, Table, ValueError};
use crate::model::rigid::{Freedom, NUMBERS, RigidState};
use selvedge::Mesh;
use selvedge_core::glam::{DMat3, DVec3};
use std::sync::Arc;

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
    /// True for the proxy of a body that another physics engine moves: gravity and other bodies do not move it, and in each frame
    /// it yields to cloth from where the engine has [brought](crate::Simulation::bring_body) it.
    pub proxy: bool,
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

crate::identify!(FreeMotion {
    mass,
    placement,
    velocity,
    spin,
    locked,
    proxy
});
crate::identify!(LockedAxes { translation, rotation });

const LOCKED: &str = "locked";
const PROXY: &str = "proxy";

impl FreeMotion {
    /// Keys of a table that describes a free motion.
    pub(super) const KEYS: [&'static str; 6] = [MASS_FIELD.name, DENSITY_FIELD.name, VELOCITY.name, SPIN.name, LOCKED, PROXY];

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
            proxy: false,
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
                let given = [VELOCITY.name, SPIN.name, LOCKED, PROXY]
                    .into_iter()
                    .find(|key| table.has(key));
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
            proxy: table.flag(PROXY)?,
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
        check_speeds(self.velocity, self.spin)?;
        RigidMass::new(self.mass, mesh).map(drop)
    }
}

/// The numbers of a body that change from step to step: two states, the order of the next step, and those of a proxy.
pub(crate) const KEPT: usize = PROXY_FIRST + PROXY_NUMBERS;
const PROXY_FIRST: usize = 2 * NUMBERS + 1;

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
    /// For the proxy of a body that another engine moves.
    pub(crate) proxy: Option<Box<Proxy>>,
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
            proxy: motion.proxy.then(|| Box::new(Proxy::new(mass))),
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
        if let Some(proxy) = &mut self.proxy {
            proxy.rider_masses = riders.iter().map(|(.., mass)| *mass).collect();
        }
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
        self.proxy.clone_from(&other.proxy);
    }

    /// Moves the body elsewhere at once, with all of its motion.
    pub(crate) fn teleport(&mut self, by: &Placement) {
        for state in [&mut self.state, &mut self.before] {
            *state = RigidState {
                rotation: (by.rotation * state.rotation).normalize(),
                centre: by.apply(state.centre),
                velocity: by.rotation * state.velocity,
                momentum: by.rotation * state.momentum,
            };
        }
        if let Some(proxy) = &mut self.proxy {
            proxy.rotate(by.rotation);
        }
    }

    /// Returns where the vertices are that move with the body: its own, then those of cloth that are pinned to it.
    pub(crate) fn positions(&self) -> impl Iterator<Item = DVec3> {
        let RigidState { rotation, centre, .. } = self.state;
        let rotation = DMat3::from_quat(rotation);
        self.points.iter().map(move |&point| rotation * point + centre)
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
        let mut numbers = [0.0; KEPT];
        numbers[2 * NUMBERS] = f64::from(u8::from(self.is_first_order));
        if let Some(proxy) = &self.proxy {
            numbers[PROXY_FIRST..].copy_from_slice(&proxy.numbers());
        }
        numbers[..NUMBERS].copy_from_slice(&self.state.numbers());
        numbers[NUMBERS..2 * NUMBERS].copy_from_slice(&self.before.numbers());
        numbers
    }

    /// Restores what [`numbers`](Self::numbers) returned.
    pub(crate) fn recall(&mut self, numbers: &[f64; KEPT]) {
        let part = |first: usize| std::array::from_fn(|k| numbers[first + k]);
        (self.state, self.before) = (RigidState::from_numbers(part(0)), RigidState::from_numbers(part(NUMBERS)));
        self.is_first_order = numbers[2 * NUMBERS] != 0.0;
        if let Some(proxy) = &mut self.proxy {
            proxy.recall(&numbers[PROXY_FIRST..]);
        }
    }

    /// Returns the angular velocity in one of its states, in rad/s.
    pub(crate) fn spin_of(&self, state: &RigidState) -> DVec3 {
        self.mass.spin(state, &self.freedom)
    }
}
