//! The second derivative of a step's energy, in single precision.
//!
//! It consists of
//!
//! * a block for each vertex: its mass over h², and springs to fixed points;
//! * blocks between the corners of triangles, whose rows sum to zero with the vertex's block, since inner energies do not change
//!   when all vertices move alike;
//! * one number for the two vertices of a hinge that share no triangle. Bending is the same along all axes, and constant;
//! * [links](Link) JᵀKJ of up to four vertices: contacts, ropes, stitches;
//! * [products](RankOne) β·g·gᵀ of whole cloths: a gas in a closed cloth;
//! * the [part](super::coupled) that free rigid bodies have, in slots after the vertices.

use super::bands::Bands;
use super::coupled::Coupled;
use super::rigid::RigidBodies;
use selvedge::{Adjacency, parallel};
use selvedge_core::glam::{DMat3, DVec3, Mat3A, Vec3, Vec3A};

/// The pairs of corners of a triangle.
pub(crate) const PAIRS: [[usize; 2]; 3] = [[0, 1], [0, 2], [1, 2]];
/// The number of vertices that are worth several threads.
pub(super) const WORTH_THREADS: usize = 2048;

/// JᵀKJ, where J maps moves of four vertices to Σ w·move. Vertices that do not take part have a weight of zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) vertices: [u32; 4],
    pub(super) weights: [f32; 4],
    pub(super) stiffness: Mat3A,
}

impl Link {
    /// Adds its blocks to the whole blocks of its vertices.
    #[inline]
    fn add_to(&self, diagonal: &mut [Mat3A]) {
        for (&vertex, weight) in self.vertices.iter().zip(self.weights) {
            if weight != 0.0 {
                diagonal[vertex as usize] += self.stiffness * (weight * weight);
            }
        }
    }
}

/// β·g·gᵀ.
#[derive(Debug, Default)]
pub(super) struct RankOne {
    pub(super) factor: f64,
    pub(super) direction: Vec<Vec3A>,
}

/// The blocks of a vertex.
#[derive(Clone, Copy, Debug)]
struct Blocks {
    vertex: u32,
    own: Mat3A,
    diagonal: Mat3A,
    beside_ropes: Mat3A,
}

/// The second derivative of the energy of a step.
#[derive(Debug, Default)]
pub struct Matrix {
    /// The vertices that share a triangle with each vertex.
    neighbours: Adjacency<u32>,
    /// The block between a vertex and each of its neighbours, and the part of it that bending has, which is constant.
    blocks: Vec<Mat3A>,
    of_bending: Vec<f32>,
    /// The places of the blocks of each triangle's [`PAIRS`], from the first to the second corner and back.
    places: Vec<[[u32; 2]; 3]>,
    /// The vertices that share a hinge with each vertex, but no triangle, and the number between them.
    bent: Adjacency<(u32, f32)>,
    /// The block of each vertex besides those that the rows of `blocks` and `bent` imply.
    own: Vec<Mat3A>,
    pub(super) links: Vec<Link>,
    /// The first link of a contact, and the blocks that contacts have changed, as they were before.
    first_contact: usize,
    before_contacts: Vec<Blocks>,
    /// The vertices of all contacts since [`begin_contacts`](Self::begin_contacts); many twice.
    pub(super) pressed: Vec<u32>,
    /// The links of ropes, and the same in double precision, for the preconditioner.
    of_ropes: Vec<Link>,
    pub(super) bands: Bands,
    pub(super) ranks: Vec<RankOne>,
    /// The number of `ranks` in use.
    pub(super) used_ranks: usize,
    /// The whole block of each vertex.
    pub(super) diagonal: Vec<Mat3A>,
    /// The same without the links of ropes.
    pub(super) beside_ropes: Vec<Mat3A>,
    /// True for fixed vertices, those that are pinned to free bodies, and the slots of bodies.
    pub(super) is_fixed: Vec<bool>,
    /// True for vertices that are pinned to free bodies.
    rides: Vec<bool>,
    pub(super) coupled: Coupled,
    /// True unless conjugate gradients have met a direction without stiffness in this step.
    pub(super) may_be_indefinite: bool,
}

