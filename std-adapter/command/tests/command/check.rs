//! `selvedge check`: the files that it writes.

use crate::support::{ABOVE, Workplace, moved_by};
use selvedge_files::mesh;
use serde_json::{Value, json};

#[test]
fn the_list_names_the_vertices_of_both_as_json() {
    let place = Workplace::new();
    place.write("above.obj", ABOVE);
    place.write("through.obj", moved_by(-1.05));
    place.run(&["check", "above.obj", "through.obj", "--list", "list.json"]);
    let document: Value = serde_json::from_str(&place.read("list.json")).unwrap();
    let meets = |edge: [u32; 2]| json!({ "kind": "edge-face", "vertices": [edge[0], edge[1], 0, 1, 2] });
    let expected = json!({ "meshes": [
        { "mesh": "above.obj", "intersections": [] },
        { "mesh": "through.obj", "intersections": [meets([3, 4]), meets([3, 5])] },
    ]});
    assert_eq!(document, expected);
}

#[test]
fn the_mesh_in_colours_is_written_where_there_are_intersections_and_reads_back() {
    let place = Workplace::new();
    place.write("above.obj", ABOVE);
    // A third triangle is far away, and not red.
    place.write("through.obj", moved_by(-1.05) + "v 9 9 9\nv 9 8 9\nv 8 9 9\nf 7 8 9\n");
    place.run(&["check", "above.obj", "through.obj", "--ply", "out"]);
    let written = "out/through-intersections.ply";
    assert_eq!(place.listing(), ["above.obj", "out", written, "through.obj"]);
    let coloured = mesh::read(&place.path(written)).unwrap();
    assert_eq!(coloured.mesh, mesh::read(&place.path("through.obj")).unwrap().mesh);
    let bytes = std::fs::read(place.path(written)).unwrap();
    let (vertices, faces) = bytes[bytes.len() - 9 * 27 - 3 * 16..].split_at(9 * 27);
    let is_red = |record: &[u8]| record[record.len() - 3] > record[record.len() - 2];
    let colours = |records: &[u8], size: usize| -> Vec<bool> { records.chunks(size).map(is_red).collect() };
    let (red, grey) = (true, false);
    assert_eq!(colours(vertices, 27), [[red; 6].as_slice(), &[grey; 3]].concat());
    assert_eq!(colours(faces, 16), [red, red, grey]);
}

#[test]
fn a_rope_in_colours_has_its_edges() {
    let place = Workplace::new();
    place.write(
        "through.obj",
        "v 0 0 0\nv 4 0 0\nv 0 4 0\nf 1 2 3\nv 1 1 1\nv 1 1 -1\nv 1 1 -2\nl 4 5 6\n",
    );
    place.run(&["check", "through.obj", "--ply", "red"]);
    let coloured = mesh::read_with_loose_features(&place.path("red/through-intersections.ply")).unwrap();
    assert_eq!(coloured.topology.triangles(), [[0, 1, 2], [3, 4, 4], [4, 5, 5]]);
}
