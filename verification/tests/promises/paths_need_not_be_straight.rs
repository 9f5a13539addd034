//! Positions, deviations and times of impact on arcs and polylines agree with numbers of 256 bits, which stand for exact ones.

use crate::support::geometry::Truth;
use crate::support::prelude::*;
use rug::Float;
use selvedge_core::paths::{Arc, Moment, Path, Piece, Polyline, RigidMotion, geometry, time_of_impact};
use selvedge_verification::oracle::arcs::{FloatPoint, Pose, distance, float, minus, place, plus, times};
use selvedge_verification::oracle::within_at_rest;
use std::f64::consts::{PI, TAU};

/// Two motions, and points of the bodies.
#[derive(Clone, Debug)]
struct Turning {
    turns: [Screw; 2],
    /// The points, near the centre of the first body.
    points: [DVec3; 4],
    time: f64,
}

impl Simplify for Turning {
    fn attempts(&self) -> usize {
        0
    }

    fn simpler(&self, _: usize) -> Option<Self> {
        None
    }
}

fn turning() -> impl Strategy<Value = Turning> + Clone {
    from_choices(|choices: &mut Choices<'_>| {
        let turns = [(); 2].map(|()| Screw::choose(choices));
        let size = choices.pick(&[1.0, 1e-3, 10.0]);
        let mut unit = || choices.word() as f64 / u64::MAX as f64 * 2.0 - 1.0;
        let points = [(); 4].map(|()| turns[0].centre + size * DVec3::new(unit(), unit(), unit()));
        let time = (0.5 + 0.5 * unit()).clamp(0.0, 1.0);
        Turning { turns, points, time }
    })
}

#[test]
fn a_point_of_a_body_that_turns_is_where_it_is_said_to_be_and_as_fast() {
    check(500, turning(), |case| {
        let turn = &case.turns[0];
        for start in case.points {
            for time in [0.0, case.time, 1.0] {
                let pose = Pose::at_time(turn, time);
                let exact = (pose.at(start), pose.velocity(start));
                for environment in Environment::all() {
                    let ask = |&(turn, start, time): &(&Screw, DVec3, f64)| turn.motion().path(start).moment(time);
                    is_near(&environment.run(&(turn, start, time), ask), &exact)
                        .map_err(|error| TestCaseError::fail(format!("{environment:?} at {time}: {error}")))?;
                }
            }
        }
        Ok(())
    });
}

fn is_near(moment: &Moment, (position, velocity): &(FloatPoint, FloatPoint)) -> TestCaseResult {
    let off = distance(&place(moment.position), position);
    prop_assert!(off <= float(moment.position_error), "{} of {}", off, moment.position_error);
    let off = distance(&place(moment.velocity), velocity);
    prop_assert!(
        off <= float(moment.velocity_error),
        "{} of {}, its velocity",
        off,
        moment.velocity_error
    );
    Ok(())
}

/// The promise holds on a straight path and on a polyline. At a knot the velocity is that of the piece that leads there.
#[test]
fn a_point_on_straight_pieces_is_where_it_is_said_to_be_and_as_fast() {
    check(300, turning(), |case| {
        let points = case.points;
        let knots = [0.0, 0.25, 0.25 + 0.5 * case.time.max(1e-3), 1.0];
        let line = Polyline::new(&knots, &points).expect("ascending times");
        let straight = Motion::<f64>::new(points[0], points[1]);
        for time in [0.0, 0.25, knots[2], 0.5 * case.time, case.time, 1.0] {
            let way = |from: DVec3, to: DVec3, [begin, end]: [f64; 2]| {
                let lasts = float(end) - float(begin);
                let velocity = times(&minus(&place(to), &place(from)), &lasts.recip());
                let since = float(time) - float(begin);
                (plus(&place(from), &times(&velocity, &since)), velocity)
            };
            let k = knots.iter().rposition(|&knot| knot < time).unwrap_or(0);
            let on_line = way(points[k], points[k + 1], [knots[k], knots[k + 1]]);
            let on_straight = way(points[0], points[1], [0.0, 1.0]);
            for environment in Environment::all() {
                let moments = environment.run(&(line, straight, time), |(line, straight, time)| {
                    [line.moment(*time), straight.moment(*time)]
                });
                for (moment, exact) in moments.iter().zip([&on_line, &on_straight]) {
                    is_near(moment, exact).map_err(|error| TestCaseError::fail(format!("{environment:?} at {time}: {error}")))?;
                }
            }
        }
        Ok(())
    });
}

