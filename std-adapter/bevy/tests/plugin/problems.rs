//! Problems are reported, and the app continues.

use crate::{add, app, empty_mesh, mesh, sheet, step};
use bevy_app::App;
use bevy_asset::{Assets, RenderAssetUsages};
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_mesh::{Indices, Mesh, Mesh3d, PrimitiveTopology};
use bevy_transform::components::Transform;
use selvedge_bevy::selvedge::{StepError, TopologyError, WorldError};
use selvedge_bevy::{CollisionBody, CollisionSettings, Criterion, Limits, RenderMeshError, SelvedgeError, SelvedgeProblem};

fn problem(entity: Entity, error: SelvedgeError) -> SelvedgeProblem {
    SelvedgeProblem {
        entity: Some(entity),
        error,
    }
}

/// Makes two sheets, one of which moves through the other when a test moves it.
fn two_sheets(app: &mut App) -> [Entity; 2] {
    let (positions, triangles) = sheet(3);
    let handle = add(app, mesh(positions, &triangles));
    let mut spawn = |body, height| {
        app.world_mut()
            .spawn((Mesh3d(handle.clone()), body, Transform::from_xyz(0.0, 0.0, height)))
            .id()
    };
    [spawn(CollisionBody::Fixed, 0.0), spawn(CollisionBody::Rigid, 1.0)]
}

fn turn_over(app: &mut App, entity: Entity) {
    app.world_mut().get_mut::<Transform>(entity).unwrap().translation.z *= -1.0;
}

#[test]
fn a_mesh_without_positions_is_told_once_and_the_others_go_on_and_it_may_be_mended() {
    let mut app = app();
    let [_, mover] = two_sheets(&mut app);
    let handle = add(&mut app, empty_mesh());
    let empty = app.world_mut().spawn((Mesh3d(handle.clone()), CollisionBody::Fixed)).id();
    assert_eq!(
        step(&mut app).problems,
        [problem(empty, SelvedgeError::Mesh(RenderMeshError::NoPositions))]
    );
    for _ in 0..3 {
        turn_over(&mut app, mover);
        let told = step(&mut app);
        assert_eq!(told.problems, []);
        assert!(!told.contacts.is_empty());
    }
    let (positions, triangles) = sheet(2);
    app.world_mut()
        .resource_mut::<Assets<Mesh>>()
        .insert(&handle, mesh(positions, &triangles))
        .unwrap();
    step(&mut app);
    turn_over(&mut app, mover);
    let contacts = step(&mut app).contacts;
    assert!(contacts.iter().any(|contact| contact.entities.contains(&empty)));
}

#[test]
fn every_mesh_that_cannot_collide_says_why() {
    let (positions, triangles) = sheet(2);
    let whole = mesh(positions.clone(), &triangles);
    let with_topology = |topology| {
        Mesh::new(topology, RenderAssetUsages::all()).with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions.clone())
    };
    let mut compressed = whole.clone();
    compressed.compress_positions().unwrap();
    let mut on_the_card = whole.clone();
    on_the_card.take_gpu_data().unwrap();
    let mut broken = positions.clone();
    broken[4][1] = f32::NAN;
    let indices = |indices: Vec<u16>| whole.clone().with_inserted_indices(Indices::U16(indices));
    let cases = [
        (
            with_topology(PrimitiveTopology::LineList),
            RenderMeshError::NotTriangles {
                found: PrimitiveTopology::LineList,
            },
        ),
        (
            with_topology(PrimitiveTopology::TriangleStrip),
            RenderMeshError::NotTriangles {
                found: PrimitiveTopology::TriangleStrip,
            },
        ),
        (compressed, RenderMeshError::PositionFormat),
        (on_the_card, RenderMeshError::OnlyRendered),
        (mesh(broken, &triangles), RenderMeshError::NotFinite { vertex: 4 }),
        (indices(vec![0, 1, 2, 3]), RenderMeshError::Corners { count: 4 }),
        (
            indices(vec![0, 1, 9]),
            RenderMeshError::Topology(TopologyError::VertexOutOfRange {
                triangle: 0,
                vertex: 9,
                vertex_count: 9,
            }),
        ),
        (indices(vec![]), RenderMeshError::Topology(TopologyError::NoTriangles)),
    ];
    for body in [CollisionBody::Fixed, CollisionBody::Rigid, CollisionBody::Deforming] {
        for (mesh, error) in &cases {
            let mut app = app();
            let handle = add(&mut app, mesh.clone());
            let entity = app.world_mut().spawn((Mesh3d(handle), body)).id();
            assert_eq!(step(&mut app).problems, [problem(entity, SelvedgeError::Mesh(error.clone()))]);
            assert_eq!(step(&mut app).problems, []);
            assert_eq!(step(&mut app).problems, []);
        }
    }
}

