//! The certified non-coplanarity filter never culls four points that are coplanar at some time of the step, in any arrangement.
//! Each constant of its bound is needed. `tiers_keep_their_promises` compares it with the oracle.

use proptest::prelude::*;
use selvedge_core::PairKind;
use selvedge_verification::altered::{Factors, Kernel};
use selvedge_verification::culling::CullingTest::CertifiedNonCoplanarity;
use selvedge_verification::culling::verdict;
use selvedge_verification::formats;
use selvedge_verification::generator::{Format, Moment, PairCase, check, coplanar_pairs, pairs_of_any_kind};
use selvedge_verification::oracle::collides;
use selvedge_verification::plain;

fn culls<S: Format>(pair: &PairCase<S>) -> bool {
    verdict(CertifiedNonCoplanarity, pair).is_culled()
}

const ORDERS: [[usize; 4]; 24] = {
    let mut orders = [[0; 4]; 24];
    let mut count = 0;
    let mut code = 0;
    while code < 256 {
        let order = [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6];
        if 1 << order[0] | 1 << order[1] | 1 << order[2] | 1 << order[3] == 0b1111 {
            orders[count] = order;
            count += 1;
        }
        code += 1;
    }
    orders
};

/// Each point may be the base of the volume, and each axis may come first: every arrangement rounds differently.
fn never_culls_a_coplanar_pair_in_any_arrangement<S: Format>(moment: &Moment<S>) -> Result<(), TestCaseError> {
    let pair = moment.pair();
    for order in ORDERS {
        let arranged = pair.reordered(order);
        for axes in [[0, 1, 2], [1, 2, 0], [2, 0, 1]] {
            let arranged = arranged.with_axes(axes);
            prop_assert!(!culls(&arranged), "{arranged:?}");
        }
    }
    Ok(())
}

formats!(never_culls_a_coplanar_pair_in_any_arrangement(20_000, coplanar_pairs()));

/// If a computed control value is above its bound, the exact one is at least about one unit roundoff of f32 times its permanent.
/// This is far above the bound of f64. (To nearest, at most 7 of the 16 in the bound are needed, and at most 9 of the 20.)
#[test]
fn what_the_f32_filter_culls_the_f64_filter_culls_too() {
    check(300_000, pairs_of_any_kind::<f32>(), |pair| {
        prop_assert!(!culls(pair) || culls(&pair.widened()));
        Ok(())
    });
}

/// The kernel behind [`culls`], with other constants.
fn culls_with<F: Factors, S: Format>(pair: &PairCase<S>) -> bool {
    Kernel::NonCoplanarity.culls::<F, S>(pair)
}

struct Unchanged;
impl Factors for Unchanged {}

struct NoUnderflowTerm;
impl Factors for NoUnderflowTerm {
    const UNDERFLOW: f64 = 0.0;
}

struct ASixteenth;
impl Factors for ASixteenth {
    const UNIT_ROUNDOFF: f64 = 1.0 / 16.0;
}

#[test]
fn other_constants_are_put_into_the_filter_itself() {
    check(10_000, pairs_of_any_kind::<f64>(), |pair| {
        prop_assert_eq!(culls_with::<Unchanged, _>(pair), culls(pair));
        Ok(())
    });
}

/// Two edges of about 1e-107, whose volume of 1e-321 is lost in underflow. Found by search, then shortened.
const TINY_AND_TOUCHING: PairCase<f64> = PairCase::new(
    PairKind::EdgeEdge,
    [
        [
            [
                1.788_343_132_803_423_3e-107,
                -1.532_865_542_402_934_3e-107,
                6.812_735_744_013_041e-108,
            ],
            [1.0, 0.0, 0.0],
        ],
        [[0.0, 5.961_143_776_011_411e-108, 0.0], [0.0, 0.0, 0.0]],
        [
            [
                4.257_959_840_008_151e-108,
                1.703_183_936_003_260_3e-108,
                3.406_367_872_006_520_6e-108,
            ],
            [0.0, 0.0, 1.0],
        ],
        [
            [
                6.812_735_744_013_041e-108,
                -2.554_775_904_004_890_4e-108,
                1.703_183_936_003_260_3e-108,
            ],
            [0.0, -1.0, 0.0],
        ],
    ],
);

