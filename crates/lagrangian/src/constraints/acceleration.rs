//! Accelerations, multipliers and reactions: the equations of index one.

use nalgebra::DVector;
use piola_kinematics::Holonomic;
use piola_numerics::internal::{size, zeros};
use piola_numerics::linear::ldlt;
use piola_numerics::{Mask, NumericsError, Real};

use super::workspace::Workspace;
use super::{Constrained, Constraints, Redundancy};
use crate::check::{check_finite, check_length};
use crate::{ConstraintError, LagrangianError};
use crate::{Forces, Potential, Reaction};

impl<S: Holonomic, P: Potential, F: Forces, C: Constraints> Constrained<S, P, F, C> {
    /// The accelerations q̈ under the constraints.
    ///
    /// ```text
    /// M q̈ + Gᵀ λ = f        G q̈ = −γ                              Gauss' principle: |q̈ − M⁻¹f| in M is least
    /// ```
    ///
    /// | symbol | argument | shape | unit |
    /// |---|---|---|---|
    /// | q, q̇ | `q`, `v` | n, satisfying φ = 0 and φ̇ = 0 | the coordinates' own |
    /// | t | `t` | scalar | s |
    /// | q̈ | returned | n | the coordinates' own / s² |
    ///
    /// They are unique also where constraints depend on each other. M may be singular as long as no motion that
    /// the constraints leave is without inertia.
    ///
    /// # Errors
    /// [`LagrangianError::WrongLength`], [`LagrangianError::NotFinite`]; [`LagrangianError::SingularMetric`],
    /// which names a motion without inertia that the constraints leave; [`ConstraintError::Redundant`]
    /// if so [asked](Redundancy::Refused).
    ///
    /// # Accuracy
    /// A few ulp times the condition numbers of M, scaled to unit diagonal, and of the independent gradients in
    /// units of their lengths in M.
    pub fn acceleration<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.acceleration_into(&mut Workspace::default(), q, v, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`acceleration`](Self::acceleration) to the caller's memory, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn acceleration_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("q̈", q.len(), out.len())?;
        self.form(work, q, v, t)?;
        self.factor(work, false)?;
        work.independence.choose(self.least_share);
        self.refuse_redundancy(work)?;
        work.independence.accelerate(&work.forcing, &work.gradients.second_rates, out);
        check_finite("q̈", out)
    }

    /// The same with the constraints chosen before.
    pub(super) fn follow_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        (q, v): (&[T], &[T]),
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        self.form(work, q, v, t)?;
        self.factor(work, true)?;
        work.independence.follow().map_err(|constraint| self.singular(constraint, t.primal(0)))?;
        work.independence.accelerate(&work.forcing, &work.gradients.second_rates, out);
        Ok(())
    }

    /// The multipliers λ of M q̈ + Gᵀλ = f.
    ///
    /// Where constraints depend on each other λ is not unique: these are the ones of least Σ λᵢ² gᵢᵀM⁻¹gᵢ, which
    /// equal constraints share alike whatever their units.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn multipliers<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(self.constraints.count(), T::zero());
        let mut acceleration = vec![T::zero(); q.len()];
        self.solve_into(&mut Workspace::default(), q, v, t, &mut acceleration, out.as_mut_slice())?;
        Ok(out)
    }

    /// Accelerations and multipliers together, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn solve_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        acceleration: &mut [T],
        multipliers: &mut [T],
    ) -> Result<(), LagrangianError> {
        check_length("λ", self.constraints.count(), multipliers.len())?;
        self.acceleration_into(work, q, v, t, acceleration)?;
        work.independence.multiply(multipliers)?;
        check_finite("λ", multipliers)
    }

    /// The reactions of the constraints on the coordinates, −Gᵀλ = M q̈ − f.
    ///
    /// They are unique also where λ is not, and do no work in any motion δq with G δq = 0.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn reactions<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<DVector<T>, LagrangianError> {
        let mut out = DVector::from_element(q.len(), T::zero());
        self.reactions_into(&mut Workspace::default(), q, v, t, out.as_mut_slice())?;
        Ok(out)
    }

    /// [`reactions`](Self::reactions) to the caller's memory, without allocation once `work` has been used.
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    pub fn reactions_into<T: Real>(
        &self,
        work: &mut Workspace<T>,
        q: &[T],
        v: &[T],
        t: T,
        out: &mut [T],
    ) -> Result<(), LagrangianError> {
        let n = q.len();
        check_length("reactions", n, out.len())?;
        let (mut acceleration, mut multipliers) =
            (core::mem::take(&mut work.acceleration), core::mem::take(&mut work.multipliers));
        zeros(&mut acceleration, n);
        zeros(&mut multipliers, self.constraints.count());
        let solved = self.solve_into(work, q, v, t, &mut acceleration, &mut multipliers);
        out.fill(T::zero());
        for (row, &multiplier) in work.gradients.rows.chunks_exact(n.max(1)).zip(&multipliers) {
            for (out, &entry) in out.iter_mut().zip(row) {
                *out -= multiplier * entry;
            }
        }
        (work.acceleration, work.multipliers) = (acceleration, multipliers);
        solved
    }

    /// The forces that hold each particle and body, in the order of placement: those of the placement and of the
    /// constraints together, W(5.1–5.3).
    ///
    /// # Errors
    /// As [`acceleration`](Self::acceleration).
    ///
    /// # Source
    /// W(5.1–5.3).
    pub fn part_reactions<T: Real>(&self, q: &[T], v: &[T], t: T) -> Result<Vec<Reaction<T>>, LagrangianError> {
        let acceleration = self.acceleration(q, v, t)?;
        let mut out = vec![Reaction::none(); self.lagrangian.parts(q, t)];
        let mut work = crate::Workspace::default();
        self.lagrangian.reactions_at_acceleration_into(&mut work, q, v, acceleration.as_slice(), t, &mut out)?;
        Ok(out)
    }

    /// Leaves M, f, φ, φ̇, γ and G in `work`.
    pub(super) fn form<T: Real>(&self, work: &mut Workspace<T>, q: &[T], v: &[T], t: T) -> Result<(), LagrangianError> {
        let n = q.len();
        check_length("q̇", n, v.len())?;
        work.mass_matrix.resize(n * n, T::zero());
        work.forcing.resize(n, T::zero());
        let Workspace { lagrangian, mass_matrix, forcing, .. } = work;
        self.lagrangian.equations_into(lagrangian, q, v, t, mass_matrix, forcing)?;
        self.differentiate(work, q, v, t);
        let finite = |values: &[T]| values.iter().fold(T::Mask::splat(true), |all, a| all & a.is_finite()).all();
        let gradients = &work.gradients;
        if finite(&gradients.rates) && finite(&gradients.second_rates) && finite(&gradients.rows) {
            return Ok(());
        }
        check_finite("q", q)?;
        check_finite("q̇", v)?;
        check_finite("t", &[t])?;
        Self::check_gradients(work)
    }

    /// Factors the metric and brings the gradients to its scale.
    ///
    /// A metric that is singular alone is made regular by the constraints: adding Gᵀ W G to M and −Gᵀ W γ to f
    /// changes neither q̈ nor λ, whatever the weights.
    pub(super) fn factor<T: Real>(&self, work: &mut Workspace<T>, chosen_only: bool) -> Result<(), LagrangianError> {
        let n = work.forcing.len();
        let count = self.constraints.count();
        if work.independence.factor_metric(&work.mass_matrix, n).is_err() {
            self.add_constraints(work, chosen_only);
            if let Err(error) = work.independence.factor_metric(&work.mass_matrix, n) {
                return Err(Self::explain(error, work));
            }
        }
        work.independence.scale(&work.gradients.rows, count);
        Ok(())
    }

    #[cold]
    fn add_constraints<T: Real>(&self, work: &mut Workspace<T>, chosen_only: bool) {
        let n = work.forcing.len();
        let heaviest = (0..n).map(|i| size(work.mass_matrix[i * (n + 1)])).fold(0.0, f64::max);
        let heaviest = if 0.0 < heaviest { heaviest } else { 1.0 };
        for i in 0..self.constraints.count() {
            let independence = &work.independence;
            if chosen_only && !independence.order[..independence.rank].contains(&i) {
                continue;
            }
            let row = &work.gradients.rows[i * n..(i + 1) * n];
            let steepest = row.iter().map(|&x| size(x)).fold(0.0, f64::max);
            if steepest <= 0.0 {
                continue;
            }
            let weight = T::lit(heaviest / (steepest * steepest));
            for (j, &g) in row.iter().enumerate() {
                work.forcing[j] -= weight * g * work.gradients.second_rates[i];
                for (k, &h) in row.iter().enumerate() {
                    work.mass_matrix[k + j * n] += weight * g * h;
                }
            }
        }
    }

    /// A motion that the constraints leave and that has no inertia.
    #[cold]
    fn explain<T: Real>(error: NumericsError, work: &Workspace<T>) -> LagrangianError {
        let NumericsError::NotPositiveDefinite { pivot, value, diagonal } = error else { return error.into() };
        let n = work.forcing.len();
        let mut direction = vec![T::zero(); n];
        if ldlt::null_direction_into(&work.independence.factors, n, pivot, &mut direction).is_err() {
            direction.clear();
        }
        let direction = direction.into_iter().map(|x| x.primal(0)).collect();
        LagrangianError::SingularMetric { coordinate: pivot, pivot: value, diagonal, direction }
    }

    /// Refuses constraints that depend on others, if so asked.
    pub(super) fn refuse_redundancy<T: Real>(&self, work: &mut Workspace<T>) -> Result<(), LagrangianError> {
        let rank = work.independence.rank;
        if self.redundancy == Redundancy::Handled || work.independence.order.len() <= rank {
            return Ok(());
        }
        work.independence.combine();
        let constraint = work.independence.order[rank];
        let combination = work.independence.combination(rank).into_iter().map(|x| x.primal(0)).collect();
        Err(LagrangianError::Constraint(ConstraintError::Redundant {
            constraint,
            name: self.name_of(constraint),
            combination,
        }))
    }

    /// Σ wᵢ gᵢ into `work.along`.
    pub(super) fn gather<T: Real>(work: &mut Workspace<T>, weights: &[T], n: usize) {
        zeros(&mut work.along, n);
        for (j, along) in work.along.iter_mut().enumerate() {
            let column = work.gradients.rows.iter().skip(j).step_by(n.max(1));
            *along = weights.iter().zip(column).fold(T::zero(), |sum, (&w, &g)| sum + w * g);
        }
    }
}
