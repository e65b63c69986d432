//! Laws of the principal stretches, from the eigenvalues λₐ² and eigenvectors Nₐ of C.
//!
//! ```text
//! P = Σ Pₐ nₐ ⊗ Nₐ        Pₐ = βₐ/λₐ        nₐ = F Nₐ/λₐ
//! ∂P/∂F = Σ ∂Pₐ/∂λᵦ (nₐ ⊗ Nₐ) ⊗ (nᵦ ⊗ Nᵦ)
//!       + Σ (βₐ − βᵦ)/(λₐ² − λᵦ²) (nₐ ⊗ Nᵦ) ⊗ (nₐ ⊗ Nᵦ)                        a ≠ b
//!       + Σ (λᵦ Pₐ − λₐ Pᵦ)/(λₐ² − λᵦ²) (nₐ ⊗ Nᵦ) ⊗ (nᵦ ⊗ Nₐ)                  a ≠ b
//! ```
//! βₐ are the principal Kirchhoff stresses. Of stretches that are nearly equal the quotients are taken to be their limits.
//!
//! Source: R. W. Ogden, Non-Linear Elastic Deformations, 1984, section 6.1.

use nalgebra::{Matrix3, SVector, Vector3};
use piola_solids::{Hencky, IncompressibleOgden, IsochoricOgden, Ogden, OgdenTerm, Pressure, Pressurised};

use super::{Naive, Tangent, Textbook};

/// Stretches whose relative difference is below this are taken to be equal.
const EQUAL: f64 = 1e-6;

/// An energy of the principal stretches.
pub trait Energy {
    /// βₐ = λₐ ∂W/∂λₐ, Pa.
    #[must_use]
    fn kirchhoff(&self, stretches: &Vector3<f64>) -> Vector3<f64>;

    /// ∂βₐ/∂ ln λᵦ, Pa.
    #[must_use]
    fn stiffness(&self, stretches: &Vector3<f64>) -> Matrix3<f64>;
}

/// A law of stretches.
#[derive(Clone, Copy, Debug)]
pub struct OfStretches<E>(
    /// Its energy.
    pub E,
);

/// λₐ, nₐ and Nₐ.
#[inline]
fn principal(f: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>, Matrix3<f64>) {
    let eigen = (f.transpose() * f).symmetric_eigen();
    let stretches = eigen.eigenvalues.map(f64::sqrt);
    let mut directions = f * eigen.eigenvectors;
    for a in 0..3 {
        directions.column_mut(a).unscale_mut(stretches[a]);
    }
    (stretches, directions, eigen.eigenvectors)
}

/// nₐ ⊗ Nᵦ, by rows.
#[inline]
fn dyad(n: &Matrix3<f64>, a: usize, reference: &Matrix3<f64>, b: usize) -> SVector<f64, 9> {
    SVector::from_fn(|row, _| n[(row / 3, a)] * reference[(row % 3, b)])
}

impl<E: Energy> Naive for OfStretches<E> {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let (stretches, spatial, reference) = principal(f);
        let stress = self.0.kirchhoff(&stretches).component_div(&stretches);
        spatial * Matrix3::from_diagonal(&stress) * reference.transpose()
    }

    #[inline]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let (l, spatial, reference) = principal(f);
        let beta = self.0.kirchhoff(&l);
        let (stress, stiffness) = (beta.component_div(&l), self.0.stiffness(&l));
        // ∂Pₐ/∂λᵦ.
        let rate = Matrix3::from_fn(|a, b| (stiffness[(a, b)] - if a == b { beta[a] } else { 0.0 }) / (l[a] * l[b]));
        let mut tangent = Tangent::zeros();
        for a in 0..3 {
            for b in 0..3 {
                let (aa, bb) = (dyad(&spatial, a, &reference, a), dyad(&spatial, b, &reference, b));
                tangent.ger(rate[(a, b)], &aa, &bb, 1.0);
                if a == b {
                    continue;
                }
                let (own, mixed) = if (l[a] - l[b]).abs() < EQUAL * l[a] {
                    let difference = rate[(a, a)] - rate[(a, b)];
                    (0.5 * (difference + stress[a] / l[a]), 0.5 * (difference - stress[a] / l[a]))
                } else {
                    let squares = l[a] * l[a] - l[b] * l[b];
                    ((beta[a] - beta[b]) / squares, (l[b] * stress[a] - l[a] * stress[b]) / squares)
                };
                let (ab, ba) = (dyad(&spatial, a, &reference, b), dyad(&spatial, b, &reference, a));
                tangent.ger(own, &ab, &ab, 1.0);
                tangent.ger(mixed, &ab, &ba, 1.0);
            }
        }
        tangent
    }
}

