//! The hard cases of the literature by name, rebuilt from their geometry, with exact answers.
//!
//! `std-adapter/laboratory/data/hard-cases.csv`, which `selvedge hard-cases` reads, is what [`table`] writes; a test demands it. Answers are
//! the [`oracle`](crate::oracle)'s; where a case is placed exactly, its answer must be the one that its geometry says.

use crate::generator::{Format, PairCase};
use crate::oracle::collides;
use rug::Rational;
use selvedge_core::PairKind;
use std::fmt::Write;

/// One case, before it is placed.
struct Shape {
    name: &'static str,
    pair: PairCase<f64>,
    first: First,
}

/// What the geometry says.
#[derive(Clone, Copy)]
enum First {
    Never,
    At(u32, u32),
    Irrational,
    /// Neither: a coordinate is not a number or infinite.
    Undefined,
}

/// Where and how large: a map of positions.
struct Placement {
    name: &'static str,
    /// Whether it rounds nothing, so that answers stay.
    is_exact: bool,
    place: fn([f64; 3]) -> [f64; 3],
}

/// 2⁻²⁰ and 2¹³.
const MICROMETRE: f64 = 1.0 / (1 << 20) as f64;
const FAR: f64 = 1e7;

/// Powers of two of the shape's size, and whole numbers as its place, round nothing for shapes of a few bits.
const PLACEMENTS: [Placement; 6] = [
    Placement {
        name: "1 m",
        is_exact: true,
        place: |x| x,
    },
    Placement {
        name: "1 um",
        is_exact: true,
        place: |x| x.map(|x| x * MICROMETRE),
    },
    Placement {
        name: "10 km",
        is_exact: true,
        place: |x| x.map(|x| x * 8192.0),
    },
    Placement {
        name: "1 m, far",
        is_exact: true,
        place: |[x, y, z]| [x + FAR, y - FAR, z + FAR],
    },
    Placement {
        name: "1 um, far",
        is_exact: true,
        place: |[x, y, z]| [x * MICROMETRE + FAR, y * MICROMETRE - FAR, z * MICROMETRE + FAR],
    },
    // Turned by a matrix of thirds: whatever touched does so but for rounding.
    Placement {
        name: "1 m, turned",
        is_exact: false,
        place: |[x, y, z]| {
            [
                (x + 2.0 * y + 2.0 * z) / 3.0,
                (2.0 * x + y - 2.0 * z) / 3.0,
                (2.0 * x - 2.0 * y + z) / 3.0,
            ]
        },
    },
];

type Ends = [[f64; 3]; 2];

fn rests(position: [f64; 3]) -> Ends {
    [position; 2]
}

fn moves([x, y, z]: [f64; 3], by: [f64; 3]) -> Ends {
    [[x, y, z], [x + by[0], y + by[1], z + by[2]]]
}

/// Corners of a floor.
const FLOOR: [Ends; 3] = [[[0.0, 0.0, 0.0]; 2], [[4.0, 0.0, 0.0]; 2], [[0.0, 4.0, 0.0]; 2]];

/// From 1 above to 1 below.
const FALL: [f64; 3] = [0.0, 0.0, -2.0];

/// Lifted by 1, falling by 2: at half the step it is where it is given.
fn falls([x, y, z]: [f64; 3]) -> Ends {
    moves([x, y, z + 1.0], FALL)
}

