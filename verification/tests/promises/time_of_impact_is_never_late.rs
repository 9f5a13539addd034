//! The certified time of impact never misses, and is never later than the exact time, in every floating-point environment. It is
//! as tight as documented, and does no more work.

use crate::support::prelude::*;
use crate::support::sweeps::side_by_side;
use selvedge_core::elementary::advance::certain_contact;
use selvedge_core::elementary::advance::{
    ROUNDS, ROUNDS_WITH_SEPARATION, TURNS, time_of_impact, time_of_impact_and_work, time_of_impact_of_points,
};
use selvedge_core::kernels::advance::Work;
use selvedge_core::kernels::of_kind;
use selvedge_core::kernels::points::PairPoints;
use selvedge_verification::random::Random;

/// A pair, and lengths on its own scale.
#[derive(Clone, Debug)]
struct Question<S: Format> {
    pair: PairCase<S>,
    tolerance: S,
    separation: S,
}

impl<S: Format> Question<S> {
    fn choose(choices: &mut Choices<'_>) -> Self {
        let kind = choices.pick(&PairKind::ALL);
        let pair = PairCase::choose(kind, choices);
        Self {
            tolerance: tolerance(&pair, choices),
            separation: separation(&pair, choices),
            pair,
        }
    }

    /// Returns whether the sizes of all numbers are within 2¹⁰⁰ of one another. Otherwise the oracle may take minutes to find
    /// when the pair is first within the separation.
    fn is_of_one_size(&self) -> bool {
        let numbers = self.pair.coordinates().chain([self.separation]);
        let sizes = numbers.map(|x| x.to_f64().abs()).filter(|&x| x > 0.0);
        let (smallest, largest) = sizes.fold((f64::MAX, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        largest / smallest < 1e30
    }

    fn answer(&self) -> (Impact<S>, Work) {
        answer(&self.pair, self.tolerance, self.separation)
    }

    fn answer_in_sweeps(&self, level: Level) -> Impact<S> {
        answer_in_sweeps(&self.pair, self.tolerance, self.separation, level)
    }
}

impl<S: Format> Simplify for Question<S> {
    fn attempts(&self) -> usize {
        2 + self.pair.attempts()
    }

    fn simpler(&self, attempt: usize) -> Option<Self> {
        let mut simpler = self.clone();
        match attempt {
            0 if self.tolerance != S::ZERO => simpler.tolerance = S::ZERO,
            1 if self.separation != S::ZERO => simpler.separation = S::ZERO,
            0 | 1 => return None,
            _ => simpler.pair = self.pair.simpler(attempt - 2)?,
        }
        Some(simpler)
    }
}

fn questions<S: Format>() -> impl Strategy<Value = Question<S>> + Clone {
    from_choices(Question::choose)
}

fn answer<S: Format>(pair: &PairCase<S>, tolerance: S, separation: S) -> (Impact<S>, Work) {
    let limits = Limits { tolerance, separation };
    time_of_impact_and_work(&pair.pair(), &limits)
}

/// Finds the time of impact as for many pairs. The same pair occurs three times, so that there are unused lanes, too.
fn answer_in_sweeps<S: Format>(pair: &PairCase<S>, tolerance: S, separation: S, level: Level) -> Impact<S> {
    let impacts = side_by_side(level, pair.kind, &[*pair; 3], &Limits { tolerance, separation });
    assert!(impacts.iter().all(|impact| *impact == impacts[0]), "{impacts:?}");
    impacts[0]
}

/// Returns the exact largest difference along an axis between points of the two sets.
fn extents<S: Format>(pair: &PairCase<S>) -> [Rational; 3] {
    let [first, second] = pair.sets();
    std::array::from_fn(|axis| {
        let between = |one: &[[S; 3]; 2], other: &[[S; 3]; 2]| {
            let at = |end: usize| (rational(one[end][axis]) - rational(other[end][axis])).abs();
            at(0).max(at(1))
        };
        let all = first
            .iter()
            .flat_map(|one| second.iter().map(move |other| between(one, other)));
        all.max().expect("two sets")
    })
}

fn size<S: Format>(pair: &PairCase<S>) -> S {
    let [x, y, z] = extents(pair);
    let largest = S::from_f64(x.max(y).max(z).to_f64());
    if Scalar::is_finite(largest) { largest } else { S::LARGEST }
}

/// Chooses no tolerance, or one between a rounding error of the pair's size and its size.
fn tolerance<S: Format>(pair: &PairCase<S>, choices: &mut Choices<'_>) -> S {
    let precision = S::PRECISION.cast_signed();
    let exponent = choices.pick(&[0, 3, 7, 13, 20, precision, precision + 9]);
    choices.pick(&[S::ZERO, S::ONE]) * size(pair) * S::exact(1, -exponent)
}

/// Chooses no separation half of the time. Otherwise it is a part of the pair's size, or exactly the distance of two points along
/// an axis. For simple pairs this is how close they come.
fn separation<S: Format>(pair: &PairCase<S>, choices: &mut Choices<'_>) -> S {
    match choices.below(8) {
        0..4 => S::ZERO,
        4 | 5 => size(pair) * S::exact(1, -choices.pick(&[0, 1, 5, 10, 30])),
        _ => {
            let coordinate = |choices: &mut Choices<'_>, axis: usize| {
                let (point, end) = (choices.below(4) as usize, choices.below(2) as usize);
                pair.points[point][end][axis]
            };
            let axis = choices.below(3) as usize;
            let distance = (coordinate(choices, axis) - coordinate(choices, axis)).abs();
            if Scalar::is_finite(distance) { distance } else { S::ZERO }
        }
    }
}

fn is_not_late<S: Format>(question: &Question<S>) -> TestCaseResult {
    never_is_late(question, question.answer().0)
}

fn is_not_late_in_sweeps<S: Format>(question: &Question<S>) -> TestCaseResult {
    let impact = question.answer_in_sweeps(best_level());
    for (name, level) in available_levels() {
        let same = question.answer_in_sweeps(level);
        prop_assert_eq!(format!("{:?}", impact), format!("{:?}", same), "{}", name);
    }
    never_is_late(question, impact)
}

fn never_is_late<S: Format>(question: &Question<S>, impact: Impact<S>) -> TestCaseResult {
    let exact = question.pair.question();
    let separation = question.separation.to_f64();
    let first = if separation == 0.0 {
        collides(&exact)
    } else if !question.is_of_one_size() {
        prop_assert!(impact != Impact::Never || !within(&exact, separation));
        return Ok(());
    } else {
        first_within(&exact, separation)
    };
    let Some(first) = first else { return Ok(()) };
    let Some(time) = impact.time() else {
        return Err(TestCaseError::fail(format!("missed: within at {first:?}")));
    };
    prop_assert!((S::ZERO..=S::ONE).contains(&time), "{impact:?}");
    prop_assert!(
        first.cmp_f64(time.to_f64()).is_ge(),
        "{impact:?} is later than {:e}",
        first.to_f64_down()
    );
    Ok(())
}

formats!(is_never_later_than_the_exact_time is is_not_late(12_000, questions()));

formats!(is_never_later_than_the_exact_time_in_sweeps is is_not_late_in_sweeps(6_000, questions()));

/// The time of contact is known without the oracle.
fn finds_what_touches<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = moment.pair();
    let time = moment.time();
    for tolerance in [S::ZERO, size(&pair) * S::exact(1, -20)] {
        let (impact, _) = answer(&pair, tolerance, S::ZERO);
        let found = impact.time().map(|time| time.to_f64());
        prop_assert!(found.is_some_and(|found| found <= time), "{impact:?}");
    }
    Ok(())
}

