//! Energy does not grow where nothing does work.

use crate::common::*;

/// A thrown sheet, held at one side, against a ball at rest, without gravity and air.
const THROWN: &str = include_str!("scenes/thrown.toml");

/// A tube that is twisted by a whole turn in 0.3 s and then held, so that nothing does work any more.
const TWISTED: &str = include_str!("scenes/twisted.toml");

/// Steps of a millisecond, and the kinetic energy of the cloth in each.
struct Steps {
    simulation: Simulation,
    /// The number of triangles at each vertex. All have the same area up to rounding, and a third of each is the vertex's mass.
    shares: Vec<f64>,
}

impl Steps {
    fn of(scene: &str) -> Self {
        let simulation = set_up(scene, "scene.toml", 1);
        let shares = shares(&simulation);
        Self { simulation, shares }
    }

    fn energies(&mut self, steps: usize) -> Vec<f64> {
        let mut before = self.simulation.positions().to_vec();
        let mut energies = Vec::new();
        for step in 0..steps {
            let done = self.simulation.step();
            done.unwrap_or_else(|blocked| panic!("{blocked}"));
            let now = self.simulation.positions();
            let squared = |vertex: usize| ((now[vertex] - before[vertex]) / 1e-3).length_squared();
            let energy = |(vertex, share): (usize, &f64)| 0.5 * share * squared(vertex);
            let all: f64 = self.shares.iter().enumerate().map(energy).sum();
            assert!(all.is_finite(), "step {step}");
            energies.push(all);
            before = now.to_vec();
        }
        energies
    }
}

fn most(energies: &[f64]) -> f64 {
    energies.iter().copied().fold(0.0, f64::max)
}

/// Energy starts as kinetic energy. It can only become elastic energy, which is not negative, and heat. So the kinetic energy
/// never exceeds that of the start.
#[test]
fn a_thrown_sheet_never_moves_faster_than_it_was_thrown() {
    let mut steps = Steps::of(THROWN);
    let energies = steps.energies(2000);
    // These are all vertices but the seventeen held ones: fifteen have three triangles, one has two, and one has one.
    let all: f64 = steps.shares.iter().sum();
    let thrown = 0.5 * (all - 48.0) * DVec3::new(0.4, 0.3, -2.0).length_squared();
    // The billionth is for the rounding of differences.
    let most = most(&energies);
    assert!(most <= thrown * (1.0 + 1e-9), "{most} of {thrown}");
    // The sheet hits the ball, and has lost energy by the end.
    assert!(steps.simulation.contact_counts().unwrap().pushed > 1000);
    assert!(energies[energies.len() - 1] < 0.5 * thrown);
}

/// The pins have done work, and stop. Motion decays, however many contacts push.
#[test]
fn a_twisted_tube_calms_down_when_its_pins_stop() {
    calms_down(TWISTED);
}

/// Energy also falls with so many neighbours within the thickness that they have a smaller one.
#[test]
fn a_twisted_tube_whose_edges_are_hardly_longer_than_it_is_thick_calms_down_when_its_pins_stop() {
    let fine = TWISTED.replace("[16, 16]", "[28, 28]").replace("\"3 mm\"", "\"6 mm\"");
    assert!(fine.contains("[28, 28]") && fine.contains("6 mm"));
    calms_down(&fine);
}

fn calms_down(scene: &str) {
    let mut steps = Steps::of(scene);
    let twisting = most(&steps.energies(300));
    let pushed = |steps: &Steps| steps.simulation.contact_counts().unwrap().pushed;
    let before = pushed(&steps);
    let after = [(); 4].map(|()| most(&steps.energies(300)));
    assert!(pushed(&steps) - before > 10_000);
    let [first, later @ ..] = after;
    assert!(first <= twisting, "{after:?} after {twisting}");
    assert!(most(&later) < 0.5 * twisting, "{after:?} after {twisting}");
}

