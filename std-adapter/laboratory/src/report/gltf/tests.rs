use super::*;
use crate::report::{About, Recorder};
use ::gltf::animation::util::ReadOutputs;

const CLOTH_AND_BALL: usize = 2;

/// Records `frames` frames of a triangle that falls and turns over a body that stays.
fn recording(frames: u64, up: DVec3) -> Recording {
    let about = About::test("fall", up, 0.02);
    let parts = vec![
        RecordedPart::new("cloth", PartKind::Cloth, 3, vec![[0, 1, 2]]),
        RecordedPart::new("nothing", PartKind::Body, 1, vec![]),
        RecordedPart::new("ball", PartKind::Body, 4, vec![[0, 1, 2], [2, 1, 3]]),
    ];
    let mut recorder = Recorder::new(about, parts, &[], &[]);
    for frame in 0..frames {
        let t = frame as f64 * 0.1;
        let turned = |x: f64, y: f64| DVec3::new(x * t.cos(), y, x * t.sin() - t + 0.1);
        let mut positions = vec![turned(-1.0, 0.3), turned(1.0, 0.3), turned(0.0, -1.0)];
        positions.push(DVec3::ZERO);
        positions.extend([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE].map(|p| p - DVec3::Z * 9.0));
        recorder.frame(10 + 5 * frame, &positions).unwrap();
    }
    recorder.finish(None)
}

/// Parses and validates the file, as a program that opens it would.
fn read_back(recording: &Recording) -> (::gltf::Document, Vec<u8>) {
    let ::gltf::Gltf { document, blob } = ::gltf::Gltf::from_slice(&binary(recording).unwrap()).expect("valid glTF");
    (document, blob.unwrap_or_default())
}

#[test]
fn every_frame_reads_back_as_the_shape_with_one_target_at_its_time() {
    let recording = recording(7, DVec3::Z);
    let (document, blob) = read_back(&recording);
    let mut meshes = document.meshes();
    assert_eq!(meshes.len(), CLOTH_AND_BALL);
    let cloth = meshes.next().unwrap().primitives().next().unwrap();
    let reader = cloth.reader(|_| Some(&blob[..]));
    let rest: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
    assert_eq!(rest, recording.frames[0].positions[..3]);
    let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
    assert_eq!(indices, [0, 1, 2]);

    let animation = document.animations().next().unwrap();
    assert_eq!(animation.channels().count(), 1, "the ball stays");
    let channel = animation.channels().next().unwrap();
    assert_eq!(channel.target().node().name(), Some("cloth"));
    let reader_of_animation = channel.reader(|_| Some(&blob[..]));
    let times: Vec<f32> = reader_of_animation.read_inputs().unwrap().collect();
    let ReadOutputs::MorphTargetWeights(weights) = reader_of_animation.read_outputs().unwrap() else {
        panic!("weights are animated");
    };
    let weights: Vec<f32> = weights.into_f32().collect();
    let targets: Vec<Vec<[f32; 3]>> = reader
        .read_morph_targets()
        .map(|(positions, ..)| positions.unwrap().collect())
        .collect();
    assert_eq!((times.len(), targets.len(), weights.len()), (7, 6, 42));
    for (k, frame) in recording.frames.iter().enumerate() {
        // Steps take 0.02 s, and five make a frame.
        assert!((f64::from(times[k]) - 0.1 * k as f64).abs() < 1e-6);
        let weights = &weights[6 * k..6 * (k + 1)];
        for (vertex, &expected) in frame.positions[..3].iter().enumerate() {
            for axis in 0..3 {
                let moved = targets
                    .iter()
                    .zip(weights)
                    .map(|(target, weight)| weight * target[vertex][axis]);
                let found = rest[vertex][axis] + moved.sum::<f32>();
                // The position is a difference and a sum, each rounded once; nothing here is larger than 2.
                assert!((found - expected[axis]).abs() <= 4.0 * f32::EPSILON, "frame {k}");
            }
        }
    }
}

#[test]
fn normals_are_of_length_one_in_every_frame_and_face_as_triangles_turn() {
    let recording = recording(7, DVec3::Z);
    let (document, blob) = read_back(&recording);
    for mesh in document.meshes() {
        let primitive = mesh.primitives().next().unwrap();
        let reader = primitive.reader(|_| Some(&blob[..]));
        let rest: Vec<[f32; 3]> = reader.read_normals().unwrap().collect();
        let mut frames = vec![rest.clone()];
        for (_, normals, _) in reader.read_morph_targets() {
            let moved = normals.unwrap().zip(&rest);
            frames.push(moved.map(|(d, n)| [d[0] + n[0], d[1] + n[1], d[2] + n[2]]).collect());
        }
        for normal in frames.iter().flatten() {
            let length = DVec3::from(normal.map(f64::from)).length();
            assert!((length - 1.0).abs() < 1e-6, "{normal:?}");
        }
        if mesh.name() == Some("cloth") {
            assert_eq!(frames.len(), 7);
            // (-1, .3), (1, .3), (0, -1) turn clockwise seen from above.
            assert!(frames[0].iter().all(|normal| normal[2] < -0.9));
        }
    }
}

