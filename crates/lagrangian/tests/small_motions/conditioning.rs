//! Accelerations where the metric is ill-conditioned: against closed forms and doubled precision.

use nalgebra::DMatrix;
use piola_lagrangian::LagrangianError;
use piola_lagrangian::{Lagrangian, Workspace};
use piola_numerics::linear::ldlt::{self, Ldlt};
use piola_numerics::{Dual, Lanes, Real};
use piola_testkit::{DoubleDouble, Tol, assert_close, relative_error};

use crate::systems::{Acts, GRAVITY, Linear, Standing, Still, standing};

/// κ of the metric scaled to unit diagonal.
fn condition(lagrangian: &Standing, q: &[f64]) -> f64 {
    let g = lagrangian.inertia_metric(q, 0.0).unwrap();
    let scaled = DMatrix::from_fn(q.len(), q.len(), |i, j| g[(i, j)] / (g[(i, i)] * g[(j, j)]).sqrt());
    // Singular values tell where the factorisation fails already.
    let values = scaled.singular_values();
    values.max() / values.min()
}

/// The accelerations by the metric as it stands, which loses κ ulp.
fn by_metric(lagrangian: &Standing, q: &[f64], v: &[f64]) -> Option<Vec<f64>> {
    let n = q.len();
    let (mut metric, mut force) = (vec![0.0; n * n], vec![0.0; n]);
    lagrangian.equations_into(&mut Workspace::default(), q, v, 0.0, &mut metric, &mut force).unwrap();
    ldlt::factor_in_place(&mut metric, n).ok()?;
    ldlt::solve_in_place(&metric, n, &mut force).unwrap();
    Some(force)
}

/// The metric as it stands loses κ ulp, its rows √κ: a thousandfold gain from 10¹² on.
fn rows_pay(condition: f64, error: f64, error_by_metric: f64) {
    assert!(condition < 1e12 || 1e3 * error <= error_by_metric, "{condition}: {error} {error_by_metric}");
}

fn lifted(x: &[f64]) -> Vec<DoubleDouble> {
    x.iter().map(|&x| DoubleDouble::lit(x)).collect()
}

fn lowered(x: &[DoubleDouble]) -> Vec<f64> {
    x.iter().map(|x| x.primal(0)).collect()
}

/// By how much relative errors of the given numbers are magnified in f, in the largest component: differences
/// over one ulp, in doubled precision.
fn sensitivity(f: impl Fn(&[DoubleDouble]) -> Vec<DoubleDouble>, x: &[f64]) -> f64 {
    let mut x = lifted(x);
    let value = f(&x);
    let size = value.iter().map(|value| value.primal(0).abs()).fold(0.0, f64::max);
    let mut sums = vec![0.0; value.len()];
    let ulp = DoubleDouble::lit(f64::EPSILON);
    for j in 0..x.len() {
        let kept = x[j];
        x[j] = kept + kept * ulp;
        for (sum, (moved, &value)) in sums.iter_mut().zip(f(&x).into_iter().zip(&value)) {
            *sum += ((moved - value) / ulp).primal(0).abs();
        }
        x[j] = kept;
    }
    sums.into_iter().fold(size, f64::max) / size
}

/// The closed form of the double pendulum.
fn double_pendulum(masses: [f64; 2], lengths: [f64; 2], state: &[DoubleDouble]) -> Vec<DoubleDouble> {
    let [m1, m2] = masses.map(DoubleDouble::lit);
    let [l1, l2] = lengths.map(DoubleDouble::lit);
    let g = DoubleDouble::lit(GRAVITY);
    let &[a, b, va, vb] = state else { panic!("four numbers") };
    let (s, c) = (a - b).sin_cos();
    let denominator = m1 + m2 * s * s;
    let first = -(m1 + m2) * g * a.sin() + m2 * g * b.sin() * c - m2 * s * (l2 * vb * vb + l1 * va * va * c);
    let second = (m1 + m2) * (g * a.sin() * c - g * b.sin() + l1 * va * va * s) + m2 * l2 * vb * vb * s * c;
    vec![first / (l1 * denominator), second / (l2 * denominator)]
}

