//! Cloth tears above its strength and nowhere else, conserves momentum, and has the same bits in every kind of run.

use crate::common;
use crate::common::*;

/// Cells along and across a strip, of a centimetre each.
const CELLS: [u32; 2] = [10, 5];

fn strip(name: &str, at: DVec3) -> Cloth {
    let sides = [DVec3::X * 0.01 * f64::from(CELLS[0]), DVec3::Y * 0.01 * f64::from(CELLS[1])];
    Cloth::sheet(at, sides, CELLS, 0.2).unwrap().named(name)
}

/// Returns the vertices of the strip in a column.
fn column(column: u32) -> Vec<u32> {
    (0..=CELLS[1]).map(|row| (CELLS[0] + 1) * row + column).collect()
}

/// Pins the ends of the strip.
fn drawn() -> Pins {
    let mut pins = pinned(
        column(CELLS[0]),
        PinMotion::Own(along([(0.0, DVec3::ZERO), (0.1, DVec3::X * 0.01)])),
    );
    pins.groups.push(PinGroup::resting(column(0)));
    pins
}

/// Makes a strip of 1 kN/m whose ends are drawn apart by a centimetre in a tenth of a second. It stretches by a tenth, so that
/// 100 N pull on each metre of its width.
fn pulled(tearing: Tearing) -> Scene {
    let mut scene = Scene::new(strip("cloth", DVec3::ZERO), 1e-3);
    scene.add(drawn());
    scene.add(Stretch::isotropic(1000.0)).add(Shear::new(100.0));
    scene.add(SelfCollision(Thickness::new(1e-3))).add(tearing);
    scene
}

/// Counts the connected pieces of the cloth.
fn pieces(simulation: &Simulation) -> usize {
    let mut piece: Vec<usize> = (0..simulation.cloth_vertices()).collect();
    let triangles = &simulation.triangles()[..simulation.cloth_triangles()];
    let mut has_changed = true;
    while has_changed {
        has_changed = false;
        for triangle in triangles {
            let own = triangle.map(|vertex| piece[vertex as usize]);
            let least = own[0].min(own[1]).min(own[2]);
            has_changed |= own != [least; 3];
            triangle.iter().for_each(|&vertex| piece[vertex as usize] = least);
        }
    }
    piece.sort_unstable();
    piece.dedup();
    piece.len()
}

#[test]
fn a_strip_tears_through_above_its_strength_and_not_at_all_below() {
    for (strength, expected) in [(120.0, 1), (60.0, 2)] {
        let simulation = run(pulled(Tearing::perforated(column(5), strength)), 200);
        assert_eq!(pieces(&simulation), expected, "{strength} N/m");
        let torn = simulation.torn_edges();
        assert_eq!(torn.len(), if expected == 1 { 0 } else { 5 });
        assert_eq!(simulation.positions().len(), 66 + if expected == 1 { 0 } else { 6 });
        assert!(
            torn.iter()
                .all(|edge| edge.load > strength && edge.cloth == 0 && edge.time > 0.03)
        );
        assert!(simulation.is_certified());
    }
}

#[test]
fn a_perforation_tears_where_the_cloth_would_hold_and_nothing_else_does() {
    let tearing = Tearing {
        strength: Some(150.0),
        ..Tearing::perforated(column(5), 50.0)
    };
    let simulation = run(pulled(tearing), 200);
    let torn = simulation.torn_edges();
    assert_eq!(torn.len(), 5);
    assert!(
        torn.iter()
            .all(|edge| edge.vertices.iter().all(|end| column(5).contains(end)))
    );
    let mut copied = simulation.copied_vertices(0).to_vec();
    copied.sort_unstable();
    assert_eq!(copied, column(5));
}

