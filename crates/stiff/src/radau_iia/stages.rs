//! The stages of a step by Newton's iteration in transformed variables.

use num_complex::Complex64;
use piola_integrators::internal::check_finite;
use piola_integrators::{IntegratorsError, State};

use super::aim::Aim;
use super::matrices::Matrices;
use super::norm::norm;
use super::tableau::{MOST_STAGES, Tableau};
use crate::StiffField;

/// Contraction at which the iteration is given up.
const HOPELESS: f64 = 0.99;
/// The same at the second sweep, where a good start may let the change grow once.
const EARLY: f64 = 2.0;
/// The ratio of two changes from which on they may be rounding, and how far they have fallen then.
const STANDING: f64 = 0.5;
const FALLEN: f64 = 1e-3;
/// The part of a stage that is rounding.
const ROUNDING: f64 = 64.0 * f64::EPSILON;
/// The farthest that the polynomial of a step is continued to start the next one, in lengths of the former.
const FAR: f64 = 3.0;

/// Memory of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    /// Z₁ … Zₛ, one after the other.
    pub(super) stages: Vec<f64>,
    /// Those of the last accepted step.
    pub(super) accepted: Vec<f64>,
    /// f at the stages, then the transformed right-hand sides.
    pub(super) rates: Vec<f64>,
    /// The residuals of the stages, then their corrections.
    pub(super) residuals: Vec<f64>,
    /// The state at the start of the last accepted step.
    pub(super) start: Vec<f64>,
    pub(super) start_carry: Vec<f64>,
    /// f at the start of the step, and at its end.
    pub(super) rate: Vec<f64>,
    pub(super) rate_at_end: Vec<f64>,
    pub(super) trial: Vec<f64>,
    pub(super) trial_carry: Vec<f64>,
    pub(super) matrices: Matrices,
    pair: Vec<Complex64>,
    pub(super) magnitudes: Vec<f64>,
    magnitudes_at_end: Vec<f64>,
    /// The error allowed in each component.
    pub(super) weights: Vec<f64>,
    pub(super) error: Vec<f64>,
    /// θ/(1 − θ) of the last iteration, by which the first change of the next is judged.
    pub(super) rest: f64,
}

/// How Newton's iteration ended.
#[derive(Debug)]
pub(super) enum Solved<E> {
    /// It converged in so many sweeps, each contracting by the factor, if there were two.
    Converged { sweeps: u32, contraction: Option<f64> },
    /// It would need a step shorter by the factor.
    Diverged { factor: f64, sweeps: u32, change: f64 },
    /// The field could not be evaluated at a stage.
    Refused(IntegratorsError<E>),
}

impl Workspace {
    /// Makes room for a run.
    ///
    /// # Errors
    /// Mass matrix and pattern must fit the field.
    pub(super) fn begin<F: StiffField>(
        &mut self,
        n: usize,
        most_stages: usize,
        field: &F,
    ) -> Result<(), IntegratorsError<F::Error>> {
        for buffer in [&mut self.stages, &mut self.accepted, &mut self.rates, &mut self.residuals] {
            buffer.resize(most_stages * n, 0.0);
        }
        for buffer in [
            &mut self.start,
            &mut self.start_carry,
            &mut self.rate,
            &mut self.rate_at_end,
            &mut self.trial,
            &mut self.trial_carry,
            &mut self.magnitudes,
            &mut self.magnitudes_at_end,
            &mut self.weights,
            &mut self.error,
        ] {
            buffer.resize(n, 0.0);
        }
        self.matrices.begin(n, most_stages / 2, field)?;
        self.pair.resize(n, Complex64::default());
        self.rest = 1.0;
        Ok(())
    }

