//! `selvedge cull`.

use crate::support::{Workplace, keys, moved_by};
use selvedge_laboratory::methods::{Preset, Source};
use serde_json::{Value, json};

const CULL: [&str; 3] = ["cull", "start.obj", "end.obj"];

fn with<'a>(options: &[&'a str]) -> Vec<&'a str> {
    [&CULL[..], options].concat()
}

fn stage<'a>(document: &'a Value, name: &str) -> &'a Value {
    let stages = document["stages"].as_array().unwrap();
    stages.iter().find(|stage| stage["stage"] == name).unwrap()
}

#[test]
fn json_has_the_mesh_the_stages_and_the_contacts() {
    let place = Workplace::with_step();
    let ours = place.json(&with(&["--json"]));
    has_the_mesh_the_stages_and_the_contacts(&ours, "selvedge", false);
    // The pairs are those of the small triangle's corners with the large face, and of its edges with the two slanted ones of the
    // large triangle.
    assert_eq!(stage(&ours, "broad-phase")["vertex_face"], 3);
    assert_eq!(stage(&ours, "broad-phase")["edge_edge"], 6);

    let paper = place.json(&with(&["--json", "--pipeline", "lv_2014"]));
    has_the_mesh_the_stages_and_the_contacts(&paper, "lv_2014", true);
    assert_eq!(stage(&paper, "broad-phase")["triangle_pairs"], 1);
    assert_eq!(stage(&paper, "distribution")["vertex_face"], 6);
    assert_eq!(stage(&paper, "distribution")["edge_edge"], 9);
}

fn has_the_mesh_the_stages_and_the_contacts(document: &Value, pipeline: &str, has_triangle_pairs: bool) {
    assert_eq!(document["pipeline"], pipeline);
    assert_eq!(
        [
            &document["vertices"],
            &document["edges"],
            &document["triangles"],
            &document["threads"]
        ],
        [6, 6, 2, 1]
    );
    let stages = document["stages"].as_array().unwrap();
    for (index, stage) in stages.iter().enumerate() {
        let counts: &[&str] = match index {
            0 if has_triangle_pairs => &["stage", "triangle_pairs", "seconds"],
            _ => &["stage", "vertex_face", "edge_edge", "seconds"],
        };
        assert_eq!(keys(stage), counts);
        assert!(stage["seconds"].as_f64().unwrap() >= 0.0);
    }
    // The corners of the small triangle fall from 1, 1.1 and 1.2 by 4 each.
    let contacts = &document["contacts"];
    assert_eq!(keys(contacts), ["vertex_face", "edge_edge", "earliest"]);
    assert_eq!(contacts["vertex_face"], 3);
    assert_eq!(contacts["edge_edge"], 0);
    let earliest = contacts["earliest"].as_f64().unwrap();
    assert!(earliest <= 0.25 && earliest > 0.25 - 1e-9, "{earliest}");
    assert!(document["seconds"].as_f64().unwrap() > 0.0);
}

#[test]
fn stages_are_those_of_the_preset() {
    let place = Workplace::with_step();
    for preset in Preset::ALL {
        let document = place.json(&with(&["--json", "--pipeline", preset.name()]));
        let names: Vec<_> = document["stages"]
            .as_array()
            .unwrap()
            .iter()
            .map(|stage| stage["stage"].as_str().unwrap().to_owned())
            .collect();
        let mut expected = vec!["broad-phase".to_owned()];
        if preset.stages().source != Source::MovingBoxes {
            expected.push("distribution".to_owned());
        }
        expected.extend(preset.stages().tests.iter().map(|test| test.stage().to_string()));
        expected.push("elementary".to_owned());
        assert_eq!(names, expected);
        assert_eq!(document["pipeline"], preset.name());
        assert_eq!(document["contacts"]["vertex_face"], 3, "{preset}");
    }
}

#[test]
fn earliest_is_null_without_contact() {
    let place = Workplace::with_step();
    place.write("end.obj", moved_by(-0.5));
    let document = place.json(&with(&["--json"]));
    assert_eq!(
        document["contacts"],
        json!({"vertex_face": 0, "edge_edge": 0, "earliest": null})
    );
}

