//! A program without std that calls every culling test of `selvedge-core`, exact signs, distribution and the elementary test, for
//! both number formats. `check.sh` links it into a C program and searches for the machinery of panics.
//!
//! It would not compile if a dependency used std, which has a panic handler of its own.
#![no_std]

use core::cmp::Ordering;
use core::panic::PanicInfo;
use selvedge_core::PairKind;
use selvedge_core::batch::{
    self, BatchTest, Level, Mask, Round, RoundQuestion, Test, Tile, VertexRow, advance_from_rows, closest_points,
    largest_strays_from_rows,
};
use selvedge_core::boxes::block::BoxBlock;
use selvedge_core::boxes::mapping::{Inset, Mapping};
use selvedge_core::boxes::moving::{MovingBlock, MovingBox};
use selvedge_core::boxes::{Aabb, relative, segment, swept_boxes};
use selvedge_core::distribution::distribute;
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::glam::DVec3;
use selvedge_core::kernels::coplanarity::MovingTetrahedron;
use selvedge_core::kernels::exact;
use selvedge_core::separation::clearance::{Clearance, are_boxes_within, nearness};
use selvedge_core::separation::closest::ClosestPoints;
use selvedge_core::separation::gap::{GapError, SeparatingDirection, distance_from_below};
use selvedge_core::separation::geometry::geometry;
use selvedge_core::separation::{course, largest_coordinate};
use selvedge_core::{FeatureTriangle, Motion, PrimitivePair, Scalar, Verdict, elementary, filter};

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}

/// The positions of four points at the start and at the end of the step.
type Points<S> = [[[S; 3]; 2]; 4];

/// Returns 0 if every tier keeps the pair, 1 if every tier culls it, and 2 if they disagree. Each runs with a separation and
/// without, on its own and batched in every form.
fn tiers<S: Scalar>(pair: &PrimitivePair<S>) -> u32 {
    let mut masks = [0];
    let mut answers = 0;
    for tier in Tier::ALL {
        let filter = Filter::<S>::new(tier);
        let separated = filter.with_separation(S::from_f64(0.125)).unwrap_or(filter);
        for filter in [filter, separated] {
            answers |= 1 << u32::from(filter.verdict(pair).is_culled());
            for mask in in_every_form(filter, pair, &mut masks) {
                answers |= 1 << mask;
            }
        }
    }
    match answers {
        0b01 => 0,
        0b10 => 1,
        _ => 2,
    }
}

/// Returns one pair's mask as a list, a tile and rows.
fn in_every_form<S: Scalar>(test: impl BatchTest<S>, pair: &PrimitivePair<S>, masks: &mut [Mask; 1]) -> [Mask; 3] {
    let (level, kind): (Level, PairKind) = (Level::baseline(), pair.kind);
    let mut tile = Tile::unknown();
    tile.set(0, pair.motions);
    let rows = pair.motions.map(VertexRow::new);
    let mut answers = [0; 3];
    batch::culled(level, test, core::slice::from_ref(pair), masks);
    answers[0] = masks[0];
    batch::culled_from_tiles(level, kind, test, &[tile], masks);
    answers[1] = masks[0];
    batch::culled_from_rows(level, kind, test, &rows, &[[0, 1, 2, 3]], masks);
    answers[2] = masks[0];
    answers
}

fn bit(index: u32, verdict: Verdict) -> u32 {
    u32::from(verdict.is_culled()) << index
}

/// Returns the results of the batched tests, each at the bit of its one-pair twin, on the baseline instruction set.
fn batched<S: Scalar>(pair: &PrimitivePair<S>) -> u32 {
    fn at<S: Scalar>(index: u32, test: impl BatchTest<S>, pair: &PrimitivePair<S>) -> u32 {
        let mut mask = [0];
        batch::culled(Level::baseline(), test, core::slice::from_ref(pair), &mut mask);
        u32::from(mask[0]) << index
    }
    at(0, Test::SweptBoxes, pair) | at(1, Test::RelativeBoxes, pair) | at(4, Filter::new(Tier::Permanent), pair)
}

/// Returns three bits from exact signs: one sign for all, more than half a unit apart, all positive.
fn exactly<S: Scalar>(pair: &PrimitivePair<S>) -> u32 {
    let tetrahedron = MovingTetrahedron::from(pair);
    let known = exact::certain_signs(&tetrahedron.control_values(), tetrahedron.error_bounds());
    let half = S::from_f64(0.5);
    let signs = exact::control_value_signs(pair);
    u32::from(exact::is_never_coplanar(pair, known))
        | u32::from(exact::is_never_within(pair, half, exact::UNKNOWN)) << 1
        | u32::from(signs == Some([Ordering::Greater; 4])) << 2
}

