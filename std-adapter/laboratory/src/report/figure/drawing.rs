//! Draws the mesh and its marks, from back to front.

use super::view::{Seen, View};
use crate::study::StepCandidates;
use selvedge::Topology;
use selvedge::glam::{DVec3, Vec3};
use tiny_skia::{FillRule, Paint, Path, PathBuilder, Pixmap, Stroke, Transform};

/// A colour as red, green and blue.
type Rgb = [u8; 3];

/// The colour of vertices of vertex–face pairs.
pub(super) const BLUE: Rgb = [0, 78, 200];
/// The colour of faces of vertex–face pairs.
pub(super) const YELLOW: Rgb = [255, 214, 10];
/// The colour of edges of edge–edge pairs.
pub(super) const GREEN: Rgb = [0, 150, 60];
/// The colour of the frame around a close-up.
pub(super) const FRAME: Rgb = [60, 66, 74];
const CLOTH: Rgb = [196, 204, 214];
const OUTLINE: Rgb = [90, 100, 112];

/// The opacity of faces. The rest of what lies behind shows through.
const CLOTH_OPACITY: f32 = 0.5;
const MARK_OPACITY: f32 = 0.8;
/// The shortest edges, in pixels, of faces with outlines. Shorter ones would make all cloth grey.
const SHORTEST_OUTLINED_EDGE: f32 = 4.0;

/// The primitives with a candidate pair.
pub(super) struct Marks {
    vertices: Vec<bool>,
    faces: Vec<bool>,
    edges: Vec<bool>,
}

impl Marks {
    pub(super) fn new(topology: &Topology, candidates: &StepCandidates) -> Self {
        let mut marks = Self {
            vertices: vec![false; topology.vertex_count()],
            faces: vec![false; topology.triangles().len()],
            edges: vec![false; topology.edges().len()],
        };
        for &[vertex, face] in &candidates.vertex_face {
            marks.vertices[vertex as usize] = true;
            marks.faces[face as usize] = true;
        }
        for &edge in candidates.edge_edge.as_flattened() {
            marks.edges[edge as usize] = true;
        }
        marks
    }

    /// Returns the positions of all marked primitives' vertices.
    pub(super) fn positions(&self, topology: &Topology, positions: &[DVec3]) -> Vec<DVec3> {
        let vertices = marked(&self.vertices).map(|vertex| vertex as u32);
        let faces = marked(&self.faces).flat_map(|face| topology.triangles()[face]);
        let edges = marked(&self.edges).flat_map(|edge| topology.edges()[edge]);
        let vertices = vertices.chain(faces).chain(edges);
        vertices.map(|vertex| positions[vertex as usize]).collect()
    }
}

fn marked(marks: &[bool]) -> impl Iterator<Item = usize> {
    let marks = marks.iter().enumerate();
    marks.filter(|&(_, &marked)| marked).map(|(index, _)| index)
}

/// A feature that is drawn at once, with its depth.
#[derive(Clone, Copy)]
enum DrawnShape {
    Face(usize),
    Edge(usize),
    Vertex(usize),
}

/// A mesh with its marks.
pub(super) struct Drawing<'a> {
    pub(super) topology: &'a Topology,
    pub(super) positions: &'a [DVec3],
    pub(super) marks: &'a Marks,
}

impl Drawing<'_> {
    pub(super) fn draw(&self, picture: &mut Pixmap, view: &View) {
        let Self { topology, marks, .. } = *self;
        let seen: Vec<Seen> = self.positions.iter().map(|&p| view.see(p)).collect();
        let pen = Pen::new(topology, &seen);
        for shape in shapes(topology, &seen, marks, pen.edge_length) {
            match shape {
                DrawnShape::Face(face) => {
                    let corners = topology.triangles()[face].map(|vertex| seen[vertex as usize]);
                    pen.draw_face(picture, corners, marks.faces[face]);
                }
                DrawnShape::Edge(edge) => {
                    let ends = topology.edges()[edge].map(|vertex| seen[vertex as usize]);
                    pen.draw_edge(picture, ends);
                }
                DrawnShape::Vertex(vertex) => draw_dot(picture, seen[vertex], pen.dot),
            }
        }
    }
}

/// Returns faces without a mark from the furthest to the nearest, then everything with a mark in the same order. So cloth never
/// hides a mark.
///
/// A face is as deep as its middle. Edges and vertices lie on faces, so edges come half an edge's length nearer, and vertices a
/// whole one. Otherwise neighbouring faces and edges with nearer middles would cover them.
fn shapes(topology: &Topology, seen: &[Seen], marks: &Marks, edge_length: f32) -> Vec<DrawnShape> {
    fn mean<const N: usize>(seen: &[Seen], vertices: [u32; N]) -> f32 {
        vertices.iter().map(|&v| seen[v as usize].depth).sum::<f32>() / N as f32
    }
    let faces = topology
        .triangles()
        .iter()
        .enumerate()
        .map(|(face, &corners)| (marks.faces[face], mean(seen, corners), DrawnShape::Face(face)));
    let edges = marked(&marks.edges).map(|edge| {
        let depth = mean(seen, topology.edges()[edge]) + 0.5 * edge_length;
        (true, depth, DrawnShape::Edge(edge))
    });
    let vertices = marked(&marks.vertices).map(|vertex| {
        let depth = seen[vertex].depth + edge_length;
        (true, depth, DrawnShape::Vertex(vertex))
    });
    let mut shapes: Vec<_> = faces.chain(edges).chain(vertices).collect();
    shapes.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    shapes.into_iter().map(|(_, _, shape)| shape).collect()
}

