//! Untangles garments that start tangled before the first step, and checks them with the exact oracle.
//!
//! `cargo run --release -p selvedge-verification --example untangled_garments -- [--cells N] [--depths 1,2,3] [--only WORDS]`
//!
//! Prints a row for each garment at each depth, and the number that end without an intersection. The exit status is 1 if the
//! oracle finds an intersection though the simulation starts, or finds none though the simulation is refused.

#[path = "../../std-adapter/cloth/tests/simulation/garments.rs"]
mod garments;

use clap::Parser;
use garments::{NAMES, garment};
use selvedge_cloth::{Mesh, Scene, SetupError, Simulation, TangledStart, Untangled};
use selvedge_verification::oracle::mesh_intersections;
use std::process::ExitCode;

type Failure = Box<dyn std::error::Error>;

#[derive(Parser)]
struct Options {
    /// The number of cells along the longer side.
    #[arg(long, default_value_t = 24, value_parser = clap::value_parser!(u32).range(4..))]
    cells: u32,
    #[arg(long, value_delimiter = ',', default_values_t = [1.0, 2.0, 3.0])]
    depths: Vec<f64>,
    /// Only garments whose names contain this.
    #[arg(long, default_value = "")]
    only: String,
}

/// Returns pairs of triangles that intersect, except pairs of two bodies.
fn intersecting(mesh: &Mesh, cloth_triangles: usize) -> usize {
    let positions: Vec<_> = mesh.positions.iter().map(|position| position.to_array()).collect();
    mesh_intersections(&positions, &mesh.triangles, cloth_triangles).len()
}

/// Sets a scene up. Returns its positions and what was untangled, or the remaining intersections.
fn set_up(scene: Scene) -> Result<(Mesh, Option<Untangled>, bool), Failure> {
    match Simulation::new(scene, 1) {
        Ok(simulation) => {
            let mesh = Mesh::new(simulation.positions().to_vec(), simulation.triangles().to_vec());
            Ok((mesh, simulation.untangled().copied(), true))
        }
        Err(SetupError::Tangled(tangle)) => Ok((tangle.mesh, tangle.untangled, false)),
        Err(other) => Err(other.into()),
    }
}

fn run(options: &Options) -> Result<bool, Failure> {
    println!(
        "| garment, depth | triangles | pairs of triangles that intersect: before, after | steps | edges: 99 %, longest | moved by | time |"
    );
    println!("|---|---|---|---|---|---|---|");
    let (mut free, mut all, mut is_honest) = (0, 0, true);
    for name in NAMES.into_iter().filter(|name| name.contains(&options.only)) {
        for &depth in &options.depths {
            let mut scene = garment(name, options.cells, depth);
            let cloth_triangles = scene.cloths[0].mesh().triangles.len();
            let (start, ..) = set_up(garment(name, options.cells, depth))?;
            let before = intersecting(&start, cloth_triangles);
            scene.tangled_start = TangledStart::Untangle;
            let (end, untangled, is_free) = set_up(scene)?;
            let after = intersecting(&end, cloth_triangles);
            is_honest &= is_free == (after == 0);
            all += 1;
            free += usize::from(after == 0);
            let Some(told) = untangled else {
                println!("| {name}, {depth} | {cloth_triangles} | {before}, {after} | | | | |");
                continue;
            };
            println!(
                "| {name}, {depth} | {cloth_triangles} | {before}, {after} | {} | {:.3}, {:.3} | {:.0} mm | {:.2} s |",
                told.steps,
                told.stretch.percentile_99,
                told.stretch.largest,
                1e3 * told.farthest,
                told.seconds,
            );
        }
    }
    println!("\n{free} of {all} are free of intersections by the oracle");
    Ok(is_honest)
}

fn main() -> ExitCode {
    let options = Options::parse();
    match run(&options) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("the oracle and the simulation disagree");
            ExitCode::FAILURE
        }
        Err(failure) => {
            eprintln!("{failure}");
            ExitCode::FAILURE
        }
    }
}
