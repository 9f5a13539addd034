//! C's functions, called as C does, beside the detector itself. Programs in C and C++ are tested in
//! `tests/interface/programs.rs`.

use crate::answers::{ContactRow, GeometryRow, Kind};
use crate::detector::{Handle, ScalarFormat, on, selvedge_detector_free, selvedge_detector_new, selvedge_detector_set_cancelled};
use crate::settings::*;
use crate::status::{Status, selvedge_last_error, selvedge_status_string};
use crate::weld::selvedge_weld;
use selvedge::core::elementary::Limits;
use selvedge::{CollisionDetector, Contact, Geometry, PairKind, Scalar, Topology};
use std::ffi::CStr;
use std::fmt::Debug;
use std::ptr;

#[cfg(feature = "cloth")]
mod messages;
#[path = "../../tests/sheet/mod.rs"]
pub(crate) mod sheet;

/// The functions for a format, and the same tests of both.
macro_rules! queries {
    ($module:ident: $scalar:ident = $format:ident, $($function:ident as $name:ident),*) => {
        #[path = "."]
        mod $module {
            pub(super) use crate::queries::$module::{$($function as $name),*};
            pub(super) type S = $scalar;
            pub(super) const FORMAT: super::ScalarFormat = super::ScalarFormat::$format;
            #[allow(clippy::duplicate_mod, reason = "the functions that the tests call have other types")]
            #[path = "queries.rs"]
            mod queries;
        }
    };
}
queries!(single: f32 = F32, selvedge_detector_contacts_f32 as contacts, selvedge_detector_contacts_of_f32 as contacts_of,
    selvedge_detector_earliest_f32 as earliest, selvedge_detector_is_free_f32 as is_free,
    selvedge_detector_candidates_f32 as candidates, selvedge_detector_intersections_f32 as intersections,
    selvedge_detector_has_intersections_f32 as has_intersections, selvedge_detector_near_f32 as near,
    selvedge_detector_contact_geometries_f32 as contact_geometries, selvedge_detector_truncate_f32 as truncate);
queries!(double: f64 = F64, selvedge_detector_contacts_f64 as contacts, selvedge_detector_contacts_of_f64 as contacts_of,
    selvedge_detector_earliest_f64 as earliest, selvedge_detector_is_free_f64 as is_free,
    selvedge_detector_candidates_f64 as candidates, selvedge_detector_intersections_f64 as intersections,
    selvedge_detector_has_intersections_f64 as has_intersections, selvedge_detector_near_f64 as near,
    selvedge_detector_contact_geometries_f64 as contact_geometries, selvedge_detector_truncate_f64 as truncate);

pub(crate) fn last_error() -> String {
    // SAFETY: the text ends with a zero and belongs to this thread, which calls nothing meanwhile.
    unsafe { CStr::from_ptr(selvedge_last_error()) }.to_str().unwrap().to_owned()
}

fn new(format: ScalarFormat) -> *mut Handle {
    let triangles = sheet::triangles();
    let vertex_count = sheet::frame(0).len();
    let mut handle = ptr::null_mut();
    // SAFETY: the list is as long as it says.
    let status = unsafe {
        let start = triangles.as_ptr().cast();
        selvedge_detector_new(format as u32, vertex_count, start, triangles.len(), &raw mut handle)
    };
    assert_eq!(status, Status::Ok, "{}", last_error());
    handle
}

pub(crate) fn list<T: Copy>(call: impl FnOnce(*mut *const T, *mut usize) -> Status) -> Vec<T> {
    let (mut start, mut count) = (ptr::null(), usize::MAX);
    let status = call(&raw mut start, &raw mut count);
    assert_eq!(status, Status::Ok, "{}", last_error());
    assert_eq!(start.is_null(), count == 0);
    if count == 0 {
        return Vec::new();
    }
    // SAFETY: the library shows so many rows until its next answer.
    unsafe { std::slice::from_raw_parts(start, count) }.to_vec()
}

/// Checks that two lists are equal to the last bit: none of the numbers is NaN, and every digit is printed.
pub(crate) fn same<T: PartialEq + Debug>(from_c: &[T], from_rust: impl IntoIterator<Item = T>) {
    let from_rust: Vec<T> = from_rust.into_iter().collect();
    assert_eq!(from_c, from_rust);
    assert_eq!(format!("{from_c:?}"), format!("{from_rust:?}"), "but for the sign of a zero");
}

