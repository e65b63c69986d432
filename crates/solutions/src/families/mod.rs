//! The families of universal deformations of incompressible isotropic solids: boundary tractions alone maintain them,
//! whatever the law.
//!
//! ```text
//! 0   x = F X + c                                                  det F = 1
//! 1   r = √(2 A X)          θ = B Y + C Z     z = D Y + E Z        A (B E − C D) = 1      a block is bent
//! 2   x = ½ A R²            y = B Θ + C Z     z = D Θ + E Z        A (B E − C D) = 1      a sector is straightened
//! 3   r = √(A R² + B)       θ = C Θ + D Z     z = E Θ + F Z        A (C F − D E) = 1      a tube is inflated, twisted, everted
//! 4   r = ∛(±R³ + A)        θ = ±Θ            φ = Φ                                       a sphere is inflated, everted
//! 5   r = A R               θ = B ln R + C Θ  z = D Z              A² C D = 1             a sector is sheared
//! ```
//! Components are physical, in the order of the coordinates; in spherical ones θ is the azimuth, φ the colatitude. The
//! pressure is determined up to a constant: a [`Datum`] gives T₁₁ at one particle.
//!
//! Each family is a [`Family`], with the same methods:
//!
//! | to get | use |
//! |---|---|
//! | the place of a particle | [`Family::place`]; as a motion in Cartesian coordinates [`AsMotion`] |
//! | F, B, B⁻¹, I, II | [`Family::deformation`] |
//! | p and T | [`Family::stress`] |
//! | div T | [`Family::equilibrium_residual`] |
//!
//! # Source
//! W §25; J. L. Ericksen, Z. angew. Math. Phys. 5 (1954) 466; M. Singh and A. C. Pipkin, ibid. 16 (1965) 706.

mod affine;
mod azimuthal;
mod bending;
mod motion;
pub(crate) mod profile;
mod sphere;
mod straightening;
mod tube;

pub use affine::IsochoricDeformation;
pub use azimuthal::AzimuthalShearing;
pub use bending::BlockBending;
pub use motion::{AsMotion, FromCartesian};
pub use sphere::{Orientation, SphereDeformation};
pub use straightening::SectorStraightening;
pub use tube::TubeDeformation;

use nalgebra::Vector3;
use piola_continuum::CauchyStress;
use piola_fields::{Coordinates, VectorResidual};
use piola_numerics::linear::matrix3::inverse_and_determinant;
use piola_numerics::{Gradient, Real};
use piola_tensor::Symmetric;
use piola_tensor::internal::rows::Rows;

use crate::error::{check_bound, check_finite};
use crate::{LocalDeformation, ResponseFunctions, SolutionsError};

/// T₁₁ at one particle: what the pressure is measured from.
///
/// # Example
/// ```
/// use piola_solutions::families::Datum;
/// let free = Datum::free_at([1.0, 0.0, 0.0]);
/// assert_eq!(free.stress, 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Datum {
    /// The reference coordinates of the particle.
    pub reference: [f64; 3],
    /// T₁₁ there, Pa: `T_rr`, or `T_xx` in families 0 and 2.
    pub stress: f64,
}

impl Datum {
    /// T₁₁ = 0 at a particle, as on a free face.
    #[must_use]
    pub const fn free_at(reference: [f64; 3]) -> Self {
        Self { reference, stress: 0.0 }
    }
}

/// The stress at a particle.
///
/// # Example
/// See [`Family`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalStress {
    /// p, Pa, of T = −p 1 + g₁ B + g₋₁ B⁻¹.
    pub pressure: f64,
    /// T in physical components, Pa.
    pub cauchy: CauchyStress,
}

