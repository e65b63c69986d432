//! Dense output: the state at any time within an accepted step.
//!
//! The accelerations within a step are a polynomial `Σ γ_k P_k(x)`, x = 2θ − 1, whose integrals are the velocities and the
//! positions. Both ends of the step give γ₀ and γ₁; the accelerations there γ₂ and γ₃. With positions from this polynomial f
//! is evaluated at two more places, and at four, which gives two and four more coefficients: positions err by h⁶, h⁸ and
//! h¹⁰. Places lie in pairs ±x, so that even and odd coefficients follow from small matrices of their own.

use piola_numerics::Real;

use super::stages::evaluate;
use super::{Nystrom, NystromPair, Rows};
use crate::accepted::AcceptedStep;
use crate::checkpoint::{Checkpoint, RunSoFar};
use crate::explicit::{Dense, row};
use crate::legendre::integrals;
use crate::number_and_times;
use crate::{IntegratorsError, SecondOrder, State};

/// The places ±x of one layer beside the ends, and the matrices that make coefficients of half the sums and half the
/// differences of accelerations at x = 1 and at these places.
struct Layer<const M: usize> {
    places: [f64; M],
    /// The inverse of the matrix of P₂, P₄, P₆ at these places.
    even: [[f64; M]; M],
    /// The inverse of the matrix of P₃, P₅, P₇ at these places.
    odd: [[f64; M]; M],
}

const TWO: Layer<2> = Layer {
    places: [1.0, 0.5],
    even: [[37.0 / 21.0, 128.0 / 21.0], [-16.0 / 21.0, -128.0 / 21.0]],
    odd: [[23.0 / 135.0, -256.0 / 135.0], [112.0 / 135.0, 256.0 / 135.0]],
};

const FOUR: Layer<3> = Layer {
    places: [1.0, 0.75, 0.3],
    even: [
        [0.3566720366945044, 0.8106301336449665, -0.9991064516850366],
        [-0.8370614594168235, -7.12254441119198, -9.001194796613882],
        [1.480389422722319, 6.311914277547014, 10.000301248298918],
    ],
    odd: [
        [-1.2956183031124484, -7.019568604857875, -4.711254602832363],
        [0.03303491280432372, -1.9528866439439776, 0.4453523005402213],
        [2.2625833903081247, 8.972455248801854, 4.265902302292142],
    ],
};

/// An accepted step, with the state at any time within it.
///
/// The first call of [`at`](Self::at) within a step evaluates the acceleration twice ([`Nystrom86`](super::Nystrom86)) or six
/// times ([`Nystrom1210`](super::Nystrom1210)); a step that is not asked, or asked at its ends only, costs nothing.
#[doc(alias("interpolation", "continuous output"))]
#[derive(Debug)]
pub struct NystromStep<'a, P, T, F> {
    method: &'a mut Nystrom<P, T>,
    field: &'a mut F,
    step: AcceptedStep,
    evaluations: u64,
    prepared: bool,
}

impl<'a, P: NystromPair, T: Real, F: SecondOrder<T>> NystromStep<'a, P, T, F> {
    pub(super) fn new(method: &'a mut Nystrom<P, T>, field: &'a mut F, step: AcceptedStep) -> Self {
        Self { method, field, step, evaluations: 0, prepared: false }
    }

    number_and_times!();

    /// The state (q, v) at its start.
    #[must_use]
    pub fn start_values(&self) -> &[T] {
        self.rows(Rows::START, 2)
    }
    /// The state (q, v) at its end.
    #[must_use]
    pub fn values(&self) -> &[T] {
        self.rows(Rows::TRIAL, 2)
    }
    fn rows(&self, first: usize, count: usize) -> &[T] {
        let n = self.method.freedom;
        &self.method.memory[(P::STAGES + first) * n..][..count * n]
    }

    /// The run at the end of this step, to be written down and continued. Its report counts the evaluations for dense output of
    /// this step that were made before.
    #[must_use]
    pub fn checkpoint(&self) -> Checkpoint<T> {
        let (n, RunSoFar { mut report, time_carry, next, .. }) = (self.method.freedom, self.step.progress);
        report.evaluations += self.evaluations;
        let [q, v] = self.method.magnitudes_at_end;
        let (values, carry) = (self.values().to_vec(), self.rows(Rows::TRIAL + 2, 2).to_vec());
        let state = State { time: self.step.end, values, carry, time_carry, run: None };
        Checkpoint::of(P::NAME, state, report, row(&self.method.memory, P::END, n).to_vec(), vec![next, q, v])
    }

