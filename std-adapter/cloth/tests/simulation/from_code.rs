//! Scenes from code, with bodies, pins and wind that the caller drives.

use crate::common::*;
use selvedge_cloth::glam::{DMat3, DQuat};

const CELLS: u32 = 12;

/// A horizontal sheet over the origin at a height, in metres.
fn sheet(height: f64) -> Cloth {
    let corner = DVec3::new(-0.15, -0.15, height);
    Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [CELLS; 2], 0.2).unwrap()
}

/// The sheet with pinned corners, body contact and self-collision.
fn scene_with(body: Body, height: f64) -> Scene {
    let cloth = sheet(height);
    let corners = ["bottom-left", "bottom-right", "top-left", "top-right"];
    let corners = corners.map(|name| cloth.part(name).unwrap()).concat();
    let mut scene = Scene::new(cloth, 2e-3);
    scene.bodies.push(body);
    scene.add(Gravity::default()).add(Stretch::isotropic(200.0));
    scene.add(Bend::isotropic(1e-5));
    scene.add(resting(corners));
    scene.add(BodyContact(Thickness::new(4e-3)));
    scene.add(SelfCollision(Thickness::new(4e-3)));
    scene
}

fn driven(mut body: Body) -> Body {
    body.motion = BodyMotion::Driven(Placement::default());
    body
}

fn turned(rotation: DQuat) -> Placement {
    Placement {
        rotation,
        ..Placement::default()
    }
}

fn ball() -> Body {
    driven(Body::ball("ball", DVec3::ZERO, 0.06, 16).unwrap())
}

/// A bar through the origin, along x.
fn bar() -> Body {
    driven(Body::capsule("bar", [-0.1 * DVec3::X, 0.1 * DVec3::X], 0.02, 12).unwrap())
}

#[test]
fn code_and_file_make_the_same_scene_to_the_last_bit() {
    let ends = |x: f64| [-x * DVec3::X, x * DVec3::X];
    let mut cloth = Cloth::tube(ends(0.2), 0.1, [16, 12], 0.2).unwrap();
    cloth.velocity = 0.1 * DVec3::Y;
    let start = cloth.part("start").unwrap().to_vec();
    let mut scene = Scene::new(cloth, 2e-3);
    scene.on_blocked = OnBlocked::Hold;
    let mut arm = Body::capsule("arm", ends(0.3), 0.05, 24).unwrap();
    let later = Keyframe {
        time: 0.2,
        angle: 0.3,
        translation: 0.02 * DVec3::Z,
    };
    let keyframes = vec![Keyframe::default(), later];
    let motion = KeyframeMotion::new(0.1 * DVec3::Z, 2.0 * DVec3::Y, keyframes).unwrap();
    arm.motion = motion.interpolated(Interpolation::Smooth).into();
    scene.bodies.push(arm);
    // The order of these calls does not matter.
    scene.add(Friction { coefficient: 0.3 });
    let separation = 1e-3;
    scene.add(SelfCollision(Thickness {
        separation,
        ..Thickness::new(4e-3)
    }));
    scene.add(BodyContact(Thickness::new(4e-3)));
    scene
        .add(Stretch {
            weft_stiffness: 300.0,
            ..Stretch::isotropic(400.0)
        })
        .add(StrainLimit::at(1.1));
    scene.add(Shear::new(50.0)).add(Bend::isotropic(1e-5));
    let mut held = pinned(start, PinMotion::Body(0));
    held.groups.push(PinGroup::resting([100]));
    scene.add(held);
    scene.add(AirDrag { rate: 0.2 }).add(Gravity::default());
    scene.add(Wind {
        gust: 0.5,
        ..wind(3.0 * DVec3::Y)
    });

    let of_file = Scene::parse(include_str!("scenes/arm-in-tube.toml"), Path::new("s.toml")).unwrap();
    assert_eq!(scene.effect_names(), of_file.effect_names());
    let [mut code, mut file] = [scene, of_file].map(|scene| Simulation::new(scene, 1).unwrap());
    [&mut code, &mut file]
        .into_iter()
        .for_each(|simulation| advance(simulation, 60));
    assert!(code.contact_counts().unwrap().pushed > 0, "a test of contact, too");
    assert_eq!(bits(&code), bits(&file));
}

