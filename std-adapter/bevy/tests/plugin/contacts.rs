//! The contacts are those of the detector.

use crate::{add, app, mesh, sheet, step};
use bevy_app::App;
use bevy_asset::Assets;
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_mesh::{Mesh, Mesh3d};
use bevy_transform::components::Transform;
use selvedge_bevy::selvedge::glam::{DQuat, DVec3};
use selvedge_bevy::selvedge::{CollisionDetector, MeshMotion, Topology, World};
use selvedge_bevy::{CollisionBody, CollisionContact, CollisionSettings, Groups, PairKind, Threads};
use std::sync::Arc;

/// A kind, vertices and a time, for bodies that a test knows by the order of their vertices.
type Found = (PairKind, [u32; 4], u64);

fn at(x: f32, y: f32, z: f32) -> Transform {
    Transform::from_xyz(x, y, z)
}

fn transform(app: &mut App, entity: Entity, change: impl FnOnce(&mut Transform)) {
    change(&mut app.world_mut().get_mut::<Transform>(entity).unwrap());
}

/// Returns sorted contacts, with vertices numbered through all bodies.
fn found(contacts: &[CollisionContact], bodies: &[(Entity, u32)]) -> Vec<Found> {
    let first = |entity: Entity| bodies.iter().find(|body| body.0 == entity).unwrap().1;
    let mut found: Vec<Found> = contacts
        .iter()
        .map(|contact| {
            let [one, other] = contact.entities.map(first);
            let [a, b, c, d] = contact.vertices;
            let vertices = match contact.kind {
                PairKind::VertexFace => [a + one, b + other, c + other, d + other],
                PairKind::EdgeEdge => [a + one, b + one, c + other, d + other],
            };
            in_order(contact.kind, vertices, contact.time)
        })
        .collect();
    found.sort_unstable();
    found
}

/// Sorts the vertices: a face may start at any corner, and two edges may come in any order.
fn in_order(kind: PairKind, [a, b, c, d]: [u32; 4], time: f64) -> Found {
    let vertices = match kind {
        PairKind::VertexFace => {
            let mut face = [b, c, d];
            face.sort_unstable();
            [a, face[0], face[1], face[2]]
        }
        PairKind::EdgeEdge => {
            let mut edges = [[a.min(b), a.max(b)], [c.min(d), c.max(d)]];
            edges.sort_unstable();
            [edges[0][0], edges[0][1], edges[1][0], edges[1][1]]
        }
    };
    (kind, vertices, time.to_bits())
}

#[test]
fn contacts_of_deforming_bodies_are_those_of_a_detector_bit_for_bit() {
    let (floor, triangles) = sheet(4);
    let (cloth, cloth_triangles) = sheet(9);
    // The sheet falls, and folds onto itself.
    let deformed = |turn: f32| -> Vec<[f32; 3]> {
        let folded = |&[x, y, z]: &[f32; 3]| {
            if x > 0.3 {
                [x - 1.4 * turn, y * 0.93, z + 0.25 - 0.3 * turn]
            } else {
                [x, y, z + 0.2 - 0.3 * turn]
            }
        };
        cloth.iter().map(folded).collect()
    };
    let mut app = app();
    let handles = [
        add(&mut app, mesh(floor.clone(), &triangles)),
        add(&mut app, mesh(deformed(0.0), &cloth_triangles)),
    ];
    let [ground, falling] = handles.clone();
    let ground = app
        .world_mut()
        .spawn((Mesh3d(ground), CollisionBody::Fixed, at(0.25, -0.5, 0.0)))
        .id();
    let falling = app.world_mut().spawn((Mesh3d(falling), CollisionBody::Deforming)).id();
    assert_eq!(step(&mut app).contacts, []);
    let mut meshes = app.world_mut().resource_mut::<Assets<Mesh>>();
    meshes
        .get_mut(&handles[1])
        .unwrap()
        .insert_attribute(Mesh::ATTRIBUTE_POSITION, deformed(1.0));
    let told = step(&mut app);

    let wide = |positions: &[[f32; 3]]| -> Vec<DVec3> { positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect() };
    let place = |p: DVec3| p + DVec3::new(0.25, -0.5, 0.0);
    let still: Vec<DVec3> = wide(&floor).into_iter().map(place).collect();
    let mut parts = [
        (ground, [still.clone(), still], triangles),
        (
            falling,
            [deformed(0.0), deformed(1.0)].map(|positions| wide(&positions)),
            cloth_triangles,
        ),
    ];
    // Bodies have this order.
    parts.sort_unstable_by_key(|part| part.0);
    let [one, other] = &parts;
    let count = one.1[0].len() as u32;
    let own = found(&told.contacts, &[(one.0, 0), (other.0, count)]);
    let second = other.2.iter().map(|triangle| triangle.map(|vertex| vertex + count));
    let all: Vec<[u32; 3]> = one.2.iter().copied().chain(second).collect();
    let [start, end] = [0, 1].map(|frame| [&one.1[frame][..], &other.1[frame]].concat());
    let mut detector = CollisionDetector::<f64>::new(Topology::new(start.len(), all).unwrap());
    let mut contacts = Vec::new();
    detector.contacts(&start, &end, &mut contacts).unwrap();
    let mut expected: Vec<Found> = contacts
        .iter()
        .map(|contact| {
            let vertices = detector.topology().vertices_of(contact.kind, contact.pair);
            in_order(contact.kind, vertices, contact.time)
        })
        .collect();
    expected.sort_unstable();
    let meets_itself = |found: &Found| found.1.iter().all(|&vertex| (vertex >= count) == (found.1[0] >= count));
    assert!(
        own.iter().any(meets_itself) && !own.iter().all(meets_itself),
        "both are to happen"
    );
    assert_eq!(own, expected);
}

