//! C's functions beside the simulation itself. `tests/programs/simulations.c` tests wrong calls.

use super::checkpoint::*;
use super::counts::*;
use super::lead::*;
use super::loads::*;
use super::motion::*;
use super::on;
use super::run::*;
use super::state::*;
use crate::status::{Status, selvedge_last_error};
use crate::world::steps::PoseRow;
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{BroughtBody, Placement, Scene, Simulation, vertex_normals};
use std::ffi::{CStr, CString};
use std::path::Path;
use std::ptr;

#[path = "../../../files/tests/nonsense/mod.rs"]
mod nonsense;

#[test]
fn nonsense_is_refused_with_its_place_in_the_scene_and_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = CString::new(folder.path().to_str().unwrap()).unwrap();
    for (name, content, message) in nonsense::nonsense() {
        std::fs::write(folder.path().join(name), content).unwrap();
        let text = format!(
            "time_step = 0.002\nduration = 1\ncloth = {{ shape = 'file', file = '{name}', density = 0.2 }}\neffects = {{}}"
        );
        let text = CString::new(text).unwrap();
        let mut handle = ptr::null_mut();
        // SAFETY: the texts end with a zero, and there is a place for the handle.
        let status = unsafe { selvedge_simulation_new(text.as_ptr(), path.as_ptr(), 1, &raw mut handle) };
        assert_eq!(status, Status::BadScene);
        // SAFETY: the text ends with a zero and belongs to this thread, which calls nothing meanwhile.
        let said = unsafe { CStr::from_ptr(selvedge_last_error()) }.to_str().unwrap();
        let expected = format!("{0}/scene.toml:3:34: {0}/{name}: {message}", folder.path().display());
        assert_eq!(said, expected);
    }
}

const SCENE: &CStr = c"
time_step = 0.002
duration = 1
frames_per_second = 50
[[body]]
name = 'ball'
shape = 'ball'
centre = [0.2, 0.2, -0.12]
radius = 0.1
around = 16
driven = true
[cloth]
shape = 'sheet'
sides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }
cells = [10, 10]
density = 0.15
[effects.gravity]
[effects.stretch]
stiffness = 500
[effects.wind]
velocity = [0, 0, 0]
[effects.self_collision]
thickness = 0.005
[effects.body_contact]
thickness = 0.005
[effects.friction]
coefficient = 0.3
[[effects.pins.group]]
part = 'left'
driven = true
";

fn in_c(threads: usize) -> *mut SimulationHandle {
    let mut handle = ptr::null_mut();
    // SAFETY: the text ends with a zero, and there is a place for the handle.
    let status = unsafe { selvedge_simulation_new(SCENE.as_ptr(), ptr::null(), threads, &raw mut handle) };
    assert_eq!(status, Status::Ok);
    handle
}

fn in_rust() -> Simulation {
    let scene = Scene::parse(SCENE.to_str().unwrap(), Path::new("scene.toml")).unwrap();
    Simulation::new(scene, 1).unwrap()
}

/// Returns the bits that one of C's functions copies.
fn copied(count: usize, copy: impl FnOnce(*mut f64) -> Status) -> Vec<u64> {
    let mut numbers = vec![f64::NAN; 3 * count];
    assert_eq!(copy(numbers.as_mut_ptr()), Status::Ok);
    numbers.into_iter().map(f64::to_bits).collect()
}

fn bits(vectors: &[DVec3]) -> Vec<u64> {
    vectors.iter().flat_map(|it| it.to_array()).map(f64::to_bits).collect()
}

