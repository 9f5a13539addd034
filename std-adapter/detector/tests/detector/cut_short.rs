//! Steps that are cut short leave a usable detector. Unreasonable counts are errors.

use selvedge::glam::DVec3;
use selvedge::{CandidateBoxes, CollisionDetector, Contact, PairKind, StepError, Threads, Topology};
use std::num::NonZeroUsize;
use std::thread;
use std::time::{Duration, Instant};

/// Makes triangles without a common vertex, each moved by `by` from the last.
fn stack(count: u32, by: DVec3) -> (Topology, Vec<DVec3>) {
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let positions = (0..count).flat_map(|k| corners.map(|corner| corner + f64::from(k) * by));
    let triangles = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    (Topology::new(3 * count as usize, triangles).unwrap(), positions.collect())
}

/// Makes a stack that turns upside down within a step.
fn collapsing_stack() -> (Topology, Vec<DVec3>, Vec<DVec3>) {
    let (topology, start) = stack(40, DVec3::new(0.01, 0.0, 0.1));
    let end = start
        .iter()
        .map(|p| DVec3::new(p.x, p.y + 0.2 * p.z, 0.3 * p.x - p.z))
        .collect();
    (topology, start, end)
}

type Pair = (PairKind, [u32; 2], u64);

fn contacts(detector: &mut CollisionDetector<f64>, start: &[DVec3], end: &[DVec3]) -> Result<Vec<Pair>, StepError> {
    let mut contacts = Vec::new();
    detector.contacts(start, end, &mut contacts)?;
    let pair = |contact: &Contact<f64>| (contact.kind, contact.pair, contact.time.to_bits());
    let mut pairs: Vec<_> = contacts.iter().map(pair).collect();
    pairs.sort_unstable();
    Ok(pairs)
}

