use selvedge::PairKind;
use std::{fs, path::PathBuf};

use proptest::prelude::*;
use tempfile::TempDir;

use super::*;
use selvedge_core::glam::DVec3;

const FACE: &str = "0,1,0,1,0,1\n1,1,0,1,0,1\n0,1,1,1,0,1\n";

/// A folder with one file in it; removed at the end of the test.
struct OnDisk {
    folder: TempDir,
    path: PathBuf,
}

fn on_disk(name: &str, text: impl AsRef<[u8]>) -> OnDisk {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::create_dir_all(path.parent().unwrap()).unwrap();
    fs::write(&path, text).unwrap();
    OnDisk { folder, path }
}

fn read_text(text: impl AsRef<[u8]>) -> Result<QueryFile, QueryError> {
    read(&on_disk("queries.csv", text).path, Some(PairKind::VertexFace))
}

/// One query of a vertex that falls through a triangle, without truth.
fn fall() -> String {
    format!("1,4,1,4,1,2\n{FACE}1,4,1,4,-1,2\n{FACE}")
}

/// The same with a truth for each row.
fn fall_with_truths(truths: [&str; 8]) -> String {
    fall()
        .lines()
        .zip(truths)
        .map(|(row, truth)| format!("{row},{truth}\n"))
        .collect()
}

/// The message of the error that `text` gives, which must name the file.
fn message(text: impl AsRef<[u8]>) -> String {
    let error = read_text(text).unwrap_err().to_string();
    assert!(error.contains("queries.csv"), "{error}");
    error
}

#[track_caller]
fn assert_names(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "'{part}' is missing in: {message}");
    }
}

#[test]
fn points_keep_the_order_of_their_rows() {
    let file = read_text(fall()).unwrap();
    let face = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let with_face = |v| [v, face[0], face[1], face[2]];
    assert_eq!(file.queries.len(), 1);
    assert_eq!(
        file.queries[0].pair.motions.map(|motion| motion.start),
        with_face(DVec3::new(0.25, 0.25, 0.5))
    );
    assert_eq!(
        file.queries[0].pair.motions.map(|motion| motion.end),
        with_face(DVec3::new(0.25, 0.25, -0.5))
    );
}

#[test]
fn the_truth_column_may_be_missing() {
    assert_eq!(read_text(fall()).unwrap().queries[0].collides, None);
    for (digit, truth) in [("0", false), ("1", true)] {
        let file = read_text(fall_with_truths([digit; 8])).unwrap();
        assert_eq!(file.queries[0].collides, Some(truth));
    }
}

#[test]
fn windows_line_ends_blank_lines_spaces_and_a_missing_last_line_end_change_nothing() {
    let expected = read_text(fall()).unwrap().queries;
    let text = fall().trim_end().replace(',', " ,\t").replace('\n', "\r\n");
    assert_eq!(read_text(text).unwrap().queries, expected);
    let text = fall().replace('\n', "\n\n \n\r\n");
    assert_eq!(read_text(text).unwrap().queries, expected);
}

#[test]
fn lines_are_counted_as_an_editor_counts_them() {
    for line_end in ["\n", "\r\n"] {
        let text = format!("\n\n{}\n{}\n\nbad,1,0,1,0,1", fall(), fall()).replace('\n', line_end);
        assert_names(&message(&text), &["line 22,"]);
        let good = text.rsplit_once("bad").unwrap().0;
        let lines = read_text(good)
            .unwrap()
            .queries
            .iter()
            .map(|query| query.line)
            .collect::<Vec<_>>();
        assert_eq!(lines, [3, 12]);
    }
}

#[test]
fn rounded_coordinates_are_counted() {
    assert_eq!(read_text(fall()).unwrap().inexact, 0);
    let text = fall().replacen("1,4,1,4,1,2", "1,3,1,10,1,2", 1);
    let file = read_text(text).unwrap();
    assert_eq!(file.inexact, 2);
    assert_eq!(file.queries[0].pair.motions[0].start, DVec3::new(1.0 / 3.0, 0.1, 0.5));
}

