//! `selvedge simulate`.

use crate::support::{SHEET, Workplace};
use std::fs;

fn place() -> Workplace {
    let place = Workplace::new();
    place.write("sheet.toml", SHEET);
    place
}

#[test]
fn json_has_energy_stretch_and_loads_at_every_frame_and_the_slowest_step() {
    let document = place().json(&["simulate", "sheet.toml", "--json"]);
    let numbers =
        |value: &serde_json::Value| -> Vec<f64> { value.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect() };
    let energy = &document["energy"];
    let [seconds, kinetic, elastic, gravitational, lost] =
        ["seconds", "kinetic", "elastic", "gravitational", "lost"].map(|kind| numbers(&energy[kind]));
    assert_eq!((seconds.len(), seconds[0]), (11, 0.0));
    for frame in 0..11 {
        let all = [&kinetic, &elastic, &gravitational, &lost]
            .map(|kind| kind[frame])
            .iter()
            .sum::<f64>();
        assert!(
            (all - kinetic[0] - elastic[0] - gravitational[0]).abs() < 1e-12,
            "nothing is missing"
        );
    }
    let names: Vec<_> = energy["effects"]
        .as_array()
        .unwrap()
        .iter()
        .map(|effect| &effect["effect"])
        .collect();
    assert_eq!(names, ["gravity", "stretch"]);
    assert_eq!(numbers(&energy["effects"][1]["joules"]), elastic);
    let stretch = &document["edge_stretch"];
    let longest = numbers(&stretch["largest"]);
    let most = longest.iter().copied().fold(0.0, f64::max);
    assert_eq!(stretch["most"]["largest"]["value"].as_f64().unwrap(), most);
    assert_eq!(document["edge_stretch_at_end"]["largest"].as_f64().unwrap(), longest[10]);
    let load = &document["loads"]["on"][0];
    let newtons = numbers(&load["newtons"]);
    assert_eq!((&load["on"], newtons.len()), (&"ball".into(), 11));
    assert_eq!(newtons[0], 0.0, "it has not landed yet");
    let most = newtons.iter().copied().fold(0.0, f64::max);
    assert!(
        most > 0.0 && load["largest"]["value"].as_f64().unwrap() == most,
        "{newtons:?}"
    );
    let slowest = &document["slowest_step"];
    assert!((1..=500).contains(&slowest["step"].as_u64().unwrap()));
    assert!(slowest["seconds"].as_f64().unwrap() >= document["seconds"].as_f64().unwrap() / 1000.0);
}

#[test]
fn json_the_table_and_written_frames_have_the_motion_of_free_bodies() {
    let place = Workplace::new();
    let free = "around = 10\nmass = \"500 g\"\nvelocity = [0, 0, -1]\nspin = [0, 3, 0]";
    place.write("falling.toml", SHEET.replace("around = 10", free).replace("1 s", "200 ms"));
    let document = place.json(&["simulate", "falling.toml", "--json", "--output", "out", "--frames", "obj"]);
    let bodies = document["free_bodies_at_end"].as_array().unwrap();
    assert_eq!((bodies.len(), &bodies[0]["body"]), (1, &"ball".into()));
    let number = |name: &str, axis: usize| bodies[0][name][axis].as_f64().unwrap();
    assert_eq!(bodies[0]["mass"].as_f64(), Some(0.5));
    // It falls away from the sheet, by the steps' 1/2 g t (t + h).
    let (t, h) = (0.2, 0.002);
    assert!((number("velocity", 2) + 1.0 + 9.81 * t).abs() < 1e-9);
    assert!((number("centre", 2) + t + 0.5 * 9.81 * t * (t + h)).abs() < 1e-9);
    assert!((number("spin", 1) - 3.0).abs() < 1e-6 && number("angular_momentum", 1) > 0.0);
    assert!((number("rotation", 1) - (0.5 * 3.0 * t).sin()).abs() < 1e-4 && number("translation", 2) < -0.3);

    let heights = |frame: &str| -> Vec<f64> {
        let obj = fs::read_to_string(place.path(frame)).unwrap();
        let vertices = obj.lines().filter_map(|line| line.strip_prefix("v "));
        vertices
            .map(|vertex| vertex.split_whitespace().nth(2).unwrap().parse().unwrap())
            .collect()
    };
    let lowest = |frame: &str| heights(frame).into_iter().fold(f64::INFINITY, f64::min);
    let fallen = lowest("out/falling-00000.obj") - lowest("out/falling-00002.obj");
    assert!(
        (fallen + number("centre", 2)).abs() < 0.01,
        "the ball is in the frames where it is: {fallen}"
    );

    let table = place.stdout(&["simulate", "falling.toml", "--output", "out"]);
    assert!(table.contains("free body, at the end"), "{table}");
    place.write("resting.toml", SHEET.replace("1 s", "20 ms"));
    let resting = place.json(&["simulate", "resting.toml", "--json"]);
    assert_eq!(resting["free_bodies_at_end"].as_array().map(Vec::len), Some(0));
    assert!(!place.stdout(&["simulate", "resting.toml"]).contains("free body"));
}

