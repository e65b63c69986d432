//! Runs a robot and keeps its history.

use core::cell::Cell;
use core::ops::ControlFlow;
use std::rc::Rc;

use piola_integrators::{DormandPrince853, Ending, Field, IntegratorsError, State, Tolerance};
use piola_multibody::{MultibodyError, TreeWorkspace};

use super::RobotStudy;
use piola_simulation::internal::Sealed;

use super::checkpoint::{PIECE, Renewable, RobotCheckpoint, RobotCheckpointBody};
use super::sample::{RobotSample, WORKS};
use crate::{Observer, Outcome, StudyCheckpointKeeper};

/// A run with all that it recorded, however far it came.
///
/// # Example
/// See [`RobotStudy`](super::RobotStudy).
#[derive(Debug, Clone, Default)]
pub struct RobotMotion {
    /// The record.
    pub samples: Vec<RobotSample>,
    /// Accepted steps, rejected ones, evaluations.
    pub cost: [u64; 3],
    /// Time reached, s.
    pub reached: f64,
    /// The largest change of energies less work, over the largest energy or work met.
    pub energy_error: f64,
    /// Singular positions that the run went through, the first 64: times, s, and closures.
    pub singular_positions: Vec<(f64, String)>,
    /// The first instants at which joints are beyond their limits, s, and the joints.
    pub beyond_limits: Vec<(f64, String)>,
    /// The names of the coordinates.
    pub names: Vec<String>,
}

/// Singular positions that are listed.
const LISTED: usize = 64;

/// A run where it begins anew, with the lengths of its record.
struct Piece {
    state: State,
    cost: [u64; 3],
    samples: usize,
    singular_positions: usize,
}

impl Piece {
    fn of(state: &State, found: &RobotMotion) -> Self {
        let (samples, singular_positions) = (found.samples.len(), found.singular_positions.len());
        Self { state: state.clone(), cost: found.cost, samples, singular_positions }
    }

    /// The checkpoint, from a record that may have become longer since.
    fn checkpoint(self, robot: &RobotStudy, found: &RobotMotion) -> RobotCheckpoint {
        let body = RobotCheckpointBody {
            state: self.state,
            samples: found.samples[..self.samples].to_vec(),
            cost: self.cost,
            singular_positions: found.singular_positions[..self.singular_positions].to_vec(),
        };
        RobotCheckpoint::new(robot, body)
    }
}

/// A motion with the works of its forces as numbers more.
struct WithWorks<'a, F> {
    motion: F,
    robot: &'a RobotStudy,
    /// Whether the motion may begin anew.
    apart: Rc<Cell<bool>>,
}

impl<F: Field<Error = MultibodyError> + Renewable> Field for WithWorks<'_, F> {
    type Error = MultibodyError;
    fn dimension(&self) -> usize {
        self.motion.dimension() + WORKS
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), MultibodyError> {
        let n = self.motion.dimension();
        self.motion.rate(t, &y[..n], &mut rate[..n])?;
        self.apart.set(self.motion.is_apart());
        let (q, v) = y[..n].split_at(self.robot.closed.tree().coordinates());
        let powers = self.robot.closed.tree().joint_powers(q, v, self.robot.slip_rate)?;
        let driven = self.robot.drives.iter().zip(v).map(|(drive, &v)| drive.effort * v).sum();
        rate[n..].copy_from_slice(&[driven, powers.damping_power, powers.friction_power]);
        Ok(())
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), MultibodyError> {
        let n = self.motion.dimension();
        self.motion.project(t, &mut y[..n])
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        let n = self.motion.dimension();
        self.motion.magnitudes(&y[..n], &mut magnitudes[..n]);
        // Works follow the motion: their errors decide on no step.
        magnitudes[n..].fill(f64::INFINITY);
    }
}

impl RobotStudy {
    fn drive(&self, q: &[f64], v: &[f64], tau: &mut [f64]) {
        // A state that is refused here is refused by the dynamics, with its reason.
        if self.closed.tree().joint_forces(q, v, self.slip_rate, tau).is_err() {
            tau.fill(f64::NAN);
        }
        for (tau, drive) in tau.iter_mut().zip(&self.drives) {
            *tau += drive.effort;
        }
    }

    /// Runs the study, from a checkpoint or from its start: the results so far and how it ended.
    ///
    /// The observer gets the finished part, from 0 to 1, and may stop the run. A run from a checkpoint is bit for bit the run that was
    /// never stopped. With a checkpoint of another study, or one that was changed, the run fails; so it does with fewer than two
    /// instants to record.
    pub fn run(
        &self,
        from: Option<RobotCheckpoint>,
        keeper: Option<&mut dyn StudyCheckpointKeeper<RobotCheckpoint>>,
        observer: &mut Observer<'_>,
    ) -> (RobotMotion, Outcome) {
        let mut found = RobotMotion { names: self.names[0].clone(), ..RobotMotion::default() };
        if let Some(Err(error)) = from.as_ref().map(|checkpoint| checkpoint.check(self)) {
            return (found, Outcome::Failed(error.to_string()));
        }
        if self.samples < 2 {
            return (found, Outcome::Failed(format!("{} instants to record: at least two are needed", self.samples)));
        }
        let forces = |_t: f64, q: &[f64], v: &[f64], tau: &mut [f64]| self.drive(q, v, tau);
        let outcome = if self.closed.conditions() == 0 {
            self.follow(self.closed.tree().motion(forces), &mut found, (from, keeper), observer)
        } else {
            let motion = self.closed.motion(forces);
            let motion = if self.stops { motion.stopping_at_singular_positions() } else { motion };
            self.follow(motion, &mut found, (from, keeper), observer)
        };
        found.judge(self);
        let outcome = match outcome {
            Ok(Ending::Stopped) => Outcome::Interrupted,
            Ok(_) => Outcome::Completed,
            Err(why) => Outcome::Failed(why),
        };
        (found, outcome)
    }