/// The widths of lines and dots, in pixels, which suit the size of the faces.
struct Pen {
    edge_length: f32,
    has_outlines: bool,
    outline: f32,
    edge: f32,
    dot: f32,
}

impl Pen {
    fn new(topology: &Topology, seen: &[Seen]) -> Self {
        let length = |&[a, b]: &[u32; 2]| {
            let (a, b) = (seen[a as usize], seen[b as usize]);
            f64::from(Vec3::new(a.x - b.x, a.y - b.y, a.depth - b.depth).length())
        };
        let edges = topology.edges();
        let sum: f64 = edges.iter().map(length).sum();
        let edge_length = (sum / edges.len().max(1) as f64) as f32;
        Self {
            edge_length,
            has_outlines: edge_length >= SHORTEST_OUTLINED_EDGE,
            outline: (0.03 * edge_length).clamp(0.15, 1.0),
            edge: (0.1 * edge_length).clamp(1.0, 5.0),
            dot: (0.13 * edge_length).clamp(1.5, 8.0),
        }
    }

    fn draw_face(&self, picture: &mut Pixmap, corners: [Seen; 3], marked: bool) {
        if self.misses(picture, &corners) {
            return;
        }
        let Some(path) = polyline(&corners, true) else {
            return;
        };
        let brightness = brightness(corners, marked);
        if marked {
            // The line keeps a face visible that is seen from its side.
            let yellow = shaded(YELLOW, brightness);
            fill(picture, &path, yellow, MARK_OPACITY);
            if self.has_outlines {
                stroke(picture, &path, yellow, 1.0, 0.7 * self.edge);
            }
        } else {
            fill(picture, &path, shaded(CLOTH, brightness), CLOTH_OPACITY);
        }
        if self.has_outlines {
            stroke(picture, &path, OUTLINE, 0.6, self.outline);
        }
    }

    fn draw_edge(&self, picture: &mut Pixmap, ends: [Seen; 2]) {
        if self.misses(picture, &ends) {
            return;
        }
        if let Some(path) = polyline(&ends, false) {
            stroke(picture, &path, GREEN, 1.0, self.edge);
        }
    }

    /// Returns whether a line around these points is outside the picture, so that drawing it would only take time.
    fn misses(&self, picture: &Pixmap, points: &[Seen]) -> bool {
        let (width, height) = (picture.width() as f32, picture.height() as f32);
        let all = |outside: &dyn Fn(&Seen) -> bool| points.iter().all(outside);
        all(&|p| p.x < -self.edge)
            || all(&|p| p.y < -self.edge)
            || all(&|p| p.x > width + self.edge)
            || all(&|p| p.y > height + self.edge)
    }
}

pub(super) fn draw_dot(picture: &mut Pixmap, at: Seen, radius: f32) {
    for (colour, radius) in [([255; 3], radius * 1.25), (BLUE, radius)] {
        if let Some(path) = PathBuilder::from_circle(at.x, at.y, radius) {
            fill(picture, &path, colour, 1.0);
        }
    }
}

/// Returns the brightness by Lambert's law for a lamp at the viewer's left shoulder, the same for both sides of a face.
fn brightness(corners: [Seen; 3], marked: bool) -> f32 {
    let [a, b, c] = corners.map(|corner| Vec3::new(corner.x, -corner.y, corner.depth));
    let normal = (b - a).cross(c - a).normalize_or(Vec3::Z);
    let lamp = Vec3::new(-0.35, 0.45, 0.82).normalize();
    let darkest = if marked { 0.85 } else { 0.6 };
    darkest + (1.0 - darkest) * normal.dot(lamp).abs()
}

fn shaded(colour: Rgb, brightness: f32) -> Rgb {
    colour.map(|channel| (f32::from(channel) * brightness).round() as u8)
}

fn polyline(points: &[Seen], closed: bool) -> Option<Path> {
    let mut path = PathBuilder::new();
    path.move_to(points[0].x, points[0].y);
    for point in &points[1..] {
        path.line_to(point.x, point.y);
    }
    if closed {
        path.close();
    }
    path.finish()
}

fn paint([red, green, blue]: Rgb, opacity: f32) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color_rgba8(red, green, blue, (255.0 * opacity).round() as u8);
    paint
}

pub(super) fn fill(picture: &mut Pixmap, path: &Path, colour: Rgb, opacity: f32) {
    picture.fill_path(path, &paint(colour, opacity), FillRule::Winding, Transform::identity(), None);
}

pub(super) fn stroke(picture: &mut Pixmap, path: &Path, colour: Rgb, opacity: f32, width: f32) {
    let stroke = Stroke {
        width,
        line_cap: tiny_skia::LineCap::Round,
        line_join: tiny_skia::LineJoin::Round,
        ..Stroke::default()
    };
    picture.stroke_path(path, &paint(colour, opacity), &stroke, Transform::identity(), None);
}
