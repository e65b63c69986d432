//! Intervals by profile likelihood and by the bootstrap, of every kind of fit.

use core::cell::Cell;
use core::error::Error;

use piola_fit::fluids::{FlowData, Options, fit_flow, fit_flow_until};
use piola_fit::history::{
    HistoryModel, HistoryOptions, HistoryParameter, HistoryTest, StepControl, fit_history, fit_history_until,
};
use piola_fit::nonlinear::{NonlinearData, NonlinearFlow, NonlinearModel, ShearResponse, fit_nonlinear};
use piola_fit::sides::Loading;
use piola_fit::solids::{AnyModel, Data, Measure, Table, Test, fit};
use piola_fit::{FitError, Intervals, Outcome};
use piola_fluids::PowerLaw;
use piola_testkit::NormalNoise;

type Fallible = Result<(), Box<dyn Error>>;

const BOOTSTRAP: Intervals = Intervals::Bootstrap { samples: 400, seed: 1 };

#[test]
fn kinds_of_intervals_are_read_by_name() {
    assert_eq!("linear".parse(), Ok(Intervals::Linear));
    assert_eq!("profile".parse(), Ok(Intervals::Profile));
    assert_eq!("bootstrap".parse(), Ok(Intervals::Bootstrap { samples: 1000, seed: 0 }));
    assert_eq!("bootstrap:500".parse(), Ok(Intervals::Bootstrap { samples: 500, seed: 0 }));
    for text in ["", "profile:3", "bootstrap:", "bootstrap:199", "bootstrap:100001", "bootstrap:-5", "jackknife"] {
        assert!(matches!(text.parse::<Intervals>(), Err(FitError::UnknownIntervals { .. })), "{text}");
    }
}

/// Six rows and two parameters: quantiles of resamples alone would be a third too narrow.
#[test]
fn bootstrap_intervals_of_few_rows_hold_the_truth_as_often_as_they_say() -> Fallible {
    let mut normal = NormalNoise(12);
    let options = Options { intervals: Intervals::Bootstrap { samples: 400, seed: 3 }, ..Options::default() };
    let (trials, mut held) = (250, 0);
    for _ in 0..trials {
        let rates = (0..6).map(|i| (1.2 * f64::from(i) - 3.0).exp());
        let rows: Vec<[f64; 2]> = rates.map(|k| [k, 3.0 * k.sqrt() * (1.0 + 0.02 * normal.draw())]).collect();
        let fit = fit_flow::<PowerLaw, 2>(&[FlowData::flow_curve(&rows)?], &[[2.0, 0.6]], &options)?;
        for (parameter, truth) in fit.parameters.iter().zip([3.0, 0.5]) {
            let [low, high] = parameter.interval.ok_or("determined")?;
            held += u32::from(low <= truth && truth <= high);
        }
    }
    // 475 ± 5 of 500.
    assert!((455..=495).contains(&held), "{held}");
    Ok(())
}

/// Stress = p · amount: linear in p.
struct Linear;

impl HistoryModel for Linear {
    fn name(&self) -> String {
        "linear".to_owned()
    }
    fn parameters(&self) -> Vec<HistoryParameter> {
        vec![("modulus", true, [f64::NEG_INFINITY, f64::INFINITY])]
    }
    fn stresses(&self, p: &[f64], test: &HistoryTest, _control: &StepControl) -> Result<Vec<f64>, FitError> {
        Ok(test.rows().iter().map(|row| p[0] * row[1]).collect())
    }
}

/// A linear interval, the same by profile (whose end is found to 1e-4 of its width) and by bootstrap.
fn assert_agree(linear: [f64; 2], profile: [f64; 2], bootstrap: [f64; 2]) {
    let width = linear[1] - linear[0];
    for k in 0..2 {
        assert!((profile[k] - linear[k]).abs() < 1e-3 * width, "{linear:?} {profile:?}");
        // 400 samples tell a quantile to some 7 % of the half width; normal residuals are few.
        assert!((bootstrap[k] - linear[k]).abs() < 0.2 * width, "{linear:?} {bootstrap:?}");
    }
}

