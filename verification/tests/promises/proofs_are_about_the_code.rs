//! The proofs in `gappa/` are about core as it is: scripts are what its code gives, constants and counts of roundings in them
//! are its own. That the proofs hold is checked by `gappa/check.sh`.

use selvedge_core::points::{EdgeAndEdge, PairShape, VertexAndFace};
use selvedge_core::{Rounding, Scalar};
use selvedge_verification::proofs::{inside, scripts, tetrahedron};
use selvedge_verification::traced::{Paths, Traced, trace};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("gappa")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The scripts that are written by hand.
fn by_hand() -> Vec<(String, String)> {
    let entries = fs::read_dir(folder()).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let scripts = paths.filter(|path| path.extension().is_some_and(|extension| extension == "g"));
    let named = |path: PathBuf| (path.display().to_string(), read(&path));
    scripts.map(named).collect()
}

/// `UPDATE_PROOFS=1 cargo test` writes them anew.
#[test]
fn traced_scripts_are_what_the_code_gives() {
    let traced = folder().join("traced");
    let scripts = scripts();
    for (name, text) in &scripts {
        let path = traced.join(name);
        if std::env::var_os("UPDATE_PROOFS").is_some() {
            fs::write(&path, text).expect("a folder that can be written");
        }
        assert!(
            read(&path) == *text,
            "{name} is not what the code gives; UPDATE_PROOFS=1 writes it anew"
        );
    }
    assert_eq!(fs::read_dir(traced).expect("a folder").count(), scripts.len());
}

/// Marked by `#!` (with the number, of which half is not enough) or `#~`: the file, and what stands in it.
#[test]
fn constants_of_the_scripts_are_those_of_the_code() {
    let one_spaced = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut marked = 0;
    for (name, text) in by_hand() {
        for line in text.lines() {
            let Some(mark) = line.find("#!").or_else(|| line.find("#~")) else {
                continue;
            };
            let (path, code) = line[mark + 2..].split_once(": ").expect("a file and its code");
            let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path.trim());
            // Comments of lines in between do not count.
            let source: String = read(&source)
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"))
                .map(|line| format!("{line}\n"))
                .collect();
            assert!(
                one_spaced(&source).contains(&one_spaced(code)),
                "{name}: {path} has no `{code}` any more"
            );
            if line[mark..].starts_with("#!") {
                let (_, number) = line[..mark].split_once('=').expect("a definition");
                let number = number.trim().trim_end_matches(';');
                let called = ["small", "roundoffs", "constant"].map(|name| format!("{name}({number})"));
                assert!(
                    called.iter().any(|call| code.contains(call)),
                    "{name}: {number} is not the constant of `{code}`"
                );
            }
            marked += 1;
        }
    }
    assert!(marked > 30, "only {marked} constants are marked");
}

fn exponents(format: &str) -> BTreeMap<String, i32> {
    let text = read(&folder().join("formats").join(format).with_extension("sed"));
    let rules = text.lines().filter_map(|line| line.strip_prefix("s/@"));
    rules
        .map(|rule| {
            let (name, rest) = rule.split_once("@/").expect("a name");
            let exponent = rest.strip_suffix("/g").expect("a rule").parse().expect("an exponent");
            (name.to_owned(), exponent)
        })
        .collect()
}

fn constants_are_those_of<S: Scalar>(smallest_normal: f64, digits: i32, infinity: f64) {
    let exponents = exponents(S::NAME);
    let power = |name: &str| 2.0_f64.powi(exponents[name]);
    assert_eq!(power("u"), <S as Rounding>::UNIT_ROUNDOFF.to_f64());
    assert_eq!(power("eta"), S::UNDERFLOW.to_f64());
    assert_eq!(power("edge"), S::LARGEST_EDGE.to_f64());
    assert_eq!(power("gap"), S::SUM_GAP.to_f64());
    assert_eq!(power("lambda"), smallest_normal);
    assert_eq!(power("max"), infinity);
    assert_eq!(exponents["u"], -digits);
    assert_eq!(exponents["gap16"], exponents["gap"] - exponents["u"] - 4);
}

#[test]
fn constants_of_the_formats_are_those_of_core() {
    constants_are_those_of::<f32>(f32::MIN_POSITIVE.into(), 24, 2.0_f64.powi(128));
    constants_are_those_of::<f64>(f64::MIN_POSITIVE, 53, f64::INFINITY);
    // Those of core/src/elementary, in the order in which they stand in its source.
    for (name, code) in [
        ("mu", "let vanishing = of_format::<S>(-100, -960);"),
        ("extent", "of_format(29, 250)"),
        ("length", "areas + of_format(-62, -510)"),
        ("squares", "if squared > of_format(-100, -900) {"),
    ] {
        let [single, double] = ["f32", "f64"].map(|format| exponents(format)[name]);
        let pair = format!("({single}, {double})");
        assert!(code.contains(&pair), "{name}");
        assert!(
            by_hand().iter().any(|(_, text)| text.contains(code)),
            "{name}: no script says where"
        );
    }
}