#[test]
fn a_tear_within_the_cloth_is_a_slit_and_vertices_that_are_not_split_keep_their_numbers() {
    let slit = &column(5)[1..4];
    let simulation = run(pulled(Tearing::perforated(slit, 50.0)), 200);
    assert_eq!((pieces(&simulation), simulation.torn_edges().len()), (1, 2));
    assert_eq!(simulation.copied_vertices(0), [slit[1]]);
    let gap = simulation.positions()[slit[1] as usize].distance(simulation.positions()[66]);
    assert!(gap > 1e-4, "the slit is {gap} m wide");
    // The border keeps its place.
    assert!(column(0).iter().all(|&pin| simulation.positions()[pin as usize].x == 0.0));
}

#[test]
fn what_pins_hold_is_not_split() {
    // An edge ends at a pinned vertex, or has an end inside the cloth.
    let held = [column(0), column(1)[2..4].to_vec()].concat();
    let simulation = run(pulled(Tearing::perforated(held, 10.0)), 200);
    assert!(simulation.copied_vertices(0).iter().all(|copied| !column(0).contains(copied)));
}

/// Pulls both halves of a cloth apart, evenly.
#[derive(Debug)]
struct Apart;

const ACCELERATION: f64 = 2000.0;

selvedge_cloth::identify!(Apart {});

impl Effect for Apart {
    fn name(&self) -> &'static str {
        "apart"
    }

    fn register(&self, plan: &mut Plan<'_>) {
        plan.add_force(Self);
    }
}

impl Force for Apart {
    fn apply(&mut self, step: &TimeStep<'_>, velocities: &mut [DVec3]) {
        for (velocity, start) in velocities.iter_mut().zip(step.start) {
            let side = if start.x > 0.05 { 1.0 } else { -0.5 };
            *velocity += DVec3::new(side, 0.3, 0.1) * (ACCELERATION * step.h);
        }
    }
}

/// Returns the mass of each vertex of the torn cloth: a third of its triangles'.
fn masses(simulation: &Simulation) -> Vec<f64> {
    let mut positions = strip("cloth", DVec3::ZERO).mesh().positions.clone();
    { simulation.copied_vertices(0).iter() }.for_each(|&vertex| positions.push(positions[vertex as usize]));
    let triangles = simulation.triangles().to_vec();
    common::masses(&Mesh { positions, triangles }, 0.2)
}

fn sum(masses: &[f64], of: &[DVec3]) -> DVec3 {
    masses.iter().zip(of).map(|(mass, of)| *of * *mass).sum()
}

#[test]
fn a_tear_keeps_mass_momentum_and_the_centre_of_mass() {
    let mut scene = Scene::new(strip("cloth", DVec3::ZERO), 1e-3);
    // In steps of first order, the new velocity alone moves the positions.
    scene.accuracy = Accuracy::Game;
    scene.add(Stretch::isotropic(1000.0)).add(SelfCollision(Thickness::new(2e-4)));
    scene.add(Tearing::above(4.0)).add(Apart);
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let all: f64 = masses(&simulation).iter().sum();
    let mut expected = DVec3::ZERO;
    for _ in 0..60 {
        let (before, positions) = (masses(&simulation), simulation.positions().to_vec());
        let pulls: Vec<DVec3> = { positions.iter() }
            .map(|p| DVec3::new(if p.x > 0.05 { 1.0 } else { -0.5 }, 0.3, 0.1) * ACCELERATION * 1e-3)
            .collect();
        expected += sum(&before, &pulls);
        simulation.step().unwrap();
        let now = masses(&simulation);
        let momentum = sum(&now, simulation.velocities());
        assert!((now.iter().sum::<f64>() - all).abs() < 1e-15);
        assert!(
            momentum.distance(expected) < 1e-9 * expected.length(),
            "{} {momentum} {expected} {}",
            simulation.time(),
            simulation.torn_edges().len()
        );
        let moved = sum(&now, simulation.positions()) - sum(&before, &positions);
        assert!(moved.distance(momentum * 1e-3) < 1e-12);
    }
    assert!(simulation.torn_edges().len() >= 5, "{}", simulation.torn_edges().len());
}

