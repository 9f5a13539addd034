//! The broad phase of moving boxes agrees with its definition, on small degenerate meshes and on a late step of a bending tube.

use crate::support::prelude::*;
use selvedge::broad_phase::MovingBroadPhase;

fn candidates(broad_phase: &mut MovingBroadPhase) -> Vec<MeshPair> {
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    broad_phase.candidates(&mut vertex_face, &mut edge_edge);
    with_kinds([vertex_face, edge_edge])
}

fn updated<S: Format>(mesh: &MeshCase<S>) -> MovingBroadPhase {
    let mut broad_phase = MovingBroadPhase::new(mesh.topology());
    update(&mut broad_phase, mesh);
    broad_phase
}

fn update<S: Format>(broad_phase: &mut MovingBroadPhase, mesh: &MeshCase<S>) {
    let result = broad_phase.update(&mesh.frame(0), &mesh.frame(1));
    result.expect("finite positions, one for each vertex");
}

/// Returns whether, along one axis, all of one primitive is above all of the other at the given ends, in one order.
fn keeps_order<S: Format>(pair: &PairCase<S>, above: impl Fn([S; 2], [S; 2]) -> bool) -> bool {
    let [one, other] = pair.sets();
    (0..3).any(|axis| {
        let along = |points: &[[[S; 3]; 2]]| -> Vec<[S; 2]> { points.iter().map(|ends| ends.map(|x| x[axis])).collect() };
        let all_above = |high: &[[S; 2]], low: &[[S; 2]]| high.iter().all(|&high| low.iter().all(|&low| above(high, low)));
        let (one, other) = (along(one), along(other));
        all_above(&one, &other) || all_above(&other, &one)
    })
}

fn is_f32<S: Format>(mesh: &MeshCase<S>) -> bool {
    let numbers = mesh.positions.iter().flatten().flatten();
    numbers.copied().all(|x| f32::from_f64(x.to_f64()).to_f64() == x.to_f64())
}

/// Returns whether a mesh is near the origin for its size. Then positions are not taken relative to its middle.
fn is_near_origin<S: Format>(mesh: &MeshCase<S>) -> bool {
    (0..3).all(|axis| {
        let numbers = || mesh.positions.iter().flatten().map(|x| x[axis].to_f64());
        let (low, high) = (
            numbers().fold(f64::INFINITY, f64::min),
            numbers().fold(f64::NEG_INFINITY, f64::max),
        );
        (0.5 * low + 0.5 * high).abs() <= 4.0 * (0.5 * high - 0.5 * low)
    })
}

fn candidates_are_those_of_the_definition<S: Format>(mesh: &MeshCase<S>, exact: &Cell<u32>) -> TestCaseResult {
    let topology = mesh.topology();
    let all: BTreeSet<MeshPair> = with_kinds(all_pairs(&topology)).into_iter().collect();
    for is_swept in [false, true] {
        let mut broad_phase = MovingBroadPhase::new(topology.clone());
        broad_phase.set_swept(is_swept);
        update(&mut broad_phase, mesh);
        let found = candidates(&mut broad_phase);
        let set: BTreeSet<MeshPair> = found.iter().copied().collect();
        prop_assert_eq!(set.len(), found.len(), "a pair is found twice");
        prop_assert!(set.is_subset(&all));
        let left = |&pair: &MeshPair| {
            let pair = mesh.pair(&topology, pair);
            !if is_swept {
                keeps_order(&pair, |high, low| high.iter().all(|high| low.iter().all(|low| high > low)))
            } else {
                keeps_order(&pair, |high, low| high[0] > low[0] && high[1] > low[1])
            }
        };
        let left: BTreeSet<MeshPair> = all.iter().copied().filter(left).collect();
        prop_assert!(set.is_superset(&left), "lost: {:?}", left.difference(&set).next());
        if is_f32(mesh) && (S::NAME == "f32" || is_near_origin(mesh)) {
            exact.set(exact.get() + 1);
            prop_assert_eq!(&set, &left);
        }
    }
    Ok(())
}

fn all_candidates_are_those_of_the_definition<S: Format>() {
    let exact = Cell::new(0);
    check(2000, meshes::<S>(), |mesh| {
        candidates_are_those_of_the_definition(mesh, &exact)
    });
    assert!(exact.get() > if S::NAME == "f32" { 3000 } else { 500 }, "{exact:?}");
}

formats!(all_candidates_are_those_of_the_definition);

#[test]
fn candidates_far_from_the_origin_lack_none_of_the_definition() {
    check(1000, meshes::<f64>(), |mesh| {
        let far = mesh.moved_by([1e7, -1e7, 1e7]);
        candidates_are_those_of_the_definition(&far, &Cell::new(0))
    });
}

