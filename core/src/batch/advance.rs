//! Advancing many pairs by separating directions, one round for sixteen of them at a time.
//!
//! [`advance_from_rows`] is the body of one round of [`time_of_impact`](crate::elementary::advance::time_of_impact) with what goes
//! well in lanes: a constant separating direction, and, where asked for, two steps of clipping the signed volume. The proofs, their
//! bounds and the order of operations are those of `elementary/advance`, where they are derived. The closest point, from which a
//! direction is taken, is found without branches; no proof relies on it.

use super::simd::Quotients;
use super::{LANES, Level, Mask, VertexRow};
use crate::PairKind;
use crate::coplanarity::MovingTetrahedron;
use crate::elementary::Limits;
use crate::elementary::corners::{largest_extent, less_roundoffs, more_roundoffs, of_format};
use crate::lanes::{Lanes, Rounding};
use crate::points::{PairPoints, PairShape};
use crate::scalar::Scalar;
use crate::vector::Vector;

/// What a round found of sixteen pairs. A pair in none of the three has advanced, and is still open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Round {
    /// Certainly farther apart than the separation until the end of the time asked about.
    pub apart: Mask,
    /// At its time, which did not change, within the tolerance of the separation.
    pub near: Mask,
    /// Nothing more could be proven in lanes; its time did not change.
    pub stuck: Mask,
}

/// What a round is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundQuestion<S> {
    /// Separation and tolerance.
    pub limits: Limits<S>,
    /// Up to when pairs are of interest, at most 1.
    pub until: S,
    /// Whether the signed volume is asked as well: half as much work again, which pays for pairs that come close to contact. Only
    /// with a separation of zero.
    pub with_volume: bool,
}

/// One round of advancing for each pair that `indices` name, from its time on: proven to be apart up to that, each is proven to be so up
/// to a later one, or to the end.
///
/// A caller sweeps over all open pairs, drops those that are decided, sweeps again, and finishes those that are stuck, or still
/// open after a dozen sweeps, one by one
/// ([`time_of_impact_within`](crate::elementary::advance::time_of_impact_within)).
///
/// **Certified, in every floating-point environment**, as for one pair, and the same bits on every instruction set. NaN,
/// infinite or too large differences, and indices that are not in the rows, make a pair [`stuck`](Round::stuck).
///
/// Times and rounds past the last pair are not touched; pairs past
/// the last time or round are not looked at. With a separation or a tolerance that is negative, NaN or too large (above 2²⁹,
/// `f64` 2²⁵⁰) all pairs are stuck.
///
/// Each pair must be proven to be apart from the start up to its time; zero will always do. Afterwards it is so up to the
/// new one. The four indices are those of its vertices: vertex, face; or first edge, second edge.
///
/// ```
/// use selvedge_core::batch::{advance_from_rows, Level, Round, RoundQuestion, VertexRow};
/// use selvedge_core::{elementary::Limits, glam::DVec3, PairKind, Motion};
/// // A vertex that falls from 1 to −1 onto a resting triangle.
/// let mut rows = vec![VertexRow::new(Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)))];
/// rows.extend([DVec3::ZERO, DVec3::X, DVec3::Y].map(|corner| VertexRow::new(Motion::resting(corner))));
/// let question = RoundQuestion { limits: Limits::default(), until: 1.0, with_volume: false };
/// let (mut times, mut rounds) = ([0.0], [Round::default()]);
/// let kind = PairKind::VertexFace;
/// advance_from_rows(Level::baseline(), kind, &question, &rows, &[[0, 1, 2, 3]], &mut times, &mut rounds);
/// assert!(times[0] > 0.499 && times[0] <= 0.5);
/// advance_from_rows(Level::baseline(), kind, &question, &rows, &[[0, 1, 2, 3]], &mut times, &mut rounds);
/// assert_eq!(rounds[0].near, 1);
/// ```
pub fn advance_from_rows<S: Scalar>(
    level: Level,
    kind: PairKind,
    question: &RoundQuestion<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    times: &mut [S],
    rounds: &mut [Round],
) {
    let question = RoundQuestion {
        limits: Limits {
            separation: question.limits.separation.raised_to_normal(),
            ..question.limits
        },
        ..*question
    };
    let Limits { tolerance, separation } = question.limits;
    let is_length = |length: S| length >= S::ZERO && length <= largest_extent();
    let is_good = is_length(tolerance) && is_length(separation);
    let pairs = indices.chunks(LANES).zip(times.chunks_mut(LANES));
    for ((indices, times), round) in pairs.zip(rounds) {
        if !is_good {
            *round = Round {
                stuck: Mask::MAX.checked_shr((LANES - LANES.min(indices.len())) as u32).unwrap_or(0),
                ..Round::default()
            };
            continue;
        }
        let whole = match (indices.first_chunk(), times.first_chunk_mut()) {
            (Some(indices), Some(times)) => S::round(level, kind, &question, rows, indices, times),
            _ => None,
        };
        *round = whole.unwrap_or_else(|| one_by_one(level, kind, &question, rows, indices, times));
    }
}

