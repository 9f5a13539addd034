//! The part of the [matrix](super::matrix) that free rigid bodies have: their inertia, and contacts JᵀKJ with them.
//!
//! A contact sees Σw·move of the cloth's vertices, and for each body s·(move + turn × arm) with the side s. The preconditioner
//! inverts the block of the six unknowns of each body. No more is needed: bodies are few, and a body couples all that it touches.

use super::rigid::RigidBodies;
use super::rigid_body::cross;
use selvedge_core::glam::{DMat3, DVec3, Mat3A, Vec3A};

/// The unknowns of a body.
const SIX: usize = 6;

/// A matrix of a body.
type Block = [[f64; SIX]; SIX];

/// A body's side of a contact.
#[derive(Clone, Copy, Debug)]
struct BodySide {
    slot: usize,
    side: f32,
    arm: Vec3A,
}

/// Vertices of cloth with their weights; those that do not take part have a weight of zero.
type Weighted = ([u32; 4], [f32; 4]);

/// A contact with one or two bodies.
#[derive(Clone, Copy, Debug)]
struct BodyLink {
    /// The free vertices of cloth, if there are any.
    cloth: Option<Weighted>,
    stiffness: Mat3A,
    sides: [Option<BodySide>; 2],
}

/// The part of the matrix that bodies have.
#[derive(Debug, Default)]
pub(super) struct Coupled {
    first_slot: usize,
    /// M and the inertia of each body.
    inertia: Vec<(f32, Mat3A)>,
    /// 1 for each free axis of a body, along and about, and 0 for each locked one.
    freedom: Vec<[Vec3A; 2]>,
    /// The vertices of cloth that are pinned to bodies, each with its body's first slot and its arm.
    riders: Vec<(u32, usize, Vec3A)>,
    links: Vec<BodyLink>,
}

impl Coupled {
    /// Starts again, with the inertia of bodies.
    pub(super) fn begin(&mut self, bodies: &RigidBodies) {
        self.first_slot = bodies.first_slot;
        self.links.clear();
        self.riders.clear();
        bodies.visit_riders(&mut |vertex, slot, arm| self.riders.push((vertex as u32, slot, arm.as_vec3a())));
        self.inertia.clear();
        let freedom = bodies.all.iter().map(|body| body.freedom);
        self.freedom.clear();
        self.freedom
            .extend(freedom.map(|free| [free.translation, free.rotation].map(|axes| axes.as_vec3a())));
        let each = bodies.all.iter().map(|body| body.curvature());
        self.inertia.extend(each.map(|(mass, of_turn)| {
            let columns = [of_turn.x_axis, of_turn.y_axis, of_turn.z_axis].map(|column| column.as_vec3a());
            (mass as f32, Mat3A::from_cols(columns[0], columns[1], columns[2]))
        }));
    }

    pub(super) fn is_empty(&self) -> bool {
        self.inertia.is_empty()
    }

    /// Adds a contact with up to two bodies, each with its first slot, its side and its arm.
    pub(super) fn add(&mut self, cloth: Option<Weighted>, stiffness: Mat3A, touches: &[(usize, f64, DVec3)]) {
        let mut sides = [None; 2];
        for (own, &(slot, side, arm)) in sides.iter_mut().zip(touches) {
            *own = Some(BodySide {
                slot,
                side: side as f32,
                arm: arm.as_vec3a(),
            });
        }
        self.links.push(BodyLink { cloth, stiffness, sides });
    }

    /// Removes all contacts.
    pub(super) fn remove_contacts(&mut self) {
        self.links.clear();
    }

    /// Lets pinned vertices move with their bodies.
    pub(super) fn carry_riders(&self, moves: &mut [Vec3A]) {
        for &(vertex, slot, arm) in &self.riders {
            moves[vertex as usize] = moves[slot] + moves[slot + 1].cross(arm);
        }
    }

