//! Whether the coordinates of a system are independent: the rank of the placement's Jacobian.
//!
//! ```text
//! J = rows √m ∂x/∂q^Δ of particles;  √M ∂x^c/∂q^Δ, √I ω_Δ of bodies       so that JᵀJ = g
//! rank J = n                                                             W(3.4)
//! ```
//!
//! Columns are scaled to length one, so that units of the coordinates do not matter; a column that is zero
//! belongs to a coordinate that moves nothing.

use nalgebra::{DMatrix, Vector3};
use piola_numerics::Dual;

use crate::attitude::Attitude;
use crate::error::{KinematicsError, finite};
use crate::placement::{Holonomic, Placement};
use crate::rigid_body::RigidBody;

/// How independent the coordinates are.
///
/// # Example
/// See [`independence`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Independence {
    /// Largest over smallest singular value of J with columns of length one: 1 for orthogonal tangents.
    pub condition_number: f64,
}

/// Checks at q and t that the coordinates are independent, and says how nearly they are not.
///
/// Singular values below 64 max(rows, n) ε of the largest count as zero: the derivatives are exact to
/// rounding. Independence may be lost at single points only, as at the pole of spherical coordinates.
/// For set-up: allocates.
///
/// # Errors
/// [`KinematicsError::DependentCoordinates`] names all coordinates that take part in a motion of the
/// coordinates that moves nothing; [`KinematicsError::NotFinite`].
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_kinematics::{Holonomic, KinematicsError, Placement, placement::independence};
/// use piola_numerics::Real;
/// /// Only the sum of the last two coordinates matters.
/// struct Sum;
/// impl Holonomic for Sum {
///     fn place<T: Real>(&self, q: &[T], _t: T, bodies: &mut impl Placement<T>) {
///         bodies.particle(1.0, Vector3::new(q[0], q[1] + q[2], T::zero()));
///     }
/// }
/// let found = independence(&Sum, &[0.1, 0.2, 0.3], 0.0);
/// assert_eq!(found, Err(KinematicsError::DependentCoordinates { coordinates: vec![1, 2], rank: 2 }));
/// ```
///
/// # Source
/// W(3.4).
pub fn independence(system: &impl Holonomic, q: &[f64], t: f64) -> Result<Independence, KinematicsError> {
    let n = q.len();
    finite("coordinates", q)?;
    if n == 0 {
        return Ok(Independence { condition_number: 1.0 });
    }
    let columns: Vec<Vec<f64>> = (0..n).map(|direction| column(system, q, t, direction)).collect();
    for (index, column) in columns.iter().enumerate() {
        if let Some((_, value)) = crate::vector::first_non_finite(column) {
            return Err(KinematicsError::NotFinite { quantity: "tangent vector", index, value });
        }
    }
    // At least n rows, so that the decomposition returns the whole null space.
    let rows = columns[0].len().max(n);
    let jacobian = DMatrix::from_fn(rows, n, |row, direction| {
        let column = &columns[direction];
        let length = length(column);
        if length <= 0.0 { 0.0 } else { column.get(row).map_or(0.0, |x| x / length) }
    });
    let decomposition = jacobian.svd(false, true);
    let values = &decomposition.singular_values;
    let (largest, smallest) = (values.max(), values.min());
    let threshold = 64.0 * rows as f64 * f64::EPSILON * largest;
    if threshold < smallest {
        return Ok(Independence { condition_number: largest / smallest });
    }
    let null = |index: usize| values[index] <= threshold;
    let rank = (0..n).filter(|&index| !null(index)).count();
    let right = decomposition.v_t.unwrap_or_else(|| DMatrix::identity(n, n));
    // A coordinate takes part when a null vector has a component in it that is not rounding.
    let coordinates = (0..n)
        .filter(|&coordinate| (0..n).any(|index| null(index) && NEGLIGIBLE < right[(index, coordinate)].abs()))
        .collect();
    Err(KinematicsError::DependentCoordinates { coordinates, rank })
}

/// Components of null vectors below this are rounding: √ε.
const NEGLIGIBLE: f64 = 1.5e-8;

/// Euclidean length without overflow.
fn length(column: &[f64]) -> f64 {
    column.iter().fold(0.0_f64, |length, &x| length.hypot(x))
}

/// Column Δ of J: the mass-weighted tangent vector `h_Δ`.
fn column(system: &impl Holonomic, q: &[f64], t: f64, direction: usize) -> Vec<f64> {
    let seeds: Vec<Dual<f64>> = (0..q.len())
        .map(|index| if index == direction { Dual::variable(q[index]) } else { Dual::constant(q[index]) })
        .collect();
    let mut column = Column(Vec::new());
    system.place(&seeds, Dual::constant(t), &mut column);
    column.0
}

struct Column(Vec<f64>);

impl Placement<Dual<f64>> for Column {
    fn particle(&mut self, mass: f64, position: Vector3<Dual<f64>>) {
        self.0.extend(position.iter().map(|x| mass.sqrt() * x.tangent));
    }
    fn body(&mut self, body: &RigidBody, centre: Vector3<Dual<f64>>, attitude: Attitude<Dual<f64>>) {
        self.particle(body.mass(), centre);
        let [w, x, y, z] = <[Dual<f64>; 4]>::from(attitude);
        let value = Attitude { w: w.value, x: x.value, y: y.value, z: z.value };
        let omega = value.angular_velocity_in_body([w.tangent, x.tangent, y.tangent, z.tangent]);
        // √I ω along the principal axes: its square is ω·Iω.
        let principal = body.inertia().principal_axes();
        let along_axes = principal.axes.transpose() * omega;
        self.0.extend((0..3).map(|i| principal.moments[i].max(0.0).sqrt() * along_axes[i]));
    }
}
