//! Gappa scripts for the computations of core's kernels, written from the kernels themselves.
//!
//! `verification/gappa/README.md` lists the proven claims. In the scripts `@u@` and similar marks stand for a format's exponents.

use crate::Text;
use crate::symbols::{Step, Trace, Traced, trace};
use selvedge_core::PairKind;
use selvedge_core::kernels::coplanarity::MovingTetrahedron;
use selvedge_core::kernels::vector::Vector;
use std::collections::BTreeSet;
use std::fmt::Write;

/// The claims about one control value, in multiples of u and of λ.
struct Claim {
    name: &'static str,
    index: usize,
    /// The rounding error, if all components are at most 1.
    roundoffs: u32,
    /// The error that underflow in its steps adds.
    of_steps: u32,
    /// The error that underflow in the three differences of points adds.
    of_differences: u32,
}

const CONTROL_VALUES: [Claim; 4] = [
    Claim {
        name: "k0",
        index: 0,
        roundoffs: 95,
        of_steps: 17,
        of_differences: 55,
    },
    Claim {
        name: "3k1",
        index: 1,
        roundoffs: 380,
        of_steps: 41,
        of_differences: 163,
    },
    Claim {
        name: "3k2",
        index: 2,
        roundoffs: 380,
        of_steps: 41,
        of_differences: 163,
    },
    Claim {
        name: "k3",
        index: 3,
        roundoffs: 95,
        of_steps: 17,
        of_differences: 55,
    },
];

/// Returns all scripts.
pub fn scripts() -> Vec<Text> {
    let (values, steps) = trace(|| tetrahedron().control_values().0);
    let mut scripts: Vec<Text> = CONTROL_VALUES
        .iter()
        .map(|claim| control_value(claim, values[claim.index], &steps))
        .collect();
    for (kind, name) in [
        (PairKind::VertexFace, "normal-vertex-face"),
        (PairKind::EdgeEdge, "normal-edge-edge"),
    ] {
        let (length, steps) = trace(|| tetrahedron().largest_normal(kind));
        scripts.push(normal(name, length, &steps));
    }
    scripts
}

/// Runs a kernel with 18 inputs: the differences of points, as computed.
pub fn tetrahedron() -> MovingTetrahedron<Traced> {
    let edge =
        |name: &str| [0, 1].map(|end| Vector::from(["x", "y", "z"].map(|axis| Traced::input(format!("{name}{end}{axis}")))));
    MovingTetrahedron {
        b: edge("b"),
        c: edge("c"),
        p: edge("p"),
    }
}

fn control_value(claim: &Claim, value: Traced, trace: &Trace) -> Text {
    let script = Writer::new(trace, value);
    let name = claim.name;
    let Traced::Step(last) = value else { unreachable!("a sum") };
    let Step::Sum(a, b) = trace.steps[last] else {
        unreachable!("a sum")
    };
    let [(a, exact_a, q_a, x_a), (b, exact_b, q_b, x_b)] = [a, b].map(|x| {
        (
            rounded(x, trace),
            exact(x, trace),
            by_steps(x, trace),
            by_differences(x, trace),
        )
    });
    let Claim {
        roundoffs,
        of_steps,
        of_differences,
        ..
    } = claim;
    let text = format!(
        "\
# The control value {name}: core/src/kernels/coplanarity.rs, MovingTetrahedron::control_values.
# Written from the code by verification/traced/src/gappa.rs.
#
# Each difference of points (b0x, …) is at most 1 as computed: errors scale with each of the three edges, or axes. Its relative
# error is at most 2u. A lower-case name is the result of one rounded step, the same in capitals is exact. The last addition
# does not count: the value is compared with a floating-point number.
#
# What underflow adds, in units of L, which is at most lambda: q… by a step that loses up to 1 (its own) and passes on what it
# was given, x… by differences that are off by up to 3. Both are of degree 2 at most in the components, hence in 1 + M.
{definitions}
{{ {hypotheses}
->  ({a} + {b}) - ({exact_a} + {exact_b}) in [-{roundoffs}b@u@, {roundoffs}b@u@]
/\\ {q_a} + {q_b} in [-{of_steps}, {of_steps}]
/\\ {x_a} + {x_b} in [-{of_differences}, {of_differences}] }}
",
        definitions = script.definitions + &script.underflow,
        hypotheses = (script.hypotheses + &script.underflow_hypotheses).trim_start_matches("\n/\\ "),
    );
    (format!("{name}.g"), text)
}

