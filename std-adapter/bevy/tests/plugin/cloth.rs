//! Cloth whose bodies follow entities.

use crate::figure::{self, DURATION};
use crate::{add, app, empty_mesh, mesh, sheet, step};
use bevy_app::{App, FixedUpdate};
use bevy_asset::Assets;
use bevy_ecs::entity::Entity;
use bevy_math::{Quat, Vec3};
use bevy_mesh::primitives::Meshable;
use bevy_mesh::{Mesh, Mesh3d, VertexAttributeValues};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use selvedge_bevy::selvedge::{CollisionDetector, Intersection, Topology};
use selvedge_bevy::selvedge_cloth::effects::{
    BodyContact, Gravity, PinGroup, PinMotion, Pins, RopeStretch, SelfCollision, Stretch, Tearing, Thickness,
};
use selvedge_bevy::selvedge_cloth::glam::DVec3;
use selvedge_bevy::selvedge_cloth::{Body, BodyMotion, Cloth, Keyframe, KeyframeMotion, OnBlocked, Placement, Scene, Simulation};
use selvedge_bevy::{
    ClothSimulation, RopesOf, SelvedgeError, SelvedgeProblem, body_of_mesh, cloth_of_mesh, mesh_of, mesh_of_cloths,
};
use std::time::Duration;

pub(crate) fn wide(position: [f32; 3]) -> DVec3 {
    DVec3::from_array(position.map(f64::from))
}

fn attribute(app: &App, entity: Entity, attribute: bevy_mesh::MeshVertexAttribute) -> Vec<[f32; 3]> {
    let handle = &app.world().get::<Mesh3d>(entity).unwrap().0;
    match app
        .world()
        .resource::<Assets<Mesh>>()
        .get(handle)
        .unwrap()
        .attribute(attribute)
    {
        Some(VertexAttributeValues::Float32x3(values)) => values.clone(),
        other => panic!("{other:?}"),
    }
}

/// Spawns an entity that leads the ball, and the cloth above it.
fn spawn_over_a_ball(app: &mut App) -> [Entity; 2] {
    let ball = app.world_mut().spawn(Transform::default()).id();
    let cloth = ClothSimulation::new(over_a_ball()).led_by(0, ball);
    [ball, app.world_mut().spawn(cloth).id()]
}

pub(crate) fn simulation(app: &App, entity: Entity) -> &Simulation {
    app.world().get::<ClothSimulation>(entity).unwrap().simulation().unwrap()
}

/// Makes a scene of a sheet above a ball, without the ball's motion.
pub(crate) fn over_a_ball() -> Scene {
    let cloth = Cloth::sheet(
        DVec3::new(-0.15, 0.12, -0.15),
        [DVec3::Z * 0.3, DVec3::X * 0.3],
        [12, 12],
        0.2,
    )
    .unwrap();
    let mut scene = Scene::new(cloth, 4e-3);
    scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.1, 16).unwrap());
    scene
        .add(Gravity {
            acceleration: DVec3::NEG_Y * 9.81,
        })
        .add(Stretch::isotropic(500.0));
    scene
        .add(BodyContact(Thickness::new(4e-3)))
        .add(SelfCollision(Thickness::new(4e-3)));
    scene.on_blocked = OnBlocked::Yield;
    scene
}

fn problem(entity: Entity, error: SelvedgeError) -> SelvedgeProblem {
    SelvedgeProblem {
        entity: Some(entity),
        error,
    }
}

