//! The inverse of the Legendre map: the velocities that belong to momenta.

use piola_kinematics::Holonomic;
use piola_numerics::linear::ldlt;
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Mask, NumericsError, Real};

use super::conditioning::trusted_pivot;
use super::energy::With;
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::check_length;

/// Newton steps after which the inversion is given up.
const NEWTON_ITERATIONS: usize = 50;
/// How often one of them is halved.
const HALVINGS: usize = 40;

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The velocities that belong to momenta: the inverse of the Legendre map.
    ///
    /// ```text
    /// ∂L/∂q̇ (q, q̇, t) = p
    /// ```
    ///
    /// One solve with the metric when the potential does not depend on velocities, or is declared linear in
    /// them. Otherwise Newton's iteration
    /// from q̇ = 0, with steps that are halved where they leave the domain of L or overshoot: it converges when
    /// L is convex in q̇ and p lies in the range of ∂L/∂q̇. [`Self::legendre_certificate`] vouches for the result.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`], [`LagrangianError::SingularMetric`],
    /// [`LagrangianError::LegendreNotConverged`].
    ///
    /// # Accuracy
    /// A few ulp times the condition number of ∂²L/∂q̇∂q̇ scaled to unit diagonal.
    ///
    /// # Source
    /// W(9.4).
    pub fn velocities_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        p: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        check_length("p", n, p.len())?;
        check_length("q̇", n, out.len())?;
        if P::VELOCITY_DEPENDENT && !P::LINEAR_IN_VELOCITIES {
            // The buffers are lent, so that the workspace can be used beside them.
            let mut residual = core::mem::take(&mut work.linear);
            let mut step = core::mem::take(&mut work.force);
            let result = self.invert_by_newton(work, (q, p, t), &mut residual, &mut step, out);
            work.linear = residual;
            work.force = step;
            result?;
        } else {
            out.copy_from_slice(p);
            if S::TIME_DEPENDENT || P::VELOCITY_DEPENDENT {
                let mut linear = core::mem::take(&mut work.linear);
                linear.clear();
                linear.resize(2 * n, T::zero());
                let (zero, momenta) = linear.split_at_mut(n);
                self.differentiate(work, q, zero, t, With::Velocities, momenta);
                for (out, &linear) in out.iter_mut().zip(&*momenta) {
                    *out -= linear;
                }
                work.linear = linear;
            }
            self.form_inertia_metric(work, q, t);
            self.solve_with_metric(work, (q, p, t), out)?;
        }
        if out.iter().fold(T::Mask::splat(true), |all, v| all & v.is_finite()).all() {
            Ok(())
        } else {
            Err(self.explain_non_finite([("q", q), ("p", p)], t, ("q̇", out)))
        }
    }

    /// Overwrites b with the solution of g x = b, g being in `work.metric`; from rows where g is ill-conditioned.
    pub(super) fn solve_with_metric<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, p, t): (&[T], &[T], T),
        b: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        match ldlt::factor_and_grade_in_place(&mut work.metric, n, trusted_pivot::<T>()) {
            Ok(sound) => {
                if !sound.all() {
                    work.force.clear();
                    work.force.extend_from_slice(b);
                }
                ldlt::solve_in_place(&work.metric, n, b)?;
                if !sound.all() {
                    let refused = self.refine_velocities_by_least_squares(work, (q, t), sound, b).err();
                    if let Some(error) = refused {
                        return Err(self.explain(error, [("q", q), ("p", p)], t, work));
                    }
                }
                Ok(())
            }
            Err(error) => {
                work.force.clear();
                work.force.extend_from_slice(b);
                match self.refine_velocities_by_least_squares(work, (q, t), T::Mask::splat(false), b) {
                    Ok(true) => Ok(()),
                    _ => Err(self.explain(error, [("q", q), ("p", p)], t, work)),
                }
            }
        }
    }

    /// Overwrites b with the solution of H x = b, H being in `work.metric`, where its factors are left.
    pub(super) fn solve_with_hessian<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, p, t): (&[T], &[T], T),
        b: &mut [T],
    ) -> Result<(), LagrangianError> {
        let solved = ldlt::factor_in_place(&mut work.metric, q.len())
            .and_then(|()| ldlt::solve_in_place(&work.metric, q.len(), b));
        solved.map_err(|error: NumericsError| self.explain(error, [("q", q), ("p", p)], t, work))
    }

    /// Newton's iteration for ∂L/∂q̇ = p. It seeks the maximum of the concave function p·q̇ − L: a step is too
    /// long where the slope behind it is steeper downwards than it was upwards.
    fn invert_by_newton<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, p, t): (&[T], &[T], T),
        residual: &mut Vec<T>,
        step: &mut Vec<T>,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        let resolution = unit_in_last_place::<T>();
        // Corrections below are made of rounding where the Hessian is poorly conditioned.
        let noise = 1e3 * resolution;
        residual.clear();
        residual.resize(n, T::zero());
        out.fill(T::zero());
        let remainder = |work: &mut Workspace<T>, v: &[T], residual: &mut [T]| {
            self.differentiate(work, q, v, t, With::Velocities, residual);
            for (residual, &p) in residual.iter_mut().zip(p) {
                *residual = p - *residual;
            }
        };
        remainder(work, out, residual);
        let (mut correction, mut previous) = (f64::INFINITY, f64::INFINITY);
        for iteration in 1..=NEWTON_ITERATIONS {
            self.form_inertia_metric(work, q, t);
            let Workspace { nested, metric, .. } = &mut *work;
            self.subtract_velocity_hessian(nested, q, out, t, metric, q.len());
            step.clear();
            step.extend_from_slice(residual);
            self.solve_with_hessian(work, (q, p, t), step)?;
            let slope = |residual: &[T], lane: usize| -> f64 {
                residual.iter().zip(&*step).map(|(r, s)| r.primal(lane) * s.primal(lane)).sum()
            };
            // The slopes before the step, kept where the factors are no longer needed.
            work.metric.clear();
            work.metric.extend_from_slice(residual);
            let (mut fraction, mut taken) = (1.0, 0.0);
            for halving in 0..=HALVINGS {
                let change = T::lit(fraction - taken);
                for (v, &step) in out.iter_mut().zip(&*step) {
                    *v += change * step;
                }
                taken = fraction;
                remainder(work, out, residual);
                correction = largest_ratio(step, out);
                let goes_on = |lane: usize| {
                    let (before, behind) = (slope(&work.metric, lane), slope(residual, lane));
                    -before <= behind && behind < f64::INFINITY
                };
                // Steps near convergence are made of rounding: they are taken as they are.
                if correction <= noise || halving == HALVINGS || (0..T::LANES).all(goes_on) {
                    break;
                }
                fraction *= 0.5;
            }
            // Derivatives converge one step after the value.
            let stagnates = correction <= noise && previous <= 2.0 * correction;
            if 1 < iteration && (correction <= 4.0 * resolution || stagnates) {
                return Ok(());
            }
            previous = correction;
        }
        if correction <= resolution.sqrt() {
            Ok(())
        } else {
            Err(LagrangianError::LegendreNotConverged { iterations: NEWTON_ITERATIONS, correction })
        }
    }
}

/// max|a|/max|b| of the worst lane; NaN where a number is.
fn largest_ratio<T: Real>(a: &[T], b: &[T]) -> f64 {
    let largest = |values: &[T], lane: usize| {
        values.iter().map(|x| x.primal(lane).abs()).fold(0.0, |m: f64, x| if x <= m || m.is_nan() { m } else { x })
    };
    let mut worst = 0.0;
    for lane in 0..T::LANES {
        let (a, b) = (largest(a, lane), largest(b, lane));
        let ratio = if a <= 0.0 { 0.0 } else { a / b };
        worst = if ratio <= worst || f64::is_nan(worst) { worst } else { ratio };
    }
    worst
}
