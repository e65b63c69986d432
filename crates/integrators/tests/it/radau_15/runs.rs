//! Runs: dense output, references, steps, rounding, events, refusals.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    Crossing, Ending, Event, EventAction, GaussRadau15, IntegratorsError, SecondOrder, State, Tolerance,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{Tol, allocations_in, assert_close, convergence_order};

use super::by;
use crate::problems::{DoublePendulum, FIGURE_EIGHT, henon_heiles, kepler, kepler_at, kepler_energy, three_bodies};

fn adaptive(tolerance: f64) -> GaussRadau15 {
    GaussRadau15::new(Tolerance::relative(tolerance).unwrap())
}

#[test]
fn dense_output_equals_the_integrals_of_powers_to_degree_seven() {
    for k in 0..=7 {
        let mut state = State::new(0.0, vec![0.25, 0.5]).unwrap();
        let mut field = by(1, |t: f64, _q, _v, a| a[0] = t.powi(k));
        let mut method = GaussRadau15::with_step(1.0).unwrap();
        let run = method.integrate(&mut field, &mut state, 1.0, |step| {
            for t in [0.0, 0.1, 0.5, 0.77, 1.0_f64] {
                let mut y = [0.0; 2];
                step.at(t, &mut y).unwrap();
                let n = f64::from(k);
                let expected =
                    [0.25 + 0.5 * t + t.powi(k + 2) / ((n + 1.0) * (n + 2.0)), 0.5 + t.powi(k + 1) / (n + 1.0)];
                assert_close("dense", &y, &expected, Tol::ulps(8.0));
            }
            assert!(matches!(step.at(1.1, &mut [0.0; 2]), Err(IntegratorsError::OutsideStep { .. })));
            assert!(matches!(step.at(f64::NAN, &mut [0.0; 2]), Err(IntegratorsError::OutsideStep { .. })));
            assert!(matches!(step.at(0.5, &mut [0.0; 3]), Err(IntegratorsError::WrongLength { quantity: "out", .. })));
            ControlFlow::Continue(())
        });
        run.unwrap();
    }
}

#[test]
fn dense_output_equals_closed_form_and_meets_the_steps() {
    for (e, end, tol) in [(0.3, 12.0, 1e-13), (0.9, -12.0, 1e-11)] {
        let mut state = State::new(0.0, kepler_at(e, 0.0).to_vec()).unwrap();
        let mut previous = state.values.clone();
        let run = GaussRadau15::to_rounding().integrate(&mut kepler(), &mut state, end, |step| {
            let mut y = [0.0; 4];
            for part in [0.0, 0.2, 0.5, 0.9, 1.0] {
                let t = step.start() + part * (step.time() - step.start());
                step.at(t, &mut y).unwrap();
                assert_close("dense", &y, &kepler_at(e, t), Tol::stated(tol, "rounding, grown by two revolutions"));
            }
            step.at(step.start(), &mut y).unwrap();
            assert_eq!(&y[..], &previous[..]);
            assert_eq!(&y[..], step.start_values());
            step.at(step.time(), &mut y).unwrap();
            assert_eq!(&y[..], step.values());
            previous.copy_from_slice(step.values());
            ControlFlow::Continue(())
        });
        assert_eq!(run.unwrap().ending, Ending::Reached);
    }
}

fn follow<F: SecondOrder<Error = Infallible>>(name: &str, mut field: F) {
    let golden = golden::load("trajectories");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    let mut state = State::new(0.0, vector(&case["initial_state"])).unwrap();
    let sensitivity = vector(&case["sensitivity"]);
    let mut method = GaussRadau15::to_rounding();
    for (expected, sensitivity) in case["states"].as_array().unwrap().iter().zip(sensitivity) {
        method.integrate_to(&mut field, &mut state, number(&expected["t"])).unwrap();
        let tol = Tol::stated(1e-12, "trajectories").or(Tol::stated(4e-15, "rounding of the input").times(sensitivity));
        assert_close(name, &state.values, &vector(&expected["state"]), tol);
    }
}

