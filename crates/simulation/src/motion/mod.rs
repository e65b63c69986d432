//! Motions of systems made of data, recorded at instants with their invariants.
//!
//! | system | equations | invariants |
//! |---|---|---|
//! | [`Gravitation`] | ẍᵢ = Σⱼ Gmⱼ (xⱼ − xᵢ)/(rᵢⱼ² + ε²)^(3/2), with a post-Newtonian term on request | energy, momentum, angular momentum |
//! | [`Central`] | ẍᵢ = −Gm xᵢ/rᵢ³ | energy, angular momentum |
//! | [`Mechanism`](crate::joints::Mechanism) | Lagrange's of its tree of joints; Hamilton's with [`Method::GaussLegendre`] | energy less the works of its forces |
//! | [`PhaseSystem`](crate::phase::PhaseSystem) | q̇ = ∂H/∂p, ṗ = −∂H/∂q | energy less ∫ ∂H/∂t dt |

mod drive;
mod energies;
mod history;
mod mechanism;
mod method;
mod phase;
mod system;
mod systems;
mod timetable;

use core::ops::ControlFlow;

use piola_integrators::{Ending, Report};

pub use history::{Drift, DriftAt, Drifts, History, Invariants, PartReaction, Scaled};
pub use method::Method;
pub use system::{Central, Gravitation, MassPoint, NEWTONIAN_CONSTANT, Orbiter, PostNewtonian, System};
pub use timetable::{TimeSpan, Timetable};

use crate::Outcome;
use drive::Driver;

/// The progress of a run.
///
/// # Example
/// See [`simulate`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Progress {
    /// Time reached, s.
    pub time: f64,
    /// Part of the span that is done, 0 to 1.
    pub fraction: f64,
    /// Steps so far.
    pub steps: u64,
}

/// A run with all that it recorded, however far it came.
///
/// # Example
/// See [`simulate`].
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MotionRun {
    /// How it ended.
    pub outcome: Outcome,
    /// Time reached, s.
    pub time: f64,
    /// Accepted steps.
    pub steps: u64,
    /// Steps tried and rejected.
    pub rejected: u64,
    /// Evaluations of the forces.
    pub force_evaluations: u64,
    /// The record.
    pub history: History,
}

/// Integrates the motion of a system and records it at the instants of a timetable. The observer sees the progress after every
/// step and may stop the run.
///
/// A run that fails or is stopped returns what it recorded until then. It fails where the method does not fit the system (an
/// explicit composition needs forces that depend on positions alone) or the data are not valid.
///
/// # Example
/// ```
/// use piola_integrators::Order;
/// use piola_simulation::Outcome;
/// use piola_simulation::motion::{Gravitation, MassPoint, Method, System, TimeSpan, Timetable, simulate};
/// use std::ops::ControlFlow;
/// // Two equal bodies on a circle about their centre: Gm = 1 each, distance 2, speed 1/2, period 4 pi.
/// let body = |name: &str, side: f64| {
///     MassPoint { name: name.into(), gm: 1.0, position: [side, 0.0, 0.0], velocity: [0.0, 0.5 * side, 0.0] }
/// };
/// let bodies = vec![body("right", 1.0), body("left", -1.0)];
/// let system = System::Gravitation(Gravitation { bodies, softening: 0.0, post_newtonian: None });
/// let timetable = Timetable::new(TimeSpan { start: 0.0, end: 2.0 * std::f64::consts::PI }, 2, &[]);
/// let method = Method::Composition { order: Order::Eight, step: 0.1 };
/// let run = simulate(&system, method, &timetable, &mut |_| ControlFlow::Continue(()));
/// assert_eq!((run.outcome, run.steps), (Outcome::Completed, 63));
/// let [x, y, _] = run.history.positions[1][0]; // half a turn
/// assert!((x + 1.0).abs() < 1e-11 && y.abs() < 1e-11);
/// ```
pub fn simulate(
    system: &System,
    method: Method,
    timetable: &Timetable,
    observer: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> MotionRun {
    let names = system.names().into_iter().map(str::to_string).collect();
    let mut driver = Driver::new(names, timetable, observer);
    let result = match system {
        System::Gravitation(system) => systems::gravitation(system, method, &mut driver),
        System::Mechanism(system) => mechanism::mechanism(system, method, &mut driver),
        System::Central(system) => systems::central(system, method, &mut driver),
        System::Phase(system) => phase::phase(system, method, &mut driver),
    };
    let (history, report, time) = driver.finish();
    let outcome = match result {
        Err(why) => Outcome::Failed(why),
        Ok(()) if report.ending == Ending::Stopped => Outcome::Interrupted,
        Ok(()) => Outcome::Completed,
    };
    let Report { steps, rejected, evaluations, .. } = report;
    MotionRun { outcome, time, steps, rejected, force_evaluations: evaluations, history }
}
