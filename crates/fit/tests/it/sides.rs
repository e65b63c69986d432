//! Fits of foams and of fibre-reinforced laws to tests made by the laws themselves; refusals.

use core::error::Error;

use piola_continuum::DeformationGradient;
use piola_fit::sides::{Loading, SidesModel, SidesOptions, SidesTest, fit_sides};
use piola_fit::{Criteria, FitError, State};
use piola_laws::OfStretches;
use piola_laws::rubber::{FoamTerm, Hyperfoam};
use piola_solids::{Fibre, HolzapfelGasserOgden, Hyperelastic};
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close};

type Fallible = Result<(), Box<dyn Error>>;

/// Of data without errors: the root of the rounding of S.
const FOUND: Tol = Tol::stated(1e-6, "the root of the rounding of the sum of squares");

/// The root of a rising function.
fn root(mut low: f64, mut high: f64, of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if of(middle) < 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

fn stress(law: &impl Hyperelastic, stretches: [f64; 3]) -> [f64; 3] {
    let stress = law.first_piola(&DeformationGradient::diagonal(stretches).expect("0 < det F")).0;
    [0, 1, 2].map(|a| stress[(a, a)])
}

/// Tests of a foam by the law itself: sides by bisection of P = 0.
fn of_foam(terms: &[FoamTerm]) -> Result<Vec<SidesTest>, Box<dyn Error>> {
    let law = OfStretches(Hyperfoam::new(terms)?);
    let stretches = [0.35, 0.45, 0.55, 0.65, 0.75, 0.85, 0.95, 1.1, 1.2];
    let bar = stretches.map(|x| {
        let side = root(0.2, 3.0, |side| stress(&law, [x, side, side])[1]);
        (x, stress(&law, [x, side, side])[0], Some(side))
    });
    let sheet = stretches.map(|x| {
        let side = root(0.2, 3.0, |side| stress(&law, [x, 1.0, side])[2]);
        (x, stress(&law, [x, 1.0, side])[0], None)
    });
    let both = stretches.map(|x| {
        let side = root(0.2, 3.0, |side| stress(&law, [x, x, side])[2]);
        (x, stress(&law, [x, x, side])[1], Some(side))
    });
    let volumes = stretches.map(|volume| {
        let x = volume.cbrt();
        (volume, -stress(&law, [x; 3])[0] / (x * x), None)
    });
    let mut shears = Vec::new();
    for k in [0.2, 0.4, 0.6] {
        shears.push((k, law.cauchy(&DeformationGradient::simple_shear(k)?).0.components[3], None));
    }
    Ok(vec![
        SidesTest::new("bar", Loading::Uniaxial, &bar)?,
        SidesTest::new("sheet", Loading::Planar, &sheet)?,
        SidesTest::new("both", Loading::Equibiaxial, &both)?,
        SidesTest::new("volumes", Loading::Volumetric, &volumes)?,
        SidesTest::new("shears", Loading::SimpleShear, &shears)?,
    ])
}

#[test]
fn fitted_foam_equals_the_one_that_made_the_tests() -> Fallible {
    let terms = [
        FoamTerm { modulus: 0.4, exponent: 9.0, poisson_ratio: 0.1 },
        FoamTerm { modulus: 0.8, exponent: -2.5, poisson_ratio: 0.3 },
    ];
    let tests = of_foam(&terms)?;
    let model: SidesModel = "hyperfoam:2".parse()?;
    let fit = fit_sides(model, &tests, &SidesOptions::default())?;
    assert!(fit.outcome.is_converged() && fit.weighted_squares < 1e-18, "{fit:?}");
    assert_close("θ", &fit.values(), &[0.4, 9.0, 0.1, 0.8, -2.5, 0.3], FOUND);
    assert_eq!((fit.tests.len(), fit.tests[0].laterals.len(), fit.tests[3].lateral_rms), (5, 9, None));
    // The law that is handed over answers as the one that made the tests.
    let law = model.law(&fit.values(), 0.0)?;
    let made = OfStretches(Hyperfoam::new(&terms)?);
    assert_close("P", &stress(&law, [0.5, 1.1, 1.0]), &stress(&made, [0.5, 1.1, 1.0]), FOUND);
    Ok(())
}

/// Without lateral stretches one test hardly tells ν; with them it does, and a fixed ν stays.
#[test]
fn lateral_stretches_determine_what_stresses_of_a_bar_do_not() -> Fallible {
    let terms = [FoamTerm { modulus: 0.4, exponent: 6.0, poisson_ratio: 0.2 }];
    let bar = &of_foam(&terms)?[0];
    let mut random = Random::new(3);
    let noisy: Vec<(f64, f64, Option<f64>)> =
        bar.rows().iter().map(|(x, p, side)| (*x, p * (1.0 + 0.01 * random.symmetric()), *side)).collect();
    let plain: Vec<(f64, f64, Option<f64>)> = noisy.iter().map(|(x, p, _)| (*x, *p, None)).collect();
    let model: SidesModel = "hyperfoam:1".parse()?;
    let error = |rows: &[(f64, f64, Option<f64>)]| -> Result<f64, FitError> {
        let fit = fit_sides(model, &[SidesTest::new("bar", Loading::Uniaxial, rows)?], &SidesOptions::default())?;
        Ok(fit.parameters[2].standard_error.unwrap_or(f64::INFINITY))
    };
    let (with, without) = (error(&noisy)?, error(&plain)?);
    assert!(5.0 * with < without, "{with} {without}");
    let fixed = SidesOptions::default().with_bounds("nu1", [0.0, 0.0]);
    let fit = fit_sides(model, &[SidesTest::new("bar", Loading::Uniaxial, &plain)?], &fixed)?;
    assert_eq!((fit.parameters[2].value, fit.parameters[2].state), (0.0, State::Held));
    // Two of three parameters are searched for: AICc = m ln(2π S/m) + m + 2 (k + 1) + … of k = 2.
    assert_eq!(fit.criteria, Criteria::new(9, 2, fit.weighted_squares));
    Ok(())
}

/// Tests of a body with fibres that keeps its volume: the pressure by the third axis, sides by bisection.
fn of_fibres(angle: f64, [mu, k1, k2, dispersion]: [f64; 4]) -> Result<Vec<SidesTest>, Box<dyn Error>> {
    let (sine, cosine) = angle.sin_cos();
    let fibres = [Fibre::new([cosine, sine, 0.0])?, Fibre::new([cosine, -sine, 0.0])?];
    let law = HolzapfelGasserOgden::new(mu, 0.0, k1, k2, dispersion, fibres)?;
    // λₐ Pₐ − λ₃ P₃ of a deformation that keeps the volume.
    let beyond = |a: f64, b: f64| {
        let stretches = [a, b, 1.0 / (a * b)];
        let found = stress(&law, stretches);
        [0, 1].map(|axis| stretches[axis] * found[axis] - stretches[2] * found[2])
    };
    let stretches = [1.05, 1.1, 1.15, 1.2, 1.25, 1.3];
    let along = stretches.map(|x| {
        let side = root(0.4, 1.5, |side| beyond(x, side)[1]);
        (x, beyond(x, side)[0] / x, Some(side))
    });
    let across = stretches.map(|x| {
        let side = root(0.4, 1.5, |side| beyond(side, x)[0]);
        (x, beyond(side, x)[1] / x, None)
    });
    let both = stretches.map(|x| {
        let [a, b] = beyond(x, x);
        (x, 0.5 * (a + b) / x, None)
    });
    let held = stretches.map(|x| (x, beyond(x, 1.0)[0] / x, None));
    Ok(vec![
        SidesTest::new("along", Loading::Uniaxial, &along)?,
        SidesTest::new("across", Loading::Transverse, &across)?,
        SidesTest::new("both", Loading::Equibiaxial, &both)?,
        SidesTest::new("held", Loading::Planar, &held)?,
    ])
}

#[test]
fn fitted_fibres_equal_those_that_made_the_tests() -> Fallible {
    let expected = [3.0, 5.0, 4.0, 0.6, 0.1];
    let [mu, k1, k2, angle, dispersion] = expected;
    let tests = of_fibres(angle, [mu, k1, k2, dispersion])?;
    let model: SidesModel = "holzapfel-gasser-ogden".parse()?;
    let fit = fit_sides(model, &tests, &SidesOptions::default())?;
    assert!(fit.outcome.is_converged() && fit.weighted_squares < 1e-16, "{fit:?}");
    assert_close("θ", &fit.values(), &expected, Tol::stated(1e-5, "the same, of parameters that are correlated"));
    assert!(!model.law(&fit.values(), 100.0)?.is_incompressible());
    Ok(())
}

/// Strips that were cut between the axes: width and shear by Newton's method, with the law itself and a pressure that keeps the volume.
#[test]
fn strips_at_an_angle_tell_the_fibres_and_equal_tests_along_the_axes_at_their_ends() -> Fallible {
    let expected = [3.0_f64, 5.0, 4.0, 0.6, 0.1];
    let [mu, k1, k2, angle, dispersion] = expected;
    let (sine, cosine) = angle.sin_cos();
    let fibres = [Fibre::new([cosine, sine, 0.0])?, Fibre::new([cosine, -sine, 0.0])?];
    let law = HolzapfelGasserOgden::new(mu, 0.0, k1, k2, dispersion, fibres)?;
    // P along the strip, with the width and the shear at which the stresses on its sides vanish. T = T′ − p 1 with p = T′₃₃.
    let pulled = |from_axis: f64, stretch: f64| -> Result<[f64; 2], Box<dyn Error>> {
        let turn = nalgebra::Rotation3::from_axis_angle(&nalgebra::Vector3::z_axis(), from_axis);
        let cauchy = |width: f64, shear: f64| -> Result<nalgebra::Matrix3<f64>, Box<dyn Error>> {
            let across = 1.0 / (stretch * width);
            let own = nalgebra::Matrix3::new(stretch, shear, 0.0, 0.0, width, 0.0, 0.0, 0.0, across);
            // In the frame of the body.
            let gradient = DeformationGradient::new(turn.matrix() * own * turn.matrix().transpose())?;
            let stress = turn.matrix().transpose() * law.cauchy(&gradient).0.matrix() * turn.matrix();
            Ok(stress - nalgebra::Matrix3::identity() * stress[(2, 2)])
        };
        let (mut width, mut shear) = (stretch.powf(-0.5), 0.0);
        for _ in 0..60 {
            let at = cauchy(width, shear)?;
            let excess = nalgebra::Vector2::new(at[(1, 1)], at[(0, 1)]);
            let step = 1e-6;
            let [a, b] = [cauchy(width + step, shear)?, cauchy(width, shear + step)?];
            let slope = |moved: nalgebra::Matrix3<f64>| {
                nalgebra::Vector2::new(moved[(1, 1)] - at[(1, 1)], moved[(0, 1)] - at[(0, 1)]) / step
            };
            let slopes = nalgebra::Matrix2::from_columns(&[slope(a), slope(b)]);
            let change = slopes.try_inverse().ok_or("a tangent")? * excess;
            (width, shear) = (width - change[0], shear - change[1]);
        }
        let at = cauchy(width, shear)?;
        assert!(at[(1, 1)].hypot(at[(0, 1)]) < 1e-9, "the sides carry no stress: {at}");
        // P₁₁ = T₁₁ /F₁₁ of a shear along 1 that carries no T₁₂.
        Ok([cauchy(width, shear)?[(0, 0)] / stretch, width])
    };
    let strip = |degrees: f64| -> Result<SidesTest, Box<dyn Error>> {
        let mut rows = Vec::new();
        for stretch in [1.05, 1.1, 1.15, 1.2, 1.25] {
            let [stress, width] = pulled(degrees.to_radians(), stretch)?;
            rows.push((stretch, stress, Some(width)));
        }
        Ok(SidesTest::strip(format!("{degrees}°"), degrees.to_radians(), &rows)?)
    };
    let model: SidesModel = "holzapfel-gasser-ogden".parse()?;
    let fit = fit_sides(model, &[strip(20.0)?, strip(45.0)?, strip(70.0)?], &SidesOptions::default())?;
    assert!(fit.weighted_squares < 1e-14, "{fit:?}");
    assert_close("θ", &fit.values(), &expected, Tol::stated(1e-5, "the same, of parameters that are correlated"));
    // A strip along axis 2 is the transverse test.
    let along = of_fibres(angle, [mu, k1, k2, dispersion])?;
    let [stress, _] = pulled(core::f64::consts::FRAC_PI_2, 1.2)?;
    assert_close("P at 90°", &[stress], &[along[1].rows()[3].1], Tol::stated(1e-7, "differences over 1e-6"));
    let refused = SidesTest::strip("a", f64::NAN, &[(1.1, 1.0, None)]).expect_err("NaN").to_string();
    assert_eq!(refused, "test `a`: the angle NaN of the strip is not finite");
    Ok(())
}

#[test]
fn tests_with_sides_are_refused_by_name() -> Fallible {
    let row = [(0.5, -1.0, None)];
    let named = |found: Result<SidesTest, FitError>, expected: &str| {
        let text = found.err().map(|error| error.to_string()).unwrap_or_default();
        assert!(text.contains(expected), "{text}");
    };
    named(SidesTest::new("a", Loading::Uniaxial, &[]), "`a`");
    named(SidesTest::new("a", Loading::Uniaxial, &[(0.5, -1.0, Some(-0.1))]), "-0.1");
    named(SidesTest::new("a", Loading::Uniaxial, &[(0.5, f64::NAN, None)]), "NaN");
    let foam: SidesModel = "hyperfoam:1".parse()?;
    let fibres: SidesModel = "holzapfel-gasser-ogden".parse()?;
    let test = SidesTest::new("a", Loading::Uniaxial, &row)?;
    let volumes = SidesTest::new("v", Loading::Volumetric, &row)?;
    let options = SidesOptions::default();
    let refused = |model, tests: &[SidesTest], options: &SidesOptions| fit_sides(model, tests, options).err();
    assert!(matches!(refused(foam, &[], &options), Some(FitError::NoTests)));
    assert!(matches!(refused(foam, &[test.clone(), test.clone()], &options), Some(FitError::TestTwice { .. })));
    assert!(matches!(
        refused(foam, core::slice::from_ref(&test), &options),
        Some(FitError::TooFewPoints { points: 1, .. })
    ));
    assert!(matches!(refused(fibres, &[volumes], &options), Some(FitError::NoSuchLoading { .. })));
    let unknown = options.clone().with_bounds("gamma", [0.0, 1.0]);
    assert!(matches!(refused(foam, core::slice::from_ref(&test), &unknown), Some(FitError::UnknownParameter { .. })));
    let nan = options.clone().with_bounds("nu1", [f64::NAN, 0.4]);
    assert!(matches!(refused(foam, core::slice::from_ref(&test), &nan), Some(FitError::ImpossibleBounds { .. })));
    let still = SidesTest::new("still", Loading::Uniaxial, &[(1.0, 0.0, Some(1.0))])?;
    assert!(matches!(refused(foam, &[still], &options), Some(FitError::NothingTold { test }) if test == "still"));
    let lateral = SidesTest::new("shear", Loading::SimpleShear, &[(0.1, 1.0, Some(1.0))]);
    assert!(matches!(lateral, Err(FitError::NoLateral { loading: "simple shear", .. })));
    let empty = options.with_bounds("nu1", [0.6, 0.7]);
    assert!(matches!(refused(foam, &[test], &empty), Some(FitError::ImpossibleBounds { .. })));
    assert!(matches!("foam".parse::<SidesModel>(), Err(FitError::UnknownSidesModel { .. })));
    Ok(())
}

/// P = (2 μ/α)(λ² − λₜ²)/λ is linear in μ: residuals that are greater by a tenth of the stresses ask for nine tenths of μ, and the scales stay.
#[test]
fn shifted_residuals_ask_for_the_law_of_shifted_stresses() -> Fallible {
    let tests = of_foam(&[FoamTerm { modulus: 3.0, exponent: 2.0, poisson_ratio: 0.25 }])?;
    let mut shift = Vec::new();
    for test in &tests {
        shift.extend(test.rows().iter().map(|row| 0.1 * row.1 / test.largest_stress()));
        shift.extend(test.rows().iter().filter_map(|row| row.2).map(|_| 0.0));
    }
    let foam: SidesModel = "hyperfoam:1".parse()?;
    let found = piola_fit::internal::fit_sides_shifted(foam, &tests, &SidesOptions::default(), &shift)?;
    assert_close("parameters", &found.values(), &[2.7, 2.0, 0.25], FOUND);
    Ok(())
}