fn verdicts<S: Scalar>(pair: &PrimitivePair<S>) -> u32 {
    bit(0, swept_boxes(pair)) | bit(1, relative::three_axes(pair)) | bit(4, filter::certified::non_coplanarity(pair))
}

/// Returns these results, whether the batched ones differ, and the exact ones.
fn with_batches<S: Scalar>(pair: &PrimitivePair<S>) -> u32 {
    let verdicts = verdicts(pair);
    let differ = (verdicts & 0b1_0011) != batched(pair);
    verdicts | u32::from(differ) << 9 | exactly(pair) << 10 | tiers(pair) << 13
}

/// Returns the time from which contact is not excluded, by a round in lanes, then for the pair alone.
fn advanced<S: Scalar>(pair: &PrimitivePair<S>) -> Option<S> {
    let rows = pair.motions.map(VertexRow::new);
    let question = RoundQuestion {
        limits: elementary::Limits::default(),
        until: S::ONE,
        with_volume: true,
    };
    let (mut times, mut rounds) = ([S::ZERO], [Round::default()]);
    let (level, kind) = (Level::baseline(), pair.kind);
    let indices = [[0, 1, 2, 3]];
    advance_from_rows(level, kind, &question, &rows, &indices, &mut times, &mut rounds);
    let from = times[0];
    if rounds[0].apart != 0 {
        return None;
    }
    elementary::advance::time_of_impact_within(pair, &question.limits, from, S::ONE).time()
}

/// Returns one bit if the exact verdict is that there is no contact. Another bit shows that whole numbers alone, the certified
/// time of impact, or its confirmation disagree.
fn elementary_tests<S: Scalar>(pair: &PrimitivePair<S>) -> u32 {
    use elementary::{ContactVerdict, Limits, advance, contact};
    let touches = contact(pair) == ContactVerdict::Happens;
    let limits = Limits::default();
    let time = advance::time_of_impact(pair, &limits).time();
    let confirmed = time.and_then(|time| advance::certain_contact(pair, time));
    let agree = time.is_some() == touches
        && advanced(pair).is_some() == touches
        && exact::touches(pair) == Some(touches)
        && confirmed.is_some() == touches;
    u32::from(!touches) << 8 | u32::from(!agree) << 10
}

/// Returns one bit for each test that culls, and another if the elementary test finds no contact.
fn all_tests<S: Scalar>(points: &Points<S>) -> [u32; 2] {
    let motions = points.map(|[start, end]| Motion::<S> {
        start: start.into(),
        end: end.into(),
    });
    let [a, b, c, d] = motions;
    let vertex_face = PrimitivePair::vertex_face(a, [b, c, d]);
    let edge_edge = PrimitivePair::edge_edge([a, b], [c, d]);
    let apart = |overlap: bool| u32::from(!overlap) << 5;
    [
        with_batches(&vertex_face)
            | apart(Aabb::swept(&[a]).overlaps(&Aabb::swept(&[b, c, d])))
            | bit(7, segment::primitive_boxes(&vertex_face))
            | elementary_tests(&vertex_face),
        with_batches(&edge_edge) | apart(Aabb::swept(&[a, b]).overlaps(&Aabb::swept(&[c, d]))) | elementary_tests(&edge_edge),
    ]
}

/// Returns the results of all tests: vertex–face in the low half, edge–edge in the high one.
#[unsafe(no_mangle)]
pub extern "C" fn verdicts_f64(points: &Points<f64>) -> u32 {
    let [vertex_face, edge_edge] = all_tests(points);
    vertex_face | edge_edge << 16
}

/// Returns the results of [`verdicts_f64`] in single precision.
#[unsafe(no_mangle)]
pub extern "C" fn verdicts_f32(points: &Points<f32>) -> u32 {
    let [vertex_face, edge_edge] = all_tests(points);
    vertex_face | edge_edge << 16
}

/// Returns the height at which a vertex and a face meet in the middle of the step, if the normal points upwards; NaN otherwise.
#[unsafe(no_mangle)]
pub extern "C" fn height(points: &Points<f64>) -> f64 {
    let motions = points.map(|[start, end]| Motion::new(start.into(), end.into()));
    let [vertex, face @ ..] = motions;
    let found = geometry(&PrimitivePair::vertex_face(vertex, face), 0.5);
    match found.normal {
        Some(normal) if normal.z > 0.99 && found.distance[0] <= found.distance[1] => found.points[0].z,
        _ => f64::NAN,
    }
}

