//! Two bodies in screw motion, with a set of points on each. The sets meet at a known time, up to rounding.

use super::interval::Interval;
use crate::generator::{Choices, Screw, side_of, vector};
use selvedge_core::PairKind;
use selvedge_core::elementary::Limits;
use selvedge_core::glam::DVec3;
use selvedge_core::paths::{Arc, Path, time_of_impact};
use std::f64::consts::{PI, TAU};

/// Angles by which bodies rotate. Few are large, since each turn takes many straight pieces.
const ANGLES: [f64; 16] = [0.0, 1e-9, 1e-4, 0.01, 0.1, 0.1, 0.5, 0.5, 1.0, 1.0, 2.0, 2.0, PI, PI, PI, TAU];

type Box = [Interval; 3];

fn about(point: DVec3) -> Box {
    point.to_array().map(Interval::from)
}

fn each(a: Box, b: Box, f: impl Fn(Interval, Interval) -> Interval) -> Box {
    [0, 1, 2].map(|axis| f(a[axis], b[axis]))
}

fn times(a: Box, factor: Interval) -> Box {
    a.map(|x| x * factor)
}

fn dot(a: Box, b: Box) -> Interval {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: Box, b: Box) -> Box {
    [0, 1, 2].map(|axis| {
        let (i, j) = ((axis + 1) % 3, (axis + 2) % 3);
        a[i] * b[j] - a[j] * b[i]
    })
}

/// An enclosure of a body's pose at some time.
struct Turned {
    centre: Box,
    /// The place of the centre at that time.
    moved: Box,
    axis: Box,
    sine: Interval,
    cosine: Interval,
}

impl Turned {
    fn new(screw: &Screw, time: f64) -> Self {
        let [sine, cosine] = Interval::sine_and_cosine(screw.angle, time);
        let centre = about(screw.centre);
        // Divides by the largest coordinate first, since the square may overflow.
        let axis = about(screw.axis);
        let axis = axis.map(|x| x / Interval::from(screw.axis.abs().max_element()));
        let length = (axis[0].square() + axis[1].square() + axis[2].square()).root();
        Self {
            centre,
            moved: each(centre, times(about(screw.translation), time.into()), |a, b| a + b),
            axis: axis.map(|x| x / length),
            sine,
            cosine,
        }
    }

    /// Returns the position of the point that starts at `start`.
    fn at(&self, start: DVec3) -> Box {
        let way = each(about(start), self.centre, |a, b| a - b);
        let along = times(self.axis, dot(self.axis, way));
        let across = each(way, along, |a, b| a - b);
        let turned = each(times(across, self.cosine), times(cross(self.axis, way), self.sine), |a, b| {
            a + b
        });
        each(self.moved, each(along, turned, |a, b| a + b), |a, b| a + b)
    }
}

/// Returns the start of a point that is `there` at `time`, rounded.
fn start_of(screw: &Screw, there: DVec3, time: f64) -> DVec3 {
    let axis = screw.axis / screw.axis.abs().max_element();
    let axis = axis / axis.length();
    let way = there - screw.centre - screw.translation * time;
    let (sine, cosine) = (-screw.angle * time).sin_cos();
    let along = axis * axis.dot(way);
    screw.centre + along + (way - along) * cosine + axis.cross(way) * sine
}

/// A case of the campaign; see the [module](super).
#[derive(Clone, Debug)]
pub(super) struct Case {
    pub(super) kind: PairKind,
    /// The motions of the first and of the second body.
    screws: [Screw; 2],
    /// The starts of the four points.
    starts: [DVec3; 4],
    /// The time at which they meet.
    pub(super) time: f64,
    /// An upper bound of their distance at that time.
    pub(super) distance: f64,
    tolerance: f64,
}

