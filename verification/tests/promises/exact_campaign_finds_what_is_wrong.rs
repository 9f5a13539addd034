//! In a small billion-pair campaign no certified claim is wrong, and the false culls of an unsafe filter are found. The findings
//! depend on neither threads nor interruptions.

use crate::support::prelude::*;
use selvedge_verification::campaign::Findings;
use selvedge_verification::campaign::exact::{Claim, ClaimCounts, Progress, Scenes, run};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Makes a vertex that falls through a face, and two edges that cross.
fn scenes() -> Scenes {
    let rests = |position: [f64; 3]| [position; 2];
    let falls = |[x, y, z]: [f64; 3]| [[x, y, z + 0.7], [x, y, z - 0.6]];
    let floor = [[0.1, 0.2, 0.3], [1.1, 0.3, 0.2], [0.3, 1.2, 0.4]];
    let [a, b, c] = floor.map(rests);
    Scenes {
        vertex_face: vec![[falls([0.4, 0.4, 0.3]), a, b, c], [falls([1.4, 0.4, 0.3]), a, b, c]],
        edge_edge: vec![[falls(floor[0]), falls([0.9, 0.8, 0.3]), b, c]],
    }
}

fn campaign(claims: &[Claim], pairs: u64) -> Progress {
    Progress::new(3, pairs, 2048, &scenes(), claims)
}

fn to_the_end(progress: Progress, threads: usize) -> Progress {
    run(progress, &scenes(), best_level(), threads, |_| {}, || false)
}

fn sum(progress: &Progress, what: fn(&ClaimCounts) -> u64) -> u64 {
    progress.found.counts.iter().flatten().flatten().map(what).sum()
}

#[test]
fn no_certified_claim_is_wrong_and_each_kind_of_proof_is_needed() {
    let progress = to_the_end(campaign(&Claim::CERTIFIED, 100_000), 2);
    assert_eq!(progress.found.wrong(), 0, "{progress}");
    for by_source in &progress.found.counts {
        for claim in 0..Claim::CERTIFIED.len() {
            let of_claim = by_source.iter().map(|counts| &counts[claim]);
            assert!(of_claim.clone().map(|count| count.claims).sum::<u64>() > 1000, "{progress}");
            assert!(of_claim.map(|count| count.by_oracle).sum::<u64>() > 1, "{progress}");
        }
    }
    let proofs: [fn(&ClaimCounts) -> u64; 3] = [|count| count.by_signs, |count| count.by_axis, |count| count.by_whole_numbers];
    for proven in proofs {
        assert!(sum(&progress, proven) > 100, "{progress}");
    }
}

#[test]
fn false_culls_of_the_plain_filter_are_found_and_shown() {
    let progress = to_the_end(campaign(&[Claim::Plain], 25_000), 2);
    assert!(progress.found.wrong() > 10, "{progress}");
    assert!(progress.to_string().contains("Plain, f32, is wrong of\n"), "{progress}");
}

#[test]
fn a_run_that_was_stopped_goes_on_to_the_same_result() {
    let whole = to_the_end(campaign(&Claim::CERTIFIED, 25_000), 1);
    let chunks = AtomicUsize::new(0);
    let stopped = run(
        campaign(&Claim::CERTIFIED, 25_000),
        &scenes(),
        best_level(),
        2,
        |_| {
            chunks.fetch_add(1, Ordering::Relaxed);
        },
        || chunks.load(Ordering::Relaxed) >= 3,
    );
    assert!(!stopped.done.is_empty() && stopped.done.len() < whole.done.len());
    assert_eq!(stopped.settings, whole.settings);
    let kept = serde_json::to_string(&stopped).expect("JSON");
    let resumed = to_the_end(serde_json::from_str(&kept).expect("JSON"), 2);
    assert_eq!(resumed, whole);
}
