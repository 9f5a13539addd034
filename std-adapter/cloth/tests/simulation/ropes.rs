//! Ropes, laces and fringes: edges that belong to no triangle.

use crate::air::Even;
use crate::common::*;

const G: f64 = 9.81;

fn length(points: &[DVec3]) -> f64 {
    points.windows(2).map(|two| two[0].distance(two[1])).sum()
}

/// A weight in N, without mass, at the last vertex.
#[derive(Clone, Copy, Debug)]
struct Weight(f64);

selvedge_cloth::identify!(Weight { 0 });

impl selvedge_cloth::effects::Effect for Weight {
    fn name(&self) -> &'static str {
        "weight"
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_force(*self);
    }
}

impl Force for Weight {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        let last = velocities.len() - 1;
        velocities[last] -= DVec3::Z * (self.0 * step.inverse_masses[last] * step.h);
    }
}

fn wind(velocity: DVec3, rope_diameter: f64) -> Wind {
    Wind {
        rope_diameter,
        ..crate::common::wind(velocity)
    }
}

/// A rope of 2 m and 50 g/m that hangs from its start.
fn hanging(segments: u32, stiffness: f64, time_step: f64) -> Scene {
    let rope = Cloth::rope(&[DVec3::ZERO, DVec3::Z * -2.0], segments, 0.05).unwrap();
    let mut scene = Scene::new(rope, time_step);
    scene.add(Gravity::default()).add(RopeStretch::new(stiffness));
    scene.add(resting([0]));
    scene.add(AirDrag { rate: 5.0 });
    scene
}

/// The extension is F·l/EA for the weight F, and μ·g·l²/(2·EA) for the rope itself, with any number of segments and any time
/// step.
#[test]
fn a_hung_rope_is_stretched_as_its_stiffness_says() {
    for (segments, time_step) in [(20, 1e-3), (200, 1e-3), (200, 4e-3)] {
        for (stiffness, weight) in [(1e3, 20.0), (1e5, 50.0)] {
            let mut scene = hanging(segments, stiffness, time_step);
            scene.add(Weight(weight));
            let simulation = run(scene, (3.0 / time_step) as u64);
            let stretch = length(simulation.positions()) - 2.0;
            let theory = (weight * 2.0 + 0.05 * G * 2.0 * 2.0 / 2.0) / stiffness;
            assert!(
                (stretch / theory - 1.0).abs() < 0.01,
                "{segments}, {stiffness}: {stretch} for {theory}"
            );
        }
    }
}

/// A plate of 0.98 kg hangs below a rope of 0.1 kg with edges of 0.5 g. It is in one mesh with it, or tied to its end by a seam.
#[test]
fn a_rope_of_two_hundred_edges_that_holds_a_weight_is_stretched_by_a_thousandth_as_its_stiffness_says() {
    let (length_at_rest, stiffness, gap) = (2.0, 1e4, 1e-3);
    let rope = || {
        Cloth::rope(&[DVec3::ZERO, DVec3::Z * -length_at_rest], 200, 0.05)
            .unwrap()
            .named("rope")
    };
    let plate = |top: f64| [[0.0, 0.0], [0.07, -0.07], [-0.07, -0.07], [0.0, -0.14]].map(|[x, z]| DVec3::new(x, 0.0, top + z));
    let one_mesh = || {
        let mut mesh = rope().mesh().clone();
        mesh.positions.extend(&plate(-length_at_rest)[1..]);
        mesh.triangles = vec![[200, 201, 202], [201, 203, 202]];
        let edges: Vec<[u32; 2]> = (0..200).map(|k| [k, k + 1]).collect();
        vec![Cloth::from_mesh_with_loose_edges(mesh, &edges, DVec3::X, [100.0, 0.05]).unwrap()]
    };
    let tied = || {
        let mesh = Mesh::new(plate(-length_at_rest - gap).to_vec(), vec![[0, 1, 2], [1, 3, 2]]);
        vec![rope(), Cloth::from_mesh(mesh, DVec3::X, 100.0).unwrap().named("plate")]
    };
    for (is_tied, time_step) in [(false, 1e-3), (false, 4e-3), (true, 1e-3), (true, 4e-3)] {
        let mut cloths = if is_tied { tied() } else { one_mesh() }.into_iter();
        let mut scene = Scene::new(cloths.next().unwrap(), time_step);
        scene.cloths.extend(cloths);
        scene.add(Gravity::default()).add(RopeStretch::new(stiffness));
        scene.add(AirDrag { rate: 5.0 });
        scene.add(Stretch::isotropic(1e5)).add(Shear::new(1e5)).add(resting([0]));
        if is_tied {
            let seam = Seam {
                gap: Some(gap),
                ..Seam::new(vec![200], vec![201])
            };
            scene.add(Seams { seams: vec![seam] });
        }
        let simulation = run(scene, (2.0 / time_step) as u64);
        let stretch = length(&simulation.positions()[..=200]) - length_at_rest;
        let theory = (0.98 * length_at_rest + 0.05 * length_at_rest.powi(2) / 2.0) * G / stiffness;
        assert!(
            (stretch / theory - 1.0).abs() < 0.03,
            "{is_tied}, {time_step}: {stretch} for {theory}"
        );
    }
}