impl Case {
    /// Chooses a case. Returns `None` if rounding leaves the sets apart by more than a billionth of the coordinates.
    pub(super) fn choose(choices: &mut Choices<'_>) -> Option<Self> {
        let kind = choices.pick(&[PairKind::VertexFace, PairKind::EdgeEdge]);
        let screws = [Screw::choose(&ANGLES, choices), Screw::choose(&ANGLES, choices)];
        let size = choices.pick(&[1.0, 1e-3, 10.0]);
        let places = [(); 4].map(|()| screws[0].centre + size * vector(choices));
        // Weights are sixteenths, so that they add up to one exactly.
        let sixteenths = |choices: &mut Choices<'_>, most: u32| choices.below(most + 1);
        let time = match choices.below(8) {
            0 => 1.0,
            1 => f64::from(sixteenths(choices, 16)) / 16.0,
            _ => (choices.word() >> 11) as f64 / (1_u64 << 53) as f64,
        };
        let first = sixteenths(choices, 16);
        let second = match kind {
            PairKind::VertexFace => sixteenths(choices, 16 - first),
            PairKind::EdgeEdge => sixteenths(choices, 16),
        };
        let [u, v] = [first, second].map(|part| f64::from(part) / 16.0);

        // Rounded places at that time.
        let [a, b, c, d] = places;
        let places = match kind {
            PairKind::VertexFace => [b + (c - b) * u + (d - b) * v, b, c, d],
            // The second edge begins where its part v is part u of the first edge.
            PairKind::EdgeEdge => {
                let way = d - c;
                let second = a + (b - a) * u - way * v;
                [a, b, second, second + way]
            }
        };
        let side = |corner: usize| side_of(kind, corner);
        let corners = [0, 1, 2, 3];
        let starts = corners.map(|corner| start_of(&screws[side(corner)], places[corner], time));
        if !starts.iter().all(|start| start.is_finite()) {
            return None;
        }

        // Encloses the distance of a point on the one set and a point on the other.
        let turned = screws.each_ref().map(|screw| Turned::new(screw, time));
        let [a, b, c, d] = corners.map(|corner| turned[side(corner)].at(starts[corner]));
        let part = |from: Box, to: Box, share: f64| times(each(to, from, |x, y| x - y), share.into());
        let apart = match kind {
            PairKind::VertexFace => {
                let inside = each(part(b, c, u), part(b, d, v), |x, y| x + y);
                each(a, each(b, inside, |x, y| x + y), |x, y| x - y)
            }
            PairKind::EdgeEdge => {
                let on_first = each(a, part(a, b, u), |x, y| x + y);
                let on_second = each(c, part(c, d, v), |x, y| x + y);
                each(on_first, on_second, |x, y| x - y)
            }
        };
        let distance = (apart[0].square() + apart[1].square() + apart[2].square()).root().high;
        let far = screws.iter().flat_map(|screw| [screw.centre, screw.translation]);
        let far = far.map(|point| point.abs().max_element()).fold(size, f64::max);
        (distance < 1e-9 * far).then_some(Self {
            kind,
            screws,
            starts,
            time,
            distance,
            tolerance: choices.pick(&[1e-9, 1e-6, 1e-3]) * far,
        })
    }

    fn arcs(&self) -> [Arc; 4] {
        [0, 1, 2, 3].map(|corner| self.screws[side_of(self.kind, corner)].motion().path(self.starts[corner]))
    }

    /// Returns the first time at which core cannot exclude that the sets are within [`distance`](Self::distance), on their arcs or on
    /// the chords of these.
    pub(super) fn first_time(&self, on_chords: bool) -> Option<f64> {
        let limits = Limits {
            separation: self.distance,
            tolerance: self.tolerance,
        };
        let arcs = self.arcs();
        if on_chords {
            let chords = arcs.map(|arc| arc.piece(0.0, 1.0).motion);
            return time_of_impact(self.kind, chords.each_ref().map(|chord| chord as &dyn Path), &limits).time();
        }
        time_of_impact(self.kind, arcs.each_ref().map(|arc| arc as &dyn Path), &limits).time()
    }
}
