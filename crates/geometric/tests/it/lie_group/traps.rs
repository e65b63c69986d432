//! Starts from rest, bad input, fields that fail, observers.

use core::ops::ControlFlow;

use piola_geometric::{
    CommutatorFree, DirectProduct, GeneralisedAlpha, GroupField, GroupMotion, LieGroup, MuntheKaas, Rotations,
    Translations, group_field,
};
use piola_integrators::{Ending, IntegratorsError, Order, Report, State, Step};
use piola_numerics::{Lanes, Real};
use piola_testkit::{Tol, assert_close};

use super::{Top, reference};

const ONE: [f64; 4] = [1.0, 0.0, 0.0, 0.0];

#[test]
fn top_falls_from_rest() {
    // A pendulum: from the horizontal, the arm along x, ω₂ = √(2 w/J) at the lowest place, which it passes.
    let mut top = Top::new([1.0, 2.0, 2.0], [3.0, 0.0, 0.0]);
    let start = State::new(0.0, [&ONE[..], &[0.0; 3]].concat()).unwrap();
    for method in 0..3 {
        let mut state = start.clone();
        let end = 4.0;
        match method {
            0 => MuntheKaas::new(Order::Eight, 0.05).unwrap().integrate_to(&mut top, &mut state, end).unwrap(),
            1 => CommutatorFree::new(0.005).unwrap().integrate_to(&mut top, &mut state, end).unwrap(),
            _ => GeneralisedAlpha::newmark(0.005).unwrap().integrate_to(&mut top, &mut state, end).unwrap(),
        };
        let tol =
            [Tol::ulps_because(256.0, "eighty steps"), Tol::stated(1e-8, "order four"), Tol::order(0.005, 2)][method];
        let energy = top.energy(&state.values);
        assert!(energy.abs() <= 3.0 * tol.value(), "{method}: {energy:e}");
        // It swings in the plane.
        let aside: Vec<f64> = [1, 3, 4, 6].iter().map(|&i| state.values[i]).collect();
        assert_eq!(aside, vec![0.0; 4]);
        assert!(0.1 < state.values[2].abs());
    }
}

#[test]
fn rest_stays_to_the_last_bit() {
    // The centre of mass is below the point that is held.
    let mut top = Top::new([1.0, 2.0, 3.0], [0.0, 0.0, -1.0]);
    let start = State::new(0.0, [&ONE[..], &[0.0; 3]].concat()).unwrap();
    let [mut a, mut b, mut c] = [start.clone(), start.clone(), start.clone()];
    MuntheKaas::new(Order::Six, 0.1).unwrap().integrate_to(&mut top, &mut a, 10.0).unwrap();
    CommutatorFree::new(0.1).unwrap().integrate_to(&mut top, &mut b, 10.0).unwrap();
    GeneralisedAlpha::new(0.8, 0.1).unwrap().integrate_to(&mut top, &mut c, 10.0).unwrap();
    for state in [a, b, c] {
        assert_eq!(state.values, start.values);
    }
}

#[test]
fn way_back_leads_to_the_start() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let mut state = start.clone();
    let mut method = MuntheKaas::new(Order::Eight, 0.02).unwrap();
    method.integrate_to(&mut top, &mut state, 5.0).unwrap();
    method.integrate_to(&mut top, &mut state, 0.0).unwrap();
    assert_close("start", &state.values, &start.values, Tol::stated(1e-12, "order eight at step 0.02, there and back"));
    // Newmark's rule is symmetric but for the attitude, where it is of second order.
    let mut method = GeneralisedAlpha::newmark(0.01).unwrap();
    method.integrate_to(&mut top, &mut state, 1.0).unwrap();
    method.integrate_to(&mut top, &mut state, 0.0).unwrap();
    assert_close("start", &state.values, &start.values, Tol::order(0.01, 2));
}

#[test]
fn run_of_zero_length_changes_nothing() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let mut state = start.clone();
    let nothing = Report::begin();
    assert_eq!(MuntheKaas::new(Order::Two, 0.1).unwrap().integrate_to(&mut top, &mut state, 0.0).unwrap(), nothing);
    assert_eq!(CommutatorFree::new(0.1).unwrap().integrate_to(&mut top, &mut state, 0.0).unwrap(), nothing);
    assert_eq!(GeneralisedAlpha::new(0.5, 0.1).unwrap().integrate_to(&mut top, &mut state, 0.0).unwrap(), nothing);
    assert_eq!(state, start);
}

