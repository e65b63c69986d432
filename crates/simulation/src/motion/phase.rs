//! The equations of a Hamiltonian and the reading of its states.

use piola_hamiltonian::PhaseFunction as _;
use piola_integrators::{Composition, State};

use super::drive::{Driver, Reading};
use super::{History, Invariants, Method};
use crate::SimulationError;
use crate::phase::{Newtonian, PhaseField, PhaseSystem, Split};

/// A system given by its Hamiltonian.
pub(super) fn phase(system: &PhaseSystem, method: Method, driver: &mut Driver) -> Result<(), String> {
    let hamiltonian = &system.hamiltonian;
    let driven = hamiltonian.0.depends_on_time();
    let history = driver.history();
    history.coordinate_names = [&system.coordinates[..], &system.momenta[..]].concat();
    if driven {
        history.work_names.push("what depends on time".to_string());
    }
    let mut start = [&system.position[..], &system.momentum[..]].concat();
    start.extend(driven.then_some(0.0));
    let mut state = State::new(driver.start(), start).map_err(|error| error.to_string())?;
    let value = hamiltonian.value(&system.position, &system.momentum, driver.start());
    if !value.is_finite() {
        return Err(SimulationError::NotFinite { quantity: "hamiltonian at the start", index: 0, value }.to_string());
    }
    let mut reading = PhaseReading { system, field: PhaseField::of(system), newtonian: None, state: Vec::new() };
    match method {
        Method::Composition { order, step } => {
            let Some(mut split) = Split::of(system) else {
                return Err(SimulationError::NotSeparable { method: method.to_string() }.to_string());
            };
            let mut method = Composition::new(order, step).map_err(|error| error.to_string())?;
            driver.separable(&mut method, &mut split, &mut state, &mut reading)
        }
        Method::Nystrom86 { .. } | Method::Nystrom1210 { .. } => {
            let (Some(mut newtonian), true) = (Newtonian::of(system), !driven) else {
                return Err(SimulationError::NoConstantInertia { method: method.to_string() }.to_string());
            };
            state.values[system.freedom()..].copy_from_slice(&newtonian.velocities(&system.momentum));
            reading.state.clone_from(&state.values);
            reading.newtonian = Newtonian::of(system);
            driver.second_order(method, &mut newtonian, &mut state, &mut reading)
        }
        _ => driver.field(method, &mut PhaseField::of(system), &mut state, &mut reading),
    }
}

struct PhaseReading<'s> {
    system: &'s PhaseSystem,
    field: PhaseField,
    /// Where states hold velocities instead of momenta.
    newtonian: Option<Newtonian>,
    /// (q, p) of such a state.
    state: Vec<f64>,
}

impl PhaseReading<'_> {
    /// (q, p) and the works.
    fn read<'v>(&'v mut self, values: &'v [f64]) -> (&'v mut PhaseField, &'v [f64], &'v [f64]) {
        let n = self.system.freedom();
        let (motion, works) = values.split_at(2 * n);
        let Some(newtonian) = &self.newtonian else { return (&mut self.field, motion, works) };
        let (q, p) = self.state.split_at_mut(n);
        q.copy_from_slice(&motion[..n]);
        newtonian.momenta_into(&motion[n..], p);
        (&mut self.field, &self.state, works)
    }
}

impl Reading for PhaseReading<'_> {
    fn record(&mut self, time: f64, values: &[f64], history: &mut History) {
        let (_, motion, works) = self.read(values);
        history.times.push(time);
        history.positions.push(Vec::new());
        history.coordinates.push(motion.to_vec());
        if !works.is_empty() {
            history.works.push(works.to_vec());
        }
    }

    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants {
        let (field, motion, works) = self.read(values);
        let (q, p) = motion.split_at(motion.len() / 2);
        // ½ p·∂H/∂p is the kinetic energy where H has one.
        let (energy, energy_scale) = field.energies(q, p, time);
        Invariants {
            time,
            energy,
            work: works.iter().sum(),
            energy_scale,
            post_newtonian_energy: None,
            momentum: None,
            angular_momentum: None,
        }
    }
}
