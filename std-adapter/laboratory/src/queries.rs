//! Reads primitive-pair queries in the rational CSV format of the public continuous collision detection benchmark (Wang,
//! Ferguson, Schneider, Jiang, Attene, Panozzo: A Large-scale Benchmark and an Inclusion-based Algorithm for Continuous Collision
//! Detection, 2021).
//!
//! A query is one vertex–face or edge–edge pair that moves linearly over the step. It takes eight rows: its four points at the
//! start of the step, then the same four at the end. A row has numerator and denominator of x, y and z. If the verdict is known,
//! a further column has the truth, the same on all eight rows: 1 if the pair collides within the step, else 0. Numerators and
//! denominators are integers of any length. There is no header; blank lines are skipped.
//!
//! ```
//! use selvedge::PairKind;
//! use selvedge_laboratory::queries::read_from;
//! // A vertex falls from z = 1/2 to z = -1/2 through a resting triangle.
//! let face = "0,1,0,1,0,1,1\n1,1,0,1,0,1,1\n0,1,1,1,0,1,1\n";
//! let rows = format!("1,4,1,4,1,2,1\n{face}1,4,1,4,-1,2,1\n{face}");
//! let file = read_from(rows.as_bytes(), "fall".as_ref(), PairKind::VertexFace)?;
//! let vertex = file.queries[0].pair.motions[0];
//! assert_eq!((vertex.start.z, vertex.end.z), (0.5, -0.5));
//! assert_eq!((file.queries[0].collides, file.inexact), (Some(true), 0));
//! # Ok::<(), selvedge_laboratory::queries::QueryError>(())
//! ```

use dashu_int::IBig;
use dashu_ratio::RBig;
use selvedge::PairKind;
use selvedge_core::glam::DVec3;
use selvedge_core::{Motion, PrimitivePair, Scalar};
use selvedge_files::excerpt::excerpt;
use std::fmt::Display;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The reason why a file of queries could not be read or converted. The message names the file, the line and the column if there
/// are any, and the remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct QueryError(String);

/// A primitive pair that moves linearly over the step, and whether it collides. Positions are in the file's length unit and
/// finite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Query<S: Scalar = f64> {
    /// The pair: `v, f0, f1, f2` or `a0, a1, b0, b1`.
    pub pair: PrimitivePair<S>,
    /// True if the primitives touch at some time in [0, 1]; `None` if the file does not say.
    pub collides: Option<bool>,
    /// The line of the file on which the query starts, counted from 1.
    pub line: usize,
}

/// The queries of one file, in double precision.
#[derive(Debug, Clone, PartialEq)]
pub struct QueryFile {
    /// The kind of all pairs in the file.
    pub kind: PairKind,
    /// The queries, in the order of the file; at least one.
    pub queries: Vec<Query>,
    /// The path that was read, as given.
    pub path: PathBuf,
    /// The number of coordinates that `f64` does not hold exactly. They are rounded to the nearest; the truth may not hold for
    /// them.
    pub inexact: usize,
}

/// The queries of one file, rounded to single precision.
#[derive(Debug, Clone, PartialEq)]
pub struct SinglePrecision {
    /// The queries, in the order of the file.
    pub queries: Vec<Query<f32>>,
    /// The number of coordinates that changed in the conversion from `f64`. The truth may not hold for them.
    pub rounded: usize,
}

/// The number of rows of a query: four points at the start of the step, four at its end.
const ROWS: usize = 8;

/// Returns the kind that a path names, or `None`.
///
/// The file's folder decides if its name is `vertex-face` or `edge-edge`, as in the benchmark. Otherwise a file name decides that
/// ends in `vf` or `ee` before its extension, if no letter comes before these (`227vf.csv`, but not `knee.csv`).
pub fn kind_of_path(path: &Path) -> Option<PairKind> {
    // The path is made absolute so that `data.csv` inside `vertex-face` is recognised from there.
    let absolute = std::path::absolute(path);
    let folder = absolute.as_deref().unwrap_or(path).parent();
    let folder = folder.and_then(Path::file_name).and_then(|name| name.to_str());
    let stem = path.file_stem()?.to_str()?;
    let ends_in = |suffix| {
        let rest = stem.strip_suffix(suffix);
        rest.is_some_and(|rest| !rest.ends_with(char::is_alphabetic))
    };
    let of_stem = || match (ends_in("vf"), ends_in("ee")) {
        (true, _) => Some(PairKind::VertexFace),
        (_, true) => Some(PairKind::EdgeEdge),
        _ => None,
    };
    folder.and_then(|name| name.parse().ok()).or_else(of_stem)
}

