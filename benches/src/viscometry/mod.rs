//! Flows that shear a fluid: ours, plain quadrature of the textbook's formulas, closed forms; and histories of K-BKZ fluids.

pub mod accuracy;
pub mod history;
pub mod plain;
pub mod problems;
pub mod sheet;
pub mod truth;

use piola_fluids::FluidsError;
use piola_fluids::{CarreauYasuda, ExponentialDamping, Giesekus, HerschelBulkley, Kbkz, PowerLaw, Relaxation};

/// A fluid whose flows are closed.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn power_law() -> Result<PowerLaw, FluidsError> {
    PowerLaw::new(1.5, 0.4)
}

/// A fluid whose stress is a formula of the rate and whose rate is not one of the stress.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn carreau_yasuda() -> Result<CarreauYasuda, FluidsError> {
    CarreauYasuda::new(1.0, 0.0, 2.0, 0.5, 1.25)
}

/// A fluid that yields.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn herschel_bulkley() -> Result<HerschelBulkley, FluidsError> {
    HerschelBulkley::new(0.5, 1.0, 0.4)
}

/// A fluid with normal stresses.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn giesekus() -> Result<Giesekus, FluidsError> {
    Giesekus::new(0.1, 1.0, 2.0, 0.3)
}

/// A fluid that remembers, over three decades of times; damped after Wagner, so that its steady shear is closed.
///
/// # Errors
/// None: its parameters are within bounds.
pub fn melt() -> Result<Kbkz<ExponentialDamping>, FluidsError> {
    let memory = [(2.0, 0.01), (5.0, 0.1), (8.0, 1.0)].map(|(viscosity, time)| Relaxation { viscosity, time });
    Kbkz::new(memory.to_vec(), ExponentialDamping::new(DAMPING, 1.0)?)
}

/// n of the damping e^(−n γ) of [`melt`].
pub const DAMPING: f64 = 0.3;
