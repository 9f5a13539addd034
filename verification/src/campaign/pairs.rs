//! Sources of pairs that cost little to make.

use crate::generator::{Choices, Format, PairCase};
use crate::random::Random;
use selvedge::broad_phase::MovingBroadPhase;
use selvedge::{StepError, Topology};
use selvedge_core::PairKind;
use selvedge_core::glam::DVec3;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CaseSource {
    /// Random coordinates; half of the pairs are nearly coplanar.
    Random,
    /// Pairs of the tests' [generator](crate::generator), each in many variants that differ by a few units in the last place.
    Adversarial,
    /// Pairs from meshes in motion: unchanged, nudged, far from the origin, or moved into one another's plane.
    Scene,
}

impl CaseSource {
    pub(super) const ALL: [Self; 3] = [Self::Random, Self::Adversarial, Self::Scene];
}

pub type Points = [[[f64; 3]; 2]; 4];

/// Pairs from meshes in motion.
#[derive(Clone, Debug, Default)]
pub struct Scenes {
    pub vertex_face: Vec<Points>,
    pub edge_edge: Vec<Points>,
}

impl Scenes {
    /// Adds pairs of a mesh whose moving boxes overlap in a step: at most `limit` of each kind, evenly spaced.
    ///
    /// # Errors
    /// Returns an error if a position is not finite, or there is not one for each vertex.
    pub fn add_step(&mut self, topology: &Topology, start: &[DVec3], end: &[DVec3], limit: usize) -> Result<(), StepError> {
        let mut broad_phase = MovingBroadPhase::new(topology.clone());
        broad_phase.update(start, end)?;
        let (mut vertex_face, mut edge_edge) = (Vec::new(), Vec::new());
        broad_phase.candidates(&mut vertex_face, &mut edge_edge);
        for (kind, mut pairs, found) in [
            (PairKind::VertexFace, vertex_face, &mut self.vertex_face),
            (PairKind::EdgeEdge, edge_edge, &mut self.edge_edge),
        ] {
            // The order of candidates is not promised.
            pairs.sort_unstable();
            let stride = pairs.len().div_ceil(limit).max(1);
            let points = |pair: [u32; 2]| {
                let vertices = topology.vertices_of(kind, pair).map(|vertex| vertex as usize);
                vertices.map(|vertex| [start[vertex].to_array(), end[vertex].to_array()])
            };
            found.extend(pairs.into_iter().step_by(stride).map(points));
        }
        Ok(())
    }
}

/// Makes the pairs of a chunk.
pub(super) struct Maker<'a> {
    source: CaseSource,
    kind: PairKind,
    of_scene: &'a [Points],
    random: Random,
}

impl<'a> Maker<'a> {
    pub(super) fn new(source: CaseSource, kind: PairKind, scenes: &'a Scenes, random: Random) -> Self {
        let of_scene = match kind {
            PairKind::VertexFace => &scenes.vertex_face,
            PairKind::EdgeEdge => &scenes.edge_edge,
        };
        Self {
            source,
            kind,
            of_scene,
            random,
        }
    }

    /// Appends the next `count` pairs.
    pub(super) fn make<S: Format>(&mut self, count: usize, cases: &mut Vec<PairCase<S>>) {
        let (kind, random) = (self.kind, &mut self.random);
        let mut base = PairCase::new(kind, [[[S::ZERO; 3]; 2]; 4]);
        let mut variants = 0;
        for _ in 0..count {
            let case = match self.source {
                CaseSource::Scene if !self.of_scene.is_empty() => {
                    let points = self.of_scene[random.below(self.of_scene.len() as u64) as usize];
                    let points = points.map(|ends| ends.map(|x| x.map(S::from_f64)));
                    of_motion(PairCase::new(kind, points), random)
                }
                CaseSource::Adversarial => {
                    if variants == 0 {
                        base = PairCase::choose(kind, &mut Choices::new(&random.bytes::<{ Choices::ENOUGH }>()));
                        variants = if is_wide(&base) { 1 } else { 32 };
                    }
                    variants -= 1;
                    nudged(base, 1 + random.below(3), random)
                }
                CaseSource::Random | CaseSource::Scene => at_random(kind, random),
            };
            cases.push(case.map(S::made_finite));
        }
    }
}

