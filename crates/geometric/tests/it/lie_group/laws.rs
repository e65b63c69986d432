//! What runs on groups keep, and what they give over other scalars.

use core::ops::ControlFlow;

use piola_geometric::{CommutatorFree, GeneralisedAlpha, MuntheKaas, Rotations, Translations, group_field};
use piola_integrators::{Order, State, Step};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_close_at_scale, difference_quotient};

use super::{Top, reference};

/// |q| − 1, without the rounding of doubles.
fn excess_of_length(q: &[f64]) -> f64 {
    let lit = DoubleDouble::lit;
    let sum = q[..4].iter().fold(lit(-1.0), |sum, &x| sum + lit(x) * lit(x));
    0.5 * sum.primal(0)
}

/// Half an ulp of each component is what the nearest doubles to a unit quaternion may be off by: 2⁻⁵³ of its length together.
const ROUNDED_ONCE: f64 = 0.5 * f64::EPSILON * (1.0 + 1e-9);

#[test]
fn quaternion_has_length_one_to_half_an_ulp_over_a_million_steps() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let mut looks = 0;
    let mut look = |step: Step<'_>| {
        if step.number.is_multiple_of(97) {
            let excess = excess_of_length(step.values);
            assert!(excess.abs() <= ROUNDED_ONCE, "step {}: {excess:e}", step.number);
            looks += 1;
        }
        ControlFlow::Continue(())
    };
    let step = 1.0 / 64.0;
    let mut state = start.clone();
    let steps =
        MuntheKaas::new(Order::Two, step).unwrap().integrate(&mut top, &mut state, 15_625.0, &mut look).unwrap().steps;
    assert_eq!(steps, 1_000_000);
    let mut state = start.clone();
    CommutatorFree::new(step).unwrap().integrate(&mut top, &mut state, 500.0, &mut look).unwrap();
    let mut state = start.clone();
    GeneralisedAlpha::new(0.9, step).unwrap().integrate(&mut top, &mut state, 500.0, &mut look).unwrap();
    assert_eq!(looks, 1_000_000 / 97 + 2 * (32_000 / 97));
}

/// A million steps of one constant spin, whose displacements are exact: what is left is the rounding of one exponential, in each
/// step the same, and none of the products.
#[test]
fn million_turns_about_one_axis_equal_one_turn() {
    let omega = [0.25, 0.5, -1.0];
    let mut spin = group_field(Rotations, |_t, _q: &[f64], velocity: &mut [f64]| velocity.copy_from_slice(&omega));
    let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
    let end = 62_500.0;
    let report = CommutatorFree::new(1.0 / 16.0).unwrap().integrate_to(&mut spin, &mut state, end).unwrap();
    assert_eq!(report.steps, 1_000_000);
    let lit = DoubleDouble::lit;
    let rate = omega.iter().fold(lit(0.0), |sum, &x| sum + lit(x) * lit(x)).sqrt();
    let (s, c) = (rate * lit(0.5 * end)).sin_cos();
    let expected =
        [c, s * lit(omega[0]) / rate, s * lit(omega[1]) / rate, s * lit(omega[2]) / rate].map(|x| x.primal(0));
    let tol = Tol::ulps_because(1.0, "an ulp for each radian of half the angle").times(0.5 * end * rate.primal(0));
    assert_close("spin", &state.values, &expected, tol);
}

#[test]
fn free_motion_does_not_depend_on_where_space_points() {
    // The field of a free top is the same for all attitudes: p q₀ leads to p q(t).
    let (mut top, start, _) = reference("free asymmetric top");
    let turn = |q: &[f64]| {
        let p: [f64; 4] = [0.5, 0.5, -0.5, 0.5];
        vec![
            p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
            p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
            p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
            p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
        ]
    };
    let turned = State::new(0.0, [turn(&start.values), start.values[4..].to_vec()].concat()).unwrap();
    let mut run = |state: &State, method: usize| {
        let mut state = state.clone();
        match method {
            0 => MuntheKaas::new(Order::Four, 0.25).unwrap().integrate_to(&mut top, &mut state, 50.0).unwrap(),
            1 => CommutatorFree::new(0.25).unwrap().integrate_to(&mut top, &mut state, 50.0).unwrap(),
            _ => GeneralisedAlpha::new(0.5, 0.25).unwrap().integrate_to(&mut top, &mut state, 50.0).unwrap(),
        };
        state.values
    };
    for method in 0..3 {
        let (plain, turned) = (run(&start, method), run(&turned, method));
        assert_eq!(plain[4..], turned[4..]);
        assert_close("attitude", &turned[..4], &turn(&plain), Tol::ulps(16.0));
    }
}

