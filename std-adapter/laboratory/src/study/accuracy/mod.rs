//! Measures what accuracy costs in time, for filters: every non-coplanarity filter on the same pairs.
//!
//! # Pairs
//! A [`PairSet`] is measured in `f32` and in `f64`. In either format a filter is compared with exact arithmetic **on the
//! coordinates that it gets**. Those of a scene are rounded to that format; those of nearly coplanar pairs are made in it. All
//! rows of one set and one format thus share pairs and truth, while `f32` and `f64` stand for programs with positions in that
//! format.
//!
//! # Truth
//! Exact arithmetic ([`selvedge_core::kernels::exact`]) culls a pair if the four control values have one strict sign, and
//! exceed the separation if there is one. Every filter computes that with some rounding, so a filter that culls another pair has
//! no proof of it: a *false cull*.
//!
//! # Time
//! All pairs are counted; about 50,000 of a set are timed. They are gathered by index from rows of vertices, as in the pipeline,
//! in chunks of 2,048 pairs that stay in a core's own cache. Each chunk goes through all filters and backends before the next
//! one, as often as requested, and the fastest run counts. All backends must give the same verdicts.
//!
//! A second time is that of tiles in the first cache (128 pairs of each chunk, repeated), on the best instruction set alone. It
//! measures the arithmetic without gathering, and with trained branches.

pub mod elementary;
mod measure;
mod near_coplanar;
mod pairs;

pub use pairs::PairSet;

use super::{ArmFrames, Frames};
use crate::methods::MeasuredFilter;
use crate::scene::ArmScene;
use selvedge::glam::DVec3;
use std::error::Error;
use std::time::Duration;

/// Options for measuring filters and elementary tests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AccuracyOptions {
    /// The largest number of pairs in each set.
    pub pairs: usize,
    /// The number of runs of each chunk through each filter or test, of which the fastest counts.
    pub repeat: u32,
    /// The seed of random pairs.
    pub seed: u64,
    /// The distance that pairs must exceed to be culled, in the unit of the positions, rounded to the format in use. It is
    /// neither negative nor infinite.
    pub separation: f64,
    /// The approximate time limit of one elementary test on one set in one format. It always runs on sixteen pairs. Filters
    /// ignore it.
    pub budget: Duration,
}

/// Every filter on every set.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterAccuracy {
    /// The options.
    pub options: AccuracyOptions,
    /// The sets, each in `f32`, then in `f64`.
    pub sets: Vec<AccuracySet>,
}

/// Every filter on one set of pairs in one format.
#[derive(Clone, Debug, PartialEq)]
pub struct AccuracySet {
    /// The name of the set.
    pub name: String,
    /// `"f32"` or `"f64"`.
    pub scalar: &'static str,
    /// The number of vertex–face pairs.
    pub vertex_face: usize,
    /// The number of edge–edge pairs.
    pub edge_edge: usize,
    /// The number of pairs before sampling.
    pub drawn_from: usize,
    /// The number of timed pairs; all were counted.
    pub timed: usize,
    /// The number of pairs that exact arithmetic culls.
    pub cullable: usize,
    /// A row for each filter, in the order of [`MeasuredFilter::ALL`]. The paper's is missing with a separation. In `f64` the
    /// widened tier is missing, which equals the permanent there.
    pub rows: Vec<AccuracyRow>,
}

/// One filter on one set.
#[derive(Clone, Debug, PartialEq)]
pub struct AccuracyRow {
    /// The filter.
    pub filter: MeasuredFilter,
    /// The number of pairs that it culls.
    pub culled: usize,
    /// The number of pairs that it keeps although exact arithmetic culls them.
    pub kept_cullable: usize,
    /// The number of pairs that it culls without proof, although exact arithmetic does not.
    pub false_culls: usize,
    /// The times for one pair at a time, then on each instruction set, the simplest first.
    pub times: Vec<BackendTime>,
    /// The nanoseconds per pair for tiles in the first cache, on the best instruction set.
    pub in_first_cache: Option<f64>,
}

/// The time of a pair on one backend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BackendTime {
    /// The name [`ONE_AT_A_TIME`](Self::ONE_AT_A_TIME), or the instruction set.
    pub backend: &'static str,
    /// The nanoseconds per pair, gathered.
    pub nanoseconds: f64,
}

impl BackendTime {
    /// The name of the backend without lanes.
    pub const ONE_AT_A_TIME: &'static str = "one";
}

impl AccuracySet {
    /// Returns the number of pairs.
    pub const fn pairs(&self) -> usize {
        self.vertex_face + self.edge_edge
    }

