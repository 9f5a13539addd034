//! Terms of Coq for what the certified filter, the box tests and the time of impact compute, written from core's kernels.
//!
//! The proofs in `verification/proofs` are about these terms: the numbers that they compute, and the claims that their signs
//! prove.

use crate::Text;
use crate::gappa::tetrahedron;
use crate::kernels::exact;
use crate::narrowed;
use crate::symbols::{MaskStep, Step, Trace, Traced, TracedMask, if_any, trace};
use selvedge_core::kernels::advance::corners::Corners;
use selvedge_core::kernels::advance::directions::{are_apart_curving, are_apart_turning};
use selvedge_core::kernels::advance::volume::SignedVolume;
use selvedge_core::kernels::coplanarity::MovingTetrahedron;
use selvedge_core::kernels::gap;
use selvedge_core::kernels::lanes::Rounding;
use selvedge_core::kernels::points::{EdgeEdge, PairPoints, PairShape, VertexFace};
use selvedge_core::kernels::vector::Vector;
use selvedge_core::{PairKind, Scalar};
use std::collections::BTreeMap;
use std::fmt::Write;

const HEAD: &str = "\
(* What the certified filter computes: core/src/filter/certified.rs, core/src/kernels/coplanarity.rs, core/src/kernels/points.rs.
   Written from the code by verification/traced/src/coq.rs. *)
From Coq Require Import ZArith.
From Selvedge Require Import Arithmetic Expressions.

";

const BOXES_HEAD: &str = "\
(* What relative and swept boxes ask: core/src/boxes/mod.rs, core/src/boxes/relative.rs, core/src/kernels/points.rs.
   Written from the code by verification/traced/src/coq.rs. *)
From Coq Require Import ZArith.
From Selvedge Require Import Expressions Orders.

";

const ADVANCE_HEAD: &str = "\
(* What the time of impact computes: core/src/kernels/advance/corners.rs, directions.rs, volume.rs. Directions and moments have numbers.
   Written from the code by verification/traced/src/coq.rs. *)
From Coq Require Import ZArith.
From Selvedge Require Import Arithmetic Expressions Machine.
From Selvedge Require Filter.

";

const GAPS_HEAD: &str = "\
(* What the gap along a direction computes: core/src/kernels/gap.rs.
   Written from the code by verification/traced/src/coq.rs. *)
From Coq Require Import ZArith.
From Selvedge Require Import Expressions Machine.

";

/// The files that `verification/proofs` builds on.
pub fn files() -> Vec<Text> {
    [
        ("Filter.v", filter()),
        ("Boxes.v", boxes()),
        ("Advance.v", advance()),
        ("Gap.v", gaps()),
        ("Narrowed.v", narrowed::text()),
        ("Sampled.v", exact::text()),
    ]
    .map(|(name, text)| (name.to_owned(), text))
    .into()
}

fn filter() -> String {
    let mut text = String::from(HEAD);
    format::<f32>("binary32", [24, -149, 128], &mut text);
    format::<f64>("binary64", [53, -1074, 1024], &mut text);
    differences::<VertexFace>("vertex_face", "vertex, a, b, c", &mut text);
    differences::<EdgeEdge>("edge_edge", "u, v, k, l", &mut text);

    let ((values, bounds, masks), steps) = trace(|| {
        let points = tetrahedron();
        let by_permanent = points.is_never_coplanar();
        let masks = [
            // The first case has no lane that needs the permanent, the second has one.
            ("by_permanent_alone", by_permanent),
            ("by_permanent", if_any(|| points.is_never_coplanar())),
        ];
        (points.control_values().0, points.error_bounds(), masks)
    });
    let mut terms = Terms::new("expr", &steps);
    for (index, value) in values.into_iter().enumerate() {
        terms.define(&format!("control_value_{index}"), value);
    }
    for (index, bound) in bounds.into_iter().enumerate() {
        terms.define(&format!("error_bound_{index}"), bound);
    }
    for (name, mask) in masks {
        let formula = terms.mask(mask);
        writeln!(terms.text, "Definition culled_{name} : mask := {formula}.").expect("a string");
    }
    text + &terms.text
}

fn boxes() -> String {
    let mut text = String::from(BOXES_HEAD);
    box_tests::<VertexFace>("a_vertex_and_a_face", &mut text);
    box_tests::<EdgeEdge>("two_edges", &mut text);
    text
}

