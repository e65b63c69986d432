//! Burgers vectors of circuits and the density of dislocations.
//!
//! ```text
//! b^a = ∮ (K⁻¹)^a_A dX^A = ∫ α^aD N_D dA = −∫ (K⁻¹)^a_C Y^C_12 dA        α^aD = ε^DAB ∂_A (K⁻¹)^a_B
//! ```
//!
//! b counts in the crystal: component a along the crystal's basis vector a. A circuit is run through counter-clockwise about N.

use nalgebra::{Matrix3, Vector3};
use piola_numerics::Real;
use piola_numerics::linear::matrix3::{from_rows, inverse_and_determinant, rows_of};
use piola_numerics::quadrature::{self, Ending, GaussKronrod, Growing, Quadpack};

use crate::UniformityError;
use crate::connection::Torsion;
use crate::curve::ReferenceCurve;
use crate::error::check_finite;
use crate::indices::{second, sum, third};
use crate::map::{LocalMap, UniformityMap, check_map};

/// The most panels of a quadrature along a circuit.
const PANELS: usize = 4096;

/// The Burgers vector of a circuit, `b^a = ∮ (K⁻¹)^a_A dX^A`, with the error of its quadrature.
///
/// # Example
/// A screw dislocation of Burgers vector ¾ m along X₃: K⁻¹ is known everywhere off the line, where no dislocation is.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_numerics::Real;
/// use piola_uniformity::{BurgersVector, InverseMap, RoundCircuit, UniformityMap};
/// struct Screw;
/// impl UniformityMap for Screw {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let [x, y, _] = (*reference).into();
///         let factor = T::lit(0.75 / std::f64::consts::TAU) / (x * x + y * y);
///         let mut dual = Matrix3::identity();
///         (dual[(2, 0)], dual[(2, 1)]) = (-(factor * y), factor * x);
///         dual
///     }
/// }
/// let around = RoundCircuit::new(Vector3::zeros(), Vector3::z(), 1.5)?;
/// let burgers = BurgersVector::of(&InverseMap(Screw), &around, 1e-12)?;
/// assert!((burgers.value - Vector3::new(0.0, 0.0, 0.75)).norm() < 1e-14);
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[doc(alias("closure failure", "dislocation"))]
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BurgersVector {
    /// b, m, in components of the crystal.
    pub value: Vector3<f64>,
    /// The estimated error of each component, m.
    pub error: Vector3<f64>,
    /// `∮ |(K⁻¹)^a_A dX^A|`, m: what the components are sums of.
    pub scale: Vector3<f64>,
}

impl BurgersVector {
    /// Of a circuit, each component to `tolerance` × its scale.
    ///
    /// # Errors
    /// [`UniformityError::OpenCircuit`], [`UniformityError::BrokenCurve`]; what the map refuses on the circuit;
    /// [`UniformityError::OutOfBounds`] unless 0 < tolerance; [`UniformityError::NotConverged`].
    pub fn of(
        map: &impl UniformityMap,
        circuit: &impl ReferenceCurve,
        tolerance: f64,
    ) -> Result<Self, UniformityError> {
        circuit.check_closed()?;
        crate::error::check_bound("tolerance", tolerance, "0 < tolerance", 0.0 < tolerance)?;
        // Rounding of the sums cannot be asked away.
        let relative = tolerance.max(16.0 * f64::EPSILON);
        let allowed = |_values: &[f64; 3], sizes: &[f64; 3]| sizes.map(|size| relative * size);
        let parts = (0..circuit.pieces()).map(|_| (0.0, 1.0));
        let mut panels = Growing::up_to(PANELS);
        let method = (&GaussKronrod::POINTS_21, &Quadpack);
        let found = quadrature::integrate(&mut panels, parts, method, &allowed, |piece, s: f64| {
            let (place, velocity) = (circuit.place(piece, s), circuit.velocity(piece, s));
            let dual = inverse_and_determinant(rows_of(&map.value(&place)?)).0;
            Ok::<_, UniformityError>((from_rows(dual) * velocity).into())
        })?;
        if let Ending::NotFinite { value, component: index, .. } = found.ending {
            return Err(UniformityError::NotFinite { quantity: "Burgers vector", index, value });
        }
        // Where panels are too small to be halved what is left is rounding, and said so.
        if found.ending == Ending::Full {
            let worst = (0..3).max_by(|&i, &j| found.errors[i].total_cmp(&found.errors[j])).unwrap_or(0);
            let (error, allowed) = (found.errors[worst], relative * found.sizes[worst]);
            return Err(UniformityError::NotConverged { quantity: "Burgers vector", error, allowed });
        }
        Ok(Self { value: found.values.into(), error: found.errors.into(), scale: found.sizes.into() })
    }