/// Sets the same next step for both: the ball rises and turns, pins sway, the wind changes.
fn lead(handle: *mut SimulationHandle, simulation: &mut Simulation, step: u32) {
    let t = f64::from(step);
    let placement = Placement::new(
        selvedge_cloth::glam::DQuat::from_rotation_z(0.002 * t),
        DVec3::new(0.0, 0.0, 0.0002 * t),
    );
    simulation.place_body(0, placement).unwrap();
    let pose = PoseRow {
        rotation: placement.rotation.to_array(),
        origin: placement.translation.to_array(),
    };
    // SAFETY: there is one entry.
    let status = unsafe { selvedge_simulation_place_body(handle, 0, &raw const pose) };
    assert_eq!(status, Status::Ok);
    let pins: Vec<[f64; 3]> = (0..11).map(|pin| [0.0, 0.04 * f64::from(pin), 0.0001 * t]).collect();
    let positions: Vec<DVec3> = pins.iter().map(|&pin| pin.into()).collect();
    simulation.move_pins(0, &positions).unwrap();
    // SAFETY: the array is as long as the count says.
    let status = unsafe { selvedge_simulation_move_pins(handle, 0, pins.as_ptr().cast(), pins.len()) };
    assert_eq!(status, Status::Ok);
    let (vertices, forces) = ([60, 61], [DVec3::new(0.0, 0.0, 0.001 * t), DVec3::X * 0.002]);
    simulation.add_forces(&vertices, &forces).unwrap();
    let numbers = forces.map(|force| force.to_array());
    // SAFETY: the arrays are as long as the count says.
    let status = unsafe { selvedge_simulation_add_forces(handle, vertices.as_ptr(), numbers.as_ptr().cast(), 2) };
    assert_eq!(status, Status::Ok);
    let wind = DVec3::new(0.0, f64::from(step % 7), -1.0);
    simulation.set_wind(wind).unwrap();
    assert_eq!(selvedge_simulation_set_wind(handle, wind.x, wind.y, wind.z), Status::Ok);
}

/// Checks that both have the same loads.
fn loads_are_alike(handle: *mut SimulationHandle, simulation: &Simulation) {
    let about = DVec3::new(0.1, 0.2, 0.3);
    let point = about.to_array();
    let mut on_body = [BodyLoadRow::default(); 2];
    let mut on_pins = [WrenchRow::default(); 2];
    let (mut contacts, mut count) = (ptr::null(), 0);
    // SAFETY: there is room for each.
    unsafe {
        for status in [
            selvedge_simulation_body_load(handle, 0, point.as_ptr(), &raw mut on_body[0]),
            selvedge_simulation_mean_body_load(handle, 0, point.as_ptr(), &raw mut on_body[1]),
            selvedge_simulation_pin_load(handle, 0, point.as_ptr(), &raw mut on_pins[0]),
            selvedge_simulation_mean_pin_load(handle, 0, point.as_ptr(), &raw mut on_pins[1]),
            selvedge_simulation_contact_loads(handle, 0, &raw mut contacts, &raw mut count),
        ] {
            assert_eq!(status, Status::Ok);
        }
    }
    let known = [simulation.body_load(0, about), simulation.mean_body_load(0, about)];
    assert_eq!(on_body, known.map(|load| load.unwrap().into()));
    let known = [simulation.pin_load(0, about), simulation.mean_pin_load(0, about)];
    assert_eq!(on_pins, known.map(|load| load.unwrap().into()));
    let known: Vec<ContactLoadRow> = simulation.contact_loads(0).map(ContactLoadRow::from).collect();
    assert_eq!(count, known.len());
    if count > 0 {
        // SAFETY: this is the list that was shown last.
        assert_eq!(unsafe { std::slice::from_raw_parts(contacts, count) }, known);
    }
}

/// Checks that both have the same state. Returns the number of near pairs.
fn are_alike(handle: *mut SimulationHandle, simulation: &Simulation) -> usize {
    let count = simulation.positions().len();
    let mut normals = Vec::new();
    vertex_normals(simulation.positions(), simulation.triangles(), &mut normals);
    let mut progress = ProgressRow::default();
    let (mut pairs, mut pair_count) = (ptr::null(), 0);
    // SAFETY: there is room for each.
    unsafe {
        let positions = copied(count, |to| selvedge_simulation_positions(handle, to, count));
        assert_eq!(positions, bits(simulation.positions()));
        let velocities = copied(count, |to| selvedge_simulation_velocities(handle, to, count));
        assert_eq!(velocities, bits(simulation.velocities()));
        assert_eq!(
            copied(count, |to| selvedge_simulation_normals(handle, to, count)),
            bits(&normals)
        );
        assert_eq!(selvedge_simulation_progress(handle, &raw mut progress), Status::Ok);
        let status = selvedge_simulation_near_pairs(handle, &raw mut pairs, &raw mut pair_count);
        assert_eq!(status, Status::Ok);
    }
    loads_are_alike(handle, simulation);
    let known = ProgressRow {
        steps_done: simulation.steps_done(),
        time: simulation.time(),
        lag: simulation.lag(),
        blocked_steps: simulation.blocked_steps(),
        overstretched_steps: simulation.overstretched_steps(),
        tolerated_pairs: simulation.tolerated_pairs(),
        is_certified: simulation.is_certified(),
    };
    assert_eq!(progress, known);
    assert!(progress.is_certified);
    let near: Vec<NearPairRow> = simulation.near_pairs().map(NearPairRow::from).collect();
    if !near.is_empty() {
        // SAFETY: this is the list that was shown last.
        assert_eq!(unsafe { std::slice::from_raw_parts(pairs, pair_count) }, near);
    }
    assert_eq!(pair_count, near.len());
    near.len()
}

