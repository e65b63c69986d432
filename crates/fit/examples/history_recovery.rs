//! How often fits of laws with history come to the best optimum of noisy tables, from the starts that the tables give.
//!
//! ```sh
//! cargo run --release -p piola-fit --features history --example history_recovery -- 20
//! ```
//! The argument is the number of tables of each law. Each stress has normal noise of 1 % of the largest. The metals' first row is beyond
//! their yield stress. A fit counts if its sum of squares exceeds by at most 1 % the least that is found, from the starts or from the
//! parameters that made the table. The kinematic hardening is a law of one's own.

#![expect(clippy::print_stdout, reason = "prints a table")]

use std::error::Error;
use std::time::Instant;

use piola_fit::FitError;
use piola_fit::history::{
    AnyHistoryModel, HistoryModel, HistoryOptions, HistoryParameter, HistoryTest, fit_history, fit_history_of_starts,
    follow,
};
use piola_fit::sides::Loading;
use piola_inelastic::{Hardening, Kinematic, StepControl};
use piola_solids::Hencky;
use piola_testkit::NormalNoise;

/// A law whose first Lamé parameters are multiples of the shear moduli before them.
struct Tied<'m> {
    model: &'m dyn HistoryModel,
    ratio: f64,
}

impl Tied<'_> {
    fn tied(&self, values: &[f64]) -> Vec<f64> {
        let mut values = values.to_vec();
        for (k, (name, ..)) in self.model.parameters().iter().enumerate() {
            if name.ends_with("first_lame_parameter") {
                values[k] = self.ratio * values[k - 1];
            }
        }
        values
    }
}

impl HistoryModel for Tied<'_> {
    fn name(&self) -> String {
        self.model.name()
    }
    fn parameters(&self) -> Vec<HistoryParameter> {
        self.model.parameters()
    }
    fn stresses(&self, p: &[f64], test: &HistoryTest, control: &StepControl) -> Result<Vec<f64>, FitError> {
        self.model.stresses(&self.tied(p), test, control)
    }
}

/// Armstrong and Frederick's hardening of Hencky's metal.
struct Moving;

const POSITIVE: [f64; 2] = [0.0, f64::INFINITY];

impl HistoryModel for Moving {
    fn name(&self) -> String {
        "kinematic hardening".to_owned()
    }
    fn parameters(&self) -> Vec<HistoryParameter> {
        vec![
            ("shear_modulus", true, POSITIVE),
            ("first_lame_parameter", true, POSITIVE),
            ("yield_stress", true, POSITIVE),
            ("back_modulus", true, POSITIVE),
            ("recovery", false, POSITIVE),
        ]
    }
    fn stresses(&self, p: &[f64], test: &HistoryTest, control: &StepControl) -> Result<Vec<f64>, FitError> {
        let &[mu, lambda, yield_stress, back, recovery] = p else {
            return Err(FitError::NumberOfValues { model: self.name(), parameters: 5, values: p.len() });
        };
        let hardening = Hardening { yield_stress, linear: 0.0, saturation: yield_stress, saturation_exponent: 0.0 };
        follow(
            &Kinematic::new(Hencky::new(lambda, mu)?, Hencky::new(0.0, back)?, hardening, recovery, 0.0)?,
            test,
            control,
        )
    }
}

impl Moving {
    /// Those of the viscoplastic law: the back stress tends to 1/β and begins with 3 c.
    fn starts(tests: &[HistoryTest]) -> Vec<Vec<f64>> {
        let starts = AnyHistoryModel::Viscoplastic.starts(tests);
        let of = |start: &Vec<f64>| {
            let [mu, lambda, yields, _, saturates, exponent, _] = start[..] else { return Vec::new() };
            let grows = (saturates - yields).max(0.1 * yields);
            vec![mu, lambda, yields, grows * exponent / 3.0, 1.0 / grows]
        };
        starts.iter().map(of).collect()
    }
}

/// Rows of time and deformation of a path through turning points at a rate.
fn path(from: f64, turns: &[f64], rate: f64, step: f64) -> Vec<[f64; 3]> {
    let (mut rows, mut t, mut x) = (Vec::new(), 0.0, from);
    for &turn in turns {
        let count = ((turn - x).abs() / step).ceil().max(1.0);
        let begin = x;
        for k in 1..=20 {
            if count < f64::from(k) {
                break;
            }
            let next = begin + (turn - begin) * f64::from(k) / count;
            t += (next - x).abs() / rate;
            x = next;
            rows.push([t, x, 0.0]);
        }
    }
    rows
}

struct Case {
    title: &'static str,
    model: Box<dyn HistoryModel>,
    ratio: f64,
    made: Vec<f64>,
    tests: Vec<HistoryTest>,
    held: Vec<&'static str>,
}