    /// K b, m: the Burgers vector in components of the reference configuration, laid to a point.
    ///
    /// # Errors
    /// What the map refuses.
    pub fn at(&self, map: &impl UniformityMap, place: &Vector3<f64>) -> Result<Vector3<f64>, UniformityError> {
        Ok(map.value(place)? * self.value)
    }
}

/// `α^aD = ε^DAB ∂_A (K⁻¹)^a_B`, 1/m: the Burgers vector, in the crystal, of all dislocations through a unit of area with normal D.
///
/// # Accuracy
/// A few ulp of the derivatives of K.
///
/// # Example
/// Screws of density ½ along X₃, and no edges.
/// ```
/// use nalgebra::{Matrix3, Vector3};
/// use piola_numerics::Real;
/// use piola_uniformity::{DislocationDensity, InverseMap, UniformityMap};
/// struct Screws;
/// impl UniformityMap for Screws {
///     fn at<T: Real>(&self, reference: &Vector3<T>) -> Matrix3<T> {
///         let mut dual = Matrix3::identity();
///         dual[(2, 0)] = T::lit(-0.25) * reference.y;
///         dual[(2, 1)] = T::lit(0.25) * reference.x;
///         dual
///     }
/// }
/// let density = DislocationDensity::of(&InverseMap(Screws), &Vector3::zeros())?;
/// assert_eq!(density.through(&Vector3::z()), Vector3::new(0.0, 0.0, 0.5));
/// assert_eq!((density.screw(&Vector3::z()), density.edge(&Vector3::z()).norm()), (0.5, 0.0));
/// # Ok::<(), piola_uniformity::UniformityError>(())
/// ```
#[doc(alias("Nye tensor", "geometrically necessary dislocations"))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DislocationDensity<T = f64> {
    /// α, rows in the crystal, columns in the reference.
    pub value: Matrix3<T>,
    /// K at the point, which lays rows into the reference.
    pub map: Matrix3<T>,
    /// The largest sum of the moduli of the two terms of a component, 1/m.
    pub scale: T,
}

impl<T: Real> DislocationDensity<T> {
    /// Of a uniformity map at a place.
    ///
    /// # Errors
    /// What the map refuses.
    pub fn of(map: &impl UniformityMap, place: &Vector3<T>) -> Result<Self, UniformityError> {
        let value = map.value(place)?;
        let map = LocalMap::of(map, place);
        // ∂_A (K⁻¹)^a_B = −(K⁻¹)^a_C ∂_A K^C_e (K⁻¹)^e_B, as [A][a][B].
        let slope =
            third(|along, a, b| -sum(|c| map.inverse[a][c] * sum(|e| map.partials[along][c][e] * map.inverse[e][b])));
        let term = |a: usize, d: usize| {
            let (first, last) = ((d + 1) % 3, (d + 2) % 3);
            (slope[first][a][last], slope[last][a][first])
        };
        let curl = second(|a, d| term(a, d).0 - term(a, d).1);
        check_finite("dislocation density", curl.as_flattened())?;
        let sizes = second(|a, d| term(a, d).0.abs() + term(a, d).1.abs());
        let scale = crate::indices::largest(sizes.as_flattened().iter().copied());
        Ok(Self { value: from_rows(curl), map: value, scale })
    }

    /// From the torsion of the connection of a crystal: `α^aD = −½ ε^DAB (K⁻¹)^a_C Y^C_AB`.
    ///
    /// # Errors
    /// [`UniformityError::SingularMap`] and [`UniformityError::OrientationReversing`]; the place that they name is the origin.
    pub fn of_torsion(torsion: &Torsion<T>, map: &Matrix3<T>) -> Result<Self, UniformityError> {
        check_map(rows_of(map), &Vector3::from_element(T::zero()))?;
        let inverse = from_rows(inverse_and_determinant(rows_of(map)).0);
        Ok(Self { value: -(inverse * torsion.axial()), map: *map, scale: torsion.scale })
    }

    /// α N, 1/m: the Burgers vector, in the crystal, through a unit of area with unit normal N.
    #[must_use]
    pub fn through(&self, normal: &Vector3<T>) -> Vector3<T> {
        self.value * normal
    }

    /// K α, 1/m: both indices in the reference.
    #[must_use]
    pub fn in_reference(&self) -> Matrix3<T> {
        self.map * self.value
    }

    /// N · K α N, 1/m: the part of the Burgers vector along lines of direction N, of screws.
    #[must_use]
    pub fn screw(&self, line: &Vector3<T>) -> T {
        let burgers = self.map * self.through(line);
        sum(|i| line[i] * burgers[i])
    }

    /// K α N − N (N · K α N), 1/m: the part across lines of unit direction N, of edges.
    #[must_use]
    pub fn edge(&self, line: &Vector3<T>) -> Vector3<T> {
        let burgers = self.map * self.through(line);
        let along = sum(|i| line[i] * burgers[i]);
        Vector3::from_fn(|i, _| burgers[i] - line[i] * along)
    }
}
