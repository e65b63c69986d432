//! How far a function U(q, t) is from solving the Hamilton–Jacobi equation.
//!
//! ```text
//! ∂U/∂t + H(q, ∂U/∂q, t) = r        H(q, ∂S/∂q) − E = r                                    W(11.19)
//! ```

use piola_numerics::{Gradient, Real};

use crate::HamiltonianError;
use crate::PhaseFunction;
use crate::check::check_finite;
use crate::partial_derivatives::Slopes;

/// A function U(q, t) of events, written once for any scalar: a solution, a candidate, or initial data.
///
/// # Example
/// See [`Candidate`].
///
/// # Source
/// W(11.21).
pub trait PrincipalFunction {
    /// U(q, t), J s.
    fn value<T: Real>(&self, q: &[T], t: T) -> T;
}

impl<U: PrincipalFunction> PrincipalFunction for &U {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        (**self).value(q, t)
    }
}

/// What is left of the Hamilton–Jacobi equation, with the terms that should cancel.
///
/// # Example
/// See [`Candidate`].
///
/// # Source
/// W(11.19).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Residual<T = f64> {
    /// ∂U/∂t + H(q, ∂U/∂q, t), or H(q, ∂S/∂q) − E, J.
    pub value: T,
    /// ∂U/∂t, or −E, J.
    pub time_derivative: T,
    /// H(q, ∂U/∂q, t), J.
    pub energy: T,
}

/// A candidate U(q, t) for a solution of the Hamilton–Jacobi equation of H.
///
/// ```text
/// r = ∂U/∂t + H(q, ∂U/∂q, t)
/// ```
///
/// No evaluation allocates after the first.
///
/// # Example
/// A free particle: U = m (q − Q)²/(2t) solves, and p = m (q − Q)/t.
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{Candidate, PrincipalFunction};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Free; // m = 2
/// impl PhaseFunction for Free {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.25) * p[0] * p[0]
///     }
/// }
/// struct Action;
/// impl PrincipalFunction for Action {
///     fn value<T: Real>(&self, q: &[T], t: T) -> T {
///         q[0] * q[0] / t
///     }
/// }
/// let mut candidate = Candidate::new(Free, Action);
/// let residual = candidate.residual(&[3.0], 2.0)?;
/// assert_eq!((residual.value, residual.time_derivative, residual.energy), (0.0, -2.25, 2.25));
/// assert_eq!(candidate.momenta(), [3.0]);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(11.19), W(12.1).
#[derive(Clone, Debug)]
pub struct Candidate<H, U, T = f64> {
    hamiltonian: H,
    function: U,
    slopes: Slopes<T>,
}

impl<H: PhaseFunction, U: PrincipalFunction, T: Real> Candidate<H, U, T> {
    /// A candidate for the equation of a Hamiltonian.
    #[must_use]
    pub fn new(hamiltonian: H, function: U) -> Self {
        Self { hamiltonian, function, slopes: Slopes::new() }
    }

    /// What is left of the equation at an event.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`] where q, t, or a derivative of U is not finite, or H.
    ///
    /// # Accuracy
    /// A few ulp of the terms of U and H.
    pub fn residual(&mut self, q: &[T], t: T) -> Result<Residual<T>, HamiltonianError> {
        check_finite("q", q)?;
        check_finite("t", &[t])?;
        let Self { function, slopes, .. } = self;
        slopes.of(&q.iter().copied().chain([t]), |x| {
            let (t, q) = x.split_last().map_or((Gradient::constant(T::zero()), x), |(t, q)| (*t, q));
            function.value(q, t)
        });
        check_finite("∂U/∂(q, t)", &self.slopes.partials)?;
        let (p, time_derivative) = (&self.slopes.partials[..q.len()], self.slopes.partials[q.len()]);
        let energy = self.hamiltonian.value(q, p, t);
        check_finite("H", &[energy])?;
        Ok(Residual { value: time_derivative + energy, time_derivative, energy })
    }

    /// The momenta p = ∂U/∂q at the event of the last [`residual`](Self::residual).
    #[must_use]
    pub fn momenta(&self) -> &[T] {
        self.slopes.partials.split_last().map_or(&[], |(_, momenta)| momenta)
    }

    /// U at the event of the last [`residual`](Self::residual), J s.
    #[must_use]
    pub fn value(&self) -> T {
        self.slopes.value
    }
}

/// A candidate S(q) for the time-independent equation H(q, ∂S/∂q) = E, where H does not depend on time.
///
/// The whole solution is U = S(q) − E t. S is a [`PrincipalFunction`] that is asked at t = 0.
///
/// # Example
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{PrincipalFunction, StationaryCandidate};
/// use piola_hamiltonian::PhaseFunction;
/// use piola_numerics::Real;
/// struct Free; // m = 1
/// impl PhaseFunction for Free {
///     fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * p[0] * p[0]
///     }
/// }
/// struct Plane;
/// impl PrincipalFunction for Plane {
///     fn value<T: Real>(&self, q: &[T], _t: T) -> T {
///         T::lit(3.0) * q[0]
///     }
/// }
/// assert_eq!(StationaryCandidate::new(Free, Plane, 4.0).residual(&[1.0])?.value, 0.5);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(11.19) with U = S − E t.
#[derive(Clone, Debug)]
pub struct StationaryCandidate<H, U, T = f64> {
    candidate: Candidate<H, U, T>,
    energy: T,
}

impl<H: PhaseFunction, U: PrincipalFunction, T: Real> StationaryCandidate<H, U, T> {
    /// A candidate for H = `energy`, J.
    #[must_use]
    pub fn new(hamiltonian: H, function: U, energy: T) -> Self {
        Self { candidate: Candidate::new(hamiltonian, function), energy }
    }

    /// H(q, ∂S/∂q) − E.
    ///
    /// # Errors
    /// [`HamiltonianError::NotFinite`].
    pub fn residual(&mut self, q: &[T]) -> Result<Residual<T>, HamiltonianError> {
        let found = self.candidate.residual(q, T::zero())?;
        Ok(Residual { value: found.energy - self.energy, time_derivative: -self.energy, energy: found.energy })
    }

    /// The momenta p = ∂S/∂q of the last [`residual`](Self::residual).
    #[must_use]
    pub fn momenta(&self) -> &[T] {
        self.candidate.momenta()
    }
}
