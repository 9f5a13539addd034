//! A cape on a moving figure, in a window.
//!
//! `cargo run` shows it. With a folder as argument it writes pictures there and exits.

mod figure;

use bevy::prelude::*;
use bevy::render::view::window::screenshot::{Screenshot, save_to_disk};
use figure::{DURATION, Figure, Keyframes};
use selvedge_bevy::{ClothSimulation, CollisionBody, CollisionContact, CollisionGroups, Groups, SelvedgePlugin};
use std::path::PathBuf;

/// The times of the pictures in seconds.
const PICTURES: [f32; 6] = [0.9, 1.5, 2.2, 2.8, 3.1, 4.0];

/// A ball beside the path that lights up when a hand touches it.
#[derive(Component)]
struct Lamp;

/// The folder for pictures, and the number of pictures taken.
#[derive(Resource, Default)]
struct Pictures {
    folder: Option<PathBuf>,
    taken: usize,
}

fn main() {
    let folder = std::env::args_os().nth(1).map(PathBuf::from);
    let window = Window {
        title: "Selvedge: a cape in Bevy".to_owned(),
        resolution: (960, 720).into(),
        ..default()
    };
    let mut app = App::new();
    // The figure has no materials of its own.
    app.register_required_components::<Keyframes, Visibility>();
    app.add_plugins(DefaultPlugins.set(WindowPlugin {
        primary_window: Some(window),
        ..default()
    }))
    .add_plugins(SelvedgePlugin)
    .insert_resource(Pictures { folder, taken: 0 })
    .insert_resource(ClearColor(Color::srgb(0.75, 0.8, 0.85)))
    .add_systems(Startup, setup)
    .add_systems(FixedUpdate, figure::walk)
    .add_systems(Update, (follow, ring, tell, take_pictures))
    .run();
}

fn setup(world: &mut World) {
    let figure = figure::spawn(world, [32, 64]).expect("a cape may have so many cells");
    let mut materials = world.resource_mut::<Assets<StandardMaterial>>();
    let matt = |colour: Color| StandardMaterial {
        base_color: colour,
        perceptual_roughness: 0.9,
        ..default()
    };
    let skin = materials.add(matt(Color::srgb(0.35, 0.4, 0.5)));
    let ground = materials.add(matt(Color::srgb(0.5, 0.55, 0.45)));
    let cape = materials.add(StandardMaterial {
        double_sided: true,
        cull_mode: None,
        ..matt(Color::srgb(0.7, 0.1, 0.12))
    });
    let Figure { parts, cape: own } = &figure;
    for &part in parts {
        world.entity_mut(part).insert(MeshMaterial3d(skin.clone()));
    }
    world.entity_mut(*own).insert(MeshMaterial3d(cape));
    let plane = world
        .resource_mut::<Assets<Mesh>>()
        .add(Plane3d::default().mesh().size(12.0, 12.0));
    world.spawn((Mesh3d(plane), MeshMaterial3d(ground), Transform::from_xyz(0.0, 0.05, 0.0)));
    let dark = world
        .resource_mut::<Assets<StandardMaterial>>()
        .add(matt(Color::srgb(0.25, 0.25, 0.3)));
    let ball = world.resource_mut::<Assets<Mesh>>().add(Sphere::new(0.05));
    for z in [0.5, 1.2, 1.9] {
        let at = Transform::from_xyz(-0.33, 1.0, z);
        let groups = CollisionGroups(Groups::new(0b10, 0b01));
        world.spawn((
            Lamp,
            CollisionBody::Fixed,
            groups,
            Mesh3d(ball.clone()),
            MeshMaterial3d(dark.clone()),
            at,
        ));
    }
    world.spawn((
        DirectionalLight {
            illuminance: 9_000.0,
            shadow_maps_enabled: true,
            ..default()
        },
        Transform::from_xyz(-3.0, 5.0, -3.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
    world.spawn((Camera3d::default(), Transform::default()));
}

/// Keeps the camera beside and behind the figure.
fn follow(torso: Query<&GlobalTransform, With<Keyframes>>, mut camera: Single<&mut Transform, With<Camera3d>>) {
    let farthest = torso.iter().map(|place| place.translation().z).fold(0.0, f32::max);
    let centre = Vec3::new(0.0, 0.95, farthest);
    **camera = Transform::from_translation(centre + Vec3::new(-1.7, 0.7, -2.0)).looking_at(centre, Vec3::Y);
}

/// Lights up the ball when a contact message names it.
fn ring(
    mut contacts: MessageReader<CollisionContact>,
    mut lamps: Query<&mut MeshMaterial3d<StandardMaterial>, With<Lamp>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut lit: Local<Option<Handle<StandardMaterial>>>,
) {
    for entity in contacts.read().flat_map(|contact| contact.entities) {
        if let Ok(mut material) = lamps.get_mut(entity) {
            let light = || materials.add(StandardMaterial::from(Color::srgb(1.0, 0.85, 0.2)));
            material.0 = lit.get_or_insert_with(light).clone();
        }
    }
}

/// Logs the certificate once a second.
fn tell(time: Res<Time<Fixed>>, mut second: Local<u32>, cape: Single<&ClothSimulation>) {
    if time.elapsed_secs() as u32 > *second
        && let Some(simulation) = cape.simulation()
    {
        *second += 1;
        info!(
            "{:.2} s: certified {}, blocked steps {}",
            simulation.time(),
            simulation.is_certified(),
            simulation.blocked_steps()
        );
    }
}

fn take_pictures(
    time: Res<Time<Fixed>>,
    mut pictures: ResMut<Pictures>,
    mut commands: Commands,
    mut exit: MessageWriter<AppExit>,
) {
    let now = time.elapsed_secs();
    let Some(folder) = &pictures.folder else { return };
    match PICTURES.get(pictures.taken) {
        Some(&due) if now >= due => {
            let path = folder.join(format!("cape-{:.1}.png", due));
            commands.spawn(Screenshot::primary_window()).observe(save_to_disk(path));
            pictures.taken += 1;
        }
        None if now >= DURATION => drop(exit.write(AppExit::Success)),
        _ => {}
    }
}
