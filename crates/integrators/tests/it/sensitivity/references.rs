//! Derivatives against references of 34 digits, and against differences in twice the precision.

use piola_integrators::{DormandPrincePair, RungeKuttaPair, State, VernerPair, WithParameters};
use piola_numerics::Real;
use piola_testkit::golden::{self, matrix, number, text, vector};
use piola_testkit::{DoubleDouble, Tol, assert_close, assert_each_close_at_scales};

use super::{Kepler, Linear, LotkaVolterra, ParametricField, adjoint, fixed, forward, method};

fn check<P: RungeKuttaPair>(name: &str, field: &impl ParametricField<Error = core::convert::Infallible>) {
    let golden = golden::load("sensitivities");
    let case = golden.cases.iter().find(|case| text(&case["name"]) == name).unwrap();
    let (start, p, end) = (vector(&case["start"]), vector(&case["parameters"]), number(&case["t"]));
    let (by_start, by_parameters) = (matrix(&case["by_start"]), matrix(&case["by_parameters"]));
    let (state, sensitivities) = forward(method::<P, f64>(1e-15), field, &start, &p, end);
    let tol = Tol::stated(2e-13, "rounding and truncation of steps at the tolerance 1e-15, magnified by up to 40");
    assert_close("end", &state.values, &vector(&case["end"]), tol);
    assert_close("∂y/∂y₀", sensitivities.by_start(), &by_start.concat(), tol);
    assert_close("∂y/∂p", sensitivities.by_parameters(), &by_parameters.concat(), tol);
    // The gradients of single components are the rows.
    for (i, (row_by_start, row_by_parameters)) in by_start.iter().zip(&by_parameters).enumerate() {
        let mut c = vec![0.0; start.len()];
        c[i] = 1.0;
        let gradient = adjoint(method::<P, f64>(1e-15), 4, field, &Linear(c), (&start, &p), end);
        assert_close("∂yᵢ/∂y₀", &gradient.by_start, row_by_start, tol);
        assert_close("∂yᵢ/∂p", &gradient.by_parameters, row_by_parameters, tol);
    }
}

#[test]
fn derivatives_of_keplers_motion_equal_the_reference() {
    check::<DormandPrincePair>("kepler", &Kepler);
    check::<VernerPair>("kepler", &Kepler);
}

#[test]
fn derivatives_of_predators_and_prey_equal_the_reference() {
    check::<DormandPrincePair>("lotka_volterra", &LotkaVolterra);
    check::<VernerPair>("lotka_volterra", &LotkaVolterra);
}

/// The derivative of component i of the end of a run in steps of one length, by input j, by central differences.
fn differences<P: RungeKuttaPair>(start: &[f64], p: &[f64], step: f64, end: f64) -> Vec<Vec<f64>> {
    let inputs: Vec<f64> = start.iter().chain(p).copied().collect();
    let increment = DoubleDouble::lit(1e-10);
    let run = |j: usize, change: DoubleDouble| {
        let mut inputs: Vec<_> = inputs.iter().map(|&x| DoubleDouble::lit(x)).collect();
        inputs[j] += change;
        let (start, p) = inputs.split_at(start.len());
        let mut state = State::new(0.0, start.to_vec()).unwrap();
        let report = fixed::<P, DoubleDouble>(step)
            .integrate_to(&mut WithParameters::new(&Kepler, p).unwrap(), &mut state, end)
            .unwrap();
        (state.values, report.steps)
    };
    let column = |j: usize| {
        let ((high, steps), (low, same)) = (run(j, increment), run(j, -increment));
        assert_eq!((steps, same), (8, 8));
        let quotient =
            |(&high, &low): (&DoubleDouble, &DoubleDouble)| ((high - low) / (increment + increment)).primal(0);
        high.iter().zip(&low).map(quotient).collect()
    };
    (0..inputs.len()).map(column).collect()
}

#[test]
fn derivatives_are_those_of_the_run_that_was_made() {
    // Steps so long that the run is far from the solution: its own derivatives are found, not those of the solution.
    fn check<P: RungeKuttaPair>() {
        let (start, p, end) = ([1.0, 0.0, 0.0, 1.25], [1.0], 10.0);
        let columns = differences::<P>(&start, &p, 1.25, end);
        let (_, sensitivities) = forward(fixed::<P, f64>(1.25), &Kepler, &start, &p, end);
        let exact = forward(method::<P, f64>(1e-13), &Kepler, &start, &p, end).1;
        let largest = exact.by_start().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        let mut truncation = 0.0_f64;
        for i in 0..4 {
            let expected: Vec<f64> = columns.iter().map(|column| column[i]).collect();
            let row: Vec<f64> = sensitivities.by_start()[4 * i..4 * i + 4]
                .iter()
                .chain(&sensitivities.by_parameters()[i..=i])
                .copied()
                .collect();
            let scales = [largest; 5];
            assert_each_close_at_scales("forward", &row, &expected, &scales, Tol::ulps(64.0));
            let mut c = vec![0.0; 4];
            c[i] = 1.0;
            let gradient = adjoint(fixed::<P, f64>(1.25), 2, &Kepler, &Linear(c), (&start, &p), end);
            let row: Vec<f64> = gradient.by_start.iter().chain(&gradient.by_parameters).copied().collect();
            assert_each_close_at_scales("adjoint", &row, &expected, &scales, Tol::ulps(64.0));
            truncation = truncation.max((expected[0] - exact.by_start()[4 * i]).abs() / largest);
        }
        assert!(1e-7 < truncation, "{truncation:e}");
    }
    check::<DormandPrincePair>();
    check::<VernerPair>();
}
