//! Cloth that starts in another shape than it rests in.

use crate::common::*;
use std::ops::ControlFlow;

fn sheet() -> Cloth {
    let corner = DVec3::new(-0.15, -0.15, 0.0);
    Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [10, 10], 0.2).unwrap()
}

/// The sheet bent around a cylinder about y, without any stretch along x or y.
fn bent() -> Vec<DVec3> {
    let bend = |p: &DVec3| DVec3::new(0.1 * (p.x / 0.1).sin(), p.y, 0.1 * (p.x / 0.1).cos());
    sheet().mesh().positions.iter().map(bend).collect()
}

#[test]
fn lengths_and_angles_at_rest_are_those_of_the_rest_shape() {
    let mut scene = Scene::new(sheet().starting_at(bent()).unwrap(), 2e-3);
    scene.add(Stretch::isotropic(500.0)).add(Bend::isotropic(1e-3));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    assert_eq!(simulation.positions(), bent());
    let height = |simulation: &Simulation| {
        let heights = simulation.positions().iter().map(|p| p.z);
        heights.clone().fold(f64::MIN, f64::max) - heights.fold(f64::MAX, f64::min)
    };
    let before = height(&simulation);
    let mut lowest = before;
    for _ in 0..100 {
        simulation.step().unwrap();
        lowest = lowest.min(height(&simulation));
    }
    // It swings through its rest shape, which is flat.
    assert!(lowest < 0.5 * before, "{before} {lowest}");
}

#[test]
fn pins_hold_vertices_where_they_start() {
    let mut scene = Scene::new(sheet().starting_at(bent()).unwrap(), 2e-3);
    scene
        .add(Gravity::default())
        .add(Stretch::isotropic(500.0))
        .add(resting(vec![0, 10]));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    simulation.step().unwrap();
    assert_eq!(
        [0, 10].map(|vertex| simulation.positions()[vertex]),
        [0, 10].map(|vertex| bent()[vertex])
    );
}

#[test]
fn another_start_is_another_scene_to_checkpoints() {
    let made = |cloth: Cloth| {
        let mut scene = Scene::new(cloth, 2e-3);
        scene.add(Gravity::default());
        Simulation::new(scene, 1).unwrap()
    };
    let checkpoint = made(sheet()).checkpoint().unwrap();
    assert!(made(sheet()).resume(&checkpoint).is_ok());
    assert!(made(sheet().starting_at(bent()).unwrap()).resume(&checkpoint).is_err());
}

#[test]
fn a_start_needs_a_position_for_each_vertex_and_no_flat_triangles() {
    let error = sheet().starting_at(bent()[1..].to_vec()).unwrap_err();
    assert!(error.to_string().contains("120 positions"), "{error}");
    assert!(sheet().starting_at(vec![DVec3::ZERO; 121]).is_err());
    assert!(sheet().starting_at(vec![DVec3::NAN; 121]).is_err());
}

#[test]
fn a_mesh_from_code_has_a_rest_shape_in_the_place_of_the_start() {
    let mut mesh = sheet().mesh().clone();
    mesh.positions = bent();
    let context = SceneContext {
        meshes: vec![NamedMesh {
            rest: Some(sheet().mesh().positions.clone()),
            ..NamedMesh::new("sheet", mesh)
        }],
        is_run_by_code: true,
        ..SceneContext::default()
    };
    let text = r#"
    cloth = { shape = "mesh", mesh = "sheet", material = "cotton", translation = [0, 0, 1], scale = 2 }
    effects = { stretch = {} }
    "#;
    let scene = Scene::parse_in(text, Path::new("scene.toml"), &context).unwrap();
    let cloth = &scene.cloths[0];
    let placed = |positions: &[DVec3]| positions.iter().map(|p| 2.0 * *p + DVec3::Z).collect::<Vec<_>>();
    assert_eq!(cloth.start(), placed(&bent()));
    assert_eq!(cloth.mesh().positions, placed(&sheet().mesh().positions));
    assert!(!scene.has_duration());
    let error = Scene::parse_in(&text.replace("\"sheet\"", "\"shet\""), Path::new("scene.toml"), &context).unwrap_err();
    assert!(error.message.contains("did you mean 'sheet'"), "{error}");
    assert_eq!(
        error.field(&text.replace("\"sheet\"", "\"shet\"")).as_deref(),
        Some("cloth.mesh")
    );
}

#[test]
fn a_frame_that_is_stopped_has_made_whole_steps_and_goes_on() {
    let mut scene = Scene::new(sheet(), 2e-3);
    scene.add(Gravity::default()).add(Stretch::isotropic(500.0));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let mut told = Vec::new();
    let frame = simulation.advance_while(0.1, 64, &mut |now| {
        told.push(now);
        if now.steps == 3 {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    assert_eq!(frame.unwrap().steps, 3);
    assert_eq!(told.iter().map(|now| now.steps).collect::<Vec<_>>(), [1, 2, 3]);
    let expected = 3.0 * 0.1 / f64::from(told[0].of);
    assert!((simulation.time() - expected).abs() < 1e-9);
    assert!((told[2].time - expected).abs() < 1e-9);
    simulation.advance(0.1).unwrap();
    assert!((simulation.time() - expected - 0.1).abs() < 1e-9);
}

#[test]
fn pinned_vertices_in_a_tangled_start_are_named() {
    let cloth = sheet();
    let pinned = 60;
    let mut scene = Scene::new(cloth, 2e-3);
    scene
        .bodies
        .push(Body::ball("ball", DVec3::new(0.0, 0.0, 0.01), 0.02, 12).unwrap());
    scene.add(BodyContact(Thickness::new(2e-3))).add(resting(vec![pinned]));
    scene.tangled_start = TangledStart::Refuse;
    let error = Simulation::new(scene, 1).unwrap_err().to_string();
    assert!(error.contains("1 pinned vertex is there (60)"), "{error}");
}