/// Calls every method, and returns its name and error.
fn ask_all(detector: &mut CollisionDetector<f64>, start: &[DVec3], end: &[DVec3]) -> [(&'static str, Option<StepError>); 7] {
    let (mut first, mut second) = (Vec::new(), Vec::new());
    [
        ("contacts", contacts(detector, start, end).err()),
        ("earliest", detector.earliest(start, end).err()),
        ("is_free", detector.is_free(start, end).err()),
        (
            "candidates",
            detector
                .candidates(start, end, CandidateBoxes::Moving, &mut first, &mut second)
                .err(),
        ),
        (
            "contacts_of",
            detector.contacts_of(start, end, &[[0, 1]; 40], &[], &mut Vec::new()).err(),
        ),
        ("intersections", detector.intersections(start, &mut Vec::new()).err()),
        ("has_intersections", detector.has_intersections(start).err()),
    ]
}

#[test]
fn a_question_that_is_cancelled_ends_soon_and_the_next_is_answered_in_full() {
    // There are six million pairs of vertices and faces in one place, and as many of edges: minutes of exact verdicts.
    let (topology, positions) = stack(1500, DVec3::ZERO);
    for threads in [1, 3] {
        let mut detector = CollisionDetector::<f64>::new(topology.clone());
        detector.set_threads(Threads::from_count(threads)).unwrap();
        let cancellation = detector.cancellation();
        let canceller = thread::spawn(move || {
            thread::sleep(Duration::from_millis(30));
            cancellation.cancel();
            Instant::now()
        });
        let answer = detector.intersections(&positions, &mut Vec::new());
        let ended = Instant::now();
        assert_eq!(answer, Err(StepError::Cancelled));
        let late = ended.saturating_duration_since(canceller.join().unwrap());
        assert!(late < Duration::from_secs(5), "{late:?}");
    }
}

#[test]
fn a_cancelled_detector_refuses_every_question_until_it_is_reset_and_then_answers_as_if_nothing_had_been() {
    let (topology, start, end) = collapsing_stack();
    let expected = contacts(&mut CollisionDetector::new(topology.clone()), &start, &end).unwrap();
    assert!(expected.len() > 100, "{}", expected.len());
    for coherent in [false, true] {
        let mut detector = CollisionDetector::<f64>::new(topology.clone());
        detector.set_coherent(coherent);
        assert_eq!(contacts(&mut detector, &start, &end).as_ref(), Ok(&expected));
        detector.cancellation().cancel();
        for (question, error) in ask_all(&mut detector, &start, &end) {
            assert_eq!(error, Some(StepError::Cancelled), "{question}");
        }
        detector.cancellation().reset();
        assert_eq!(contacts(&mut detector, &start, &end).as_ref(), Ok(&expected));
    }
}

#[test]
fn more_pairs_than_the_limit_are_an_error_on_any_number_of_threads_and_not_one_fewer() {
    let (topology, start, end) = collapsing_stack();
    for threads in [1, 2, 5] {
        let mut detector = CollisionDetector::<f64>::new(topology.clone());
        detector.set_threads(Threads::from_count(threads)).unwrap();
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        detector
            .candidates(&start, &end, CandidateBoxes::Moving, &mut vertex_face, &mut edge_edge)
            .unwrap();
        let expected = contacts(&mut detector, &start, &end).unwrap();
        let pairs = (vertex_face.len() + edge_edge.len()) as u64;
        detector.set_pair_limit(Some(pairs - 1));
        let refused = Err(StepError::TooManyPairs { limit: pairs - 1 });
        assert_eq!(contacts(&mut detector, &start, &end), refused);
        let earliest = detector.earliest(&start, &end).map(|_| Vec::new());
        assert!(earliest.is_ok() || earliest == refused);
        let both = (&mut vertex_face, &mut edge_edge);
        let candidates = detector.candidates(&start, &end, CandidateBoxes::Moving, both.0, both.1);
        assert_eq!(candidates.map(|()| Vec::new()), refused);
        for limit in [Some(pairs), None] {
            detector.set_pair_limit(limit);
            assert_eq!(contacts(&mut detector, &start, &end).as_ref(), Ok(&expected));
        }
    }
}

#[test]
fn contacts_without_end_are_an_error_that_leaves_the_detector_usable_and_the_earliest_needs_no_memory() {
    // All pairs of triangles meet in one place: 15 contacts each.
    let count = 80;
    let (topology, positions) = stack(count, DVec3::ZERO);
    let all = 15 * u64::from(count * (count - 1) / 2);
    for threads in [1, 3] {
        let mut detector = CollisionDetector::<f64>::new(topology.clone());
        detector.set_threads(Threads::from_count(threads)).unwrap();
        let limit = 48 * all - 1;
        detector.set_memory_limit(Some(limit));
        let refused = contacts(&mut detector, &positions, &positions);
        assert_eq!(refused, Err(StepError::TooMuchMemory { limit }));
        let earliest = detector.earliest(&positions, &positions).unwrap().unwrap();
        assert_eq!((earliest.pair, earliest.time), ([0, 1], 0.0));
        assert_eq!(detector.is_free(&positions, &positions), Ok(false));
        detector.set_memory_limit(Some(limit + 1));
        assert_eq!(contacts(&mut detector, &positions, &positions).unwrap().len() as u64, all);

        // Steps that follow near pairs keep these too.
        detector.set_coherent(true);
        detector.set_memory_limit(Some(8 * all));
        for _ in 0..2 {
            let refused = contacts(&mut detector, &positions, &positions);
            assert_eq!(refused, Err(StepError::TooMuchMemory { limit: 8 * all }));
            assert_eq!(
                detector.is_free(&positions, &positions),
                Err(StepError::TooMuchMemory { limit: 8 * all })
            );
        }
        detector.set_memory_limit(None);
        assert_eq!(contacts(&mut detector, &positions, &positions).unwrap().len() as u64, all);
    }
}

#[test]
fn candidates_and_near_pairs_without_end_are_an_error_too() {
    let (topology, positions) = stack(40, DVec3::ZERO);
    let mut detector = CollisionDetector::<f64>::new(topology);
    let limit = 10_000;
    detector.set_memory_limit(Some(limit));
    let refused = Err(StepError::TooMuchMemory { limit });
    let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
    let boxes = CandidateBoxes::Moving;
    let candidates = detector.candidates(&positions, &positions, boxes, &mut vertex_face, &mut edge_edge);
    assert_eq!(candidates, refused);
    let pairs = 15 * 40 * 39 / 2;
    detector.set_memory_limit(Some(8 * pairs + limit));
    assert_eq!(
        detector.candidates(&positions, &positions, boxes, &mut vertex_face, &mut edge_edge),
        Ok(())
    );
    let refused = Err(StepError::TooMuchMemory {
        limit: 8 * pairs + limit,
    });
    assert_eq!(detector.near(&positions, 0.1, &mut Vec::new()), refused);
    detector.set_memory_limit(None);
    assert_eq!(detector.near(&positions, 0.1, &mut Vec::new()), Ok(()));
}

#[test]
fn a_limit_of_none_but_cheap_questions_refuses_what_has_to_be_looked_at() {
    let (topology, positions) = stack(40, DVec3::ZERO);
    let mut detector = CollisionDetector::<f64>::new(topology);
    detector.set_pair_limit(Some(0));
    for (question, error) in ask_all(&mut detector, &positions, &positions) {
        assert_eq!(error, Some(StepError::TooManyPairs { limit: 0 }), "{question}");
    }
}

#[test]
fn threads_beyond_reason_are_refused_and_those_before_stay() {
    let (topology, _) = stack(1, DVec3::ZERO);
    let mut detector = CollisionDetector::<f64>::new(topology);
    detector.set_threads(Threads::from_count(2)).unwrap();
    for count in [Threads::most() + 1, 100_000, usize::MAX] {
        let threads = Threads::Own(NonZeroUsize::new(count).unwrap());
        let error = detector.set_threads(threads).unwrap_err();
        assert_eq!(error.threads, threads);
        let most = format!("{} are the most", Threads::most());
        assert!(error.to_string().contains(&most), "{error}");
        assert_eq!(detector.threads(), 2);
    }
}

#[test]
fn a_mesh_of_as_many_vertices_as_can_be_numbered_takes_memory_for_its_triangles_alone() {
    let last = u32::MAX - 1;
    let topology = Topology::new(u32::MAX as usize, vec![[0, last, 7], [7, last, 3_000_000_000]]).unwrap();
    let edges = [[0, 7], [7, 3_000_000_000], [0, last], [7, last], [3_000_000_000, last]];
    assert_eq!(topology.edges(), edges);
    assert_eq!(topology.statistics().isolated_vertices, u32::MAX as usize - 4);
    let mut detector = CollisionDetector::<f64>::new(topology);
    let refused = detector.is_free(&[DVec3::ZERO; 4], &[DVec3::ZERO; 4]);
    assert!(matches!(refused, Err(StepError::WrongLength { .. })), "{refused:?}");
}
