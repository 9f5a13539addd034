//! The source of the time of impact runs on numbers of 9 and 11 significant bits, in every floating-point environment. The claims
//! of its certificates hold in exact arithmetic, and bounds that are too small are detected.
//!
//! Rounding errors are a large part of such numbers, so grids of a few values come close to every bound. The tests assert how
//! close, and that something is proven at all.

use crate::support::determinant;
use crate::support::prelude::*;
use rug::Integer;
use selvedge_core::elementary::advance::{ROUNDS, time_of_impact_of_points};
use selvedge_core::kernels::advance::corners::Corners;
use selvedge_core::kernels::advance::directions::{are_apart_curving, are_apart_turning};
use selvedge_core::kernels::advance::round::{RoundInput, round};
use selvedge_core::kernels::advance::volume::SignedVolume;
use selvedge_core::kernels::lanes::Rounding;
use selvedge_core::kernels::points::{EdgeEdge, PairPoints, PairShape, VertexFace};
use selvedge_core::kernels::separation_lanes::SeparationLanes;
use selvedge_verification::altered::{self, Factors};
use selvedge_verification::minifloat::{DOWNWARD, FLUSHING, Minifloat, TO_NEAREST, TOWARDS_ZERO, UPWARD, every, numbers};
use selvedge_verification::random::Random;

type Number<const F: u32, const ENVIRONMENT: u32> = Minifloat<5, F, ENVIRONMENT>;
type Points<T> = [[[T; 3]; 2]; 4];

fn pair_points<T: Copy>(points: &Points<T>) -> PairPoints<T> {
    let at = |end: usize| points.map(|ends| Vector::from(ends[end]));
    PairPoints {
        start: at(0),
        end: at(1),
    }
}

/// Returns the number exactly, in units of the smallest number.
fn units<const F: u32, const ENVIRONMENT: u32>(position: Vector<Number<F, ENVIRONMENT>>) -> [i128; 3] {
    [position.x, position.y, position.z].map(|x| i128::from(x.units()))
}

fn difference(a: [i128; 3], b: [i128; 3]) -> [i128; 3] {
    std::array::from_fn(|axis| a[axis] - b[axis])
}

/// A corner at the start and at the end, exactly.
type ExactCorner = [[i128; 3]; 2];

fn exact_corners<const F: u32, const ENVIRONMENT: u32>(
    kind: PairKind,
    points: &PairPoints<Number<F, ENVIRONMENT>>,
) -> Vec<ExactCorner> {
    let pairs: &[[usize; 2]] = match kind {
        PairKind::VertexFace => &[[0, 1], [0, 2], [0, 3]],
        PairKind::EdgeEdge => &[[0, 2], [0, 3], [1, 2], [1, 3]],
    };
    let corner = |&[a, b]: &[usize; 2]| [points.start, points.end].map(|ends| difference(units(ends[a]), units(ends[b])));
    pairs.iter().map(corner).collect()
}

/// Returns a multiple of w·e at the time that is `part` of `whole`.
fn exact_product(w: [i128; 3], [start, end]: ExactCorner, part: i128, whole: i128) -> i128 {
    (0..3).map(|k| w[k] * (start[k] * (whole - part) + end[k] * part)).sum()
}

/// The findings about a certificate.
#[derive(Debug, Default)]
struct Seen {
    asked: u64,
    proven: u64,
    /// The number of proofs until a time between the given one and the end.
    until: u64,
    /// The largest ratio of a computed value to its bound if the exact value is not positive.
    worst: f64,
}

impl Seen {
    fn look_at_direction<const F: u32, const ENVIRONMENT: u32>(
        &mut self,
        points: &PairPoints<Number<F, ENVIRONMENT>>,
        w: Vector<Number<F, ENVIRONMENT>>,
        time: Number<F, ENVIRONMENT>,
    ) {
        let one = Number::<F, ENVIRONMENT>::ONE;
        let corners = Corners::of_vertex_face(points);
        let direction = corners.direction(w);
        let positions = corners.at(time);
        let proven = corners.apart_along(&direction, &positions, true);
        let exact = exact_corners(PairKind::VertexFace, points);
        let product = |corner: ExactCorner, time: Number<F, ENVIRONMENT>| {
            exact_product(units(w), corner, time.units().into(), one.units().into())
        };
        self.asked += 1;
        for (corner, position) in exact.iter().zip(positions) {
            let share = w.dot(position).value() / direction.bar.value();
            if share > self.worst && product(*corner, time) <= 0 {
                self.worst = share;
            }
        }
        if proven.is_apart {
            self.proven += 1;
            let until = if proven.until < one { proven.until } else { one };
            self.until += u64::from(until > time && until < one);
            for &corner in &exact {
                assert!(product(corner, time) > 0, "{points:?}, {w:?}, at {time:?}");
                assert!(
                    until <= time || product(corner, until) > 0,
                    "{points:?}, {w:?}, {time:?} to {until:?}"
                );
            }
        }
    }
}

