//! Initial value problems with known solutions, their equations written by hand as for any library.

mod arenstorf;
mod attraction;
mod double_pendulum;
mod henon_heiles;
mod inner_solar_system;
mod kepler;
mod reference;
mod spring_chain;
mod tops;

use std::time::Duration;

pub use arenstorf::{Arenstorf, arenstorf};
pub use attraction::{Attraction, cluster, outer_solar_system, outer_solar_system_long, pleiades};
pub use double_pendulum::{DoublePendulum, double_pendulum};
pub use henon_heiles::{HenonHeiles, henon_heiles};
pub use inner_solar_system::{PostNewtonianAttraction, inner_solar_system};
pub use kepler::{Kepler, kepler, kepler_long, kepler_round};
pub use reference::ReferenceError;
pub use spring_chain::{SpringChain, spring_chain};
pub use tops::{Top, free_top, heavy_top};

use piola_numerics::Real;

/// A run longer than this ends the curve of its method, unless a problem says otherwise.
pub(crate) const LONGEST_RUN: Duration = Duration::from_millis(120);

/// Equations of first order, ẏ = f(y), y being a block of positions and a block of velocities.
pub trait Equations<const D: usize> {
    /// The number of positions; all other components are velocities.
    const POSITIONS: usize = D / 2;
    /// Whether the rates of the positions are the velocities.
    const SECOND_ORDER: bool = true;
    /// Writes f(y).
    fn rate(&self, y: &[f64; D], rate: &mut [f64; D]);
}

/// Equations of second order, q̈ = f(q, q̇), over any scalar.
pub trait Accelerations {
    /// Whether f depends on q̇.
    const VELOCITY_DEPENDENT: bool = true;
    /// Writes f(q, q̇).
    fn accelerations<T: Real>(&self, q: &[T], v: &[T], out: &mut [T]);
}

/// Equations of second order, q̈ = f(q).
pub trait Force {
    /// Writes f(q).
    fn force(&self, position: &[f64], force: &mut [f64]);
}

/// A problem from time 0 to `end`.
#[derive(Clone, Debug)]
pub struct Problem<E, const D: usize> {
    /// The name of files and records.
    pub name: &'static str,
    /// One line about it.
    pub title: &'static str,
    /// The equations.
    pub equations: E,
    /// The state at time 0.
    pub start: [f64; D],
    /// The end time.
    pub end: f64,
    /// The state at the end.
    pub reference: [f64; D],
    /// The size of the smaller of both blocks of the state: absolute tolerances are relative to it where a
    /// method wants one.
    pub small: f64,
    /// A longer run ends the curve of its method.
    pub longest_run: Duration,
}

impl<E: Equations<D>, const D: usize> Problem<E, D> {
    /// The error of a final state: the largest difference of a component, relative to the largest component
    /// of its block (positions or velocities).
    ///
    /// # Panics
    /// The state has fewer than D components.
    #[must_use]
    pub fn error(&self, state: &[f64]) -> f64 {
        let mut error = 0.0_f64;
        for block in [0..E::POSITIONS, E::POSITIONS..D] {
            let (found, expected) = (&state[block.clone()], &self.reference[block]);
            let scale = expected.iter().fold(0.0_f64, |scale, x| scale.max(x.abs()));
            for (found, expected) in found.iter().zip(expected) {
                let difference = (found - expected).abs() / scale;
                error = if difference <= error { error } else { difference };
            }
        }
        error
    }
}
