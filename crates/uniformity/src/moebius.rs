//! The Möbius crystal: locally homogeneous, not globally.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, Vector3};
use piola_fields::{FieldsError, Motion};
use piola_numerics::{Mask, Real};

use crate::UniformityError;
use crate::curve::RoundCircuit;
use crate::error::check_bound;
use crate::map::{HomogeneousIn, UniformityMap};

/// A bar of crystal, bent to a ring after a half turn, its ends joined, W p. 178.
///
/// ```text
/// s = r φ     w = cos(φ/2)(ρ − r) + sin(φ/2) z     n = sin(φ/2)(ρ − r) − cos(φ/2) z        K⁻¹ = ∂(s, w, n)/∂X
/// ```
///
/// ρ, φ and z are cylindrical coordinates of X, and (s, w, n) those of the straight bar. Once around, (w, n) becomes (−w, −n): there K
/// becomes K H with H = diag(1, −1, −1), the half turn about the bar. A crystal with that symmetry does not feel the seam: the body is
/// materially uniform, the material connection is smooth and without torsion and curvature, and every small part can be straightened. The whole
/// cannot: a frame carried around returns turned by H.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_integrators::Tolerance;
/// use piola_uniformity::{Flatness, LieAlgebra, MaterialConnection, MoebiusCrystal, TransportedFrame, UniformityMap};
/// let crystal = MoebiusCrystal::new(2.0)?;
/// let place = Vector3::new(0.5, 1.75, 0.25);
/// assert!(Flatness::of_body(&crystal, LieAlgebra::trivial(), &[place], 2.0, 1e-12)?.is_flat());
/// let connection = MaterialConnection::of_crystal(crystal);
/// let core = crystal.core();
/// let start = crystal.value(&Vector3::new(2.0, 0.0, 0.0))?;
/// let round = TransportedFrame::around(&connection, &core, &start, Tolerance::relative(1e-12)?)?;
/// assert!((round.holonomy() - MoebiusCrystal::SEAM).norm() < 1e-10); // the half turn
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MoebiusCrystal {
    radius: f64,
    /// The azimuth opposite to the seam.
    opposite: f64,
}

impl MoebiusCrystal {
    /// H, what K becomes on the other side of the seam: K H.
    pub const SEAM: Matrix3<f64> = Matrix3::new(1.0, 0.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0);

    /// By the radius of the bar's axis, m, with the seam at the azimuth π.
    ///
    /// # Errors
    /// [`UniformityError::OutOfBounds`] unless 0 < radius < ∞.
    pub fn new(radius: f64) -> Result<Self, UniformityError> {
        check_bound("radius", radius, "0 < radius", 0.0 < radius)?;
        Ok(Self { radius, opposite: 0.0 })
    }

    /// The same body with the seam of its map at another azimuth, rad: K differs from that of the first by H between the seams.
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`].
    pub fn with_seam_at(self, azimuth: f64) -> Result<Self, UniformityError> {
        check_bound("azimuth", azimuth, "finite", true)?;
        Ok(Self { opposite: azimuth - 0.5 * TAU, ..self })
    }

    /// The axis of the bar, counter-clockwise about e₃ from the azimuth 0.
    #[must_use]
    pub fn core(&self) -> RoundCircuit {
        RoundCircuit::of_radii(Vector3::zeros(), [Vector3::x() * self.radius, Vector3::y() * self.radius])
    }

    /// The length of the bar, 2πr, m.
    #[must_use]
    pub fn length(&self) -> f64 {
        TAU * self.radius
    }
}

/// X ↦ (s, w, n), the straight bar cut at the seam.
impl Motion for MoebiusCrystal {
    fn place<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Vector3<T> {
        let [x, y, z] = (*reference).into();
        let (radius, half) = (T::lit(self.radius), T::lit(0.5));
        // The azimuth from the side opposite to the seam, where its branch is smooth.
        let (sine, cosine) = self.opposite.sin_cos();
        let (sine, cosine) = (T::lit(sine), T::lit(cosine));
        let azimuth = T::lit(self.opposite) + (y * cosine - x * sine).atan2(x * cosine + y * sine);
        let across = (x * x + y * y).sqrt() - radius;
        let (s, c) = (half * azimuth).sin_cos();
        Vector3::new(radius * azimuth, c * across + s * z, s * across - c * z)
    }

    fn check_domain<T: Real>(&self, reference: &Vector3<T>, _t: T) -> Result<(), FieldsError> {
        let square = reference.x * reference.x + reference.y * reference.y;
        if T::zero().less_than(square).all() {
            return Ok(());
        }
        let coordinates = [0, 1, 2].map(|i: usize| reference[i].primal(0));
        Err(FieldsError::SingularCoordinates { coordinates, volume_element: 0.0 })
    }
}

impl UniformityMap for MoebiusCrystal {
    fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
        HomogeneousIn(self).at(reference)
    }
    fn check_domain<T: Real>(&self, reference: &Vector3<T>) -> Result<(), UniformityError> {
        HomogeneousIn(self).check_domain(reference)
    }
}
