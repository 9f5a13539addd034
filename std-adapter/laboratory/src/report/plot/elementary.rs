//! Plots what accuracy costs in time, for elementary tests.

use super::axis::{LogAxis, TowardsNone};
use super::look::Look;
use super::picture::{Curve, Mark, Panel, Plot, StripRow};
use crate::methods::ElementaryTest;
use crate::report::number::{grouped, round_time, time};
use crate::study::elementary::{ElementaryAccuracy, ElementaryRow, ElementarySet};

const WIDTH: f64 = 300.0;
const ERRORS: TowardsNone = TowardsNone {
    smallest: -16,
    step: 14.0,
};
const LEGEND: [(Look, &str); 4] = [
    (Look::CERTIFIED, "certified"),
    (Look::EXACT, "exact verdict"),
    (Look::BISECTION, "Tight-Inclusion, re-implemented"),
    (Look::UNSAFE, "unsafe: misses contacts, or finds them too late"),
];

/// The tests without proof: their names in reports and in the plot.
const UNSAFE: [(&str, &str); 4] = [
    ("without_bounds", "without bounds"),
    ("additive", "additive"),
    ("bernstein_sign", "Bernstein sign"),
    ("cubic", "cubic"),
];

fn look(method: ElementaryTest) -> Look {
    match method {
        ElementaryTest::Certified(_) => Look::CERTIFIED,
        ElementaryTest::Exact => Look::EXACT,
        ElementaryTest::TightInclusion(_) => Look::BISECTION,
        _ => Look::UNSAFE,
    }
}

/// Plots the accuracy of the time of impact against time, as an SVG picture with a light background. Each set of pairs and format
/// has a panel.
///
/// The horizontal axis is time per pair, logarithmic and the same in all panels. The vertical axis is the median error of a
/// contact's time, ten times less from line to line. A line joins the tolerances of one test. Tests that may miss contacts, or
/// find them too late, have no place on that axis. They are in a strip of their own, with their errors.
pub fn elementary_svg(accuracy: &ElementaryAccuracy) -> String {
    let rows = accuracy.sets.iter().flat_map(|set| &set.rows);
    let axis = LogAxis::over(rows.map(|row| row.nanoseconds), WIDTH);
    let plot = Plot {
        title: "What an accurate time of impact costs in time",
        explanation: "Up: contacts are found nearer to their exact time. Left: faster. One pair at a time, on one thread. \
                      A line joins tolerances δ from 1e-2 to 1e-12. False: pairs that never touch, but are not called free.",
        legend: &LEGEND,
        size: [WIDTH, ERRORS.height()],
        ticks: axis.ticks(|nanoseconds| round_time(nanoseconds * 1e-9)),
        across: "time per pair",
        upwards: "too early by, in steps (median)",
        lines: lines().collect(),
        strip_rows: UNSAFE.len(),
    };
    let panels: Vec<_> = accuracy.sets.iter().map(|set| panel(set, &axis)).collect();
    plot.draw(&panels)
}

fn panel(set: &ElementarySet, axis: &LogAxis) -> Panel {
    let proven = set.rows.iter().filter(|row| row.method.is_certified());
    // A test that met no contact of known time has no mark.
    let proven: Vec<_> = proven
        .filter_map(|row| Some((row, [axis.place(row.nanoseconds), ERRORS.place(row.early?)])))
        .collect();
    // The order is that of the set's rows: from the widest tolerance of a test to the tightest.
    let of_look = |wanted| proven.iter().filter(move |(row, _)| look(row.method) == wanted);
    let curves = [Look::CERTIFIED, Look::BISECTION].map(|look| Curve {
        points: of_look(look).map(|(_, at)| *at).collect(),
        colour: look.colour,
        width: 1.5,
        is_dashed: false,
    });
    let looks = LEGEND.into_iter().map(|(look, _)| look);
    let marks = looks.flat_map(|look| {
        let count = of_look(look).count();
        of_look(look).enumerate().map(move |(index, &(row, at))| {
            let is_end = index == 0 || index + 1 == count;
            Mark {
                look,
                at,
                name: is_end.then(|| name_of_proven(row, set)),
            }
        })
    });
    let strip = UNSAFE.map(|(method, name)| {
        let of_method = |row: &&ElementaryRow| row.method.name() == method && row.asked > 0;
        let rows: Vec<_> = set.rows.iter().filter(of_method).collect();
        StripRow {
            places: rows.iter().map(|row| axis.place(row.nanoseconds)).collect(),
            name: name_of_unsafe(name, &rows, set),
        }
    });
    Panel {
        title: format!("{}, {}", set.name, set.scalar),
        subtitle: format!(
            "{} pairs, of which {} touch",
            grouped(set.vertex_face + set.edge_edge),
            grouped(set.touching),
        ),
        curves: curves.into(),
        marks: marks.collect(),
        strip: strip.into(),
        note: None,
    }
}

