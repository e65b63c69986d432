//! The laws that are measured, and the Mooney–Rivlin solid by other means: its printed formula in nalgebra's matrices and
//! in lanes, and without a tangent.
//!
//! ```text
//! P = 2 C₁₀ F + 2 C₀₁ F (I₁ 1 − C) + (2 c J² − d) F⁻ᵀ
//! ```
//! It cancels at small strain: its `error` says so.

pub mod floor;
pub mod laws;

use nalgebra::{Matrix3, SMatrix};
use piola_constitutive::solids::{Hyperelastic, MooneyRivlin};
use piola_continuum::tensor::rows::{Rows, cofactor, product, scaled, sum, transposed_product};
use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{dot, from_rows};

/// C₁₀, C₀₁, c and d of the printed formula, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Printed {
    /// C₁₀.
    pub c10: f64,
    /// C₀₁.
    pub c01: f64,
    /// c.
    pub c: f64,
    /// d.
    pub d: f64,
}

impl Printed {
    /// P as one writes it in nalgebra.
    #[inline]
    #[must_use]
    pub fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let right = f.transpose() * f;
        let j = f.determinant();
        let inverse = f.try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        f * (2.0 * self.c10)
            + f * (Matrix3::identity() * right.trace() - right) * (2.0 * self.c01)
            + inverse.transpose() * (2.0 * self.c * j * j - self.d)
    }

    /// ∂P/∂F as one writes it in nalgebra, entry by entry.
    #[inline]
    #[must_use]
    pub fn first_piola_tangent(&self, f: &Matrix3<f64>) -> SMatrix<f64, 9, 9> {
        let (right, left) = (f.transpose() * f, f * f.transpose());
        let j = f.determinant();
        let inverse = f.try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN));
        let (trace, one) = (right.trace(), Matrix3::<f64>::identity());
        SMatrix::from_fn(|r, s| {
            let (i, p, k, q) = (r / 3, r % 3, s / 3, s % 3);
            2.0 * self.c10 * one[(i, k)] * one[(p, q)]
                + 2.0
                    * self.c01
                    * (trace * one[(i, k)] * one[(p, q)] + 2.0 * f[(i, p)] * f[(k, q)]
                        - one[(i, k)] * right[(p, q)]
                        - f[(i, q)] * f[(k, p)]
                        - left[(i, k)] * one[(p, q)])
                + 4.0 * self.c * j * j * inverse[(p, i)] * inverse[(q, k)]
                - (2.0 * self.c * j * j - self.d) * inverse[(p, k)] * inverse[(q, i)]
        })
    }
}

/// The printed formula in lanes.
impl Hyperelastic for Printed {
    #[inline(always)]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        deformation.jacobian()
    }

    #[inline(always)]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        let f = deformation.gradient_rows();
        let cofactor = cofactor(f);
        let j = dot(f[0], cofactor[0]);
        let right: Rows<T> = transposed_product(f, f);
        let trace = right[0][0] + right[1][1] + right[2][2];
        let w = T::lit(2.0 * self.c01);
        let diagonal = T::lit(2.0 * self.c10) + w * trace;
        let mut inner = scaled(right, -w);
        inner[0][0] += diagonal;
        inner[1][1] += diagonal;
        inner[2][2] += diagonal;
        let volume = (T::lit(2.0 * self.c) * j * j - T::lit(self.d)) / j;
        FirstPiola(from_rows(sum(product(f, inner), scaled(cofactor, volume))))
    }
}

/// The law with its energy and stress alone: its tangent is nowhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithoutTangent(
    /// The law.
    pub MooneyRivlin,
);

impl Hyperelastic for WithoutTangent {
    #[inline(always)]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.0.energy(deformation)
    }

    #[inline(always)]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.0.first_piola(deformation)
    }
}
