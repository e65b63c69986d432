//! Places where integrators fail silently: rest, symmetry, singularities, the ends of runs, bad input.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    Composition, DormandPrince853, Ending, Field, GaussLegendre, IntegratorsError, Order, Report, Separable, State,
    Tolerance, Verner98, field, separable,
};
use piola_numerics::{Lanes, Real};
use piola_testkit::{Tol, assert_close};

use crate::problems::{DoublePendulum, FIGURE_EIGHT, kepler, kepler_at, three_bodies};

fn adaptive<T: Real>(tolerance: f64) -> DormandPrince853<T> {
    DormandPrince853::new(Tolerance::relative(tolerance).unwrap())
}

#[test]
fn pendulum_from_rest_equals_tight_collocation() {
    // From rest the rates of the positions vanish: an estimate of the first step from them alone fails.
    for start in [2.0, 3.0, 1e-3, 1e-9] {
        let mut pendulum = field(2, |_t, y: &[f64], rate: &mut [f64]| {
            rate[0] = y[1];
            rate[1] = -y[0].sin();
        });
        let mut explicit = State::new(0.0, vec![start, 0.0]).unwrap();
        let mut implicit = explicit.clone();
        let report = adaptive(1e-13).integrate_to(&mut pendulum, &mut explicit, 10.0).unwrap();
        assert!(report.steps < 200, "{report:?}");
        GaussLegendre::new(Order::Eight, 0.05).unwrap().integrate_to(&mut pendulum, &mut implicit, 10.0).unwrap();
        let tol = Tol::stated(1e-11, "tolerance 1e-13 over ten units of time");
        assert_close("pendulum", &explicit.values, &implicit.values, tol);
    }
}

#[test]
fn symmetric_starts_stay_symmetric() {
    // Two equal bodies fall past a third between them, from rest, mirrored in the origin.
    let mut state = State::new(0.0, vec![1.0, 0.5, -1.0, -0.5, 0.0, 0.0, 0.0, 0.4, 0.0, -0.4, 0.0, 0.0]).unwrap();
    adaptive(1e-12).integrate_to(&mut three_bodies(), &mut state, 3.0).unwrap();
    let y = &state.values;
    assert_close("mirror", &[y[0], y[1], y[6], y[7]], &[-y[2], -y[3], -y[8], -y[9]], Tol::ulps(64.0));
    assert_close("centre", &[1.0 + y[4], 1.0 + y[5]], &[1.0, 1.0], Tol::ulps(64.0));
}

#[test]
fn equilibrium_stays_to_the_last_bit() {
    let mut pendulum = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.81 };
    let start = State::new(0.0, vec![0.0; 4]).unwrap();
    let mut state = start.clone();
    adaptive(1e-12).integrate_to(&mut pendulum, &mut state, 100.0).unwrap();
    assert_eq!(state.values, start.values);
    let mut state = start.clone();
    GaussLegendre::new(Order::Six, 0.1).unwrap().integrate_to(&mut pendulum, &mut state, 100.0).unwrap();
    assert_eq!(state.values, start.values);
}

#[test]
fn drive_from_the_zero_state_equals_the_integral() {
    // y = 0 has no magnitude; a purely relative tolerance must still start.
    let mut driven = field(1, |t: f64, _y: &[f64], rate: &mut [f64]| rate[0] = t.cos());
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    adaptive(1e-12).integrate_to(&mut driven, &mut state, 2.0).unwrap();
    assert_close("sine", &state.values, &[2.0_f64.sin()], Tol::stated(1e-11, "tolerance 1e-12"));
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    GaussLegendre::new(Order::Eight, 0.1).unwrap().integrate_to(&mut driven, &mut state, 2.0).unwrap();
    assert_close("sine", &state.values, &[2.0_f64.sin()], Tol::stated(1e-12, "order eight at step 0.1"));
}

#[test]
fn backward_run_returns_to_the_start() {
    let start = kepler_at(0.9, 0.0);
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut method = adaptive(1e-14);
    method.integrate_to(&mut kepler(), &mut state, 5.0).unwrap();
    assert_eq!(state.time.to_bits(), 5.0_f64.to_bits());
    method.integrate_to(&mut kepler(), &mut state, 0.0).unwrap();
    assert_eq!(state.time.to_bits(), 0.0_f64.to_bits());
    assert_close("start", &state.values, &start, Tol::stated(1e-10, "tolerance 1e-14 times the sensitivity, 1e3"));
}

