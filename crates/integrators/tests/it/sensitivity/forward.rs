//! Derivatives along the run: closed forms, orders, the bits of the run, and what is not computed.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_integrators::{
    DormandPrince853, DormandPrincePair, ForwardSensitivity, GaussLegendre, Order, ParametricField, RungeKuttaPair,
    Sensitivities, SensitivityInputs, State, Tolerance, Verner98, VernerPair, WithParameters,
};
use piola_numerics::{Dual, Gradient, Lanes, Real};
use piola_testkit::{
    Tol, allocations_in, assert_close, assert_close_at_scale, assert_each_close, assert_order, golden, relative_error,
};

use super::{
    Counted, Driven, Kepler, LotkaVolterra, Oscillator, coefficients, covector_times, fixed, forward, method,
    oscillation,
};

const BOTH: SensitivityInputs = SensitivityInputs::StartAndParameters;

#[test]
fn derivatives_of_an_oscillation_equal_the_closed_form() {
    fn check<P: RungeKuttaPair>(start: [f64; 2]) {
        let (state, sensitivities) = forward(method::<P, f64>(1e-14), &Oscillator, &start, &[1.75], 6.0);
        let (end, by_start, by_parameter) = oscillation(start, 1.75, 6.0);
        let tol = Tol::ulps_because(256.0, "truncation at the tolerance 1e-14 over some twenty steps");
        assert_close("end", &state.values, &end, tol);
        assert_close("∂y/∂y₀", sensitivities.by_start(), &by_start, tol);
        assert_close("∂y/∂p", sensitivities.by_parameters(), &by_parameter, tol.times(6.0));
    }
    check::<DormandPrincePair>([1.0, 0.0]);
    check::<VernerPair>([1.0, 0.0]);
    check::<DormandPrincePair>([0.25, -1.5]);
    check::<VernerPair>([0.0, 1.0]);
}

#[test]
fn derivatives_of_rest_are_those_of_the_linearised_pendulum() {
    // Without torque the driven pendulum stays at rest; its derivatives follow ẍ + d ẋ + x = cos((k + 1) t/8).
    let field = Driven { coefficients: 7 };
    let (d, t) = (0.5_f64, 4.0_f64);
    let mut p = vec![0.0; 8];
    p[0] = d;
    let (state, sensitivities) = forward(fixed::<VernerPair, f64>(0.125), &field, &[0.0, 0.0], &p, t);
    assert_eq!(state.values, [0.0, 0.0]);
    let w = (1.0 - 0.25 * d * d).sqrt();
    let (sine, cosine, decay) = ((w * t).sin(), (w * t).cos(), (-0.5 * d * t).exp());
    let mut expected = vec![0.0];
    for k in 0..7 {
        // Steady oscillation a cos νt + b sin νt, and the decaying one that starts from rest.
        let nu = 0.125 * (f64::from(k) + 1.0);
        let size = (1.0 - nu * nu).powi(2) + (d * nu).powi(2);
        let (a, b) = ((1.0 - nu * nu) / size, d * nu / size);
        let decaying = decay * (-a * cosine - (b * nu + 0.5 * d * a) / w * sine);
        expected.push(a * (nu * t).cos() + b * (nu * t).sin() + decaying);
    }
    let tol = Tol::ulps(64.0);
    assert_close("∂x/∂p", &sensitivities.by_parameters()[..8], &expected, tol);
    let free = [decay * (cosine + 0.5 * d / w * sine), decay * sine / w];
    assert_close("∂x/∂y₀", &sensitivities.by_start()[..2], &free, tol);
}

/// ẏ = (y + p)(1 − y − p).
struct Logistic;
impl ParametricField for Logistic {
    type Error = Infallible;
    fn dimension(&self) -> usize {
        1
    }
    fn parameters(&self) -> usize {
        1
    }
    fn rate<T: Real>(&self, _t: f64, y: &[T], p: &[T], rate: &mut [T]) -> Result<(), Infallible> {
        let sum = y[0] + p[0];
        rate[0] = sum * (T::one() - sum);
        Ok(())
    }
}