#[test]
fn without_the_underflow_term_a_tiny_touching_pair_would_be_culled_f64() {
    assert!(collides(&TINY_AND_TOUCHING.question()).is_some());
    assert!(culls_with::<NoUnderflowTerm, _>(&TINY_AND_TOUCHING));
    assert!(!culls(&TINY_AND_TOUCHING));
}

#[test]
fn without_the_underflow_term_a_tiny_touching_pair_would_be_culled_f32() {
    let resting = |position: [f32; 3]| [position; 2];
    let pair = PairCase::<f32>::new(
        PairKind::VertexFace,
        [
            resting([-5.355_958_7e-16, 7.723_856_3e-16, -5.000_340_4e-16]),
            resting([-1.994_932e-16, -3.001_071_6e-16, -1.091_141_1e-15]),
            resting([-1.616_762_3e-15, 1.288_899_5e-15, -6.938_894e-18]),
            resting([-1.752_070_7e-16, 6.002_143e-16, -6.643_991e-16]),
        ],
    );
    assert!(collides(&pair.question()).is_some());
    assert!(culls_with::<NoUnderflowTerm, _>(&pair));
    assert!(!culls(&pair));
}

/// A vertex that starts inside the face. Found by search, then shortened.
const INSIDE_AT_THE_START: PairCase<f64> = PairCase::new(
    PairKind::VertexFace,
    [
        [
            [0.901_926_164_773_954, -0.246_246_277_764_612_4, 0.353_010_188_642_770_1],
            [1.0, 0.0, 0.0],
        ],
        [
            [-1.829_223_818_289_165_1, -0.399_710_054_950_901_4, -0.749_800_507_244_799_5],
            [0.0, 0.0, 0.0],
        ],
        [
            [0.785_839_694_590_095, -1.396_080_322_007_264_8, 1.178_072_273_859_925_2],
            [0.0, 0.0, 1.0],
        ],
        [
            [1.018_012_634_957_813_1, 0.903_587_766_478_040_1, -0.472_051_896_574_384_95],
            [0.0, 1.0, 0.0],
        ],
    ],
);

#[test]
fn with_a_sixteenth_of_the_rounding_bound_a_touching_pair_would_be_culled() {
    assert!(collides(&INSIDE_AT_THE_START.question()).is_some());
    assert!(culls_with::<ASixteenth, _>(&INSIDE_AT_THE_START));
    assert!(!culls(&INSIDE_AT_THE_START));
}

#[test]
fn the_plain_filter_culls_a_vertex_that_starts_on_a_corner_of_the_face_f32() {
    let pair = PairCase::<f32>::new(
        PairKind::VertexFace,
        [
            [[0.0, 0.0, 0.0], [0.0, 0.0, 0.0]],
            [[1.0, -1.0, 1.615_234_4], [0.0, 0.0, 1.0]],
            [[0.0, 0.000_383_011_1, 0.0], [0.0, 1.0, 0.0]],
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]],
        ],
    );
    assert_eq!(pair.points[0][0], pair.points[3][0]);
    assert!(plain::culls(&pair));
    assert!(!culls(&pair));
}

#[test]
fn the_plain_filter_culls_a_colliding_pair_that_certified_keeps_f64() {
    let pair = PairCase::<f64>::new(
        PairKind::VertexFace,
        [
            [
                [0.0, 0.0, 0.0],
                [0.815_510_629_087_612, 0.619_723_023_008_248_2, -0.539_244_362_733_370_5],
            ],
            [
                [0.0, -1.0, 0.0],
                [1.897_718_366_896_242_5, -1.878_857_091_290_456, 1.772_956_876_306_58],
            ],
            [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0]],
            [
                [1.0, 0.0, 0.0],
                [0.454_774_716_484_735_1, 1.452_583_061_107_816_3, -1.309_978_109_080_020_7],
            ],
        ],
    );
    assert!(collides(&pair.question()).is_some());
    assert!(plain::culls(&pair));
    assert!(!culls(&pair));
}
