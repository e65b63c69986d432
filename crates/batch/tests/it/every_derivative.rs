//! Every request of derivatives gives at a point what the one-point interface gives.

use nalgebra::Matrix3;
use piola_continuum::rates::{GradientRate, StretchRates};
use piola_continuum::polar::StretchAnalysis;
use piola_tensor::spectral::{Exponential, Logarithm, SquareRoot, derivative_array, second_derivative};
use piola_continuum::strain::{AlmansiStrain, GreenStrain, HenckyStrain, LeftCauchyGreen, LeftStretch, RightCauchyGreen, RightStretch, Rotation, SethHill, SethHillStrain, SpatialHenckyStrain, SpatialSethHillStrain, invariants};
use piola_batch as batch;
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::linear::matrix3::from_rows;
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close};

use super::cases::deformations;
use super::every_request::{all, flat, same};

/// Rows of nine, one after the other.
fn joined<const K: usize, const TOTAL: usize>(rows: [[f64; 9]; K]) -> [f64; TOTAL] {
    std::array::from_fn(|place| rows[place / 9][place % 9])
}

/// The rates for one entry of Ḟ.
#[inline(never)]
fn rates_along(f: &DeformationGradient, place: usize) -> StretchRates {
    let mut direction = Matrix3::zeros();
    direction[(place / 3, place % 3)] = 1.0;
    StretchRates::of(f, &GradientRate(direction))
}

/// ∂/∂F by the rates for each entry of Ḟ.
fn by_rates<const K: usize, const TOTAL: usize>(
    f: &DeformationGradient,
    rate: impl Fn(&StretchRates) -> [f64; K],
) -> [f64; TOTAL] {
    let columns: [[f64; K]; 9] = std::array::from_fn(|place| rate(&rates_along(f, place)));
    std::array::from_fn(|place| columns[place % 9][place / 9])
}

#[test]
fn derivatives_by_the_gradient_equal_those_of_one_point() {
    let scale = SethHill::new(1.5).expect("an order");
    for f in &deformations(97) {
        all! { f:
            right_cauchy_green_derivative() = joined(RightCauchyGreen::derivative_matrix(f));
            left_cauchy_green_derivative() = joined(LeftCauchyGreen::derivative_matrix(f));
            green_strain_derivative() = joined(GreenStrain::derivative_matrix(f));
            almansi_strain_derivative() = joined(AlmansiStrain::derivative_matrix(f));
            right_stretch_derivative() = by_rates(f, |rates| rates.right_stretch().components);
            left_stretch_derivative() = by_rates(f, |rates| rates.left_stretch().components);
            hencky_derivative() = by_rates(f, |rates| rates.hencky_material().components);
            hencky_spatial_derivative() = by_rates(f, |rates| rates.hencky_spatial().components);
            rotation_derivative() = by_rates(f, |rates| flat(&rates.rotation()));
            seth_hill_derivative(scale) = by_rates(f, |rates| rates.material_function(&scale).components);
            seth_hill_spatial_derivative(scale) = by_rates(f, |rates| rates.spatial_function(&scale).components);
            strain_invariant_gradients() = joined([
                invariants::first_gradient(f).as_flattened().try_into().expect("nine"),
                invariants::second_gradient(f).as_flattened().try_into().expect("nine"),
                invariants::third_gradient(f).as_flattened().try_into().expect("nine"),
            ]);
            isochoric_invariants() = [invariants::isochoric_first(f), invariants::isochoric_second(f)];
            isochoric_first_derivative() = invariants::isochoric_first_derivative(f).components;
            isochoric_second_derivative() = invariants::isochoric_second_derivative(f).components;
        }
    }
}

/// What the batch takes from rates of the stretches, the single point takes from scalars with derivatives.
#[test]
fn derivatives_of_spectral_strains_equal_automatic_ones() {
    let tolerance = Tol::stated(1e-11, "derivatives, coalescence included");
    let mut seen = 0;
    for f in &deformations(300) {
        let [largest, .., smallest] = StretchAnalysis::of(f).principal_stretches();
        if 10.0 * smallest < largest {
            continue;
        }
        seen += 1;
        let close = |what: &str, found: [f64; 54], expected: [[f64; 9]; 6]| {
            assert_close(what, &found, expected.as_flattened(), tolerance);
        };
        let none = || [[0.0; 54]; 0];
        let found = batch::right_stretch_derivative(&mut none()[..]).at(f, 0);
        close("∂U/∂F", found, RightStretch::derivative_matrix(f));
        let found = batch::left_stretch_derivative(&mut none()[..]).at(f, 0);
        close("∂V/∂F", found, LeftStretch::derivative_matrix(f));
        let found = batch::hencky_derivative(&mut none()[..]).at(f, 0);
        close("∂ ln U/∂F", found, HenckyStrain::derivative_matrix(f));
        let found = batch::hencky_spatial_derivative(&mut none()[..]).at(f, 0);
        close("∂ ln V/∂F", found, SpatialHenckyStrain::derivative_matrix(f));
        let mut direction = Matrix3::zeros();
        direction[(1, 2)] = 1.0;
        let whole = batch::rotation_derivative(&mut [[0.0; 81]; 0][..]).at(f, 0);
        let column: [f64; 9] = std::array::from_fn(|row| whole[9 * row + 5]);
        let expected = flat(&Rotation::derivative(f, &direction));
        assert_close("∂R/∂F₂₃", &column, &expected, tolerance);
    }
    assert!(100 < seen, "{seen} deformations are ordinary");
}