    /// Returns the row of a filter, if it was measured.
    pub fn row(&self, filter: MeasuredFilter) -> Option<&AccuracyRow> {
        self.rows.iter().find(|row| row.filter == filter)
    }

    /// Returns a row's time on a backend relative to that of [`MeasuredFilter::Uncertified`] on the same backend.
    pub fn over_uncertified(&self, time: BackendTime) -> Option<f64> {
        let uncertified = self.row(MeasuredFilter::Uncertified)?;
        Some(time.nanoseconds / uncertified.time(time.backend)?)
    }
}

impl AccuracyRow {
    /// Returns the best instruction set's time.
    pub fn best_time(&self) -> Option<BackendTime> {
        self.times.last().copied()
    }

    /// Returns the nanoseconds per pair on a backend.
    pub fn time(&self, backend: &str) -> Option<f64> {
        let mut times = self.times.iter();
        Some(times.find(|time| time.backend == backend)?.nanoseconds)
    }
}

/// A filter gives different verdicts on different backends: a defect of this program or of the machine.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the filter `{filter}` on {backend} does not cull the same pairs as one pair at a time")]
pub struct BackendsDisagree {
    filter: MeasuredFilter,
    backend: &'static str,
}

impl BackendsDisagree {
    fn new(filter: MeasuredFilter, backend: &'static str) -> Self {
        Self { filter, backend }
    }
}

/// The number of steps of the arm scene of which one is measured. The last step is included.
const ARM_STRIDE: usize = 5;
/// The distances of the pairs far from the origin, in turn, in metres.
const DISTANCES: [f64; 4] = [1e3, 1e4, 1e5, 1e6];
/// The direction to these pairs, without a coordinate much smaller than the others.
const DIRECTION: DVec3 = DVec3::new(0.7, -0.6, 0.39);
/// The largest number of nearly coplanar pairs, which take half a kilobyte each.
const MOST_GENERATED: usize = 200_000;

/// The pairs that all studies of accuracy use.
struct ScenePairs {
    /// The sets of the arm, and of the caller's mesh.
    scenes: Vec<PairSet>,
    /// The pairs made in `f32`, and in `f64`.
    near_coplanar: [PairSet; 2],
}

impl ScenePairs {
    /// Returns each set as it is in `f32` and in `f64`.
    fn in_each_format(&self) -> impl ExactSizeIterator<Item = [&PairSet; 2]> {
        let scenes = self.scenes.iter().map(|set| [set; 2]);
        let all: Vec<_> = scenes.chain([self.near_coplanar.each_ref()]).collect();
        all.into_iter()
    }
}

fn arm_frames() -> Result<ArmFrames, Box<dyn Error + Send + Sync>> {
    Ok(ArmFrames::new(1, ArmScene::STEPS)?)
}

fn arm_steps() -> impl Iterator<Item = usize> {
    (ARM_STRIDE - 1..ArmScene::STEPS).step_by(ARM_STRIDE)
}

fn scene_pairs(mesh: Option<&dyn Frames>, options: AccuracyOptions) -> Result<ScenePairs, Box<dyn Error + Send + Sync>> {
    let AccuracyOptions { pairs, seed, .. } = options;
    let arm = arm_frames()?;
    let here: Vec<_> = arm_steps().map(|step| (step, DVec3::ZERO)).collect();
    let of_mesh = |mesh: &dyn Frames| {
        let steps: Vec<_> = (0..mesh.step_count()).map(|step| (step, DVec3::ZERO)).collect();
        PairSet::from_steps(mesh.name(), mesh, &steps, pairs)
    };
    let generated = pairs.min(MOST_GENERATED);
    let mut scenes = vec![PairSet::from_steps(arm.name(), &arm, &here, pairs)?];
    scenes.extend(mesh.map(of_mesh).transpose()?);
    Ok(ScenePairs {
        scenes,
        near_coplanar: [
            PairSet::near_coplanar::<f32>(seed, generated),
            PairSet::near_coplanar::<f64>(seed, generated),
        ],
    })
}

