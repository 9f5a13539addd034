//! Writes a comparison as the paper's Table 1, as a page.

use super::number::{ABSENT, counted, three_figures};
use super::page;
use super::paper::{paper_row, printed};
use super::{mesh_size, printable};
use crate::methods::{Preset, Stage};
use crate::study::{Comparison, ComparisonRow, MeanCounts};
use maud::html;

/// The headings of columns under headings of groups. All columns after the first hold numbers.
const COLUMNS: [(&str, &[&str]); 7] = [
    ("", &["Method"]),
    ("Distributed", &["VF", "EE"]),
    ("After boxes", &["VF", "EE"]),
    ("After filter", &["VF", "EE"]),
    ("Contacts", &["VF", "EE"]),
    ("Frames a second", &[""]),
    ("The paper's Table 1", &["VF", "EE", "frames/s"]),
];
/// The column with a bar beside each number.
const FRAMES_PER_SECOND: usize = 8;

/// Returns a method's name, with a dagger if it is reconstructed, and its numbers. They are mean pairs a step after distribution,
/// boxes and filters, contacts, frames a second, and the paper's numbers if it has them. A dash stands for a stage that the
/// method lacks.
fn cells(row: &ComparisonRow) -> (String, Vec<String>) {
    let survivors = |wanted: fn(Stage) -> bool| {
        let last = row.stages.iter().rfind(|stage| wanted(stage.stage));
        last.map(|stage| stage.survivors)
    };
    let after_boxes = match row.has_triangle_pairs {
        true => survivors(Stage::is_box_test),
        false => Some(row.after_boxes),
    };
    let distributed = survivors(|stage| stage == Stage::Distribution);
    let contacts = survivors(|stage| stage == Stage::Elementary);
    let pairs = |counts: Option<MeanCounts>| match counts {
        Some(counts) => [three_figures(counts.vertex_face), three_figures(counts.edge_edge)],
        None => [ABSENT; 2].map(str::to_owned),
    };
    let counts = [distributed, after_boxes, Some(row.candidates), contacts];
    let mut numbers = counts.map(pairs).concat();
    numbers.push(three_figures(row.frames_per_second));
    numbers.extend(printed(row.preset));
    let dagger = if row.preset.is_reconstructed() { " †" } else { "" };
    (format!("{}{dagger}", row.preset), numbers)
}

/// Returns the table as a self-contained page. It highlights `selvedge` and shows a bar beside each rate.
pub fn comparison_html(comparison: &Comparison) -> String {
    let rates = comparison.rows.iter().map(|row| row.frames_per_second);
    let fastest = rates.filter(|rate| rate.is_finite()).fold(0.0, f64::max);
    let title = printable(&format!("Pairs left after each stage, and speed: {}", comparison.name));
    let body = html! {
        header {
            p.kicker { "selvedge compare" }
            h1 { (title) }
            p.lead { (subtitle(comparison)) "." }
        }
        main {
            section {
                div.scroll { table.comparison {
                    thead {
                        tr { @for (group, columns) in COLUMNS { th colspan=(columns.len()) scope="colgroup" { (group) } } }
                        tr { @for column in COLUMNS.iter().flat_map(|(_, columns)| *columns) { th scope="col" { (column) } } }
                    }
                    tbody { @for row in &comparison.rows {
                        @let (name, numbers) = cells(row);
                        tr.ours[row.preset == Preset::Selvedge] {
                            th scope="row" { (name) }
                            @for (index, number) in numbers.iter().enumerate() { td {
                                (number)
                                @if index == FRAMES_PER_SECOND { (page::bar(row.frames_per_second / fastest)) }
                            } }
                        }
                    } }
                } }
                @for note in notes(comparison) { p.note { (note) } }
            }
        }
    };
    page::document(&title, &body)
}

fn subtitle(comparison: &Comparison) -> String {
    let mut subtitle = format!(
        "{}; mean of {}, {}, fastest of {}",
        mesh_size(comparison.vertices, comparison.edges, comparison.triangles),
        counted(comparison.steps, "step"),
        counted(comparison.threads, "thread"),
        counted(comparison.rounds, "round"),
    );
    if let Some(row) = comparison.rows.iter().find(|row| row.has_triangle_pairs) {
        subtitle += &format!("; {} candidate triangle pairs a step", three_figures(row.triangle_pairs));
    }
    subtitle
}

