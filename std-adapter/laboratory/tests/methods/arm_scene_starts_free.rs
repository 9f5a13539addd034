//! The arm scene starts exactly without intersections.

use selvedge_laboratory::scene::ArmScene;
use selvedge_verification::oracle::mesh_self_intersections;

fn intersections_at_the_start(refinement: u32) -> Vec<[u32; 2]> {
    let scene = ArmScene::new(refinement).expect("a refinement in range");
    let positions: Vec<[f64; 3]> = scene.frame(0).iter().map(|position| position.to_array()).collect();
    mesh_self_intersections(&positions, scene.topology().triangles())
}

#[test]
fn the_papers_sleeve_starts_free_of_intersections() {
    assert_eq!(intersections_at_the_start(1), [[0; 2]; 0]);
}

#[test]
fn the_sleeve_refined_ten_times_starts_free_of_intersections() {
    assert_eq!(intersections_at_the_start(10), [[0; 2]; 0]);
}

/// This shows that the tests above can fail.
#[test]
fn the_sleeve_ends_in_itself() {
    let scene = ArmScene::new(1).expect("a refinement in range");
    let positions: Vec<[f64; 3]> = scene
        .frame(ArmScene::STEPS)
        .iter()
        .map(|position| position.to_array())
        .collect();
    assert!(!mesh_self_intersections(&positions, scene.topology().triangles()).is_empty());
}