#[test]
fn errors_of_the_derivatives_fall_with_the_order_of_the_method() {
    fn check<P: RungeKuttaPair>(
        field: &impl ParametricField<Error = Infallible>,
        (start, p, end): (&[f64], &[f64], f64),
        (by_start, by_parameters): (&[f64], &[f64]),
        counts: [u32; 5],
        order: f64,
    ) {
        let steps = counts.map(|n| end / f64::from(n));
        let runs = steps.map(|h| forward(fixed::<P, f64>(h), field, start, p, end).1);
        let error = |actual: &[f64], expected: &[f64]| {
            actual.iter().zip(expected).map(|(a, e)| (a - e).abs()).fold(0.0, f64::max)
        };
        let of_start = runs.each_ref().map(|run| error(run.by_start(), by_start));
        let of_parameters = runs.each_ref().map(|run| error(run.by_parameters(), by_parameters));
        for errors in [of_start, of_parameters] {
            assert!(errors[4] < 1e-2 * errors[0], "two decades: {errors:?}");
            assert_order("derivatives", &steps, &errors, order, 0.1);
        }
    }
    let golden = golden::load("sensitivities");
    let case = golden.cases.iter().find(|case| golden::text(&case["name"]) == "lotka_volterra").unwrap();
    let [start, p] = ["start", "parameters"].map(|name| golden::vector(&case[name]));
    let [by_start, by_parameters] = ["by_start", "by_parameters"].map(|name| golden::matrix(&case[name]).concat());
    let problem = (&start[..], &p[..], golden::number(&case["t"]));
    check::<DormandPrincePair>(&LotkaVolterra, problem, (&by_start, &by_parameters), [60, 80, 100, 120, 160], 8.0);
    // y + p = e^t s/(1 + s (e^t − 1)) with s = y₀ + p.
    let e = 2.0_f64.exp();
    let growth = e / (1.0 + 0.25 * (e - 1.0)).powi(2);
    check::<VernerPair>(&Logistic, (&[0.125], &[0.125], 2.0), (&[growth], &[growth - 1.0]), [3, 4, 5, 6, 8], 9.0);
}

#[test]
fn state_has_the_bits_of_a_run_without_derivatives() {
    fn check<P: RungeKuttaPair, F: ParametricField>(field: &F, start: &[f64], p: &[f64], end: f64)
    where
        F::Error: core::fmt::Debug + PartialEq,
    {
        let mut alone = State::new(0.5, start.to_vec()).unwrap();
        let mut plain = method::<P, f64>(1e-10);
        let report = plain.integrate_to(&mut WithParameters::new(field, p).unwrap(), &mut alone, end).unwrap();
        let mut state = State::new(0.5, start.to_vec()).unwrap();
        let mut sensitivities = Sensitivities::at_start(start.len(), p.len(), BOTH);
        let mut steps = 0;
        let mut with = ForwardSensitivity::new(method::<P, f64>(1e-10));
        let found = with
            .integrate(field, p, &mut state, &mut sensitivities, end, |step, _| {
                steps += 1;
                assert_eq!(step.number, steps);
                ControlFlow::Continue(())
            })
            .unwrap();
        assert_eq!((found, state), (report, alone));
        assert_eq!(steps, report.steps);
    }
    let driven = Driven { coefficients: 3 };
    check::<DormandPrincePair, _>(&driven, &[0.0, 0.0], &coefficients(3), 20.0);
    check::<VernerPair, _>(&driven, &[0.0, 0.0], &coefficients(3), -20.0);
    check::<VernerPair, _>(&Kepler, &[0.25, 0.0, 0.0, 2.5], &[1.0], 9.0);
}

#[test]
fn derivatives_over_an_interval_are_those_of_its_parts_multiplied() {
    let p = [1.0625];
    let start = [0.75, 0.25, -0.5, 1.125];
    let mut method = ForwardSensitivity::new(method::<DormandPrincePair, f64>(1e-13));
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut whole = Sensitivities::at_start(4, 1, BOTH);
    method.integrate_to(&Kepler, &p, &mut state, &mut whole, 2.0).unwrap();
    let first = whole.clone();
    let mut second = Sensitivities::at_start(4, 1, BOTH);
    method.integrate_to(&Kepler, &p, &mut state.clone(), &mut second, 5.0).unwrap();
    method.integrate_to(&Kepler, &p, &mut state, &mut whole, 5.0).unwrap();
    let mut by_start = Vec::new();
    let mut by_parameter = Vec::new();
    for (row, own) in second.by_start().chunks(4).zip(second.by_parameters()) {
        by_start.extend(covector_times(row, first.by_start()));
        by_parameter.push(own + covector_times(row, first.by_parameters())[0]);
    }
    assert_close("∂y/∂y₀", whole.by_start(), &by_start, Tol::ulps(32.0));
    assert_close("∂y/∂p", whole.by_parameters(), &by_parameter, Tol::ulps(32.0));
}

