//! Runs the steps of a simulation, each of which starts where the last ended.

use selvedge::{CollisionDetector, Topology, glam::DVec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut detector = CollisionDetector::<f64>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    // Near pairs are found for several steps at once and followed.
    detector.set_coherent(true);

    // A triangle slides along a larger one and slowly comes down.
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
    let frame = |step: u32| {
        let by = f64::from(step) * DVec3::new(0.01, 0.0, -0.003);
        [large, small.map(|vertex| vertex + by)].concat()
    };
    let mut contacts = Vec::new();
    for step in 0..80 {
        detector.contacts(&frame(step), &frame(step + 1), &mut contacts)?;
        if let Some(contact) = contacts.first() {
            println!("step {step}: {} {:?} touch", contact.kind, contact.pair);
            break;
        }
    }
    assert!(!contacts.is_empty());
    println!("near pairs were searched for {} times", detector.near_statistics().searches);
    Ok(())
}
