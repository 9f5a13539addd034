//! Primitive pairs of every shape that is known to be hard.

use super::numbers::{binary_exponent, exponent, extraordinary, finite, fraction};
use super::strategy::Simplify;
use super::{Choices, Format, Meeting, MeetingPair, PairCase};
use selvedge_core::PairKind;

impl<S: Format> PairCase<S> {
    /// Makes a pair of finite coordinates from any bytes, for the fuzz targets. The property tests draw from the same pairs.
    pub fn from_bytes(kind: PairKind, bytes: &[u8]) -> Self {
        Self::choose(kind, &mut Choices::new(bytes))
    }

    /// Makes a pair from any bytes. Some coordinates may be NaN, infinite, or so large that everything overflows.
    pub fn any_from_bytes(kind: PairKind, bytes: &[u8]) -> Self {
        Self::choose_any(kind, &mut Choices::new(bytes))
    }

    /// Chooses a pair of finite coordinates.
    pub fn choose(kind: PairKind, choices: &mut Choices<'_>) -> Self {
        let mut case = match choices.below(12) {
            0 => grid(kind, choices),
            1 | 2 => MeetingPair::choose(kind, Meeting::Touching, choices).pair(),
            3 | 4 => MeetingPair::choose(kind, Meeting::Coplanar, choices).pair(),
            5 => coplanar_throughout(kind, choices),
            6 => graze(kind, choices),
            7 => gathering(kind, choices),
            8 => everyday(kind, choices),
            9 => nearly_coplanar(kind, choices),
            10 => Self::new(kind, each_coordinate(|| finite(choices))),
            _ => Self::new(kind, each_coordinate(|| S::from_word(choices.word()).made_finite())),
        };
        // Half of the cases stay unchanged, so that exact ones stay exact.
        for _ in 0..choices.below(8).saturating_sub(3) {
            case = disturbed(case, choices).map(S::made_finite);
        }
        case
    }

    /// Chooses a vertex whose path passes an edge of a resting face's box, within a few units in the last place on either side.
    pub fn choose_graze_of_a_box(choices: &mut Choices<'_>) -> Self {
        // Start and end have different sizes, so that differences round.
        let start: [S; 3] = std::array::from_fn(|_| S::exact(1, -choices.pick(&[0, 1, 4, 7])) * fraction::<S>(choices));
        let end: [S; 3] = std::array::from_fn(|_| fraction(choices));
        let part = fraction::<S>(choices).abs();
        let passed: [S; 3] = std::array::from_fn(|axis| {
            let position = start[axis] + part * (end[axis] - start[axis]);
            let steps = choices.pick(&[2, 30]);
            position.nudged(choices.within(steps))
        });
        // The edge is parallel to one axis. Along the others the box begins there and lies on either side.
        let edge_axis = choices.below(3) as usize;
        let (far, thin) = (S::exact(2, 0), S::exact(1, -6));
        let mut corners = [passed; 2];
        for axis in 0..3 {
            if axis == edge_axis {
                (corners[0][axis], corners[1][axis]) = (-far, far);
            } else {
                corners[1][axis] = passed[axis] + choices.pick(&[thin, -thin, far, -far]);
            }
        }
        // Often products are subnormal here, but have some bits left.
        let products_underflow = S::MIN_EXPONENT / 2 + choices.below(S::PRECISION / 2) as i32;
        let any = exponent::<S>(choices);
        let factor = S::exact(1, choices.pick(&[0, products_underflow, any]));
        let [one, other] = corners.map(|corner| [corner; 2]);
        Self::new(PairKind::VertexFace, [[start, end], one, other, one]).map(|x| (x * factor).made_finite())
    }

    /// Chooses a pair with extraordinary coordinates.
    pub fn choose_any(kind: PairKind, choices: &mut Choices<'_>) -> Self {
        let mut case = Self::choose(kind, choices);
        for _ in 0..=choices.below(4) {
            *coordinate(&mut case, choices) = extraordinary(choices);
        }
        case
    }
}

fn each_coordinate<S>(mut make: impl FnMut() -> S) -> [[[S; 3]; 2]; 4] {
    std::array::from_fn(|_| std::array::from_fn(|_| std::array::from_fn(|_| make())))
}

fn coordinate<'a, S>(case: &'a mut PairCase<S>, choices: &mut Choices<'_>) -> &'a mut S {
    let (point, end, axis) = (choices.below(4), choices.below(2), choices.below(3));
    &mut case.points[point as usize][end as usize][axis as usize]
}

/// Converts integers to points of the format, moved and scaled together.
fn scaled<S: Format>(kind: PairKind, points: [[[i64; 3]; 2]; 4], choices: &mut Choices<'_>) -> PairCase<S> {
    let exponent = exponent::<S>(choices);
    let points = points.map(|ends| ends.map(|x| x.map(|x| S::exact(x, exponent))));
    PairCase::new(kind, points)
}

/// Chooses small integers, which most often make a degenerate pair.
fn grid<S: Format>(kind: PairKind, choices: &mut Choices<'_>) -> PairCase<S> {
    let limit = choices.pick(&[1, 2, 4]);
    let points = each_coordinate(|| choices.within(limit));
    scaled(kind, points, choices)
}

