//! Bending resistance: the energy of the hinges of a cloth. The [solve](crate::solve::bending) minimises it.
//!
//! **Energy.** A [`Hinge`] is an edge between two triangles with its four vertices. The weights K in C = ΣKᵢxᵢ are made of the
//! cotangents of its angles at rest. The length of C is the length of the edge times the angle between the triangles (Bergou et
//! al. 2006). The energy is ½(αD/A)·|C|², with the flexural rigidity D in N·m and A the area of both triangles. It is quadratic:
//! forces are −Q·x with a constant Q, without trigonometry and without singular folds.
//!
//! Bergou et al. use α = 3. That is right for a ball, but cloth hardly ever bends in two directions at once. Bent in one
//! direction around rows of equilateral triangles, it is three times too stiff. Only the hinges across the rows bend, with |C| =
//! κ·A for a curvature κ. There is one of them for each area A of cloth, whose energy should be ½D·κ² per area. With α = 1
//! equilateral triangles are right in any direction. Take a grid of right-angled triangles with alternating diagonals, whose
//! vertices relax to the least energy. It would have 5/6 of the rigidity around its rows and 4/3 around its diagonals. With 4/3
//! for the legs and 2/3 for the diagonals it is 1 in every direction. This follows by homogenisation: the least energy of a
//! periodic cell at a given mean curvature. α = (2 + cot γ + cot δ)/3, with γ and δ the angles opposite the edge, gives both, and
//! 1.05 for equilateral triangles. A strip that bends under its weight then shows 0.9 to 1.1 times the rigidity, on grids and on
//! irregular triangles. If all diagonals of a grid are parallel, it shows 0.6 to 2.9.
//!
//! Folds that stay have a rest value of their own ([`folds`]).

mod folds;
mod hinge;

pub(crate) use folds::{Folds, Yield};
pub(crate) use hinge::{PlacedHinge, hinges};
