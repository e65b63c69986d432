//! What makes an explicit Runge–Kutta pair, and the memory of its runs.

use core::marker::PhantomData;

use piola_numerics::Real;

use super::Limits;
use crate::{Field, IntegratorsError, Tolerance};

/// A pair of explicit formulas: [`DormandPrincePair`](crate::DormandPrincePair) or [`VernerPair`](crate::VernerPair).
pub trait RungeKuttaPair: RungeKuttaCoefficients {}

/// A row of a tableau: stages, counted from zero, with their coefficients.
pub(crate) type Weights = &'static [(usize, f64)];

/// What makes a pair of formulas. Stages are counted from zero.
pub trait RungeKuttaCoefficients: Copy + core::fmt::Debug {
    /// The name of the method that steps with the pair.
    const NAME: &'static str;
    /// Stages of all kinds.
    const STAGES: usize;
    /// The times of the stages, as parts of the step.
    const NODES: &'static [f64];
    /// The stages of a step after the first, by their numbers.
    const ROWS: &'static [(usize, Weights)];
    /// The stage that holds the rate at the end of a step: the first stage of the next one.
    const END: usize;
    /// |hλ| above which the step is near the limit of stability, for negative real λ.
    const NEARLY_UNSTABLE: f64;
    /// The weights of the result.
    const WEIGHTS: Weights;
    /// The weights of the estimate of the error.
    const ERROR: Weights;
    /// The weights of a second, coarser result, from which another estimate is made; may be empty.
    const COARSER: Weights;
    /// Stages that dense output alone needs, by their numbers.
    const DENSE_ROWS: &'static [(usize, Weights)];
    /// How many coefficients dense output has, each a state.
    const INTERPOLANT: usize;

    /// The error over the tolerance, of n components, from Σ (eᵢ/allowedᵢ)² of both estimates.
    fn error(h: f64, n: usize, first: f64, second: f64) -> f64;
    /// e^(1/p), where the error e falls with the power p of the step.
    fn root(error: f64) -> f64;
    /// Writes the coefficients of dense output to `interpolant` from the stages and the ends of a step.
    fn interpolant<T: Real>(stages: &[T], increment: &[T], h: f64, interpolant: &mut [T]);
    /// The increment of component i from the start of the step to its part θ.
    fn increment<T: Real>(interpolant: &[T], n: usize, i: usize, theta: f64) -> T;
}

/// An explicit Runge–Kutta method with adaptive steps: [`DormandPrince853`](crate::DormandPrince853) or
/// [`Verner98`](crate::Verner98), whose pages have examples.
///
/// # Accuracy
/// The local error of each step is below the tolerance; the global error is proportional to it, by a factor
/// that the problem's sensitivity sets. The state and the time are summed with compensation.
#[derive(Clone, Debug)]
pub struct RungeKutta<P, T = f64> {
    pub(crate) tolerance: Tolerance,
    pub(super) limits: Limits,
    /// Rows of one state each: the stages, then those of `Rows`.
    pub(super) memory: Vec<T>,
    /// Components of the state.
    pub(super) components: usize,
    pub(super) magnitudes: Vec<f64>,
    pub(super) magnitudes_at_end: Vec<f64>,
    pub(super) pair: PhantomData<P>,
}

/// The rows of the memory after the stages.
pub(crate) struct Rows;
impl Rows {
    /// The stage's argument, then the step's end and what rounding left of it.
    pub(super) const TRIAL: usize = 0;
    /// The step's start and what rounding left of it.
    pub(crate) const START: usize = 2;
    pub(crate) const START_CARRY: usize = 3;
    /// The coefficients of dense output.
    pub(super) const INTERPOLANT: usize = 4;
    /// Among these, before they are made: the argument of the last stage.
    pub(super) const LAST_ARGUMENT: usize = 2;
}

/// Writes f(t, y) to `rate`.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn evaluate<T: Real, F: Field<T>>(
    field: &mut F,
    time: f64,
    y: &[T],
    rate: &mut [T],
) -> Result<(), IntegratorsError<F::Error>> {
    field.rate(time, y, rate).map_err(|source| IntegratorsError::Field { t: time, source })
}
