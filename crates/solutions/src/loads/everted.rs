//! A tube turned inside out.

use core::f64::consts::PI;

use piola_numerics::{Gradient, Real};

use super::resultants::of_profile;
use super::{Tube, shear_modulus};
use crate::error::check_bound;
use crate::families::TubeDeformation;
use crate::families::profile::Cylindrical;
use crate::roots::newton;
use crate::{ResponseFunctions, SolutionsError};

/// A tube turned inside out, without loads on its curved faces and without a resultant on its ends.
///
/// # Example
/// See [`everted_tube`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EvertedTube {
    /// The deformation: A < 0 and F < 0.
    pub deformation: TubeDeformation,
    /// The radii of the everted tube, m.
    pub radii: [f64; 2],
    /// −F, the axial stretch.
    pub axial_stretch: f64,
}

/// The everted state of a tube without loads: free curved faces, no resultant force on the ends.
///
/// ```text
/// r = √(B − R²/λ)      θ = Θ      z = −λ Z      p = 0,  N = 0
/// ```
/// The stress on the ends is not zero at each place: there the exact solution holds in the sense of Saint-Venant.
///
/// # Errors
/// [`SolutionsError::OutOfBounds`] for a solid cylinder; [`SolutionsError::NotConverged`] where no state is found; what the
/// law refuses.
///
/// # Accuracy
/// Pressure and force below 1e-11 of the shear modulus, most often at rounding.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::loads::{Tube, everted_tube};
/// let everted = everted_tube(&Tube::new(1.0, 1.1)?, &NeoHookean::new(1.0)?)?;
/// // A thin tube keeps its radius and length nearly.
/// assert!((everted.radii[0] - 1.0).abs() < 0.01 && (everted.axial_stretch - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. S. Rivlin, Proc. R. Soc. A 195 (1949) 463; family 3.
#[doc(alias = "eversion")]
pub fn everted_tube(tube: &Tube, law: &impl ResponseFunctions) -> Result<EvertedTube, SolutionsError> {
    check_bound("inner radius", tube.inner(), "0 < R_i", 0.0 < tube.inner())?;
    let modulus = shear_modulus(law);
    let (inner, outer) = (tube.inner(), tube.outer());
    let equations = |[radius, axial]: [Gradient<f64, 2>; 2]| {
        check_bound("radius of the cavity", radius.value, "0 < r", 0.0 < radius.value)?;
        check_bound("axial stretch", axial.value, "0 < λ", 0.0 < axial.value)?;
        let loads = of_profile::<_, 16>(
            &everted(tube, radius, axial),
            law,
            (Real::lit(inner), Real::lit(outer)),
            Real::lit(0.0),
        )?;
        let area = Gradient::constant(modulus * 0.5 * (outer * outer - inner * inner));
        Ok([loads.normal_stresses[0] / Gradient::constant(modulus), loads.axial_force / area])
    };
    let [radius, axial_stretch] = newton("no load", [inner, 1.0], equations)?;
    let profile = everted(tube, radius, axial_stretch);
    let largest = (radius * radius + (outer * outer - inner * inner) / axial_stretch).sqrt();
    check_bound("volume", PI * (largest - radius), "0 < r_o − r_i", radius < largest)?;
    Ok(EvertedTube { deformation: TubeDeformation::of_profile(profile), radii: [radius, largest], axial_stretch })
}

/// `r² = radius² + (R_o² − R²)/λ`.
fn everted<T: Real>(tube: &Tube, radius: T, axial: T) -> Cylindrical<T> {
    let a = -axial.recip();
    let offset = radius * radius - a * T::lit(tube.outer() * tube.outer());
    Cylindrical { a, offset, block: [T::one(), T::zero(), T::zero(), -axial], is_sector: true }
}
