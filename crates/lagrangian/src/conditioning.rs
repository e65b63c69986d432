//! Accelerations where the metric is ill-conditioned: from the rows of the placement, not from their squares.
//!
//! ```text
//! q̈ = argmin ½ Σ m |∂x/∂q q̈ + ẍ₀ − f/m|² − h·q̈          h: what potentials and generalised forces add
//! ```
//!
//! A metric of condition number κ, once formed, has lost κ ulp; its rows √m ∂x/∂q have the condition √κ.

use piola_kinematics::Holonomic;
use piola_numerics::{NumericsError, Real};

use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};

/// A pivot of the metric is trusted when it is more than this share of the diagonal entry it comes from. Its
/// reciprocal is at most the condition number of the metric scaled to unit diagonal, and seldom much less: all
/// those beyond 10¹⁰ are met with a margin of a thousand.
const TRUSTED_PIVOT: f64 = 1e-7;
/// The same over f32.
const TRUSTED_PIVOT_SINGLE: f64 = 1e-3;
/// A row is trusted as long as more than this share of it is left: the root of a pivot. Placements round, and
/// what coordinates that depend on each other leave is a few ulp, not a thousand.
const TRUSTED_ROW: f64 = 1e-11;
const TRUSTED_ROW_SINGLE: f64 = 1e-5;

/// The share of its diagonal entry that a pivot must exceed for the metric to be solved as it is.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn trusted_pivot<T: Real>() -> f64 {
    if is_single::<T>() { TRUSTED_PIVOT_SINGLE } else { TRUSTED_PIVOT }
}

fn is_single<T: Real>() -> bool {
    f64::EPSILON < piola_numerics::sums::unit_in_last_place::<T>()
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// Replaces accelerations by those from rows, in the lanes where the metric is not `sound`. They stay as
    /// they are where the metric is not made of rows alone: with a potential that is not linear in the
    /// velocities.
    ///
    /// `Ok(false)` says that nothing was replaced. `work.metric` is left as it is.
    #[cold]
    #[inline(never)]
    pub(super) fn refine_by_least_squares<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, v, t): (&[T], &[T], T),
        sound: T::Mask,
        out: &mut [T],
    ) -> Result<bool, NumericsError> {
        if P::VELOCITY_DEPENDENT && !P::LINEAR_IN_VELOCITIES && !self.is_linear_in_velocities(work, q, v, t) {
            return Ok(false);
        }
        self.collect_rows_with_rates(work, q, v, t);
        work.force.clear();
        work.force.resize(q.len(), T::zero());
        self.add_forces_without_parts(work, q, v, t);
        solve_by_rows(work, sound, out)
    }

    /// Replaces velocities, the solution of g q̇ = p − b, by those from rows. The right-hand side is in
    /// `work.force`.
    #[cold]
    #[inline(never)]
    pub(super) fn refine_velocities_by_least_squares<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, t): (&[T], T),
        sound: T::Mask,
        out: &mut [T],
    ) -> Result<bool, NumericsError> {
        work.rows.clear();
        self.collect_rows_from(work, q, t, 0);
        solve_by_rows(work, sound, out)
    }

    /// Whether ∂²V/∂q̇∂q̇ is zero at a state.
    pub(super) fn is_linear_in_velocities<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) -> bool {
        let n = q.len();
        let mut hessian = core::mem::take(&mut work.linear);
        hessian.clear();
        hessian.resize(n * n, T::zero());
        self.subtract_velocity_hessian(&mut work.nested, q, v, t, &mut hessian, n);
        let linear = hessian.iter().all(T::is_zero);
        work.linear = hessian;
        linear
    }
}

/// The rows with what is left of the forces on them, and `work.force` beside them.
fn solve_by_rows<T: Real>(work: &mut Workspace<T>, sound: T::Mask, out: &mut [T]) -> Result<bool, NumericsError> {
    let n = out.len();
    let Workspace { rows, force, least_squares, linear, .. } = work;
    least_squares.begin(n);
    linear.clear();
    linear.resize(n, T::zero());
    for (number, &mass) in rows.weights.iter().enumerate() {
        linear.fill(T::zero());
        rows.row_into(number, linear);
        let left = rows.residual.get(number).copied().unwrap_or_else(T::zero);
        if 0.0 < mass {
            let root = T::lit(mass.sqrt());
            least_squares.add_row(linear.iter().map(|&partial| root * partial), left / root)?;
        } else {
            // Forces on what has no mass act on the coordinates alone.
            for (force, &partial) in force.iter_mut().zip(&*linear) {
                *force += partial * left;
            }
        }
    }
    let share = if is_single::<T>() { TRUSTED_ROW_SINGLE } else { TRUSTED_ROW };
    least_squares.solve_in_place(force, share)?;
    for (out, &from_rows) in out.iter_mut().zip(&*force) {
        *out = T::select(sound, *out, from_rows);
    }
    Ok(true)
}