    /// Starts the stages of a step of length h from the polynomial of the last one, of length `last`; from zero without.
    pub(super) fn predict(&mut self, tableau: &Tableau, h: f64, last: Option<(&Tableau, f64)>) {
        let n = self.rate.len();
        match last {
            Some((before, last)) if h / last <= FAR => {
                let end = &self.accepted[(before.stages() - 1) * n..][..n];
                for (c, stage) in tableau.nodes.iter().zip(self.stages.chunks_exact_mut(n.max(1))) {
                    let weights = before.weights_at(1.0 + c * (h / last));
                    for (k, z) in stage.iter_mut().enumerate() {
                        *z = -end[k];
                        for (weight, old) in weights.iter().zip(self.accepted.chunks_exact(n)).take(before.stages()) {
                            *z += weight * old[k];
                        }
                    }
                }
            }
            _ => self.stages.fill(0.0),
        }
    }

    /// Newton's iteration from what [`predict`](Self::predict) left.
    pub(super) fn solve<F: StiffField>(
        &mut self,
        field: &mut F,
        tableau: &Tableau,
        state: &State,
        h: f64,
        aim: Aim,
        evaluations: &mut u64,
    ) -> Solved<F::Error> {
        let (n, s) = (self.rate.len(), tableau.stages());
        // What earlier steps contracted by says nothing of one much longer, which may lead where the field is another.
        self.rest = if aim.is_familiar { self.rest.max(f64::EPSILON).powf(0.8) } else { 1.0 };
        let (mut first, mut before, mut ratio_before) = (f64::NAN, f64::NAN, f64::NAN);
        let mut contraction = None;
        // Changes of this size are rounding.
        let rounding = aim.unswept.max(if 0.0 < aim.relative { ROUNDING / aim.relative } else { 0.0 });
        for sweep in 1..=aim.most_sweeps {
            for i in 0..s {
                let (stage, rate) = (&self.stages[i * n..][..n], &mut self.rates[i * n..][..n]);
                for (k, trial) in self.trial.iter_mut().enumerate() {
                    *trial = state.values[k] + (state.carry[k] + stage[k]);
                }
                let t = state.time + tableau.nodes[i] * h;
                *evaluations += 1;
                if let Err(source) = field.rate(t, &self.trial, rate) {
                    return Solved::Refused(IntegratorsError::Field { t, source });
                }
                if let Err(error) = check_finite("rate", Some(state.time), rate) {
                    return Solved::Refused(error);
                }
            }
            self.correct(tableau, h);
            if sweep == 1 {
                // A start from zero has no magnitude; where the step leads it has one.
                self.weigh(field, tableau, state, h, aim);
            }
            let change = norm(&self.residuals[..s * n], &self.weights);
            if !change.is_finite() {
                return Solved::Diverged { factor: 0.25, sweeps: sweep, change };
            }
            if 1 < sweep {
                let ratio = change / before;
                let theta = if sweep == 2 { ratio } else { (ratio * ratio_before).sqrt() };
                ratio_before = ratio;
                contraction = Some(theta);
                // Rounding does not contract: J times the rounding of y, where the field is stiff.
                let is_noise = STANDING <= ratio && change <= aim.noise && change <= FALLEN * first;
                let is_rounding = change <= rounding || is_noise;
                let limit = if sweep == 2 { EARLY } else { HOPELESS };
                if limit <= theta || theta.is_nan() {
                    return if is_rounding {
                        Solved::Converged { sweeps: sweep, contraction: None }
                    } else {
                        Solved::Diverged { factor: 0.5, sweeps: sweep, change }
                    };
                }
                self.rest = if theta < HOPELESS { theta / (1.0 - theta) } else { f64::INFINITY };
                let left = aim.most_sweeps - sweep;
                #[expect(clippy::cast_possible_wrap, reason = "a few dozen sweeps")]
                let expected = self.rest * change * theta.powi(left as i32) / aim.unswept;
                if is_noise && 1.0 <= expected {
                    return Solved::Converged { sweeps: sweep, contraction: None };
                }
                if 2 < sweep && 0 < left && 1.0 <= expected && !is_rounding {
                    let factor = 0.8 * expected.clamp(1e-4, 20.0).powf(-1.0 / f64::from(4 + left));
                    return Solved::Diverged { factor, sweeps: sweep, change };
                }
            } else {
                first = change;
            }
            if self.rest * change <= aim.unswept {
                return Solved::Converged { sweeps: sweep, contraction };
            }
            before = change;
        }
        Solved::Diverged { factor: 0.5, sweeps: aim.most_sweeps, change: before }
    }