#[test]
fn pins_that_follow_a_driven_body_start_where_the_cloth_is() {
    let standing = Placement::new(DQuat::from_rotation_x(0.8), DVec3::new(3.0, -2.0, 5.0));
    let mut ball = Body::ball("ball", DVec3::Z, 0.01, 12).unwrap();
    ball.motion = BodyMotion::Driven(standing);
    let mut scene = scene_with(ball, 0.0);
    let vertices = scene.cloths[0].part("left").unwrap().to_vec();
    let rest = scene.cloths[0].mesh().positions.clone();
    scene.add(pinned(&vertices[..], PinMotion::Body(0)));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let next = Placement::new(
        DQuat::from_rotation_x(0.8) * DQuat::from_rotation_y(1e-3),
        standing.translation + DVec3::splat(1e-4),
    );
    for (now, leads) in [(standing, false), (next, true)] {
        if leads {
            simulation.place_body(0, now).unwrap();
            simulation.step().unwrap();
        }
        for &vertex in &vertices {
            // These would be fixed to the ball at its placement.
            let fixed = standing.rotation.inverse() * (rest[vertex as usize] - standing.translation);
            assert!(simulation.positions()[vertex as usize].distance(now.apply(fixed)) < 1e-12);
        }
    }
}

#[test]
fn a_ball_that_code_moves_pushes_the_cloth_and_never_passes_it() {
    let mut simulation = Simulation::new(scene_with(ball(), 0.075), 1).unwrap();
    for step in 1..=150 {
        let up = Placement::at(DVec3::Z * (5e-4 * f64::from(step)));
        simulation.place_body(0, up).unwrap();
        simulation.step().unwrap();
        assert_eq!(simulation.placement(0), Some(up));
        assert_eq!(intersections(&simulation), []);
    }
    let middle = (CELLS as usize + 1).pow(2) / 2;
    let [middle, top] = [simulation.positions()[middle].z, 0.06 + 0.075];
    assert!(middle > top && middle < top + 0.01, "{middle}");
    assert!(simulation.is_certified());
    let mut near = 0;
    for pair in simulation.near_pairs() {
        // The positive weights of the first side sum to one, the negative ones of the other side to minus one.
        let of_first: f64 = pair.weights.iter().filter(|weight| **weight > 0.0).sum();
        let of_other: f64 = pair.weights.iter().filter(|weight| **weight < 0.0).sum();
        assert!((of_first - 1.0).abs() < 1e-12 && (of_other + 1.0).abs() < 1e-12, "{pair:?}");
        assert!(
            (pair.normal.length() - 1.0).abs() < 1e-12 && pair.thickness <= 4.001e-3,
            "{pair:?}"
        );
        let positions = pair.vertices.map(|vertex| simulation.positions()[vertex as usize]);
        let way: DVec3 = positions
            .into_iter()
            .zip(pair.weights)
            .map(|(position, weight)| position * weight)
            .sum();
        // The normal points from the second side to the first, in a motion of half a millimetre a step.
        assert!(way.dot(pair.normal) > 0.0 && way.dot(pair.normal) < 8e-3, "{pair:?}");
        near += 1;
    }
    assert!(near > 0);
}

#[test]
fn a_rotation_of_any_length_turns_and_does_not_scale() {
    let rotation = DQuat::from_rotation_z(0.5);
    let [unit, longer] = [1.0, 3.0].map(|length| {
        let mut scene = scene_with(bar(), 0.1);
        scene.bodies[0].motion = BodyMotion::Driven(turned(rotation * length));
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let start = simulation.positions()[simulation.body_vertices(0).unwrap()].to_vec();
        simulation.place_body(0, turned(DQuat::IDENTITY * length)).unwrap();
        simulation.step().unwrap();
        [start, simulation.positions()[simulation.body_vertices(0).unwrap()].to_vec()]
    });
    for (unit, longer) in unit.iter().flatten().zip(longer.iter().flatten()) {
        assert!(unit.distance(*longer) < 1e-15, "{unit} {longer}");
    }
}

