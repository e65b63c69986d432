//! Stresses along paths against an independent integration of the differential equations at 50 digits.

use core::error::Error;

use piola_continuum::DeformationGradient;
use piola_inelastic::{
    BergstromBoyce, DrivenGrowth, Evolution, Hardening, InelasticPoint, Kinematic, Mullins, PowerFlow, ReeseGovindjee,
    StepControl, Viscoplastic,
};
use piola_numerics::linear::matrix3::determinant;
use piola_solids::{Hencky, Hyperelastic, NeoHookeanCiarlet};
use piola_testkit::golden::{self, matrix, number, text, vector};
use piola_testkit::{Tol, assert_close, assert_order};
use serde_json::Value;

type Fallible = Result<(), Box<dyn Error>>;

fn deformation(value: &Value) -> Result<DeformationGradient, Box<dyn Error>> {
    let rows = matrix(value);
    Ok(DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j])))?)
}

/// Follows the legs of a law in `inelastic_paths.json`.
fn follow<L: Evolution<S, X>, const S: usize, const X: usize>(name: &str, law: &L) -> Result<usize, Box<dyn Error>> {
    follow_in("inelastic_paths", name, law)
}

fn follow_in<L: Evolution<S, X>, const S: usize, const X: usize>(
    file: &str,
    name: &str,
    law: &L,
) -> Result<usize, Box<dyn Error>> {
    let stated = Tol::stated(1e-10, "the error of an increment is controlled to 1e-12");
    follow_to(file, name, law, (&StepControl::new(1e-12)?, stated))
}

/// Follows the legs of a law. The first starts with the state of the body as made, at the deformation of the reference data.
fn follow_to<L: Evolution<S, X>, const S: usize, const X: usize>(
    file: &str,
    name: &str,
    law: &L,
    (control, stated): (&StepControl, Tol),
) -> Result<usize, Box<dyn Error>> {
    let golden = golden::load(file);
    let legs = golden.cases.iter().filter(|case| text(&case["law"]) == name);
    let mut point: Option<InelasticPoint<'_, L, S, X>> = None;
    let mut count = 0;
    for leg in legs {
        let from = deformation(&leg["input"]["from"])?;
        let mut here = match point.take() {
            Some(point) => point,
            None => InelasticPoint::with_state(law, &law.initial(), &from)?,
        };
        let advanced = here.advance(&deformation(&leg["input"]["to"])?, number(&leg["input"]["duration"]), control)?;
        let what = text(&leg["id"]);
        let stress: Vec<f64> = advanced.first_piola.0.transpose().as_slice().to_vec();
        assert_close(&format!("{what}: P"), &stress, &vector(&leg["output"]["P"]), stated);
        if leg["output"]["state"].is_array() {
            assert_close(&format!("{what}: state"), &advanced.state, &vector(&leg["output"]["state"]), stated);
        }
        point = Some(here);
        count += 1;
    }
    Ok(count)
}

fn springs() -> Result<(NeoHookeanCiarlet, NeoHookeanCiarlet), Box<dyn Error>> {
    Ok((NeoHookeanCiarlet::with_constants(1.0, 5.0)?, NeoHookeanCiarlet::with_constants(2.0, 8.0)?))
}

pub(crate) fn bergstrom_boyce() -> Result<BergstromBoyce<NeoHookeanCiarlet, NeoHookeanCiarlet>, Box<dyn Error>> {
    let (rest, spring) = springs()?;
    let flow =
        PowerFlow { rate: 0.25, stress: 0.5, stress_exponent: 3.0, stretch_exponent: -0.5, perturbation: 0.0625 };
    Ok(BergstromBoyce::new(rest, spring, flow)?)
}

pub(crate) fn reese_govindjee() -> Result<ReeseGovindjee<NeoHookeanCiarlet, NeoHookeanCiarlet>, Box<dyn Error>> {
    let (rest, spring) = springs()?;
    Ok(ReeseGovindjee::new(rest, spring, 0.75)?.with_bulk_viscosity(3.0)?)
}

pub(crate) fn kinematic(viscosity: f64) -> Result<Kinematic<Hencky, NeoHookeanCiarlet>, Box<dyn Error>> {
    let hardening = Hardening { yield_stress: 0.25, linear: 0.125, saturation: 0.5, saturation_exponent: 4.0 };
    let back = NeoHookeanCiarlet::with_constants(0.25, 0.5)?;
    Ok(Kinematic::new(Hencky::new(3.0, 2.0)?, back, hardening, 1.5, viscosity)?)
}

pub(crate) fn viscoplastic(viscosity: f64) -> Result<Viscoplastic<Hencky>, Box<dyn Error>> {
    let hardening = Hardening { yield_stress: 0.25, linear: 0.125, saturation: 0.5, saturation_exponent: 4.0 };
    Ok(Viscoplastic::new(Hencky::new(3.0, 2.0)?, hardening, viscosity)?)
}

pub(crate) fn driven_growth() -> Result<DrivenGrowth<NeoHookeanCiarlet>, Box<dyn Error>> {
    Ok(DrivenGrowth::new(springs()?.0, 0.5, [0.5, 2.0], 2.0)?)
}

pub(crate) fn mullins() -> Result<Mullins<NeoHookeanCiarlet>, Box<dyn Error>> {
    Ok(Mullins::new(springs()?.0, 2.0, 0.25, 0.125)?)
}

#[test]
fn bergstrom_boyce_stress_equals_the_reference() -> Fallible {
    assert_eq!(follow("bergstrom_boyce", &bergstrom_boyce()?)?, 2);
    Ok(())
}

