//! The viscometric functions of a fluid, and the shear rate at a shear stress.

use piola_numerics::{Dual, Mask, Real};

use crate::FluidsError;

/// Moments of the shear rate between two shear stresses, ∫ sᵖ ζ(s) ds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FlowMoment {
    /// ∫ ζ(s)/s ds: differences of angular velocity.
    Reciprocal,
    /// ∫ ζ(s) ds: velocities.
    Zeroth,
    /// ∫ s ζ(s) ds: the discharge of a channel.
    First,
    /// ∫ s² ζ(s) ds: the discharge of a pipe.
    Second,
}

impl FlowMoment {
    /// The exponent p of sᵖ.
    #[must_use]
    pub const fn power(self) -> i32 {
        match self {
            Self::Reciprocal => -1,
            Self::Zeroth => 0,
            Self::First => 1,
            Self::Second => 2,
        }
    }
}

/// A fluid in simple shear at a steady rate.
///
/// ```text
/// T₁₂ = τ(k) = −τ(−k)      σ₁(k) = T₁₁ − T₃₃ = σ₁(−k)      σ₂(k) = T₂₂ − T₃₃ = σ₂(−k)      ζ = τ⁻¹
/// ```
///
/// | symbol | method | unit |
/// |---|---|---|
/// | k | `shear_rate` | 1/s |
/// | τ | [`shear_stress`](Self::shear_stress) | Pa |
/// | τ/k | [`viscosity`](Self::viscosity) | Pa s |
/// | σ₁, σ₂ | [`sigma1`](Self::sigma1), [`sigma2`](Self::sigma2) | Pa |
/// | ζ | [`shear_rate`](Self::shear_rate) | 1/s |
///
/// # Example
/// A fluid of one's own, from its shear stress alone:
/// ```
/// use piola_fluids::ViscometricFluid;
/// use piola_numerics::{Dual, Real};
///
/// struct Thickening { viscosity: f64, time: f64 }
/// impl ViscometricFluid for Thickening {
///     const NAME: &'static str = "thickening";
///     fn shear_stress<T: Real>(&self, k: T) -> T {
///         let beyond = T::lit(self.time) * k;
///         T::lit(self.viscosity) * k * (T::one() + beyond * beyond)
///     }
/// }
/// let fluid = Thickening { viscosity: 2.0, time: 0.5 };
/// assert_eq!(fluid.shear_stress(2.0), 8.0);
/// assert_eq!(fluid.shear_rate(-8.0)?, -2.0);
/// assert_eq!(fluid.shear_rate(Dual::variable(8.0))?.tangent, 1.0 / 8.0); // 1/τ′ = 1/(2 + 1.5 k²)
/// # Ok::<(), piola_fluids::FluidsError>(())
/// ```
///
/// # Source
/// W(23.13)–W(23.24).
pub trait ViscometricFluid {
    /// The fluid's name in errors.
    const NAME: &'static str;
    /// Whether a normal stress difference can differ from zero; where none can, none is computed.
    const NORMAL_STRESSES: bool = false;
    /// Whether [`shear_rate`](Self::shear_rate) is a closed form: quadrature then goes by stresses.
    const CLOSED_RATE: bool = false;

    /// τ, Pa, at a shear rate k, 1/s: odd in k, zero at rest. For a fluid with a yield stress its limit from above
    /// (below) where k > 0 (k < 0).
    #[must_use]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T;

    /// σ₁ = T₁₁ − T₃₃, Pa: the second normal stress difference N₂.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn sigma1<T: Real>(&self, shear_rate: T) -> T {
        let _ = shear_rate;
        T::zero()
    }

    /// σ₂ = T₂₂ − T₃₃, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn sigma2<T: Real>(&self, shear_rate: T) -> T {
        let _ = shear_rate;
        T::zero()
    }

    /// The stress below which the fluid is at rest, Pa; zero for most.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn yield_stress(&self) -> f64 {
        0.0
    }

    /// N₁ = T₂₂ − T₁₁ = σ₂ − σ₁, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn first_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        self.sigma2(shear_rate) - self.sigma1(shear_rate)
    }

    /// N₂ = T₁₁ − T₃₃ = σ₁, Pa.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn second_normal_stress_difference<T: Real>(&self, shear_rate: T) -> T {
        self.sigma1(shear_rate)
    }

    /// τ/k, Pa s; at rest its limit τ′(0), which is infinite where the formula's derivative is.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        let rest = shear_rate.abs().at_most(T::zero());
        if !rest.any() {
            return self.shear_stress(shear_rate) / shear_rate;
        }
        let limit = self.shear_stress(Dual::variable(T::zero())).tangent;
        let moving = T::select(rest, T::one(), shear_rate);
        T::select(rest, limit, self.shear_stress(moving) / moving)
    }

    /// ζ = τ⁻¹: the shear rate, 1/s, at a shear stress, Pa; zero up to the yield stress.
    ///
    /// Unless a fluid gives a closed form it is found by Newton's method on ln τ over ln k within a bracket that
    /// shrinks, by halves where the steps do not, to the rounding of τ; derivatives and lanes are carried.
    ///
    /// # Errors
    /// [`FluidsError::NoShearRate`] where no rate has this stress, or τ does not grow there.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        rate_at_stress(self, shear_stress)
    }

    /// ∫ sᵖ ζ(s) ds from `from` to `to` (0 ≤ from ≤ to, Pa) in closed form, where the fluid has one that keeps its digits;
    /// `None` leaves it to quadrature.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let _ = (moment, from, to);
        None
    }
}

