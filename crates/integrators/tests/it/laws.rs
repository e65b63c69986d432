//! What the methods keep: reversibility, symplecticity, invariants; and what they give over other scalars.

use piola_integrators::{
    Composition, DormandPrince853, Field, GaussLegendre, Order, Separable, State, Tolerance, field,
};
use piola_numerics::{Dual, Gradient, Lanes, Real};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use crate::problems::{DoublePendulum, FIGURE_EIGHT, henon_heiles, kepler, kepler_at, kepler_energy, three_bodies};

/// H = (1 + q₁²) p₁²/2 + p₂²/2 + (1 − cos q₁) + q₁ p₂ + q₂²/2: it does not separate.
fn inseparable<T: Real>(_t: f64, y: &[T], rate: &mut [T]) {
    let (q, p) = (&y[..2], &y[2..]);
    rate[0] = (T::one() + q[0] * q[0]) * p[0];
    rate[1] = p[1] + q[0];
    rate[2] = -(q[0] * p[0] * p[0]) - q[0].sin() - p[1];
    rate[3] = -q[1];
}

/// 640 steps, each of which rounds; the way back multiplies what the way out has left by the growth of neighbours.
const THERE_AND_BACK: Tol = Tol::ulps_because(512.0, "640 steps, whose roundings the flow magnifies");

/// ∂y/∂y₀ has entries of some tens, whose products cancel to one.
const SYMPLECTIC: Tol =
    Tol::ulps_because(40_960.0, "products of derivatives of some tens, summed over 60 steps, cancel to one");

/// Sums over three bodies of what a thousand steps have rounded.
const MOMENTA: Tol = Tol::ulps_because(256.0, "a thousand steps of three bodies, whose roundings walk at random");

proptest! {
    #[test]
    fn there_and_back_equals_the_start(x in 0.1..0.3, p in 0.1..0.3) {
        let start = [x, 0.125, p, 0.05];
        for order in Order::ALL {
            let mut state = State::new(0.0, start.to_vec()).unwrap();
            let mut method = Composition::new(order, 0.0625).unwrap();
            method.integrate_to(&mut henon_heiles(), &mut state, 20.0).unwrap();
            method.integrate_to(&mut henon_heiles(), &mut state, 0.0).unwrap();
            assert_close("composition", &state.values, &start, THERE_AND_BACK);

            let mut state = State::new(0.0, start.to_vec()).unwrap();
            let mut method = GaussLegendre::new(order, 0.0625).unwrap();
            method.integrate_to(&mut henon_heiles(), &mut state, 20.0).unwrap();
            method.integrate_to(&mut henon_heiles(), &mut state, 0.0).unwrap();
            assert_close("collocation", &state.values, &start, THERE_AND_BACK);
        }
    }
}

type G = Gradient<f64, 4>;

fn variables(start: [f64; 4]) -> State<G> {
    State::new(0.0, (0..4).map(|i| G::variable(start[i], i)).collect()).unwrap()
}

/// Asserts Jᵀ Ω J = Ω for J = ∂y/∂y₀.
fn assert_symplectic(what: &str, y: &[G], tol: Tol) {
    let mut form = [0.0; 16];
    let mut expected = [0.0; 16];
    for i in 0..4 {
        for j in 0..4 {
            form[4 * i + j] =
                (0..2).map(|k| y[k].partials[i] * y[k + 2].partials[j] - y[k + 2].partials[i] * y[k].partials[j]).sum();
        }
    }
    for k in 0..2 {
        expected[4 * k + k + 2] = 1.0;
        expected[4 * (k + 2) + k] = -1.0;
    }
    assert_close(what, &form, &expected, tol);
}

#[test]
fn compositions_are_symplectic() {
    for order in Order::ALL {
        let mut state = variables(kepler_at(0.3, 0.0));
        Composition::new(order, 0.1).unwrap().integrate_to(&mut kepler(), &mut state, 6.0).unwrap();
        assert_symplectic("composition", &state.values, SYMPLECTIC);
    }
}

#[test]
fn collocation_is_symplectic_also_where_hamiltonians_do_not_separate() {
    for order in Order::ALL {
        let mut state = variables([0.5, -0.25, 0.75, 0.125]);
        let mut field = field(4, inseparable::<G>);
        GaussLegendre::new(order, 0.0625).unwrap().integrate_to(&mut field, &mut state, 3.0).unwrap();
        assert_symplectic("collocation", &state.values, SYMPLECTIC);
        let mut state = variables(kepler_at(0.3, 0.0));
        GaussLegendre::new(order, 0.1).unwrap().integrate_to(&mut kepler(), &mut state, 6.0).unwrap();
        assert_symplectic("collocation of second order", &state.values, SYMPLECTIC);
    }
}

