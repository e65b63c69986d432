//! Fluids whose stress is a function of the present density and rate of deformation.

use piola_continuum::rates::VelocityGradient;
use piola_continuum::{CauchyStress, Symmetric};
use piola_numerics::Real;

use super::EulerianFluid;
use crate::error::check_finite;
use crate::{FluidsError, ReinerRivlinCoefficients};

/// A fluid whose stress is a function of its present density and rate of deformation (Stokes; Reiner; Rivlin).
///
/// ```text
/// T = γ₀ 1 + γ₁ D + γ₂ D²      γ functions of ρ and of I, II, III of D
/// at rest T = γ₀(ρ, 0, 0, 0) 1 = −p(ρ) 1
/// ```
/// | symbol | method | unit |
/// |---|---|---|
/// | γ₀, γ₁, γ₂ | [`coefficients`](Self::coefficients) | Pa, Pa s, Pa s² |
/// | p(ρ) | [`pressure_at_rest`](Self::pressure_at_rest) | Pa |
/// | T | [`cauchy`](Self::cauchy) | Pa |
/// | (T + p(ρ) 1) : D | [`dissipation`](Self::dissipation) | W/m³ |
///
/// No frame-indifferent function of ρ and D is more general. Newtonian fluids are those with γ₁ constant, γ₀ linear in I and γ₂ = 0,
/// [Eulerian](EulerianFluid) ones those with γ₁ = γ₂ = 0. The least powers of D that a value needs, and whether a function is of this
/// form, are found by [`representation`](piola_tensor::spectral::representation).
///
/// # Example
/// A gas whose viscosity rises with its density:
/// ```
/// use piola_continuum::rates::VelocityGradient;
/// use piola_fluids::StokesianFluid;
/// use piola_numerics::Real;
/// struct Gas;
/// impl StokesianFluid for Gas {
///     fn coefficients<T: Real>(&self, density: T, [first, _, _]: [T; 3]) -> [T; 3] {
///         let viscosity = T::lit(0.25) * density;
///         [T::lit(-8.0) * density - viscosity * first, viscosity + viscosity, T::zero()]
///     }
/// }
/// let shear = VelocityGradient::from_rows([[0.0; 3], [3.0, 0.0, 0.0], [0.0; 3]])?;
/// assert_eq!(Gas.cauchy(2.0, &shear).0.components, [-16.0, -16.0, -16.0, 1.5, 0.0, 0.0]);
/// assert_eq!(Gas.dissipation(2.0, &shear), 4.5); // μ k²
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # Source
/// W(19.21), W(19.22), W(19.33–19.34).
pub trait StokesianFluid {
    /// γ₀, γ₁, γ₂ at the density ρ, kg/m³, and the invariants I = tr D, II = ½ (I² − D : D), III = det D.
    #[must_use]
    fn coefficients<T: Real>(&self, density: T, invariants: [T; 3]) -> [T; 3];

    /// p(ρ) = −γ₀(ρ, 0, 0, 0), Pa: the pressure of the fluid at rest.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn pressure_at_rest<T: Real>(&self, density: T) -> T {
        -self.coefficients(density, [T::zero(); 3])[0]
    }

    /// T, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn cauchy<T: Real>(&self, density: T, velocity_gradient: &VelocityGradient<T>) -> CauchyStress<T> {
        let d = velocity_gradient.rate_of_deformation().0;
        let [zeroth, first, second] = self.coefficients(density, invariants(&d));
        CauchyStress(Symmetric::identity() * zeroth + d * first + d.square() * second)
    }

    /// (T + p(ρ) 1) : D, W/m³: the power turned into heat. No fluid exists for which it is negative in some motion.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn dissipation<T: Real>(&self, density: T, velocity_gradient: &VelocityGradient<T>) -> T {
        let viscous =
            self.cauchy(density, velocity_gradient).0 + Symmetric::identity() * self.pressure_at_rest(density);
        viscous.double_contraction(&velocity_gradient.rate_of_deformation().0)
    }
}

/// I, II, III of D.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn invariants<T: Real>(d: &Symmetric<T>) -> [T; 3] {
    let trace = d.trace();
    [trace, T::lit(0.5) * (trace * trace - d.double_contraction(d)), d.determinant()]
}

/// The compressible fluid of Reiner and Rivlin: an equation of state, a viscosity of volume changes, and the coefficients of a
/// [`ReinerRivlin`](crate::ReinerRivlin) fluid.
///
/// ```text
/// T = (−p(ρ) + λ tr D) 1 + g₁ D + g₂ D²
/// ```
/// | symbol | parameter | unit |
/// |---|---|---|
/// | p(ρ) | `state` | Pa |
/// | λ | `second_viscosity` | Pa s |
/// | g₁, g₂ | `coefficients`, functions of I, II, III of D | Pa s, Pa s² |
///
/// # Accuracy
/// 4 ulp of each term.
///
/// # Example
/// ```
/// use piola_continuum::rates::VelocityGradient;
/// use piola_fluids::{CompressibleReinerRivlin, ConstantCoefficients, Polytropic, StokesianFluid};
/// let state = Polytropic::new(1000.0, 1.25, 2.0)?;
/// let fluid = CompressibleReinerRivlin::new(state, 0.5, ConstantCoefficients::new(2.0, 0.25)?)?;
/// // At rest the stress is that of the Eulerian fluid.
/// assert_eq!(fluid.pressure_at_rest(2.5), 4000.0);
/// // Expansion along 1 at the rate 2: −4000 + 0.5·2 + 2·2 + 0.25·4.
/// let expansion = VelocityGradient::from_rows([[2.0, 0.0, 0.0], [0.0; 3], [0.0; 3]])?;
/// assert_eq!(fluid.cauchy(2.5, &expansion).0.components[0], -3994.0);
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// W(19.21).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompressibleReinerRivlin<E, C> {
    state: E,
    second_viscosity: f64,
    coefficients: C,
}

impl<E: EulerianFluid, C: ReinerRivlinCoefficients> CompressibleReinerRivlin<E, C> {
    /// Of an equation of state, λ, and g₁ and g₂.
    ///
    /// # Errors
    /// [`FluidsError::NotFinite`].
    pub fn new(state: E, second_viscosity: f64, coefficients: C) -> Result<Self, FluidsError> {
        check_finite("compressible Reiner-Rivlin", "second_viscosity", second_viscosity)?;
        Ok(Self { state, second_viscosity, coefficients })
    }

    /// The equation of state.
    #[must_use]
    pub const fn state(&self) -> &E {
        &self.state
    }

    /// λ, Pa s.
    #[must_use]
    pub const fn second_viscosity(&self) -> f64 {
        self.second_viscosity
    }
}

impl<E: EulerianFluid, C: ReinerRivlinCoefficients> StokesianFluid for CompressibleReinerRivlin<E, C> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn coefficients<T: Real>(&self, density: T, invariants: [T; 3]) -> [T; 3] {
        let isotropic = T::lit(self.second_viscosity) * invariants[0] - self.state.pressure(density);
        [isotropic, self.coefficients.first(invariants), self.coefficients.second(invariants)]
    }
}
