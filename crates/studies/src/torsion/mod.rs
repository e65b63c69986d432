//! Torsion of a rod or a tube, its ends held or under an axial force.
//!
//! ```text
//! θ = Θ + ψ Z,  z = λ Z,    M = 2π ∫ T_θz r² dr,    N = 2π ∫ T_zz r dr                       W(25.10), family 3
//! ```

mod run;

pub use run::{RodCurves, TwistedState};

use piola_solutions::loads::{Ends, Torsion, Tube, TwistedTube};
use piola_solutions::{CurvePoint, LoadCurve, SolutionsError};

use crate::RubberLaw;

/// A rod or a tube, and how far it is twisted.
///
/// # Example
/// ```
/// use piola_solids::isochoric::NeoHookean;
/// use piola_solutions::loads::Tube;
/// use piola_studies::{RubberLaw, torsion::TwistedRod};
/// use std::ops::ControlFlow;
/// let (tube, law) = (Tube::solid(1.0)?, RubberLaw::from(NeoHookean::new(1.0)?));
/// let rod = TwistedRod { tube, law, twist: 0.5, axial_stretch: 1.0, axial_force: 0.0, torque: None, points: 10 };
/// let (found, _) = rod.run(&mut |_| ControlFlow::Continue(()));
/// // λ³ = 1 + ¼ ψ² R² of a neo-Hookean rod without axial force.
/// assert!((found.states[10].pulled.axial_stretch.powi(3) - 1.0625).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct TwistedRod {
    /// The rod in the reference.
    pub tube: Tube,
    /// The law.
    pub law: RubberLaw,
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
    pub(crate) const fn held(&self) -> Torsion<'_, RubberLaw> {
        Torsion { tube: self.tube, law: &self.law, ends: Ends::Stretch(self.axial_stretch) }
    }

    pub(crate) const fn pulled(&self) -> Torsion<'_, RubberLaw> {
        Torsion { tube: self.tube, law: &self.law, ends: Ends::Force(self.axial_force) }
    }

    /// The rod held at its axial stretch, at a twist, rad/m.
    ///
    /// # Errors
    /// [`SolutionsError`]: the law or the quadrature refuses it.
    pub fn held_at(&self, twist: f64) -> Result<TwistedTube, SolutionsError> {
        self.held().state(twist)
    }

    /// The rod under its axial force, at a twist, rad/m.
    ///
    /// # Errors
    /// As [`held_at`](Self::held_at), and no axial stretch carries the force.
    pub fn pulled_at(&self, twist: f64) -> Result<TwistedTube, SolutionsError> {
        self.pulled().state(twist)
    }

    /// All states under the axial force that carry a torque, N m.
    ///
    /// # Errors
    /// [`SolutionsError`]: no state carries it, with the nearest torque that one does.
    pub fn states_at(&self, torque: f64) -> Result<Vec<CurvePoint>, SolutionsError> {
        self.pulled().states_at(torque, (0.0, self.twist))
    }
}