formats!(finds_every_pair_that_touches is finds_what_touches(80_000, touching_pairs()));

/// The time holds in every environment of a thread.
fn finds_what_touches_in_every_environment<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = moment.pair();
    let time = moment.time();
    for tolerance in [S::ZERO, size(&pair) * S::exact(1, -20)] {
        for environment in Environment::all() {
            let (impact, _) = environment.run(&pair, |pair| answer(pair, tolerance, S::ZERO));
            let in_sweeps = environment.run(&pair, |pair| answer_in_sweeps(pair, tolerance, S::ZERO, best_level()));
            for impact in [impact, in_sweeps] {
                let found = impact.time().map(|time| time.to_f64());
                prop_assert!(found.is_some_and(|found| found <= time), "{environment:?}: {impact:?}");
            }
        }
    }
    Ok(())
}

formats!(finds_every_pair_that_touches_in_every_environment is finds_what_touches_in_every_environment(8_000, touching_pairs()));

/// With a separation, the oracle decides whether the pair comes that close.
fn excludes_only_what_stays_apart<S: Format>(question: &Question<S>) -> TestCaseResult {
    let mut excluding = Environment::all();
    excluding.retain(|environment| {
        let (impact, _) = environment.run(question, Question::answer);
        let in_sweeps = environment.run(question, |question| question.answer_in_sweeps(best_level()));
        impact == Impact::Never || in_sweeps == Impact::Never
    });
    if excluding.is_empty() {
        return Ok(());
    }
    let separation = question.separation.to_f64();
    prop_assert!(!within(&question.pair.question(), separation), "excluded in {excluding:?}");
    Ok(())
}

