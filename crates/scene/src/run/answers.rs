//! Answers to the questions of a scene.

use core::ops::ControlFlow;

use piola_simulation::Outcome;
use piola_simulation::motion::{History, Progress};
use piola_simulation::phase::PhaseAnswers;
use piola_simulation::questions::MechanismAnswers;

use crate::model::{Scene, System};

/// Answers to the questions of a scene.
#[derive(Debug, Clone)]
pub enum Answers {
    /// Of a Hamiltonian.
    Phase(PhaseAnswers),
    /// Of a mechanism, or why there are none.
    Mechanism(Result<MechanismAnswers, String>),
}

/// The answers, and how the search for them ended; nothing where nothing is asked.
pub(super) fn answers(
    scene: &Scene,
    history: &History,
    last: Option<Progress>,
    observer: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Option<(Answers, Outcome)> {
    match &scene.system {
        System::Phase(system) if !system.questions.is_empty() => {
            let (answers, outcome) = system.answers(scene.time, history, &mut |_| match last {
                Some(progress) => observer(progress),
                None => ControlFlow::Continue(()),
            });
            Some((Answers::Phase(answers), outcome))
        }
        System::Mechanism(system) if system.questions.equilibrium || system.questions.modes => {
            let answers = system.answers(scene.time.start).map_err(|error| error.to_string());
            Some((Answers::Mechanism(answers), Outcome::Completed))
        }
        _ => None,
    }
}