impl Matrix {
    /// Makes a matrix of zeros for `vertex_count` vertices in these triangles. `bending` has the vertices and the weights of
    /// hinges, and the stiffness of each, `ropes` successive vertices.
    pub(super) fn new(
        triangles: &[[u32; 3]],
        bending: &[([u32; 4], [f64; 4], f64)],
        ropes: &[Vec<u32>],
        vertex_count: usize,
    ) -> Self {
        let pairs = || {
            triangles
                .iter()
                .flat_map(|vertices| PAIRS.map(|pair| pair.map(|corner| vertices[corner])))
        };
        let mut both: Vec<[u32; 2]> = pairs().flat_map(|[one, other]| [[one, other], [other, one]]).collect();
        both.sort_unstable();
        both.dedup();
        let place = |pair: [u32; 2]| both.partition_point(|&other| other < pair) as u32;
        let places: Vec<_> = pairs()
            .map(|[one, other]| [place([one, other]), place([other, one])])
            .collect();
        let mut bent: Vec<([u32; 2], f64)> = Vec::new();
        for (vertices, weights, stiffness) in bending {
            for [i, j] in (0..4).flat_map(|i| (0..4).map(move |j| [i, j])).filter(|[i, j]| i != j) {
                bent.push(([vertices[i], vertices[j]], stiffness * weights[i] * weights[j]));
            }
        }
        bent.sort_by_key(|(pair, _)| *pair);
        let mut of_bending = vec![0.0; both.len()];
        let mut apart: Vec<(u32, (u32, f32))> = Vec::new();
        for own in bent.chunk_by(|one, other| one.0 == other.0) {
            let (pair, number) = (own[0].0, own.iter().map(|(_, k)| k).sum::<f64>() as f32);
            match both.binary_search(&pair) {
                Ok(place) => of_bending[place] = number,
                Err(_) => apart.push((pair[0], (pair[1], number))),
            }
        }
        Self {
            neighbours: Adjacency::new(vertex_count, || both.iter().map(|&[vertex, other]| (vertex, other))),
            blocks: vec![Mat3A::ZERO; both.len()],
            places: places.as_chunks().0.to_vec(),
            bent: Adjacency::new(vertex_count, || apart.iter().copied()),
            of_bending,
            own: vec![Mat3A::ZERO; vertex_count],
            diagonal: vec![Mat3A::ZERO; vertex_count],
            beside_ropes: vec![Mat3A::ZERO; vertex_count],
            is_fixed: vec![true; vertex_count],
            rides: vec![false; vertex_count],
            bands: Bands::new(ropes, vertex_count),
            ..Self::default()
        }
    }

    /// Starts again, with these masses over h² on the diagonal. A mass of zero fixes a vertex.
    pub(super) fn clear(&mut self, masses: &[f64]) {
        for (block, bent) in self.blocks.iter_mut().zip(&self.of_bending) {
            *block = Mat3A::from_diagonal(Vec3::splat(*bent));
        }
        self.links.clear();
        self.of_ropes.clear();
        self.bands.clear();
        self.used_ranks = 0;
        for (vertex, &mass) in masses.iter().enumerate() {
            self.own[vertex] = Mat3A::from_diagonal(Vec3::splat(mass as f32));
            self.is_fixed[vertex] = mass == 0.0;
        }
    }

    /// Begins with free bodies.
    pub(super) fn begin_bodies(&mut self, bodies: &RigidBodies) {
        self.coupled.begin(bodies);
        self.rides.fill(false);
        self.coupled.riders().for_each(|vertex| self.rides[vertex as usize] = true);
    }

    /// Adds the blocks between the [`PAIRS`] of a triangle of cloth, and minus their sums on the diagonal.
    #[inline]
    pub(super) fn add_triangle(&mut self, triangle: usize, blocks: [Mat3A; 3]) {
        for (block, [there, back]) in blocks.into_iter().zip(self.places[triangle]) {
            self.blocks[there as usize] += block;
            self.blocks[back as usize] += block.transpose();
        }
    }

    /// Adds a block of one vertex.
    #[inline]
    pub(super) fn add_own(&mut self, vertex: u32, block: Mat3A) {
        self.own[vertex as usize] += block;
    }

    /// Adds the stiffness `stiffness`, in N/m, of the point Σ w·x. Vertices of bodies do not take part. The stiffness must be
    /// symmetric and positive semidefinite.
    pub fn add(&mut self, vertices: &[u32], weights: &[f64], stiffness: DMat3) {
        self.add_link(vertices, weights, Mat3A::from(stiffness.as_mat3()));
    }

    /// Adds a link; up to four vertices take part.
    #[inline]
    pub(super) fn add_link(&mut self, vertices: &[u32], weights: &[f64], stiffness: Mat3A) {
        if let Some(link) = self.link(vertices, weights, stiffness) {
            self.take(link);
        }
    }

    /// Adds a link of a rope, also to the [bands](Bands).
    pub(super) fn add_of_rope(&mut self, vertices: &[u32], weights: &[f64], stiffness: DMat3) {
        let of_ropes = self.link(vertices, weights, Mat3A::from(stiffness.as_mat3()));
        self.of_ropes.extend(of_ropes);
        self.bands.add(vertices, weights, stiffness);
    }

