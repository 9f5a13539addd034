//! Set-up that tests share.

pub(crate) use selvedge::{CollisionDetector, Intersection, Topology};
pub(crate) use selvedge_cloth::effects::*;
pub(crate) use selvedge_cloth::glam::DVec3;
pub(crate) use selvedge_cloth::*;
pub(crate) use std::f64::consts::PI;
pub(crate) use std::path::Path;

use std::ops::Range;
use std::path::PathBuf;

pub(crate) fn scene_file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes").join(name)
}

pub(crate) fn test_scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/simulation/scenes")
}

/// Sets up a scene of the folder `scenes`, with changes.
pub(crate) fn load(name: &str, change: impl Fn(String) -> String, threads: usize) -> Simulation {
    let path = scene_file(name);
    let text = change(std::fs::read_to_string(&path).unwrap());
    set_up(&text, name, threads)
}

/// Sets up a scene as if it were in the folder `scenes`.
pub(crate) fn set_up(text: &str, name: &str, threads: usize) -> Simulation {
    let scene = Scene::parse(text, &scene_file(name)).unwrap();
    Simulation::new(scene, threads).unwrap()
}

/// Returns a valley along y with sides at a right angle to each other, of decimetre cells: `columns` on each side, `rows`, and
/// its bottom at `height` metres. Sheets of different heights lie over each other, vertex over vertex.
pub(crate) fn folded(columns: i32, rows: Range<i32>, height: f64) -> Mesh {
    let across = 2 * columns + 1;
    let vertex = |row: i32, column: i32| {
        let [x, y] = [0.07 * f64::from(column), 0.1 * f64::from(row)];
        DVec3::new(x, y, x.abs() + height)
    };
    let positions = rows
        .clone()
        .flat_map(|row| (-columns..=columns).map(move |column| vertex(row, column)));
    let cells = (0..rows.len() as i32 - 1).flat_map(|row| (0..across - 1).map(move |column| across * row + column));
    let corners = |at: i32| [[at, at + 1, at + across], [at + 1, at + across + 1, at + across]];
    Mesh::new(
        positions.collect(),
        cells.flat_map(corners).map(|t| t.map(|corner| corner as u32)).collect(),
    )
}

pub(crate) fn run(scene: Scene, steps: u64) -> Simulation {
    let mut simulation = Simulation::new(scene, 1).unwrap();
    advance(&mut simulation, steps);
    simulation
}

pub(crate) fn advance(simulation: &mut Simulation, steps: u64) {
    (0..steps).for_each(|_| simulation.step().unwrap());
}

pub(crate) fn wind(velocity: DVec3) -> Wind {
    Wind {
        velocity,
        ..Wind::default()
    }
}

pub(crate) fn resting(vertices: impl Into<Vec<u32>>) -> Pins {
    Pins {
        groups: vec![PinGroup::resting(vertices)],
    }
}

pub(crate) fn pinned(vertices: impl Into<Vec<u32>>, motion: PinMotion) -> Pins {
    let vertices = vertices.into();
    Pins {
        groups: vec![PinGroup::new(vertices, motion)],
    }
}

/// Returns a motion along straight lines between the translations at these times, at rest at each of them.
pub(crate) fn along<const N: usize>(keys: [(f64, DVec3); N]) -> BodyMotion {
    let key = |(time, translation)| Keyframe {
        time,
        translation,
        ..Keyframe::default()
    };
    let motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys.map(key).to_vec()).unwrap();
    motion.interpolated(Interpolation::Smooth).into()
}

/// Makes a square of 1 m in two triangles. One group of vertices is held, the other moves by `way` until `time`.
pub(crate) fn square([held, moved]: [&[u32]; 2], way: DVec3, time: f64, time_step: f64) -> Scene {
    let cloth = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [1, 1], 0.2).unwrap();
    let mut scene = Scene::new(cloth, time_step);
    let mut pins = pinned(moved, PinMotion::Own(along([(0.0, DVec3::ZERO), (time, way)])));
    pins.groups.push(PinGroup::resting(held));
    scene.add(pins);
    scene
}

