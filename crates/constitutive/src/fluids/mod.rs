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
//! A fluid of your own gives τ as one function over any scalar; its inverse, viscosity and derivatives follow. At many rates the functions
//! of [`batch`] run in lanes.
//!
//! | the fluid | is |
//! |---|---|
//! | thins or thickens, no elasticity | [`PowerLaw`], [`CarreauYasuda`], [`Cross`], [`Ellis`], [`Eyring`], [`Sisko`] |
//! | is solid at small stresses | [`Bingham`], [`HerschelBulkley`], [`Casson`]; nearly so: [`Papanastasiou`] |
//! | flows in three dimensions by the present rate | [`LinearViscous`], [`GeneralisedNewtonian`], [`ReinerRivlin`], [`SecondOrder`]: [`ViscousFluid`] |
//! | is a pressure that depends on the density | [`EulerianFluid`], [`Polytropic`] |
//! | remembers, by an equation along the motion | [`UpperConvectedMaxwell`], [`OldroydB`], [`Giesekus`], [`LinearPhanThienTanner`], [`ExponentialPhanThienTanner`], with slip as [`Slipping`], [`Modes`] of them: [`DifferentialFluid`] |
//! | remembers, by an integral over its history | [`Kbkz`] |
//! | is at another temperature | [`Arrhenius`], [`WilliamsLandelFerry`] |
//! | is read from a file | [`AnyFluid`] |
//!
//! # What each answers to
//!
//! The same questions go to every fluid through [`SimpleFluid`]; formulas are marked ●, roots of one equation ○, six equations ◐,
//! quadratures with an error ∫, integrations to a tolerance →.
//!
//! | fluid | τ, N₁, N₂ | ζ = τ⁻¹ | steady L | motion | samples | start, stop | small oscillation | large oscillation | extension |
//! |---|---|---|---|---|---|---|---|---|---|
//! | [`Newtonian`], [`Bingham`], [`Casson`], [`Eyring`], [`PowerLaw`], [`HerschelBulkley`] | ● | ● | ● | ● | ● | ● | ● ¹ | ∫ | ● |
//! | [`CarreauYasuda`], [`Cross`], [`Sisko`], [`Papanastasiou`] | ● | ○ | ● | ● | ● | ● | ● ¹ | ∫ | ● |
//! | [`Ellis`] | ○ | ● | ○ | ○ | ○ | ○ | ● | ∫ | ○ |
//! | [`ReinerRivlin`], [`GeneralisedNewtonian`] of any, [`LinearViscous`] ² | ● | ○ | ● | ● | ● | ● | ● ¹ | ∫ | ● |
//! | [`SecondOrder`] | ● | ○ | ● | ● | ● | ● | ● | ● | ● |
//! | [`UpperConvectedMaxwell`], [`OldroydB`] | ● | ● | ◐ ³ | → ⁴ | ● | ● | ● | → | ● ³ |
//! | [`Giesekus`] | ● | ○ | ◐ | → | → | → | ● | → | ● |
//! | [`LinearPhanThienTanner`], [`ExponentialPhanThienTanner`] | ○ | ● ⁵ | ◐ | → | → | → | ● | → | ○ |
//! | [`Slipping`] networks | ○ | ● ⁵ | ◐ | → | → | → | ● | → | ○ ³ |
//! | [`Modes`] of these | as one | ○ | as one | → | → | → ⁴ | ● | → | as one |
//! | [`Kbkz`] | ∫ | ○ | ∫ ³ | ∫ | ∫ | ∫ | ● | ∫ | ∫ ³ |
//!
//! ¹ An error where the viscosity at rest is infinite: with a yield stress, and of powers below 1. ² [`LinearViscous`] is asked for
//! L alone. ³ An error where the stress would grow without end: 2 λ ε̇ ≥ 1 without anything that limits it. ⁴ By formulas through
//! [`ConvectedMaxwell`]: any history of constant pieces, one given as a strain by ∫. ⁵ Without solvent; with it a root.
//! [`EulerianFluid`]s have a pressure of the present density and nothing else.
//!
//! Derivatives: the functions of shear and the steady stresses are over any scalar, those of differential fluids by implicit
//! differentiation ([`DifferentialFluid::steady_stress`]).

mod answers;
mod any;
pub mod batch;
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
mod histories;
mod kbkz;
mod kbkz_histories;
mod linear_viscous;
mod navier_stokes;
mod newtonian;
mod papanastasiou;
mod parameters;
mod power_law;
mod quadrature;
mod reiner_rivlin;
mod second_order;
mod simple_fluid;
mod sisko;
mod temperature;
mod viscometric;
mod viscous;

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
    ConvectedMaxwell, DifferentialFluid, ExponentialPhanThienTanner, Extension, Following, Giesekus, LinearMode,
    LinearPhanThienTanner, Mode, Modes, NetworkMode, OldroydB, Oscillation, ShearStresses, Slipping,
    UpperConvectedMaxwell, follow, follow_shear, oscillate,
};
pub use ellis::Ellis;
pub use eulerian::{EulerianFluid, Polytropic};
pub use eyring::Eyring;
pub use generalised_newtonian::GeneralisedNewtonian;
pub use herschel_bulkley::HerschelBulkley;
pub use histories::{
    ConstantStretchHistory, PlaneHistory, Referred, SeenFrom, Viscometric, fluid_indifference, plane_history,
    reference_indifference, steady_turn, stretch_history, viscometric_motion,
};
pub use kbkz::{Damping, ExponentialDamping, Kbkz, RationalDamping, Relaxation};
pub use linear_viscous::LinearViscous;
pub use navier_stokes::{CartesianCoordinates, ViscousStress, navier_stokes_residual};
pub use newtonian::Newtonian;
pub use papanastasiou::Papanastasiou;
pub use parameters::Parameters;
pub use power_law::PowerLaw;
pub use quadrature::Integral;
pub use reiner_rivlin::{ConstantCoefficients, ReinerRivlin, ReinerRivlinCoefficients};
pub use second_order::SecondOrder;
pub use simple_fluid::{Moduli, SimpleFluid};
pub use sisko::Sisko;
pub use temperature::{Arrhenius, Shifted, TemperatureShift, WilliamsLandelFerry};
pub use viscometric::{FlowMoment, ViscometricFluid};
pub use viscous::ViscousFluid;
