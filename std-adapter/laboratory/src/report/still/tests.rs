use super::*;
use crate::report::{About, PartKind, RecordedPart, Recorder};
use selvedge_core::glam::DVec3;
use tiny_skia::ColorU8;

/// Records a square of cloth, 1 m wide and flat, above a larger one that is a body.
fn recording(up: DVec3, unit: f64) -> Recording {
    let about = About::test("squares", up, 0.1);
    let triangles = vec![[0, 1, 2], [2, 1, 3]];
    let parts = vec![
        RecordedPart::new("cloth", PartKind::Cloth, 4, triangles.clone()),
        RecordedPart::new("floor", PartKind::Body, 4, triangles),
    ];
    let mut recorder = Recorder::new(about, parts, &[], &[]);
    let [across, along] = [up.any_orthonormal_vector(), up.cross(up.any_orthonormal_vector())];
    let square = |half: f64, height: f64| {
        let corner = move |x: f64, y: f64| unit * (half * (across * x + along * y) + up * height);
        [corner(-1.0, -1.0), corner(1.0, -1.0), corner(-1.0, 1.0), corner(1.0, 1.0)]
    };
    for step in 0..3 {
        let positions = [square(0.3, 0.5 - 0.1 * step as f64), square(1.0, 0.0)].concat();
        recorder.frame(step, &positions).unwrap();
    }
    recorder.finish(None)
}

fn pixels(recording: &Recording, frame: usize) -> Vec<ColorU8> {
    let png = png(recording, frame, [160, 100]).unwrap();
    let picture = Pixmap::decode_png(&png).unwrap();
    assert_eq!((picture.width(), picture.height()), (160, 100));
    picture.pixels().iter().map(|pixel| pixel.demultiply()).collect()
}

/// Blue is the cloth's colour, seen from above.
fn is_cloth(pixel: &ColorU8) -> bool {
    i32::from(pixel.blue()) > 40 + i32::from(pixel.red())
}

#[test]
fn what_is_nearer_hides_what_is_behind_it_and_moves_from_frame_to_frame() {
    let recording = recording(DVec3::Z, 1.0);
    let rows = [0, 2].map(|frame| {
        let pixels = pixels(&recording, frame);
        let cloth: Vec<usize> = (0..pixels.len()).filter(|&k| is_cloth(&pixels[k])).collect();
        assert!((100..6000).contains(&cloth.len()), "{}", cloth.len());
        // The cloth is around the middle of the body, which would be visible without the cloth.
        cloth.iter().map(|k| k / 160).sum::<usize>() / cloth.len()
    });
    assert!(rows[1] > rows[0] + 3, "it falls: {rows:?}");
}

#[test]
fn the_body_has_the_cloths_shadow() {
    let shaded = |with_cloth: bool| {
        let mut recording = recording(DVec3::Z, 1.0);
        if !with_cloth {
            recording.frames[0].positions[..4].fill([0.0, 0.0, 0.0]);
        }
        let pixels = pixels(&recording, 0);
        // The body is brown: red is more than blue.
        let body = pixels.iter().filter(|pixel| pixel.red() > pixel.blue().saturating_add(4));
        body.filter(|pixel| pixel.red() < 140).count()
    };
    assert!(shaded(true) > shaded(false) + 50, "{} {}", shaded(true), shaded(false));
}

#[test]
fn neither_the_unit_of_length_nor_the_direction_up_changes_the_picture_much() {
    let first = pixels(&recording(DVec3::Z, 1.0), 0);
    for (up, unit) in [(DVec3::Y, 1.0), (DVec3::Z, 1e-6), (DVec3::Z, 1e9), (DVec3::NEG_X, 3.0)] {
        let other = pixels(&recording(up, unit), 0);
        let cloth = |pixels: &[ColorU8]| pixels.iter().filter(|pixel| is_cloth(pixel)).count() as f64;
        let ratio = cloth(&other) / cloth(&first);
        assert!((0.8..1.25).contains(&ratio), "{up} {unit}: {ratio}");
    }
}

#[test]
fn a_scene_of_nothing_is_a_floor() {
    let about = recording(DVec3::Z, 1.0).about;
    let mut recorder = Recorder::new(about, Vec::new(), &[], &[]);
    recorder.frame(0, &[]).unwrap();
    let pixels = pixels(&recorder.finish(None), 0);
    assert!(!pixels.iter().any(is_cloth));
}

#[test]
fn a_frame_that_is_not_there_and_a_size_that_cannot_be_are_refused() {
    let recording = recording(DVec3::Z, 1.0);
    assert_eq!(
        png(&recording, 3, [9, 9]).unwrap_err().to_string(),
        "there is no frame 3: the recording has 3, from 0 on"
    );
    for size in [[0, 9], [9, 0], [9, 8193]] {
        assert!(matches!(png(&recording, 0, size), Err(StillError::Size(..))));
    }
}