#[test]
fn the_mesh_of_cloth_that_tears_is_torn_as_well() {
    let mut app = app();
    let cloth = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.1, DVec3::Y * 0.05], [10, 5], 0.2).unwrap();
    let seen = app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh_of(cloth.mesh()));
    let triangles = cloth.mesh().triangles.len();
    let mut scene = Scene::new(cloth, 2e-3);
    let [left, right] = ["left", "right"].map(|part| scene.part("cloth", part).unwrap());
    let keys = [(0.0, 0.0), (0.2, 0.03)].map(|(time, x)| Keyframe {
        time,
        translation: DVec3::X * x,
        ..Keyframe::default()
    });
    let away = PinMotion::Own(KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys.to_vec()).unwrap().into());
    let right = PinGroup::new(right, away);
    scene.add(Pins {
        groups: vec![PinGroup::resting(left), right],
    });
    scene.add(Stretch::isotropic(500.0)).add(SelfCollision(Thickness::new(1e-3)));
    scene.add(Tearing::above(50.0));
    let entity = app.world_mut().spawn((ClothSimulation::new(scene), Mesh3d(seen))).id();
    while app.world().resource::<Time<Fixed>>().elapsed_secs() < 0.3 {
        assert_eq!(step(&mut app).problems, []);
    }
    let simulation = simulation(&app, entity);
    assert!(!simulation.torn_edges().is_empty());
    let corners = simulation.triangles().as_flattened().iter();
    let expected: Vec<[f32; 3]> = corners
        .map(|&vertex| simulation.positions()[vertex as usize].as_vec3().to_array())
        .collect();
    assert_eq!(expected.len(), 3 * triangles);
    assert_eq!(attribute(&app, entity, Mesh::ATTRIBUTE_POSITION), expected);
    assert_eq!(attribute(&app, entity, Mesh::ATTRIBUTE_NORMAL).len(), expected.len());
}

#[test]
fn a_cape_on_a_moving_figure_stays_free_of_intersections() {
    let mut app = app();
    app.add_systems(FixedUpdate, figure::walk);
    let figure = figure::spawn(app.world_mut(), [12, 24]).unwrap();
    let mut detector = None;
    let (mut found, mut overlaps) = (Vec::new(), 0);
    let (mut lowest, mut highest) = (f32::MAX, f32::MIN);
    while app.world().resource::<Time<Fixed>>().elapsed_secs() < DURATION {
        let told = step(&mut app);
        assert_eq!(told.problems, []);
        let simulation = simulation(&app, figure.cape);
        let (positions, cloth) = (simulation.positions(), simulation.cloth_vertices());
        assert!(simulation.is_certified() && simulation.blocked_steps() == 0);
        // The rendered cloth is the simulated one.
        let seen = attribute(&app, figure.cape, Mesh::ATTRIBUTE_POSITION);
        assert!(
            seen.iter()
                .map(|&position| Vec3::from(position))
                .eq(positions[..cloth].iter().map(|p| Vec3::from(p.as_vec3().to_array())))
        );
        let detector = detector.get_or_insert_with(|| {
            let topology = Topology::new(positions.len(), simulation.triangles().to_vec()).unwrap();
            CollisionDetector::<f32>::new(topology)
        });
        let rounded: Vec<[f32; 3]> = positions.iter().map(|position| position.as_vec3().to_array()).collect();
        detector.intersections(&rounded, &mut found).unwrap();
        // Parts of the figure overlap; the cape meets none of them, nor itself.
        let topology = detector.topology();
        let is_figures = |vertices: &[u32]| vertices.iter().all(|&vertex| vertex as usize >= cloth);
        let (edge, face) = (
            |edge: u32| &topology.edges()[edge as usize],
            |face: u32| &topology.triangles()[face as usize],
        );
        overlaps += found.len();
        found.retain(|found| match *found {
            Intersection::EdgeFace { edge: own, face: other } => !(is_figures(edge(own)) && is_figures(face(other))),
            Intersection::VertexFace { vertex, face: other } => !(is_figures(&[vertex]) && is_figures(face(other))),
            Intersection::EdgeEdge { edges: [own, other] } => !(is_figures(edge(own)) && is_figures(edge(other))),
        });
        assert_eq!(found, []);
        lowest = seen.iter().map(|position| position[2]).fold(lowest, f32::min);
        highest = seen.iter().map(|position| position[2]).fold(highest, f32::max);
    }
    assert!(overlaps > 0, "the figure's own");
    assert!(
        lowest < -0.3 && highest > 2.5,
        "it hung on the back, and on the other side after the turn: {lowest} {highest}"
    );
    // The bodies were at the places of their entities.
    let simulation = simulation(&app, figure.cape);
    for (body, &entity) in figure.parts.iter().enumerate() {
        let drawn = app
            .world()
            .get::<bevy_transform::components::GlobalTransform>(entity)
            .unwrap();
        let mesh = attribute(&app, entity, Mesh::ATTRIBUTE_POSITION);
        for (vertex, position) in simulation.body_vertices(body).unwrap().zip(mesh) {
            let drawn = drawn.transform_point(position.into());
            assert!(wide(drawn.to_array()).distance(simulation.positions()[vertex]) < 1e-5);
        }
    }
}

