//! Sections of the motions of Hénon and Heiles, with their Lyapunov exponents.
//!
//! ```text
//! H = ½(p_x² + p_y² + x² + y²) + x²y − y³/3,    x = 0, ẋ > 0
//! ```
//! M. Hénon and C. Heiles, Astronomical Journal 69 (1964) 73.

mod build;
mod figure;
mod run;

pub use run::{Motion, Section, Sections};

use piola_dynamics::hamiltonian::PhaseFunction;
use piola_numerics::Real;

use super::StudyPlan;

/// Sections at some energies.
#[derive(Debug, Clone)]
pub struct HenonHeiles {
    /// Energies, at most 1/6.
    pub energies: Vec<f64>,
    /// Motions at each.
    pub orbits: u32,
    /// Crossings of each motion.
    pub crossings: u32,
    /// Time over which the exponents are taken.
    pub duration: f64,
    /// Relative tolerance of a step.
    pub tolerance: f64,
}

/// The Hamiltonian.
#[derive(Debug, Clone, Copy)]
pub(super) struct Potential;

impl PhaseFunction for Potential {
    fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
        let (x, y) = (q[0], q[1]);
        T::lit(0.5) * (p[0] * p[0] + p[1] * p[1] + x * x + y * y) + x * x * y - y * y * y / T::lit(3.0)
    }
}

/// The surface x = 0.
#[derive(Debug, Clone, Copy)]
struct Abscissa;

impl PhaseFunction for Abscissa {
    fn value<T: Real>(&self, q: &[T], _p: &[T], _t: T) -> T {
        q[0]
    }
}

impl HenonHeiles {
    /// Fills a plan; the tables and figures of this study.
    pub(super) fn plan(&self, plan: &mut StudyPlan) -> (&'static [&'static str], &'static [&'static str]) {
        let count = self.energies.len();
        plan.system = format!(
            "sections of {} motions of Hénon and Heiles at {count} energ{}",
            count * self.orbits as usize,
            if count == 1 { "y" } else { "ies" }
        );
        plan.method = format!("dormand-prince-853, relative tolerance {:e}", self.tolerance);
        plan.reason =
            "crossings are found on the continuous extension of each step; the change of the energy is stated"
                .to_string();
        let crossings = format!("{} crossings of x = 0 upwards by each motion", self.crossings);
        let time = run::LONGEST_TURN * f64::from(self.crossings);
        plan.compute("sections", format!("{crossings}, or as many as the time {time} has"));
        plan.compute("Lyapunov exponents", format!("the largest of each motion, over the time {}", self.duration));
        plan.skip("the other exponents", "two vanish and the last is the negative of the first");
        (&["section.csv", "exponents.csv"], &["section.svg"])
    }
}
