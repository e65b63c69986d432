//! Differences of second order on a staggered grid, solved by conjugate gradients without a matrix.

#![expect(clippy::needless_range_loop, reason = "components and places are the indices of the equations")]

use piola_spectral::LameParameters;

/// Equal cells of the unit cube between sliding walls. Component c stands on the faces across axis c; the first face of
/// a row lies in the wall, where it stays zero.
#[derive(Clone, Debug)]
pub struct Staggered {
    n: usize,
    lame: LameParameters,
    dilatation: Vec<f64>,
}

/// The end of a solution.
#[derive(Clone, Copy, Debug)]
pub struct Solved {
    /// Steps of conjugate gradients.
    pub steps: usize,
    /// ‖r‖/‖f‖ at the end.
    pub residual: f64,
}

type Fields = [Vec<f64>; 3];

impl Staggered {
    /// With n cells along each axis.
    #[must_use]
    pub fn new(n: usize, lame: LameParameters) -> Self {
        Self { n, lame, dilatation: vec![0.0; n * n * n] }
    }

    /// Places of the first value of a component, in spacings.
    #[must_use]
    pub fn offset(component: usize) -> [f64; 3] {
        std::array::from_fn(|axis| if axis == component { 0.0 } else { 0.5 })
    }

    /// Solves Ku = f from rest until the residual has fallen by `tolerance`.
    #[must_use]
    pub fn solve(&mut self, force: &Fields, tolerance: f64) -> (Fields, Solved) {
        let mut u: Fields = std::array::from_fn(|_| vec![0.0; force[0].len()]);
        let mut residual = force.clone();
        for c in 0..3 {
            self.wall(&mut residual[c], c);
        }
        let mut direction = residual.clone();
        let mut image = u.clone();
        let start = product(&residual, &residual);
        let mut squared = start;
        let mut steps = 0;
        while tolerance * tolerance * start < squared && steps < 100 * self.n {
            self.apply(&direction, &mut image);
            let length = squared / product(&direction, &image);
            add(&mut u, length, &direction);
            add(&mut residual, -length, &image);
            let next = product(&residual, &residual);
            let share = next / squared;
            for (direction, residual) in direction.iter_mut().flatten().zip(residual.iter().flatten()) {
                *direction = residual + share * *direction;
            }
            squared = next;
            steps += 1;
        }
        (u, Solved { steps, residual: (squared / start).sqrt() })
    }

    /// −Lu.
    fn apply(&mut self, u: &Fields, out: &mut Fields) {
        let n = self.n;
        let square = (n * n) as f64;
        let (mu, both) = (self.lame.shear_modulus() * square, (self.lame.first() + self.lame.shear_modulus()) * square);
        self.dilatation.fill(0.0);
        for (c, u) in u.iter().enumerate() {
            let stride = self.stride(c);
            for row in 0..n * n {
                let start = row * n;
                let last = self.index(start, c) + 1 == n;
                let place = |k: usize| start + k;
                if c == 2 {
                    for k in 0..n - 1 {
                        self.dilatation[place(k)] += u[place(k + 1)] - u[place(k)];
                    }
                    self.dilatation[place(n - 1)] -= u[place(n - 1)];
                } else if last {
                    for k in 0..n {
                        self.dilatation[place(k)] -= u[place(k)];
                    }
                } else {
                    for k in 0..n {
                        self.dilatation[place(k)] += u[place(k) + stride] - u[place(k)];
                    }
                }
            }
        }
        for c in 0..3 {
            out[c].fill(0.0);
            for axis in 0..3 {
                self.second_differences(&u[c], &mut out[c], axis, axis == c, mu);
            }
            let stride = self.stride(c);
            for row in 0..n * n {
                let start = row * n;
                if c < 2 && self.index(start, c) == 0 {
                    continue;
                }
                let first = usize::from(c == 2);
                for place in start + first..start + n {
                    out[c][place] -= both * (self.dilatation[place] - self.dilatation[place - stride]);
                }
            }
            self.wall(&mut out[c], c);
        }
    }

    /// Adds −μu″ along an axis: zero beyond both ends if `fixed`, no slope there if not.
    fn second_differences(&self, u: &[f64], out: &mut [f64], axis: usize, fixed: bool, mu: f64) {
        let n = self.n;
        let stride = self.stride(axis);
        let mut add = |place: usize, index: usize| {
            let below = if 0 < index { u[place] - u[place - stride] } else { 0.0 };
            let above = if index + 1 < n {
                u[place] - u[place + stride]
            } else if fixed {
                u[place]
            } else {
                0.0
            };
            out[place] += mu * (below + above);
        };
        for row in 0..n * n {
            let start = row * n;
            if axis == 2 {
                for k in 0..n {
                    add(start + k, k);
                }
            } else {
                let index = self.index(start, axis);
                for k in 0..n {
                    add(start + k, index);
                }
            }
        }
    }

    /// Sets what lies in the wall to zero.
    fn wall(&self, field: &mut [f64], component: usize) {
        let n = self.n;
        for row in 0..n * n {
            if component == 2 {
                field[row * n] = 0.0;
            } else if self.index(row * n, component) == 0 {
                field[row * n..(row + 1) * n].fill(0.0);
            }
        }
    }

    fn stride(&self, axis: usize) -> usize {
        [self.n * self.n, self.n, 1][axis]
    }

    fn index(&self, place: usize, axis: usize) -> usize {
        place / self.stride(axis) % self.n
    }
}

fn product(a: &Fields, b: &Fields) -> f64 {
    let part = |a: &[f64], b: &[f64]| -> f64 {
        // Eight sums at once, as fast as memory gives them.
        let mut sums = [0.0; 8];
        for (a, b) in a.chunks(8).zip(b.chunks(8)) {
            for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
                *sum += a * b;
            }
        }
        sums.iter().sum()
    };
    a.iter().zip(b).map(|(a, b)| part(a, b)).sum()
}

fn add(to: &mut Fields, factor: f64, what: &Fields) {
    for (to, what) in to.iter_mut().zip(what) {
        for (to, what) in to.iter_mut().zip(what) {
            *to += factor * what;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Staggered;
    use crate::boxes::problem::{displacements, forces, lame};
    use piola_testkit::relative_error;

    fn error(n: usize) -> f64 {
        let lame = lame().expect("elliptic");
        let (u, solved) = Staggered::new(n, lame).solve(&forces(lame, n, Staggered::offset), 1e-9);
        assert!(solved.residual <= 1e-9, "{solved:?}");
        relative_error(&u.concat(), &displacements(n, Staggered::offset).concat())
    }

    #[test]
    fn differences_are_of_second_order() {
        let (coarse, fine) = (error(8), error(16));
        let order = (coarse / fine).log2();
        assert!((order - 2.0).abs() < 0.2, "order {order}: {coarse:.2e}, {fine:.2e}");
    }
}
