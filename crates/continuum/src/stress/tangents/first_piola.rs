//! ∂P/∂F to and from ∂S/∂E.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::internal::rows::identity;
use piola_tensor::rotation::check_rotation;
use piola_tensor::{FourthOrder, Minor, MinorSymmetric, PairSymmetric, Symmetry};

use super::{FirstPiolaTangent, MaterialTangent, kernels};
use crate::rates::GradientRate;
use crate::{ContinuumError, Deformation, FirstPiola, SecondPiola};

impl<T: Real, Y: Symmetry> MaterialTangent<T, Y> {
    /// ∂P/∂F = `δ_ij S_AB + F_iC F_jD C_CADB`.
    ///
    /// # Accuracy
    /// 12 ulp of |F|² |C| + |S|.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn first_piola(&self, stress: &SecondPiola<T>, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        let components = kernels::first_piola_tangent(deformation.gradient_rows(), &stress.0, &self.0.slots());
        FirstPiolaTangent(FourthOrder { components })
    }

    /// Ṡ = C : Ė of a rate of Green's strain, Pa/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rate(&self, strain_rate: &crate::Symmetric<T>) -> SecondPiola<T> {
        SecondPiola(self.0.contract(strain_rate))
    }
}

impl<T: Real> FirstPiolaTangent<T> {
    /// Ṗ = A : Ḟ, Pa/s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn rate(&self, gradient_rate: &GradientRate<T>) -> FirstPiola<T> {
        FirstPiola::trusted(self.0.contract(gradient_rate.rows()))
    }

    /// ∂S/∂E = `F⁻¹_Ci F⁻¹_Dj (A_iAjB − δ_ij S_AB)`.
    ///
    /// The tangent of any law that does not depend on the observer has minor symmetries then, and what is lacking is
    /// rounding: the mean over the exchanges is returned, and [`objectivity_residual`](Self::objectivity_residual)
    /// tells how much is left out. Of a law with an energy,
    /// [`major_part`](piola_tensor::MinorSymmetric::major_part) has the major symmetry too.
    ///
    /// # Accuracy
    /// 16 ulp of |F⁻¹|² (|A| + |S|).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material(&self, stress: &SecondPiola<T>, deformation: &impl Deformation<T>) -> MaterialTangent<T, Minor> {
        let slots = kernels::material_tangent(deformation.inverse_rows(), &stress.0, &self.0.components);
        MaterialTangent(MinorSymmetric { components: slots })
    }

    /// The largest entry of what `F⁻¹_Ci F⁻¹_Dj (A_iAjB − δ_ij S_AB)` lacks of minor symmetries, Pa: zero to
    /// rounding when the law is objective and the stress its own.
    #[must_use]
    pub fn objectivity_residual(&self, stress: &SecondPiola<T>, deformation: &impl Deformation<T>) -> T {
        let s = stress.0.rows();
        let a = FourthOrder::from_fn(|i, a, j, b| {
            let entry = self.entry(i, a, j, b);
            if i == j { entry - s[a][b] } else { entry }
        });
        let c = a.transformed(deformation.inverse_rows(), identity());
        c.first_minor_residual().max(c.second_minor_residual())
    }

    /// The tangent of the body turned by Q after its deformation: `Q_ik Q_jl A_kAlB`.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`TensorError::NotARotation`](piola_tensor::TensorError::NotARotation).
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self(self.0.transformed(rows_of(rotation), identity())))
    }
}
