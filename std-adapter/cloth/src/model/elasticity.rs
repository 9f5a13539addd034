//! Stretch and shear of a cloth in one implicit step, solved until little changes.
//!
//! Warp and weft of a triangle of area A have the images w_u and w_v ([`Membrane`]). Its energy is
//! ½k_u·A·(|w_u| − 1)² + ½k_v·A·(|w_v| − 1)² + ½G·A·(w_u·w_v)². With the prediction y of everything else, the step finds the least
//! value over x of
//!
//! ```text
//! Φ(x) = ½(x − y)ᵀM(x − y)/h² + E(x)
//! ```
//!
//! which is implicit Euler. Newton's method starts at y. It finds its step by conjugate gradients, with the masses M/h² as the
//! preconditioner and the convex part of the second derivative of E. If Φ does not fall, the step is halved. So no stiffness and
//! no state makes the cloth unstable.
//!
//! **Accuracy.** A Gauss–Seidel sweep over the triangles (extended position-based dynamics) leaves to each triangle what its later
//! neighbours do. At rest that makes a cloth softer: the strain is off by the order of h²·T/(ρ·a²) for a tension T and edges a, in
//! every step. Conjugate gradients have no such error. Their first direction is h²·M⁻¹ times the force, which is right for motion
//! that is slow in a step. The others are for what is fast.
//!
//! **The end.** Iteration i lowers Φ by dᵢ, half of which is the square of the energy norm of what it mends (Hestenes and Stiefel
//! 1952). The error after k iterations is about that of the next ones, and those are like the last ones. So it ends when the last
//! third has mended little of the whole: Σ dᵢ over the third is at most [`SMALL`]² of the sum over all. Soft cloth needs two or
//! three iterations. In general the number is about that of the edges that a pull passes in a step.

use super::energy::{Configuration, StoredEnergy};
use super::membrane::{Membrane, all, image};
use super::schedule::On;
use super::step::{Constraint, TimeStep, Touches};
use crate::world::Incidence;
use selvedge::parallel;
use selvedge_core::glam::{DMat3, DVec3};

/// The error that needs no other iteration, as a share of the whole correction in the energy norm.
const SMALL: f64 = 0.1;
/// The least number of last iterations that must mend little.
const FEWEST: usize = 2;
/// The largest number of iterations for one step of Newton's method.
const MOST: usize = 100;
/// The largest number of steps of Newton's method.
const MOST_NEWTON_STEPS: usize = 3;
/// The largest ratio of the square of the remaining force to that of the linear problem that needs no other step of Newton's method.
const NEARLY_LINEAR: f64 = 4.0;
/// The largest number of halvings of a step.
const HALVINGS: usize = 6;
/// The rounding of Φ, as a share of it.
const ROUNDING: f64 = 1e-12;
/// An energy in J that is not worth an iteration. Rounding of forces leaves less.
const NEGLIGIBLE: f64 = 1e-24;
/// A vector shorter than this has no reliable direction.
const SHORTEST: f64 = 1e-6;
/// The number of vertices that are worth several threads in each iteration.
const WORTH_THREADS: usize = 2048;

/// Resistance of a triangle to stretch along warp and weft, and to shear.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Element {
    pub(crate) membrane: Membrane,
    /// The stiffnesses of warp, weft and shear, times the area, in J.
    pub(crate) stiffness: [f64; 3],
}

/// The directions and the lengths of the images of warp and weft in a triangle.
#[derive(Clone, Copy, Debug, Default)]
struct Deformed {
    directions: [DVec3; 2],
    lengths: [f64; 2],
}

/// A vector for each corner but the first. The vector of the first is minus their sum.
type Corners = [DVec3; 2];

impl Element {
    #[inline(always)]
    fn deformed(&self, x: [DVec3; 3]) -> Deformed {
        let [u, v] = [image(self.membrane.a, x), image(self.membrane.b, x)];
        let lengths = [u.length(), v.length()];
        let unit = |image: DVec3, length: f64| if length > SHORTEST { image / length } else { DVec3::ZERO };
        Deformed {
            directions: [unit(u, lengths[0]), unit(v, lengths[1])],
            lengths,
        }
    }

    /// Returns what vectors for the images of warp and weft mean for the corners.
    #[inline(always)]
    fn corners(&self, of_warp: DVec3, of_weft: DVec3) -> Corners {
        let Membrane { a, b } = self.membrane;
        [of_warp * a[0] + of_weft * b[0], of_warp * a[1] + of_weft * b[1]]
    }

