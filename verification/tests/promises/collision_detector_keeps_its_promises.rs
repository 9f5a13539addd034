//! The detector's results agree, step by step, with the exact oracle and with each other.

use crate::support::prelude::*;
use selvedge::PairKind::{EdgeEdge, VertexFace};
use selvedge::{CandidateBoxes, Frame};

fn detector<S: Format>(mesh: &MeshCase<S>) -> CollisionDetector<S> {
    CollisionDetector::new(mesh.topology())
}

fn contacts<S: Format>(detector: &mut CollisionDetector<S>, mesh: &MeshCase<S>) -> Vec<Contact<S>> {
    let mut contacts = Vec::new();
    let result = detector.contacts(&mesh.frame(0), &mesh.frame(1), &mut contacts);
    result.expect("finite positions, one for each vertex");
    contacts
}

fn by_pair<S: Scalar>(contacts: &[Contact<S>]) -> BTreeMap<MeshPair, f64> {
    contacts
        .iter()
        .map(|contact| ((contact.kind, contact.pair), contact.time.to_f64()))
        .collect()
}

/// Runs every query whose result the oracle knows. With exact verdicts the contacts are those that the oracle finds, and no
/// others.
fn no_question_misses_a_contact<S: Format>(mesh: &MeshCase<S>) -> TestCaseResult {
    let topology = mesh.topology();
    let (start, end) = (mesh.frame(0), mesh.frame(1));
    let (mut detector, mut exact) = (detector(mesh), detector(mesh));
    let tolerance = Limits::default().tolerance;
    exact.set_criterion(Criterion::Touching { tolerance }).expect("a length");
    let [vertex_face, edge_edge] = all_pairs(&topology);
    let of_all_pairs = |detector: &mut CollisionDetector<S>| {
        let mut own = Vec::new();
        let result = detector.contacts_of(&start, &end, &vertex_face, &edge_edge, &mut own);
        result.expect("pairs of the mesh");
        by_pair(&own)
    };
    let (all, own) = (by_pair(&contacts(&mut detector, mesh)), of_all_pairs(&mut detector));
    let touching = by_pair(&contacts(&mut exact, mesh));
    prop_assert_eq!(&of_all_pairs(&mut exact), &touching);
    let earliest = detector.earliest(&start, &end).expect("finite positions");
    let earliest = earliest.map(|contact| contact.time.to_f64());
    prop_assert_eq!(detector.is_free(&start, &end), Ok(all.is_empty()));
    prop_assert!(all.keys().all(|pair| own.contains_key(pair)));
    for pair in with_kinds([vertex_face.clone(), edge_edge.clone()]) {
        let first = collides(&mesh.pair(&topology, pair).question());
        prop_assert_eq!(touching.contains_key(&pair), first.is_some(), "{:?}", pair);
        let Some(first) = first else { continue };
        for (question, found) in [
            ("contacts", all.get(&pair).copied()),
            ("contacts_of", own.get(&pair).copied()),
            ("earliest", earliest),
        ] {
            let is_in_time = found.is_some_and(|found| first.cmp_f64(found).is_ge());
            prop_assert!(is_in_time, "{}: {:?}, {:?} at {:?}", question, found, pair, first);
        }
    }
    Ok(())
}

formats!(no_question_misses_a_contact(150, meshes()));

#[test]
fn no_pair_that_comes_within_the_separation_is_missed() {
    check(30, meshes::<f64>(), |mesh| {
        let topology = mesh.topology();
        let mut detector = detector(mesh);
        for separation in [1e-9, 0.25, 1.0] {
            let limits = Limits::within(separation);
            detector.set_criterion(Criterion::Within(limits)).expect("a length");
            let found = by_pair(&contacts(&mut detector, mesh));
            for pair in with_kinds(all_pairs(&topology)) {
                if !found.contains_key(&pair) {
                    let question = mesh.pair(&topology, pair).question();
                    prop_assert!(!within(&question, separation), "{:?}", pair);
                }
            }
        }
        Ok(())
    });
}

/// Positions that are `f32` numbers are examined in `f32` first. A missing number in `f32` must not make two triangles count as
/// free that are never coplanar.
#[test]
fn a_separation_beyond_the_numbers_of_f32_excludes_nothing() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let frame = [
        triangle,
        triangle.map(|point| point + DVec3::new(0.25, 0.25, 1.0) + 0.125 * point.x * DVec3::Z),
    ]
    .concat();
    let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).expect("two triangles");
    let mut detector = CollisionDetector::<f64>::new(topology);
    let mut found = Vec::new();
    for separation in [10.0, 1e39] {
        let limits = Limits::within(separation);
        detector.set_criterion(Criterion::Within(limits)).expect("a length");
        detector.contacts(&frame, &frame, &mut found).expect("finite positions");
        assert_eq!(found.len(), 15, "{separation}");
    }
}

