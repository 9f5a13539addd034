//! Where nothing does work, energy does not grow.

use crate::scene_file;
use selvedge::simulation::{Scene, Simulation};

/// A sheet that is thrown, held at one side that rests, against a ball that rests, without gravity and without air.
const THROWN: &str = r#"
time_step = "1 ms"
duration = "2 s"
[cloth]
shape = "sheet"
corner = [-0.2, -0.2, 0.2]
sides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }
cells = [16, 16]
density = "200 g/m2"
velocity = [0.4, 0.3, -2]
[[body]]
name = "ball"
shape = "ball"
centre = [0, 0, 0]
radius = "10 cm"
[[effects.pins.group]]
part = "left"
[effects.stretch]
stiffness = "300 N/m"
[effects.shear]
stiffness = "100 N/m"
[effects.bend]
stiffness = "10 uN m"
[effects.body_contact]
thickness = "3 mm"
[effects.self_collision]
thickness = "3 mm"
[effects.friction]
coefficient = 0.2
"#;

/// Energy starts as energy of motion, and can only become elastic energy, which is not negative, and heat. So the energy of motion
/// never exceeds that of the start.
#[test]
fn a_thrown_sheet_never_moves_faster_than_it_was_thrown() {
    let scene = Scene::parse(THROWN, &scene_file("thrown.toml")).unwrap();
    let (steps, h) = (scene.steps(), scene.time_step);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let cloth = simulation.cloth_vertices();
    // A vertex's mass is a third of its triangles', all of one area but for rounding: count them.
    let mut shares = vec![0.0; cloth];
    for &vertex in simulation.triangles()[..simulation.cloth_triangles()]
        .iter()
        .flatten()
    {
        shares[vertex as usize] += 1.0;
    }
    let mut before = simulation.positions()[..cloth].to_vec();
    let mut energies = Vec::new();
    for step in 0..steps {
        simulation
            .step()
            .unwrap_or_else(|blocked| panic!("{blocked}"));
        let now = &simulation.positions()[..cloth];
        let squared = now
            .iter()
            .zip(&before)
            .map(|(now, before)| ((*now - *before) / h).length_squared());
        let energy: f64 = squared
            .zip(&shares)
            .map(|(squared, share)| 0.5 * share * squared)
            .sum();
        energies.push(energy);
        assert!(energy.is_finite(), "step {step}");
        before = now.to_vec();
    }
    // All vertices but the seventeen that are held, of which fifteen have three triangles, one two and one one.
    let all: f64 = shares.iter().sum();
    let thrown = 0.5 * (all - 48.0) * (0.4 * 0.4 + 0.3 * 0.3 + 2.0 * 2.0);
    let most = energies
        .iter()
        .fold(0.0, |most: f64, &energy| most.max(energy));
    // A billionth for the rounding of differences.
    assert!(most <= thrown * (1.0 + 1e-9), "{most} of {thrown}");
    // It did hit the ball, and has lost energy by the end.
    assert!(simulation.contact_counts().unwrap().pushed > 1000);
    assert!(energies[energies.len() - 1] < 0.5 * thrown);
}
