//! Every answer is the same, bit for bit, on every machine, and from one version to the next until someone changes it on
//! purpose: a digest of the answers to questions that are the same each time.
//!
//! The other promises say what an answer must not be. Within that, a test may become blunter, or a time earlier, and nobody would
//! notice; here one does. A change that is meant changes a digest: the failure prints the new ones; put them in place of the old ones, and say in the
//! commit what became sharper, or blunter, and why.

use selvedge_core::PrimitivePair;
use selvedge_core::boxes::moving::{MovingBlock, MovingBox};
use selvedge_core::boxes::{Aabb, direction, segment, swept_boxes};
use selvedge_core::coplanarity::{error_bound_by_magnitudes, is_in_range};
use selvedge_core::elementary::advance::confirm::certain_contact;
use selvedge_core::elementary::advance::{
    time_of_impact_and_work, time_of_impact_within, uncertified,
};
use selvedge_core::elementary::contact::contact_and_evidence;
use selvedge_core::elementary::{Impact, Limits};
use selvedge_core::exact::{
    UNKNOWN, certain_signs, control_value_signs, is_never_coplanar, is_never_within, touches,
};
use selvedge_core::filter::{Filter, Tier, inside, plain};
use selvedge_core::points::{PairShape, Shape};
use selvedge_verification::campaign::exact::{Source, sample};
use selvedge_verification::culling;
use selvedge_verification::generator::{Format, PairCase};
use selvedge_verification::oracle::Kind;

/// FNV-1a, of which there is only one.
struct Digest(u64);

