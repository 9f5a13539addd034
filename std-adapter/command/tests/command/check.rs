//! `selvedge check`.

use crate::support::{ABOVE, Workplace, keys, moved_by};
use selvedge_files::mesh;
use serde_json::{Value, json};

/// Returns the output of a run that finds intersections.
#[track_caller]
fn tangled(place: &Workplace, arguments: &[&str]) -> String {
    let output = place.run(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(3), "{errors}");
    String::from_utf8(output.stdout).unwrap()
}

/// The small triangle lies at three heights: above the large one, through it, and with a corner on it.
fn sequence() -> Workplace {
    let place = Workplace::new();
    place.write("above.obj", ABOVE);
    place.write("through.obj", moved_by(-1.05));
    place.write("on.obj", moved_by(-1.0));
    place
}

#[test]
fn the_exit_status_says_whether_there_are_intersections() {
    let place = sequence();
    assert!(place.stdout(&["check", "above.obj"]).contains("free of intersections"));
    assert!(tangled(&place, &["check", "through.obj"]).contains("intersects itself"));
    assert!(tangled(&place, &["check", "--any", "above.obj", "on.obj"]).contains("1 of 2 meshes intersect themselves"));
}

#[test]
fn json_has_counts_of_each_mesh_in_order() {
    let place = sequence();
    let text = tangled(&place, &["check", "--json", "above.obj", "through.obj", "on.obj"]);
    let document: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(keys(&document), ["meshes", "are_free"]);
    assert_eq!(document["are_free"], false);
    let meshes = document["meshes"].as_array().unwrap();
    let names = [
        "mesh",
        "vertices",
        "triangles",
        "edge_face",
        "vertex_face",
        "edge_edge",
        "is_free",
        "is_complete",
        "seconds",
        "file",
    ];
    assert_eq!(keys(&meshes[0]), names);
    let counts: Vec<_> = meshes
        .iter()
        .map(|mesh| [&mesh["mesh"], &mesh["edge_face"], &mesh["is_free"]])
        .collect();
    // Two edges meet at the corner below the large triangle's plane.
    assert_eq!(counts[0], [&json!("above.obj"), &json!(0), &json!(true)]);
    assert_eq!(counts[1], [&json!("through.obj"), &json!(2), &json!(false)]);
    assert_eq!(counts[2], [&json!("on.obj"), &json!(2), &json!(false)]);

    // With --any, only the verdict is known.
    let document: Value = serde_json::from_str(&tangled(&place, &["check", "--json", "--any", "on.obj"])).unwrap();
    assert!(document["meshes"][0]["edge_face"].is_null() && document["are_free"] == false);
}

#[test]
fn the_list_names_the_vertices_of_both_as_csv_and_as_json() {
    let place = sequence();
    tangled(&place, &["check", "above.obj", "through.obj", "--list", "list.csv"]);
    let expected = "\
mesh,kind,i0,i1,i2,i3,i4
through.obj,edge-face,3,4,0,1,2
through.obj,edge-face,3,5,0,1,2
";
    assert_eq!(place.read("list.csv"), expected);
    tangled(&place, &["check", "above.obj", "through.obj", "--list", "list.json"]);
    let document: Value = serde_json::from_str(&place.read("list.json")).unwrap();
    let meets = |edge: [u32; 2]| json!({ "kind": "edge-face", "vertices": [edge[0], edge[1], 0, 1, 2] });
    let expected = json!({ "meshes": [
        { "mesh": "above.obj", "intersections": [] },
        { "mesh": "through.obj", "intersections": [meets([3, 4]), meets([3, 5])] },
    ]});
    assert_eq!(document, expected);
}

#[test]
fn neighbours_folded_flat_are_listed_by_their_edges() {
    let place = Workplace::new();
    place.write("folded.obj", "v 0 0 0\nv 3 1 0\nv 1 2 0\nv 2 2 0\nf 1 2 3\nf 2 1 4\n");
    tangled(&place, &["check", "folded.obj", "--list", "list.csv"]);
    assert_eq!(
        place.read("list.csv"),
        "mesh,kind,i0,i1,i2,i3,i4\nfolded.obj,edge-edge,1,2,0,3,\n"
    );
}

#[test]
fn the_mesh_in_colours_is_written_where_there_are_intersections_and_reads_back() {
    let place = Workplace::new();
    place.write("above.obj", ABOVE);
    // A third triangle is far away, and not red.
    place.write("through.obj", moved_by(-1.05) + "v 9 9 9\nv 9 8 9\nv 8 9 9\nf 7 8 9\n");
    tangled(&place, &["check", "above.obj", "through.obj", "--ply", "out"]);
    assert_eq!(
        place.listing(),
        ["above.obj", "out", "out/through-intersections.ply", "through.obj"]
    );
    let coloured = mesh::read(&place.path("out/through-intersections.ply")).unwrap();
    assert_eq!(coloured.mesh, mesh::read(&place.path("through.obj")).unwrap().mesh);
    let bytes = std::fs::read(place.path("out/through-intersections.ply")).unwrap();
    let (vertices, faces) = bytes[bytes.len() - 9 * 27 - 3 * 16..].split_at(9 * 27);
    let colours = |records: &[u8], size: usize| -> Vec<bool> {
        records
            .chunks(size)
            .map(|record| record[size - 3] > record[size - 2])
            .collect()
    };
    let (red, grey) = (true, false);
    assert_eq!(colours(vertices, 27), [[red; 6].as_slice(), &[grey; 3]].concat());
    assert_eq!(colours(faces, 16), [red, red, grey]);
}

