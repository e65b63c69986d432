//! A program of a user: stress and tangent of a law of one's own, stated by its energy, at many points.

use piola_continuum::{DeformationGradient, FirstPiola};
use piola_laws::{EnergyOfInvariants, Excesses, OfInvariants};
use piola_numerics::Real;
use piola_solids::batch;

/// W = ½ μ (I₁ − 3 − 2 ln J) + ½ λ (ln J)² + ½ k (I₄ − 1)²
#[derive(Clone, Copy)]
struct Tissue {
    mu: f64,
    lambda: f64,
    k: f64,
}

impl EnergyOfInvariants for Tissue {
    const FIBRES: usize = 1;
    const SECOND: bool = false;

    #[inline(always)]
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        let (volume, stretch) = (at.ln_jacobian(), at.fourth(0));
        T::lit(0.5 * self.mu) * at.first_excess()
            + T::lit(0.5 * self.lambda) * volume * volume
            + T::lit(0.5 * self.k) * stretch * stretch
    }
    fn fibre(&self, _family: usize) -> [f64; 3] {
        [1.0, 0.0, 0.0]
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let law = OfInvariants(Tissue { mu: 2.0, lambda: 3.0, k: 1.0 });
    let f = vec![DeformationGradient::simple_shear(0.5)?; 1000];
    let mut p = vec![FirstPiola::zero(); 1000];
    let mut tangents = vec![[0.0; 45]; 1000];
    batch::evaluate(&f[..], batch::first_piola_and_tangent(&law, &mut p[..], &mut tangents[..]))?;
    println!("{} {}", p[999].0[(0, 1)], tangents[0][0]);
    Ok(())
}