/// Checks the deviation of a point from the straight motion, at times in between.
fn deviates(piece: &Piece, [from, to]: [f64; 2], at: impl Fn(f64) -> FloatPoint) -> TestCaseResult {
    for share in [0.0, 0.1, 0.5, 0.77, 1.0] {
        let time = from + (to - from) * share;
        if time > to {
            continue;
        }
        // This is the exact share of the time.
        let share = (float(time) - float(from)) / (float(to) - float(from));
        let rest = float(1.0) - &share;
        let straight = plus(
            &times(&place(piece.motion.start), &rest),
            &times(&place(piece.motion.end), &share),
        );
        let off = distance(&straight, &at(time));
        prop_assert!(off <= float(piece.deviation), "{off} of {} at {time}", piece.deviation);
    }
    Ok(())
}

#[test]
fn no_path_deviates_farther_from_its_straight_pieces_than_is_said() {
    check(600, turning(), |case| {
        let turn = &case.turns[0];
        let [from, to] = [case.time * 0.5, case.time * 0.5 + 0.5];
        for [from, to] in [[0.0, 1.0], [from, to], [from, from + (to - from) * 1e-3]] {
            let arc = turn.motion().path(case.points[0]);
            deviates(&arc.piece(from, to), [from, to], |time| {
                Pose::at_time(turn, time).at(case.points[0])
            })?;

            let straight = Motion::<f64>::new(case.points[0], case.points[1]);
            let knots = [0.0, 0.25, 0.25 + 0.5 * case.time, 1.0];
            let line = Polyline::new(&knots, &case.points).expect("ascending times");
            let between = |a: DVec3, b: DVec3, share: Float| {
                let rest = float(1.0) - &share;
                plus(&times(&place(a), &rest), &times(&place(b), &share))
            };
            deviates(&straight.piece(from, to), [from, to], |time| {
                between(straight.start, straight.end, float(time))
            })?;
            let on_line = |time: f64| {
                let k = knots.iter().rposition(|&knot| knot <= time).unwrap_or(0).min(2);
                let share = (float(time) - float(knots[k])) / (float(knots[k + 1]) - float(knots[k]));
                between(case.points[k], case.points[k + 1], share)
            };
            deviates(&line.piece(from, to), [from, to], on_line)?;
        }
        Ok(())
    });
}

/// Returns the starts of two sets of points, one on each body, that touch at the case's time up to the rounding of the starts.
fn sides_that_touch(case: &Turning, kind: PairKind) -> [Vec<DVec3>; 2] {
    let [first, second] = case.turns.each_ref().map(|turn| Pose::at_time(turn, case.time));
    // The positions at the time, on the first body: a vertex in the middle of a face, or two edges that cross.
    let [a, b, c, d] = case.points;
    let there = |point: DVec3| first.at(point);
    let middle = |points: &[DVec3]| points.iter().sum::<DVec3>() / points.len() as f64;
    let (own, other) = match kind {
        PairKind::VertexFace => (vec![middle(&[b, c, d])], vec![b, c, d]),
        // The second edge passes through the middle of the first.
        PairKind::EdgeEdge => (vec![a, b], vec![c, middle(&[a, b]) * 2.0 - c]),
    };
    let starts = other.iter().map(|&point| second.start_of(&there(point)));
    [own, starts.collect()]
}

/// Two bodies in screw motion, each with one set, touch at a time by construction, up to the rounding of the starts. The time of
/// impact is no later, for any separation that exceeds this rounding. Counts the pairs, tight times, and those that the chords of
/// the arcs would miss.
fn contacts_are_found(case: &Turning, count: &Cell<[usize; 3]>) -> TestCaseResult {
    let [first, second] = &case.turns;
    for kind in PairKind::ALL {
        let [own, other] = sides_that_touch(case, kind);
        let size = case
            .points
            .iter()
            .chain([&first.centre, &second.centre, &first.translation, &second.translation]);
        let size = size.map(|point| point.abs().max_element()).fold(1.0, f64::max);
        let arcs: Vec<Arc> = own
            .iter()
            .map(|&point| first.motion().path(point))
            .chain(other.iter().map(|&point| second.motion().path(point)))
            .collect();
        let limits = Limits {
            separation: 1e-13 * size,
            tolerance: 1e-6 * size,
        };
        let first_time = |paths: [&dyn Path; 4]| time_of_impact(kind, paths, &limits).time();
        let found = first_time([&arcs[0], &arcs[1], &arcs[2], &arcs[3]]);
        let is_in_time = |found: Option<f64>| found.is_some_and(|time| time <= case.time);
        prop_assert!(is_in_time(found), "{kind:?} at {}: {found:?}", case.time);
        let chords: Vec<_> = arcs.iter().map(|arc| arc.piece(0.0, 1.0).motion).collect();
        let on_chords = first_time([&chords[0], &chords[1], &chords[2], &chords[3]]);
        let [all, tight, missed] = count.get();
        let is_tight = found.is_some_and(|time| time > 0.5 * case.time);
        count.set([
            all + 1,
            tight + usize::from(is_tight),
            missed + usize::from(!is_in_time(on_chords)),
        ]);
    }
    Ok(())
}

