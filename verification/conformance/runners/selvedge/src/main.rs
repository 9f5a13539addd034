//! Answers the cases of the conformance suite by Selvedge. With the argument `exact`, only pairs that truly touch count.

use selvedge::core::elementary::advance::time_of_impact;
use selvedge::core::elementary::{ContactVerdict, Limits, contact};
use selvedge::core::{Motion, PairKind, PrimitivePair, Scalar};
use selvedge::{CollisionDetector, Criterion, Position, Topology};
use std::io::{BufRead, Write};
use std::time::Instant;

type Answer = Option<(bool, Option<f64>)>;

/// Returns a function that answers the question in a format.
fn question<S: Scalar>(question: &str, is_exact: bool, x: &[f64], faces: Vec<[u32; 3]>) -> Option<Box<dyn FnMut() -> Answer>>
where
    S::Vector: Position<Scalar = S>,
{
    let points: Vec<S::Vector> = x.chunks_exact(3).map(|p| [p[0], p[1], p[2]].map(S::from_f64).into()).collect();
    let (start, end) = match question {
        "triangles" | "meshes" => (points.clone(), points),
        "moving-triangle" => {
            // The format of the cases promises that the sums are exact.
            let moved = |p: &[f64]| [0, 1, 2].map(|k| S::from_f64(p[k] + x[18 + k])).into();
            let end = points[..3].iter().copied().chain(x[9..18].chunks_exact(3).map(moved)).collect();
            (points[..6].to_vec(), end)
        }
        _ => (points[..points.len() / 2].to_vec(), points[points.len() / 2..].to_vec()),
    };
    let limits = Limits::default();
    if let "vertex-face" | "edge-edge" = question {
        let kind = if question == "edge-edge" { PairKind::EdgeEdge } else { PairKind::VertexFace };
        let motions = [0, 1, 2, 3].map(|i| Motion { start: start[i], end: end[i] });
        let pair = PrimitivePair { kind, motions };
        return Some(Box::new(move || {
            if is_exact {
                return Some((contact(&pair) != ContactVerdict::Never, None));
            }
            let time = time_of_impact(&pair, &limits).time();
            Some((time.is_some(), time.map(Scalar::to_f64)))
        }));
    }
    let mut detector = CollisionDetector::<S>::new(Topology::new(start.len(), faces).ok()?);
    if is_exact {
        detector.set_criterion(Criterion::Touching { tolerance: limits.tolerance }).ok()?;
    }
    let intersects_first = question == "moving-triangle";
    let is_at_rest = matches!(question, "triangles" | "meshes");
    Some(Box::new(move || {
        if (intersects_first || is_at_rest) && detector.has_intersections(&start).ok()? {
            return Some((true, intersects_first.then_some(0.0)));
        }
        if is_at_rest {
            return Some((false, None));
        }
        let first = detector.earliest(&start, &end).ok()?.map(|first| first.time.to_f64());
        Some((first.is_some(), first))
    }))
}

fn answer(line: &str, is_exact: bool) -> Option<String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let (kind, format, mut numbers) = (words[1], words[2], &words[3..]);
    let mut faces = vec![[0, 1, 2], [3, 4, 5]];
    if let "meshes" | "moving-mesh" = kind {
        let count: usize = numbers[1].parse().ok()?;
        let (first, indices) = numbers[3..].split_at(numbers.len() - 3 - 3 * count);
        let indices: Vec<u32> = indices.iter().map(|word| word.parse().ok()).collect::<Option<_>>()?;
        faces = indices.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect();
        numbers = first;
    }
    let number = |word: &&str| match *word {
        "nan" | "inf" | "-inf" => word.parse().ok(),
        word => hexf_parse::parse_hexf64(word, false).ok(),
    };
    let x: Vec<f64> = numbers.iter().map(number).collect::<Option<_>>()?;
    let mut ask = match format {
        "f32" => question::<f32>(kind, is_exact, &x, faces)?,
        _ => question::<f64>(kind, is_exact, &x, faces)?,
    };
    let mut best = u128::MAX;
    let mut said = None;
    for _ in 0..3 {
        let start = Instant::now();
        said = std::hint::black_box(ask());
        best = best.min(start.elapsed().as_nanos());
    }
    let (touches, time) = said?;
    let time = time.map_or("-".to_owned(), |time| time.to_string());
    Some(format!("{} {time} {best}", if touches { "touches" } else { "none" }))
}

fn main() {
    let is_exact = std::env::args().nth(1).as_deref() == Some("exact");
    let mut output = std::io::stdout().lock();
    let mut say = |text: String| writeln!(output, "{text}").and_then(|()| output.flush()).expect("standard output is open");
    say(format!("ready {}", env!("CARGO_PKG_VERSION")));
    for line in std::io::stdin().lock().lines() {
        let line = line.expect("standard input is text");
        let name = line.split(' ').next().unwrap_or_default();
        say(format!("{name} {}", answer(&line, is_exact).unwrap_or_else(|| "refused - 0".to_owned())));
    }
}
