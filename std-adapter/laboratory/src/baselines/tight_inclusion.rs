//! Bisection of the cube of time and two parameters, after Tight-Inclusion (Wang, Ferguson, Schneider, Jiang, Attene, Panozzo: A
//! Large-scale Benchmark and an Inclusion-based Algorithm for Continuous Collision Detection, 2021), as a baseline. It never
//! misses, but has **no useful bound of its work**.
//!
//! F(t, u, v) is the difference of two points: one set's at parameter u (or the vertex), and the other's at v (or the face's at
//! u, v). F is linear in each variable, so its values on a box lie in the box of its values at the corners. If that box does not
//! contain the origin, up to the error of evaluation, there is no contact. Otherwise the search halves the box, until F's values
//! on it span less than the tolerance on each axis.
//!
//! * Where contact lasts or nearly happens (sliding, resting, parallel edges), the number of boxes grows as the inverse square of
//!   the tolerance. After [`MOST_BOXES`] boxes the search ends with the earliest time not excluded. That is no miss, but may be
//!   far too early.
//! * Contact means that F is within the tolerance *on each axis*. The separation counts in the same way.
//!
//! The code is written from the description. It differs from the original in two ways. The search is depth-first, earlier half
//! first, and cuts off boxes that are later than the best time found, so that a short stack suffices. The error bound is that of
//! the evaluation here, linear in the coordinates.
//!
//! # Rounding
//! F comes from the positions at t (1 − t, two products, a sum), their weighted sums (1 − u − v, a product, two sums), and a
//! difference. A monomial passes through at most 9 roundings. The magnitudes add up to at most 4m for coordinates up to m on that
//! axis (|1 − u − v| + u + v ≤ 3). The error is thus 36εm to first order, and ε = 2u in any direction of rounding. The bound
//! 80u·max(1, m) covers that and the second order; the 1 covers underflow. (The published code has min(1, m), which does not
//! bound the error of large coordinates.)

use arrayvec::ArrayVec;
use selvedge_core::PairKind;
use selvedge_core::elementary::{Impact, Limits, Reason};
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::{PairPoints, PairShape};
use selvedge_core::kernels::vector::Vector;
use selvedge_core::motion::PrimitivePair;
use selvedge_core::scalar::Scalar;

/// The largest number of boxes that a search tests.
pub const MOST_BOXES: u32 = 1_000_000;

/// The largest number of open boxes: one for each halving that led to the present one, at most 52 along each of three axes.
const OPEN: usize = 160;

/// Returns the time from which the pair may be within the separation, on each axis. The module's documentation lists what is not
/// promised.
///
/// NaN, infinite and very large coordinates exclude nothing.
///
/// ```
/// use selvedge_core::elementary::Limits;
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_laboratory::baselines::tight_inclusion::time_of_impact;
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -1.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// let limits = Limits { tolerance: 1e-6, separation: 0.0 };
/// let time = time_of_impact(&pair, &limits).time().unwrap();
/// assert!(0.499999 < time && time <= 0.5);
/// ```
#[inline]
pub fn time_of_impact<S: Scalar>(pair: &PrimitivePair<S>, limits: &Limits<S>) -> Impact<S> {
    of_kind!(pair.kind, P => search::<S, P>(&pair.into(), limits))
}

/// A box of times and parameters.
#[derive(Clone, Copy, Debug)]
struct Cell<S> {
    low: [S; 3],
    size: [S; 3],
}

fn search<S: Scalar, P: PairShape>(points: &PairPoints<S>, limits: &Limits<S>) -> Impact<S> {
    let possible = |time, reason| Impact::Possible { time, reason };
    if !(points.is_finite() && limits.separation >= S::ZERO) {
        return possible(S::ZERO, Reason::NotFinite);
    }
    let mut largest = Vector::new(S::ONE, S::ONE, S::ONE);
    for point in points.start.iter().chain(&points.end) {
        largest = point.abs().larger(largest);
    }
    if !(largest.largest() <= S::LARGEST_EXTENT && limits.separation <= S::LARGEST_EXTENT) {
        return possible(S::ZERO, Reason::OutOfRange);
    }
    let error = largest.scaled(S::small(80) * S::UNIT_ROUNDOFF);
    let apart = Vector::new(limits.separation, limits.separation, limits.separation);
    let room = (error + apart).scaled(S::ONE + S::small(8) * S::UNIT_ROUNDOFF);

    let mut earliest: Option<(S, Reason)> = None;
    let mut open = ArrayVec::<Cell<S>, OPEN>::new();
    open.push(Cell {
        low: [S::ZERO; 3],
        size: [S::ONE; 3],
    });
    let mut checks = 0;
    while let Some(cell) = open.pop() {
        let [time, ..] = cell.low;
        if earliest.is_some_and(|(known, _)| time >= known) {
            continue;
        }
        if checks == MOST_BOXES {
            // This cell and every other open one may hold contact.
            let times = open.iter().map(|cell| cell.low[0]);
            let first = times.fold(time, |first, time| time.smaller(first));
            return possible(first, Reason::LastResort);
        }
        checks += 1;
        let [low, high] = image_of::<S, P>(points, &cell);
        let excluded = low.x > room.x
            || low.y > room.y
            || low.z > room.z
            || -high.x > room.x
            || -high.y > room.y
            || -high.z > room.z
            || (P::KIND == PairKind::VertexFace && cell.low[1] + cell.low[2] > S::ONE);
        if excluded {
            continue;
        }
        let width = (high - low).largest();
        let halves = if width > limits.tolerance {
            halves::<S, P>(points, &cell)
        } else {
            None
        };
        match halves {
            Some([earlier, later]) if open.len() + 2 <= OPEN => {
                // The last box pushed is the first popped.
                open.push(later);
                open.push(earlier);
            }
            _ => {
                let reason = if width > limits.tolerance {
                    Reason::WithinError
                } else {
                    Reason::WithinTolerance
                };
                earliest = Some((time, reason));
            }
        }
    }
    earliest.map_or(Impact::Never, |(time, reason)| possible(time, reason))
}