fn normal(name: &str, length: Traced, trace: &Trace) -> Text {
    let components = normal_components(length, trace);
    let mut script = Writer::default();
    for &component in components.iter().flatten() {
        script.add(trace, component);
    }
    let mut goals = Vec::new();
    for (control_point, of_point) in components.iter().enumerate() {
        // The middle control point is doubled.
        let bound = if control_point == 1 { 120 } else { 60 };
        for &component in of_point {
            let (rounded, exact) = (rounded(component, trace), exact(component, trace));
            goals.push(format!("{rounded} - {exact} in [-{bound}b@u@, {bound}b@u@]"));
        }
    }
    let text = format!(
        "\
# The control points of the normal: core/src/kernels/coplanarity.rs, MovingTetrahedron::largest_normal.
# Written from the code by verification/traced/src/gappa.rs.
#
# Names and scale as in k0.g. Three components each of n0, h (twice the middle one) and n1: a component is off by at most 60u,
# the vector by sqrt(3) times that.
{definitions}
{{ {hypotheses}
->  {goals} }}
",
        definitions = script.definitions,
        hypotheses = script.hypotheses.trim_start_matches("\n/\\ "),
        goals = goals.join("\n/\\ "),
    );
    (format!("{name}.g"), text)
}

/// Reads n₀, h and n₁ off (√(larger(larger(n₀·n₀, ¼ h·h), n₁·n₁) + η) + …)·….
fn normal_components(length: Traced, trace: &Trace) -> [[Traced; 3]; 3] {
    use Step::{Larger, Product, Root, Sum};
    let step = |x: Traced| match x {
        Traced::Step(index) => trace.steps[index].clone(),
        other => panic!("{other:?} is no step"),
    };
    macro_rules! taken_apart {
        ($x:expr, $shape:pat $(if $condition:expr)? => $parts:expr) => {
            match step($x) {
                $shape $(if $condition)? => $parts,
                other => panic!("{other:?} is not the length that was proven"),
            }
        };
    }
    let sum = taken_apart!(length, Product(sum, _) => sum);
    let root = taken_apart!(sum, Sum(root, _) => root);
    let squared = taken_apart!(root, Root(squared) => squared);
    let largest = taken_apart!(squared, Sum(largest, Traced::Underflow) => largest);
    let (first_two, third) = taken_apart!(largest, Larger(two, one) => (two, one));
    let (first, halved) = taken_apart!(first_two, Larger(one, other) => (one, other));
    let halved = taken_apart!(halved, Product(Traced::Half, halved) => halved);
    let second = taken_apart!(halved, Product(Traced::Half, second) => second);
    [first, second, third].map(|dot| {
        let (two, z) = taken_apart!(dot, Sum(two, z) => (two, z));
        let (x, y) = taken_apart!(two, Sum(x, y) => (x, y));
        [x, y, z].map(|square| taken_apart!(square, Product(a, b) if a == b => a))
    })
}

#[derive(Default)]
struct Writer {
    done: BTreeSet<usize>,
    definitions: String,
    hypotheses: String,
    underflow: String,
    underflow_hypotheses: String,
}

impl Writer {
    /// Returns the claims of a sum whose last step does not count.
    fn new(trace: &Trace, value: Traced) -> Self {
        let mut script = Self::default();
        if let Traced::Step(last) = value
            && let Step::Sum(a, b) = trace.steps[last]
        {
            script.add(trace, a);
            script.add(trace, b);
        }
        script.underflow_hypotheses.push_str("\n/\\ L in [0, 1b@lambda@]");
        script
    }

