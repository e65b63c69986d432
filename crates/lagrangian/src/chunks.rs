//! Lagrange's equations of more coordinates than one pass serves: passes over chunks of directions.

use piola_kinematics::Holonomic;
use piola_numerics::linear::ldlt;
use piola_numerics::{Dual, Gradient, Jet, Mask, NumericsError, Real};

use super::acceleration::moving_against;
use super::collect::Pass;
use super::conditioning::trusted_pivot;
use super::directions::{CHUNK, HESSIAN_CHUNK, LARGEST};
use super::workspace::{Twice, Workspace};
use super::{Forces, Lagrangian, Potential};
use crate::LagrangianError;

impl<S: Holonomic, P: Potential, F: Forces> Lagrangian<S, P, F> {
    /// [`equations_into`](Self::equations_into) by the code for any number of coordinates: for what is called once, where a pass for each
    /// number would be compiled for nothing. All slices fit.
    pub(super) fn equations_in_chunks<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, v, t): (&[T], &[T], T),
        mass_matrix: &mut [T],
        forcing: &mut [T],
    ) -> Result<(), LagrangianError> {
        self.form_in_chunks(work, q, v, t);
        work.complete_metric(q.len());
        mass_matrix.copy_from_slice(&work.metric);
        forcing.copy_from_slice(&work.force);
        self.check_equations((q, v, t), mass_matrix, forcing)
    }

    /// The accelerations q̈, with g = JᵀmJ from stored rows.
    pub(super) fn acceleration_in_chunks<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), NumericsError> {
        self.form_in_chunks(work, q, v, t);
        match ldlt::factor_and_grade_in_place(&mut work.metric, q.len(), trusted_pivot::<T>()) {
            Ok(sound) => {
                ldlt::solve_in_place(&work.metric, q.len(), &mut work.force)?;
                out.copy_from_slice(&work.force);
                if sound.all() { Ok(()) } else { self.refine_by_least_squares(work, (q, v, t), sound, out).map(|_| ()) }
            }
            Err(error) => self.solve_singular_by_least_squares(work, (q, v, t), error, out),
        }
    }

    /// Leaves the mass matrix in `work.metric` and the forcing in `work.force`.
    fn form_in_chunks<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) {
        let n = q.len();
        self.collect_rows_with_rates(work, q, v, t);
        work.form_metric(n);
        work.force.clear();
        work.force.resize(n, T::zero());
        work.rows.add_forces(&mut work.force);
        self.add_forces_without_parts(work, q, v, t);
        if P::VELOCITY_DEPENDENT && !P::LINEAR_IN_VELOCITIES {
            self.subtract_velocity_hessian(&mut work.nested, q, v, t, &mut work.metric, n);
        }
    }

    /// Adds to `work.force` what does not act on parts: the potential's and the generalised forces.
    pub(super) fn add_forces_without_parts<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) {
        if P::PRESENT {
            if P::VELOCITY_DEPENDENT {
                self.add_velocity_dependence_by_chunks(work, q, v, t);
            } else {
                self.subtract_gradient_by_chunks(work, q, t);
            }
        }
        if F::GENERALISED {
            self.forces.generalised(q, v, t, &mut work.force);
        }
    }

    /// The rows, weights and residuals at a state.
    pub(super) fn collect_rows_with_rates<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) {
        work.rows.clear();
        work.jets.clear();
        work.jets.extend(q.iter().zip(v).enumerate().map(|(i, (&q, &v))| Jet::coordinate(q, v, i)));
        let time = if S::TIME_DEPENDENT { Jet::time(t) } else { Jet::constant(t) };
        self.system.place(&work.jets, time, &mut Pass::new(self, &mut work.rows, t));
        self.collect_rows_from(work, q, t, CHUNK);
    }

    /// The rows in the directions from `first` on.
    pub(super) fn collect_rows_from<T: Real>(&self, work: &mut Workspace<T>, q: &[T], t: T, first: usize) {
        let n = q.len();
        for first in (first..n).step_by(CHUNK) {
            work.coordinates.clear();
            work.coordinates.extend(q.iter().enumerate().map(|(i, &q)| Gradient::variable(q, i.wrapping_sub(first))));
            let mut pass = Pass::new(self, &mut work.rows, t);
            self.system.place(&work.coordinates, Gradient::constant(t), &mut pass);
        }
    }

    fn subtract_gradient_by_chunks<T: Real>(&self, work: &mut Workspace<T>, q: &[T], t: T) {
        let n = q.len();
        for first in (0..n).step_by(CHUNK) {
            work.coordinates.clear();
            work.coordinates.extend(q.iter().enumerate().map(|(i, &q)| Gradient::variable(q, i.wrapping_sub(first))));
            let value = self.potential.potential(&work.coordinates, &[], Gradient::constant(t));
            for (force, partial) in work.force[first..].iter_mut().zip(value.partials) {
                *force -= partial;
            }
        }
    }

    fn add_velocity_dependence_by_chunks<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) {
        let n = q.len();
        for first in (0..n).step_by(CHUNK) {
            work.mixed.clear();
            work.mixed_rates.clear();
            for (i, (&q, &v)) in q.iter().zip(v).enumerate() {
                let [moving, rate] = moving_against(q, v, i.wrapping_sub(first));
                work.mixed.push(moving);
                work.mixed_rates.push(rate);
            }
            let time = Dual::variable(Gradient::constant(t));
            let value = self.potential.potential(&work.mixed, &work.mixed_rates, time);
            for (force, partial) in work.force[first..].iter_mut().zip(value.tangent.partials) {
                *force += partial;
            }
        }
    }

    /// Subtracts ∂²V/∂q̇∂q̇ from a metric whose columns are `stride` apart.
    pub(super) fn subtract_velocity_hessian<T: Real>(
        &self,
        nested: &mut Vec<Twice<T>>,
        q: &[T],
        v: &[T],
        t: T,
        metric: &mut [T],
        stride: usize,
    ) {
        let n = q.len();
        for first in (0..n).step_by(HESSIAN_CHUNK) {
            for second in (0..n).step_by(HESSIAN_CHUNK) {
                // Coordinates are constants; the velocities carry both sets of directions.
                nested.clear();
                nested.extend(q.iter().map(|&q| Gradient::constant(Gradient::constant(q))));
                let twice = |(i, &v): (usize, &T)| {
                    let inner = Gradient::variable(v, i.wrapping_sub(second));
                    Gradient::variable(inner, i.wrapping_sub(first))
                };
                nested.extend(v.iter().enumerate().map(twice));
                let (coordinates, rates) = nested.split_at(n);
                let time = Gradient::constant(Gradient::constant(t));
                let value = self.potential.potential(coordinates, rates, time);
                for i in first..n.min(first + HESSIAN_CHUNK) {
                    for j in second..n.min(second + HESSIAN_CHUNK) {
                        metric[j + i * stride] -= value.partials[i - first].partials[j - second];
                    }
                }
            }
        }
    }
}

impl<T: Real> Workspace<T> {
    /// The lower triangle of g = JᵀmJ, down the columns.
    pub(super) fn form_metric(&mut self, n: usize) {
        self.metric.clear();
        self.metric.resize(n * n, T::zero());
        self.rows.form_metric(n, &mut self.metric);
    }

    /// The upper triangle from the lower.
    pub(super) fn complete_metric(&mut self, n: usize) {
        for j in 0..n {
            for i in 0..j {
                self.metric[i + j * n] = self.metric[j + i * n];
            }
        }
    }
}

const _: () = assert!(LARGEST == CHUNK, "one chunk serves every system that is solved in one pass");