#[test]
fn intervals_of_a_linear_law_with_history_agree() -> Fallible {
    let mut normal = NormalNoise(4);
    let rows: Vec<[f64; 3]> = (1..31).map(f64::from).map(|k| [k, 0.1 * k, 0.2 * k + 0.05 * normal.draw()]).collect();
    let tests = [HistoryTest::new("t", Loading::SimpleShear, &rows)?];
    let interval = |intervals| -> Result<[f64; 2], Box<dyn Error>> {
        let mut options = HistoryOptions::default();
        options.intervals = intervals;
        let found = fit_history(&Linear, &tests, &[1.0], &options)?;
        Ok(found.parameters[0].interval.ok_or("determined")?)
    };
    assert_agree(interval(Intervals::Linear)?, interval(Intervals::Profile)?, interval(BOOTSTRAP)?);
    Ok(())
}

#[test]
fn intervals_of_a_linear_solid_agree() -> Fallible {
    let mut normal = NormalNoise(5);
    let stretches = (1..31).map(|k| 1.0 + 0.05 * f64::from(k));
    let rows = stretches.map(|x| [x, 2.0 * (x - 1.0 / (x * x)) * (1.0 + 0.02 * normal.draw())]).collect();
    let data = Data::new(vec![Test::new("bar", Table::Uniaxial(rows), Measure::FirstPiola)?])?;
    let interval = |intervals| -> Result<[f64; 2], Box<dyn Error>> {
        let options = piola_fit::solids::Options { intervals, ..piola_fit::solids::Options::default() };
        let found = fit(&AnyModel::NeoHookean, &data, &options)?;
        Ok(found.parameters[0].interval.ok_or("determined")?)
    };
    let linear = interval(Intervals::Linear)?;
    let (profile, bootstrap) = (interval(Intervals::Profile)?, interval(BOOTSTRAP)?);
    let width = linear[1] - linear[0];
    assert!((0..2).all(|k| (profile[k] - linear[k]).abs() < 0.02 * width), "{linear:?} {profile:?}");
    assert!((0..2).all(|k| (bootstrap[k] - linear[k]).abs() < 0.2 * width), "{linear:?} {bootstrap:?}");
    Ok(())
}

/// N₁ = 2 ηₚ λ k² and τ = (ηₛ + ηₚ) k: nearly linear in the logarithms.
#[test]
fn intervals_of_a_viscoelastic_fluid_agree() -> Fallible {
    let mut normal = NormalNoise(6);
    let mut rows = |answer: &dyn Fn(f64) -> f64| -> Vec<[f64; 2]> {
        let drives = (0..12).map(|i| 0.25 * 2.0_f64.powi(i));
        drives.map(|x| [x, answer(x) * (1.0 + 0.01 * normal.draw())]).collect()
    };
    let normal_stress = NonlinearFlow::SteadyShear(ShearResponse::FirstNormalStressDifference);
    let start = NonlinearFlow::ShearStartUp { shear_rate: 1.0, response: ShearResponse::ShearStress };
    let data = [
        NonlinearData::new(normal_stress, rows(&|k| 16.0 * k * k))?,
        NonlinearData::new(start, rows(&|t| 1.0 + 2.0 * (1.0 - (-t / 4.0).exp())))?,
    ];
    let interval = |intervals| -> Result<[f64; 2], Box<dyn Error>> {
        let options = piola_fit::nonlinear::Options { intervals, ..piola_fit::nonlinear::Options::default() };
        let found = fit_nonlinear(NonlinearModel::OldroydB, &data, &options)?;
        Ok(found.parameters[1].interval.ok_or("determined")?)
    };
    let linear = interval(Intervals::Linear)?;
    let (profile, bootstrap) =
        (interval(Intervals::Profile)?, interval(Intervals::Bootstrap { samples: 200, seed: 1 })?);
    let width = linear[1] - linear[0];
    assert!((0..2).all(|k| (profile[k] - linear[k]).abs() < 0.1 * width), "{linear:?} {profile:?}");
    assert!((0..2).all(|k| (bootstrap[k] - linear[k]).abs() < 0.25 * width), "{linear:?} {bootstrap:?}");
    Ok(())
}

