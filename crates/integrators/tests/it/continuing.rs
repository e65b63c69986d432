//! What tests of stopped and continued runs share.

use core::convert::Infallible;
use core::fmt::Debug;
use core::ops::ControlFlow;

use piola_integrators::{IntegratorsError, Report, Separable, State, Step, separable};

/// Writes and reads a state or a checkpoint, where the feature allows it.
#[cfg(feature = "serde")]
pub(crate) fn written_and_read<T>(written: &T) -> T
where
    T: serde::Serialize + serde::de::DeserializeOwned + PartialEq + Debug,
{
    let read: T = serde_json::from_str(&serde_json::to_string(written).unwrap()).unwrap();
    assert_eq!(read, *written);
    read
}
#[cfg(not(feature = "serde"))]
pub(crate) fn written_and_read<T: Clone + PartialEq + Debug>(written: &T) -> T {
    written.clone()
}

/// Stops after the step of this number.
pub(crate) fn until(number: u64) -> impl FnMut(Step<'_>) -> ControlFlow<()> {
    move |step| if step.number == number { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// An attraction that grows with time, so that a force at the wrong moment shows.
pub(crate) fn growing() -> impl Separable<Error = Infallible> {
    separable(2, |t: f64, q: &[f64], force: &mut [f64]| {
        let factor = -(1.0 + 0.1 * t) / (q[0] * q[0] + q[1] * q[1]).powf(1.5);
        force.copy_from_slice(&[factor * q[0], factor * q[1]]);
    })
}

/// A state that has nothing to do with the run.
pub(crate) fn elsewhere(dimension: usize) -> State {
    State::new(-1.0, vec![7.0; dimension]).unwrap()
}

/// A run to a time that is none cannot begin: it leaves the state alone, which was that `elsewhere`.
pub(crate) fn assert_refused(run: &Result<Report, IntegratorsError>, state: &State) {
    assert!(matches!(run, Err(IntegratorsError::NotFinite { quantity: "end", .. })), "{run:?}");
    assert_eq!(*state, elsewhere(state.values.len()));
}
