use super::message;
use selvedge::Mesh;
use selvedge_files::animation;
use selvedge_files::mesh::{FileFormat, Findings, PlyEncoding, read_bytes, read_bytes_with_loose_features, write_bytes};

const FORMATS: [FileFormat; 4] = [
    FileFormat::Obj,
    FileFormat::Ply(PlyEncoding::Ascii),
    FileFormat::Ply(PlyEncoding::LittleEndian),
    FileFormat::Ply(PlyEncoding::BigEndian),
];

/// Reads OBJ files; see `check`.
pub fn obj(data: &[u8]) {
    check(data, FileFormat::Obj);
}

/// Reads PLY files, in the encoding that the bytes declare; see `check`.
pub fn ply(data: &[u8]) {
    check(data, FileFormat::Ply(PlyEncoding::default()));
}

/// Reads STL files, text or binary; see `check`.
pub fn stl(data: &[u8]) {
    check(data, FileFormat::Stl);
}

/// Reads OFF files; see `check`.
pub fn off(data: &[u8]) {
    check(data, FileFormat::Off);
}

/// Reads glTF, text or binary, without other files; see `check`. Its animation is read or refused as well.
pub fn gltf(data: &[u8]) {
    check(data, FileFormat::Gltf);
    match animation::read_bytes(data, "".as_ref(), &animation::Choice::default()) {
        Err(error) => message::check(&error.problem),
        Ok(figure) => {
            let mut positions = Vec::new();
            for time in figure.key_times() {
                figure.positions_at(time, &mut positions);
                assert_eq!(positions.len(), figure.mesh().positions.len());
            }
        }
    }
}

/// A file is refused with a readable message, or read as a mesh whose triangles exist and whose coordinates are finite. In any
/// format, a written mesh reads back bit for bit. The file is also read, or refused, with its loose edges and points.
fn check(data: &[u8], format: FileFormat) {
    match read_bytes_with_loose_features(data, format) {
        Ok(loose) => {
            assert!(!loose.topology.triangles().is_empty());
            assert!(loose.positions.iter().all(|position| position.is_finite()));
            let vertices = loose.topology.triangles().as_flattened();
            assert!(vertices.iter().all(|&vertex| (vertex as usize) < loose.positions.len()));
        }
        Err(problem) => message::check(&problem),
    }
    let file = match read_bytes(data, format) {
        Ok(file) => file,
        Err(problem) => return message::check(&problem),
    };
    let Mesh { positions, triangles } = &file.mesh;
    assert!(!triangles.is_empty());
    assert!(positions.iter().all(|position| position.is_finite()));
    let mut vertices = triangles.iter().flatten();
    assert!(vertices.all(|&vertex| (vertex as usize) < positions.len()));
    let polygons = file.notes.polygons_triangulated;
    assert!(polygons <= triangles.len(), "a polygon is one or more");

    message::check(&file.notes);
    let topology = file.mesh.topology().expect("it was read with one");
    message::check(&format!("findings: {}", Findings::of(positions, &topology)));
    for format in FORMATS {
        let written = write_bytes(&file.mesh, format).expect("what was read can be written");
        let again = read_bytes(&written, format).expect("what was written can be read");
        assert_eq!(again.mesh.triangles, *triangles, "{format:?}");
        assert_eq!(bits(&again.mesh), bits(&file.mesh), "{format:?}");
        assert_eq!(again.notes.statistics, file.notes.statistics, "{format:?}");
        assert_eq!(again.notes.polygons_triangulated, 0, "{format:?}");
    }
}

/// Returns the bits of the coordinates, so that the sign of zero counts.
fn bits(mesh: &Mesh) -> Vec<[u64; 3]> {
    let bits = |position: &selvedge::glam::DVec3| position.to_array().map(f64::to_bits);
    mesh.positions.iter().map(bits).collect()
}
