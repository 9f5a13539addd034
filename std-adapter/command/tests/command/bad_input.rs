//! Input that cannot be used: one message that names the file and the place, the exit status, nothing left behind.

use crate::support::{ABOVE, Workplace, moved_by};

/// A triangle as ASCII PLY, with the given lines after the header and its counts.
fn ply(vertices: usize, faces: usize, body: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {faces}\nproperty list uchar int vertex_indices\nend_header\n{body}"
    )
}

/// Culls `first` against a good second frame, and the other way round. Both must be refused with a message that names
/// the file and has all of `parts`.
#[track_caller]
fn refused(name: &str, content: &str, parts: &[&str]) {
    let place = Workplace::with_step();
    place.write(name, content);
    let outputs = ["--pairs", "pairs.csv", "--candidates", "candidates.csv"];
    for frames in [[name, "end.obj"], ["start.obj", name]] {
        let arguments = [&["cull"], &frames[..], &outputs[..]].concat();
        assert_says(&place.refusal(1, &arguments), &[&[name], parts].concat());
    }
}

#[track_caller]
fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
    assert_eq!(message.lines().count(), 1, "{message}");
}

#[test]
fn a_missing_file_is_named() {
    let message = Workplace::with_step().refusal(1, &["cull", "gone.ply", "end.obj", "--pairs", "out.csv"]);
    assert_says(&message, &["gone.ply", "no such file"]);
}

#[test]
fn a_folder_is_named() {
    let place = Workplace::with_step();
    place.write("meshes/a.obj", ABOVE);
    let message = place.refusal(1, &["cull", "meshes", "end.obj"]);
    assert_says(&message, &["meshes", "folder"]);
}

#[test]
fn an_unknown_extension_is_named() {
    refused("mesh.stl", ABOVE, &[".obj or .ply"]);
}

#[test]
fn an_empty_file_is_named() {
    refused("empty.obj", "", &["empty"]);
    refused("empty.ply", "", &["empty"]);
}

#[test]
fn a_truncated_ascii_ply_is_named() {
    refused("cut.ply", &ply(3, 1, "0 0 0\n1 0 0\n"), &["vertex"]);
}

#[test]
fn a_truncated_binary_ply_is_named() {
    let place = Workplace::with_step();
    place.stdout(&["arm", "--frames", "0"]);
    let whole = std::fs::read(place.path("arm-00.ply")).unwrap();
    for part in [10, whole.len() / 2, whole.len() - 1] {
        place.write("cut.ply", &whole[..part]);
        let message = place.refusal(1, &["cull", "cut.ply", "arm-00.ply"]);
        assert_says(&message, &["cut.ply"]);
    }
}

#[test]
fn a_wrong_count_in_a_header_is_named() {
    let body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    refused("many.ply", &ply(1_000_000_000, 1, body), &["vertex", "1000000000"]);
    refused("few.ply", &ply(3, 1, &format!("{body}3 0 1 2\n")), &["line 14"]);
}

#[test]
fn a_coordinate_that_is_not_finite_is_named_with_its_line() {
    for number in ["nan", "inf", "-inf", "1e999"] {
        let text = ABOVE.replace("v 0 5 0", &format!("v 0 {number} 0"));
        refused("odd.obj", &text, &["line 3"]);
        let body = format!("0 0 0\n1 {number} 0\n0 1 0\n3 0 1 2\n");
        refused("odd.ply", &ply(3, 1, &body), &["line 11"]);
    }
}

#[test]
fn a_line_that_is_no_number_is_named() {
    refused("odd.obj", &ABOVE.replace("v 0 5 0", "v 0 five 0"), &["line 3", "five"]);
}

#[test]
fn an_index_out_of_range_is_named_with_its_line() {
    refused(
        "far.obj",
        &ABOVE.replace("f 4 5 6", "f 4 5 7"),
        &["line 8", "vertex 7", "6 vertices"],
    );
    let body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n";
    refused("far.ply", &ply(3, 1, body), &["line 13", "vertex 3", "3 vertices"]);
}

