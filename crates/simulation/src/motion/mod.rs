//! Motions of systems made of data, recorded at instants with their invariants.
//!
//! | system | equations | invariants |
//! |---|---|---|
//! | [`Gravitation`] | ẍᵢ = Σⱼ Gmⱼ (xⱼ − xᵢ)/(rᵢⱼ² + ε²)^(3/2), with a post-Newtonian term on request | energy, momentum, angular momentum |
//! | [`Central`] | ẍᵢ = −Gm xᵢ/rᵢ³, or Kepler's closed form with [`Method::ClosedForm`] | energy, angular momentum |
//! | [`Mechanism`](crate::joints::Mechanism) | Lagrange's of its tree of joints; Hamilton's with [`Method::GaussLegendre`] | energy less the works of its forces |
//! | [`PhaseSystem`](crate::phase::PhaseSystem) | q̇ = ∂H/∂p, ṗ = −∂H/∂q | energy less ∫ ∂H/∂t dt |

mod any_field;
pub(crate) mod checkpoint;
mod drive;
mod energies;
mod history;
mod islands;
mod mechanism;
mod memory;
mod method;
mod phase;
mod system;
mod systems;
mod timetable;
mod together;

use core::ops::ControlFlow;

use piola_integrators::{Ending, Report};

pub use checkpoint::{CheckpointKeeper, MotionCheckpoint};
pub use history::{Drift, DriftAt, Drifts, History, Invariants, PartReaction, Scaled};
pub use method::Method;
pub use system::{Central, Gravitation, MassPoint, NEWTONIAN_CONSTANT, Orbiter, PostNewtonian, System};
pub use timetable::{TimeSpan, Timetable};
pub use together::{TOGETHER, simulate_together};

use crate::{Outcome, SimulationError};
use checkpoint::{Marks, Part};
use drive::{Driver, Keeper, Observer};

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
    driven(system, method, timetable, (None, None), observer)
}

/// As [`simulate`], with checkpoints: the run begins at one if there is one, and gives others to their keeper. A run that its
/// observer stops gives a last one.
///
/// The record is the same, to the last bit, as that of [`simulate`].
///
/// # Errors
/// [`SimulationError::CheckpointOfOtherVersion`], [`SimulationError::CheckpointOfOtherRun`],
/// [`SimulationError::CheckpointChanged`].
///
/// # Example
/// ```
/// use piola_simulation::motion::{CheckpointKeeper, MotionCheckpoint};
/// use piola_simulation::motion::{Central, Method, Orbiter, System, TimeSpan, Timetable, resume, simulate};
/// use std::ops::ControlFlow;
/// /// Keeps the checkpoint after the tenth step.
/// struct Tenth(u32, Option<MotionCheckpoint>);
/// impl CheckpointKeeper for Tenth {
///     fn is_due(&mut self) -> bool {
///         self.0 += 1;
///         self.0 == 10
///     }
///     fn keep(&mut self, checkpoint: &MotionCheckpoint) {
///         self.1 = Some(checkpoint.clone());
///     }
/// }
/// let comet = Orbiter { name: "comet".into(), mass: 1.0, position: [1.0, 0.0, 0.0], velocity: [0.0, 1.2, 0.0] };
/// let system = System::Central(Central { gm: 1.0, bodies: vec![comet] });
/// let timetable = Timetable::new(TimeSpan { start: 0.0, end: 50.0 }, 11, &[]);
/// let method = Method::Verner { tolerance: 1e-12 };
/// let mut keeper = Tenth(0, None);
/// let whole = resume(&system, method, &timetable, None, &mut keeper, &mut |_| ControlFlow::Continue(()))?;
/// assert!(keeper.1.as_ref().is_some_and(|kept| 0.0 < kept.time() && kept.time() < 50.0));
/// let kept = keeper.1.take();
/// let continued = resume(&system, method, &timetable, kept, &mut keeper, &mut |_| ControlFlow::Continue(()))?;
/// assert_eq!((continued.history, continued.steps), (whole.history, whole.steps));
/// # Ok::<(), piola_simulation::SimulationError>(())
/// ```
pub fn resume(
    system: &System,
    method: Method,
    timetable: &Timetable,
    checkpoint: Option<MotionCheckpoint>,
    keeper: &mut dyn CheckpointKeeper,
    observer: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<MotionRun, SimulationError> {
    if let Some(checkpoint) = &checkpoint {
        checkpoint.check(system, method, timetable)?;
    }
    let keeper: Keeper<'_> = (keeper, Marks::of(system, method, timetable));
    Ok(driven(system, method, timetable, (Some(keeper), checkpoint), observer))
}

fn driven<'o>(
    system: &System,
    method: Method,
    timetable: &Timetable,
    (keeper, checkpoint): (Option<Keeper<'o>>, Option<MotionCheckpoint>),
    observer: Observer<'o>,
) -> MotionRun {
    if let System::Mechanism(system) = system
        && let Some(islands) = islands::of(system, method)
    {
        return islands::run(system, &islands, method, timetable, (keeper, checkpoint), observer);
    }
    let names = system.names().into_iter().map(str::to_string).collect();
    let mut driver = Driver::new(names, timetable, observer, (keeper, checkpoint));
    let result = match system {
        System::Gravitation(system) => systems::gravitation(system, method, &mut driver),
        System::Mechanism(system) => mechanism::mechanism(system, method, &mut driver),
        System::Central(system) => systems::central(system, method, &mut driver),
        System::Phase(system) => phase::phase(system, method, &mut driver),
    };
    MotionRun::of(driver.finish().0, result)
}

impl MotionRun {
    fn of(Part { history, report, time }: Part, result: Result<(), String>) -> Self {
        let outcome = match result {
            Err(why) => Outcome::Failed(why),
            Ok(()) if report.ending == Ending::Stopped => Outcome::Interrupted,
            Ok(()) => Outcome::Completed,
        };
        let Report { steps, rejected, evaluations, .. } = report;
        Self { outcome, time, steps, rejected, force_evaluations: evaluations, history }
    }
}
