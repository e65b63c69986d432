//! Polar and spherical coordinates with their momenta.

use piola_numerics::Real;

use crate::HamiltonianError;
use crate::check::check_length;
use crate::{InvertiblePhaseMap, PhaseMap};

fn check<T>(dimension: usize, q: &[T], p: &[T], out: &[T]) -> Result<(), HamiltonianError> {
    check_length("q", dimension, q.len())?;
    check_length("p", dimension, p.len())?;
    check_length("the image", 2 * dimension, out.len())
}

/// (x, y, p_x, p_y) ↦ (r, φ, p_r, p_φ).
///
/// ```text
/// r = √(x² + y²)    φ = atan2(y, x)    p_r = (x p_x + y p_y)/r    p_φ = x p_y − y p_x
/// ```
///
/// At the origin p_r is not a number; every function of this module refuses such a result by name.
///
/// # Example
/// ```
/// use piola_hamiltonian::{PhaseMap, PolarCoordinates};
/// let mut new = [0.0; 4];
/// PolarCoordinates.map(&[3.0, 4.0], &[1.0, 3.0], 0.0, &mut new)?;
/// assert_eq!((new[0], new[2], new[3]), (5.0, 3.0, 5.0));
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PolarCoordinates;

impl PhaseMap for PolarCoordinates {
    fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        check(2, q, p, new)?;
        let radius = (q[0] * q[0] + q[1] * q[1]).sqrt();
        new[0] = radius;
        new[1] = q[1].atan2(q[0]);
        new[2] = (q[0] * p[0] + q[1] * p[1]) / radius;
        new[3] = q[0] * p[1] - q[1] * p[0];
        Ok(())
    }
}

impl InvertiblePhaseMap for PolarCoordinates {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], _t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        check(2, new_q, new_p, old)?;
        let (s, c) = new_q[1].sin_cos();
        let across = new_p[1] / new_q[0];
        old[0] = new_q[0] * c;
        old[1] = new_q[0] * s;
        old[2] = new_p[0] * c - across * s;
        old[3] = new_p[0] * s + across * c;
        Ok(())
    }
}

/// (x, y, z, p) ↦ (r, ϑ, φ, p_r, p_ϑ, p_φ), ϑ being measured from the z axis.
///
/// ```text
/// r = |x|    ϑ = atan2(ρ, z)    φ = atan2(y, x)    ρ = √(x² + y²)
/// p_r = x·p/r    p_ϑ = (z (x p_x + y p_y) − ρ² p_z)/ρ    p_φ = x p_y − y p_x
/// ```
///
/// On the z axis p_ϑ is not a number; every function of this module refuses such a result by name.
///
/// # Example
/// ```
/// use piola_hamiltonian::{Inverse, PhaseMap, SphericalCoordinates};
/// let (mut new, mut back) = ([0.0_f64; 6], [0.0_f64; 6]);
/// SphericalCoordinates.map(&[3.0, 4.0, 12.0], &[1.0, 3.0, 2.0], 0.0, &mut new)?;
/// assert_eq!((new[0], new[3], new[5]), (13.0, 3.0, 5.0));
/// Inverse(SphericalCoordinates).map(&new[..3], &new[3..], 0.0, &mut back)?;
/// assert!((back[2] - 12.0).abs() < 1e-14 && (back[5] - 2.0).abs() < 1e-14);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SphericalCoordinates;

impl PhaseMap for SphericalCoordinates {
    fn map<T: Real>(&self, q: &[T], p: &[T], _t: T, new: &mut [T]) -> Result<(), HamiltonianError> {
        check(3, q, p, new)?;
        let [x, y, z] = [q[0], q[1], q[2]];
        let square = x * x + y * y;
        let (cylinder, radius) = (square.sqrt(), (square + z * z).sqrt());
        let outwards = x * p[0] + y * p[1];
        new[0] = radius;
        new[1] = cylinder.atan2(z);
        new[2] = y.atan2(x);
        new[3] = (outwards + z * p[2]) / radius;
        new[4] = (z * outwards - square * p[2]) / cylinder;
        new[5] = x * p[1] - y * p[0];
        Ok(())
    }
}

impl InvertiblePhaseMap for SphericalCoordinates {
    fn invert<T: Real>(&self, new_q: &[T], new_p: &[T], _t: T, old: &mut [T]) -> Result<(), HamiltonianError> {
        check(3, new_q, new_p, old)?;
        let ((s, c), (sine, cosine)) = (new_q[1].sin_cos(), new_q[2].sin_cos());
        let (radius, along) = (new_q[0], new_p[0]);
        let (down, across) = (new_p[1] / radius, new_p[2] / (radius * s));
        let outwards = along * s + down * c;
        old[0] = radius * s * cosine;
        old[1] = radius * s * sine;
        old[2] = radius * c;
        old[3] = outwards * cosine - across * sine;
        old[4] = outwards * sine + across * cosine;
        old[5] = along * c - down * s;
        Ok(())
    }
}
