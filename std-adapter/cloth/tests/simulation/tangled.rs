//! Scenes that start with intersections are refused with a list, tolerated, or untangled.

use crate::common::*;
use crate::garments::{NAMES, garment};

/// Makes a garment with this response to its intersections.
fn starting(name: &str, cells: u32, depth: f64, start: TangledStart) -> Scene {
    let mut scene = garment(name, cells, depth);
    scene.tangled_start = start;
    scene
}

/// Returns whether the cloth intersects a body. Without `self_collision` the cloth may intersect itself.
fn meets_a_body(simulation: &Simulation) -> bool {
    let topology = Topology::new(simulation.positions().len(), simulation.triangles().to_vec()).unwrap();
    let is_body = |vertex: u32| vertex as usize >= simulation.cloth_vertices();
    intersections(simulation).into_iter().any(|own| {
        let Intersection::EdgeFace { edge, face } = own else {
            return true;
        };
        is_body(topology.edges()[edge as usize][0]) != is_body(topology.triangles()[face as usize][0])
    })
}

fn refused(scene: Scene) -> Tangled {
    match Simulation::new(scene, 1) {
        Err(SetupError::Tangled(tangle)) => *tangle,
        other => panic!("{:?}", other.map(|simulation| simulation.name().to_owned())),
    }
}

#[test]
fn a_refusal_lists_every_edge_and_face_that_meet_and_where() {
    let tangle = refused(garment("sheet in a ball", 12, 1.0));
    let topology = Topology::new(tangle.mesh.positions.len(), tangle.mesh.triangles.clone()).unwrap();
    let mut found = Vec::new();
    let mut detector = CollisionDetector::<f64>::new(topology);
    detector.intersections(&tangle.mesh.positions, &mut found).unwrap();
    assert!(found.len() > 20);
    let pairs: Vec<_> = tangle
        .crossings
        .iter()
        .map(|crossing| (crossing.edge, crossing.face))
        .collect();
    for intersection in &found {
        let Intersection::EdgeFace { edge, face } = *intersection else {
            panic!("{intersection:?}")
        };
        let pair = (
            detector.topology().edges()[edge as usize],
            detector.topology().triangles()[face as usize],
        );
        assert!(pairs.contains(&pair), "{pair:?}");
    }
    assert_eq!(pairs.len(), found.len());
    for crossing in &tangle.crossings {
        assert_eq!(crossing.body, Some(0));
        // The sheet lies in the plane z = 0.
        assert!(crossing.point.z.abs() < 1e-12 && crossing.point.x.abs() < 0.4);
    }
    let text = tangle.to_string();
    let expected = format!("{0} edges meet faces, {0} with the body 'ball'; first the edge ", found.len());
    assert!(
        text.contains(&expected) && text.contains("tangled_start = \"untangle\""),
        "{text}"
    );
}

#[test]
fn four_fifths_of_tangled_garments_are_free_after_untangling_and_the_others_are_told() {
    let (mut free, mut all) = (0, 0);
    for name in NAMES {
        for depth in [1.0, 2.0] {
            assert!(!refused(garment(name, 20, depth)).crossings.is_empty(), "{name}");
            all += 1;
            match Simulation::new(starting(name, 20, depth, TangledStart::Untangle), 1) {
                Ok(simulation) => {
                    assert_eq!(intersections(&simulation), [], "{name} {depth}");
                    let untangled = simulation.untangled().unwrap();
                    assert!(
                        untangled.crossings > 0 && untangled.left == 0 && simulation.is_certified(),
                        "{name}"
                    );
                    free += 1;
                }
                Err(SetupError::Tangled(tangle)) => {
                    let left = tangle.untangled.as_ref().unwrap().left;
                    assert!(left > 0 && tangle.crossings.len() == left, "{name} {depth}: {tangle}");
                }
                Err(other) => panic!("{name}: {other}"),
            }
        }
    }
    assert!(5 * free >= 4 * all, "{free} of {all}");
}

#[test]
fn what_was_untangled_goes_on_as_any_other_scene_and_is_the_same_on_two_threads() {
    let run = |threads| {
        let mut scene = starting("corner through itself", 20, 1.0, TangledStart::Untangle);
        scene.add(Gravity::default());
        let mut told = Vec::new();
        let mut simulation = Simulation::with_progress(scene, threads, &mut |untangling| told.push(untangling)).unwrap();
        assert!(
            matches!(told[0], UntanglingProgress { steps: 0, crossings } if crossings > 10),
            "{told:?}"
        );
        assert_eq!(told.last().unwrap().crossings, 0);
        assert!(simulation.velocities().iter().all(|velocity| velocity.length() == 0.0));
        assert_eq!(
            (simulation.steps_done(), simulation.contact_counts().unwrap().candidates),
            (0, 0)
        );
        advance(&mut simulation, 60);
        assert!(simulation.is_certified() && intersections(&simulation).is_empty());
        simulation.positions().to_vec()
    };
    assert_eq!(run(1), run(2));
}

#[test]
fn what_is_tolerated_is_told_and_nothing_else_comes_to_meet() {
    let mut scene = starting("corner through itself", 20, 1.0, TangledStart::Tolerate);
    scene.add(Gravity::default());
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let before = simulation.crossings().len();
    assert_eq!(before, intersections(&simulation).len());
    assert!(before > 10 && simulation.tolerated_pairs() > before && !simulation.is_certified());
    for _ in 0..100 {
        simulation.step().unwrap();
        let found = intersections(&simulation).len();
        assert_eq!(simulation.crossings().len(), found);
        assert_eq!(simulation.is_certified(), simulation.tolerated_pairs() == 0);
        assert!(found == 0 || !simulation.is_certified());
    }
}

