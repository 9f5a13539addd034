//! `selvedge truths`.

use super::Failure;
use super::output::{self, OutputFiles};
use super::progress::Progress;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use selvedge_cloth::Accuracy;
use selvedge_laboratory::report::{PriorRuns, json, tables, truths_html};
use selvedge_laboratory::truths::{Extent, LAWS, Law, LawRuns, PACES, Pace};
use std::path::{Path, PathBuf};

/// Compares the cloth simulation with laws whose answers are known
///
/// Runs scenes with an exact answer, such as free fall, catenaries, balloons, friction and stacks. All settings are the defaults.
/// Each scene runs in time steps of 1 and 4 ms and by frames of 1/60 s, on up to four meshes. The table has the largest error of
/// each.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge truths
  selvedge truths --law capstan,inclined_plane
  selvedge truths --pace frames --coarse
  selvedge truths --output out
  selvedge-before truths --json > before.json
  selvedge truths --output out --against before.json

All laws take many minutes. Other load on the machine disturbs the times.")]
pub(crate) struct Truths {
    /// Measure only these laws, separated by commas
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = law_parser())]
    law: Vec<&'static Law>,
    /// Measure only at these paces, separated by commas
    #[arg(long, value_name = "PACE,…", value_delimiter = ',', value_parser = parse_pace)]
    pace: Vec<Pace>,
    /// Measure only with these accuracies, separated by commas
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', value_parser = parse_accuracy)]
    accuracy: Vec<Accuracy>,
    /// Measure each law on its coarsest mesh only
    #[arg(long)]
    coarse: bool,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
    /// Write a page with plots (truths.html) to this folder
    #[arg(long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// Draw the errors of another revision beside, from the output of its `selvedge truths --json`
    #[arg(long, value_name = "FILE", requires = "output")]
    against: Option<PathBuf>,
}

/// Parses a law's name. The error lists the known ones.
fn law_parser() -> impl TypedValueParser<Value = &'static Law> {
    let known = PossibleValuesParser::new(LAWS.iter().map(|law| law.name));
    known.try_map(|name| {
        LAWS.iter()
            .copied()
            .find(|law| law.name == name)
            .ok_or("there is no such law")
    })
}

/// Returns a pace's name on the command line: `1ms` or `frames`.
fn name_of(pace: Pace) -> String {
    pace.to_string().replace(' ', "")
}

/// Parses a pace's name. The error lists the known ones.
fn parse_pace(name: &str) -> Result<Pace, String> {
    let known = PACES.map(name_of).join(", ");
    PACES
        .into_iter()
        .find(|pace| name_of(*pace) == name)
        .ok_or_else(|| format!("the paces are {known}"))
}

/// Parses an accuracy's name. The error lists the known ones.
fn parse_accuracy(name: &str) -> Result<Accuracy, String> {
    let known = Accuracy::ALL.map(Accuracy::name).join(", ");
    { Accuracy::ALL.into_iter() }
        .find(|accuracy| accuracy.name() == name)
        .ok_or_else(|| format!("the accuracies are {known}"))
}

/// Reads the runs of another revision.
fn read_prior(file: &Path) -> Result<PriorRuns, Failure> {
    let named = |error: &dyn std::fmt::Display| format!("{}: {error}", file.display());
    let text = std::fs::read_to_string(file).map_err(|error| named(&error))?;
    Ok(PriorRuns::parse(&text).map_err(|error| named(&error))?)
}

impl Truths {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        if let Some(folder) = &self.output {
            OutputFiles::check_folder(folder)?;
        }
        let prior = self.against.as_deref().map(read_prior).transpose()?;
        let is_meant = |law: &&Law| self.law.is_empty() || self.law.iter().any(|own| own.name == law.name);
        let laws: Vec<&'static Law> = LAWS.iter().copied().filter(is_meant).collect();
        let is_asked = |pace: &Pace| self.pace.is_empty() || self.pace.contains(pace);
        let extent = Extent {
            paces: PACES.into_iter().filter(is_asked).collect(),
            accuracies: { Accuracy::ALL.into_iter() }
                .filter(|accuracy| self.accuracy.is_empty() || self.accuracy.contains(accuracy))
                .collect(),
            is_coarse: self.coarse,
        };
        let count: usize = laws.iter().map(|law| extent.runs(law)).sum();
        let (progress, mut before) = (Progress::bar("measuring"), 0);
        let mut all = Vec::with_capacity(laws.len());
        for law in laws {
            all.push(LawRuns::measure(law, &extent, &mut |done| {
                progress.set((before + done) as f64 / count as f64);
            }));
            before += extent.runs(law);
        }
        drop(progress);
        let mut files = OutputFiles::default();
        if let Some(folder) = &self.output {
            files.add_bytes(folder.join("truths.html"), truths_html(&all, prior.as_ref()).as_bytes())?;
        }
        files.publish()?;
        output::answer(self.json, || json::truths(&all), || tables::truths(&all))
    }
}