#[test]
fn observers_see_every_step_and_stop_runs() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let mut seen = Vec::new();
    let mut observe = |step: Step<'_>| {
        seen.push((step.number, step.time.to_bits(), step.values.len()));
        if step.number == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let mut state = start.clone();
    let one = MuntheKaas::new(Order::Four, 0.125).unwrap().integrate(&mut top, &mut state, 5.0, &mut observe).unwrap();
    assert_eq!(state.time.to_bits(), 0.375_f64.to_bits());
    let mut state = start.clone();
    let two = CommutatorFree::new(0.125).unwrap().integrate(&mut top, &mut state, 5.0, &mut observe).unwrap();
    let mut state = start.clone();
    let three = GeneralisedAlpha::new(0.5, 0.125).unwrap().integrate(&mut top, &mut state, 5.0, &mut observe).unwrap();
    assert_eq!([one.ending, two.ending, three.ending], [Ending::Stopped; 3]);
    assert_eq!([one.steps, two.steps, three.steps], [3; 3]);
    assert_eq!([one.evaluations, two.evaluations], [12; 2]);
    let expected = [(1, 0.125_f64.to_bits(), 7), (2, 0.25_f64.to_bits(), 7), (3, 0.375_f64.to_bits(), 7)];
    assert_eq!(seen, expected.repeat(3));
}

#[test]
fn bad_input_is_refused_by_name() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(MuntheKaas::<f64>::new(Order::Two, step), Err(IntegratorsError::InvalidStep { .. })));
        assert!(matches!(CommutatorFree::<f64>::new(step), Err(IntegratorsError::InvalidStep { .. })));
    }
    let mut refuse = |state: &State, end: f64| {
        let [mut a, mut b, mut c] = [state.clone(), state.clone(), state.clone()];
        let errors = [
            MuntheKaas::new(Order::Four, 0.1).unwrap().integrate_to(&mut top, &mut a, end).unwrap_err(),
            CommutatorFree::new(0.1).unwrap().integrate_to(&mut top, &mut b, end).unwrap_err(),
            GeneralisedAlpha::new(0.5, 0.1).unwrap().integrate_to(&mut top, &mut c, end).unwrap_err(),
        ];
        assert_eq!(format!("{:?}", errors[0]), format!("{:?}", errors[1]));
        assert_eq!(format!("{:?}", errors[0]), format!("{:?}", errors[2]));
        errors[0].clone()
    };
    let short = State::new(0.0, ONE.to_vec()).unwrap();
    let mismatch = IntegratorsError::WrongLength { quantity: "state", expected: 7, found: 4 };
    assert_eq!(refuse(&short, 1.0), mismatch);
    for end in [f64::NAN, f64::INFINITY] {
        assert!(matches!(refuse(&start, end), IntegratorsError::NotFinite { quantity: "end", .. }));
    }
    let mut broken = start.clone();
    broken.values[5] = f64::NAN;
    assert!(matches!(refuse(&broken, 1.0), IntegratorsError::NotFinite { quantity: "state", index: 5, .. }));
    // A quaternion that is none: twice as long, zero, or off by more than what is taken for rounding.
    for (q, expected) in [([2.0, 0.0, 0.0, 0.0], 1.5), ([0.0; 4], 0.5), ([1.0 + 1e-7, 0.0, 0.0, 0.0], 1e-7)] {
        let mut long = start.clone();
        long.values[..4].copy_from_slice(&q);
        let IntegratorsError::OutsideGroup { index: 0, defect } = refuse(&long, 1.0) else { panic!("{q:?}") };
        assert_close("defect", &[defect], &[expected], Tol::stated(1e-6, "the defect is that to first order"));
    }
    // One that is off by less is normalised by the first step.
    let mut near = start.clone();
    near.values[..4].copy_from_slice(&[1.0 - 1e-9, 0.0, 0.0, 0.0]);
    MuntheKaas::new(Order::Four, 0.1).unwrap().integrate_to(&mut top, &mut near, 0.1).unwrap();
    let length = near.values[..4].iter().map(|x| x * x).sum::<f64>();
    assert_close("length", &[length], &[1.0], Tol::ulps(2.0));
    // The message says where and by how much.
    let error = IntegratorsError::<core::convert::Infallible>::OutsideGroup { index: 4, defect: 0.5 };
    let message = "the state is off its group by 5e-1 from entry 4 on: a quaternion there must have length one";
    assert_eq!(error.to_string(), message);
}

#[test]
fn quaternion_that_is_none_in_one_lane_is_refused() {
    type Two = Lanes<f64, 2>;
    let mut rest = group_field(Rotations, |_t, _q: &[Two], omega: &mut [Two]| omega.fill(Two::lit(0.0)));
    let q = vec![Two::from([1.0, 1.5]), Two::lit(0.0), Two::lit(0.0), Two::lit(0.0)];
    let mut state = State::new(0.0, q).unwrap();
    let error = CommutatorFree::new(0.1).unwrap().integrate_to(&mut rest, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::OutsideGroup { index: 0, defect } if 0.6 < defect), "{error:?}");
}

