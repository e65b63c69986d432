//! What the two types with minor symmetries have in common, and the names of the symmetries.

use core::fmt::Debug;
use core::ops::{Add, Mul, Neg, Sub};

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;

use super::{FourthOrder, MajorSymmetric, MinorSymmetric, kernels};
use crate::rotation::check_rotation;
use crate::rows::Rows;
use crate::slots::Slots;
use crate::{Symmetric, TensorError};

/// A fourth-order tensor with minor symmetries: 6×6 components over pairs of indices.
///
/// # Example
/// ```
/// use piola_tensor::Symmetric;
/// use piola_tensor::{MajorSymmetric, PairSymmetric};
/// let stiffness = MajorSymmetric::isotropic(1.0, 3.0); // λ tr ε 1 + 2μ ε
/// assert_eq!(stiffness.contract(&Symmetric::identity()), Symmetric::identity() * 9.0);
/// assert_eq!((stiffness.entry(0, 1, 0, 1), stiffness.entry(0, 0, 1, 1)), (3.0, 1.0));
/// ```
pub trait PairSymmetric<T: Real>:
    Copy
    + Debug
    + PartialEq
    + Send
    + Sync
    + Add<Output = Self>
    + Sub<Output = Self>
    + Neg<Output = Self>
    + Mul<T, Output = Self>
{
    /// All components by pairs of indices.
    #[must_use]
    fn slots(&self) -> Slots<T>;

    /// From components by pairs of indices; of a tensor with major symmetry only the upper triangle is read.
    #[must_use]
    fn from_slots(slots: &Slots<T>) -> Self;

    /// M C Mᵀ.
    #[must_use]
    fn transformed(&self, matrix: &Slots<T>) -> Self;

    /// `C_ijkl`, indices from 0.
    #[must_use]
    fn entry(&self, i: usize, j: usize, k: usize, l: usize) -> T;

    /// `F_iA F_jB F_kC F_lD C_ABCD`: the change of basis by a rotation, the push-forward by F, the pull-back
    /// by F⁻¹.
    ///
    /// # Accuracy
    /// 24 ulp of |F|⁴ |C|.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn congruence(&self, f: Rows<T>) -> Self {
        self.transformed(&kernels::congruence_matrix(f))
    }

    /// The tensor turned by the rotation Q.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`], [`TensorError::NotARotation`]. A kernel that knows its Q uses
    /// [`congruence`](Self::congruence).
    fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, TensorError> {
        check_rotation(rotation)?;
        Ok(self.congruence(rows_of(rotation)))
    }

    /// C : A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn contract(&self, a: &Symmetric<T>) -> Symmetric<T> {
        Symmetric { components: kernels::contract(&self.slots(), a.components) }
    }

    /// A : C.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn contract_left(&self, a: &Symmetric<T>) -> Symmetric<T> {
        Symmetric { components: kernels::contract(&kernels::transposed(&self.slots()), a.components) }
    }

    /// A : C : B, for A = B a quadratic form such as twice an energy.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn quadratic_form(&self, a: &Symmetric<T>, b: &Symmetric<T>) -> T {
        a.double_contraction(&self.contract(b))
    }

    /// C : D, which lacks major symmetry in general.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn double_contraction(&self, other: &impl PairSymmetric<T>) -> MinorSymmetric<T> {
        // Shears of the pair that is summed over count twice.
        let (c, d) = (self.slots(), kernels::transposed(&other.slots()));
        let mut result = [[T::zero(); 6]; 6];
        for (row, c) in result.iter_mut().zip(&c) {
            let doubled = [c[0], c[1], c[2], c[3] + c[3], c[4] + c[4], c[5] + c[5]];
            for (entry, d) in row.iter_mut().zip(&d) {
                *entry = kernels::dot6(&doubled, d);
            }
        }
        MinorSymmetric { components: result }
    }

    /// |C| = √(`C_ijkl C_ijkl`).
    ///
    /// # Accuracy
    /// 16 ulp for components anywhere in the range of numbers.
    #[must_use]
    fn norm(&self) -> T {
        use crate::scale::{power_of_two_scale, square_root};
        let slots = self.slots();
        let size = slots.as_flattened().iter().fold(T::zero(), |size, x| size.max(x.abs()));
        let (scale, unscale) = power_of_two_scale(size);
        let mut sum = T::zero();
        for (i, row) in slots.iter().enumerate() {
            let mut squares = T::zero();
            for (j, x) in row.iter().enumerate() {
                let x = *x * scale;
                squares += if j < 3 { x * x } else { (x + x) * x };
            }
            sum += if i < 3 { squares } else { squares + squares };
        }
        square_root(sum) * unscale
    }

    /// The same tensor without the claim of major symmetry.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn minor(&self) -> MinorSymmetric<T> {
        MinorSymmetric { components: self.slots() }
    }

    /// The same tensor without any claim.
    #[must_use]
    fn general(&self) -> FourthOrder<T> {
        FourthOrder::from_fn(|i, j, k, l| self.entry(i, j, k, l))
    }
}

/// Which symmetries a tangent has: [`Minor`], or [`Major`] too.
pub trait Symmetry: Copy + Debug + Default + PartialEq + Send + Sync + 'static {
    /// How such a tensor is stored.
    type Tensor<T: Real>: PairSymmetric<T>;
}

/// `C_ijkl = C_jikl = C_ijlk`: the tangent of any law between symmetric tensors.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Minor;

/// Also `C_ijkl = C_klij`: the tangent of a law that has an energy.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Major;

impl Symmetry for Minor {
    type Tensor<T: Real> = MinorSymmetric<T>;
}

impl Symmetry for Major {
    type Tensor<T: Real> = MajorSymmetric<T>;
}
