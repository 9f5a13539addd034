//! `selvedge cull`.

use crate::support::Workplace;
use selvedge_laboratory::methods::{Preset, Source};

const CULL: [&str; 3] = ["cull", "start.obj", "end.obj"];

fn with<'a>(options: &[&'a str]) -> Vec<&'a str> {
    [&CULL[..], options].concat()
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
}
