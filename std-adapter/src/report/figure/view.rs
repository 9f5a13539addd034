//! From where the mesh is seen.

use crate::glam::{DVec2, DVec3};

/// An orthographic view that fits the mesh into a rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    centre: DVec3,
    /// One over half the mesh's longest side, in two factors: for a tiny mesh their product would overflow.
    half_side: f64,
    right: DVec3,
    up: DVec3,
    towards_eye: DVec3,
    /// The middle of the mesh as seen, in units of `half_side`.
    middle: DVec2,
    /// Pixels to a unit of `half_side`.
    pixels: f64,
    /// Where `middle` goes, in pixels.
    target: DVec2,
}

/// A point of the mesh in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Seen {
    /// In pixels, from the left.
    pub(super) x: f32,
    /// In pixels, from the top.
    pub(super) y: f32,
    /// In pixels, towards the viewer.
    pub(super) depth: f32,
}

/// A rectangle of the picture, in pixels.
#[derive(Clone, Copy, Debug)]
pub(super) struct Room {
    pub(super) left: f32,
    pub(super) top: f32,
    pub(super) width: f32,
    pub(super) height: f32,
}

impl View {
    /// Looks at `positions` (finite) from the side to which they bend.
    ///
    /// The line between two vertices that lie far apart is level in the picture; the vertex furthest from that line is
    /// where the mesh bends, and the viewer stands on the other side, halfway round to the plane's normal.
    pub(super) fn new(positions: &[DVec3], room: Room) -> Self {
        let (low, high) = positions
            .iter()
            .fold((DVec3::MAX, DVec3::MIN), |(low, high), &p| {
                (low.min(p), high.max(p))
            });
        // Halves, because the whole may overflow.
        let centre = 0.5 * low + 0.5 * high;
        let half_side = (0.5 * high - 0.5 * low).max_element();
        let mut view = Self {
            centre,
            half_side: if half_side > 0.0 { half_side } else { 1.0 },
            right: DVec3::X,
            up: DVec3::Y,
            towards_eye: DVec3::Z,
            middle: DVec2::ZERO,
            pixels: 0.0,
            target: DVec2::new(
                f64::from(room.left + 0.5 * room.width),
                f64::from(room.top + 0.5 * room.height),
            ),
        };
        view.turn(positions);
        view.fit(positions, room);
        view
    }

    pub(super) fn moved_right(mut self, pixels: f32) -> Self {
        self.target.x += f64::from(pixels);
        self
    }

    pub(super) fn see(&self, position: DVec3) -> Seen {
        let position = self.normalised(position);
        let seen = self.pixels * (self.flat(position) - self.middle);
        Seen {
            x: (self.target.x + seen.x) as f32,
            y: (self.target.y - seen.y) as f32,
            depth: (self.pixels * self.towards_eye.dot(position)) as f32,
        }
    }

    /// Every coordinate from −1 to 1.
    fn normalised(&self, position: DVec3) -> DVec3 {
        (position - self.centre) / self.half_side
    }

    fn flat(&self, normalised: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(normalised), self.up.dot(normalised))
    }

    fn turn(&mut self, positions: &[DVec3]) {
        let points = || positions.iter().map(|&position| self.normalised(position));
        let furthest = |measure: &dyn Fn(DVec3) -> f64| {
            points().fold(DVec3::ZERO, |best, p| {
                if measure(p) > measure(best) { p } else { best }
            })
        };
        let one_end = furthest(&|p| p.length_squared());
        let other_end = furthest(&|p| p.distance_squared(one_end));
        let Some(right) = (other_end - one_end).try_normalize() else {
            return;
        };
        let off_line = |p: DVec3| (p - one_end).reject_from_normalized(right);
        let bend = furthest(&|p| off_line(p).length_squared());
        let bend = off_line(bend)
            .try_normalize()
            .unwrap_or_else(|| right.any_orthonormal_vector());
        let normal = right.cross(bend);
        // A right-angled triangle of sides 3, 4, 5 gives a unit vector 37 degrees off the normal.
        self.towards_eye = 0.8 * normal - 0.6 * bend;
        self.right = right;
        self.up = self.towards_eye.cross(right);
    }

    fn fit(&mut self, positions: &[DVec3], room: Room) {
        let points = positions
            .iter()
            .map(|&position| self.flat(self.normalised(position)));
        let (low, high) = points.fold((DVec2::MAX, DVec2::MIN), |(low, high), p| {
            (low.min(p), high.max(p))
        });
        let size = high - low;
        self.middle = 0.5 * (low + high);
        let room = DVec2::new(room.width.into(), room.height.into());
        let fitting = (room / size.max(DVec2::splat(1e-3))).min_element();
        self.pixels = fitting.min(room.min_element());
    }
}
