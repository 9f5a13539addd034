//! Runs core's kernels on symbols, to show which monomials they compute, in how many rounded steps, in which order.
//!
//! The kernels are generic over [`Lanes`], so their source runs on [`Traced`] unchanged. The proofs in `verification/gappa` start
//! from these traces, so they are about the code and not about a copy of it.

use selvedge_core::kernels::lanes::{Lanes, Rounding};
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// A number that knows how it was computed. The thread keeps its steps: see [`trace`].
///
/// The order of the variants is that of `PartialOrd`: a step is greater than zero, since core asks whether a separation is
/// positive before it computes with one.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Traced {
    /// The unit roundoff.
    UnitRoundoff,
    /// η.
    Underflow,
    /// The limit beyond which pairs are out of range.
    LargestEdge,
    /// The limit beyond which extents are out of range.
    LargestExtent,
    /// μ.
    ExtentUnderflow,
    /// The limit below which sums of squares may have lost digits.
    SafeSquare,
    /// The length of a vector whose squares all underflow.
    LengthUnderflow,
    /// One half.
    Half,
    /// Infinity.
    Infinity,
    /// A small integer.
    Small(u8),
    /// The result of a step of the current trace.
    Step(usize),
}

/// A step of a computation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Step {
    /// An input of this name.
    Input(String),
    /// A rounded sum.
    Sum(Traced, Traced),
    /// A rounded difference.
    Difference(Traced, Traced),
    /// A rounded product.
    Product(Traced, Traced),
    /// A rounded quotient.
    Quotient(Traced, Traced),
    /// A rounded square root.
    Root(Traced),
    /// An exact negation.
    Negative(Traced),
    /// An exact magnitude.
    Magnitude(Traced),
    /// The larger of two, exactly.
    Larger(Traced, Traced),
    /// The smaller of two, exactly.
    Smaller(Traced, Traced),
    /// The first of two where the mask is true, else the second; exactly.
    Selected(TracedMask, Traced, Traced),
}

/// A truth value that knows how it was computed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TracedMask {
    /// An index of [`Trace::masks`].
    pub index: usize,
    /// The value if all comparisons are false.
    truth: bool,
}

/// The origin of a [`TracedMask`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaskStep {
    /// True.
    Always,
    /// True if the first is greater than the second.
    Greater(Traced, Traced),
    /// True if both are.
    And(TracedMask, TracedMask),
    /// True if at least one is.
    Or(TracedMask, TracedMask),
    /// True if exactly one is.
    Xor(TracedMask, TracedMask),
    /// The other truth value.
    Not(TracedMask),
}

#[derive(Clone, Debug, Default)]
struct Arena {
    steps: Vec<Step>,
    comparisons: Vec<[Traced; 2]>,
    masks: Vec<MaskStep>,
    any_is_true: bool,
}

thread_local! {
    static ARENA: RefCell<Arena> = RefCell::default();
}

/// The record of a kernel's computation.
#[derive(Clone, Debug)]
pub struct Trace {
    /// All steps, each after those that it uses.
    pub steps: Vec<Step>,
    /// All comparisons: they are true if the first is greater than the second.
    pub comparisons: Vec<[Traced; 2]>,
    /// The masks made from them.
    pub masks: Vec<MaskStep>,
}

/// Runs a kernel on symbols. Its computation must not depend on its comparisons, which are all false.
pub fn trace<T>(kernel: impl FnOnce() -> T) -> (T, Trace) {
    ARENA.take();
    let result = kernel();
    let Arena {
        steps,
        comparisons,
        masks,
        ..
    } = ARENA.take();
    (
        result,
        Trace {
            steps,
            comparisons,
            masks,
        },
    )
}

/// Within [`trace`]: runs a part in which each [`Lanes::any`] returns that some lane is true.
pub fn if_any<T>(part: impl FnOnce() -> T) -> T {
    ARENA.with_borrow_mut(|arena| arena.any_is_true = true);
    let result = part();
    ARENA.with_borrow_mut(|arena| arena.any_is_true = false);
    result
}

