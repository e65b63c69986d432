//! The memory of a K-BKZ fluid in steady shear: error against how often its integrand is evaluated.

use std::error::Error;
use std::hint::black_box;
use std::time::Instant;

use piola_fluids::{Damping, ExponentialDamping, Kbkz, ViscometricFluid};

use super::{DAMPING, melt, plain};

/// The shear rate, 1/s.
pub const RATE: f64 = 5.0;

/// The method of the fluid itself.
const STEPS: &str = "equal steps, double exponential";

/// A way to integrate.
#[derive(Clone, Debug)]
pub struct Point {
    /// How.
    pub method: &'static str,
    /// With which setting.
    pub setting: String,
    /// How often the integrand was evaluated.
    pub evaluations: usize,
    /// The relative error of τ.
    pub error: f64,
    /// The time of it all, s: the least of many.
    pub seconds: f64,
}

/// Equal steps of u with s = s₀ e^(u − e^(−u)), as in the fluid itself, whose step is a fifth.
#[must_use]
pub fn equal_steps(fluid: &Kbkz<ExponentialDamping>, rate: f64, step: f64) -> (f64, usize) {
    let mut evaluations = 0;
    let mut total = 0.0;
    for term in fluid.memory() {
        let w = term.time * rate;
        let start = -w.ln_1p();
        let (mut u, mut sum) = (-3.0_f64, 0.0);
        while start + u < 3.9 {
            let below = (-u).exp();
            let x = (start + u - below).exp();
            let strain = w * x;
            let damped = fluid.damping().factor(strain * strain, strain * strain);
            sum += (-x).exp() * x * (1.0 + below) * strain * damped;
            evaluations += 1;
            u += step;
        }
        total += sum * step * term.viscosity / term.time;
    }
    (total, evaluations)
}

/// m(s) h(γ) γ with γ = k s.
fn integrand(fluid: &Kbkz<ExponentialDamping>, rate: f64, s: f64) -> f64 {
    let strain = rate * s;
    fluid.memory_function(s) * fluid.damping().factor(strain * strain, strain * strain) * strain
}

/// How long a history is, in the longest of the fluid's times: e⁻⁴⁰ is below the rounding.
const LENGTH: f64 = 40.0;

/// Simpson's rule over equal steps of s.
#[must_use]
pub fn simpson(fluid: &Kbkz<ExponentialDamping>, rate: f64, pairs: u32) -> (f64, usize) {
    let step = LENGTH / f64::from(2 * pairs);
    let at = |i: u32| integrand(fluid, rate, step * f64::from(i));
    let inner: f64 = (1..2 * pairs).map(|i| if i % 2 == 1 { 4.0 } else { 2.0 } * at(i)).sum();
    ((at(0) + inner + at(2 * pairs)) * step / 3.0, 2 * pairs as usize + 1)
}

/// Σ η k/(1 + n λ k)²: τ of [`melt`].
#[must_use]
pub fn exact(fluid: &Kbkz<ExponentialDamping>, rate: f64) -> f64 {
    fluid.memory().iter().map(|term| term.viscosity * rate / (1.0 + DAMPING * term.time * rate).powi(2)).sum()
}

/// Error against evaluations of all ways.
///
/// # Errors
/// None: the fluid is within bounds.
pub fn points() -> Result<Vec<Point>, Box<dyn Error>> {
    let fluid = melt()?;
    let truth = exact(&fluid, RATE);
    let point = |method, setting: String, run: &dyn Fn() -> (f64, usize)| {
        let (value, evaluations) = run();
        let seconds = (0..50)
            .map(|_| {
                let start = Instant::now();
                black_box(run());
                start.elapsed().as_secs_f64()
            })
            .fold(f64::INFINITY, f64::min);
        Point { method, setting, evaluations, error: (value / truth - 1.0).abs(), seconds }
    };
    let mut points = Vec::new();
    for step in [1.5, 1.0, 0.75, 0.5, 0.375, 0.25, 0.2] {
        points.push(point(STEPS, format!("step {step}"), &|| equal_steps(&fluid, RATE, step)));
    }
    // One of the two grids that give a bound is the shear stress itself.
    let count = fluid.steady_shear(RATE)[0].evaluations / 2;
    let steady = || (black_box(&fluid).shear_stress(RATE), count);
    points.push(point("Piola, steady shear", "as it is".into(), &steady));
    let started = || fluid.start_up(RATE, LENGTH).map_or((f64::NAN, 0), |all| (all.value.shear, all.evaluations));
    points.push(point("Piola, start-up (τ, N₁ and bound)", "as it is".into(), &started));
    for power in (3..=12).step_by(3) {
        let tolerance = 10.0_f64.powi(-power);
        let answer = || plain::integrate(0.0, LENGTH, tolerance, |s| integrand(&fluid, RATE, s));
        points.push(point("plain Gauss–Kronrod in s", format!("tolerance 1e-{power}"), &answer));
    }
    for power in (4..=16).step_by(2) {
        points.push(point("Simpson in s", format!("2^{power} steps"), &|| simpson(&fluid, RATE, 1 << (power - 1))));
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use piola_fluids::ViscometricFluid;

    use super::{RATE, STEPS, exact, melt, points};

    #[test]
    fn the_sum_over_equal_steps_converges_to_the_closed_form() {
        let fluid = melt().expect("within bounds");
        assert!((fluid.shear_stress(RATE) / exact(&fluid, RATE) - 1.0).abs() < 1e-14);
        let points = points().expect("within bounds");
        let steps: Vec<_> = points.iter().filter(|point| point.method == STEPS).collect();
        assert!(steps.first().is_some_and(|point| point.error > 1e-4));
        assert!(steps.last().is_some_and(|point| point.error < 1e-14));
        assert!(points.iter().filter(|point| point.method.starts_with("Piola")).all(|point| point.error < 1e-13));
    }
}