#[test]
fn the_folder_or_the_file_name_tells_the_kind() {
    for (name, kind) in [
        ("vertex-face/data.csv", PairKind::VertexFace),
        ("edge-edge/data.csv", PairKind::EdgeEdge),
        ("227vf.csv", PairKind::VertexFace),
        ("227ee.csv", PairKind::EdgeEdge),
        ("set_ee.csv", PairKind::EdgeEdge),
        ("edge-edge/227vf.csv", PairKind::EdgeEdge),
    ] {
        assert_eq!(read(&on_disk(name, fall()).path, None).unwrap().kind, kind, "{name}");
    }
}

#[test]
fn what_the_caller_says_outranks_the_path() {
    let file = on_disk("vertex-face/227vf.csv", fall());
    assert_eq!(read(&file.path, Some(PairKind::EdgeEdge)).unwrap().kind, PairKind::EdgeEdge);
}

#[test]
fn an_unknown_kind_says_to_pass_it() {
    for name in ["data.csv", "knee.csv", "vertex-face/deeper/data.csv"] {
        let error = read(&on_disk(name, fall()).path, None).unwrap_err().to_string();
        assert_names(&error, &[name.rsplit('/').next().unwrap(), "--kind"]);
    }
}

#[test]
fn a_kind_reads_back_as_it_is_written() {
    for kind in [PairKind::VertexFace, PairKind::EdgeEdge] {
        assert_eq!(kind.to_string().parse(), Ok(kind));
    }
    // Core, which has no strings to keep, leaves it to the caller to quote the text.
    assert_names(
        &"vf".parse::<PairKind>().unwrap_err().to_string(),
        &["vertex-face", "edge-edge"],
    );
}

#[test]
fn a_missing_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let error = read(&folder.path().join("gone-vf.csv"), None).unwrap_err();
    assert!(matches!(error, QueryError::Read { .. }));
    assert_names(&error.to_string(), &["gone-vf.csv"]);
}

#[test]
fn a_folder_is_no_file() {
    let file = on_disk("vertex-face/data.csv", fall());
    let error = read(&file.folder.path().join("vertex-face"), None).unwrap_err();
    assert!(matches!(error, QueryError::Directory { .. }), "{error}");
}

#[test]
fn a_file_without_rows_is_an_error() {
    for text in ["", "\n", "\r\n \n\n"] {
        assert!(matches!(read_text(text), Err(QueryError::Empty { .. })));
    }
}

#[test]
fn a_wrong_number_of_columns_is_named() {
    assert_names(&message("1,2,3\n"), &["line 1:", "3 columns", "6 or 7"]);
    let text = fall().replacen("1,1,0,1,0,1", "1,1,0,1,0,1,1", 1);
    assert_names(&message(text), &["line 3:", "7 columns", "instead of 6"]);
    let text = fall_with_truths(["1"; 8]).replacen("1,1,0,1,0,1,1", "1,1,0,1,0,1", 1);
    assert_names(&message(text), &["line 3:", "6 columns", "instead of 7"]);
}

#[test]
fn a_field_that_is_no_integer_is_named() {
    assert_names(&message("x0,x1,y0,y1,z0,z1\n"), &["line 1, column 1:", "'x0'"]);
    let text = fall().replacen("1,1,0,1,0,1", "1,1,0,1.5,0,1", 1);
    assert_names(&message(text), &["line 3, column 4:", "'1.5'"]);
    assert_names(&message(b"\xff\xfe,1,0,1,0,1\n"), &["line 1, column 1:"]);
    assert_names(&message("\"1\",1,0,1,0,1\n"), &["line 1, column 1:", "'\"1\"'"]);
}

