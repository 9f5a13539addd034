//! C's messages are Rust's. `tests/messages/table.txt` has them, and the tests of the npm package read it as well.
//! `UPDATE_MESSAGES=1` writes it.

use super::last_error;
use crate::answers::{ContactRow, PairRow};
use crate::detector::{Handle, ScalarFormat, selvedge_detector_free, selvedge_detector_new};
use crate::files::selvedge_file_new;
use crate::queries::double::*;
use crate::settings::*;
use crate::simulation::checkpoint::*;
use crate::simulation::counts::*;
use crate::simulation::lead::*;
use crate::simulation::motion::*;
use crate::simulation::run::*;
use crate::status::Status;
use crate::world::steps::PoseRow;
use selvedge::core::elementary::Limits;
use selvedge::{CollisionDetector, CollisionFilter, Criterion, Topology};
use selvedge_cloth::files::mesh;
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{BroughtBody, Placement, Scene, Simulation};
use std::collections::BTreeMap;
use std::ffi::CString;
use std::fmt::Display;
use std::path::Path;
use std::{env, fs, ptr};

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/messages/table.txt");
const HEAD: &str = "# The messages of Rust, of C and of the npm package for the same mistakes: `name | message`.
# src/tests/messages.rs writes and checks it; std-adapter/web/tests/node.test.mjs checks it as well.
";
const SCENE: &str = include_str!("../../tests/messages/scene.toml");