/// Measures every filter on candidate pairs of the arm scene and of all steps of `mesh`, if given. Nearly coplanar pairs and
/// pairs far from the origin follow. Calls `progress` with the share that is done.
///
/// # Errors
/// Returns an error if threads cannot be started, a frame is not finite, or backends disagree.
pub fn measure_accuracy(
    mesh: Option<&dyn Frames>,
    options: AccuracyOptions,
    progress: &mut dyn FnMut(f64),
) -> Result<FilterAccuracy, Box<dyn Error + Send + Sync>> {
    let AccuracyOptions {
        pairs,
        repeat,
        separation,
        ..
    } = options;
    let mut all = scene_pairs(mesh, options)?;
    let distances = DISTANCES.into_iter().cycle();
    let far: Vec<_> = arm_steps()
        .zip(distances)
        .map(|(step, distance)| (step, distance * DIRECTION))
        .collect();
    let name = "Arm scene, 1 km to 1,000 km from the origin".to_owned();
    all.scenes.push(PairSet::from_steps(name, &arm_frames()?, &far, pairs)?);

    let in_each_format = all.in_each_format();
    let count = 2 * in_each_format.len();
    let mut sets = Vec::with_capacity(count);
    for [single, double] in in_each_format {
        let done = sets.len() as f64;
        let mut share = |part: f64| progress((done + part) / count as f64);
        sets.push(measure::measure::<f32>(single, repeat, separation, &mut share)?);
        let mut share = |part: f64| progress((done + 1.0 + part) / count as f64);
        sets.push(measure::measure::<f64>(double, repeat, separation, &mut share)?);
    }
    Ok(FilterAccuracy { options, sets })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measured(separation: f64) -> FilterAccuracy {
        let options = AccuracyOptions {
            pairs: 3000,
            repeat: 1,
            seed: 7,
            separation,
            budget: Duration::ZERO,
        };
        measure_accuracy(None, options, &mut |_| ()).unwrap()
    }

    fn row(set: &AccuracySet, filter: MeasuredFilter) -> &AccuracyRow {
        set.row(filter).unwrap()
    }

    #[test]
    fn every_set_is_there_in_both_formats() {
        let mut shares = Vec::new();
        let options = AccuracyOptions {
            pairs: 100,
            repeat: 1,
            seed: 0,
            separation: 0.0,
            budget: Duration::ZERO,
        };
        let accuracy = measure_accuracy(None, options, &mut |share| shares.push(share)).unwrap();
        let scalars: Vec<_> = accuracy.sets.iter().map(|set| set.scalar).collect();
        assert_eq!(scalars, ["f32", "f64"].repeat(3));
        assert!(shares.is_sorted() && shares.last() == Some(&1.0), "{shares:?}");
    }

    #[test]
    fn certified_filters_cull_nothing_that_exact_arithmetic_does_not() {
        for separation in [0.0, 1e-3] {
            for set in measured(separation).sets {
                assert!(set.cullable > 0 || separation > 0.0, "{}", set.name);
                for row in &set.rows {
                    assert_eq!(row.culled + row.kept_cullable, set.cullable + row.false_culls);
                    if row.filter.is_certified() {
                        assert_eq!(row.false_culls, 0, "{}, {}", set.name, row.filter);
                    }
                }
                assert_eq!(row(&set, MeasuredFilter::Exact).kept_cullable, 0, "{}", set.name);
            }
        }
    }

    #[test]
    fn filters_that_ignore_rounding_are_caught_on_nearly_coplanar_pairs() {
        let accuracy = measured(0.0);
        for set in accuracy.sets.iter().filter(|set| set.name == "Nearly coplanar pairs") {
            assert!(set.row(MeasuredFilter::Uncertified).unwrap().false_culls > 0);
            assert!(set.row(MeasuredFilter::Paper).unwrap().false_culls > 0);
        }
    }

    #[test]
    fn sharper_tiers_keep_less() {
        for set in measured(0.0).sets {
            let [permanent, exact] =
                [MeasuredFilter::Permanent, MeasuredFilter::Exact].map(|filter| row(&set, filter).kept_cullable);
            assert!(exact <= permanent, "{}: {exact}, {permanent}", set.name);
        }
    }

    #[test]
    fn every_tier_is_timed_on_every_backend() {
        let levels = selvedge::simd::available_levels().len();
        for set in measured(0.0).sets {
            let rows = if set.scalar == "f32" { 5 } else { 4 };
            assert_eq!(set.rows.len(), rows);
            for row in &set.rows {
                assert_eq!(row.times.len(), 1 + levels);
                assert!(row.times.iter().all(|time| time.nanoseconds > 0.0));
            }
            let uncertified = set.row(MeasuredFilter::Uncertified).unwrap().times[0];
            assert_eq!(set.over_uncertified(uncertified), Some(1.0));
        }
    }

    #[test]
    fn a_separation_leaves_out_the_filter_that_knows_none() {
        for set in measured(1e-3).sets {
            assert_eq!(set.row(MeasuredFilter::Paper), None);
        }
    }
}
