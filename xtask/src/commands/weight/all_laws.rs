//! A program of a user: stress and tangent of every law at many points.

use std::error::Error;

use piola_continuum::{DeformationGradient, FirstPiola};
use piola_solids::isochoric::{ArrudaBoyce, Gent, MooneyRivlin as IsochoricMooneyRivlin, NeoHookean as IsochoricNeoHookean, Yeoh};
use piola_solids::volumetric::Quadratic;
use piola_solids::{
    BlatzKo, Compressible, ElasticConstants, Fibre, Fung, Hencky, HolzapfelGasserOgden, Hyperelastic, LinearElastic,
    MooneyRivlin, ReinforcedNeoHookean, SaintVenantKirchhoff, Stiffness, batch,
};

fn evaluate<L: Hyperelastic + Sync>(law: &L) -> Result<(), Box<dyn Error>> {
    let f = vec![DeformationGradient::simple_shear(0.5)?; 1000];
    let mut p = vec![FirstPiola::zero(); 1000];
    let mut a = vec![[0.0; 45]; 1000];
    batch::evaluate(&f[..], batch::first_piola_and_tangent(law, &mut p[..], &mut a[..]))?;
    println!("{} {}", p[999].0[(0, 1)], a[999][0]);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let bulk = Quadratic::new(20.0)?;
    let fibre = |x: f64, y: f64| Fibre::new([x, y, 0.0]);
    evaluate(&MooneyRivlin::stress_free(0.5, 0.25, 1.0)?)?;
    evaluate(&SaintVenantKirchhoff::new(1.5, 0.75)?)?;
    evaluate(&LinearElastic::new(ElasticConstants::from_lame(1.5, 0.75)?)?)?;
    evaluate(&Compressible::new(IsochoricNeoHookean::new(0.8)?, bulk))?;
    evaluate(&Compressible::new(IsochoricMooneyRivlin::new(0.5, 0.25)?, bulk))?;
    evaluate(&Compressible::new(Yeoh::new(0.5, -0.02, 0.001)?, bulk))?;
    evaluate(&Compressible::new(Gent::new(1.0, 50.0)?, bulk))?;
    evaluate(&Compressible::new(ArrudaBoyce::new(1.0, 8.0)?, bulk))?;
    evaluate(&BlatzKo::new(1.0, 0.25, 0.5)?)?;
    evaluate(&ReinforcedNeoHookean::new(1.0, 2.0, 3.0, fibre(0.6, 0.8)?)?)?;
    evaluate(&Fung::new(1.0, Stiffness::isotropic(1.0, 2.0)?)?)?;
    evaluate(&HolzapfelGasserOgden::new(1.0, 20.0, 2.0, 0.8, 0.1, [fibre(0.6, 0.8)?, fibre(0.6, -0.8)?])?)?;
    evaluate(&Hencky::new(2.0, 0.9)?)
}
