//! The equations of each kind of system and the reading of its states.

use core::convert::Infallible;

use piola_gravitation as gravitation;
use piola_gravitation::kepler::KeplerMotion;
use piola_gravitation::{Gravitation, SPEED_OF_LIGHT, attraction};
use piola_integrators::{Composition, Field, SecondOrder, Separable, State};
use piola_numerics::sums::CompensatedSum;

use super::drive::{Driver, Reading};
use super::{History, Invariants, Method, NEWTONIAN_CONSTANT, system as model};

/// Bodies that attract each other.
pub(super) fn gravitation(system: &model::Gravitation, method: Method, driver: &mut Driver) -> Result<(), String> {
    let mut bodies = gravitating(system).map_err(|error| error.to_string())?;
    let positions: Vec<_> = system.bodies.iter().map(|body| body.position).collect();
    let velocities: Vec<_> = system.bodies.iter().map(|body| body.velocity).collect();
    let start = bodies.state(&positions, &velocities).map_err(|error| error.to_string())?;
    let mut state = State::new(driver.start(), start).map_err(|error| error.to_string())?;
    let mut reading = bodies.clone();
    match method {
        Method::Composition { order, step } if system.post_newtonian.is_none() => {
            let mut method = Composition::new(order, step).map_err(|error| error.to_string())?;
            driver.separable(&mut method, &mut bodies, &mut state, &mut reading)
        }
        Method::Nystrom86 { .. } | Method::Nystrom1210 { .. } => {
            driver.second_order(method, &mut bodies, &mut state, &mut reading)
        }
        _ => driver.field(method, &mut bodies, &mut state, &mut reading),
    }
}

pub(super) fn gravitating(system: &model::Gravitation) -> Result<Gravitation, piola_gravitation::GravitationError> {
    let bodies =
        Gravitation::new(system.bodies.iter().map(|body| body.gm).collect())?.with_softening(system.softening)?;
    match system.post_newtonian {
        None => Ok(bodies),
        Some(term) => bodies
            .with_post_newtonian(gravitation::PostNewtonian { centre: term.central, speed_of_light: SPEED_OF_LIGHT }),
    }
}

impl Reading for Gravitation {
    fn record(&mut self, time: f64, values: &[f64], history: &mut History) {
        history.times.push(time);
        history.positions.push((0..self.bodies()).map(|body| Gravitation::position(self, values, body)).collect());
        history.velocities.push((0..self.bodies()).map(|body| Gravitation::velocity(self, values, body)).collect());
    }

    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants {
        let sums = Gravitation::invariants(self, values);
        // The sums are of Gm: one division makes them joules and newton-seconds.
        let mass = |x: f64| x / NEWTONIAN_CONSTANT;
        Invariants {
            time,
            energy: mass(sums.energy),
            work: 0.0,
            energy_scale: 0.0,
            post_newtonian_energy: self.post_newtonian().map(|_| mass(sums.post_newtonian_energy)),
            momentum: Some((sums.momentum.map(mass), mass(sums.momentum_scale))),
            angular_momentum: Some((sums.angular_momentum.map(mass), mass(sums.angular_momentum_scale))),
        }
    }
}

/// Bodies about a fixed centre.
pub(super) fn central(system: &model::Central, method: Method, driver: &mut Driver) -> Result<(), String> {
    let places = system.bodies.iter().flat_map(|body| body.position);
    let start = places.chain(system.bodies.iter().flat_map(|body| body.velocity)).collect();
    let mut state = State::new(driver.start(), start).map_err(|error| error.to_string())?;
    let mut field = CentralField { gm: system.gm, freedom: 3 * system.bodies.len() };
    match method {
        Method::Composition { order, step } => {
            let mut method = Composition::new(order, step).map_err(|error| error.to_string())?;
            driver.separable(&mut method, &mut field, &mut state, &mut CentralReading(system))
        }
        Method::Nystrom86 { .. } | Method::Nystrom1210 { .. } => {
            driver.second_order(method, &mut field, &mut state, &mut CentralReading(system))
        }
        Method::ClosedForm => {
            let motions: Vec<KeplerMotion> = system
                .bodies
                .iter()
                .map(|body| {
                    let motion = KeplerMotion::new(system.gm, body.position, body.velocity);
                    let motion = motion.map_err(|error| format!("the closed form of {}: {error}", body.name))?;
                    let (turns, most) = (driver.span().length() / motion.period(), KeplerMotion::MOST_TURNS);
                    if turns <= most {
                        return Ok(motion);
                    }
                    Err(format!(
                        "the closed form of {}: the time is {turns:e} turns; at most {most:e} are valid",
                        body.name
                    ))
                })
                .collect::<Result<_, _>>()?;
            let (start, n) = (driver.start(), 3 * system.bodies.len());
            let mut at = |t: f64, values: &mut [f64]| {
                for (motion, i) in motions.iter().zip((0..n).step_by(3)) {
                    let (position, velocity) = motion.state(t - start);
                    values[i..i + 3].copy_from_slice(&position);
                    values[n + i..n + i + 3].copy_from_slice(&velocity);
                }
            };
            driver.closed_form(&mut at, &mut state, &mut CentralReading(system));
            Ok(())
        }
        _ => driver.field(method, &mut field, &mut state, &mut CentralReading(system)),
    }
}

