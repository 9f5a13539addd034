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
//!
//! **Precision.** The gradient and Φ are in double precision. The linear problem, whose solution is a move, is in single precision.
//! The momentum that it loses to rounding is given back with that of all inner forces.
//!
//! **The start.** Newton's method could start at x + h·v, where cloth at rest has no residual at all. But conjugate gradients that
//! end early leave slow motion undone, such as folds that deepen without stretch: gravity would not bend the cloth.

use super::energy::{Configuration, StoredEnergy};
use super::length::length;
use super::membrane::{Membrane, all, image};
use super::rows::{PAIRS, Rows, product};
use super::schedule::On;
use super::step::{Constraint, TimeStep, Touches};
use selvedge_core::glam::{DVec3, Mat3A, Vec3, Vec3A};

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
    /// The inverse lengths, or zero for lengths near zero.
    inverse: [f64; 2],
}

/// A vector for each corner but the first. The vector of the first is minus their sum.
type Corners = [DVec3; 2];

impl Element {
    #[inline(always)]
    fn deformed(&self, x: [DVec3; 3]) -> Deformed {
        let [u, v] = [image(self.membrane.a, x), image(self.membrane.b, x)];
        let lengths = [length(u), length(v)];
        let inverse = lengths.map(|length| if length > SHORTEST { length.recip() } else { 0.0 });
        Deformed {
            directions: [u * inverse[0], v * inverse[1]],
            lengths,
            inverse,
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
            ..
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
    #[inline]
    fn curvature(&self, deformed: &Deformed) -> [Mat3A; 3] {
        let [u, v] = deformed.directions.map(|direction| direction.as_vec3a());
        let [warp, weft, shear] = self.stiffness.map(|k| k as f32);
        let across = deformed.inverse.map(|inverse| (1.0 - inverse).max(0.0) as f32);
        let (of_warp, of_weft) = (stretch(warp, u, across[0]), stretch(weft, v, across[1]));
        let [a, b] = [all(self.membrane.a), all(self.membrane.b)];
        let (by_warp, by_weft) = (v * deformed.lengths[1] as f32, u * deformed.lengths[0] as f32);
        let angle = |k: usize| by_warp * a[k] as f32 + by_weft * b[k] as f32;
        let angles = [angle(0), angle(1), angle(2)];
        let block = |[i, j]: [usize; 2]| {
            let in_plane = of_warp * (a[i] * a[j]) as f32 + of_weft * (b[i] * b[j]) as f32;
            in_plane + product(angles[i] * shear, angles[j])
        };
        [block(PAIRS[0]), block(PAIRS[1]), block(PAIRS[2])]
    }
}

/// Returns the second derivative of the energy of stretch in this direction, with the share of it that resists moves across.
#[inline]
fn stretch(stiffness: f32, direction: Vec3A, across: f32) -> Mat3A {
    let along = product(direction * (stiffness * (1.0 - across)), direction);
    along + Mat3A::from_diagonal(Vec3::splat(stiffness * across))
}

/// The elasticity of a cloth in its plane, as a constraint.
#[derive(Debug)]
pub(crate) struct Elasticity {
    elements: Vec<On<Element, 3>>,
    deformed: Vec<Deformed>,
    curvature: Rows,
    /// The diagonal of M/h², in N/m, and its inverse; both zero for kinematic vertices.
    masses: Vec<[f32; 2]>,
    /// The positions that Newton's method has reached, and those before its last step.
    x: Vec<DVec3>,
    before: Vec<DVec3>,
    /// The gradient of E at `x`.
    gradient: Vec<DVec3>,
    moves: Vec<Vec3A>,
    residual: Vec<Vec3A>,
    direction: Vec<Vec3A>,
    product: Vec<Vec3A>,
    /// By how much each iteration of a step has lowered twice Φ, in J.
    drops: Vec<f64>,
}

impl Elasticity {
    /// Makes the constraint from the triangles of a cloth of `vertex_count` vertices.
    pub(crate) fn new(elements: Vec<On<Element, 3>>, vertex_count: usize) -> Self {
        Self {
            curvature: Rows::new(elements.iter().map(|(vertices, _)| *vertices), vertex_count),
            elements,
            deformed: Vec::new(),
            masses: Vec::new(),
            x: Vec::new(),
            before: Vec::new(),
            gradient: Vec::new(),
            moves: vec![Vec3A::ZERO; vertex_count],
            residual: Vec::new(),
            direction: Vec::new(),
            product: vec![Vec3A::ZERO; vertex_count],
            drops: Vec::with_capacity(MOST * MOST_NEWTON_STEPS),
        }
    }

    /// Finds the gradient of E at `x`, and returns Φ for this goal y.
    fn look(&mut self, step: &TimeStep<'_>, goal: &[DVec3]) -> f64 {
        let Self {
            elements,
            deformed,
            x,
            gradient,
            ..
        } = self;
        gradient.clear();
        gradient.resize(x.len(), DVec3::ZERO);
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
        energy + distance(step, x, goal)
    }

    /// Finds the residual −∇Φ at `x`, and returns the square of its norm, in J.
    fn find_residual(&mut self, step: &TimeStep<'_>, goal: &[DVec3]) -> f64 {
        let per_square = (step.h * step.h).recip();
        let mut squared = 0.0;
        self.residual.clear();
        for (vertex, (x, goal)) in self.x.iter().zip(goal).enumerate() {
            let inverse_mass = step.inverse_masses[vertex];
            // A kinematic vertex has no residual.
            let residual = if inverse_mass > 0.0 {
                (*goal - *x) * (per_square / inverse_mass) - self.gradient[vertex]
            } else {
                DVec3::ZERO
            };
            squared += residual.length_squared() * (inverse_mass / per_square);
            self.residual.push(residual.as_vec3a());
        }
        squared
    }

    /// Finds the product of the second derivative of Φ with `direction`, and returns that with `direction` once more.
    fn multiply(&mut self) -> f64 {
        let Self {
            curvature,
            masses,
            direction,
            product,
            ..
        } = self;
        curvature.multiply(masses, direction, product);
        let each = product.iter().zip(&*direction);
        each.map(|(product, direction)| f64::from(product.dot(*direction))).sum()
    }

    /// Moves `x` by a step of Newton's method, from a residual of this squared norm. Returns that of the linear problem's remaining
    /// residual.
    fn solve(&mut self, mut squared: f64) -> f64 {
        self.curvature.clear();
        for (triangle, ((_, element), deformed)) in self.elements.iter().zip(&self.deformed).enumerate() {
            self.curvature.add(triangle, element.curvature(deformed));
        }
        self.moves.fill(Vec3A::ZERO);
        self.direction.clear();
        let first = self.residual.iter().zip(&self.masses);
        self.direction
            .extend(first.map(|(residual, [_, mobility])| *residual * *mobility));
        for _ in 0..MOST {
            let way = squared / self.multiply();
            let by = way as f32;
            let mut next = 0.0;
            let changes = self.residual.iter_mut().zip(&self.product).zip(&self.masses);
            for ((residual, product), [_, mobility]) in changes {
                *residual -= *product * by;
                next += f64::from(residual.length_squared() * *mobility);
            }
            for (moved, direction) in self.moves.iter_mut().zip(&self.direction) {
                *moved += *direction * by;
            }
            self.drops.push(way * squared);
            let share = (next / squared) as f32;
            squared = next;
            let last = FEWEST.max(self.drops.len() / 3);
            let mended: f64 = self.drops.iter().rev().take(last).sum();
            let is_small = self.drops.len() >= last && mended <= SMALL * SMALL * self.drops.iter().sum::<f64>();
            // A number that is not one ends the iteration, too.
            if is_small || !(squared > NEGLIGIBLE) {
                break;
            }
            let next = self.residual.iter().zip(&self.masses);
            for (direction, (residual, [_, mobility])) in self.direction.iter_mut().zip(next) {
                *direction = *residual * *mobility + *direction * share;
            }
        }
        self.before.clone_from(&self.x);
        for (x, by) in self.x.iter_mut().zip(&self.moves) {
            *x += by.as_dvec3();
        }
        squared
    }
}

/// Returns ½(x − y)ᵀM(x − y)/h².
fn distance(step: &TimeStep<'_>, x: &[DVec3], goal: &[DVec3]) -> f64 {
    let ways = x.iter().zip(goal).zip(step.inverse_masses);
    let free = ways.filter(|(_, inverse_mass)| **inverse_mass > 0.0);
    let each = free.map(|((x, goal), inverse_mass)| x.distance_squared(*goal) / inverse_mass);
    0.5 * each.sum::<f64>() / (step.h * step.h)
}

impl Constraint for Elasticity {
    fn project(&mut self, step: &TimeStep<'_>, positions: &mut [DVec3], _: &mut Touches) {
        let goal = &mut positions[..self.product.len()];
        let square = step.h * step.h;
        self.masses.clear();
        self.x.clear();
        for (vertex, goal) in goal.iter().enumerate() {
            let inverse_mass = step.inverse_masses[vertex];
            let is_free = inverse_mass > 0.0;
            let mass = if is_free { (square * inverse_mass).recip() } else { 0.0 };
            self.masses.push([mass as f32, (square * inverse_mass) as f32]);
            self.x.push(*goal);
        }
        self.drops.clear();
        let mut least = self.look(step, goal);
        let mut squared = self.find_residual(step, goal);
        for _ in 0..MOST_NEWTON_STEPS {
            // Positions whose squares overflow stay where they are.
            if !(squared > NEGLIGIBLE && least.is_finite()) {
                break;
            }
            let left = self.solve(squared);
            let mut found = self.look(step, goal);
            for _ in 0..HALVINGS {
                if found <= least * (1.0 + ROUNDING) {
                    break;
                }
                for (x, before) in self.x.iter_mut().zip(&self.before) {
                    *x = x.midpoint(*before);
                }
                found = self.look(step, goal);
            }
            // A number that is not one is not less, either.
            if !(found <= least * (1.0 + ROUNDING)) {
                std::mem::swap(&mut self.x, &mut self.before);
                break;
            }
            least = found;
            squared = self.find_residual(step, goal);
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
    use crate::model::rows::WORTH_THREADS;
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

    fn projected(cloth: &Cloth, positions: &[DVec3]) -> Vec<DVec3> {
        let mut elasticity = Elasticity::new(elements(cloth, [400.0, 300.0, 80.0]), positions.len());
        let inverse_masses: Vec<f64> = cloth.masses().into_iter().map(f64::recip).collect();
        let mut end = positions.to_vec();
        let step = TimeStep::first(H, positions, &inverse_masses);
        elasticity.project(&step, &mut end, &mut Touches::default());
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
            let [one, other, between] = [by[i], by[j], by[j] - by[i]].map(|by| by.as_vec3a());
            f64::from(one.dot(block * between) - between.dot(block * other))
        });
        let bent: f64 = bent.sum();
        assert!((bent / ((ahead - behind) / (2.0 * way)) - 1.0).abs() < 1e-6);
    }

    /// The end of a step satisfies M(x − y)/h² = −∇E(x) up to the share of the energy that the iteration leaves.
    #[test]
    fn a_step_is_one_of_implicit_euler_and_keeps_momentum() {
        let cloth = square(12);
        let start = wavy(&cloth);
        let end = projected(&cloth, &start);
        let masses = cloth.masses();
        let mut elasticity = Elasticity::new(elements(&cloth, [400.0, 300.0, 80.0]), end.len());
        let inverse_masses: Vec<f64> = masses.iter().map(|mass| mass.recip()).collect();
        let step = TimeStep::first(H, &start, &inverse_masses);
        let mut left = |x: &[DVec3]| {
            elasticity.x = x.to_vec();
            elasticity.look(&step, &start);
            elasticity.find_residual(&step, &start)
        };
        let [before, after] = [left(&start), left(&end)];
        assert!(after < 0.03 * before, "{after} of {before}");
        let momentum = |sum: DVec3, k: usize| sum + (end[k] - start[k]) * masses[k];
        let [sum, all] = [
            (0..end.len()).fold(DVec3::ZERO, momentum).length(),
            (0..end.len()).map(|k| end[k].distance(start[k]) * masses[k]).sum(),
        ];
        // The rest, of single precision, is for the [projection](crate::simulate::momentum).
        assert!(sum < 1e-7 * all, "{sum} of {all}");
    }

    #[test]
    fn many_threads_give_the_same_bits() {
        let cloth = square(46);
        let start = wavy(&cloth);
        assert!(start.len() >= WORTH_THREADS);
        let on_threads = |count| {
            let threads = Workers::new(Threads::from_count(count)).unwrap();
            threads.run(|| projected(&cloth, &start))
        };
        assert_eq!(on_threads(1), on_threads(3));
    }

    #[test]
    fn cloth_at_rest_or_beyond_numbers_stays_where_it_is() {
        let cloth = square(4);
        let rest = cloth.mesh.positions.clone();
        assert_eq!(projected(&cloth, &rest), rest);
        let far: Vec<DVec3> = rest.iter().map(|p| *p * 1e160).collect();
        assert_eq!(projected(&cloth, &far), far);
    }
}
