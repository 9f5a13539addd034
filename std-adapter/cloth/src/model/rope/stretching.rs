//! Stretch of a rope: one implicit step of a row of springs.
//!
//! A spring of the stiffness k = (axial stiffness)/(length L at rest), with the length ℓ along n, pulls with T = k(ℓ − L).
//! Implicit Euler solves M(x − y) = h²f(x) for x, with y the prediction of everything else and f the pull of the springs. One
//! Newton step from y solves
//!
//! ```text
//! (M + K)·d = h²f(y),    K of a spring = h²(k·n·nᵀ + a·(1 − n·nᵀ))
//! ```
//!
//! as Baraff and Witkin (1998) do for cloth. The second part of K is tension: a spring pulls back sideways motion, with a = T/ℓ.
//! Without it a taut rope of short edges would be unstable, as explicit steps are when waves travel farther than an edge. A
//! compressed spring would amplify sideways motion; this term is left out (Choi and Ko 2002), so the matrix is always definite.
//!
//! **Tension.** Tension at the end of the step counts, since a pull travels along the whole rope within a step. At y a jerk at
//! one end has not reached the other edges. So the equations are solved twice. The first time takes the tension at y, and gives
//! the tension T + k·n·(d of one end − d of the other), which the second time takes.
//!
//! **Ties.** If a seam joins the end of a rope to one other vertex, the rope is solved together with that vertex. At the largest
//! distance of the two, the spring between them is as stiff as possible. Otherwise a light end would give way to a heavy load, by
//! the ratio of the masses times the load's own fall.
//!
//! **Elimination** keeps masses beside stiffnesses up to 10⁹ times theirs. The effective mass E of a vertex, felt through a
//! spring K at the next vertex, is K(E + K)⁻¹E. This is the two in series, without a subtraction. E + K is never inverted but
//! factorised. So the error of a solution is its condition number times rounding, not the square of it.

use crate::model::energy::{Configuration, StoredEnergy};
use crate::model::step::{Constraint, TimeStep, Touches};
use crate::model::stitches::{Tie, length_at_end};
use crate::world::Cloth;
use crate::world::runs;
use selvedge_core::glam::{DMat3, DVec3};

/// The largest stiffness, as a multiple of the lighter vertex's mass over h², so that rounding is 10⁻⁷ of a move. A rope of n
/// vertices then stretches under its own weight by n·g·h²/10⁹ an edge. For n = 1,000 and h = 1 ms this is a hundredth of a
/// nanometre.
const STIFFEST: f64 = 1e9;

/// A tie longer than this share of its largest length is taut. Earlier stitches leave it so, up to rounding.
const TAUT: f64 = 0.999;

#[derive(Debug)]
pub(crate) struct Stretching {
    /// The axial stiffness, in N.
    stiffness: f64,
    pieces: Vec<Piece>,
    work: Work,
}

#[derive(Debug)]
struct Piece {
    /// The vertices, as the scene numbers them. The vertices to which the rope's ends are tied come before and after them.
    vertices: Vec<u32>,
    /// The edges, each from a vertex to the next.
    edges: Vec<Edge>,
}

#[derive(Clone, Copy, Debug)]
enum Edge {
    /// A length at rest, in m.
    Rope(f64),
    Tied(Tie),
}

/// The equations of the piece that is being solved.
#[derive(Debug, Default)]
struct Work {
    masses: Vec<Option<f64>>,
    springs: Vec<Spring>,
    links: Vec<Link>,
    moves: Vec<DVec3>,
}

/// An edge; forces are multiplied by h².
#[derive(Clone, Copy, Debug)]
struct Spring {
    /// The unit vector from its first end to its second; zero if the edge has hardly any length.
    along: DVec3,
    /// The length at rest, in m.
    length: f64,
    stiffness: f64,
    /// The pull at the prediction of everything else.
    pull: f64,
    /// The tension that pulls back sideways motion.
    tension: f64,
}

/// A vertex and the spring to the next one, after elimination of all before.
#[derive(Debug)]
struct Link {
    /// The factors of E + K; `None` for a kinematic vertex.
    factors: Option<Factors>,
    spring: DMat3,
    pull: DVec3,
}

impl Stretching {
    /// Makes the springs of a cloth with an axial stiffness, in N; `first` is its first vertex in the scene.
    pub(crate) fn new(cloth: &Cloth, stiffness: f64, first: u32, ties: &[Tie]) -> Self {
        let edges: Vec<[u32; 2]> = cloth.topology.loose_edges().collect();
        let rest = &cloth.mesh.positions;
        let piece = |row: Vec<u32>| {
            let ends = row.windows(2).map(|two| [two[0], two[1]].map(|v| rest[v as usize]));
            let mut piece = Piece {
                edges: ends.map(|[a, b]| Edge::Rope(a.distance(b))).collect(),
                vertices: row.into_iter().map(|vertex| first + vertex).collect(),
            };
            piece.tie(ties);
            piece
        };
        let runs = runs(&edges, rest.len());
        Self {
            stiffness,
            pieces: runs.iter().flat_map(|run| run.pieces()).map(piece).collect(),
            work: Work::default(),
        }
    }
}

