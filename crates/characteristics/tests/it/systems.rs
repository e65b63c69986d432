//! Equations and initial manifolds of the tests.

use piola_characteristics::{Covector, FirstOrderPde, InitialManifold};
use piola_numerics::Real;

/// (|ξ|² − 1)/2 = 0.
pub(crate) struct Eikonal;
impl FirstOrderPde for Eikonal {
    fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
        T::lit(0.5) * (xi.iter().fold(T::zero(), |sum, &xi| sum + xi * xi) - T::one())
    }
}

/// (ξ₁² + ξ₂²/r² − 1)/2 = 0: the same in polar coordinates x = (r, φ).
pub(crate) struct PolarEikonal;
impl FirstOrderPde for PolarEikonal {
    fn value<T: Real>(&self, x: &[T], _u: T, xi: &[T]) -> T {
        let across = xi[1] / x[0];
        T::lit(0.5) * (xi[0] * xi[0] + across * across - T::one())
    }
}

/// A manifold in polar coordinates, with ξ along r and across it: (x·ξ)/r and x¹ξ₂ − x²ξ₁.
pub(crate) struct ByPolar<M>(pub(crate) M);
impl<M: InitialManifold> InitialManifold for ByPolar<M> {
    const COVECTOR: Covector = M::COVECTOR;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let u = self.0.place(tau, x);
        (x[0], x[1]) = ((x[0] * x[0] + x[1] * x[1]).sqrt(), x[1].atan2(x[0]));
        u
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        let mut x = [T::zero(); 2];
        self.0.place(tau, &mut x);
        self.0.covector(tau, xi);
        let radius = (x[0] * x[0] + x[1] * x[1]).sqrt();
        (xi[0], xi[1]) = ((x[0] * xi[0] + x[1] * xi[1]) / radius, x[0] * xi[1] - x[1] * xi[0]);
    }
}

/// ξ₁ ξ₂ − u = 0.
pub(crate) struct Product;
impl FirstOrderPde for Product {
    fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
        xi[0] * xi[1] - u
    }
}

/// ∂u/∂t + u ∂u/∂q = 0.
pub(crate) struct Burgers;
impl FirstOrderPde for Burgers {
    const QUASILINEAR: bool = true;
    fn value<T: Real>(&self, _x: &[T], u: T, xi: &[T]) -> T {
        xi[0] + u * xi[1]
    }
}

/// ∂S/∂t + (∂S/∂q)²/2m + m ω² q²/2 = 0.
pub(crate) struct Oscillator {
    pub(crate) mass: f64,
    pub(crate) omega: f64,
}
impl FirstOrderPde for Oscillator {
    fn value<T: Real>(&self, x: &[T], _u: T, xi: &[T]) -> T {
        let stiffness = self.mass * self.omega * self.omega;
        xi[0] + xi[1] * xi[1] / T::lit(2.0 * self.mass) + T::lit(0.5 * stiffness) * x[1] * x[1]
    }
}

/// u = 0 on a circle with the normal as a guess of ξ.
pub(crate) struct Circle {
    pub(crate) radius: f64,
    pub(crate) centre: [f64; 2],
    pub(crate) outward: bool,
}
impl InitialManifold for Circle {
    const COVECTOR: Covector = Covector::Guessed;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let (s, c) = tau[0].sin_cos();
        x[0] = T::lit(self.centre[0]) + T::lit(self.radius) * c;
        x[1] = T::lit(self.centre[1]) + T::lit(self.radius) * s;
        T::zero()
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        let sign = T::lit(if self.outward { 1.0 } else { -1.0 });
        let (s, c) = tau[0].sin_cos();
        (xi[0], xi[1]) = (sign * c, sign * s);
    }
}

/// u = 0 on y = a x².
pub(crate) struct Parabola(pub(crate) f64);
impl InitialManifold for Parabola {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        (x[0], x[1]) = (tau[0], T::lit(self.0) * tau[0] * tau[0]);
        T::zero()
    }
}

/// u = f(q) at x = (0, q).
pub(crate) enum Line {
    Square,
    Sine,
    Gaussian,
    /// a q²/2 + b q + c.
    Quadratic([f64; 3]),
}
impl InitialManifold for Line {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let q = tau[0];
        (x[0], x[1]) = (T::zero(), q);
        match *self {
            Self::Square => q * q,
            Self::Sine => q.sin(),
            Self::Gaussian => (-(q * q)).exp(),
            Self::Quadratic([a, b, c]) => (T::lit(0.5 * a) * q + T::lit(b)) * q + T::lit(c),
        }
    }
}

/// (ξ₁² + 3/2 ξ₂² − (1 + x¹x²/5)²)/2 − u (1 + ξ₁)/10 = 0: everything depends on everything.
pub(crate) struct Bent;
impl FirstOrderPde for Bent {
    fn value<T: Real>(&self, x: &[T], u: T, xi: &[T]) -> T {
        let index = T::one() + T::lit(0.2) * x[0] * x[1];
        T::lit(0.5) * (xi[0] * xi[0] + T::lit(1.5) * xi[1] * xi[1] - index * index)
            - T::lit(0.1) * u * (T::one() + xi[0])
    }
}

