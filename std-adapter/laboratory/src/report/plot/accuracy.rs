//! Plots what accuracy costs in time, for filters.

use super::axis::{LogAxis, TowardsNone};
use super::look::Look;
use super::picture::{Mark, Panel, Plot, StripRow};
use crate::methods::MeasuredFilter;
use crate::report::number::{grouped, percent, round_time, time};
use crate::study::{AccuracyRow, AccuracySet, BackendTime, FilterAccuracy};

const WIDTH: f64 = 266.0;
const SHARES: TowardsNone = TowardsNone {
    smallest: -6,
    step: 24.0,
};
const LINES: [&str; 8] = ["all", "99.9999 %", "99.999 %", "99.99 %", "99.9 %", "99 %", "90 %", "none"];
const LEGEND: [(Look, &str); 4] = [
    (Look::CERTIFIED, "certified"),
    (Look::ONE_AT_A_TIME, "certified, one by one"),
    (Look::EXACT, "exact"),
    (Look::UNSAFE, "unsafe: culls without proof"),
];

/// Plots accuracy against time, as an SVG picture with its own light background: one panel for each set of pairs and format.
///
/// The horizontal axis is time per pair, logarithmic and the same in all panels. It is for sixteen pairs side by side on the best
/// instruction set, unless the name says otherwise. The vertical axis is the share of pairs that the filter culls, among those
/// that exact arithmetic culls. Each line is ten times closer to all. Filters without a proof have no place on that axis. They
/// are in a strip of their own, with the number of pairs that they cull without proof.
pub fn accuracy_svg(accuracy: &FilterAccuracy) -> String {
    let measured: Vec<_> = accuracy.sets.iter().map(|set| (set, measured(set))).collect();
    let times = measured.iter().flat_map(|(_, rows)| rows).map(|row| row.nanoseconds);
    let axis = LogAxis::over(times, WIDTH);
    let mut backends = accuracy.sets.iter().filter_map(best_backend);
    let lanes = backends.next_back().unwrap_or("no");
    let separation = match accuracy.options.separation {
        0.0 => String::new(),
        separation => format!(", separation {separation}"),
    };
    let plot = Plot {
        title: "What accuracy costs in time",
        explanation: &format!(
            "Up: culls more of what exact arithmetic culls. Left: faster. Pairs are gathered from a mesh by one thread, \
             sixteen side by side ({lanes}){separation}."
        ),
        legend: &LEGEND,
        size: [WIDTH, SHARES.height()],
        ticks: axis.ticks(|nanoseconds| round_time(nanoseconds * 1e-9)),
        across: "time per pair",
        upwards: "of these it culls",
        lines: (0..)
            .zip(LINES)
            .map(|(line, name)| (f64::from(line) * SHARES.step, name.to_owned()))
            .collect(),
        strip_rows: 2,
    };
    let panels: Vec<_> = measured.iter().map(|(set, rows)| panel(set, rows, &axis)).collect();
    plot.draw(&panels)
}

/// Returns the instruction set of the plotted times.
fn best_backend(set: &AccuracySet) -> Option<&'static str> {
    Some(set.rows.last()?.best_time()?.backend)
}

/// A filter with one of its times.
struct TimedFilter<'a> {
    row: &'a AccuracyRow,
    look: Look,
    nanoseconds: f64,
}

/// Returns each filter's best time, and the permanent's time one by one.
fn measured(set: &AccuracySet) -> Vec<TimedFilter<'_>> {
    let rows = set.rows.iter().flat_map(|row| {
        let is_permanent = row.filter == MeasuredFilter::Permanent;
        let one = row.times.first().copied().filter(|_| is_permanent);
        let times = [(look(row.filter), row.best_time()), (Look::ONE_AT_A_TIME, one)];
        times.into_iter().filter_map(move |(look, time)| {
            let BackendTime { nanoseconds, .. } = time.filter(|time| time.nanoseconds.is_finite())?;
            Some(TimedFilter { row, look, nanoseconds })
        })
    });
    rows.collect()
}

fn look(filter: MeasuredFilter) -> Look {
    match filter {
        MeasuredFilter::Exact => Look::EXACT,
        filter if filter.is_certified() => Look::CERTIFIED,
        _ => Look::UNSAFE,
    }
}

