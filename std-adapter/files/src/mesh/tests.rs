//! Tests of the readers and writers of mesh files.

use super::*;
use proptest::prelude::*;
use std::fs;
use tempfile::TempDir;

const FORMATS: [FileFormat; 4] = [
    FileFormat::Obj,
    FileFormat::Ply(PlyEncoding::Ascii),
    FileFormat::Ply(PlyEncoding::LittleEndian),
    FileFormat::Ply(PlyEncoding::BigEndian),
];
const PLY: FileFormat = FileFormat::Ply(PlyEncoding::Ascii);

/// Generates meshes with any triangles and finite coordinates, which include denormals, huge ones and both zeros.
fn meshes() -> impl Strategy<Value = Mesh> {
    let coordinate = prop_oneof![
        any::<u64>()
            .prop_map(f64::from_bits)
            .prop_filter("finite", |value| value.is_finite()),
        Just(-0.0),
        Just(f64::MIN_POSITIVE / 4.0),
        -1.0..1.0,
    ];
    let position = prop::array::uniform3(coordinate).prop_map(DVec3::from_array);
    prop::collection::vec(position, 1..12).prop_flat_map(|positions| {
        let vertices = positions.len() as u32;
        let triangles = prop::collection::vec(prop::array::uniform3(0..vertices), 1..12);
        (Just(positions), triangles).prop_map(|(positions, triangles)| Mesh { positions, triangles })
    })
}

fn bytes_of(mesh: &Mesh, format: FileFormat) -> Vec<u8> {
    let mut bytes = Vec::new();
    match format {
        FileFormat::Obj => obj::write(&mut bytes, mesh, &[]).unwrap(),
        FileFormat::Ply(encoding) => ply::write(&mut bytes, mesh, &[], encoding).unwrap(),
        FileFormat::Stl | FileFormat::Off | FileFormat::Gltf => unreachable!("only read"),
    }
    bytes
}

fn bits(mesh: &Mesh) -> Vec<[u64; 3]> {
    mesh.positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

fn triangle() -> Mesh {
    Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y], vec![[0, 1, 2]])
}

fn read_obj(text: &str) -> MeshFile {
    read_bytes(text.as_bytes(), FileFormat::Obj).unwrap()
}

fn problem(bytes: impl AsRef<[u8]>, format: FileFormat) -> String {
    read_bytes(bytes.as_ref(), format).unwrap_err().to_string()
}

/// Writes a binary PLY file with these properties of its elements and these bytes.
fn ply_binary(vertex: &str, faces: &str, body: &[u8]) -> Vec<u8> {
    let mut bytes = format!("ply\nformat binary_little_endian 1.0\n{vertex}\n{faces}\nend_header\n").into_bytes();
    bytes.extend_from_slice(body);
    bytes
}

proptest! {
    #[test]
    fn every_format_gives_back_every_bit_and_every_number(mesh in meshes()) {
        for format in FORMATS {
            let read = read_bytes(&bytes_of(&mesh, format), format).unwrap().mesh;
            prop_assert_eq!(bits(&read), bits(&mesh), "{:?}", format);
            prop_assert_eq!(&read.triangles, &mesh.triangles, "{:?}", format);
        }
    }

    #[test]
    fn a_header_that_claims_anything_never_panics(vertices: u64, faces: u64, count in "char|uchar|short|int|uint|float", number in "char|ushort|int|uint|double", body: Vec<u8>) {
        let vertex = format!("element vertex {vertices}\nproperty char x\nproperty char y\nproperty char z");
        let edges = format!("element edge {faces}\nproperty {number} vertex1\nproperty {number} vertex2");
        let faces = format!("element face {faces}\nproperty list {count} {number} vertex_index");
        for element in [faces, edges] {
            let bytes = ply_binary(&vertex, &element, &body);
            let _ = read_bytes(&bytes, PLY);
            let _ = read_bytes_with_loose_features(&bytes, PLY);
        }
    }

    #[test]
    fn no_proper_beginning_of_a_binary_file_is_taken_for_the_whole(mesh in meshes(), cut in any::<prop::sample::Index>()) {
        let format = FileFormat::Ply(PlyEncoding::LittleEndian);
        let bytes = bytes_of(&mesh, format);
        prop_assert!(read_bytes(&bytes[..cut.index(bytes.len())], format).is_err());
    }
}

