//! Rates: velocity gradient, rate of deformation and spin; rates of strain and of the polar factors; relative
//! deformation; exponential motions.
//!
//! | to get | use |
//! |---|---|
//! | L, D, W, J̇, grad a | [`VelocityGradient`], [`RateOfDeformation`], [`Spin`], [`AccelerationGradient`] |
//! | Ċ, Ė, Ḃ, ė | [`strain`] |
//! | U̇, V̇, Ṙ, (ln U)˙, (ln V)˙, spins of R, of ln V, of the principal axes | [`StretchRates`] |
//! | rates of stress that any observer agrees on | [`stress::rates`](crate::stress::rates) |
//! | Fₜ(τ), Cₜ; tensors of Rivlin–Ericksen and White–Metzner | [`RelativeDeformation`], [`RivlinEricksen`], [`WhiteMetzner`] |
//! | exp(Kt), its derivative, ln F of a general F | [`exponential`], [`exponential_derivative`], [`logarithm`] |
//! | motions F(t) of your own with all rates, linear and exponential ones | [`HomogeneousMotion`], [`LinearMotion`], [`ExponentialMotion`] |
//! | motions of constant stretch history, viscometric ones, and tests for them | [`ConstantStretchHistory`], [`stretch_history`], [`viscometric_motion`] |
//!
//! Ḟ is a [`GradientRate`]; the deformation may be given as F or as ∇u. Strains are those of the reference
//! configuration or of space as their names say; skew tensors are stored as axial vectors, Ω v = ω × v.

mod exponential;
mod histories;
pub(crate) mod kernels;
mod logarithmic_excess;
mod motion;
mod principal_frame;
mod relative;
mod spins;
pub mod strain;
mod stretch;
mod velocity_gradient;

pub use exponential::{
    exponential, exponential_derivative, exponential_minus_identity, exponential_minus_identity_rows, exponential_rows,
    logarithm, rotation_minus_identity,
};
pub use histories::{ConstantStretchHistory, Viscometric, steady_turn, stretch_history, viscometric_motion};
pub use motion::{ExponentialMotion, HomogeneousMotion, LinearMotion, MotionRates};
pub use relative::{RelativeDeformation, RivlinEricksen, WhiteMetzner, gradients_of_rates, steady_gradients};
pub use spins::{LogarithmicSpin, MaterialSpin, MaterialTwirl, PolarSpin, SpatialTwirl};
pub use stretch::StretchRates;
pub use velocity_gradient::{
    AccelerationGradient, GradientRate, GradientSecondRate, RateOfDeformation, Spin, VelocityGradient,
};
