//! Splittings with reversible steps: no drift, reversal, order, what goes wrong.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_geometric::{ReversibleComposition, StepLength};
use piola_integrators::{
    DormandPrince853, IntegratorsError, Order, Separable, SplittingScheme, State, Tolerance, field,
};
use piola_numerics::Real;
use piola_testkit::{allocations_in, assert_order, relative_error};

use crate::problems::kepler_at;

struct Kepler;
impl Separable for Kepler {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        2
    }
    fn force(&mut self, _t: f64, q: &[f64], force: &mut [f64]) -> Result<(), Infallible> {
        let square = q[0] * q[0] + q[1] * q[1];
        let factor = 1.0 / (square * square.sqrt());
        force.copy_from_slice(&[-q[0] * factor, -q[1] * factor]);
        Ok(())
    }
}

/// |q|^(3/2).
pub(crate) struct Distance;
impl StepLength for Distance {
    fn length<T: Real>(&self, q: &[T]) -> T {
        let square = q[0] * q[0] + q[1] * q[1];
        (square * square.sqrt()).sqrt()
    }
}

const TURN: f64 = core::f64::consts::TAU;

fn start(e: f64) -> State {
    State::new(0.0, kepler_at(e, 0.0).to_vec()).unwrap()
}

fn energy_error(y: &[f64]) -> f64 {
    0.5 * (y[2] * y[2] + y[3] * y[3]) - 1.0 / y[0].hypot(y[1]) + 0.5
}

