//! Laws of I₁, I₂ and J, the invariants of C and det F.
//!
//! ```text
//! P = 2 W₁ F + 2 W₂ F (I₁ 1 − C) + J W_J F⁻ᵀ
//! ∂P/∂F = Σ Wₐ ∂²Iₐ/∂F² + Σ Wₐᵦ ∂Iₐ/∂F ⊗ ∂Iᵦ/∂F
//! ∂²I₂/∂F_ip ∂F_kq = 2 (I₁ δ_ik δ_pq + 2 F_ip F_kq − δ_ik C_pq − F_iq F_kp − B_ik δ_pq)
//! ∂²J/∂F_ip ∂F_kq = J (F⁻ᵀ_ip F⁻ᵀ_kq − F⁻ᵀ_iq F⁻ᵀ_kp)
//! ```

use nalgebra::Matrix3;
use piola_solids::volumetric::{Logarithmic, SimoTaylor};
use piola_solids::{
    BlatzKo, IncompressibleSolid, MooneyRivlin, NeoHookean, Polynomial, PolynomialTerm, Pressure, isochoric,
};

use super::{Naive, Tangent, Textbook, by_entries, inverse_transposed};

/// An energy W(I₁, I₂, J).
pub trait Energy {
    /// Whether W depends on I₂: without it nobody writes its terms.
    const SECOND: bool;
    /// Whether W₁ or W₂ depend on the deformation.
    const COUPLED: bool;

    /// W₁, W₂ and `W_J`, Pa.
    #[must_use]
    fn slopes(&self, first: f64, second: f64, jacobian: f64) -> [f64; 3];

    /// W₁₁, W₁₂, W₂₂, `W_1J`, `W_2J` and `W_JJ`, Pa.
    #[must_use]
    fn curvatures(&self, first: f64, second: f64, jacobian: f64) -> [f64; 6];
}

/// A law of invariants.
#[derive(Clone, Debug)]
pub struct OfInvariants<E>(
    /// Its energy.
    pub E,
);

/// I₂ = ½ (I₁² − tr C²).
#[inline]
fn second_invariant(right: &Matrix3<f64>) -> f64 {
    0.5 * (right.trace() * right.trace() - (right * right).trace())
}

impl<E: Energy> Naive for OfInvariants<E> {
    #[inline]
    fn first_piola(&self, f: &Matrix3<f64>) -> Matrix3<f64> {
        let right = f.transpose() * f;
        let (first, jacobian) = (right.trace(), f.determinant());
        let second = if E::SECOND { second_invariant(&right) } else { 0.0 };
        let [w1, w2, wj] = self.0.slopes(first, second, jacobian);
        let stress = f * (2.0 * w1) + inverse_transposed(f) * (jacobian * wj);
        if E::SECOND { stress + f * (Matrix3::identity() * first - right) * (2.0 * w2) } else { stress }
    }

    #[inline]
    fn first_piola_tangent(&self, f: &Matrix3<f64>) -> Tangent {
        let one = Matrix3::<f64>::identity();
        let (right, left) = (f.transpose() * f, f * f.transpose());
        let (first, j) = (right.trace(), f.determinant());
        let second = if E::SECOND { second_invariant(&right) } else { 0.0 };
        let [w1, w2, wj] = self.0.slopes(first, second, j);
        let [w11, w12, w22, w1j, w2j, wjj] = self.0.curvatures(first, second, j);
        let g = inverse_transposed(f);
        // ∂I₁/∂F, ∂I₂/∂F and ∂J/∂F.
        let (d1, dj) = (f * 2.0, g * j);
        let d2 = if E::SECOND { (f * first - f * right) * 2.0 } else { Matrix3::zeros() };
        by_entries(|i, p, k, q| {
            let mut entry = 2.0 * w1 * one[(i, k)] * one[(p, q)]
                + wj * j * (g[(i, p)] * g[(k, q)] - g[(i, q)] * g[(k, p)])
                + wjj * dj[(i, p)] * dj[(k, q)];
            if E::SECOND {
                entry += 2.0
                    * w2
                    * (first * one[(i, k)] * one[(p, q)] + 2.0 * f[(i, p)] * f[(k, q)]
                        - one[(i, k)] * right[(p, q)]
                        - f[(i, q)] * f[(k, p)]
                        - left[(i, k)] * one[(p, q)]);
            }
            if E::COUPLED {
                entry += w11 * d1[(i, p)] * d1[(k, q)] + w1j * (d1[(i, p)] * dj[(k, q)] + dj[(i, p)] * d1[(k, q)]);
            }
            if E::COUPLED && E::SECOND {
                entry += w12 * (d1[(i, p)] * d2[(k, q)] + d2[(i, p)] * d1[(k, q)])
                    + w22 * d2[(i, p)] * d2[(k, q)]
                    + w2j * (d2[(i, p)] * dj[(k, q)] + dj[(i, p)] * d2[(k, q)]);
            }
            entry
        })
    }
}