impl Piece {
    /// Adds the vertices to which the ends are tied, unless they belong to the row.
    fn tie(&mut self, ties: &[Tie]) {
        for is_last in [false, true] {
            let end = if is_last {
                self.vertices.last()
            } else {
                self.vertices.first()
            };
            let Some(&end) = end else { continue };
            let tied = ties.iter().find_map(|tie| {
                let [one, other] = tie.vertices;
                let partner = if one == end { other } else { one };
                let is_own = self.vertices.contains(&partner);
                (tie.vertices.contains(&end) && !is_own).then_some((partner, Edge::Tied(*tie)))
            });
            if let Some((partner, edge)) = tied {
                let place = |count: usize| if is_last { count } else { 0 };
                self.vertices.insert(place(self.vertices.len()), partner);
                self.edges.insert(place(self.edges.len()), edge);
            }
        }
    }
}

impl Constraint for Stretching {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        for piece in &self.pieces {
            self.work.begin(piece, self.stiffness, step, positions);
            self.work.solve();
            self.work.take_tension();
            self.work.solve();
            for (&vertex, &moved) in piece.vertices.iter().zip(&self.work.moves) {
                positions[vertex as usize] += moved;
            }
        }
    }

    fn is_inner(&self) -> bool {
        true
    }

    /// The ties, which connect it with other cloths.
    fn joints(&self) -> Vec<[u32; 2]> {
        let tied = |piece: &Piece| {
            let edges = piece.vertices.windows(2).zip(&piece.edges);
            let tied = edges.filter(|(_, edge)| matches!(edge, Edge::Tied(_)));
            tied.map(|(two, _)| [two[0], two[1]]).collect::<Vec<_>>()
        };
        self.pieces.iter().flat_map(tied).collect()
    }

    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let at = |vertex: u32| now.positions[vertex as usize];
        let of_piece = |piece: &Piece| -> f64 {
            let edges = piece.vertices.windows(2).zip(&piece.edges);
            let energy = |(two, edge): (&[u32], &Edge)| match edge {
                Edge::Rope(length) => (at(two[0]).distance(at(two[1])) - length).powi(2) / length,
                Edge::Tied(_) => 0.0,
            };
            edges.map(energy).sum()
        };
        let all: f64 = self.pieces.iter().map(of_piece).sum();
        Some(StoredEnergy::Elastic(0.5 * self.stiffness * all))
    }
}

impl Work {
    fn begin(&mut self, piece: &Piece, stiffness: f64, step: &TimeStep<'_>, positions: &[DVec3]) {
        let inverse = piece.vertices.iter().map(|&vertex| step.inverse_masses[vertex as usize]);
        self.masses.clear();
        self.masses
            .extend(inverse.map(|inverse| (inverse > 0.0).then(|| inverse.recip())));
        let lighter = |k: usize| match [self.masses[k], self.masses[k + 1]] {
            [Some(one), Some(other)] => one.min(other),
            [one, other] => one.or(other).unwrap_or(0.0),
        };
        let edges = piece.vertices.windows(2).zip(&piece.edges).enumerate();
        let spring = |(k, (two, edge)): (usize, (&[u32], &Edge))| {
            let [from, to] = [two[0], two[1]].map(|vertex| positions[vertex as usize]);
            let stiffest = STIFFEST * lighter(k);
            match *edge {
                Edge::Rope(length) => Spring::new(to - from, length, (stiffness * step.h * step.h / length).min(stiffest)),
                Edge::Tied(tie) => {
                    let length = length_at_end(step, tie.start, tie.gap, tie.closing);
                    Spring::tied(to - from, length, stiffest)
                }
            }
        };
        self.springs.clear();
        self.springs.extend(edges.map(spring));
    }

