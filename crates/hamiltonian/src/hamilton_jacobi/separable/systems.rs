//! Systems that separate: the Kepler problem in two ways, and two fixed centres.

use piola_numerics::Real;

use super::Separable;
use crate::PhaseFunction;

/// The Kepler problem in polar coordinates q = (r, φ), with the constants c = (E, L).
///
/// ```text
/// H = (p_r² + p_φ²/r²)/(2m) − k/r        p_r² = 2m(E + k/r) − L²/r²,   p_φ² = L²
/// ```
///
/// # Example
/// See [`SeparableMotion::integral`](super::SeparableMotion::integral).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KeplerPolar {
    /// m, kg.
    pub mass: f64,
    /// k = G M m, J m.
    pub strength: f64,
}

impl PhaseFunction for KeplerPolar {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        (p[0] * p[0] + p[1] * p[1] / (q[0] * q[0])) * T::lit(0.5 / self.mass) - T::lit(self.strength) / q[0]
    }
}

impl Separable for KeplerPolar {
    fn freedom(&self) -> usize {
        2
    }
    fn square<T: Real>(&self, coordinate: usize, x: T, c: &[T]) -> T {
        let moment = c[1] * c[1];
        if coordinate == 0 {
            T::lit(2.0 * self.mass) * (c[0] + T::lit(self.strength) / x) - moment / (x * x)
        } else {
            moment
        }
    }
    fn constants(&self, q: &[f64], p: &[f64], constants: &mut [f64]) {
        constants[0] = self.value(q, p, 0.0);
        constants[1] = p[1];
    }
    fn range(&self, coordinate: usize) -> (f64, f64) {
        (if coordinate == 0 { 0.0 } else { f64::NEG_INFINITY }, f64::INFINITY)
    }
}

/// The plane Kepler problem in parabolic coordinates q = (ξ, η), with the constants c = (E, β).
///
/// ```text
/// x = (ξ² − η²)/2,   y = ξη,   r = (ξ² + η²)/2
/// H = ((p_ξ² + p_η²)/(2m) − 2k)/(ξ² + η²)
/// p_ξ² = 2mEξ² + 2mk + β,   p_η² = 2mEη² + 2mk − β
/// ```
///
/// β/(2m) is the component of Laplace's vector along x, with its sign changed.
///
/// # Example
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{KeplerParabolic, SeparableMotion};
/// let kepler = KeplerParabolic { mass: 1.0, strength: 1.0 };
/// // From rest at x = 1/2 straight into the centre, and through it: 4a = 1 and the period is 2π a^{3/2}.
/// let motion = SeparableMotion::through(&kepler, (&[1.0, 0.0], &[0.0, 0.0], 0.0))?;
/// assert_eq!(motion.constants()[0], -2.0);
/// assert!((motion.turning_points(0).0.unwrap() + 1.0).abs() < 1e-14);
/// let (q, _) = motion.at(std::f64::consts::PI / 8.0)?; // half of it: at the centre
/// assert!(q[0].abs() < 1e-4); // ξ goes through zero with the cube root of the time
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct KeplerParabolic {
    /// m, kg.
    pub mass: f64,
    /// k = G M m, J m.
    pub strength: f64,
}

impl PhaseFunction for KeplerParabolic {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let kinetic = (p[0] * p[0] + p[1] * p[1]) * T::lit(0.5 / self.mass);
        (kinetic - T::lit(2.0 * self.strength)) / (q[0] * q[0] + q[1] * q[1])
    }
}

