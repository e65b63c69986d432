//! Hamiltonians that the tests share.

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{CompleteIntegral, InitialFront, PrincipalFunction};
use piola_numerics::Real;

/// H = |p|²/(2m) − m g·q + m ω² |q|²/2, of as many coordinates as g has.
#[derive(Debug)]
pub(crate) struct Particle {
    pub(crate) mass: f64,
    pub(crate) omega: f64,
    pub(crate) gravity: Vec<f64>,
}

impl Particle {
    pub(crate) fn oscillator(mass: f64, omega: f64, n: usize) -> Self {
        Self { mass, omega, gravity: vec![0.0; n] }
    }
}

impl PhaseFunction for Particle {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let mut h = T::zero();
        for i in 0..q.len() {
            h += T::lit(0.5 / self.mass) * p[i] * p[i] - T::lit(self.mass * self.gravity[i]) * q[i]
                + T::lit(0.5 * self.mass * self.omega * self.omega) * q[i] * q[i];
        }
        h
    }
}

/// A charge in a uniform magnetic field, H = |p − eA|²/(2m), A = B(−y, x)/2.
#[derive(Debug)]
pub(crate) struct Magnetic {
    pub(crate) mass: f64,
    pub(crate) charge: f64,
    pub(crate) field: f64,
}

impl PhaseFunction for Magnetic {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let half = T::lit(0.5 * self.charge * self.field);
        let (x, y) = (p[0] + half * q[1], p[1] - half * q[0]);
        (x * x + y * y) * T::lit(0.5 / self.mass)
    }
}

/// A pendulum whose point of support is shaken: H = p²/2 − (4 + a cos 3t) cos q.
#[derive(Debug)]
pub(crate) struct ShakenPendulum {
    pub(crate) amplitude: f64,
}

impl PhaseFunction for ShakenPendulum {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        T::lit(0.5) * p[0] * p[0] - (T::lit(4.0) + T::lit(self.amplitude) * (T::lit(3.0) * t).cos()) * q[0].cos()
    }
}

/// A particle of unit mass in the plane, in the potential V = k r²/2 + a r⁴/4 … by Cartesian coordinates.
#[derive(Debug)]
pub(crate) struct Bowl;

impl PhaseFunction for Bowl {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let square = q[0] * q[0] + q[1] * q[1];
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1] + square) + T::lit(0.25) * square * square
    }
}

/// The same by polar coordinates q = (r, φ).
#[derive(Debug)]
pub(crate) struct PolarBowl;

impl PhaseFunction for PolarBowl {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let square = q[0] * q[0];
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1] / square + square) + T::lit(0.25) * square * square
    }
}

/// The action of an oscillator that starts from Q at t = 0: m ω/(2 sin ωt) ((q² + Q²) cos ωt − 2 q Q).
#[derive(Debug)]
pub(crate) struct OscillatorAction {
    pub(crate) mass: f64,
    pub(crate) omega: f64,
}

impl CompleteIntegral for OscillatorAction {
    fn value<T: Real>(&self, q: &[T], c: &[T], t: T) -> T {
        let (s, cosine) = (T::lit(self.omega) * t).sin_cos();
        let mut sum = T::zero();
        for i in 0..q.len() {
            sum += (q[i] * q[i] + c[i] * c[i]) * cosine - T::lit(2.0) * q[i] * c[i];
        }
        T::lit(0.5 * self.mass * self.omega) * sum / s
    }
}

/// The same with the start Q given: a solution of the Hamilton–Jacobi equation.
#[derive(Debug)]
pub(crate) struct FromPlace {
    pub(crate) action: OscillatorAction,
    pub(crate) place: Vec<f64>,
}

impl PrincipalFunction for FromPlace {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        let place: Vec<T> = self.place.iter().map(|&x| T::lit(x)).collect();
        CompleteIntegral::value(&self.action, q, &place, t)
    }
}

/// S(q; E) − E t of an oscillator on the branch p > 0, with the one constant E.
#[derive(Debug)]
pub(crate) struct OscillatorByEnergy {
    pub(crate) mass: f64,
    pub(crate) omega: f64,
}

impl CompleteIntegral for OscillatorByEnergy {
    fn value<T: Real>(&self, q: &[T], c: &[T], t: T) -> T {
        let (m, w) = (T::lit(self.mass), T::lit(self.omega));
        let p = (T::lit(2.0) * m * c[0] - m * m * w * w * q[0] * q[0]).sqrt();
        let angle = (m * w * q[0]).atan2(p);
        T::lit(0.5) * q[0] * p + c[0] / w * angle - c[0] * t
    }
}

/// The same with E given, at t = 0 the function S(q) alone.
#[derive(Debug)]
pub(crate) struct ByEnergy {
    pub(crate) action: OscillatorByEnergy,
    pub(crate) energy: f64,
}

impl PrincipalFunction for ByEnergy {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        CompleteIntegral::value(&self.action, q, &[T::lit(self.energy)], t)
    }
}

/// A particle in a frame that turns, in a hollow that breathes: momenta are no velocities, and the energy is not kept.
#[derive(Debug)]
pub(crate) struct Swaying;

impl PhaseFunction for Swaying {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        let stiffness = T::one() + T::lit(0.4) * (t + t).cos();
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1])
            + T::lit(0.3) * (q[0] * p[1] - q[1] * p[0])
            + T::lit(0.5) * stiffness * (q[0] * q[0] + T::lit(0.5) * q[1] * q[1])
            + T::lit(0.2) * q[0] * q[0] * q[1]
    }
}

/// A function of Cartesian coordinates, by polar ones q = (r, φ).
#[derive(Debug)]
pub(crate) struct ByPolar<U>(pub(crate) U);

impl<U: PrincipalFunction> PrincipalFunction for ByPolar<U> {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        let (s, c) = q[1].sin_cos();
        self.0.value(&[q[0] * c, q[0] * s], t)
    }
}

impl<C: InitialFront<2, 1>> InitialFront<2, 1> for ByPolar<C> {
    fn at<T: Real>(&self, parameters: [T; 1]) -> [T; 2] {
        let [x, y] = self.0.at(parameters);
        [(x * x + y * y).sqrt(), y.atan2(x)]
    }
}