formats!(excludes_only_what_stays_apart_in_every_environment is excludes_only_what_stays_apart(2_000, questions()));

/// The test above found this pair. If subnormal numbers are flushed, a subnormal separation must not compare as zero. The vertex
/// comes within it of a corner that sinks away from below.
#[test]
fn a_subnormal_separation_counts_where_subnormal_numbers_are_taken_for_zero() {
    let y = |y: f64| DVec3::new(0.0, y, 0.0);
    let low = Motion::resting(y(-1.0));
    let pair = PrimitivePair::vertex_face(
        Motion::new(DVec3::ZERO, y(-4.389e-308)),
        [low, low, Motion::new(y(-1.0), y(-4.4154e-308))],
    );
    let limits = Limits {
        tolerance: 0.0,
        separation: 4.13e-310,
    };
    for environment in Environment::all() {
        let impact = environment.run(&pair, |pair| time_of_impact(pair, &limits));
        assert!(impact.time().is_some(), "{environment:?}: {impact:?}");
    }
}

/// The pair is coplanar at some time, which is often a contact or a near miss.
fn is_not_late_when_coplanar<S: Format>(moment: &MeetingPair<S>) -> TestCaseResult {
    let pair = moment.pair();
    is_not_late(&Question {
        tolerance: size(&pair) * S::exact(1, -20),
        separation: S::ZERO,
        pair,
    })
}

formats!(is_not_late_for_coplanar_pairs is is_not_late_when_coplanar(12_000, coplanar_pairs()));

/// The distance is what the module's documentation says for each reason.
fn comes_near<S: Format>(question: &Question<S>) -> TestCaseResult {
    let Impact::Possible { time, reason } = question.answer().0 else {
        return Ok(());
    };
    let (tolerance, separation) = (rational(question.tolerance), rational(question.separation));
    let [x, y, z] = extents(&question.pair);
    let (near, roundoffs) = match reason {
        Reason::WithinTolerance => (tolerance + separation, 64),
        Reason::WithinError => (separation, 192),
        Reason::LastResort if question.separation == S::ZERO => {
            // Whole numbers have decided.
            prop_assert!(collides(&question.pair.question()).is_some(), "never touches");
            return Ok(());
        }
        Reason::LastResort => return comes_near_at_last(question, ROUNDS_WITH_SEPARATION),
        Reason::OutOfRange | Reason::NotFinite => return Ok(()),
    };
    let bound = with_rounding::<S>(near, roundoffs, x + y + z);
    prop_assert!(
        within_at(&question.pair.question(), &rational(time), bound),
        "not within {bound:e} at {time}, {reason:?}"
    );
    Ok(())
}

/// Returns a length and the documented rounding, as a floating-point number that is no less.
fn with_rounding<S: Format>(near: Rational, roundoffs: u32, sizes: Rational) -> f64 {
    let rounding = (&near + sizes) * roundoffs * rational(S::UNIT_ROUNDOFF);
    let vanishing = Rational::from(1) >> if S::NAME == "f32" { 60 } else { 500 };
    let bound: Rational = near + rounding + vanishing;
    bound.to_f64().next_up()
}

