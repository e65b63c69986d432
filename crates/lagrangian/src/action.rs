//! The action of a path and its first variation.
//!
//! ```text
//! I = ∫ L(q, q̇, t) dt                                                                       W(7.10)
//! δI = ∫ (∂L/∂q − d/dt ∂L/∂q̇)·η dt + [p·δq − h δt],    δq = η + q̇ δt                         W(7.18)
//! ```
//!
//! η is the variation at a fixed time; δt moves the ends. The variations of W(7.11) hold the ends fast, and the last
//! term is then zero.

use core::ops::Range;

use piola_integrators::Tolerance;
use piola_kinematics::Holonomic;
use piola_numerics::{Dual, Jet, Real};

use super::quadrature::integrate;
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// A path q(t) in the coordinates, written once for any scalar.
///
/// # Example
/// See [`Lagrangian::action`].
pub trait Path {
    /// The number of coordinates.
    fn freedom(&self) -> usize;
    /// Writes q(t), as many as [`freedom`](Self::freedom) says.
    fn at<T: Real>(&self, t: T, q: &mut [T]);
}

/// q(t) + ε η(t): a path varied. Each evaluation allocates room for η.
///
/// # Example
/// See [`Lagrangian::action`].
///
/// # Source
/// W(7.11).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Varied<'a, A, B> {
    /// q(t).
    pub path: &'a A,
    /// η(t).
    pub variation: &'a B,
    /// ε.
    pub amount: f64,
}

impl<A: Path, B: Path> Path for Varied<'_, A, B> {
    fn freedom(&self) -> usize {
        self.path.freedom()
    }
    fn at<T: Real>(&self, t: T, q: &mut [T]) {
        self.path.at(t, q);
        let mut variation = vec![T::zero(); q.len()];
        self.variation.at(t, &mut variation);
        for (q, eta) in q.iter_mut().zip(variation) {
            *q += T::lit(self.amount) * eta;
        }
    }
}

/// An action, J s, with a bound of its error.
///
/// # Example
/// See [`Lagrangian::action`].
///
/// # Source
/// W(7.10).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Action {
    /// I.
    pub value: f64,
    /// An estimate of |error|, on the safe side for smooth paths.
    pub error: f64,
}

