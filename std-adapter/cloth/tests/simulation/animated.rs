//! Bodies that deform: frames of files and of code, skinned figures.

use crate::common::*;
use selvedge_cloth::files::animation::{Choice, read};
use selvedge_cloth::files::mesh;

/// Counts the intersections of the cloth by the exact test, which is independent of the certificate.
fn crossings(simulation: &Simulation) -> usize {
    let topology = selvedge::Topology::new(simulation.positions().len(), simulation.triangles().to_vec()).unwrap();
    let cloth = |vertex: u32| (vertex as usize) < simulation.cloth_vertices();
    let found = intersections(simulation);
    let with_cloth = found.iter().filter(|intersection| match **intersection {
        selvedge::Intersection::EdgeFace { edge, face } => {
            cloth(topology.edges()[edge as usize][0]) || cloth(topology.triangles()[face as usize][0])
        }
        // The certificate excludes only edges through faces.
        _ => false,
    });
    with_cloth.count()
}

/// A ball of two shapes that swells and shrinks, as frames.
fn breathing(frames: usize) -> (Vec<[u32; 3]>, Vec<Vec<DVec3>>) {
    let rest = Body::ball("ball", DVec3::ZERO, 0.06, 16).unwrap().mesh;
    let frame = |index: usize| {
        let by = 1.0 + 0.3 * (index as f64).sin().powi(2);
        rest.positions.iter().map(|p| *p * DVec3::new(by, by, 2.0 - by)).collect()
    };
    (rest.triangles.clone(), (0..frames).map(frame).collect())
}

fn sheet(height: f64) -> Cloth {
    let corner = DVec3::new(-0.15, -0.15, height);
    Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [12; 2], 0.2).unwrap()
}

fn scene_with(cloth: Cloth, bodies: Vec<Body>) -> Scene {
    let mut scene = Scene::new(cloth, 2e-3);
    scene.bodies = bodies;
    scene.add(Gravity::default()).add(Stretch::isotropic(200.0));
    scene.add(BodyContact(Thickness::new(4e-3)));
    scene.add(SelfCollision(Thickness::new(4e-3)));
    scene
}

fn on_breathing_ball() -> Scene {
    let (triangles, frames) = breathing(12);
    let animation = Animation::from_frames(frames, 24.0).unwrap().starting_at(0.1);
    scene_with(sheet(0.08), vec![Body::animated("ball", triangles, animation)])
}

#[test]
fn at_each_step_a_body_is_exactly_where_its_animation_says_and_rests_before_and_after() {
    let mut simulation = Simulation::new(on_breathing_ball(), 1).unwrap();
    let (_, frames) = breathing(12);
    let vertices = simulation.body_vertices(0).unwrap();
    let animation = Animation::from_frames(frames.clone(), 24.0).unwrap().starting_at(0.1);
    assert_eq!(&simulation.positions()[vertices.clone()], frames[0]);
    for step in 1..=350 {
        simulation.step().unwrap();
        assert!(simulation.is_certified());
        assert_eq!(crossings(&simulation), 0, "step {step}");
        let now = &simulation.positions()[vertices.clone()];
        let expected = animation.positions_at(simulation.time());
        // The clock is a sum, but the time is a product.
        let differ = now.iter().zip(&expected).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
        assert!(differ < 1e-12, "step {step}: {differ}");
        match step {
            ..=49 => assert!(now == frames[0], "before the first key"),
            290.. => assert!(now == frames[11], "after the last"),
            _ => {}
        }
    }
    assert_eq!((simulation.lag(), simulation.blocked_steps()), (0.0, 0));
}

#[test]
fn a_body_of_frames_gives_the_same_bits_on_any_number_of_threads_and_resumed() {
    assert_same_bits(on_breathing_ball, CHECKPOINT_STEPS, 60);
    // Another animation makes another scene.
    let mut scene = on_breathing_ball();
    let (triangles, frames) = breathing(11);
    scene.bodies[0] = Body::animated(
        "ball",
        triangles,
        Animation::from_frames(frames, 24.0).unwrap().starting_at(0.1),
    );
    let checkpoint = run(on_breathing_ball(), 0).checkpoint().unwrap();
    assert_eq!(run(scene, 0).resume(&checkpoint), Err(CheckpointError::OtherScene));
}