impl Digest {
    fn add(&mut self, answer: u64) {
        for byte in answer.to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Every NaN is the same: which one an operation makes is the machine's choice.
    fn add_number<S: Format>(&mut self, number: S) {
        let number = number.to_f64();
        self.add(if number.is_nan() { 1 } else { number.to_bits() });
    }

    fn add_numbers<S: Format, const N: usize>(&mut self, numbers: [S; N]) {
        for number in numbers {
            self.add_number(number);
        }
    }

    fn add_impact<S: Format>(&mut self, impact: Impact<S>) {
        match impact {
            Impact::Never => self.add(u64::MAX),
            Impact::Possible { time, reason } => {
                self.add(reason as u64);
                self.add_number(time);
            }
        }
    }
}

/// Random and adversarial pairs; one in sixteen has a coordinate that no mesh should have.
fn cases<S: Format>(kind: Kind, count: usize) -> Vec<PairCase<S>> {
    let mut cases = sample(Source::Random, kind, 1, count);
    cases.append(&mut sample(Source::Adversarial, kind, 2, count));
    let odd = [
        S::NAN,
        S::INFINITY,
        -S::INFINITY,
        S::LARGEST,
        -S::LARGEST,
        S::exact(1, S::MIN_EXPONENT),
        S::exact(1, S::MAX_EXPONENT / 3),
        S::exact(1, S::MAX_EXPONENT / 4),
    ];
    for (index, case) in cases.iter_mut().step_by(16).enumerate() {
        let place = index % 24;
        case.points[place / 6][place / 3 % 2][place % 3] = odd[index / 24 % odd.len()];
    }
    cases
}

/// A question about one pair, of either kind.
trait Question {
    fn ask<S: Format, P: PrimitivePair<S>>(case: &PairCase<S>, pair: &P, digest: &mut Digest);
}

fn digest<S: Format, Q: Question>(kind: Kind, count: usize) -> u64 {
    let mut digest = Digest(0xcbf2_9ce4_8422_2325);
    for case in cases::<S>(kind, count) {
        match kind {
            Kind::VertexFace => Q::ask(&case, &case.vertex_face(), &mut digest),
            Kind::EdgeEdge => Q::ask(&case, &case.edge_edge(), &mut digest),
        }
    }
    digest.0
}

/// Of vertex and face, `f32` and `f64`, and of two edges.
fn digests<Q: Question>(count: usize) -> String {
    let all = [
        digest::<f32, Q>(Kind::VertexFace, count),
        digest::<f64, Q>(Kind::VertexFace, count),
        digest::<f32, Q>(Kind::EdgeEdge, count),
        digest::<f64, Q>(Kind::EdgeEdge, count),
    ];
    all.map(|digest| format!("{digest:016x}")).join(" ")
}

/// A separation of the size of the pair, which some keep and some do not.
fn separation_of<S: Format>(case: &PairCase<S>) -> S {
    let [first, second] = [case.points[0][0], case.points[3][0]];
    let apart = (first[0] - second[0]).abs() * S::from_f64(0.125);
    if apart.is_finite() { apart } else { S::ONE }
}

struct Filters;

impl Question for Filters {
    fn ask<S: Format, P: PrimitivePair<S>>(case: &PairCase<S>, pair: &P, digest: &mut Digest) {
        let mut bits = u64::from(plain::non_coplanarity(pair).is_culled());
        bits |= u64::from(inside::never_inside(pair).is_culled()) << 1;
        for tier in Tier::ALL {
            let filter = Filter::new(tier);
            let separated = filter
                .with_separation(separation_of(case))
                .expect("positive");
            bits = bits << 2 | u64::from(filter.verdict(pair).is_culled());
            bits |= u64::from(separated.verdict(pair).is_culled()) << 1;
        }
        digest.add(bits);
    }
}

#[test]
fn filters() {
    assert_eq!(
        digests::<Filters>(10_000),
        "cd017e3776ebc994 80de981605a8a825 54d04b8bb6546cd9 0a72743d10fdb8d2"
    );
}

struct Volume;

impl Question for Volume {
    fn ask<S: Format, P: PrimitivePair<S>>(_: &PairCase<S>, pair: &P, digest: &mut Digest) {
        let volume = pair.tetrahedron();
        let (values, bounds) = (volume.control_values(), volume.error_bounds());
        digest.add_numbers(values.0);
        digest.add_numbers(bounds);
        for largest in [volume.largest_by_axis(), volume.largest_by_edge()] {
            digest.add_number(error_bound_by_magnitudes(largest));
            digest.add(u64::from(is_in_range(largest.largest())));
        }
        for shape in [Shape::VertexFace, Shape::EdgeEdge] {
            digest.add_number(volume.largest_normal(shape));
        }
        digest.add(u64::from(values.one_sign_beyond(bounds)));
    }
}

#[test]
fn control_values_and_their_bounds() {
    assert_eq!(
        digests::<Volume>(10_000),
        "41a0d454fcccab0d 31724f339a9c26f6 6797d2ebc8b1c82b e3c824fc089f6ea6"
    );
}

struct Boxes;

impl Question for Boxes {
    fn ask<S: Format, P: PrimitivePair<S>>(case: &PairCase<S>, pair: &P, digest: &mut Digest) {
        let mut bits = u64::from(direction::normal(pair).is_culled());
        bits |= u64::from(swept_boxes(pair).is_culled()) << 1;
        for test in culling::ALL {
            bits = bits << 1 | u64::from(culling::verdict(test, case).is_culled());
        }
        let motions = case.motions();
        let target = Aabb::swept(&motions[1..]);
        bits = bits << 1 | u64::from(segment::misses(&motions[0], &target));
        let boxes = motions.map(|motion| MovingBox::of(&motion));
        let [first, second] = [boxes[0].merged(&boxes[1]), boxes[2].merged(&boxes[3])];
        bits = bits << 1 | u64::from(first.is_apart_from(&second));
        digest.add(bits);
        let Aabb { lower, upper } = first.merged(&second).swept();
        digest.add_numbers(lower);
        digest.add_numbers(upper);
    }
}

#[test]
fn boxes() {
    assert_eq!(
        digests::<Boxes>(10_000),
        "da606488cb6e0da3 ca181c924c51259a 164625d50d982e99 02459708fa2836f0"
    );
}

/// The moving boxes of four points at a time, in lanes, against those of the pair before.
struct Blocks;

impl Question for Blocks {
    fn ask<S: Format, P: PrimitivePair<S>>(case: &PairCase<S>, _: &P, digest: &mut Digest) {
        let mut block = MovingBlock::empty();
        let narrow = case
            .points
            .map(|ends| ends.map(|x| x.map(|x| x.to_f64() as f32)));
        let boxes = narrow.map(|[start, end]| MovingBox::of(&(start, end).into()));
        for (lane, moving) in boxes.iter().enumerate() {
            block.set(5 * lane, moving);
        }
        boxes
            .iter()
            .for_each(|moving| digest.add(block.near(moving).into()));
        let merged = block.merged();
        for Aabb { lower, upper } in [merged.start, merged.end, block.get(5).start] {
            digest.add_numbers(lower);
            digest.add_numbers(upper);
        }
    }
}

#[test]
fn blocks_of_moving_boxes() {
    assert_eq!(
        digests::<Blocks>(4000),
        "aff0600662443cba e50cbf388cdf7a68 ee5fd7bd97ec7a07 216809e60c381d79"
    );
}

struct Signs;

impl Question for Signs {
    fn ask<S: Format, P: PrimitivePair<S>>(case: &PairCase<S>, pair: &P, digest: &mut Digest) {
        fn of<Q: PairShape, S: Format>(case: &PairCase<S>, pair: &impl PrimitivePair<S>) -> u64 {
            let (points, volume) = (pair.points(), pair.tetrahedron());
            let signs = control_value_signs::<Q, S>(&points);
            let mut bits = signs.map_or(0, |signs| {
                signs.iter().fold(0, |bits, &sign| {
                    bits * 4 + u64::from((sign as i8 + 2).unsigned_abs())
                })
            });
            let known = certain_signs(&volume.control_values(), volume.error_bounds());
            for sign in known {
                let sign = sign.map_or(0, |sign| (sign as i8 + 2).unsigned_abs());
                bits = bits << 2 | u64::from(sign);
            }
            for known in [UNKNOWN, known] {
                bits = bits << 1 | u64::from(is_never_coplanar::<Q, S>(&points, known));
            }
            let within = is_never_within::<Q, S>(&points, separation_of(case), UNKNOWN);
            bits << 1 | u64::from(within)
        }
        digest.add(of::<P::Shape, S>(case, pair));
    }
}

#[test]
fn exact_signs() {
    assert_eq!(
        digests::<Signs>(10_000),
        "36a348c9db5018b8 1101cc70ec9252d0 8368961d363d15a9 5a7da4b285c5ec0a"
    );
}

struct Times;

impl Question for Times {
    fn ask<S: Format, P: PrimitivePair<S>>(case: &PairCase<S>, pair: &P, digest: &mut Digest) {
        let separated = Limits {
            separation: separation_of(case),
            ..Limits::default()
        };
        let tight = Limits {
            tolerance: S::ZERO,
            separation: S::ZERO,
        };
        for limits in [Limits::default(), separated, tight] {
            let (impact, work) = time_of_impact_and_work(pair, &limits);
            digest.add_impact(impact);
            digest.add(u64::from(work.rounds));
            digest.add(u64::from(work.volume_steps));
            digest.add(u64::from(work.turns));
        }
        let [early, late, never] = [0.25, 0.75, -0.5].map(S::from_f64);
        for (from, until) in [
            (early, late),
            (late, early),
            (never, late),
            (early, S::ONE + S::ONE),
            (S::NAN, late),
            (early, S::NAN),
        ] {
            digest.add_impact(time_of_impact_within(pair, &tight, from, until));
        }
        digest.add_impact(uncertified::time_of_impact(pair, &separated));
        for near in [S::ZERO, early, S::ONE] {
            match certain_contact(pair, near) {
                None => digest.add(0),
                Some(times) => digest.add_numbers(times),
            }
        }
    }
}

#[test]
fn times_of_impact() {
    assert_eq!(
        digests::<Times>(8000),
        "9d9e06623489e73e ddaa6f0cde7bb15b 51ae2e707b60fc0d afa515bd05f6307a"
    );
}

struct Contacts;

impl Question for Contacts {
    fn ask<S: Format, P: PrimitivePair<S>>(_: &PairCase<S>, pair: &P, digest: &mut Digest) {
        let (contact, evidence) = contact_and_evidence(pair);
        digest.add(contact as u64);
        digest.add(evidence as u64);
        let exact = touches::<P::Shape, S>(&pair.points());
        digest.add(exact.map_or(2, u64::from));
    }
}

#[test]
fn exact_verdicts() {
    assert_eq!(
        digests::<Contacts>(4000),
        "200a190f66ae44e7 d6d5261c9dead584 8bbc5ae65411a805 37e432f1d506d667"
    );
}
