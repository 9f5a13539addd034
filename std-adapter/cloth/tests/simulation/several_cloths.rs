//! Several cloths in a scene, each with its own properties.

use crate::common::*;
use selvedge::core::PairKind;
use selvedge::core::separation::closest::ClosestPoints;

/// A horizontal sheet of 0.3 m with this lower left corner.
fn sheet(name: &str, corner: DVec3, cells: u32, density: f64) -> Cloth {
    let cloth = Cloth::sheet(corner, [0.3 * DVec3::X, 0.3 * DVec3::Y], [cells; 2], density).unwrap();
    cloth.named(name)
}

fn of_cloth(simulation: &Simulation, cloth: usize) -> &[DVec3] {
    &simulation.positions()[simulation.vertices_of_cloth(cloth).unwrap()]
}

const LAYERS: &str = include_str!("scenes/layers.toml");

fn from_file() -> Scene {
    Scene::parse(LAYERS, Path::new("layers.toml")).unwrap()
}

fn from_code() -> Scene {
    let corner = |height| DVec3::new(-0.15, -0.15, height);
    let mut lining = sheet("lining", corner(0.076), 10, 0.08);
    lining.velocity = -0.1 * DVec3::Z;
    let mut scene = Scene::new(sheet("shell", corner(0.08), 12, 0.2), 2e-3);
    scene.cloths.push(lining);
    let of_shell = Thickness {
        thickness: 5e-3,
        separation: 1e-3,
    };
    scene.add_to("shell", SelfCollision(of_shell));
    scene.add_to("lining", Stretch::isotropic(80.0));
    scene.add_to("lining", SelfCollision(Thickness::new(3e-3)));
    scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.06, 16).unwrap());
    let wind = wind(DVec3::X);
    scene.add(Gravity::default()).add(wind).add(Stretch::isotropic(400.0));
    scene.add(Shear::new(40.0)).add(Friction { coefficient: 0.3 });
    scene.add(BodyContact(Thickness::new(4e-3)));
    let corner = scene.part("lining", "bottom-left").unwrap();
    scene.add(resting(corner));
    scene
}

#[test]
fn code_and_file_make_the_same_scene_of_two_cloths_to_the_last_bit() {
    let [file, code] = [from_file(), from_code()].map(|scene| {
        assert_eq!(scene.effect_names().len(), 8);
        run(scene, 100)
    });
    assert_eq!(file.cloth_names(), ["shell", "lining"]);
    assert_eq!(file.positions(), code.positions());
    assert_eq!(file.cloth_vertices(), 13 * 13 + 11 * 11);
    assert_eq!(file.vertices_of_cloth(1), Some(169..290));
    assert!(file.is_certified());
}

#[test]
fn several_cloths_have_the_same_bits_on_any_number_of_threads_and_resumed() {
    assert_same_bits(from_file, CHECKPOINT_STEPS, 60);
    let checkpoint = run(from_file(), 0).checkpoint().unwrap();
    // A cloth's own effect is part of the scene.
    let mut other = from_code();
    other.add_to("lining", Stretch::isotropic(81.0));
    assert!(Simulation::new(other, 1).unwrap().resume(&checkpoint).is_err());
}

/// Each effect sees the vertices of its cloth alone. One solve serves all cloths, so that they agree up to its accuracy.
#[test]
fn cloths_that_do_not_meet_go_as_each_goes_alone_up_to_the_accuracy_of_the_solve() {
    let places = [DVec3::ZERO, DVec3::new(2.0, 0.0, 0.0)];
    let cloths = || {
        let stiff = sheet("stiff", places[0], 9, 0.2);
        let mut soft = sheet("soft", places[1], 14, 0.1);
        soft.velocity = DVec3::X;
        [stiff, soft]
    };
    let scene = |cloths: Vec<Cloth>| {
        let mut all = cloths.into_iter();
        let mut scene = Scene::new(all.next().unwrap(), 1e-3);
        scene.cloths.extend(all);
        scene.accuracy = Accuracy::Exact;
        scene.add(Gravity::default()).add(Stretch::isotropic(60.0));
        if scene.cloths[0].name == "stiff" {
            let wind = wind(DVec3::new(0.0, 2.0, 1.0));
            scene.add_to("stiff", Stretch::isotropic(900.0)).add_to("stiff", wind);
        }
        let corners = scene.cloths.iter().flat_map(|cloth| scene.part(&cloth.name, "left").unwrap());
        let corners: Vec<u32> = corners.collect();
        scene.add(resting(corners));
        run(scene, 50)
    };
    let together = scene(cloths().into());
    for (index, cloth) in cloths().into_iter().enumerate() {
        let alone = scene(vec![cloth]);
        let both = of_cloth(&together, index).iter().zip(alone.positions());
        let differ = both.map(|(one, other)| one.distance(*other)).fold(0.0, f64::max);
        assert!(differ < 1e-4, "{index}: {differ} m");
    }
}

