//! Bounds on which a caller relies for several steps are never overstated. They are the gap along a direction, the distance that
//! a pair keeps although its points stray, their stray, and how wide neighbours are open. This holds in every floating-point
//! environment.

use crate::support::bounds::{largest_accepted, largest_of_all};
use crate::support::prelude::*;
use crate::support::{dot, minus, point};
use selvedge_core::separation::clearance::Clearance;
use selvedge_core::separation::course;
use selvedge_core::separation::gap::{GapError, SeparatingDirection, distance_from_below};
use selvedge_core::separation::hinge::is_wide_open;

/// A pair, and some decisions as well.
#[derive(Clone, Debug)]
struct Question<S: Format> {
    pair: PairCase<S>,
    choice: u32,
}

impl<S: Format> Simplify for Question<S> {
    fn attempts(&self) -> usize {
        self.pair.attempts()
    }

    fn simpler(&self, attempt: usize) -> Option<Self> {
        let pair = self.pair.simpler(attempt)?;
        Some(Self { pair, ..self.clone() })
    }
}

fn questions<S: Format>() -> impl Strategy<Value = Question<S>> + Clone {
    from_choices(|choices: &mut Choices<'_>| {
        let kind = choices.pick(&PairKind::ALL);
        Question {
            choice: choices.word() as u32,
            pair: PairCase::choose(kind, choices),
        }
    })
}

/// Returns the four points at the start and at the end.
fn ends<S: Format>(pair: &PairCase<S>) -> [[S::Vector; 4]; 2] {
    let motions = pair.motions();
    [motions.map(|motion| motion.start), motions.map(|motion| motion.end)]
}

fn error_of<S: Format>(pair: &PairCase<S>) -> GapError<S> {
    GapError::from_largest_coordinate(largest_coordinate(&ends(pair).concat()))
}

/// Returns directions between points of the two sets, their normals, and the axes, of length one or a little more.
fn directions<S: Format>(pair: &PairCase<S>) -> Vec<S::Vector> {
    let question = pair.question();
    let middle: [[f64; 3]; 4] =
        [0, 1, 2, 3].map(|k| [0, 1, 2].map(|axis| 0.5 * question.start[k][axis] + 0.5 * question.end[k][axis]));
    let mut directions = vec![DVec3::X, DVec3::Y, DVec3::Z];
    let first = points_of_first(pair.kind);
    for points in [question.start, middle, question.end] {
        let points = points.map(DVec3::from);
        let [a, b, c, d] = points;
        directions.push(match pair.kind {
            PairKind::VertexFace => (c - b).cross(d - b),
            PairKind::EdgeEdge => (b - a).cross(d - c),
        });
        directions.extend((0..first).flat_map(|i| (first..4).map(move |j| points[i] - points[j])));
        let mean = |points: &[DVec3]| points.iter().map(|&point| point / points.len() as f64).sum::<DVec3>();
        directions.push(mean(&points[..first]) - mean(&points[first..]));
    }
    let units = directions.into_iter().map(DVec3::normalize_or_zero);
    let lengths = [1.0, 1.0 + 0.5_f64.powi(21), 1.0 + 0.5_f64.powi(20)];
    let scaled = |unit: DVec3| lengths.into_iter().flat_map(move |length| [unit * length, unit * -length]);
    let in_format = |direction: DVec3| S::Vector::from(direction.to_array().map(S::from_f64));
    units.flat_map(scaled).map(in_format).collect()
}

/// Returns whether some direction proves the pair apart, in any form of the query.
fn is_kept_apart<S: Format>(pair: &PairCase<S>, directions: &[S::Vector], separation: S) -> bool {
    let (kind, error, [start, end]) = (pair.kind, error_of(pair), ends(pair));
    directions.iter().any(|&direction| {
        let found = SeparatingDirection::for_step(kind, direction, [start, end], separation, error);
        let at_start = SeparatingDirection::NONE.or_better(kind, direction, start, error);
        let lasts = at_start.lasts(kind, end, separation, error);
        found.is_some() || lasts.is_some()
    })
}