#[test]
fn steps_to_rounding_follow_the_references() {
    follow("kepler_e0.3", kepler());
    follow("kepler_e0.9", kepler());
    follow("kepler_e0.99", kepler());
    follow("henon_heiles_E_1_12", henon_heiles());
    follow("figure_eight", three_bodies());
    // From rest.
    let pendulum = |masses, lengths| DoublePendulum { masses, lengths, gravity: 9.8125 };
    follow("double_pendulum_low", pendulum([1.0, 1.0], [1.0, 1.0]));
    follow("double_pendulum_high", pendulum([1.0, 2.0], [1.0, 0.5]));
}

/// Distance from Kepler's motion in closed form, in semi-major axes, at a time; started half a revolution from the pericentre,
/// where the state has no small numbers whose rounding the pericentre enlarges.
fn kepler_error(method: &mut GaussRadau15, e: f64, revolutions: f64) -> f64 {
    let half = core::f64::consts::PI;
    // At the apocentre the state is exact but for the speed, rounded once.
    let speed = ((1.0 - e) / (1.0 + e)).sqrt();
    let mut state = State::new(0.0, vec![-1.0 - e, 0.0, 0.0, -speed]).unwrap();
    let end = revolutions * 2.0 * half;
    method.integrate_to(&mut kepler(), &mut state, end).unwrap();
    (state.values[0] + 1.0 + e).hypot(state.values[1])
}

#[test]
fn kepler_orbits_of_any_eccentricity_close_to_rounding() {
    // Ten revolutions; measured are a third of these bounds or less. The rounding of the speed at the apocentre alone moves
    // the end by 3·2π·10·(1 − e)/2 roundings.
    for (e, bound) in [(0.0, 1e-13), (0.3, 1e-13), (0.9, 1e-12), (0.99, 1e-11), (0.999, 1e-10)] {
        let error = kepler_error(&mut GaussRadau15::to_rounding(), e, 10.0);
        assert!(error < bound, "e = {e}: {error:e}");
    }
}

#[test]
fn errors_follow_the_tolerance() {
    for (e, tolerance) in [0.0, 0.5].into_iter().flat_map(|e| [1e-4, 1e-6, 1e-8, 1e-10, 1e-12].map(|tol| (e, tol))) {
        let mut state = State::new(0.0, kepler_at(e, 0.0).to_vec()).unwrap();
        let report = adaptive(tolerance).integrate_to(&mut kepler(), &mut state, 20.0).unwrap();
        assert!(report.steps < 250, "{report:?}");
        let tol = Tol::stated(2.0 * tolerance, "three revolutions");
        assert_close("tolerance", &state.values, &kepler_at(e, 20.0), tol);
    }
}

#[test]
fn smaller_epsilons_take_shorter_steps() {
    // h ∝ ε^(1/7).
    let epsilons = [1e-5, 1e-7, 1e-9];
    let steps = epsilons.map(|epsilon| {
        let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let mut method = GaussRadau15::with_epsilon(epsilon).unwrap();
        method.integrate_to(&mut kepler(), &mut state, 100.0).unwrap().steps as f64
    });
    let order = convergence_order(&epsilons, &steps);
    assert!((order + 1.0 / 7.0).abs() < 0.01, "{order}: {steps:?}");
}

#[test]
fn oscillators_turn_to_rounding() {
    // A coordinate whose acceleration passes through zero, twice in a period, and damped: a hundred radians.
    for beta in [0.0, 0.05_f64] {
        let rate = (1.0 - beta * beta).sqrt();
        let mut field = by(1, |_t: f64, q, v, a| a[0] = -q[0] - 2.0 * beta * v[0]);
        let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
        let report = GaussRadau15::to_rounding().integrate_to(&mut field, &mut state, 100.0).unwrap();
        assert!(report.steps < 700, "{report:?}");
        let (sine, cosine) = (rate * 100.0).sin_cos();
        let fall = (-beta * 100.0).exp();
        let expected = [fall * (cosine + beta / rate * sine), -fall * sine / rate];
        assert_close("oscillator", &state.values, &expected, Tol::stated(2e-14, "rounding of 640 steps"));
    }
}

