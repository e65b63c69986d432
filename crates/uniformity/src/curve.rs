//! Curves in the reference configuration: what vectors are carried along and lattices are counted around.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use piola_numerics::{Dual, Real};

use crate::UniformityError;
use crate::error::{check_bound, check_finite};

/// A curve X(s) in the reference configuration, of one or more smooth pieces with 0 ≤ s ≤ 1 each.
///
/// # Errors
/// [`check`](Self::check) and [`check_closed`](Self::check_closed) refuse points that are not finite, pieces that do not meet
/// ([`UniformityError::BrokenCurve`]) and circuits that are open ([`UniformityError::OpenCircuit`]): ends that differ by more than 64 ulp
/// of the largest coordinate.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_numerics::Real;
/// use piola_uniformity::{ReferenceCurve, UniformityError};
/// struct Parabola;
/// impl ReferenceCurve for Parabola {
///     fn place<T: Real>(&self, _piece: usize, s: T) -> Vector3<T> {
///         Vector3::new(s, s * s, T::zero())
///     }
/// }
/// assert_eq!(Parabola.velocity(0, 0.5), Vector3::new(1.0, 1.0, 0.0));
/// assert!(matches!(Parabola.check_closed(), Err(UniformityError::OpenCircuit { .. })));
/// ```
pub trait ReferenceCurve {
    /// X(s) on a piece, m.
    fn place<T: Real>(&self, piece: usize, s: T) -> Vector3<T>;

    /// The number of pieces.
    fn pieces(&self) -> usize {
        1
    }

    /// dX/ds on a piece, m.
    fn velocity<T: Real>(&self, piece: usize, s: T) -> Vector3<T> {
        self.place(piece, Dual::variable(s)).map(|x| x.tangent)
    }

    /// Refuses pieces that do not meet.
    ///
    /// # Errors
    /// See [the trait](ReferenceCurve#errors).
    fn check(&self) -> Result<(), UniformityError> {
        check_bound("number of pieces", self.pieces() as f64, "1 ≤ pieces", 1 <= self.pieces())?;
        for piece in 0..self.pieces() {
            let (start, end) = (self.place(piece, 0.0), self.place(piece, 1.0));
            check_finite("curve", start.as_slice())?;
            check_finite("curve", end.as_slice())?;
            if 0 < piece {
                let before = self.place(piece - 1, 1.0);
                if !meet(&before, &start) {
                    return Err(UniformityError::BrokenCurve { piece, gap: (before - start).norm() });
                }
            }
        }
        Ok(())
    }

    /// Refuses pieces that do not meet, and curves that do not end where they begin.
    ///
    /// # Errors
    /// See [the trait](ReferenceCurve#errors).
    fn check_closed(&self) -> Result<(), UniformityError> {
        self.check()?;
        let (start, end) = (self.place(0, 0.0), self.place(self.pieces() - 1, 1.0));
        if meet(&start, &end) {
            return Ok(());
        }
        Err(UniformityError::OpenCircuit { start: start.into(), end: end.into(), gap: (end - start).norm() })
    }
}

impl<C: ReferenceCurve + ?Sized> ReferenceCurve for &C {
    fn place<T: Real>(&self, piece: usize, s: T) -> Vector3<T> {
        (**self).place(piece, s)
    }
    fn pieces(&self) -> usize {
        (**self).pieces()
    }
}

/// Equal to 64 ulp of the largest coordinate: what rounding of a formula leaves.
fn meet(a: &Vector3<f64>, b: &Vector3<f64>) -> bool {
    (a - b).amax() <= 64.0 * f64::EPSILON * a.amax().max(b.amax())
}

/// A straight line from one point to another.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_uniformity::{ReferenceCurve, Segment};
/// let line = Segment { from: Vector3::zeros(), to: Vector3::x() };
/// assert_eq!(line.place(0, 0.5).x, 0.5);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// The first point, m.
    pub from: Vector3<f64>,
    /// The last point, m.
    pub to: Vector3<f64>,
}

