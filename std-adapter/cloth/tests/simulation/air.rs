//! Moving air: inflation by a prescribed pressure, and wind from a field.

use crate::common;
use crate::common::*;

const RADIUS: f64 = 0.1;

/// A ball of cloth about (1, 0, 0), with its triangles facing inwards if `is_inside_out`.
fn balloon(is_inside_out: bool) -> Cloth {
    let mut mesh = Body::ball("ball", DVec3::X, RADIUS, 24).unwrap().mesh;
    if is_inside_out {
        mesh.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    }
    Cloth::from_mesh(mesh, DVec3::Z, 0.2).unwrap()
}

/// Runs with steps of half a millisecond.
fn run(cloth: Cloth, effects: impl FnOnce(&mut Scene), steps: u64) -> Simulation {
    let mut scene = Scene::new(cloth, 5e-4);
    effects(&mut scene);
    common::run(scene, steps)
}

fn mean_radius(simulation: &Simulation) -> f64 {
    let count = simulation.cloth_vertices();
    let positions = &simulation.positions()[..count];
    positions.iter().map(|p| p.distance(DVec3::X)).sum::<f64>() / count as f64
}

/// The skin of a ball has the tension T = k·(r − R)/R, and p = 2T/r. Shorter steps leave less of the pull to the next.
#[test]
fn a_balloon_grows_until_its_skin_holds_the_pressure() {
    let (stiffness, pressure) = (200.0, 400.0);
    for is_inside_out in [false, true] {
        let effects = |scene: &mut Scene| {
            scene.time_step = 1e-4;
            scene.add(Stretch::isotropic(stiffness)).add(AirDrag { rate: 20.0 });
            scene.add(Inflation::at(pressure)).add(SelfCollision(Thickness::new(1e-3)));
        };
        let inflated = run(balloon(is_inside_out), effects, 8000);
        let expected = RADIUS / (1.0 - pressure * RADIUS / (2.0 * stiffness));
        let found = mean_radius(&inflated);
        assert!((found / expected - 1.0).abs() < 0.02, "{found}, not {expected}");
        assert!(inflated.is_certified());
    }
}

#[test]
fn a_pressure_over_time_is_that_of_its_keyframes() {
    let key = |time, pressure| PressureKey { time, pressure };
    let after = |steps| {
        let inflation = Inflation {
            keyframes: vec![key(0.1, 0.0), key(0.4, 400.0), key(0.5, 0.0)],
        };
        let effects = |scene: &mut Scene| {
            scene.add(inflation).add(Stretch::isotropic(200.0));
            scene.add(AirDrag { rate: 20.0 });
        };
        mean_radius(&run(balloon(false), effects, steps)) / RADIUS
    };
    let [before, full, empty] = [200, 800, 2000].map(after);
    assert!((before - 1.0).abs() < 1e-9, "{before}");
    assert!(full > 1.08, "{full}");
    assert!((empty - 1.0).abs() < 0.01, "{empty}");
}

/// In one step the momentum is exact, and each vertex of an open sheet gets p·h/σ.
#[test]
fn a_closed_cloth_is_not_pushed_as_a_whole_and_an_open_one_along_its_normals() {
    let closed = run(balloon(false), |scene| _ = scene.add(Inflation::at(1e3)), 1);
    let (mut momentum, mut sizes) = (DVec3::ZERO, 0.0);
    let mesh = balloon(false).mesh().clone();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|v| mesh.positions[v as usize]);
        for vertex in triangle {
            let own = closed.velocities()[*vertex as usize] * (b - a).cross(c - a).length();
            momentum += own;
            sizes += own.length();
        }
    }
    assert!(sizes > 1e-3 && momentum.length() < 1e-12 * sizes, "{momentum} of {sizes}");
    let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [4, 4], 0.2).unwrap();
    let open = run(sheet, |scene| _ = scene.add(Inflation::at(30.0)), 1);
    let expected = DVec3::Z * (30.0 * 5e-4 / 0.2);
    for velocity in open.velocities() {
        // The push is that at the end of the step, where the sheet is a little bent.
        assert!(
            velocity.distance(expected) < 1e-6 * expected.length(),
            "{velocity}, not {expected}"
        );
    }
}

/// A uniform wind, as a field.
#[derive(Debug)]
pub(crate) struct Even(pub(crate) DVec3);

selvedge_cloth::identify!(Even { 0 });

impl Air for Even {
    fn velocity(&self, _: DVec3, _: f64) -> DVec3 {
        self.0
    }
}

fn sheet() -> Cloth {
    Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.3, DVec3::Z * 0.3], [6, 6], 0.1).unwrap()
}

#[test]
fn a_field_that_is_the_same_everywhere_is_wind_to_the_last_bit() {
    let velocity = DVec3::new(1.0, 4.0, 0.5);
    let even = run(sheet(), |scene| _ = scene.add(WindField::new(Even(velocity))), 100);
    let wind = wind(velocity);
    let wind = run(sheet(), |scene| _ = scene.add(wind), 100);
    assert_eq!(even.positions(), wind.positions());
    assert!(even.velocities()[0].y > 0.01);
}

