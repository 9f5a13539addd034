//! Loads on bodies, pins and attachments: weights, Coulomb's law on a slope, levers, and the change of the cloth's momentum.

use crate::{contact, elastic, masses, momenta, table};
use selvedge_cloth::effects::{
    AirDrag, AttachmentGroup, Attachments, BodyContact, Friction, Gravity, PinGroup, PinMotion, Pins, RopeStretch, Thickness,
};
use selvedge_cloth::glam::{DQuat, DVec3};
use selvedge_cloth::{Body, BodyLoad, Cloth, Mesh, Placement, Scene, Simulation, Wrench};

const G: f64 = 9.81;
const DENSITY: f64 = 0.15;
const SIDE: f64 = 0.3;
const WEIGHT: f64 = SIDE * SIDE * DENSITY * G;
const THICKNESS: f64 = 2e-3;

/// How a test runs its scene: in steps of so many seconds, or in frames.
#[derive(Clone, Copy, Debug)]
pub(super) enum Pace {
    Steps(f64),
    Frames(f64),
}

pub(super) const PACES: [Pace; 3] = [Pace::Steps(1e-3), Pace::Steps(4e-3), Pace::Frames(1.0 / 60.0)];

impl Pace {
    pub(super) fn seconds(self) -> f64 {
        match self {
            Self::Steps(seconds) | Self::Frames(seconds) => seconds,
        }
    }

    pub(super) fn run(self, simulation: &mut Simulation, seconds: f64) {
        for _ in 0..(seconds / self.seconds()).round() as u32 {
            match self {
                Self::Steps(_) => simulation.step().unwrap(),
                Self::Frames(seconds) => drop(simulation.advance(seconds).unwrap()),
            }
        }
    }
}

fn sheet(corner: DVec3, sides: [DVec3; 2]) -> Cloth {
    Cloth::sheet(corner, sides.map(|side| SIDE * side), [8; 2], DENSITY).unwrap()
}

/// A sheet that lies flat around the origin, at this height.
fn lying(height: f64) -> Cloth {
    sheet(DVec3::new(-0.5 * SIDE, -0.5 * SIDE, height), [DVec3::X, DVec3::Y])
}

/// A sheet that hangs from its vertices with z = 0.
fn hanging() -> (Cloth, Vec<u32>) {
    let cloth = sheet(DVec3::new(0.0, 0.0, -SIDE), [DVec3::X, DVec3::Z]);
    let top = cloth.part("top").map(<[_]>::to_vec).unwrap_or_default();
    let points = &cloth.mesh().positions;
    let top = if top.is_empty() {
        (0..points.len() as u32).filter(|&v| points[v as usize].z == 0.0).collect()
    } else {
        top
    };
    (cloth, top)
}

fn scene(cloth: Cloth, pace: Pace) -> Scene {
    let mut scene = Scene::new(cloth, pace.seconds());
    scene.add(Gravity::default());
    elastic(&mut scene, 400.0, 15e-6);
    scene
}

/// Checks that a vector is as exact as a share of a scale allows.
pub(super) fn near(what: &str, found: DVec3, exact: DVec3, scale: f64, share: f64) {
    let error = (found - exact).length() / scale;
    println!("{what}: {error:e} off {exact}");
    assert!(error <= share, "{what}: {found} instead of {exact}");
}

#[test]
fn a_table_carries_the_weight_of_a_sheet_and_feels_where_it_lies() {
    for pace in PACES {
        let mut scene = scene(lying(1.2 * THICKNESS), pace);
        scene.bodies.push(table(20, 0.0));
        contact(&mut scene, THICKNESS, 0.3);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        assert_eq!(
            simulation.body_load(0, DVec3::ZERO),
            Some(BodyLoad::default()),
            "nothing has touched yet"
        );
        pace.run(&mut simulation, 1.0);
        let about = DVec3::new(-0.5, 0.2, 0.1);
        let weight = -WEIGHT * DVec3::Z;
        for load in [simulation.body_load(0, about), simulation.mean_body_load(0, about)] {
            let load = load.unwrap();
            near(&format!("{pace:?}, contact"), load.contact.force, weight, WEIGHT, 1e-3);
            near(&format!("{pace:?}, friction"), load.friction.force, DVec3::ZERO, WEIGHT, 1e-3);
            let lever = (DVec3::Z * THICKNESS - about).cross(weight);
            near(&format!("{pace:?}, torque"), load.total().torque, lever, lever.length(), 1e-3);
            assert_eq!([load.pins, load.attachments], [Wrench::default(); 2]);
        }
        let each = simulation.contact_loads(0).map(|contact| contact.push).sum::<DVec3>();
        let all = simulation.body_load(0, about).unwrap().contact.force;
        near("sum of contacts", each, all, WEIGHT, 1e-14);
        assert!(simulation.body_load(1, about).is_none() && simulation.mean_body_load(1, about).is_none());
        assert!(simulation.pin_load(0, about).is_none() && simulation.attachment_load(0, about).is_none());
    }
}