#[test]
fn double_pendulum_of_mass_ratio_1e12_equals_closed_form() {
    for exponent in [-12, -9, -6, 0, 6, 9, 12] {
        let ratio = 10.0_f64.powi(exponent);
        let (masses, lengths) = ([ratio, 1.0], [1.0, 0.75]);
        let pendulum = standing(Still::Pendulums(masses.to_vec(), lengths.to_vec()));
        let (mut worst, mut worst_by_metric, mut largest_condition) = (0.0_f64, 0.0_f64, 0.0_f64);
        for k in 0..200 {
            // Angles between the links from 1 down to 1e-8: the metric is singular when they are in line.
            let apart = 10.0_f64.powf(-8.0 * f64::from(k) / 199.0);
            let q = [0.3 + 0.02 * f64::from(k), 0.3 + 0.02 * f64::from(k) - apart];
            let v = [(f64::from(k) * 0.7).sin(), (f64::from(k) * 1.3).cos()];
            let closed_form = |state: &[DoubleDouble]| double_pendulum(masses, lengths, state);
            let state = [q, v].concat();
            let expected = lowered(&closed_form(&lifted(&state)));
            let found = pendulum.acceleration(&q, &v, 0.0).unwrap();
            let kappa = condition(&pendulum, &q);
            largest_condition = largest_condition.max(kappa);
            let error = relative_error(found.as_slice(), &expected);
            worst = worst.max(error);
            // Below 10⁷ the metric is used, and κ ulp are lost; beyond, no more than an ulp of the angles does.
            let by_angles = sensitivity(closed_form, &state);
            let lost = if kappa < 1e8 { by_angles + kappa } else { by_angles + kappa.sqrt() };
            let allowed = Tol::ulps(8.0).times(lost);
            assert!(error <= allowed.value(), "{exponent}, {apart}: {error} {kappa} {by_angles}");
            let plain = by_metric(&pendulum, &q, &v).map_or(1.0, |plain| relative_error(&plain, &expected));
            worst_by_metric = worst_by_metric.max(plain);
        }
        rows_pay(largest_condition, worst, worst_by_metric);
    }
}

#[test]
fn accelerations_of_nearly_parallel_tangents_equal_rational_closed_form() {
    // One unit mass at (q₁ + q₂, δ q₂): q̈₂ = a_z/δ, q̈₁ = a_x − a_z/δ, exactly.
    for exponent in [3, 7, 10, 13, 17, 20, 23] {
        let delta = 2.0_f64.powi(-exponent);
        let sheared = Lagrangian::of(Still::Sheared(delta))
            .with_uniform_gravity([3.0, 0.0, 5.0])
            .with_potential(Acts::Nothing)
            .with_forces(Linear::default());
        let kappa = condition(&sheared, &[0.0; 2]);
        let found = sheared.acceleration(&[0.25, 0.5], &[1.0, 2.0], 0.0).unwrap();
        let expected = [3.0 - 5.0 / delta, 5.0 / delta];
        assert_close("q̈", found.as_slice(), &expected, Tol::ulps(4.0));
        // An ulp of a force on the coordinates themselves is κ ulp of q̈, whatever the method.
        let pushed = Lagrangian::of(Still::Sheared(delta))
            .with_potential(Acts::Springs(DMatrix::zeros(2, 2), vec![1.0, 1.0 + delta * delta]))
            .with_forces(Linear::default());
        let found = pushed.acceleration(&[0.0; 2], &[0.0; 2], 0.0).unwrap();
        // What is left of 1 + δ² after rounding, over δ².
        let push = ((1.0 + delta * delta) - 1.0) / (delta * delta);
        assert_close("by forces", found.as_slice(), &[1.0 - push, push], Tol::ulps(4.0).times(kappa));
    }
}

#[test]
fn chains_of_wild_masses_equal_doubled_precision() {
    for (n, spread) in [(3, 1e6), (4, 1e12), (6, 1e4), (8, 1e12), (10, 1e8), (12, 1e12)] {
        let masses: Vec<f64> = (0..n).map(|i| if i % 2 == 0 { 1.0 } else { spread }).collect();
        let chain = standing(Still::Pendulums(masses, vec![1.0; n]));
        let (mut worst, mut worst_by_metric, mut largest_condition) = (0.0_f64, 0.0_f64, 0.0_f64);
        for k in 0..40_u32 {
            let apart = 10.0_f64.powf(-7.0 * f64::from(k) / 39.0);
            let q: Vec<f64> = (0..n).map(|i| 0.4 + apart * ((i * i) as f64 + f64::from(k)).sin()).collect();
            let v: Vec<f64> = (0..n).map(|i| ((3 * i) as f64 + f64::from(k)).cos()).collect();
            let exact = |state: &[DoubleDouble]| {
                let (q, v) = state.split_at(n);
                chain.acceleration(q, v, DoubleDouble::lit(0.0)).unwrap().as_slice().to_vec()
            };
            let state = [&q[..], &v].concat();
            let expected = lowered(&exact(&lifted(&state)));
            let kappa = condition(&chain, &q);
            let error =
                chain.acceleration(&q, &v, 0.0).map_or(1.0, |found| relative_error(found.as_slice(), &expected));
            let plain = by_metric(&chain, &q, &v).map_or(1.0, |plain| relative_error(&plain, &expected));
            worst = worst.max(error);
            worst_by_metric = worst_by_metric.max(plain);
            largest_condition = largest_condition.max(kappa);
        }
        rows_pay(largest_condition, worst, worst_by_metric);
    }
}

