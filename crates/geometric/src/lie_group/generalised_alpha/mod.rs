//! The generalised-α method on Lie groups: implicit, of order 2, with damping of fast vibrations that is chosen.
//!
//! For the motion of mechanical systems whose configuration q is an element of a group and whose velocity v is in its algebra:
//!
//! ```text
//! q̇ = q v,     M(q) v̇ = f(t, q, v)
//!
//! qₙ₊₁ = qₙ exp(h vₙ + h² ((½ − β) aₙ + β aₙ₊₁))        M v̇ₙ₊₁ = f(tₙ₊₁, qₙ₊₁, vₙ₊₁)
//! vₙ₊₁ = vₙ + h ((1 − γ) aₙ + γ aₙ₊₁)                   (1 − α_m) aₙ₊₁ + α_m aₙ = (1 − α_f) v̇ₙ₊₁ + α_f v̇ₙ
//!
//! α_m = (2ρ − 1)/(ρ + 1),   α_f = ρ/(ρ + 1),   γ = ½ + α_f − α_m,   β = ¼ (γ + ½)²
//! ```
//!
//! ρ = ρ∞ is the factor by which a step shrinks vibrations that are infinitely fast. The sequence a approximates v̇ at times that
//! are shifted by (`α_m` − `α_f`) h; a run begins it with a = v̇.
//!
//! # References
//! J. Chung & G. M. Hulbert, J. Appl. Mech. 60 (1993) 371; O. Brüls, A. Cardona & M. Arnold, *Lie group generalized-α time
//! integration of constrained flexible multibody systems*, Mech. Mach. Theory 48 (2012) 121.

mod newton;

use core::ops::ControlFlow;

use piola_integrators::internal::{DIRECTIONS, check_step};
use piola_integrators::{Checkpoint, IntegratorsError, Report, State, Step, resumed_run, unobserved};
use piola_numerics::{Gradient, Real};

use self::newton::Workspace;
use super::LieGroup;
use super::run::check_start;
use crate::fixed_step::take_equal_steps;
use crate::kept::{Kept, checkpoint_of};

/// A mechanical system on a Lie group: q̇ = q v, M(q) v̇ = f(t, q, v), generic over its scalar.
///
/// The velocity v is that in the frame of the body, as [`GroupField`](crate::GroupField) has it.
///
/// # Example
/// See [`GeneralisedAlpha`].
#[doc(alias("equation of motion", "mass matrix", "multibody"))]
pub trait GroupMotion<T: Real = f64> {
    /// Why an evaluation can fail; [`Infallible`](core::convert::Infallible) when it cannot.
    type Error;
    /// The group of the configurations.
    type Group: LieGroup<T>;
    /// The group of the configurations.
    fn group(&self) -> &Self::Group;
    /// Writes M(q) v̇ − f(t, q, v) to `residual`. All but `element` have the dimension of the group.
    ///
    /// # Errors
    /// Whatever makes the residual undefined.
    fn residual(
        &mut self,
        t: f64,
        element: &[T],
        velocity: &[T],
        acceleration: &[T],
        residual: &mut [T],
    ) -> Result<(), Self::Error>;
}

/// The parameters of the method.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Parameters {
    alpha_m: f64,
    alpha_f: f64,
    beta: f64,
    gamma: f64,
}

impl Parameters {
    /// The displacement and the increment of the velocity in a step that begins at (v, a, v̇) and ends at the acceleration
    /// `end`, and the a there.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn increments<T: Real>(self, h: f64, v: T, a: T, acceleration: T, end: T) -> (T, T, T) {
        let Self { alpha_m, alpha_f, beta, gamma } = self;
        let lit = T::lit;
        let next = (lit(1.0 - alpha_f) * end + lit(alpha_f) * acceleration - lit(alpha_m) * a) / lit(1.0 - alpha_m);
        let h = lit(h);
        let displacement = h * (v + h * (lit(0.5 - beta) * a + lit(beta) * next));
        (displacement, h * (lit(1.0 - gamma) * a + lit(gamma) * next), next)
    }
}

/// The generalised-α method with a fixed step, for stiff mechanical systems on a Lie group.
///
/// The state is the element q and then the velocity v. A step solves for the acceleration at its end by Newton's iteration,
/// whose matrix is exact: the residual is evaluated over numbers that carry four derivatives each, and so is the exponential
/// before it. Systems are therefore generic over their scalar. Two or three iterations are usual; after thirty the step is
/// given up.
///
/// | ρ∞ | vibrations with hω → ∞ | |
/// |---|---|---|
/// | 1 | are kept | [`newmark`](Self::newmark), the trapezoidal rule |
/// | 0.8 to 0.9 | lose a fifth to a tenth in each step | usual |
/// | 0 | are gone after three steps | |
///
/// Linear vibrations are stable at any step for any ρ∞ ≤ 1.
///
/// # Accuracy
/// Global error O(h²) in q and v. The linear oscillator keeps its energy to rounding with ρ∞ = 1. A step rounds a vibration of
/// frequency ω by (hω)² ulp of its amplitude. Each run begins with a = v̇: a run that is cut in two differs from one in one
/// piece by O(h²), unless [`resume`](Self::resume) continues it.
///
/// # Example
/// ```
/// use core::convert::Infallible;
/// use piola_geometric::{GeneralisedAlpha, GroupMotion, Rotations};
/// use piola_integrators::State;
/// use piola_numerics::Real;
/// struct Brake; // a ball of unit inertia whose turning is braked: ω̇ = −ω
/// impl<T: Real> GroupMotion<T> for Brake {
///     type Error = Infallible;
///     type Group = Rotations;
///     fn group(&self) -> &Rotations {
///         &Rotations
///     }
///     fn residual(&mut self, _t: f64, _q: &[T], omega: &[T], rate: &[T], out: &mut [T]) -> Result<(), Infallible> {
///         for i in 0..3 {
///             out[i] = rate[i] + omega[i];
///         }
///         Ok(())
///     }
/// }
/// // About x with 1 rad/s: after the time t the angle is 1 − e⁻ᵗ.
/// let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0])?;
/// GeneralisedAlpha::new(0.8, 0.01)?.integrate_to(&mut Brake, &mut state, 1.0)?;
/// let angle = 1.0 - (-1.0_f64).exp();
/// assert!((state.values[1] - (0.5 * angle).sin()).abs() < 1e-5);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("generalized-alpha", "Chung-Hulbert", "Newmark", "HHT", "numerical damping"))]
#[derive(Clone, Debug)]
pub struct GeneralisedAlpha<T = f64> {
    parameters: Parameters,
    step: f64,
    work: Workspace<T>,
}