#[test]
fn reese_govindjee_stress_equals_the_reference() -> Fallible {
    assert_eq!(follow("reese_govindjee", &reese_govindjee()?)?, 2);
    Ok(())
}

#[test]
fn viscoplastic_stress_equals_the_reference() -> Fallible {
    assert_eq!(follow("viscoplastic", &viscoplastic(0.5)?)?, 1);
    Ok(())
}

/// To and fro: elastic up to the yield surface, flow, back through the elastic domain, flow in the other sense.
#[test]
fn kinematic_stress_and_state_equal_the_reference() -> Fallible {
    assert_eq!(follow_in("kinematic_paths", "kinematic", &kinematic(0.0)?)?, 4);
    assert_eq!(follow_in("kinematic_paths", "kinematic_viscous", &kinematic(0.5)?)?, 1);
    Ok(())
}

/// Each leg crosses the yield surface inside: it is elastic first and then flows.
#[test]
fn kinematic_stress_and_state_equal_the_reference_where_legs_cross_the_yield_surface() -> Fallible {
    let law = kinematic(0.0)?;
    let follow = |control: &StepControl, stated: f64| {
        let tol =
            Tol::stated(stated, "a hundred times the tolerance, at least: stiffness, and errors of several parts");
        follow_to("kinematic_paths", "kinematic_crossing", &law, (control, tol))
    };
    assert_eq!(follow(&StepControl::new(1e-12)?, 1e-10)?, 2);
    assert_eq!(follow(&StepControl::default(), 1e-8)?, 2);
    assert_eq!(follow(&StepControl::new(1e-6)?, 1e-4)?, 2);
    Ok(())
}

#[test]
fn driven_growth_stress_equals_the_reference() -> Fallible {
    assert_eq!(follow("driven_growth", &driven_growth()?)?, 1);
    Ok(())
}

/// From ϑ = 1 growth begins at the rate k tr M, and shrinking too, whatever the bounds.
#[test]
fn growth_begins_at_the_rate_of_the_stress_in_both_directions() -> Fallible {
    let (spring, rate, dt) = (springs()?.0, 0.5, 1e-7);
    let law = DrivenGrowth::new(spring, rate, [0.5, 2.0], 2.0)?;
    for stretch in [1.25, 0.8] {
        let f = DeformationGradient::diagonal([stretch; 3])?;
        // Mandel's stress of a dilation: Fᵀ P.
        let trace = 3.0 * stretch * spring.first_piola(&f).0[(0, 0)];
        let advanced = InelasticPoint::new(&law).advance(&f, dt, &StepControl::one_step())?;
        let tol = Tol::stated(3e-5, "ten to twenty times the change of 1e-6, which the stress feels");
        assert_close("dϑ/dt", &[(advanced.state[0] - 1.0) / dt], &[rate * trace], tol);
    }
    Ok(())
}

/// A change of the volume alone has no deviator that would flow.
#[test]
fn a_dilation_leaves_the_state_of_a_rubber() -> Fallible {
    let law = bergstrom_boyce()?;
    let f = DeformationGradient::diagonal([1.1; 3])?;
    let advanced = InelasticPoint::new(&law).advance(&f, 1.0, &StepControl::one_step())?;
    let (rest, spring) = springs()?;
    let expected = rest.first_piola(&f).0 + spring.first_piola(&f).0;
    assert_close("P", advanced.first_piola.0.as_slice(), expected.as_slice(), Tol::ulps(64.0));
    assert_close("state", &advanced.state, &law.initial(), Tol::ulps(4.0));
    Ok(())
}

#[test]
fn mullins_stress_equals_the_reference() -> Fallible {
    assert_eq!(follow("mullins", &mullins()?)?, 4);
    Ok(())
}

/// The exponential map and extrapolation in the algebra keep the volume.
#[test]
fn determinant_of_the_inelastic_deformation_stays_one() -> Fallible {
    let law = bergstrom_boyce()?;
    let mut point = InelasticPoint::new(&law);
    for step in 0..100 {
        let to = DeformationGradient::simple_shear(0.5 * f64::from(step).sin())?;
        let control = if step % 2 == 0 { StepControl::default() } else { StepControl::one_step() };
        point.advance(&to, 0.1, &control)?;
    }
    let s = point.state();
    let determinant = determinant([[s[0], s[1], s[2]], [s[3], s[4], s[5]], [s[6], s[7], s[8]]]);
    assert_close("det Fᵢ", &[determinant], &[1.0], Tol::ulps_because(500.0, "some five hundred exponentials"));
    Ok(())
}

/// One step an increment converges to the reference with the first order.
#[test]
fn error_of_one_step_an_increment_is_of_the_first_order() -> Fallible {
    let law = reese_govindjee()?;
    let to = DeformationGradient::simple_shear(0.4)?;
    let exact = InelasticPoint::new(&law).trial(&to, 1.0, &StepControl::new(1e-12)?)?.first_piola.0;
    let counts = [16, 32, 64];
    let error = |count: i32| -> Result<f64, Box<dyn Error>> {
        let mut point = InelasticPoint::new(&law);
        let mut stress = exact;
        for k in 1..=count {
            let here = DeformationGradient::simple_shear(0.4 * f64::from(k) / f64::from(count))?;
            stress = point.advance(&here, 1.0 / f64::from(count), &StepControl::one_step())?.first_piola.0;
        }
        Ok((stress - exact).norm())
    };
    let errors = [error(counts[0])?, error(counts[1])?, error(counts[2])?];
    let steps = counts.map(|count| 1.0 / f64::from(count));
    assert_order("implicit Euler", &steps, &errors, 1.0, 0.1);
    Ok(())
}