#[test]
fn methods_on_vectors_are_the_classical_ones() {
    let mut driven = group_field(Translations(2), |t: f64, y: &[f64], rate: &mut [f64]| {
        rate.copy_from_slice(&[y[1] + 0.5 * t.sin(), -y[0] * y[1] - t]);
    });
    let start = State::new(0.25, vec![0.5, 1.0]).unwrap();
    let (mut one, mut other) = (start.clone(), start);
    MuntheKaas::new(Order::Four, 0.125).unwrap().integrate_to(&mut driven, &mut one, 2.25).unwrap();
    CommutatorFree::new(0.125).unwrap().integrate_to(&mut driven, &mut other, 2.25).unwrap();
    assert_close("Kutta", &one.values, &other.values, Tol::ulps(16.0));
    // Kutta's method once more, as it is written in every book.
    let f = |t: f64, y: [f64; 2]| [y[1] + 0.5 * t.sin(), -y[0] * y[1] - t];
    let (mut t, mut y, h) = (0.25, [0.5, 1.0], 0.125);
    for _ in 0..16 {
        let at = |k: [f64; 2], part: f64| [y[0] + part * h * k[0], y[1] + part * h * k[1]];
        let k1 = f(t, y);
        let k2 = f(t + 0.5 * h, at(k1, 0.5));
        let k3 = f(t + 0.5 * h, at(k2, 0.5));
        let k4 = f(t + h, at(k3, 1.0));
        y = core::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]));
        t += h;
    }
    assert_close("Kutta", &one.values, &y, Tol::ulps(16.0));
}

type Four = Lanes<f64, 4>;

#[test]
fn lanes_get_what_each_gets_alone() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let starts: [Vec<f64>; 4] = core::array::from_fn(|lane| {
        let mut values = start.values.clone();
        values[4] += 0.5 * (lane as f64);
        values
    });
    let together: Vec<Four> = (0..7).map(|i| Four::from(core::array::from_fn(|lane| starts[lane][i]))).collect();
    // Displacements below one radian take no sine: lanes and doubles then do the same operations.
    let mut many = State::new(0.0, together.clone()).unwrap();
    MuntheKaas::new(Order::Six, 0.05).unwrap().integrate_to(&mut top, &mut many, 3.0).unwrap();
    let mut second = State::new(0.0, together.clone()).unwrap();
    CommutatorFree::new(0.05).unwrap().integrate_to(&mut top, &mut second, 3.0).unwrap();
    let mut third = State::new(0.0, together).unwrap();
    GeneralisedAlpha::new(0.5, 0.05).unwrap().integrate_to(&mut top, &mut third, 3.0).unwrap();
    for (lane, start) in starts.iter().enumerate() {
        let lane_of = |state: &State<Four>| state.values.iter().map(|x| x.primal(lane)).collect::<Vec<_>>();
        let mut alone = State::new(0.0, start.clone()).unwrap();
        MuntheKaas::new(Order::Six, 0.05).unwrap().integrate_to(&mut top, &mut alone, 3.0).unwrap();
        assert_eq!(alone.values, lane_of(&many));
        let mut alone = State::new(0.0, start.clone()).unwrap();
        CommutatorFree::new(0.05).unwrap().integrate_to(&mut top, &mut alone, 3.0).unwrap();
        assert_eq!(alone.values, lane_of(&second));
        // Lanes share the number of iterations and the order of pivots.
        let mut alone = State::new(0.0, start.clone()).unwrap();
        GeneralisedAlpha::new(0.5, 0.05).unwrap().integrate_to(&mut top, &mut alone, 3.0).unwrap();
        assert_close("generalised-α", &alone.values, &lane_of(&third), Tol::ulps(64.0));
    }
}