#[test]
fn contacts_of_bodies_that_turn_are_those_of_a_world_of_meshes_bit_for_bit() {
    let (positions, triangles) = sheet(6);
    let mut app = app();
    let handle = add(&mut app, mesh(positions.clone(), &triangles));
    let spawn = |app: &mut App, transform: Transform| {
        app.world_mut()
            .spawn((Mesh3d(handle.clone()), CollisionBody::Rigid, transform))
            .id()
    };
    let low = spawn(&mut app, at(0.1, 0.2, -0.6));
    let high = spawn(&mut app, at(0.0, 0.0, 0.2));
    assert_eq!(step(&mut app).contacts, []);
    let turn = bevy_math::Quat::from_rotation_y(1.2);
    transform(&mut app, high, |own| own.rotation = turn);
    transform(&mut app, low, |own| own.translation.z = -0.5);
    let told = step(&mut app);
    let wide: Vec<DVec3> = positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
    let [x, y, z, w] = turn.to_array().map(f64::from);
    let place = |x: f32, y: f32, z: f32| DVec3::from_array([x, y, z].map(f64::from));
    let (identity, turn) = (DQuat::IDENTITY, DQuat::from_xyzw(x, y, z, w).normalize());
    let mut motions = [
        (low, (identity, place(0.1, 0.2, -0.6)), (identity, place(0.1, 0.2, -0.5))),
        (high, (identity, place(0.0, 0.0, 0.2)), (turn, place(0.0, 0.0, 0.2))),
    ];
    // Bodies have this order.
    motions.sort_unstable_by_key(|motion| motion.0);
    let count = positions.len() as u32;
    let own = found(&told.contacts, &[(motions[0].0, 0), (motions[1].0, count)]);

    let topology = Arc::new(Topology::new(wide.len(), triangles).unwrap());
    let mut world = World::<DVec3>::new();
    let handles = motions.map(|_| world.insert(Arc::clone(&topology), &wide, Groups::ALL).unwrap());
    let [first, second] = motions.map(|(_, start, end)| MeshMotion::Rigid { start, end });
    let mut contacts = Vec::new();
    world
        .contacts(&[(handles[0], first), (handles[1], second)], &mut contacts)
        .unwrap();
    let mut expected: Vec<Found> = contacts
        .iter()
        .map(|contact| {
            let [first, second] = contact.pair.map(|feature| feature as usize);
            let offsets = contact.meshes.map(|mesh| if mesh == handles[0] { 0 } else { count });
            let vertices = match contact.kind {
                PairKind::VertexFace => {
                    let [a, b, c] = topology.triangles()[second].map(|vertex| vertex + offsets[1]);
                    [contact.pair[0] + offsets[0], a, b, c]
                }
                PairKind::EdgeEdge => {
                    let [a, b] = topology.edges()[first].map(|vertex| vertex + offsets[0]);
                    let [c, d] = topology.edges()[second].map(|vertex| vertex + offsets[1]);
                    [a, b, c, d]
                }
            };
            in_order(contact.kind, vertices, contact.time)
        })
        .collect();
    expected.sort_unstable();
    assert!(!own.is_empty());
    assert_eq!(own, expected);

    // The digest covers every digit of the points.
    let mut geometries = Vec::new();
    world.contact_geometries(&contacts, &mut geometries).unwrap();
    let sorted = |mut texts: Vec<String>| {
        texts.sort_unstable();
        texts
    };
    assert_eq!(
        sorted(
            told.contacts
                .iter()
                .map(|contact| format!("{:?}", contact.geometry))
                .collect()
        ),
        sorted(geometries.iter().map(|found| format!("{:?}", found.geometry)).collect())
    );
}