#[test]
fn times_of_single_precision_are_written_exactly() {
    let place = Workplace::new();
    place.write(
        "start.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 0.3\nv 3 0.2 0.3\nv 3 1 0.3\nf 1 2 3\nf 4 5 6\n",
    );
    place.write(
        "end.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0.2 0.2 -0.4\nv 3 0.2 0.3\nv 3 1 0.3\nf 1 2 3\nf 4 5 6\n",
    );
    place.stdout(&["cull", "start.obj", "end.obj", "--scalar", "f32", "--pairs", "pairs.csv"]);
    let list = place.read("pairs.csv");
    let times: Vec<f64> = list
        .lines()
        .skip(1)
        .map(|line| line.rsplit(',').next().unwrap().parse().unwrap())
        .collect();
    assert!(!times.is_empty());
    assert!(times.iter().all(|&time| f64::from(time as f32) == time), "{list}");
}

#[test]
fn contacts_are_written_with_their_vertices_and_times() {
    let place = Workplace::with_step();
    place.stdout(&with(&["--pairs", "out.csv"]));
    let text = place.read("out.csv");
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("kind,i0,i1,i2,i3,time"));
    for (line, (vertex, time)) in lines.zip([(3, 0.25), (4, 0.275), (5, 0.3)]) {
        let (pair, found) = line.rsplit_once(',').unwrap();
        assert_eq!(pair, format!("vertex-face,{vertex},0,1,2"));
        assert!((found.parse::<f64>().unwrap() - time).abs() < 1e-9, "{line}");
    }
    assert_eq!(text.lines().count(), 4);
}

#[test]
fn candidates_hold_every_pair_before_the_elementary_test() {
    let place = Workplace::with_step();
    let all = with(&["--json", "--pipeline", "curtis_2008", "--candidates", "out.csv"]);
    place.stdout(&all);
    let text = place.read("out.csv");
    let mut lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.remove(0), "kind,i0,i1,i2,i3");
    let count = |kind: &str| lines.iter().filter(|line| line.starts_with(kind)).count();
    assert_eq!((count("vertex-face,"), count("edge-edge,")), (6, 9));
    assert!(lines.contains(&"vertex-face,0,3,4,5"));
    lines.sort_unstable();
    lines.dedup();
    assert_eq!(lines.len(), 15);
}

#[test]
fn candidates_only_ends_after_the_broad_phase() {
    let place = Workplace::with_step();
    let options = ["--json", "--candidates-only", "--candidates", "out.csv"];
    let document = place.json(&with(&options));
    assert_eq!(document["contacts"], Value::Null);
    assert_eq!(document["stages"].as_array().unwrap().len(), 1);
    assert_eq!(stage(&document, "broad-phase")["vertex_face"], 3);
    assert_eq!(place.read("out.csv").lines().count(), 1 + 3 + 6);
    assert!(
        place
            .stdout(&with(&["--candidates-only"]))
            .contains("certainly apart throughout")
    );
}

#[test]
fn the_earliest_contact_is_found_alone() {
    let place = Workplace::with_step();
    let document = place.json(&with(&["--json", "--earliest", "--pairs", "out.csv"]));
    let earliest = document["contacts"]["earliest"].as_f64().unwrap();
    assert!(earliest <= 0.25 && earliest > 0.25 - 1e-9, "{earliest}");
    let text = place.read("out.csv");
    assert!(text.contains("vertex-face,3,0,1,2,0.2"), "{text}");
    place.write("end.obj", moved_by(-0.5));
    let document = place.json(&with(&["--json", "--earliest"]));
    assert_eq!(document["contacts"]["earliest"], Value::Null);
}

#[test]
fn the_published_pipelines_do_not_answer_short_questions() {
    let place = Workplace::with_step();
    for option in ["--earliest", "--candidates-only"] {
        let output = place.run(&with(&[option, "--pipeline", "lv_2014"]));
        assert_eq!(output.status.code(), Some(1));
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(message.contains("only the pipeline selvedge"), "{message}");
    }
}

#[test]
fn counts_do_not_depend_on_the_number_of_threads() {
    let place = Workplace::new();
    place.stdout(&["arm", "--frames", "55,56"]);
    let run = |threads: &str| {
        let arguments = ["cull", "arm-55.ply", "arm-56.ply", "--json", "--threads", threads];
        let document = place.json(&[&arguments[..], &["--pairs", "pairs.csv"]].concat());
        (document["contacts"].clone(), place.read("pairs.csv"))
    };
    let one = run("1");
    assert!(one.0["edge_edge"].as_u64().unwrap() > 0);
    assert_eq!(run("3"), one);
    assert_eq!(run("0"), one);
}

