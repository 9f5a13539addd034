//! Every kept input again: the corpus that campaigns grew, and what once broke a promise.

use crate::targets;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};

/// The files in `folder`, sorted; none if there is no such folder.
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
    // Mesh files of every kind, which campaigns start from as well.
    let zoo = files(&root.join("../std-adapter/files/tests/zoo"));
    paths.extend(
        zoo.into_iter()
            .filter(|path| path.extension().is_some_and(|extension| extension == name)),
    );
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

#[test]
fn certified_filter_keeps_its_promises_on_the_kept_inputs() {
    replay("certified_filter");
}

#[test]
fn box_tests_keep_their_promises_on_the_kept_inputs() {
    replay("box_tests");
}

#[test]
fn exact_signs_keeps_its_promises_on_the_kept_inputs() {
    replay("exact_signs");
}

#[test]
fn time_of_impact_keeps_its_promises_on_the_kept_inputs() {
    replay("time_of_impact");
}

#[test]
fn exact_verdict_keeps_its_promises_on_the_kept_inputs() {
    replay("exact_verdict");
}

#[test]
fn distribution_keeps_its_promises_on_the_kept_inputs() {
    replay("distribution");
}

#[test]
fn obj_keeps_its_promises_on_the_kept_inputs() {
    replay("obj");
}

#[test]
fn ply_keeps_its_promises_on_the_kept_inputs() {
    replay("ply");
}

#[test]
fn stl_keeps_its_promises_on_the_kept_inputs() {
    replay("stl");
}

#[test]
fn off_keeps_its_promises_on_the_kept_inputs() {
    replay("off");
}

#[test]
fn query_csv_keeps_its_promises_on_the_kept_inputs() {
    replay("query_csv");
}

#[test]
fn scene_keeps_its_promises_on_the_kept_inputs() {
    replay("scene");
}

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