fn kind(kind: PairKind) -> u32 {
    match kind {
        PairKind::VertexFace => Kind::VertexFace as u32,
        PairKind::EdgeEdge => Kind::EdgeEdge as u32,
    }
}

pub(crate) fn contact_row(of: PairKind, pair: [u32; 2], vertices: [u32; 4], time: impl Scalar) -> ContactRow {
    ContactRow {
        time: time.to_f64(),
        kind: kind(of),
        pair: pair.into(),
        vertices,
    }
}

fn rows<S: Scalar>(contacts: &[Contact<S>], topology: &Topology) -> Vec<ContactRow> {
    let row = |it: &Contact<S>| contact_row(it.kind, it.pair, topology.vertices_of(it.kind, it.pair), it.time);
    contacts.iter().map(row).collect()
}

pub(crate) fn geometry_row(of: PairKind, pair: [u32; 2], vertices: [u32; 4], it: &Geometry) -> GeometryRow {
    GeometryRow {
        kind: kind(of),
        pair: pair.into(),
        vertices,
        has_normal: it.normal.is_some(),
        weights: it.weights,
        points: it.points.map(|point| point.to_array()),
        normal: it.normal.unwrap_or_default().to_array(),
        separated_at: it.separated_at,
        distance: it.distance,
        speed: it.speed,
    }
}

