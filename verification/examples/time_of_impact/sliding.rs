//! Measures the cost of pairs that slide past each other, by their distance, as a table and a plot.

use super::Random;
use selvedge_core::PairKind;
use selvedge_core::PrimitivePair;
use selvedge_core::elementary::Limits;
use selvedge_core::elementary::advance::{time_of_impact, time_of_impact_and_work};
use selvedge_verification::generator::{Choices, PairCase};
use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// The negated exponents of the distances, which are powers of two.
const EXPONENTS: std::ops::RangeInclusive<i32> = 2..=32;
/// The size of a panel, and the room around it.
const SIZE: [f64; 2] = [330.0, 230.0];
const ROOM: [f64; 2] = [70.0, 60.0];

/// The costs at one distance.
struct Cost {
    exponent: i32,
    nanoseconds: f64,
    mean_rounds: f64,
    most_rounds: u32,
}

/// One of the costs.
type Value = fn(&Cost) -> f64;

/// Measures `count` pairs of each kind at each distance in `f64`, prints a table, and writes a plot.
pub(crate) fn sliding(count: u64, plot: &Path) -> std::io::Result<()> {
    println!("kind        distance  ns a pair  rounds: mean, most");
    let kinds = [("vertex and face", PairKind::VertexFace), ("two edges", PairKind::EdgeEdge)];
    let costs = kinds.map(|(name, kind)| {
        let costs: Vec<Cost> = EXPONENTS.step_by(2).map(|exponent| cost(kind, exponent, count)).collect();
        for cost in &costs {
            println!(
                "{name:15} 2^-{:<3} {:9.0} {:8.2} {:5}",
                cost.exponent, cost.nanoseconds, cost.mean_rounds, cost.most_rounds
            );
        }
        (name, costs)
    });
    std::fs::write(plot, svg(&costs))
}

fn cost(kind: PairKind, exponent: i32, count: u64) -> Cost {
    let mut random = Random::new(1, exponent as u64);
    let pairs: Vec<PrimitivePair<f64>> = (0..count)
        .map(|_| {
            let bytes = random.bytes::<{ Choices::ENOUGH }>();
            PairCase::choose_sliding_at(kind, exponent, &mut Choices::new(&bytes)).pair()
        })
        .collect();
    let limits = Limits::default();
    let rounds = pairs.iter().map(|pair| time_of_impact_and_work(pair, &limits).1.rounds);
    let (sum, most_rounds) = rounds.fold((0, 0), |(sum, most), rounds| (sum + u64::from(rounds), most.max(rounds)));
    let seconds = [(); 5].map(|()| {
        let begin = Instant::now();
        for pair in &pairs {
            let _ = black_box(time_of_impact(black_box(pair), &limits));
        }
        begin.elapsed().as_secs_f64()
    });
    let nanoseconds = 1e9 * seconds.into_iter().fold(f64::INFINITY, f64::min);
    Cost {
        exponent,
        nanoseconds: nanoseconds / count as f64,
        mean_rounds: sum as f64 / count as f64,
        most_rounds,
    }
}

/// Draws two panels: time and rounds, upwards, against the distance, from far to near.
fn svg(costs: &[(&str, Vec<Cost>); 2]) -> String {
    let [width, height] = [2.0 * (SIZE[0] + ROOM[0]), SIZE[1] + 2.0 * ROOM[1]];
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" font-family=\"sans-serif\" font-size=\"11\" fill=\"#1f2328\">\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fdfdfc\"/>\n"
    );
    let value_of: [(&str, f64, Value); 2] = [
        ("nanoseconds for a pair, f64", 200.0, |cost| cost.nanoseconds),
        ("rounds in the mean", 2.0, |cost| cost.mean_rounds),
    ];
    for (index, (title, tick, value)) in value_of.into_iter().enumerate() {
        let largest = costs
            .iter()
            .flat_map(|(_, costs)| costs.iter().map(value))
            .fold(tick, f64::max);
        let left = ROOM[0] * 0.75 + index as f64 * (SIZE[0] + ROOM[0]);
        panel(
            &mut svg,
            left,
            [title, "distance at which they slide, edges of about 1"],
            [largest, tick],
            costs,
            value,
        );
    }
    svg + "</svg>\n"
}

fn panel(
    svg: &mut String,
    left: f64,
    [title, across]: [&str; 2],
    [largest, tick]: [f64; 2],
    costs: &[(&str, Vec<Cost>); 2],
    value: Value,
) {
    let (first, last) = (f64::from(*EXPONENTS.start()), f64::from(*EXPONENTS.end()));
    let bottom = ROOM[1] + SIZE[1];
    let x = |exponent: f64| left + (exponent - first) / (last - first) * SIZE[0];
    let y = |value: f64| bottom - value / (1.1 * largest) * SIZE[1];
    let mut add = |element: String| writeln!(svg, "{element}").expect("a string");
    add(format!(
        "<text x=\"{left}\" y=\"{}\" font-size=\"13\">{title}</text>",
        ROOM[1] - 20.0
    ));
    for step in 0..=(1.1 * largest / tick) as u32 {
        let value = f64::from(step) * tick;
        let [right, at] = [left + SIZE[0], y(value)];
        add(format!(
            "<line x1=\"{left}\" y1=\"{at:.1}\" x2=\"{right}\" y2=\"{at:.1}\" stroke=\"#d0d7de\"/>"
        ));
        add(format!(
            "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{value}</text>",
            left - 6.0,
            at + 4.0
        ));
    }
    for (exponent, name) in [
        (3.32, "1e-1"),
        (9.97, "1e-3"),
        (16.61, "1e-5"),
        (23.25, "1e-7"),
        (29.9, "1e-9"),
    ] {
        add(format!(
            "<text x=\"{:.1}\" y=\"{}\" text-anchor=\"middle\">{name}</text>",
            x(exponent),
            bottom + 16.0
        ));
    }
    add(format!(
        "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{across}</text>",
        left + SIZE[0] / 2.0,
        bottom + 36.0
    ));
    for ((name, costs), (colour, above)) in costs.iter().zip([("#0072b2", 0.0), ("#d55e00", 14.0)]) {
        let points: Vec<String> = costs
            .iter()
            .map(|cost| format!("{:.1},{:.1}", x(f64::from(cost.exponent)), y(value(cost))))
            .collect();
        add(format!(
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"1.8\"/>",
            points.join(" ")
        ));
        add(format!(
            "<text x=\"{}\" y=\"{}\" fill=\"{colour}\">{name}</text>",
            left + 8.0,
            ROOM[1] + 14.0 + above
        ));
    }
}
