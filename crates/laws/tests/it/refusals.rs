//! What an energy may not do, and what answers then.

use piola_continuum::DeformationGradient;
use piola_laws::{EnergyOfInvariants, Excesses, OfInvariants};
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
