//! Motions, stresses and fields that are polynomials of the place, so that rules of quadrature are exact for them.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{Deformation, FirstPiola};
use piola_fields::integral::StoredEnergy;
use piola_fields::{Body, Field, Material, Motion};
use piola_numerics::{Gradient, Real};
use proptest::prelude::*;

/// x = X + sin(t) A X + cos(2t) B (X ⊗ X) + t² c with small A and B: F is linear in X and 0 < det F near the origin.
#[derive(Clone, Debug)]
pub(super) struct Quadratic {
    pub(super) linear: [[f64; 3]; 3],
    /// Of x², y², z², xy, yz, xz.
    pub(super) of_squares: [[f64; 6]; 3],
    pub(super) shift: [f64; 3],
}

fn squares<T: Real>(x: &Vector3<T>) -> [T; 6] {
    [x.x * x.x, x.y * x.y, x.z * x.z, x.x * x.y, x.y * x.z, x.x * x.z]
}

fn sum<T: Real, const N: usize>(coefficients: &[f64; N], values: &[T; N]) -> T {
    coefficients.iter().zip(values).fold(T::lit(0.0), |sum, (&c, &v)| sum + T::lit(c) * v)
}

impl Motion for Quadratic {
    fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        let (x, squares): ([T; 3], _) = ((*reference).into(), squares(reference));
        let (first, second) = (time.sin(), (T::lit(2.0) * time).cos());
        let u = |i: usize| {
            first * sum(&self.linear[i], &x)
                + second * sum(&self.of_squares[i], &squares)
                + time * time * T::lit(self.shift[i])
        };
        reference + Vector3::new(u(0), u(1), u(2))
    }
}

/// A vector field, quadratic in the place, with coefficients that change in time.
#[derive(Clone, Debug)]
pub(super) struct QuadraticField {
    pub(super) coefficients: [[f64; 10]; 3],
}

impl Field for QuadraticField {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Vector3<T> {
        let [a, b, c, d, e, f] = squares(place);
        let s = time.sin();
        let values = [T::lit(1.0), place.x, place.y, place.z, a * s, b, c, d * time, e, f];
        Vector3::from_fn(|i, _| sum(&self.coefficients[i], &values) * (T::lit(1.0) + time))
    }
}

/// 1 + a · X.
#[derive(Clone, Copy, Debug)]
pub(super) struct AffineDensity(pub(super) [f64; 3]);

impl Field for AffineDensity {
    type Value = f64;
    fn at<T: Real>(&self, particle: &Vector3<T>, _: T) -> T {
        T::lit(1.0) + sum(&self.0, &(*particle).into())
    }
}

/// A motion with a stress P = F S(X), S symmetric and linear in X, and a density linear in X.
#[derive(Clone, Debug)]
pub(super) struct Balanced {
    pub(super) motion: Quadratic,
    /// Components 11, 22, 33, 12, 23, 13 of S, each of 1, x, y, z.
    pub(super) stress: [[f64; 4]; 6],
    pub(super) density: AffineDensity,
}

/// The stress of a [`Balanced`] body.
#[derive(Clone, Copy, Debug)]
pub(super) struct StressOf<'a>(pub(super) &'a Balanced);

impl Field for StressOf<'_> {
    type Value = FirstPiola;
    fn at<T: Real>(&self, particle: &Vector3<T>, time: T) -> FirstPiola<T> {
        let values = [T::lit(1.0), particle.x, particle.y, particle.z];
        let [a, b, c, d, e, f] = core::array::from_fn(|k| sum(&self.0.stress[k], &values));
        let second = Matrix3::new(a, d, f, d, b, e, f, e, c);
        let deformation = self.0.motion.deformation_gradient(particle, time).expect("regular");
        FirstPiola(deformation.matrix() * second)
    }
}

/// The body force b = ẍ − `Div P/ρ_κ` that balances a [`Balanced`] body, times a factor.
#[derive(Clone, Copy, Debug)]
pub(super) struct ForceOf<'a>(pub(super) &'a Balanced, pub(super) f64);

impl Field for ForceOf<'_> {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, particle: &Vector3<T>, time: T) -> Vector3<T> {
        let x = Vector3::from_fn(|i, _| Gradient::<T, 3>::variable(particle[i], i));
        let divergence = divergence(&StressOf(self.0).at(&x, Gradient::constant(time)).matrix());
        let density = self.0.density.at(particle, time);
        let acceleration = self.0.motion.acceleration(particle, time).expect("regular");
        Vector3::from_fn(|i, _| (acceleration[i] - divergence[i] / density) * T::lit(self.1))
    }
}