#[test]
fn friction_and_push_on_a_slope_are_the_parts_of_the_weight_along_it_and_across() {
    let angle = 0.3_f64;
    for pace in PACES {
        let mut cloth = lying(1.02 * THICKNESS).mesh().clone();
        let turn = DQuat::from_rotation_y(angle);
        cloth.positions.iter_mut().for_each(|point| *point = turn * *point);
        let mut scene = scene(Cloth::from_mesh(cloth, turn * DVec3::X, DENSITY).unwrap(), pace);
        scene.bodies.push(table(20, angle));
        contact(&mut scene, THICKNESS, 0.5);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        pace.run(&mut simulation, 1.0);
        let (along, across) = (turn * DVec3::X, turn * DVec3::Z);
        let load = simulation.body_load(0, DVec3::ZERO).unwrap();
        let [push, friction] = [-angle.cos() * across, angle.sin() * along].map(|part| part * WEIGHT);
        near(&format!("{pace:?}, contact"), load.contact.force, push, WEIGHT, 1e-3);
        near(&format!("{pace:?}, friction"), load.friction.force, friction, WEIGHT, 1e-3);
    }
}

#[test]
fn pins_and_attachments_carry_the_weight_of_cloth_and_its_load() {
    for pace in PACES {
        for is_attached in [false, true] {
            let (cloth, top) = hanging();
            let bottom: Vec<u32> = (0..cloth.mesh().positions.len() as u32)
                .filter(|&v| cloth.mesh().positions[v as usize].z < -0.99 * SIDE)
                .collect();
            let mut scene = scene(cloth, pace);
            // A rail that does not touch the cloth.
            scene.bodies.push(Body::ball("rail", 0.5 * DVec3::Z, 0.1, 8).unwrap());
            let motion = PinMotion::Body(0);
            if is_attached {
                let group = AttachmentGroup {
                    motion,
                    ..AttachmentGroup::resting(top, 5.0)
                };
                scene.add(Attachments { groups: vec![group] });
            } else {
                let vertices = top;
                scene.add(Pins {
                    groups: vec![PinGroup::new(vertices, motion)],
                });
            }
            scene.add(AirDrag { rate: 5.0 });
            let mut simulation = Simulation::new(scene, 1).unwrap();
            let load = 0.1 * DVec3::new(1.0, 0.0, -2.0);
            let each = load / bottom.len() as f64;
            for _ in 0..(3.0 / pace.seconds()) as u32 {
                simulation.add_force(&bottom, each).unwrap();
                pace.run(&mut simulation, pace.seconds());
            }
            let exact = load - WEIGHT * DVec3::Z;
            let about = DVec3::X;
            let [now, mean] = if is_attached {
                [
                    simulation.attachment_load(0, about),
                    simulation.mean_attachment_load(0, about),
                ]
            } else {
                [simulation.pin_load(0, about), simulation.mean_pin_load(0, about)]
            }
            .map(Option::unwrap);
            let what = format!("{pace:?}, attached {is_attached}");
            near(&what, now.force, exact, WEIGHT, 1e-3);
            near(&what, mean.force, exact, WEIGHT, 1e-3);
            let on_body = simulation.body_load(0, about).unwrap();
            let (own, other) = if is_attached {
                (on_body.attachments, on_body.pins)
            } else {
                (on_body.pins, on_body.attachments)
            };
            assert_eq!([own, other, on_body.contact], [now, Wrench::default(), Wrench::default()]);
        }
    }
}

