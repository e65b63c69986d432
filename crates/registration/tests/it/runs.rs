//! The endings of runs, and their independence of threads and of the unit of length.

use std::ops::ControlFlow;

use piola_registration::{
    DisplacementMap, Image, Registration, RegistrationEnding, RegistrationError, RegistrationModel, SimilarityMeasure,
};

use crate::fixtures::{phantom, unit_box};

fn models() -> Result<[RegistrationModel; 2], RegistrationError> {
    Ok([RegistrationModel::elastic(0.0, 0.1)?, RegistrationModel::viscous_fluid(0.0, 1.0)?])
}

#[test]
fn equal_images_need_no_step() -> Result<(), RegistrationError> {
    let [image, _] = phantom::<2, f64>(unit_box(32)?, 0.0)?;
    for model in models()? {
        let found = Registration::new(model).run(&image, &image)?;
        assert_eq!(found.map, DisplacementMap::identity(*image.grid()));
        assert_eq!((found.levels.len(), found.ending()), (2, RegistrationEnding::NoFurtherDecrease));
    }
    Ok(())
}

#[test]
fn observer_ends_a_run_and_the_map_found_so_far_is_kept() -> Result<(), RegistrationError> {
    let [fixed, moving] = phantom::<2, f64>(unit_box(33)?, 0.06)?;
    for model in models()? {
        let mut seen = Vec::new();
        let found = Registration::new(model).run_observed(&fixed, &moving, |progress| {
            seen.push((progress.level, progress.step));
            if seen.len() < 3 { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        })?;
        assert_eq!(seen, [(1, 1), (1, 2), (1, 3)]);
        assert_eq!(found.ending(), RegistrationEnding::Interrupted);
        assert_eq!(found.map.grid(), fixed.grid());
        let squares = |map: &DisplacementMap<2, f64>| -> Result<f64, RegistrationError> {
            let map = map.warp(&moving, piola_registration::Interpolant::Linear)?;
            SimilarityMeasure::SumOfSquares.of(&fixed, &map)
        };
        assert!(squares(&found.map)? < squares(&DisplacementMap::identity(*fixed.grid()))?);
    }
    Ok(())
}

#[test]
fn measures_fall_with_every_step_and_the_jacobian_keeps_its_bound() -> Result<(), RegistrationError> {
    let [fixed, moving] = phantom::<2, f64>(unit_box(32)?, 0.1)?;
    let method = Registration::new(RegistrationModel::viscous_fluid(0.0, 1.0)?).with_jacobian_bounds(0.8, 0.3);
    let (mut last, mut compared) = ((usize::MAX, f64::INFINITY), 0);
    let found = method.run_observed(&fixed, &moving, |progress| {
        assert!(0.3 <= progress.least_jacobian);
        if progress.level == last.0 {
            assert!(progress.measure < last.1);
            compared += 1;
        }
        last = (progress.level, progress.measure);
        ControlFlow::Continue(())
    })?;
    assert!(10 < compared && 0.3 <= found.map.least_jacobian());
    assert!(0 < found.levels.iter().map(|level| level.regriddings).sum::<usize>());
    Ok(())
}

/// Lengths in another unit: displacements scale, nothing else changes.
#[test]
fn results_do_not_depend_on_the_unit_of_length() -> Result<(), RegistrationError> {
    let [fixed, moving] = phantom::<2, f64>(unit_box(32)?, 0.05)?;
    let grid = piola_registration::ImageGrid::new([32, 32], [1024.0 / 32.0; 2])?;
    let larger = |image: &Image<2, f64>| Image::new(grid, image.values().to_vec());
    for model in models()? {
        let found = Registration::new(model).run(&fixed, &moving)?;
        let scaled = Registration::new(model).run(&larger(&fixed)?, &larger(&moving)?)?;
        let steps = |levels: &[piola_registration::LevelReport<2>]| levels.iter().map(|l| l.steps).collect::<Vec<_>>();
        assert_eq!(steps(&found.levels), steps(&scaled.levels));
        for (u, scaled) in found.map.displacements().iter().zip(scaled.map.displacements()) {
            for (u, scaled) in u.iter().zip(scaled) {
                assert!((1024.0 * u - scaled).abs() < 1e-6, "{u} {scaled}");
            }
        }
    }
    Ok(())
}

#[cfg(feature = "rayon")]
#[test]
fn bits_do_not_depend_on_the_number_of_threads() -> Result<(), Box<dyn std::error::Error>> {
    let [fixed, moving] = phantom::<2, f64>(unit_box(160)?, 0.01)?;
    for model in models()? {
        for measure in [SimilarityMeasure::CrossCorrelation, SimilarityMeasure::MutualInformation] {
            let method = Registration::new(model).with_measure(measure).with_steps(3).with_levels(1);
            let mut maps = Vec::new();
            for threads in [1, 2, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
                maps.push(pool.install(|| method.run(&fixed, &moving))?.map);
            }
            assert_eq!(maps[0], maps[1]);
            assert_eq!(maps[0], maps[2]);
            assert!(0.0 < maps[0].largest_displacement());
        }
    }
    Ok(())
}
