use super::{Impact, Limits, ROUNDS, Reason, time_of_impact, time_of_impact_and_work};
use crate::{Motion, PrimitivePair};
use glam::{DVec3, Vec3};

const FACE: [DVec3; 3] = [DVec3::ZERO, DVec3::X, DVec3::Y];

fn limits(separation: f64) -> Limits<f64> {
    Limits {
        tolerance: 1e-9,
        separation,
    }
}

/// Makes a vertex over the middle of a resting face.
fn fall(from: f64, to: f64) -> PrimitivePair<f64> {
    let at = |z| DVec3::new(0.25, 0.25, z);
    PrimitivePair::vertex_face(Motion::new(at(from), at(to)), FACE.map(Motion::resting))
}

#[track_caller]
fn assert_contact(impact: Impact<f64>, expected: f64, slack: f64) {
    let Impact::Possible {
        time,
        reason: Reason::WithinTolerance,
    } = impact
    else {
        panic!("{impact:?}");
    };
    assert!(time <= expected && time >= expected - slack, "{time}, not {expected}");
}

#[test]
fn a_fall_is_timed_within_the_tolerance() {
    assert_contact(time_of_impact(&fall(1.0, -1.0), &limits(0.0)), 0.5, 1e-9);
    assert_contact(time_of_impact(&fall(1.0, -1.0), &limits(0.5)), 0.25, 1e-9);
    assert_contact(time_of_impact(&fall(-1.0, 1.0), &limits(0.0)), 0.5, 1e-9);
}

#[test]
fn a_fall_that_ends_above_is_excluded_unless_the_separation_is_larger() {
    let pair = fall(1.0, 0.25);
    assert_eq!(time_of_impact(&pair, &limits(0.0)), Impact::Never);
    assert_eq!(time_of_impact(&pair, &limits(0.249)), Impact::Never);
    assert_contact(time_of_impact(&pair, &limits(0.25)), 1.0, 2e-9);
}

#[test]
fn contact_at_either_end_is_contact() {
    assert_contact(time_of_impact(&fall(0.0, 1.0), &limits(0.0)), 0.0, 0.0);
    assert_contact(time_of_impact(&fall(1.0, 0.0), &limits(0.0)), 1.0, 1e-9);
}

#[test]
fn parallel_edges_meet_though_they_are_always_coplanar() {
    let edge = [DVec3::ZERO, DVec3::X];
    let pair = PrimitivePair::edge_edge(
        edge.map(Motion::resting),
        edge.map(|end| Motion::new(end + DVec3::Z, end - DVec3::Z)),
    );
    assert_contact(time_of_impact(&pair, &limits(0.0)), 0.5, 1e-9);
}

#[test]
fn a_face_without_area_is_a_segment() {
    let line = [DVec3::ZERO, DVec3::X, 2.0 * DVec3::X];
    let at = |x: f64, z| DVec3::new(x, 0.0, z);
    for (x, hits) in [(1.5, true), (2.5, false)] {
        let pair = PrimitivePair::vertex_face(Motion::new(at(x, 1.0), at(x, -1.0)), line.map(Motion::resting));
        let impact = time_of_impact(&pair, &limits(0.0));
        if hits {
            assert_contact(impact, 0.5, 1e-9);
        } else {
            assert_eq!(impact, Impact::Never);
        }
    }
}

#[test]
fn points_that_slide_past_each_other_need_few_rounds() {
    // The vertex is 1e-6 above the plane of the face and moves across it. The face spins under it by half a turn (linearly:
    // through its middle).
    let turned = FACE.map(|corner| Motion::new(corner, DVec3::new(0.6, 0.6, 0.0) - corner));
    let pair = PrimitivePair::vertex_face(Motion::new(DVec3::new(-1.0, 0.3, 1e-6), DVec3::new(2.0, 0.2, 2e-6)), turned);
    let (impact, work) = time_of_impact_and_work(&pair, &limits(0.0));
    assert_eq!(impact, Impact::Never);
    assert!(work.rounds < ROUNDS / 2, "{work:?}");
}

