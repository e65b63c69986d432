//! What rounding leaves of angles near gimbal points and of systems far from the origin, against doubled precision.
//!
//! Each result is compared with the same quantity computed in doubled precision from the same doubles; where that is
//! another formula (the rates: a linear system with W instead of its inverse written out) it is said. To see the
//! figures: `cargo test -p piola-kinematics --test it rounding -- --nocapture`.

use core::f64::consts::{FRAC_PI_2, PI};

use nalgebra::Vector3;
use piola_kinematics::euler_angles::AnglesOfAttitude;
use piola_kinematics::{Attitude, EulerAngles, EulerSequence, ParticleSystem};
use piola_numerics::Real;
use piola_numerics::linear::matrix3;
use piola_testkit::DoubleDouble;

/// Largest error over the largest exact component, in units of 2⁻⁵².
fn ulps(computed: &[f64], exact: &[DoubleDouble]) -> f64 {
    ulps_of(computed, exact, exact.iter().fold(0.0, |size: f64, exact| size.max(exact.primal(0).abs())))
}

/// Largest error over a given size, in units of 2⁻⁵².
fn ulps_of(computed: &[f64], exact: &[DoubleDouble], size: f64) -> f64 {
    computed.iter().zip(exact).map(|(computed, exact)| exact.rounding_of(*computed).abs()).fold(0.0, f64::max)
        / size
        / f64::EPSILON
}

fn doubled(values: [f64; 3]) -> [DoubleDouble; 3] {
    values.map(DoubleDouble::lit)
}

fn doubled_attitude(attitude: Attitude<f64>) -> Attitude<DoubleDouble> {
    Attitude::constant(attitude)
}

/// The middle angle at a distance from either gimbal point of a sequence.
fn near_gimbal(sequence: EulerSequence, distance: f64) -> [f64; 2] {
    if sequence.is_eulerian() { [distance, PI - distance] } else { [FRAC_PI_2 - distance, distance - FRAC_PI_2] }
}

/// Outer angles whose sums do not leave (−π, π], so that no multiple of 2π is added in either precision.
const OUTER: [[f64; 2]; 5] = [[0.4, 1.1], [-0.9, 0.3], [1.3, -0.7], [-1.2, -0.2], [0.01, 0.6]];

const RATES: [f64; 3] = [0.7, -1.1, 0.4];
const OMEGA: Vector3<f64> = Vector3::new(0.3, -0.8, 1.1);

/// The worst error of each column over all sequences, both gimbal points and several outer angles.
fn worst_errors(distance: f64) -> [f64; 6] {
    let mut worst = [0.0_f64; 6];
    for sequence in EulerSequence::ALL {
        for middle in near_gimbal(sequence, distance) {
            for [first, third] in OUTER {
                let theta = [first, middle, third];
                let (angles, exact) = (EulerAngles::new(sequence, theta), EulerAngles::new(sequence, doubled(theta)));
                let attitude = angles.attitude();
                let q = ulps_of(&<[f64; 4]>::from(attitude), &<[DoubleDouble; 4]>::from(exact.attitude()), 1.0);
                let omega = ulps(
                    angles.angular_velocity_in_body(RATES).as_slice(),
                    exact.angular_velocity_in_body(doubled(RATES)).as_slice(),
                );
                let found = angles.rates(&OMEGA).expect("regular");
                let by_elimination = matrix3::solve_rows(matrix3::rows_of(&exact.rate_matrix()), doubled(OMEGA.into()));
                let rates = ulps(&found.rates, &by_elimination);
                // The angles of the rounded attitude, exactly.
                let AnglesOfAttitude::Regular { angles: back, condition_number } =
                    EulerAngles::of_attitude(sequence, attitude)
                else {
                    panic!("{sequence}: {distance} from a gimbal point is regular");
                };
                let of_attitude = EulerAngles::away_from_gimbal(sequence, doubled_attitude(attitude)).theta;
                let inverse = ulps_of(&back.theta, &of_attitude, 1.0);
                // There and back: what the rounding of the attitude does to the angles, over cond W.
                let round_trip = back.theta.iter().zip(theta).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                let round_trip = round_trip / f64::EPSILON / condition_number;
                // To a chart that is regular there, and the rates with it.
                let to = EulerSequence::best(attitude);
                let changed = EulerAngles::of_attitude(to, attitude).angles();
                let carried = changed.rates(&angles.angular_velocity_in_body(RATES)).expect("regular");
                let kept = ulps(
                    changed.angular_velocity_in_body(carried.rates).as_slice(),
                    exact.angular_velocity_in_body(doubled(RATES)).as_slice(),
                );
                for (worst, error) in worst.iter_mut().zip([q, omega, rates, inverse, round_trip, kept]) {
                    *worst = worst.max(if error.is_nan() { f64::INFINITY } else { error });
                }
            }
        }
    }
    worst
}

