//! Times and counts filters on one set of pairs in one format.

use super::{AccuracyRow, AccuracySet, BackendTime, BackendsDisagree, PairSet};
use crate::methods::{MeasuredFilter, WithLanes, WithTest};
use selvedge::simd::{Level, available_levels};
use selvedge_core::PairKind;
use selvedge_core::batch::{BatchTest, LANES, Mask, Tile, VertexRow, culled_from_rows, culled_from_tiles};
use selvedge_core::kernels::exact;
use selvedge_core::{PrimitivePair, Scalar};
use std::hint::black_box;
use std::time::Instant;

/// The number of pairs that are tested together. Rows of pairs that share none take 512 kB in `f64`, which stays in a core's own
/// cache. Reading the clock, about 25 ns, is short compared with the fastest filter's 2 µs.
const CHUNK: usize = 2048;
/// The approximate number of timed pairs in a set, in evenly spaced chunks. All pairs are counted.
const TIMED: usize = 50_000;
/// The number of pairs of each timed chunk that are also tested as tiles: 24 kB in `f64`, which stays in the first cache.
const TILED: usize = 128;
/// The number of repetitions of these, so that reading the clock does not matter.
const TILED_PASSES: usize = 32;

/// Runs every filter on `set` in the format `S`, `repeat` times.
pub(super) fn measure<S: Scalar>(
    set: &PairSet,
    repeat: u32,
    separation: f64,
    progress: &mut dyn FnMut(f64),
) -> Result<AccuracySet, BackendsDisagree> {
    let separation = S::from_f64(separation);
    let rows = set.rows::<S>();
    let mut filters: Vec<Measurement<S>> = MeasuredFilter::ALL
        .into_iter()
        .filter_map(|filter| Measurement::new(filter, separation))
        .collect();
    let mut cullable = 0;
    let mut timed = 0;
    let mut done = 0;
    let timed_every = (set.pairs() / TIMED).max(1);
    let mut chunk = 0;
    for (kind, indices) in set.by_kind() {
        for indices in indices.chunks(CHUNK) {
            let pairs = Pairs {
                kind,
                rows: &rows,
                indices,
            };
            let exact = pairs.exact_masks(separation);
            cullable += ones(&exact);
            let masks = filters.iter_mut().map(|filter| filter.count(&pairs, &exact));
            let masks: Vec<_> = masks.collect();
            if chunk % timed_every == 0 {
                timed += indices.len();
                let tiles = pairs.tiles();
                for (filter, masks) in filters.iter_mut().zip(&masks) {
                    filter.time(&pairs, &tiles, masks, repeat)?;
                }
            }
            chunk += 1;
            done += indices.len();
            progress(done as f64 / set.pairs() as f64);
        }
    }
    Ok(AccuracySet {
        name: set.name.clone(),
        scalar: S::NAME,
        vertex_face: set.vertex_face.len(),
        edge_edge: set.edge_edge.len(),
        drawn_from: set.drawn_from,
        timed,
        cullable,
        rows: filters.into_iter().map(|filter| filter.row(timed)).collect(),
    })
}

/// The pairs of one kind, in the form of the pipeline.
struct Pairs<'a, S> {
    kind: PairKind,
    rows: &'a [VertexRow<S>],
    indices: &'a [[u32; 4]],
}

impl<S: Scalar> Pairs<'_, S> {
    fn mask_count(&self) -> usize {
        self.indices.len().div_ceil(LANES)
    }

    #[inline(always)]
    fn pair(&self, indices: [u32; 4]) -> PrimitivePair<S> {
        PrimitivePair::new(self.kind, indices.map(|index| self.rows[index as usize].motion()))
    }

    /// Returns the pairs that exact arithmetic culls.
    fn exact_masks(&self, separation: S) -> Vec<Mask> {
        let mut masks = vec![0; self.mask_count()];
        OneByOne(self, &mut masks).with(|pair| exact::is_never_within(pair, separation, exact::UNKNOWN));
        masks
    }

    /// Returns the first pairs as tiles.
    fn tiles(&self) -> Vec<Tile<S>> {
        let tiled = &self.indices[..self.indices.len().min(TILED)];
        let tiles = tiled
            .chunks(LANES)
            .map(|indices| Tile::new(indices.iter().map(|&indices| self.pair(indices).motions)));
        tiles.collect()
    }
}

/// A writer of masks with the verdicts on pairs that are made from their rows one by one.
struct OneByOne<'a, S: Scalar>(&'a Pairs<'a, S>, &'a mut [Mask]);

impl<S: Scalar> WithTest<S, bool> for OneByOne<'_, S> {
    type Outcome = ();

    #[inline(always)]
    fn with(self, culls: impl Fn(&PrimitivePair<S>) -> bool) {
        let Self(pairs, masks) = self;
        for (indices, mask) in pairs.indices.chunks(LANES).zip(masks) {
            *mask = 0;
            for (lane, &indices) in indices.iter().enumerate() {
                *mask |= Mask::from(culls(&pairs.pair(indices))) << lane;
            }
        }
    }
}

/// A writer of masks with the verdicts on pairs that are gathered sixteen at a time, or on tiles of them.
struct SideBySide<'a, S: Scalar>(Level, &'a Pairs<'a, S>, Option<&'a [Tile<S>]>, &'a mut [Mask]);

