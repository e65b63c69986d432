//! A smooth displacement of the unit cube between sliding walls, with its force in closed form.
//!
//! ```text
//! u_c(x) = s(x_c) Π_{d≠c} b(x_d),    s(x) = sin πx e^{cos πx},  b(x) = e^{½ cos πx}
//! f = −μ Δu − (λ + μ) ∇(∇·u)
//! ```
//! All wave numbers take part, and u obeys walls that hold its normal component and no shear.
//!
//! # Example
//! ```
//! use piola_testkit::smooth_cube::{displacement, force};
//! assert!(displacement([0.0, 0.3, 0.7])[0].abs() < 1e-15);
//! assert!(force([1.5, 0.75], [0.5, 0.5, 0.5]).iter().all(|f| f.is_finite()));
//! ```

use std::f64::consts::PI;

/// s and b at x, each with its derivatives of order up to two.
fn factors(x: f64) -> [[f64; 3]; 2] {
    let (s, c) = (PI * x).sin_cos();
    let (e, b) = (c.exp(), (0.5 * c).exp());
    let sine = [s * e, PI * (c - s * s) * e, PI * PI * e * s * (s * s - 1.0 - 3.0 * c)];
    [sine, [b, -0.5 * PI * s * b, PI * PI * b * (0.25 * s * s - 0.5 * c)]]
}

/// A derivative of component c of u, once along each of the axes.
fn derivative(table: &[[[f64; 3]; 2]; 3], component: usize, axes: &[usize]) -> f64 {
    let mut orders = [0; 3];
    for &axis in axes {
        orders[axis] += 1;
    }
    (0..3).map(|axis| table[axis][usize::from(axis != component)][orders[axis]]).product()
}

/// u at x.
#[must_use]
pub fn displacement(x: [f64; 3]) -> [f64; 3] {
    let table = x.map(factors);
    [0, 1, 2].map(|component| derivative(&table, component, &[]))
}

/// f at x, with Lamé's λ and μ.
#[must_use]
pub fn force([first, mu]: [f64; 2], x: [f64; 3]) -> [f64; 3] {
    let table = x.map(factors);
    [0, 1, 2].map(|c| {
        let laplacian: f64 = (0..3).map(|axis| derivative(&table, c, &[axis, axis])).sum();
        let dilatation: f64 = (0..3).map(|other| derivative(&table, other, &[other, c])).sum();
        -mu * laplacian - (first + mu) * dilatation
    })
}

#[cfg(test)]
mod tests {
    use super::{displacement, force};

    /// Against central differences of the displacement, whose error is h²/12 of fourth derivatives.
    #[test]
    fn force_is_that_of_the_displacement() {
        let (x, h) = ([0.31, 0.62, 0.17], 1e-3);
        let second = |component: usize, a: usize, b: usize| {
            let mut sum = 0.0;
            for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
                let mut place = x;
                place[a] += 0.5 * s * h;
                place[b] += 0.5 * t * h;
                sum += s * t * displacement(place)[component];
            }
            sum / (h * h)
        };
        for (c, found) in force([1.5, 0.75], x).into_iter().enumerate() {
            let laplacian: f64 = (0..3).map(|axis| second(c, axis, axis)).sum();
            let dilatation: f64 = (0..3).map(|other| second(other, other, c)).sum();
            let expected = -0.75 * laplacian - 2.25 * dilatation;
            assert!((found - expected).abs() < 1e-3, "component {c}: {found} and {expected}");
        }
    }
}