/// Returns the lanes near the first point, for a block with the first point in lane 3 and the box of the other three in lane 5.
#[unsafe(no_mangle)]
pub extern "C" fn near(points: &Points<f32>) -> u32 {
    let [a, b, c, d] = points.map(|[start, end]| MovingBox::<f32>::from_motion(&Motion::new(start.into(), end.into())));
    let mut block = MovingBlock::empty();
    block.set(3, &a);
    block.set(5, &b.merged(&c).merged(&d));
    if block.merged() != a.merged(&block.get(5)) {
        return u32::MAX;
    }
    let mut at_start = BoxBlock::empty();
    at_start.set(3, &a.start);
    at_start.set(5, &block.get(5).start);
    let near = block.near(&a, Mask::MAX);
    // A box is at distance zero from itself, and no box is farther away than the largest number.
    if at_start.within(&a.start, 0.0, 1 << 3) == 0 || at_start.within(&a.start, f32::MAX, near) != near {
        return u32::MAX - 1;
    }
    near.into()
}

/// Returns one bit for each certificate that a vertex and a face keep half a unit. These are boxes with that separation and a
/// smaller one, a lower bound of the distance at the start, a direction, and a clearance. Two more bits say that the vertex's
/// course has room, and that its boxes come within one unit of the face's.
#[unsafe(no_mangle)]
pub extern "C" fn separations(points: &Points<f64>) -> u32 {
    let ends = [
        points.map(|[start, _]| DVec3::from(start)),
        points.map(|[_, end]| DVec3::from(end)),
    ];
    let [start, end] = ends;
    let largest = largest_coordinate(&start).max(largest_coordinate(&end));
    let (kind, error) = (PairKind::VertexFace, GapError::from_largest_coordinate(largest));
    let mapping = Mapping::new(&Aabb::everything(), 0.5, 1.0, false);
    let [a, b, c, d] = points.map(|[start, end]| mapping.vertex(start, end));
    let face = b.merged(&c).merged(&d);
    let drawn_in = a.drawn_in(Inset::new(0.5, 0.25).for_bounds(&a));
    let mut closest = [ClosestPoints::default()];
    closest_points(Level::baseline(), kind, &[start], &mut closest);
    let bound = distance_from_below(kind, start, closest[0].direction, error);
    let known = SeparatingDirection::NONE.or_better(kind, DVec3::Z, start, error);
    let found = SeparatingDirection::for_step(kind, DVec3::Z, ends, 0.5, error);
    let in_single = ends.map(|points| points.map(|point| point.as_vec3a()));
    let clearance = Clearance::new(0.25, largest, 0.0);
    let rows = points.map(|[start, end]| VertexRow::new(Motion::new(DVec3::from(start).as_vec3(), DVec3::from(end).as_vec3())));
    let mut strays = [0.0];
    largest_strays_from_rows(
        Level::baseline(),
        kind,
        &[clearance],
        &rows,
        &[[0, 1, 2, 3]],
        &[0],
        &mut strays,
    );
    let near = nearness(1.0, largest);
    let drift = end[0] - start[0];
    let room = course::room(0.125, 0.0);
    let time = course::time_after(0.5, 0.5, 1.0).unwrap_or(2.0);
    let expected = course::expected(course::joined(start[0], drift, 0.0), drift, time);
    let is_kept = clearance.largest_stray(kind, in_single[0], in_single[1]) >= 0.125 && strays[0] >= 0.125;
    u32::from(a.is_apart_from(&face) && drawn_in.is_apart_from(&face))
        | u32::from(bound > 0.5) << 1
        | u32::from(found.is_some_and(|found| found.gap() > 0.5)) << 2
        | u32::from(known.lasts(kind, end, 0.5, error).is_some()) << 3
        | u32::from(is_kept && clearance.certain_gap(0.125, largest) < 1.0) << 4
        | u32::from(course::is_certain(room, largest) && course::has_room(end[0], expected, room)) << 5
        | u32::from(are_boxes_within(kind, in_single[0], near)) << 6
}

/// Returns the number of primitive pairs of two triangles, each of which represents as many vertices and edges as `vertices` and
/// `edges` say.
#[unsafe(no_mangle)]
pub extern "C" fn distributed(corners: &[[u32; 3]; 2], vertices: u8, edges: u8) -> usize {
    use selvedge_core::{FeatureEdge, Features};
    let features = Features::new(vertices, edges).unwrap_or(Features::NONE);
    let [a, b] = corners.map(|[a, b, c]| FeatureTriangle {
        face: a,
        vertices: [a, b, c],
        edges: [[a, b], [b, c], [c, a]].map(|ends| FeatureEdge { edge: ends[0], ends }),
        features,
    });
    let pairs = distribute(&a, &b);
    pairs.vertex_face.len() + pairs.edge_edge.len()
}
