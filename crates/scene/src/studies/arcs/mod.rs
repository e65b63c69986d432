//! All extremals between two events under Kepler's attraction.
//!
//! ```text
//! H = |p|²/2m − m μ/r,    dG = p₁·dq₁ − p₀·dq₀ − H₁ dt₁ + H₀ dt₀                              W(13.8)
//! ```
//!
//! They lie in the plane of the two places and the centre, in which they are sought, with lengths in units of the first
//! distance and times in units of √(r³/μ).

mod build;
mod figure;
mod lambert;
mod run;

pub use run::{Arc, Arcs};

use nalgebra::Vector3;
use piola_dynamics::hamiltonian::PhaseFunction;
use piola_numerics::Real;

use super::StudyPlan;

/// Two events about a centre.
#[derive(Debug, Clone)]
pub struct KeplerArcs {
    /// μ, m³/s².
    pub gm: f64,
    /// m, kg.
    pub mass: f64,
    /// Place of the first event, m.
    pub from: Vector3<f64>,
    /// Place of the second event, m.
    pub to: Vector3<f64>,
    /// Time between them, s.
    pub duration: f64,
}

/// |p|²/2 − 1/r in the plane.
#[derive(Debug, Clone, Copy)]
struct Kepler;

impl PhaseFunction for Kepler {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1]) - (q[0] * q[0] + q[1] * q[1]).sqrt().recip()
    }
}

impl KeplerArcs {
    /// The units of length and time: |q₀| and √(|q₀|³/μ).
    fn units(&self) -> (f64, f64) {
        let length = self.from.norm();
        (length, (length * length * length / self.gm).sqrt())
    }

    /// The longest time between the events for which all arcs are sought, s.
    fn longest(&self) -> f64 {
        let (length, unit) = self.units();
        lambert::longest(1.0, self.to.norm() / length, (self.to - self.from).norm() / length) * unit
    }

    /// Unit vectors of the plane: towards the first event, and at right angles to it on the side of the second.
    fn plane(&self) -> [Vector3<f64>; 2] {
        let first = self.from.normalize();
        [first, (self.to - first * first.dot(&self.to)).normalize()]
    }

    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        plan.system = format!("extremals between two events {} s apart about a centre", self.duration);
        plan.method = "shooting from the arcs of Lambert's theorem, dormand-prince-853".to_string();
        plan.reason =
            "the theorem says how many arcs there are; each is then found by Newton's iteration with exact variations"
                .to_string();
        plan.compute("sheets", "every arc, of any number of revolutions, both ways round");
        plan.compute("gradients of the distance", "momenta and energies at both ends");
        plan.compute(
            "conjugate points",
            "with their multiplicity: the Morse index of variations in the plane of the arcs",
        );
        plan.compute(
            "Delaunay's elements",
            "of each arc; its radial action by quadrature of the separated integral too",
        );
        plan.skip("arcs out of the plane", "there are none: the places are not in line with the centre");
        plan.skip("variations out of the plane", "each half turn about the centre adds one to the index in space");
        (&["sheets.csv", "arcs.csv"], &["arcs.svg"])
    }
}
