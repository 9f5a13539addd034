//! The comparison of methods as a picture of a table.

use super::number::{grouped, mean, rate};
use super::paper::paper_row;
use crate::pipeline::{Preset, Stage};
use crate::study::{Comparison, ComparisonRow, MeanCounts};
use svg::node::element::{Group, Line, Rectangle, Text};
use svg::{Document, Node};

// Lengths in pixels, at the picture's own size.
pub(super) const FONT: &str = "system-ui, -apple-system, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif";
const FONT_SIZE: f64 = 13.0;
/// What a letter or digit takes at most on average, in the widest of the fonts above.
const LETTER: f64 = 7.9;
/// The same for a sentence, for each pixel of font size.
const PROSE_LETTER: f64 = 0.54;
const TITLE_SIZE: f64 = 16.0;
const SUBTITLE_SIZE: f64 = 12.0;
const NOTE_SIZE: f64 = 11.5;
const MARGIN: f64 = 20.0;
const COLUMN_GAP: f64 = 14.0;
const GROUP_GAP: f64 = 26.0;
const ROW_HEIGHT: f64 = 26.0;
const BAR_WIDTH: f64 = 90.0;
const BAR_HEIGHT: f64 = 12.0;
/// From a row's middle down to the baseline of its text.
const BASELINE: f64 = 4.5;

pub(super) const PAPER_WHITE: &str = "#fdfdfc";
pub(super) const INK: &str = "#1f2328";
pub(super) const FAINT_INK: &str = "#656d76";
pub(super) const RULE: &str = "#d0d7de";
const HIGHLIGHT: &str = "#ddeeff";
const BAR: &str = "#9aa7b4";
const BAR_HIGHLIGHT: &str = "#0b63ce";

const ABSENT: &str = "–";

/// The paper's Table 1 from our run, as an SVG picture with its own light background.
///
/// One row for each method, in the order of [`Comparison::rows`]: mean pairs a step after distribution, boxes and
/// filters, contacts, frames a second with a bar, and the paper's numbers where it has them. `selvedge` is highlighted,
/// reconstructed methods carry a dagger, and what a method has no stage for is a dash.
#[must_use]
pub fn comparison_svg(comparison: &Comparison) -> String {
    let groups = column_groups(comparison);
    let table = Table::place(&groups, comparison);
    let mut picture = Group::new()
        .set("font-family", FONT)
        .set("font-size", FONT_SIZE)
        .set("fill", INK)
        .set("style", "font-variant-numeric: tabular-nums");
    table.draw_title(&mut picture, comparison);
    table.draw_highlight(&mut picture, comparison);
    for placed in &table.groups {
        table.draw_group(&mut picture, placed, comparison);
    }
    table.draw_notes(&mut picture);
    let background = Rectangle::new()
        .set("width", "100%")
        .set("height", "100%")
        .set("fill", PAPER_WHITE);
    let (width, height) = (table.width.ceil(), table.height().ceil());
    let document = Document::new()
        .set("viewBox", (0, 0, width, height))
        .set("width", width)
        .set("height", height)
        .set("role", "img")
        .add(background)
        .add(picture);
    document.to_string()
}

/// Columns under one heading.
struct ColumnGroup {
    heading: &'static str,
    columns: Vec<Column>,
}

struct Column {
    heading: &'static str,
    content: Content,
}

enum Content {
    /// Aligned to the left.
    Names(Vec<String>),
    /// Aligned to the right.
    Numbers(Vec<String>),
    /// From 0 to 1.
    Bars(Vec<f64>),
}

impl Column {
    fn width(&self) -> f64 {
        let longest = |cells: &[String]| cells.iter().map(|cell| text_width(cell)).fold(0.0, f64::max);
        match &self.content {
            Content::Names(cells) | Content::Numbers(cells) => longest(cells).max(text_width(self.heading)),
            Content::Bars(_) => BAR_WIDTH,
        }
    }
}

fn text_width(text: &str) -> f64 {
    text.chars().count() as f64 * LETTER
}