#[test]
fn a_cloth_is_that_of_a_simulation_driven_by_hand_bit_for_bit() {
    let mut app = app();
    let ball = app.world_mut().spawn(Transform::default()).id();
    let scene = over_a_ball();
    let handle = add(&mut app, mesh_of(scene.cloths[0].mesh()));
    let cloth = app
        .world_mut()
        .spawn((ClothSimulation::new(scene).led_by(0, ball), Mesh3d(handle)))
        .id();

    let mut scene = over_a_ball();
    scene.bodies[0].motion = BodyMotion::Driven(Placement::default());
    let mut expected = Simulation::new(scene, 1).unwrap();
    for k in 0..40 {
        let height = 0.002 * k as f32;
        app.world_mut().get_mut::<Transform>(ball).unwrap().translation.y = height;
        assert_eq!(step(&mut app).problems, []);
        let goal = Placement::at(DVec3::Y * f64::from(height));
        expected.place_body(0, goal).unwrap();
        let frame = expected.advance(1.0 / 64.0).unwrap();
        assert!(frame.steps >= 4 && frame.steps == frame.needed, "{frame:?}");
        assert_eq!(simulation(&app, cloth).positions(), expected.positions());
    }
    assert!(expected.contact_counts().is_some());
}

#[test]
fn a_cloths_own_transform_does_not_move_it_and_its_mesh_is_seen_where_it_is() {
    let mut app = app();
    let ball = app.world_mut().spawn(Transform::default()).id();
    let handle = add(&mut app, mesh_of(over_a_ball().cloths[0].mesh()));
    let transform = Transform::from_xyz(1.0, -2.0, 0.5)
        .with_rotation(Quat::from_rotation_x(0.7))
        .with_scale(Vec3::new(2.0, 1.0, 0.5));
    let cloth = app
        .world_mut()
        .spawn((ClothSimulation::new(over_a_ball()).led_by(0, ball), Mesh3d(handle), transform))
        .id();
    for _ in 0..20 {
        assert_eq!(step(&mut app).problems, []);
    }
    let simulated = simulation(&app, cloth);
    let seen = attribute(&app, cloth, Mesh::ATTRIBUTE_POSITION);
    let normals = attribute(&app, cloth, Mesh::ATTRIBUTE_NORMAL);
    let mut expected = Vec::new();
    selvedge_bevy::selvedge_cloth::vertex_normals(
        &simulated.positions()[..seen.len()],
        &simulated.triangles()[..simulated.cloth_triangles()],
        &mut expected,
    );
    for (vertex, (position, normal)) in seen.iter().zip(&normals).enumerate() {
        let drawn = wide(transform.transform_point((*position).into()).to_array());
        assert!(drawn.distance(simulated.positions()[vertex]) < 1e-5);
        // Bevy transforms normals in this way.
        let drawn = transform.rotation * (Vec3::from(*normal) / transform.scale);
        assert!(wide(drawn.normalize().to_array()).distance(expected[vertex]) < 1e-5);
    }
}