#[test]
fn a_simulation_goes_as_in_rust_bit_for_bit_and_goes_on_from_rusts_checkpoint() {
    // The number of threads differs, which changes nothing.
    let (handle, mut simulation) = (in_c(2), in_rust());
    let mut sizes = SizesRow::default();
    // SAFETY: there is one entry, and there is room for all triangles.
    let triangles = unsafe {
        assert_eq!(selvedge_simulation_sizes(handle, &raw mut sizes), Status::Ok);
        let mut triangles = vec![[0; 3]; sizes.triangle_count];
        let to = triangles.as_mut_ptr().cast();
        assert_eq!(selvedge_simulation_triangles(handle, to, triangles.len()), Status::Ok);
        triangles
    };
    assert_eq!(triangles, simulation.triangles());
    assert_eq!((sizes.cloth_vertex_count, sizes.cloth_triangle_count), (121, 200));
    assert_eq!((sizes.cloth_count, sizes.body_count), (1, 1));
    assert_eq!((sizes.time_step, sizes.steps, sizes.steps_per_frame), (0.002, 500, 10));
    assert_eq!(sizes.vertex_count, simulation.positions().len());

    let mut near = 0;
    for step in 1..=200 {
        lead(handle, &mut simulation, step);
        simulation.step().unwrap();
        assert_eq!(selvedge_simulation_step(handle), Status::Ok);
        near += are_alike(handle, &simulation);
    }
    assert!(near > 1000, "{near} near pairs show little");

    let resumed = in_c(1);
    let kept = simulation.checkpoint().unwrap();
    // SAFETY: the array is as long as the count says.
    unsafe {
        assert_eq!(selvedge_simulation_resume(resumed, kept.as_ptr(), kept.len()), Status::Ok);
        let (mut bytes, mut count) = (ptr::null(), 0);
        assert_eq!(
            selvedge_simulation_checkpoint(resumed, &raw mut bytes, &raw mut count),
            Status::Ok
        );
        // Measured times continue as well.
        assert_eq!(std::slice::from_raw_parts(bytes, count), kept);
        // The simulation reads its own bytes while it shows them.
        assert_eq!(selvedge_simulation_resume(resumed, bytes, count), Status::Ok);
    }
    for step in 201..=220 {
        lead(resumed, &mut simulation, step);
        let expected = simulation.advance_within(0.016, 5).unwrap();
        let mut frame = FrameRow::default();
        // SAFETY: one entry.
        let status = unsafe { selvedge_simulation_advance(resumed, 0.016, 5, &raw mut frame) };
        assert_eq!(
            (status, frame.steps, frame.needed),
            (Status::Ok, expected.steps, expected.needed)
        );
        are_alike(resumed, &simulation);
    }
    // SAFETY: NULL is allowed.
    let [too_long, nan] =
        [2.0, f64::NAN].map(|seconds| unsafe { selvedge_simulation_advance(resumed, seconds, 9, ptr::null_mut()) });
    assert_eq!([too_long, nan], [Status::BadValue; 2]);
    are_alike(resumed, &simulation);
    assert_eq!(selvedge_simulation_free(handle), Status::Ok);
    assert_eq!(selvedge_simulation_free(resumed), Status::Ok);
}

