//! Solids with internal variables: flow, plasticity, damage, growth.
#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

#[cfg(feature = "any")]
mod any;
mod bergstrom_boyce;
mod by_tangent;
mod driven_growth;
mod error;
mod evolution;
mod flow;
mod given;
mod grown;
mod in_lanes;
mod in_series;
mod inelastic_point;
mod kinematic;
mod mullins;
mod newton;
mod path;
mod points;
mod reese_govindjee;
mod viscoplastic;
#[cfg(feature = "serde")]
mod written;

#[cfg(feature = "any")]
pub use any::{AnyAdvanced, AnyInelastic, MOST_STATE};
pub use bergstrom_boyce::{BergstromBoyce, PowerFlow};
pub use by_tangent::ByTangent;
pub use driven_growth::DrivenGrowth;
pub use error::InelasticError;
pub use evolution::Evolution;
pub use given::{GivenGrowth, Thermal};
pub use grown::{Grown, ThermalExpansion};
pub use in_lanes::advance_in_lanes;
pub use in_series::InSeries;
pub use inelastic_point::{Advanced, InelasticPoint, NextIncrement};
pub use kinematic::Kinematic;
pub use mullins::Mullins;
pub use path::{Effort, StepControl};
pub use points::{OverHistory, advance_all, advance_components};
pub use reese_govindjee::ReeseGovindjee;
pub use viscoplastic::{Hardening, Viscoplastic};