#[test]
fn derivatives_there_and_back_are_those_of_the_start() {
    let start = [0.75, 0.25, -0.5, 1.125];
    let mut method = ForwardSensitivity::new(method::<VernerPair, f64>(1e-15));
    let mut state = State::new(0.0, start.to_vec()).unwrap();
    let mut sensitivities = Sensitivities::at_start(4, 1, BOTH);
    method.integrate_to(&Kepler, &[1.0625], &mut state, &mut sensitivities, 5.0).unwrap();
    method.integrate_to(&Kepler, &[1.0625], &mut state, &mut sensitivities, 0.0).unwrap();
    let unit: Sensitivities = Sensitivities::at_start(4, 1, BOTH);
    let tol = Tol::ulps_because(1e4, "derivatives grow by a factor of twenty and shrink again");
    assert_close("∂y/∂y₀", sensitivities.by_start(), unit.by_start(), tol);
    assert_close_at_scale("∂y/∂p", sensitivities.by_parameters(), unit.by_parameters(), 1.0, tol);
}

/// The largest entry of `ΦᵀJΦ − J` over the square of the largest of Φ, in the plane.
fn symplectic_defect(phi: &[f64]) -> f64 {
    let entry = |i: usize, j: usize| phi[i * 4 + j];
    let mut defect = 0.0_f64;
    for a in 0..4 {
        for b in 0..4 {
            let product: f64 = (0..2).map(|k| entry(k, a) * entry(k + 2, b) - entry(k + 2, a) * entry(k, b)).sum();
            let unit = if a + 2 == b {
                1.0
            } else if b + 2 == a {
                -1.0
            } else {
                0.0
            };
            defect = defect.max((product - unit).abs());
        }
    }
    let size = phi.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    defect / (size * size)
}

#[test]
fn derivatives_of_a_hamiltonian_flow_are_symplectic() {
    for start in [[0.75, 0.25, -0.5, 1.125], [1.0, 0.0, 0.0, 1.25]] {
        let dormand_prince = forward(method::<DormandPrincePair, f64>(1e-14), &Kepler, &start, &[1.0], 10.0).1;
        let verner = forward(method::<VernerPair, f64>(1e-14), &Kepler, &start, &[1.0], 10.0).1;
        for phi in [dormand_prince.by_start(), verner.by_start()] {
            let defect = symplectic_defect(phi);
            let tol = Tol::ulps_because(512.0, "truncation at the tolerance 1e-14 over some thirty steps");
            assert!(defect < tol.value(), "{defect:e}");
        }
    }
    // At a loose tolerance the defect is that of the method: the check above is no identity of the derivatives.
    let coarse = forward(fixed::<DormandPrincePair, f64>(1.0), &Kepler, &[1.0, 0.0, 0.0, 1.25], &[1.0], 10.0).1;
    assert!(1e-9 < symplectic_defect(coarse.by_start()));
}

#[test]
fn derivatives_by_a_symplectic_method_are_symplectic_to_rounding() {
    // Any method that is generic over its scalar differentiates its run: the start and the parameters carry the directions.
    let start = [0.75, 0.25, -0.5, 1.125];
    let variables = start.iter().enumerate().map(|(i, &x)| Gradient::<f64, 5>::variable(x, i)).collect();
    let p = [Gradient::variable(1.0625, 4)];
    let mut state = State::new(0.0, variables).unwrap();
    GaussLegendre::new(Order::Four, 0.125)
        .unwrap()
        .integrate_to(&mut WithParameters::new(&Kepler, &p).unwrap(), &mut state, 3.0)
        .unwrap();
    let phi: Vec<f64> = state.values.iter().flat_map(|y| y.partials[..4].to_vec()).collect();
    let tol = Tol::ulps(16.0);
    assert!(symplectic_defect(&phi) < tol.value(), "{:e}", symplectic_defect(&phi));
    // The run itself has the error of its long steps.
    let exact = forward(method::<VernerPair, f64>(1e-13), &Kepler, &start, &[1.0625], 3.0).1;
    let by_parameter: Vec<f64> = state.values.iter().map(|y| y.partials[4]).collect();
    let errors =
        [(&phi[..], exact.by_start()), (&by_parameter, exact.by_parameters())].map(|(a, e)| relative_error(a, e));
    assert!(errors.iter().all(|error| (1e-7..1e-2).contains(error)), "{errors:?}");
}

#[test]
fn derivatives_not_asked_for_are_not_computed() {
    let count = |inputs| {
        let field = Counted::new(Driven { coefficients: 19 });
        let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
        let mut sensitivities = Sensitivities::at_start(2, 20, inputs);
        let mut method = ForwardSensitivity::new(method::<DormandPrincePair, f64>(1e-9));
        let p = coefficients(19);
        let report = method.integrate_to(&field, &p, &mut state, &mut sensitivities, 5.0).unwrap();
        assert_eq!(field.plain.get(), report.evaluations);
        assert_eq!(sensitivities.inputs(), inputs);
        assert_eq!(field.differentiated.get() % (12 * report.steps), 0);
        (field.differentiated.get() / (12 * report.steps), sensitivities)
    };
    let (start, of_start) = count(SensitivityInputs::Start);
    let (parameters, of_parameters) = count(SensitivityInputs::Parameters);
    let (both, of_both) = count(BOTH);
    // 2, 20 and 22 directions, four at once.
    assert_eq!((start, parameters, both), (1, 5, 6));
    assert_eq!((of_start.by_parameters(), of_parameters.by_start()), (&[][..], &[][..]));
    assert_eq!((of_start.by_start(), of_parameters.by_parameters()), (of_both.by_start(), of_both.by_parameters()));
}

