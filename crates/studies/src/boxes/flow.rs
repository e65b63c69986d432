//! A creeping flow and the map of its particles.

use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, FlowReport, SpectralError, ViscousFlow};

use super::checkpoint::{Body, BoxCheckpoint, FlowBody, Keeper};
use super::instant::FlowInstant;
use super::map::{middle_height, points_with_stride};
use super::statics::solve_for_loads;
use super::{BoxFields, FlowTask, MOST_BYTES, MOST_STEPS, Probe};
use crate::{Observer, PlaneSamples};

/// Spacings that the fastest particle crosses in a step that is chosen here.
const CHOSEN_COURANT_NUMBER: f64 = 0.5;
/// Beyond this the method is not stable.
const LARGEST_COURANT_NUMBER: f64 = 0.8;
/// How often a step that is chosen here is halved when it folds the map.
const HALVINGS: u32 = 10;
/// Points of the figure along the longer side.
const SHOWN: f64 = 96.0;

/// A recorded flow.
///
/// # Example
/// See [`BoxStudy`](super::BoxStudy).
#[derive(Debug, Clone)]
pub struct FlowHistory<const D: usize> {
    /// The grid.
    pub grid: BoxGrid<D>,
    /// Time from the start to the end, s.
    pub duration: f64,
    /// The velocity at the points of the grid, m/s; empty until it is known.
    pub velocity: [Vec<f64>; D],
    /// The steps.
    pub instants: Vec<FlowInstant>,
    /// Points of the grid, and where their particles were at first, m.
    pub particles: Vec<([f64; D], [f64; D])>,
    /// Only each of so many points along each axis is in `particles`.
    pub stride: usize,
    /// The probes, and where their particles were at first, m.
    pub probes: Vec<(Probe<D>, [f64; D])>,
    /// The first two coordinates that particles of the middle slice had at first.
    pub coordinates: Option<[PlaneSamples; 2]>,
}

impl<const D: usize> FlowHistory<D> {
    pub(super) fn of(task: &FlowTask<D>) -> Self {
        Self {
            grid: task.grid,
            duration: task.duration,
            velocity: core::array::from_fn(|_| Vec::new()),
            instants: Vec::new(),
            particles: Vec::new(),
            stride: 1,
            probes: Vec::new(),
            coordinates: None,
        }
    }

