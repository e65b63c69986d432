//! Images and their interpolants.

use piola_registration::{Image, ImageGrid, ImageSampler, Interpolant, RegistrationError};
use piola_testkit::{Tol, assert_close, difference_quotient};

use crate::fixtures::{texture, unit_box};

#[test]
fn interpolants_return_the_samples_and_their_gradient_is_the_derivative() -> Result<(), RegistrationError> {
    let grid = ImageGrid::new([6, 9, 7], [0.2, 0.1, 0.15])?;
    let image = Image::from_fn(grid, texture)?;
    let mut compared = 0;
    for interpolant in [Interpolant::Linear, Interpolant::CubicSpline] {
        let sampler = ImageSampler::new(&image, interpolant);
        let found: Vec<f64> = (0..grid.len()).map(|position| sampler.value(grid.place(position))).collect();
        assert_close("samples", &found, image.values(), Tol::ulps(32.0));
        for place in [[0.33, 0.42, 0.5], [0.15, 0.08, 0.98], [0.61, 0.72, 0.2]] {
            let gradient = sampler.with_gradient(place).1;
            for axis in 0..3 {
                let mut direction = [0.0; 3];
                direction[axis] = 0.01;
                let quotient = difference_quotient(|x| vec![sampler.value([x[0], x[1], x[2]])], &place, &direction);
                let tolerance = Tol::stated(1e-9, "rounding over steps of 2e-5");
                assert_close("gradient", &[gradient[axis] * 0.01], &quotient, tolerance);
                compared += 1;
            }
        }
    }
    assert_eq!(compared, 18);
    Ok(())
}

/// Two samples mirrored for ever are a cosine wave at the highest frequency: between 0 and 1 the spline is 3t² − 2t³ by symmetry.
#[test]
fn cubic_spline_through_two_samples_is_the_smooth_step() -> Result<(), RegistrationError> {
    let image = Image::from_fn(ImageGrid::new([2, 2], [1.0, 1.0])?, |[_, x]| x - 0.5)?;
    let sampler = ImageSampler::new(&image, Interpolant::CubicSpline);
    let shares = [0.0, 0.125, 0.5, 0.75, 1.0];
    let found: Vec<f64> = shares.iter().map(|t| sampler.value([0.9, 0.5 + t])).collect();
    let expected: Vec<f64> = shares.iter().map(|t| t * t * (3.0 - 2.0 * t)).collect();
    assert_close("smooth step", &found, &expected, Tol::ulps(8.0));
    Ok(())
}

#[test]
fn values_beyond_the_outermost_samples_are_those_of_the_nearest_point() -> Result<(), RegistrationError> {
    let image = Image::from_fn(unit_box::<2>(8)?, texture)?;
    for interpolant in [Interpolant::Linear, Interpolant::CubicSpline] {
        let sampler = ImageSampler::new(&image, interpolant);
        let (value, gradient) = sampler.with_gradient([-3.0, 0.4]);
        assert_close("value", &[value], &[sampler.value([0.0625, 0.4])], Tol::ulps(16.0));
        assert!(gradient[0].abs() <= 0.0 && 0.0 < gradient[1].abs());
    }
    Ok(())
}

#[test]
fn dice_of_two_discs_equals_the_ratio_of_counted_samples() -> Result<(), RegistrationError> {
    let grid = unit_box::<2>(40)?;
    let disc = |radius: f64| Image::from_fn(grid, move |[y, x]| radius - (x - 0.5).hypot(y - 0.5));
    let (small, large) = (disc(0.2)?, disc(0.4)?);
    let count = |image: &Image<2, f64>| image.values().iter().filter(|value| 0.0 < **value).count() as f64;
    let expected = 2.0 * count(&small) / (count(&small) + count(&large));
    assert_close("Dice", &[small.dice(&large, 0.0)?], &[expected], Tol::ulps(1.0));
    Ok(())
}