/// Deforms a square of 1 m in two triangles within a second, and returns its energy.
fn drawn(groups: [&[u32]; 2], way: DVec3, effect: impl Effect + 'static) -> Energy {
    let mut scene = square(groups, way, 1.0, 1e-2);
    scene.add(effect);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let rest = simulation.energy();
    assert!(rest.elastic().unwrap() < 1e-20 && rest.gravitational().is_none(), "{rest:?}");
    advance(&mut simulation, 100);
    simulation.energy()
}

const SIDES: [&[u32]; 2] = [&[0, 2], &[1, 3]];

fn assert_near(found: f64, expected: f64, part: f64) {
    assert!((found - expected).abs() <= part * expected.abs(), "{found}, not {expected}");
}

#[test]
fn a_stretched_square_holds_half_of_k_times_area_times_the_strain_squared() {
    let energy = drawn(SIDES, DVec3::X * 0.1, Stretch::isotropic(300.0));
    assert_near(energy.elastic().unwrap(), 0.5 * 300.0 * 0.1 * 0.1, 1e-9);
    assert_eq!((energy.kinetic, energy.stored.len()), (0.0, 1));
    assert_eq!((energy.stored[0].0, energy.total()), ("stretch", energy.elastic().unwrap()));
}

#[test]
fn a_sheared_square_holds_half_of_k_times_area_times_the_product_of_warp_and_weft_squared() {
    // The warp becomes (1, 0.1), the weft stays (0, 1).
    let energy = drawn(SIDES, DVec3::Y * 0.1, Shear::new(80.0));
    assert_near(energy.elastic().unwrap(), 0.5 * 80.0 * 0.1 * 0.1, 1e-9);
}

/// Every weight of the hinge on the diagonal is 2 or −2, so that |C| is twice the move of a corner. It has two thirds of the
/// stiffness.
#[test]
fn a_bent_square_holds_a_third_of_k_over_its_area_times_c_squared() {
    let energy = drawn([&[0, 1, 2], &[3]], DVec3::Z * 0.1, Bend::isotropic(1e-5));
    assert_near(energy.elastic().unwrap(), 1e-5 / 3.0 * 0.2 * 0.2, 1e-9);
}

/// Kinematic vertices have no energy.
#[test]
fn in_free_fall_motion_and_weight_keep_their_sum_but_for_what_steps_of_first_order_take() {
    for accuracy in [Accuracy::Game, Accuracy::Film] {
        in_free_fall_the_sum_is_kept(accuracy);
    }
}

/// A step of implicit Euler takes ½·m·g²·h². BDF2 has exact velocities. Its first step is of first order and falls ½·g·h² too
/// far; after n steps that has become ¾·g·h²·(1 − 3⁻ⁿ), and so the weight has given m·g times that.
fn in_free_fall_the_sum_is_kept(accuracy: Accuracy) {
    let acceleration = DVec3::new(1.0, -2.0, -9.81);
    let mut cloth = Cloth::sheet(DVec3::new(3.0, 1.0, 2.0), [DVec3::X, DVec3::Y], [4, 4], 0.25).unwrap();
    cloth.velocity = DVec3::new(0.0, 3.0, 1.0);
    let (mass, h) = (0.25, 1e-3);
    let mut scene = Scene::new(cloth, h);
    scene.accuracy = accuracy;
    scene.add(Gravity { acceleration });
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let start = simulation.energy();
    assert_near(start.kinetic, 0.5 * mass * 10.0, 1e-12);
    assert_near(
        start.gravitational().unwrap(),
        -mass * acceleration.dot(DVec3::new(3.5, 1.5, 2.0)),
        1e-12,
    );
    for step in 1..=500 {
        simulation.step().unwrap();
        let steps = match accuracy {
            Accuracy::Game => 0.5 * f64::from(step),
            _ => 0.75 * (1.0 - 3.0_f64.powi(-step)),
        };
        let taken = mass * acceleration.length_squared() * h * h * steps;
        assert_near(simulation.energy().total(), start.total() - taken, 1e-10);
    }
    assert!(simulation.energy().kinetic > start.kinetic);
    assert_eq!(simulation.energy().elastic(), None);
}

