use super::table;
use crate::report::number::{grouped, three_figures};
use crate::study::QueryResult;
use selvedge::PairKind;

/// Returns each method's answers to queries, one table for each kind of pair.
pub fn queries(scalar: &str, results: &[QueryResult]) -> String {
    let mut text = String::new();
    for kind in PairKind::ALL {
        let of_kind: Vec<_> = results.iter().filter(|result| result.kind == kind).collect();
        let Some(first) = of_kind.first() else {
            continue;
        };
        let truth = first.truth.map_or_else(
            || "truth unknown".to_owned(),
            |truth| format!("{} collide", grouped(truth.positives)),
        );
        text += &format!(
            "{}: {} queries, {truth}; {scalar}\n\n",
            match kind {
                PairKind::VertexFace => "Vertex–face",
                PairKind::EdgeEdge => "Edge–edge",
            },
            grouped(first.queries),
        );
        let header = [
            "method",
            "kept",
            "false\n+",
            "false\n−",
            "mean\nns",
            "median\nns",
            "99 %\nns",
            "max\nns",
        ];
        text += &table(header, of_kind.into_iter().map(row));
        text += "\n";
    }
    text += "kept: not culled (cubic: found to touch); false +: kept without a collision;\n\
             false −: a collision missed. Times are for one query, in the cache.\n";
    if results.iter().any(|result| !result.method.is_certified()) {
        text += "! not certified: may miss collisions by rounding\n";
    }
    text
}

fn row(result: &QueryResult) -> [String; 8] {
    let mark = if result.method.is_certified() { "" } else { "!" };
    let count = |count: Option<usize>| count.map_or_else(|| "?".to_owned(), grouped);
    let time = result.nanoseconds;
    [
        format!("{}{mark}", result.method),
        grouped(result.positives),
        count(result.truth.map(|truth| truth.false_positives)),
        count(result.truth.map(|truth| truth.false_negatives)),
        three_figures(time.mean),
        three_figures(time.median),
        three_figures(time.p99),
        three_figures(time.max),
    ]
}
