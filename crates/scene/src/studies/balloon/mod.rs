//! The balloon: a spherical shell under pressure.
//!
//! ```text
//! r³ = R³ + A,    p = 2 ∫ (N_θθ − N_rr) dr/r,    λ = r_i/R_i                                 W(25.20–25.22)
//! thin wall:  p = 2 (t/R) λ⁻³ (T_θθ − T_rr),  t/R = (R_o − R_i)/R_i
//! ```

mod build;
mod figure;
mod run;

pub use run::BalloonCurve;

use piola_solutions::families::Orientation;
use piola_solutions::loads::{Shell, SphereInflation};
use piola_solutions::{LocalDeformation, ResponseFunctions};

use super::law::material;
use super::panel::quantity;
use super::{Law, StudyPlan};

/// A spherical shell, and the range of its stretch.
///
/// # Example
/// ```
/// use piola_scene::studies::{self, Findings, SolidFindings};
/// use piola_scene::{Document, SceneFile};
/// let document = Document::parse("balloon.toml", "
///     [balloon]
///     inner_radius = '1 m'
///     outer_radius = '1.001 m'
///     [law]
///     type = 'neo-hookean'
///     shear_modulus = '1 MPa'
/// ");
/// let SceneFile::Study(study) = SceneFile::from_document(&document)? else { panic!() };
/// let run = studies::run(&study, |_| std::ops::ControlFlow::Continue(()));
/// let Findings::Solid(SolidFindings::Balloon(found)) = &run.findings else { panic!() };
/// // A thin neo-Hookean wall: p = 2 μ (t/R) (λ⁻¹ − λ⁻⁷) is largest at λ = 7^(1/6).
/// assert!((found.limits[0].parameter - 7.0_f64.powf(1.0 / 6.0)).abs() < 1e-2);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Balloon {
    /// The shell in the reference.
    pub shell: Shell,
    /// The law.
    pub law: Law,
    /// The least and the greatest stretch of the inner face.
    pub stretch: [f64; 2],
    /// The pressure of the states that are sought, Pa.
    pub pressure: Option<f64>,
    /// Points of the curve.
    pub points: u32,
}

impl Balloon {
    pub(super) const fn inflation(&self) -> SphereInflation<'_, Law> {
        SphereInflation { shell: self.shell, law: &self.law, orientation: Orientation::Kept }
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

    pub(super) const fn radii(&self) -> [f64; 2] {
        [self.shell.inner(), self.shell.outer()]
    }

    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        let ([inner, outer], [low, high]) = (self.radii(), self.stretch);
        let [inner, outer] = [inner, outer].map(|radius| quantity("m", radius));
        plan.system = format!("a spherical shell of radii {inner} and {outer}, of {}", material(&self.law));
        plan.method = format!("pressure by quadrature through the wall, stretches from {low} to {high}");
        plan.reason = "a sphere inflated keeps its shape whatever the law: nothing but an integral is left".to_string();
        plan.compute("limit points", "where the exact slope of the pressure changes its sign");
        match self.pressure {
            Some(pressure) => plan.compute("states", format!("all that carry {}", quantity("Pa", pressure))),
            None => plan.skip("states at a pressure", "no `pressure` is given: stresses are those at the limit points"),
        }
        plan.compute("thin wall", "the pressure of a wall without thickness, for comparison");
        plan.skip("states that are no spheres", "the solution is the sphere's own");
        (&["curve.csv", "states.csv", "stress.csv"], &["balloon.svg"])
    }
}
