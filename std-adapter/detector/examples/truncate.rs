//! Holds back only the vertices that would collide.

use selvedge::{CollisionDetector, Topology, glam::DVec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // Two small triangles fall. The first meets a large one; the second falls beside it.
    let mut detector = CollisionDetector::<f64>::new(Topology::new(9, vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]])?);
    let large = [
        DVec3::new(-5.0, -5.0, 0.0),
        DVec3::new(5.0, -5.0, 0.0),
        DVec3::new(0.0, 5.0, 0.0),
    ];
    let small = |x| {
        [
            DVec3::new(x, 0.0, 0.2),
            DVec3::new(x + 1.0, 0.0, 0.3),
            DVec3::new(x, 1.0, 0.4),
        ]
    };
    let start = [large, small(0.0), small(9.0)].concat();
    let mut wanted = start.clone();
    wanted[3..].iter_mut().for_each(|vertex| vertex.z -= 0.5);

    let mut end = Vec::new();
    let truncation = detector.truncate(&start, &wanted, &mut end)?;
    println!(
        "{} vertices are held back, after {} rounds",
        truncation.held_back, truncation.rounds
    );
    assert!(detector.is_free(&start, &end)?);
    assert_eq!(end[6..], wanted[6..]);
    Ok(())
}