#[test]
fn second_derivatives_equal_those_of_one_point() {
    let mut random = Random::new(15);
    let scale = SethHill::new(-0.5).expect("an order");
    for f in &deformations(200) {
        let (a, b) = (from_rows(random.matrix()), from_rows(random.matrix()));
        let [s, x, y] = [(); 3].map(|()| [(); 6].map(|()| random.symmetric()));
        let [tensor, first, second] = [s, x, y].map(|components| Symmetric { components });
        let u = RightStretch::of(f).0;
        let (p, q) = (&[a][..], &[b][..]);
        let (s, x, y, w) = (&[s][..], &[x][..], &[y][..], &[u][..]);
        all! { f:
            right_cauchy_green_second_derivative(p, q) = RightCauchyGreen::second_derivative(&a, &b).components;
            left_cauchy_green_second_derivative(p, q) = LeftCauchyGreen::second_derivative(&a, &b).components;
            green_strain_second_derivative(p, q) = GreenStrain::second_derivative(&a, &b).components;
            almansi_strain_second_derivative(p, q) = AlmansiStrain::second_derivative(f, &a, &b).components;
            right_stretch_second_derivative(p, q) = RightStretch::second_derivative(f, &a, &b).components;
            left_stretch_second_derivative(p, q) = LeftStretch::second_derivative(f, &a, &b).components;
            hencky_second_derivative(p, q) = HenckyStrain::second_derivative(f, &a, &b).components;
            hencky_spatial_second_derivative(p, q) = SpatialHenckyStrain::second_derivative(f, &a, &b).components;
            seth_hill_second_derivative(scale, p, q) = SethHillStrain::second_derivative(f, scale, &a, &b).components;
            seth_hill_spatial_second_derivative(scale, p, q) =
                SpatialSethHillStrain::second_derivative(f, scale, &a, &b).components;
            isochoric_first_second_derivative(x) = invariants::isochoric_first_second_derivative(f, &first).components;
            isochoric_second_second_derivative(x) =
                invariants::isochoric_second_second_derivative(f, &first).components;
            invariant_derivatives(s) = {
                let [one, two, three] = invariants::derivatives(&tensor).map(|gradient| gradient.components);
                std::array::from_fn(|k| if k < 6 { one[k] } else if k < 12 { two[k - 6] } else { three[k - 12] })
            };
            invariant_second_derivatives(s, x, y) = invariants::second_derivatives(&tensor, &first, &second);
            tensor_function_second_derivative(Logarithm, w, x, y) =
                second_derivative(&Logarithm, &u, &first, &second).components;
            tensor_function_derivative_array(Exponential, s) = {
                let array = derivative_array(&Exponential, &tensor);
                std::array::from_fn(|k| array[k / 6][k % 6])
            };
            tensor_function_derivative_array(SquareRoot, w) = {
                let array = derivative_array(&SquareRoot, &u);
                std::array::from_fn(|k| array[k / 6][k % 6])
            };
        }
    }
}

#[test]
fn derivatives_in_lanes_equal_those_of_one_point() {
    let f = deformations(37);
    let mut random = Random::new(16);
    let directions: Vec<Matrix3<f64>> = f.iter().map(|_| from_rows(random.matrix())).collect();
    let (mut first, mut second) = (vec![[0.0; 54]; f.len()], vec![Symmetric::zero(); f.len()]);
    let requests = (
        batch::right_stretch_derivative(&mut first[..]),
        batch::almansi_strain_second_derivative(&directions[..], &directions[..], &mut second[..]),
    );
    batch::evaluate(&f[..], requests).expect("deformations");
    for (index, f) in f.iter().enumerate() {
        let expected: [f64; 54] = by_rates(f, |rates| rates.right_stretch().components);
        assert_close("∂U/∂F", &first[index], &expected, Tol::ulps(0.0));
        let expected = AlmansiStrain::second_derivative(f, &directions[index], &directions[index]);
        assert_close("∂²e/∂F²", &second[index].components, &expected.components, Tol::ulps(0.0));
    }
}