#[test]
fn the_ball_in_the_hammock_rolls_down_and_back_up_and_the_pins_carry_it() {
    let place = Workplace::new();
    let scene = concat!(env!("CARGO_MANIFEST_DIR"), "/../cloth/scenes/hammock.toml");
    let text = fs::read_to_string(scene).unwrap();
    let at = |duration: &str| {
        place.write("hammock.toml", text.replace("2 s", duration));
        place.json(&["simulate", "hammock.toml", "--json", "--output", duration])
    };
    let (start, middle, end) = (at("20 ms"), at("1 s"), at("2 s"));
    let along = |document: &serde_json::Value| document["free_bodies_at_end"][0]["centre"][0].as_f64().unwrap();
    assert!(along(&start) > 0.29, "it starts near the right end: {}", along(&start));
    assert!(along(&middle) < 0.0, "it rolls past the middle: {}", along(&middle));
    assert!(along(&end).abs() < 0.3, "it stays in the hammock: {}", along(&end));
    assert_eq!(end["intersections_at_end"].as_u64(), Some(0));
    let loads = end["loads"]["on"].as_array().unwrap();
    let pins = loads.iter().filter(|load| load["on"].as_str().unwrap().starts_with("pins"));
    let mean: f64 = pins.map(|load| load["mean"].as_f64().unwrap()).sum();
    assert!(mean > 0.4 * 9.81, "the ropes of a hammock pull more than the weight: {mean}");
}

#[test]
fn a_scene_without_a_time_step_runs_by_frames_and_steps_that_are_too_long_are_told_when_they_happen() {
    let place = Workplace::new();
    let limited = SHEET.replace("[8, 8]", "[16, 16]").replace(
        "[effects.gravity]",
        "[effects.gravity]\n[effects.strain_limit]\nlimit = 1.0\n[effects.friction]\ncoefficient = 0.5",
    );
    place.write("frames.toml", limited.replace("time_step = \"2 ms\"\n", ""));
    // It is thrown at the ball, so that no step of this length can keep its limit.
    let thrown = limited.replace("density = \"200 g/m2\"", "density = \"200 g/m2\"\nvelocity = [0, 0, -20]");
    place.write("long.toml", thrown.replace("2 ms", "16 ms"));
    let run = |scene: &str| {
        let output = place.run(&["simulate", scene, "--json"]);
        let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        (document, String::from_utf8(output.stderr).unwrap())
    };
    let (frames, warned) = run("frames.toml");
    assert!(frames["steps"].as_u64().unwrap() >= 240, "{}", frames["steps"]);
    let times = frames["edge_stretch"]["seconds"].as_array().unwrap();
    assert_eq!((times.len(), times[10].as_f64()), (11, Some(1.0)));
    assert_eq!(frames["overstretched_steps"].as_u64(), Some(0));
    assert!(frames["slowest_step"].is_null(), "what is timed is a frame of several steps");
    assert!((1..=60).contains(&frames["slowest_frame"]["frame"].as_u64().unwrap()));
    assert!(!warned.contains("above its limit"), "{warned}");
    let (long, warned) = run("long.toml");
    assert!(long["overstretched_steps"].as_u64().unwrap() > 0);
    assert_eq!(warned.matches("more than 5 % above its limit").count(), 1, "{warned}");
}

