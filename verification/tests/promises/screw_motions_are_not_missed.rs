//! In a small campaign of bodies in screw motion no time is late, late ones would be found, and most are sharp.

use selvedge_verification::campaign::Findings;
use selvedge_verification::campaign::screw_motions::{MotionPaths, Progress, run};

fn to_the_end(paths: MotionPaths, cases: u64, threads: usize) -> Progress {
    run(Progress::new(11, cases, 1024, paths), paths, threads, |_| {}, || false)
}

#[test]
fn no_time_of_impact_on_arcs_is_late_and_most_are_sharp() {
    let progress = to_the_end(MotionPaths::Arcs, 20_000, 2);
    assert_eq!(progress.found.wrong(), 0, "{progress}");
    for counts in &progress.found.counts {
        assert!(counts.cases > 8_000 && 2 * counts.sharp > counts.cases, "{progress}");
    }
}

#[test]
fn misses_on_chords_are_found_and_shown() {
    let progress = to_the_end(MotionPaths::Chords, 2_000, 1);
    assert!(progress.found.wrong() > 500, "{progress}");
    assert!(progress.to_string().contains("missed, in chunk 0:\nfound"), "{progress}");
}

#[test]
fn what_is_found_does_not_depend_on_threads() {
    assert_eq!(
        to_the_end(MotionPaths::Arcs, 5_000, 1),
        to_the_end(MotionPaths::Arcs, 5_000, 3)
    );
}