fn name_of_proven(row: &ElementaryRow, set: &ElementarySet) -> String {
    let name = match row.method {
        ElementaryTest::Certified(tolerance) => format!("certified {tolerance:e}"),
        ElementaryTest::TightInclusion(tolerance) => format!("Tight-Inclusion {tolerance:e}"),
        _ => "exact".to_owned(),
    };
    let time = time(row.nanoseconds * 1e-9);
    let alarms = match row.false_alarms {
        0 => String::new(),
        some => format!(", {} false", grouped(some)),
    };
    format!("{name}{}: {time}{alarms}", part_asked(row.asked, set))
}

/// Names a test with the worst counts of all its tolerances.
fn name_of_unsafe(name: &str, rows: &[&ElementaryRow], set: &ElementarySet) -> String {
    let Some(asked) = rows.iter().map(|row| row.asked).min() else {
        return format!("{name}: not run");
    };
    let most = |count: fn(&ElementaryRow) -> usize| {
        let counts = rows.iter().map(|row| count(row));
        grouped(counts.max().unwrap_or_default())
    };
    format!(
        "{name}{}: {}{} missed, {} late, {} false",
        part_asked(asked, set),
        if rows.len() > 1 { "up to " } else { "" },
        most(|row| row.missed),
        most(|row| row.late),
        most(|row| row.false_alarms),
    )
}

/// Writes the number of pairs that a test ran on, if not all.
fn part_asked(asked: usize, set: &ElementarySet) -> String {
    if asked < set.vertex_face + set.edge_edge {
        format!(" ({} pairs)", grouped(asked))
    } else {
        String::new()
    }
}

/// Returns lines across, with their names.
fn lines() -> impl Iterator<Item = (f64, String)> {
    let powers = (ERRORS.smallest..=0).rev().step_by(2);
    let named = powers.map(|power| {
        let name = match power {
            0 => "1".to_owned(),
            power => format!("1e{power}"),
        };
        (ERRORS.place(10.0_f64.powi(power)), name)
    });
    named.chain([(0.0, "none".to_owned())])
}

#[cfg(test)]
mod tests {
    use super::super::texts::texts;
    use super::*;
    use crate::study::AccuracyOptions;
    use crate::study::elementary::METHODS;
    use std::time::Duration;

    fn plot() -> String {
        let rows = METHODS.map(|method| ElementaryRow {
            method,
            asked: if matches!(method, ElementaryTest::TightInclusion(_)) {
                500
            } else {
                1000
            },
            touching: 10,
            nanoseconds: 50.0,
            missed: if method.is_certified() { 0 } else { 3 },
            late: 0,
            latest: 0.0,
            false_alarms: 1234,
            early: Some(method.tolerance().unwrap_or(0.0)),
            earliest: 0.1,
        });
        let set = ElementarySet {
            name: "some pairs".to_owned(),
            scalar: "f32",
            vertex_face: 400,
            edge_edge: 600,
            touching: 10,
            with_time: 9,
            rows: rows.to_vec(),
        };
        let options = AccuracyOptions {
            pairs: 1000,
            repeat: 1,
            seed: 1,
            separation: 0.0,
            budget: Duration::ZERO,
        };
        elementary_svg(&ElementaryAccuracy {
            options,
            sets: vec![set],
        })
    }

    #[test]
    fn every_test_is_named_with_its_time_and_unsafe_ones_with_what_they_miss() {
        let svg = plot();
        let texts = texts(&svg);
        for label in [
            "some pairs, f32",
            "1,000 pairs, of which 10 touch",
            "certified 1e-2: 50.0 ns, 1,234 false",
            "certified 1e-12: 50.0 ns, 1,234 false",
            "Tight-Inclusion 1e-12 (500 pairs): 50.0 ns, 1,234 false",
            "exact: 50.0 ns, 1,234 false",
            "without bounds: up to 3 missed, 0 late, 1,234 false",
            "cubic: 3 missed, 0 late, 1,234 false",
        ] {
            assert!(texts.iter().any(|text| text == label), "{label}: {texts:?}");
        }
        // Only the ends of a line are named.
        assert!(!texts.iter().any(|text| text.contains("1e-9")), "{texts:?}");
        assert!(!svg.contains("NaN"));
    }
}
