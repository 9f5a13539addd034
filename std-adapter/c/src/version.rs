//! The version of the header and of the library.

use std::ffi::{CStr, c_char};

/// The major version of the header. It changes with an incompatible change.
pub const SELVEDGE_VERSION_MAJOR: u32 = 0;
/// The minor version of the header. Below 1.0 it changes with an incompatible change.
pub const SELVEDGE_VERSION_MINOR: u32 = 1;
/// The patch version of the header.
pub const SELVEDGE_VERSION_PATCH: u32 = 0;
/// The version of the header as one number. selvedge_version() returns that of the library.
pub const SELVEDGE_VERSION: u32 = 1000000 * SELVEDGE_VERSION_MAJOR + 1000 * SELVEDGE_VERSION_MINOR + SELVEDGE_VERSION_PATCH;

const TEXT: &CStr = match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
    Ok(text) => text,
    Err(_) => panic!("a version has no zero byte"),
};

/// Returns the version of the library as a text, such as "0.1.0". It is never NULL, and valid forever.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_version_string() -> *const c_char {
    TEXT.as_ptr()
}

/// Returns the version of the library: 1,000,000 * major + 1,000 * minor + patch. SELVEDGE_VERSION is that of the header.
#[unsafe(no_mangle)]
pub extern "C" fn selvedge_version() -> u32 {
    SELVEDGE_VERSION
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn macros_and_library_have_the_same_version() {
        let parts = [SELVEDGE_VERSION_MAJOR, SELVEDGE_VERSION_MINOR, SELVEDGE_VERSION_PATCH];
        let words = TEXT.to_str().unwrap();
        assert_eq!(parts.map(|part| part.to_string()).join("."), words);
    }
}