/// ẍ = −μ x/|x|³ for each body.
struct CentralField {
    gm: f64,
    freedom: usize,
}

impl Separable for CentralField {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        self.freedom
    }
    fn force(&mut self, _t: f64, position: &[f64], force: &mut [f64]) -> Result<(), Infallible> {
        for (x, f) in position.chunks_exact(3).zip(force.chunks_exact_mut(3)) {
            f.copy_from_slice(&attraction([-x[0], -x[1], -x[2]], self.gm, 0.0));
        }
        Ok(())
    }
}

impl SecondOrder for CentralField {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    const OWN_MAGNITUDES: bool = true;
    fn freedom(&self) -> usize {
        self.freedom
    }
    fn acceleration(&mut self, t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Infallible> {
        self.force(t, q, acceleration)
    }
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]) {
        Field::magnitudes(self, state, magnitudes);
    }
}

impl Field for CentralField {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        2 * self.freedom
    }
    fn is_second_order(&self) -> bool {
        true
    }
    fn rate(&mut self, t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
        let (positions, velocities) = y.split_at(self.freedom);
        let (rate, force) = rate.split_at_mut(self.freedom);
        rate.copy_from_slice(velocities);
        self.force(t, positions, force)
    }
    /// Each body by itself: a distant one must not hide the error of a near one.
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        for (values, magnitudes) in y.chunks_exact(3).zip(magnitudes.chunks_exact_mut(3)) {
            magnitudes.fill(values.iter().map(|x| x * x).sum::<f64>().sqrt());
        }
    }
}

struct CentralReading<'s>(&'s model::Central);

fn triples(values: &[f64]) -> Vec<[f64; 3]> {
    values.chunks_exact(3).map(|x| [x[0], x[1], x[2]]).collect()
}

impl Reading for CentralReading<'_> {
    fn record(&mut self, time: f64, values: &[f64], history: &mut History) {
        let (positions, velocities) = values.split_at(values.len() / 2);
        history.times.push(time);
        history.positions.push(triples(positions));
        history.velocities.push(triples(velocities));
    }

    fn invariants(&mut self, time: f64, values: &[f64]) -> Invariants {
        let (positions, velocities) = values.split_at(values.len() / 2);
        let mut energy = CompensatedSum::new();
        let mut moment = [CompensatedSum::new(); 3];
        let mut scale = CompensatedSum::new();
        for ((body, x), v) in self.0.bodies.iter().zip(positions.chunks_exact(3)).zip(velocities.chunks_exact(3)) {
            let mut own = [0.0; 3];
            for k in 0..3 {
                let (a, b) = ((k + 1) % 3, (k + 2) % 3);
                energy.add_product(0.5 * body.mass * v[k], v[k]);
                moment[k].add_product(body.mass * x[a], v[b]);
                moment[k].add_product(-(body.mass * x[b]), v[a]);
                own[k] = x[a] * v[b] - x[b] * v[a];
            }
            let length = |x: &[f64]| x.iter().map(|x| x * x).sum::<f64>().sqrt();
            energy.add(-body.mass * self.0.gm / length(x));
            scale.add(body.mass * length(&own));
        }
        Invariants {
            time,
            energy: energy.value(),
            work: 0.0,
            energy_scale: 0.0,
            post_newtonian_energy: None,
            momentum: None,
            angular_momentum: Some((moment.map(CompensatedSum::value), scale.value())),
        }
    }
}
