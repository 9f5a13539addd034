//! Invalid input gives one message that names the file and the place, and the exit status, and leaves no files. Messages about
//! the content of a mesh or of queries are tested where these are read.

use crate::support::{ABOVE, Workplace, moved_by};

#[track_caller]
fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "`{part}` is missing in: {message}");
    }
    assert_eq!(message.lines().count(), 1, "{message}");
}

#[test]
fn a_mesh_that_cannot_be_read_is_named_with_the_place() {
    let place = Workplace::with_step();
    place.write("meshes/a.obj", ABOVE);
    place.write("mesh.stl", ABOVE);
    place.write("mesh.step", ABOVE);
    place.write("empty.ply", "");
    place.write("nan.obj", ABOVE.replace("v 0 5 0", "v 0 nan 0"));
    place.write("far.obj", ABOVE.replace("f 4 5 6", "f 4 5 7"));
    place.write("points.obj", "v 0 0 0\nv 1 0 0\n");
    place.stdout(&["arm", "--frames", "0"]);
    let whole = std::fs::read(place.path("arm-00.ply")).unwrap();
    place.write("cut.ply", &whole[..whole.len() / 2]);
    for (name, part) in [
        ("gone.ply", "no such file"),
        ("meshes", "folder"),
        ("mesh.stl", "the header is missing"),
        ("mesh.step", ".obj"),
        ("empty.ply", "empty"),
        ("nan.obj", "line 3"),
        ("far.obj", "vertex 7"),
        ("points.obj", "no triangles"),
        ("cut.ply", "is the file complete"),
    ] {
        for frames in [[name, "end.obj"], ["start.obj", name]] {
            let arguments = [&["cull"], &frames[..], &["--pairs", "p.csv", "--candidates", "c.csv"]].concat();
            assert_says(&place.refusal(1, &arguments), &[name, part]);
        }
    }
}

#[test]
fn frames_of_different_meshes_are_both_named_with_the_difference() {
    let place = Workplace::with_step();
    let more = format!("{ABOVE}f 1 2 4\n");
    let turned = ABOVE.replace("f 4 5 6", "f 4 6 5");
    let vertex = format!("v 9 9 9\n{ABOVE}");
    for (text, part) in [(more.as_str(), "3"), (&turned, "face 1"), (&vertex, "7")] {
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
fn outputs_that_cannot_be_written_are_refused_before_the_work_and_leave_nothing() {
    let place = Workplace::with_step();
    place.write("bad.obj", moved_by(f64::NAN));
    for (arguments, parts) in [
        (
            &["cull", "start.obj", "end.obj", "--pairs", "gone/out.csv"][..],
            &["gone/out.csv", "cannot be written"][..],
        ),
        (
            &[
                "cull",
                "start.obj",
                "end.obj",
                "--pairs",
                "o.csv",
                "--candidates",
                "gone/c.csv",
            ],
            &["gone/c.csv"],
        ),
        (
            &["cull", "start.obj", "end.obj", "--pairs", "o.csv", "--candidates", "o.csv"],
            &["same file"],
        ),
        (
            &["--steps", "1", "--output", "start.obj"],
            &["start.obj", "cannot be written"],
        ),
        (
            &["compare", "start.obj", "bad.obj", "--output", "new", "--csv", "new.csv"],
            &["bad.obj", "line 4"],
        ),
        (&["accuracy", "--svg", "gone/plot.svg"], &["gone/plot.svg"]),
        (&["accuracy", "--json=gone/rows.json", "--svg", "a.svg"], &["gone/rows.json"]),
        (&["accuracy", "--json=same", "--svg", "same"], &["same file"]),
        (&["accuracy", "gone.obj", "end.obj", "--svg", "a.svg"], &["gone.obj"]),
    ] {
        assert_says(&place.refusal(1, arguments), parts);
    }
}

#[test]
fn an_unknown_name_is_answered_with_the_known_ones() {
    let place = Workplace::with_step();
    for (arguments, known) in [
        (
            &["cull", "start.obj", "end.obj", "--pipeline", "curtis"][..],
            "curtis_2008, tang_2010",
        ),
        (&["compare", "--pipelines", "basic,curtis"], "curtis_2008, tang_2010"),
        (&["scaling", "--pipeline", "curtis"], "curtis_2008, tang_2010"),
        (&["queries", "q-vf.csv", "--method", "quartic"], "non_coplanarity, "),
    ] {
        let message = place.refusal(2, arguments);
        assert!(message.contains(known), "{message}");
    }
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

#[test]
fn queries_that_cannot_be_read_are_named_with_the_place() {
    let place = Workplace::new();
    let rows_with = |row: usize, text: &str| {
        let mut rows = ["0,1,0,1,0,1,1"; 8];
        rows[row] = text;
        rows.join("\n")
    };
    place.write("word-vf.csv", rows_with(2, "0,1,zero,1,0,1,1"));
    place.write("zero-vf.csv", rows_with(5, "0,1,0,0,0,1,1"));
    place.write("data.csv", rows_with(0, "0,1,0,1,0,1,1"));
    place.write("huge-vf.csv", rows_with(6, &format!("0,1,0,1,1{},1,1", "0".repeat(39))));
    for (arguments, parts) in [
        (&["gone-vf.csv"][..], &["gone-vf.csv"][..]),
        (&["word-vf.csv"], &["word-vf.csv", "line 3, column 3"]),
        (&["zero-vf.csv"], &["line 6, column 4", "denominator is zero"]),
        (&["data.csv"], &["data.csv", "--kind"]),
        (
            &["huge-vf.csv", "--scalar", "f32"],
            &["huge-vf.csv", "line 1", "z of f1 at t = 1", "f64"],
        ),
    ] {
        assert_says(&place.refusal(1, &[&["queries"], arguments].concat()), parts);
    }
}
