//! Displacements that a constraint forbids are refused with what they make of it.

use piola_continuum::DisplacementGradient;
use piola_solids::internal_constraints::{Constraints, Incompressibility, Inextensibility, Rigidity};
use piola_solids::{Fibre, IncompressibleSolid, MooneyRivlin, SolidsError, isochoric};
use piola_specimens::SpecimensError;
use piola_specimens::homogeneous::{Control, Controls, constrained_equilibrium, equilibrium, simple_shear, volumetric};
use piola_testkit::{Tol, assert_close};

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters")
}

fn incompressible() -> IncompressibleSolid<isochoric::MooneyRivlin> {
    IncompressibleSolid::new(isochoric::MooneyRivlin::new(0.37, 0.11).expect("parameters"))
}

fn cord(direction: [f64; 3]) -> Inextensibility {
    Inextensibility::along(Fibre::new(direction).expect("a direction"))
}

fn displaced(along: [f64; 3]) -> Controls {
    Controls::axial(along.map(Control::Displacement)).expect("controls")
}

/// The constraint that is contradicted, and by how much.
fn contradicted<const N: usize>(constraints: &impl Constraints<N>, controls: &Controls) -> (usize, f64) {
    let error = constrained_equilibrium(&rubber(), constraints, controls, &DisplacementGradient::zero());
    match error {
        Err(SpecimensError::ContradictedConstraint { index, value, .. }) => (index, value),
        other => panic!("{other:?}"),
    }
}

#[test]
fn volume_of_an_incompressible_body_that_is_prescribed_is_refused_with_its_value() {
    let tolerance = Tol::stated(1e-14, "the cube of a cube root, and of elongations");
    for jacobian in [2.0, 0.5, 1.0 + 1e-6] {
        let error = volumetric(&incompressible(), jacobian).expect_err("its volume is kept");
        let SpecimensError::OutOfBounds { parameter: "det F", value, .. } = error else { panic!("{error}") };
        assert_close("det F", &[value], &[jacobian], tolerance);
    }
    let error = volumetric(&incompressible(), 2.0).expect_err("its volume is kept").to_string();
    assert!(error.starts_with("incompressible body: det F = 2") && error.ends_with("violates det F = 1"), "{error}");
    // Shears that are free do not make up for it: det F does not see them near F = diag(1.3, 1, 1).
    let free = Control::FREE;
    let sheared = Controls::new([
        [Control::Displacement(0.3), free, Control::HELD],
        [Control::HELD, Control::HELD, Control::HELD],
        [Control::HELD, Control::HELD, Control::HELD],
    ]);
    let error = equilibrium(&incompressible(), &sheared.expect("controls"), &DisplacementGradient::zero());
    let Err(SpecimensError::OutOfBounds { value, .. }) = error else { panic!("{error:?}") };
    assert_close("det F", &[value], &[1.3], tolerance);
}

#[test]
fn volume_that_is_kept_leaves_the_pressure_undetermined() {
    let undetermined = Err(SpecimensError::Solids(SolidsError::UndeterminedMultiplier { index: 0, rank: 0, count: 1 }));
    let start = DisplacementGradient::zero();
    for stretch in [1.0, 2.0, 0.7] {
        let kept = displaced([stretch - 1.0, 1.0 / stretch - 1.0, 0.0]);
        assert_eq!(equilibrium(&incompressible(), &kept, &start), undetermined);
    }
    assert_eq!(simple_shear(&incompressible(), 0.5, false), undetermined);
}

#[test]
fn stretch_of_a_rigid_body_or_along_a_cord_is_refused_with_its_value() {
    let tolerance = Tol::stated(1e-15, "a difference of squares");
    let (index, value) = contradicted(&Rigidity, &Controls::uniaxial(2.0).expect("controls"));
    assert_eq!(index, 0);
    assert_close("C₁₁ − 1", &[value], &[3.0], tolerance);
    // A shear k = F₂₁ makes C₁₁ = 1 + k², C₁₂ = k.
    let (index, value) = contradicted(&Rigidity, &Controls::simple_shear(0.25, false).expect("controls"));
    assert_eq!(index, 3);
    assert_close("C₁₂", &[value], &[0.25], tolerance);
    let (index, value) = contradicted(&cord([1.0, 0.0, 0.0]), &Controls::uniaxial(1.5).expect("controls"));
    assert_eq!(index, 0);
    assert_close("|F e|² − 1", &[value], &[1.25], tolerance);
}

#[test]
fn constraints_that_want_different_things_of_one_component_are_refused() {
    // Along 2 the cord wants 1, the volume ½.
    let both = (Incompressibility, cord([0.0, 1.0, 0.0]));
    let pulled = Controls::axial([Control::Displacement(1.0), Control::FREE, Control::HELD]).expect("controls");
    let (_, value) = contradicted(&both, &pulled);
    assert!(0.4 < value.abs(), "{value}");
    // Held, both are kept: of the two reactions only a sum is seen.
    let held = Controls::axial([Control::HELD, Control::FREE, Control::HELD]).expect("controls");
    let error = constrained_equilibrium(&rubber(), &both, &held, &DisplacementGradient::zero());
    let undetermined =
        matches!(error, Err(SpecimensError::Solids(SolidsError::UndeterminedMultiplier { rank: 1, count: 2, .. })));
    assert!(undetermined, "{error:?}");
}
