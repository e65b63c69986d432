//! The equations of a mechanism with the works of its forces, and the reading of its states.

use nalgebra::{DMatrix, DVector, Vector3};
use piola_integrators::{Field, State};
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};
use piola_lagrangian::anholonomic::Coframe as _;
use piola_lagrangian::constraints;
use piola_lagrangian::{LagrangianError, Reaction, Workspace};

use super::drive::{Driver, Reading};
use super::energies;
pub(super) use super::energies::names as energy_names;
use super::memory::{Memory, Remembering};
use super::{History, Invariants, Method, PartReaction};
use crate::SimulationError;
use crate::constraints::{ConstrainedMechanism, MechanismConstraints, RollingFrame, RollingMechanism};
use crate::forces::{MechanismLagrangian, working};
use crate::joints::{ClosedTop, Mechanism};

/// Particles and rigid bodies on joints.
pub(super) fn mechanism(system: &Mechanism, method: Method, driver: &mut Driver) -> Result<(), String> {
    let n = system.tree.freedom();
    for (quantity, values) in [("position", &system.position), ("velocity", &system.velocity)] {
        if values.len() != n {
            return Err(SimulationError::WrongLength { quantity, expected: n, found: values.len() }.to_string());
        }
    }
    let working = working(&system.forces);
    let history = driver.history();
    history.coordinate_names.clone_from(&system.coordinates);
    history.work_names = system.work_names();
    let works = history.work_names.len();
    if system.reactions {
        history.condition_names = system.condition_names();
    }
    if system.questions.energies {
        history.energy_names = energies::names(system);
    }
    let lagrangian = system.lagrangian();
    // Steps evaluate what moves alone; what is recorded is that of all parts.
    let reduction = system.simplify.then(|| system.reduction());
    let lean = system.lagrangian_on(reduction.as_ref().map_or(&system.tree, |reduction| &reduction.tree));
    let rolling = if system.rolls() {
        Some(system.rolling(system.lagrangian()).map_err(|error| error.to_string())?)
    } else {
        None
    };
    let constrained = (!system.constraints.is_empty() && rolling.is_none()).then(|| system.constrained());
    let canonical = matches!(method, Method::GaussLegendre { .. });
    let (mut position, mut velocity) = (system.position.clone(), system.velocity.clone());
    if canonical && !system.constraints.is_empty() {
        return Err(SimulationError::ConstraintsNeedProjection { method: method.to_string() }.to_string());
    }
    if rolling.is_some() {
        // The rates that are free; the others follow from them.
        velocity = system.rolling_start().map_err(|error| error.to_string())?;
    } else if let Some(constrained) = &constrained {
        let start = constrained.assemble(&position, &velocity, driver.start()).map_err(|error| error.to_string())?;
        (position, velocity) = (start.coordinates, start.velocities);
    } else if canonical {
        let momenta = lagrangian.momenta(&position, &velocity, driver.start());
        velocity = momenta.map_err(|error| error.to_string())?.as_slice().to_vec();
    }
    let mut start = [position, velocity].concat();
    start.resize(start.len() + works, 0.0);
    let mut state = State::new(driver.start(), start).map_err(|error| error.to_string())?;
    let mut reading = MechanismReading {
        system,
        lagrangian: &lagrangian,
        constrained: constrained.as_ref(),
        rolling: rolling.as_ref(),
        canonical,
        work: Workspace::default(),
        state: vec![0.0; 2 * n],
    };
    if let Method::ClosedForm = method {
        let top = ClosedTop::of(system).ok_or_else(|| SimulationError::NoClosedForm.to_string())?;
        let from = driver.start();
        driver.closed_form(&mut |t, values| top.write(t - from, values), &mut state, &mut reading);
        return Ok(());
    }
    let power =
        Power { system, lagrangian: &lean, working: &working, work: Workspace::default(), forces: vec![0.0; n] };
    if rolling.is_some() {
        let rolling = system.rolling(lean.clone()).map_err(|error| error.to_string())?;
        let frame = system.rolling_frame();
        let leaves_out = frame.held.len() < 3 * system.constraints.len();
        let left_out = leaves_out.then_some(LeftOut { frame, rolling: &rolling, slips: None });
        let mut field = RollingWithWork { field: rolling.motion(n), coordinates: n, power, works, left_out };
        return driver.field(method, &mut field, &mut state, &mut reading);
    }
    match &constrained {
        Some(_) => {
            let constrained = lean.clone().with_constraints(MechanismConstraints(system));
            let (constraints, memory) = (MechanismConstraints(system), Memory::shared());
            driver.remember(memory.clone());
            let motion = Remembering { motion: constrained.motion(n), constraints, memory: memory.clone(), before: 0 };
            let mut field = WithWork { field: motion, power, works };
            let done = driver.field(method, &mut field, &mut state, &mut reading);
            driver.history().singular_positions = memory.passed.take();
            done.map_err(|why| {
                let singular = why
                    .contains("singular")
                    .then_some("; a run through such a position needs a tolerance of about 1e-10");
                why + singular.unwrap_or_default()
            })
        }
        None if canonical => {
            let field = &mut WithWork { field: lean.canonical_motion(n), power, works };
            driver.field(method, field, &mut state, &mut reading)
        }
        None => driver.field(method, &mut WithWork { field: lean.motion(n), power, works }, &mut state, &mut reading),
    }
}

