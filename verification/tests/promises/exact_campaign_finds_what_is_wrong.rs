//! In a small billion-pair campaign no certified claim is wrong, and the false culls of an unsafe filter are found. The findings
//! do not depend on threads, and those of several runs add up.

use crate::support::prelude::*;
use selvedge_verification::campaign::{CampaignFindings, ClaimCounts, Run, Scenes, TestedClaim};

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

fn findings(seed: u64, claims: &[TestedClaim], pairs: u64, threads: usize) -> CampaignFindings {
    let run = Run {
        seed,
        chunks: pairs.div_ceil(2048),
        pairs_per_chunk: 2048,
        scenes: &scenes(),
        claims,
        level: best_level(),
    };
    run.findings(threads, |_| {})
}

fn sum(found: &CampaignFindings, what: fn(&ClaimCounts) -> u64) -> u64 {
    found.counts.iter().flatten().flatten().map(what).sum()
}

#[test]
fn no_certified_claim_is_wrong_and_each_kind_of_proof_is_needed() {
    let found = findings(3, &TestedClaim::CERTIFIED, 100_000, 2);
    assert_eq!(found.wrong(), 0, "{found}");
    for by_source in &found.counts {
        for claim in 0..TestedClaim::CERTIFIED.len() {
            let of_claim = by_source.iter().map(|counts| &counts[claim]);
            assert!(of_claim.clone().map(|count| count.claims).sum::<u64>() > 1000, "{found}");
            assert!(of_claim.map(|count| count.by_oracle).sum::<u64>() > 1, "{found}");
        }
    }
    let proofs: [fn(&ClaimCounts) -> u64; 3] = [|count| count.by_signs, |count| count.by_axis, |count| count.by_whole_numbers];
    for proven in proofs {
        assert!(sum(&found, proven) > 100, "{found}");
    }
}

#[test]
fn false_culls_of_the_plain_filter_are_found_and_shown() {
    let found = findings(3, &[TestedClaim::Plain], 25_000, 2);
    assert!(found.wrong() > 10, "{found}");
    assert!(found.to_string().contains("Plain, f32, is wrong of\n"), "{found}");
}

#[test]
fn findings_depend_on_the_seed_alone_and_add_up() {
    let [one, other] = [3, 4].map(|seed| findings(seed, &TestedClaim::CERTIFIED, 25_000, 1));
    assert_eq!(findings(3, &TestedClaim::CERTIFIED, 25_000, 2), one);
    assert_ne!(one, other);
    // Counts of several machines travel as JSON.
    let mut both: CampaignFindings = serde_json::from_str(&serde_json::to_string(&one).expect("JSON")).expect("JSON");
    both.add(other.clone()).expect("the same claims");
    assert_eq!(both.pairs, one.pairs + other.pairs);
    let counts: [fn(&ClaimCounts) -> u64; 3] = [|count| count.claims, |count| count.by_signs, |count| count.by_oracle];
    for count in counts {
        assert_eq!(sum(&both, count), sum(&one, count) + sum(&other, count));
    }
    assert_eq!(
        both.add(findings(3, &[TestedClaim::Plain], 2048, 1)),
        Err(vec![TestedClaim::Plain])
    );
}
