//! Measures the time of impact of pairs that slide past each other, by their distance.

mod pairs;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use pairs::{COUNT, sliding};
use selvedge_core::elementary::{Impact, Limits, advance::time_of_impact};
use selvedge_core::{PairKind, Scalar};
use std::hint::black_box;

fn by_distance<S: Scalar>(criterion: &mut Criterion) {
    for (kind, name) in [(PairKind::VertexFace, "vertex_face"), (PairKind::EdgeEdge, "edge_edge")] {
        let mut group = criterion.benchmark_group(format!("sliding/{name}/{}", S::NAME));
        group.throughput(Throughput::Elements(COUNT as u64));
        for exponent in [4, 10, 14, 17, 20, 23] {
            let pairs = sliding::<S>(kind, exponent);
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
