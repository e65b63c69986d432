//! The five matrices against closed forms and against differences of the accelerations.

use nalgebra::{DMatrix, DVector, dmatrix};
use piola_lagrangian::LagrangianError;
use piola_lagrangian::{Forces, Holonomic, Lagrangian, LagrangianFunction, Potential};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, difference_quotient};

use crate::systems::{GRAVITY, Linear, Still, TOP, foucault, hoop, row_of_springs, sprung, standing};

/// Compares A with differences of q̈ in every coordinate and velocity.
fn state_matrix_equals_differences<S: Holonomic, P: Potential, F: Forces>(
    name: &str,
    lagrangian: &Lagrangian<S, P, F>,
    q: &[f64],
    v: &[f64],
    t: f64,
) {
    let n = q.len();
    let linearisation = lagrangian.linearise(q, v, t).unwrap();
    let found = linearisation.state_matrix().unwrap();
    let rate = |x: &[f64]| {
        let accelerations = lagrangian.acceleration(&x[..n], &x[n..], t).unwrap();
        [&x[n..], accelerations.as_slice()].concat()
    };
    let state = [q, v].concat();
    let scale = found.amax();
    for j in 0..2 * n {
        let direction: Vec<f64> = (0..2 * n).map(|i| f64::from(u8::from(i == j))).collect();
        let expected = difference_quotient(rate, &state, &direction);
        let what = format!("{name}, column {j}");
        let tolerance = Tol::stated(1e-10, "sixth-order differences of steps of 2⁻⁹");
        assert_close_at_scale(&what, found.column(j).as_slice(), &expected, scale, tolerance);
    }
    let expected = lagrangian.acceleration(q, v, t).unwrap();
    assert_close("q̈₀", linearisation.acceleration.as_slice(), expected.as_slice(), Tol::ulps(4.0));
}

#[test]
fn state_matrix_equals_differences_of_acceleration() {
    let (q, v) = ([0.5, -1.0, 0.75, 0.25], [1.5, -0.5, 2.0, 1.0]);
    let pendulums = standing(Still::Pendulums(vec![1.0, 2.0, 0.5, 1.0], vec![1.0, 0.5, 0.75, 1.0]));
    state_matrix_equals_differences("pendulums", &pendulums, &q, &v, 0.0);
    state_matrix_equals_differences("cart", &standing(Still::CartPole(2.0, 1.0)), &q[..2], &v[..2], 0.0);
    state_matrix_equals_differences("top", &standing(Still::top()), &q[1..], &v[1..], 0.0);
    state_matrix_equals_differences("hoop", &hoop(0.5, 2.0, 3.0), &q[..1], &v[..1], 0.25);
    let earth = foucault([2.0, 4.0, 0.5, 0.75]);
    state_matrix_equals_differences("Foucault", &earth, &q[..2], &v[..2], 0.25);
    // Beyond eight coordinates derivatives come in chunks.
    let many: Vec<f64> = (0..10).map(|i| 0.3 * f64::from(i) - 1.0).collect();
    let chain = standing(Still::Pendulums(vec![1.0; 10], vec![1.0; 10]));
    state_matrix_equals_differences("chain", &chain, &many, &many, 0.0);
}

#[test]
fn state_matrix_of_a_relativistic_particle_knows_its_velocity_dependent_mass() {
    /// L = −√(1 − v²) + q²/2.
    struct Relativistic;
    impl LagrangianFunction for Relativistic {
        fn lagrangian<T: Real>(&self, q: &[T], v: &[T], _t: T) -> T {
            -(T::one() - v[0] * v[0]).sqrt() + T::lit(0.5) * q[0] * q[0]
        }
    }
    // a = q (1 − v²)^(3/2): ∂a/∂q = 0.512, ∂a/∂v = −3 q v √(1 − v²) = −1.44 q at v = 0.6.
    let (q, v) = (1.5, 0.6);
    let a = Lagrangian::from_function(Relativistic).linearise(&[q], &[v], 0.0).unwrap().state_matrix().unwrap();
    assert_close("A", a.as_slice(), &[0.0, 0.512, 1.0, -1.44 * q], Tol::ulps(16.0));
}

