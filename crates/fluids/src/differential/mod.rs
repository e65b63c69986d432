//! Differential fluids: the extra stress follows an equation of relaxation along the motion.

mod giesekus;
mod maxwell;
mod mode;
mod multi_mode;
mod phan_thien_tanner;
mod slipping;

pub use giesekus::Giesekus;
pub use maxwell::{LinearMode, OldroydB, UpperConvectedMaxwell};
pub use mode::{DifferentialFluid, Extension, Mode};
pub use multi_mode::Modes;
pub use phan_thien_tanner::{ExponentialPhanThienTanner, LinearPhanThienTanner};
pub use slipping::{NetworkMode, Slipping};
