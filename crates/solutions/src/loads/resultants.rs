//! Loads on the faces of bent blocks and of tubes.

use crate::error::{check_bound, check_finite};
use crate::families::profile::Cylindrical;
use crate::families::{BlockBending, Family, TubeDeformation};
use crate::integral::{Packed, integrate};
use crate::{ResponseFunctions, SolutionsError};

/// Loads on the faces of a bent block, family 1, or of a sector of a tube, family 3, per unit of the other two reference
/// coordinates.
///
/// ```text
/// family 1:  θ = B Y + C Z,  z = D Y + E Z        family 3:  θ = C Θ + D Z,  z = E Θ + F Z
/// dE = bending_moment d(θ,Y) + torque d(θ,Z) + axial_shear d(z,Y) + axial_force d(z,Z) + pressures
/// ```
/// | load | face | of family 1 | unit | of family 3 | unit | conjugate to |
/// |---|---|---|---|---|---|---|
/// | `bending_moment` | Y or Θ constant | ∫ r `P_θY` dX | N | ∫ r `P_θΘ` dR | N | B; C |
/// | `torque` | Z constant | ∫ r `P_θZ` dX | N | ∫ r `P_θZ` R dR | N m | C; D |
/// | `axial_shear` | Y or Θ constant | ∫ `P_zY` dX | N/m | ∫ `P_zΘ` dR | N/m | D; E |
/// | `axial_force` | Z constant | ∫ `P_zZ` dX | N/m | ∫ `P_zZ` R dR | N | E; F |
///
/// A whole tube carries 2π times `torque` and `axial_force`. Moments are those about the axis r = 0.
///
/// # Example
/// A solid cylinder of radius 1 m, twisted by ½ rad/m at fixed length: M = ½ π μ D R⁴, N = −¼ π μ D² R⁴.
/// ```
/// use core::f64::consts::{PI, TAU};
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::TubeDeformation;
/// use piola_solutions::loads::SectorLoads;
/// let twist = TubeDeformation::new([1.0, 0.0, 1.0, 0.5, 0.0, 1.0])?;
/// let loads = SectorLoads::of_tube(&twist, &NeoHookean::new(2.0)?, (0.0, 1.0), 0.0)?;
/// assert!((TAU * loads.torque - 0.5 * PI).abs() < 1e-14);
/// assert!((TAU * loads.axial_force + 0.125 * PI).abs() < 1e-14); // Poynting: it must be pushed
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W §25; R. S. Rivlin, Phil. Trans. R. Soc. A 242 (1949) 173.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SectorLoads<T = f64> {
    /// `T_rr` at the first and the second face, Pa: minus the pressures there.
    pub normal_stresses: [T; 2],
    /// The moment about the axis on a face of constant Y or Θ, per length along Z, N.
    pub bending_moment: T,
    /// The moment about the axis on a face of constant Z, per length along Y, N, or per radian of Θ, N m.
    pub torque: T,
    /// The axial force on a face of constant Y or Θ, per length along Z, N/m.
    pub axial_shear: T,
    /// The axial force on a face of constant Z, per length along Y, N/m, or per radian of Θ, N.
    pub axial_force: T,
}

impl SectorLoads {
    /// Of a block between two X, m, with `T_rr` at the second, Pa.
    ///
    /// # Errors
    /// [`SolutionsError::OutsideDomain`] where a face is; what the law refuses; [`SolutionsError::NotFinite`].
    ///
    /// # Accuracy
    /// 1e-13 of the integrals of the moduli.
    pub fn of_bending(
        bending: &BlockBending,
        law: &impl ResponseFunctions,
        (first, second): (f64, f64),
        stress: f64,
    ) -> Result<Self, SolutionsError> {
        bending.check_domain([first, 0.0, 0.0])?;
        bending.check_domain([second, 0.0, 0.0])?;
        check_bound("faces", second, "X₁ < X₂", first < second)?;
        check_finite("T_rr", &[stress])?;
        of_profile::<_, 6>(bending.profile(), law, (first, second), stress)
    }

    /// Of a tube or a sector between two R, m, with `T_rr` at the second, Pa. A solid cylinder begins at R = 0.
    ///
    /// # Errors
    /// As [`of_bending`](Self::of_bending).
    ///
    /// # Accuracy
    /// As [`of_bending`](Self::of_bending).
    pub fn of_tube(
        tube: &TubeDeformation,
        law: &impl ResponseFunctions,
        (first, second): (f64, f64),
        stress: f64,
    ) -> Result<Self, SolutionsError> {
        let is_solid = first.abs() <= 0.0 && tube.profile().offset.abs() <= 0.0;
        if !is_solid {
            tube.check_domain([first, 0.0, 0.0])?;
        }
        tube.check_domain([second, 0.0, 0.0])?;
        check_bound("faces", second, "R₁ < R₂", first < second)?;
        check_finite("T_rr", &[stress])?;
        of_profile::<_, 6>(tube.profile(), law, (first, second), stress)
    }
}

/// Loads of families 1 and 3 as one; K > 5 · COUNT.
pub(crate) fn of_profile<T: Packed, const K: usize>(
    profile: &Cylindrical<T>,
    law: &impl ResponseFunctions,
    (first, second): (T, T),
    stress: T,
) -> Result<SectorLoads<T>, SolutionsError> {
    let Cylindrical { a, block: [b, c, d, e], .. } = *profile;
    let from = profile.area(first);
    let integrand = |s: T| {
        let (extra, hoop, terms) = profile.stresses(law, s)?;
        let [rr, _, zz, _, tz, _] = extra.components;
        let axial = zz - rr;
        let (r, k) = (profile.radius(s), profile.scale(s));
        let slope = hoop * (a * k / (r * r));
        let ak = a * k;
        // T = T_rr 1 + (N − N_rr 1): the share of T_rr is that of Q = ∫ T_rr κ ds = T_rr(s₂) (ξ₂ − ξ₁) − ∫ T_rr' (ξ − ξ₁) ds.
        let uniform = -(slope * (profile.area(s) - from));
        let values = [
            slope,
            a * e * uniform + ak * (e * hoop - r * c * tz),
            -(a * d * uniform) + ak * (r * b * tz - d * hoop),
            -(a * c * uniform) + ak * (e * tz / r - c * axial),
            a * b * uniform + ak * (b * axial - d * tz / r),
        ];
        Ok((values, (terms + zz.primal(0).abs()) * ak.primal(0).abs()))
    };
    let [rise, bending_moment, torque, axial_shear, axial_force] =
        integrate::<T, 5, K>("tractions", (first, second), integrand)?;
    let uniform = a * stress * (profile.area(second) - from);
    Ok(SectorLoads {
        normal_stresses: [stress - rise, stress],
        bending_moment: bending_moment + e * uniform,
        torque: torque - d * uniform,
        axial_shear: axial_shear - c * uniform,
        axial_force: axial_force + b * uniform,
    })
}
