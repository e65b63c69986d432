//! Canonical transformations ready to use.
//!
//! | from → to | type |
//! |---|---|
//! | any coordinates → others, q = c(Q, t) | [`PointTransformation`] |
//! | plane → polar | [`PolarCoordinates`] |
//! | space → spherical | [`SphericalCoordinates`] |
//! | oscillator → angle and action | [`OscillatorActionAngle`] |
//! | Kepler's motion in space → Delaunay's elements | [`Delaunay`] |
//! | a plane or space → a frame that turns | [`RotatingFrame`] |

mod curvilinear;
mod delaunay;
mod oscillator;
mod point;
mod rotating;

pub use curvilinear::{PolarCoordinates, SphericalCoordinates};
pub use delaunay::{Delaunay, KeplerOfActions};
pub use oscillator::OscillatorActionAngle;
pub use point::PointTransformation;
pub use rotating::RotatingFrame;

use piola_numerics::Real;

use crate::HamiltonianError;

/// Refuses an action outside its range, in any lane.
fn check_action<T: Real>(index: usize, action: T, range: (f64, f64)) -> Result<(), HamiltonianError> {
    (0..T::LANES).try_for_each(|lane| check_action_value(index, action.primal(lane), range))
}

fn check_action_value(index: usize, value: f64, (least, greatest): (f64, f64)) -> Result<(), HamiltonianError> {
    if least <= value && value <= greatest {
        Ok(())
    } else {
        Err(HamiltonianError::InvalidAction { index, value, least, greatest })
    }
}
