//! The systems that the tests integrate, over any scalar.

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

/// V = (x² + y²)/2 + x²y − y³/3.
pub(crate) struct HenonHeiles;
impl Force for HenonHeiles {
    fn force<T: Real>(&self, _t: f64, q: &[T], force: &mut [T]) {
        let two = T::lit(2.0);
        force[0] = -q[0] - two * q[0] * q[1];
        force[1] = -q[1] - q[0] * q[0] + q[1] * q[1];
    }
}
pub(crate) const fn henon_heiles() -> SecondOrder<HenonHeiles> {
    SecondOrder { freedom: 2, force: HenonHeiles }
}

/// Bodies of mass one in the plane with G = 1.
pub(crate) struct EqualBodies;
impl Force for EqualBodies {
    fn force<T: Real>(&self, _t: f64, q: &[T], force: &mut [T]) {
        force.fill(T::zero());
        let n = q.len() / 2;
        for i in 0..n {
            for j in i + 1..n {
                let d = [q[2 * j] - q[2 * i], q[2 * j + 1] - q[2 * i + 1]];
                let square = d[0] * d[0] + d[1] * d[1];
                let inverse_cube = (square * square.sqrt()).recip();
                for (k, d) in d.into_iter().enumerate() {
                    force[2 * i + k] += d * inverse_cube;
                    force[2 * j + k] -= d * inverse_cube;
                }
            }
        }
    }
}
pub(crate) const fn three_bodies() -> SecondOrder<EqualBodies> {
    SecondOrder { freedom: 6, force: EqualBodies }
}
pub(crate) const FIGURE_EIGHT: [f64; 12] = [
    0.970_004_36,
    -0.243_087_53,
    -0.970_004_36,
    0.243_087_53,
    0.0,
    0.0,
    0.466_203_685,
    0.432_365_73,
    0.466_203_685,
    0.432_365_73,
    -0.932_407_37,
    -0.864_731_46,
];

/// The double pendulum with absolute angles from the downward vertical.
pub(crate) struct DoublePendulum {
    pub(crate) masses: [f64; 2],
    pub(crate) lengths: [f64; 2],
    pub(crate) gravity: f64,
}
impl<T: Real> Field<T> for DoublePendulum {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        4
    }
    fn rate(&mut self, _t: f64, y: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let ([m1, m2], [l1, l2], g) = (self.masses.map(T::lit), self.lengths.map(T::lit), T::lit(self.gravity));
        let (sine, cosine) = (y[0] - y[1]).sin_cos();
        let (a, b, c) = ((m1 + m2) * l1 * l1, m2 * l1 * l2 * cosine, m2 * l2 * l2);
        let f1 = -m2 * l1 * l2 * sine * y[3] * y[3] - (m1 + m2) * g * l1 * y[0].sin();
        let f2 = m2 * l1 * l2 * sine * y[2] * y[2] - m2 * g * l2 * y[1].sin();
        let determinant = a * c - b * b;
        rate[0] = y[2];
        rate[1] = y[3];
        rate[2] = (c * f1 - b * f2) / determinant;
        rate[3] = (a * f2 - b * f1) / determinant;
        Ok(())
    }
    fn is_second_order(&self) -> bool {
        true
    }
}

impl<T: Real> piola_integrators::SecondOrder<T> for DoublePendulum {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        2
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, _t: T, q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        let mut rate = [T::zero(); 4];
        self.rate(0.0, &[q[0], q[1], v[0], v[1]], &mut rate)?;
        acceleration.copy_from_slice(&rate[2..]);
        Ok(())
    }
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