/// Tries every direction and every motion of a vertex on a grid of three values, over a face that is one point. (Corners count
/// one by one, since the direction's certificate is about each alone.)
fn every_constant_direction<const ENVIRONMENT: u32>(grid: [f64; 3], point: [f64; 3]) -> Seen {
    let grid: [Number<8, ENVIRONMENT>; 3] = numbers(grid);
    let times: [Number<8, ENVIRONMENT>; 3] = numbers([0.0, 0.25, 0.806_640_625]);
    let point = [numbers(point); 2];
    let mut seen = Seen::default();
    every::<_, 9>(&grid, |[a, b, c, d, e, f, g, h, i]| {
        let points = pair_points(&[[[a, b, c], [d, e, f]], point, point, point]);
        for time in times {
            seen.look_at_direction(&points, Vector::new(g, h, i), time);
        }
    });
    seen
}

/// A point with smaller steps than those of the grid, so that differences are rounded.
const POINT: [f64; 3] = [0.313_476_562_5, -0.156_738_281_25, 0.078_369_140_625];

#[test]
fn every_constant_direction_on_a_grid_of_three_values_with_9_bits() {
    let grid = [-1.363_281_25, 0.869_140_625, 1.925_781_25];
    let all = [
        every_constant_direction::<TO_NEAREST>(grid, POINT),
        every_constant_direction::<DOWNWARD>(grid, POINT),
        every_constant_direction::<UPWARD>(grid, POINT),
        every_constant_direction::<TOWARDS_ZERO>(grid, POINT),
    ];
    for seen in &all {
        assert!(seen.proven > 1000 && seen.until > 100, "{seen:?}");
    }
    // These are the findings to nearest. On this grid no nonpositive value is computed as positive when everything is rounded
    // down.
    assert!(all[0].worst > 0.005, "{all:?}");
}

/// The numbers are about the smallest normal number, 2⁻¹⁴, so differences and products are flushed.
#[test]
fn every_constant_direction_on_a_grid_of_tiny_values_where_they_are_flushed() {
    let grid = [-1.0 / 16_384.0, 1.5 / 16_384.0, 1.0];
    let point = [0.0, 1.5 / 16_384.0, -1.0 / 16_384.0];
    let all = [
        every_constant_direction::<{ TO_NEAREST | FLUSHING }>(grid, point),
        every_constant_direction::<{ DOWNWARD | FLUSHING }>(grid, point),
        every_constant_direction::<{ UPWARD | FLUSHING }>(grid, point),
    ];
    for seen in all {
        assert!(seen.proven > 0, "{seen:?}");
    }
}

/// Chooses coordinates that often coincide, and otherwise are a few steps or a few quarters apart.
fn random_points<const F: u32, const ENVIRONMENT: u32>(random: &mut Random) -> Points<Number<F, ENVIRONMENT>> {
    let grid: [Number<F, ENVIRONMENT>; 9] = numbers([-2.0, -1.0, -0.75, 0.0, 0.25, 0.501_953_125, 0.994_140_625, 1.0, 1.75]);
    let offsets: [Number<F, ENVIRONMENT>; 3] = numbers([0.0, 0.001_953_125, -0.023_437_5]);
    let mut coordinate = || random.pick(&grid) + random.pick(&offsets);
    [(); 4].map(|()| [(); 2].map(|()| [(); 3].map(|()| coordinate())))
}

