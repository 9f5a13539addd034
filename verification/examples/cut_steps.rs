//! Checks with the oracle that no two primitives of different triangles touch in steps that were cut as a detector said.
//!
//! `std-adapter/python/benchmarks/cut_steps.py --save FILE`, then
//! `cargo run --release -p selvedge-verification --example cut_steps -- FILE`
//!
//! A step is 36 positions of three `f64` in this machine's byte order, without gaps. They are the 18 corners of six triangles at
//! the start of the step, then at the cut. The program prints each pair that touches. The exit status is 1 if there is one, or
//! the input is invalid.

use indicatif::{ProgressBar, ProgressStyle};
use rayon::prelude::*;
use selvedge_core::PairKind;
use selvedge_verification::oracle::{Pair, collides};
use std::process::ExitCode;

const TRIANGLES: usize = 6;
const CORNERS: usize = 3 * TRIANGLES;

type Positions = [[f64; 3]; CORNERS];

fn main() -> ExitCode {
    let mut arguments = std::env::args_os().skip(1);
    let (Some(path), None) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: cut_steps FILE");
        return ExitCode::from(2);
    };
    let steps = match std::fs::read(&path)
        .map_err(|error| error.to_string())
        .and_then(|bytes| steps_of(&bytes))
    {
        Ok(steps) => steps,
        Err(what) => {
            eprintln!("{}: {what}", path.display());
            return ExitCode::FAILURE;
        }
    };
    let pairs = pairs();
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} steps, {eta} left");
    let progress = ProgressBar::new(steps.len() as u64).with_style(style.expect("valid template"));
    let touching = steps
        .par_iter()
        .enumerate()
        .filter(|(number, [start, end])| {
            progress.inc(1);
            let first = pairs.iter().find(|(kind, corners)| {
                let pair = Pair {
                    kind: *kind,
                    start: corners.map(|corner| start[corner]),
                    end: corners.map(|corner| end[corner]),
                };
                collides(&pair).is_some()
            });
            if let Some((kind, corners)) = first {
                progress.suspend(|| println!("step {}: {kind:?} {corners:?} touches", number + 1));
            }
            first.is_some()
        })
        .count();
    progress.finish_and_clear();
    println!(
        "{} steps of {} pairs: {touching} touch, by the oracle",
        steps.len(),
        pairs.len()
    );
    ExitCode::from(u8::from(touching > 0))
}

fn steps_of(bytes: &[u8]) -> Result<Vec<[Positions; 2]>, String> {
    let (numbers, rest) = bytes.as_chunks::<8>();
    let numbers: Vec<f64> = numbers.iter().map(|bytes| f64::from_ne_bytes(*bytes)).collect();
    let (positions, others) = numbers.as_chunks::<3>();
    let (meshes, more) = positions.as_chunks::<CORNERS>();
    let (steps, odd) = meshes.as_chunks::<2>();
    if steps.is_empty() || !(rest.is_empty() && others.is_empty() && more.is_empty() && odd.is_empty()) {
        return Err(format!(
            "{} bytes are no whole number of steps of {} bytes; write it with cut_steps.py --save",
            bytes.len(),
            size_of::<[Positions; 2]>()
        ));
    }
    match positions.iter().position(|position| !position.iter().all(|x| x.is_finite())) {
        Some(number) => Err(format!("position {number} is not finite; write it with cut_steps.py --save")),
        None => Ok(steps.to_vec()),
    }
}

/// Returns each vertex with each face, and each edge with each edge, of another triangle.
fn pairs() -> Vec<(PairKind, [usize; 4])> {
    let face = |triangle: usize| [0, 1, 2].map(|corner| 3 * triangle + corner);
    let edges = |triangle: usize| {
        let [a, b, c] = face(triangle);
        [[a, b], [b, c], [c, a]]
    };
    let mut pairs = Vec::new();
    for first in 0..TRIANGLES {
        for second in (0..TRIANGLES).filter(|&second| second != first) {
            let [a, b, c] = face(second);
            pairs.extend(face(first).map(|vertex| (PairKind::VertexFace, [vertex, a, b, c])));
            if first < second {
                for [p, q] in edges(first) {
                    pairs.extend(edges(second).map(|[r, s]| (PairKind::EdgeEdge, [p, q, r, s])));
                }
            }
        }
    }
    pairs
}
