//! What a run ends with: forces in balance, steps within their bound, endings as stated.

use std::ops::ControlFlow;

use piola_registration::{
    DisplacementMap, Image, ImageGrid, Interpolant, Registration, RegistrationEnding, RegistrationError,
    RegistrationModel, SimilarityMeasure,
};
use piola_spectral::{BoxGrid, BoxOperator, BoxSolver, LameParameters, Walls};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::fixtures::{displacement, phantom, texture, unit_box};

/// At the least of energy and measure the elastic force −Lu is the force of the images: u is the response to it.
fn assert_balanced(images: &[Image<2, f64>; 2], first: f64, shear: f64) -> Result<(), Box<dyn std::error::Error>> {
    let [fixed, moving] = images;
    let grid = fixed.grid();
    let mut solver = BoxSolver::<f64, 2>::new(
        BoxGrid::cells(grid.sizes(), grid.spacing())?,
        Walls::Sliding,
        BoxOperator::elastic(LameParameters::new(first, shear)?),
    )?;
    let method = Registration::new(RegistrationModel::elastic(first, shear)?)
        .with_interpolant(Interpolant::CubicSpline)
        .with_levels(1)
        .with_largest_step(2.0)
        .with_tolerance(0.0)
        .with_steps(300);
    for measure in [SimilarityMeasure::SumOfSquares, SimilarityMeasure::CrossCorrelation] {
        let found = method.with_measure(measure).run(fixed, moving)?;
        let (_, force) = measure.force(fixed, moving, &found.map, Interpolant::CubicSpline)?;
        let mut response = [0, 1].map(|axis| force.iter().map(|f| f[axis]).collect::<Vec<f64>>());
        solver.solve_in_place(response.each_mut().map(|component| &mut component[..]))?;
        let u = [0, 1].map(|axis| found.map.displacements().iter().map(|u| u[axis]).collect::<Vec<f64>>());
        let tolerance = Tol::stated(1e-5, "what three hundred steps of conjugate directions leave");
        assert_close(&format!("u, {shear}"), &u.concat(), &response.concat(), tolerance);
        // Half a sample: there is something to balance.
        assert!(0.5 * grid.spacing()[1] < found.map.largest_displacement());
    }
    Ok(())
}

#[test]
fn elastic_registration_ends_where_the_forces_balance() -> Result<(), Box<dyn std::error::Error>> {
    assert_balanced(&phantom(ImageGrid::new([16, 20], [1.0 / 16.0, 1.0 / 20.0])?, 0.06)?, 0.2, 0.2)?;
    // Two distant blobs pull the more, the closer they come: long steps are tried, and some are too long.
    let grid = unit_box::<2>(24)?;
    let blob = |at: f64| Image::from_fn(grid, move |[y, x]| (-((x - at).powi(2) + (y - 0.5).powi(2)) / 0.01).exp());
    for shear in [2.0, 5.0] {
        assert_balanced(&[blob(0.65)?, blob(0.35)?], 0.0, shear)?;
    }
    Ok(())
}

/// The first step of either model moves the fastest sample by the allowed part of a sample.
#[test]
fn first_step_is_as_long_as_allowed() -> Result<(), RegistrationError> {
    let [fixed, moving] = phantom::<2, f64>(unit_box(32)?, 0.08)?;
    // An elastic body so soft that its whole response is longer.
    for model in [RegistrationModel::elastic(0.0, 1e-3)?, RegistrationModel::viscous_fluid(0.0, 7.0)?] {
        for largest in [0.25, 0.0625] {
            let method = Registration::new(model).with_levels(1).with_steps(1).with_largest_step(largest);
            let found = method.run(&fixed, &moving)?;
            let moved = found.map.largest_displacement() * 32.0;
            assert_close(&format!("{model:?}"), &[moved], &[largest], Tol::ulps(16.0));
        }
    }
    Ok(())
}

