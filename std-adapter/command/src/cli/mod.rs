//! The `selvedge` command. It reads arguments and files, runs a study, and prints and writes the results.

mod accuracy;
mod arm;
mod check;
mod compare;
mod conformance;
mod cull;
mod hard_cases;
mod main_job;
mod options;
mod output;
mod progress;
mod queries;
mod scaling;
mod simulate;
mod truths;
mod walker;
mod witnesses;

use clap::{Parser, Subcommand};
use std::process::ExitCode;

/// An error in the input, in words for the user.
pub(crate) type Failure = Box<dyn std::error::Error + Send + Sync>;

/// Finds the vertex–face and edge–edge pairs of a deforming triangle mesh that can collide during a time step
///
/// Without a subcommand, simulates a sleeve on a bending arm and runs every published method on its steps. Prints the comparison,
/// and writes it to a folder with a report to look at.
#[derive(Debug, Parser)]
#[command(name = "selvedge", version, max_term_width = 80, args_conflicts_with_subcommands = true, after_help = EXAMPLES)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    main_job: main_job::MainJob,
}

const EXAMPLES: &str = "\
Examples:
  selvedge                                  a sleeve in motion, all methods on it
  selvedge cull a.ply b.ply                 pairs that may collide from a to b
  selvedge cull a.ply b.ply --pairs c.csv   … and the contacts, one per line
  selvedge check frames/*.ply               does a mesh pass through itself?
  selvedge compare a.obj b.obj --json       all methods on your own mesh
  selvedge arm --frames 55,56               two meshes to try these on
  selvedge simulate scene.toml              cloth of a scene file

Exit status: 0 done, 1 the input is at fault, 2 the command line is at fault,
3 `check` found intersections, 4 not all of a file was read.";

/// The exit status if something that may have an area was not read, and nothing was found in the rest that weighs more.
const NOT_READ_WHOLE: u8 = 4;

#[derive(Debug, Subcommand)]
enum Command {
    Cull(cull::Cull),
    Check(check::Check),
    Compare(compare::Compare),
    Queries(queries::Queries),
    HardCases(hard_cases::HardCases),
    Conformance(conformance::Conformance),
    Scaling(scaling::Scaling),
    Accuracy(accuracy::Accuracy),
    Arm(arm::Arm),
    Simulate(simulate::Simulate),
    Truths(truths::Truths),
    Walker(walker::Walker),
}

/// Runs the command line. Only results go to standard output; errors and notes go to standard error.
pub(crate) fn main() -> ExitCode {
    let cli = Cli::parse();
    let result = match &cli.command {
        None => cli.main_job.run(),
        Some(Command::Check(check)) => return exit(check.run()),
        Some(Command::Conformance(conformance)) => return exit(conformance.run()),
        Some(Command::Cull(cull)) => return exit(cull.run()),
        Some(Command::Compare(compare)) => compare.run(),
        Some(Command::Queries(queries)) => queries.run(),
        Some(Command::HardCases(hard_cases)) => hard_cases.run(),
        Some(Command::Scaling(scaling)) => scaling.run(),
        Some(Command::Accuracy(accuracy)) => accuracy.run(),
        Some(Command::Arm(arm)) => arm.run(),
        Some(Command::Simulate(simulate)) => simulate.run(),
        Some(Command::Truths(truths)) => truths.run(),
        Some(Command::Walker(walker)) => walker.run(),
    };
    exit(result.map(|()| ExitCode::SUCCESS))
}

fn exit(result: Result<ExitCode, Failure>) -> ExitCode {
    match result {
        Ok(code) => code,
        Err(failure) => {
            output::say(format_args!("error: {failure}"));
            ExitCode::from(1)
        }
    }
}
