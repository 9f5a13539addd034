//! Checks on many pairs that every reported contact comes as near as the documentation of the time of impact says.

use super::Random;
use rug::Rational;
use selvedge_core::PairKind;
use selvedge_core::elementary::advance::time_of_impact_and_work;
use selvedge_core::elementary::{Impact, Limits, Reason};
use selvedge_core::glam::DVec3;
use selvedge_core::kernels::exact::touches;
use selvedge_verification::generator::{Choices, Format, PairCase};
use selvedge_verification::oracle::{collides, within, within_at};

/// The sources of pairs: those that slide, and all that the tests' generator makes.
pub(crate) const SOURCES: [&str; 2] = ["sliding", "generated"];

/// Prints a table of `count` pairs of each source and format. Returns the number of results that break a promise: alarms beyond
/// the documented distance, and pairs that are excluded but touch.
pub(crate) fn alarms(count: u64, seed: u64) -> u64 {
    println!(
        "source    scalar    pairs   contacts  within tolerance, error, last resort, other | asked of the oracle | beyond the promise, missed | rounds: mean, most, over 20"
    );
    let sources = SOURCES.into_iter().enumerate();
    sources
        .map(|(source, name)| {
            let mut random = Random::new(seed, source as u64);
            judged::<f64>(name, count, &mut random) + judged::<f32>(name, count, &mut random)
        })
        .sum()
}

#[derive(Default)]
struct Counts {
    contacts: u64,
    reasons: [u64; 4],
    by_oracle: u64,
    beyond: u64,
    missed: u64,
    rounds: u64,
    most_rounds: u32,
    long: u64,
}

fn judged<S: Format>(source: &str, count: u64, random: &mut Random) -> u64 {
    let mut counts = Counts::default();
    for index in 0..count as usize {
        let (case, limits) = chosen::<S>(source, index, random);
        judge(&case, &limits, &mut counts);
    }
    let Counts {
        contacts,
        reasons: [tolerance, error, last, other],
        by_oracle,
        beyond,
        missed,
        ..
    } = counts;
    println!(
        "{source:9} {:6} {count:8} {contacts:10}  {tolerance:8} {error:8} {last:6} {other:8} | {by_oracle:8} | {beyond:4} {missed:4} | {:.3} {} {}",
        S::NAME,
        counts.rounds as f64 / count as f64,
        counts.most_rounds,
        counts.long,
    );
    beyond + missed
}

/// Chooses a pair and its limits.
pub(crate) fn chosen<S: Format>(source: &str, index: usize, random: &mut Random) -> (PairCase<S>, Limits<S>) {
    let bytes = random.bytes::<{ Choices::ENOUGH }>();
    let mut choices = Choices::new(&bytes);
    let kind = [PairKind::VertexFace, PairKind::EdgeEdge][index % 2];
    let case = if source == SOURCES[0] {
        PairCase::<S>::choose_sliding(kind, &mut choices)
    } else {
        PairCase::<S>::choose(kind, &mut choices)
    };
    // A quarter of the sliding pairs are to keep a separation of about the distance at which they slide.
    let separation = if source == SOURCES[0] && index % 8 < 2 {
        S::exact(1, -choices.pick(&[10, 14, 20, 26]))
    } else {
        S::ZERO
    };
    let limits = Limits::within(separation);
    (case, limits)
}

fn judge<S: Format>(case: &PairCase<S>, limits: &Limits<S>, counts: &mut Counts) {
    let (impact, work) = time_of_impact_and_work(&case.pair(), limits);
    counts.rounds += u64::from(work.rounds);
    counts.most_rounds = counts.most_rounds.max(work.rounds);
    counts.long += u64::from(work.rounds > 20);
    let Impact::Possible { time, reason } = impact else {
        if limits.separation == S::ZERO && touches(&case.pair()) != Some(false) {
            counts.missed += 1;
            println!("missed: {case:?}");
        }
        return;
    };
    counts.contacts += 1;
    counts.reasons[match reason {
        Reason::WithinTolerance => 0,
        Reason::WithinError => 1,
        Reason::LastResort => 2,
        Reason::OutOfRange | Reason::NotFinite => 3,
    }] += 1;
    if !comes_near(case, limits, time, reason, &mut counts.by_oracle) {
        counts.beyond += 1;
        println!("beyond the promise: {limits:?}, {work:?}, {impact:?} {case:?}");
    }
}