/// A sheet and a body that is pulled out of it.
const PULLED: &str = include_str!("scenes/pulled.toml");

#[test]
fn what_comes_apart_is_in_the_promise_again_and_does_not_meet_again() {
    let mut simulation = set_up(PULLED, "pulled.toml", 1);
    assert!(!simulation.crossings().is_empty());
    let mut has_come_apart = false;
    for step in 0..300 {
        simulation.step().unwrap();
        has_come_apart |= simulation.is_certified();
        assert_eq!(simulation.is_certified(), has_come_apart, "step {step}");
        assert!(!has_come_apart || !meets_a_body(&simulation), "step {step}");
    }
    assert!(has_come_apart);
}

#[test]
fn a_tolerated_tangle_goes_on_from_a_checkpoint_to_the_same_bits() {
    let scene = || {
        let mut scene = starting("two sheets, tilted", 12, 1.0, TangledStart::Tolerate);
        scene.add(Gravity::default());
        scene
    };
    let simulation = assert_same_bits(scene, CHECKPOINT_STEPS, 50);
    assert!(simulation.tolerated_pairs() > 0);
}

#[test]
fn a_file_says_the_same_as_code_and_what_nothing_keeps_apart_is_an_error() {
    let file = |text: &str| Scene::parse(text, &scene_file("pulled.toml"));
    assert_eq!(file(PULLED).unwrap().tangled_start, TangledStart::Tolerate);
    let untangled = file(&PULLED.replace("\"tolerate\"", "\"untangle\"")).unwrap();
    assert_eq!(untangled.tangled_start, TangledStart::Untangle);
    let mut scene = starting("curls", 8, 1.0, TangledStart::Untangle);
    assert!(scene.check().is_ok());
    let effects = scene
        .effect_names()
        .iter()
        .position(|name| *name == "self_collision")
        .unwrap();
    scene.keep_first_effects(effects);
    assert!(scene.check().unwrap_err().to_string().contains("tangled_start"));
}

/// A closed body between two rings of vertices, with upright walls if both have the same radius.
fn frustum(around: u32, [lower, upper]: [f64; 2], half: f64) -> Mesh {
    let at = |k: u32, radius: f64, z: f64| {
        let (sine, cosine) = (std::f64::consts::TAU * (f64::from(k) + 0.3) / f64::from(around)).sin_cos();
        DVec3::new(radius * cosine, radius * sine, z)
    };
    let mut mesh = Mesh::default();
    mesh.positions.extend((0..around).map(|k| at(k, lower, -half)));
    mesh.positions.extend((0..around).map(|k| at(k, upper, half)));
    mesh.positions.extend([-half, half].map(|z| DVec3::Z * z));
    let [bottom, top] = [2 * around, 2 * around + 1];
    for k in 0..around {
        let next = (k + 1) % around;
        let walls = [[k, next, around + next], [k, around + next, around + k]];
        mesh.triangles
            .extend(walls.into_iter().chain([[bottom, next, k], [top, around + k, around + next]]));
    }
    mesh
}

#[test]
fn cloth_comes_out_of_bodies_with_upright_walls() {
    let bodies = [
        ("cube", 4, [0.2; 2]),
        ("cylinder", 24, [0.2; 2]),
        ("widening", 24, [0.12, 0.2]),
    ];
    for (name, around, radii) in bodies {
        let corner = DVec3::new(-0.297, -0.298, 0.05);
        let sheet = Cloth::sheet(corner, [0.6 * DVec3::X, 0.6 * DVec3::Y], [16, 16], 0.15).unwrap();
        let mut scene = Scene::new(sheet, 4e-3);
        scene.bodies.push(Body::from_mesh("body", frustum(around, radii, 0.1)));
        scene.add(Stretch::isotropic(200.0)).add(Bend::isotropic(1e-5));
        scene
            .add(BodyContact(Thickness::new(4e-3)))
            .add(SelfCollision(Thickness::new(4e-3)));
        scene.tangled_start = TangledStart::Untangle;
        let simulation = Simulation::new(scene, 1).unwrap();
        assert_eq!(intersections(&simulation), [], "{name}");
        assert!(simulation.is_certified() && simulation.time() == 0.0 && simulation.checkpoint().is_some());
        let body = simulation.body_vertices(0).unwrap();
        assert_eq!(simulation.positions()[body], frustum(around, radii, 0.1).positions);
    }
}

#[test]
#[ignore = "not kept yet: cloth wholly inside a body crosses nothing, so nothing untangles it"]
fn a_waist_that_is_too_small_goes_around_its_limb() {
    let tube = Cloth::tube([-0.06 * DVec3::Z, 0.06 * DVec3::Z], 0.1, [32, 8], 0.15).unwrap();
    let mut scene = Scene::new(tube, 4e-3);
    scene
        .bodies
        .push(Body::capsule("limb", [-0.25 * DVec3::Z, 0.25 * DVec3::Z], 0.12, 24).unwrap());
    scene.add(Stretch::isotropic(200.0)).add(Bend::isotropic(1e-5));
    scene
        .add(BodyContact(Thickness::new(4e-3)))
        .add(SelfCollision(Thickness::new(4e-3)));
    scene.tangled_start = TangledStart::Untangle;
    let simulation = Simulation::new(scene, 1).unwrap();
    assert_eq!(intersections(&simulation), []);
    let waist = simulation.vertices_of_cloth(0).unwrap();
    let narrowest = { simulation.positions()[waist].iter() }
        .map(|p| p.with_z(0.0).length())
        .fold(f64::MAX, f64::min);
    assert!(narrowest > 0.11, "{narrowest}");
}
