use super::*;
use proptest::prelude::*;

fn about() -> About {
    About::test("test", DVec3::Z, 0.5)
}

fn triangle() -> RecordedPart {
    RecordedPart::new("cloth", PartKind::Cloth, 3, vec![[0, 1, 2]])
}

/// Returns a triangle whose height is the number of its step.
fn positions(step: u64) -> [DVec3; 3] {
    [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| p + DVec3::Z * step as f64)
}

fn frames_of(count: u64, budget: usize) -> Recording {
    let mut recorder = Recorder::new(about(), vec![triangle()], &[], &[]).with_budget(36 * budget);
    for step in 0..count {
        recorder.frame(step, &positions(step)).unwrap();
    }
    recorder.finish(None)
}

proptest! {
    #[test]
    fn frames_stay_within_the_budget_evenly_spread_and_end_at_the_end(count in 1..500_u64, budget in 2..20_usize) {
        let recording = frames_of(count, budget);
        let steps: Vec<u64> = recording.frames.iter().map(|frame| frame.step).collect();
        // The last frame is kept in addition.
        prop_assert!(steps.len() <= budget + 1);
        prop_assert_eq!((steps[0], steps[steps.len() - 1]), (0, count - 1));
        let even = &steps[..steps.len() - 1];
        prop_assert!(even.windows(3).all(|s| s[1] - s[0] == s[2] - s[1]));
        // Twice as many frames would not have fitted.
        prop_assert!(steps.len() as u64 >= count.min(budget as u64 / 2));
        for frame in &recording.frames {
            prop_assert_eq!(frame.positions[0], [0.0, 0.0, frame.step as f32]);
            prop_assert_eq!(recording.time(frame), 0.5 * frame.step as f64);
        }
    }

    #[test]
    fn values_are_means_of_a_fixed_number_of_steps_and_sum_to_the_total(
        steps in 1..10_000_u64,
        start in 0..1000_u32,
    ) {
        let series = [("pairs", SeriesKind::Pairs), ("height", SeriesKind::Gauge("m"))];
        let mut counter = f64::from(start);
        let mut recorder = Recorder::new(about(), vec![triangle()], &series, &[counter, f64::NAN]);
        recorder.frame(0, &positions(0)).unwrap();
        // All numbers are whole, so that sums are exact.
        let value = |step: u64| (step * step % 17) as f64;
        for step in 0..steps {
            counter += value(step);
            recorder.step(&[counter, -value(step)]);
        }
        let recording = recorder.finish(None);
        let each = recording.steps_per_value as usize;
        let all: Vec<f64> = (0..steps).map(value).collect();
        let [pairs, height] = &recording.series[..] else { unreachable!() };
        prop_assert_eq!(pairs.values.len(), all.len().div_ceil(each));
        prop_assert!(pairs.values.len() <= 2048 && (each == 1 || pairs.values.len() > 1024));
        for ((chunk, &mean), &negative) in all.chunks(each).zip(&pairs.values).zip(&height.values) {
            let expected = (chunk.iter().sum::<f64>() / chunk.len() as f64) as f32;
            prop_assert_eq!((mean, negative), (expected, -expected));
        }
        prop_assert_eq!((recording.steps, pairs.total, height.total), (steps, all.iter().sum(), -all.iter().sum::<f64>()));
        let largest = all.iter().copied().fold(0.0, f64::max);
        prop_assert_eq!((pairs.smallest, pairs.largest), (0.0, largest));
        prop_assert_eq!((height.smallest, height.largest), (-largest, 0.0));
    }
}

#[test]
fn a_recording_that_goes_on_from_a_checkpoint_knows_its_first_step() {
    let mut recorder = Recorder::new(about(), vec![triangle()], &[], &[]);
    recorder.frame(40, &positions(40)).unwrap();
    recorder.step(&[]);
    let recording = recorder.finish(Some(2.0));
    assert_eq!((recording.first_step, recording.steps), (41, 1));
    assert_eq!(recording.wall_seconds, Some(2.0));
}

#[test]
fn a_second_state_after_the_same_step_replaces_the_first() {
    for budget in [2, 9] {
        let mut recorder = Recorder::new(about(), vec![triangle()], &[], &[]).with_budget(36 * budget);
        for step in 0..4 {
            recorder.frame(step, &positions(step)).unwrap();
            recorder.frame(step, &positions(step + 70)).unwrap();
        }
        let recording = recorder.finish(None);
        let steps: Vec<u64> = recording.frames.iter().map(|frame| frame.step).collect();
        assert!(steps.is_sorted_by(|a, b| a < b) && steps.ends_with(&[3]), "{steps:?}");
        for frame in &recording.frames {
            assert_eq!(frame.positions[0][2], frame.step as f32 + 70.0);
        }
    }
}

