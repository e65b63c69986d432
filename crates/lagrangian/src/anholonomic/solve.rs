//! The linear system for the free quasi-velocities, with the others held.

use piola_kinematics::Holonomic;
use piola_numerics::linear::ldlt;
use piola_numerics::{Mask, NumericsError, Real};

use super::map::{dot, zeros};
use super::workspace::Workspace;
use super::{InFrame, QuasiVelocities};
use crate::check::check_finite;
use crate::{AnholonomicError, LagrangianError};
use crate::{Forces, Potential};

impl<T: Real> Workspace<T> {
    /// Notes which of n quasi-velocities are held; `held` increases.
    pub(super) fn hold(&mut self, n: usize, held: &[usize]) -> Result<(), LagrangianError> {
        if let Some(&index) = held.iter().find(|&&index| n <= index) {
            return Err(LagrangianError::Anholonomic(AnholonomicError::NoSuchQuasiVelocity { index, count: n }));
        }
        self.held.clear();
        self.held.extend_from_slice(held);
        self.free.clear();
        self.free.extend((0..n).filter(|a| !held.contains(a)));
        Ok(())
    }

    /// q̈ = k_α u̇^α + c, after [`InFrame::solve`].
    pub(super) fn form_coordinate_acceleration(&mut self) {
        let n = self.velocity.len();
        zeros(&mut self.moved, n);
        for (&a, &rate) in self.free.iter().zip(&self.rates) {
            for (moved, &k) in self.moved.iter_mut().zip(&self.map.frame[a * n..(a + 1) * n]) {
                *moved += k * rate;
            }
        }
        self.acceleration.clear();
        self.acceleration.extend(self.moved.iter().zip(&self.change).map(|(&moved, &change)| moved + change));
    }

    /// The reactions in the coordinates, R = M q̈ − f, after
    /// [`form_coordinate_acceleration`](Self::form_coordinate_acceleration).
    pub(super) fn form_reaction(&mut self) {
        let n = self.velocity.len();
        self.product.clear();
        for (row, &force) in self.mass_matrix.chunks_exact(n.max(1)).zip(&self.forcing) {
            self.product.push(dot(row, &self.moved) - force); // M c is in the force already
        }
    }

    /// The reactions along the vectors that are held, R_h = k_h·(M q̈ − f).
    pub(super) fn reactions_into(&mut self, out: &mut [T]) {
        let n = self.velocity.len();
        for (out, &h) in out.iter_mut().zip(&self.held) {
            *out = dot(&self.map.frame[h * n..(h + 1) * n], &self.product);
        }
    }

    /// The reactions in the coordinates.
    pub(super) fn reaction(&self) -> &[T] {
        &self.product
    }
}

impl<S: Holonomic, P: Potential, F: Forces, W: QuasiVelocities> InFrame<S, P, F, W> {
    /// Solves for the rates of the free quasi-velocities, `work.quasi` being all of u.
    pub(super) fn solve<T: Real>(&self, work: &mut Workspace<T>, q: &[T], t: T) -> Result<(), LagrangianError> {
        match self.solve_unchecked(work, q, t) {
            Ok(()) if work.rates.iter().fold(T::Mask::splat(true), |all, x| all & x.is_finite()).all() => Ok(()),
            result => {
                for (quantity, values) in [("q", q), ("u", &work.quasi), ("t", &[t]), ("frame", &work.map.frame)] {
                    check_finite(quantity, values)?;
                }
                result?;
                check_finite("u̇", &work.rates)
            }
        }
    }

    fn solve_unchecked<T: Real>(&self, work: &mut Workspace<T>, q: &[T], t: T) -> Result<(), LagrangianError> {
        let n = q.len();
        work.map.evaluate(self.map(), q, t)?;
        for buffer in [&mut work.velocity, &mut work.change, &mut work.forcing, &mut work.product] {
            zeros(buffer, n);
        }
        zeros(&mut work.mass_matrix, n * n);
        work.map.velocities_into(&work.quasi, &mut work.velocity);
        let (matrix, forcing) = (&mut work.mass_matrix, &mut work.forcing);
        self.lagrangian().equations_into(&mut work.lagrangian, q, &work.velocity, t, matrix, forcing)?;
        work.map.differentiate(self.map(), q, t, (&work.velocity, T::one()));
        work.map.velocity_change_into::<W>(&work.quasi, &work.velocity, &mut work.change)?;
        for (force, row) in forcing.iter_mut().zip(matrix.chunks_exact(n.max(1))) {
            *force -= dot(row, &work.change);
        }

        let m = work.free.len();
        zeros(&mut work.metric, m * m);
        work.rates.clear();
        for (j, &b) in work.free.iter().enumerate() {
            let vector = &work.map.frame[b * n..(b + 1) * n];
            work.rates.push(dot(vector, forcing));
            for (product, row) in work.product.iter_mut().zip(matrix.chunks_exact(n)) {
                *product = dot(row, vector);
            }
            for (i, &a) in work.free.iter().enumerate().skip(j) {
                work.metric[i + j * m] = dot(&work.map.frame[a * n..(a + 1) * n], &work.product);
            }
        }
        match ldlt::factor_in_place(&mut work.metric, m) {
            Ok(()) => Ok(ldlt::solve_in_place(&work.metric, m, &mut work.rates)?),
            Err(error) => Err(work.explain(error)),
        }
    }
}

impl<T: Real> Workspace<T> {
    /// A motion without inertia, or quasi-velocities without motion.
    #[cold]
    fn explain(&self, error: NumericsError) -> LagrangianError {
        let NumericsError::NotPositiveDefinite { pivot, value, diagonal } = error else { return error.into() };
        let (n, m) = (self.velocity.len(), self.free.len());
        let mut direction = vec![T::zero(); m];
        if ldlt::null_direction_into(&self.metric, m, pivot, &mut direction).is_err() {
            return error.into();
        }
        // The lane that failed is the one with this pivot.
        let of_lane = |lane: usize| self.metric[pivot * (m + 1)].primal(lane).to_bits() == value.to_bits();
        let lane = (0..T::LANES).find(|&lane| of_lane(lane)).unwrap_or(0);
        let mut combination = vec![0.0; n];
        let (mut motion, mut parts) = (vec![0.0; n], vec![0.0; n]);
        for (&a, weight) in self.free.iter().zip(direction) {
            let weight = weight.primal(lane);
            combination[a] = weight;
            for c in 0..n {
                let part = weight * self.map.frame[a * n + c].primal(lane);
                motion[c] += part;
                parts[c] += part.abs();
            }
        }
        // Squares of rounding are what a metric of a singular frame shows.
        let vanishes = motion.iter().zip(&parts).all(|(sum, parts)| sum.abs() <= 1e-7 * parts);
        if vanishes {
            LagrangianError::Anholonomic(AnholonomicError::SingularFrame {
                index: self.free[pivot],
                pivot: value,
                scale: diagonal,
                combination,
            })
        } else {
            LagrangianError::SingularMetric { coordinate: self.free[pivot], pivot: value, diagonal, direction: motion }
        }
    }
}
