//! Which sound tests belong between the distribution of triangle pairs and the elementary test, and in which order.
//!
//! ```sh
//! cargo run --release -p selvedge-laboratory --example second_tests -- [START END]…
//! ```
//!
//! Takes the primitive pairs as they come from distribution, of the arm scene and of each step between two meshes (OBJ, PLY) that is
//! named, at most `PAIRS` of each, and asks every test, sixteen pairs side by side on the best instruction set, gathered from rows of
//! vertices. Then chooses an order step by step: next is the test that pays first on what is left. A test pays if what
//! follows it takes longer, for a pair, than the test's time divided by the share that it culls. Last, of the pairs that
//! non-coplanarity and relative boxes along three axes leave, how many of those that nine directions cull the first round of advancing
//! culls as well.
//!
//! All tests are sound: they cull nothing that touches. The paper's box test stands beside ours.

use selvedge::glam::DVec3;
use selvedge::simd::best_level;
use selvedge_core::PairKind;
use selvedge_core::batch::{LANES, Mask, Round, RoundQuestion, Test, VertexRow, advance_from_rows, culled_from_rows};
use selvedge_core::elementary::Limits;
use selvedge_core::filter::{Depth, Filter, Tier};
use selvedge_files::mesh::read_step;
use selvedge_laboratory::scene::ArmScene;
use selvedge_laboratory::study::{ArmFrames, Frames, PairSet, TwoFrames};
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// At most so many pairs of a scene.
const PAIRS: usize = 600_000;
/// So many pairs go through a test in one go.
const CHUNK: usize = 2048;
/// The fastest of so many runs counts.
const RUNS: usize = 5;
/// A test that culls less than this of what is left is not chosen.
const LEAST_SHARE: f64 = 0.005;

#[derive(Clone, Copy, PartialEq)]
enum Candidate {
    Test(Test),
    Filter(Tier),
    /// One round of advancing from time 0: the closest points' direction, held constant.
    ClosestDirection,
}

const TESTS: [(&str, Candidate); 9] = [
    ("swept boxes", Candidate::Test(Test::SweptBoxes)),
    ("paper's box test", Candidate::Test(Test::SegmentBox)),
    ("relative boxes, 3 axes", Candidate::Test(Test::RelativeBoxes)),
    ("relative boxes, 9 directions", Candidate::Test(Test::RelativeBoxesNine)),
    ("direction: normal", Candidate::Test(Test::NormalDirection)),
    ("direction: closest points", Candidate::ClosestDirection),
    ("inside functions", Candidate::Test(Test::InsideFunctions)),
    ("non-coplanarity", Candidate::Filter(Tier::Permanent)),
    ("subdivided in time", Candidate::Filter(Tier::Subdivided(Depth::One))),
];

/// What a test did to a set of pairs.
struct Outcome {
    culled: Vec<bool>,
    nanoseconds: f64,
}

impl Outcome {
    fn share(&self) -> f64 {
        let culled = self.culled.iter().filter(|&&culled| culled).count();
        culled as f64 / self.culled.len().max(1) as f64
    }

    /// What follows must take longer than so many nanoseconds a pair.
    fn pays_from(&self) -> f64 {
        self.nanoseconds / self.share()
    }
}

fn main() -> Result<(), Box<dyn Error + Send + Sync>> {
    let files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    let (steps, rest) = files.as_chunks::<2>();
    if !rest.is_empty() {
        return Err("a step has two meshes".into());
    }
    // The later half of the arm's way, where the sleeve folds.
    let arm = ArmFrames::new(10, ArmScene::STEPS)?;
    let late: Vec<_> = (ArmScene::STEPS / 2..ArmScene::STEPS)
        .step_by(6)
        .map(|step| (step, DVec3::ZERO))
        .collect();
    report(&PairSet::of_steps(arm.name(), &arm, &late, PAIRS)?);
    for [start, end] in steps {
        let step = read_step(start, end)?;
        let frames = TwoFrames {
            name: format!("{} to {}", stem(start), stem(end)),
            topology: step.topology,
            start: step.start,
            end: step.end,
        };
        let set = PairSet::of_steps(frames.name(), &frames, &[(0, DVec3::ZERO)], PAIRS)?;
        report(&set);
    }
    Ok(())
}

fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or(path.as_os_str());
    stem.to_string_lossy().into_owned()
}

fn report(set: &PairSet) {
    let rows = set.rows::<f64>();
    for (name, kind, pairs) in [
        ("VF", PairKind::VertexFace, &set.vertex_face),
        ("EE", PairKind::EdgeEdge, &set.edge_edge),
    ] {
        println!(
            "{}, {name}: {} pairs after distribution (a sample of {} VF and EE)",
            set.name,
            pairs.len(),
            set.drawn_from
        );
        let all = TESTS.map(|(_, test)| measured(test, kind, &rows, pairs));
        let overlapping = left(pairs, &all[0]);
        let after = TESTS.map(|(_, test)| measured(test, kind, &rows, &overlapping));
        println!(
            "  {:<30}{:>8}{:>9}{:>10} |{:>8}{:>9}{:>10}",
            "", "culls", "ns", "pays from", "culls", "ns", "pays from"
        );
        println!("  {:<30}{:>27} |{:>27}", "", "of all", "of those whose boxes overlap");
        for (((name, _), all), after) in TESTS.iter().zip(&all).zip(&after) {
            println!("  {name:<30}{} |{}", cells(all), cells(after));
        }
        print_order(kind, &rows, pairs);
        print_what_the_first_round_culls(kind, &rows, pairs);
        println!();
    }
}

