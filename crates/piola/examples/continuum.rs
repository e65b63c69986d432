//! A block sheared by one: stretches, rotation, strain, and the first Piola–Kirchhoff stress of a Cauchy stress.
#![expect(clippy::print_stdout, reason = "an example prints")]

use piola::continuum::polar::StretchAnalysis;
use piola::continuum::strain::GreenStrain;
use piola::continuum::{CauchyStress, DeformationGradient};

/// Prints numbers and asserts that they equal those found by hand.
fn show<const N: usize>(what: &str, found: [f64; N], by_hand: [f64; N]) {
    println!("{what:<28} {found:.12?}");
    assert!(found.iter().zip(by_hand).all(|(a, b)| (a - b).abs() < 1e-15), "{by_hand:?}");
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // x₁ = X₁, x₂ = X₂ + X₁: direction 2 is that of the shift, 1 that of its gradient.
    let shear = DeformationGradient::simple_shear(1.0)?;

    // F = R U: the largest stretch is the golden ratio, the least its inverse, and R turns by atan(1/2).
    let parts = StretchAnalysis::of(&shear);
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    show("principal stretches", parts.principal_stretches(), [golden, 1.0, 1.0 / golden]);
    let rotation = parts.rotation();
    show("tangent of the rotation", [rotation[1][0] / rotation[0][0]], [0.5]);

    // E = ½ (FᵀF − 1), components 11, 22, 33, 12, 23, 13; the trace of ln U is ln J = 0.
    show("Green's strain", GreenStrain::of(&shear).0.components, [0.5, 0.0, 0.0, 0.5, 0.0, 0.0]);
    let hencky = parts.hencky_material().components;
    show("trace of Hencky's strain", [hencky[0] + hencky[1] + hencky[2]], [0.0]);

    // P = J T F⁻ᵀ of a pure shear stress T₁₂ = 1: P₂₂ = −1, since the faces have turned.
    let piola = CauchyStress::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0)?.first_piola(&shear).0;
    show("P₁₁, P₁₂, P₂₁, P₂₂", [piola[(0, 0)], piola[(0, 1)], piola[(1, 0)], piola[(1, 1)]], [0.0, 1.0, 1.0, -1.0]);
    Ok(())
}
