//! The equations of one step for the increments Kⱼ = h bⱼ fⱼ of the positions and Lⱼ = h bⱼ gⱼ of the momenta.

use core::marker::PhantomData;

use piola_integrators::internal::{DIRECTIONS as D, check_finite, largest_lane, magnitudes_of_blocks};
use piola_integrators::{Field, IntegratorsError};
use piola_numerics::{Gradient, Real};

use super::tableau::PairTableau;
use crate::newton::Equations;

/// Memory of one step.
#[derive(Clone, Debug)]
pub(super) struct Workspace<T> {
    /// (q, p) at a stage.
    pub(super) stage: Vec<T>,
    pub(super) rate: Vec<T>,
    pub(super) seeds: Vec<Gradient<T, D>>,
    pub(super) rate_of_seeds: Vec<Gradient<T, D>>,
    /// ∂(f, g)/∂(q, p) at a stage, down the columns.
    pub(super) jacobian: Vec<T>,
}

/// One step: `K` is how the field is differentiated.
pub(super) struct PairStep<'a, F, T, K> {
    pub(super) field: &'a mut F,
    pub(super) tableau: &'a PairTableau,
    pub(super) weights: &'a [f64],
    pub(super) work: &'a mut Workspace<T>,
    pub(super) values: &'a [T],
    pub(super) carry: &'a [T],
    pub(super) t: f64,
    pub(super) h: f64,
    pub(super) evaluations: u64,
    pub(super) kind: PhantomData<K>,
}

/// The iteration goes by fixed point.
pub(super) struct FixedPoint;
/// The iteration goes by Newton's method with exact Jacobians.
pub(super) struct Exact;

/// How the field is differentiated.
pub(super) trait Jacobians<F: Field<T>, T: Real> {
    /// Whether it is not.
    const NONE: bool;
    /// Writes ∂rate/∂y at the stage of the workspace.
    fn write(field: &mut F, t: f64, work: &mut Workspace<T>) -> Result<(), F::Error>;
}

impl<F: Field<T>, T: Real> Jacobians<F, T> for FixedPoint {
    const NONE: bool = true;
    fn write(_field: &mut F, _t: f64, _work: &mut Workspace<T>) -> Result<(), F::Error> {
        Ok(())
    }
}

impl<F, E, T: Real> Jacobians<F, T> for Exact
where
    F: Field<T, Error = E> + Field<Gradient<T, D>, Error = E>,
{
    const NONE: bool = false;
    fn write(field: &mut F, t: f64, work: &mut Workspace<T>) -> Result<(), E> {
        let n = work.stage.len();
        for first in (0..n).step_by(D) {
            for (i, (seed, &y)) in work.seeds.iter_mut().zip(&work.stage).enumerate() {
                *seed = Gradient::variable(y, i.wrapping_sub(first));
            }
            field.rate(t, &work.seeds, &mut work.rate_of_seeds)?;
            for (i, rate) in work.rate_of_seeds.iter().enumerate() {
                for (j, &partial) in (first..n).zip(&rate.partials) {
                    work.jacobian[i + j * n] = partial;
                }
            }
        }
        Ok(())
    }
}

impl<F, T: Real, K> PairStep<'_, F, T, K> {
    /// Writes (Qᵢ, Pᵢ).
    fn set_stage(&mut self, x: &[T], i: usize) {
        let n = self.values.len();
        let half = n / 2;
        for k in 0..n {
            let row = if k < half { &self.tableau.positions[i] } else { &self.tableau.momenta[i] };
            let mut increment = self.carry[k];
            for (j, &factor) in row[..self.tableau.stages].iter().enumerate() {
                increment += T::lit(factor) * x[j * n + k];
            }
            self.work.stage[k] = self.values[k] + increment;
        }
    }

    fn time_of(&self, i: usize) -> f64 {
        self.t + self.tableau.nodes[i] * self.h
    }
}

impl<F: Field<T>, T: Real, K: Jacobians<F, T>> Equations<T> for PairStep<'_, F, T, K> {
    type Error = F::Error;
    const BY_FIXED_POINT: bool = K::NONE;

    fn residual(&mut self, x: &[T], residual: &mut [T]) -> Result<(), IntegratorsError<F::Error>> {
        let n = self.values.len();
        for i in 0..self.tableau.stages {
            self.set_stage(x, i);
            let t = self.time_of(i);
            self.field
                .rate(t, &self.work.stage, &mut self.work.rate)
                .map_err(|source| IntegratorsError::Field { t, source })?;
            self.evaluations += 1;
            check_finite("rate", Some(self.t), &self.work.rate)?;
            let weight = T::lit(self.weights[i]);
            for (k, &rate) in self.work.rate.iter().enumerate() {
                residual[i * n + k] = x[i * n + k] - weight * rate;
            }
        }
        Ok(())
    }

    fn matrix(&mut self, x: &[T], matrix: &mut [T], response: &mut [f64]) -> Result<(), IntegratorsError<F::Error>> {
        let (n, s) = (self.values.len(), self.tableau.stages);
        let size = s * n;
        for i in 0..s {
            self.set_stage(x, i);
            let t = self.time_of(i);
            K::write(self.field, t, self.work).map_err(|source| IntegratorsError::Field { t, source })?;
            check_finite("jacobian", Some(self.t), &self.work.jacobian)?;
            for (column, &y) in self.work.stage.iter().enumerate() {
                for row in 0..n {
                    let slope = T::lit(self.weights[i]) * self.work.jacobian[row + column * n];
                    response[i * n + row] += largest_lane(slope) * largest_lane(y);
                }
            }
            for j in 0..s {
                for column in 0..n {
                    let row_of = if column < n / 2 { &self.tableau.positions[i] } else { &self.tableau.momenta[i] };
                    let factor = T::lit(self.weights[i] * row_of[j]);
                    for row in 0..n {
                        let identity = if i == j && row == column { T::one() } else { T::zero() };
                        matrix[i * n + row + (j * n + column) * size] =
                            identity - factor * self.work.jacobian[row + column * n];
                    }
                }
            }
        }
        Ok(())
    }

    fn magnitudes(&self, x: &[T], magnitudes: &mut [f64]) {
        let n = self.values.len().max(1);
        for (stage, magnitudes) in x.chunks(n).zip(magnitudes.chunks_mut(n)) {
            magnitudes_of_blocks(self.values, magnitudes);
            for (magnitude, &x) in magnitudes.iter_mut().zip(stage) {
                *magnitude = magnitude.max(largest_lane(x));
            }
        }
    }
}