    fn follow<F: Field<Error = MultibodyError> + Renewable>(
        &self,
        motion: F,
        found: &mut RobotMotion,
        (from, mut keeper): (Option<RobotCheckpoint>, Option<&mut dyn StudyCheckpointKeeper<RobotCheckpoint>>),
        observer: &mut Observer<'_>,
    ) -> Result<Ending, String> {
        let mut motion = WithWorks { motion, robot: self, apart: Rc::new(Cell::new(true)) };
        let (start, end) = (self.time.start, self.time.end);
        found.reached = start;
        let mut y = [&self.start.0[..], &self.start.1, &[0.0; WORKS]].concat();
        let in_words = |error: IntegratorsError| error.to_string();
        let mut state = State::new(start, y.clone()).map_err(in_words)?;
        let tolerance = Tolerance::new(self.tolerance, self.tolerance).map_err(in_words)?;
        let mut work = self.closed.tree().workspace();
        match from {
            Some(RobotCheckpoint(Sealed {
                body: RobotCheckpointBody { state: kept, samples, cost, singular_positions },
                ..
            })) => {
                (state, found.samples, found.cost) = (kept, samples, cost);
                found.singular_positions = singular_positions;
            }
            None => self.record(start, &mut y, &mut work, found).map_err(|error| error.to_string())?,
        }
        let last = f64::from(self.samples - 1);
        loop {
            let piece = keeper.is_some().then(|| Piece::of(&state, found));
            let (apart, before) = (motion.apart.clone(), found.cost);
            let (mut refused, mut stopped, mut left) = (None, false, PIECE);
            let result = DormandPrince853::new(tolerance).integrate(&mut motion, &mut state, end, |step| {
                let forward = (step.time() - start).abs();
                while found.samples.len() < self.samples as usize {
                    let share = found.samples.len() as f64 / last;
                    let t = if share < 1.0 { start + share * (end - start) } else { end };
                    if forward < (t - start).abs() {
                        break;
                    }
                    let sampled = step.at(t, &mut y).map_err(|error| error.to_string());
                    let recorded = sampled
                        .and_then(|()| self.record(t, &mut y, &mut work, found).map_err(|error| error.to_string()));
                    if let Err(why) = recorded {
                        refused = Some(why);
                        return ControlFlow::Break(());
                    }
                }
                found.reached = step.time();
                found.cost[0] += 1;
                left = u32::saturating_sub(left, 1);
                stopped = observer(forward / (end - start).abs()).is_break();
                if stopped || (left == 0 && apart.get()) { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            });
            let named = |(t, condition)| (t, self.closed.closure_of(condition).to_string());
            let listed = LISTED - found.singular_positions.len().min(LISTED);
            found.singular_positions.extend(motion.motion.renew().into_iter().take(listed).map(named));
            if let Some(why) = refused {
                return Err(why);
            }
            let report = result.map_err(|error| error.to_string())?;
            found.cost = [before[0] + report.steps, before[1] + report.rejected, before[2] + report.evaluations];
            if report.ending != Ending::Stopped || stopped {
                if let (true, Some(keeper), Some(piece)) = (stopped, &mut keeper, piece) {
                    keeper.keep(&piece.checkpoint(self, found));
                }
                return Ok(report.ending);
            }
            if let Some(keeper) = &mut keeper
                && keeper.is_due()
            {
                keeper.keep(&Piece::of(&state, found).checkpoint(self, found));
            }
        }
    }

    fn record(
        &self,
        t: f64,
        y: &mut [f64],
        work: &mut TreeWorkspace<f64>,
        found: &mut RobotMotion,
    ) -> Result<(), MultibodyError> {
        let tree = self.closed.tree();
        let (q, rest) = y.split_at_mut(tree.coordinates());
        tree.normalise(q)?;
        let (v, done) = rest.split_at(tree.freedoms());
        let energies = tree.tree_energies(work, q, v)?;
        let springs = tree.joint_powers(q, v, self.slip_rate)?.spring_energy;
        found.samples.push(RobotSample {
            t,
            q: q.to_vec(),
            v: v.to_vec(),
            energies: [energies.kinetic, energies.potential, springs],
            works: [done[0], done[1], done[2]],
        });
        Ok(())
    }
}

impl RobotMotion {
    fn judge(&mut self, robot: &RobotStudy) {
        let Some(first) = self.samples.first().map(RobotSample::balance) else { return };
        let (mut change, mut size) = (0.0_f64, 0.0_f64);
        for sample in &self.samples {
            change = change.max((sample.balance() - first).abs());
            size = sample.energies.iter().chain(&sample.works).fold(size, |size, energy| size.max(energy.abs()));
        }
        self.energy_error = if 0.0 < size { change / size } else { 0.0 };
        for drive in &robot.drives {
            let Some(coordinate) = drive.coordinate else { continue };
            let [low, high] = drive.limits;
            let beyond = |sample: &&RobotSample| sample.q[coordinate] < low || high < sample.q[coordinate];
            if let Some(sample) = self.samples.iter().find(beyond) {
                self.beyond_limits.push((sample.t, self.names[coordinate].clone()));
            }
        }
    }
}
