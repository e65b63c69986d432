//! The laws as one writes them from a textbook in nalgebra: matrices and their operations for P, index formulas for ∂P/∂F.
//!
//! | module | laws | made of |
//! |---|---|---|
//! | [`invariants`] | W(I₁, I₂, J) | C, its invariants and F⁻ᵀ |
//! | [`isochoric`] | W̄(Ī₁, Ī₂) + U(J) | the same, by the chain rule |
//! | [`strains`] | linear, of St. Venant and Kirchhoff, of Fung | S of E, P = F S |
//! | [`fibres`] | with families of fibres | F a and a · C a |
//! | [`stretches`] | W(λ₁, λ₂, λ₃) | eigenvalues and eigenvectors of C |
//!
//! Parameters are those of the law itself, see [`Textbook`]. Where a law is a difference that vanishes with the strain, such
//! as μ (F − F⁻ᵀ), its printed form cancels at small strain.

pub mod fibres;
pub mod invariants;
pub mod isochoric;
pub mod strains;
pub mod stretches;

use std::error::Error;

use nalgebra::{Matrix3, SMatrix};
use piola_continuum::DeformationGradient;
use piola_solids::Hyperelastic;
use piola_testkit::relative_error;

/// ∂P/∂F, Pa: row 3 i + p and column 3 k + q for `∂P_ip/∂F_kq`.
pub type Tangent = SMatrix<f64, 9, 9>;

/// P and ∂P/∂F of F, Pa.
pub trait Naive {
    /// P.
    #[must_use]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64>;

    /// ∂P/∂F.
    #[must_use]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent;

    /// Both, one after the other.
    #[inline]
    #[must_use]
    fn first_piola_and_tangent(&self, f: &Matrix3<f64>) -> (Matrix3<f64>, Tangent) {
        (self.first_piola(f), self.first_piola_tangent(f))
    }
}

/// A law that has its textbook's formula beside it.
pub trait Textbook {
    /// The formula.
    type Formula: Naive;

    /// The formula with the parameters of the law.
    #[must_use]
    fn textbook(&self) -> Self::Formula;
}

/// How far answers of the same formula at an ordinary deformation may be from each other.
pub const AGREEMENT: f64 = 1e-12;

/// The relative differences of P and of ∂P/∂F between a law and its textbook's formula.
#[must_use]
pub fn differences<L: Hyperelastic>(law: &L, naive: &impl Naive, deformation: &DeformationGradient) -> [f64; 2] {
    let f = deformation.matrix();
    let tangent = law.first_piola_tangent(deformation).0.components;
    [
        relative_error(naive.first_piola(f).as_slice(), law.first_piola(deformation).0.as_slice()),
        relative_error(naive.first_piola_tangent(f).transpose().as_slice(), tangent.as_flattened()),
    ]
}

/// Whether a law and its textbook's formula say the same of a deformation, within [`AGREEMENT`].
///
/// # Errors
/// They do not.
pub fn agree<L: Hyperelastic>(
    name: &str,
    law: &L,
    naive: &impl Naive,
    deformation: &DeformationGradient,
) -> Result<(), Box<dyn Error>> {
    let [stress, tangent] = differences(law, naive, deformation);
    if stress < AGREEMENT && tangent < AGREEMENT {
        Ok(())
    } else {
        Err(format!("{name}: P differs by {stress:e} from the textbook's, ∂P/∂F by {tangent:e}").into())
    }
}

/// F⁻ᵀ; not a number where there is none.
#[inline]
fn inverse_transposed(f: &Matrix3<f64>) -> Matrix3<f64> {
    f.try_inverse().unwrap_or_else(|| Matrix3::repeat(f64::NAN)).transpose()
}

/// ∂P/∂F from its entries `A_ipkq`, given i, p, k and q.
#[inline]
fn by_entries(entry: impl Fn(usize, usize, usize, usize) -> f64) -> Tangent {
    Tangent::from_fn(|row, column| entry(row / 3, row % 3, column / 3, column % 3))
}