/// The largest energy errors of the first and of the last of `parts` parts of a run at e = 0.9, from the pericentre.
fn energy_errors(mut method: ReversibleComposition, turns: f64, part: f64) -> [f64; 2] {
    let mut state = start(0.9);
    let mut worst = [0.0_f64; 2];
    method
        .integrate(&mut Kepler, &Distance, &mut state, turns * TURN, |step| {
            let error = energy_error(step.values).abs();
            if step.time < part * TURN {
                worst[0] = worst[0].max(error);
            } else if (turns - part) * TURN < step.time {
                worst[1] = worst[1].max(error);
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    worst
}

/// Störmer and Verlet's energy error is of order ε² and stays where it is; with a tolerance an explicit pair drifts.
#[test]
fn energy_of_ten_thousand_revolutions_does_not_drift() {
    let method = ReversibleComposition::new(SplittingScheme::Composition(Order::Two), 0.1).unwrap();
    let [first, last] = energy_errors(method, 10_000.0, 100.0);
    assert!(last < 1.05 * first && first < 0.05, "{first:e}, {last:e}");
    let method = ReversibleComposition::new(SplittingScheme::Nystrom6, 0.2).unwrap();
    let [first, last] = energy_errors(method, 1_000.0, 50.0);
    assert!(last < 1.2 * first && first < 1e-4, "{first:e}, {last:e}");
    // What drift is: the same error in the first revolutions, many times that in the end.
    let mut kepler = field(4, |_t, y: &[f64], rate: &mut [f64]| {
        let cube = y[0].hypot(y[1]).powi(3);
        rate.copy_from_slice(&[y[2], y[3], -y[0] / cube, -y[1] / cube]);
    });
    let mut state = start(0.9);
    let mut pair = DormandPrince853::new(Tolerance::relative(1e-6).unwrap());
    let mut at = [10.0, 200.0].map(|turns| {
        pair.integrate_to(&mut kepler, &mut state, turns * TURN).unwrap();
        energy_error(&state.values).abs()
    });
    at[0] *= 10.0;
    assert!(at[0] < at[1], "{at:?}");
}

/// Steps there, and as many back from the density reached.
#[test]
fn steps_back_lead_to_the_start() {
    for scheme in SplittingScheme::ALL {
        let mut method = ReversibleComposition::new(scheme, 0.05).unwrap();
        let mut state = start(0.9);
        let none = |_: piola_integrators::Step<'_>| ControlFlow::Continue(());
        method.integrate_steps(&mut Kepler, &Distance, &mut state, (500, false, false), none).unwrap();
        assert!(3.0 < state.time);
        method.integrate_steps(&mut Kepler, &Distance, &mut state, (500, true, true), none).unwrap();
        let error = relative_error(&state.values, &kepler_at(0.9, 0.0));
        assert!(error < 1e-9 && state.time.abs() < 1e-10, "{scheme:?}: {error:e}, {:e}", state.time);
    }
}

#[test]
fn errors_fall_with_the_order_of_the_scheme() {
    for (scheme, scales) in [
        (SplittingScheme::Composition(Order::Two), [0.02, 0.01, 0.005, 0.0016]),
        (SplittingScheme::Nystrom4, [0.05, 0.032, 0.02, 0.0125]),
        (SplittingScheme::Nystrom6, [0.1, 0.08, 0.0625, 0.04]),
    ] {
        let errors = scales.map(|scale| {
            let mut state = start(0.6);
            let mut method = ReversibleComposition::new(scheme, scale).unwrap();
            method.integrate_to(&mut Kepler, &Distance, &mut state, 10.0).unwrap();
            assert!((state.time - 10.0).abs() <= 0.0);
            relative_error(&state.values, &kepler_at(0.6, 10.0))
        });
        assert!(100.0 * errors[3] < errors[0], "{scheme:?}: less than two decades: {errors:?}");
        assert_order(&format!("{scheme:?}"), &scales, &errors, f64::from(scheme.order()), 0.1);
    }
}

/// Steps where they are needed: at equal cost the error is smaller than that of equal steps, by far.
#[test]
fn reversible_steps_err_less_than_equal_steps_of_equal_cost() {
    let end = 10.0 * TURN;
    let mut state = start(0.9);
    let report = ReversibleComposition::new(SplittingScheme::Nystrom6, 0.1)
        .unwrap()
        .integrate_to(&mut Kepler, &Distance, &mut state, end)
        .unwrap();
    let adaptive = energy_error(&state.values).abs();
    let mut state = start(0.9);
    let step = end / report.steps as f64;
    piola_integrators::Composition::with_scheme(SplittingScheme::Nystrom6, step)
        .unwrap()
        .integrate_to(&mut Kepler, &mut state, end)
        .unwrap();
    let equal = energy_error(&state.values).abs();
    assert!(100.0 * adaptive < equal, "{adaptive:e}, {equal:e}");
}

#[test]
fn runs_backwards_and_empty_runs() {
    let mut state = start(0.6);
    let mut method = ReversibleComposition::new(SplittingScheme::Nystrom6, 0.05).unwrap();
    assert_eq!(method.integrate_to(&mut Kepler, &Distance, &mut state, 0.0).unwrap().steps, 0);
    method.integrate_to(&mut Kepler, &Distance, &mut state, -3.0).unwrap();
    assert!(relative_error(&state.values, &kepler_at(0.6, -3.0)) < 1e-7);
    let report = method.integrate(&mut Kepler, &Distance, &mut state, 1.0, |_| ControlFlow::Break(())).unwrap();
    assert_eq!((report.steps, report.ending), (1, piola_integrators::Ending::Stopped));
}

/// The density at the end of a run whose last step was cut short is near 1/σ, to O(ε²) and not O(ε).
#[test]
fn density_after_a_step_that_was_cut_short_is_that_of_the_end() {
    let mut departures = Vec::new();
    for scale in [0.1, 0.05, 0.025] {
        let mut method = ReversibleComposition::new(SplittingScheme::Nystrom6, scale).unwrap();
        let mut largest = 0.0_f64;
        for k in 0..20 {
            let mut state = start(0.6);
            method.integrate_to(&mut Kepler, &Distance, &mut state, 1.0 + 0.013 * f64::from(k)).unwrap();
            let sigma = state.values[0].hypot(state.values[1]).powf(1.5);
            largest = largest.max((method.density().unwrap() * sigma - 1.0).abs());
        }
        departures.push(largest);
    }
    assert!(departures[0] < 0.02, "{departures:?}");
    assert!(departures.windows(2).all(|pair| 3.0 * pair[1] < pair[0]), "{departures:?}");
}

#[test]
fn steps_allocate_nothing() {
    let mut state = start(0.9);
    let mut method = ReversibleComposition::new(SplittingScheme::Composition(Order::Six), 0.05).unwrap();
    method.integrate_to(&mut Kepler, &Distance, &mut state, 1.0).unwrap();
    let (count, _) = allocations_in(|| method.integrate_to(&mut Kepler, &Distance, &mut state, 10.0).unwrap());
    assert_eq!(count, 0);
}

#[test]
fn what_is_wrong_is_named_and_the_state_kept() {
    struct Wrong(f64);
    impl StepLength for Wrong {
        fn length<T: Real>(&self, _q: &[T]) -> T {
            T::lit(self.0)
        }
    }
    assert!(matches!(
        ReversibleComposition::new(SplittingScheme::Nystrom4, 0.0),
        Err(IntegratorsError::InvalidStep { .. })
    ));
    let mut method = ReversibleComposition::new(SplittingScheme::Nystrom4, 0.1).unwrap();
    for value in [0.0, -1.0] {
        let mut state = start(0.5);
        let error = method.integrate_to(&mut Kepler, &Wrong(value), &mut state, 1.0).unwrap_err();
        assert_eq!(error, IntegratorsError::NotPositive { quantity: "step length", value });
        assert_eq!(state, start(0.5));
    }
    let mut state = start(0.5);
    let error = method.integrate_to(&mut Kepler, &Wrong(f64::NAN), &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "step length", index: 0, .. }));
    // ε far too large: the density becomes negative on the way out.
    let mut state = start(0.9);
    let mut method = ReversibleComposition::new(SplittingScheme::Composition(Order::Two), 5.0).unwrap();
    let error = method.integrate_to(&mut Kepler, &Distance, &mut state, 100.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotPositive { quantity: "density", .. }), "{error}");
    assert!(state.values.iter().all(|y| y.is_finite()));
    // Steps that no longer advance the time.
    let mut state = State::new(1e9, kepler_at(0.5, 0.0).to_vec()).unwrap();
    let mut method = ReversibleComposition::new(SplittingScheme::Nystrom4, 1e-9).unwrap();
    let error = method.integrate_to(&mut Kepler, &Distance, &mut state, 2e9).unwrap_err();
    assert!(matches!(error, IntegratorsError::StepTooSmall { .. }));
}
