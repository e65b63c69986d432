//! A crystal with screw dislocations along an axis.
//!
//! ```text
//! K⁻¹ = [1 0 0; 0 1 0; −q y  q x  1]        b = ∮ K⁻¹ dX
//! uniform:  q = ρ/2,                 density ρ
//! core:     q = (b/2π)/(r² + c²),    density (b/π) c²/(r² + c²)²,    within r:  b r²/(r² + c²)
//! ```

mod run;

pub use run::{BurgersCircuit, BurgersCircuits, TorsionAt};

use core::f64::consts::{PI, TAU};

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_uniformity::UniformityMap;

/// A crystal with screws, and circuits in it.
///
/// # Example
/// ```
/// use piola_studies::dislocation::{ScrewDislocations, Screws};
/// use std::ops::ControlFlow;
/// let spread = Screws::Uniform { density: 0.5 };
/// let crystal = ScrewDislocations { spread, radii: vec![1.0], centre: [0.0; 2], tolerance: 1e-9 };
/// let (found, _) = crystal.run(&mut |_| ControlFlow::Continue(()));
/// // Density times area.
/// assert!((found.circuits[0].burgers[2] - 0.5 * std::f64::consts::PI).abs() < 1e-14);
/// ```
#[derive(Debug, Clone)]
pub struct ScrewDislocations {
    /// How the screws are spread.
    pub spread: Screws,
    /// Radii of the circuits, m.
    pub radii: Vec<f64>,
    /// Their centre, m.
    pub centre: [f64; 2],
    /// Relative torsion and curvature of a body that counts as homogeneous.
    pub tolerance: f64,
}

/// How screw dislocations are spread over the plane across them. A uniformity map by its inverse.
///
/// # Example
/// See [`ScrewDislocations`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Screws {
    /// Evenly.
    Uniform {
        /// ρ, Burgers vector per area, 1/m.
        density: f64,
    },
    /// About the axis.
    Core {
        /// b of all, m.
        burgers: f64,
        /// c, m: half of them are within.
        radius: f64,
    },
}

impl UniformityMap for Screws {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        let [x, y, _] = (*reference).into();
        let turn = match *self {
            Self::Uniform { density } => T::lit(0.5 * density),
            Self::Core { burgers, radius } => T::lit(burgers / TAU) / (x * x + y * y + T::lit(radius * radius)),
        };
        let mut dual = Matrix3::identity();
        (dual[(2, 0)], dual[(2, 1)]) = (-(turn * y), turn * x);
        dual
    }
}

impl Screws {
    /// Burgers vector per area at a distance from the axis, 1/m.
    #[must_use]
    pub fn density(&self, distance: f64) -> f64 {
        match *self {
            Self::Uniform { density } => density,
            Self::Core { burgers, radius } => {
                let square = radius * radius;
                burgers / PI * square / (distance * distance + square).powi(2)
            }
        }
    }

    /// Burgers vector of a circle about the axis, m.
    #[must_use]
    pub fn enclosed(&self, radius: f64) -> f64 {
        match *self {
            Self::Uniform { density } => density * PI * radius * radius,
            Self::Core { burgers, radius: core } => burgers * radius * radius / (radius * radius + core * core),
        }
    }
}

impl ScrewDislocations {
    /// The Burgers vector of a circuit in closed form, m: of any circle in even screws, of one about the axis of a core.
    #[must_use]
    pub fn closed_form(&self, radius: f64) -> Option<f64> {
        let is_centred = self.centre.iter().all(|x| x.abs() <= 0.0);
        (is_centred || matches!(self.spread, Screws::Uniform { .. })).then(|| self.spread.enclosed(radius))
    }

    /// The largest radius, m.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.radii.iter().copied().fold(0.0, f64::max)
    }
}