#[test]
fn vertices_keep_the_files_numbers_across_objects_and_without_faces() {
    let file = read_obj("o a\nv 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\no b\ng c\nv 0 0 1\nf 5 3 2\n");
    assert_eq!(file.mesh.positions.len(), 5);
    assert_eq!(file.mesh.triangles, [[1, 2, 3], [4, 2, 1]]);
    assert_eq!(file.notes.statistics.isolated_vertices, 1);
}

#[test]
fn polygons_become_fans_from_their_first_vertex_and_are_counted() {
    let file = read_obj("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nf 2 3 4 5 1\nf 1 2 3\nf 1 2 3 4\n");
    assert_eq!(
        file.mesh.triangles,
        [[1, 2, 3], [1, 3, 4], [1, 4, 0], [0, 1, 2], [0, 1, 2], [0, 2, 3]]
    );
    assert_eq!(file.notes.polygons_triangulated, 2);
    assert_eq!(file.notes.statistics.duplicate_triangles, 1);
    assert!(
        file.notes
            .to_string()
            .ends_with(", 1 duplicate triangle, 2 polygons split into triangles"),
        "{}",
        file.notes
    );
}

#[test]
fn a_written_file_is_read_back_by_its_extension_in_capitals_or_not() {
    let folder = TempDir::new().unwrap();
    for name in ["a.obj", "a.ply", "b.OBJ", "b.PLY"] {
        let path = folder.path().join(name);
        write(&path, &triangle()).unwrap();
        assert_eq!(read(&path).unwrap().mesh, triangle(), "{name}");
    }
    assert_eq!(
        fs::read_dir(&folder).unwrap().count(),
        4,
        "nothing else is left in the folder"
    );
}

#[test]
fn a_mesh_that_could_not_be_read_again_is_not_written_and_the_old_file_stays() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a.ply");
    fs::write(&path, "old").unwrap();
    let bad = |change: Change| {
        let mut mesh = triangle();
        change(&mut mesh);
        write(&path, &mesh).unwrap_err().to_string()
    };
    assert!(bad(|mesh| mesh.positions[1].x = f64::NAN).ends_with("the x coordinate of vertex 1 is NaN, but must be finite"));
    assert!(bad(|mesh| mesh.triangles[0][2] = 3).ends_with("face 0 names vertex 3, but there are 3 vertices, numbered from 0"));
    assert!(bad(|mesh| mesh.triangles.clear()).ends_with("the mesh has no triangles"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(
        fs::read_dir(&folder).unwrap().count(),
        1,
        "nothing else is left in the folder"
    );
}

#[test]
fn nothing_is_left_behind_where_a_file_cannot_be_put() {
    let folder = TempDir::new().unwrap();
    fs::create_dir_all(folder.path().join("a.obj/in the way")).unwrap();
    let error = write(&folder.path().join("a.obj"), &triangle()).unwrap_err();
    assert!(
        matches!(
            error,
            MeshError::File {
                problem: FileProblem::Write(_),
                ..
            }
        ),
        "{error}"
    );
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
}

#[test]
#[cfg(unix)]
fn a_written_file_has_the_permissions_of_any_new_file() {
    use std::os::unix::fs::PermissionsExt;
    let folder = TempDir::new().unwrap();
    let (ours, plain) = (folder.path().join("a.obj"), folder.path().join("b.obj"));
    write(&ours, &triangle()).unwrap();
    fs::write(&plain, "").unwrap();
    let mode = |path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(ours), mode(plain));
}

type Change = fn(&mut Mesh);

fn written_step(change: Change) -> (TempDir, Result<MeshStep, MeshError>) {
    let folder = TempDir::new().unwrap();
    let (start, end) = (folder.path().join("start.obj"), folder.path().join("end.ply"));
    let mut mesh = Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2], [1, 2, 3]]);
    write(&start, &mesh).unwrap();
    change(&mut mesh);
    write(&end, &mesh).unwrap();
    let step = read_step(&start, &end);
    (folder, step)
}

#[test]
fn two_frames_of_one_mesh_are_a_step_whatever_their_formats() {
    let (_folder, step) = written_step(|mesh| mesh.positions[3] *= 2.0);
    let step = step.unwrap();
    assert_eq!(step.topology.triangles(), [[0, 1, 2], [1, 2, 3]]);
    assert_eq!((step.start[3], step.end[3]), (DVec3::Z, 2.0 * DVec3::Z));
}