/// Fewer than sixteen pairs, or some whose indices are not in `rows`: each pair in all lanes.
#[cold]
fn one_by_one<S: Scalar>(
    level: Level,
    kind: PairKind,
    question: &RoundQuestion<S>,
    rows: &[VertexRow<S>],
    indices: &[[u32; 4]],
    times: &mut [S],
) -> Round {
    let mut all = Round::default();
    // Those that are there, and again the first in lanes that are left.
    let (Some(&first), Some(&first_time)) = (indices.first(), times.first()) else {
        return all;
    };
    let are_in_rows = |pair: &[u32; 4]| pair.iter().all(|&index| (index as usize) < rows.len());
    let mut whole = [first; LANES];
    let mut whole_times = [first_time; LANES];
    let mut present: Mask = 0;
    let given = indices.iter().zip(times.iter());
    let lanes = whole.iter_mut().zip(&mut whole_times);
    for (lane, ((pair, &time), (own, own_time))) in given.zip(lanes).enumerate() {
        if are_in_rows(pair) {
            present |= 1 << lane;
            (*own, *own_time) = (*pair, time);
        } else {
            all.stuck |= 1 << lane;
        }
    }
    // A pair that is in the rows, for the lanes of those that are not.
    let Some(&known) = indices.iter().find(|pair| are_in_rows(pair)) else {
        return all;
    };
    for own in &mut whole {
        if !are_in_rows(own) {
            *own = known;
        }
    }
    let Some(round) = S::round(level, kind, question, rows, &whole, &mut whole_times) else {
        return all;
    };
    for (lane, (time, new)) in times.iter_mut().zip(whole_times).enumerate() {
        if present >> lane & 1 != 0 {
            *time = new;
        }
    }
    all.apart = round.apart & present;
    all.near = round.near & present;
    all.stuck |= round.stuck & present;
    all
}

/// What a round found, in lanes.
#[derive(Clone, Copy, Debug)]
pub(super) struct LaneRound<L: Lanes> {
    pub(super) time: L,
    pub(super) apart: L::Mask,
    pub(super) near: L::Mask,
    pub(super) stuck: L::Mask,
}

/// The corners of `points` that count: VF has three, EE four.
macro_rules! for_each_corner {
    ($shape:ty, $corners:expr, |$corner:ident| $action:block) => {{
        let [a, b, c, d] = $corners;
        if matches!(<$shape>::KIND, PairKind::EdgeEdge) {
            let $corner = a;
            $action
        }
        {
            let $corner = b;
            $action
        }
        {
            let $corner = c;
            $action
        }
        {
            let $corner = d;
            $action
        }
    }};
}