/// A body that spins about z and moves along x, as a field and as a motion, which is not defined beyond x = 1, or NaN there.
struct Walled {
    group: DirectProduct<Rotations, Translations>,
    fails: bool,
}

#[derive(Debug, PartialEq)]
struct Wall;

impl<T: Real> GroupField<T> for Walled {
    type Error = Wall;
    type Group = DirectProduct<Rotations, Translations>;
    fn group(&self) -> &Self::Group {
        &self.group
    }
    fn velocity(&mut self, _t: f64, y: &[T], velocity: &mut [T]) -> Result<(), Wall> {
        velocity.fill(T::zero());
        velocity[2] = T::one();
        velocity[3] = T::one();
        if y[4].primal(0) <= 1.0 {
            return Ok(());
        }
        velocity[3] = T::lit(f64::NAN);
        if self.fails { Err(Wall) } else { Ok(()) }
    }
}

impl<T: Real> GroupMotion<T> for Walled {
    type Error = Wall;
    type Group = DirectProduct<Rotations, Translations>;
    fn group(&self) -> &Self::Group {
        &self.group
    }
    fn residual(&mut self, _t: f64, y: &[T], _v: &[T], rate: &[T], residual: &mut [T]) -> Result<(), Wall> {
        residual.copy_from_slice(rate);
        if y[4].primal(0) <= 1.0 {
            return Ok(());
        }
        residual[3] = T::lit(f64::NAN);
        if self.fails { Err(Wall) } else { Ok(()) }
    }
}

#[test]
fn run_that_fails_leaves_the_last_good_state() {
    for fails in [true, false] {
        let group = DirectProduct(Rotations, Translations(1));
        assert_eq!(LieGroup::<f64>::element_length(&group), 5);
        let mut walled = Walled { group, fails };
        let start = State::new(0.0, [&ONE[..], &[0.0]].concat()).unwrap();
        let moving = State::new(0.0, [&ONE[..], &[0.0], &[0.0, 0.0, 1.0, 1.0]].concat()).unwrap();
        let [mut a, mut b, mut c] = [start.clone(), start, moving];
        let errors = [
            MuntheKaas::new(Order::Six, 0.15).unwrap().integrate_to(&mut walled, &mut a, 3.0).unwrap_err(),
            CommutatorFree::new(0.15).unwrap().integrate_to(&mut walled, &mut b, 3.0).unwrap_err(),
            GeneralisedAlpha::new(0.8, 0.15).unwrap().integrate_to(&mut walled, &mut c, 3.0).unwrap_err(),
        ];
        for (state, error) in [a, b, c].iter().zip(errors) {
            // The sixth step ends at 0.9, the seventh leads beyond the wall.
            if fails {
                assert!(matches!(error, IntegratorsError::Field { source: Wall, t } if 1.0 < t), "{error:?}");
            } else {
                assert!(
                    matches!(
                        error,
                        IntegratorsError::NotFinite { quantity: "rate" | "residual", index: 3, t: Some(_), .. }
                    ),
                    "{error:?}"
                );
            }
            let (s, c) = 0.45_f64.sin_cos();
            assert_close("last good state", &state.values[..5], &[c, 0.0, 0.0, s, 0.9], Tol::ulps(4.0));
            assert_close("its time", &[state.time], &[0.9], Tol::ulps(4.0));
        }
    }
}

#[test]
fn steps_beyond_one_turn_are_answered_without_a_number_that_is_none() {
    // At exactly one turn the differential of the exponential cannot be inverted; the commutator-free method does not need it.
    let spin = |_t: f64, _q: &[f64], omega: &mut [f64]| omega.copy_from_slice(&[0.0, 0.0, core::f64::consts::TAU]);
    let mut spin = group_field(Rotations, spin);
    let mut state = State::new(0.0, ONE.to_vec()).unwrap();
    CommutatorFree::new(1.75).unwrap().integrate_to(&mut spin, &mut state, 1.75).unwrap();
    let (s, c) = (1.75 * core::f64::consts::PI).sin_cos();
    assert_close("spin", &state.values, &[c, 0.0, 0.0, s], Tol::ulps(8.0));
    let mut state = State::new(0.0, ONE.to_vec()).unwrap();
    MuntheKaas::new(Order::Four, 1.75).unwrap().integrate_to(&mut spin, &mut state, 1.75).unwrap();
    assert_close("spin", &state.values, &[c, 0.0, 0.0, s], Tol::ulps(8.0));
}