#[test]
fn what_turns_half_round_in_a_step_meets_the_cloth_on_its_way() {
    // The cloth hangs where the bar's ends pass. At the end of each step the bar lies as at its start.
    let mut scene = scene_with(bar(), 0.04);
    scene.on_blocked = OnBlocked::Hold;
    // Its ends move at 38 m/s.
    scene.time_step = 1e-2;
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for step in 1..=3 {
        let half_turns = turned(DQuat::from_rotation_y(PI * f64::from(step)));
        simulation.place_body(0, half_turns).unwrap();
        simulation.step().unwrap();
        assert_eq!(intersections(&simulation), []);
    }
    let highest = simulation.positions()[..(CELLS as usize + 1).pow(2)].iter();
    let highest = highest.map(|p| p.z).fold(f64::MIN, f64::max);
    // It starts 40 mm high.
    assert!(highest > 0.041 || simulation.blocked_steps() > 0, "it was passed: {highest}");
}

#[test]
fn a_body_that_changes_its_shape_pushes_the_cloth_and_never_passes_it() {
    let ball = ball();
    let rest = ball.mesh.positions.clone();
    let mut simulation = Simulation::new(scene_with(ball, 0.075), 1).unwrap();
    for step in 1..=120 {
        let swollen: Vec<_> = rest.iter().map(|p| *p * (1.0 + 0.005 * f64::from(step))).collect();
        simulation.move_body(0, &swollen).unwrap();
        simulation.step().unwrap();
        assert_eq!(intersections(&simulation), []);
        assert_eq!(simulation.positions()[simulation.body_vertices(0).unwrap()], swollen);
    }
    assert_eq!(simulation.placement(0), None, "it is no rigid body any more");
    // The body returns to its own shape, elsewhere.
    let placement = Placement::at(-0.01 * DVec3::Z);
    simulation.place_body(0, placement).unwrap();
    simulation.step().unwrap();
    assert_eq!(simulation.placement(0), Some(placement));
    assert_eq!(intersections(&simulation), []);
}

#[test]
fn pins_go_where_code_leads_them() {
    let cloth = sheet(0.0);
    let left = cloth.part("left").unwrap().to_vec();
    let start: Vec<_> = left.iter().map(|&v| cloth.mesh().positions[v as usize]).collect();
    let mut scene = Scene::new(cloth, 2e-3);
    scene.add(pinned(&left[..], PinMotion::Own(BodyMotion::Driven(Placement::default()))));
    scene.add(Gravity::default()).add(Stretch::isotropic(200.0));
    scene.add(SelfCollision(Thickness::new(3e-3)));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for step in 1..=100 {
        // The pins are drawn together like a curtain.
        let share = 1.0 - 0.004 * f64::from(step);
        let goals: Vec<_> = start.iter().map(|p| DVec3::new(p.x, p.y * share, 0.0)).collect();
        simulation.move_pins(0, &goals).unwrap();
        simulation.step().unwrap();
        let there: Vec<_> = left.iter().map(|&v| simulation.positions()[v as usize]).collect();
        assert_eq!(there, goals);
    }
    assert_eq!(intersections(&simulation), []);
}

#[test]
fn a_body_that_has_to_wait_stands_where_it_is_said_to_stand_and_goes_on_from_there() {
    // The cloth cannot escape from between two balls.
    let mut scene = scene_with(ball(), 0.065);
    let mut above = ball();
    above.name = "above".to_owned();
    above.motion = BodyMotion::Driven(Placement::at(0.14 * DVec3::Z));
    scene.bodies.push(above);
    scene.on_blocked = OnBlocked::Hold;
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let goal = Placement::at(0.09 * DVec3::Z);
    for _ in 0..20 {
        simulation.place_body(1, goal).unwrap();
        simulation.step().unwrap();
        assert_eq!(intersections(&simulation), []);
    }
    assert!(simulation.blocked_steps() > 0);
    let stands = simulation.placement(1).unwrap();
    assert!(
        stands.translation.z > goal.translation.z && stands.translation.z < 0.14,
        "{stands:?}"
    );
    let vertices = simulation.body_vertices(1).unwrap();
    for (position, rest) in simulation.positions()[vertices].iter().zip(&ball().mesh.positions) {
        assert!(position.distance(stands.apply(*rest)) < 1e-12);
    }
    simulation.place_body(1, Placement::at(0.2 * DVec3::Z)).unwrap();
    simulation.step().unwrap();
    assert_eq!(simulation.placement(1), Some(Placement::at(0.2 * DVec3::Z)));
}