#[test]
fn a_long_field_is_shortened_in_the_message() {
    let text = format!("{}x,1,0,1,0,1\n", "1".repeat(10_000));
    assert!(message(text).chars().count() < 200);
}

#[test]
fn a_zero_denominator_is_named() {
    let text = fall().replacen("1,1,0,1,0,1", "1,1,0,1,0,0", 1);
    assert_names(&message(text), &["line 3, column 6:", "denominator is zero"]);
}

#[test]
fn a_coordinate_beyond_double_precision_is_named() {
    let text = fall().replacen("1,1,0,1,0,1", &format!("1,1,-1{},1,0,1", "0".repeat(309)), 1);
    assert_names(&message(text), &["line 3, columns 3 and 4:", "too large for f64"]);
}

#[test]
fn an_incomplete_query_is_named() {
    let text = fall() + "0,1,0,1,0,1\n";
    assert_names(&message(text), &["9 rows", "multiple of 8", "line 9"]);
}

#[test]
fn a_truth_is_0_or_1() {
    let text = fall_with_truths(["1", "1", "2", "1", "1", "1", "1", "1"]);
    assert_names(&message(text), &["line 3, column 7:", "'2'"]);
}

#[test]
fn the_rows_of_a_query_agree_on_the_truth() {
    let text = fall_with_truths(["1"; 8]) + &fall_with_truths(["0", "0", "0", "0", "0", "1", "0", "0"]);
    assert_names(&message(text), &["line 14, column 7:", "line 9"]);
}

#[test]
fn single_precision_counts_what_it_rounds() {
    let third = 1.0_f64 / 3.0;
    let mut file = read_text(fall()).unwrap();
    assert_eq!(file.to_f32().unwrap().rounded, 0);
    file.queries[0].pair.motions[3].end = DVec3::new(third, 1e-300, 0.5);
    let single = file.to_f32().unwrap();
    assert_eq!(single.rounded, 2);
    assert_eq!(single.queries[0].pair.motions[3].end.to_array(), [third as f32, 0.0, 0.5]);
}

#[test]
fn a_coordinate_beyond_single_precision_is_named() {
    // The largest single is kept; half a unit in the last place above it is the tie that rounds
    // to infinity.
    let largest = f64::from(f32::MAX);
    let tie = largest + 2_f64.powi(127 - 24);
    let mut file = read_text(fall() + &fall()).unwrap();
    file.queries[1].pair.motions[2].end.y = -tie.next_down();
    assert_eq!(file.to_f32().unwrap().queries[1].pair.motions[2].end.y, f32::MIN);
    file.queries[1].pair.motions[2].end.y = -tie;
    let error = file.to_f32().unwrap_err().to_string();
    assert_names(
        &error,
        &["queries.csv", "line 9", "y of f1 at t = 1", "-3.40", "--scalar f64"],
    );
}

proptest! {
    #[test]
    fn any_bytes_are_queries_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        let _ = read_text(bytes);
    }

    #[test]
    fn a_damaged_field_is_refused_on_its_line_unless_it_is_still_a_number(
        row in 0..8_usize,
        column in 0..6_usize,
        damage in "[-+.\"_ e0-9]{0,4}",
    ) {
        let mut rows: Vec<Vec<String>> =
            fall().lines().map(|row| row.split(',').map(str::to_owned).collect()).collect();
        rows[row][column].clone_from(&damage);
        let text: String = rows.iter().map(|row| row.join(",") + "\n").collect();

        let is_denominator = column % 2 == 1;
        let usable = damage.trim().parse::<i64>().is_ok_and(|value| !is_denominator || value != 0);
        match read_text(text) {
            Ok(file) => {
                prop_assert!(usable);
                prop_assert_eq!(file.queries.len(), 1);
            }
            Err(error) => {
                prop_assert!(!usable);
                let place = format!("line {}, column {}:", row + 1, column + 1);
                prop_assert!(error.to_string().contains(&place), "{error}");
            }
        }
    }
}
