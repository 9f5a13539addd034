//! Proxies: free bodies that stand for those of another physics engine.
//!
//! **A frame.** The engine moves its body first, with the load of the cloth's last frame. Then the cloth's frame begins: the
//! proxy starts where its last frame has ended, with the acceleration that the engine has given the body, and at the velocity
//! which leads to where the engine has brought it. It yields to the cloth as a free body of the engine's mass does. The engine
//! takes over where the proxy ends, and the load as an impulse.
//!
//! So a load is implicit in the motion that answers it. For a body on a spring k with the frame T this is x' = x + v·T −
//! k·x'·T²/m, which is stable for any k, and cloth of any mass may hang on the body. With the load of the last frame instead, a
//! body lighter than half of its cloth is thrown off, and one on a taut sheet bounces ever higher.
//!
//! **What the engine holds.** On the ground, the engine stops what the load moves, and the proxy would sink by the load's
//! displacement d in each frame. The engine's velocity shows its reaction: the last velocity with load and gravity would be
//! another one. The reaction moves the body by up to c in the frame. It takes back the part of d along c, at most |c|. In free
//! flight c vanishes. The same holds for rotations.

use super::placement::Placement;
use super::rigid_mass::RigidMass;
use crate::input::{ANGULAR_SPEED, Field, SPEED, ValueError};
use crate::model::rigid::{rotation_by, turned, vector_of};
use selvedge_core::glam::{DMat3, DQuat, DVec3};

pub(super) const VELOCITY: Field = Field::vector("velocity", SPEED, 1e2);
pub(super) const SPIN: Field = Field::vector("spin", ANGULAR_SPEED, 1e3);

/// The numbers of a proxy that change from frame to frame: six vectors.
pub(super) const PROXY_NUMBERS: usize = 6 * 3;

/// Where another engine has brought the body of a proxy in the time of a frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BroughtBody {
    /// The placement of the mesh.
    pub placement: Placement,
    /// The velocity of the centre of mass, in m/s.
    pub velocity: DVec3,
    /// The angular velocity, in rad/s.
    pub spin: DVec3,
}

/// Checks a velocity and a spin.
pub(super) fn check_speeds(velocity: DVec3, spin: DVec3) -> Result<(), ValueError> {
    VELOCITY.check_vector(velocity)?;
    SPIN.check_vector(spin)
}

/// The proxy of a body. Pairs are of the centre of mass and of the rotation.
#[derive(Clone, Debug)]
pub(crate) struct Proxy {
    /// The mass of the engine's body: without the cloth that is pinned to it.
    pub(super) own: RigidMass,
    /// The masses of the cloth's vertices that are pinned to it, in kg.
    pub(super) rider_masses: Vec<f64>,
    brought: Option<BroughtBody>,
    /// The displacement and the rotation by which the load has moved it in the last frame.
    yielded: [DVec3; 2],
    /// The velocity and the spin of the engine's body at the end of the last frame, with the load.
    expected: [DVec3; 2],
    /// The impulse of the load in the last frame, and its moment about the centre of mass.
    pub(super) impulses: [DVec3; 2],
    pub(super) frame: Frame,
    /// The acceleration of the centre of mass of all that moves with the proxy, and the torque about it, without those by cloth.
    pub(crate) applied: [DVec3; 2],
}

/// The frame that has begun.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Frame {
    pub(super) seconds: f64,
    pub(super) gravity: DVec3,
    /// The velocity and the spin to which the engine has brought its body, and the accelerations by which it has.
    brought: [DVec3; 2],
    pub(super) accelerations: [DVec3; 2],
    /// The velocity and the spin at the start, and the rotation there.
    pub(super) leaves: [DVec3; 2],
    from: DQuat,
    /// Where the proxy would end without load: its centre of mass and its rotation.
    centre: DVec3,
    rotation: DQuat,
}

impl Proxy {
    pub(super) fn new(own: RigidMass) -> Self {
        Self {
            own,
            rider_masses: Vec::new(),
            brought: None,
            yielded: [DVec3::ZERO; 2],
            expected: [DVec3::ZERO; 2],
            impulses: [DVec3::ZERO; 2],
            frame: Frame::default(),
            applied: [DVec3::ZERO; 2],
        }
    }

