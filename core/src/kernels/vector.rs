//! Three-component vectors of [`Lanes`], with the operations that the kernels use.

use crate::lanes::Lanes;
use core::ops::{Add, Sub};

/// Three components, each one number or one lane per pair. Every addition, subtraction and product rounds on its own, in the
/// order written here: error bounds rely on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<L> {
    /// The first component.
    pub x: L,
    /// The second component.
    pub y: L,
    /// The third component.
    pub z: L,
}

impl<L: Lanes> Vector<L> {
    /// Makes the vector with these components.
    #[inline(always)]
    #[must_use]
    pub const fn new(x: L, y: L, z: L) -> Self {
        Self { x, y, z }
    }

    /// Returns `(x·x′ + y·y′) + z·z′`.
    #[inline(always)]
    #[must_use]
    pub fn dot(self, other: Self) -> L {
        (self.x * other.x + self.y * other.y) + self.z * other.z
    }

    /// Returns the cross product, each component a difference of two products.
    #[inline(always)]
    #[must_use]
    pub fn cross(self, other: Self) -> Self {
        Self::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }

    /// Returns the [cross product](Self::cross) with every subtraction replaced by an addition. On magnitudes, it bounds each
    /// component and every intermediate result.
    #[inline(always)]
    #[must_use]
    pub fn cross_permanent(self, other: Self) -> Self {
        Self::new(
            self.y * other.z + self.z * other.y,
            self.z * other.x + self.x * other.z,
            self.x * other.y + self.y * other.x,
        )
    }

    /// Returns the magnitude of each component.
    #[inline(always)]
    #[must_use]
    pub fn abs(self) -> Self {
        Self::new(self.x.abs(), self.y.abs(), self.z.abs())
    }

    /// Returns the larger of two vectors, component by component. NaN may be dropped: see [`Lanes::larger`].
    #[inline(always)]
    #[must_use]
    pub fn larger(self, other: Self) -> Self {
        Self::new(self.x.larger(other.x), self.y.larger(other.y), self.z.larger(other.z))
    }

    /// Returns the smaller of two vectors, component by component. NaN may be dropped: see [`Lanes::larger`].
    #[inline(always)]
    #[must_use]
    pub fn smaller(self, other: Self) -> Self {
        Self::new(self.x.smaller(other.x), self.y.smaller(other.y), self.z.smaller(other.z))
    }

    /// Returns the largest component. NaN may be dropped: see [`Lanes::larger`].
    #[inline(always)]
    #[must_use]
    pub fn largest(self) -> L {
        self.x.larger(self.y).larger(self.z)
    }

    /// Returns the vector without its part along `side`.
    #[inline(always)]
    #[must_use]
    pub fn without(self, side: Self) -> Self {
        let along = self.dot(side) / side.dot(side);
        self - side.scaled(along)
    }

    /// Returns each component times `factor`.
    #[inline(always)]
    #[must_use]
    pub fn scaled(self, factor: L) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<L> From<[L; 3]> for Vector<L> {
    #[inline(always)]
    fn from([x, y, z]: [L; 3]) -> Self {
        Self { x, y, z }
    }
}

impl<L> From<Vector<L>> for [L; 3] {
    #[inline(always)]
    fn from(Vector { x, y, z }: Vector<L>) -> Self {
        [x, y, z]
    }
}

impl<L: Lanes> Add for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl<L: Lanes> Sub for Vector<L> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}
