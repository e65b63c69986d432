//! Symmetric tensors of second order, with six stored components.
//!
//! Operators and conversions are in the files beside this one, products with vectors and tensors too.

mod conversions;
pub(crate) mod definite;
pub(crate) mod kernels;
mod measures;
mod products;

use core::ops::{Index, IndexMut};

use nalgebra::Matrix3;
use piola_numerics::{Mask, Real};

use super::rows::Rows;
use super::slots::SLOT;
use crate::TensorError;
use crate::error::check_finite;
use crate::linear_space;

/// A symmetric tensor: its components in Voigt's order 11, 22, 33, 12, 23, 13, shears not doubled.
///
/// # Example
/// ```
/// use piola_tensor::Symmetric;
/// let tensor = Symmetric::new(1.0, 2.0, 3.0, 4.0, 5.0, 6.0);
/// assert_eq!(tensor.trace(), 6.0);
/// assert_eq!(tensor.matrix()[(0, 2)], 6.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "[T; 6]",
        into = "[T; 6]",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
#[repr(transparent)]
pub struct Symmetric<T = f64> {
    /// 11, 22, 33, 12, 23, 13.
    pub components: [T; 6],
}

impl<T: Real> Symmetric<T> {
    /// From the components 11, 22, 33, 12, 23, 13.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub const fn new(xx: T, yy: T, zz: T, xy: T, yz: T, xz: T) -> Self {
        Self { components: [xx, yy, zz, xy, yz, xz] }
    }

    /// 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn zero() -> Self {
        Self { components: [T::zero(); 6] }
    }

    /// 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn identity() -> Self {
        let (o, l) = (T::zero(), T::one());
        Self { components: [l, l, l, o, o, o] }
    }

    /// diag(a, b, c).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn diagonal(diagonal: [T; 3]) -> Self {
        let o = T::zero();
        Self { components: [diagonal[0], diagonal[1], diagonal[2], o, o, o] }
    }

    /// ½ (A + Aᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symmetric_part(a: Rows<T>) -> Self {
        let half = T::lit(0.5);
        Self {
            components: [
                a[0][0],
                a[1][1],
                a[2][2],
                half * (a[0][1] + a[1][0]),
                half * (a[1][2] + a[2][1]),
                half * (a[0][2] + a[2][0]),
            ],
        }
    }

    /// A + Aᵀ, twice the symmetric part.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn sum_with_transpose(a: Rows<T>) -> Self {
        let both = |i: usize, j: usize| a[i][j] + a[j][i];
        Self { components: [both(0, 0), both(1, 1), both(2, 2), both(0, 1), both(1, 2), both(0, 2)] }
    }

    /// The symmetric tensor with the upper triangle of A: for a product known to be symmetric.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn upper_triangle(a: Rows<T>) -> Self {
        Self { components: [a[0][0], a[1][1], a[2][2], a[0][1], a[1][2], a[0][2]] }
    }

    /// From a matrix that is symmetric to rounding.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`]; [`TensorError::NotSymmetric`] when two opposite entries differ by more
    /// than 32 ulp of the largest entry.
    pub fn from_matrix(matrix: &Matrix3<T>) -> Result<Self, TensorError> {
        Self::of_quantity("tensor", piola_numerics::linear::matrix3::rows_of(matrix))
    }

    /// From an array of rows that is symmetric to rounding.
    ///
    /// # Errors
    /// As [`from_matrix`](Self::from_matrix).
    pub fn from_rows(rows: Rows<T>) -> Result<Self, TensorError> {
        Self::of_quantity("tensor", rows)
    }

    /// From rows that are symmetric to 32 ulp of the largest entry; errors name the quantity.
    #[doc(hidden)]
    pub fn of_quantity(quantity: &'static str, rows: Rows<T>) -> Result<Self, TensorError> {
        check_finite(quantity, rows.as_flattened())?;
        let scale = rows.as_flattened().iter().fold(T::zero(), |scale, x| scale.max(x.abs()));
        let tolerance = scale * T::lit(32.0 * piola_numerics::sums::unit_in_last_place::<T>());
        for (row, column) in [(0, 1), (1, 2), (0, 2)] {
            let difference = rows[row][column] - rows[column][row];
            if !difference.abs().at_most(tolerance).all() {
                let lane =
                    (0..T::LANES).find(|&lane| tolerance.primal(lane) < difference.primal(lane).abs()).unwrap_or(0);
                return Err(TensorError::NotSymmetric {
                    quantity,
                    row,
                    column,
                    difference: difference.primal(lane),
                    scale: scale.primal(lane),
                });
            }
        }
        Ok(Self::symmetric_part(rows))
    }

    /// All nine components as an array of rows.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rows(&self) -> Rows<T> {
        let [xx, yy, zz, xy, yz, xz] = self.components;
        [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]]
    }

    /// All nine components as a matrix.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn matrix(&self) -> Matrix3<T> {
        piola_numerics::linear::matrix3::from_rows(self.rows())
    }

    /// tr A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn trace(&self) -> T {
        self.components[0] + self.components[1] + self.components[2]
    }

    /// det A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn determinant(&self) -> T {
        piola_numerics::linear::matrix3::determinant(self.rows())
    }

    /// A : B = Aᵢⱼ Bᵢⱼ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn double_contraction(&self, other: &Self) -> T {
        let (a, b) = (self.components, other.components);
        a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + T::lit(2.0) * (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
    }

    /// A v.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn apply(&self, v: [T; 3]) -> [T; 3] {
        super::rows::apply(self.rows(), v)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    #[doc(hidden)]
    pub fn each(a: &Self, b: &Self, f: impl Fn(T, T) -> T) -> Self {
        let (a, b) = (a.components, b.components);
        Self { components: [f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2]), f(a[3], b[3]), f(a[4], b[4]), f(a[5], b[5])] }
    }
}

linear_space!(Symmetric);

/// A component by row and column, from 0; (i, j) and (j, i) are one number.
///
/// # Panics
/// When an index is above 2, as indexing does everywhere.
impl<T> Index<(usize, usize)> for Symmetric<T> {
    type Output = T;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn index(&self, (row, column): (usize, usize)) -> &T {
        &self.components[SLOT[row][column]]
    }
}

impl<T> IndexMut<(usize, usize)> for Symmetric<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn index_mut(&mut self, (row, column): (usize, usize)) -> &mut T {
        &mut self.components[SLOT[row][column]]
    }
}
