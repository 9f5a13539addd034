//! Cuts a step at its first contact.

use selvedge::{CollisionDetector, Topology, glam::DVec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut detector = CollisionDetector::<f64>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    let large = [
        DVec3::new(-5.0, -5.0, 0.0),
        DVec3::new(5.0, -5.0, 0.0),
        DVec3::new(0.0, 5.0, 0.0),
    ];
    let small = [
        DVec3::new(0.0, 0.0, 0.2),
        DVec3::new(1.0, 0.0, 0.3),
        DVec3::new(0.0, 1.0, 0.4),
    ];
    let start = [large, small].concat();
    let end = [large, small.map(|vertex| vertex - DVec3::Z)].concat();

    let first = detector.earliest(&start, &end)?.expect("the triangles meet");
    println!("{} {:?} touch at {} of the step", first.kind, first.pair, first.time);
    // A step that is a little shorter is free.
    let share = 0.9 * first.time;
    let shorter: Vec<_> = start.iter().zip(&end).map(|(from, &to)| from.lerp(to, share)).collect();
    assert!(detector.is_free(&start, &shorter)?);
    Ok(())
}
