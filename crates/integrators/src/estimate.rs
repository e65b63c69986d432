//! The error of a whole run, by a second run.

use piola_numerics::{Lanes, Real};

use crate::field::largest_lane;
use crate::{
    Field, GaussLegendre16, GaussRadau15, IntegratorsError, Nystrom, NystromPair, Report, RungeKutta, RungeKuttaPair,
    SecondOrder, State,
};

/// How far the state at the end of a run is from the exact one, as a second, finer run tells.
///
/// A tolerance bounds what one step adds. What the motion makes of it until the end, a factor of up to many thousands, only
/// a run can tell. The finer run has a hundredth (order eight) or a thousandth (orders fifteen and sixteen) of the tolerance.
///
/// # Accuracy
/// Over Keplerian orbits, Hénon–Heiles, the figure eight and double pendulums, at tolerances from 1e-4 to 1e-13, the
/// largest estimate of a block of the state is within a factor of three of its true error in nine cases of ten, and never
/// less than a tenth. Where rounding is the error, both runs have it: the estimate is then of its size.
///
/// # Example
/// ```
/// use piola_integrators::{DormandPrince853, State, Tolerance, field};
/// // Ten turns of the circle, to 1e-6 in each step.
/// let mut circle = field(2, |_t, y: &[f64], rate: &mut [f64]| rate.copy_from_slice(&[-y[1], y[0]]));
/// let mut state = State::new(0.0, vec![1.0, 0.0])?;
/// let end = 20.0 * core::f64::consts::PI;
/// let estimate = DormandPrince853::new(Tolerance::relative(1e-6)?).integrate_and_estimate(&mut circle, &mut state, end)?;
/// let ratio = estimate.errors[1] / state.values[1].abs(); // exactly (1, 0)
/// assert!(0.9 < ratio && ratio < 1.1);
/// # Ok::<(), piola_integrators::IntegratorsError>(())
/// ```
#[doc(alias("global error", "error bar"))]
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ErrorEstimate {
    /// The estimated error of each component of the state at the end, in the component's unit.
    pub errors: Vec<f64>,
    /// What the run cost.
    pub run: Report,
    /// What the finer run cost.
    pub finer_run: Report,
}

/// The part of the tolerance that the finer run of order eight has.
const FINER_EIGHT: f64 = 1e-2;
/// The part of the tolerance that the finer run of orders fifteen and sixteen has.
const FINER_SIXTEEN: f64 = 1e-3;

impl<P: RungeKuttaPair, T: Real> RungeKutta<P, T> {
    /// Integrates to `end`, as [`integrate_to`](Self::integrate_to), and estimates the error there by a second run, which
    /// costs about 1.8 times the first.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), of either run. The state then stands where the first run ended.
    pub fn integrate_and_estimate<F: Field<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<ErrorEstimate, IntegratorsError<F::Error>> {
        let mut finer_state = state.clone();
        let run = self.integrate_to(field, state, end)?;
        let finer = self.tolerance().times::<T>(FINER_EIGHT);
        let coarse = core::mem::replace(&mut self.tolerance, finer);
        let finer_run = self.integrate_to(field, &mut finer_state, end);
        self.tolerance = coarse;
        Ok(ErrorEstimate { errors: differences(state, &finer_state), run, finer_run: finer_run? })
    }
}

impl<P: NystromPair, T: Real> Nystrom<P, T> {
    /// Integrates to `end`, as [`integrate_to`](Self::integrate_to), and estimates the error there by a second run, which
    /// costs about 1.8 times the first.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), of either run. The state then stands where the first run ended.
    pub fn integrate_and_estimate<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<ErrorEstimate, IntegratorsError<F::Error>> {
        let mut finer_state = state.clone();
        let run = self.integrate_to(field, state, end)?;
        let finer = self.tolerance().times::<T>(FINER_EIGHT);
        let coarse = core::mem::replace(&mut self.tolerance, finer);
        let finer_run = self.integrate_to(field, &mut finer_state, end);
        self.tolerance = coarse;
        Ok(ErrorEstimate { errors: differences(state, &finer_state), run, finer_run: finer_run? })
    }
}

impl GaussLegendre16 {
    /// Integrates to `end`, as [`integrate_to`](Self::integrate_to), and estimates the error there by a second run, which
    /// costs about 1.3 times the first with adaptive steps; with a fixed step, by one of twice as many steps.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), of either run. The state then stands where the first run ended.
    pub fn integrate_and_estimate<F: SecondOrder<Lanes<f64, 8>>>(
        &mut self,
        field: &mut F,
        state: &mut State,
        end: f64,
    ) -> Result<ErrorEstimate, IntegratorsError<F::Error>> {
        let mut finer_state = state.clone();
        let run = self.integrate_to(field, state, end)?;
        let finer_run = self.finer(FINER_SIXTEEN).integrate_to(field, &mut finer_state, end)?;
        Ok(ErrorEstimate { errors: differences(state, &finer_state), run, finer_run })
    }
}

impl<T: Real> GaussRadau15<T> {
    /// Integrates to `end`, as [`integrate_to`](Self::integrate_to), and estimates the error there by a second run, which
    /// costs about 1.6 times the first with adaptive steps; with a fixed step, by one of twice as many steps.
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate), of either run. The state then stands where the first run ended.
    pub fn integrate_and_estimate<F: SecondOrder<T>>(
        &mut self,
        field: &mut F,
        state: &mut State<T>,
        end: f64,
    ) -> Result<ErrorEstimate, IntegratorsError<F::Error>> {
        let mut finer_state = state.clone();
        let run = self.integrate_to(field, state, end)?;
        let finer_run = self.finer(FINER_SIXTEEN).integrate_to(field, &mut finer_state, end)?;
        Ok(ErrorEstimate { errors: differences(state, &finer_state), run, finer_run })
    }
}

/// How far two states are apart, with the parts that rounding left behind.
#[must_use]
pub fn differences<T: Real>(state: &State<T>, finer: &State<T>) -> Vec<f64> {
    let pairs = state.values.iter().zip(&state.carry).zip(finer.values.iter().zip(&finer.carry));
    pairs.map(|((&a, &a_carry), (&b, &b_carry))| largest_lane((a - b) + (a_carry - b_carry))).collect()
}
