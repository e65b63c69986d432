//! A family as a motion in Cartesian coordinates.

use nalgebra::Vector3;
use piola_fields::{Cartesian, Coordinates, Cylindrical, FieldsError, Motion, Spherical};
use piola_numerics::Real;

use super::Family;
use crate::SolutionsError;

/// A system of coordinates whose map from Cartesian ones is known.
///
/// # Example
/// See [`AsMotion`].
pub trait FromCartesian: Coordinates + Default {
    /// The coordinates of a place, m or rad; angles in (−π, π].
    #[must_use]
    fn of_place<T: Real>(place: [T; 3]) -> [T; 3];
}

impl FromCartesian for Cartesian {
    fn of_place<T: Real>(place: [T; 3]) -> [T; 3] {
        place
    }
}

impl FromCartesian for Cylindrical {
    fn of_place<T: Real>([x, y, z]: [T; 3]) -> [T; 3] {
        [(x * x + y * y).sqrt(), y.atan2(x), z]
    }
}

impl FromCartesian for Spherical {
    fn of_place<T: Real>([x, y, z]: [T; 3]) -> [T; 3] {
        let across = x * x + y * y;
        [(across + z * z).sqrt(), y.atan2(x), across.sqrt().atan2(z)]
    }
}

/// A [`Family`] as a motion x(X) in Cartesian coordinates, at rest.
///
/// Angles of the reference are taken from (−π, π].
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_fields::Motion;
/// use piola_solutions::families::{AsMotion, TubeDeformation};
/// // A cylinder twisted by ½ rad/m: its cross section at Z = π turns by a quarter.
/// let twist = AsMotion(TubeDeformation::new([1.0, 0.0, 1.0, 0.5, 0.0, 1.0])?);
/// let x = twist.position(&Vector3::new(2.0, 0.0, core::f64::consts::PI), 0.0)?;
/// assert!((x - Vector3::new(0.0, 2.0, core::f64::consts::PI)).norm() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AsMotion<F>(pub F);

impl<F: Family> Motion for AsMotion<F> {
    fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
        let coordinates = self.0.place(F::Reference::of_place((*reference).into()));
        F::Current::default().place(&Vector3::from(coordinates))
    }

    fn check_domain<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Result<(), FieldsError> {
        for lane in 0..T::LANES {
            let at: [f64; 3] = F::Reference::of_place(reference.map(|x| x.primal(lane)).into());
            self.0.check_domain(at).map_err(|error| match error {
                SolutionsError::OutsideDomain { value, .. } => {
                    FieldsError::SingularCoordinates { coordinates: at, volume_element: value }
                }
                SolutionsError::NotFinite { quantity, index, value } => {
                    FieldsError::NotFinite { quantity, index, value }
                }
                _ => FieldsError::SingularCoordinates { coordinates: at, volume_element: 0.0 },
            })?;
        }
        Ok(())
    }
}
