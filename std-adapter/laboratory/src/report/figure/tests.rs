use super::drawing::{BLUE, FRAME, GREEN};
use super::view::Room;
use super::*;
use crate::methods::Preset;
use crate::scene::ArmScene;
use proptest::prelude::*;
use tiny_skia::PremultipliedColorU8;

/// The rows above captions and legend.
const MESH_ROWS: u32 = 820;

fn decoded(png: &[u8]) -> Pixmap {
    Pixmap::decode_png(png).unwrap()
}

/// Counts the wanted pixels of a panel (0: left, 1: right), without captions and legend.
fn count(picture: &Pixmap, panel: u32, wanted: impl Fn([u8; 3]) -> bool) -> usize {
    let half = picture.width() / 2;
    (0..MESH_ROWS)
        .flat_map(|y| (0..half).map(move |x| (x + panel * half, y)))
        .filter_map(|(x, y)| picture.pixel(x, y))
        .filter(|&pixel: &PremultipliedColorU8| wanted([pixel.red(), pixel.green(), pixel.blue()]))
        .count()
}

fn is_yellow([red, green, blue]: [u8; 3]) -> bool {
    red > 180 && green > 130 && blue < 110
}

fn marks(picture: &Pixmap, panel: u32) -> [bool; 3] {
    [
        count(picture, panel, |pixel| pixel == BLUE) > 0,
        count(picture, panel, is_yellow) > 0,
        count(picture, panel, |pixel| pixel == GREEN) > 0,
    ]
}

fn candidates(vertex_face: &[[u32; 2]], edge_edge: &[[u32; 2]]) -> StepCandidates {
    StepCandidates {
        preset: Preset::Basic,
        vertex_face: vertex_face.to_vec(),
        edge_edge: edge_edge.to_vec(),
    }
}

fn arm() -> (Topology, Vec<DVec3>) {
    let scene = ArmScene::new(1).unwrap();
    (scene.topology().clone(), scene.positions(0.9))
}

#[test]
fn each_kind_of_pair_has_its_colours_in_its_panel_and_no_other() {
    let (topology, positions) = arm();
    let (vertex_face, edge_edge) = ([[300, 700], [320, 650]], [[900, 1000], [910, 1011]]);
    let cases = [
        (candidates(&[], &[]), [false, false, false]),
        (candidates(&vertex_face, &[]), [true, true, false]),
        (candidates(&[], &edge_edge), [false, false, true]),
        (candidates(&vertex_face, &edge_edge), [true, true, true]),
    ];
    // Each mark is drawn in each panel, beside two others.
    for (place, (left, in_left)) in cases.iter().enumerate() {
        for (right, in_right) in [&cases[(place + 1) % 4], &cases[(place + 2) % 4]] {
            let picture = decoded(&figure_3(&topology, &positions, [left, right]).unwrap());
            assert_eq!([picture.width(), picture.height()], FIGURE_SIZE);
            assert_eq!([marks(&picture, 0), marks(&picture, 1)], [*in_left, *in_right]);
        }
    }
}

#[test]
fn a_small_part_with_the_right_panels_marks_is_shown_close_up_in_both() {
    let (topology, positions) = arm();
    let draw = |right: &StepCandidates| {
        let everything: Vec<[u32; 2]> = (0..topology.triangles().len() as u32).map(|face| [face / 2, face]).collect();
        let picture = decoded(&figure_3(&topology, &positions, [&candidates(&everything, &[]), right]).unwrap());
        [0, 1].map(|panel| count(&picture, panel, |pixel| pixel == FRAME) > 0)
    };
    let corner = topology.triangles()[700][0];
    assert_eq!(draw(&candidates(&[[corner, 700]], &[])), [true, true]);
    assert_eq!(draw(&candidates(&[], &[])), [false, false]);
    assert_eq!(
        draw(&candidates(&[[0, 0], [692, 1344]], &[])),
        [false, false],
        "from end to end"
    );
}

#[test]
fn the_viewer_stands_on_the_side_to_which_the_arm_bends() {
    let scene = ArmScene::new(1).unwrap();
    for frame in [20, 40, 60] {
        let positions = scene.frame(frame);
        let view = View::new(scene.topology(), &positions, panel::OVERVIEW);
        let depth = |vertices: std::ops::Range<usize>| {
            let count = vertices.len() as f32;
            vertices.map(|vertex| view.see(positions[vertex]).depth).sum::<f32>() / count
        };
        let (shoulder, elbow, cuff) = (depth(0..25), depth(330..360), depth(677..693));
        assert!(elbow < 0.5 * (shoulder + cuff), "frame {frame}");
    }
}

/// Generates coordinates of any size, many of them equal.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(1.0),
        -1.0..1.0,
        Just(f64::MAX),
        Just(f64::MIN),
        Just(5e-324),
        Just(1e-310),
        proptest::num::f64::NORMAL,
    ]
}

fn positions() -> impl Strategy<Value = Vec<DVec3>> {
    let position = || prop::array::uniform3(coordinate()).prop_map(DVec3::from);
    prop_oneof![
        prop::collection::vec(position(), 6),
        position().prop_map(|position| vec![position; 6]),
    ]
}

fn soup() -> Topology {
    Topology::new(6, vec![[0, 1, 2], [2, 1, 3], [3, 3, 4], [4, 4, 4], [2, 1, 0]]).unwrap()
}

proptest! {
    #[test]
    fn every_mesh_fits_into_its_room(positions in positions()) {
        let view = View::new(&soup(), &positions, panel::OVERVIEW);
        let Room { left, top, width, height } = panel::OVERVIEW;
        for &position in &positions {
            let seen = view.see(position);
            prop_assert!((left - 0.1..=left + width + 0.1).contains(&seen.x), "{seen:?}");
            prop_assert!((top - 0.1..=top + height + 0.1).contains(&seen.y), "{seen:?}");
            prop_assert!(seen.depth.is_finite());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(8))]

    #[test]
    fn degenerate_meshes_are_drawn_the_same_each_time(positions in positions()) {
        let topology = soup();
        let (left, right) = (candidates(&[[5, 3], [0, 2]], &[[0, 4]]), candidates(&[[5, 3]], &[]));
        let picture = figure_3(&topology, &positions, [&left, &right]).unwrap();
        prop_assert_eq!(marks(&decoded(&picture), 0)[0], true);
        prop_assert_eq!(picture, figure_3(&topology, &positions, [&left, &right]).unwrap());
    }
}
