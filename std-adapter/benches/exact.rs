//! Measures the cost of exact signs for a pair: on pairs that can mostly be culled, on undecided pairs, and on numbers of all
//! sizes.

mod pairs;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use pairs::{COUNT, all_sizes, barely_above, cloth, nearly_coplanar};
use selvedge_core::filter::certified::non_coplanarity;
use selvedge_core::kernels::exact::{UNKNOWN, control_value_signs, is_never_coplanar, is_never_within};
use selvedge_core::{PrimitivePair, Scalar};
use std::hint::black_box;

/// Measures tests by the pair, over all of `pairs`.
fn measure<S: Scalar>(criterion: &mut Criterion, set: &str, pairs: &[PrimitivePair<S>]) {
    let mut group = criterion.benchmark_group(format!("{set}/{}", S::NAME));
    group.throughput(Throughput::Elements(COUNT as u64));
    let mut bench = |name: &str, culls: &dyn Fn(&[PrimitivePair<S>]) -> usize| {
        group.bench_function(name, |bencher| bencher.iter(|| culls(black_box(pairs))));
    };
    macro_rules! count {
        (|$pair:ident| $culls:expr) => {
            &|pairs| pairs.iter().filter(|$pair| $culls).count()
        };
    }
    bench("certified", count!(|pair| non_coplanarity(pair).is_culled()));
    bench("one_sign", count!(|pair| is_never_coplanar(pair, UNKNOWN)));
    bench("all_signs", count!(|pair| control_value_signs(pair).is_some()));
    let separation = S::UNIT_ROUNDOFF;
    bench("separation", count!(|pair| is_never_within(pair, separation, UNKNOWN)));
}

fn sets<S: Scalar>(criterion: &mut Criterion) {
    measure::<S>(criterion, "cloth", &cloth());
    measure::<S>(criterion, "nearly_coplanar", &nearly_coplanar());
    measure::<S>(criterion, "barely_above", &barely_above());
    measure::<S>(criterion, "all_sizes", &all_sizes());
}

criterion_group!(benches, sets::<f32>, sets::<f64>);
criterion_main!(benches);