fn cases() -> Result<Vec<Case>, FitError> {
    let bar = |name: &str, turns: &[f64], rate: f64, step: f64| {
        HistoryTest::new(name, Loading::Uniaxial, &path(1.0, turns, rate, step))
    };
    Ok(vec![
        Case {
            title: "J₂ viscoplasticity, two rates, one unloading",
            model: Box::new(AnyHistoryModel::Viscoplastic),
            ratio: 1.5,
            made: vec![80e3, 120e3, 250.0, 300.0, 400.0, 25.0, 2e3],
            tests: vec![bar("slow", &[1.08, 1.078, 1.1], 1e-3, 0.01)?, bar("fast", &[1.08, 1.078, 1.1], 3e-2, 0.01)?],
            held: vec!["first_lame_parameter"],
        },
        Case {
            title: "J₂ viscoplasticity, two rates, no unloading",
            model: Box::new(AnyHistoryModel::Viscoplastic),
            ratio: 1.5,
            made: vec![80e3, 120e3, 250.0, 300.0, 400.0, 25.0, 2e3],
            tests: vec![bar("slow", &[1.1], 1e-3, 0.006)?, bar("fast", &[1.1], 3e-2, 0.006)?],
            held: vec!["first_lame_parameter"],
        },
        Case {
            title: "kinematic hardening, two cycles",
            model: Box::new(Moving),
            ratio: 1.5,
            made: vec![80e3, 120e3, 200.0, 5e3, 0.008],
            tests: vec![bar("cycles", &[1.02, 0.98, 1.03, 0.99], 1e-3, 0.004)?],
            held: vec!["first_lame_parameter"],
        },
        Case {
            title: "Bergström and Boyce's rubber, three rates and a hold",
            model: Box::new(AnyHistoryModel::BergstromBoyce),
            ratio: 100.0,
            made: vec![0.5, 50.0, 0.9, 90.0, 1.0, 1.2, 4.0, -0.5, 0.01],
            tests: vec![
                HistoryTest::new("slow", Loading::Uniaxial, &path(1.0, &[1.6, 1.1], 0.01, 0.1))?,
                HistoryTest::new("fast", Loading::Uniaxial, &path(1.0, &[1.6, 1.1], 1.0, 0.1))?,
                HistoryTest::new("hold", Loading::Uniaxial, &hold())?,
            ],
            held: vec!["first_lame_parameter", "overstress_first_lame_parameter", "rate", "perturbation"],
        },
    ])
}

/// Pulled fast to half as long again and held.
fn hold() -> Vec<[f64; 3]> {
    let times = [0.25, 0.5, 1.0, 2.0, 5.0, 10.0, 30.0, 100.0];
    times.iter().map(|t| [*t, 1.0 + 0.5 * (t / 0.5_f64).min(1.0), 0.0]).collect()
}

fn main() -> Result<(), Box<dyn Error>> {
    let tables: u32 = std::env::args().nth(1).map_or(Ok(20), |text| text.parse())?;
    let mut normal = NormalNoise(20_261_127);
    let control = StepControl::new(1e-6)?;
    println!("| law | tables | at the optimum | s for each fit |\n|---|---|---|---|");
    for Case { title, model, ratio, made, tests, held } in cases()? {
        let law = Tied { model: model.as_ref(), ratio };
        let exact: Vec<Vec<f64>> =
            tests.iter().map(|test| law.stresses(&made, test, &control)).collect::<Result<_, _>>()?;
        let (mut reached, mut seconds) = (0, 0.0);
        for _ in 0..tables {
            let mut noisy = Vec::new();
            for (test, stresses) in tests.iter().zip(&exact) {
                let largest = stresses.iter().map(|p| p.abs()).fold(0.0, f64::max);
                let rows: Vec<[f64; 3]> = test
                    .rows()
                    .iter()
                    .zip(stresses)
                    .map(|(row, stress)| [row[0], row[1], stress + 0.01 * largest * normal.draw()])
                    .collect();
                noisy.push(HistoryTest::new(test.name(), test.loading(), &rows)?);
            }
            let options = HistoryOptions::default().with_control(control);
            let starts = match law.name().parse::<AnyHistoryModel>() {
                Ok(model) => model.starts(&noisy),
                Err(_) => Moving::starts(&noisy),
            };
            let begin = Instant::now();
            let found = fit_history_of_starts(&law, &noisy, &starts, &held, &options, &|| false)?;
            seconds += begin.elapsed().as_secs_f64();
            let parameters = law.parameters();
            let fixed = parameters.iter().zip(&made).filter(|((name, ..), _)| held.contains(name));
            let options = fixed.fold(options, |options, ((name, ..), value)| options.with_bounds(name, [*value; 2]));
            let truth = fit_history(&law, &noisy, &made, &options)?;
            let least = found.weighted_squares.min(truth.weighted_squares);
            reached += u32::from(found.weighted_squares <= 1.01 * least);
        }
        println!("| {title} | {tables} | {reached} | {:.2} |", seconds / f64::from(tables));
    }
    Ok(())
}