pub(super) fn prose_width(text: &str, size: f64) -> f64 {
    text.chars().count() as f64 * PROSE_LETTER * size
}

fn column_groups(comparison: &Comparison) -> Vec<ColumnGroup> {
    let rows = &comparison.rows;
    let numbers = |heading, cell: &dyn Fn(&ComparisonRow) -> String| Column {
        heading,
        content: Content::Numbers(rows.iter().map(cell).collect()),
    };
    let pairs = |heading, counts: &dyn Fn(&ComparisonRow) -> Option<MeanCounts>| ColumnGroup {
        heading,
        columns: vec![
            numbers("VF", &|row| {
                counts(row).map_or(ABSENT.to_owned(), |counts| mean(counts.vertex_face))
            }),
            numbers("EE", &|row| {
                counts(row).map_or(ABSENT.to_owned(), |counts| mean(counts.edge_edge))
            }),
        ],
    };
    let name = |row: &ComparisonRow| {
        let dagger = if row.preset.is_reconstructed() { " †" } else { "" };
        format!("{}{dagger}", row.preset)
    };
    let fastest = rows
        .iter()
        .map(|row| row.frames_per_second)
        .filter(|rate| rate.is_finite())
        .fold(0.0, f64::max);
    let bar = |row: &ComparisonRow| {
        let share = row.frames_per_second / fastest;
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    };
    let paper =
        |cell: fn(super::PaperRow) -> String| move |row: &ComparisonRow| paper_row(row.preset).map_or(String::new(), cell);
    vec![
        ColumnGroup {
            heading: "",
            columns: vec![Column {
                heading: "Method",
                content: Content::Names(rows.iter().map(name).collect()),
            }],
        },
        pairs("Distributed", &|row| survivors(row, |stage| stage == Stage::Distribution)),
        pairs("After boxes", &|row| {
            if row.has_triangle_pairs {
                survivors(row, Stage::is_box_test)
            } else {
                Some(row.after_boxes)
            }
        }),
        pairs("After filter", &|row| Some(row.candidates)),
        pairs("Contacts", &|row| survivors(row, |stage| stage == Stage::Elementary)),
        ColumnGroup {
            heading: "Frames a second",
            columns: vec![
                numbers("", &|row| rate(row.frames_per_second)),
                Column {
                    heading: "",
                    content: Content::Bars(rows.iter().map(bar).collect()),
                },
            ],
        },
        ColumnGroup {
            heading: "The paper's Table 1",
            columns: vec![
                numbers("VF", &paper(|row| grouped(row.vertex_face.into()))),
                numbers("EE", &paper(|row| grouped(row.edge_edge.into()))),
                numbers("frames/s", &paper(|row| format!("{:.2}", row.frames_per_second))),
            ],
        },
    ]
}

/// What the last of the wanted stages passed on, if the method has one.
fn survivors(row: &ComparisonRow, wanted: impl Fn(Stage) -> bool) -> Option<MeanCounts> {
    let last = row.stages.iter().rfind(|stage| wanted(stage.stage))?;
    Some(last.survivors)
}

/// A group of columns in its place from left to right.
struct PlacedGroup<'a> {
    group: &'a ColumnGroup,
    left: f64,
    right: f64,
    /// Left and right of each column.
    columns: Vec<[f64; 2]>,
}

struct Table<'a> {
    groups: Vec<PlacedGroup<'a>>,
    title: String,
    subtitle: String,
    notes: Vec<&'static str>,
    rows: usize,
    width: f64,
}

/// Where the two lines of headings are.
const HEADINGS: [f64; 2] = [76.0, 100.0];
const HEADINGS_END: f64 = 114.0;
const NOTE_HEIGHT: f64 = 19.0;

