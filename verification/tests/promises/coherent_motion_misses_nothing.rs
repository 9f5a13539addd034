//! A detector that follows pairs from step to step gives the results of one that has not seen earlier steps.

use crate::support::prelude::*;
use std::sync::Arc;

type Contacts = BTreeMap<(PairKind, [u32; 2]), u64>;

fn by_pair<S: Scalar>(contacts: &[Contact<S>]) -> Contacts {
    let time = |contact: &Contact<S>| ((contact.kind, contact.pair), contact.time.to_f64().to_bits());
    contacts.iter().map(time).collect()
}

/// Makes steps from the step of a mesh: glides, rests, jumps, repeated steps, ends that a response has changed, and meshes that
/// move far away.
fn steps<S: Format>(mesh: &MeshCase<S>) -> Vec<MeshCase<S>> {
    let step = |position: &dyn Fn(usize, [[S; 3]; 2]) -> [[S; 3]; 2]| mesh.with_positions(position);
    let between = |[from, to]: [[S; 3]; 2], share: f64| {
        [0, 1, 2].map(|axis| {
            let (from, to) = (from[axis].to_f64(), to[axis].to_f64());
            S::from_f64(from + (to - from) * share)
        })
    };
    let glide = |first: f64, last: f64| step(&|_, ends| [between(ends, first), between(ends, last)]);
    let mut steps: Vec<MeshCase<S>> = Vec::new();
    // Six small steps; the last is repeated with another end, and with its own.
    steps.extend((0..6).map(|k| glide(f64::from(k) / 32.0, f64::from(k + 1) / 32.0)));
    steps.push(glide(5.0 / 32.0, 8.0 / 32.0));
    steps.push(glide(5.0 / 32.0, 6.0 / 32.0));
    // The mesh is at rest, then moving, then cut short.
    steps.push(glide(6.0 / 32.0, 6.0 / 32.0));
    steps.push(glide(6.0 / 32.0, 16.0 / 32.0));
    steps.push(glide(7.0 / 32.0, 8.0 / 32.0));
    // The start is not the end of the step before: for one vertex, then for all.
    steps.push(step(&|k, ends| {
        let start = between(ends, if k == 0 { 1.0 } else { 0.25 });
        [start, between(ends, 9.0 / 32.0)]
    }));
    steps.push(glide(9.0 / 32.0, 10.0 / 32.0));
    steps.push(glide(0.0, 1.0));
    steps.push(glide(1.0, 0.0));
    // One vertex moves very far, and comes back.
    let far = |k: usize, position: [S; 3]| {
        if k == 1 {
            position.map(|x| x + S::from_f64(1e30))
        } else {
            position
        }
    };
    steps.push(step(&|k, [start, _]| [start, far(k, start)]));
    steps.push(step(&|k, [start, _]| [far(k, start), start]));
    steps.extend((0..3).map(|k| glide(f64::from(k) / 128.0, f64::from(k + 1) / 128.0)));
    steps
}

/// The findings of a step are those of a new detector, with the same times. Further findings are certainly farther apart than the
/// tolerance: they are pairs on which the elementary test gives up, mostly of faces without area.
fn are_those_of_a_new_one<S: Format>(
    step: &MeshCase<S>,
    topology: &Topology,
    [found, expected]: [&Contacts; 2],
    limits: &Limits<S>,
    compared: &Cell<[usize; 2]>,
) -> TestCaseResult {
    for (pair, time) in found {
        prop_assert_eq!(expected.get(pair), Some(time), "{:?}", pair);
    }
    for pair in expected.keys().filter(|pair| !found.contains_key(pair)) {
        let question = step.pair(topology, *pair).question();
        prop_assert!(
            !within(&question, limits.separation.to_f64() + limits.tolerance.to_f64()),
            "{:?}",
            pair
        );
    }
    let [so_far, more] = compared.get();
    compared.set([so_far + found.len(), more + expected.len() - found.len()]);
    Ok(())
}

