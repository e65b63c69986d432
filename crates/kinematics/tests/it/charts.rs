//! Eulerian angles in all twelve sequences, and charts that change before they degrade.

use core::cell::Cell;

use nalgebra::{Matrix3, Rotation3, Vector3};
use piola_kinematics::euler_angles::AnglesOfAttitude;
use piola_kinematics::{Attitude, EulerAngles, EulerChart, EulerSequence, KinematicsError};
use piola_numerics::{Dual, Gradient, Jet, Lanes, Real};
use piola_testkit::strategies::{finite, rotation, vector};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;
use proptest::test_runner::TestRunner;

const FEW: Tol = Tol::ulps(64.0);

fn attitude() -> impl Strategy<Value = Attitude<f64>> {
    rotation().prop_map(|q| Attitude::from_quaternion(q).expect("a unit quaternion"))
}

fn triple() -> impl Strategy<Value = [f64; 3]> {
    vector(3, -2.0..2.0).prop_map(|v| [v[0], v[1], v[2]])
}

/// Angles of a sequence in the range that `of_attitude` returns, not too near a gimbal point.
fn angles() -> impl Strategy<Value = EulerAngles<f64>> {
    let sequence = (0_usize..12).prop_map(|i| EulerSequence::ALL[i]);
    (sequence, finite(-3.1..3.1), finite(0.05..3.09), finite(-3.1..3.1)).prop_map(|(sequence, a, b, c)| {
        let middle = if sequence.is_eulerian() { b } else { b - core::f64::consts::FRAC_PI_2 };
        EulerAngles::new(sequence, [a, middle, c])
    })
}

fn about(axis: usize, angle: f64) -> Attitude<f64> {
    [Attitude::about_x, Attitude::about_y, Attitude::about_z][axis](angle)
}

fn close(what: &str, actual: &Vector3<f64>, expected: &Vector3<f64>, scale: f64) {
    assert_close_at_scale(what, actual.as_slice(), expected.as_slice(), scale, FEW);
}

/// The largest component of the rotation that leads from one attitude to the other: their angle, but for a factor
/// of at most √3 and terms of third order.
fn angle_between(a: Attitude<f64>, b: Attitude<f64>) -> f64 {
    2.0 * a.conjugate().product(b).rotation_vector().amax().min(core::f64::consts::PI)
}