    fn add(&mut self, trace: &Trace, number: Traced) {
        let Traced::Step(index) = number else { panic!("a constant") };
        if !self.done.insert(index) {
            return;
        }
        let step = &trace.steps[index];
        if let Step::Sum(a, b) | Step::Difference(a, b) | Step::Product(a, b) = step {
            self.add(trace, *a);
            self.add(trace, *b);
        }
        self.write(trace, number, step).expect("a string has room");
    }

    fn write(&mut self, trace: &Trace, number: Traced, step: &Step) -> std::fmt::Result {
        let (name, whole) = (rounded(number, trace), exact(number, trace));
        let (q, x) = (by_steps(number, trace), by_differences(number, trace));
        let (a, b, sign) = match step {
            Step::Input(_) => {
                write!(
                    self.hypotheses,
                    "\n/\\ {name} in [-1, 1] /\\ {name} -/ {whole} in [-2b@u@, 2b@u@]"
                )?;
                return write!(self.underflow_hypotheses, "\n/\\ {x} in [-3, 3]");
            }
            Step::Sum(a, b) => (*a, *b, "+"),
            Step::Difference(a, b) => (*a, *b, "-"),
            Step::Product(a, b) => (*a, *b, "*"),
            other => panic!("{other:?} is none of the steps that are proven"),
        };
        let [(a, exact_a, q_a, x_a), (b, exact_b, q_b, x_b)] = [a, b].map(|x| {
            (
                rounded(x, trace),
                exact(x, trace),
                by_steps(x, trace),
                by_differences(x, trace),
            )
        });
        writeln!(self.definitions, "{whole} = {exact_a} {sign} {exact_b};")?;
        write!(self.hypotheses, "\n/\\ {name} -/ ({a} {sign} {b}) in [-2b@u@, 2b@u@]")?;
        let error = format!("e{q}");
        let loss = format!("l{q}");
        write!(
            self.underflow_hypotheses,
            "\n/\\ {error} in [-2b@u@, 2b@u@] /\\ {loss} in [-1, 1]"
        )?;
        let is_input = |q: &str| q == "0";
        if sign == "*" {
            let mut terms = Vec::new();
            if !is_input(&q_a) {
                terms.push(format!("{q_a} * {b}"));
            }
            if !is_input(&q_b) {
                terms.push(format!("{a} * {q_b}"));
            }
            if terms.len() == 2 {
                terms.push(format!("L * ({q_a} * {q_b})"));
            }
            if terms.is_empty() {
                terms.push("0".to_owned());
            }
            writeln!(self.underflow, "{q} = ({}) * (1 + {error}) + {loss};", terms.join(" + "))?;
            writeln!(
                self.underflow,
                "{x} = ({x_a} * {exact_b} + {exact_a} * {x_b}) + L * ({x_a} * {x_b});"
            )
        } else {
            writeln!(self.underflow, "{q} = ({q_a} {sign} {q_b}) * (1 + {error}) + {loss};")?;
            writeln!(self.underflow, "{x} = {x_a} {sign} {x_b};")
        }
    }
}

fn named(number: Traced, trace: &Trace, input: impl Fn(&str) -> String, step: &str) -> String {
    match number {
        Traced::Step(index) => match &trace.steps[index] {
            Step::Input(name) => input(name),
            _ => format!("{step}{index}"),
        },
        other => panic!("{other:?} is no step"),
    }
}

fn rounded(number: Traced, trace: &Trace) -> String {
    named(number, trace, str::to_owned, "t")
}

fn exact(number: Traced, trace: &Trace) -> String {
    named(number, trace, str::to_uppercase, "T")
}

/// Returns the error that underflow in the steps adds. Inputs are computed values.
fn by_steps(number: Traced, trace: &Trace) -> String {
    named(number, trace, |_| "0".to_owned(), "q")
}

fn by_differences(number: Traced, trace: &Trace) -> String {
    named(number, trace, |name| format!("x{name}"), "x")
}
