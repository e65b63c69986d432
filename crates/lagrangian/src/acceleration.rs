//! Lagrange's equations solved for the accelerations.

use nalgebra::DVector;
use piola_kinematics::Holonomic;
use piola_numerics::linear::ldlt;
use piola_numerics::{Dual, Gradient, Jet, Mask, NumericsError, Real};

use super::collect::Equations;
use super::conditioning::trusted_pivot;
use super::directions::{with_directions, with_exact_directions};
use super::workspace::Workspace;
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;
use crate::check::{check_finite, check_length};

/// The mass matrix (lower triangle by columns) and the forcing of at most N coordinates.
struct Formed<T, const N: usize> {
    metric: [[T; N]; N],
    force: [T; N],
}

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// The accelerations q̈ that Lagrange's equations give.
    ///
    /// ```text
    /// g_ΔΓ q̈^Γ = Q_Δ − Σ m ∂x/∂q^Δ·ẍ₀ − …                         W(5.31), W(6.3)
    /// ```
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, q̇ | `q`, `v` | n | the coordinates' own |
    /// | t | `t` | scalar | s |
    /// | q̈ | returned | n | the coordinates' own / s² |
    ///
    /// One pass of the placement gives the inertia metric and the accelerations at q̈ = 0; Christoffel
    /// symbols are not formed.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`] and
    /// [`LagrangianError::SingularMetric`], which names a motion without inertia; then also what
    /// [`check`](Self::check) finds wrong with the parts. A negative mass that leaves the metric positive is
    /// not noticed here, but by `check`.
    ///
    /// # Accuracy
    /// A few ulp times κ, the condition number of the metric scaled to unit diagonal, as long as κ is below 10⁷
    /// or so. Beyond, the accelerations are found from the rows √m ∂x/∂q of the placement, without the metric:
    /// the error is then of a few ulp times √κ, and κ ulp only of what an ulp of q or of a force on the
    /// coordinates themselves would change too. The difference is noticed by the pivots of the metric, at no
    /// cost. Where the potential is not linear in the velocities, the metric is used throughout.
    ///
    /// # Source
    /// W(5.31), W(6.3).
    pub fn acceleration<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.acceleration_into(&mut Workspace::default(), q, v, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`acceleration`](Self::acceleration) to the caller's memory, without allocation once `work` has been
    /// used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    #[inline]
    pub fn acceleration_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        self.accelerate(work, q, v, t, out)
    }

    /// [`acceleration_into`](Self::acceleration_into), inlined into kernels over lanes.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(super) fn accelerate<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        check_length("q̇", n, v.len())?;
        check_length("q̈", n, out.len())?;
        let solved = with_exact_directions!(n, N => self.acceleration_in_one_pass::<T, N>(work, q, v, t, out),
            beyond => self.acceleration_in_chunks(work, q, v, t, out));
        // NaN velocities and forces leave the metric as it is: they show in the result only.
        let finite = out.iter().fold(T::Mask::splat(true), |all, a| all & a.is_finite());
        match solved {
            Ok(()) if finite.all() => Ok(()),
            Ok(()) => Err(self.explain_non_finite([("q", q), ("q̇", v)], t, ("q̈", out))),
            Err(error) => Err(self.explain(error, [("q", q), ("q̇", v)], t, work)),
        }
    }

    /// The reason for results that are not finite.
    #[cold]
    pub(super) fn explain_non_finite<T: Real>(
        &self,
        state: [(&'static str, &[T]); 2],
        t: T,
        (quantity, result): (&'static str, &[T]),
    ) -> LagrangianError {
        let reason = self.check_given(state, t).and_then(|()| check_finite(quantity, result));
        reason.err().unwrap_or(LagrangianError::NotFinite { quantity, index: 0, value: f64::NAN })
    }

    /// The reason for a failed factorisation, in the terms of mechanics. `work.metric` holds the factors made.
    #[cold]
    pub(super) fn explain<T: Real>(
        &self,
        error: NumericsError,
        state: [(&'static str, &[T]); 2],
        t: T,
        work: &Workspace<T>,
    ) -> LagrangianError {
        if let Err(error) = self.check_given(state, t) {
            return error;
        }
        let n = state[0].1.len();
        match error {
            NumericsError::NotPositiveDefinite { pivot, value, diagonal } => {
                let mut direction = vec![T::zero(); n];
                if ldlt::null_direction_into(&work.metric, n, pivot, &mut direction).is_err() {
                    direction.clear();
                }
                // The lane that failed is the one with this pivot.
                let pivot_in = |lane: usize| work.metric.get(pivot * (n + 1)).map(|entry| entry.primal(lane).to_bits());
                let lane = (0..T::LANES).find(|&lane| pivot_in(lane) == Some(value.to_bits())).unwrap_or(0);
                let direction = direction.into_iter().map(|x| x.primal(lane)).collect();
                LagrangianError::SingularMetric { coordinate: pivot, pivot: value, diagonal, direction }
            }
            // Only the rows of a metric are solved that way: pivots are the squares of what is left of them.
            NumericsError::Singular { pivot, value, scale } => {
                let mut direction = vec![T::zero(); n];
                if work.least_squares.null_direction_into(pivot, &mut direction).is_err() {
                    direction.clear();
                }
                let direction = direction.into_iter().map(|x| x.primal(0)).collect();
                let (pivot, coordinate, diagonal) = (value * value, pivot, scale * scale);
                LagrangianError::SingularMetric { coordinate, pivot, diagonal, direction }
            }
            other => LagrangianError::Numerics(other),
        }
    }

    /// The mass matrix and the forcing of the equations of motion, `mass_matrix` q̈ = `forcing`.
    ///
    /// ```text
    /// M = g − ∂²V/∂q̇∂q̇
    /// f = Q − ∂V/∂q + (∂²V/∂q̇∂q) q̇ + ∂²V/∂q̇∂t − (Σ m ∂x/∂q·ẍ₀ + …)            W(5.31), W(6.3)
    /// ```
    ///
    /// M is the inertia metric where the potential does not depend on velocities, and always the Hessian
    /// ∂²L/∂q̇∂q̇. `mass_matrix` holds n² entries, (i, j) at `i + j n`; `forcing` n. Nothing is allocated once
    /// `work` has been used, and no Christoffel symbols are formed.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`]; [`LagrangianError::NotFinite`] and what [`check`](Self::check) finds
    /// wrong with the parts. A singular matrix is no error here.
    ///
    /// # Accuracy
    /// A few ulp of the terms summed.
    ///
    /// # Source
    /// W(5.31), W(6.3), W(7.3).
    pub fn equations_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        mass_matrix: &mut [T],
        forcing: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        check_length("q̇", n, v.len())?;
        check_length("mass matrix", n * n, mass_matrix.len())?;
        check_length("forcing", n, forcing.len())?;
        with_directions!(n, N => {
            let Formed { metric, force } = self.form_in_one_pass::<T, N>(work, q, v, t);
            for (i, (forcing, entry)) in forcing.iter_mut().zip(force).enumerate() {
                *forcing = entry;
                for j in i..n {
                    mass_matrix[j + i * n] = metric[i][j];
                    mass_matrix[i + j * n] = metric[i][j];
                }
            }
        }, beyond => return self.equations_in_chunks(work, (q, v, t), mass_matrix, forcing));
        self.check_equations((q, v, t), mass_matrix, forcing)
    }

    pub(super) fn check_equations<T: Real>(
        &self,
        (q, v, t): (&[T], &[T], T),
        mass_matrix: &[T],
        forcing: &[T],
    ) -> Result<(), LagrangianError> {
        let given = mass_matrix.iter().chain(forcing);
        if given.fold(T::Mask::splat(true), |all, a| all & a.is_finite()).all() {
            Ok(())
        } else {
            Err(self.explain_non_finite([("q", q), ("q̇", v)], t, ("equations of motion", forcing)))
        }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn form_in_one_pass<T: Real, const N: usize>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
    ) -> Formed<T, N> {
        let n = q.len();
        let mut coordinates = [Jet::<T, N>::constant(T::zero()); N];
        for (i, jet) in coordinates.iter_mut().take(n).enumerate() {
            *jet = Jet::coordinate(q[i], v[i], i);
        }
        let time = if S::TIME_DEPENDENT { Jet::time(t) } else { Jet::constant(t) };
        let mut equations = Equations::<T, S, P, F, N>::new(self, t);
        self.system.place(&coordinates[..n], time, &mut equations);
        let Equations { mut metric, mut force, .. } = equations;

        if P::PRESENT {
            if P::VELOCITY_DEPENDENT {
                self.add_velocity_dependence::<T, N>(work, q, v, t, metric.as_flattened_mut(), &mut force);
            } else {
                self.subtract_gradient::<T, N>(q, t, &mut force[..n]);
            }
        }
        if F::GENERALISED {
            self.forces.generalised(q, v, t, &mut force[..n]);
        }
        Formed { metric, force }
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration_in_one_pass<T: Real, const N: usize>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), NumericsError> {
        let n = q.len();
        let Formed { mut metric, mut force } = self.form_in_one_pass::<T, N>(work, q, v, t);
        for (i, column) in metric.iter_mut().enumerate().skip(n) {
            column[i] = T::one(); // directions that the system does not have
        }
        let factors = metric.as_flattened_mut();
        match ldlt::factor_and_grade_in_place(factors, N, trusted_pivot::<T>()) {
            Ok(sound) => {
                ldlt::solve_in_place(factors, N, &mut force)?;
                out.copy_from_slice(&force[..n]);
                if sound.all() { Ok(()) } else { self.refine_by_least_squares(work, (q, v, t), sound, out).map(|_| ()) }
            }
            Err(error) => {
                work.metric.clear();
                for column in factors.chunks(N).take(n) {
                    work.metric.extend_from_slice(&column[..n]);
                }
                self.solve_singular_by_least_squares(work, (q, v, t), error, out)
            }
        }
    }

    /// The accelerations where the metric cannot be factored, or else the error that says so.
    #[cold]
    #[inline(never)]
    pub(super) fn solve_singular_by_least_squares<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, v, t): (&[T], &[T], T),
        error: NumericsError,
        out: &mut [T],
    ) -> Result<(), NumericsError> {
        match self.refine_by_least_squares(work, (q, v, t), T::Mask::splat(false), out) {
            Ok(true) => Ok(()),
            _ => Err(error),
        }
    }

    /// −∂V/∂q where V does not depend on velocities.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn subtract_gradient<T: Real, const N: usize>(&self, q: &[T], t: T, force: &mut [T]) {
        let n = q.len();
        let mut coordinates = [Gradient::<T, N>::constant(T::zero()); N];
        for (i, (coordinate, &q)) in coordinates.iter_mut().zip(q).enumerate() {
            *coordinate = Gradient::variable(q, i);
        }
        let value = self.potential.potential(&coordinates[..n], &[], Gradient::constant(t));
        for (force, partial) in force.iter_mut().zip(value.partials) {
            *force -= partial;
        }
    }

    /// What a potential of velocities adds: −∂²V/∂q̇∂q̇ to the metric, and to the force, in one pass,
    ///
    /// ```text
    /// (∂²V/∂q̇∂q) q̇ + ∂²V/∂q̇∂t − ∂V/∂q = ∂/∂ε d/dt V(q, q̇ + ε, t)   along   q̇ − ε,  ṫ = 1,  q̈ = 0
    /// ```
    ///
    /// The coordinates move slower by the ε by which the velocities are more: see [`moving_against`].
    fn add_velocity_dependence<T: Real, const N: usize>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        metric: &mut [T],
        force: &mut [T; N],
    ) {
        let n = q.len();
        let zero = Gradient::<T, N>::constant(T::zero());
        let mut moving = [Dual::constant(zero); N];
        let mut rates = [Dual::constant(zero); N];
        for i in 0..n {
            [moving[i], rates[i]] = moving_against(q[i], v[i], i);
        }
        let value = self.potential.potential(&moving[..n], &rates[..n], Dual::variable(Gradient::constant(t)));
        for (force, partial) in force.iter_mut().zip(value.tangent.partials) {
            *force += partial;
        }
        if !P::LINEAR_IN_VELOCITIES {
            self.subtract_velocity_hessian(&mut work.nested, q, v, t, metric, N);
        }
    }
}

/// A coordinate that moves at v − ε, and its velocity v + ε, ε in the given direction: what d/dt V along them has
/// of ε is d/dt(∂V/∂q̇) − ∂V/∂q.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn moving_against<T: Real, const N: usize>(q: T, v: T, direction: usize) -> [Dual<Gradient<T, N>>; 2] {
    let mut slower = Gradient::variable(v, direction);
    slower.partials = slower.partials.map(|partial| -partial);
    [Dual::new(Gradient::constant(q), slower), Dual::constant(Gradient::variable(v, direction))]
}
