//! Bernstein sign classification (Tang, Tong, Wang, Manocha: Fast and exact continuous collision detection with Bernstein sign
//! classification, 2014), in plain floating point, as a baseline. **Not certified: it misses contacts.**
//!
//! The method decides whether there is contact, not when. It uses signs of polynomials in Bernstein form and computes no roots.
//!
//! * The volume K is a cubic. Between its extremes it has one root where its signs at both ends differ, and none otherwise.
//! * Let eᵢ be the pair's corners in order around the triangle or parallelogram, and n its normal. The origin is inside at the
//!   root if no **inside function** gᵢ = (eᵢ × eᵢ₊₁)·n is negative there. These are quartics; their control values follow from
//!   those of the two quadratics in the product. If all five control values have one strict sign, that is the sign at the root. A
//!   function that is negative throughout excludes contact, even if the pair is coplanar.
//! * Otherwise the function is reduced modulo the cubic, which keeps its value at the cubic's root: c²·g = q·K + r. Here c is the
//!   leading coefficient of K, and r has degree two. The sign of r at the root follows from the order of that root and the roots
//!   of r. That order follows from the signs of K at the roots of r.
//!
//! In exact arithmetic this is a decision. The paper uses expansions if floating point is in doubt. Here rounding is ignored, to
//! show the cost of the classification alone and how often it then errs. The reduction suffers most: if K is nearly of lower
//! degree, c²·g and q·K nearly cancel. [`exact::touches`](selvedge_core::kernels::exact::touches) decides exactly, by the
//! same idea with quadratics in place of quartics.
//!
//! If K is zero throughout there is no root. The pair then counts as touching unless an inside function is negative throughout.
//! The inside functions are zero where the normal is, so degenerate pairs are false alarms rather than misses. The code is
//! written from the paper's description.

use super::cubic::Cubic;
use selvedge_core::PairKind;
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::{PairPoints, PairShape};
use selvedge_core::kernels::vector::Vector;
use selvedge_core::motion::PrimitivePair;
use selvedge_core::scalar::Scalar;

/// Returns whether the pair touches at some time in [0, 1]. Rounding can make either answer wrong: see the module.
///
/// NaN and infinite coordinates exclude nothing.
///
/// ```
/// use selvedge_core::{glam::DVec3, Motion, PrimitivePair};
/// use selvedge_laboratory::baselines::bernstein_sign;
/// let falls_at = |x| PrimitivePair::vertex_face(
///     Motion::new(DVec3::new(x, 0.2, 1.0), DVec3::new(x, 0.2, -3.0)),
///     [DVec3::ZERO, DVec3::X, DVec3::Y].map(Motion::resting),
/// );
/// assert!(bernstein_sign::touches(&falls_at(0.2)));
/// assert!(!bernstein_sign::touches(&falls_at(0.9)));
/// ```
pub fn touches<S: Scalar>(pair: &PrimitivePair<S>) -> bool {
    of_kind!(pair.kind, P => touches_of::<S, P>(&pair.into()))
}

fn touches_of<S: Scalar, P: PairShape>(points: &PairPoints<S>) -> bool {
    if !points.is_finite() {
        return true;
    }
    let mut touches = false;
    Cubic::new(points.tetrahedron::<P>()).for_each_monotone_piece(|from, to| {
        // Motion between two times is linear as well.
        let piece = PairPoints {
            start: at(points, from),
            end: at(points, to),
        };
        let [a, b, c, d] = corners::<S, P>(&piece);
        let cubic = Cubic::new(piece.tetrahedron::<P>());
        touches = cubic.may_have_a_root()
            && match P::KIND {
                PairKind::VertexFace => contains_origin_at_root([b, c, d], &cubic),
                PairKind::EdgeEdge => contains_origin_at_root([a, b, d, c], &cubic),
            };
        touches
    });
    touches
}

