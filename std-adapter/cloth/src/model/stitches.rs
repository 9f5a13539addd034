//! Stitches: the pairs of points that a seam joins.
//!
//! Two rows of vertices are laid along each other by their lengths at rest. Each vertex of the row with more vertices is joined
//! to the point at the same share of the other row's length. So rows of different meshes fit, and rows of equally many evenly
//! spaced vertices are joined one to one.
//!
//! A stitch is C = |a − (1 − s)·b − s·c| ≤ L, without compliance: Δx = −(|p| − L)·wₖ·∇C/Σw·|∇C|². It only pulls. Contact keeps
//! the rows apart.

use crate::model::mobility::mobility;
use crate::model::step::{Constraint, TimeStep, Touches};
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

    /// Returns the vector from the point to the vertex.
    fn way(&self, positions: &[DVec3]) -> DVec3 {
        let [a, b, c] = self.vertices.map(|vertex| positions[vertex as usize]);
        a - b.lerp(c, self.share)
    }

    /// Returns the distance of vertex and point.
    pub(crate) fn length(&self, positions: &[DVec3]) -> f64 {
        self.way(positions).length()
    }

    /// Moves vertex and point to within `length` of each other.
    fn draw(&self, length: f64, inverse_masses: &[f64], positions: &mut [DVec3]) {
        let weights = self.weights();
        let mobility = mobility(inverse_masses, self.vertices, weights);
        let way = self.way(positions);
        let distance = way.length();
        if !(distance > length && mobility > 0.0) {
            return;
        }
        let along = way * ((length - distance) / (distance * mobility));
        for (vertex, weight) in self.vertices.into_iter().zip(weights) {
            positions[vertex as usize] += along * (weight * inverse_masses[vertex as usize]);
        }
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
    let ways = steps.scan(0.0, |way, step| {
        *way += step;
        Some(*way)
    });
    let ways: Vec<f64> = std::iter::once(0.0).chain(ways).collect();
    let all = ways[ways.len() - 1];
    ways.into_iter().map(|way| way / all).collect()
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
        self.tie().is_some() && self.stitches.iter().all(is_closed)
    }

    /// Returns the tie, if the seam consists of one stitch between two vertices.
    pub(crate) fn tie(&self) -> Option<Tie> {
        let &[
            (
                Stitch {
                    vertices: [one, other, also],
                    ..
                },
                start,
            ),
        ] = self.stitches.as_slice()
        else {
            return None;
        };
        (other == also).then_some(Tie {
            vertices: [one, other],
            start,
            gap: self.gap,
            closing: self.closing,
        })
    }
}

/// Two vertices that a seam joins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tie {
    pub(crate) vertices: [u32; 2],
    /// The initial and the final distance, in metres.
    pub(crate) start: f64,
    pub(crate) gap: f64,
    /// The time of closing, in seconds, as in a [`Seam`](crate::effects::Seam).
    pub(crate) closing: Option<f64>,
}

/// Returns the largest distance of a stitch's points at the end of a step, for a seam that closes from `start` to `gap`.
pub(crate) fn length_at_end(step: &TimeStep<'_>, start: f64, gap: f64, closing: Option<f64>) -> f64 {
    let left = closing.map_or(1.0, |closing| (1.0 - (step.time + step.h) / closing).max(0.0));
    gap + left * (start - gap).max(0.0)
}

impl Constraint for Sewing {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        for (stitch, start) in &self.stitches {
            let length = length_at_end(step, *start, self.gap, self.closing);
            stitch.draw(length, step.inverse_masses, positions);
        }
    }

    fn is_inner(&self) -> bool {
        true
    }

    fn acts_among_contacts(&self) -> bool {
        true
    }

    fn joints(&self) -> Vec<[u32; 2]> {
        let each = self.stitches.iter().map(|(stitch, _)| stitch.vertices);
        each.flat_map(|[a, b, c]| [[a, b], [a, c]]).collect()
    }
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
    fn a_stitch_is_drawn_to_its_length_keeps_the_momentum_and_never_pushes() {
        let (rest, made) = rows(&[0.0, 1.0], &[0.0, 0.4, 1.0]);
        let inverse_masses = [1.0, 2.0, 0.5, 3.0, 0.0];
        for (length, expected) in [(0.25, 0.25), (2.0, 1.0)] {
            let mut positions = rest.clone();
            made[1].draw(length, &inverse_masses, &mut positions);
            assert!((made[1].length(&positions) - expected).abs() < 1e-12);
            let moved = |k: usize| (positions[k] - rest[k]) / inverse_masses[k];
            assert!((moved(0) + moved(1) + moved(3)).length() < 1e-12);
        }
        let mut positions = rest.clone();
        made[2].draw(0.25, &[0.0; 5], &mut positions);
        assert_eq!(positions, rest, "what is pinned stays");
    }

    #[test]
    fn a_seam_is_as_long_as_the_time_says_and_one_without_a_time_as_long_as_it_was() {
        let (rest, made) = rows(&[0.0, 1.0], &[0.0, 1.0]);
        let lengths = |closing, time| {
            let mut positions = rest.clone();
            let mut sewing = Sewing {
                stitches: made.iter().map(|stitch| (*stitch, 1.0)).collect(),
                gap: 0.2,
                closing,
            };
            let step = TimeStep {
                time,
                ..TimeStep::first(0.1, &rest, &[1.0; 4])
            };
            sewing.project(&step, &mut positions, &mut Touches::default());
            made[0].length(&positions)
        };
        for (closing, time, expected) in [
            (Some(1.0), 0.4, 0.6),
            (Some(1.0), 0.9, 0.2),
            (Some(1.0), 5.0, 0.2),
            (None, 5.0, 1.0),
        ] {
            assert!((lengths(closing, time) - expected).abs() < 1e-12);
        }
    }
}
