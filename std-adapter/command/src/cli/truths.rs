//! `selvedge truths`.

use super::Failure;
use super::output::{self, OutputFiles};
use super::progress::Progress;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use selvedge_laboratory::report::{json, tables, truths_html};
use selvedge_laboratory::truths::{LAWS, Law, LawRuns};
use std::path::PathBuf;

/// Compares the cloth simulation with laws whose answers are known
///
/// Runs scenes with an exact answer, such as free fall, catenaries, friction and stacks, each at time steps of 1, 2 and 4 ms and
/// on up to three meshes. The table has the largest error of each.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge truths
  selvedge truths --law capstan,inclined_plane
  selvedge truths --output out

All laws take a few minutes. Other load on the machine disturbs the times.")]
pub(crate) struct Truths {
    /// Measure only these laws, separated by commas
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = law_parser())]
    law: Vec<&'static Law>,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
    /// Write a page with plots (truths.html) to this folder
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,
}

/// Parses a law's name. The error lists the known ones.
fn law_parser() -> impl TypedValueParser<Value = &'static Law> {
    let known = PossibleValuesParser::new(LAWS.map(|law| law.name));
    known.try_map(|name| LAWS.into_iter().find(|law| law.name == name).ok_or("there is no such law"))
}

impl Truths {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if let Some(folder) = &self.output {
            OutputFiles::check_folder(folder)?;
        }
        let is_meant = |law: &&Law| self.law.is_empty() || self.law.iter().any(|own| own.name == law.name);
        let laws: Vec<&'static Law> = LAWS.into_iter().filter(is_meant).collect();
        let count: usize = laws.iter().map(|law| law.runs()).sum();
        let (progress, mut before) = (Progress::bar("measuring"), 0);
        let mut all = Vec::with_capacity(laws.len());
        for law in laws {
            all.push(LawRuns::measure(law, &mut |done| {
                progress.set((before + done) as f64 / count as f64);
            })?);
            before += law.runs();
        }
        drop(progress);
        let mut files = OutputFiles::default();
        if let Some(folder) = &self.output {
            files.add_bytes(folder.join("truths.html"), truths_html(&all).as_bytes())?;
        }
        files.publish()?;
        output::answer(self.json, || json::truths(&all), || tables::truths(&all))
    }
}
