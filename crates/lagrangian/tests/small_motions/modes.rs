//! Frequencies and shapes against closed forms, and the laws they obey.

use core::f64::consts::PI;

use nalgebra::{Complex, DMatrix, DVector, dmatrix};
use piola_lagrangian::LagrangianError;
use piola_lagrangian::small_motions::{Linearisation, ModeMotion};
use piola_testkit::strategies::finite;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use crate::systems::{GRAVITY, Linear, Still, TOP, linear, row_of_springs, sprung, standing};

#[test]
fn double_pendulum_frequencies_equal_closed_form() {
    let length = 0.5;
    let equal = standing(Still::Pendulums(vec![3.0; 2], vec![length; 2])).equilibrium(&[0.1, 0.1], 0.0).unwrap();
    let modes = equal.linearisation.normal_modes().unwrap();
    let expected = [2.0 - 2.0_f64.sqrt(), 2.0 + 2.0_f64.sqrt()].map(|factor| GRAVITY / length * factor);
    assert_close("ω²", modes.squares.as_slice(), &expected, Tol::ulps(16.0));
    // θ₂ = ±√2 θ₁, of unit length in M.
    for (mode, sign) in [(0, 1.0), (1, -1.0)] {
        let ratio = modes.shapes[(1, mode)] / modes.shapes[(0, mode)];
        assert_close("shape", &[ratio], &[sign * 2.0_f64.sqrt()], Tol::ulps(32.0));
    }
}

#[test]
fn row_of_masses_frequencies_equal_twice_root_k_over_m_times_sines() {
    let (k, m) = (48.0, 3.0);
    for n in [1, 2, 5, 20] {
        let held = sprung(vec![m; n], row_of_springs(n, k, 2), Linear::default());
        let modes = held.linearise(&vec![0.0; n], &vec![0.0; n], 0.0).unwrap().normal_modes().unwrap();
        let angle = |mode: usize| PI * (mode + 1) as f64 / (2 * (n + 1)) as f64;
        let expected: Vec<f64> = (0..n).map(|mode| 2.0 * (k / m).sqrt() * angle(mode).sin()).collect();
        assert_close("ω", &modes.angular_frequencies(), &expected, Tol::ulps(16.0));
        for (mode, &frequency) in expected.iter().enumerate() {
            // φ_i = √(2/(m(n+1))) sin(2 angle (i+1)), the largest component positive.
            let shape: Vec<f64> = (0..n).map(|i| (2.0 * angle(mode) * (i + 1) as f64).sin()).collect();
            let sign = (shape[0] * modes.shapes[(0, mode)]).signum();
            let size = sign * (2.0 / (m * (n + 1) as f64)).sqrt();
            let shape: Vec<f64> = shape.iter().map(|x| size * x).collect();
            assert_close("φ", modes.shapes.column(mode).as_slice(), &shape, Tol::ulps(64.0).times((n * n) as f64));
            let (square, uncertainty) = (modes.squares[mode], modes.uncertainties[mode]);
            assert!((square - frequency * frequency).abs() <= uncertainty, "{mode} of {n}");
        }
    }
}

#[test]
fn free_row_of_masses_drifts_in_one_mode() {
    let (n, k, m) = (9, 2.0, 0.5);
    let free = sprung(vec![m; n], row_of_springs(n, k, 0), Linear::default());
    let linearisation = free.linearise(&vec![0.0; n], &vec![0.0; n], 0.0).unwrap();
    let modes = linearisation.normal_modes().unwrap();
    assert_eq!(modes.motion(0), Some(ModeMotion::Drift));
    let size = 1.0 / (m * n as f64).sqrt();
    assert_close("φ", modes.shapes.column(0).as_slice(), &vec![size; n], Tol::ulps(64.0));
    let expected: Vec<f64> =
        (1..n).map(|mode| 2.0 * (k / m).sqrt() * (PI * mode as f64 / (2 * n) as f64).sin()).collect();
    assert_close("ω", &modes.angular_frequencies(), &expected, Tol::ulps(32.0));
}

