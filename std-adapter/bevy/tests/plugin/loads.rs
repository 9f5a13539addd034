//! Loads of cloth on bodies, read by a system in each fixed step.

use crate::{app, step};
use bevy_app::FixedLast;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Query, Res, ResMut};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use selvedge_bevy::ClothSimulation;
use selvedge_bevy::selvedge_cloth::effects::{BodyContact, Friction, Gravity, SelfCollision, Stretch, Thickness};
use selvedge_bevy::selvedge_cloth::glam::DVec3;
use selvedge_bevy::selvedge_cloth::{Body, Cloth, Scene, Simulation};

const SIDE: f64 = 0.2;
const DENSITY: f64 = 0.15;

/// The loads of the cloth on the table: the time of each fixed step, and the force in its mean and at its end.
#[derive(Resource, Default)]
struct Loads(Vec<(f64, DVec3, DVec3)>);

fn read(mut loads: ResMut<'_, Loads>, cloths: Query<'_, '_, &ClothSimulation>, time: Res<'_, Time<Fixed>>) {
    let seconds = time.elapsed_secs_f64();
    let of = |simulation: &Simulation| {
        let mean = simulation.mean_body_load(0, DVec3::ZERO)?.total().force;
        let end = simulation.body_load(0, DVec3::ZERO)?.total().force;
        Some((seconds, mean, end))
    };
    loads
        .0
        .extend(cloths.iter().filter_map(ClothSimulation::simulation).filter_map(of));
}

/// Makes a scene of a sheet that lies a little above a large ball, its table.
fn on_a_table() -> Scene {
    let corner = DVec3::new(-0.5 * SIDE, 0.0055, -0.5 * SIDE);
    let cloth = Cloth::sheet(corner, [DVec3::Z * SIDE, DVec3::X * SIDE], [6, 6], DENSITY).unwrap();
    let mut scene = Scene::new(cloth, 4e-3);
    scene.bodies.push(Body::ball("table", DVec3::NEG_Y, 1.0, 24).unwrap());
    scene
        .add(Gravity {
            acceleration: DVec3::NEG_Y * 9.81,
        })
        .add(Stretch::isotropic(400.0))
        .add(Friction { coefficient: 0.5 })
        .add(BodyContact(Thickness::new(5e-3)))
        .add(SelfCollision(Thickness::new(5e-3)));
    scene
}

#[test]
fn a_system_reads_the_load_on_a_body_in_each_fixed_step_and_at_rest_it_is_the_weight() {
    let mut app = app();
    app.init_resource::<Loads>().add_systems(FixedLast, read);
    let table = app.world_mut().spawn(Transform::default()).id();
    app.world_mut().spawn(ClothSimulation::new(on_a_table()).led_by(0, table));
    let steps = 64;
    for done in 1..=steps {
        assert_eq!(step(&mut app).problems, []);
        assert_eq!(app.world().resource::<Loads>().0.len(), done, "one load in each fixed step");
    }
    let loads = &app.world().resource::<Loads>().0;
    assert!(loads.windows(2).all(|two| two[0].0 < two[1].0), "each belongs to its time");
    let weight = DVec3::NEG_Y * SIDE * SIDE * DENSITY * 9.81;
    let (_, first, _) = loads[0];
    assert!(first.length() < 0.9 * weight.length(), "it falls before it rests: {first}");
    let (_, mean, end) = loads[steps - 1];
    for force in [mean, end] {
        assert!(
            (force - weight).length() < 1e-3 * weight.length(),
            "{force} instead of {weight}"
        );
    }
}
