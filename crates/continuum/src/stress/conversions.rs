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
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(self.0 * deformation.jacobian())
    }

    /// P = T Cof F, W(17.21): force per area before the deformation.
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(first_piola_of_cauchy(deformation.gradient_rows(), &self.0))
    }

    /// S = J F⁻¹ T F⁻ᵀ, B(4.57).
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_cauchy(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// M = Fᵀ T Cof F.
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ T Cof F.
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}

impl<T: Real> KirchhoffStress<T> {
    /// T = τ/J.
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(self.0 * deformation.jacobian().recip())
    }

    /// P = τ F⁻ᵀ.
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(first_piola_of_kirchhoff(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// S = F⁻¹ τ F⁻ᵀ.
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(congruence(inverse(deformation), &self.0))
    }

    /// M = Fᵀ τ F⁻ᵀ.
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// Biot's stress Rᵀ τ F⁻ᵀ.
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }
}

impl<T: Real> FirstPiola<T> {
    /// T = sym(P Fᵀ)/J, W(17.21).
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(cauchy_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// τ = sym(P Fᵀ).
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(product_symmetrized(self.rows(), deformation.gradient_rows()))
    }

    /// S = sym(F⁻¹ P), B(4.57).
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        SecondPiola(second_piola_of_first_piola(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// M = Fᵀ P.
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        MandelStress::from_rows(transposed_product(deformation.gradient_rows(), self.rows()))
    }

    /// Biot's stress Rᵀ P; its rotation R is computed, see [`StretchAnalysis`].
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.biot_of_analysis(&StretchAnalysis::of(deformation))
    }

    /// Biot's stress Rᵀ P where the stretches are known already.
    #[inline(always)]
    #[must_use]
    pub fn biot_of_analysis(&self, stretches: &StretchAnalysis<T>) -> BiotStress<T> {
        BiotStress::from_rows(transposed_product(stretches.rotation(), self.rows()))
    }

    /// Biot's stress Rᵀ P where the rotation R of F is known.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NotARotation`].
    pub fn biot_of_rotation(&self, rotation: &Matrix3<T>) -> Result<BiotStress<T>, ContinuumError> {
        check_rotation(rotation)?;
        Ok(BiotStress::from_rows(transposed_product(rows_of(rotation), self.rows())))
    }
}

impl<T: Real> SecondPiola<T> {
    /// T = F S Fᵀ/J, B(4.57).
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(cauchy_of_second_piola(deformation.gradient_rows(), deformation.jacobian(), &self.0))
    }

    /// τ = F S Fᵀ.
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        KirchhoffStress(congruence(deformation.gradient_rows(), &self.0))
    }

    /// P = F S, B(4.57).
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(product(deformation.gradient_rows(), self.rows()))
    }

    /// M = C S, as Fᵀ (F S).
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// M = C S where the right Cauchy–Green tensor is all that is known.
    #[inline(always)]
    #[must_use]
    pub fn mandel_of_right_cauchy_green(&self, right_cauchy_green: &RightCauchyGreen<T>) -> MandelStress<T> {
        MandelStress::from_rows(product(right_cauchy_green.rows(), self.rows()))
    }

    /// Biot's stress U S, as Rᵀ (F S).
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }

    /// Biot's stress U S where the right stretch is all that is known.
    #[inline(always)]
    #[must_use]
    pub fn biot_of_right_stretch(&self, right_stretch: &Symmetric<T>) -> BiotStress<T> {
        BiotStress::from_rows(product(right_stretch.rows(), self.rows()))
    }
}

impl<T: Real> MandelStress<T> {
    /// P = F⁻ᵀ M.
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(first_piola_of_mandel(deformation.gradient_rows(), deformation.jacobian(), self.rows()))
    }

    /// T = sym(F⁻ᵀ M Fᵀ)/J.
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.first_piola(deformation).cauchy(deformation)
    }

    /// τ = sym(F⁻ᵀ M Fᵀ).
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        self.first_piola(deformation).kirchhoff(deformation)
    }

    /// Biot's stress U⁻¹ M, as Rᵀ (F⁻ᵀ M).
    #[inline(always)]
    #[must_use]
    pub fn biot(&self, deformation: &impl Deformation<T>) -> BiotStress<T> {
        self.first_piola(deformation).biot(deformation)
    }

    /// S = sym(C⁻¹ M), as F⁻¹ (F⁻ᵀ M).
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.first_piola(deformation).second_piola(deformation)
    }
}

impl<T: Real> BiotStress<T> {
    /// P = R Biot; the rotation R is computed, see [`StretchAnalysis`].
    #[inline(always)]
    #[must_use]
    pub fn first_piola(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.first_piola_of_analysis(&StretchAnalysis::of(deformation))
    }

    /// P = R Biot where the stretches are known already.
    #[inline(always)]
    #[must_use]
    pub fn first_piola_of_analysis(&self, stretches: &StretchAnalysis<T>) -> FirstPiola<T> {
        FirstPiola::from_rows(product(stretches.rotation(), self.rows()))
    }

    /// T = sym(R Biot Fᵀ)/J.
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        self.first_piola(deformation).cauchy(deformation)
    }

    /// τ = sym(R Biot Fᵀ).
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        self.first_piola(deformation).kirchhoff(deformation)
    }

    /// S = sym(U⁻¹ Biot), as F⁻¹ (R Biot).
    #[inline(always)]
    #[must_use]
    pub fn second_piola(&self, deformation: &impl Deformation<T>) -> SecondPiola<T> {
        self.first_piola(deformation).second_piola(deformation)
    }

    /// M = U Biot, as Fᵀ (R Biot).
    #[inline(always)]
    #[must_use]
    pub fn mandel(&self, deformation: &impl Deformation<T>) -> MandelStress<T> {
        self.first_piola(deformation).mandel(deformation)
    }

    /// P = R Biot where the rotation R of F is known.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`], [`ContinuumError::NotARotation`].
    pub fn first_piola_of_rotation(&self, rotation: &Matrix3<T>) -> Result<FirstPiola<T>, ContinuumError> {
        check_rotation(rotation)?;
        Ok(FirstPiola::from_rows(product(rows_of(rotation), self.rows())))
    }

    /// Its symmetric part, conjugate to U: ½ (Rᵀ P + Pᵀ R) = ½ (U S + S U).
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