#[test]
fn frames_of_different_meshes_are_refused_with_both_names_and_the_first_difference() {
    let cases: [(Change, &str); 3] = [
        (
            |mesh| mesh.positions.push(DVec3::ONE),
            "the first has 4 vertices, the second 5",
        ),
        (
            |mesh| mesh.triangles[1] = [1, 3, 2],
            "face 1 is 1 2 3 in the first, 1 3 2 in the second",
        ),
        (|mesh| mesh.triangles.truncate(1), "the first has 2 faces, the second 1"),
    ];
    for (change, difference) in cases {
        let (folder, step) = written_step(change);
        let at = |name: &str| folder.path().join(name).display().to_string();
        assert_eq!(
            step.unwrap_err().to_string(),
            format!(
                "{} and {} are not frames of the same mesh: {difference}; export both with the same vertices and triangles in the same order",
                at("start.obj"),
                at("end.ply")
            )
        );
    }
}

#[test]
fn the_start_of_a_step_splits_polygons_for_both_frames() {
    let folder = TempDir::new().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("start.obj"), "v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nf 1 2 3 4\n").unwrap();
    fs::write(path("end.obj"), "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nsurf 1\nf 1 2 3 4\n").unwrap();
    let step = read_step(&path("start.obj"), &path("end.obj")).unwrap();
    // This is not the fan of the end, which would cover the notch at the start.
    assert!(step.topology.edges().contains(&[0, 2]), "{:?}", step.topology);
    assert_eq!(step.topology.triangles().len(), 2);
    assert_eq!(step.notes.missing().as_deref(), Some("1 line 'surf' (line 5)"));
}

#[test]
fn one_group_or_object_alone_can_be_read() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 4\no coat\ng sleeve left\nf 1 2 3\ng hood\nf 2 3 4\no shoe\nf 1 3 4\ng sleeve\nf 1 2 3\n";
    let only = |name| {
        let options = ReadOptions {
            only: Some(name),
            ..ReadOptions::default()
        };
        read_bytes_with(text.as_bytes(), FileFormat::Obj, &options).map(|mesh| mesh.topology.triangles().to_vec())
    };
    assert_eq!(only("left").unwrap(), [[0, 1, 2]]);
    assert_eq!(only("sleeve").unwrap(), [[0, 1, 2], [0, 1, 2]]);
    assert_eq!(only("sleeve left").unwrap(), [[0, 1, 2]]);
    assert_eq!(only("coat").unwrap(), [[0, 1, 2], [1, 2, 3]]);
    assert_eq!(
        only("glove").unwrap_err().to_string(),
        "there is no group or object 'glove'; choose from 'coat', 'sleeve left', 'hood', 'shoe', 'sleeve'"
    );
    let options = ReadOptions {
        only: Some("a"),
        ..ReadOptions::default()
    };
    let ply = read_bytes_with(&bytes_of(&triangle(), PLY), PLY, &options)
        .unwrap_err()
        .to_string();
    assert_eq!(
        ply,
        "this kind of file has no groups; only OBJ and glTF files can be read in part"
    );
}

#[test]
fn vertices_are_merged_on_request_and_keep_their_numbers() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1e-7 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\nf 2 4 6\nl 3 5 6\np 5 3\n";
    let welded = |tolerance| {
        let options = ReadOptions {
            weld: Some(tolerance),
            loose_features: true,
            ..ReadOptions::default()
        };
        read_bytes_with(text.as_bytes(), FileFormat::Obj, &options).unwrap()
    };
    let exactly = welded(0.0);
    assert_eq!(exactly.topology.proper_triangles(), [[0, 1, 2], [3, 5, 2], [1, 3, 5]]);
    assert!(exactly.topology.loose_edges().eq([[2, 5]]) && exactly.topology.points().eq([2]));
    assert_eq!((exactly.notes.welded_vertices, exactly.positions.len()), (1, 6));
    let nearly = welded(1e-6);
    assert_eq!(nearly.topology.proper_triangles(), [[0, 1, 2], [1, 5, 2]]);
    assert!(
        nearly
            .notes
            .to_string()
            .ends_with(", 2 vertices merged, 1 triangle collapsed by that"),
        "{}",
        nearly.notes
    );
}

fn loose(text: &str, format: FileFormat) -> LooseMesh {
    read_bytes_with_loose_features(text.as_bytes(), format).unwrap()
}

fn loose_problem(text: &str, format: FileFormat) -> String {
    let read = read_bytes_with_loose_features(text.as_bytes(), format);
    read.unwrap_err().to_string()
}

