//! The paper's Table 1 from our run: as a page, and as Markdown.

use super::findings::findings;
use super::number::{ABSENT, counted, figures, mean};
use super::page;
use super::paper::{paper_row, printed};
use super::{mesh_size, printable};
use crate::methods::{Preset, Stage};
use crate::study::{Comparison, ComparisonRow, MeanCounts};
use maud::html;

/// Headings of columns under headings of groups. After the first column all are numbers.
const COLUMNS: [(&str, &[&str]); 7] = [
    ("", &["Method"]),
    ("Distributed", &["VF", "EE"]),
    ("After boxes", &["VF", "EE"]),
    ("After filter", &["VF", "EE"]),
    ("Contacts", &["VF", "EE"]),
    ("Frames a second", &[""]),
    ("The paper's Table 1", &["VF", "EE", "frames/s"]),
];
/// Which number has a bar beside it.
const FRAMES_PER_SECOND: usize = 8;

/// A method's name, with a dagger if it is reconstructed, and its numbers: mean pairs a step after distribution, boxes and filters,
/// contacts, frames a second, and the paper's numbers where it has them. What a method has no stage for is a dash.
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
        Some(counts) => [mean(counts.vertex_face), mean(counts.edge_edge)],
        None => [ABSENT; 2].map(str::to_owned),
    };
    let counts = [distributed, after_boxes, Some(row.candidates), contacts];
    let mut numbers = counts.map(pairs).concat();
    numbers.push(figures(row.frames_per_second));
    numbers.extend(printed(row.preset));
    let dagger = if row.preset.is_reconstructed() { " †" } else { "" };
    (format!("{}{dagger}", row.preset), numbers)
}

/// The table as a page that needs nothing else, `selvedge` highlighted, a bar beside each rate; below it what the numbers say.
#[must_use]
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
            section {
                h2 { "What the numbers say" }
                ul { @for finding in findings(comparison) { li.unexpected[!finding.as_expected] { (finding.text) } } }
            }
        }
    };
    page::document(&title, &body)
}

