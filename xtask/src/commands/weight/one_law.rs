//! A program of a user: the stress of one law at many points, and its tangent.

use piola_continuum::{DeformationGradient, FirstPiola};
use piola_solids::{MooneyRivlin, batch};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let law = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
    let f = vec![DeformationGradient::simple_shear(0.5)?; 1000];
    let mut p = vec![FirstPiola::zero(); 1000];
    batch::evaluate(&f[..], batch::first_piola(&law, &mut p[..]))?;
    let mut tangents = vec![[0.0; 45]; 1000];
    batch::evaluate(&f[..], batch::first_piola_tangent(&law, &mut tangents[..]))?;
    println!("{} {}", p[999].0[(0, 1)], tangents[0][0]);
    Ok(())
}
