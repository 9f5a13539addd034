//! `selvedge queries`.

use crate::support::{Workplace, keys};
use serde_json::{Value, json};

/// Writes a query of a vertex at (1/4, 1/4) that moves from z = 1/2 to `end`/2 over a resting triangle, with the given truth.
fn fall(end: i32, truth: &str) -> String {
    let face = ["0,1,0,1,0,1", "1,1,0,1,0,1", "0,1,1,1,0,1"];
    let mut rows = vec!["1,4,1,4,1,2".to_owned()];
    rows.extend(face.map(str::to_owned));
    rows.push(format!("1,4,1,4,{end},2"));
    rows.extend(face.map(str::to_owned));
    rows.iter().map(|row| format!("{row}{truth}\n")).collect()
}

fn method<'a>(document: &'a Value, method: &str, kind: &str) -> &'a Value {
    let methods = document["methods"].as_array().unwrap();
    let mut found = methods.iter().filter(|row| row["method"] == method && row["kind"] == kind);
    let row = found.next().unwrap();
    assert!(found.next().is_none());
    row
}

#[test]
fn json_counts_answers_against_the_truth() {
    let place = Workplace::new();
    // The queries are a hit, a miss, a hit whose truth says miss, and a miss whose truth says hit.
    let text = [fall(-1, ",1"), fall(1, ",0"), fall(-1, ",0"), fall(1, ",1")].concat();
    place.write("fall-vf.csv", text);
    let document = place.json(&["queries", "fall-vf.csv", "--method", "selvedge", "--json"]);
    assert_eq!(document["scalar"], "f64");
    let row = method(&document, "selvedge", "vertex-face");
    for (name, count) in [
        ("queries", 4),
        ("positives", 2),
        ("truth_positives", 2),
        ("false_positives", 1),
        ("false_negatives", 1),
    ] {
        assert_eq!(row[name], count, "{name}");
    }
    let time = &row["nanoseconds"];
    assert_eq!(keys(time), ["mean", "median", "p99", "max"]);
    let at = |name: &str| time[name].as_f64().unwrap();
    assert!(at("median") > 0.0 && at("median") <= at("p99") && at("p99") <= at("max"));
}

#[test]
fn without_a_truth_column_the_truth_is_null() {
    let place = Workplace::new();
    place.write("fall-vf.csv", fall(-1, ""));
    let document = place.json(&["queries", "fall-vf.csv", "--json"]);
    for row in document["methods"].as_array().unwrap() {
        for name in ["truth_positives", "false_positives", "false_negatives"] {
            assert_eq!(row[name], Value::Null);
        }
        assert_eq!(row["positives"], 1);
    }
}

#[test]
fn files_are_joined_by_kind() {
    let place = Workplace::new();
    place.write("vertex-face/a.csv", fall(-1, ",1"));
    place.write("vertex-face/b.csv", fall(1, ",0"));
    place.write("edge-edge/a.csv", fall(1, ",0"));
    let files = ["vertex-face/a.csv", "vertex-face/b.csv", "edge-edge/a.csv"];
    let document = place.json(&[&["queries", "--json"], &files[..]].concat());
    assert_eq!(method(&document, "cubic", "vertex-face")["queries"], 2);
    assert_eq!(method(&document, "cubic", "edge-edge")["queries"], 1);
}

#[test]
fn the_kind_may_be_given() {
    let place = Workplace::new();
    place.write("data.csv", fall(-1, ",1"));
    for kind in ["vertex-face", "edge-edge"] {
        let arguments = ["queries", "data.csv", "--kind", kind, "--json", "--method", "dop_18"];
        let document = place.json(&arguments);
        assert_eq!(method(&document, "dop_18", kind)["queries"], 1);
    }
}

#[test]
fn single_precision_says_what_it_rounds() {
    let place = Workplace::new();
    place.write("fall-vf.csv", fall(-1, ",1").replace("1,4,1,4", "1,3,1,4"));
    let output = place.run(&["queries", "fall-vf.csv", "--scalar", "f32", "--json"]);
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["scalar"], "f32");
    let notes = String::from_utf8(output.stderr).unwrap();
    assert!(notes.contains("2 coordinates were rounded to f64"), "{notes}");
    assert!(notes.contains("2 coordinates were rounded to f32"), "{notes}");
}

#[test]
fn methods_without_a_promise_are_marked() {
    let place = Workplace::new();
    place.write("fall-vf.csv", fall(-1, ",1"));
    let text = place.stdout(&["queries", "fall-vf.csv"]);
    for (method, mark) in [("cubic", "cubic!"), ("non_coplanarity_plain", "non_coplanarity_plain!")] {
        assert!(text.contains(mark), "{method}: {text}");
    }
    assert!(!text.contains("selvedge!") && !text.contains("dop_18!"));
    let document = place.json(&["queries", "fall-vf.csv", "--json"]);
    let marks = ["cubic", "selvedge"].map(|name| &method(&document, name, "vertex-face")["certified"]);
    assert_eq!(marks, [&json!(false), &json!(true)]);
}
