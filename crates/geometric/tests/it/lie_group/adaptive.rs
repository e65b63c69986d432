//! Steps that adapt: errors proportional to the tolerance, starts, limits, failures.

use core::ops::ControlFlow;

use piola_geometric::{AdaptiveMuntheKaas, DirectProduct, RigidMotions, Rotations, Translations, group_field};
use piola_integrators::{Ending, IntegratorsError, Report, State, Tolerance};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale};

use super::{Top, reference};

fn adaptive<T: Real>(tolerance: f64) -> AdaptiveMuntheKaas<T> {
    AdaptiveMuntheKaas::new(Tolerance::relative(tolerance).unwrap())
}

const ONE: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

#[test]
fn errors_of_tops_are_proportional_to_the_tolerance() {
    let mut compared = 0;
    for (name, factor) in [
        ("free asymmetric top", 2.0),
        ("free top about its middle axis", 2.0),
        ("heavy top, asymmetric", 2.0),
        ("heavy top of the test set", 200.0),
    ] {
        for tolerance in [1e-6, 1e-8, 1e-10, 1e-12] {
            let (mut top, mut state, states) = reference(name);
            let (t, expected) = states.last().unwrap();
            let report = adaptive(tolerance).integrate_to(&mut top, &mut state, *t).unwrap();
            let error = state.values.iter().zip(expected).take(4).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max);
            assert!(error <= factor * tolerance, "{name}, {tolerance:e}: {error:e}");
            assert!(report.rejected * 10 <= report.steps + 10, "{report:?}");
            compared += 1;
        }
    }
    assert_eq!(compared, 16);
}

#[test]
fn observers_see_every_step_and_stop_runs() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let mut state = start.clone();
    let mut times = vec![0.0];
    let report = adaptive(1e-8)
        .integrate(&mut top, &mut state, 5.0, |step| {
            assert_eq!(step.number, times.len() as u64);
            times.push(step.time);
            if step.number == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .unwrap();
    assert_eq!((report.steps, report.ending, times.len()), (5, Ending::Stopped, 6));
    assert!(times.windows(2).all(|t| t[0] < t[1]));
    assert_eq!(state.time.to_bits(), times[5].to_bits());
    let mut state = start.clone();
    let nothing = Report::begin();
    assert_eq!(adaptive(1e-8).integrate_to(&mut top, &mut state, 0.0).unwrap(), nothing);
    assert_eq!(state, start);
}

#[test]
fn starts_from_rest_and_rest_need_no_help() {
    // A pendulum from the horizontal.
    let mut top = Top::new([1.0, 2.0, 2.0], [3.0, 0.0, 0.0]);
    let mut state = State::new(0.0, [&ONE[..], &[0.0; 3]].concat()).unwrap();
    let report = adaptive(1e-12).integrate_to(&mut top, &mut state, 4.0).unwrap();
    assert!(report.steps < 60, "{report:?}");
    assert_close_at_scale("energy", &[top.energy(&state.values)], &[0.0], 3.0, Tol::stated(1e-11, "tolerance 1e-12"));
    // One that hangs.
    let mut top = Top::new([1.0, 2.0, 3.0], [0.0, 0.0, -1.0]);
    let start = State::new(0.0, [&ONE[..], &[0.0; 3]].concat()).unwrap();
    let mut state = start.clone();
    adaptive(1e-12).integrate_to(&mut top, &mut state, 100.0).unwrap();
    assert_eq!(state.values, start.values);
}

#[test]
fn limits_on_steps_are_kept() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let mut state = start.clone();
    let error = adaptive(1e-12).with_most_steps(7).integrate_to(&mut top, &mut state, 5.0).unwrap_err();
    assert_eq!(error, IntegratorsError::TooManySteps { t: state.time, steps: 7 });
    let mut method = adaptive(1e-6).with_longest_step(0.01).unwrap().with_first_step(0.001).unwrap();
    let (mut state, mut before) = (start.clone(), 0.0);
    method
        .integrate(&mut top, &mut state, 1.00005, |step| {
            let length = step.time - before;
            assert!(length <= if step.number == 1 { 0.001 } else { 0.01 } * (1.0 + Tol::ulps(64.0).value()));
            before = step.time;
            ControlFlow::Continue(())
        })
        .unwrap();
    for step in [0.0, -1.0, f64::NAN] {
        assert!(matches!(adaptive::<f64>(1e-6).with_first_step(step), Err(IntegratorsError::InvalidStep { .. })));
        assert!(matches!(adaptive::<f64>(1e-6).with_longest_step(step), Err(IntegratorsError::InvalidStep { .. })));
    }
    // Bad states are refused as by the other methods.
    let mut long = start;
    long.values[0] = 2.0;
    let error = adaptive(1e-6).integrate_to(&mut top, &mut long, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::OutsideGroup { index: 0, .. }), "{error:?}");
}