/// Waves travel at 45 m/s, four and a half edges in a step.
#[test]
fn a_taut_rope_that_is_plucked_comes_to_rest() {
    let rope = Cloth::rope(&[DVec3::ZERO, DVec3::X * 2.0], 200, 0.05).unwrap();
    let mut scene = Scene::new(rope, 1e-3);
    scene.add(RopeStretch::new(1e4)).add(AirDrag { rate: 3.0 });
    scene.add(pinned([0, 200], PinMotion::Own(BodyMotion::Driven(Default::default()))));
    scene.cloths[0].velocity = DVec3::Z;
    let mut simulation = Simulation::new(scene, 1).unwrap();
    for _ in 0..3000 {
        // The rope is stretched by a hundredth, with a jerk.
        simulation.move_pins(0, &[DVec3::ZERO, DVec3::X * 2.02]).unwrap();
        simulation.step().unwrap();
    }
    let off = simulation.positions().iter().map(|p| p.z.abs()).fold(0.0, f64::max);
    assert!(off < 1e-3, "{off}");
    assert!((length(simulation.positions()) - 2.02).abs() < 1e-6);
}

/// The tip sinks by w·l⁴/(8·D), for a deflection that is small beside the length.
#[test]
fn a_clamped_rope_bends_under_its_weight_as_a_beam() {
    for segments in [100, 200] {
        let edge = 0.5 / f64::from(segments);
        let rope = Cloth::rope(&[DVec3::X * -edge, DVec3::X * 0.5], segments + 1, 0.05).unwrap();
        let mut scene = Scene::new(rope, 1e-3);
        let rigidity = 0.15;
        scene.add(Gravity::default()).add(RopeStretch::new(1e5));
        scene.add(RopeBend::straight(rigidity));
        scene.add(resting([0, 1])).add(AirDrag { rate: 20.0 });
        let simulation = run(scene, 1500);
        let tip = -simulation.positions()[segments as usize + 1].z;
        let theory = 0.05 * G * 0.5_f64.powi(4) / (8.0 * rigidity);
        assert!((tip / theory - 1.0).abs() < 0.03, "{segments}: {tip} for {theory}");
    }
}

