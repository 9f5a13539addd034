//! Packs the data for the page's scripts.
//!
//! Each block is a `<script>` element of a type that browsers do not run. `recording` is JSON. The others are base64 of
//! little-endian arrays:
//!
//! | block | type | content |
//! |---|---|---|
//! | `triangles` | u32 | three vertices each, part after part, numbered among all |
//! | `bounds` | f32 | for each frame its least x, y, z and its extent along x, y, z |
//! | `positions` | u16 | for each frame and vertex x, y, z: 0 is the frame's least, 65,535 is the least plus the extent |
//! | `values` | f32 | each series' values, one series after the other |
//! | `measured` | f32 | each measure's values, one measure after the other |
//!
//! The error of a position is thus at most half a 65,535th of the frame's extent, and the rounding of f32.

use super::measures::ShownMeasure;
use crate::report::colours::cloth_colours;
use crate::report::label;
use crate::report::recording::{PartKind, RecordedFrame, Recording, SeriesKind};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};

/// The largest quantised coordinate.
const FINEST: f64 = u16::MAX as f64;

pub(super) fn blocks(recording: &Recording) -> Markup {
    let triangles = recording.placed_parts().flat_map(|(first, part)| {
        let placed = move |vertex: &u32| first as u32 + vertex;
        part.triangles().iter().flatten().map(placed)
    });
    let bounds: Vec<FrameBox> = recording.frames.iter().map(FrameBox::new).collect();
    let positions = recording.frames.iter().zip(&bounds);
    let positions = positions.flat_map(|(frame, bounds)| {
        let quantised = |&position| bounds.quantised(position);
        frame.positions.iter().flat_map(quantised)
    });
    let values = recording.series.iter().flat_map(|series| &series.values);
    let measures = ShownMeasure::all(recording);
    let measured = measures.iter().flat_map(|measure| &measure.values).map(|&value| value as f32);
    let blocks = [
        ("triangles", base64(triangles.map(u32::to_le_bytes))),
        (
            "bounds",
            base64(bounds.iter().flat_map(FrameBox::numbers).map(f32::to_le_bytes)),
        ),
        ("positions", base64(positions.map(u16::to_le_bytes))),
        ("values", base64(values.map(|value| value.to_le_bytes()))),
        ("measured", base64(measured.map(f32::to_le_bytes))),
    ];
    html! {
        script #recording type="application/json" { (PreEscaped(inside_script(&header(recording, &measures)))) }
        @for (name, text) in &blocks {
            script id=(name) type="application/octet-stream" { (PreEscaped(text)) }
        }
    }
}

/// Returns the header, which describes the blocks.
fn header(recording: &Recording, measures: &[ShownMeasure<'_>]) -> Value {
    let parts = recording
        .placed_parts()
        .zip(cloth_colours(&recording.parts))
        .map(|((first, part), colour)| {
            json!({
                "name": part.name(),
                "colour": colour,
                "kind": match part.kind() {
                    PartKind::Cloth => "cloth",
                    PartKind::Body => "body",
                },
                "firstVertex": first,
                "vertices": part.vertex_count(),
                "triangles": part.triangles().len(),
            })
        });
    let series = recording.series.iter().map(|series| {
        let (kind, unit) = match series.kind {
            SeriesKind::Pairs => ("pairs", ""),
            SeriesKind::Events => ("events", ""),
            SeriesKind::Effect => ("effect", "s"),
            SeriesKind::Stage => ("stage", "s"),
            SeriesKind::Step => ("step", "s"),
            SeriesKind::Gauge(unit) => ("gauge", unit),
        };
        json!({"name": series.name, "label": label(&series.name), "kind": kind, "unit": unit})
    });
    let measures = measures.iter();
    let measures = measures
        .map(|shown| json!({"name": shown.name, "label": label(shown.name), "kind": shown.kind_name(), "unit": shown.unit()}));
    let frame_steps = recording.frames.iter().map(|frame| frame.step);
    json!({
        "up": recording.up().to_array(),
        "timeStep": recording.about.time_step,
        "firstStep": recording.first_step,
        "steps": recording.steps,
        "stepsPerValue": recording.steps_per_value,
        "vertices": recording.vertex_count(),
        "frameSteps": frame_steps.collect::<Vec<_>>(),
        "parts": parts.collect::<Vec<_>>(),
        "series": series.collect::<Vec<_>>(),
        "measuredSteps": recording.measured_steps,
        "measures": measures.collect::<Vec<_>>(),
    })
}

/// Returns JSON text that cannot end the element around it.
fn inside_script(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

fn base64<const N: usize>(numbers: impl Iterator<Item = [u8; N]>) -> String {
    STANDARD.encode(numbers.flatten().collect::<Vec<u8>>())
}

/// The bounding box of a frame.
struct FrameBox {
    least: [f32; 3],
    extent: [f32; 3],
}

impl FrameBox {
    fn new(frame: &RecordedFrame) -> Self {
        let (mut least, mut most) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for position in &frame.positions {
            for axis in 0..3 {
                least[axis] = least[axis].min(position[axis]);
                most[axis] = most[axis].max(position[axis]);
            }
        }
        if frame.positions.is_empty() {
            (least, most) = ([0.0; 3], [0.0; 3]);
        }
        let extent = [0, 1, 2].map(|axis| (f64::from(most[axis]) - f64::from(least[axis])) as f32);
        Self { least, extent }
    }

    fn numbers(&self) -> [f32; 6] {
        let ([a, b, c], [d, e, f]) = (self.least, self.extent);
        [a, b, c, d, e, f]
    }

    fn quantised(&self, position: [f32; 3]) -> [u16; 3] {
        [0, 1, 2].map(|axis| {
            let above = f64::from(position[axis]) - f64::from(self.least[axis]);
            let share = above / f64::from(self.extent[axis]);
            // The conversion saturates. It takes 0/0, from an extent of zero, to 0.
            (share * FINEST).round() as u16
        })
    }
}
