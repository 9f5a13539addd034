//! Surfaces of solids that a function describes: surface nets, relaxed.

use selvedge::Mesh;
use selvedge_core::glam::DVec3;
use std::collections::BTreeMap;

/// How often vertices go to the middle of their neighbours, and back to the surface.
const ROUNDS: usize = 12;

/// A cut along an axis: what is beyond is left out.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cut {
    pub(super) axis: usize,
    pub(super) at: f64,
    /// 1: what is above is left out; -1: what is below.
    pub(super) side: f64,
}

impl Cut {
    /// Whether it leaves out a point: not one that is nearly on it.
    fn leaves_out(&self, point: DVec3, nearly: f64) -> bool {
        (point.to_array()[self.axis] - self.at) * self.side > nearly
    }
}

/// Where `solid` is zero, as a mesh with edges of about `pitch` between `lower` and `upper`, without what cuts leave out. Triangles turn
/// anticlockwise seen from where it is positive. The mesh ends at a cut in an even line.
pub(super) fn surface(solid: impl Fn(DVec3) -> f64, [lower, upper]: [DVec3; 2], pitch: f64, cuts: &[Cut]) -> Mesh {
    // Where the middles of cells are, so that the last row of triangles is as wide as the others.
    let snapped = |cut: &Cut| {
        let first = lower.to_array()[cut.axis];
        let at = first + (((cut.at - first) / pitch - 0.5).round() + 0.5) * pitch;
        Cut { at, ..*cut }
    };
    let cuts: Vec<Cut> = cuts.iter().map(snapped).collect();
    let [width, height, depth] = ((upper - lower) / pitch).to_array().map(|cells| cells.ceil() as usize + 1);
    let corner = |at: [usize; 3]| lower + DVec3::from(at.map(|cells| cells as f64)) * pitch;
    let mut values = Vec::with_capacity(width * height * depth);
    for z in 0..depth {
        for y in 0..height {
            values.extend((0..width).map(|x| solid(corner([x, y, z]))));
        }
    }
    let is_inside = |[x, y, z]: [usize; 3]| values[(z * height + y) * width + x] < 0.0;
    let mut mesh = Mesh::default();
    // Of cells that the surface passes through; in order, so that the mesh is the same on every machine.
    let mut vertices = BTreeMap::new();
    let mut vertex = |cell: [usize; 3], mesh: &mut Mesh| {
        *vertices.entry(cell).or_insert_with(|| {
            mesh.positions.push(corner(cell) + 0.5 * pitch);
            mesh.positions.len() as u32 - 1
        })
    };
    for z in 1..depth - 1 {
        for y in 1..height - 1 {
            for x in 1..width - 1 {
                let at = [x, y, z];
                for axis in 0..3 {
                    let end = moved(at, axis, 1);
                    let [inside, beyond] = [at, end].map(is_inside);
                    let middle = 0.5 * (corner(at) + corner(end));
                    if inside == beyond || cuts.iter().any(|cut| cut.leaves_out(middle, 0.1 * pitch)) {
                        continue;
                    }
                    // The four cells about the edge, anticlockwise seen from its end.
                    let [one, other] = [(axis + 1) % 3, (axis + 2) % 3];
                    let below = moved(at, other, -1);
                    let around = [moved(below, one, -1), below, at, moved(at, one, -1)];
                    let [a, b, c, d] = around.map(|cell| vertex(cell, &mut mesh));
                    let [b, d] = if inside { [b, d] } else { [d, b] };
                    mesh.triangles.extend(if (x + y + z) % 2 == 0 {
                        [[a, b, c], [a, c, d]]
                    } else {
                        [[a, b, d], [b, c, d]]
                    });
                }
            }
        }
    }
    trim(&mut mesh);
    relax(&mut mesh, &solid, pitch, &cuts);
    mesh
}

/// A cell or a corner, so many farther along an axis.
fn moved(mut at: [usize; 3], axis: usize, by: isize) -> [usize; 3] {
    at[axis] = at[axis].wrapping_add_signed(by);
    at
}