#[test]
fn every_instruction_set_can_be_forced_and_changes_nothing() {
    let place = Workplace::with_step();
    let contacts = |options: &[&str]| {
        place.stdout(&[&with(&["--pairs", "out.csv"])[..], options].concat());
        let earliest = place.json(&[&with(&["--json", "--earliest"])[..], options].concat());
        (place.read("out.csv"), earliest["contacts"].clone())
    };
    let best = contacts(&[]);
    for (name, _) in selvedge::simd::available_levels() {
        assert_eq!(contacts(&["--simd", name]), best, "{name}");
    }
    let unknown = place.run(&with(&["--simd", "abacus"]));
    assert_eq!(unknown.status.code(), Some(2));
}

#[test]
fn single_precision_says_what_it_rounds() {
    let place = Workplace::with_step();
    let output = place.run(&with(&["--json", "--scalar", "f32"]));
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["scalar"], "f32");
    assert_eq!(document["contacts"]["vertex_face"], 3);
    let notes = String::from_utf8(output.stderr).unwrap();
    assert!(notes.contains("start.obj: 2 coordinates were rounded"), "{notes}");
}

#[test]
fn what_is_unusual_about_the_mesh_is_said_on_standard_error() {
    let place = Workplace::with_step();
    for name in ["start.obj", "end.obj"] {
        let text = place.read(name);
        place.write(name, format!("{text}v 9 9 9\nf 1 2 3\nf 1 1 2\nf 4 5 6 7\n"));
    }
    let output = place.run(&with(&["--json"]));
    let notes = String::from_utf8(output.stderr).unwrap();
    for part in ["2 duplicate triangles", "1 degenerate triangle", "1 polygon"] {
        assert!(notes.contains(part), "{notes}");
    }
    assert!(serde_json::from_slice::<Value>(&output.stdout).is_ok());
}

#[test]
fn the_table_has_every_stage_and_says_what_the_counts_are_worth() {
    let place = Workplace::with_step();
    let ours = place.stdout(&CULL);
    for part in ["broad-phase", "non-coplanarity", "elementary", "every stage is certified"] {
        assert!(ours.contains(part), "{ours}");
    }
    let paper = place.stdout(&with(&["--pipeline", "lv_2014"]));
    let contacts = "3 vertex–face and 0 edge–edge, the first at t = 0.250000";
    for part in ["distribution", "boxes", contacts, "can both miss contacts"] {
        assert!(paper.contains(part), "{paper}");
    }
}

#[test]
fn pairs_whose_swept_boxes_overlap_go_through_all_later_stages() {
    let place = Workplace::with_step();
    let usual = place.json(&with(&["--json"]));
    for pipeline in ["selvedge", "selvedge_exact"] {
        let swept = ["--swept-boxes", "--pipeline", pipeline, "--json", "--pairs", "out.csv"];
        let document = place.json(&with(&swept));
        assert_eq!(document["pipeline"], pipeline);
        assert_eq!(document["contacts"], usual["contacts"]);
        let stages: Vec<_> = document["stages"].as_array().unwrap().iter().collect();
        let names: Vec<_> = stages.iter().map(|stage| &stage["stage"]).collect();
        assert_eq!(names, ["broad-phase", "relative-boxes", "non-coplanarity", "elementary"]);
        let pairs = |index: usize| stages[index]["vertex_face"].as_u64();
        assert!(pairs(0) >= pairs(1) && pairs(1) >= pairs(2) && pairs(3) == Some(3));
        assert_eq!(place.read("out.csv").lines().count(), 4);
    }
    let message = place.refusal(1, &with(&["--swept-boxes", "--pipeline", "lv_2014"]));
    assert!(message.contains("--swept-boxes"), "{message}");
}

#[test]
fn edges_that_single_precision_collapses_are_reported() {
    let place = Workplace::new();
    // Next to 2^24 numbers of f32 are whole.
    let far = "v 16777216 0 0\nv 16777216.25 0 0\nv 16777216 9 0\nf 1 2 3\n";
    place.write("start.obj", far);
    place.write("end.obj", far);
    let output = place.run(&with(&["--scalar", "f32", "--json"]));
    let notes = String::from_utf8(output.stderr).unwrap();
    assert!(
        notes.contains("end.obj: rounding to f32 gives both ends of 1 edge one position"),
        "{notes}"
    );
    let output = place.run(&with(&["--json"]));
    assert!(!String::from_utf8(output.stderr).unwrap().contains("one position"));
}
