//! Stand-in for the planned solver of piola-spectral.

use rustdct::{DctPlanner, TransformType2And3};
use std::sync::Arc;

use piola_numerics::Real;
pub trait Precision: Real + rustdct::DctNum {}
impl Precision for f32 {}
impl Precision for f64 {}

pub(crate) struct Standin<T, const D: usize> {
    points: [usize; D],
    sides: [f64; D],
    plans: Vec<Arc<dyn TransformType2And3<T>>>,
    scratch: Vec<T>,
    line: Vec<T>,
    first: f64,
    shear: f64,
}

impl<T: Precision, const D: usize> Standin<T, D> {
    pub(crate) fn new(points: [usize; D], sides: [f64; D], first: f64, shear: f64) -> Self {
        let mut planner = DctPlanner::new();
        let plans: Vec<_> = points.iter().map(|n| planner.plan_dct2(*n)).collect();
        let scratch = vec![T::lit(0.0); plans.iter().map(|p| p.get_scratch_len()).max().unwrap_or(0)];
        let line = vec![T::lit(0.0); 8 * points.iter().copied().max().unwrap_or(0)];
        Self { points, sides, plans, scratch, line, first, shear }
    }
    fn along(&mut self, field: &mut [T], axis: usize, is_sine: bool, is_inverse: bool) {
        let n = self.points[axis];
        let stride: usize = self.points[axis + 1..].iter().product();
        let outer = field.len() / (n * stride);
        let Self { plans, scratch, line, .. } = self;
        let scratch = &mut scratch[..plans[axis].get_scratch_len()];
        for o in 0..outer {
            let mut s0 = 0;
            while s0 < stride {
                let w = 8.min(stride - s0);
                for i in 0..n {
                    let at = (o * n + i) * stride + s0;
                    for k in 0..w {
                        line[k * n + i] = field[at + k];
                    }
                }
                for k in 0..w {
                    let l = &mut line[k * n..(k + 1) * n];
                    match (is_sine, is_inverse) {
                        (true, false) => plans[axis].process_dst2_with_scratch(l, scratch),
                        (true, true) => plans[axis].process_dst3_with_scratch(l, scratch),
                        (false, false) => plans[axis].process_dct2_with_scratch(l, scratch),
                        (false, true) => plans[axis].process_dct3_with_scratch(l, scratch),
                    }
                }
                for i in 0..n {
                    let at = (o * n + i) * stride + s0;
                    for k in 0..w {
                        field[at + k] = line[k * n + i];
                    }
                }
                s0 += w;
            }
        }
    }
    pub(crate) fn solve_in_place(&mut self, fields: [&mut [T]; D]) {
        let mut fields = fields;
        for c in 0..D {
            for a in 0..D {
                self.along(fields[c], a, a == c, false);
            }
        }
        let norm: f64 = self.points.iter().map(|n| 2.0 / *n as f64).product();
        let mut k = [0_usize; D];
        let strides: [usize; D] = std::array::from_fn(|a| self.points[a + 1..].iter().product());
        let limits = self.points.map(|n| n + 1);
        for _ in 0..limits.iter().product::<usize>() {
            let q: [f64; D] = std::array::from_fn(|a| k[a] as f64 * std::f64::consts::PI / self.sides[a]);
            let q2: f64 = q.iter().map(|q| q * q).sum();
            let mut at = [None; D];
            let mut f = [0.0; D];
            let mut dot = 0.0;
            for c in 0..D {
                let ok = k[c] >= 1 && (0..D).all(|a| a == c || k[a] < self.points[a]);
                if ok {
                    let p: usize = (0..D).map(|a| (k[a] - usize::from(a == c)) * strides[a]).sum();
                    at[c] = Some(p);
                    f[c] = fields[c][p].primal(0);
                    dot += q[c] * f[c];
                }
            }
            let nyquist = (0..D).any(|a| k[a] == self.points[a]);
            for c in 0..D {
                if let Some(p) = at[c] {
                    let u = if nyquist {
                        f[c] / (self.shear * q2 + (self.first + self.shear) * q[c] * q[c])
                    } else {
                        f[c] / (self.shear * q2)
                            - (self.first + self.shear) / (self.first + 2.0 * self.shear) * q[c] * dot
                                / (self.shear * q2 * q2)
                    };
                    fields[c][p] = T::lit(u * norm);
                }
            }
            for a in (0..D).rev() {
                k[a] += 1;
                if k[a] < limits[a] {
                    break;
                }
                k[a] = 0;
            }
        }
        for c in 0..D {
            for a in 0..D {
                self.along(fields[c], a, a == c, true);
            }
        }
    }
}
