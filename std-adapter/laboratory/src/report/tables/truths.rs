use super::table;
use crate::report::number::few;
use crate::report::truths::error;
use crate::truths::LawRuns;

/// Returns a table of laws with the simulation's errors at each time step. The exact and the simulated value are those of the
/// largest error on the finest mesh with the shortest step.
#[must_use]
pub fn truths(all: &[LawRuns]) -> String {
    let header = ["law", "mesh", "exact", "simulated", "error at\n1 ms", "at\n2 ms", "at\n4 ms"];
    let rows = all.iter().flat_map(|runs| {
        runs.by_mesh().enumerate().filter_map(|(index, own)| {
            let worst = own.first()?.worst();
            let name = if index == 0 { runs.law.name } else { "" };
            let mut row = vec![
                name.to_owned(),
                own[0].mesh.to_string(),
                few(worst.exact),
                few(worst.simulated),
            ];
            row.extend(own.iter().map(|run| error(runs.law, run.error())));
            Some(row)
        })
    });
    format!(
        "{}\nexact and simulated: at the place of the largest error at 1 ms.\n\
         `selvedge truths --output DIR` writes the laws, meshes and reasons.\n",
        table(header, rows)
    )
}
