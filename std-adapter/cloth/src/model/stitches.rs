//! Stitches: the pairs of points that a seam joins.
//!
//! Two rows of vertices are laid along each other by their lengths at rest. Each vertex of the row with more vertices is joined
//! to the point at the same share of the other row's length. So rows of different meshes fit, and rows of equally many evenly
//! spaced vertices are joined one to one.
//!
//! A stitch is |a − (1 − s)·b − s·c| ≤ L, which the [solve](crate::solve::stitches) keeps. It only pulls. Contact keeps the rows
//! apart.

use crate::model::step::TimeStep;
use selvedge_core::glam::DVec3;

/// A vertex, and a point between two others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Stitch {
    /// The vertex, then the two vertices of the point.
    pub(crate) vertices: [u32; 3],
    /// The share of the way from the first of the two to the second.
    share: f64,
}

impl Stitch {
    /// The weights of the vertices in the vector from the point to the vertex.
    pub(crate) fn weights(&self) -> [f64; 3] {
        [1.0, self.share - 1.0, -self.share]
    }

    /// Returns the distance of vertex and point.
    pub(crate) fn length(&self, positions: &[DVec3]) -> f64 {
        let [a, b, c] = self.vertices.map(|vertex| positions[vertex as usize]);
        a.distance(b.lerp(c, self.share))
    }
}

/// Joins two rows by stitches. Each row has at least two vertices and a length, or both are single vertices.
pub(crate) fn stitches(first: &[u32], second: &[u32], rest: &[DVec3]) -> Vec<Stitch> {
    if let (&[first], &[second]) = (first, second) {
        let vertices = [first, second, second];
        return vec![Stitch { vertices, share: 0.0 }];
    }
    let (finer, coarser) = if first.len() < second.len() {
        (second, first)
    } else {
        (first, second)
    };
    let [of_finer, of_coarser] = [finer, coarser].map(|row| shares(row, rest));
    let stitch = |(&vertex, share): (&u32, f64)| {
        let next = of_coarser.partition_point(|&own| own <= share).clamp(1, coarser.len() - 1);
        let [from, to] = [of_coarser[next - 1], of_coarser[next]];
        Stitch {
            vertices: [vertex, coarser[next - 1], coarser[next]],
            share: ((share - from) / (to - from)).clamp(0.0, 1.0),
        }
    };
    finer.iter().zip(of_finer).map(stitch).collect()
}

/// Returns each vertex's share of the row's length, from 0 to 1.
fn shares(row: &[u32], rest: &[DVec3]) -> Vec<f64> {
    let steps = row
        .windows(2)
        .map(|two| rest[two[0] as usize].distance(rest[two[1] as usize]));
    let lengths = steps.scan(0.0, |length, step| {
        *length += step;
        Some(*length)
    });
    let lengths: Vec<f64> = std::iter::once(0.0).chain(lengths).collect();
    let all = lengths[lengths.len() - 1];
    lengths.into_iter().map(|length| length / all).collect()
}

/// The distance of two vertices that are tied without a gap, in metres.
pub(crate) const TIED: f64 = 1e-6;

#[derive(Debug)]
pub(crate) struct Sewing {
    /// The stitches, each with the initial distance of its points, in metres.
    pub(crate) stitches: Vec<(Stitch, f64)>,
    /// The final distance, in metres.
    pub(crate) gap: f64,
    /// The time of closing, in seconds. `None` keeps the initial distance.
    pub(crate) closing: Option<f64>,
}

impl Sewing {
    /// Returns whether the seam joins two single vertices without a gap, and is closed at the end of a step.
    pub(crate) fn is_closed_tie(&self, step: &TimeStep<'_>) -> bool {
        let is_closed = |(_, start): &(Stitch, f64)| length_at_end(step, *start, self.gap, self.closing) <= TIED;
        self.tied_vertices().is_some() && self.stitches.iter().all(is_closed)
    }

    /// Returns the two vertices, if the seam joins only these.
    pub(crate) fn tied_vertices(&self) -> Option<[u32; 2]> {
        match self.stitches.as_slice() {
            &[
                (
                    Stitch {
                        vertices: [one, other, also],
                        ..
                    },
                    _,
                ),
            ] if other == also => Some([one, other]),
            _ => None,
        }
    }
}

/// Returns the largest distance of a stitch's points at the end of a step, for a seam that closes from `start` to `gap`.
pub(crate) fn length_at_end(step: &TimeStep<'_>, start: f64, gap: f64, closing: Option<f64>) -> f64 {
    let left = closing.map_or(1.0, |closing| (1.0 - (step.time + step.h) / closing).max(0.0));
    gap + left * (start - gap).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns two rows along x, one above the other by 1.
    fn rows(first: &[f64], second: &[f64]) -> (Vec<DVec3>, Vec<Stitch>) {
        let above = second.iter().map(|&x| DVec3::new(x, 1.0, 0.0));
        let rest: Vec<DVec3> = first.iter().map(|&x| DVec3::X * x).chain(above).collect();
        let numbers: Vec<u32> = (0..rest.len() as u32).collect();
        let (one, other) = numbers.split_at(first.len());
        let made = stitches(one, other, &rest);
        (rest, made)
    }

    #[test]
    fn rows_of_as_many_vertices_are_joined_one_to_one_and_others_at_the_same_share() {
        let even = [0.0, 1.0, 2.0, 3.0];
        for (index, stitch) in rows(&even, &even).1.iter().enumerate() {
            let [a, b, c] = stitch.vertices;
            let met = if stitch.share == 0.0 { b } else { c };
            assert_eq!((a, met), (index as u32, index as u32 + 4));
            assert!(stitch.share == 0.0 || stitch.share == 1.0);
        }
        // Each vertex of the finer row is joined, whichever row it is.
        for (first, second) in [(&[0.0, 1.5, 3.0][..], &even[..]), (&even[..], &[0.0, 1.0, 3.0][..])] {
            let (rest, made) = rows(first, second);
            assert_eq!(made.len(), 4);
            assert!(made.iter().all(|stitch| (stitch.length(&rest) - 1.0).abs() < 1e-12));
        }
    }

    #[test]
    fn a_seam_is_as_long_as_the_time_says_and_one_without_a_time_as_long_as_it_was() {
        for (closing, time, expected) in [
            (Some(1.0), 0.4, 0.6),
            (Some(1.0), 0.9, 0.2),
            (Some(1.0), 5.0, 0.2),
            (None, 5.0, 1.0),
        ] {
            let step = TimeStep {
                time,
                ..TimeStep::first(0.1, &[], &[])
            };
            assert!((length_at_end(&step, 1.0, 0.2, closing) - expected).abs() < 1e-12);
        }
    }
}