    /// Adds a link between two vertices that is part of the [bands](Bands) if both are.
    pub(super) fn add_tie(&mut self, vertices: &[u32], weights: &[f64], stiffness: DMat3) {
        if self.bands.have(vertices) {
            self.add_of_rope(vertices, weights, stiffness);
        } else {
            self.add_late(vertices, weights, Mat3A::from(stiffness.as_mat3()));
        }
    }

    /// Makes a link of the free vertices; `None` if there are none.
    #[inline]
    fn link(&self, vertices: &[u32], weights: &[f64], stiffness: Mat3A) -> Option<Link> {
        let mut link = Link {
            vertices: [0; 4],
            weights: [0.0; 4],
            stiffness,
        };
        let mut count = 0;
        for (&vertex, &weight) in vertices.iter().zip(weights) {
            let place = vertex as usize;
            let moves = self
                .is_fixed
                .get(place)
                .is_some_and(|is_fixed| !is_fixed || self.rides[place]);
            if weight != 0.0 && moves && count < 4 {
                (link.vertices[count], link.weights[count]) = (vertex, weight as f32);
                count += 1;
            }
        }
        let first = link.vertices[0];
        link.vertices[count..].fill(first);
        (count > 0).then_some(link)
    }

    fn take(&mut self, link: Link) {
        if link.weights[1..] == [0.0; 3] {
            let weight = link.weights[0];
            self.own[link.vertices[0] as usize] += link.stiffness * (weight * weight);
        } else {
            self.links.push(link);
        }
    }

    /// Adds β·g·gᵀ; `fill` writes g, which is zero at first.
    pub(super) fn add_rank_one(&mut self, factor: f64, fill: impl FnOnce(&mut [Vec3A])) {
        if self.used_ranks == self.ranks.len() {
            self.ranks.push(RankOne::default());
        }
        let rank = &mut self.ranks[self.used_ranks];
        self.used_ranks += 1;
        rank.factor = factor;
        rank.direction.clear();
        rank.direction.resize(self.own.len(), Vec3A::ZERO);
        fill(&mut rank.direction);
        for (direction, is_fixed) in rank.direction.iter_mut().zip(&self.is_fixed) {
            if *is_fixed {
                *direction = Vec3A::ZERO;
            }
        }
    }

    /// Finds the whole block of each vertex, with the links so far.
    pub(super) fn find_diagonal(&mut self) {
        for vertex in 0..self.own.len() {
            let bent: f32 = self.bent.of(vertex).iter().map(|(_, number)| number).sum();
            let mut sum = self.own[vertex] - Mat3A::from_diagonal(Vec3::splat(bent));
            for block in &self.blocks[self.neighbours.range(vertex)] {
                sum -= *block;
            }
            self.diagonal[vertex] = sum;
        }
        for link in &self.links {
            link.add_to(&mut self.diagonal);
        }
        self.beside_ropes.clone_from(&self.diagonal);
        for link in &self.of_ropes {
            link.add_to(&mut self.diagonal);
        }
    }

    /// Adds a link after [`find_diagonal`](Self::find_diagonal).
    #[inline]
    pub(super) fn add_late(&mut self, vertices: &[u32], weights: &[f64], stiffness: Mat3A) {
        if let Some(link) = self.link(vertices, weights, stiffness) {
            self.take_late(link);
        }
    }

    fn take_late(&mut self, link: Link) {
        link.add_to(&mut self.diagonal);
        link.add_to(&mut self.beside_ropes);
        self.take(link);
    }

    /// Begins to add contacts. Those of the last matrix are gone.
    pub(super) fn begin_contacts(&mut self) {
        self.first_contact = self.links.len();
        self.before_contacts.clear();
        self.pressed.clear();
    }

    /// Adds the link of a contact.
    pub(super) fn add_contact(&mut self, vertices: &[u32], weights: &[f64], stiffness: Mat3A) {
        if let Some(link) = self.link(vertices, weights, stiffness) {
            self.keep_blocks(&link);
            self.take_late(link);
        }
    }

    /// Keeps the blocks of a contact's vertices as they are before it.
    fn keep_blocks(&mut self, link: &Link) {
        for (&vertex, weight) in link.vertices.iter().zip(link.weights) {
            if weight != 0.0 {
                let place = vertex as usize;
                self.before_contacts.push(Blocks {
                    vertex,
                    own: self.own[place],
                    diagonal: self.diagonal[place],
                    beside_ropes: self.beside_ropes[place],
                });
                self.pressed.push(vertex);
            }
        }
    }

