//! Deformations that depend on one radial coordinate: their gradients, and how T₁₁ changes along it.

use piola_numerics::Real;
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::Rows;

use crate::integral::{Packed, integrate};
use crate::{LocalDeformation, ResponseFunctions, SolutionsError};

/// Families 1 and 3 as one: r² = 2 a ξ + offset, with θ and z linear in η and Z.
///
/// ```text
/// block:   ξ = X,  η = Y,  κ = 1        sector:   ξ = ½ R²,  η = Θ,  κ = R        dξ = κ ds
/// θ = b η + c Z      z = d η + e Z      a (b e − c d) = 1
/// F = [a κ/r  0  0;  0  r b/κ  r c;  0  d/κ  e]
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cylindrical<T> {
    pub(crate) a: T,
    pub(crate) offset: T,
    /// b, c, d, e.
    pub(crate) block: [T; 4],
    /// Whether the reference is a sector; otherwise it is a block.
    pub(crate) is_sector: bool,
}

impl<T: Real> Cylindrical<T> {
    /// κ at s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn scale(&self, s: T) -> T {
        if self.is_sector { s } else { T::one() }
    }
    /// ξ at s.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn area(&self, s: T) -> T {
        if self.is_sector { T::lit(0.5) * s * s } else { s }
    }
    /// r².
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn radicand(&self, s: T) -> T {
        T::lit(2.0) * self.a * self.area(s) + self.offset
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn radius(&self, s: T) -> T {
        self.radicand(s).sqrt()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn gradient(&self, s: T) -> Rows<T> {
        let (r, k, zero) = (self.radius(s), self.scale(s), T::zero());
        let [b, c, d, e] = self.block;
        [[self.a * k / r, zero, zero], [zero, r * b / k, r * c], [zero, d / k, e]]
    }
    /// N, `N_θθ − N_rr` and the moduli of its terms, at s.
    ///
    /// ```text
    /// B_θθ − B_rr = (κ/r)² ((b q)² − a²) + (r c)²        B⁻¹_θθ − B⁻¹_rr = (κ/r)² ((a e)² − (q/a)²) + (a d/r)²
    /// q = (r/κ)²,  of a sector a + offset/κ²: for b = 1 nothing cancels near the reference
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn stresses(
        &self,
        law: &impl ResponseFunctions,
        s: T,
    ) -> Result<(Symmetric<T>, T, f64), SolutionsError> {
        let local = LocalDeformation::of(self.gradient(s));
        let [direct, inverse] = local.checked_response(law)?;
        let Self { a, offset, block: [b, c, d, e], .. } = *self;
        let (k, square) = (self.scale(s), self.radicand(s));
        // b q − a and a e − q/a.
        let (q, across, along) = if self.is_sector {
            let more = offset / (k * k);
            (a + more, (b - T::one()) * a + b * more, (a * e - T::one()) - more / a)
        } else {
            (square, b * square - a, a * e - square / a)
        };
        let ratio = k * k / square;
        let left = ratio * across * (b * q + a) + square * c * c;
        let right = ratio * along * (a * e + q / a) + a * a * d * d / square;
        let extra = local.left_cauchy_green * direct + local.inverse * inverse;
        let terms = moduli(&extra, (direct * left).primal(0), (inverse * right).primal(0));
        Ok((extra, direct * left + inverse * right, terms))
    }
    /// `dT_rr/ds = (N_θθ − N_rr) a κ/r²`, W(25.14–25.16), with the moduli of its terms.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn slope(&self, law: &impl ResponseFunctions, s: T) -> Result<([T; 1], f64), SolutionsError> {
        let (_, hoop, terms) = self.stresses(law, s)?;
        let rate = self.a * self.scale(s) / self.radicand(s);
        Ok(([hoop * rate], terms * rate.primal(0).abs()))
    }
}

/// The moduli of the terms of `N_θθ` − `N_rr`.
#[cfg_attr(not(debug_assertions), inline(always))]
fn moduli<T: Real>(extra: &Symmetric<T>, left: f64, right: f64) -> f64 {
    // Rounding of the gradient is a share of N where the closed forms of the differences are not exact.
    let size = extra.components[0].primal(0).abs() + extra.components[1].primal(0).abs();
    left.abs() + right.abs() + 0.125 * size
}

impl<T: Packed> Cylindrical<T> {
    /// `T_rr` at `to` less that at `from`.
    pub(crate) fn rise(&self, law: &impl ResponseFunctions, from: T, to: T) -> Result<T, SolutionsError> {
        let [rise] = integrate::<T, 1, 4>("dT_rr/dR", (from, to), |s| self.slope(law, s))?;
        Ok(rise)
    }
}

/// Family 4: r³ = ±R³ + a.
///
/// ```text
/// F = diag(±R²/r², ±r/R, r/R)
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spherical<T> {
    /// +1, or −1 of a sphere turned inside out.
    pub(crate) sign: f64,
    pub(crate) a: T,
}

impl<T: Real> Spherical<T> {
    /// r³.
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn radicand(&self, s: T) -> T {
        T::lit(self.sign) * s * s * s + self.a
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn radius(&self, s: T) -> T {
        self.radicand(s).cbrt()
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn gradient(&self, s: T) -> Rows<T> {
        let (zero, sign) = (T::zero(), T::lit(self.sign));
        let stretch = self.radius(s) / s;
        [[sign / (stretch * stretch), zero, zero], [zero, sign * stretch, zero], [zero, zero, stretch]]
    }
    /// `dT_rr/ds = 2 (N_θθ − N_rr) (±R²)/r³`, W(25.20–25.22), with the moduli of its terms.
    ///
    /// ```text
    /// λ = r/R:   B_θθ − B_rr = (λ⁶ − 1)/λ⁴      B⁻¹_θθ − B⁻¹_rr = −(λ⁶ − 1)/λ²      λ³ ∓ 1 = a/R³
    /// ```
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub(crate) fn slope(&self, law: &impl ResponseFunctions, s: T) -> Result<([T; 1], f64), SolutionsError> {
        let [direct, inverse] = LocalDeformation::of(self.gradient(s)).checked_response(law)?;
        let cube = self.radicand(s);
        let volume = s * s * s;
        let ratio = cube / volume;
        let square = (self.radius(s) / s).powi(2);
        let power = (self.a / volume) * (ratio + T::lit(self.sign));
        let left = direct * power / (square * square);
        let right = inverse * power / square;
        let rate = T::lit(2.0 * self.sign) * s * s / cube;
        let terms = (left.primal(0).abs() + right.primal(0).abs()) * rate.primal(0).abs();
        Ok(([(left - right) * rate], terms))
    }
}

impl<T: Packed> Spherical<T> {
    /// `T_rr` at `to` less that at `from`.
    pub(crate) fn rise(&self, law: &impl ResponseFunctions, from: T, to: T) -> Result<T, SolutionsError> {
        let [rise] = integrate::<T, 1, 4>("dT_rr/dR", (from, to), |s| self.slope(law, s))?;
        Ok(rise)
    }
}
