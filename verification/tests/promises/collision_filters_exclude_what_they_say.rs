//! With a collision filter, allowed pairs are found with the same times, and excluded ones never are.

use crate::support::prelude::*;
use selvedge::{CandidateBoxes, CollisionFilter, Groups};
use std::sync::Arc;

/// Returns filters of every kind, alone and combined, for any number of vertices.
fn filters(vertices: usize) -> Vec<CollisionFilter> {
    let each = |of: &dyn Fn(u32) -> Groups| (0..vertices as u32).map(of).collect::<Vec<_>>();
    let halves = each(&|v| if v % 2 == 0 { Groups::new(1, 2) } else { Groups::new(2, 3) });
    let ghosts = each(&|v| if v < 4 { Groups::new(1, 0) } else { Groups::ALL });
    let patches: Vec<u32> = (0..vertices as u32).map(|v| v / 4).collect();
    let pairs = || (0..vertices as u32 - 1).flat_map(|v| [[v, v + 1], [v + 1, v / 2]]);
    let rule = |kind, [a, b]: [u32; 2], vertices: [u32; 4]| {
        let sum = a + b + vertices[3] + u32::from(kind == PairKind::EdgeEdge);
        !sum.is_multiple_of(3)
    };
    vec![
        CollisionFilter::new(),
        CollisionFilter::new().with_groups(halves.clone()),
        CollisionFilter::new().with_groups(ghosts),
        CollisionFilter::new().with_patches(patches.clone()),
        CollisionFilter::new().without_vertex_pairs(pairs()),
        CollisionFilter::new().with_rule(rule),
        CollisionFilter::new()
            .with_groups(halves)
            .with_patches(patches)
            .without_vertex_pairs(pairs())
            .with_rule(rule),
    ]
}

fn sorted(mut contacts: Vec<Contact<f64>>) -> Vec<Contact<f64>> {
    contacts.sort_by_key(|contact| (contact.kind, contact.pair));
    contacts
}

fn is_kept(mesh: &MeshCase<f64>, counts: &Cell<[usize; 2]>) -> TestCaseResult {
    let topology = Arc::new(mesh.topology());
    let (start, end) = (mesh.frame(0), mesh.frame(1));
    let mut all = Vec::new();
    let mut detector = CollisionDetector::<f64>::new(Arc::clone(&topology));
    if detector.contacts(&start, &end, &mut all).is_err() {
        return Ok(());
    }
    let (mut all_pairs, mut pairs) = ([Vec::new(), Vec::new()], [Vec::new(), Vec::new()]);
    let [vertex_face, edge_edge] = &mut all_pairs;
    let moving = CandidateBoxes::Moving;
    detector
        .candidates(&start, &end, moving, vertex_face, edge_edge)
        .expect("as before");
    for filter in filters(mesh.positions.len()) {
        let allows = |kind, pair| filter.allows(kind, pair, topology.vertices_of(kind, pair));
        let expected: Vec<_> = all
            .iter()
            .copied()
            .filter(|contact| allows(contact.kind, contact.pair))
            .collect();
        let expected = sorted(expected);
        for is_coherent in [false, true] {
            let mut detector = CollisionDetector::<f64>::new(Arc::clone(&topology));
            detector.set_coherent(is_coherent);
            detector.set_collision_filter(filter.clone()).expect("one for each vertex");
            let mut contacts = Vec::new();
            detector.contacts(&start, &end, &mut contacts).expect("as before");
            let contacts = sorted(contacts);
            if is_coherent {
                // Pairs on which the elementary test gives up may be left out.
                prop_assert!(contacts.iter().all(|contact| expected.contains(contact)));
            } else {
                prop_assert_eq!(&contacts, &expected);
                prop_assert_eq!(detector.is_free(&start, &end).expect("as before"), expected.is_empty());
            }
            let [vertex_face, edge_edge] = &mut pairs;
            detector
                .candidates(&start, &end, moving, vertex_face, edge_edge)
                .expect("as before");
            for (kind, (pairs, all)) in PairKind::ALL.into_iter().zip(pairs.iter_mut().zip(&all_pairs)) {
                let mut expected: Vec<_> = all.iter().copied().filter(|&pair| allows(kind, pair)).collect();
                expected.sort_unstable();
                pairs.sort_unstable();
                prop_assert_eq!(&*pairs, &expected);
            }
        }
        let [kept, excluded] = counts.get();
        counts.set([kept + expected.len(), excluded + all.len() - expected.len()]);
    }
    Ok(())
}

#[test]
fn what_is_allowed_is_found_and_nothing_else() {
    let counts = Cell::new([0; 2]);
    check(80, meshes::<f64>(), |mesh| is_kept(mesh, &counts));
    // Usually some thousand; a few cases hold most of them.
    assert!(counts.get().into_iter().all(|count| count > 50), "{:?}", counts.get());
}

/// Two tubes, one inside the other, that do not collide with each other need about as many box tests as one alone.
#[test]
fn what_groups_exclude_as_a_whole_is_not_looked_at() {
    let scene = BendingTube::new(12);
    let count = scene.topology().vertex_count();
    let triangles = scene.topology().triangles();
    let second = triangles.iter().map(|triangle| triangle.map(|vertex| vertex + count as u32));
    let both: Vec<_> = triangles.iter().copied().chain(second).collect();
    let twice = |frame: usize| -> Vec<_> {
        let own = scene.frame(frame);
        own.iter().copied().chain(own.iter().map(|&point| point * 1.001)).collect()
    };
    let candidates = |filter: Option<CollisionFilter>| {
        let topology = Topology::new(2 * count, both.clone()).expect("as many again");
        let mut detector = CollisionDetector::<f64>::new(topology);
        if let Some(filter) = filter {
            detector.set_collision_filter(filter).expect("one for each vertex");
        }
        let mut contacts = Vec::new();
        detector
            .contacts(&twice(30), &twice(31), &mut contacts)
            .expect("finite positions");
        detector.statistics().candidates.total()
    };
    let groups = [Groups::new(1, 1), Groups::new(2, 2)];
    let groups = groups.into_iter().flat_map(|own| vec![own; count]).collect();
    let (all, apart) = (candidates(None), candidates(Some(CollisionFilter::new().with_groups(groups))));
    let mut alone = CollisionDetector::<f64>::new(scene.topology().clone());
    alone
        .contacts(&scene.frame(30), &scene.frame(31), &mut Vec::new())
        .expect("finite positions");
    let alone = alone.statistics().candidates.total();
    assert!(all > 3 * alone && apart < 3 * alone, "{all} {apart} {alone}");
}

#[test]
fn a_filter_for_another_mesh_is_an_error_and_changes_nothing() {
    let mut detector = CollisionDetector::<f64>::new(Topology::new(3, vec![[0, 1, 2]]).expect("a triangle"));
    let mut wrong = |filter| detector.set_collision_filter(filter).unwrap_err();
    let (found, expected) = (2, 3);
    assert_eq!(
        wrong(CollisionFilter::new().with_groups(vec![Groups::ALL; 2])),
        StepError::WrongCount { found, expected }
    );
    assert_eq!(
        wrong(CollisionFilter::new().with_patches(vec![7; 2])),
        StepError::WrongCount { found, expected }
    );
    let (vertex, count) = (3, 3);
    assert_eq!(
        wrong(CollisionFilter::new().without_vertex_pairs([[0, 1], [3, 0]])),
        StepError::NoSuchVertex { vertex, count }
    );
}
