//! Fourth-order tensors with minor symmetries: 36 components.

use piola_numerics::Real;
use piola_numerics::linear::lu;

use super::symmetry::PairSymmetric;
use super::{MajorSymmetric, kernels};
use crate::linear_space;
use crate::scale::power_of_two_scale;
use crate::slots::{SLOT, Slots};
use crate::{Symmetric, TensorError};

/// A fourth-order tensor with `C_ijkl = C_jikl = C_ijlk`, as a linear map between symmetric tensors.
///
/// # Example
/// ```
/// use piola_tensor::Symmetric;
/// use piola_tensor::{MinorSymmetric, PairSymmetric};
/// let c = MinorSymmetric::dyad(&Symmetric::diagonal([1.0, 0.0, 0.0]), &Symmetric::identity()); // A ↦ A_kk e₁⊗e₁
/// assert_eq!(c.contract(&Symmetric::diagonal([1.0, 2.0, 3.0])), Symmetric::diagonal([6.0, 0.0, 0.0]));
/// assert_eq!(c.major_residual(), 1.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(
    feature = "serde",
    serde(
        try_from = "[[T; 6]; 6]",
        into = "[[T; 6]; 6]",
        bound(serialize = "T: Real + serde::Serialize", deserialize = "T: Real + serde::Deserialize<'de>")
    )
)]
#[repr(transparent)]
pub struct MinorSymmetric<T = f64> {
    /// Rows (ij), columns (kl) in the order 11, 22, 33, 12, 23, 13, without factors for shears.
    pub components: Slots<T>,
}

impl<T: Real> MinorSymmetric<T> {
    /// 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn zero() -> Self {
        Self { components: [[T::zero(); 6]; 6] }
    }

    /// The identity of symmetric tensors, ½ (δᵢₖ δⱼₗ + δᵢₗ δⱼₖ).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn identity() -> Self {
        MajorSymmetric::identity().minor()
    }

    /// A ⊗ B = `A_ij B_kl`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn dyad(a: &Symmetric<T>, b: &Symmetric<T>) -> Self {
        let b = b.components;
        let row = |a: T| [a * b[0], a * b[1], a * b[2], a * b[3], a * b[4], a * b[5]];
        let [xx, yy, zz, xy, yz, xz] = a.components;
        Self { components: [row(xx), row(yy), row(zz), row(xy), row(yz), row(xz)] }
    }

    /// The linear map that takes the symmetric tensors with a single pair of components one to the given ones.
    ///
    /// `images[(kl)]` is the image of the tensor with `A_kl = A_lk = 1` and no other component: of a shear it is
    /// `2 C_ijkl`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn from_images(images: &[Symmetric<T>; 6]) -> Self {
        let half = T::lit(0.5);
        Self {
            components: kernels::transposed(&[
                images[0].components,
                images[1].components,
                images[2].components,
                (images[3] * half).components,
                (images[4] * half).components,
                (images[5] * half).components,
            ]),
        }
    }

    /// The tensor with the pairs exchanged, `C_klij`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn transpose(&self) -> Self {
        Self { components: kernels::transposed(&self.components) }
    }

    /// The largest |`C_ijkl − C_klij`|: zero for the tangent of an energy.
    #[must_use]
    pub fn major_residual(&self) -> T {
        let difference = *self - self.transpose();
        difference.components.as_flattened().iter().fold(T::zero(), |largest, x| largest.max(x.abs()))
    }

    /// ½ (`C_ijkl + C_klij`).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn major_part(&self) -> MajorSymmetric<T> {
        let sum = *self + self.transpose();
        MajorSymmetric::from_slots(&(sum * T::lit(0.5)).components)
    }

    /// C⁻¹, with C⁻¹ : C = identity of symmetric tensors.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`]; [`TensorError::SingularTensor`] when, in any lane, a pivot is within
    /// rounding of zero.
    ///
    /// # Accuracy
    /// A few ulp × the condition number.
    pub fn inverse(&self) -> Result<Self, TensorError> {
        crate::error::check_finite("fourth-order tensor", self.components.as_flattened())?;
        let size = self.components.as_flattened().iter().fold(T::zero(), |size, x| size.max(x.abs()));
        let (scale, unscale) = power_of_two_scale(size);
        // Columns of C with doubled shears: the matrix of the map of slots.
        let mut matrix = [T::zero(); 36];
        for (place, entry) in matrix.iter_mut().enumerate() {
            let (row, column) = (place % 6, place / 6);
            let weight = if column < 3 { T::one() } else { T::lit(2.0) };
            *entry = self.components[row][column] * scale * weight;
        }
        let mut exchanges = [0; 6];
        let singular = |error| match error {
            piola_numerics::NumericsError::Singular { value, .. } => {
                TensorError::SingularTensor { relative_determinant: value, scale: unscale.primal(0) }
            }
            _ => TensorError::SingularTensor { relative_determinant: 0.0, scale: unscale.primal(0) },
        };
        lu::factor_in_place(&mut matrix, &mut exchanges).map_err(singular)?;
        let mut columns = [[T::zero(); 6]; 6];
        for (place, column) in columns.iter_mut().enumerate() {
            // The identity of symmetric tensors has ½ in the slots of shears.
            column[place] = if place < 3 { T::one() } else { T::lit(0.5) };
            lu::solve_in_place(&matrix, &exchanges, column).map_err(singular)?;
        }
        let inverse = Self { components: kernels::transposed(&columns) };
        Ok(inverse * scale)
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

linear_space!(MinorSymmetric);

impl<T: Real> PairSymmetric<T> for MinorSymmetric<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slots(&self) -> Slots<T> {
        self.components
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_slots(slots: &Slots<T>) -> Self {
        Self { components: *slots }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn transformed(&self, matrix: &Slots<T>) -> Self {
        Self { components: kernels::transform_minor(matrix, &self.components) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn entry(&self, i: usize, j: usize, k: usize, l: usize) -> T {
        self.components[SLOT[i][j]][SLOT[k][l]]
    }
}
