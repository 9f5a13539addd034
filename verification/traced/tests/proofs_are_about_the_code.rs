//! The proofs in `gappa/` and `proofs/` are about the present code of core. They read what it gives, and the constants and counts
//! of roundings in scripts are the code's. `gappa/check.sh` and `proofs/check.sh` check that the proofs hold.

use selvedge_core::Scalar;
use selvedge_core::kernels::advance::confirm::{contains_origin, doubled_bounds};
use selvedge_core::kernels::advance::corners::Corners;
use selvedge_core::kernels::advance::directions::{are_apart_curving, are_apart_turning};
use selvedge_core::kernels::advance::volume::SignedVolume;
use selvedge_core::kernels::lanes::Rounding;
use selvedge_core::kernels::points::PairPoints;
use selvedge_core::kernels::vector::Vector;
use selvedge_traced::gappa::tetrahedron;
use selvedge_traced::symbols::{Paths, Trace, Traced, TracedMask, trace};
use selvedge_traced::{Prover, accepted};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../gappa")
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

#[test]
fn what_gappa_reads_is_what_was_accepted() {
    accepted::check(Prover::Gappa).unwrap_or_else(|why| panic!("{why}"));
}

/// The terms that `proofs/Theorems.v` is about.
#[test]
fn what_coq_reads_is_what_was_accepted() {
    accepted::check(Prover::Coq).unwrap_or_else(|why| panic!("{why}"));
}

#[test]
fn a_term_that_has_changed_is_named() {
    let list = accepted::list();
    let of_coq = |list: &str| -> Vec<String> {
        list.lines()
            .filter(|line| line.contains("  coq/"))
            .map(str::to_owned)
            .collect()
    };
    assert_eq!(accepted::compare(Prover::Coq, &of_coq(&list), &list), Ok(()));

    let mut changed = of_coq(&list);
    let line = changed
        .iter_mut()
        .find(|line| line.ends_with("Boxes.v two_edges.culled_by_three_axes"));
    line.expect("a term").replace_range(..1, "g");
    let complaint = accepted::compare(Prover::Coq, &changed, &list).expect_err("another digest");
    let named: Vec<&str> = complaint.lines().filter_map(|line| line.strip_prefix("    ")).collect();
    assert_eq!(named, ["coq/Boxes.v two_edges.culled_by_three_axes"]);

    let fewer = &of_coq(&list)[1..];
    let complaint = accepted::compare(Prover::Coq, fewer, &list).expect_err("a term is missing");
    assert!(complaint.contains("(removed)"), "{complaint}");
}

/// Lines marked by `#!` (with the number, half of which does not suffice) or `#~`: the file and the line.
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
            let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path.trim());
            // Comment lines in between do not count.
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
                let called = ["small(", "constant(", ", "].map(|before| format!("{before}{number})"));
                let is_factor = code.contains(&format!("{number}.0 * "));
                assert!(
                    is_factor || called.iter().any(|call| code.contains(call)),
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
    assert_eq!(power("extent"), S::LARGEST_EXTENT.to_f64());
    assert_eq!(power("mu"), S::EXTENT_UNDERFLOW.to_f64());
    assert_eq!(power("squares"), S::SAFE_SQUARE.to_f64());
    assert_eq!(power("length"), S::LENGTH_UNDERFLOW.to_f64());
    assert_eq!(power("lambda"), smallest_normal);
    assert_eq!(power("max"), infinity);
    assert_eq!(exponents["u"], -digits);
}

#[test]
fn constants_of_the_formats_are_those_of_core() {
    constants_are_those_of::<f32>(f32::MIN_POSITIVE.into(), 24, 2.0_f64.powi(128));
    constants_are_those_of::<f64>(f64::MIN_POSITIVE, 53, f64::INFINITY);
}

/// The inputs of the traces are differences of points, each rounded once, and a monomial has three.
const OF_DIFFERENCES: u32 = 3;

fn most(paths: &Paths) -> u32 {
    paths.values().max().expect("a monomial") + OF_DIFFERENCES
}

/// Checks `#= NAME COUNT OF_BOUND` in a script: the roundings of a control value except its last addition, and of its bound.
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

        // The same monomials, all of them, times the constant and u. The term for underflow has three roundings: those of 1 + M,
        // two products and the sum, of which a separation adds one.
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

/// `#= NAME COUNT OF_BOUND CONSTANT` in a script of the time of impact.
fn advance_counts_in(script: &str, name: &str) -> [u32; 3] {
    let script = read(&folder().join(script));
    let prefix = format!("#= {name} ");
    let line = script
        .lines()
        .find_map(|line| line.strip_prefix(&prefix))
        .expect("a line of counts");
    let counts: Vec<u32> = line.split(' ').map(|count| count.parse().expect("a count")).collect();
    counts.try_into().expect("three counts")
}