/// Chooses eight positions in one plane, through the origin or not, along the axes or not.
fn coplanar_throughout<S: Format>(kind: PairKind, choices: &mut Choices<'_>) -> PairCase<S> {
    let limit = choices.pick(&[2, 60]);
    let (slope, other_slope, height) = (choices.within(2), choices.within(2), choices.within(9));
    let axes = permutation(choices);
    let points = each_coordinate(|| choices.within(limit)).map(|ends| {
        ends.map(|[x, y, _]| {
            let position = [x, y, slope * x + other_slope * y + height];
            axes.map(|axis| position[axis])
        })
    });
    scaled(kind, points, choices)
}

/// Chooses a pair whose volume is proportional to (t − τ)² − εβ. It has a double root at τ if εβ = 0, else no root or two close
/// ones.
///
/// B = (β, t − τ, z₁), C = (0, 0, c), P = (t − τ, ε, z₂), in any order, from a base that moves.
fn graze<S: Format>(kind: PairKind, choices: &mut Choices<'_>) -> PairCase<S> {
    let bits = choices.below(6);
    let numerator = i64::from(choices.below((1 << bits) + 1));
    let base: [[i64; 3]; 2] = std::array::from_fn(|_| std::array::from_fn(|_| choices.within(60)));
    let (b, c, p) = (
        [choices.within(1), choices.within(20)],
        choices.within(20),
        [choices.within(1), choices.within(20)],
    );
    let order = order(choices);
    let axes = permutation(choices);
    let shear = choices.within(2);
    let mut points = [[[0; 3]; 2]; 4];
    for (end, base) in base.iter().enumerate() {
        let along = ((end as i64) << bits) - numerator;
        let relative = [[0, 0, 0], [b[0], along, b[1]], [0, 0, c], [along, p[0], p[1]]];
        for (point, [x, y, z]) in relative.into_iter().enumerate() {
            let position = [x, y, z + shear * x];
            points[order[point]][end] = std::array::from_fn(|k| position[axes[k]] + base[axes[k]]);
        }
    }
    scaled(kind, points, choices)
}

/// Chooses four points that meet in one position at one time: a triple root.
fn gathering<S: Format>(kind: PairKind, choices: &mut Choices<'_>) -> PairCase<S> {
    let bits = choices.below(4);
    let numerator = i64::from(choices.below((1 << bits) + 1));
    let place: [i64; 3] = std::array::from_fn(|_| choices.within(60));
    let points = std::array::from_fn(|_| {
        let velocity: [i64; 3] = std::array::from_fn(|_| choices.within(60));
        [0, 1].map(|end: i64| {
            let times = (end << bits) - numerator;
            std::array::from_fn(|axis| place[axis] + times * velocity[axis])
        })
    });
    scaled(kind, points, choices)
}

/// Chooses points of about unit size with random bits, which move little or much.
fn everyday<S: Format>(kind: PairKind, choices: &mut Choices<'_>) -> PairCase<S> {
    let motion = S::exact(1, -choices.pick(&[0, 1, 4, 12, 22]));
    let points = std::array::from_fn(|_| {
        let start: [S; 3] = std::array::from_fn(|_| fraction(choices));
        let end = start.map(|x| x + motion * fraction::<S>(choices));
        [start, end]
    });
    PairCase::new(kind, points)
}

/// Chooses points that are coplanar up to rounding, at one end of the step or at both.
fn nearly_coplanar<S: Format>(kind: PairKind, choices: &mut Choices<'_>) -> PairCase<S> {
    let mut case = everyday(kind, choices);
    let order = order(choices);
    let [p, a, b, c] = order;
    let ends: &[usize] = choices.pick(&[&[0, 1], &[0], &[1]]);
    for &end in ends {
        let (s, t) = (fraction::<S>(choices), fraction::<S>(choices));
        let [a, b, c] = [a, b, c].map(|point| case.points[point][end]);
        case.points[p][end] = std::array::from_fn(|axis| a[axis] + (s * (b[axis] - a[axis]) + t * (c[axis] - a[axis])));
    }
    case
}

fn permutation(choices: &mut Choices<'_>) -> [usize; 3] {
    let all = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [1, 0, 2], [0, 2, 1], [2, 1, 0]];
    choices.pick(&all)
}

/// Exchanges each of the four points with the first.
fn order(choices: &mut Choices<'_>) -> [usize; 4] {
    let mut order = [0, 1, 2, 3];
    order.swap(0, choices.below(4) as usize);
    order
}

