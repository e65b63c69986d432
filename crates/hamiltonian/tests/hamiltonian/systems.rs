//! Functions and maps of phase space that the tests share.

use nalgebra::Vector3;
use piola_hamiltonian::HamiltonianError;
use piola_hamiltonian::{InvertiblePhaseMap, PhaseFunction, PhaseMap, VectorField};
use piola_lagrangian::{Holonomic, LagrangianFunction, Placement};
use piola_numerics::Real;
use proptest::prelude::*;

/// A function of two degrees of freedom and of time, with terms of all kinds.
#[derive(Clone, Debug)]
pub(crate) struct AnyFunction(pub(crate) [f64; 7]);

impl PhaseFunction for AnyFunction {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        let c = self.0.map(T::lit);
        c[0] * q[0] * p[1]
            + c[1] * q[1] * q[1] * p[0]
            + c[2] * (q[0] + c[3] * p[1]).sin()
            + c[4] * (T::lit(0.25) * q[0] * q[1]).exp() * p[0]
            + c[5] * p[0] * p[0] * q[1]
            + c[6] * q[0] * (t + p[1]).cos()
    }
}

/// Any field of vectors: two functions make its components, which are no gradient.
pub(crate) struct AnyField<A, B>(pub(crate) A, pub(crate) B);

impl<A: PhaseFunction, B: PhaseFunction> VectorField for AnyField<A, B> {
    fn components<T: Real>(&self, x: &[T], out: &mut [T]) {
        let (a, b) = (self.0.value(&x[..2], &x[2..], T::zero()), self.1.value(&x[..2], &x[2..], T::zero()));
        out.copy_from_slice(&[a, b * x[0], a + b, x[1] * a]);
    }
}

/// Such functions, of coefficients in (−1, 1).
pub(crate) fn any_function() -> impl Strategy<Value = AnyFunction> {
    prop::array::uniform7(-1.0..1.0_f64).prop_map(AnyFunction)
}

/// Points (q, p) of two degrees of freedom.
pub(crate) fn any_point() -> impl Strategy<Value = ([f64; 2], [f64; 2])> {
    (prop::array::uniform2(-1.5..1.5_f64), prop::array::uniform2(-1.5..1.5_f64))
}

/// A canonical map of two degrees of freedom: a kick by −∂V/∂q, a drift by ∂T/∂p, a rotation of the first phase plane, and
/// a shear of the coordinates with the momenta that belong to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct AnyMap(pub(crate) [f64; 6]);

impl PhaseMap for AnyMap {
    fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        let c = self.0.map(T::lit);
        let ([mut x, mut y], [mut u, mut v]) = ([q[0], q[1]], [p[0], p[1]]);
        // V = c₀ sin(x + y) + c₁ x² y
        u -= c[0] * (x + y).cos() + T::lit(2.0) * c[1] * x * y;
        v -= c[0] * (x + y).cos() + c[1] * x * x;
        // T = c₂ sin(u − v) + c₃ u v
        x += c[2] * (u - v).cos() + c[3] * v;
        y += -c[2] * (u - v).cos() + c[3] * u;
        let (s, cosine) = c[4].sin_cos();
        (x, u) = (cosine * x + s * u, cosine * u - s * x);
        // Y = y + c₅ x²: p_x = P_x + 2 c₅ x P_y
        u -= T::lit(2.0) * c[5] * x * v;
        y += c[5] * x * x;
        new.copy_from_slice(&[x, y, u, v]);
        Ok(())
    }
}

impl InvertiblePhaseMap for AnyMap {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], _t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        let c = self.0.map(T::lit);
        let ([mut x, mut y], [mut u, mut v]) = ([new_q[0], new_q[1]], [new_p[0], new_p[1]]);
        y -= c[5] * x * x;
        u += T::lit(2.0) * c[5] * x * v;
        let (s, cosine) = c[4].sin_cos();
        (x, u) = (cosine * x - s * u, cosine * u + s * x);
        x -= c[2] * (u - v).cos() + c[3] * v;
        y -= -c[2] * (u - v).cos() + c[3] * u;
        u += c[0] * (x + y).cos() + T::lit(2.0) * c[1] * x * y;
        v += c[0] * (x + y).cos() + c[1] * x * x;
        old.copy_from_slice(&[x, y, u, v]);
        Ok(())
    }
}

/// Such maps.
pub(crate) fn any_map() -> impl Strategy<Value = AnyMap> {
    prop::array::uniform6(-0.8..0.8_f64).prop_map(AnyMap)
}

/// Kepler's problem in any number of Cartesian coordinates: H = p²/2m − k/r.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kepler {
    pub(crate) mass: f64,
    pub(crate) strength: f64,
}

impl PhaseFunction for Kepler {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let square = |x: &[T]| x.iter().fold(T::zero(), |sum, &x| sum + x * x);
        square(p) / T::lit(2.0 * self.mass) - T::lit(self.strength) / square(q).sqrt()
    }
}

/// The angular momentum in a plane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlaneMoment;

impl PhaseFunction for PlaneMoment {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        q[0] * p[1] - q[1] * p[0]
    }
}

/// A charged particle in uniform fields: L = ½ m v² + e E·x + e A·v, A = ½ B × x.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Charged {
    pub(crate) mass: f64,
    pub(crate) charge: f64,
    pub(crate) electric: [f64; 3],
    pub(crate) magnetic: [f64; 3],
}

impl LagrangianFunction for Charged {
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
        let (b, e) = (self.magnetic.map(T::lit), self.electric.map(T::lit));
        let mut sum = T::zero();
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            let potential = T::lit(0.5) * (b[j] * q[k] - b[k] * q[j]);
            sum += T::lit(0.5 * self.mass) * v[i] * v[i] + T::lit(self.charge) * (e[i] * q[i] + potential * v[i]);
        }
        sum
    }
}

/// θ from the downward vertical, azimuth φ; with one coordinate a plane pendulum.
pub(crate) struct SphericalPendulum {
    pub(crate) mass: f64,
    pub(crate) length: f64,
}

impl Holonomic for SphericalPendulum {
    fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
        let ((s, c), (sp, cp)) = (q[0].sin_cos(), q.get(1).map_or((T::zero(), T::one()), |x| x.sin_cos()));
        let l = T::lit(self.length);
        bodies.particle(self.mass, Vector3::new(l * s * cp, l * s * sp, -l * c));
    }
}

/// A relativistic particle in a field of force that grows with time: L = −√(1 − v²) − ½ k(t) q², k = 1 + ε sin t.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relativistic {
    pub(crate) wobble: f64,
}

impl LagrangianFunction for Relativistic {
    fn lagrangian<T: Real>(&self, q: &[T], v: &[T], t: T) -> T {
        let speed = v.iter().fold(T::zero(), |sum, &v| sum + v * v);
        let square = q.iter().fold(T::zero(), |sum, &q| sum + q * q);
        -(T::one() - speed).sqrt() - T::lit(0.5) * (T::one() + T::lit(self.wobble) * t.sin()) * square
    }
}