/// A motion y = (q, q̇) or (q, p) with works after it: Ẇ = P.
struct WithWork<'m, F> {
    field: F,
    power: Power<'m>,
    works: usize,
}

/// The powers of forces, and of the drives of prescribed motions together.
struct Power<'m> {
    system: &'m Mechanism,
    lagrangian: &'m MechanismLagrangian<'m>,
    working: &'m [usize],
    work: Workspace,
    forces: Vec<f64>,
}

impl Power<'_> {
    fn write(
        &mut self,
        q: &[f64],
        (v, a): (&[f64], &[f64]),
        t: f64,
        powers: &mut [f64],
    ) -> Result<(), LagrangianError> {
        for (power, &force) in powers.iter_mut().zip(self.working) {
            *power = self.system.forces[force].kind.power(&self.system.tree, q, v, t);
        }
        if let [power] = &mut powers[self.working.len()..] {
            // All constraints together: those that do not move do no work. (M q̈ − f)·q̇
            self.lagrangian.driving_forces_into(&mut self.work, q, v, a, t, &mut self.forces)?;
            *power = self.forces.iter().zip(v).map(|(force, v)| force * v).sum();
        }
        Ok(())
    }
}

impl<F: Field<Error = LagrangianError>> Field for WithWork<'_, F> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        self.field.dimension() + self.works
    }
    fn is_second_order(&self) -> bool {
        self.works == 0 && self.field.is_second_order()
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), LagrangianError> {
        let (motion, powers) = rate.split_at_mut(self.field.dimension());
        let state = &y[..motion.len()];
        self.field.rate(t, state, motion)?;
        if powers.is_empty() {
            return Ok(());
        }
        let n = motion.len() / 2;
        self.power.write(&state[..n], motion.split_at(n), t, powers)
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), LagrangianError> {
        let dimension = self.field.dimension();
        self.field.project(t, &mut y[..dimension])
    }
    /// Works are as smooth as the motion and do not act back on it: its steps serve for them.
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        let dimension = self.field.dimension();
        self.field.magnitudes(&y[..dimension], &mut magnitudes[..dimension]);
        magnitudes[dimension..].fill(f64::MAX);
    }
}

/// A motion y = (q, w) in coordinates and free rates, with works after it.
struct RollingWithWork<'m, F> {
    field: F,
    coordinates: usize,
    power: Power<'m>,
    works: usize,
    left_out: Option<LeftOut<'m>>,
}

/// Conditions of rolling that followed from others at the start.
struct LeftOut<'m> {
    frame: RollingFrame<'m>,
    rolling: &'m RollingMechanism<'m>,
    /// The error once one of them is violated.
    slips: Option<LagrangianError>,
}

