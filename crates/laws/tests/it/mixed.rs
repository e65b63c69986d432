//! Mixed forms against second derivatives of their energy by dual numbers, and against the law itself in equilibrium.

use core::error::Error;

use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_laws::mixed::{ThreeField, TwoField, two_field};
use piola_laws::{Decoupled, LawsError};
use piola_numerics::derivatives::{ScalarFunction, gradient, hessian};
use piola_numerics::{Lanes, Real};
use piola_solids::isochoric::{Gent, NeoHookean};
use piola_solids::volumetric::{Logarithmic, Quadratic};
use piola_solids::{
    BlatzKo, Compressible, Hencky, Hyperelastic, IncompressibleSolid, MooneyRivlin, ReinforcedNeoHookean,
    SaintVenantKirchhoff, SolidsError,
};
use piola_testkit::{Tol, allocations_in, assert_close, assert_close_at_scale};

type Fallible = Result<(), Box<dyn Error>>;

fn sample() -> DeformationGradient {
    DeformationGradient::from_rows([[1.1, 0.2, 0.0], [-0.1, 0.9, 0.3], [0.05, 0.1, 1.02]]).expect("0 < det F")
}

/// Π of F by rows, θ and p, written without the library's own change of volume.
struct Potential<'a, L>(&'a L);

impl<L: Hyperelastic> ScalarFunction for Potential<'_, L> {
    fn call<T: Real>(&self, x: &[T]) -> T {
        let f = [[x[0], x[1], x[2]], [x[3], x[4], x[5]], [x[6], x[7], x[8]]];
        let jacobian = piola_numerics::linear::matrix3::determinant(f);
        let scale = (x[9] / jacobian).cbrt();
        let resized = f.map(|row| row.map(|entry| entry * scale));
        let resized = DeformationGradient::from_rows(resized).expect("0 < det F");
        self.0.energy(&resized) + x[10] * (jacobian - x[9])
    }
}

/// All residuals and second derivatives of the three-field form, as a gradient and a Hessian in 11 variables.
fn check(what: &str, law: &impl Hyperelastic, [volume, pressure]: [f64; 2]) -> Fallible {
    let f = sample();
    let mut x = f.gradient_rows().concat();
    x.extend([volume, pressure]);
    let (slopes, curvatures) = (gradient(&Potential(law), &x)?, hessian(&Potential(law), &x)?);
    let at = ThreeField::checked(law, &f, volume - 1.0, pressure)?;
    let tol = Tol::ulps_because(512.0, "P and ∂P/∂F of two formulas, and some hundred terms beside them");
    let scale = curvatures.amax();
    let near = |quantity: &str, found: &[f64], expected: &[f64]| {
        assert_close_at_scale(&format!("{what}: {quantity}"), found, expected, scale, tol);
    };
    near("Π", &[at.energy], &[Potential(law).call(&x)]);
    near("∂Π/∂F", at.first_piola.0.transpose().as_slice(), &slopes.as_slice()[..9]);
    near("∂Π/∂θ, ∂Π/∂p", &[at.volume_residual, at.pressure_residual], &slopes.as_slice()[9..]);
    for row in 0..9 {
        let expected: Vec<f64> = (0..9).map(|column| curvatures[(row, column)]).collect();
        near("∂²Π/∂F²", &at.tangent.0.components[row], &expected);
    }
    let column = |c: usize| -> Vec<f64> { (0..9).map(|row| curvatures[(row, c)]).collect() };
    near("∂²Π/∂F∂θ", at.coupling.0.transpose().as_slice(), &column(9));
    near("∂²Π/∂F∂p", at.cofactor.transpose().as_slice(), &column(10));
    near("∂²Π/∂θ², ∂²Π/∂θ∂p", &[at.bulk, -1.0], &[curvatures[(9, 9)], curvatures[(9, 10)]]);
    Ok(())
}

