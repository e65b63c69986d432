//! Flows of any fluid: a drive or an answer in, all answers with their error bounds and the profile out.
//!
//! | flow | sizes | drive | or an answer |
//! |---|---|---|---|
//! | `pipe` | `radius` | `pressure_gradient` | `discharge` |
//! | `channel` | `half_width` | `pressure_gradient` | `discharge_per_width` |
//! | `annulus` | `inner_radius`, `outer_radius` | `pressure_gradient` | `discharge` |
//! | `couette` | `inner_radius`, `outer_radius` | `torque_per_length` | `speed_difference` |
//! | `plates` | `radius`, `gap` | `angular_velocity` | `torque` |
//! | `cone` | `radius`, `angle` | `angular_velocity` | `torque` |
//! | `film` | `density`, `inclination` | `thickness` | `discharge_per_width` |
//!
//! The film runs down under g = 9.80665 m/s²; its inclination is measured from the horizontal.

mod flow;
mod fluid;
mod output;

pub use flow::{Answered, FlowRequest, ProfilePoint, SolvedFlow, solve};
pub use fluid::fluid;