pub(crate) fn advance() -> String {
    let mut text = String::from(ADVANCE_HEAD);
    constants::<f32>("binary32", &mut text);
    constants::<f64>("binary64", &mut text);
    proofs_of_advance("a_vertex_and_a_face", Corners::of_vertex_face, &mut text);
    proofs_of_advance("two_edges", Corners::of_edge_edge, &mut text);
    text
}

/// Writes whether a direction keeps a pair apart by its gaps at both ends of the step, by a stored one and the one at the end,
/// and whether it is short; the gaps that are stored; and the distance that it proves.
fn gaps() -> String {
    let mut text = String::from(GAPS_HEAD);
    for (of, kind) in [
        ("a_vertex_and_a_face", PairKind::VertexFace),
        ("two_edges", PairKind::EdgeEdge),
    ] {
        let ((masks, numbers), steps) = trace(|| {
            let PairPoints { start, end } = coordinates();
            let direction = direction(0);
            let length = |name| Traced::input(format!("Length {name}"));
            let [separation, largest, slack] = ["Separation", "LargestCoordinate", "Slack"].map(length);
            let error = gap::error(largest);
            let threshold = gap::threshold(separation, error, slack);
            let limits = ["LeastGap", "LargestGap"].map(length);
            let at_end = gap::gap(kind, end, direction);
            let keeps = gap::keeps(at_end, || gap::gap(kind, start, direction), threshold);
            let (lasts, less) = gap::lasts(length("StoredGap"), || at_end - error, threshold);
            let masks = [("keeps", keeps), ("lasts", lasts), ("short", gap::is_short(direction, slack))];
            let numbers = [
                ("stored_by_keeps", gap::stored(at_end - error, slack, limits)),
                ("stored_by_lasts", gap::stored(less, slack, limits)),
                ("distance", gap::distance(at_end, slack, error)),
            ];
            (masks, numbers)
        });
        let mut terms = Terms::new("number", &steps);
        terms.input = machine_input;
        for (name, number) in numbers {
            terms.define(name, number);
        }
        let formulas = masks.map(|(name, mask)| (name, terms.mask(mask)));
        writeln!(text, "Module {of}.\n{}", terms.text.trim_end()).expect("a string");
        for (name, formula) in formulas {
            writeln!(text, "Definition {name} : mask := {formula}.").expect("a string");
        }
        writeln!(text, "End {of}.\n").expect("a string");
    }
    text
}

pub(crate) fn machine_input(name: &str) -> String {
    match name.split(' ').next() {
        Some("Coordinate") => format!("Input (Place ({name}))"),
        _ => format!("Input ({name})"),
    }
}

/// The exponents of the constants that only the time of impact has.
fn constants<S: Scalar>(name: &str, text: &mut String) {
    let constants = [S::EXTENT_UNDERFLOW, S::LARGEST_EXTENT, S::SAFE_SQUARE, S::LENGTH_UNDERFLOW];
    let [underflow, largest, square, length] = constants.map(|constant| exponent(constant.to_f64()));
    writeln!(
        text,
        "Definition {name} := Constants Filter.{name} ({underflow}) {largest} ({square}) ({length})."
    )
    .expect("a string");
}

/// Writes the assumptions and results of each proof of one round, for corners in range.
fn proofs_of_advance<const N: usize>(of: &str, corners: fn(&PairPoints<Traced>) -> Corners<Traced, N>, text: &mut String) {
    let ((margins, masks, times), steps) = trace(|| {
        let corners = corners(&coordinates());
        let in_range = corners.are_in_range();
        let moments = [0, 1].map(|number| Traced::input(format!("Moment {number}")));
        let [now, later] = moments.map(|moment| corners.at(moment));
        let [first, second, third] = [0, 1, 2].map(|number| corners.direction(direction(number)));
        let held = corners.apart_along(&first, &now, in_range);
        let volume = SignedVolume::new(&corners);
        let margins = volume.margins_from(moments[0]);
        let clipped = volume.clipped(moments[0]);
        let masks = [
            ("in_range", in_range),
            ("held", held.is_apart),
            ("turning", are_apart_turning(&first, &now, &second, &later)),
            ("curving", are_apart_curving(&[first, second, third], &now, &later)),
            ("volume_throughout", volume.proves_apart_throughout()),
            ("volume_to_the_end", clipped.to_the_end),
        ];
        let times = [("held", held.until), ("volume", clipped.until)];
        (margins, masks, times)
    });
    let mut terms = Terms::new("number", &steps);
    terms.input = machine_input;
    for (index, margin) in margins.into_iter().enumerate() {
        terms.define_for_use(&format!("margin_{index}"), margin);
    }
    for (name, mask) in masks {
        let formula = terms.mask(mask);
        writeln!(terms.text, "Definition {name} : mask := {formula}.").expect("a string");
    }
    for (name, time) in times {
        terms.define(&format!("until_{name}"), time);
    }
    writeln!(text, "Module {of}.\n{}End {of}.\n", terms.text).expect("a string");
}