#[test]
fn three_field_form_equals_the_gradient_and_hessian_of_its_energy() -> Fallible {
    let fibre = piola_solids::Fibre::new([0.6, 0.8, 0.0])?;
    check("Gent", &Compressible::new(Gent::new(1.0, 30.0)?, Quadratic::new(20.0)?), [1.15, 0.7])?;
    check("Mooney–Rivlin", &MooneyRivlin::stress_free(0.5, 0.25, 2.0)?, [0.9, -1.5])?;
    check("St. Venant–Kirchhoff", &SaintVenantKirchhoff::new(1.0, 2.0)?, [1.2, 0.5])?;
    check("Hencky", &Hencky::new(3.0, 1.0)?, [1.1, 0.5])?;
    check("Blatz–Ko", &BlatzKo::new(1.0, 0.3, 0.4)?, [0.9, 0.5])?;
    check("reinforced", &ReinforcedNeoHookean::new(1.0, 2.0, 3.0, fibre)?, [1.05, 0.5])?;
    check(
        "decoupled",
        &Decoupled { shape: Hencky::new(3.0, 1.0)?, volume: SaintVenantKirchhoff::new(1.0, 3.0)? },
        [1.1, 0.5],
    )?;
    check("incompressible", &IncompressibleSolid::new(Gent::new(1.0, 30.0)?), [1.0, 0.7])
}

/// With θ = J and p = ⅓ tr T the stress is the law's, and eliminating θ and p gives the law's tangent.
#[test]
fn eliminated_volume_and_pressure_give_the_stress_and_tangent_of_the_law() -> Fallible {
    fn check(what: &str, law: &impl Hyperelastic) -> Fallible {
        let f = sample();
        let pressure = law.cauchy(&f).0.trace() / 3.0;
        let at = ThreeField::checked(law, &f, f.volume_change(), pressure)?;
        let (stress, tangent) = law.first_piola_and_tangent(&f);
        let tol = Tol::ulps_because(512.0, "P and ∂P/∂F of two formulas, and some hundred terms beside them");
        let scale = tangent.0.components.concat().iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
        assert_close_at_scale(what, at.first_piola.0.as_slice(), stress.0.as_slice(), scale, tol);
        assert_close_at_scale(what, &[at.volume_residual, at.pressure_residual], &[0.0; 2], scale, tol);
        let (g, n) = (at.coupling.0.transpose(), at.cofactor.transpose());
        let (g, n) = (g.as_slice(), n.as_slice());
        for (row, (found, expected)) in at.tangent.0.components.iter().zip(tangent.0.components).enumerate() {
            let whole: Vec<f64> = found
                .iter()
                .enumerate()
                .map(|(s, x)| x + g[row] * n[s] + n[row] * g[s] + at.bulk * n[row] * n[s])
                .collect();
            assert_close_at_scale(what, &whole, &expected, scale, tol);
        }
        // The u–p form: K + b ⊗ b h with b = cof F + g/h.
        let TwoField { first_piola, pressure_residual, tangent: k, cofactor, compliance, .. } =
            two_field(law, &f, pressure)?;
        assert_close_at_scale(what, first_piola.0.as_slice(), stress.0.as_slice(), scale, tol);
        assert_close_at_scale(what, &[pressure_residual], &[0.0], 1.0, tol);
        let b = cofactor.transpose();
        for (row, expected) in tangent.0.components.iter().enumerate() {
            let part = |s: usize| k.0.components[row][s] + b.as_slice()[row] * b.as_slice()[s] / compliance;
            let whole: Vec<f64> = (0..9).map(part).collect();
            assert_close_at_scale(what, &whole, expected, scale, tol);
        }
        Ok(())
    }
    check("Gent", &Compressible::new(Gent::new(1.0, 30.0)?, Logarithmic::new(20.0)?))?;
    check("Mooney–Rivlin", &MooneyRivlin::stress_free(0.5, 0.25, 2.0)?)?;
    check("Hencky", &Hencky::new(3.0, 1.0)?)?;
    check("Blatz–Ko", &BlatzKo::new(1.0, 0.3, 0.4)?)
}

/// ½ κ (θ − 1)² and ½ κ (ln θ)²: θ = 1 + p/κ, and p = κ ln θ/θ.
#[test]
fn volumes_of_the_two_field_form_equal_closed_forms() -> Fallible {
    let f = sample();
    let jacobian = f.jacobian();
    let quadratic = Compressible::new(NeoHookean::new(1.0)?, Quadratic::new(2000.0)?);
    let at = two_field(&quadratic, &f, 300.0)?;
    assert_close("J − θ", &[at.pressure_residual], &[jacobian - 1.15], Tol::ulps(64.0));
    assert_close("1/h", &[at.compliance], &[1.0 / 2000.0], Tol::ulps(64.0));
    let logarithmic = Compressible::new(NeoHookean::new(1.0)?, Logarithmic::new(10.0)?);
    let at = two_field(&logarithmic, &f, 10.0 * 1.3_f64.ln() / 1.3)?;
    assert_close_at_scale("J − θ", &[at.pressure_residual], &[jacobian - 1.3], 1.0, Tol::ulps(64.0));
    // κ ln θ/θ has its largest value κ/e at θ = e: no volume has a larger mean stress.
    let beyond = two_field(&logarithmic, &f, 5.0);
    assert!(matches!(beyond, Err(LawsError::NoVolume { mean_stress: 5.0, .. })), "{beyond:?}");
    Ok(())
}

