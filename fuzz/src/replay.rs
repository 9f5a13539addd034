//! Runs every kept input: the corpus that campaigns grew, and inputs that once broke a promise.

use crate::targets;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// Returns the files in `folder`, sorted, or none if there is no such folder.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

fn replay(name: &str) {
    let (_, target) = targets::ALL
        .into_iter()
        .find(|(known, _)| *known == name)
        .expect("a target of this name");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut paths = files(&root.join("corpus").join(name));
    // These are mesh files of every kind, which campaigns start from as well.
    let zoo = files(&root.join("../std-adapter/files/tests/zoo"));
    paths.extend(zoo.into_iter().filter(|path| {
        path.extension()
            .is_some_and(|extension| extension == name || name == "gltf" && extension == "glb")
    }));
    assert!(paths.len() >= 10, "only {} kept inputs", paths.len());
    paths.extend(files(&root.join("regressions").join(name)));
    let mut broken = Vec::new();
    for path in paths {
        let bytes = fs::read(&path).unwrap();
        if catch_unwind(AssertUnwindSafe(|| target(&bytes))).is_err() {
            broken.push(path);
        }
    }
    assert!(broken.is_empty(), "see above for {broken:#?}");
}

/// A test for each target, so that they run side by side.
macro_rules! replayed {
    ($($name:ident),* $(,)?) => {
        $(#[test]
        fn $name() {
            replay(stringify!($name));
        })*
    };
}

replayed!(
    certified_filter,
    box_tests,
    exact_signs,
    time_of_impact,
    exact_verdict,
    detector,
    obj,
    ply,
    stl,
    off,
    gltf,
    scene,
    c_interface
);

#[test]
fn every_folder_of_inputs_belongs_to_a_target() {
    for folder in ["corpus", "regressions"] {
        for path in files(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder)) {
            let name = path.file_name().unwrap().to_str().unwrap();
            let known = targets::ALL.iter().any(|(target, _)| *target == name);
            assert!(known, "{} belongs to no target", path.display());
        }
    }
}

/// libFuzzer puts words of the dictionary into scene files.
#[test]
fn the_dictionary_of_scenes_has_every_effect() {
    let dictionary = include_str!("../dictionaries/scene.dict");
    let is_missing = |name: &&str| !dictionary.lines().any(|line| line == format!("\"{name}\""));
    let missing: Vec<_> = selvedge_cloth::effect_names().into_iter().filter(is_missing).collect();
    assert!(missing.is_empty(), "add to dictionaries/scene.dict: {missing:?}");
}

/// `cargo run -p selvedge-traced -- coq FOLDER` writes the signs of these pairs for Coq, which computes the same.
#[test]
fn the_proofs_have_the_kept_pairs_of_exact_signs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let path = root.join("../verification/traced/kept_pairs.txt");
    let inputs = files(&root.join("corpus/exact_signs"));
    let lines = inputs
        .iter()
        .map(|input| targets::exact_signs::encodings(&fs::read(input).unwrap()) + "\n");
    let text: String = lines.collect();
    if std::env::var_os("UPDATE_KEPT_PAIRS").is_some() {
        fs::write(&path, &text).unwrap();
    }
    assert!(
        fs::read_to_string(&path).unwrap() == text,
        "kept inputs have changed: run UPDATE_KEPT_PAIRS=1 cargo test -p selvedge-fuzz kept_pairs, then accept the terms \
         (cargo run -p selvedge-traced -- accept)"
    );
}
