//! Points, weights, distance and normal of a contact agree with rational numbers.

use crate::support::at;
use crate::support::geometry::Truth;
use crate::support::prelude::*;
use selvedge_core::separation::geometry::{Geometry, geometry};

/// Checks everything that is promised, at one time. Returns whether there is a normal.
fn keeps_promises(case: &PairCase<f64>, time: f64) -> Result<bool, TestCaseError> {
    are_kept(case, time, &geometry(&case.pair(), time))
}

fn are_kept(case: &PairCase<f64>, time: f64, found: &Geometry) -> Result<bool, TestCaseError> {
    let motions = case.pair().motions;
    let ends: Vec<DVec3> = motions.iter().flat_map(|motion| [motion.start, motion.end]).collect();
    let velocity = |motion: Motion<f64>| [0, 1, 2].map(|axis| rational(motion.end[axis]) - rational(motion.start[axis]));
    let from_first = motions.iter().flat_map(|motion| {
        let of_one = |end: DVec3, first: DVec3| [0, 1, 2].map(|axis| (rational(end[axis]) - rational(first[axis])).abs());
        [of_one(motion.start, motions[0].start), of_one(motion.end, motions[0].end)]
    });
    let truth = Truth {
        kind: case.kind,
        time,
        at: &|time| motions.map(|motion| at(motion.start.to_array(), motion.end.to_array(), &rational(time))),
        velocities: motions.map(velocity),
        largest: rational(largest_coordinate(&ends)),
        of_speed: from_first.flatten().max().expect("eight points"),
        position_errors: [0.0; 2],
        velocity_errors: 0.0,
    };
    truth.is_promised(found)
}

fn is_in_range(case: &PairCase<f64>) -> bool {
    case.coordinates().all(|x| x.abs() < 1e150)
}

#[test]
fn points_weights_distances_and_normals_are_as_promised_at_any_time() {
    let normals = Cell::new([0; 2]);
    let count = |has_normal: bool| {
        let mut counts = normals.get();
        counts[usize::from(has_normal)] += 1;
        normals.set(counts);
    };
    for time in [0.0, 0.3, 1.0] {
        let property = |case: &PairCase<f64>| {
            if is_in_range(case) {
                count(keeps_promises(case, time)?);
            }
            Ok(())
        };
        check(400, pairs_of_any_kind::<f64>(), property);
        check(400, extraordinary_pairs::<f64>(), property);
    }
    let [without, with] = normals.get();
    assert!(without > 50 && with > 500, "{without} {with}");
}

#[test]
fn the_thread_may_round_in_any_direction_and_flush_subnormal_numbers() {
    for time in [0.0, 0.3, 1.0] {
        let property = |case: &PairCase<f64>| {
            if is_in_range(case) {
                for environment in Environment::all() {
                    let found = environment.run(case, |case| geometry(&case.pair(), time));
                    are_kept(case, time, &found).map_err(|error| TestCaseError::fail(format!("{environment:?}: {error}")))?;
                }
            }
            Ok(())
        };
        check(60, pairs_of_any_kind::<f64>(), property);
        check(60, extraordinary_pairs::<f64>(), property);
    }
}

/// At a time of impact, just before they touch, most pairs have a normal.
#[test]
fn a_pair_that_was_apart_before_it_touches_has_a_normal() {
    use selvedge_core::elementary::advance::time_of_impact;
    use selvedge_core::elementary::{Impact, Limits};
    let found = Cell::new([0; 2]);
    check(1500, touching_pairs::<f64>(), |moment: &MeetingPair<f64>| {
        let case = &moment.pair();
        if !is_in_range(case) {
            return Ok(());
        }
        if let Impact::Possible { time, .. } = time_of_impact(&case.pair(), &Limits::default()) {
            let has_normal = keeps_promises(case, time)?;
            let [all, with] = found.get();
            // Excludes pairs that touch at the start of the step, or are too near for floating point.
            let begins_apart = time > 0.0;
            found.set([
                all + usize::from(begins_apart),
                with + usize::from(begins_apart && has_normal),
            ]);
        }
        Ok(())
    });
    let [all, with] = found.get();
    assert!(all > 200 && 10 * with > 9 * all, "{with} of {all}");
}

