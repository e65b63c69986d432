//! All laws, every energy of shape and of volume among them.

use nalgebra::Matrix3;
use piola_solids::SolidsError;
use piola_solids::isochoric::{self, ArrudaBoyce, ArrudaBoyceSeries, Gent, Isochoric, Rivlin, RivlinTerm, Yeoh};
use piola_solids::volumetric::{
    HartmannNeff, Lame, Liu, Logarithmic, Miehe, OgdenVolumetric, Quadratic, QuadraticLogarithmic, SimoTaylor,
    Volumetric,
};
use piola_solids::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, AnyIsochoric, AnySolid, AnyVolumetric, BlatzKo, Compressible,
    ElasticConstants, EngineeringConstants, Fibre, Fung, Hencky, HolzapfelGasserOgden, IncompressibleOgden,
    IncompressibleSolid, IsochoricOgden, LinearElastic, MooneyRivlin, NeoHookean, Ogden, OgdenTerm, Polynomial,
    PolynomialTerm, ReinforcedNeoHookean, SaintVenantKirchhoff, Stiffness, TransverseConstants,
};
use piola_testkit::strategies::{rotation, rotation_matrix, vector};
use proptest::prelude::*;

fn compressible(
    isochoric: impl Isochoric + Into<AnyIsochoric>,
    volumetric: impl Volumetric + Into<AnyVolumetric>,
) -> AnySolid {
    Compressible::checked(isochoric, volumetric).expect("0 ≤ κ").into()
}

fn terms() -> [OgdenTerm; 3] {
    [(0.63, 1.3), (0.0012, 5.0), (-0.01, -2.0)].map(|(mu, alpha)| OgdenTerm { modulus: mu, exponent: alpha })
}

pub(super) fn artery(dispersion: f64) -> Result<HolzapfelGasserOgden, SolidsError> {
    HolzapfelGasserOgden::new(1.5, 20.0, 2.4, 0.8, dispersion, [Fibre::in_plane(0.6)?, Fibre::in_plane(-0.6)?])
}

