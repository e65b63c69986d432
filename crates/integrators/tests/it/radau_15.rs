//! Collocation at Radau's nodes: its coefficients, its order, its steps, its refusals.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    Crossing, Ending, Event, EventAction, GaussRadau15, IntegratorsError, Report, SecondOrder, State, Tolerance,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::golden::{self, number, text, vector};
use piola_testkit::{DoubleDouble, Tol, allocations_in, assert_close, assert_order, convergence_order};

use crate::problems::{DoublePendulum, FIGURE_EIGHT, henon_heiles, kepler, kepler_at, kepler_energy, three_bodies};

fn adaptive(tolerance: f64) -> GaussRadau15 {
    GaussRadau15::new(Tolerance::relative(tolerance).unwrap())
}

fn wide(x: f64) -> DoubleDouble {
    DoubleDouble::lit(x)
}

/// q̈ = f(t, q, q̇) by a function, in one scalar.
struct By<F>(usize, F);
impl<T: Real, F: FnMut(T, &[T], &[T], &mut [T])> SecondOrder<T> for By<F> {
    type Error = Infallible;
    fn freedom(&self) -> usize {
        self.0
    }
    fn acceleration(&mut self, t: T, q: &[T], v: &[T], acceleration: &mut [T]) -> Result<(), Infallible> {
        (self.1)(t, q, v, acceleration);
        Ok(())
    }
}

fn by<T: Real, F: FnMut(T, &[T], &[T], &mut [T])>(freedom: usize, function: F) -> By<F> {
    By(freedom, function)
}

/// The state after one step of length one.
fn one_step<T: Real, F: FnMut(T, &[T], &[T], &mut [T])>(start: Vec<T>, function: F) -> Vec<T> {
    let mut state = State::new(0.0, start).unwrap();
    let mut field = by(1, function);
    GaussRadau15::with_step(1.0).unwrap().integrate_to(&mut field, &mut state, 1.0).unwrap();
    state.values
}

/// The times at which a step of length one evaluates the field: the start, and the nodes of the first sweep.
fn nodes<T: Real>() -> Vec<T> {
    let mut times = Vec::new();
    one_step(vec![T::zero(); 2], |t, _q, _v, a: &mut [T]| {
        times.push(t);
        a[0] = T::zero();
    });
    assert_eq!(times.len(), 8, "one sweep shows that nothing accelerates");
    times
}

#[test]
fn nodes_equal_the_zeros_of_legendre_seven_plus_eight() {
    let found = nodes::<DoubleDouble>();
    assert_eq!(found[0], wide(0.0));
    for pair in found.windows(2) {
        assert!(pair[0].primal(0) < pair[1].primal(0) && pair[1].primal(0) < 1.0);
    }
    for &c in &found {
        let x = wide(2.0) * c - wide(1.0);
        let (mut before, mut now, mut slope_before, mut slope) = (wide(1.0), x, wide(0.0), wide(1.0));
        for k in 1..8 {
            let (k, next) = (wide(f64::from(k)), wide(f64::from(k + 1)));
            let p = ((k + next) * x * now - k * before) / next;
            let d = ((k + next) * (now + x * slope) - k * slope_before) / next;
            (before, now, slope_before, slope) = (now, p, slope, d);
        }
        let error = ((before + now) / (slope_before + slope)).primal(0).abs();
        assert!(error < 1e-31, "{c:?} is off by {error:e}");
    }
    // Doubles are the nearest ones, to which the tables then belong.
    for (rounded, exact) in nodes::<f64>().iter().zip(found) {
        assert_eq!(rounded.to_bits(), exact.primal(0).to_bits());
    }
}

