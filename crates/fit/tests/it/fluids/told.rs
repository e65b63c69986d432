//! Parameters at their bounds, parameters that nothing tells, and intervals by profile likelihood.

use piola_fit::fluids::{FlowData, FluidFit, Intervals, Options, Outcome, State, fit_flow, fit_flow_until};
use piola_fluids::{CarreauYasuda, Ellis, HerschelBulkley, PowerLaw};
use piola_testkit::{Tol, assert_close};

/// Twenty rates, with errors that alternate by a percent.
fn curve(stress: impl Fn(f64) -> f64) -> FlowData {
    let signs = [1.0, -0.6, 0.3, -1.2, 0.9, 0.1, -0.8, 0.5, -0.2, 0.7];
    let rows: Vec<_> = (0..20_u32)
        .map(|i| {
            let k = 0.1 * f64::from(i).mul_add(0.35, 0.0).exp();
            [k, stress(k) * (1.0 + 0.01 * signs[i as usize % 10] * if i < 10 { 1.0 } else { -1.0 })]
        })
        .collect();
    FlowData::flow_curve(&rows).expect("data")
}

fn herschel_bulkley(data: &FlowData, options: &Options) -> FluidFit<HerschelBulkley> {
    let starts = [[0.1, 1.0, 1.0], [0.01, 3.0, 0.6]];
    fit_flow::<HerschelBulkley, 3>(core::slice::from_ref(data), &starts, options).expect("a fit")
}

#[test]
fn a_yield_stress_that_the_data_do_not_ask_for_is_at_its_bound() {
    // A power law with a slight downturn asks for less than no yield stress.
    let found = herschel_bulkley(&curve(|k| 3.0 * k.sqrt() - 0.02), &Options::default());
    let yields = &found.parameters[0];
    assert_eq!((yields.state, yields.standard_error), (State::AtBound, None));
    let [low, high] = yields.interval.expect("from the bound");
    assert!(low.abs() <= 0.0 && 1e-3 < high && high < 0.2, "{high}");
    assert_eq!(found.degrees_of_freedom, 18);
    // The others are those of the power law.
    let power = fit_flow::<PowerLaw, 2>(&[curve(|k| 3.0 * k.sqrt() - 0.02)], &[[1.0, 1.0]], &Options::default());
    let errors = |k: usize| power.as_ref().expect("a fit").parameters[k].standard_error.expect("told");
    for k in [0, 1] {
        let tolerance = Tol::stated(1e-4, "the yield stress is small, not none");
        assert_close("error", &[found.parameters[k + 1].standard_error.expect("told")], &[errors(k)], tolerance);
    }
}

#[test]
fn no_interval_of_a_positive_parameter_reaches_below_zero() {
    for intervals in [Intervals::Linear, Intervals::Profile] {
        let options = Options { intervals, ..Options::default() };
        for yields in [0.0, 0.01, 0.03, 0.1, 1.0] {
            let found = herschel_bulkley(&curve(|k| yields + 3.0 * k.sqrt()), &options);
            for parameter in &found.parameters {
                if let Some([low, high]) = parameter.interval {
                    assert!(0.0 <= low && low <= high, "{intervals:?} {yields}: {parameter:?}");
                }
            }
        }
    }
}

#[test]
fn profile_and_linear_intervals_agree_where_parameters_are_well_determined() {
    let of =
        |intervals| herschel_bulkley(&curve(|k| 1.0 + 3.0 * k.sqrt()), &Options { intervals, ..Options::default() });
    let (linear, profile) = (of(Intervals::Linear), of(Intervals::Profile));
    for (a, b) in linear.parameters.iter().zip(&profile.parameters) {
        let ([low, high], [from, to]) = (a.interval.expect("told"), b.interval.expect("told"));
        let width = high - low;
        assert!((low - from).abs() < 0.1 * width && (high - to).abs() < 0.1 * width, "{a:?} {b:?}");
    }
}

#[test]
fn parameters_of_which_not_even_the_size_is_told_are_not_determined() {
    // A power law has no plateau at small rates: any large viscosity does.
    let data = [curve(|k| 3.0 * k.sqrt())];
    let found = fit_flow::<Ellis, 3>(&data, &[[10.0, 1.0, 2.0]], &Options::default()).expect("a fit");
    let plateau = &found.parameters[0];
    assert_eq!((plateau.state, plateau.interval), (State::Undetermined, None), "{plateau:?}");
}

#[test]
fn repeated_rows_count_and_thousands_of_rows_give_the_same_fluid() {
    let stress = |k: f64| 8.0 * k * (1.0 + (2.0 * k).powi(2)).powf(-0.3) + 0.01 * k;
    let rows: Vec<_> = (0..4000).map(|i| 1e-2 * (0.0025 * f64::from(i)).exp()).map(|k| [k, stress(k)]).collect();
    let data = FlowData::flow_curve(&rows).expect("data");
    let start = [10.0, 0.02, 1.0, 0.5, 1.5];
    let found = fit_flow::<CarreauYasuda, 5>(&[data], &[start], &Options::default()).expect("a fit");
    let values: Vec<f64> = found.parameters.iter().map(|parameter| parameter.value).collect();
    assert_close(
        "parameters",
        &values,
        &[8.01, 0.01, 2.0, 0.4, 2.0],
        Tol::stated(1e-5, "the root of the rounding of S"),
    );
    let twice: Vec<_> = [[1.0, 2.9], [1.0, 3.1], [4.0, 5.9], [4.0, 6.1], [9.0, 9.0]].to_vec();
    let data = FlowData::flow_curve(&[]).and_then(|data| data.with_rows(twice)).expect("data");
    let found = fit_flow::<PowerLaw, 2>(&[data], &[[1.0, 1.0]], &Options::default()).expect("a fit");
    assert_eq!((found.degrees_of_freedom, found.residuals[0].len()), (3, 5));
}

#[test]
fn a_search_that_is_stopped_returns_its_best_until_then() {
    let count = core::cell::Cell::new(0);
    let stop = || {
        count.set(count.get() + 1);
        5 < count.get()
    };
    let data = [curve(|k| 1.0 + 3.0 * k.sqrt())];
    let found = fit_flow_until::<HerschelBulkley, 3>(&data, &[[0.1, 1.0, 1.0]], &Options::default(), &stop);
    assert_eq!(found.expect("a fit").outcome, Outcome::Interrupted);
}