/// Drives the body and the wind, and does a step.
fn drive(simulation: &mut Simulation) {
    let time = simulation.time();
    let rotation = DQuat::from_rotation_x(3.0 * time);
    let translation = DVec3::Z * (0.02 + 0.02 * (9.0 * time).sin());
    simulation.place_body(0, Placement { rotation, translation }).unwrap();
    simulation.set_wind(DVec3::Y * (4.0 * time)).unwrap();
    simulation.step().unwrap();
}

#[test]
fn neither_threads_nor_a_resume_change_a_bit() {
    let scene = || {
        let mut scene = scene_with(bar(), 0.1);
        scene.add(Wind::default()).add(Friction { coefficient: 0.4 });
        scene
    };
    let [mut one, mut two, mut resumed] = [1, 2, 1].map(|threads| Simulation::new(scene(), threads).unwrap());
    for _ in 0..CHECKPOINT_STEPS {
        drive(&mut one);
        drive(&mut two);
    }
    resumed.resume(&one.checkpoint().unwrap()).unwrap();
    assert_eq!(resumed.placement(0), one.placement(0));
    for _ in 0..20 {
        [&mut one, &mut two, &mut resumed].into_iter().for_each(drive);
    }
    assert_eq!(bits(&one), bits(&two));
    assert_eq!(bits(&one), bits(&resumed));
    let mut other = scene();
    other.cloths[0].density = 0.3;
    let mut other = Simulation::new(other, 1).unwrap();
    assert!(other.resume(&two.checkpoint().unwrap_or_default()).is_err());
}

#[test]
fn the_wind_on_all_cloths_turns_when_it_is_told_to() {
    let mut scene = Scene::new(sheet(0.0), 2e-3);
    scene.cloths.push(sheet(1.0).named("above"));
    scene.add(Wind::default());
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let mean = |simulation: &Simulation| simulation.velocities().iter().map(|v| v.z).sum::<f64>();
    simulation.step().unwrap();
    assert_eq!(mean(&simulation), 0.0);
    simulation.set_wind(5.0 * DVec3::Z).unwrap();
    simulation.step().unwrap();
    assert!(simulation.velocities().iter().all(|velocity| velocity.z > 0.0));
    let up = mean(&simulation);
    simulation.set_wind(-50.0 * DVec3::Z).unwrap();
    simulation.step().unwrap();
    assert!(up > 0.0 && mean(&simulation) < up);
}

/// An effect outside the crate: it pushes everything up, and keeps it below a ceiling.
#[derive(Clone, Copy, Debug)]
struct Balloon {
    ceiling: f64,
}

selvedge_cloth::identify!(Balloon { ceiling });

impl Effect for Balloon {
    fn name(&self) -> &'static str {
        "balloon"
    }

    fn register(&self, plan: &mut Plan<'_>) {
        assert_eq!(plan.masses().len(), plan.scene().cloth.mesh().positions.len());
        plan.add_force(Lift);
        plan.add_term(Ceiling {
            height: self.ceiling,
            vertices: plan.vertices(),
        });
    }
}

#[derive(Debug)]
struct Lift;

impl Force for Lift {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        for velocity in velocities {
            velocity.z += 20.0 * step.h;
        }
    }
}

/// A soft ceiling: ½·k·(z − height)² above it, for each vertex.
#[derive(Debug)]
struct Ceiling {
    height: f64,
    vertices: std::ops::Range<usize>,
}

impl Ceiling {
    /// The stiffness, in N/m.
    const STIFFNESS: f64 = 100.0;

    fn above(&self, position: DVec3) -> f64 {
        (position.z - self.height).max(0.0)
    }
}

impl Term for Ceiling {
    fn gradient(&mut self, x: &[DVec3], gradient: &mut [DVec3]) -> f64 {
        let mut energy = 0.0;
        for vertex in self.vertices.clone() {
            let above = self.above(x[vertex]);
            gradient[vertex].z += Self::STIFFNESS * above;
            energy += 0.5 * Self::STIFFNESS * above * above;
        }
        energy
    }

    fn curvature(&mut self, x: &[DVec3], matrix: &mut Matrix) {
        for vertex in self.vertices.clone().filter(|&vertex| self.above(x[vertex]) > 0.0) {
            matrix.add(&[vertex as u32], &[1.0], DMat3::from_diagonal(DVec3::Z * Self::STIFFNESS));
        }
    }

