//! Motions along keyframes: as tools export them, steady, and never faster than a vertex may be.

use crate::common::*;

/// A patch on a plate of two metres, with friction.
fn on_a_plate(centre: DVec3, motion: BodyMotion) -> Scene {
    let sides = [0.04 * DVec3::X, 0.04 * DVec3::Y];
    let cloth = Cloth::sheet(centre + DVec3::new(-0.02, -0.02, 2.1e-3), sides, [4, 4], 0.3).unwrap();
    let mut scene = Scene::new(cloth, 1e-3);
    let corners = [[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [-2.0, 2.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    let mut plate = Body::from_mesh("plate", Mesh::new(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]]));
    plate.motion = motion;
    scene.bodies.push(plate);
    scene
        .add(Gravity::default())
        .add(Stretch::isotropic(300.0))
        .add(Shear::new(100.0));
    scene
        .add(BodyContact(Thickness::new(2e-3)))
        .add(Friction { coefficient: 0.5 });
    scene
}

fn centre(simulation: &Simulation) -> DVec3 {
    let cloth = &simulation.positions()[..simulation.cloth_vertices()];
    cloth.iter().sum::<DVec3>() / cloth.len() as f64
}

#[test]
fn a_belt_keyed_thirty_times_a_second_carries_cloth_as_far_as_it_goes() {
    let key = |time| Keyframe {
        time,
        translation: DVec3::X * time,
        ..Keyframe::default()
    };
    let keys: Vec<Keyframe> = (0..=33).map(|k| key(f64::from(k) / 30.0)).collect();
    for interpolation in [Interpolation::Linear, Interpolation::Spline] {
        let belt = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys.clone()).unwrap();
        let mut scene = on_a_plate(DVec3::ZERO, belt.interpolated(interpolation).into());
        scene.cloths[0].velocity = DVec3::X;
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let start = centre(&simulation).x;
        for _ in 0..1000 {
            simulation.step().unwrap();
        }
        let way = centre(&simulation).x - start;
        assert!((way - 1.0).abs() < 1e-3, "{interpolation:?}: {way} m");
    }
}

#[test]
fn a_turntable_at_a_steady_rate_is_one_line_and_carries_cloth_round() {
    let text = r#"
        duration = "1 s"
        time_step = "1 ms"
        [cloth]
        shape = "sheet"
        corner = [0.18, -0.02, 0.0021]
        sides = { first = [0.04, 0, 0], second = [0, 0.04, 0] }
        cells = [4, 4]
        density = "300 g/m2"
        velocity = [0, 0.6, 0]
        [[body]]
        name = "table"
        shape = "file"
        file = "plate.obj"
        rate = "3 rad/s"
        [effects]
        gravity = {}
        stretch = { stiffness = "300 N/m" }
        shear = { stiffness = "100 N/m" }
        body_contact = { thickness = "2 mm" }
        friction = { coefficient = 0.5 }
    "#;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("plate.obj"),
        "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nf 1 2 3 4\n",
    )
    .unwrap();
    let scene = Scene::parse(text, &folder.path().join("table.toml")).unwrap();
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for _ in 0..1000 {
        simulation.step().unwrap();
    }
    // ω²r = 1.8 m/s² is less than µg, so the patch stays on its place of the table.
    let expected = DVec3::new(0.2 * 3.0_f64.cos(), 0.2 * 3.0_f64.sin(), centre(&simulation).z);
    let off = centre(&simulation).distance(expected);
    assert!(off < 8e-3, "{off} m off");
}

#[test]
fn a_jump_in_keyframes_is_refused_with_the_line_the_time_and_the_speed() {
    let scene = |motion: &str| {
        let text = format!(
            "duration = 1\n[cloth]\nshape = \"sheet\"\ncorner = [0, 0, 0]\nsides = {{ first = [1, 0, 0], second = [0, 1, 0] }}\ncells = [2, 2]\n\
             density = \"200 g/m2\"\n[[body]]\nname = \"ball\"\nshape = \"ball\"\ncentre = [0, 0, -1]\nradius = 0.1\n{motion}\n[effects]\n"
        );
        Scene::parse(&text, Path::new("scene.toml"))
            .map(drop)
            .map_err(|error| error.to_string())
    };
    let jump = "keyframes = [{ time = 0 }, { time = 0.2 }, { time = 0.201, translation = [2, 0, 0] }]";
    let error = scene(jump).unwrap_err();
    assert!(
        error.contains("scene.toml:13:13: a vertex moves at 2000 m/s from 0.200 s on, but must not be faster than 100 m/s"),
        "{error}"
    );
    let error = scene("rate = \"100000 deg/s\"").unwrap_err();
    assert!(
        error.contains("scene.toml:13:8: a vertex moves at 175 m/s from 0.000 s on"),
        "{error}"
    );
    let error = scene("interpolation = \"spline\"").unwrap_err();
    assert!(
        error.contains("`interpolation` is for keyframes, but there is none"),
        "{error}"
    );
    let error = scene("keyframes = [{ time = 0 }]\ninterpolation = \"bezier\"").unwrap_err();
    assert!(error.contains("`interpolation` cannot be 'bezier'"), "{error}");
    assert_eq!(scene(&jump.replace("0.201", "0.25")), Ok(()));
}

#[test]
fn pins_that_jump_are_refused_as_bodies_are() {
    let motion = along([(0.0, DVec3::ZERO), (0.01, DVec3::X)]);
    let sheet = || Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [2, 2], 0.2).unwrap();
    let mut scene = Scene::new(sheet(), 1e-3);
    scene.add(pinned([0], PinMotion::Own(motion)));
    let error = Simulation::new(scene, 1).unwrap_err().to_string();
    assert!(
        error.starts_with("pins: a vertex moves at 150 m/s from 0.000 s on"),
        "{error}"
    );
    // A vertex that follows a body is as far from its axis as it is.
    let mut scene = Scene::new(sheet(), 1e-3);
    let mut hub = Body::ball("hub", DVec3::new(0.0, 0.0, -1.0), 0.1, 8).unwrap();
    hub.motion = KeyframeMotion::new(DVec3::ZERO, DVec3::Z, Vec::new())
        .unwrap()
        .spinning(90.0)
        .into();
    scene.bodies.push(hub);
    scene.add(pinned([8], PinMotion::Body(0)));
    let error = Simulation::new(scene, 1).unwrap_err().to_string();
    assert!(error.starts_with("pins: a vertex moves at 127 m/s"), "{error}");
}
