//! Fluids: what a material answers to the rate and the history of its deformation, up to a pressure.
//!
//! Simple shear is v₂ = k x₁: direction 1 is that of the velocity gradient, 2 that of the flow, 3 neutral. In it a simple fluid
//! is three functions of the shear rate k, its [viscometric functions](ViscometricFluid):
//!
//! ```text
//! T₁₂ = τ(k)                 odd,  the shear stress
//! σ₁(k) = T₁₁ − T₃₃          even, the second normal stress difference N₂ of rheologists
//! σ₂(k) = T₂₂ − T₃₃          even; N₁ = T₂₂ − T₁₁ = σ₂ − σ₁
//! ```
//!
//! A fluid of your own gives τ as one function over any scalar; its inverse, viscosity and derivatives follow.
//!
//! | the fluid | is |
//! |---|---|
//! | thins or thickens, no elasticity | [`PowerLaw`], [`CarreauYasuda`], [`Cross`], [`Ellis`], [`Eyring`], [`Sisko`] |
//! | is solid at small stresses | [`Bingham`], [`HerschelBulkley`], [`Casson`]; nearly so: [`Papanastasiou`] |
//! | flows in three dimensions by the present rate | [`LinearViscous`], [`GeneralisedNewtonian`], [`ReinerRivlin`], [`SecondOrder`]: [`ViscousFluid`] |
//! | is a pressure that depends on the density | [`EulerianFluid`], [`Polytropic`] |
//! | remembers, by an equation along the motion | [`UpperConvectedMaxwell`], [`OldroydB`], [`Giesekus`], [`LinearPhanThienTanner`], [`ExponentialPhanThienTanner`], [`Modes`] of them: [`DifferentialFluid`] |
//! | remembers, by an integral over its history | [`Kbkz`] |
//! | is at another temperature | [`Arrhenius`], [`WilliamsLandelFerry`] |
//! | is read from a file | [`AnyFluid`] |

mod answers;
mod any;
mod bingham;
mod carreau_yasuda;
mod casson;
mod cross;
mod differential;
mod ellis;
mod eulerian;
mod eyring;
mod generalised_newtonian;
mod herschel_bulkley;
mod kbkz;
mod linear_viscous;
mod newtonian;
mod papanastasiou;
mod parameters;
mod power_law;
mod quadrature;
mod reiner_rivlin;
mod second_order;
mod sisko;
mod temperature;
mod viscometric;
mod viscous;

pub use any::{
    AnyFluid, ConstantReinerRivlin, ExponentialPhanThienTannerModes, GiesekusModes, KbkzExponential, KbkzRational,
    LinearPhanThienTannerModes, OldroydBModes,
};
pub use bingham::Bingham;
pub use carreau_yasuda::CarreauYasuda;
pub use casson::Casson;
pub use cross::Cross;
pub use differential::{
    ConvectedMaxwell, DifferentialFluid, ExponentialPhanThienTanner, Extension, Giesekus, LinearMode,
    LinearPhanThienTanner, Mode, Modes, OldroydB, Oscillation, ShearStresses, UpperConvectedMaxwell, follow,
    follow_shear, oscillate,
};
pub use ellis::Ellis;
pub use eulerian::{EulerianFluid, Polytropic};
pub use eyring::Eyring;
pub use generalised_newtonian::GeneralisedNewtonian;
pub use herschel_bulkley::HerschelBulkley;
pub use kbkz::{Damping, ExponentialDamping, Kbkz, RationalDamping, Relaxation};
pub use linear_viscous::LinearViscous;
pub use newtonian::Newtonian;
pub use papanastasiou::Papanastasiou;
pub use parameters::Parameters;
pub use power_law::PowerLaw;
pub use quadrature::Integral;
pub use reiner_rivlin::{ConstantCoefficients, ReinerRivlin, ReinerRivlinCoefficients};
pub use second_order::SecondOrder;
pub use sisko::Sisko;
pub use temperature::{Arrhenius, Shifted, TemperatureShift, WilliamsLandelFerry};
pub use viscometric::{FlowMoment, ViscometricFluid};
pub use viscous::ViscousFluid;