fn notes(comparison: &Comparison) -> Vec<&'static str> {
    let any = |wanted: &dyn Fn(Preset) -> bool| comparison.rows.iter().any(|row| wanted(row.preset));
    let mut notes = vec![
        "VF: vertex–face pairs, EE: edge–edge pairs. After filter: the pairs that reach the elementary test. –: the method has no such stage.",
    ];
    if any(&|preset| paper_row(preset).is_some()) {
        notes.push(
            "The paper's Table 1 counts pairs that reach the elementary test, on its own mesh of 1,345 triangles; its frame rate is a whole simulation's.",
        );
    }
    if any(&Preset::is_reconstructed) {
        notes.push("† Reconstructed: the original could not be read, and no reproduction of it is claimed.");
    }
    notes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::MeanStage;
    use scraper::{Html, Selector};

    fn row(preset: Preset, [vertex_face, edge_edge, frames_per_second]: [f64; 3]) -> ComparisonRow {
        let counts = |times: f64| MeanCounts {
            vertex_face: times * vertex_face,
            edge_edge: times * edge_edge,
        };
        let tests = preset.stages().tests.iter().map(|test| test.stage());
        let stages = [Stage::Distribution].into_iter().chain(tests).chain([Stage::Elementary]);
        let stages = stages.enumerate().map(|(index, stage)| MeanStage {
            stage,
            survivors: counts(1.0 + 0.25 * (4.0 - index as f64)),
            seconds: 0.001,
        });
        ComparisonRow {
            preset,
            triangle_pairs: 8412.0,
            has_triangle_pairs: true,
            broad_phase_seconds: 0.001,
            after_boxes: counts(1.5),
            candidates: counts(1.0),
            contacts: counts(0.5),
            missed: MeanCounts::default(),
            frames_per_second,
            stages: stages.collect(),
        }
    }

    /// Returns the paper's own numbers, with ours better than all of them.
    fn comparison_like_the_papers() -> Comparison {
        let rows = Preset::ALL.into_iter().map(|preset| match paper_row(preset) {
            Some(paper) => row(
                preset,
                [paper.vertex_face.into(), paper.edge_edge.into(), paper.frames_per_second],
            ),
            None => row(preset, [30.0, 100.0, if preset == Preset::Selvedge { 40.0 } else { 20.0 }]),
        });
        Comparison {
            name: "arm".to_owned(),
            vertices: 693,
            edges: 2038,
            triangles: 1345,
            steps: 60,
            threads: 1,
            rounds: 3,
            rows: rows.collect(),
        }
    }

    /// Returns the texts of all such elements of the page, whose markup must be without errors.
    fn texts(html: &str, selector: &str) -> Vec<String> {
        let page = Html::parse_document(html);
        assert!(page.errors.is_empty(), "{:?}", page.errors);
        let selector = Selector::parse(selector).unwrap();
        let found = page.select(&selector);
        found.map(|element| element.text().collect()).collect()
    }

    #[test]
    fn the_page_has_every_methods_numbers_and_the_papers_and_ours_is_highlighted() {
        let html = comparison_html(&comparison_like_the_papers());
        let cells = texts(&html, "tbody tr > *");
        assert_eq!(cells.len(), 13 * Preset::ALL.len());
        assert_eq!(texts(&html, "thead tr:last-child th").len(), 13);
        let lead = "693 vertices, 2,038 edges, 1,345 triangles; mean of 60 steps, 1 thread, fastest of 3 rounds; \
                    8,412 candidate triangle pairs a step.";
        assert_eq!(texts(&html, ".lead"), [lead]);
        // The paper's numbers are in the last three columns.
        for (method, paper) in [("lv_2014", "3113734.22"), ("basic", "1,1222,05612.70")] {
            let rows = texts(&html, "tbody tr");
            assert!(
                rows.iter().any(|row| row.starts_with(method) && row.ends_with(paper)),
                "{rows:?}"
            );
        }
        assert_eq!(texts(&html, ".ours > th"), ["selvedge"]);
    }

    #[test]
    fn notes_and_dashes_are_there_only_where_they_mean_something() {
        let mut comparison = comparison_like_the_papers();
        assert!(comparison_html(&comparison).contains("† Reconstructed"));
        comparison.rows.retain(|row| row.preset == Preset::Curtis2008);
        let html = comparison_html(&comparison);
        assert!(!html.contains("† Reconstructed"));
        assert_eq!(texts(&html, "td").iter().filter(|&text| text == ABSENT).count(), 2);
    }

    #[test]
    fn odd_names_and_rates_are_shown_safely() {
        let mut comparison = comparison_like_the_papers();
        comparison.name = "a<b> & \"c\" x\u{0}y]]></title>".to_owned();
        comparison.rows.truncate(1);
        for rate in [f64::NAN, f64::INFINITY, 0.0] {
            comparison.rows[0].frames_per_second = rate;
            let html = comparison_html(&comparison);
            let title = "Pairs left after each stage, and speed: a<b> & \"c\" x\u{fffd}y]]></title>";
            assert_eq!(texts(&html, "h1"), [title]);
            assert!(html.contains("style=\"--share:0.0000\""));
        }
    }
}