/// The pins feel the inertia of the vertices that they move: F = m·(g + a) for a rope that is lifted as a whole.
#[test]
fn pins_feel_the_inertia_of_what_they_lift() {
    let rope = Cloth::rope(&[DVec3::ZERO, DVec3::X], 10, 0.05).unwrap();
    let count = rope.mesh().positions.len();
    let mut scene = Scene::new(rope, 1e-3);
    scene.add(Gravity::default()).add(RopeStretch::new(1000.0));
    scene.add(Pins {
        groups: vec![PinGroup::new(
            (0..count as u32).collect::<Vec<_>>(),
            PinMotion::Own(selvedge_cloth::BodyMotion::Driven(Placement::default())),
        )],
    });
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let acceleration = 2.0;
    for step in 1..=20 {
        // Steps of first order reach the velocity a·t at the end of the step.
        let height = acceleration * 1e-6 * f64::from(step * (step + 1)) / 2.0;
        let rope = simulation.positions()[..count].iter();
        let places: Vec<DVec3> = rope.map(|point| DVec3::new(point.x, 0.0, height)).collect();
        simulation.move_pins(0, &places).unwrap();
        simulation.step().unwrap();
        let load = simulation.pin_load(0, DVec3::ZERO).unwrap();
        let exact = -0.05 * (G + acceleration) * DVec3::Z;
        near("force", load.force, exact, exact.length(), 1e-9);
        let middle = DVec3::new(0.5, 0.0, height);
        near("torque", load.torque, middle.cross(exact), exact.length(), 1e-9);
    }
}

#[test]
fn a_rod_and_a_pin_carry_a_rope_that_hangs_over_the_rod() {
    for pace in PACES {
        let radius = 0.05 + 1.05 * THICKNESS;
        let arc = |k: u32| {
            let angle = std::f64::consts::PI * (1.0 - f64::from(k) / 32.0);
            radius * DVec3::new(angle.cos(), 0.0, angle.sin())
        };
        let mut line = vec![DVec3::new(-radius, 0.0, -0.3)];
        line.extend((0..=32).map(arc));
        line.push(DVec3::new(radius, 0.0, -0.4));
        let length: f64 = line.windows(2).map(|two| two[0].distance(two[1])).sum();
        let rope = Cloth::rope(&line, 80, 0.05).unwrap();
        let mut scene = Scene::new(rope, pace.seconds());
        let ends = [-0.2 * DVec3::Y, 0.2 * DVec3::Y];
        scene.bodies.push(Body::capsule("rod", ends, 0.05, 48).unwrap());
        scene
            .add(Gravity::default())
            .add(RopeStretch::new(2000.0))
            .add(AirDrag { rate: 5.0 });
        scene.add(Pins {
            groups: vec![PinGroup::resting([0])],
        });
        scene
            .add(BodyContact(Thickness::new(THICKNESS)))
            .add(Friction { coefficient: 0.2 });
        let mut simulation = Simulation::new(scene, 1).unwrap();
        // A hand pulls at the end.
        let pull = 2.0;
        for _ in 0..(3.0 / pace.seconds()) as u32 {
            simulation.add_force(&[80], -pull * DVec3::Z).unwrap();
            pace.run(&mut simulation, pace.seconds());
        }
        let exact = -(0.05 * length * G + pull) * DVec3::Z;
        let rod = simulation.mean_body_load(0, DVec3::ZERO).unwrap().total();
        let pin = simulation.mean_pin_load(0, DVec3::ZERO).unwrap();
        println!("rod {}, pin {}", rod.force, pin.force);
        near(&format!("{pace:?}"), rod.force + pin.force, exact, exact.length(), 1e-3);
        assert!(pin.force.z > 0.5 && rod.force.z < -3.0, "the pin holds the rope down");
    }
}

/// The impulses of a step, in N·s.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Impulses {
    /// Of all loads.
    loads: DVec3,
    /// Of gravity, without the change of the momentum.
    exact: DVec3,
    /// Of the force that the solve has left.
    left: DVec3,
    /// The repairs of the certificate so far.
    repairs: u64,
}

