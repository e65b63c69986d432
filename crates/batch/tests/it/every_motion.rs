//! Every request of relative deformations, accelerations, exponentials and rotations gives at a point what the one-point
//! interface gives, in lanes too, and names what is no deformation and no rotation.

use nalgebra::Matrix3;
use piola_continuum::rates::{AccelerationGradient, RelativeDeformation, RivlinEricksen, VelocityGradient, WhiteMetzner, exponential_rows};
use piola_tensor::{MajorSymmetric, PairSymmetric};
use piola_batch as batch;
use piola_continuum::{ContinuumError, Symmetric};
use piola_numerics::linear::matrix3::from_rows;
use piola_testkit::spectral::Random;

use super::cases::deformations;
use super::every_request::{all, flat, flat_rows, same};

fn tensors(random: &mut Random, count: usize) -> Vec<Matrix3<f64>> {
    (0..count).map(|_| from_rows(random.matrix())).collect()
}

fn rotations(random: &mut Random, count: usize) -> Vec<Matrix3<f64>> {
    (0..count).map(|_| from_rows(random.rotation())).collect()
}

#[test]
fn relative_deformations_accelerations_and_rotations_equal_those_of_one_point() {
    let mut random = Random::new(19);
    let thens = deformations(96);
    for (f, then) in deformations(97)[1..].iter().zip(&thens) {
        let Ok(relative) = RelativeDeformation::of(f, then) else { continue };
        let (l, a) = (from_rows(random.matrix()), from_rows(random.matrix()));
        let (velocity, acceleration) = (VelocityGradient(l), AccelerationGradient(a));
        let (q, symmetric) =
            (from_rows(random.rotation()), Symmetric { components: [(); 6].map(|()| random.symmetric()) });
        let tangent = MajorSymmetric { components: [(); 21].map(|()| random.symmetric()) };
        let (g, l, a, q) = (&[*then.matrix()][..], &[velocity][..], &[acceleration][..], &[q][..]);
        all! { f:
            relative_gradient(g) = flat(&relative.gradient());
            relative_right_cauchy_green(g) = relative.right_cauchy_green().components;
            relative_right_cauchy_green_change(g) = relative.right_cauchy_green_change().components;
            second_rivlin_ericksen(a, l) = RivlinEricksen::of_gradients(&[l[0].0, a[0].0])[1].0.components;
            second_white_metzner(a, l) = WhiteMetzner::of_gradients(&[l[0].0, a[0].0])[1].0.components;
            exponential(g) = flat_rows(exponential_rows(piola_numerics::linear::matrix3::rows_of(&g[0])));
            rotated(&[symmetric][..], q) = symmetric.rotated(&q[0]).expect("a rotation").components;
            rotated_tangent(&[tangent][..], q) = tangent.rotated(&q[0]).expect("a rotation").components;
        }
    }
}

#[test]
fn motions_and_rotations_in_lanes_equal_those_of_one_point() {
    const COUNT: usize = 103;
    let mut random = Random::new(20);
    let f = deformations(COUNT);
    let then: Vec<_> =
        f.iter().map(|f| f.matrix() * (Matrix3::identity() + from_rows(random.matrix()) * 1e-3)).collect();
    let (l, q) = (tensors(&mut random, COUNT), rotations(&mut random, COUNT));
    let l: Vec<_> = l.into_iter().map(VelocityGradient).collect();
    let a: Vec<_> = tensors(&mut random, COUNT).into_iter().map(AccelerationGradient).collect();
    let tensor: Vec<_> = (0..COUNT).map(|_| Symmetric { components: [(); 6].map(|()| random.symmetric()) }).collect();
    let (mut relative, mut turned, mut second) = ([[0.0; 6]; COUNT], [[0.0; 6]; COUNT], [[0.0; 6]; COUNT]);
    let requests = (
        batch::relative_right_cauchy_green_change(&then[..], &mut relative[..]),
        batch::rotated(&tensor[..], &q[..], &mut turned[..]),
        batch::second_rivlin_ericksen(&a[..], &l[..], &mut second[..]),
    );
    batch::evaluate(&f[..], requests).expect("deformations and rotations");
    for (i, f) in f.iter().enumerate() {
        same(&batch::relative_right_cauchy_green_change(&then[i..=i], &mut [[0.0; 6]; 0][..]), f, relative[i]);
        assert_eq!(Symmetric { components: turned[i] }, tensor[i].rotated(&q[i]).expect("a rotation"), "point {i}");
        let expected = RivlinEricksen::of_gradients(&[l[i].0, a[i].0])[1].0;
        assert_eq!(Symmetric { components: second[i] }, expected, "point {i}");
    }
}

#[test]
fn what_is_no_deformation_then_and_no_rotation_is_named_and_the_others_computed() {
    const COUNT: usize = 41;
    let mut random = Random::new(21);
    let f = deformations(COUNT);
    let mut then: Vec<_> = f.iter().map(|f| *f.matrix()).collect();
    then[7] = -then[7];
    let mut q = rotations(&mut random, COUNT);
    q[7] *= 1.0 + 1e-12;
    q[30] = -q[30];
    let tensor = [Symmetric::<f64>::identity(); COUNT];
    let (mut relative, mut turned) = ([[0.0; 9]; COUNT], [[0.0; 6]; COUNT]);
    let bad = |result: Result<batch::Report, ContinuumError>| match result {
        Err(ContinuumError::BadPoints { points, .. }) => points,
        other => panic!("bad points are expected: {other:?}"),
    };
    let backwards = bad(batch::evaluate(&f[..], batch::relative_gradient(&then[..], &mut relative[..])));
    assert_eq!(backwards.iter().map(|point| point.index).collect::<Vec<_>>(), [7]);
    assert!(matches!(backwards[0].error, ContinuumError::NonPositiveJacobian { .. }));
    assert!(relative[7].iter().all(|x: &f64| x.is_nan()) && relative[8].iter().all(|x| x.is_finite()));
    let spoilt = bad(batch::evaluate(&f[..], batch::rotated(&tensor[..], &q[..], &mut turned[..])));
    assert_eq!(spoilt.iter().map(|point| point.index).collect::<Vec<_>>(), [7, 30]);
    assert!(spoilt.iter().all(|point| matches!(point.error, ContinuumError::NotARotation { .. })));
    assert!((turned[8][0] - 1.0).abs() < 1e-14);
}
