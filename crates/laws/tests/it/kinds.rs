//! Kinds of laws answer as the laws themselves, alone and in lanes, and refuse what they refuse.

use core::error::Error;

use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_laws::kinds::{self, LawOfInvariants, LawOfStrain};
use piola_numerics::{Lanes, Real};
use piola_solids::isochoric::{ArrudaBoyce, Gent};
use piola_solids::volumetric::{Quadratic, SimoTaylor};
use piola_solids::{
    AnisotropicLinear, AnisotropicSaintVenantKirchhoff, AnySolid, BlatzKo, Compressible, ElasticConstants, Fibre, Fung,
    Hencky, HolzapfelGasserOgden, Hyperelastic, IncompressibleOgden, IncompressibleSolid, IsochoricOgden,
    LinearElastic, MooneyRivlin, NeoHookean, Ogden, OgdenTerm, Polynomial, ReinforcedNeoHookean, SaintVenantKirchhoff,
    SolidVisitor, SolidsError, Stiffness,
};
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale};

type Fallible = Result<(), Box<dyn Error>>;

/// Each law of the enum.
fn laws() -> Result<Vec<AnySolid>, Box<dyn Error>> {
    let terms = [OgdenTerm { modulus: 1.0, exponent: 2.0 }, OgdenTerm { modulus: -0.25, exponent: -2.0 }];
    let (volume, stiffness) = (Quadratic::new(4.0)?, Stiffness::isotropic(1.0, 2.0)?);
    let fibres = [Fibre::new([1.0, 0.0, 0.0])?, Fibre::new([0.6, 0.8, 0.0])?];
    Ok(vec![
        MooneyRivlin::stress_free(0.5, 0.25, 1.0)?.into(),
        NeoHookean::new(2.0, SimoTaylor::new(4.0)?)?.into(),
        Compressible::new(Gent::new(1.0, 50.0)?, volume).into(),
        Compressible::new(ArrudaBoyce::new(1.0, 20.0)?, SimoTaylor::new(4.0)?).into(),
        IncompressibleSolid::new(Gent::new(1.0, 50.0)?).into(),
        Polynomial::saint_venant_kirchhoff(1.0, 2.0)?.into(),
        BlatzKo::new(1.0, 0.25, 0.5)?.into(),
        SaintVenantKirchhoff::new(1.0, 2.0)?.into(),
        LinearElastic::new(ElasticConstants::from_lame(1.0, 2.0)?)?.into(),
        Ogden::with_volumetric(&terms, volume)?.into(),
        IsochoricOgden::with_volumetric(&terms, volume)?.into(),
        IncompressibleOgden::new(&terms)?.into(),
        Hencky::new(1.0, 2.0)?.into(),
        Fung::new(1.0, stiffness)?.into(),
        HolzapfelGasserOgden::new(1.0, 4.0, 1.0, 0.5, 0.1, fibres)?.into(),
        ReinforcedNeoHookean::new(1.0, 2.0, 0.5, fibres[1])?.into(),
        AnisotropicLinear::new(stiffness).into(),
        AnisotropicSaintVenantKirchhoff::new(stiffness).into(),
    ])
}

/// Deformations with stretches between 2/3 and 3/2, those of a body that keeps its volume if asked.
fn deformations(keeps_volume: bool) -> Result<Vec<DeformationGradient>, Box<dyn Error>> {
    let mut random = Random::new(11);
    let one = |random: &mut Random| {
        let [x, y, z] = [0, 1, 2].map(|_| 0.4 * random.symmetric());
        let logarithms = if keeps_volume { [x, y, -x - y] } else { [x, y, z] };
        with_stretches(&random.rotation(), logarithms.map(f64::exp), &random.rotation())
    };
    (0..12).map(|_| Ok(DeformationGradient::from_rows(one(&mut random))?)).collect()
}

/// All answers of a law at a deformation, and what it refuses.
#[derive(Clone, Copy)]
struct Answers<'a, D>(&'a D);

