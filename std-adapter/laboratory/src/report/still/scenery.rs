//! Places the scene and the camera. The y axis is up, the middle of all motion is zero, and its radius is one.

use crate::report::colours::cloth_colours;
use crate::report::recording::Recording;
use selvedge_cloth::vertex_normals;
use selvedge_core::glam::{DMat3, DVec3};

/// The vertical field of view: tan 0.3.
const HALF_FIELD: f64 = 0.309_336_249_609_623_25;
/// The number of points of a frame that determine the view.
const LOOKED_AT: usize = 400;
/// The number of frames that determine the view.
const FRAMES: usize = 12;

/// The scene over all frames.
pub(super) struct Scenery {
    turn: DMat3,
    /// The middle, in the recording's own unit of length.
    middle: DVec3,
    radius: f64,
    /// The points that must be in view.
    sample: Vec<DVec3>,
    /// True if the scene is deeper than wide, so that it is seen from its side.
    is_deep: bool,
    /// The height of the floor, a little below all that moves.
    pub(super) floor: f64,
    /// The distance between lines of the floor's grid.
    pub(super) spacing: f64,
    /// The place of the scene's origin on the floor.
    pub(super) origin: [f64; 2],
}

/// The triangles of a frame.
pub(super) struct Surface {
    pub(super) points: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// The number of each triangle's colour, if it belongs to a cloth.
    pub(super) cloths: Vec<Option<usize>>,
}

impl Scenery {
    /// Makes a scenery for all of these. The first decides the direction up.
    pub(super) fn new(recordings: &[&Recording]) -> Self {
        let up = recordings[0].up();
        // The axis that is least upright becomes horizontal.
        let axes = [DVec3::X, DVec3::Y, DVec3::Z];
        let least_upright = axes.into_iter().min_by(|a, b| up.dot(*a).abs().total_cmp(&up.dot(*b).abs()));
        let across = least_upright.unwrap_or(DVec3::X).reject_from_normalized(up).normalize();
        let turn = DMat3::from_cols(across, up, across.cross(up)).transpose();

        let turned = |position: &[f32; 3]| turn * DVec3::from(position.map(f64::from));
        let frames = recordings.iter().flat_map(|recording| &recording.frames);
        let points = frames.flat_map(|frame| frame.positions.iter().map(turned));
        let ends = points.map(|point| (point, point));
        let (low, high) = ends.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))).unwrap_or_default();
        let middle = 0.5 * low + 0.5 * high;
        let mut sample = Vec::new();
        for recording in recordings {
            let stride = (recording.vertex_count() / LOOKED_AT).max(1);
            let last = recording.frames.len() - 1;
            for k in 0..FRAMES {
                let positions = &recording.frames[k * last / (FRAMES - 1)].positions;
                sample.extend(positions.iter().step_by(stride).map(|position| turned(position) - middle));
            }
        }
        let radius = sample.iter().map(|point| point.length()).fold(1e-30, f64::max);
        let spacing = round_spacing(0.2 * radius);
        Self {
            turn,
            middle,
            radius,
            sample: sample.into_iter().map(|point| point / radius).collect(),
            is_deep: high.z - low.z > high.x - low.x,
            floor: (low.y - middle.y) / radius - 0.002,
            spacing: spacing / radius,
            origin: [middle.x / radius, middle.z / radius],
        }
    }

    pub(super) fn surface(&self, recording: &Recording, frame: usize) -> Surface {
        let positions = recording.frames[frame].positions.iter();
        let placed = |position: &[f32; 3]| (self.turn * DVec3::from(position.map(f64::from)) - self.middle) / self.radius;
        let points: Vec<DVec3> = positions.map(placed).collect();
        let triangles = recording.mesh(frame).triangles;
        let colours = recording.parts.iter().zip(cloth_colours(&recording.parts));
        let cloths = colours.flat_map(|(part, colour)| std::iter::repeat_n(colour, part.triangles().len()));
        let mut normals = Vec::new();
        vertex_normals(&points, &triangles, &mut normals);
        Surface {
            cloths: cloths.collect(),
            points,
            normals,
            triangles,
        }
    }
}

/// Returns 1, 2 or 5 times a power of ten: `rough` or the next above.
fn round_spacing(rough: f64) -> f64 {
    let power = libm::pow(10.0, libm::floor(libm::log10(rough)));
    let steps = [1.0, 2.0, 5.0, 10.0].map(|step| step * power);
    steps.into_iter().find(|&step| step >= rough).unwrap_or(steps[3])
}

/// The camera, in front of the scene, a little above and to its side. It is far enough away to see everything.
pub(super) struct Camera {
    pub(super) eye: DVec3,
    right: DVec3,
    up: DVec3,
    /// The direction towards the eye.
    back: DVec3,
    /// The number of pixels in a unit, one unit away.
    scale: f64,
    middle: [f64; 2],
}

/// A direction from the camera.
pub(super) struct Ray {
    pub(super) direction: DVec3,
}

impl Camera {
    pub(super) fn new(scenery: &Scenery, [width, height]: [usize; 2]) -> Self {
        let yaw = if scenery.is_deep { std::f64::consts::FRAC_PI_2 } else { 0.0 } - 0.45;
        let pitch = 0.3;
        let (level, rise) = (libm::cos(pitch), libm::sin(pitch));
        let back = DVec3::new(libm::sin(yaw) * level, rise, libm::cos(yaw) * level);
        let right = DVec3::Y.cross(back).normalize();
        let up = back.cross(right);
        let tall = 0.9 * HALF_FIELD;
        let wide = tall * width as f64 / height as f64;
        let needed = |point: &DVec3| point.dot(back) + (point.dot(right).abs() / wide).max(point.dot(up).abs() / tall);
        let distance = scenery.sample.iter().map(needed).fold(0.1, f64::max);
        Self {
            eye: back * distance,
            right,
            up,
            back,
            scale: 0.5 * height as f64 / HALF_FIELD,
            middle: [0.5 * width as f64, 0.5 * height as f64],
        }
    }

    /// Returns a place in pixels from the left and from the top, and the nearness, one over the depth. Returns `None` behind the
    /// camera.
    pub(super) fn see(&self, point: DVec3) -> Option<[f64; 3]> {
        let way = point - self.eye;
        let near = -1.0 / way.dot(self.back);
        let in_front = near > 0.0 && near < 1e4;
        in_front.then(|| {
            let [x, y] = [way.dot(self.right), way.dot(self.up)].map(|side| self.scale * side * near);
            [self.middle[0] + x, self.middle[1] - y, near]
        })
    }

    pub(super) fn ray(&self, x: f64, y: f64) -> Ray {
        let [x, y] = [x - self.middle[0], self.middle[1] - y].map(|side| side / self.scale);
        Ray {
            direction: self.right * x + self.up * y - self.back,
        }
    }
}
