//! Sampled motions: exact for polynomials, of the stated order for the rest, and what samples are refused.

use nalgebra::Vector3;
use piola_fields::FieldsError;
use piola_fields::{Interpolation, Inversion, Motion, MotionSamples, SampledMotion, SampledTrajectories};
use piola_numerics::{Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, assert_order};
use proptest::prelude::*;

use super::fixtures::{Wave, point};

/// Every node and time of a grid with the value of a function there.
fn samples(
    nodes: [Vec<f64>; 3],
    times: Vec<f64>,
    interpolation: Interpolation,
    u: impl Fn(&Vector3<f64>, f64) -> Vector3<f64>,
) -> MotionSamples {
    let mut displacements = Vec::new();
    for &t in &times {
        for &x in &nodes[0] {
            for &y in &nodes[1] {
                displacements.extend(nodes[2].iter().map(|&z| <[f64; 3]>::from(u(&Vector3::new(x, y, z), t))));
            }
        }
    }
    MotionSamples { nodes, times, displacements, interpolation }
}

/// n + 1 nodes on [−1, 1], unevenly spaced.
fn uneven(n: usize) -> Vec<f64> {
    let even = |i: usize| 2.0 * i as f64 / n as f64 - 1.0;
    (0..=n).map(|i| even(i) + 0.2 * (1.0 - even(i) * even(i)) / n as f64).collect()
}

/// A polynomial of degree d in each variable: u₁ = A (x + 2y)^d z t^d and so on, with |∇u| < 0.3.
#[derive(Clone, Copy)]
struct Polynomial(i32);

impl Motion for Polynomial {
    fn place<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        reference + self.displacement(reference, time)
    }
    fn displacement<T: Real>(&self, reference: &Vector3<T>, time: T) -> Vector3<T> {
        let [x, y, z] = (*reference).into();
        let power = |x: T| (0..self.0).fold(T::one(), |power, _| power * x);
        let (two, size) =
            (T::lit(2.0), T::lit(0.1 / f64::from(self.0 * 3_i32.pow(self.0.unsigned_abs()))) * power(time));
        Vector3::new(power(x + two * y) * z, power(y - z) * x, power(z) * power(x)) * size
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn splines_through_a_polynomial_equal_it(x in point(), t in -1.0..1.0_f64, which in 0..3_usize) {
        // The grids are made once for all cases.
        use std::sync::OnceLock;
        static MOTIONS: [OnceLock<SampledMotion>; 3] = [const { OnceLock::new() }; 3];
        let (interpolation, degree) =
            [(Interpolation::Linear, 1), (Interpolation::Cubic, 3), (Interpolation::Quintic, 5)][which];
        let exact = Polynomial(degree);
        let motion = MOTIONS[which].get_or_init(|| {
            let axes = [uneven(6), uneven(7), uneven(8)];
            let samples = samples(axes, uneven(6), interpolation, |x, t| exact.displacement(x, t));
            SampledMotion::new(samples).expect("samples")
        });
        // Displacements reach 0.1, and derivatives magnify their rounding by degree/h = 20.
        let (tol, scale) = (Tol::ulps(32.0), 0.1);
        let close = |what: &str, actual: &[f64], expected: &[f64], slope: f64| {
            assert_close_at_scale(what, actual, expected, scale * slope, tol);
        };
        close("u", motion.displacement(&x, t).as_slice(), exact.displacement(&x, t).as_slice(), 1.0);
        close("v", motion.velocity(&x, t)?.as_slice(), exact.velocity(&x, t)?.as_slice(), 20.0);
        close("a", motion.acceleration(&x, t)?.as_slice(), exact.acceleration(&x, t)?.as_slice(), 400.0);
        let (h, expected) = (motion.displacement_gradient(&x, t)?, exact.displacement_gradient(&x, t)?);
        close("∇u", h.matrix().as_slice(), expected.matrix().as_slice(), 20.0);
        let lanes = motion.displacement(&x.map(|x| Lanes::<f64, 2>::from([x, -x])), Lanes::from([t, -t]));
        let other = motion.displacement(&-x, -t);
        close("lane 0", lanes.map(|u| u.primal(0)).as_slice(), motion.displacement(&x, t).as_slice(), 1.0);
        close("lane 1", lanes.map(|u| u.primal(1)).as_slice(), other.as_slice(), 1.0);
    }

    #[test]
    fn particle_of_a_sampled_motion_is_found_at_its_place(x in point(), t in -1.0..1.0_f64) {
        use std::sync::OnceLock;
        static MOTION: OnceLock<SampledMotion> = OnceLock::new();
        let motion = MOTION.get_or_init(|| sampled_wave(Interpolation::Cubic, 8));
        let place = motion.position(&x, t)?;
        let found = Inversion::default().preimage_near(motion, &place, t, &(x * 0.9))?;
        prop_assert!((found.reference - x).amax() <= found.error_bound && found.error_bound < 1e-13, "{found:?}");
    }
}

