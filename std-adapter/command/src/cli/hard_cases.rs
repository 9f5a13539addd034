//! `selvedge hard-cases`.

use super::Failure;
use super::options::ScalarChoice;
use super::output;
use super::progress::Progress;
use selvedge_laboratory::report::{json, tables};
use selvedge_laboratory::study::ask_hard_cases;

/// Runs every method on hard cases by name: degenerate pairs, grazes, shapes of the literature
///
/// Each case has several sizes, from a micrometre to ten kilometres. It is near the origin, 10,000 km from it, and turned so that
/// coordinates are rounded. The table shows the exact answer and marks every wrong one, ours included.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  selvedge hard-cases
  selvedge hard-cases spike
  selvedge hard-cases --scalar f32 --json

Sizes are exact: 1 um is 2^-20 times the shape, 10 km is 2^13 times. With f32, only
cases run whose coordinates f32 holds exactly.")]
pub(crate) struct HardCases {
    /// Only cases whose name contains this
    #[arg(value_name = "NAME", default_value = "", hide_default_value = true)]
    name: String,
    /// Compute in this format
    #[arg(long, value_enum, default_value_t = ScalarChoice::F64)]
    scalar: ScalarChoice,
    /// Print one JSON document instead of a table
    #[arg(long)]
    json: bool,
}

impl HardCases {
    pub(crate) fn run(&self) -> Result<(), Failure> {
        let (scalar, results) = {
            let progress = Progress::bar("running methods");
            let mut progress = |share| progress.set(share);
            match self.scalar {
                ScalarChoice::F64 => ("f64", ask_hard_cases::<f64>(&self.name, &mut progress)),
                ScalarChoice::F32 => ("f32", ask_hard_cases::<f32>(&self.name, &mut progress)),
            }
        };
        if results.is_empty() {
            return Err(format!("no hard case has `{}` in its name", self.name).into());
        }
        output::answer(
            self.json,
            || json::hard_cases(scalar, &results),
            || tables::hard_cases(scalar, &results),
        )
    }
}