#[test]
fn meshes_with_other_triangles_may_follow_each_other() {
    let place = sequence();
    place.write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    let text = tangled(
        &place,
        &["check", "--json", "other.obj", "through.obj", "other.obj", "above.obj"],
    );
    let document: Value = serde_json::from_str(&text).unwrap();
    let free: Vec<_> = document["meshes"]
        .as_array()
        .unwrap()
        .iter()
        .map(|mesh| &mesh["is_free"])
        .collect();
    assert_eq!(free, [true, false, true, true]);
}

#[test]
fn a_file_that_was_not_read_whole_is_never_called_free() {
    let place = sequence();
    place.write("surface.obj", format!("{ABOVE}surf 0 1 0 1 1 2 3 4\n"));
    place.write("both.obj", format!("{}surf 0 1 0 1 1 2 3 4\n", moved_by(-1.05)));
    for any in [&["check"][..], &["check", "--any"]] {
        let output = place.run(&[any, &["above.obj", "surface.obj"]].concat());
        let text = String::from_utf8(output.stdout).unwrap();
        assert_eq!(output.status.code(), Some(4), "{text}");
        assert!(
            text.contains("surface.obj: not all of it was read: 1 line 'surf' (line 9)"),
            "{text}"
        );
        assert!(
            text.contains("1 of 2 meshes were not read whole") && !text.contains("free"),
            "{text}"
        );
        let text = tangled(&place, &[any, &["both.obj", "surface.obj"]].concat());
        assert!(
            text.contains("1 of 2 meshes intersect themselves, 1 were not read whole"),
            "{text}"
        );
    }
    let output = place.run(&["check", "--json", "surface.obj"]);
    let document: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mesh = &document["meshes"][0];
    assert_eq!([&document["are_free"], &mesh["is_complete"]], [false, false]);
    assert_eq!(mesh["file"]["left_out"][0]["line"], 9);
}

#[test]
fn split_seams_are_named_and_merged_on_request() {
    let place = Workplace::new();
    let seam = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\ng back\nf 4 5 6\n";
    place.write("seam.obj", seam);
    let text = tangled(&place, &["check", "seam.obj"]);
    assert!(
        text.contains("seam.obj: 2 vertices in the same place as others (weld merges them)"),
        "{text}"
    );
    for arguments in [&["--weld"][..], &["--weld=0"], &["--weld=1e-3"], &["--only", "back"]] {
        let text = place.stdout(&[&["check", "seam.obj"], arguments].concat());
        assert!(text.contains("free of intersections"), "{text}");
    }
    let message = place.refusal(1, &["check", "seam.obj", "--only", "front"]);
    assert!(
        message.contains("there is no group or object 'front'; choose from 'back'"),
        "{message}"
    );
    place.refusal(2, &["check", "seam.obj", "--weld=-1"]);
}

#[test]
fn what_cannot_be_read_or_written_is_refused_with_its_name() {
    let place = sequence();
    let refused = |status, arguments: &[&str], text: &str| {
        let message = place.refusal(status, &[&["check"], arguments].concat());
        assert!(message.contains(text), "{message}");
    };
    refused(1, &["above.obj", "missing.obj"], "missing.obj");
    place.write("nothing.obj", "v 0 0 0\n");
    refused(1, &["nothing.obj"], "nothing.obj");
    refused(
        1,
        &["on.obj", "--list", "list.txt"],
        "list.txt: the name of the list must end in .csv or .json",
    );
    refused(1, &["on.obj", "--list", "nowhere/list.csv"], "nowhere");
    refused(2, &["on.obj", "--any", "--list", "list.csv"], "cannot be used with");
    refused(2, &[], "<MESH>");
    place.write("again/on.obj", ABOVE);
    refused(1, &["on.obj", "again/on.obj", "--ply", "out"], "would both be written");
}

/// A rope passes through a triangle, and two points of a cloud coincide.
#[test]
fn ropes_and_clouds_of_points_are_looked_at() {
    let place = Workplace::new();
    let rope = |x: f64| format!("v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\nv {x} 1 1\nv {x} 1 -1\nv {x} 1 -2\nl 4 5 6\n");
    place.write("through.obj", rope(1.0));
    place.write("beside.obj", rope(3.5));
    let cloud = |last: &str| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n1 0 0\n{last}\n"
        )
    };
    place.write("cloud.ply", cloud("0 1 0"));
    place.write("twice.ply", cloud("1 0 0"));
    let free = place.stdout(&["check", "beside.obj", "cloud.ply"]);
    assert!(free.contains("free of intersections"), "{free}");

    let json: Value = serde_json::from_str(&place.stdout(&["check", "--json", "beside.obj", "cloud.ply"])).unwrap();
    let counts = [0, 1].map(|mesh| [&json["meshes"][mesh]["vertices"], &json["meshes"][mesh]["triangles"]]);
    assert_eq!(counts, [[&json!(6), &json!(1)], [&json!(3), &json!(0)]]);

    let arguments = ["check", "through.obj", "twice.ply", "--list", "list.csv", "--ply", "red"];
    let text = tangled(&place, &arguments);
    assert!(text.contains("2 of 2 meshes intersect themselves"), "{text}");
    let list = std::fs::read_to_string(place.path("list.csv")).unwrap();
    assert!(list.contains("through.obj,edge-face,3,4,0,1,2\n"), "{list}");
    assert!(list.contains("twice.ply,vertex-face,1,2,2,2,\n"), "{list}");
    let coloured = mesh::read_with_loose_features(&place.path("red/through-intersections.ply")).unwrap();
    assert_eq!(coloured.topology.triangles(), [[0, 1, 2], [3, 4, 4], [4, 5, 5]]);
}
