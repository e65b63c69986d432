//! The consistent tangent: against difference quotients, and as Newton's method for equilibrium uses it.

use core::error::Error;

use nalgebra::{Matrix2, Matrix3, Vector2};
use piola_continuum::DeformationGradient;
use piola_inelastic::{Evolution, InelasticPoint, StepControl};
use piola_testkit::{Tol, assert_close};

use super::laws::{grown, hot, in_series};
use super::paths::{bergstrom_boyce, driven_growth, kinematic, mullins, reese_govindjee, viscoplastic};

type Fallible = Result<(), Box<dyn Error>>;

fn start() -> Result<DeformationGradient, Box<dyn Error>> {
    Ok(DeformationGradient::from_rows([[1.2, 0.25, 0.0], [0.0, 0.9, 0.1], [0.05, 0.0, 1.05]])?)
}

/// (P(F + h G) − P(F − h G))/(2 h), Richardson's extrapolation of two widths.
fn check_tangent<L: Evolution<S, X>, const S: usize, const X: usize>(
    what: &str,
    law: &L,
    control: &StepControl,
) -> Fallible {
    let mut point = InelasticPoint::new(law);
    point.advance(&start()?, 0.3, control)?;
    let to = Matrix3::new(1.3, 0.1, 0.05, 0.1, 0.95, 0.0, 0.0, 0.15, 1.1);
    let at = |f: Matrix3<f64>| -> Result<_, Box<dyn Error>> {
        Ok(point.trial(&DeformationGradient::new(f)?, 0.2, control)?)
    };
    let here = at(to)?;
    let mut tangent = here.tangent.0.components;
    let mut quotients = [[0.0; 9]; 9];
    for column in 0..9 {
        let mut direction = Matrix3::zeros();
        direction[(column / 3, column % 3)] = 1.0;
        let quotient = |h: f64| -> Result<Matrix3<f64>, Box<dyn Error>> {
            let (up, down) = (at(to + direction * h)?, at(to - direction * h)?);
            Ok((up.first_piola.0 - down.first_piola.0) / (2.0 * h))
        };
        // Stresses with an error of 1e-9 need a wider quotient than those of one step.
        let h = if control.tolerance().is_some() { 1e-3 } else { 1e-4 };
        let rate = (quotient(h)? * 4.0 - quotient(2.0 * h)?) / 3.0;
        for row in 0..9 {
            quotients[row][column] = rate[(row / 3, row % 3)];
        }
    }
    let tol = Tol::stated(
        if control.tolerance().is_some() { 1e-6 } else { 2e-9 },
        "difference quotients of the fourth order, and errors of the stress over their width",
    );
    assert_close(what, tangent.as_flattened_mut(), quotients.as_flattened(), tol);
    Ok(())
}

#[test]
fn consistent_tangents_equal_difference_quotients_of_the_stress() -> Fallible {
    let (one, controlled) = (StepControl::one_step(), StepControl::new(1e-9)?);
    check_tangent("Bergström–Boyce", &bergstrom_boyce()?, &one)?;
    check_tangent("Reese–Govindjee", &reese_govindjee()?, &one)?;
    check_tangent("driven growth", &driven_growth()?, &one)?;
    check_tangent("Mullins", &mullins()?, &one)?;
    check_tangent("in series", &in_series()?, &one)?;
    check_tangent("Reese–Govindjee, extrapolated", &reese_govindjee()?, &controlled)?;
    check_tangent("driven growth, extrapolated", &driven_growth()?, &controlled)?;
    check_tangent("viscoplastic", &viscoplastic(0.5)?, &one)?;
    check_tangent("plastic", &viscoplastic(0.0)?, &one)?;
    check_tangent("kinematic, viscous", &kinematic(0.5)?, &one)?;
    check_tangent("kinematic", &kinematic(0.0)?, &one)?;
    // The first increment begins to flow inside.
    check_tangent("plastic, extrapolated", &viscoplastic(0.0)?, &controlled)?;
    check_tangent("kinematic, extrapolated", &kinematic(0.0)?, &controlled)
}

/// Residuals of the free sides of a bar that is pulled, iteration by iteration.
fn residuals<L: Evolution<S, X>, const S: usize, const X: usize>(law: &L) -> Result<Vec<f64>, Box<dyn Error>> {
    let point = InelasticPoint::new(law);
    let (mut sides, mut residuals) = (Vector2::new(1.0, 1.0), Vec::new());
    for _ in 0..8 {
        let to = DeformationGradient::diagonal([1.4, sides[0], sides[1]])?;
        let here = point.trial(&to, 0.2, &StepControl::one_step())?;
        let residual = Vector2::new(here.first_piola.0[(1, 1)], here.first_piola.0[(2, 2)]);
        residuals.push(residual.norm());
        let entry = |i: usize, j: usize| here.tangent.entry(i, i, j, j);
        let matrix = Matrix2::new(entry(1, 1), entry(1, 2), entry(2, 1), entry(2, 2));
        sides -= matrix.try_inverse().ok_or("a singular tangent")? * residual;
    }
    Ok(residuals)
}

fn check_quadratic(what: &str, residuals: &[f64]) {
    // Each residual is below a constant times the square of the one before, down to rounding.
    let last = residuals[residuals.len() - 1];
    assert!(last <= 1e-13, "{what}: {residuals:?}");
    let mut compared = 0;
    for pair in residuals.windows(2) {
        if pair[0] < 0.1 && 1e-13 < pair[1] {
            assert!(pair[1] <= 4.0 * pair[0] * pair[0], "{what}: {residuals:?}");
            compared += 1;
        }
    }
    assert!(0 < compared, "{what}: {residuals:?}");
}

#[test]
fn newtons_method_for_free_sides_converges_quadratically_with_the_consistent_tangent() -> Fallible {
    check_quadratic("Bergström–Boyce", &residuals(&bergstrom_boyce()?)?);
    check_quadratic("Reese–Govindjee", &residuals(&reese_govindjee()?)?);
    check_quadratic("viscoplastic", &residuals(&viscoplastic(0.5)?)?);
    check_quadratic("plastic", &residuals(&viscoplastic(0.0)?)?);
    check_quadratic("kinematic", &residuals(&kinematic(0.0)?)?);
    check_quadratic("kinematic, viscous", &residuals(&kinematic(0.5)?)?);
    check_quadratic("driven growth", &residuals(&driven_growth()?)?);
    check_quadratic("Mullins", &residuals(&mullins()?)?);
    check_quadratic("in series", &residuals(&in_series()?)?);
    check_quadratic("thermal", &residuals(&hot()?)?);
    check_quadratic("given growth", &residuals(&grown()?)?);
    Ok(())
}
