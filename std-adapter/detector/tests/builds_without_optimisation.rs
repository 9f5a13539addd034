//! Every kernel and every question to a detector, in little stack, with answers that are the same bits in every build.
//!
//! `test.sh` runs these with optimisation, as all tests, and once more without it, as a user's program in development is built: there
//! frames are largest, and plain loops stand for vectors. The digests were written down from the optimised build.

use fearless_simd::Level;
use fnv::FnvHasher;
use selvedge::core::batch::{
    LANES, Mask, Round, RoundQuestion, Test, Tile, VertexRow, advance_from_rows, closest_points, culled, culled_from_rows,
    culled_from_tiles, largest_strays_from_rows,
};
use selvedge::core::boxes::{relative, segment, swept_boxes};
use selvedge::core::elementary::advance::certain_contact;
use selvedge::core::elementary::advance::{time_of_impact, time_of_impact_within};
use selvedge::core::elementary::{Impact, Limits, contact};
use selvedge::core::filter::{Filter, Tier};
use selvedge::core::glam::DVec3;
use selvedge::core::separation::clearance::Clearance;
use selvedge::core::separation::closest::ClosestPoints;
use selvedge::core::{Motion, PrimitivePair};
use selvedge::{CandidateBoxes, CollisionDetector, Contact, Criterion, PairKind, Scalar, StepError, Topology};
use std::hash::Hasher;

/// What a thread of a pool has at least, everywhere.
const STACK: usize = 1 << 20;

/// The answer of a thread with so little stack.
fn in_little_stack<T: Send + 'static>(action: impl FnOnce() -> T + Send + 'static) -> T {
    let thread = std::thread::Builder::new().stack_size(STACK).spawn(action);
    thread.expect("a thread").join().expect("no panic")
}

/// FNV-1a.
#[derive(Default)]
struct Digest(FnvHasher);

impl Digest {
    fn add(&mut self, answer: impl Into<u64>) {
        self.0.write(&answer.into().to_le_bytes());
    }

    fn add_impact<S: Scalar>(&mut self, impact: Impact<S>) {
        match impact {
            Impact::Never => self.add(u64::MAX),
            Impact::Possible { time, reason } => {
                self.add(reason as u64);
                self.add(time.to_f64().to_bits());
            }
        }
    }

