//! ∂S/∂E to and from the spatial tangents, and those to and from one another.

use piola_numerics::Real;

use super::{
    CauchyJaumannTangent, CauchyLowerConvectedTangent, CauchyUpperConvectedTangent, FirstPiolaTangent, JaumannTangent,
    LieTangent, LowerConvectedTangent, MaterialTangent, TruesdellTangent,
};
use crate::tensor::{MajorSymmetric, Minor, MinorSymmetric, PairSymmetric, Symmetry};
use crate::{CauchyStress, Deformation, SecondPiola, Symmetric};

impl<T: Real, Y: Symmetry> MaterialTangent<T, Y> {
    /// c = `F_iA F_jB F_kC F_lD C_ABCD`, the push-forward.
    ///
    /// # Accuracy
    /// 24 ulp of |F|⁴ |C|.
    #[inline(always)]
    #[must_use]
    pub fn lie(&self, deformation: &impl Deformation<T>) -> LieTangent<T, Y> {
        LieTangent(self.0.congruence(deformation.gradient_rows()))
    }

    /// c/J.
    #[inline(always)]
    #[must_use]
    pub fn truesdell(&self, deformation: &impl Deformation<T>) -> TruesdellTangent<T, Y> {
        self.lie(deformation).truesdell(deformation)
    }
}

impl<T: Real> FirstPiolaTangent<T> {
    /// c/J of ∂P/∂F, by way of ∂S/∂E.
    #[inline(always)]
    #[must_use]
    pub fn truesdell(&self, stress: &SecondPiola<T>, deformation: &impl Deformation<T>) -> TruesdellTangent<T, Minor> {
        self.material(stress, deformation).truesdell(deformation)
    }
}

impl<T: Real, Y: Symmetry> LieTangent<T, Y> {
    /// c/J.
    #[inline(always)]
    #[must_use]
    pub fn truesdell(&self, deformation: &impl Deformation<T>) -> TruesdellTangent<T, Y> {
        TruesdellTangent(self.0 * deformation.jacobian().recip())
    }

    /// ∂S/∂E, the pull-back.
    ///
    /// # Accuracy
    /// 24 ulp of |F⁻¹|⁴ |c|.
    #[inline(always)]
    #[must_use]
    pub fn material(&self, deformation: &impl Deformation<T>) -> MaterialTangent<T, Y> {
        MaterialTangent(self.0.congruence(deformation.inverse_rows()))
    }
}

/// ½ (`δ_ik T_jl + δ_il T_jk + T_ik δ_jl + T_il δ_jk`): D ↦ D T + T D.
#[inline(always)]
fn stretching_terms<T: Real>(stress: &CauchyStress<T>) -> MajorSymmetric<T> {
    MajorSymmetric::symmetric_square_dyad(&stress.0, &Symmetric::identity()) * T::lit(2.0)
}

/// The terms in the storage of a tangent.
#[inline(always)]
fn stored<T: Real, Y: Symmetry>(terms: &MajorSymmetric<T>) -> Y::Tensor<T> {
    Y::Tensor::from_slots(&terms.slots())
}

/// T ⊗ 1: D ↦ T tr D.
#[inline(always)]
pub(super) fn volume_terms<T: Real>(stress: &CauchyStress<T>) -> MinorSymmetric<T> {
    MinorSymmetric::dyad(&stress.0, &Symmetric::identity())
}

impl<T: Real, Y: Symmetry> TruesdellTangent<T, Y> {
    /// c = J × this.
    #[inline(always)]
    #[must_use]
    pub fn lie(&self, deformation: &impl Deformation<T>) -> LieTangent<T, Y> {
        LieTangent(self.0 * deformation.jacobian())
    }

    /// ∂S/∂E, J times the pull-back.
    #[inline(always)]
    #[must_use]
    pub fn material(&self, deformation: &impl Deformation<T>) -> MaterialTangent<T, Y> {
        self.lie(deformation).material(deformation)
    }

    /// The tangent of Jaumann's rate of τ, over J: adds D ↦ D T + T D.
    #[inline(always)]
    #[must_use]
    pub fn jaumann(&self, stress: &CauchyStress<T>) -> JaumannTangent<T, Y> {
        JaumannTangent(self.0 + stored::<T, Y>(&stretching_terms(stress)))
    }

    /// The tangent of the lower-convected rate of τ, over J: adds twice D ↦ D T + T D.
    #[inline(always)]
    #[must_use]
    pub fn lower_convected(&self, stress: &CauchyStress<T>) -> LowerConvectedTangent<T, Y> {
        LowerConvectedTangent(self.0 + stored::<T, Y>(&(stretching_terms(stress) * T::lit(2.0))))
    }

    /// The tangent of the upper-convected rate of Cauchy's stress: less T ⊗ 1.
    #[inline(always)]
    #[must_use]
    pub fn cauchy_upper_convected(&self, stress: &CauchyStress<T>) -> CauchyUpperConvectedTangent<T> {
        CauchyUpperConvectedTangent(self.0.minor() - volume_terms(stress))
    }
}

impl<T: Real, Y: Symmetry> JaumannTangent<T, Y> {
    /// The tangent of Truesdell's rate.
    #[inline(always)]
    #[must_use]
    pub fn truesdell(&self, stress: &CauchyStress<T>) -> TruesdellTangent<T, Y> {
        TruesdellTangent(self.0 - stored::<T, Y>(&stretching_terms(stress)))
    }

    /// The tangent of Jaumann's rate of Cauchy's stress: less T ⊗ 1.
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, stress: &CauchyStress<T>) -> CauchyJaumannTangent<T> {
        CauchyJaumannTangent(self.0.minor() - volume_terms(stress))
    }
}

impl<T: Real, Y: Symmetry> LowerConvectedTangent<T, Y> {
    /// The tangent of Truesdell's rate.
    #[inline(always)]
    #[must_use]
    pub fn truesdell(&self, stress: &CauchyStress<T>) -> TruesdellTangent<T, Y> {
        TruesdellTangent(self.0 - stored::<T, Y>(&(stretching_terms(stress) * T::lit(2.0))))
    }

    /// The tangent of the lower-convected rate of Cauchy's stress: less T ⊗ 1.
    #[inline(always)]
    #[must_use]
    pub fn cauchy(&self, stress: &CauchyStress<T>) -> CauchyLowerConvectedTangent<T> {
        CauchyLowerConvectedTangent(self.0.minor() - volume_terms(stress))
    }
}

impl<T: Real> CauchyJaumannTangent<T> {
    /// The tangent of Jaumann's rate of τ, over J: with T ⊗ 1.
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, stress: &CauchyStress<T>) -> JaumannTangent<T, Minor> {
        JaumannTangent(self.0 + volume_terms(stress))
    }
}

impl<T: Real> CauchyLowerConvectedTangent<T> {
    /// The tangent of the lower-convected rate of τ, over J: with T ⊗ 1.
    #[inline(always)]
    #[must_use]
    pub fn kirchhoff(&self, stress: &CauchyStress<T>) -> LowerConvectedTangent<T, Minor> {
        LowerConvectedTangent(self.0 + volume_terms(stress))
    }
}

impl<T: Real> CauchyUpperConvectedTangent<T> {
    /// The tangent of Truesdell's rate: with T ⊗ 1.
    #[inline(always)]
    #[must_use]
    pub fn truesdell(&self, stress: &CauchyStress<T>) -> TruesdellTangent<T, Minor> {
        TruesdellTangent(self.0 + volume_terms(stress))
    }
}