/// The table as Markdown, `selvedge` in bold.
#[must_use]
pub fn comparison_markdown(comparison: &Comparison) -> String {
    let heading = |(group, columns): (&str, &[&str])| {
        let group = (group != COLUMNS[0].0).then(|| format!("{group}: "));
        let group = group.unwrap_or_default();
        let columns = columns.iter().enumerate().map(|(index, column)| match index {
            0 => format!("{group}{column}").trim_end_matches(": ").to_owned(),
            _ => (*column).to_owned(),
        });
        columns.collect::<Vec<_>>()
    };
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let header: Vec<String> = COLUMNS.into_iter().flat_map(heading).collect();
    let mut text = line(&header) + "|---" + &"|--:".repeat(header.len() - 1) + "|\n";
    for row in &comparison.rows {
        let (name, numbers) = cells(row);
        let is_ours = row.preset == Preset::Selvedge;
        let emphasised = |cell: String| match is_ours && !cell.is_empty() && cell != ABSENT {
            true => format!("**{cell}**"),
            false => cell,
        };
        text += &line(&[name].into_iter().chain(numbers).map(emphasised).collect::<Vec<_>>());
    }
    let notes = notes(comparison).join(" ");
    format!("{text}\n{}. {notes}\n", subtitle(comparison))
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
        subtitle += &format!("; {} candidate triangle pairs a step", mean(row.triangle_pairs));
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

    /// A row of which every number is different from every other row's.
    fn row(preset: Preset, scale: f64) -> ComparisonRow {
        let counts = |share: f64| MeanCounts {
            vertex_face: (scale * share).round(),
            edge_edge: (1.5 * scale * share).round(),
        };
        let tests = preset.stages().tests.iter().map(|test| test.stage());
        let stages = [Stage::Distribution].into_iter().chain(tests).chain([Stage::Elementary]);
        let stages: Vec<MeanStage> = stages
            .enumerate()
            .map(|(index, stage)| MeanStage {
                stage,
                survivors: counts(1.0 / (1.0 + index as f64)),
                seconds: 0.001,
            })
            .collect();
        let last = |wanted: &dyn Fn(Stage) -> bool| stages.iter().rfind(|stage| wanted(stage.stage)).unwrap().survivors;
        ComparisonRow {
            preset,
            triangle_pairs: 8412.0,
            has_triangle_pairs: true,
            broad_phase_seconds: 0.001,
            after_boxes: last(&|stage| stage == Stage::Distribution || stage.is_box_test()),
            candidates: last(&|stage| stage != Stage::Elementary),
            contacts: last(&|stage| stage == Stage::Elementary),
            missed: MeanCounts::default(),
            frames_per_second: 0.01 * scale,
            stages,
        }
    }

    fn comparison(name: &str, rows: Vec<ComparisonRow>) -> Comparison {
        Comparison {
            name: name.to_owned(),
            vertices: 693,
            edges: 2038,
            triangles: 1345,
            steps: 60,
            threads: 1,
            rounds: 3,
            rows,
        }
    }

    fn every_preset(scale: f64) -> Comparison {
        let rows = Preset::ALL.iter().enumerate();
        let rows = rows.map(|(index, &preset)| row(preset, scale / (1.0 + index as f64)));
        comparison("arm", rows.collect())
    }

    /// The texts of all such elements of the page, which has no error in its markup.
    fn texts(html: &str, selector: &str) -> Vec<String> {
        let page = Html::parse_document(html);
        assert!(page.errors.is_empty(), "{:?}", page.errors);
        let selector = Selector::parse(selector).unwrap();
        let found = page.select(&selector);
        found.map(|element| element.text().collect()).collect()
    }

    #[test]
    fn every_name_and_number_is_in_the_page_and_in_the_markdown() {
        let comparison = every_preset(98_765.0);
        let html = comparison_html(&comparison);
        let on_page = texts(&html, "tbody tr > *");
        let markdown = comparison_markdown(&comparison);
        let in_markdown: Vec<&str> = markdown
            .split(['|', '\n'])
            .map(|cell| cell.trim().trim_matches('*'))
            .collect();
        let has = |text: &str| on_page.iter().any(|found| found == text) && in_markdown.contains(&text);
        for row in &comparison.rows {
            let name = row.preset.name();
            let dagger = format!("{name} †");
            assert!(has(if row.preset.is_reconstructed() { &dagger } else { name }), "{name}");
            assert!(has(&figures(row.frames_per_second)));
            let shown = |stage: &&MeanStage| stage.stage != Stage::Boxes || row.after_boxes == stage.survivors;
            for MeanStage { stage, survivors, .. } in row.stages.iter().filter(shown) {
                let numbers = [mean(survivors.vertex_face), mean(survivors.edge_edge)];
                assert!(numbers.iter().all(|number| has(number)), "{name} {stage}");
            }
        }
        for printed in [
            "1,122", "2,056", "12.70", "74", "475", "32.00", "44", "338", "37.54", "31", "137", "34.22",
        ] {
            assert!(has(printed), "the paper's {printed}");
        }
        let subtitle = "693 vertices, 2,038 edges, 1,345 triangles; mean of 60 steps, 1 thread, fastest of 3 rounds; 8,412 candidate triangle pairs a step.";
        assert_eq!(texts(&html, ".lead"), [subtitle]);
        assert!(markdown.contains(subtitle), "{markdown}");
    }

    #[test]
    fn every_row_has_a_cell_in_every_column() {
        let markdown = comparison_markdown(&every_preset(1e4));
        let cells: Vec<_> = { markdown.lines().take(2 + Preset::ALL.len()) }
            .map(|line| line.matches('|').count() - 1)
            .collect();
        assert!(cells.iter().all(|&count| count == 13), "{markdown}");
        assert!(markdown.starts_with("| Method | Distributed: VF | EE |"), "{markdown}");
        assert!(
            markdown.contains("| Frames a second | The paper's Table 1: VF | EE | frames/s |"),
            "{markdown}"
        );
        let html = comparison_html(&every_preset(1e4));
        assert_eq!(texts(&html, "thead tr:last-child th").len(), 13);
        assert_eq!(texts(&html, "tbody tr > *").len(), 13 * Preset::ALL.len());
    }

    #[test]
    fn a_stage_that_a_method_lacks_is_a_dash() {
        let dashes = |preset| {
            let html = comparison_html(&comparison("arm", vec![row(preset, 1e4)]));
            texts(&html, "td").iter().filter(|&text| text == ABSENT).count()
        };
        assert_eq!([Preset::Curtis2008, Preset::Tang2010, Preset::Lv2014].map(dashes), [2, 2, 0]);
    }

    #[test]
    fn our_row_alone_is_highlighted() {
        let mut comparison = every_preset(1e4);
        assert_eq!(texts(&comparison_html(&comparison), ".ours > th"), ["selvedge"]);
        // Its name and seven numbers: it has no box test, and is not in the paper's table.
        assert_eq!(comparison_markdown(&comparison).matches("| **").count(), 8);
        comparison.rows.retain(|row| row.preset != Preset::Selvedge);
        assert_eq!(texts(&comparison_html(&comparison), ".ours").len(), 0);
        assert!(!comparison_markdown(&comparison).contains("**"));
    }

    #[test]
    fn the_dagger_is_explained_only_where_there_is_one() {
        let has_dagger = |presets: &[Preset]| {
            let rows = presets.iter().map(|&preset| row(preset, 1e4)).collect();
            let comparison = comparison("arm", rows);
            [comparison_html(&comparison), comparison_markdown(&comparison)].map(|text| text.contains("† Reconstructed"))
        };
        assert_eq!(has_dagger(&[Preset::TangC2010]), [true; 2]);
        assert_eq!(has_dagger(&[Preset::Lv2014]), [false; 2]);
    }

    #[test]
    fn any_name_is_written_as_it_is_but_for_control_characters() {
        for (name, expected) in [
            ("a<b> & \"c\" ']]></title>", "a<b> & \"c\" ']]></title>"),
            ("x\u{0}y\u{1b}[1m", "x\u{fffd}y\u{fffd}[1m"),
        ] {
            let html = comparison_html(&comparison(name, Vec::new()));
            let title = format!("Pairs left after each stage, and speed: {expected}");
            assert_eq!(texts(&html, "h1"), [title]);
        }
    }

    #[test]
    fn rates_that_are_no_numbers_have_an_empty_bar() {
        for frames_per_second in [f64::NAN, f64::INFINITY, 0.0] {
            let row = ComparisonRow {
                frames_per_second,
                ..row(Preset::Basic, 1e4)
            };
            let html = comparison_html(&comparison("arm", vec![row]));
            assert!(html.contains("style=\"--share:0.0000\""));
        }
    }
}