    fn solve(&mut self) {
        let Self {
            masses,
            springs,
            links,
            moves,
        } = self;
        links.clear();
        let diagonal = |mass: f64| DMat3::from_diagonal(DVec3::splat(mass));
        // Earlier vertices add this mass and this pull to the next one.
        let (mut before, mut pulled) = (DMat3::ZERO, DVec3::ZERO);
        for (&mass, own) in masses.iter().zip(&*springs) {
            let (spring, force) = (own.matrix(), own.along * own.pull);
            let pull = pulled + force;
            let effective = mass.map(|mass| before + diagonal(mass));
            let factors = effective.map(|effective| Factors::of(effective + spring));
            (before, pulled) = match (&factors, effective) {
                (Some(factors), Some(effective)) => {
                    let columns = [effective.x_axis, effective.y_axis, effective.z_axis].map(|column| factors.solve(column));
                    let [x, y, z] = columns.map(|column| spring * column);
                    let next = DMat3::from_cols(x, y, z);
                    // Factors use one half of a matrix: rounding differences of the other half would grow from link to link.
                    let next = (next + next.transpose()) * 0.5;
                    (next, spring * factors.solve(pull) - force)
                }
                _ => (spring, -force),
            };
            links.push(Link { factors, spring, pull });
        }
        let last = masses.last().copied().flatten();
        let mut moved = last.map_or(DVec3::ZERO, |mass| Factors::of(before + diagonal(mass)).solve(pulled));
        moves.clear();
        moves.push(moved);
        for link in links.iter().rev() {
            let pull = link.pull + link.spring * moved;
            moved = link.factors.as_ref().map_or(DVec3::ZERO, |factors| factors.solve(pull));
            moves.push(moved);
        }
        moves.reverse();
    }

    /// Computes the tension that results from the moves.
    fn take_tension(&mut self) {
        // The loop is by index: with `windows` the generated code varies with the rest of the program.
        for (k, spring) in self.springs.iter_mut().enumerate() {
            spring.tension = spring.pull + spring.stiffness * spring.along.dot(self.moves[k + 1] - self.moves[k]);
        }
    }
}

/// The factors of a symmetric, positive definite matrix, L·D·Lᵀ.
#[derive(Debug)]
struct Factors {
    diagonal: DVec3,
    /// The entries of L below its diagonal of ones: that of the second row, then those of the third.
    lower: [f64; 3],
}

impl Factors {
    fn of(matrix: DMat3) -> Self {
        let DMat3 { x_axis, y_axis, z_axis } = matrix;
        let [first, second] = [x_axis.y, x_axis.z].map(|below| below / x_axis.x);
        let middle = y_axis.y - first * x_axis.y;
        let third = (y_axis.z - second * x_axis.y) / middle;
        let last = z_axis.z - second * x_axis.z - third * third * middle;
        Self {
            diagonal: DVec3::new(x_axis.x, middle, last),
            lower: [first, second, third],
        }
    }

    fn solve(&self, right: DVec3) -> DVec3 {
        let [first, second, third] = self.lower;
        let y = right.y - first * right.x;
        let z = right.z - second * right.x - third * y;
        let scaled = DVec3::new(right.x, y, z) / self.diagonal;
        let y = scaled.y - third * scaled.z;
        DVec3::new(scaled.x - first * y - second * scaled.z, y, scaled.z)
    }
}

impl Spring {
    fn new(way: DVec3, length: f64, stiffness: f64) -> Self {
        let now = way.length();
        // The direction of a shorter edge has no meaning.
        let is_there = now > 1e-6 * length;
        let pull = if is_there { stiffness * (now - length) } else { 0.0 };
        Self {
            along: if is_there { way / now } else { DVec3::ZERO },
            length,
            stiffness,
            pull,
            tension: pull,
        }
    }

    /// Makes the spring of a tie with a largest length. Below that length it does nothing, up to rounding.
    fn tied(way: DVec3, length: f64, stiffness: f64) -> Self {
        let spring = Self::new(way, length, stiffness);
        if way.length() >= TAUT * spring.length {
            return spring;
        }
        Self {
            along: DVec3::ZERO,
            pull: 0.0,
            ..spring
        }
    }

