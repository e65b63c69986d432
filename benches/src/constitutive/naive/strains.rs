//! Laws of a strain: linear, of St. Venant and Kirchhoff, and of Fung.
//!
//! ```text
//! P = F S        ∂P_ip/∂F_kq = δ_ik S_pq + F_ia C_paqb F_kb        C = ∂S/∂E
//! ```
//! A stiffness of any symmetry is a 6×6 matrix over 11, 22, 33, 12, 23, 13, and strain has engineering shears.

use nalgebra::{Matrix3, Matrix6, Vector6};
use piola_solids::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, Fung, LinearElastic, SaintVenantKirchhoff, Stiffness,
};
use piola_tensor::PairSymmetric;

use super::{Naive, Tangent, Textbook, by_entries};

/// The place of a component among 11, 22, 33, 12, 23, 13.
const PLACE: [[usize; 3]; 3] = [[0, 3, 5], [3, 1, 4], [5, 4, 2]];

/// The components of each place.
const PAIRS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)];

/// E = ½ (Fᵀ F − 1).
#[inline]
fn green(f: &Matrix3<f64>) -> Matrix3<f64> {
    (f.transpose() * f - Matrix3::identity()) * 0.5
}

/// ε = ½ (∇u + ∇uᵀ).
#[inline]
fn linear(f: &Matrix3<f64>) -> Matrix3<f64> {
    (f + f.transpose()) * 0.5 - Matrix3::identity()
}

/// Normal strains and engineering shears.
#[inline]
fn engineering(strain: &Matrix3<f64>) -> Vector6<f64> {
    Vector6::from_fn(|place, _| {
        let (i, j) = PAIRS[place];
        strain[(i, j)] + if i == j { 0.0 } else { strain[(j, i)] }
    })
}

/// The symmetric tensor of six components.
#[inline]
fn tensor(components: &Vector6<f64>) -> Matrix3<f64> {
    Matrix3::from_fn(|i, j| components[PLACE[i][j]])
}

/// The components of C.
fn matrix(stiffness: &Stiffness) -> Matrix6<f64> {
    Matrix6::from_fn(|row, column| {
        let ((i, j), (k, l)) = (PAIRS[row], PAIRS[column]);
        stiffness.tensor().entry(i, j, k, l)
    })
}

/// ∂P/∂F of S and ∂S/∂E.
#[inline]
fn tangent(f: &Matrix3<f64>, stress: &Matrix3<f64>, stiffness: &Matrix6<f64>) -> Tangent {
    let one = Matrix3::<f64>::identity();
    by_entries(|i, p, k, q| {
        let mut entry = one[(i, k)] * stress[(p, q)];
        for a in 0..3 {
            for b in 0..3 {
                entry += f[(i, a)] * stiffness[(PLACE[p][a], PLACE[q][b])] * f[(k, b)];
            }
        }
        entry
    })
}

/// S = λ tr E 1 + 2 μ E.
#[inline]
fn hooke(lambda: f64, mu: f64, strain: &Matrix3<f64>) -> Matrix3<f64> {
    Matrix3::identity() * (lambda * strain.trace()) + strain * (2.0 * mu)
}

/// S = λ tr E 1 + 2 μ E.
impl Naive for SaintVenantKirchhoff {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        f * hooke(self.first_lame_parameter(), self.shear_modulus(), &green(f))
    }

    /// `δ_ik S_pq + λ F_ip F_kq + μ (F_iq F_kp + B_ik δ_pq)`.
    #[inline]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let (lambda, mu) = (self.first_lame_parameter(), self.shear_modulus());
        let (one, left) = (Matrix3::<f64>::identity(), f * f.transpose());
        let stress = hooke(lambda, mu, &green(f));
        by_entries(|i, p, k, q| {
            one[(i, k)] * stress[(p, q)]
                + lambda * f[(i, p)] * f[(k, q)]
                + mu * (f[(i, q)] * f[(k, p)] + left[(i, k)] * one[(p, q)])
        })
    }
}

impl Textbook for SaintVenantKirchhoff {
    type Formula = Self;

    fn textbook(&self) -> Self {
        *self
    }
}

/// P = λ tr ε 1 + 2 μ ε.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hooke {
    lambda: f64,
    mu: f64,
}

impl Naive for Hooke {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        hooke(self.lambda, self.mu, &linear(f))
    }

    #[inline]
    fn first_piola_tangent(&self, _f: &Matrix3<f64>) -> Tangent {
        let one = Matrix3::<f64>::identity();
        by_entries(|i, p, k, q| {
            self.lambda * one[(i, p)] * one[(k, q)] + self.mu * (one[(i, k)] * one[(p, q)] + one[(i, q)] * one[(p, k)])
        })
    }
}

impl Textbook for LinearElastic {
    type Formula = Hooke;

    /// λ is not a number where the solid is incompressible, which this law refuses.
    fn textbook(&self) -> Hooke {
        Hooke {
            lambda: self.constants().first_lame_parameter().unwrap_or(f64::NAN),
            mu: self.constants().shear_modulus(),
        }
    }
}

/// P = C : ε.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear {
    stiffness: Matrix6<f64>,
}

impl Naive for Linear {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        tensor(&(self.stiffness * engineering(&linear(f))))
    }

    #[inline]
    fn first_piola_tangent(&self, _f: &Matrix3<f64>) -> Tangent {
        by_entries(|i, p, k, q| self.stiffness[(PLACE[i][p], PLACE[k][q])])
    }
}

impl Textbook for AnisotropicLinear {
    type Formula = Linear;

    fn textbook(&self) -> Linear {
        Linear { stiffness: matrix(self.stiffness()) }
    }
}

/// S = C : E.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kirchhoff {
    stiffness: Matrix6<f64>,
}

impl Naive for Kirchhoff {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        f * tensor(&(self.stiffness * engineering(&green(f))))
    }

    #[inline]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        tangent(f, &tensor(&(self.stiffness * engineering(&green(f)))), &self.stiffness)
    }
}

impl Textbook for AnisotropicSaintVenantKirchhoff {
    type Formula = Kirchhoff;

    fn textbook(&self) -> Kirchhoff {
        Kirchhoff { stiffness: matrix(self.stiffness()) }
    }
}

/// S = c e^Q A : E with Q = E : A : E, ∂S/∂E = c e^Q (A + 2 (A : E) ⊗ (A : E)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Exponential {
    c: f64,
    exponents: Matrix6<f64>,
}

impl Exponential {
    /// A : E and c e^Q.
    #[inline]
    fn image_and_growth(&self, f: &Matrix3<f64>) -> (Vector6<f64>, f64) {
        let strain = engineering(&green(f));
        let image = self.exponents * strain;
        (image, self.c * strain.dot(&image).exp())
    }
}

impl Naive for Exponential {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let (image, growth) = self.image_and_growth(f);
        f * tensor(&image) * growth
    }

    #[inline]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let (image, growth) = self.image_and_growth(f);
        let stiffness = (self.exponents + image * image.transpose() * 2.0) * growth;
        tangent(f, &(tensor(&image) * growth), &stiffness)
    }
}

impl Textbook for Fung {
    type Formula = Exponential;

    fn textbook(&self) -> Exponential {
        Exponential { c: self.modulus(), exponents: matrix(self.exponents()) }
    }
}
