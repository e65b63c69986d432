//! Laws of a change of shape and a change of volume, by the chain rule from those of I₁, I₂ and J.
//!
//! ```text
//! W = W̄(Ī₁, Ī₂) + ½ κ (J − 1)²        Ī₁ = J^(−2/3) I₁        Ī₂ = J^(−4/3) I₂
//! ```

use piola_solids::Compressible;
use piola_solids::isochoric::{ArrudaBoyce, Gent, MooneyRivlin, NeoHookean, Rivlin, Yeoh};
use piola_solids::volumetric::Quadratic;

use super::Textbook;
use super::invariants::{Energy, OfInvariants, power};

/// An energy W̄(Ī₁, Ī₂).
pub trait Shape {
    /// Whether W̄ depends on Ī₂.
    const SECOND: bool;

    /// ∂W̄/∂Ī₁ and ∂W̄/∂Ī₂, Pa.
    #[must_use]
    fn slopes(&self, first: f64, second: f64) -> [f64; 2];

    /// ∂²W̄/∂Ī₁², ∂²W̄/∂Ī₁∂Ī₂ and ∂²W̄/∂Ī₂², Pa.
    #[must_use]
    fn curvatures(&self, first: f64, second: f64) -> [f64; 3];
}

impl<I: Shape> Energy for Compressible<I, Quadratic> {
    const SECOND: bool = I::SECOND;
    const COUPLED: bool = true;

    #[inline]
    fn slopes(&self, first: f64, second: f64, jacobian: f64) -> [f64; 3] {
        let g = jacobian.powf(-2.0 / 3.0);
        let (x, y) = (g * first, g * g * second);
        let [a, b] = self.isochoric().slopes(x, y);
        let volume = self.volumetric().bulk_modulus() * (jacobian - 1.0);
        [a * g, b * g * g, volume - (2.0 * a * x + 4.0 * b * y) / (3.0 * jacobian)]
    }

    #[inline]
    fn curvatures(&self, first: f64, second: f64, jacobian: f64) -> [f64; 6] {
        let g = jacobian.powf(-2.0 / 3.0);
        let (x, y) = (g * first, g * g * second);
        let [a, b] = self.isochoric().slopes(x, y);
        let [aa, ab, bb] = self.isochoric().curvatures(x, y);
        // ∂Ī₁/∂J and ∂Ī₂/∂J.
        let (xj, yj) = (-2.0 * x / (3.0 * jacobian), -4.0 * y / (3.0 * jacobian));
        [
            aa * g * g,
            ab * g * g * g,
            bb * g * g * g * g,
            g * (aa * xj + ab * yj - 2.0 * a / (3.0 * jacobian)),
            g * g * (ab * xj + bb * yj - 4.0 * b / (3.0 * jacobian)),
            aa * xj * xj
                + 2.0 * ab * xj * yj
                + bb * yj * yj
                + (10.0 * a * x + 28.0 * b * y) / (9.0 * jacobian * jacobian)
                + self.volumetric().bulk_modulus(),
        ]
    }
}

/// W̄ = ½ μ (Ī₁ − 3).
impl Shape for NeoHookean {
    const SECOND: bool = false;

    #[inline]
    fn slopes(&self, _first: f64, _second: f64) -> [f64; 2] {
        [0.5 * self.shear_modulus(), 0.0]
    }

    #[inline]
    fn curvatures(&self, _first: f64, _second: f64) -> [f64; 3] {
        [0.0; 3]
    }
}

/// W̄ = C₁₀ (Ī₁ − 3) + C₀₁ (Ī₂ − 3).
impl Shape for MooneyRivlin {
    const SECOND: bool = true;

    #[inline]
    fn slopes(&self, _first: f64, _second: f64) -> [f64; 2] {
        [self.c10(), self.c01()]
    }

    #[inline]
    fn curvatures(&self, _first: f64, _second: f64) -> [f64; 3] {
        [0.0; 3]
    }
}

/// W̄ = C₁ x + C₂ x² + C₃ x³, x = Ī₁ − 3.
impl Shape for Yeoh {
    const SECOND: bool = false;

