//! Statics: equilibria against closed forms, and what is refused.

use core::f64::consts::PI;

use nalgebra::DMatrix;
use piola_kinematics::{Inertia, RigidBody};
use piola_lagrangian::Lagrangian;
use piola_lagrangian::small_motions::{ModeMotion, Stability};
use piola_lagrangian::{LagrangianError, SmallMotionsError};
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use crate::systems::{Acts, GRAVITY, Linear, Still, hoop, row_of_springs, sprung, standing};

/// Newton's iteration ends at rounding: a few ulp of the coordinates times the condition number.
fn rounding(condition: f64) -> Tol {
    Tol::ulps(16.0).times(condition)
}

#[test]
fn bead_on_hoop_rests_where_cos_theta_is_g_over_r_omega_squared() {
    let (mass, radius) = (0.5, 2.0);
    for rate in [2.25, 3.0, 8.0, 40.0] {
        let turning = hoop(mass, radius, rate);
        // Above the threshold the lowest point is a maximum of the effective potential.
        let lowest = turning.equilibrium(&[0.01], 0.5);
        let (cosine, scale) = (GRAVITY / (radius * rate * rate), mass * radius * radius);
        let found = turning.equilibrium(&[1.3], 0.5).unwrap();
        // ∂ arccos/∂ cos = 1/sin.
        let sine = (1.0 - cosine * cosine).sqrt();
        assert_close("θ", found.coordinates.as_slice(), &[cosine.acos()], rounding(found.condition / (sine * sine)));
        assert_eq!(found.stability, Stability::Stable);
        assert!(found.residual <= Tol::ulps(16.0).value(), "{}", found.residual);
        let stiffness = found.linearisation.stiffness[(0, 0)];
        assert_close(
            "K",
            &[stiffness],
            &[scale * rate * rate * sine * sine],
            Tol::ulps(64.0).times(1.0 / (sine * sine)),
        );
        let lowest = lowest.unwrap();
        assert_close_at_scale("θ = 0", lowest.coordinates.as_slice(), &[0.0], 1.0, rounding(1.0));
        assert_eq!(lowest.stability, Stability::Unstable);
    }
    for rate in [0.5, 2.0, 2.2] {
        let found = hoop(mass, radius, rate).equilibrium(&[0.3], 0.0).unwrap();
        assert_close_at_scale("θ = 0", found.coordinates.as_slice(), &[0.0], 1.0, rounding(1.0));
        assert_eq!(found.stability, Stability::Stable);
        let frequency = found.linearisation.normal_modes().unwrap().angular_frequencies()[0];
        let (gravity, turn) = (GRAVITY / radius, rate * rate);
        let cancellation = (gravity + turn) / (gravity - turn);
        assert_close("ω", &[frequency], &[(gravity - turn).sqrt()], Tol::ulps(8.0).times(cancellation));
    }
}

#[test]
fn double_pendulum_has_one_stable_equilibrium_of_four() {
    let pendulum = || standing(Still::Pendulums(vec![1.0, 2.0], vec![1.0, 0.5]));
    for (first, second) in [(0.0, 0.0), (PI, 0.0), (0.0, PI), (PI, PI)] {
        let found = pendulum().equilibrium(&[first + 0.2, second - 0.3], 0.0).unwrap();
        assert_close_at_scale("θ", found.coordinates.as_slice(), &[first, second], 1.0, rounding(found.condition));
        let expected = if first + second < 1.0 { Stability::Stable } else { Stability::Unstable };
        assert_eq!(found.stability, expected, "{first} {second}");
        assert!(found.residual <= Tol::ulps(16.0).value(), "{}", found.residual);
        assert!(found.iterations < 12, "{}", found.iterations);
    }
    // An exact guess is accepted as it is.
    assert_eq!(pendulum().equilibrium(&[0.0, 0.0], 0.0).unwrap().iterations, 0);
}

