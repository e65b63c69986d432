//! Bodies that attract each other by Newton's law, as points.
//!
//! ```text
//! aᵢ = Σⱼ Gmⱼ (xⱼ − xᵢ) / (|xⱼ − xᵢ|² + ε²)^(3/2)                                          W(4.2)
//! ```
//!
//! The sum is direct, in lanes, over all cores beyond [`PARALLEL_BODIES`] with feature `rayon`, and
//! bit-identical for every number of lanes and threads: each body sums over the others in their order.
//! Softening ε is off unless asked for. The post-Newtonian term of one central body is a separate request.
//!
//! The state is kept by components, (x₁…xₙ, y₁…yₙ, z₁…zₙ), then velocities in the same order: this is what
//! lanes load. [`Gravitation::position`] and [`Gravitation::velocity`] read one body of it.
//!
//! # Example
//! ```
//! use piola_dynamics::gravitation::Gravitation;
//! use piola_integrators::{Composition, Order, State};
//! // Two equal bodies on a circle about their centre: Gm = 1 each, distance 2, speed ½, period 4π.
//! let mut pair = Gravitation::new(vec![1.0, 1.0])?;
//! let start = pair.state(&[[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]], &[[0.0, 0.5, 0.0], [0.0, -0.5, 0.0]])?;
//! let mut state = State::new(0.0, start)?;
//! let period = 4.0 * std::f64::consts::PI;
//! Composition::new(Order::Eight, period / 100.0)?.integrate_to(&mut pair, &mut state, period)?;
//! assert!((pair.position(&state.values, 0)[0] - 1.0).abs() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod attraction;
mod invariants;
mod post_newtonian;

use core::convert::Infallible;

use piola_integrators::{Field, Separable};
use piola_numerics::{Dual, Real};

pub use attraction::{PARALLEL_BODIES, attraction};
pub use invariants::GravitationInvariants;
pub use post_newtonian::{PostNewtonian, SPEED_OF_LIGHT, post_newtonian_acceleration};

use crate::DynamicsError;
use attraction::Summation;

/// Bodies with their gravitational parameters Gm (m³/s²), and what acts between them.
///
/// It is a [`Separable`] system without, and a [`Field`] with or without, the post-Newtonian term.
#[derive(Clone, Debug)]
pub struct Gravitation {
    parameters: Vec<f64>,
    softening: f64,
    post_newtonian: Option<PostNewtonian>,
    summation: Summation,
}

impl Gravitation {
    /// Bodies with the gravitational parameters Gm (m³/s²); a body without mass is a test particle.
    ///
    /// # Errors
    /// [`DynamicsError::InvalidGravitationalParameter`] unless every 0 ≤ Gm < ∞.
    pub fn new(parameters: Vec<f64>) -> Result<Self, DynamicsError> {
        for (body, &value) in parameters.iter().enumerate() {
            if !(0.0 <= value && value < f64::INFINITY) {
                return Err(DynamicsError::InvalidGravitationalParameter { body, value });
            }
        }
        let summation = Summation::new(parameters.len());
        Ok(Self { parameters, softening: 0.0, post_newtonian: None, summation })
    }

    /// Softens the attraction by the length ε (m).
    ///
    /// # Errors
    /// [`DynamicsError::InvalidSoftening`] unless 0 ≤ ε < ∞.
    pub fn with_softening(mut self, softening: f64) -> Result<Self, DynamicsError> {
        if !(0.0 <= softening && softening < f64::INFINITY) {
            return Err(DynamicsError::InvalidSoftening { value: softening });
        }
        self.softening = softening;
        Ok(self)
    }

    /// Adds the first post-Newtonian term of one central body, which makes the force depend on velocities.
    ///
    /// # Errors
    /// [`DynamicsError::NoSuchBody`], [`DynamicsError::MasslessCentre`].
    pub fn with_post_newtonian(mut self, term: PostNewtonian) -> Result<Self, DynamicsError> {
        match self.parameters.get(term.centre) {
            None => Err(DynamicsError::NoSuchBody { body: term.centre, bodies: self.parameters.len() }),
            Some(&parameter) if parameter <= 0.0 => Err(DynamicsError::MasslessCentre { body: term.centre }),
            Some(_) => {
                self.post_newtonian = Some(term);
                Ok(self)
            }
        }
    }

    /// The number of bodies n.
    #[must_use]
    pub fn bodies(&self) -> usize {
        self.parameters.len()
    }

    /// The gravitational parameters Gm, m³/s².
    #[must_use]
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// The softening length ε, m.
    #[must_use]
    pub const fn softening(&self) -> f64 {
        self.softening
    }

    /// The post-Newtonian term, if it is on.
    #[must_use]
    pub const fn post_newtonian(&self) -> Option<PostNewtonian> {
        self.post_newtonian
    }

    /// The state made of positions (m) and velocities (m/s), one triple a body.
    ///
    /// # Errors
    /// [`DynamicsError::DimensionMismatch`], [`DynamicsError::NonFinite`], and
    /// [`DynamicsError::CoincidentBodies`] when two bodies that attract are in one place without softening.
    pub fn state(&self, positions: &[[f64; 3]], velocities: &[[f64; 3]]) -> Result<Vec<f64>, DynamicsError> {
        let n = self.bodies();
        let mut state = vec![0.0; 6 * n];
        for (block, (quantity, triples)) in
            [("positions", positions), ("velocities", velocities)].into_iter().enumerate()
        {
            if triples.len() != n {
                return Err(DynamicsError::DimensionMismatch { quantity, expected: n, found: triples.len() });
            }
            for (body, triple) in triples.iter().enumerate() {
                for (component, &value) in triple.iter().enumerate() {
                    if !value.is_finite() {
                        return Err(DynamicsError::NonFinite { quantity, index: 3 * body + component, value });
                    }
                    state[(3 * block + component) * n + body] = value;
                }
            }
        }
        if self.softening <= 0.0
            && let Some((first, second)) = self.coincident(&state)
        {
            return Err(DynamicsError::CoincidentBodies { first, second });
        }
        Ok(state)
    }

