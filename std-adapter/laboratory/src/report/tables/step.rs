use super::table;
use crate::methods::{CullingTest, ElementaryTest, Stage};
use crate::report::number::{counted, grouped, time};
use crate::report::{StepQuestion, StepSummary, mesh_size};

/// Returns the pairs after each stage of one step, and the times.
pub fn step(summary: &StepSummary) -> String {
    let report = &summary.report;
    let pairs = report.broad_phase_pairs;
    let broad_phase = [
        Stage::BroadPhase.to_string(),
        match pairs {
            None => grouped(report.triangle_pairs),
            Some(_) => String::new(),
        },
        pairs.map_or_else(String::new, |pairs| grouped(pairs.vertex_face)),
        pairs.map_or_else(String::new, |pairs| grouped(pairs.edge_edge)),
        time(report.broad_phase_seconds),
    ];
    let stages = report.stages.iter().map(|stage| {
        [
            stage.stage.to_string(),
            String::new(),
            grouped(stage.survivors.vertex_face),
            grouped(stage.survivors.edge_edge),
            time(stage.seconds),
        ]
    });
    let whole = [
        "whole step".to_owned(),
        String::new(),
        String::new(),
        String::new(),
        time(report.seconds),
    ];
    let header = ["stage", "triangle pairs", "VF pairs", "EE pairs", "time"];
    let rows = [broad_phase].into_iter().chain(stages).chain([whole]);
    let sums = if summary.threads == 1 {
        ""
    } else {
        "Times of stages are summed over threads.\n"
    };
    format!(
        "{}\n{} in {} on {}\n\n{}\n{sums}\
         {}",
        mesh_size(summary.vertices, summary.edges, summary.triangles),
        summary.preset,
        summary.scalar,
        counted(summary.threads, "thread"),
        table(header, rows),
        answer(summary),
    )
}

fn answer(summary: &StepSummary) -> String {
    let contacts = summary.report.contacts();
    match (summary.question, summary.earliest) {
        (StepQuestion::Candidates, _) => "All other pairs are certainly apart throughout the step.\n".to_owned(),
        (StepQuestion::Earliest, None) => "The step is certainly free of contact.\n".to_owned(),
        (StepQuestion::Earliest, Some(time)) => format!(
            "The earliest contact is at t = {time:.6}, certainly none before.\n\
             Counts are of the part of the step in which it was found.\n"
        ),
        (StepQuestion::Contacts, first) => {
            let first = first.map_or_else(String::new, |time| format!(", the first at t = {time:.6}"));
            format!(
                "Contacts: {} vertex–face and {} edge–edge{first}.\n{}",
                grouped(contacts.vertex_face),
                grouped(contacts.edge_edge),
                promise(summary),
            )
        }
    }
}

/// Returns the guarantee behind the counts.
fn promise(summary: &StepSummary) -> &'static str {
    let stages = summary.preset.stages();
    let tests_are_certified = stages.tests.iter().copied().all(CullingTest::is_certified);
    match (tests_are_certified, stages.elementary) {
        (true, ElementaryTest::Exact) => "No contact is missed, none is false, and no time is too late: the verdict is exact.\n",
        (true, ElementaryTest::TimeOfImpact) => "No contact is missed, and no time is too late: every stage is certified.\n",
        (true, _) => "The plain cubic elementary test can miss contacts; the stages before it cannot.\n",
        (false, ElementaryTest::TimeOfImpact | ElementaryTest::Exact) => {
            "The plain filter can miss contacts; the elementary test cannot.\n"
        }
        (false, _) => "The plain filter and the plain cubic elementary test can both miss contacts.\n",
    }
}