proptest! {
    #[test]
    fn attitude_of_any_sequence_equals_product_of_turns_about_its_axes(angles in angles()) {
        let [i, j, k] = angles.sequence.axes();
        let [a, b, c] = angles.theta;
        let expected = about(i, a).product(about(j, b)).product(about(k, c));
        assert_close(&angles.sequence.to_string(), &<[f64; 4]>::from(angles.attitude()), &<[f64; 4]>::from(expected), FEW);
        // Matrices of the turns stand in the reverse order: Q = A₃ A₂ A₁.
        let by_turns = about(k, c).to_matrix() * about(j, b).to_matrix() * about(i, a).to_matrix();
        assert_close("Q", angles.matrix().as_slice(), by_turns.as_slice(), FEW);
    }

    #[test]
    fn yaw_pitch_and_roll_equal_those_of_nalgebra(yaw in finite(-3.1..3.1), pitch in finite(-1.5..1.5), roll in finite(-3.1..3.1)) {
        let expected = Rotation3::from_euler_angles(roll, pitch, yaw);
        let actual = EulerAngles::new(EulerSequence::Zyx, [yaw, pitch, roll]).matrix().transpose();
        assert_close("R", actual.as_slice(), expected.matrix().as_slice(), FEW);
    }

    #[test]
    fn angles_of_the_attitude_of_angles_equal_these_angles(angles in angles()) {
        let found = EulerAngles::of_attitude(angles.sequence, angles.attitude());
        let AnglesOfAttitude::Regular { angles: found, condition_number } = found else {
            panic!("{angles:?} is no gimbal point");
        };
        assert_close("θ", &found.theta, &angles.theta, FEW.times(condition_number));
        assert_close("cond W", &[condition_number], &[angles.condition_number()], FEW.times(condition_number));
    }

    #[test]
    fn attitude_of_the_angles_of_an_attitude_equals_this_attitude(attitude in attitude()) {
        for sequence in EulerSequence::ALL {
            let found = EulerAngles::of_attitude(sequence, attitude).angles();
            // However near a gimbal point: errors of θ¹ and θ³ are such that they cancel in the attitude.
            assert_close_at_scale(&sequence.to_string(), &[angle_between(found.attitude(), attitude)], &[0.0], 1.0, FEW);
        }
    }

    #[test]
    fn condition_number_of_the_best_sequence_stays_below_its_bound(attitude in attitude()) {
        let best = EulerSequence::best(attitude).condition_number(attitude);
        let bound = (3.0_f64.sqrt() + 1.0) / 2.0_f64.sqrt();
        prop_assert!(1.0 <= best && best <= bound, "{best}");
    }

    #[test]
    fn angular_velocity_of_any_sequence_equals_that_of_the_quaternion(angles in angles(), rates in triple(), second in triple()) {
        let jets = core::array::from_fn(|i| Jet::<f64, 0> {
            value: angles.theta[i], partials: [], rate: rates[i], second_rate: second[i]
        });
        let moving = <[Jet<f64, 0>; 4]>::from(EulerAngles::new(angles.sequence, jets).attitude());
        let (rate, second_rate) = (moving.map(|x| x.rate), moving.map(|x| x.second_rate));
        let q = angles.attitude();
        let omega = angles.angular_velocity_in_body(rates);
        close("ω body", &omega, &q.angular_velocity_in_body(rate), 8.0);
        close("W θ̇", &(angles.rate_matrix() * Vector3::from(rates)), &omega, 8.0);
        let in_space = angles.angular_velocity_in_space(rates);
        close("ω space", &in_space, &q.angular_velocity_in_space(rate), 8.0);
        close("W_space θ̇", &(angles.rate_matrix_in_space() * Vector3::from(rates)), &in_space, 8.0);
        let acceleration = angles.angular_acceleration_in_body(rates, second);
        close("ω̇ body", &acceleration, &q.angular_velocity_in_body(second_rate), 40.0);
        close("ω̇ space", &angles.angular_acceleration_in_space(rates, second), &q.to_space(&acceleration), 40.0);
        let found = angles.rates(&omega).expect("no gimbal point");
        let tolerance = FEW.times(found.condition_number);
        assert_close_at_scale("θ̇", &found.rates, &rates, 8.0, tolerance);
        assert_close_at_scale("θ̇ of space", &angles.rates_from_space(&in_space).expect("regular").rates, &rates, 8.0, tolerance);
        let found = angles.second_rates(rates, &acceleration).expect("no gimbal point");
        assert_close_at_scale("θ̈", &found.rates, &second, 40.0, tolerance);
    }

    #[test]
    fn determinant_and_condition_number_equal_those_of_the_rate_matrix(angles in angles()) {
        let w = angles.rate_matrix();
        assert_close_at_scale("det W", &[angles.rate_matrix_determinant()], &[w.determinant()], 1.0, FEW);
        let values = w.singular_values();
        let condition_number = values.max() / values.min();
        assert_close("cond W", &[angles.condition_number()], &[condition_number], FEW.times(condition_number));
    }

    /// W(5.30) for every sequence: ∂W_ij/∂θ^r − ∂W_ir/∂θ^j = −ε_ikl W_kr W_lj.
    #[test]
    fn curl_of_any_rate_matrix_equals_minus_cross_products_of_its_columns(angles in angles()) {
        let seeds = core::array::from_fn(|i| Gradient::<f64, 3>::variable(angles.theta[i], i));
        let w = EulerAngles::new(angles.sequence, seeds).rate_matrix();
        let column = |j: usize| w.column(j).map(|x| x.value);
        for (j, r) in [(0, 1), (0, 2), (1, 2)] {
            let curl: Vector3<f64> = Vector3::from_fn(|i, _| w[(i, j)].partials[r] - w[(i, r)].partials[j]);
            let crossed: Vector3<f64> = -column(r).cross(&column(j));
            close("curl W", &curl, &crossed, 2.0);
        }
    }

    #[test]
    fn rates_by_dual_angles_equal_those_by_the_inverse_matrix(attitude in attitude(), omega in triple()) {
        let omega = Vector3::from(omega);
        let rate = attitude.rate(&omega);
        let [w, x, y, z]: [f64; 4] = attitude.into();
        let moving = Attitude {
            w: Dual::new(w, rate[0]), x: Dual::new(x, rate[1]), y: Dual::new(y, rate[2]), z: Dual::new(z, rate[3])
        };
        let mut compared = 0;
        for sequence in EulerSequence::ALL {
            let AnglesOfAttitude::Regular { angles, condition_number } = EulerAngles::of_attitude(sequence, attitude) else {
                continue;
            };
            compared += 1;
            let by_duals = EulerAngles::away_from_gimbal(sequence, moving).theta.map(|x| x.tangent);
            let found = angles.rates(&omega).expect("regular");
            // Both divide by s₂; its relative error is ε cond W once more.
            let tolerance = FEW.times(condition_number).times(condition_number);
            assert_close_at_scale(&sequence.to_string(), &by_duals, &found.rates, 8.0, tolerance);
        }
        // At no attitude are more than half of the sequences at a gimbal point.
        prop_assert!(6 <= compared, "only {} sequences", compared);
    }

    #[test]
    fn angles_in_lanes_and_in_f32_equal_those_in_f64(angles in angles(), rates in triple()) {
        let sequence = angles.sequence;
        let lanes = EulerAngles::new(sequence, angles.theta.map(|x| Lanes([x, 0.5 * x])));
        let in_lanes = lanes.angular_velocity_in_body(rates.map(Lanes::<f64, 2>::lit));
        let halves = EulerAngles::new(sequence, angles.theta.map(|x| 0.5 * x));
        for (lane, alone) in [angles, halves].iter().enumerate() {
            close("ω", &in_lanes.map(|x| x.primal(lane)), &alone.angular_velocity_in_body(rates), 8.0);
            let back = EulerAngles::away_from_gimbal(sequence, lanes.attitude()).theta.map(|x| x.primal(lane));
            let expected = EulerAngles::away_from_gimbal(sequence, alone.attitude()).theta;
            let condition = alone.condition_number();
            // ±π are one angle.
            let apart = back.iter().zip(expected).map(|(a, b)| (0.5 * (a - b)).sin().abs()).fold(0.0, f64::max);
            assert_close_at_scale("θ", &[apart], &[0.0], 1.0, FEW.times(condition));
        }
        let single = EulerAngles::new(sequence, angles.theta.map(f32::lit)).matrix().map(f64::from);
        assert_close("Q in f32", single.as_slice(), angles.matrix().as_slice(), Tol::ulps32(16.0));
    }
}

