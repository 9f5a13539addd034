//! Builds programs in C and C++ with the system's compilers, with every warning an error, and runs them.
//!
//! `check.sh` checks more: both compilers, sanitizers, an installed library, CMake, pkg-config.

use crate::sheet;
use selvedge::{CollisionDetector, Scalar, Topology};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::LazyLock;
use std::{env, fs};
use tempfile::TempDir;

const FOLDER: &str = env!("CARGO_MANIFEST_DIR");

/// A folder with the library that cargo has just built, under the names that an installed one has.
static LIBRARY: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = TempDir::new().unwrap();
    let built = |name: &str| env::current_exe().unwrap().parent().unwrap().join(name);
    let (name, installed) = if cfg!(target_vendor = "apple") {
        ("libselvedge_c.dylib", vec!["libselvedge.dylib".to_owned()])
    } else {
        let [major, minor] = [env!("CARGO_PKG_VERSION_MAJOR"), env!("CARGO_PKG_VERSION_MINOR")];
        let names = vec!["libselvedge.so".to_owned(), format!("libselvedge.so.{major}.{minor}")];
        ("libselvedge_c.so", names)
    };
    for installed in installed {
        std::os::unix::fs::symlink(built(name), folder.path().join(installed)).unwrap();
    }
    folder
});

#[derive(Clone, Copy, PartialEq)]
enum Language {
    C,
    Cpp,
}

impl Language {
    const fn suffix(self) -> &'static str {
        match self {
            Self::C => "c",
            Self::Cpp => "cpp",
        }
    }
}

/// Returns the compiler that `CC` or `CXX` names, or the system's. Returns `None` if there is none; only C++ may lack one.
fn compiler(language: Language) -> Option<Command> {
    let (variable, default) = match language {
        Language::C => ("CC", "cc"),
        Language::Cpp => ("CXX", "c++"),
    };
    let name = env::var(variable).unwrap_or_else(|_| default.to_owned());
    if Command::new(&name).arg("--version").output().is_ok() {
        return Some(Command::new(name));
    }
    assert!(language == Language::Cpp, "{name} is missing: the tests need a C compiler");
    println!("skipped: {name} is missing, a C++ compiler");
    None
}

/// Builds a program of this crate, or of a folder outside of it.
fn build(language: Language, source: &str) -> Option<PathBuf> {
    let mut compiler = compiler(language)?;
    let standard = match language {
        Language::C => "-std=c11",
        Language::Cpp => "-std=c++17",
    };
    let suffix = language.suffix();
    let source = Path::new(FOLDER).join(format!("{source}.{suffix}"));
    let library = LIBRARY.path();
    let program = library.join(format!("{}-{suffix}", source.file_stem().unwrap().to_str().unwrap()));
    compiler.args([standard, "-pedantic", "-Wall", "-Wextra", "-Werror", "-O1", "-I"]);
    compiler.arg(format!("{FOLDER}/include")).arg(&source);
    compiler.arg("-o").arg(&program).arg("-L").arg(library);
    compiler
        .arg(format!("-Wl,-rpath,{}", library.display()))
        .args(["-lselvedge", "-lm"]);
    succeed(&mut compiler);
    Some(program)
}

fn succeed(command: &mut Command) -> Output {
    let output = command.output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{command:?}: {}\n{errors}", output.status);
    output
}

/// Writes frames to files. All numbers read back with the same bits.
fn write_frames(folder: &Path) -> Vec<PathBuf> {
    let write = |number| {
        let mut text = String::new();
        for [x, y, z] in sheet::frame(number) {
            writeln!(text, "v {x:?} {y:?} {z:?}").unwrap();
        }
        for [a, b, c] in sheet::triangles() {
            writeln!(text, "f {} {}/1/1 {}", a + 1, b + 1, c + 1).unwrap();
        }
        let path = folder.join(format!("frame-{number}.obj"));
        fs::write(&path, text).unwrap();
        path
    };
    (0..5).map(write).collect()
}

/// Returns the expected output of the examples, without the file's name and with times as their bits.
fn expected<S: Scalar>(narrowed: impl Fn(f64) -> S) -> Vec<String> {
    let frame = |number| -> Vec<[S; 3]> { sheet::frame(number).into_iter().map(|it| it.map(&narrowed)).collect() };
    let topology = Topology::new(sheet::frame(0).len(), sheet::triangles()).unwrap();
    let mut detector = CollisionDetector::<S>::new(topology.clone());
    let (mut contacts, mut lines) = (Vec::new(), Vec::new());
    for number in 0..4 {
        detector.contacts(&frame(number), &frame(number + 1), &mut contacts).unwrap();
        lines.push(format!("{} contacts", contacts.len()));
        lines.extend(contacts.iter().map(|contact| {
            let ([first, second], [a, b, c, d]) = (contact.pair, topology.vertices_of(contact.kind, contact.pair));
            let bits = contact.time.to_f64().to_bits();
            format!("{} {first} {second} vertices {a} {b} {c} {d} time {bits:x}", contact.kind)
        }));
    }
    lines
}

