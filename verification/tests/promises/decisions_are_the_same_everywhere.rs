//! Every result is the same, bit for bit, on every machine and in every version. Each test compares a digest of the results of
//! fixed queries.
//!
//! The other promises exclude wrong results. Within them, a test could become less sharp, or a time earlier, without a failure;
//! here it fails. An intended change changes a digest, and the failure prints the new ones. Replace the old ones, and explain in
//! the commit which results became sharper or less sharp, and why.

use crate::support::digest::{Digest, cases};
use crate::support::prelude::*;
use selvedge_core::batch::{Compares, Loop, Mask, in_lanes};
use selvedge_core::boxes::block::BoxBlock;
use selvedge_core::boxes::moving::{MovingBlock, MovingBox};
use selvedge_core::boxes::{segment, swept_boxes};
use selvedge_core::elementary::advance::certain_contact;
use selvedge_core::elementary::advance::time_of_impact_and_work;
use selvedge_core::elementary::contact::contact_and_evidence;
use selvedge_core::kernels::coplanarity::error_bound_by_magnitudes;
use selvedge_core::kernels::exact::{UNKNOWN, certain_signs, control_value_signs, is_never_coplanar, is_never_within, touches};
use selvedge_core::separation::geometry::geometry;
use selvedge_verification::culling;

/// A question about one pair, of either kind.
type Question<S> = fn(&PairCase<S>, &PrimitivePair<S>, &mut Digest);

fn digest<S: Format>(kind: PairKind, count: usize, ask: Question<S>) -> u64 {
    let mut digest = Digest::default();
    for case in cases::<S>(kind, count) {
        ask(&case, &case.pair(), &mut digest);
    }
    digest.finish()
}

/// Returns the digests of vertex–face pairs in `f32` and `f64`, and of edge–edge pairs.
fn digests(count: usize, in_f32: Question<f32>, in_f64: Question<f64>) -> String {
    let of_kind = |kind| [digest(kind, count, in_f32), digest(kind, count, in_f64)];
    let all = PairKind::ALL.map(of_kind);
    all.as_flattened()
        .iter()
        .map(|digest| format!("{digest:016x}"))
        .collect::<Vec<_>>()
        .join(" ")
}

/// Returns a separation of the size of the pair, so that some pairs are kept and some are culled.
fn separation_of<S: Format>(case: &PairCase<S>) -> S {
    let [first, second] = [case.points[0][0], case.points[3][0]];
    let apart = (first[0] - second[0]).abs() * S::from_f64(0.125);
    if apart.is_finite() { apart } else { S::ONE }
}

fn of_filters<S: Format>(case: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    for odd in [S::NAN, S::INFINITY, -S::ONE] {
        let separated = Filter::new(Tier::Permanent).with_separation(odd);
        digest.add(u64::from(separated.is_some()));
    }
    let mut bits = 0;
    let mut add = |alone: Verdict, separated: Verdict| {
        bits = bits << 2 | u64::from(alone.is_culled()) | u64::from(separated.is_culled()) << 1;
    };
    for tier in Tier::ALL {
        let filter = Filter::new(tier);
        let separated = filter.with_separation(separation_of(case)).expect("positive");
        add(filter.verdict(pair), separated.verdict(pair));
    }
    digest.add(bits);
}

#[test]
fn filters() {
    assert_eq!(
        digests(10_000, of_filters, of_filters),
        "fc30cf837ca491bc bc82dccb8d9f6438 1096646b7d71c27b ea08f49d3e2a3acd"
    );
}

fn of_volume<S: Format>(_: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    let volume = MovingTetrahedron::from(pair);
    let (values, bounds) = (volume.control_values(), volume.error_bounds());
    digest.add_numbers(values.0);
    digest.add_numbers(bounds);
    let largest = volume.largest_by_axis();
    digest.add_number(error_bound_by_magnitudes(largest));
    digest.add(u64::from(is_in_range(largest.largest())));
    for kind in PairKind::ALL {
        digest.add_number(volume.largest_normal(kind));
    }
    digest.add(u64::from(values.one_sign_beyond(bounds)));
}

#[test]
fn control_values_and_their_bounds() {
    assert_eq!(
        digests(10_000, of_volume, of_volume),
        "49dd52df5a209cc9 4f45650a3226f385 78f33fc028cb0de2 d4e09d282d8651ab"
    );
}

