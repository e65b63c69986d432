//! Motions and flows on a box that can be continued.

use piola_simulation::SimulationError;
use piola_simulation::internal::{Marks, Sealed};
use piola_spectral::{BoxSolver, ModalMotion, ModalSeries, SpectralError, ViscousFlow};
use serde::{Deserialize, Serialize};

use super::form::indices;
use super::instant::{FlowInstant, MotionInstant};
use super::{BoxFields, BoxStudy, FlowTask, MotionTask, Task};
use crate::StudyCheckpointKeeper;

/// The state of an interrupted motion or flow on a box, with the instants recorded so far.
///
/// # Example
/// See [`BoxStudy::run_with_checkpoints`].
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(transparent)]
pub struct BoxCheckpoint(Sealed<Body>);

/// Where the checkpoints of a run go.
pub(super) type Keeper<'k> = Option<&'k mut dyn StudyCheckpointKeeper<BoxCheckpoint>>;

/// The state from which a run continues.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) enum Body {
    Motion(MotionBody),
    Flow(FlowBody),
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct MotionBody {
    time: f64,
    steps: usize,
    /// The amplitudes of the modes, components together.
    displacement: Vec<f64>,
    velocity: Vec<f64>,
    /// Time, kinetic and elastic energy and the displacements of the probes of each instant.
    instants: Vec<Vec<f64>>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FlowBody {
    time: f64,
    step: f64,
    /// The displacements of each piece of the map, with its least Jacobian.
    pieces: Vec<(Vec<Vec<f64>>, f64)>,
    instants: Vec<FlowInstant>,
}

impl BoxCheckpoint {
    pub(super) fn new<const D: usize>(fields: &BoxFields<D>, body: Body) -> Self {
        Self(Sealed::new(fields.marks(), body))
    }

    pub(super) fn into_body(self) -> Body {
        self.0.body
    }

    /// Time reached, s.
    #[must_use]
    pub const fn time(&self) -> f64 {
        match &self.0.body {
            Body::Motion(body) => body.time,
            Body::Flow(body) => body.time,
        }
    }

    /// Checks that the checkpoint is of this study and is as it was made.
    ///
    /// # Errors
    /// [`SimulationError`]: it is of another study or another version, or it was changed.
    pub fn check(&self, study: &BoxStudy) -> Result<(), SimulationError> {
        self.0.check(match study {
            BoxStudy::Rectangle(fields) => fields.marks(),
            BoxStudy::Box(fields) => fields.marks(),
        })
    }
}

impl BoxStudy {
    /// Whether a run leaves checkpoints: motions and flows do, equilibrium is found at once.
    #[must_use]
    pub const fn has_checkpoints(&self) -> bool {
        match self {
            Self::Rectangle(fields) => !matches!(fields.task, Task::Static(_)),
            Self::Box(fields) => !matches!(fields.task, Task::Static(_)),
        }
    }
}

impl<const D: usize> BoxFields<D> {
    /// The marks of a run, by all that its record depends on.
    fn marks(&self) -> Marks {
        Marks::of_run(format_args!("{self:?}"))
    }
}

fn amplitudes<const D: usize>(series: &ModalSeries<D>) -> Vec<f64> {
    indices(series.highest()).flat_map(|indices| series.amplitudes(indices)).collect()
}

/// The components of a place or a displacement.
fn components<const D: usize>(list: &[f64]) -> [f64; D] {
    core::array::from_fn(|axis| list.get(axis).copied().unwrap_or(f64::NAN))
}

fn series<const D: usize>(
    fields: &BoxFields<D>,
    highest: [usize; D],
    amplitudes: &[f64],
) -> Result<ModalSeries<D>, SpectralError> {
    let mut series = ModalSeries::zeros(fields.sides, fields.walls, highest)?;
    for (indices, amplitudes) in indices(highest).zip(amplitudes.chunks(D)) {
        series.set_amplitudes(indices, components(amplitudes))?;
    }
    Ok(series)
}

/// Displacement and velocity, time, number of steps, instants.
type MotionState<const D: usize> = ([ModalSeries<D>; 2], f64, usize, Vec<MotionInstant<D>>);
/// The flow, its time, its step, instants.
type FlowState<const D: usize> = (ViscousFlow<f64, D>, f64, f64, Vec<FlowInstant>);

impl MotionBody {
    pub(super) fn of<const D: usize>(
        motion: &ModalMotion<D>,
        (time, steps): (f64, usize),
        instants: &[MotionInstant<D>],
    ) -> Self {
        let row = |instant: &MotionInstant<D>| {
            let numbers = [instant.time, instant.kinetic_energy, instant.elastic_energy];
            numbers.into_iter().chain(instant.displacements.iter().flatten().copied()).collect()
        };
        Self {
            time,
            steps,
            displacement: amplitudes(motion.displacement()),
            velocity: amplitudes(motion.velocity()),
            instants: instants.iter().map(row).collect(),
        }
    }

    /// Displacement and velocity, time, number of steps, instants.
    pub(super) fn restore<const D: usize>(
        self,
        fields: &BoxFields<D>,
        task: &MotionTask<D>,
    ) -> Result<MotionState<D>, SpectralError> {
        let instant = |row: &Vec<f64>| MotionInstant {
            time: row.first().copied().unwrap_or(f64::NAN),
            kinetic_energy: row.get(1).copied().unwrap_or(f64::NAN),
            elastic_energy: row.get(2).copied().unwrap_or(f64::NAN),
            displacements: row.get(3..).unwrap_or_default().chunks(D).map(components).collect(),
        };
        let instants = self.instants.iter().map(instant).collect();
        let state = [series(fields, task.modes, &self.displacement)?, series(fields, task.modes, &self.velocity)?];
        Ok((state, self.time, self.steps, instants))
    }
}

impl FlowBody {
    pub(super) fn of<const D: usize>(
        flow: &ViscousFlow<f64, D>,
        (time, step): (f64, f64),
        instants: &[FlowInstant],
    ) -> Self {
        let pieces = flow.pieces().map(|(lists, least)| (lists.map(<[f64]>::to_vec).to_vec(), least));
        Self { time, step, pieces: pieces.collect(), instants: instants.to_vec() }
    }

    /// The flow, its time, its step, instants.
    pub(super) fn restore<const D: usize>(
        self,
        solver: BoxSolver<f64, D>,
        task: &FlowTask<D>,
    ) -> Result<FlowState<D>, SpectralError> {
        let pieces = self.pieces.into_iter().map(|(mut lists, least)| {
            lists.resize(D, Vec::new());
            let mut lists = lists.into_iter();
            (core::array::from_fn(|_| lists.next().unwrap_or_default()), least)
        });
        Ok((ViscousFlow::from_pieces(solver, task.least_jacobian, pieces)?, self.time, self.step, self.instants))
    }
}