/// Two soft bodies that close on the sheet from both sides, pass into each other, and open again.
fn pinched(on_blocked: OnBlocked) -> Simulation {
    let plate = |name: &str, side: f64| {
        let ball = Body::ball(name, DVec3::ZERO, 0.06, 16).unwrap().mesh;
        let frame = |distance: f64| ball.positions.iter().map(|p| *p + DVec3::Z * (side * distance)).collect();
        let frames = vec![frame(0.08), frame(0.05), frame(0.05), frame(0.12)];
        Body::animated(name, ball.triangles.clone(), Animation::from_frames(frames, 5.0).unwrap())
    };
    let mut scene = scene_with(sheet(0.0), vec![plate("below", -1.0), plate("above", 1.0)]);
    scene.on_blocked = on_blocked;
    Simulation::new(scene, 1).unwrap()
}

#[test]
fn stop_names_the_body_hold_lets_the_clock_wait_and_yield_lets_it_pass() {
    let mut stops = pinched(OnBlocked::Stop);
    let blocked = (0..200).find_map(|_| stops.step().err()).expect("no room is left");
    let body = blocked.body.as_deref().unwrap();
    assert!(
        ["below", "above"].contains(&body) && blocked.to_string().contains(body),
        "{blocked}"
    );
    assert!((0.1..0.2).contains(&blocked.time), "{blocked}");
    assert!(stops.is_certified() && crossings(&stops) == 0);

    let mut holds = pinched(OnBlocked::Hold);
    for _ in 0..200 {
        holds.step().unwrap();
        assert!(holds.is_certified());
    }
    assert_eq!(crossings(&holds), 0);
    assert!(holds.lag() > 0.05 && holds.blocked_steps() > 0, "{}", holds.lag());
    // The body is where its clock is.
    let ball = Body::ball("below", DVec3::ZERO, 0.06, 16).unwrap().mesh;
    let height = holds.positions()[holds.body_vertices(0).unwrap().start].z - ball.positions[0].z;
    let clock = holds.time() - holds.lag();
    assert!((height - (-0.08 + 0.03 * clock * 5.0)).abs() < 1e-9, "{height} at {clock}");

    let mut yields = pinched(OnBlocked::Yield);
    let mut has_yielded = false;
    for _ in 0..400 {
        yields.step().unwrap();
        has_yielded |= !yields.is_certified();
        assert!(
            !yields.is_certified() || crossings(&yields) == 0,
            "step {}",
            yields.steps_done()
        );
    }
    assert!(has_yielded && yields.lag() == 0.0);
}

#[test]
fn numbered_files_and_frames_of_code_make_the_same_scene() {
    let folder = tempfile::tempdir().unwrap();
    let (triangles, frames) = breathing(5);
    for (number, frame) in frames.iter().enumerate() {
        let triangles = triangles.clone();
        let mesh = Mesh::new(frame.clone(), triangles);
        mesh::write(&folder.path().join(format!("ball-{number:04}.ply")), &mesh).unwrap();
    }
    let of_files = |files: &str| {
        let text = include_str!("scenes/frames.toml").replace("ball-####.ply", files);
        Scene::parse(&text, &folder.path().join("s.toml")).unwrap()
    };
    let animation = Animation::from_frames(frames, 24.0).unwrap().starting_at(0.02);
    let of_code = scene_with(sheet(0.08), vec![Body::animated("ball", triangles, animation)]);
    let [expected, pattern, folder] = [of_code, of_files("ball-####.ply"), of_files(".")].map(|scene| bits(&run(scene, 100)));
    assert!(pattern == expected && folder == expected);
}

/// In the first states of the shipped scene the figure starts to walk with one arm up.
#[test]
fn a_walking_figure_never_passes_through_its_shirt() {
    let mut simulation = load("walker.toml", |text| text, 1);
    for step in 1..=520 {
        simulation.step().unwrap();
        assert!(simulation.is_certified(), "step {step}");
        assert_eq!(crossings(&simulation), 0, "step {step}");
    }
    assert_eq!(simulation.blocked_steps(), 0);
    // The shirt has followed the figure.
    let cloth = &simulation.positions()[..simulation.cloth_vertices()];
    let middle = cloth.iter().map(|p| p.z).sum::<f64>() / cloth.len() as f64;
    assert!(middle > 1.0, "{middle}");
}