#[test]
fn a_gas_holds_half_of_its_modulus_times_the_volume_that_it_lacks_squared() {
    let ball = Body::ball("ball", DVec3::new(5.0, 0.0, 0.0), 0.5, 24).unwrap();
    let cloth = Cloth::from_mesh(ball.mesh, DVec3::Z, 0.2).unwrap();
    let corners = |t: &[u32; 3]| t.map(|v| cloth.mesh().positions[v as usize] - 5.0 * DVec3::X);
    let parts = cloth
        .mesh()
        .triangles
        .iter()
        .map(corners)
        .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0);
    let volume: f64 = parts.sum();
    let mut scene = Scene::new(cloth, 1e-3);
    scene.add(InternalPressure {
        volume: 1.2,
        modulus: 5e3,
    });
    let simulation = Simulation::new(scene, 1).unwrap();
    let (goal, lacking) = (1.2 * volume, 0.2 * volume);
    assert_near(
        simulation.energy().elastic().unwrap(),
        0.5 * 5e3 * lacking * lacking / goal,
        1e-9,
    );
}

/// Weight becomes motion, which stretch, contact, drag and friction reduce.
#[test]
fn a_dropped_sheet_never_has_more_energy_than_it_started_with() {
    let scene = THROWN.to_owned() + "[effects.gravity]\n";
    let mut simulation = set_up(&scene, "scene.toml", 1);
    let start = simulation.energy();
    let names: Vec<_> = start.stored.iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["gravity", "stretch", "shear", "bend"]);
    assert!(matches!(start.stored[0].1, StoredEnergy::Gravitational(joules) if joules > 0.0));
    let mut most = f64::NEG_INFINITY;
    for _ in 0..2000 {
        simulation.step().unwrap();
        most = most.max(simulation.energy().total());
    }
    assert!(most <= 1.01 * start.total(), "{most} of {start:?}");
}

/// A sheet of 100 g/m² swings from two corners. What goes on straight in a long step stretches a stiff sheet, in N/m, by little
/// length and much energy, hardly any of which may remain.
#[test]
fn a_swinging_sheet_of_any_stiffness_gains_no_energy() {
    // Each solve of a game leaves a fiftieth. The sheet moves on half of its way in 16 ms, and on an eighth in 4 ms.
    for (milliseconds, share) in [(1.0, 1e-3), (4.0, 1e-2), (16.0, 5e-2)] {
        for stiffness in [1e2, 1e3, 1e4] {
            let risen = risen_over_motion(swinging(milliseconds * 1e-3, stiffness), 0.5);
            assert!(risen <= share, "{risen} with {stiffness} N/m at {milliseconds} ms");
        }
    }
}

/// A thousand times as stiff as cloth.
#[test]
fn a_swinging_sheet_that_is_stiffer_than_any_cloth_gains_little_energy() {
    for milliseconds in [1.0, 4.0] {
        let risen = risen_over_motion(swinging(milliseconds * 1e-3, 1e6), 0.5);
        assert!(risen <= 3e-2, "{risen} at {milliseconds} ms");
    }
}

fn swinging(time_step: f64, stiffness: f64) -> Scene {
    let cloth = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.4, DVec3::Y * 0.3], [12, 9], 0.1).unwrap();
    let corners = ["top-left", "top-right"].map(|name| cloth.part(name).unwrap()).concat();
    let mut scene = Scene::new(cloth, time_step);
    scene.add(Gravity::default());
    scene.add(Stretch::isotropic(stiffness));
    scene.add(Shear::new(0.1 * stiffness));
    scene.add(Bend::isotropic(1e-5));
    scene.add(resting(corners));
    scene
}

/// A blow stretches soft, heavy cloth beyond its limit. The way back is slow, or it would become motion.
#[test]
fn soft_cloth_that_a_strain_limit_stops_in_a_fall_gains_no_energy() {
    let ends = [-0.5, 0.5].map(|x| DVec3::new(x, 0.0, -1.0));
    let sides = [1.2 * DVec3::X, DVec3::new(0.0, 1.2, -0.6)];
    let cloth = Cloth::sheet(DVec3::new(-0.6, -0.6, 0.0), sides, [15, 13], 1.0).unwrap();
    let mut scene = Scene::new(cloth, 1e-3);
    scene.bodies.push(Body::capsule("bar", ends, 0.08, 8).unwrap());
    scene.add(Gravity::default());
    scene.add(Stretch::isotropic(50.0));
    scene.add(Shear::new(1.0));
    scene.add(StrainLimit { limit: 1.05 });
    scene.add(BodyContact(Thickness::new(0.03)));
    scene.add(SelfCollision(Thickness::new(0.03)));
    let risen = risen_over_motion(scene, 0.6);
    assert!(risen <= 5e-2, "{risen}");
}

