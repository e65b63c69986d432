//! The same formulas in f32, in lanes and in differentiable numbers.

use nalgebra::Matrix3;
use piola_continuum::internal::tangents::push_forward;
use piola_continuum::stress::tangents::{MaterialTangent, TruesdellTangent};
use piola_continuum::{DeformationGradient, Symmetric};
use piola_numerics::{Dual, Kernel, Lanes, Level, Real, dispatch_at};
use piola_tensor::{MajorSymmetric, PairSymmetric};
use piola_testkit::{Tol, assert_close};

const F: [[f64; 3]; 3] = [[1.2, 0.3, -0.1], [0.05, 0.9, 0.2], [0.15, -0.25, 1.1]];

fn tangent<T: Real>() -> [T; 21] {
    core::array::from_fn(|i| T::lit(f64::from(u8::try_from(i).expect("below 21")).sin()))
}

fn gradient<T: Real>() -> [[T; 3]; 3] {
    F.map(|row| row.map(T::lit))
}

/// Pushes one tangent forward in each lane.
struct Push<'a>([[Lanes<f64, 4>; 3]; 3], &'a [Lanes<f64, 4>; 21]);

impl Kernel for Push<'_> {
    type Output = [Lanes<f64, 4>; 21];
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn run(self) -> Self::Output {
        push_forward(self.0, self.1)
    }
}

#[test]
fn lanes_equal_scalars_to_the_last_bit() {
    let expected = push_forward::<f64>(gradient(), &tangent());
    for level in Level::available() {
        let lanes = dispatch_at(level, Push(gradient(), &tangent()));
        for lane in 0..4 {
            let found: Vec<u64> = lanes.iter().map(|x| x.primal(lane).to_bits()).collect();
            assert_eq!(found, expected.map(f64::to_bits), "lane {lane} at {level:?}");
        }
    }
}

#[test]
fn single_precision_agrees_with_double() {
    let single = push_forward::<f32>(gradient(), &tangent());
    let double = push_forward::<f64>(gradient(), &tangent());
    assert_close("c", &single.map(f64::from), &double, Tol::ulps32(16.0));
    let inverse = Symmetric::<f32>::diagonal([2e30, 4e30, 1e30]).inverse().expect("regular");
    assert_close(
        "A⁻¹",
        &inverse.components.map(|x| f64::from(x) * 1e30),
        &[0.5, 0.25, 1.0, 0.0, 0.0, 0.0],
        Tol::ulps32(4.0),
    );
}

#[test]
fn derivative_of_the_truesdell_tangent_with_respect_to_f_equals_differences() {
    let of = |t: f64| {
        let f = Matrix3::from_fn(|i, j| F[i][j] + t * F[j][i]);
        let tangent: MaterialTangent = MaterialTangent(MajorSymmetric { components: tangent() });
        tangent.truesdell(&DeformationGradient::new(f).expect("0 < det F")).0.components.to_vec()
    };
    let f = Matrix3::from_fn(|i, j| Dual { value: F[i][j], tangent: F[j][i] });
    let material = MaterialTangent::<Dual<f64>>(MajorSymmetric { components: tangent() });
    let exact: TruesdellTangent<Dual<f64>> = material.truesdell(&DeformationGradient::new(f).expect("0 < det F"));
    let difference = piola_testkit::difference_quotient(|t| of(t[0]), &[0.0], &[1.0]);
    let tolerance = Tol::stated(1e-11, "sixth-order differences");
    assert_close("dc/dt", &exact.0.components.map(|x| x.tangent), &difference, tolerance);
    let norm = Symmetric::<Dual<f64>>::zero().norm();
    assert_eq!((norm.value.to_bits(), norm.tangent.to_bits()), (0, 0), "no NaN at the corner of the norm");
    let _ = exact.0.minor();
}
