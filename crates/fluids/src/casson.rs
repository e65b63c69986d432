//! Casson's plastic.

use piola_numerics::internal::excess_over_logarithm;
use piola_numerics::{Real, parameters};

use super::answers::{beyond, finite_rate, moving, signed, viscosity_with_limit};
use super::parameters::{Parameters, listed};
use super::viscometric::{FlowMoment, ViscometricFluid};
use crate::FluidsError;

parameters! {
    FluidsError;
    /// Casson's plastic: blood, chocolate, printing ink.
    ///
    /// ```text
    /// √|τ| = √τᵧ + √(μ |k|)      ζ = (√|τ| − √τᵧ)² sign τ / μ where τᵧ < |τ|, else 0
    /// ```
    /// | symbol | parameter | unit | bounds |
    /// |---|---|---|---|
    /// | τᵧ | `yield_stress` | Pa | 0 ≤ τᵧ |
    /// | μ | `plastic_viscosity` | Pa s | 0 < μ |
    ///
    /// All moments of ζ are closed.
    ///
    /// # Accuracy
    /// 4 ulp of τ and, close to yield too, 8 ulp of ζ; 32 ulp of the moments: with x = √s − √τᵧ = (s − τᵧ)/(√s + √τᵧ) they
    /// are sums of positive terms, so that nothing cancels just above yield or in a narrow interval.
    ///
    /// # Example
    /// ```
    /// use piola_fluids::{Casson, ViscometricFluid};
    /// let chocolate = Casson::new(4.0, 0.25)?;
    /// assert_eq!(chocolate.shear_stress(4.0), 9.0); // (2 + 1)²
    /// assert_eq!(chocolate.shear_rate(-9.0)?, -4.0);
    /// assert_eq!(chocolate.shear_rate(3.0)?, 0.0);
    /// # Ok::<(), piola_fluids::FluidsError>(())
    /// ```
    ///
    /// # Source
    /// N. Casson, in *Rheology of Disperse Systems* (1959) 84; an example of the functions of W(23.13).
    pub struct Casson("Casson") {
        /// τᵧ, Pa.
        yield_stress: "0 ≤ τᵧ" => 0.0 <= yield_stress,
        /// μ, Pa s.
        plastic_viscosity: "0 < μ" => 0.0 < plastic_viscosity,
    }
}

listed! {
    Casson<2>: yield_stress, plastic_viscosity;
    |[yield_stress, viscosity], shear_rate|
        yield_stress + viscosity * shear_rate + mixed(yield_stress, viscosity, shear_rate)
}

/// 2 √(τᵧ μ |k|), zero without derivatives where one of them is.
#[cfg_attr(not(debug_assertions), inline(always))]
fn mixed<T: Real>(yield_stress: T, viscosity: T, shear_rate: T) -> T {
    let (rest, rate) = moving(shear_rate);
    let (never, plastic) = moving(yield_stress);
    let root = T::lit(2.0) * (plastic.sqrt() * (viscosity * rate).sqrt());
    T::select(rest, T::zero(), T::select(never, T::zero(), root))
}

impl ViscometricFluid for Casson {
    const NAME: &'static str = Self::NAME;
    const CLOSED_RATE: bool = true;

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_stress<T: Real>(&self, shear_rate: T) -> T {
        let (yield_stress, viscosity) = (T::lit(self.yield_stress), T::lit(self.plastic_viscosity));
        viscosity * shear_rate + signed(shear_rate, yield_stress + mixed(yield_stress, viscosity, shear_rate))
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn yield_stress(&self) -> f64 {
        self.yield_stress
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn viscosity<T: Real>(&self, shear_rate: T) -> T {
        let limit = if 0.0 < self.yield_stress { f64::INFINITY } else { self.plastic_viscosity };
        viscosity_with_limit(self, shear_rate, limit)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shear_rate<T: Real>(&self, shear_stress: T) -> Result<T, FluidsError> {
        let yield_stress = T::lit(self.yield_stress);
        if self.yield_stress <= 0.0 {
            return finite_rate::<Self, T>(shear_stress, shear_stress / T::lit(self.plastic_viscosity));
        }
        let excess = beyond(shear_stress, yield_stress);
        let (_, size) = moving(shear_stress);
        // (s − τᵧ)²/(√s + √τᵧ)²: no difference of roots.
        let roots = size.sqrt() + yield_stress.sqrt();
        let x = excess / roots;
        finite_rate::<Self, T>(shear_stress, signed(shear_stress, x * (x / T::lit(self.plastic_viscosity))))
    }

    /// With √s = a + x, a = √τᵧ: ∫ sᵖ ζ ds = (2/μ) ∫ (a + x)²ᵖ⁺¹ x² dx, expanded about the lower end.
    fn flow_moment(&self, moment: FlowMoment, from: f64, to: f64) -> Option<f64> {
        let start = from.max(self.yield_stress);
        if to <= start {
            return Some(0.0);
        }
        let a = self.yield_stress.sqrt();
        let lower = (start - self.yield_stress) / (start.sqrt() + a);
        let width = (to - start) / (to.sqrt() + start.sqrt());
        let integral = match moment {
            FlowMoment::Reciprocal => {
                let edge = a + lower;
                if edge <= 0.0 { width * width / 2.0 } else { over_root(lower, edge, width) }
            }
            FlowMoment::Zeroth => expanded::<1>(a, lower, width),
            FlowMoment::First => expanded::<3>(a, lower, width),
            FlowMoment::Second => expanded::<5>(a, lower, width),
        };
        Some(2.0 * integral / self.plastic_viscosity)
    }
}

/// ∫ (a + x)^N x² dx from `lower` to `lower + width`, a sum of positive terms.
///
/// With y = x − `lower` and e = a + `lower`: (e + y)^N (l + y)², term by term.
fn expanded<const N: usize>(a: f64, lower: f64, width: f64) -> f64 {
    let edge = a + lower;
    // Coefficients of (e + y)^N, then of the product, as multiples of powers of the width.
    let mut coefficients = [0.0; 8];
    coefficients[0] = 1.0;
    let mut times = |constant: f64| {
        for k in (0..8).rev() {
            let below = if k == 0 { 0.0 } else { coefficients[k - 1] * width };
            coefficients[k] = coefficients[k] * constant + below;
        }
    };
    for _ in 0..N {
        times(edge);
    }
    times(lower);
    times(lower);
    width * coefficients.iter().zip(1..).map(|(c, k)| c / f64::from(k)).sum::<f64>()
}

/// ∫ x²/(a + x) dx from `lower`, with e = a + `lower` and y = x − `lower`:
/// l² ∫ dy/(e + y) + 2 l ∫ y dy/(e + y) + ∫ y² dy/(e + y).
fn over_root(lower: f64, edge: f64, width: f64) -> f64 {
    let z = width / edge;
    lower * lower * z.ln_1p() + 2.0 * lower * edge * excess_over_logarithm(z) + edge * edge * third_excess(z)
}

/// ln(1 + z) − z + z²/2, of third order in z, 0 ≤ z, without cancellation.
///
/// With s = z/(2 + z): z² s/2 + 2 (s³/3 + s⁵/5 + …), a sum of positive terms.
fn third_excess(z: f64) -> f64 {
    if 2.0 < z {
        return z * (z / 2.0 - 1.0) + z.ln_1p();
    }
    let s = z / (2.0 + z);
    let square = s * s;
    let mut sum = 0.0;
    // s ≤ ½: twenty-six terms.
    for k in (0..27).rev() {
        sum = sum * square + 1.0 / f64::from(2 * k + 3);
    }
    z * z * s / 2.0 + 2.0 * s * square * sum
}