#[inline(always)]
fn at<S: Scalar>(points: &PairPoints<S>, time: S) -> [Vector<S>; 4] {
    let mut positions = points.start;
    for (position, end) in positions.iter_mut().zip(points.end) {
        *position = position.scaled(S::ONE - time) + end.scaled(time);
    }
    positions
}

/// A linear polynomial by its values at 0 and 1.
type Linear<S> = [Vector<S>; 2];

#[inline(always)]
fn corners<S: Scalar, P: PairShape>(points: &PairPoints<S>) -> [Linear<S>; 4] {
    let [a0, b0, c0, d0] = P::corners(points.start);
    let [a1, b1, c1, d1] = P::corners(points.end);
    [[a0, a1], [b0, b1], [c0, c1], [d0, d1]]
}

/// Returns whether the polygon with these corners, in order around it, contains the origin at the cubic's only root.
#[inline(always)]
fn contains_origin_at_root<S: Scalar, const N: usize>(corners: [Linear<S>; N], cubic: &Cubic<S>) -> bool {
    let next = || corners.iter().cycle().skip(1);
    // Twice the area for a triangle, four times for a parallelogram. It points to where the corners run anticlockwise.
    let zero = Vector::new(S::ZERO, S::ZERO, S::ZERO);
    let mut normal = [zero; 3];
    for (corner, next) in corners.iter().zip(next()) {
        for (sum, part) in normal.iter_mut().zip(cross(corner, next)) {
            *sum = *sum + part;
        }
    }
    corners.iter().zip(next()).all(|(corner, next)| {
        let inside = dot(&cross(corner, next), &normal);
        !is_negative_at_root(&inside, &cubic.k)
    })
}

/// Returns control values of the cross product of two linear polynomials.
#[inline(always)]
fn cross<S: Scalar>([a0, a1]: &Linear<S>, [b0, b1]: &Linear<S>) -> [Vector<S>; 3] {
    let half = S::from_f64(0.5);
    let between = a0.cross(*b1) + a1.cross(*b0);
    [a0.cross(*b0), between.scaled(half), a1.cross(*b1)]
}

/// Returns control values of the dot product of two quadratics.
#[inline(always)]
fn dot<S: Scalar>([m0, m1, m2]: &[Vector<S>; 3], [n0, n1, n2]: &[Vector<S>; 3]) -> [S; 5] {
    let (half, four) = (S::from_f64(0.5), S::from_f64(4.0));
    let sixth = S::from_f64(1.0 / 6.0);
    [
        m0.dot(*n0),
        (m0.dot(*n1) + m1.dot(*n0)) * half,
        (m0.dot(*n2) + four * m1.dot(*n1) + m2.dot(*n0)) * sixth,
        (m1.dot(*n2) + m2.dot(*n1)) * half,
        m2.dot(*n2),
    ]
}

impl<S: Scalar> Cubic<S> {
    /// Returns whether the signs at the ends are not one strict sign.
    #[inline(always)]
    fn may_have_a_root(&self) -> bool {
        let [start, .., end] = self.k;
        !(start > S::ZERO && end > S::ZERO || start < S::ZERO && end < S::ZERO)
    }
}

/// Returns whether a quartic is negative at the only root of a cubic in [0, 1]. Both are given by control values.
#[inline(always)]
fn is_negative_at_root<S: Scalar>(quartic: &[S; 5], cubic: &[S; 4]) -> bool {
    if quartic.iter().all(|&value| value < S::ZERO) {
        return true;
    }
    if quartic.iter().all(|&value| value >= S::ZERO) {
        return false;
    }
    let [at_start, .., at_end] = *quartic;
    match (cubic[0] == S::ZERO, cubic[3] == S::ZERO) {
        (true, true) => false, // the cubic is zero throughout
        (true, false) => at_start < S::ZERO,
        (false, true) => at_end < S::ZERO,
        (false, false) => is_negative_by_reduction(quartic, cubic),
    }
}