fn printed(program: &Path, options: &[&str], frames: &[PathBuf]) -> Vec<String> {
    let output = succeed(Command::new(program).args(options).args(frames));
    let text = String::from_utf8(output.stdout).unwrap();
    let line = |line: &str| match line.split_once(" time ") {
        Some((pair, time)) => format!("{pair} time {:x}", time.parse::<f64>().unwrap().to_bits()),
        None => line.rsplit_once(": ").unwrap().1.to_owned(),
    };
    text.lines().map(line).collect()
}

fn prints_what_rust_finds(language: Language) {
    let Some(program) = build(language, "examples/frames") else {
        return;
    };
    let folder = TempDir::new().unwrap();
    let frames = write_frames(folder.path());
    let double = expected::<f64>(|number| number);
    assert!(double.len() > 100, "{} lines show little", double.len());
    assert_eq!(printed(&program, &[], &frames), double);
    assert_eq!(
        printed(&program, &["--float"], &frames),
        expected::<f32>(|number| number as f32)
    );

    let shorter = folder.path().join("shorter.obj");
    fs::write(&shorter, "v 0 0 0\n").unwrap();
    let refused = Command::new(&program).args([&frames[0], &shorter]).output().unwrap();
    assert_eq!(refused.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("225 positions"));
}

/// Returns the expected output of the flag's examples, with coordinates as their bits, from a simulation of the scene in the C
/// example.
#[cfg(feature = "cloth")]
fn flag_in_rust() -> Vec<String> {
    use selvedge_cloth::{Scene, Simulation};
    let source = include_str!("../../examples/flag.c");
    let quoted = |line: &str| Some(line.strip_prefix("    \"")?.split_once("\\n\"")?.0.replace("\\\"", "\""));
    let scene = source.lines().filter_map(quoted).collect::<Vec<_>>().join("\n");
    let scene = Scene::parse(&scene, Path::new("flag.toml")).unwrap();
    let mut simulation = Simulation::new(scene, 1).unwrap();
    let winds = [
        [6.0, 1.0, 0.0],
        [6.0, -4.0, 0.0],
        [-5.0, 3.0, 0.0],
        [12.0, 0.0, 1.0],
        [0.0; 3],
    ];
    let topology = Topology::new(simulation.positions().len(), simulation.triangles().to_vec()).unwrap();
    let mut detector = CollisionDetector::<f64>::new(topology);
    let mut lines = Vec::new();
    for step in 0..500 {
        simulation.set_wind(winds[step / 100].into()).unwrap();
        simulation.step().unwrap();
        assert!(simulation.is_certified());
        let positions: Vec<[f64; 3]> = simulation.positions().iter().map(|it| it.to_array()).collect();
        assert!(!detector.has_intersections(&positions).unwrap(), "step {step}, exactly");
        if (step + 1) % 50 == 0 {
            let [x, y, z] = simulation.positions().last().unwrap().to_array().map(f64::to_bits);
            lines.push(format!("step {:3}: {x:x} {y:x} {z:x} certified", step + 1));
        }
    }
    lines.push("500 of 500 states are certified".to_owned());
    lines
}

#[cfg(feature = "cloth")]
fn flies_as_in_rust(language: Language) {
    let Some(program) = build(language, "examples/flag") else {
        return;
    };
    let output = succeed(&mut Command::new(program));
    let word = |word: &str| match word.parse::<f64>() {
        Ok(number) if word.contains('.') => format!("{:x}", number.to_bits()),
        _ => word.to_owned(),
    };
    let line = |line: &str| line.split(' ').map(word).collect::<Vec<_>>().join(" ");
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(text.lines().map(line).collect::<Vec<_>>(), flag_in_rust());
}

#[cfg(feature = "cloth")]
#[test]
fn the_flag_in_c_flies_as_in_rust_bit_for_bit() {
    flies_as_in_rust(Language::C);
}

#[cfg(feature = "cloth")]
#[test]
fn the_flag_in_cpp_flies_as_in_rust_bit_for_bit() {
    flies_as_in_rust(Language::Cpp);
}

#[cfg(feature = "cloth")]
#[test]
fn what_is_wrong_with_a_simulation_from_c_is_refused_and_changes_nothing() {
    runs(Language::C, "tests/programs/simulations");
}

