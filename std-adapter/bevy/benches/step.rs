//! The cost of a fixed step beside the detector's own work: a thousand bodies, some of which move.

use bevy_app::{App, FixedPostUpdate};
use bevy_asset::Assets;
use bevy_ecs::entity::Entity;
use bevy_ecs::message::Messages;
use bevy_mesh::primitives::Meshable;
use bevy_mesh::{Mesh, Mesh3d, VertexAttributeValues};
use bevy_transform::components::Transform;
use selvedge_bevy::selvedge::glam::{DQuat, DVec3};
use selvedge_bevy::selvedge::{MeshMotion, Topology, World};
use selvedge_bevy::{CollisionBody, CollisionContact, Groups, SelvedgePlugin};
use std::sync::Arc;
use std::time::Instant;

const BODIES: usize = 1000;

/// Creates balls in a grid, each overlapping its neighbours.
fn place(body: usize, height: f32) -> [f32; 3] {
    [(body % 32) as f32 * 0.9, (body / 32) as f32 * 0.9, height]
}

/// Moves bodies up and down.
fn height(step: usize) -> f32 {
    if step.is_multiple_of(2) { 0.0 } else { 0.02 }
}

fn main() {
    let mesh = bevy_shape::Sphere::new(0.5)
        .mesh()
        .ico(6)
        .expect("a ball may be as coarse as that");
    let Some(VertexAttributeValues::Float32x3(positions)) = mesh.attribute(Mesh::ATTRIBUTE_POSITION) else {
        return;
    };
    let positions: Vec<DVec3> = positions.iter().map(|p| DVec3::from_array(p.map(f64::from))).collect();
    let indices: Vec<u32> = mesh
        .indices()
        .into_iter()
        .flat_map(|all| all.iter())
        .map(|index| index as u32)
        .collect();
    let triangles = indices.as_chunks::<3>().0.to_vec();
    println!("{BODIES} balls of {} triangles; median of 60 steps", triangles.len());
    let topology = Arc::new(Topology::new(positions.len(), triangles).expect("triangles of a ball"));
    for moving in [1, 10, 100] {
        let mut app = App::new();
        app.add_plugins(SelvedgePlugin);
        let handle = app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh.clone());
        let bodies: Vec<Entity> = (0..BODIES)
            .map(|body| {
                let transform = Transform::from_translation(place(body, 0.0).into());
                app.world_mut()
                    .spawn((Mesh3d(handle.clone()), CollisionBody::Rigid, transform))
                    .id()
            })
            .collect();
        let mut world = World::<DVec3>::new();
        let insert = |_| world.insert(Arc::clone(&topology), &positions, Groups::ALL).expect("a ball");
        let handles: Vec<_> = (0..BODIES).map(insert).collect();
        let pose = |body: usize, height: f32| (DQuat::IDENTITY, DVec3::from_array(place(body, height).map(f64::from)));
        let motion = |body: usize, from: f32, to: f32| {
            let [start, end] = [from, to].map(|height| pose(body, height));
            (handles[body], MeshMotion::Rigid { start, end })
        };
        let mut found = Vec::new();
        let all: Vec<_> = (0..BODIES).map(|body| motion(body, 0.0, 0.0)).collect();
        world.contacts(&all, &mut found).expect("a step");
        app.world_mut().run_schedule(FixedPostUpdate);

        let movers = || (0..moving).map(|k| k * (BODIES / moving));
        let [mut plugin, mut detector] = [Vec::new(), Vec::new()];
        for step in 0..60 {
            for body in movers() {
                if let Some(mut transform) = app.world_mut().get_mut::<Transform>(bodies[body]) {
                    transform.translation.z = height(step + 1);
                }
            }
            app.world_mut().resource_mut::<Messages<CollisionContact>>().clear();
            let begin = Instant::now();
            app.world_mut().run_schedule(FixedPostUpdate);
            plugin.push(begin.elapsed());
            let motions: Vec<_> = movers().map(|body| motion(body, height(step), height(step + 1))).collect();
            let begin = Instant::now();
            world.contacts(&motions, &mut found).expect("a step");
            detector.push(begin.elapsed());
            assert_eq!(app.world().resource::<Messages<CollisionContact>>().len(), found.len());
        }
        plugin.sort_unstable();
        detector.sort_unstable();
        println!(
            "{moving} move, {} contacts: {:?} with the plugin, {:?} without",
            found.len(),
            plugin[30],
            detector[30]
        );
    }
}
