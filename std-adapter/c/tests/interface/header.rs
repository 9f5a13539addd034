//! The headers are what cbindgen makes of the sources. With `UPDATE_HEADER=1` they are written.

use cbindgen::Config;
use std::path::Path;
use std::{env, fs};

/// Of `selvedge.h`, in the order that it has.
const SOURCES: [&str; 7] = [
    "version",
    "status",
    "answers",
    "detector",
    "settings",
    "questions/mod",
    "world/mod",
];

/// Of `selvedge_cloth.h`.
const CLOTH_SOURCES: [&str; 5] = ["run", "counts", "state", "lead", "checkpoint"];

const CLOTH_HEAD: &str = "
/* Selvedge's cloth: a simulation of which no state ever has an intersection.
 *
 * Made by cbindgen from std-adapter/c/src; do not edit. README.md beside it has an example; what a scene may say stands in
 * std-adapter/cloth/scenes/README.md.
 *
 * For a library that was built with the feature \"cloth\", as `make install CLOTH=yes` does. Statuses, words and threads are as
 * in selvedge.h. All is in SI units. Names and paths are UTF-8 with a zero at the end.
 */";

fn config() -> Config {
    Config::from_file(Path::new(env!("CARGO_MANIFEST_DIR")).join("cbindgen.toml")).unwrap()
}

fn is_made_of(header: &str, config: Config, sources: &[String]) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut builder = cbindgen::Builder::new().with_config(config);
    for source in sources {
        builder = builder.with_src(folder.join(format!("src/{source}.rs")));
    }
    let mut made = Vec::new();
    builder.generate().unwrap().write(&mut made);
    // Rust's name for what a caller owes.
    let made = String::from_utf8(made)
        .unwrap()
        .replace(" * # Safety\n", " * The caller promises:\n");
    let path = folder.join("include").join(header);
    if env::var_os("UPDATE_HEADER").is_some() {
        fs::write(&path, &made).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    let line = kept.lines().zip(made.lines()).position(|(kept, made)| kept != made);
    assert!(
        kept == made,
        "include/{header} is not that of the sources (line {line:?}): UPDATE_HEADER=1 cargo test -p selvedge-c --test interface header"
    );
}

#[test]
fn the_header_is_that_of_the_sources() {
    is_made_of("selvedge.h", config(), &SOURCES.map(str::to_owned));
}

#[test]
fn the_header_of_cloth_is_that_of_the_sources() {
    let mut config = config();
    config.include_guard = Some("SELVEDGE_CLOTH_H".into());
    config.header = Some(CLOTH_HEAD.into());
    config.includes = vec!["selvedge.h".into()];
    is_made_of(
        "selvedge_cloth.h",
        config,
        &CLOTH_SOURCES.map(|source| format!("simulation/{source}")),
    );
}