#[test]
fn a_teleport_is_that_of_rust_and_a_jump_is_refused() {
    let (handle, mut simulation) = (in_c(1), in_rust());
    for step in 1..=20 {
        lead(handle, &mut simulation, step);
        simulation.step().unwrap();
        assert_eq!(selvedge_simulation_step(handle), Status::Ok);
    }
    let by = Placement::new(selvedge_cloth::glam::DQuat::from_rotation_x(0.5), DVec3::new(20.0, 0.0, 1.0));
    let pose = PoseRow {
        rotation: by.rotation.to_array(),
        origin: by.translation.to_array(),
    };
    let number = [0_usize];
    let teleport = |bodies: usize, cloths: usize| {
        let first = number.as_ptr();
        // SAFETY: there is one number in each list, and counts above that of the scene are refused before the list is read.
        unsafe { selvedge_simulation_teleport(handle, first, bodies, first, cloths, &raw const pose) }
    };
    simulation.teleport(&[0], &[0], by).unwrap();
    assert_eq!(teleport(2, 1), Status::WrongLength);
    assert_eq!(teleport(1, 1), Status::Ok);
    are_alike(handle, &simulation);
    simulation.step().unwrap();
    assert_eq!(selvedge_simulation_step(handle), Status::Ok);
    are_alike(handle, &simulation);
    // Twenty metres in a step of 2 ms are too fast.
    let far = PoseRow {
        origin: [0.0; 3],
        ..pose
    };
    // SAFETY: there is one entry.
    let status = unsafe { selvedge_simulation_place_body(handle, 0, &raw const far) };
    assert_eq!((status, selvedge_simulation_step(handle)), (Status::Ok, Status::Blocked));
    assert_eq!(selvedge_simulation_free(handle), Status::Ok);
}

#[test]
fn a_free_body_moves_as_in_rust_bit_for_bit() {
    let text = SCENE
        .to_str()
        .unwrap()
        .replacen("driven = true", "mass = 0.3\nvelocity = [0, 0, 1]\nspin = [1, 0, 9]", 1);
    let scene = Scene::parse(&text, Path::new("scene.toml")).unwrap();
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let text = CString::new(text).unwrap();
    let mut handle = ptr::null_mut();
    // SAFETY: the text ends with a zero, and there is a place for the handle.
    let status = unsafe { selvedge_simulation_new(text.as_ptr(), ptr::null(), 2, &raw mut handle) };
    assert_eq!(status, Status::Ok);
    for _ in 0..50 {
        simulation.step().unwrap();
        assert_eq!(selvedge_simulation_step(handle), Status::Ok);
        let mut state = FreeBodyStateRow::default();
        let mut pose = PoseRow {
            rotation: [0.0; 4],
            origin: [0.0; 3],
        };
        let (mut is_free, mut is_known) = (false, false);
        // SAFETY: there is one entry for each.
        let statuses = unsafe {
            [
                selvedge_simulation_body_motion(handle, 0, &raw mut is_free, &raw mut state),
                selvedge_simulation_placement(handle, 0, &raw mut is_known, &raw mut pose),
            ]
        };
        assert_eq!((statuses, is_free, is_known), ([Status::Ok; 2], true, true));
        let (known, placement) = (simulation.body_motion(0).unwrap(), simulation.placement(0).unwrap());
        assert_eq!(state, known.into());
        assert_eq!(pose.rotation, placement.rotation.to_array());
        assert_eq!(pose.origin, placement.translation.to_array());
    }
    assert!(simulation.body_load(0, DVec3::ZERO).unwrap().total().force.length() > 0.0);
    assert_eq!(selvedge_simulation_free(handle), Status::Ok);
}