fn panel(set: &AccuracySet, rows: &[TimedFilter<'_>], axis: &LogAxis) -> Panel {
    let (is_unsafe, is_proven) = (|row: &&_| is_unsafe(row), |row: &&_| !is_unsafe(row));
    let proven = rows.iter().filter(is_proven).filter(|_| set.cullable > 0);
    let mark = |measured: &TimedFilter<'_>| {
        let kept = measured.row.kept_cullable as f64 / set.cullable as f64;
        Mark {
            look: measured.look,
            at: [axis.place(measured.nanoseconds), SHARES.place(kept)],
            name: Some(name(measured)),
        }
    };
    let strip = rows.iter().filter(is_unsafe).map(|measured| StripRow {
        places: vec![axis.place(measured.nanoseconds)],
        name: name(measured),
    });
    let marks: Vec<_> = proven.map(mark).collect();
    Panel {
        title: format!("{}, {}", set.name, set.scalar),
        subtitle: format!(
            "{} pairs, of which exact arithmetic culls {}",
            grouped(set.pairs()),
            percent(set.cullable, set.pairs(), 1),
        ),
        note: marks.is_empty().then_some("exact arithmetic culls none of them"),
        marks,
        strip: strip.collect(),
        curves: Vec::new(),
    }
}

fn is_unsafe(measured: &TimedFilter<'_>) -> bool {
    measured.look == Look::UNSAFE
}

fn name(measured: &TimedFilter<'_>) -> String {
    let TimedFilter { row, look, nanoseconds } = *measured;
    let filter = match row.filter {
        MeasuredFilter::Uncertified => "as computed".to_owned(),
        filter => filter.name().replace('_', " "),
    };
    let time = time(nanoseconds * 1e-9);
    match (look, row.false_culls) {
        (Look::ONE_AT_A_TIME, _) => format!("{filter}, one by one: {time}"),
        (Look::UNSAFE, 0) => format!("{filter}: {time}, none false here"),
        (Look::UNSAFE, beyond) => format!("{filter}: {time}, {} false", grouped(beyond)),
        _ => format!("{filter}: {time}"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::texts::{placed_texts, texts};
    use super::*;
    use crate::study::AccuracyOptions;
    use roxmltree::Document;
    use std::time::Duration;

    /// Makes a set of 100,000 pairs of which 90,000 can be culled; every filter takes 3 ns in lanes and keeps `kept` of them.
    fn set(scalar: &'static str, cullable: usize, kept: usize) -> AccuracySet {
        let rows = MeasuredFilter::ALL.map(|filter| AccuracyRow {
            filter,
            culled: cullable - kept,
            kept_cullable: kept,
            false_culls: if filter.is_certified() { 0 } else { 1234 },
            times: [("one", 8.0), ("avx2", 3.0)]
                .map(|(backend, nanoseconds)| BackendTime { backend, nanoseconds })
                .to_vec(),
            in_first_cache: None,
        });
        AccuracySet {
            name: "some pairs".to_owned(),
            scalar,
            vertex_face: 40_000,
            edge_edge: 60_000,
            drawn_from: 100_000,
            timed: 50_000,
            cullable,
            rows: rows.to_vec(),
        }
    }

    fn plot(sets: Vec<AccuracySet>) -> String {
        let options = AccuracyOptions {
            pairs: 100_000,
            repeat: 1,
            seed: 1,
            separation: 0.0,
            budget: Duration::ZERO,
        };
        accuracy_svg(&FilterAccuracy { options, sets })
    }

    #[test]
    fn every_filter_is_named_with_its_time_and_unsafe_ones_with_their_false_culls() {
        let svg = plot(vec![set("f32", 90_000, 9), set("f64", 90_000, 0)]);
        let texts = texts(&svg);
        for label in [
            "some pairs, f32",
            "some pairs, f64",
            "100,000 pairs, of which exact arithmetic culls 90.0\u{a0}%",
            "permanent: 3.00 ns",
            "permanent, one by one: 8.00 ns",
            "exact: 3.00 ns",
            "as computed: 3.00 ns, 1,234 false",
            "paper: 3.00 ns, 1,234 false",
        ] {
            assert!(texts.iter().any(|text| text == label), "{label}: {texts:?}");
        }
    }

    #[test]
    fn names_never_overlap() {
        let svg = plot(vec![set("f32", 90_000, 9)]);
        let mut names: Vec<f64> = placed_texts(&svg)
            .into_iter()
            .filter(|(_, text)| text.contains(".00 ns"))
            .map(|([_, y], _)| y)
            .collect();
        names.sort_by(f64::total_cmp);
        // Five filters, and the permanent's second time.
        assert_eq!(names.len(), 6);
        for pair in names.windows(2) {
            assert!(pair[1] - pair[0] > 15.0, "{names:?}");
        }
    }

    #[test]
    fn a_set_of_which_nothing_can_be_culled_says_so() {
        let svg = plot(vec![set("f32", 0, 0)]);
        assert!(svg.contains("exact arithmetic culls none of them"));
        assert!(!svg.contains("NaN"));
    }

    #[test]
    fn a_plot_of_nothing_is_a_picture() {
        assert!(Document::parse(&plot(Vec::new())).is_ok());
    }
}