/// The clearance holds for any direction.
fn nothing_keeps_apart_what_touches<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = &moment.pair();
    let directions = directions(pair);
    for environment in Environment::all() {
        let is_kept = environment.run(pair, |pair| is_kept_apart(pair, &directions, S::ZERO));
        prop_assert!(!is_kept, "{environment:?}");
    }
    Ok(())
}

formats!(nothing_keeps_apart_what_touches(800, touching_pairs()));

fn a_pair_keeps_the_separation_that_a_direction_is_said_to_keep<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let directions = directions(pair);
    let kept = largest_of_all(pair, |pair| {
        largest_accepted(|separation| is_kept_apart(pair, &directions, separation))
    });
    if let Some(separation) = kept {
        prop_assert!(!within(&pair.question(), separation.to_f64()), "{separation}");
    }
    Ok(())
}

formats!(a_pair_keeps_the_separation_that_a_direction_is_said_to_keep(
    600,
    pairs_of_any_kind()
));

/// Returns whether the distance at an end of the step is certainly at least `bound`.
fn is_at_least(pair: &Pair, end: u32, bound: f64) -> bool {
    bound <= 0.0 || !within_at(pair, &Rational::from(end), bound.next_down())
}

fn a_bound_of_the_distance_is_not_above_it<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let directions = directions(pair);
    let (question, kind) = (pair.question(), pair.kind);
    let better = |a: S, b: S| if a < b { b } else { a };
    let at_start = largest_of_all(pair, |pair| {
        let (error, [start, _]) = (error_of(pair), ends(pair));
        let bounds = directions
            .iter()
            .map(|&direction| distance_from_below(kind, start, direction, error));
        bounds.reduce(better)
    });
    let bound = at_start.map_or(0.0, S::to_f64);
    prop_assert!(is_at_least(&question, 0, bound), "{bound}");
    // The stored values in `f32` come from one end, from both, and from the one before.
    let at_end = largest_of_all(pair, |pair| {
        let (error, [start, end]) = (error_of(pair), ends(pair));
        let stored = directions.iter().flat_map(|&direction| {
            let none = SeparatingDirection::NONE;
            let found = SeparatingDirection::for_step(kind, direction, [start, end], S::ZERO, error);
            let lasting = none.or_better(kind, direction, start, error).lasts(kind, end, S::ZERO, error);
            let at_end = none.or_better(kind, direction, end, error);
            [found, lasting, Some(at_end)].into_iter().flatten()
        });
        stored.map(|stored| stored.gap()).reduce(f32::max).map(f64::from)
    });
    let bound = at_end.unwrap_or(0.0);
    prop_assert!(is_at_least(&question, 1, bound), "stored: {bound}");
    Ok(())
}

formats!(a_bound_of_the_distance_is_not_above_it(600, pairs_of_any_kind()));

fn what_is_not_finite_is_never_kept_apart<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    let finite = pair.map(S::made_finite);
    let directions = directions(&finite);
    if pair.is_finite() {
        return Ok(());
    }
    for environment in Environment::all() {
        let is_kept = environment.run(pair, |pair| is_kept_apart(pair, &directions, S::ZERO));
        prop_assert!(!is_kept, "{environment:?}");
        let is_clear = environment.run(pair, |pair| is_clear(&in_double(pair), 0.0, 0.0));
        prop_assert!(!is_clear, "{environment:?}");
    }
    Ok(())
}

formats!(what_is_not_finite_is_never_kept_apart(800, extraordinary_pairs()));

