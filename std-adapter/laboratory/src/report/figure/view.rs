//! Chooses the view of the mesh.

use selvedge::Topology;
use selvedge::glam::{DVec2, DVec3};

/// An orthographic view that fits the mesh into a rectangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct View {
    centre: DVec3,
    /// Half the mesh's longest side.
    half_side: f64,
    right: DVec3,
    up: DVec3,
    towards_eye: DVec3,
    /// The middle of the mesh as seen, in units of `half_side`.
    middle: DVec2,
    /// The number of pixels in a unit of `half_side`.
    pixels: f64,
    /// The place of `middle`, in pixels.
    target: DVec2,
}

/// A point of the mesh in the picture.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Seen {
    /// The distance from the left, in pixels.
    pub(super) x: f32,
    /// The distance from the top, in pixels.
    pub(super) y: f32,
    /// The nearness to the viewer, in pixels.
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

/// The least magnification of a close-up over the overview. Without it there is no close-up.
const LEAST_MAGNIFICATION: f64 = 1.3;
const LARGEST_MAGNIFICATION: f64 = 5.0;

impl Room {
    fn size(self) -> DVec2 {
        DVec2::new(self.width.into(), self.height.into())
    }

    fn middle(self) -> DVec2 {
        DVec2::new(self.left.into(), self.top.into()) + 0.5 * self.size()
    }
}

impl View {
    /// Looks at `positions` (finite) from the side to which they bend.
    ///
    /// The line between the mesh's [ends](find_ends) is level in the picture. The mesh bends at the vertex furthest from that
    /// line. The viewer stands on the other side, more than halfway round from the plane's normal.
    pub(super) fn new(topology: &Topology, positions: &[DVec3], room: Room) -> Self {
        let (low, high) = positions
            .iter()
            .fold((DVec3::MAX, DVec3::MIN), |(low, high), &p| (low.min(p), high.max(p)));
        // Sums halves, because the whole may overflow.
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
            target: room.middle(),
        };
        view.turn(topology, positions);
        let (low, high) = view.bounds(positions);
        view.middle = 0.5 * (low + high);
        view.pixels = fitting(high - low, room).min(room.size().min_element());
        view
    }

    /// Returns the same view elsewhere in the picture.
    pub(super) fn moved(mut self, right: f32, down: f32) -> Self {
        self.target += DVec2::new(right.into(), down.into());
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

    /// Maps every coordinate to −1 to 1.
    fn normalised(&self, position: DVec3) -> DVec3 {
        (position - self.centre) / self.half_side
    }

    fn flat(&self, normalised: DVec3) -> DVec2 {
        DVec2::new(self.right.dot(normalised), self.up.dot(normalised))
    }

    fn turn(&mut self, topology: &Topology, positions: &[DVec3]) {
        let [one_end, other_end] = find_ends(topology).map(|end| self.normalised(positions[end]));
        let Some(right) = (other_end - one_end).try_normalize() else {
            return;
        };
        let off_line = |p: DVec3| (p - one_end).reject_from_normalized(right);
        let bend = positions
            .iter()
            .map(|&position| off_line(self.normalised(position)))
            .fold(
                DVec3::ZERO,
                |best, p| {
                    if p.length_squared() > best.length_squared() { p } else { best }
                },
            )
            .try_normalize()
            .unwrap_or_else(|| right.any_orthonormal_vector());
        let normal = right.cross(bend);
        // A right-angled triangle of sides 3, 4, 5 gives a unit vector 53 degrees off the normal.
        self.towards_eye = 0.6 * normal - 0.8 * bend;
        self.right = right;
        self.up = self.towards_eye.cross(right);
    }

    /// Returns a view of a part of the mesh in another room, if it would be enough larger.
    pub(super) fn close_up(&self, part: &[DVec3], room: Room) -> Option<Self> {
        if part.is_empty() {
            return None;
        }
        let (low, high) = self.bounds(part);
        // A quarter of its size is added on every side.
        let pixels = fitting(1.5 * (high - low), room).min(LARGEST_MAGNIFICATION * self.pixels);
        (pixels >= LEAST_MAGNIFICATION * self.pixels).then_some(Self {
            middle: 0.5 * (low + high),
            pixels,
            target: room.middle(),
            ..*self
        })
    }

    /// Returns the rectangle of this view that a close-up of a room shows.
    pub(super) fn frame_of(&self, close_up: &Self, room: Room) -> Room {
        let size = room.size() * (self.pixels / close_up.pixels);
        let middle = self.pixels * (close_up.middle - self.middle);
        Room {
            left: (self.target.x + middle.x - 0.5 * size.x) as f32,
            top: (self.target.y - middle.y - 0.5 * size.y) as f32,
            width: size.x as f32,
            height: size.y as f32,
        }
    }

    /// Returns the rectangle around `positions` as seen.
    fn bounds(&self, positions: &[DVec3]) -> (DVec2, DVec2) {
        let points = positions.iter().map(|&position| self.flat(self.normalised(position)));
        points.fold((DVec2::MAX, DVec2::MIN), |(low, high), p| (low.min(p), high.max(p)))
    }
}

/// Finds two vertices that are far apart along the edges of the first triangle's component, however the mesh is folded. The
/// search goes from any vertex to the one most edges away, and from there again.
fn find_ends(topology: &Topology) -> [usize; 2] {
    let mut neighbours = vec![Vec::new(); topology.vertex_count()];
    for &[a, b] in topology.edges() {
        neighbours[a as usize].push(b as usize);
        neighbours[b as usize].push(a as usize);
    }
    let last_reached = |start: usize| {
        let mut reached = vec![false; neighbours.len()];
        let mut queue = vec![start];
        reached[start] = true;
        let mut next = 0;
        while let Some(&vertex) = queue.get(next) {
            next += 1;
            for &neighbour in &neighbours[vertex] {
                if !std::mem::replace(&mut reached[neighbour], true) {
                    queue.push(neighbour);
                }
            }
        }
        queue[queue.len() - 1]
    };
    let one_end = last_reached(topology.triangles()[0][0] as usize);
    [one_end, last_reached(one_end)]
}

/// Returns the number of pixels in a unit with which a rectangle fits into a room. A side without length counts as a short one.
fn fitting(size: DVec2, room: Room) -> f64 {
    (room.size() / size.max(DVec2::splat(1e-3))).min_element()
}