#[test]
fn a_cloth_may_be_made_of_a_mesh_whose_vertices_bevy_parts() {
    let mut app = app();
    // Each triangle of the tube has vertices of its own.
    let ball = bevy_shape::Sphere::new(0.1).mesh().ico(3).unwrap();
    let tube = Cloth::tube([DVec3::Y * 0.15, DVec3::NEG_Y * 0.15], 0.15, [24, 6], 0.2).unwrap();
    let mut parted = mesh_of(tube.mesh());
    parted.duplicate_vertices();
    let tube_cloth = cloth_of_mesh(&parted, DVec3::Y, 0.2).unwrap();
    assert_eq!(tube_cloth.mesh().positions.len(), tube.mesh().positions.len());
    assert_eq!(parted.count_vertices(), 3 * tube.mesh().triangles.len());
    let mut scene = Scene::new(tube_cloth, 4e-3);
    scene.bodies.push(body_of_mesh("ball", &ball).unwrap());
    scene
        .add(Gravity {
            acceleration: DVec3::NEG_Y * 9.81,
        })
        .add(Stretch::isotropic(500.0));
    scene.add(BodyContact(Thickness::new(4e-3)));
    let handles = [add(&mut app, ball), add(&mut app, parted)];
    let [ball, tube] = handles.map(Mesh3d);
    let ball = app.world_mut().spawn(ball).id();
    let cloth = app
        .world_mut()
        .spawn((ClothSimulation::new(scene).led_by(0, ball), tube))
        .id();
    let before = attribute(&app, cloth, Mesh::ATTRIBUTE_POSITION);
    for _ in 0..10 {
        assert_eq!(step(&mut app).problems, []);
    }
    let after = attribute(&app, cloth, Mesh::ATTRIBUTE_POSITION);
    for (vertex, other) in (0..before.len()).flat_map(|vertex| (0..vertex).map(move |other| (vertex, other))) {
        assert_eq!(before[vertex] == before[other], after[vertex] == after[other]);
    }
    assert!(
        after.iter().zip(&before).all(|(after, before)| after[1] < before[1] - 0.05),
        "it falls"
    );
}

#[test]
fn a_leader_that_is_despawned_or_scaled_is_told_once_and_its_body_stays() {
    let mut app = app();
    let [ball, cloth] = spawn_over_a_ball(&mut app);
    assert_eq!(step(&mut app).problems, []);
    *app.world_mut().get_mut::<Transform>(ball).unwrap() = Transform::from_xyz(0.0, 0.5, 0.0).with_scale(Vec3::splat(2.0));
    assert_eq!(
        step(&mut app).problems,
        [problem(cloth, SelvedgeError::ScaledLeader { entity: ball })]
    );
    app.world_mut().despawn(ball);
    assert_eq!(
        step(&mut app).problems,
        [problem(cloth, SelvedgeError::NoTransform { entity: ball })]
    );
    assert_eq!(step(&mut app).problems, []);
    let simulation = simulation(&app, cloth);
    assert_eq!(simulation.steps_done(), 16);
    assert_eq!(simulation.placement(0), Some(Placement::default()));
}

#[test]
fn a_leader_beyond_a_kilometre_is_told_once_and_its_body_stays_until_it_is_back() {
    let mut app = app();
    let [ball, cloth] = spawn_over_a_ball(&mut app);
    assert_eq!(step(&mut app).problems, []);
    let height = |app: &mut App, y: f32| app.world_mut().get_mut::<Transform>(ball).unwrap().translation.y = y;
    for away in [-1e5, -2e5] {
        height(&mut app, away);
        let told = step(&mut app).problems;
        assert!(
            matches!(&told[..], [SelvedgeProblem { entity: Some(own), error: SelvedgeError::Lead(_) }] if *own == cloth),
            "{told:?}"
        );
        height(&mut app, away);
        assert_eq!(step(&mut app).problems, []);
        height(&mut app, -0.01);
        assert_eq!(step(&mut app).problems, []);
        assert_eq!(
            simulation(&app, cloth).placement(0),
            Some(Placement::at(wide([0.0, -0.01, 0.0])))
        );
    }
}