#[test]
fn a_direction_that_is_longer_than_one_or_no_number_proves_nothing() {
    let points = [DVec3::Z, DVec3::ZERO, DVec3::X, DVec3::Y];
    let (kind, error) = (PairKind::VertexFace, GapError::from_largest_coordinate(1.0));
    for length in [1.000_01, 2.0, f64::INFINITY, f64::NAN] {
        let direction = DVec3::new(0.0, 0.0, length);
        assert_eq!(distance_from_below(kind, points, direction, error), 0.0);
        assert_eq!(SeparatingDirection::for_step(kind, direction, [points; 2], 0.0, error), None);
    }
    for separation in [1.0, f64::INFINITY, f64::NAN] {
        let found = SeparatingDirection::for_step(kind, DVec3::Z, [points; 2], separation, error);
        assert_eq!(found, None);
    }
}

fn in_double<S: Format>(pair: &PairCase<S>) -> PairCase<f64> {
    let points = pair.points.map(|ends| ends.map(|position| position.map(S::to_f64)));
    PairCase::new(pair.kind, points)
}

/// Returns whether the pair is claimed to keep `distance` although its points stray.
fn is_clear(pair: &PairCase<f64>, distance: f64, stray: f64) -> bool {
    largest_stray(pair, distance) >= stray as f32
}

/// Returns how far the points of a pair may stray, with its positions rounded to `f32` here.
fn largest_stray(pair: &PairCase<f64>, distance: f64) -> f32 {
    let [start, end] = ends(pair);
    let largest = largest_coordinate(&[start, end].concat());
    let [start, end] = [start, end].map(|points| points.map(|point| point.as_vec3a()));
    Clearance::new(distance, largest, 0.0).largest_stray(pair.kind, start, end)
}

/// Returns x + `by`, or the next number nearer to x if that is farther from it.
fn strayed(x: f64, by: f64) -> f64 {
    let (from, to) = (x, x + by);
    let way = rational(to) - rational(from);
    if way.abs() <= rational(by).abs() {
        to
    } else if to > from {
        to.next_down()
    } else {
        to.next_up()
    }
}

/// Its points stray towards each other as far as they may.
fn a_clear_pair_keeps_its_distance<S: Format>(question: &Question<S>) -> TestCaseResult {
    let pair = in_double(&question.pair);
    let largest = largest_coordinate(&ends(&pair).concat());
    let share = [0.0, 1.0, 0.25, 0.5_f64.powi(10), 0.5_f64.powi(20)][question.choice as usize % 5];
    let stray = largest.min(1e9) * share;
    let kept = largest_of_all(&pair, |pair| largest_accepted(|distance| is_clear(pair, distance, stray)));
    let Some(distance) = kept else { return Ok(()) };
    keeps_it_though_strayed(&pair, distance, stray)
}

formats!(a_clear_pair_keeps_its_distance(400, questions()));

/// The points stray as far as the clearance allows.
fn a_pair_keeps_its_distance_though_its_points_stray_as_far_as_they_may<S: Format>(question: &Question<S>) -> TestCaseResult {
    let pair = in_double(&question.pair);
    let Some(kept) = largest_of_all(&pair, |pair| largest_accepted(|distance| is_clear(pair, distance, 0.0))) else {
        return Ok(());
    };
    let distance = kept * [0.0, 1.0, 0.5, 0.999, 0.5_f64.powi(10)][question.choice as usize % 5];
    let stray = f64::from(largest_stray(&pair, distance));
    if stray < 0.0 {
        return Ok(());
    }
    keeps_it_though_strayed(&pair, distance, stray)
}

formats!(a_pair_keeps_its_distance_though_its_points_stray_as_far_as_they_may(
    400,
    questions()
));

fn keeps_it_though_strayed(pair: &PairCase<f64>, distance: f64, stray: f64) -> TestCaseResult {
    let first = points_of_first(pair.kind);
    for signs in 0..8_u32 {
        let sign = |axis: usize| if signs >> axis & 1 == 0 { 1.0 } else { -1.0 };
        let mut towards = *pair;
        for (k, ends) in towards.points.iter_mut().enumerate() {
            let of_set = if k < first { 0.5 } else { -0.5 };
            for position in ends {
                *position = [0, 1, 2].map(|axis| strayed(position[axis], sign(axis) * of_set * stray));
            }
        }
        prop_assert!(!within(&towards.question(), distance), "{distance} with {stray}, {signs:b}");
        if stray == 0.0 {
            break;
        }
    }
    Ok(())
}

