//! Stresses in any motion and after any history.

mod convected_maxwell;
mod eulerian;
mod following;
mod generalised_newtonian;
mod histories;
mod kbkz;
mod linear_viscous;
mod oscillation;
mod quadrature;
mod reiner_rivlin;
mod second_order;
mod shear_stresses;
mod simple_fluid;
mod steady;
mod stokesian;
mod stress_rate;
mod viscous;

pub use convected_maxwell::ConvectedMaxwell;
pub use eulerian::{EulerianFluid, Polytropic};
pub use following::{Following, follow, follow_shear};
pub use generalised_newtonian::GeneralisedNewtonian;
pub use histories::{PlaneHistory, Referred, SeenFrom, fluid_indifference, plane_history, reference_indifference};
pub use linear_viscous::LinearViscous;
pub use oscillation::{Oscillation, oscillate};
pub use shear_stresses::ShearStresses;
pub use simple_fluid::{Moduli, SimpleFluid};
pub use steady::SteadyStress;
pub use stokesian::{CompressibleReinerRivlin, StokesianFluid};
pub use stress_rate::StressRate;
pub use viscous::ViscousFluid;