#[test]
fn torn_cloth_is_the_same_bits_on_two_threads_and_resumed_from_a_checkpoint() {
    let fast = |text: String| text.replace("cells = [60, 40]", "cells = [30, 20]");
    let mut whole = load("tear.toml", fast, 2);
    advance(&mut whole, CHECKPOINT_STEPS);
    let mut torn = Vec::new();
    for _ in 0..3 {
        let checkpoint = whole.checkpoint().unwrap();
        let before = whole.torn_edges().len();
        let mut resumed = load("tear.toml", fast, 1);
        resumed.resume(&checkpoint).unwrap();
        assert_eq!(resumed.torn_edges(), whole.torn_edges());
        assert_eq!(
            (resumed.triangles(), resumed.positions()),
            (whole.triangles(), whole.positions())
        );
        advance(&mut whole, CHECKPOINT_STEPS);
        advance(&mut resumed, CHECKPOINT_STEPS);
        assert_eq!(resumed.positions(), whole.positions());
        assert_eq!(resumed.triangles(), whole.triangles());
        torn.push([before, whole.torn_edges().len()]);
        // A resume works from any state to any other.
        resumed.resume(&checkpoint).unwrap();
        assert_eq!(resumed.checkpoint(), Some(checkpoint));
    }
    // Some intervals start with torn cloth and tear more.
    assert!(torn.iter().any(|[before, after]| 0 < *before && before < after), "{torn:?}");
}

#[test]
fn a_checkpoint_of_torn_cloth_that_is_damaged_changes_nothing() {
    let scene = || pulled(Tearing::perforated(column(5), 60.0));
    let simulation = run(scene(), CHECKPOINT_STEPS);
    let checkpoint = simulation.checkpoint().unwrap();
    // The first triangle's first vertex follows the magic number, the version, the fingerprint, a byte that there are tears, the
    // number of cloths, the number of copies, the copies, and the number of triangles. Numbers below 128 take a byte each.
    let corner = 15 + 1 + 8 + 1 + 1 + 1 + simulation.copied_vertices(0).len() + 1;
    let mut damaged = checkpoint.clone();
    damaged[corner] ^= 1;
    let mut fresh = Simulation::new(scene(), 1).unwrap();
    assert_eq!(fresh.resume(&damaged), Err(CheckpointError::Damaged));
    assert_eq!((fresh.torn_edges().len(), fresh.positions().len()), (0, 66));
    fresh.resume(&checkpoint).unwrap();
    assert_eq!(fresh.positions(), simulation.positions());
}

/// The first of two cloths tears. Attachments and pins hold the second one by the scene's numbers.
#[test]
fn what_names_vertices_of_a_cloth_behind_one_that_tears_goes_on_holding_them() {
    let mut scene = pulled(Tearing::perforated(column(5), 60.0));
    let mut second = strip("second", DVec3::Z * 0.1);
    second.velocity = DVec3::Y;
    scene.cloths.push(second);
    let corners = [66, 66 + CELLS[0]];
    scene.add(Attachments {
        groups: vec![AttachmentGroup::resting(corners, 1000.0)],
    });
    let simulation = run(scene, 300);
    assert_eq!(simulation.torn_edges().len(), 5);
    let own = simulation.vertices_of_cloth(1).unwrap();
    assert_eq!(own, 72..138);
    for corner in [0, CELLS[0] as usize] {
        let made = strip("second", DVec3::Z * 0.1).mesh().positions[corner];
        assert!(simulation.positions()[own.start + corner].distance(made) < 1e-3);
    }
}