#[cfg(feature = "cloth")]
#[test]
fn what_is_wrong_with_a_simulation_from_cpp_is_thrown_and_changes_nothing() {
    runs(Language::Cpp, "tests/programs/simulations");
}

fn runs(language: Language, source: &str) {
    if let Some(program) = build(language, source) {
        succeed(&mut Command::new(program));
    }
}

#[test]
fn the_example_in_c_prints_what_rust_finds_bit_for_bit() {
    prints_what_rust_finds(Language::C);
}

#[test]
fn the_example_in_cpp_prints_what_rust_finds_bit_for_bit() {
    prints_what_rust_finds(Language::Cpp);
}

#[test]
fn a_simulator_behind_the_guard_in_c_never_intersects_and_without_it_does() {
    let Some(program) = build(Language::C, "examples/guard") else {
        return;
    };
    let output = String::from_utf8(succeed(&mut Command::new(program)).stdout).unwrap();
    let lines: Vec<&str> = output.lines().collect();
    let intersecting = |line: &str, run: &str| -> usize {
        let counts = line.strip_prefix(run).unwrap().strip_prefix(" the guard: ").unwrap();
        counts.split(' ').next().unwrap().parse().unwrap()
    };
    assert!(intersecting(lines[0], "without") > 10, "{output}");
    assert_eq!(intersecting(lines[1], "with"), 0, "{output}");
    assert_eq!(lines[2..], ["a step to a number that is not finite is not free"]);
}

#[test]
fn a_sheet_carries_the_ball_of_an_engine_in_c() {
    let Some(program) = build(Language::C, "examples/hammock") else {
        return;
    };
    let output = String::from_utf8(succeed(&mut Command::new(program)).stdout).unwrap();
    let last = output.lines().last().unwrap();
    let (carried, certified) = last.strip_prefix("the sheet carries ").unwrap().split_once(' ').unwrap();
    let carried: f64 = carried.parse().unwrap();
    assert!((carried - 1.0).abs() < 1e-3, "{output}");
    assert_eq!(certified, "of the ball's weight; 600 of 600 states are certified");
}

#[test]
fn wrong_input_from_c_is_refused_and_changes_nothing() {
    runs(Language::C, "tests/programs/refusals");
    runs(Language::C, "tests/programs/refusals_of_worlds");
}

#[test]
fn wrong_input_from_cpp_is_thrown_and_changes_nothing() {
    runs(Language::Cpp, "tests/programs/refusals");
}

#[test]
fn a_forked_child_is_refused_what_has_threads() {
    runs(Language::C, "tests/programs/fork");
}

#[cfg(feature = "cloth")]
#[test]
fn a_forked_child_is_refused_a_simulation_that_has_threads() {
    runs(Language::C, "tests/programs/fork_simulation");
}

/// Builds the programs of a page in a language, and checks what each prints.
fn page_prints(page: &str, language: Language, expected: &[&str]) {
    let page = fs::read_to_string(format!("{FOLDER}/{page}")).unwrap();
    let folder = TempDir::new().unwrap();
    let suffix = language.suffix();
    let programs: Vec<&str> = page.split(&format!("```{suffix}\n")).skip(1).collect();
    assert_eq!(programs.len(), expected.len(), "programs in {suffix}");
    for (number, (program, expected)) in programs.iter().zip(expected).enumerate() {
        if program.contains("selvedge_cloth") && !cfg!(feature = "cloth") {
            continue;
        }
        let source = folder.path().join(format!("page-{number}"));
        fs::write(source.with_extension(suffix), program.split("```").next().unwrap()).unwrap();
        let Some(program) = build(language, source.to_str().unwrap()) else {
            continue;
        };
        let output = succeed(&mut Command::new(program));
        assert_eq!(&String::from_utf8_lossy(&output.stdout), expected);
    }
}

#[test]
fn the_programs_of_the_readme_print_what_it_says() {
    let first = "vertex 3 meets face 0 at time 0.5\nvertex 4 meets face 0 at time 0.75\nvertex 5 meets face 0 at time 1\n";
    let second = "vertex 2 comes down at x = 1.7321\n";
    let flag = "after 500 steps the corner is at -0.811 0.212 0.483, certified\n";
    page_prints("README.md", Language::C, &[first, flag]);
    page_prints("README.md", Language::Cpp, &[first, second]);
}

#[test]
fn the_program_of_the_tutorial_prints_what_it_says() {
    let text = "9 contacts\n9 vertices held back, free: yes\n";
    page_prints("../../docs/tutorials/cpp.md", Language::Cpp, &[text]);
}