impl<'a> Table<'a> {
    fn place(groups: &'a [ColumnGroup], comparison: &Comparison) -> Self {
        let mut x = MARGIN;
        let mut placed = Vec::with_capacity(groups.len());
        for group in groups {
            let widths: Vec<f64> = group.columns.iter().map(Column::width).collect();
            let gaps = COLUMN_GAP * (widths.len() - 1) as f64;
            let missing = text_width(group.heading) - widths.iter().sum::<f64>() - gaps;
            let left = x;
            x += missing.max(0.0);
            let mut columns = Vec::with_capacity(widths.len());
            for width in widths {
                columns.push([x, x + width]);
                x += width + COLUMN_GAP;
            }
            x -= COLUMN_GAP;
            placed.push(PlacedGroup {
                group,
                left,
                right: x,
                columns,
            });
            x += GROUP_GAP;
        }
        let (title, subtitle) = (title(comparison), subtitle(comparison));
        let notes = notes(comparison);
        // Bold letters are wider.
        let lines = [(&*title, 1.15 * TITLE_SIZE), (&*subtitle, SUBTITLE_SIZE)];
        let lines = lines
            .into_iter()
            .chain(notes.iter().map(|&note| (note, NOTE_SIZE)))
            .map(|(line, size)| 2.0 * MARGIN + prose_width(line, size));
        Self {
            width: lines.fold(x - GROUP_GAP + MARGIN, f64::max),
            groups: placed,
            title,
            subtitle,
            notes,
            rows: comparison.rows.len(),
        }
    }

    fn rows_end(&self) -> f64 {
        HEADINGS_END + ROW_HEIGHT * self.rows as f64
    }

    fn height(&self) -> f64 {
        self.rows_end() + NOTE_HEIGHT * self.notes.len() as f64 + MARGIN
    }

    fn draw_title(&self, picture: &mut Group, comparison: &Comparison) {
        debug_assert_eq!(comparison.rows.len(), self.rows);
        let title = text(MARGIN, 30.0, "start", &self.title);
        picture.append(title.set("font-size", TITLE_SIZE).set("font-weight", 600));
        let subtitle = text(MARGIN, 50.0, "start", &self.subtitle);
        picture.append(subtitle.set("font-size", SUBTITLE_SIZE).set("fill", FAINT_INK));
    }

    fn draw_highlight(&self, picture: &mut Group, comparison: &Comparison) {
        for (row, _) in highlighted(comparison).filter(|&(_, highlighted)| highlighted) {
            let band = Rectangle::new()
                .set("x", MARGIN - 8.0)
                .set("y", HEADINGS_END + ROW_HEIGHT * row as f64)
                .set("width", self.width - 2.0 * MARGIN + 16.0)
                .set("height", ROW_HEIGHT)
                .set("rx", 4)
                .set("fill", HIGHLIGHT);
            picture.append(band);
        }
        for y in [HEADINGS_END, self.rows_end()] {
            picture.append(rule(MARGIN, self.width - MARGIN, y));
        }
    }

    fn draw_group(&self, picture: &mut Group, placed: &PlacedGroup<'_>, comparison: &Comparison) {
        if !placed.group.heading.is_empty() {
            let middle = 0.5 * (placed.left + placed.right);
            let heading = text(middle, HEADINGS[0], "middle", placed.group.heading);
            picture.append(heading.set("font-weight", 600));
            picture.append(rule(placed.left, placed.right, HEADINGS[0] + 7.0));
        }
        for (column, &[left, right]) in placed.group.columns.iter().zip(&placed.columns) {
            let (x, anchor) = match column.content {
                Content::Names(_) => (left, "start"),
                Content::Numbers(_) | Content::Bars(_) => (right, "end"),
            };
            if !column.heading.is_empty() {
                let heading = text(x, HEADINGS[1], anchor, column.heading);
                picture.append(heading.set("fill", FAINT_INK));
            }
            for (row, highlighted) in highlighted(comparison) {
                let middle = HEADINGS_END + ROW_HEIGHT * (row as f64 + 0.5);
                match &column.content {
                    Content::Names(cells) | Content::Numbers(cells) if !cells[row].is_empty() => {
                        let cell = text(x, middle + BASELINE, anchor, &cells[row]);
                        picture.append(cell.set("font-weight", if highlighted { 700 } else { 400 }));
                    }
                    Content::Names(_) | Content::Numbers(_) => {}
                    Content::Bars(shares) => picture.append(
                        Rectangle::new()
                            .set("x", left)
                            .set("y", middle - 0.5 * BAR_HEIGHT)
                            .set("width", round(shares[row] * BAR_WIDTH))
                            .set("height", BAR_HEIGHT)
                            .set("rx", 2)
                            .set("fill", if highlighted { BAR_HIGHLIGHT } else { BAR }),
                    ),
                }
            }
        }
    }

