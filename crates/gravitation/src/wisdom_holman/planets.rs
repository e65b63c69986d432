//! Democratic heliocentric coordinates: places from the central body, velocities from the mass centre of all bodies.
//!
//! ```text
//! Qᵢ = xᵢ − x₀        Vᵢ = vᵢ − V,  V = Σ mᵢ vᵢ/M        canonical with Pᵢ = mᵢ Vᵢ
//! ```

use piola_integrators::internal::compensated_add;
use piola_numerics::{Kernel, Lanes, Mask, Real, dispatch};

use crate::attraction::{LANES, inverse_cube};
use crate::checkpoint::take;
use crate::kepler::{Increment, advance};

/// What does not change in a run.
#[derive(Clone, Debug)]
pub(crate) struct PlanetMasses {
    /// Gm of the central body.
    pub(crate) centre: f64,
    /// Gm of all bodies together.
    pub(crate) total: f64,
    /// Gm of the planets: planet i is body i + 1.
    pub(crate) planets: Vec<f64>,
    /// The planets that attract, and those that do not.
    pub(crate) heavy: Vec<usize>,
    pub(crate) light: Vec<usize>,
}

impl PlanetMasses {
    pub(crate) fn new(parameters: &[f64]) -> Self {
        let (centre, planets) = parameters.split_first().map_or((0.0, &[][..]), |(first, rest)| (*first, rest));
        let (heavy, light) = (0..planets.len()).partition(|&planet| 0.0 < planets[planet]);
        Self { centre, total: parameters.iter().sum(), planets: planets.to_vec(), heavy, light }
    }

    /// All pairs of which one at least attracts: the first of them does.
    pub(crate) fn pairs(&self) -> impl Iterator<Item = (usize, usize)> {
        self.heavy.iter().enumerate().flat_map(|(rank, &first)| {
            self.heavy[rank + 1..].iter().chain(&self.light).map(move |&second| (first, second))
        })
    }
}

/// The place and the velocity of a planet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Planet<T> {
    /// Q, m, and what rounding left of it.
    pub(crate) position: [T; 3],
    pub(crate) position_carry: [T; 3],
    /// V, m/s, and what rounding left of it.
    pub(crate) velocity: [T; 3],
    pub(crate) velocity_carry: [T; 3],
}

impl<T: Real> Planet<T> {
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn shift(&mut self, change: [T; 3]) {
        add_compensated(&mut self.position, &mut self.position_carry, change);
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn push(&mut self, change: [T; 3]) {
        add_compensated(&mut self.velocity, &mut self.velocity_carry, change);
    }
}

#[cfg_attr(not(debug_assertions), inline(always))]
fn add_compensated<T: Real>(values: &mut [T; 3], carries: &mut [T; 3], changes: [T; 3]) {
    for ((value, carry), change) in values.iter_mut().zip(carries).zip(changes) {
        compensated_add(value, carry, change);
    }
}

/// A state in these coordinates.
#[derive(Clone, Debug)]
pub(crate) struct Planets<T> {
    pub(crate) planets: Vec<Planet<T>>,
    /// The mass centre of all bodies: where it was at the start of the run, and its velocity.
    centre_of_mass: [[T; 3]; 2],
}

impl<T: Real> Planets<T> {
    pub(crate) fn new(masses: &PlanetMasses, state: &[T]) -> Self {
        let zero = [T::zero(); 3];
        let planet = Planet { position: zero, position_carry: zero, velocity: zero, velocity_carry: zero };
        let mut planets = vec![planet; masses.planets.len()];
        let mut centre_of_mass = [zero; 2];
        let bodies = planets.len() + 1;
        for component in 0..6 {
            let (kind, axis) = (component / 3, component % 3);
            let values = &state[component * bodies..(component + 1) * bodies];
            // The mass centre from the central body.
            let mut centre = T::zero();
            for (&parameter, &value) in masses.planets.iter().zip(&values[1..]) {
                centre += T::lit(parameter / masses.total) * (value - values[0]);
            }
            centre_of_mass[kind][axis] = values[0] + centre;
            for (planet, &value) in planets.iter_mut().zip(&values[1..]) {
                let relative = value - values[0];
                if kind == 0 {
                    planet.position[axis] = relative;
                } else {
                    planet.velocity[axis] = relative - centre;
                }
            }
        }
        Self { planets, centre_of_mass }
    }

