//! Fourth-order tensors without symmetries: 81 components.

use nalgebra::Matrix3;
use piola_numerics::linear::matrix3::rows_of;
use piola_numerics::{Mask, Real};

use super::MinorSymmetric;
use crate::TensorError;
use crate::linear_space;
use crate::rotation::check_rotation;
use crate::rows::Rows;
use crate::slots::PAIR;

/// A fourth-order tensor as a linear map of second-order tensors.
///
/// # Example
/// ```
/// use piola_tensor::FourthOrder;
/// let a = [[1.0, 2.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(FourthOrder::identity().contract(a), a);
/// assert_eq!(FourthOrder::transposer().contract(a)[1][0], 2.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "[[T; 9]; 9]",
        into = "[[T; 9]; 9]",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
#[repr(transparent)]
pub struct FourthOrder<T = f64> {
    /// `C_ijkl` in row 3i + j and column 3k + l.
    pub components: [[T; 9]; 9],
}

impl<T: Real> FourthOrder<T> {
    /// 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn zero() -> Self {
        Self { components: [[T::zero(); 9]; 9] }
    }

    /// From a formula for `C_ijkl`, indices from 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn from_fn(f: impl Fn(usize, usize, usize, usize) -> T) -> Self {
        let mut components = [[T::zero(); 9]; 9];
        for (row, entries) in components.iter_mut().enumerate() {
            for (column, entry) in entries.iter_mut().enumerate() {
                *entry = f(row / 3, row % 3, column / 3, column % 3);
            }
        }
        Self { components }
    }

    /// `C_ijkl`, indices from 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn entry(&self, i: usize, j: usize, k: usize, l: usize) -> T {
        self.components[3 * i + j][3 * k + l]
    }

    /// A ⊗ B = `A_ij B_kl`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn dyad(a: Rows<T>, b: Rows<T>) -> Self {
        Self::from_fn(|i, j, k, l| a[i][j] * b[k][l])
    }

    /// A ⊗̄ B = `A_ik B_jl`: C ↦ A C Bᵀ.
    #[doc(alias = "otimesu")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn upper_dyad(a: Rows<T>, b: Rows<T>) -> Self {
        Self::from_fn(|i, j, k, l| a[i][k] * b[j][l])
    }

    /// A ⊗̲ B = `A_il B_jk`: C ↦ A Cᵀ Bᵀ.
    #[doc(alias = "otimesl")]
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn lower_dyad(a: Rows<T>, b: Rows<T>) -> Self {
        Self::from_fn(|i, j, k, l| a[i][l] * b[j][k])
    }

    /// δᵢₖ δⱼₗ: A ↦ A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn identity() -> Self {
        Self::from_fn(|i, j, k, l| delta::<T>(i, k) * delta(j, l))
    }

    /// δᵢₗ δⱼₖ: A ↦ Aᵀ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn transposer() -> Self {
        Self::from_fn(|i, j, k, l| delta::<T>(i, l) * delta(j, k))
    }

    /// A ↦ ½ (A + Aᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symmetrizer() -> Self {
        (Self::identity() + Self::transposer()) * T::lit(0.5)
    }

    /// A ↦ ½ (A − Aᵀ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn skew_projector() -> Self {
        (Self::identity() - Self::transposer()) * T::lit(0.5)
    }

    /// A ↦ ⅓ tr A 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spherical() -> Self {
        Self::from_fn(|i, j, k, l| delta::<T>(i, j) * delta(k, l) * T::lit(1.0 / 3.0))
    }

    /// C : A = `C_ijkl A_kl`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn contract(&self, a: Rows<T>) -> Rows<T> {
        let entry = |i: usize, j: usize| dot9(&self.components[3 * i + j], &a);
        let row = |i: usize| [entry(i, 0), entry(i, 1), entry(i, 2)];
        [row(0), row(1), row(2)]
    }

    /// A : C = `A_ij C_ijkl`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn contract_left(&self, a: Rows<T>) -> Rows<T> {
        self.transpose().contract(a)
    }

    /// C : D = `C_ijmn D_mnkl`, the composition of the maps.
    #[inline]
    #[must_use]
    pub fn double_contraction(&self, other: &Self) -> Self {
        let mut components = [[T::zero(); 9]; 9];
        for (row, left) in components.iter_mut().zip(&self.components) {
            for (right, factor) in other.components.iter().zip(left) {
                for (entry, right) in row.iter_mut().zip(right) {
                    *entry += *factor * *right;
                }
            }
        }
        Self { components }
    }

    /// The tensor with the pairs exchanged, `C_klij`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self::from_fn(|i, j, k, l| self.entry(k, l, i, j))
    }

    /// `F_iA G_jB F_kC G_lD C_ABCD`: the change of both bases of a two-point tensor by F and G, of a tensor of one
    /// configuration with F = G.
    ///
    /// Four stages of 243 products each, in place of 3⁸.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn transformed(&self, f: Rows<T>, g: Rows<T>) -> Self {
        let half = |c: &[[T; 9]; 9]| {
            // Acts on the first pair and exchanges the pairs: twice is all four indices.
            let mut result = [[T::zero(); 9]; 9];
            for column in 0..9 {
                let entry = |a: usize, b: usize| c[3 * a + b][column];
                let block = [0, 1, 2].map(|a| [entry(a, 0), entry(a, 1), entry(a, 2)]);
                let block = crate::rows::product_transposed(crate::rows::product(f, block), g);
                for (row, entry) in block.as_flattened().iter().enumerate() {
                    result[column][row] = *entry;
                }
            }
            result
        };
        Self { components: half(&half(&self.components)) }
    }

    /// The tensor turned by the rotation Q.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`], [`TensorError::NotARotation`].
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, TensorError> {
        check_rotation(rotation)?;
        let q = rows_of(rotation);
        Ok(self.transformed(q, q))
    }

    /// The largest |`C_ijkl − C_jikl`|.
    #[must_use]
    pub fn first_minor_residual(&self) -> T {
        self.residual(|i, j, k, l| [j, i, k, l]).1
    }

    /// The largest |`C_ijkl − C_ijlk`|.
    #[must_use]
    pub fn second_minor_residual(&self) -> T {
        self.residual(|i, j, k, l| [i, j, l, k]).1
    }

    /// The largest |`C_ijkl − C_klij`|.
    #[must_use]
    pub fn major_residual(&self) -> T {
        self.residual(|i, j, k, l| [k, l, i, j]).1
    }

    /// The part with minor symmetries: the mean over exchanges within the pairs.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn minor_part(&self) -> MinorSymmetric<T> {
        let quarter = T::lit(0.25);
        let mut components = [[T::zero(); 6]; 6];
        for (row, (i, j)) in components.iter_mut().zip(PAIR) {
            for (entry, (k, l)) in row.iter_mut().zip(PAIR) {
                *entry = quarter
                    * ((self.entry(i, j, k, l) + self.entry(j, i, k, l))
                        + (self.entry(i, j, l, k) + self.entry(j, i, l, k)));
            }
        }
        MinorSymmetric { components }
    }

    /// The indices and the size of the largest difference of two entries that a symmetry exchanges.
    pub(super) fn residual(&self, exchange: impl Fn(usize, usize, usize, usize) -> [usize; 4]) -> ([usize; 4], T) {
        let mut largest = ([0; 4], T::zero());
        for row in 0..9 {
            for column in 0..9 {
                let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
                let [a, b, c, d] = exchange(i, j, k, l);
                let difference = (self.entry(i, j, k, l) - self.entry(a, b, c, d)).abs();
                if largest.1.less_than(difference).any() {
                    largest = ([i, j, k, l], largest.1.max(difference));
                }
            }
        }
        largest
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn each(a: &Self, b: &Self, f: impl Fn(T, T) -> T) -> Self {
        let mut components = a.components;
        for (row, other) in components.iter_mut().zip(&b.components) {
            for (entry, other) in row.iter_mut().zip(other) {
                *entry = f(*entry, *other);
            }
        }
        Self { components }
    }
}

linear_space!(FourthOrder);

/// δᵢⱼ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn delta<T: Real>(i: usize, j: usize) -> T {
    if i == j { T::one() } else { T::zero() }
}

/// Σ cₖₗ aₖₗ.
#[cfg_attr(not(debug_assertions), inline(always))]
fn dot9<T: Real>(c: &[T; 9], a: &Rows<T>) -> T {
    (c[0] * a[0][0] + c[1] * a[0][1] + c[2] * a[0][2])
        + (c[3] * a[1][0] + c[4] * a[1][1] + c[5] * a[1][2])
        + (c[6] * a[2][0] + c[7] * a[2][1] + c[8] * a[2][2])
}
