//! Each text format is read whole, however its words are divided into lines. A stray word never makes a face disappear unnoticed.
//!
//! `SELVEDGE_FILES=100000 cargo test --release -p selvedge-files --features gltf --test whole` writes that many files of each
//! format.

mod random;
mod writers;

use random::Numbers;
use selvedge_files::mesh::{FileFormat, ReadOptions, read_bytes_with};
use writers::{Drawn, FORMATS, Format};

/// The words that a stray one is drawn from: keywords of all formats, numbers, and what is neither.
const STRAY: [&str; 41] = [
    "0",
    "1",
    "3",
    "4",
    "-1",
    "7",
    "0.5",
    "1e3",
    "nan",
    "x",
    "\"x\"",
    "{",
    "}",
    "[",
    ",",
    ":",
    "1/1",
    "\\",
    "f",
    "fo",
    "v",
    "vn",
    "vt",
    "l",
    "p",
    "g",
    "o",
    "s",
    "usemtl",
    "solid",
    "facet",
    "normal",
    "outer",
    "loop",
    "vertex",
    "endloop",
    "endfacet",
    "endsolid",
    "color",
    "comment",
    "end_header",
];

fn files() -> usize {
    let wanted = std::env::var("SELVEDGE_FILES").ok();
    wanted.map_or(2_000, |count| count.parse().expect("SELVEDGE_FILES is a number"))
}

/// Returns the corners of each triangle, if the file was read and its report says that nothing with an area is missing.
fn read(bytes: &[u8], format: FileFormat) -> Option<Vec<[[f64; 3]; 3]>> {
    let mesh = read_bytes_with(bytes, format, &ReadOptions::default()).ok()?;
    let corners = |corners: &[u32; 3]| corners.map(|vertex| mesh.positions[vertex as usize].to_array());
    mesh.notes
        .is_complete()
        .then(|| mesh.topology.triangles().iter().map(corners).collect())
}

fn all_files(mut test: impl FnMut(Format, Drawn, &mut Numbers)) {
    for (seed, format) in (62..).zip(FORMATS) {
        let mut numbers = Numbers(seed);
        for _ in 0..files() {
            let drawn = (format.write)(&mut numbers);
            test(*format, drawn, &mut numbers);
        }
    }
}

#[test]
fn a_valid_file_with_free_white_space_and_line_ends_is_read_whole() {
    all_files(|format, drawn, numbers| {
        let bytes = drawn.file(numbers, None);
        let problem = || {
            let read = read_bytes_with(&bytes, format.format, &ReadOptions::default());
            (
                read.err().map(|problem| problem.to_string()),
                String::from_utf8_lossy(&bytes).into_owned(),
            )
        };
        let read = read(&bytes, format.format).unwrap_or_else(|| panic!("{:?}", problem()));
        assert_eq!(read, drawn.triangles, "{:?}", problem());
    });
}

#[test]
fn a_stray_word_never_makes_a_face_disappear_unnoticed() {
    let mut refused = 0;
    all_files(|format, drawn, numbers| {
        let word = numbers.pick(&STRAY);
        let place = numbers.below(drawn.words.len() + 1);
        let bytes = drawn.file(numbers, Some((place, word)));
        match read(&bytes, format.format) {
            None => refused += 1,
            Some(read) => assert!(
                read.len() >= drawn.triangles.len(),
                "{} of {} faces with '{word}':\n{}",
                read.len(),
                drawn.triangles.len(),
                String::from_utf8_lossy(&bytes)
            ),
        }
    });
    assert!(refused > FORMATS.len() * files() / 2, "{refused}");
}