/// Runs a sheet with pinned vertices that falls on a ball. (Pins on one line would let it turn, and its turn keeps its
/// angular momentum by a correction that no load has.)
fn drop_on_a_ball(threads: usize) -> Vec<Impulses> {
    let pace = Pace::Steps(2e-3);
    let cloth = lying(0.12);
    let mesh: Mesh = cloth.mesh().clone();
    let mut scene = scene(cloth, pace);
    scene.bodies.push(Body::ball("ball", DVec3::X * 0.03, 0.1, 24).unwrap());
    scene.add(Pins {
        groups: vec![PinGroup::resting([0, 8, 13])],
    });
    contact(&mut scene, THICKNESS, 0.3);
    let mut simulation = Simulation::new(scene, threads).unwrap();
    let masses = masses(&mesh, DENSITY);
    let step = |_| {
        let [before, _] = momenta(&simulation, &masses, DVec3::ZERO);
        simulation.step().unwrap();
        let [after, _] = momenta(&simulation, &masses, DVec3::ZERO);
        let body = simulation.mean_body_load(0, DVec3::ZERO).unwrap().total().force;
        let pins = simulation.mean_pin_load(0, DVec3::ZERO).unwrap().force;
        Impulses {
            loads: (body + pins) * pace.seconds(),
            exact: -WEIGHT * DVec3::Z * pace.seconds() - (after - before),
            left: simulation.unbalanced_force() * pace.seconds(),
            repairs: simulation.contact_counts().map_or(0, |counts| counts.violated + counts.cuts),
        }
    };
    (0..250).map(step).collect()
}

#[test]
fn the_impulses_of_all_loads_are_those_of_gravity_without_the_change_of_the_momentum() {
    let found = drop_on_a_ball(1);
    let weight = WEIGHT * 2e-3;
    // With what the solve left, nothing but rounding is missing, unless the certificate has held something back.
    let missing = |step: &Impulses| (step.loads - step.left).distance(step.exact) / weight;
    let free = found
        .windows(2)
        .filter(|two| two[0].repairs == two[1].repairs)
        .map(|two| &two[1]);
    let worst = free.clone().map(missing).fold(0.0, f64::max);
    println!("worst of {} steps: {worst:e} of the weight", free.clone().count());
    assert!(free.count() > 200 && worst < 1e-11, "{worst}");
    let sum = |of: fn(&Impulses) -> DVec3| found.iter().map(of).sum::<DVec3>();
    let all = weight * found.len() as f64;
    // Alone, the loads have the error that the accuracy of a game allows, a fiftieth.
    near("impulse", sum(|step| step.loads), sum(|step| step.exact), all, 0.02);
    assert!(sum(|step| step.exact).z < -0.8 * all, "most of the weight has been carried");
}

#[test]
fn loads_have_the_same_bits_on_any_number_of_threads() {
    assert_eq!(drop_on_a_ball(1), drop_on_a_ball(3));
}

#[test]
fn forces_on_vertices_give_their_whole_impulse_in_one_call_and_are_then_gone() {
    for pace in PACES {
        let cloth = lying(0.0);
        let mesh: Mesh = cloth.mesh().clone();
        let mut scene = Scene::new(cloth, pace.seconds());
        elastic(&mut scene, 400.0, 15e-6);
        let mut simulation = Simulation::new(scene, 1).unwrap();
        let (one, two) = (DVec3::new(0.02, 0.0, 0.01), DVec3::new(0.0, -0.03, 0.01));
        simulation.add_force(&[3, 40], one).unwrap();
        simulation.add_forces(&[40, 77], &[two, -one]).unwrap();
        assert!(simulation.add_force(&[81], one).is_err(), "there are 81 vertices");
        assert!(simulation.add_force(&[0], DVec3::X * f64::NAN).is_err());
        assert!(simulation.add_force(&[0], DVec3::X * 2e6).is_err());
        assert!(simulation.add_forces(&[0], &[]).is_err());
        let exact = (one + two) * pace.seconds();
        for _ in 0..2 {
            pace.run(&mut simulation, pace.seconds());
            let [momentum, _] = momenta(&simulation, &masses(&mesh, DENSITY), DVec3::ZERO);
            near(&format!("{pace:?}"), momentum, exact, exact.length(), 1e-9);
        }
    }
}

#[test]
fn a_force_on_a_pinned_vertex_goes_to_its_pins() {
    let (cloth, top) = hanging();
    let mut scene = Scene::new(cloth, 1e-3);
    elastic(&mut scene, 400.0, 15e-6);
    let pinned = top[2];
    scene.add(Pins {
        groups: vec![PinGroup::resting(top)],
    });
    let mut simulation = Simulation::new(scene, 1).unwrap();
    simulation.add_force(&[pinned], 3.0 * DVec3::Y).unwrap();
    simulation.step().unwrap();
    let load = simulation.pin_load(0, DVec3::ZERO).unwrap();
    near("pins", load.force, 3.0 * DVec3::Y, 3.0, 1e-12);
}