impl<S: Scalar> WithLanes<S> for SideBySide<'_, S> {
    fn with(self, test: impl BatchTest<S>) {
        let Self(level, &Pairs { kind, rows, indices }, tiles, masks) = self;
        match tiles {
            None => culled_from_rows(level, kind, test, rows, indices, masks),
            Some(tiles) => culled_from_tiles(level, kind, test, tiles, masks),
        }
    }
}

/// One filter: its times and counts so far.
struct Measurement<S> {
    filter: MeasuredFilter,
    separation: S,
    /// The seconds in all, for one pair at a time and for each instruction set.
    backends: Vec<(Backend, f64)>,
    tiled_seconds: f64,
    tiled: usize,
    culled: usize,
    kept_cullable: usize,
    false_culls: usize,
}

#[derive(Clone, Copy)]
enum Backend {
    OneAtATime,
    Lanes(&'static str, Level),
}

impl<S: Scalar> Measurement<S> {
    /// Returns `None` for a filter that would repeat another's row, or that ignores separations.
    fn new(filter: MeasuredFilter, separation: S) -> Option<Self> {
        let is_widest = S::FRACTION_BITS == f64::MANTISSA_DIGITS - 1;
        let is_left_out = match filter {
            MeasuredFilter::Paper => separation > S::ZERO,
            MeasuredFilter::Widened => is_widest,
            _ => false,
        };
        if is_left_out {
            return None;
        }
        let levels = available_levels();
        let levels = levels.into_iter().map(|(name, level)| Backend::Lanes(name, level));
        let backends = std::iter::once(Backend::OneAtATime).chain(levels);
        Some(Self {
            filter,
            separation,
            backends: backends.map(|backend| (backend, 0.0)).collect(),
            tiled_seconds: 0.0,
            tiled: 0,
            culled: 0,
            kept_cullable: 0,
            false_culls: 0,
        })
    }

    /// Counts the culled pairs, one at a time, and compares them with exact arithmetic.
    fn count(&mut self, pairs: &Pairs<'_, S>, exact: &[Mask]) -> Vec<Mask> {
        let mut masks = vec![0; pairs.mask_count()];
        self.filter.run(self.separation, OneByOne(pairs, &mut masks));
        self.culled += ones(&masks);
        for (&culled, &exact) in masks.iter().zip(exact) {
            self.kept_cullable += (exact & !culled).count_ones() as usize;
            self.false_culls += (culled & !exact).count_ones() as usize;
        }
        masks
    }

    /// Times every backend. Each must give the verdicts `expected`.
    fn time(&mut self, pairs: &Pairs<'_, S>, tiles: &[Tile<S>], expected: &[Mask], repeat: u32) -> Result<(), BackendsDisagree> {
        let (filter, separation) = (self.filter, self.separation);
        let mut masks = vec![0; expected.len()];
        for (backend, seconds) in &mut self.backends {
            *seconds += fastest(repeat, || match *backend {
                Backend::OneAtATime => {
                    let masks = black_box(&mut masks);
                    filter.run(separation, OneByOne(pairs, masks));
                }
                Backend::Lanes(_, level) => {
                    let masks = black_box(&mut masks);
                    filter.run_lanes(separation, SideBySide(level, pairs, None, masks));
                }
            });
            if masks != expected {
                return Err(BackendsDisagree::new(filter, backend.name()));
            }
        }
        if let Some(&(Backend::Lanes(name, level), _)) = self.backends.last() {
            self.tiled += TILED.min(pairs.indices.len());
            let seconds = fastest(repeat, || {
                for _ in 0..TILED_PASSES {
                    let tiles = Some(black_box(tiles));
                    filter.run_lanes(separation, SideBySide(level, pairs, tiles, &mut masks));
                }
            });
            self.tiled_seconds += seconds / TILED_PASSES as f64;
            if masks != expected {
                return Err(BackendsDisagree::new(filter, name));
            }
        }
        Ok(())
    }

    fn row(self, timed: usize) -> AccuracyRow {
        let nanoseconds = |seconds: f64, pairs: usize| seconds * 1e9 / pairs as f64;
        let times = self.backends.iter().map(|&(backend, seconds)| BackendTime {
            backend: backend.name(),
            nanoseconds: nanoseconds(seconds, timed),
        });
        AccuracyRow {
            filter: self.filter,
            culled: self.culled,
            kept_cullable: self.kept_cullable,
            false_culls: self.false_culls,
            times: times.collect(),
            in_first_cache: (self.tiled > 0).then(|| nanoseconds(self.tiled_seconds, self.tiled)),
        }
    }
}

impl Backend {
    fn name(self) -> &'static str {
        match self {
            Self::OneAtATime => BackendTime::ONE_AT_A_TIME,
            Self::Lanes(name, _) => name,
        }
    }
}

/// Returns the seconds of the fastest of `repeat` runs.
fn fastest(repeat: u32, mut run: impl FnMut()) -> f64 {
    let mut fastest = f64::INFINITY;
    for _ in 0..repeat.max(1) {
        let begin = Instant::now();
        run();
        fastest = fastest.min(begin.elapsed().as_secs_f64());
    }
    fastest
}

fn ones(masks: &[Mask]) -> usize {
    masks.iter().map(|mask| mask.count_ones() as usize).sum()
}
