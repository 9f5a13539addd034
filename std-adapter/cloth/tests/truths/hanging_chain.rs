//! The hanging chain: a rope between two points takes the form of a catenary, y = a·cosh(x/a).
//!
//! The error of a rope of straight segments grows with the square of their length.

use selvedge_cloth::effects::{AirDrag, Gravity, PinGroup, Pins, RopeStretch};
use selvedge_cloth::glam::DVec3;
use selvedge_cloth::{Cloth, Scene, Simulation};

const SPAN: f64 = 1.0;
const LENGTH: f64 = 1.25;

/// Returns the sag of a catenary in the middle; its length is 2a·sinh(span/2a).
fn sag() -> f64 {
    let length = |a: f64| 2.0 * a * (0.5 * SPAN / a).sinh();
    let (mut low, mut high) = (0.1, 10.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        // A flatter catenary is shorter.
        if length(middle) > LENGTH {
            low = middle;
        } else {
            high = middle;
        }
    }
    low * ((0.5 * SPAN / low).cosh() - 1.0)
}

/// Returns the sag of a rope of so many segments at rest.
fn hung(segments: u32, step: f64) -> f64 {
    let depth = 0.5 * (LENGTH * LENGTH - SPAN * SPAN).sqrt();
    let points = [DVec3::ZERO, DVec3::new(0.5 * SPAN, 0.0, -depth), DVec3::X * SPAN];
    let mut scene = Scene::new(Cloth::rope(&points, segments, 0.05).unwrap(), step);
    scene
        .add(Gravity::default())
        .add(AirDrag { rate: 4.0 })
        .add(RopeStretch::new(1e5));
    scene.add(Pins {
        groups: vec![PinGroup::resting([0, segments])],
    });
    let mut simulation = Simulation::new(scene, 1).unwrap();
    while simulation.time() < 6.0 {
        simulation.step().unwrap();
    }
    -simulation.positions()[segments as usize / 2].z
}

#[test]
fn a_rope_hangs_as_a_catenary_and_finer_ropes_more_so() {
    let exact = sag();
    let errors = [8, 16, 32].map(|segments| (hung(segments, 2e-3) / exact - 1.0).abs());
    println!("{exact} m; errors {errors:?}");
    assert!(
        errors[0] < 1e-2 && errors[1] < 0.35 * errors[0] && errors[2] < 0.35 * errors[1],
        "{errors:?}"
    );
}

#[test]
fn the_form_does_not_depend_on_the_time_step() {
    let [one, other] = [1e-3, 4e-3].map(|step| hung(16, step));
    assert!((one - other).abs() < 1e-4, "{one} and {other}");
}
