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
        ("brackets.csv", !questions.brackets.is_empty()),
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
        for bracket in &system.questions.brackets {
            self.compute(&format!("bracket `{}`", bracket.name), "at every recorded instant, by exact derivatives");
        }
        if system.questions.brackets.is_empty() {
            self.skip("Poisson brackets", "no [[bracket]]");
        }
        if system.questions.new_variables.is_some() {
            self.compute("canonical test", "of the new coordinates, by their exact Jacobian at every recorded instant");
        } else {
            self.skip("canonical test", "no [[new_coordinate]]");
        }
    }
}
