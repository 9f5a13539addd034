//! A strip bends under its weight according to its flexural rigidity, on any mesh.

use crate::common::*;
use crate::irregular;
use selvedge::glam::DQuat;

/// The rigidity in N·m; the density below is in kg/m².
const RIGIDITY: f64 = 1e-5;
const DENSITY: f64 = 0.15;
/// The number of edges along the overhang.
const CELLS: f64 = 16.0;
const WIDTH: f64 = 0.02;

/// A square of `cells` by `cells`, from (-½, -½) to (½, ½), with alternating diagonals.
fn alternating(cells: u32) -> Mesh {
    let mut mesh = Mesh::default();
    let at = |k: u32| f64::from(k) / f64::from(cells) - 0.5;
    for row in 0..=cells {
        mesh.positions
            .extend((0..=cells).map(|column| DVec3::new(at(column), at(row), 0.0)));
    }
    for row in 0..cells {
        for column in 0..cells {
            let [a, c] = [row, row + 1].map(|row| row * (cells + 1) + column);
            let [b, d] = [a + 1, c + 1];
            mesh.triangles.extend(if (row + column) % 2 == 0 {
                [[a, b, d], [a, d, c]]
            } else {
                [[a, b, c], [b, d, c]]
            });
        }
    }
    mesh
}

/// A strip of the mesh, turned by `turn` degrees, with edges of length `h`, that hangs over by `overhang` along x.
fn strip(mesh: &Mesh, cells: u32, turn: f64, overhang: f64, h: f64) -> Mesh {
    let turn = DQuat::from_rotation_z(turn.to_radians());
    let place = |p: &DVec3| turn * (*p * (h * f64::from(cells))) + DVec3::X * (0.5 * overhang);
    let places: Vec<DVec3> = mesh.positions.iter().map(place).collect();
    let is_in = |p: DVec3| p.x > -3.2 * h && p.x < overhang + 1e-9 && p.y.abs() < 0.5 * WIDTH;
    let mut own = Mesh::default();
    let mut numbers = vec![u32::MAX; places.len()];
    for triangle in mesh.triangles.iter().filter(|t| t.iter().all(|&v| is_in(places[v as usize]))) {
        own.triangles.push(triangle.map(|vertex| {
            let number = &mut numbers[vertex as usize];
            if *number == u32::MAX {
                *number = own.positions.len() as u32;
                own.positions.push(places[vertex as usize]);
            }
            *number
        }));
    }
    own
}

/// Returns the rigidity by Peirce's test (1930), over the given one. An overhang l that bends by an angle θ from end to end has
/// the rigidity w·l³·cos(θ/2)/(8·tan θ), with w the weight per area.
fn found_over_given(mesh: &Mesh, cells: u32, turn: f64) -> f64 {
    let weight = DENSITY * 9.81;
    let overhang = 2.0 * (RIGIDITY / weight).cbrt();
    let h = overhang / CELLS;
    let mesh = strip(mesh, cells, turn, overhang, h);
    let xs = || mesh.positions.iter().map(|p| p.x);
    let (clamp, end) = (xs().filter(|x| *x <= 1e-9).fold(-1.0, f64::max), xs().fold(-1.0, f64::max));
    let of = |is_meant: &dyn Fn(f64) -> bool| -> Vec<u32> {
        let all = xs().enumerate();
        all.filter(|(_, x)| is_meant(*x)).map(|(vertex, _)| vertex as u32).collect()
    };
    let (pinned, tip) = (of(&|x| x <= 1e-9), of(&|x| x > end - 0.5 * h));
    let mut scene = Scene::new(Cloth::from_mesh(mesh, DVec3::X, DENSITY).unwrap(), 1e-3);
    scene
        .add(Gravity::default())
        .add(Stretch::isotropic(1000.0))
        .add(Shear::new(300.0))
        .add(Bend::isotropic(RIGIDITY));
    scene.add(AirDrag { rate: 8.0 });
    scene.add(resting(pinned));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let middle = |simulation: &Simulation| {
        let all = tip.iter().map(|&v| simulation.positions()[v as usize]);
        all.sum::<DVec3>() / tip.len() as f64
    };
    let length = middle(&simulation).x - clamp;
    advance(&mut simulation, 1500);
    let tip = middle(&simulation);
    let angle = (-tip.z).atan2(tip.x - clamp);
    weight * length.powi(3) * (0.5 * angle).cos() / (8.0 * angle.tan()) / RIGIDITY
}

#[test]
fn a_strip_bends_under_its_weight_as_its_rigidity_says_on_any_mesh_and_in_any_direction() {
    let cells = 48;
    for mesh in [alternating(cells), irregular::sheet(cells, 0), irregular::sheet(cells, 4)] {
        for turn in [0.0, 45.0] {
            let found = found_over_given(&mesh, cells, turn);
            assert!((0.8..=1.2).contains(&found), "turned by {turn}: {found}");
        }
    }
}

/// A row of pins holds the warp of a strip, and then its weft.
#[test]
fn the_weft_has_a_rigidity_of_its_own() {
    let cells = 12;
    let droop = |turn: f64| {
        let mesh = strip(&alternating(cells), cells, 0.0, 0.06, 0.01);
        let pinned: Vec<u32> = (0..mesh.positions.len() as u32)
            .filter(|&v| mesh.positions[v as usize].x <= 1e-9)
            .collect();
        let warp = DQuat::from_rotation_z(turn) * DVec3::X;
        let mut scene = Scene::new(Cloth::from_mesh(mesh, warp, DENSITY).unwrap(), 1e-3);
        scene.add(Gravity::default()).add(Stretch::isotropic(1000.0)).add(Bend {
            weft_stiffness: 1e-5,
            ..Bend::isotropic(1e-4)
        });
        scene.add(AirDrag { rate: 8.0 }).add(resting(pinned));
        run(scene, 1000).positions().iter().map(|p| -p.z).fold(0.0, f64::max)
    };
    let [warp, weft] = [droop(0.0), droop(std::f64::consts::FRAC_PI_2)];
    assert!(weft > 1.5 * warp, "{warp} along the warp, {weft} along the weft");
}
