//! Bodies come and go, and change.

use crate::{add, app, empty_mesh, mesh, sheet, step};
use bevy_app::App;
use bevy_asset::{Assets, Handle};
use bevy_ecs::entity::Entity;
use bevy_math::Vec3;
use bevy_mesh::primitives::Meshable;
use bevy_mesh::{Mesh, Mesh3d};
use bevy_transform::components::Transform;
use selvedge_bevy::{CollisionBody, CollisionGroups, CollisionMesh, Groups, PairKind};

fn sheet_mesh(app: &mut App) -> Handle<Mesh> {
    let (positions, triangles) = sheet(3);
    add(app, mesh(positions, &triangles))
}

fn spawn(app: &mut App, mesh: &Handle<Mesh>, body: CollisionBody, height: f32) -> Entity {
    app.world_mut()
        .spawn((Mesh3d(mesh.clone()), body, Transform::from_xyz(0.0, 0.0, height)))
        .id()
}

fn move_to(app: &mut App, entity: Entity, height: f32) {
    app.world_mut().get_mut::<Transform>(entity).unwrap().translation.z = height;
}

/// Returns the bodies that the first meets as it moves through them all, and back.
fn met(app: &mut App, mover: Entity) -> Vec<Entity> {
    let mut met = Vec::new();
    for height in [-9.0, 9.0] {
        move_to(app, mover, height);
        let told = step(app);
        assert_eq!(told.problems, []);
        met = told
            .contacts
            .iter()
            .flat_map(|contact| contact.entities)
            .filter(|&entity| entity != mover)
            .collect();
        met.sort_unstable();
        met.dedup();
    }
    met
}

#[test]
fn an_entity_that_is_despawned_or_loses_its_body_leaves() {
    let mut app = app();
    let mesh = sheet_mesh(&mut app);
    let mover = spawn(&mut app, &mesh, CollisionBody::Rigid, 9.0);
    let mut others = [1.0, 2.0, 3.0].map(|height| spawn(&mut app, &mesh, CollisionBody::Fixed, height));
    others.sort_unstable();
    assert_eq!(met(&mut app, mover), others);
    app.world_mut().despawn(others[0]);
    assert_eq!(met(&mut app, mover), others[1..]);
    app.world_mut().entity_mut(others[1]).remove::<CollisionBody>();
    assert_eq!(met(&mut app, mover), others[2..]);
    app.world_mut().entity_mut(others[2]).remove::<Mesh3d>();
    assert_eq!(met(&mut app, mover), []);
    app.world_mut().entity_mut(others[1]).insert(CollisionBody::Deforming);
    assert_eq!(met(&mut app, mover), [others[1]]);
    app.world_mut().despawn(mover);
    assert_eq!(step(&mut app).contacts, []);
}

#[test]
fn bodies_whose_groups_do_not_meet_have_no_contacts() {
    let mut app = app();
    let mesh = sheet_mesh(&mut app);
    let (figure, cloth) = (Groups::new(1, 2), Groups::new(2, 1));
    let mover = spawn(&mut app, &mesh, CollisionBody::Rigid, 9.0);
    let others = [1.0, 2.0].map(|height| spawn(&mut app, &mesh, CollisionBody::Fixed, height));
    for (entity, groups) in [(mover, figure), (others[0], figure), (others[1], cloth)] {
        app.world_mut().entity_mut(entity).insert(CollisionGroups(groups));
    }
    assert_eq!(met(&mut app, mover), [others[1]]);
    // Groups may change.
    app.world_mut().entity_mut(others[0]).insert(CollisionGroups(cloth));
    app.world_mut().entity_mut(others[1]).insert(CollisionGroups(figure));
    assert_eq!(met(&mut app, mover), [others[0]]);
}

#[test]
fn a_body_starts_when_its_mesh_is_there_where_it_is_then() {
    let mut app = app();
    let mesh = sheet_mesh(&mut app);
    let late = app.world().resource::<Assets<Mesh>>().reserve_handle();
    let mover = spawn(&mut app, &late, CollisionBody::Rigid, 9.0);
    let other = spawn(&mut app, &mesh, CollisionBody::Fixed, 0.0);
    assert_eq!(met(&mut app, mover), []);
    move_to(&mut app, mover, -9.0);
    let (positions, triangles) = sheet(3);
    app.world_mut()
        .resource_mut::<Assets<Mesh>>()
        .insert(&late, crate::mesh(positions, &triangles))
        .unwrap();
    // The body did not come there from above.
    assert_eq!(step(&mut app).contacts, []);
    assert_eq!(met(&mut app, mover), [other]);
}

#[test]
fn a_fixed_body_is_put_elsewhere_without_a_way_in_between() {
    let mut app = app();
    let mesh = sheet_mesh(&mut app);
    let other = spawn(&mut app, &mesh, CollisionBody::Fixed, 5.0);
    let mover = spawn(&mut app, &mesh, CollisionBody::Rigid, 0.0);
    step(&mut app);
    move_to(&mut app, other, -5.0);
    assert_eq!(step(&mut app).contacts, []);
    move_to(&mut app, mover, -9.0);
    assert!(!step(&mut app).contacts.is_empty());
}

