//! Dense output: exact at the ends of steps, smooth across them, refused outside.

use core::ops::ControlFlow;

use piola_integrators::{DormandPrince853, IntegratorsError, State, Tolerance, field};
use piola_testkit::{Tol, assert_close};

use crate::problems::{kepler, kepler_at};

fn method(tolerance: f64) -> DormandPrince853 {
    DormandPrince853::new(Tolerance::relative(tolerance).unwrap())
}

#[test]
fn dense_output_at_step_ends_equals_the_steps() {
    for end in [10.0, -10.0] {
        let mut state = State::new(0.0, kepler_at(0.9, 0.0).to_vec()).unwrap();
        let mut previous: Option<Vec<f64>> = None;
        method(1e-9)
            .integrate(&mut kepler(), &mut state, end, |step| {
                let mut y = [0.0; 4];
                step.at(step.start(), &mut y).unwrap();
                assert_eq!(&y[..], step.start_values());
                if let Some(previous) = &previous {
                    assert_eq!(&y[..], &previous[..]);
                }
                step.at(step.time(), &mut y).unwrap();
                assert_eq!(&y[..], step.values());
                previous = Some(y.to_vec());
                ControlFlow::Continue(())
            })
            .unwrap();
    }
}

#[test]
fn dense_output_near_step_ends_tends_to_the_steps() {
    let mut state = State::new(0.0, kepler_at(0.5, 0.0).to_vec()).unwrap();
    method(1e-9)
        .integrate(&mut kepler(), &mut state, 10.0, |step| {
            let mut y = [0.0; 4];
            let nearly = step.time() - 1e-13 * (step.time() - step.start());
            step.at(nearly, &mut y).unwrap();
            assert_close("end", &y, step.values(), Tol::stated(1e-12, "a rate of order one over 1e-13 of a step"));
            ControlFlow::Continue(())
        })
        .unwrap();
}

#[test]
fn dense_output_equals_closed_form_at_prescribed_times() {
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let mut next = 0_u32;
    method(1e-12)
        .integrate(&mut kepler(), &mut state, 12.0, |step| {
            while step.contains(f64::from(next) / 64.0) {
                let t = f64::from(next) / 64.0;
                let mut y = [0.0; 4];
                step.at(t, &mut y).unwrap();
                let tol = Tol::stated(1e-9, "order seven within steps made for 1e-12 at order eight");
                assert_close("dense", &y, &kepler_at(0.3, t), tol);
                next += 1;
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    assert_eq!(next, 12 * 64 + 1);
}

#[test]
fn dense_output_outside_the_step_is_refused() {
    let mut decay = field(1, |_t, y: &[f64], rate: &mut [f64]| rate[0] = -y[0]);
    let mut state = State::new(0.0, vec![1.0]).unwrap();
    method(1e-9)
        .integrate(&mut decay, &mut state, 2.0, |step| {
            let mut y = [7.0];
            for time in [step.time().next_up(), step.start().next_down(), f64::NAN, f64::INFINITY] {
                assert!(matches!(step.at(time, &mut y), Err(IntegratorsError::OutsideStep { .. })));
            }
            let expected = IntegratorsError::WrongLength { quantity: "out", expected: 1, found: 2 };
            assert_eq!(step.at(step.time(), &mut [0.0; 2]), Err(expected));
            assert_eq!(y.map(f64::to_bits), [7.0_f64.to_bits()]);
            ControlFlow::Continue(())
        })
        .unwrap();
}

#[test]
fn steps_not_asked_cost_nothing_and_asked_ones_three_evaluations() {
    let run = |ask: bool| {
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let report = method(1e-9).integrate(&mut kepler(), &mut state, 10.0, |step| {
            if ask {
                let mut y = [0.0; 4];
                for part in [0.25, 0.5, 0.75] {
                    step.at(step.start() + part * (step.time() - step.start()), &mut y).unwrap();
                }
            }
            ControlFlow::Continue(())
        });
        (report.unwrap(), state)
    };
    let ((plain, plain_state), (asked, asked_state)) = (run(false), run(true));
    assert_eq!(asked.evaluations, plain.evaluations + 3 * plain.steps);
    assert_eq!(plain_state, asked_state);
}
