//! `selvedge accuracy`.

use crate::support::{ACCURACY, Run, Workplace, keys};
use serde_json::Value;

/// Arguments for a run that is short enough for a test.
const SHORT: [&str; 7] = ["accuracy", "--only", "filters", "--pairs", "1500", "--repeat", "1"];

fn rows(document: &Value) -> &Vec<Value> {
    document["rows"].as_array().unwrap()
}

fn at(row: &Value, name: &str) -> f64 {
    row[name].as_f64().unwrap_or_else(|| panic!("{name}: {row}"))
}

#[test]
fn json_has_every_filter_on_every_set_and_backend() {
    let document = Workplace::new().json(&[&SHORT[..], &["--json"]].concat());
    let levels = selvedge::simd::available_levels();
    let sets = document["sets"].as_array().unwrap();
    assert_eq!(sets.len(), 6);
    // The filters are the paper's, bare signs, three tiers for f32 and two for f64, on each level and one at a time.
    let expected = 3 * (5 + 4) * (1 + levels.len());
    assert_eq!(rows(&document).len(), expected);
    for row in rows(&document) {
        assert!(at(row, "nanoseconds_per_pair") > 0.0);
        let [culled, cullable, kept] =
            ["culled_fraction", "cullable_fraction", "kept_of_cullable_fraction"].map(|name| at(row, name));
        for share in [culled, cullable, kept] {
            assert!((0.0..=1.0).contains(&share), "{row}");
        }
        let tier = row["tier"].as_str().unwrap();
        if row["certified"] == true {
            assert_eq!(row["false_culls"], 0, "{row}");
        }
        if tier == "exact" {
            assert_eq!((culled, kept), (cullable, 0.0));
        }
        if tier == "uncertified" {
            assert_eq!(at(row, "over_uncertified"), 1.0);
        }
    }
}

#[test]
fn filters_without_proof_are_marked_and_caught() {
    let place = Workplace::new();
    let text = place.stdout(&SHORT);
    assert!(text.contains("paper!") && text.contains("uncertified!"), "{text}");
    assert!(!text.contains("permanent!") && text.contains("! not certified"));
    let document = place.json(&[&SHORT[..], &["--json"]].concat());
    for tier in ["paper", "uncertified"] {
        for scalar in ["f32", "f64"] {
            let mut found = rows(&document)
                .iter()
                .filter(|row| row["set"] == "Nearly coplanar pairs" && row["tier"] == tier && row["scalar"] == scalar);
            assert!(at(found.next().unwrap(), "false_culls") > 0.0, "{tier}, {scalar}");
        }
    }
}

#[test]
fn a_step_between_two_meshes_is_a_set_of_its_own() {
    let place = Workplace::with_step();
    let document = place.json(&[&SHORT[..], &["start.obj", "end.obj", "--json"]].concat());
    let sets = document["sets"].as_array().unwrap();
    assert_eq!(sets.len(), 8);
    assert_eq!(sets[2]["set"], "start to end");
    // These are all 15 pairs of two triangles.
    assert_eq!((&sets[2]["vertex_face"], &sets[2]["edge_edge"]), (&6.into(), &9.into()));
    assert_eq!(sets[2]["drawn_from"], 15);
}

#[test]
fn a_mesh_without_candidates_has_no_times() {
    let place = Workplace::with_step();
    let document = place.json(&[&SHORT[..], &["start.obj", "start.obj", "--json"]].concat());
    let empty = rows(&document).iter().filter(|row| row["set"] == "start to start");
    for row in empty {
        assert!(row["nanoseconds_per_pair"].is_null(), "{row}");
    }
    let text = place.stdout(&[&SHORT[..], &["start.obj", "start.obj", "--svg", "a.svg"]].concat());
    assert!(text.contains("start to start, f32\n0 pairs"), "{text}");
    assert!(!text.contains("NaN") && !place.read("a.svg").contains("NaN"));
}

#[test]
fn files_are_written_and_the_table_printed() {
    let place = Workplace::new();
    let text = place.stdout(&[&SHORT[..], &["--json=rows.json", "--svg", "plot.svg"]].concat());
    assert!(text.contains("What accuracy costs in time"));
    assert_eq!(place.listing(), ["plot.svg", "rows.json"]);
    let document: Value = serde_json::from_str(&place.read("rows.json")).unwrap();
    assert_eq!(keys(&document), ["seed", "repeat", "separation", "sets", "rows"]);
    let plot = place.read("plot.svg");
    for label in ["Arm scene, f32", "Nearly coplanar pairs, f64", "permanent", "as computed"] {
        assert!(plot.contains(label), "{label}");
    }
}

#[test]
fn elementary_tests_are_measured_at_every_tolerance_and_the_unsafe_ones_are_caught() {
    let place = Workplace::with_step();
    let outputs = ["start.obj", "end.obj", "--json=rows.json", "--elementary-svg", "plot.svg"];
    let text = place.stdout(&[&ACCURACY[..], &["--only", "elementary"], &outputs].concat());
    assert!(text.contains("without_bounds!") && text.contains("! not certified"));
    assert!(!text.contains("certified!") && !text.contains("exact!"), "{text}");
    let document: Value = serde_json::from_str(&place.read("rows.json")).unwrap();
    assert_eq!(keys(&document), ["elementary"]);
    let document = &document["elementary"];
    // The sets are hard cases, arm, step and nearly coplanar pairs, in two formats.
    assert_eq!(document["sets"].as_array().unwrap().len(), 8);
    assert_eq!(rows(document).len(), 8 * 25);
    let mut wrong = 0.0;
    for row in rows(document) {
        let mistakes = at(row, "false_negatives") + at(row, "late");
        if row["certified"] == true {
            assert_eq!(mistakes, 0.0, "{row}");
        }
        if row["method"] == "exact" {
            assert_eq!(row["false_positives"], 0, "{row}");
        }
        wrong += mistakes;
    }
    assert!(wrong > 100.0, "{wrong}");
    let step = |row: &&Value| row["set"] == "start to end" && row["scalar"] == "f64";
    let mut step = rows(document).iter().filter(step);
    // Three vertices go through a face.
    assert!(step.all(|row| row["touching"].as_u64() <= Some(3)));
    let plot = place.read("plot.svg");
    for label in ["Hard cases, f32", "Arm scene, f64", "certified 1e-12", "cubic"] {
        assert!(plot.contains(label), "{label}");
    }
    assert!(!plot.contains("NaN"));
}

#[test]
fn without_only_one_document_has_both_parts() {
    let document: Value = serde_json::from_str(Run::of_accuracy().read("rows.json")).unwrap();
    assert_eq!(
        keys(&document),
        ["seed", "repeat", "separation", "sets", "rows", "elementary"]
    );
}