/// Laws that answer at every volume.
fn of_all_volumes() -> Result<Vec<AnySolid>, SolidsError> {
    let rivlin = |first, second, coefficient| RivlinTerm { first, second, coefficient };
    let term = |first, second, third, coefficient| PolynomialTerm { first, second, third, coefficient };
    let wood = EngineeringConstants { young: [11.0, 1.2, 0.7], poisson: [0.38, 0.45, 0.4], shear: [0.8, 0.1, 0.7] };
    let soft = EngineeringConstants { young: [0.9, 0.5, 0.4], poisson: [0.3, 0.2, 0.25], shear: [0.2, 0.15, 0.3] };
    let ply = TransverseConstants {
        young_along: 8.0,
        young_across: 1.5,
        poisson_along: 0.3,
        poisson_across: 0.45,
        shear_along: 0.6,
    };
    let fibre = Fibre::new([1.0, 2.0, 2.0])?;
    let orthotropic = Stiffness::orthotropic(&wood, &Matrix3::identity())?;
    let soft = Stiffness::orthotropic(&soft, &Matrix3::identity())?;
    Ok(vec![
        compressible(isochoric::NeoHookean::new(0.8)?, Quadratic::new(20.0)?),
        compressible(isochoric::MooneyRivlin::new(0.5, 0.25)?, Logarithmic::new(5.0)?),
        compressible(Yeoh::new(0.5, -0.05, 0.01)?, SimoTaylor::new(5.0)?),
        compressible(Gent::new(0.8, 30.0)?, Liu::new(5.0)?),
        compressible(ArrudaBoyce::new(0.8, 9.0)?, Miehe::new(5.0)?),
        compressible(ArrudaBoyceSeries::new(0.8, 9.0)?, OgdenVolumetric::new(5.0, 9.0)?),
        compressible(
            Rivlin::new(vec![rivlin(1, 0, 0.4), rivlin(0, 1, 0.1), rivlin(1, 1, 0.05), rivlin(3, 0, 0.01)])?,
            HartmannNeff::new(5.0)?,
        ),
        compressible(isochoric::NeoHookean::new(0.8)?, QuadraticLogarithmic::new(5.0)?),
        compressible(isochoric::NeoHookean::new(0.8)?, Lame::new(5.0)?),
        NeoHookean::new(0.8, Logarithmic::new(3.0)?)?.into(),
        NeoHookean::new(0.8, SimoTaylor::new(3.0)?)?.into(),
        NeoHookean::new(0.8, Lame::new(-0.3)?)?.into(),
        MooneyRivlin::stress_free(0.5, 0.25, 1.25)?.into(),
        MooneyRivlin::new(0.5, 0.25, 1.25, 3.0)?.into(),
        Polynomial::stress_free(vec![
            term(1, 0, 0, 0.5),
            term(0, 1, 0, 0.25),
            term(0, 0, 1, -1.0),
            term(1, 1, 0, 0.125),
            term(0, 0, 2, 0.75),
            term(2, 0, 1, 0.0625),
        ])?
        .into(),
        BlatzKo::foam(0.8)?.into(),
        BlatzKo::new(0.8, 0.4, 0.7)?.into(),
        BlatzKo::new(0.8, 0.0, 0.5)?.into(),
        SaintVenantKirchhoff::new(1.5, 0.75)?.into(),
        LinearElastic::new(ElasticConstants::from_lame(1.5, 0.75)?)?.into(),
        Ogden::new(&[OgdenTerm { modulus: 1.2, exponent: 1.3 }, OgdenTerm { modulus: -0.3, exponent: -2.0 }], 4.0)?
            .into(),
        Ogden::with_volumetric(&terms(), SimoTaylor::new(2.0)?)?.into(),
        IsochoricOgden::new(&terms(), 10.0)?.into(),
        IsochoricOgden::with_volumetric(&terms(), HartmannNeff::new(5.0)?)?.into(),
        Hencky::new(2.0, 0.9)?.into(),
        Hencky::new(-0.3, 0.9)?.into(),
        Hencky::with_volumetric(0.9, Miehe::new(2.0)?)?.into(),
        Hencky::with_volumetric(0.9, OgdenVolumetric::new(2.0, -2.0)?)?.into(),
        Fung::new(1.7, soft)?.into(),
        artery(0.0)?.into(),
        artery(0.2)?.into(),
        ReinforcedNeoHookean::new(0.8, 1.1, 2.0, fibre)?.into(),
        AnisotropicLinear::new(orthotropic).into(),
        AnisotropicSaintVenantKirchhoff::new(orthotropic).into(),
        AnisotropicSaintVenantKirchhoff::new(Stiffness::transversely_isotropic(&ply, fibre)?).into(),
        AnisotropicSaintVenantKirchhoff::new(Stiffness::cubic(3.0, 1.0, 1.5, &Matrix3::identity())?).into(),
    ])
}

/// Laws of bodies that keep their volume.
fn of_no_volume() -> Result<Vec<AnySolid>, SolidsError> {
    let mooney = isochoric::MooneyRivlin::new(0.5, 0.25)?;
    Ok(vec![
        IncompressibleSolid::new(mooney).into(),
        IncompressibleSolid::new(mooney).at_pressure(1.75)?.into(),
        IncompressibleSolid::new(Gent::new(0.8, 30.0)?).at_excess_pressure(0.5)?.into(),
        IncompressibleSolid::new(Yeoh::new(0.5, -0.05, 0.01)?).into(),
        IncompressibleOgden::new(&terms())?.into(),
        IncompressibleOgden::new(&terms())?.at_pressure(0.7)?.into(),
        IncompressibleOgden::new(&terms())?.at_excess_pressure(0.7)?.into(),
    ])
}

/// Every law, with whether it answers at every volume.
pub(super) fn all() -> Vec<(AnySolid, bool)> {
    let all = of_all_volumes().expect("parameters").into_iter().map(|law| (law, true));
    all.chain(of_no_volume().expect("parameters").into_iter().map(|law| (law, false))).collect()
}

/// F = R diag(λ) Q with stretches of 0.7 to 1.5.
pub(super) fn gradient() -> impl Strategy<Value = [[f64; 3]; 3]> {
    (rotation(), vector(3, 0.7..1.5), rotation()).prop_map(|(r, stretches, q)| {
        let (r, q) = (rotation_matrix(r), rotation_matrix(q));
        core::array::from_fn(|i| core::array::from_fn(|j| (0..3).map(|k| r[i][k] * stretches[k] * q[k][j]).sum()))
    })
}

pub(super) fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, x| largest.max(x.abs()))
}
