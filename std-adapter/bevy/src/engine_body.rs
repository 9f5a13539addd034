//! Bodies of a physics engine that cloth pushes.

use bevy_ecs::component::Component;
use bevy_math::Vec3;
use selvedge_cloth::{BodyMass, BroughtBody, FreeMotion, LockedAxes, Placement, Wrench, glam::DVec3};

/// The rigid body of an entity in a physics engine. Cloth whose body [follows](crate::ClothSimulation::led_by) the entity pushes
/// it.
///
/// The features `avian` and `rapier` have plugins that write and read this component: `AvianBridge` and `RapierBridge`. For
/// another engine, two systems do it in `FixedPostUpdate`. One runs before
/// [`SelvedgeSystems::Cloth`](crate::SelvedgeSystems::Cloth), after the engine's step of the same length, and writes the mass and
/// the motion. The other one runs after it, and adds [`impulse`](Self::impulse) and [`angular_impulse`](Self::angular_impulse) to
/// the momenta of the engine's body at once. In between the plugin has moved the `Transform` of the entity to where the cloth has
/// left the body; the engine has to go on from there.
///
/// The entity needs the component, with a mass, when the simulation starts. The scene's body must have the shape of the engine's
/// body: its centre of mass and its inertia come from its mesh. The engine's gravity is that of the scene. See
/// [`Simulation::bring_body`](selvedge_cloth::Simulation::bring_body) for what happens in the cloth.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct EngineBody {
    /// The mass, in kg.
    pub mass: f64,
    /// The velocity of the centre of mass, in m/s.
    pub velocity: Vec3,
    /// The angular velocity, in rad/s.
    pub spin: Vec3,
    /// The axes along and about which the engine does not move the body. Only the start of the simulation reads them.
    pub locked: LockedAxes,
    /// The impulse of all cloths in the last fixed step, in N·s. The plugin writes it.
    pub impulse: Vec3,
    /// Its moment about the centre of mass, in N·m·s. The plugin writes it.
    pub angular_impulse: Vec3,
}

fn wide(vector: Vec3) -> DVec3 {
    DVec3::from_array(vector.to_array().map(f64::from))
}

fn narrow(vector: DVec3) -> Vec3 {
    Vec3::from_array(vector.as_vec3().to_array())
}

impl EngineBody {
    /// Returns the motion of its proxy from here.
    pub(crate) fn proxy(&self, placement: Placement) -> FreeMotion {
        FreeMotion {
            placement,
            velocity: wide(self.velocity),
            spin: wide(self.spin),
            locked: self.locked,
            proxy: true,
            ..FreeMotion::new(BodyMass::Mass(self.mass))
        }
    }

    /// Returns where the engine has brought it.
    pub(crate) fn brought(&self, placement: Placement) -> BroughtBody {
        BroughtBody {
            placement,
            velocity: wide(self.velocity),
            spin: wide(self.spin),
        }
    }

    /// Adds a load over so many seconds to its impulses.
    pub(crate) fn push(&mut self, load: Wrench, seconds: f64) {
        self.impulse += narrow(load.force * seconds);
        self.angular_impulse += narrow(load.torque * seconds);
    }
}