/// Reads all queries of the file at `path`. Without a `kind` the path names it, see [`kind_of_path`]. Every coordinate becomes
/// the nearest `f64`, ties to even.
///
/// # Errors
/// Returns an error if the file is missing, a folder, unreadable, empty or of unknown kind, or the last query is incomplete. A
/// row must have the right number of columns and only integers, no denominator of zero, and no coordinate beyond `f64`. A truth
/// is 0 or 1, and the same within a query.
pub fn read(path: &Path, kind: Option<PairKind>) -> Result<QueryFile, QueryError> {
    let at = |message: &dyn Display| QueryError(format!("{}: {message}", path.display()));
    if path.is_dir() {
        return Err(at(&"is a folder; name the CSV files inside it"));
    }
    let source = std::fs::File::open(path).map_err(|error| at(&format_args!("cannot be read: {error}")))?;
    let kind = kind.or_else(|| kind_of_path(path)).ok_or_else(|| {
        at(
            &"neither the folder's nor the file's name says whether these are vertex-face or edge-edge queries; \
             pass --kind vertex-face or --kind edge-edge",
        )
    })?;
    read_from(source, path, kind)
}

/// Reads all queries from `source`, which has the content of a file. Messages and [`QueryFile::path`] call it `path`.
///
/// # Errors
/// Returns the errors of [`read`] that concern the content.
pub fn read_from(mut source: impl Read, path: &Path, kind: PairKind) -> Result<QueryFile, QueryError> {
    let at = |message: &dyn Display| QueryError(format!("{}{message}", path.display()));
    let mut bytes = Vec::new();
    let read = source.read_to_end(&mut bytes);
    read.map_err(|error| at(&format_args!(": cannot be read: {error}")))?;
    // A character that is not UTF-8 is no digit, and is refused with its place.
    let text = String::from_utf8_lossy(&bytes);
    let mut file = QueryFile {
        kind,
        queries: Vec::new(),
        path: path.to_owned(),
        inexact: 0,
    };
    let mut rows: Vec<(usize, QueryPoint)> = Vec::with_capacity(ROWS);
    let mut columns = None;
    let lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim().is_empty());
    for (line, text) in lines {
        let row = QueryPoint::parse(text, &mut columns).map_err(|error| at(&format_args!(", line {line}{error}")))?;
        file.inexact += row.inexact;
        if let Some((first, _)) = rows.first().filter(|(_, first)| first.truth != row.truth) {
            let reason = format!("the truth differs from that on line {first}, where the query starts; the 8 rows must agree");
            return Err(at(&format_args!(", line {line}, column 7: {reason}")));
        }
        rows.push((line, row));
        if let [(line, first), ..] = &rows[..]
            && rows.len() == ROWS
        {
            let motions = [0, 1, 2, 3].map(|k| Motion::new(rows[k].1.point, rows[k + 4].1.point));
            file.queries.push(Query {
                pair: PrimitivePair { kind, motions },
                collides: first.truth,
                line: *line,
            });
            rows.clear();
        }
    }
    if let Some((line, _)) = rows.first() {
        let count = ROWS * file.queries.len() + rows.len();
        let reason = format!("the query that starts on line {line} is incomplete, so the file may be truncated");
        return Err(at(&format_args!(": {count} rows are not a multiple of 8; {reason}")));
    }
    if file.queries.is_empty() {
        return Err(at(&": has no rows; a query is 8 rows of 6 or 7 integers"));
    }
    Ok(file)
}

