//! Parts of the laws' scenes, and measures of states.

use super::Failure;
use super::conditions::Grid;
use fastrand::Rng;
use selvedge_cloth::effects::{Bend, BodyContact, Friction, Gravity, PinGroup, Pins, SelfCollision, Shear, Stretch, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Mesh, Scene, Simulation};

/// The acceleration of gravity, in m/s².
pub(super) const G: f64 = 9.81;
/// The mass of cloth, in kg/m².
pub(super) const DENSITY: f64 = 0.15;
/// A scene needs a time step. The [run](super::run) replaces it.
const ANY_STEP: f64 = 1e-3;

/// Makes a scene without gravity.
pub(super) fn weightless(cloth: Cloth) -> Scene {
    Scene::new(cloth, ANY_STEP)
}

/// Makes a scene with gravity.
pub(super) fn scene(cloth: Cloth) -> Scene {
    let mut scene = weightless(cloth);
    scene.add(Gravity::default());
    scene
}

/// Adds the elastic effects of a membrane, with a stiffness in N/m.
pub(super) fn membrane(scene: &mut Scene, stiffness: f64) {
    scene.add(Stretch::isotropic(stiffness)).add(Shear::new(0.2 * stiffness));
}

/// Adds the elastic effects of a fabric with these stiffnesses, in N/m and N·m.
pub(super) fn elastic(scene: &mut Scene, stiffness: f64, bending: f64) {
    membrane(scene, stiffness);
    scene.add(Bend::isotropic(bending));
}

/// Adds contact at a thickness in metres, and friction if its coefficient is positive.
pub(super) fn contact(scene: &mut Scene, thickness: f64, friction: f64) {
    let thickness = Thickness::new(thickness);
    scene.add(BodyContact(thickness)).add(SelfCollision(thickness));
    if friction > 0.0 {
        scene.add(Friction { coefficient: friction });
    }
}

pub(super) fn pinned(vertices: impl Into<Vec<u32>>) -> Pins {
    Pins {
        groups: vec![PinGroup::resting(vertices)],
    }
}

/// Returns the vertices of a mesh for which `is_meant` holds.
pub(super) fn vertices_where(mesh: &Mesh, is_meant: impl Fn(DVec3) -> bool) -> Vec<u32> {
    let all = (0..).zip(&mesh.positions);
    all.filter(|(_, point)| is_meant(**point)).map(|(vertex, _)| vertex).collect()
}

/// Makes a horizontal square around the z axis with this side, at this height.
pub(super) fn square(side: f64, height: f64, grid: Grid) -> Result<Cloth, Failure> {
    let corner = DVec3::new(-0.5 * side, -0.5 * side, height);
    let cells = [grid.number; 2];
    sheet(corner, [side * DVec3::X, side * DVec3::Y], cells, DENSITY, grid, |_| false)
}

/// Makes a parallelogram as [`Cloth::sheet`], whose warp follows the first side. On an irregular grid it moves the inner
/// vertices, but not those for which `stays` holds.
pub(super) fn sheet(
    corner: DVec3,
    sides: [DVec3; 2],
    cells: [u32; 2],
    density: f64,
    grid: Grid,
    stays: impl Fn(DVec3) -> bool,
) -> Result<Cloth, Failure> {
    let cloth = Cloth::sheet(corner, sides, cells, density)?;
    if !grid.is_irregular {
        return Ok(cloth);
    }
    let mesh = jittered(cloth.mesh(), sides, cells, stays);
    Ok(Cloth::from_mesh(mesh, sides[0], density)?)
}

/// Makes a weightless strip of 1 m by 0.25 m that is held at its two short sides, with a stiffness in N/m.
pub(super) fn held_strip(density: f64, stiffness: f64, grid: Grid) -> Result<Scene, Failure> {
    let cells = [grid.number, grid.number / 4];
    let cloth = sheet(DVec3::ZERO, [DVec3::X, 0.25 * DVec3::Y], cells, density, grid, |_| false)?;
    let held = pinned(vertices_where(cloth.mesh(), |point| (point.x - 0.5).abs() > 0.5 - 1e-9));
    let mut scene = weightless(cloth);
    membrane(&mut scene, stiffness);
    scene.add(held);
    Ok(scene)
}

/// Returns the vertex in the middle of a [strip](held_strip).
pub(super) const fn middle_of_strip(grid: Grid) -> usize {
    let cells = grid.number;
    (cells / 8 * (cells + 1) + cells / 2) as usize
}

/// Returns a mesh of [`Cloth::sheet`] whose inner vertices are moved in its plane by up to 0.3 of a cell, except those for which
/// `stays` holds.
fn jittered(regular: &Mesh, sides: [DVec3; 2], cells: [u32; 2], stays: impl Fn(DVec3) -> bool) -> Mesh {
    let mut mesh = regular.clone();
    let mut random = Rng::with_seed(7);
    for row in 1..cells[1] {
        for column in 1..cells[0] {
            let mut share = |axis: usize| sides[axis] * (0.6 * random.f64() - 0.3) / f64::from(cells[axis]);
            let point = &mut mesh.positions[(row * (cells[0] + 1) + column) as usize];
            let way = share(0) + share(1);
            if !stays(*point) {
                *point += way;
            }
        }
    }
    mesh
}

/// Makes a rectangle in the plane of two sides, around the origin, with irregular triangles. They have no direction that the law
/// could depend on.
pub(super) fn irregular_body(name: &str, sides: [DVec3; 2], cells: [u32; 2]) -> Result<Body, Failure> {
    let grid = Cloth::sheet(-0.5 * (sides[0] + sides[1]), sides, cells, DENSITY)?;
    Ok(Body::from_mesh(name, jittered(grid.mesh(), sides, cells, |_| false)))
}

/// Returns the mean position of all cloth.
pub(super) fn middle(simulation: &Simulation) -> DVec3 {
    let cloth = &simulation.positions()[..simulation.cloth_vertices()];
    cloth.iter().sum::<DVec3>() / cloth.len() as f64
}

/// Returns the root mean square of the lengths of vectors.
pub(super) fn rms(vectors: impl ExactSizeIterator<Item = DVec3>) -> f64 {
    let count = vectors.len() as f64;
    (vectors.map(DVec3::length_squared).sum::<f64>() / count).sqrt()
}

/// Returns the root mean square of the speeds of all cloth, in m/s.
pub(super) fn speed(simulation: &Simulation) -> f64 {
    rms(simulation.velocities()[..simulation.cloth_vertices()].iter().copied())
}

/// Returns the value that is farthest from the expected one.
pub(super) fn farthest(values: impl Iterator<Item = f64>, expected: f64) -> f64 {
    let off = |value: f64| (value - expected).abs();
    values.fold(expected, |worst, value| if off(value) < off(worst) { worst } else { value })
}