impl<T: Real> GeneralisedAlpha<T> {
    /// The method with the spectral radius ρ∞ at infinity whose steps are no longer than `step` (s).
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidDamping`] unless 0 ≤ ρ∞ ≤ 1, [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    pub fn new(spectral_radius: f64, step: f64) -> Result<Self, IntegratorsError> {
        if !(0.0 <= spectral_radius && spectral_radius <= 1.0) {
            return Err(IntegratorsError::InvalidDamping { spectral_radius });
        }
        let rho = spectral_radius;
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 + alpha_f - alpha_m;
        Self::of(Parameters { alpha_m, alpha_f, beta: 0.25 * (gamma + 0.5) * (gamma + 0.5), gamma }, step)
    }

    /// Newmark's method with β = ¼ and γ = ½, constant average acceleration: a = v̇, no damping.
    ///
    /// With exact arithmetic it is the method with ρ∞ = 1.
    ///
    /// # Errors
    /// [`IntegratorsError::InvalidStep`] unless 0 < step < ∞.
    #[doc(alias("Lie-Newmark", "trapezoidal rule"))]
    pub fn newmark(step: f64) -> Result<Self, IntegratorsError> {
        Self::of(Parameters { alpha_m: 0.0, alpha_f: 0.0, beta: 0.25, gamma: 0.5 }, step)
    }

    fn of(parameters: Parameters, step: f64) -> Result<Self, IntegratorsError> {
        check_step(step)?;
        Ok(Self { parameters, step, work: Workspace::new() })
    }

    /// The longest step, s.
    #[must_use]
    pub const fn step(&self) -> f64 {
        self.step
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step), unobserved.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate).
    pub fn integrate_to<F>(
        &mut self,
        system: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<Report, IntegratorsError<F::Error>>
    where
        F: GroupMotion<Gradient<T, DIRECTIONS>, Group: LieGroup<T>>,
    {
        self.integrate(system, state, end, unobserved)
    }

    /// Integrates to `end` in equal steps no longer than [`step`](Self::step); backwards if `end` is earlier than the
    /// state's time, where what is damped grows. The observer sees every step and may stop the run.
    ///
    /// # Errors
    /// The state does not fit, is not finite or does not begin with an element of the group; the step is too small to advance
    /// the time; the system fails or gives a residual that is not finite; its matrix is singular
    /// ([`IntegratorsError::SingularMatrix`]) or Newton's iteration does not converge ([`IntegratorsError::StagesDiverged`]). The
    /// state then stands at the last complete step.
    pub fn integrate<F>(
        &mut self,
        system: &mut F,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>>
    where
        F: GroupMotion<Gradient<T, DIRECTIONS>, Group: LieGroup<T>>,
    {
        self.run(system, None, state, end, observer)
    }

    checkpoint_of!(work, "GeneralisedAlpha");

    resumed_run!(
        <F> [F: GroupMotion<Gradient<T, DIRECTIONS>, Group: LieGroup<T>>] system: &mut F, IntegratorsError<F::Error>
    );

    fn run<F>(
        &mut self,
        system: &mut F,
        resumed: Option<&Checkpoint<T>>,
        state: &mut State<T>,
        end: f64,
        observer: impl FnMut(Step<'_, T>) -> ControlFlow<()>,
    ) -> Result<Report, IntegratorsError<F::Error>>
    where
        F: GroupMotion<Gradient<T, DIRECTIONS>, Group: LieGroup<T>>,
    {
        let (length, n) = newton::lengths::<T, _>(system.group());
        self.work.resize(length, n);
        let Self { parameters, work, .. } = self;
        let check = |state: &mut State<T>| check_start::<T, _>(system.group(), n, state, end);
        let mut before = work.start(Self::NAME, resumed, state, check)?;
        if (end - state.time).abs() <= 0.0 {
            return Ok(before);
        }
        if resumed.is_none() {
            before.evaluations += work.begin(*parameters, system, state)?;
        }
        take_equal_steps((before, self.step), state, end, observer, |state, h| {
            work.advance(*parameters, system, state, h)
        })
    }
}