fn box_tests<P: PairShape>(of: &str, text: &mut String) {
    let (masks, steps) = trace(|| {
        let points = coordinates();
        [
            ("swept_boxes", points.have_disjoint_swept_boxes::<P>()),
            ("three_axes", points.are_apart_along_three_axes::<P>()),
        ]
    });
    let mut terms = Terms::new("number", &steps);
    let formulas = masks.map(|(name, mask)| (name, terms.mask(mask)));
    writeln!(text, "Module {of}.\n{}", terms.text.trim_end()).expect("a string");
    for (name, formula) in formulas {
        writeln!(text, "Definition culled_by_{name} := {formula}.").expect("a string");
    }
    writeln!(text, "End {of}.\n").expect("a string");
}

/// A direction that is tried.
pub(crate) fn direction(number: usize) -> Vector<Traced> {
    Vector::from(["X", "Y", "Z_"].map(|axis| Traced::input(format!("Along {number} {axis}"))))
}

/// A pair's 24 coordinates.
pub(crate) fn coordinates() -> PairPoints<Traced> {
    let points = |end: &str| {
        [0, 1, 2, 3]
            .map(|point| Vector::from(["X", "Y", "Z_"].map(|axis| Traced::input(format!("Coordinate {point} {end} {axis}")))))
    };
    PairPoints {
        start: points("Start"),
        end: points("End"),
    }
}

fn exponent(power_of_two: f64) -> i32 {
    let exponent = power_of_two.log2();
    assert_eq!(exponent.exp2(), power_of_two);
    exponent as i32
}

/// The three numbers are the format's by definition; the other two are core's constants.
fn format<S: Scalar>(name: &str, [precision, least, greatest]: [i32; 3], text: &mut String) {
    assert_eq!(<S as Rounding>::UNIT_ROUNDOFF.to_f64(), f64::from(-precision).exp2());
    let underflow = exponent(S::UNDERFLOW.to_f64());
    let largest_edge = exponent(S::LARGEST_EDGE.to_f64());
    writeln!(
        text,
        "Definition {name} := Format {precision} ({least}) {greatest} ({underflow}) {largest_edge}."
    )
    .expect("a string");
}

/// Returns the coordinates of each difference, the subtracted one second.
fn differences<P: PairShape>(name: &str, order: &str, text: &mut String) {
    let (differences, steps) = trace(|| {
        let points = coordinates();
        let MovingTetrahedron { b, c, p } = points.tetrahedron::<P>();
        [b, c, p]
    });
    let input = |number: Traced| match step(number, &steps) {
        Step::Input(name) => name.clone(),
        other => panic!("{other:?} is no coordinate"),
    };
    writeln!(text, "\n(* Points 0 to 3 are {order}. *)").expect("a string");
    writeln!(text, "Definition {name} c := match c with").expect("a string");
    for (edge, ends) in ["B", "C", "P"].into_iter().zip(differences) {
        for (end, vector) in ["Start", "End"].into_iter().zip(ends) {
            for (axis, difference) in [("X", vector.x), ("Y", vector.y), ("Z_", vector.z)] {
                let Step::Difference(to, from) = step(difference, &steps) else {
                    panic!("no difference")
                };
                let (to, from) = (input(*to), input(*from));
                writeln!(text, "| Component {edge} {end} {axis} => ({to}, {from})").expect("a string");
            }
        }
    }
    writeln!(text, "end.\n").expect("a string");
}

fn step(number: Traced, trace: &Trace) -> &Step {
    match number {
        Traced::Step(index) => &trace.steps[index],
        other => panic!("{other:?} is no step"),
    }
}

/// Writes definitions of the terms that are used, each once.
pub(crate) struct Terms<'a> {
    trace: &'a Trace,
    names: BTreeMap<String, String>,
    /// The names of steps and masks whose terms are written.
    steps: BTreeMap<usize, String>,
    masks: BTreeMap<usize, String>,
    number_type: &'static str,
    /// Returns the term of an input from its name.
    pub(crate) input: fn(&str) -> String,
    pub(crate) text: String,
}