/// Checks that a direction keeps the corners apart at seventeen times. It leads over the corners' middles at two times and turns,
/// or at three times on a curve. Returns the number of proofs.
fn random_directions<const ENVIRONMENT: u32>(is_curved: bool) -> u64 {
    let mut random = Random(u64::from(ENVIRONMENT));
    let times: [Number<8, ENVIRONMENT>; 3] = numbers([0.125, 0.437_5, 0.75]);
    let mut proven = 0;
    for _ in 0..20_000 {
        let points = pair_points(&random_points::<8, ENVIRONMENT>(&mut random));
        let corners = Corners::of_edge_edge(&points);
        let positions = times.map(|time| corners.at(time));
        let [before, middle, after] = positions.map(|[a, b, c, d]| (a + b) + (c + d));
        let curve = [before, middle + middle, after].map(|w| corners.direction(w));
        let [from, _, to] = &positions;
        let is_proven = match is_curved {
            true => are_apart_curving(&curve, from, to),
            false => are_apart_turning(&curve[0], from, &curve[2], to),
        };
        if !is_proven {
            continue;
        }
        proven += 1;
        let [before, doubled, after] = curve.map(|direction| units(direction.w));
        for corner in exact_corners(PairKind::EdgeEdge, &points) {
            for step in 0..=16 {
                // The time is in 128ths: from 1/8 to 3/4 is five eighths of 16 times 8.
                let (time, rest) = (16 + 5 * step, 16 - step);
                let w = std::array::from_fn(|k| match is_curved {
                    true => before[k] * rest * rest + doubled[k] * rest * step + after[k] * step * step,
                    false => before[k] * rest + after[k] * step,
                });
                assert!(exact_product(w, corner, time, 128) > 0, "{points:?} {step}");
            }
        }
    }
    proven
}

#[test]
fn random_turning_and_curving_directions_with_9_bits() {
    for is_curved in [false, true] {
        for proven in [
            random_directions::<TO_NEAREST>(is_curved),
            random_directions::<DOWNWARD>(is_curved),
            random_directions::<UPWARD>(is_curved),
            random_directions::<{ TOWARDS_ZERO | FLUSHING }>(is_curved),
        ] {
            assert!(proven > 20, "{proven}");
        }
    }
}

/// Returns a multiple of the volume at the time that is `part` of `whole`, which is a power of two.
fn exact_volume(corners: &[ExactCorner], part: i128, whole: i128) -> Integer {
    let [k0, k1, k2, k3] = [0, 1, 2, 3].map(|ends: usize| {
        let choices = (0..8_usize).filter(|choice| choice.count_ones() as usize == ends);
        let of_choice = |choice: usize| determinant([0, 1, 2].map(|corner: usize| corners[corner][choice >> corner & 1]));
        Integer::from(choices.map(of_choice).sum::<i128>())
    });
    let (part, rest) = (Integer::from(part), Integer::from(whole - part));
    let mut sum = k0 * &rest * &rest * &rest;
    sum += k1 * &rest * &rest * &part;
    sum += k2 * &rest * &part * &part;
    sum + k3 * &part * &part * &part
}

/// Checks the volume's certificate on random motions, exactly, at the times that a clip from some time on has passed.
fn random_volumes<const ENVIRONMENT: u32>() -> Seen {
    let mut random = Random(7 + u64::from(ENVIRONMENT));
    let times: [Number<10, ENVIRONMENT>; 4] = numbers([0.0, 0.0, 0.25, 0.688_964_843_75]);
    let one = Number::<10, ENVIRONMENT>::ONE;
    let whole = i128::from(one.units());
    let mut seen = Seen::default();
    for _ in 0..30_000 {
        let points = pair_points(&random_points::<10, ENVIRONMENT>(&mut random));
        let time = random.pick(&times);
        let corners = Corners::of_vertex_face(&points);
        let volume = SignedVolume::new(&corners);
        let exact = exact_corners(PairKind::VertexFace, &points);
        let at = |part: i128| exact_volume(&exact, part, whole);
        seen.asked += 1;
        let (computed, sign) = (volume.at(time).value(), at(time.units().into()).cmp0());
        let share = computed.abs() / volume.error.value();
        if share > seen.worst && computed.partial_cmp(&0.0) != Some(sign) {
            seen.worst = share;
        }
        for clipped in [volume.clipped::<true>(time), volume.clipped::<false>(time)] {
            let until = if clipped.to_the_end { one } else { clipped.until };
            if until <= time {
                continue;
            }
            seen.proven += 1;
            seen.until += u64::from(until < one);
            let (from, to) = (i128::from(time.units()), i128::from(until.units()));
            assert!(sign.is_ne(), "{points:?} at {time:?}");
            for step in 1..=16 {
                let part = from + (to - from) * step / 16;
                assert_eq!(at(part).cmp0(), sign, "{points:?} from {time:?} to {until:?}");
            }
        }
        if volume.proves_apart_throughout() {
            assert!(
                (0..=16).all(|step| at(whole * step / 16).cmp0() == at(0).cmp0()),
                "{points:?}"
            );
        }
    }
    seen
}

