//! What can be wrong with a file of queries.

use std::path::PathBuf;

/// Why a file of queries could not be read or converted.
///
/// Each message names the file, the line (counted from 1) and the column (counted from 1) where
/// there is one, and what to do about it.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum QueryError {
    /// The file could not be opened or read.
    #[error("{path}: cannot be read: {source}", path = path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// What the operating system said.
        source: std::io::Error,
    },
    /// The path is a folder.
    #[error("{path}: is a folder; name the CSV files inside it", path = path.display())]
    Directory {
        /// The folder.
        path: PathBuf,
    },
    /// Neither the caller nor the path says which kind of pairs the file holds.
    #[error(
        "{path}: cannot tell whether these are vertex-face or edge-edge queries, as neither the \
         folder's nor the file's name says so; pass --kind vertex-face or --kind edge-edge",
        path = path.display()
    )]
    UnknownKind {
        /// The file.
        path: PathBuf,
    },
    /// The file has no rows.
    #[error("{path}: has no rows; a query is 8 rows of 6 or 7 integers", path = path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
    /// A row has neither 6 nor 7 columns, or not as many as the first row.
    #[error(
        "{path}, line {line}: {found} columns instead of {expected} (numerator and denominator of \
         x, y and z, then the truth if it is known)",
        path = path.display()
    )]
    Columns {
        /// The file.
        path: PathBuf,
        /// The row's line.
        line: u64,
        /// How many columns the row has.
        found: usize,
        /// How many it should have.
        expected: &'static str,
    },
    /// A numerator or denominator is no decimal integer.
    #[error("{path}, line {line}, column {column}: '{text}' is no integer", path = path.display())]
    NotAnInteger {
        /// The file.
        path: PathBuf,
        /// The row's line.
        line: u64,
        /// The field's column.
        column: usize,
        /// The field, shortened.
        text: String,
    },
    /// A denominator is zero.
    #[error("{path}, line {line}, column {column}: the denominator is zero", path = path.display())]
    ZeroDenominator {
        /// The file.
        path: PathBuf,
        /// The row's line.
        line: u64,
        /// The denominator's column.
        column: usize,
    },
    /// A coordinate rounds to infinity.
    #[error(
        "{path}, line {line}, columns {column} and {next}: the coordinate is too large for f64; \
         scale the file's length unit",
        path = path.display(),
        next = column + 1
    )]
    OverflowsF64 {
        /// The file.
        path: PathBuf,
        /// The row's line.
        line: u64,
        /// The numerator's column.
        column: usize,
    },
    /// A truth is neither 0 nor 1.
    #[error(
        "{path}, line {line}, column 7: the truth '{text}' is neither 0 nor 1",
        path = path.display()
    )]
    Truth {
        /// The file.
        path: PathBuf,
        /// The row's line.
        line: u64,
        /// The field, shortened.
        text: String,
    },
    /// The eight rows of a query do not agree on the truth.
    #[error(
        "{path}, line {line}, column 7: the truth differs from that on line {first}, where the \
         query starts; the 8 rows of a query must agree",
        path = path.display()
    )]
    TruthDiffers {
        /// The file.
        path: PathBuf,
        /// The row's line.
        line: u64,
        /// The line on which the query starts.
        first: u64,
    },
    /// The file ends within a query.
    #[error(
        "{path}: {rows} rows are not a multiple of 8; the query that starts on line {line} is \
         incomplete, so the file may be truncated",
        path = path.display()
    )]
    IncompleteQuery {
        /// The file.
        path: PathBuf,
        /// How many rows it has.
        rows: usize,
        /// The line on which the incomplete query starts.
        line: u64,
    },
    /// A coordinate is representable in `f64` but rounds to infinity in `f32`.
    #[error(
        "{path}, query on line {line}: {coordinate} of {point} at t = {time} is {value:e}, too \
         large for f32; use --scalar f64",
        path = path.display()
    )]
    OverflowsF32 {
        /// The file.
        path: PathBuf,
        /// The line on which the query starts.
        line: u64,
        /// `x`, `y` or `z`.
        coordinate: &'static str,
        /// The point's name: `v`, `f0`, `f1`, `f2` of a vertex and a face, `a0`, `a1`, `b0`, `b1` of two edges.
        point: &'static str,
        /// 0 for the start of the step, 1 for its end.
        time: u8,
        /// The coordinate.
        value: f64,
    },
}
