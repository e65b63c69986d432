//! Torsion of a rod or a tube, its ends held or under an axial force.
//!
//! ```text
//! θ = Θ + ψ Z,  z = λ Z,    M = 2π ∫ T_θz r² dr,    N = 2π ∫ T_zz r dr                       W(25.10), family 3
//! ```

mod build;
mod figure;
mod run;

pub use run::{RodCurves, TwistedState};

use piola_solutions::loads::{Ends, Torsion, Tube};

use super::law::material;
use super::panel::quantity;
use super::{Law, StudyPlan};

/// A rod or a tube, and how far it is twisted.
///
/// # Example
/// ```
/// use piola_scene::studies::{self, Findings, SolidFindings};
/// use piola_scene::{Document, SceneFile};
/// let document = Document::parse("rod.toml", "
///     [torsion]
///     outer_radius = '1 m'
///     twist = '0.5 rad/m'
///     [law]
///     type = 'neo-hookean'
///     shear_modulus = '1 Pa'
/// ");
/// let SceneFile::Study(study) = SceneFile::from_document(&document)? else { panic!() };
/// let run = studies::run(&study, |_| std::ops::ControlFlow::Continue(()));
/// let Findings::Solid(SolidFindings::Torsion(found)) = &run.findings else { panic!() };
/// // λ³ = 1 + ¼ ψ² R² of a neo-Hookean rod without axial force.
/// assert!((found.states[100].pulled.axial_stretch.powi(3) - 1.0625).abs() < 1e-12);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone)]
pub struct TwistedRod {
    /// The rod in the reference.
    pub tube: Tube,
    /// The law.
    pub law: Law,
    /// Largest twist, rad/m.
    pub twist: f64,
    /// Axial stretch of the rod that is held.
    pub axial_stretch: f64,
    /// Axial force on the other, N.
    pub axial_force: f64,
    /// The torque of the states that are sought, N m.
    pub torque: Option<f64>,
    /// Points of the curves.
    pub points: u32,
}

impl TwistedRod {
    pub(super) const fn held(&self) -> Torsion<'_, Law> {
        Torsion { tube: self.tube, law: &self.law, ends: Ends::Stretch(self.axial_stretch) }
    }

    pub(super) const fn pulled(&self) -> Torsion<'_, Law> {
        Torsion { tube: self.tube, law: &self.law, ends: Ends::Force(self.axial_force) }
    }

    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        let [inner, outer] = [self.tube.inner(), self.tube.outer()].map(|radius| quantity("m", radius));
        let body = if self.tube.is_solid() {
            format!("a rod of radius {outer}")
        } else {
            format!("a tube of radii {inner} and {outer}")
        };
        plan.system = format!("{body}, of {}, twisted by up to {} rad/m", material(&self.law), self.twist);
        plan.method = "loads by quadrature, stretches by Newton's iteration with exact slopes".to_string();
        plan.reason =
            "a twisted rod keeps its circles whatever the law: two stretches are left to be found".to_string();
        plan.compute("held", format!("torque and axial force at the axial stretch {}", self.axial_stretch));
        plan.compute(
            "pulled",
            format!("torque and axial stretch under the axial force {}", quantity("N", self.axial_force)),
        );
        match self.torque {
            Some(torque) => {
                plan.compute("states", format!("all under the axial force that carry {}", quantity("N m", torque)));
            }
            None => plan.skip("states at a torque", "no `torque` is given: stresses are those at the largest twist"),
        }
        plan.skip("buckling", "the axis stays straight");
        (&["torsion.csv", "stress.csv"], &["torsion.svg"])
    }
}
