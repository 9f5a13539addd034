//! The simulation against exact predictions: momenta, strain limits, and rest. `selvedge truths` has the laws with closed forms,
//! which the laboratory tests.

mod bodies;
mod coupled;
mod limits;
mod loads;
mod momentum;
mod rest;
mod soft_pins;

use selvedge_cloth::effects::{Bend, Shear, Stretch};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Mesh, Scene, Simulation};

/// Returns the mass of each vertex of a mesh with this density, in kg: a third of its triangles'.
fn masses(mesh: &Mesh, density: f64) -> Vec<f64> {
    let mut masses = vec![0.0; mesh.positions.len()];
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.positions[vertex as usize]);
        let third = density * (b - a).cross(c - a).length() / 6.0;
        triangle.iter().for_each(|&vertex| masses[vertex as usize] += third);
    }
    masses
}

/// Returns momentum, and angular momentum about a point, of as many vertices as there are masses.
fn momenta(simulation: &Simulation, masses: &[f64], about: DVec3) -> [DVec3; 2] {
    let vertices = simulation.positions().iter().zip(simulation.velocities()).zip(masses);
    vertices.fold([DVec3::ZERO; 2], |[linear, angular], ((x, v), m)| {
        [linear + *v * *m, angular + (*x - about).cross(*v) * *m]
    })
}

fn elastic(scene: &mut Scene, stiffness: f64, bending: f64) {
    scene
        .add(Stretch::isotropic(stiffness))
        .add(Shear::new(0.2 * stiffness))
        .add(Bend::isotropic(bending));
}

/// Makes a rectangle with these sides in the xy plane, around the origin, in so many cells of two triangles.
fn grid(sides: [f64; 2], [columns, rows]: [u32; 2]) -> Mesh {
    let vertex = |row: u32, column: u32| {
        let share = [
            f64::from(column) / f64::from(columns) - 0.5,
            f64::from(row) / f64::from(rows) - 0.5,
        ];
        DVec3::new(sides[0] * share[0], sides[1] * share[1], 0.0)
    };
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| row * (columns + 1) + column));
    let corners = |at: u32| [[at, at + 1, at + columns + 2], [at, at + columns + 2, at + columns + 1]];
    Mesh {
        positions: (0..=rows)
            .flat_map(|row| (0..=columns).map(move |column| vertex(row, column)))
            .collect(),
        triangles: cells.flat_map(corners).collect(),
    }
}

/// Moves the inner vertices of a grid by up to a share of a cell, always in the same way.
fn jittered(mut grid: Mesh, [columns, rows]: [u32; 2], share: f64) -> Mesh {
    let cell = [
        grid.positions[1].x - grid.positions[0].x,
        grid.positions[columns as usize + 1].y - grid.positions[0].y,
    ];
    let mut seed = 7_u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    };
    for row in 1..rows {
        for column in 1..columns {
            let at = (row * (columns + 1) + column) as usize;
            grid.positions[at] += DVec3::new(share * cell[0] * random(), share * cell[1] * random(), 0.0);
        }
    }
    grid
}