/// W = C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3) + c J² − d ln J.
impl Energy for MooneyRivlin {
    const SECOND: bool = true;
    const COUPLED: bool = false;

    #[inline]
    fn slopes(&self, _first: f64, _second: f64, jacobian: f64) -> [f64; 3] {
        [self.c10(), self.c01(), 2.0 * self.square_coefficient() * jacobian - self.logarithm_coefficient() / jacobian]
    }

    #[inline]
    fn curvatures(&self, _first: f64, _second: f64, jacobian: f64) -> [f64; 6] {
        [
            0.0,
            0.0,
            0.0,
            0.0,
            0.0,
            2.0 * self.square_coefficient() + self.logarithm_coefficient() / (jacobian * jacobian),
        ]
    }
}

/// W = ½ μ (I₁ − 3) − μ ln J + ½ λ ln² J.
impl Energy for NeoHookean<Logarithmic> {
    const SECOND: bool = false;
    const COUPLED: bool = false;

    #[inline]
    fn slopes(&self, _first: f64, _second: f64, jacobian: f64) -> [f64; 3] {
        [
            0.5 * self.shear_modulus(),
            0.0,
            (self.volumetric().bulk_modulus() * jacobian.ln() - self.shear_modulus()) / jacobian,
        ]
    }

    #[inline]
    fn curvatures(&self, _first: f64, _second: f64, jacobian: f64) -> [f64; 6] {
        let volume =
            (self.volumetric().bulk_modulus() * (1.0 - jacobian.ln()) + self.shear_modulus()) / (jacobian * jacobian);
        [0.0, 0.0, 0.0, 0.0, 0.0, volume]
    }
}

/// W = ½ μ (I₁ − 3) − μ ln J + ¼ λ (J² − 1 − 2 ln J).
impl Energy for NeoHookean<SimoTaylor> {
    const SECOND: bool = false;
    const COUPLED: bool = false;

    #[inline]
    fn slopes(&self, _first: f64, _second: f64, jacobian: f64) -> [f64; 3] {
        let lambda = self.volumetric().bulk_modulus();
        [0.5 * self.shear_modulus(), 0.0, 0.5 * lambda * (jacobian - 1.0 / jacobian) - self.shear_modulus() / jacobian]
    }

    #[inline]
    fn curvatures(&self, _first: f64, _second: f64, jacobian: f64) -> [f64; 6] {
        let (lambda, square) = (self.volumetric().bulk_modulus(), jacobian * jacobian);
        [0.0, 0.0, 0.0, 0.0, 0.0, 0.5 * lambda * (1.0 + 1.0 / square) + self.shear_modulus() / square]
    }
}

/// W = ½ μ f [I₁ − 3 + (J^(−2β) − 1)/β] + ½ μ (1 − f) [I₂/J² − 3 + (J^(2β) − 1)/β].
impl Energy for BlatzKo {
    const SECOND: bool = true;
    const COUPLED: bool = true;

    #[inline]
    fn slopes(&self, _first: f64, second: f64, jacobian: f64) -> [f64; 3] {
        let (beta, solid, foam) = (
            self.exponent(),
            self.shear_modulus() * self.solid_fraction(),
            self.shear_modulus() * (1.0 - self.solid_fraction()),
        );
        let square = jacobian * jacobian;
        let volume = foam * (jacobian.powf(2.0 * beta) - second / square) - solid * jacobian.powf(-2.0 * beta);
        [0.5 * solid, 0.5 * foam / square, volume / jacobian]
    }

    #[inline]
    fn curvatures(&self, _first: f64, second: f64, jacobian: f64) -> [f64; 6] {
        let (beta, solid, foam) = (
            self.exponent(),
            self.shear_modulus() * self.solid_fraction(),
            self.shear_modulus() * (1.0 - self.solid_fraction()),
        );
        let square = jacobian * jacobian;
        let volume = solid * (2.0 * beta + 1.0) * jacobian.powf(-2.0 * beta)
            + foam * (3.0 * second / square + (2.0 * beta - 1.0) * jacobian.powf(2.0 * beta));
        [0.0, 0.0, 0.0, 0.0, -foam / (square * jacobian), volume / square]
    }
}