    fn energy(&self, now: &Configuration<'_>, own: usize) -> Vec<(usize, StoredEnergy)> {
        let above = now.positions[self.vertices.clone()]
            .iter()
            .map(|position| self.above(*position));
        vec![(
            own,
            StoredEnergy::Elastic(above.map(|above| 0.5 * Self::STIFFNESS * above * above).sum()),
        )]
    }
}

#[test]
fn an_effect_of_a_callers_own_acts_is_timed_and_runs_after_ours() {
    let mut scene = Scene::new(sheet(0.0), 2e-3);
    scene.add(Balloon { ceiling: 0.05 }).add(Gravity::default());
    scene.add(Stretch::isotropic(100.0));
    scene.add(SelfCollision(Thickness::new(3e-3)));
    assert_eq!(scene.effect_names(), ["gravity", "stretch", "self_collision", "balloon"]);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let mut highest = 0.0_f64;
    for _ in 0..100 {
        simulation.step().unwrap();
        highest = simulation.positions().iter().map(|p| p.z).fold(highest, f64::max);
    }
    // It rises at 1 m/s, which presses it into the soft ceiling by about a millimetre.
    assert!((0.05..0.053).contains(&highest), "{highest}");
    let balloon = simulation.effects().iter().find(|effect| effect.name == "balloon");
    assert!(balloon.unwrap().seconds > 0.0);
}

fn pins(groups: Vec<PinGroup>) -> Pins {
    Pins { groups }
}

