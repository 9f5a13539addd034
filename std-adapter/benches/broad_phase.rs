//! Broad phase against parry3d's `Bvh`: milliseconds to build, to refit, and to list all pairs in order.
//!
//! `cargo bench -p selvedge-benches --bench broad_phase` runs on generated tubes. `SELVEDGE_BENCH_BOXES=FILE` runs on boxes
//! from a file instead: six little-endian `f32` each, the lower corner, then the upper.

use std::hint::black_box;
use std::time::Instant;

use parry3d::bounding_volume::Aabb;
use parry3d::math::Vector;
use parry3d::partitioning::{Bvh, BvhBuildStrategy, BvhWorkspace};
use selvedge_laboratory::broad_phase::{BroadPhase, SweptBox};

fn main() {
    println!(
        "{:>9} {:>10} {:<16} {:>8} {:>8} {:>8}",
        "triangles", "pairs", "", "build", "refit", "pairs"
    );
    if let Some(path) = std::env::var_os("SELVEDGE_BENCH_BOXES") {
        measure(&read_boxes(&std::fs::read(path).expect("a readable file")));
    } else {
        for rings in [26, 82, 259, 818] {
            measure(&tube(rings, 0.0));
        }
    }
}

fn measure(boxes: &[SweptBox]) {
    let repeats = (4_000_000 / boxes.len()).clamp(3, 100);
    let mut pairs = Vec::new();
    for threads in [1, 2] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        let figures = pool.install(|| measure_ours(boxes, repeats, &mut pairs));
        print_row(boxes.len(), pairs.len(), &format!("ours, threads: {threads}"), figures);
    }
    for (name, strategy) in [
        ("parry3d binned", BvhBuildStrategy::Binned),
        ("parry3d PLOC", BvhBuildStrategy::Ploc),
    ] {
        let mut same = Vec::new();
        let figures = measure_parry(boxes, repeats, strategy, &mut same);
        print_row(boxes.len(), same.len(), name, figures);
        assert!(same == pairs, "parry3d finds other pairs");
    }
}

fn print_row(triangles: usize, pairs: usize, name: &str, [build, refit, traverse]: [f64; 3]) {
    println!("{triangles:>9} {pairs:>10} {name:<16} {build:>8.3} {refit:>8.3} {traverse:>8.3}");
}

fn measure_ours(boxes: &[SweptBox], repeats: usize, pairs: &mut Vec<[u32; 2]>) -> [f64; 3] {
    let build = shortest(repeats.min(10), || {
        let mut broad_phase = BroadPhase::new();
        broad_phase.update(boxes);
        black_box(&broad_phase);
    });
    let mut broad_phase = BroadPhase::new();
    broad_phase.update(boxes);
    let refit = shortest(repeats, || broad_phase.update(boxes));
    let traverse = shortest(repeats, || broad_phase.candidate_triangle_pairs(pairs));
    [build, refit, traverse]
}

/// Prints what it takes to put parry3d's pairs in order, as ours are, in a line of its own.
fn measure_parry(boxes: &[SweptBox], repeats: usize, strategy: BvhBuildStrategy, pairs: &mut Vec<[u32; 2]>) -> [f64; 3] {
    let boxes: Vec<Aabb> = boxes
        .iter()
        .map(|b| Aabb::new(Vector::from_array(b.lower), Vector::from_array(b.upper)))
        .collect();
    let build = shortest(repeats.min(10), || {
        black_box(Bvh::from_leaves(strategy, &boxes));
    });
    let mut bvh = Bvh::from_leaves(strategy, &boxes);
    let mut workspace = BvhWorkspace::default();
    bvh.refit(&mut workspace);
    let refit = shortest(repeats, || {
        for (index, aabb) in (0..).zip(&boxes) {
            bvh.insert_or_update_partially(*aabb, index, 0.0);
        }
        bvh.refit_without_opt();
    });
    let traverse = shortest(repeats, || {
        pairs.clear();
        bvh.traverse_bvtt_single_tree::<false>(&mut workspace, &mut |a, b| {
            pairs.push([a.min(b), a.max(b)]);
        });
    });
    let sort = shortest(1, || pairs.sort_unstable());
    println!("{:>20} {:<16} {sort:>26.3}", "", "  to sort them");
    [build, refit, traverse]
}

/// The shortest of several runs, in milliseconds.
fn shortest(repeats: usize, mut action: impl FnMut()) -> f64 {
    let mut best = f64::INFINITY;
    for _ in 0..repeats {
        let start = Instant::now();
        action();
        best = best.min(start.elapsed().as_secs_f64() * 1e3);
    }
    best
}

fn read_boxes(bytes: &[u8]) -> Vec<SweptBox> {
    let (numbers, _) = bytes.as_chunks::<4>();
    let numbers: Vec<f32> = numbers.iter().map(|bytes| f32::from_le_bytes(*bytes)).collect();
    let (boxes, _) = numbers.as_chunks::<6>();
    boxes
        .iter()
        .map(|&[x, y, z, u, v, w]| SweptBox {
            lower: [x, y, z],
            upper: [u, v, w],
        })
        .collect()
}

/// A crumpled tube of `rings` rings of as many points, moving by about an edge length.
fn tube(rings: usize, phase: f32) -> Vec<SweptBox> {
    let edge = std::f32::consts::TAU / rings as f32;
    let point = |ring: usize, around: usize, time: f32| {
        let angle = edge * (around % rings) as f32;
        let along = edge * ring as f32;
        let radius = 1.0 + 0.1 * (7.0 * angle + phase + time).sin() * (11.0 * along).cos();
        [
            radius * angle.cos(),
            radius * angle.sin(),
            along + 0.05 * (5.0 * angle - 3.0 * phase).sin() + time,
        ]
    };
    let mut boxes = Vec::new();
    for ring in 0..rings {
        for around in 0..rings {
            let corners = [(ring, around), (ring, around + 1), (ring + 1, around), (ring + 1, around + 1)];
            for triangle in [[0, 1, 2], [1, 3, 2]] {
                let points = triangle.iter().flat_map(|&corner| {
                    let (ring, around) = corners[corner];
                    [point(ring, around, 0.0), point(ring, around, edge)]
                });
                let empty = SweptBox {
                    lower: [f32::INFINITY; 3],
                    upper: [f32::NEG_INFINITY; 3],
                };
                boxes.push(points.fold(empty, |swept, point| SweptBox {
                    lower: std::array::from_fn(|k| swept.lower[k].min(point[k])),
                    upper: std::array::from_fn(|k| swept.upper[k].max(point[k])),
                }));
            }
        }
    }
    boxes
}