    /// Returns the gradient of the energy, and the energy in J.
    #[inline(always)]
    fn gradient(&self, deformed: &Deformed) -> (Corners, f64) {
        let Deformed {
            directions: [u, v],
            lengths: [along_u, along_v],
        } = *deformed;
        let [warp, weft, shear] = self.stiffness;
        let (longer_u, longer_v) = (along_u - 1.0, along_v - 1.0);
        let angle = u.dot(v) * along_u * along_v;
        let of_warp = u * (warp * longer_u) + v * (shear * angle * along_v);
        let of_weft = v * (weft * longer_v) + u * (shear * angle * along_u);
        let energy = 0.5 * (warp * longer_u * longer_u + weft * longer_v * longer_v + shear * angle * angle);
        (self.corners(of_warp, of_weft), energy)
    }

    /// Returns the convex part of the second derivative between two corners, for each of the [`PAIRS`]. A compressed direction
    /// resists no move across, and of shear only the product of first derivatives counts.
    #[inline(always)]
    fn curvature(&self, deformed: &Deformed) -> [DMat3; 3] {
        let Deformed {
            directions: [u, v],
            lengths: [along_u, along_v],
        } = *deformed;
        let [warp, weft, shear] = self.stiffness;
        let stretch = |stiffness: f64, direction: DVec3, length: f64| {
            let across = if length > 1.0 { 1.0 - 1.0 / length } else { 0.0 };
            product(direction * (stiffness * (1.0 - across)), direction) + DMat3::from_diagonal(DVec3::splat(stiffness * across))
        };
        let (of_warp, of_weft) = (stretch(warp, u, along_u), stretch(weft, v, along_v));
        let (a, b) = (all(self.membrane.a), all(self.membrane.b));
        let (across_warp, across_weft) = (v * along_v, u * along_u);
        let angle = [0, 1, 2].map(|k| across_warp * a[k] + across_weft * b[k]);
        PAIRS.map(|[i, j]| of_warp * (a[i] * a[j]) + of_weft * (b[i] * b[j]) + product(angle[i] * shear, angle[j]))
    }
}

/// The pairs of corners.
const PAIRS: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];