#[test]
fn ill_conditioned_velocities_return_through_their_momenta() {
    for exponent in [3, 10, 17, 23] {
        let delta = 2.0_f64.powi(-exponent);
        let sheared =
            Lagrangian::of(Still::Sheared(delta)).with_potential(Acts::Nothing).with_forces(Linear::default());
        // p = g v with g = [[1, 1], [1, 1 + δ²]]: exact for v = (1, 2).
        let p = [3.0, 3.0 + 2.0 * delta * delta];
        let kappa = condition(&sheared, &[0.0; 2]);
        let mut v = [0.0; 2];
        sheared.velocities_into(&mut Workspace::default(), &[0.0; 2], &p, 0.0, &mut v).unwrap();
        assert_close("v", &v, &[1.0, 2.0], Tol::ulps(8.0).times(kappa.sqrt()).or(Tol::ulps(2.0 / (delta * delta))));
    }
}

#[test]
fn derivatives_of_ill_conditioned_accelerations_equal_differences() {
    let masses = [1e-12, 1.0];
    let pendulum = standing(Still::Pendulums(masses.to_vec(), vec![1.0, 0.75]));
    let (q, v) = ([0.5, 0.5 - 1e-5], [0.25, -0.5]);
    // The derivative along a turn of both angles, by doubled precision with a small step.
    let moving: Vec<Dual<f64>> = q.iter().map(|&q| Dual::variable(q)).collect();
    let still: Vec<Dual<f64>> = v.iter().map(|&v| Dual::constant(v)).collect();
    let found = pendulum.acceleration(&moving, &still, Dual::constant(0.0)).unwrap();
    let plain = pendulum.acceleration(&q, &v, 0.0).unwrap();
    assert_eq!(found.map(|x| x.value), plain, "the value is that of the plain scalar");
    let step = DoubleDouble::lit(2.0_f64.powi(-30));
    let at = |s: DoubleDouble| {
        let moved: Vec<DoubleDouble> = lifted(&q).into_iter().map(|q| q + s).collect();
        pendulum.acceleration(&moved, &lifted(&v), DoubleDouble::lit(0.0)).unwrap()
    };
    let (ahead, behind) = (at(step), at(-step));
    let expected: Vec<f64> = ahead.iter().zip(&behind).map(|(&a, &b)| ((a - b) / (step + step)).primal(0)).collect();
    let tangent: Vec<f64> = found.iter().map(|x| x.tangent).collect();
    let tolerance = Tol::ulps(64.0).times(condition(&pendulum, &q).sqrt() * 1e5);
    assert_close("∂q̈", &tangent, &expected, tolerance);
}

#[test]
fn ill_conditioned_lane_leaves_the_other_as_it_is() {
    let pendulum = standing(Still::Pendulums(vec![1e-12, 1.0], vec![1.0, 0.75]));
    let states = [([0.5, 0.5 - 1e-5], [0.25, -0.5]), ([0.5, -1.0], [0.25, 0.75])];
    let lanes = |of: &dyn Fn(usize) -> [f64; 2]| [0, 1].map(|i| Lanes([of(0)[i], of(1)[i]]));
    let (q, v) = (lanes(&|lane| states[lane].0), lanes(&|lane| states[lane].1));
    let found = pendulum.acceleration(&q, &v, Lanes::lit(0.0)).unwrap();
    for (lane, (q, v)) in states.iter().enumerate() {
        let closed_form = |state: &[DoubleDouble]| double_pendulum([1e-12, 1.0], [1.0, 0.75], state);
        let state = [*q, *v].concat();
        let found: Vec<f64> = found.iter().map(|a| a.primal(lane)).collect();
        let tolerance = Tol::ulps(16.0).times(sensitivity(closed_form, &state));
        assert_close("q̈", &found, &lowered(&closed_form(&lifted(&state))), tolerance);
    }
}

#[test]
fn coordinates_that_depend_to_rounding_are_refused_with_their_direction() {
    // One coordinate twice.
    for delta in [0.0, 1e-13, 1e-15] {
        let twice = Lagrangian::of(Still::Sheared(delta)).with_potential(Acts::Nothing).with_forces(Linear::default());
        let error = twice.acceleration(&[0.0; 2], &[0.0; 2], 0.0).unwrap_err();
        let LagrangianError::SingularMetric { direction, .. } = &error else { panic!("{error}") };
        let sign = direction[1].signum();
        assert_close("direction", direction, &[-sign, sign], Tol::ulps(4.0));
        let mut velocity = [0.0; 2];
        let refused = twice.velocities_into(&mut Workspace::default(), &[0.0; 2], &[1.0, 1.0], 0.0, &mut velocity);
        assert!(matches!(refused, Err(LagrangianError::SingularMetric { .. })), "{refused:?}");
    }
}

#[test]
fn share_of_a_pivot_bounds_the_condition_number() {
    for exponent in 0..12 {
        let c = 1.0 - 2.0_f64.powi(-2 * exponent - 1);
        let matrix = DMatrix::from_row_slice(2, 2, &[1.0, c, c, 1.0]);
        let kappa = Ldlt::new(&matrix).unwrap().condition_estimate(matrix.as_slice()).unwrap();
        let share = 1.0 - c * c;
        assert!(share.recip() <= kappa && kappa <= 4.0 * share.recip(), "{share} {kappa}");
    }
}
