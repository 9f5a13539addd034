//! Moves each coordinate of a mesh by at most 1e-11 of the mesh's size, so that its positions are no `f32` numbers.
//!
//! `cargo run --release -p selvedge-laboratory --example true_doubles -- MESH OUTPUT`
//!
//! Files often hold `float`. A detector for `f64` then decides most pairs in `f32`, since that is exact for such positions. So
//! its time on these files is not that of `f64`. Use this to measure that.

use selvedge::glam::DVec3;
use std::error::Error;
use std::path::Path;

/// The largest way, as a share of the largest coordinate.
const SHARE: f64 = 1e-11;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [from, to] = &arguments[..] else {
        return Err("usage: true_doubles MESH OUTPUT".into());
    };
    let mut mesh = selvedge_files::mesh::read(Path::new(from))?.mesh;
    let largest = mesh
        .positions
        .iter()
        .fold(0.0, |largest: f64, position| largest.max(position.abs().max_element()));
    for (number, position) in (0_u64..).zip(&mut mesh.positions) {
        *position += DVec3::from_array([0, 1, 2].map(|axis| SHARE * largest * scattered(3 * number + axis)));
    }
    selvedge_files::mesh::write(Path::new(to), &mesh)?;
    Ok(())
}

/// Returns a number in [-1, 1) that looks random, by the finaliser of SplitMix64.
fn scattered(number: u64) -> f64 {
    let mut bits = number.wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    bits ^= bits >> 31;
    (bits >> 11) as f64 * 2.0_f64.powi(-52) - 1.0
}
