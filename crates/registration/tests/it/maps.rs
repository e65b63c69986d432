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

/// The least Jacobian where one sample alone is displaced, by these parts of the spacings.
fn least_of_one<const D: usize>(
    grid: ImageGrid<D>,
    index: [usize; D],
    parts: [f64; D],
) -> Result<f64, RegistrationError> {
    let position = (0..D).fold(0, |position, axis| position * grid.sizes()[axis] + index[axis]);
    let mut displacements = vec![[0.0; D]; grid.len()];
    displacements[position] = std::array::from_fn(|axis| parts[axis] * grid.spacing()[axis]);
    Ok(DisplacementMap::new(grid, displacements)?.least_jacobian())
}

/// Between a sample with u₀ = 0.3 h₀, u₁ = −0.2 h₁ and neighbours at rest, the simplex that comes along axis 0 and leaves along axis 1 has
/// the gradient e₀⊗u/h₀ − e₁⊗u/h₁ and the least determinant, 1 − 0.3 − 0.2.
#[test]
fn least_jacobian_about_a_single_sample_is_found_wherever_it_is() -> Result<(), RegistrationError> {
    let mut compared = 0;
    let plane = ImageGrid::new([93, 51], [0.5, 0.25])?;
    for row in 1..92 {
        for column in [1, 30, 49] {
            assert_close("plane", &[least_of_one(plane, [row, column], [0.3, -0.2])?], &[0.5], Tol::ulps(8.0));
            compared += 1;
        }
    }
    let space = ImageGrid::new([25, 14, 13], [0.5, 0.25, 2.0])?;
    for row in 1..24 {
        for column in 1..13 {
            let least = least_of_one(space, [row, column, 1 + row % 11], [0.3, -0.2, 0.0])?;
            assert_close("space", &[least], &[0.5], Tol::ulps(8.0));
            compared += 1;
        }
    }
    assert_eq!(compared, 91 * 3 + 23 * 12);
    Ok(())
}

/// A wall stays in place: half a spacing from it, u = ±0.3 h towards the inside leaves 1 − 0.6 of the length.
#[test]
fn least_jacobian_at_a_wall_is_that_of_its_half_spacing() -> Result<(), RegistrationError> {
    let mut compared = 0;
    for axis in 0..3 {
        for is_far in [false, true] {
            let (sizes, part) = ([5, 4, 6], if is_far { -0.3 } else { 0.3 });
            let (mut index, mut parts) = ([2, 1, 3], [0.0; 3]);
            index[axis] = if is_far { sizes[axis] - 1 } else { 0 };
            parts[axis] = part;
            let least = least_of_one(ImageGrid::new(sizes, [0.5, 0.25, 2.0])?, index, parts)?;
            assert_close("space", &[least], &[0.4], Tol::ulps(8.0));
            if axis < 2 {
                let plane = ImageGrid::new([5, 4], [0.5, 0.25])?;
                let least = least_of_one(plane, [index[0], index[1]], [parts[0], parts[1]])?;
                assert_close("plane", &[least], &[0.4], Tol::ulps(8.0));
            }
            compared += 1;
        }
    }
    assert_eq!(compared, 6);
    Ok(())
}

/// det(1 − ∇u) has no unit: the least one is the same in metres and in thirds of a micrometre.
#[test]
fn least_jacobian_does_not_depend_on_the_unit_of_length() -> Result<(), RegistrationError> {
    let least = |unit: f64| -> Result<f64, RegistrationError> {
        let grid = ImageGrid::new([9, 8, 10], [0.1 * unit, 0.125 * unit, 0.1 * unit])?;
        let place = |x: [f64; 3]| displacement(0.08, x.map(|x| x / unit)).map(|u| u * unit);
        Ok(DisplacementMap::from_fn(grid, place)?.least_jacobian())
    };
    let expected = least(1.0)?;
    assert!(0.1 < expected && expected < 0.7, "{expected}");
    for unit in [1e3, 3e6, 1e-3] {
        assert_close("least Jacobian", &[least(unit)?], &[expected], Tol::ulps(64.0));
    }
    Ok(())
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

/// A whirl that turns its middle by four and a half radians: nowhere folded, but −u(y) begins on the other side of the middle.
#[test]
fn inverse_of_a_whirl_turns_back() -> Result<(), RegistrationError> {
    let grid = unit_box::<2>(160)?;
    let whirl = |[y, x]: [f64; 2], sense: f64| {
        let (dx, dy) = (x - 0.5, y - 0.5);
        let left = (1.0 - (dx * dx + dy * dy) / 0.16).max(0.0);
        let (sin, cos) = (sense * 4.5 * left * left).sin_cos();
        [dy - sin * dx - cos * dy, dx - cos * dx + sin * dy]
    };
    let map = DisplacementMap::from_fn(grid, |place| whirl(place, 1.0))?;
    assert!(0.02 < map.least_jacobian(), "{}", map.least_jacobian());
    let inverse = map.inverse()?;
    let rounding = map.after(&inverse)?.largest_displacement();
    assert!(rounding < 64.0 * f64::EPSILON, "{rounding:e}");
    // Between samples u is linear: second order in the spacing.
    let back = DisplacementMap::from_fn(grid, |place| whirl(place, -1.0))?;
    let off = inverse.displacements().as_flattened().iter().zip(back.displacements().as_flattened());
    let off = off.map(|(found, expected)| (found - expected).abs()).fold(0.0, f64::max);
    assert!(off < 0.4 / 160.0, "{off}");
    Ok(())
}
