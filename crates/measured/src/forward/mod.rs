//! Flows of any fluid: a drive or an answer in, all answers with their error bounds and the profile out. Specimens of any solid: a
//! path of stretches or loads in, all components of strain and stress out.
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

//!
//! | specimen | is changed, or prescribed beside it |
//! |---|---|
//! | `uniaxial`, `equibiaxial`, `planar` | `stretch`, `strain`, `stress` (P), `true_stress` (T) |
//! | `biaxial` | the same along 1; `second_stretch`, `second_stress` along 2 |
//! | `simple-shear` | `shear` (k = F₂₁), `shear_stress` (T₂₁) |
//! | `volumetric` | `volume` (det F), `pressure` |
//! | `mixed`, and all above | any component: `F11` to `F33`, `P11` to `P33`, `T11` to `T33` |
//! | `torsion` | `twist`; `stretch` or `force` of the ends; sizes `radius`, `inner_radius` |
//!
//! Sides that are not named are free of traction, shears that are not named are zero; a planar specimen is held along 2.

#[cfg(feature = "specimens")]
mod controls;
mod flow;
mod fluid;
mod output;
mod quantity;
mod solid;
#[cfg(feature = "specimens")]
mod specimen;
#[cfg(feature = "specimens")]
mod specimen_output;

pub use flow::{Answered, FlowRequest, ProfilePoint, SolvedFlow, solve};
pub use fluid::fluid;
pub use solid::solid;
#[cfg(feature = "specimens")]
pub use specimen::{LoadedSpecimen, SpecimenRequest, specimen};
