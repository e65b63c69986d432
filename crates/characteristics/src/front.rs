//! Many characteristics advanced together, in lanes and on all cores.

use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::Lanes;

use super::mesh::Walk;
use super::partials::Partials;
use super::{CauchyProblem, CharacteristicField, FirstOrderPde, InitialManifold, ParameterInterval};
use crate::CharacteristicsError;
use crate::check::{check_finite, check_length};

/// Characteristics that take each step together.
const LANES: usize = 4;

/// A front of characteristics: one row (x, u, ξ) of 2m + 1 numbers for each.
///
/// Four characteristics advance at once in lanes, with a common step; groups are always the same, so that with feature
/// `rayon` the result is bit-identical for any number of threads.
///
/// # Example
/// ```
/// use piola_characteristics::{FirstOrderPde, Front};
/// use piola_integrators::Tolerance;
/// use piola_numerics::Real;
/// struct Eikonal;
/// impl FirstOrderPde for Eikonal {
///     fn value<T: Real>(&self, _x: &[T], _u: T, xi: &[T]) -> T {
///         T::lit(0.5) * (xi[0] * xi[0] + xi[1] * xi[1] - T::one())
///     }
/// }
/// // Two points of the unit circle, from which the front u = s goes outward.
/// let mut front = Front::new(2, vec![1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0])?;
/// front.advance(&Eikonal, 0.5, Tolerance::relative(1e-12)?)?;
/// assert_eq!(front.row(1), Some(&[0.0, 1.5, 0.5, 0.0, 1.0][..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Source
/// W(A.38).
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(try_from = "Unchecked"))]
pub struct Front {
    variables: usize,
    rows: Vec<f64>,
    s: f64,
}

/// A front as it is written.
#[cfg(feature = "serde")]
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Unchecked {
    variables: usize,
    rows: Vec<f64>,
    s: f64,
}

#[cfg(feature = "serde")]
impl TryFrom<Unchecked> for Front {
    type Error = CharacteristicsError;
    fn try_from(unchecked: Unchecked) -> Result<Self, CharacteristicsError> {
        check_finite("s", &[unchecked.s])?;
        Ok(Self { s: unchecked.s, ..Self::new(unchecked.variables, unchecked.rows)? })
    }
}

impl Front {
    /// A front at s = 0 of rows (x, u, ξ) in m variables.
    ///
    /// # Errors
    /// [`CharacteristicsError::WrongLength`] unless the rows are full; [`CharacteristicsError::NotFinite`].
    pub fn new(variables: usize, rows: Vec<f64>) -> Result<Self, CharacteristicsError> {
        let n = 2 * variables + 1;
        check_length("rows of the front", rows.len().next_multiple_of(n), rows.len())?;
        check_finite("rows of the front", &rows)?;
        Ok(Self { variables, rows, s: 0.0 })
    }

    /// The number of characteristics.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len() / (2 * self.variables + 1)
    }
    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
    /// The parameter s reached.
    #[must_use]
    pub const fn s(&self) -> f64 {
        self.s
    }
    /// All rows, one after the other.
    #[must_use]
    pub fn rows(&self) -> &[f64] {
        &self.rows
    }
    /// The row (x, u, ξ) of one characteristic.
    #[must_use]
    pub fn row(&self, index: usize) -> Option<&[f64]> {
        self.rows.chunks(2 * self.variables + 1).nth(index)
    }

    /// Advances all characteristics by `step`, forwards or backwards in s.
    ///
    /// Each call makes room for the rows to come, for a method and a field (one of each on every core) and for a state of
    /// every four rows; the steps and evaluations in between need none.
    ///
    /// # Errors
    /// [`CharacteristicsError::NotFinite`]; [`CharacteristicsError::Run`] of the first group that fails, in the order of the rows. The
    /// front then stands where it stood.
    ///
    /// # Accuracy
    /// The local error of each step is below the tolerance for the worst of the four characteristics of a group.
    pub fn advance<P: FirstOrderPde + Sync>(
        &mut self,
        equation: &P,
        step: f64,
        tolerance: Tolerance,
    ) -> Result<(), CharacteristicsError> {
        check_finite("step", &[step])?;
        let (m, n) = (self.variables, 2 * self.variables + 1);
        let mut next = self.rows.clone();
        let worker =
            || (CharacteristicField::<P, Lanes<f64, LANES>>::new(equation, m), DormandPrince853::new(tolerance));
        let advance = |worker: &mut (CharacteristicField<'_, P, _>, DormandPrince853<_>), rows: &mut [f64]| {
            let last = rows.len() / n - 1;
            let component = |i: usize| Lanes(core::array::from_fn(|lane| rows[lane.min(last) * n + i]));
            let failed = |time, source| CharacteristicsError::Run { time, source: Box::new(source) };
            let mut state = State::new(0.0, (0..n).map(component).collect())
                .map_err(|source| failed(0.0, source.with_field_error()))?;
            let result = worker.1.integrate_to(&mut worker.0, &mut state, step);
            result.map_err(|source| failed(state.time, source))?;
            for (lane, row) in rows.chunks_mut(n).enumerate() {
                for (row, value) in row.iter_mut().zip(&state.values) {
                    *row = value.0[lane];
                }
            }
            Ok(())
        };
        #[cfg(feature = "rayon")]
        let results: Vec<Result<(), CharacteristicsError>> = {
            use rayon::prelude::*;
            next.par_chunks_mut(LANES * n).map_init(worker, advance).collect()
        };
        #[cfg(not(feature = "rayon"))]
        let results: Vec<Result<(), CharacteristicsError>> = {
            let mut worker = worker();
            next.chunks_mut(LANES * n).map(|rows| advance(&mut worker, rows)).collect()
        };
        results.into_iter().collect::<Result<(), _>>()?;
        self.rows = next;
        self.s += step;
        Ok(())
    }

    /// The largest |Φ| on the front: the drift of the integral W(A.20).
    #[must_use]
    pub fn drift<P: FirstOrderPde>(&self, equation: &P) -> f64 {
        let mut work = Partials::new(self.variables);
        let rows = self.rows.chunks(2 * self.variables + 1);
        rows.fold(0.0, |drift, row| drift.max(work.evaluate(equation, row).abs()))
    }
}

impl<P: FirstOrderPde, M: InitialManifold> CauchyProblem<'_, P, M> {
    /// The front s = 0 at the ends of all parts of the intervals, the first parameter running fastest.
    ///
    /// # Errors
    /// As [`characteristic`](Self::characteristic).
    ///
    /// # Source
    /// W(A.40).
    pub fn front(&self, intervals: &[ParameterInterval]) -> Result<Front, CharacteristicsError> {
        self.check_intervals(intervals)?;
        let walk = Walk::new(intervals);
        let (m, n) = (self.data.variables, 2 * self.data.variables + 1);
        let mut rows: Vec<f64> = Vec::with_capacity(n * walk.len());
        for index in 0..walk.len() {
            let guess =
                walk.before(index).map_or(&self.guess[..], |before| &rows[before * n + m + 1..(before + 1) * n]);
            let point = self.ray_start(&walk.parameters(index), guess)?.0;
            rows.extend(point.x.iter().chain([&point.u]).chain(&point.xi));
        }
        Front::new(m, rows)
    }
}