/// Half of the vertices rest, in this step and the next. Pairs with another vertex are found as before, with the same times.
fn what_rests_changes_nothing_for_what_moves<S: Format>(mesh: &MeshCase<S>) -> TestCaseResult {
    let topology = mesh.topology();
    let moving: Vec<bool> = (0..mesh.positions.len()).map(|k| k % 2 == 0).collect();
    let step = |step: usize| {
        mesh.with_positions(|vertex, [start, end]| match (moving[vertex], step) {
            (false, _) => [start; 2],
            (true, 0) => [start, end],
            (true, _) => [end, start],
        })
    };
    let (mut whole, mut part) = (detector(mesh), detector(mesh));
    part.set_moving(Some(&moving)).expect("one for each vertex");
    for number in 0..3 {
        let mesh = step(number);
        let moves = |contact: &Contact<S>| {
            let vertices = topology.vertices_of(contact.kind, contact.pair);
            vertices.iter().any(|&vertex| moving[vertex as usize])
        };
        let mut expected = contacts(&mut whole, &mesh);
        expected.retain(moves);
        let found = contacts(&mut part, &mesh);
        prop_assert_eq!(by_pair(&found), by_pair(&expected), "step {}", number);
    }
    part.set_moving(None).expect("all");
    let all = by_pair(&contacts(&mut part, mesh));
    prop_assert_eq!(all, by_pair(&contacts(&mut whole, mesh)));
    Ok(())
}

formats!(what_rests_changes_nothing_for_what_moves(250, meshes()));

/// Positions in `f32`, and the same in `f64`, give the same contacts, with the same times up to rounding them down.
#[test]
fn the_format_of_the_positions_changes_no_contact() {
    let compared = Cell::new(0);
    check(250, meshes::<f32>(), |mesh| {
        let wide = mesh.with_positions(|_, ends| ends.map(|end| end.map(f64::from)));
        let (mut narrow_detector, mut wide_detector) = (detector(mesh), detector(&wide));
        let limits = Limits::<f32>::default();
        let limits = Limits {
            tolerance: f64::from(limits.tolerance),
            separation: f64::from(limits.separation),
        };
        wide_detector.set_criterion(Criterion::Within(limits)).expect("lengths");
        let found = by_pair(&contacts(&mut narrow_detector, mesh));
        let wide_found = by_pair(&contacts(&mut wide_detector, &wide));
        prop_assert!(found.keys().eq(wide_found.keys()));
        for (pair, &time) in &found {
            let exact = wide_found[pair];
            prop_assert!(time <= exact && time >= exact * (1.0 - 1e-6), "{:?}", pair);
        }
        compared.set(compared.get() + found.len());
        Ok(())
    });
    assert!(compared.get() > 100, "{compared:?}");
}

/// A mesh of many chunks has the same contacts, bits and order.
#[test]
fn instruction_sets_and_threads_change_nothing() {
    let scene = BendingTube::new(40);
    let [start, end] = [57, 58].map(|frame| scene.frame(frame));
    let mut expected: Option<(Vec<Contact<f64>>, Contact<f64>)> = None;
    for (name, level) in available_levels() {
        for threads in [1, 2, 3].map(Threads::from_count) {
            let topology = scene.topology().clone();
            let mut detector = CollisionDetector::<f64>::new(topology);
            detector.set_threads(threads).expect("threads");
            detector.set_level(level);
            let mut contacts = Vec::new();
            for _ in 0..2 {
                let result = detector.contacts(&start, &end, &mut contacts);
                result.expect("finite positions, one for each vertex");
            }
            assert!(!contacts.is_empty());
            assert!(detector.statistics().candidates.total() > 2 * 4096);
            let earliest = detector.earliest(&start, &end).expect("finite positions");
            let earliest = earliest.expect("there are contacts");
            let first = contacts.iter().map(|contact| contact.time);
            assert_eq!(first.reduce(f64::min), Some(earliest.time));
            assert!(!detector.is_free(&start, &end).expect("finite positions"));
            match &expected {
                None => expected = Some((contacts, earliest)),
                Some(expected) => {
                    assert!(*expected == (contacts, earliest), "{name}, {threads:?}");
                }
            }
        }
    }
}

