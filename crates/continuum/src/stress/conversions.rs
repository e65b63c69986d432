//! Conversions between the measures of stress: the table is in the documentation of [`stress`](crate::stress).

use nalgebra::Matrix3;
use piola_numerics::Real;
use piola_numerics::linear::matrix3::rows_of;

use super::kernels::{
    cauchy_of_first_piola, cauchy_of_second_piola, cofactor, congruence, first_piola_of_cauchy,
    first_piola_of_kirchhoff, first_piola_of_mandel, product_symmetrized, second_piola_of_cauchy,
    second_piola_of_first_piola,
};
use super::{BiotStress, CauchyStress, FirstPiola, KirchhoffStress, MandelStress, SecondPiola};
use crate::spectral::StretchAnalysis;
use crate::strain::RightCauchyGreen;
use crate::tensor::rotation::check_rotation;
use crate::tensor::rows::{Rows, product, scaled, transpose, transposed_product};
use crate::{ContinuumError, Deformation, Symmetric};

impl<T: Real> CauchyStress<T> {
    /// τ = J T.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, CauchyStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.kirchhoff(&bar).0.components[0], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(self.0 * deformation.jacobian())
    }

    /// P = T Cof F, W(17.21): force per area before the deformation.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, CauchyStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.first_piola(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(first_piola_of_cauchy(deformation.gradient_rows(), &self.0))
    }

    /// S = J F⁻¹ T F⁻ᵀ, B(4.57).
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, CauchyStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_cauchy(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// M = Fᵀ T Cof F.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, CauchyStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ T Cof F.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, CauchyStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = CauchyStress::new(8.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}

impl<T: Real> KirchhoffStress<T> {
    /// T = τ/J.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.cauchy(&bar).0.components[0], 8.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(self.0 * deformation.jacobian().recip())
    }

    /// P = τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.first_piola(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(first_piola_of_kirchhoff(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// S = F⁻¹ τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(congruence(inverse(deformation), &self.0))
    }

    /// M = Fᵀ τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ τ F⁻ᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, KirchhoffStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = KirchhoffStress::new(4.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}

impl<T: Real> FirstPiola<T> {
    /// T = sym(P Fᵀ)/J, W(17.21).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.cauchy(&bar).0.components[0], 8.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(cauchy_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// τ = sym(P Fᵀ).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.kirchhoff(&bar).0.components[0], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(product_symmetrized(self.rows(), deformation.gradient_rows()))
    }

    /// S = sym(F⁻¹ P), B(4.57).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// M = Fᵀ P.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        MandelStress::from_rows(transposed_product(deformation.gradient_rows(), self.rows()))
    }

    /// Biot's stress Rᵀ P; its rotation R is computed, see [`StretchAnalysis`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.biot_of_analysis(&StretchAnalysis::of(deformation))
    }

    /// Biot's stress Rᵀ P where the stretches are known already.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::spectral::StretchAnalysis;
    /// use piola_continuum::{DeformationGradient, FirstPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.biot_of_analysis(&StretchAnalysis::of(&bar)).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot_of_analysis(&self, stretches: &StretchAnalysis<T>) -> BiotStress<T> {
        BiotStress::from_rows(transposed_product(stretches.rotation(), self.rows()))
    }

    /// Biot's stress Rᵀ P where the rotation R of F is known.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NotARotation`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::FirstPiola;
    /// let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0); // e₁ to e₂
    /// let stress = FirstPiola::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.biot_of_rotation(&turn)?.0[(1, 0)], -2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn biot_of_rotation(&self, rotation: &Matrix3<T>) -> Result<BiotStress<T>, ContinuumError> {
        check_rotation(rotation)?;
        Ok(BiotStress::from_rows(transposed_product(rows_of(rotation), self.rows())))
    }
}

impl<T: Real> SecondPiola<T> {
    /// T = F S Fᵀ/J, B(4.57).
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, SecondPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.cauchy(&bar).0.components[0], 8.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(cauchy_of_second_piola(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// τ = F S Fᵀ.
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, SecondPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.kirchhoff(&bar).0.components[0], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(congruence(deformation.gradient_rows(), &self.0))
    }

    /// P = F S, B(4.57).
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, SecondPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.first_piola(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(product(deformation.gradient_rows(), self.rows()))
    }

    /// M = C S, as Fᵀ (F S).
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, SecondPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// M = C S where the right Cauchy–Green tensor is all that is known.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{SecondPiola, strain::RightCauchyGreen};
    /// let squares = RightCauchyGreen::new(4.0, 0.25, 0.25, 0.0, 0.0, 0.0)?;
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.mandel_of_right_cauchy_green(&squares).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel_of_right_cauchy_green(&self, right_cauchy_green: &RightCauchyGreen<T>) -> MandelStress<T> {
        MandelStress::from_rows(product(right_cauchy_green.rows(), self.rows()))
    }

    /// Biot's stress U S, as Rᵀ (F S).
    ///
    /// # Example
    /// ```
    /// # use piola_continuum::{DeformationGradient, SecondPiola};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }

    /// Biot's stress U S where the right stretch is all that is known.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::{SecondPiola, Symmetric};
    /// let stress = SecondPiola::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0)?;
    /// assert_eq!(stress.biot_of_right_stretch(&Symmetric::diagonal([2.0, 0.5, 0.5])).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot_of_right_stretch(&self, right_stretch: &Symmetric<T>) -> BiotStress<T> {
        BiotStress::from_rows(product(right_stretch.rows(), self.rows()))
    }
}