/// Checks the promises about the geometry of such a pair at its time of impact, and at any other time. Counts the normals of
/// bodies that begin apart and meet.
fn geometry_is_kept(case: &Turning, environment: Environment, count: &Cell<[usize; 2]>) -> TestCaseResult {
    let motions = case.turns.each_ref().map(Screw::motion);
    for kind in PairKind::ALL {
        let sides = sides_that_touch(case, kind);
        let on = |side: usize, start: &DVec3| (side, *start);
        let starts: Vec<(usize, DVec3)> = (0..2)
            .flat_map(|side| sides[side].iter().map(move |start| on(side, start)))
            .collect();
        let arcs: Vec<Arc> = starts.iter().map(|&(side, start)| motions[side].path(start)).collect();
        let paths: [&dyn Path; 4] = [&arcs[0], &arcs[1], &arcs[2], &arcs[3]];
        let impact = time_of_impact(kind, paths, &Limits::default());
        for (time, is_impact) in [
            (impact.time(), true),
            (Some(0.5 * case.time), false),
            (Some(case.time), false),
        ] {
            let Some(time) = time else { continue };
            let found = environment.run(&(kind, &arcs, time), |&(kind, arcs, time)| {
                geometry(kind, [&arcs[0], &arcs[1], &arcs[2], &arcs[3]], time)
            });
            let moments = arcs.iter().map(|arc| arc.moment(time)).collect::<Vec<_>>();
            let most = |side: usize, error: fn(&Moment) -> f64| {
                let of_side = starts.iter().zip(&moments).filter(|((own, _), _)| *own == side);
                of_side.map(|(_, moment)| error(moment)).fold(0.0, f64::max)
            };
            let exact = |place: FloatPoint| place.map(|x| x.to_rational().expect("a finite number"));
            let all = |time: f64, of: fn(&Pose, DVec3) -> FloatPoint| {
                let poses = case.turns.each_ref().map(|turn| Pose::at_time(turn, time));
                [0, 1, 2, 3].map(|k| exact(of(&poses[starts[k].0], starts[k].1)))
            };
            let at = |time: f64| all(time, Pose::at);
            let velocities = all(time, Pose::velocity);
            let from_first = velocities.iter().flat_map(|velocity| velocity.iter().zip(&velocities[0]));
            let of_speed = from_first.map(|(own, first)| Rational::from(own - first).abs()).max();
            let largest = at(time).into_iter().flatten().map(Rational::abs).max();
            // Errors in another rounding direction may differ by 16u of the moments, and the widening covers that.
            let wider = 1.0 + 1e-12;
            let truth = Truth {
                kind,
                time,
                at: &at,
                velocities,
                largest: largest.expect("four points"),
                of_speed: of_speed.expect("four points"),
                position_errors: [0, 1].map(|side| wider * most(side, |moment| moment.position_error)),
                velocity_errors: wider * (most(0, |moment| moment.velocity_error) + most(1, |moment| moment.velocity_error)),
            };
            let has_normal = truth
                .is_promised(&found)
                .map_err(|error| TestCaseError::fail(format!("{kind:?} at {time}, {environment:?}: {error}")))?;
            if is_impact && time > 0.0 {
                let [all, with] = count.get();
                count.set([all + 1, with + usize::from(has_normal)]);
            }
        }
    }
    Ok(())
}