fn of_boxes<S: Format>(case: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    let mut bits = u64::from(swept_boxes(pair).is_culled());
    for test in CertifiedTest::ALL {
        bits = bits << 1 | u64::from(culling::verdict(test, case).is_culled());
    }
    let motions = case.motions();
    let target = Aabb::swept(&motions[1..]);
    bits = bits << 1 | u64::from(segment::misses(&motions[0], &target));
    let boxes = motions.map(|motion| MovingBox::from_motion(&motion));
    let [first, second] = [boxes[0].merged(&boxes[1]), boxes[2].merged(&boxes[3])];
    bits = bits << 1 | u64::from(first.is_apart_from(&second));
    digest.add(bits);
    let Aabb { lower, upper } = first.merged(&second).swept();
    digest.add_numbers(lower);
    digest.add_numbers(upper);
}

#[test]
fn boxes() {
    assert_eq!(
        digests(10_000, of_boxes, of_boxes),
        "e61ed86ec81b55a5 a1be679e8570001f d7cf3447c6499e7f 2cf9b7673a198e93"
    );
}

struct Near<'a>(&'a MovingBlock, &'a MovingBox<f32>, Mask);

impl Loop for Near<'_> {
    type Output = Mask;

    #[inline(always)]
    fn run(self, lanes: impl Compares) -> Mask {
        lanes.near(self.0, self.1, self.2)
    }
}

/// Compares the moving boxes of a pair's four points, in a block with empty lanes between, with each of them, on every
/// instruction set.
fn of_blocks<S: Format>(case: &PairCase<S>, _: &PrimitivePair<S>, digest: &mut Digest) {
    let mut block = MovingBlock::empty();
    let narrow = case.points.map(|ends| ends.map(|x| x.map(|x| x.to_f64() as f32)));
    let boxes = narrow.map(|[start, end]| MovingBox::from_motion(&(start, end).into()));
    for (lane, moving) in boxes.iter().enumerate() {
        block.set(5 * lane, moving);
    }
    for moving in &boxes {
        let near = block.near(moving, Mask::MAX);
        for among in [Mask::MAX, 1 << 10 | 1 << 5 | 1 << 2] {
            assert_eq!(block.near(moving, among), near & among, "one by one {case:?}");
            for (name, level) in available_levels() {
                let found = in_lanes(level, Near(&block, moving, among));
                assert_eq!(found, near & among, "{name} {case:?}");
            }
        }
        digest.add(near.into());
    }
    let merged = block.merged();
    for Aabb { lower, upper } in [merged.start, merged.end, block.get(5).start] {
        digest.add_numbers(lower);
        digest.add_numbers(upper);
    }
}

struct Within<'a>(&'a BoxBlock, &'a Aabb<f32>, f32, Mask);

impl Loop for Within<'_> {
    type Output = Mask;

    #[inline(always)]
    fn run(self, lanes: impl Compares) -> Mask {
        lanes.within(self.0, self.1, self.2, self.3)
    }
}

#[test]
fn boxes_within_a_distance_are_those_among_the_lanes_asked_about_on_every_instruction_set() {
    let at = |x: f32| Aabb {
        lower: [x, 0.5, -x],
        upper: [x + 0.25, 0.75, 1.0 - x],
    };
    // The steps are inexact, so gaps are rounded; some values are not finite.
    let places: [f32; LANES] = std::array::from_fn(|lane| if lane == 9 { f32::NAN } else { lane as f32 * 0.3 });
    let mut block = BoxBlock::empty();
    places.iter().enumerate().for_each(|(lane, &x)| block.set(lane, &at(x)));
    let gap = places[7] - (places[3] + 0.25);
    for (own, distance) in [
        (3, gap),
        (3, gap.next_down()),
        (0, 2.0),
        (7, 0.0),
        (7, f32::NEG_INFINITY),
        (9, 2.0),
        (2, f32::NAN),
    ] {
        let own = at(places[own]);
        for among in [Mask::MAX, 0, 0xA5C3] {
            let is_one = |&lane: &usize| among >> lane & 1 == 1 && at(places[lane]).is_within(&own, distance);
            let expected = (0..LANES).filter(is_one).fold(0, |mask, lane| mask | 1 << lane);
            assert_eq!(
                block.within(&own, distance, among),
                expected,
                "one by one, {own:?} {distance}"
            );
            for (name, level) in available_levels() {
                let found = in_lanes(level, Within(&block, &own, distance, among));
                assert_eq!(found, expected, "{name}, {own:?} {distance} among {among:x}");
            }
        }
    }
    let is_told = |distance| block.within(&at(places[3]), distance, 1 << 7) != 0;
    assert!(is_told(gap) && !is_told(gap.next_down()));
}