    /// How many numbers a state of so many bodies is saved in.
    pub(crate) const fn numbers(bodies: usize) -> usize {
        12 * bodies.saturating_sub(1) + 6
    }

    /// All numbers of the state, for a checkpoint.
    pub(crate) fn saved(&self) -> Vec<T> {
        let planets = self.planets.iter().flat_map(|planet| {
            [planet.position, planet.position_carry, planet.velocity, planet.velocity_carry].into_iter().flatten()
        });
        planets.chain(self.centre_of_mass.into_iter().flatten()).collect()
    }

    /// Takes back what was saved of the same bodies.
    pub(crate) fn restore(&mut self, mut saved: &[T]) {
        for planet in &mut self.planets {
            let Planet { position, position_carry, velocity, velocity_carry } = planet;
            for triple in [position, position_carry, velocity, velocity_carry] {
                *triple = take(&mut saved).unwrap_or(*triple);
            }
        }
        for triple in &mut self.centre_of_mass {
            *triple = take(&mut saved).unwrap_or(*triple);
        }
    }

    /// Becomes `other`, of the same bodies, without a new allocation.
    pub(crate) fn copy(&mut self, other: &Self) {
        self.planets.copy_from_slice(&other.planets);
        self.centre_of_mass = other.centre_of_mass;
    }

    /// The first number that is not finite, with its index in the state.
    pub(crate) fn not_finite(&self) -> Option<(usize, f64)> {
        let mut sum = T::zero();
        for planet in &self.planets {
            for axis in 0..3 {
                // A product with zero is zero or NaN.
                sum += T::zero() * (planet.position[axis] + planet.velocity[axis]);
            }
        }
        if sum.is_finite().all() {
            return None;
        }
        let bodies = self.planets.len() + 1;
        (0..6 * self.planets.len()).find_map(|entry| {
            let (component, planet) = (entry / self.planets.len(), entry % self.planets.len());
            let own = &self.planets[planet];
            let value = if component < 3 { own.position[component] } else { own.velocity[component - 3] };
            let found = (0..T::LANES).map(|lane| value.primal(lane)).find(|value| !value.is_finite());
            found.map(|value| (component * bodies + planet + 1, value))
        })
    }

    /// Writes the state, so many seconds after the start of the run.
    pub(crate) fn write(&self, masses: &PlanetMasses, elapsed: f64, state: &mut [T]) {
        let bodies = self.planets.len() + 1;
        let [place, velocity] = self.centre_of_mass;
        for component in 0..6 {
            let (kind, axis) = (component / 3, component % 3);
            let values = &mut state[component * bodies..(component + 1) * bodies];
            let mut sum = T::zero();
            for (&parameter, planet) in masses.planets.iter().zip(&self.planets) {
                let own = if kind == 0 { planet.position } else { planet.velocity };
                sum += T::lit(parameter) * own[axis];
            }
            if kind == 0 {
                values[0] = (place[axis] + velocity[axis] * T::lit(elapsed)) - sum / T::lit(masses.total);
            } else {
                values[0] = velocity[axis] - sum / T::lit(masses.centre);
            }
            for (planet, body) in self.planets.iter().zip(1..) {
                values[body] =
                    if kind == 0 { values[0] + planet.position[axis] } else { velocity[axis] + planet.velocity[axis] };
            }
        }
    }

