//! The same method with transforms of other libraries: every line is copied out, transformed and copied back.

#![expect(missing_debug_implementations, reason = "plans of other crates have none")]

use std::f64::consts::PI;
use std::sync::Arc;

use piola_spectral::LameParameters;
use realfft::num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustdct::{DctPlanner, TransformType2And3};

/// Transforms of a line between samples at centres of cells and cosines: type II forward, type III back, without factors.
pub trait LineTransform {
    /// From samples to cosines: X(k) = Σ x(j) cos(πk(j + ½)/n).
    fn forward(&mut self, line: &mut [f64]);
    /// Back, times n/2.
    fn back(&mut self, line: &mut [f64]);
}

/// `rustdct`.
pub struct Rustdct {
    plan: Arc<dyn TransformType2And3<f64>>,
    scratch: Vec<f64>,
}

impl Rustdct {
    /// Planned for lines of n.
    #[must_use]
    pub fn new(n: usize) -> Self {
        let plan = DctPlanner::new().plan_dct2(n);
        let scratch = vec![0.0; plan.get_scratch_len()];
        Self { plan, scratch }
    }
}

impl LineTransform for Rustdct {
    fn forward(&mut self, line: &mut [f64]) {
        self.plan.process_dct2_with_scratch(line, &mut self.scratch);
    }

    fn back(&mut self, line: &mut [f64]) {
        self.plan.process_dct3_with_scratch(line, &mut self.scratch);
    }
}

/// `realfft` with Makhoul's order of the samples: even places forward, odd ones backward; then one rotation for each k.
pub struct Realfft {
    forward: Arc<dyn RealToComplex<f64>>,
    back: Arc<dyn ComplexToReal<f64>>,
    real: Vec<f64>,
    complex: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    /// e^{−iπk/2n}.
    turns: Vec<Complex<f64>>,
}

impl Realfft {
    /// Planned for lines of n, which must be even.
    #[must_use]
    pub fn new(n: usize) -> Self {
        let mut planner = RealFftPlanner::new();
        let (forward, back) = (planner.plan_fft_forward(n), planner.plan_fft_inverse(n));
        let scratch = vec![Complex::default(); forward.get_scratch_len().max(back.get_scratch_len())];
        let turns = (0..=n / 2).map(|k| Complex::from_polar(1.0, -PI * k as f64 / (2 * n) as f64)).collect();
        Self { forward, back, real: vec![0.0; n], complex: vec![Complex::default(); n / 2 + 1], scratch, turns }
    }
}

impl LineTransform for Realfft {
    fn forward(&mut self, line: &mut [f64]) {
        let n = line.len();
        for j in 0..n / 2 {
            self.real[j] = line[2 * j];
            self.real[n - 1 - j] = line[2 * j + 1];
        }
        // The lengths are those of the plan.
        let _ = self.forward.process_with_scratch(&mut self.real, &mut self.complex, &mut self.scratch);
        for k in 0..=n / 2 {
            let turned = self.turns[k] * self.complex[k];
            line[k] = turned.re;
            if 0 < k && k < n - k {
                line[n - k] = -turned.im;
            }
        }
    }

    fn back(&mut self, line: &mut [f64]) {
        let n = line.len();
        self.complex[0] = Complex::new(line[0], 0.0);
        for k in 1..=n / 2 {
            self.complex[k] = self.turns[k].conj() * Complex::new(line[k], -line[n - k]);
        }
        // Real by symmetry, up to rounding.
        self.complex[n / 2].im = 0.0;
        let _ = self.back.process_with_scratch(&mut self.complex, &mut self.real, &mut self.scratch);
        for j in 0..n / 2 {
            line[2 * j] = 0.5 * self.real[j];
            line[2 * j + 1] = 0.5 * self.real[n - 1 - j];
        }
    }
}

/// The static solution between sliding walls on the unit cube of n × n × n cells, in place.
pub struct PlainSolver<L> {
    n: usize,
    lame: LameParameters,
    transform: L,
    line: Vec<f64>,
}