/// One of two particles falls onto the other and onto one piece of a rope of two.
#[test]
fn ropes_and_particles_are_triangles_that_name_a_vertex_again() {
    let (edges, points) = ([[0, 1], [1, 2]], [3, 4]);
    let topology = Topology::with_loose_features(5, vec![], &edges, &points).unwrap();
    let faces = [[0_u32, 1, 1], [1, 2, 2], [3, 3, 3], [4, 4, 4]];
    let mut handle = ptr::null_mut();
    // SAFETY: the array is as long as the count says.
    let status = unsafe { selvedge_detector_new(ScalarFormat::F64 as u32, 5, faces.as_ptr().cast(), 4, &raw mut handle) };
    assert_eq!(status, Status::Ok, "{}", last_error());
    let start = [
        [-1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [1.0, 0.0, 1.0],
        [1.0, 0.0, 0.5],
    ];
    let mut end = start;
    end[3][2] = -1.0;
    let mut contacts = Vec::new();
    let mut detector = CollisionDetector::<f64>::new(topology.clone());
    detector.contacts(&start, &end, &mut contacts).unwrap();
    assert_eq!(
        contacts.len(),
        3,
        "each particle with the other, one with the piece: {contacts:?}"
    );
    // SAFETY: the frames are as long as the mesh requires.
    let from_c =
        list(|rows, count| unsafe { double::contacts(handle, start.as_ptr().cast(), end.as_ptr().cast(), 5, rows, count) });
    same(&from_c, rows(&contacts, &topology));
    assert_eq!(selvedge_detector_free(handle), Status::Ok);
}

#[test]
fn default_tolerances_are_the_detectors() {
    assert_eq!(SELVEDGE_DEFAULT_TOLERANCE_F32, f64::from(Limits::<f32>::default().tolerance));
    assert_eq!(SELVEDGE_DEFAULT_TOLERANCE_F64, Limits::<f64>::default().tolerance);
}

#[test]
fn a_separation_is_never_rounded_down() {
    // The nearest float is larger, smaller, or zero.
    for separation in [0.1, 0.7, 1e-60] {
        let kept: f64 = length::<f32>(separation).unwrap().into();
        assert!(
            kept >= separation && kept <= separation * 1.000001 + 1e-29,
            "{separation} became {kept}"
        );
        assert_eq!(length::<f64>(separation).unwrap(), separation);
    }
    assert!(
        [-1e-60, -1.0, f64::NAN, f64::INFINITY]
            .iter()
            .all(|&none| length::<f32>(none).is_err())
    );
}

#[test]
fn a_panic_breaks_its_detector_and_no_other() {
    let (broken, other) = (new(ScalarFormat::F64), new(ScalarFormat::F64));
    assert_eq!(on(broken, |_| panic!("on purpose, {}", 1)), Status::Internal);
    assert!(last_error().ends_with("on purpose, 1"), "{}", last_error());
    assert_eq!(selvedge_detector_set_coherent(broken, 1), Status::Internal);
    assert!(last_error().contains("only be freed"), "{}", last_error());
    assert_eq!(selvedge_detector_set_coherent(other, 1), Status::Ok);
    assert_eq!(selvedge_detector_free(broken), Status::Ok);
    assert_eq!(selvedge_detector_free(broken), Status::NoSuchDetector);
    assert_eq!(selvedge_detector_free(other), Status::Ok);
}

/// A panic payload whose drop panics.
struct Unhappy;
impl Drop for Unhappy {
    fn drop(&mut self) {
        panic!("again");
    }
}

#[test]
fn a_panic_without_a_message_ends_at_the_border_too() {
    let handle = new(ScalarFormat::F64);
    assert_eq!(on(handle, |_| std::panic::panic_any(Unhappy)), Status::Internal);
    assert!(last_error().contains("without a message"));
    selvedge_detector_free(handle);
}

#[test]
fn a_second_thread_is_refused_and_may_cancel_and_free() {
    let handle = new(ScalarFormat::F64);
    let status = on(handle, |_| {
        let address = handle.addr();
        let second = std::thread::spawn(move || {
            let handle = ptr::without_provenance_mut(address);
            let refused = selvedge_detector_set_coherent(handle, 1);
            let words = last_error();
            // These two calls are the exceptions.
            let cancelled = selvedge_detector_set_cancelled(handle, 1);
            (refused, words, cancelled, selvedge_detector_free(handle))
        });
        let (refused, words, cancelled, freed) = second.join().unwrap();
        assert_eq!((refused, cancelled, freed), (Status::Busy, Status::Ok, Status::Ok));
        assert!(words.contains("another thread"));
        Ok(())
    });
    assert_eq!(status, Status::Ok);
    assert_eq!(selvedge_detector_set_coherent(handle, 1), Status::NoSuchDetector);
}

#[test]
fn each_thread_has_its_own_last_error() {
    assert_eq!(selvedge_detector_set_coherent(ptr::null_mut(), 1), Status::NullPointer);
    let before = last_error();
    std::thread::spawn(|| assert_eq!(last_error(), "")).join().unwrap();
    assert_eq!(last_error(), before);
    assert_eq!(before, "the detector is NULL");
}

#[test]
fn every_status_has_a_text_of_its_own() {
    let text = |status| {
        // SAFETY: the text ends with a zero and is valid forever.
        unsafe { CStr::from_ptr(selvedge_status_string(status)) }.to_str().unwrap()
    };
    let last = Status::BadFile as i32;
    let texts: std::collections::BTreeSet<_> = (0..=last).map(text).collect();
    assert_eq!(texts.len(), last as usize + 1);
    assert!(!texts.contains("unknown status"));
    assert!([-1, i32::MIN, i32::MAX, last + 1].map(text) == ["unknown status"; 4]);
}

#[test]
fn a_long_text_is_cut_at_a_character() {
    let text = "é".repeat(2000);
    assert_eq!(
        crate::status::remember(&crate::status::Failure::new(Status::Internal, text)),
        Status::Internal
    );
    assert!(last_error().len() > 1000 && last_error().chars().all(|letter| letter == 'é'));
}

#[test]
fn vertices_in_one_place_are_merged() {
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [-0.0; 3], [1.0, 1e-7, 0.0]];
    let weld = |tolerance: f64| {
        let (mut vertex_of, mut count) = ([9; 4], 9);
        // SAFETY: the arrays are as long as the count says.
        let status = unsafe {
            selvedge_weld(
                positions.as_ptr().cast(),
                4,
                tolerance,
                vertex_of.as_mut_ptr(),
                &raw mut count,
            )
        };
        (status, vertex_of, count)
    };
    assert_eq!(weld(0.0), (Status::Ok, [0, 1, 0, 2], 3));
    assert_eq!(weld(1e-6), (Status::Ok, [0, 1, 0, 1], 2));
    assert_eq!(weld(-1.0), (Status::BadValue, [9; 4], 9));
    assert_eq!(last_error(), "the tolerance is -1, but must be a distance, 0 or more");
}