#[test]
fn a_skinned_figure_gives_the_same_bits_on_any_number_of_threads_and_resumed() {
    assert_same_bits(|| Scene::read(&scene_file("walker.toml")).unwrap(), CHECKPOINT_STEPS, 50);
}

#[test]
fn a_figure_of_code_is_that_of_the_file() {
    let figure = read(
        &scene_file("walker.glb"),
        &Choice {
            node: Some("figure"),
            animation: Some("walk"),
            at_rest: false,
        },
    )
    .unwrap();
    let triangles = figure.mesh().triangles.clone();
    let body = Body::animated("figure", triangles, Animation::from_figure(figure).unwrap());
    let of_file = Scene::read(&scene_file("walker.toml")).unwrap();
    assert_eq!(of_file.bodies[0].mesh, body.mesh);
    assert_eq!(of_file.bodies[0].motion, body.motion);
}

#[test]
fn pins_may_be_animated_as_well() {
    let cloth = sheet(0.2);
    let top = cloth.part("top").unwrap().to_vec();
    let at_rest: Vec<DVec3> = top.iter().map(|&vertex| cloth.mesh().positions[vertex as usize]).collect();
    let moved = at_rest.iter().map(|p| *p + DVec3::Z * 0.05).collect();
    let animation = Animation::from_frames(vec![at_rest, moved], 10.0).unwrap();
    let pins = |vertices: Vec<u32>| pinned(vertices, PinMotion::Own(BodyMotion::Animated(animation.clone())));
    let mut scene = scene_with(sheet(0.2), vec![Body::ball("ball", DVec3::ZERO, 0.06, 16).unwrap()]);
    scene.add(pins(top.clone()));
    let simulation = run(scene, 60);
    assert_eq!(simulation.positions()[top[3] as usize].z, 0.25);
    assert_complaints! { on_breathing_ball();
        |s| _ = s.add(pins(vec![0, 1])) => "pins: the animation has 13 vertices, but it moves 2";
        |s| _ = s.add(pinned([0], PinMotion::Body(0)))
            => "pins: pins cannot follow 'ball', which deforms; give them a motion of their own";
    }
}

#[test]
fn animations_that_cannot_be_are_refused_where_they_are_made() {
    let frame = |x: f64| vec![DVec3::ZERO, DVec3::X, DVec3::new(x, 1.0, 0.0)];
    let made = |frames, rate| Animation::from_frames(frames, rate);
    assert_errors! {
        made(vec![], 24.0) => "an animation needs at least one frame";
        made(vec![frame(0.0), vec![]], 24.0) => "frame 1 has 0 vertices, but the first has 3";
        made(vec![frame(0.0), frame(f64::NAN)], 24.0) => "frame 1 has vertex 2 at [NaN, 1, 0]…";
    }
    let far = made(vec![frame(1e4)], 24.0).unwrap_err().to_string();
    assert!(far.contains("which is not within 1000 metres"), "{far}");
    for rate in [-24.0, 0.0, f64::NAN, f64::INFINITY] {
        assert_errors! { made(vec![frame(0.0)], rate) => "`frames_per_second` is …"; }
    }
    let scene = |animation: Animation| scene_with(sheet(0.5), vec![Body::animated("leaf", vec![[0, 1, 2]], animation)]);
    // This is a cut: five metres from one frame to the next.
    let cut = made(vec![frame(0.0), frame(0.1), frame(5.1)], 24.0).unwrap();
    let early = made(vec![frame(0.0)], 24.0).unwrap().starting_at(-1.0);
    let other = made(vec![frame(0.0)], 24.0).unwrap();
    assert_complaints! { scene(cut);
        |_| () => "leaf: vertex 2 moves at 120 m/s from 0.042 s of the animation on, but must not be faster than 100 m/s; is there a cut in the animation? If the file is not in metres, add `unit = \"cm\"`.";
    }
    assert_complaints! { scene(early); |_| () => "leaf: `start` is -1 s…"; }
    assert_complaints! { scene(other);
        |s| s.bodies[0].mesh.positions.push(DVec3::ONE) => "leaf: the animation has 3 vertices, but it moves 4";
    }
}
