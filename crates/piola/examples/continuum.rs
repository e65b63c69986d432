//! A block sheared by one: stretches, strains, rotation, area, and the stresses of Piola beside that of Cauchy.
#![expect(clippy::print_stdout, reason = "an example prints")]
#![expect(clippy::float_cmp, reason = "these numbers are exact")]

use piola::continuum::polar::StretchAnalysis;
use piola::continuum::strain::GreenStrain;
use piola::continuum::{CauchyStress, Deformation, DeformationGradient};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let shear = DeformationGradient::simple_shear(1.0)?;
    assert_eq!(shear.jacobian(), 1.0);

    // F = R U: the largest stretch is the golden ratio, its inverse the least, and R turns by atan(1/2).
    let parts = StretchAnalysis::of(&shear);
    let golden = 0.5 * (1.0 + 5.0_f64.sqrt());
    let [large, _, small] = parts.principal_stretches();
    println!("stretches {large:.15} and {small:.15}");
    assert!((large - golden).abs() < 1e-15 && (small - 1.0 / golden).abs() < 1e-15);
    let rotation = parts.rotation();
    let angle = f64::atan2(rotation[1][0], rotation[0][0]);
    println!("rotation {:.12}°", angle.to_degrees());
    assert!((angle - 0.5_f64.atan()).abs() < 1e-15);

    // E = ½(FᵀF − 1), components 11, 22, 33, 12, 23, 13; ln U has the trace ln J = 0.
    let green = GreenStrain::of(&shear).0;
    println!("Green's strain {:?}", green.components);
    assert_eq!(green.components, [0.5, 0.0, 0.0, 0.5, 0.0, 0.0]);
    let hencky = parts.hencky_material();
    assert!((hencky.components[0] + hencky.components[1]).abs() < 1e-15);

    // P = J T F⁻ᵀ: the shear stress alone makes P₂₂ = −1, since the faces have turned.
    let cauchy = CauchyStress::new(0.0, 0.0, 0.0, 1.0, 0.0, 0.0)?;
    let piola = cauchy.first_piola(&shear);
    println!("P₁₂ = {}, P₂₁ = {}, P₂₂ = {}", piola.0[(0, 1)], piola.0[(1, 0)], piola.0[(1, 1)]);
    assert_eq!([piola.0[(0, 0)], piola.0[(0, 1)], piola.0[(1, 0)], piola.0[(1, 1)]], [0.0, 1.0, 1.0, -1.0]);
    Ok(())
}
