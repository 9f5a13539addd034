//! Every method rebuilds degraded hierarchies when that pays.

use super::detector::CollisionDetector;
use crate::mesh::Topology;
use crate::step::StepError;
use selvedge_core::glam::DVec3;
use std::sync::Arc;

const SIDE: u32 = 60;

/// Makes a square sheet. If it is crumpled, every part of it lies in a small ball, and neighbours are near each other.
fn sheet(is_crumpled: bool) -> Vec<DVec3> {
    let at = |k: u32| {
        let [x, y] = [k % SIDE, k / SIDE].map(f64::from);
        let wave = |a: f64, b: f64| (0.31 * a + 1.7 * (0.23 * b).sin()).sin();
        let crumpled = DVec3::new(wave(x, y), wave(y, x), wave(x - y, x + y)) * 4.0;
        if is_crumpled { crumpled } else { DVec3::new(x, y, 0.0) }
    };
    (0..SIDE * SIDE).map(at).collect()
}

fn topology() -> Arc<Topology> {
    let cells = (0..SIDE * (SIDE - 1)).filter(|k| k % SIDE + 1 < SIDE);
    let triangles = cells.flat_map(|k| [[k, k + 1, k + SIDE], [k + 1, k + SIDE + 1, k + SIDE]]);
    Arc::new(Topology::new((SIDE * SIDE) as usize, triangles.collect()).unwrap())
}

/// Counts the builds of hierarchies when a method is called for a crumpled sheet, then for a smooth one, and for that again.
fn builds(threads: usize, ask: impl Fn(&mut CollisionDetector<f64>, &[DVec3]) -> Result<(), StepError>) -> [usize; 3] {
    let mut detector = CollisionDetector::new(topology());
    detector.set_threads(crate::Threads::from_count(threads)).unwrap();
    [(true, 1), (false, 10), (false, 10)].map(|(is_crumpled, times)| {
        for _ in 0..times {
            ask(&mut detector, &sheet(is_crumpled)).unwrap();
        }
        detector.engine.broad_phase.hierarchies.statistics().builds
    })
}

#[test]
fn every_method_rebuilds_hierarchies_once_when_a_crumpled_mesh_becomes_smooth() {
    type Ask = fn(&mut CollisionDetector<f64>, &[DVec3]) -> Result<(), StepError>;
    let questions: [Ask; 5] = [
        |detector, p| detector.contacts(p, p, &mut Vec::new()),
        |detector, p| detector.earliest(p, p).map(|_| ()),
        |detector, p| detector.is_free(p, p).map(|_| ()),
        |detector, p| detector.intersections(p, &mut Vec::new()),
        |detector, p| detector.has_intersections(p).map(|_| ()),
    ];
    for threads in [1, 2] {
        assert_eq!(questions.map(|ask| builds(threads, ask)), [[1, 2, 2]; 5]);
    }
}
