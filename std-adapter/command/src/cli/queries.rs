//! `selvedge queries`.

use super::Failure;
use super::options::ScalarChoice;
use super::output;
use super::progress::Progress;
use selvedge::PairKind;
use selvedge::core::Scalar;
use selvedge_laboratory::methods::{QueryMethod, UnknownMethod};
use selvedge_laboratory::queries::{self, Query, QueryFile};
use selvedge_laboratory::report::{json, tables};
use selvedge_laboratory::study::{QueryResult, measure_queries};
use std::path::PathBuf;

/// Runs methods on single pairs with known answers, and measures them
///
/// Reads queries in the CSV format of the public benchmark of continuous collision detection. A query has 8 rows: four points at
/// the start of the step, then at its end. Each row has numerator and denominator of x, y and z, and the truth as 0 or 1 if it is
/// known. Files of both kinds may be given together; results are joined by kind.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge queries unit-tests/vertex-face/*.csv
  selvedge queries */*/*.csv --method selvedge,cubic --scalar f32
  selvedge queries pairs.csv --kind edge-edge --json

A query's time is the mean of calls that take 2 µs together, in the fastest of
three runs.")]
pub(crate) struct Queries {
    /// Files of queries
    #[arg(required = true, value_name = "FILE.csv")]
    files: Vec<PathBuf>,
    /// Run these methods, separated by commas, or `all`
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', default_value = "all", value_parser = method, help = method_help())]
    method: Vec<MethodChoice>,
    /// Compute in this format
    #[arg(long, value_enum, default_value_t = ScalarChoice::F64)]
    scalar: ScalarChoice,
    /// The kind of pairs in all files. By default the name of the folder or the file decides
    #[arg(long, value_name = "KIND", value_parser = kind_parser())]
    kind: Option<PairKind>,
    /// Print one JSON document instead of tables
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug)]
enum MethodChoice {
    All,
    One(QueryMethod),
}

fn method(name: &str) -> Result<MethodChoice, UnknownMethod> {
    match name {
        "all" => Ok(MethodChoice::All),
        name => name.parse().map(MethodChoice::One),
    }
}

fn method_help() -> String {
    let names = QueryMethod::ALL.map(QueryMethod::name).join(", ");
    format!("Run these methods, separated by commas: {names}; or all")
}

fn kind_parser() -> impl clap::builder::TypedValueParser<Value = PairKind> {
    use clap::builder::{PossibleValuesParser, TypedValueParser};
    PossibleValuesParser::new(PairKind::ALL.map(PairKind::name)).try_map(|name| name.parse::<PairKind>())
}

impl Queries {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let files = {
            let _progress = Progress::spinner("reading");
            let files = self.files.iter().map(|path| queries::read(path, self.kind));
            files.collect::<Result<Vec<_>, _>>()?
        };
        let inexact: usize = files.iter().map(|file| file.inexact).sum();
        if inexact > 0 {
            output::say(format_args!(
                "{} rounded to f64; the truth may not hold for the queries they are in",
                output::coordinates_were(inexact)
            ));
        }
        let (scalar, results) = match self.scalar {
            ScalarChoice::F64 => {
                let queries = |file: &QueryFile| Ok(file.queries.clone());
                ("f64", self.measure::<f64>(&files, queries)?)
            }
            ScalarChoice::F32 => {
                let mut rounded = 0;
                let single = |file: &QueryFile| {
                    let single = file.to_f32()?;
                    rounded += single.rounded;
                    Ok(single.queries)
                };
                let results = self.measure::<f32>(&files, single)?;
                if rounded > 0 {
                    output::say(format_args!(
                        "{} rounded to f32; the truth may not hold for the queries they are in",
                        output::coordinates_were(rounded)
                    ));
                }
                ("f32", results)
            }
        };
        output::answer(
            self.json,
            || json::queries(scalar, &results),
            || tables::queries(scalar, &results),
        )
    }

    fn measure<S: Scalar>(
        &self,
        files: &[QueryFile],
        mut queries: impl FnMut(&QueryFile) -> Result<Vec<Query<S>>, Failure>,
    ) -> Result<Vec<QueryResult>, Failure> {
        let mut by_kind = Vec::new();
        for kind in PairKind::ALL {
            let mut of_kind = Vec::new();
            for file in files.iter().filter(|file| file.kind == kind) {
                of_kind.extend(queries(file)?);
            }
            if !of_kind.is_empty() {
                by_kind.push((kind, of_kind));
            }
        }
        let methods = self.methods();
        let count: usize = by_kind.iter().map(|(_, queries)| queries.len()).sum();
        let progress = Progress::bar("running methods");
        let mut results = Vec::new();
        let mut done = 0;
        for &method in &methods {
            for (kind, queries) in &by_kind {
                let result = measure_queries::<S>(method, *kind, queries, &mut |asked| {
                    progress.set((done + asked) as f64 / (count * methods.len()) as f64);
                });
                results.push(result);
                done += queries.len();
            }
        }
        Ok(results)
    }

    /// Returns each method once, in the order of the command line.
    fn methods(&self) -> Vec<QueryMethod> {
        let mut methods = Vec::new();
        let asked = self.method.iter().flat_map(|choice| match choice {
            MethodChoice::All => QueryMethod::ALL.to_vec(),
            MethodChoice::One(method) => vec![*method],
        });
        for method in asked {
            if !methods.contains(&method) {
                methods.push(method);
            }
        }
        methods
    }
}
