//! An extremal with its action and its variations.
//!
//! ```text
//! q̇ = H_p,   ṗ = −H_q,   Ṡ = p·H_p − H
//! δq̇ = H_pq δq + H_pp δp,   δṗ = −H_qq δq − H_qp δp
//! ```

use core::cmp::Ordering;
use core::ops::ControlFlow;

use piola_integrators::{DenseStep, DormandPrince853, DormandPrincePair, Field, State, Tolerance};
use piola_numerics::{Dual, Gradient, Real};

use super::partial_derivatives::Slopes;
use crate::HamiltonianError;
use crate::PhaseFunction;

/// Groups of components whose errors are measured against one size: q, p, S, δq, δp.
const GROUPS: usize = 5;

/// An extremal, its action and k of its variations (Jacobi fields) as a field, y = (q, p, S, δq₁, δp₁, δq₂, …).
///
/// The errors of a component are relative to the largest q (p, S, δq, δp) met since the field was made, so that
/// nothing is asked of a component that passes through zero. Evaluations do not allocate after the first.
///
/// # Example
/// An oscillator with its variation by the initial momentum, ∂q/∂p₀ = sin t.
/// ```
/// use piola_hamiltonian::hamilton_jacobi::RayField;
/// use piola_hamiltonian::PhaseFunction;
/// use piola_integrators::Field;
/// use piola_numerics::Real;
/// struct Oscillator;
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
///     }
/// }
/// let mut rate = [0.0; 5];
/// RayField::new(&Oscillator, 1, 1).rate(0.0, &[3.0, 4.0, 0.0, 0.0, 1.0], &mut rate)?;
/// assert_eq!(rate, [4.0, -3.0, 3.5, 1.0, 0.0]); // Ṡ = 16 − 12.5
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(12.4), W(13.1).
#[derive(Clone, Debug)]
pub struct RayField<'a, H, T = f64> {
    hamiltonian: &'a H,
    freedom: usize,
    variations: usize,
    point: Vec<Dual<T>>,
    slopes: Slopes<Dual<T>>,
    largest: [f64; GROUPS],
}

impl<'a, H: PhaseFunction, T: Real> RayField<'a, H, T> {
    /// The extremals of a Hamiltonian of n degrees of freedom, each with k variations.
    #[must_use]
    pub fn new(hamiltonian: &'a H, freedom: usize, variations: usize) -> Self {
        let point = Vec::with_capacity(2 * freedom);
        Self { hamiltonian, freedom, variations, point, slopes: Slopes::new(), largest: [0.0; GROUPS] }
    }

    /// The largest component met, of q, p, S, δq and δp.
    pub(crate) const fn sizes(&self) -> [f64; GROUPS] {
        self.largest
    }

    fn group(&self, component: usize) -> usize {
        let n = self.freedom;
        match component.cmp(&(2 * n)) {
            Ordering::Less => usize::from(n <= component),
            Ordering::Equal => 2,
            Ordering::Greater => 3 + usize::from(n <= (component - 2 * n - 1) % (2 * n)),
        }
    }

    fn sizes_with(&self, y: &[T]) -> [f64; GROUPS] {
        let mut sizes = self.largest;
        for (i, y) in y.iter().enumerate() {
            let size = &mut sizes[self.group(i)];
            for lane in 0..T::LANES {
                *size = size.max(y.primal(lane).abs());
            }
        }
        // Terms of the action cancel; p·q is their size.
        sizes[2] = sizes[2].max(sizes[0] * sizes[1]);
        sizes
    }
}

