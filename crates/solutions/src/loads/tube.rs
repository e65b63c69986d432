//! Inflation of a tube.

use core::f64::consts::{PI, TAU};

use piola_numerics::Gradient;

use super::resultants::of_profile;
use super::{Ends, SectorLoads, Tube, shear_modulus};
use crate::error::check_bound;
use crate::families::TubeDeformation;
use crate::families::profile::Cylindrical;
use crate::integral::Packed;
use crate::roots::implicit;
use crate::{LoadCurve, ResponseFunctions, SolutionsError};

/// The pressure inside a tube over the stretch of its inner face, its outer face free.
///
/// ```text
/// p = ∫ (N_θθ − N_rr) dr/r      N = 2π ∫ T_zz r dr      r² = R²/λ_z + B
/// ```
/// The ends are held at a stretch, pulled by a force, or closed by caps: then N = π `r_i²` p.
///
/// # Example
/// A tube of neo-Hookean rubber, its ends held: `p = μ (ln λ_i − ln λ_o + ½/λ_o² − ½/λ_i²)` rises towards
/// `μ ln(R_o/R_i)`.
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::LoadCurve;
/// use piola_solutions::loads::{Ends, Tube, TubeInflation};
/// let law = NeoHookean::new(1.0)?;
/// let tube = TubeInflation { tube: Tube::new(1.0, 2.0)?, law: &law, ends: Ends::Stretch(1.0) };
/// assert!(tube.limit_points((1.0, 5.0))?.is_empty());
/// let outer = 7.0_f64.sqrt() / 2.0; // r_o² = 4 + 3
/// let by_hand = (2.0 / outer).ln() + 0.5 * (1.0 / (outer * outer) - 0.25);
/// assert!((tube.point(2.0)?.load - by_hand).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// R. S. Rivlin, Phil. Trans. R. Soc. A 242 (1949) 173; family 3.
#[derive(Clone, Copy, Debug)]
pub struct TubeInflation<'a, L> {
    /// The tube.
    pub tube: Tube,
    /// The law.
    pub law: &'a L,
    /// What holds the ends.
    pub ends: Ends,
}

/// A tube under pressure.
///
/// # Example
/// See [`TubeInflation`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InflatedTube {
    /// The deformation.
    pub deformation: TubeDeformation,
    /// The axial stretch.
    pub axial_stretch: f64,
    /// The pressure inside, Pa.
    pub pressure: f64,
    /// The resultant of the axial stress, N.
    pub axial_force: f64,
}

/// The profile of a whole tube with the stretches (axial, of the inner face) and the twist.
pub(super) fn profile<T: Packed>(tube: &Tube, axial: T, inner: T, twist: T) -> Cylindrical<T> {
    let a = axial.recip();
    let area = T::lit(tube.inner() * tube.inner());
    Cylindrical { a, offset: area * (inner * inner - a), block: [T::one(), twist, T::zero(), axial], is_sector: true }
}

/// Loads of a whole tube, its outer face free, over two or three unknowns.
pub(super) fn loads<T: Packed, const K: usize>(
    tube: &Tube,
    law: &impl ResponseFunctions,
    profile: &Cylindrical<T>,
) -> Result<SectorLoads<T>, SolutionsError> {
    of_profile::<T, K>(profile, law, (T::lit(tube.inner()), T::lit(tube.outer())), T::zero())
}

/// Refuses stretches that no tube has, so that a search turns back.
pub(super) fn check_stretches(axial: f64, inner: f64) -> Result<(), SolutionsError> {
    check_bound("axial stretch", axial, "0 < λ", 0.0 < axial)?;
    check_bound("stretch of the inner face", inner, "0 < λ", 0.0 < inner)
}

impl<L: ResponseFunctions> TubeInflation<'_, L> {
    /// (axial stretch, (pressure, slope)).
    fn solved(&self, stretch: f64) -> Result<(f64, [f64; 2]), SolutionsError> {
        check_bound("stretch of the inner face", stretch, "0 < λ", 0.0 < stretch)?;
        if self.tube.is_solid() {
            check_bound("inner radius", 0.0, "0 < R_i", false)?;
        }
        let ends = self.ends.check()?;
        let scale = PI * self.tube.outer() * self.tube.outer() * shear_modulus(self.law);
        // An inflated tube keeps its volume: the guess lets it share the change between length and width.
        let guess = if let Ends::Stretch(axial) = ends { axial } else { 1.0 };
        let state = |[axial, inner]: [Gradient<f64, 2>; 2]| {
            check_stretches(axial.value, inner.value)?;
            let profile = profile(&self.tube, axial, inner, Gradient::constant(0.0));
            let found = loads::<_, 16>(&self.tube, self.law, &profile)?;
            let pressure = -found.normal_stresses[0];
            let force = found.axial_force * Gradient::constant(TAU);
            let cap = inner * inner * Gradient::constant(PI * self.tube.inner() * self.tube.inner());
            let scale = Gradient::constant(scale);
            let equation = match ends {
                Ends::Stretch(stretch) => axial - Gradient::constant(stretch),
                Ends::Force(prescribed) => (force - Gradient::constant(prescribed)) / scale,
                Ends::Closed => (force - cap * pressure) / scale,
            };
            Ok(([equation], pressure))
        };
        let ([axial, _], load) = implicit("the axial force", [guess, stretch], state)?;
        Ok((axial, load))
    }

    /// The pressure of a tube whose ends are held.
    pub(crate) fn pressure_of_held(&self, stretch: f64) -> Result<f64, SolutionsError> {
        let axial = if let Ends::Stretch(axial) = self.ends { axial } else { f64::NAN };
        check_stretches(axial, stretch)?;
        profile(&self.tube, axial, stretch, 0.0).rise(self.law, self.tube.inner(), self.tube.outer())
    }

    /// The state at a stretch of the inner face.
    ///
    /// # Errors
    /// [`SolutionsError::OutOfBounds`] for stretches that are not positive and for a solid cylinder;
    /// [`SolutionsError::NotConverged`] where no axial stretch is found; what the law refuses.
    pub fn state(&self, stretch: f64) -> Result<InflatedTube, SolutionsError> {
        let (axial_stretch, [pressure, _]) = self.solved(stretch)?;
        let profile = profile(&self.tube, axial_stretch, stretch, 0.0);
        let found = loads::<_, 6>(&self.tube, self.law, &profile)?;
        let deformation = TubeDeformation::of_profile(profile);
        Ok(InflatedTube { deformation, axial_stretch, pressure, axial_force: TAU * found.axial_force })
    }
}

impl<L: ResponseFunctions> LoadCurve for TubeInflation<'_, L> {
    const LOAD: &'static str = "pressure";
    const PARAMETER: &'static str = "stretch of the inner face";

    fn load_and_slope(&self, stretch: f64) -> Result<[f64; 2], SolutionsError> {
        Ok(self.solved(stretch)?.1)
    }
}