#[test]
fn a_mesh_without_triangles_is_named() {
    refused("points.obj", "v 0 0 0\nv 1 0 0\n", &["no triangles"]);
    refused("points.ply", &ply(1, 0, "0 0 0\n"), &["no triangles"]);
}

#[test]
fn frames_of_different_meshes_are_both_named_with_the_difference() {
    let place = Workplace::with_step();
    let more = format!("{ABOVE}f 1 2 4\n");
    let turned = ABOVE.replace("f 4 5 6", "f 4 6 5");
    let vertex = format!("v 9 9 9\n{ABOVE}");
    for (text, part) in [(more.as_str(), "3"), (&turned, "triangle 1"), (&vertex, "7")] {
        place.write("other.obj", text);
        let message = place.refusal(1, &["cull", "start.obj", "other.obj"]);
        assert_says(&message, &["start.obj", "other.obj", part]);
    }
}

#[test]
fn a_coordinate_too_large_for_f32_is_named_with_its_vertex() {
    let place = Workplace::with_step();
    place.write("huge.obj", ABOVE.replace("v 0 5 0", "v 0 -1e39 0"));
    let arguments = ["cull", "start.obj", "huge.obj", "--pairs", "out.csv"];
    let message = place.refusal(1, &[&arguments[..], &["--scalar", "f32"]].concat());
    assert_says(&message, &["huge.obj", "y coordinate of vertex 2", "-1e39", "f64"]);
    assert!(place.run(&arguments).status.success());
}

#[test]
fn a_bad_frame_leaves_no_output_folder_behind() {
    let place = Workplace::with_step();
    place.write("end.obj", moved_by(f64::NAN));
    let message = place.refusal(1, &["compare", "start.obj", "end.obj", "--output", "new", "--csv", "new.csv"]);
    assert_says(&message, &["end.obj", "line 4"]);
}

#[test]
fn an_output_file_in_a_missing_folder_is_named() {
    let arguments = ["cull", "start.obj", "end.obj", "--pairs", "gone/out.csv"];
    let message = Workplace::with_step().refusal(1, &arguments);
    assert_says(&message, &["gone/out.csv", "cannot be written"]);
}

#[test]
fn an_output_folder_that_is_a_file_is_named() {
    let message = Workplace::with_step().refusal(1, &["--steps", "1", "--output", "start.obj"]);
    assert_says(&message, &["start.obj", "cannot be written"]);
}

#[test]
fn two_outputs_in_one_file_are_refused() {
    let arguments = ["cull", "start.obj", "end.obj", "--pairs", "o.csv", "--candidates", "o.csv"];
    assert_says(&Workplace::with_step().refusal(1, &arguments), &["same file"]);
}

#[test]
fn a_plot_that_cannot_be_written_is_refused_before_the_work() {
    let place = Workplace::with_step();
    for (arguments, parts) in [
        (&["--svg", "gone/plot.svg"][..], &["gone/plot.svg"][..]),
        (&["--json=gone/rows.json", "--svg", "a.svg"], &["gone/rows.json"]),
        (&["--json=same", "--svg", "same"], &["same file"]),
        (&["gone.obj", "end.obj", "--svg", "a.svg"], &["gone.obj"]),
    ] {
        assert_says(&place.refusal(1, &[&["accuracy"], arguments].concat()), parts);
    }
}

#[test]
fn one_bad_output_of_two_leaves_neither() {
    let arguments = [
        "cull",
        "start.obj",
        "end.obj",
        "--pairs",
        "o.csv",
        "--candidates",
        "gone/c.csv",
    ];
    assert_says(&Workplace::with_step().refusal(1, &arguments), &["gone/c.csv"]);
}

#[test]
fn an_unknown_preset_is_told_the_known_ones() {
    let place = Workplace::with_step();
    for arguments in [
        &["cull", "start.obj", "end.obj", "--pipeline", "curtis"][..],
        &["compare", "--pipelines", "basic,curtis"],
        &["scaling", "--pipeline", "curtis"],
    ] {
        let message = place.refusal(2, arguments);
        assert!(
            message.contains("'curtis'") && message.contains("curtis_2008, tang_2010"),
            "{message}"
        );
    }
}