    /// Follows the flow to its end; false when the observer stopped it.
    pub(super) fn follow(
        &mut self,
        (fields, task): (&BoxFields<D>, &FlowTask<D>),
        (from, keeper): (Option<FlowBody>, Keeper<'_>),
        observer: &mut Observer<'_>,
    ) -> Result<bool, String> {
        let words = |error: SpectralError| error.to_string();
        let mut solver = BoxSolver::new(task.grid, fields.walls, BoxOperator::elastic(fields.lame)).map_err(words)?;
        if let Some(modes) = task.modes {
            solver = solver.with_truncation(modes);
        }
        (self.velocity, _) = solve_for_loads(fields, &mut solver, task.modes.is_some()).map_err(words)?;
        let (mut flow, now, step) = match from {
            Some(body) => {
                let (flow, now, step);
                (flow, now, step, self.instants) = body.restore(solver, task).map_err(words)?;
                (flow, now, step)
            }
            None => (ViscousFlow::new(solver, task.least_jacobian).map_err(words)?, 0.0, self.first_step(task)?),
        };
        let advanced = self.advance(&mut flow, (fields, task), (now, step), keeper, observer);
        // However far it came, the map so far is kept.
        self.map(&flow, fields).map_err(words)?;
        advanced
    }

    fn advance(
        &mut self,
        flow: &mut ViscousFlow<f64, D>,
        (fields, task): (&BoxFields<D>, &FlowTask<D>),
        (mut now, mut step): (f64, f64),
        mut keeper: Keeper<'_>,
        observer: &mut Observer<'_>,
    ) -> Result<bool, String> {
        let one_map = 8.0 * (D * task.grid.len()) as f64;
        while now < task.duration {
            // The last step ends at the end, and none is only rounding.
            let left = task.duration - now;
            let h = if left < step * (1.0 + 1e-9) { left } else { step };
            let report = match flow.step(self.velocity.each_ref().map(Vec::as_slice), h) {
                Ok(report) => report,
                Err(SpectralError::Folded { .. }) if task.step.is_none() && self.finest(task) < step => {
                    step *= 0.5;
                    continue;
                }
                Err(error @ SpectralError::Folded { .. }) => return Err(format!("{error}; a shorter `step` may pass")),
                Err(error) => return Err(error.to_string()),
            };
            now = if h < left { now + h } else { task.duration };
            self.record(flow, report, now);
            if MOST_BYTES < fields.bytes() + one_map * flow.regriddings() as f64 {
                let (count, most) = (flow.regriddings(), MOST_BYTES / 1_073_741_824.0);
                return Err(format!("{count} displacements that were put away take more than {most} GiB"));
            }
            let stopped = observer(now / task.duration).is_break();
            if let Some(keeper) = &mut keeper
                && (stopped || keeper.is_due())
            {
                keeper.keep(&BoxCheckpoint::new(fields, Body::Flow(FlowBody::of(flow, (now, step), &self.instants))));
            }
            if stopped {
                return Ok(task.duration <= now);
            }
        }
        Ok(true)
    }

    /// The rate at which the fastest particle crosses spacings, 1/s.
    fn crossing_rate(&self) -> f64 {
        let spacings = self.grid.spacings();
        let rates = self.velocity.iter().zip(spacings).flat_map(|(list, h)| list.iter().map(move |v| v.abs() / h));
        rates.fold(0.0, f64::max)
    }

    fn first_step(&self, task: &FlowTask<D>) -> Result<f64, String> {
        let rate = self.crossing_rate();
        if let Some(step) = task.step {
            if LARGEST_COURANT_NUMBER < rate * step {
                let (crossed, most) = (rate * step, LARGEST_COURANT_NUMBER / rate);
                return Err(format!(
                    "the fastest particle crosses {crossed:.3} spacings in a step, and {LARGEST_COURANT_NUMBER} are \
                     stable: a `step` of at most {most:.6e} s"
                ));
            }
            let count = task.duration / step;
            if !(0.0 < step && count <= MOST_STEPS) {
                return Err(format!("{count:.0} steps are needed, more than {MOST_STEPS}: a longer `step`"));
            }
            return Ok(step);
        }
        let count = (task.duration * rate / CHOSEN_COURANT_NUMBER).ceil().max(1.0);
        if count <= MOST_STEPS {
            return Ok(task.duration / count);
        }
        Err(format!("{count:.0} steps are needed, more than {MOST_STEPS}: a shorter `duration`, or fewer `points`"))
    }

    /// The least step to which one that is chosen here is halved.
    fn finest(&self, task: &FlowTask<D>) -> f64 {
        self.first_step(task).unwrap_or(task.duration) * 0.5_f64.powi(HALVINGS.cast_signed())
    }

    fn record(&mut self, flow: &ViscousFlow<f64, D>, report: FlowReport, time: f64) {
        self.instants.push(FlowInstant {
            time,
            least_jacobian: report.least_jacobian,
            certified_jacobian: flow.certified_jacobian(),
            courant_number: report.largest_courant_number,
            regriddings: flow.regriddings(),
        });
    }

    /// Where particles came from: of the table, of the probes, of the figure.
    fn map(&mut self, flow: &ViscousFlow<f64, D>, fields: &BoxFields<D>) -> Result<(), SpectralError> {
        let (points, stride) = points_with_stride(&self.grid);
        self.stride = stride;
        for point in points {
            let place = self.grid.position(self.grid.indices(point));
            self.particles.push((place, flow.reference_position(place)?));
        }
        let sides = self.grid.sides();
        for probe in &fields.probes {
            // The sides of the grid, points times spacing, are those of the study but for rounding.
            let place = core::array::from_fn(|axis| probe.at[axis].min(sides[axis]));
            self.probes.push((probe.clone(), flow.reference_position(place)?));
        }
        let middle = middle_height(&self.grid);
        let [wide, tall] = [sides[0], sides[1]];
        let spacing = wide.max(tall) / SHOWN;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 3 to SHOWN + 1")]
        let count = [wide, tall].map(|side| (side / spacing).round().max(2.0) as usize + 1);
        let mut coordinates = [Vec::new(), Vec::new()];
        for j in 0..count[1] {
            for i in 0..count[0] {
                let mut place = [0.0; D];
                place[0] = (wide * i as f64 / (count[0] - 1) as f64).min(wide);
                place[1] = (tall * j as f64 / (count[1] - 1) as f64).min(tall);
                if let Some(height) = middle {
                    place[D - 1] = height;
                }
                let at_first = flow.reference_position(place)?;
                coordinates[0].push(at_first[0]);
                coordinates[1].push(at_first[1]);
            }
        }
        let spacing = [wide / (count[0] - 1) as f64, tall / (count[1] - 1) as f64];
        let samples = |values| PlaneSamples { origin: [0.0; 2], spacing, points: count, values };
        self.coordinates = Some(coordinates.map(samples));
        Ok(())
    }
}
