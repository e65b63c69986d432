//! Intervals by profile likelihood and by the bootstrap, of every kind of fit.

use core::error::Error;

use piola_fit::fluids::{FlowData, Options, fit_flow};
use piola_fit::history::{HistoryModel, HistoryOptions, HistoryParameter, HistoryTest, StepControl, fit_history};
use piola_fit::nonlinear::{NonlinearData, NonlinearFlow, NonlinearModel, ShearResponse, fit_nonlinear};
use piola_fit::sides::Loading;
use piola_fit::solids::{AnyModel, Data, Measure, Table, Test, fit};
use piola_fit::{FitError, Intervals};
use piola_fluids::PowerLaw;
use piola_testkit::{NormalNoise, Tol, assert_close};

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
        assert!(1.3 * independent < high - low && high - low < 2.0 * widening * independent, "{parameter:?}");
    }
    assert_close(
        "seeded",
        &[found.squares],
        &[fit_flow::<PowerLaw, 2>(&data, &[[2.0, 0.6]], &options)?.squares],
        Tol::ulps(1.0),
    );
    Ok(())
}
