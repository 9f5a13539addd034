//! Answers the cases of the conformance suite by Parry. Argument: `f32` or `f64`.

use std::io::{BufRead, Write};
use std::time::Instant;

macro_rules! runner {
    ($module:ident, $parry:ident, $scalar:ty) => {
        mod $module {
            use $parry::math::{Pose, Vector};
            use $parry::query::{ShapeCastOptions, cast_shapes, intersection_test};
            use $parry::shape::{Shape, TriMesh, Triangle};

            /// Returns a function that answers the question.
            pub fn ask(question: &str, x: &[f64], faces: [Vec<[u32; 3]>; 2]) -> Option<Box<dyn Fn() -> Option<(bool, Option<f64>)>>> {
                let points: Vec<Vector> = x.chunks_exact(3).map(|p| Vector::new(p[0] as $scalar, p[1] as $scalar, p[2] as $scalar)).collect();
                let place = Pose::IDENTITY;
                if question == "meshes" {
                    let [first, second] = faces;
                    let count = 1 + first.iter().flatten().max()?;
                    let own = second.iter().map(|face| face.map(|v| v - count)).collect();
                    let (one, other) = points.split_at(count as usize);
                    let [a, b] = [TriMesh::new(one.to_vec(), first).ok()?, TriMesh::new(other.to_vec(), own).ok()?];
                    return Some(Box::new(move || Some((intersection_test(&place, &a, &place, &b).ok()?.intersecting, None))));
                }
                let [a, b] = [0, 3].map(|i| Triangle::new(points[i], points[i + 1], points[i + 2]));
                if question == "triangles" {
                    return Some(Box::new(move || Some((intersection_test(&place, &a, &place, &b).ok()?.intersecting, None))));
                }
                let step = points[6];
                let options = ShapeCastOptions { max_time_of_impact: 1.0, ..Default::default() };
                Some(Box::new(move || {
                    let hit = cast_shapes(&place, Vector::ZERO, &a as &dyn Shape, &place, step, &b, options).ok()?;
                    Some((hit.is_some(), hit.map(|hit| hit.time_of_impact as f64)))
                }))
            }
        }
    };
}
runner!(single, parry3d, f32);
runner!(double, parry3d_f64, f64);

fn answer(line: &str, is_single: bool) -> Option<String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let (question, mut words) = (words[1], &words[3..]);
    let mut faces = [Vec::new(), Vec::new()];
    if question == "meshes" {
        let counts: Vec<usize> = words[..3].iter().map(|word| word.parse().ok()).collect::<Option<_>>()?;
        let (numbers, indices) = words[3..].split_at(words.len() - 3 - 3 * counts[1]);
        let indices: Vec<u32> = indices.iter().map(|word| word.parse().ok()).collect::<Option<_>>()?;
        let all: Vec<[u32; 3]> = indices.chunks_exact(3).map(|face| [face[0], face[1], face[2]]).collect();
        faces = [all[..counts[2]].to_vec(), all[counts[2]..].to_vec()];
        words = numbers;
    }
    let x: Vec<f64> = words.iter().map(|word| hexf_parse::parse_hexf64(word, false).ok()).collect::<Option<_>>()?;
    let ask = if is_single { single::ask(question, &x, faces)? } else { double::ask(question, &x, faces)? };
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
    let is_single = std::env::args().nth(1).as_deref() == Some("f32");
    let mut output = std::io::stdout().lock();
    let mut say = |text: String| writeln!(output, "{text}").and_then(|()| output.flush()).expect("standard output is open");
    say("ready 0.31.1".to_owned());
    for line in std::io::stdin().lock().lines() {
        let line = line.expect("standard input is text");
        let name = line.split(' ').next().unwrap_or_default();
        say(format!("{name} {}", answer(&line, is_single).unwrap_or_else(|| "refused - 0".to_owned())));
    }
}