fn momenta(y: &[f64]) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for i in 0..3 {
        let (q, v) = (&y[2 * i..2 * i + 2], &y[6 + 2 * i..8 + 2 * i]);
        sums[0] += v[0];
        sums[1] += v[1];
        sums[2] += q[0] * v[1] - q[1] * v[0];
    }
    sums
}

#[test]
fn linear_and_angular_momentum_are_kept_to_rounding() {
    // Moved and moving as a whole, so that no momentum vanishes.
    let mut start = FIGURE_EIGHT;
    for body in 0..3 {
        for (i, shift) in [(0, 0.5), (1, 0.25), (6, 0.25), (7, -0.125)] {
            start[2 * body + i] += shift;
        }
    }
    let expected = momenta(&start);
    for order in Order::ALL {
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        Composition::new(order, 0.01).unwrap().integrate_to(&mut three_bodies(), &mut state, 10.0).unwrap();
        assert_close_at_scale("composition", &momenta(&state.values), &expected, 1.0, MOMENTA);
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        GaussLegendre::new(order, 0.01).unwrap().integrate_to(&mut three_bodies(), &mut state, 10.0).unwrap();
        assert_close_at_scale("collocation", &momenta(&state.values), &expected, 1.0, MOMENTA);
    }
}

const TOP: Tol = Tol::ulps_because(256.0, "two thousand steps, whose roundings walk at random");

#[test]
fn collocation_keeps_both_quadratic_integrals_of_the_free_top() {
    // Euler's equations: the energy and the square of the angular momentum are quadratic in ω.
    let inertia = [1.0, 2.0, 3.0];
    let mut top = field(3, |_t, w: &[f64], rate: &mut [f64]| {
        rate[0] = (inertia[1] - inertia[2]) / inertia[0] * w[1] * w[2];
        rate[1] = (inertia[2] - inertia[0]) / inertia[1] * w[2] * w[0];
        rate[2] = (inertia[0] - inertia[1]) / inertia[2] * w[0] * w[1];
    });
    let integrals = |w: &[f64]| {
        let sum = |power: i32| (0..3).map(|i| inertia[i].powi(power) * w[i] * w[i]).sum::<f64>();
        [sum(1), sum(2)]
    };
    let start = [0.5, -0.25, 1.5];
    for order in Order::ALL {
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        GaussLegendre::new(order, 0.05).unwrap().integrate_to(&mut top, &mut state, 100.0).unwrap();
        assert_close("integrals", &integrals(&state.values), &integrals(&start), TOP);
    }
}

/// Steps in one period of the Kepler motion.
const STEPS: u32 = 64;

/// The change of the relative energy error over a run, by a straight line through a thousand samples, and the
/// largest error among them.
///
/// The samples are a number of periods and a third apart, so that they see the oscillation at all phases.
fn energy_drift(periods: u32, mut advance: impl FnMut(&mut State, f64)) -> (f64, f64) {
    let samples = 1000;
    let between = (periods / samples * STEPS + STEPS / 3) | 1;
    let mut state = State::new(0.0, kepler_at(0.3, 0.0).to_vec()).unwrap();
    let before = kepler_energy(&state.values);
    let (mut largest, mut sums) = (0.0_f64, [0.0; 4]);
    for sample in 1..=samples {
        let x = f64::from(sample) / f64::from(samples);
        advance(&mut state, STEP * f64::from(between * sample));
        let error = kepler_energy(&state.values) / before - 1.0;
        largest = largest.max(error.abs());
        sums = [sums[0] + x, sums[1] + x * x, sums[2] + error, sums[3] + x * error];
    }
    let n = f64::from(samples);
    ((n * sums[3] - sums[0] * sums[2]) / (n * sums[1] - sums[0] * sums[0]), largest)
}

const STEP: f64 = 2.0 * core::f64::consts::PI / 64.0;

#[test]
fn energy_error_of_compositions_oscillates_and_does_not_drift_over_a_hundred_thousand_periods() {
    for order in [Order::Two, Order::Four] {
        let mut method = Composition::new(order, STEP).unwrap();
        let (drift, largest) = energy_drift(100_000, |state, end| {
            method.integrate_to(&mut kepler(), state, end).unwrap();
        });
        // A thousand samples of an oscillation fix a slope to a tenth of its size, whatever the run's length.
        assert!(1e-7 < largest && drift.abs() < 0.2 * largest, "{order:?}: drift {drift:e}, largest {largest:e}");
    }
}

#[test]
fn energy_error_of_order_eight_stays_near_rounding_over_a_hundred_thousand_periods() {
    let mut method = Composition::new(Order::Eight, STEP).unwrap();
    let (drift, largest) = energy_drift(100_000, |state, end| {
        method.integrate_to(&mut kepler(), state, end).unwrap();
    });
    // Six million roundings of 1e-16 of the energy walk to 3e-13 at random; to 6e-10 in one direction.
    assert!(largest < 1e-11 && drift.abs() < 6e-13, "drift {drift:e}, largest {largest:e}");
}

