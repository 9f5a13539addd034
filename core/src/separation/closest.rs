//! The closest points of a pair at rest, in plain floating point.
//!
//! Nothing that is certified relies on how well this is done (Ericson, Real-Time Collision Detection, 2005, 5.1.5 and 5.1.9).

use crate::kind::PairKind;
use glam::DVec3;

/// The shortest way from the second set of a pair to the first.
#[derive(Clone, Copy, Debug)]
pub struct Closest {
    /// Of the four points in [`way`](Self::way): those of the first set add up to 1, those of the second to −1.
    pub weights: [f64; 4],
    /// Σ weightᵢ·xᵢ.
    pub way: DVec3,
    /// Perpendicular to the features on which the closest points lie, as far as rounding allows: of length one, or zero where
    /// the sets touch.
    pub direction: DVec3,
}

impl Closest {
    /// Of the pair whose four vertices are these.
    #[inline]
    #[must_use]
    pub fn of(kind: PairKind, points: [DVec3; 4]) -> Self {
        let weights = match kind {
            PairKind::VertexFace => of_vertex_face(points),
            PairKind::EdgeEdge => of_edge_edge(points),
        };
        let [p, q, r, s] = points;
        // Differences first: they are small and nearly exact, wherever the pair is.
        let way = match kind {
            PairKind::VertexFace => (q - p) * weights[1] + (r - p) * weights[2] + (s - p) * weights[3],
            PairKind::EdgeEdge => (p - r) + (q - p) * weights[1] + (s - r) * weights[3],
        };
        let mut closest = Self {
            weights,
            way,
            direction: DVec3::ZERO,
        };
        closest.direction = closest.upright(kind, points);
        closest
    }

    /// The length of the shortest way.
    #[must_use]
    pub fn distance(&self) -> f64 {
        self.way.length()
    }

    /// Where the sets are near to each other the difference of the closest points has lost its digits: then a normal is
    /// computed from the features themselves.
    fn upright(&self, kind: PairKind, [p, q, r, s]: [DVec3; 4]) -> DVec3 {
        let (first, second) = match kind {
            PairKind::VertexFace => (r - q, s - q),
            PairKind::EdgeEdge => (q - p, s - r),
        };
        let size = first.length_squared().max(second.length_squared());
        if self.way.length_squared() > NEAR * size {
            return self.way.normalize_or_zero();
        }
        let normal = first.cross(second).normalize_or_zero();
        let along = normal.dot(self.way);
        if along * along > 0.999_998 * self.way.length_squared() && along != 0.0 {
            return normal * along.signum();
        }
        // On a side: take off what is left along it.
        let mut way = self.way;
        let sides = [first, second, second - first];
        let count = if kind == PairKind::VertexFace { 3 } else { 2 };
        for side in &sides[..count] {
            let share = way.dot(*side) / side.length_squared();
            if share.is_finite() && (share * share) * side.length_squared() < 1e-6 * way.length_squared() {
                way -= *side * share;
            }
        }
        way.normalize_or_zero()
    }
}

/// A thousandth of the pair's size, squared.
const NEAR: f64 = 1e-6;

fn of_vertex_face([p, a, b, c]: [DVec3; 4]) -> [f64; 4] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, -1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [1.0, 0.0, -1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = share(d1, d1 - d3);
        return [1.0, v - 1.0, -v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [1.0, 0.0, 0.0, -1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = share(d2, d2 - d6);
        return [1.0, w - 1.0, 0.0, -w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = share(d4 - d3, (d4 - d3) + (d5 - d6));
        return [1.0, 0.0, w - 1.0, -w];
    }
    let all = va + vb + vc;
    let (v, w) = (share(vb, all), share(vc, all));
    [1.0, v + w - 1.0, -v, -w]
}

fn of_edge_edge([a, b, c, d]: [DVec3; 4]) -> [f64; 4] {
    let (u, v, r) = (b - a, d - c, a - c);
    let (uu, vv, uv) = (u.length_squared(), v.length_squared(), u.dot(v));
    let (ur, vr) = (u.dot(r), v.dot(r));
    let mut s = share(uv * vr - ur * vv, uu * vv - uv * uv).clamp(0.0, 1.0);
    let t = share(uv * s + vr, vv);
    if !(0.0..=1.0).contains(&t) {
        let t = t.clamp(0.0, 1.0);
        s = share(uv * t - ur, uu).clamp(0.0, 1.0);
        return [1.0 - s, s, t - 1.0, -t];
    }
    [1.0 - s, s, t - 1.0, -t]
}

/// A quotient; zero where it is none.
fn share(part: f64, whole: f64) -> f64 {
    let share = part / whole;
    if share.is_finite() { share } else { 0.0 }
}