/// Errors that keep their sign over four rows: blocks keep them together, and intervals of independent errors are too narrow.
#[test]
fn blocks_widen_the_intervals_of_correlated_errors() -> Fallible {
    let mut normal = NormalNoise(8);
    let mut error = 0.0;
    let rows: Vec<[f64; 2]> = (0..60)
        .map(|i| {
            error = 0.85 * error + 0.02 * normal.draw();
            let k = (0.1 * f64::from(i) - 3.0).exp();
            [k, 3.0 * k.sqrt() * (1.0 + error)]
        })
        .collect();
    let data = [FlowData::flow_curve(&rows)?];
    let options = Options { intervals: BOOTSTRAP, ..Options::default() };
    let found = fit_flow::<PowerLaw, 2>(&data, &[[2.0, 0.6]], &options)?;
    let widening = found.autocorrelation.ok_or("59 pairs")?.widening;
    assert!(1.5 < widening, "{widening}");
    for parameter in &found.parameters {
        let [low, high] = parameter.interval.ok_or("determined")?;
        let independent = 2.0 * 2.0 * parameter.standard_error.ok_or("determined")?;
        // Blocks alone would be a quarter too narrow.
        let ratio = (high - low) / (widening * independent);
        assert!(0.85 < ratio && ratio < 1.25, "{ratio} {parameter:?}");
    }
    let of_seed = |seed| -> Result<Vec<Option<[f64; 2]>>, FitError> {
        let options = Options { intervals: Intervals::Bootstrap { samples: 400, seed }, ..Options::default() };
        let found = fit_flow::<PowerLaw, 2>(&data, &[[2.0, 0.6]], &options)?;
        Ok(found.parameters.iter().map(|parameter| parameter.interval).collect())
    };
    let seeded: Vec<_> = found.parameters.iter().map(|parameter| parameter.interval).collect();
    assert_eq!(of_seed(1)?, seeded);
    assert_ne!(of_seed(2)?, seeded);
    Ok(())
}

/// Intervals of the linear law with history.
fn of_linear(tests: &[HistoryTest], intervals: Intervals, confidence: f64) -> Result<[f64; 2], Box<dyn Error>> {
    let mut options = HistoryOptions::default();
    (options.intervals, options.confidence) = (intervals, confidence);
    Ok(fit_history(&Linear, tests, &[1.0], &options)?.parameters[0].interval.ok_or("determined")?)
}

fn assert_near(bootstrap: [f64; 2], linear: [f64; 2]) {
    let width = linear[1] - linear[0];
    assert!((0..2).all(|k| (bootstrap[k] - linear[k]).abs() < 0.2 * width), "{linear:?} {bootstrap:?}");
}

#[test]
fn tests_of_one_row_and_tests_that_are_misfitted_as_wholes_draw_from_all_residuals() -> Fallible {
    let mut normal = NormalNoise(9);
    let row = |k: f64, error: f64| [k, 0.1 * k, 0.2 * k + error];
    let mut single = Vec::new();
    for k in 1..31_u32 {
        // The largest stress of a test is its own: errors over it are alike.
        let stress = 0.2 * f64::from(k);
        let rows = [row(f64::from(k), 0.02 * stress * normal.draw())];
        single.push(HistoryTest::new(k.to_string(), Loading::SimpleShear, &rows)?);
    }
    assert_near(of_linear(&single, BOOTSTRAP, 0.95)?, of_linear(&single, Intervals::Linear, 0.95)?);
    let mut misfitted = Vec::new();
    for (name, error) in [("above", 0.05), ("below", -0.05)] {
        let rows: Vec<_> = (1..21).map(|k| row(f64::from(k), error + 0.002 * normal.draw())).collect();
        misfitted.push(HistoryTest::new(name, Loading::SimpleShear, &rows)?);
    }
    assert_near(of_linear(&misfitted, BOOTSTRAP, 0.95)?, of_linear(&misfitted, Intervals::Linear, 0.95)?);
    Ok(())
}

#[test]
fn bootstrap_intervals_reach_beyond_the_samples_where_the_confidence_does() -> Fallible {
    let mut normal = NormalNoise(4);
    let rows: Vec<[f64; 3]> = (1..31).map(f64::from).map(|k| [k, 0.1 * k, 0.2 * k + 0.05 * normal.draw()]).collect();
    let tests = [HistoryTest::new("t", Loading::SimpleShear, &rows)?];
    assert_near(of_linear(&tests, BOOTSTRAP, 0.9999)?, of_linear(&tests, Intervals::Linear, 0.9999)?);
    Ok(())
}