#[test]
fn a_picture_of_any_frame_is_a_png() {
    let place = place();
    let run = |options: &[&str]| {
        let arguments = ["simulate", "sheet.toml", "--output", "out", "--picture", "sheet.png"];
        place.stdout(&[&arguments[..], options].concat());
        fs::read(place.path("out/sheet.png")).unwrap()
    };
    let last = run(&[]);
    assert!(last.starts_with(b"\x89PNG"));
    assert_ne!(last, run(&["--at", "0"]));
    assert_eq!(last, run(&["--at", "1e9"]));
}

#[test]
fn a_resumed_run_ends_with_the_same_bits_on_any_number_of_threads() {
    let place = place();
    let run = |options: &[&str]| {
        let arguments = ["simulate", "sheet.toml", "--output", "out", "--frames", "ply"];
        place.stdout(&[&arguments[..], options].concat());
        fs::read(place.path("out/sheet-00010.ply")).unwrap()
    };
    let whole = run(&[]);
    // The first checkpoint is after 200 steps; the rest runs again.
    fs::remove_file(place.path("out/sheet-00010.ply")).unwrap();
    assert_eq!(whole, run(&["--resume"]));
    // The report covers all of it.
    let page = place.read("out/sheet.html");
    assert!(page.contains("\"firstStep\":1,") && page.contains("\"steps\":500,"));
    assert_eq!(whole, run(&["--threads", "2"]));
}

/// A sheet that tears when its right side moves away from its left one.
const TEARING: &str = r#"
time_step = "1 ms"
duration = "0.5 s"
frames_per_second = 30
[cloth]
shape = "sheet"
sides = { first = [0.3, 0, 0], second = [0, 0.2, 0] }
cells = [12, 8]
density = "200 g/m2"
[effects.stretch]
stiffness = "200 N/m"
[effects.shear]
stiffness = "50 N/m"
[effects.tearing]
strength = "30 N/m"
[[effects.tearing.perforation]]
vertices = [6, 19]
strength = "5 N/m"
[[effects.pins.group]]
part = "left"
[[effects.pins.group]]
part = "right"
keyframes = [{ time = 0 }, { time = "0.5 s", translation = [0.09, 0, 0] }]
[effects.self_collision]
thickness = "2 mm"
"#;

#[test]
fn cloth_that_tears_is_reported_and_shown_and_resumes_torn() {
    let place = Workplace::new();
    place.write("tear.toml", TEARING);
    let command = |more: &[&str]| {
        let all = [
            &["simulate", "tear.toml", "--json", "--frames", "gltf", "--picture", "end.png"],
            more,
        ]
        .concat();
        place.json(&all)
    };
    let whole = command(&["--output", "whole"]);
    let torn = whole["torn"].as_array().unwrap();
    assert!(torn.len() > 8 && torn.iter().all(|edge| edge["newtons_per_metre"].as_f64().unwrap() > 5.0));
    assert_eq!(whole["intersections_at_end"], 0);
    // Resumes from the checkpoint of the 200th step, when the perforation has already torn.
    command(&["--output", "again"]);
    let resumed = command(&["--output", "again", "--resume", "--threads", "2"]);
    assert_eq!(resumed["torn"], whole["torn"]);
    for file in ["end.png", "tear.glb"] {
        let [one, other] = ["whole", "again"].map(|folder| fs::read(place.path(folder).join(file)).unwrap());
        assert!(one == other, "{file}");
    }
}

#[test]
fn results_have_the_numbers_of_the_cloths_file() {
    let place = Workplace::new();
    // Two triangles with a split seam; an unused vertex comes first.
    place.write(
        "seam.obj",
        "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 2 3 4\nf 5 6 7\n",
    );
    let scene = "time_step = 0.01\nduration = 0.2\ncloth = { shape = 'file', file = 'seam.obj', weld = 0, density = 0.1 }\n\
                 effects.gravity = {}\neffects.attachments.group = [{ vertices = [3], limit = 0.001 }]\n";
    place.write("seam.toml", scene);
    let result = place.json(&["simulate", "seam.toml", "--json"]);
    assert_eq!(result["released"][0]["vertex"], 6, "{result}");
}

/// Writes a scene with the sheet of `SHEET` through the upper part of its ball.
fn tangled(start: &str) -> Workplace {
    let place = Workplace::new();
    let through = SHEET
        .replace("0.13", "0.05")
        .replace("name = \"a", &format!("{start}\nname = \"a"));
    place.write("sheet.toml", through);
    place
}