#[test]
fn one_step_equals_the_integrals_of_powers_to_degree_fourteen() {
    for degree in 0..=15 {
        let [position, velocity] = {
            let n = wide(f64::from(degree));
            let once = wide(1.0) / (n + wide(1.0));
            [once / (n + wide(2.0)), once]
        };
        let errors =
            |values: &[DoubleDouble]| [(values[0] - position).primal(0).abs(), (values[1] - velocity).primal(0).abs()];
        let values = one_step(vec![wide(0.0); 2], |t, _q, _v, a| a[0] = t.powi(degree));
        let [of_position, of_velocity] = errors(&values);
        // Positions are exact to degree thirteen: ∫(1 − t) tᵏ has degree k + 1.
        if degree < 14 {
            assert!(of_position < 1e-30, "degree {degree}: {of_position:e}");
        }
        if degree < 15 {
            assert!(of_velocity < 1e-30, "degree {degree}: {of_velocity:e}");
        } else {
            assert!(1e-10 < of_velocity, "the order is no higher: {of_velocity:e}");
        }
        if degree < 14 {
            let rounded = one_step(vec![0.0; 2], |t: f64, _q, _v, a| a[0] = t.powi(degree));
            let tol = Tol::stated(1e-13, "coefficients up to thousands, of alternating sign");
            assert_close("powers", &rounded, &[position.primal(0), velocity.primal(0)], tol);
        }
    }
}

/// The Padé approximant of degrees eight and seven of eˣ.
fn pade(x: DoubleDouble) -> DoubleDouble {
    let (mut up, mut down) = (wide(0.0), wide(0.0));
    let (mut above, mut below) = (wide(1.0), wide(1.0));
    for k in 0..=8 {
        up += above;
        down += below;
        let k = f64::from(k);
        above = above * x * wide(8.0 - k) / wide((15.0 - k) * (k + 1.0));
        below = -below * x * wide(7.0 - k) / wide((15.0 - k) * (k + 1.0));
    }
    up / down
}

#[test]
fn one_step_of_damping_equals_the_pade_approximant() {
    // Every coefficient takes part, and this approximant belongs to these nodes alone.
    for beta in [0.0625, 0.125, 0.25] {
        let exact = pade(wide(-2.0 * beta));
        let values = one_step(vec![wide(0.0), wide(1.0)], |_t, _q, v, a| a[0] = wide(-2.0 * beta) * v[0]);
        assert!((values[1] - exact).primal(0).abs() < 1e-29, "{:e}", (values[1] - exact).primal(0));
        let position = (wide(1.0) - exact) / wide(2.0 * beta);
        assert!((values[0] - position).primal(0).abs() < 1e-29, "{:e}", (values[0] - position).primal(0));
        let rounded = one_step(vec![0.0, 1.0], |_t, _q, v: &[f64], a| a[0] = -2.0 * beta * v[0]);
        assert_close("damping", &rounded, &[position.primal(0), exact.primal(0)], Tol::ulps(4.0));
    }
}

/// The largest error, over position and velocity, of a circular motion of radius and rate one after 16 units of time.
fn circle_error<F: SecondOrder<DoubleDouble, Error = Infallible>>(field: &mut F, h: f64) -> f64 {
    let start = [1.0, 0.0, 0.0, 1.0].map(wide).to_vec();
    let mut state = State::new(0.0, start).unwrap();
    GaussRadau15::with_step(h).unwrap().integrate_to(field, &mut state, 16.0).unwrap();
    let (sine, cosine) = wide(16.0).sin_cos();
    let exact = [cosine, sine, -sine, cosine];
    state.values.iter().zip(exact).map(|(&x, exact)| (x - exact).primal(0).abs()).fold(0.0, f64::max)
}

#[test]
fn error_falls_with_order_fifteen() {
    // Nearly two decades of steps.
    let steps = [2.0, 1.0, 0.5, 0.25, 0.125];
    let errors = steps.map(|h| circle_error(&mut kepler(), h));
    assert!(1e17 < errors[0] / errors[4], "{errors:?}");
    assert_order("attraction", &steps, &errors, 15.0, 0.3);
    // Charged in a magnetic field: the velocity alone turns it, about the same circle.
    let mut charged = by(2, |_t, _q: &[DoubleDouble], v: &[DoubleDouble], a: &mut [DoubleDouble]| {
        (a[0], a[1]) = (-v[1], v[0]);
    });
    let steps = [1.0, 0.5, 0.25, 0.125];
    let errors = steps.map(|h| circle_error(&mut charged, h));
    assert!(1e13 < errors[0] / errors[3], "{errors:?}");
    assert_order("charge", &steps, &errors, 15.0, 0.3);
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
    // No drift common to all: the mean of eight is within three of its deviations.
    assert!(mean.abs() < 3.0 * last / 8.0_f64.sqrt(), "{spread:?}");
    // √t has the slope ½ and a drift 1; six spreads of eight orbits are known to some 0.1.
    let slope = convergence_order(&revolutions[1..], &spread.map(|(spread, ..)| spread)[1..]);
    assert!((0.2..0.8).contains(&slope), "slope {slope}: {spread:?}");
}

