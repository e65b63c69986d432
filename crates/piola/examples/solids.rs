//! Rubber: stress and tangent of a law in shear, and the stress of a bar that is pulled.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::continuum::DeformationGradient;
use piola::solids::{Hyperelastic, MooneyRivlin};
use piola::specimens::homogeneous::{Mode, first_piola};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (c10, c01) = (0.3e6, 0.1e6);
    let rubber = MooneyRivlin::stress_free(c10, c01, 1.0e9)?;

    // In simple shear T₁₂ = 2 (C₁₀ + C₀₁) k at every amount k; the tangent ∂P₂₁/∂F₂₁ is the modulus 2 (C₁₀ + C₀₁).
    for amount in [1e-9_f64, 0.5, 2.0] {
        let shear = DeformationGradient::simple_shear(amount)?;
        let cauchy = rubber.cauchy(&shear).0;
        let stiffness = rubber.first_piola_tangent(&shear).entry(1, 0, 1, 0);
        println!("k = {amount:4.1e}: T₁₂ = {:.6e} Pa, ∂P₂₁/∂F₂₁ = {stiffness:.6e} Pa", cauchy.components[3]);
        assert!((stiffness / 0.8e6 - 1.0).abs() < 1e-12);
        assert!((cauchy.components[3] / (0.8e6 * amount) - 1.0).abs() < 1e-12);
    }

    // A bar with free sides: P = 2 (λ − λ⁻²)(C₁₀ + C₀₁/λ), incompressible.
    for stretch in [0.5, 1.5, 3.0_f64] {
        let stress = first_piola(Mode::Uniaxial, stretch, &rubber);
        let by_hand = 2.0 * (stretch - stretch.powi(-2)) * (c10 + c01 / stretch);
        println!("λ = {stretch}: P = {stress:.3} Pa");
        assert!((stress / by_hand - 1.0).abs() < 1e-13);
    }
    Ok(())
}