/// A corner falls onto a floor in Bevy's world.
#[test]
fn a_contact_says_where_and_along_which_normal() {
    let mut app = app();
    let floor = mesh(vec![[-5.0, -5.0, 0.0], [5.0, -5.0, 0.0], [0.0, 5.0, 0.0]], &[[0, 1, 2]]);
    let corner = mesh(vec![[0.0, 0.0, 0.0], [0.5, 0.0, 1.0], [0.0, 0.5, 1.0]], &[[0, 1, 2]]);
    let (floor, corner) = (add(&mut app, floor), add(&mut app, corner));
    let floor = app
        .world_mut()
        .spawn((Mesh3d(floor), CollisionBody::Fixed, at(0.0, 0.0, 7.0)))
        .id();
    let corner = app
        .world_mut()
        .spawn((Mesh3d(corner), CollisionBody::Rigid, at(1.0, -2.0, 7.5)))
        .id();
    assert_eq!(step(&mut app).contacts, []);
    transform(&mut app, corner, |own| own.translation.z = 6.5);
    let contacts = step(&mut app).contacts;
    let contact = contacts.iter().find(|contact| contact.kind == PairKind::VertexFace).unwrap();
    assert_eq!((contact.entities, contact.vertices), ([corner, floor], [0, 0, 1, 2]));
    let met = &contact.geometry;
    assert_eq!((met.normal, met.speed), (Some(DVec3::Z), -1.0));
    assert!(
        met.points
            .iter()
            .all(|point| point.distance(DVec3::new(1.0, -2.0, 7.0)) < 1e-6)
    );
}

#[test]
fn a_body_on_a_turning_parent_is_met_on_its_arc() {
    let mut app = app();
    let plank = mesh(vec![[1.9, -0.1, 0.0], [1.9, 0.1, 0.0], [2.0, 0.0, 0.0]], &[[0, 1, 2]]);
    // The post is between the arc of the tip and the straight way from its start to its end.
    let post = mesh(vec![[1.40, 1.40, -0.5], [1.40, 1.40, 0.5], [1.405, 1.395, 0.0]], &[[0, 1, 2]]);
    let (plank, post) = (add(&mut app, plank), add(&mut app, post));
    let hub = app.world_mut().spawn(Transform::default()).id();
    let plank = app
        .world_mut()
        .spawn((Mesh3d(plank), CollisionBody::Rigid, ChildOf(hub)))
        .id();
    let post = app.world_mut().spawn((Mesh3d(post), CollisionBody::Fixed)).id();
    assert_eq!(step(&mut app).contacts, []);
    transform(&mut app, hub, |own| {
        own.rotation = bevy_math::Quat::from_rotation_z(std::f32::consts::FRAC_PI_2)
    });
    let contacts = step(&mut app).contacts;
    assert!(!contacts.is_empty());
    for contact in contacts {
        assert!(contact.entities.contains(&plank) && contact.entities.contains(&post));
        assert!(contact.time > 0.4 && contact.time < 0.6, "{}", contact.time);
    }
}

#[test]
fn contacts_are_the_same_in_the_same_order_on_several_threads() {
    let run = |threads: usize| {
        let mut app = app();
        app.world_mut().resource_mut::<CollisionSettings>().threads = Threads::from_count(threads);
        let (positions, triangles) = sheet(12);
        let handle = add(&mut app, mesh(positions, &triangles));
        let bodies: Vec<Entity> = (0..6)
            .map(|k| {
                app.world_mut()
                    .spawn((Mesh3d(handle.clone()), CollisionBody::Rigid, at(0.0, 0.0, k as f32)))
                    .id()
            })
            .collect();
        step(&mut app);
        for (k, &body) in bodies.iter().enumerate() {
            transform(&mut app, body, |own| {
                own.rotation = bevy_math::Quat::from_rotation_x(0.4 * k as f32)
            });
        }
        step(&mut app).contacts
    };
    let alone = run(1);
    assert!(alone.len() > 100);
    assert_eq!(run(3), alone);
}
