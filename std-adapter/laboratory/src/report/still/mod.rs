//! Draws a frame as a still picture (PNG), without a browser: the page's first view, with its light, shadows and floor.
//!
//! ```text
//! frame ──▶ the scene's own axes ──▶ which triangle each sample sees, from the eye and from the sun ──▶ colours ──▶ pixels
//! ```
//!
//! All arithmetic is `f64` with functions that round the same everywhere, so that the same frame gives the same bytes on every
//! machine.

mod raster;
mod scenery;
mod shade;
#[cfg(test)]
mod tests;

use super::recording::Recording;
use raster::Raster;
use scenery::{Camera, Scenery};
use shade::Light;
use std::error::Error;
use tiny_skia::{Pixmap, PremultipliedColorU8};

/// The default width and height of a still picture, in pixels.
pub const STILL_SIZE: [u32; 2] = [1280, 800];

/// The number of samples of a pixel along each side.
const SAMPLES: usize = 2;
/// The number of samples of the sun's view, along each side.
const SHADOW: usize = 1024;

/// The reason why there is no picture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StillError {
    /// The recording has no such frame.
    #[error("there is no frame {frame}: the recording has {count}, from 0 on")]
    NoFrame {
        /// The requested frame.
        frame: usize,
        /// The number of frames.
        count: usize,
    },
    /// A side has no pixels, or too many.
    #[error("a picture of {0} × {1} pixels cannot be drawn: each side must be from 1 to 8192")]
    Size(u32, u32),
    /// The picture could not be written as PNG.
    #[error("the picture cannot be written as PNG: {0}")]
    Encoding(#[source] Box<dyn Error + Send + Sync>),
}

/// Draws a frame, `width` × `height` pixels, and returns the PNG file's bytes. The view is the same for all frames of a
/// recording, and shows all of its motion.
///
/// # Errors
/// Returns an error if there is no such frame, a side of the picture is not from 1 to 8192 pixels, or PNG cannot be written.
pub fn png(recording: &Recording, frame: usize, size: [u32; 2]) -> Result<Vec<u8>, StillError> {
    png_among(recording, frame, size, &[recording])
}

/// Draws a frame with the motion of several recordings in view.
pub(super) fn png_among(
    recording: &Recording,
    frame: usize,
    [width, height]: [u32; 2],
    all: &[&Recording],
) -> Result<Vec<u8>, StillError> {
    let count = recording.frames.len();
    if frame >= count {
        return Err(StillError::NoFrame { frame, count });
    }
    let sides = 1..=8192;
    let size = [width, height];
    let pixmap = size
        .iter()
        .all(|side| sides.contains(side))
        .then(|| Pixmap::new(width, height))
        .flatten();
    let mut picture = pixmap.ok_or(StillError::Size(width, height))?;

    let scenery = Scenery::new(all);
    let surface = scenery.surface(recording, frame);
    let fine = size.map(|side| side as usize * SAMPLES);
    let camera = Camera::new(&scenery, fine);
    let seen = Raster::new(&surface, fine, |point| camera.see(point));
    let light = Light::new(&surface, SHADOW);
    let colour_at = |x: usize, y: usize| {
        let ray = camera.ray(x as f64 + 0.5, y as f64 + 0.5);
        match seen.at(x, y) {
            Some(triangle) => light.on_surface(&surface, triangle, &ray, camera.eye),
            None => {
                let beside = [(SAMPLES, 0), (0, SAMPLES)];
                let beside = beside.map(|(dx, dy)| camera.ray((x + dx) as f64 + 0.5, (y + dy) as f64 + 0.5));
                light.on_floor(&scenery, &ray, &beside, camera.eye, y as f64 / fine[1] as f64)
            }
        }
    };
    let pixels = picture.pixels_mut();
    for (index, pixel) in pixels.iter_mut().enumerate() {
        let [x, y] = [index % width as usize, index / width as usize].map(|at| at * SAMPLES);
        let mut sum = [0.0; 3];
        for sample in 0..SAMPLES * SAMPLES {
            let colour = colour_at(x + sample % SAMPLES, y + sample / SAMPLES);
            (0..3).for_each(|k| sum[k] += colour[k]);
        }
        let [red, green, blue] = sum.map(|all| (255.0 * all / (SAMPLES * SAMPLES) as f64).round() as u8);
        *pixel = PremultipliedColorU8::from_rgba(red, green, blue, 255).expect("no colour is more than opaque");
    }
    picture.encode_png().map_err(|error| StillError::Encoding(error.into()))
}
