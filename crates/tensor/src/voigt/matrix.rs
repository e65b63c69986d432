//! 6×6 matrices of tangents, with the factors of each convention.

use core::marker::PhantomData;
use core::ops::Mul;

use nalgebra::Matrix6;
use piola_numerics::Real;

use super::order::{Piola, VoigtOrder};
use super::vector::{MandelVector, StrainVector, StressVector};
use crate::TensorError;
use crate::error::check_finite;
use crate::fourth::kernels::dot6;
use crate::{MinorSymmetric, PairSymmetric, Slots};

macro_rules! matrices {
    ($($(#[$documentation:meta])* $name:ident, $quantity:literal, $one:expr, $two:expr, $right:ident => $left:ident;)*) => {$(
        $(#[$documentation])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
        #[cfg_attr(feature = "serde", serde(
            try_from = "[[T; 6]; 6]",
            into = "[[T; 6]; 6]",
            bound(
                serialize = "T: Real + serde::Serialize, O: VoigtOrder",
                deserialize = "T: Real + serde::Deserialize<'de>, O: VoigtOrder"
            )
        ))]
        pub struct $name<T = f64, O = Piola> {
            /// The entries by rows in the order O, with the factors of this type.
            pub entries: [[T; 6]; 6],
            order: PhantomData<O>,
        }

        impl<T: Real, O: VoigtOrder> $name<T, O> {
            /// The factor of an entry with shears in none, one or both of its pairs.
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn factor(row: usize, column: usize) -> T {
                match (row < 3, column < 3) {
                    (true, true) => T::one(),
                    (false, false) => T::lit($two),
                    _ => T::lit($one),
                }
            }

            /// From entries by rows in the order O, with the factors of this type.
            ///
            /// # Errors
            /// [`TensorError::NotFinite`].
            pub fn new(entries: [[T; 6]; 6]) -> Result<Self, TensorError> {
                check_finite($quantity, entries.as_flattened())?;
                Ok(Self { entries, order: PhantomData })
            }

            /// From a matrix of nalgebra.
            ///
            /// # Errors
            /// [`TensorError::NotFinite`].
            pub fn from_matrix(matrix: &Matrix6<T>) -> Result<Self, TensorError> {
                Self::new(MinorSymmetric::from_matrix(matrix)?.components)
            }

            /// As a matrix of nalgebra.
            #[must_use]
            pub fn matrix(&self) -> Matrix6<T> {
                Matrix6::from_fn(|i, j| self.entries[i][j])
            }

            /// Of a tensor.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn of(tensor: &impl PairSymmetric<T>) -> Self {
                let slots: Slots<T> = tensor.slots();
                let mut entries = [[T::zero(); 6]; 6];
                for (i, row) in entries.iter_mut().enumerate() {
                    for (j, entry) in row.iter_mut().enumerate() {
                        *entry = slots[O::PLACES[i]][O::PLACES[j]] * Self::factor(i, j);
                    }
                }
                Self { entries, order: PhantomData }
            }

            /// The tensor; with [`major_symmetric`](MinorSymmetric::major_symmetric) its major symmetry is checked.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn tensor(&self) -> MinorSymmetric<T> {
                let mut tensor = MinorSymmetric::zero();
                for (i, row) in self.entries.iter().enumerate() {
                    for (j, entry) in row.iter().enumerate() {
                        tensor.components[O::PLACES[i]][O::PLACES[j]] = *entry / Self::factor(i, j);
                    }
                }
                tensor
            }

            /// The same in another order, to the last bit.
            #[cfg_attr(not(debug_assertions), inline(always))]
            #[must_use]
            pub fn reordered<N: VoigtOrder>(&self) -> $name<T, N> {
                let mut stored = [[T::zero(); 6]; 6];
                for (i, row) in self.entries.iter().enumerate() {
                    for (j, entry) in row.iter().enumerate() {
                        stored[O::PLACES[i]][O::PLACES[j]] = *entry;
                    }
                }
                let entries =
                    [0, 1, 2, 3, 4, 5].map(|i: usize| [0, 1, 2, 3, 4, 5].map(|j: usize| stored[N::PLACES[i]][N::PLACES[j]]));
                $name { entries, order: PhantomData }
            }
        }

        impl<T: Real, O: VoigtOrder> Mul<$right<T, O>> for $name<T, O> {
            type Output = $left<T, O>;
            #[cfg_attr(not(debug_assertions), inline(always))]
            fn mul(self, vector: $right<T, O>) -> $left<T, O> {
                let row = |i: usize| dot6(&self.entries[i], &vector.components);
                $left::raw([row(0), row(1), row(2), row(3), row(4), row(5)])
            }
        }

        /// Refuses infinite and NaN entries.
        impl<T: Real, O: VoigtOrder> TryFrom<[[T; 6]; 6]> for $name<T, O> {
            type Error = TensorError;
            fn try_from(entries: [[T; 6]; 6]) -> Result<Self, TensorError> {
                Self::new(entries)
            }
        }

        impl<T, O> From<$name<T, O>> for [[T; 6]; 6] {
            fn from(matrix: $name<T, O>) -> Self {
                matrix.entries
            }
        }
    )*};
}