/// The rest shape as built keeps a hoop of 16 edges round; a straight rest shape stores energy.
#[test]
fn a_ring_keeps_the_shape_that_it_rests_in() {
    let corner = |k: u32| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::FRAC_PI_8).sin_cos();
        DVec3::new(cosine, sine, 0.0) * 0.2
    };
    let mesh = Mesh::new((0..16).map(corner).collect(), Vec::new());
    let edges: Vec<_> = (0..16).map(|k| [k, (k + 1) % 16]).collect();
    let hoop = Cloth::from_mesh_with_loose_edges(mesh, &edges, DVec3::X, [0.0, 0.1]).unwrap();
    let rest = hoop.mesh().positions.clone();
    let energy = |rest| {
        let mut scene = Scene::new(hoop.clone(), 1e-3);
        scene.add(RopeStretch::new(1e4)).add(RopeBend { stiffness: 1e-2, rest });
        let mut simulation = run(scene, 0);
        let energy = simulation.energy().elastic().unwrap();
        (0..100).for_each(|_| simulation.step().unwrap());
        (energy, simulation.positions().to_vec())
    };
    let (as_built, positions) = energy(RopeShape::AsBuilt);
    assert!(as_built < 1e-12);
    assert!(positions.iter().zip(&rest).all(|(a, b)| a.distance(*b) < 1e-9));
    // The energy is ½D/r² for each metre of its circumference, 2πr long.
    let (straight, _) = energy(RopeShape::Straight);
    let theory = 0.5 * 1e-2 / (0.2 * 0.2) * std::f64::consts::TAU * 0.2;
    assert!((straight / theory - 1.0).abs() < 0.02, "{straight} for {theory}");
}

/// Two ropes across each other over a ball, and a sheet below that is sewn to one of them.
fn tangle() -> Scene {
    let along = Cloth::rope(&[DVec3::new(-0.3, 0.01, 0.14), DVec3::new(0.3, 0.0, 0.14)], 60, 0.04);
    let across = Cloth::rope(&[DVec3::new(0.01, -0.3, 0.16), DVec3::new(0.0, 0.3, 0.16)], 60, 0.04);
    let sheet = Cloth::sheet(DVec3::new(-0.1, -0.1, 0.12), [DVec3::X * 0.2, DVec3::Y * 0.2], [12, 12], 0.1);
    let mut scene = Scene::new(along.unwrap().named("along"), 2e-3);
    scene.cloths.push(across.unwrap().named("across"));
    scene.cloths.push(sheet.unwrap().named("sheet"));
    let tied = [scene.part("along", "end").unwrap(), scene.part("across", "end").unwrap()];
    for rope in ["along", "across"] {
        scene.add_to(rope, SelfCollision(Thickness::new(8e-3)));
        scene.add_to(rope, BodyContact(Thickness::new(4e-3)));
    }
    scene.add_to("sheet", Stretch::isotropic(500.0));
    scene.bodies.push(Body::ball("ball", DVec3::ZERO, 0.1, 24).unwrap());
    scene.add(Gravity::default()).add(RopeStretch::new(5e3));
    scene.add(RopeBend::straight(1e-5));
    scene.add(SelfCollision(Thickness::new(3e-3)));
    scene.add(BodyContact(Thickness::new(3e-3)));
    scene.add(Friction { coefficient: 0.3 });
    let [first, second] = tied;
    scene.add(Seams {
        seams: vec![Seam {
            closing: Some(0.3),
            ..Seam::new(first, second)
        }],
    });
    scene
}

#[test]
fn ropes_stay_apart_from_each_other_from_cloth_and_from_bodies() {
    let mut simulation = Simulation::new(tangle(), 1).unwrap();
    for step in 0..400 {
        simulation.step().unwrap();
        assert!(simulation.is_certified(), "{step}");
        assert_eq!(intersections(&simulation), [], "{step}");
    }
    let closest = |from: usize| {
        let [one, other] = [0, 1].map(|cloth| simulation.vertices_of_cloth(cloth).unwrap());
        let others = &simulation.positions()[other];
        others
            .iter()
            .map(|p| p.distance(simulation.positions()[one.start + from]))
            .fold(1.0, f64::min)
    };
    assert!(closest(60) < 9e-3, "{}", closest(60));
}

#[test]
fn ropes_have_the_same_bits_on_any_number_of_threads_and_resumed() {
    assert_same_bits(tangle, CHECKPOINT_STEPS, 60);
}

