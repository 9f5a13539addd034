//! A cape on a moving figure, in a window.
//!
//! `cargo run` shows it, over and over. With a folder as argument it ends after one round, and leaves pictures there.

mod figure;

use bevy::prelude::*;
use bevy::render::view::window::screenshot::{Screenshot, save_to_disk};
use figure::{DURATION, Figure};
use selvedge_bevy::{BodyContact, ClothSimulation, SelvedgePlugin};
use std::path::PathBuf;

/// When pictures are taken, in seconds.
const PICTURES: [f32; 6] = [0.4, 1.3, 2.2, 2.8, 3.1, 4.0];

/// Where pictures go, and how many were taken.
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
    App::new()
        .add_plugins(DefaultPlugins.set(WindowPlugin {
            primary_window: Some(window),
            ..default()
        }))
        .add_plugins(SelvedgePlugin)
        .insert_resource(Pictures { folder, taken: 0 })
        .insert_resource(ClearColor(Color::srgb(0.75, 0.8, 0.85)))
        .add_systems(Startup, setup)
        .add_systems(FixedUpdate, figure::walk)
        .add_systems(Update, (follow, tell, take_pictures))
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

/// The camera stays beside and behind the figure.
fn follow(torso: Query<&GlobalTransform, With<figure::Keyframes>>, mut camera: Single<&mut Transform, With<Camera3d>>) {
    let farthest = torso.iter().map(|place| place.translation().z).fold(0.0, f32::max);
    let centre = Vec3::new(0.0, 0.95, farthest);
    **camera = Transform::from_translation(centre + Vec3::new(-1.7, 0.7, -2.0)).looking_at(centre, Vec3::Y);
}

/// What the certificate says, once a second.
fn tell(
    time: Res<Time<Fixed>>,
    mut second: Local<u32>,
    mut contacts: MessageReader<BodyContact>,
    cape: Single<&ClothSimulation>,
) {
    let met = contacts.read().count();
    if time.elapsed_secs() as u32 > *second
        && let Some(simulation) = cape.simulation()
    {
        *second += 1;
        info!(
            "{:.2} s: certified {}, blocked steps {}, contacts {met}",
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
