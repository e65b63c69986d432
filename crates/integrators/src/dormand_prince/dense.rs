//! Dense output: the state at any time within an accepted step, to order seven.

use piola_numerics::Real;

use super::coefficients as c;
use super::stages::{combine, weighted_sums};
use super::{DormandPrince853, evaluate};
use crate::accepted::{AcceptedStep, number_and_times};
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
        &self.method.start
    }
    /// The state at its end.
    #[must_use]
    pub fn values(&self) -> &[T] {
        &self.method.trial
    }
    pub(super) const fn evaluations(&self) -> u64 {
        self.evaluations
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
        self.step.check(t, self.method.start.len(), out.len())?;
        // At its ends the step is known, to the last bit and without evaluations.
        if self.step.is_end(t) {
            out.copy_from_slice(&self.method.trial);
            return Ok(());
        }
        if t.to_bits() == self.start().to_bits() {
            out.copy_from_slice(&self.method.start);
            return Ok(());
        }
        if self.evaluations == 0 {
            self.prepare()?;
        }
        let theta = T::lit(self.step.part(t));
        let rest = T::one() - theta;
        let n = out.len();
        let [f0, f1, f2, f3, f4, f5, f6] = self.method.interpolant.each_ref().map(|f| &f[..n]);
        let (start, carry) = (&self.method.start[..n], &self.method.start_carry[..n]);
        for (i, out) in out.iter_mut().enumerate() {
            let inner = f3[i] + theta * (f4[i] + rest * (f5[i] + theta * f6[i]));
            let increment = theta * (f0[i] + rest * (f1[i] + theta * (f2[i] + rest * inner)));
            *out = start[i] + (carry[i] + increment);
        }
        Ok(())
    }

    fn prepare(&mut self) -> Result<(), IntegratorsError<F::Error>> {
        let (method, t, h) = (&mut *self.method, self.step.start, self.step.length);
        let start = (&method.start[..], &method.start_carry[..]);
        // The step's end stands in `trial`; the arguments of the stages go to the last interpolant.
        macro_rules! stage {
            ($number:literal, $row:expr) => {
                combine(&$row, &method.stages, start, h, &mut method.interpolant[6]);
                evaluate(self.field, t + c::C[$number] * h, &method.interpolant[6], &mut method.stages[$number])?;
            };
        }
        stage!(13, c::A14);
        stage!(14, c::A15);
        stage!(15, c::A16);
        self.evaluations += 3;
        let h = T::lit(h);
        let DormandPrince853 { stages: k, interpolant, trial, trial_carry, start, start_carry, .. } = method;
        let n = trial.len();
        let [f0, f1, f2, f3, f4, f5, f6] = interpolant.each_mut().map(|f| &mut f[..n]);
        for i in 0..n {
            let difference = (trial[i] - start[i]) + (trial_carry[i] - start_carry[i]);
            let (first, last) = (h * k[0][i], h * k[12][i]);
            f0[i] = difference;
            f1[i] = first - difference;
            f2[i] = difference + difference - (last + first);
        }
        weighted_sums(&c::D4, k, f3);
        weighted_sums(&c::D5, k, f4);
        weighted_sums(&c::D6, k, f5);
        weighted_sums(&c::D7, k, f6);
        for f in [f3, f4, f5, f6] {
            for f in f {
                *f *= h;
            }
        }
        Ok(())
    }
}
