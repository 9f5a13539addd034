//! Mistakes in scene files, and their messages.

use crate::common::*;
use std::fs::read_to_string;

/// A table has the name of the scene that its mistakes are made in. A mistake has two lines: a passage of the scene, `=>` and its
/// replacement; then the place and the message, or its beginning. `\\n` stands for a line break, and F for the folder.
#[test]
fn every_mistake_in_a_scene_is_named_with_its_place_its_unit_and_what_would_be_right() {
    let folder = test_scenes();
    let files = folder.read_dir().unwrap().map(|file| file.unwrap().path());
    let tables: Vec<_> = files.filter(|file| file.extension().is_some_and(|e| e == "txt")).collect();
    assert!(tables.len() > 10, "{tables:?}");
    for table in tables {
        let path = table.with_extension("toml");
        let in_folder = |text: &str| text.replace(folder.to_str().unwrap(), "F");
        let (good, mistakes) = (read_to_string(&path).unwrap(), read_to_string(&table).unwrap());
        Scene::parse(&good, &path).unwrap();
        let mut lines = mistakes.lines().map(str::trim);
        while let Some(case) = lines.next() {
            let (passage, by) = case.split_once(" =>").unwrap();
            let [passage, by] = [passage, by.trim_start()].map(|text| text.replace("\\n", "\n"));
            assert_eq!(
                good.matches(&passage).count(),
                1,
                "'{passage}' must be there once in {path:?}"
            );
            let error = Scene::parse(&good.replacen(&passage, &by, 1), &path).unwrap_err();
            let expected = format!("{}:{}", in_folder(path.to_str().unwrap()), lines.next().unwrap());
            assert_message(&in_folder(&error.to_string()), &expected);
        }
    }
}

/// The library words the message about a file that is not TOML; the place comes from this crate.
#[test]
fn a_scene_that_is_not_toml_is_refused_with_its_place() {
    for text in ["[cloth", "[effects.gravity]\n[effects.gravity]"] {
        let error = Scene::parse(text, Path::new("s.toml")).unwrap_err().to_string();
        assert!(error.starts_with("s.toml:") && error.len() > 20, "{error}");
    }
}

#[test]
fn a_file_that_cannot_be_read_is_named() {
    let error = Scene::read(Path::new("no/such/scene.toml")).unwrap_err();
    assert!(error.to_string().starts_with("no/such/scene.toml: cannot be read: "));
    let error = Scene::read(Path::new(".")).unwrap_err();
    assert_eq!(error.to_string(), ".: this is a folder; name a scene file in it");
}

#[test]
fn the_scenes_that_come_with_the_program_are_good() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes");
    let files: Vec<_> = folder.read_dir().unwrap().map(|file| file.unwrap().path()).collect();
    assert!(!files.is_empty());
    for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "toml")) {
        let scene = Scene::read(file).unwrap();
        assert!(!scene.effect_names().is_empty(), "{}", file.display());
    }
}

#[test]
fn slivers_and_what_an_exporter_has_split_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let read = |obj: &str| {
        std::fs::write(folder.path().join("m.obj"), obj).unwrap();
        let text = "duration = 1\n[cloth]\nshape = \"file\"\nfile = \"m.obj\"\ndensity = 0.1\n[effects.gravity]\n";
        Scene::parse(text, &folder.path().join("s.toml"))
    };
    let sliver = read("v 0 0 0\nv 1 0 0\nv 1 1e-7 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n")
        .unwrap_err()
        .to_string();
    assert!(
        sliver.contains("triangle 0 of the cloth (vertices 0, 1, 2) is only 1.0e-7 m high: a sliver"),
        "{sliver}"
    );
    assert!(sliver.contains("weld = \"1 um\""), "{sliver}");
    let seam = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 4 5 6\nf 4 5 6\n";
    let remarks = read(seam).unwrap().remarks;
    assert_eq!(
        remarks,
        [
            "The file of the cloth 'cloth' has 2 vertices in the same place as others (weld merges them), 1 duplicate triangle, 3 edges between triangles that face opposite ways."
        ]
    );
    assert!(read("v 0 0 0\nv 1 0 0\nv 1 1e-5 0\nf 1 2 3\n").unwrap().remarks.is_empty());
}
