//! After the first step, a step allocates nothing.

use selvedge::Mesh;
use selvedge::glam::DVec3;
use selvedge::{CandidateBoxes, CollisionDetector};
use selvedge_cloth::sleeve::sleeve;
use selvedge_laboratory::methods::Preset;
use selvedge_laboratory::pipeline::Pipeline;
use selvedge_laboratory::scene::ArmScene;

/// Counts allocations in each step, on the calling thread.
fn allocations(pipeline: &mut Pipeline<f64>, frames: &[Vec<DVec3>]) -> Vec<u64> {
    let mut step = |start: &[DVec3], end: &[DVec3]| {
        allocation_counter::measure(|| {
            let report = pipeline.step(start, end);
            report.expect("finite positions, one for each vertex");
        })
        .count_total
    };
    frames.windows(2).map(|pair| step(&pair[0], &pair[1])).collect()
}

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
fn a_sleeve_in_waves_allocates_in_its_first_step_only() {
    let mesh = sleeve(1).expect("a refinement in range");
    let frames = waves(&mesh, 40);
    for preset in Preset::ALL {
        let topology = mesh.topology().expect("a sleeve");
        let mut pipeline = Pipeline::new(topology, preset.stages(), 1).expect("one thread");
        let counted = allocations(&mut pipeline, &frames);
        assert!(counted[0] > 0, "{preset}: the counter counts");
        assert_eq!(counted[1..], vec![0; frames.len() - 2], "{preset}");
    }
}

/// The detector's methods allocate nothing either, with the caller's buffers.
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

/// The arm bends again and again, from where folds begin to meet. When the broad phase builds its tree again, a list may have to
/// grow once more, but seldom.
#[test]
fn the_arm_bent_again_and_again_hardly_allocates_after_the_first_time() {
    let scene = ArmScene::new(1).expect("a refinement in range");
    let frames: Vec<_> = (40..=ArmScene::STEPS).map(|frame| scene.frame(frame)).collect();
    for preset in Preset::ALL {
        let topology = scene.topology().clone();
        let mut pipeline = Pipeline::new(topology, preset.stages(), 1).expect("one thread");
        pipeline.keep_candidates(true);
        let mut round = || allocations(&mut pipeline, &frames).iter().sum::<u64>();
        let first = round();
        let later: u64 = (0..4).map(|_| round()).sum();
        assert!(
            40 * later <= first,
            "{preset}: {first} allocations in the first round, {later} in four more"
        );
    }
}
