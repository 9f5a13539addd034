use super::table;
use crate::report::number::three_figures;
use crate::report::truths::error;
use crate::truths::LawRuns;

/// Returns a table of laws with the simulation's errors at each pace: a row for each mesh and accuracy. The exact and the
/// simulated value are those of the largest error in the first column.
#[must_use]
pub fn truths(all: &[LawRuns]) -> String {
    let Some(first) = all.first().and_then(|runs| runs.by_accuracy().next()) else {
        return String::new();
    };
    let paces = first.iter().map(|run| format!("error,\n{}", run.conditions.pace));
    let mut header: Vec<String> = ["law", "mesh", "exact", "simulated"].map(str::to_owned).into();
    header.extend(paces);
    let rows = all.iter().flat_map(|runs| {
        runs.by_accuracy().enumerate().filter_map(|(index, own)| {
            let first = own.first()?;
            let worst = first.worst();
            let name = if index == 0 { runs.law.name } else { "" };
            let mesh = format!("{}, {}", first.conditions.grid, first.conditions.accuracy.name());
            let mut row = vec![
                name.to_owned(),
                mesh,
                three_figures(worst.exact),
                three_figures(worst.simulated),
            ];
            row.extend(own.iter().map(|run| error(runs.law, run.error())));
            Some(row)
        })
    });
    let failures = all.iter().flat_map(|runs| {
        runs.runs.iter().filter_map(|run| {
            let conditions = &run.conditions;
            let failure = run.failure.as_ref()?;
            Some(format!(
                "{}, {}, {}: {failure}\n",
                runs.law.name, conditions.grid, conditions.pace
            ))
        })
    });
    format!(
        "{}\nexact and simulated: at the place of the largest error in the first column of errors.\n\
         `selvedge truths --output DIR` writes the laws, meshes and reasons.\n{}",
        table(header, rows),
        failures.collect::<String>()
    )
}
