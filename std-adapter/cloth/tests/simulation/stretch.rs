//! Cloth is as stiff as its fabric, on any mesh.

use crate::common::*;
use crate::irregular;

/// Makes 0.8 m × 0.8 m of a fabric of 400 and 80 N/m with a mesh one metre wide.
fn fabric(mut mesh: Mesh) -> Scene {
    { mesh.positions.iter_mut() }.for_each(|p| *p = DVec3::new(0.8 * p.x, 0.8 * p.y, 0.35));
    let mut scene = Scene::new(Cloth::from_mesh(mesh, DVec3::X, 0.15).unwrap(), 1e-3);
    scene
        .add(AirDrag { rate: 0.5 })
        .add(Shear::new(80.0))
        .add(Bend::isotropic(15e-6));
    scene.add(Stretch::isotropic(400.0));
    scene
}

fn dropped(mesh: Mesh) -> Simulation {
    let mut scene = fabric(mesh);
    scene
        .bodies
        .push(Body::ball("ball", DVec3::new(0.03, 0.02, 0.0), 0.2, 32).unwrap());
    scene.add(Gravity::default()).add(Friction { coefficient: 0.3 });
    scene.add(StrainLimit::at(1.08));
    scene.add(BodyContact(Thickness::new(3e-3)));
    Simulation::new(scene, 1).unwrap()
}

/// Hangs the cloth by its upper corners.
fn hung(mesh: Mesh) -> Simulation {
    let mut scene = fabric(mesh);
    scene.add(Gravity {
        acceleration: DVec3::Y * -9.81,
    });
    let vertices = scene.cloths[0].mesh().positions.iter().zip(0..);
    let corners = vertices.filter(|(p, _)| p.y > 0.4 - 1e-6 && p.x.abs() > 0.4 - 1e-6);
    let corners: Vec<u32> = corners.map(|(_, vertex)| vertex).collect();
    assert_eq!(corners.len(), 2);
    scene.add(resting(corners));
    Simulation::new(scene, 1).unwrap()
}

fn regular(cells: u32) -> Mesh {
    let corner = DVec3::new(-0.5, -0.5, 0.0);
    let sheet = Cloth::sheet(corner, [DVec3::X, DVec3::Y], [cells; 2], 0.15).unwrap();
    sheet.mesh().clone()
}

/// Checks that the cloth lies on the ball after half a second, and that its corners pull most.
fn is_hardly_stretched(mut simulation: Simulation) {
    advance(&mut simulation, 500);
    let stretch = simulation.edge_stretch();
    assert!(stretch.percentile_99 <= 1.03 && stretch.largest <= 1.12, "{stretch:?}");
}

#[test]
fn a_sheet_dropped_on_a_ball_is_hardly_stretched_at_any_resolution() {
    for cells in [26, 71] {
        is_hardly_stretched(dropped(regular(cells)));
    }
}

#[test]
fn irregular_triangles_and_a_hole_make_no_difference() {
    let relaxed = irregular::sheet(71, 4);
    let hole = irregular::with_hole(&relaxed, DVec3::new(-0.19, 0.15, 0.0), 0.125);
    for mesh in [irregular::sheet(71, 0), relaxed, hole] {
        is_hardly_stretched(dropped(mesh));
    }
}

/// Returns the mean sag of the vertices during the second second.
fn sag(mut simulation: Simulation) -> f64 {
    let height = |simulation: &Simulation| {
        let cloth = &simulation.positions()[..simulation.cloth_vertices()];
        cloth.iter().map(|p| p.y).sum::<f64>() / cloth.len() as f64
    };
    let start = height(&simulation);
    advance(&mut simulation, 1000);
    let mut sum = 0.0;
    for _ in 0..10 {
        advance(&mut simulation, 100);
        sum += start - height(&simulation);
    }
    sum / 10.0
}

#[test]
fn a_sheet_hung_by_two_corners_sags_by_millimetres() {
    let sags = [regular(71), irregular::sheet(71, 4)].map(|mesh| sag(hung(mesh)));
    assert!(sags.iter().all(|sag| (0.004..0.015).contains(sag)), "{sags:?}");
}