/// Makes edges of which an end of one travels at a distance of about `near` beside an end of the other.
fn ends_that_slide(near: f64) -> PrimitivePair<f64> {
    let at = DVec3::new;
    PrimitivePair::edge_edge(
        [
            Motion::new(at(-0.75, -0.375, -1.0), at(1.0, -0.75, 0.75)),
            Motion::new(at(0.0, 0.625, -0.625 - near), at(0.625 + near, 0.375, -0.125)),
        ],
        [
            Motion::new(at(0.625, 0.5, -0.5), at(0.0, -0.25, 0.5)),
            Motion::new(at(0.0, 0.625, -0.625), at(0.625, 0.375, -0.125)),
        ],
    )
}

#[test]
fn ends_that_slide_past_each_other_are_apart_however_near() {
    for exponent in [10, 13, 20, 26] {
        let (impact, work) = time_of_impact_and_work(&ends_that_slide(0.5_f64.powi(exponent)), &limits(0.0));
        assert_eq!(impact, Impact::Never, "{exponent}");
        assert!(work.rounds <= 20, "{exponent}: {work:?}");
    }
}

/// The edges lie along one another at both ends, and turn by a right angle.
#[test]
fn edges_that_lie_along_one_another_are_apart_however_near() {
    for exponent in [10, 17, 24, 28] {
        let above = DVec3::new(0.0, 0.0, 0.5_f64.powi(exponent));
        let along = [-DVec3::X, DVec3::X].map(|end| Motion::new(end, DVec3::new(0.0, end.x, 0.0)));
        let other = along.map(|end| Motion::new(1.5 * end.start + above, 0.75 * end.end + 2.0 * above));
        let (impact, work) = time_of_impact_and_work(&PrimitivePair::edge_edge(along, other), &limits(0.0));
        assert_eq!(impact, Impact::Never, "{exponent}");
        assert!(work.rounds <= 20, "{exponent}: {work:?}");
    }
}

#[test]
fn bad_input_excludes_nothing_and_says_why() {
    let nothing = |reason| Impact::Possible { time: 0.0, reason };
    for bad in [f64::NAN, f64::INFINITY] {
        let impact = time_of_impact(&fall(bad, 2.0), &limits(0.0));
        assert_eq!(impact, nothing(Reason::NotFinite));
    }
    for separation in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        let impact = time_of_impact(&fall(2.0, 1.0), &limits(separation));
        assert_eq!(impact, nothing(Reason::NotFinite));
    }
    let impact = time_of_impact(&fall(1e100, -1e100), &limits(1.0));
    assert_eq!(impact, nothing(Reason::OutOfRange));
    let impact = time_of_impact(&fall(2.0, 1.0), &limits(f64::INFINITY));
    assert_eq!(impact, nothing(Reason::OutOfRange));
}

#[test]
fn rest_in_contact_up_to_rounding_says_so() {
    // The vertex stays above the face by a thousandth of the last place of the corners.
    let height = f64::EPSILON / 1000.0;
    let impact = time_of_impact(
        &fall(height, height),
        &Limits {
            tolerance: 0.0,
            separation: 1e-6,
        },
    );
    assert_contact(impact, 0.0, 0.0);
    let tilted = PrimitivePair::vertex_face(
        Motion::resting(DVec3::new(0.25, 0.25, 0.5 + height)),
        [DVec3::Z, DVec3::X, DVec3::Y].map(Motion::resting),
    );
    let impact = time_of_impact(&tilted, &Limits::accurate_to(0.0));
    let Impact::Possible { time, .. } = impact else {
        panic!("it touches");
    };
    assert_eq!(time, 0.0);
}

#[test]
fn single_precision_has_a_tolerance_of_its_own() {
    let at = |z| Vec3::new(0.25, 0.25, z);
    let pair = PrimitivePair::vertex_face(
        Motion::new(at(1.0), at(-1.0)),
        [Vec3::ZERO, Vec3::X, Vec3::Y].map(Motion::resting),
    );
    let time = time_of_impact(&pair, &Limits::default()).time();
    assert!(time.is_some_and(|time| (0.499_998..=0.5).contains(&time)));
}
