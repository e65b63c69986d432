//! ∂S/∂E to and from the spatial tangents, and those to and from one another.

use piola_numerics::Real;
use piola_tensor::{MajorSymmetric, Minor, PairSymmetric, Symmetry};

use super::{FirstPiolaTangent, JaumannTangent, LieTangent, MaterialTangent, TruesdellTangent};
use crate::{CauchyStress, Deformation, SecondPiola, Symmetric};

impl<T: Real, Y: Symmetry> MaterialTangent<T, Y> {
    /// c = `F_iA F_jB F_kC F_lD C_ABCD`, the push-forward.
    ///
    /// # Accuracy
    /// 24 ulp of |F|⁴ |C|.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn lie(&self, deformation: &impl Deformation<T>) -> LieTangent<T, Y> {
        LieTangent(self.0.congruence(deformation.gradient_rows()))
    }

    /// c/J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn truesdell(&self, deformation: &impl Deformation<T>) -> TruesdellTangent<T, Y> {
        self.lie(deformation).truesdell(deformation)
    }
}

impl<T: Real> FirstPiolaTangent<T> {
    /// c/J of ∂P/∂F, by way of ∂S/∂E.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn truesdell(&self, stress: &SecondPiola<T>, deformation: &impl Deformation<T>) -> TruesdellTangent<T, Minor> {
        self.material(stress, deformation).truesdell(deformation)
    }
}

impl<T: Real, Y: Symmetry> LieTangent<T, Y> {
    /// c/J.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn truesdell(&self, deformation: &impl Deformation<T>) -> TruesdellTangent<T, Y> {
        TruesdellTangent(self.0 * deformation.jacobian().recip())
    }

    /// ∂S/∂E, the pull-back.
    ///
    /// # Accuracy
    /// 24 ulp of |F⁻¹|⁴ |c|.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material(&self, deformation: &impl Deformation<T>) -> MaterialTangent<T, Y> {
        MaterialTangent(self.0.congruence(deformation.inverse_rows()))
    }
}

/// ½ (`δ_ik T_jl + δ_il T_jk + T_ik δ_jl + T_il δ_jk`): D ↦ D T + T D.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn stretching_terms<T: Real>(stress: &CauchyStress<T>) -> MajorSymmetric<T> {
    MajorSymmetric::symmetric_square_dyad(&stress.0, &Symmetric::identity()) * T::lit(2.0)
}

/// The terms in the storage of a tangent.
#[cfg_attr(not(debug_assertions), inline(always))]
fn stored<T: Real, Y: Symmetry>(terms: &MajorSymmetric<T>) -> Y::Tensor<T> {
    Y::Tensor::from_slots(&terms.slots())
}

impl<T: Real, Y: Symmetry> TruesdellTangent<T, Y> {
    /// c = J × this.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn lie(&self, deformation: &impl Deformation<T>) -> LieTangent<T, Y> {
        LieTangent(self.0 * deformation.jacobian())
    }

    /// ∂S/∂E, J times the pull-back.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn material(&self, deformation: &impl Deformation<T>) -> MaterialTangent<T, Y> {
        self.lie(deformation).material(deformation)
    }

    /// The tangent of Jaumann's rate of τ, over J: adds D ↦ D T + T D.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn jaumann(&self, stress: &CauchyStress<T>) -> JaumannTangent<T, Y> {
        JaumannTangent(self.0 + stored::<T, Y>(&stretching_terms(stress)))
    }
}

impl<T: Real, Y: Symmetry> JaumannTangent<T, Y> {
    /// The tangent of Truesdell's rate.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn truesdell(&self, stress: &CauchyStress<T>) -> TruesdellTangent<T, Y> {
        TruesdellTangent(self.0 - stored::<T, Y>(&stretching_terms(stress)))
    }
}