#[test]
fn geometry_of_bodies_in_screw_motion_is_enclosed() {
    let count = Cell::new([0; 2]);
    check(250, turning(), |case| geometry_is_kept(case, Environment::all()[0], &count));
    check(25, turning(), |case| {
        Environment::all()
            .into_iter()
            .try_for_each(|environment| geometry_is_kept(case, environment, &count))
    });
    let [all, with] = count.get();
    assert!(all > 200 && 10 * with > 9 * all, "{with} of {all}");
}

#[test]
fn no_contact_of_bodies_in_screw_motion_is_missed() {
    let count = Cell::new([0; 3]);
    check(5_000, turning(), |case| contacts_are_found(case, &count));
    let [all, tight, missed] = count.get();
    assert!(
        all > 8_000 && 10 * tight > all && 10 * missed > all,
        "{tight} and {missed} of {all}"
    );
}

/// If a polyline is straight up to the rounding of a knot, a contact comes within three tolerances and the rounding of knots and
/// places. That rounding is far less than 2⁻⁴⁰.
fn comes_near_on_polylines(case: &PairCase<f64>) -> TestCaseResult {
    let knots = case.points.map(|ends| {
        let [start, end] = ends.map(DVec3::from);
        [start, (start + end) * 0.5, end]
    });
    let paths = knots
        .each_ref()
        .map(|knots| Polyline::new(&[0.0, 0.5, 1.0], knots).expect("knots"));
    let limits = Limits::default();
    let impact = time_of_impact(case.kind, paths.each_ref().map(|path| path as &dyn Path), &limits);
    let bound = 3.0 * limits.tolerance + 0.5_f64.powi(40);
    prop_assert!(impact == Impact::Never || within(&case.question(), bound), "{impact:?}");
    Ok(())
}

#[test]
fn what_slides_on_polylines_and_is_called_a_contact_comes_near() {
    check(2000, sliding_pairs::<f64>(), comes_near_on_polylines);
}

/// A pair that slides at the start, on two bodies that move almost alike.
fn sliding_on_arcs(kind: PairKind) -> impl Strategy<Value = Turning> + Clone {
    from_choices(move |choices: &mut Choices<'_>| {
        let points = PairCase::<f64>::choose_sliding(kind, choices).points;
        let [centre, axis, translation, apart] = [(); 4].map(|()| vector(choices));
        let angle = choices.pick(&[0.01, 0.3, PI, TAU]);
        let nearly = 0.5_f64.powi(choices.pick(&[10, 17, 24, 30]));
        let turn = |translation: DVec3| Screw {
            centre,
            axis: axis + DVec3::Z,
            angle,
            translation,
        };
        Turning {
            turns: [turn(translation), turn(translation + nearly * apart)],
            points: points.map(|[start, _]| DVec3::from(start)),
            time: 0.0,
        }
    })
}

/// Checks that a contact on arcs comes as near as the documentation of [`time_of_impact`] says, and counts the contacts.
fn comes_near_on_arcs(kind: PairKind, case: &Turning, contacts: &Cell<usize>) -> TestCaseResult {
    let side = |k: usize| side_of(kind, k);
    let bodies = case.turns.each_ref().map(Screw::motion);
    let arcs = [0, 1, 2, 3].map(|k| bodies[side(k)].path(case.points[k]));
    let limits = Limits::default();
    let impact = time_of_impact(kind, arcs.each_ref().map(|arc| arc as &dyn Path), &limits);
    let Impact::Possible { time, reason } = impact else {
        return Ok(());
    };
    contacts.set(contacts.get() + 1);
    let is_near_at = |time: f64, bound: f64| {
        let poses = case.turns.each_ref().map(|turn| Pose::at_time(turn, time));
        let exact = |place: FloatPoint| place.map(|x| x.to_rational().expect("a finite number"));
        within_at_rest(kind, &[0, 1, 2, 3].map(|k| exact(poses[side(k)].at(case.points[k]))), bound)
    };
    let rounding = 1e-12;
    if reason == Reason::LastResort {
        let parts = arcs.each_ref().map(|arc| arc.piece(0.0, 1.0 / 512.0).deviation);
        let bound = limits.tolerance + 4.0 * parts.into_iter().fold(0.0, f64::max) + rounding;
        prop_assert!(
            (0..=128).any(|k| is_near_at(f64::from(k) / 128.0, bound)),
            "never within {bound:e}"
        );
    } else {
        let bound = 3.0 * limits.tolerance + rounding;
        prop_assert!(is_near_at(time, bound), "not within {bound:e}: {impact:?}");
    }
    Ok(())
}