/// The step of ln k after which Newton's method has half of the digits: the last steps are those in k itself.
const NEAR: f64 = 1e-9;

/// ln k beyond which no rate is sought.
const FARTHEST: f64 = 690.0;

/// The rate at which τ is `stress`.
pub(crate) fn rate_at_stress<F: ViscometricFluid + ?Sized, T: Real>(fluid: &F, stress: T) -> Result<T, FluidsError> {
    let wanted = stress.frozen();
    let size = wanted.abs();
    if !size.is_finite().all() {
        return Err(refusal::<F, T>(T::select(size.is_finite(), T::zero(), size), size));
    }
    let flows = T::lit(fluid.yield_stress()).less_than(size);
    if !flows.any() {
        return Ok(stress * T::zero());
    }
    // Where nothing flows any rate serves: that of the yield stress and something.
    let size = T::select(flows, size, T::lit(2.0 * fluid.yield_stress() + 1.0));
    let target = size.ln();
    let (mut low, mut high) = (T::lit(-FARTHEST), T::lit(FARTHEST));
    let mut x = T::zero();
    let mut before = T::lit(2.0 * FARTHEST);
    for _ in 0..200 {
        let at = fluid.shear_stress(Dual { value: x.exp(), tangent: x.exp() });
        let excess = at.value.ln() - target;
        let below = excess.less_than(T::zero());
        low = T::select(below, x, low);
        high = T::select(below, high, x);
        let step = excess * at.value / at.tangent;
        let newton = x - step;
        // Steps that do not become half as long may go to and fro across a bend for ever.
        let shrinks = (T::lit(2.0) * step.abs()).at_most(before);
        let inside = low.at_most(newton) & newton.at_most(high) & shrinks;
        let next = T::select(inside, newton, T::lit(0.5) * (low + high));
        before = (next - x).abs();
        let settled = before.at_most(T::lit(NEAR));
        x = next;
        if (settled | !flows).all() {
            break;
        }
    }
    // What the logarithm rounded off is made good; derivatives enter one order a step.
    let mut rate = x.exp();
    let size = T::select(stress.less_than(T::zero()), -stress, stress);
    let size = T::select(flows, size, T::lit(2.0 * fluid.yield_stress() + 1.0));
    for _ in 0..=T::ORDER + 1 {
        let at = fluid.shear_stress(Dual { value: rate.frozen(), tangent: T::one() });
        let excess = fluid.shear_stress(rate) - size;
        let step = excess / at.tangent;
        rate -= T::select(step.is_finite(), step, T::zero());
    }
    let residual = (fluid.shear_stress(rate.frozen()) - size.frozen()).abs();
    let slope = fluid.shear_stress(Dual { value: rate.frozen(), tangent: T::one() }).tangent;
    let exact = residual.at_most(T::lit(1e-12) * size.frozen()) & rate.is_finite() & T::zero().less_than(slope);
    if !(exact | !flows).all() {
        return Err(refusal::<F, T>(T::select(exact | !flows, T::zero(), wanted.abs()), residual));
    }
    let signed = T::select(stress.less_than(T::zero()), -rate, rate);
    Ok(T::select(flows, signed, stress * T::zero()))
}

/// The error of the first lane that has no rate.
fn refusal<F: ViscometricFluid + ?Sized, T: Real>(size: T, residual: T) -> FluidsError {
    let lane = (0..T::LANES).find(|&lane| size.primal(lane).abs() > 0.0 || !size.primal(lane).is_finite()).unwrap_or(0);
    FluidsError::NoShearRate { fluid: F::NAME, stress: size.primal(lane), residual: residual.primal(lane) }
}