struct Equal<'a, const M: usize, const N: usize>(&'a [[u32; LANES]; M], &'a [u32; N], Mask);

impl<const M: usize, const N: usize> Loop for Equal<'_, M, N> {
    type Output = Mask;

    #[inline(always)]
    fn run(self, lanes: impl Compares) -> Mask {
        lanes.equal(self.0, self.1, self.2)
    }
}

/// Checks that exactly the selected lanes with one of these numbers are reported.
fn equal_are_told<const M: usize, const N: usize>(rows: &[[u32; LANES]; M], wanted: &[u32; N]) {
    for among in [Mask::MAX, 0, 0xA5C3] {
        let has_one = |lane: usize| rows.iter().any(|row| wanted.contains(&row[lane]));
        let is_one = |&lane: &usize| among >> lane & 1 == 1 && has_one(lane);
        let expected = (0..LANES).filter(is_one).fold(0, |mask, lane| mask | 1 << lane);
        for (name, level) in available_levels() {
            let found = in_lanes(level, Equal(rows, wanted, among));
            assert_eq!(found, expected, "{name}: {wanted:?} among {among:#06x}");
        }
    }
}

#[test]
fn equal_numbers_are_those_among_the_lanes_asked_about_on_every_instruction_set() {
    let numbers = std::array::from_fn(|lane| [7, u32::MAX, 0, 7, 1 << 31][lane % 5]);
    let others = std::array::from_fn(|lane| [8, 7, 9][lane % 3]);
    for number in [7, u32::MAX, 0, 1 << 31, 8] {
        equal_are_told(&[numbers], &[number]);
        equal_are_told(&[numbers, others], &[number]);
        equal_are_told(&[numbers, others], &[number, 9, 10]);
        equal_are_told(&[numbers, others, numbers], &[11, number]);
    }
    equal_are_told(&[numbers], &[]);
}

#[test]
fn blocks_of_moving_boxes() {
    assert_eq!(
        digests(4000, of_blocks, of_blocks),
        "8a86cf97b9eb16de 3423ce3eeadc7b75 ff0fde85066139bb 0d138a6175dfcf34"
    );
}

fn of_signs<S: Format>(case: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    let volume = MovingTetrahedron::from(pair);
    let signs = control_value_signs(pair);
    let mut bits = signs.map_or(0, |signs| {
        signs
            .iter()
            .fold(0, |bits, &sign| bits * 4 + u64::from((sign as i8 + 2).unsigned_abs()))
    });
    let known = certain_signs(&volume.control_values(), volume.error_bounds());
    for sign in known {
        let sign = sign.map_or(0, |sign| (sign as i8 + 2).unsigned_abs());
        bits = bits << 2 | u64::from(sign);
    }
    for known in [UNKNOWN, known] {
        bits = bits << 1 | u64::from(is_never_coplanar(pair, known));
    }
    let within = is_never_within(pair, separation_of(case), UNKNOWN);
    digest.add(bits << 1 | u64::from(within));
}

#[test]
fn exact_signs() {
    assert_eq!(
        digests(10_000, of_signs, of_signs),
        "e6237934e9213cec 2223f37cef4297c6 b1039403865db81a de66eea94085a974"
    );
}

fn of_times<S: Format>(case: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    let separated = Limits::within(separation_of(case));
    let tight = Limits::accurate_to(S::ZERO);
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
    for near in [S::ZERO, early, S::ONE, never, S::ONE + S::ONE, S::NAN] {
        match certain_contact(pair, near) {
            None => digest.add(0),
            Some(times) => digest.add_numbers(times),
        }
    }
}

