//! Names the shared library for the loader, so that programs find a version that they were built for.

use std::env::var;

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let version = |part: &str| var(format!("CARGO_PKG_VERSION_{part}")).expect("cargo sets it");
    // Elsewhere cargo's own name stays.
    let is_elf = var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|family| family == "unix")
        && var("CARGO_CFG_TARGET_VENDOR").is_ok_and(|vendor| vendor != "apple");
    if is_elf {
        // Below 1.0 a minor version may change what is there. The Makefile has the same name.
        let (major, minor) = (version("MAJOR"), version("MINOR"));
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libselvedge.so.{major}.{minor}");
    }
}