#[test]
fn a_scene_that_starts_tangled_is_refused_with_every_place_in_json_and_in_red() {
    let place = tangled("");
    let output = place.run(&["simulate", "sheet.toml", "--json"]);
    assert_eq!(output.status.code(), Some(1));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(
        message.contains("sheet.toml: the scene starts with an intersection: "),
        "{message}"
    );
    assert!(
        message.contains("with the body 'ball'") && message.contains("tangled_start = \"untangle\""),
        "{message}"
    );
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let crossings = document["tangled_start"]["crossings"].as_array().unwrap();
    assert!(crossings.len() > 10);
    for crossing in crossings {
        assert_eq!(crossing["body"], "ball");
        // The sheet lies at this height; the point is rounded.
        assert!((crossing["point"][2].as_f64().unwrap() - 0.05).abs() < 1e-12);
    }
    // All triangles have a colour; those that meet have red.
    let coloured = fs::read(place.path("selvedge-out/sheet.tangled.ply")).unwrap();
    let mesh = selvedge_files::mesh::read(&place.path("selvedge-out/sheet.tangled.ply"))
        .unwrap()
        .mesh;
    let faces = coloured[coloured.len() - 16 * mesh.triangles.len()..].chunks(16);
    let red = faces.filter(|face| face[13] > face[14]).count();
    assert!((10..mesh.triangles.len() / 2).contains(&red), "{red}");
}

#[test]
fn a_scene_that_starts_tangled_is_untangled_or_tolerated_on_request_and_reported() {
    let place = tangled("tangled_start = \"untangle\"");
    let document = place.json(&["simulate", "sheet.toml", "--json"]);
    let untangled = &document["untangled"];
    assert!(
        untangled["crossings"].as_u64() > Some(10) && untangled["left"] == 0,
        "{untangled}"
    );
    assert_eq!(
        (&document["steps"], &document["intersections_at_end"]),
        (&500.into(), &0.into())
    );
    assert!(document["tolerated"].is_null());
    let page = place.read("selvedge-out/sheet.html");
    assert!(page.contains("Untangled before the first step: edges met faces at "));
    assert!(
        place
            .stdout(&["simulate", "sheet.toml"])
            .contains("Untangled before the first step")
    );

    let place = tangled("tangled_start = \"tolerate\"");
    let document = place.json(&["simulate", "sheet.toml", "--json"]);
    assert!(document["tolerated"]["crossings_at_end"].is_u64() && document["untangled"].is_null());
    assert!(
        place
            .read("selvedge-out/sheet.html")
            .contains("edges through faces, tolerated")
    );
}

#[test]
fn the_scene_that_it_writes_runs_and_stays_free_of_intersections() {
    let place = Workplace::new();
    place.stdout(&["walker", "--output", "walker"]);
    let scene = place.read("walker/walker.toml");
    place.write(
        "walker/walker.toml",
        scene.replace("duration = \"3 s\"", "duration = \"40 ms\""),
    );
    let document = place.json(&["simulate", "walker/walker.toml", "--json"]);
    assert_eq!(
        (
            &document["steps"],
            &document["intersections_at_end"],
            &document["blocked_steps"]
        ),
        (&10.into(), &0.into(), &0.into())
    );
}

#[test]
fn the_scene_of_the_tutorial_runs_and_is_certified() {
    let page = include_str!("../../../../docs/tutorials/cloth.md");
    let scene = page.split("```toml\n").nth(1).and_then(|rest| rest.split("```").next());
    let place = Workplace::new();
    place.write("scene.toml", scene.expect("a scene"));
    let document = place.json(&["simulate", "scene.toml", "--json"]);
    assert_eq!(document["intersections_at_end"], 0);
    assert!(document["contacts_resolved"].as_u64().unwrap() > 0);
    // Its frames take several steps each, and the report is about frames.
    let report = place.read("selvedge-out/scene.html");
    for text in [
        "frames a second",
        ">most in a frame<",
        ">all frames<",
        "whole frame, by the wall clock",
    ] {
        assert!(report.contains(text), "`{text}` is not in the report");
    }
    assert!(!report.contains("steps a second") && !report.contains(">most in a step<"));
}