#[test]
fn what_slides_on_arcs_and_is_called_a_contact_comes_near() {
    for kind in PairKind::ALL {
        let contacts = Cell::new(0);
        check(400, sliding_on_arcs(kind), |case| comes_near_on_arcs(kind, case, &contacts));
        assert!(contacts.get() > 40, "{kind:?}: {} contacts", contacts.get());
    }
}

/// This is the case of parry's issue 317: a plank that spins fast hits a box beside it. The plank is clear of the box when the
/// step begins and when it ends, and would be on the straight paths of its corners.
#[test]
fn a_plank_that_spins_hits_the_box_beside_it() {
    // The plank starts half a turn from the x axis, so that its ends change places and its straight paths lead through the
    // middle.
    let plank = RigidMotion::new(DVec3::ZERO, DVec3::Z, PI, DVec3::ZERO).expect("numbers in range");
    let tip = [DVec3::new(2.0, -0.1, 0.0), DVec3::new(2.0, 0.1, 0.0)].map(|corner| plank.path(corner));
    let post = [DVec3::new(0.0, 1.5, -1.0), DVec3::new(0.0, 1.5, 1.0)].map(Motion::resting);
    let side = plank.path(DVec3::new(-2.0, -0.1, 0.0));
    // The leading long side reaches the post when the plank is nearly upright.
    let paths: [&dyn Path; 4] = [&side, &tip[0], &post[0], &post[1]];
    let limits = Limits::default();
    let edges = time_of_impact(PairKind::EdgeEdge, paths, &limits);
    let other: [&dyn Path; 4] = [&tip[0], &tip[1], &post[0], &post[1]];
    assert_eq!(
        time_of_impact(PairKind::EdgeEdge, other, &limits),
        Impact::Never,
        "the tip passes beyond the post"
    );
    // At an angle of φ the side, 0.1 from the axis, is at (0, 1.5): it trails the plank's middle line by asin(0.1 / 1.5).
    let angle = std::f64::consts::FRAC_PI_2 + (0.1_f64 / 1.5).asin();
    let exact = angle / PI;
    let time = edges.time().expect("a contact");
    assert!(time <= exact && time > exact - 1e-7, "{time}, {exact}");
    // On straight paths it passes through the axis of the plank, far from the post.
    let ends = |path: &Arc| Motion::<f64>::new(path.at(0.0), path.at(1.0));
    let straight = [ends(&side), ends(&tip[0]), post[0], post[1]];
    let straight: [&dyn Path; 4] = [&straight[0], &straight[1], &straight[2], &straight[3]];
    assert_eq!(time_of_impact(PairKind::EdgeEdge, straight, &limits), Impact::Never);
}

#[test]
fn what_is_not_known_excludes_nothing() {
    let wall = [
        DVec3::new(0.0, 5.0, 0.0),
        DVec3::new(1.0, 5.0, 0.0),
        DVec3::new(0.0, 5.0, 1.0),
    ]
    .map(Motion::resting);
    let turn = RigidMotion::new(DVec3::ZERO, DVec3::Z, 1.0, DVec3::ZERO).expect("numbers in range");
    for start in [DVec3::NAN, DVec3::INFINITY, DVec3::new(f64::MAX, -f64::MAX, 0.0)] {
        let point = turn.path(start);
        let paths: [&dyn Path; 4] = [&point, &wall[0], &wall[1], &wall[2]];
        let impact = time_of_impact(PairKind::VertexFace, paths, &Limits::default());
        assert_eq!(impact.time(), Some(0.0), "{start}");
    }
    let strange = [f64::NAN, f64::INFINITY, 1e7];
    assert!(
        strange
            .iter()
            .all(|&angle| RigidMotion::new(DVec3::ZERO, DVec3::Z, angle, DVec3::ZERO).is_none())
    );
    assert!(RigidMotion::new(DVec3::ZERO, DVec3::ZERO, 1.0, DVec3::ZERO).is_none());
    let knots = [DVec3::ZERO, DVec3::X, DVec3::Y];
    for times in [[0.0, 0.5, 0.5], [0.0, 0.5, 0.9], [0.1, 0.5, 1.0], [0.0, f64::NAN, 1.0]] {
        assert!(Polyline::new(&times, &knots).is_none());
    }
    assert!(Polyline::new(&[0.0, 1.0], &knots).is_none());
}
