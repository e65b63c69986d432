//! Springs in series against closed forms.

use core::error::Error;

use piola_continuum::DeformationGradient;
use piola_inelastic::{Evolution, InSeries, InelasticError, InelasticPoint, StepControl};
use piola_numerics::linear::matrix3::rows_of;
use piola_solids::{Hencky, Hyperelastic, NeoHookeanCiarlet};
use piola_testkit::{Tol, assert_close};

type Fallible = Result<(), Box<dyn Error>>;

/// For Hencky's springs about the same axes logarithms add, and so do the compliances: 1/μ = 1/μ₁ + 1/μ₂ for equal ratios λ/μ.
#[test]
fn stress_of_henckys_springs_in_series_equals_that_of_the_summed_compliance() -> Fallible {
    let law = InSeries::new(Hencky::new(3.0, 1.5)?, Hencky::new(6.0, 3.0)?, 0.0)?;
    let whole = Hencky::new(2.0, 1.0)?;
    for stretches in [[1.5, 0.9, 0.8], [0.6, 1.2, 1.3], [1.01, 1.0, 1.0]] {
        let f = DeformationGradient::diagonal(stretches)?;
        let point = InelasticPoint::new(&law);
        let advanced = point.trial(&f, 1.0, &StepControl::one_step())?;
        let (stress, tangent) = whole.first_piola_and_tangent(&f);
        let tol = Tol::ulps_because(1e3, "Newton's method ends at a residual of 1e-15");
        assert_close("P", advanced.first_piola.0.as_slice(), stress.0.as_slice(), tol);
        let entry = |k: usize| [advanced.tangent.entry(0, 0, k, k), tangent.entry(0, 0, k, k)];
        for k in 0..3 {
            let [own, expected] = entry(k);
            assert_close("∂P₁₁/∂F", &[own], &[expected], tol);
        }
    }
    Ok(())
}

/// A dashpot beside the second spring: the first bears all at once, later the two share, and no step gains work.
#[test]
fn damped_springs_in_series_creep_from_the_first_to_both() -> Fallible {
    let (first, second) = (Hencky::new(3.0, 1.5)?, Hencky::new(6.0, 3.0)?);
    let law = InSeries::new(first, second, 0.5)?;
    let f = DeformationGradient::diagonal([1.3, 0.9, 1.0])?;
    let mut point = InelasticPoint::new(&law);
    let at_once = point.advance(&f, 1e-12, &StepControl::one_step())?;
    let tol = Tol::stated(1e-10, "a time of 1e-12 of the relaxation");
    assert_close("P", at_once.first_piola.0.as_slice(), first.first_piola(&f).0.as_slice(), tol);
    for _ in 0..20 {
        let before = *point.state();
        let after = point.advance(&f, 1.0, &StepControl::one_step())?.state;
        assert!(-1e-14 <= law.dissipated(&before, &rows_of(f.matrix()), &after));
    }
    let late = point.trial(&f, 1.0, &StepControl::one_step())?;
    let whole = Hencky::new(2.0, 1.0)?.first_piola(&f);
    assert_close("P", late.first_piola.0.as_slice(), whole.0.as_slice(), Tol::stated(1e-10, "twenty relaxation times"));
    Ok(())
}

/// Without a dashpot the state at the end does not depend on the path: neo-Hookean springs over two ways to one place.
#[test]
fn springs_in_series_without_a_dashpot_are_elastic() -> Fallible {
    let law =
        InSeries::new(NeoHookeanCiarlet::with_constants(1.0, 2.0)?, NeoHookeanCiarlet::with_constants(3.0, 1.0)?, 0.0)?;
    let f = DeformationGradient::from_rows([[1.2, 0.3, 0.0], [0.1, 0.9, 0.1], [0.0, 0.2, 1.1]])?;
    let straight = InelasticPoint::new(&law).advance(&f, 1.0, &StepControl::one_step())?;
    let mut point = InelasticPoint::new(&law);
    for by in [[0.2, 0.0, 0.1], [-0.1, 0.3, 0.0]] {
        let detour = DeformationGradient::from_rows([[1.0 + by[0], by[1], 0.0], [by[2], 1.0, by[0]], [0.0, 0.0, 0.9]])?;
        point.advance(&detour, 1.0, &StepControl::one_step())?;
    }
    let other = point.advance(&f, 1.0, &StepControl::one_step())?;
    let tol = Tol::ulps_because(1e3, "Newton's method ends at a residual of 1e-15");
    assert_close("P", other.first_piola.0.as_slice(), straight.first_piola.0.as_slice(), tol);
    // In another unit of stress.
    for unit in [1e-9, 1e9] {
        let (first, second) = ([unit, 2.0 * unit], [3.0 * unit, unit]);
        let [first, second] = [first, second].map(|[mu, lambda]| NeoHookeanCiarlet::with_constants(mu, lambda));
        let law = InSeries::new(first?, second?, 0.0)?;
        let stress = InelasticPoint::new(&law).advance(&f, 1.0, &StepControl::one_step())?.first_piola.0 / unit;
        assert_close("P", stress.as_slice(), straight.first_piola.0.as_slice(), tol);
    }
    Ok(())
}

#[test]
fn a_negative_viscosity_is_refused() -> Fallible {
    let error = InSeries::new(Hencky::new(1.0, 1.0)?, Hencky::new(1.0, 1.0)?, -1.0).map(|_| ());
    assert!(matches!(error, Err(InelasticError::OutOfBounds { parameter: "viscosity", .. })));
    Ok(())
}