#[test]
fn thirty_wrong_ways_to_use_it_from_code_get_thirty_errors_that_say_what_would_be_right() {
    assert!(
        Simulation::new(scene_with(ball(), 0.1), 1).is_ok(),
        "the scene that the mistakes are made in"
    );
    let up = DVec3::Z;
    let at = |time, angle| Keyframe {
        time,
        angle,
        ..Keyframe::default()
    };
    let turning = |keyframes| KeyframeMotion::new(DVec3::ZERO, up, keyframes).unwrap().into();
    assert_complaints! { scene_with(ball(), 0.1);
        |s| s.time_step = 0.0 => "`time_step` is 0 s, but must be from 1e-6 s to 0.0167 s…";
        |s| s.time_step = f64::NAN => "`time_step` is NaN s…";
        |s| s.duration = 1e-4 => "`duration` is 1e-4 s, but must be from 0.002 s…";
        |s| s.time_step = 1.0 / 50.0 => "`time_step` is 0.02 s, but must be from 1e-6 s to 0.0167 s; use a shorter step, or frames…";
        |s| (s.by_frames, s.frame_rate) = (true, 0.5) => "`frames_per_second` is 0.5 Hz, but must be from 1 Hz…";
        |s| s.frame_rate = -1.0 => "`frames_per_second` is -1 Hz…";
        |s| s.cloths[0].density = 200.0 => "cloth: `density` is 200 kg/m2, but must be from 0.001 kg/m2 to 100 kg/m2…";
        |s| s.cloths[0].velocity = up * 1e4 => "cloth: `velocity` is 10000 m/s…";
        |s| s.bodies.push(ball()) => "there are two bodies named 'ball'…";
        |s| s.bodies[0].mesh.positions[0].x = f64::INFINITY => "ball: the mesh has a vertex at [inf…";
        |s| s.bodies[0].mesh.positions[0].x = 1e300 => "ball: the mesh has a vertex at [1.000e300, …";
        |s| s.bodies[0].mesh.triangles[0][1] = 9999 => "ball: a triangle of the mesh names the vertex 9999…";
        |s| s.bodies[0].motion = turning(vec![at(1.0, 0.0), at(1.0, 1.0)]) => "ball: keyframes must be in order…";
        |s| s.bodies[0].motion = turning(vec![at(-1.0, 0.0)]) => "ball: `time` is -1 s…";
        |s| s.bodies[0].motion = turning(vec![at(0.0, 0.0), at(0.01, 1e3)]) => "ball: before this keyframe the motion turns by…";
        |s| s.bodies[0].motion = BodyMotion::Driven(Placement::at(up * 1e9)) => "ball: `translation` is 1e9 m…";
        |s| _ = s.add(Gravity { acceleration: up * f64::NAN, }) => "gravity: `acceleration` is NaN m/s2…";
        |s| _ = s.add(AirDrag { rate: -1.0 }) => "air_drag: `rate` is -1 Hz…";
        |s| _ = s.add(Wind { drag: 1e3, ..Wind::default() }) => "wind: `drag` is 1000, but must be from 0 to 100…";
        |s| _ = s.add(Stretch::isotropic(0.0)) => "stretch: `stiffness` is 0 N/m, but must be from 0.001 N/m to 1e9 N/m…";
        |s| _ = s.add(Shear::new(1e10)) => "shear: `stiffness` is 1e10 N/m…";
        |s| _ = s.add(Bend::isotropic(100.0)) => "bend: `stiffness` is 100 N m, but must be from 1e-12 N m to 10 N m…";
        |s| _ = s.add(StrainLimit::at(0.9)) => "strain_limit: `limit` is 0.9, but must be from 1 to 10…";
        |s| _ = s.add(InternalPressure::with_volume_ratio(1.1))
            => "internal_pressure: internal pressure needs a closed cloth, but this one has 48 open edges…";
        |s| _ = s.add(SelfCollision(Thickness::new(0.0)))
            => "self_collision: `thickness` is 0 m, but must be from 1e-5 m to 0.1 m…";
        |s| _ = s.add(BodyContact(Thickness { thickness: 1e-3, separation: 1e-3, }))
            => "body_contact: `separation` is 0.001 m, but must be at most nine tenths…";
        |s| s.bodies.clear() => "body_contact: body contact has nothing to act on…";
        |s| _ = s.add(Friction { coefficient: -0.1 }) => "friction: `coefficient` is -0.1…";
        |s| _ = s.add(pins(Vec::new())) => "pins: pins need at least one…";
        |s| _ = s.add(pins(vec![PinGroup::resting([])])) => "pins: no vertex of the cloth is in this group…";
        |s| _ = s.add(pins(vec![PinGroup::resting([169])]))
            => "pins: the scene has no vertex 169 of cloth: it has 169, numbered from 0…";
        |s| _ = s.add(pins(vec![PinGroup::resting([2, 3, 3])])) => "pins: vertex 3 is pinned twice";
        |s| _ = s.add(pins(vec![PinGroup::resting([3]), PinGroup::new([2, 3], PinMotion::Body(0))]))
            => "pins: vertex 3 is pinned twice, with different motions";
        |s| _ = s.add(pinned([0], PinMotion::Body(4)))
            => "pins: there is no body 4: the scene has 1, numbered from 0…";
        |s| s.bodies[0].motion = BodyMotion::Driven(Placement::at(0.1 * up)) => "the scene starts with an intersection…";
    }
    let without_contact = complaint(Scene::new(sheet(0.1), 2e-3), |s| _ = s.add(Friction { coefficient: 0.1 }));
    assert!(
        without_contact.contains("[effects.self_collision] or [effects.body_contact]"),
        "{without_contact}"
    );
}

#[test]
fn shapes_that_cannot_be_are_refused_where_they_are_made() {
    let [x, y] = [DVec3::X, DVec3::Y];
    let mut flat = sheet(0.0).mesh().clone();
    flat.triangles[0] = [0, 1, 1];
    let mut beyond = flat.clone();
    beyond.triangles[0] = [0, 1, 5000];
    let mut small = sheet(0.0).mesh().clone();
    small.positions.iter_mut().for_each(|place| *place *= 1e-6);
    assert_errors! {
        Cloth::from_mesh(small, x, 0.1) => "triangle 0 of the cloth has an area below 0.0001 square millimetres…";
        Cloth::sheet(x, [x, 2.0 * x], [2, 2], 0.1) => "the two sides of the sheet must not be parallel…";
        Cloth::sheet(x, [x, 0.0 * x], [2, 2], 0.1) => "the two sides of the sheet must not be parallel or zero";
        Cloth::sheet(x, [x, y], [0, 2], 0.1) => "`cells` is 0, but must be from 1 to 2000";
        Cloth::tube([x, x], 0.1, [9, 9], 0.1) => "`from` and `to` are the same point";
        Cloth::tube([x, y], 0.1, [2, 9], 0.1) => "`cells` is 2, but must be from 3…";
        Cloth::sleeve(0, 0.1) => "`refinement` is 0…";
        Cloth::from_mesh(flat, x, 0.1) => "cloth must consist of proper triangles…";
        Cloth::from_mesh(beyond, x, 0.1) => "a triangle of the mesh names the vertex 5000…";
        Body::capsule("arm", [x, y], 0.0, 24) => "arm: `radius` is 0 m…";
        KeyframeMotion::new(x, DVec3::ZERO, Vec::new()) => "`axis` must not be zero…";
    }
}

