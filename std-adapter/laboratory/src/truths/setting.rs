//! Parts of the laws' scenes, and samples over time.

use super::{Failure, Sample};
use fastrand::Rng;
use selvedge_cloth::effects::{Bend, BodyContact, Friction, Gravity, PinGroup, Pins, SelfCollision, Shear, Stretch, Thickness};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Body, Cloth, Mesh, Scene, Simulation};

/// The acceleration of gravity, in m/s².
pub(super) const G: f64 = 9.81;
/// The mass of cloth, in kg/m².
pub(super) const DENSITY: f64 = 0.15;
const SAMPLES: u32 = 20;

/// Makes a scene with gravity.
pub(super) fn scene(cloth: Cloth, step: f64) -> Scene {
    let mut scene = Scene::new(cloth, step);
    scene.add(Gravity::default());
    scene
}

/// Adds the elastic effects of a fabric with these stiffnesses, in N/m and N·m.
pub(super) fn elastic(scene: &mut Scene, stiffness: f64, bending: f64) {
    scene.add(Stretch::isotropic(stiffness)).add(Shear::new(0.2 * stiffness));
    scene.add(Bend::isotropic(bending));
}

/// Returns stretch with a stiffness in N/m that each step solves until converged.
pub(super) const fn solved(stiffness: f64) -> Stretch {
    Stretch {
        sweeps: 0,
        ..Stretch::isotropic(stiffness)
    }
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

/// Makes a horizontal square around the z axis with this side, at this height.
pub(super) fn square(side: f64, height: f64, cells: u32) -> Result<Cloth, Failure> {
    let corner = DVec3::new(-0.5 * side, -0.5 * side, height);
    Ok(Cloth::sheet(corner, [side * DVec3::X, side * DVec3::Y], [cells; 2], DENSITY)?)
}

/// Makes a rectangle in the plane of two sides, around the origin, whose inner vertices are moved by up to 0.3 of a cell. Its
/// triangles have no direction that the law could depend on.
pub(super) fn irregular(name: &str, sides: [DVec3; 2], cells: [u32; 2]) -> Result<Body, Failure> {
    let grid = Cloth::sheet(-0.5 * (sides[0] + sides[1]), sides, cells, DENSITY)?;
    let mut mesh: Mesh = grid.mesh().clone();
    let mut random = Rng::with_seed(7);
    for row in 1..cells[1] {
        for column in 1..cells[0] {
            let mut share = |axis: usize| sides[axis] * (0.6 * random.f64() - 0.3) / f64::from(cells[axis]);
            mesh.positions[(row * (cells[0] + 1) + column) as usize] += share(0) + share(1);
        }
    }
    Ok(Body::from_mesh(name, mesh))
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

/// Returns the value that is farthest from the expected one.
pub(super) fn farthest(values: impl Iterator<Item = f64>, expected: f64) -> f64 {
    let off = |value: f64| (value - expected).abs();
    values.fold(expected, |worst, value| if off(value) < off(worst) { worst } else { value })
}

/// Advances to a time, in seconds.
pub(super) fn advance_to(simulation: &mut Simulation, time: f64, step: f64) -> Result<(), Failure> {
    while simulation.time() < time - 0.5 * step {
        simulation.step()?;
    }
    Ok(())
}

/// Advances by `span` seconds, and returns twenty samples. `answer` takes the simulation, the time and the number of steps since
/// the call.
pub(super) fn over_time(
    simulation: &mut Simulation,
    [span, step]: [f64; 2],
    mut answer: impl FnMut(&Simulation, f64, f64) -> Sample,
) -> Result<Vec<Sample>, Failure> {
    let start = simulation.time();
    let mut samples = Vec::with_capacity(SAMPLES as usize);
    for k in 1..=SAMPLES {
        advance_to(simulation, start + span * f64::from(k) / f64::from(SAMPLES), step)?;
        let time = simulation.time() - start;
        let sample = answer(simulation, time, (time / step).round());
        samples.push(Sample { at: time, ..sample });
    }
    Ok(samples)
}
