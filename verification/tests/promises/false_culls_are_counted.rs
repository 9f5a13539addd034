//! A short run of `examples/false_culls.rs`, and that an interrupted run ends like an uninterrupted one.

use selvedge_verification::campaign::Findings;
use selvedge_verification::campaign::false_culls::{Progress, Rule, run};
use std::sync::atomic::{AtomicU64, Ordering};

const SEED: u64 = 1;

#[test]
fn no_certified_tier_has_a_false_cull_and_the_others_do() {
    let progress = run(Progress::new(SEED, 100_000, 10_000), 2, |_| (), || false);
    println!("{progress}");
    assert!(progress.is_finished());
    assert_eq!(progress.found.wrong(), 0, "{progress}");
    for rows in &progress.found.rows {
        for (rule, tally) in Rule::all().into_iter().zip(rows) {
            assert_eq!(tally.pairs, 100_000);
            assert!(tally.culled > 1000, "{rule} culls too little to tell");
            assert!(tally.by_oracle > 0, "{rule} was never put to the oracle");
            assert_eq!(tally.touching > 0, !rule.is_certified(), "{rule}");
            assert_eq!(tally.example.is_some(), !rule.is_certified(), "{rule}");
        }
    }
}

#[test]
fn a_run_that_is_killed_and_started_again_ends_like_any_other() {
    let fresh = || Progress::new(SEED, 6_000, 1_000);
    let whole = run(fresh(), 1, |_| (), || false);
    let chunks = AtomicU64::new(0);
    let kept = std::sync::Mutex::new(String::new());
    let cut = run(
        fresh(),
        2,
        |progress| {
            chunks.fetch_add(1, Ordering::Relaxed);
            *kept.lock().unwrap() = serde_json::to_string(progress).unwrap();
        },
        || chunks.load(Ordering::Relaxed) >= 5,
    );
    assert!(!cut.is_finished() && !cut.done.is_empty());
    let kept: Progress = serde_json::from_str(&kept.into_inner().unwrap()).unwrap();
    assert_eq!(kept, cut);
    assert_eq!(run(kept, 2, |_| (), || false), whole);
}

#[test]
fn another_seed_gives_other_pairs() {
    let culled = |seed: u64| run(Progress::new(seed, 1_000, 1_000), 1, |_| (), || false).found.rows;
    assert_ne!(culled(SEED), culled(SEED + 1));
}