fn are_followed<S: Format>(mesh: &MeshCase<S>, compared: &Cell<[usize; 2]>, separation: f64) -> TestCaseResult {
    let topology = Arc::new(mesh.topology());
    let limits = Limits::within(S::from_f64(separation));
    let new = || {
        let mut detector = CollisionDetector::<S>::new(Arc::clone(&topology));
        detector.set_criterion(Criterion::Within(limits)).expect("lengths");
        detector
    };
    let mut coherent = new();
    coherent.set_coherent(true);
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    for (number, step) in steps(mesh).into_iter().enumerate() {
        let (start, end) = (step.frame(0), step.frame(1));
        let result = coherent.contacts(&start, &end, &mut found);
        let mut fresh = new();
        prop_assert_eq!(result.is_err(), fresh.contacts(&start, &end, &mut expected).is_err());
        if result.is_err() {
            continue;
        }
        let keys: Vec<_> = found.iter().map(|contact| (contact.kind, contact.pair)).collect();
        prop_assert!(keys.is_sorted(), "in order");
        are_those_of_a_new_one(&step, &topology, [&by_pair(&found), &by_pair(&expected)], &limits, compared)
            .map_err(|error| TestCaseError::fail(format!("step {number}: {error}")))?;
        // The same step is used in other queries: no result is later than the first time that is certainly within the tolerance.
        let is_certain = |contact: &&Contact<S>| {
            let question = step.pair(&topology, (contact.kind, contact.pair)).question();
            within(&question, limits.separation.to_f64() + limits.tolerance.to_f64())
        };
        // The loop follows the order of times, because the oracle is the slowest part.
        let mut in_time: Vec<_> = found.iter().collect();
        in_time.sort_by(|a, b| a.time.to_f64().total_cmp(&b.time.to_f64()));
        let first = in_time.into_iter().find(is_certain);
        let first = first.map_or(f64::INFINITY, |contact| contact.time.to_f64());
        let earliest = coherent.earliest(&start, &end).expect("finite positions");
        // If the elementary test gives up, the boxes of part of a step may exclude a pair that those of the whole step do not.
        let is_expected = |contact: &Contact<S>| {
            let mut pairs = expected.iter().map(|contact| (contact.kind, contact.pair));
            pairs.any(|pair| pair == (contact.kind, contact.pair)) || !is_certain(&contact)
        };
        prop_assert!(earliest.as_ref().is_none_or(is_expected), "step {}", number);
        prop_assert!(
            first.is_infinite() || earliest.is_some_and(|contact| contact.time.to_f64() <= first),
            "step {}",
            number
        );
        let is_free = coherent.is_free(&start, &end).expect("finite positions");
        prop_assert!(
            if is_free { first.is_infinite() } else { !expected.is_empty() },
            "step {}",
            number
        );
    }
    Ok(())
}

#[test]
fn the_contacts_are_those_of_a_detector_that_has_seen_no_step_before() {
    let compared = Cell::new([0; 2]);
    check(40, meshes::<f64>(), |mesh| are_followed(mesh, &compared, 0.0));
    check(40, meshes::<f32>(), |mesh| are_followed(mesh, &compared, 0.0));
    for separation in [1e-6, 0.25] {
        check(10, meshes::<f64>(), |mesh| are_followed(mesh, &compared, separation));
        check(10, meshes::<f32>(), |mesh| are_followed(mesh, &compared, separation));
    }
    let [found, more] = compared.get();
    assert!(found > 250 && more < found / 20, "{compared:?}");
}

/// For two contacts at 0.99999871 and 0.99999884, the later one once came first in `f32`, because its time was rounded down
/// farther.
#[test]
fn of_contacts_whose_times_hardly_differ_the_earliest_is_the_first() {
    let mesh = MeshCase::<f32> {
        triangles: vec![[0, 2, 4], [4, 3, 1]],
        positions: vec![
            [[-1.0, -3.0, 0.0], [0.0, 0.0, -1.0]],
            [[4.0, -2.0, 0.0], [0.0, 0.0, 2.0]],
            [[-1.0, 0.0, 0.0], [-1.0, -6.0, 2.0]],
            [[-4.0, 1.0, 0.0], [-2.0, 0.0, 0.0]],
            [[0.0, 4.0, 0.0], [-1.0, 1.0, 1.0]],
        ],
    };
    are_followed(&mesh, &Cell::new([0; 2]), 1e-6).unwrap();
}