#[test]
fn approach_to_a_singularity_ends_with_the_last_good_state() {
    // The rate of turning is 1/(1 − t): the angle −ln(1 − t) leaves every bound.
    let mut spin = group_field(Rotations, |t: f64, _q: &[f64], omega: &mut [f64]| {
        omega.copy_from_slice(&[0.0, 0.0, 1.0 / (1.0 - t)]);
    });
    let mut state = State::new(0.0, ONE.to_vec()).unwrap();
    let error = adaptive(1e-10).integrate_to(&mut spin, &mut state, 2.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::StepTooSmall { .. } | IntegratorsError::NotFinite { .. }), "{error:?}");
    assert_close("time", &[state.time], &[1.0], Tol::stated(1e-10, "tolerance 1e-10"));
    // A rate that is NaN beyond t = 1.
    let mut spin = group_field(Rotations, |t: f64, _q: &[f64], omega: &mut [f64]| {
        omega.copy_from_slice(&[0.0, 0.0, if t <= 1.0 { t.cos() } else { f64::NAN }]);
    });
    let mut state = State::new(0.0, ONE.to_vec()).unwrap();
    let error = adaptive(1e-10).integrate_to(&mut spin, &mut state, 2.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 2, t: Some(_), .. }), "{error:?}");
    let half = 0.5 * state.time.sin();
    assert_close("state", &state.values, &[half.cos(), 0.0, 0.0, half.sin()], Tol::stated(1e-10, "tolerance 1e-10"));
    assert!(0.99 < state.time && state.time <= 1.0);
}

/// A pose in large coordinates beside a small number: each is measured by its own magnitude.
#[test]
fn error_of_each_factor_is_relative_to_its_own_magnitude() {
    let group = DirectProduct(RigidMotions, Translations(1));
    let mut moving = group_field(group, |t: f64, y: &[f64], velocity: &mut [f64]| {
        // A circle of radius 1e7 m about the origin once in 2π s, and growth from 1e-9.
        velocity.copy_from_slice(&[0.0, 0.0, 1.0, 1e7, 0.0, 0.0, t.cos() * y[7]]);
    });
    let start = vec![1.0, 0.0, 0.0, 0.0, 0.0, -1e7, 0.0, 1e-9];
    let mut state = State::new(0.0, start).unwrap();
    adaptive(1e-11).integrate_to(&mut moving, &mut state, 2.0).unwrap();
    let (s, c) = 2.0_f64.sin_cos();
    let tol = Tol::stated(1e-10, "tolerance 1e-11 over two seconds");
    assert_close("attitude", &state.values[..4], &[1.0_f64.cos(), 0.0, 0.0, 1.0_f64.sin()], tol);
    assert_close("place", &state.values[4..7], &[1e7 * s, -1e7 * c, 0.0], tol);
    assert_close("growth", &state.values[7..], &[1e-9 * s.exp()], tol);
}

#[test]
fn other_scalars_give_the_same_motion() {
    type Two = Lanes<f64, 2>;
    let (mut top, start, states) = reference("heavy top, asymmetric");
    let (t, expected) = &states[2];
    let mut state = State::new(0.0, start.values.iter().map(|&x| Two::from([x, x])).collect()).unwrap();
    adaptive(1e-13).integrate_to(&mut top, &mut state, *t).unwrap();
    for lane in 0..2 {
        let found: Vec<f64> = state.values.iter().map(|x| x.primal(lane)).collect();
        assert_close("lane", &found, expected, Tol::stated(1e-11, "tolerance 1e-13"));
    }
    let mut state = State::new(0.0, start.values.iter().map(|&x| Dual::constant(x)).collect()).unwrap();
    adaptive(1e-13).integrate_to(&mut top, &mut state, *t).unwrap();
    let (mut plain, mut again) = (start.clone(), start);
    let mut method = adaptive(1e-13);
    method.integrate_to(&mut top, &mut plain, *t).unwrap();
    let found: Vec<f64> = state.values.iter().map(|x| x.value).collect();
    assert_eq!(found, plain.values);
    assert_eq!(state.values.iter().map(|x| x.tangent).collect::<Vec<_>>(), vec![0.0; 7]);
    // A second run repeats to the last bit, and allocates nothing.
    let (count, ()) = allocations_in(|| {
        method.integrate_to(&mut top, &mut again, *t).unwrap();
    });
    assert_eq!((again, count), (plain, 0));
}