/// Returns the box of F's values at the eight corners of `cell`.
#[inline(always)]
fn image_of<S: Scalar, P: PairShape>(points: &PairPoints<S>, cell: &Cell<S>) -> [Vector<S>; 2] {
    let ([t, u, v], [dt, du, dv]) = (cell.low, cell.size);
    let mut range: Option<[Vector<S>; 2]> = None;
    for t in [t, t + dt] {
        let positions = at(points, t);
        for u in [u, u + du] {
            for v in [v, v + dv] {
                let value = difference::<S, P>(positions, u, v);
                let [low, high] = range.unwrap_or([value; 2]);
                let low = Vector::new(value.x.smaller(low.x), value.y.smaller(low.y), value.z.smaller(low.z));
                range = Some([low, value.larger(high)]);
            }
        }
    }
    let nothing = Vector::new(S::ZERO, S::ZERO, S::ZERO);
    range.unwrap_or([nothing; 2])
}

#[inline(always)]
fn at<S: Scalar>(points: &PairPoints<S>, time: S) -> [Vector<S>; 4] {
    let mut positions = points.start;
    for (position, end) in positions.iter_mut().zip(&points.end) {
        *position = position.scaled(S::ONE - time) + end.scaled(time);
    }
    positions
}

/// Evaluates F at the time of the positions.
#[inline(always)]
fn difference<S: Scalar, P: PairShape>(positions: [Vector<S>; 4], u: S, v: S) -> Vector<S> {
    let [a, b, c, d] = positions;
    match P::KIND {
        PairKind::VertexFace => a - ((b.scaled(S::ONE - u - v) + c.scaled(u)) + d.scaled(v)),
        PairKind::EdgeEdge => (a.scaled(S::ONE - u) + b.scaled(u)) - (c.scaled(S::ONE - v) + d.scaled(v)),
    }
}

/// Returns the two halves of `cell` along the variable in which F changes most, or `None` if precision allows no shorter box.
#[inline(always)]
fn halves<S: Scalar, P: PairShape>(points: &PairPoints<S>, cell: &Cell<S>) -> Option<[Cell<S>; 2]> {
    let ([t, u, v], [dt, du, dv]) = (cell.low, cell.size);
    let [now, later] = [at(points, t), at(points, t + dt)];
    let change = |from: Vector<S>, to: Vector<S>| (to - from).abs().largest();
    let [mut by_t, mut by_u, mut by_v] = [S::ZERO; 3];
    for (u, v) in [(u, v), (u + du, v), (u, v + dv), (u + du, v + dv)] {
        let [from, to] = [now, later].map(|at| difference::<S, P>(at, u, v));
        by_t = change(from, to).larger(by_t);
    }
    for at in [now, later] {
        let corner = |u, v| difference::<S, P>(at, u, v);
        by_u = change(corner(u, v), corner(u + du, v)).larger(by_u);
        by_v = change(corner(u, v), corner(u, v + dv)).larger(by_v);
        if P::KIND == PairKind::VertexFace {
            continue;
        }
        by_u = change(corner(u, v + dv), corner(u + du, v + dv)).larger(by_u);
        by_v = change(corner(u + du, v), corner(u + du, v + dv)).larger(by_v);
    }
    // A half must be representable: not below the format's precision at 1.
    let shortest = S::small(4) * S::UNIT_ROUNDOFF;
    let mut best: Option<(usize, S)> = None;
    for (variable, change) in [by_t, by_u, by_v].into_iter().enumerate() {
        let size = cell.size.get(variable).copied().unwrap_or(S::ZERO);
        if size > shortest && best.is_none_or(|(_, most)| change > most) {
            best = Some((variable, change));
        }
    }
    let (variable, _) = best?;
    let (mut earlier, mut later) = (*cell, *cell);
    let half = S::from_f64(0.5);
    let size = earlier.size.get_mut(variable)?;
    *size = *size * half;
    let length = *size;
    later.size = earlier.size;
    let low = later.low.get_mut(variable)?;
    *low = *low + length;
    Some([earlier, later])
}