impl<'a> Terms<'a> {
    pub(crate) fn new(number_type: &'static str, trace: &'a Trace) -> Self {
        Self {
            trace,
            names: BTreeMap::new(),
            steps: BTreeMap::new(),
            masks: BTreeMap::new(),
            number_type,
            input: leaf,
            text: String::new(),
        }
    }

    pub(crate) fn define(&mut self, name: &str, number: Traced) {
        let term = self.number(number);
        writeln!(self.text, "Definition {name} : {} := {term}.", self.number_type).expect("a string");
    }

    /// Defines a number whose name stands for it in all that follows. So what follows is compared without it.
    pub(crate) fn define_for_use(&mut self, name: &str, number: Traced) {
        self.define(name, number);
        let term = self.number(number);
        for known in self.names.values_mut().chain(self.steps.values_mut()) {
            if *known == term {
                name.clone_into(known);
            }
        }
    }

    /// Returns the name of a term, and defines the term if it has none.
    fn named(&mut self, letter: char, kind: &str, term: String) -> String {
        if let Some(name) = self.names.get(&term) {
            return name.clone();
        }
        let name = format!("{letter}{}", self.names.len());
        writeln!(self.text, "Definition {name} : {kind} := {term}.").expect("a string");
        self.names.insert(term, name.clone());
        name
    }

    fn number(&mut self, number: Traced) -> String {
        let Traced::Step(index) = number else {
            return match number {
                Traced::Small(count) => format!("(Constant (Small {count}))"),
                Traced::Infinity => panic!("{number:?} is not known to the proof"),
                _ => format!("(Constant {number:?})"),
            };
        };
        if let Some(name) = self.steps.get(&index) {
            return name.clone();
        }
        let term = match self.trace.steps[index].clone() {
            Step::Input(name) => (self.input)(&name),
            Step::Sum(a, b) => self.operation("Sum", a, b),
            Step::Difference(a, b) => self.operation("Minus", a, b),
            Step::Product(a, b) => self.operation("Product", a, b),
            Step::Quotient(a, b) => self.operation("Quotient", a, b),
            Step::Larger(a, b) => self.operation("Larger", a, b),
            Step::Smaller(a, b) => self.operation("Smaller", a, b),
            Step::Negative(a) => format!("Negative {}", self.number(a)),
            Step::Magnitude(a) => format!("Magnitude {}", self.number(a)),
            Step::Selected(mask, a, b) => {
                let mask = self.mask(mask);
                let (a, b) = (self.number(a), self.number(b));
                format!("Select {mask} {a} {b}")
            }
            Step::Root(a) => format!("Root {}", self.number(a)),
        };
        let name = self.named('s', self.number_type, term);
        self.steps.insert(index, name.clone());
        name
    }

    fn operation(&mut self, name: &str, a: Traced, b: Traced) -> String {
        let (a, b) = (self.number(a), self.number(b));
        format!("{name} {a} {b}")
    }

    pub(crate) fn mask(&mut self, mask: TracedMask) -> String {
        if let Some(name) = self.masks.get(&mask.index) {
            return name.clone();
        }
        let term = match self.trace.masks[mask.index] {
            MaskStep::Greater(Traced::Infinity, _) => return "Finite".to_owned(),
            MaskStep::Greater(a, b) => {
                let (a, b) = (self.number(a), self.number(b));
                return format!("(Greater {a} {b})");
            }
            MaskStep::And(a, b) => {
                let (a, b) = (self.mask(a), self.mask(b));
                format!("(Both {a} {b})")
            }
            MaskStep::Or(a, b) => {
                let (a, b) = (self.mask(a), self.mask(b));
                format!("(Either {a} {b})")
            }
            MaskStep::Not(a) => format!("(Not {})", self.mask(a)),
            other => panic!("{other:?} is not known to the proof"),
        };
        self.masks.insert(mask.index, term.clone());
        term
    }
}

/// Returns the term of an input from its name: a coordinate's name, or one like `b0x`.
fn leaf(name: &str) -> String {
    if name.starts_with("Coordinate") {
        return format!("Value ({name})");
    }
    let [edge, end, axis] = name.as_bytes() else {
        panic!("{name} is no component")
    };
    let edge = char::from(edge.to_ascii_uppercase());
    let end = if *end == b'0' { "Start" } else { "End" };
    let axis = match axis {
        b'x' => "X",
        b'y' => "Y",
        _ => "Z_",
    };
    format!("Difference (Component {edge} {end} {axis})")
}