fn is_negative_by_reduction<S: Scalar>(quartic: &[S; 5], cubic: &[S; 4]) -> bool {
    let volume = coefficients_of_cubic(cubic);
    let [r0, r1, r2] = remainder(coefficients_of_quartic(quartic), volume);
    let at = |[c0, c1, c2, c3]: [S; 4], t: S| c0 + t * (c1 + t * (c2 + t * c3));
    // Where the remainder changes sign before the root, its sign there is opposite to that at the start.
    let mut is_negative = [r0, r1, r2]
        .into_iter()
        .find(|&value| value != S::ZERO)
        .is_some_and(|value| value < S::ZERO);
    for zero in roots([r0, r1, r2]) {
        if !(zero > S::ZERO && zero < S::ONE) {
            continue;
        }
        let value = at(volume, zero);
        if value == S::ZERO {
            return false; // the remainder is zero at the root
        }
        if (value > S::ZERO) == (volume[0] > S::ZERO) {
            is_negative = !is_negative;
        }
    }
    is_negative
}

/// Returns the coefficients of 1, t, t² …, scaled to at most one.
#[inline(always)]
fn coefficients_of_cubic<S: Scalar>(&[k0, k1, k2, k3]: &[S; 4]) -> [S; 4] {
    let three = S::small(3);
    normalised([
        k0,
        three * (k1 - k0),
        three * ((k2 - k1) - (k1 - k0)),
        (k3 - k0) - three * (k2 - k1),
    ])
}

/// Returns the coefficients of 1, t, t² …, scaled to at most one.
#[inline(always)]
fn coefficients_of_quartic<S: Scalar>(&[b0, b1, b2, b3, b4]: &[S; 5]) -> [S; 5] {
    let (four, six) = (S::small(4), S::small(6));
    normalised([
        b0,
        four * (b1 - b0),
        six * ((b2 - b1) - (b1 - b0)),
        four * ((b3 - b0) - S::small(3) * (b2 - b1)),
        (b4 + b0) - four * (b3 + b1) + six * b2,
    ])
}

#[inline(always)]
fn normalised<S: Scalar, const N: usize>(mut coefficients: [S; N]) -> [S; N] {
    let largest = coefficients
        .iter()
        .fold(S::ZERO, |largest, value| largest.larger(value.abs()));
    if largest > S::ZERO {
        for value in &mut coefficients {
            *value = *value / largest;
        }
    }
    coefficients
}

/// Returns the quartic modulo a polynomial of degree three or less, times a positive number.
#[inline(always)]
fn remainder<S: Scalar>(g: [S; 5], [c0, c1, c2, c3]: [S; 4]) -> [S; 3] {
    let [g0, g1, g2, g3, g4] = g;
    if c3 != S::ZERO {
        // c3·g − g4·t·K has degree three. Repeating this gives degree two, times c3².
        let [h0, h1, h2, h3] = normalised([c3 * g0, c3 * g1 - g4 * c0, c3 * g2 - g4 * c1, c3 * g3 - g4 * c2]);
        return [c3 * h0 - h3 * c0, c3 * h1 - h3 * c1, c3 * h2 - h3 * c2];
    }
    if c2 != S::ZERO {
        // t² equals −(c0 + c1·t)/c2, which is applied from the highest power down.
        let (p, q) = (S::ZERO - c0 / c2, S::ZERO - c1 / c2);
        let g3 = g3 + g4 * q;
        let g2 = g2 + g4 * p + g3 * q;
        return [g0 + g2 * p, g1 + g3 * p + g2 * q, S::ZERO];
    }
    let root = S::ZERO - c0 / c1;
    let value = g0 + root * (g1 + root * (g2 + root * (g3 + root * g4)));
    [value, S::ZERO, S::ZERO]
}

/// Returns the real roots of a quadratic, or NaN or infinite numbers without any.
#[inline(always)]
fn roots<S: Scalar>([r0, r1, r2]: [S; 3]) -> [S; 2] {
    let half = S::from_f64(0.5);
    let b = S::ZERO - half * r1;
    let root = (b * b - r2 * r0).sqrt();
    let sum = if b > S::ZERO { b + root } else { b - root };
    [sum / r2, r0 / sum]
}
