//! The equations of one step: Δ = h (S − R)(m) ∇̄H.

use piola_integrators::IntegratorsError;
use piola_integrators::internal::{DIRECTIONS as D, check_finite, largest_lane, magnitudes_of_blocks};
use piola_numerics::sums::unit_in_last_place;
use piola_numerics::{Gradient, Real, Secant};

use super::EnergySystem;
use crate::newton::Equations;

/// Memory for the derivatives of a system.
#[derive(Clone, Debug)]
pub(super) struct Workspace<T> {
    middle: Vec<T>,
    gradient: Vec<T>,
    rate: Vec<T>,
    damping: Vec<T>,
    secants: Vec<Secant<T>>,
    seeds: Vec<Gradient<T, D>>,
    gradient_of_seeds: Vec<Gradient<T, D>>,
    rate_of_seeds: Vec<Gradient<T, D>>,
    damping_of_seeds: Vec<Gradient<T, D>>,
    nested: Vec<Gradient<Gradient<T, D>, D>>,
}

impl<T: Real> Workspace<T> {
    pub(super) const fn new() -> Self {
        Self {
            middle: Vec::new(),
            gradient: Vec::new(),
            rate: Vec::new(),
            damping: Vec::new(),
            secants: Vec::new(),
            seeds: Vec::new(),
            gradient_of_seeds: Vec::new(),
            rate_of_seeds: Vec::new(),
            damping_of_seeds: Vec::new(),
            nested: Vec::new(),
        }
    }

    pub(super) fn resize(&mut self, n: usize) {
        for vector in [&mut self.middle, &mut self.gradient, &mut self.rate, &mut self.damping] {
            vector.resize(n, T::zero());
        }
        let zero = Gradient::constant(T::zero());
        for vector in
            [&mut self.seeds, &mut self.gradient_of_seeds, &mut self.rate_of_seeds, &mut self.damping_of_seeds]
        {
            vector.resize(n, zero);
        }
        self.secants.resize(n, Secant::constant(T::zero()));
        self.nested.resize(n, Gradient::constant(zero));
    }

    /// H(y + carry) − H(y₀ + carry₀), without cancellation.
    pub(super) fn energy_change(
        &mut self,
        system: &impl EnergySystem,
        (start, start_carry): (&[T], &[T]),
        (end, end_carry): (&[T], &[T]),
    ) -> T {
        for (i, secant) in self.secants.iter_mut().enumerate() {
            let change = (end[i] - start[i]) + (end_carry[i] - start_carry[i]);
            *secant = Secant { start: start[i], end: end[i], change };
        }
        system.energy(&self.secants).change
    }

    /// Writes ∇H of the middle to `gradient`.
    fn differentiate(&mut self, system: &impl EnergySystem) {
        for first in (0..self.middle.len()).step_by(D) {
            for (i, (seed, &y)) in self.seeds.iter_mut().zip(&self.middle).enumerate() {
                // Before `first` the difference wraps to a number that is no direction.
                *seed = Gradient::variable(y, i.wrapping_sub(first));
            }
            let energy = system.energy(&self.seeds);
            for (out, &partial) in self.gradient[first..].iter_mut().zip(&energy.partials) {
                *out = partial;
            }
        }
    }

    /// Writes (S − R) g of the middle and of the vector `gradient` to `rate`.
    fn rotate<S: EnergySystem>(&mut self, system: &S) {
        system.structure(&self.middle, &self.gradient, &mut self.rate);
        if S::DAMPED {
            system.damping(&self.middle, &self.gradient, &mut self.damping);
            for (rate, &damping) in self.rate.iter_mut().zip(&self.damping) {
                *rate -= damping;
            }
        }
    }
}

/// One step from `values + carry`.
pub(super) struct MidpointStep<'a, S, T> {
    pub(super) system: &'a S,
    pub(super) work: &'a mut Workspace<T>,
    pub(super) values: &'a [T],
    pub(super) carry: &'a [T],
    pub(super) t: f64,
    /// The step.
    pub(super) h: f64,
    /// What rounding added to the energy so far.
    pub(super) excess: T,
}

impl<S, T: Real> MidpointStep<'_, S, T> {
    fn set_middle(&mut self, increment: &[T]) {
        for (i, middle) in self.work.middle.iter_mut().enumerate() {
            *middle = self.values[i] + (self.carry[i] + T::lit(0.5) * increment[i]);
        }
    }
}