impl Balanced {
    pub(super) fn body(&self) -> Body<&Quadratic, AffineDensity> {
        Body { motion: &self.motion, reference_density: self.density }
    }
    pub(super) fn stress_field(&self) -> Material<StressOf<'_>> {
        Material(StressOf(self))
    }
    pub(super) fn force_field(&self) -> Material<ForceOf<'_>> {
        Material(ForceOf(self, 1.0))
    }
}

/// Div P from derivatives with respect to X.
pub(super) fn divergence<T: Real>(stress: &Matrix3<Gradient<T, 3>>) -> Vector3<T> {
    let component = |i: usize| stress[(i, 0)].partials[0] + stress[(i, 1)].partials[1] + stress[(i, 2)].partials[2];
    Vector3::new(component(0), component(1), component(2))
}

/// W = ½ λ (tr E)² + μ E : E, of St. Venant and Kirchhoff.
#[derive(Clone, Copy, Debug)]
pub(super) struct SaintVenant {
    pub(super) lambda: f64,
    pub(super) mu: f64,
}

impl StoredEnergy for SaintVenant {
    fn density<T: Real>(&self, _: &Vector3<f64>, gradient: &Matrix3<T>) -> T {
        let c = gradient.transpose() * gradient;
        let half = T::lit(0.5);
        let e = |i: usize, j: usize| half * (c[(i, j)] - if i == j { T::lit(1.0) } else { T::lit(0.0) });
        let trace = e(0, 0) + e(1, 1) + e(2, 2);
        let squares = (0..9).fold(T::lit(0.0), |sum, k| sum + e(k / 3, k % 3) * e(k / 3, k % 3));
        T::lit(0.5 * self.lambda) * trace * trace + T::lit(self.mu) * squares
    }
}

/// The body force that a hyperelastic body of uniform density one needs for a motion: b = ẍ − Div ∂W/∂F.
#[derive(Clone, Copy, Debug)]
pub(super) struct HyperelasticForce<'a>(pub(super) &'a Quadratic, pub(super) SaintVenant);

impl Field for HyperelasticForce<'_> {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, particle: &Vector3<T>, time: T) -> Vector3<T> {
        let x = Vector3::from_fn(|i, _| Gradient::<T, 3>::variable(particle[i], i));
        let deformation = self.0.deformation_gradient(&x, Gradient::constant(time)).expect("regular");
        // The energy is the same at all particles.
        let stress = self.1.stress(&Vector3::zeros(), deformation.matrix()).matrix();
        self.0.acceleration(particle, time).expect("regular") - divergence(&stress)
    }
}

/// The stress ∂W/∂F of a motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct HyperelasticStress<'a>(pub(super) &'a Quadratic, pub(super) SaintVenant);

impl Field for HyperelasticStress<'_> {
    type Value = FirstPiola;
    fn at<T: Real>(&self, particle: &Vector3<T>, time: T) -> FirstPiola<T> {
        let deformation = self.0.deformation_gradient(particle, time).expect("regular");
        self.1.stress(&Vector3::zeros(), deformation.matrix())
    }
}

fn coefficients<const N: usize>(size: f64) -> impl Strategy<Value = [f64; N]> {
    proptest::collection::vec(-size..size, N).prop_map(|values| core::array::from_fn(|i| values[i]))
}

pub(super) fn quadratic() -> impl Strategy<Value = Quadratic> {
    let rows = || [coefficients::<3>(0.1), coefficients::<3>(0.1), coefficients::<3>(0.1)];
    let squares = || [coefficients::<6>(0.04), coefficients::<6>(0.04), coefficients::<6>(0.04)];
    (rows(), squares(), coefficients::<3>(1.0)).prop_map(|(linear, of_squares, shift)| Quadratic {
        linear,
        of_squares,
        shift,
    })
}

pub(super) fn field() -> impl Strategy<Value = QuadraticField> {
    let rows = [coefficients::<10>(1.0), coefficients::<10>(1.0), coefficients::<10>(1.0)];
    rows.prop_map(|coefficients| QuadraticField { coefficients })
}

pub(super) fn balanced() -> impl Strategy<Value = Balanced> {
    let stress = proptest::collection::vec(coefficients::<4>(1.0), 6);
    (quadratic(), stress, coefficients::<3>(0.2)).prop_map(|(motion, stress, variation)| Balanced {
        motion,
        stress: core::array::from_fn(|k| stress[k]),
        density: AffineDensity(variation),
    })
}

/// J.
pub(super) fn volume_ratio(motion: &impl Motion, particle: &Vector3<f64>, time: f64) -> f64 {
    motion.deformation_gradient(particle, time).expect("regular").jacobian()
}