#[test]
fn what_cannot_be_simulated_is_told_once_and_the_app_runs_on() {
    let cloth = |change: fn(&mut Scene)| {
        let mut scene = over_a_ball();
        change(&mut scene);
        ClothSimulation::new(scene)
    };
    let cases: [(ClothSimulation, &str); 4] = [
        (cloth(|scene| scene.cloths[0].density = f64::NAN), "density"),
        (cloth(|scene| scene.time_step = f64::NAN), "time_step"),
        (cloth(|scene| _ = scene.add(Stretch::isotropic(0.0))), "stiffness"),
        (
            cloth(|scene| scene.bodies[0].motion = BodyMotion::Driven(Placement::at(DVec3::Y * 0.12))),
            "starts with an intersection",
        ),
    ];
    for (cloth, what) in cases {
        let mut app = app();
        let entity = app.world_mut().spawn(cloth).id();
        let told = step(&mut app).problems;
        assert!(
            matches!(&told[..], [SelvedgeProblem { entity: Some(own), error: SelvedgeError::Setup(text) }] if *own == entity && text.contains(what)),
            "{told:?}"
        );
        assert_eq!(step(&mut app).problems, []);
        assert!(app.world().get::<ClothSimulation>(entity).unwrap().has_ended());
    }
    // The scene does not have this body.
    let mut app = app();
    let leader = app.world_mut().spawn(Transform::default()).id();
    let entity = app
        .world_mut()
        .spawn(ClothSimulation::new(over_a_ball()).led_by(7, leader))
        .id();
    assert_eq!(
        step(&mut app).problems,
        [problem(entity, SelvedgeError::NoBody { body: 7, bodies: 1 })]
    );
}

#[test]
fn a_cloth_that_is_blocked_ends_if_its_scene_says_so_and_tells() {
    let mut app = app();
    let mut scene = over_a_ball();
    scene.on_blocked = OnBlocked::Stop;
    // A ball is driven into these pins.
    let pins = selvedge_bevy::selvedge_cloth::effects::PinGroup::resting((0..169).collect::<Vec<u32>>());
    scene.add(selvedge_bevy::selvedge_cloth::effects::Pins { groups: vec![pins] });
    let ball = app.world_mut().spawn(Transform::default()).id();
    let entity = app.world_mut().spawn(ClothSimulation::new(scene).led_by(0, ball)).id();
    assert_eq!(step(&mut app).problems, []);
    app.world_mut().get_mut::<Transform>(ball).unwrap().translation.y = 0.2;
    let told = step(&mut app).problems;
    assert!(
        matches!(&told[..], [SelvedgeProblem { error: SelvedgeError::Blocked(blocked), .. }] if blocked.body.as_deref() == Some("ball")),
        "{told:?}"
    );
    assert_eq!(step(&mut app).problems, []);
    assert!(app.world().get::<ClothSimulation>(entity).unwrap().has_ended());
}

#[test]
fn a_mesh_that_is_not_the_cloths_and_a_fixed_step_that_is_too_long_are_told() {
    let mut app = app();
    let (positions, triangles) = sheet(3);
    let handle = add(&mut app, mesh(positions, &triangles));
    let cloth = app
        .world_mut()
        .spawn((ClothSimulation::new(over_a_ball()), Mesh3d(handle)))
        .id();
    assert_eq!(
        step(&mut app).problems,
        [problem(cloth, SelvedgeError::OtherMesh { seen: 16, cloth: 169 })]
    );
    app.world_mut()
        .resource_mut::<Time<Fixed>>()
        .set_timestep(Duration::from_secs(2));
    // Bevy passes at most a quarter of a second in each update.
    let told: Vec<_> = (0..10).flat_map(|_| step(&mut app).problems).collect();
    assert!(
        matches!(&told[..], [SelvedgeProblem { error: SelvedgeError::FixedStep(error), .. }] if error.field == "seconds"),
        "{told:?}"
    );
}

/// Makes a scene of a sheet and, beside it, a rope of 21 vertices.
fn rope_and_sheet() -> Scene {
    let mut scene = over_a_ball();
    let points = [DVec3::new(0.5, 0.0, 0.0), DVec3::new(1.5, 0.0, 0.0)];
    scene.cloths.push(Cloth::rope(&points, 20, 0.05).unwrap().named("rope"));
    scene.add(RopeStretch::new(1e4));
    scene
}

