//! Laws with families of fibres along unit vectors a of the reference.

use nalgebra::{Matrix3, Vector3};
use piola_solids::{Fibre, HolzapfelGasserOgden, ReinforcedNeoHookean};

use super::{Naive, Tangent, Textbook, by_entries, inverse_transposed};

/// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)² + ½ k (I₄ − 1)², I₄ = a · C a.
///
/// ```text
/// P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ + 2 k (I₄ − 1) F a ⊗ a
/// ```
impl Naive for ReinforcedNeoHookean {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let a = Vector3::from(self.fibre().direction());
        let (g, logarithm, along) = (inverse_transposed(f), f.determinant().ln(), f * a);
        let excess = along.norm_squared() - 1.0;
        (f - g) * self.shear_modulus()
            + g * (self.first_lame_parameter() * logarithm)
            + along * a.transpose() * (2.0 * self.fibre_modulus() * excess)
    }

    #[inline]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let (one, a) = (Matrix3::<f64>::identity(), Vector3::from(self.fibre().direction()));
        let (g, logarithm, along) = (inverse_transposed(f), f.determinant().ln(), f * a);
        let (lambda, mu, k4) = (self.first_lame_parameter(), self.shear_modulus(), self.fibre_modulus());
        let excess = along.norm_squared() - 1.0;
        by_entries(|i, p, k, q| {
            mu * one[(i, k)] * one[(p, q)]
                + lambda * g[(i, p)] * g[(k, q)]
                + (mu - lambda * logarithm) * g[(i, q)] * g[(k, p)]
                + 2.0 * k4 * excess * one[(i, k)] * a[p] * a[q]
                + 4.0 * k4 * along[i] * a[p] * along[k] * a[q]
        })
    }
}

impl Textbook for ReinforcedNeoHookean {
    type Formula = Self;

    fn textbook(&self) -> Self {
        *self
    }
}

/// W = ½ μ (Ī₁ − 3) + ½ κ (J − 1)² + k₁/(2 k₂) Σₐ (e^(k₂ ⟨Eₐ⟩²) − 1).
///
/// ```text
/// Eₐ = J^(−2/3) C : H − 1        H = d 1 + (1 − 3 d) a ⊗ a
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Artery {
    law: HolzapfelGasserOgden,
    structures: [Matrix3<f64>; 2],
}

impl Textbook for HolzapfelGasserOgden {
    type Formula = Artery;

    fn textbook(&self) -> Artery {
        let d = self.dispersion();
        let structure = |fibre: Fibre| {
            let a = Vector3::from(fibre.direction());
            Matrix3::identity() * d + a * a.transpose() * (1.0 - 3.0 * d)
        };
        Artery { law: *self, structures: self.fibres().map(structure) }
    }
}

/// J^(−2/3) C : H, and what its derivatives are made of.
struct Invariant {
    value: f64,
    /// ∂/∂F: J^(−2/3) (2 F H − ⅔ (C : H) F⁻ᵀ).
    slope: Matrix3<f64>,
    structure: Matrix3<f64>,
    scale: f64,
}

impl Invariant {
    /// Of F, F⁻ᵀ, J^(−2/3), H and F H.
    #[inline]
    fn of(f: &Matrix3<f64>, g: &Matrix3<f64>, scale: f64, structure: &Matrix3<f64>, product: &Matrix3<f64>) -> Self {
        let value = scale * f.dot(product);
        Self { value, slope: product * (2.0 * scale) - g * (2.0 / 3.0 * value), structure: *structure, scale }
    }

    /// An entry of the second derivative, −⅔ (∂/∂F ⊗ F⁻ᵀ + F⁻ᵀ ⊗ ∂/∂F) and the rest.
    #[inline]
    fn curvature(&self, g: &Matrix3<f64>, i: usize, p: usize, k: usize, q: usize) -> f64 {
        let own = if i == k { 2.0 * self.scale * self.structure[(p, q)] } else { 0.0 };
        own - 2.0 / 3.0 * (self.slope[(i, p)] * g[(k, q)] + g[(i, p)] * self.slope[(k, q)])
            - 4.0 / 9.0 * self.value * g[(i, p)] * g[(k, q)]
            + 2.0 / 3.0 * self.value * g[(i, q)] * g[(k, p)]
    }
}

impl Artery {
    /// Those of the matrix and of both families, of F, F⁻ᵀ and J.
    #[inline]
    fn invariants(&self, f: &Matrix3<f64>, g: &Matrix3<f64>, jacobian: f64) -> (Invariant, [Invariant; 2]) {
        let scale = jacobian.powf(-2.0 / 3.0);
        let families = self.structures.map(|structure| Invariant::of(f, g, scale, &structure, &(f * structure)));
        (Invariant::of(f, g, scale, &Matrix3::identity(), f), families)
    }

    /// ∂W/∂E and ∂²W/∂E² of a family, Pa: k₁ E e^(k₂ E²) and k₁ (1 + 2 k₂ E²) e^(k₂ E²) where E is positive.
    #[inline]
    fn tension(&self, family: &Invariant) -> [f64; 2] {
        let (k1, k2, strain) = (self.law.fibre_modulus(), self.law.fibre_exponent(), family.value - 1.0);
        if strain <= 0.0 {
            return [0.0; 2];
        }
        let growth = k1 * (k2 * strain * strain).exp();
        [growth * strain, growth * (1.0 + 2.0 * k2 * strain * strain)]
    }
}

impl Naive for Artery {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let (g, j) = (inverse_transposed(f), f.determinant());
        let (matrix, families) = self.invariants(f, &g, j);
        let mut stress =
            matrix.slope * (0.5 * self.law.shear_modulus()) + g * (self.law.bulk_modulus() * (j - 1.0) * j);
        for family in &families {
            stress += family.slope * self.tension(family)[0];
        }
        stress
    }

    #[inline]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let (g, j) = (inverse_transposed(f), f.determinant());
        let (matrix, families) = self.invariants(f, &g, j);
        let (mu, kappa) = (self.law.shear_modulus(), self.law.bulk_modulus());
        let tensions = families.each_ref().map(|family| self.tension(family));
        by_entries(|i, p, k, q| {
            let mut entry = 0.5 * mu * matrix.curvature(&g, i, p, k, q)
                + kappa * (2.0 * j - 1.0) * j * g[(i, p)] * g[(k, q)]
                - kappa * (j - 1.0) * j * g[(i, q)] * g[(k, p)];
            for (family, [slope, curvature]) in families.iter().zip(tensions) {
                entry +=
                    curvature * family.slope[(i, p)] * family.slope[(k, q)] + slope * family.curvature(&g, i, p, k, q);
            }
            entry
        })
    }
}
