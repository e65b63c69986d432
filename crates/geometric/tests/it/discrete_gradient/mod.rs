//! Discrete gradients: energies and Casimir functions, orders, damping, and what goes wrong.

mod energy;
mod runs;

use piola_geometric::EnergySystem;
use piola_numerics::{Real, Secant};

/// H = (p² + q²)/2 + x²y − y³/3.
pub(crate) struct HenonHeiles;
impl EnergySystem for HenonHeiles {
    fn dimension(&self) -> usize {
        4
    }
    fn energy<T: Real>(&self, y: &[T]) -> T {
        let half = T::lit(0.5);
        let quadratic = half * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]);
        quadratic + y[0] * y[0] * y[1] - y[1] * y[1] * y[1] / T::lit(3.0)
    }
}

/// H = p²/2 − cos q.
pub(crate) struct Pendulum;
impl EnergySystem for Pendulum {
    fn dimension(&self) -> usize {
        2
    }
    fn energy<T: Real>(&self, y: &[T]) -> T {
        T::lit(0.5) * y[1] * y[1] - y[0].cos()
    }
}

/// H = p²/2 − 1/|q| in the plane.
pub(crate) struct Kepler;
impl EnergySystem for Kepler {
    fn dimension(&self) -> usize {
        4
    }
    fn energy<T: Real>(&self, y: &[T]) -> T {
        T::lit(0.5) * (y[2] * y[2] + y[3] * y[3]) - (y[0] * y[0] + y[1] * y[1]).sqrt().recip()
    }
}

/// A free rigid body with the principal moments of inertia 1, 2 and 3; y is the angular momentum.
pub(crate) struct FreeBody;
impl FreeBody {
    /// |y|²/2.
    pub(crate) fn casimir<T: Real>(y: &[T]) -> T {
        T::lit(0.5) * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2])
    }
}
impl EnergySystem for FreeBody {
    fn dimension(&self) -> usize {
        3
    }
    fn energy<T: Real>(&self, y: &[T]) -> T {
        T::lit(0.5) * (y[0] * y[0] + y[1] * y[1] / T::lit(2.0) + y[2] * y[2] / T::lit(3.0))
    }
    fn structure<T: Real>(&self, y: &[T], g: &[T], out: &mut [T]) {
        out[0] = y[1] * g[2] - y[2] * g[1];
        out[1] = y[2] * g[0] - y[0] * g[2];
        out[2] = y[0] * g[1] - y[1] * g[0];
    }
}

/// q̈ + friction q̇ + sin q = 0: R acts on the momentum.
pub(crate) struct DampedPendulum {
    pub(crate) friction: f64,
}
impl EnergySystem for DampedPendulum {
    const DAMPED: bool = true;
    fn dimension(&self) -> usize {
        2
    }
    fn energy<T: Real>(&self, y: &[T]) -> T {
        Pendulum.energy(y)
    }
    fn damping<T: Real>(&self, _y: &[T], g: &[T], out: &mut [T]) {
        out[0] = T::zero();
        out[1] = T::lit(self.friction) * g[1];
    }
}

/// f(end) − f(start), where nothing cancels.
pub(crate) fn change(f: impl Fn(&[Secant<f64>]) -> Secant<f64>, start: &[f64], end: &[f64]) -> f64 {
    let secants: Vec<_> = start.iter().zip(end).map(|(&a, &b)| Secant { start: a, end: b, change: b - a }).collect();
    f(&secants).change
}
