//! Differential fluids: the extra stress follows an equation of relaxation along the motion.

mod convected_maxwell;
mod giesekus;
mod mode;
pub(in crate::fluids) mod motion;
mod multi_mode;
mod phan_thien_tanner;
mod slipping;
mod steady;

pub use convected_maxwell::{ConvectedMaxwell, LinearMode, OldroydB, UpperConvectedMaxwell};
pub use giesekus::Giesekus;
pub use mode::{DifferentialFluid, Extension, Mode, ShearStresses};
pub use motion::{Following, Oscillation, follow, follow_shear, oscillate};
pub use multi_mode::Modes;
pub use phan_thien_tanner::{ExponentialPhanThienTanner, LinearPhanThienTanner};
pub use slipping::{NetworkMode, Slipping};
