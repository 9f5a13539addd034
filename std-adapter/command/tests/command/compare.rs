//! `selvedge`, `selvedge compare` and `selvedge hard-cases`.

use crate::support::{Run, SHEET, Workplace, keys};
use selvedge_laboratory::methods::Preset;

/// Arguments for a run that is short enough for a test.
const SHORT: [&str; 4] = ["--steps", "2", "--rounds", "1"];

const REPORT: [&str; 2] = ["comparison.html", "figure-3.png"];

#[test]
fn the_main_job_simulates_the_sleeve_compares_every_method_and_writes_its_report() {
    let run = Run::of_main_job();
    let text = &run.text;
    assert!(text.starts_with("arm sleeve: 1,500 steps in "), "{text}");
    assert!(text.contains("arm sleeve, 2 of its 1500 simulated steps"));
    for preset in Preset::ALL {
        assert!(text.contains(preset.name()), "{preset} is missing");
    }
    assert!(text.contains("693 vertices") && text.contains("1,345 triangles"));
    let written = REPORT.map(|name| format!("selvedge-out/{name}"));
    let first = ["selvedge-out", "selvedge-out/arm-sleeve.html"].map(str::to_owned);
    assert_eq!(run.listing, [&first[..], &written].concat());
    let page = run.read("selvedge-out/arm-sleeve.html");
    assert!(page.contains("<h1>arm sleeve</h1>"));
    let picture = run.bytes("selvedge-out/figure-3.png");
    assert_eq!(&picture[..8], b"\x89PNG\r\n\x1a\n");
    assert!(run.read("selvedge-out/comparison.html").contains("</table>"));
}

#[test]
fn the_main_job_takes_another_folder() {
    let place = Workplace::new();
    place.stdout(&[&SHORT[..], &["--output", "a/b"]].concat());
    assert_eq!(place.listing().len(), 3 + REPORT.len());
    assert!(place.path("a/b/comparison.html").exists());
}

#[test]
fn the_papers_numbers_stand_beside_ours() {
    let text = Workplace::new().stdout(&[&["compare"], &SHORT[..]].concat());
    for (preset, numbers) in [
        ("basic ", ["1,122", "2,056", "12.70"]),
        ("curtis_2008 ", ["74", "475", "32.00"]),
        ("tang_2010 ", ["44", "338", "37.54"]),
        ("lv_2014 ", ["31", "137", "34.22"]),
    ] {
        let row = text.lines().find(|line| line.starts_with(preset)).unwrap();
        let words: Vec<_> = row.split_whitespace().collect();
        assert_eq!(words[words.len() - 3..], numbers, "{row}");
    }
}

#[test]
fn json_has_a_row_for_each_method_with_means_per_step() {
    let place = Workplace::new();
    let arguments = ["compare", "--pipelines", "basic,tang_c_2010,lv_2014", "--json"];
    let document = place.json(&[&arguments[..], &SHORT].concat());
    assert_eq!(document["steps"], 2);
    let rows = document["rows"].as_array().unwrap();
    let names: Vec<_> = rows.iter().map(|row| &row["pipeline"]).collect();
    assert_eq!(names, ["basic", "tang_c_2010", "lv_2014"]);
    for row in rows {
        assert_eq!(row["reconstructed"], row["pipeline"] == "tang_c_2010");
        let has_paper = row["pipeline"] != "tang_c_2010";
        assert_eq!(row["paper"]["frames_per_second"].is_number(), has_paper, "{row}");
        assert_eq!(row["missed"], 0.0, "{row}");
        assert!(row["frames_per_second"].as_f64().unwrap() > 0.0);
        for kind in ["vertex_face", "edge_edge"] {
            assert_eq!(keys(&row[kind]), ["distributed", "after_boxes", "after_filter", "contacts"]);
            let counts: Vec<_> = row[kind]
                .as_object()
                .unwrap()
                .values()
                .map(|count| count.as_f64().unwrap())
                .collect();
            assert!(counts.is_sorted_by(|more, fewer| more >= fewer), "{row}");
        }
        let stages = row["stages"].as_array().unwrap();
        assert_eq!(stages.first().unwrap()["stage"], "broad-phase");
        assert_eq!(stages.last().unwrap()["stage"], "elementary");
    }
    assert!(place.listing().is_empty());
}

#[test]
fn two_meshes_are_compared_as_one_step() {
    let place = Workplace::with_step();
    let document = place.json(&["compare", "start.obj", "end.obj", "--json"]);
    assert_eq!(document["steps"], 1);
    assert_eq!(document["triangles"], 2);
    let rows = document["rows"].as_array().unwrap();
    assert_eq!(rows.len(), Preset::ALL.len());
    for row in rows {
        assert_eq!(row["vertex_face"]["contacts"], 3.0, "{row}");
    }
}

#[test]
fn a_scene_is_simulated_and_compared_on_steps_of_its_own() {
    let place = Workplace::new();
    let short = SHEET.replace("duration = \"1 s\"", "duration = \"40 ms\"");
    place.write("sheet.toml", short);
    let arguments = ["compare", "sheet.toml", "--json", "--steps", "4"];
    let document = place.json(&arguments);
    assert_eq!((&document["steps"], &document["triangles"]), (&4.into(), &128.into()));
    let name = "a </script> sheet, 4 of its 20 simulated steps";
    assert_eq!(document["scene"], name);
    // With more steps than the scene has, all of them are compared.
    let document = place.json(&["compare", "sheet.toml", "--json", "--steps", "99"]);
    assert_eq!(document["steps"], 20);
    for row in document["rows"].as_array().unwrap() {
        assert_eq!(row["missed"], 0.0, "{row}");
        // No method may find a contact where the simulation has certified that there is none.
        assert_eq!(row["vertex_face"]["contacts"], 0.0, "{row}");
    }
}

#[test]
fn each_case_has_its_exact_answer_beside_and_ours_are_right() {
    let document = Workplace::new().json(&["hard-cases", "edge", "--json"]);
    let cases = document["cases"].as_array().unwrap();
    assert!(cases.len() > 50);
    let mut missed_by_the_plain_test = 0;
    for case in cases {
        assert_eq!(
            keys(case),
            ["case", "placement", "kind", "first_contact", "between", "answers"]
        );
        for method in ["selvedge", "time_of_impact", "non_coplanarity", "relative_boxes"] {
            assert_ne!(case["answers"][method], "missed", "{case}");
        }
        missed_by_the_plain_test += usize::from(case["answers"]["cubic"] == "missed");
    }
    assert!(missed_by_the_plain_test > 0);
}
