//! The inclined plane: a sheet slides down by ½·(g·sin α − μ·g·cos α)·t², and stays where it is if μ exceeds tan α (Coulomb).
//!
//! The plane consists of triangles, whose edges and vertices must have no effect. Semi-implicit steps of h give ½·a·t·(t + h).

use crate::{elastic, grid, jittered};
use selvedge_cloth::effects::{BodyContact, Friction, Gravity, SelfCollision, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Mesh, Scene, Simulation};

const STEP: f64 = 1e-3;
const SLOPE: f64 = 20.0;
const THICKNESS: f64 = 3e-3;

/// Returns the downhill direction and the normal of the plane.
fn axes() -> [DVec3; 2] {
    let (sine, cosine) = f64::to_radians(SLOPE).sin_cos();
    [DVec3::new(cosine, 0.0, -sine), DVec3::new(sine, 0.0, cosine)]
}

/// Makes a plane of 10 m by 2 m in so many cells.
fn plane(cells: [u32; 2], jitter: f64) -> Mesh {
    let [down, normal] = axes();
    let mut mesh = jittered(grid([10.0, 2.0], cells), cells, jitter);
    mesh.positions
        .iter_mut()
        .for_each(|p| *p = down * p.x + DVec3::Y * p.y + normal * p.z);
    mesh
}

/// Returns a sheet's path after half a second, downhill and sideways, and its largest height above the plane.
fn slid(plane: Mesh, friction: f64) -> [f64; 3] {
    let [down, normal] = axes();
    let corner = down * -4.0 + normal * (1.01 * THICKNESS) - DVec3::Y * 0.15;
    let cloth = Cloth::sheet(corner, [down * 0.3, DVec3::Y * 0.3], [6, 6], 0.15).unwrap();
    let mut scene = Scene::new(cloth, STEP);
    scene.bodies.push(Body::from_mesh("plane", plane));
    elastic(&mut scene, 400.0, 15e-6);
    scene
        .add(Gravity::default())
        .add(BodyContact(Thickness::new(THICKNESS)))
        .add(SelfCollision(Thickness::new(THICKNESS)));
    if friction > 0.0 {
        scene.add(Friction { coefficient: friction });
    }
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let count = simulation.cloth_vertices();
    let middle = |simulation: &Simulation| simulation.positions()[..count].iter().sum::<DVec3>() / count as f64;
    let start = middle(&simulation);
    let mut highest = 0.0_f64;
    for _ in 0..500 {
        simulation.step().unwrap();
        let heights = simulation.positions()[..count].iter().map(|p| p.dot(normal));
        highest = heights.fold(highest, f64::max);
    }
    let way = middle(&simulation) - start;
    [way.dot(down), way.y, highest]
}

fn expected(friction: f64) -> f64 {
    let (sine, cosine) = f64::to_radians(SLOPE).sin_cos();
    let time = 0.5;
    0.5 * 9.81 * (sine - friction * cosine).max(0.0) * time * (time + STEP)
}

#[test]
fn a_sheet_slides_without_friction_as_on_a_smooth_plane_whatever_its_triangles() {
    for (cells, jitter) in [([1, 1], 0.0), ([50, 10], 0.0), ([100, 20], 0.3), ([200, 40], 0.3)] {
        let [down, side, highest] = slid(plane(cells, jitter), 0.0);
        let expected = expected(0.0);
        println!(
            "{cells:?}: {down:.6} m for {expected:.6}, {:.4} mm to the side, {:.4} mm high",
            1e3 * side,
            1e3 * highest
        );
        assert!((down / expected - 1.0).abs() < 1e-3, "{cells:?}: {down} for {expected}");
        assert!(
            side.abs() < 1e-5 && highest < 1.02 * THICKNESS,
            "{cells:?}: {side} to the side, {highest} high"
        );
    }
}

#[test]
fn friction_slows_by_its_coefficient_and_holds_above_the_tangent_of_the_slope() {
    for friction in [0.1, 0.2, 0.3, 0.37, 0.5] {
        let [down, side, _] = slid(plane([100, 20], 0.3), friction);
        let expected = expected(friction);
        println!("{friction}: {down:.6} m for {expected:.6}");
        assert!(
            (down - expected).abs() < 1e-3 + 0.01 * expected,
            "{friction}: {down} for {expected}"
        );
        assert!(side.abs() < 1e-4, "{friction}: {side} to the side");
    }
}

/// Coulomb's cone: on a level plane, under a gravity that leans by `slope` towards any direction, a sheet slides that way alone.
#[test]
fn friction_is_the_same_in_every_direction() {
    for direction in (0..8).map(|k| f64::from(k) * std::f64::consts::FRAC_PI_4 + 0.1) {
        for (lean, friction) in [(0.3_f64, 0.2), (0.25, 0.35)] {
            let along = DVec3::new(direction.cos(), direction.sin(), 0.0);
            let corner = DVec3::new(-0.15, -0.15, 1.01 * THICKNESS);
            let cloth = Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [6, 6], 0.15).unwrap();
            let mut scene = Scene::new(cloth, STEP);
            scene
                .bodies
                .push(Body::from_mesh("plane", jittered(grid([4.0, 4.0], [40, 40]), [40, 40], 0.3)));
            elastic(&mut scene, 400.0, 15e-6);
            let acceleration = 9.81 * (along * lean.sin() - DVec3::Z * lean.cos());
            scene
                .add(Gravity { acceleration })
                .add(BodyContact(Thickness::new(THICKNESS)));
            scene.add(Friction { coefficient: friction });
            let mut simulation = Simulation::new(scene, 1).unwrap();
            let middle = |simulation: &Simulation| simulation.positions()[..49].iter().sum::<DVec3>() / 49.0;
            let start = middle(&simulation);
            (0..300).for_each(|_| simulation.step().unwrap());
            let way = middle(&simulation) - start;
            let expected = 0.5 * 9.81 * (lean.sin() - friction * lean.cos()).max(0.0) * 0.3 * (0.3 + STEP);
            let (down, side) = (way.dot(along), way.cross(along).z);
            println!(
                "{direction:.2} rad, {friction}: {down:.6} m for {expected:.6}, {:.4} mm aside",
                1e3 * side
            );
            assert!(
                (down - expected).abs() < 1e-4 + 1e-3 * expected && side.abs() < 1e-5,
                "{down} for {expected}, {side} aside"
            );
        }
    }
}