#[test]
fn charge_in_crossed_fields_drifts_in_a_cycloid() {
    // q̈ = E + q̇ × B, from rest, with E along 2 and B along 3: a cycloid along 1.
    let mut field = by(2, |_t: f64, _q, v, a| (a[0], a[1]) = (v[1], 1.0 - v[0]));
    let mut state = State::new(0.0, vec![0.0; 4]).unwrap();
    GaussRadau15::to_rounding().integrate_to(&mut field, &mut state, 50.0).unwrap();
    let (sine, cosine) = 50.0_f64.sin_cos();
    let expected = [50.0 - sine, 1.0 - cosine, 1.0 - cosine, sine];
    assert_close("cycloid", &state.values, &expected, Tol::stated(1e-14, "rounding of 300 steps"));
}

/// A run over lanes follows eight orbits, each of its own size and eccentricity, with common steps.
#[test]
fn energy_error_of_ten_thousand_revolutions_walks_at_random() {
    type Orbits = Lanes<f64, 8>;
    let orbit = |i: u32| (0.01 + 0.004 * f64::from(i), 1.0 + 0.0037 * f64::from(i));
    let each = |value: &dyn Fn(f64, f64) -> f64| {
        Lanes(core::array::from_fn(|i| {
            let (e, a) = orbit(u32::try_from(i).unwrap());
            value(e, a)
        }))
    };
    let start: Vec<Orbits> = vec![
        each(&|e, a| a * (1.0 - e)),
        Lanes::splat(0.0),
        Lanes::splat(0.0),
        each(&|e, a| ((1.0 + e) / ((1.0 - e) * a)).sqrt()),
    ];
    let energies = |values: &[Orbits]| -> [f64; 8] {
        core::array::from_fn(|lane| kepler_energy(&core::array::from_fn::<f64, 4, _>(|k| values[k].0[lane])))
    };
    let before = energies(&start);
    let mut state = State::new(0.0, start).unwrap();
    let mut method = GaussRadau15::to_rounding();
    let revolutions = [10.0, 40.0, 160.0, 640.0, 2560.0, 10240.0];
    let mut steps = 0;
    let spread = revolutions.map(|n| {
        // Not at a pericentre of all.
        steps += method.integrate_to(&mut kepler(), &mut state, (n + 0.3) * core::f64::consts::TAU).unwrap().steps;
        let errors: Vec<f64> = energies(&state.values).iter().zip(before).map(|(now, then)| now / then - 1.0).collect();
        let mean_square = errors.iter().map(|x| x * x).sum::<f64>() / 8.0;
        (mean_square.sqrt(), errors.iter().sum::<f64>() / 8.0, steps)
    });
    let (last, mean, steps) = spread[5];
    // At random: half a rounding in a step, of which there are `steps`. All at once would be 4e-11.
    let bound = 0.5 * 0.5 * f64::EPSILON * (steps as f64).sqrt();
    assert!(last < bound, "{last:e} after {steps} steps, above {bound:e}: {spread:?}");
    // No drift common to all: the mean of eight is within three deviations of a mean, estimated from their differences.
    let deviation = ((last * last - mean * mean) * 8.0 / 7.0).sqrt();
    assert!(mean.abs() < 3.0 * deviation / 8.0_f64.sqrt(), "{spread:?}");
    // √t has the slope ½ and a drift 1; six spreads of eight orbits are known to some 0.1.
    let slope = convergence_order(&revolutions[1..], &spread.map(|(spread, ..)| spread)[1..]);
    assert!((0.2..0.8).contains(&slope), "slope {slope}: {spread:?}");
}

