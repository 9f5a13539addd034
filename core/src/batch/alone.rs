//! One pair at a time: where a machine has no vectors that we have code for, and in builds without optimisation.
//!
//! Without optimisation an operator of a generic type is a call, and so are `?` and `get`. So the number has a type of its own, whose
//! operators are inlined always, and a row is read once: a step of many pairs takes 0.6 times the time that it takes with `f32` and `f64`
//! themselves.

use super::chunk::Chunk;
use super::{LANES, Mask, VertexRow};
use crate::lanes::{Lanes, either};
use crate::vector::Vector;
use core::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Not, Sub};

/// One number.
#[derive(Clone, Copy)]
pub(super) struct Alone<S>(S);

/// What is true of it.
#[derive(Clone, Copy)]
pub(super) struct Truth(bool);

/// Start and end of a vertex, or of a difference of two.
#[derive(Clone, Copy)]
pub(super) struct Row<S>([Vector<Alone<S>>; 2]);

macro_rules! operator {
    ($trait:ident, $function:ident, $type:ty, $operator:tt) => {
        impl $trait for $type {
            type Output = Self;

            #[inline(always)]
            fn $function(self, other: Self) -> Self {
                Self(self.0 $operator other.0)
            }
        }
    };
}

operator!(BitAnd, bitand, Truth, &);
operator!(BitOr, bitor, Truth, |);
operator!(BitXor, bitxor, Truth, ^);

impl Not for Truth {
    type Output = Self;

    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0)
    }
}

macro_rules! alone {
    ($scalar:ident) => {
        operator!(Add, add, Alone<$scalar>, +);
        operator!(Sub, sub, Alone<$scalar>, -);
        operator!(Mul, mul, Alone<$scalar>, *);
        operator!(Div, div, Alone<$scalar>, /);

        impl Neg for Alone<$scalar> {
            type Output = Self;

            #[inline(always)]
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }

        impl Sub for Row<$scalar> {
            type Output = Self;

            #[inline(always)]
            fn sub(self, other: Self) -> Self {
                Self([self.0[0] - other.0[0], self.0[1] - other.0[1]])
            }
        }

        impl Lanes for Alone<$scalar> {
            type Scalar = $scalar;
            type Mask = Truth;

            #[inline(always)]
            fn splat(self, value: $scalar) -> Self {
                Self(value)
            }

            #[inline(always)]
            fn any(mask: Truth) -> bool {
                mask.0
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                Self(Lanes::sqrt(self.0))
            }

            #[inline(always)]
            fn abs(self) -> Self {
                Self(Lanes::abs(self.0))
            }

            #[inline(always)]
            fn larger(self, other: Self) -> Self {
                either!(self.0 > other.0, self, other)
            }

            #[inline(always)]
            fn smaller(self, other: Self) -> Self {
                either!(self.0 < other.0, self, other)
            }

            #[inline(always)]
            fn greater(self, other: Self) -> Truth {
                Truth(self.0 > other.0)
            }

            #[inline(always)]
            fn at_most(self, other: Self) -> Truth {
                Truth(self.0 <= other.0)
            }

            #[inline(always)]
            fn select(mask: Truth, if_true: Self, if_false: Self) -> Self {
                either!(mask.0, if_true, if_false)
            }

            #[inline(always)]
            fn may_leave(open: Truth) -> bool {
                !open.0
            }
        }

        impl Chunk for Alone<$scalar> {
            type Token = ();
            type Part = Row<$scalar>;

            const WIDTH: usize = 1;

            #[inline(always)]
            fn load((): (), numbers: &[$scalar; LANES], first: usize) -> Self {
                Self(numbers[first % LANES])
            }

            #[inline(always)]
            fn store(self, numbers: &mut [$scalar; LANES], first: usize) {
                numbers[first % LANES] = self.0;
            }

            #[inline(always)]
            fn bits(mask: Truth) -> Mask {
                mask.0 as Mask
            }

            #[inline(always)]
            fn part((): (), row: &VertexRow<$scalar>, _: usize) -> Row<$scalar> {
                let [x, y, z, _, u, v, w, _] = row.0;
                Row([
                    Vector::new(Self(x), Self(y), Self(z)),
                    Vector::new(Self(u), Self(v), Self(w)),
                ])
            }

            #[inline(always)]
            fn between((): (), from: &VertexRow<$scalar>, to: &VertexRow<$scalar>, _: usize) -> Row<$scalar> {
                // In one go: as two rows and their difference it takes three times as long.
                macro_rules! way {
                    ($coordinate:literal) => {
                        Self(to.0[$coordinate] - from.0[$coordinate])
                    };
                }
                Row([
                    Vector::new(way!(0), way!(1), way!(2)),
                    Vector::new(way!(4), way!(5), way!(6)),
                ])
            }

            #[inline(always)]
            fn columns(row: impl Fn(usize, usize) -> Option<Row<$scalar>>) -> Option<[Vector<Self>; 2]> {
                match row(0, 0) {
                    Some(row) => Some(row.0),
                    None => None,
                }
            }
        }
    };
}

alone!(f32);
alone!(f64);
