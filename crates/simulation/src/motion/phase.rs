//! The equations of a Hamiltonian and the reading of its states.

use piola_hamiltonian::{HamiltonianError, HamiltonianField, PhaseFunction as _, differential, time_derivative};
use piola_integrators::{Composition, Field, State};

use super::drive::{Driver, Reading};
use super::{History, Invariants, Method};
use crate::SimulationError;
use crate::phase::{PhaseExpression, PhaseSystem, Split};

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
    let mut reading = PhaseReading { system };
    match method {
        Method::Composition { .. } if !hamiltonian.0.is_separable() => {
            Err(SimulationError::NotSeparable { method: method.to_string() }.to_string())
        }
        Method::Composition { order, step } => {
            let mut method = Composition::new(order, step).map_err(|error| error.to_string())?;
            driver.separable(&mut method, &mut Split { system }, &mut state, &mut reading)
        }
        _ => {
            let n = system.freedom();
            let mut field = PhaseField { field: HamiltonianField::new(hamiltonian, n), hamiltonian, driven };
            driver.field(method, &mut field, &mut state, &mut reading)
        }
    }
}

/// Hamilton's equations, with ∫ ∂H/∂t dt after them where H depends on time.
struct PhaseField<'s> {
    field: HamiltonianField<'s, PhaseExpression>,
    hamiltonian: &'s PhaseExpression,
    driven: bool,
}

impl Field for PhaseField<'_> {
    type Error = HamiltonianError;
    fn dimension(&self) -> usize {
        self.field.dimension() + usize::from(self.driven)
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), HamiltonianError> {
        let dimension = self.field.dimension();
        let (motion, power) = rate.split_at_mut(dimension);
        self.field.rate(t, &y[..dimension], motion)?;
        if let [power] = power {
            let (q, p) = y[..dimension].split_at(dimension / 2);
            *power = time_derivative(self.hamiltonian, q, p, t)?;
        }
        Ok(())
    }
    /// The work does not act back on the motion, whose steps serve for it.
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        let dimension = self.field.dimension();
        self.field.magnitudes(&y[..dimension], &mut magnitudes[..dimension]);
        magnitudes[dimension..].fill(f64::MAX);
    }
}

struct PhaseReading<'s> {
    system: &'s PhaseSystem,
}

impl Reading for PhaseReading<'_> {
    fn record(&mut self, time: f64, values: &[f64], history: &mut History) {
        let (motion, works) = values.split_at(2 * self.system.freedom());
        history.times.push(time);
        history.positions.push(Vec::new());
        history.coordinates.push(motion.to_vec());
        if !works.is_empty() {
            history.works.push(works.to_vec());
        }
    }

    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants {
        let n = self.system.freedom();
        let (motion, works) = values.split_at(2 * n);
        let (q, p) = motion.split_at(n);
        let hamiltonian = &self.system.hamiltonian;
        // ½ p·∂H/∂p is the kinetic energy where H has one.
        let scale = differential(hamiltonian, q, p, time).map_or(f64::NAN, |slopes| {
            0.5 * p.iter().zip(slopes.iter().skip(n)).map(|(p, v)| p * v).sum::<f64>().abs()
        });
        Invariants {
            time,
            energy: hamiltonian.value(q, p, time),
            work: works.iter().sum(),
            energy_scale: scale,
            post_newtonian_energy: None,
            momentum: None,
            angular_momentum: None,
        }
    }
}