/// Shapes that are placed at every size and place.
fn shapes() -> Vec<Shape> {
    let mut shapes = Vec::new();
    let mut vf = |name, vertex: Ends, face: [Ends; 3], first| {
        let [a, b, c] = face;
        let pair = PairCase::new(PairKind::VertexFace, [vertex, a, b, c]);
        shapes.push(Shape { name, pair, first });
    };
    let half = First::At(1, 2);

    vf("vertex falls through a face", falls([1.0, 1.0, 0.0]), FLOOR, half);
    vf("vertex falls onto a corner", falls([0.0, 0.0, 0.0]), FLOOR, half);
    vf("vertex falls onto a side", falls([2.0, 2.0, 0.0]), FLOOR, half);
    vf("vertex falls past a side", falls([2.25, 2.0, 0.0]), FLOOR, First::Never);
    vf(
        "contact at t = 0",
        moves([1.0, 1.0, 0.0], [0.0, 0.0, 2.0]),
        FLOOR,
        First::At(0, 1),
    );
    vf("contact at t = 1", moves([1.0, 1.0, 2.0], FALL), FLOOR, First::At(1, 1));
    let short = 0.5_f64.powi(8);
    vf(
        "stops short of the face",
        moves([1.0, 1.0, 2.0 + short], FALL),
        FLOOR,
        First::Never,
    );
    vf("no motion, touching", rests([1.0, 1.0, 0.0]), FLOOR, First::At(0, 1));
    vf("no motion, apart", rests([1.0, 1.0, 0.25]), FLOOR, First::Never);
    vf(
        "coplanar throughout, slides in",
        moves([-2.0, 1.0, 0.0], [4.0, 0.0, 0.0]),
        FLOOR,
        half,
    );
    vf(
        "coplanar throughout, slides past",
        moves([-2.0, 4.5, 0.0], [4.0, 0.0, 0.0]),
        FLOOR,
        First::Never,
    );
    vf("shared vertex", FLOOR[0], FLOOR, First::At(0, 1));
    let together = |position| moves(position, [3.0, -1.0, 0.5]);
    let floor_together = FLOOR.map(|[start, _]| together(start));
    vf(
        "together in contact",
        together([1.0, 1.0, 0.0]),
        floor_together,
        First::At(0, 1),
    );
    vf("together apart", together([1.0, 1.0, 0.25]), floor_together, First::Never);
    let segment = [0.0, 1.0, 2.0].map(|x| rests([x, 0.0, 0.0]));
    vf("zero-area triangle, a segment", falls([0.5, 0.0, 0.0]), segment, half);
    vf("zero-area triangle, missed", falls([0.5, 0.25, 0.0]), segment, First::Never);
    vf("zero-area triangle, a point", falls([0.0; 3]), [rests([0.0; 3]); 3], half);
    let closing = [rests([0.0; 3]), rests([2.0, 0.0, 0.0]), [[0.0, 2.0, 0.0], [0.0; 3]]];
    vf(
        "face closes to zero area",
        [[1.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
        closing,
        First::At(1, 1),
    );
    // K = 8(t - 1/2)^2 + a multiple of the height.
    let tipping = [rests([0.0; 3]), [[4.0, 0.0, -1.0], [4.0, 0.0, 1.0]], rests([0.0, 4.0, 0.0])];
    let graze = |z: f64| [[0.5, 0.5, z], [-0.5, 0.5, z]];
    vf("double root, grazes", graze(0.0), tipping, half);
    vf("double root, just apart", graze(short), tipping, First::Never);
    vf("two roots close together", graze(-1.0 / 128.0), tipping, First::At(3, 8));
    let gather = |[x, y, z]: [f64; 3]| [[x, y, z], [-x, -y, -z]];
    let [p, a, b, c] = [[1.0, 2.0, 3.0], [-2.0, 1.0, 0.5], [0.25, -1.0, 4.0], [3.0, 3.0, -1.0]].map(gather);
    vf("triple root, all meet", p, [a, b, c], half);
    // The vertex (t, 1/2) meets the segment from (0, 0) to (1, t) at t = 1/sqrt(2).
    let side = [[1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    vf(
        "irrational time",
        [[0.0, 0.5, 0.0], [1.0, 0.5, 0.0]],
        [rests([0.0; 3]), side, side],
        First::Irrational,
    );
    vf(
        "tiny motion into contact",
        [[1.0, 1.0, short], [1.0, 1.0, -short]],
        FLOOR,
        half,
    );
    vf("large motion through", [[1.0, 1.0, 512.0], [1.0, 1.0, -512.0]], FLOOR, half);

    // Erleben's shapes. A spike points down, its slopes are 1/2; a wedge's ridge runs along y.
    let apex = [0.0, 0.0, 0.0];
    let spike_face = [apex, [1.0, 1.0, -2.0], [-1.0, 1.0, -2.0]].map(rests);
    let wedge_face = [[0.0, -2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 2.0, -2.0]].map(rests);
    vf("spikes: apex on apex", falls(apex), spike_face, half);
    vf("spike on wedge: apex on ridge", falls(apex), wedge_face, half);
    let fall_far = |[x, y, z]: [f64; 3]| moves([x, y, z + 1.0], [0.0, 0.0, -4.0]);
    let spike_side = [apex, [1.0, 1.0, 2.0], [-1.0, 1.0, 2.0]].map(fall_far);
    vf(
        "spike in a hole: rim corner on side",
        rests([0.5, 0.5, 0.0]),
        spike_side,
        half,
    );
    vf("spike in a crack: rim on side", rests([0.25, 0.5, 0.0]), spike_side, half);
    let wedge_side = [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 2.0]].map(fall_far);
    vf("wedge in a crack: rim on side", rests([0.5, 0.5, 0.0]), wedge_side, half);
    vf("wedges: ridge end on side", falls([0.5, 1.0, -1.0]), wedge_face, half);
    let slide = [8.0, 0.0, 0.0];
    vf(
        "sliding spike: apex over a side",
        moves([-3.0, 1.0, 0.0], slide),
        FLOOR,
        First::At(3, 8),
    );
    vf(
        "sliding wedge: ridge end over a side",
        moves([-3.0, 2.0, 0.0], slide),
        FLOOR,
        First::At(3, 8),
    );
    vf("cliff edges: corner on the brink", falls([0.0, 2.0, 0.0]), FLOOR, half);
    vf(
        "cliff edges: corner beyond the brink",
        falls([-0.25, 2.0, 0.0]),
        FLOOR,
        First::Never,
    );
    vf("internal edges: corner on an edge", falls([2.0, 2.0, 0.0]), FLOOR, half);

    let mut ee = |name, first: [Ends; 2], second: [Ends; 2], when| {
        let ([u, v], [k, l]) = (first, second);
        let pair = PairCase::new(PairKind::EdgeEdge, [u, v, k, l]);
        shapes.push(Shape { name, pair, first: when });
    };
    let along_x = [rests([-1.0, 0.0, 0.0]), rests([1.0, 0.0, 0.0])];
    let along_y = |z: f64| [[0.0, -1.0, z], [0.0, 1.0, z]];
    ee("edges cross", along_x, along_y(0.0).map(falls), half);
    ee(
        "edges pass at a distance",
        along_x,
        along_y(1.0).map(|x| moves(x, [0.5, 0.0, -0.75])),
        First::Never,
    );
    ee(
        "edges meet at t = 0",
        along_x,
        along_y(0.0).map(|x| moves(x, [0.0, 0.0, 1.0])),
        First::At(0, 1),
    );
    ee(
        "edges meet at t = 1",
        along_x,
        along_y(2.0).map(|x| moves(x, FALL)),
        First::At(1, 1),
    );
    ee(
        "edges stop short",
        along_x,
        along_y(2.0 + short).map(|x| moves(x, FALL)),
        First::Never,
    );
    ee(
        "parallel edges fall on each other",
        along_x,
        [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0]].map(falls),
        half,
    );
    ee(
        "parallel edges slide past",
        along_x,
        [[-1.0, 0.25, 0.0], [1.0, 0.25, 0.0]].map(|x| moves(x, [2.0, 0.0, 0.0])),
        First::Never,
    );
    ee(
        "collinear edges slide together",
        along_x,
        [[3.0, 0.0, 0.0], [5.0, 0.0, 0.0]].map(|x| moves(x, [-4.0, 0.0, 0.0])),
        half,
    );
    ee(
        "collinear edges stop short",
        along_x,
        [[3.0, 0.0, 0.0], [5.0, 0.0, 0.0]].map(|x| moves(x, [-2.0 + short, 0.0, 0.0])),
        First::Never,
    );
    ee(
        "edges end on end",
        along_x,
        [[1.0, 0.0, 0.0], [1.0, 2.0, 1.0]].map(falls),
        half,
    );
    ee(
        "shared vertex of edges",
        along_x,
        [along_x[0], rests([0.0, 1.0, 1.0])],
        First::At(0, 1),
    );
    ee(
        "zero-length edge falls on an edge",
        along_x,
        [[0.5, 0.0, 0.0]; 2].map(falls),
        half,
    );
    ee(
        "zero-length edge falls past",
        along_x,
        [[0.5, 0.25, 0.0]; 2].map(falls),
        First::Never,
    );
    let run = |x: f64| [[[-x, 0.0, 0.0], [x, 0.0, 0.0]]; 2];
    ee("zero-length edges meet", run(1.0), run(-1.0), half);
    // With s = 1 - 2t the second edge passes the first at height s^2 + gap.
    let turning = |gap: f64| {
        let at = |s: f64| [[0.0, -1.0 - s, gap - s], [0.0, 1.0 - s, gap + s]];
        let ([k0, l0], [k1, l1]) = (at(1.0), at(-1.0));
        [[k0, k1], [l0, l1]]
    };
    ee("edges graze, double root", along_x, turning(0.0), half);
    ee("edges graze, just apart", along_x, turning(short), First::Never);
    ee("edges cross twice", along_x, turning(-0.25), First::At(1, 4));
    ee("edges, triple root, all meet", [p, a], [b, c], half);
    ee(
        "edges coplanar throughout, meet",
        along_x,
        [[3.0, -1.0, 0.0], [3.0, 1.0, 0.0]].map(|x| moves(x, [-4.0, 0.0, 0.0])),
        half,
    );
    ee(
        "edges together in contact",
        along_x.map(|[x, _]| together(x)),
        along_y(0.0).map(together),
        First::At(0, 1),
    );

    let spike_edge = [apex, [1.0, 1.0, 2.0]];
    let ridge = [rests([0.0, -2.0, 0.0]), rests([0.0, 2.0, 0.0])];
    ee(
        "spikes: edge on edge at the apexes",
        spike_edge.map(falls),
        [apex, [1.0, -1.0, -2.0]].map(rests),
        half,
    );
    ee("spike on wedge: edge on ridge", spike_edge.map(falls), ridge, half);
    let rim = [rests([-0.5, 0.5, 0.0]), rests([0.5, 0.5, 0.0])];
    ee("spike in a hole: edge on rim corner", spike_edge.map(fall_far), rim, half);
    let crack = [rests([0.5, -2.0, 0.0]), rests([0.5, 2.0, 0.0])];
    ee("spike in a crack: edge on rim", spike_edge.map(fall_far), crack, half);
    ee(
        "wedge in a crack: edge on rim",
        [[0.0, 1.0, 0.0], [1.0, 1.0, 2.0]].map(fall_far),
        crack,
        half,
    );
    ee(
        "wedge in a crack: ridge in the gap",
        [[0.0, -1.0, 0.0], [0.0, 1.0, 0.0]].map(fall_far),
        crack,
        First::Never,
    );
    ee(
        "wedges: ridges cross",
        [[-1.0, 0.5, 0.0], [1.0, 0.5, 0.0]].map(falls),
        ridge,
        half,
    );
    ee(
        "wedges: ridges parallel",
        [[0.0, -1.0, 0.0], [0.0, 3.0, 0.0]].map(falls),
        ridge,
        half,
    );
    let internal = [rests([0.0, 0.0, 0.0]), rests([0.0, 4.0, 0.0])];
    let diagonal = [rests([0.0, 0.0, 0.0]), rests([4.0, 4.0, 0.0])];
    let slid = |x: [f64; 3]| moves(x, slide);
    ee(
        "sliding spike: edge over an edge",
        [[-3.0, 1.0, 0.0], [-2.0, 2.0, 2.0]].map(slid),
        internal,
        First::At(3, 8),
    );
    ee(
        "sliding wedge: ridge over a parallel",
        [[-3.0, 1.0, 0.0], [-3.0, 2.0, 0.0]].map(slid),
        internal,
        First::At(3, 8),
    );
    ee(
        "sliding wedge: ridge over a diagonal",
        [[-3.0, 1.0, 0.0], [-3.0, 2.0, 0.0]].map(slid),
        diagonal,
        half,
    );
    ee(
        "cliff edges: edge across the brink",
        [[-1.0, 2.0, 0.0], [1.0, 2.0, 0.0]].map(falls),
        internal,
        half,
    );
    ee(
        "cliff edges: edge along the brink",
        [[0.0, 1.0, 0.0], [0.0, 6.0, 0.0]].map(falls),
        internal,
        half,
    );
    ee(
        "internal edges: edge along an edge",
        [[1.0, 1.0, 0.0], [3.0, 3.0, 0.0]].map(falls),
        diagonal,
        half,
    );
    ee(
        "internal edges: edge on a vertex",
        [[-1.0, 0.0, 0.0], [1.0, 0.0, 0.0]].map(falls),
        diagonal,
        half,
    );
    shapes
}

/// Shapes whose size is the point: not placed anywhere else.
fn extremes() -> Vec<(&'static str, Shape)> {
    let scaled = |name, factor: f64, fall: [f64; 2], first| {
        let [a, b, c] = FLOOR.map(|ends| ends.map(|x| x.map(|x| x * factor)));
        let vertex = fall.map(|z| [factor, factor, z * factor]);
        let pair = PairCase::new(PairKind::VertexFace, [vertex, a, b, c]);
        Shape { name, pair, first }
    };
    let crossing = |name, factor: f64, fall: [f64; 2], first| {
        let x = |x: f64| [[x * factor, 0.0, 0.0]; 2];
        let y = |y: f64| fall.map(|z| [0.0, y * factor, z * factor]);
        let pair = PairCase::new(PairKind::EdgeEdge, [x(-1.0), x(1.0), y(-1.0), y(1.0)]);
        Shape { name, pair, first }
    };
    let (subnormal, huge) = (f64::from_bits(1), f64::MAX / 8.0);
    let half = First::At(1, 2);
    let mut extremes = Vec::new();
    for (place, factor) in [("2^-1074", subnormal), ("2^-1021", 2.0 * f64::MIN_POSITIVE), ("2^1021", huge)] {
        extremes.push((place, scaled("vertex falls through a face", factor, [1.0, -1.0], half)));
        extremes.push((place, scaled("vertex stops above a face", factor, [3.0, 1.0], First::Never)));
        extremes.push((place, crossing("edges cross", factor, [1.0, -1.0], half)));
        extremes.push((place, crossing("edges pass at a distance", factor, [3.0, 1.0], First::Never)));
    }
    // A subnormal height over a face of everyday size, and over the largest.
    for (place, factor) in [("1 m", 1.0), ("2^1021", huge)] {
        let short = subnormal / factor;
        if short > 0.0 {
            extremes.push((place, scaled("stops 2^-1074 short", factor, [1.0, short], First::Never)));
        }
        let mut thin = scaled("falls from 2^-1074", factor, [1.0, -1.0], half);
        (thin.pair.points[0][0][2], thin.pair.points[0][1][2]) = (subnormal, -subnormal);
        extremes.push((place, thin));
    }
    for (place, value) in [
        ("NaN", f64::NAN),
        ("infinity", f64::INFINITY),
        ("-infinity", f64::NEG_INFINITY),
    ] {
        let mut shape = scaled("vertex from far away", 1.0, [9.0, 8.0], First::Undefined);
        shape.pair.points[0][0][2] = value;
        extremes.push((place, shape));
        let mut shape = crossing("edge from far away", 1.0, [9.0, 8.0], First::Undefined);
        shape.pair.points[3][1][1] = value;
        extremes.push((place, shape));
    }
    extremes
}

/// The file's text.
///
/// # Panics
/// If a case that is placed exactly does not have the answer that its geometry says.
#[must_use]
pub fn table() -> String {
    let mut text = "\
# Hard cases of continuous collision detection, with exact answers. Written by verification/src/hard_cases.rs; a test there
# demands that it is what it gives, and that the answers are those of exact rational arithmetic on the numbers below.
#
# first: the time of first contact in [0, 1], exact if it is a ratio of small numbers; never; or undefined, where a coordinate is
# not finite and nothing may be excluded. from, to: two f64 that enclose it, equal if it is an f64.
# Points at the start of the step, then at its end: vertex and face, or the ends of the first and of the second edge.
"
    .to_owned();
    let points = ["0", "1"].iter().flat_map(|end| {
        ["a", "b", "c", "d"]
            .iter()
            .flat_map(move |point| ["x", "y", "z"].map(|axis| format!("{point}{end}{axis}")))
    });
    let columns = ["name", "placement", "kind", "first", "from", "to"].map(str::to_owned);
    let header: Vec<String> = columns.into_iter().chain(points).collect();
    text += &(header.join(",") + "\n");
    for shape in shapes() {
        for placement in &PLACEMENTS {
            let pair = shape.pair.with_positions(placement.place);
            row(
                &mut text,
                shape.name,
                placement.name,
                &pair,
                placement.is_exact.then_some(shape.first),
            );
        }
    }
    for (place, shape) in extremes() {
        row(&mut text, shape.name, place, &shape.pair, Some(shape.first));
    }
    text
}

fn row(text: &mut String, name: &str, placement: &str, pair: &PairCase<f64>, expected: Option<First>) {
    let kind = pair.kind;
    let (first, from, to) = answer(pair, expected, name, placement);
    write!(text, "\"{name}\",\"{placement}\",{kind},{first},{from},{to}").expect("a string has room");
    for end in 0..2 {
        for coordinate in pair.points.iter().flat_map(|point| point[end]) {
            write!(text, ",{coordinate:?}").expect("a string has room");
        }
    }
    text.push('\n');
}

fn answer(pair: &PairCase<f64>, expected: Option<First>, name: &str, placement: &str) -> (String, String, String) {
    let nothing = |word: &str| (word.to_owned(), String::new(), String::new());
    if !pair.is_finite() {
        assert!(matches!(expected, Some(First::Undefined)), "{name}, {placement}");
        return nothing("undefined");
    }
    let contact = collides(&pair.question());
    match (expected, &contact) {
        (None, _) | (Some(First::Never), None) => {}
        (Some(First::At(p, q)), Some(time)) => {
            assert_eq!(time.as_rational(), Some(&Rational::from((p, q))), "{name}, {placement}");
        }
        (Some(First::Irrational), Some(time)) => {
            assert_eq!(time.as_rational(), None, "{name}, {placement}");
        }
        (_, contact) => panic!("{name}, {placement}: {contact:?}"),
    }
    let Some(time) = contact else {
        return nothing("never");
    };
    let from = time.to_f64_down();
    let to = if time.cmp_f64(from).is_eq() { from } else { from.up() };
    let first = match time.as_rational() {
        Some(ratio) if *ratio.denom() < 1000 => ratio.to_string(),
        Some(_) => format!("about {from:.6}"),
        None => format!("irrational {from:.6}"),
    };
    (first, format!("{from:?}"), format!("{to:?}"))
}
