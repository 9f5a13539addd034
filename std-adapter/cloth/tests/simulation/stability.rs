//! No setting makes a position non-finite or lets it escape.

use crate::common::*;

fn stays_finite(name: &str, steps: usize, change: impl Fn(String) -> String, what: &str) {
    let mut simulation = load(name, change, 1);
    for step in 0..steps {
        simulation.step().unwrap();
        let positions = simulation.positions();
        assert!(positions.iter().all(|p| p.is_finite()), "{name} with {what}, step {step}");
        // Speeds are limited, so no vertex escapes.
        let farthest = positions.iter().map(|p| p.length()).fold(0.0, f64::max);
        assert!(farthest < 1e3, "{name} with {what}, step {step}: {farthest} m away");
    }
}

#[test]
fn stiffness_over_twelve_orders_of_magnitude_and_any_time_step() {
    for stiffness in ["0.001", "1", "1000", "1e6", "1e9"] {
        for time_step in ["0.00001", "0.002", "0.0166"] {
            let change = |text: String| {
                let text = text.replace("\"2 kN/m\"", stiffness);
                text.replace("\"2 ms\"", time_step)
            };
            let what = format!("stiffness {stiffness}, time step {time_step}");
            stays_finite("hanging.toml", 60, change, &what);
            let change = |text: String| {
                let text = text.replace("\"1 kN/m\"", stiffness).replace("\"200 N/m\"", stiffness);
                text.replace("\"20 uN m\"", "1").replace("\"2 ms\"", time_step)
            };
            stays_finite("flag.toml", 60, change, &what);
        }
    }
}

#[test]
fn a_hurricane_and_no_air_at_all() {
    let strong = |text: String| text.replace("[7, 1.5, 0]", "[1000, 0, 300]");
    stays_finite("flag.toml", 100, strong, "1000 m/s");
    let thick = |text: String| text.replace("gust = 0.4", "gust = 1\nair_density = 1000\ndrag = 100");
    stays_finite("flag.toml", 100, thick, "air as dense as water");
    let thin = |text: String| text.replace("gust = 0.4", "air_density = 0");
    stays_finite("flag.toml", 100, thin, "no air");
}

/// A pinned vertex too near to a body has all the weight of its pairs, and its neighbours have a rounding error of it. They must
/// not move far to compensate.
#[test]
fn what_is_pinned_too_near_to_a_body_flings_nothing_away() {
    // The sheet is 35 µm from the body, across the slopes.
    let [above, thickness] = [50e-6, 50e-6];
    let cloth = Cloth::from_mesh(folded(2, 0..4, 0.0), DVec3::X, 0.2).unwrap();
    let ends = (0..4).flat_map(|row| [5 * row, 5 * row + 4]).collect::<Vec<u32>>();
    let mut scene = Scene::new(cloth, 1e-3);
    scene.bodies = vec![Body::from_mesh("wedge", folded(3, -1..5, above))];
    scene.add(resting(ends));
    scene.add(Stretch::isotropic(100.0));
    scene.add(BodyContact(Thickness::new(thickness)));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for _ in 0..20 {
        let before = simulation.positions().to_vec();
        simulation.step().unwrap();
        let ways = before.iter().zip(simulation.positions()).map(|(a, b)| (*b - *a).length());
        let farthest = ways.fold(0.0, f64::max);
        assert!(farthest < thickness, "{farthest} m in a step of {}", simulation.time());
    }
}
