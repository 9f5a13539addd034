//! Which version this is.

use std::ffi::{CStr, c_char};

/// Of the header: it changes with what was there before.
pub const SELVEDGE_VERSION_MAJOR: u32 = 0;
/// Of the header: below 1.0 it changes with what was there before.
pub const SELVEDGE_VERSION_MINOR: u32 = 1;
/// Of the header.
pub const SELVEDGE_VERSION_PATCH: u32 = 0;
/// Of the header, as one number. That of the library is selvedge_version().
pub const SELVEDGE_VERSION: u32 = 1000000 * SELVEDGE_VERSION_MAJOR + 1000 * SELVEDGE_VERSION_MINOR + SELVEDGE_VERSION_PATCH;

const TEXT: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(text) => text,
    Err(_) => panic!("a version has no zero byte"),
};

/// The library's version in words, as "0.1.0". Never NULL; valid for ever.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_version_string() -> *const c_char {
    TEXT.as_ptr()
}

/// The library's version as a number: 1,000,000 * major + 1,000 * minor + patch. That of the header is SELVEDGE_VERSION.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_version() -> u32 {
    SELVEDGE_VERSION
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn macros_and_library_tell_the_same_version() {
        let parts = [SELVEDGE_VERSION_MAJOR, SELVEDGE_VERSION_MINOR, SELVEDGE_VERSION_PATCH];
        let words = TEXT.to_str().unwrap();
        assert_eq!(parts.map(|part| part.to_string()).join("."), words);
    }
}