#[test]
fn a_method_that_is_unknown_is_told_the_known_ones() {
    let place = Workplace::new();
    let message = place.refusal(2, &["queries", "q-vf.csv", "--method", "quartic"]);
    assert!(
        message.contains("no method") && message.contains("non_coplanarity, "),
        "{message}"
    );
}

#[test]
fn a_frame_too_few_or_a_number_out_of_range_is_refused() {
    let place = Workplace::with_step();
    for arguments in [
        &["cull", "start.obj"][..],
        &["compare", "start.obj"],
        &["compare", "start.obj", "end.obj", "--steps", "3"],
        &["compare", "--rounds", "0"],
        &["--threads", "1000000"],
        &["compare", "--refinement", "0"],
        &["--refinement", "2"],
        &["arm", "--frames", "61"],
        &["accuracy", "start.obj"],
        &["accuracy", "--pairs", "0"],
        &["accuracy", "--repeat", "0"],
        &["accuracy", "--separation=-1"],
        &["accuracy", "--separation", "nan"],
        &["accuracy", "--separation", "1e39"],
        &["accuracy", "--budget=-1"],
        &["accuracy", "--budget", "nan"],
        &["accuracy", "--budget", "1e99"],
        &["accuracy", "--budget", "soon"],
        &["cull", "start.obj", "end.obj", "--scalar", "f16"],
        &["simulat"],
    ] {
        place.refusal(2, arguments);
    }
}

/// Eight good rows of a query, with `row` (from 0) replaced.
fn rows_with(row: usize, text: &str) -> String {
    let mut rows = ["0,1,0,1,0,1,1"; 8];
    rows[row] = text;
    rows.join("\n")
}

#[track_caller]
fn query_refused(text: &str, parts: &[&str]) {
    let place = Workplace::new();
    place.write("bad-vf.csv", text);
    let message = place.refusal(1, &["queries", "bad-vf.csv"]);
    assert_says(&message, &[&["bad-vf.csv"], parts].concat());
}

#[test]
fn an_unreadable_csv_row_is_named_with_line_and_column() {
    query_refused(&rows_with(2, "0,1,zero,1,0,1,1"), &["line 3, column 3", "zero"]);
    query_refused(&rows_with(2, "0,1,0,1,0"), &["line 3", "5 columns"]);
    query_refused(&rows_with(2, "0,1,0,1,0,1,yes"), &["line 3, column 7", "yes"]);
    query_refused("0,1,0,1,0,1,1\n", &["line 1", "multiple of 8"]);
    query_refused("", &["no rows"]);
}

#[test]
fn a_zero_denominator_is_named_with_line_and_column() {
    query_refused(&rows_with(5, "0,1,0,0,0,1,1"), &["line 6, column 4", "denominator is zero"]);
}

#[test]
fn a_missing_file_of_queries_is_named() {
    let message = Workplace::new().refusal(1, &["queries", "gone-vf.csv"]);
    assert_says(&message, &["gone-vf.csv"]);
}

#[test]
fn queries_of_unknown_kind_ask_for_the_kind() {
    let place = Workplace::new();
    place.write("data.csv", rows_with(0, "0,1,0,1,0,1,1"));
    let message = place.refusal(1, &["queries", "data.csv"]);
    assert_says(&message, &["data.csv", "--kind"]);
}

#[test]
fn a_query_too_large_for_f32_is_named_with_its_line() {
    let place = Workplace::new();
    let huge = format!("0,1,0,1,1{},1,1", "0".repeat(39));
    place.write("huge-vf.csv", rows_with(6, &huge));
    let message = place.refusal(1, &["queries", "huge-vf.csv", "--scalar", "f32"]);
    assert_says(&message, &["huge-vf.csv", "line 1", "z of f1 at t = 1", "f64"]);
}