#[test]
fn change_of_chart_keeps_attitude_and_angular_velocity() {
    let (changed, kept) = (Cell::new(0), Cell::new(0));
    let outcome = TestRunner::default().run(&(attitude(), triple()), |(attitude, omega)| {
        let omega = Vector3::from(omega);
        for sequence in EulerSequence::ALL {
            let found = EulerAngles::of_attitude(sequence, attitude);
            let AnglesOfAttitude::Regular { angles, condition_number } = found else { continue };
            let rates = angles.rates(&omega).expect("regular").rates;
            let mut chart = EulerChart::new(angles, rates, 2.0).expect("a chart");
            let Some(change) = chart.change_if_degraded().expect("finite") else {
                kept.set(kept.get() + 1);
                prop_assert!(chart.condition_number() <= 2.0);
                continue;
            };
            changed.set(changed.get() + 1);
            prop_assert!(2.0 < change.condition_number_before && change.condition_number_after < 2.0);
            assert_close_at_scale("attitude", &[angle_between(chart.angles.attitude(), attitude)], &[0.0], 1.0, FEW);
            let after = chart.angles.angular_velocity_in_body(chart.rates);
            assert_close_at_scale("ω", after.as_slice(), omega.as_slice(), 4.0, FEW.times(condition_number));
            prop_assert_eq!(chart.change_if_degraded().expect("finite"), None);
        }
        Ok(())
    });
    assert_eq!(outcome, Ok(()));
    assert!(300 < changed.get() && 300 < kept.get(), "{} changed, {} kept", changed.get(), kept.get());
}

