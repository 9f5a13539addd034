//! Measures the cost of a world beyond that of its moving meshes. It has a cloth alone, the same cloth beside many resting
//! meshes, and steps before and after a large mesh is inserted.
//!
//! ```sh
//! cargo bench -p selvedge --bench world
//! ```
//!
//! All worlds of a table take their steps in turn; the shortest time of each counts.

use selvedge::glam::Vec3;
use selvedge::{CollisionDetector, Groups, MeshHandle, MeshMotion, Topology, World};
use std::sync::Arc;
use std::time::Instant;

const STEPS: usize = 60;
const RESTING: usize = 1000;

fn main() {
    for quads in [32, 100] {
        beside_what_rests(quads);
    }
    insertion();
}

/// Makes a sheet of so many quads along each side, each of two triangles.
fn sheet(across: u32, along: u32) -> Topology {
    let at = |x: u32, y: u32| y * (across + 1) + x;
    let quads = (0..along).flat_map(|y| (0..across).map(move |x| (x, y)));
    let triangles = quads.flat_map(|(x, y)| {
        let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)];
        [[a, b, c], [b, d, c]]
    });
    let vertices = (across + 1) * (along + 1);
    Topology::new(vertices as usize, triangles.collect()).expect("vertices that exist")
}

/// Returns its vertices, a unit apart, with waves that travel with time, above a place.
fn waves(across: u32, along: u32, time: f32, place: Vec3) -> Vec<Vec3> {
    let vertices = (0..=along).flat_map(|y| (0..=across).map(move |x| (x as f32, y as f32)));
    let wave = |(x, y): (f32, f32)| Vec3::new(x, y, 3.0 * (0.4 * x + time).sin() * (0.3 * y).cos());
    vertices.map(|point| place + wave(point)).collect()
}

fn cloth(quads: u32, step: usize) -> [Vec<Vec3>; 2] {
    [step, step + 1].map(|step| waves(quads, quads, 0.1 * step as f32, Vec3::ZERO))
}

fn moves(world: &mut World<Vec3>, mesh: MeshHandle, [start, end]: &[Vec<Vec3>; 2]) -> f64 {
    let mut contacts = Vec::new();
    let clock = Instant::now();
    let motion = (mesh, MeshMotion::Deforming { start, end });
    world.contacts(&[motion], &mut contacts).expect("in order");
    clock.elapsed().as_secs_f64()
}

/// Returns meshes that rest, in rows, at this height.
fn resting(above: f32) -> impl Iterator<Item = Vec<Vec3>> {
    (0..RESTING as u32).map(move |k| {
        let place = Vec3::new(30.0 * (k % 32) as f32 - 430.0, 25.0 * (k / 32) as f32 - 360.0, above);
        waves(25, 20, 0.0, place)
    })
}