#[test]
fn proportional_damping_ratios_equal_closed_form() {
    // C = a M + b K: 2 ζ ω = a + b ω².
    let (n, k, m, a, b) = (6, 40.0, 2.0, 0.25, 0.05);
    let stiffness = row_of_springs(n, k, 2);
    let damping = DMatrix::identity(n, n) * (a * m) + &stiffness * b;
    let forces = Linear { velocity: Some(damping), position: None };
    let damped = sprung(vec![m; n], stiffness, forces).linearise(&vec![0.0; n], &vec![0.0; n], 0.0).unwrap();
    let found = damped.complex_modes().unwrap();
    let mut expected: Vec<[f64; 2]> = damped
        .normal_modes()
        .unwrap()
        .squares
        .iter()
        .map(|square| {
            let decay = 0.5 * (a + b * square);
            [-decay, (square - decay * decay).sqrt()]
        })
        .collect();
    expected.sort_by(|a, b| a[1].total_cmp(&b[1]));
    assert_eq!(found.modes.len(), n, "all oscillate");
    for (mode, expected) in found.modes.iter().zip(&expected) {
        assert_close("λ", &[mode.eigenvalue.re, mode.eigenvalue.im], expected, Tol::ulps(64.0));
        let ratio = -expected[0] / expected[0].hypot(expected[1]);
        assert_close("ζ", &[mode.damping_ratio()], &[ratio], Tol::ulps(64.0));
        // A bound by the norm of the whole matrix, beside the smallest eigenvalue.
        assert!(mode.uncertainty < 1e-10 * mode.eigenvalue.norm());
    }
}

#[test]
fn overdamped_oscillator_has_two_real_frequencies() {
    // λ² + 10 λ + 9 = (λ + 1)(λ + 9); then a spread of 1e12 between the two.
    for (damping, stiffness, slow, fast) in [(10.0, 9.0, -1.0, -9.0), (1e6 + 1e-6, 1.0, -1e-6, -1e6)] {
        let oscillator = linear(dmatrix![1.0], &dmatrix![damping], &dmatrix![stiffness]);
        let modes = oscillator.complex_modes().unwrap().modes;
        let found: Vec<f64> = modes.iter().map(|mode| mode.eigenvalue.re).collect();
        assert_close("fast", &found[..1], &[fast], Tol::ulps(8.0));
        assert_close("slow", &found[1..], &[slow], Tol::ulps(64.0));
        assert!(modes.iter().all(|mode| mode.eigenvalue.im == 0.0 && 0.999_999 < mode.damping_ratio()));
    }
}

#[test]
fn critically_damped_oscillator_knows_its_frequency_to_the_root_of_rounding() {
    let modes = linear(dmatrix![1.0], &dmatrix![6.0], &dmatrix![9.0]).complex_modes().unwrap().modes;
    for mode in &modes {
        let error = (mode.eigenvalue - Complex::new(-3.0, 0.0)).norm();
        // √ε times the size of λ, with room for the constant of the bound.
        assert!(error <= mode.uncertainty && mode.uncertainty < 1e-6, "{mode:?}");
    }
}

#[test]
fn equal_oscillators_keep_independent_shapes() {
    // Three equal oscillators turned into each other by a change of coordinates.
    let turn = dmatrix![1.0, 0.25, 0.0; 0.5, 1.0, 0.125; 0.0, 0.75, 1.0];
    let mass = &turn.transpose() * &turn;
    let (stiffness, damping) = (&mass * 4.0, &mass * 0.5);
    let modes = linear(mass.clone(), &damping, &stiffness).complex_modes().unwrap().modes;
    assert_eq!(modes.len(), 3);
    let shapes = DMatrix::from_fn(3, 3, |i, k| modes[k].shape[i]);
    let gram = shapes.adjoint() * mass.map(Complex::from) * &shapes;
    assert!(0.1 < gram.determinant().norm(), "{gram}");
    let expected = [-0.25, (4.0_f64 - 0.0625).sqrt()];
    for mode in &modes {
        assert_close("λ", &[mode.eigenvalue.re, mode.eigenvalue.im], &expected, Tol::ulps(64.0).times(16.0));
        // Equal eigenvalues with independent shapes are as well known as single ones.
        assert!(mode.uncertainty < 1e-12, "{}", mode.uncertainty);
    }
}