impl TracedMask {
    /// The mask that is always true.
    pub fn always() -> Self {
        Self::record(MaskStep::Always)
    }

    fn record(step: MaskStep) -> Self {
        let truth = match step {
            MaskStep::Always => true,
            MaskStep::Greater(..) => false,
            MaskStep::And(a, b) => a.truth && b.truth,
            MaskStep::Or(a, b) => a.truth || b.truth,
            MaskStep::Xor(a, b) => a.truth != b.truth,
            MaskStep::Not(a) => !a.truth,
        };
        ARENA.with_borrow_mut(|arena| {
            arena.masks.push(step);
            let index = arena.masks.len() - 1;
            Self { index, truth }
        })
    }
}

impl BitAnd for TracedMask {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self::record(MaskStep::And(self, other))
    }
}

impl BitOr for TracedMask {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self::record(MaskStep::Or(self, other))
    }
}

impl BitXor for TracedMask {
    type Output = Self;
    fn bitxor(self, other: Self) -> Self {
        Self::record(MaskStep::Xor(self, other))
    }
}

impl Not for TracedMask {
    type Output = Self;
    fn not(self) -> Self {
        Self::record(MaskStep::Not(self))
    }
}

impl Traced {
    /// Makes a number with this name.
    pub fn input(name: impl Into<String>) -> Self {
        Self::record(Step::Input(name.into()))
    }

    fn record(step: Step) -> Self {
        ARENA.with_borrow_mut(|arena| {
            arena.steps.push(step);
            Self::Step(arena.steps.len() - 1)
        })
    }
}

impl Add for Traced {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::record(Step::Sum(self, other))
    }
}

impl Sub for Traced {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::record(Step::Difference(self, other))
    }
}

impl Mul for Traced {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::record(Step::Product(self, other))
    }
}

impl Div for Traced {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self::record(Step::Quotient(self, other))
    }
}

impl Neg for Traced {
    type Output = Self;
    fn neg(self) -> Self {
        Self::record(Step::Negative(self))
    }
}

impl Rounding for Traced {
    const UNIT_ROUNDOFF: Self = Self::UnitRoundoff;
    const UNDERFLOW: Self = Self::Underflow;
    const LARGEST_EDGE: Self = Self::LargestEdge;
    const LARGEST_EXTENT: Self = Self::LargestExtent;
    const EXTENT_UNDERFLOW: Self = Self::ExtentUnderflow;
    const SAFE_SQUARE: Self = Self::SafeSquare;
    const LENGTH_UNDERFLOW: Self = Self::LengthUnderflow;
    const ZERO: Self = Self::Small(0);
    const ONE: Self = Self::Small(1);
    const HALF: Self = Self::Half;
    const INFINITY: Self = Self::Infinity;
    fn small(count: u8) -> Self {
        Self::Small(count)
    }
}

impl Lanes for Traced {
    type Scalar = Self;
    type Mask = TracedMask;
    fn splat(self, value: Self) -> Self {
        value
    }
    fn any(mask: TracedMask) -> bool {
        mask.truth || ARENA.with_borrow(|arena| arena.any_is_true)
    }
    fn sqrt(self) -> Self {
        Self::record(Step::Root(self))
    }
    fn abs(self) -> Self {
        Self::record(Step::Magnitude(self))
    }
    fn larger(self, other: Self) -> Self {
        Self::record(Step::Larger(self, other))
    }
    fn smaller(self, other: Self) -> Self {
        Self::record(Step::Smaller(self, other))
    }
    fn greater(self, other: Self) -> TracedMask {
        ARENA.with_borrow_mut(|arena| arena.comparisons.push([self, other]));
        TracedMask::record(MaskStep::Greater(self, other))
    }
    fn at_most(self, other: Self) -> TracedMask {
        !self.greater(other)
    }
    fn select(mask: TracedMask, if_true: Self, if_false: Self) -> Self {
        Self::record(Step::Selected(mask, if_true, if_false))
    }
}