/// π is the number next to the angle of the upright pendulum: the moment m g l sin π there is rounding in any unit of mass.
#[test]
fn guess_that_is_exact_but_for_rounding_is_accepted_in_any_unit_of_mass() {
    for mass in [1e-12, 1.0, 1e12] {
        let upright = standing(Still::Pendulums(vec![mass], vec![0.5])).equilibrium(&[PI], 0.0).unwrap();
        assert_eq!((upright.iterations, upright.stability), (0, Stability::Unstable), "{mass}");
        assert_close("θ", upright.coordinates.as_slice(), &[PI], Tol::ulps(1.0));
        // K = −m g l, and its condition number is one.
        let stiffness = upright.linearisation.stiffness[(0, 0)];
        assert_close("K", &[stiffness, upright.condition], &[-0.5 * mass * GRAVITY, 1.0], Tol::ulps(8.0));
    }
}

#[test]
fn equilibrium_of_loaded_springs_equals_tridiagonal_solution() {
    // Unit loads on n springs in a row, held at one end: x_i = Σ_{j ≤ i} (n − j)/k.
    let (n, k) = (12, 64.0);
    let springs = Acts::Springs(row_of_springs(n, k, 1), vec![1.0; n]);
    let loaded = Lagrangian::of(Still::Masses(vec![2.0; n])).with_potential(springs).with_forces(Linear::default());
    let found = loaded.equilibrium(&vec![0.0; n], 0.0).unwrap();
    let mut place = 0.0;
    let expected: Vec<f64> = (0..n)
        .map(|i| {
            place += (n - i) as f64 / k;
            place
        })
        .collect();
    assert_close("x", found.coordinates.as_slice(), &expected, rounding(found.condition));
    assert_eq!(found.stability, Stability::Stable);
}

#[test]
fn condition_number_tells_the_error_of_stiff_and_soft_springs() {
    for exponent in [2, 6, 10, 13] {
        let soft = 10.0_f64.powi(-exponent);
        // x₁ = x₂ + soft displacement: K = [[1 + s, −1], [−1, 1 + s]] with equal loads b gives x = b/s.
        let stiffness = DMatrix::from_row_slice(2, 2, &[1.0 + soft, -1.0, -1.0, 1.0 + soft]);
        let exact = (1.0 + soft) - 1.0; // what the rounded entries stand for
        let springs = Acts::Springs(stiffness, vec![1.0, 1.0]);
        let loaded = Lagrangian::of(Still::Masses(vec![1.0; 2])).with_potential(springs).with_forces(Linear::default());
        let found = loaded.equilibrium(&[0.0, 0.0], 0.0).unwrap();
        assert_close(
            "κ",
            &[found.condition],
            &[2.0 / soft],
            Tol::ulps(16.0).times(2.0 / soft).or(Tol::stated(1e-2, "soft is rounded")),
        );
        assert_close("x", found.coordinates.as_slice(), &[1.0 / exact; 2], rounding(found.condition));
    }
}

/// Springs of the length of their place, both rounded: at q = 0 they are at rest, but for a force of rounding.
#[test]
fn springs_at_rest_are_at_rest() {
    let (mut compared, mut rounded) = (0, 0);
    for i in 1..60 {
        for j in 1..60 {
            let (a, b) = (0.1 * f64::from(i), 0.07 * f64::from(j));
            let (place, rest) = (a + b, f64::from(10 * i + 7 * j) / 100.0);
            let still = Lagrangian::of(Still::Displaced(place)).with_potential(Acts::Spring([40.0, place, rest]));
            let found = still.with_forces(Linear::default()).equilibrium(&[0.0], 0.0).unwrap();
            assert_close_at_scale("q", found.coordinates.as_slice(), &[0.0], place, Tol::ulps(4.0));
            assert!(found.residual <= Tol::ulps(16.0).value(), "{}", found.residual);
            compared += 1;
            rounded += usize::from(place.to_bits() != rest.to_bits());
        }
    }
    assert_eq!(compared, 3481);
    assert!(1000 < rounded, "{rounded} with a force of rounding");
}