/// One round. `elementary/advance` has the derivations.
#[inline(always)]
pub(super) fn round<P: PairShape, L: Quotients>(
    points: &PairPoints<L>,
    time: L,
    question: &RoundQuestion<L::Scalar>,
) -> LaneRound<L>
where
    L::Scalar: Scalar,
{
    let limits = &question.limits;
    let zero = time.splat(L::Scalar::ZERO);
    let one = time.splat(L::Scalar::ONE);
    let (start, end) = (P::corners(points.start), P::corners(points.end));
    let rest = one - time;
    macro_rules! at_time {
        ($index:expr) => {
            start[$index].scaled(rest) + end[$index].scaled(time)
        };
    }
    let now = [at_time!(0), at_time!(1), at_time!(2), at_time!(3)];

    let mut extent = start[0].abs();
    for_each_corner!(P, [0, 1, 2, 3], |corner| {
        extent = extent.larger(start[corner].abs()).larger(end[corner].abs());
    });
    let vanishing = time.splat(of_format(-100, -960));
    let extent = extent + Vector::new(vanishing, vanishing, vanishing);
    let is_in_range = time.splat(largest_extent()).greater(extent.largest()) & points.is_finite();

    let w = closest::<P, L>(now);
    let near_length = limits.tolerance + limits.separation;
    let squared_distance = w.dot(w);
    let is_beyond = squared_distance.greater(time.splat(near_length * near_length));

    let mut bar =
        time.splat(L::Scalar::small(20) * L::Scalar::UNIT_ROUNDOFF) * w.abs().dot(extent) + time.splat(L::Scalar::UNDERFLOW);
    if limits.separation > L::Scalar::ZERO {
        let factor = time.splat(more_roundoffs(32));
        bar = bar + time.splat(limits.separation) * (length_above(w) * factor);
    }

    // Until when w, held constant, keeps the pair apart: `Corners::apart_along`.
    let never = time.splat(L::Scalar::small(2));
    let less = time.splat(less_roundoffs(32));
    let mut is_proven = is_in_range;
    let mut until = never;
    for_each_corner!(P, [0, 1, 2, 3], |corner| {
        is_proven = is_proven & w.dot(now[corner]).greater(bar);
        let at_end = w.dot(end[corner]);
        let at_start = w.dot(start[corner]);
        let stays = at_end.greater(bar);
        let comes_down = at_start.greater(at_end);
        // Zero, or 0/0 where differences are flushed, is no progress.
        let quotient = (at_start - bar).over(at_start - at_end) * less;
        is_proven = is_proven & (stays | comes_down & quotient.greater(zero));
        until = L::select(stays, until, until.smaller(quotient));
    });
    is_proven = is_proven & until.greater(time);

    if question.with_volume && limits.separation == L::Scalar::ZERO {
        let (later, to_the_end) = volume_apart_from::<P, L>(&start, &end, extent, time);
        let later = L::select(to_the_end, never, later);
        let is_later = later.greater(until) | L::not(is_proven);
        let is_later = is_in_range & later.greater(time) & is_later;
        until = L::select(is_later, later, until);
        is_proven = is_proven | is_later;
    }

    let is_number = time.splat(L::Scalar::INFINITY).greater(squared_distance);
    let near = is_in_range & is_number & L::not(is_beyond);
    let open = is_proven & L::not(near);
    LaneRound {
        time: L::select(open, until, time),
        apart: open & until.greater(time.splat(question.until)),
        near,
        stuck: L::not(open | near),
    }
}

/// The point of the corners' hull that is closest to the origin, but for rounding: `elementary/closest.rs`, without branches. Not
/// a number for some degenerate pairs.
#[inline(always)]
fn closest<P: PairShape, L: Quotients>(corners: [Vector<L>; 4]) -> Vector<L> {
    match P::KIND {
        PairKind::VertexFace => {
            let [_, a, b, c] = corners;
            in_triangle(a, b, c)
        }
        PairKind::EdgeEdge => {
            let [a, b, c, _] = corners;
            in_parallelogram(a, b, c)
        }
    }
}

