//! Measures every batched test and every filter tier. Pairs are in tiles that stay in the first cache, or gathered from a mesh of
//! a million vertices. Run `cargo bench -p selvedge-benches --bench filters`; a further word selects benchmarks, such as
//! `gathered/f32`.
//!
//! Criterion's time per element is the time per pair.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use selvedge_core::PairKind;
use selvedge_core::batch::{BatchTest, LANES, Level, Mask, Test, Tile, VertexRow, culled_from_rows, culled_from_tiles};
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::{Motion, PrimitivePair, Scalar, filter};
use std::hint::black_box;
use std::time::Duration;

/// Two wavy sheets of `side`² vertices each, one above the other, which pass through one another in places. For each square, a
/// vertex of one is paired with a triangle of the other.
struct Sheets<S> {
    rows: Vec<VertexRow<S>>,
    indices: Vec<[u32; 4]>,
}

impl<S: Scalar> Sheets<S> {
    fn new(side: u32) -> Self {
        let mut rows = Vec::new();
        for sheet in 0..2 {
            for i in 0..side {
                for j in 0..side {
                    rows.push(vertex(sheet, f64::from(i), f64::from(j)));
                }
            }
        }
        let mut indices = Vec::new();
        for i in 0..side - 1 {
            for j in 0..side - 1 {
                let here = i * side + j;
                let above = side * side + here;
                indices.push([here, above, above + 1, above + side]);
                indices.push([above + side + 1, here, here + 1, here + side]);
            }
        }
        Self { rows, indices }
    }

    fn pair(&self, indices: [u32; 4]) -> PrimitivePair<S> {
        PrimitivePair::new(PairKind::VertexFace, indices.map(|index| self.rows[index as usize].motion()))
    }
}

/// Returns a vertex of a sheet with edges of about one hundredth; the sheets are half as far apart.
fn vertex<S: Scalar>(sheet: u8, i: f64, j: f64) -> VertexRow<S> {
    let sheet = f64::from(sheet);
    let height = 0.005 * sheet + 0.01 * (0.7 * i + 0.3 * sheet).sin();
    let swing = 0.02 * (1.1 * i + 0.5 * j + sheet).cos();
    let start = [0.01 * i, 0.01 * j, height];
    let end = [0.01 * i + swing, 0.01 * j + 0.3 * swing, height + swing];
    let [start, end] = [start, end].map(|position| position.map(S::from_f64));
    VertexRow::new(Motion {
        start: start.into(),
        end: end.into(),
    })
}

fn levels() -> Vec<(&'static str, Level)> {
    let best = Level::try_detect().unwrap_or(Level::baseline());
    let mut levels = vec![("best", best)];
    #[cfg(target_arch = "x86_64")]
    {
        use fearless_simd::Simd;
        levels.extend(best.as_avx2().map(|token| ("avx2", token.level())));
    }
    levels
}

#[derive(Clone, Copy, PartialEq)]
enum Place {
    /// Tiles, or a list of pairs, that stay in the first cache.
    Cache,
    /// Rows of vertices.
    Mesh,
}

struct Bench<'a, S: Scalar> {
    group: BenchmarkGroup<'a, WallTime>,
    place: Place,
    sheets: Sheets<S>,
    pairs: Vec<PrimitivePair<S>>,
    tiles: Vec<Tile<S>>,
}

impl<S: Scalar> Bench<'_, S> {
    fn batched(&mut self, name: &str, test: impl BatchTest<S>) {
        let Sheets { rows, indices } = &self.sheets;
        let mut masks: Vec<Mask> = vec![0; indices.len().div_ceil(LANES)];
        for (level_name, level) in levels() {
            self.group.bench_function(format!("{name}/{level_name}"), |bencher| {
                bencher.iter(|| {
                    let masks = black_box(&mut masks);
                    if self.place == Place::Cache {
                        let tiles = black_box(&self.tiles);
                        culled_from_tiles(level, PairKind::VertexFace, test, tiles, masks);
                    } else {
                        let (rows, indices) = (black_box(rows), black_box(indices));
                        culled_from_rows(level, PairKind::VertexFace, test, rows, indices, masks);
                    }
                });
            });
        }
        let culled: u32 = masks.iter().map(|mask| mask.count_ones()).sum();
        println!("  culls {:.4} of the pairs", f64::from(culled) / indices.len() as f64);
    }

    fn one_by_one(&mut self, name: &str, culls: impl Fn(&PrimitivePair<S>) -> bool) {
        self.group.bench_function(format!("{name}/one by one"), |bencher| {
            bencher.iter(|| {
                if self.place == Place::Cache {
                    let pairs = black_box(&self.pairs);
                    pairs.iter().filter(|pair| culls(pair)).count()
                } else {
                    let sheets = black_box(&self.sheets);
                    let pairs = sheets.indices.iter().map(|&indices| sheets.pair(indices));
                    pairs.filter(|pair| culls(pair)).count()
                }
            });
        });
    }
}

fn bench<S: Scalar>(criterion: &mut Criterion) {
    // 32 pairs in 2 tiles are 6 kB in f64; 2 · 708² vertices are a million.
    for (place, place_name, side) in [
        (Place::Cache, "cache", 5),
        (Place::Mesh, "rows in cache", 9),
        (Place::Mesh, "gathered", 708),
    ] {
        let sheets = Sheets::<S>::new(side);
        let mut group = criterion.benchmark_group(format!("{place_name}/{}", S::NAME));
        group
            .throughput(Throughput::Elements(sheets.indices.len() as u64))
            .warm_up_time(Duration::from_millis(300))
            .measurement_time(Duration::from_secs(1))
            .sample_size(20);
        let pairs: Vec<_> = sheets.indices.iter().map(|&indices| sheets.pair(indices)).collect();
        let tiles = pairs
            .chunks(LANES)
            .map(|pairs| Tile::new(pairs.iter().map(|pair| pair.motions)))
            .collect();
        let mut bench = Bench {
            group,
            place,
            sheets,
            pairs,
            tiles,
        };
        for (name, test) in [
            ("swept boxes", Test::SweptBoxes),
            ("segment against box", Test::SegmentBox),
            ("relative boxes, three axes", Test::RelativeBoxes),
        ] {
            bench.batched(name, test);
        }
        for (name, tier) in [
            ("permanent", Tier::Permanent),
            ("widened", Tier::Widened),
            ("exact", Tier::Exact),
        ] {
            bench.batched(name, Filter::new(tier));
        }
        let separated = Filter::new(Tier::Permanent).with_separation(S::from_f64(0.001));
        bench.batched("permanent, separation", separated.expect("is finite"));
        bench.one_by_one("permanent", |pair| filter::certified::non_coplanarity(pair).is_culled());
        bench.group.finish();
    }
}

fn both_formats(criterion: &mut Criterion) {
    bench::<f32>(criterion);
    bench::<f64>(criterion);
}

criterion_group!(benches, both_formats);
criterion_main!(benches);
