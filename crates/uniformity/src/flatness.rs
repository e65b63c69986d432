//! Local homogeneity: whether torsion and curvature vanish, with the numbers that decide.
//!
//! ```text
//! locally homogeneous  ⇔  K⁻¹ H is a gradient for some H(X) ∈ 𝒢          W(26.10)
//!                      ⇔  a material connection has Y = 0 and R = 0       W(28.26), W(29.20)
//! ```
//!
//! For the symmetry algebra of a solid the connection of least torsion decides alone: no other can be free of torsion.

use nalgebra::{Matrix3, Vector3};
use piola_fields::Field;
use piola_integrators::Tolerance;
use piola_tensor::Symmetric;

use crate::UniformityError;
use crate::connection::{AffineConnection, LeviCivita, MaterialConnection};
use crate::curve::PolygonalCurve;
use crate::error::check_bound;
use crate::group::LieAlgebra;
use crate::map::UniformityMap;
use crate::transport::TransportedFrame;

/// The largest value of a tensor over places, and where it is: see [`Flatness`].
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct LargestDefect {
    /// The largest |component|: torsion 1/m, curvature 1/m².
    pub value: f64,
    /// The same without unit: divided by the size of the terms, and by 1/L or 1/L² where that is larger.
    pub relative: f64,
    /// Where.
    pub place: Vector3<f64>,
}

/// A verdict on local homogeneity, with its certificate: the largest torsion and curvature over the places that were looked at.
///
/// A body is judged at places, not between them: derivatives there are exact, so that a smooth map with torsion or curvature shows
/// them at almost every place.
///
/// # Example
/// A lattice that turns with X₁ has dislocations as a crystal and none as an isotropic solid.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_numerics::Real;
/// use piola_uniformity::{Flatness, LieAlgebra, UniformityMap};
/// struct Turning;
/// impl UniformityMap for Turning {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let ((s, c), o) = (reference.x.sin_cos(), T::zero());
///         Matrix3::new(c, -s, o, s, c, o, o, o, T::one())
///     }
/// }
/// let places = [Vector3::zeros(), Vector3::new(0.5, 0.25, 1.0)];
/// let crystal = Flatness::of_body(&Turning, LieAlgebra::trivial(), &places, 1.0, 1e-12)?;
/// assert!(!crystal.is_flat() && crystal.torsion.value > 0.5);
/// assert!(Flatness::of_body(&Turning, LieAlgebra::rotations(), &places, 1.0, 1e-12)?.is_flat());
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Flatness {
    /// The largest torsion.
    pub torsion: LargestDefect,
    /// The largest curvature.
    pub curvature: LargestDefect,
    /// The tolerance of the relative defects.
    pub tolerance: f64,
    /// How many places were looked at.
    pub places: usize,
}

impl Flatness {
    /// Of a connection at places of a body of size L, m.
    ///
    /// Torsion is compared with 1/L and curvature with 1/L², or with the size of their terms where these are larger: below the
    /// tolerance, a circuit in the body closes to about the tolerance times L.
    ///
    /// # Errors
    /// What the connection refuses; [`UniformityError::OutOfBounds`] unless 0 < L and 0 < tolerance;
    /// [`UniformityError::WrongLength`] without places.
    pub fn of_connection(
        connection: &impl AffineConnection,
        places: &[Vector3<f64>],
        size: f64,
        tolerance: f64,
    ) -> Result<Self, UniformityError> {
        check_bound("size", size, "0 < L", 0.0 < size)?;
        check_bound("tolerance", tolerance, "0 < tolerance", 0.0 < tolerance)?;
        if places.is_empty() {
            return Err(UniformityError::WrongLength { quantity: "places", found: 0, expected: 1 });
        }
        let none = LargestDefect { value: 0.0, relative: 0.0, place: places[0] };
        let (mut torsion, mut curvature) = (none, none);
        for &place in places {
            let (y, r) = (connection.torsion(&place)?, connection.curvature(&place)?);
            torsion = torsion.or(y.largest(), y.scale.max(1.0 / size), place);
            curvature = curvature.or(r.largest(), r.scale.max(1.0 / (size * size)), place);
        }
        Ok(Self { torsion, curvature, tolerance, places: places.len() })
    }