fn cells(outcome: &Outcome) -> String {
    let share = outcome.share();
    let pays = if share > 0.0 {
        format!("{:.1} ns", outcome.pays_from())
    } else {
        "–".to_owned()
    };
    format!("{:>6.1} %{:>9.1}{pays:>10}", 100.0 * share, outcome.nanoseconds)
}

/// One test after another, each time the one that pays first.
fn print_order(kind: PairKind, rows: &[VertexRow<f64>], pairs: &[[u32; 4]]) {
    let mut pairs = pairs.to_vec();
    let whole = pairs.len() as f64;
    println!("  order:");
    while !pairs.is_empty() {
        let outcomes = TESTS.map(|(name, test)| (name, measured(test, kind, rows, &pairs)));
        let best = outcomes
            .iter()
            .filter(|(_, outcome)| outcome.share() >= LEAST_SHARE)
            .min_by(|(_, a), (_, b)| a.pays_from().total_cmp(&b.pays_from()));
        let Some((name, outcome)) = best else { break };
        pairs = left(&pairs, outcome);
        println!(
            "    {name:<28} culls {:>5.1} % of what is left, {:>5.1} ns, pays from {:>6.1} ns; leaves {:.2} % of all",
            100.0 * outcome.share(),
            outcome.nanoseconds,
            outcome.pays_from(),
            100.0 * pairs.len() as f64 / whole,
        );
    }
}

/// Of what nine directions cull where the tests that always pay have been before.
fn print_what_the_first_round_culls(kind: PairKind, rows: &[VertexRow<f64>], pairs: &[[u32; 4]]) {
    let mut pairs = pairs.to_vec();
    for test in [Candidate::Filter(Tier::Permanent), Candidate::Test(Test::RelativeBoxes)] {
        pairs = left(&pairs, &measured(test, kind, rows, &pairs));
    }
    let nine = measured(Candidate::Test(Test::RelativeBoxesNine), kind, rows, &pairs);
    let round = measured(Candidate::ClosestDirection, kind, rows, &pairs);
    let by_nine: Vec<_> = { nine.culled.iter().zip(&round.culled) }.filter(|(nine, _)| **nine).collect();
    let by_both = by_nine.iter().filter(|(_, round)| **round).count();
    println!(
        "  non-coplanarity and 3 axes leave {} pairs: 9 directions cull {:.1} % of them, the first round {:.1} %, and {:.1} % of those that 9 directions cull",
        pairs.len(),
        100.0 * nine.share(),
        100.0 * round.share(),
        100.0 * by_both as f64 / by_nine.len().max(1) as f64,
    );
}

fn left(pairs: &[[u32; 4]], outcome: &Outcome) -> Vec<[u32; 4]> {
    let both = pairs.iter().zip(&outcome.culled);
    both.filter(|(_, culled)| !**culled).map(|(&pair, _)| pair).collect()
}

fn measured(candidate: Candidate, kind: PairKind, rows: &[VertexRow<f64>], pairs: &[[u32; 4]]) -> Outcome {
    let mut culled = Vec::with_capacity(pairs.len());
    let mut seconds = 0.0;
    let mut masks = [0; CHUNK / LANES];
    for pairs in pairs.chunks(CHUNK) {
        let mut fastest = f64::INFINITY;
        for _ in 0..RUNS {
            let begin = Instant::now();
            ask(candidate, kind, rows, pairs, &mut masks);
            fastest = fastest.min(begin.elapsed().as_secs_f64());
        }
        seconds += fastest;
        let is_culled = |index: usize| masks[index / LANES] >> (index % LANES) & 1 != 0;
        culled.extend((0..pairs.len()).map(is_culled));
    }
    Outcome {
        culled,
        nanoseconds: seconds * 1e9 / pairs.len().max(1) as f64,
    }
}

fn ask(candidate: Candidate, kind: PairKind, rows: &[VertexRow<f64>], pairs: &[[u32; 4]], masks: &mut [Mask; CHUNK / LANES]) {
    let level = best_level();
    match candidate {
        Candidate::Test(test) => culled_from_rows(level, kind, test, rows, pairs, masks),
        Candidate::Filter(tier) => {
            culled_from_rows(level, kind, Filter::new(tier), rows, pairs, masks);
        }
        Candidate::ClosestDirection => {
            let question = RoundQuestion {
                limits: Limits::default(),
                until: 1.0,
                with_volume: false,
            };
            let mut times = [0.0; CHUNK];
            let mut rounds = [Round::default(); CHUNK / LANES];
            advance_from_rows(level, kind, &question, rows, pairs, &mut times, &mut rounds);
            for (mask, round) in masks.iter_mut().zip(&rounds) {
                *mask = round.apart;
            }
        }
    }
}
