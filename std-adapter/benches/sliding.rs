//! Measures the time of impact of pairs that slide past each other, by their distance.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use fastrand::Rng;
use selvedge_core::elementary::{Impact, Limits, advance::time_of_impact};
use selvedge_core::{Motion, PairKind, PrimitivePair, Scalar};
use std::hint::black_box;

/// The number of pairs in a set: too many for the processor to learn their branches, few enough for the cache.
const COUNT: usize = 1024;

/// Makes a pair from the start and the end of each point, rounded.
fn rounded<S: Scalar>(kind: PairKind, points: [[[f64; 3]; 2]; 4]) -> PrimitivePair<S> {
    let rounded = |position: [f64; 3]| position.map(S::from_f64).into();
    PrimitivePair::new(
        kind,
        points.map(|[start, end]| Motion {
            start: rounded(start),
            end: rounded(end),
        }),
    )
}

/// Makes pairs in which a point of one set begins and ends its way near a corner of the other: within 2 to the power of
/// −`exponent` along each axis. All other coordinates are eighths.
fn sliding_pairs<S: Scalar>(kind: PairKind, exponent: i32) -> Vec<PrimitivePair<S>> {
    let mut random = Rng::with_seed(5);
    let mut within = |limit: f64| limit * (2.0 * random.f64() - 1.0);
    let (mover, corner) = match kind {
        PairKind::VertexFace => (0, 1),
        PairKind::EdgeEdge => (1, 3),
    };
    let distance = 0.5_f64.powi(exponent);
    let mut pair = || {
        let mut points = [(); 4].map(|()| [(); 2].map(|()| [(); 3].map(|()| within(8.0).round() / 8.0)));
        for end in 0..2 {
            points[mover][end] = points[corner][end].map(|x| x + within(distance));
        }
        rounded(kind, points)
    };
    (0..COUNT).map(|_| pair()).collect()
}

fn by_distance<S: Scalar>(criterion: &mut Criterion) {
    for (kind, name) in [(PairKind::VertexFace, "vertex_face"), (PairKind::EdgeEdge, "edge_edge")] {
        let mut group = criterion.benchmark_group(format!("sliding/{name}/{}", S::NAME));
        group.throughput(Throughput::Elements(COUNT as u64));
        for exponent in [4, 10, 14, 17, 20, 23] {
            let pairs = sliding_pairs::<S>(kind, exponent);
            let limits = Limits::default();
            group.bench_function(BenchmarkId::from_parameter(format!("2^-{exponent}")), |bencher| {
                bencher.iter(|| {
                    let apart = |pair: &&_| time_of_impact(black_box(*pair), &limits) == Impact::Never;
                    pairs.iter().filter(apart).count()
                });
            });
        }
    }
}

criterion_group!(benches, by_distance::<f32>, by_distance::<f64>);
criterion_main!(benches);
