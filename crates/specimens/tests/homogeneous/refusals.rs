//! What a homogeneous test cannot be is refused by name.

use piola_continuum::DisplacementGradient;
use piola_solids::internal_constraints::{Incompressibility, Inextensibility};
use piola_solids::{
    Fibre, IncompressibleSolid, MooneyRivlin, Pressurised, ReinforcedNeoHookean, SolidsError, isochoric,
};
use piola_specimens::SpecimensError;
use piola_specimens::homogeneous::{
    Control, Controls, IncompressibleState, Mode, constrained_equilibrium, equilibrium, simple_shear, uniaxial,
    volumetric,
};

fn rubber() -> MooneyRivlin {
    MooneyRivlin::stress_free(0.37, 0.11, 2.0).expect("parameters")
}

#[test]
fn pressure_that_nothing_determines_is_named() {
    let law = IncompressibleSolid::new(isochoric::MooneyRivlin::new(0.37, 0.11).expect("parameters"));
    for controls in [Controls::simple_shear(0.5, false), Controls::volumetric(1.0)] {
        let error = equilibrium(&law, &controls.expect("controls"), &DisplacementGradient::zero()).expect_err("no p");
        let expected = SolidsError::UndeterminedMultiplier { index: 0, rank: 0, count: 1 }.into();
        assert_eq!(error, expected);
    }
    let all_free = Controls::new([[Control::FREE; 3]; 3]).expect("controls");
    let error = equilibrium(&law, &all_free, &DisplacementGradient::zero()).expect_err("a rotation is free");
    assert!(matches!(error, SpecimensError::Indeterminate { .. }), "{error}");
}

#[test]
fn constraints_that_say_the_same_are_named() {
    let cord = |direction| Inextensibility::along(Fibre::new(direction).expect("direction"));
    let twice = (cord([1.0, 0.0, 0.0]), cord([-2.0, 0.0, 0.0]));
    let controls = Controls::uniaxial(1.0).expect("controls");
    let error = constrained_equilibrium(&rubber(), &twice, &controls, &DisplacementGradient::zero());
    let Err(SpecimensError::Solids(error)) = error else { panic!("{error:?}") };
    assert!(matches!(error, SolidsError::RedundantConstraint { index: 1, rank: 1, count: 2, .. }));
    // An incompressible law that nobody told to keep its volume.
    let law = Pressurised::new(rubber());
    let error = constrained_equilibrium(&law, &(), &Controls::uniaxial(2.0).expect("λ"), &DisplacementGradient::zero());
    let Err(SpecimensError::Solids(error)) = error else { panic!("{error:?}") };
    assert!(matches!(error, SolidsError::BeyondLimit { quantity: "|J − 1|", .. }), "{error:?}");
    let told = constrained_equilibrium(
        &law,
        &Incompressibility,
        &Controls::uniaxial(2.0).expect("λ"),
        &DisplacementGradient::zero(),
    );
    assert!(told.is_ok());
}

#[test]
fn fibres_across_the_axes_of_a_test_are_named() {
    let along = |axis| ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new(axis).expect("axis")).expect("parameters");
    let error = IncompressibleState::of(&along([0.6, 0.8, 0.0]), Mode::Uniaxial, 1.3_f64).expect_err("it shears");
    assert!(matches!(error, SpecimensError::TractionOnFreeFace { component: [0, 1], .. }), "{error}");
    let error = IncompressibleState::of(&along([0.6, 0.0, 0.8]), Mode::Planar, 1.3_f64).expect_err("it shears");
    assert!(matches!(error, SpecimensError::TractionOnFreeFace { component: [0, 2], .. }), "{error}");
    assert!(IncompressibleState::of(&along([0.0, 1.0, 0.0]), Mode::Uniaxial, 1.3_f64).is_ok());
}

#[test]
fn stretches_that_are_none_are_named() {
    let named = |error: &SpecimensError, value: f64| matches!(error, SpecimensError::OutOfBounds { value: found, .. } if (found - value).abs() <= 0.0);
    for bad in [-0.5, -2.0, 0.0] {
        let error = uniaxial(&rubber(), bad).expect_err("λ ≤ 0");
        assert!(named(&error, bad), "{error}");
        let error = volumetric(&rubber(), bad).expect_err("J ≤ 0");
        assert!(named(&error, bad), "{error}");
        let error = IncompressibleState::of(&rubber(), Mode::Planar, bad).expect_err("λ ≤ 0");
        assert!(named(&error, bad), "{error}");
        let error = IncompressibleState::biaxial(&rubber(), [2.0, bad]).expect_err("λ ≤ 0");
        assert!(named(&error, bad), "{error}");
    }
    let error = uniaxial(&rubber(), f64::NAN).expect_err("NaN");
    assert!(matches!(error, SpecimensError::NotFinite { parameter: "stretch", .. }), "{error}");
    assert!(simple_shear(&rubber(), -0.5, true).is_ok());
}

#[test]
fn both_shears_of_a_symmetric_stress_are_not_prescribed() {
    let (o, s) = (Control::HELD, Control::Cauchy(0.1));
    let error = Controls::new([[o, s, o], [s, o, o], [o, o, o]]).expect_err("twice");
    assert_eq!(error, SpecimensError::PrescribedTwice { row: 0, column: 1 });
    assert!(Controls::new([[s, s, o], [o, s, s], [s, o, s]]).is_ok());
}