/// W = Σ C (I₁ − 3)^r (I₂ − 3)^s (I₃ − 1)^t.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    terms: Vec<PolynomialTerm>,
}

/// xⁿ, n xⁿ⁻¹ and n (n − 1) xⁿ⁻².
#[inline]
pub(super) fn power(x: f64, n: u8) -> [f64; 3] {
    let (degree, exponent) = (f64::from(n), i32::from(n));
    let slope = if n < 1 { 0.0 } else { degree * x.powi(exponent - 1) };
    let curvature = if n < 2 { 0.0 } else { degree * (degree - 1.0) * x.powi(exponent - 2) };
    [x.powi(exponent), slope, curvature]
}

impl Energy for Series {
    const SECOND: bool = true;
    const COUPLED: bool = true;

    #[inline]
    fn slopes(&self, first: f64, second: f64, jacobian: f64) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for term in &self.terms {
            let [x, dx, _] = power(first - 3.0, term.first);
            let [y, dy, _] = power(second - 3.0, term.second);
            let [z, dz, _] = power(jacobian * jacobian - 1.0, term.third);
            sums[0] += term.coefficient * dx * y * z;
            sums[1] += term.coefficient * x * dy * z;
            sums[2] += term.coefficient * x * y * dz * 2.0 * jacobian;
        }
        sums
    }

    #[inline]
    fn curvatures(&self, first: f64, second: f64, jacobian: f64) -> [f64; 6] {
        let mut sums = [0.0; 6];
        for term in &self.terms {
            let [x, dx, ddx] = power(first - 3.0, term.first);
            let [y, dy, ddy] = power(second - 3.0, term.second);
            let [z, dz, ddz] = power(jacobian * jacobian - 1.0, term.third);
            sums[0] += term.coefficient * ddx * y * z;
            sums[1] += term.coefficient * dx * dy * z;
            sums[2] += term.coefficient * x * ddy * z;
            sums[3] += term.coefficient * dx * y * dz * 2.0 * jacobian;
            sums[4] += term.coefficient * x * dy * dz * 2.0 * jacobian;
            sums[5] += term.coefficient * x * y * (4.0 * jacobian * jacobian * ddz + 2.0 * dz);
        }
        sums
    }
}

/// W = C₁₀ x + C₀₁ y − p J with x = I₁ − 3 and y = I₂/J² − 3, or with x less 2 ln J and y more 2 ln J where the pressure is
/// that beyond a body at rest.
impl Energy for IncompressibleSolid<isochoric::MooneyRivlin> {
    const SECOND: bool = true;
    const COUPLED: bool = true;

    #[inline]
    fn slopes(&self, _first: f64, second: f64, jacobian: f64) -> [f64; 3] {
        let (c10, c01) = (self.isochoric.c10(), self.isochoric.c01());
        let (pressure, rest) = pressures(self);
        let square = jacobian * jacobian;
        [c10, c01 / square, -rest / jacobian - 2.0 * c01 * second / (square * jacobian) - pressure]
    }

    #[inline]
    fn curvatures(&self, _first: f64, second: f64, jacobian: f64) -> [f64; 6] {
        let c01 = self.isochoric.c01();
        let (square, rest) = (jacobian * jacobian, pressures(self).1);
        let volume = (rest + 6.0 * c01 * second / square) / square;
        [0.0, 0.0, 0.0, 0.0, -2.0 * c01 / (square * jacobian), volume]
    }
}

/// The given pressure, and 2 (C₁₀ − C₀₁) of a body at rest where that comes beside it.
#[inline]
fn pressures(law: &IncompressibleSolid<isochoric::MooneyRivlin>) -> (f64, f64) {
    match law.pressure {
        Pressure::Whole(p) => (p, 0.0),
        Pressure::Excess(q) => (q, 2.0 * (law.isochoric.c10() - law.isochoric.c01())),
    }
}

impl Textbook for Polynomial {
    type Formula = OfInvariants<Series>;

    fn textbook(&self) -> Self::Formula {
        OfInvariants(Series { terms: self.terms() })
    }
}

/// Laws whose parameters are at hand.
macro_rules! textbook {
    ($($law:ty),+ $(,)?) => { $(
        impl Textbook for $law {
            type Formula = OfInvariants<Self>;

            fn textbook(&self) -> Self::Formula {
                OfInvariants(*self)
            }
        }
    )+ };
}
textbook!(
    MooneyRivlin,
    NeoHookean<Logarithmic>,
    NeoHookean<SimoTaylor>,
    BlatzKo,
    IncompressibleSolid<isochoric::MooneyRivlin>,
);
