//! The plugin in an app without a window, and without the rest of Bevy.

mod bodies;
mod cloth;
mod contacts;
mod engine_bodies;
mod free;
mod loads;
mod problems;
mod teleports;

#[path = "../../example/src/figure.rs"]
mod figure;
#[allow(dead_code, reason = "the examples use the rest")]
#[path = "../../examples/scenes/mod.rs"]
mod scenes;

use bevy_app::{App, FixedLast, TaskPoolPlugin};
use bevy_asset::{AssetPlugin, Assets, Handle, RenderAssetUsages};
use bevy_ecs::message::MessageReader;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::ResMut;
use bevy_mesh::{Indices, Mesh, MeshPlugin, PrimitiveTopology};
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use selvedge_bevy::{CollisionContact, SelvedgePlugin, SelvedgeProblem};

/// The messages since the last reading.
#[derive(Resource, Default)]
struct Told {
    contacts: Vec<CollisionContact>,
    problems: Vec<SelvedgeProblem>,
}

fn listen(
    mut told: ResMut<'_, Told>,
    mut contacts: MessageReader<'_, '_, CollisionContact>,
    mut problems: MessageReader<'_, '_, SelvedgeProblem>,
) {
    told.contacts.extend(contacts.read());
    told.problems.extend(problems.read().cloned());
}

/// Makes an app in which each update is one fixed step.
fn app() -> App {
    let mut app = App::new();
    app.add_plugins((
        TaskPoolPlugin::default(),
        TimePlugin,
        TransformPlugin,
        AssetPlugin::default(),
        MeshPlugin,
        SelvedgePlugin,
    ))
    .insert_resource(TimeUpdateStrategy::FixedTimesteps(1))
    .init_resource::<Told>()
    .add_systems(FixedLast, listen);
    app.finish();
    app.cleanup();
    // Time starts with the first update.
    app.update();
    app
}

/// Runs one fixed step, and returns its messages.
fn step(app: &mut App) -> Told {
    app.update();
    std::mem::take(&mut *app.world_mut().resource_mut::<Told>())
}

fn add(app: &mut App, mesh: Mesh) -> Handle<Mesh> {
    app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh)
}

fn empty_mesh() -> Mesh {
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::all())
}

fn mesh(positions: Vec<[f32; 3]>, triangles: &[[u32; 3]]) -> Mesh {
    empty_mesh()
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_indices(Indices::U32(triangles.as_flattened().to_vec()))
}

/// Returns a square of 2 by 2 about the origin, at height zero, of n by n cells, with waves so that no position is special.
fn sheet(n: u32) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let coordinate = |k: u32| 2.0 * k as f32 / n as f32 - 1.0;
    let vertices = (0..=n).flat_map(|i| (0..=n).map(move |j| (i, j)));
    let positions = vertices.map(|(i, j)| {
        let (x, y) = (coordinate(i), coordinate(j));
        [x, y, 0.05 * (3.0 * x + 2.0 * y).sin()]
    });
    let cells = (0..n).flat_map(|i| (0..n).map(move |j| i * (n + 1) + j));
    let triangles = cells.flat_map(|a| [[a, a + n + 1, a + 1], [a + 1, a + n + 1, a + n + 2]]);
    (positions.collect(), triangles.collect())
}
