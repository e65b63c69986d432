//! Growth and temperatures among the internal variables are those of `Grown`, and stay as they are.

use core::error::Error;

use piola_continuum::DeformationGradient;
use piola_inelastic::{
    Evolution, GivenGrowth, Grown, InelasticError, InelasticPoint, StepControl, Thermal, ThermalExpansion,
};
use piola_numerics::linear::matrix3::from_rows;
use piola_solids::{Hyperelastic, NeoHookeanCiarlet, SolidsError};
use piola_testkit::golden::{self, matrix, number, text, vector};
use piola_testkit::{Tol, assert_close_at_scale};
use serde_json::Value;

type Fallible = Result<(), Box<dyn Error>>;

fn deformation() -> Result<DeformationGradient, Box<dyn Error>> {
    Ok(DeformationGradient::from_rows([[1.2, 0.25, 0.0], [0.0, 0.9, 0.1], [0.05, 0.0, 1.05]])?)
}

/// Follows a path of `grown_paths.json`: the user writes the state, which `state` reads, before each increment.
fn follow<L: Evolution<S, X>, const S: usize, const X: usize>(
    name: &str,
    law: &L,
    state: impl Fn(&Value) -> Vec<f64>,
) -> Result<usize, Box<dyn Error>> {
    let golden = golden::load("grown_paths");
    let mut before = DeformationGradient::identity();
    let mut count = 0;
    for leg in golden.cases.iter().filter(|case| text(&case["law"]) == name) {
        let to = deformation_of(&leg["input"]["to"])?;
        let mut point = InelasticPoint::with_state(law, &state(&leg["input"]), &before)?;
        let found = point.advance(&to, 0.5, &StepControl::default())?;
        let tol = Tol::ulps_because(256.0, "F G⁻¹, the stress of the law, and two products with G⁻¹");
        let close = |what: &str, found: &[f64], expected: &Value| {
            let expected = vector(expected);
            let scale = expected.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
            assert_close_at_scale(&format!("{}: {what}", text(&leg["id"])), found, &expected, scale, tol);
        };
        close("P", found.first_piola.0.transpose().as_slice(), &leg["output"]["P"]);
        close("∂P/∂F", found.tangent.0.components.as_flattened(), &leg["output"]["tangent"]);
        (before, count) = (to, count + 1);
    }
    Ok(count)
}

fn deformation_of(value: &Value) -> Result<DeformationGradient, Box<dyn Error>> {
    let rows = matrix(value);
    Ok(DeformationGradient::from_rows(core::array::from_fn(|i| core::array::from_fn(|j| rows[i][j])))?)
}

/// Central differences of the energy at 100 digits.
#[test]
fn stresses_and_tangents_along_paths_of_growth_and_temperature_equal_the_reference() -> Fallible {
    let law = NeoHookeanCiarlet::with_constants(1.0, 5.0)?;
    assert_eq!(follow("given_growth", &GivenGrowth::new(law), |input| matrix(&input["growth"]).concat())?, 4);
    let expansion = ThermalExpansion { coefficient: 1.0 / 1024.0, reference_temperature: 300.0 };
    let thermal = Thermal::new(law, expansion)?;
    assert_eq!(follow("thermal", &thermal, |input| vec![number(&input["temperature"])])?, 4);
    Ok(())
}

#[test]
fn stress_and_tangent_of_given_growth_equal_those_of_the_grown_law() -> Fallible {
    let (law, f) = (NeoHookeanCiarlet::with_constants(1.0, 5.0)?, deformation()?);
    let growth = [[1.25, 0.125, 0.0], [0.0, 1.0, 0.25], [0.0, 0.0, 0.875]];
    let (stress, tangent) = Grown::new(law, &from_rows(growth))?.first_piola_and_tangent(&f);
    let given = GivenGrowth::new(law);
    let mut point = InelasticPoint::with_state(&given, growth.as_flattened(), &DeformationGradient::identity())?;
    let found = point.advance(&f, 1.0, &StepControl::one_step())?;
    assert_close_at_scale("P", found.first_piola.0.as_slice(), stress.0.as_slice(), 1.0, Tol::ulps(64.0));
    let (found_tangent, tangent) = (found.tangent.0.components, tangent.0.components);
    assert_close_at_scale("∂P/∂F", found_tangent.as_flattened(), tangent.as_flattened(), 10.0, Tol::ulps(64.0));
    assert!(found.state.iter().zip(growth.as_flattened()).all(|(x, y)| x.to_bits() == y.to_bits()), "{found:?}");
    Ok(())
}

#[test]
fn stress_of_a_temperature_equals_that_of_the_heated_law() -> Fallible {
    let (law, f) = (NeoHookeanCiarlet::with_constants(1.0, 5.0)?, deformation()?);
    let expansion = ThermalExpansion { coefficient: 1e-3, reference_temperature: 300.0 };
    let stress = Grown::heated(law, &expansion, 420.0)?.first_piola(&f);
    let thermal = Thermal::new(law, expansion)?;
    assert_eq!(InelasticPoint::new(&thermal).state().map(f64::to_bits), [300.0_f64.to_bits()]);
    let found = InelasticPoint::with_state(&thermal, &[420.0], &f)?.trial(&f, 0.0, &StepControl::one_step())?;
    assert_close_at_scale("P", found.first_piola.0.as_slice(), stress.0.as_slice(), 1.0, Tol::ulps(64.0));
    Ok(())
}

#[test]
fn growth_without_volume_and_absurd_temperatures_are_refused() -> Fallible {
    let (law, f) = (NeoHookeanCiarlet::with_constants(1.0, 5.0)?, deformation()?);
    let given = GivenGrowth::new(law);
    let flat = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -0.5];
    let error = InelasticPoint::with_state(&given, &flat, &f)?.trial(&f, 1.0, &StepControl::one_step());
    assert!(
        matches!(error, Err(InelasticError::Solids(SolidsError::BeyondLimit { quantity: "−det G", .. }))),
        "{error:?}"
    );
    let thermal = Thermal::new(law, ThermalExpansion { coefficient: 1.0, reference_temperature: 300.0 })?;
    for (temperature, what) in [(1e4, "ϑ"), (-1e4, "1/ϑ")] {
        let error = InelasticPoint::with_state(&thermal, &[temperature], &f)?.trial(&f, 1.0, &StepControl::one_step());
        let Err(InelasticError::Solids(SolidsError::BeyondLimit { quantity, .. })) = error else {
            return Err(format!("{temperature}: {error:?}").into());
        };
        assert_eq!(quantity, what);
    }
    let error = Thermal::new(law, ThermalExpansion { coefficient: f64::NAN, reference_temperature: 300.0 });
    assert!(matches!(error, Err(InelasticError::NotFinite { .. })), "{error:?}");
    Ok(())
}
