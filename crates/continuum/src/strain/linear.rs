//! The linear strain and the engineering strain vector.

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;
use piola_tensor::voigt::{BroNielsen, Piola, StrainVector};

use super::lines::derivatives_of_measure;
use crate::measures::{linear_measure, symmetric_measure};
use crate::{Deformation, Symmetric};

symmetric_measure! {
    /// The linear strain ε = ½ (∇u + ∇uᵀ), the limit of every strain for ∇u → 0.
    ///
    /// It is not invariant under rotation: a rotation by φ about an axis has ε = (cos φ − 1) across the axis.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::DisplacementGradient;
    /// use piola_continuum::strain::LinearStrain;
    /// let shear = DisplacementGradient::simple_shear(0.5)?;
    /// assert_eq!(LinearStrain::of(&shear), LinearStrain::new(0.0, 0.0, 0.0, 0.25, 0.0, 0.0)?);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    ///
    /// # Source
    /// B(4.71).
    LinearStrain, "ε", "1", |_strain| Symmetric::<T>::identity()
}

linear_measure!(LinearStrain);

derivatives_of_measure!(LinearStrain, whole);

impl<T: Real> LinearStrain<T> {
    /// ε = ½ (∇u + ∇uᵀ).
    ///
    /// # Accuracy
    /// ½ ulp of each component, from ∇u.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of(deformation: &impl Deformation<T>) -> Self {
        Self(Symmetric::symmetric_part(deformation.displacement_rows()))
    }

    /// dε = sym dF along the direction dF, the same at every deformation; with Ḟ for dF the rate of ε, 1/s. The
    /// [engineering](Self::engineering) vector of it is the derivative of the vector. Second derivatives are zero.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn derivative(_deformation: &impl Deformation<T>, direction: &Matrix3<T>) -> Symmetric<T> {
        Symmetric::symmetric_part(rows_of(direction))
    }

    /// The engineering strain vector in Voigt's order, [ε₁₁, ε₂₂, ε₃₃, γ₁₂, γ₂₃, γ₁₃] with γᵢⱼ = 2 εᵢⱼ = uᵢ,ⱼ + uⱼ,ᵢ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn engineering(&self) -> [T; 6] {
        StrainVector::<T, Piola>::of(&self.0).components
    }

    /// The engineering strain vector in Bro-Nielsen's order, `[u_x, v_y, w_z, u_y + v_x, u_z + w_x, v_z + w_y]`.
    ///
    /// Its last two shears, 13 and 23, are exchanged against those of [`engineering`](Self::engineering).
    ///
    /// # Source
    /// B(4.73).
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn engineering_bro_nielsen(&self) -> [T; 6] {
        StrainVector::<T, BroNielsen>::of(&self.0).components
    }

    /// From the engineering strain vector in Voigt's order, with doubled shears.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`](crate::ContinuumError::NotFinite).
    pub fn from_engineering(vector: [T; 6]) -> Result<Self, crate::ContinuumError> {
        Ok(Self(StrainVector::<T, Piola>::new(vector)?.tensor()))
    }

    /// From the engineering strain vector in Bro-Nielsen's order, with doubled shears.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`](crate::ContinuumError::NotFinite).
    ///
    /// # Source
    /// B(4.73).
    pub fn from_engineering_bro_nielsen(vector: [T; 6]) -> Result<Self, crate::ContinuumError> {
        Ok(Self(StrainVector::<T, BroNielsen>::new(vector)?.tensor()))
    }
}
