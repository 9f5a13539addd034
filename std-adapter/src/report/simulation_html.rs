//! A simulation as one HTML page that needs nothing else: no network, no other file.
//!
//! The page holds the animation, to be turned, played and stepped through; how many candidate pairs each stage left over time;
//! and the time of each effect and stage. Positions are rounded to 16 bits of the scene's extent, for the picture only.

use crate::simulation::{Frame, Recording};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

const PAGE: &str = include_str!("simulation.html");
const SCRIPT: &str = include_str!("simulation.js");

/// The page does not get much larger than this: of long animations of large meshes it shows every second frame, or fewer.
const LARGEST: usize = 24 << 20;

/// The page's text.
///
/// # Panics
/// Without a frame.
#[must_use]
pub fn simulation_html(recording: &Recording) -> String {
    let data = data(recording).to_string();
    // A name in the data must not end the script.
    let data = data.replace('<', "\\u003c");
    let name = recording.name.replace('&', "&amp;").replace('<', "&lt;");
    PAGE.replace("{{name}}", &name)
        .replace("{{script}}", SCRIPT)
        .replace("{{data}}", &data)
}

fn data(recording: &Recording) -> Value {
    let vertices = recording.frames[0].positions.len();
    let stride = (recording.frames.len() * vertices * 6)
        .div_ceil(LARGEST)
        .max(1);
    let shown: Vec<&Frame> = recording.frames.iter().step_by(stride).collect();
    let all = || shown.iter().flat_map(|frame| &frame.positions);
    let extreme = |pick: fn(f32, f32) -> f32, from: f32| {
        all().fold([from; 3], |a, b| [0, 1, 2].map(|k| pick(a[k], b[k])))
    };
    let (lower, upper) = (extreme(f32::min, f32::MAX), extreme(f32::max, f32::MIN));
    let scale = (0..3)
        .map(|k| upper[k] - lower[k])
        .fold(f32::MIN_POSITIVE, f32::max)
        / 65535.0;
    let positions: Vec<u8> = all()
        .flat_map(|position| [0, 1, 2].map(|k| ((position[k] - lower[k]) / scale).round() as u16))
        .flat_map(u16::to_le_bytes)
        .collect();
    let triangles: Vec<u8> = recording
        .triangles
        .iter()
        .flatten()
        .flat_map(|v| v.to_le_bytes())
        .collect();
    let frames = &recording.frames;
    let per_step = |pick: &dyn Fn(&Frame) -> f64| -> Vec<f64> {
        let mean = |frame: &Frame| pick(frame) / frame.steps.max(1) as f64;
        frames.iter().map(mean).collect()
    };
    let counts = |name: &str, pick: fn(&Frame) -> u64| json!({"name": name, "values": per_step(&|frame| pick(frame) as f64)});
    let pairs = if recording.has_contact {
        json!([
            counts("candidates", |frame| frame.contact.candidates),
            counts("not settled by remembered directions", |frame| frame
                .contact
                .looked_at),
            counts("pushed apart", |frame| frame.contact.pushed),
            counts("not free, repaired", |frame| frame.contact.violated),
            counts("vertices held", |frame| frame.contact.held),
        ])
    } else {
        json!([])
    };
    let times = recording.timed.iter().enumerate().map(|(index, name)| {
        json!({"name": name, "values": per_step(&|frame| 1e3 * frame.seconds[index])})
    });
    let times: Vec<Value> = times.collect();
    json!({
        "vertices": vertices,
        "clothTriangles": recording.cloth_triangles,
        "lower": lower,
        "scale": scale,
        "frames": shown.len(),
        "frameTimes": shown.iter().map(|frame| frame.time).collect::<Vec<_>>(),
        "positions": STANDARD.encode(positions),
        "triangles": STANDARD.encode(triangles),
        "steps": frames.iter().map(|frame| frame.steps).sum::<u64>(),
        "times": frames.iter().map(|frame| frame.time).collect::<Vec<_>>(),
        "pairs": pairs,
        "milliseconds": times,
    })
}
