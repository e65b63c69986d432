//! Dormand–Prince 8(5,3): an adaptive explicit Runge–Kutta method of order eight with dense output of order
//! seven and events.
//!
//! The step is chosen so that the local error, estimated by two embedded formulas of orders five and three,
//! stays below the [`Tolerance`]. Dense output costs three more evaluations, made only for the steps where it
//! is asked for, and never extrapolates.
//!
//! # When?
//! For smooth fields that are not stiff, at tolerances from 1e-6 to rounding: close encounters, driven and
//! damped systems, trajectories at prescribed times. For millions of revolutions prefer a symplectic method.
//!
//! # References
//! Hairer, Nørsett & Wanner, *Solving Ordinary Differential Equations I*, II.4–II.6, II.10.

#[expect(clippy::unreadable_literal, reason = "seventeen digits, to be compared with printed tables")]
pub mod coefficients;

use piola_numerics::Real;

use self::coefficients as c;
use crate::explicit::{RungeKutta, RungeKuttaCoefficients, RungeKuttaPair, Weights, row, row_mut, weighted_sums};

/// The adaptive method of order 8(5,3).
///
/// # Accuracy
/// The local error of each step is below the tolerance; the global error is proportional to it, by a factor
/// that the problem's sensitivity sets. The state and the time are summed with compensation.
///
/// # Example
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance, field};
/// let mut oscillator = field(2, |_t, y: &[f64], rate: &mut [f64]| {
///     rate[0] = y[1];
///     rate[1] = -y[0];
/// });
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// let mut method = DormandPrince853::new(Tolerance::relative(1e-13)?);
/// let mut largest = 0.0_f64;
/// method.integrate(&mut oscillator, &mut state, 10.0, |step| {
///     // Dense output in the middle of each step.
///     let middle = 0.5 * (step.start() + step.time());
///     let mut y = [0.0; 2];
///     if step.at(middle, &mut y).is_ok() {
///         largest = largest.max((y[0] - middle.cos()).abs());
///     }
///     std::ops::ControlFlow::Continue(())
/// })?;
/// assert!((state.values[0] - 10.0_f64.cos()).abs() < 1e-12);
/// assert!(largest < 1e-11);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("DOP853", "Runge-Kutta"))]
pub type DormandPrince853<T = f64> = RungeKutta<DormandPrincePair, T>;

/// The formulas of Dormand and Prince, of order eight, with estimates of orders five and three.
///
/// # Example
/// ```
/// use piola_integrators::{DormandPrince853, DormandPrincePair, RungeKutta, Tolerance};
/// let method: RungeKutta<DormandPrincePair> = DormandPrince853::new(Tolerance::relative(1e-9)?);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct DormandPrincePair;

impl RungeKuttaPair for DormandPrincePair {}

impl RungeKuttaCoefficients for DormandPrincePair {
    const NAME: &'static str = "DormandPrince853";
    const STAGES: usize = 16;
    const NODES: &'static [f64] = &c::C;
    const ROWS: &'static [(usize, Weights)] = &c::ROWS;
    const END: usize = 12;
    /// The interval of stability ends at −6.39.
    const NEARLY_UNSTABLE: f64 = 5.5;
    const WEIGHTS: Weights = &c::B;
    const ERROR: Weights = &c::E5;
    const COARSER: Weights = &c::B3;
    const DENSE_ROWS: &'static [(usize, Weights)] = &c::DENSE_ROWS;
    const INTERPOLANT: usize = 7;

    /// The estimate of order five, damped by that of order three.
    ///
    /// ```text
    /// e = |h| ‖e₅‖² / √(n (‖e₅‖² + 0.01 ‖e₃‖²)),    ‖x‖² = Σᵢ (xᵢ/allowedᵢ)²
    /// ```
    fn error(h: f64, n: usize, fifth: f64, third: f64) -> f64 {
        let denominator = fifth + 0.01 * third;
        if denominator <= 0.0 {
            0.0
        } else if denominator.is_infinite() {
            f64::INFINITY
        } else {
            h.abs() * fifth / (denominator * n as f64).sqrt()
        }
    }

    fn root(error: f64) -> f64 {
        error.sqrt().sqrt().sqrt()
    }

    fn interpolant<T: Real>(k: &[T], increment: &[T], h: f64, interpolant: &mut [T]) {
        let (n, h) = (increment.len(), T::lit(h));
        let (low, high) = interpolant.split_at_mut(2 * n);
        for (i, &increment) in increment.iter().enumerate() {
            let (first, last) = (h * k[i], h * k[Self::END * n + i]);
            low[i] = first - increment;
            low[n + i] = increment + increment - (last + first);
        }
        for (j, weights) in [&c::D4[..], &c::D5, &c::D6, &c::D7].into_iter().enumerate() {
            let f = row_mut(high, j, n);
            weighted_sums(weights, k, f);
            for f in f {
                *f *= h;
            }
        }
    }

    /// ```text
    /// θ(F₀ + θ̄(F₁ + θ(F₂ + θ̄(F₃ + θ(F₄ + θ̄(F₅ + θF₆)))))),   θ̄ = 1 − θ
    /// ```
    fn increment<T: Real>(interpolant: &[T], n: usize, i: usize, theta: f64) -> T {
        let f = |j: usize| row(interpolant, j, n)[i];
        let theta = T::lit(theta);
        let rest = T::one() - theta;
        let inner = f(3) + theta * (f(4) + rest * (f(5) + theta * f(6)));
        theta * (f(0) + rest * (f(1) + theta * (f(2) + rest * inner)))
    }
}
