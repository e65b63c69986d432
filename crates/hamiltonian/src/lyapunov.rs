//! Lyapunov's characteristic exponents: how fast neighbouring motions part.
//!
//! ```text
//! λ = lim 1/t ln |δz(t)|/|δz(0)|,        δż = Ω⁻¹ ∂²H δz
//! ```
//!
//! Variations of the motion are carried along by exact derivatives and made orthogonal again at even intervals; the
//! logarithms of their lengths add up (G. Benettin, L. Galgani, A. Giorgilli and J.-M. Strelcyn, Meccanica 15 (1980)).
//! For a Hamiltonian the exponents come in pairs ±λ, and two of them vanish where H is kept.

use core::ops::ControlFlow;

use piola_integrators::{DormandPrince853, State, Tolerance};

use super::PhaseFunction;
use super::integrals::PhasePoint;
use crate::HamiltonianError;
use crate::check::check_finite;
use crate::ray::RayField;

/// The exponents of a motion over a span of time.
///
/// # Example
/// See [`lyapunov_exponents`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct LyapunovExponents {
    /// The exponents, 1/s, as they come out: the largest first where the span is long enough.
    pub exponents: Vec<f64>,
    /// Times at which the estimates were noted, s since the start.
    pub times: Vec<f64>,
    /// The estimate of the first exponent at these times, 1/s: that it levels off says that the span is long enough.
    pub history: Vec<f64>,
    /// The point reached.
    pub end: PhasePoint,
}

/// The first `count` Lyapunov exponents of the motion from a point, over `intervals` intervals of `interval` seconds.
///
/// | symbol | argument | unit |
/// |---|---|---|
/// | z₀ | `start` | \[q\], J s/\[q\] |
/// | Δ | `interval`, after which variations are made orthogonal | s |
/// | λ₁ ≥ λ₂ … | returned | 1/s |
///
/// Lengths of variations are Euclidean in (q, p): units change the estimate at a finite time, not its limit. What an
/// error leaves undone is lost; choose the span so that the motion stays regular.
///
/// # Errors
/// [`HamiltonianError::WrongLength`] for more exponents than 2n; [`HamiltonianError::NotPositive`] for the interval,
/// [`HamiltonianError::TooFewSamples`] for none;
/// [`HamiltonianError::Run`].
///
/// # Accuracy
/// The estimate converges as slowly as 1/t does; the integration adds its tolerance per interval.
///
/// # Example
/// A pencil near its top: H = ½(p² − q²) has the exponents ±1.
/// ```
/// use piola_hamiltonian::{PhaseFunction, PhasePoint, lyapunov_exponents};
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// struct Saddle;
/// impl PhaseFunction for Saddle {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] - q[0] * q[0])
///     }
/// }
/// let start = PhasePoint::new(&[0.0], &[0.0], 0.0)?;
/// let found = lyapunov_exponents(&Saddle, &start, 2, 1.0, 200, Tolerance::relative(1e-10)?)?;
/// assert!((found.exponents[0] - 1.0).abs() < 1e-2 && (found.exponents[1] + 1.0).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// The variations of W(9.10).
pub fn lyapunov_exponents(
    hamiltonian: &impl PhaseFunction,
    start: &PhasePoint,
    count: usize,
    interval: f64,
    intervals: usize,
    tolerance: Tolerance,
) -> Result<LyapunovExponents, HamiltonianError> {
    lyapunov_exponents_observed(hamiltonian, start, count, (interval, intervals), tolerance, |_| {
        ControlFlow::Continue(())
    })
}

/// [`lyapunov_exponents`] over `(interval, intervals)` with an observer that gets the number of intervals done and may stop the
/// run: then the exponents are those of the time until then.
///
/// # Errors
/// As [`lyapunov_exponents`].
pub fn lyapunov_exponents_observed(
    hamiltonian: &impl PhaseFunction,
    start: &PhasePoint,
    count: usize,
    (interval, intervals): (f64, usize),
    tolerance: Tolerance,
    mut observer: impl FnMut(usize) -> ControlFlow<()>,
) -> Result<LyapunovExponents, HamiltonianError> {
    check_finite("interval", &[interval])?;
    if interval <= 0.0 {
        return Err(HamiltonianError::NotPositive { quantity: "interval", value: interval });
    }
    if intervals == 0 {
        return Err(HamiltonianError::TooFewSamples { found: 0, needed: 1 });
    }
    let n = start.q().len();
    let dimension = 2 * n;
    if dimension < count {
        return Err(HamiltonianError::WrongLength { quantity: "exponents", expected: dimension, found: count });
    }
    // (q, p), the action, and the variations.
    let mut values = [start.q(), start.p(), &[0.0]].concat();
    for j in 0..count {
        // In general position: none starts in an invariant plane of a symmetric system.
        values.extend((0..dimension).map(|i| if i == j { 1.0 } else { 0.1 / f64::from(1 + u32::from(i < j)) }));
    }
    orthonormalise(&mut values[dimension + 1..], dimension, |_, _| {});
    let mut sums = vec![0.0; count];
    let (mut times, mut history) = (Vec::with_capacity(intervals), Vec::with_capacity(intervals));
    let mut method = DormandPrince853::new(tolerance);
    let mut elapsed = 0.0;
    for _ in 0..intervals {
        let (from, to) = (start.time() + elapsed, start.time() + (elapsed + interval));
        let refused = |source| HamiltonianError::Run { time: from, source: Box::new(source) };
        let mut field = RayField::new(hamiltonian, n, count);
        let mut state = State::new(from, values).map_err(|error| refused(error.with_field_error()))?;
        method.integrate_to(&mut field, &mut state, to).map_err(refused)?;
        values = state.values;
        values[dimension] = 0.0;
        orthonormalise(&mut values[dimension + 1..], dimension, |j, length: f64| sums[j] += length.ln());
        elapsed += interval;
        times.push(elapsed);
        history.push(sums.first().map_or(0.0, |sum| sum / elapsed));
        if observer(times.len()).is_break() {
            break;
        }
    }
    let exponents = sums.iter().map(|sum| if 0.0 < elapsed { sum / elapsed } else { 0.0 }).collect();
    let end = PhasePoint::new(&values[..n], &values[n..dimension], start.time() + elapsed)?;
    Ok(LyapunovExponents { exponents, times, history, end })
}

/// Makes vectors orthonormal one after another; `seen` gets the length of each before.
fn orthonormalise(vectors: &mut [f64], dimension: usize, mut seen: impl FnMut(usize, f64)) {
    for j in 0..vectors.len() / dimension.max(1) {
        let (before, rest) = vectors.split_at_mut(j * dimension);
        let vector = &mut rest[..dimension];
        // Twice is enough: what the first leaves of the others is rounding.
        for _ in 0..2 {
            for other in before.chunks_exact(dimension) {
                let along: f64 = vector.iter().zip(other).map(|(a, b)| a * b).sum();
                for (a, b) in vector.iter_mut().zip(other) {
                    *a -= along * b;
                }
            }
        }
        let length = vector.iter().map(|a| a * a).sum::<f64>().sqrt();
        for a in vector.iter_mut() {
            *a /= length;
        }
        seen(j, length);
    }
}