/// The differences of points are the traces' inputs, each rounded once: three to a monomial.
const OF_DIFFERENCES: u32 = 3;

fn most(paths: &Paths) -> u32 {
    paths.values().max().expect("a monomial") + OF_DIFFERENCES
}

/// `#= NAME COUNT OF_BOUND` in a script: roundings of a control value but for its last addition, and of its bound.
fn counts_in(script: &str, name: &str) -> [u32; 2] {
    let script = read(&folder().join(script));
    let prefix = format!("#= {name} ");
    let line = script.lines().find_map(|line| line.strip_prefix(&prefix));
    let mut counts = line
        .expect("a line of counts")
        .split(' ')
        .map(|count| count.parse().expect("a count"));
    [counts.next(), counts.next()].map(|count| count.expect("two counts"))
}

#[test]
fn roundings_are_as_many_as_the_scripts_say() {
    let (values, of_values) = trace(|| tetrahedron().control_values().0);
    let (bounds, of_bounds) = trace(|| tetrahedron().error_bounds());
    for (index, name, monomials) in [(0, "k0", 6), (1, "3k1", 18), (2, "3k1", 18), (3, "k0", 6)] {
        let [of_value, of_bound] = counts_in("coplanarity.g", name);
        let paths = of_values.paths_but_last(values[index]);
        assert_eq!(paths.len(), monomials);
        assert_eq!(most(&paths), of_value, "{name}");
        let whole = of_values.paths(values[index]);
        assert_eq!(most(&whole), of_value + 1, "{name}");
        assert!(most(&whole) <= 10, "volume.g counts on it");

        // The same monomials, all of them, times the constant and u; and the term for underflow, which has three roundings of
        // 1 + M, two products and the sum. A separation adds one.
        let bound = of_bounds.paths(bounds[index]);
        let constant = if monomials == 6 { "16" } else { "20" };
        let counts = paths.keys().map(|monomial| {
            let mut scaled = [monomial.as_slice(), &[constant.to_owned(), "u".to_owned()]].concat();
            scaled.sort();
            let count = bound.get(&scaled);
            count.unwrap_or_else(|| panic!("{scaled:?} is not in the bound of {name}"))
        });
        let with_separation = 1;
        let most = counts.max().map(|most| most + OF_DIFFERENCES + with_separation);
        assert_eq!(most, Some(of_bound), "{name}");
        let underflow = bound
            .iter()
            .filter(|(monomial, _)| monomial.contains(&format!("{:?}", Traced::Underflow)));
        let counts: Vec<u32> = underflow.map(|(_, &count)| count).collect();
        assert!(!counts.is_empty() && counts.iter().all(|&count| count < 6), "{counts:?}");
    }
}

/// Of one kind of pair: the monomials of each control value of an inside function have at most as many roundings as `inside.g` says.
fn roundings_of_inside_functions<P: PairShape>() -> [[u32; 2]; 5] {
    // Each monomial has four differences of points.
    const OF_FOUR_DIFFERENCES: u32 = 4;
    let (values, trace) = inside::<P>();
    let names = ["first", "second", "third", "second", "first"];
    let mut counts = [[0; 2]; 5];
    for (index, ([value, bound], name)) in values.into_iter().zip(names).enumerate() {
        let [of_value, of_bound] = counts_in("inside.g", name);
        let value = trace.paths_but_last(value);
        // A multiple of every product of two components of A.
        let bound = trace.paths(bound);
        let most = |paths: &Paths| *paths.values().max().expect("a monomial");
        counts[index] = [most(&value) + OF_FOUR_DIFFERENCES, most(&bound)];
        assert!(counts[index][0] <= of_value, "{name}: {counts:?}");
        assert!(counts[index][1] <= of_bound, "{name}: {counts:?}");
    }
    counts
}

#[test]
fn roundings_of_inside_functions_are_as_many_as_the_script_says() {
    let (faces, edges) = (
        roundings_of_inside_functions::<VertexAndFace>(),
        roundings_of_inside_functions::<EdgeAndEdge>(),
    );
    // No more than that: a script that said too many would prove less than it could.
    let most = |[a, b]: [u32; 2], [c, d]: [u32; 2]| [a.max(c), b.max(d)];
    for (index, name) in ["first", "second", "third"].into_iter().enumerate() {
        let counted = most(faces[index], edges[index]);
        assert_eq!(counted, counts_in("inside.g", name), "{name}");
    }
}