#[test]
fn cart_without_springs_is_refused_along_its_track() {
    let cart = standing(Still::CartPole(3.0, 1.0));
    let error = cart.equilibrium(&[2.0, 0.1], 0.0).unwrap_err();
    let LagrangianError::SmallMotions(SmallMotionsError::SingularStiffness { direction, .. }) = error else {
        panic!("{error}")
    };
    assert_close("direction", &direction, &[1.0, 0.0], Tol::ulps(4.0));
    // Linearised upright it drifts along the track and falls: ω² = −(1 + m/M) g/l.
    let modes = cart.linearise(&[2.0, 0.0], &[0.0, 0.0], 0.0).unwrap().normal_modes().unwrap();
    let Some(ModeMotion::Growth { rate }) = modes.motion(0) else { panic!("{modes:?}") };
    assert_close("σ", &[rate], &[(4.0 / 3.0 * GRAVITY).sqrt()], Tol::ulps(8.0));
    assert_eq!(modes.motion(1), Some(ModeMotion::Drift));
    assert_eq!(modes.motion(2), None);
}

#[test]
fn forces_that_nothing_balances_are_refused() {
    let free =
        |acts: Acts| Lagrangian::of(Still::Masses(vec![1.0])).with_potential(acts).with_forces(Linear::default());
    // A constant force: no displacement answers it.
    let pushed = free(Acts::Springs(DMatrix::zeros(1, 1), vec![3.0]));
    let error = pushed.equilibrium(&[0.5], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::SmallMotions(SmallMotionsError::SingularStiffness { .. })), "{error}");
    // A force that only fades: Newton walks for ever.
    let error = free(Acts::Exponential).equilibrium(&[0.5], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::SmallMotions(SmallMotionsError::NoEquilibrium { .. })), "{error}");
    let error = free(Acts::Exponential).equilibrium(&[f64::NAN], 0.0).unwrap_err();
    assert!(matches!(error, LagrangianError::NotFinite { quantity: "q", index: 0, .. }), "{error}");
    // Horizontal, a pendulum answers no turn: the direction is named.
    let pendulum = standing(Still::Pendulums(vec![1.0], vec![1.0]));
    let error = pendulum.equilibrium(&[0.5 * PI], 0.0).unwrap_err();
    assert!(
        matches!(
            error,
            LagrangianError::SmallMotions(
                SmallMotionsError::SingularStiffness { .. } | SmallMotionsError::NoEquilibrium { .. }
            )
        ),
        "{error}"
    );
}

/// Along e^q Newton's hundred steps have the length one each: the force left is e^(−99.5), compared with the weight m g.
#[test]
fn force_that_is_left_is_compared_with_the_weight_of_particles_and_bodies() {
    let mass = 2.5;
    let body = RigidBody::new(mass, Inertia::principal([1.0; 3]).unwrap()).unwrap();
    for system in [Still::Masses(vec![mass]), Still::Slide(body)] {
        let fading = Lagrangian::of(system).with_gravity(GRAVITY).with_potential(Acts::Exponential);
        let error = fading.with_forces(Linear::default()).equilibrium(&[0.5], 0.0).unwrap_err();
        let LagrangianError::SmallMotions(SmallMotionsError::NoEquilibrium { iterations, residual }) = error else {
            panic!("{error}")
        };
        assert_eq!(iterations, 100);
        let places = Tol::ulps_because(6400.0, "a hundred steps, each rounded at places up to a hundred");
        assert_close("residual", &[residual], &[(-99.5_f64).exp() / (mass * GRAVITY)], places);
    }
}

#[test]
fn equilibrium_of_nothing_is_empty() {
    let found = sprung(Vec::new(), DMatrix::zeros(0, 0), Linear::default()).equilibrium(&[], 0.0).unwrap();
    assert_eq!((found.coordinates.len(), found.stability), (0, Stability::Stable));
}
