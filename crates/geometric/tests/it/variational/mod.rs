//! Variational integrators: orders, what is kept, equal methods, coefficients, and what goes wrong.

mod equal_methods;
mod failures;
mod kept;
mod orders;
mod tableaux;

use piola_geometric::{ActionRule, VariationalSystem};
use piola_integrators::Order;
use piola_numerics::Real;

/// Both rules in all orders.
pub(crate) fn all() -> impl Iterator<Item = (ActionRule, Order)> {
    Order::ALL.into_iter().flat_map(|order| [ActionRule::Gauss, ActionRule::Lobatto].map(|rule| (rule, order)))
}

/// L = v²/2 + 1/|q| in the plane.
pub(crate) struct Kepler;
impl VariationalSystem for Kepler {
    fn freedom(&self) -> usize {
        2
    }
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        T::lit(0.5) * (v[0] * v[0] + v[1] * v[1]) + (q[0] * q[0] + q[1] * q[1]).sqrt().recip()
    }
}

/// A spherical pendulum of unit mass, length and gravity in stereographic coordinates; at q = 0 it hangs straight.
///
/// ```text
/// L = 2 v²/(1 + r²)² + (1 − r²)/(1 + r²)
/// ```
pub(crate) struct SphericalPendulum;
impl VariationalSystem for SphericalPendulum {
    fn freedom(&self) -> usize {
        2
    }
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        let square = q[0] * q[0] + q[1] * q[1];
        let sum = T::one() + square;
        T::lit(2.0) * (v[0] * v[0] + v[1] * v[1]) / (sum * sum) + (T::one() - square) / sum
    }
}

/// q̈ + 2 f q̇ + q = cos 2t: a damped, driven oscillator.
pub(crate) struct Driven {
    pub(crate) friction: f64,
}
impl VariationalSystem for Driven {
    const FORCED: bool = true;
    fn freedom(&self) -> usize {
        1
    }
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        T::lit(0.5) * (v[0] * v[0] - q[0] * q[0])
    }
    fn force<T: Real>(&self, _q: &[T], v: &[T], t: T, force: &mut [T]) {
        force[0] = (T::lit(2.0) * t).cos() - T::lit(2.0 * self.friction) * v[0];
    }
}
impl Driven {
    /// (q, v) of the start (1, 0).
    pub(crate) fn exact(&self, t: f64) -> [f64; 2] {
        let f = self.friction;
        // q = a cos 2t + b sin 2t + e^{−ft} (c cos wt + d sin wt).
        let square = 9.0 + 16.0 * f * f;
        let (a, b, w) = (-3.0 / square, 4.0 * f / square, (1.0 - f * f).sqrt());
        let (c, d) = (1.0 - a, (f * (1.0 - a) - 2.0 * b) / w);
        let ((s2, c2), (sw, cw), decay) = ((2.0 * t).sin_cos(), (w * t).sin_cos(), (-f * t).exp());
        let free = c * cw + d * sw;
        [a * c2 + b * s2 + decay * free, 2.0 * (b * c2 - a * s2) + decay * (w * (d * cw - c * sw) - f * free)]
    }
}

pub(crate) fn distance(actual: &[f64], exact: &[f64]) -> f64 {
    actual.iter().zip(exact).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
}
