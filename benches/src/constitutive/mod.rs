//! The laws that are measured, each with its textbook's formula in [`naive`]; and the Mooney–Rivlin solid by other means: its
//! printed formula in lanes, and without a tangent.
//!
//! ```text
//! P = 2 C₁₀ F + 2 C₀₁ F (I₁ 1 − C) + (2 c J² − d) F⁻ᵀ
//! ```
//! It cancels at small strain: its `error` says so.

pub mod floor;
pub mod laws;
pub mod naive;

use piola_continuum::{Deformation, FirstPiola};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{dot, from_rows};
use piola_solids::{Hyperelastic, MooneyRivlin};
use piola_tensor::internal::rows::{Rows, cofactor, product, scaled, sum, transposed_product};

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

/// The printed formula in lanes.
impl Hyperelastic for Printed {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        deformation.jacobian()
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
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
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn energy<T: Real>(&self, deformation: &impl Deformation<T>) -> T {
        self.0.energy(deformation)
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn first_piola<T: Real>(&self, deformation: &impl Deformation<T>) -> FirstPiola<T> {
        self.0.first_piola(deformation)
    }
}
