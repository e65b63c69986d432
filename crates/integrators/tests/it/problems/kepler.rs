//! Systems of second order by their force, over any scalar, and Kepler's motion among them.

use core::convert::Infallible;

use piola_integrators::{Field, Separable};
use piola_numerics::Real;

/// A separable system with q̇ = p, also as a field of second order.
pub(crate) struct SecondOrder<F> {
    pub(crate) freedom: usize,
    pub(crate) force: F,
}

impl<T: Real, F: Force> piola_integrators::SecondOrder<T> for SecondOrder<F> {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    fn freedom(&self) -> usize {
        self.freedom
    }
    // None of these forces depends on the time.
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, t: T, q: &[T], _v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        self.force.force(t.primal(0), q, acceleration);
        Ok(())
    }
}

/// A force ṗ = w(t, q) over any scalar.
pub(crate) trait Force {
    fn force<T: Real>(&self, t: f64, q: &[T], force: &mut [T]);
}

impl<T: Real, F: Force> Separable<T> for SecondOrder<F> {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        self.freedom
    }
    fn force(&mut self, t: f64, q: &[T], force: &mut [T]) -> Result<(), Infallible> {
        self.force.force(t, q, force);
        Ok(())
    }
}

impl<T: Real, F: Force> Field<T> for SecondOrder<F> {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2 * self.freedom
    }
    fn rate(&mut self, t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let (q, p) = y.split_at(self.freedom);
        rate[..self.freedom].copy_from_slice(p);
        self.force.force(t, q, &mut rate[self.freedom..]);
        Ok(())
    }
    fn is_second_order(&self) -> bool {
        true
    }
}

/// q̈ = −q/|q|³ in the plane.
pub(crate) struct Attraction;
impl Force for Attraction {
    fn force<T: Real>(&self, _t: f64, q: &[T], force: &mut [T]) {
        let square = q[0] * q[0] + q[1] * q[1];
        let inverse_cube = (square * square.sqrt()).recip();
        force[0] = -q[0] * inverse_cube;
        force[1] = -q[1] * inverse_cube;
    }
}
pub(crate) const fn kepler() -> SecondOrder<Attraction> {
    SecondOrder { freedom: 2, force: Attraction }
}

/// Kepler's motion with μ = a = 1 from the pericentre, in closed form.
pub(crate) fn kepler_at(eccentricity: f64, t: f64) -> [f64; 4] {
    let e = eccentricity;
    let mut anomaly = t;
    for _ in 0..60 {
        anomaly -= (anomaly - e * anomaly.sin() - t) / (1.0 - e * anomaly.cos());
    }
    let (sine, cosine) = anomaly.sin_cos();
    let (b, rate) = ((1.0 - e * e).sqrt(), 1.0 / (1.0 - e * cosine));
    [cosine - e, b * sine, -sine * rate, b * cosine * rate]
}

pub(crate) fn kepler_energy(y: &[f64]) -> f64 {
    0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / y[0].hypot(y[1])
}