/// An upright sheet of 0.2 m and 100 g/m² along x, with nine loose rows of five edges of a centimetre at its lower side.
fn fringed(linear_density: f64) -> Cloth {
    let mut mesh = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.2, DVec3::Z * 0.2], [8, 8], 0.1)
        .unwrap()
        .mesh()
        .clone();
    let mut loose = Vec::new();
    for root in 0..9 {
        let mut last = root;
        for k in 1..=5 {
            let next = mesh.positions.len() as u32;
            mesh.positions
                .push(mesh.positions[root as usize] - DVec3::Z * (0.01 * f64::from(k)));
            loose.push([last, next]);
            last = next;
        }
    }
    Cloth::from_mesh_with_loose_edges(mesh, &loose, DVec3::X, [0.1, linear_density]).unwrap()
}

#[test]
fn a_fringe_hangs_from_the_cloth_that_it_is_of() {
    let cloth = fringed(0.002);
    let mut scene = Scene::new(cloth, 1e-3);
    scene.add(Gravity::default()).add(Stretch::isotropic(1e3));
    scene.add(RopeStretch::new(100.0));
    scene.add(RopeBend::straight(1e-8)).add(SelfCollision(Thickness::new(2e-3)));
    scene.add(resting([72, 80]));
    let masses: f64 = 0.2 * 0.2 * 0.1 + 9.0 * 0.05 * 0.002;
    let simulation = run(scene, 300);
    let weight = masses * G;
    let kinetic = simulation.energy().kinetic;
    assert!(simulation.is_certified() && kinetic < 0.01 * weight, "{kinetic}");
    // The fringe keeps its length.
    for root in 0..9 {
        let tassel: Vec<DVec3> = [root]
            .into_iter()
            .chain(81 + 5 * root..86 + 5 * root)
            .map(|v| simulation.positions()[v])
            .collect();
        assert!((length(&tassel) - 0.05).abs() < 1e-3, "{}", length(&tassel));
    }
}

/// A square with two tassels in a file. Its lines are read if the scene gives `linear_density`.
#[test]
fn the_lines_of_a_file_are_loose_edges_if_they_are_given_a_weight() {
    let folder = tempfile::tempdir().unwrap();
    let square = "v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\nf 1 2 3 4\n";
    let tassels = "v 0 0 -0.01\nv 0 0 -0.02\nv 0.1 0 -0.01\nl 1 5 6\nl 2 7\n";
    let read = |content: &str, keys: &str| {
        std::fs::write(folder.path().join("shawl.obj"), content).unwrap();
        let cloth = format!("[cloth]\nshape = \"file\"\nfile = \"shawl.obj\"\n{keys}\n");
        let effects = "[effects.rope_stretch]\nstiffness = 50\n";
        let text = format!("time_step = 0.001\nduration = 1\n{cloth}{effects}");
        Scene::parse(&text, &folder.path().join("s.toml")).map_err(|error| error.to_string())
    };
    let scene = read(&(square.to_owned() + tassels), "density = 0.1\nlinear_density = \"2 g/m\"").unwrap();
    assert_eq!(scene.all_loose_edges(), [[0, 4], [4, 5], [1, 6]]);
    let simulation = Simulation::new(scene, 1).unwrap();
    assert_eq!((simulation.triangles().len(), simulation.loose_edges().len()), (2, 3));
    // A net has no area, and needs no density.
    assert!(
        read(
            tassels.replace("l 1 5 6\nl 2 7", "l 1 2 3").as_str(),
            "linear_density = 0.002"
        )
        .is_ok()
    );

    // Isolated vertices are left out, with a remark.
    let isolated = format!("{square}{tassels}v 9 9 9\n");
    let isolated = read(&isolated, "density = 0.1\nlinear_density = \"2 g/m\"").unwrap();
    assert_eq!(isolated.cloths[0].mesh().positions.len(), 7);
    assert!(isolated.remarks[0].starts_with("Isolated vertices in the file of the cloth 'cloth': 1."));

    let none = read(square, "density = 0.1\nlinear_density = 0.002").unwrap_err();
    let expected = "`linear_density` is for edges that belong to no triangle (lines `l` of an OBJ file), but the file has none";
    assert!(none.ends_with(expected), "{none}");
    let weightless = read(&(square.to_owned() + tassels), "density = 0.1").unwrap_err();
    let expected = "cloth must consist of proper triangles, but the mesh has 1 component, 4 boundary and 1 interior edges, 3 isolated vertices; give `linear_density` if lines `l` of the file join them";
    assert!(weightless.ends_with(expected), "{weightless}");
}

