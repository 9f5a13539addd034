//! Every kind of file in `zoo/` is read or refused as `zoo/expected.txt` says. Damaged files never cause a panic, and every lost
//! face is reported.

mod nonsense;
mod random;

use random::Numbers;
use selvedge::CollisionDetector;
use selvedge_files::mesh::{FileFormat, Findings, LooseMesh, ReadOptions, read_bytes, read_bytes_with, write_bytes};
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/zoo")
}

/// A file's name, format, bytes and expected result.
struct Animal {
    name: String,
    format: FileFormat,
    bytes: Vec<u8>,
    /// The numbers of vertices, triangles, and intersections.
    counts: String,
    report: String,
}

fn animals() -> Vec<Animal> {
    let table = std::fs::read_to_string(folder().join("expected.txt")).unwrap();
    let rows = table.lines().filter(|line| !line.starts_with('#'));
    let animal = |row: &str| {
        let [name, counts, report] = row.splitn(3, " | ").collect::<Vec<_>>().try_into().expect(row);
        Animal {
            name: name.to_owned(),
            format: FileFormat::from_path(Path::new(name)).expect(name),
            bytes: std::fs::read(folder().join(name)).expect(name),
            counts: counts.to_owned(),
            report: report.to_owned(),
        }
    };
    let is_built = |animal: &Animal| cfg!(feature = "gltf") || animal.format != FileFormat::Gltf;
    rows.map(animal).filter(is_built).collect()
}

fn intersections(mesh: &LooseMesh) -> usize {
    let mut detector = CollisionDetector::<f64>::new(Arc::new(mesh.topology.clone()));
    let mut found = Vec::new();
    detector.intersections(&mesh.positions, &mut found).unwrap();
    found.len()
}