#[test]
fn gimbal_points_of_every_sequence_are_reported() {
    use core::f64::consts::{FRAC_PI_2, PI};
    for sequence in EulerSequence::ALL {
        let middles = if sequence.is_eulerian() { [0.0, PI] } else { [FRAC_PI_2, -FRAC_PI_2] };
        for middle in middles {
            let angles = EulerAngles::new(sequence, [0.4, middle, 0.3]);
            let refused = angles.rates(&Vector3::x());
            assert!(matches!(refused, Err(KinematicsError::GimbalPoint { .. })), "{sequence}: {refused:?}");
            let found = EulerAngles::of_attitude(sequence, angles.attitude());
            let (determined, expected) = match found {
                AnglesOfAttitude::Gimbal { sum, .. } => (sum, 0.7),
                AnglesOfAttitude::ReversedGimbal { difference, .. } => (difference, 0.1),
                AnglesOfAttitude::Regular { .. } => panic!("{sequence}: {middle} is a gimbal point"),
            };
            assert_close(&sequence.to_string(), &[determined], &[expected], Tol::ulps(32.0));
            let chosen = found.angles();
            assert_close("θ²", &[chosen.theta[1]], &[middle], Tol::ulps(4.0));
            let between = angle_between(chosen.attitude(), angles.attitude());
            assert_close_at_scale("attitude", &[between], &[0.0], 1.0, Tol::ulps(16.0));
        }
    }
}

/// A torque-free top of revolution with moments (1, 1, 2) that passes through the body axes along the space axes
/// at t = 0, where z–y–z is singular: L/I₁ turns it in space, (I₁ − I₃)/I₁ ω₃ about its own axis.
struct FreeTop {
    omega: Vector3<f64>,
}

impl FreeTop {
    fn angular_velocity(&self, t: f64) -> Vector3<f64> {
        let (s, c) = (self.omega.z * t).sin_cos();
        let (x, y) = (self.omega.x, self.omega.y);
        Vector3::new(c * x - s * y, s * x + c * y, self.omega.z)
    }

    fn attitude(&self, t: f64) -> Attitude<f64> {
        let moment = Vector3::new(self.omega.x, self.omega.y, 2.0 * self.omega.z);
        Attitude::from_rotation_vector(&(moment * t)).product(Attitude::about_z(-self.omega.z * t))
    }
}

/// One step of the midpoint rule in n parts, extrapolated: order 2 × columns.
fn extrapolated_step(f: impl Fn(f64, &Vector3<f64>) -> Vector3<f64>, t: f64, y: &Vector3<f64>, h: f64) -> Vector3<f64> {
    const COLUMNS: usize = 8;
    let parts = |row: usize| 2.0 * (row as f64 + 1.0);
    let mut table = [Vector3::zeros(); COLUMNS];
    for row in 0..COLUMNS {
        let step = h / parts(row);
        // Increments rather than values: extrapolation multiplies their rounding.
        let (mut before, mut now) = (Vector3::zeros(), f(t, y) * step);
        for part in 1..2 * (row + 1) {
            (before, now) = (now, before + f(t + part as f64 * step, &(y + now)) * (2.0 * step));
        }
        // The last stage averaged with an Eulerian step cancels the weak instability.
        let mut refined = (before + now + f(t + h, &(y + now)) * step) * 0.5;
        for (column, entry) in table.iter_mut().take(row).enumerate() {
            let ratio = (parts(row) / parts(row - column - 1)).powi(2);
            let coarser = core::mem::replace(entry, refined);
            refined += (refined - coarser) / (ratio - 1.0);
        }
        table[row] = refined;
    }
    y + table[COLUMNS - 1]
}