/// Positions that are moved by integers without rounding leave the same pairs: `f32` spends no digits on the place of the mesh.
#[test]
fn an_exact_translation_leaves_the_same_candidates() {
    let compared = Cell::new(0);
    check(1000, meshes::<f64>(), |mesh| {
        let far = mesh.moved_by([1e7, -1e7, 1e7]);
        let numbers = mesh.positions.iter().flatten().flatten();
        let are_small = numbers.copied().all(|x: f64| x.abs() < 100.0);
        let is_exact = far.moved_by([-1e7, 1e7, -1e7]) == *mesh;
        if are_small && is_exact && is_f32(mesh) && is_near_origin(mesh) {
            compared.set(compared.get() + 1);
            let [near, far] = [mesh, &far].map(|mesh| {
                let found = candidates(&mut updated(mesh));
                found.into_iter().collect::<BTreeSet<_>>()
            });
            // The middle of the mesh may have more digits than `f32`: then there are a few pairs more, but none less.
            prop_assert!(far.is_superset(&near));
            prop_assert!(far.len() <= near.len() + near.len() / 4 + 8);
        }
        Ok(())
    });
    assert!(compared.get() > 50, "{compared:?}");
}

#[test]
fn a_separation_widens_boxes_by_no_more_than_it_has_to() {
    let low = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let high = low.map(|[x, y, z]| [x, y, z + 0.25]);
    let mesh = MeshCase::<f64> {
        triangles: vec![[0, 1, 2], [3, 4, 5]],
        positions: low.into_iter().chain(high).map(|x| [x, x]).collect(),
    };
    let mut broad_phase = MovingBroadPhase::new(mesh.topology());
    for (separation, count) in [(0.0, 0), (0.249_99, 0), (0.25, 15), (1.0, 15)] {
        assert!(broad_phase.set_separation(separation).is_ok());
        update(&mut broad_phase, &mesh);
        assert_eq!(candidates(&mut broad_phase).len(), count, "{separation}");
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let refused = broad_phase.set_separation(bad);
        assert!(matches!(refused, Err(StepError::BadLimit { .. })), "{bad}");
    }
    // The mesh is unchanged.
    update(&mut broad_phase, &mesh);
    assert_eq!(candidates(&mut broad_phase).len(), 15);
}

#[test]
fn frames_of_the_wrong_length_and_what_is_not_finite_are_errors() {
    let mesh = MeshCase::<f64> {
        triangles: vec![[0, 1, 2]],
        positions: vec![[[0.0; 3]; 2]; 3],
    };
    let mut broad_phase = MovingBroadPhase::new(mesh.topology());
    let frame = mesh.frame(0);
    assert!(broad_phase.update(&frame[1..], &frame).is_err());
    assert!(broad_phase.update(&frame, &frame[1..]).is_err());
    let mut bad = frame.clone();
    bad[1].y = f64::NAN;
    assert!(broad_phase.update(&frame, &bad).is_err());
    assert!(broad_phase.update(&frame, &frame).is_ok());
}

fn arm(refinement: u32, frame: usize) -> (Topology, [Vec<DVec3>; 2]) {
    let scene = BendingTube::new(refinement);
    let frames = [frame, frame + 1].map(|frame| scene.frame(frame));
    (scene.topology().clone(), frames)
}

#[test]
fn instruction_sets_and_threads_change_nothing() {
    let (topology, [start, end]) = arm(8, 57);
    let mut expected: Option<Vec<MeshPair>> = None;
    for (name, level) in available_levels() {
        for threads in [1, 2, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
            let found = pool.expect("threads").install(|| {
                let mut broad_phase = MovingBroadPhase::new(topology.clone());
                broad_phase.set_level(level);
                for _ in 0..2 {
                    let result = broad_phase.update(&start, &end);
                    result.expect("finite positions, one for each vertex");
                }
                candidates(&mut broad_phase)
            });
            assert!(found.len() > 2_000, "{}", found.len());
            match &expected {
                None => expected = Some(found),
                Some(expected) => assert!(found == *expected, "{name}, {threads} threads"),
            }
        }
    }
}

/// When triangles change places, the hierarchies degrade, are built again, and then cost as much as at first. The candidates are
/// right throughout.
#[test]
fn degraded_hierarchies_are_built_anew() {
    const SIDE: usize = 60;
    let triangles = (0..3600).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    let topology = Topology::new(3 * SIDE * SIDE, triangles).expect("indices are in range");
    // Triangles on a grid overlap their neighbours. The triangle at each place changes its number.
    let frame = |step: usize| -> Vec<DVec3> {
        let corners = |triangle: usize| {
            let place = triangle * step % (SIDE * SIDE);
            let corner = DVec3::new((place % SIDE) as f64, (place / SIDE) as f64, 0.0);
            [corner, corner + DVec3::X * 1.5, corner + DVec3::Y * 1.5]
        };
        (0..SIDE * SIDE).flat_map(corners).collect()
    };
    let set = |broad_phase: &mut MovingBroadPhase, frame: &[DVec3]| {
        broad_phase.update(frame, frame).expect("finite positions");
        let found = candidates(broad_phase);
        found.into_iter().collect::<BTreeSet<MeshPair>>()
    };
    let mut fresh = MovingBroadPhase::new(topology.clone());
    let expected = set(&mut fresh, &frame(1));

    let mut broad_phase = MovingBroadPhase::new(topology);
    set(&mut broad_phase, &frame(1009));
    for _ in 0..30 {
        assert!(set(&mut broad_phase, &frame(1)) == expected);
    }
    let statistics = broad_phase.statistics();
    assert_eq!(statistics.builds, 2);
    assert_eq!(statistics.box_tests, fresh.statistics().box_tests);
}
