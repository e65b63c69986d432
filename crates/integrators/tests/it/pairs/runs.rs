//! Runs of the pairs: orders, dense output, events, time and back, exact derivatives, failures.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    Crossing, DormandPrince853, Ending, Event, EventAction, Field, IntegratorsError, Nystrom86, Nystrom1210,
    SecondOrder, State, Tolerance, Verner98, field,
};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_order, convergence_order};

use crate::problems::{henon_heiles, kepler, kepler_at, three_bodies};

const E: f64 = 0.3;

fn error(actual: &[f64], expected: &[f64]) -> f64 {
    actual.iter().zip(expected).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
}

/// A method that takes equal steps: everything is tolerated, and steps may not grow.
macro_rules! equal_steps {
    ($method:ident, $h:expr) => {
        $method::new(Tolerance::new(0.5, 1e9).unwrap()).with_first_step($h).unwrap().with_longest_step($h).unwrap()
    };
}

macro_rules! order_of_nystrom {
    ($method:ident, $steps:expr, $order:expr, $within:expr) => {{
        let steps = $steps.map(|count: u32| 6.0 / f64::from(count));
        let errors = steps.map(|h| {
            let mut state = State::new(0.0, kepler_at(E, 0.0).to_vec()).unwrap();
            let report = equal_steps!($method, h).integrate_to(&mut kepler(), &mut state, 6.0).unwrap();
            assert_eq!(report.rejected, 0);
            error(&state.values, &kepler_at(E, 6.0))
        });
        assert_order(stringify!($method), &steps, &errors, $order, $within);
    }};
}

#[test]
fn nystrom_error_on_kepler_falls_with_order_twelve() {
    // Between errors of 1e-10 and rounding lies a factor of one and a half in the step: no slope is straighter there.
    order_of_nystrom!(Nystrom1210, [16, 18, 20, 24], 12.0, 0.3);
}

