use super::table;
use crate::report::number::{grouped, time};
use crate::study::elementary::{ElementaryAccuracy, ElementaryRow, ElementarySet};

/// What an accurate elementary test costs in time: a table for each set of pairs and format.
#[must_use]
pub fn elementary(accuracy: &ElementaryAccuracy) -> String {
    let mut text = format!(
        "What an accurate elementary test costs in time: one pair at a time, seed {}\n\n",
        accuracy.options.seed,
    );
    for set in &accuracy.sets {
        text += &format!(
            "{}, {}\n{} VF and {} EE pairs; {} touch, of {} of them it is known when\n\n",
            set.name,
            set.scalar,
            grouped(set.vertex_face as u64),
            grouped(set.edge_edge as u64),
            grouped(set.touching as u64),
            grouped(set.with_time as u64),
        );
        text += &body(set);
        text += "\n";
    }
    text + NOTES
}

const NOTES: &str = "\
δ: the tolerance, in units of length. asked: a slow test is asked about a random
part of the pairs; its counts are of those. missed: touching pairs called free;
late: contacts found after their exact time, which is as bad; false: pairs that
never touch, but are not called free. early: how long before the exact time a
contact is found, in steps: the median, and the most.
! not certified: unsafe to rely on
";

fn body(set: &ElementarySet) -> String {
    let header = ["test", "δ", "time", "asked", "missed", "late", "false", "early", "at most"];
    table(header, set.rows.iter().map(cells))
}

fn cells(row: &ElementaryRow) -> [String; 9] {
    let mark = if row.method.is_certified() { "" } else { "!" };
    let count = |count: usize| grouped(count as u64);
    let length = |length: f64| match length {
        0.0 => "0".to_owned(),
        length => format!("{length:.0e}"),
    };
    [
        format!("{}{mark}", row.method.name()),
        row.method
            .tolerance()
            .map_or_else(String::new, |tolerance| format!("{tolerance:e}")),
        if row.asked > 0 {
            time(row.nanoseconds * 1e-9)
        } else {
            "–".to_owned()
        },
        count(row.asked),
        count(row.missed),
        count(row.late),
        count(row.false_alarms),
        row.early.map_or_else(|| "–".to_owned(), length),
        row.early.map_or_else(|| "–".to_owned(), |_| length(row.earliest)),
    ]
}