    /// Returns the stiffness matrix K of the spring. While the spring is under tension, a is less than its stiffness.
    fn matrix(&self) -> DMat3 {
        let n = self.along;
        let tension = self.tension.max(0.0);
        let across = self.stiffness * tension / (self.stiffness * self.length + tension);
        if !(across >= 0.0) || n == DVec3::ZERO {
            return DMat3::ZERO;
        }
        let along = DMat3::from_cols(n * n.x, n * n.y, n * n.z);
        along * (self.stiffness - across) + DMat3::from_diagonal(DVec3::splat(across))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn step<'a>(start: &'a [DVec3], inverse_masses: &'a [f64]) -> TimeStep<'a> {
        TimeStep::first(1e-2, start, inverse_masses)
    }

    fn point() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-0.3..0.3_f64).prop_map(DVec3::from)
    }

    proptest! {
        /// M·d + K·d = h²f holds for the matrix as a whole, with pins, from soft to stiff.
        #[test]
        fn elimination_solves_the_implicit_step(
            moves in prop::collection::vec(point(), 6), pinned in prop::collection::vec(any::<bool>(), 6),
            stiffness in prop::sample::select(vec![1.0, 1e3, 1e6]),
        ) {
            let points: Vec<DVec3> = (0..6).map(|k| DVec3::X * f64::from(k)).collect();
            let cloth = Cloth::rope(&[DVec3::ZERO, DVec3::X * 5.0], 5, 0.3).unwrap();
            let start: Vec<DVec3> = points.iter().zip(&moves).map(|(&point, &by)| point + by).collect();
            let masses = cloth.masses();
            let inverse: Vec<f64> = masses.iter().zip(&pinned).map(|(mass, &pinned)| if pinned { 0.0 } else { mass.recip() }).collect();
            let mut end = start.clone();
            Stretching::new(&cloth, stiffness, 0, &[]).project(&step(&start, &inverse), &mut end, &mut Touches::default());
            let moved: Vec<DVec3> = start.iter().zip(&end).map(|(from, to)| *to - *from).collect();
            // The equations use the tension of the first solution.
            let mut work = Work::default();
            let own = Stretching::new(&cloth, stiffness, 0, &[]);
            work.begin(&own.pieces[0], stiffness, &step(&start, &inverse), &start);
            work.solve();
            work.take_tension();
            let springs: Vec<_> = work.springs.iter().map(|spring| (spring.matrix(), spring.along * spring.pull)).collect();
            for k in 0..6 {
                if pinned[k] {
                    prop_assert_eq!(moved[k], DVec3::ZERO);
                    continue;
                }
                let mut left = moved[k] * masses[k];
                let mut size = left.length();
                for (spring, other, sign) in [(k.checked_sub(1), k.wrapping_sub(1), -1.0), ((k < 5).then_some(k), k + 1, 1.0)] {
                    if let Some((matrix, force)) = spring.map(|spring| springs[spring]) {
                        left += matrix * (moved[k] - moved[other]) - force * sign;
                        size += (matrix * (moved[k] - moved[other])).length() + force.length();
                    }
                }
                prop_assert!(left.length() < 1e-9 * size.max(1e-6), "{left} of {size}");
            }
        }
    }

    /// The equation holds in spite of the rounding of a thousand links.
    #[test]
    fn elimination_is_exact_to_rounding_over_many_stiff_links() {
        let cloth = Cloth::rope(&[DVec3::ZERO, DVec3::new(0.5, 0.0, -0.4), DVec3::X], 1000, 0.03).unwrap();
        let masses = cloth.masses();
        let mut inverse: Vec<f64> = masses.iter().map(|mass| mass.recip()).collect();
        (inverse[0], inverse[1000]) = (0.0, 0.0);
        let shaken = |(k, p): (usize, &DVec3)| *p + DVec3::new((k as f64).sin(), 0.1, (k as f64 * 1.7).cos()) * 1e-6;
        let start: Vec<DVec3> = cloth.mesh.positions.iter().enumerate().map(shaken).collect();
        let mut stretching = Stretching::new(&cloth, 1e4, 0, &[]);
        let work = &mut stretching.work;
        work.begin(&stretching.pieces[0], 1e4, &step(&start, &inverse), &start);
        for _ in 0..2 {
            work.solve();
            let turned = |k: usize| work.springs[k].matrix() * (work.moves[k + 1] - work.moves[k]);
            let pull = |k: usize| work.springs[k].along * work.springs[k].pull;
            let largest = (0..1000).map(|k| pull(k).length()).fold(0.0, f64::max);
            for k in 1..1000 {
                let forces = pull(k) - pull(k - 1) + turned(k) - turned(k - 1);
                let left = work.moves[k] * masses[k] - forces;
                assert!(left.length() < 1e-9 * largest, "{k}: {left} of {largest}");
            }
            work.take_tension();
        }
    }

    #[test]
    fn a_row_of_short_and_stiff_edges_that_is_torn_apart_comes_together_and_keeps_its_centre() {
        let cloth = Cloth::rope(&[DVec3::ZERO, DVec3::X], 1000, 0.01).unwrap();
        let masses = cloth.masses();
        let inverse: Vec<f64> = masses.iter().map(|mass| mass.recip()).collect();
        let centre = |at: &[DVec3]| at.iter().zip(&masses).map(|(p, mass)| *p * *mass).sum::<DVec3>() / 0.01;
        let start: Vec<DVec3> = cloth.mesh.positions.iter().map(|p| *p * 1.1 + DVec3::Y).collect();
        let mut end = start.clone();
        Stretching::new(&cloth, 1e9, 0, &[]).project(&step(&start, &inverse), &mut end, &mut Touches::default());
        assert!(centre(&start).distance(centre(&end)) < 1e-6, "{}", centre(&end));
        let length: f64 = end.windows(2).map(|two| two[0].distance(two[1])).sum();
        assert!((length - 1.0).abs() < 1e-4, "{length}");
    }
}