/// One point of a query.
struct QueryPoint {
    point: DVec3,
    inexact: usize,
    truth: Option<bool>,
}

impl QueryPoint {
    /// Reads a row, which must have as many columns as the first. Errors begin with the place in the row.
    fn parse(text: &str, columns: &mut Option<usize>) -> Result<Self, String> {
        let fields: Vec<&str> = text.split(',').map(str::trim).collect();
        let expected = match *columns {
            None if matches!(fields.len(), 6 | 7) => String::new(),
            None => "6 or 7".to_owned(),
            Some(count) if count == fields.len() => String::new(),
            Some(count) => format!("{count} as before"),
        };
        if !expected.is_empty() {
            let meaning = "numerator and denominator of x, y and z, then the truth if it is known";
            return Err(format!(": {} columns instead of {expected} ({meaning})", fields.len()));
        }
        *columns = Some(fields.len());
        let mut row = Self {
            point: DVec3::ZERO,
            inexact: 0,
            truth: None,
        };
        for axis in 0..3 {
            let at = 2 * axis;
            let (value, is_exact) =
                rounded(fields[at], fields[at + 1]).map_err(|(next, reason)| format!(", column {}: {reason}", at + next + 1))?;
            if value.is_infinite() {
                let reason = "the coordinate is too large for f64; scale the file's length unit";
                return Err(format!(", columns {} and {}: {reason}", at + 1, at + 2));
            }
            row.point[axis] = value;
            row.inexact += usize::from(!is_exact);
        }
        row.truth = match fields.get(6) {
            None => None,
            Some(&"0") => Some(false),
            Some(&"1") => Some(true),
            Some(other) => return Err(format!(", column 7: the truth '{}' is neither 0 nor 1", excerpt(other, 24))),
        };
        Ok(row)
    }
}

/// Rounds a ratio of two decimal integers to the nearest `f64`, ties to even. Also returns whether that is exact. Zero is +0. An
/// error is the number of the field and the reason.
fn rounded(numerator: &str, denominator: &str) -> Result<(f64, bool), (usize, String)> {
    let fields = [numerator, denominator];
    for (index, field) in fields.iter().enumerate() {
        let digits = field.strip_prefix(['-', '+']).unwrap_or(field);
        // The library's parser takes digit separators too, which the format does not have.
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err((index, format!("'{}' is no integer", excerpt(field, 24))));
        }
    }
    // Large integers are not needed here: a numerator that f64 holds exactly, over a power of two of at most 2^63, is an exact
    // quotient.
    if let (Ok(num), Ok(den)) = (numerator.parse::<i64>(), denominator.parse::<u64>())
        && num.unsigned_abs() <= 1 << f64::MANTISSA_DIGITS
        && den.is_power_of_two()
    {
        return Ok((num as f64 / den as f64, true));
    }
    let [num, den] = fields.map(|field| field.parse::<IBig>().expect("a sign and digits are an integer"));
    if den.is_zero() {
        return Err((1, "the denominator is zero".to_owned()));
    }
    // `to_f64`, unlike `to_f64_fast`, promises correct rounding. A negative ratio that underflows would become -0.
    let (value, is_exact) = RBig::from_parts_signed(num, den).to_f64().value_with_exact();
    Ok((value + 0.0, is_exact))
}