/// Returns a·bᵀ.
#[inline(always)]
fn product(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// The second derivative of E. A row has the blocks between a vertex and its neighbours. The vertex's own block is minus their sum,
/// since E does not change if all vertices move by the same.
#[derive(Debug)]
struct Rows {
    /// The neighbours of each vertex.
    neighbours: Incidence<u32>,
    blocks: Vec<DMat3>,
    /// The blocks of each triangle's [`PAIRS`], from the first to the second corner and back.
    places: Vec<[[u32; 2]; 3]>,
}

impl Rows {
    fn new(elements: &[On<Element, 3>], vertex_count: usize) -> Self {
        let pairs = elements
            .iter()
            .flat_map(|(vertices, _)| PAIRS.map(|pair| pair.map(|corner| vertices[corner])));
        let mut links: Vec<[u32; 2]> = pairs.flat_map(|[one, other]| [[one, other], [other, one]]).collect();
        links.sort_unstable();
        links.dedup();
        let place = |link: [u32; 2]| links.partition_point(|&other| other < link) as u32;
        let places = elements.iter().map(|(vertices, _)| {
            PAIRS.map(|pair| {
                let [one, other] = pair.map(|corner| vertices[corner]);
                [place([one, other]), place([other, one])]
            })
        });
        Self {
            places: places.collect(),
            neighbours: Incidence::new(vertex_count, || links.iter().map(|&[vertex, other]| (vertex, other))),
            blocks: vec![DMat3::ZERO; links.len()],
        }
    }

    fn find(&mut self, elements: &[On<Element, 3>], deformed: &[Deformed]) {
        self.blocks.fill(DMat3::ZERO);
        for (((_, element), deformed), places) in elements.iter().zip(deformed).zip(&self.places) {
            for (block, [there, back]) in element.curvature(deformed).into_iter().zip(*places) {
                self.blocks[there as usize] += block;
                self.blocks[back as usize] += block.transpose();
            }
        }
    }

    /// Returns a row's product with these moves.
    #[inline(always)]
    fn product(&self, vertex: usize, moves: &[DVec3]) -> DVec3 {
        let own = moves[vertex];
        let blocks = &self.blocks[self.neighbours.range(vertex)];
        let others = self.neighbours.of(vertex).iter().zip(blocks);
        others.fold(DVec3::ZERO, |sum, (&other, block)| {
            sum + *block * (moves[other as usize] - own)
        })
    }
}

/// The elasticity of a cloth in its plane, as a constraint.
#[derive(Debug)]
pub(crate) struct Elasticity {
    elements: Vec<On<Element, 3>>,
    deformed: Vec<Deformed>,
    rows: Rows,
    /// The diagonal of M/h², in N/m, and its inverse; both zero for kinematic vertices.
    masses: Vec<f64>,
    mobilities: Vec<f64>,
    /// The positions that Newton's method has reached, and those before its last step.
    x: Vec<DVec3>,
    before: Vec<DVec3>,
    /// The gradient of E at `x`.
    gradient: Vec<DVec3>,
    residual: Vec<DVec3>,
    direction: Vec<DVec3>,
    product: Vec<DVec3>,
    /// By how much each iteration of a step has lowered twice Φ, in J.
    drops: Vec<f64>,
}

impl Elasticity {
    /// Makes the constraint from the triangles of a cloth of `vertex_count` vertices.
    pub(crate) fn new(elements: Vec<On<Element, 3>>, vertex_count: usize) -> Self {
        Self {
            rows: Rows::new(&elements, vertex_count),
            elements,
            deformed: Vec::new(),
            masses: Vec::new(),
            mobilities: Vec::new(),
            x: Vec::new(),
            before: Vec::new(),
            gradient: Vec::new(),
            residual: vec![DVec3::ZERO; vertex_count],
            direction: Vec::new(),
            product: vec![DVec3::ZERO; vertex_count],
            drops: Vec::with_capacity(MOST * MOST_NEWTON_STEPS),
        }
    }

    /// Finds E and its derivatives at `x`, and returns Φ for this goal y.
    fn look(&mut self, goal: &[DVec3]) -> f64 {
        let Self {
            elements,
            deformed,
            x,
            gradient,
            masses,
            ..
        } = self;
        gradient.clear();
        gradient.resize(masses.len(), DVec3::ZERO);
        deformed.clear();
        let mut energy = 0.0;
        for (vertices, element) in &*elements {
            let [first, second, third] = vertices.map(|vertex| vertex as usize);
            let found = element.deformed([x[first], x[second], x[third]]);
            let ([of_second, of_third], own) = element.gradient(&found);
            deformed.push(found);
            energy += own;
            gradient[first] -= of_second + of_third;
            gradient[second] += of_second;
            gradient[third] += of_third;
        }
        let ways = masses.iter().zip(goal).zip(x);
        energy + 0.5 * ways.map(|((mass, goal), x)| mass * goal.distance_squared(*x)).sum::<f64>()
    }

    /// Finds the residual −∇Φ at `x`, and returns the square of its norm, in J.
    fn find_residual(&mut self, goal: &[DVec3]) -> f64 {
        let mut squared = 0.0;
        for (vertex, &mass) in self.masses.iter().enumerate() {
            // A kinematic vertex has no residual.
            let is_free = f64::from(u8::from(mass > 0.0));
            let residual = (goal[vertex] - self.x[vertex]) * mass - self.gradient[vertex] * is_free;
            squared += residual.length_squared() * self.mobilities[vertex];
            self.residual[vertex] = residual;
        }
        squared
    }

    /// Moves `x` by a step of Newton's method, from a residual of this squared norm. Returns that of the linear problem's remaining
    /// residual.
    fn solve(&mut self, mut squared: f64) -> f64 {
        let Self {
            elements,
            deformed,
            rows,
            masses,
            mobilities,
            x,
            residual,
            direction,
            product,
            drops,
            ..
        } = self;
        rows.find(elements, deformed);
        direction.clear();
        direction.extend(
            residual
                .iter()
                .zip(&*mobilities)
                .map(|(residual, &mobility)| *residual * mobility),
        );
        for _ in 0..MOST {
            let (rows_read, moves, masses_read) = (&*rows, &*direction, &*masses);
            let multiply = |vertex: usize, product: &mut DVec3| {
                *product = rows_read.product(vertex, moves) + moves[vertex] * masses_read[vertex];
            };
            if product.len() < WORTH_THREADS {
                product
                    .iter_mut()
                    .enumerate()
                    .for_each(|(vertex, product)| multiply(vertex, product));
            } else {
                parallel::for_each(product, multiply);
            }
            let bent: f64 = product
                .iter()
                .zip(&*direction)
                .map(|(product, direction)| product.dot(*direction))
                .sum();
            let way = squared / bent;
            let mut next = 0.0;
            for (vertex, &mobility) in mobilities.iter().enumerate() {
                x[vertex] += direction[vertex] * way;
                residual[vertex] -= product[vertex] * way;
                next += residual[vertex].length_squared() * mobility;
            }
            drops.push(way * squared);
            let share = next / squared;
            squared = next;
            let last = FEWEST.max(drops.len() / 3);
            let mended: f64 = drops.iter().rev().take(last).sum();
            let is_small = drops.len() >= last && mended <= SMALL * SMALL * drops.iter().sum::<f64>();
            // A number that is not one ends the iteration, too.
            if is_small || !(squared > NEGLIGIBLE) {
                break;
            }
            for (vertex, &mobility) in mobilities.iter().enumerate() {
                direction[vertex] = residual[vertex] * mobility + direction[vertex] * share;
            }
        }
        squared
    }
}

impl Constraint for Elasticity {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        let count = self.product.len();
        let goal = &mut positions[..count];
        let per_square = (step.h * step.h).recip();
        let mass = |inverse_mass: &f64| if *inverse_mass > 0.0 { per_square / inverse_mass } else { 0.0 };
        let inverse_masses = &step.inverse_masses[..count];
        self.masses.clear();
        self.masses.extend(inverse_masses.iter().map(mass));
        self.mobilities.clear();
        self.mobilities
            .extend(inverse_masses.iter().map(|inverse_mass| inverse_mass * step.h * step.h));
        self.x.clear();
        self.x.extend_from_slice(goal);
        self.drops.clear();
        let mut least = self.look(goal);
        let mut squared = self.find_residual(goal);
        for _ in 0..MOST_NEWTON_STEPS {
            // Positions whose squares overflow stay where they are.
            if !(squared > NEGLIGIBLE && least.is_finite()) {
                break;
            }
            self.before.clone_from(&self.x);
            let left = self.solve(squared);
            let mut found = self.look(goal);
            for _ in 0..HALVINGS {
                if found <= least * (1.0 + ROUNDING) {
                    break;
                }
                for (x, before) in self.x.iter_mut().zip(&self.before) {
                    *x = x.midpoint(*before);
                }
                found = self.look(goal);
            }
            // A number that is not one is not less, either.
            if !(found <= least * (1.0 + ROUNDING)) {
                std::mem::swap(&mut self.x, &mut self.before);
                break;
            }
            least = found;
            squared = self.find_residual(goal);
            if squared <= NEARLY_LINEAR * left {
                break;
            }
        }
        goal.copy_from_slice(&self.x);
    }

    fn is_inner(&self) -> bool {
        true
    }

    /// Returns the energy of stretch. That of shear belongs to another effect.
    fn energy(&self, now: &Configuration<'_>) -> Option<StoredEnergy> {
        let of_element = |(vertices, element): &On<Element, 3>| {
            let [warp, weft, _] = element.stiffness;
            let stretch = Element {
                stiffness: [warp, weft, 0.0],
                ..*element
            };
            let x = vertices.map(|vertex| now.positions[vertex as usize]);
            stretch.gradient(&stretch.deformed(x)).1
        };
        Some(StoredEnergy::Elastic(self.elements.iter().map(of_element).sum()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::membrane::of_triangles;
    use crate::world::{Cloth, sheet};
    use selvedge::Threads;
    use selvedge::parallel::Workers;
    use selvedge_core::glam::DVec2;

    const H: f64 = 1e-3;

    fn elements(cloth: &Cloth, stiffness: [f64; 3]) -> Vec<On<Element, 3>> {
        of_triangles(cloth, |membrane, area| Element {
            membrane,
            stiffness: stiffness.map(|k| k * area),
        })
    }

    fn square(cells: u32) -> Cloth {
        Cloth::of(sheet(DVec3::ZERO, [DVec3::X, DVec3::Y], [cells, cells]))
    }

    fn wavy(cloth: &Cloth) -> Vec<DVec3> {
        let wave = |p: &DVec3| DVec3::new(1.05 * p.x + 0.02 * (7.0 * p.y).sin(), p.y, 0.05 * (9.0 * p.x).cos());
        cloth.mesh.positions.iter().map(wave).collect()
    }

    fn projected(cloth: &Cloth, positions: &[DVec3], threads: usize) -> Vec<DVec3> {
        let mut elasticity = Elasticity::new(elements(cloth, [400.0, 300.0, 80.0]), positions.len());
        let inverse_masses: Vec<f64> = cloth.masses().into_iter().map(f64::recip).collect();
        let mut end = positions.to_vec();
        let step = TimeStep::first(H, positions, &inverse_masses);
        let threads = Workers::new(Threads::from_count(threads)).unwrap();
        threads.run(|| elasticity.project(&step, &mut end, &mut Touches::default()));
        end
    }

    /// Where warp and weft are stretched and perpendicular, the second derivative is all convex.
    #[test]
    fn gradient_and_curvature_are_derivatives_of_the_energy() {
        let element = Element {
            membrane: Membrane::new(DVec2::X, DVec2::Y),
            stiffness: [400.0, 300.0, 80.0],
        };
        let at = [DVec3::ZERO, DVec3::new(1.2, 0.0, 0.3), DVec3::new(0.0, 1.1, 0.0)];
        let mut x = at;
        x[1].y += 0.3;
        let by = [
            DVec3::new(0.1, -0.3, 0.2),
            DVec3::new(-0.2, 0.1, 0.4),
            DVec3::new(0.3, 0.2, -0.1),
        ];
        let moved = |x: [DVec3; 3], way: f64| [0, 1, 2].map(|k| x[k] + by[k] * way);
        let whole = |[second, third]: Corners| [-second - third, second, third];
        let along = |gradient: [DVec3; 3]| (0..3).map(|k| gradient[k].dot(by[k])).sum::<f64>();
        let of = |x: [DVec3; 3]| element.gradient(&element.deformed(x));
        let way = 1e-5;
        let slope = (of(moved(x, way)).1 - of(moved(x, -way)).1) / (2.0 * way);
        assert!((along(whole(of(x).0)) / slope - 1.0).abs() < 1e-8);
        let [ahead, behind] = [way, -way].map(|way| along(whole(of(moved(at, way)).0)));
        let blocks = element.curvature(&element.deformed(at));
        let bent = PAIRS.iter().zip(blocks).map(|(&[i, j], block)| {
            let between = by[j] - by[i];
            by[i].dot(block * between) - between.dot(block * by[j])
        });
        let bent: f64 = bent.sum();
        assert!((bent / ((ahead - behind) / (2.0 * way)) - 1.0).abs() < 1e-6);
    }

    /// The end of a step satisfies M(x − y)/h² = −∇E(x) up to the share of the energy that the iteration leaves.
    #[test]
    fn a_step_is_one_of_implicit_euler_and_keeps_momentum() {
        let cloth = square(12);
        let start = wavy(&cloth);
        let end = projected(&cloth, &start, 1);
        let masses = cloth.masses();
        let mut elasticity = Elasticity::new(elements(&cloth, [400.0, 300.0, 80.0]), end.len());
        elasticity.masses = masses.iter().map(|mass| mass / (H * H)).collect();
        elasticity.mobilities = masses.iter().map(|mass| H * H / mass).collect();
        let mut left = |x: &[DVec3]| {
            elasticity.x = x.to_vec();
            elasticity.look(&start);
            elasticity.find_residual(&start)
        };
        let [before, after] = [left(&start), left(&end)];
        assert!(after < 0.03 * before, "{after} of {before}");
        let momentum = |sum: DVec3, k: usize| sum + (end[k] - start[k]) * masses[k];
        let [sum, all] = [
            (0..end.len()).fold(DVec3::ZERO, momentum).length(),
            (0..end.len()).map(|k| end[k].distance(start[k]) * masses[k]).sum(),
        ];
        assert!(sum < 1e-12 * all, "{sum} of {all}");
    }

    #[test]
    fn many_threads_give_the_same_bits() {
        let cloth = square(46);
        let start = wavy(&cloth);
        assert!(start.len() >= WORTH_THREADS);
        assert_eq!(projected(&cloth, &start, 1), projected(&cloth, &start, 3));
    }

    #[test]
    fn cloth_at_rest_or_beyond_numbers_stays_where_it_is() {
        let cloth = square(4);
        let rest = cloth.mesh.positions.clone();
        assert_eq!(projected(&cloth, &rest, 1), rest);
        let far: Vec<DVec3> = rest.iter().map(|p| *p * 1e160).collect();
        assert_eq!(projected(&cloth, &far, 1), far);
    }
}