impl<T: Real> MandelStress<T> {
    /// P = F⁻ᵀ M.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, MandelStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = MandelStress::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.first_piola(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(first_piola_of_mandel(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// T = sym(F⁻ᵀ M Fᵀ)/J.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, MandelStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = MandelStress::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.cauchy(&bar).0.components[0], 8.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.first_piola(deformation).cauchy(deformation)
    }

    /// τ = sym(F⁻ᵀ M Fᵀ).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, MandelStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = MandelStress::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.kirchhoff(&bar).0.components[0], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        self.first_piola(deformation).kirchhoff(deformation)
    }

    /// Biot's stress U⁻¹ M, as Rᵀ (F⁻ᵀ M).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, MandelStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = MandelStress::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.biot(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }

    /// S = sym(C⁻¹ M), as F⁻¹ (F⁻ᵀ M).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, MandelStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = MandelStress::new(Matrix3::from_diagonal(&[4.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.first_piola(deformation).second_piola(deformation)
    }
}

impl<T: Real> BiotStress<T> {
    /// P = R Biot; the rotation R is computed, see [`StretchAnalysis`].
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, BiotStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.first_piola(&bar).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.first_piola_of_analysis(&StretchAnalysis::of(deformation))
    }

    /// P = R Biot where the stretches are known already.
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::spectral::StretchAnalysis;
    /// use piola_continuum::{BiotStress, DeformationGradient};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?;
    /// let stress = BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.first_piola_of_analysis(&StretchAnalysis::of(&bar)).0[(0, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn first_piola_of_analysis(&self, stretches: &StretchAnalysis<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(product(stretches.rotation(), self.rows()))
    }

    /// T = sym(R Biot Fᵀ)/J.
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, BiotStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.cauchy(&bar).0.components[0], 8.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.first_piola(deformation).cauchy(deformation)
    }

    /// τ = sym(R Biot Fᵀ).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, BiotStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.kirchhoff(&bar).0.components[0], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        self.first_piola(deformation).kirchhoff(deformation)
    }

    /// S = sym(U⁻¹ Biot), as F⁻¹ (R Biot).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, BiotStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.second_piola(&bar).0.components[0], 1.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.first_piola(deformation).second_piola(deformation)
    }

    /// M = U Biot, as Fᵀ (R Biot).
    ///
    /// # Example
    /// ```
    /// # use nalgebra::Matrix3;
    /// # use piola_continuum::{DeformationGradient, BiotStress};
    /// let bar = DeformationGradient::diagonal([2.0, 0.5, 0.5])?; // J = 1/2
    /// let stress = BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.mandel(&bar).0[(0, 0)], 4.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// P = R Biot where the rotation R of F is known.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NotARotation`].
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::BiotStress;
    /// let turn = Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0); // e₁ to e₂
    /// let stress = BiotStress::new(Matrix3::from_diagonal(&[2.0, 0.0, 0.0].into()))?;
    /// assert_eq!(stress.first_piola_of_rotation(&turn)?.0[(1, 0)], 2.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    pub fn first_piola_of_rotation(&self, rotation: &Matrix3<T>) -> Result<FirstPiola<T>, ContinuumError> {
        check_rotation(rotation)?;
        Ok(FirstPiola::from_rows(product(rows_of(rotation), self.rows())))
    }

    /// Its symmetric part, conjugate to U: ½ (Rᵀ P + Pᵀ R) = ½ (U S + S U).
    ///
    /// # Example
    /// ```
    /// use nalgebra::Matrix3;
    /// use piola_continuum::BiotStress;
    /// let stress = BiotStress::new(Matrix3::new(0.0, 4.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0))?;
    /// assert_eq!(stress.symmetric_part().components[3], 3.0);
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[inline(always)]
    #[must_use]
    pub fn symmetric_part(&self) -> Symmetric<T> {
        Symmetric::symmetric_part(self.rows())
    }
}

/// F⁻¹.
#[inline(always)]
fn inverse<T: Real>(deformation: &impl Deformation<T>) -> Rows<T> {
    scaled(transpose(cofactor(deformation.gradient_rows())), deformation.jacobian().recip())
}