/// Returns the number of triangles of the cloth at each of its vertices.
pub(crate) fn shares(simulation: &Simulation) -> Vec<f64> {
    let mut shares = vec![0.0; simulation.cloth_vertices()];
    let cloth = &simulation.triangles()[..simulation.cloth_triangles()];
    cloth.iter().flatten().for_each(|&vertex| shares[vertex as usize] += 1.0);
    shares
}

/// Returns the mass of each vertex of a mesh with this density, in kg: a third of its triangles'.
pub(crate) fn masses(mesh: &Mesh, density: f64) -> Vec<f64> {
    let mut masses = vec![0.0; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let third = density * (b - a).cross(c - a).length() / 6.0;
        triangle.iter().for_each(|&vertex| masses[vertex as usize] += third);
    }
    masses
}

pub(crate) fn bits(simulation: &Simulation) -> Vec<[u64; 3]> {
    let positions = simulation.positions().iter();
    positions.map(|p| p.to_array().map(f64::to_bits)).collect()
}

/// Finds intersections by the exact test, which is independent of the certificate.
pub(crate) fn intersections(simulation: &Simulation) -> Vec<Intersection> {
    let (triangles, loose) = (simulation.triangles().to_vec(), simulation.loose_edges());
    let topology = Topology::with_loose_features(simulation.positions().len(), triangles, loose, &[]).unwrap();
    let mut found = Vec::new();
    let mut detector = CollisionDetector::<f64>::new(topology);
    detector.intersections(simulation.positions(), &mut found).unwrap();
    found
}

/// Asserts that a scene has the same bits on one thread and on two, and resumed after `before` steps, for `after` steps.
#[track_caller]
pub(crate) fn assert_same_bits(scene: impl Fn() -> Scene, before: u64, after: u64) -> Simulation {
    assert!(before.is_multiple_of(CHECKPOINT_STEPS));
    let mut one = run(scene(), before);
    let [mut two, mut resumed] = [2, 2].map(|threads| Simulation::new(scene(), threads).unwrap());
    resumed.resume(&one.checkpoint().unwrap()).unwrap();
    assert_alike(&resumed, &one);
    advance(&mut two, before + after);
    for simulation in [&mut one, &mut resumed] {
        advance(simulation, after);
    }
    assert_alike(&two, &one);
    assert_alike(&resumed, &one);
    one
}

#[track_caller]
fn assert_alike(one: &Simulation, other: &Simulation) {
    assert!(bits(one) == bits(other), "step {}", one.steps_done());
    assert_eq!((one.triangles(), one.loose_edges()), (other.triangles(), other.loose_edges()));
    assert_eq!((one.torn_edges(), one.released()), (other.torn_edges(), other.released()));
    assert_eq!(
        (one.crossings(), one.tolerated_pairs()),
        (other.crossings(), other.tolerated_pairs())
    );
    assert_eq!(one.energy(), other.energy());
    assert_eq!(one.contact_counts(), other.contact_counts());
}

/// Asserts a message, or its beginning if `expected` ends with `…`.
#[track_caller]
pub(crate) fn assert_message(found: &str, expected: &str) {
    match expected.strip_suffix('…') {
        Some(beginning) => assert!(found.starts_with(beginning), "{found}\nis not\n{expected}"),
        None => assert_eq!(found, expected),
    }
}

#[track_caller]
pub(crate) fn complaint(mut scene: Scene, change: impl FnOnce(&mut Scene)) -> String {
    change(&mut scene);
    Simulation::new(scene, 1).unwrap_err().to_string()
}

/// Asserts the messages of changes to a scene, each as in [`assert_message`].
macro_rules! assert_complaints {
    ($scene:expr; $($change:expr => $expected:expr;)*) => {
        $(crate::common::assert_message(&crate::common::complaint($scene, $change), $expected);)*
    };
}
pub(crate) use assert_complaints;

/// Asserts the messages of errors, each as in [`assert_message`].
macro_rules! assert_errors {
    ($($result:expr => $expected:expr;)*) => {
        $(crate::common::assert_message(&$result.unwrap_err().to_string(), $expected);)*
    };
}
pub(crate) use assert_errors;
