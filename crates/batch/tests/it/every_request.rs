//! Every request gives at a point what the one-point interface gives.

use nalgebra::Matrix3;
use piola_batch as batch;
use piola_batch::{Destination, Quantity, Request, Source};
use piola_continuum::polar::StretchAnalysis;
use piola_continuum::rates::{GradientRate, StretchRates, VelocityGradient};
use piola_continuum::strain::{
    GreenStrain, HenckyStrain, LeftCauchyGreen, LeftStretch, RightCauchyGreen, RightStretch, Rotation,
    SpatialHenckyStrain,
};
use piola_continuum::stress::tangents::{MaterialTangent, TruesdellTangent};
use piola_continuum::{CauchyStress, Deformation, DeformationGradient, FirstPiola, KirchhoffStress, SecondPiola};
use piola_numerics::linear::matrix3::{from_rows, rows_of};
use piola_tensor::{FourthOrder, MajorSymmetric, Symmetric};
use piola_testkit::spectral::Random;
use piola_testkit::{Tol, assert_close};

use super::cases::deformations;

/// Rows one after the other.
fn flat(matrix: &Matrix3<f64>) -> [f64; 9] {
    flat_rows(rows_of(matrix))
}

fn flat_rows(rows: [[f64; 3]; 3]) -> [f64; 9] {
    std::array::from_fn(|k| rows[k / 3][k % 3])
}

fn entries(tensor: &FourthOrder) -> [f64; 81] {
    std::array::from_fn(|k| tensor.components[k / 9][k % 9])
}

/// The same formula, called in two ways.
fn same<Q, S, V, const I: usize, const K: usize>(
    request: &Request<Q, S, V, I, K>,
    deformation: &DeformationGradient,
    expected: [f64; K],
) where
    Q: Quantity<I, K> + core::fmt::Debug,
    S: Source<Q::Input, f64, I>,
    V: Destination<Q::Output, f64, K>,
{
    let found = request.at(deformation, 0);
    assert_close(core::any::type_name::<Q>(), &found, &expected, Tol::ulps(1.0));
}

/// Requests that need no destination of some type.
macro_rules! all {
    ($f:ident: $($function:ident($($argument:expr),*) = $expected:expr;)*) => { $(
        same(&batch::$function($($argument,)* &mut [[0.0; _]; 0][..]), $f, $expected);
    )* };
}

#[test]
fn measures_of_deformation_equal_those_of_one_point() {
    for f in &deformations(97) {
        let stretch = StretchAnalysis::of(f);
        all! { f:
            jacobian() = [f.jacobian()];
            right_cauchy_green() = RightCauchyGreen::of(f).0.components;
            left_cauchy_green() = LeftCauchyGreen::of(f).0.components;
            green_strain() = GreenStrain::of(f).0.components;
            rotation() = flat_rows(Rotation::of(f).rows());
            right_stretch() = RightStretch::of(f).0.components;
            left_stretch() = LeftStretch::of(f).0.components;
            hencky() = HenckyStrain::of(f).0.components;
            spatial_hencky() = SpatialHenckyStrain::of(f).0.components;
            principal_stretches() = stretch.principal_stretches();
        }
    }
}

#[test]
fn conversions_equal_those_of_one_point() {
    let mut random = Random::new(11);
    for f in &deformations(97) {
        let s: [f64; 6] = [(); 6].map(|()| random.symmetric());
        let g = from_rows(random.matrix());
        let symmetric = Symmetric { components: s };
        let (t, tau, second) = (CauchyStress(symmetric), KirchhoffStress(symmetric), SecondPiola(symmetric));
        let p = FirstPiola(g);
        let (s, g) = (&[s][..], &[g][..]);
        all! { f:
            cauchy_to_kirchhoff(s) = t.kirchhoff(f).0.components;
            cauchy_to_first_piola(s) = flat(&t.first_piola(f).0);
            cauchy_to_second_piola(s) = t.second_piola(f).0.components;
            kirchhoff_to_cauchy(s) = tau.cauchy(f).0.components;
            first_piola_to_cauchy(g) = p.cauchy(f).0.components;
            first_piola_to_second_piola(g) = p.second_piola(f).0.components;
            second_piola_to_cauchy(s) = second.cauchy(f).0.components;
            second_piola_to_first_piola(s) = flat(&second.first_piola(f).0);
            von_mises(s) = [t.von_mises()];
        }
    }
}

