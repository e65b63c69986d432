//! Deformations that depend on one radial coordinate: their gradients, and how T₁₁ changes along it.

use piola_numerics::Real;
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
    #[inline(always)]
    pub(crate) fn scale(&self, s: T) -> T {
        if self.is_sector { s } else { T::one() }
    }
    /// ξ at s.
    #[inline(always)]
    pub(crate) fn area(&self, s: T) -> T {
        if self.is_sector { T::lit(0.5) * s * s } else { s }
    }
    /// r².
    #[inline(always)]
    pub(crate) fn radicand(&self, s: T) -> T {
        T::lit(2.0) * self.a * self.area(s) + self.offset
    }
    #[inline(always)]
    pub(crate) fn radius(&self, s: T) -> T {
        self.radicand(s).sqrt()
    }
    #[inline(always)]
    pub(crate) fn gradient(&self, s: T) -> Rows<T> {
        let (r, k, zero) = (self.radius(s), self.scale(s), T::zero());
        let [b, c, d, e] = self.block;
        [[self.a * k / r, zero, zero], [zero, r * b / k, r * c], [zero, d / k, e]]
    }
    /// dT_rr/ds = (N_θθ − N_rr) a κ/r², W(25.14–25.16).
    #[inline(always)]
    pub(crate) fn slope(&self, law: &impl ResponseFunctions, s: T) -> Result<T, SolutionsError> {
        let extra = LocalDeformation::of(self.gradient(s)).checked_stress(law)?;
        Ok((extra.components[1] - extra.components[0]) * (self.a * self.scale(s) / self.radicand(s)))
    }
}

impl<T: Packed> Cylindrical<T> {
    /// T_rr at `to` less that at `from`.
    pub(crate) fn rise(&self, law: &impl ResponseFunctions, from: T, to: T) -> Result<T, SolutionsError> {
        let [rise] = integrate::<T, 1, 4>("dT_rr/dR", (from, to), |s| Ok([self.slope(law, s)?]))?;
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
    #[inline(always)]
    pub(crate) fn radicand(&self, s: T) -> T {
        T::lit(self.sign) * s * s * s + self.a
    }
    #[inline(always)]
    pub(crate) fn radius(&self, s: T) -> T {
        self.radicand(s).cbrt()
    }
    #[inline(always)]
    pub(crate) fn gradient(&self, s: T) -> Rows<T> {
        let (zero, sign) = (T::zero(), T::lit(self.sign));
        let stretch = self.radius(s) / s;
        [[sign / (stretch * stretch), zero, zero], [zero, sign * stretch, zero], [zero, zero, stretch]]
    }
    /// dT_rr/ds = 2 (N_θθ − N_rr) (±R²)/r³, W(25.20–25.22).
    #[inline(always)]
    pub(crate) fn slope(&self, law: &impl ResponseFunctions, s: T) -> Result<T, SolutionsError> {
        let extra = LocalDeformation::of(self.gradient(s)).checked_stress(law)?;
        let rate = T::lit(2.0 * self.sign) * s * s / self.radicand(s);
        Ok((extra.components[1] - extra.components[0]) * rate)
    }
}

impl<T: Packed> Spherical<T> {
    /// T_rr at `to` less that at `from`.
    pub(crate) fn rise(&self, law: &impl ResponseFunctions, from: T, to: T) -> Result<T, SolutionsError> {
        let [rise] = integrate::<T, 1, 4>("dT_rr/dR", (from, to), |s| Ok([self.slope(law, s)?]))?;
        Ok(rise)
    }
}
