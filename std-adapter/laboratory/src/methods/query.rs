use super::{Ask, CullingTest, ElementaryTest, Preset, Stages, WithTest};
use selvedge_core::elementary::{self, ContactVerdict};
use selvedge_core::{PrimitivePair, Scalar};
use std::fmt;
use std::str::FromStr;

/// A test of one primitive pair: stages alone, or ours as a whole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum QueryMethod {
    /// All stages of [`Preset::Selvedge`] from its culling tests on, with the certified time of impact.
    Selvedge,
    /// A culling test alone.
    Culling(CullingTest),
    /// An elementary test alone. [`ElementaryTest::Exact`] gives only the verdict, without a time:
    /// [`elementary::contact`](mod@elementary::contact).
    Elementary(ElementaryTest),
}

impl QueryMethod {
    /// Every method, ours first.
    pub const ALL: [Self; 14] = [
        Self::Selvedge,
        Self::Elementary(ElementaryTest::Exact),
        Self::Elementary(ElementaryTest::TimeOfImpact),
        Self::Culling(CullingTest::CertifiedNonCoplanarity),
        Self::Culling(CullingTest::PlainNonCoplanarity),
        Self::Culling(CullingTest::RelativeBoxes),
        Self::Culling(CullingTest::RelativeBoxesNine),
        Self::Culling(CullingTest::SweptBoxes),
        Self::Culling(CullingTest::SegmentBox),
        Self::Culling(CullingTest::StoredDop18),
        Self::Elementary(ElementaryTest::Cubic),
        Self::Elementary(ElementaryTest::BernsteinSign),
        Self::Elementary(ElementaryTest::TightInclusion(Self::TIGHT_INCLUSION)),
        Self::Elementary(ElementaryTest::Additive),
    ];

    /// The default tolerance of its authors.
    const TIGHT_INCLUSION: f64 = 1e-6;

    /// Returns the name on the command line and in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Selvedge => Preset::Selvedge.name(),
            Self::Culling(test) => test.name(),
            Self::Elementary(test) => test.name(),
        }
    }

    /// Returns whether it never denies a contact, rounding included.
    pub fn is_certified(self) -> bool {
        match self {
            Self::Selvedge => SELVEDGE.is_certified(),
            Self::Culling(test) => test.is_certified(),
            Self::Elementary(test) => test.is_certified(),
        }
    }

    /// Returns false if the method culls the pair, or finds that it does not touch.
    pub fn keeps<S: Scalar>(self, pair: PrimitivePair<S>) -> bool {
        self.run(Ask(&pair))
    }

    /// Passes the method to `with`: whether it keeps a pair.
    pub(crate) fn run<S: Scalar, W: WithTest<S, bool>>(self, with: W) -> W::Outcome {
        match self {
            Self::Selvedge => {
                let is_culled = |pair: &_| SELVEDGE.tests.iter().any(|test| test.culls(pair));
                with.with(|pair| !is_culled(pair) && SELVEDGE.elementary.time(pair).is_some())
            }
            Self::Culling(test) => test.run(Kept(with)),
            Self::Elementary(ElementaryTest::Exact) => with.with(|pair| elementary::contact(pair) != ContactVerdict::Never),
            Self::Elementary(test) => test.run(Kept(with)),
        }
    }
}

const SELVEDGE: Stages = Preset::Selvedge.stages();

/// The inverse of a culling test: whether it keeps a pair.
struct Kept<W>(W);

impl<S: Scalar, W: WithTest<S, bool>> WithTest<S, bool> for Kept<W> {
    type Outcome = W::Outcome;

    #[inline(always)]
    fn with(self, culls: impl Fn(&PrimitivePair<S>) -> bool) -> W::Outcome {
        self.0.with(|pair| !culls(pair))
    }
}

impl<S: Scalar, W: WithTest<S, bool>> WithTest<S, Option<S>> for Kept<W> {
    type Outcome = W::Outcome;

    #[inline(always)]
    fn with(self, time: impl Fn(&PrimitivePair<S>) -> Option<S>) -> W::Outcome {
        self.0.with(|pair| time(pair).is_some())
    }
}

impl fmt::Display for QueryMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that is not a method's.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no method `{0}`; choose from {list}", list = QueryMethod::ALL.map(QueryMethod::name).join(", "))]
pub struct UnknownMethod(String);

impl FromStr for QueryMethod {
    type Err = UnknownMethod;

    fn from_str(name: &str) -> Result<Self, UnknownMethod> {
        let known = Self::ALL.into_iter().find(|method| method.name() == name);
        known.ok_or_else(|| UnknownMethod(name.to_owned()))
    }
}
