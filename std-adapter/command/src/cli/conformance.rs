//! `selvedge conformance`.

use super::Failure;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, ExitCode};

/// Runs the conformance suite on collision libraries: hard cases with exact answers
///
/// Starts the suite's program, which needs Python 3. It installs each runner into a separate environment, and gives it every
/// case. It writes scores, pages that lead to each wrong answer, and a plot of accuracy against time.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples, in a clone of the repository:
  selvedge conformance --list
  selvedge conformance selvedge libigl parry
  selvedge conformance all --out /tmp/conformance --sample 5

`selvedge conformance -- --help` shows all options of the suite.")]
pub(crate) struct Conformance {
    /// The suite's folder
    #[arg(long, value_name = "FOLDER", default_value = "verification/conformance")]
    suite: PathBuf,
    /// Names of runners, and options of the suite
    #[arg(value_name = "RUNNER", trailing_var_arg = true, allow_hyphen_values = true)]
    arguments: Vec<OsString>,
}

impl Conformance {
    pub(crate) fn run(&self) -> Result<ExitCode, Failure> {
        let program = self.suite.join("conformance.py");
        if !program.is_file() {
            let folder = self.suite.display();
            return Err(format!("`{folder}` is not the suite: run this in a clone, or name the folder with --suite").into());
        }
        let python = if cfg!(windows) { "python" } else { "python3" };
        let status = Command::new(python).arg(program).args(&self.arguments).status();
        let status = status.map_err(|error| format!("cannot run {python}, which the suite needs: {error}"))?;
        Ok(if status.success() {
            ExitCode::SUCCESS
        } else {
            ExitCode::from(1)
        })
    }
}