#[test]
fn rounding_of_angles_near_gimbal_points_stays_within_its_bounds() {
    eprintln!("distance   q  ω=Wθ̇  θ̇=W⁻¹ω  θ of q  θ→q→θ/cond W  ω after change    [ulp]");
    for k in 0..13_i32 {
        let [q, omega, rates, inverse, round_trip, kept] = worst_errors(10.0_f64.powi(-k));
        eprintln!("1e-{k:<2} {q:9.2} {omega:6.2} {rates:7.2} {inverse:7.2} {round_trip:13.2} {kept:15.2}");
        assert!(q <= 2.0, "{k}: attitude {q} ulp");
        assert!(omega <= 2.0, "{k}: angular velocity {omega} ulp");
        // Not multiplied by cond W: sines and cosines are right, however small, and W⁻¹ is written out.
        assert!(rates <= 4.0, "{k}: rates {rates} ulp");
        assert!(inverse <= 2.0, "{k}: angles of an attitude {inverse} ulp");
        assert!(round_trip <= 2.0, "{k}: there and back {round_trip} ulp × cond W");
        assert!(kept <= 4.0, "{k}: angular velocity after a change of chart {kept} ulp");
    }
}

#[test]
fn small_middle_angles_keep_their_own_digits() {
    // θ² itself, not only to the rounding of one: for every sequence, as far as a quaternion holds it.
    let mut worst = 0.0_f64;
    for sequence in EulerSequence::ALL {
        for k in 1..15_i32 {
            let tiny = 10.0_f64.powi(-k);
            // With small outer angles nothing else disturbs those of Tait and Bryan; z–y–z needs none.
            let outer = if sequence.is_eulerian() { [0.4, 1.1] } else { [0.5 * tiny, -0.25 * tiny] };
            let angles = EulerAngles::new(sequence, [outer[0], tiny, outer[1]]);
            let back = EulerAngles::of_attitude(sequence, angles.attitude()).angles();
            worst = worst.max((back.theta[1] / tiny - 1.0).abs() / f64::EPSILON);
        }
    }
    eprintln!("θ² relative to itself: {worst:.2} ulp");
    assert!(worst <= 4.0, "{worst} ulp");
}

/// The parts about the centre of mass of 20 particles at a distance, against doubled precision.
fn split_errors(distance: f64) -> [f64; 4] {
    let count = 20_u32;
    let number = |i: u32, k: u32| (f64::from(i * 7 + k * 3 + 1) * 12.9898).sin();
    let vectors = |offset: Vector3<f64>, seed: u32| -> Vec<Vector3<f64>> {
        (0..count).map(|i| offset + Vector3::new(number(i, seed), number(i, seed + 1), number(i, seed + 2))).collect()
    };
    let positions = vectors(Vector3::new(distance, -0.5 * distance, 0.25 * distance), 0);
    let (velocities, accelerations) = (vectors(Vector3::new(3.0e4, 1.0e4, -2.0e4), 11), vectors(Vector3::zeros(), 23));
    let masses: Vec<f64> = (1..=count).map(|i| f64::from(i) * 1.1).collect();
    let doubled =
        |vectors: &[Vector3<f64>]| -> Vec<_> { vectors.iter().map(|v| v.map(DoubleDouble::lit)).collect::<Vec<_>>() };
    let computed = ParticleSystem::new(&masses, &positions, &velocities).expect("a system");
    let (exact_x, exact_v, exact_a) = (doubled(&positions), doubled(&velocities), doubled(&accelerations));
    let exact = ParticleSystem::new(&masses, &exact_x, &exact_v).expect("a system");
    let origin = Vector3::zeros();
    let exact_origin = origin.map(DoubleDouble::lit);
    let moment = ulps(
        computed.angular_momentum(&origin).relative.as_slice(),
        exact.angular_momentum(&exact_origin).relative.as_slice(),
    );
    let energy = ulps(&[computed.kinetic_energy().relative], &[exact.kinetic_energy().relative]);
    let inertia =
        ulps(computed.inertia_about_centre_of_mass().as_slice(), exact.inertia_about_centre_of_mass().as_slice());
    let rates = ulps(
        computed.rates(&accelerations, &origin).expect("rates").angular_momentum.relative.as_slice(),
        exact.rates(&exact_a, &exact_origin).expect("rates").angular_momentum.relative.as_slice(),
    );
    [moment, energy, inertia, rates]
}

#[test]
fn rounding_of_koenig_splits_far_from_the_origin_stays_within_its_bounds() {
    eprintln!("distance     H      E      I  dH/dt    [ulp, each relative to its part about the centre of mass]");
    for exponent in [0, 3, 6, 9, 12] {
        let errors = split_errors(10.0_f64.powi(exponent));
        eprintln!("1e{exponent:<2} m  {:6.2} {:6.2} {:6.2} {:6.2}", errors[0], errors[1], errors[2], errors[3]);
        for error in errors {
            assert!(error <= 2.0, "1e{exponent} m: {errors:?} ulp");
        }
    }
}