fn beside_what_rests(quads: u32) {
    let (topology, small) = (Arc::new(sheet(quads, quads)), Arc::new(sheet(25, 20)));
    let [first, _] = cloth(quads, 0);
    // The cloth meets nothing, meshes out of reach, or meshes in its way.
    let mut worlds = [None, Some(8.0), Some(-1.5)].map(|above| {
        let mut world = World::<Vec3>::new();
        let cloth = world.insert(Arc::clone(&topology), &first, Groups::ALL).expect("in order");
        for own in above.into_iter().flat_map(resting) {
            world.insert(Arc::clone(&small), &own, Groups::ALL).expect("in order");
        }
        (world, cloth)
    });
    // These are detectors of the first world and of the last, as one mesh.
    let still: Vec<Vec3> = resting(-1.5).flatten().collect();
    let mut triangles = topology.triangles().to_vec();
    for k in 0..RESTING {
        let before = (first.len() + k * small.vertex_count()) as u32;
        triangles.extend(small.triangles().iter().map(|own| own.map(|vertex| vertex + before)));
    }
    let mut alone = CollisionDetector::<f32>::new(Arc::clone(&topology));
    let vertices = first.len() + still.len();
    let mut union = CollisionDetector::<f32>::new(Topology::new(vertices, triangles).expect("vertices that exist"));
    let moving: Vec<bool> = (0..vertices).map(|vertex| vertex < first.len()).collect();
    union.set_moving(Some(&moving)).expect("one for each vertex");

    let mut least = [f64::INFINITY; 5];
    for step in 0..STEPS {
        let frames = cloth(quads, step);
        let all = frames.each_ref().map(|frame| [frame, &still[..]].concat());
        let time = |detector: &mut CollisionDetector<f32>, [start, end]: &[Vec<Vec3>; 2]| {
            let mut contacts = Vec::new();
            let clock = Instant::now();
            detector.contacts(start, end, &mut contacts).expect("in order");
            clock.elapsed().as_secs_f64()
        };
        let (alone, union) = (time(&mut alone, &frames), time(&mut union, &all));
        let [a, b, c] = worlds.each_mut().map(|(world, cloth)| moves(world, *cloth, &frames));
        for (least, time) in least.iter_mut().zip([alone, a, b, c, union]) {
            *least = least.min(time);
        }
    }
    let [detector, alone, apart, touching, union] = least.map(|seconds| seconds * 1e3);
    println!(
        "cloth of {} triangles, {RESTING} resting meshes of 1000; ms a step, ratio to the world of the cloth alone",
        2 * quads * quads
    );
    println!("  detector of the cloth          {detector:8.3}  {:.3}", detector / alone);
    println!("  world of the cloth             {alone:8.3}");
    println!("  beside meshes out of reach     {apart:8.3}  {:.3}", apart / alone);
    println!("  through meshes in its way      {touching:8.3}  {:.3}", touching / alone);
    println!("  the same as one detector's     {union:8.3}  {:.3}", union / alone);
}

/// Inserts a mesh of 100,000 triangles into a world of a cloth and many resting meshes.
fn insertion() {
    let (quads, large) = (100, Arc::new(sheet(250, 200)));
    let positions = waves(250, 200, 0.0, Vec3::new(-800.0, 0.0, 8.0));
    let topology = Arc::new(sheet(quads, quads));
    let small = Arc::new(sheet(25, 20));
    let mut least = [f64::INFINITY; 5];
    for run in 0..5 {
        let mut world = World::<Vec3>::new();
        let [first, _] = cloth(quads, 0);
        let mesh = world.insert(Arc::clone(&topology), &first, Groups::ALL).expect("in order");
        for own in resting(8.0) {
            world.insert(Arc::clone(&small), &own, Groups::ALL).expect("in order");
        }
        let before = (0..10)
            .map(|step| moves(&mut world, mesh, &cloth(quads, step)))
            .fold(f64::INFINITY, f64::min);
        let clock = Instant::now();
        world.insert(Arc::clone(&large), &positions, Groups::ALL).expect("in order");
        let inserted = clock.elapsed().as_secs_f64();
        let [after, later] = [10, 11].map(|step| moves(&mut world, mesh, &cloth(quads, step)));
        let mut detector = CollisionDetector::<f32>::new(Arc::clone(&large));
        let still = vec![false; positions.len()];
        detector.set_moving(Some(&still)).expect("one for each vertex");
        let clock = Instant::now();
        detector.contacts(&positions, &positions, &mut Vec::new()).expect("in order");
        let built = clock.elapsed().as_secs_f64();
        if run > 0 {
            for (least, time) in least.iter_mut().zip([before, inserted, after, later, built]) {
                *least = least.min(time);
            }
        }
    }
    let [before, inserted, after, later, built] = least.map(|seconds| seconds * 1e3);
    println!(
        "100,000 triangles inserted beside a cloth of {} and {RESTING} resting meshes; ms",
        2 * quads * quads
    );
    println!("  a step before             {before:8.3}");
    println!("  insertion                 {inserted:8.3}");
    println!(
        "  the step after it         {after:8.3}  {:.3} of that before",
        after / before
    );
    println!("  the next                  {later:8.3}  {:.3}", later / before);
    println!("  a detector of it alone    {built:8.3}  {:.3} insertions", built / inserted);
}