/// The messages by the names of the mistakes.
#[derive(Default)]
struct Messages(BTreeMap<&'static str, String>);

impl Messages {
    /// Makes a mistake in Rust and in C, and compares what they say.
    fn of<T, E: Display>(&mut self, name: &'static str, in_rust: Result<T, E>, in_c: impl FnOnce() -> Status) {
        let expected = in_rust.err().expect(name).to_string();
        assert_ne!(in_c(), Status::Ok, "{name}");
        assert_eq!(last_error(), expected, "{name}");
        assert!(self.0.insert(name, expected).is_none(), "{name} stands twice");
    }
}

/// The small triangle falls through the large one.
const TRIANGLES: [[u32; 3]; 2] = [[0, 1, 2], [3, 4, 5]];
const START: [[f64; 3]; 6] = [
    [-5.0, -5.0, 0.0],
    [5.0, -5.0, 0.0],
    [0.0, 5.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.1],
    [0.0, 1.0, 1.2],
];

fn end() -> [[f64; 3]; 6] {
    let mut end = START;
    end[3..].iter_mut().for_each(|vertex| vertex[2] -= 2.0);
    end
}

fn detector_in_c() -> *mut Handle {
    let mut handle = ptr::null_mut();
    // SAFETY: the list is as long as it says.
    let status = unsafe { selvedge_detector_new(ScalarFormat::F64 as u32, 6, TRIANGLES.as_ptr().cast(), 2, &raw mut handle) };
    assert_eq!(status, Status::Ok);
    handle
}

/// Asks for the contacts of a step.
fn contacts(handle: *mut Handle, start: &[[f64; 3]], end: &[[f64; 3]]) -> Status {
    let (mut list, mut count): (*const ContactRow, _) = (ptr::null(), 0);
    // SAFETY: frames of the mesh, and places for the list. A count that is wrong is refused before a number is read.
    unsafe {
        selvedge_detector_contacts_f64(
            handle,
            start.as_ptr().cast(),
            end.as_ptr().cast(),
            start.len(),
            &raw mut list,
            &raw mut count,
        )
    }
}

fn meshes(messages: &mut Messages) {
    let new = |vertex_count, triangles: &[[u32; 3]]| {
        let mut handle = ptr::null_mut();
        // SAFETY: the list is as long as it says.
        unsafe { selvedge_detector_new(1, vertex_count, triangles.as_ptr().cast(), triangles.len(), &raw mut handle) }
    };
    messages.of(
        "a vertex that the mesh does not have",
        Topology::new(2, TRIANGLES.to_vec()),
        || new(2, &TRIANGLES),
    );
    messages.of("no triangles", Topology::new(6, vec![]), || new(6, &[]));
}

fn steps(messages: &mut Messages) {
    let mut rust = CollisionDetector::<f64>::new(Topology::new(6, TRIANGLES.to_vec()).unwrap());
    let (c, mut found) = (detector_in_c(), Vec::new());
    let short = &START[..5];
    messages.of("a short frame", rust.contacts(short, &end(), &mut found), || {
        contacts(c, short, &end())
    });
    let mut wrong = end();
    wrong[5][1] = f64::NAN;
    messages.of(
        "a coordinate that is not a number",
        rust.contacts(&START, &wrong, &mut found),
        || contacts(c, &START, &wrong),
    );
    wrong[5][1] = f64::INFINITY;
    let mut has_any = false;
    messages.of("an infinite coordinate", rust.has_intersections(&wrong), || {
        // SAFETY: positions of the mesh, and a place for the answer.
        unsafe { selvedge_detector_has_intersections_f64(c, wrong.as_ptr().cast(), 6, &raw mut has_any) }
    });
    for (name, separation, tolerance) in [
        ("a negative separation", -1.0, 0.0),
        ("a tolerance that is not a number", 0.0, f64::NAN),
    ] {
        let criterion = Criterion::Within(Limits { tolerance, separation });
        messages.of(name, rust.set_criterion(criterion), || {
            selvedge_detector_set_within(c, separation, tolerance)
        });
    }
    let mut near = Vec::new();
    messages.of("an infinite distance", rust.near(&START, f64::INFINITY, &mut near), || {
        let (mut list, mut count) = (ptr::null(), 0);
        // SAFETY: positions of the mesh, and places for the list.
        unsafe { selvedge_detector_near_f64(c, START.as_ptr().cast(), 6, f64::INFINITY, &raw mut list, &raw mut count) }
    });
    messages.of("marks of too few vertices", rust.set_moving(Some(&[true; 5])), || {
        // SAFETY: a count that is wrong is refused before a byte is read.
        unsafe { selvedge_detector_set_moving(c, [1; 5].as_ptr(), 5) }
    });
    let filter = |patches: &[u32], excluded: &[PairRow]| {
        let patches_at = if patches.is_empty() { ptr::null() } else { patches.as_ptr() };
        let (at, count) = (excluded.as_ptr(), excluded.len());
        // SAFETY: the lists are as long as they say; a count that is wrong is refused before an entry is read.
        unsafe { selvedge_detector_set_collision_filter(c, ptr::null(), patches_at, patches.len(), at, count) }
    };
    let patches = CollisionFilter::new().with_patches(vec![0; 5]);
    messages.of("patches of too few vertices", rust.set_collision_filter(patches), || {
        filter(&[0; 5], &[])
    });
    let pair = CollisionFilter::new().without_vertex_pairs([[0, 6]]);
    messages.of(
        "an excluded vertex that the mesh does not have",
        rust.set_collision_filter(pair),
        || filter(&[], &[PairRow { first: 0, second: 6 }]),
    );
    rust.set_memory_limit(Some(10));
    assert_eq!(selvedge_detector_set_memory_limit(c, 10), Status::Ok);
    messages.of("too little memory", rust.contacts(&START, &end(), &mut found), || {
        contacts(c, &START, &end())
    });
    rust.set_pair_limit(Some(1));
    assert_eq!(selvedge_detector_set_pair_limit(c, 1), Status::Ok);
    messages.of("too many pairs", rust.contacts(&START, &end(), &mut found), || {
        contacts(c, &START, &end())
    });
    assert_eq!(selvedge_detector_free(c), Status::Ok);
}

/// Starts a simulation of a text, as Rust does.
fn start(text: &str) -> Result<Simulation, String> {
    let scene = Scene::parse(text, Path::new("scene.toml")).map_err(|error| error.to_string())?;
    Simulation::new(scene, 1).map_err(|error| error.to_string())
}

fn start_in_c(text: &str) -> (Status, *mut SimulationHandle) {
    let (text, mut handle) = (CString::new(text).unwrap(), ptr::null_mut());
    // SAFETY: the text ends with a zero, and there is a place for the handle.
    let status = unsafe { selvedge_simulation_new(text.as_ptr(), ptr::null(), 1, &raw mut handle) };
    (status, handle)
}

/// Mistakes in the scene: what is replaced, and by what.
const SCENES: [(&str, &str, &str); 6] = [
    ("a scene that is no TOML", "time_step = 0.002", "time_step = = 0.002"),
    ("an unknown fabric", "density = 0.15", "material = \"velvte\""),
    ("an unknown key", "density", "densty"),
    ("an unknown effect", "[effects.gravity]", "[effects.gravty]"),
    ("a number out of its range", "density = 0.15", "density = -1"),
    (
        "a start with an intersection",
        "-0.06]\nradius = 0.05\naround = 6\ndriven",
        "-0.02]\nradius = 0.05\naround = 6\ndriven",
    ),
];

fn scenes(messages: &mut Messages) {
    for (name, from, to) in SCENES {
        assert!(SCENE.contains(from), "{name}");
        let text = SCENE.replacen(from, to, 1);
        messages.of(name, start(&text), || start_in_c(&text).0);
    }
}

fn pose(placement: Placement) -> PoseRow {
    PoseRow {
        rotation: placement.rotation.to_array(),
        origin: placement.translation.to_array(),
    }
}

fn motions(messages: &mut Messages) {
    let (mut rust, (_, c)) = (start(SCENE).unwrap(), start_in_c(SCENE));
    let place = |body, placement: Placement| {
        let pose = pose(placement);
        // SAFETY: there is one entry.
        unsafe { selvedge_simulation_place_body(c, body, &raw const pose) }
    };
    let nowhere = Placement::at(DVec3::new(0.0, f64::NAN, 0.0));
    let zero = Placement::new(DQuat::from_array([0.0; 4]), DVec3::ZERO);
    messages.of("a body that is not driven", rust.place_body(1, Placement::default()), || {
        place(1, Placement::default())
    });
    messages.of("a place that is not a number", rust.place_body(0, nowhere), || {
        place(0, nowhere)
    });
    messages.of("a rotation of zero", rust.place_body(0, zero), || place(0, zero));
    let brought = BroughtBody {
        placement: Placement::default(),
        velocity: DVec3::ZERO,
        spin: DVec3::ZERO,
    };
    messages.of("a body that is not a proxy", rust.bring_body(0, brought), || {
        let to = BroughtBodyRow {
            placement: pose(brought.placement),
            velocity: [0.0; 3],
            spin: [0.0; 3],
        };
        // SAFETY: there is one entry.
        unsafe { selvedge_simulation_bring_body(c, 0, &raw const to) }
    });
    let few = [DVec3::ZERO; 2];
    let numbers = [0.0; 6];
    messages.of("too few positions of a body", rust.move_body(0, &few), || {
        // SAFETY: there are as many positions.
        unsafe { selvedge_simulation_move_body(c, 0, numbers.as_ptr(), 2) }
    });
    messages.of("pins that the scene does not have", rust.move_pins(7, &few), || {
        // SAFETY: there are as many positions.
        unsafe { selvedge_simulation_move_pins(c, 7, numbers.as_ptr(), 2) }
    });
    messages.of("wind that is not a number", rust.set_wind(DVec3::splat(f64::NAN)), || {
        selvedge_simulation_set_wind(c, f64::NAN, f64::NAN, f64::NAN)
    });
    let by = Placement::at(DVec3::new(0.95, 0.0, -0.05));
    messages.of("a teleport into a body", rust.teleport(&[0], &[0], by), || {
        let by = pose(by);
        // SAFETY: there is one entry of each.
        unsafe { selvedge_simulation_teleport(c, &0, 1, &0, 1, &raw const by) }
    });
    messages.of("a frame of two seconds", rust.advance_within(2.0, 64), || {
        // SAFETY: no counts are asked for.
        unsafe { selvedge_simulation_advance(c, 2.0, 64, ptr::null_mut()) }
    });
    let nothing = [0_u8; 64];
    messages.of("a checkpoint that is none", rust.resume(&nothing), || {
        // SAFETY: there are as many bytes.
        unsafe { selvedge_simulation_resume(c, nothing.as_ptr(), nothing.len()) }
    });
    let far = Placement::at(DVec3::new(0.0, 0.0, -5.0));
    rust.place_body(0, far).unwrap();
    assert_eq!(place(0, far), Status::Ok);
    messages.of("a body that is too fast", rust.step(), || selvedge_simulation_step(c));
    // Rust has the names themselves, so C and JavaScript have a message of their own.
    let names = rust.body_names();
    let unknown: Result<(), _> = Err(format!("there is no body 'bull'; the scene has {names:?}"));
    messages.of("a body of another name", unknown, || {
        let mut part = PartRow::default();
        // SAFETY: the text ends with a zero, and there is a place for the answer.
        unsafe { selvedge_simulation_body(c, c"bull".as_ptr(), &raw mut part) }
    });
    assert_eq!(selvedge_simulation_free(c), Status::Ok);
    let text = SCENE.replace("[effects.wind]\nvelocity = [0, 0, 0]\n", "");
    let (mut rust, (_, c)) = (start(&text).unwrap(), start_in_c(&text));
    messages.of("a scene without wind", rust.set_wind(DVec3::X), || {
        selvedge_simulation_set_wind(c, 1.0, 0.0, 0.0)
    });
    assert_eq!(selvedge_simulation_free(c), Status::Ok);
}

fn files(messages: &mut Messages) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n").unwrap();
    let text = CString::new(path.to_str().unwrap()).unwrap();
    messages.of("a mesh file with a wrong number", mesh::read(&path), || {
        let mut handle = ptr::null_mut();
        // SAFETY: the text ends with a zero, and there is a place for the handle.
        unsafe { selvedge_file_new(text.as_ptr(), &raw mut handle) }
    });
    // The table has the message without the folder.
    let prefix = format!("{}/", folder.path().display());
    messages
        .0
        .values_mut()
        .for_each(|message| *message = message.replace(&prefix, ""));
}

#[test]
fn messages_of_c_are_those_of_rust_and_of_the_table() {
    let mut messages = Messages::default();
    meshes(&mut messages);
    steps(&mut messages);
    scenes(&mut messages);
    motions(&mut messages);
    files(&mut messages);
    let rows: String = messages
        .0
        .iter()
        .map(|(name, message)| format!("{name} | {message}\n"))
        .collect();
    let table = format!("{HEAD}{rows}");
    if env::var_os("UPDATE_MESSAGES").is_some() {
        fs::write(TABLE, &table).unwrap();
    }
    let known = fs::read_to_string(TABLE).unwrap();
    assert!(known == table, "UPDATE_MESSAGES=1 writes\n{table}");
}
