//! Entities that follow free bodies of cloth.

use crate::cloth::{over_a_ball, simulation, wide};
use crate::{app, step};
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_math::{Quat, Vec3};
use bevy_transform::components::{GlobalTransform, Transform};
use bevy_transform::helper::TransformHelper;
use selvedge_bevy::selvedge_cloth::glam::DVec3;
use selvedge_bevy::selvedge_cloth::{BodyMass, FreeMotion, Scene};
use selvedge_bevy::{ClothSimulation, SelvedgeError, SelvedgeProblem};

/// Makes a scene of a sheet above a ball of 0.2 kg, which flies and spins.
fn with_a_free_ball() -> Scene {
    let mut scene = over_a_ball();
    scene.bodies[0].motion = FreeMotion {
        velocity: DVec3::new(1.0, 3.0, 0.0),
        spin: DVec3::new(0.0, 2.0, 5.0),
        ..FreeMotion::new(BodyMass::Mass(0.2))
    }
    .into();
    scene
}

fn global(app: &mut bevy_app::App, entity: Entity) -> GlobalTransform {
    let mut state = bevy_ecs::system::SystemState::<TransformHelper<'_, '_>>::new(app.world_mut());
    let helper = state.get(app.world()).unwrap();
    helper.compute_global_transform(entity).unwrap()
}

#[test]
fn an_entity_is_where_the_free_body_is_that_it_follows_and_keeps_its_scale() {
    let mut app = app();
    let alone = app.world_mut().spawn(Transform::from_scale(Vec3::splat(2.0))).id();
    let cloth = app
        .world_mut()
        .spawn(ClothSimulation::new(with_a_free_ball()).followed_by(0, alone))
        .id();
    for _ in 0..20 {
        assert_eq!(step(&mut app).problems, []);
        let placement = simulation(&app, cloth).placement(0).unwrap();
        let seen = app.world().get::<Transform>(alone).unwrap();
        assert_eq!(seen.translation.to_array(), placement.translation.as_vec3().to_array());
        assert!(seen.rotation.to_array() == placement.rotation.as_quat().normalize().to_array());
        assert_eq!(seen.scale, Vec3::splat(2.0));
    }
    let motion = simulation(&app, cloth).body_motion(0).unwrap();
    assert!(motion.centre.y > 0.1 && motion.centre.x > 0.1, "it flies: {motion:?}");
}

#[test]
fn an_entity_with_a_parent_that_moves_is_where_its_free_body_is_in_the_world() {
    let mut app = app();
    let parent = Transform {
        translation: Vec3::new(3.0, -1.0, 2.0),
        rotation: Quat::from_rotation_x(0.7) * Quat::from_rotation_z(0.3),
        scale: Vec3::splat(0.5),
    };
    let parent = app.world_mut().spawn(parent).id();
    let child = app.world_mut().spawn((Transform::default(), ChildOf(parent))).id();
    let cloth = app
        .world_mut()
        .spawn(ClothSimulation::new(with_a_free_ball()).followed_by(0, child))
        .id();
    for _ in 0..10 {
        app.world_mut().get_mut::<Transform>(parent).unwrap().translation.x += 0.1;
        assert_eq!(step(&mut app).problems, []);
        let placement = simulation(&app, cloth).placement(0).unwrap();
        let (_, rotation, translation) = global(&mut app, child).to_scale_rotation_translation();
        // Coordinates up to 4 m in f32, through one parent: a few units in the last place.
        assert!(wide(translation.to_array()).distance(placement.translation) < 4e-6);
        let turned = placement.rotation.as_quat().to_array();
        assert!(rotation.angle_between(Quat::from_array(turned)) < 2e-3);
    }
}

#[test]
fn bodies_and_entities_that_cannot_go_together_are_told_once() {
    let mut app = app();
    let [rest, gone, far] = [(); 3].map(|()| app.world_mut().spawn(Transform::default()).id());
    app.world_mut().despawn(gone);
    let resting = app
        .world_mut()
        .spawn(ClothSimulation::new(over_a_ball()).followed_by(0, rest).followed_by(1, far))
        .id();
    let flying = app
        .world_mut()
        .spawn(ClothSimulation::new(with_a_free_ball()).followed_by(0, gone))
        .id();
    let told = step(&mut app).problems;
    let problem = |entity, error| SelvedgeProblem {
        entity: Some(entity),
        error,
    };
    let expected = [
        problem(resting, SelvedgeError::NotFree { body: 0 }),
        problem(resting, SelvedgeError::NoBody { body: 1, bodies: 1 }),
        problem(flying, SelvedgeError::NoTransform { entity: gone }),
    ];
    assert_eq!(told.len(), expected.len(), "{told:?}");
    assert!(expected.iter().all(|problem| told.contains(problem)), "{told:?}");
    assert_eq!(step(&mut app).problems, []);
    assert_eq!(*app.world().get::<Transform>(rest).unwrap(), Transform::default());
}