/// The lower sheet is held at its rim, and the upper one lies on it, nowhere nearer than the mean of their separations.
#[test]
fn two_cloths_keep_the_mean_of_their_thicknesses_from_each_other() {
    for thickness in [[6e-3, 6e-3], [6e-3, 2e-3], [2e-3, 2e-3]] {
        let below = sheet("below", DVec3::ZERO, 12, 0.2);
        // Vertices of one sheet do not stand on vertices of the other.
        let above = sheet("above", DVec3::new(0.011, 0.007, 0.01), 10, 0.1);
        let rim = ["left", "right", "bottom", "top"];
        let mut rim = rim.map(|part| below.part(part).unwrap()).concat();
        rim.sort_unstable();
        rim.dedup();
        let mut scene = Scene::new(below, 2e-3);
        scene.cloths.push(above);
        for (cloth, thickness) in ["below", "above"].into_iter().zip(thickness) {
            scene.add_to(cloth, SelfCollision(Thickness::new(thickness)));
        }
        scene.add(Gravity::default()).add(Stretch::isotropic(500.0));
        scene.add(Friction { coefficient: 0.5 });
        scene.add(resting(rim));
        let simulation = run(scene, 400);
        let (positions, triangles) = (simulation.positions(), simulation.triangles());
        let distances = (169..290).map(|vertex| {
            let to = |t: &[u32; 3]| {
                ClosestPoints::from_points(
                    PairKind::VertexFace,
                    [vertex, t[0], t[1], t[2]].map(|v| positions[v as usize]),
                )
            };
            triangles[..288]
                .iter()
                .map(|t| to(t).distance())
                .fold(f64::INFINITY, f64::min)
        });
        let mut distances: Vec<f64> = distances.collect();
        distances.sort_by(f64::total_cmp);
        let [mean, least, middle] = [0.5 * (thickness[0] + thickness[1]), distances[0], distances[60]];
        assert!(least > 0.1 * mean, "{least} of {mean}");
        assert!((0.9..1.1).contains(&(middle / mean)), "{middle} of {mean}");
    }
}

#[test]
fn a_cloth_of_its_own_stiffness_is_stretched_as_that_says() {
    // The sheets hang side by side by their upper edges.
    let mut scene = Scene::new(sheet("first", DVec3::ZERO, 8, 0.2), 2e-3);
    scene.cloths.push(sheet("second", DVec3::new(0.5, 0.0, 0.0), 8, 0.2));
    scene.add_to("second", Stretch::isotropic(20.0));
    let tops = ["first", "second"].map(|name| scene.part(name, "top").unwrap()).concat();
    scene.add(Gravity {
        acceleration: -9.81 * DVec3::Y,
    });
    scene.add(Stretch::isotropic(200.0)).add(AirDrag { rate: 5.0 });
    scene.add(resting(tops));
    let simulation = run(scene, 3000);
    let lengthened = |cloth: usize| -of_cloth(&simulation, cloth)[..9].iter().map(|p| p.y).sum::<f64>() / 9.0;
    let [first, second] = [lengthened(0), lengthened(1)];
    assert!((8.0..12.0).contains(&(second / first)), "{first} {second}");
}

#[test]
fn what_is_wrong_with_several_cloths_is_told_with_their_names() {
    assert_complaints! { from_code();
        |s| s.cloths.clear() => "the scene has no cloth, but needs one or more";
        |s| s.cloths[1].name = "shell".into() => "there are two cloths named 'shell'";
        |s| s.cloths[1].density = 0.0 => "lining: `density` is 0 kg/m2, but must be from 0.001 kg/m2 to 100 kg/m2";
        |s| _ = s.add_to("lining", Stretch::isotropic(-1.0))
            => "stretch of 'lining': `stiffness` is -1 N/m, but must be from 0.001 N/m to 1e9 N/m";
        |s| _ = s.add_to("lining", Gravity::default())
            => "gravity of 'lining': 'gravity' acts on the whole scene, so no cloth may have its own: name it in [effects.gravity]";
        |s| _ = s.add_to("linen", Gravity::default()) => "there is no cloth 'linen'; did you mean 'lining'?";
        |s| s.cloths.push(sheet("patch", DVec3::Z, 2, 0.1))
            => "self_collision of 'shell': 'self_collision' acts between cloths: name it in [effects.self_collision] for all of them, or in every cloth";
        |s| _ = s.add(InternalPressure::with_volume_ratio(1.1))
            => "internal_pressure of 'shell': internal pressure needs a closed cloth, but this one has 48 open edges";
        |s| _ = s.add(resting([290]))
            => "pins: the scene has no vertex 290 of cloth: it has 290, numbered from 0";
    }
}
