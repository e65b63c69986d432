//! Fourth-order tensors with minor and major symmetries: 21 components.

use piola_numerics::Real;

use super::kernels;
use super::symmetry::PairSymmetric;
use crate::linear_space;
use crate::slots::{PAIR, SLOT, Slots};
use crate::{Symmetric, TensorError};

/// A fourth-order tensor with `C_ijkl = C_jikl = C_ijlk = C_klij`: the second derivative of an energy.
///
/// # Example
/// ```
/// use piola_tensor::Symmetric;
/// use piola_tensor::{MajorSymmetric, PairSymmetric};
/// let dev = MajorSymmetric::deviatoric();
/// assert_eq!(dev.contract(&Symmetric::diagonal([3.0, 0.0, 0.0])), Symmetric::diagonal([2.0, -1.0, -1.0]));
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
pub struct MajorSymmetric<T = f64> {
    /// The upper triangle, by rows, of the 6×6 array over the pairs 11, 22, 33, 12, 23, 13, without factors for
    /// shears.
    pub components: [T; 21],
}

/// The 21 entries (row, column), row ≤ column, of a formula, written out: of a loop over entries of eight lanes the compiler
/// makes one over entries, which gathers and scatters the lanes.
macro_rules! upper {
    ($i:ident, $j:ident => $entry:expr) => {
        upper!(@all $i, $j, $entry; 0 0, 0 1, 0 2, 0 3, 0 4, 0 5, 1 1, 1 2, 1 3, 1 4, 1 5, 2 2, 2 3, 2 4, 2 5, 3 3, 3 4, 3 5,
            4 4, 4 5, 5 5)
    };
    (@all $i:ident, $j:ident, $entry:expr; $($row:literal $column:literal),*) => {
        [$({
            let ($i, $j) = ($row, $column);
            $entry
        }),*]
    };
}

impl<T: Real> MajorSymmetric<T> {
    /// 0.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn zero() -> Self {
        Self { components: [T::zero(); 21] }
    }

    /// The identity of symmetric tensors, ½ (δᵢₖ δⱼₗ + δᵢₗ δⱼₖ): A ↦ A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn identity() -> Self {
        Self::isotropic(T::zero(), T::lit(0.5))
    }

    /// ⅓ 1 ⊗ 1: A ↦ ⅓ tr A 1.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spherical() -> Self {
        Self::isotropic(T::lit(1.0 / 3.0), T::zero())
    }

    /// The identity less the spherical projector: A ↦ dev A.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn deviatoric() -> Self {
        Self::isotropic(T::lit(-1.0 / 3.0), T::lit(0.5))
    }

    /// λ 1 ⊗ 1 + 2 μ identity: A ↦ λ tr A 1 + 2 μ A, Hooke's law of an isotropic body.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn isotropic(lambda: T, mu: T) -> Self {
        let (o, l, m) = (T::zero(), lambda, mu);
        let n = l + m + m;
        Self { components: [n, l, l, o, o, o, n, l, o, o, o, n, o, o, o, m, o, o, m, o, m] }
    }

    /// A ⊗ A = `A_ij A_kl`.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn dyad(a: &Symmetric<T>) -> Self {
        let a = a.components;
        Self { components: upper!(i, j => a[i] * a[j]) }
    }

    /// ½ (A ⊗ B + B ⊗ A).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symmetric_dyad(a: &Symmetric<T>, b: &Symmetric<T>) -> Self {
        let (a, b, half) = (a.components, b.components, T::lit(0.5));
        Self { components: upper!(i, j => half * (a[i] * b[j] + b[i] * a[j])) }
    }

    /// ½ (A ⊗̄ A + A ⊗̲ A) = ½ (`A_ik A_jl + A_il A_jk`): B ↦ A B A; its negative is ∂A⁻¹/∂A at A⁻¹.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn square_dyad(a: &Symmetric<T>) -> Self {
        let (a, half) = (a.rows(), T::lit(0.5));
        let components = upper!(p, q => {
            let ((i, j), (k, l)) = (PAIR[p], PAIR[q]);
            half * (a[i][k] * a[j][l] + a[i][l] * a[j][k])
        });
        Self { components }
    }

    /// ¼ (A ⊗̄ B + A ⊗̲ B + B ⊗̄ A + B ⊗̲ A): C ↦ ½ (A C B + B C A).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn symmetric_square_dyad(a: &Symmetric<T>, b: &Symmetric<T>) -> Self {
        let (a, b, quarter) = (a.rows(), b.rows(), T::lit(0.25));
        Self::from_fn(|p, q| {
            let ((i, j), (k, l)) = (PAIR[p], PAIR[q]);
            quarter * ((a[i][k] * b[j][l] + b[i][k] * a[j][l]) + (a[i][l] * b[j][k] + b[i][l] * a[j][k]))
        })
    }

    /// C⁻¹, with C⁻¹ : C = identity of symmetric tensors.
    ///
    /// # Errors
    /// As [`MinorSymmetric::inverse`](super::MinorSymmetric::inverse).
    pub fn inverse(&self) -> Result<Self, TensorError> {
        Ok(self.minor().inverse()?.major_part())
    }

    /// From a formula for entry (row, column), row ≤ column, of the 6×6 array over pairs.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_fn(f: impl Fn(usize, usize) -> T) -> Self {
        let mut components = [T::zero(); 21];
        let mut place = 0;
        for i in 0..6 {
            for j in i..6 {
                components[place] = f(i, j);
                place += 1;
            }
        }
        Self { components }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn each(a: &Self, b: &Self, f: impl Fn(T, T) -> T) -> Self {
        // Written out as those of `upper`.
        let (a, b) = (&a.components, &b.components);
        macro_rules! all {
            ($($k:literal)*) => { [$(f(a[$k], b[$k])),*] };
        }
        Self { components: all!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20) }
    }
}

linear_space!(MajorSymmetric);

impl<T: Real> PairSymmetric<T> for MajorSymmetric<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn slots(&self) -> Slots<T> {
        let row = |i: usize| kernels::full_row(&self.components, i);
        [row(0), row(1), row(2), row(3), row(4), row(5)]
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn from_slots(slots: &Slots<T>) -> Self {
        Self::from_fn(|i, j| slots[i][j])
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn transformed(&self, matrix: &Slots<T>) -> Self {
        Self { components: kernels::transform_major(matrix, &self.components) }
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn entry(&self, i: usize, j: usize, k: usize, l: usize) -> T {
        self.components[kernels::triangle(SLOT[i][j], SLOT[k][l])]
    }
}