/// How many triangles each edge has, whichever way it goes.
fn edges(mesh: &Mesh) -> BTreeMap<[u32; 2], u32> {
    let mut edges = BTreeMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)] {
            *edges.entry([from.min(to), from.max(to)]).or_default() += 1;
        }
    }
    edges
}

/// Leaves out triangles all of whose corners are where the mesh ends, which would be drawn into a line there, and vertices of none.
fn trim(mesh: &mut Mesh) {
    loop {
        let mut ends = vec![false; mesh.positions.len()];
        for (edge, _) in edges(mesh).iter().filter(|(_, count)| **count == 1) {
            edge.iter().for_each(|&vertex| ends[vertex as usize] = true);
        }
        let before = mesh.triangles.len();
        mesh.triangles
            .retain(|triangle| !triangle.iter().all(|&vertex| ends[vertex as usize]));
        if mesh.triangles.len() == before {
            break;
        }
    }
    let mut numbers = vec![None; mesh.positions.len()];
    let mut kept = Vec::new();
    for vertex in mesh.triangles.iter_mut().flatten() {
        let old = *vertex as usize;
        *vertex = *numbers[old].get_or_insert_with(|| {
            kept.push(mesh.positions[old]);
            kept.len() as u32 - 1
        });
    }
    mesh.positions = kept;
}

/// Evens the mesh out.
fn relax(mesh: &mut Mesh, solid: &impl Fn(DVec3) -> f64, pitch: f64, cuts: &[Cut]) {
    let edges = edges(mesh);
    let count = mesh.positions.len();
    let mut neighbours = vec![Vec::new(); count];
    let mut on_edge = vec![false; count];
    for (&[from, to], _) in edges.iter().filter(|(_, count)| **count == 1) {
        for (vertex, other) in [(from, to), (to, from)] {
            on_edge[vertex as usize] = true;
            neighbours[vertex as usize].push(other);
        }
    }
    for (&[from, to], _) in edges.iter().filter(|(_, count)| **count != 1) {
        for (vertex, other) in [(from, to), (to, from)] {
            if !on_edge[vertex as usize] {
                neighbours[vertex as usize].push(other);
            }
        }
    }
    // Of each vertex where the mesh ends: the cut that it lies on.
    let cut_of = |point: DVec3| {
        let distance = |cut: &&Cut| (point.to_array()[cut.axis] - cut.at).abs();
        cuts.iter().min_by(|a, b| distance(a).total_cmp(&distance(b)))
    };
    let ends: Vec<Option<&Cut>> = (0..count)
        .map(|vertex| cut_of(mesh.positions[vertex]).filter(|_| on_edge[vertex]))
        .collect();
    for _ in 0..ROUNDS {
        let middle = |all: &[u32]| all.iter().map(|&v| mesh.positions[v as usize]).sum::<DVec3>() / all.len() as f64;
        let wanted: Vec<DVec3> = neighbours.iter().map(|all| middle(all)).collect();
        for (vertex, wanted) in wanted.into_iter().enumerate() {
            let mut point = mesh.positions[vertex].lerp(wanted, 0.7);
            for _ in 0..3 {
                point -= onto(solid, point, pitch);
                if let Some(cut) = ends[vertex] {
                    point = match cut.axis {
                        0 => point.with_x(cut.at),
                        1 => point.with_y(cut.at),
                        _ => point.with_z(cut.at),
                    };
                }
            }
            mesh.positions[vertex] = point;
        }
    }
}

/// The way from the surface to a point, at most half a pitch.
fn onto(solid: &impl Fn(DVec3) -> f64, point: DVec3, pitch: f64) -> DVec3 {
    let step = 0.05 * pitch;
    let slope = |by: DVec3| (solid(point + by) - solid(point - by)) / (2.0 * step);
    let gradient = DVec3::new(slope(DVec3::X * step), slope(DVec3::Y * step), slope(DVec3::Z * step));
    let squared = gradient.length_squared().max(0.1);
    (gradient * (solid(point) / squared)).clamp_length_max(0.5 * pitch)
}
