//! A truncated step is free of contact by exact arithmetic, for any wanted step, and points are held back only if needed.

use crate::support::prelude::*;
use selvedge_core::glam::DQuat;
use selvedge_core::separation::carried::{LARGEST_TURN, is_too_near, kept_when_carried};
use selvedge_core::separation::gap::{GapError, SeparatingDirection, distance_from_below};
use selvedge_core::separation::truncation::shares;

/// Counts whole and truncated steps, and truncated ones with a pair in contact at the start.
type Met = Cell<[usize; 3]>;

fn are_in_contact(question: &Pair, separation: f64) -> bool {
    if separation == 0.0 {
        collides(question).is_some()
    } else {
        within(question, separation)
    }
}

fn is_free<S: Format>(mesh: &MeshCase<S>, criterion: Criterion<S>, met: &Met) -> TestCaseResult {
    let topology = mesh.topology();
    let separation = match criterion {
        Criterion::Within(limits) => limits.separation.to_f64(),
        Criterion::Touching { .. } => 0.0,
    };
    let truncated = |threads| {
        let mut detector = CollisionDetector::<S>::new(mesh.topology());
        detector.set_criterion(criterion).expect("lengths");
        detector.set_threads(threads).expect("threads");
        let mut end = Vec::new();
        let truncation = detector.truncate(&mesh.frame(0), &mesh.frame(1), &mut end);
        truncation.map(|truncation| (truncation, end, detector))
    };
    let Ok((truncation, end, mut detector)) = truncated(Threads::Calling) else {
        let is_finite = |ends: &[[S; 3]; 2]| ends.iter().flatten().all(|&x| x.is_finite());
        prop_assert!(!mesh.positions.iter().all(is_finite));
        return Ok(());
    };
    let step = mesh.with_positions(|vertex, [start, _]| [start, end[vertex].into()]);
    for pair in with_kinds(all_pairs(&topology)) {
        let vertices = topology
            .vertices_of(pair.0, pair.1)
            .map(|vertex| step.positions[vertex as usize]);
        if are_in_contact(&step.pair(&topology, pair).question(), separation) {
            prop_assert!(vertices.iter().all(|[start, end]| start == end), "{:?}", pair);
            prop_assert!(truncation.in_contact > 0, "{:?}", pair);
        }
    }
    let mut held_back = 0;
    for (&[start, wanted], &[_, end]) in mesh.positions.iter().zip(&step.positions) {
        held_back += usize::from(end != wanted);
        for axis in 0..3 {
            let (from, to, at) = (start[axis].to_f64(), wanted[axis].to_f64(), end[axis].to_f64());
            prop_assert!(from.min(to) <= at && at <= from.max(to), "in the box of its path");
        }
    }
    prop_assert!(held_back <= truncation.held_back);
    let is_free_as_wanted = detector.is_free(&mesh.frame(0), &mesh.frame(1)).expect("finite positions");
    prop_assert_eq!(is_free_as_wanted, truncation.rounds == 1);
    if truncation.rounds == 1 {
        prop_assert_eq!(held_back, 0);
    }
    if truncation.in_contact == 0 {
        prop_assert!(detector.is_free(&mesh.frame(0), &end).expect("finite positions"));
    }
    let (others, same, _) = truncated(Threads::from_count(2)).expect("it went well on one thread");
    prop_assert_eq!(truncation, others);
    prop_assert!(end == same, "the same bits");

    let [whole, some, stuck] = met.get();
    met.set(match truncation {
        truncation if truncation.rounds == 1 => [whole + 1, some, stuck],
        truncation if truncation.in_contact == 0 => [whole, some + 1, stuck],
        _ => [whole, some, stuck + 1],
    });
    Ok(())
}

#[test]
fn what_is_left_of_a_step_is_free_but_for_what_is_in_contact_at_the_start_and_rests() {
    let met = Cell::new([0; 3]);
    for separation in [0.0, 1e-6, 0.125] {
        let within = |tolerance| Limits { separation, tolerance };
        check(60, meshes::<f64>(), |mesh| {
            is_free(mesh, Criterion::Within(within(1e-9)), &met)
        });
        let within = Limits {
            separation: separation as f32,
            tolerance: 1e-6,
        };
        check(60, meshes::<f32>(), |mesh| is_free(mesh, Criterion::Within(within), &met));
    }
    check(40, meshes::<f64>(), |mesh| {
        is_free(mesh, Criterion::Touching { tolerance: 1e-9 }, &met)
    });
    assert!(met.get().into_iter().all(|steps| steps > 10), "{:?}", met.get());
}