impl<F: Field<Error = LagrangianError>> Field for RollingWithWork<'_, F> {
    type Error = LagrangianError;
    fn dimension(&self) -> usize {
        self.field.dimension() + self.works
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), LagrangianError> {
        if let Some(error) = self.left_out.as_ref().and_then(|left_out| left_out.slips.clone()) {
            return Err(error);
        }
        let (motion, powers) = rate.split_at_mut(self.field.dimension());
        self.field.rate(t, &y[..motion.len()], motion)?;
        if powers.is_empty() {
            return Ok(());
        }
        // No drive stands beside what rolls: accelerations are not needed.
        let velocities = &motion[..self.coordinates];
        self.power.write(&y[..self.coordinates], (velocities, velocities), t, powers)
    }
    /// Checks the conditions that were left out; nothing else is to be projected.
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), LagrangianError> {
        let Some(LeftOut { frame, rolling, slips }) = &mut self.left_out else { return Ok(()) };
        let (q, free) = y[..self.field.dimension()].split_at(self.coordinates);
        let v = rolling.velocities(q, free, t)?;
        let checked = self.power.system.check_left_out(frame, q, v.as_slice(), t);
        *slips = checked.clone().err();
        checked
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        let dimension = self.field.dimension();
        self.field.magnitudes(&y[..dimension], &mut magnitudes[..dimension]);
        magnitudes[dimension..].fill(f64::MAX);
    }
}

struct MechanismReading<'l> {
    system: &'l Mechanism,
    lagrangian: &'l MechanismLagrangian<'l>,
    constrained: Option<&'l ConstrainedMechanism<'l>>,
    rolling: Option<&'l RollingMechanism<'l>>,
    /// Whether states hold momenta instead of velocities.
    canonical: bool,
    work: Workspace,
    /// (q, q̇).
    state: Vec<f64>,
}

impl MechanismReading<'_> {
    fn read(&mut self, time: f64, values: &[f64]) {
        let motion = &values[..values.len() - self.system.work_count()];
        let (q, v) = motion.split_at(self.state.len() / 2);
        self.state[..q.len()].copy_from_slice(q);
        if let Some(rolling) = self.rolling {
            let velocities = &mut self.state[q.len()..];
            match rolling.velocities(q, v, time) {
                Ok(found) => velocities.copy_from_slice(found.as_slice()),
                Err(_) => velocities.fill(f64::NAN),
            }
            return;
        }
        self.state[q.len()..].copy_from_slice(v);
        if self.canonical {
            let velocities = &mut self.state[q.len()..];
            if self.lagrangian.velocities_into(&mut self.work, q, v, time, velocities).is_err() {
                velocities.fill(f64::NAN);
            }
        }
        // Between the ends of steps a state satisfies constraints to the tolerance alone.
        if let Some(Ok(closed)) = self.constrained.map(|constrained| constrained.assemble(q, v, time)) {
            self.state.clear();
            self.state.extend(closed.coordinates.iter().chain(&closed.velocities));
        }
    }

    /// What holds the parts and the forces of constraints, at the state that was read; not numbers where they are not found.
    fn hold(&mut self, time: f64, history: &mut History) {
        let (q, v) = self.state.split_at(self.state.len() / 2);
        let mut acceleration = vec![0.0; q.len()];
        let mut conditions = vec![0.0; history.condition_names.len()];
        let solved = match self.constrained {
            None if self.rolling.is_some() => self.hold_rolling(time, &mut acceleration, &mut conditions),
            Some(constrained) => {
                let work = &mut constraints::Workspace::default();
                constrained.solve_into(work, q, v, time, &mut acceleration, &mut conditions)
            }
            None => self.lagrangian.acceleration_into(&mut self.work, q, v, time, &mut acceleration),
        };
        if solved.is_err() {
            acceleration.fill(f64::NAN);
            conditions.fill(f64::NAN);
        }
        self.system.forces_of_conditions(&mut conditions);
        let mut held = vec![Reaction::none(); self.system.parts.len()];
        let found =
            self.lagrangian.reactions_at_acceleration_into(&mut self.work, q, v, &acceleration, time, &mut held);
        let unknown = PartReaction { force: [f64::NAN; 3], moment: [f64::NAN; 3] };
        let told = |reaction: &Reaction| match found {
            Ok(()) => PartReaction { force: (*reaction.force()).into(), moment: reaction.moment_in_space().into() },
            Err(_) => unknown,
        };
        history.reactions.push(held.iter().map(told).collect());
        history.conditions.push(conditions);
    }
}