#[test]
fn a_body_of_another_engine_yields_as_in_rust_bit_for_bit() {
    let text = SCENE
        .to_str()
        .unwrap()
        .replacen("driven = true", "mass = 0.05\nproxy = true", 1);
    let scene = Scene::parse(&text, Path::new("scene.toml")).unwrap();
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let text = CString::new(text).unwrap();
    let mut handle = ptr::null_mut();
    // SAFETY: the text ends with a zero, and there is a place for the handle.
    let status = unsafe { selvedge_simulation_new(text.as_ptr(), ptr::null(), 2, &raw mut handle) };
    assert_eq!(status, Status::Ok);
    let seconds = 1.0 / 60.0;
    let (mut velocity, spin) = (DVec3::Z, DVec3::new(0.5, 1.0, 2.0));
    let mut pushes = 0;
    for _ in 0..20 {
        let at = simulation.placement(0).unwrap();
        let turn = selvedge_cloth::glam::DQuat::from_scaled_axis(spin * seconds);
        let placement = Placement::new(turn * at.rotation, at.translation + velocity * seconds);
        let (to, row) = brought(placement, velocity, spin);
        simulation.bring_body(0, to).unwrap();
        // SAFETY: there is one entry.
        let status = unsafe { selvedge_simulation_bring_body(handle, 0, &raw const row) };
        assert_eq!(status, Status::Ok);
        simulation.advance(seconds).unwrap();
        // SAFETY: NULL is allowed.
        let status = unsafe { selvedge_simulation_advance(handle, seconds, 64, ptr::null_mut()) };
        assert_eq!(status, Status::Ok);
        are_alike(handle, &simulation);
        let (mut is_proxy, mut load) = (false, WrenchRow::default());
        // SAFETY: there is one entry for each.
        let status = unsafe { selvedge_simulation_proxy_load(handle, 0, &raw mut is_proxy, &raw mut load) };
        assert_eq!((status, is_proxy), (Status::Ok, true));
        let known = simulation.proxy_load(0).unwrap();
        assert_eq!(load, known.into());
        velocity += known.force * (seconds / 0.05);
        pushes += u32::from(known.force.z < 0.0 && known.torque.length() > 0.0);
    }
    assert!(pushes > 5, "the ball meets the sheet in {pushes} frames");
    assert_eq!(selvedge_simulation_free(handle), Status::Ok);
}

/// Returns for Rust and for C where an engine has brought a body.
fn brought(placement: Placement, velocity: DVec3, spin: DVec3) -> (BroughtBody, BroughtBodyRow) {
    let to = BroughtBody {
        placement,
        velocity,
        spin,
    };
    let row = BroughtBodyRow {
        placement: PoseRow {
            rotation: placement.rotation.to_array(),
            origin: placement.translation.to_array(),
        },
        velocity: velocity.to_array(),
        spin: spin.to_array(),
    };
    (to, row)
}

#[test]
fn a_panic_breaks_its_simulation_and_no_other() {
    let [broken, other] = [in_c(1), in_c(1)];
    assert_eq!(on(broken, |_| panic!("on purpose")), Status::Internal);
    assert_eq!(selvedge_simulation_step(broken), Status::Internal);
    assert_eq!(selvedge_simulation_step(other), Status::Ok);
    assert_eq!(selvedge_simulation_free(broken), Status::Ok);
    assert_eq!(selvedge_simulation_free(broken), Status::NoSuchSimulation);
    assert_eq!(selvedge_simulation_free(other), Status::Ok);
}

#[test]
fn a_rope_has_loose_edges_and_no_triangles_and_what_there_is_none_of_needs_no_room() {
    let rope = c"
time_step = 0.002
duration = 1
[cloth]
shape = 'rope'
points = [[0, 0, 0], [1, 0, 0]]
segments = 10
linear_density = 0.05
[effects.gravity]
[effects.rope_stretch]
stiffness = 1000
";
    let mut handle = ptr::null_mut();
    let mut sizes = SizesRow::default();
    let mut edges = [[0; 2]; 10];
    // SAFETY: the text ends with a zero, there are places for the handle and the sizes, and there is room for all edges.
    unsafe {
        assert_eq!(
            selvedge_simulation_new(rope.as_ptr(), ptr::null(), 1, &raw mut handle),
            Status::Ok
        );
        assert_eq!(selvedge_simulation_sizes(handle, &raw mut sizes), Status::Ok);
        assert_eq!((sizes.triangle_count, sizes.loose_edge_count), (0, 10));
        assert_eq!(selvedge_simulation_triangles(handle, ptr::null_mut(), 0), Status::Ok);
        let to: *mut u32 = edges.as_mut_ptr().cast();
        assert_eq!(selvedge_simulation_loose_edges(handle, to, 9), Status::WrongLength);
        assert_eq!(
            selvedge_simulation_loose_edges(handle, ptr::null_mut(), 10),
            Status::NullPointer
        );
        assert_eq!(selvedge_simulation_loose_edges(handle, to, 10), Status::Ok);
        assert_eq!(selvedge_simulation_free(handle), Status::Ok);
    }
    let [first, last] = [edges[0], edges[9]].map(|edge| [edge[0].min(edge[1]), edge[0].max(edge[1])]);
    assert_eq!([first, last], [[0, 1], [9, 10]]);
}