#[test]
fn ropes_are_seen_as_tubes_where_the_simulation_has_them_and_follow_their_own_transform() {
    let mut app = app();
    let handle = add(&mut app, empty_mesh());
    let cloths = add(&mut app, mesh_of_cloths(&rope_and_sheet()));
    let cloth = ClothSimulation::new(rope_and_sheet());
    let cloth = app.world_mut().spawn((cloth, Mesh3d(cloths))).id();
    let moved = Transform::from_xyz(0.0, 0.25, 0.0);
    let seen = app.world_mut().spawn((RopesOf::new(cloth), Mesh3d(handle), moved)).id();
    for _ in 0..3 {
        assert_eq!(step(&mut app).problems, []);
    }
    let positions = attribute(&app, seen, Mesh::ATTRIBUTE_POSITION);
    let normals = attribute(&app, seen, Mesh::ATTRIBUTE_NORMAL);
    assert_eq!((positions.len(), normals.len()), (21 * 8, 21 * 8));
    let simulation = simulation(&app, cloth);
    let all = attribute(&app, cloth, Mesh::ATTRIBUTE_POSITION);
    let of_cloths = &simulation.positions()[..simulation.cloth_vertices()];
    assert!(all.iter().zip(of_cloths).all(|(seen, own)| *seen == own.as_vec3().to_array()) && all.len() == 169 + 21);
    let rope = &simulation.positions()[simulation.vertices_of_cloth(1).unwrap()];
    assert!(rope[0].y < -1e-4);
    for (ring, centre) in positions.chunks(8).zip(rope) {
        for corner in ring {
            let away = wide(*corner) + DVec3::Y * 0.25 - *centre;
            assert!((away.length() - 2e-3).abs() < 1e-6, "{away}");
        }
    }
    for ((position, normal), ring) in positions
        .iter()
        .zip(&normals)
        .zip(0..)
        .filter(|(_, ring)| (8..160).contains(ring))
    {
        let out = wide(*position) + DVec3::Y * 0.25 - rope[ring / 8];
        assert!(wide(*normal).dot(out.normalize()) > 0.9);
    }
    let mesh = app.world().resource::<Assets<Mesh>>();
    let mesh = mesh.get(&app.world().get::<Mesh3d>(seen).unwrap().0).unwrap();
    assert_eq!(mesh.indices().unwrap().len(), 3 * (20 * 16 + 12));
}

#[test]
fn ropes_that_are_not_there_are_told_once() {
    let mut app = app();
    let handle = add(&mut app, empty_mesh());
    let nobody = app.world_mut().spawn_empty().id();
    let seen = app.world_mut().spawn((RopesOf::new(nobody), Mesh3d(handle))).id();
    let none = problem(seen, SelvedgeError::NoCloth { entity: nobody });
    assert_eq!(step(&mut app).problems, [none]);
    app.world_mut().entity_mut(nobody).insert(ClothSimulation::new(over_a_ball()));
    let without = problem(seen, SelvedgeError::NoRopes { entity: nobody });
    assert_eq!(step(&mut app).problems, [without]);
    assert_eq!(step(&mut app).problems, []);
}

#[test]
fn ropes_of_another_simulation_on_the_same_entity_take_the_place_of_the_first() {
    let mut app = app();
    let handle = add(&mut app, empty_mesh());
    let rope = |segments| {
        let mut scene = Scene::new(Cloth::rope(&[DVec3::ZERO, DVec3::X], segments, 0.05).unwrap(), 4e-3);
        scene.add(RopeStretch::new(1e4));
        ClothSimulation::new(scene)
    };
    let cloth = app.world_mut().spawn(rope(20)).id();
    let seen = app.world_mut().spawn((RopesOf::new(cloth), Mesh3d(handle.clone()))).id();
    for segments in [20, 5, 30] {
        app.world_mut().entity_mut(cloth).insert(rope(segments));
        assert_eq!(step(&mut app).problems, []);
        assert_eq!(
            attribute(&app, seen, Mesh::ATTRIBUTE_POSITION).len() as u32,
            8 * (segments + 1)
        );
        let mesh = app.world().resource::<Assets<Mesh>>().get(&handle).unwrap();
        assert_eq!(mesh.indices().unwrap().len() as u32, 3 * (16 * segments + 12));
    }
}