/// Inside a caller's pool and outside of it, every choice of threads gives the same contacts, bits and order.
#[test]
fn a_callers_pool_changes_nothing() {
    let scene = BendingTube::new(10);
    let [start, end] = [57, 58].map(|frame| scene.frame(frame));
    let contacts = |threads: Threads| {
        let mut detector = CollisionDetector::<f64>::new(scene.topology().clone());
        detector.set_threads(threads).expect("threads");
        let mut contacts = Vec::new();
        let result = detector.contacts(&start, &end, &mut contacts);
        result.expect("finite positions, one for each vertex");
        (contacts, detector.threads())
    };
    let (expected, _) = contacts(Threads::Calling);
    assert!(!expected.is_empty());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
    let two = Threads::from_count(2);
    for (threads, outside, inside) in [(Threads::Calling, 1, 1), (Threads::CallersPool, 1, 3), (two, 2, 2)] {
        assert!(contacts(threads) == (expected.clone(), outside), "{threads:?}");
        let in_pool = pool.install(|| contacts(threads));
        assert!(in_pool == (expected.clone(), inside), "{threads:?} in a pool");
    }
    assert!(contacts(Threads::EachCore).0 == expected);
}

/// Vectors of glam and arrays of three give the same results, bit for bit.
#[test]
fn positions_are_vectors_or_arrays() {
    fn answers<S: Scalar, P: Position<Scalar = S>>(topology: &Topology, [start, end]: [&[P]; 2]) -> String {
        let mut detector = CollisionDetector::<S>::new(topology.clone());
        let (mut contacts, mut own) = (Vec::new(), Vec::new());
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        let mut ask = || {
            detector.contacts(start, end, &mut contacts)?;
            let earliest = detector.earliest(start, end)?;
            let is_free = detector.is_free(start, end)?;
            detector.candidates(start, end, CandidateBoxes::Moving, &mut vertex_face, &mut edge_edge)?;
            detector.contacts_of(start, end, &vertex_face, &edge_edge, &mut own)?;
            Ok::<_, StepError>((earliest, is_free))
        };
        let (earliest, is_free) = ask().expect("finite positions, one for each vertex");
        assert!(!contacts.is_empty() && !is_free);
        format!("{contacts:?} {earliest:?} {vertex_face:?} {edge_edge:?} {own:?}")
    }
    let scene = BendingTube::new(1);
    let frames = [57, 60].map(|frame| scene.frame(frame));
    let topology = scene.topology();
    let [start, end] = &frames;
    let arrays = frames
        .each_ref()
        .map(|frame| frame.iter().map(|p| p.to_array()).collect::<Vec<_>>());
    assert_eq!(answers(topology, [start, end]), answers(topology, [&arrays[0], &arrays[1]]));
    let single = frames
        .each_ref()
        .map(|frame| frame.iter().map(|p| p.as_vec3()).collect::<Vec<_>>());
    let arrays = single
        .each_ref()
        .map(|frame| frame.iter().map(|p| p.to_array()).collect::<Vec<_>>());
    assert_eq!(
        answers(topology, [&single[0], &single[1]]),
        answers(topology, [&arrays[0], &arrays[1]])
    );
}

#[test]
fn errors_say_what_is_wrong_in_fields() {
    let mut detector = CollisionDetector::<f32>::new(Topology::new(3, vec![[0, 1, 2]]).expect("a triangle"));
    let (good, short) = ([[0.0; 3]; 3], [[0.0; 3]; 2]);
    let wrong = StepError::WrongLength {
        frame: Frame::End,
        found: 2,
        expected: 3,
    };
    assert_eq!(detector.is_free(&good[..], &short[..]), Err(wrong));
    let bad = [[0.0; 3], [0.0, f32::INFINITY, 0.5], [0.0; 3]];
    let wrong = StepError::NotFinite {
        frame: Frame::Start,
        vertex: 1,
        position: [0.0, f64::INFINITY, 0.5],
    };
    assert_eq!(detector.is_free(&bad, &good), Err(wrong));
    let wrong = StepError::WrongCount { found: 1, expected: 3 };
    assert_eq!(detector.set_moving(Some(&[true])), Err(wrong));
}