type Found = (Vec<(&'static str, Vec<f64>)>, Option<SolidsError>, bool);

impl<D: Deformation<f64>> SolidVisitor for Answers<'_, D> {
    type Output = Found;

    fn visit<L: Hyperelastic + Sync>(self, law: &L) -> Found {
        let f = self.0;
        let (energy, stress, tangent) = law.energy_first_piola_and_tangent(f);
        let (second, material) = law.second_piola_and_tangent(f);
        let in_lanes = law.first_piola_and_upper_triangle(&f.lifted(|_, _, x| Lanes::<f64, 2>::splat(x)));
        let answers = vec![
            ("W", vec![energy, law.energy(f), law.energy_and_first_piola(f).0]),
            ("∂P/∂F", tangent.0.components.concat()),
            ("∂P/∂F alone", law.first_piola_tangent(f).0.components.concat()),
            ("∂S/∂E", material.0.components.to_vec()),
            ("c/J", law.cauchy_and_tangent(f).1.0.components.to_vec()),
            ("P", stress.0.transpose().as_slice().to_vec()),
            ("P alone", law.first_piola(f).0.as_slice().to_vec()),
            ("P in lanes", in_lanes[..9].iter().map(|x| x.primal(1)).collect()),
            ("S", second.0.components.to_vec()),
            ("τ", law.kirchhoff(f).0.components.to_vec()),
            ("T", law.cauchy_and_tangent(f).0.0.components.to_vec()),
        ];
        (answers, law.check(f).err(), law.is_incompressible())
    }
}

/// What a visitor finds of the law as `visit` passes it, and of the law as one of its kind.
fn of_kinds<V: SolidVisitor + Copy>(solid: &AnySolid, visitor: V) -> impl Iterator<Item = V::Output> {
    let invariants = LawOfInvariants::of(solid).map(|law| visitor.visit(&law));
    let strain = LawOfStrain::of(solid).map(|law| visitor.visit(&law));
    [kinds::visit(solid, visitor), invariants, strain].into_iter().flatten()
}

#[test]
fn answers_of_kinds_equal_those_of_their_laws() -> Fallible {
    let tol = Tol::ulps_because(512.0, "sums of a hundred terms in two orders");
    let mut compared = 0;
    for law in laws()? {
        for f in deformations(law.is_incompressible())? {
            let expected = law.visit(Answers(&f));
            let size = |values: &[f64]| values.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
            let modulus = size(&expected.0[1].1);
            for found in of_kinds(&law, Answers(&f)) {
                assert_eq!((&found.1, found.2), (&expected.1, expected.2), "{law:?}");
                for ((what, found), (_, expected)) in found.0.iter().zip(&expected.0) {
                    let scale = size(expected).max(modulus);
                    assert_close_at_scale(&format!("{law:?}: {what}"), found, expected, scale, tol);
                    compared += 1;
                }
            }
        }
    }
    // Eighteen laws; twelve of them also as one of their kind.
    assert_eq!(compared, 30 * 12 * 11);
    Ok(())
}

/// In all digits of the stress.
#[test]
fn stresses_of_kinds_at_small_strain_equal_those_of_their_laws() -> Fallible {
    let tol = Tol::stated(1e-13, "the stress keeps its digits at small strain");
    let mut random = Random::new(21);
    let mut compared = 0;
    for law in laws()?.into_iter().filter(|law| !law.is_incompressible()) {
        for exponent in [3, 6, 9, 12, 15, 16] {
            let h = random.matrix().map(|row| row.map(|x| x * 10.0_f64.powi(-exponent)));
            let f = DisplacementGradient::from_rows(h)?;
            let expected = law.visit(Answers(&f));
            for found in of_kinds(&law, Answers(&f)) {
                for ((what, found), (_, expected)) in found.0.iter().zip(&expected.0).skip(5) {
                    assert_close(&format!("{law:?} at 1e-{exponent}: {what}"), found, expected, tol);
                    compared += 1;
                }
            }
        }
    }
    assert_eq!(compared, 27 * 6 * 6);
    Ok(())
}

#[test]
fn kinds_refuse_what_their_laws_refuse() -> Fallible {
    let stretched = DeformationGradient::diagonal([8.0, 1.0 / 8.0_f64.sqrt(), 1.0 / 8.0_f64.sqrt()])?;
    let gent = AnySolid::from(Compressible::new(Gent::new(1.0, 50.0)?, Quadratic::new(4.0)?));
    let (_, refusal, _) = kinds::visit(&gent, Answers(&stretched)).ok_or("a law of invariants")?;
    assert!(matches!(refusal, Some(SolidsError::BeyondLimit { limit: 50.0, .. })), "{refusal:?}");
    let grown = DeformationGradient::dilatation(1.1)?;
    let solid = AnySolid::from(IncompressibleSolid::new(Gent::new(1.0, 50.0)?));
    let (_, refusal, _) = kinds::visit(&solid, Answers(&grown)).ok_or("a law of invariants")?;
    assert!(matches!(refusal, Some(SolidsError::BeyondLimit { quantity: "|J − 1|", .. })), "{refusal:?}");
    Ok(())
}

/// Allocations of a law.
struct Allocations(DeformationGradient);

impl SolidVisitor for Allocations {
    type Output = usize;

    fn visit<L: Hyperelastic + Sync>(self, law: &L) -> usize {
        let (count, _) = allocations_in(|| core::hint::black_box(law.energy_first_piola_and_tangent(&self.0)));
        count
    }
}

#[test]
fn allocations_of_kinds_equal_zero() -> Fallible {
    for law in laws()? {
        let f = DeformationGradient::simple_shear(0.25)?;
        assert_eq!(kinds::visit(&law, Allocations(f)), Some(0), "{law:?}");
    }
    Ok(())
}