#[test]
fn sleeping_top_frequencies_equal_closed_form() {
    let [transverse, axial, mass, height] = TOP;
    let overturning = mass * GRAVITY * height;
    let threshold = 2.0 * (transverse * overturning).sqrt() / axial;
    let spin = 1.25 * threshold;
    let top = standing(Still::top()).linearise(&[0.0; 3], &[0.0, 0.0, spin], 0.0).unwrap();
    let modes = top.complex_modes().unwrap().modes;
    // A Ω² − C ω Ω + m g h = 0, and the spin itself, which drifts.
    let root = (axial * axial * spin * spin - 4.0 * transverse * overturning).sqrt();
    let [slow, fast] = [-root, root].map(|root| (axial * spin + root) / (2.0 * transverse));
    let found: Vec<f64> = modes.iter().map(|mode| mode.eigenvalue.im).collect();
    assert_close("Ω", &found[found.len() - 2..], &[slow, fast], Tol::ulps(64.0));
    for mode in &modes {
        assert!(mode.eigenvalue.re.abs() <= mode.uncertainty, "{mode:?}");
    }
    // Precession is round: the two tilts a quarter of a turn apart.
    let slow = &modes[modes.len() - 2].shape;
    assert_close("round", &[slow[0].norm(), (slow[0] * slow[1].conj()).re], &[slow[1].norm(), 0.0], Tol::ulps(64.0));
}

#[test]
fn units_of_coordinates_do_not_matter() {
    let mass = dmatrix![2.0, 0.5; 0.5, 1.0];
    let stiffness = dmatrix![8.0, -3.0; -3.0, 5.0];
    let damping = dmatrix![0.5, 0.125; 0.25, 0.75];
    let units = dmatrix![1e-9, 0.0; 0.0, 1e7];
    let scaled = |a: &DMatrix<f64>| &units * a * &units;
    let plain = linear(mass.clone(), &damping, &stiffness);
    let other = linear(scaled(&mass), &scaled(&damping), &scaled(&stiffness));
    let squares = |system: &Linearisation| system.normal_modes().unwrap().squares;
    assert_close("ω²", squares(&other).as_slice(), squares(&plain).as_slice(), Tol::ulps(32.0));
    let lambdas = |system: &Linearisation| -> Vec<f64> {
        system.complex_modes().unwrap().modes.iter().flat_map(|m| [m.eigenvalue.re, m.eigenvalue.im]).collect()
    };
    assert_close("λ", &lambdas(&other), &lambdas(&plain), Tol::ulps(64.0));
}

#[test]
fn stiff_and_soft_modes_keep_their_digits() {
    // ω² of 1 beside 1e12, coupled through the mass: uncertainties tell the truth.
    for ratio in [1e4, 1e8, 1e12] {
        // K = R diag(1, ratio) Rᵀ with R = [[0.6, −0.8], [0.8, 0.6]] and M = 1.
        let (a, b) = (0.36 + 0.64 * ratio, 0.64 + 0.36 * ratio);
        let off = 0.48 * (1.0 - ratio);
        let modes =
            linear(DMatrix::identity(2, 2), &DMatrix::zeros(2, 2), &dmatrix![a, off; off, b]).normal_modes().unwrap();
        // The given entries are rounded: their determinant, in exact products, is what the small root knows.
        let determinant = piola_numerics::sums::compensated_dot(&[a, -off], &[b, off]).unwrap();
        let exact = (0..8).fold(0.0, |small, _| determinant / ((a + b) - small));
        assert_close("large", &[modes.squares[1]], &[ratio], Tol::ulps(8.0));
        let error = (modes.squares[0] - exact).abs();
        assert!(error <= modes.uncertainties[0], "{ratio}: {error}");
    }
}