/// A stiff sheet that is thrown on a bar while some of its vertices are held.
struct Thrown {
    milliseconds: f64,
    /// The length of each side, in m.
    width: f64,
    /// In kg/m².
    density: f64,
    /// In N/m.
    stiffness: f64,
    /// In m/s.
    velocity: [f64; 3],
    held: &'static [&'static str],
}

/// Each of them once gained eight to thirty times its motion: long steps stretched what turned, the correction of
/// momentum stretched it, too, and the certificate threw it back.
const THROWN_STIFF: [Thrown; 4] = [
    Thrown {
        milliseconds: 8.0,
        width: 0.3,
        density: 0.016,
        stiffness: 7.6e4,
        velocity: [0.1, 0.3, -2.7],
        held: &["left"],
    },
    Thrown {
        milliseconds: 8.0,
        width: 1.2,
        density: 0.016,
        stiffness: 8.2e4,
        velocity: [0.3, 0.5, 0.6],
        held: &["left"],
    },
    Thrown {
        milliseconds: 16.0,
        width: 0.3,
        density: 0.4,
        stiffness: 9.1e4,
        velocity: [-0.9, -0.9, -1.7],
        held: &["top-left"],
    },
    Thrown {
        milliseconds: 4.0,
        width: 0.6,
        density: 0.1,
        stiffness: 6.4e4,
        velocity: [1.0, -0.9, -2.0],
        held: &["top-left"],
    },
];

#[test]
fn a_stiff_sheet_that_is_thrown_on_a_bar_gains_no_energy() {
    for thrown in THROWN_STIFF {
        let Thrown {
            milliseconds,
            width,
            density,
            stiffness,
            velocity,
            held,
        } = thrown;
        let corner = DVec3::new(-0.5 * width, -0.5 * width, 0.4);
        let sides = [width * DVec3::X, width * DVec3::new(0.0, 1.0, 0.2)];
        let mut cloth = Cloth::sheet(corner, sides, [14, 9], density).unwrap();
        let held: Vec<u32> = { held.iter() }.flat_map(|part| cloth.part(part).unwrap().to_vec()).collect();
        cloth.velocity = DVec3::from(velocity);
        let mut scene = Scene::new(cloth, milliseconds * 1e-3);
        let ends = [-0.3, 0.3].map(|x| DVec3::X * x);
        scene.bodies.push(Body::capsule("bar", ends, 0.06, 12).unwrap());
        scene.add(Gravity::default());
        scene.add(Stretch::isotropic(stiffness));
        scene.add(Shear::new(0.2 * stiffness));
        scene.add(Bend::isotropic(10e-6));
        scene.add(BodyContact(Thickness::new(3e-3)));
        scene.add(SelfCollision(Thickness::new(3e-3)));
        scene.add(resting(held));
        let risen = risen_over_motion(scene, 2.0);
        println!("{risen} with {stiffness} N/m at {milliseconds} ms");
        assert!(risen <= 0.15, "{risen} with {stiffness} N/m at {milliseconds} ms");
    }
}

/// Returns the largest energy that a scene gains within a time, over its largest kinetic energy.
fn risen_over_motion(scene: Scene, seconds: f64) -> f64 {
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let (mut least, mut risen, mut moving) = (f64::INFINITY, 0.0_f64, 0.0_f64);
    while simulation.time() < seconds {
        simulation.step().unwrap();
        let energy = simulation.energy();
        least = least.min(energy.total());
        risen = risen.max(energy.total() - least);
        moving = moving.max(energy.kinetic);
    }
    risen / moving
}