#[test]
fn a_corner_that_two_pinned_sides_share_is_pinned_once() {
    let mut scene = Scene::new(sheet(0.1), 2e-3);
    let sides = ["left", "right", "bottom", "top"].map(|part| PinGroup::resting(scene.part("cloth", part).unwrap()));
    scene.add(pins(sides.to_vec())).add(Gravity::default());
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let before = simulation.positions().to_vec();
    simulation.step().unwrap();
    let still = simulation
        .positions()
        .iter()
        .zip(&before)
        .filter(|(now, before)| now == before);
    assert_eq!(still.count(), 48, "the border of 12 by 12 cells");
}

#[test]
fn a_file_may_leave_bodies_and_pins_to_code() {
    let mut simulation = set_up(include_str!("scenes/driven.toml"), "driven.toml", 1);
    assert_eq!(simulation.body_names(), ["ball"]);
    simulation.place_body(0, Placement::at(0.01 * DVec3::X)).unwrap();
    let goals: Vec<_> = (0..5).map(|k| DVec3::new(0.0, 0.075 * f64::from(k), 0.001)).collect();
    simulation.move_pins(0, &goals).unwrap();
    simulation.step().unwrap();
    assert_eq!(simulation.placement(0), Some(Placement::at(0.01 * DVec3::X)));
    assert_eq!(simulation.positions()[5], goals[1]);
}

#[test]
fn moving_what_cannot_be_moved_is_an_error_and_changes_nothing() {
    let mut scene = scene_with(ball(), 0.1);
    scene.bodies.push(Body::ball("fixed", DVec3::Y, 0.1, 12).unwrap());
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let [here, far] = [Placement::default(), Placement::at(DVec3::X * 1e6)];
    assert_eq!(simulation.place_body(2, here), Err(DriveError::NoBody { body: 2, bodies: 2 }));
    let zero = turned(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0));
    let expected = simulation.body_vertices(0).unwrap().len();
    assert_errors! {
        simulation.place_body(1, here) => "the body 'fixed' cannot be moved by hand…";
        simulation.place_body(0, far) => "`translation` is 1e6 m…";
        simulation.place_body(0, zero) => "`rotation` must be…";
        simulation.move_body(0, &vec![DVec3::NAN; expected]) => "`positions` is NaN m…";
    }
    let found = DriveError::VertexCount { expected, found: 1 };
    assert_eq!(simulation.move_body(0, &[DVec3::ZERO]), Err(found));
    assert_eq!(simulation.move_pins(1, &[]), Err(DriveError::NoPins { group: 1, groups: 1 }));
    assert!(matches!(simulation.move_pins(0, &[]), Err(DriveError::NotDriven { .. })));
    assert_eq!(simulation.set_wind(DVec3::X), Err(DriveError::NoWind));
    assert_eq!((simulation.placement(1), simulation.body_vertices(2)), (None, None));
    let before = bits(&simulation)[169..].to_vec();
    simulation.step().unwrap();
    assert_eq!(bits(&simulation)[169..], before, "bodies stay where they are");
}

#[test]
fn a_pulled_vertex_moves_a_pinned_one_does_not_and_unknown_ones_are_refused() {
    let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [2, 2], 0.1).unwrap();
    let mut scene = Scene::new(sheet, 1e-3);
    scene.add(resting(vec![0])).add(Stretch::isotropic(100.0));
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let before = simulation.positions().to_vec();
    simulation.set_velocity(&[0, 8], DVec3::Z).unwrap();
    simulation.step().unwrap();
    assert_eq!(simulation.positions()[0], before[0]);
    assert!(simulation.positions()[8].z > 5e-4);
    let refused = simulation.set_velocity(&[9], DVec3::Z).unwrap_err();
    assert_eq!(
        refused.to_string(),
        "there is no vertex 9 of cloth: the scene has 9, numbered from 0"
    );
    assert!(simulation.set_velocity(&[0], DVec3::splat(f64::NAN)).is_err());
}
