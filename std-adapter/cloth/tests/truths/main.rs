//! The simulation against exact predictions: momenta, strain limits, and rest. `selvedge truths` has the laws with closed forms,
//! which the laboratory tests.

mod balance;
mod bodies;
mod coupled;
mod limits;
mod loads;
mod momentum;
mod proxies;
mod rest;
mod soft_pins;

use selvedge_cloth::effects::{Bend, BodyContact, Friction, SelfCollision, Shear, Stretch, Thickness};
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{Body, Cloth, Mesh, Scene, Simulation};

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

/// Adds contact with bodies and of cloth at a thickness in metres, and friction if its coefficient is positive.
fn contact(scene: &mut Scene, thickness: f64, friction: f64) {
    let thickness = Thickness::new(thickness);
    scene.add(BodyContact(thickness)).add(SelfCollision(thickness));
    if friction > 0.0 {
        scene.add(Friction { coefficient: friction });
    }
}

/// Makes a table of 2 m and so many cells a side in the plane z = 0, turned about y.
fn table(cells: u32, angle: f64) -> Body {
    let mut mesh = irregular_square(2.0, cells);
    let turn = DQuat::from_rotation_y(angle);
    mesh.positions.iter_mut().for_each(|point| *point = turn * *point);
    Body::from_mesh("table", mesh)
}

/// Makes a square around the origin in the xy plane, whose inner vertices are moved by up to 0.3 of a cell, always alike.
fn irregular_square(side: f64, cells: u32) -> Mesh {
    let corner = -0.5 * side * DVec3::new(1.0, 1.0, 0.0);
    let sheet = Cloth::sheet(corner, [side * DVec3::X, side * DVec3::Y], [cells; 2], 1.0).unwrap();
    let mut mesh = sheet.mesh().clone();
    let mut seed = 7_u64;
    let mut random = || {
        seed = seed
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as f64 / f64::from(1_u32 << 30) - 1.0
    };
    for (row, column) in (1..cells).flat_map(|row| (1..cells).map(move |column| (row, column))) {
        let by = DVec3::new(random(), random(), 0.0);
        mesh.positions[(row * (cells + 1) + column) as usize] += by * (0.3 * side / f64::from(cells));
    }
    mesh
}