#[test]
fn pendulum_of_foucault_splits_into_gyroscopic_and_stiffness() {
    let (mass, length, rate, latitude) = (2.0, 4.0, 0.5, 0.75_f64);
    let small = foucault([mass, length, rate, latitude]).linearise(&[0.0; 2], &[0.0; 2], 0.5).unwrap();
    let (s, c) = latitude.sin_cos();
    let tolerance = Tol::ulps(32.0);
    assert_close("M", small.mass_matrix.as_slice(), &[mass, 0.0, 0.0, mass], tolerance);
    let turn = 2.0 * mass * rate * s;
    assert_close("G", small.gyroscopic.as_slice(), &[0.0, turn, -turn, 0.0], tolerance);
    let scale = mass * GRAVITY / length;
    assert_close_at_scale("C", small.damping.as_slice(), &[0.0; 4], scale, tolerance);
    assert_close_at_scale("N", small.circulatory.as_slice(), &[0.0; 4], scale, tolerance);
    let east = mass * (GRAVITY / length - rate * rate * s * s);
    let north = mass * (GRAVITY / length + rate * rate * (c * c - s * s));
    assert_close("K", small.stiffness.as_slice(), &[east, 0.0, 0.0, north], tolerance);
    // The axis passes through the support, so that the bob, below it, is thrown to the north.
    let centrifugal = [0.0, rate * rate * length * s * c];
    assert_close("q̈₀", small.acceleration.as_slice(), &centrifugal, tolerance);
}

#[test]
fn sleeping_top_splits_into_gyroscopic_and_negative_stiffness() {
    let [transverse, axial, mass, height] = TOP;
    let spin = 7.0;
    let top = standing(Still::top()).linearise(&[0.0; 3], &[0.0, 0.0, spin], 0.0).unwrap();
    let tolerance = Tol::ulps(32.0);
    let diagonal = DMatrix::from_diagonal(&DVector::from_vec(vec![transverse, transverse, axial]));
    assert_close("M", top.mass_matrix.as_slice(), diagonal.as_slice(), tolerance);
    let overturning = -mass * GRAVITY * height;
    // The turning axes of this chart share the gyroscopic term between G and nothing else.
    let gyroscopic = dmatrix![0.0, axial * spin, 0.0; -axial * spin, 0.0, 0.0; 0.0, 0.0, 0.0];
    assert_close("G", top.gyroscopic.as_slice(), gyroscopic.as_slice(), tolerance);
    assert_close("K", top.stiffness.diagonal().as_slice(), &[overturning, overturning, 0.0], tolerance);
}

#[test]
fn applied_linear_forces_come_back_split() {
    let velocity = dmatrix![3.0, 1.0; -2.0, 5.0];
    let position = dmatrix![0.0, 4.0; -4.0, 0.0];
    let forces = Linear { velocity: Some(velocity), position: Some(position) };
    let found = sprung(vec![2.0, 1.0], row_of_springs(2, 8.0, 2), forces).linearise(&[0.0; 2], &[0.0; 2], 0.0).unwrap();
    assert_eq!(found.damping, dmatrix![3.0, -0.5; -0.5, 5.0]);
    assert_eq!(found.gyroscopic, dmatrix![0.0, 1.5; -1.5, 0.0]);
    assert_eq!(found.circulatory, dmatrix![0.0, 4.0; -4.0, 0.0]);
    assert_eq!(found.stiffness, dmatrix![16.0, -8.0; -8.0, 16.0]);
    assert_eq!(found.velocity_matrix(), dmatrix![3.0, 1.0; -2.0, 5.0]);
    assert_eq!(found.position_matrix(), dmatrix![16.0, -4.0; -12.0, 16.0]);
}

#[test]
fn input_matrix_equals_acceleration_by_unit_inputs() {
    let cart = standing(Still::CartPole(3.0, 1.0));
    let upright = cart.linearise(&[0.0; 2], &[0.0; 2], 0.0).unwrap();
    // A unit force on the cart: ẍ = 1/M, θ̈ = −1/(M l).
    let b = upright.input_matrix(&dmatrix![1.0; 0.0]).unwrap();
    assert_close("B", b.as_slice(), &[0.0, 0.0, 1.0 / 3.0, -1.0 / 3.0], Tol::ulps(8.0));
    let error = upright.input_matrix(&dmatrix![1.0]).unwrap_err();
    assert!(matches!(error, LagrangianError::WrongLength { quantity: "inputs", expected: 2, found: 1 }), "{error}");
}

#[test]
fn state_without_inertia_is_refused_with_its_direction() {
    // Two pendulums without a mass on the second.
    let massless = standing(Still::Pendulums(vec![1.0, 0.0], vec![1.0, 1.0]));
    let error = massless.linearise(&[0.1, 0.2], &[0.0; 2], 0.0).unwrap_err();
    let LagrangianError::SingularMetric { direction, .. } = &error else { panic!("{error}") };
    assert_close("direction", direction, &[0.0, 1.0], Tol::ulps(4.0));
}