#[test]
fn matrix_without_inertia_or_number_is_refused() {
    let none = linear(dmatrix![1.0, 1.0; 1.0, 1.0], &DMatrix::zeros(2, 2), &DMatrix::identity(2, 2));
    for error in [none.normal_modes().unwrap_err(), none.complex_modes().unwrap_err(), none.state_matrix().unwrap_err()]
    {
        let LagrangianError::SingularMetric { coordinate, direction, .. } = &error else { panic!("{error}") };
        assert_eq!(*coordinate, 1);
        assert_close("direction", direction, &[-1.0, 1.0], Tol::ulps(2.0));
    }
    let strange = linear(DMatrix::identity(1, 1), &DMatrix::zeros(1, 1), &dmatrix![f64::NAN]);
    assert!(matches!(strange.normal_modes(), Err(LagrangianError::NotFinite { quantity: "stiffness", .. })));
    assert!(matches!(strange.complex_modes(), Err(LagrangianError::NotFinite { .. })));
    assert!(matches!(strange.state_matrix(), Err(LagrangianError::NotFinite { quantity: "stiffness", .. })));
    assert!(matches!(strange.input_matrix(&dmatrix![1.0]), Err(LagrangianError::NotFinite { .. })));
    let whole = linear(DMatrix::identity(1, 1), &DMatrix::zeros(1, 1), &DMatrix::identity(1, 1));
    let found = whole.input_matrix(&dmatrix![f64::NAN]).unwrap_err();
    assert!(matches!(found, LagrangianError::NotFinite { quantity: "inputs", .. }), "{found}");
    let negative = linear(dmatrix![1.0, 0.0; 0.0, -2.0], &DMatrix::zeros(2, 2), &DMatrix::identity(2, 2));
    let found = negative.normal_modes().unwrap_err();
    let direction = vec![0.0, 1.0];
    assert_eq!(found, LagrangianError::SingularMetric { coordinate: 1, pivot: -2.0, diagonal: -2.0, direction });
}

#[test]
fn matrices_of_different_orders_are_refused_by_name() {
    let fits = linear(DMatrix::identity(2, 2), &DMatrix::zeros(2, 2), &DMatrix::identity(2, 2));
    let wrong = |quantity, expected, found| LagrangianError::WrongLength { quantity, expected, found };
    for (strange, refusal) in [
        (Linearisation { stiffness: DMatrix::zeros(1, 1), ..fits.clone() }, wrong("stiffness", 2, 1)),
        (Linearisation { damping: DMatrix::zeros(2, 3), ..fits.clone() }, wrong("damping", 2, 3)),
        (Linearisation { mass_matrix: DMatrix::zeros(2, 3), ..fits.clone() }, wrong("mass matrix", 2, 3)),
        (Linearisation { acceleration: DVector::zeros(0), ..fits }, wrong("acceleration", 2, 0)),
    ] {
        assert_eq!(strange.normal_modes().unwrap_err(), refusal);
        assert_eq!(strange.complex_modes().unwrap_err(), refusal);
        assert_eq!(strange.stability().unwrap_err(), refusal);
        assert_eq!(strange.state_matrix().unwrap_err(), refusal);
        assert_eq!(strange.input_matrix(&DMatrix::zeros(2, 1)).unwrap_err(), refusal);
    }
}

#[test]
fn modes_of_nothing_are_none() {
    let nothing = linear(DMatrix::zeros(0, 0), &DMatrix::zeros(0, 0), &DMatrix::zeros(0, 0));
    assert_eq!(nothing.normal_modes().unwrap().squares.len(), 0);
    assert_eq!(nothing.complex_modes().unwrap().modes.len(), 0);
    assert_eq!(nothing.state_matrix().unwrap().len(), 0);
}

