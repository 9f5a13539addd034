//! Places the parts of the picture, captions and the legend.

use super::drawing::{Drawing, FRAME, GREEN, YELLOW, draw_dot, fill, stroke};
use super::lettering::{Size, width, write};
use super::view::{Room, Seen, View};
use crate::report::number::grouped;
use crate::study::StepCandidates;
use tiny_skia::{Color, PathBuilder, Pixmap, PixmapPaint, Rect, Transform};

pub(super) const WIDTH: f32 = 800.0;
/// The room of the whole mesh, in the left panel.
pub(super) const OVERVIEW: Room = Room {
    left: 40.0,
    top: 24.0,
    width: WIDTH - 80.0,
    height: 440.0,
};
/// The room of the whole mesh without a close-up.
pub(super) const OVERVIEW_ALONE: Room = Room {
    height: 780.0,
    ..OVERVIEW
};
/// The room of the part with the right panel's marks, in the left panel.
pub(super) const CLOSE_UP: Room = Room {
    left: 120.0,
    top: 490.0,
    width: WIDTH - 240.0,
    height: 320.0,
};
const NAME_TOP: u32 = 834;
const COUNTS_TOP: u32 = 876;
const LEGEND_TOP: u32 = 948;
const LEGEND_MIDDLE: f32 = LEGEND_TOP as f32 + 13.0;
const SWATCH: f32 = 26.0;

/// Draws the part of the mesh that a close-up shows, and a frame around that part in the overview.
pub(super) fn draw_close_up(picture: &mut Pixmap, left: f32, mesh: &Drawing<'_>, overview: &View, close_up: &View) {
    let (width, height) = (CLOSE_UP.width as u32, CLOSE_UP.height as u32);
    let mut part = Pixmap::new(width, height).expect("the size is not zero");
    part.fill(Color::WHITE);
    mesh.draw(&mut part, &close_up.moved(-CLOSE_UP.left, -CLOSE_UP.top));
    let (x, y) = ((left + CLOSE_UP.left) as i32, CLOSE_UP.top as i32);
    picture.draw_pixmap(x, y, part.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
    for frame in [CLOSE_UP, overview.frame_of(close_up, CLOSE_UP)] {
        if let Some(frame) = Rect::from_xywh(left + frame.left, frame.top, frame.width, frame.height) {
            stroke(picture, &PathBuilder::from_rect(frame), FRAME, 1.0, 2.0);
        }
    }
}

/// Writes the method's name, and below it the number of pairs.
pub(super) fn write_caption(picture: &mut Pixmap, left: f32, candidates: &StepCandidates) {
    let [vertex_face, edge_edge] = [&candidates.vertex_face, &candidates.edge_edge].map(|pairs| grouped(pairs.len()));
    let counts = format!("{vertex_face} VF, {edge_edge} EE");
    for (top, text) in [(NAME_TOP, candidates.preset.name()), (COUNTS_TOP, &*counts)] {
        let room = WIDTH - width(text, Size::Large) as f32;
        write(picture, (left + 0.5 * room) as u32, top, text, Size::Large);
    }
}

/// Draws an example of a mark at this distance from the left.
type Swatch = fn(&mut Pixmap, f32);

/// Writes the meaning of the colours.
pub(super) fn write_legend(picture: &mut Pixmap) {
    let entries: [(Swatch, &str); 3] = [
        (draw_vertex_swatch, "vertex of a VF pair"),
        (draw_face_swatch, "face of a VF pair"),
        (draw_edge_swatch, "edge of an EE pair"),
    ];
    const TEXT_GAP: f32 = 10.0;
    const ENTRY_GAP: f32 = 56.0;
    let texts: f32 = entries.iter().map(|(_, text)| width(text, Size::Small) as f32).sum();
    let total = texts + 3.0 * (SWATCH + TEXT_GAP) + 2.0 * ENTRY_GAP;
    let mut x = 0.5 * (2.0 * WIDTH - total);
    for (draw_swatch, text) in entries {
        draw_swatch(picture, x);
        x += SWATCH + TEXT_GAP;
        write(picture, x as u32, LEGEND_TOP, text, Size::Small);
        x += width(text, Size::Small) as f32 + ENTRY_GAP;
    }
}

fn draw_vertex_swatch(picture: &mut Pixmap, left: f32) {
    let middle = Seen {
        x: left + 0.5 * SWATCH,
        y: LEGEND_MIDDLE,
        depth: 0.0,
    };
    draw_dot(picture, middle, 7.0);
}

fn draw_face_swatch(picture: &mut Pixmap, left: f32) {
    if let Some(square) = Rect::from_xywh(left, LEGEND_MIDDLE - 9.0, SWATCH, 18.0) {
        fill(picture, &PathBuilder::from_rect(square), YELLOW, 1.0);
    }
}

fn draw_edge_swatch(picture: &mut Pixmap, left: f32) {
    let mut path = PathBuilder::new();
    path.move_to(left, LEGEND_MIDDLE);
    path.line_to(left + SWATCH, LEGEND_MIDDLE);
    if let Some(path) = path.finish() {
        stroke(picture, &path, GREEN, 1.0, 4.0);
    }
}