impl ReferenceCurve for Segment {
    fn place<T: Real>(&self, _piece: usize, s: T) -> Vector3<T> {
        Vector3::from_fn(|i, _| T::lit(self.from[i]) + s * T::lit(self.to[i] - self.from[i]))
    }
}

/// A circle, run through once, counter-clockwise about its axis.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_uniformity::{ReferenceCurve, RoundCircuit};
/// let circle = RoundCircuit::new(Vector3::zeros(), Vector3::z(), 2.0)?;
/// assert!((circle.velocity(0, 0.25_f64).norm() - 4.0 * std::f64::consts::PI).abs() < 1e-14);
/// circle.check_closed()?;
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RoundCircuit {
    centre: Vector3<f64>,
    /// Two perpendicular radii.
    radii: [Vector3<f64>; 2],
}

impl RoundCircuit {
    /// By its centre, a vector along its axis, and its radius, m.
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`]; [`UniformityError::OutOfBounds`] unless 0 < radius and the axis has a direction.
    pub fn new(centre: Vector3<f64>, axis: Vector3<f64>, radius: f64) -> Result<Self, UniformityError> {
        check_finite("centre", centre.as_slice())?;
        check_finite("axis", axis.as_slice())?;
        check_bound("axis", axis.norm(), "0 < |axis|", 0.0 < axis.norm())?;
        check_bound("radius", radius, "0 < radius", 0.0 < radius)?;
        let axis = axis.normalize();
        // The start is on the side of the coordinate axis that is most across.
        let aside = if axis.x.abs() <= 0.8 { Vector3::x() } else { Vector3::y() };
        let first = (aside - axis * axis.dot(&aside)).normalize();
        Ok(Self::of_radii(centre, [first * radius, axis.cross(&first) * radius]))
    }

    /// By two perpendicular radii of one length.
    pub(crate) const fn of_radii(centre: Vector3<f64>, radii: [Vector3<f64>; 2]) -> Self {
        Self { centre, radii }
    }
}

impl ReferenceCurve for RoundCircuit {
    fn place<T: Real>(&self, _piece: usize, s: T) -> Vector3<T> {
        let (sine, cosine) = (T::lit(TAU) * s).sin_cos();
        let [a, b] = &self.radii;
        Vector3::from_fn(|i, _| T::lit(self.centre[i]) + T::lit(a[i]) * cosine + T::lit(b[i]) * sine)
    }
}

/// Straight lines through given points, open or closed.
///
/// # Example
/// ```
/// use nalgebra::Vector3;
/// use piola_uniformity::{PolygonalCurve, ReferenceCurve};
/// let triangle = PolygonalCurve::closed(vec![Vector3::zeros(), Vector3::x(), Vector3::y()])?;
/// assert_eq!(triangle.pieces(), 3);
/// triangle.check_closed()?;
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonalCurve {
    points: Vec<Vector3<f64>>,
}

impl PolygonalCurve {
    /// Through the points, from the first to the last.
    ///
    /// # Errors
    /// [`UniformityError::NotFinite`]; [`UniformityError::WrongLength`] for fewer than two points.
    pub fn new(points: Vec<Vector3<f64>>) -> Result<Self, UniformityError> {
        if points.len() < 2 {
            return Err(UniformityError::WrongLength { quantity: "points", found: points.len(), expected: 2 });
        }
        for point in &points {
            check_finite("points", point.as_slice())?;
        }
        Ok(Self { points })
    }

    /// Through the points and back to the first.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn closed(mut points: Vec<Vector3<f64>>) -> Result<Self, UniformityError> {
        points.extend(points.first().copied());
        Self::new(points)
    }
}

impl ReferenceCurve for PolygonalCurve {
    fn place<T: Real>(&self, piece: usize, s: T) -> Vector3<T> {
        let (from, to) = (&self.points[piece], &self.points[piece + 1]);
        Vector3::from_fn(|i, _| T::lit(from[i]) * (T::one() - s) + T::lit(to[i]) * s)
    }
    fn pieces(&self) -> usize {
        self.points.len() - 1
    }
}
