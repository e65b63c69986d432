//! The scales of Seth and Hill: how a strain counts a principal stretch.

use piola_numerics::{Mask, Real};
use piola_tensor::spectral::{IsotropicFunction, Logarithm, Power};

use crate::ContinuumError;
use crate::error::check_finite;

/// The scale (λᵐ − 1)/m of a stretch λ, with its limit ln λ for m → 0.
///
/// ```text
/// m = 2  Green      1  Biot      0  Hencky      −1  (1 − λ⁻¹)      −2  Almansi
/// ```
///
/// As an [`IsotropicFunction`] it acts on U or V; [`of_metric`](Self::of_metric) is the same scale as a function of λ²,
/// to act on C or B.
///
/// # Accuracy
/// 4 ulp of (λᵐ − 1)/m, also for λ → 1 and for m → 0.
///
/// # Example
/// ```
/// use piola_tensor::spectral::IsotropicFunction;
/// use piola_continuum::strain::SethHill;
/// assert_eq!(SethHill::new(3.0)?.value(2.0), 7.0 / 3.0);
/// assert_eq!(SethHill::HENCKY.value(2.0), 2.0_f64.ln());
/// # Ok::<(), piola_continuum::ContinuumError>(())
/// ```
///
/// # References
/// B. R. Seth, *Generalized strain measure with applications to physical problems* (1964); R. Hill, *On constitutive
/// inequalities for simple materials*, J. Mech. Phys. Solids 16 (1968).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "f64", into = "f64"))]
pub struct SethHill {
    order: f64,
}

impl SethHill {
    /// m = 2: ½ (λ² − 1), Green's strain E in the material.
    pub const GREEN: Self = Self { order: 2.0 };
    /// m = 1: λ − 1, Biot's strain U − 1 in the material.
    pub const BIOT: Self = Self { order: 1.0 };
    /// m = 0: ln λ, Hencky's strains ln U and ln V.
    pub const HENCKY: Self = Self { order: 0.0 };
    /// m = −2: ½ (1 − λ⁻²), Almansi's strain e in space.
    pub const ALMANSI: Self = Self { order: -2.0 };

    /// From the exponent m.
    ///
    /// # Errors
    /// [`ContinuumError::NotFinite`].
    pub fn new(order: f64) -> Result<Self, ContinuumError> {
        check_finite("order of a strain", &[order])?;
        Ok(Self { order })
    }

    /// m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub const fn order(self) -> f64 {
        self.order
    }

    /// The same scale as a function of c = λ², (c^(m/2) − 1)/m.
    #[cfg_attr(not(debug_assertions), inline(always))]
    #[must_use]
    pub fn of_metric(self) -> MetricScale {
        MetricScale { half: Self { order: 0.5 * self.order } }
    }
}

impl TryFrom<f64> for SethHill {
    type Error = ContinuumError;
    fn try_from(order: f64) -> Result<Self, ContinuumError> {
        Self::new(order)
    }
}

impl From<SethHill> for f64 {
    fn from(scale: SethHill) -> Self {
        scale.order
    }
}

/// Beyond this |m ln λ| the power itself is taken: an exponential would magnify the rounding of its argument.
const SMALL_EXPONENT: f64 = 0.5;

/// Orders up to this size are no different from 0 to the last bit, for any stretch that a float can hold.
const NO_ORDER: f64 = 1e-30;

/// (xᵐ − 1)/m, given ln x.
#[cfg_attr(not(debug_assertions), inline(always))]
fn scaled_power<T: Real>(order: f64, x: T, logarithm: T) -> T {
    if order.abs() <= NO_ORDER {
        return logarithm;
    }
    let m = T::lit(order);
    let small = (m * logarithm).abs().at_most(T::lit(SMALL_EXPONENT));
    let beside = if small.any() { (m * logarithm).exp_m1() } else { logarithm };
    let power = if small.all() { beside } else { x.powf(m) - T::one() };
    T::select(small, beside, power) / m
}

impl IsotropicFunction for SethHill {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, x: T) -> T {
        scaled_power(self.order, x, x.ln())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value_beside_one<T: Real>(&self, x: T) -> T {
        scaled_power(self.order, T::one() + x, x.ln_1p())
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        if self.order.abs() <= NO_ORDER {
            return Logarithm.divided_difference(a, b);
        }
        Power(self.order).divided_difference(a, b) / T::lit(self.order)
    }
}

/// A scale of Seth and Hill as a function of the square of the stretch: see [`SethHill::of_metric`].
///
/// # Example
/// ```
/// use piola_tensor::spectral::{derivative_array, IsotropicFunction};
/// use piola_continuum::strain::{RightCauchyGreen, SethHill};
/// // ∂ ln U/∂C at C = 1 is half the identity on symmetric tensors.
/// let identity = piola_continuum::Symmetric::<f64>::identity();
/// let derivative = derivative_array(&SethHill::HENCKY.of_metric(), &identity);
/// assert!((derivative[0][0] - 0.5).abs() < 1e-15 && (derivative[3][3] - 0.25).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct MetricScale {
    /// (c^(m/2) − 1)/(m/2), twice the scale.
    half: SethHill,
}

impl IsotropicFunction for MetricScale {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value<T: Real>(&self, x: T) -> T {
        T::lit(0.5) * self.half.value(x)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn value_beside_one<T: Real>(&self, x: T) -> T {
        T::lit(0.5) * self.half.value_beside_one(x)
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn divided_difference<T: Real>(&self, a: T, b: T) -> T {
        T::lit(0.5) * self.half.divided_difference(a, b)
    }
}
