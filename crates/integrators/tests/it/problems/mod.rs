//! The systems that the tests integrate, over any scalar.

use core::convert::Infallible;

use piola_integrators::Field;
use piola_numerics::Real;

pub(crate) use self::kepler::{Attraction, Force, SecondOrder, kepler, kepler_at, kepler_energy};

mod kepler;

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
