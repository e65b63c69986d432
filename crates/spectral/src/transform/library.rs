//! Transforms of lines of any length by `rustfft`, two lines at a time as the parts of complex numbers.
//!
//! The definitions are those of the modules `cosine` and `nodal`. For lengths that those cannot split.

use std::f64::consts::PI;
use std::fmt;
use std::sync::Arc;

use rustfft::num_complex::Complex;
use rustfft::{Fft, FftPlanner};

use crate::Precision;
use crate::grid::PointLocation;
use crate::transform::{Line, WIDTH};
use crate::walls::Parity;

/// A planned transform of lines of any length.
#[derive(Clone)]
pub(super) struct LibraryPlan<T> {
    forward: Arc<dyn Fft<T>>,
    backward: Arc<dyn Fft<T>>,
    location: PointLocation,
    /// Samples of a line.
    points: usize,
    /// e^{−iπk/2n} for cells.
    turns: Vec<Complex<T>>,
}

impl<T> fmt::Debug for LibraryPlan<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("LibraryPlan")
            .field("points", &self.points)
            .field("location", &self.location)
            .finish_non_exhaustive()
    }
}

impl<T: Precision> LibraryPlan<T> {
    pub(super) fn new(points: usize, location: PointLocation) -> Self {
        let mut planner = FftPlanner::new();
        let length = match location {
            PointLocation::Cells => points,
            PointLocation::Nodes => 2 * (points - 1),
        };
        let turns = (0..points).map(|k| {
            let (sin, cos) = (PI * k as f64 / (2 * points) as f64).sin_cos();
            Complex::new(T::lit(cos), T::lit(-sin))
        });
        Self {
            forward: planner.plan_fft_forward(length),
            backward: planner.plan_fft_inverse(length),
            location,
            points,
            turns: turns.collect(),
        }
    }

    /// Complex numbers of memory that a transform needs.
    pub(super) fn scratch(&self) -> usize {
        self.forward.len() + self.forward.get_inplace_scratch_len().max(self.backward.get_inplace_scratch_len())
    }

    pub(super) fn to_modes(&self, parity: Parity, panel: &mut [Line<T>], memory: &mut [Complex<T>]) {
        match self.location {
            PointLocation::Cells => self.cells_to_modes(parity, panel, memory),
            PointLocation::Nodes => self.nodes(parity, panel, memory),
        }
    }

    pub(super) fn to_samples(&self, parity: Parity, panel: &mut [Line<T>], memory: &mut [Complex<T>]) {
        match self.location {
            PointLocation::Cells => self.cells_to_samples(parity, panel, memory),
            PointLocation::Nodes => self.nodes(parity, panel, memory),
        }
    }

    fn cells_to_modes(&self, parity: Parity, panel: &mut [Line<T>], memory: &mut [Complex<T>]) {
        let n = self.points;
        let (z, rest) = memory.split_at_mut(n);
        let (sign, half) = (sign_of::<T>(parity), T::lit(0.5));
        for lane in (0..WIDTH).step_by(2) {
            for m in 0..n {
                // The even samples, then the odd ones backwards.
                let (place, sign) = if m % 2 == 0 { (m / 2, T::lit(1.0)) } else { (n - 1 - m / 2, sign) };
                z[place] = Complex::new(sign * panel[m].0[lane], sign * panel[m].0[lane + 1]);
            }
            self.forward.process_with_scratch(z, rest);
            for i in 0..n {
                let (a, b) = (z[i], z[(n - i) % n].conj());
                let (first, second) = ((a + b) * self.turns[i], (a - b) * self.turns[i]);
                let slot = if parity == Parity::Sine { (n - i) % n } else { i };
                panel[slot].0[lane] = half * first.re;
                panel[slot].0[lane + 1] = half * second.im;
            }
        }
    }

    fn cells_to_samples(&self, parity: Parity, panel: &mut [Line<T>], memory: &mut [Complex<T>]) {
        let n = self.points;
        let (z, rest) = memory.split_at_mut(n);
        let (sign, half) = (sign_of::<T>(parity), T::lit(0.5));
        for lane in (0..WIDTH).step_by(2) {
            for (i, z) in z.iter_mut().enumerate() {
                let slot = |i: usize| if parity == Parity::Sine { (n - i) % n } else { i };
                let (near, far) = (panel[slot(i)], if i == 0 { Line::splat(T::lit(0.0)) } else { panel[slot(n - i)] });
                let of = |lane: usize| Complex::new(near.0[lane], -far.0[lane]) * self.turns[i].conj();
                let (a, b) = (of(lane), of(lane + 1));
                *z = Complex::new(half * (a.re - b.im), half * (a.im + b.re));
            }
            self.backward.process_with_scratch(z, rest);
            for m in 0..n {
                let (place, sign) = if m % 2 == 0 { (m / 2, T::lit(1.0)) } else { (n - 1 - m / 2, sign) };
                panel[m].0[lane] = sign * z[place].re;
                panel[m].0[lane + 1] = sign * z[place].im;
            }
        }
    }

    fn nodes(&self, parity: Parity, panel: &mut [Line<T>], memory: &mut [Complex<T>]) {
        let last = self.points - 1;
        let (z, rest) = memory.split_at_mut(2 * last);
        let half = T::lit(0.5);
        let zero = Complex::new(T::lit(0.0), T::lit(0.0));
        for lane in (0..WIDTH).step_by(2) {
            let sign = sign_of::<T>(parity);
            for m in 0..=last {
                let x = Complex::new(panel[m].0[lane], panel[m].0[lane + 1]);
                z[m] = x;
                if 0 < m && m < last {
                    z[2 * last - m] = x * sign;
                }
            }
            if parity == Parity::Sine {
                z[0] = zero;
                z[last] = zero;
            }
            self.forward.process_with_scratch(z, rest);
            for i in 0..=last {
                let value = match parity {
                    Parity::Cosine => z[i],
                    Parity::Sine if i == 0 || i == last => zero,
                    // The transform of an odd line is −2i times the sum of sines.
                    Parity::Sine => Complex::new(-z[i].im, z[i].re),
                };
                panel[i].0[lane] = half * value.re;
                panel[i].0[lane + 1] = half * value.im;
            }
        }
    }
}

fn sign_of<T: Precision>(parity: Parity) -> T {
    T::lit(if parity == Parity::Sine { -1.0 } else { 1.0 })
}
