//! C's functions for worlds, beside the world itself.

use super::{on, selvedge_world_free, selvedge_world_new, selvedge_world_set_pair_limit};
use crate::status::Status;
use crate::tests::last_error;
use std::ptr;

/// The functions for a format, and the same test of both.
macro_rules! story {
    ($module:ident: $scalar:ident = $format:ident, $($function:ident as $name:ident),*) => {
        #[path = "."]
        mod $module {
            pub(super) use crate::world::$module::{$($function as $name),*};
            pub(super) type S = $scalar;
            pub(super) const FORMAT: crate::detector::ScalarFormat = crate::detector::ScalarFormat::$format;
            #[allow(clippy::duplicate_mod, reason = "the functions that the test calls have other types")]
            #[path = "story.rs"]
            mod story;
        }
    };
}
story!(single: f32 = F32, selvedge_world_insert_f32 as insert, selvedge_world_contacts_f32 as contacts,
    selvedge_world_earliest_f32 as earliest, selvedge_world_is_free_f32 as is_free);
story!(double: f64 = F64, selvedge_world_insert_f64 as insert, selvedge_world_contacts_f64 as contacts,
    selvedge_world_earliest_f64 as earliest, selvedge_world_is_free_f64 as is_free);

#[test]
fn a_panic_breaks_its_world_and_no_detectors_handle_names_a_world() {
    let [mut broken, mut other] = [ptr::null_mut(); 2];
    for handle in [&mut broken, &mut other] {
        // SAFETY: there is a place for it.
        assert_eq!(unsafe { selvedge_world_new(0, handle) }, Status::Ok);
    }
    assert_eq!(on(broken, |_| panic!("on purpose")), Status::Internal);
    assert_eq!(selvedge_world_set_pair_limit(broken, 1), Status::Internal);
    assert!(last_error().contains("only be freed"), "{}", last_error());
    assert_eq!(selvedge_world_set_pair_limit(other, 1), Status::Ok);
    let as_detector = other.cast();
    assert_eq!(crate::detector::selvedge_detector_free(as_detector), Status::NoSuchDetector);
    assert_eq!(selvedge_world_free(broken), Status::Ok);
    assert_eq!(selvedge_world_free(broken), Status::NoSuchWorld);
    assert_eq!(selvedge_world_free(other), Status::Ok);
}