/// Random matrices of order n: a positive definite M of moderate condition, and any D and K.
fn system(n: usize) -> impl Strategy<Value = [DMatrix<f64>; 3]> {
    let entries = || proptest::collection::vec(finite(-1.0..1.0), n * n);
    (entries(), entries(), entries()).prop_map(move |(a, d, k)| {
        let a = DMatrix::from_vec(n, n, a);
        let mass = &a * a.transpose() + DMatrix::identity(n, n);
        [mass, DMatrix::from_vec(n, n, d), DMatrix::from_vec(n, n, k)]
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn normal_modes_diagonalise_mass_and_stiffness([mass, _, k] in (1_usize..9).prop_flat_map(system)) {
        let n = mass.nrows();
        let stiffness = &k + k.transpose();
        let modes = linear(mass.clone(), &DMatrix::zeros(n, n), &stiffness).normal_modes().unwrap();
        let tolerance = Tol::ulps(64.0).times(n as f64 * mass.norm());
        let unit = modes.shapes.transpose() * &mass * &modes.shapes;
        assert_close_at_scale("φᵀMφ", unit.as_slice(), DMatrix::<f64>::identity(n, n).as_slice(), 1.0, tolerance);
        let diagonal = modes.shapes.transpose() * &stiffness * &modes.shapes;
        let expected = DMatrix::from_diagonal(&modes.squares);
        assert_close_at_scale("φᵀKφ", diagonal.as_slice(), expected.as_slice(), stiffness.norm(), tolerance);
        prop_assert!(modes.squares.as_slice().is_sorted());
    }

    #[test]
    fn complex_modes_solve_the_pencil_and_sum_to_the_trace([mass, d, k] in (1_usize..7).prop_flat_map(system)) {
        let n = mass.nrows();
        let linearisation = linear(mass.clone(), &d, &k);
        let modes = linearisation.complex_modes().unwrap().modes;
        let complex = |a: &DMatrix<f64>| a.map(Complex::from);
        let mut sum = 0.0;
        let mut count = 0;
        for mode in &modes {
            let lambda = mode.eigenvalue;
            let pencil = complex(&mass) * (lambda * lambda) + complex(&d) * lambda + complex(&k);
            let size = mass.norm() * lambda.norm_sqr() + d.norm() * lambda.norm() + k.norm();
            let remainder: DVector<Complex<f64>> = pencil * &mode.shape;
            let tolerance = Tol::ulps(256.0).times(n as f64 * mass.norm());
            prop_assert!(remainder.norm() <= tolerance.value() * size * mode.shape.norm(), "{}", remainder.norm());
            let twice = lambda.im != 0.0;
            sum += if twice { 2.0 * lambda.re } else { lambda.re };
            count += if twice { 2 } else { 1 };
        }
        prop_assert_eq!(count, 2 * n);
        let trace = linearisation.state_matrix().unwrap().trace();
        let largest = modes.iter().map(|mode| mode.eigenvalue.norm()).fold(1.0, f64::max);
        let merging = modes.iter().map(|mode| mode.uncertainty).sum::<f64>();
        let tolerance = Tol::ulps(256.0).times((n * n) as f64 * largest).value() + merging;
        prop_assert!((sum - trace).abs() <= tolerance, "{} {}", sum, trace);
    }

    #[test]
    fn complex_modes_without_damping_equal_normal_modes([mass, _, k] in (1_usize..7).prop_flat_map(system)) {
        let n = mass.nrows();
        let stiffness = &k * k.transpose() + DMatrix::identity(n, n) * 0.5;
        let linearisation = linear(mass, &DMatrix::zeros(n, n), &stiffness);
        let expected = linearisation.normal_modes().unwrap().angular_frequencies();
        let found: Vec<f64> = linearisation.complex_modes().unwrap().modes.iter().map(|m| m.eigenvalue.im).collect();
        let condition = stiffness.norm() * linearisation.mass_matrix.norm();
        assert_close("ω", &found, &expected, Tol::ulps(64.0).times(condition));
    }
}
