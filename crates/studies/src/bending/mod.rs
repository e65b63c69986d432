//! A block bent by couples, its curved faces free.
//!
//! ```text
//! r² = 2 A X,  θ = α Y/L,  z = λ Z,    A = L/(α λ),    r₁ r₂ = A L/α                          family 1
//! small strains at λ = 1:  M = ⅓ μ h t³ α/L
//! ```

mod run;

pub use run::BendingCurve;

use piola_solids::isochoric::Isochoric;
use piola_solutions::loads::{Bending, BentBlock, Block};
use piola_solutions::{CurvePoint, LoadCurve, SolutionsError};

use crate::RubberLaw;

/// A block, and how far it is bent.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::loads::Block;
/// use piola_studies::{RubberLaw, bending::BentBlockStudy};
/// use std::ops::ControlFlow;
/// let (block, law) = (Block::new(1.0, 1.0, 1.0)?, RubberLaw::from(NeoHookean::new(1.0)?));
/// let study = BentBlockStudy { block, law, angle: 1.0, axial_stretch: 1.0, moment: None, points: 10 };
/// let (found, _) = study.run(&mut |_| ControlFlow::Continue(()));
/// // r₁ r₂ = 1 and r₂² − r₁² = 2: r² = √2 ± 1.
/// assert!((found.states[9].radii[1].powi(2) - (2.0_f64.sqrt() + 1.0)).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct BentBlockStudy {
    /// The block in the reference.
    pub block: Block,
    /// The law.
    pub law: RubberLaw,
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
    pub(crate) const fn bending(&self) -> Bending<'_, RubberLaw> {
        Bending { block: self.block, law: &self.law, axial_stretch: self.axial_stretch }
    }

    /// The range of angles that is searched for a moment: it begins where the moment is exact to nine digits.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        let slender = self.block.length() / self.block.thickness();
        (self.angle.min(1e-3 * slender).min(1e-2 * self.angle), self.angle)
    }

    /// The block at an angle between its ends, rad.
    ///
    /// # Errors
    /// [`SolutionsError`]: the law or the quadrature refuses it.
    pub fn state(&self, angle: f64) -> Result<BentBlock, SolutionsError> {
        self.bending().state(angle)
    }

    /// All states of [`range`](Self::range) that carry a moment, N m.
    ///
    /// # Errors
    /// [`SolutionsError`]: no state carries it, with the nearest moment that one does.
    pub fn states_at(&self, moment: f64) -> Result<Vec<CurvePoint>, SolutionsError> {
        self.bending().states_at(moment, self.range())
    }

    /// M of a small angle, ⅓ μ h t³ α/L; for no other stretch along the axis than 1.
    #[must_use]
    pub fn small_strain_moment(&self, angle: f64) -> Option<f64> {
        let rigidity = self.law.shear_modulus() / 3.0 * self.block.height() * self.block.thickness().powi(3);
        ((self.axial_stretch - 1.0).abs() <= 0.0).then(|| rigidity * angle / self.block.length())
    }
}
