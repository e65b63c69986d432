//! Wave fronts in a plane medium of refractive index n(x, y).
//!
//! ```text
//! H = |p|/n(q) = 1,    dq/dS = p/n²,    S = ∫ n ds                                          W(13.26–13.28)
//! ```

mod medium;
mod run;

pub use medium::{Medium, MediumPart};
pub use run::{CausticMark, Front, Fronts, MOST_RAYS};

use piola_hamiltonian::hamilton_jacobi::InitialFront;
use piola_numerics::Real;

/// A source in a medium, and how far its fronts are followed.
///
/// # Example
/// ```
/// use piola_studies::Outcome;
/// use piola_studies::fronts::{Medium, MediumPart, Source, Wavefront};
/// use std::ops::ControlFlow;
/// let asked = Wavefront {
///     source: Source::Point { place: [0.0; 2], from: 0.0, to: std::f64::consts::TAU },
///     medium: Medium { parts: vec![MediumPart::Uniform { index: 1.5 }] },
///     length: 3.0,
///     fronts: 1,
///     rays: 32,
///     spacing: 0.1,
///     first_only: false,
/// };
/// let (found, outcome) = asked.run(&mut |_| ControlFlow::Continue(()));
/// assert_eq!(outcome, Outcome::Completed);
/// let [x, y] = found.fronts[0].pieces[0][0]; // a circle of radius 3/1.5
/// assert!((x - 2.0).abs() < 1e-12 && y.abs() < 1e-12 && found.caustic.is_empty());
/// ```
#[derive(Debug, Clone)]
pub struct Wavefront {
    /// The source.
    pub source: Source,
    /// The medium.
    pub medium: Medium,
    /// Optical length, m.
    pub length: f64,
    /// Number of fronts.
    pub fronts: u32,
    /// Number of rays to begin with.
    pub rays: u32,
    /// Largest distance of neighbours on a front, m.
    pub spacing: f64,
    /// Whether only what arrives first is kept.
    pub first_only: bool,
}

/// Where fronts start.
///
/// # Example
/// See [`Wavefront`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// A straight front.
    Plane {
        /// Its middle, m.
        middle: [f64; 2],
        /// Unit vector along its rays.
        direction: [f64; 2],
        /// Its width, m.
        width: f64,
    },
    /// One place.
    Point {
        /// The place, m.
        place: [f64; 2],
        /// First direction, rad.
        from: f64,
        /// Last direction, rad; a full turn after the first for all.
        to: f64,
    },
}

impl Source {
    /// The range of the parameter: a length along a straight front, a direction from a point.
    #[must_use]
    pub fn range(&self) -> (f64, f64) {
        match *self {
            Self::Plane { width, .. } => (-0.5 * width, 0.5 * width),
            Self::Point { from, to, .. } => (from, to),
        }
    }

    /// Length of a front after an optical length, m, where the index is one number.
    #[must_use]
    pub fn front(&self, length: f64, index: f64) -> f64 {
        match *self {
            Self::Plane { width, .. } => width,
            Self::Point { from, to, .. } => (to - from) * length / index,
        }
    }

    /// The place in its middle, m.
    #[must_use]
    pub fn middle(&self) -> [f64; 2] {
        match *self {
            Self::Plane { middle, .. } => middle,
            Self::Point { place, .. } => place,
        }
    }

    /// Whether the front closes upon itself.
    #[must_use]
    pub fn closed(&self) -> bool {
        match *self {
            Self::Plane { .. } => false,
            Self::Point { from, to, .. } => core::f64::consts::TAU * (1.0 - 1e-12) <= to - from,
        }
    }
}

impl InitialFront<2, 1> for Source {
    fn at<T: Real>(&self, [along]: [T; 1]) -> [T; 2] {
        match *self {
            Self::Plane { middle: [x, y], direction: [u, v], .. } => {
                [T::lit(x) - T::lit(v) * along, T::lit(y) + T::lit(u) * along]
            }
            Self::Point { place, .. } => place.map(T::lit),
        }
    }
    fn normal<T: Real>(&self, [along]: [T; 1]) -> [T; 2] {
        match *self {
            Self::Plane { direction, .. } => direction.map(T::lit),
            Self::Point { .. } => {
                let (sine, cosine) = along.sin_cos();
                [cosine, sine]
            }
        }
    }
}
