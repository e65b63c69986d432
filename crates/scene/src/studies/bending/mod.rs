//! A block bent by couples, its curved faces free.
//!
//! ```text
//! r² = 2 A X,  θ = α Y/L,  z = λ Z,    A = L/(α λ),    r₁ r₂ = A L/α                          family 1
//! small strains at λ = 1:  M = ⅓ μ h t³ α/L
//! ```

mod build;
mod figure;
mod run;

pub use run::BendingCurve;

use piola_solids::isochoric::Isochoric;
use piola_solutions::loads::{Bending, Block};

use super::law::material;
use super::panel::quantity;
use super::{Law, StudyPlan};
use piola_charts::format_short;

/// A block, and how far it is bent.
///
/// # Example
/// ```
/// use piola_scene::studies::{self, Findings, SolidFindings};
/// use piola_scene::{Document, SceneFile};
/// let document = Document::parse("block.toml", "
///     [bending]
///     thickness = 1.0
///     length = 1.0
///     height = 1.0
///     angle = '1 rad'
///     [law]
///     type = 'neo-hookean'
///     shear_modulus = '1 Pa'
/// ");
/// let SceneFile::Study(study) = SceneFile::from_document(&document)? else { panic!() };
/// let run = studies::run(&study, |_| std::ops::ControlFlow::Continue(()));
/// let Findings::Solid(SolidFindings::Bending(found)) = &run.findings else { panic!() };
/// // r₁ r₂ = 1 and r₂² − r₁² = 2: r² = √2 ± 1.
/// assert!((found.states[99].radii[1].powi(2) - (2.0_f64.sqrt() + 1.0)).abs() < 1e-14);
/// # Ok::<(), piola_scene::SceneError>(())
/// ```
#[derive(Debug, Clone)]
pub struct BentBlockStudy {
    /// The block in the reference.
    pub block: Block,
    /// The law.
    pub law: Law,
    /// Largest angle between the ends, rad.
    pub angle: f64,
    /// Stretch along the axis of bending.
    pub axial_stretch: f64,
    /// The moment of the states that are sought, N m.
    pub moment: Option<f64>,
    /// Points of the curve.
    pub points: u32,
}

impl BentBlockStudy {
    pub(super) const fn bending(&self) -> Bending<'_, Law> {
        Bending { block: self.block, law: &self.law, axial_stretch: self.axial_stretch }
    }

    /// The range of angles that is searched for a moment: it begins where the moment is exact to nine digits.
    pub(super) fn range(&self) -> (f64, f64) {
        let slender = self.block.length() / self.block.thickness();
        (self.angle.min(1e-3 * slender).min(1e-2 * self.angle), self.angle)
    }

    /// M of a small angle, ⅓ μ h t³ α/L; for no other stretch along the axis than 1.
    #[must_use]
    pub fn small_strain_moment(&self, angle: f64) -> Option<f64> {
        let rigidity = self.law.shear_modulus() / 3.0 * self.block.height() * self.block.thickness().powi(3);
        ((self.axial_stretch - 1.0).abs() <= 0.0).then(|| rigidity * angle / self.block.length())
    }

    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        let Self { block, angle, .. } = self;
        plan.system = format!(
            "a block {} thick, {} long and {} high, of {}, bent by {} degrees",
            quantity("m", block.thickness()),
            quantity("m", block.length()),
            quantity("m", block.height()),
            material(&self.law),
            format_short(angle.to_degrees())
        );
        plan.method = "moment by quadrature through the thickness".to_string();
        plan.reason = "the two curved faces exchange their stretches whatever the law: both are free of stress at once"
            .to_string();
        plan.compute("moment", format!("over the angle, at the stretch {} along the axis", self.axial_stretch));
        plan.compute("axial force", "that holds the stretch along the axis");
        match self.moment {
            Some(moment) => plan.compute("states", format!("all that carry {}", quantity("N m", moment))),
            None => plan.skip("states at a moment", "no `moment` is given: stresses are those at the largest angle"),
        }
        plan.skip("wrinkles of the inner face", "the solution is the sector's own");
        (&["bending.csv", "stress.csv"], &["bending.svg"])
    }
}
