//! The double pendulum dropped from the horizontal.

use super::reference::{array, numbers, read};
use super::{Accelerations, Equations, LONGEST_RUN, Problem, ReferenceError};
use piola_numerics::Real;

/// Two point masses on rods, angles from the downward vertical.
#[derive(Clone, Copy, Debug)]
pub struct DoublePendulum {
    /// Masses, kg.
    pub masses: [f64; 2],
    /// Lengths, m.
    pub lengths: [f64; 2],
    /// Strength of gravity, m/s².
    pub gravity: f64,
}

impl DoublePendulum {
    /// The entries g₁₁, g₁₂, g₂₂ of the inertia metric for the cosine of the angle between the rods.
    #[inline]
    #[must_use]
    pub fn metric(&self, cosine: f64) -> [f64; 3] {
        let ([m1, m2], [l1, l2]) = (self.masses, self.lengths);
        [(m1 + m2) * l1 * l1, m2 * l1 * l2 * cosine, m2 * l2 * l2]
    }

    /// The accelerations, by solving Lagrange's equations by hand.
    #[inline]
    #[must_use]
    pub fn acceleration(&self, q: [f64; 2], v: [f64; 2]) -> [f64; 2] {
        let ([m1, m2], [l1, l2]) = (self.masses, self.lengths);
        let (s1, c1) = q[0].sin_cos();
        let (s2, c2) = q[1].sin_cos();
        let (sine, cosine) = (s1 * c2 - c1 * s2, c1 * c2 + s1 * s2);
        let [a, b, d] = self.metric(cosine);
        let coupling = m2 * l1 * l2 * sine;
        let first = -coupling * v[1] * v[1] - (m1 + m2) * self.gravity * l1 * s1;
        let second = coupling * v[0] * v[0] - m2 * self.gravity * l2 * s2;
        let inverse = 1.0 / (a * d - b * b);
        [(d * first - b * second) * inverse, (a * second - b * first) * inverse]
    }

    /// The velocities that belong to momenta.
    #[must_use]
    pub fn velocities(&self, q: [f64; 2], p: [f64; 2]) -> [f64; 2] {
        let [a, b, d] = self.metric((q[0] - q[1]).cos());
        let inverse = 1.0 / (a * d - b * b);
        [(d * p[0] - b * p[1]) * inverse, (a * p[1] - b * p[0]) * inverse]
    }
}

impl Equations<4> for DoublePendulum {
    #[inline]
    fn rate(&self, y: &[f64; 4], rate: &mut [f64; 4]) {
        let [a, b] = self.acceleration([y[0], y[1]], [y[2], y[3]]);
        *rate = [y[2], y[3], a, b];
    }
}

impl Accelerations for DoublePendulum {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn accelerations<T: Real>(&self, q: &[T], v: &[T], out: &mut [T]) {
        let ([m1, m2], [l1, l2]) = (self.masses, self.lengths);
        let lit = T::lit;
        let (s1, c1) = q[0].sin_cos();
        let (s2, c2) = q[1].sin_cos();
        let (sine, cosine) = (s1 * c2 - c1 * s2, c1 * c2 + s1 * s2);
        let (a, b, d) = (lit((m1 + m2) * l1 * l1), lit(m2 * l1 * l2) * cosine, lit(m2 * l2 * l2));
        let coupling = lit(m2 * l1 * l2) * sine;
        let first = -coupling * v[1] * v[1] - lit((m1 + m2) * self.gravity * l1) * s1;
        let second = coupling * v[0] * v[0] - lit(m2 * self.gravity * l2) * s2;
        let inverse = (a * d - b * b).recip();
        out[0] = (d * first - b * second) * inverse;
        out[1] = (a * second - b * first) * inverse;
    }
}

/// The double pendulum from rest at (π/2, π/2), ten seconds.
///
/// # Errors
/// The reference cannot be read.
pub fn double_pendulum() -> Result<Problem<DoublePendulum, 4>, ReferenceError> {
    let horizontal = core::f64::consts::FRAC_PI_2;
    Ok(Problem {
        name: "double-pendulum",
        title: "Double pendulum dropped from the horizontal, 10 s",
        equations: DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.81 },
        start: [horizontal, horizontal, 0.0, 0.0],
        end: 10.0,
        reference: array(&numbers(&read("double_pendulum")?["T10"]["state"])?)?,
        small: 1.0,
        longest_run: LONGEST_RUN,
    })
}
