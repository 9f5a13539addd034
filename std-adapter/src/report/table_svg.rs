//! The comparison of methods as a picture of a table.

use super::number::{grouped, mean, rate};
use super::paper::paper_row;
use crate::pipeline::{Preset, Stage};
use crate::study::{Comparison, ComparisonRow, MeanCounts};
use svg::node::element::{Group, Line, Rectangle, Text};
use svg::{Document, Node};

// Lengths in pixels, at the picture's own size.
const FONT: &str = "system-ui, -apple-system, 'Segoe UI', 'Helvetica Neue', Arial, sans-serif";
const FONT_SIZE: f64 = 13.0;
/// What a letter or digit takes at most on average, in the widest of the fonts above.
const LETTER: f64 = 7.9;
const MARGIN: f64 = 20.0;
const COLUMN_GAP: f64 = 14.0;
const GROUP_GAP: f64 = 26.0;
const ROW_HEIGHT: f64 = 26.0;
const BAR_WIDTH: f64 = 90.0;
const BAR_HEIGHT: f64 = 12.0;
/// From a row's middle down to the baseline of its text.
const BASELINE: f64 = 4.5;

const PAPER_WHITE: &str = "#fdfdfc";
const INK: &str = "#1f2328";
const FAINT_INK: &str = "#656d76";
const RULE: &str = "#d0d7de";
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
        let longest = |cells: &[String]| {
            cells
                .iter()
                .map(|cell| text_width(cell))
                .fold(0.0, f64::max)
        };
        match &self.content {
            Content::Names(cells) | Content::Numbers(cells) => {
                longest(cells).max(text_width(self.heading))
            }
            Content::Bars(_) => BAR_WIDTH,
        }
    }
}

fn text_width(text: &str) -> f64 {
    text.chars().count() as f64 * LETTER
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
        let dagger = if row.preset.is_reconstructed() {
            " †"
        } else {
            ""
        };
        format!("{}{dagger}", row.preset)
    };
    let fastest = rows
        .iter()
        .map(|row| row.frames_per_second)
        .filter(|rate| rate.is_finite())
        .fold(0.0, f64::max);
    let bar = |row: &ComparisonRow| {
        let share = row.frames_per_second / fastest;
        if share.is_finite() {
            share.clamp(0.0, 1.0)
        } else {
            0.0
        }
    };
    let paper = |cell: fn(super::PaperRow) -> String| {
        move |row: &ComparisonRow| paper_row(row.preset).map_or(String::new(), cell)
    };
    vec![
        ColumnGroup {
            heading: "",
            columns: vec![Column {
                heading: "Method",
                content: Content::Names(rows.iter().map(name).collect()),
            }],
        },
        pairs("Distributed", &|row| {
            survivors(row, |stage| stage == Stage::Distribution)
        }),
        pairs("After boxes", &|row| survivors(row, Stage::is_box_test)),
        pairs("After filter", &|row| Some(row.candidates)),
        pairs("Contacts", &|row| {
            survivors(row, |stage| stage == Stage::Elementary)
        }),
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
                numbers(
                    "frames/s",
                    &paper(|row| format!("{:.2}", row.frames_per_second)),
                ),
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
        // The title is half as large again, the subtitle and the notes a little smaller.
        let lines = std::iter::once(&*title)
            .chain([&*subtitle])
            .chain(notes.iter().copied())
            .zip([1.3].into_iter().chain(std::iter::repeat(0.85)))
            .map(|(line, scale)| 2.0 * MARGIN + scale * text_width(line));
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
        picture.append(title.set("font-size", 16).set("font-weight", 600));
        let subtitle = text(MARGIN, 50.0, "start", &self.subtitle);
        picture.append(subtitle.set("font-size", 12).set("fill", FAINT_INK));
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
                        picture
                            .append(cell.set("font-weight", if highlighted { 700 } else { 400 }));
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
            picture.append(note.set("font-size", 11.5).set("fill", FAINT_INK));
        }
    }
}

/// Each row, and whether it is ours.
fn highlighted(comparison: &Comparison) -> impl Iterator<Item = (usize, bool)> {
    let presets = comparison.rows.iter().map(|row| row.preset);
    presets.map(|preset| preset == Preset::Selvedge).enumerate()
}

fn title(comparison: &Comparison) -> String {
    format!(
        "Pairs left after each stage, and speed: {}",
        comparison.name
    )
}

fn subtitle(comparison: &Comparison) -> String {
    let number = |count: usize| grouped(count as u64);
    let s = |count| if count == 1 { "" } else { "s" };
    let Comparison {
        steps,
        threads,
        rounds,
        ..
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
    if let Some(row) = comparison.rows.first() {
        subtitle += &format!(
            "; {} candidate triangle pairs a step",
            mean(row.triangle_pairs)
        );
    }
    subtitle
}

fn notes(comparison: &Comparison) -> Vec<&'static str> {
    let any =
        |wanted: &dyn Fn(Preset) -> bool| comparison.rows.iter().any(|row| wanted(row.preset));
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
    let content = content.replace(
        |c: char| c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}'),
        "\u{fffd}",
    );
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
