//! Culls many pairs of a mesh, sixteen side by side.

use selvedge_core::batch::{LANES, Level, VertexRow, culled_from_rows};
use selvedge_core::filter::{Filter, Tier};
use selvedge_core::{Motion, PairKind, glam::Vec3};

fn main() {
    // A triangle, and twenty vertices above it. The first nineteen stay there; the last falls through.
    let mut rows = [Vec3::ZERO, Vec3::X, Vec3::Y]
        .map(|corner| VertexRow::new(Motion::resting(corner)))
        .to_vec();
    for k in 1..=20_u8 {
        let start = Vec3::new(0.2, 0.2, 2.0);
        rows.push(VertexRow::new(Motion::new(start, Vec3::new(0.2, 0.2, 19.5 - f32::from(k)))));
    }
    // Vertex, then the three corners of the face.
    let pairs: Vec<[u32; 4]> = (3..23).map(|vertex| [vertex, 0, 1, 2]).collect();

    // The baseline instruction set; `selvedge` detects the best one.
    let mut masks = vec![0; pairs.len().div_ceil(LANES)];
    let filter = Filter::new(Tier::Permanent);
    culled_from_rows(Level::baseline(), PairKind::VertexFace, filter, &rows, &pairs, &mut masks);
    let culled: u32 = masks.iter().map(|mask| mask.count_ones()).sum();
    println!("{culled} of {} pairs culled", pairs.len());
    assert_eq!(culled, 19);
}