    /// Adds a contact with free bodies, each with its first slot, its side and its arm.
    pub(super) fn add_contact_with_bodies(
        &mut self,
        vertices: &[u32],
        weights: &[f64],
        stiffness: Mat3A,
        touches: &[(usize, f64, DVec3)],
    ) {
        let link = self.link(vertices, weights, stiffness);
        if let Some(link) = &link {
            self.keep_blocks(link);
            link.add_to(&mut self.diagonal);
            link.add_to(&mut self.beside_ropes);
        }
        self.coupled
            .add(link.map(|link| (link.vertices, link.weights)), stiffness, touches);
    }

    /// Removes all contacts.
    pub(super) fn remove_contacts(&mut self) {
        self.coupled.remove_contacts();
        self.links.truncate(self.first_contact);
        // Backwards, so that the first of several contacts of a vertex has the last word.
        for before in self.before_contacts.drain(..).rev() {
            let place = before.vertex as usize;
            (self.own[place], self.diagonal[place]) = (before.own, before.diagonal);
            self.beside_ropes[place] = before.beside_ropes;
        }
    }

    /// Finds the product with moves. Fixed vertices must not move.
    pub(super) fn multiply(&self, moves: &[Vec3A], product: &mut [Vec3A]) {
        let multiply = |vertex: usize, product: &mut Vec3A| {
            let own = moves[vertex];
            let blocks = &self.blocks[self.neighbours.range(vertex)];
            let others = self.neighbours.of(vertex).iter().zip(blocks);
            let sum = others.fold(self.own[vertex] * own, |sum, (&other, block)| {
                sum + *block * (moves[other as usize] - own)
            });
            *product = self
                .bent
                .of(vertex)
                .iter()
                .fold(sum, |sum, &(other, k)| sum + (moves[other as usize] - own) * k);
        };
        if product.len() < WORTH_THREADS {
            for (vertex, product) in product.iter_mut().enumerate() {
                multiply(vertex, product);
            }
        } else {
            parallel::for_each(product, multiply);
        }
        for link in self.links.iter().chain(&self.of_ropes) {
            let Link {
                vertices,
                weights,
                stiffness,
            } = link;
            let mut image = Vec3A::ZERO;
            for k in 0..4 {
                image += moves[vertices[k] as usize] * weights[k];
            }
            let force = *stiffness * image;
            for k in 0..4 {
                product[vertices[k] as usize] += force * weights[k];
            }
        }
        for rank in &self.ranks[..self.used_ranks] {
            let by = (rank.factor * dot(&rank.direction, moves)) as f32;
            for (product, direction) in product.iter_mut().zip(&rank.direction) {
                *product += *direction * by;
            }
        }
        self.coupled.multiply(moves, product);
    }

    /// Returns what Σ w·x yields along a direction to a force of 1 N, in m/N, if each vertex acted alone. Fixed vertices yield
    /// nothing.
    ///
    /// If a fixed vertex has nearly all of the weight, the others would move far to make up for it. The result is then larger, so
    /// that none moves farther than twice as far as the point.
    pub(super) fn compliance(&self, vertices: &[u32], weights: &[f64], direction: DVec3) -> f64 {
        let along = direction.as_vec3a();
        let (mut all, mut fastest) = (0.0, 0.0_f64);
        for (&vertex, &weight) in vertices.iter().zip(weights) {
            if weight != 0.0 && self.is_fixed.get(vertex as usize) == Some(&false) {
                let own = f64::from(along.dot(self.diagonal[vertex as usize].inverse() * along));
                all += weight * weight * own;
                fastest = fastest.max(weight.abs() * own);
            }
        }
        all.max(0.5 * fastest)
    }
}

/// The sum of products, added in order in double precision.
pub(super) fn dot(one: &[Vec3A], other: &[Vec3A]) -> f64 {
    one.iter().zip(other).map(|(one, other)| f64::from(one.dot(*other))).sum()
}

/// Returns a·bᵀ.
#[inline(always)]
pub(super) fn outer(a: Vec3A, b: Vec3A) -> Mat3A {
    Mat3A::from_cols(a * b.x, a * b.y, a * b.z)
}

/// Returns the stiffness `along` in a direction of length one, and `across` it.
#[inline(always)]
pub(super) fn directed(direction: DVec3, along: f64, across: f64) -> Mat3A {
    let n = direction.as_vec3a();
    outer(n * (along - across) as f32, n) + Mat3A::from_diagonal(Vec3::splat(across as f32))
}
