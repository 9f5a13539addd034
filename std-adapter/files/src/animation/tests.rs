//! Tests of the reader of figures.

use super::figure::{Local, Node, Part, Shape, Skin};
use super::track::{AnimatedProperty, Interpolation, Track};
use super::*;
use base64::Engine;
use proptest::prelude::*;
use selvedge_core::glam::{DAffine3, DQuat, DVec3};
use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};

/// A strip of two triangles. The upper two vertices follow the upper of two joints. It lies a metre up and turns by a quarter
/// about z in the second from 1 to 2. The joint itself moves along x. One morph target lifts vertex 0 along z.
const NUMBERS: [(&str, &[f32]); 9] = [
    ("positions", &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 1.0, 2.0, 0.0]),
    (
        "weights",
        &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.5, 0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0],
    ),
    (
        "inverses",
        &[
            1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, //
            1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -1.0, 0.0, 1.0,
        ],
    ),
    ("times", &[1.0, 2.0]),
    (
        "turns",
        &[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, FRAC_1_SQRT_2 as f32, FRAC_1_SQRT_2 as f32],
    ),
    ("target", &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]),
    ("lifts", &[0.0, 1.0]),
    ("indices", &[]),
    ("joints", &[]),
];
const JOINTS: [u8; 16] = [0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0];
const INDICES: [u16; 6] = [0, 1, 2, 1, 3, 2];

/// Returns the file's JSON, which contains its one buffer.
fn text() -> String {
    let mut bytes: Vec<u8> = Vec::new();
    let mut views = Vec::new();
    for (what, numbers) in NUMBERS {
        let begin = bytes.len();
        match what {
            "indices" => {
                bytes.extend(INDICES.iter().flat_map(|index| index.to_le_bytes()));
                // The next view begins at a multiple of four.
                views.push(format!(r#"{{"buffer":0,"byteOffset":{begin},"byteLength":12}}"#));
                continue;
            }
            "joints" => bytes.extend(JOINTS),
            _ => bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes())),
        }
        views.push(format!(
            r#"{{"buffer":0,"byteOffset":{begin},"byteLength":{}}}"#,
            bytes.len() - begin
        ));
    }
    let data = base64::engine::general_purpose::STANDARD.encode(&bytes);
    let accessor = |view: usize, component: u32, kind: &str, count: usize| {
        let bounds = if view == 0 { r#","min":[0,0,0],"max":[1,2,0]"# } else { "" };
        format!(r#"{{"bufferView":{view},"componentType":{component},"type":"{kind}","count":{count}{bounds}}}"#)
    };
    let accessors = [
        accessor(0, 5126, "VEC3", 4),
        accessor(1, 5126, "VEC4", 4),
        accessor(2, 5126, "MAT4", 2),
        accessor(3, 5126, "SCALAR", 2),
        accessor(4, 5126, "VEC4", 2),
        accessor(5, 5126, "VEC3", 4),
        accessor(6, 5126, "SCALAR", 2),
        accessor(7, 5123, "SCALAR", 6),
        accessor(8, 5121, "VEC4", 4),
    ];
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0,2]}}],
"nodes":[{{"name":"root","children":[1]}},{{"name":"upper","translation":[0,1,0]}},{{"name":"strip","mesh":0,"skin":0}}],
"meshes":[{{"name":"ribbon","primitives":[{{"attributes":{{"POSITION":0,"JOINTS_0":8,"WEIGHTS_0":1}},"indices":7,"targets":[{{"POSITION":5}}]}}]}}],
"skins":[{{"joints":[0,1],"inverseBindMatrices":2}}],
"animations":[{{"name":"bend","samplers":[{{"input":3,"output":4}},{{"input":3,"output":6}}],
"channels":[{{"sampler":0,"target":{{"node":1,"path":"rotation"}}}},{{"sampler":1,"target":{{"node":2,"path":"weights"}}}}]}}],
"accessors":[{}],"bufferViews":[{}],"buffers":[{{"byteLength":{},"uri":"data:application/octet-stream;base64,{data}"}}]}}"#,
        accessors.join(","),
        views.join(","),
        bytes.len()
    )
}

fn read_text(text: &str, choice: &Choice<'_>) -> Result<Figure, AnimationError> {
    read_bytes(text.as_bytes(), Path::new("strip.gltf"), choice)
}

fn at(figure: &Figure, time: f64) -> Vec<DVec3> {
    let mut positions = Vec::new();
    figure.positions_at(time, &mut positions);
    positions
}

