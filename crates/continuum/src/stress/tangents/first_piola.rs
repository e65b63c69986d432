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
    ///
    /// # Example
    /// ```
    /// use piola_continuum::stress::tangents::MaterialTangent;
    /// use piola_tensor::MajorSymmetric;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// let tangent: MaterialTangent = MaterialTangent(MajorSymmetric::isotropic(1.0, 3.0));
    /// let stress = SecondPiola::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// let nominal = tangent.first_piola(&stress, &DeformationGradient::diagonal([2.0, 1.0, 1.0])?);
    /// assert_eq!((nominal.entry(0, 0, 0, 0), nominal.entry(0, 0, 1, 1)), (38.0, 2.0)); // S₁₁ + 2² (λ + 2μ), 2 λ
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, stress: &SecondPiola<T>, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        let components = kernels::first_piola_tangent(deformation.gradient_rows(), &stress.0, &self.0.slots());
        FirstPiolaTangent(FourthOrder { components })
    }

    /// Ṡ = C : Ė of a rate of Green's strain, Pa/s.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{Symmetric, stress::tangents::MaterialTangent};
    /// use piola_tensor::MajorSymmetric;
    /// let tangent: MaterialTangent = MaterialTangent(MajorSymmetric::isotropic(1.0, 3.0));
    /// let rate = tangent.rate(&Symmetric::new(1.0, 0.0, 0.0, 2.0, 0.0, 0.0));
    /// assert_eq!(rate.0.components, [7.0, 1.0, 1.0, 12.0, 0.0, 0.0]); // λ tr Ė 1 + 2μ Ė
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn rate(&self, strain_rate: &crate::Symmetric<T>) -> SecondPiola<T> {
        SecondPiola(self.0.contract(strain_rate))
    }
}

impl<T: Real> FirstPiolaTangent<T> {
    /// Ṗ = A : Ḟ, Pa/s.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{rates::GradientRate, stress::tangents::FirstPiolaTangent};
    /// use piola_tensor::FourthOrder;
    /// let tangent = FirstPiolaTangent(FourthOrder::identity());
    /// let rate = GradientRate::from_rows([[0.0, 5.0, 0.0], [0.0; 3], [0.0; 3]])?;
    /// assert_eq!(tangent.rate(&rate).0[(0, 1)], 5.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
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
    ///
    /// # Example
    /// ```
    /// use piola_continuum::stress::tangents::MaterialTangent;
    /// use piola_tensor::MajorSymmetric;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// let tangent: MaterialTangent = MaterialTangent(MajorSymmetric::isotropic(1.0, 3.0));
    /// let stress = SecondPiola::new(10.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// let stretch = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
    /// let back = tangent.first_piola(&stress, &stretch).material(&stress, &stretch);
    /// assert_eq!((back.entry(0, 0, 0, 0), back.entry(0, 0, 1, 1)), (7.0, 1.0));
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn material(&self, stress: &SecondPiola<T>, deformation: &impl Deformation<T>) -> MaterialTangent<T, Minor> {
        let slots = kernels::material_tangent(deformation.inverse_rows(), &stress.0, &self.0.components);
        MaterialTangent(MinorSymmetric { components: slots })
    }

    /// The largest entry of what `F⁻¹_Ci F⁻¹_Dj (A_iAjB − δ_ij S_AB)` lacks of minor symmetries, Pa: zero to
    /// rounding when the law is objective and the stress its own.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::stress::tangents::FirstPiolaTangent;
    /// use piola_tensor::FourthOrder;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// let (stress, still) = (SecondPiola::<f64>::zero(), DeformationGradient::identity());
    /// // Without stress a turn of the body leaves P as it is; a tangent that is the identity would change it.
    /// assert_eq!(FirstPiolaTangent(FourthOrder::identity()).objectivity_residual(&stress, &still), 1.0);
    /// assert_eq!(FirstPiolaTangent(FourthOrder::symmetrizer()).objectivity_residual(&stress, &still), 0.0);
    /// ```
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
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::stress::tangents::FirstPiolaTangent;
    /// use piola_tensor::FourthOrder;
    /// let quarter_turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0);
    /// let e1 = [[2.0, 0.0, 0.0], [0.0; 3], [0.0; 3]];
    /// let turned = FirstPiolaTangent(FourthOrder::dyad(e1, e1)).rotated(&quarter_turn)?;
    /// assert_eq!(turned.entry(1, 0, 1, 0), 4.0); // the indices of space turn, those of the reference do not
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn rotated(&self, rotation: &Matrix3<T>) -> Result<Self, ContinuumError> {
        check_rotation(rotation)?;
        Ok(Self(self.0.transformed(rows_of(rotation), identity())))
    }
}