impl MechanismReading<'_> {
    /// Accelerations of what rolls, and the forces of the plane.
    fn hold_rolling(&self, time: f64, acceleration: &mut [f64], forces: &mut [f64]) -> Result<(), LagrangianError> {
        let Some(rolling) = self.rolling else { return Ok(()) };
        let (q, v) = self.state.split_at(self.state.len() / 2);
        let frame = self.system.rolling_frame();
        let free: Vec<f64> = frame.free.iter().map(|i| v[*i]).collect();
        acceleration.copy_from_slice(rolling.coordinate_acceleration(q, &free, time)?.as_slice());
        for (held, force) in frame.held.iter().zip(&rolling.reactions(q, &free, time)?) {
            forces[*held] = *force;
        }
        if frame.held.len() < forces.len() {
            share(frame, q, time, forces);
        }
        Ok(())
    }
}

/// Forces of the independent conditions become those of all conditions with the least sum of squares, with the same generalised forces.
fn share(mut frame: RollingFrame<'_>, q: &[f64], time: f64, forces: &mut [f64]) {
    /// Singular values below this part of the largest are zero.
    const SMALL: f64 = 1e-9;
    let (n, count) = (q.len(), forces.len());
    let mut rows = vec![0.0; count * n];
    (frame.free, frame.held) = (Vec::new(), (0..count).collect());
    frame.coframe(q, time, &mut rows);
    if !rows.iter().chain(&*forces).all(|x| x.is_finite()) {
        forces.fill(f64::NAN);
        return;
    }
    // A row of ours is a column here.
    let columns = DMatrix::from_column_slice(n, count, &rows);
    let generalised = &columns * DVector::from_column_slice(forces);
    let parts = columns.svd(true, true);
    let least = SMALL * parts.singular_values.max();
    match parts.solve(&generalised, least) {
        Ok(found) => forces.copy_from_slice(found.as_slice()),
        Err(_) => forces.fill(f64::NAN),
    }
}

impl Reading for MechanismReading<'_> {
    fn record(&mut self, time: f64, values: &[f64], history: &mut History) {
        self.read(time, values);
        let mut places = Places(Vec::new());
        self.lagrangian.system().place(&self.state[..self.state.len() / 2], time, &mut places);
        history.times.push(time);
        history.positions.push(places.0);
        history.coordinates.push(self.state.clone());
        let works = &values[values.len() - self.system.work_count()..];
        if !works.is_empty() {
            history.works.push(works.to_vec());
        }
        if self.system.questions.energies {
            let (q, v) = self.state.split_at(self.state.len() / 2);
            history.energies.push(energies::energies(self.system, q, v, time));
        }
        if self.system.reactions {
            self.hold(time, history);
        }
    }

    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants {
        self.read(time, values);
        let (q, v) = self.state.split_at(self.state.len() / 2);
        let (energy, scale) = match self.lagrangian.energies_with(&mut self.work, q, v, time) {
            Ok(energies) => (energies.total(), energies.kinetic),
            Err(_) => (f64::NAN, f64::NAN),
        };
        Invariants {
            time,
            energy,
            work: values[values.len() - self.system.work_count()..].iter().sum(),
            energy_scale: scale,
            post_newtonian_energy: None,
            momentum: None,
            angular_momentum: None,
        }
    }
}

struct Places(Vec<[f64; 3]>);

impl Placement<f64> for Places {
    fn particle(&mut self, _mass: f64, position: Vector3<f64>) {
        self.0.push(position.into());
    }
    fn body(&mut self, _body: &RigidBody, centre: Vector3<f64>, _attitude: Attitude<f64>) {
        self.0.push(centre.into());
    }
}