#[track_caller]
fn assert_near(found: &[DVec3], expected: &[[f64; 3]]) {
    assert_eq!(found.len(), expected.len());
    for (found, &expected) in found.iter().zip(expected) {
        assert!(found.distance(expected.into()) < 1e-6, "{found} is not {expected:?}");
    }
}

#[test]
fn vertices_go_with_their_joints_and_their_morph_targets_and_rest_before_and_after_the_keys() {
    let figure = read_text(&text(), &Choice::default()).unwrap();
    assert_eq!((figure.span(), figure.key_times()), ([1.0, 2.0], vec![1.0, 2.0]));
    assert_eq!(figure.mesh().triangles, [[0, 1, 2], [1, 3, 2]]);
    let rest = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 2.0, 0.0]];
    assert_near(&at(&figure, 1.0), &rest);
    assert_eq!(at(&figure, 0.0), at(&figure, 1.0));
    assert_eq!(figure.mesh().positions, at(&figure, 1.0));
    // A quarter turn about (0, 1) takes (1, 2) to (-1, 2). (0, 2), which follows it by half, goes halfway to (-1, 1).
    assert_near(
        &at(&figure, 2.0),
        &[[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [-0.5, 1.5, 0.0], [-1.0, 2.0, 0.0]],
    );
    assert_eq!(at(&figure, 9.0), at(&figure, 2.0));
    // The vertex is halfway along the arc, not along the chord.
    let half = FRAC_1_SQRT_2 * (1.0 - 1.0);
    assert_near(&at(&figure, 1.5)[3..], &[[half, 1.0 + 2.0 * FRAC_1_SQRT_2, 0.0]]);
    assert_near(&at(&figure, 1.5)[..1], &[[0.0, 0.0, 0.5]]);
}

#[test]
fn a_figure_is_chosen_by_the_name_of_its_node_or_its_mesh() {
    let text = text();
    let choose = |node, animation| {
        let choice = Choice {
            node,
            animation,
            at_rest: false,
        };
        read_text(&text, &choice).map(|figure| figure.fingerprint())
    };
    let only = choose(None, None).unwrap();
    assert_eq!(choose(Some("strip"), Some("bend")).unwrap(), only);
    assert_eq!(choose(Some("ribbon"), None).unwrap(), only);
    let message = choose(Some("strap"), None).unwrap_err().to_string();
    assert_eq!(message, "strip.gltf: no node 'strap' has a mesh; those that have: 'strip'");
    let message = choose(None, Some("wave")).unwrap_err().to_string();
    assert_eq!(message, "strip.gltf: there is no animation 'wave'; choose from 'bend'");
}

/// Checks the message for the file with one passage replaced.
#[track_caller]
fn message(passage: &str, by: &str) -> String {
    let good = text();
    assert!(good.contains(passage), "'{passage}' must be there");
    read_text(&good.replacen(passage, by, 1), &Choice::default())
        .unwrap_err()
        .to_string()
}

#[test]
fn files_that_are_wrong_or_lie_are_refused_with_the_place_named() {
    let rows = include_str!("../../tests/wrong-figures.txt").lines();
    for row in rows.filter(|row| !row.starts_with('#')) {
        let [passage, by, expected] = row.split(" | ").collect::<Vec<_>>().try_into().expect(row);
        let found = message(passage, by);
        assert!(
            found.starts_with(&format!("strip.gltf: {expected}")),
            "{found}\nis not\n{expected}"
        );
    }
}

