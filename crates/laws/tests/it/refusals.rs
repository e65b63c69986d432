//! What an energy may not do, and what answers then.

use piola_continuum::DeformationGradient;
use piola_laws::{EnergyOfInvariants, Excesses, LawsError, OfInvariants, examine};
use piola_numerics::Real;
use piola_solids::{Hyperelastic, SolidsError};

/// Asks for a second family, which it does not have.
#[derive(Clone, Copy)]
struct TooManyFamilies;

impl EnergyOfInvariants for TooManyFamilies {
    const FIBRES: usize = 1;
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        at.first_excess() + at.fourth(1) * at.fifth(1) + at.isochoric_fourth(1)
    }
}

/// Bears no more than J = 2.
#[derive(Clone, Copy)]
struct Limited;

impl EnergyOfInvariants for Limited {
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        at.first_excess()
    }
    fn check<T: Real>(&self, at: &impl Excesses<T>) -> Result<(), SolidsError> {
        let value = at.jacobian().primal(0);
        if value < 2.0 {
            return Ok(());
        }
        Err(SolidsError::BeyondLimit { law: "limited", quantity: "J", value, limit: 2.0 })
    }
}

#[test]
fn arguments_of_families_that_the_energy_does_not_have_are_nan() {
    let f = DeformationGradient::<f64>::simple_shear(0.5).expect("finite");
    let energy: f64 = OfInvariants(TooManyFamilies).energy(&f);
    assert!(energy.is_nan());
    assert!(OfInvariants(TooManyFamilies).first_piola(&f).0[(0, 0)].is_nan());
}

/// Says that it does not depend on I₂, and does.
#[derive(Clone, Copy)]
struct Forgetful;

impl EnergyOfInvariants for Forgetful {
    const SECOND: bool = false;
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        at.first_excess() + at.second_excess()
    }
}

#[test]
fn a_stress_with_an_argument_that_was_denied_is_nan() {
    let f = DeformationGradient::<f64>::simple_shear(0.5).expect("finite");
    assert!(OfInvariants(Forgetful).first_piola(&f).0[(0, 0)].is_nan());
}

#[test]
fn an_energy_refuses_deformations_beyond_its_limit() {
    let grown = |j: f64| DeformationGradient::diagonal([j, 1.0, 1.0]).expect("0 < J");
    assert!(OfInvariants(Limited).check(&grown(1.5)).is_ok());
    let error = OfInvariants(Limited).check(&grown(3.0));
    assert!(matches!(error, Err(SolidsError::BeyondLimit { quantity: "J", value: 3.0, .. })));
}

/// One of several energies that no elastic solid has.
#[derive(Clone, Copy)]
enum Faulty {
    /// ln(J − 0.9): no number below J = 0.9.
    NotFinite,
    /// 1 + I₁ − 3 − 2 ln J.
    Constant,
    /// I₁ − 3.
    Stressed,
}

impl EnergyOfInvariants for Faulty {
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        match self {
            Self::NotFinite => at.first_excess() + (at.jacobian() - T::lit(0.9)).ln() - T::lit(0.1_f64.ln()),
            Self::Constant => at.first_excess() + T::lit(1.0),
            Self::Stressed => at.first(),
        }
    }
}

#[test]
fn energies_that_no_elastic_solid_has_are_reported_by_name() {
    let report = |law: Faulty| examine(&OfInvariants(law), 0.3);
    // The logarithm has a slope at J = 1: its stress there is found first.
    assert!(matches!(report(Faulty::NotFinite), Err(LawsError::ReferenceStress { .. })));
    assert!(matches!(report(Faulty::Constant), Err(LawsError::ReferenceEnergy { energy: 1.0 })));
    let Err(LawsError::ReferenceStress { stress, .. }) = report(Faulty::Stressed) else {
        unreachable!("S = 2 1 at the reference")
    };
    assert!((stress - 2.0).abs() < 1e-15, "{stress}");
    // Without a strain nothing would be examined, and nothing found.
    for strain in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = examine(&OfInvariants(Infinite), strain);
        assert!(matches!(error, Err(LawsError::OutOfBounds { quantity: "strain", .. })), "{error:?}");
    }
    let error = examine(&OfInvariants(Infinite), 0.3);
    assert!(matches!(error, Err(LawsError::NotFinite { quantity: "W", index: 0, .. })), "{error:?}");
}

/// (J − 1)²/(J − 0.95)^½ where no check refuses J < 0.95.
#[derive(Clone, Copy)]
struct Infinite;

impl EnergyOfInvariants for Infinite {
    fn energy<T: Real>(&self, at: &impl Excesses<T>) -> T {
        at.first_excess() + at.volume_change() * at.volume_change() / (at.jacobian() - T::lit(0.95)).sqrt()
    }
}

#[test]
fn built_in_and_own_laws_pass_the_examination() -> Result<(), SolidsError> {
    let gent = piola_laws::coupled::GentCoupled::new(0.8, 2.0, 3.0)?;
    assert_eq!(examine(&OfInvariants(gent), 0.5), Ok(()));
    let rubber = piola_solids::MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
    assert_eq!(examine(&piola_laws::Sum(rubber, rubber), 0.5), Ok(()));
    Ok(())
}
