//! Verner 9(8): an adaptive explicit Runge–Kutta method of order nine with dense output and events.
//!
//! Sixteen evaluations a step; nine more in the steps that are asked for a state within them.
//!
//! # When?
//! For smooth fields of first order that are not stiff, for errors below 1e-7: there its longer steps make up for
//! its stages, four more than those of [`DormandPrince853`](crate::DormandPrince853).
//!
//! # References
//! J. H. Verner, *Numerically optimal Runge–Kutta pairs with interpolants*, Numer. Algorithms 53 (2010) 383–396.

#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
pub(crate) mod coefficients;

use piola_numerics::Real;

use self::coefficients as c;
use crate::explicit::{RungeKutta, RungeKuttaCoefficients, RungeKuttaPair, Weights, row, row_mut, weighted_sums};

/// The adaptive method of order 9(8).
///
/// # Accuracy
/// The local error of each step is below the tolerance; the global error is proportional to it, by a factor
/// that the problem's sensitivity sets. The state and the time are summed with compensation. Dense output is of order
/// nine. [Tolerances below rounding](crate::Tolerance#tolerances-below-rounding) are raised.
///
/// # Example
/// ```
/// use piola_integrators::{State, Tolerance, Verner98, field};
/// let mut oscillator = field(2, |_t, y: &[f64], rate: &mut [f64]| {
///     rate[0] = y[1];
///     rate[1] = -y[0];
/// });
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// let report = Verner98::new(Tolerance::relative(1e-13)?).integrate_to(&mut oscillator, &mut state, 10.0)?;
/// assert!((state.values[0] - 10.0_f64.cos()).abs() < 1e-12);
/// assert!(report.steps < 120);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("Vern9", "Runge-Kutta"))]
pub type Verner98<T = f64> = RungeKutta<VernerPair, T>;

/// Verner's formulas of order nine, with an estimate of order eight.
///
/// # Example
/// ```
/// use piola_integrators::{RungeKutta, Tolerance, Verner98, VernerPair};
/// let method: RungeKutta<VernerPair> = Verner98::new(Tolerance::relative(1e-12)?);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct VernerPair;

impl RungeKuttaPair for VernerPair {}

impl RungeKuttaCoefficients for VernerPair {
    const NAME: &'static str = "Verner98";
    const STAGES: usize = 26;
    const NODES: &'static [f64] = &c::C;
    const ROWS: &'static [(usize, Weights)] = &c::ROWS;
    const END: usize = 16;
    /// The interval of stability ends at −4.48; errors settle the steps of stiff problems at some −2.7.
    const NEARLY_UNSTABLE: f64 = 2.5;
    const WEIGHTS: Weights = &c::B;
    const ERROR: Weights = &c::E;
    const COARSER: Weights = &[];
    const DENSE_ROWS: &'static [(usize, Weights)] = &c::DENSE_ROWS;
    const INTERPOLANT: usize = 11;

    /// ```text
    /// e = |h| ‖e₈‖ / √n,    ‖x‖² = Σᵢ (xᵢ/allowedᵢ)²
    /// ```
    fn error(h: f64, n: usize, eighth: f64, _none: f64) -> f64 {
        if eighth <= 0.0 { 0.0 } else { h.abs() * (eighth / n as f64).sqrt() }
    }

    /// e^(7/64), nearly the ninth root.
    fn root(error: f64) -> f64 {
        let sixteenth = error.sqrt().sqrt().sqrt().sqrt();
        let half = sixteenth.sqrt();
        sixteenth * half * half.sqrt()
    }

    fn interpolant<T: Real>(k: &[T], increment: &[T], h: f64, interpolant: &mut [T]) {
        let (n, h) = (increment.len(), T::lit(h));
        for (j, weights) in c::D.iter().enumerate() {
            let f = row_mut(interpolant, j, n);
            weighted_sums(weights, k, f);
            for f in f {
                *f *= h;
            }
        }
    }

    /// ```text
    /// Σⱼ Fⱼ Pⱼ(2θ − 1),    (j + 1) P_{j+1}(x) = (2j + 1) x Pⱼ(x) − j P_{j−1}(x)
    /// ```
    fn increment<T: Real>(interpolant: &[T], n: usize, i: usize, theta: f64) -> T {
        let x = 2.0 * theta - 1.0;
        let (mut before, mut now) = (1.0, x);
        let mut sum = row(interpolant, 1, n)[i];
        for j in 1..c::D.len() {
            sum += T::lit(now) * row(interpolant, j + 1, n)[i];
            let m = j as f64;
            (before, now) = (now, ((2.0 * m + 1.0) * x * now - m * before) / (m + 1.0));
        }
        sum
    }
}