#[test]
fn run_of_zero_length_changes_nothing() {
    let start = State::new(2.0, kepler_at(0.3, 2.0).to_vec()).unwrap();
    let mut state = start.clone();
    let nothing = Report::begin();
    assert_eq!(adaptive(1e-9).integrate_to(&mut kepler(), &mut state, 2.0).unwrap(), nothing);
    let mut composition = Composition::new(Order::Eight, 0.1).unwrap();
    assert_eq!(composition.integrate_to(&mut kepler(), &mut state, 2.0).unwrap(), nothing);
    let mut collocation = GaussLegendre::new(Order::Eight, 0.1).unwrap();
    assert_eq!(collocation.integrate_to(&mut kepler(), &mut state, 2.0).unwrap(), nothing);
    assert_eq!(state, start);
}

#[test]
fn whole_number_of_steps_is_not_given_one_more() {
    for (end, step, expected) in [(1.0, 0.1, 10), (0.3, 0.1, 3), (-1.0, 0.1, 10), (1.0, 0.3, 4), (1e-300, 1.0, 1)] {
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let report = Composition::new(Order::Two, step).unwrap().integrate_to(&mut kepler(), &mut state, end).unwrap();
        assert_eq!(report.steps, expected);
        assert_eq!(state.time.to_bits(), end.to_bits());
    }
}

#[test]
fn observers_stop_runs_at_their_step() {
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let report = Composition::new(Order::Four, 0.125)
        .unwrap()
        .integrate(&mut kepler(), &mut state, 10.0, |step| {
            if step.number == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
    assert_eq!((report.steps, report.ending, state.time.to_bits()), (3, Ending::Stopped, 0.375_f64.to_bits()));
    let report = GaussLegendre::new(Order::Four, 0.125)
        .unwrap()
        .integrate(&mut kepler(), &mut state, 10.0, |step| {
            if step.number == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
    assert_eq!((report.steps, report.ending), (5, Ending::Stopped));
    let report = adaptive(1e-9)
        .integrate(&mut kepler(), &mut state, 10.0, |step| {
            if step.number() == 2 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
    assert_eq!((report.steps, report.ending), (2, Ending::Stopped));
}

/// A field that refuses positions beyond one.
struct Walled;
#[derive(Debug, PartialEq)]
struct Wall;
impl Field for Walled {
    type Error = Wall;
    fn dimension(&self) -> usize {
        2
    }
    fn rate(&mut self, _t: f64, y: &[f64], rate: &mut [f64]) -> Result<(), Wall> {
        rate.copy_from_slice(&[y[1], 0.0]);
        if y[0] <= 1.0 { Ok(()) } else { Err(Wall) }
    }
}
impl Separable for Walled {
    type Error = Wall;
    fn freedom(&self) -> usize {
        1
    }
    fn force(&mut self, _t: f64, q: &[f64], force: &mut [f64]) -> Result<(), Wall> {
        force[0] = 0.0;
        if q[0] <= 1.0 { Ok(()) } else { Err(Wall) }
    }
}

#[test]
fn field_that_fails_leaves_the_last_good_state() {
    let start = State::new(0.0, vec![0.0, 1.0]).unwrap();
    let mut state = start.clone();
    let mut seen = 0.0;
    let error = adaptive(1e-9)
        .integrate(&mut Walled, &mut state, 10.0, |step| {
            seen = step.time();
            ControlFlow::Continue(())
        })
        .unwrap_err();
    // However small the step, beyond the wall there is no field; up to it the run has come.
    assert!(matches!(error, IntegratorsError::Field { source: Wall, .. }), "{error:?}");
    assert_eq!(state.time.to_bits(), seen.to_bits());
    assert_close("wall", &[state.time, state.values[0]], &[1.0, 1.0], Tol::ulps(16.0));

    let mut state = start.clone();
    let error = Composition::new(Order::Six, 0.125).unwrap().integrate_to(&mut Walled, &mut state, 10.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::Field { source: Wall, .. }));
    assert!(state.time <= 1.0);
    assert_close("composition", &state.values, &[state.time, 1.0], Tol::ulps(16.0));

    let mut state = start;
    let error = GaussLegendre::new(Order::Six, 0.125).unwrap().integrate_to(&mut Walled, &mut state, 10.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::Field { source: Wall, .. }));
    assert_close("collocation", &[state.time, state.values[0]], &[1.0, 1.0], Tol::ulps(16.0));
}

#[test]
fn rate_that_is_nan_leaves_the_last_good_state() {
    let mut rooted = field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = (1.0 - y[0]).sqrt() + 1.0);
    let mut state = State::new(0.0, vec![0.0]).unwrap();
    let error = adaptive(1e-9).integrate_to(&mut rooted, &mut state, 10.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 0, t: Some(_), .. }), "{error:?}");
    assert!(0.99 < state.values[0] && state.values[0] <= 1.0);
    let mut rooted = separable(1, |_t, q: &[f64], force: &mut [f64]| force[0] = (1.0 - q[0]).sqrt());
    let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
    let error = Composition::new(Order::Two, 0.1).unwrap().integrate_to(&mut rooted, &mut state, 10.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 0, t: Some(_), .. }));
    assert!(0.0 < state.time && state.values.iter().all(|y| y.is_finite()));
}