#[test]
fn energy_error_of_collocation_does_not_drift_over_ten_thousand_periods() {
    for (order, bound) in [(Order::Four, 1e-4), (Order::Eight, 1e-11)] {
        let mut method = GaussLegendre::new(order, STEP).unwrap();
        let (drift, largest) = energy_drift(10_000, |state, end| {
            method.integrate_to(&mut kepler(), state, end).unwrap();
        });
        assert!(largest < bound && drift.abs() < 0.2 * largest, "{order:?}: drift {drift:e}, largest {largest:e}");
    }
}

#[test]
fn collocation_leaves_nothing_out_that_adds_up() {
    // What the iteration of the stages leaves out has one sign in all steps: it must be far below rounding.
    let start = kepler_at(0.05, 0.0);
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut method = GaussLegendre::new(Order::Eight, core::f64::consts::TAU / 200.0).unwrap();
    let mut general = field(4, |t, y: &[f64], rate: &mut [f64]| {
        kepler().rate(t, y, rate).unwrap_or_else(|never| match never {});
    });
    method.integrate_to(&mut general, &mut state, 100.0 * core::f64::consts::TAU).unwrap();
    let tol =
        Tol::ulps_because(4000.0, "in a hundred revolutions an ulp becomes some of phase; left out at 1/32 ulp: 1e6");
    assert_close("after a hundred revolutions", &state.values, &start, tol);
}

#[test]
fn run_over_duals_equals_the_difference_of_runs() {
    let start = [0.25, -0.125, 0.5, -0.25];
    let direction = [1.0, 0.5, -0.25, 0.125];
    let pendulum = || DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 9.8125 };
    let expected = difference_quotient(
        |y| {
            let mut state = State::new(0.0, y.to_vec()).unwrap();
            let mut method = DormandPrince853::new(Tolerance::relative(1e-15).unwrap());
            method.integrate_to(&mut pendulum(), &mut state, 2.0).unwrap();
            state.values
        },
        &start,
        &direction,
    );
    let tol = Tol::stated(1e-9, "differences of sixth order of runs of tolerance 1e-15");
    let dual = || {
        let values = (0..4).map(|i| Dual { value: start[i], tangent: direction[i] }).collect();
        State::new(0.0, values).unwrap()
    };
    let tangents = |state: State<Dual<f64>>| state.values.iter().map(|y| y.tangent).collect::<Vec<_>>();
    let mut state = dual();
    let mut method = DormandPrince853::new(Tolerance::relative(1e-14).unwrap());
    method.integrate_to(&mut pendulum(), &mut state, 2.0).unwrap();
    assert_close("adaptive", &tangents(state), &expected, tol);
    let mut state = dual();
    GaussLegendre::new(Order::Eight, 0.01).unwrap().integrate_to(&mut pendulum(), &mut state, 2.0).unwrap();
    assert_close("collocation", &tangents(state), &expected, tol);
}

#[test]
fn values_of_a_run_over_duals_equal_the_run_over_doubles() {
    let start = kepler_at(0.3, 0.0);
    let mut plain = State::new(0.0, start.to_vec()).unwrap();
    let mut dual = State::new(0.0, start.map(|y| Dual { value: y, tangent: 1.0 }).to_vec()).unwrap();
    let tolerance = Tolerance::relative(1e-10).unwrap();
    DormandPrince853::new(tolerance).integrate_to(&mut kepler(), &mut plain, 10.0).unwrap();
    DormandPrince853::new(tolerance).integrate_to(&mut kepler(), &mut dual, 10.0).unwrap();
    assert_eq!(plain.values, dual.values.iter().map(|y| y.value).collect::<Vec<_>>());
}

const STARTS: [[f64; 4]; 4] =
    [[1.0, 0.0, 0.0, 1.0], [1.0, 0.0, 0.0, 1.125], [0.875, 0.25, -0.125, 1.0], [1.5, -0.5, 0.25, 0.75]];

fn together() -> State<Lanes<f64, 4>> {
    State::new(0.0, (0..4).map(|i| Lanes::from(STARTS.map(|start| start[i]))).collect()).unwrap()
}

fn lane(state: &State<Lanes<f64, 4>>, lane: usize) -> Vec<f64> {
    state.values.iter().map(|y| y.primal(lane)).collect()
}