/// The weights of the interior, then those of each side and corner where it is closest.
#[inline(always)]
fn in_triangle<L: Quotients>(a: Vector<L>, b: Vector<L>, c: Vector<L>) -> Vector<L> {
    let zero = a.x.splat(L::Scalar::ZERO);
    let one = a.x.splat(L::Scalar::ONE);
    macro_rules! not_above {
        ($x:expr, $y:expr) => {
            L::not($x.greater($y))
        };
    }
    let (ab, ac) = (a - b, a - c);
    let (ab_a, ac_a) = (ab.dot(a), ac.dot(a));
    let (ab_b, ac_b) = (ab.dot(b), ac.dot(b));
    let (ab_c, ac_c) = (ab.dot(c), ac.dot(c));
    let area_a = ab_b * ac_c - ab_c * ac_b;
    let area_b = ab_c * ac_a - ab_a * ac_c;
    let area_c = ab_a * ac_b - ab_b * ac_a;

    // One quotient serves all: its terms are chosen first. The weight of b is `to_b` times it, that of c `to_c` times.
    let (from_b, from_c) = (ac_b - ab_b, ab_c - ac_c);
    let mut divisor = (area_a + area_b) + area_c;
    let (mut to_b, mut to_c) = (area_b, area_c);
    macro_rules! choose {
        ($where:expr, $divisor:expr, $to_b:expr, $to_c:expr) => {
            let here = $where;
            divisor = L::select(here, $divisor, divisor);
            to_b = L::select(here, $to_b, to_b);
            to_c = L::select(here, $to_c, to_c);
        };
    }
    let side = not_above!(area_a, zero) & not_above!(zero, from_b) & not_above!(zero, from_c);
    choose!(side, from_b + from_c, from_c, from_b);
    let side = not_above!(area_b, zero) & not_above!(zero, ac_a) & not_above!(ac_c, zero);
    choose!(side, ac_a - ac_c, zero, ac_a);
    let corner = not_above!(zero, ac_c) & not_above!(ab_c, ac_c);
    choose!(corner, one, zero, one);
    let side = not_above!(area_c, zero) & not_above!(zero, ab_a) & not_above!(ab_b, zero);
    choose!(side, ab_a - ab_b, ab_a, zero);
    let corner = not_above!(zero, ab_b) & not_above!(ac_b, ab_b);
    choose!(corner, one, one, zero);
    let corner = not_above!(ab_a, zero) & not_above!(ac_a, zero);
    choose!(corner, one, zero, zero);
    let scale = one.over(divisor);
    a - (ab.scaled(to_b * scale) + ac.scaled(to_c * scale))
}

/// Corners a, a + (b − a)·t + (c − a)·s for s and t of 0 and 1: the two edges' parameters.
#[inline(always)]
fn in_parallelogram<L: Quotients>(a: Vector<L>, b: Vector<L>, c: Vector<L>) -> Vector<L> {
    let zero = a.x.splat(L::Scalar::ZERO);
    let one = a.x.splat(L::Scalar::ONE);
    // The quotient if it lies in [0, 1], else the nearer end; NaN becomes an end.
    macro_rules! clamped {
        ($numerator:expr, $denominator:expr) => {{
            let (numerator, denominator) = ($numerator, $denominator);
            let quotient = numerator.over(denominator);
            let inside = L::select(denominator.greater(numerator), quotient, one);
            L::select(numerator.greater(zero), inside, zero)
        }};
    }
    let (first, second) = (c - a, a - b);
    let (first_squared, second_squared) = (first.dot(first), second.dot(second));
    let (along_first, along_second) = (first.dot(a), second.dot(a));
    let across = first.dot(second);
    let scale = first_squared * second_squared - across * across;
    let s = clamped!(across * along_second - along_first * second_squared, scale);
    let t = clamped!(across * s + along_second, second_squared);
    let s = clamped!(across * t - along_first, first_squared);
    (a + first.scaled(s)) - second.scaled(t)
}

/// The length of `w`, or more, but for 8 roundings: `elementary/advance/directions.rs`.
#[inline(always)]
fn length_above<L: Quotients>(w: Vector<L>) -> L
where
    L::Scalar: Scalar,
{
    let squared = w.dot(w);
    let magnitudes = w.abs();
    let sum = (magnitudes.x + magnitudes.y) + magnitudes.z;
    let is_safe = squared.greater(squared.splat(of_format(-100, -900)));
    L::select(is_safe, squared.sqrt(), sum)
}

/// How often the volume is clipped.
const CLIPS: u32 = 2;