#[test]
fn velocity_that_is_nan_is_refused() {
    struct Broken;
    impl Separable for Broken {
        type Error = Infallible;
        fn freedom(&self) -> usize {
            1
        }
        fn velocity(&mut self, t: f64, p: &[f64], velocity: &mut [f64]) -> Result<(), Self::Error> {
            velocity[0] = if t < 1.0 { p[0] } else { f64::NAN };
            Ok(())
        }
        fn force(&mut self, _t: f64, _q: &[f64], force: &mut [f64]) -> Result<(), Self::Error> {
            force[0] = 0.0;
            Ok(())
        }
    }
    let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
    let error = Composition::new(Order::Two, 0.25).unwrap().integrate_to(&mut Broken, &mut state, 10.0).unwrap_err();
    let IntegratorsError::NotFinite { quantity: "state", index: 0, value, t: Some(t) } = error else {
        panic!("{error:?}")
    };
    assert!(value.is_nan());
    assert_eq!(t.to_bits(), 0.75_f64.to_bits());
    assert_eq!(state.values, [0.75, 1.0]);
}

#[test]
fn nan_in_one_lane_is_not_hidden_by_the_others() {
    type Two = Lanes<f64, 2>;
    let mut rooted =
        field(1, |_t, y: &[Two], rate: &mut [Two]| rate[0] = (Two::lit(1.0) - y[0]).sqrt() + Two::lit(1.0));
    let mut state = State::new(0.0, vec![Two::from([-100.0, 0.0])]).unwrap();
    let error = adaptive(1e-9).integrate_to(&mut rooted, &mut state, 10.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 0, t: Some(_), .. }), "{error:?}");
    let invalid = State::new(0.0, vec![Two::from([0.0, f64::NAN])]);
    assert!(
        matches!(invalid, Err(IntegratorsError::NotFinite { quantity: "state", index: 0, value, t: None }) if value.is_nan())
    );
}

#[test]
fn approach_to_a_singularity_ends_with_a_step_too_small() {
    // y = 1/(1 − t) leaves every bound at t = 1.
    let mut explosion = field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = y[0] * y[0]);
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let error = adaptive(1e-12).integrate_to(&mut explosion, &mut state, 2.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::StepTooSmall { .. }), "{error:?}");
    assert_close("time of explosion", &[state.time], &[1.0], Tol::stated(1e-11, "tolerance 1e-12"));
    assert!(1e10 < state.values[0]);
}

#[test]
fn stages_that_diverge_are_refused() {
    let mut stiff = field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = -1e6 * y[0]);
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let error = GaussLegendre::new(Order::Eight, 0.1).unwrap().integrate_to(&mut stiff, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::StagesDiverged { .. } | IntegratorsError::NotFinite { .. }), "{error:?}");
    assert_eq!((state.time.to_bits(), state.values[0].to_bits()), (0.0_f64.to_bits(), 1.0_f64.to_bits()));
}

#[test]
fn limit_on_steps_is_kept() {
    let mut state = State::new(0.0, kepler_at(0.9, 0.0).to_vec()).unwrap();
    let error = adaptive(1e-12).with_most_steps(7).integrate_to(&mut kepler(), &mut state, 100.0).unwrap_err();
    assert_eq!(error, IntegratorsError::TooManySteps { t: state.time, steps: 7 });
}

#[test]
fn longest_step_is_kept_to_the_end() {
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let mut method = adaptive(1e-6).with_longest_step(0.01).unwrap();
    method
        .integrate(&mut kepler(), &mut state, 1.00005, |step| {
            assert!(step.time() - step.start() <= 0.01 * (1.0 + Tol::ulps(64.0).value()));
            ControlFlow::Continue(())
        })
        .unwrap();
}