/// Checks with the oracle that a pair which is not among the contacts neither touches nor comes within the separation.
#[test]
fn no_contact_of_any_step_is_missed() {
    check(12, meshes::<f64>(), |mesh| {
        let topology = Arc::new(mesh.topology());
        for separation in [0.0, 0.125] {
            let limits = Limits::within(separation);
            let mut coherent = CollisionDetector::<f64>::new(Arc::clone(&topology));
            coherent.set_criterion(Criterion::Within(limits)).expect("lengths");
            coherent.set_coherent(true);
            let mut found = Vec::new();
            for step in steps(mesh) {
                if coherent.contacts(&step.frame(0), &step.frame(1), &mut found).is_err() {
                    continue;
                }
                let found = by_pair(&found);
                for pair in with_kinds(all_pairs(&topology)) {
                    let question = step.pair(&topology, pair).question();
                    match found.get(&pair) {
                        None if separation == 0.0 => prop_assert!(collides(&question).is_none(), "{:?}", pair),
                        None => prop_assert!(!within(&question, separation), "{:?}", pair),
                        Some(&time) if separation == 0.0 => {
                            let first = collides(&question);
                            let is_in_time = first.is_none_or(|first| first.cmp_f64(f64::from_bits(time)).is_ge());
                            prop_assert!(is_in_time, "{:?}", pair);
                        }
                        Some(_) => {}
                    }
                }
            }
        }
        Ok(())
    });
}

/// Over a whole bend, and two components that pass each other, every number of threads and every instruction set give the same
/// bits and order.
#[test]
fn threads_and_instruction_sets_change_nothing() {
    let scene = BendingTube::new(8);
    let count = scene.topology().vertex_count() as u32;
    let triangles = scene.topology().triangles();
    let second = triangles.iter().map(|triangle| triangle.map(|vertex| vertex + count));
    let both = triangles.iter().copied().chain(second).collect();
    let topology = Arc::new(Topology::new(2 * count as usize, both).expect("as many again"));
    // The second falls through the first with growing speed.
    let frame = |number: usize| -> Vec<DVec3> {
        let own = scene.frame(number);
        let fallen = 0.02 - 2e-5 * ((number - 36) * (number - 36)) as f64;
        let other = own.iter().map(|&point| point * 1.02 + DVec3::Y * fallen);
        own.iter().copied().chain(other).collect()
    };
    let frames: Vec<_> = (36..61).map(frame).collect();
    for separation in [0.0, 1e-3] {
        let limits = Limits::within(separation);
        let contacts = |threads: Threads, level, is_coherent: bool| -> (Vec<Vec<Contact<f64>>>, u64) {
            let mut detector = CollisionDetector::<f64>::new(Arc::clone(&topology));
            detector.set_criterion(Criterion::Within(limits)).expect("lengths");
            detector.set_threads(threads).expect("threads");
            detector.set_level(level);
            detector.set_coherent(is_coherent);
            let step = |step: &[Vec<DVec3>]| {
                let mut found = Vec::new();
                detector.contacts(&step[0], &step[1], &mut found).expect("finite positions");
                found
            };
            let found = frames.windows(2).map(step).collect();
            (found, detector.near_statistics().searches)
        };
        let mut expected = None;
        for (name, level) in available_levels() {
            for threads in [1, 3].map(Threads::from_count) {
                let (found, searches) = contacts(threads, level, true);
                assert!(searches < 12, "{searches}");
                let expected = expected.get_or_insert_with(|| found.clone());
                assert!(*expected == found, "{name}, {threads:?}");
            }
        }
        let (_, level) = available_levels()[0];
        let (fresh, _) = contacts(Threads::Calling, level, false);
        let expected = expected.expect("a level");
        assert!(expected.iter().map(Vec::len).sum::<usize>() > 100);
        for (found, fresh) in expected.iter().zip(&fresh) {
            assert!(by_pair(found) == by_pair(fresh));
        }
    }
}

