//! Irregular triangulations of a square, for tests.

use selvedge::glam::{DVec2, DVec3};
use selvedge::{Mesh, Topology};

/// Reproducible numbers from -1 to 1 (Steele et al. 2014).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (z ^ (z >> 31)) as i64 as f64 / 2_f64.powi(63)
    }
}

/// Makes a flat sheet from (-½, -½) to (½, ½), with `cells` along each side. Vertices are displaced randomly, triangles are
/// Delaunay's; then `rounds` times each vertex moves to the mean of its neighbours.
pub(crate) fn sheet(cells: u32, rounds: usize) -> Mesh {
    let at = |k: u32| f64::from(k) / f64::from(cells) - 0.5;
    let inner = |k: u32| 0 < k && k < cells;
    let mut random = Random(1);
    let mut places = Vec::new();
    let mut is_inner = Vec::new();
    for row in 0..=cells {
        for column in 0..=cells {
            let thrown = 0.35 / f64::from(cells);
            let moves = [column, row].map(|k| if inner(k) { thrown * random.next() } else { 0.0 });
            places.push(DVec2::new(at(column) + moves[0], at(row) + moves[1]));
            is_inner.push(inner(row) && inner(column));
        }
    }
    let mut triangles = Vec::new();
    for row in 0..cells {
        for column in 0..cells {
            let [a, c] = [row, row + 1].map(|row| row * (cells + 1) + column);
            triangles.extend([[a, a + 1, c], [a + 1, c + 1, c]]);
        }
    }
    flip(&places, &mut triangles);
    for _ in 0..rounds {
        relax(&mut places, &triangles, &is_inner);
        flip(&places, &mut triangles);
    }
    Mesh::new(places.into_iter().map(|p| p.extend(0.0)).collect(), triangles)
}

fn relax(places: &mut [DVec2], triangles: &[[u32; 3]], is_inner: &[bool]) {
    let mut around = vec![Vec::new(); places.len()];
    for triangle in triangles {
        for k in 0..3 {
            around[triangle[k] as usize].push([triangle[(k + 1) % 3], triangle[(k + 2) % 3]]);
        }
    }
    for vertex in (0..places.len()).filter(|&vertex| is_inner[vertex]) {
        let opposite = |places: &[DVec2], of: [u32; 2]| of.map(|v| places[v as usize]);
        let sum: DVec2 = { around[vertex].iter() }.map(|&of| opposite(places, of)[0]).sum();
        let middle = places[vertex].lerp(sum / around[vertex].len() as f64, 0.7);
        let stays_valid = around[vertex].iter().all(|&of| {
            let [a, b] = opposite(places, of);
            (a - middle).perp_dot(b - middle) > 0.0
        });
        if stays_valid {
            places[vertex] = middle;
        }
    }
}

/// Flips edges until all triangles are Delaunay (Lawson 1977).
fn flip(places: &[DVec2], triangles: &mut [[u32; 3]]) {
    loop {
        let topology = Topology::new(places.len(), triangles.to_vec()).unwrap();
        let mut sides = vec![Vec::new(); topology.edges().len()];
        for (index, edges) in topology.triangle_edges().iter().enumerate() {
            (0..3).for_each(|k| sides[edges[k] as usize].push((index, k)));
        }
        let mut is_changed = vec![false; triangles.len()];
        for side in sides.iter().filter(|side| side.len() == 2) {
            let [(first, k), (second, l)] = [side[0], side[1]];
            if is_changed[first] || is_changed[second] {
                continue;
            }
            let turned = |t: [u32; 3], k: usize| [t[k], t[(k + 1) % 3], t[(k + 2) % 3]];
            let ([a, b, c], [.., d]) = (turned(triangles[first], k), turned(triangles[second], l));
            let angle = |tip: u32| {
                let [a, b, tip] = [a, b, tip].map(|v| places[v as usize]);
                (a - tip).angle_to(b - tip).abs()
            };
            if angle(c) + angle(d) > std::f64::consts::PI + 1e-9 {
                triangles[first] = [a, d, c];
                triangles[second] = [d, b, c];
                (is_changed[first], is_changed[second]) = (true, true);
            }
        }
        if !is_changed.contains(&true) {
            return;
        }
    }
}

/// Removes the triangles around a place, and vertices without triangles.
pub(crate) fn with_hole(mesh: &Mesh, middle: DVec3, radius: f64) -> Mesh {
    let outside = |t: &&[u32; 3]| {
        let corners = t.map(|v| mesh.positions[v as usize]);
        (corners[0] + corners[1] + corners[2]).distance(middle * 3.0) > 3.0 * radius
    };
    let mut with = Mesh::default();
    let mut numbers = vec![u32::MAX; mesh.positions.len()];
    for triangle in mesh.triangles.iter().filter(outside) {
        with.triangles.push(triangle.map(|v| {
            let number = &mut numbers[v as usize];
            if *number == u32::MAX {
                *number = with.positions.len() as u32;
                with.positions.push(mesh.positions[v as usize]);
            }
            *number
        }));
    }
    with
}