    /// Of a body with a symmetry algebra, by its material connection of least torsion, W(28.26).
    ///
    /// # Errors
    /// As [`of_connection`](Self::of_connection).
    pub fn of_body(
        map: &impl UniformityMap,
        algebra: LieAlgebra,
        places: &[Vector3<f64>],
        size: f64,
        tolerance: f64,
    ) -> Result<Self, UniformityError> {
        Self::of_connection(&MaterialConnection::new(map, algebra), places, size, tolerance)
    }

    /// Of an isotropic solid by its characteristic metric, W(29.20).
    ///
    /// # Errors
    /// As [`of_connection`](Self::of_connection).
    pub fn of_metric(
        metric: &impl Field<Value = Symmetric>,
        places: &[Vector3<f64>],
        size: f64,
        tolerance: f64,
    ) -> Result<Self, UniformityError> {
        Self::of_connection(&LeviCivita(metric), places, size, tolerance)
    }

    /// Whether neither torsion nor curvature exceeds the tolerance.
    #[must_use]
    pub fn is_flat(&self) -> bool {
        self.torsion.relative <= self.tolerance && self.curvature.relative <= self.tolerance
    }
}

impl LargestDefect {
    fn or(self, value: f64, scale: f64, place: Vector3<f64>) -> Self {
        let relative = value / scale;
        if self.relative < relative { Self { value, relative, place } } else { self }
    }
}

/// What a homogeneous configuration would have to close and does not: the test of local homogeneity by transport, without derivatives
/// of the connection.
///
/// # Example
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_integrators::Tolerance;
/// use piola_uniformity::{CircuitDefects, ConstantMap, MaterialConnection};
/// let connection = MaterialConnection::of_crystal(ConstantMap(Matrix3::identity()));
/// let corners = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
/// let defects = CircuitDefects::of(&connection, &Matrix3::identity(), &corners, Tolerance::relative(1e-12)?)?;
/// assert!(defects.closure < 1e-14 && defects.holonomy < 1e-14 && defects.circuits == 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CircuitDefects {
    /// The largest |development of a circuit|, m.
    pub closure: f64,
    /// The largest |holonomy − 1|.
    pub holonomy: f64,
    /// How many circuits were run through.
    pub circuits: usize,
}

impl CircuitDefects {
    /// Around all triangles of the first of the places with two others that follow each other, from a frame at the first.
    ///
    /// # Errors
    /// As [`TransportedFrame::around`]; [`UniformityError::WrongLength`] for fewer than three places.
    pub fn of(
        connection: &impl AffineConnection,
        frame: &Matrix3<f64>,
        places: &[Vector3<f64>],
        tolerance: Tolerance,
    ) -> Result<Self, UniformityError> {
        if places.len() < 3 {
            return Err(UniformityError::WrongLength { quantity: "places", found: places.len(), expected: 3 });
        }
        let (first, others) = (places[0], &places[1..]);
        let mut defects = Self { closure: 0.0, holonomy: 0.0, circuits: 0 };
        let next = others.iter().cycle().skip(1);
        // Of two others there is one triangle, not two.
        let count = if others.len() == 2 { 1 } else { others.len() };
        for (&second, &third) in others.iter().zip(next).take(count) {
            let triangle = PolygonalCurve::closed(vec![first, second, third])?;
            let round = TransportedFrame::around(connection, &triangle, frame, tolerance)?;
            defects.closure = defects.closure.max(round.development.norm());
            defects.holonomy = defects.holonomy.max((round.holonomy() - Matrix3::identity()).norm());
            defects.circuits += 1;
        }
        Ok(defects)
    }
}
