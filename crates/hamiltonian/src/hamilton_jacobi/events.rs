//! Events, and the region of initial momenta in which extremals between them are sought.

use crate::check::{check_finite, check_length};
use crate::{HamiltonJacobiError, HamiltonianError};

/// A place in configuration space at a time.
///
/// # Example
/// ```
/// use piola_hamiltonian::hamilton_jacobi::Event;
/// assert_eq!(Event::new(&[1.0, 2.0], 0.5).coordinates.len(), 2);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Event {
    /// q.
    pub coordinates: Vec<f64>,
    /// t, s.
    pub time: f64,
}

impl Event {
    /// The event (q, t).
    #[must_use]
    pub fn new(coordinates: &[f64], t: f64) -> Self {
        Self { coordinates: coordinates.to_vec(), time: t }
    }

    pub(super) fn check(&self) -> Result<(), HamiltonianError> {
        check_finite("q", &self.coordinates)?;
        check_finite("t", &[self.time])
    }
}

/// A box of initial momenta and how many of them are tried along each of its sides.
///
/// # Example
/// ```
/// use piola_hamiltonian::hamilton_jacobi::SearchRegion;
/// let region = SearchRegion::new(&[-1.0, -2.0], &[1.0, 2.0], 8)?;
/// assert_eq!(region.starts(), 64);
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct SearchRegion {
    pub(super) lower: Vec<f64>,
    pub(super) upper: Vec<f64>,
    pub(super) resolution: usize,
}

impl SearchRegion {
    /// The box lower ≤ p₀ ≤ upper, with `resolution` starts along each side, at least one.
    ///
    /// # Errors
    /// [`HamiltonianError::WrongLength`], [`HamiltonJacobiError::InvalidRegion`].
    pub fn new(lower: &[f64], upper: &[f64], resolution: usize) -> Result<Self, HamiltonianError> {
        check_length("upper", lower.len(), upper.len())?;
        for (index, (&lower, &upper)) in lower.iter().zip(upper).enumerate() {
            if !(lower <= upper && lower.is_finite() && upper.is_finite()) {
                return Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::InvalidRegion {
                    index,
                    lower,
                    upper,
                }));
            }
        }
        Ok(Self { lower: lower.to_vec(), upper: upper.to_vec(), resolution: resolution.max(1) })
    }

    /// The number of initial momenta tried.
    #[must_use]
    pub fn starts(&self) -> usize {
        self.lower.iter().fold(1, |product: usize, _| product.saturating_mul(self.resolution))
    }

    pub(super) fn start(&self, mut number: usize) -> Vec<f64> {
        let mut p = Vec::with_capacity(self.lower.len());
        for (lower, upper) in self.lower.iter().zip(&self.upper) {
            let place = (number % self.resolution) as f64 + 0.5;
            number /= self.resolution;
            p.push(lower + (upper - lower) * place / self.resolution as f64);
        }
        p
    }

    pub(super) fn contains(&self, p: &[f64]) -> bool {
        let near = |i: usize| 1e-9 * (self.upper[i] - self.lower[i]);
        (0..p.len()).all(|i| self.lower[i] - near(i) <= p[i] && p[i] <= self.upper[i] + near(i))
    }

    /// Whether two momenta are one, as far as a search tells them apart.
    pub(super) fn same(&self, a: &[f64], b: &[f64]) -> bool {
        let size = b.iter().fold(0.0_f64, |m, p| m.max(p.abs()));
        let near = |i: usize| 1e-7 * size.max(self.upper[i] - self.lower[i]);
        a.iter().zip(b).enumerate().all(|(i, (a, b))| (a - b).abs() <= near(i))
    }
}

/// The fields before validation.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    lower: Vec<f64>,
    upper: Vec<f64>,
    resolution: usize,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for SearchRegion {
    type Error = HamiltonianError;

    fn try_from(region: Unchecked) -> Result<Self, HamiltonianError> {
        Self::new(&region.lower, &region.upper, region.resolution)
    }
}