impl Separable for KeplerParabolic {
    fn freedom(&self) -> usize {
        2
    }
    fn square<T: Real>(&self, coordinate: usize, x: T, c: &[T]) -> T {
        let beta = if coordinate == 0 { c[1] } else { -c[1] };
        T::lit(2.0 * self.mass) * (c[0] * x * x + T::lit(self.strength)) + beta
    }
    fn constants(&self, q: &[f64], p: &[f64], constants: &mut [f64]) {
        let energy = self.value(q, p, 0.0);
        // (η² R_ξ − ξ² R_η)/(ξ² + η²): no difference of large terms near either axis.
        let (xi, eta) = (q[0] * q[0], q[1] * q[1]);
        let sum = xi + eta;
        let momenta = (p[0] * p[0] * eta - p[1] * p[1] * xi) / sum;
        constants[0] = energy;
        constants[1] = momenta + 2.0 * self.mass * self.strength * (xi - eta) / sum;
    }
}

/// A plane motion in the attraction of two fixed centres at x = ±c, in elliptic coordinates q = (μ, ν), with the
/// constants (E, γ).
///
/// ```text
/// x = c cosh μ cos ν,   y = c sinh μ sin ν,   r₁ = c(cosh μ − cos ν),   r₂ = c(cosh μ + cos ν)
/// H = (p_μ² + p_ν²)/(2mc²(cosh²μ − cos²ν)) − k₁/r₁ − k₂/r₂
/// p_μ² = 2mc²E cosh²μ + 2mc(k₁ + k₂) cosh μ − γ
/// p_ν² = −2mc²E cos²ν + 2mc(k₁ − k₂) cos ν + γ
/// ```
///
/// r₁ is the distance from the centre at +c.
///
/// # Example
/// ```
/// use piola_hamiltonian::hamilton_jacobi::{FixedCentres, SeparableMotion};
/// let centres = FixedCentres { mass: 1.0, strengths: [1.0, 1.0], half_distance: 1.0 };
/// // Along the line of symmetry x = 0, from rest at y = sinh 1.
/// let ninety = std::f64::consts::FRAC_PI_2;
/// let motion = SeparableMotion::through(&centres, (&[1.0, ninety], &[0.0, 0.0], 0.0))?;
/// assert!((motion.constants()[0] + 2.0 / 1_f64.cosh()).abs() < 1e-15);
/// assert!((motion.turning_points(0).0.unwrap() + 1.0).abs() < 1e-13); // and through to the other side
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct FixedCentres {
    /// m, kg.
    pub mass: f64,
    /// k₁ of the centre at +c and k₂ of that at −c, J m.
    pub strengths: [f64; 2],
    /// c, m.
    pub half_distance: f64,
}

impl PhaseFunction for FixedCentres {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let (c, [first, second]) = (T::lit(self.half_distance), self.strengths);
        let (radial, angular) = (q[0].cosh(), q[1].cos());
        // cosh²μ − cos²ν without cancellation.
        let (sinh, sin) = (q[0].sinh(), q[1].sin());
        let kinetic = (p[0] * p[0] + p[1] * p[1]) * T::lit(0.5 / self.mass) / (c * c * (sinh * sinh + sin * sin));
        kinetic - T::lit(first) / (c * (radial - angular)) - T::lit(second) / (c * (radial + angular))
    }
}

impl Separable for FixedCentres {
    fn freedom(&self) -> usize {
        2
    }
    fn square<T: Real>(&self, coordinate: usize, x: T, c: &[T]) -> T {
        let (scale, [first, second]) = (2.0 * self.mass * self.half_distance, self.strengths);
        let (energy, attraction) = (T::lit(scale * self.half_distance) * c[0], T::lit(scale));
        if coordinate == 0 {
            let cosh = x.cosh();
            (energy * cosh + attraction * T::lit(first + second)) * cosh - c[1]
        } else {
            let cos = x.cos();
            (attraction * T::lit(first - second) - energy * cos) * cos + c[1]
        }
    }
    fn constants(&self, q: &[f64], p: &[f64], constants: &mut [f64]) {
        constants[0] = self.value(q, p, 0.0);
        constants[1] = 0.0;
        let angular = self.square(1, q[1], constants);
        constants[1] = p[1] * p[1] - angular;
    }
}