    /// The first two bodies in one place of which at least one attracts, if there are any.
    #[must_use]
    pub fn coincident(&self, state: &[f64]) -> Option<(usize, usize)> {
        let n = self.bodies();
        let mut order: Vec<usize> = (0..n).collect();
        let place = |i: usize| self.position(state, i);
        order.sort_by(|&i, &j| place(i).partial_cmp(&place(j)).unwrap_or(core::cmp::Ordering::Equal));
        order
            .windows(2)
            .filter(|pair| {
                let same = place(pair[0]).iter().zip(place(pair[1])).all(|(a, b)| (a - b).abs() <= 0.0);
                same && 0.0 < self.parameters[pair[0]] + self.parameters[pair[1]]
            })
            .map(|pair| (pair[0].min(pair[1]), pair[0].max(pair[1])))
            .min()
    }

    /// The position of one body (m), from a state or from its first half.
    #[must_use]
    pub fn position<T: Real>(&self, state: &[T], body: usize) -> [T; 3] {
        let n = self.bodies();
        [state[body], state[n + body], state[2 * n + body]]
    }

    /// The velocity of one body (m/s), from a state.
    #[must_use]
    pub fn velocity<T: Real>(&self, state: &[T], body: usize) -> [T; 3] {
        let n = self.bodies();
        [state[3 * n + body], state[4 * n + body], state[5 * n + body]]
    }

    /// Writes the Newtonian accelerations (m/s²) at the positions: both in the order of the state.
    ///
    /// # Accuracy
    /// A few ulp of the sum of the magnitudes of the terms.
    pub fn accelerations_into(&mut self, positions: &[f64], accelerations: &mut [f64]) {
        self.summation.run(&self.parameters, self.softening * self.softening, positions, accelerations);
    }

    /// The Newtonian accelerations over any scalar: the same formula, without lanes.
    pub fn accelerations_over<T: Real>(&self, positions: &[T], accelerations: &mut [T]) {
        attraction::sum_over(&self.parameters, self.softening * self.softening, positions, accelerations);
    }

    fn add_post_newtonian<T: Real>(&self, state: &[T], accelerations: &mut [T]) {
        if let Some(term) = self.post_newtonian {
            post_newtonian::add(&self.parameters, term, state, accelerations);
        }
    }

    fn magnitudes<T: Real>(&self, y: &[T], magnitudes: &mut [f64]) {
        // The error of a body is relative to its own distance and speed, but a body that stands still at the
        // origin is not asked for the impossible.
        let n = self.bodies();
        for block in 0..2 {
            let part = &y[3 * n * block..3 * n * (block + 1)];
            let size = |body: usize| {
                let sum: f64 = (0..3)
                    .map(|component| {
                        let value: f64 = part[component * n + body].primal(0);
                        value * value
                    })
                    .sum();
                sum.sqrt()
            };
            let largest = (0..n).map(size).fold(0.0, f64::max);
            for body in 0..n {
                let magnitude = size(body).max(1e-3 * largest);
                for component in 0..3 {
                    magnitudes[3 * n * block + component * n + body] = magnitude;
                }
            }
        }
    }
}

impl Separable for Gravitation {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        3 * self.bodies()
    }
    fn force(&mut self, _t: f64, position: &[f64], force: &mut [f64]) -> Result<(), Infallible> {
        self.accelerations_into(position, force);
        Ok(())
    }
}

impl Field for Gravitation {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        6 * self.bodies()
    }
    fn is_second_order(&self) -> bool {
        true
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Infallible> {
        let half = 3 * self.bodies();
        rate[..half].copy_from_slice(&y[half..]);
        self.accelerations_into(&y[..half], &mut rate[half..]);
        self.add_post_newtonian(y, &mut rate[half..]);
        Ok(())
    }
    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        self.magnitudes(y, magnitudes);
    }
}

impl<T: Real> Separable<Dual<T>> for Gravitation {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        3 * self.bodies()
    }
    fn force(&mut self, _t: f64, position: &[Dual<T>], force: &mut [Dual<T>]) -> Result<(), Infallible> {
        self.accelerations_over(position, force);
        Ok(())
    }
}

impl<T: Real> Field<Dual<T>> for Gravitation {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        6 * self.bodies()
    }
    fn is_second_order(&self) -> bool {
        true
    }
    fn rate(&mut self, _t: f64, y: &[Dual<T>], rate: &mut [Dual<T>]) -> Result<(), Infallible> {
        let half = 3 * self.bodies();
        rate[..half].copy_from_slice(&y[half..]);
        self.accelerations_over(&y[..half], &mut rate[half..]);
        self.add_post_newtonian(y, &mut rate[half..]);
        Ok(())
    }
    fn magnitudes(&self, y: &[Dual<T>], magnitudes: &mut [f64]) {
        self.magnitudes(y, magnitudes);
    }
}
