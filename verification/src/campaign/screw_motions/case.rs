//! Two bodies in screw motion, with a set of points on each. The sets meet at a known time, up to rounding.

use crate::generator::{Choices, Screw, side_of, vector};
use crate::oracle::arcs::{Place, Pose, distance, float, minus, place, plus, times};
use selvedge_core::PairKind;
use selvedge_core::elementary::Limits;
use selvedge_core::glam::DVec3;
use selvedge_core::paths::{Arc, Path, time_of_impact};
use std::f64::consts::{PI, TAU};

/// Angles by which bodies rotate. Few are large, since each turn takes many straight pieces.
const ANGLES: [f64; 16] = [0.0, 1e-9, 1e-4, 0.01, 0.1, 0.1, 0.5, 0.5, 1.0, 1.0, 2.0, 2.0, PI, PI, PI, TAU];

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
        let poses = screws.each_ref().map(|screw| Pose::at_time(screw, time));
        let pose = |corner: usize| &poses[side_of(kind, corner)];
        let corners = [0, 1, 2, 3];
        let starts = corners.map(|corner| pose(corner).start_of(&place(places[corner])));
        if !starts.iter().all(|start| start.is_finite()) {
            return None;
        }

        // The distance of a point on the one set and a point on the other.
        let [a, b, c, d] = corners.map(|corner| pose(corner).at(starts[corner]));
        let part = |from: &Place, to: &Place, share: f64| times(&minus(to, from), &float(share));
        let [first, second] = match kind {
            PairKind::VertexFace => [a, plus(&b, &plus(&part(&b, &c, u), &part(&b, &d, v)))],
            PairKind::EdgeEdge => [plus(&a, &part(&a, &b, u)), plus(&c, &part(&c, &d, v))],
        };
        let far = screws.iter().flat_map(|screw| [screw.centre, screw.translation]);
        let far = far.map(|point| point.abs().max_element()).fold(size, f64::max);
        // The error of 256 bits is far less than what is added.
        let distance = (distance(&first, &second).to_f64() + 1e-60 * far).next_up();
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
