//! ∂S/∂E to and from the spatial tangents, and those to and from one another.

use piola_numerics::Real;
use piola_tensor::{MajorSymmetric, Minor, MinorSymmetric, PairSymmetric, Symmetry};

use super::{FirstPiolaTangent, JaumannTangent, LieTangent, MaterialTangent, TruesdellTangent, kernels};
use crate::{CauchyStress, Deformation, SecondPiola};

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
    /// c/J = `F_jA F_lB A_iAkB/J − δ_ik T_jl`, without F⁻¹.
    ///
    /// The mean over the exchange of k and l is returned: the answer to symmetric D. The exchange of i and j leaves it as it is where the
    /// stress is symmetric.
    ///
    /// # Accuracy
    /// 8 ulp of |F|² |A|/J + |T|.
    ///
    /// # Example
    /// ```
    /// use piola_continuum::stress::tangents::MaterialTangent;
    /// use piola_continuum::{DeformationGradient, SecondPiola};
    /// use piola_tensor::{MajorSymmetric, PairSymmetric, Symmetric};
    /// let bar = DeformationGradient::diagonal([2.0, 1.0, 1.0])?;
    /// let stress = SecondPiola(Symmetric::identity());
    /// let material: MaterialTangent<f64> = MaterialTangent(MajorSymmetric::isotropic(1.0, 2.0));
    /// let first_piola = material.first_piola(&stress, &bar);
    /// let cauchy = stress.kirchhoff(&bar).cauchy(&bar);
    /// assert_eq!(first_piola.spatial(&cauchy, &bar).0.entry(0, 0, 0, 0), 40.0); // F₁₁⁴ (λ + 2 μ)/J
    /// # Ok::<(), piola_continuum::ContinuumError>(())
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn spatial(&self, stress: &CauchyStress<T>, deformation: &impl Deformation<T>) -> TruesdellTangent<T, Minor> {
        let (f, volume) = (deformation.gradient_rows(), deformation.jacobian());
        TruesdellTangent(MinorSymmetric {
            components: kernels::spatial_tangent(f, volume, &stress.0, &self.0.components),
        })
    }

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
///
/// ```text
///       11    22    33    12             23             13
/// 11  2 T₁₁   0     0    T₁₂             0             T₁₃
/// 22        2 T₂₂   0    T₁₂            T₂₃             0
/// 33              2 T₃₃   0             T₂₃            T₁₃
/// 12                  ½(T₁₁ + T₂₂)     ½ T₁₃          ½ T₂₃
/// 23                               ½(T₂₂ + T₃₃)       ½ T₁₂
/// 13                                             ½(T₁₁ + T₃₃)
/// ```
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn stretching_terms<T: Real>(stress: &CauchyStress<T>) -> MajorSymmetric<T> {
    let (half, zero) = (T::lit(0.5), T::zero());
    let [a, b, c, d, e, f] = stress.0.components;
    MajorSymmetric {
        components: [
            a + a,
            zero,
            zero,
            d,
            zero,
            f,
            b + b,
            zero,
            d,
            e,
            zero,
            c + c,
            zero,
            e,
            f,
            half * (a + b),
            half * f,
            half * e,
            half * (b + c),
            half * d,
            half * (a + c),
        ],
    }
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