/// ∂/∂F by the rates for each entry of Ḟ.
fn by_rates(f: &DeformationGradient, rate: impl Fn(&StretchRates) -> [f64; 6]) -> [f64; 54] {
    let columns: [[f64; 6]; 9] = std::array::from_fn(|place| {
        let mut direction = Matrix3::zeros();
        direction[(place / 3, place % 3)] = 1.0;
        rate(&StretchRates::of(f, &GradientRate(direction)))
    });
    std::array::from_fn(|place| columns[place % 9][place / 9])
}

#[test]
fn derivatives_and_rates_equal_those_of_one_point() {
    let mut random = Random::new(13);
    for f in &deformations(97) {
        let (a, b) = (from_rows(random.matrix()), from_rows(random.matrix()));
        let (rate, l) = (GradientRate(a), VelocityGradient(a));
        let rates = StretchRates::of(f, &rate);
        let (x, y) = (&[a][..], &[b][..]);
        all! { f:
            hencky_derivative() = by_rates(f, |rates| rates.hencky_material().components);
            hencky_second_derivative(x, y) = HenckyStrain::second_derivative(f, &a, &b).components;
            hencky_rate(x) = rates.hencky_material().components;
            velocity_gradient(x) = flat(&VelocityGradient::of(f, &rate).0);
            rate_of_deformation(x) = l.rate_of_deformation().0.components;
        }
    }
}

/// What the batch takes from rates of the stretches, the single point takes from scalars with derivatives.
#[test]
fn derivatives_of_the_logarithm_equal_automatic_ones() {
    let tolerance = Tol::stated(1e-11, "derivatives, coalescence included");
    let mut seen = 0;
    for f in &deformations(300) {
        let [largest, .., smallest] = StretchAnalysis::of(f).principal_stretches();
        if 10.0 * smallest < largest {
            continue;
        }
        seen += 1;
        let found = batch::hencky_derivative(&mut [[0.0; 54]; 0][..]).at(f, 0);
        assert_close("∂ ln U/∂F", &found, HenckyStrain::derivative_matrix(f).as_flattened(), tolerance);
    }
    assert!(100 < seen, "{seen} deformations are ordinary");
}

#[test]
fn derivatives_in_lanes_equal_those_of_one_point() {
    let f: Vec<_> = deformations(37).into_iter().filter(Deformation::is_moderate).collect();
    let mut random = Random::new(16);
    let directions: Vec<Matrix3<f64>> = f.iter().map(|_| from_rows(random.matrix())).collect();
    let (mut first, mut second) = (vec![[0.0; 54]; f.len()], vec![Symmetric::zero(); f.len()]);
    let requests = (
        batch::hencky_derivative(&mut first[..]),
        batch::hencky_second_derivative(&directions[..], &directions[..], &mut second[..]),
    );
    batch::evaluate(&f[..], requests).expect("deformations");
    for (index, f) in f.iter().enumerate() {
        // Logarithms in lanes are their own, within 2 ulp.
        let expected = by_rates(f, |rates| rates.hencky_material().components);
        assert_close("∂ ln U/∂F", &first[index], &expected, Tol::ulps(64.0));
        let expected = HenckyStrain::second_derivative(f, &directions[index], &directions[index]);
        assert_close("∂² ln U/∂F²", &second[index].components, &expected.components, Tol::ulps(64.0));
    }
}

#[test]
fn tangents_equal_those_of_one_point() {
    let mut random = Random::new(14);
    for f in &deformations(97) {
        let s: [f64; 6] = [(); 6].map(|()| random.symmetric());
        let c: [f64; 21] = std::array::from_fn(|_| random.symmetric());
        let (t, second) = (CauchyStress(Symmetric { components: s }), SecondPiola(Symmetric { components: s }));
        let tensor = MajorSymmetric { components: c };
        let (material, truesdell): (MaterialTangent, TruesdellTangent) =
            (MaterialTangent(tensor), TruesdellTangent(tensor));
        let (s, c) = (&[s][..], &[c][..]);
        all! { f:
            push_forward_tangent(c) = material.lie(f).0.components;
            truesdell_tangent(c) = material.truesdell(f).0.components;
            first_piola_tangent(s, c) = entries(&material.first_piola(&second, f).0);
            jaumann_tangent(s, c) = truesdell.jaumann(&t).0.components;
        }
    }
}