const ROPE: &str = include_str!("scenes/rope.toml");

#[test]
fn a_scene_file_says_what_code_does() {
    let mut from_file = set_up(ROPE, "rope.toml", 1);
    let mut scene = Scene::new(Cloth::rope(&[DVec3::ZERO, DVec3::X], 20, 0.05).unwrap(), 2e-3);
    scene.add(Gravity::default()).add(RopeStretch::new(5e3));
    scene.add(RopeBend::straight(1e-4)).add(resting([0]));
    let mut from_code = Simulation::new(scene, 1).unwrap();
    [&mut from_file, &mut from_code]
        .into_iter()
        .for_each(|simulation| advance(simulation, 50));
    assert_eq!(from_file.positions(), from_code.positions());
    assert_eq!(from_file.loose_edges().len(), 20);
    let told: Vec<_> = from_file.effects().iter().map(|effect| effect.name).collect();
    assert_eq!(told, ["gravity", "pins", "rope_bend", "rope_stretch"]);
    let energy = from_file.energy();
    assert!(energy.stored.iter().any(|(name, _)| *name == "rope_bend") && energy.elastic().unwrap() > 0.0);
    let fabric = Scene::parse(ROPE, &scene_file("rope.toml")).unwrap().fabric();
    let told = |what: &str| fabric.iter().find(|(name, _)| name == what).map(|(_, value)| value.as_str());
    assert_eq!(told("weight of loose edges"), Some("50 g/m"));
    assert_eq!(told("axial stiffness of loose edges"), Some("5 kN"));
    assert_eq!(told("bending stiffness of loose edges"), Some("0.1 mN m2"));
    assert_eq!(told("weight"), None);
}

#[test]
fn what_cannot_be_of_loose_edges_is_told_from_code() {
    let triangle = || Mesh::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], vec![[0, 1, 2]]);
    let made = |edges: &[[u32; 2]], densities| Cloth::from_mesh_with_loose_edges(triangle(), edges, DVec3::X, densities);
    assert!(made(&[[0, 3]], [0.1, 0.1]).is_ok());
    let twice = "loose edge 1 of the cloth joins two vertices that a triangle or another loose edge joins already";
    assert_errors! {
        made(&[[0, 4]], [0.1, 0.1]) => "loose edge 0 names vertex 4, but there are 4 vertices, numbered from 0";
        made(&[[0, 3], [3, 0]], [0.1, 0.1]) => twice;
        made(&[[0, 3], [2, 1]], [0.1, 0.1]) => twice;
        made(&[[0, 3], [1, 1]], [0.1, 0.1]) => "loose edge 1 of the cloth is shorter than 1e-5 metres; are the units metres?";
        made(&[[0, 3]], [0.1, 0.0]) => "`linear_density` is 0 kg/m, but must be from 1e-6 kg/m to 100 kg/m";
    }
    let line = Cloth::rope(&[DVec3::ZERO, DVec3::X], 3, 0.1).unwrap().named("line");
    assert_complaints! { Scene::new(line, 1e-3);
        |s| _ = s.add_to("line", Stretch::isotropic(1.0))
            => "stretch: 'stretch' has nothing to act on: the cloth 'line' has no triangles; ropes use `rope_stretch` and `rope_bend`";
    }
    let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [2, 2], 0.1).unwrap();
    assert_complaints! { Scene::new(sheet, 1e-3);
        |s| _ = s.add(RopeStretch::new(1.0)) => "rope_stretch: 'rope_stretch' has nothing to act on: no cloth has loose edges…";
    }
}