#[test]
fn symmetric_starts_stay_symmetric() {
    // Two equal bodies fall past a third between them, from rest, mirrored in the origin.
    let mut state = State::new(0.0, vec![1.0, 0.5, -1.0, -0.5, 0.0, 0.0, 0.0, 0.4, 0.0, -0.4, 0.0, 0.0]).unwrap();
    GaussRadau15::to_rounding().integrate_to(&mut three_bodies(), &mut state, 3.0).unwrap();
    let y = &state.values;
    assert_close("mirror", &[y[0], y[1], y[6], y[7]], &[-y[2], -y[3], -y[8], -y[9]], Tol::ulps(64.0));
    assert_close("centre", &[1.0 + y[4], 1.0 + y[5]], &[1.0, 1.0], Tol::ulps(64.0));
}

#[test]
fn steps_that_come_upon_a_peak_are_made_again() {
    // A peak of width w at t = 5 after a quiet start: q̈ = w²/(w² + (t − 5)²).
    let w = 1e-3;
    let mut peak = by(1, |t: f64, _q, _v, a| a[0] = w * w / (w * w + (t - 5.0) * (t - 5.0)));
    let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
    let report = adaptive(1e-12).integrate_to(&mut peak, &mut state, 10.0).unwrap();
    assert!(0 < report.rejected && report.rejected < 20 && report.steps < 200, "{report:?}");
    let velocity = 2.0 * w * (5.0 / w).atan();
    assert_close("peak", &state.values[1..], &[velocity], Tol::stated(1e-12, "the tolerance"));
}

#[test]
fn same_run_gives_the_same_bits() {
    let run = |method: &mut GaussRadau15| {
        let mut state = State::new(0.0, FIGURE_EIGHT.to_vec()).unwrap();
        let report = method.integrate_to(&mut three_bodies(), &mut state, 20.0).unwrap();
        (report, state)
    };
    let mut method = GaussRadau15::default();
    let first = run(&mut method);
    // Again by the same method, whose memory holds the first run, and by a new one.
    assert_eq!(run(&mut method), first);
    assert_eq!(run(&mut GaussRadau15::to_rounding()), first);
}

#[test]
fn derivatives_of_a_run_equal_those_of_the_closed_form() {
    // Of an oscillator, with respect to its first velocity.
    for mut method in [GaussRadau15::to_rounding(), GaussRadau15::with_step(0.25).unwrap()] {
        let start = vec![Dual::lit(1.0), Dual::variable(0.0)];
        let mut state = State::new(0.0, start).unwrap();
        let mut field = by(1, |_t: Dual<f64>, q, _v, a| a[0] = -q[0]);
        method.integrate_to(&mut field, &mut state, 10.0).unwrap();
        let (sine, cosine) = 10.0_f64.sin_cos();
        let tangents = [state.values[0].tangent, state.values[1].tangent];
        assert_close("tangents", &tangents, &[sine, cosine], Tol::stated(1e-14, "rounding of 64 steps"));
    }
}

#[test]
fn single_precision_ends_within_its_rounding() {
    let start = kepler_at(0.3, 0.0).map(f32::lit).to_vec();
    let mut state = State::new(0.0, start).unwrap();
    let report = GaussRadau15::to_rounding().integrate_to(&mut kepler(), &mut state, 10.0).unwrap();
    assert!(report.steps < 100, "{report:?}");
    let values: Vec<f64> = state.values.iter().map(|&x| f64::from(x)).collect();
    assert_close("single", &values, &kepler_at(0.3, 10.0), Tol::stated(1e-5, "some hundred roundings of 6e-8"));
}

