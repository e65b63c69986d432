//! Any law as an incompressible solid, with a pressure that is given.

use piola_continuum::stress::tangents::FirstPiolaTangent;
use piola_continuum::{CauchyStress, Deformation, FirstPiola, KirchhoffStress, Symmetric};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::from_rows;

use super::Hyperelastic;
use super::incompressible::check_volume;
use crate::SolidsError;
use crate::error::check_finite;

const LAW: &str = "pressurised solid";

/// An incompressible solid of any law, its pressure given.
///
/// ```text
/// T = T_law − p 1,   det F = 1        P = P_law − p Cof F        W = W_law − p (J − 1)
/// ```
/// `T_law` is all that the law answers. What it says of volumes has nothing to do at det F = 1: Ogden's, Hencky's, Fung's
/// or a fibre-reinforced law of any bulk modulus becomes the incompressible one. The reference is as free of stress as that
/// of the law where p = 0. To have p from a condition such as a free face see
/// `piola_specimens::homogeneous::equilibrium` and `piola_specimens::homogeneous::IncompressibleState`.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | p | `pressure`, beyond the one that the law has | Pa | finite |
///
/// # Accuracy
/// That of the law and a few ulp of p; P, S, τ relative 1e-13 down to ∇u = 1e-16 at p = 0 where the law has that.
///
/// # Errors
/// `check` refuses 1e-6 ≤ |J − 1| and what the law refuses.
///
/// # Example
/// ```
/// use piola_solids::{Hencky, Hyperelastic, Pressurised};
/// use piola_continuum::DeformationGradient;
/// // T = 2 μ ln V − p 1; the first parameter of Hencky's law, λ, says nothing at det F = 1.
/// let steel = Pressurised::new(Hencky::new(3.0, 1.0)?);
/// let stretch = DeformationGradient::diagonal([2.0, 0.5, 1.0])?;
/// let stress: f64 = steel.at_pressure(0.5)?.cauchy(&stretch).0.components[0];
/// assert!((stress - (2.0 * 2.0_f64.ln() - 0.5)).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(21.20).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Written<L>"))]
pub struct Pressurised<L> {
    law: L,
    pressure: f64,
}

impl<L> Pressurised<L> {
    /// At p = 0.
    #[must_use]
    pub const fn new(law: L) -> Self {
        Self { law, pressure: 0.0 }
    }

    /// At the pressure p, Pa.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn at_pressure(self, pressure: f64) -> Result<Self, SolidsError> {
        check_finite(LAW, "p", pressure)?;
        Ok(Self { pressure, ..self })
    }

    /// The law.
    #[must_use]
    pub const fn law(&self) -> &L {
        &self.law
    }

    /// p, Pa.
    #[must_use]
    pub const fn pressure(&self) -> f64 {
        self.pressure
    }
}

impl<L: Hyperelastic> Pressurised<L> {
    /// `P_law` − p Cof F.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn pressed<T: Real>(&self, stress: FirstPiola<T>, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        let p = T::lit(self.pressure);
        FirstPiola(stress.0 - from_rows(deformation.cofactor_rows()).map(|x| x * p))
    }

    /// `W_law` − p (J − 1).
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn worked<T: Real>(&self, energy: T, deformation: &impl Deformation<T>) -> T {
        energy - T::lit(self.pressure) * deformation.volume_change()
    }

    /// `A_law` − p ∂ Cof F/∂F, ∂ Cofᵢⱼ/∂Fₖₗ = εᵢₖₘ εⱼₗₙ Fₘₙ.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn stiffened<T: Real>(
        &self,
        mut tangent: FirstPiolaTangent<T>,
        deformation: &impl Deformation<T>,
    ) -> FirstPiolaTangent<T> {
        let f = deformation.gradient_rows();
        let p = T::lit(self.pressure);
        for (row, entries) in tangent.0.components.iter_mut().enumerate() {
            for (column, entry) in entries.iter_mut().enumerate() {
                let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
                if i == k || j == l {
                    continue;
                }
                let term = p * f[3 - i - k][3 - j - l];
                // ε is 1 where the second index follows the first in turn.
                let even = ((k + 3 - i) % 3 == 1) == ((l + 3 - j) % 3 == 1);
                *entry -= if even { term } else { -term };
            }
        }
        tangent
    }
}

impl<L: Hyperelastic> Hyperelastic for Pressurised<L> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.worked(self.law.energy(deformation), deformation)
    }

    fn reference_energy(&self) -> f64 {
        self.law.reference_energy()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check<T: Real>(&self, deformation: &impl Deformation<T>) -> Result<(), SolidsError> {
        check_volume(LAW, deformation)?;
        self.law.check(deformation)
    }

    fn is_incompressible(&self) -> bool {
        true
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.pressed(self.law.first_piola(deformation), deformation)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_and_first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> (T, FirstPiola<T>) {
        let (energy, stress) = self.law.energy_and_first_piola(deformation);
        (self.worked(energy, deformation), self.pressed(stress, deformation))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy_first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (T, FirstPiola<T>, FirstPiolaTangent<T>) {
        let (energy, stress, tangent) = self.law.energy_first_piola_and_tangent(deformation);
        let (stress, tangent) = (self.pressed(stress, deformation), self.stiffened(tangent, deformation));
        (self.worked(energy, deformation), stress, tangent)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn kirchhoff<T: Real>(&self, deformation: &impl Deformation<T>) -> KirchhoffStress<T> {
        let mean = Symmetric::identity() * (T::lit(self.pressure) * deformation.jacobian());
        KirchhoffStress(self.law.kirchhoff(deformation).0 - mean)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn cauchy<T: Real>(&self, deformation: &impl Deformation<T>) -> CauchyStress<T> {
        CauchyStress(self.law.cauchy(deformation).0 - Symmetric::identity() * T::lit(self.pressure))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_tangent<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiolaTangent<T> {
        self.stiffened(self.law.first_piola_tangent(deformation), deformation)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola_and_tangent<T: Real>(
        &self,
        deformation: &impl Deformation<T>,
    ) -> (FirstPiola<T>, FirstPiolaTangent<T>) {
        let (stress, tangent) = self.law.first_piola_and_tangent(deformation);
        (self.pressed(stress, deformation), self.stiffened(tangent, deformation))
    }
}

/// The solid as it is written.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Written<L> {
    law: L,
    #[serde(default)]
    pressure: f64,
}

#[cfg(feature = "serde")]
impl<L> TryFrom<Written<L>> for Pressurised<L> {
    type Error = SolidsError;

    fn try_from(Written { law, pressure }: Written<L>) -> Result<Self, SolidsError> {
        Self::new(law).at_pressure(pressure)
    }
}
