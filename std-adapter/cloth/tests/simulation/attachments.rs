//! Attachments hold with a limited force, and report releases.

use crate::common::*;

/// A sheet of 20 cm and 200 g/m², upright: it weighs 78.48 mN.
fn sheet() -> Cloth {
    Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.2, DVec3::Z * 0.2], [6, 6], 0.2).unwrap()
}

const WEIGHT: f64 = 0.2 * 0.2 * 0.2 * 9.81;
const CORNERS: [u32; 2] = [42, 48];

fn hung(groups: Vec<AttachmentGroup>) -> Scene {
    let mut scene = Scene::new(sheet(), 1e-3);
    scene.add(Gravity::default()).add(Stretch::isotropic(500.0));
    scene.add(Shear::new(100.0)).add(AirDrag { rate: 5.0 });
    scene.add(Attachments { groups });
    scene
}

/// At rest each of two attachments holds half the weight. A spring that yields by a millimetre at twice the weight then yields by
/// a quarter of one, downwards. The same holds on fine meshes, where a vertex weighs little.
#[test]
fn each_holds_its_share_of_the_weight() {
    for (cells, longest) in [(6, 1.02), (24, 1.1)] {
        let sheet = Cloth::sheet(DVec3::ZERO, [DVec3::X * 0.2, DVec3::Z * 0.2], [cells, cells], 0.2).unwrap();
        let rest = sheet.mesh().positions.clone();
        let corners = ["top-left", "top-right"].map(|corner| sheet.part(corner).unwrap()[0]);
        let mut scene = hung(vec![AttachmentGroup::resting(corners, 2.0 * WEIGHT)]);
        scene.cloths = vec![sheet];
        let hanging = run(scene, 4000);
        assert_eq!(hanging.released(), []);
        let given = corners.map(|v| rest[v as usize] - hanging.positions()[v as usize]);
        for given in given {
            assert!((given.z / 0.25e-3 - 1.0).abs() < 0.01, "{cells} cells: {given}");
        }
        let stretch = hanging.edge_stretch().largest;
        assert!(stretch < longest, "{cells} cells: {stretch}");
        let stored = hanging.energy().stored;
        let held = stored.iter().find(|(name, _)| *name == "attachments").unwrap();
        let expected: f64 = given.iter().map(|d| 0.5 * 2.0 * WEIGHT / 1e-3 * d.length_squared()).sum();
        assert!((held.1.joules() / expected - 1.0).abs() < 1e-9, "{held:?}, not {expected}");
    }
}

/// Each vertex is released by itself and for good.
#[test]
fn what_pulls_more_than_the_limit_comes_loose_and_falls() {
    let [weak, strong] = [(CORNERS[0], 0.2), (CORNERS[1], 5.0)];
    let group = |(corner, share): (u32, f64)| AttachmentGroup::resting([corner], share * WEIGHT);
    let one = run(hung(vec![group(strong), group(weak)]), 1000);
    let released = one.released();
    assert_eq!(released.len(), 1);
    let Release { group: of, vertex, time } = released[0];
    assert_eq!((of, vertex), (1, weak.0));
    assert!((0.0..0.2).contains(&time), "{time}");
    let height = |vertex: u32| one.positions()[vertex as usize].z - sheet().mesh().positions[vertex as usize].z;
    assert!(height(weak.0) < -0.1 && height(strong.0) > -1e-3);

    let mut both = run(hung(vec![AttachmentGroup::resting(CORNERS, 0.2 * WEIGHT)]), 1000);
    assert_eq!(both.released().len(), 2);
    let before = both.velocities()[0].z;
    advance(&mut both, 100);
    assert!(both.velocities()[0].z < before, "it falls ever faster");
}

/// Attachments follow a body that rises, one that the caller drives, and one that deforms.
#[test]
fn attachments_follow_bodies_however_they_move() {
    let rigid = |at: DVec3, motion: BodyMotion| {
        let mut body = Body::ball("ball", at, 0.05, 24).unwrap();
        body.motion = motion;
        body
    };
    let at = sheet().mesh().positions[CORNERS[0] as usize] - DVec3::X * 0.06;
    let keyed = along([(0.0, DVec3::ZERO), (1.0, DVec3::Z * 0.1)]);
    let mesh = rigid(at, KeyframeMotion::resting().into()).mesh;
    let frame = |height: f64| mesh.positions.iter().map(|p| *p + DVec3::Z * height).collect::<Vec<_>>();
    let frames = Animation::from_frames(vec![frame(0.0), frame(0.1)], 1.0).unwrap();
    let bodies = [
        rigid(at, keyed),
        rigid(at, BodyMotion::Driven(Placement::default())),
        Body::animated("ball", mesh.triangles.clone(), frames),
    ];
    for (index, body) in bodies.into_iter().enumerate() {
        let mut group = AttachmentGroup::resting([CORNERS[0]], 50.0 * WEIGHT);
        group.motion = PinMotion::Body(0);
        let mut scene = hung(vec![group]);
        scene.bodies.push(body);
        scene.add(BodyContact(Thickness::new(2e-3)));
        let mut simulation = Simulation::new(scene, 1).unwrap();
        for step in 1..=1000 {
            if index == 1 {
                simulation
                    .place_body(0, Placement::at(DVec3::Z * (1e-4 * f64::from(step))))
                    .unwrap();
            }
            simulation.step().unwrap();
        }
        assert_eq!(simulation.released(), [], "body {index}");
        let expected = sheet().mesh().positions[CORNERS[0] as usize] + DVec3::Z * 0.1;
        let found = simulation.positions()[CORNERS[0] as usize];
        assert!(found.distance(expected) < 1e-3, "body {index}: {found}, not {expected}");
    }
}

const FILE: &str = include_str!("scenes/attachments.toml");

fn of_file() -> Scene {
    Scene::parse(FILE, Path::new("s.toml")).unwrap()
}

#[test]
fn attachments_from_a_file_and_from_code_are_the_same_to_the_last_bit() {
    let mut resting = AttachmentGroup::resting([CORNERS[0]], 0.5);
    resting.give = 2e-3;
    let mut moved = AttachmentGroup::resting([CORNERS[1]], 0.1);
    // A file's keyframes are linear unless it says more.
    let key = |time: f64, translation: DVec3| Keyframe {
        time,
        translation,
        ..Keyframe::default()
    };
    let keys = vec![key(0.1, DVec3::ZERO), key(0.5, DVec3::new(0.2, 0.0, 0.1))];
    moved.motion = PinMotion::Own(KeyframeMotion::new(DVec3::ZERO, DVec3::Z, keys).unwrap().into());
    let of_code = run(hung(vec![resting, moved]), 600);
    let of_file = run(of_file(), 600);
    assert_eq!(of_file.positions(), of_code.positions());
    assert_eq!(of_file.released(), of_code.released());
    assert_eq!(of_file.released().len(), 1, "the one that is pulled away");
}

/// A released vertex stays free.
#[test]
fn a_resumed_simulation_knows_what_has_let_go() {
    let before = 2 * CHECKPOINT_STEPS;
    let simulation = assert_same_bits(of_file, before, 150);
    assert!(
        simulation.released()[0].time < 1e-3 * before as f64,
        "{:?}",
        simulation.released()
    );
}

#[test]
fn attachments_of_nothing_are_an_error() {
    assert_complaints! { hung(Vec::new());
        |_| () => "attachments: attachments need at least one [[effects.attachments.group]]";
    }
}
