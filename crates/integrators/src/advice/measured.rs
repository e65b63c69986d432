//! Error against time, measured: written by `cargo xtask work-precision`.

use super::AdvisedMethod::*;
use super::table::{Curve, Measured, Point};

pub(super) const MEASURED: &[Measured] = &[];
