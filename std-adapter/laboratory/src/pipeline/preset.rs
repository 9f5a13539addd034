//! The published methods, and ours, each as a choice of stages.

use std::fmt;
use std::str::FromStr;

/// Where a method's primitive pairs come from, and what keeps the same one from being tested twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    /// Candidate triangle pairs, distributed.
    TrianglePairs(Redundancy),
    /// Hierarchies of moving boxes over vertices, edges and faces, which find each primitive pair once
    /// ([`MovingBroadPhase`](selvedge::verification::MovingBroadPhase)); then the certified stages of [`CollisionDetector`](selvedge::CollisionDetector), whatever
    /// the tests, and exact verdicts for [`ElementaryTest::Exact`].
    MovingBoxes,
}

/// How a method keeps the same primitive pair from being tested twice, where it distributes triangle pairs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Redundancy {
    /// Not at all: each candidate triangle pair is distributed in full, duplicates included.
    Kept,
    /// Two hash sets, of vertex–face and of edge–edge pairs already distributed in this step.
    HashSets,
    /// Each vertex and each edge is represented by one triangle (Curtis et al. 2008), assigned by
    /// the paper's greedy rule.
    RepresentativeTriangles,
}

/// One culling test on primitive pairs. See [`selvedge_core::boxes`] and [`selvedge_core::filter`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CullingTest {
    /// Swept axis-aligned boxes of the two primitives, made on the fly. Exact.
    SweptBoxes,
    /// The same test with boxes that are kept for every vertex, edge and face and refitted each step: each is made once,
    /// not once for every pair. Exact.
    StoredSweptBoxes,
    /// Swept 18-DOPs, kept for every vertex, edge and face and refitted each step. Exact.
    StoredDop18,
    /// VF: the vertex's path against the face's swept box; EE: swept boxes. Certified.
    SegmentBox,
    /// One of three coordinate axes keeps the two primitives in the same order. Exact.
    RelativeBoxes,
    /// [`RelativeBoxes`](Self::RelativeBoxes) with the six diagonals as well. Exact.
    RelativeBoxesNine,
    /// The three-axis subspace filter of Tang, Li, Wang 2010 as reconstructed: the same computation as
    /// [`RelativeBoxes`](Self::RelativeBoxes), counted as a filter.
    SubspaceThree,
    /// The subspace filter of Tang, Li, Wang 2011 as reconstructed: nine fixed directions.
    SubspaceNine,
    /// Four control values of one sign, as printed in the paper. **Not certified.**
    PlainNonCoplanarity,
    /// Four control values certainly of one sign. Certified.
    CertifiedNonCoplanarity,
}

/// Where in the data flow a count is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Stage {
    /// Candidate triangle pairs.
    BroadPhase,
    /// Their primitive pairs.
    Distribution,
    /// After the primitive box test.
    Boxes,
    /// After relative boxes.
    RelativeBoxes,
    /// After the subspace filter.
    Subspace,
    /// After the non-coplanarity filter.
    NonCoplanarity,
    /// After the elementary test: contacts.
    Elementary,
}

impl Stage {
    /// The name in reports, as in `"broad-phase"`.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::BroadPhase => "broad-phase",
            Self::Distribution => "distribution",
            Self::Boxes => "boxes",
            Self::RelativeBoxes => "relative-boxes",
            Self::Subspace => "subspace",
            Self::NonCoplanarity => "non-coplanarity",
            Self::Elementary => "elementary",
        }
    }

    /// Whether the stage compares boxes (the paper's first stage) rather than planes or directions (its second).
    #[must_use]
    pub const fn is_box_test(self) -> bool {
        matches!(self, Self::Boxes | Self::RelativeBoxes)
    }
}

impl fmt::Display for Stage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl CullingTest {
    /// The stage that this test is a choice for.
    #[must_use]
    pub const fn stage(self) -> Stage {
        match self {
            Self::SweptBoxes | Self::StoredSweptBoxes | Self::StoredDop18 | Self::SegmentBox => Stage::Boxes,
            Self::RelativeBoxes | Self::RelativeBoxesNine => Stage::RelativeBoxes,
            Self::SubspaceThree | Self::SubspaceNine => Stage::Subspace,
            Self::PlainNonCoplanarity | Self::CertifiedNonCoplanarity => Stage::NonCoplanarity,
        }
    }

    /// Whether it never culls a pair that touches, rounding included.
    #[must_use]
    pub const fn is_certified(self) -> bool {
        !matches!(self, Self::PlainNonCoplanarity)
    }
}

/// Decides whether, and when, a surviving pair first touches.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ElementaryTest {
    /// [`cubic`](crate::baselines::cubic): plain, misses contacts.
    Cubic,
    /// [`selvedge_core::elementary::advance`], with the default tolerance: certified; a contact's time is not after the exact
    /// one, and a pair that comes within the tolerance, or too close to tell, may count as a contact.
    TimeOfImpact,
    /// The same, and then [`selvedge_core::elementary::contact()`]: a contact is one exactly, and its time certified as before.
    Exact,
}

impl ElementaryTest {
    /// Whether it never misses a contact, rounding included.
    #[must_use]
    pub const fn is_certified(self) -> bool {
        matches!(self, Self::TimeOfImpact | Self::Exact)
    }
}

/// A method as a choice for each stage after the broad phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stages {
    /// Where primitive pairs come from.
    pub source: Source,
    /// The culling tests, in order; at most one for each [`Stage`].
    pub tests: &'static [CullingTest],
    /// The test of what survives.
    pub elementary: ElementaryTest,
}

