//! After the first step, a step of the detector allocates nothing, with the caller's buffers.

use selvedge::Mesh;
use selvedge::glam::DVec3;
use selvedge::{CandidateBoxes, CollisionDetector};
use selvedge_cloth::sleeve::sleeve;

/// Returns the mesh in waves that run along it.
fn waves(mesh: &Mesh, count: usize) -> Vec<Vec<DVec3>> {
    let frame = |index: usize| {
        let phase = index as f64 * 0.1;
        let displaced = |&position: &DVec3| position * (1.0 + 0.02 * (phase + 20.0 * position.x).sin());
        mesh.positions.iter().map(displaced).collect()
    };
    (0..count).map(frame).collect()
}

#[test]
fn a_detector_allocates_in_its_first_step_only() {
    let mesh = sleeve(1).expect("a refinement in range");
    let frames = waves(&mesh, 50);
    let topology = mesh.topology().expect("a sleeve");
    let mut detector = CollisionDetector::<f64>::new(topology);
    let (mut contacts, mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new(), Vec::new());
    let counted: Vec<u64> = frames
        .windows(2)
        .map(|pair| {
            let (start, end) = (&pair[0], &pair[1]);
            let mut step = || {
                let boxes = CandidateBoxes::Moving;
                detector.contacts(start, end, &mut contacts)?;
                detector.earliest(start, end)?;
                detector.is_free(start, end)?;
                detector.candidates(start, end, boxes, &mut vertex_face, &mut edge_edge)?;
                detector.contacts_of(start, end, &vertex_face, &edge_edge, &mut contacts)
            };
            let count = allocation_counter::measure(|| step().expect("finite positions"));
            count.count_total
        })
        .collect();
    assert!(counted[0] > 0, "the counter counts");
    assert_eq!(counted[1..], vec![0; frames.len() - 2]);
}