/// The caller moves anchors of the second cloth before and after the first one tears.
#[test]
fn soft_pins_go_on_pulling_a_cloth_behind_one_that_tears() {
    let mut scene = pulled(Tearing::perforated(column(5), 60.0));
    scene.cloths.push(strip("second", DVec3::Z * 0.1));
    let corners = [66, 66 + CELLS[0]];
    let mut pins = drawn();
    pins.groups.push(PinGroup {
        stiffness: Some(100.0),
        ..PinGroup::new(corners, PinMotion::Own(BodyMotion::Driven(Placement::default())))
    });
    scene.add(pins).add(AirDrag { rate: 20.0 });
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let start = corners.map(|corner| simulation.positions()[corner as usize]);
    let torn_after = (1..=600).fold(None, |torn, step| {
        let way = DVec3::Z * (1e-4 * f64::from(step.min(300)));
        simulation.move_pins(2, &start.map(|corner| corner + way)).unwrap();
        simulation.step().unwrap();
        torn.or((simulation.torn_edges().len() == 5).then_some(step))
    });
    assert!(torn_after.is_some_and(|step| step < 300), "{torn_after:?}");
    let own = simulation.vertices_of_cloth(1).unwrap();
    assert_eq!(own, 72..138);
    for (corner, start) in [0, CELLS[0] as usize].into_iter().zip(start) {
        let off = simulation.positions()[own.start + corner].distance(start + DVec3::Z * 0.03);
        assert!(off < 1e-4, "{off} m off");
    }
}

/// Makes a strip with a tassel of two edges at a vertex, whose ends are 66 and 67.
fn with_tassel(name: &str, at: DVec3, vertex: u32) -> Cloth {
    let mut mesh = strip(name, at).mesh().clone();
    let root = mesh.positions[vertex as usize];
    mesh.positions.extend([root - DVec3::Y * 0.01, root - DVec3::Y * 0.02]);
    let made = Cloth::from_mesh_with_loose_edges(mesh, &[[vertex, 66], [66, 67]], DVec3::X, [0.2, 0.001]);
    made.unwrap().named(name)
}

fn with_tassels() -> Scene {
    let mut scene = pulled(Tearing::perforated(column(5), 50.0));
    scene.cloths = vec![with_tassel("cloth", DVec3::ZERO, 5), with_tassel("second", DVec3::Z * 0.1, 3)];
    scene.add(RopeStretch::new(1000.0));
    scene
}

#[test]
fn torn_cloth_with_tassels_is_resumed_from_a_checkpoint() {
    assert_same_bits(with_tassels, CHECKPOINT_STEPS, 50);
}

#[test]
fn tassels_stay_with_the_vertices_that_keep_their_numbers() {
    let simulation = run(with_tassels(), 200);
    assert_eq!(simulation.torn_edges().len(), 5);
    let own = simulation.vertices_of_cloth(1).unwrap();
    assert_eq!(own, 74..142);
    assert_eq!(simulation.loose_edges(), [[5, 66], [66, 67], [77, 140], [140, 141]]);
    for &[from, to] in simulation.loose_edges() {
        let length = simulation.positions()[from as usize].distance(simulation.positions()[to as usize]);
        assert!((length - 0.01).abs() < 1e-4, "{length}");
    }
    assert!(simulation.is_certified());
}

#[test]
fn a_balloon_that_has_torn_holds_no_pressure_any_more() {
    let tetrahedron = {
        let corners = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(|c| DVec3::from(c) * 0.05);
        let faces = [[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]];
        refined(refined((corners.to_vec(), faces.to_vec())))
    };
    let (positions, triangles) = tetrahedron;
    let mesh = Mesh { positions, triangles };
    let scene = |strength| {
        let mut scene = Scene::new(Cloth::from_mesh(mesh.clone(), DVec3::X, 0.2).unwrap(), 1e-3);
        scene.add(Stretch::isotropic(500.0)).add(SelfCollision(Thickness::new(1e-3)));
        scene.add(InternalPressure::with_volume_ratio(2.0));
        scene.add(Tearing::above(strength));
        scene
    };
    let elastic = |simulation: &Simulation| {
        simulation
            .energy()
            .stored
            .iter()
            .any(|(name, _)| *name == "internal_pressure")
    };
    let whole = run(scene(1e4), 100);
    assert!(whole.torn_edges().is_empty() && elastic(&whole));
    let burst = run(scene(20.0), 100);
    assert!(!burst.torn_edges().is_empty() && !elastic(&burst) && burst.is_certified());
}