formats!(comes_as_near_as_its_reason_says is comes_near(12_000, questions()));

/// The first rounds, which may look at points that are not the closest.
const CHEAP_ROUNDS: u32 = 3;

/// Checks how near a pair comes that is undecided after this many rounds: within the separation, the rounding, and the part of
/// the longest path of a corner that one of the accurate rounds takes.
fn comes_near_at_last<S: Format>(question: &Question<S>, rounds: u32) -> TestCaseResult {
    let [first, second] = question.pair.sets();
    let way = |one: &[[S; 3]; 2], other: &[[S; 3]; 2]| {
        let along = |axis: usize| {
            let at = |end: usize| one[end][axis].to_f64() - other[end][axis].to_f64();
            at(1) - at(0)
        };
        along(0).hypot(along(1)).hypot(along(2))
    };
    let ways = first.iter().flat_map(|one| second.iter().map(move |other| way(one, other)));
    let part = ways.fold(0.0, f64::max) / f64::from(rounds - CHEAP_ROUNDS) * (1.0 + 0.5_f64.powi(12));
    let near = [question.separation.to_f64(), part].map(rational);
    let [x, y, z] = extents(&question.pair);
    let bound = with_rounding::<S>(near.iter().sum(), 192, x + y + z);
    prop_assert!(
        within(&question.pair.question(), bound),
        "never within {bound:e} after {rounds} rounds"
    );
    Ok(())
}

/// With few rounds, many pairs are undecided.
fn comes_near_after_few_rounds<S: Format>(question: &Question<S>) -> TestCaseResult {
    let limits = Limits {
        tolerance: question.tolerance,
        separation: question.separation.raised_to_normal(),
    };
    let pair = question.pair.pair();
    for rounds in [4, 5, 6, 9, 15] {
        let (impact, _) = of_kind!(pair.kind, P => time_of_impact_of_points::<P, S>(&PairPoints::from(&pair), &limits, rounds));
        let is_undecided = matches!(
            impact,
            Impact::Possible {
                reason: Reason::LastResort,
                ..
            }
        );
        if !is_undecided {
            return Ok(());
        }
        comes_near_at_last(question, rounds)?;
    }
    Ok(())
}

formats!(comes_near_if_few_rounds_leave_it_undecided is comes_near_after_few_rounds(12_000, questions()));

/// Generates a pair that slides, without a separation or with one that it nearly keeps.
fn sliding_questions<S: Format>() -> impl Strategy<Value = Question<S>> + Clone {
    from_choices(|choices| {
        let kind = choices.pick(&PairKind::ALL);
        let pair = PairCase::choose_sliding(kind, choices);
        let tolerance = Limits::<S>::default().tolerance;
        let nearly = S::exact(1, -choices.pick(&[10, 17, 23, 26]));
        Question {
            pair,
            tolerance: choices.pick(&[tolerance, tolerance, S::ZERO]),
            separation: choices.pick(&[S::ZERO, S::ZERO, nearly]),
        }
    })
}

formats!(comes_as_near_as_its_reason_says_where_it_slides is comes_near(12_000, sliding_questions()));

formats!(comes_near_if_few_rounds_leave_it_undecided_where_it_slides is comes_near_after_few_rounds(6_000, sliding_questions()));
formats!(is_not_late_where_it_slides is is_not_late(6_000, sliding_questions()));

formats!(is_not_late_in_sweeps_where_it_slides is is_not_late_in_sweeps(3_000, sliding_questions()));

