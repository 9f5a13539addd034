//! Times the intersection test of a whole mesh on a crumpled sheet.
//!
//! `cargo run --release -p selvedge-verification --example mesh_truth -- 82`

use selvedge_verification::oracle::mesh_self_intersections;
use std::time::Instant;

fn main() {
    let side: u32 = std::env::args()
        .nth(1)
        .map_or(82, |n| n.parse().expect("a number of quads"));
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..=side {
        for j in 0..=side {
            let (x, y) = (
                f64::from(i) / f64::from(side),
                f64::from(j) / f64::from(side),
            );
            // A sheet rolled up to a tube that overlaps itself a little.
            let angle = 6.4 * x;
            let radius = 1.0 + 0.01 * (17.0 * y).sin() + 0.02 * x;
            positions.push([radius * angle.cos(), radius * angle.sin(), 6.0 * y]);
            if i < side && j < side {
                let v = i * (side + 1) + j;
                triangles.push([v, v + 1, v + side + 1]);
                triangles.push([v + 1, v + side + 2, v + side + 1]);
            }
        }
    }
    let begin = Instant::now();
    let found = mesh_self_intersections(&positions, &triangles);
    println!(
        "{} triangles, {} intersections, {:.2} s",
        triangles.len(),
        found.len(),
        begin.elapsed().as_secs_f64()
    );
}