    fn draw_notes(&self, picture: &mut Group) {
        for (line, note) in self.notes.iter().enumerate() {
            let y = self.rows_end() + NOTE_HEIGHT * (line as f64 + 1.0);
            let note = text(MARGIN, y, "start", note);
            picture.append(note.set("font-size", NOTE_SIZE).set("fill", FAINT_INK));
        }
    }
}

/// Each row, and whether it is ours.
fn highlighted(comparison: &Comparison) -> impl Iterator<Item = (usize, bool)> {
    let presets = comparison.rows.iter().map(|row| row.preset);
    presets.map(|preset| preset == Preset::Selvedge).enumerate()
}

fn title(comparison: &Comparison) -> String {
    format!("Pairs left after each stage, and speed: {}", comparison.name)
}

fn subtitle(comparison: &Comparison) -> String {
    let number = |count: usize| grouped(count as u64);
    let s = |count| if count == 1 { "" } else { "s" };
    let Comparison {
        steps, threads, rounds, ..
    } = *comparison;
    let mut subtitle = format!(
        "{} vertices, {} edges, {} triangles; mean of {} step{}, {threads} thread{}, fastest of {rounds} round{}",
        number(comparison.vertices),
        number(comparison.edges),
        number(comparison.triangles),
        number(steps),
        s(steps),
        s(threads),
        s(rounds),
    );
    let with_triangle_pairs = |row: &&ComparisonRow| row.has_triangle_pairs;
    if let Some(row) = comparison.rows.iter().find(with_triangle_pairs) {
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

fn text(x: f64, y: f64, anchor: &str, content: &str) -> Text {
    // XML has no way to write a control character, and a file's name may hold one.
    let content = content.replace(|c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'), "\u{fffd}");
    Text::new(content)
        .set("x", round(x))
        .set("y", round(y))
        .set("text-anchor", anchor)
}

fn rule(left: f64, right: f64, y: f64) -> Line {
    Line::new()
        .set("x1", round(left))
        .set("x2", round(right))
        .set("y1", round(y))
        .set("y2", round(y))
        .set("stroke", RULE)
}

/// To a tenth of a pixel, to keep the file short.
fn round(length: f64) -> f64 {
    (length * 10.0).round() / 10.0
}

#[cfg(test)]
mod tests {
    use super::super::svg_texts::texts;
    use super::*;
    use crate::study::MeanStage;
    use proptest::prelude::*;
    use roxmltree::{Document, Node};

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

    fn fills(svg: &str, colour: &str) -> usize {
        let document = Document::parse(svg).unwrap();
        document
            .descendants()
            .filter(|node| node.attribute("fill") == Some(colour))
            .count()
    }

    #[test]
    fn every_name_and_number_is_in_the_picture() {
        let comparison = every_preset(98_765.0);
        let texts = texts(&comparison_svg(&comparison));
        let has = |text: &str| texts.iter().any(|found| found == text);
        for row in &comparison.rows {
            let name = row.preset.name();
            let dagger = format!("{name} †");
            assert!(has(if row.preset.is_reconstructed() { &dagger } else { name }), "{name}");
            assert!(has(&rate(row.frames_per_second)));
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
        let subtitle = "693 vertices, 2,038 edges, 1,345 triangles; mean of 60 steps, 1 thread, fastest of 3 rounds; 8,412 candidate triangle pairs a step";
        assert!(has(subtitle), "{texts:?}");
    }

    #[test]
    fn a_stage_that_a_method_lacks_is_a_dash() {
        let dashes = |preset| {
            let svg = comparison_svg(&comparison("arm", vec![row(preset, 1e4)]));
            texts(&svg).iter().filter(|&text| text == ABSENT).count()
        };
        assert_eq!([Preset::Curtis2008, Preset::Tang2010, Preset::Lv2014].map(dashes), [2, 2, 0]);
    }

    #[test]
    fn our_row_alone_is_highlighted() {
        let mut comparison = every_preset(1e4);
        assert_eq!(fills(&comparison_svg(&comparison), HIGHLIGHT), 1);
        comparison.rows.retain(|row| row.preset != Preset::Selvedge);
        assert_eq!(fills(&comparison_svg(&comparison), HIGHLIGHT), 0);
    }

    #[test]
    fn the_dagger_is_explained_only_where_there_is_one() {
        let has_dagger = |presets: &[Preset]| {
            let rows = presets.iter().map(|&preset| row(preset, 1e4)).collect();
            comparison_svg(&comparison("arm", rows)).contains("† Reconstructed")
        };
        assert!(has_dagger(&[Preset::TangC2010]));
        assert!(!has_dagger(&[Preset::Lv2014]));
    }

    #[test]
    fn any_name_is_written_as_it_is_but_for_control_characters() {
        for (name, expected) in [
            ("a<b> & \"c\" ']]>", "a<b> & \"c\" ']]>"),
            ("x\u{0}y\u{1b}[1m", "x\u{fffd}y\u{fffd}[1m"),
        ] {
            let texts = texts(&comparison_svg(&comparison(name, Vec::new())));
            assert!(texts.iter().any(|text| text.ends_with(expected)), "{texts:?}");
        }
    }

    #[test]
    fn rates_that_are_no_numbers_have_no_bar() {
        for frames_per_second in [f64::NAN, f64::INFINITY, 0.0] {
            let row = ComparisonRow {
                frames_per_second,
                ..row(Preset::Basic, 1e4)
            };
            let svg = comparison_svg(&comparison("arm", vec![row]));
            let document = Document::parse(&svg).unwrap();
            let mut bars = document.descendants().filter(|node| node.attribute("fill") == Some(BAR));
            assert_eq!(bars.next().unwrap().attribute("width"), Some("0"));
        }
    }

    /// Left and right end of a text, as wide as it may be.
    fn extent(node: Node<'_, '_>) -> [f64; 2] {
        let x: f64 = node.attribute("x").unwrap().parse().unwrap();
        let text = node.text().unwrap().trim();
        let size = node.attribute("font-size").map(|size| size.parse().unwrap());
        let width = size.map_or(text_width(text), |size| prose_width(text, size));
        match node.attribute("text-anchor").unwrap() {
            "start" => [x, x + width],
            "middle" => [x - 0.5 * width, x + 0.5 * width],
            _ => [x - width, x],
        }
    }

    proptest! {
        #[test]
        fn texts_never_overlap_nor_leave_the_picture(scale in 1.0..1e13) {
            let svg = comparison_svg(&every_preset(scale));
            let document = Document::parse(&svg).unwrap();
            let width: f64 = document.root_element().attribute("width").unwrap().parse().unwrap();
            let lines_of_text: Vec<_> = document.descendants().filter(|node| node.has_tag_name("text")).collect();
            for (index, &one) in lines_of_text.iter().enumerate() {
                let [left, right] = extent(one);
                prop_assert!(left >= 0.0 && right <= width, "{one:?}");
                let same_line = |other: &Node<'_, '_>| other.attribute("y") == one.attribute("y");
                for other in lines_of_text[index + 1..].iter().copied().filter(same_line) {
                    let [other_left, other_right] = extent(other);
                    // A tenth of a pixel is lost in rounding.
                    prop_assert!(right <= other_left + 0.2 || other_right <= left + 0.2, "{one:?} {other:?}");
                }
            }
        }
    }
}