/// The first variation of an action, J s per unit of the variation, and its two parts.
///
/// # Example
/// See [`Lagrangian::action`].
///
/// # Source
/// W(7.18).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FirstVariation {
    /// δI, differentiated exactly under the integral.
    pub value: f64,
    /// ∫ (∂L/∂q − d/dt ∂L/∂q̇)·η dt: zero for every η exactly when the path obeys Lagrange's equations.
    pub interior: f64,
    /// [p·δq − h δt] between the ends.
    pub end_points: f64,
    /// An estimate of the error of either integral.
    pub error: f64,
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The action of a path over a span of time.
    ///
    /// ```text
    /// I = ∫ L(q, q̇, t) dt
    /// ```
    ///
    /// Velocities are exact derivatives of the path; the integral is adaptive, by the rule of Gauss and Kronrod with
    /// 7 and 15 nodes. The tolerance is relative to ∫|L| dt.
    ///
    /// # Errors
    /// [`LagrangianError::NotFinite`]; [`LagrangianError::QuadratureNotConverged`].
    ///
    /// # Accuracy
    /// The error returned is at most the tolerance asked for and mostly far above the true one.
    ///
    /// # Example
    /// A stone of 2 kg thrown up with 10 m/s under 10 m/s²: L = v² − 20 z, ∫₀² = 200/3 − 400/3 J s.
    /// ```
    /// # use nalgebra::Vector3;
    /// # use piola_lagrangian::{Holonomic, Lagrangian, Path, Placement, Varied};
    /// # use piola_numerics::Real;
    /// use piola_integrators::Tolerance;
    /// # struct Stone;
    /// # impl Holonomic for Stone {
    /// #     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
    /// #         bodies.particle(2.0, Vector3::new(T::zero(), T::zero(), q[0]));
    /// #     }
    /// # }
    /// struct Throw;
    /// impl Path for Throw {
    ///     fn freedom(&self) -> usize {
    ///         1
    ///     }
    ///     fn at<T: Real>(&self, t: T, q: &mut [T]) {
    ///         q[0] = T::lit(10.0) * t - T::lit(5.0) * t * t;
    ///     }
    /// }
    /// let stone = Lagrangian::of(Stone).with_gravity(10.0);
    /// let action = stone.action(&Throw, 0.0..2.0, Tolerance::relative(1e-13)?)?;
    /// assert!((action.value + 200.0 / 3.0).abs() < 1e-12 && action.error < 1e-10);
    ///
    /// struct Shift; // by one metre: δI = [m v] = 2·(−10 − 10)
    /// impl Path for Shift {
    ///     fn freedom(&self) -> usize {
    ///         1
    ///     }
    ///     fn at<T: Real>(&self, _t: T, eta: &mut [T]) {
    ///         eta[0] = T::one();
    ///     }
    /// }
    /// let variation = stone.first_variation(&Throw, &Shift, 0.0..2.0, [0.0; 2], Tolerance::relative(1e-13)?)?;
    /// assert!((variation.value + 40.0).abs() < 1e-12 && (variation.end_points + 40.0).abs() < 1e-12);
    /// assert!(variation.interior.abs() < 1e-12); // the throw obeys Lagrange's equations
    /// let mut height = [0.0];
    /// Varied { path: &Throw, variation: &Shift, amount: 0.5 }.at(1.0, &mut height);
    /// assert_eq!(height, [5.5]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Source
    /// W(7.10).
    pub fn action(&self, path: &impl Path, times: Range<f64>, tolerance: Tolerance) -> Result<Action, LagrangianError> {
        check_finite("times", &[times.start, times.end])?;
        let n = path.freedom();
        let mut work = Workspace::default();
        let (mut moving, mut q, mut v) = (vec![Dual::constant(0.0); n], vec![0.0; n], vec![0.0; n]);
        let range = (times.start, times.end);
        let allowed = (tolerance.relative_part(), tolerance.absolute_part());
        let integrals = integrate(range, allowed, |t| {
            path.at(Dual::variable(t), &mut moving);
            for ((q, v), x) in q.iter_mut().zip(&mut v).zip(&moving) {
                (*q, *v) = (x.value, x.tangent);
            }
            Ok::<_, LagrangianError>([self.energies_with(&mut work, &q, &v, t)?.lagrangian()])
        })?;
        let ([value], [error]) = (integrals.values, integrals.errors);
        Ok(Action { value, error })
    }

    /// The first variation of the action of a path along a variation η(t), with the ends moved in time by
    /// `end_shifts` (s per unit of the variation).
    ///
    /// ```text
    /// δI = ∫ (∂L/∂q − d/dt ∂L/∂q̇)·η dt + [p·δq − h δt],    δq = η + q̇ δt
    /// ```
    ///
    /// The left side is differentiated exactly under the integral, the right side computed by itself: that they
    /// agree is a check of both. Applied forces are no part of the action.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`],
    /// [`LagrangianError::QuadratureNotConverged`].
    ///
    /// # Source
    /// W(7.16–7.18).
    pub fn first_variation(
        &self,
        path: &impl Path,
        variation: &impl Path,
        times: Range<f64>,
        end_shifts: [f64; 2],
        tolerance: Tolerance,
    ) -> Result<FirstVariation, LagrangianError> {
        let n = path.freedom();
        check_length("variation", n, variation.freedom())?;
        check_finite("times", &[times.start, times.end])?;
        check_finite("shifts of the ends", &end_shifts)?;
        let mut varied_work = Workspace::<Dual<f64>>::default();
        let mut work = Workspace::default();
        let jet = Jet::<f64, 0>::constant(0.0);
        let (mut q_jets, mut eta_jets) = (vec![jet; n], vec![jet; n]);
        let dual = Dual::constant(0.0);
        let (mut q_duals, mut v_duals) = (vec![dual; n], vec![dual; n]);
        let (mut q, mut v, mut a) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        let mut residual = vec![0.0; n];
        let range = (times.start, times.end);
        let allowed = (tolerance.relative_part(), tolerance.absolute_part());
        let integrals = integrate(range, allowed, |t| {
            path.at(Jet::time(t), &mut q_jets);
            variation.at(Jet::time(t), &mut eta_jets);
            for i in 0..n {
                (q[i], v[i], a[i]) = (q_jets[i].value, q_jets[i].rate, q_jets[i].second_rate);
                q_duals[i] = Dual::new(q[i], eta_jets[i].value);
                v_duals[i] = Dual::new(v[i], eta_jets[i].rate);
            }
            let energies = self.energies_with(&mut varied_work, &q_duals, &v_duals, Dual::constant(t))?;
            self.driving_forces_into(&mut work, &q, &v, &a, t, &mut residual)?;
            let interior = |sum: f64, (residual, eta): (&f64, &Jet<f64, 0>)| sum - residual * eta.value;
            let mut interior = residual.iter().zip(&eta_jets).fold(0.0, interior);
            if F::GENERALISED || F::ON_PARTS || F::MOMENTS {
                // The equations hold the applied forces, the action does not.
                residual.fill(0.0);
                self.add_generalised_forces(&mut work, &q, &v, t, &mut residual)?;
                interior -= residual.iter().zip(&eta_jets).map(|(force, eta)| force * eta.value).sum::<f64>();
            }
            Ok::<_, LagrangianError>([energies.lagrangian().tangent, interior])
        })?;
        // L δt of the moved ends on one side, p·δq − h δt on the other.
        let (mut moved, mut end_points) = (0.0, 0.0);
        for (sign, t, shift) in [(-1.0, times.start, end_shifts[0]), (1.0, times.end, end_shifts[1])] {
            path.at(Jet::time(t), &mut q_jets);
            variation.at(Jet::time(t), &mut eta_jets);
            for i in 0..n {
                (q[i], v[i]) = (q_jets[i].value, q_jets[i].rate);
            }
            let momenta = self.momenta(&q, &v, t)?;
            let shifted = |i: usize| momenta[i] * (eta_jets[i].value + v[i] * shift);
            end_points += sign * ((0..n).map(shifted).sum::<f64>() - self.jacobi_integral(&q, &v, t)? * shift);
            moved += sign * self.energies_with(&mut work, &q, &v, t)?.lagrangian() * shift;
        }
        let [value, interior] = integrals.values;
        Ok(FirstVariation {
            value: value + moved,
            interior,
            end_points,
            error: integrals.errors[0].max(integrals.errors[1]),
        })
    }
}
