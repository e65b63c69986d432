//! The balloon: a spherical shell under pressure.
//!
//! ```text
//! r³ = R³ + A,    p = 2 ∫ (N_θθ − N_rr) dr/r,    λ = r_i/R_i                                 W(25.20–25.22)
//! thin wall:  p = 2 (t/R) λ⁻³ (T_θθ − T_rr),  t/R = (R_o − R_i)/R_i
//! ```

mod run;

pub use run::{BalloonCurve, is_stable};

use piola_solutions::families::Orientation;
use piola_solutions::loads::{Shell, SphereInflation};
use piola_solutions::{CurvePoint, LoadCurve, LocalDeformation, ResponseFunctions, SolutionsError};

use crate::RubberLaw;

/// A spherical shell, and the range of its stretch.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::loads::Shell;
/// use piola_studies::{RubberLaw, Outcome, balloon::Balloon};
/// use std::ops::ControlFlow;
/// let shell = Shell::new(1.0, 1.001)?;
/// let law = RubberLaw::from(NeoHookean::new(1e6)?);
/// let balloon = Balloon { shell, law, stretch: [1.0, 4.0], pressure: None, points: 100 };
/// let (found, outcome) = balloon.run(&mut |_| ControlFlow::Continue(()));
/// assert_eq!(outcome, Outcome::Completed);
/// // A thin neo-Hookean wall: p = 2 μ (t/R) (λ⁻¹ − λ⁻⁷) is largest at λ = 7^(1/6).
/// assert!((found.limits[0].parameter - 7.0_f64.powf(1.0 / 6.0)).abs() < 1e-2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Balloon {
    /// The shell in the reference.
    pub shell: Shell,
    /// The law.
    pub law: RubberLaw,
    /// The least and the greatest stretch of the inner face.
    pub stretch: [f64; 2],
    /// The pressure of the states that are sought, Pa.
    pub pressure: Option<f64>,
    /// Points of the curve.
    pub points: u32,
}

impl Balloon {
    pub(crate) const fn inflation(&self) -> SphereInflation<'_, RubberLaw> {
        SphereInflation { shell: self.shell, law: &self.law, orientation: Orientation::Kept }
    }

    /// The state at a stretch of the inner face.
    ///
    /// # Errors
    /// [`SolutionsError`]: the law or the quadrature refuses it.
    pub fn state(&self, stretch: f64) -> Result<CurvePoint, SolutionsError> {
        self.inflation().point(stretch)
    }

    /// All states of the range of stretches that carry a pressure, Pa.
    ///
    /// # Errors
    /// [`SolutionsError`]: no state carries it, with the nearest pressure that one does.
    pub fn states_at(&self, pressure: f64) -> Result<Vec<CurvePoint>, SolutionsError> {
        self.inflation().states_at(pressure, (self.stretch[0], self.stretch[1]))
    }

    /// The pressure of a thin wall at a stretch, Pa.
    #[must_use]
    pub fn thin_wall_pressure(&self, stretch: f64) -> f64 {
        let [inner, outer] = self.radii();
        let across = (stretch * stretch).recip();
        let local = LocalDeformation::of([[across, 0.0, 0.0], [0.0, stretch, 0.0], [0.0, 0.0, stretch]]);
        let [direct, inverse] = self.law.response(local.first_minus_three, local.second_minus_three);
        let [radial, hoop] =
            [0, 1].map(|i| direct * local.left_cauchy_green.components[i] + inverse * local.inverse.components[i]);
        2.0 * (outer - inner) / inner * stretch.powi(-3) * (hoop - radial)
    }

    /// Inner and outer radius in the reference, m.
    #[must_use]
    pub const fn radii(&self) -> [f64; 2] {
        [self.shell.inner(), self.shell.outer()]
    }
}
