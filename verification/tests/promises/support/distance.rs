//! A third check: distances in floating point, and steps through time that are no longer than they allow.
//!
//! The error is about 1e-12 for coordinates of size 1. That decides every case of a small grid, where a pair either touches or
//! stays apart by far more.

use glam::DVec3;
use selvedge_core::glam;
use selvedge_verification::generator::points_of_first;
use selvedge_verification::oracle::{Pair, PairKind};

fn position(pair: &Pair, i: usize, t: f64) -> DVec3 {
    DVec3::from(pair.start[i]) * (1.0 - t) + DVec3::from(pair.end[i]) * t
}

fn to_segment(x: DVec3, p: DVec3, q: DVec3) -> f64 {
    let along = q - p;
    let length = along.length_squared();
    let part = if length > 0.0 {
        ((x - p).dot(along) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    x.distance(p + along * part)
}

/// The squared height of a triangle below which only its edges are examined, since its points are then within 1e-9 of an edge.
const THIN: f64 = 1e-18;

fn vertex_face([x, a, b, c]: [DVec3; 4]) -> f64 {
    let edges = [(a, b), (b, c), (c, a)];
    let nearest = edges
        .map(|(p, q)| to_segment(x, p, q))
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let normal = (b - a).cross(c - a);
    let above = edges.iter().all(|&(p, q)| normal.dot((q - p).cross(x - p)) >= 0.0);
    if normal.length_squared() > THIN && above {
        nearest.min((x - a).dot(normal.normalize()).abs())
    } else {
        nearest
    }
}

fn edge_edge([a, b, c, d]: [DVec3; 4]) -> f64 {
    let ends = [(a, c, d), (b, c, d), (c, a, b), (d, a, b)];
    let nearest = ends
        .map(|(x, p, q)| to_segment(x, p, q))
        .into_iter()
        .fold(f64::INFINITY, f64::min);
    let normal = (b - a).cross(d - c);
    let squared = normal.length_squared();
    if squared <= THIN {
        return nearest;
    }
    let first = (c - a).cross(d - c).dot(normal) / squared;
    let second = (c - a).cross(b - a).dot(normal) / squared;
    if (0.0..=1.0).contains(&first) && (0.0..=1.0).contains(&second) {
        nearest.min((c - a).dot(normal).abs() / squared.sqrt())
    } else {
        nearest
    }
}

/// Returns the distance of the two sides at time `t`.
pub(crate) fn distance(pair: &Pair, t: f64) -> f64 {
    let points = [0, 1, 2, 3].map(|i| position(pair, i, t));
    match pair.kind {
        PairKind::VertexFace => vertex_face(points),
        PairKind::EdgeEdge => edge_edge(points),
    }
}

/// The distance above the separation at which stepping ends.
pub(crate) const SLACK: f64 = 1e-9;

/// Returns a time at which the distance is less than `SLACK` above `separation`, or `None`. It is not after the first time at
/// which the distance comes down to `separation`.
pub(crate) fn advance(pair: &Pair, separation: f64) -> Option<f64> {
    let velocity = |i: usize| DVec3::from(pair.end[i]) - DVec3::from(pair.start[i]);
    let first = points_of_first(pair.kind);
    let relative = (0..first).flat_map(|i| (first..4).map(move |j| (velocity(i) - velocity(j)).length()));
    let fastest = relative.fold(0.0, f64::max);
    let mut t = 0.0;
    while t < 1.0 {
        let gap = distance(pair, t) - separation;
        if gap < SLACK {
            return Some(t);
        }
        t += gap / fastest;
    }
    (distance(pair, 1.0) - separation < SLACK).then_some(1.0)
}