/// The test counts the results of 6,000 pairs that slide in `f64`, and their mean and largest numbers of rounds.
#[test]
fn pairs_that_slide_take_few_rounds() {
    let (mut rounds, mut most, mut last_resorts) = (0, 0, 0);
    let cases = 6000;
    let mut random = Random(1);
    for case in 0..cases {
        let bytes: [u8; Choices::ENOUGH] = random.bytes();
        let kind = PairKind::ALL[case % 2];
        let pair = PairCase::<f64>::choose_sliding(kind, &mut Choices::new(&bytes));
        let (impact, work) = time_of_impact_and_work(&pair.pair(), &Limits::default());
        rounds += work.rounds;
        most = most.max(work.rounds);
        let is_last = matches!(
            impact,
            Impact::Possible {
                reason: Reason::LastResort,
                ..
            }
        );
        last_resorts += u32::from(is_last);
    }
    let mean = f64::from(rounds) / cases as f64;
    assert!(
        mean <= 4.0 && most <= ROUNDS && last_resorts == 0,
        "{mean} in the mean, {most} at most, {last_resorts} last resorts"
    );
}

fn does_not_work_more_than_stated(work: Work) -> TestCaseResult {
    prop_assert!(work.rounds <= ROUNDS_WITH_SEPARATION, "{work:?}");
    prop_assert!(work.volume_steps <= 1 + 8 * work.rounds, "{work:?}");
    prop_assert!(work.turns <= TURNS * work.rounds, "{work:?}");
    Ok(())
}

fn does_no_more_work_than_stated<S: Format>(question: &Question<S>) -> TestCaseResult {
    does_not_work_more_than_stated(question.answer().1)
}

formats!(does_no_more_work_than_stated(40_000, questions()));

/// A relative box may cull a pair of huge but finite numbers; nothing culls one that is not finite.
fn excludes_nothing_that_is_not_finite<S: Format>(pair: &PairCase<S>) -> TestCaseResult {
    for separation in [S::ZERO, S::ONE] {
        let (impact, work) = answer(pair, S::exact(1, -20), separation);
        does_not_work_more_than_stated(work)?;
        if !pair.is_finite() {
            let nothing = Impact::Possible {
                time: S::ZERO,
                reason: Reason::NotFinite,
            };
            prop_assert_eq!(impact, nothing);
        } else if separation == S::ZERO {
            is_not_late(&Question {
                pair: *pair,
                tolerance: S::ZERO,
                separation,
            })?;
        }
    }
    Ok(())
}

formats!(excludes_nothing_from_bad_input is excludes_nothing_that_is_not_finite(20_000, extraordinary_pairs()));

/// Counts the confirmed contacts.
type Confirmed = Cell<u32>;

fn confirms_only_contacts<S: Format>(pair: &PairCase<S>, environment: Environment, confirmed: &Confirmed) -> TestCaseResult {
    let (impact, _) = answer(pair, size(pair) * S::exact(1, -20), S::ZERO);
    let times = [impact.time(), Some(S::exact(1, -1)), Some(S::ZERO)];
    for near in times.into_iter().flatten() {
        let interval = environment.run(pair, |pair| certain_contact(&pair.pair(), near));
        let Some([from, to]) = interval else { continue };
        confirmed.set(confirmed.get() + 1);
        let Some(first) = collides(&pair.question()) else {
            return Err(TestCaseError::fail("confirmed what never touches"));
        };
        prop_assert!(first.cmp_rational(&rational(to)).is_le(), "[{from}, {to}]");
    }
    Ok(())
}

fn confirms_contacts_and_nothing_else<S: Format>() {
    let (asked, confirmed) = (Cell::new(0), Confirmed::default());
    check(20_000, pairs_of_any_kind::<S>(), |pair| {
        asked.set(asked.get() + 1);
        confirms_only_contacts(pair, Environment::DEFAULT, &confirmed)
    });
    // About three in a hundred are confirmed.
    let (confirmed, asked) = (confirmed.get(), asked.get());
    assert!(confirmed > asked / 100, "{confirmed} of {asked}");
}

formats!(confirms_contacts_and_nothing_else);

fn confirms_contacts_and_nothing_else_in_every_environment<S: Format>() {
    let confirmed = Confirmed::default();
    check(2_000, pairs_of_any_kind::<S>(), |pair| {
        for environment in Environment::all() {
            confirms_only_contacts(pair, environment, &confirmed)?;
        }
        Ok(())
    });
    assert!(Environment::all().is_empty() || confirmed.get() > 200);
}

formats!(confirms_contacts_and_nothing_else_in_every_environment);