/// A rope of 8 mm and 50 g/m in a wind of 10 m/s hangs so that sin ϑ / cos² ϑ = ρ·d·U²/(2·μ·g), from drag and weight across it.
#[test]
fn a_rope_in_a_wind_leans_until_drag_and_weight_across_it_are_even() {
    let mut scene = hanging(40, 1e5, 1e-3);
    scene.add(wind(DVec3::X * 10.0, 8e-3));
    let simulation = run(scene, 4000);
    let asked = 1.2 * 8e-3 * 100.0 / (2.0 * 0.05 * G);
    let sine = ((1.0 + 4.0 * asked * asked).sqrt() - 1.0) / (2.0 * asked);
    for two in simulation.positions().windows(2) {
        let found = (two[1] - two[0]).normalize();
        assert!((found.x - sine).abs() < 2e-3, "{} for {sine}", found.x);
    }
}

#[test]
fn a_wind_along_a_rope_does_nothing_to_it_and_one_across_never_makes_it_faster_than_itself() {
    let rope = || Cloth::rope(&[DVec3::ZERO, DVec3::Z], 10, 1e-4).unwrap();
    let blown = |velocity| {
        let mut scene = Scene::new(rope(), 1e-2);
        scene.add(wind(velocity, 0.05));
        run(scene, 5).velocities().to_vec()
    };
    assert!(blown(DVec3::Z * 300.0).iter().all(|velocity| *velocity == DVec3::ZERO));
    for velocity in blown(DVec3::X * 300.0) {
        assert!(velocity.x > 290.0 && velocity.x <= 300.0, "{velocity}");
    }
}

/// A vertex of triangles and edges gets the momentum of both.
#[test]
fn air_gives_a_fringed_cloth_as_much_momentum_as_its_triangles_and_edges_stop() {
    let (linear_density, diameter, speed, step) = (0.02, 3e-3, 5.0, 1e-4);
    for rope_diameter in [0.0, diameter] {
        let cloth = fringed(linear_density);
        let mut scene = Scene::new(cloth, step);
        scene.add(wind(DVec3::Y * speed, rope_diameter));
        let masses = {
            let mut masses = masses(scene.cloths[0].mesh(), 0.1);
            for edge in scene.cloths[0].topology().loose_edges() {
                edge.iter()
                    .for_each(|&vertex| masses[vertex as usize] += linear_density * 0.01 / 2.0);
            }
            masses
        };
        let simulation = run(scene, 1);
        let momentum: DVec3 = masses
            .iter()
            .zip(simulation.velocities())
            .map(|(mass, velocity)| *velocity * *mass)
            .sum();
        let given = |mass: f64, slowing: f64| mass * speed * slowing * step * speed / (1.0 + slowing * step * speed);
        let of_triangles = given(0.1 * 0.04, 0.5 * 1.2 / 0.1);
        let of_edges = given(9.0 * 0.05 * linear_density, 0.5 * 1.2 * rope_diameter / linear_density);
        // Both act on the common vertices at once, which a short step hardly shows.
        let expected = of_triangles + of_edges;
        assert!((momentum.y / expected - 1.0).abs() < 5e-3, "{} for {expected}", momentum.y);
    }
}

#[test]
fn a_field_blows_on_ropes_as_the_same_wind_does() {
    let velocity = DVec3::new(0.5, 6.0, 0.0);
    let rope_diameter = 8e-3;
    let field = WindField {
        rope_diameter,
        ..WindField::new(Even(velocity))
    };
    let mut scenes = [hanging(20, 1e4, 1e-3), hanging(20, 1e4, 1e-3)];
    scenes[0].add(wind(velocity, rope_diameter));
    scenes[1].add(field);
    let [of_wind, of_field] = scenes.map(|scene| run(scene, 100));
    assert_eq!(of_wind.positions(), of_field.positions());
    assert!(of_wind.velocities()[20].y > 0.1);
}

#[test]
fn a_diameter_of_ropes_asks_for_a_rope() {
    let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [2, 2], 0.1).unwrap();
    assert_complaints! { Scene::new(sheet, 1e-3);
        |s| _ = s.add(wind(DVec3::ZERO, 1e-3)) => "wind: `rope_diameter` is the diameter of loose edges…";
    }
    assert_complaints! { hanging(4, 1e4, 1e-3);
        |s| _ = s.add(wind(DVec3::ZERO, 2.0)) => "wind: `rope_diameter` is 2 m…";
    }
}