/// Until when the signed volume proves, from `time` on, that the pair is apart, which may be `time`; and whether to the end:
/// `elementary/advance/volume.rs`, for a separation of zero.
#[inline(always)]
fn volume_apart_from<P: PairShape, L: Quotients>(
    start: &[Vector<L>; 4],
    end: &[Vector<L>; 4],
    extent: Vector<L>,
    time: L,
) -> (L, L::Mask)
where
    L::Scalar: Scalar,
{
    let zero = time.splat(L::Scalar::ZERO);
    let one = time.splat(L::Scalar::ONE);
    let never = time.splat(L::Scalar::small(2));
    let third = time.splat(L::Scalar::from_f64(1.0 / 3.0));
    let two = time.splat(L::Scalar::small(2));
    let three = time.splat(L::Scalar::small(3));
    let ([a0, b0, c0, d0], [a1, b1, c1, d1]) = (*start, *end);
    let tetrahedron = match P::KIND {
        PairKind::VertexFace => MovingTetrahedron {
            p: [b0, b1],
            b: [c0, c1],
            c: [d0, d1],
        },
        PairKind::EdgeEdge => MovingTetrahedron {
            p: [a0, a1],
            b: [b0, b1],
            c: [c0, c1],
        },
    };
    let [k0, k1, k2, k3] = tetrahedron.control_values().0;
    let (k1, k2) = (k1 * third, k2 * third);
    let size = one + extent.largest();
    let error = time.splat(L::Scalar::small(64) * L::Scalar::UNIT_ROUNDOFF) * extent.dot(extent.cross_permanent(extent))
        + time.splat(L::Scalar::UNDERFLOW) * (size * size);

    macro_rules! mix {
        ($part:expr, $rest:expr, $a:expr, $b:expr) => {
            $rest * $a + $part * $b
        };
    }
    let mut proven = time;
    let mut to_the_end = zero.greater(zero);
    for _ in 0..CLIPS {
        // The control values on what is left, in whichever sign makes the first positive, less the error.
        let rest = one - proven;
        let a0 = mix!(proven, rest, k0, k1);
        let a1 = mix!(proven, rest, k1, k2);
        let b2 = mix!(proven, rest, k2, k3);
        let c0 = mix!(proven, rest, a0, a1);
        let b1 = mix!(proven, rest, a1, b2);
        let b0 = mix!(proven, rest, c0, b1);
        let is_negative = zero.greater(b0);
        let m0 = L::select(is_negative, -b0, b0) - error;
        let m1 = L::select(is_negative, -b1, b1) - error;
        let m2 = L::select(is_negative, -b2, b2) - error;
        let m3 = L::select(is_negative, -k3, k3) - error;
        let is_good = m0.greater(zero);
        let (p1, p2, p3) = (m1.greater(zero), m2.greater(zero), m3.greater(zero));
        to_the_end = to_the_end | is_good & p1 & p2 & p3;

        // Where the lower hull of the control polygon comes down to zero first.
        let mut first = never;
        macro_rules! line {
            ($where:expr, $zero:expr) => {
                first = first.smaller(L::select($where, $zero, never));
            };
        }
        line!(L::not(p1), m0.over(three * (m0 - m1)));
        line!(L::not(p2), m0 * two.over(three * (m0 - m2)));
        line!(L::not(p3), m0 * three.over(three * (m0 - m3)));
        line!(p1 & L::not(p2), (one + m1.over(m1 - m2)) * third);
        line!(p1 & L::not(p3), (one + two * m1.over(m1 - m3)) * third);
        line!(p1 & p2 & L::not(p3), (two + m2.over(m2 - m3)) * third);

        // Four or sixteen times as much where the part before that has positive control values only.
        let mut part = first;
        for times in [4, 16] {
            let longer = time.splat(L::Scalar::small(times)) * first;
            let rest = one - longer;
            let a0 = mix!(longer, rest, m0, m1);
            let a1 = mix!(longer, rest, m1, m2);
            let a2 = mix!(longer, rest, m2, m3);
            let c0 = mix!(longer, rest, a0, a1);
            let c1 = mix!(longer, rest, a1, a2);
            let d0 = mix!(longer, rest, c0, c1);
            let holds = rest.greater(zero) & a0.greater(zero) & c0.greater(zero) & d0.greater(zero);
            part = L::select(holds, longer, part);
        }
        let next = (proven + part * (one - proven) * time.splat(less_roundoffs(32))) * time.splat(less_roundoffs(8));
        let advances = is_good & next.greater(proven);
        proven = L::select(advances, next, proven);
    }
    (proven, to_the_end)
}