#[test]
fn a_frame_that_f32_cannot_hold_is_refused_by_step_and_vertex_and_not_recorded() {
    let mut recorder = Recorder::new(about(), vec![triangle()], &[], &[]);
    recorder.frame(0, &positions(0)).unwrap();
    for bad in [f64::NAN, f64::INFINITY, 1e39] {
        let mut broken = positions(1);
        broken[2].y = bad;
        let error = recorder.frame(1, &broken).unwrap_err();
        assert_eq!((error.step, error.vertex), (1, 2));
    }
    assert_eq!(recorder.finish(None).frames.len(), 1);
}

#[test]
fn a_frames_mesh_numbers_vertices_across_parts() {
    let parts = vec![triangle(), RecordedPart::new("ball", PartKind::Body, 3, vec![[2, 1, 0]])];
    let mut recorder = Recorder::new(about(), parts, &[], &[]);
    let all = [positions(0), positions(1)].concat();
    recorder.frame(0, &all).unwrap();
    let mesh = recorder.finish(None).mesh(0);
    assert_eq!(mesh.triangles, [[0, 1, 2], [5, 4, 3]]);
    assert_eq!(mesh.positions, all);
}

/// The second of two parts does not move. The first tears twice.
#[test]
fn what_is_split_looks_in_earlier_frames_as_it_did_and_copies_of_copies_are_where_these_were() {
    let parts = vec![triangle(), RecordedPart::new("ball", PartKind::Body, 3, vec![[2, 1, 0]])];
    let mut recorder = Recorder::new(about(), parts, &[], &[]);
    let (cloth, ball) = (positions(0), positions(9));
    recorder.frame(0, &[&cloth[..], &ball].concat()).unwrap();
    recorder.split(0, &[1], vec![[0, 3, 2]]);
    let apart = DVec3::new(0.5, 0.25, 0.0);
    recorder.frame(1, &[&cloth[..], &[apart], &ball].concat()).unwrap();
    recorder.split(0, &[3, 4], vec![[0, 5, 2]]);
    let recording = recorder.finish(None);
    for (frame, copy) in [(0, cloth[1]), (1, apart)] {
        let mesh = recording.mesh(frame);
        assert_eq!(mesh.positions[..3], cloth);
        assert_eq!(mesh.positions[4..6], [copy; 2]);
        assert_eq!(mesh.positions[6..], ball);
        assert_eq!(mesh.triangles, [[0, 5, 2], [8, 7, 6]]);
    }
}

#[test]
#[should_panic(expected = "not among the 3")]
fn a_part_refuses_a_triangle_beyond_its_vertices() {
    let _ = RecordedPart::new("cloth", PartKind::Cloth, 3, vec![[0, 1, 3]]);
}

#[test]
fn a_measure_and_a_series_know_when_they_were_largest_also_after_an_interruption() {
    let begin = || {
        let recorder = Recorder::new(about(), vec![triangle()], &[("step", SeriesKind::Step)], &[0.0]);
        recorder.with_measures(&[("longest", MeasureKind::Stretch)])
    };
    let show = |recorder: &mut Recorder, step: u64, value: f64| {
        if step > 0 {
            recorder.step(&[value]);
        }
        recorder.frame(step, &positions(step)).unwrap();
        recorder.measure(step, &[value]);
    };
    let values = [1.0, 1.2, 1.7, 1.1, 1.7, 1.0];
    let mut whole = begin();
    (0..6).for_each(|step| show(&mut whole, step, values[step as usize]));
    let mut first = begin();
    (0..4).for_each(|step| show(&mut first, step, values[step as usize]));
    let saved = first.save(3.0);
    let mut second = begin();
    show(&mut second, 0, 9.0);
    assert_eq!(second.restore(&saved), Some(3.0));
    (4..6).for_each(|step| show(&mut second, step, values[step as usize]));
    let (whole, second) = (whole.finish(None), second.finish(None));
    assert_eq!(whole, second);
    let [measure] = &whole.measures[..] else { unreachable!() };
    assert_eq!(
        (measure.largest, measure.largest_step, &measure.values[..]),
        (1.7, 2, &values[..])
    );
    assert_eq!(whole.measured_steps, [0, 1, 2, 3, 4, 5]);
    // A step's time is not a counter.
    assert_eq!((whole.series[0].largest, whole.series[0].largest_step), (1.7, 2));
    assert!((whole.series[0].total - 6.7).abs() < 1e-12);
    // Truncated bytes, and those of another recorder, change nothing.
    assert!(begin().restore(&saved[..saved.len() - 1]).is_none());
    let mut other = Recorder::new(about(), vec![triangle()], &[("step", SeriesKind::Step)], &[0.0]);
    assert!(other.restore(&saved).is_none());
}

#[test]
fn the_nearest_frame_to_a_time_is_found() {
    let recording = frames_of(5, 9);
    // Steps take half a second.
    let times = [0.0, 0.2, 0.3, 1.0, 1.25, 1.9, 99.0];
    assert_eq!(times.map(|time| recording.frame_at(time)), [0, 0, 1, 2, 2, 4, 4]);
}
