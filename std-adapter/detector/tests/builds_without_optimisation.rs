//! Calls every method of a detector on a thread with little stack, and compares the bits of the results with those of an
//! optimised build.
//!
//! `test.sh` runs these tests with optimisation, and once more without it, as in a program under development. Stack frames are
//! then largest, and plain loops stand for vectors.

use fnv::FnvHasher;
use selvedge::core::elementary::Limits;
use selvedge::{CandidateBoxes, CollisionDetector, Contact, Criterion, Scalar, StepError, Topology};
use std::hash::Hasher;

/// The smallest stack of a pool's thread on any platform.
const STACK: usize = 1 << 20;

fn in_little_stack<T: Send + 'static>(action: impl FnOnce() -> T + Send + 'static) -> T {
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(action);
    thread.expect("a thread").join().expect("no panic")
}

/// The hash FNV-1a.
#[derive(Default)]
struct Digest(FnvHasher);

impl Digest {
    fn add(&mut self, answer: impl Into<u64>) {
        self.0.write(&answer.into().to_le_bytes());
    }

    fn add_contact<S: Scalar>(&mut self, contact: &Contact<S>) {
        self.add(contact.kind as u64);
        self.add(contact.pair[0]);
        self.add(contact.pair[1]);
        self.add(contact.time.to_f64().to_bits());
    }
}

/// The generator SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// Returns a number in [−1, 1).
    fn number(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// The number of vertices along a side of two uneven sheets, the upper of which falls through the lower.
const SIDE: u32 = 24;

fn sheets() -> Topology {
    let triangles = (0..2 * SIDE).filter(|row| row % SIDE != SIDE - 1).flat_map(|row| {
        (0..SIDE - 1).flat_map(move |column| {
            let corner = row * SIDE + column;
            [
                [corner, corner + 1, corner + SIDE],
                [corner + 1, corner + SIDE + 1, corner + SIDE],
            ]
        })
    });
    Topology::new(2 * (SIDE * SIDE) as usize, triangles.collect()).expect("triangles of the sheets")
}

/// Returns the positions at the start and at the end.
fn frames<S: Scalar>() -> [Vec<[S; 3]>; 2] {
    let mut random = Random(7);
    let mut frame = |height: f64| {
        let vertex = |index: u32| {
            let (upper, index) = (index / (SIDE * SIDE), index % (SIDE * SIDE));
            let z = if upper == 1 { height } else { 0.0 };
            let at = [f64::from(index % SIDE), f64::from(index / SIDE), z];
            at.map(|x| S::from_f64(x + 0.25 * random.number()))
        };
        (0..2 * SIDE * SIDE).map(vertex).collect()
    };
    [frame(0.75), frame(-0.125)]
}

fn answers<S: Scalar>(ask: impl Fn(&mut CollisionDetector<S>, [&[[S; 3]]; 2], &mut Digest) -> Result<(), StepError>) -> [u64; 2] {
    let [start, end] = frames::<S>();
    let tolerance = Limits::default().tolerance;
    let separated = Limits {
        separation: S::from_f64(0.03125),
        tolerance,
    };
    [Criterion::Within(separated), Criterion::Touching { tolerance }].map(|criterion| {
        let mut detector = CollisionDetector::<S>::new(sheets());
        detector.set_criterion(criterion).expect("lengths");
        let mut digest = Digest::default();
        ask(&mut detector, [&start, &end], &mut digest).expect("finite positions, one for each vertex");
        digest.0.finish()
    })
}

/// Calls every method but `truncate`.
fn detectors<S: Scalar>() -> [u64; 2] {
    answers::<S>(|detector, [start, end], digest| {
        let mut contacts = Vec::new();
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        // The first run has new hierarchies, the second refitted ones.
        for _ in 0..2 {
            detector.contacts(start, end, &mut contacts)?;
            assert!(contacts.len() > 1000);
            contacts.iter().for_each(|contact| digest.add_contact(contact));
        }
        let earliest = detector.earliest(start, end)?;
        earliest.iter().for_each(|contact| digest.add_contact(contact));
        digest.add(detector.is_free(start, end)?);
        digest.add(detector.is_free(start, start)?);
        for boxes in [CandidateBoxes::Swept, CandidateBoxes::Moving] {
            detector.candidates(start, end, boxes, &mut vertex_face, &mut edge_edge)?;
            for [first, second] in vertex_face.iter().chain(&edge_edge) {
                digest.add(*first);
                digest.add(*second);
            }
        }
        detector.contacts_of(start, end, &vertex_face, &edge_edge, &mut contacts)?;
        contacts.iter().for_each(|contact| digest.add_contact(contact));
        Ok(())
    })
}

fn truncated<S: Scalar>() -> [u64; 2] {
    answers::<S>(|detector, [start, wanted], digest| {
        let mut end = Vec::new();
        let truncation = detector.truncate(start, wanted, &mut end)?;
        assert!(truncation.held_back > 10 && detector.is_free(start, &end)? == (truncation.in_contact == 0));
        end.iter().flatten().for_each(|x: &S| digest.add(x.to_f64().to_bits()));
        Ok(())
    })
}

fn written([a, b]: [u64; 2]) -> String {
    format!("{a:016x} {b:016x}")
}

#[test]
fn a_detector_needs_little_stack_and_answers_as_ever_f32() {
    assert_eq!(
        written(in_little_stack(detectors::<f32>)),
        "a8f3fb2a03e13fd3 6c001ae9dace57e3"
    );
}

#[test]
fn a_detector_needs_little_stack_and_answers_as_ever_f64() {
    assert_eq!(
        written(in_little_stack(detectors::<f64>)),
        "761b919df16c5a10 825c1d29d511ef95"
    );
}

#[test]
fn a_truncated_step_needs_little_stack_and_ends_where_it_always_does() {
    assert_eq!(
        written(in_little_stack(truncated::<f32>)),
        "7803fc776034605c 6de459e2f9ceb077"
    );
    assert_eq!(
        written(in_little_stack(truncated::<f64>)),
        "8986c88a26d1c3f4 a8136671b61d2e34"
    );
}
