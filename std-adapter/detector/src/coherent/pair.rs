//! A pair that is followed from step to step, and the direction that last kept its two sets apart.
//!
//! Proofs by directions, and their rounding errors, are [core's](selvedge_core::separation::gap).

use selvedge_core::PairKind;
use selvedge_core::glam::DVec3;
use selvedge_core::separation::closest::ClosestPoints;
use selvedge_core::separation::gap::{GapError, SeparatingDirection, distance_from_below};
use selvedge_core::separation::truncation::most_shares;

/// A vertex and a face, or two edges, that may come near each other.
///
/// The pair remembers a direction that keeps its two sets apart, and a lower bound of their gap along it.
#[derive(Clone, Copy, Debug)]
pub struct NearPair<D> {
    /// The vertex and the face, or the two edges, the smaller number first.
    pub pair: [u32; 2],
    /// The four vertices of the pair.
    pub vertices: [u32; 4],
    /// The direction that kept the sets apart at the end of the last tested step.
    separating: SeparatingDirection,
    /// The length by which vertices of both sets may stray together, twice along each axis, before the pair needs attention. It
    /// is negative if the pair needs attention at once.
    pub(super) stray: f32,
    /// The caller's data.
    pub data: D,
    /// Vertex–face or edge–edge.
    pub kind: PairKind,
}

impl<D: Copy> NearPair<D> {
    /// Makes a pair that remembers nothing.
    pub fn new(kind: PairKind, pair: [u32; 2], vertices: [u32; 4], data: D) -> Self {
        Self {
            pair,
            vertices,
            separating: SeparatingDirection::NONE,
            stray: f32::NEG_INFINITY,
            data,
            kind,
        }
    }

    /// Returns the same pair with another [stray](Self::stray).
    #[inline(always)]
    pub(super) const fn with_stray(self, stray: f32) -> Self {
        Self { stray, ..self }
    }

    /// Returns the key by which lists of pairs ascend.
    #[inline(always)]
    pub fn key(&self) -> (PairKind, [u32; 2]) {
        (self.kind, self.pair)
    }

    /// Returns whether the pair may have come within its distance, given how far all vertices stray. False proves that it has
    /// not.
    #[inline(always)]
    pub(super) fn needs_attention(&self, strays: &[f32]) -> bool {
        let [a, b, c, d] = self.vertices.map(|vertex| strays[vertex as usize]);
        // `max` is a call on WebAssembly.
        let larger = |one: f32, other: f32| if one > other { one } else { other };
        let (first, second) = match self.kind {
            PairKind::VertexFace => (a, larger(larger(b, c), d)),
            PairKind::EdgeEdge => (larger(a, b), larger(c, d)),
        };
        // A NaN proves nothing.
        let is_settled = 0.5 * (first + second) <= self.stray;
        !is_settled
    }

    /// Returns the vertices of both primitives.
    #[inline]
    pub fn sides(&self) -> [&[u32]; 2] {
        let of_first = match self.kind {
            PairKind::VertexFace => 1,
            PairKind::EdgeEdge => 2,
        };
        self.vertices.split_at(of_first).into()
    }

    /// Returns the positions of the pair's vertices.
    #[inline(always)]
    pub fn points(&self, positions: &[DVec3]) -> [DVec3; 4] {
        // The calls are written out, since `map` with a closure is not always inlined.
        let [a, b, c, d] = self.vertices;
        [
            positions[a as usize],
            positions[b as usize],
            positions[c as usize],
            positions[d as usize],
        ]
    }

    /// Returns the closest points at rest.
    pub fn closest(&self, positions: &[DVec3]) -> ClosestPoints {
        ClosestPoints::from_points(self.kind, self.points(positions))
    }

    /// Returns a lower bound of the distance at the end of the last tested step, or −∞ if there is none.
    #[inline(always)]
    pub const fn gap(&self) -> f32 {
        self.separating.gap()
    }

    /// Forgets the gap, because the pair has moved without a test.
    pub const fn forget_gap(&mut self) {
        self.separating = self.separating.without_gap();
    }

