//! Counts the instructions of the certified non-coplanarity filter on 32 pairs: one at a time, as tiles, and gathered from rows.
//! Run `../run.sh`.
//!
//! valgrind does not support AVX-512: batches are counted with AVX2 and with the baseline instruction set.

use gungraun::prelude::*;
use selvedge_core::PairKind;
use selvedge_core::batch::{LANES, Level, Mask, Tile, VertexRow, culled_from_rows, culled_from_tiles};
use selvedge_core::filter::certified::non_coplanarity;
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::{Motion, PrimitivePair, Scalar};
use std::hint::black_box;

const PAIRS: usize = 2 * LANES;

/// Vertices above, below and passing through a triangle each.
struct Input<S: Scalar> {
    pairs: Vec<PrimitivePair<S>>,
    tiles: Vec<Tile<S>>,
    rows: Vec<VertexRow<S>>,
    indices: Vec<[u32; 4]>,
    level: Level,
}

fn input<S: Scalar>(level: Level) -> Input<S> {
    let motion = |start: [f64; 3], end: [f64; 3]| {
        let [start, end] = [start, end].map(|position| position.map(S::from_f64).into());
        Motion { start, end }
    };
    let pairs: Vec<_> = (0..PAIRS)
        .map(|k| {
            let height = 0.07 * k as f64 - 1.0;
            PrimitivePair::vertex_face(
                motion([0.2, 0.3, height], [0.3, 0.2, 0.5 * height + 0.2]),
                [
                    motion([0.0, 0.0, 0.01], [0.1, 0.0, 0.0]),
                    motion([1.0, 0.0, 0.0], [1.0, 0.1, 0.02]),
                    motion([0.0, 1.0, 0.0], [0.0, 1.1, 0.0]),
                ],
            )
        })
        .collect();
    let tiles = pairs
        .chunks(LANES)
        .map(|pairs| Tile::new(pairs.iter().map(|pair| pair.motions)))
        .collect();
    let rows = pairs.iter().flat_map(|pair| pair.motions.map(VertexRow::new)).collect();
    let indices = (0..PAIRS as u32).map(|k| [4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3]).collect();
    Input {
        pairs,
        tiles,
        rows,
        indices,
        level,
    }
}

fn best<S: Scalar>() -> Input<S> {
    input(Level::try_detect().unwrap_or(Level::baseline()))
}

fn baseline<S: Scalar>() -> Input<S> {
    input(Level::baseline())
}

fn count_one_by_one<S: Scalar>(input: &Input<S>) -> usize {
    let pairs = black_box(&input.pairs);
    pairs.iter().filter(|pair| non_coplanarity(*pair).is_culled()).count()
}

fn count_tiles<S: Scalar>(input: &Input<S>) -> [Mask; 2] {
    let mut masks = [0; 2];
    let tiles = black_box(&input.tiles);
    let test = Filter::new(Tier::Permanent);
    culled_from_tiles(input.level, PairKind::VertexFace, test, tiles, &mut masks);
    masks
}

fn count_rows<S: Scalar>(input: &Input<S>) -> [Mask; 2] {
    let mut masks = [0; 2];
    let (rows, indices) = (black_box(&input.rows), black_box(&input.indices));
    let test = Filter::new(Tier::Permanent);
    culled_from_rows(input.level, PairKind::VertexFace, test, rows, indices, &mut masks);
    masks
}

macro_rules! benches {
    ($one:ident, $tiles:ident, $rows:ident, $scalar:ty) => {
        #[library_benchmark]
        #[bench::pairs_32(best())]
        fn $one(input: Input<$scalar>) -> usize {
            black_box(count_one_by_one(&input))
        }

        #[library_benchmark]
        #[bench::baseline(baseline())]
        #[bench::best(best())]
        fn $tiles(input: Input<$scalar>) -> [Mask; 2] {
            black_box(count_tiles(&input))
        }

        #[library_benchmark]
        #[bench::baseline(baseline())]
        #[bench::best(best())]
        fn $rows(input: Input<$scalar>) -> [Mask; 2] {
            black_box(count_rows(&input))
        }
    };
}

benches!(one_by_one_f32, tiles_f32, rows_f32, f32);
benches!(one_by_one_f64, tiles_f64, rows_f64, f64);

library_benchmark_group!(
    name = certified_filter,
    benchmarks = [one_by_one_f32, tiles_f32, rows_f32, one_by_one_f64, tiles_f64, rows_f64]
);

main!(library_benchmark_groups = certified_filter);
