//! Bergström and Boyce's elastomer.

use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};
use piola_tensor::internal::rows::{Rows, product, sum};

use crate::error::check_bound;
use crate::{Evolution, InelasticError, flow};

/// The flow of Bergström and Boyce: a power of the stress, slowed down by the flow so far.
///
/// ```text
/// Dᵢ = γ̇ dev M/τ        γ̇ = γ̇₀ (λ̄ᵢ − 1 + ξ)^c (τ/τ₀)^m        τ = |dev M|,   λ̄ᵢ = √(tr(Fᵢᵀ Fᵢ)/3)
/// ```
///
/// | symbol | field | unit | bounds |
/// |---|---|---|---|
/// | γ̇₀ | `rate` | 1/s | 0 < γ̇₀ |
/// | τ₀ | `stress` | Pa | 0 < τ₀ |
/// | m | `stress_exponent` | – | 1 ≤ m |
/// | c | `stretch_exponent` | – | −1 ≤ c ≤ 0 |
/// | ξ | `perturbation` | – | 0 < ξ |
///
/// # Example
/// ```
/// use piola_inelastic::PowerFlow;
/// let flow = PowerFlow { rate: 1.0, stress: 1.0, stress_exponent: 4.0, stretch_exponent: -0.8, perturbation: 0.01 };
/// assert!(flow.checked().is_ok());
/// assert!(PowerFlow { stretch_exponent: 0.5, ..flow }.checked().is_err());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PowerFlow {
    /// γ̇₀, 1/s.
    pub rate: f64,
    /// τ₀, Pa.
    pub stress: f64,
    /// m.
    pub stress_exponent: f64,
    /// c.
    pub stretch_exponent: f64,
    /// ξ, which makes the first flow finite.
    pub perturbation: f64,
}

const LAW: &str = "Bergström–Boyce";

impl PowerFlow {
    /// The same, if within its bounds.
    ///
    /// # Errors
    /// [`InelasticError::NotFinite`], [`InelasticError::OutOfBounds`].
    pub fn checked(self) -> Result<Self, InelasticError> {
        check_bound(LAW, "rate", self.rate, "0 < rate", 0.0 < self.rate)?;
        check_bound(LAW, "stress", self.stress, "0 < stress", 0.0 < self.stress)?;
        let exponent = self.stress_exponent;
        check_bound(LAW, "stress_exponent", exponent, "1 ≤ stress exponent", 1.0 <= exponent)?;
        let exponent = self.stretch_exponent;
        let holds = (-1.0..=0.0).contains(&exponent);
        check_bound(LAW, "stretch_exponent", exponent, "−1 ≤ stretch exponent ≤ 0", holds)?;
        check_bound(LAW, "perturbation", self.perturbation, "0 < perturbation", 0.0 < self.perturbation)?;
        Ok(self)
    }
}

/// The viscoelastic solid of Bergström and Boyce: a law at rest beside a spring that flows.
///
/// ```text
/// P = P₁(F) + P₂(F Fᵢ⁻¹) Fᵢ⁻ᵀ        Ḟᵢ = Dᵢ Fᵢ, Dᵢ of the flow, det Fᵢ = 1
/// ```
/// Both laws may be any energy; the spring P₂ must be isotropic. The nine internal variables are Fᵢ by rows.
///
/// # Accuracy
/// That of the [`StepControl`](crate::StepControl); det Fᵢ = 1 to rounding.
///
/// # Example
/// Held for long, only the law at rest bears the shear.
/// ```
/// use piola_continuum::DeformationGradient;
/// use piola_inelastic::{BergstromBoyce, StepControl, InelasticPoint, PowerFlow};
/// use piola_solids::NeoHookeanCiarlet;
/// let flow = PowerFlow { rate: 5.0, stress: 1.0, stress_exponent: 1.0, stretch_exponent: 0.0, perturbation: 0.01 };
/// let spring = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
/// let law = BergstromBoyce::new(spring, spring, flow)?;
/// let mut point = InelasticPoint::new(&law);
/// let shear = DeformationGradient::simple_shear(0.3)?;
/// let stress = point.advance(&shear, 5.0, &StepControl::new(1e-4)?)?.first_piola.0[(0, 1)];
/// assert!((stress - 0.3).abs() < 2e-2); // μ k, and what the last of the motion adds
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// J. S. Bergström and M. C. Boyce, J. Mech. Phys. Solids 46 (1998) 931–954.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BergstromBoyce<A, B> {
    pub(crate) equilibrium: A,
    pub(crate) overstress: B,
    flow: PowerFlow,
}