#[test]
fn second_run_with_dense_output_allocates_nothing() {
    let mut state = State::new(0.0, kepler_at(0.5, 0.0).to_vec()).unwrap();
    let mut method = adaptive(1e-9);
    method.integrate_to(&mut kepler(), &mut state, 1.0).unwrap();
    let (count, _) = allocations_in(|| {
        let dense = |step: &piola_integrators::GaussRadauStep<'_>| {
            step.at(0.5 * (step.start() + step.time()), &mut [0.0; 4]).unwrap();
            ControlFlow::Continue(())
        };
        method.integrate(&mut kepler(), &mut state, 10.0, dense).unwrap()
    });
    assert_eq!(count, 0, "a second run allocates nothing");
}

#[test]
fn steps_are_no_longer_than_the_longest() {
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let mut method = GaussRadau15::to_rounding().with_longest_step(1.0 / 64.0).unwrap();
    let run = method.integrate(&mut kepler(), &mut state, 4.0, |step| {
        assert!(step.time() - step.start() <= 1.0 / 64.0 + f64::EPSILON);
        ControlFlow::Continue(())
    });
    assert!(256 <= run.unwrap().steps);
}

#[test]
fn run_begins_with_the_first_step_given() {
    let first = |method: &mut GaussRadau15| {
        let mut end = None;
        let mut state = State::new(1.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
        let run = method.integrate(&mut kepler(), &mut state, -3.0, |step| {
            end.get_or_insert(step.start() - step.time());
            ControlFlow::Continue(())
        });
        (end.unwrap(), run.unwrap())
    };
    let (estimated, run) = first(&mut GaussRadau15::to_rounding());
    let given = 0.75 * estimated;
    let (found, hasty) = first(&mut GaussRadau15::to_rounding().with_first_step(given).unwrap());
    assert_eq!(found.to_bits(), (1.0 - (1.0 - given)).to_bits());
    assert!(hasty.rejected < run.rejected && hasty.evaluations < run.evaluations, "{hasty:?} and {run:?}");
    // What is too long is made again.
    let (found, _) = first(&mut GaussRadau15::to_rounding().with_first_step(100.0).unwrap());
    assert!(found < 2.0 * estimated, "{found} and {estimated}");
}

#[test]
fn events_stand_where_the_motion_crosses() {
    // The node y = 0 of an ellipse is passed at its pericentre, whose times are the revolutions.
    let mut state = State::new(0.0, kepler_at(0.6, 1.0).to_vec()).unwrap();
    state.time = 1.0;
    let start = state.clone();
    let mut times = Vec::new();
    let mut pericentre = [Event::new(Crossing::Rising, EventAction::Report, |_t, y| y[1])];
    let mut steps = 0;
    let report = GaussRadau15::to_rounding()
        .integrate_with_events(
            &mut kepler(),
            &mut state,
            25.0,
            &mut pericentre,
            |crossing| {
                times.push(crossing.time);
                ControlFlow::Continue(())
            },
            |_step| {
                steps += 1;
                ControlFlow::Continue(())
            },
        )
        .unwrap();
    assert_eq!((report.ending, report.steps), (Ending::Reached, steps));
    let expected = [1.0, 2.0, 3.0].map(|n| n * core::f64::consts::TAU);
    assert_close("pericentres", &times, &expected, Tol::stated(1e-13, "dense output of order ten, rounding"));

    let mut state = start;
    let mut apocentre = [Event::new(Crossing::Falling, EventAction::Stop, |_t, y| y[1])];
    let report = GaussRadau15::to_rounding()
        .integrate_with_events(
            &mut kepler(),
            &mut state,
            25.0,
            &mut apocentre,
            |_crossing| ControlFlow::Continue(()),
            |_step| ControlFlow::Continue(()),
        )
        .unwrap();
    assert_eq!(report.ending, Ending::Event(0));
    assert_close("apocentre", &[state.time], &[core::f64::consts::PI], Tol::stated(1e-14, "dense output, rounding"));
    assert_close("state", &state.values, &[-1.6, 0.0, 0.0, -0.5], Tol::stated(1e-14, "dense output, rounding"));
    let mut undefined = [Event::new(Crossing::Either, EventAction::Stop, |t, _y| if t < 4.0 { 1.0 } else { f64::NAN })];
    let error = GaussRadau15::to_rounding()
        .integrate_with_events(
            &mut kepler(),
            &mut state,
            25.0,
            &mut undefined,
            |_crossing| ControlFlow::Continue(()),
            |_step| ControlFlow::Continue(()),
        )
        .unwrap_err();
    assert!(matches!(error, IntegratorsError::InvalidEvent { event: 0, .. }), "{error:?}");
}

#[test]
fn longest_steps_and_epsilons_out_of_range_are_refused_by_name() {
    let unbounded = GaussRadau15::<f64>::to_rounding();
    assert!(matches!(unbounded.with_longest_step(f64::NAN), Err(IntegratorsError::InvalidStep { .. })));
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = GaussRadau15::<f64>::to_rounding().with_first_step(step);
        assert!(matches!(refused, Err(IntegratorsError::InvalidStep { .. })), "{step}");
    }
    for epsilon in [0.0, -1e-9, 1.0, f64::NAN] {
        let refused = GaussRadau15::<f64>::with_epsilon(epsilon);
        assert!(matches!(refused, Err(IntegratorsError::InvalidTolerance { .. })), "{epsilon}");
    }
}