/// Writes a header and its lines, as text.
fn ply_of(elements: &str, body: &str) -> String {
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n{elements}end_header\n0 0 0\n1 0 0\n0 1 0\n{body}"
    )
}

#[test]
fn edges_and_points_of_no_triangle_are_kept_where_they_are_wanted() {
    let text = "p -1 4\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 0 0 1\nl 1/7 2 \\\n-1\np 4\n";
    let text = text.replace("p -1 4\n", "l 4 1\n");
    let mesh = loose(&text, FileFormat::Obj);
    assert_eq!(mesh.positions.len(), 4);
    let expected = [[0, 1, 2], [3, 0, 0], [0, 1, 1], [1, 3, 3], [3, 3, 3]];
    assert_eq!(mesh.topology.triangles(), expected);
    assert_eq!(
        (mesh.topology.statistics().loose_edges, mesh.topology.statistics().points),
        (3, 1)
    );
    // A caller that asks for triangles gets no other features.
    assert_eq!(read_obj(&text).mesh.triangles, [[0, 1, 2]]);

    let edges = "element edge 2\nproperty int vertex1\nproperty uchar weight\nproperty int vertex2\n";
    let rope = ply_of(edges, "0 9 1\n1 9 2\n");
    assert_eq!(loose(&rope, PLY).topology.triangles(), [[0, 1, 1], [1, 2, 2]]);
    let face = "element face 1\nproperty list uchar int vertex_indices\n";
    let both = ply_of(&format!("{face}{edges}"), "3 0 1 2\n0 9 1\n1 9 2\n");
    assert_eq!(loose(&both, PLY).topology.triangles(), [[0, 1, 2], [0, 1, 1], [1, 2, 2]]);
    assert_eq!(read_bytes(both.as_bytes(), PLY).unwrap().mesh.triangles, [[0, 1, 2]]);
    for elements in ["", "element face 0\nproperty list uchar int vertex_indices\n"] {
        let cloud = loose(&ply_of(elements, ""), PLY);
        assert_eq!(cloud.topology.triangles(), [[0, 0, 0], [1, 1, 1], [2, 2, 2]]);
    }
    // The result is what `read` makes of all meshes.
    for format in FORMATS {
        let mesh = triangle();
        let read = read_bytes_with_loose_features(&bytes_of(&mesh, format), format).unwrap();
        assert_eq!(
            (read.positions, read.topology),
            (mesh.positions.clone(), mesh.topology().unwrap())
        );
    }
}

#[test]
fn loose_edges_are_read_as_they_were_written_with_triangles_and_without() {
    let folder = TempDir::new().unwrap();
    let positions = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::splat(0.1)];
    for triangles in [vec![], vec![[0, 1, 2]]] {
        let mesh = Mesh::new(positions.clone(), triangles);
        for format in FORMATS {
            let path = folder
                .path()
                .join(if format == FileFormat::Obj { "rope.obj" } else { "rope.ply" });
            write_checked(&path, &mesh, &[[3, 0], [3, 2]], format).unwrap();
            let read = read_with_loose_features(&path).unwrap();
            assert_eq!(read.positions, mesh.positions);
            assert_eq!(read.topology.proper_triangles(), mesh.triangles);
            assert!(read.topology.loose_edges().eq([[3, 0], [3, 2]]));
        }
    }
    let path = folder.path().join("rope.obj");
    let mesh = Mesh::new(positions, Vec::new());
    let written = |edges: &[[u32; 2]]| write_with_loose_edges(&path, &mesh, edges).unwrap_err().to_string();
    let no_vertex = "loose edge 1 names vertex 4, but there are 4 vertices, numbered from 0";
    assert_eq!(written(&[[0, 1], [1, 4]]), format!("{}: {no_vertex}", path.display()));
    assert!(written(&[]).ends_with("the mesh has no triangles"));
}