/// Half of the vertices rest: pairs among them are not examined, and the others are found as before.
#[test]
fn what_rests_changes_nothing_for_what_moves() {
    check(60, meshes::<f64>(), |mesh| {
        let topology = Arc::new(mesh.topology());
        let moving: Vec<bool> = (0..mesh.positions.len()).map(|k| k % 2 == 0).collect();
        let resting = mesh.with_positions(|vertex, [start, end]| [start, if moving[vertex] { end } else { start }]);
        let mut coherent = CollisionDetector::<f64>::new(Arc::clone(&topology));
        coherent.set_coherent(true);
        coherent.set_moving(Some(&moving)).expect("one for each vertex");
        let mut whole = CollisionDetector::<f64>::new(Arc::clone(&topology));
        let compared = Cell::new([0; 2]);
        let (mut found, mut expected) = (Vec::new(), Vec::new());
        for step in steps(&resting).into_iter().take(10) {
            let (start, end) = (step.frame(0), step.frame(1));
            let result = coherent.contacts(&start, &end, &mut found);
            prop_assert_eq!(result.is_err(), whole.contacts(&start, &end, &mut expected).is_err());
            if result.is_err() {
                continue;
            }
            expected.retain(|contact| {
                let vertices = topology.vertices_of(contact.kind, contact.pair);
                vertices.iter().any(|&vertex| moving[vertex as usize])
            });
            let contacts = [&by_pair(&found), &by_pair(&expected)];
            are_those_of_a_new_one(&step, &topology, contacts, &Limits::default(), &compared)?;
        }
        Ok(())
    });
}

/// With lengths and positions at the limits of the format no pair is excluded, and no overflow causes a panic.
#[test]
fn enormous_lengths_exclude_nothing() {
    let triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let frame = |size: f64, height: f64| -> Vec<DVec3> {
        let above = triangle.map(|point| (point + DVec3::new(0.25, 0.25, height)) * size);
        triangle.map(|point| point * size).into_iter().chain(above).collect()
    };
    let topology = Topology::new(6, vec![[0, 1, 2], [3, 4, 5]]).expect("two triangles");
    let mut detector = CollisionDetector::<f64>::new(topology);
    detector.set_coherent(true);
    let mut found = Vec::new();
    for (size, separation, tolerance) in [
        (1.0, f64::MAX, 0.0),
        (1.0, 1e99, f64::MAX),
        (1e307, 0.0, 0.0),
        (1e300, 1e99, 1e99),
    ] {
        let limits = Limits { tolerance, separation };
        detector.set_criterion(Criterion::Within(limits)).expect("lengths");
        for step in 0..4 {
            let [start, end] = [0, 1].map(|k| frame(size, 1.0 - 0.5 * f64::from(step + k)));
            detector.contacts(&start, &end, &mut found).expect("finite positions");
            let must_be_all = separation > size;
            assert!(
                found.len() == 15 || !must_be_all,
                "{size} {separation} {step}: {}",
                found.len()
            );
        }
    }
}

/// The step has a different query from the one before: another distance, then all vertices, then no coherent mode.
#[test]
fn what_is_asked_may_change_from_step_to_step() {
    let scene = BendingTube::new(4);
    let topology = Arc::new(scene.topology().clone());
    let mut coherent = CollisionDetector::<f64>::new(Arc::clone(&topology));
    let (mut found, mut expected) = (Vec::new(), Vec::new());
    for number in 46..60 {
        coherent.set_coherent(number % 5 != 4);
        let limits = Limits::within([0.0, 1e-3, 1e-3, 4e-3][number % 4]);
        coherent.set_criterion(Criterion::Within(limits)).expect("lengths");
        let mut fresh = CollisionDetector::<f64>::new(Arc::clone(&topology));
        fresh.set_criterion(Criterion::Within(limits)).expect("lengths");
        let (start, end) = (scene.frame(number), scene.frame(number + 1));
        coherent.contacts(&start, &end, &mut found).expect("finite positions");
        fresh.contacts(&start, &end, &mut expected).expect("finite positions");
        assert!(by_pair(&found) == by_pair(&expected), "step {number}");
    }
}