#[test]
fn rates_that_are_not_finite_are_refused_by_name() {
    for value in [f64::NAN, f64::INFINITY] {
        for mut method in [GaussRadau15::to_rounding(), GaussRadau15::with_step(0.125).unwrap()] {
            // From the start, and from t = 1 on.
            for from in [0.0, 1.0] {
                let mut field = by(2, |t: f64, _q, _v, a| {
                    a[0] = 1.0;
                    a[1] = if from <= t { value } else { 0.0 };
                });
                let mut state = State::new(0.0, vec![0.0; 4]).unwrap();
                let error = method.integrate_to(&mut field, &mut state, 2.0).unwrap_err();
                let named = matches!(error, IntegratorsError::NotFinite { quantity: "rate", index: 1, t: Some(_), .. });
                assert!(named, "{error:?}");
                assert!(state.values.iter().all(|x| x.is_finite()) && state.time <= from + 1e-9, "{state:?}");
            }
        }
    }
}

/// A pair at distance one from the origin whose separation is far below that: the rounding of positions alone makes a last
/// coefficient above 10⁻⁹. The pair goes around ten times; what is known of its separation is what positions tell of it.
#[test]
fn close_pairs_far_from_the_origin_are_followed_to_the_rounding_of_their_positions() {
    for separation in [1e-3, 1e-4, 1e-5, 1e-6] {
        let mut pair = by(4, |_t: f64, q: &[f64], _v: &[f64], a: &mut [f64]| {
            let d = [q[2] - q[0], q[3] - q[1]];
            let square = d[0] * d[0] + d[1] * d[1];
            let factor = 0.5 / (square * square.sqrt());
            a.copy_from_slice(&[d[0] * factor, d[1] * factor, -d[0] * factor, -d[1] * factor]);
        });
        // Masses of one half on circles about (1, 1).
        let speed = 0.5 * (1.0_f64 / separation).sqrt();
        let half = 0.5 * separation;
        let mut state = State::new(0.0, vec![1.0 - half, 1.0, 1.0 + half, 1.0, 0.0, -speed, 0.0, speed]).unwrap();
        let period = core::f64::consts::TAU * separation.powf(1.5);
        let mut method = GaussRadau15::to_rounding().with_most_steps(2_000);
        method.integrate_to(&mut pair, &mut state, 10.0 * period).unwrap();
        let distance = (state.values[2] - state.values[0]).hypot(state.values[3] - state.values[1]);
        assert!((distance / separation - 1.0).abs() < 2e-14 / separation, "{separation:e}: {distance:e}");
    }
}
