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
//! use piola_gravitation::Gravitation;
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
#![forbid(unsafe_code)]
#![cfg_attr(docsrs, feature(doc_cfg))]

mod attraction;
mod check;
mod checkpoint;
mod error;
mod field;
#[cfg(feature = "glam")]
mod glam;
pub mod hybrid;
mod invariants;
pub mod kepler;
mod post_newtonian;
pub mod regularised;
pub mod wisdom_holman;

use piola_numerics::{Mask, Real};

pub use attraction::{PARALLEL_BODIES, attraction};
pub use error::GravitationError;
pub use invariants::GravitationInvariants;
pub use post_newtonian::{PostNewtonian, SPEED_OF_LIGHT, post_newtonian_acceleration};

use crate::check::{check_finite, check_length};
use attraction::Summation;

/// Bodies with their gravitational parameters Gm (m³/s²), and what acts between them.
///
/// It is a [`Separable`](piola_integrators::Separable) system without, and a
/// [`Field`](piola_integrators::Field) with or without, the post-Newtonian term.
///
/// # Example
/// See the [module](self).
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "Unchecked", into = "Unchecked"))]
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
    /// [`GravitationError::InvalidGravitationalParameter`] unless every 0 ≤ Gm < ∞.
    pub fn new(parameters: Vec<f64>) -> Result<Self, GravitationError> {
        for (body, &value) in parameters.iter().enumerate() {
            if !(0.0 <= value && value < f64::INFINITY) {
                return Err(GravitationError::InvalidGravitationalParameter { body, value });
            }
        }
        let summation = Summation::new(parameters.len());
        Ok(Self { parameters, softening: 0.0, post_newtonian: None, summation })
    }

    /// Softens the attraction by the length ε (m).
    ///
    /// # Errors
    /// [`GravitationError::InvalidSoftening`] unless 0 ≤ ε < ∞.
    pub fn with_softening(mut self, softening: f64) -> Result<Self, GravitationError> {
        if !(0.0 <= softening && softening < f64::INFINITY) {
            return Err(GravitationError::InvalidSoftening { value: softening });
        }
        self.softening = softening;
        Ok(self)
    }

    /// Adds the first post-Newtonian term of one central body, which makes the force depend on velocities.
    ///
    /// # Errors
    /// [`GravitationError::NoSuchBody`], [`GravitationError::MasslessCentre`], and
    /// [`GravitationError::InvalidSpeedOfLight`] unless 0 < c < ∞.
    pub fn with_post_newtonian(mut self, term: PostNewtonian) -> Result<Self, GravitationError> {
        if !(0.0 < term.speed_of_light && term.speed_of_light < f64::INFINITY) {
            return Err(GravitationError::InvalidSpeedOfLight { value: term.speed_of_light });
        }
        match self.parameters.get(term.centre) {
            None => Err(GravitationError::NoSuchBody { body: term.centre, bodies: self.parameters.len() }),
            Some(&parameter) if parameter <= 0.0 => Err(GravitationError::MasslessCentre { body: term.centre }),
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

    /// The state made of positions (m) and velocities (m/s), one triple a body: arrays, nalgebra's `Vector3`,
    /// glam's `DVec3`.
    ///
    /// # Errors
    /// [`GravitationError::WrongLength`], [`GravitationError::NotFinite`], and
    /// [`GravitationError::CoincidentBodies`] when two bodies are in one place where their attraction is
    /// infinite: see [`with_softening`](Self::with_softening).
    ///
    /// # Example
    /// ```
    /// use piola_gravitation::Gravitation;
    /// let pair = Gravitation::new(vec![1.0, 1.0])?;
    /// let state = pair.state(&[[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]], &[[0.0; 3]; 2])?;
    /// assert_eq!(state[..6], [1.0, 4.0, 2.0, 5.0, 3.0, 6.0]); // x of both, y of both, z of both
    /// # Ok::<(), piola_gravitation::GravitationError>(())
    /// ```
    pub fn state<V: Copy + Into<[f64; 3]>>(
        &self,
        positions: &[V],
        velocities: &[V],
    ) -> Result<Vec<f64>, GravitationError> {
        let n = self.bodies();
        let mut state = vec![0.0; 6 * n];
        for (block, (quantity, triples)) in
            [("positions", positions), ("velocities", velocities)].into_iter().enumerate()
        {
            check_length(quantity, n, triples.len())?;
            for (body, &triple) in triples.iter().enumerate() {
                for (component, value) in triple.into().into_iter().enumerate() {
                    if !value.is_finite() {
                        return Err(GravitationError::NotFinite { quantity, index: 3 * body + component, value });
                    }
                    state[(3 * block + component) * n + body] = value;
                }
            }
        }
        let pair = if self.softening <= 0.0 { self.coincident(&state) } else { self.at_the_centre(&state) };
        match pair {
            Some((first, second)) => Err(GravitationError::CoincidentBodies { first, second }),
            None => Ok(state),
        }
    }

    /// The central body of the post-Newtonian term, which nothing softens, and one in the same place.
    fn at_the_centre(&self, state: &[f64]) -> Option<(usize, usize)> {
        let centre = self.post_newtonian?.centre;
        let mut others = (0..self.bodies()).filter(|&other| other != centre);
        let other = others.find(|&other| self.is_infinite_between(state, centre, other))?;
        Some((centre.min(other), centre.max(other)))
    }

    /// The first two bodies in one place of which at least one attracts, if there are any.
    #[must_use]
    pub fn coincident(&self, state: &[f64]) -> Option<(usize, usize)> {
        // Both zeros are one place; NaN is none.
        let place = |&i: &usize| self.position(state, i).map(|x| x + 0.0);
        let mut order: Vec<usize> = (0..self.bodies()).filter(|i| place(i).iter().all(|x| x.is_finite())).collect();
        let compare = |i: &usize, j: &usize| {
            let [a, b] = [place(i), place(j)];
            a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])).then(a[2].total_cmp(&b[2]))
        };
        order.sort_by(compare); // stable: bodies in one place stay in their order
        order
            .chunk_by(|i, j| compare(i, j).is_eq())
            .filter_map(|together| {
                let first = *together.first()?;
                let mut others = together[1..].iter().copied();
                let second = others.find(|&other| 0.0 < self.parameters[first] + self.parameters[other])?;
                Some((first, second))
            })
            .min()
    }

    /// The position of one body (m), from a state or from its first half.
    ///
    /// # Panics
    /// As indexing does: `body` must be below [`bodies`](Self::bodies), the state one of this system.
    #[must_use]
    pub fn position<T: Real>(&self, state: &[T], body: usize) -> [T; 3] {
        let n = self.bodies();
        [state[body], state[n + body], state[2 * n + body]]
    }

    /// The velocity of one body (m/s), from a state.
    ///
    /// # Panics
    /// As [`position`](Self::position).
    #[must_use]
    pub fn velocity<T: Real>(&self, state: &[T], body: usize) -> [T; 3] {
        let n = self.bodies();
        [state[3 * n + body], state[4 * n + body], state[5 * n + body]]
    }

    /// Writes the Newtonian accelerations (m/s²) at the positions: both in the order of the state.
    ///
    /// # Errors
    /// [`GravitationError::WrongLength`]; when an acceleration is infinite or NaN, why:
    /// [`GravitationError::NotFinite`] for a position, [`GravitationError::CoincidentBodies`] for bodies whose
    /// distance is zero or so small that its cube is. Nothing is looked for while all is well.
    ///
    /// # Accuracy
    /// A few ulp of the sum of the magnitudes of the terms.
    pub fn accelerations_into(&mut self, positions: &[f64], accelerations: &mut [f64]) -> Result<(), GravitationError> {
        self.check_lengths(positions, accelerations)?;
        self.summation.run(&self.parameters, self.softening * self.softening, positions, accelerations);
        self.check_accelerations(positions, &[], accelerations)
    }

    /// The Newtonian accelerations over any scalar: the same formula, without lanes, and for floats the same
    /// results to the last bit.
    ///
    /// # Errors
    /// As [`accelerations_into`](Self::accelerations_into).
    #[cfg_attr(not(debug_assertions), inline(always))]
    pub fn accelerations_over<T: Real>(
        &self,
        positions: &[T],
        accelerations: &mut [T],
    ) -> Result<(), GravitationError> {
        self.check_lengths(positions, accelerations)?;
        attraction::sum_over(&self.parameters, self.softening * self.softening, positions, accelerations);
        self.check_accelerations(positions, &[], accelerations)
    }

    fn check_lengths<T>(&self, positions: &[T], accelerations: &[T]) -> Result<(), GravitationError> {
        check_length("positions", 3 * self.bodies(), positions.len())?;
        check_length("accelerations", 3 * self.bodies(), accelerations.len())
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn check_accelerations<T: Real>(
        &self,
        positions: &[T],
        velocities: &[T],
        accelerations: &[T],
    ) -> Result<(), GravitationError> {
        let finite = accelerations.iter().fold(T::Mask::splat(true), |all, a| all & a.is_finite());
        if finite.all() { Ok(()) } else { Err(self.explain(positions, velocities, accelerations)) }
    }

    /// Why an acceleration is not finite.
    #[cold]
    fn explain<T: Real>(&self, positions: &[T], velocities: &[T], accelerations: &[T]) -> GravitationError {
        let given = check_finite("positions", positions).and_then(|()| check_finite("velocities", velocities));
        if let Err(error) = given {
            return error;
        }
        for first in 0..self.bodies() {
            for second in first + 1..self.bodies() {
                if self.is_infinite_between(positions, first, second) {
                    return GravitationError::CoincidentBodies { first, second };
                }
            }
        }
        match check_finite("accelerations", accelerations) {
            Err(error) => error,
            Ok(()) => GravitationError::NotFinite { quantity: "accelerations", index: 0, value: f64::NAN },
        }
    }

    /// Whether what one of two bodies does to the other is infinite, in some lane.
    fn is_infinite_between<T: Real>(&self, positions: &[T], first: usize, second: usize) -> bool {
        let (x, y) = (self.position(positions, first), self.position(positions, second));
        let distance: [T; 3] = core::array::from_fn(|k| y[k] - x[k]);
        let infinite = |a: [T; 3]| a.iter().any(|a| !a.is_finite().all());
        let parameter = self.parameters[first].max(self.parameters[second]);
        let attracts = 0.0 < parameter;
        let softening_squared = T::lit(self.softening * self.softening);
        attracts && infinite(attraction(distance, T::lit(parameter), softening_squared))
            || self.post_newtonian.is_some_and(|term| {
                let (mu, c) = (T::lit(self.parameters[term.centre]), T::lit(term.speed_of_light));
                [first, second].contains(&term.centre)
                    && infinite(post_newtonian_acceleration(distance, [T::zero(); 3], mu, c))
            })
    }

    #[cfg_attr(not(debug_assertions), inline(always))]
    fn add_post_newtonian<T: Real>(
        &self,
        positions: &[T],
        velocities: &[T],
        accelerations: &mut [T],
    ) -> Result<(), GravitationError> {
        let Some(term) = self.post_newtonian else { return Ok(()) };
        post_newtonian::add(&self.parameters, term, [positions, velocities], accelerations);
        self.check_accelerations(positions, velocities, accelerations)
    }

    fn magnitudes<T: Real>(&self, y: &[T], magnitudes: &mut [f64]) {
        // The error of a body is relative to its own distance and speed, but a body that stands still at the
        // origin is not asked for the impossible.
        let n = self.bodies();
        for block in 0..2 {
            let part = &y[3 * n * block..3 * n * (block + 1)];
            let size = |body: usize| {
                // Over lanes the largest counts; NaN shows in the error itself.
                (0..T::LANES)
                    .map(|lane| {
                        let [x, y, z] = [0, n, 2 * n].map(|start| part[start + body].primal(lane));
                        (x * x + y * y + z * z).sqrt()
                    })
                    .fold(0.0, f64::max)
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

/// What is written of a system, checked when it is read.
#[cfg(feature = "serde")]
#[derive(serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    parameters: Vec<f64>,
    #[serde(default)]
    softening: f64,
    #[serde(default)]
    post_newtonian: Option<PostNewtonian>,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Gravitation {
    type Error = GravitationError;
    fn try_from(unchecked: Unchecked) -> Result<Self, GravitationError> {
        let system = Self::new(unchecked.parameters)?.with_softening(unchecked.softening)?;
        match unchecked.post_newtonian {
            None => Ok(system),
            Some(term) => system.with_post_newtonian(term),
        }
    }
}

#[cfg(feature = "serde")]
impl From<Gravitation> for Unchecked {
    fn from(system: Gravitation) -> Self {
        let Gravitation { parameters, softening, post_newtonian, .. } = system;
        Self { parameters, softening, post_newtonian }
    }
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadMe;
