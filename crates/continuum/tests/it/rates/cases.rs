//! Random motions and what the tests share.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::rates::{GradientRate, VelocityGradient};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::Real;
use piola_testkit::strategies::{rotation, rotation_matrix, vector};
use proptest::prelude::*;

/// A motion near a time, its stress, and an observer: polynomials in time.
#[derive(Clone, Debug)]
pub(crate) struct Path {
    /// F, Ḟ, F̈/2 at t = 0.
    pub(crate) gradient: [Matrix3<f64>; 3],
    /// T and Ṫ at t = 0.
    pub(crate) stress: [Symmetric; 2],
    /// Q at t = 0 and the axial vector of Q̇Qᵀ, constant.
    pub(crate) frame: Matrix3<f64>,
    pub(crate) turning: Vector3<f64>,
}

/// Entry by entry, without derivatives.
pub(crate) fn lift<T: Real>(a: &Matrix3<f64>) -> Matrix3<T> {
    a.map(T::lit)
}

impl Path {
    /// F(t).
    pub(crate) fn at<T: Real>(&self, t: T) -> Matrix3<T> {
        let [f, rate, half] = &self.gradient;
        lift::<T>(f) + lift::<T>(rate) * t + lift::<T>(half) * (t * t)
    }
    /// T(t).
    pub(crate) fn stress_at<T: Real>(&self, t: T) -> Symmetric<T> {
        let [value, rate] = self.stress;
        let at = |k: usize| T::lit(value.components[k]) + T::lit(rate.components[k]) * t;
        Symmetric { components: [at(0), at(1), at(2), at(3), at(4), at(5)] }
    }
    /// Q(t) = exp(Ω t) Q.
    pub(crate) fn frame_at<T: Real>(&self, t: T) -> Matrix3<T> {
        let w = self.turning;
        let skew = Matrix3::new(0.0, -w.z, w.y, w.z, 0.0, -w.x, -w.y, w.x, 0.0);
        piola_continuum::rates::exponential(&(lift::<T>(&skew) * t)).expect("finite") * lift::<T>(&self.frame)
    }
    pub(crate) fn deformation(&self) -> DeformationGradient {
        DeformationGradient::new(self.gradient[0]).expect("0 < det F")
    }
    pub(crate) fn rate(&self) -> GradientRate {
        GradientRate(self.gradient[1])
    }
    pub(crate) fn velocity_gradient(&self) -> VelocityGradient {
        VelocityGradient::of(&self.deformation(), &self.rate())
    }
    /// |F| |F⁻¹|, by Frobenius' norm.
    pub(crate) fn condition(&self) -> f64 {
        self.gradient[0].norm() * self.gradient[0].try_inverse().expect("regular").norm()
    }
}

/// Stretches between ⅓ and 3, some of them coalescent or nearly so, in random frames; rates of order one.
pub(crate) fn path() -> impl Strategy<Value = Path> {
    let gap = prop_oneof![3 => Just(1.0), 1 => Just(0.0), 1 => Just(1e-9), 1 => Just(1e-4)];
    let numbers = vector(18 + 12 + 3, -1.0..1.0);
    (rotation(), rotation(), rotation(), vector(3, 0.34..3.0), gap, numbers).prop_map(|(q, r, frame, l, gap, x)| {
        let turn = |q| Matrix3::from_row_slice(rotation_matrix(q).as_flattened());
        let stretches = Vector3::new(l[0], l[0] + gap * (l[1] - l[0]), l[2]);
        let gradient = turn(q) * Matrix3::from_diagonal(&stretches) * turn(r).transpose();
        let six = |k: usize| Symmetric { components: [x[k], x[k + 1], x[k + 2], x[k + 3], x[k + 4], x[k + 5]] };
        Path {
            gradient: [gradient, Matrix3::from_row_slice(&x[..9]), Matrix3::from_row_slice(&x[9..18])],
            stress: [six(18), six(24)],
            frame: turn(frame),
            turning: Vector3::new(x[30], x[31], x[32]),
        }
    })
}

/// The same with stretches that differ by more than 10⁻³.
pub(crate) fn distinct() -> impl Strategy<Value = Path> {
    path().prop_filter("the stretches are to be distinct", |path| 1e-3 < gap(path))
}

/// The least gap of the stretches.
pub(crate) fn gap(path: &Path) -> f64 {
    let stretches = path.gradient[0].singular_values();
    (stretches[0] - stretches[1]).min(stretches[1] - stretches[2])
}

/// The nine entries, by rows.
pub(crate) fn nine(matrix: &Matrix3<f64>) -> Vec<f64> {
    matrix.transpose().as_slice().to_vec()
}

/// Asserts |A − B| ≤ tol × the larger of |B| and `scale`.
#[track_caller]
pub(crate) fn assert_same(what: &str, a: &Matrix3<f64>, b: &Matrix3<f64>, scale: f64, tol: piola_testkit::Tol) {
    piola_testkit::assert_close_at_scale(what, &nine(a), &nine(b), scale, tol);
}
