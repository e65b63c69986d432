//! A rubber balloon: pressure over stretch, its limit points, the states under one pressure, and its oscillation.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::solids::isochoric::MooneyRivlin;
use piola::solutions::dynamics::{RadialOscillation, RadialState};
use piola::solutions::families::Orientation;
use piola::solutions::loads::{Shell, SphereInflation};
use piola::solutions::{LoadCurve, SolutionsError};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (c10, c01) = (0.5e6, 0.03e6);
    let rubber = MooneyRivlin::new(c10, c01)?;
    let (radius, thickness) = (0.05, 0.0005);
    let shell = Shell::new(radius, radius + thickness)?;
    let balloon = SphereInflation { shell, law: &rubber, orientation: Orientation::Kept };
    let range = (1.0, 10.0);

    println!("stretch   pressure, Pa");
    for point in balloon.trace(range, 12)? {
        println!("{:7.3}   {:12.1}", point.parameter, point.load);
        // The membrane: p = 4 (h/R) (1/λ − 1/λ⁷)(C₁₀ + C₀₁ λ²).
        let x = point.parameter;
        let membrane = 4.0 * thickness / radius * (1.0 / x - x.powi(-7)) * (c10 + c01 * x * x);
        assert!((point.load - membrane).abs() <= 0.05 * membrane);
    }

    let limits = balloon.limit_points(range)?;
    for limit in &limits {
        println!("limit point at λ = {:.6}: p = {:.3} Pa", limit.parameter, limit.load);
    }
    assert_eq!(limits.len(), 2);

    let pressure = 0.5 * (limits[0].load + limits[1].load);
    let states = balloon.states_at(pressure, range)?;
    for state in &states {
        let kind = if 0.0 < state.slope { "stable" } else { "unstable" };
        println!("p = {pressure:.3} Pa at λ = {:.6}, {kind}", state.parameter);
    }
    assert_eq!(states.len(), 3);

    // Beyond the first limit point there is no state nearby.
    match balloon.states_at(1.05 * limits[0].load, (1.0, limits[1].parameter)) {
        Err(SolutionsError::BeyondLimitPoint { limit, at, .. }) => {
            println!("5 % more is beyond the limit {limit:.3} Pa at λ = {at:.6}");
        }
        other => panic!("{other:?}"),
    }

    // Let go at λ = 1.1 without pressure, it oscillates.
    let free = RadialOscillation { body: balloon, density: 1000.0, pressure: 0.0 };
    let orbit = free.orbit(RadialState { stretch: 1.1, rate: 0.0 }, (0.5, 2.0))?;
    let [low, high] = orbit.turning_points;
    println!(
        "without pressure it oscillates between λ = {low:.6} and {high:.6} with the period {:.3e} s",
        orbit.period
    );
    // Small oscillations of the membrane: ω² = 12 μ/(ρ R²), μ = 2 (C₁₀ + C₀₁).
    let membrane = core::f64::consts::TAU * (1000.0 * radius * radius / (24.0 * (c10 + c01))).sqrt();
    assert!((orbit.period / membrane - 1.0).abs() < 0.1);
    Ok(())
}