impl<A: Hyperelastic, B: Hyperelastic> BergstromBoyce<A, B> {
    /// Of the law at rest, the spring that flows, and its flow.
    ///
    /// # Errors
    /// Those of [`PowerFlow::checked`].
    pub fn new(equilibrium: A, overstress: B, flow: PowerFlow) -> Result<Self, InelasticError> {
        Ok(Self { equilibrium, overstress, flow: flow.checked()? })
    }
}

impl<A: Hyperelastic, B: Hyperelastic> Evolution<9, 6> for BergstromBoyce<A, B> {
    fn initial(&self) -> [f64; 9] {
        flow::virgin()
    }

    fn residual<T: Real>(&self, from: &[T; 9], gradient: &Rows<T>, unknowns: &[T; 6], dt: f64) -> [T; 6] {
        let flow = &self.flow;
        let (before, increment) = (flow::inelastic(from), flow::increment(unknowns));
        let stress = flow::mandel(&self.overstress, &flow::elastic(gradient, &before, &increment)).deviator();
        let after = product(flow::exponential(&increment), before);
        let stretch = (flow::trace_of_square(&after) * T::lit(1.0 / 3.0)).sqrt() - T::lit(1.0 - flow.perturbation);
        // γ̇/τ = γ̇₀ (…)^c (τ²/τ₀²)^((m − 1)/2)/τ₀.
        let square = flow::square(&stress, flow.stress) * T::lit(1.0 / (flow.stress * flow.stress));
        let rate = T::lit(dt * flow.rate / flow.stress)
            * stretch.powf(T::lit(flow.stretch_exponent))
            * square.powf(T::lit(0.5 * (flow.stress_exponent - 1.0)));
        (increment - stress * rate).components
    }

    fn updated<T: Real>(&self, from: &[T; 9], _gradient: &Rows<T>, unknowns: &[T; 6], _dt: f64) -> [T; 9] {
        let after = product(flow::exponential(&flow::increment(unknowns)), flow::inelastic(from));
        flow::with_inelastic(*from, &after)
    }

    fn first_piola<T: Real>(&self, gradient: &Rows<T>, state: &[T; 9]) -> Rows<T> {
        parallel(&self.equilibrium, &self.overstress, gradient, state)
    }

    fn coordinates<T: Real>(&self, about: &[T; 9], state: &[T; 9]) -> [T; 9] {
        flow::coordinates(about, state)
    }

    fn at_coordinates<T: Real>(&self, about: &[T; 9], coordinates: &[T; 9]) -> [T; 9] {
        flow::at_coordinates(about, coordinates, true)
    }

    fn dissipated(&self, from: &[f64; 9], gradient: &Rows<f64>, state: &[f64; 9]) -> f64 {
        flow::dissipated(&self.overstress, from, gradient, state)
    }

    fn check(&self, gradient: &Rows<f64>, state: &[f64; 9]) -> Result<(), SolidsError> {
        check(&self.equilibrium, &self.overstress, gradient, state)
    }
}

/// The stress of a law at rest beside a spring behind Fᵢ.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn parallel<T: Real, A: Hyperelastic, B: Hyperelastic>(
    equilibrium: &A,
    overstress: &B,
    gradient: &Rows<T>,
    state: &[T; 9],
) -> Rows<T> {
    let rest = equilibrium.first_piola(&piola_continuum::DeformationGradient::trusted(*gradient));
    let rest = piola_numerics::linear::matrix3::rows_of(&rest.0);
    sum(rest, flow::first_piola(overstress, gradient, &flow::inelastic(state)))
}

/// Refuses what one of the two laws does.
pub(crate) fn check<A: Hyperelastic, B: Hyperelastic>(
    equilibrium: &A,
    overstress: &B,
    gradient: &Rows<f64>,
    state: &[f64; 9],
) -> Result<(), SolidsError> {
    use piola_continuum::DeformationGradient;
    equilibrium.check(&DeformationGradient::trusted(*gradient))?;
    let nothing = piola_continuum::Symmetric::zero();
    overstress.check(&DeformationGradient::trusted(flow::elastic(gradient, &flow::inelastic(state), &nothing)))
}
