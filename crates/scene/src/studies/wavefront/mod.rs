//! Wave fronts in a plane medium of refractive index n(x, y).
//!
//! ```text
//! H = |p|/n(q) = 1,    dq/dS = p/n²,    S = ∫ n ds                                          W(13.26–13.28)
//! ```

mod build;
mod figure;
mod medium;
mod run;

pub use medium::{Medium, MediumPart};
pub use run::{CausticMark, Front, Fronts};

use piola_hamiltonian::hamilton_jacobi::InitialFront;
use piola_numerics::Real;

use super::StudyPlan;

/// A source in a medium, and how far its fronts are followed.
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
    fn front(&self, length: f64, index: f64) -> f64 {
        match *self {
            Self::Plane { width, .. } => width,
            Self::Point { from, to, .. } => (to - from) * length / index,
        }
    }

    /// The place in its middle, m.
    fn middle(&self) -> [f64; 2] {
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

impl Wavefront {
    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        let source = match self.source {
            Source::Plane { width, .. } => format!("a plane source {width} m wide"),
            Source::Point { .. } => "a point source".to_string(),
        };
        let parts = self.medium.parts.len();
        plan.system =
            format!("wave fronts from {source} in a medium of {parts} part{}", if parts == 1 { "" } else { "s" });
        plan.method = format!("rays of |p| = n by a method of order 6, {} steps", self.steps());
        plan.reason =
            "H = |p|/n has no terms of p and q apart: explicit, with exact derivatives; its difference from order 4 \
                       is the error stated"
                .to_string();
        plan.compute("fronts", format!("{} levels of the optical length up to {} m", self.fronts, self.length));
        plan.compute(
            "rays",
            format!(
                "{} to begin with; more, up to {}, where neighbours on a front are {} m apart",
                self.rays,
                run::MOST_RAYS,
                self.spacing
            ),
        );
        plan.compute("caustics", "where the Jacobian of the ray map changes sign");
        if self.first_only {
            plan.compute(
                "first arrival",
                "keep = \"first\": swallow-tails and rays that have touched a caustic are cut off",
            );
        } else {
            plan.skip("first arrival", "keep = \"all\": fronts keep all their sheets");
        }
        if self.medium.parts.iter().any(|part| matches!(part, MediumPart::Luneburg { .. })) {
            plan.compute(
                "short steps",
                "the gradient of Luneburg's index jumps on its rim: a step across it is of order one",
            );
        }
        plan.skip("amplitude and diffraction", "rays only");
        (&["fronts.csv", "caustic.csv"], &["fronts.svg"])
    }
}
