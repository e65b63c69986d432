//! Parameters from measurements: a law of rubber from a bar that was pulled, a fluid from its flow curve.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::fit::fluids as flow;
use piola::fit::fluids::{FlowData, fit_flow};
use piola::fit::solids::{AnyModel, Data, Measure, Options, Table, Test, fit};
use piola::fluids::PowerLaw;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // First Piola–Kirchhoff stresses 2 (λ − λ⁻²)(C₁₀ + C₀₁/λ) of C₁₀ = 0.3, C₀₁ = 0.1 MPa, rounded to four decimals.
    let bar = Table::Uniaxial(vec![[1.25, 0.4636], [1.5, 0.7741], [2.0, 1.2250], [3.0, 1.9259], [4.0, 2.5594]]);
    let data = Data::new(vec![Test::new("bar", bar, Measure::FirstPiola)?])?;
    let rubber = fit(&AnyModel::MooneyRivlin, &data, &Options::default())?;
    for (parameter, by_hand) in rubber.parameters.iter().zip([0.3, 0.1]) {
        println!("{} = {:.5} MPa", parameter.name, parameter.value);
        assert!((parameter.value - by_hand).abs() < 2e-4);
    }
    assert!(rubber.outcome.is_converged() && rubber.stability.is_stable());

    // τ = 3 √k: the exponent and the consistency of a power law.
    let curve = FlowData::flow_curve(&[[1.0, 3.0], [4.0, 6.0], [9.0, 9.0], [100.0, 30.0]])?;
    let fluid = fit_flow::<PowerLaw, 2>(&[curve], &[[1.0, 1.0]], &flow::Options::default())?.fluid;
    println!("τ = {:.6} k^{:.6}", fluid.consistency(), fluid.exponent());
    assert!((fluid.consistency() - 3.0).abs() < 1e-10 && (fluid.exponent() - 0.5).abs() < 1e-10);
    Ok(())
}
