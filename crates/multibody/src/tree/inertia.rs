//! What a body of a tree weighs: mass, centre of mass and inertia, or nothing.

use nalgebra::Vector3;
use piola_kinematics::{Inertia, KinematicsError, RigidBody};

/// Mass, centre of mass and inertia about it, in the axes of a body's frame.
///
/// # Example
/// ```
/// use piola_kinematics::{Inertia, RigidBody};
/// use piola_multibody::BodyInertia;
/// let rod = RigidBody::new(2.0, Inertia::principal([0.1, 0.1, 0.01])?)?;
/// let inertia = BodyInertia::of(&rod, [0.0, 0.0, 0.5]);
/// assert_eq!((inertia.mass(), inertia.centre()), (2.0, [0.0, 0.0, 0.5]));
/// # Ok::<(), piola_kinematics::KinematicsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyInertia {
    mass: f64,
    centre: [f64; 3],
    about_centre: [[f64; 3]; 3],
}

impl BodyInertia {
    /// No mass at all, as between two joints in series.
    pub const MASSLESS: Self = Self { mass: 0.0, centre: [0.0; 3], about_centre: [[0.0; 3]; 3] };

    /// Those of a rigid body with its centre of mass at `centre` (m), from the origin of the body's frame.
    #[must_use]
    pub fn of(body: &RigidBody, centre: [f64; 3]) -> Self {
        Self { mass: body.mass(), centre, about_centre: (*body.inertia()).into() }
    }

    /// Those of a particle: mass in kg, place in m.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`], [`KinematicsError::NonPositiveMass`].
    pub fn particle(mass: f64, place: [f64; 3]) -> Result<Self, KinematicsError> {
        finite("place", &place)?;
        positive(mass)?;
        Ok(Self { mass, centre: place, about_centre: [[0.0; 3]; 3] })
    }

    /// Those of a mass (kg) and a matrix about the centre of mass (kg m²), which must be an inertia tensor.
    ///
    /// # Errors
    /// As [`RigidBody::new`] and [`Inertia::new`]: the condition that is violated.
    pub fn new(mass: f64, centre: [f64; 3], about_centre: [[f64; 3]; 3]) -> Result<Self, KinematicsError> {
        finite("centre of mass", &centre)?;
        let inertia = Inertia::try_from(about_centre)?;
        Ok(Self::of(&RigidBody::new(mass, inertia)?, centre))
    }

    /// As [`new`](Self::new), but the matrix may be any that is finite and symmetric: zero, or one that no body has.
    ///
    /// Files of robots hold such matrices, rounded or left out. The equations are then those of the numbers given. They have
    /// solutions as long as the mass matrix of the tree is positive definite.
    ///
    /// # Errors
    /// [`KinematicsError::NotFinite`], [`KinematicsError::InertiaNotSymmetric`] beyond 10⁻¹² of the largest entry,
    /// [`KinematicsError::NonPositiveMass`] where the mass is negative.
    pub fn as_given(mass: f64, centre: [f64; 3], about_centre: [[f64; 3]; 3]) -> Result<Self, KinematicsError> {
        finite("centre of mass", &centre)?;
        finite("inertia tensor", about_centre.as_flattened())?;
        finite("mass", &[mass])?;
        if mass < 0.0 {
            return Err(KinematicsError::NonPositiveMass { mass });
        }
        let scale = about_centre.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let mut symmetric = about_centre;
        for (row, column) in [(0, 1), (0, 2), (1, 2)] {
            let difference = about_centre[row][column] - about_centre[column][row];
            if 1.0e-12 * scale < difference.abs() {
                return Err(KinematicsError::InertiaNotSymmetric { row, column, difference });
            }
            symmetric[column][row] = about_centre[row][column];
        }
        Ok(Self { mass, centre, about_centre: symmetric })
    }

    /// Mass, kg.
    #[must_use]
    pub const fn mass(&self) -> f64 {
        self.mass
    }

    /// Centre of mass, m, from the origin of the body's frame.
    #[must_use]
    pub const fn centre(&self) -> [f64; 3] {
        self.centre
    }

    /// Inertia about the centre of mass, kg m², by rows.
    #[must_use]
    pub const fn about_centre(&self) -> [[f64; 3]; 3] {
        self.about_centre
    }

    /// (first moment, inertia about the origin) in a frame in which the body's frame has the axes `axes` and the origin
    /// `origin`.
    pub(crate) fn seen_from(&self, axes: [[f64; 3]; 3], origin: [f64; 3]) -> ([f64; 3], [f64; 6]) {
        use crate::spatial::{add, times, translated_inertia};
        use crate::turn::{AnyTurn, Turning};
        let centre = add(origin, times(axes, self.centre));
        let a = self.about_centre;
        let about_centre = AnyTurn(axes).symmetric_to_parent([a[0][0], a[0][1], a[0][2], a[1][1], a[1][2], a[2][2]]);
        let mut inertia = translated_inertia(self.mass, [0.0; 3], centre);
        for (sum, part) in inertia.iter_mut().zip(about_centre) {
            *sum += part;
        }
        (centre.map(|c| self.mass * c), inertia)
    }
}

impl From<(&RigidBody, Vector3<f64>)> for BodyInertia {
    /// A rigid body with its centre of mass.
    fn from((body, centre): (&RigidBody, Vector3<f64>)) -> Self {
        Self::of(body, centre.into())
    }
}

/// 0 < mass < ∞.
fn positive(mass: f64) -> Result<(), KinematicsError> {
    finite("mass", &[mass])?;
    if mass <= 0.0 { Err(KinematicsError::NonPositiveMass { mass }) } else { Ok(()) }
}

fn finite(quantity: &'static str, values: &[f64]) -> Result<(), KinematicsError> {
    match values.iter().position(|x| !x.is_finite()) {
        None => Ok(()),
        Some(index) => Err(KinematicsError::NotFinite { quantity, index, value: values[index] }),
    }
}