#[test]
fn a_rigid_body_whose_scale_or_mesh_changes_goes_on_from_where_it_was() {
    let mut app = app();
    let mesh = sheet_mesh(&mut app);
    let other = spawn(&mut app, &mesh, CollisionBody::Fixed, 1.0);
    let mover = spawn(&mut app, &mesh, CollisionBody::Rigid, 0.0);
    step(&mut app);
    app.world_mut()
        .entity_mut(mover)
        .insert(Transform::from_xyz(0.0, 0.0, 2.0).with_scale(Vec3::splat(3.0)));
    let contacts = step(&mut app).contacts;
    assert!(
        contacts.iter().all(|contact| contact.entities[0] != contact.entities[1]),
        "it does not meet itself"
    );
    assert!(!contacts.is_empty());
    // The body has its new size: at its old one it would not reach the other.
    app.world_mut()
        .entity_mut(mover)
        .insert(Transform::from_xyz(3.0, 0.0, 2.0).with_scale(Vec3::splat(3.0)));
    assert_eq!(step(&mut app).contacts, []);
    move_to(&mut app, mover, 0.0);
    assert!(!step(&mut app).contacts.is_empty());
    // The body turns inside out, which a deforming body would not do without meeting itself.
    app.world_mut().get_mut::<Transform>(mover).unwrap().scale.x = -3.0;
    assert_eq!(step(&mut app).contacts, []);
    // The body gets another mesh while it moves back. Bevy reports it after the first of these steps.
    let (mut positions, triangles) = sheet(3);
    positions.iter_mut().for_each(|position| position[2] += 0.01);
    app.world_mut()
        .resource_mut::<Assets<Mesh>>()
        .insert(&mesh, crate::mesh(positions, &triangles))
        .unwrap();
    assert_eq!(step(&mut app).contacts, []);
    move_to(&mut app, mover, 2.0);
    let contacts = step(&mut app).contacts;
    assert!(!contacts.is_empty() && contacts.iter().all(|contact| contact.entities.contains(&other)));
}

#[test]
fn a_mesh_may_shrink_or_grow_before_bevy_tells_of_it() {
    let meshes = [2, 3, 5].map(sheet);
    for body in [CollisionBody::Fixed, CollisionBody::Rigid, CollisionBody::Deforming] {
        for (positions, triangles) in &meshes {
            let mut app = app();
            let (other, changing) = (sheet_mesh(&mut app), sheet_mesh(&mut app));
            let mover = spawn(&mut app, &other, CollisionBody::Rigid, 9.0);
            let first = spawn(&mut app, &changing, body, 0.0);
            step(&mut app);
            // Until now it has only reported that the mesh was added.
            step(&mut app);
            let new = crate::mesh(positions.clone(), triangles);
            app.world_mut().resource_mut::<Assets<Mesh>>().insert(&changing, new).unwrap();
            // One body has the new mesh, and one moves and changes its scale.
            let second = spawn(&mut app, &changing, body, 1.0);
            app.world_mut().get_mut::<Transform>(first).unwrap().scale = Vec3::new(1.0, 2.0, 1.0);
            move_to(&mut app, first, -1.0);
            assert_eq!(step(&mut app).problems, []);
            assert_eq!(step(&mut app).problems, []);
            let mut others = [first, second];
            others.sort_unstable();
            assert_eq!(met(&mut app, mover), others);
        }
    }
}

#[test]
fn vertices_that_bevy_parts_for_normals_are_one() {
    let mut app = app();
    // The mesh has three vertices in each corner.
    let cuboid = Mesh::from(bevy_mesh::primitives::CuboidMeshBuilder::default());
    assert_eq!(cuboid.count_vertices(), 24);
    let handle = add(&mut app, cuboid);
    let soft = spawn(&mut app, &handle, CollisionBody::Deforming, 0.0);
    step(&mut app);
    for height in [1.0, 2.0] {
        move_to(&mut app, soft, height);
        assert_eq!(step(&mut app).contacts, [], "with itself");
    }
    // A face comes off, and passes through the one on the other side.
    let mut meshes = app.world_mut().resource_mut::<Assets<Mesh>>();
    let mut cuboid = meshes.get_mut(&handle).unwrap();
    let bevy_mesh::VertexAttributeValues::Float32x3(positions) = cuboid.attribute_mut(Mesh::ATTRIBUTE_POSITION).unwrap() else {
        panic!()
    };
    positions[..4]
        .iter_mut()
        .for_each(|position| *position = [position[0] * 0.5, position[1] * 0.5, position[2] - 2.0]);
    drop(cuboid);
    let contacts = step(&mut app).contacts;
    let corners = |of: fn(u32) -> bool| {
        contacts.iter().any(|contact| {
            let [vertex, corners @ ..] = contact.vertices;
            contact.kind == PairKind::VertexFace
                && vertex < 4
                && corners.into_iter().all(|corner| corner > 3)
                && corners.into_iter().any(of)
        })
    };
    assert!(corners(|corner| corner < 8), "the other side");
    assert!(
        corners(|corner| corner > 7),
        "what it was one with, which it touched at the start"
    );
}

#[test]
fn a_collision_mesh_takes_the_place_of_the_one_that_is_seen() {
    let mut app = app();
    let (coarse, seen) = (sheet_mesh(&mut app), add(&mut app, empty_mesh()));
    let mover = app
        .world_mut()
        .spawn((
            Mesh3d(seen),
            CollisionMesh(coarse.clone()),
            CollisionBody::Rigid,
            Transform::from_xyz(0.0, 0.0, 9.0),
        ))
        .id();
    let other = spawn(&mut app, &coarse, CollisionBody::Fixed, 0.0);
    assert_eq!(met(&mut app, mover), [other]);
}

#[test]
fn meshes_of_bevys_own_shapes_collide() {
    let mut app = app();
    let sphere = add(&mut app, bevy_math_sphere());
    let mesh = sheet_mesh(&mut app);
    let mover = spawn(&mut app, &sphere, CollisionBody::Rigid, 9.0);
    let other = spawn(&mut app, &mesh, CollisionBody::Fixed, 0.0);
    assert_eq!(met(&mut app, mover), [other]);
}

/// Returns a sphere with a seam, and with poles where triangles have no area.
fn bevy_math_sphere() -> Mesh {
    bevy_shape::Sphere::new(0.5).mesh().uv(12, 8)
}