/// Measures after each step tell where ten steps together brought less than the tolerance times all before.
#[test]
fn level_converges_where_ten_steps_bring_less_than_their_share() -> Result<(), RegistrationError> {
    let grid = unit_box::<2>(24)?;
    let [fixed, moving] = phantom::<2, f64>(grid, 0.01)?;
    let mut compared = 0;
    for tolerance in [0.3, 0.05] {
        let mut measures = vec![SimilarityMeasure::SumOfSquares.of(&fixed, &moving)?];
        let method = Registration::new(RegistrationModel::viscous_fluid(0.0, 1.0)?)
            .with_levels(1)
            .with_largest_step(0.05)
            .with_tolerance(tolerance);
        let found = method.run_observed(&fixed, &moving, |progress| {
            measures.push(progress.measure);
            ControlFlow::Continue(())
        })?;
        assert_eq!(found.ending(), RegistrationEnding::Converged);
        let steps = measures.len() - 1;
        let falls_short =
            |step: usize| measures[step - 10] - measures[step] < tolerance * (measures[0] - measures[step]);
        assert_eq!((10..=steps).find(|step| falls_short(*step)), Some(steps), "{measures:?}");
        assert!(10 < steps && steps < 200, "{steps}");
        compared += 1;
    }
    assert_eq!(compared, 2);
    Ok(())
}

/// The measure that comes with the force is that of the warped image.
#[test]
fn measure_of_the_force_is_that_of_the_warped_image() -> Result<(), RegistrationError> {
    let grid = unit_box::<2>(16)?;
    let fixed = Image::from_fn(grid, |place| texture(place) + 2.0 * place[1])?;
    let moving = Image::from_fn(grid, |place| texture(place) + 3.0 * place[0])?;
    // A mean that the warp changes.
    let map = DisplacementMap::from_fn(grid, |place| displacement(0.02, place).map(|u| u + 0.1))?;
    let warped = map.warp(&moving, Interpolant::Linear)?;
    let (found, _) = SimilarityMeasure::CrossCorrelation.force(&fixed, &moving, &map, Interpolant::Linear)?;
    assert_close("D", &[found], &[SimilarityMeasure::CrossCorrelation.of(&fixed, &warped)?], Tol::ulps(32.0));
    Ok(())
}

/// Both images move in a symmetric run, and so do their means.
#[test]
fn measure_of_a_symmetric_run_is_that_of_the_halves() -> Result<(), RegistrationError> {
    let grid = unit_box::<2>(24)?;
    let [fixed, moving] = [0.02, -0.03].map(|amplitude| {
        Image::<2, f64>::from_fn(grid, |place| {
            let u = displacement(amplitude, place);
            texture([place[0] - u[0], place[1] - u[1]]) + (4.0 * (place[0] - u[0])).exp() / 20.0
        })
    });
    let (fixed, moving) = (fixed?, moving?);
    let mut compared = 0;
    for model in [RegistrationModel::elastic(0.0, 0.05)?, RegistrationModel::viscous_fluid(0.0, 1.0)?] {
        for measure in [SimilarityMeasure::SumOfSquares, SimilarityMeasure::CrossCorrelation] {
            let method = Registration::new(model).with_measure(measure).with_levels(1).symmetric();
            let found = method.run(&fixed, &moving)?;
            let Some([to_fixed, to_moving]) = &found.halves else { panic!("no halves") };
            let warped = [to_fixed.warp(&fixed, Interpolant::Linear)?, to_moving.warp(&moving, Interpolant::Linear)?];
            let expected = match measure {
                // The sum of squares is divided by the variances of the images before they move.
                SimilarityMeasure::SumOfSquares => {
                    let [before, after] = [[&fixed, &moving], [&warped[0], &warped[1]]].map(squares);
                    measure.of(&fixed, &moving)? * after / before
                }
                _ => measure.of(&warped[0], &warped[1])?,
            };
            // One less a correlation has the rounding of one.
            let found = [found.levels[0].measures[1]];
            assert_close_at_scale(&format!("{model:?}"), &found, &[expected], 1.0, Tol::ulps(8.0));
            compared += 1;
        }
    }
    assert_eq!(compared, 4);
    Ok(())
}

fn squares([a, b]: [&Image<2, f64>; 2]) -> f64 {
    a.values().iter().zip(b.values()).map(|(a, b)| (a - b).powi(2)).sum()
}
