//! Homogeneous motions: which are universal, for how long, and homogeneous configurations.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::rates::{ExponentialMotion, HomogeneousMotion, LinearMotion};
use piola_fields::{AffineHistory, Homogeneous, Motion};
use piola_numerics::Real;
use piola_solutions::SolutionsError;
use piola_solutions::homogeneous::{
    MaterialSymmetry, MotionConditions, acceleration_potential, body_force, configuration_residual, lifetime,
    simple_shearing, steady_extension,
};
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

const TOLERANCE: f64 = 1e-12;

fn matrix(entries: [f64; 9]) -> Matrix3<f64> {
    Matrix3::from_row_slice(&entries)
}

/// F = Σ tⁿ Fₙ, c = Σ tⁿ cₙ.
struct Quadratic([Matrix3<f64>; 3], [Vector3<f64>; 3]);

impl AffineHistory for Quadratic {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        let [a, b, c] = self.0.map(|m| m.map(T::lit));
        a + b * t + c * (t * t)
    }
    fn translation<T: Real>(&self, t: T) -> Vector3<T> {
        let [a, b, c] = self.1.map(|m| m.map(T::lit));
        a + b * t + c * (t * t)
    }
}

proptest! {
    #[test]
    fn body_force_of_a_homogeneous_motion_equals_its_acceleration(
        entries in prop::array::uniform9(-0.1..0.1_f64), c in prop::array::uniform3(-2.0..2.0_f64), t in 0.0..1.0_f64,
    ) {
        let f = matrix(entries);
        let history = Quadratic([Matrix3::identity() + f, f * 0.5, f.transpose()], [Vector3::zeros(), Vector3::x(), c.into()]);
        let particle = Vector3::new(1.0, -2.0, 0.5);
        let force = body_force(&history, &particle, t).expect("force");
        let acceleration = Homogeneous(history).acceleration(&particle, t).expect("acceleration");
        assert_close_at_scale("b", force.as_slice(), acceleration.as_slice(), 1.0, Tol::ulps(16.0));
    }

    #[test]
    fn linear_motions_are_accelerationless_and_exist_between_the_zeros_of_their_determinant(
        a in prop::array::uniform9(-1.0..1.0_f64), b in prop::array::uniform9(-0.4..0.4_f64),
    ) {
        let (rate, start) = (matrix(a), Matrix3::identity() + matrix(b));
        prop_assume!(0.2 < start.determinant());
        let life = lifetime(&rate, &start, TOLERANCE).expect("lifetime");
        prop_assert!(life.begin < 0.0 && 0.0 < life.end);
        let motion = LinearMotion::new(start, rate).expect("motion");
        let det = |t: f64| (rate * t + start).determinant();
        for (end, sign) in [(life.begin, -1.0), (life.end, 1.0)] {
            let inside = if end.is_finite() { 0.999 * end } else { sign * 50.0 };
            for share in [0.1, 0.5, 1.0] {
                prop_assert!(0.0 < det(share * inside), "{end} {share}");
            }
            let kinematics = MotionConditions::of(&motion, 0.5 * inside.clamp(-1.0, 1.0)).expect("kinematics");
            prop_assert!(kinematics.acceleration <= 0.0);
            if end.is_finite() {
                let size = (rate * end).norm() + start.norm();
                assert_close_at_scale("det F", &[det(end)], &[0.0], size.powi(3), Tol::stated(1e-11, "roots of a cubic"));
            }
        }
    }

    #[test]
    fn steady_extensions_keep_volume_and_circulation(a in -1.0..1.0_f64, b in -1.0..1.0_f64, t in -1.0..1.0_f64) {
        let extension = steady_extension([a, b, -(a + b)]).expect("extension");
        let kinematics = MotionConditions::of(&extension, t).expect("kinematics");
        prop_assert!(kinematics.volume.abs() < 1e-14 && kinematics.volume_rate < 1e-14 && kinematics.circulation < 1e-13);
        // a = −grad ζ: F̈ F⁻¹ = A².
        let x = Vector3::new(1.0, 2.0, -1.0);
        let zeta = acceleration_potential(&extension, &x, t).expect("ζ");
        let expected = -0.5 * (a * a + 4.0 * b * b + (a + b) * (a + b));
        assert_close_at_scale("ζ", &[zeta], &[expected], 1e-3, Tol::ulps_because(256.0, "exponentials of t up to 1"));
    }

    #[test]
    fn turned_references_are_homogeneous_for_isotropic_solids_only(
        quaternions in prop::collection::vec(strategies::rotation(), 3..5),
    ) {
        let turns: Vec<Matrix3<f64>> = quaternions.into_iter().map(|q| {
            let rows = strategies::rotation_matrix(q);
            Matrix3::from_fn(|i, j| rows[i][j])
        }).collect();
        prop_assert!(configuration_residual(&turns, &MaterialSymmetry::Orthogonal).expect("residual") < 1e-13);
        prop_assert!(configuration_residual(&turns, &MaterialSymmetry::Unimodular).expect("residual") < 1e-13);
        let fixed: Vec<_> = turns.iter().map(|turn| turn * 2.0).collect();
        prop_assert!(configuration_residual(&fixed, &MaterialSymmetry::Orthogonal).expect("residual") < 1e-13);
        let mixed = [turns[0], turns[1] * 2.0];
        prop_assert!(1.0 < configuration_residual(&mixed, &MaterialSymmetry::Unimodular).expect("residual"));
    }
}

