//! A folder for a test, and the program.

use serde_json::Value;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;
use tempfile::TempDir;

/// A small triangle one unit above a large one.
pub(crate) const ABOVE: &str = "\
v -5 -5 0
v 5 -5 0
v 0 5 0
v 0 0 1
v 1 0 1.1
v 0 1 1.2
f 1 2 3
f 4 5 6
";

/// Returns the same triangles, with the small one moved by `z`.
pub(crate) fn moved_by(z: f64) -> String {
    let mut lines: Vec<String> = ABOVE.lines().map(str::to_owned).collect();
    for (line, height) in lines[3..6].iter_mut().zip([1.0, 1.1, 1.2]) {
        let (place, _) = line.rsplit_once(' ').unwrap();
        *line = format!("{place} {}", height + z);
    }
    lines.join("\n") + "\n"
}

/// A scene of a sheet that falls on a ball, in 500 steps.
pub(crate) const SHEET: &str = r#"
name = "a </script> sheet"
time_step = "2 ms"
duration = "1 s"
frames_per_second = 10

[cloth]
shape = "sheet"
corner = [-0.2, -0.2, 0.13]
sides = { first = [0.4, 0, 0], second = [0, 0.4, 0] }
cells = [8, 8]
density = "200 g/m2"

[[body]]
name = "ball"
shape = "ball"
centre = [0, 0, 0]
radius = "10 cm"
around = 10

[effects.gravity]

[effects.stretch]
stiffness = "200 N/m"

[effects.body_contact]
thickness = "5 mm"

[effects.self_collision]
thickness = "5 mm"
"#;

/// A folder of its own for each test, in which the program runs.
pub(crate) struct Workplace {
    folder: TempDir,
}

impl Workplace {
    pub(crate) fn new() -> Self {
        Self {
            folder: tempfile::tempdir().unwrap(),
        }
    }

    /// Makes a folder with `start.obj` and `end.obj`, in which the small triangle falls through the large one.
    pub(crate) fn with_step() -> Self {
        let place = Self::new();
        place.write("start.obj", ABOVE);
        place.write("end.obj", moved_by(-4.0));
        place
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        let path = self.path(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, content).unwrap();
    }

    pub(crate) fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// Returns every file and folder, by its path from here.
    pub(crate) fn listing(&self) -> Vec<String> {
        fn visit(folder: &Path, root: &Path, found: &mut Vec<String>) {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                let name = path.strip_prefix(root).unwrap();
                found.push(name.to_str().unwrap().to_owned());
                if path.is_dir() {
                    visit(&path, root, found);
                }
            }
        }
        let mut found = Vec::new();
        visit(self.folder.path(), self.folder.path(), &mut found);
        found.sort();
        found
    }

    pub(crate) fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_selvedge"));
        command.current_dir(self.folder.path()).args(arguments);
        command
    }

    pub(crate) fn run(&self, arguments: &[&str]) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// Returns the standard output of a run that must succeed.
    #[track_caller]
    pub(crate) fn stdout(&self, arguments: &[&str]) -> String {
        let output = self.run(arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    }

    /// Returns the error message, without earlier notes, of a run that must fail with status 1, print nothing and leave no file
    /// behind.
    #[track_caller]
    pub(crate) fn refusal(&self, arguments: &[&str]) -> String {
        let before = self.listing();
        let output = self.run(arguments);
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), output.stdout.len()), (Some(1), 0), "{text}");
        assert_eq!(self.listing(), before, "files were left behind");
        text[text.find("error: ").expect("no error message")..].to_owned()
    }

    #[track_caller]
    pub(crate) fn json(&self, arguments: &[&str]) -> Value {
        serde_json::from_str(&self.stdout(arguments)).unwrap()
    }
}

/// A run that several tests share, since it takes seconds: its output, its notes, and its files.
pub(crate) struct Run {
    pub(crate) text: String,
    pub(crate) notes: String,
    /// The paths of all files and folders, as [`Workplace::listing`] returns them.
    pub(crate) listing: Vec<String>,
    files: BTreeMap<String, Vec<u8>>,
}

impl Run {
    #[track_caller]
    fn new(arguments: &[&str]) -> Self {
        let place = Workplace::new();
        let Output { status, stdout, stderr } = place.run(arguments);
        let [text, notes] = [stdout, stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(status.success(), "{notes}");
        let listing = place.listing();
        let files = listing.iter().filter(|name| place.path(name).is_file());
        let files = files.map(|name| (name.clone(), fs::read(place.path(name)).unwrap()));
        Self {
            text,
            notes,
            files: files.collect(),
            listing,
        }
    }

    #[track_caller]
    pub(crate) fn bytes(&self, name: &str) -> &[u8] {
        &self.files[name]
    }

    #[track_caller]
    pub(crate) fn read(&self, name: &str) -> &str {
        std::str::from_utf8(self.bytes(name)).unwrap()
    }

    /// Runs `selvedge` without a subcommand.
    pub(crate) fn of_main_job() -> &'static Self {
        static RUN: LazyLock<Run> = LazyLock::new(|| Run::new(&["--steps", "2", "--rounds", "1"]));
        &RUN
    }

    /// Runs both parts of `selvedge accuracy`; the document goes to `rows.json`.
    pub(crate) fn of_accuracy() -> &'static Self {
        static RUN: LazyLock<Run> = LazyLock::new(|| Run::new(&[&ACCURACY[..], &["--json=rows.json"]].concat()));
        &RUN
    }
}

/// The arguments of both parts of `selvedge accuracy`, for a run that is short enough for a test.
pub(crate) const ACCURACY: [&str; 4] = ["accuracy", "--pairs=300", "--repeat=1", "--budget=0.05"];

/// Returns the keys of a JSON object, in order.
#[track_caller]
pub(crate) fn keys(value: &Value) -> Vec<&str> {
    value.as_object().unwrap().keys().map(String::as_str).collect()
}