    /// Takes where the engine has brought its body.
    ///
    /// # Errors
    /// Returns an error if a number is out of range.
    pub(crate) fn bring(&mut self, to: BroughtBody) -> Result<(), ValueError> {
        check_speeds(to.velocity, to.spin)?;
        let placement = to.placement.checked()?;
        self.brought = Some(BroughtBody { placement, ..to });
        Ok(())
    }

    /// Forgets where the engine has brought it.
    pub(crate) fn forget_goal(&mut self) {
        self.brought = None;
    }

    /// Returns the mean force of the last frame, and the mean torque about the centre of mass.
    pub(crate) fn load(&self) -> [DVec3; 2] {
        let seconds = self.frame.seconds;
        if seconds > 0.0 {
            self.impulses.map(|impulse| impulse / seconds)
        } else {
            [DVec3::ZERO; 2]
        }
    }

    /// Begins a frame of so many seconds at a placement. Returns the mean velocity and the mean spin that lead to its goal.
    pub(super) fn begin(&mut self, seconds: f64, at: Placement, gravity: DVec3) -> [DVec3; 2] {
        let to = self.brought.take().unwrap_or(BroughtBody {
            placement: at,
            velocity: DVec3::ZERO,
            spin: DVec3::ZERO,
        });
        let start = at.apply(self.own.centre);
        let moved = [
            to.placement.apply(self.own.centre) - start,
            vector_of(to.placement.rotation * at.rotation.inverse()),
        ];
        let brought = [to.velocity, to.spin];
        let accelerations = [0, 1].map(|slot| (brought[slot] - self.expected[slot]) / seconds);
        let reactions = [accelerations[0] - gravity, accelerations[1]];
        let leaves = [0, 1].map(|slot| {
            let held = part_along(self.yielded[slot], reactions[slot] * (seconds * seconds));
            (moved[slot] - held) / seconds
        });
        self.frame = Frame {
            seconds,
            gravity,
            brought,
            accelerations,
            leaves,
            from: at.rotation,
            centre: start + leaves[0] * seconds,
            rotation: rotation_by(leaves[1] * seconds) * at.rotation,
        };
        leaves
    }

    /// Ends the frame at a placement, with the velocity and the spin there.
    pub(super) fn end(&mut self, at: Placement, [velocity, spin]: [DVec3; 2]) {
        let frame = &self.frame;
        self.yielded = [
            at.apply(self.own.centre) - frame.centre,
            vector_of(at.rotation * frame.rotation.inverse()),
        ];
        let inertia_at = |rotation: DQuat| turned(&DMat3::from_quat(rotation), &self.own.inertia);
        let inertia = inertia_at(at.rotation);
        let [gained, gained_spin] = frame.accelerations.map(|acceleration| acceleration * frame.seconds);
        let [velocity_before, spin_before] = frame.leaves;
        let impulse = (velocity - velocity_before - gained) * self.own.mass;
        let moment = inertia * (spin - gained_spin) - inertia_at(frame.from) * spin_before;
        self.impulses = [impulse, moment];
        self.expected = [
            frame.brought[0] + impulse / self.own.mass,
            frame.brought[1] + inertia.inverse() * moment,
        ];
    }

    pub(super) fn numbers(&self) -> [f64; PROXY_NUMBERS] {
        let vectors = [self.yielded, self.expected, self.impulses].concat();
        std::array::from_fn(|k| vectors[k / 3][k % 3])
    }

    pub(super) fn recall(&mut self, numbers: &[f64]) {
        let vector = |k: usize| DVec3::from_slice(&numbers[3 * k..]);
        (self.yielded, self.expected) = ([vector(0), vector(1)], [vector(2), vector(3)]);
        self.impulses = [vector(4), vector(5)];
        self.frame = Frame::default();
    }

    /// Rotates all that it knows of the last frame, and forgets where the engine has brought the body.
    pub(super) fn rotate(&mut self, by: DQuat) {
        self.brought = None;
        for vector in [&mut self.yielded, &mut self.expected, &mut self.impulses]
            .into_iter()
            .flatten()
        {
            *vector = by * *vector;
        }
    }
}

/// Returns the part of `d` along `c`, at most as long as `c`.
fn part_along(d: DVec3, c: DVec3) -> DVec3 {
    let length = c.length();
    if length > 0.0 {
        let unit = c / length;
        unit * d.dot(unit).clamp(-length, length)
    } else {
        DVec3::ZERO
    }
}
