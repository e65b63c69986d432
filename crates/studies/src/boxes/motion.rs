//! A motion of modes.

use piola_spectral::{BoxOperator, ModalMotion, SpectralError};

use super::checkpoint::{Body, BoxCheckpoint, Keeper, MotionBody};
use super::instant::MotionInstant;
use super::load::Forces;
use super::statics::{finite, series_of};
use super::{BoxFields, Form, MOST_STEPS, MotionTask, Probe};
use crate::Observer;

/// A recorded motion.
///
/// # Example
/// See [`BoxStudy::run_with_checkpoints`](super::BoxStudy::run_with_checkpoints).
#[derive(Debug, Clone)]
pub struct MotionHistory<const D: usize> {
    /// The places that are recorded.
    pub probes: Vec<Probe<D>>,
    /// The instants.
    pub instants: Vec<MotionInstant<D>>,
    /// Steps, each exact.
    pub steps: usize,
    /// Whether neither drag nor loads change the energy.
    pub is_conservative: bool,
}

impl<const D: usize> MotionTask<D> {
    /// The instants after the start: multiples of the interval, then the end.
    pub fn instants(&self) -> impl Iterator<Item = f64> + '_ {
        // A last interval that is only rounding is not one.
        let whole = (self.duration / self.interval * (1.0 + 4.0 * f64::EPSILON)).floor();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and the most steps")]
        let count = whole as u32;
        let times = (1..=count).map(|k| (f64::from(k) * self.interval).min(self.duration));
        let last = times.clone().next_back().unwrap_or(0.0);
        let rest = (4.0 * f64::EPSILON * self.duration < self.duration - last).then_some(self.duration);
        times.chain(rest)
    }
}

impl<const D: usize> BoxFields<D> {
    /// Whether the energy of a motion is constant.
    #[must_use]
    pub fn is_conservative(&self, task: &MotionTask<D>) -> bool {
        self.loads.is_empty() && task.drag <= 0.0
    }
}

impl<const D: usize> MotionHistory<D> {
    pub(super) fn of(fields: &BoxFields<D>, task: &MotionTask<D>) -> Self {
        Self {
            probes: fields.probes.clone(),
            instants: Vec::new(),
            steps: 0,
            is_conservative: fields.is_conservative(task),
        }
    }

    /// Follows the motion to its end; false when the observer stopped it.
    pub(super) fn follow(
        &mut self,
        (fields, task): (&BoxFields<D>, &MotionTask<D>),
        (from, mut keeper): (Option<MotionBody>, Keeper<'_>),
        observer: &mut Observer<'_>,
    ) -> Result<bool, SpectralError> {
        let forms = |is_velocity: bool| -> Vec<&Form<D>> {
            task.starts.iter().filter(|start| start.is_velocity == is_velocity).map(|start| &start.form).collect()
        };
        let intervals = task.duration / task.interval;
        if !(0.0 < intervals && intervals <= MOST_STEPS) {
            let (quantity, bound) = ("duration/interval", "0 < duration/interval <= 100000");
            return Err(SpectralError::OutOfBounds { quantity, value: intervals, bound });
        }
        let is_new = from.is_none();
        let ([displacement, velocity], mut now) = match from {
            Some(body) => {
                let (state, time);
                (state, time, self.steps, self.instants) = body.restore(fields, task)?;
                (state, time)
            }
            None => {
                ([series_of(fields, &forms(false), task.modes)?, series_of(fields, &forms(true), task.modes)?], 0.0)
            }
        };
        let operator = BoxOperator::elastic(fields.lame);
        let mut motion = ModalMotion::new(operator, task.density, task.drag, displacement, velocity)?;
        let mut forces = Forces::new(&fields.loads, (fields.sides, fields.walls, task.modes))?;
        if is_new {
            self.record(&motion, fields, now)?;
        }
        let recorded = self.instants.len().saturating_sub(1);
        for instant in task.instants().skip(recorded) {
            while now < instant {
                let next = instant.min(forces.next_change(now));
                motion.step(next - now, forces.of_step(now)?)?;
                now = next;
                self.steps += 1;
            }
            self.record(&motion, fields, now)?;
            let stopped = observer(now / task.duration).is_break();
            if let Some(keeper) = &mut keeper
                && (stopped || keeper.is_due())
            {
                keeper.keep(&BoxCheckpoint::new(
                    fields,
                    Body::Motion(MotionBody::of(&motion, (now, self.steps), &self.instants)),
                ));
            }
            if stopped {
                return Ok(task.duration <= now);
            }
        }
        Ok(true)
    }

    fn record(&mut self, motion: &ModalMotion<D>, fields: &BoxFields<D>, time: f64) -> Result<(), SpectralError> {
        let displacements = fields.probes.iter().map(|probe| motion.displacement().value(probe.at));
        let instant = MotionInstant {
            time,
            kinetic_energy: motion.kinetic_energy(),
            elastic_energy: motion.elastic_energy(fields.lame),
            displacements: displacements.collect::<Result<_, _>>()?,
        };
        finite("energy", instant.energy())?;
        self.instants.push(instant);
        Ok(())
    }

    /// The largest relative change of the energy since the start, where nothing should change it.
    #[must_use]
    pub fn energy_drift(&self) -> Option<f64> {
        let first = self.instants.first().map(MotionInstant::energy).filter(|energy| 0.0 < *energy)?;
        let change = |instant: &MotionInstant<D>| (instant.energy() - first).abs() / first;
        self.is_conservative.then(|| self.instants.iter().map(change).fold(0.0, f64::max))
    }
}