    /// Returns a lower bound of the distance, or zero where rounding hides it.
    pub fn distance_from_below(&self, positions: &[DVec3], error: GapError<f64>) -> f64 {
        let direction = self.closest(positions).direction;
        distance_from_below(self.kind, self.points(positions), direction, error)
    }

    /// Remembers another direction, with its gap at the start of a step, if that gap is larger.
    pub fn refresh(&mut self, direction: DVec3, start: &[DVec3], error: GapError<f64>) {
        self.separating = self.separating.or_better(self.kind, direction, self.points(start), error);
    }

    /// Returns whether the remembered direction keeps the pair at a distance. This is plain floating point, not a proof.
    #[inline(always)]
    pub fn is_kept_at(&self, distance: f64, positions: &[DVec3]) -> bool {
        self.separating.gap_at(self.kind, self.points(positions)) > distance
    }

    /// Returns whether the remembered direction also keeps the pair apart at the end of the step. The remembered gap must hold at
    /// the start.
    #[inline(always)]
    pub fn stays_apart(&mut self, end: &[DVec3], separation: f64, error: GapError<f64>) -> bool {
        let later = self.separating.lasts(self.kind, self.points(end), separation, error);
        if let Some(later) = later {
            self.separating = later;
        }
        later.is_some()
    }

    /// Returns whether a direction certainly keeps the pair more than `separation` apart on the path from `start` to `end`, and
    /// remembers it. It tries the remembered direction, then those of the closest points at the end and at the start.
    #[inline]
    pub fn keeps_apart(&mut self, path: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> bool {
        let [_, end] = path;
        self.keeps_apart_as_before(path, separation, error)
            || self.keeps_apart_along(self.closest(end).direction, path, separation, error)
    }

    /// Tries the remembered direction only: the first part of [`keeps_apart`](Self::keeps_apart).
    #[inline]
    pub fn keeps_apart_as_before(&mut self, [start, end]: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> bool {
        let points = [self.points(start), self.points(end)];
        self.remember_if(self.separating.keeps(self.kind, points, separation, error))
    }

    /// Tries the direction of the closest points at the end, which is given, and that at the start: the second part of
    /// [`keeps_apart`](Self::keeps_apart). If neither keeps the pair apart, the gap is forgotten.
    #[inline]
    pub fn keeps_apart_along(
        &mut self,
        at_end: DVec3,
        [start, end]: [&[DVec3]; 2],
        separation: f64,
        error: GapError<f64>,
    ) -> bool {
        let points = [self.points(start), self.points(end)];
        let found = |direction| SeparatingDirection::for_step(self.kind, direction, points, separation, error);
        let kept = found(at_end).or_else(|| found(self.closest(start).direction));
        let is_kept = self.remember_if(kept);
        if !is_kept {
            self.forget_gap();
        }
        is_kept
    }

    #[inline]
    fn remember_if(&mut self, kept: Option<SeparatingDirection>) -> bool {
        if let Some(kept) = kept {
            self.separating = kept;
        }
        kept.is_some()
    }

    /// Returns the share of the path from `base` to `wanted` that each vertex may go. With it the pair keeps `separation` on the
    /// path from `start` ([core's truncation](selvedge_core::separation::truncation)).
    ///
    /// It tries the remembered direction and those of the closest points, and remembers the best one, without a gap. The shares
    /// are zero if no direction keeps the pair apart both at `start` and at `base`.
    pub fn shares(&mut self, start: &[DVec3], [base, wanted]: [&[DVec3]; 2], separation: f64, error: GapError<f64>) -> [f64; 4] {
        let (kind, [start, base, wanted]) = (self.kind, [self.points(start), self.points(base), self.points(wanted)]);
        let directions = [start, base, wanted].map(|points| ClosestPoints::from_points(kind, points).direction);
        let directions = directions.into_iter().chain([self.separating.direction()]);
        let is_kept =
            |&direction: &DVec3| SeparatingDirection::for_step(kind, direction, [start, base], separation, error).is_some();
        let most = most_shares(kind, [base, wanted], directions.filter(is_kept), separation, error);
        let Some((direction, shares)) = most else {
            self.forget_gap();
            return [0.0; 4];
        };
        self.separating = SeparatingDirection::NONE
            .or_better(kind, direction, base, error)
            .without_gap();
        shares
    }
}
