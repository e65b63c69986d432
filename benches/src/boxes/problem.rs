//! A displacement with all wave numbers, between sliding walls.

use std::f64::consts::PI;

use piola_spectral::{LameParameters, SpectralError};

/// λ = 3/2, μ = 3/4.
///
/// # Errors
/// Never: these are elliptic.
pub fn lame() -> Result<LameParameters, SpectralError> {
    LameParameters::new(1.5, 0.75)
}

/// sin πx e^{cos πx} and e^{½ cos πx}, each with its derivatives of order up to two.
fn factors(x: f64) -> [[f64; 3]; 2] {
    let (s, c) = (PI * x).sin_cos();
    let (e, b) = (c.exp(), (0.5 * c).exp());
    let sine = [s * e, PI * (c - s * s) * e, PI * PI * e * s * (s * s - 1.0 - 3.0 * c)];
    [sine, [b, -0.5 * PI * s * b, PI * PI * b * (0.25 * s * s - 0.5 * c)]]
}

/// A derivative of one component of u: the factor with the sine stands on the component's own axis.
fn derivative(table: &[[[f64; 3]; 2]; 3], component: usize, orders: [usize; 3]) -> f64 {
    (0..3).map(|axis| table[axis][usize::from(axis != component)][orders[axis]]).product()
}

/// A component of u in the unit cube.
#[must_use]
pub fn displacement(x: [f64; 3], component: usize) -> f64 {
    derivative(&x.map(factors), component, [0; 3])
}

/// A component of f = −μΔu − (λ + μ)∇(∇·u).
#[must_use]
pub fn force(lame: LameParameters, x: [f64; 3], component: usize) -> f64 {
    let table = x.map(factors);
    let of = |component: usize, axes: [usize; 2]| {
        let mut orders = [0; 3];
        for axis in axes {
            orders[axis] += 1;
        }
        derivative(&table, component, orders)
    };
    let laplacian: f64 = (0..3).map(|axis| of(component, [axis, axis])).sum();
    let dilatation: f64 = (0..3).map(|other| of(other, [other, component])).sum();
    -lame.shear_modulus() * laplacian - (lame.first() + lame.shear_modulus()) * dilatation
}

/// Values of a component at all points of a grid of n × n × n, the last index running fastest; `offset` is the place of the
/// first point on each axis, in spacings.
#[must_use]
pub fn samples(n: usize, offset: [f64; 3], value: impl Fn([f64; 3]) -> f64) -> Vec<f64> {
    let h = 1.0 / n as f64;
    let mut values = Vec::with_capacity(n * n * n);
    for i in 0..n {
        for j in 0..n {
            values.extend(
                (0..n).map(|k| {
                    value([(i as f64 + offset[0]) * h, (j as f64 + offset[1]) * h, (k as f64 + offset[2]) * h])
                }),
            );
        }
    }
    values
}

/// ‖a − b‖/‖b‖ over all components.
#[must_use]
pub fn relative_error(a: &[Vec<f64>; 3], b: &[Vec<f64>; 3]) -> f64 {
    let sum = |value: &dyn Fn(f64, f64) -> f64| -> f64 {
        a.iter().flatten().zip(b.iter().flatten()).map(|(a, b)| value(*a, *b).powi(2)).sum()
    };
    (sum(&|a, b| a - b) / sum(&|_, b| b)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{displacement, force, lame};

    /// The force by hand against central differences of the displacement, whose error is h²/12 of fourth derivatives.
    #[test]
    fn the_force_is_that_of_the_displacement() {
        let lame = lame().expect("elliptic");
        let (x, h) = ([0.31, 0.62, 0.17], 1e-3);
        let at = |component: usize, steps: [(usize, f64); 2]| {
            let mut place = x;
            for (axis, step) in steps {
                place[axis] += step * h;
            }
            displacement(place, component)
        };
        let second = |component: usize, a: usize, b: usize| {
            let sign = |s: f64, t: f64| s * t * at(component, [(a, 0.5 * s), (b, 0.5 * t)]);
            (sign(1.0, 1.0) + sign(1.0, -1.0) + sign(-1.0, 1.0) + sign(-1.0, -1.0)) / (h * h)
        };
        for c in 0..3 {
            let laplacian: f64 = (0..3).map(|axis| second(c, axis, axis)).sum();
            let dilatation: f64 = (0..3).map(|other| second(other, other, c)).sum();
            let expected = -lame.shear_modulus() * laplacian - (lame.first() + lame.shear_modulus()) * dilatation;
            assert!((force(lame, x, c) - expected).abs() < 1e-3, "component {c}: {expected}");
        }
    }
}
