//! What the plan says of a Hamiltonian and its questions.

use super::Plan;
use crate::model::PhaseSystem;

/// The tables of answers.
pub(super) fn tables(system: &PhaseSystem) -> impl Iterator<Item = &'static str> {
    let questions = &system.questions;
    let tables = [
        ("works.csv", system.hamiltonian.0.depends_on_time()),
        ("section.csv", questions.section.is_some()),
        ("exponent.csv", questions.exponent),
    ];
    tables.into_iter().filter(|(_, written)| *written).map(|(name, _)| name)
}

/// The figures besides that of the invariants.
pub(super) fn figures(system: &PhaseSystem) -> impl Iterator<Item = &'static str> {
    let section = system.questions.section.is_some();
    ["phase.svg"].into_iter().chain(section.then_some("section.svg"))
}

impl Plan {
    pub(super) fn phase_items(&mut self, system: &PhaseSystem) {
        self.compute("Hamilton's equations", "by exact derivatives of H");
        if system.hamiltonian.0.depends_on_time() {
            self.compute("energy less work", "∫ ∂H/∂t dt is integrated with the motion");
        } else {
            self.compute("energy", "conserved: at every recorded instant");
            self.skip("work", "H does not depend on time");
        }
        match &system.questions.section {
            Some((_, most)) => {
                self.compute(
                    "Poincaré section",
                    format!("at most {most} crossings until the end, by a run of its own"),
                );
            }
            None => self.skip("Poincaré section", "no questions.section"),
        }
        if system.questions.exponent {
            self.compute("largest Lyapunov exponent", "by exact variations, 400 intervals over the time");
        } else {
            self.skip("Lyapunov exponent", "questions.exponent = false");
        }
    }
}
