//! Finds the pairs of a mesh at rest that are near each other, with their closest points.

use selvedge::{CollisionDetector, Topology};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut detector = CollisionDetector::<f32>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    let positions = [
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 1.0, 0.5],
        [1.0, 1.0, 2.0],
        [2.0, 1.0, 2.0],
    ];
    let mut near = Vec::new();
    detector.near(&positions, 1.0, &mut near)?;
    for pair in &near {
        // A penalty force would act on these vertices by these weights.
        let geometry = &pair.geometry;
        println!(
            "{} {:?}: {:?} apart, weights {:?}",
            pair.kind, pair.vertices, geometry.distance, geometry.weights
        );
    }
    assert_eq!(near[0].vertices, [3, 0, 1, 2]);
    Ok(())
}