#[test]
fn bad_input_is_refused_by_name() {
    for (relative, absolute) in
        [(-1e-9, 0.0), (0.0, 0.0), (1.0, 0.0), (f64::NAN, 0.0), (1e-9, f64::NAN), (1e-9, -1.0), (1e-9, f64::INFINITY)]
    {
        let refused = Tolerance::new(relative, absolute);
        assert!(matches!(refused, Err(IntegratorsError::InvalidTolerance { .. })), "{relative} {absolute}");
    }
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Composition::<f64>::new(Order::Two, step).is_err());
        assert!(GaussLegendre::<f64>::new(Order::Two, step).is_err());
        assert!(adaptive::<f64>(1e-9).with_first_step(step).is_err());
    }
    assert!(adaptive::<f64>(1e-9).with_longest_step(f64::NAN).is_err());
    assert!(matches!(State::new(f64::NAN, vec![1.0]), Err(IntegratorsError::NotFinite { quantity: "t", .. })));
    assert_eq!(
        State::new(0.0, vec![1.0, f64::NEG_INFINITY]),
        Err(IntegratorsError::NotFinite { quantity: "state", index: 1, value: f64::NEG_INFINITY, t: None })
    );
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    let mismatch = IntegratorsError::WrongLength { quantity: "state", expected: 4, found: 1 };
    assert_eq!(adaptive(1e-9).integrate_to(&mut kepler(), &mut state, 1.0), Err(mismatch));
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    for end in [f64::NAN, f64::INFINITY] {
        let error = Composition::new(Order::Two, 0.1).unwrap().integrate_to(&mut kepler(), &mut state, end);
        assert!(matches!(error, Err(IntegratorsError::NotFinite { quantity: "end", .. })));
    }
    // Steps that cannot advance the time, or could not be counted.
    let error = Composition::new(Order::Two, 1e-300).unwrap().integrate_to(&mut kepler(), &mut state, 1.0);
    assert!(matches!(error, Err(IntegratorsError::StepTooSmall { .. })));
    state.values[2] = f64::NAN;
    let error = adaptive(1e-9).integrate_to(&mut kepler(), &mut state, 1.0);
    assert!(matches!(error, Err(IntegratorsError::NotFinite { quantity: "state", index: 2, .. })));
}

#[test]
fn state_with_replaced_values_is_integrated_from_them() {
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    state.values = kepler_at(0.3, 0.0).to_vec();
    Composition::new(Order::Eight, 0.01).unwrap().integrate_to(&mut kepler(), &mut state, 1.0).unwrap();
    assert_close("kepler", &state.values, &kepler_at(0.3, 1.0), Tol::stated(1e-12, "order eight at step 0.01"));
}

/// Steps that stability bounded, among all, of both Runge–Kutta pairs.
fn stiff_steps<F: Field<Error = Infallible>>(
    mut field: F,
    start: &[f64],
    end: f64,
    tolerance: f64,
) -> [(u64, u64, bool); 2] {
    let tolerance = Tolerance::relative(tolerance).unwrap();
    let (mut one, mut other) = (State::new(0.0, start.to_vec()).unwrap(), State::new(0.0, start.to_vec()).unwrap());
    let eight = DormandPrince853::new(tolerance).integrate_to(&mut field, &mut one, end).unwrap();
    let nine = Verner98::new(tolerance).integrate_to(&mut field, &mut other, end).unwrap();
    [eight, nine].map(|report| (report.stiff_steps, report.steps, report.was_stiff()))
}

#[test]
fn a_stiff_problem_is_reported_and_no_other() {
    for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
        // Decay a thousand times as fast as the motion; van der Pol's relaxation with μ = 1000.
        let follower = field(1, |t: f64, y: &[f64], rate: &mut [f64]| rate[0] = -1000.0 * (y[0] - t.cos()));
        for (stiff, all, was) in stiff_steps(follower, &[1.0], 10.0, tolerance) {
            assert!(was && all < 2 * stiff, "tolerance {tolerance:e}: {stiff} of {all}");
        }
        let van_der_pol = field(2, |_t, y: &[f64], rate: &mut [f64]| {
            rate[0] = y[1];
            rate[1] = 1000.0 * (1.0 - y[0] * y[0]) * y[1] - y[0];
        });
        for (stiff, all, was) in stiff_steps(van_der_pol, &[2.0, 0.0], 10.0, tolerance) {
            assert!(was && all < 2 * stiff, "van der Pol, tolerance {tolerance:e}: {stiff} of {all}");
        }
        // Close encounters and fast oscillations are not stiff.
        let pendulum = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.8125 };
        for (stiff, all, was) in [
            stiff_steps(kepler(), &kepler_at(0.9, 0.0), 20.0, tolerance),
            stiff_steps(three_bodies(), &FIGURE_EIGHT, 20.0, tolerance),
            stiff_steps(pendulum, &[2.0, 1.0, 0.0, 0.0], 20.0, tolerance),
        ]
        .concat()
        {
            assert!(!was && 20 * stiff < all, "tolerance {tolerance:e}: {stiff} of {all}");
        }
    }
}