/// On a mesh all near pairs are found, and a contact's geometry is that of its pair, in any numbering of the pairs.
#[test]
fn near_pairs_are_all_within_the_distance_and_none_is_missed() {
    let scene = BendingTube::new(4);
    let topology = scene.topology().clone();
    let positions = scene.frame(50);
    let mut detector = CollisionDetector::<f64>::new(topology.clone());
    let mut near = Vec::new();
    let mut threaded = CollisionDetector::<f64>::new(topology.clone());
    threaded.set_threads(selvedge::Threads::from_count(2)).expect("threads");
    let mut same = Vec::new();
    for distance in [0.0, 1e-3, 1e-2] {
        detector.near(&positions, distance, &mut near).expect("finite positions");
        threaded.near(&positions, distance, &mut same).expect("finite positions");
        assert!(near == same, "on two threads");
        let keys: Vec<_> = near.iter().map(|near| (near.kind, near.pair)).collect();
        assert!(keys.is_sorted());
        let is_within = |pair: (PairKind, [u32; 2]), distance: f64| {
            let vertices = topology.vertices_of(pair.0, pair.1);
            let resting = vertices.map(|vertex| [positions[vertex as usize].to_array(); 2]);
            within_at(&PairCase::new(pair.0, resting).question(), &Rational::new(), distance)
        };
        // Checks some of them, and some of the many others.
        assert!(keys.iter().step_by(61).all(|&pair| is_within(pair, 1.00001 * distance)));
        let others = with_kinds(all_pairs(&topology)).into_iter();
        for pair in others.step_by(19_997).filter(|pair| keys.binary_search(pair).is_err()) {
            assert!(!is_within(pair, distance), "{pair:?}");
        }
    }
    assert!(near.len() > 100);
}

#[test]
fn geometry_of_what_the_mesh_does_not_have_is_an_error() {
    let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).expect("triangles");
    let mut detector = CollisionDetector::<f64>::new(topology);
    let start = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 1.0, 0.5],
        [1.0, 1.0, 2.0],
        [2.0, 1.0, 2.0],
    ];
    let mut end = start;
    end[3][2] = -0.5;
    let contact = detector
        .earliest(&start, &end)
        .expect("finite positions")
        .expect("the vertex goes through the face");
    let strange = selvedge::Contact { pair: [3, 2], ..contact };
    let (kind, pair) = (strange.kind, strange.pair);
    let no_such_pair = StepError::NoSuchPair { kind, pair };
    assert_eq!(detector.contact_geometry(&start, &end, &strange), Err(no_such_pair));
    let many = detector.contact_geometries(&start, &end, &[contact, strange], &mut Vec::new());
    assert_eq!(many, Err(no_such_pair));
    assert!(detector.contact_geometry(&start, &end[1..], &contact).is_err());
    assert!(detector.near(&start, f64::NAN, &mut Vec::new()).is_err());
    for time in [-1.0, 2.0, f64::NAN, f64::INFINITY] {
        let at_no_time = selvedge::Contact { time, ..contact };
        let found = detector.contact_geometry(&start, &end, &at_no_time);
        assert!(matches!(found, Err(StepError::BadTime { time: told }) if told.to_bits() == time.to_bits()));
        let found = detector.contact_geometries(&start, &end, &[contact, at_no_time], &mut Vec::new());
        assert!(matches!(found, Err(StepError::BadTime { .. })));
    }
    end[0][0] = f64::NAN;
    assert!(
        detector
            .contact_geometries(&start, &end, &[contact], &mut Vec::new())
            .is_err()
    );
    let found = detector.contact_geometry(&start, &end, &contact).expect("a pair of the mesh");
    assert_eq!((found.geometry.normal, found.geometry.distance), (None, [0.0, f64::INFINITY]));
}