    /// Writes the state (q, v) at a time within the step to `out`.
    ///
    /// ```text
    /// v(θ) = v₀ + h Σ γ_k ∫₀^θ P_k,    q(θ) = q₀ + h θ v₀ + h² Σ γ_k ∬₀^θ P_k,    θ = (t − t₀)/h
    /// ```
    ///
    /// # Accuracy
    /// Within the step positions are accurate to order 8 and velocities to order 7 ([`Nystrom86`](super::Nystrom86)), or to
    /// orders 10 and 9 ([`Nystrom1210`](super::Nystrom1210)).
    ///
    /// # Errors
    /// [`IntegratorsError::OutsideStep`]: dense output never extrapolates. [`IntegratorsError::Field`] when
    /// one of the additional evaluations fails. [`IntegratorsError::WrongLength`].
    pub fn at(&mut self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError<F::Error>> {
        self.step.check(t, 2 * self.method.freedom, out.len())?;
        if self.step.is_end(t) {
            out.copy_from_slice(self.values());
            return Ok(());
        }
        if t.to_bits() == self.start().to_bits() {
            out.copy_from_slice(self.start_values());
            return Ok(());
        }
        if !self.prepared {
            self.prepare()?;
            self.prepared = true;
        }
        let (q, v) = out.split_at_mut(self.method.freedom);
        self.state_at(self.step.part(t), q, Some(v), 2 + 2 * (P::LAYERS + 1));
        Ok(())
    }

    /// Writes the positions, and the velocities if they are wanted, at the part θ of the step, from so many coefficients.
    fn state_at(&self, theta: f64, q: &mut [T], v: Option<&mut [T]>, coefficients: usize) {
        let n = self.method.freedom;
        let (once, twice) = integrals(theta);
        let start = self.rows(Rows::START, 4);
        let gamma = self.rows(Rows::LEGENDRE, 8);
        let sum = |i: usize, weights: &[f64; 8]| {
            (0..coefficients).fold(T::zero(), |sum, k| sum + T::lit(weights[k]) * gamma[k * n + i])
        };
        let (h, part) = (T::lit(self.step.length), T::lit(theta));
        for (i, q) in q.iter_mut().enumerate() {
            let moved = part * start[n + i] + h * sum(i, &twice);
            *q = start[i] + (start[2 * n + i] + h * moved);
        }
        for (i, v) in v.into_iter().flatten().enumerate() {
            *v = start[n + i] + (start[3 * n + i] + h * sum(i, &once));
        }
    }

    /// Finds the coefficients `γ_k`.
    fn prepare(&mut self) -> Result<(), IntegratorsError<F::Error>> {
        let (n, h) = (self.method.freedom, T::lit(self.step.length));
        let (stages, rest) = self.method.memory.split_at_mut(P::STAGES * n);
        let (ends, rest) = rest.split_at_mut(Rows::LEGENDRE * n);
        let (end, start) = ends.split_at(Rows::START * n);
        let gamma = &mut rest[..8 * n];
        let half = T::lit(0.5);
        for i in 0..n {
            let gained = |i: usize| (end[i] - start[i]) + (end[2 * n + i] - start[2 * n + i]);
            let mean = gained(n + i) / h;
            // q₁ − q₀ = h v₀ + h² (γ₀/2 − γ₁/6)
            let twice = (gained(i) / h - (start[n + i] + start[3 * n + i])) / h;
            let slope = T::lit(6.0) * (half * mean - twice);
            let (first, last) = (stages[i], stages[P::END * n + i]);
            gamma[i] = mean;
            gamma[n + i] = slope;
            gamma[2 * n + i] = half * (last + first) - mean;
            gamma[3 * n + i] = half * (last - first) - slope;
        }
        if 1 <= P::LAYERS {
            self.refine(&TWO)?;
        }
        if 2 <= P::LAYERS {
            self.refine(&FOUR)?;
        }
        Ok(())
    }

    /// Evaluates the accelerations at the places of a layer and makes its coefficients of them.
    ///
    /// Stages 1, 2, … are free for them: the next step writes them anew.
    fn refine<const M: usize>(&mut self, layer: &Layer<M>) -> Result<(), IntegratorsError<F::Error>> {
        let n = self.method.freedom;
        let signed = layer.places[1..].iter().flat_map(|&x| [x, -x]);
        for (number, x) in signed.enumerate() {
            let theta = 0.5 * (1.0 + x);
            let mut argument = core::mem::take(&mut self.method.argument);
            self.state_at(theta, &mut argument, None, 2 * M);
            let t = self.step.start + theta * self.step.length;
            let stage = &mut self.method.memory[(number + 1) * n..][..n];
            let evaluated = evaluate(self.field, t, &argument, stage);
            self.method.argument = argument;
            evaluated?;
            self.evaluations += 1;
        }
        let (stages, rest) = self.method.memory.split_at_mut(P::STAGES * n);
        let gamma = &mut rest[Rows::LEGENDRE * n..][..8 * n];
        let half = T::lit(0.5);
        for i in 0..n {
            let (mut even, mut odd) = ([T::zero(); M], [T::zero(); M]);
            for (m, &x) in layer.places.iter().enumerate() {
                let (plus, minus) = if m == 0 { (P::END, 0) } else { (2 * m - 1, 2 * m) };
                let (plus, minus) = (row(stages, plus, n)[i], row(stages, minus, n)[i]);
                even[m] = half * (plus + minus) - gamma[i];
                odd[m] = half * (plus - minus) - T::lit(x) * gamma[n + i];
            }
            for m in 0..M {
                let sum = |matrix: &[[f64; M]; M], values: &[T; M]| {
                    matrix[m].iter().zip(values).fold(T::zero(), |sum, (&w, &x)| sum + T::lit(w) * x)
                };
                gamma[(2 + 2 * m) * n + i] = sum(&layer.even, &even);
                gamma[(3 + 2 * m) * n + i] = sum(&layer.odd, &odd);
            }
        }
        Ok(())
    }
}

impl<P: NystromPair, T: Real, F: SecondOrder<T>> Dense<T, F::Error> for NystromStep<'_, P, T, F> {
    fn at(&mut self, t: f64, out: &mut [T]) -> Result<(), IntegratorsError<F::Error>> {
        NystromStep::at(self, t, out)
    }
    fn evaluations(&self) -> u64 {
        self.evaluations
    }
}
