//! Validity of the solution of a flow.

use std::fmt;

/// A reason to distrust a viscometric solution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Warning {
    /// The flow need not stay laminar.
    Turbulence {
        /// The Reynolds number.
        reynolds: f64,
        /// The one up to which it does.
        critical: f64,
    },
    /// The flow is not developed over most of its length.
    Entry {
        /// The length of the duct, m.
        length: f64,
        /// The length that the flow takes to develop, m.
        developing: f64,
    },
    /// Vortices of Taylor between cylinders.
    Vortices {
        /// Taylor's number.
        taylor: f64,
        /// The one from which they grow.
        critical: f64,
    },
    /// The ends of the gap are near.
    Ends {
        /// The extent of the sheared layer over its thickness.
        ratio: f64,
        /// The least that keeps effects of the ends below some per cent.
        least: f64,
    },
    /// Inertia turns a secondary flow that adds more than 1 % to the torque.
    SecondaryFlow {
        /// The Reynolds number.
        reynolds: f64,
        /// That at which 1 % is reached.
        critical: f64,
    },
    /// The angle of a cone is so wide that the shear rate varies by more than 1 %.
    WideCone {
        /// The angle, rad.
        angle: f64,
        /// That at which 1 % is reached, rad.
        greatest: f64,
    },
    /// Waves grow on a film.
    Waves {
        /// The Reynolds number.
        reynolds: f64,
        /// The one from which they grow.
        critical: f64,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Turbulence { reynolds, critical } => {
                write!(out, "the flow need not be laminar: Re = {reynolds:.3e} is above {critical}")
            }
            Self::Entry { length, developing } => {
                write!(out, "the flow develops over {developing:.3e} m of a length of {length:.3e} m")
            }
            Self::Vortices { taylor, critical } => {
                write!(out, "Taylor's vortices: Ta = {taylor:.3e} is above {critical}")
            }
            Self::Ends { ratio, least } => {
                write!(out, "the ends are near: the layer is {ratio:.3} thicknesses long, less than {least}")
            }
            Self::SecondaryFlow { reynolds, critical } => {
                write!(out, "inertia adds more than 1 % to the torque: Re = {reynolds:.3e} is above {critical}")
            }
            Self::WideCone { angle, greatest } => {
                write!(out, "the shear rate varies in the gap: the angle {angle:.3} rad is above {greatest}")
            }
            Self::Waves { reynolds, critical } => {
                write!(out, "waves grow on the film: Re = {reynolds:.3e} is above {critical:.3e}")
            }
        }
    }
}

/// The Reynolds number of a flow and the reasons, at most two, to distrust its solution.
///
/// # Example
/// ```
/// use piola_fluids::Newtonian;
/// use piola_viscometry::{Poiseuille, Warning};
/// let water = Newtonian::new(0.001)?;
/// let pipe = Poiseuille::with_discharge(0.01, 1e-4, &water)?;
/// let validity = pipe.validity(&water, 1000.0, 0.5)?;
/// assert!((validity.reynolds_number - 6366.2).abs() < 0.1); // 2 ρ Q/(π μ R)
/// assert!(matches!(validity.warnings().next(), Some(Warning::Turbulence { .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Validity {
    /// The Reynolds number, as the flow's own page defines it.
    pub reynolds_number: f64,
    warnings: [Option<Warning>; 2],
}

impl Validity {
    /// Those of the warnings that hold.
    pub(crate) fn new(reynolds_number: f64, candidates: [(bool, Warning); 2]) -> Self {
        Self { reynolds_number, warnings: candidates.map(|(holds, warning)| holds.then_some(warning)) }
    }

    /// The reasons to distrust the solution.
    pub fn warnings(&self) -> impl Iterator<Item = Warning> + '_ {
        self.warnings.iter().copied().flatten()
    }

    /// Whether no reason is known to distrust the solution.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.warnings().next().is_none()
    }
}