#[derive(Debug)]
struct Gust;

selvedge_cloth::identify!(Gust {});

impl Air for Gust {
    fn velocity(&self, at: DVec3, time: f64) -> DVec3 {
        if at.x > 0.15 && time > 0.02 {
            DVec3::Y * 5.0
        } else {
            DVec3::ZERO
        }
    }
}

#[test]
fn a_field_from_code_depends_on_place_and_time() {
    let fastest = |steps, side: &str| {
        let vertices = sheet().part(side).unwrap().to_vec();
        let blown = run(sheet(), |scene| _ = scene.add(WindField::new(Gust)), steps);
        vertices.iter().map(|&v| blown.velocities()[v as usize].y).fold(0.0, f64::max)
    };
    assert_eq!([fastest(40, "right"), fastest(200, "left")], [0.0, 0.0]);
    assert!(fastest(200, "right") > 0.1);
}

fn fan() -> Fan {
    Fan {
        at: DVec3::new(1.0, 2.0, 3.0),
        velocity: DVec3::Y * 6.0,
        radius: 0.2,
    }
}

fn moved_by(source: AirSource, at: DVec3) -> DVec3 {
    vec![source].velocity(at, 0.0)
}

#[test]
fn a_fan_blows_a_jet_that_keeps_its_momentum() {
    let fan = fan();
    let blown = |along: f64, across: f64| moved_by(AirSource::Fan(fan), fan.at + DVec3::new(across, along, 0.0));
    assert_eq!(blown(0.0, 0.0), fan.velocity);
    assert!(blown(0.0, fan.radius).distance(fan.velocity / 2.0) < 1e-12);
    assert_eq!(blown(-0.1, 0.0), DVec3::ZERO, "behind it the air is still");
    // The momentum through a section is ∫U²·2πr·dr.
    let momentum = |along: f64| {
        let rings = (0..4000).map(|k| 1e-3 * (f64::from(k) + 0.5));
        rings.map(|r| blown(along, r).length_squared() * r).sum::<f64>()
    };
    for along in [1.0, 5.0] {
        assert!((momentum(along) / momentum(0.0) - 1.0).abs() < 1e-3, "{along} m");
    }
}

#[test]
fn a_vortex_is_fastest_at_its_radius_and_turns_counter_clockwise() {
    let vortex = Vortex {
        at: DVec3::ONE,
        axis: DVec3::Z * 7.0,
        speed: 3.0,
        radius: 0.5,
    };
    let blown = |x: f64| moved_by(AirSource::Vortex(vortex), DVec3::new(1.0 + x, 1.0, -4.0));
    assert!(blown(0.5).distance(3.0 * DVec3::Y) < 1e-12);
    assert!(blown(-0.5).distance(-3.0 * DVec3::Y) < 1e-12);
    assert_eq!(blown(0.0), DVec3::ZERO);
    assert!((1..100).all(|k| blown(0.05 * f64::from(k)).y <= 3.0));
}

const FILE: &str = include_str!("scenes/air.toml");

#[test]
fn fields_and_pressures_from_a_file_and_from_code_are_the_same_to_the_last_bit() {
    let of_file = common::run(Scene::parse(FILE, Path::new("s.toml")).unwrap(), 200);
    let sources = vec![
        AirSource::Fan(Fan {
            at: DVec3::new(0.1, -0.2, 0.1),
            velocity: DVec3::new(0.0, 18.0 * (1.0 / 3.6), 1.0),
            radius: 0.1,
        }),
        AirSource::Vortex(Vortex {
            at: DVec3::ZERO,
            axis: DVec3::Z,
            speed: 2.0,
            radius: 0.3,
        }),
    ];
    let key = |time, pressure| PressureKey { time, pressure };
    let inflation = Inflation {
        keyframes: vec![key(0.0, 5.0), key(0.05, -10.0)],
    };
    let effects = |scene: &mut Scene| _ = scene.add(WindField::from_sources(sources)).add(inflation);
    assert_eq!(of_file.positions(), run(sheet(), effects, 200).positions());
}

#[test]
fn wrong_air_from_code_is_named_with_its_unit() {
    let endless = Fan {
        velocity: DVec3::Y * f64::NAN,
        ..fan()
    };
    assert_complaints! { Scene::new(sheet(), 1e-3);
        |s| _ = s.add(WindField::from_sources(vec![AirSource::Fan(endless)])) => "wind_field: `velocity` is NaN m/s…";
        |s| _ = s.add(Inflation { keyframes: Vec::new() }) => "inflation: inflation needs a `pressure`…";
    }
    assert_eq!(WindField::new(Gust).name(), "wind_field");
}
