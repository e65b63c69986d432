//! Measures of similarity and their forces.

use piola_registration::{DisplacementMap, Image, ImageGrid, Interpolant, RegistrationError, SimilarityMeasure};
use piola_testkit::{Tol, assert_close, difference_quotient};

use crate::fixtures::{displacement, texture, unit_box};

const MEASURES: [SimilarityMeasure; 3] =
    [SimilarityMeasure::SumOfSquares, SimilarityMeasure::CrossCorrelation, SimilarityMeasure::MutualInformation];

/// A displacement that no wall stops, so that samples leave the box of the moving image too.
fn force_equals_difference_quotient<const D: usize>(
    n: usize,
    interpolant: Interpolant,
) -> Result<usize, RegistrationError> {
    let grid = unit_box::<D>(n)?;
    let fixed = Image::from_fn(grid, |place| texture(place) + 0.3 * place[0])?;
    let moving = Image::from_fn(grid, texture)?;
    let start: Vec<f64> =
        (0..grid.len()).flat_map(|position| displacement(0.13, grid.place(position)).map(|u| u + 0.011)).collect();
    let mut compared = 0;
    for measure in MEASURES {
        let at = |values: &[f64]| {
            let map = DisplacementMap::new(grid, values.as_chunks::<D>().0.to_vec())?;
            measure.force(&fixed, &moving, &map, interpolant)
        };
        let (_, force) = at(&start)?;
        // One direction mixes all components; with steps of 2⁻⁹ of it, no sample changes its cell.
        let direction: Vec<f64> = (0..start.len()).map(|i| 1e-2 / n as f64 * (1.0 + i as f64).sin()).collect();
        let quotient =
            difference_quotient(|values| vec![at(values).map_or(f64::NAN, |(measure, _)| measure)], &start, &direction);
        let work: f64 = force.as_flattened().iter().zip(&direction).map(|(f, d)| f * d).sum();
        // The spline and its windows are twice differentiable only, so differences see third derivatives jump.
        let tolerance = Tol::stated(2e-7, "differences: steps of 2e-5 samples, rounding of D over the step");
        assert_close("force · δu", &[work / grid.len() as f64], &[-quotient[0]], tolerance);
        compared += 1;
    }
    Ok(compared)
}

#[test]
fn force_is_minus_the_derivative_of_the_measure() -> Result<(), RegistrationError> {
    let mut compared = 0;
    for interpolant in [Interpolant::Linear, Interpolant::CubicSpline] {
        compared += force_equals_difference_quotient::<2>(12, interpolant)?;
        compared += force_equals_difference_quotient::<3>(7, interpolant)?;
    }
    assert_eq!(compared, 12);
    Ok(())
}

/// Four samples of each of the pairs (0, 0), (1, 1) are independent of nothing: by hand.
#[test]
fn measures_of_two_values_equal_those_by_hand() -> Result<(), RegistrationError> {
    let grid = ImageGrid::new([2, 2], [1.0, 1.0])?;
    let a = Image::new(grid, vec![0.0, 0.0, 1.0, 1.0])?;
    let b = Image::new(grid, vec![0.0, 1.0, 0.0, 1.0])?;
    let minus_a = Image::new(grid, vec![1.0, 1.0, 0.0, 0.0])?;
    // mean (a − b)² = ½, each variance ¼.
    assert_close("squares", &[SimilarityMeasure::SumOfSquares.of(&a, &b)?], &[1.0], Tol::ulps(2.0));
    assert_close("uncorrelated", &[SimilarityMeasure::CrossCorrelation.of(&a, &b)?], &[1.0], Tol::ulps(2.0));
    assert_close("opposite", &[SimilarityMeasure::CrossCorrelation.of(&a, &minus_a)?], &[2.0], Tol::ulps(2.0));
    // Two values far apart: windows do not overlap, so one bit is shared, whatever the sign.
    let bit = -std::f64::consts::LN_2;
    let [same, opposite, none] = [&a, &minus_a, &b].map(|other| SimilarityMeasure::MutualInformation.of(&a, other));
    // A window spreads each value over bins: the two images share less than the spread of one with itself.
    assert!(same.clone()? <= bit, "{same:?}");
    assert_close("opposite", &[opposite?], &[same?], Tol::ulps(8.0));
    assert!(none?.abs() <= 8.0 * f64::EPSILON);
    Ok(())
}

#[test]
fn cross_correlation_ignores_linear_maps_of_intensity_and_information_ignores_their_sign()
-> Result<(), RegistrationError> {
    let grid = unit_box::<2>(24)?;
    let fixed = Image::from_fn(grid, texture)?;
    let moving = Image::from_fn(grid, |[y, x]| texture([x, y]))?;
    let mapped = |scale: f64| Image::new(grid, moving.values().iter().map(|value| 7.0 + scale * value).collect());
    let correlation = SimilarityMeasure::CrossCorrelation;
    assert_close(
        "scaled",
        &[correlation.of(&fixed, &mapped(3.0)?)?],
        &[correlation.of(&fixed, &moving)?],
        Tol::ulps(32.0),
    );
    let information = SimilarityMeasure::MutualInformation;
    assert_close(
        "negative",
        &[information.of(&fixed, &mapped(-3.0)?)?],
        &[information.of(&fixed, &moving)?],
        Tol::ulps_because(512.0, "positions in the histogram are rounded, and 576 terms summed in another order"),
    );
    // All measures are symmetric.
    for measure in MEASURES {
        assert_close("symmetric", &[measure.of(&moving, &fixed)?], &[measure.of(&fixed, &moving)?], Tol::ulps(64.0));
    }
    Ok(())
}