#[test]
fn numbers_of_samples_that_no_bootstrap_has_are_refused() -> Fallible {
    let rows: Vec<[f64; 3]> = (1..4).map(f64::from).map(|k| [k, 0.1 * k, 0.2 * k]).collect();
    let flow: Vec<[f64; 2]> = (1..4).map(f64::from).map(|k| [k, k]).collect();
    for samples in [0, 199, 100_001, usize::MAX] {
        let intervals = Intervals::Bootstrap { samples, seed: 0 };
        let tests = [HistoryTest::new("t", Loading::SimpleShear, &rows)?];
        let told = of_linear(&tests, intervals, 0.95).expect_err("no such bootstrap").to_string();
        assert!(told.starts_with(&format!("no intervals are called `bootstrap:{samples}`")), "{told}");
        let options = Options { intervals, ..Options::default() };
        let refused = fit_flow::<PowerLaw, 2>(&[FlowData::flow_curve(&flow)?], &[[1.0, 1.0]], &options);
        assert!(matches!(refused, Err(FitError::UnknownIntervals { .. })));
    }
    Ok(())
}

/// An interval and the outcome of a fit that is stopped when it asks for the so manieth time, and how often it asked.
type Stopped<'f> = &'f dyn Fn(Intervals, u32) -> Result<([f64; 2], Outcome, u32), Box<dyn Error>>;

/// Linear intervals stay where the search of others is stopped.
fn assert_linear_stay(fit: Stopped<'_>) -> Fallible {
    let (linear, _, asked) = fit(Intervals::Linear, u32::MAX)?;
    for intervals in [Intervals::Profile, BOOTSTRAP] {
        for more in [1, 5, 30] {
            let (stopped, outcome, _) = fit(intervals, asked + more)?;
            // A profile of few parameters may end before.
            assert!(outcome == Outcome::Interrupted || more != 1, "{intervals:?}");
            assert!(
                outcome != Outcome::Interrupted || stopped.map(f64::to_bits) == linear.map(f64::to_bits),
                "{intervals:?} {more}: {stopped:?} {linear:?}"
            );
        }
    }
    Ok(())
}

#[test]
fn linear_intervals_stay_where_others_are_interrupted() -> Fallible {
    let mut normal = NormalNoise(4);
    let rows: Vec<[f64; 3]> = (1..31).map(f64::from).map(|k| [k, 0.1 * k, 0.2 * k + 0.05 * normal.draw()]).collect();
    let tests = [HistoryTest::new("t", Loading::SimpleShear, &rows)?];
    assert_linear_stay(&|intervals, most| {
        let asked = Cell::new(0);
        let stop = || most <= asked.replace(asked.get() + 1);
        let mut options = HistoryOptions::default();
        options.intervals = intervals;
        let found = fit_history_until(&Linear, &tests, &[1.0], &options, &stop)?;
        Ok((found.parameters[0].interval.ok_or("determined")?, found.outcome, asked.get()))
    })?;
    let flow: Vec<[f64; 2]> =
        (1..31).map(f64::from).map(|k| [k, 3.0 * k.sqrt() * (1.0 + 0.02 * normal.draw())]).collect();
    let data = [FlowData::flow_curve(&flow)?];
    assert_linear_stay(&|intervals, most| {
        let asked = Cell::new(0);
        let stop = || most <= asked.replace(asked.get() + 1);
        let options = Options { intervals, ..Options::default() };
        let found = fit_flow_until::<PowerLaw, 2>(&data, &[[2.0, 0.6]], &options, &stop)?;
        Ok((found.parameters[0].interval.ok_or("determined")?, found.outcome, asked.get()))
    })?;
    let stretches = (1..31).map(|k| 1.0 + 0.05 * f64::from(k));
    // Gent's law with the limit 20.
    let stiffer = |x: f64| 20.0 / (23.0 - x * x - 2.0 / x);
    let bar = stretches.map(|x| [x, 2.0 * stiffer(x) * (x - 1.0 / (x * x)) * (1.0 + 0.02 * normal.draw())]).collect();
    let bar = Data::new(vec![Test::new("bar", Table::Uniaxial(bar), Measure::FirstPiola)?])?;
    assert_linear_stay(&|intervals, most| {
        let asked = Cell::new(0);
        let stop = || most <= asked.replace(asked.get() + 1);
        let options = piola_fit::solids::Options { intervals, ..piola_fit::solids::Options::default() };
        let found = AnyModel::Gent.fit_until(&bar, &options, &stop)?;
        Ok((found.parameters[0].interval.ok_or("determined")?, found.outcome, asked.get()))
    })
}
