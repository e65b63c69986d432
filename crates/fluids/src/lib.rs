//! Laws of fluids: viscometric functions, and stresses in any motion.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod answers;
mod any;
pub mod batch;
mod bingham;
mod carreau_yasuda;
mod casson;
mod cross;
mod differential;
mod ellis;
mod error;
mod eyring;
mod herschel_bulkley;
mod integral;
mod kbkz;
#[cfg(feature = "motions")]
mod motions;
#[cfg(feature = "fields")]
mod navier_stokes;
mod newtonian;
mod papanastasiou;
mod parameters;
mod power_law;
mod reiner_rivlin;
mod second_order;
mod sisko;
mod temperature;
mod viscometric;

pub use any::{
    AnyFluid, ConstantReinerRivlin, ExponentialPhanThienTannerModes, GiesekusModes, JohnsonSegalman, KbkzExponential,
    KbkzRational, LinearPhanThienTannerModes, OldroydBModes, SlippingExponentialPhanThienTanner,
    SlippingLinearPhanThienTanner,
};
pub use bingham::Bingham;
pub use carreau_yasuda::CarreauYasuda;
pub use casson::Casson;
pub use cross::Cross;
pub use differential::{
    DifferentialFluid, ExponentialPhanThienTanner, Extension, Giesekus, LinearMode, LinearPhanThienTanner, Mode, Modes,
    NetworkMode, OldroydB, Slipping, UpperConvectedMaxwell,
};
pub use ellis::Ellis;
pub use error::FluidsError;
pub use eyring::Eyring;
pub use herschel_bulkley::HerschelBulkley;
pub use integral::Integral;
pub use kbkz::{Damping, ExponentialDamping, Kbkz, RationalDamping, Relaxation};
#[cfg(feature = "motions")]
pub use motions::{
    CompressibleReinerRivlin, ConvectedMaxwell, EulerianFluid, Following, GeneralisedNewtonian, LinearViscous, Moduli,
    Oscillation, PlaneHistory, Polytropic, Referred, SeenFrom, ShearStresses, SimpleFluid, SteadyStress,
    StokesianFluid, StressRate, ViscousFluid, fluid_indifference, follow, follow_shear, oscillate, plane_history,
    reference_indifference,
};
#[cfg(feature = "fields")]
pub use navier_stokes::{CartesianCoordinates, ViscousStress, navier_stokes_residual};
pub use newtonian::Newtonian;
pub use papanastasiou::Papanastasiou;
pub use parameters::Parameters;
pub use power_law::PowerLaw;
pub use reiner_rivlin::{ConstantCoefficients, ReinerRivlin, ReinerRivlinCoefficients};
pub use second_order::SecondOrder;
pub use sisko::Sisko;
pub use temperature::{Arrhenius, Shifted, TemperatureShift, WilliamsLandelFerry};
pub use viscometric::{FlowMoment, ViscometricFluid};