    /// What Kepler's motion about the central body adds to each planet in a time.
    pub(crate) fn keplerian(&self, masses: &PlanetMasses, time: f64, out: &mut [Increment<T>]) {
        if !is_double::<T>() {
            for (planet, out) in self.planets.iter().zip(out) {
                *out = advance(T::lit(masses.centre), planet.position, planet.velocity, T::lit(time));
            }
            return;
        }
        for (planets, out) in self.planets.chunks(LANES).zip(out.chunks_mut(LANES)) {
            // Where there is no planet a body rests beside a centre that does not draw it.
            let mut parameter = Lanes::splat(0.0);
            let mut position = [Lanes::splat(1.0), Lanes::splat(0.0), Lanes::splat(0.0)];
            let mut velocity = [Lanes::splat(0.0); 3];
            for (lane, planet) in planets.iter().enumerate() {
                parameter.0[lane] = masses.centre;
                for axis in 0..3 {
                    position[axis].0[lane] = planet.position[axis].primal(0);
                    velocity[axis].0[lane] = planet.velocity[axis].primal(0);
                }
            }
            let increment = dispatch(AdvanceEight { parameter, position, velocity, time });
            for (lane, out) in out.iter_mut().enumerate() {
                *out = Increment {
                    position: increment.position.map(|x| T::lit(x.0[lane])),
                    velocity: increment.velocity.map(|x| T::lit(x.0[lane])),
                };
            }
        }
    }

    pub(crate) fn add(&mut self, increments: &[Increment<T>]) {
        for (planet, increment) in self.planets.iter_mut().zip(increments) {
            planet.shift(increment.position);
            planet.push(increment.velocity);
        }
    }

    /// The attractions between planets, each times its weight, and the motion of the central body, for a time.
    ///
    /// The two parts commute: the motion of the central body changes the places of all planets alike, and attractions change no
    /// total momentum.
    ///
    /// ```text
    /// V̇ᵢ = Σⱼ Gmⱼ w(i, j, dᵢⱼ) dᵢⱼ        Q̇ᵢ = Σⱼ mⱼ Vⱼ/m₀
    /// ```
    pub(crate) fn attract(
        &mut self,
        masses: &PlanetMasses,
        time: f64,
        weight: &impl Fn(usize, usize, [T; 3]) -> T,
        accelerations: &mut [[T; 3]],
    ) {
        accelerations.fill([T::zero(); 3]);
        for (rank, &first) in masses.heavy.iter().enumerate() {
            let mut own = accelerations[first];
            for &second in masses.heavy[rank + 1..].iter().chain(&masses.light) {
                let [x, y] = [self.planets[first].position, self.planets[second].position];
                let d = [y[0] - x[0], y[1] - x[1], y[2] - x[2]];
                let weight = weight(first, second, d);
                let on_first = T::lit(masses.planets[second]) * weight;
                let on_second = T::lit(masses.planets[first]) * weight;
                for axis in 0..3 {
                    own[axis] += on_first * d[axis];
                    accelerations[second][axis] -= on_second * d[axis];
                }
            }
            accelerations[first] = own;
        }
        let mut momentum = [T::zero(); 3];
        for (&parameter, planet) in masses.planets.iter().zip(&self.planets) {
            for (momentum, velocity) in momentum.iter_mut().zip(planet.velocity) {
                *momentum += T::lit(parameter) * velocity;
            }
        }
        let shift = momentum.map(|p| T::lit(time / masses.centre) * p);
        for (planet, acceleration) in self.planets.iter_mut().zip(accelerations) {
            planet.shift(shift);
            planet.push(acceleration.map(|a| T::lit(time) * a));
        }
    }
}

/// The weight of an attraction that is nowhere taken out: |d|⁻³.
#[cfg_attr(not(debug_assertions), inline(always))]
pub(crate) fn whole<T: Real>(_first: usize, _second: usize, d: [T; 3]) -> T {
    inverse_cube(d, T::zero())
}

/// Whether a scalar is one number of double precision and nothing else.
fn is_double<T: Real>() -> bool {
    let (tenth, half_ulp) = (0.1, 0.5 * f64::EPSILON);
    let holds_no_less = T::lit(tenth).primal(0).to_bits() == tenth.to_bits();
    let holds_no_more = ((T::one() + T::lit(half_ulp)) - T::one()).primal(0).abs() <= 0.0;
    T::LANES == 1 && T::ORDER == 0 && holds_no_less && holds_no_more
}

/// Kepler's motion of eight planets.
struct AdvanceEight {
    parameter: Lanes<f64, LANES>,
    position: [Lanes<f64, LANES>; 3],
    velocity: [Lanes<f64, LANES>; 3],
    time: f64,
}

impl Kernel for AdvanceEight {
    type Output = Increment<Lanes<f64, LANES>>;
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        advance(self.parameter, self.position, self.velocity, Lanes::splat(self.time))
    }
}
