//! The published methods, and ours, each as a choice of stages.

use super::table::table;
use super::{CullingTest, ElementaryTest, Stage};
use std::str::FromStr;

/// The source of a method's primitive pairs, and how it avoids testing a pair twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PairSource {
    /// Candidate triangle pairs, distributed.
    TrianglePairs(Redundancy),
    /// Hierarchies of moving boxes over vertices, edges and faces, which find each primitive pair once
    /// ([`MovingBroadPhase`](selvedge::broad_phase::MovingBroadPhase)). The certified stages of
    /// [`CollisionDetector`](selvedge::CollisionDetector) follow, for any tests, and exact verdicts for
    /// [`ElementaryTest::Exact`].
    MovingBoxes,
}

/// The way in which a method that distributes triangle pairs avoids testing a primitive pair twice.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Redundancy {
    /// It does not: each candidate triangle pair is distributed in full, duplicates included.
    Kept,
    /// Two hash sets hold the vertex–face and edge–edge pairs already distributed in this step.
    HashSets,
    /// One triangle represents each vertex and each edge (Curtis et al. 2008), by the paper's greedy rule.
    RepresentativeTriangles,
}

/// A method as a choice for each stage after the broad phase.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stages {
    /// The source of primitive pairs.
    pub source: PairSource,
    /// The culling tests, in order; at most one for each [`Stage`].
    pub tests: &'static [CullingTest],
    /// The test of the surviving pairs.
    pub elementary: ElementaryTest,
}

impl Stages {
    /// Returns the stages after the broad phase of a method that distributes triangle pairs, in order.
    pub(crate) fn names(&self) -> impl Iterator<Item = Stage> {
        let tests = self.tests.iter().map(|test| test.stage());
        [Stage::Distribution].into_iter().chain(tests).chain([Stage::Elementary])
    }

    /// Returns whether the method misses nothing that touches, rounding included.
    pub fn is_certified(&self) -> bool {
        self.tests.iter().all(|test| test.is_certified()) && self.elementary.is_certified()
    }
}

table! {
    /// A method by its name: author and year, or `selvedge`. The order is that of the paper's references; ours come last.
    pub enum Preset of Stages {
        /// Every primitive pair of every candidate triangle pair, duplicates included.
        Naive = "naive": published(Redundancy::Kept, &[]),
        /// The paper's *basic lower tailoring*: duplicates removed by two hash sets.
        Basic = "basic": published(Redundancy::HashSets, &[]),
        /// Provot 1997: the elementary test alone. The stages are those of [`Basic`](Self::Basic), whose elementary test is
        /// Provot's; the paper names both.
        Provot1997 = "provot_1997": published(Redundancy::HashSets, &[]),
        /// Hutter, Fuhrmann 2007: stored 18-DOPs.
        HutterFuhrmann2007 = "hutter_fuhrmann_2007": published(REPRESENTATIVES, &[CullingTest::StoredDop18]),
        /// Curtis, Tamstorf, Manocha 2008: representative triangles.
        Curtis2008 = "curtis_2008": published(REPRESENTATIVES, &[]),
        /// Tang, Manocha, Tong 2010: the non-coplanarity filter.
        Tang2010 = "tang_2010": published(REPRESENTATIVES, &[CullingTest::PlainNonCoplanarity]),
        /// Tang, Li, Wang 2010 (*reconstructed*): a subspace filter on three axes.
        TangC2010 = "tang_c_2010": published(REPRESENTATIVES, &[CullingTest::SubspaceThree]),
        /// Tang, Li, Wang 2011 (*reconstructed*): a subspace filter on nine directions.
        TangC2011 = "tang_c_2011": published(REPRESENTATIVES, &[CullingTest::SubspaceNine]),
        /// Lv, He, Mi: the paper.
        Lv2014 = "lv_2014": published(REPRESENTATIVES, &[CullingTest::SegmentBox, CullingTest::PlainNonCoplanarity]),
        /// Our method.
        Selvedge = "selvedge": ours(ElementaryTest::TimeOfImpact),
        /// Our method with the exact verdict: exactly the pairs that touch are contacts.
        SelvedgeExact = "selvedge_exact": ours(ElementaryTest::Exact),
    }
}

const REPRESENTATIVES: Redundancy = Redundancy::RepresentativeTriangles;

const fn published(redundancy: Redundancy, tests: &'static [CullingTest]) -> Stages {
    Stages {
        source: PairSource::TrianglePairs(redundancy),
        tests,
        elementary: ElementaryTest::Cubic,
    }
}

const fn ours(elementary: ElementaryTest) -> Stages {
    Stages {
        source: PairSource::MovingBoxes,
        tests: &[CullingTest::CertifiedNonCoplanarity],
        elementary,
    }
}

impl Preset {
    /// Returns the stages that the name stands for.
    pub const fn stages(self) -> Stages {
        self.row()
    }

    /// Returns whether the original could not be read, so that the preset claims no reproduction of it.
    pub const fn is_reconstructed(self) -> bool {
        matches!(self, Self::TangC2010 | Self::TangC2011)
    }
}

/// A name that is not a preset's.
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
    fn the_error_about_an_unknown_name_lists_the_known_ones() {
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
