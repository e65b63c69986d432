//! Motions, stresses and coordinates whose derivatives are written out by hand.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::{CauchyStress, Symmetric};
use piola_fields::{Coordinates, Field, Motion};
use piola_numerics::Real;
use proptest::prelude::*;

/// uᵢ = A (sin(Xⱼ + pᵢ + ωt) + ½ Xₖ² sin(ωt + pᵢ)), (i, j, k) cyclic.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wave {
    pub(crate) amplitude: f64,
    pub(crate) phase: [f64; 3],
    pub(crate) frequency: f64,
}

impl Motion for Wave {
    fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        reference + self.displacement(reference, time)
    }
    fn displacement<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        Vector3::from_fn(|i, _| {
            let angle = T::lit(self.phase[i]) + T::lit(self.frequency) * time;
            let square = reference[(i + 2) % 3] * reference[(i + 2) % 3];
            let wave = (reference[(i + 1) % 3] + angle).sin() + T::lit(0.5) * square * angle.sin();
            T::lit(self.amplitude) * wave
        })
    }
}

impl Wave {
    /// The n-th derivative with respect to time of u and of ∇u, by hand.
    pub(crate) fn by_hand(&self, x: &Vector3<f64>, time: f64, n: i32) -> (Vector3<f64>, Matrix3<f64>) {
        let factor = self.amplitude * self.frequency.powi(n);
        let turn = f64::from(n) * core::f64::consts::FRAC_PI_2;
        let mut u = Vector3::zeros();
        let mut gradient = Matrix3::zeros();
        for i in 0..3 {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            // The n-th derivative of the sine is the sine a quarter turn later n times.
            let angle = self.phase[i] + self.frequency * time + turn;
            u[i] = factor * ((x[j] + angle).sin() + 0.5 * x[k] * x[k] * angle.sin());
            gradient[(i, j)] = factor * (x[j] + angle).cos();
            gradient[(i, k)] = factor * x[k] * angle.sin();
        }
        (u, gradient)
    }
}

pub(crate) fn wave() -> impl Strategy<Value = Wave> + Clone {
    (0.02..0.15_f64, [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0], -2.0..2.0_f64)
        .prop_map(|(amplitude, phase, frequency)| Wave { amplitude, phase, frequency })
}

pub(crate) fn point() -> impl Strategy<Value = Vector3<f64>> + Clone {
    [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0].prop_map(Vector3::from)
}

/// T = Σ over polynomial and trigonometric terms of x and t; not symmetric as a `Matrix3`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tensor {
    pub(crate) coefficients: [f64; 9],
}

impl Field for Tensor {
    type Value = Matrix3<f64>;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Matrix3<T> {
        Matrix3::from_fn(|i, j| {
            let c = T::lit(self.coefficients[3 * i + j]);
            c * (place[i] * place[j] + (place[(i + j) % 3] + time).sin()) + place[(i + 1) % 3]
        })
    }
}

impl Tensor {
    /// ∂Tᵢⱼ/∂xₖ by hand.
    pub(crate) fn slope(&self, x: &Vector3<f64>, time: f64, i: usize, j: usize, k: usize) -> f64 {
        let delta = |a: usize, b: usize| if a == b { 1.0 } else { 0.0 };
        let product = delta(i, k) * x[j] + x[i] * delta(j, k);
        let wave = delta((i + j) % 3, k) * (x[(i + j) % 3] + time).cos();
        self.coefficients[3 * i + j] * (product + wave) + delta((i + 1) % 3, k)
    }
    /// ∂Tᵢⱼ/∂xⱼ by hand.
    pub(crate) fn divergence(&self, x: &Vector3<f64>, time: f64) -> Vector3<f64> {
        Vector3::from_fn(|i, _| (0..3).map(|j| self.slope(x, time, i, j, j)).sum())
    }
}

pub(crate) fn tensor() -> impl Strategy<Value = Tensor> + Clone {
    proptest::array::uniform9(-2.0..2.0_f64).prop_map(|coefficients| Tensor { coefficients })
}

/// The symmetric part of a [`Tensor`], as a stress.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Stress(pub(crate) Tensor);

impl Field for Stress {
    type Value = CauchyStress;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> CauchyStress<T> {
        let m = self.0.at(place, time);
        let rows = [0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| m[(i, j)]));
        CauchyStress(Symmetric::symmetric_part(rows))
    }
}

impl Stress {
    pub(crate) fn divergence(&self, x: &Vector3<f64>, time: f64) -> Vector3<f64> {
        let half = |i: usize, j: usize| 0.5 * (self.0.slope(x, time, i, j, j) + self.0.slope(x, time, j, i, j));
        Vector3::from_fn(|i, _| half(i, 0) + half(i, 1) + half(i, 2))
    }
}

/// The first column of a [`Tensor`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Column(pub(crate) Tensor);

impl Field for Column {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Vector3<T> {
        let m = self.0.at(place, time);
        Vector3::new(m[(0, 0)], m[(1, 0)], m[(2, 0)])
    }
}

/// The last entry of a [`Tensor`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct Entry(pub(crate) Tensor);

impl Field for Entry {
    type Value = f64;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> T {
        self.0.at(place, time)[(2, 2)]
    }
}

/// Orthogonal coordinates with unit vectors written out by hand.
pub(crate) trait ByHand: Coordinates + Copy {
    /// eᵢ in Cartesian components, one a row.
    fn directions<T: Real>(&self, q: &Vector3<T>) -> Matrix3<T>;
}

/// A Cartesian field of tensors in the physical components of a system.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Physical<C, F> {
    pub(crate) system: C,
    pub(crate) field: F,
}

impl<C: ByHand> Field for Physical<C, Tensor> {
    type Value = Matrix3<f64>;
    fn at<T: Real>(&self, q: &Vector3<T>, time: T) -> Matrix3<T> {
        let e = self.system.directions(q);
        e * self.field.at(&self.system.place(q), time) * e.transpose()
    }
}

impl<C: ByHand> Field for Physical<C, Column> {
    type Value = Vector3<f64>;
    fn at<T: Real>(&self, q: &Vector3<T>, time: T) -> Vector3<T> {
        self.system.directions(q) * self.field.at(&self.system.place(q), time)
    }
}

impl<C: ByHand> Field for Physical<C, Stress> {
    type Value = CauchyStress;
    fn at<T: Real>(&self, q: &Vector3<T>, time: T) -> CauchyStress<T> {
        let e = self.system.directions(q);
        let m = e * self.field.at(&self.system.place(q), time).matrix() * e.transpose();
        CauchyStress(Symmetric::symmetric_part([0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| m[(i, j)]))))
    }
}

impl<C: ByHand> Field for Physical<C, Entry> {
    type Value = f64;
    fn at<T: Real>(&self, q: &Vector3<T>, time: T) -> T {
        self.field.at(&self.system.place(q), time)
    }
}