/// A course, and a point that is claimed to be within its room of it.
#[derive(Clone, Copy, Debug)]
struct Course<S: Format> {
    origin: S::Vector,
    end: S::Vector,
    span: S,
    time: S,
    stray: S,
    spare: S,
    position: S::Vector,
}

/// Makes a course on the path of the first point of a pair for some steps, then perhaps on that of the second.
fn course_of<S: Format>(question: &Question<S>) -> Option<Course<S>> {
    let [first, second, ..] = question.pair.motions();
    let choice = |bits: u32, count: u32| question.choice >> bits & (count - 1);
    let h = S::from_f64([1.0, 0.1, 1.0 / 60.0, 0.001][choice(0, 4) as usize]);
    let steps = choice(2, 8) + 1;
    let span = h * S::from_f64(f64::from(steps));
    let mut elapsed = S::ZERO;
    for _ in 0..choice(5, 8) % steps {
        elapsed = elapsed + h;
    }
    let drift = |from: S::Vector, to: S::Vector| {
        let (from, to): ([S; 3], [S; 3]) = (from.into(), to.into());
        S::Vector::from([0, 1, 2].map(|axis| (to[axis] - from[axis]) / h))
    };
    let (origin, end, drift) = if choice(8, 2) == 0 {
        let drift = drift(first.start, first.end);
        (first.start, course::expected(first.start, drift, span), drift)
    } else {
        let drift = drift(second.start, second.end);
        let origin = course::joined(second.start, drift, elapsed);
        (origin, course::expected(second.start, drift, span - elapsed), drift)
    };
    let largest = largest_coordinate(&[origin, end]);
    let part = S::from_f64([0.0, 1.0, 100.0, -1.0, -1.7][choice(9, 8) as usize % 5]);
    let is_certain = |stray: S| course::is_certain(course::room(stray, part * stray), largest);
    // This is the least certain distance.
    let powers = S::MIN_EXPONENT / 2..S::MAX_EXPONENT / 2;
    let stray = powers.map(|power| S::exact(1, power)).find(|&stray| is_certain(stray))?;
    let spare = part * stray;
    let room = course::room(stray, spare);
    let time = course::time_after(elapsed, h, span)?;
    let expected = course::expected(origin, drift, time);
    let middle: [S; 3] = expected.into();
    let mut position = middle.map(|x| x + room);
    for (axis, sign) in [choice(12, 2), choice(13, 2), choice(14, 2)].into_iter().enumerate() {
        position[axis] = if sign == 0 { middle[axis] + room } else { middle[axis] - room };
        // The point is as far out as is still within.
        let inwards = if sign == 0 { -1 } else { 1 };
        position[axis] = position[axis].nudged(-3 * inwards);
        for _ in 0..8 {
            let mut alone = middle;
            alone[axis] = position[axis];
            if !course::has_room(S::Vector::from(alone), expected, room) {
                position[axis] = position[axis].nudged(inwards);
            }
        }
    }
    let position = S::Vector::from(position);
    course::has_room(position, expected, room).then_some(Course {
        origin,
        end,
        span,
        time,
        stray,
        spare,
        position,
    })
}

