//! Integrals among the combinations of candidates.
//!
//! ```text
//! Σ_c a_c (∂K_c/∂t + {K_c, H}) = 0 at every point                                        W(9.20), W(10.17)
//! ```

use nalgebra::DMatrix;

use super::PhaseFunction;
use super::integrals::{PhaseFunctions, PhasePoint, rates_and_magnitudes};
use crate::HamiltonianError;

/// The integrals found among the combinations of candidates.
///
/// # Example
/// See [`integrals_among`].
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct IntegralsFound {
    /// For each integral the coefficients a_c of the candidates, the largest share of it having the coefficient one.
    pub coefficients: Vec<Vec<f64>>,
    /// Candidates that are the same everywhere, and therefore left out.
    pub constants: Vec<usize>,
    /// The singular values of the scaled rates, sorted downwards: those of integrals are some ulp, and the gap above
    /// them says how sure the answer is.
    pub singular_values: Vec<f64>,
}

/// Finds the integrals of a Hamiltonian among the linear combinations of candidates.
///
/// The rates of all candidates are formed at the points given, each relative to the magnitude of its terms; combinations
/// whose rates vanish at all points are the null space of that matrix. `tolerance` is the singular value, relative to
/// the largest possible, below which a combination is taken for an integral. The points should be in general
/// position, and more than the candidates; what they do not tell apart is not told apart.
///
/// # Errors
/// [`HamiltonianError::TooFewSamples`] for fewer points than candidates; [`HamiltonianError::NotFinite`];
/// [`HamiltonianError::NoEigenvalues`] should the decomposition not converge.
///
/// # Example
/// An oscillator in the plane, ω = 1 along x and 2 along y: of the six squares two energies are kept.
/// ```
/// use piola_hamiltonian::{PhaseFunction, PhaseFunctions, PhasePoint, integrals_among};
/// use piola_numerics::Real;
/// struct Oscillator;
/// impl PhaseFunction for Oscillator {
///     fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
///         T::lit(0.5) * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + T::lit(4.0) * q[1] * q[1])
///     }
/// }
/// struct Squares;
/// impl PhaseFunctions for Squares {
///     fn count(&self) -> usize {
///         6
///     }
///     fn values<T: Real>(&self, q: &[T], p: &[T], _t: T, out: &mut [T]) {
///         out.copy_from_slice(&[q[0] * q[0], q[1] * q[1], p[0] * p[0], p[1] * p[1], q[0] * q[1], p[0] * p[1]]);
///     }
/// }
/// let points: Result<Vec<_>, _> = (0..12)
///     .map(|i| f64::from(i))
///     .map(|i| PhasePoint::new(&[i.sin(), (2.0 * i).cos()], &[(3.0 * i).cos(), (5.0 * i).sin()], 0.0))
///     .collect();
/// let found = integrals_among(&Squares, &Oscillator, &points?, 1e-10)?;
/// assert_eq!(found.coefficients.len(), 2); // p_x² + x² and p_y² + 4 y²
/// # Ok::<(), piola_hamiltonian::HamiltonianError>(())
/// ```
///
/// # Source
/// W(9.20), W(10.17).
pub fn integrals_among(
    candidates: &impl PhaseFunctions,
    hamiltonian: &impl PhaseFunction,
    points: &[PhasePoint],
    tolerance: f64,
) -> Result<IntegralsFound, HamiltonianError> {
    let count = candidates.count();
    if points.len() < count.max(1) {
        return Err(HamiltonianError::TooFewSamples { found: points.len(), needed: count.max(1) });
    }
    let (mut rates, mut magnitudes) = (DMatrix::zeros(points.len(), count), vec![0.0_f64; count]);
    for (row, point) in points.iter().enumerate() {
        for (c, (rate, magnitude)) in rates_and_magnitudes(candidates, hamiltonian, point)?.into_iter().enumerate() {
            rates[(row, c)] = rate;
            magnitudes[c] = magnitudes[c].max(magnitude);
        }
    }
    let constants: Vec<usize> = (0..count).filter(|&c| magnitudes[c] <= 0.0).collect();
    let kept: Vec<usize> = (0..count).filter(|&c| 0.0 < magnitudes[c]).collect();
    let scaled = DMatrix::from_fn(points.len(), kept.len(), |row, c| rates[(row, kept[c])] / magnitudes[kept[c]]);
    if kept.is_empty() {
        return Ok(IntegralsFound { coefficients: Vec::new(), constants, singular_values: Vec::new() });
    }
    let rows = points.len();
    let Some(svd) = scaled.try_svd(false, true, f64::EPSILON, 0) else {
        return Err(HamiltonianError::NoEigenvalues { rows });
    };
    let Some(right) = svd.v_t else { return Err(HamiltonianError::NoEigenvalues { rows }) };
    // Every scaled rate is at most one.
    #[expect(clippy::cast_precision_loss, reason = "numbers of points and candidates are small")]
    let largest_possible = ((rows * kept.len()) as f64).sqrt();
    let null: Vec<usize> =
        (0..kept.len()).filter(|&i| svd.singular_values[i] <= tolerance * largest_possible).collect();
    let mut basis = DMatrix::from_fn(null.len(), kept.len(), |i, c| right[(null[i], c)]);
    reduce(&mut basis);
    let coefficients = basis
        .row_iter()
        .map(|row| {
            let mut all = vec![0.0; count];
            // The largest share of the integral, not the largest coefficient, which has a unit.
            let lead = row.iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map_or(0, |(c, _)| c);
            let unit = row[lead] / magnitudes[kept[lead]];
            for (c, &share) in row.iter().enumerate() {
                all[kept[c]] = share / magnitudes[kept[c]] / unit;
            }
            all
        })
        .collect();
    Ok(IntegralsFound { coefficients, constants, singular_values: svd.singular_values.iter().copied().collect() })
}

/// Brings a basis to reduced echelon form with the largest pivots, so that few candidates share each vector; what is
/// left of rounding is taken for zero.
fn reduce(basis: &mut DMatrix<f64>) {
    for row in 0..basis.nrows() {
        let lead = basis.row(row).iter().enumerate().max_by(|a, b| a.1.abs().total_cmp(&b.1.abs())).map(|(c, _)| c);
        let Some(lead) = lead else { return };
        let pivot = basis[(row, lead)];
        for other in 0..basis.nrows() {
            if other != row {
                let factor = basis[(other, lead)] / pivot;
                for c in 0..basis.ncols() {
                    let change = factor * basis[(row, c)];
                    basis[(other, c)] -= change;
                }
                basis[(other, lead)] = 0.0;
            }
        }
    }
    for mut row in basis.row_iter_mut() {
        let largest = row.amax();
        for x in row.iter_mut() {
            if x.abs() <= 1e-12 * largest {
                *x = 0.0;
            }
        }
    }
}