impl<L: LineTransform> PlainSolver<L> {
    /// Planned for n cells along each axis.
    pub fn new(n: usize, lame: LameParameters, transform: L) -> Self {
        Self { n, lame, transform, line: vec![0.0; n] }
    }

    /// Forces in, displacements out.
    pub fn solve(&mut self, fields: &mut [Vec<f64>; 3]) {
        for (component, field) in fields.iter_mut().enumerate() {
            for axis in 0..3 {
                self.lines(field, axis, axis == component, true);
            }
        }
        self.divide(fields);
        for (component, field) in fields.iter_mut().enumerate() {
            for axis in 0..3 {
                self.lines(field, axis, axis == component, false);
            }
        }
    }

    /// Transforms all lines along an axis. Sines are cosines of the samples with alternating signs, in reverse order.
    fn lines(&mut self, field: &mut [f64], axis: usize, sine: bool, forward: bool) {
        let n = self.n;
        let stride = n.pow(2 - u32::try_from(axis).unwrap_or(0));
        for start in (0..n * n).map(|line| line / stride * stride * n + line % stride) {
            for (j, value) in self.line.iter_mut().enumerate() {
                *value = field[start + j * stride];
            }
            let alternate = |line: &mut [f64]| line.iter_mut().skip(1).step_by(2).for_each(|value| *value = -*value);
            if sine && forward {
                alternate(&mut self.line);
            } else if sine {
                self.line.reverse();
            }
            if forward {
                self.transform.forward(&mut self.line);
            } else {
                self.transform.back(&mut self.line);
            }
            if sine && forward {
                self.line.reverse();
            } else if sine {
                alternate(&mut self.line);
            }
            for (j, value) in self.line.iter().enumerate() {
                field[start + j * stride] = *value;
            }
        }
    }

    /// û = (f̂ − (λ + μ)/(λ + 2μ) q (q·f̂)/q²)/(μq²) for every wave vector q = πk.
    fn divide(&self, fields: &mut [Vec<f64>; 3]) {
        let n = self.n;
        let (first, mu) = (self.lame.first(), self.lame.shear_modulus());
        let share = (first + mu) / (first + 2.0 * mu);
        let scale = (2.0 / n as f64).powi(3);
        for i in 0..=n {
            for j in 0..=n {
                for k in 0..=n {
                    let q = [i, j, k].map(|index| PI * index as f64);
                    // Where a component's coefficient stands: sines begin with k = 1, cosines end with k = n − 1.
                    let place = |component: usize| {
                        let mut place = 0;
                        for (axis, index) in [i, j, k].into_iter().enumerate() {
                            let index = if axis == component { index.checked_sub(1)? } else { index };
                            place = place * n + (index < n).then_some(index)?;
                        }
                        Some(place)
                    };
                    let places: [_; 3] = std::array::from_fn(place);
                    let squared: f64 = q.iter().map(|q| q * q).sum();
                    let value = |c: usize| places[c].map_or(0.0, |place| fields[c][place]);
                    let along: f64 = (0..3).map(|c| q[c] * value(c)).sum();
                    for c in 0..3 {
                        if let Some(place) = places[c] {
                            fields[c][place] =
                                scale * (fields[c][place] - share * q[c] * along / squared) / (mu * squared);
                        }
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{LineTransform, PlainSolver, Realfft, Rustdct};
    use crate::boxes::problem::{centres, displacements, forces, lame};
    use piola_testkit::relative_error;

    fn error(n: usize, transform: impl LineTransform) -> f64 {
        let lame = lame().expect("elliptic");
        let mut fields = forces(lame, n, centres);
        PlainSolver::new(n, lame, transform).solve(&mut fields);
        relative_error(&fields.concat(), &displacements(n, centres).concat())
    }

    #[test]
    fn other_transforms_give_the_same_solution() {
        assert!(error(24, Rustdct::new(24)) < 1e-12);
        assert!(error(24, Realfft::new(24)) < 1e-12);
    }
}