    fn add_contact<S: Scalar>(&mut self, contact: &Contact<S>) {
        self.add(contact.kind as u64);
        self.add(contact.pair[0]);
        self.add(contact.pair[1]);
        self.add(contact.time.to_f64().to_bits());
    }
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ mixed >> 31
    }

    /// In [−1, 1).
    fn number(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Four moving points: in general position, on a small grid, or of sizes as different as the format has.
fn motions<S: Scalar>(random: &mut Random, case: usize) -> [Motion<S>; 4] {
    let largest = S::from_f64(if S::FRACTION_BITS == 23 { 1e37 } else { 1e300 });
    let smallest = S::from_f64(if S::FRACTION_BITS == 23 { 1e-37 } else { 1e-300 });
    let mut coordinate = || {
        let number = random.number();
        match case % 4 {
            0 => S::from_f64(number),
            1 | 2 => S::from_f64((3.0 * number).floor()),
            _ => S::from_f64(number) * if random.next().is_multiple_of(2) { largest } else { smallest },
        }
    };
    let mut position = || [coordinate(), coordinate(), coordinate()];
    [(); 4].map(|()| Motion {
        start: position().into(),
        end: position().into(),
    })
}

/// Every test of one pair.
fn ask_of_pair<S: Scalar>(pair: &PrimitivePair<S>, digest: &mut Digest) {
    let eighth = S::from_f64(0.125);
    for tier in Tier::ALL {
        let filter = Filter::<S>::new(tier);
        let separated = filter.with_separation(eighth).expect("a length");
        digest.add(filter.verdict(pair).is_culled());
        digest.add(separated.verdict(pair).is_culled());
    }
    for verdict in [swept_boxes(pair), relative::three_axes(pair)] {
        digest.add(verdict.is_culled());
    }
    let separated = Limits {
        separation: eighth,
        ..Limits::default()
    };
    for limits in [Limits::default(), separated] {
        digest.add_impact(time_of_impact(pair, &limits));
        digest.add_impact(time_of_impact_within(pair, &limits, eighth, S::from_f64(0.75)));
    }
    let certain = certain_contact(pair, eighth);
    digest.add(certain.map_or(u64::MAX, |[from, _]| from.to_f64().to_bits()));
    digest.add(contact(pair) as u64);
}

fn in_single<S: Scalar>(motion: Motion<S>) -> Motion<f32> {
    let rounded = |position: S::Vector| {
        let position: [S; 3] = position.into();
        position.map(|x| x.to_f64() as f32).into()
    };
    Motion::new(rounded(motion.start), rounded(motion.end))
}

fn in_double<S: Scalar>(motion: Motion<S>) -> DVec3 {
    let start: [S; 3] = motion.start.into();
    start.map(Scalar::to_f64).into()
}

/// Every test and round of many pairs at once, and where they are closest.
fn ask_of_many<S: Scalar>(kind: PairKind, pairs: &[PrimitivePair<S>], digest: &mut Digest) {
    let level = Level::new();
    let rows: Vec<_> = pairs.iter().flat_map(|pair| pair.motions.map(VertexRow::new)).collect();
    let indices: Vec<_> = (0..pairs.len() as u32)
        .map(|k| [4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3])
        .collect();
    let tiles: Vec<_> = pairs
        .chunks(LANES)
        .map(|pairs| Tile::new(pairs.iter().map(|pair| pair.motions)))
        .collect();
    let mut masks = vec![Mask::default(); pairs.len().div_ceil(LANES)];
    for test in [Test::SweptBoxes, Test::SegmentBox, Test::RelativeBoxes] {
        culled(level, test, pairs, &mut masks);
        masks.iter().for_each(|&mask| digest.add(mask));
        culled_from_rows(level, kind, test, &rows, &indices, &mut masks);
        masks.iter().for_each(|&mask| digest.add(mask));
    }
    let filter = Filter::<S>::new(Tier::Permanent);
    culled(level, filter, pairs, &mut masks);
    masks.iter().for_each(|&mask| digest.add(mask));
    culled_from_rows(level, kind, filter, &rows, &indices, &mut masks);
    masks.iter().for_each(|&mask| digest.add(mask));
    for tier in Tier::ALL {
        let filter = Filter::<S>::new(tier);
        let separated = filter.with_separation(S::from_f64(0.125)).expect("a length");
        for filter in [filter, separated] {
            culled_from_tiles(level, kind, filter, &tiles, &mut masks);
            masks.iter().for_each(|&mask| digest.add(mask));
        }
    }
    let in_single: Vec<_> = pairs
        .iter()
        .flat_map(|pair| pair.motions.map(|motion| VertexRow::new(in_single(motion))))
        .collect();
    let clearances = [Clearance::new(0.125, 4.0, 0.5)];
    let mut strays = vec![0.0; pairs.len()];
    let classes = vec![0; pairs.len()];
    largest_strays_from_rows(level, kind, &clearances, &in_single, &indices, &classes, &mut strays);
    strays.iter().for_each(|&stray| digest.add(stray.max(0.0).to_bits()));
    let at_start: Vec<_> = pairs.iter().map(|pair| pair.motions.map(in_double)).collect();
    let mut closest = vec![ClosestPoints::default(); pairs.len()];
    closest_points(level, kind, &at_start, &mut closest);
    for ClosestPoints { weights, way, direction } in closest {
        let numbers = weights.into_iter().chain(way.to_array()).chain(direction.to_array());
        // What is no number is none in whatever bits.
        numbers.for_each(|number| digest.add(if number.is_nan() { 0 } else { number.to_bits() }));
    }
    for with_volume in [false, true] {
        let question = RoundQuestion {
            limits: Limits::default(),
            until: S::ONE,
            with_volume,
        };
        let mut times = vec![S::ZERO; pairs.len()];
        let mut rounds = vec![Round::default(); masks.len()];
        for _ in 0..4 {
            advance_from_rows(level, kind, &question, &rows, &indices, &mut times, &mut rounds);
            for &Round { apart, near, stuck } in &rounds {
                for mask in [apart, near, stuck] {
                    digest.add(mask);
                }
            }
        }
        times.iter().for_each(|time| digest.add(time.to_f64().to_bits()));
    }
}

/// Vertex and face, then two edges.
fn kernels<S: Scalar>() -> [u64; 2] {
    let mut random = Random(S::FRACTION_BITS.into());
    let points: Vec<_> = (0..200).map(|case| motions::<S>(&mut random, case)).collect();
    let vertex_face: Vec<_> = points
        .iter()
        .map(|&[vertex, a, b, c]| PrimitivePair::vertex_face(vertex, [a, b, c]))
        .collect();
    let edge_edge: Vec<_> = points
        .iter()
        .map(|&[a, b, c, d]| PrimitivePair::edge_edge([a, b], [c, d]))
        .collect();
    let (mut digest, mut other) = (Digest::default(), Digest::default());
    for pair in &vertex_face {
        digest.add(segment::primitive_boxes(pair).is_culled());
        ask_of_pair(pair, &mut digest);
    }
    edge_edge.iter().for_each(|pair| ask_of_pair(pair, &mut other));
    ask_of_many(PairKind::VertexFace, &vertex_face, &mut digest);
    ask_of_many(PairKind::EdgeEdge, &edge_edge, &mut other);
    [digest.0.finish(), other.0.finish()]
}

/// Two uneven sheets of `SIDE`² vertices, the upper of which falls through the lower.
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

/// The positions at the start and at the end.
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

/// The answers of a detector to questions about one step, by either criterion.
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

/// Every question but where a step is truncated.
fn detectors<S: Scalar>() -> [u64; 2] {
    answers::<S>(|detector, [start, end], digest| {
        let mut contacts = Vec::new();
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        // Twice: built hierarchies, and refitted ones.
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
fn kernels_need_little_stack_and_answer_as_ever_f32() {
    assert_eq!(written(in_little_stack(kernels::<f32>)), "60d994eaddcc4c5a 6f5fc117540462fc");
}

#[test]
fn kernels_need_little_stack_and_answer_as_ever_f64() {
    assert_eq!(written(in_little_stack(kernels::<f64>)), "ac7c7a707a81b84b 89bd63cbe6c6ea3c");
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
        "7e1e6ad80392807d 825c1d29d511ef95"
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