/// The stress of 2 μ dev ε + p 1 at strains of 1e-16, where F itself is 1.
#[test]
fn residuals_at_small_strain_have_all_digits() -> Fallible {
    let law = Compressible::new(NeoHookean::new(1.0)?, Quadratic::new(10.0)?);
    let f = DisplacementGradient::from_rows([[1e-16, 2e-16, 0.0], [2e-16, -3e-16, 0.0], [0.0, 0.0, 4e-16]])?;
    let at = ThreeField::checked(&law, &f, 5e-16, 7e-16)?;
    // tr ε = 2e-16.
    let third = 2e-16 / 3.0;
    let expected =
        [2.0 * (1e-16 - third) + 7e-16, 4e-16, 2.0 * (-3e-16 - third) + 7e-16, 2.0 * (4e-16 - third) + 7e-16];
    let found = [(0, 0), (0, 1), (1, 1), (2, 2)].map(|place| at.first_piola.0[place]);
    assert_close("P", &found, &expected, Tol::ulps(64.0));
    assert_close("∂Π/∂θ", &[at.volume_residual], &[50e-16 - 7e-16], Tol::ulps(64.0));
    assert_close("J − θ", &[at.pressure_residual], &[-3e-16], Tol::ulps(64.0));
    Ok(())
}

#[test]
fn mixed_form_in_lanes_has_the_numbers_of_one_point_and_allocates_nothing() -> Fallible {
    let law = Compressible::new(NeoHookean::new(1.0)?, Quadratic::new(10.0)?);
    let f = sample();
    let one = ThreeField::of(&law, &f, 0.1, 0.5);
    let lanes = f.lifted(|_, _, x| Lanes::<f64, 4>([x; 4]));
    let four = ThreeField::of(&law, &lanes, Lanes([0.1; 4]), Lanes([0.5; 4]));
    let tol = Tol::ulps_because(64.0, "logarithms and exponentials of lanes");
    for (r, row) in one.tangent.0.components.iter().enumerate() {
        let found = four.tangent.0.components[r].map(|x| x.0[3]);
        assert_close_at_scale("∂²Π/∂F²", &found, row, 10.0, tol);
    }
    assert_close("∂Π/∂θ", &[four.volume_residual.0[1]], &[one.volume_residual], tol);
    let (count, result) = allocations_in(|| two_field(&law, &f, 0.5));
    assert_eq!(count, 0);
    result?;
    Ok(())
}

#[test]
fn mixed_forms_refuse_volumes_and_pressures_by_name() -> Fallible {
    let law = Compressible::new(NeoHookean::new(1.0)?, Quadratic::new(10.0)?);
    let f = sample();
    for change in [-1.0, -2.0, f64::NAN, f64::INFINITY] {
        let error = ThreeField::checked(&law, &f, change, 0.0);
        assert!(matches!(error, Err(LawsError::OutOfBounds { quantity: "θ", .. })), "{change}: {error:?}");
    }
    let error = two_field(&law, &f, f64::NAN);
    assert!(matches!(error, Err(LawsError::OutOfBounds { quantity: "p", .. })), "{error:?}");
    let incompressible = IncompressibleSolid::new(NeoHookean::new(1.0)?);
    let error = ThreeField::checked(&incompressible, &f, 0.1, 0.0);
    assert!(matches!(error, Err(LawsError::Solids(_))), "{error:?}");
    assert!(two_field(&incompressible, &f, 0.3).is_ok());
    let gent = IncompressibleSolid::new(Gent::new(1.0, 0.5)?);
    let error = two_field(&gent, &DeformationGradient::simple_shear(1.0)?, 0.0);
    assert!(matches!(error, Err(LawsError::Solids(SolidsError::BeyondLimit { .. }))), "{error:?}");
    Ok(())
}