#[test]
fn lanes_give_the_bits_that_each_lane_gets_alone() {
    let starts = [[1.0, 0.5], [2.0, 0.25]];
    let p = [[1.5, 1.0, 3.0, 1.25], [1.25, 0.75, 2.0, 1.0]];
    let lanes = |values: [&[f64]; 2]| -> Vec<Lanes<f64, 2>> {
        values[0].iter().zip(values[1]).map(|(&a, &b)| Lanes([a, b])).collect()
    };
    let mut state = State::new(0.0, lanes([&starts[0], &starts[1]])).unwrap();
    let mut sensitivities = Sensitivities::at_start(2, 4, BOTH);
    ForwardSensitivity::new(fixed::<DormandPrincePair, Lanes<f64, 2>>(0.0625))
        .integrate_to(&LotkaVolterra, &lanes([&p[0], &p[1]]), &mut state, &mut sensitivities, 2.0)
        .unwrap();
    for lane in 0..2 {
        let alone = forward(fixed::<DormandPrincePair, f64>(0.0625), &LotkaVolterra, &starts[lane], &p[lane], 2.0).1;
        let of_lane = |x: &[Lanes<f64, 2>]| x.iter().map(|x| x.primal(lane)).collect::<Vec<_>>();
        assert_eq!(of_lane(sensitivities.by_start()), alone.by_start());
        assert_eq!(of_lane(sensitivities.by_parameters()), alone.by_parameters());
    }
}

#[test]
fn dual_numbers_carry_second_derivatives() {
    // x = cos pt from rest: ∂²x/∂p² = −t² cos pt, ∂²x/∂x₀∂p = −t sin pt.
    let (p, t) = (1.75_f64, 3.0_f64);
    let mut state = State::new(0.0, vec![Dual::lit(1.0), Dual::lit(0.0)]).unwrap();
    let mut sensitivities = Sensitivities::at_start(2, 1, BOTH);
    ForwardSensitivity::new(Verner98::new(Tolerance::relative(1e-14).unwrap()))
        .integrate_to(&Oscillator, &[Dual::variable(p)], &mut state, &mut sensitivities, t)
        .unwrap();
    let (sine, cosine) = (p * t).sin_cos();
    let actual = [sensitivities.by_parameters()[0].tangent, sensitivities.by_start()[0].tangent];
    let tol = Tol::ulps_because(256.0, "truncation at the tolerance 1e-14");
    assert_each_close("second derivatives", &actual, &[-t * t * cosine, -t * sine], tol);
}

#[test]
fn repeated_runs_are_bit_identical_and_allocate_nothing() {
    let field = Driven { coefficients: 9 };
    let p = coefficients(9);
    let mut method = ForwardSensitivity::new(DormandPrince853::new(Tolerance::relative(1e-10).unwrap()));
    let mut state = State::new(0.0, vec![0.0, 0.0]).unwrap();
    let mut sensitivities = Sensitivities::at_start(2, 10, BOTH);
    let (fresh_state, fresh) = (state.clone(), sensitivities.clone());
    method.integrate_to(&field, &p, &mut state, &mut sensitivities, 10.0).unwrap();
    let (mut again_state, mut again) = (fresh_state, fresh);
    let (count, _) = allocations_in(|| method.integrate_to(&field, &p, &mut again_state, &mut again, 10.0).unwrap());
    assert_eq!(count, 0);
    assert_eq!((again_state, again), (state, sensitivities));
}

#[test]
fn runs_of_ten_and_of_a_thousand_steps_allocate_alike() {
    let allocations = [10_u32, 1000].map(|steps| {
        let mut taken = 0;
        let (count, ()) = allocations_in(|| {
            let mut state = State::new(0.0, vec![1.0, 0.5]).unwrap();
            let mut sensitivities = Sensitivities::at_start(2, 4, BOTH);
            let mut method = ForwardSensitivity::new(fixed::<DormandPrincePair, f64>(1.0 / 1024.0));
            let (p, end) = ([1.5, 1.0, 3.0, 1.25], f64::from(steps) / 1024.0);
            taken = method.integrate_to(&LotkaVolterra, &p, &mut state, &mut sensitivities, end).unwrap().steps;
        });
        assert_eq!(taken, u64::from(steps));
        count
    });
    assert_eq!(allocations[0], allocations[1]);
}
