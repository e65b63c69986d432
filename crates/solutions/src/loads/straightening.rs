//! Straightening of a sector.

use piola_numerics::{Dual, Real};

use super::Sector;
use crate::error::{check_bound, check_finite};
use crate::families::{Family, SectorStraightening};
use crate::integral::{Packed, integrate};
use crate::{LoadCurve, LocalDeformation, ResponseFunctions, SolutionsError};

/// Loads on the faces of a straightened sector, family 2, per unit of the other reference coordinate.
///
/// ```text
/// dE = tension dB + cross_shear dC + shear dD + axial_force dE + work of T_xx      E per radian of Θ and metre of Z
/// ```
/// | load | face | | unit |
/// |---|---|---|---|
/// | `tension` | Θ constant | ∫ `P_yΘ` dR | N/m |
/// | `cross_shear` | Z constant | ∫ `P_yZ` R dR | N |
/// | `shear` | Θ constant | ∫ `P_zΘ` dR | N/m |
/// | `axial_force` | Z constant | ∫ `P_zZ` R dR | N |
/// | `bending_moment` | Θ constant | ∫ (x₁ − x) `P_yΘ` dR about the face x₁ of R₁ | N |
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::families::SectorStraightening;
/// use piola_solutions::loads::BlockLoads;
/// let straight = SectorStraightening::new([0.5, 2.0, 0.0, 0.0, 1.0])?;
/// let loads = BlockLoads::of_sector(&straight, &NeoHookean::new(1.0)?, (1.0, 3.0), 0.0)?;
/// // P_yΘ = μ (B/R − A² B⁻¹ R³ …) = 2/R − R³/8, from 1 to 3
/// assert!((loads.tension - (2.0 * 3.0_f64.ln() - 80.0 / 32.0)).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BlockLoads<T = f64> {
    /// The force along y on a face of constant Θ, per length along Z, N/m.
    pub tension: T,
    /// The force along y on a face of constant Z, per radian, N.
    pub cross_shear: T,
    /// The force along z on a face of constant Θ, per length along Z, N/m.
    pub shear: T,
    /// The force along z on a face of constant Z, per radian, N.
    pub axial_force: T,
    /// The moment about z on a face of constant Θ, about the first face, per length along Z, N.
    pub bending_moment: T,
}

impl BlockLoads {
    /// Of a sector between two R, m, with the same `T_xx` everywhere, Pa.
    ///
    /// # Errors
    /// [`SolutionsError::OutsideDomain`] unless 0 < R; [`SolutionsError::OutOfBounds`] unless R₁ < R₂; what the law refuses.
    ///
    /// # Accuracy
    /// 1e-13 of the integrals of the moduli.
    pub fn of_sector(
        straightening: &SectorStraightening,
        law: &impl ResponseFunctions,
        (first, second): (f64, f64),
        stress: f64,
    ) -> Result<Self, SolutionsError> {
        straightening.check_domain([first, 0.0, 0.0])?;
        straightening.check_domain([second, 0.0, 0.0])?;
        check_bound("faces", second, "R₁ < R₂", first < second)?;
        check_finite("T_xx", &[stress])?;
        of_constants::<f64, 6>(straightening.constants(), law, (first, second), stress)
    }
}

/// K > 5 · COUNT.
fn of_constants<T: Packed, const K: usize>(
    [a, b, c, d, e]: [T; 5],
    law: &impl ResponseFunctions,
    (first, second): (f64, f64),
    stress: T,
) -> Result<BlockLoads<T>, SolutionsError> {
    let zero = T::zero();
    let integrand = |r: T| {
        let gradient = [[a * r, zero, zero], [zero, b / r, c], [zero, d / r, e]];
        let [xx, yy, zz, _, yz, _] = LocalDeformation::of(gradient).checked_stress(law)?.components;
        let (yy, zz) = (stress + (yy - xx), stress + (zz - xx));
        let ar = a * r;
        let tension = ar * (e * yy - c * yz);
        let lever = T::lit(0.5) * a * (T::lit(first * first) - r * r);
        let terms = xx.primal(0).abs() + yy.primal(0).abs() + zz.primal(0).abs();
        let values = [tension, ar * (b * yz - d * yy), ar * (e * yz - c * zz), ar * (b * zz - d * yz), lever * tension];
        Ok((values, terms * ar.primal(0).abs()))
    };
    let ends = (T::lit(first), T::lit(second));
    let [tension, cross_shear, shear, axial_force, bending_moment] =
        integrate::<T, 5, K>("tractions", ends, integrand)?;
    Ok(BlockLoads { tension, cross_shear, shear, axial_force, bending_moment })
}

/// The tension on a straightened sector over its length per radian, B, with free faces x constant and a given stretch along
/// z; tension 0 is straightening by couples alone.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::LoadCurve;
/// use piola_solutions::loads::{Sector, Straightening};
/// let law = NeoHookean::new(1.0)?;
/// let sector = Straightening { sector: Sector::new([1.0, 3.0], [0.0, 1.0])?, law: &law, axial_stretch: 1.0 };
/// // B ln 3 = (3⁴ − 1)/(4 B³)
/// let by_couples = sector.states_at(0.0, (0.5, 5.0))?;
/// assert_eq!(by_couples.len(), 1);
/// assert!((by_couples[0].parameter.powi(4) - 20.0 / 3.0_f64.ln()).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Straightening<'a, L> {
    /// The sector.
    pub sector: Sector,
    /// The law.
    pub law: &'a L,
    /// E, the stretch along z.
    pub axial_stretch: f64,
}

impl<L: ResponseFunctions> LoadCurve for Straightening<'_, L> {
    const LOAD: &'static str = "tension";
    const PARAMETER: &'static str = "length per radian";

    fn load_and_slope(&self, length: f64) -> Result<[f64; 2], SolutionsError> {
        check_bound("length per radian", length, "0 < B", 0.0 < length)?;
        check_bound("axial stretch", self.axial_stretch, "0 < E", 0.0 < self.axial_stretch)?;
        let (b, e, zero) = (Dual::variable(length), Dual::constant(self.axial_stretch), Dual::constant(0.0));
        let constants = [(b * e).recip(), b, zero, zero, e];
        let [first, second] = self.sector.radii();
        let tension = of_constants::<_, 11>(constants, self.law, (first, second), zero)?.tension;
        Ok([tension.value, tension.tangent])
    }
}