/// Returns the first `count` pairs of `source`, which are the same on every machine. [`CaseSource::Scene`] has no pairs here, and
/// random ones are returned.
pub fn sample<S: Format>(source: CaseSource, kind: PairKind, seed: u64, count: usize) -> Vec<PairCase<S>> {
    let (scenes, mut cases) = (Scenes::default(), Vec::new());
    Maker::new(source, kind, &scenes, self::random(seed, 0)).make(count, &mut cases);
    cases
}

/// Returns whether coordinates differ so much in size that exact arithmetic takes a hundred times as long. Then one variant is
/// enough.
fn is_wide<S: Format>(case: &PairCase<S>) -> bool {
    let sizes = case.coordinates().map(|x| x.to_f64().abs()).filter(|&x| x > 0.0);
    let (low, high) = sizes.fold((f64::MAX, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
    high / low > 1e60
}

/// Makes a random pair. Three in four pairs have coordinates of so few bits that integers of one word suffice, which takes a
/// fraction of the time.
fn at_random<S: Format>(kind: PairKind, random: &mut Random) -> PairCase<S> {
    let bits = if random.below(4) > 0 { 26 } else { 52 };
    let motion = [1.0, 0.5, 1.0 / 16.0, 1.0 / 4096.0, 1.0 / 4_194_304.0][random.below(5) as usize];
    let points = std::array::from_fn(|_| {
        let start: [f64; 3] = std::array::from_fn(|_| random.fraction(bits));
        let end = start.map(|x| x + motion * random.fraction(bits));
        [start, end].map(|x| x.map(S::from_f64))
    });
    let case = PairCase::new(kind, points);
    if random.below(2) == 0 {
        case
    } else {
        onto_the_plane(case, random)
    }
}

/// Returns the pair unchanged, nudged, far from the origin, where coordinates are rounded, or with a point in the plane of the
/// others.
fn of_motion<S: Format>(case: PairCase<S>, random: &mut Random) -> PairCase<S> {
    match random.below(4) {
        0 => case,
        1 => nudged(case, 8, random),
        2 => {
            let by: [S; 3] = std::array::from_fn(|_| {
                S::from_f64(random.fraction(52) * [16.0, 1024.0, 65536.0, 1e7][random.below(4) as usize])
            });
            case.with_positions(|x| std::array::from_fn(|axis| x[axis] + by[axis]))
        }
        _ => nudged(onto_the_plane(case, random), 2, random),
    }
}

/// Moves the first point into the plane of the others, up to rounding, at the start, at the end or at both.
fn onto_the_plane<S: Format>(mut case: PairCase<S>, random: &mut Random) -> PairCase<S> {
    let ends = 1 + random.below(3);
    let [p, a, b, c] = &mut case.points;
    for end in (0..2).filter(|end| ends >> end & 1 != 0) {
        let (s, t) = (S::from_f64(random.fraction(20)), S::from_f64(random.fraction(20)));
        p[end] = std::array::from_fn(|axis| {
            let from = a[end][axis];
            from + (s * (b[end][axis] - from) + t * (c[end][axis] - from))
        });
    }
    case
}

/// Moves some coordinates up or down by one or two units in the last place. It seldom changes zeros: subnormal numbers beside
/// numbers of everyday size make exact arithmetic a hundred times as slow.
fn nudged<S: Format>(mut case: PairCase<S>, count: u64, random: &mut Random) -> PairCase<S> {
    for _ in 0..count {
        let index = random.below(24) as usize;
        let number = &mut case.points[index / 6][index / 3 % 2][index % 3];
        if *number == S::ZERO && random.below(64) > 0 {
            continue;
        }
        *number = match random.below(4) {
            0 => number.down(),
            1 => number.down().down(),
            2 => number.up(),
            _ => number.up().up(),
        };
    }
    case
}

/// Returns the generator of a chunk.
pub(super) const fn random(seed: u64, chunk: u64) -> Random {
    let seed = Random(seed).word();
    Random(seed ^ chunk.wrapping_mul(0xd134_2543_de82_ef95))
}