/// A product of inputs and constants by name, in alphabetical order.
pub type Monomial = Vec<String>;

/// The monomials of a result, each with the largest number of roundings on the path from one of its occurrences to the result. A
/// minimum or a maximum has the monomials of both.
pub type Paths = BTreeMap<Monomial, u32>;

impl Trace {
    /// Treats each difference of two inputs as an input itself, named after both, since computations start from differences of
    /// points.
    pub fn begin_with_differences(&mut self) {
        let name = |number: &Traced| match number {
            Traced::Step(index) => match &self.steps[*index] {
                Step::Input(name) => Some(name.as_str()),
                _ => None,
            },
            _ => None,
        };
        let differences = self.steps.iter().map(|step| match step {
            Step::Difference(a, b) => Some(format!("{}_{}", name(a)?, name(b)?)),
            _ => None,
        });
        let differences: Vec<_> = differences.collect();
        for (step, difference) in self.steps.iter_mut().zip(differences) {
            if let Some(name) = difference {
                *step = Step::Input(name);
            }
        }
    }

    /// Returns the monomials of a result.
    ///
    /// # Panics
    /// Panics if it is not a polynomial.
    pub fn paths(&self, number: Traced) -> Paths {
        self.paths_with_last_step(number, 1)
    }

    /// Returns the monomials of a result that is compared with a floating-point number. Rounding is monotone, so its last step
    /// does not count.
    ///
    /// # Panics
    /// Panics if it is not a polynomial.
    pub fn paths_but_last(&self, number: Traced) -> Paths {
        self.paths_with_last_step(number, 0)
    }

    fn paths_with_last_step(&self, number: Traced, last: u32) -> Paths {
        let Traced::Step(index) = number else {
            return Paths::from([(constant(number), 0)]);
        };
        match &self.steps[index] {
            Step::Input(name) => Paths::from([(vec![name.clone()], 0)]),
            Step::Sum(a, b) | Step::Difference(a, b) => union([self.paths(*a), self.paths(*b)], last),
            Step::Product(a, b) => {
                // Powers of two, and integers times the unit roundoff, round nothing.
                let is_exact = [a, b].into_iter().all(|factor| !matches!(factor, Traced::Step(_)));
                let rounded = if is_exact { 0 } else { last };
                let (a, b) = (self.paths(*a), self.paths(*b));
                let mut products = Paths::new();
                for (x, of_x) in &a {
                    for (y, of_y) in &b {
                        let mut monomial = [x.as_slice(), y].concat();
                        monomial.sort();
                        let count = products.entry(monomial).or_default();
                        *count = (*count).max(of_x + of_y + rounded);
                    }
                }
                products
            }
            Step::Negative(a) | Step::Magnitude(a) => self.paths_with_last_step(*a, last),
            Step::Larger(a, b) | Step::Smaller(a, b) | Step::Selected(_, a, b) => {
                let both = [a, b].map(|&x| self.paths_with_last_step(x, last));
                union(both, 0)
            }
            Step::Quotient(a, b) if [a, b].iter().all(|x| !matches!(x, Traced::Step(_))) => {
                Paths::from([(vec![format!("{a:?}/{b:?}")], last)])
            }
            Step::Quotient(..) | Step::Root(_) => panic!("a quotient or a root is no polynomial"),
        }
    }
}

fn union([mut one, other]: [Paths; 2], rounded: u32) -> Paths {
    for (monomial, of_other) in other {
        let count = one.entry(monomial).or_default();
        *count = (*count).max(of_other);
    }
    for count in one.values_mut() {
        *count += rounded;
    }
    one
}

fn constant(number: Traced) -> Monomial {
    match number {
        Traced::Small(1) => Vec::new(),
        Traced::UnitRoundoff => vec!["u".to_owned()],
        Traced::Small(count) => vec![count.to_string()],
        other => vec![format!("{other:?}")],
    }
}