#[test]
fn a_body_that_cannot_be_placed_stays_where_it_was_until_it_can() {
    let mut app = app();
    let [other, mover] = two_sheets(&mut app);
    step(&mut app);
    app.world_mut().get_mut::<Transform>(mover).unwrap().translation.z = f32::NAN;
    assert_eq!(step(&mut app).problems, [problem(mover, SelvedgeError::BadTransform)]);
    assert_eq!(step(&mut app).problems, []);
    // The body is back at its earlier place.
    app.world_mut().get_mut::<Transform>(mover).unwrap().translation.z = -1.0;
    let told = step(&mut app);
    assert!(told.problems.is_empty() && told.contacts.iter().all(|contact| contact.entities.contains(&other)));
    assert!(!told.contacts.is_empty());
    // This ancestor has no place.
    let nowhere = app.world_mut().spawn_empty().id();
    app.world_mut().entity_mut(mover).insert(ChildOf(nowhere));
    assert_eq!(
        step(&mut app).problems,
        [problem(mover, SelvedgeError::NoTransform { entity: nowhere })]
    );
}

#[test]
fn a_body_out_of_the_range_of_numbers_is_told_and_the_others_go_on() {
    let mut app = app();
    let [other, mover] = two_sheets(&mut app);
    let (positions, triangles) = sheet(2);
    let handle = add(&mut app, mesh(positions, &triangles));
    // Each of the scales is a finite `f32`, but their product is not.
    let mut parent = app
        .world_mut()
        .spawn(Transform::from_scale(bevy_math::Vec3::splat(1e38)))
        .id();
    for _ in 0..7 {
        parent = app
            .world_mut()
            .spawn((Transform::from_scale(bevy_math::Vec3::splat(1e38)), ChildOf(parent)))
            .id();
    }
    let bodies = [CollisionBody::Fixed, CollisionBody::Rigid, CollisionBody::Deforming];
    let mut huge = bodies.map(|body| {
        app.world_mut()
            .spawn((
                Mesh3d(handle.clone()),
                body,
                Transform::from_scale(bevy_math::Vec3::splat(1e38)),
                ChildOf(parent),
            ))
            .id()
    });
    huge.sort_unstable();
    let told = step(&mut app);
    let entities: Vec<_> = told.problems.iter().filter_map(|problem| problem.entity).collect();
    assert_eq!(entities, huge);
    turn_over(&mut app, mover);
    let told = step(&mut app);
    assert_eq!(told.problems, []);
    assert!(!told.contacts.is_empty() && told.contacts.iter().all(|contact| contact.entities.contains(&other)));
}

#[test]
fn a_step_beyond_a_limit_is_told_and_the_next_is_done() {
    type Set = fn(&mut CollisionSettings);
    let limits: [(Set, StepError); 2] = [
        (|settings| settings.pair_limit = Some(1), StepError::TooManyPairs { limit: 1 }),
        (
            |settings| settings.memory_limit = Some(1),
            StepError::TooMuchMemory { limit: 1 },
        ),
    ];
    for (set, error) in limits {
        let mut app = app();
        let [_, mover] = two_sheets(&mut app);
        step(&mut app);
        set(&mut app.world_mut().resource_mut::<CollisionSettings>());
        turn_over(&mut app, mover);
        let told = step(&mut app);
        let error = SelvedgeError::Step(WorldError::Step(error));
        assert_eq!(told.problems, [SelvedgeProblem { entity: None, error }]);
        assert_eq!(told.contacts, []);
        *app.world_mut().resource_mut::<CollisionSettings>() = CollisionSettings::default();
        turn_over(&mut app, mover);
        assert!(!step(&mut app).contacts.is_empty());
    }
}

#[test]
fn a_setting_that_is_none_is_told_and_the_one_before_holds() {
    let mut app = app();
    let [_, mover] = two_sheets(&mut app);
    let within = |separation| Criterion::Within(Limits::within(separation));
    app.world_mut().resource_mut::<CollisionSettings>().criterion = within(0.5);
    assert!(step(&mut app).problems.is_empty());
    app.world_mut().resource_mut::<CollisionSettings>().criterion = within(f64::NAN);
    assert!(matches!(
        &step(&mut app).problems[..],
        [SelvedgeProblem {
            entity: None,
            error: SelvedgeError::Setting(_)
        }]
    ));
    // The body comes within half a unit, and no nearer.
    app.world_mut().get_mut::<Transform>(mover).unwrap().translation.z = 0.3;
    assert!(!step(&mut app).contacts.is_empty());
}
