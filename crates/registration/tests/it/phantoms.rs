//! Known deformations are recovered within half a sample.

use piola_registration::{
    DisplacementMap, Image, Interpolant, Precision, Registration, RegistrationError, RegistrationModel,
    SimilarityMeasure,
};

use crate::fixtures::{displacement, phantom, unit_box};

/// The mean of |u − exact|, in samples.
fn mean_error<const D: usize, T: Precision>(map: &DisplacementMap<D, T>, amplitude: f64) -> f64 {
    let grid = map.grid();
    let errors = map.displacements().iter().enumerate().map(|(position, u)| {
        let exact = displacement(amplitude, grid.place(position));
        u.iter().zip(exact).map(|(u, exact)| (u.primal(0) - exact).powi(2)).sum::<f64>().sqrt()
    });
    errors.sum::<f64>() / (grid.len() as f64 * grid.spacing()[0])
}

fn models() -> Result<[RegistrationModel; 2], RegistrationError> {
    Ok([RegistrationModel::elastic(0.0, 0.1)?, RegistrationModel::viscous_fluid(0.0, 1.0)?])
}

#[test]
fn deformation_in_two_dimensions_is_recovered_by_both_models_and_all_measures() -> Result<(), RegistrationError> {
    let n = 48;
    let amplitude = 3.0 / n as f64;
    let [fixed, moving] = phantom::<2, f64>(unit_box(n)?, amplitude)?;
    let unregistered = mean_error(&DisplacementMap::<2, f64>::identity(*fixed.grid()), amplitude);
    assert!(1.0 < unregistered, "{unregistered}");
    let measures =
        [SimilarityMeasure::SumOfSquares, SimilarityMeasure::CrossCorrelation, SimilarityMeasure::MutualInformation];
    let mut compared = 0;
    for model in models()? {
        for measure in measures {
            let method = Registration::new(model).with_measure(measure);
            let variants = [method, method.symmetric(), method.with_interpolant(Interpolant::CubicSpline)];
            for method in variants {
                let found = method.run(&fixed, &moving)?;
                let error = mean_error(&found.map, amplitude);
                assert!(error < 0.5, "{method:?}: {error}");
                assert!(0.0 < found.map.least_jacobian());
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 18);
    Ok(())
}

#[test]
fn deformation_in_three_dimensions_is_recovered_by_both_models() -> Result<(), RegistrationError> {
    let n = 24;
    let amplitude = 2.0 / n as f64;
    let [fixed, moving] = phantom::<3, f64>(unit_box(n)?, amplitude)?;
    for model in models()? {
        let found = Registration::new(model).run(&fixed, &moving)?;
        let error = mean_error(&found.map, amplitude);
        assert!(error < 0.5, "{model:?}: {error}");
        assert!(0.0 < found.map.least_jacobian());
    }
    Ok(())
}

#[test]
fn single_precision_recovers_the_same_deformation() -> Result<(), RegistrationError> {
    let n = 32;
    let amplitude = 2.0 / n as f64;
    for model in models()? {
        let [fixed, moving] = phantom::<2, f32>(unit_box(n)?, amplitude)?;
        let found = Registration::new(model).run(&fixed, &moving)?;
        let error = mean_error(&found.map, amplitude);
        assert!(error < 0.5, "{model:?}: {error}");
    }
    Ok(())
}

/// The intensities of another device: a curve that is not even monotonic. Only mutual information can use it.
#[test]
fn mutual_information_registers_images_of_two_devices() -> Result<(), RegistrationError> {
    let n = 48;
    let amplitude = 2.0 / n as f64;
    let [fixed, moving] = phantom::<2, f64>(unit_box(n)?, amplitude)?;
    let other = Image::new(*moving.grid(), moving.values().iter().map(|value| (1.5 * value).cos()).collect())?;
    let method = Registration::new(RegistrationModel::viscous_fluid(0.0, 1.0)?);
    let error = |measure: SimilarityMeasure| -> Result<f64, RegistrationError> {
        Ok(mean_error(&method.with_measure(measure).run(&fixed, &other)?.map, amplitude))
    };
    let [shared, squares] = [error(SimilarityMeasure::MutualInformation)?, error(SimilarityMeasure::SumOfSquares)?];
    assert!(shared < 0.5 && 0.5 < squares, "{shared} {squares}");
    Ok(())
}