impl<H: PhaseFunction, T: Real> Field<T> for RayField<'_, H, T> {
    type Error = HamiltonianError;
    fn dimension(&self) -> usize {
        2 * self.freedom * (1 + self.variations) + 1
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), HamiltonianError> {
        let n = self.freedom;
        self.largest = self.sizes_with(y);
        let Self { hamiltonian, point, slopes, variations, .. } = self;
        let t = Gradient::constant(Dual::constant(T::lit(t)));
        for variation in 0..(*variations).max(1) {
            let first = 2 * n + 1 + 2 * n * variation;
            let varied = variation < *variations;
            point.clear();
            point.extend(
                (0..2 * n).map(|i| Dual { value: y[i], tangent: if varied { y[first + i] } else { T::zero() } }),
            );
            slopes.of(&point.iter().copied(), |x| {
                let (q, p) = x.split_at(n);
                hamiltonian.value(q, p, t)
            });
            let (h_q, h_p) = slopes.partials.split_at(n);
            if variation == 0 {
                let mut along = -slopes.value.value;
                for i in 0..n {
                    rate[i] = h_p[i].value;
                    rate[n + i] = -h_q[i].value;
                    along += y[n + i] * h_p[i].value;
                }
                rate[2 * n] = along;
            }
            if varied {
                for i in 0..n {
                    rate[first + i] = h_p[i].tangent;
                    rate[first + n + i] = -h_q[i].tangent;
                }
            }
        }
        Ok(())
    }
    fn magnitudes(&self, y: &[T], magnitudes: &mut [f64]) {
        let sizes = self.sizes_with(y);
        for (i, magnitude) in magnitudes.iter_mut().enumerate() {
            *magnitude = sizes[self.group(i)];
        }
    }
}

/// The end of a ray: y = (q, p, S, variations), and the sizes met on the way.
#[derive(Clone, Debug)]
pub(crate) struct RayEnd {
    pub(crate) freedom: usize,
    pub(crate) values: Vec<f64>,
    pub(crate) sizes: [f64; GROUPS],
}

impl RayEnd {
    pub(crate) fn coordinates(&self) -> &[f64] {
        &self.values[..self.freedom]
    }
    pub(crate) fn momenta(&self) -> &[f64] {
        &self.values[self.freedom..2 * self.freedom]
    }
    pub(crate) fn action(&self) -> f64 {
        self.values[2 * self.freedom]
    }
    /// Component i of variation j: δq for i < n, δp from n on.
    pub(crate) fn variation(&self, j: usize, i: usize) -> f64 {
        self.values[2 * self.freedom * (1 + j) + 1 + i]
    }
}

/// What sees the steps of a ray.
pub(crate) type Observed<'s, 'f, 'a, H> = &'s mut DenseStep<'f, DormandPrincePair, f64, RayField<'a, H>>;

/// Follows a ray from y = (q, p, S, variations); the observer sees every step.
pub(crate) fn follow<'a, H: PhaseFunction>(
    ray: (&'a H, usize, Tolerance),
    start: &[f64],
    times: (f64, f64),
    observer: impl FnMut(Observed<'_, '_, 'a, H>) -> Result<(), HamiltonianError>,
) -> Result<RayEnd, HamiltonianError> {
    follow_within(MOST_STEPS, ray, start, times, observer)
}

/// [`follow`] that gives up after a number of steps.
pub(crate) fn follow_within<'a, H: PhaseFunction>(
    most_steps: u64,
    (hamiltonian, freedom, tolerance): (&'a H, usize, Tolerance),
    start: &[f64],
    (t0, t1): (f64, f64),
    mut observer: impl FnMut(Observed<'_, '_, 'a, H>) -> Result<(), HamiltonianError>,
) -> Result<RayEnd, HamiltonianError> {
    let variations = (start.len() - 2 * freedom - 1) / (2 * freedom).max(1);
    let mut field = RayField::new(hamiltonian, freedom, variations);
    let run = |error| HamiltonianError::Run { time: t0, source: Box::new(error) };
    let mut state = State::new(t0, start.to_vec()).map_err(|error| run(error.with_field_error()))?;
    let mut failure = None;
    DormandPrince853::new(tolerance)
        .with_most_steps(most_steps)
        .integrate(&mut field, &mut state, t1, |step| match observer(step) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                failure = Some(error);
                ControlFlow::Break(())
            }
        })
        .map_err(|error| HamiltonianError::Run { time: state.time, source: Box::new(error) })?;
    match failure {
        Some(error) => Err(error),
        None => Ok(RayEnd { freedom, values: state.values, sizes: field.sizes() }),
    }
}

/// Steps after which a ray is given up: it runs into a singularity, or the time between events is absurd.
pub(crate) const MOST_STEPS: u64 = 200_000;
