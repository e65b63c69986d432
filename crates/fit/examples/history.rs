//! Parameters of laws with history from the independent tables of `testdata/golden/history_tables.json`, and how far they are off.
//!
//! ```sh
//! cargo run --release -p piola-fit --features history --example history
//! ```

#![expect(clippy::print_stdout, reason = "prints a table")]

use std::error::Error;
use std::time::Instant;

use piola_fit::history::{AnyHistoryModel, HistoryModel, HistoryOptions, HistoryTest, fit_history};
use piola_fit::sides::Loading;
use piola_inelastic::StepControl;
use serde_json::Value;

/// What a simple shear does not tell.
const HELD: [&str; 4] = ["first_lame_parameter", "overstress_first_lame_parameter", "stress", "perturbation"];

fn main() -> Result<(), Box<dyn Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../testdata/golden/history_tables.json");
    let file: Value = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let cases = file["cases"].as_array().ok_or("no cases")?;
    println!(
        "| model | rows | parameters sought | largest relative error | evaluations | s |\n|---|---|---|---|---|---|"
    );
    for model in AnyHistoryModel::ALL {
        let (mut tests, mut made) = (Vec::new(), Vec::new());
        for case in cases.iter().filter(|case| case["law"] == model.to_string()) {
            let rows = case["input"]["rows"].as_array().ok_or("no rows")?;
            let stresses = case["output"]["P12"].as_array().ok_or("no stresses")?;
            let rows = rows.iter().zip(stresses).map(|(row, stress)| {
                let stress = stress.as_str().and_then(|text| text.parse().ok());
                Some([row[0].as_f64()?, row[1].as_f64()?, stress?])
            });
            let rows = rows.collect::<Option<Vec<_>>>().ok_or("no numbers")?;
            tests.push(HistoryTest::new(case["id"].as_str().unwrap_or_default(), Loading::SimpleShear, &rows)?);
            made = parameters(model, &case["params"])?;
        }
        let mut options = HistoryOptions::default().with_control(StepControl::new(1e-12)?);
        for ((name, _, _), value) in model.parameters().iter().zip(&made).filter(|((name, ..), _)| HELD.contains(name))
        {
            options = options.with_bounds(name, [*value; 2]);
        }
        let start: Vec<f64> = made.iter().map(|value| 1.2 * value).collect();
        let begin = Instant::now();
        let fit = fit_history(&model, &tests, &start, &options)?;
        let seconds = begin.elapsed().as_secs_f64();
        let error = fit.values().iter().zip(&made).map(|(found, made)| (found / made - 1.0).abs()).fold(0.0, f64::max);
        let rows: usize = tests.iter().map(|test| test.rows().len()).sum();
        let sought = made.len() - options.bounds.len();
        println!("| `{model}` | {rows} | {sought} | {error:.1e} | {} | {seconds:.2} |", fit.evaluations);
    }
    Ok(())
}

/// The parameters that made a table, in the order of the model.
fn parameters(model: AnyHistoryModel, written: &Value) -> Result<Vec<f64>, Box<dyn Error>> {
    let of_spring = |key: &str, spring: usize| written[key].get(spring).unwrap_or(&written[key]).as_f64();
    let of = |(name, _, _): &(&str, bool, [f64; 2])| match *name {
        "shear_modulus" => of_spring("mu", 0),
        "first_lame_parameter" => of_spring("lambda", 0),
        "overstress_shear_modulus" => of_spring("mu", 1),
        "overstress_first_lame_parameter" => of_spring("lambda", 1),
        other => written[other].as_f64(),
    };
    Ok(model.parameters().iter().map(of).collect::<Option<Vec<_>>>().ok_or("a parameter is missing")?)
}
