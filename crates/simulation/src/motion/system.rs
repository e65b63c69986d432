//! Systems made of data.

use piola_gravitation::kepler::KeplerMotion;

use crate::joints::Mechanism;
use crate::phase::PhaseSystem;

/// The kinds of systems.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone)]
pub enum System {
    /// Bodies that attract each other.
    Gravitation(Gravitation),
    /// Particles and rigid bodies on a tree of joints.
    Mechanism(Box<Mechanism>),
    /// Bodies about a fixed centre.
    Central(Central),
    /// Coordinates and momenta under a Hamiltonian.
    Phase(Box<PhaseSystem>),
}

impl System {
    /// Names of everything that has a position, in the order of positions.
    #[must_use]
    pub fn names(&self) -> Vec<&str> {
        match self {
            Self::Gravitation(system) => system.bodies.iter().map(|body| body.name.as_str()).collect(),
            Self::Mechanism(system) => system.parts.iter().map(|part| part.name.as_str()).collect(),
            Self::Central(system) => system.bodies.iter().map(|body| body.name.as_str()).collect(),
            Self::Phase(_) => Vec::new(),
        }
    }
}

/// Newton's constant of gravitation, m³ kg⁻¹ s⁻² (CODATA 2018; uncertain in the fifth digit).
pub const NEWTONIAN_CONSTANT: f64 = 6.674_30e-11;

/// Point masses with Newton's attraction.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone)]
pub struct Gravitation {
    /// The bodies, at least one.
    pub bodies: Vec<MassPoint>,
    /// Softening length ε, m; 0 for the true law.
    pub softening: f64,
    /// The post-Newtonian term, when asked for.
    pub post_newtonian: Option<PostNewtonian>,
}

/// A body without extent.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, PartialEq)]
pub struct MassPoint {
    /// Name.
    pub name: String,
    /// Gravitational parameter, m³/s².
    pub gm: f64,
    /// Position at the start, m.
    pub position: [f64; 3],
    /// Velocity at the start, m/s.
    pub velocity: [f64; 3],
}

/// The first post-Newtonian term of one body.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PostNewtonian {
    /// Index of the central body.
    pub central: usize,
}

/// Bodies about a fixed centre at the origin, without attraction among themselves.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone)]
pub struct Central {
    /// Gravitational parameter of the centre, m³/s².
    pub gm: f64,
    /// The bodies, at least one.
    pub bodies: Vec<Orbiter>,
}

/// A body about the centre.
///
/// # Example
/// See [`simulate`](super::simulate).
#[derive(Debug, Clone, PartialEq)]
pub struct Orbiter {
    /// Name.
    pub name: String,
    /// Mass, kg: a factor of energy and momentum only.
    pub mass: f64,
    /// Position at the start, m.
    pub position: [f64; 3],
    /// Velocity at the start, m/s.
    pub velocity: [f64; 3],
}

impl Central {
    /// The period of the first body, s; `None` if it escapes.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        let body = self.bodies.first()?;
        Some(KeplerMotion::new(self.gm, body.position, body.velocity).ok()?.period())
    }
}
