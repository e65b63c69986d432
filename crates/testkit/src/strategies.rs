//! Random inputs for identities, to be used with proptest.
//!
//! ```
//! use piola_testkit::strategies;
//! use proptest::prelude::*;
//! proptest!(|(n in strategies::unit_vector())| {
//!     prop_assert!((n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0).abs() < 4.0 * f64::EPSILON);
//! });
//! ```

use core::ops::Range;

use proptest::collection;
use proptest::prelude::*;

/// The number of random cases that a test tries: a tenth of `all`, or `all` where the environment sets `PIOLA_ALL_CASES`.
///
/// # Example
///
/// ```
/// use piola_testkit::strategies::random_cases;
/// use proptest::prelude::*;
/// proptest!(ProptestConfig::with_cases(random_cases(1_000)), |(x in -1.0_f64..1.0)| prop_assert!(x.abs() <= 1.0));
/// ```
#[must_use]
pub fn random_cases(all: u32) -> u32 {
    if std::env::var_os("PIOLA_ALL_CASES").is_some() { all } else { all.div_ceil(10) }
}

/// Numbers of a finite range.
///
/// # Panics
/// When an end is not finite: the numbers would not be either.
pub fn finite(range: Range<f64>) -> impl Strategy<Value = f64> + Clone {
    assert!(range.start.is_finite() && range.end.is_finite(), "the ends of {range:?} are not finite");
    range
}

/// `n` numbers of a finite range.
///
/// # Panics
/// When an end is not finite.
pub fn vector(n: usize, range: Range<f64>) -> impl Strategy<Value = Vec<f64>> + Clone {
    collection::vec(finite(range), n)
}

/// Directions in space, uniformly distributed.
pub fn unit_vector() -> impl Strategy<Value = [f64; 3]> + Clone {
    // Archimedes: the height of a point of the sphere is uniformly distributed.
    (-1.0..1.0_f64, -core::f64::consts::PI..core::f64::consts::PI).prop_map(|(height, azimuth)| {
        let radius = ((1.0 - height) * (1.0 + height)).sqrt();
        [radius * azimuth.cos(), radius * azimuth.sin(), height]
    })
}

/// Unit quaternions (w, x, y, z), uniformly distributed over the rotations.
pub fn rotation() -> impl Strategy<Value = [f64; 4]> + Clone {
    // Two points of circles whose radii share the unit: Shoemake, Graphics Gems III (1992).
    let turn = -core::f64::consts::PI..core::f64::consts::PI;
    (0.0..1.0_f64, turn.clone(), turn).prop_map(|(share, first, second)| {
        let (r, s) = (share.sqrt(), (1.0 - share).sqrt());
        [r * first.cos(), r * first.sin(), s * second.cos(), s * second.sin()]
    })
}

/// The rotation matrix, by rows, of a unit quaternion (w, x, y, z).
#[must_use]
pub fn rotation_matrix([w, x, y, z]: [f64; 4]) -> [[f64; 3]; 3] {
    [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)],
        [2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)],
        [2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)],
    ]
}

/// Symmetric positive definite 3×3 matrices R diag(λ) Rᵀ with eigenvalues λ of the range, exactly symmetric.
///
/// # Panics
/// When the range does not start above zero.
pub fn positive_definite(eigenvalues: Range<f64>) -> impl Strategy<Value = [[f64; 3]; 3]> + Clone {
    assert!(0.0 < eigenvalues.start, "{eigenvalues:?} does not start above zero");
    (rotation(), vector(3, eigenvalues)).prop_map(|(quaternion, lambda)| {
        let r = rotation_matrix(quaternion);
        let mut matrix = [[0.0; 3]; 3];
        for i in 0..3 {
            for j in 0..=i {
                matrix[i][j] = (0..3).map(|k| r[i][k] * lambda[k] * r[j][k]).sum();
                matrix[j][i] = matrix[i][j];
            }
        }
        matrix
    })
}
