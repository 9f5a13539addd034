//! Finds all contacts of a step, with their points and normals.

use selvedge::{CollisionDetector, Topology};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A small triangle falls through a large one.
    let mut detector = CollisionDetector::<f32>::new(Topology::new(6, vec![[0, 1, 2], [3, 4, 5]])?);
    let start = [
        [-5.0, -5.0, 0.0],
        [5.0, -5.0, 0.0],
        [0.0, 5.0, 0.0],
        [0.0, 0.0, 0.2],
        [1.0, 0.0, 0.3],
        [0.0, 1.0, 0.4],
    ];
    let mut end = start;
    end[3..].iter_mut().for_each(|vertex| vertex[2] -= 0.5);

    let mut contacts = Vec::new();
    detector.contacts(&start, &end, &mut contacts)?;
    for contact in &contacts {
        let found = detector.contact_geometry(&start, &end, contact)?;
        let (points, normal) = (found.geometry.points, found.geometry.normal);
        println!(
            "{} {:?} at {}: {:?}, normal {normal:?}",
            contact.kind, contact.pair, contact.time, points[0]
        );
    }
    assert_eq!(contacts.len(), 3);
    Ok(())
}