#[test]
fn lanes_on_both_sides_of_one_radian_get_what_each_gets_alone() {
    // A step of 0.5 s turns by 0.5, 1 and 2.5 rad.
    let rates = [1.0, 2.0, 5.0, 1.999];
    let mut spin = group_field(Rotations, |t: f64, q: &[Four], omega: &mut [Four]| {
        let rate = Four::from(rates);
        omega.copy_from_slice(&[rate * q[0], rate * Four::lit(t.cos()), rate]);
    });
    let one = [1.0, 0.0, 0.0, 0.0].map(Four::lit);
    let mut many = State::new(0.0, one.to_vec()).unwrap();
    CommutatorFree::new(0.5).unwrap().integrate_to(&mut spin, &mut many, 4.0).unwrap();
    for (lane, rate) in rates.into_iter().enumerate() {
        let mut spin = group_field(Rotations, |t: f64, q: &[f64], omega: &mut [f64]| {
            omega.copy_from_slice(&[rate * q[0], rate * t.cos(), rate]);
        });
        let mut alone = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
        CommutatorFree::new(0.5).unwrap().integrate_to(&mut spin, &mut alone, 4.0).unwrap();
        let found: Vec<f64> = many.values.iter().map(|x| x.primal(lane)).collect();
        // Sines over lanes are within two ulp of those of doubles.
        assert_close("spin", &found, &alone.values, Tol::ulps(64.0));
    }
}

#[test]
fn generalised_alpha_over_duals_carries_the_derivative_of_the_run() {
    let (top, start, _) = reference("heavy top, asymmetric");
    let run = |spin: &[f64]| {
        let mut state = start.clone();
        state.values[6] = spin[0];
        GeneralisedAlpha::new(0.8, 0.05).unwrap().integrate_to(&mut top.clone(), &mut state, 2.0).unwrap();
        state.values
    };
    let expected = difference_quotient(run, &[2.0], &[1.0]);
    let lifted =
        start.values.iter().enumerate().map(|(i, &y)| if i == 6 { Dual::variable(2.0) } else { Dual::constant(y) });
    let mut state = State::new(0.0, lifted.collect()).unwrap();
    GeneralisedAlpha::new(0.8, 0.05).unwrap().integrate_to(&mut top.clone(), &mut state, 2.0).unwrap();
    let found: Vec<f64> = state.values.iter().map(|x| x.tangent).collect();
    assert_close("derivative", &found, &expected, Tol::stated(1e-9, "differences of values, extrapolated"));
    let values: Vec<f64> = state.values.iter().map(|x| x.value).collect();
    assert_close("value", &values, &run(&[2.0]), Tol::ulps(64.0));
}

#[test]
fn single_precision_runs_stay_unit_in_single_precision() {
    let mut top = Top::new([1.0, 2.0, 3.0], [0.0; 3]);
    let start: Vec<f32> = vec![1.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.75];
    let mut state = State::new(0.0, start.clone()).unwrap();
    MuntheKaas::new(Order::Four, 0.0625).unwrap().integrate_to(&mut top, &mut state, 20.0).unwrap();
    let mut double = State::new(0.0, start.iter().map(|&x| f64::from(x)).collect()).unwrap();
    MuntheKaas::new(Order::Four, 0.0625).unwrap().integrate_to(&mut top, &mut double, 20.0).unwrap();
    let found: Vec<f64> = state.values.iter().map(|&x| f64::from(x)).collect();
    assert_close("single", &found, &double.values, Tol::ulps32(64.0));
    let length: f64 = found[..4].iter().map(|x| x * x).sum::<f64>().sqrt();
    assert_close_at_scale("length", &[length], &[1.0], 1.0, Tol::ulps32(0.51));
    let mut state = State::new(0.0, start).unwrap();
    GeneralisedAlpha::new(0.8, 0.0625).unwrap().integrate_to(&mut top, &mut state, 20.0).unwrap();
    let mut double = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0, 0.5, 0.0, 0.75]).unwrap();
    GeneralisedAlpha::new(0.8, 0.0625).unwrap().integrate_to(&mut top, &mut double, 20.0).unwrap();
    let found: Vec<f64> = state.values.iter().map(|&x| f64::from(x)).collect();
    assert_close("single", &found, &double.values, Tol::ulps32(64.0));
}

#[test]
fn runs_repeat_to_the_last_bit() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let mut kaas = MuntheKaas::new(Order::Eight, 0.1).unwrap();
    let mut free = CommutatorFree::new(0.1).unwrap();
    let mut alpha = GeneralisedAlpha::new(0.9, 0.1).unwrap();
    let mut run = || {
        let [mut a, mut b, mut c] = [start.clone(), start.clone(), start.clone()];
        kaas.integrate_to(&mut top, &mut a, 5.0).unwrap();
        free.integrate_to(&mut top, &mut b, 5.0).unwrap();
        alpha.integrate_to(&mut top, &mut c, 5.0).unwrap();
        [a, b, c]
    };
    // A second run of a method begins afresh.
    assert_eq!(run(), run());
}
