//! From a file to queries.

use std::{fs::File, io::Read, path::Path};

use csv::{ByteRecord, ReaderBuilder, Terminator, Trim};
use selvedge_core::glam::DVec3;
use selvedge_core::{Motion, PrimitivePair};

use super::kind::kind_of_path;
use super::{
    Query, QueryError, QueryFile,
    rational::{self, RatioError},
};
use selvedge::PairKind;
use selvedge_files::excerpt::excerpt;

/// Rows of a query: four points at the start of the step, four at its end.
const ROWS: usize = 8;
/// Numerator and denominator of x, y and z; the truth, if any, comes after them.
const COORDINATE_COLUMNS: usize = 6;

/// Reads all queries of the file at `path`.
///
/// `kind` says which kind of pairs the file holds; if it is `None`, the path has to
/// ([`kind_of_path`]). Every coordinate becomes the nearest `f64`, ties to even;
/// [`QueryFile::inexact`] counts those for which that is not the value itself.
///
/// # Errors
///
/// A [`QueryError`] that names the file and, where there is one, the line: the file is missing,
/// a folder, unreadable, empty or of unknown kind; a row has the wrong number of columns, a field
/// that is no integer, a denominator of zero or a coordinate beyond `f64`; a truth is not 0 or 1 or
/// differs within a query; or the last query is incomplete.
pub fn read(path: &Path, kind: Option<PairKind>) -> Result<QueryFile, QueryError> {
    let unreadable = |source| QueryError::Read {
        path: path.to_owned(),
        source,
    };
    if path.is_dir() {
        return Err(QueryError::Directory { path: path.to_owned() });
    }
    let source = File::open(path).map_err(unreadable)?;
    let kind = kind
        .or_else(|| kind_of_path(path))
        .ok_or_else(|| QueryError::UnknownKind { path: path.to_owned() })?;
    read_from(source, path, kind)
}

/// Reads all queries from `source`, which holds what a file would; `path` is what messages and [`QueryFile::path`] call it.
///
/// # Errors
///
/// Those of [`read`] that concern the content.
///
/// ```
/// use selvedge::PairKind;
/// use selvedge_laboratory::queries::read_from;
/// let rows = "1,2,0,1,-3,4\n".repeat(8);
/// let file = read_from(rows.as_bytes(), "generated".as_ref(), PairKind::EdgeEdge)?;
/// assert_eq!(file.queries[0].pair.motions[0].start.to_array(), [0.5, 0.0, -0.75]);
/// # Ok::<(), selvedge_laboratory::queries::QueryError>(())
/// ```
pub fn read_from(source: impl Read, path: &Path, kind: PairKind) -> Result<QueryFile, QueryError> {
    let unreadable = |source| QueryError::Read {
        path: path.to_owned(),
        source,
    };
    let mut reader = ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .quoting(false)
        .trim(Trim::All)
        // The library's own count of lines is behind by the blank lines that it skips, and by one
        // where lines end in CR LF. With LF as the only terminator (CR is trimmed as white space),
        // and a last line that has one too, a record has just been completed by its own LF.
        .terminator(Terminator::Any(b'\n'))
        .from_reader(source.chain(&b"\n"[..]));
    let mut record = ByteRecord::new();
    let mut builder = Builder::new(path, kind);
    while reader
        .read_byte_record(&mut record)
        .map_err(|error| unreadable(error.into()))?
    {
        let is_blank = record.len() == 1 && record[0].is_empty();
        if !is_blank {
            builder.push(&record, reader.position().line() - 1)?;
        }
    }
    let (queries, inexact) = builder.finish()?;
    Ok(QueryFile {
        kind,
        queries,
        path: path.to_owned(),
        inexact,
    })
}

/// Rows in, queries out.
struct Builder<'a> {
    path: &'a Path,
    queries: Vec<Query>,
    inexact: usize,
    /// The query that the next row belongs to.
    current: Query,
    /// How many rows of `current` are there.
    filled: usize,
    /// Columns of the first row, 0 before it.
    columns: usize,
}

