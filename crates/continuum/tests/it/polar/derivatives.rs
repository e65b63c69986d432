//! Derivatives of the polar decomposition, at coalescence and away from it.

use num_dual::{Dual3_64, HyperDual64};
use piola_continuum::DeformationGradient;
use piola_continuum::polar::StretchAnalysis;
use piola_numerics::{Dual, Real};
use piola_tensor::spectral::{Exponential, tensor_function};
use piola_testkit::spectral::{Random, Rows, with_stretches};
use piola_testkit::{Tol, assert_close};

const COALESCENCE: Tol = Tol::stated(1e-11, "derivatives at coalescence");

const TRIPLES: [[f64; 3]; 8] = [
    [1.5, 1.5, 1.5],
    [2.0, 2.0, 0.5],
    [2.0, 0.5, 0.5],
    [1.5 + 1e-10, 1.5, 0.7],
    [1.5 + 1e-13, 1.5, 1.5 - 1e-13],
    [1.5 + 1e-6, 1.5, 1.5 - 3e-7],
    [2.0, 1.9, 0.3],
    [3.0, 1.0, 0.2],
];

fn product<T: Real>(a: &Rows<T>, b: &Rows<T>) -> Rows<T> {
    core::array::from_fn(|i| core::array::from_fn(|j| a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j]))
}

fn transpose<T: Real>(a: &Rows<T>) -> Rows<T> {
    core::array::from_fn(|i| core::array::from_fn(|j| a[j][i]))
}

/// The identities R U = V R = F, Rᵀ R = 1, U² = C and exp 2 ln U = C with all derivatives that T carries.
fn check_identities<T: Real>(f: &Rows<T>, parts: impl Fn(T) -> Vec<f64>) {
    let deformation = DeformationGradient::new(nalgebra::Matrix3::from_fn(|i, j| f[i][j])).expect("0 < det F");
    let stretch = StretchAnalysis::of(&deformation);
    let (r, u, v) = (stretch.rotation(), stretch.right_stretch().rows(), stretch.left_stretch().rows());
    let all = |rows: &Rows<T>| rows.as_flattened().iter().flat_map(|x| parts(*x)).collect::<Vec<_>>();
    let c = product(&transpose(f), f);
    let twice = stretch.hencky_material() * T::lit(2.0);
    let one: Rows<T> = core::array::from_fn(|i| core::array::from_fn(|j| T::lit(f64::from(u8::from(i == j)))));
    assert_close("R U", &all(&product(&r, &u)), &all(f), COALESCENCE);
    assert_close("V R", &all(&product(&v, &r)), &all(f), COALESCENCE);
    assert_close("Rᵀ R", &all(&product(&transpose(&r), &r)), &all(&one), COALESCENCE);
    assert_close("U²", &all(&product(&u, &u)), &all(&c), COALESCENCE);
    assert_close("exp 2 ln U", &all(&tensor_function(&Exponential, &twice).rows()), &all(&c), COALESCENCE);
    let inverse = stretch.inverse_right_stretch().rows();
    assert_close("U⁻¹ U", &all(&product(&inverse, &u)), &all(&one), COALESCENCE);
}

#[test]
fn polar_identities_hold_with_derivatives_of_num_dual() {
    let mut random = Random::new(22);
    for stretches in TRIPLES {
        for _ in 0..20 {
            let (p, q) = (random.rotation(), random.rotation());
            let (f, g, h) = (with_stretches(&p, stretches, &q), random.matrix(), random.matrix());
            let hyper = core::array::from_fn(|i| {
                core::array::from_fn(|j| HyperDual64::new(f[i][j], 0.5 * g[i][j], 0.5 * h[i][j], 0.1))
            });
            check_identities(&hyper, |x| vec![x.re, x.eps1, x.eps2, x.eps1eps2]);
            let third = core::array::from_fn(|i| {
                core::array::from_fn(|j| Dual3_64::new(f[i][j], 0.5 * g[i][j], 0.25 * h[i][j], 0.1))
            });
            check_identities(&third, |x| vec![x.re, x.v1, x.v2, x.v3]);
        }
    }
}

#[test]
fn polar_identities_hold_to_the_fourth_order() {
    type Four = Dual<Dual<Dual<Dual<f64>>>>;
    let mut random = Random::new(23);
    let parts = |x: Four| {
        let values = [x.value, x.tangent].map(|x| [x.value, x.tangent].map(|x| [x.value, x.tangent]));
        values.iter().flatten().flatten().flat_map(|x| [x.value, x.tangent]).collect()
    };
    for stretches in TRIPLES {
        for _ in 0..5 {
            let (p, q) = (random.rotation(), random.rotation());
            let (f, g, h) = (with_stretches(&p, stretches, &q), random.matrix(), random.matrix());
            let entry = |i: usize, j: usize| {
                let line = Dual::new(f[i][j], 0.2 * g[i][j]);
                let plane = Dual::new(line, Dual::constant(0.2 * h[i][j]));
                let space = Dual::new(plane, Dual::constant(Dual::constant(0.2 * g[j][i])));
                Dual::new(space, Dual::constant(Dual::constant(Dual::constant(0.2 * h[j][i]))))
            };
            check_identities(&core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j))), parts);
        }
    }
}
