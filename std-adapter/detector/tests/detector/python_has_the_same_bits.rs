//! The contacts of some steps, to the last bit. Python's package has a test of the same steps, which reads the same digests.

use fnv::FnvHasher;
use selvedge::{CollisionDetector, PairKind, Scalar, Topology};
use std::fmt::Write as _;
use std::hash::Hasher;

const SIZE: u32 = 12;
const STEPS: u32 = 8;
const DIGESTS: &str = include_str!("../../../python/tests/contacts.digests");

/// Returns two sheets of triangles, one above the other.
fn faces() -> Vec<[u32; 3]> {
    let mut faces = Vec::new();
    for first in [0, SIZE * SIZE] {
        for row in 0..SIZE - 1 {
            for column in 0..SIZE - 1 {
                let corner = first + row * SIZE + column;
                faces.push([corner, corner + SIZE, corner + 1]);
                faces.push([corner + 1, corner + SIZE, corner + SIZE + 1]);
            }
        }
    }
    faces
}

/// Returns the position of a vertex in a frame. Coordinates are whole multiples of 2⁻¹⁶, from a multiplicative congruence, so
/// that every language has the same.
fn frame(number: u32) -> Vec<[f64; 3]> {
    let mut state = number + 1;
    let mut shift = |range: u32| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from((state >> 16) % range)
    };
    let mut positions = Vec::new();
    for sheet in 0..2 {
        for row in 0..SIZE {
            for column in 0..SIZE {
                let at = [row * 6000, column * 6000, sheet * 3000];
                positions.push(at.map(|at| (f64::from(at) + shift(4000)) / 65536.0));
            }
        }
    }
    positions
}

fn digests<S: Scalar>() -> Vec<String> {
    let mut detector = CollisionDetector::<S>::new(Topology::new(2 * (SIZE * SIZE) as usize, faces()).unwrap());
    let narrow = |positions: Vec<[f64; 3]>| {
        positions
            .into_iter()
            .map(|position| position.map(S::from_f64))
            .collect::<Vec<_>>()
    };
    let mut contacts = Vec::new();
    let mut digests = Vec::new();
    for step in 0..STEPS {
        detector
            .contacts(&narrow(frame(step)), &narrow(frame(step + 1)), &mut contacts)
            .unwrap();
        contacts.sort_by_key(|contact| (contact.kind == PairKind::EdgeEdge, contact.pair));
        let mut digest = FnvHasher::default();
        for contact in &contacts {
            digest.write(&[u8::from(contact.kind == PairKind::EdgeEdge)]);
            contact.pair.iter().for_each(|number| digest.write(&number.to_le_bytes()));
            // The time is exact in `f32` as well.
            digest.write(&contact.time.to_f64().to_le_bytes());
        }
        digests.push(format!("{} {step} {} {:016x}", S::NAME, contacts.len(), digest.finish()));
    }
    digests
}

#[test]
fn contacts_have_the_bits_that_python_has() {
    let mut found = String::new();
    for line in digests::<f32>().into_iter().chain(digests::<f64>()) {
        writeln!(found, "{line}").unwrap();
    }
    assert_eq!(found, DIGESTS);
}
