//! Plane stress against closed forms and difference quotients.

use core::error::Error;

use piola_laws::LawsError;
use piola_laws::plane::{plane_strain, plane_stress};
use piola_solids::{ElasticConstants, Hencky, LinearElastic, MooneyRivlin};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

type Fallible = Result<(), Box<dyn Error>>;

/// E/(1 − ν²) [1, ν; ν, 1] of the linear sheet.
#[test]
fn tangent_of_a_linear_sheet_equals_the_plane_stress_stiffness() -> Fallible {
    let law = LinearElastic::new(ElasticConstants::from_lame(2.0, 1.0)?)?;
    let state = plane_stress(&law, &[[1.01, 0.002], [0.0, 0.99]])?;
    // λ* = 2 λ μ/(λ + 2 μ) = 1.
    let (lambda, mu) = (1.0, 1.0);
    let expected = [lambda + 2.0 * mu, lambda, 0.0, 0.0, mu, mu];
    let [a, b, _, d] = state.tangent;
    let found = [a[0], a[3], a[1], d[2], b[1], b[2]];
    assert_close("stiffness", &found, &expected, Tol::ulps(64.0));
    assert!(state.normal_stress.abs() < 1e-17, "{state:?}");
    Ok(())
}

#[test]
fn tangent_of_plane_stress_equals_difference_quotients_of_its_stress() -> Fallible {
    let law = MooneyRivlin::stress_free(0.5, 0.25, 2.0)?;
    let here = [[1.3, 0.2], [-0.1, 0.9]];
    let state = plane_stress(&law, &here)?;
    for column in 0..4 {
        let moved = |h: f64| -> Result<[f64; 4], Box<dyn Error>> {
            let mut there = here;
            there[column / 2][column % 2] += h;
            Ok(plane_stress(&law, &there)?.first_piola)
        };
        let quotient = |h: f64| -> Result<Vec<f64>, Box<dyn Error>> {
            Ok(moved(h)?.iter().zip(moved(-h)?).map(|(up, down)| (up - down) / (2.0 * h)).collect())
        };
        let (fine, coarse) = (quotient(5e-4)?, quotient(1e-3)?);
        let rate: Vec<f64> = fine.iter().zip(coarse).map(|(fine, coarse)| (4.0 * fine - coarse) / 3.0).collect();
        let found: Vec<f64> = state.tangent.iter().map(|row| row[column]).collect();
        let tol = Tol::stated(1e-9, "difference quotients of the fourth order in 1e-3");
        assert_close_at_scale("∂P/∂F", &found, &rate, 1.0, tol);
    }
    Ok(())
}

/// In plane strain at the thickness of plane stress both are the same state: Hencky's law with λ = 0.
#[test]
fn plane_strain_and_plane_stress_agree_where_nothing_contracts() -> Fallible {
    let law = Hencky::new(0.0, 1.0)?;
    let here = [[1.3, 0.2], [-0.1, 0.9]];
    let (strain, stress) = (plane_strain(&law, &here)?, plane_stress(&law, &here)?);
    assert_close("P", &strain.first_piola, &stress.first_piola, Tol::ulps(64.0));
    assert_close("F₃₃", &[stress.thickness_stretch], &[1.0], Tol::ulps(4.0));
    Ok(())
}

#[test]
fn a_sheet_turned_inside_out_is_refused() -> Fallible {
    let law = Hencky::new(2.0, 1.0)?;
    assert!(matches!(plane_stress(&law, &[[-1.0, 0.0], [0.0, 1.0]]), Err(LawsError::Continuum(_))));
    assert!(matches!(plane_strain(&law, &[[f64::NAN, 0.0], [0.0, 1.0]]), Err(LawsError::Continuum(_))));
    Ok(())
}