    /// Adds the product with moves. What pinned vertices feel, their bodies feel.
    pub(super) fn multiply(&self, moves: &[Vec3A], product: &mut [Vec3A]) {
        for (place, (mass, of_turn)) in self.inertia.iter().enumerate() {
            let slot = self.first_slot + 2 * place;
            product[slot] += moves[slot] * *mass;
            product[slot + 1] += *of_turn * moves[slot + 1];
        }
        for &(vertex, slot, arm) in &self.riders {
            let force = std::mem::replace(&mut product[vertex as usize], Vec3A::ZERO);
            product[slot] += force;
            product[slot + 1] += arm.cross(force);
        }
        for link in &self.links {
            let mut image = Vec3A::ZERO;
            if let Some((vertices, weights)) = &link.cloth {
                for k in 0..4 {
                    image += moves[vertices[k] as usize] * weights[k];
                }
            }
            for BodySide { slot, side, arm } in link.sides.iter().flatten() {
                image += (moves[*slot] + moves[slot + 1].cross(*arm)) * *side;
            }
            let force = link.stiffness * image;
            if let Some((vertices, weights)) = &link.cloth {
                for k in 0..4 {
                    product[vertices[k] as usize] += force * weights[k];
                }
            }
            for BodySide { slot, side, arm } in link.sides.iter().flatten() {
                let force = force * *side;
                product[*slot] += force;
                product[slot + 1] += arm.cross(force);
            }
        }
        let slots = product[self.first_slot..].as_chunks_mut::<2>().0;
        for (slots, freedom) in slots.iter_mut().zip(&self.freedom) {
            slots[0] *= freedom[0];
            slots[1] *= freedom[1];
        }
    }

    /// Returns the vertices of cloth that are pinned to bodies.
    pub(super) fn riders(&self) -> impl Iterator<Item = u32> {
        self.riders.iter().map(|(vertex, ..)| *vertex)
    }

    /// Returns the block of each body; `diagonal` has those of vertices.
    fn blocks(&self, diagonal: &[Mat3A]) -> Vec<Block> {
        let mut blocks: Vec<Block> = { self.inertia.iter() }
            .map(|(mass, of_turn)| {
                let mut block = [[0.0; SIX]; SIX];
                add(&mut block, [0, 0], &DMat3::from_diagonal(DVec3::splat(f64::from(*mass))));
                add(&mut block, [3, 3], &of_turn.as_dmat3());
                block
            })
            .collect();
        let riders = self.riders.iter();
        let riders = riders.map(|(vertex, slot, arm)| (slot, arm, &diagonal[*vertex as usize]));
        let arms = self.links.iter().flat_map(|link| {
            let arms = link.sides.iter().flatten();
            arms.map(|BodySide { slot, arm, .. }| (slot, arm, &link.stiffness))
        });
        for (slot, arm, stiffness) in riders.chain(arms) {
            let block = &mut blocks[(slot - self.first_slot) / 2];
            let (stiffness, arm) = (stiffness.as_dmat3(), cross(arm.as_dvec3()));
            // move + turn × arm = move − arm × turn.
            let turned = stiffness * -arm;
            add(block, [0, 0], &stiffness);
            add(block, [0, 3], &turned);
            add(block, [3, 0], &turned.transpose());
            add(block, [3, 3], &(arm * turned));
        }
        for (block, [translation, rotation]) in blocks.iter_mut().zip(&self.freedom) {
            let is_locked = |axis: usize| if axis < 3 { translation[axis] } else { rotation[axis - 3] } == 0.0;
            for axis in (0..SIX).filter(|&axis| is_locked(axis)) {
                block[axis] = [0.0; SIX];
                block.iter_mut().for_each(|row| row[axis] = 0.0);
                block[axis][axis] = 1.0;
            }
        }
        blocks
    }
}

/// Adds a matrix at a row and a column.
fn add(block: &mut Block, [row, column]: [usize; 2], part: &DMat3) {
    for (k, own) in [part.x_axis, part.y_axis, part.z_axis].into_iter().enumerate() {
        for (j, number) in own.to_array().into_iter().enumerate() {
            block[row + j][column + k] += number;
        }
    }
}

/// The factors of the blocks of all bodies, for the preconditioner.
#[derive(Debug, Default)]
pub(super) struct BodyFactors {
    first_slot: usize,
    /// The lower factor L of each block L·Lᵀ.
    factors: Vec<Block>,
}