#[test]
fn composition_over_lanes_equals_the_runs_of_each_lane() {
    for order in Order::ALL {
        let mut state = together();
        Composition::new(order, 0.05).unwrap().integrate_to(&mut kepler(), &mut state, 10.0).unwrap();
        for (i, start) in STARTS.iter().enumerate() {
            let mut single = State::new(0.0, start.to_vec()).unwrap();
            Composition::new(order, 0.05).unwrap().integrate_to(&mut kepler(), &mut single, 10.0).unwrap();
            assert_eq!(lane(&state, i), single.values);
        }
    }
}

#[test]
fn collocation_over_lanes_tends_to_the_runs_of_each_lane() {
    // Lanes are iterated until all have converged: a lane may get a sweep more than alone.
    let mut state = together();
    GaussLegendre::new(Order::Eight, 0.05).unwrap().integrate_to(&mut kepler(), &mut state, 10.0).unwrap();
    for (i, start) in STARTS.iter().enumerate() {
        let mut single = State::new(0.0, start.to_vec()).unwrap();
        GaussLegendre::new(Order::Eight, 0.05).unwrap().integrate_to(&mut kepler(), &mut single, 10.0).unwrap();
        let tol = Tol::stated(1e-12, "rounding of two hundred steps times a sensitivity of thirty");
        assert_close("lane", &lane(&state, i), &single.values, tol);
    }
}

#[test]
fn second_order_and_general_iterations_agree() {
    let start = kepler_at(0.3, 0.0);
    let mut shortcut = State::new(0.0, start.to_vec()).unwrap();
    let mut general = shortcut.clone();
    let mut plain = field(4, |t, y: &[f64], rate: &mut [f64]| {
        if let Err(never) = kepler().rate(t, y, rate) {
            match never {}
        }
    });
    let fewer =
        GaussLegendre::new(Order::Eight, 0.05).unwrap().integrate_to(&mut kepler(), &mut shortcut, 10.0).unwrap();
    let more = GaussLegendre::new(Order::Eight, 0.05).unwrap().integrate_to(&mut plain, &mut general, 10.0).unwrap();
    assert!(fewer.evaluations < more.evaluations, "{fewer:?} {more:?}");
    let tol = Tol::stated(1e-12, "rounding of two hundred steps times a sensitivity of forty");
    assert_close("states", &shortcut.values, &general.values, tol);
}

#[test]
fn rounding_of_a_million_small_steps_stays_below_an_ulp() {
    // Free motion: only the sum of a million increments can err.
    struct Free;
    impl Separable for Free {
        type Error = core::convert::Infallible;
        fn freedom(&self) -> usize {
            1
        }
        fn force(&mut self, _t: f64, _q: &[f64], force: &mut [f64]) -> Result<(), Self::Error> {
            force[0] = 0.0;
            Ok(())
        }
    }
    let mut state = State::new(0.0, vec![1.0, 0.1]).unwrap();
    let mut method = Composition::new(Order::Two, 1.0 / 1_048_576.0).unwrap();
    method.integrate_to(&mut Free, &mut state, 1.0).unwrap();
    assert_close("position", &state.values, &[1.1, 0.1], Tol::ulps(1.0));
}

/// A clock y′ = 1 from a late time, where that is rounded to 1e-7: the steps still add up to the span.
#[test]
fn steps_from_a_late_time_add_up_to_the_span() {
    let mut clock = field(1, |_t, _y: &[f64], rate: &mut [f64]| rate[0] = 1.0);
    for (start, span) in [(1e9, 10.0), (-1e9, 10.0), (1e9, -10.0)] {
        let mut state = State::new(start, vec![0.0]).unwrap();
        let mut method =
            DormandPrince853::new(Tolerance::relative(1e-9).unwrap()).with_longest_step(1.0 / 3.0).unwrap();
        let report = method.integrate_to(&mut clock, &mut state, start + span).unwrap();
        assert!(30 <= report.steps, "{report:?}");
        assert_close("y", &state.values, &[span], Tol::ulps(2.0));
    }
}

/// Of an even number of components the first half are positions, the others velocities; of an odd number all are alike.
#[test]
fn errors_are_relative_to_the_largest_position_and_to_the_largest_velocity() {
    let still = |_t: f64, _y: &[f64], rate: &mut [f64]| rate.fill(0.0);
    let mut found = [0.0; 4];
    field(4, still).magnitudes(&[1.0, -3.0, 0.25, -0.125], &mut found);
    assert_close("four", &found, &[3.0, 3.0, 0.25, 0.25], Tol::ulps(0.0));
    field(3, still).magnitudes(&[1.0, -0.5, -2.0], &mut found[..3]);
    assert_close("three", &found[..3], &[2.0; 3], Tol::ulps(0.0));
    field(4, still).componentwise().magnitudes(&[1.0, -3.0, 0.25, -0.125], &mut found);
    assert_close("each", &found, &[1.0, 3.0, 0.25, 0.125], Tol::ulps(0.0));
}
