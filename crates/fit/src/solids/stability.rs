//! Stability of a fitted law over the measured deformations.
//!
//! ```text
//! Drucker         Σ dτₐ dεₐ > 0   for all isochoric increments:  ∂²W/∂ε∂ε > 0 on Σ εₐ = 0,   εₐ = ln λₐ
//! Baker–Ericksen  (τₐ − τᵦ)(λₐ − λᵦ) > 0   where λₐ ≠ λᵦ
//! ```
//! Looked at on a fan of rays ε = s (1, b, −1 − b) from uniaxial tension (b = −½) by planar (0) to equibiaxial (1), as far as
//! the I₁ of the data.

use piola_numerics::{Dual, Real};

use super::Model;

/// Rays of the fan: b of ε = s (1, b, −1 − b).
const RAYS: [f64; 7] = [-0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0];
/// Points of a ray.
const STEPS: u32 = 24;

/// Where a condition is violated most.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Counterexample {
    /// The principal stretches.
    pub stretches: [f64; 3],
    /// The value that should be positive, in the unit of the stresses.
    pub value: f64,
}

/// Both conditions over the deformations of the data.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StabilityReport {
    /// The largest I₁ = λ₁² + λ₂² + λ₃² that was tried.
    pub largest_first_invariant: f64,
    /// The worst violation of Drucker's condition.
    pub drucker: Option<Counterexample>,
    /// The worst violation of the inequalities of Baker and Ericksen.
    pub baker_ericksen: Option<Counterexample>,
}

impl StabilityReport {
    /// Whether neither is violated.
    #[must_use]
    pub const fn is_stable(&self) -> bool {
        self.drucker.is_none() && self.baker_ericksen.is_none()
    }
}

/// The logarithmic stretches that are looked at.
pub(super) fn fan(largest_first_invariant: f64) -> Vec<[f64; 3]> {
    let mut points = vec![[0.0; 3]];
    for b in RAYS {
        let at = |s: f64| [s, b * s, -(1.0 + b) * s];
        let first = |s: f64| at(s).into_iter().map(|x| (2.0 * x).exp()).sum::<f64>();
        // I₁ grows along the ray: halving finds where it ends.
        let (mut low, mut high) = (0.0, 0.5 * largest_first_invariant.ln() + 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if first(middle) < largest_first_invariant {
                low = middle;
            } else {
                high = middle;
            }
        }
        points.extend((1..=STEPS).map(|step| at(low * f64::from(step) / f64::from(STEPS))));
    }
    points
}

/// The report on a model with its parameters.
pub(super) fn report<M: Model>(model: &M, parameters: &[f64], largest_first_invariant: f64) -> StabilityReport {
    let mut report = StabilityReport { largest_first_invariant, drucker: None, baker_ericksen: None };
    let worse = |worst: &mut Option<Counterexample>, logarithms: [f64; 3], value: f64| {
        // What is not a number is no proof of stability.
        let violated = value.is_nan() || value <= 0.0;
        if violated && worst.is_none_or(|worst| value < worst.value) {
            *worst = Some(Counterexample { stretches: logarithms.map(f64::exp), value });
        }
    };
    for logarithms in fan(largest_first_invariant) {
        worse(&mut report.drucker, logarithms, least_modulus(model, logarithms, parameters));
        if logarithms[0] < 1e-6 {
            continue;
        }
        for (a, b) in [(0, 1), (1, 2), (0, 2)] {
            if logarithms[a] - logarithms[b] < 1e-6 {
                continue;
            }
            // τₐ − τᵦ as the derivative along εₐ and against εᵦ.
            let stretches = core::array::from_fn(|k| {
                let sign = if k == a {
                    1.0
                } else if k == b {
                    -1.0
                } else {
                    0.0
                };
                Dual::new(logarithms[k], sign).exp()
            });
            let lifted: Vec<_> = parameters.iter().map(|x| Dual::constant(*x)).collect();
            worse(&mut report.baker_ericksen, logarithms, model.energy(stretches, &lifted).tangent);
        }
    }
    report
}

/// The least principal modulus dτ:dε/dε:dε of isochoric increments.
pub(super) fn least_modulus<T: Real, M: Model>(model: &M, logarithms: [f64; 3], parameters: &[T]) -> T {
    least(moduli(model, logarithms, parameters))
}

/// The second derivatives along two orthonormal directions of Σ εₐ = 0, and the mixed one: linear in parameters that are factors.
pub(super) fn moduli<T: Real, M: Model>(model: &M, logarithms: [f64; 3], parameters: &[T]) -> [T; 3] {
    /// (2, −1, −1)/√6 and (0, 1, −1)/√2.
    const DIRECTIONS: [[f64; 3]; 2] = [
        [0.816_496_580_927_726, -0.408_248_290_463_863, -0.408_248_290_463_863],
        [0.0, core::f64::consts::FRAC_1_SQRT_2, -core::f64::consts::FRAC_1_SQRT_2],
    ];
    let lifted: Vec<Dual<Dual<T>>> = parameters.iter().map(|x| Dual::constant(Dual::constant(*x))).collect();
    // Two nested duals for each entry: less machine code for the energies of all models than a scalar that carries both directions.
    let second = |[i, j]: [usize; 2]| {
        let stretches = core::array::from_fn(|a| {
            let inner = Dual::new(T::lit(logarithms[a]), T::lit(DIRECTIONS[j][a]));
            Dual::new(inner, Dual::lit(DIRECTIONS[i][a])).exp()
        });
        model.energy(stretches, &lifted).tangent.tangent
    };
    [second([0, 0]), second([0, 1]), second([1, 1])]
}

/// The least of the principal moduli.
pub(super) fn least<T: Real>([a, b, d]: [T; 3]) -> T {
    // The mean less the radius of Mohr's circle, whose derivative is taken as zero at its centre.
    let (mean, half) = (T::lit(0.5) * (a + d), T::lit(0.5) * (a - d));
    let tiny = T::lit(1e-15) * (a.abs() + d.abs()).frozen();
    mean - (half * half + b * b + tiny * tiny).sqrt()
}
