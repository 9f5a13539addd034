use super::table;
use crate::report::number::{counted, finite, grouped, percent, three_figures};
use crate::study::{AccuracyRow, AccuracySet, FilterAccuracy};

/// Returns a table of filters and their times for each set of pairs and format.
pub fn accuracy(accuracy: &FilterAccuracy) -> String {
    let options = accuracy.options;
    let separation = match options.separation {
        0.0 => String::new(),
        separation => format!(", separation {separation}"),
    };
    let mut text = format!(
        "What accuracy costs in time: one thread, the fastest of {}, seed {}{separation}\n\n",
        counted(options.repeat, "run"),
        options.seed,
    );
    for set in &accuracy.sets {
        text += &heading(set);
        text += &body(set);
        text += "\n";
    }
    text + NOTES
}

const NOTES: &str = "\
culls: percentage of all pairs. keeps: pairs kept, of 100,000 that exact
arithmetic culls. false: pairs culled without proof; +: percentage of all pairs
that are coplanar at some time, but do not touch, and are culled as well.
The other columns are nanoseconds a pair, gathered by index from rows of
vertices in a core's cache: one at a time, then sixteen side by side on each
instruction set. in L1: from tiles in the first cache, on the best one.
cost: the time on the best one, relative to that of `uncertified`.
! not certified: culls colliding pairs now and then
";

fn heading(set: &AccuracySet) -> String {
    let drawn = if set.pairs() < set.drawn_from {
        format!(" of {}", grouped(set.drawn_from))
    } else {
        String::new()
    };
    let timed = if set.timed < set.pairs() {
        format!(", {} of them timed", grouped(set.timed))
    } else {
        String::new()
    };
    format!(
        "{}, {}\n{} pairs{drawn} ({} VF, {} EE){timed}\nexact arithmetic culls {}\n\n",
        set.name,
        set.scalar,
        grouped(set.pairs()),
        grouped(set.vertex_face),
        grouped(set.edge_edge),
        percent(set.cullable, set.pairs(), 2),
    )
}

fn body(set: &AccuracySet) -> String {
    let times = set.rows.first().map(|row| &row.times);
    let times = times.into_iter().flatten();
    let backends: Vec<&str> = times.map(|time| time.backend).collect();
    let mut header: Vec<String> = ["filter", "culls", "keeps", "false"].map(str::to_owned).into();
    header.extend(backends.iter().map(|backend| in_two_lines(backend)));
    header.extend(["in\nL1", "cost"].map(str::to_owned));
    let rows = set.rows.iter().map(|row| cells(set, row, &backends));
    table(header, rows)
}

/// Splits a name, since `avx512` would make a wide column of short numbers.
fn in_two_lines(backend: &str) -> String {
    match backend.find(|letter: char| letter.is_ascii_digit()) {
        Some(digit) if backend.len() > 4 => format!("{}\n{}", &backend[..digit], &backend[digit..]),
        _ => backend.to_owned(),
    }
}

fn cells(set: &AccuracySet, row: &AccuracyRow, backends: &[&str]) -> Vec<String> {
    let mark = if row.filter.is_certified() { "" } else { "!" };
    let share = |count: usize| 100.0 * count as f64 / set.pairs() as f64;
    let mut cells = vec![
        format!("{}{mark}", row.filter),
        finite(share(row.culled), |share| format!("{share:.2}")),
        per_100_000(row.kept_cullable, set.cullable),
        grouped(row.false_culls),
    ];
    let time = |time: Option<f64>| time.map_or_else(String::new, nanoseconds);
    cells.extend(backends.iter().map(|backend| time(row.time(backend))));
    cells.push(time(row.in_first_cache));
    let cost = row.best_time().and_then(|time| set.over_uncertified(time));
    cells.push(cost.map_or_else(String::new, three_figures));
    cells
}

/// Writes a count per 100,000. A count above zero never reads as 0.
fn per_100_000(part: usize, whole: usize) -> String {
    match 1e5 * part as f64 / whole as f64 {
        rate if part > 0 && rate < 0.1 => "< 0.1".to_owned(),
        rate => three_figures(rate),
    }
}

/// Writes at most five letters.
fn nanoseconds(time: f64) -> String {
    match time {
        time if (999.5..9999.5).contains(&time) => format!("{time:.0}"),
        time if time >= 9999.5 => format!("{:.0}µs", time / 1e3),
        time => three_figures(time),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kept_pair_never_reads_as_none() {
        let rates = [(0, 7), (1, 10_000_000), (1, 200_000), (3, 1000), (9, 9)];
        assert_eq!(
            rates.map(|(part, whole)| per_100_000(part, whole)),
            ["0", "< 0.1", "0.5", "300", "100,000"]
        );
        assert_eq!(per_100_000(0, 0), "–");
    }

    #[test]
    fn times_have_three_figures() {
        let times = [0.754, 12.34, 123.4, 9999.4, 9999.6, f64::NAN];
        assert_eq!(times.map(nanoseconds), ["0.754", "12.3", "123", "9999", "10µs", "–"]);
    }
}