fn disturbed<S: Format>(mut case: PairCase<S>, choices: &mut Choices<'_>) -> PairCase<S> {
    let (one, other) = (choices.below(4) as usize, choices.below(4) as usize);
    match choices.below(13) {
        0 | 1 => {
            let steps = choices.within(3);
            let number = coordinate(&mut case, choices);
            *number = number.nudged(steps);
        }
        2 => {
            for number in case.points.iter_mut().flatten().flatten() {
                *number = number.nudged(choices.within(1));
            }
        }
        3 => {
            // Makes a coordinate equal.
            let axis = choices.below(3) as usize;
            let end = choices.below(2) as usize;
            case.points[one][end][axis] = case.points[other][choices.below(2) as usize][axis];
        }
        4 => case.points[one] = case.points[other],
        5 => case.points[one][1] = case.points[one][0],
        6 => {
            for point in &mut case.points {
                point[1] = point[0];
            }
        }
        7 => {
            let by: [S; 3] = std::array::from_fn(|_| finite(choices));
            for point in &mut case.points {
                point[1] = std::array::from_fn(|axis| point[0][axis] + by[axis]);
            }
        }
        8 => {
            // Moves a point to the line through two others, up to rounding.
            let third = choices.below(4) as usize;
            let along = S::exact(choices.within(4), -1);
            for end in 0..2 {
                let (from, to) = (case.points[other][end], case.points[third][end]);
                case.points[one][end] = std::array::from_fn(|axis| from[axis] + along * (to[axis] - from[axis]));
            }
        }
        9 => {
            let axes = permutation(choices);
            case = case.reversed().with_axes(axes);
        }
        10 => {
            let factor = S::exact(1, exponent::<S>(choices));
            case = case.map(|x| x * factor);
        }
        11 => {
            // Moves the pair far away, which rounds the shape to a coarser grid.
            let by: [S; 3] = std::array::from_fn(|_| S::exact(choices.within(3), choices.below(40) as i32));
            case = case.with_positions(|x| std::array::from_fn(|axis| x[axis] + by[axis]));
        }
        _ => *coordinate(&mut case, choices) = finite(choices),
    }
    case
}

impl<S: Format> Simplify for PairCase<S> {
    fn attempts(&self) -> usize {
        19 + 4 * 24
    }

    fn simpler(&self, attempt: usize) -> Option<Self> {
        let mut simpler = *self;
        match attempt {
            // Makes all points rest, or one.
            0..4 => simpler.points[attempt][1] = simpler.points[attempt][0],
            4..8 => simpler.points[attempt - 4][0] = simpler.points[attempt - 4][1],
            // Drops an axis.
            8..11 => {
                for x in simpler.points.iter_mut().flatten() {
                    x[attempt - 8] = S::ZERO;
                }
            }
            // Moves a point to the origin.
            11..15 => simpler.points[attempt - 11] = [[S::ZERO; 3]; 2],
            // Scales all axes, or one, to unit size.
            15..19 => {
                let axes = if attempt == 15 { 0..3 } else { attempt - 16..attempt - 15 };
                let numbers = simpler.points.iter().flatten();
                let exponents = numbers.flat_map(|x| x[axes.clone()].iter().map(|&x| binary_exponent(x)));
                let factor = S::exact(
                    1,
                    -exponents.max().unwrap_or(0).clamp(S::MIN_EXPONENT / 2, S::MAX_EXPONENT / 2),
                );
                for x in simpler.points.iter_mut().flatten() {
                    for number in &mut x[axes.clone()] {
                        *number = *number * factor;
                    }
                }
            }
            _ => {
                let (kind, index) = ((attempt - 19) % 4, (attempt - 19) / 4);
                let (point, end, axis) = (index / 6, index / 3 % 2, index % 3);
                let number = &mut simpler.points[point][end][axis];
                *number = simpler_number(*number, kind);
            }
        }
        (simpler.complexity() < self.complexity()).then_some(simpler)
    }
}

impl<S: Format> PairCase<S> {
    fn complexity(&self) -> u64 {
        let moving = self
            .points
            .iter()
            .flat_map(|[start, end]| start.iter().zip(end).map(|(from, to)| u64::from(from != to)));
        self.coordinates().map(complexity).sum::<u64>() + moving.sum::<u64>()
    }
}

/// Makes the number simpler in one of four ways.
pub(super) fn simpler_number<S: Format>(number: S, kind: usize) -> S {
    let value = number.to_f64();
    S::from_f64(match kind {
        0 => 0.0,
        1 if value.is_nan() => 1.0,
        1 => value.signum(),
        2 => value.round(),
        // Keeps half of the significant bits.
        _ => shorter(value),
    })
}

/// Drops about half of the significant bits.
fn shorter(value: f64) -> f64 {
    let (bits, kept) = (value.to_bits(), significant_bits(value) / 2);
    f64::from_bits(bits & !((1 << (52 - kept)) - 1))
}

/// Returns the number of significant bits after the leading one.
fn significant_bits(value: f64) -> u32 {
    52 - value.to_bits().trailing_zeros().min(52)
}

/// Returns 0 for zero, little for small integers, and much for many digits and far exponents.
pub(super) fn complexity<S: Format>(number: S) -> u64 {
    let value = number.to_f64();
    if value == 0.0 {
        return u64::from(value.is_sign_negative());
    }
    if !value.is_finite() {
        return 4000;
    }
    let exponent = i64::from(binary_exponent(number));
    2 + 16 * u64::from(significant_bits(value)) + exponent.unsigned_abs() + u64::from(value < 0.0)
}
