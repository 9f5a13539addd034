//! What happens where bodies leave the cloth no room.

use crate::common::{scene_file, set_up};
use selvedge_cloth::{Scene, Simulation};

/// A ball comes down on another one, with the cloth in between, and goes up again.
fn press(on_blocked: &str) -> Simulation {
    let text = format!(
        r#"
        time_step = "1 ms"
        duration = "1 s"
        on_blocked = "{on_blocked}"
        [cloth]
        shape = "sheet"
        corner = [-0.15, -0.15, 0.105]
        sides = {{ first = [0.3, 0, 0], second = [0, 0.3, 0] }}
        cells = [12, 12]
        density = "200 g/m2"
        [[body]]
        name = "anvil"
        shape = "ball"
        centre = [0, 0, 0]
        radius = "0.1"
        [[body]]
        name = "hammer"
        shape = "ball"
        centre = [0.01, 0, 0.25]
        radius = "0.1"
        keyframes = [
            {{ time = 0 }},
            {{ time = "0.1 s", translation = [0, 0, -0.15] }},
            {{ time = "0.3 s", translation = [0, 0, 0.2] }},
        ]
        [effects.gravity]
        [effects.stretch]
        stiffness = 300
        [effects.body_contact]
        thickness = "3 mm"
        [effects.self_collision]
        thickness = "3 mm"
        "#
    );
    set_up(&text, "press.toml", 1)
}

#[test]
fn stop_ends_the_simulation_and_names_the_body_and_the_time() {
    let mut simulation = press("stop");
    let blocked = (0..400).find_map(|_| simulation.step().err()).expect("no room is left");
    let body = blocked.body.as_deref().unwrap();
    assert!(["anvil", "hammer"].contains(&body), "{blocked}");
    assert!((0.02..0.1).contains(&blocked.time), "{blocked}");
    assert!(blocked.to_string().contains(body));
    assert!(simulation.is_certified());
}

#[test]
fn hold_lets_the_bodies_wait_and_tells_for_how_long() {
    let mut simulation = press("hold");
    for _ in 0..150 {
        simulation.step().unwrap();
        assert!(simulation.is_certified());
    }
    assert!(simulation.blocked_steps() > 0);
    let lag = simulation.lag();
    assert!(lag > 0.02 && lag < 0.15, "{lag}");
}

#[test]
fn yield_lets_the_body_pass_and_takes_it_back_when_it_is_apart() {
    let mut simulation = press("yield");
    let mut has_yielded = false;
    for _ in 0..900 {
        simulation.step().unwrap();
        has_yielded |= !simulation.is_certified();
    }
    assert!(has_yielded);
    assert_eq!(simulation.lag(), 0.0);
    assert!(simulation.positions().iter().all(|p| p.is_finite()));
}

/// Edges of a coarse sheet through faces of a coarse ball: no vertex is near a face, and hardly an edge near an edge.
#[test]
fn a_start_that_passes_through_a_body_is_refused_with_the_pair_named() {
    let text = r#"
        time_step = "1 ms"
        duration = "1 s"
        [cloth]
        shape = "sheet"
        corner = [-0.21, -0.19, 0.05]
        sides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }
        cells = [4, 4]
        density = "200 g/m2"
        [[body]]
        name = "ball"
        shape = "ball"
        centre = [0, 0, 0]
        radius = "10 cm"
        around = 8
        [effects.body_contact]
        thickness = "1 mm"
    "#;
    let scene = Scene::parse(text, &scene_file("through.toml")).unwrap();
    let error = Simulation::new(scene, 1).unwrap_err().to_string();
    let named = "the scene starts with an intersection: 24 edges meet faces, 24 with the body 'ball'; first the edge ";
    assert!(error.starts_with(named), "{error}");
}