/// Returns the most roundings of a value's monomials and of its bound's, and the constant by which u is multiplied in all of
/// these. `differences` is the number of rounded differences of points in a monomial of the value.
fn counted(trace: &Trace, value: Traced, bound: Traced, differences: u32) -> [u32; 3] {
    let of_error = |monomial: &[String]| monomial.iter().any(|factor| factor == "u");
    let is_constant = |factor: &&String| factor.parse::<u32>().is_ok();
    let of_value = trace.paths(value).into_iter();
    let of_value =
        of_value.filter(|(monomial, _)| !of_error(monomial) && !monomial.contains(&format!("{:?}", Traced::Underflow)));
    let of_value = of_value.map(|(_, count)| count).max().expect("a monomial") + differences;
    let bound = trace.paths(bound);
    let of_bound = bound.iter().filter(|(monomial, _)| of_error(monomial));
    let constants = of_bound.clone().map(|(monomial, _)| {
        let constants: Vec<u32> = monomial
            .iter()
            .filter(is_constant)
            .map(|factor| factor.parse().expect("a number"))
            .collect();
        assert_eq!(constants.len(), 1, "{monomial:?}");
        constants[0]
    });
    let constants: Vec<u32> = constants.collect();
    assert!(constants.iter().all(|&constant| constant == constants[0]), "{constants:?}");
    [
        of_value,
        *of_bound.map(|(_, count)| count).max().expect("a bound"),
        constants[0],
    ]
}

fn vector(name: &str) -> Vector<Traced> {
    Vector::from(["x", "y", "z"].map(|axis| Traced::input(format!("{name}{axis}"))))
}

fn edge_edge_corners() -> Corners<Traced, 4> {
    let points = |end: u32| ["p", "a", "b", "c"].map(|name| vector(&format!("{name}{end}")));
    let points = PairPoints {
        start: points(0),
        end: points(1),
    };
    Corners::of_edge_edge(&points)
}

#[test]
fn roundings_of_a_direction_are_as_many_as_the_script_says() {
    let (bar, mut constant) = trace(|| {
        let corners = edge_edge_corners();
        let direction = corners.direction(vector("w"));
        let positions = corners.at(Traced::input("t"));
        let _ = corners.apart_along(&direction, &positions, TracedMask::always());
        direction.bar
    });
    constant.begin_with_differences();
    // At the time, at the end, at the start and at the end, for each corner.
    for corner in constant.comparisons.chunks(4) {
        let &[[now, bar_now], [end, bar_end], [at_start, at_end], _] = corner else {
            panic!("{corner:?}")
        };
        assert_eq!([bar_now, bar_end, end], [bar, bar, at_end]);
        assert_eq!(counted(&constant, now, bar, 1), advance_counts_in("corners.g", "product"));
        for value in [at_start, at_end] {
            assert_eq!(counted(&constant, value, bar, 1), advance_counts_in("corners.g", "line"));
        }
    }

    let (_, mut turning) = trace(|| {
        let corners = edge_edge_corners();
        let [before, after] = ["v", "w"].map(|name| corners.direction(vector(name)));
        let [from, to] = ["s", "t"].map(|name| corners.at(Traced::input(name)));
        are_apart_turning(&before, &from, &after, &to)
    });
    turning.begin_with_differences();
    // The first comparison is with zero.
    for corner in turning.comparisons[1..].chunks(3) {
        let &[_, _, [value, bar]] = corner else { panic!("{corner:?}") };
        assert_eq!(counted(&turning, value, bar, 1), advance_counts_in("corners.g", "turning"));
    }

    let (_, mut curving) = trace(|| {
        let corners = edge_edge_corners();
        let curve = ["u", "v", "w"].map(|name| corners.direction(vector(name)));
        let [from, to] = ["s", "t"].map(|name| corners.at(Traced::input(name)));
        are_apart_curving(&curve, &from, &to)
    });
    curving.begin_with_differences();
    for corner in curving.comparisons[1..].chunks(4) {
        let &[_, _, first, second] = corner else {
            panic!("{corner:?}")
        };
        for [value, bar] in [first, second] {
            assert_eq!(counted(&curving, value, bar, 1), advance_counts_in("corners.g", "curving"));
        }
    }
}

#[test]
fn roundings_of_the_volume_are_as_many_as_the_script_says() {
    let ((at, margins, error), mut steps) = trace(|| {
        let volume = SignedVolume::new(&edge_edge_corners());
        let time = Traced::input("t");
        (volume.at(time), volume.margins_from(time), volume.error)
    });
    steps.begin_with_differences();
    let counts = margins.map(|margin| counted(&steps, margin, error, OF_DIFFERENCES));
    let [most, of_bound, constant] = counts.into_iter().max().expect("four margins");
    // Looking ahead, by the rule that leads to the margins and to the value at a time, rounds at most 9 times. A monomial of 3k1
    // has t itself once among its weights, which is one rounding less than 1 − t.
    let [value, ..] = counted(&steps, at, error, OF_DIFFERENCES);
    assert_eq!(value, 12 + 8);
    assert_eq!([most + 9, of_bound, constant], advance_counts_in("volume.g", "volume"));
}

#[test]
fn roundings_of_a_confirmed_contact_are_as_many_as_the_script_says() {
    let (_, mut steps) = trace(|| {
        let corners = edge_edge_corners();
        let [start, end] = ["s", "t"].map(|name| corners.at(Traced::input(name)));
        let [xy, ..] = doubled_bounds(corners.extent);
        contains_origin(&start, &end, |v| [v.x, v.y], xy)
    });
    steps.begin_with_differences();
    let of_a_difference_each = 2;
    let counts = steps.comparisons[1..].iter();
    let counts = counts.map(|&[value, bound]| counted(&steps, value, bound, of_a_difference_each));
    assert_eq!(counts.max(), Some(advance_counts_in("confirm.g", "confirm")));
}