const WAVE: Wave = Wave { amplitude: 0.1, phase: [0.3, 1.1, -0.7], frequency: 1.0 };

fn sampled_wave(interpolation: Interpolation, n: usize) -> SampledMotion {
    let axes = [uneven(n), uneven(n), uneven(n)];
    SampledMotion::new(samples(axes, uneven(n), interpolation, |x, t| WAVE.displacement(x, t))).expect("samples")
}

#[test]
fn errors_of_sampled_motions_fall_at_the_stated_orders() {
    for (interpolation, order) in
        [(Interpolation::Linear, 2.0), (Interpolation::Cubic, 4.0), (Interpolation::Quintic, 6.0)]
    {
        let mut errors = [[0.0_f64; 4]; 3];
        let intervals = [6, 9, 13];
        for (errors, n) in errors.iter_mut().zip(intervals) {
            let motion = sampled_wave(interpolation, n);
            for i in 0..200_u32 {
                // A low-discrepancy sequence over the grid.
                let at = |ratio: f64| 1.96 * (f64::from(i) * ratio).fract() - 0.98;
                let (x, t) = (Vector3::new(at(0.819_172_5), at(0.671_043_6), at(0.549_700_5)), at(0.450_299_5));
                let ((u, h), (v, _), (a, _)) = (WAVE.by_hand(&x, t, 0), WAVE.by_hand(&x, t, 1), WAVE.by_hand(&x, t, 2));
                let gradient = motion.displacement_gradient(&x, t).expect("∇u");
                let differences = [
                    (motion.displacement(&x, t) - u).amax(),
                    (motion.velocity(&x, t).expect("v") - v).amax(),
                    (gradient.matrix() - h).amax(),
                    (motion.acceleration(&x, t).expect("a") - a).amax(),
                ];
                for (error, difference) in errors.iter_mut().zip(differences) {
                    *error = error.max(difference);
                }
            }
        }
        let steps = intervals.map(|n| 2.0 / n as f64);
        let of = |quantity: usize| errors.map(|errors| errors[quantity]);
        assert_order("u", &steps, &of(0), order, 0.7);
        assert_order("v", &steps, &of(1), order - 1.0, 0.7);
        assert_order("∇u", &steps, &of(2), order - 1.0, 0.7);
        if interpolation != Interpolation::Linear {
            assert_order("a", &steps, &of(3), order - 2.0, 0.7);
        }
    }
}

#[test]
fn places_and_displacements_give_the_same_motion() {
    let exact = Polynomial(3);
    let axes = || [uneven(4), uneven(5), uneven(3)];
    let given = samples(axes(), uneven(4), Interpolation::Cubic, |x, t| exact.place(x, t));
    let motion = SampledMotion::from_places(axes(), uneven(4), &given.displacements, Interpolation::Cubic);
    let motion = motion.expect("places");
    let x = Vector3::new(0.3, -0.4, 0.9);
    assert_close("x", motion.place(&x, 0.7).as_slice(), exact.place(&x, 0.7).as_slice(), Tol::ulps(16.0));
    // At the nodes, exactly the samples; at the last corner and time too.
    let corner = Vector3::new(1.0, 1.0, 1.0);
    assert_close("x", motion.place(&corner, 1.0).as_slice(), exact.place(&corner, 1.0).as_slice(), Tol::ulps(8.0));
}

#[test]
fn tiny_strains_of_samples_keep_their_digits() {
    let u = |x: &Vector3<f64>, _: f64| x * 1e-18;
    let motion = SampledMotion::new(samples([uneven(4), uneven(4), uneven(4)], vec![0.0], Interpolation::Cubic, u));
    let gradient = motion.expect("samples").displacement_gradient(&Vector3::repeat(0.3), 5.0).expect("∇u");
    assert_close("∇u", &[gradient.matrix()[(1, 1)]], &[1e-18], Tol::ulps(32.0));
}

