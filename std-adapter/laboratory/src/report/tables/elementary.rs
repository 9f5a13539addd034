use super::table;
use crate::report::number::{ABSENT, grouped, magnitude, time};
use crate::study::elementary::{ElementaryAccuracy, ElementaryRow, ElementarySet};

/// Returns a table of elementary tests, their times and errors for each set of pairs and format.
pub fn elementary(accuracy: &ElementaryAccuracy) -> String {
    let mut text = format!(
        "What an accurate elementary test costs in time: one pair at a time, seed {}\n\n",
        accuracy.options.seed,
    );
    for set in &accuracy.sets {
        text += &format!(
            "{}, {}\n{} VF and {} EE pairs; {} touch, {} of them at a known time\n\n",
            set.name,
            set.scalar,
            grouped(set.vertex_face),
            grouped(set.edge_edge),
            grouped(set.touching),
            grouped(set.with_time),
        );
        text += &body(set);
        text += "\n";
    }
    text + NOTES
}

const NOTES: &str = "\
δ: the tolerance, in units of length. pairs: a slow test runs on a random part
of the pairs, and its counts are of those. missed: touching pairs called free.
late: contacts found after their exact time, which is as bad. false: pairs that
never touch, but are not called free. early: the time by which a contact is
found too early, in steps: the median and the largest.
! not certified: unsafe to rely on
";

fn body(set: &ElementarySet) -> String {
    let header = ["test", "δ", "time", "pairs", "missed", "late", "false", "early", "at most"];
    table(header, set.rows.iter().map(cells))
}

fn cells(row: &ElementaryRow) -> [String; 9] {
    let mark = if row.method.is_certified() { "" } else { "!" };
    let tolerance = row.method.tolerance();
    let early = |length: Option<f64>| length.map_or_else(|| ABSENT.to_owned(), magnitude);
    [
        format!("{}{mark}", row.method.name()),
        tolerance.map_or_else(String::new, |tolerance| format!("{tolerance:e}")),
        time(row.nanoseconds * 1e-9),
        grouped(row.asked),
        grouped(row.missed),
        grouped(row.late),
        grouped(row.false_alarms),
        early(row.early),
        early(row.early.map(|_| row.earliest)),
    ]
}