#[test]
fn every_file_is_read_or_refused_as_expected() {
    let animals = animals();
    for entry in std::fs::read_dir(folder()).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        let is_listed = animals.iter().any(|animal| animal.name == name);
        assert!(
            is_listed || !cfg!(feature = "gltf") || name == "expected.txt",
            "{name} has no line in expected.txt"
        );
    }
    let mut wrong = Vec::new();
    for Animal {
        name,
        format,
        bytes,
        counts,
        report,
    } in animals
    {
        let (found, said) = match read_bytes_with(&bytes, format, &ReadOptions::default()) {
            Err(problem) => ("refused".to_owned(), problem.to_string()),
            Ok(mesh) => {
                let crossings = match intersections(&mesh) {
                    0 => "0".to_owned(),
                    _ if counts.ends_with('?') => "?".to_owned(),
                    count => count.to_string(),
                };
                let [vertices, triangles] = [mesh.positions.len(), mesh.topology.triangles().len()];
                let findings = Findings::of(&mesh.positions, &mesh.topology);
                (
                    format!("{vertices} {triangles} {crossings}"),
                    format!("{}, {findings}", mesh.notes),
                )
            }
        };
        if found != counts || report != "-" && !said.contains(&report) {
            wrong.push(format!("{name}: expected {counts} | {report}, but found {found} | {said}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn nonsense_is_refused_with_the_place_and_what_was_found() {
    let folder = tempfile::tempdir().unwrap();
    for (name, content, message) in nonsense::nonsense() {
        let path = folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        let error = selvedge_files::mesh::read(&path).unwrap_err().to_string();
        assert_eq!(error, format!("{}: {message}", path.display()));
    }
}

#[test]
fn what_is_read_written_and_read_again_is_the_same_mesh() {
    use selvedge_files::mesh::PlyEncoding::{Ascii, BigEndian, LittleEndian};
    for animal in animals() {
        let Ok(file) = read_bytes(&animal.bytes, animal.format) else {
            continue;
        };
        for format in [
            FileFormat::Obj,
            FileFormat::Ply(Ascii),
            FileFormat::Ply(LittleEndian),
            FileFormat::Ply(BigEndian),
        ] {
            let written = write_bytes(&file.mesh, format).unwrap();
            assert_eq!(
                read_bytes(&written, format).unwrap().mesh,
                file.mesh,
                "{} as {format:?}",
                animal.name
            );
        }
    }
}

/// The number of times that each file is damaged: more than a hundred thousand in all.
const DAMAGED: usize = 500;

/// Changes bytes, drops or doubles a line, or cuts the end off.
fn damage(bytes: &[u8], numbers: &mut Numbers) -> Vec<u8> {
    let mut damaged = bytes.to_vec();
    for _ in 0..=numbers.below(3) {
        if damaged.is_empty() {
            break;
        }
        let place = numbers.below(damaged.len());
        match numbers.below(6) {
            0 => damaged[place] ^= 1 << numbers.below(8),
            1 => damaged[place] = b" \n\r\\#0-.~\xff"[numbers.below(10)],
            2 => damaged.truncate(place),
            3 => drop(damaged.remove(place)),
            drop_or_double => {
                let end = damaged[place..]
                    .iter()
                    .position(|&byte| byte == b'\n')
                    .map_or(damaged.len(), |end| place + end + 1);
                let begin = damaged[..place]
                    .iter()
                    .rposition(|&byte| byte == b'\n')
                    .map_or(0, |begin| begin + 1);
                if drop_or_double == 4 {
                    damaged.drain(begin..end);
                } else {
                    let line = damaged[begin..end].to_vec();
                    damaged.splice(begin..begin, line);
                }
            }
        }
    }
    damaged
}

/// The least number of faces, edges and points that were read of a file, counted in another way than the readers count: by lines,
/// and by the size of binary STL. `None`: they are not counted.
fn least_count(bytes: &[u8], format: FileFormat, mesh: &LooseMesh) -> Option<usize> {
    let has_facets = || bytes.windows(5).any(|word| word.eq_ignore_ascii_case(b"facet"));
    if format == FileFormat::Stl && !has_facets() {
        let triangles = bytes.get(84..)?.chunks_exact(50);
        return Some(triangles.filter(|triangle| triangle.iter().any(|&byte| byte != 0)).count());
    }
    let text = std::str::from_utf8(bytes).ok()?;
    let lines = || {
        text.split(['\n', '\r'])
            .map(|line| line.split('#').next().unwrap_or_default().trim())
    };
    let count = |names: &[&str]| {
        lines()
            .filter(|line| names.iter().any(|name| starts_with_word(line.as_bytes(), name)))
            .count()
    };
    let left_out: usize = mesh.notes.left_out.iter().map(|part| part.count).sum();
    let besides = mesh.positions.len() + left_out;
    match format {
        FileFormat::Obj if !text.contains('\\') => Some(count(&["f", "fo"])),
        FileFormat::Stl if !text.contains('\0') => {
            let words = lines().flat_map(str::split_ascii_whitespace);
            Some(words.filter(|word| word.eq_ignore_ascii_case("endloop")).count())
        }
        FileFormat::Off => {
            // A face that is not read is reported, or its words follow the last one, which is reported as well.
            let content: String = lines().map(|line| format!("{line} ")).collect();
            let counts = content
                .trim_start_matches('\u{feff}')
                .trim_start()
                .trim_start_matches(|c: char| c.is_ascii_alphabetic());
            let faces: usize = counts.split_ascii_whitespace().nth(1)?.parse().ok()?;
            faces.checked_sub(left_out)
        }
        FileFormat::Ply(_) if text.contains("format ascii") && !text.contains("tristrips") && !text.contains('\0') => {
            let body = text.split_once("end_header")?.1.split(['\n', '\r']);
            body.filter(|line| !line.trim().is_empty()).count().checked_sub(besides)
        }
        FileFormat::Gltf => {
            let root: serde_json::Value = serde_json::from_str(text.trim_start_matches('\u{feff}')).ok()?;
            let primitives = root["meshes"][root["nodes"][0]["mesh"].as_u64()? as usize]["primitives"].as_array()?;
            let of_lists = primitives
                .iter()
                .filter(|primitive| primitive["mode"].as_u64().unwrap_or(4) == 4);
            let corners = |primitive: &serde_json::Value| {
                let accessor = primitive
                    .get("indices")
                    .unwrap_or(&primitive["attributes"]["POSITION"])
                    .as_u64()?;
                root["accessors"][accessor as usize]["count"].as_u64()
            };
            let is_one = root["nodes"].as_array()?.len() == 1;
            let counted: Option<u64> = of_lists.map(|primitive| Some(corners(primitive)? / 3)).sum();
            counted.filter(|_| is_one).map(|count| count as usize)
        }
        _ => None,
    }
}

/// Returns whether a word stands at the begin of a line, in capitals or not.
fn starts_with_word(text: &[u8], name: &str) -> bool {
    let lines = text.split(|byte| b"\n\r".contains(byte));
    let mut words = lines.filter_map(|line| line.split(u8::is_ascii_whitespace).find(|word| !word.is_empty()));
    words.any(|word| word.eq_ignore_ascii_case(name.as_bytes()))
}

/// The largest memory that a reader may hold at a time, for each byte of its file, and for small files.
const MEMORY: [usize; 2] = [200, 65_536];

#[test]
fn damaged_files_end_in_a_mesh_or_a_message_with_little_memory_and_no_lost_face_goes_unnoticed() {
    let (mut numbers, mut counted) = (Numbers(51), 0);
    for animal in animals() {
        for _ in 0..DAMAGED {
            let damaged = damage(&animal.bytes, &mut numbers);
            let options = ReadOptions {
                loose_features: numbers.below(2) == 0,
                ..ReadOptions::default()
            };
            let mut read = None;
            let memory = allocation_counter::measure(|| read = read_bytes_with(&damaged, animal.format, &options).ok());
            let limit = MEMORY[0] * damaged.len() + MEMORY[1];
            let text = || String::from_utf8_lossy(&damaged).into_owned();
            assert!(
                memory.bytes_max <= limit as u64,
                "{}: {} bytes of memory for\n{}",
                animal.name,
                memory.bytes_max,
                text()
            );
            let Some(mesh) = read else { continue };
            assert!(mesh.positions.iter().all(|position| position.is_finite()));
            if !mesh.notes.is_complete() || mesh.notes.polygons_triangulated > 0 {
                continue;
            }
            if let Some(least) = least_count(&damaged, animal.format, &mesh) {
                counted += 1;
                let read = mesh.topology.triangles().len();
                assert!(read >= least, "{}: {read} of {least} faces of\n{}", animal.name, text());
            }
        }
    }
    assert!(counted > 4_000, "{counted}");
}

/// A file with only one kind of line takes memory in proportion to its size, and a time that does not grow faster.
#[test]
fn large_files_are_read_in_proportion() {
    let wheel: String = (0..20_000).map(|k| format!(" {}", k % 9_000 + 1)).collect();
    let vertices: String = (0..9_000)
        .map(|k| format!("v {} {} 0\n", k * 7 % 9_001, k * k % 9_001))
        .collect();
    let begin = std::time::Instant::now();
    for text in [
        format!("{vertices}f{wheel}\n"),
        format!("{vertices}f{}\n", &wheel[..40_000]),
        "f 1 2 3\n".repeat(100_000) + "v 0 0 0\nv 1 0 0\nv 0 1 0\n",
        (0..100_000).map(|k| format!("word{k} 1\n")).collect::<String>() + "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    ] {
        let memory = allocation_counter::measure(|| drop(read_bytes(text.as_bytes(), FileFormat::Obj).unwrap()));
        assert!(
            memory.bytes_max < (MEMORY[0] * text.len()) as u64,
            "{} of {}",
            memory.bytes_max,
            text.len()
        );
    }
    assert!(begin.elapsed().as_secs() < 60, "{:?}", begin.elapsed());
}