    #[inline]
    fn slopes(&self, first: f64, _second: f64) -> [f64; 2] {
        let x = first - 3.0;
        [self.c1() + 2.0 * self.c2() * x + 3.0 * self.c3() * x * x, 0.0]
    }

    #[inline]
    fn curvatures(&self, first: f64, _second: f64) -> [f64; 3] {
        [2.0 * self.c2() + 6.0 * self.c3() * (first - 3.0), 0.0, 0.0]
    }
}

/// W̄ = −½ μ Jₘ ln(1 − (Ī₁ − 3)/Jₘ).
impl Shape for Gent {
    const SECOND: bool = false;

    #[inline]
    fn slopes(&self, first: f64, _second: f64) -> [f64; 2] {
        [0.5 * self.shear_modulus() * self.limit() / (self.limit() - (first - 3.0)), 0.0]
    }

    #[inline]
    fn curvatures(&self, first: f64, _second: f64) -> [f64; 3] {
        let left = self.limit() - (first - 3.0);
        [0.5 * self.shear_modulus() * self.limit() / (left * left), 0.0, 0.0]
    }
}

/// β with coth β − 1/β = λ: Padé's approximation of Cohen (Rheol. Acta 30 (1991) 270–273) and Newton's iteration.
#[inline]
fn inverse_langevin(stretch: f64) -> f64 {
    let square = stretch * stretch;
    let mut beta = stretch * (3.0 - square) / (1.0 - square);
    for _ in 0..8 {
        let step = (1.0 / beta.tanh() - 1.0 / beta - stretch) / langevin_slope(beta);
        beta -= step;
        // Beyond, nothing is left but rounding: the iteration is of second order.
        if step.abs() < 1e-9 * beta {
            break;
        }
    }
    beta
}

/// ℒ′(β) = 1/β² − 1/sinh² β.
#[inline]
fn langevin_slope(beta: f64) -> f64 {
    let sinh = beta.sinh();
    1.0 / (beta * beta) - 1.0 / (sinh * sinh)
}

/// ∂W̄/∂Ī₁ = n β/(6 λ), λ = √(Ī₁/(3 N)).
impl Shape for ArrudaBoyce {
    const SECOND: bool = false;

    #[inline]
    fn slopes(&self, first: f64, _second: f64) -> [f64; 2] {
        let stretch = (first / (3.0 * self.links())).sqrt();
        [self.rubbery_modulus() * inverse_langevin(stretch) / (6.0 * stretch), 0.0]
    }

    /// n/(36 N λ²) (1/ℒ′(β) − β/λ).
    #[inline]
    fn curvatures(&self, first: f64, _second: f64) -> [f64; 3] {
        let stretch = (first / (3.0 * self.links())).sqrt();
        let beta = inverse_langevin(stretch);
        let rate = 1.0 / langevin_slope(beta) - beta / stretch;
        [self.rubbery_modulus() * rate / (36.0 * self.links() * stretch * stretch), 0.0, 0.0]
    }
}

/// W̄ = Σ Cᵢⱼ (Ī₁ − 3)ⁱ (Ī₂ − 3)ʲ.
impl Shape for Rivlin {
    const SECOND: bool = true;

    #[inline]
    fn slopes(&self, first: f64, second: f64) -> [f64; 2] {
        let mut sums = [0.0; 2];
        for term in self.terms() {
            let ([x, dx, _], [y, dy, _]) = (power(first - 3.0, term.first), power(second - 3.0, term.second));
            sums[0] += term.coefficient * dx * y;
            sums[1] += term.coefficient * x * dy;
        }
        sums
    }

    #[inline]
    fn curvatures(&self, first: f64, second: f64) -> [f64; 3] {
        let mut sums = [0.0; 3];
        for term in self.terms() {
            let ([x, dx, ddx], [y, dy, ddy]) = (power(first - 3.0, term.first), power(second - 3.0, term.second));
            sums[0] += term.coefficient * ddx * y;
            sums[1] += term.coefficient * dx * dy;
            sums[2] += term.coefficient * x * ddy;
        }
        sums
    }
}

impl<I: Shape + Clone> Textbook for Compressible<I, Quadratic> {
    type Formula = OfInvariants<Self>;

    fn textbook(&self) -> Self::Formula {
        OfInvariants(self.clone())
    }
}