#[test]
fn random_volumes_with_11_bits() {
    for seen in [
        random_volumes::<TO_NEAREST>(),
        random_volumes::<DOWNWARD>(),
        random_volumes::<UPWARD>(),
        random_volumes::<TOWARDS_ZERO>(),
        random_volumes::<{ TO_NEAREST | FLUSHING }>(),
    ] {
        assert!(seen.proven > 1000 && seen.until > 300 && seen.worst > 0.0001, "{seen:?}");
    }
}

/// Runs the whole time of impact, for one pair alone, and in rounds as for several side by side.
fn random_times<P: PairShape, const ENVIRONMENT: u32>() -> [u64; 2] {
    type Tiny<const ENVIRONMENT: u32> = Number<8, ENVIRONMENT>;
    let mut random = Random(70 + u64::from(ENVIRONMENT));
    let (zero, one) = (Tiny::<ENVIRONMENT>::ZERO, Tiny::<ENVIRONMENT>::ONE);
    let limits = Limits {
        tolerance: zero,
        separation: zero,
    };
    let mut found = [0; 2];
    for _ in 0..3000 {
        let tiny = random_points::<8, ENVIRONMENT>(&mut random);
        let points = pair_points(&tiny);
        let alone = match time_of_impact_of_points::<P, _>(&points, &limits, ROUNDS).0 {
            Impact::Never => None,
            Impact::Possible { time, .. } => Some(time),
        };
        let mut in_rounds = Some(zero);
        for sweep in 0..4 {
            let Some(from) = in_rounds else { break };
            let question = RoundInput {
                near: zero,
                separation: SeparationLanes::zero(zero),
                until: one,
                with_volume: sweep > 1,
            };
            let round = round::<P, _>(&points, from, &question);
            in_rounds = if round.apart { None } else { Some(round.time) };
        }
        let case = PairCase::new(P::KIND, tiny.map(|ends| ends.map(|x| x.map(Tiny::<ENVIRONMENT>::value))));
        let first = collides(&case.question());
        found[0] += u64::from(alone.is_none() || in_rounds.is_none());
        found[1] += u64::from(first.is_some());
        for time in [alone, in_rounds] {
            let Some(first) = &first else { continue };
            let time = time.unwrap_or_else(|| panic!("missed: {case:?}"));
            assert!(first.cmp_f64(time.value()).is_ge(), "{time:?} is late: {case:?}");
        }
    }
    found
}

#[test]
fn random_times_of_impact_with_9_bits_are_never_late() {
    for [apart, touching] in [
        random_times::<VertexFace, TO_NEAREST>(),
        random_times::<VertexFace, UPWARD>(),
        random_times::<VertexFace, { DOWNWARD | FLUSHING }>(),
        random_times::<EdgeEdge, DOWNWARD>(),
        random_times::<EdgeEdge, TOWARDS_ZERO>(),
        random_times::<EdgeEdge, { TO_NEAREST | FLUSHING }>(),
    ] {
        assert!(apart > 300 && touching > 50, "{apart} apart, {touching} touching");
    }
}

struct Unchanged;
impl Factors for Unchanged {}

/// Factors that give 0.02u instead of 20u, and 0.064u instead of 64u. (A twentieth did not fail on twenty thousand pairs, to
/// nearest.)
struct AThousandth;
impl Factors for AThousandth {
    const UNIT_ROUNDOFF: f64 = 0.001;
}

/// Returns the number of pairs that touch at a known time and have a later time of impact, or none, with the bounds times `F`.
fn late_with_bounds_times<F: Factors, S: Format>() -> u32 {
    let mut random = Random(1);
    let mut late = 0;
    for index in 0..20_000 {
        let bytes: [u8; Choices::ENOUGH] = random.bytes();
        let kind = [PairKind::VertexFace, PairKind::EdgeEdge][index % 2];
        let moment = Moment::<S>::choose(kind, Meeting::Touching, &mut Choices::new(&bytes));
        let limits = Limits::accurate_to(S::ZERO);
        let impact = altered::time_of_impact::<F, S>(&moment.pair(), &limits);
        let is_late = impact.time().is_none_or(|time| time.to_f64() > moment.time());
        late += u32::from(is_late);
    }
    late
}

#[test]
fn with_a_thousandth_of_the_bounds_times_of_impact_would_be_late() {
    assert_eq!(late_with_bounds_times::<Unchanged, f32>(), 0);
    assert_eq!(late_with_bounds_times::<Unchanged, f64>(), 0);
    let late = (
        late_with_bounds_times::<AThousandth, f32>(),
        late_with_bounds_times::<AThousandth, f64>(),
    );
    assert!(late.0 > 0 && late.1 > 0, "{late:?}");
}
