//! Directions of fibres in the reference configuration.

use piola_continuum::Symmetric;

use crate::SolidsError;
use crate::error::{check_bound, check_finite};

/// The unit vector along a family of fibres in the reference configuration; its sign has no meaning.
///
/// Written as its three components; what is read is normalised.
///
/// # Example
/// ```
/// use piola_solids::Fibre;
/// assert_eq!(Fibre::new([3.0, 0.0, 4.0])?.direction(), [0.6, 0.0, 0.8]);
/// # Ok::<(), piola_solids::SolidsError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(try_from = "[f64; 3]", into = "[f64; 3]"))]
pub struct Fibre {
    direction: [f64; 3],
}

impl Fibre {
    /// Along a vector of any length.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`]; [`SolidsError::OutOfBounds`] for the zero vector.
    pub fn new(vector: [f64; 3]) -> Result<Self, SolidsError> {
        for component in vector {
            check_finite("fibre", "direction", component)?;
        }
        // What is a unit vector to the last bit stays as it is.
        let square: f64 = vector.iter().map(|x| x * x).sum();
        if (square - 1.0).abs() <= 2.0 * f64::EPSILON {
            return Ok(Self { direction: vector });
        }
        let size = vector.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        check_bound("fibre", "direction", size, "0 < |direction|", 0.0 < size)?;
        let scaled = vector.map(|x| x / size);
        let length = scaled.iter().map(|x| x * x).sum::<f64>().sqrt();
        Ok(Self { direction: scaled.map(|x| x / length) })
    }

    /// At an angle from axis 1 towards axis 2, rad.
    ///
    /// # Errors
    /// [`SolidsError::NotFinite`].
    pub fn in_plane(angle: f64) -> Result<Self, SolidsError> {
        check_finite("fibre", "angle", angle)?;
        let (sine, cosine) = angle.sin_cos();
        Ok(Self { direction: [cosine, sine, 0.0] })
    }

    /// The unit vector a.
    #[must_use]
    pub const fn direction(&self) -> [f64; 3] {
        self.direction
    }

    /// M = a ⊗ a.
    #[must_use]
    pub fn structure(&self) -> Symmetric {
        Symmetric::dyad(self.direction)
    }
}

impl TryFrom<[f64; 3]> for Fibre {
    type Error = SolidsError;

    fn try_from(vector: [f64; 3]) -> Result<Self, SolidsError> {
        Self::new(vector)
    }
}

impl From<Fibre> for [f64; 3] {
    fn from(fibre: Fibre) -> Self {
        fibre.direction
    }
}