/// Returns whether the pair comes as near as `reason` says.
fn comes_near<S: Format>(case: &PairCase<S>, limits: &Limits<S>, time: S, reason: Reason, by_oracle: &mut u64) -> bool {
    let (tolerance, separation) = (limits.tolerance.to_f64(), limits.separation.to_f64());
    let (corners, sizes) = corners_at(case, time.to_f64());
    let (near, roundoffs, lengths) = match reason {
        Reason::WithinTolerance => (tolerance + separation, 64.0, tolerance + separation),
        Reason::WithinError => (separation, 192.0, separation),
        Reason::LastResort if separation == 0.0 => {
            *by_oracle += 1;
            return collides(&case.question()).is_some();
        }
        Reason::LastResort => {
            *by_oracle += 1;
            return within(&case.question(), separation + 2.0 * tolerance);
        }
        Reason::OutOfRange | Reason::NotFinite => return true,
    };
    let vanishing = if S::NAME == "f32" {
        2.0_f64.powi(-60)
    } else {
        2.0_f64.powi(-500)
    };
    let bound = near + roundoffs * S::UNIT_ROUNDOFF.to_f64() * (lengths + sizes) + vanishing;
    // The error of the result is less than 32u of the sizes, with u of f64. So only a result within that error of the bound is in
    // doubt.
    if distance_at_most(&corners) + 16.0 * f64::EPSILON * sizes <= bound {
        return true;
    }
    *by_oracle += 1;
    within_at(
        &case.question(),
        &Rational::from_f64(time.to_f64()).expect("finite"),
        bound.next_up(),
    )
}

/// Returns the corners at a time, and the sum of their largest coordinates during the step.
fn corners_at<S: Format>(case: &PairCase<S>, time: f64) -> (Vec<DVec3>, f64) {
    let [first, second] = case.sets();
    let mut corners = Vec::with_capacity(4);
    let mut largest = DVec3::ZERO;
    for one in first {
        for other in second {
            let [start, end] = [0, 1].map(|end| {
                let coordinate = |axis: usize| one[end][axis].to_f64() - other[end][axis].to_f64();
                DVec3::new(coordinate(0), coordinate(1), coordinate(2))
            });
            largest = largest.max(start.abs()).max(end.abs());
            corners.push(start * (1.0 - time) + end * time);
        }
    }
    (corners, largest.element_sum())
}

/// Returns the distance from the origin of a point of the hull of three corners, or of the four of a parallelogram. It is the
/// closest point, up to rounding and except on thin hulls.
fn distance_at_most(corners: &[DVec3]) -> f64 {
    let mut least = f64::INFINITY;
    let mut consider = |point: DVec3| least = least.min(point.length());
    let sides: &[[usize; 2]] = if corners.len() == 3 {
        &[[0, 1], [1, 2], [2, 0]]
    } else {
        &[[0, 1], [0, 2], [1, 3], [2, 3]]
    };
    for &[from, to] in sides {
        let (from, side) = (corners[from], corners[to] - corners[from]);
        let part = -from.dot(side) / side.length_squared();
        consider(from);
        if (0.0..=1.0).contains(&part) {
            consider(from + side * part);
        }
    }
    let (a, ab, ac) = (corners[0], corners[1] - corners[0], corners[2] - corners[0]);
    let (long, short) = if ab.length_squared() < ac.length_squared() {
        (ac, ab)
    } else {
        (ab, ac)
    };
    let upright = |v: DVec3| (0..2).fold(v, |v, _| v - long * (v.dot(long) / long.length_squared()));
    let height = upright(short);
    let across = -upright(a).dot(height) / height.length_squared();
    let foot = a + short * across;
    let along = -foot.dot(long) / long.length_squared();
    let is_inside = across >= 0.0 && along >= 0.0 && across <= 1.0 && along <= 1.0;
    if is_inside && (corners.len() == 4 || across + along <= 1.0) {
        consider(foot + long * along);
    }
    least
}