impl QueryFile {
    /// Rounds every coordinate to the nearest `f32`, ties to even. Underflow counts as rounding.
    ///
    /// # Errors
    /// Returns an error if a coordinate rounds to infinity.
    pub fn to_f32(&self) -> Result<SinglePrecision, QueryError> {
        let mut rounded = 0;
        let mut queries = Vec::with_capacity(self.queries.len());
        for query in &self.queries {
            let mut motions = [Motion::<f32>::default(); 4];
            for (k, (wide, narrow)) in query.pair.motions.iter().zip(&mut motions).enumerate() {
                *narrow = Motion::new(wide.start.as_vec3(), wide.end.as_vec3());
                for (time, wide, narrow) in [(0, wide.start, narrow.start), (1, wide.end, narrow.end)] {
                    if let Some(axis) = (0..3).find(|&axis| !narrow[axis].is_finite()) {
                        let point = match self.kind {
                            PairKind::VertexFace => ["v", "f0", "f1", "f2"][k],
                            PairKind::EdgeEdge => ["a0", "a1", "b0", "b1"][k],
                        };
                        return Err(QueryError(format!(
                            "{}, query on line {}: {} of {point} at t = {time} is {:e}, too large for f32; use --scalar f64",
                            self.path.display(),
                            query.line,
                            ["x", "y", "z"][axis],
                            wide[axis],
                        )));
                    }
                    rounded += narrow.as_dvec3().cmpne(wide).bitmask().count_ones() as usize;
                }
            }
            queries.push(Query {
                pair: PrimitivePair::new(query.pair.kind, motions),
                collides: query.collides,
                line: query.line,
            });
        }
        Ok(SinglePrecision { queries, rounded })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const FACE: &str = "0,1,0,1,0,1\n1,1,0,1,0,1\n0,1,1,1,0,1\n";

    fn read_text(text: impl AsRef<[u8]>) -> Result<QueryFile, QueryError> {
        read_from(text.as_ref(), Path::new("queries.csv"), PairKind::VertexFace)
    }

    /// Writes one query of a vertex that falls through a triangle, without truth.
    fn fall() -> String {
        format!("1,4,1,4,1,2\n{FACE}1,4,1,4,-1,2\n{FACE}")
    }

    /// Writes the same query with a truth for each row.
    fn fall_with_truths(truths: [&str; 8]) -> String {
        let rows = fall();
        let rows = rows.lines().zip(truths);
        rows.map(|(row, truth)| format!("{row},{truth}\n")).collect()
    }

    #[test]
    fn points_and_truth_are_those_of_the_rows() {
        let file = read_text(fall()).unwrap();
        let [query] = file.queries[..] else { panic!("one query") };
        let face = [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting);
        let vertex = Motion::new(DVec3::new(0.25, 0.25, 0.5), DVec3::new(0.25, 0.25, -0.5));
        assert_eq!(query.pair, PrimitivePair::vertex_face(vertex, face));
        assert_eq!((query.collides, query.line, file.inexact), (None, 1, 0));
        for (digit, truth) in [("0", false), ("1", true)] {
            let file = read_text(fall_with_truths([digit; 8])).unwrap();
            assert_eq!(file.queries[0].collides, Some(truth));
        }
    }

    #[test]
    fn line_ends_blank_lines_and_spaces_change_nothing_but_lines_which_count_as_in_an_editor() {
        let expected = read_text(fall()).unwrap().queries;
        let text = fall().trim_end().replace(',', " ,\t").replace('\n', "\r\n");
        assert_eq!(read_text(text).unwrap().queries, expected);
        let text = format!("\n \r\n{}\n{}", fall(), fall());
        let lines: Vec<_> = read_text(text).unwrap().queries.iter().map(|query| query.line).collect();
        assert_eq!(lines, [3, 12]);
    }

    #[test]
    fn the_path_names_the_kind() {
        for (name, kind) in [
            ("vertex-face/data.csv", Some(PairKind::VertexFace)),
            ("edge-edge/227vf.csv", Some(PairKind::EdgeEdge)),
            ("227vf.csv", Some(PairKind::VertexFace)),
            ("set_ee.csv", Some(PairKind::EdgeEdge)),
            ("data.csv", None),
            ("knee.csv", None),
            ("vertex-face/deeper/data.csv", None),
        ] {
            assert_eq!(kind_of_path(Path::new(name)), kind, "{name}");
        }
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        let damaged = |field: &str| fall().replacen("1,1,0,1,0,1", field, 1);
        let huge = format!("1,1,-1{},1,0,1", "0".repeat(309));
        let truths = |row: &str| fall_with_truths(["1"; 8]) + &fall_with_truths(["0", "0", "0", "0", "0", row, "0", "0"]);
        for (text, place) in [
            ("\n".to_owned(), ": has no rows"),
            ("1,2,3\n".to_owned(), ", line 1: 3 columns instead of 6 or 7"),
            (damaged("1,1,0,1,0,1,1"), ", line 3: 7 columns instead of 6 as before"),
            (damaged("1,1,0,1.5,0,1"), ", line 3, column 4: '1.5' is no integer"),
            (damaged("\"1\",1,0,1,0,1"), ", line 3, column 1: '\"1\"' is no integer"),
            (damaged("1,1,0,1_0,0,1"), ", line 3, column 4: '1_0'"),
            (damaged("1,1,0,1,0,-0"), ", line 3, column 6: the denominator is zero"),
            (
                damaged(&huge),
                ", line 3, columns 3 and 4: the coordinate is too large for f64",
            ),
            (truths("2"), ", line 14, column 7: the truth '2' is neither"),
            (truths("1"), ", line 14, column 7: the truth differs from that on line 9"),
            (
                fall() + "0,1,0,1,0,1\n",
                ": 9 rows are not a multiple of 8; the query that starts on line 9",
            ),
        ] {
            let error = read_text(text).unwrap_err().to_string();
            assert!(error.starts_with(&format!("queries.csv{place}")), "{error}");
        }
        let long = format!("{}x,1,0,1,0,1\n", "1".repeat(10_000));
        assert!(read_text(long).unwrap_err().to_string().len() < 200);
        assert!(read_text(b"\xff\xfe,1,0,1,0,1\n").is_err());
    }

    #[test]
    fn ratios_are_rounded_to_the_nearest_double_and_zero_is_positive() {
        let text = fall().replacen("1,4,1,4,1,2", "1,3,1,10,+6,-4", 1);
        let file = read_text(text).unwrap();
        assert_eq!(file.inexact, 2);
        assert_eq!(file.queries[0].pair.motions[0].start, DVec3::new(1.0 / 3.0, 0.1, -1.5));
        let tiny = format!("1{}", "0".repeat(400));
        for (numerator, denominator) in [("-1", tiny.as_str()), ("0", "-1"), ("-0", &tiny)] {
            let (value, is_exact) = rounded(numerator, denominator).unwrap();
            assert_eq!((value.to_bits(), is_exact), (0, numerator != "-1"));
        }
    }

    #[test]
    fn single_precision_counts_what_it_rounds_and_names_what_it_cannot_hold() {
        let mut file = read_text(fall() + &fall()).unwrap();
        assert_eq!(file.to_f32().unwrap().rounded, 0);
        file.queries[0].pair.motions[3].end = DVec3::new(0.1, 1e-300, 0.5);
        let single = file.to_f32().unwrap();
        assert_eq!(single.rounded, 2);
        assert_eq!(single.queries[0].pair.motions[3].end.to_array(), [0.1, 0.0, 0.5]);
        // Half a unit in the last place above the largest single is the tie that rounds to infinity.
        let tie = f64::from(f32::MAX) + 2_f64.powi(127 - 24);
        file.queries[1].pair.motions[2].end.y = -tie.next_down();
        assert_eq!(file.to_f32().unwrap().queries[1].pair.motions[2].end.y, f32::MIN);
        file.queries[1].pair.motions[2].end.y = -tie;
        let error = file.to_f32().unwrap_err().to_string();
        let place = "queries.csv, query on line 9: y of f1 at t = 1 is -3.40";
        assert!(error.starts_with(place) && error.contains("--scalar f64"), "{error}");
    }

    proptest! {
        /// `tests/methods/queries_are_read_to_the_nearest.rs` compares ratios of all sizes with another exact arithmetic.
        #[test]
        fn every_double_comes_back_from_its_own_ratio(bits in any::<u64>(), scale in 1..u64::MAX) {
            let value = f64::from_bits(bits);
            prop_assume!(value.is_finite());
            let exact = RBig::try_from(value).unwrap();
            // A common factor, or a sign below the line, does not change it.
            let scale = -IBig::from(scale);
            let (num, den) = (exact.numerator() * &scale, IBig::from(exact.denominator().clone()) * &scale);
            prop_assert_eq!(rounded(&num.to_string(), &den.to_string()), Ok((value + 0.0, true)));
        }
    }
}