impl<S: EnergySystem, T: Real> MidpointStep<'_, S, T> {
    /// Turns ∇H(m) into the discrete gradient of Gonzalez, which also takes back what rounding added to the energy:
    ///
    /// ```text
    /// ∇̄H = ∇H(m) + (δH − ∇H(m)·Δ + excess)/|Δ|² Δ
    /// ```
    fn correct_gradient(&mut self, increment: &[T]) {
        for (i, secant) in self.work.secants.iter_mut().enumerate() {
            let end = self.values[i] + (self.carry[i] + increment[i]);
            *secant = Secant { start: self.values[i], end, change: increment[i] };
        }
        let change = self.system.energy(&self.work.secants).change;
        let (mut slope, mut bound, mut largest) = (T::zero(), T::zero(), T::zero());
        for (&g, &d) in self.work.gradient.iter().zip(increment) {
            slope += g * d;
            bound += (g * d).abs();
            largest = largest.max(d.abs());
        }
        // No more of the gradient than half of its digits is changed: the rest of the excess is left to later steps.
        let bound = T::lit(unit_in_last_place::<T>().sqrt()) * bound;
        let returned = self.excess.min(bound).max(-bound);
        // By the largest component, so that no square of a short step underflows; where there is no step, no correction.
        let moves = T::zero().less_than(largest);
        let scale = T::select(moves, largest, T::one());
        let mut square = T::zero();
        for &d in increment {
            square += (d / scale) * (d / scale);
        }
        let square = T::select(moves, square, T::one());
        let factor = (change - slope + returned) / scale / square;
        for (g, &d) in self.work.gradient.iter_mut().zip(increment) {
            *g += factor * (d / scale);
        }
    }
}

impl<S: EnergySystem, T: Real> Equations<T> for MidpointStep<'_, S, T> {
    type Error = core::convert::Infallible;

    fn residual(&mut self, x: &[T], residual: &mut [T]) -> Result<(), IntegratorsError> {
        self.set_middle(x);
        self.work.differentiate(self.system);
        self.correct_gradient(x);
        self.work.rotate(self.system);
        check_finite("rate", Some(self.t), &self.work.rate)?;
        let h = T::lit(self.h);
        for ((residual, &x), &rate) in residual.iter_mut().zip(x).zip(&self.work.rate) {
            *residual = x - h * rate;
        }
        Ok(())
    }

    /// 1 − ½ h ∂((S − R)∇H)/∂y at the middle: what the correction of the gradient adds is of order h³.
    fn matrix(&mut self, x: &[T], matrix: &mut [T], response: &mut [f64]) -> Result<(), IntegratorsError> {
        self.set_middle(x);
        let (n, work, half) = (x.len(), &mut *self.work, T::lit(0.5 * self.h));
        for first in (0..n).step_by(D) {
            for (i, (seed, &y)) in work.seeds.iter_mut().zip(&work.middle).enumerate() {
                *seed = Gradient::variable(y, i.wrapping_sub(first));
            }
            for row in (0..n).step_by(D) {
                for (i, (nested, &seed)) in work.nested.iter_mut().zip(&work.seeds).enumerate() {
                    *nested = Gradient::variable(seed, i.wrapping_sub(row));
                }
                let energy = self.system.energy(&work.nested);
                for (out, &partial) in work.gradient_of_seeds[row..].iter_mut().zip(&energy.partials) {
                    *out = partial;
                }
            }
            self.system.structure(&work.seeds, &work.gradient_of_seeds, &mut work.rate_of_seeds);
            if S::DAMPED {
                self.system.damping(&work.seeds, &work.gradient_of_seeds, &mut work.damping_of_seeds);
                for (rate, &damping) in work.rate_of_seeds.iter_mut().zip(&work.damping_of_seeds) {
                    *rate -= damping;
                }
            }
            for (i, rate) in work.rate_of_seeds.iter().enumerate() {
                for (j, &partial) in (first..n).zip(&rate.partials) {
                    response[i] += largest_lane(half * partial) * largest_lane(work.middle[j]);
                    matrix[i + j * n] = if i == j { T::one() } else { T::zero() } - half * partial;
                }
            }
        }
        check_finite("jacobian", Some(self.t), matrix)
    }

    fn magnitudes(&self, x: &[T], magnitudes: &mut [f64]) {
        magnitudes_of_blocks(self.values, magnitudes);
        for (magnitude, &x) in magnitudes.iter_mut().zip(x) {
            *magnitude = magnitude.max(largest_lane(x));
        }
    }
}
