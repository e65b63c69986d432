//! One trial step: its stages, its end and its error.

use piola_numerics::Real;

use super::coefficients as c;
use super::{DormandPrince853, error_of_pair, evaluate};
use crate::field::largest_lane;
use crate::state::{check_finite, compensated_add};
use crate::{Field, IntegratorsError, Report, State};

impl<T: Real> DormandPrince853<T> {
    /// Makes the stages of one step and its end in `trial`; returns the error over the tolerance.
    pub(super) fn try_step<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &State<T>,
        h: f64,
        report: &mut Report,
    ) -> Result<f64, IntegratorsError<F::Error>> {
        let t = state.time;
        let y = (&state.values[..], &state.carry[..]);
        let k = &mut self.stages;
        let trial = &mut self.trial;
        macro_rules! stage {
            ($number:literal, $row:expr) => {
                combine(&$row, k, y, h, trial);
                report.evaluations += 1;
                evaluate(field, t + c::C[$number] * h, trial, &mut k[$number])?;
            };
        }
        stage!(1, c::A2);
        stage!(2, c::A3);
        stage!(3, c::A4);
        stage!(4, c::A5);
        stage!(5, c::A6);
        stage!(6, c::A7);
        stage!(7, c::A8);
        stage!(8, c::A9);
        stage!(9, c::A10);
        stage!(10, c::A11);
        stage!(11, c::A12);
        let error = self.finish(field, state, h);
        if error <= 1.0 {
            field.project(t + h, &mut self.trial).map_err(|source| IntegratorsError::Field { t: t + h, source })?;
            report.evaluations += 1;
            evaluate(field, t + h, &self.trial, &mut self.stages[12])?;
            check_finite("rate", Some(t), &self.stages[12])?;
        } else if error.is_nan() {
            for rate in &self.stages[1..12] {
                check_finite("rate", Some(t), rate)?;
            }
        }
        Ok(error)
    }

    /// The end of the step, and its error over the tolerance.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn finish<F: Field<T>>(&mut self, field: &F, state: &State<T>, h: f64) -> f64 {
        let n = self.trial.len();
        // E5 has the stages of B; those of B3 are among them.
        let h_lit = T::lit(h);
        let (y, carry) = (&state.values[..n], &state.carry[..n]);
        let (trial, trial_carry) = (&mut self.trial[..n], &mut self.trial_carry[..n]);
        let [fifth_error, third_error, ..] = self.interpolant.each_mut().map(|f| &mut f[..n]);
        weighted_sums(&c::E5, &self.stages, fifth_error);
        weighted_sums(&c::B, &self.stages, trial);
        weighted_sums(&c::B3, &self.stages, third_error);
        for (i, trial) in trial.iter_mut().enumerate() {
            let slope = *trial;
            third_error[i] = slope - third_error[i];
            (*trial, trial_carry[i]) = (y[i], carry[i]);
            compensated_add(trial, &mut trial_carry[i], slope * h_lit);
        }

        field.magnitudes(trial, &mut self.magnitudes_at_end);
        let (absolute, relative) = (self.tolerance.absolute_part(), self.tolerance.relative_part());
        let (mut fifth, mut third) = (0.0, 0.0);
        for (((e5, e3), &before), &after) in
            fifth_error.iter().zip(&*third_error).zip(&self.magnitudes).zip(&self.magnitudes_at_end)
        {
            let allowed = absolute + relative * if before < after { after } else { before };
            let (e5, e3) = (largest_lane(*e5), largest_lane(*e3));
            // An exact component is exact whatever the tolerance: also where its magnitude is zero.
            let allowed = if e5 <= 0.0 && e3 <= 0.0 { 1.0 } else { allowed };
            let (e5, e3) = (e5 / allowed, e3 / allowed);
            fifth += e5 * e5;
            third += e3 * e3;
        }
        error_of_pair(fifth, third, n, h)
    }
}

/// Components worked on at once: small systems are one block, whose sums the compiler keeps in registers.
const BLOCK: usize = 4;

/// Blocks of a system of n components: none beyond the size where the plain loop, in vector registers, is faster.
const fn blocks_of(n: usize) -> usize {
    if n < 16 { n / BLOCK } else { 0 }
}

/// y + (carry + h Σ aⱼ kⱼ).
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn combine<T: Real, const M: usize>(
    row: &[(usize, f64); M],
    stages: &[Vec<T>; 16],
    (y, carry): (&[T], &[T]),
    h: f64,
    out: &mut [T],
) {
    let n = out.len();
    let h = T::lit(h);
    let weights: [T; M] = core::array::from_fn(|m| T::lit(row[m].1));
    let terms: [&[T]; M] = core::array::from_fn(|m| &stages[row[m].0][..n]);
    let (y, carry) = (&y[..n], &carry[..n]);
    let blocks = blocks_of(n);
    let term_blocks: [&[[T; BLOCK]]; M] = core::array::from_fn(|m| &terms[m].as_chunks::<BLOCK>().0[..blocks]);
    let (y_blocks, carry_blocks) = (&y.as_chunks::<BLOCK>().0[..blocks], &carry.as_chunks::<BLOCK>().0[..blocks]);
    for (b, out) in out.as_chunks_mut::<BLOCK>().0[..blocks].iter_mut().enumerate() {
        let sum = sum_of_terms(&weights, |m| term_blocks[m][b]);
        for l in 0..BLOCK {
            out[l] = y_blocks[b][l] + (carry_blocks[b][l] + h * sum[l]);
        }
    }
    for i in blocks * BLOCK..n {
        let [sum] = sum_of_terms(&weights, |m| [terms[m][i]]);
        out[i] = y[i] + (carry[i] + h * sum);
    }
}

/// Writes Σ aⱼ kⱼ, for rows whose length the compiler knows.
///
/// The sum runs over even and odd terms apart, which halves the time spent waiting for additions.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(super) fn weighted_sums<T: Real, const M: usize>(row: &[(usize, f64); M], stages: &[Vec<T>; 16], out: &mut [T]) {
    let n = out.len();
    let weights: [T; M] = core::array::from_fn(|m| T::lit(row[m].1));
    let terms: [&[T]; M] = core::array::from_fn(|m| &stages[row[m].0][..n]);
    let blocks = blocks_of(n);
    let term_blocks: [&[[T; BLOCK]]; M] = core::array::from_fn(|m| &terms[m].as_chunks::<BLOCK>().0[..blocks]);
    let (out_blocks, _) = out.as_chunks_mut::<BLOCK>();
    for (b, out) in out_blocks[..blocks].iter_mut().enumerate() {
        *out = sum_of_terms(&weights, |m| term_blocks[m][b]);
    }
    for i in blocks * BLOCK..n {
        [out[i]] = sum_of_terms(&weights, |m| [terms[m][i]]);
    }
}

/// Σ aⱼ kⱼ, even and odd terms apart.
#[cfg_attr(not(debug_assertions), inline(always))]
fn sum_of_terms<T: Real, const M: usize, const N: usize>(weights: &[T; M], term: impl Fn(usize) -> [T; N]) -> [T; N] {
    let first = term(0);
    let mut even: [T; N] = core::array::from_fn(|l| weights[0] * first[l]);
    if M == 1 {
        return even;
    }
    let second = term(1);
    let mut odd: [T; N] = core::array::from_fn(|l| weights[1] * second[l]);
    for (m, &weight) in weights.iter().enumerate().skip(2) {
        let term = term(m);
        let sum = if m % 2 == 0 { &mut even } else { &mut odd };
        for l in 0..N {
            sum[l] += weight * term[l];
        }
    }
    core::array::from_fn(|l| even[l] + odd[l])
}