/// A method by its name: author and year, or `selvedge`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Preset {
    /// Every primitive pair of every candidate triangle pair, duplicates included.
    Naive,
    /// The paper's *basic lower tailoring*: duplicates removed by two hash sets.
    Basic,
    /// Provot 1997: the elementary test alone. The same stages as [`Basic`](Self::Basic), whose
    /// elementary test is Provot's; the paper names both.
    Provot1997,
    /// Hutter, Fuhrmann 2007: stored 18-DOPs.
    HutterFuhrmann2007,
    /// Curtis, Tamstorf, Manocha 2008: representative triangles.
    Curtis2008,
    /// Tang, Manocha, Tong 2010: the non-coplanarity filter.
    Tang2010,
    /// Tang, Li, Wang 2010 (*reconstructed*): a subspace filter on three axes.
    TangC2010,
    /// Tang, Li, Wang 2011 (*reconstructed*): a subspace filter on nine directions.
    TangC2011,
    /// Lv, He, Mi: the paper.
    Lv2014,
    /// Ours.
    Selvedge,
    /// Ours, with the exact verdict: no pair is called a contact that is none.
    SelvedgeExact,
}

impl Preset {
    /// Every preset, in the order of the paper's references, ours last.
    pub const ALL: [Self; 11] = [
        Self::Naive,
        Self::Basic,
        Self::Provot1997,
        Self::HutterFuhrmann2007,
        Self::Curtis2008,
        Self::Tang2010,
        Self::TangC2010,
        Self::TangC2011,
        Self::Lv2014,
        Self::Selvedge,
        Self::SelvedgeExact,
    ];

    /// The name on the command line and in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Naive => "naive",
            Self::Basic => "basic",
            Self::Provot1997 => "provot_1997",
            Self::HutterFuhrmann2007 => "hutter_fuhrmann_2007",
            Self::Curtis2008 => "curtis_2008",
            Self::Tang2010 => "tang_2010",
            Self::TangC2010 => "tang_c_2010",
            Self::TangC2011 => "tang_c_2011",
            Self::Lv2014 => "lv_2014",
            Self::Selvedge => "selvedge",
            Self::SelvedgeExact => "selvedge_exact",
        }
    }

    /// Whether the original could not be read, and the preset claims no reproduction of it.
    #[must_use]
    pub const fn is_reconstructed(self) -> bool {
        matches!(self, Self::TangC2010 | Self::TangC2011)
    }

    /// Whether it is one of our own.
    #[must_use]
    pub const fn is_ours(self) -> bool {
        matches!(self, Self::Selvedge | Self::SelvedgeExact)
    }

    /// The stages that the name stands for.
    #[must_use]
    pub const fn stages(self) -> Stages {
        use CullingTest as Test;
        use Redundancy::{HashSets, Kept, RepresentativeTriangles};
        use Source::{MovingBoxes, TrianglePairs};
        let (source, tests): (_, &[Test]) = match self {
            Self::Naive => (TrianglePairs(Kept), &[]),
            Self::Basic | Self::Provot1997 => (TrianglePairs(HashSets), &[]),
            Self::HutterFuhrmann2007 => (TrianglePairs(RepresentativeTriangles), &[Test::StoredDop18]),
            Self::Curtis2008 => (TrianglePairs(RepresentativeTriangles), &[]),
            Self::Tang2010 => (TrianglePairs(RepresentativeTriangles), &[Test::PlainNonCoplanarity]),
            Self::TangC2010 => (TrianglePairs(RepresentativeTriangles), &[Test::SubspaceThree]),
            Self::TangC2011 => (TrianglePairs(RepresentativeTriangles), &[Test::SubspaceNine]),
            Self::Lv2014 => (
                TrianglePairs(RepresentativeTriangles),
                &[Test::SegmentBox, Test::PlainNonCoplanarity],
            ),
            Self::Selvedge | Self::SelvedgeExact => (MovingBoxes, &[Test::CertifiedNonCoplanarity]),
        };
        let elementary = match self {
            Self::Selvedge => ElementaryTest::TimeOfImpact,
            Self::SelvedgeExact => ElementaryTest::Exact,
            _ => ElementaryTest::Cubic,
        };
        Stages {
            source,
            tests,
            elementary,
        }
    }
}

impl fmt::Display for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A name that no preset has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no pipeline `{0}`; choose one of {list}", list = Preset::ALL.map(Preset::name).join(", "))]
pub struct UnknownPreset(pub String);

impl FromStr for Preset {
    type Err = UnknownPreset;

    fn from_str(name: &str) -> Result<Self, UnknownPreset> {
        Self::ALL
            .into_iter()
            .find(|preset| preset.name() == name)
            .ok_or_else(|| UnknownPreset(name.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_read_back() {
        for preset in Preset::ALL {
            assert_eq!(preset.name().parse(), Ok(preset));
        }
    }

    #[test]
    fn an_unknown_name_is_told_the_known_ones() {
        let message = "curtis".parse::<Preset>().unwrap_err().to_string();
        assert!(
            message.contains("`curtis`") && message.contains("curtis_2008, tang_2010"),
            "{message}"
        );
    }

    #[test]
    fn no_preset_has_two_tests_for_one_stage() {
        for preset in Preset::ALL {
            let mut stages: Vec<_> = preset.stages().tests.iter().map(|test| test.stage()).collect();
            stages.dedup();
            assert_eq!(stages.len(), preset.stages().tests.len());
            assert!(stages.is_sorted(), "{preset}");
        }
    }
}