impl BodyFactors {
    pub(super) fn factorise(&mut self, coupled: &Coupled, diagonal: &[Mat3A]) {
        self.first_slot = coupled.first_slot;
        self.factors.clear();
        if !coupled.is_empty() {
            self.factors.extend(coupled.blocks(diagonal).iter().map(cholesky));
        }
    }

    /// Finds the image of the residual in the slots of bodies, and returns the sum of their products.
    pub(super) fn solve(&self, residual: &[Vec3A], image: &mut [Vec3A]) -> f64 {
        let mut sum = 0.0;
        for (place, factor) in self.factors.iter().enumerate() {
            let slot = self.first_slot + 2 * place;
            let [displacement, turn] = [residual[slot], residual[slot + 1]].map(|own| own.as_dvec3().to_array());
            let mut own = [displacement[0], displacement[1], displacement[2], turn[0], turn[1], turn[2]];
            for row in 0..SIX {
                for k in 0..row {
                    own[row] -= factor[row][k] * own[k];
                }
                own[row] /= factor[row][row];
            }
            for row in (0..SIX).rev() {
                for k in row + 1..SIX {
                    own[row] -= factor[k][row] * own[k];
                }
                own[row] /= factor[row][row];
            }
            let single = own.map(|number| number as f32);
            (image[slot], image[slot + 1]) = (Vec3A::from_slice(&single[..3]), Vec3A::from_slice(&single[3..]));
            sum += f64::from(residual[slot].dot(image[slot]));
            sum += f64::from(residual[slot + 1].dot(image[slot + 1]));
        }
        sum
    }
}

/// Returns the lower factor of a symmetric positive definite block. A pivot that rounding has made something else becomes as
/// large as the block's own number.
fn cholesky(block: &Block) -> Block {
    let mut factor = [[0.0; SIX]; SIX];
    for row in 0..SIX {
        for column in 0..=row {
            let products = (0..column).map(|k| factor[row][k] * factor[column][k]);
            let rest = products.fold(block[row][column], |rest, product| rest - product);
            factor[row][column] = if row != column {
                rest / factor[column][column]
            } else if rest > 0.0 {
                rest.sqrt()
            } else {
                block[row][row].sqrt()
            };
        }
    }
    factor
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = DVec3> {
        prop::array::uniform3(-1.0..1.0_f64).prop_map(DVec3::from)
    }

    proptest! {
        /// A body that touches nothing but fixed things has a block of its own, which the factors invert.
        #[test]
        fn the_factors_of_a_body_invert_its_part_of_the_matrix(
            arms in prop::collection::vec((vector(), vector()), 0..5),
            moves in [vector(), vector()],
        ) {
            let mut coupled = Coupled {
                first_slot: 1,
                inertia: vec![(2.0, Mat3A::from_diagonal(selvedge_core::glam::Vec3::new(0.1, 0.2, 0.3)))],
                freedom: vec![[Vec3A::ONE; 2]],
                riders: Vec::new(),
                links: Vec::new(),
            };
            for (arm, normal) in arms {
                let normal = normal.normalize_or(DVec3::X).as_vec3a();
                let along = normal * 3.0;
                let stiffness = Mat3A::from_cols(along * normal.x, along * normal.y, along * normal.z);
                coupled.add(None, stiffness, &[(1, -1.0, arm)]);
            }
            let moves = [Vec3A::ZERO, moves[0].as_vec3a(), moves[1].as_vec3a()];
            let (mut product, mut image) = ([Vec3A::ZERO; 3], [Vec3A::ZERO; 3]);
            coupled.multiply(&moves, &mut product);
            let mut factors = BodyFactors::default();
            factors.factorise(&coupled, &[]);
            let sum = factors.solve(&product, &mut image);
            for k in 0..3 {
                prop_assert!((image[k] - moves[k]).length() < 1e-4, "{:?} instead of {:?}", image[k], moves[k]);
            }
            let expected: f32 = (0..3).map(|k| product[k].dot(image[k])).sum();
            prop_assert!((sum - f64::from(expected)).abs() < 1e-4 * sum.abs().max(1.0));
        }
    }
}