#[test]
fn the_scenes_up_becomes_the_formats() {
    for up in [DVec3::Z, DVec3::Y, DVec3::NEG_Y, DVec3::X * 4.0] {
        let (document, _) = read_back(&recording(2, up));
        let root = document.default_scene().unwrap().nodes().next().unwrap();
        assert_eq!(root.children().len(), CLOTH_AND_BALL);
        let (_, rotation, _) = root.transform().decomposed();
        let turned = DQuat::from_array(rotation.map(f64::from)) * up.normalize();
        assert!((turned - DVec3::Y).length() < 1e-6, "{up}: {turned}");
    }
}

#[test]
fn one_frame_is_a_mesh_without_animation() {
    let (document, _) = read_back(&recording(1, DVec3::Z));
    assert_eq!(document.animations().len(), 0);
    assert_eq!(document.meshes().len(), CLOTH_AND_BALL);
}

#[test]
fn of_many_frames_evenly_chosen_ones_and_the_last_are_written() {
    for count in [600_u64, 601, 1300] {
        let recording = recording(count, DVec3::Z);
        let steps: Vec<u64> = chosen(&recording.frames).iter().map(|frame| frame.step).collect();
        assert!(
            steps.len() <= 600 && steps.len() as u64 >= count.min(300),
            "{count}: {}",
            steps.len()
        );
        assert_eq!((steps[0], *steps.last().unwrap()), (10, 10 + 5 * (count - 1)));
        let even = &steps[..steps.len() - 1];
        assert!(even.windows(3).all(|s| s[1] - s[0] == s[2] - s[1]));
    }
}

#[test]
fn a_scene_of_nothing_is_valid() {
    let about = recording(1, DVec3::Z).about;
    let mut recorder = Recorder::new(about, Vec::new(), &[], &[]);
    recorder.frame(0, &[]).unwrap();
    let (document, blob) = read_back(&recorder.finish(None));
    assert_eq!((document.meshes().len(), blob.len()), (0, 0));
}

/// One body turns by more than a whole turn and goes elsewhere, and one breathes.
#[test]
fn a_body_that_keeps_its_shape_is_an_animated_node_and_one_that_does_not_has_targets() {
    let corners = [DVec3::new(0.3, 0.1, 0.0), DVec3::X, DVec3::Y, DVec3::new(0.2, 0.3, 0.9)];
    let triangles = vec![[0, 1, 2], [2, 1, 3]];
    let parts = ["rigid", "breathing"].map(|name| RecordedPart::new(name, PartKind::Body, 4, triangles.clone()));
    let about = recording(1, DVec3::Z).about;
    let mut recorder = Recorder::new(about, parts.to_vec(), &[], &[]);
    for frame in 0..9_u64 {
        let t = frame as f64;
        let turned = |p: DVec3| DQuat::from_axis_angle(DVec3::new(0.6, 0.0, 0.8), 0.9 * t) * p + DVec3::new(0.1 * t, 2.0, 0.0);
        let breathing = |p: DVec3| p * (1.0 + 0.1 * t);
        recorder
            .frame(frame, &[corners.map(turned), corners.map(breathing)].concat())
            .unwrap();
    }
    let recording = recorder.finish(None);
    let (document, blob) = read_back(&recording);
    let targets: Vec<usize> = document
        .meshes()
        .map(|mesh| mesh.primitives().next().unwrap().morph_targets().count())
        .collect();
    assert_eq!(targets, [0, 8]);
    let animation = document.animations().next().unwrap();
    let (mut rotations, mut translations, mut weighted) = (Vec::new(), Vec::new(), 0);
    for channel in animation.channels() {
        let name = channel.target().node().name().unwrap().to_owned();
        match channel.reader(|_| Some(&blob[..])).read_outputs().unwrap() {
            ReadOutputs::Rotations(all) if name == "rigid" => rotations.extend(all.into_f32()),
            ReadOutputs::Translations(all) if name == "rigid" => translations.extend(all),
            ReadOutputs::MorphTargetWeights(_) if name == "breathing" => weighted += 1,
            _ => panic!("{name} is animated otherwise"),
        }
    }
    assert_eq!((rotations.len(), translations.len(), weighted), (9, 9, 1));
    for (k, frame) in recording.frames.iter().enumerate() {
        let (turn, shift) = (
            DQuat::from_array(rotations[k].map(f64::from)),
            DVec3::from(translations[k].map(f64::from)),
        );
        for (first, now) in recording.frames[0].positions[..4].iter().zip(&frame.positions[..4]) {
            let placed = turn * DVec3::from(first.map(f64::from)) + shift;
            assert!(placed.distance(DVec3::from(now.map(f64::from))) < 1e-5, "frame {k}");
        }
    }
    // The rotation goes the short way from one frame to the next.
    let quaternions: Vec<DQuat> = rotations.iter().map(|q| DQuat::from_array(q.map(f64::from))).collect();
    assert!(quaternions.windows(2).all(|two| two[0].dot(two[1]) > 0.0));
}