#[test]
fn tumbling_motion_by_charts_equals_that_of_the_quaternion() {
    // The first passes exactly through the pole of z–y–z, the second 10⁻⁹ beside it.
    for tilt in [0.0, 1.0e-9] {
        let top = FreeTop { omega: Vector3::new(1.0, 0.5, 0.75) };
        let aside = Attitude::about_y(tilt);
        let start = -4.0;
        let first = EulerAngles::of_attitude(EulerSequence::Zyz, aside.product(top.attitude(start))).angles();
        let rates = first.rates(&top.angular_velocity(start)).expect("regular").rates;
        let mut chart = EulerChart::new(first, rates, 4.0).expect("a chart");
        let (mut changes, mut worst, h) = (0_u32, 0.0_f64, 1.0 / 16.0);
        for step in 0..128_u32 {
            let t = start + f64::from(step) * h;
            let sequence = chart.angles.sequence;
            let field = |t: f64, theta: &Vector3<f64>| {
                let angles = EulerAngles::new(sequence, (*theta).into());
                Vector3::from(angles.rates(&top.angular_velocity(t)).expect("charts stay regular").rates)
            };
            let theta = extrapolated_step(field, t, &Vector3::from(chart.angles.theta), h);
            chart.angles.theta = theta.into();
            chart.rates = field(t + h, &theta).into();
            if let Some(change) = chart.change_if_degraded().expect("finite") {
                assert!(change.condition_number_before < 8.0, "left too late: {change:?}");
                changes += 1;
            }
            assert!(chart.condition_number() <= 4.0);
            let expected = aside.product(top.attitude(t + h));
            worst = worst.max(angle_between(chart.angles.attitude(), expected));
            let omega = chart.angles.angular_velocity_in_body(chart.rates);
            assert_close("ω", omega.as_slice(), top.angular_velocity(t + h).as_slice(), Tol::ulps(64.0));
        }
        assert!(2 <= changes, "{changes} changes");
        // Measured: 2e-14 rad after 128 steps of a few roundings each, some of them passed through cond W = 4.
        assert_close_at_scale("angle", &[worst], &[0.0], 1.0, Tol::ulps(64.0).times(4.0));
    }
}

#[test]
fn bad_thresholds_and_numbers_of_charts_are_refused_by_name() {
    let angles = EulerAngles::zyz([0.1, 0.5, 0.2]);
    for threshold in [1.9, f64::NAN, f64::INFINITY] {
        let refused = EulerChart::new(angles, [0.0; 3], threshold);
        assert!(matches!(refused, Err(KinematicsError::ConditionThreshold { .. })), "{refused:?}");
    }
    let refused = EulerChart::new(angles, [0.0, f64::NAN, 0.0], 4.0);
    assert!(matches!(refused, Err(KinematicsError::NotFinite { quantity: "rates", index: 1, .. })));
    let mut chart = EulerChart::new(angles, [0.0; 3], 4.0).expect("a chart");
    chart.angles.theta[2] = f64::INFINITY;
    assert!(matches!(chart.change_if_degraded(), Err(KinematicsError::NotFinite { quantity: "theta", index: 2, .. })));
    let refused = angles.second_rates([0.0, 0.0, f64::NAN], &Vector3::x());
    assert!(matches!(refused, Err(KinematicsError::NotFinite { quantity: "rates", index: 2, .. })));
}

#[test]
fn charts_stay_where_they_are_between_the_thresholds() {
    // Rocking across the line where z–y–z is left: after the first change there is none.
    let rocking = |t: f64| Attitude::about_y(0.49 + 0.02 * t.sin());
    let start = EulerAngles::of_attitude(EulerSequence::Zyz, rocking(1.0)).angles();
    let mut chart = EulerChart::new(start, [0.0; 3], 4.0).expect("a chart");
    let mut changes = 0;
    for step in 0..1000_i32 {
        let attitude = rocking(1.0 + 0.1 * f64::from(step));
        chart.angles = EulerAngles::of_attitude(chart.angles.sequence, attitude).angles();
        changes += i32::from(chart.change_if_degraded().expect("finite").is_some());
    }
    assert_eq!(changes, 1);
}

#[test]
fn rate_matrix_in_space_equals_that_of_the_body_turned() {
    for sequence in EulerSequence::ALL {
        let angles = EulerAngles::new(sequence, [0.3, 0.7, -1.2]);
        let turned: Matrix3<f64> = angles.matrix().transpose() * angles.rate_matrix();
        assert_close(
            &sequence.to_string(),
            angles.rate_matrix_in_space().as_slice(),
            turned.as_slice(),
            Tol::ulps(8.0),
        );
    }
}

#[test]
fn angles_of_an_attitude_that_is_no_number_are_no_gimbal_point() {
    let broken = Attitude { w: f64::NAN, x: 0.0, y: 0.0, z: 0.0 };
    for sequence in [EulerSequence::Zyz, EulerSequence::Xyz, EulerSequence::Zyx, EulerSequence::Zxz] {
        let found = EulerAngles::of_attitude(sequence, broken);
        let AnglesOfAttitude::Regular { condition_number, .. } = found else { panic!("{found:?}") };
        assert!(condition_number.is_nan());
    }
}
