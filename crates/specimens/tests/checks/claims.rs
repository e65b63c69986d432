//! Noll's equivalences, the declared symmetry group and the energy of closed circuits, for every law of every volume.

use piola_continuum::DeformationGradient;
use piola_solids::{AnySolid, Hyperelastic};
use piola_specimens::SpecimensError;
use piola_specimens::checks::{
    CrystalClass, Sampler, Search, Stored, SymmetryGroup, hyperelasticity, material_symmetry, noll, potential,
};
use piola_testkit::{Tol, assert_close_at_scale};

use super::every_law::all;

const SAMPLES: usize = 60;

/// The fibre of the reinforced laws and of the ply.
const AXIS: [f64; 3] = [1.0, 2.0, 2.0];

/// The declared groups of all laws that are independent of the observer.
fn declared() -> Result<Vec<(AnySolid, SymmetryGroup)>, SpecimensError> {
    // The three of Hooke's law between E and S: of wood, of a ply, of a cubic crystal.
    let mut hookean = [
        SymmetryGroup::orthotropic(),
        SymmetryGroup::transversely_isotropic(AXIS)?,
        SymmetryGroup::crystal(CrystalClass::CubicHigh),
    ]
    .into_iter();
    let mut declared = Vec::new();
    for law in all().into_iter().filter(|(_, any_volume)| *any_volume).map(|(law, _)| law) {
        let group = match law {
            // W of the linear strain depends on the observer.
            AnySolid::LinearElastic(_) | AnySolid::AnisotropicLinear(_) => continue,
            AnySolid::Fung(_) | AnySolid::HolzapfelGasserOgden(_) => SymmetryGroup::orthotropic(),
            AnySolid::ReinforcedNeoHookean(_) => SymmetryGroup::transversely_isotropic(AXIS)?,
            AnySolid::AnisotropicSaintVenantKirchhoff(_) => hookean.next().expect("three of them"),
            _ => SymmetryGroup::isotropic(),
        };
        declared.push((law, group));
    }
    assert_eq!((declared.len(), hookean.next()), (34, None));
    Ok(declared)
}

#[test]
fn every_law_keeps_nolls_claims_and_its_group() {
    let search = Search { samples: SAMPLES, strain: 0.35, ..Search::default() };
    for (law, group) in declared().expect("parameters") {
        let report = noll(&law, &search);
        assert!(report.agrees() && report.passes(), "{law:?}: {report:?}");
        let report = material_symmetry(&Stored(&law), &group, &search);
        assert!(report.passes(), "{law:?}: {report:?}");
    }
}

#[test]
fn work_around_closed_circuits_is_zero_and_that_along_paths_is_the_energy() {
    for (law, _) in declared().expect("parameters") {
        let search = Search { samples: SAMPLES / 4, strain: 0.25, ..Search::default() };
        let report = hyperelasticity(&Stored(&law), &search);
        assert!(report.passes(), "{law:?}: {report:?}");
        let f = DeformationGradient::new(Sampler::new(4).gradient(0.3)).expect("0 < det F");
        let found = potential(&Stored(&law), &f);
        let tolerance = Tol::stated(1e-13, "quadrature to 1e-13 of the work without signs");
        assert_close_at_scale(&format!("{law:?}: W"), &[found.energy], &[law.energy(&f)], 1.0, tolerance);
    }
}