#[test]
fn times_of_impact() {
    assert_eq!(
        digests(8000, of_times, of_times),
        "97734b4a54e7e8a1 61818e095d45a0ea fa63c42d1910f945 d50a994c1c9aed02"
    );
}

fn of_geometries<S: Format>(_: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    let in_double = |point: S::Vector| DVec3::from(point.into().map(S::to_f64));
    let motions = pair
        .motions
        .map(|motion| Motion::new(in_double(motion.start), in_double(motion.end)));
    for time in [0.0, 0.7] {
        let pair = PrimitivePair::new(pair.kind, motions);
        let found = geometry(&pair, time);
        digest.add_numbers(found.weights);
        found.points.iter().for_each(|point| digest.add_numbers(point.to_array()));
        digest.add_numbers(found.normal.unwrap_or(DVec3::ZERO).to_array());
        digest.add_numbers(found.distance);
        digest.add_numbers([found.separated_at, found.speed]);
    }
}

#[test]
fn geometries_of_contacts() {
    assert_eq!(
        digests(4000, of_geometries, of_geometries),
        "143ff9a66d5e345c 8f4bd3492855d5b0 29aa30f54c6d4ebe 79d07806ff3157de"
    );
}

fn of_contacts<S: Format>(_: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    let (contact, _) = contact_and_evidence(pair);
    digest.add(contact as u64);
    assert_eq!(touches(pair).map_or(2, u64::from), contact as u64);
}

#[test]
fn exact_verdicts() {
    assert_eq!(
        digests(4000, of_contacts, of_contacts),
        "9d360c981d5f11e5 a3f72a5071f48904 9b0db8bf0f7e3d04 a35e7d197ced4984"
    );
}

fn of_evidence<S: Format>(_: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    digest.add(contact_and_evidence(pair).1 as u64);
}

#[test]
fn evidence_of_verdicts() {
    assert_eq!(
        digests(4000, of_evidence, of_evidence),
        "3e97f289cae75985 04755c2db41eb887 3f6c9689874f79e6 5046e7bde5a88c04"
    );
}

/// Bisects until no number lies between. Returns `None` if both ends have the same result.
fn threshold<S: Format>(mut low: S, mut high: S, holds: impl Fn(S) -> bool) -> Option<S> {
    let at_low = holds(low);
    if at_low == holds(high) {
        return None;
    }
    for _ in 0..80 {
        let middle = S::HALF * (low + high);
        if holds(middle) == at_low {
            low = middle;
        } else {
            high = middle;
        }
    }
    Some(high)
}

fn answers_yes<S: Format>(test: usize, pair: &PrimitivePair<S>, separation: S) -> bool {
    let limits = Limits {
        tolerance: S::ZERO,
        separation,
    };
    if let Some(&tier) = Tier::ALL.get(test) {
        let filter = Filter::new(tier).with_separation(separation);
        return filter.expect("positive").verdict(pair).is_culled();
    }
    match test - Tier::ALL.len() {
        0 => certain_contact(pair, S::HALF).is_some(),
        1 => time_of_impact_within(pair, &limits, S::ZERO, S::HALF) == Impact::Never,
        _ => time_of_impact_and_work(pair, &limits).0 == Impact::Never,
    }
}

/// The places where results change: how far the first point must move, and which separation is too large. On a grid, values are
/// exactly equal to their bounds there.
fn of_thresholds<S: Format>(case: &PairCase<S>, pair: &PrimitivePair<S>, digest: &mut Digest) {
    for test in 0..Tier::ALL.len() + 3 {
        let (zero, far) = (S::ZERO, S::from_f64(8.0));
        let separation = threshold(zero, far, |separation| answers_yes(test, pair, separation));
        let moved = threshold(zero, far, |by| {
            let mut case = *case;
            for end in &mut case.points[0] {
                end[0] = end[0] + by;
            }
            answers_yes(test, &case.pair(), zero)
        });
        for found in [separation, moved] {
            digest.add_number(found.unwrap_or(-far));
        }
    }
}

#[test]
fn thresholds() {
    assert_eq!(
        digests(200, of_thresholds, of_thresholds),
        "881243668af5b225 f30915e52090cf97 adc81e539e5f1f0f 14adf3ea615d90cc"
    );
}
