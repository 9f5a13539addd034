//! The plain cubic test of Provot 1997, as a baseline. **Not certified: it misses contacts.**
//!
//! The four points are coplanar at the roots of a cubic. The test takes each root in [0, 1], earliest first. It checks whether
//! the vertex lies in the triangle (barycentric coordinates in [0, 1]), or the two lines' nearest points lie on both edges.
//! Everything is computed in plain floating point without a tolerance, so the answer is sometimes wrong either way:
//! * Pairs that are coplanar throughout (the cubic is zero) count as free of contact, and so do parallel edges.
//! * Rounding may lose a double root (a graze).
//! * Rounding may move a contact at the border of the triangle or at the end of an edge outside.
//!
//! `selvedge queries --method cubic` shows how often.

use selvedge_core::kernels::coplanarity::MovingTetrahedron;
use selvedge_core::kernels::vector::Vector;
use selvedge_core::{Motion, PairKind, PrimitivePair, Scalar};

/// Returns the earliest time in [0, 1] at which the vertex is in the triangle, or the edges cross. It may be wrong: see the
/// module.
///
/// ```
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_laboratory::baselines::cubic;
/// let pair = PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(0.2, 0.2, 1.0), DVec3::new(0.2, 0.2, -3.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// assert_eq!(cubic::time_of_impact(&pair), Some(0.25));
/// ```
#[inline]
pub fn time_of_impact<S: Scalar>(pair: &PrimitivePair<S>) -> Option<S> {
    match pair.kind {
        PairKind::VertexFace => first_root(pair, is_in_triangle),
        PairKind::EdgeEdge => first_root(pair, do_cross),
    }
}

#[inline(always)]
fn is_in_triangle<S: Scalar>([vertex, a, b, c]: [Vector<S>; 4]) -> bool {
    let (b, c, p) = (b - a, c - a, vertex - a);
    let normal = b.cross(c);
    let area = normal.dot(normal);
    let along_b = p.cross(c).dot(normal);
    let along_c = b.cross(p).dot(normal);
    area > S::ZERO && along_b >= S::ZERO && along_c >= S::ZERO && along_b + along_c <= area
}

#[inline(always)]
fn do_cross<S: Scalar>([u, v, k, l]: [Vector<S>; 4]) -> bool {
    let (first, second, between) = (v - u, l - k, k - u);
    let normal = first.cross(second);
    let scale = normal.dot(normal);
    let along_first = between.cross(second).dot(normal);
    let along_second = between.cross(first).dot(normal);
    let on_edge = |along: S| along >= S::ZERO && along <= scale;
    scale > S::ZERO && on_edge(along_first) && on_edge(along_second)
}

/// Returns the position at `time`, rounded.
#[inline(always)]
fn at<S: Scalar>(motion: Motion<S>, time: S) -> Vector<S> {
    let [start, end] = [motion.start, motion.end].map(|position| Vector::from(position.into()));
    start.scaled(S::ONE - time) + end.scaled(time)
}

/// Returns the earliest root of the pair's cubic in [0, 1] at which `accept` agrees with the positions of the four points.
#[inline(always)]
fn first_root<S: Scalar>(pair: &PrimitivePair<S>, accept: impl Fn([Vector<S>; 4]) -> bool) -> Option<S> {
    let cubic = Cubic::new(pair.into());
    let accept = |time| accept(pair.motions.map(|motion| at(motion, time)));
    let mut found = None;
    cubic.for_each_monotone_piece(|from, to| {
        if let Some(root) = cubic.root_between(from, to).filter(|&root| accept(root)) {
            found = Some(root);
        }
        found.is_some()
    });
    found
}

/// A cubic by its four control values (none tripled).
pub(super) struct Cubic<S> {
    pub(super) k: [S; 4],
}

impl<S: Scalar> Cubic<S> {
    #[inline(always)]
    pub(super) fn new(tetrahedron: MovingTetrahedron<S>) -> Self {
        let [k0, k1, k2, k3] = tetrahedron.control_values().0;
        let third = S::from_f64(1.0 / 3.0);
        Self {
            k: [k0, k1 * third, k2 * third, k3],
        }
    }

    /// Evaluates the cubic by de Casteljau's rule.
    #[inline(always)]
    fn at(&self, t: S) -> S {
        let mix = |a: S, b: S| (S::ONE - t) * a + t * b;
        let [k0, k1, k2, k3] = self.k;
        let (a, b, c) = (mix(k0, k1), mix(k1, k2), mix(k2, k3));
        mix(mix(a, b), mix(b, c))
    }

    /// Calls `visit(from, to)` on the pieces of [0, 1] between the extremes, in order, until it returns true.
    #[inline(always)]
    pub(super) fn for_each_monotone_piece(&self, mut visit: impl FnMut(S, S) -> bool) {
        let mut from = S::ZERO;
        for extreme in self.extremes() {
            if extreme > from && extreme < S::ONE {
                if visit(from, extreme) {
                    return;
                }
                from = extreme;
            }
        }
        visit(from, S::ONE);
    }

    /// Returns the roots of the derivative in increasing order, or NaN or infinite numbers without any.
    #[inline(always)]
    fn extremes(&self) -> [S; 2] {
        let [k0, k1, k2, k3] = self.k;
        // The derivative / 3 is d₀(1−t)² + 2d₁(1−t)t + d₂t² = a·t² − 2b·t + d₀.
        let (d0, d1, d2) = (k1 - k0, k2 - k1, k3 - k2);
        let (a, b) = (d0 - d1 - d1 + d2, d0 - d1);
        let root = (b * b - a * d0).sqrt();
        let sum = if b > S::ZERO { b + root } else { b - root };
        let (first, second) = (sum / a, d0 / sum);
        if first < second { [first, second] } else { [second, first] }
    }

    /// Returns the root on a monotone piece, by regula falsi (the Illinois rule), to a rounding error of [0, 1]. Returns `None`
    /// without a change of sign.
    #[inline(always)]
    fn root_between(&self, mut from: S, mut to: S) -> Option<S> {
        let (mut low, mut high) = (self.at(from), self.at(to));
        if low == S::ZERO && high == S::ZERO {
            return None; // zero throughout the piece
        }
        if low == S::ZERO {
            return Some(from);
        }
        if high == S::ZERO {
            return Some(to);
        }
        let falling = low > S::ZERO;
        if falling == (high > S::ZERO) || !(low.is_finite() && high.is_finite()) {
            return None;
        }
        let half = S::from_f64(0.5);
        let mut root = from;
        let mut last_moved_from = None;
        // About ten rounds suffice for a cubic; the limit only bounds the work.
        for _ in 0..64 {
            let guess = from + (to - from) * (low / (low - high));
            if (guess - root).abs() <= S::UNIT_ROUNDOFF {
                break;
            }
            root = guess;
            let value = self.at(guess);
            if value == S::ZERO {
                break;
            }
            let moves_from = (value > S::ZERO) == falling;
            let repeated = last_moved_from == Some(moves_from);
            last_moved_from = Some(moves_from);
            if moves_from {
                (from, low) = (guess, value);
                if repeated {
                    high = high * half;
                }
            } else {
                (to, high) = (guess, value);
                if repeated {
                    low = low * half;
                }
            }
        }
        Some(root)
    }
}
