//! Maps: Jacobian, composition, inverse.

use piola_registration::{DisplacementMap, ImageGrid, RegistrationError};
use piola_testkit::{Tol, assert_close};

use crate::fixtures::{displacement, unit_box};

/// Each component depends on its own coordinate, so every simplex has a product of difference quotients as its determinant.
fn stretched<const D: usize>(grid: ImageGrid<D>, amplitude: f64) -> Result<DisplacementMap<D, f64>, RegistrationError> {
    DisplacementMap::from_fn(grid, |place| place.map(|x| amplitude * (2.0 * std::f64::consts::PI * x).sin()))
}

fn least_equals_product_of_quotients<const D: usize>(sizes: [usize; D]) -> Result<(), RegistrationError> {
    let grid = ImageGrid::new(sizes, sizes.map(|size| 1.0 / size as f64))?;
    let map = stretched(grid, 0.1)?;
    let mut expected = 1.0;
    for size in sizes {
        let h = 1.0 / size as f64;
        let u = |index: f64| 0.1 * (2.0 * std::f64::consts::PI * (index + 0.5) * h).sin();
        // The wave is odd about the walls, so ghost samples continue it.
        let quotients = (0..=size).map(|index| 1.0 - (u(index as f64) - u(index as f64 - 1.0)) / h);
        expected *= quotients.fold(f64::INFINITY, f64::min);
    }
    let tolerance = Tol::ulps_because(256.0, "differences of displacements over the spacing lose a digit or two");
    assert_close("least Jacobian", &[map.least_jacobian()], &[expected], tolerance);
    Ok(())
}

#[test]
fn least_jacobian_of_a_separable_map_equals_the_product_of_least_quotients() -> Result<(), RegistrationError> {
    least_equals_product_of_quotients([20, 33])?;
    least_equals_product_of_quotients([10, 13, 8])
}

#[test]
fn folds_are_found_and_refused() -> Result<(), RegistrationError> {
    let map = stretched(unit_box::<2>(32)?, 0.17)?;
    assert!(map.least_jacobian() < 0.0);
    assert!(matches!(map.inverse(), Err(RegistrationError::Folded { least }) if least < 0.0));
    let folded = stretched(unit_box::<3>(16)?, 0.17)?;
    assert!(folded.least_jacobian() < 0.0 && folded.inverse().is_err());
    Ok(())
}

#[test]
fn jacobian_converges_to_the_determinant_of_the_formula() -> Result<(), RegistrationError> {
    let error = |n: usize| -> Result<f64, RegistrationError> {
        let grid = unit_box::<2>(n)?;
        let map = DisplacementMap::from_fn(grid, |place| displacement(0.05, place))?;
        let pi = std::f64::consts::PI;
        let exact = |[y, x]: [f64; 2]| {
            // u_a = A sin(π x_a) cos(2π x_b + 0.4 a).
            let phases = [2.0 * pi * x, 2.0 * pi * y + 0.4];
            let normal = [pi * (pi * y).cos() * phases[0].cos(), pi * (pi * x).cos() * phases[1].cos()];
            let shear = [-2.0 * pi * (pi * y).sin() * phases[0].sin(), -2.0 * pi * (pi * x).sin() * phases[1].sin()];
            (1.0 - 0.05 * normal[0]) * (1.0 - 0.05 * normal[1]) - 0.05 * 0.05 * shear[0] * shear[1]
        };
        let inside = (0..grid.len()).filter(|&position| grid.place(position).iter().all(|x| 0.1 < *x && *x < 0.9));
        let jacobian = map.jacobian();
        Ok(inside.map(|position| (jacobian.values()[position] - exact(grid.place(position))).abs()).fold(0.0, f64::max))
    };
    let order = (error(40)? / error(80)?).log2();
    assert!(1.9 < order && order < 2.1, "{order}");
    Ok(())
}

fn inverse_undoes<const D: usize>(n: usize, amplitude: f64) -> Result<[f64; 2], RegistrationError> {
    let grid = unit_box::<D>(n)?;
    let map = DisplacementMap::from_fn(grid, |place| displacement(amplitude, place))?;
    let inverse = map.inverse()?;
    let rounding = map.after(&inverse)?.largest_displacement();
    assert!(rounding < 64.0 * f64::EPSILON, "{rounding:e}");
    Ok([inverse.after(&map)?.largest_displacement(), inverse.least_jacobian()])
}

#[test]
fn map_after_its_inverse_is_the_identity() -> Result<(), RegistrationError> {
    let [coarse, _] = inverse_undoes::<2>(32, 0.08)?;
    let [fine, least] = inverse_undoes::<2>(64, 0.08)?;
    // Between samples the inverse is interpolated: second order.
    let order = (coarse / fine).log2();
    assert!(1.5 < order && order < 2.5 && 0.0 < least, "{order} {least}");
    let [error, least] = inverse_undoes::<3>(16, 0.06)?;
    assert!(error < 0.5 / 16.0 && 0.0 < least, "{error} {least}");
    Ok(())
}

#[test]
fn composition_of_shifts_is_their_sum() -> Result<(), RegistrationError> {
    let grid = unit_box::<2>(20)?;
    let shift = |by: f64| DisplacementMap::from_fn(grid, move |_| [by, -2.0 * by]);
    let both = shift(0.05)?.after(&shift(0.03)?)?;
    let mut compared = 0;
    for (position, u) in both.displacements().iter().enumerate() {
        // Near a wall the ghost samples turn the normal component.
        if grid.place(position).iter().all(|x| 0.2 < *x && *x < 0.8) {
            assert_close("sum", u, &[0.08, -0.16], Tol::ulps(4.0));
            compared += 1;
        }
    }
    assert_eq!(compared, 144);
    Ok(())
}