#[test]
fn trajectories_equal_the_motion_of_their_particles() {
    let times = uneven(9);
    let tol = Tol::ulps(512.0);
    let particles = [Vector3::new(0.1, 0.2, 0.3), Vector3::new(-0.4, 0.5, 0.9)];
    let exact = Polynomial(5);
    let places = particles.map(|x| times.iter().map(|&t| exact.place(&x, t).into()).collect::<Vec<[f64; 3]>>());
    let sampled = SampledTrajectories::new(&times, &[&places[0], &places[1]], Interpolation::Quintic).expect("places");
    assert_eq!(sampled.particles(), 2);
    for (i, x) in particles.iter().enumerate() {
        for t in [-1.0, -0.3, 0.05, 0.77, 1.0] {
            let expected = exact.position(x, t).expect("x");
            assert_close("x", sampled.position(i, t).expect("x").as_slice(), expected.as_slice(), tol);
            let expected = exact.velocity(x, t).expect("v");
            assert_close_at_scale("v", sampled.velocity(i, t).expect("v").as_slice(), expected.as_slice(), 10.0, tol);
            let expected = exact.acceleration(x, t).expect("a");
            let actual = sampled.acceleration(i, t).expect("a");
            assert_close_at_scale("a", actual.as_slice(), expected.as_slice(), 100.0, tol);
        }
    }
    let lanes = sampled.position(1, Lanes::<f64, 4>::from([-1.0, -0.1, 0.4, 1.0])).expect("lanes");
    let last = sampled.position(1, 1.0).expect("x");
    assert_close("lane", lanes.map(|x| x.primal(3)).as_slice(), last.as_slice(), tol);
}

#[test]
fn samples_that_make_no_motion_are_refused_by_name() {
    let good = || samples([uneven(3), uneven(4), uneven(3)], uneven(3), Interpolation::Cubic, |x, t| x * (0.1 * t));
    assert!(SampledMotion::new(good()).is_ok());

    let mut unsorted = good();
    unsorted.nodes[1].swap(1, 2);
    assert!(matches!(
        SampledMotion::new(unsorted),
        Err(FieldsError::NotIncreasing { quantity: "nodes along X2", index: 2, .. })
    ));
    let mut repeated = good();
    repeated.times[1] = repeated.times[0];
    assert!(matches!(
        SampledMotion::new(repeated),
        Err(FieldsError::NotIncreasing { quantity: "times", index: 1, .. })
    ));
    let mut infinite = good();
    infinite.displacements[7][2] = f64::INFINITY;
    assert!(matches!(
        SampledMotion::new(infinite),
        Err(FieldsError::NotFinite { quantity: "displacements", index: 23, .. })
    ));
    let mut short = good();
    short.displacements.pop();
    let expected = 4 * 4 * 5 * 4;
    assert!(matches!(
        SampledMotion::new(short),
        Err(FieldsError::WrongLength { found, expected: e, .. }) if e == expected && found == e - 1
    ));
    let mut empty = good();
    empty.nodes[0].clear();
    assert!(matches!(SampledMotion::new(empty), Err(FieldsError::WrongLength { quantity: "nodes along X1", .. })));

    // Node (2, 1, 1) at the last time is pushed past its neighbour (3, 1, 1).
    let mut folded = good();
    let index = ((3 * 4 + 2) * 5 + 1) * 4 + 1;
    folded.displacements[index][0] += 3.0;
    let Err(FieldsError::FoldedCell { cell, time, determinant }) = SampledMotion::new(folded) else {
        panic!("a folded cell was accepted");
    };
    assert!(cell == [2, 0, 0] && time == 3 && determinant < 0.0, "{cell:?} {time} {determinant}");

    let motion = SampledMotion::new(good()).expect("samples");
    assert!(matches!(
        motion.position(&Vector3::new(0.0, 0.0, 1.5), 0.0),
        Err(FieldsError::OutsideSamples { quantity: "nodes along X3", value: 1.5, .. })
    ));
    assert!(matches!(motion.velocity(&Vector3::zeros(), -2.0), Err(FieldsError::OutsideSamples { .. })));
    let places = [[0.0; 3]; 3];
    assert!(matches!(
        SampledTrajectories::new(&[0.0, 1.0], &[&places], Interpolation::Cubic),
        Err(FieldsError::WrongLength { found: 3, expected: 2, .. })
    ));
}
