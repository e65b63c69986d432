//! Sums, shares and the split of laws against what they are made of.

use core::error::Error;

use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_laws::algebra::{Decoupled, OfVolume, Scaled, Sum};
use piola_solids::isochoric::{Gent, NeoHookean};
use piola_solids::volumetric::{Quadratic, SimoTaylor};
use piola_solids::{
    Compressible, Fibre, Hyperelastic, MooneyRivlin, NeoHookeanCiarlet, Polynomial, PolynomialTerm,
    ReinforcedNeoHookean, SaintVenantKirchhoff, derived,
};
use piola_testkit::spectral::{Random, with_stretches};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

fn deformations(count: usize) -> Vec<DeformationGradient> {
    let mut random = Random::new(22);
    let one = |random: &mut Random| {
        let stretches = core::array::from_fn(|_| (0.4 * random.symmetric()).exp());
        let f = with_stretches(&random.rotation(), stretches, &random.rotation());
        DeformationGradient::from_rows(f).expect("0 < det F")
    };
    (0..count).map(|_| one(&mut random)).collect()
}

const TOL: Tol = Tol::ulps_because(512.0, "two orders of summation of some hundred terms");

/// All answers of two laws agree.
fn same(what: &str, a: &impl Hyperelastic, b: &impl Hyperelastic, f: &DeformationGradient) {
    let (w, p, t) = a.energy_first_piola_and_tangent(f);
    let (v, q, u) = b.energy_first_piola_and_tangent(f);
    let scale = u.0.components.concat().iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    assert_close_at_scale(&format!("{what}: W"), &[w], &[v], scale, TOL);
    assert_close_at_scale(&format!("{what}: P"), p.0.as_slice(), q.0.as_slice(), scale, TOL);
    assert_close(&format!("{what}: ∂P/∂F"), &t.0.components.concat(), &u.0.components.concat(), TOL);
    let ((s, c), (z, d)) = (a.second_piola_and_tangent(f), b.second_piola_and_tangent(f));
    assert_close_at_scale(&format!("{what}: S"), &s.0.components, &z.0.components, scale, TOL);
    assert_close(&format!("{what}: ∂S/∂E"), &c.0.components, &d.0.components, TOL);
    let (s, z) = (a.kirchhoff(f).0.components, b.kirchhoff(f).0.components);
    assert_close_at_scale(&format!("{what}: τ"), &s, &z, scale, TOL);
}

#[test]
fn sum_of_a_shape_and_a_volume_equals_the_built_in_sum() -> Result<(), Box<dyn Error>> {
    let shape = Compressible::new(Gent::new(1.0, 50.0)?, Quadratic::new(0.0)?);
    let whole = Compressible::new(Gent::new(1.0, 50.0)?, Quadratic::new(20.0)?);
    for f in deformations(10) {
        same("Gent", &Sum(shape, OfVolume(Quadratic::new(20.0)?)), &whole, &f);
    }
    Ok(())
}

#[test]
fn thrice_a_law_equals_the_sum_of_it_and_twice_it() -> Result<(), Box<dyn Error>> {
    let law = MooneyRivlin::stress_free(0.5, 0.25, 1.0)?;
    for f in deformations(10) {
        same("thrice", &Scaled::new(law, 3.0)?, &Sum(law, Scaled::new(law, 2.0)?), &f);
        same("once", &law, &Sum(Scaled::new(law, 3.0)?, Scaled::unchecked(law, -2.0)), &f);
    }
    Ok(())
}

/// A neo-Hookean law is its own shape, with any volume: (μ/2)(Ī₁ − 3) + U(J).
#[test]
fn decoupled_neo_hookean_law_equals_the_isochoric_one() -> Result<(), Box<dyn Error>> {
    let own =
        Decoupled { shape: NeoHookeanCiarlet::with_constants(0.8, 3.0)?, volume: OfVolume(SimoTaylor::new(20.0)?) };
    let built_in = Compressible::new(NeoHookean::new(0.8)?, SimoTaylor::new(20.0)?);
    for f in deformations(10) {
        same("decoupled", &own, &built_in, &f);
    }
    Ok(())
}

/// Whatever the two laws are, stress and tangent are the derivatives of the energy.
#[test]
fn answers_of_decoupled_anisotropic_laws_equal_derivatives_of_the_energy() -> Result<(), Box<dyn Error>> {
    let law = Decoupled {
        shape: ReinforcedNeoHookean::new(1.0, 2.0, 3.0, Fibre::new([0.6, 0.8, 0.0])?)?,
        volume: ReinforcedNeoHookean::new(2.0, 1.0, 1.0, Fibre::new([0.0, 0.0, 1.0])?)?,
    };
    for f in deformations(5) {
        let (w, p, a) = law.energy_first_piola_and_tangent(&f);
        let (v, q, b) = derived::energy_first_piola_and_tangent(&law, &f);
        assert_close("W", &[w], &[v], TOL);
        assert_close("P", p.0.as_slice(), q.0.as_slice(), TOL);
        assert_close("∂P/∂F", &a.0.components.concat(), &b.0.components.concat(), TOL);
    }
    Ok(())
}

#[test]
fn decoupled_stress_keeps_its_digits_at_small_strain() -> Result<(), Box<dyn Error>> {
    let own =
        Decoupled { shape: NeoHookeanCiarlet::with_constants(0.8, 3.0)?, volume: OfVolume(SimoTaylor::new(20.0)?) };
    let built_in = Compressible::new(NeoHookean::new(0.8)?, SimoTaylor::new(20.0)?);
    let mut random = Random::new(23);
    for exponent in [3, 8, 12, 16] {
        let h = random.matrix().map(|row| row.map(|x| x * 10.0_f64.powi(-exponent)));
        let f = DisplacementGradient::from_rows(h)?;
        let expected = built_in.first_piola(&f).0;
        let tol = Tol::stated(1e-13, "the stress keeps its digits at small strain");
        assert_close("P", own.first_piola(&f).0.as_slice(), expected.as_slice(), tol);
    }
    Ok(())
}

/// W = 2 μ i₂(E)-like part of St. Venant and Kirchhoff's polynomial, which no stable solid is, and the rest of it.
#[test]
fn unchecked_parts_of_a_polynomial_sum_to_it() -> Result<(), Box<dyn Error>> {
    let term = |first, second, coefficient| PolynomialTerm { first, second, third: 0, coefficient };
    // C₁₀₀ = μ, C₀₁₀ = −μ/2, C₂₀₀ = (λ + 2 μ)/8 with λ = 1, μ = 2.
    let negative = Polynomial::unchecked(vec![term(0, 1, -1.0)]);
    assert!(Polynomial::stress_free(vec![term(0, 1, -1.0)]).is_err());
    let sum = Sum(negative, Polynomial::unchecked(vec![term(1, 0, 2.0), term(2, 0, 0.625)]));
    for f in deformations(5) {
        let (whole, summed) = (SaintVenantKirchhoff::new(1.0, 2.0)?.cauchy(&f).0, sum.cauchy(&f).0);
        assert_close_at_scale("T", &summed.components, &whole.components, 10.0 / f.jacobian(), TOL);
    }
    Ok(())
}
