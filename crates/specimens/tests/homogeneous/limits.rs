//! Specimens of laws with a limit: pulled as far as these go.

use piola_solids::isochoric::{ArrudaBoyce, Gent};
use piola_solids::volumetric::Quadratic;
use piola_solids::{AnySolid, Compressible, IncompressibleSolid, SolidsError};
use piola_specimens::SpecimensError;
use piola_specimens::homogeneous::{IncompressibleState, Mode, uniaxial};

/// Both stop at Ī₁ − 3 = 3.
fn solids() -> Result<[AnySolid; 4], SolidsError> {
    let (gent, chains, bulk) = (Gent::new(1.0, 3.0)?, ArrudaBoyce::new(1.0, 2.0)?, Quadratic::new(10.0)?);
    Ok([
        Compressible::new(gent, bulk).into(),
        Compressible::new(chains, bulk).into(),
        IncompressibleSolid::new(gent).into(),
        IncompressibleSolid::new(chains).into(),
    ])
}

#[test]
fn stretches_of_incompressible_bars_beyond_the_limit_are_refused() -> Result<(), SolidsError> {
    for law in solids()? {
        let refused = IncompressibleState::of(&law, Mode::Uniaxial, 3.0);
        assert!(matches!(refused, Err(SpecimensError::Solids(SolidsError::BeyondLimit { .. }))), "{refused:?}");
    }
    Ok(())
}

#[test]
fn a_bar_is_pulled_as_far_as_its_law_goes_and_the_end_is_said() -> Result<(), SolidsError> {
    let [gent, chains, ..] = solids()?;
    for law in [gent, chains] {
        assert!(uniaxial(&law, 2.0).is_ok());
        let error = uniaxial(&law, 20.0).expect_err("beyond the limit");
        let SpecimensError::NotConverged { share, gradient, .. } = error else { panic!("{error}") };
        assert!(share < 1.0 && 2.0 < gradient[0][0], "{share} {gradient:?}");
    }
    Ok(())
}