#[test]
fn backward_run_returns_to_the_start() {
    // To the rounding of both runs, which the pericentre enlarges.
    for (e, tol) in [(0.0, 2e-14), (0.7, 2e-13)] {
        let mut state = State::new(0.0, kepler_at(e, 0.0).to_vec()).unwrap();
        let mut method = GaussRadau15::to_rounding();
        method.integrate_to(&mut kepler(), &mut state, 10.0).unwrap();
        method.integrate_to(&mut kepler(), &mut state, 0.0).unwrap();
        assert_close("return", &state.values, &kepler_at(e, 0.0), Tol::stated(tol, "two revolutions, twice"));
    }
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
fn equilibrium_stays_to_the_last_bit_and_rest_is_left() {
    let mut pendulum = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.81 };
    let start = State::new(0.0, vec![0.0; 4]).unwrap();
    let mut state = start.clone();
    GaussRadau15::to_rounding().integrate_to(&mut pendulum, &mut state, 100.0).unwrap();
    assert_eq!(state.values, start.values);
    // From rest at the origin the drive alone moves it.
    let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
    GaussRadau15::to_rounding()
        .integrate_to(&mut by(1, |t: f64, _q, _v, a| a[0] = t * t * t), &mut state, 2.0)
        .unwrap();
    assert_close("drive", &state.values, &[32.0 / 20.0, 4.0], Tol::ulps(16.0));
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
fn runs_of_any_length_allocate_alike() {
    let counts = [1.0, 100.0, 10_000.0].map(|end| {
        let mut state = State::new(0.0, kepler_at(0.5, 0.0).to_vec()).unwrap();
        let mut method = adaptive(1e-9);
        let (count, steps) = allocations_in(|| method.integrate_to(&mut kepler(), &mut state, end).unwrap().steps);
        assert!((steps as f64) < 1.0 + 20.0 * end);
        count
    });
    assert_eq!(counts, [counts[0]; 3]);
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
fn runs_of_zero_length_and_stopped_runs_end_where_they_say() {
    let nothing = Report { steps: 0, rejected: 0, evaluations: 0, ending: Ending::Reached };
    for mut method in [adaptive(1e-9), GaussRadau15::with_step(0.1).unwrap()] {
        let start = State::new(2.0, kepler_at(0.3, 2.0).to_vec()).unwrap();
        let mut state = start.clone();
        assert_eq!(method.integrate_to(&mut kepler(), &mut state, 2.0).unwrap(), nothing);
        assert_eq!(state, start);
        let mut times = Vec::new();
        let report = method
            .integrate(&mut kepler(), &mut state, 10.0, |step| {
                assert_eq!(step.start().to_bits(), times.last().copied().unwrap_or(2.0_f64).to_bits());
                times.push(step.time());
                if step.number() == 3 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            })
            .unwrap();
        assert_eq!((report.steps, report.ending, times.len()), (3, Ending::Stopped, 3));
        assert_eq!(times.last().map(|t| t.to_bits()), Some(state.time.to_bits()));
    }
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let mut method = GaussRadau15::to_rounding().with_longest_step(1.0 / 64.0).unwrap();
    let run = method.integrate(&mut kepler(), &mut state, 4.0, |step| {
        assert!(step.time() - step.start() <= 1.0 / 64.0 + f64::EPSILON);
        ControlFlow::Continue(())
    });
    assert!(256 <= run.unwrap().steps);
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

/// q̈ = 0 before a wall at q = 1, where there is no field, or a root of it that is not a number.
struct Walled {
    refuses: bool,
}
#[derive(Debug, PartialEq, thiserror::Error)]
#[error("there is a wall")]
struct Wall;
impl SecondOrder for Walled {
    type Error = Wall;
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, _t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Wall> {
        acceleration[0] = if self.refuses { 0.0 } else { (1.0 - q[0]).sqrt() * 1e-3 };
        if self.refuses && 1.0 < q[0] { Err(Wall) } else { Ok(()) }
    }
}

#[test]
fn fields_that_end_leave_the_last_good_state() {
    for refuses in [true, false] {
        for mut method in [adaptive(1e-9), GaussRadau15::with_step(0.125).unwrap()] {
            let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
            let mut seen = 0.0;
            let error = method
                .integrate(&mut Walled { refuses }, &mut state, 10.0, |step| {
                    seen = step.time();
                    ControlFlow::Continue(())
                })
                .unwrap_err();
            if refuses {
                assert!(matches!(error, IntegratorsError::Field { source: Wall, .. }), "{error:?}");
            } else {
                // The root has no derivative at the wall: no step comes quite to it.
                let expected = matches!(
                    error,
                    IntegratorsError::NotFinite { quantity: "rate", index: 0, .. }
                        | IntegratorsError::StepTooSmall { .. }
                );
                assert!(expected, "{error:?}");
            }
            assert_eq!(state.time.to_bits(), seen.to_bits());
            assert!(0.8 < state.values[0] && state.values[0] < 1.03, "{state:?}");
        }
    }
}

#[test]
fn collision_ends_with_a_step_too_small_and_stiff_steps_are_refused() {
    // Two bodies that fall onto each other from rest meet after π/(2√2).
    let mut state = State::new(0.0, vec![1.0, 0.0, 0.0, 0.0]).unwrap();
    let error = adaptive(1e-9).integrate_to(&mut kepler(), &mut state, 2.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::StepTooSmall { .. } | IntegratorsError::NotFinite { .. }), "{error:?}");
    let time = core::f64::consts::PI / 8.0_f64.sqrt();
    assert_close(
        "collision",
        &[state.time],
        &[time],
        Tol::stated(1e-6, "tolerance 1e-9 where the error grows as r^(-3/2)"),
    );

    let mut stiff = by(1, |_t: f64, q, _v, a| a[0] = -1e6 * q[0]);
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let error = GaussRadau15::with_step(0.5).unwrap().integrate_to(&mut stiff, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::StagesDiverged { .. }), "{error:?}");
    assert_eq!(state.values, [1.0, 0.0]);
    // The adaptive method shortens its steps instead.
    adaptive(1e-9).integrate_to(&mut stiff, &mut state, 1.0).unwrap();
    assert_close("oscillator", &state.values[..1], &[1e3_f64.cos()], Tol::stated(1e-6, "160 revolutions"));
}

#[test]
fn bad_input_is_refused_by_name() {
    assert!(matches!(GaussRadau15::<f64>::with_step(0.0), Err(IntegratorsError::InvalidStep { .. })));
    assert!(matches!(GaussRadau15::<f64>::with_step(f64::NAN), Err(IntegratorsError::InvalidStep { .. })));
    let unbounded = GaussRadau15::<f64>::to_rounding();
    assert!(matches!(unbounded.with_longest_step(f64::NAN), Err(IntegratorsError::InvalidStep { .. })));
    for epsilon in [0.0, -1e-9, 1.0, f64::NAN] {
        let refused = GaussRadau15::<f64>::with_epsilon(epsilon);
        assert!(matches!(refused, Err(IntegratorsError::InvalidTolerance { .. })), "{epsilon}");
    }
    let mut state = State::new(0.0, vec![1.0; 3]).unwrap();
    let error = adaptive(1e-9).integrate_to(&mut kepler(), &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::WrongLength { quantity: "state", expected: 4, found: 3 }));
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let error = adaptive(1e-9).integrate_to(&mut kepler(), &mut state, f64::NAN).unwrap_err();
    assert!(matches!(error, IntegratorsError::NotFinite { quantity: "end", .. }));
    let error = adaptive(1e-9).with_most_steps(2).integrate_to(&mut kepler(), &mut state, 100.0).unwrap_err();
    assert_eq!(error, IntegratorsError::TooManySteps { t: state.time, steps: 2 });
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
