//! Twenty common mistakes in scene files, and their messages.

use crate::common::assert_messages;
use selvedge_cloth::Scene;
use std::path::Path;

const GOOD: &str = r#"time_step = "2 ms"
duration = "1 s"
on_blocked = "hold"

[cloth]
shape = "sheet"
sides = { first = [0.3, 0, 0], second = [0, 0.3, 0] }
cells = [10, 10]
density = "200 g/m2"

[[body]]
name = "ball"
shape = "ball"
centre = [0, 0, -1]
radius = "10 cm"
keyframes = [{ time = 0 }, { time = "1 s", translation = [0, 0, 0.5] }]

[effects.gravity]
acceleration = [0, 0, -9.81]

[effects.stretch]
stiffness = "1 kN/m"

[effects.body_contact]
thickness = "3 mm"

[effects.friction]
coefficient = 0.3

[[effects.pins.group]]
part = "bottom-left"
"#;

#[test]
fn the_scene_that_the_mistakes_are_made_in_is_good() {
    let scene = Scene::parse(GOOD, Path::new("s.toml")).unwrap();
    let names = ["gravity", "pins", "stretch", "body_contact", "friction"];
    assert_eq!(scene.effect_names(), names);
    assert_eq!((scene.name.as_str(), scene.steps()), ("s", 500));
}

#[test]
fn twenty_mistakes_get_twenty_messages_that_say_what_to_do() {
    // The library words the message about a file that is not TOML; the place comes from this crate.
    for (passage, by) in [
        ("[cloth]", "[cloth"),
        ("[effects.gravity]", "[effects.gravity]\n[effects.gravity]"),
    ] {
        let error = Scene::parse(&GOOD.replacen(passage, by, 1), Path::new("s.toml"))
            .unwrap_err()
            .to_string();
        assert!(error.starts_with("s.toml:") && error.len() > 20, "{error}");
    }
    assert_messages(
        GOOD,
        r#"
        time_step => timestep
            s.toml:1:1: a scene has no key 'timestep'; did you mean 'time_step'?
        effects.gravity => effects.gravitation
            s.toml:18:10: there is no effect 'gravitation'; did you mean 'gravity'?
        effects.stretch => effects.magnetism
            s.toml:21:10: there is no effect 'magnetism'; choose from gravity, wind, wind_field, inflation, air_drag, pins, attachments, stretch, shear, bend, plastic_folds, internal_pressure, strain_limit, seams, rope_bend, rope_stretch, body_contact, self_collision, friction, tearing
        coefficient => mu
            s.toml:28:1: [effects.friction] has no key 'mu'; choose from coefficient
        shape = "sheet" => shape = "sheat"
            s.toml:6:9: `shape` cannot be 'sheat'; did you mean 'sheet'?
        bottom-left => bottom_left
            s.toml:31:8: this cloth has no part 'bottom_left'; did you mean 'bottom-left'?
        on_blocked = "hold" => on_blocked = "wait"
            s.toml:3:14: `on_blocked` cannot be 'wait'; choose from stop, hold, yield
        density = "200 g/m2"\n =>
            s.toml:5:1: [cloth] needs `density`, such as 0.5 (in kg/m2) or "5 g/m2"
        duration = "1 s"\n =>
            s.toml:1:1: a scene needs `duration`, such as 0.5 (in s) or "5 ms"
        "3 mm" => "3 kg"
            s.toml:25:13: `thickness` must be a length, but 'kg' is not a unit of it; choose from m, mm, cm, um
        "3 mm" => "thin"
            s.toml:25:13: `thickness` must be a length, such as 0.5 (in m) or "5 mm", not 'thin'
        "3 mm" => 3
            s.toml:25:13: `thickness` is 3 m, but must be from 1e-5 m to 0.1 m
        "2 ms" => 0
            s.toml:1:13: `time_step` is 0 s, but must be from 1e-6 s to 0.0167 s; use a shorter step, or frames (without `time_step`, or `advance` in code), which take as many steps as the cloth needs
        [0, 0, -9.81] => -9.81
            s.toml:19:16: `acceleration` must be a list of three numbers, such as [0, 0, 1], but is of type float
        [10, 10] => [10, 0]
            s.toml:8:14: `cells` is 0, but must be from 1 to 2000
        { time = "1 s", => { time = 0,
            s.toml:16:37: keyframes must be in order: each `time` at least a microsecond after the one before
        translation = [0, 0, 0.5] => angle = 1e4
            s.toml:16:52: before this keyframe the motion turns by 30.0 rad per time step, but the limit is 6; choose a shorter `time_step` or a later keyframe
        name = "ball" => name = "a\u001b[2Jb"
            s.toml:12:8: `name` must be text without control characters, line breaks included, but is the text 'a\u{1b}[2Jb'
        [effects.body_contact]\nthickness = "3 mm"\n =>
            s.toml:25:1: 'friction' has nothing to act on: it needs [effects.self_collision] or [effects.body_contact] in the scene
        [effects.gravity]\nacceleration = [0, 0, -9.81] => [effects.internal_pressure]\nvolume = 1.2
            s.toml:19:10: internal pressure needs a closed cloth, but this one has 40 open edges
        part = "bottom-left" => ball = { centre = [5, 0, 0], radius = 0.1 }
            s.toml:31:8: no vertex of the cloth is in this group
        [[effects.pins.group]]\npart = "bottom-left" => [effects.pins]
            s.toml:30:1: pins need at least one [[effects.pins.group]]
    "#,
    );
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let error = Scene::read(Path::new("no/such/scene.toml")).unwrap_err();
    assert!(error.to_string().starts_with("no/such/scene.toml: cannot be read: "));
}

#[test]
fn the_scenes_that_come_with_the_program_are_good() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files: Vec<_> = folder.read_dir().unwrap().map(|file| file.unwrap().path()).collect();
    assert!(!files.is_empty());
    for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "toml")) {
        let scene = Scene::read(file).unwrap();
        assert!(!scene.effect_names().is_empty(), "{}", file.display());
    }
}

#[test]
fn slivers_and_what_an_exporter_has_split_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let read = |obj: &str| {
        std::fs::write(folder.path().join("m.obj"), obj).unwrap();
        let text = "duration = 1\n[cloth]\nshape = \"file\"\nfile = \"m.obj\"\ndensity = 0.1\n[effects.gravity]\n";
        Scene::parse(text, &folder.path().join("s.toml"))
    };
    let sliver = read("v 0 0 0\nv 1 0 0\nv 1 1e-7 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
        .unwrap_err()
        .to_string();
    assert!(
        sliver.contains("triangle 0 of the cloth (vertices 0, 1, 2) is only 1.0e-7 m high: a sliver"),
        "{sliver}"
    );
    assert!(sliver.contains("weld = \"1 um\""), "{sliver}");
    let seam = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\nf 4 5 6\n";
    let remarks = read(seam).unwrap().remarks;
    assert_eq!(
        remarks,
        [
            "The file of the cloth 'cloth' has 2 vertices in the same place as others (weld merges them), 1 duplicate triangle, 3 edges between triangles that face opposite ways."
        ]
    );
    assert!(read("v 0 0 0\nv 1 0 0\nv 1 1e-5 0\nf 1 2 3\n").unwrap().remarks.is_empty());
}