/// Σ μₚ λ^αₚ.
#[inline]
fn series(terms: &[OgdenTerm], stretch: f64) -> f64 {
    terms.iter().map(|term| term.modulus * stretch.powf(term.exponent)).sum()
}

/// Σ μₚ αₚ λ^αₚ.
#[inline]
fn series_rate(terms: &[OgdenTerm], stretch: f64) -> f64 {
    terms.iter().map(|term| term.modulus * term.exponent * stretch.powf(term.exponent)).sum()
}

/// Σ μₚ.
#[inline]
fn moduli(terms: &[OgdenTerm]) -> f64 {
    terms.iter().map(|term| term.modulus).sum()
}

/// β = Σ μₚ (λ^αₚ − 1) + λ ln J.
impl Energy for Ogden {
    #[inline]
    fn kirchhoff(&self, stretches: &Vector3<f64>) -> Vector3<f64> {
        let volume = self.first_lame_parameter() * stretches.product().ln() - moduli(self.terms());
        stretches.map(|stretch| series(self.terms(), stretch) + volume)
    }

    #[inline]
    fn stiffness(&self, stretches: &Vector3<f64>) -> Matrix3<f64> {
        Matrix3::from_diagonal(&stretches.map(|stretch| series_rate(self.terms(), stretch)))
            .add_scalar(self.first_lame_parameter())
    }
}

/// β = dev Σ μₚ λ̄^αₚ + κ J (J − 1), λ̄ = J^(−1/3) λ.
impl Energy for IsochoricOgden {
    #[inline]
    fn kirchhoff(&self, stretches: &Vector3<f64>) -> Vector3<f64> {
        let j = stretches.product();
        let part = (stretches / j.cbrt()).map(|stretch| series(self.terms(), stretch));
        part.add_scalar(self.bulk_modulus() * j * (j - 1.0) - part.mean())
    }

    #[inline]
    fn stiffness(&self, stretches: &Vector3<f64>) -> Matrix3<f64> {
        let j = stretches.product();
        let rate = (stretches / j.cbrt()).map(|stretch| series_rate(self.terms(), stretch));
        let volume = self.bulk_modulus() * j * (2.0 * j - 1.0);
        Matrix3::from_fn(|a, b| {
            let own = if a == b { rate[a] } else { 0.0 };
            own - (rate[a] + rate[b] - rate.mean()) / 3.0 + volume
        })
    }
}

/// β = 2 μ ln λ + λ ln J.
impl Energy for Hencky {
    #[inline]
    fn kirchhoff(&self, stretches: &Vector3<f64>) -> Vector3<f64> {
        let strain = stretches.map(f64::ln);
        (strain * (2.0 * self.shear_modulus())).add_scalar(self.first_lame_parameter() * strain.sum())
    }

    #[inline]
    fn stiffness(&self, _stretches: &Vector3<f64>) -> Matrix3<f64> {
        (Matrix3::identity() * (2.0 * self.shear_modulus())).add_scalar(self.first_lame_parameter())
    }
}

/// β = Σ μₚ λ^αₚ − p J, or Σ μₚ (λ^αₚ − 1) − q J.
impl Energy for IncompressibleOgden {
    #[inline]
    fn kirchhoff(&self, stretches: &Vector3<f64>) -> Vector3<f64> {
        let (rest, pressure) = match self.pressure() {
            Pressure::Whole(p) => (0.0, p),
            Pressure::Excess(q) => (moduli(self.terms()), q),
        };
        let volume = rest + pressure * stretches.product();
        stretches.map(|stretch| series(self.terms(), stretch) - volume)
    }

    #[inline]
    fn stiffness(&self, stretches: &Vector3<f64>) -> Matrix3<f64> {
        let (Pressure::Whole(pressure) | Pressure::Excess(pressure)) = self.pressure();
        Matrix3::from_diagonal(&stretches.map(|stretch| series_rate(self.terms(), stretch)))
            .add_scalar(-pressure * stretches.product())
    }
}

/// β of the law, less p J.
impl<L: Energy> Energy for Pressurised<L> {
    #[inline]
    fn kirchhoff(&self, stretches: &Vector3<f64>) -> Vector3<f64> {
        self.law().kirchhoff(stretches).add_scalar(-self.pressure() * stretches.product())
    }

    #[inline]
    fn stiffness(&self, stretches: &Vector3<f64>) -> Matrix3<f64> {
        self.law().stiffness(stretches).add_scalar(-self.pressure() * stretches.product())
    }
}

/// Laws whose parameters are at hand.
macro_rules! textbook {
    ($($law:ty),+ $(,)?) => { $(
        impl Textbook for $law {
            type Formula = OfStretches<Self>;

            fn textbook(&self) -> Self::Formula {
                OfStretches(*self)
            }
        }
    )+ };
}
textbook!(Ogden, IsochoricOgden, Hencky, IncompressibleOgden, Pressurised<Hencky>);
