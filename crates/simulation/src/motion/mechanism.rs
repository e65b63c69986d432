//! The equations of a mechanism with the works of its forces, and the reading of its states.

use nalgebra::Vector3;
use piola_integrators::{Field, State};
use piola_kinematics::{Attitude, Holonomic, Placement, RigidBody};
use piola_lagrangian::Workspace;

use super::drive::{Driver, Reading};
use super::{History, Invariants, Method};
use crate::SimulationError;
use crate::forces::{MechanismLagrangian, working};
use crate::joints::Mechanism;

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
    history.work_names = working.iter().map(|&i| system.forces[i].name.clone()).collect();
    let lagrangian = system.lagrangian();
    let canonical = matches!(method, Method::GaussLegendre { .. });
    let mut start = system.position.clone();
    if canonical {
        let momenta = lagrangian.momenta(&system.position, &system.velocity, driver.start());
        start.extend(momenta.map_err(|error| error.to_string())?.iter());
    } else {
        start.extend(&system.velocity);
    }
    start.resize(2 * n + working.len(), 0.0);
    let mut state = State::new(driver.start(), start).map_err(|error| error.to_string())?;
    let mut reading =
        MechanismReading { lagrangian: &lagrangian, canonical, work: Workspace::default(), state: vec![0.0; 2 * n] };
    if canonical {
        let field = &mut WithWork { field: lagrangian.canonical_motion(n), system, working: &working };
        driver.field(method, field, &mut state, &mut reading)
    } else {
        let field = &mut WithWork { field: lagrangian.motion(n), system, working: &working };
        driver.field(method, field, &mut state, &mut reading)
    }
}

/// A motion y = (q, q̇) or (q, p) with the works of some forces after it: Ẇ = P.
struct WithWork<'m, F> {
    field: F,
    system: &'m Mechanism,
    working: &'m [usize],
}

impl<F: Field> Field for WithWork<'_, F> {
    type Error = F::Error;
    fn dimension(&self) -> usize {
        self.field.dimension() + self.working.len()
    }
    fn is_second_order(&self) -> bool {
        self.working.is_empty() && self.field.is_second_order()
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), F::Error> {
        let (motion, powers) = rate.split_at_mut(self.field.dimension());
        let state = &y[..motion.len()];
        self.field.rate(t, state, motion)?;
        let n = motion.len() / 2;
        for (power, &force) in powers.iter_mut().zip(self.working) {
            *power = self.system.forces[force].kind.power(&self.system.tree, &state[..n], &motion[..n], t);
        }
        Ok(())
    }
    fn project(&mut self, t: f64, y: &mut [f64]) -> Result<(), F::Error> {
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

struct MechanismReading<'l> {
    lagrangian: &'l MechanismLagrangian<'l>,
    /// Whether states hold momenta instead of velocities.
    canonical: bool,
    work: Workspace,
    /// (q, q̇).
    state: Vec<f64>,
}

impl MechanismReading<'_> {
    fn read(&mut self, time: f64, values: &[f64]) {
        let motion = &values[..self.state.len()];
        self.state.copy_from_slice(motion);
        if self.canonical {
            let (q, p) = motion.split_at(motion.len() / 2);
            let velocities = &mut self.state[q.len()..];
            if self.lagrangian.velocities_into(&mut self.work, q, p, time, velocities).is_err() {
                velocities.fill(f64::NAN);
            }
        }
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
        if self.state.len() < values.len() {
            history.works.push(values[self.state.len()..].to_vec());
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
            work: values[self.state.len()..].iter().sum(),
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
