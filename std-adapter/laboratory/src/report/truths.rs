//! Writes the simulation's errors against laws as a page.

use super::number::{share, three_figures, time};
use super::page::document;
use super::plot::{convergence_svg, cost_of_accuracy_svg, cost_of_law_svg, truth_svg};
use super::prior::PriorRuns;
use crate::truths::{ErrorUnit, Law, LawRuns, Measured};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, html};

/// Writes an error of a law: as a share, or with its unit.
pub(super) fn error(law: &Law, error: f64) -> String {
    match law.error {
        ErrorUnit::Of(_) => share(error),
        ErrorUnit::In(unit) => format!("{} {unit}", three_figures(error)),
    }
}

/// Returns a self-contained page: each law with its plots and errors, and all errors against the time of a run. The runs of
/// another revision have lines of their own, and a table.
#[must_use]
pub fn truths_html(all: &[LawRuns], prior: Option<&PriorRuns>) -> String {
    let body = html! {
        header {
            p.kicker { "selvedge truths" }
            h1 { "The cloth simulation against laws" }
            p.lead { "Each law has a known answer. Errors are the largest difference from it, in steps of 1 and 4 ms and by frames of 1/60 s, on up to four meshes. All settings are the defaults." }
        }
        main {
            @if all.len() > 1 {
                section {
                    h2 { "What accuracy costs in time" }
                    (picture(&cost_of_accuracy_svg(all), "errors of all laws on their finest mesh against the time of a run on one thread"))
                }
            }
            @if let Some(prior) = prior { (beside(all, prior)) }
            @for runs in all { (law(runs, prior)) }
        }
        footer { p { "Written by selvedge " (env!("CARGO_PKG_VERSION")) ". This file is self-contained: it loads nothing." } }
    };
    document("The cloth simulation against laws", &body)
}

fn law(runs: &LawRuns, prior: Option<&PriorRuns>) -> Markup {
    let law = runs.law;
    let unit = match law.error {
        ErrorUnit::Of(quantity) => format!("error over {quantity}"),
        ErrorUnit::In(unit) => format!("error in {unit}"),
    };
    let cell = |run: &Measured| {
        let beyond = run.unpredicted().map(|own| format!(" ({})", error(law, own)));
        html! { td { (error(law, run.error())) (beyond.unwrap_or_default()) } td { (time(run.seconds)) } }
    };
    html! {
        section {
            h2 { (law.name.replace('_', " ")) }
            p { (law.statement) "." }
            div.pairs {
                (picture(&truth_svg(runs), "simulation and law, on the finest mesh"))
                (picture(&convergence_svg(runs), "error against time step and mesh"))
            }
            (picture(&cost_of_law_svg(runs, prior), "error against the time of a run on one thread, at each pace, on regular meshes from coarse to fine"))
            div.scroll { table {
                thead { tr {
                    th scope="col" { (law.mesh) } th scope="col" { "accuracy" }
                    @for run in runs.by_accuracy().next().unwrap_or_default() {
                        th scope="col" { (unit) ", " (run.conditions.pace) } th scope="col" { "time" }
                    }
                } }
                tbody { @for own in runs.by_accuracy() { tr {
                    th scope="row" { (own[0].conditions.grid) } th scope="row" { (own[0].conditions.accuracy.name()) }
                    @for run in own { (cell(run)) }
                } } }
            } }
            @if runs.runs.iter().any(|run| run.unpredicted().is_some()) {
                p.note { "In brackets: the error beyond the time stepping's own, which is known in closed form." }
            }
            p.note { (law.remark) }
        }
    }
}

/// Returns a table of the errors and times of another revision, and those of this one, on the finest mesh of each law.
fn beside(all: &[LawRuns], prior: &PriorRuns) -> Markup {
    let rows = all.iter().flat_map(|runs| {
        let own = runs.by_mesh().next_back().unwrap_or_default().iter();
        own.filter_map(|run| {
            let grid = run.conditions.grid;
            let pace = run.conditions.pace.to_string();
            let before = { prior.on(runs.law.name, grid.number, grid.is_irregular) }.find(|before| before.pace == pace)?;
            Some((runs.law, run, before))
        })
    });
    let titles = [
        "law",
        "pace",
        "accuracy",
        "error before",
        "error now",
        "time before",
        "time now over before",
    ];
    html! {
        section {
            h2 { "Beside another revision" }
            p { "On the finest mesh of each law." }
            div.scroll { table {
                thead { tr { @for title in titles { th scope="col" { (title) } } } }
                tbody { @for (law, run, before) in rows { tr {
                    th scope="row" { (law.name.replace('_', " ")) }
                    td { (run.conditions.pace) } td { (run.conditions.accuracy.name()) }
                    td { (error(law, before.error)) } td { (error(law, run.error())) }
                    td { (time(before.seconds)) } td { (three_figures(run.seconds / before.seconds)) }
                } } }
            } }
        }
    }
}

fn picture(svg: &str, meaning: &str) -> Markup {
    let data = format!("data:image/svg+xml;base64,{}", STANDARD.encode(svg));
    html! { figure { img src=(data) alt=(meaning); figcaption { (meaning) } } }
}