/// The same motion as a system of second order.
struct Driven;
impl SecondOrder for Driven {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    fn freedom(&self) -> usize {
        2
    }
    fn acceleration(&mut self, t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Infallible> {
        let (x, z, rate) = (q[0], q[1], q[0] * t.cos());
        acceleration[0] = (t.cos() * t.cos() - t.sin()) * x;
        acceleration[1] = z * z * (2.0 * z * rate * rate - acceleration[0]);
        Ok(())
    }
}

fn moved_at(t: f64) -> [f64; 4] {
    let [x, z] = driven_at(t);
    let rate = x * t.cos();
    [x, z, rate, -z * z * rate]
}

#[test]
fn nystrom_error_of_a_driven_motion_falls_with_order_eight() {
    let steps = [32, 40, 48, 56, 64].map(|count: u32| 6.0 / f64::from(count));
    let errors = steps.map(|h| {
        let mut state = State::new(0.0, moved_at(0.0).to_vec()).unwrap();
        equal_steps!(Nystrom86, h).integrate_to(&mut Driven, &mut state, 6.0).unwrap();
        error(&state.values, &moved_at(6.0))
    });
    assert_order("8(6)", &steps, &errors, 8.0, 0.1);
}

/// x = e^(sin t) and z = 1/(1 + x), of a field that depends on the time.
fn driven() -> impl Field<Error = Infallible> {
    field(2, |t: f64, y: &[f64], rate: &mut [f64]| {
        rate[0] = y[0] * t.cos();
        rate[1] = -y[1] * y[1] * rate[0];
    })
}

fn driven_at(t: f64) -> [f64; 2] {
    let x = t.sin().exp();
    [x, 1.0 / (1.0 + x)]
}

#[test]
fn verner_error_falls_with_order_nine() {
    let steps = [20, 25, 30].map(|count: u32| 5.0 / f64::from(count));
    let errors = steps.map(|h| {
        let mut state = State::new(0.0, driven_at(0.0).to_vec()).unwrap();
        equal_steps!(Verner98, h).integrate_to(&mut driven(), &mut state, 5.0).unwrap();
        error(&state.values, &driven_at(5.0))
    });
    assert_order("9(8)", &steps, &errors, 9.0, 0.1);
}

#[test]
fn verner_dense_output_errs_within_a_step_by_no_less_a_power_than_ten() {
    let steps = [0.5, 0.4, 0.3125, 0.25];
    let errors = steps.map(|h| {
        let mut state = State::new(0.0, driven_at(0.0).to_vec()).unwrap();
        let mut largest = 0.0_f64;
        equal_steps!(Verner98, h)
            .integrate(&mut driven(), &mut state, h, |step| {
                let mut y = [0.0; 2];
                for part in 1..16 {
                    let t = h * f64::from(part) / 16.0;
                    step.at(t, &mut y).unwrap();
                    largest = largest.max(error(&y, &driven_at(t)));
                }
                ControlFlow::Continue(())
            })
            .unwrap();
        largest
    });
    let found = convergence_order(&steps, &errors);
    assert!(10.0 <= found, "{found}: {errors:?}");
}

/// The largest error of a position within one step from an exact start.
macro_rules! dense_errors {
    ($method:ident, $steps:expr) => {
        $steps.map(|h| {
            let mut state = State::new(0.0, moved_at(0.0).to_vec()).unwrap();
            let mut largest = 0.0_f64;
            equal_steps!($method, h)
                .integrate(&mut Driven, &mut state, h, |step| {
                    let mut y = [0.0; 4];
                    for part in 1..16 {
                        let t = h * f64::from(part) / 16.0;
                        step.at(t, &mut y).unwrap();
                        largest = largest.max(error(&y[..2], &moved_at(t)[..2]));
                    }
                    ControlFlow::Continue(())
                })
                .unwrap();
            largest
        })
    };
}

#[test]
fn nystrom_dense_output_errors_of_positions_fall_with_the_orders() {
    let steps = [0.3, 0.25, 0.2, 0.15];
    assert_order("8(6), dense", &steps, &dense_errors!(Nystrom86, steps), 8.0, 0.15);
    let steps = [0.3, 0.25, 0.2, 0.15];
    assert_order("12(10), dense", &steps, &dense_errors!(Nystrom1210, steps), 10.0, 0.1);
}

#[test]
fn dense_output_at_step_ends_equals_the_steps() {
    macro_rules! check {
        ($method:ident) => {
            for end in [10.0, -10.0] {
                let mut state = State::new(0.0, kepler_at(0.9, 0.0).to_vec()).unwrap();
                let mut previous: Option<Vec<f64>> = None;
                $method::new(Tolerance::relative(1e-9).unwrap())
                    .integrate(&mut kepler(), &mut state, end, |step| {
                        let mut y = [0.0; 4];
                        step.at(step.start(), &mut y).unwrap();
                        assert_eq!(&y[..], step.start_values());
                        if let Some(previous) = &previous {
                            assert_eq!(&y[..], &previous[..]);
                        }
                        let nearly = step.time() - 1e-13 * (step.time() - step.start());
                        step.at(nearly, &mut y).unwrap();
                        let tol = Tol::stated(1e-11, "a rate of order ten over 1e-13 of a step");
                        assert_close("near the end", &y, step.values(), tol);
                        step.at(step.time(), &mut y).unwrap();
                        assert_eq!(&y[..], step.values());
                        let beyond = step.time() + 0.1 * (step.time() - step.start());
                        assert!(matches!(step.at(beyond, &mut y), Err(IntegratorsError::OutsideStep { .. })));
                        previous = Some(y.to_vec());
                        ControlFlow::Continue(())
                    })
                    .unwrap();
            }
        };
    }
    check!(Verner98);
    check!(Nystrom86);
    check!(Nystrom1210);
}

#[test]
fn runs_there_and_back_return() {
    macro_rules! check {
        ($method:ident) => {{
            let mut state = State::new(3.0, kepler_at(0.5, 0.0).to_vec()).unwrap();
            let mut method = $method::new(Tolerance::relative(1e-13).unwrap());
            method.integrate_to(&mut kepler(), &mut state, 13.0).unwrap();
            method.integrate_to(&mut kepler(), &mut state, 3.0).unwrap();
            let tol = Tol::stated(2e-11, "tolerances of some forty steps, amplified along ten units of time and back");
            assert_close(stringify!($method), &state.values, &kepler_at(0.5, 0.0), tol);
        }};
    }
    check!(Verner98);
    check!(Nystrom86);
    check!(Nystrom1210);
}

#[test]
fn events_stop_at_the_apocentre() {
    macro_rules! check {
        ($method:ident) => {{
            let mut state = State::new(0.0, kepler_at(0.6, 0.0).to_vec()).unwrap();
            let mut apocentre = [Event::new(Crossing::Falling, EventAction::Stop, |_t, y| y[1])];
            let report = $method::new(Tolerance::relative(1e-13).unwrap())
                .integrate_with_events(
                    &mut kepler(),
                    &mut state,
                    10.0,
                    &mut apocentre,
                    |_| ControlFlow::Continue(()),
                    |_| ControlFlow::Continue(()),
                )
                .unwrap();
            assert_eq!(report.ending, Ending::Event(0));
            let tol = Tol::stated(1e-10, "dense output within steps made for 1e-13 at the end");
            assert_close(stringify!($method), &[state.time, state.values[0]], &[std::f64::consts::PI, -1.6], tol);
        }};
    }
    check!(Verner98);
    check!(Nystrom86);
    check!(Nystrom1210);
}

#[test]
fn a_start_from_rest_and_from_equilibrium_needs_no_help() {
    // At rest in a potential: E = V, and an equilibrium where nothing moves at all.
    let mut state = State::new(0.0, vec![0.0, 0.5, 0.0, 0.0]).unwrap();
    Nystrom1210::new(Tolerance::relative(1e-13).unwrap()).integrate_to(&mut henon_heiles(), &mut state, 30.0).unwrap();
    let [x, y, u, v] = state.values[..] else { panic!("four components") };
    let energy = 0.5 * (u * u + v * v + x * x + y * y) + x * x * y - y * y * y / 3.0;
    let start = 0.5 * 0.25 - 0.125 / 3.0;
    assert_close("energy", &[energy], &[start], Tol::stated(1e-12, "some sixty steps of tolerance 1e-13"));
    assert_eq!((x, u), (0.0, 0.0), "the motion stays on its axis of symmetry");
    let mut state = State::new(0.0, vec![0.0; 4]).unwrap();
    Nystrom86::new(Tolerance::relative(1e-9).unwrap()).integrate_to(&mut henon_heiles(), &mut state, 5.0).unwrap();
    assert_eq!(state.values, [0.0; 4]);
}

#[test]
fn derivatives_of_a_run_equal_differences_of_runs_in_twice_double_precision() {
    let start = kepler_at(E, 0.0);
    let end = 4.0;
    let mut dual = State::new(0.0, start.map(|x| Dual::new(x, 0.0)).to_vec()).unwrap();
    dual.values[3].tangent = 1.0;
    Nystrom1210::new(Tolerance::relative(1e-13).unwrap()).integrate_to(&mut kepler(), &mut dual, end).unwrap();
    let displaced = |by: f64| {
        let mut state = State::new(0.0, start.map(DoubleDouble::lit).to_vec()).unwrap();
        state.values[3] += DoubleDouble::lit(by);
        Nystrom1210::new(Tolerance::relative(1e-14).unwrap()).integrate_to(&mut kepler(), &mut state, end).unwrap();
        state.values
    };
    let by = 1.0 / 65536.0;
    let (plus, minus) = (displaced(by), displaced(-by));
    let differences: Vec<f64> =
        plus.iter().zip(&minus).map(|(&a, &b)| ((a - b) / DoubleDouble::lit(2.0 * by)).primal(0)).collect();
    let found: Vec<f64> = dual.values.iter().map(|x| x.tangent).collect();
    assert_close(
        "derivative",
        &found,
        &differences,
        Tol::stated(1e-6, "central differences err by the square of 2⁻¹⁶ times thousands"),
    );
}

#[test]
fn lanes_of_equal_starts_give_what_each_gives_alone() {
    // Steps are those of the largest lane: only equal lanes take the steps that each would take alone.
    let start = kepler_at(E, 0.0);
    let mut lanes = State::new(0.0, start.map(|x| Lanes([x; 4])).to_vec()).unwrap();
    let mut alone = State::new(0.0, start.to_vec()).unwrap();
    let tolerance = Tolerance::relative(1e-10).unwrap();
    Nystrom86::new(tolerance).integrate_to(&mut kepler(), &mut lanes, 10.0).unwrap();
    Nystrom86::new(tolerance).integrate_to(&mut kepler(), &mut alone, 10.0).unwrap();
    for (lanes, alone) in lanes.values.iter().zip(&alone.values) {
        assert_eq!(lanes.0.map(f64::to_bits), [alone.to_bits(); 4]);
    }
}

/// q̈ = −1/√q where 0 < q: it falls to zero, where it is not defined.
struct Falling;
impl SecondOrder for Falling {
    type Error = &'static str;
    const VELOCITY_DEPENDENT: bool = false;
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, _t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Self::Error> {
        if q[0] <= 0.0 {
            return Err("0 < q");
        }
        acceleration[0] = -q[0].sqrt().recip();
        Ok(())
    }
}

#[test]
fn a_run_that_leaves_the_domain_keeps_its_last_good_state() {
    let mut state = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let (mut last, mut steps) = (state.clone(), 0);
    let run = Nystrom86::new(Tolerance::relative(1e-9).unwrap()).integrate(&mut Falling, &mut state, 10.0, |step| {
        (last.time, last.values) = (step.time(), step.values().to_vec());
        steps += 1;
        ControlFlow::Continue(())
    });
    assert!(matches!(run, Err(IntegratorsError::Field { source: "0 < q", .. })), "{run:?}");
    assert!(3 < steps);
    assert_eq!((state.time, &state.values), (last.time, &last.values));
    // v²/2 = 2(1 − √q): it arrives at −2 after a time of 4/3.
    let tol = Tol::stated(1e-6, "steps shrink with the distance to the singularity");
    assert_close(
        "the end",
        &[state.time, state.values[1]],
        &[4.0 / 3.0, -2.0],
        Tol::stated(1e-3, "the last step before it").or(tol),
    );
}

#[test]
fn bad_input_is_refused_by_name() {
    let mut method = Nystrom86::new(Tolerance::relative(1e-9).unwrap());
    let mut short = State::new(0.0, vec![1.0, 0.0]).unwrap();
    let run = method.integrate_to(&mut kepler(), &mut short, 1.0);
    assert_eq!(run, Err(IntegratorsError::WrongLength { quantity: "state", expected: 4, found: 2 }));
    let mut state = State::new(0.0, kepler_at(E, 0.0).to_vec()).unwrap();
    let run = method.integrate_to(&mut kepler(), &mut state, f64::NAN);
    assert!(matches!(run, Err(IntegratorsError::NotFinite { quantity: "end", .. })));
    // Bodies at the same place.
    let mut together = State::new(0.0, vec![0.0; 12]).unwrap();
    let run =
        Nystrom1210::new(Tolerance::relative(1e-9).unwrap()).integrate_to(&mut three_bodies(), &mut together, 1.0);
    assert!(matches!(run, Err(IntegratorsError::NotFinite { quantity: "rate", .. })));
    let few = Nystrom86::new(Tolerance::relative(1e-9).unwrap()).with_most_steps(3).integrate_to(
        &mut kepler(),
        &mut state,
        100.0,
    );
    assert!(matches!(few, Err(IntegratorsError::TooManySteps { steps: 3, .. })));
    assert!(Nystrom86::<f64>::new(Tolerance::relative(1e-9).unwrap()).with_first_step(0.0).is_err());
}

/// q̈ = −q̇, or without damping: decided when it is made.
struct Damped(bool);
impl SecondOrder for Damped {
    type Error = Infallible;
    fn is_velocity_dependent(&self) -> bool {
        self.0
    }
    fn freedom(&self) -> usize {
        1
    }
    fn acceleration(&mut self, _t: f64, _q: &[f64], v: &[f64], acceleration: &mut [f64]) -> Result<(), Infallible> {
        acceleration[0] = if self.0 { -v[0] } else { 0.0 };
        Ok(())
    }
}

#[test]
fn accelerations_that_depend_on_velocities_are_refused() {
    let mut state = State::new(0.0, vec![0.0, 1.0]).unwrap();
    let mut method = Nystrom86::new(Tolerance::relative(1e-9).unwrap());
    assert_eq!(method.integrate_to(&mut Damped(true), &mut state, 1.0), Err(IntegratorsError::VelocityDependent));
    assert_eq!(state.time.to_bits(), 0.0_f64.to_bits());
    method.integrate_to(&mut Damped(false), &mut state, 1.0).unwrap();
    assert_close("uniform", &state.values, &[1.0, 1.0], Tol::ulps(4.0));
}

/// What rounding alone exceeds is raised, by name, and costs nothing.
#[test]
fn tolerances_below_rounding_are_raised_to_two_units_in_the_last_place() {
    let least = 2.0 * f64::EPSILON;
    let tolerance = |relative: f64| Tolerance::relative(relative).unwrap();
    macro_rules! check {
        ($Method:ident) => {{
            let run = |tolerance| {
                let mut state = State::new(0.0, kepler_at(0.6, 0.0).to_vec()).unwrap();
                let report = $Method::new(tolerance).integrate_to(&mut kepler(), &mut state, 20.0).unwrap();
                (report, state)
            };
            assert_eq!($Method::<f64>::new(tolerance(1e-20)).tolerance(), tolerance(least));
            assert_eq!($Method::<f64>::new(tolerance(1e-15)).tolerance(), tolerance(1e-15));
            assert_eq!(run(tolerance(1e-20)), run(tolerance(least)));
            assert!(run(tolerance(1e-300)).0.steps < 2 * run(tolerance(1e-14)).0.steps);
        }};
    }
    check!(DormandPrince853);
    check!(Verner98);
    check!(Nystrom86);
    check!(Nystrom1210);
    assert!(
        (DormandPrince853::<f32>::new(tolerance(1e-9)).tolerance().relative_part() - 2.0 * f64::from(f32::EPSILON))
            .abs()
            <= 0.0
    );
}

/// Two oscillators that know nothing of each other, of 10⁶ m and of 1 m.
#[derive(Clone, Copy)]
struct LargeAndSmall<const OWN: bool>;

impl<const OWN: bool> SecondOrder for LargeAndSmall<OWN> {
    type Error = Infallible;
    const VELOCITY_DEPENDENT: bool = false;
    const OWN_MAGNITUDES: bool = OWN;
    fn freedom(&self) -> usize {
        2
    }
    fn acceleration(&mut self, _t: f64, q: &[f64], _v: &[f64], acceleration: &mut [f64]) -> Result<(), Infallible> {
        acceleration.copy_from_slice(&[-q[0], -4.0 * q[1]]);
        Ok(())
    }
    fn magnitudes(&self, state: &[f64], magnitudes: &mut [f64]) {
        let [a, b] = [state[0].hypot(state[2]), state[1].hypot(0.5 * state[3])];
        magnitudes.copy_from_slice(&[a, b, a, 2.0 * b]);
    }
}

/// A system's own magnitudes keep the error of a small component small; the largest of a block hides it.
#[test]
fn error_of_a_small_component_is_relative_to_its_own_magnitude() {
    fn errors<const OWN: bool>(tolerance: f64) -> [f64; 2] {
        let mut state = State::new(0.0, vec![1e6, 1.0, 0.0, 0.0]).unwrap();
        let mut method = Nystrom1210::new(Tolerance::relative(tolerance).unwrap());
        method.integrate_to(&mut LargeAndSmall::<OWN>, &mut state, 20.0).unwrap();
        [(state.values[0] / 1e6 - 20.0_f64.cos()).abs(), (state.values[1] - 40.0_f64.cos()).abs()]
    }
    let (own, blocks) = (errors::<true>(1e-10), errors::<false>(1e-10));
    assert!(own[0] < 1e-9 && own[1] < 1e-8, "{own:?}");
    assert!(blocks[0] < 1e-8 && 100.0 * own[1] < blocks[1], "{blocks:?} beside {own:?}");
}

#[test]
fn run_with_own_magnitudes_continues_to_the_last_bit() {
    let mut method = Nystrom86::new(Tolerance::relative(1e-9).unwrap());
    let start = State::new(0.0, vec![1e6, 1.0, 0.0, 0.0]).unwrap();
    let mut whole = start.clone();
    let mut checkpoint = None;
    method
        .integrate(&mut LargeAndSmall::<true>, &mut whole, 20.0, |step| {
            if step.number() == 9 {
                checkpoint = Some(step.checkpoint());
            }
            ControlFlow::Continue(())
        })
        .unwrap();
    let mut continued = start;
    let checkpoint = checkpoint.expect("more than nine steps");
    let mut method = Nystrom86::new(Tolerance::relative(1e-9).unwrap());
    method
        .resume(&mut LargeAndSmall::<true>, &checkpoint, &mut continued, 20.0, |_| ControlFlow::Continue(()))
        .unwrap();
    assert_eq!(whole, continued);
}