/// u = 3/10 cos τ on x = (τ, sin τ /5), with ξ upwards.
pub(crate) struct Wave;
impl InitialManifold for Wave {
    const COVECTOR: Covector = Covector::Guessed;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let (s, c) = tau[0].sin_cos();
        (x[0], x[1]) = (tau[0], T::lit(0.2) * s);
        T::lit(0.3) * c
    }
    fn covector<T: Real>(&self, _tau: &[T], xi: &mut [T]) {
        (xi[0], xi[1]) = (T::zero(), T::one());
    }
}

/// An equation, or a manifold, in the coordinates x = R z + a, ξ = R ζ of a plane turned by an angle.
pub(crate) struct Turned<A> {
    pub(crate) inner: A,
    pub(crate) angle: f64,
    pub(crate) shift: [f64; 2],
}
impl<A> Turned<A> {
    fn turn<T: Real>(&self, z: &[T]) -> [T; 2] {
        let (s, c) = self.angle.sin_cos();
        [T::lit(c) * z[0] - T::lit(s) * z[1], T::lit(s) * z[0] + T::lit(c) * z[1]]
    }
    fn back<T: Real>(&self, x: [T; 2]) -> [T; 2] {
        let (s, c) = self.angle.sin_cos();
        [T::lit(c) * x[0] + T::lit(s) * x[1], T::lit(c) * x[1] - T::lit(s) * x[0]]
    }
}
impl<P: FirstOrderPde> FirstOrderPde for Turned<P> {
    fn value<T: Real>(&self, z: &[T], u: T, zeta: &[T]) -> T {
        let x = self.turn(z);
        self.inner.value(&[x[0] + T::lit(self.shift[0]), x[1] + T::lit(self.shift[1])], u, &self.turn(zeta))
    }
}
impl<M: InitialManifold> InitialManifold for Turned<M> {
    const COVECTOR: Covector = M::COVECTOR;
    fn place<T: Real>(&self, tau: &[T], z: &mut [T]) -> T {
        let mut x = [T::zero(); 2];
        let u = self.inner.place(tau, &mut x);
        z.copy_from_slice(&self.back([x[0] - T::lit(self.shift[0]), x[1] - T::lit(self.shift[1])]));
        u
    }
    fn covector<T: Real>(&self, tau: &[T], zeta: &mut [T]) {
        let mut xi = [T::zero(); 2];
        self.inner.covector(tau, &mut xi);
        zeta.copy_from_slice(&self.back(xi));
    }
}

/// The same equation with its variables in the opposite order, and the same for a manifold.
pub(crate) struct Relabelled<A>(pub(crate) A);
impl<P: FirstOrderPde> FirstOrderPde for Relabelled<P> {
    fn value<T: Real>(&self, x: &[T], u: T, xi: &[T]) -> T {
        self.0.value(&[x[1], x[0]], u, &[xi[1], xi[0]])
    }
}
impl<M: InitialManifold> InitialManifold for Relabelled<M> {
    const COVECTOR: Covector = M::COVECTOR;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let u = self.0.place(tau, x);
        x.swap(0, 1);
        u
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        self.0.covector(tau, xi);
        xi.swap(0, 1);
    }
}

/// Another parameter on the same manifold: τ = σ + sin σ /2.
pub(crate) struct Reparametrised<M>(pub(crate) M);
impl<M: InitialManifold> InitialManifold for Reparametrised<M> {
    const COVECTOR: Covector = M::COVECTOR;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        self.0.place(&[tau[0] + T::lit(0.5) * tau[0].sin()], x)
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        self.0.covector(&[tau[0] + T::lit(0.5) * tau[0].sin()], xi);
    }
}

/// The same equation times (2 + sin x¹ + ξ₂²): other parameters s, the same solutions.
pub(crate) struct Multiplied<P>(pub(crate) P);
impl<P: FirstOrderPde> FirstOrderPde for Multiplied<P> {
    fn value<T: Real>(&self, x: &[T], u: T, xi: &[T]) -> T {
        (T::lit(2.0) + x[0].sin() + xi[1] * xi[1]) * self.0.value(x, u, xi)
    }
}

/// u = 0 on x⁴ = (cos τ¹ + cos τ² + cos τ³)/10.
pub(crate) struct Hill;
impl InitialManifold for Hill {
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        x[..3].copy_from_slice(tau);
        x[3] = T::lit(0.1) * (tau[0].cos() + tau[1].cos() + tau[2].cos());
        T::zero()
    }
}

/// u = 0 on the ellipsoid with the semi-axes given, by longitude and latitude, with ξ inwards.
pub(crate) struct Ellipsoid(pub(crate) [f64; 3]);
impl InitialManifold for Ellipsoid {
    const COVECTOR: Covector = Covector::Guessed;
    fn place<T: Real>(&self, tau: &[T], x: &mut [T]) -> T {
        let ((s, c), (sin, cos)) = (tau[0].sin_cos(), tau[1].sin_cos());
        let [a, b, d] = self.0.map(T::lit);
        (x[0], x[1], x[2]) = (a * c * cos, b * s * cos, d * sin);
        T::zero()
    }
    fn covector<T: Real>(&self, tau: &[T], xi: &mut [T]) {
        let ((s, c), (sin, cos)) = (tau[0].sin_cos(), tau[1].sin_cos());
        let [a, b, d] = self.0.map(T::lit);
        (xi[0], xi[1], xi[2]) = (-c * cos / a, -s * cos / b, -sin / d);
    }
}
