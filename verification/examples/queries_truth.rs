//! Compares the oracle with the truth column of CSV queries of the public continuous collision detection benchmark (B. Wang et
//! al. 2021).
//!
//! `cargo run --release -p selvedge-verification --example queries_truth -- FILE.csv…`
//!
//! A query is eight rows of a numerator and a denominator for x, y and z, then the truth. The name of the file's folder,
//! `vertex-face` or `edge-edge`, is the kind. The program prints each disagreement with its exact numbers. The exit status is 1
//! if there is one, or the input is invalid.

use indicatif::{ProgressBar, ProgressStyle};
use rug::{Integer, Rational};
use selvedge_core::PairKind;
use selvedge_verification::oracle::{AlgebraicTime, Pair, collides};
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

type Result<T> = std::result::Result<T, String>;

fn main() -> ExitCode {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    if files.is_empty() {
        eprintln!("usage: queries_truth FILE.csv…");
        return ExitCode::from(2);
    }
    match compare(&files) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Compares every query and returns the number of disagreements.
fn compare(files: &[PathBuf]) -> Result<usize> {
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} files, {eta} left");
    let progress = ProgressBar::new(files.len() as u64).with_style(style.expect("valid template"));
    let mut total = Tally::default();
    println!(" queries  positives  disagreements  mean time  slowest  file");
    for path in files {
        let mut tally = Tally::default();
        for (number, (pair, truth)) in read(path)?.into_iter().enumerate() {
            let begin = Instant::now();
            let time = collides(&pair);
            let elapsed = begin.elapsed();
            let disagrees = time.is_some() != truth;
            tally.add(&Tally {
                queries: 1,
                positives: usize::from(truth),
                disagreements: usize::from(disagrees),
                time: elapsed,
                slowest: elapsed,
            });
            if disagrees {
                let oracle = time.as_ref().map_or("no contact".into(), describe);
                progress.suspend(|| {
                    println!("query {number}: truth {truth}, oracle: {oracle}\n{pair:?}");
                });
            }
        }
        progress.suspend(|| println!("{tally}  {}", path.display()));
        progress.inc(1);
        total.add(&tally);
    }
    progress.finish_and_clear();
    println!("{total}  all");
    Ok(total.disagreements)
}

#[derive(Default)]
struct Tally {
    queries: usize,
    positives: usize,
    disagreements: usize,
    time: Duration,
    slowest: Duration,
}

impl Tally {
    fn add(&mut self, other: &Self) {
        self.queries += other.queries;
        self.positives += other.positives;
        self.disagreements += other.disagreements;
        self.time += other.time;
        self.slowest = self.slowest.max(other.slowest);
    }
}

impl std::fmt::Display for Tally {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            queries,
            positives,
            disagreements,
            ..
        } = self;
        let mean = self.time.as_secs_f64() * 1e6 / (*queries).max(1) as f64;
        let slowest = self.slowest.as_secs_f64() * 1e3;
        write!(
            f,
            "{queries:8}  {positives:9}  {disagreements:13}  {mean:6.1} µs  {slowest:4.1} ms"
        )
    }
}

fn describe(time: &AlgebraicTime) -> String {
    let exact = match time.as_rational() {
        Some(value) => format!("= {value}"),
        None => format!("a root of {:?}", time.polynomial().coefficients()),
    };
    format!("contact at t ≈ {:e}, {exact}", time.to_f64_down())
}

/// Reads the queries of a file with their truth.
fn read(path: &Path) -> Result<Vec<(Pair, bool)>> {
    let at = |what: &dyn std::fmt::Display| format!("{}: {what}", path.display());
    let folder = path.parent().and_then(Path::file_name).and_then(|name| name.to_str());
    let kind = match folder {
        Some("vertex-face") => PairKind::VertexFace,
        Some("edge-edge") => PairKind::EdgeEdge,
        _ => return Err(at(&"the folder must be named vertex-face or edge-edge")),
    };
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .from_path(path)
        .map_err(|error| at(&error))?;
    let rows: Vec<([f64; 3], bool)> = reader
        .deserialize()
        .zip(1..)
        .map(|(row, line)| {
            let row: [String; 7] = row.map_err(|error| at(&error))?;
            parse(&row).map_err(|what| at(&format!("line {line}: {what}")))
        })
        .collect::<Result<_>>()?;
    let (queries, rest) = rows.as_chunks::<8>();
    if !rest.is_empty() {
        return Err(at(&format!("{} rows are not a multiple of 8", rows.len())));
    }
    let pair = |rows: &[([f64; 3], bool); 8]| Pair {
        kind,
        start: std::array::from_fn(|i| rows[i].0),
        end: std::array::from_fn(|i| rows[i + 4].0),
    };
    Ok(queries.iter().map(|rows| (pair(rows), rows[0].1)).collect())
}

/// Reads the position and the truth in a row.
fn parse(row: &[String; 7]) -> Result<([f64; 3], bool)> {
    let integer = |field: &String| {
        field
            .parse::<Integer>()
            .map_err(|error| format!("{field:?} is not an integer: {error}"))
    };
    let mut position = [0.0; 3];
    for (x, fraction) in position.iter_mut().zip(row.as_chunks::<2>().0) {
        let (numerator, denominator) = (integer(&fraction[0])?, integer(&fraction[1])?);
        if denominator.is_zero() {
            return Err("a denominator is zero".into());
        }
        let value = Rational::from((numerator, denominator));
        *x = value.to_f64();
        if Rational::from_f64(*x).as_ref() != Some(&value) {
            return Err(format!("{value} is not a floating-point number"));
        }
    }
    match row[6].as_str() {
        "0" => Ok((position, false)),
        "1" => Ok((position, true)),
        other => Err(format!("the truth must be 0 or 1, not {other:?}")),
    }
}