#[test]
fn a_figure_without_an_animation_of_its_own_rests() {
    let text = text();
    let between = |from: &str, to: &str, by: &str| {
        let begin = text.find(from).unwrap();
        let end = begin + text[begin..].find(to).unwrap();
        [&text[..begin], by, &text[end..]].concat()
    };
    let moving = read_text(&text, &Choice::default()).unwrap();
    for still in [
        between(r#""animations""#, r#""accessors""#, ""),
        between(r#""channels":["#, r#"}],"#, r#""channels":["#).replacen(r#""channels":[}],"#, r#""channels":[]}],"#, 1),
    ] {
        let figure = read_text(&still, &Choice::default()).unwrap();
        assert_eq!((figure.span(), figure.key_times()), ([0.0; 2], vec![0.0]));
        assert_eq!(figure.mesh(), moving.mesh());
    }
    let choice = Choice {
        at_rest: true,
        ..Choice::default()
    };
    assert_eq!(read_text(&text, &choice).unwrap().span(), [0.0; 2]);
    let file = crate::mesh::read_bytes(text.as_bytes(), crate::mesh::FileFormat::Gltf).unwrap();
    assert_eq!(&file.mesh, moving.mesh());
}

#[test]
fn looks_and_other_channels_are_ignored_even_where_they_are_required() {
    let text = text();
    let plain = read_text(&text, &Choice::default()).unwrap();
    for (passage, by) in [
        (
            r#"{"asset""#,
            r#"{"extensionsRequired":["KHR_materials_unlit","KHR_texture_transform","KHR_lights_punctual","KHR_mesh_quantization"],"asset""#,
        ),
        (
            r#"{"asset""#,
            r#"{"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":77}}}],"images":[{"uri":7}],"asset""#,
        ),
        (
            r#"{"POSITION":0"#,
            r#"{"TEXCOORD_0":55,"COLOR_9":1,"Custom":3,"_OWN":2,"NORMAL":44,"POSITION":0"#,
        ),
        (r#""targets":[{"#, r#""material":9,"targets":[{"NORMAL":66,"#),
        (
            r#""channels":["#,
            r#""channels":[{"sampler":1,"target":{"path":"pointer","extensions":{"KHR_animation_pointer":{"pointer":"/materials/0"}}}},"#,
        ),
        (r#","min":[0,0,0],"max":[1,2,0]"#, ""),
        (
            r#""name":"root","#,
            r#""name":"root","camera":8,"extensions":{"KHR_lights_punctual":{"light":3}},"#,
        ),
        (
            r#""targets":[{"POSITION":5}]}"#,
            r#""targets":[{"POSITION":5}]},{"attributes":{"POSITION":0},"mode":0}"#,
        ),
    ] {
        assert!(text.contains(passage), "{passage}");
        let figure = read_text(&text.replacen(passage, by, 1), &Choice::default()).unwrap();
        assert_eq!((at(&figure, 1.7), figure.mesh()), (at(&plain, 1.7), plain.mesh()), "{by}");
        let said: Vec<String> = figure.left_out().iter().map(ToString::to_string).collect();
        match by {
            by if by.contains("pointer") => assert_eq!(said, ["1 channel 'of something other than nodes'"]),
            by if by.contains("mode") => assert_eq!(said, ["1 primitive 'Points'"]),
            _ => assert!(said.is_empty(), "{said:?}"),
        }
    }
}

#[test]
fn strips_fans_and_accessors_without_bytes_are_read() {
    let text = text();
    let triangles = |by: &str| {
        let figure = read_text(&text.replacen(r#""indices":7"#, by, 1), &Choice::default()).unwrap();
        figure.mesh().triangles.clone()
    };
    // The indices are 0 1 2 1 3 2.
    assert_eq!(triangles(r#""mode":5"#), [[0, 1, 2], [2, 1, 3]]);
    assert_eq!(triangles(r#""mode":6"#), [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(triangles(r#""indices":7,"mode":5"#), [[0, 1, 2], [2, 1, 3], [3, 1, 2]]);
    let sparse = r#""sparse":{"count":1,"indices":{"bufferView":8,"componentType":5121},"values":{"bufferView":0}}"#;
    let replaced = text.replacen(
        r#"{"bufferView":0,"componentType":5126,"type":"VEC3","count":4"#,
        &format!(r#"{{{sparse},"componentType":5126,"type":"VEC3","count":4"#),
        1,
    );
    let figure = read_text(
        &replaced,
        &Choice {
            at_rest: true,
            ..Choice::default()
        },
    )
    .unwrap();
    assert_near(&figure.mesh().positions, &[[0.0; 3]; 4]);
}

/// Two nodes with the strip's mesh, one below the other.
#[test]
fn all_nodes_of_the_scene_are_one_figure_and_one_is_chosen_by_its_path() {
    let text = text();
    let two = text.replacen(r#"{"name":"upper","#, r#"{"name":"upper","children":[3],"#, 1);
    let two = two.replacen(
        r#""skin":0}]"#,
        r#""skin":0},{"name":"strip","mesh":0,"translation":[5,0,0]},{"name":"unseen","mesh":0}]"#,
        1,
    );
    let all = read_text(&two, &Choice::default()).unwrap();
    assert_eq!(
        (all.mesh().positions.len(), all.mesh().triangles[2..].to_vec()),
        (8, vec![[4, 5, 6], [5, 7, 6]])
    );
    let choose = |node| {
        let choice = Choice {
            node: Some(node),
            ..Choice::default()
        };
        read_text(&two, &choice)
    };
    assert_eq!(
        choose("root/upper/strip").unwrap().mesh().positions,
        all.mesh().positions[4..]
    );
    assert_eq!(choose("unseen").unwrap().mesh().positions.len(), 4);
    let message = choose("strip").unwrap_err().to_string();
    assert_eq!(
        message,
        "strip.gltf: 2 nodes of this name have a mesh; name one by its path: 'strip', 'root/upper/strip'"
    );
    // The lower node turns with the joint, and its vertices are scaled last.
    assert_near(
        &at(&all.clone().transformed(DAffine3::from_scale(DVec3::splat(2.0))), 2.0)[4..5],
        &[[0.0, 12.0, 0.0]],
    );
}

/// One animation moves the joint from 1 to 2 s and the weights from 0 to 1 s, which another figure would not have.
#[test]
fn all_nodes_of_an_animation_share_its_clock() {
    let text = text();
    // Only rotations remain, from 1 s on. The times of weights are the weights: 0 and 1.
    let shifted = text.replacen(r#"{"input":3,"output":6}"#, r#"{"input":6,"output":6}"#, 1);
    let figure = read_text(&shifted, &Choice::default()).unwrap();
    assert_eq!((figure.span(), figure.key_times()), ([0.0, 2.0], vec![0.0, 1.0, 2.0]));
    let without_weights = shifted.replacen(r#""targets":[{"POSITION":5}]"#, r#""targets":[]"#, 1);
    let figure = read_text(&without_weights, &Choice::default()).unwrap();
    assert_eq!((figure.span(), figure.key_times()), ([0.0, 2.0], vec![0.0, 1.0, 2.0]));
}

#[test]
fn numbers_that_are_not_finite_or_out_of_range_are_refused() {
    let good = text();
    let begin = good.find("base64,").unwrap() + 7;
    let end = begin + good[begin..].find('"').unwrap();
    let engine = &base64::engine::general_purpose::STANDARD;
    let bytes = engine.decode(&good[begin..end]).unwrap();
    let changed = |offset: usize, by: &[u8]| {
        let mut changed = bytes.clone();
        changed[offset..offset + by.len()].copy_from_slice(by);
        let text = [&good[..begin], &engine.encode(&changed), &good[end..]].concat();
        read_text(&text, &Choice::default())
    };
    let message = |offset: usize, by: &[u8]| changed(offset, by).unwrap_err().to_string();
    let nan = f32::NAN.to_le_bytes();
    let offset = |index: usize| NUMBERS[..index].iter().map(|(_, numbers)| 4 * numbers.len()).sum::<usize>();
    assert!(message(offset(0), &nan).ends_with("primitive 0 of the mesh, positions: number 0 is NaN, but must be finite"));
    assert!(message(offset(1), &nan).contains("WEIGHTS_0: number 0 is NaN"));
    assert!(message(offset(1), &(-1.0_f32).to_le_bytes()).contains("vertex 0 has the weight -1"));
    assert!(message(offset(3) + 4, &1.0_f32.to_le_bytes()).contains("each later than the one before"));
    assert!(message(offset(4) + 12, &[0; 4]).contains("the rotation of key 0 is zero"));
    assert!(message(offset(7), &9_u16.to_le_bytes()).contains("face 0 names vertex 9, but there are 4 vertices"));
    assert!(message(offset(7) + 12, &[7; 4]).contains("vertex 0 follows joint 7, but the skin has 2"));
    let figure = changed(offset(1), &0.0_f32.to_le_bytes()).unwrap();
    let left_out: Vec<String> = figure.left_out().iter().map(ToString::to_string).collect();
    assert_eq!(left_out, ["1 vertex 'of weight zero, which follow joint 0'"]);
    // The vertex follows that joint in the unchanged file as well.
    assert_eq!(at(&figure, 1.5), at(&read_text(&good, &Choice::default()).unwrap(), 1.5));
}

#[test]
fn binary_files_that_are_cut_short_or_say_another_length_are_refused() {
    let json = text();
    let json = format!("{json}{}", " ".repeat(json.len().next_multiple_of(4) - json.len()));
    let file = |length: u32| {
        let mut bytes = b"glTF".to_vec();
        for number in [2, length, json.len() as u32] {
            bytes.extend(number.to_le_bytes());
        }
        bytes.extend(b"JSON");
        bytes.extend(json.as_bytes());
        bytes
    };
    let length = 20 + json.len() as u32;
    let read = |bytes: &[u8]| read_bytes(bytes, Path::new("strip.glb"), &Choice::default());
    assert_eq!(read(&file(length)).unwrap().mesh().positions.len(), 4);
    for wrong in [0, 3, 11, length + 1, u32::MAX] {
        let message = read(&file(wrong)).unwrap_err().to_string();
        assert!(message.contains("its header says that it has"), "{message}");
    }
    let whole = file(length);
    for cut in (0..whole.len()).step_by(7) {
        assert!(read(&whole[..cut]).is_err(), "{cut}");
    }
    assert_eq!(read(&[]).unwrap_err().to_string(), "strip.glb: the file is empty");
    let error = super::read(Path::new("no/such.glb"), &Choice::default()).unwrap_err();
    assert_eq!(error.to_string(), "no/such.glb: there is no such file");
}

/// Makes a joint that turns about z.
fn turning(interpolation: Interpolation, values: Vec<f64>) -> Figure {
    let shape = Shape {
        nodes: vec![Node {
            parent: None,
            local: Local::Parts {
                translation: DVec3::ZERO,
                rotation: DQuat::IDENTITY,
                scale: DVec3::ONE,
            },
        }],
        tracks: vec![Track {
            node: 0,
            property: AnimatedProperty::Rotation,
            interpolation,
            times: vec![0.0, 1.0],
            values,
            width: 4,
        }],
        parts: vec![Part {
            rest: vec![DVec3::X],
            targets: Vec::new(),
            node: 0,
            skin: Some(Skin {
                joints: vec![(0, DAffine3::IDENTITY)],
                ends: vec![1],
                influences: vec![(0, 1.0)],
            }),
        }],
        span: [0.0, 1.0],
        placement: DAffine3::IDENTITY,
    };
    Figure {
        mesh: Default::default(),
        shape,
        left_out: Vec::new(),
        fingerprint: 0,
    }
}

#[test]
fn rotations_take_the_shorter_arc_evenly_and_steps_jump_at_the_key() {
    let half = |angle: f64| [0.0, 0.0, (0.5 * angle).sin(), (0.5 * angle).cos()];
    let both = |other: [f64; 4]| [half(0.0), other].concat();
    let quarter = half(FRAC_PI_2);
    for to in [quarter, quarter.map(|number| -number)] {
        let figure = turning(Interpolation::Linear, both(to));
        for share in [0.0, 0.25, 0.5, 0.9, 1.0] {
            let angle = share * FRAC_PI_2;
            assert!(at(&figure, share)[0].distance(DVec3::new(angle.cos(), angle.sin(), 0.0)) < 1e-12);
        }
        assert!(!figure.has_steps());
    }
    let figure = turning(Interpolation::Step, both(quarter));
    assert!(figure.has_steps());
    assert_eq!(at(&figure, 0.999), at(&figure, 0.0));
    assert!(at(&figure, 1.0)[0].distance(DVec3::Y) < 1e-12);
    // The tangents are zero, so it starts and ends slowly.
    let zero = [0.0; 4];
    let figure = turning(Interpolation::Cubic, [zero, half(0.0), zero, zero, quarter, zero].concat());
    let turn = |time: f64| at(&figure, time)[0].y;
    assert!(turn(0.0).abs() < 1e-12 && (turn(1.0) - 1.0).abs() < 1e-12);
    assert!(turn(0.1) < 0.1 && (turn(0.5) - FRAC_1_SQRT_2).abs() < 1e-12);
    // The curve goes through zero. It may give any rotation, but must give one.
    let figure = turning(
        Interpolation::Cubic,
        [zero, half(0.0), zero, zero, half(0.0).map(|x| -x), zero].concat(),
    );
    assert!(at(&figure, 0.5)[0].is_finite());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// No change of a file's bytes causes a panic.
    #[test]
    fn no_bytes_make_the_reader_panic(changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = text().into_bytes();
        for (place, byte) in changes {
            let place = place.index(bytes.len());
            bytes[place] = byte;
        }
        if let Ok(figure) = read_bytes(&bytes, Path::new("strip.gltf"), &Choice::default()) {
            prop_assert_eq!(at(&figure, 1.5).len(), figure.mesh().positions.len());
        }
    }

    /// No replaced number in the JSON half causes a panic.
    #[test]
    fn no_numbers_make_the_reader_panic(which in any::<prop::sample::Index>(), by in prop_oneof![Just(u64::MAX), Just(u64::from(u32::MAX)), 0..20_u64]) {
        let text = text();
        let end = text.find("base64").unwrap();
        let digits: Vec<usize> = (1..end).filter(|&k| text.as_bytes()[k].is_ascii_digit() && b":[,".contains(&text.as_bytes()[k - 1])).collect();
        let begin = digits[which.index(digits.len())];
        let length = text[begin..].bytes().take_while(u8::is_ascii_digit).count();
        let changed = [&text[..begin], &by.to_string(), &text[begin + length..]].concat();
        let _ = read_text(&changed, &Choice::default());
    }
}
