//! `include/selvedge.h` is what cbindgen makes of the sources. With `UPDATE_HEADER=1` it is written.

use std::path::Path;
use std::{env, fs};

/// In the order that the header has.
const SOURCES: [&str; 8] = [
    "version",
    "status",
    "answers",
    "detector",
    "settings",
    "questions",
    "world/mod",
    "world/steps",
];

#[test]
fn the_header_is_that_of_the_sources() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let config = cbindgen::Config::from_file(folder.join("cbindgen.toml")).unwrap();
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in SOURCES {
        builder = builder.with_src(folder.join(format!("src/{source}.rs")));
    }
    let mut made = Vec::new();
    builder.generate().unwrap().write(&mut made);
    // Rust's name for what a caller owes.
    let made = String::from_utf8(made)
        .unwrap()
        .replace(" * # Safety\n", " * The caller promises:\n");
    let path = folder.join("include/selvedge.h");
    if env::var_os("UPDATE_HEADER").is_some() {
        fs::write(&path, &made).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    let line = kept.lines().zip(made.lines()).position(|(kept, made)| kept != made);
    assert!(
        kept == made,
        "include/selvedge.h is not that of the sources (line {line:?}): UPDATE_HEADER=1 cargo test -p selvedge-c --test header"
    );
}