fn who_has_room_has_not_strayed_farther_from_the_course<S: Format>(question: &Question<S>) -> TestCaseResult {
    for environment in Environment::all() {
        let Some(course) = environment.run(question, |question| course_of(question)) else {
            continue;
        };
        let position_of = |vector: S::Vector| {
            let position: [S; 3] = vector.into();
            point(position.map(S::to_f64))
        };
        let share = rational(course.time) / rational(course.span);
        let [origin, end, position] = [course.origin, course.end, course.position].map(position_of);
        for axis in 0..3 {
            let on_course = Rational::from(&end[axis] - &origin[axis]) * &share + &origin[axis];
            let strayed = Rational::from(&position[axis] - &on_course).abs();
            // The condition is 2·strayed ≤ stray + spare/√3.
            let more = strayed * 2_u32 - rational(course.stray);
            let (spare, squared) = (rational(course.spare), Rational::from(more.square_ref()) * 3_u32);
            let is_within = match (more > 0, spare > 0) {
                (true, true) => squared <= spare.square(),
                (true, false) => false,
                (false, true) => true,
                (false, false) => squared >= spare.square(),
            };
            prop_assert!(is_within, "{environment:?}: {course:?}");
        }
    }
    Ok(())
}

formats!(who_has_room_has_not_strayed_farther_from_the_course(1_500, questions()));

#[test]
fn nobody_has_room_without_numbers_or_after_the_course() {
    let nowhere = DVec3::new(0.0, f64::NAN, 0.0);
    assert!(!course::has_room(nowhere, DVec3::ZERO, 1.0) && !course::has_room(DVec3::ZERO, nowhere, 1.0));
    assert!(!course::has_room(DVec3::ZERO, DVec3::ZERO, f64::NAN));
    assert!(!course::is_certain(1.0, f64::NAN) && !course::is_certain(1.0, f64::INFINITY) && !course::is_certain(f64::NAN, 1.0));
    assert!(!course::is_certain(0.0, 0.0) && !course::is_certain(-1.0, 0.0));
    assert_eq!(course::time_after(0.5, 0.5, 1.0), Some(1.0));
    assert_eq!(course::time_after(0.5, 0.6, 1.0), None);
    assert_eq!(course::time_after(f64::NAN, 0.6, 1.0), None);
}

/// Returns (a·b)(e·e) − (a·e)(b·e), which is negative beyond a right angle. The vectors lead from the first point to the others,
/// e to the second.
fn across<S: Format>([v, others @ ..]: [[S; 3]; 4]) -> Rational {
    let [e, a, b] = others.map(|other| minus(&other.map(rational), &v.map(rational)));
    dot(&a, &b) * dot(&e, &e) - dot(&a, &e) * dot(&b, &e)
}

fn only_what_is_beyond_a_right_angle_is_wide_open<S: Format>() {
    let open = std::cell::Cell::new([0; 2]);
    check(1500, pairs_of_any_kind::<S>(), |pair| {
        let points = pair.points.map(|[start, _]| start);
        // The triangles are at a right angle up to rounding: the last corner is perpendicular to the first triangle, turned a
        // little.
        let [v, u, a, _] = points.map(|point| DVec3::from(point.map(S::to_f64)));
        let upright = v + (u - v).cross(a - v).normalize_or_zero() * (a - v).length();
        let turned = upright - (a - v) * f64::from(S::UNIT_ROUNDOFF.to_f64() as f32) * 3.0;
        let in_format = |point: DVec3| point.to_array().map(S::from_f64);
        let upright = [upright, turned].map(|last| [points[0], points[1], points[2], in_format(last)]);
        for points in upright.into_iter().chain([points]) {
            if !points.as_flattened().iter().all(|x| x.is_finite()) {
                continue;
            }
            let exact = across(points);
            for environment in Environment::all() {
                let is_open = environment.run(&points, |points| is_wide_open(points.map(S::Vector::from)));
                prop_assert!(!is_open || exact < 0, "{environment:?}: {points:?}");
                let [so_far, all] = open.get();
                open.set([so_far + usize::from(is_open), all + usize::from(exact < 0)]);
            }
        }
        Ok(())
    });
    let [found, all] = open.get();
    // An opening of a few roundings cannot be decided.
    assert!(found > 1_000 && all > found, "{found} of {all}");
}

formats!(only_what_is_beyond_a_right_angle_is_wide_open);
