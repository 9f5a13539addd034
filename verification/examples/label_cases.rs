//! Labels the cases of the conformance suite by the oracle: `label_cases < CASES.jsonl > LABELS.jsonl`.
//!
//! Numbers of the output are decimals that identify their `f64`.

use selvedge_verification::conformance::{Case, CaseQuestion};
use selvedge_verification::oracle::{collides, triangles_intersect, within};
use serde_json::{Value, json};
use std::io::{BufRead, Write};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut output = std::io::stdout().lock();
    for line in std::io::stdin().lock().lines() {
        let case: Case = serde_json::from_str(&line?)?;
        writeln!(output, "{}", label(&case))?;
    }
    Ok(())
}

fn label(case: &Case) -> Value {
    let [start, end] = case.positions();
    if start.iter().chain(&end).flatten().any(|x| !x.is_finite()) {
        return json!({ "id": case.id, "touches": null });
    }
    let pairs = case.questions();
    if meet_at_start(case, &start) {
        return json!({ "id": case.id, "touches": true, "first": [0.0, 0.0], "exact": "0" });
    }
    if let Some(first) = pairs.iter().filter_map(collides).min() {
        let low = first.to_f64_down();
        let is_exact = first.cmp_f64(low).is_eq();
        let high = if is_exact { low } else { low.next_up() };
        let exact = first.as_rational().map(ToString::to_string);
        return json!({ "id": case.id, "touches": true, "first": [low, high], "exact": exact });
    }
    // Numbers of one sign are ordered as their bits. The two differ by 1/32 at most, unless they are subnormal.
    let (mut low, mut high) = (0, f64::MAX.to_bits());
    while high - low > (1 << 47).min(1.max(high >> 6)) {
        let middle = low.midpoint(high);
        if pairs.iter().any(|pair| within(pair, f64::from_bits(middle))) {
            high = middle;
        } else {
            low = middle;
        }
    }
    json!({ "id": case.id, "touches": false, "distance": [f64::from_bits(low), f64::from_bits(high)] })
}

/// Returns whether triangles meet at the start that are not parts of one moving mesh.
fn meet_at_start(case: &Case, start: &[[f64; 3]]) -> bool {
    let split = match case.question {
        CaseQuestion::Triangles | CaseQuestion::MovingTriangle => 1,
        CaseQuestion::Meshes => case.split,
        _ => return false,
    };
    let triangles: Vec<_> = case
        .triangles()
        .into_iter()
        .map(|face| face.map(|vertex| start[vertex as usize]))
        .collect();
    let (first, second) = triangles.split_at(split);
    first.iter().any(|a| second.iter().any(|b| triangles_intersect(a, b, &[])))
}
