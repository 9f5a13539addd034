//! Names the shared library for the loader, and makes the functions for `float` from those for `double`. A macro would not do:
//! cbindgen, which writes the header, reads sources and does not expand macros with stable Rust.

use std::env::var;
use std::path::Path;
use std::{env, fs};

/// The sources with functions for `double`, and the file that receives their twins.
const DOUBLE: [(&str, &str); 2] = [("src/queries/double.rs", "queries.rs"), ("src/world/double.rs", "world.rs")];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let folder = env::var_os("OUT_DIR").expect("cargo sets it");
    for (double, single) in DOUBLE {
        println!("cargo:rerun-if-changed={double}");
        let source = fs::read_to_string(double).unwrap_or_else(|error| panic!("{double}: {error}"));
        let target = Path::new(&folder).join(single);
        fs::write(&target, twins(&source)).unwrap_or_else(|error| panic!("{}: {error}", target.display()));
    }

    let version = |part: &str| var(format!("CARGO_PKG_VERSION_{part}")).expect("cargo sets it");
    // On other systems the library has cargo's name.
    let is_elf = var("CARGO_CFG_TARGET_FAMILY").is_ok_and(|family| family == "unix")
        && var("CARGO_CFG_TARGET_VENDOR").is_ok_and(|vendor| vendor != "apple");
    if is_elf {
        // Below 1.0 a minor version may change the interface. The Makefile uses the same name.
        let (major, minor) = (version("MAJOR"), version("MINOR"));
        println!("cargo:rustc-cdylib-link-arg=-Wl,-soname,libselvedge.so.{major}.{minor}");
    }
}

/// Returns `source` for `f32`. The documentation of a function refers to its twin. `c_double` stays `double`.
fn twins(source: &str) -> String {
    let mut twins = String::new();
    let mut documentation: Vec<&str> = Vec::new();
    for line in source.lines() {
        match line {
            _ if line.starts_with("//!") => {}
            _ if line.starts_with("///") => documentation.push(line),
            _ => {
                if let Some(name) = line
                    .strip_prefix("pub unsafe extern \"C\" fn ")
                    .and_then(|rest| rest.strip_suffix('('))
                {
                    twins.push_str(&format!("/// {name} for float.\n"));
                    if documentation.contains(&"/// # Safety") {
                        twins.push_str(&format!("///\n/// # Safety\n/// The conditions are those of {name}.\n"));
                    }
                    twins.push_str("#[unsafe(no_mangle)]\n");
                    documentation.clear();
                }
                if line != "#[unsafe(no_mangle)]" {
                    twins.push_str(&line.replace("f64", "f32"));
                    twins.push('\n');
                }
            }
        }
    }
    twins
}
