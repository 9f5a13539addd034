//! Conservation of momentum and angular momentum with seams and pins: inner forces neither move nor turn anything.

use crate::{elastic, masses, momenta};
use selvedge_cloth::effects::{
    AirDrag, Effect, Force, Gravity, PinGroup, Pins, Plan, RopeBend, RopeStretch, Seam, Seams, TimeStep,
};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Mesh, Scene, Simulation};

const DENSITY: f64 = 0.15;

/// Makes a sheet in the xy plane whose vertices are pushed out of it and along it in waves, so that elastic forces shake it.
fn wavy(corner: DVec3) -> Mesh {
    let flat = Cloth::sheet(corner, [0.5 * DVec3::X, 0.5 * DVec3::Y], [10, 10], DENSITY).unwrap();
    let mut mesh = flat.mesh().clone();
    for p in &mut mesh.positions {
        *p += DVec3::new(0.0, 0.01 * (9.0 * p.x).sin(), 0.05 * (11.0 * p.x + 5.0 * p.y).sin());
    }
    mesh
}

/// Sets the velocity of all cloth to that of a body that spins about the origin, at the start.
#[derive(Debug)]
struct Spin(DVec3);

selvedge_cloth::identify!(Spin { 0 });

impl Effect for Spin {
    fn name(&self) -> &'static str {
        "spin"
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_force(Self(self.0));
    }
}

impl Force for Spin {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        if step.time == 0.0 {
            velocities.iter_mut().zip(step.start).for_each(|(v, x)| *v = self.0.cross(*x));
        }
    }
}

/// Runs so many steps after the first one. Returns the change of momenta since then, over the sums of the lengths of their parts.
fn change(scene: Scene, masses: &[f64], steps: usize) -> [f64; 2] {
    let mut simulation = Simulation::new(scene, 1).unwrap();
    simulation.step().unwrap();
    let before = momenta(&simulation, masses, DVec3::ZERO);
    let mut largest = [0.0_f64; 2];
    for _ in 0..steps {
        simulation.step().unwrap();
        let now = momenta(&simulation, masses, DVec3::ZERO);
        let vertices = || simulation.positions().iter().zip(simulation.velocities()).zip(masses);
        let scales = [
            vertices().map(|((_, v), m)| v.length() * m).sum::<f64>(),
            vertices().map(|((x, v), m)| x.length() * v.length() * m).sum(),
        ];
        for k in 0..2 {
            largest[k] = largest[k].max((now[k] - before[k]).length() / scales[k]);
        }
    }
    largest
}

/// Cloths that seams and ties join are one piece: they pass momentum on to each other.
#[test]
fn cloths_that_are_sewn_together_keep_their_momenta_together() {
    let meshes = [wavy(DVec3::ZERO), wavy(DVec3::new(0.52, 0.0, 0.02))];
    let cloth = |mesh: &Mesh| Cloth::from_mesh(mesh.clone(), DVec3::X, DENSITY).unwrap();
    let mut scene = Scene::new(cloth(&meshes[0]).named("first"), 1e-3);
    scene.cloths.push(cloth(&meshes[1]).named("second"));
    scene.cloths.push(
        Cloth::rope(&[DVec3::new(1.1, 0.3, 0.0), DVec3::new(1.5, 0.4, 0.1)], 10, 0.01)
            .unwrap()
            .named("rope"),
    );
    let column = |first: u32, x: u32| (0..11).map(|row| first + 11 * row + x).collect::<Vec<_>>();
    let closing = |seam: Seam| Seam {
        gap: Some(1e-3),
        closing: Some(0.2),
        ..seam
    };
    let seams = vec![
        closing(Seam::new(column(0, 10), column(121, 0))),
        closing(Seam::new(vec![121 + 120], vec![242])),
    ];
    elastic(&mut scene, 400.0, 1e-2);
    scene
        .add(Seams { seams })
        .add(RopeStretch::new(100.0))
        .add(RopeBend::straight(1e-5));
    scene.add(Spin(DVec3::new(1.0, 0.5, -2.0)));
    let mut all: Vec<f64> = meshes.iter().flat_map(|mesh| masses(mesh, DENSITY)).collect();
    let edge = 0.01 * DVec3::new(0.4, 0.1, 0.1).length() / 10.0;
    all.extend((0..11).map(|k| if k == 0 || k == 10 { 0.5 * edge } else { edge }));
    let change = change(scene, &all, 500);
    assert!(change.iter().all(|own| *own < 1e-9), "{change:?}");
}

/// Gravity, drag and the pin exert no moment about the vertical through the pin.
#[test]
fn a_sheet_that_hangs_by_a_corner_does_not_turn_about_it() {
    let mesh = wavy(DVec3::ZERO);
    let mut scene = Scene::new(Cloth::from_mesh(mesh.clone(), DVec3::X, DENSITY).unwrap(), 1e-3);
    elastic(&mut scene, 400.0, 1e-2);
    scene.add(Gravity::default()).add(AirDrag { rate: 0.5 });
    scene.add(Pins {
        groups: vec![PinGroup::resting([0])],
    });
    let masses = masses(&mesh, DENSITY);
    let pin = mesh.positions[0];
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for step in 0..2000 {
        simulation.step().unwrap();
        let [_, angular] = momenta(&simulation, &masses, pin);
        let inertia: f64 = simulation
            .positions()
            .iter()
            .zip(&masses)
            .map(|(x, m)| m * (*x - pin).truncate().length_squared())
            .sum();
        assert!(
            (angular.z / inertia).abs() < 1e-9,
            "step {step}: {} rad/s",
            angular.z / inertia
        );
    }
}

/// A sheet that hangs by two pins swings about that side as gravity alone makes it.
#[test]
fn gravity_alone_changes_the_momentum_about_a_line_of_pins() {
    let mesh = wavy(DVec3::ZERO);
    let step = 1e-3;
    let mut scene = Scene::new(Cloth::from_mesh(mesh.clone(), DVec3::X, DENSITY).unwrap(), step);
    elastic(&mut scene, 400.0, 1e-2);
    scene.add(Gravity::default());
    let pins = [0_u32, 120];
    scene.add(Pins {
        groups: vec![PinGroup::resting(pins)],
    });
    let mut masses = masses(&mesh, DENSITY);
    pins.iter().for_each(|&pin| masses[pin as usize] = 0.0);
    let [first, last] = pins.map(|pin| mesh.positions[pin as usize]);
    let axis = (last - first).normalize();
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let (mut expected, mut scale) = (0.0, 0.0_f64);
    for _ in 0..1000 {
        let moment = |m: &f64, x: &DVec3| (*x - first).cross(DVec3::Z * (-9.81 * m)).dot(axis);
        expected += step
            * masses
                .iter()
                .zip(simulation.positions())
                .map(|(m, x)| moment(m, x))
                .sum::<f64>();
        simulation.step().unwrap();
        let [_, angular] = momenta(&simulation, &masses, first);
        scale = scale.max(angular.length());
        assert!(
            (angular.dot(axis) - expected).abs() < 1e-9 * scale,
            "{} for {expected}",
            angular.dot(axis)
        );
    }
}