matrices! {
    /// A stiffness-like matrix: entries `C_ijkl`, which multiply engineering shears as they are.
    ///
    /// # Example
    /// ```
    /// use piola_tensor::{MajorSymmetric, voigt::StiffnessMatrix};
    /// let matrix = StiffnessMatrix::<f64>::of(&MajorSymmetric::isotropic(1.0, 3.0));
    /// assert_eq!((matrix.entries[0][0], matrix.entries[3][3]), (7.0, 3.0)); // λ + 2μ, μ
    /// ```
    StiffnessMatrix, "stiffness matrix", 1.0, 1.0, StrainVector => StressVector;
    /// A compliance-like matrix: entries doubled for one pair of shears and four times for two.
    ///
    /// # Example
    /// ```
    /// use piola_tensor::{MajorSymmetric, voigt::ComplianceMatrix};
    /// let compliance = MajorSymmetric::isotropic(0.0, 2.0).inverse()?; // ε = σ/4
    /// let matrix = ComplianceMatrix::<f64>::of(&compliance);
    /// assert_eq!((matrix.entries[0][0], matrix.entries[3][3]), (0.25, 0.5)); // γ = σ₁₂/μ
    /// # Ok::<(), piola_tensor::TensorError>(())
    /// ```
    ComplianceMatrix, "compliance matrix", 2.0, 4.0, StressVector => StrainVector;
    /// A matrix of Mandel: entries times √2 for one pair of shears and 2 for two. Products, inverses, norms and
    /// eigenvalues are those of the tensors.
    ///
    /// # Example
    /// ```
    /// use piola_tensor::{MajorSymmetric, voigt::MandelMatrix};
    /// let matrix = MandelMatrix::<f64>::of(&MajorSymmetric::identity());
    /// assert_eq!(matrix.matrix(), nalgebra::Matrix6::identity());
    /// ```
    MandelMatrix, "Mandel matrix", core::f64::consts::SQRT_2, 2.0, MandelVector => MandelVector;
}

impl<T: Real, O: VoigtOrder> StiffnessMatrix<T, O> {
    /// The compliance matrix, its inverse.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`], [`TensorError::SingularTensor`].
    pub fn compliance(&self) -> Result<ComplianceMatrix<T, O>, TensorError> {
        Ok(ComplianceMatrix::of(&self.tensor().inverse()?))
    }
}

impl<T: Real, O: VoigtOrder> ComplianceMatrix<T, O> {
    /// The stiffness matrix, its inverse.
    ///
    /// # Errors
    /// [`TensorError::NotFinite`], [`TensorError::SingularTensor`].
    pub fn stiffness(&self) -> Result<StiffnessMatrix<T, O>, TensorError> {
        Ok(StiffnessMatrix::of(&self.tensor().inverse()?))
    }
}