#[test]
fn edges_and_points_that_are_none_are_errors_that_name_their_line() {
    let three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let wrong = "\
l 1 | a line needs two vertices or more, but names 1
l 1 4 | an edge names vertex 4, but there are 3 vertices, numbered from 1
l 1 0 | an edge names vertex 0, but there are 3 vertices, numbered from 1
p -4 | a point names vertex -4, but there are 3 vertices, numbered from 1
p x | a point names a vertex 'x', which is not a whole number";
    for (line, expected) in wrong.lines().filter_map(|row| row.split_once(" | ")) {
        let text = format!("{three}{line}\n");
        assert_eq!(loose_problem(&text, FileFormat::Obj), format!("line 4: {expected}"));
        // They were not requested.
        assert!(read_bytes(format!("{text}f 1 2 3\n").as_bytes(), FileFormat::Obj).is_ok());
    }
    assert_eq!(loose_problem(three, FileFormat::Obj), problem(three, FileFormat::Obj));
    let edges = |kind: &str| format!("element edge 1\nproperty {kind} vertex1\nproperty int vertex2\n");
    assert_eq!(
        loose_problem(&ply_of(&edges("int"), "0 3\n"), PLY),
        "line 14: 'edge' element 0 names vertex 3, but there are 3 vertices, numbered from 0"
    );
    assert_eq!(
        loose_problem(&ply_of(&edges("int"), "-1 0\n"), PLY),
        "line 14: 'edge' element 0 names vertex -1, but there are 3 vertices, numbered from 0"
    );
    assert_eq!(
        loose_problem(&ply_of(&edges("float"), "0 1\n"), PLY),
        "the header declares no integer 'vertex1' for the element 'edge'"
    );
}

#[test]
fn numbered_files_are_frames_in_the_order_of_their_numbers() {
    let folder = TempDir::new().unwrap();
    let frame = |number: u64| Mesh {
        positions: triangle()
            .positions
            .into_iter()
            .map(|p| p + DVec3::Z * number as f64)
            .collect(),
        ..triangle()
    };
    // The numbers have more digits than the first, and files are of both formats.
    for number in [8, 9, 10, 11] {
        write(&folder.path().join(format!("leaf{number}.ply")), &frame(number)).unwrap();
    }
    fs::write(folder.path().join("leaf.txt"), "of no interest").unwrap();
    let by_name = read_sequence(&folder.path().join("leaf#.ply")).unwrap();
    let heights: Vec<f64> = by_name.frames.iter().map(|frame| frame[0].z).collect();
    assert_eq!((heights, by_name.triangles.len()), (vec![8.0, 9.0, 10.0, 11.0], 1));
    assert_eq!(by_name.files[3], folder.path().join("leaf11.ply"));
    assert_eq!(read_sequence(folder.path()).unwrap(), by_name);
}

#[test]
fn what_is_no_sequence_is_refused_with_the_frame_or_the_file_named() {
    let folder = TempDir::new().unwrap();
    let put = |name: &str| write(&folder.path().join(name), &triangle()).unwrap();
    let message = |pattern: &str| {
        let path = folder.path().join(pattern);
        let error = read_sequence(&path).unwrap_err().to_string();
        error.replace(&*folder.path().to_string_lossy(), "F")
    };
    assert_eq!(message("leaf-#.obj"), "F/leaf-#.obj: there is no such file in 'F'");
    assert_eq!(message(""), "F/: there is no such file in 'F/'");
    for name in ["leaf-1.obj", "leaf-2.obj", "leaf-5.obj"] {
        put(name);
    }
    assert_eq!(
        message("leaf-#.obj"),
        "F/leaf-#.obj: frame 3 is missing: there are frames up to 2, and from 5 on"
    );
    assert!(message("leaf-1.obj").ends_with("must have one run of '#' where their numbers stand, such as body-####.ply"));
    assert!(message("#-#.obj").contains("one run of '#'"));
    assert!(message("no/leaf-#.obj").starts_with("F/no/leaf-#.obj: the folder 'F/no' cannot be read: "));
    fs::remove_file(folder.path().join("leaf-5.obj")).unwrap();
    put("leaf-02.obj");
    assert_eq!(
        message("leaf-#.obj"),
        "F/leaf-#.obj: frame 2 is there twice: 'leaf-02.obj' and 'leaf-2.obj'"
    );
    fs::remove_file(folder.path().join("leaf-02.obj")).unwrap();
    put("shirt.obj");
    assert!(message("").contains("more than one sequence ('leaf-1.obj' and 'shirt.obj'); name the files"));
    let text = |lines: &str| fs::write(folder.path().join("leaf-3.obj"), lines).unwrap();
    text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\n");
    assert!(
        message("leaf-#.obj")
            .contains("F/leaf-1.obj and F/leaf-3.obj are not frames of the same mesh: the first has 3 vertices, the second 4")
    );
    text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\n");
    assert!(message("leaf-#.obj").contains("face 0 is 0 1 2 in the first, 0 2 1 in the second"));
    text("v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
    assert!(
        message("leaf-#.obj").starts_with("F/leaf-3.obj: line 3: "),
        "{}",
        message("leaf-#.obj")
    );
}