#[test]
fn nilpotent_and_turning_rates_last_for_ever() {
    let one = Matrix3::identity();
    // Two shears, one in a turned frame: proper numbers of a nilpotent matrix are computed to 1e-5 only.
    let shear = matrix([0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 1.0, 3.0, 0.0]);
    let turn = strategies::rotation_matrix([0.8, 0.36, 0.48, 0.0]);
    let turn = Matrix3::from_fn(|i, j| turn[i][j]);
    for rate in [shear, turn * shear * turn.transpose(), Matrix3::zeros()] {
        assert!(lifetime(&rate, &one, TOLERANCE).expect("lifetime").is_eternal(), "{rate}");
    }
    // det(1 + t Ω) = 1 + ω² t².
    let spin = Vector3::new(1.0, 2.0, 2.0).cross_matrix();
    assert!(lifetime(&spin, &one, TOLERANCE).expect("lifetime").is_eternal());
    // Stretching: for t ≥ 0 only; a double zero at −1.
    let stretching = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, 0.0));
    let life = lifetime(&stretching, &one, TOLERANCE).expect("lifetime");
    assert!(life.lasts() && !life.is_eternal());
    assert_close("begin", &[life.begin], &[-1.0], Tol::stated(1e-7, "a double root"));
    assert!(matches!(lifetime(&shear, &-one, TOLERANCE), Err(SolutionsError::OutOfBounds { .. })));
}

#[test]
fn motions_that_violate_a_condition_show_by_how_much() {
    let expansion = ExponentialMotion::new(Matrix3::identity(), Matrix3::identity()).expect("motion");
    let kinematics = MotionConditions::of(&expansion, 0.0).expect("kinematics");
    assert_close("tr L", &[kinematics.volume_rate], &[3.0_f64.sqrt()], Tol::ulps(4.0));
    assert!(kinematics.circulation < 1e-15);
    // K = [0 1; 2 0] with a spin: K² = 2 is symmetric; K = [1 1; 0 −1]: K² = 1; K = [1 1 0; 0 1 0; 0 0 −2] is not.
    let generator = matrix([1.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, -2.0]);
    let motion = ExponentialMotion::new(generator, Matrix3::identity()).expect("motion");
    let kinematics = MotionConditions::of(&motion, 0.5).expect("kinematics");
    // K² = [1 2; 0 1] ⊕ 4: skew part √2, norm √22.
    assert_close("skew", &[kinematics.circulation], &[(2.0_f64 / 22.0).sqrt()], Tol::ulps(64.0));
    assert!(matches!(acceleration_potential(&motion, &Vector3::x(), 0.5), Err(SolutionsError::NoPotential { .. })));
    let refused = steady_extension([1.0, 1.0, 1.0]);
    assert!(matches!(refused, Err(SolutionsError::ConstraintViolated { nearest: -2.0, .. })), "{refused:?}");
    assert!(simple_shearing(f64::NAN).is_err());
    let shear = simple_shearing(2.0).expect("shear").deformation(1.5_f64).expect("F");
    assert_close("k t", &[shear.matrix()[(1, 0)]], &[3.0], Tol::ulps(1.0));
}

#[test]
fn configurations_of_crystals_and_fibres_are_told_apart() {
    let about = |angle: f64| *nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), angle).matrix();
    let turned = [about(0.0), about(0.7), about(-1.3)];
    let quarter = core::f64::consts::FRAC_PI_2;
    let fourfold = MaterialSymmetry::Finite(vec![about(quarter), about(2.0 * quarter), about(3.0 * quarter)]);
    let residual = |gradients: &[Matrix3<f64>], group: &MaterialSymmetry| {
        configuration_residual(gradients, group).expect("residual")
    };
    assert!(residual(&turned, &MaterialSymmetry::About(Vector3::z())) < 1e-14);
    assert!(0.1 < residual(&turned, &MaterialSymmetry::About(Vector3::x())));
    assert!(0.1 < residual(&turned, &fourfold));
    assert!(residual(&[about(0.3), about(0.3 + quarter), about(0.3 + 3.0 * quarter)], &fourfold) < 1e-14);
    assert!(configuration_residual(&[Matrix3::zeros()], &fourfold).is_err());
    assert!(configuration_residual(&turned, &MaterialSymmetry::About(Vector3::zeros())).is_err());
}
