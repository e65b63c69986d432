//! Bodies on a rough plane: a sphere, a disc, a blade.
//!
//! The plane is z = 0, the bodies above it. Gravity may have any direction, so that the plane may be inclined:
//! [`Lagrangian::with_uniform_gravity`](crate::Lagrangian::with_uniform_gravity). Each system is a
//! placement and a frame at once, whose last quasi-velocities are those of the point of contact; `on_plane` holds
//! these at zero.
//!
//! Contacts hold in both directions: nothing lifts off, and friction has no limit. The force of contact says whether
//! a real plane would do that: pull where its z component is negative, slip where its share of the normal force is
//! too large.
//!
//! | system | q | w | held |
//! |---|---|---|---|
//! | [`RollingSphere`] | x, y of the centre, quaternion | ω in space | slip along x, y, length of the quaternion |
//! | [`RollingDisc`] | x, y of the contact, θ¹, θ², θ³ | θ̇¹, θ̇², θ̇³ | slip along and across the track |
//! | [`KnifeEdge`] | x, y of the blade, φ | speed along, φ̇ | speed across |
//!
//! # Example
//! A homogeneous sphere rolls down an incline of slope 3/4 with a = 5/7 g sin α; the friction is 2/7 of the pull.
//! ```
//! use piola_lagrangian::anholonomic::rolling::RollingSphere;
//! let (pull, normal) = (6.0, 8.0); // g = 10 m/s²
//! let sphere = RollingSphere::homogeneous(7.0, 0.5)?.on_plane([pull, 0.0, -normal]);
//! let q = RollingSphere::coordinates(0.0, 0.0);
//! let acceleration = sphere.coordinate_acceleration(&q, &[0.0; 3], 0.0)?;
//! assert!((acceleration[0] - 5.0 / 7.0 * pull).abs() < 1e-14);
//! let contact = sphere.part_reactions(&q, &[0.0; 3], 0.0)?[0];
//! assert!((contact.force().x + 2.0 * pull).abs() < 1e-13 && (contact.force().z - 7.0 * normal).abs() < 1e-13);
//! # Ok::<(), piola_lagrangian::LagrangianError>(())
//! ```

mod disc;
mod knife_edge;
mod sphere;

pub use disc::RollingDisc;
pub use knife_edge::KnifeEdge;
pub use sphere::RollingSphere;

use super::{ByFrame, Nonholonomic};
use crate::{AnholonomicError, LagrangianError};
use crate::{NoForces, NoPotential};

/// A system on its plane: placement, frame and conditions.
///
/// # Example
/// See the [module](self).
pub type OnPlane<S> = Nonholonomic<S, NoPotential, NoForces, ByFrame<S>>;

fn check_length(quantity: &'static str, value: f64) -> Result<f64, LagrangianError> {
    if 0.0 < value && value < f64::INFINITY {
        Ok(value)
    } else {
        Err(LagrangianError::Anholonomic(AnholonomicError::InvalidLength { quantity, value }))
    }
}
