//! Adaptive integration of several functions of one variable at once.

use piola_numerics::quadrature::{self, Difference, Ending, GaussKronrod, Growing};

use crate::LagrangianError;

/// After so many intervals an integral is given up.
const MOST_INTERVALS: usize = 2000;

/// Values and errors of K integrals.
#[derive(Clone, Copy, Debug)]
pub struct Integrals<const K: usize> {
    /// The integrals.
    pub values: [f64; K],
    /// Their errors, as those of Gauss's rule: many times the errors of the values.
    pub errors: [f64; K],
}

/// Integrates K functions over a range, each to `relative` times ∫|f| plus `absolute`.
///
/// # Errors
/// [`LagrangianError::QuadratureNotConverged`], [`LagrangianError::NotFinite`], and those of the functions.
pub fn integrate<E: From<LagrangianError>, const K: usize>(
    range: (f64, f64),
    (relative, absolute): (f64, f64),
    mut functions: impl FnMut(f64) -> Result<[f64; K], E>,
) -> Result<Integrals<K>, E> {
    // Below some ulp of ∫|f| errors are made of rounding.
    let share = relative.max(50.0 * f64::EPSILON);
    let allowed = |_: &[f64; K], sizes: &[f64; K]| sizes.map(|size| absolute + share * size);
    let mut memory = Growing::up_to(MOST_INTERVALS);
    let method = (&GaussKronrod::POINTS_15, &Difference);
    let found = quadrature::integrate(&mut memory, [range], method, &allowed, |_, t| functions(t))?;
    match found.ending {
        Ending::Accurate => Ok(Integrals { values: found.values, errors: found.errors }),
        Ending::NotFinite { component: index, value, .. } => {
            Err(LagrangianError::NotFinite { quantity: "integrand of the action", index, value }.into())
        }
        Ending::Full | Ending::Exhausted => {
            let error = found.errors.into_iter().fold(0.0, f64::max);
            Err(LagrangianError::QuadratureNotConverged { intervals: found.panels, error }.into())
        }
    }
}
