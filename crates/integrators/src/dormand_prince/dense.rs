//! Dense output: the state at any time within an accepted step, to order seven.

use piola_numerics::Real;

use super::coefficients as c;
use super::{DormandPrince853, Row, evaluate};
use crate::accepted::{AcceptedStep, number_and_times};
use crate::explicit::{Dense, combine, row, row_mut, weighted_sums};
use crate::{Field, IntegratorsError};

/// An accepted step, with the state at any time within it.
///
/// The first call of [`at`](Self::at) within a step evaluates the field three times; a step that is not asked,
/// or asked at its ends only, costs nothing.
#[doc(alias("interpolation", "continuous output"))]
#[derive(Debug)]
pub struct DenseStep<'a, T, F> {
    method: &'a mut DormandPrince853<T>,
    field: &'a mut F,
    step: AcceptedStep,
    evaluations: u64,
}

impl<'a, T: Real, F: Field<T>> DenseStep<'a, T, F> {
    pub(super) fn new(method: &'a mut DormandPrince853<T>, field: &'a mut F, step: AcceptedStep) -> Self {
        Self { method, field, step, evaluations: 0 }
    }

    number_and_times!();

    /// The state at its start.
    #[must_use]
    pub fn start_values(&self) -> &[T] {
        self.row(Row::START)
    }
    /// The state at its end.
    #[must_use]
    pub fn values(&self) -> &[T] {
        self.row(Row::TRIAL)
    }
    fn row(&self, number: usize) -> &[T] {
        row(&self.method.memory, number, self.method.components)
    }

    /// Writes the state at a time within the step to `out`.
    ///
    /// ```text
    /// y(θ) = y₀ + θ(F₀ + θ̄(F₁ + θ(F₂ + θ̄(F₃ + θ(F₄ + θ̄(F₅ + θF₆)))))),   θ = (t − t₀)/h,  θ̄ = 1 − θ
    /// ```
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideStep`]: dense output never extrapolates. [`IntegratorsError::Field`] when
    /// one of the three additional evaluations fails. [`IntegratorsError::WrongLength`].
    pub fn at(&mut self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError<F::Error>> {
        self.step.check(t, self.method.components, out.len())?;
        // At its ends the step is known, to the last bit and without evaluations.
        if self.step.is_end(t) {
            out.copy_from_slice(self.row(Row::TRIAL));
            return Ok(());
        }
        if t.to_bits() == self.start().to_bits() {
            out.copy_from_slice(self.row(Row::START));
            return Ok(());
        }
        if self.evaluations == 0 {
            self.prepare()?;
        }
        let theta = T::lit(self.step.part(t));
        let rest = T::one() - theta;
        let [f0, f1, f2, f3, f4, f5, f6] = core::array::from_fn(|j| self.row(Row::INTERPOLANT + j));
        let (start, carry) = (self.row(Row::START), self.row(Row::START_CARRY));
        for (i, out) in out.iter_mut().enumerate() {
            let inner = f3[i] + theta * (f4[i] + rest * (f5[i] + theta * f6[i]));
            let increment = theta * (f0[i] + rest * (f1[i] + theta * (f2[i] + rest * inner)));
            *out = start[i] + (carry[i] + increment);
        }
        Ok(())
    }

    fn prepare(&mut self) -> Result<(), IntegratorsError<F::Error>> {
        let (t, h) = (self.step.start, self.step.length);
        let n = F::DIMENSION.unwrap_or(self.method.components);
        let (k, rest) = self.method.memory[..Row::COUNT * n].split_at_mut(Row::STAGES * n);
        let (ends, interpolant) = rest.split_at_mut((Row::INTERPOLANT - Row::TRIAL) * n);
        let [trial, trial_carry, start, carry] = core::array::from_fn(|j| row(ends, j, n));
        // The step's end stands in `trial`; the arguments of the stages go to the last interpolant.
        macro_rules! stage {
            ($number:literal, $row:expr) => {
                let argument = row_mut(interpolant, 6, n);
                combine(&$row, k, (start, carry), h, argument);
                evaluate(self.field, t + c::C[$number] * h, argument, row_mut(k, $number, n))?;
            };
        }
        stage!(13, c::A14);
        stage!(14, c::A15);
        stage!(15, c::A16);
        self.evaluations += 3;
        let h = T::lit(h);
        let (low, high) = interpolant.split_at_mut(3 * n);
        for i in 0..n {
            let difference = (trial[i] - start[i]) + (trial_carry[i] - carry[i]);
            let (first, last) = (h * k[i], h * k[12 * n + i]);
            low[i] = difference;
            low[n + i] = first - difference;
            low[2 * n + i] = difference + difference - (last + first);
        }
        weighted_sums(&c::D4, k, row_mut(high, 0, n));
        weighted_sums(&c::D5, k, row_mut(high, 1, n));
        weighted_sums(&c::D6, k, row_mut(high, 2, n));
        weighted_sums(&c::D7, k, row_mut(high, 3, n));
        for f in high {
            *f *= h;
        }
        Ok(())
    }
}

impl<T: Real, F: Field<T>> Dense<T, F::Error> for DenseStep<'_, T, F> {
    fn at(&mut self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError<F::Error>> {
        DenseStep::at(self, t, out)
    }
    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}
