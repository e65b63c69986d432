//! Azimuthal shearing of a sector.

use piola_numerics::{Dual, Real};

use super::Sector;
use crate::error::{check_bound, check_finite};
use crate::families::{AzimuthalShearing, Datum, Family};
use crate::integral::integrate;
use crate::{LoadCurve, LocalDeformation, ResponseFunctions, SolutionsError};

/// Loads on the faces of a sheared sector, family 5, per metre of Z.
///
/// ```text
/// couple on a curved face:  R² T_rθ (Θ₂ − Θ₁)        moment on a face Θ = const:  ∫ r P_θΘ dR        axial force:  ∫∫ P_zZ R dR dΘ
/// couples[1] − couples[0] + moments[1] − moments[0] = 0
/// ```
/// Moments are those about the axis.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::{AzimuthalShearing, Datum};
/// use piola_solutions::loads::{Sector, ShearLoads};
/// let shearing = AzimuthalShearing::new([1.0, 0.5, 1.0, 1.0])?;
/// let sector = Sector::new([1.0, 2.0], [0.0, 1.0])?;
/// let loads = ShearLoads::of_sector(&shearing, &NeoHookean::new(2.0)?, &sector, &Datum::free_at([1.0, 0.0, 0.0]))?;
/// assert_eq!(loads.couples, [1.0, 4.0]); // R² μ B
/// assert!((loads.moments[1] - loads.moments[0] + 3.0).abs() < 1e-14); // the faces Θ = const balance them
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShearLoads {
    /// On the curved faces R₁ and R₂, N m per metre.
    pub couples: [f64; 2],
    /// On the faces Θ₁ and Θ₂, N m per metre.
    pub moments: [f64; 2],
    /// On a face of constant Z, N.
    pub axial_force: f64,
}

impl ShearLoads {
    /// Of a sector, with `T_rr` at one particle.
    ///
    /// # Errors
    /// [`SolutionsError::OutsideDomain`] for a datum off the domain; what the law refuses.
    ///
    /// # Accuracy
    /// 1e-13 of the integrals of the moduli.
    pub fn of_sector(
        shearing: &AzimuthalShearing,
        law: &impl ResponseFunctions,
        sector: &Sector,
        datum: &Datum,
    ) -> Result<Self, SolutionsError> {
        shearing.check_domain(datum.reference)?;
        check_finite("datum", &[datum.stress])?;
        let [a, b, _, d] = shearing.constants();
        let ([inner, outer], angles) = (sector.radii(), sector.angles());
        let local = LocalDeformation::of(shearing.gradient(datum.reference));
        let [rr, tt, zz, rt, _, _] = local.checked_stress(law)?.components;
        let normal = |r: f64, theta: f64| -> Result<f64, SolutionsError> {
            Ok(datum.stress + shearing.rise(law, datum.reference, [r, theta, 0.0])?)
        };
        let mut moments = [0.0; 2];
        for (moment, theta) in moments.iter_mut().zip(angles) {
            [*moment] = integrate::<f64, 1, 2>("moment", (inner, outer), |r| {
                // P_θΘ = A D (T_θθ − B T_rθ)
                let stress = (normal(r, theta)? + (tt - rr)) - b * rt;
                Ok(([a * r * (a * d * stress)], a * a * d * r * (rr.abs() + tt.abs() + (b * rt).abs())))
            })?;
        }
        // T_rr is linear in θ: its mean over the sector is that at the middle.
        let middle = f64::midpoint(angles[0], angles[1]);
        let [along] = integrate::<f64, 1, 2>("axial force", (inner, outer), |r| {
            // P_zZ = T_zz/D
            Ok(([r * ((normal(r, middle)? + (zz - rr)) / d)], r * (rr.abs() + zz.abs()) / d))
        })?;
        let couples = [inner, outer].map(|r| r * r * rt * sector.angle());
        Ok(Self { couples, moments, axial_force: along * sector.angle() })
    }
}

/// The shear traction `T_rθ` over the constant B, at given A and C.
///
/// # Example
/// Gent's law stiffens: `T_rθ` = μ B/(1 − B²/Jₘ).
/// ```
/// use piola_solids::isochoric::Gent;
/// use piola_solutions::LoadCurve;
/// use piola_solutions::loads::AzimuthalShear;
/// let law = Gent::new(1.0, 4.0)?;
/// let shear = AzimuthalShear { law: &law, radial_stretch: 1.0, angular_stretch: 1.0 };
/// let states = shear.states_at(4.0 / 3.0, (0.0, 1.9))?;
/// assert!((states[0].parameter - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct AzimuthalShear<'a, L> {
    /// The law.
    pub law: &'a L,
    /// A.
    pub radial_stretch: f64,
    /// C.
    pub angular_stretch: f64,
}

impl<L: ResponseFunctions> LoadCurve for AzimuthalShear<'_, L> {
    const LOAD: &'static str = "shear traction";
    const PARAMETER: &'static str = "B";

    fn load_and_slope(&self, b: f64) -> Result<[f64; 2], SolutionsError> {
        check_bound("A", self.radial_stretch, "0 < A", 0.0 < self.radial_stretch)?;
        check_bound("C", self.angular_stretch, "0 < C", 0.0 < self.angular_stretch)?;
        let lit = Dual::<f64>::lit;
        let (a, c, zero) = (lit(self.radial_stretch), lit(self.angular_stretch), lit(0.0));
        let d = (a * a * c).recip();
        let gradient = [[a, zero, zero], [a * Dual::variable(b), a * c, zero], [zero, zero, d]];
        let shear = LocalDeformation::of(gradient).checked_stress(self.law)?.components[3];
        Ok([shear.value, shear.tangent])
    }
}