/// The lemma holds for the function itself: each point may move by any part of its share, in any combination. It also holds from
/// any state in which the direction keeps the pair apart, where the shares are those of displacements from a base.
#[test]
fn a_pair_keeps_its_separation_for_all_smaller_shares() {
    let (held, from_a_base) = (Cell::new(0), Cell::new(0));
    let coordinates = || prop::array::uniform3(-1.0..1.0_f64);
    let points = || prop::array::uniform4(coordinates());
    let inputs = (
        points(),
        points(),
        coordinates(),
        prop::array::uniform4(0.0..=1.0_f64),
        -40..40_i32,
        any::<bool>(),
        points(),
    );
    check(
        2000,
        inputs,
        |&(start, wanted, direction, parts, exponent, is_edges, before)| {
            let scale = 2_f64.powi(exponent);
            let points = |of: [[f64; 3]; 4]| of.map(|point| DVec3::from(point) * scale);
            let (mut start, mut wanted, mut before) = (points(start), points(wanted), points(before));
            let kind = if is_edges { PairKind::EdgeEdge } else { PairKind::VertexFace };
            // Most cases start apart.
            let direction = DVec3::from(direction).normalize_or_zero();
            for corner in 0..if is_edges { 2 } else { 1 } {
                start[corner] += direction * scale;
                wanted[corner] += direction * (0.25 * scale);
                before[corner] += direction * scale;
            }
            let all = [start, wanted, before].concat();
            let largest = largest_coordinate(&all);
            let separation = 0.01 * scale;
            let Some(shares) = shares(
                kind,
                [start, wanted],
                direction,
                separation,
                GapError::from_largest_coordinate(largest),
            ) else {
                return Ok(());
            };
            held.set(held.get() + usize::from(shares.iter().any(|&share| share < 1.0)));
            let mut ends = wanted;
            for corner in 0..4 {
                prop_assert!((0.0..=1.0).contains(&shares[corner]));
                ends[corner] = Motion::new(start[corner], wanted[corner]).at(shares[corner] * parts[corner]);
            }
            let error = GapError::from_largest_coordinate(largest);
            let others = SeparatingDirection::for_step(kind, direction, [before, start], separation, error).map(|_| before);
            from_a_base.set(from_a_base.get() + usize::from(others.is_some()));
            for from in [start].into_iter().chain(others) {
                let motions = [0, 1, 2, 3].map(|corner| [from[corner].to_array(), ends[corner].to_array()]);
                let question = PairCase::new(kind, motions).question();
                prop_assert!(!within(&question, separation));
            }
            Ok(())
        },
    );
    assert!(held.get() > 400, "{}", held.get());
    assert!(from_a_base.get() > 100, "{}", from_a_base.get());
}

/// A pair that is carried along rigidly keeps the required distance, however near it starts. The bound shows this for
/// translations, exact arithmetic for turns.
#[test]
fn a_pair_that_is_carried_along_keeps_its_separation() {
    let kept_any = Cell::new(0);
    let coordinates = || prop::array::uniform3(-1.0..1.0_f64);
    let inputs = (
        prop::array::uniform4(coordinates()),
        [coordinates(), coordinates()],
        -LARGEST_TURN..LARGEST_TURN,
        [-40..40_i32, -45..2],
        any::<bool>(),
    );
    check(2000, inputs, |&(points, [way, axis], angle, [exponent, apart], is_edges)| {
        let kind = if is_edges { PairKind::EdgeEdge } else { PairKind::VertexFace };
        let scale = 2_f64.powi(exponent);
        let mut start = points.map(|point| DVec3::from(point) * scale);
        let [a, b, c, d] = start;
        let (normal, first) = match kind {
            PairKind::VertexFace => ((c - b).cross(d - b), 1),
            PairKind::EdgeEdge => ((b - a).cross(d - c), 2),
        };
        let direction = normal.normalize_or_zero();
        // As near along the normal as the second exponent says.
        let [low, high] = [0, 1].map(|side| {
            let own = if side == 0 { &start[..first] } else { &start[first..] };
            let along = own.iter().map(|point| point.dot(direction));
            if side == 0 {
                along.fold(f64::INFINITY, f64::min)
            } else {
                along.fold(f64::NEG_INFINITY, f64::max)
            }
        });
        let shift = direction * (high - low + scale * 2_f64.powi(apart));
        start[..first].iter_mut().for_each(|point| *point += shift);
        let turn = DQuat::from_axis_angle(DVec3::from(axis).try_normalize().unwrap_or(DVec3::X), angle);
        let ends = [
            start.map(|point| point + DVec3::from(way) * scale),
            start.map(|point| turn * point),
        ];
        for (end, is_translated) in ends.into_iter().zip([true, false]) {
            let error = GapError::from_largest_coordinate(largest_coordinate(&[start, end].concat()));
            let distance = distance_from_below(kind, start, direction, error);
            if is_too_near(distance, error) {
                continue;
            }
            kept_any.set(kept_any.get() + 1);
            let kept = kept_when_carried(f64::INFINITY, distance, error);
            prop_assert!(kept > 0.0 || distance <= 3.1 * error.length());
            prop_assert_eq!(kept_when_carried(0.5 * kept, distance, error), 0.5 * kept);
            let at_end = distance_from_below(kind, end, direction, error);
            prop_assert!(
                !is_translated || at_end > kept,
                "{} at the end of {}, {} to keep",
                at_end,
                distance,
                kept
            );
            let motions = [0, 1, 2, 3].map(|corner| [start[corner].to_array(), end[corner].to_array()]);
            prop_assert!(!within(&PairCase::new(kind, motions).question(), kept));
        }
        Ok(())
    });
    assert!(kept_any.get() > 1000, "{}", kept_any.get());
}
