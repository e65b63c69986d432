//! Growth and thermal expansion against derivatives of the energy and closed forms.

use core::error::Error;

use nalgebra::Matrix3;
use piola_continuum::DeformationGradient;
use piola_inelastic::{Grown, InelasticError, ThermalExpansion};
use piola_solids::{Fibre, Hyperelastic, MooneyRivlin, NeoHookeanCiarlet, derived};
use piola_testkit::{Tol, assert_close};

#[test]
fn answers_of_a_grown_body_equal_derivatives_of_its_energy() -> Result<(), Box<dyn Error>> {
    let growth = Matrix3::new(1.2, 0.1, 0.0, 0.0, 0.9, 0.2, 0.1, 0.0, 1.1);
    let law = Grown::new(MooneyRivlin::stress_free(0.5, 0.25, 1.0)?, &growth)?;
    let f = DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]])?;
    let (w, p, a) = law.energy_first_piola_and_tangent(&f);
    let (v, q, b) = derived::energy_first_piola_and_tangent(&law, &f);
    let tol = Tol::ulps_because(256.0, "two orders of summation of some hundred terms");
    assert_close("W", &[w], &[v], tol);
    assert_close("P", p.0.as_slice(), q.0.as_slice(), tol);
    assert_close("∂P/∂F", &a.0.components.concat(), &b.0.components.concat(), tol);
    Ok(())
}

#[test]
fn a_body_deformed_as_it_grew_has_no_stress() -> Result<(), Box<dyn Error>> {
    let law = Grown::along(NeoHookeanCiarlet::with_constants(1.0, 2.0)?, 1.5, Fibre::new([0.6, 0.8, 0.0])?)?;
    let stress = law.first_piola(&DeformationGradient::new(law.growth())?).0;
    assert!(stress.norm() <= 16.0 * f64::EPSILON, "{stress}");
    // 1 + (ϑ − 1) a ⊗ a.
    let expected = Matrix3::new(1.18, 0.24, 0.0, 0.24, 1.32, 0.0, 0.0, 0.0, 1.0);
    assert_close("G", law.growth().as_slice(), expected.as_slice(), Tol::ulps(4.0));
    Ok(())
}

/// Held at its length in one direction alone, a heated bar is under the pressure E α ΔT, to the first order.
#[test]
fn thermal_stress_of_a_held_bar_at_small_expansion_equals_hookes() -> Result<(), Box<dyn Error>> {
    let (mu, lambda) = (1.0, 2.0);
    let young = mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
    let expansion = ThermalExpansion { coefficient: 1e-8, reference_temperature: 300.0 };
    let law = Grown::heated(NeoHookeanCiarlet::with_constants(mu, lambda)?, &expansion, 400.0)?;
    let bar = piola_specimens::homogeneous::uniaxial(&law, 1.0)?;
    let tol = Tol::stated(1e-5, "terms of the second order in the strain of 1e-6");
    assert_close("P₁₁", &[bar.first_piola.0[(0, 0)]], &[-young * 1e-6], tol);
    Ok(())
}

#[test]
fn growth_without_a_volume_is_refused() -> Result<(), Box<dyn Error>> {
    let law = NeoHookeanCiarlet::with_constants(1.0, 2.0)?;
    assert!(matches!(Grown::isotropic(law, 0.0), Err(InelasticError::OutOfBounds { parameter: "ϑ", .. })));
    let error = Grown::new(law, &Matrix3::from_element(f64::NAN));
    assert!(matches!(error, Err(InelasticError::NotFinite { quantity: "G", index: 0, .. })));
    Ok(())
}