/// Splits each triangle in four.
fn refined((mut positions, triangles): (Vec<DVec3>, Vec<[u32; 3]>)) -> (Vec<DVec3>, Vec<[u32; 3]>) {
    let mut middles = std::collections::BTreeMap::new();
    let mut middle = |a: u32, b: u32| {
        *middles.entry([a.min(b), a.max(b)]).or_insert_with(|| {
            positions.push((positions[a as usize] + positions[b as usize]) / 2.0);
            positions.len() as u32 - 1
        })
    };
    let finer = triangles.iter().flat_map(|&[a, b, c]| {
        let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
        [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
    });
    let finer = finer.collect();
    (positions, finer)
}

/// Makes cloth of decimetre cells between a groove and a wedge, 27 µm from each. An opening of a thousandth of an edge would go
/// 50 µm into the walls. The cloth's ends are drawn up along the walls, and the groove moves away after 0.35 s.
fn in_a_groove() -> Scene {
    let cloth = Cloth::from_mesh(folded(2, 0..4, 0.0), DVec3::X, 0.2).unwrap();
    let mut scene = Scene::new(cloth, 1e-3);
    // Steps of first order damp the swings from the drawing, which make room now and then.
    scene.accuracy = Accuracy::Game;
    let away = along([(0.35, DVec3::ZERO), (0.4, DVec3::Z * -0.02)]);
    let gap = 27e-6 * std::f64::consts::SQRT_2;
    let mut groove = Body::from_mesh("groove", folded(3, -1..5, -gap));
    groove.motion = away;
    scene.bodies = vec![groove, Body::from_mesh("wedge", folded(3, -1..5, gap))];
    let drawn = |side: f64| PinMotion::Own(along([(0.0, DVec3::ZERO), (0.15, DVec3::new(side, 0.0, 1.0) * 0.002)]));
    let ends = [-1.0, 1.0].map(|side: f64| {
        PinGroup::new(
            (0..4).map(|row| 5 * row + if side < 0.0 { 0 } else { 4 }).collect::<Vec<_>>(),
            drawn(side),
        )
    });
    scene.add(Pins { groups: ends.to_vec() });
    scene.add(Stretch::isotropic(1000.0)).add(BodyContact(Thickness::new(50e-6)));
    scene.add(SelfCollision(Thickness::new(50e-6)));
    scene.add(Tearing::perforated([2, 7, 12, 17], 1.0));
    scene
}

#[test]
fn a_tear_that_has_no_room_to_open_waits_until_there_is() {
    let simulation = run(in_a_groove(), 400);
    let torn = simulation.torn_edges();
    assert_eq!(torn.len(), 3);
    assert!(torn.iter().all(|edge| edge.time > 0.35), "{torn:?}");
    assert!(simulation.is_certified());
}

#[test]
fn a_tear_that_waits_at_a_checkpoint_opens_in_the_same_step_when_resumed() {
    let simulation = assert_same_bits(in_a_groove, CHECKPOINT_STEPS, 200);
    assert!(!simulation.torn_edges().is_empty());
}

#[test]
fn wind_that_the_caller_has_set_blows_on_through_a_tear() {
    let mut simulation = set_up(include_str!("scenes/torn-by-wind.toml"), "torn-by-wind.toml", 1);
    simulation.set_wind(DVec3::new(0.0, 3.0, 25.0)).unwrap();
    advance(&mut simulation, 60);
    assert!(!simulation.torn_edges().is_empty());
    let torn = simulation.torn_edges().len();
    let free = simulation.positions().iter().map(|p| p.z).fold(0.0, f64::max);
    advance(&mut simulation, 40);
    let farther = simulation.positions().iter().map(|p| p.z).fold(0.0, f64::max);
    assert!(farther > free + 0.01, "{torn} torn, from {free} to {farther}");
}

#[test]
fn wrong_ways_to_tear_from_code_are_told() {
    assert_complaints! { pulled(Tearing::perforated(column(5), 50.0));
        |s| _ = s.add(Tearing::perforated([400, 401], 50.0))
            => "tearing: the scene has no vertex 400 of cloth: it has 66, numbered from 0";
        |s| _ = s.add(Tearing::above(f64::NAN)) => "tearing: `strength` is NaN N/m, but must be from 0.001 N/m to 1e9 N/m";
    }
}