    /// One correction of Z from f at the stages; it is left in `residuals`.
    fn correct(&mut self, tableau: &Tableau, h: f64) {
        let (n, s) = (self.rate.len(), tableau.stages());
        // r = h A f − M Z: small where the iteration has converged, so that only then it is transformed.
        apply(tableau.matrix, s, h, &self.rates, &mut self.residuals, n);
        for (z, r) in self.stages.chunks_exact(n.max(1)).zip(self.residuals.chunks_exact_mut(n.max(1))).take(s) {
            self.matrices.subtract_mass_times(z, r);
        }
        // Λ/h T⁻¹ r.
        apply(tableau.inverse, s, 1.0 / h, &self.residuals, &mut self.rates, n);
        let (real, pairs) = self.rates.split_at_mut(n);
        for r in &mut *real {
            *r *= tableau.real;
        }
        self.matrices.solve_real(real);
        let pairs = pairs.chunks_exact_mut((2 * n).max(1));
        for (k, (pair, [alpha, beta])) in pairs.zip(tableau.pairs).enumerate() {
            let (r2, r3) = pair.split_at_mut(n);
            for ((x, &r2), &r3) in self.pair.iter_mut().zip(&*r2).zip(&*r3) {
                *x = Complex64::new(alpha * r2 + beta * r3, alpha * r3 - beta * r2);
            }
            self.matrices.solve_complex(k, &mut self.pair);
            for ((x, re), im) in self.pair.iter().zip(r2).zip(r3) {
                (*re, *im) = (x.re, x.im);
            }
        }
        apply(tableau.transformation, s, 1.0, &self.rates, &mut self.residuals, n);
        for (z, change) in self.stages.iter_mut().zip(&self.residuals[..s * n]) {
            *z += change;
        }
    }

    /// The error allowed in each component, from the magnitudes at both ends of the step.
    pub(super) fn weigh<F: StiffField>(&mut self, field: &F, tableau: &Tableau, state: &State, h: f64, aim: Aim) {
        let n = self.rate.len();
        let end = &self.stages[(tableau.stages() - 1) * n..][..n];
        for (k, trial) in self.trial.iter_mut().enumerate() {
            *trial = state.values[k] + (state.carry[k] + end[k]);
        }
        field.magnitudes(&self.trial, &mut self.magnitudes_at_end);
        for (k, weight) in self.weights.iter_mut().enumerate() {
            let magnitude = self.magnitudes[k].max(self.magnitudes_at_end[k]);
            *weight = aim.absolute + aim.relative * magnitude;
            for _ in 1..field.index(k) {
                *weight /= h.abs().min(1.0);
            }
        }
    }
}

/// out ← factor (matrix ⊗ I) x, of s blocks of n.
fn apply(matrix: &[f64], s: usize, factor: f64, x: &[f64], out: &mut [f64], n: usize) {
    match s {
        3 => apply_unrolled::<3>(matrix, factor, x, out, n),
        5 => apply_unrolled::<5>(matrix, factor, x, out, n),
        _ => apply_unrolled::<MOST_STAGES>(matrix, factor, x, out, n),
    }
}

/// [`apply`], one component of all blocks after the other.
fn apply_unrolled<const S: usize>(matrix: &[f64], factor: f64, x: &[f64], out: &mut [f64], n: usize) {
    let (rows, _) = matrix.as_chunks::<S>();
    for k in 0..n {
        let x: [f64; S] = core::array::from_fn(|j| x[j * n + k]);
        for (i, row) in rows.iter().enumerate() {
            let mut sum = 0.0;
            for j in 0..S {
                sum += row[j] * x[j];
            }
            out[i * n + k] = factor * sum;
        }
    }
}
