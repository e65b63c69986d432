//! Family 3: a tube or a sector of it, inflated, stretched, twisted, sheared or everted.

use piola_fields::Cylindrical;
use piola_numerics::Real;
use piola_tensor::internal::rows::Rows;

use super::profile;
use super::{Family, check_constraint, isochoric_factor};
use crate::error::check_finite;
use crate::{ResponseFunctions, SolutionsError};

/// Family 3: inflation or eversion, bending, torsion, extension and shearing of a tube or of a sector of one.
///
/// ```text
/// r = √(A R² + B)      θ = C Θ + D Z      z = E Θ + F Z      A (C F − D E) = 1
/// F = [A R/r  0  0;  0  r C/R  r D;  0  E/R  F]
/// T_rr' = (N_θθ − N_rr)/r,   N = g₁ B + g₋₁ B⁻¹        W(25.14–25.16)
/// ```
/// | constant | unit | of a whole tube |
/// |---|---|---|
/// | A | 1 | 1/F; negative where the tube is everted |
/// | B | m² | 0 of a solid cylinder |
/// | C | 1 | 1; with F < 0 where the tube is everted |
/// | D | rad/m | the twist |
/// | E | m/rad | 0 |
/// | F | 1 | the axial stretch, negative where the tube is everted |
///
/// # Example
/// A solid cylinder twisted by D = ½ rad/m: Tθz = μ D r.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::{Datum, Family, TubeDeformation};
/// let twist = TubeDeformation::new([1.0, 0.0, 1.0, 0.5, 0.0, 1.0])?;
/// let surface = [2.0, 0.0, 0.0];
/// let stress = twist.stress(&NeoHookean::new(3.0)?, &Datum::free_at(surface), surface)?;
/// assert_eq!(stress.cauchy.0.components[4], 3.0); // 3 · ½ · 2
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25, family 3.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeDeformation {
    profile: profile::Cylindrical<f64>,
}

impl TubeDeformation {
    /// From A, B, C, D, E, F.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::ConstraintViolated`] with the A that satisfies the constraint.
    pub fn new([a, b, c, d, e, f]: [f64; 6]) -> Result<Self, SolutionsError> {
        check_finite("constants", &[a, b, c, d, e, f])?;
        let nearest = isochoric_factor([c, d, e, f])?;
        let terms = (a * (c * f - d * e), a.abs() * ((c * f).abs() + (d * e).abs()));
        check_constraint("family 3", "A (C F − D E) = 1", terms, ("A", nearest))?;
        Ok(Self::of_profile(profile::Cylindrical { a, offset: b, block: [c, d, e, f], is_sector: true }))
    }

    /// From B, C, D, E, F: A follows.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`]; [`SolutionsError::OutOfBounds`] where no A is right.
    pub fn isochoric([b, c, d, e, f]: [f64; 5]) -> Result<Self, SolutionsError> {
        check_finite("B", &[b])?;
        let a = isochoric_factor([c, d, e, f])?;
        Ok(Self::of_profile(profile::Cylindrical { a, offset: b, block: [c, d, e, f], is_sector: true }))
    }

    /// A, B, C, D, E, F.
    #[must_use]
    pub fn constants(&self) -> [f64; 6] {
        let [c, d, e, f] = self.profile.block;
        [self.profile.a, self.profile.offset, c, d, e, f]
    }

    pub(crate) const fn profile(&self) -> &profile::Cylindrical<f64> {
        &self.profile
    }

    pub(crate) const fn of_profile(profile: profile::Cylindrical<f64>) -> Self {
        Self { profile }
    }
}

impl Family for TubeDeformation {
    type Reference = Cylindrical;
    type Current = Cylindrical;

    fn place<T: Real>(&self, reference: [T; 3]) -> [T; 3] {
        self.profile.place(reference)
    }

    fn gradient<T: Real>(&self, [r, _, _]: [T; 3]) -> Rows<T> {
        self.profile.over::<T>().gradient(r)
    }

    fn check_domain(&self, reference: [f64; 3]) -> Result<(), SolutionsError> {
        self.profile.check_domain(reference, ("A R² + B", "0 < A R² + B"))
    }

    fn rise(&self, law: &impl ResponseFunctions, from: [f64; 3], to: [f64; 3]) -> Result<f64, SolutionsError> {
        self.profile.rise(law, from[0], to[0])
    }

    fn rise_and_slope(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [f64; 3],
    ) -> Result<(f64, [f64; 3]), SolutionsError> {
        self.profile.rise_with_slope(law, from[0], to[0])
    }
}