impl<'a> Builder<'a> {
    fn new(path: &'a Path, kind: PairKind) -> Self {
        Self {
            path,
            queries: Vec::new(),
            inexact: 0,
            current: Query {
                pair: PrimitivePair {
                    kind,
                    motions: [Motion::default(); 4],
                },
                collides: None,
                line: 0,
            },
            filled: 0,
            columns: 0,
        }
    }

    fn push(&mut self, record: &ByteRecord, line: u64) -> Result<(), QueryError> {
        self.check_columns(record, line)?;
        let truth = self.truth(record, line)?;
        if self.filled == 0 {
            self.current.line = line;
            self.current.collides = truth;
        } else if truth != self.current.collides {
            let path = self.path.to_owned();
            return Err(QueryError::TruthDiffers {
                path,
                line,
                first: self.current.line,
            });
        }
        let point = self.point(record, line)?;
        let motion = &mut self.current.pair.motions[self.filled % 4];
        if self.filled < 4 {
            motion.start = point;
        } else {
            motion.end = point;
        }
        self.filled += 1;
        if self.filled == ROWS {
            self.queries.push(self.current);
            self.filled = 0;
        }
        Ok(())
    }

    fn finish(self) -> Result<(Vec<Query>, usize), QueryError> {
        if self.columns == 0 {
            return Err(QueryError::Empty {
                path: self.path.to_owned(),
            });
        }
        if self.filled != 0 {
            return Err(QueryError::IncompleteQuery {
                path: self.path.to_owned(),
                rows: self.queries.len() * ROWS + self.filled,
                line: self.current.line,
            });
        }
        Ok((self.queries, self.inexact))
    }

    fn check_columns(&mut self, record: &ByteRecord, line: u64) -> Result<(), QueryError> {
        const WITH_TRUTH: usize = COORDINATE_COLUMNS + 1;
        let found = record.len();
        let expected = match (self.columns, found) {
            (0, COORDINATE_COLUMNS | WITH_TRUTH) => {
                self.columns = found;
                return Ok(());
            }
            (columns, found) if columns == found => return Ok(()),
            (0, _) => "6 or 7",
            (WITH_TRUTH, _) => "7 as before",
            (_, _) => "6 as before",
        };
        Err(QueryError::Columns {
            path: self.path.to_owned(),
            line,
            found,
            expected,
        })
    }

    fn truth(&self, record: &ByteRecord, line: u64) -> Result<Option<bool>, QueryError> {
        match record.get(COORDINATE_COLUMNS) {
            None => Ok(None),
            Some(b"0") => Ok(Some(false)),
            Some(b"1") => Ok(Some(true)),
            Some(other) => Err(QueryError::Truth {
                path: self.path.to_owned(),
                line,
                text: shorten(other),
            }),
        }
    }

    fn point(&mut self, record: &ByteRecord, line: u64) -> Result<DVec3, QueryError> {
        let mut point = DVec3::ZERO;
        for axis in 0..3 {
            let (column, next) = (2 * axis, 2 * axis + 1);
            let path = || self.path.to_owned();
            let not_an_integer = |index: usize| QueryError::NotAnInteger {
                path: path(),
                line,
                column: index + 1,
                text: shorten(&record[index]),
            };
            let rounded = rational::round(&record[column], &record[next]).map_err(|error| match error {
                RatioError::NumeratorNotAnInteger => not_an_integer(column),
                RatioError::DenominatorNotAnInteger => not_an_integer(next),
                RatioError::ZeroDenominator => QueryError::ZeroDenominator {
                    path: path(),
                    line,
                    column: next + 1,
                },
            })?;
            if rounded.value.is_infinite() {
                return Err(QueryError::OverflowsF64 {
                    path: path(),
                    line,
                    column: column + 1,
                });
            }
            self.inexact += usize::from(!rounded.exact);
            point[axis] = rounded.value;
        }
        Ok(point)
    }
}

/// A field for a message.
fn shorten(field: &[u8]) -> String {
    excerpt(&String::from_utf8_lossy(field), 24)
}
