//! Truncation: the displacement of each point of a pair that lets the pair keep its distance, however far the others go. A step
//! is truncated vertex by vertex, where a time of impact would cut it for the whole mesh.
//!
//! **The lemma.** Let x be where the four points start, y where they are wanted, and d a direction with |d| ≤ 1. Along d the
//! first set A is ahead of the second B by more than m at the start: min_A d·x − max_B d·x > m. Choose an offset o with max_B d·x
//! ≤ o ≤ min_A d·x − m. Let each point go as far as e = x + s·(y − x), with its share s in [0, 1] at most the largest with d·e ≥
//! o + m in A and d·e ≤ o in B. Then the sets are at least m apart throughout the step from x to e, **and also for all smaller
//! shares, each on its own**.
//!
//! *Proof.* At s = 0 each point is in its half-space, by the choice of o. Half-spaces are convex, so it is there for every share
//! up to the largest, whatever the others' shares are. So the gap along d is at least m at the end, and more than m at the start.
//! Along straight paths it is linear in time ([`gap`](super::gap)). ∎
//!
//! **From a base.** The step may begin at another place than x, which is then a *base* from which its points continue towards y.
//! Then only the start needs a further test. If d keeps the pair more than m apart there too, the sets are at least m apart
//! throughout the step from there to e. *Proof.* The statement about the end of the path from x to y concerns e alone, and
//! straight paths from any start are linear in time. ∎ A step that cannot go from its start towards y first goes to a free base,
//! and from there as far as it can.
//!
//! A vertex takes the least of its shares over all of its pairs; their order does not matter. Only d is shared by both ends, and
//! o belongs to the end, so points that move together are not held back. Where d keeps the pair apart at y too, o is chosen so
//! that no point is held back. Otherwise the room is shared in proportion to how far each set goes towards the other.
//!
//! **Rounding.** The result has the ordinary certificate, of the stored positions: *no guarantee rests on the arithmetic here*.
//! So that the certificate succeeds, m is the threshold of [`gap`](super::gap), plus the same error once more, which covers the
//! rounding of e. A share is at most [`PART`] of the room.
//!
//! Shares towards planes are due to Chen, Hsu, Ayman and Macklin, *Divide and Truncate* (2026, arXiv 2604.15513), and Chen and
//! others, *Offset Geometric Contact* (2025). Both leave out pairs, or let them pass, that they cannot certify.

use super::gap::{GapError, threshold};
use crate::kind::PairKind;
use crate::lanes::{Lanes, Rounding};
use crate::points::PairShape;
use crate::scalar::{Position, Scalar};
use crate::vector::Vector;

/// The part of its room that a point may take. A point that took all of it would have none in the next step, and its pair would
/// rest from then on.
pub const PART: f64 = 127.0 / 128.0;

/// Returns the largest shares of their displacements from `start` to `wanted` that the four points may go, each in [0, 1]. With
/// them the pair keeps more than `separation` along `direction`. `direction` goes from the second set to the first and is no
/// longer than one. Returns `None` if it keeps the pair no farther apart than that at the start.
///
/// The shares of points that need not be held back are exactly 1. Shares are plain floating point, and never NaN. The
/// [module](self) has the proofs.
///
/// ```
/// use selvedge_core::{PairKind, glam::DVec3, separation::gap::GapError, separation::truncation::shares};
/// // A vertex that falls by 1 from half of that above a triangle that rises by as much.
/// let start = [DVec3::new(0.2, 0.2, 0.5), DVec3::ZERO, DVec3::X, DVec3::Y];
/// let wanted = [start[0] - DVec3::Z, start[1] + DVec3::Z, start[2] + DVec3::Z, start[3] + DVec3::Z];
/// let error = GapError::from_largest_coordinate(1.5);
/// let [vertex, face, ..] = shares(PairKind::VertexFace, [start, wanted], DVec3::Z, 0.1, error).unwrap();
/// // Each may go by nearly half of the 0.4 between them.
/// assert!(vertex < 0.2 && vertex > 0.198 && face < 0.2 && face > 0.198);
/// ```
#[must_use]
pub fn shares<P: Position>(
    kind: PairKind,
    [start, wanted]: [[P; 4]; 2],
    direction: P,
    separation: P::Scalar,
    error: GapError<P::Scalar>,
) -> Option<[P::Scalar; 4]> {
    let (zero, one) = (P::Scalar::ZERO, P::Scalar::ONE);
    let direction = Vector::from(direction.into());
    let along = |points: [P; 4]| points.map(|point| direction.dot(Vector::from(point.into())));
    let kept = threshold(separation, error) + error.length();
    let (from, to) = (along(start), along(wanted));
    let ranges = |values| of_kind!(kind, K => K::ranges(values));
    let [[first, _], [_, second]] = ranges(from);
    let [[first_wanted, _], [_, second_wanted]] = ranges(to);
    let room = first - kept - second;
    if !(room > zero && direction.dot(direction).is_finite()) {
        return None;
    }
    let (low, high) = (second.larger(second_wanted), first.smaller(first_wanted) - kept);
    if low <= high {
        return Some([one; 4]);
    }
    let (falls, rises) = ((first - first_wanted).larger(zero), (second_wanted - second).larger(zero));
    let offset = second + room * (rises / (falls + rises));
    let of_first = match kind {
        PairKind::VertexFace => 1,
        PairKind::EdgeEdge => 2,
    };
    let mut shares = [one; 4];
    for corner in 0..4 {
        // These are the distances of the point on its side of the plane, at both ends.
        let [before, after] = [from, to].map(|values| {
            if corner < of_first {
                values[corner] - offset - kept
            } else {
                offset - values[corner]
            }
        });
        let stays = after >= zero;
        if !stays {
            let share = before / (before - after) * P::Scalar::from_f64(PART);
            let is_share = share >= zero && share <= one;
            shares[corner] = if is_share { share } else { zero };
        }
    }
    Some(shares)
}

/// Returns the [`shares`] along the direction whose smallest share is largest, with that direction; the first of equals. Returns
/// `None` if none of the directions keeps the pair apart at the start.
///
/// ```
/// use selvedge_core::{PairKind, glam::DVec3, separation::gap::GapError, separation::truncation::most_shares};
/// // A vertex that slides along the triangle, and a little towards it.
/// let start = [DVec3::new(0.2, 0.2, 0.5), DVec3::ZERO, DVec3::X, DVec3::Y];
/// let wanted = [DVec3::new(3.0, 0.2, -0.1), start[1], start[2], start[3]];
/// let directions = [DVec3::X, DVec3::new(0.0, 0.0, 1.0), DVec3::new(0.6, 0.0, 0.8)];
/// let error = GapError::from_largest_coordinate(3.0);
/// let (direction, [vertex, ..]) = most_shares(PairKind::VertexFace, [start, wanted], directions, 0.1, error).unwrap();
/// assert!(direction == DVec3::Z && vertex > 0.6);
/// ```
#[must_use]
pub fn most_shares<P: Position>(
    kind: PairKind,
    ends: [[P; 4]; 2],
    directions: impl IntoIterator<Item = P>,
    separation: P::Scalar,
    error: GapError<P::Scalar>,
) -> Option<(P, [P::Scalar; 4])> {
    let least = |shares: &[P::Scalar; 4]| {
        let [a, b, c, d] = *shares;
        a.smaller(b).smaller(c.smaller(d))
    };
    directions
        .into_iter()
        .filter_map(|direction| Some((direction, shares(kind, ends, direction, separation, error)?)))
        .reduce(|a, b| if least(&b.1) > least(&a.1) { b } else { a })
}