#[test]
fn a_pair_of_ones_own_is_looked_at_as_it_is() {
    let resting = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(|x| [x; 2]);
    let falling = [0.2, 0.3, 0.4].map(|x| [[x, 0.2, 1.0], [x, 0.2, -1.0]]);
    let mesh = MeshCase::<f64> {
        triangles: vec![[0, 1, 2], [3, 4, 5]],
        positions: resting.into_iter().chain(falling).collect(),
    };
    let mut detector = detector(&mesh);
    let mut found = Vec::new();
    let (start, end) = (mesh.frame(0), mesh.frame(1));
    let mut ask = |vertex_face: &[[u32; 2]], edge_edge: &[[u32; 2]]| {
        let result = detector.contacts_of(&start, &end, vertex_face, edge_edge, &mut found);
        result.map(|()| found.clone())
    };
    assert_eq!(ask(&[], &[]), Ok(Vec::new()));
    let two = ask(&[[5, 0], [3, 0]], &[]).expect("pairs of the mesh");
    assert_eq!([two[0].pair, two[1].pair], [[5, 0], [3, 0]]);
    assert!(two[0].time > 0.5 - 1e-8 && two[0].time <= 0.5);
    for (vertex_face, edge_edge) in [(&[[6, 0]][..], &[][..]), (&[[0, 2]], &[]), (&[], &[[0, 6]]), (&[], &[[6, 0]])] {
        let error = ask(vertex_face, edge_edge).expect_err("no such pair");
        assert!(matches!(error, StepError::NoSuchPair { .. }), "{error}");
    }
}

#[test]
fn what_is_wrong_with_the_input_is_an_error() {
    let mesh = MeshCase::<f64> {
        triangles: vec![[0, 1, 2]],
        positions: vec![[[0.0; 3]; 2]; 3],
    };
    let frame = mesh.frame(0);
    let mut detector = detector(&mesh);
    let (mut vertex_face, mut edge_edge, mut found) = (Vec::new(), Vec::new(), Vec::new());
    let bad: [&[DVec3]; 3] = [&frame[1..], &[], &[DVec3::NAN; 3]];
    for bad in bad {
        for (start, end) in [(bad, &frame[..]), (&frame[..], bad)] {
            assert!(detector.contacts(start, end, &mut found).is_err());
            assert!(detector.earliest(start, end).is_err());
            assert!(detector.is_free(start, end).is_err());
            let boxes = CandidateBoxes::Moving;
            let result = detector.candidates(start, end, boxes, &mut vertex_face, &mut edge_edge);
            assert!(result.is_err());
            let result = detector.contacts_of(start, end, &[], &[], &mut found);
            assert!(result.is_err());
        }
    }
    assert!(detector.set_moving(Some(&[true])).is_err());
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        let (separation, tolerance) = (bad, 0.0);
        let limits = Limits { tolerance, separation };
        assert!(detector.set_criterion(Criterion::Within(limits)).is_err());
        let limits = Limits::accurate_to(bad);
        assert!(detector.set_criterion(Criterion::Within(limits)).is_err());
    }
    let bad = Criterion::Touching { tolerance: f64::NAN };
    assert!(matches!(detector.set_criterion(bad), Err(StepError::BadLimit { .. })));
    assert!(detector.contacts(&frame, &frame, &mut found).is_ok());
}

/// A vertex of one triangle lies on a vertex of another, and they are different vertices. So they are a pair like any other, in
/// contact throughout.
#[test]
fn a_position_in_common_is_no_vertex_in_common() {
    let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).expect("a mesh");
    let corner = DVec3::new(0.1, 0.2, 0.3);
    let frame = [
        corner,
        corner + DVec3::X,
        corner + DVec3::Y,
        corner,
        corner - DVec3::X + DVec3::Z,
        corner - DVec3::Y + DVec3::Z,
    ];
    let mut contacts = Vec::new();
    let mut detector = CollisionDetector::<f64>::new(topology.clone());
    detector.contacts(&frame, &frame, &mut contacts).expect("finite positions");
    let has = |kind, pair| contacts.iter().any(|contact| (contact.kind, contact.pair) == (kind, pair));
    assert!(has(VertexFace, [0, 1]) && has(VertexFace, [3, 0]));
    let meet = |ends: [u32; 2]| topology.edges().iter().position(|&edge| edge == ends).expect("an edge") as u32;
    let [first, second] = [meet([0, 1]), meet([3, 4])];
    assert!(has(EdgeEdge, [first, second]) || has(EdgeEdge, [second, first]));
}
