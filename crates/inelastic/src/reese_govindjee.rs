//! Reese and Govindjee's finite linear viscosity.

use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, product};

use crate::bergstrom_boyce::{check, parallel};
use crate::error::check_bound;
use crate::{Evolution, InelasticError, flow};

/// The viscoelastic solid of Reese and Govindjee: a law at rest beside a spring that flows in proportion to its stress.
///
/// ```text
/// P = P₁(F) + P₂(F Fᵢ⁻¹) Fᵢ⁻ᵀ        Ḟᵢ = Dᵢ Fᵢ,   Dᵢ = dev M/(2 η) + tr M/(9 ζ) 1
/// ```
/// Both laws may be any energy; the spring P₂ must be isotropic. The nine internal variables are Fᵢ by rows.
///
/// | symbol | parameter | unit | bounds |
/// |---|---|---|---|
/// | η | `viscosity` | Pa s | 0 < η |
/// | ζ | `bulk_viscosity` | Pa s | 0 < ζ; none: the volume does not flow, and det Fᵢ = 1 |
///
/// # Accuracy
/// That of the [`StepControl`](crate::StepControl); without ζ det Fᵢ = 1 to rounding.
///
/// # Example
/// ```
/// use piola_inelastic::ReeseGovindjee;
/// use piola_solids::NeoHookeanCiarlet;
/// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let law = ReeseGovindjee::new(spring, spring, 0.5)?.with_bulk_viscosity(2.0)?;
/// assert_eq!(law.viscosity() / 1.0, 0.5); // relaxation time η/μ, s
/// assert!(ReeseGovindjee::new(spring, spring, -1.0).is_err());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// S. Reese and S. Govindjee, Int. J. Solids Structures 35 (1998) 3455–3482.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ReeseGovindjee<A, B> {
    pub(crate) equilibrium: A,
    pub(crate) overstress: B,
    viscosity: f64,
    /// 1/ζ.
    bulk_fluidity: f64,
}

const LAW: &str = "Reese–Govindjee";

impl<A, B> ReeseGovindjee<A, B> {
    /// Of the law at rest, the spring that flows, and η, Pa s.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn new(equilibrium: A, overstress: B, viscosity: f64) -> Result<Self, InelasticError> {
        check_bound(LAW, "viscosity", viscosity, "0 < η", 0.0 < viscosity)?;
        Ok(Self { equilibrium, overstress, viscosity, bulk_fluidity: 0.0 })
    }

    /// With ζ, Pa s.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn with_bulk_viscosity(self, bulk_viscosity: f64) -> Result<Self, InelasticError> {
        check_bound(LAW, "bulk_viscosity", bulk_viscosity, "0 < ζ", 0.0 < bulk_viscosity)?;
        Ok(Self { bulk_fluidity: bulk_viscosity.recip(), ..self })
    }

    /// With 1/ζ, 1/(Pa s), as it was written; 0 for no flow of volumes.
    #[cfg(feature = "serde")]
    pub(crate) fn with_bulk_fluidity(self, bulk_fluidity: f64) -> Result<Self, InelasticError> {
        check_bound(LAW, "bulk_fluidity", bulk_fluidity, "0 ≤ 1/ζ", 0.0 <= bulk_fluidity)?;
        Ok(Self { bulk_fluidity, ..self })
    }

    /// η, Pa s.
    #[must_use]
    pub const fn viscosity(&self) -> f64 {
        self.viscosity
    }
}

impl<A: Hyperelastic, B: Hyperelastic> Evolution<9, 6> for ReeseGovindjee<A, B> {
    fn initial(&self) -> [f64; 9] {
        flow::virgin()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn residual<T: Real>(&self, from: &[T; 9], gradient: &Rows<T>, unknowns: &[T; 6], dt: f64) -> [T; 6] {
        let increment = flow::increment(unknowns);
        let stress = flow::mandel(&self.overstress, &flow::elastic(gradient, &flow::inelastic(from), &increment));
        let shape = stress.deviator() * T::lit(dt / (2.0 * self.viscosity));
        let volume = stress.spherical_part() * T::lit(dt * self.bulk_fluidity / 3.0);
        (increment - shape - volume).components
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn updated<T: Real>(&self, from: &[T; 9], _gradient: &Rows<T>, unknowns: &[T; 6], _dt: f64) -> [T; 9] {
        let after = product(flow::exponential(&flow::increment(unknowns)), flow::inelastic(from));
        flow::with_inelastic(*from, &after)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 9]) -> Rows<T> {
        parallel(&self.equilibrium, &self.overstress, gradient, state)
    }

    fn coordinates<T: Real>(&self, about: &[T; 9], state: &[T; 9]) -> [T; 9] {
        flow::coordinates(about, state)
    }

    fn at_coordinates<T: Real>(&self, about: &[T; 9], coordinates: &[T; 9]) -> [T; 9] {
        flow::at_coordinates(about, coordinates, self.bulk_fluidity <= 0.0)
    }

    fn dissipated(&self, from: &[f64; 9], gradient: &Rows<f64>, state: &[f64; 9]) -> f64 {
        flow::dissipated(&self.overstress, from, gradient, state)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 9]) -> Result<(), SolidsError> {
        check(&self.equilibrium, &self.overstress, gradient, state)
    }
}
