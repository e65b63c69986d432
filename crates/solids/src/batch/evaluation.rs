//! Evaluation with this crate's errors.

use piola_batch::{BatchError, BatchScalar, Deformations, Report, Requests};

use crate::SolidsError;
use crate::error::BadPoint;

/// Computes the requested outputs at all points.
///
/// It is [`piola_batch::evaluate`], with bad points by the errors of this crate.
///
/// # Errors
/// [`SolidsError::BadPoints`] with *all* bad points when there are any, be it that they are no deformations or
/// that a law has no answer there: their outputs are NaN, those of the good points are written all the same.
/// [`SolidsError::Batch`] with [`BatchError::WrongLength`], before anything is computed, when a view does not have as many points as there are
/// deformations.
///
/// # Accuracy
/// That of the one-point functions, to the last bit where they use no elementary functions (ln, exp, powers): those of
/// lanes are within 2 ulp of the standard library's.
///
/// # Example
/// ```
/// use piola_solids::{Compressible, isochoric::Gent, volumetric::Quadratic};
/// use piola_solids::{SolidsError, batch};
/// use piola_continuum::DeformationGradient;
/// let law = Compressible::new(Gent::new(1.0, 2.0)?, Quadratic::new(10.0)?); // Ī₁ − 3 < 2
/// let f = [1.5, 9.0, 1.0].map(|stretch| DeformationGradient::uniaxial(stretch, 1.0).unwrap());
/// let mut w = [0.0_f64; 3];
/// let Err(SolidsError::BadPoints { points, .. }) = batch::evaluate(&f[..], batch::energy(&law, &mut w[..])) else {
///     unreachable!()
/// };
/// assert!(matches!(points[0].error, SolidsError::BeyondLimit { limit: 2.0, .. }));
/// assert_eq!((points.len(), points[0].index), (1, 1));
/// assert_eq!((0.0 < w[0], w[1].is_nan(), w[2]), (true, true, 0.0));
/// # Ok::<(), SolidsError>(())
/// ```
pub fn evaluate<T: BatchScalar, D: Deformations<T>, R: Requests<T>>(
    deformations: D,
    requests: R,
) -> Result<Report, SolidsError> {
    piola_batch::evaluate(deformations, requests).map_err(|error| match error {
        BatchError::BadPoints { points, count, slow_path } => {
            let points = points.into_iter().map(|point| BadPoint { index: point.index, error: typed(point.error) });
            SolidsError::BadPoints { points: points.collect(), count, slow_path }
        }
        other => other.into(),
    })
}

/// The law's own error where a law refused.
fn typed(error: BatchError) -> SolidsError {
    match &error {
        BatchError::Refused(refusal) => refusal.downcast_ref().cloned().unwrap_or(error.into()),
        _ => error.into(),
    }
}