/// A family of universal deformations of incompressible isotropic solids.
///
/// # Errors
/// All methods that return a `Result`: [`SolutionsError::NotFinite`]; [`SolutionsError::OutsideDomain`] for particles that
/// the map does not reach; what the law refuses; [`SolutionsError::IntegralNotConverged`].
///
/// # Accuracy
/// Places and strains: a few ulp. Stress: a few ulp of its largest term; where the pressure is an integral, 1e-13 of ∫ |dT₁₁|.
///
/// # Example
/// A block of rubber bent to a sector: `T_θθ` at the outer face, where `T_rr` is 0.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::{BlockBending, Datum, Family};
/// let bending = BlockBending::new([2.0, 0.5, 0.0, 0.0, 1.0])?; // r = √(4 X), θ = ½ Y
/// let outer = [4.0, 0.0, 0.0]; // r = 4
/// let stress = bending.stress(&NeoHookean::new(1.0)?, &Datum::free_at(outer), outer)?;
/// // B_θθ − B_rr = (r B)² − (A/r)² = 4 − 1/4
/// assert_eq!(stress.cauchy.0.components[1], 3.75);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait Family {
    /// The coordinates of the reference configuration.
    type Reference: FromCartesian;
    /// The coordinates of the deformed body.
    type Current: FromCartesian;

    /// The coordinates of the place of a particle, m or rad.
    #[must_use]
    fn place<T: Real>(&self, reference: [T; 3]) -> [T; 3];

    /// F in physical components, by rows.
    #[must_use]
    fn gradient<T: Real>(&self, reference: [T; 3]) -> Rows<T>;

    /// Refuses particles that the map does not reach.
    ///
    /// # Errors
    /// [`SolutionsError::NotFinite`], [`SolutionsError::OutsideDomain`].
    fn check_domain(&self, reference: [f64; 3]) -> Result<(), SolutionsError>;

    /// T₁₁ at one particle less that at another, Pa, and its derivatives with respect to the reference coordinates of the
    /// first.
    ///
    /// # Errors
    /// See [the trait](Family#errors).
    #[doc(hidden)]
    fn rise_and_slope(
        &self,
        law: &impl ResponseFunctions,
        from: [f64; 3],
        to: [f64; 3],
    ) -> Result<(f64, [f64; 3]), SolutionsError>;

    /// T₁₁ at one particle less that at another, Pa.
    ///
    /// # Errors
    /// See [the trait](Family#errors).
    #[doc(hidden)]
    fn rise(&self, law: &impl ResponseFunctions, from: [f64; 3], to: [f64; 3]) -> Result<f64, SolutionsError>;

    /// F, B, B⁻¹, I and II at a particle.
    ///
    /// # Errors
    /// See [the trait](Family#errors).
    fn deformation(&self, reference: [f64; 3]) -> Result<LocalDeformation, SolutionsError> {
        self.check_domain(reference)?;
        Ok(LocalDeformation::of(self.gradient(reference)))
    }

    /// p and T at a particle, W(25.4).
    ///
    /// # Errors
    /// See [the trait](Family#errors).
    fn stress(
        &self,
        law: &impl ResponseFunctions,
        datum: &Datum,
        reference: [f64; 3],
    ) -> Result<LocalStress, SolutionsError> {
        let extra = self.deformation(reference)?.checked_stress(law)?;
        check_finite("datum", &[datum.stress])?;
        self.check_domain(datum.reference)?;
        let normal = datum.stress + self.rise(law, datum.reference, reference)?;
        Ok(at_normal_stress(&extra, normal))
    }

    /// div T, N/m³, in physical components: zero in all families. Its scale is the sum of the moduli of its terms.
    ///
    /// All derivatives are exact, those of the pressure by differentiation under its integral.
    ///
    /// # Errors
    /// See [the trait](Family#errors).
    fn equilibrium_residual(
        &self,
        law: &impl ResponseFunctions,
        datum: &Datum,
        reference: [f64; 3],
    ) -> Result<VectorResidual, SolutionsError>
    where
        Self::Current: Default,
    {
        self.check_domain(reference)?;
        self.check_domain(datum.reference)?;
        let at: [Gradient<f64, 3>; 3] = core::array::from_fn(|i| Gradient::variable(reference[i], i));
        let place = self.place(at);
        let extra = LocalDeformation::of(self.gradient(at)).checked_stress(law)?.rows();
        let (rise, slope) = self.rise_and_slope(law, datum.reference, reference)?;
        let normal = Gradient { value: datum.stress + rise, partials: slope } - extra[0][0];
        let stress = |i: usize, j: usize| if i == j { extra[i][j] + normal } else { extra[i][j] };
        // ∂/∂q = ∂X/∂q ∂/∂X
        let (back, _) = inverse_and_determinant(place.map(|q| q.partials));
        let tensor: Rows<f64> = core::array::from_fn(|i| core::array::from_fn(|j| stress(i, j).value));
        let partials: [Rows<f64>; 3] = core::array::from_fn(|k| {
            core::array::from_fn(|i| {
                core::array::from_fn(|j| (0..3).map(|a| stress(i, j).partials[a] * back[a][k]).sum())
            })
        });
        let coordinates = Vector3::from(place.map(|q| q.value));
        Ok(Self::Current::default().divergence_terms(&coordinates, &tensor, &partials)?.into())
    }
}

/// T = T₁₁ 1 + (N − N₁₁ 1), p = N₁₁ − T₁₁.
pub(crate) fn at_normal_stress(extra: &Symmetric, normal: f64) -> LocalStress {
    let pressure = extra.components[0] - normal;
    let [_, yy, zz, xy, yz, xz] = extra.components;
    let xx = extra.components[0];
    let cauchy = CauchyStress(Symmetric::new(normal, normal + (yy - xx), normal + (zz - xx), xy, yz, xz));
    LocalStress { pressure, cauchy }
}

/// Refuses constants that violate `value` = 1 beyond the rounding of its terms, and names the constant that satisfies it.
pub(crate) fn check_constraint(
    family: &'static str,
    constraint: &'static str,
    (value, scale): (f64, f64),
    (constant, nearest): (&'static str, f64),
) -> Result<(), SolutionsError> {
    check_finite(constraint, &[value])?;
    if (value - 1.0).abs() <= 16.0 * f64::EPSILON * scale.max(1.0) {
        return Ok(());
    }
    Err(SolutionsError::ConstraintViolated { family, constraint, value, constant, nearest })
}

/// A = 1/det of a block of constants; refuses one that no A makes isochoric.
pub(crate) fn isochoric_factor(block: [f64; 4]) -> Result<f64, SolutionsError> {
    check_finite("constants", &block)?;
    let [b, c, d, e] = block;
    let determinant = b * e - c * d;
    let scale = (b * e).abs() + (c * d).abs();
    let holds = 4.0 * f64::EPSILON * scale < determinant.abs();
    check_bound("determinant of the constants", determinant, "≠ 0", holds)?;
    Ok(determinant.recip())
}
