//! Parallel transport of frames along curves, and the development of a curve into the crystal.
//!
//! ```text
//! du^C/ds = −Γ^C_AB u^A dX^B/ds        W(27.12)
//! dP/ds   = −Γ(dX/ds) P,  P(0) = P₀     dy/ds = P⁻¹ dX/ds,  y(0) = 0
//! ```
//!
//! The columns of P are carried in parallel. y is the *development*: the curve as it would run in a crystal without defects. Around a
//! circuit P₀⁻¹ P is the holonomy, which the curvature makes, and y the Burgers vector, which the torsion makes too.

use nalgebra::{Matrix3, Vector3};
use piola_integrators::{DormandPrince853, Field, State, Tolerance};
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};

use crate::UniformityError;
use crate::connection::AffineConnection;
use crate::curve::ReferenceCurve;
use crate::map::check_map;

/// A frame carried in parallel along a curve, and the curve's development.
///
/// # Accuracy
/// The local error of each step is below the tolerance, relative to the largest entry of the frame and to the length of the
/// development; errors add up along the curve.
///
/// # Example
/// Around a circle of radius 1 in a lattice with screws of density ½: the development does not close, by ½ times the area.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// use piola_uniformity::{InverseMap, MaterialConnection, RoundCircuit, TransportedFrame, UniformityMap};
/// struct Screws;
/// impl UniformityMap for Screws {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let mut dual = Matrix3::identity();
///         dual[(2, 0)] = T::lit(-0.25) * reference.y;
///         dual[(2, 1)] = T::lit(0.25) * reference.x;
///         dual
///     }
/// }
/// let connection = MaterialConnection::of_crystal(InverseMap(Screws));
/// let circle = RoundCircuit::new(Vector3::zeros(), Vector3::z(), 1.0)?;
/// let start = Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, -0.25, 1.0); // K at (1, 0, 0)
/// let round = TransportedFrame::along(&connection, &circle, &start, Tolerance::relative(1e-12)?)?;
/// assert!((round.holonomy() - Matrix3::identity()).norm() < 1e-10); // no curvature
/// assert!((round.development.z - 0.5 * std::f64::consts::PI).abs() < 1e-10);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(27.12), W(27.24).
#[doc(alias("parallel transport", "holonomy", "development", "Cartan"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TransportedFrame {
    /// P₀, the frame at the start.
    pub start: Matrix3<f64>,
    /// P, the frame at the end.
    pub end: Matrix3<f64>,
    /// ∫ P⁻¹ dX, m, in components of the frame.
    pub development: Vector3<f64>,
    /// Evaluations of the connection.
    pub evaluations: u64,
}

impl TransportedFrame {
    /// A frame P₀ carried along a curve.
    ///
    /// # Errors
    /// What the curve and the connection refuse; [`UniformityError::SingularMap`] and
    /// [`UniformityError::OrientationReversing`] for P₀; [`UniformityError::Transport`] with the reason.
    pub fn along(
        connection: &impl AffineConnection,
        curve: &impl ReferenceCurve,
        start: &Matrix3<f64>,
        tolerance: Tolerance,
    ) -> Result<Self, UniformityError> {
        curve.check()?;
        check_map(rows_of(start), &curve.place(0, 0.0))?;
        let mut values: Vec<f64> = start.as_slice().to_vec();
        values.extend([0.0; 3]);
        let (mut state, mut evaluations) = (State::new(0.0, values)?, 0);
        for piece in 0..curve.pieces() {
            let refused = |source| UniformityError::Transport { piece, source: Box::new(source) };
            let mut field = Parallel { connection, curve, piece, size: size_of(curve) };
            // Each piece has its own clock: a corner falls between two runs.
            state.time = 0.0;
            let report = DormandPrince853::new(tolerance).integrate_to(&mut field, &mut state, 1.0).map_err(refused)?;
            evaluations += report.evaluations;
        }
        let end = Matrix3::from_column_slice(&state.values[..9]);
        let development = Vector3::from_column_slice(&state.values[9..]);
        Ok(Self { start: *start, end, development, evaluations })
    }

    /// A frame P₀ carried around a circuit.
    ///
    /// # Errors
    /// As [`along`](Self::along); [`UniformityError::OpenCircuit`].
    pub fn around(
        connection: &impl AffineConnection,
        circuit: &impl ReferenceCurve,
        start: &Matrix3<f64>,
        tolerance: Tolerance,
    ) -> Result<Self, UniformityError> {
        circuit.check_closed()?;
        Self::along(connection, circuit, start, tolerance)
    }

    /// The vector with the same components in the frame at the end as u has in the frame at the start.
    #[must_use]
    pub fn carried(&self, vector: &Vector3<f64>) -> Vector3<f64> {
        self.end * (from_rows(inverse_and_determinant(rows_of(&self.start)).0) * vector)
    }

    /// P₀⁻¹ P: of a circuit the holonomy, in components of the frame.
    #[must_use]
    pub fn holonomy(&self) -> Matrix3<f64> {
        from_rows(inverse_and_determinant(rows_of(&self.start)).0) * self.end
    }
}

/// The largest extent of a curve, by seventeen points a piece.
fn size_of(curve: &impl ReferenceCurve) -> f64 {
    let start: Vector3<f64> = curve.place(0, 0.0);
    let points = (0..curve.pieces()).flat_map(|piece| (0..17).map(move |i| (piece, f64::from(i) / 16.0)));
    points.map(|(piece, s)| (curve.place(piece, s) - start).amax()).fold(0.0, f64::max)
}

/// The equations of transport on a piece of a curve.
struct Parallel<'a, C, R> {
    connection: &'a C,
    curve: &'a R,
    piece: usize,
    size: f64,
}

impl<C: AffineConnection, R: ReferenceCurve> Field for Parallel<'_, C, R> {
    type Error = UniformityError;

    fn dimension(&self) -> usize {
        12
    }

    fn rate(&mut self, s: f64, y: &[f64], rate: &mut [f64]) -> Result<(), UniformityError> {
        let (place, velocity) = (self.curve.place(self.piece, s), self.curve.velocity(self.piece, s));
        let gamma = self.connection.coefficients(&place)?;
        let frame = Matrix3::from_column_slice(&y[..9]);
        for (column, rate) in frame.column_iter().zip(rate.chunks_exact_mut(3)) {
            rate.copy_from_slice(gamma.parallel_rate(&column.into_owned(), &velocity).as_slice());
        }
        let inverse = from_rows(inverse_and_determinant(rows_of(&frame)).0);
        rate[9..].copy_from_slice((inverse * velocity).as_slice());
        Ok(())
    }

    fn magnitudes(&self, y: &[f64], magnitudes: &mut [f64]) {
        let frame = Matrix3::from_column_slice(&y[..9]);
        magnitudes[..9].fill(frame.amax());
        let inverse = inverse_and_determinant(rows_of(&frame)).0;
        let stretch = inverse.as_flattened().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        magnitudes[9..].fill(self.size * stretch);
    }
}
