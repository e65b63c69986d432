//! Motions of constant stretch history and viscometric ones: those that are, those that are not, and refusals.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::ContinuumError;
use piola_continuum::rates::{
    ConstantStretchHistory, ExponentialMotion, HomogeneousMotion, LinearMotion, steady_turn, stretch_history,
    viscometric_motion,
};
use piola_numerics::Real;
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale, strategies};
use proptest::prelude::*;

/// F is a product of two shears and a stretch that change with time, det F = 1.
#[derive(Clone, Debug)]
struct Wandering {
    shears: [f64; 3],
    rates: [f64; 3],
}

impl HomogeneousMotion for Wandering {
    fn gradient<T: Real>(&self, t: T) -> Matrix3<T> {
        let at = |i: usize| T::lit(self.shears[i]) * (T::lit(self.rates[i]) * t).sin();
        let one = Matrix3::from_diagonal_element(T::one());
        let (mut first, mut second) = (one, one);
        first[(1, 0)] = at(0);
        second[(0, 1)] = at(1);
        let stretch = at(2).exp();
        first * Matrix3::from_diagonal(&Vector3::new(stretch, stretch.recip(), T::one())) * second
    }
}

fn unimodular(entries: &[f64]) -> Matrix3<f64> {
    let mut lower = Matrix3::identity();
    let mut upper = Matrix3::identity();
    (lower[(1, 0)], lower[(2, 0)], lower[(2, 1)]) = (entries[0], entries[1], entries[2]);
    (upper[(0, 1)], upper[(0, 2)], upper[(1, 2)]) = (entries[3], entries[4], entries[5]);
    lower * upper
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(1_000)))]

    #[test]
    fn turned_exponential_motions_have_constant_stretch_histories_and_others_none(
        entries in strategies::vector(9, -1.0..1.0), spin in strategies::vector(3, -2.0..2.0),
        h in strategies::vector(6, -1.0..1.0), shears in proptest::array::uniform3(-0.8..0.8_f64), rates in proptest::array::uniform3(0.3..1.5_f64),
    ) {
        let mut generator = Matrix3::from_row_slice(&entries);
        generator -= Matrix3::from_diagonal_element(generator.trace() / 3.0);
        let turning = steady_turn(&Vector3::from_column_slice(&spin)).expect("finite");
        let constant = ConstantStretchHistory { turning, reference: unimodular(&h), generator };
        let times = [0.0, 0.3, 1.0];
        let change = stretch_history(&constant, &times, 1.0).expect("a motion");
        // cond H and exp(K) to the third power, of each of three factors.
        let rounding = Tol::stated(1e-8, "cond H and |exp K| ≤ e³, each to the third power, of an ulp");
        assert_close_at_scale("change", &[change], &[0.0], 1.0, rounding);
        let motion = Wandering { shears, rates };
        let shape = motion.shears.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
        prop_assume!(0.3 < shape);
        let other = stretch_history(&motion, &times, 1.0).expect("a motion");
        prop_assert!(1e-4 < other, "{other:e} of {motion:?}");
    }

    #[test]
    fn turned_shears_are_viscometric(
        log in -3.0..3.0_f64, spin in strategies::vector(3, -2.0..2.0), q in strategies::rotation(), time in 0.0..3.0_f64,
    ) {
        let k = 10.0_f64.powf(log);
        let r = strategies::rotation_matrix(q);
        let axes = Matrix3::from_fn(|i, j| r[i][j]);
        let shear = Matrix3::new(0.0, 0.0, 0.0, k, 0.0, 0.0, 0.0, 0.0, 0.0);
        let turning = steady_turn(&(Vector3::from_column_slice(&spin) * k)).expect("finite");
        let motion = ConstantStretchHistory {
            turning, reference: axes.transpose(), generator: Matrix3::zeros(),
        };
        // H exp(K t) with K = H⁻¹ shear H is the shear along turned axes.
        let motion = ConstantStretchHistory { generator: axes * shear * axes.transpose(), ..motion };
        let found = viscometric_motion(&motion, time / k).expect("a motion").expect("it flows");
        // Up to k t = 3: F, its rate and its inverse grow by 1 + k t each.
        let tolerance = Tol::ulps_because(4096.0, "two derivatives of F and its inverse").times((1.0 + time).powi(4));
        assert_close("k", &[found.shear_rate], &[k], tolerance);
        assert_close_at_scale("residual", &[found.residual], &[0.0], 1.0, tolerance);
        // A₁ = k (e₁e₂ + e₂e₁) with e₁ in the turned gradient.
        let turn = motion.turning.gradient(time / k);
        assert_close("e₁", &[found.axes[0].dot(&(turn * Vector3::x())).abs()], &[1.0], tolerance);
    }

    #[test]
    fn stretching_motions_are_not_viscometric(
        entries in strategies::vector(9, -1.0..1.0),
    ) {
        let mut l = Matrix3::from_row_slice(&entries);
        l -= Matrix3::from_diagonal_element(l.trace() / 3.0);
        // det of a nilpotent L, and the sum of its principal minors, are zero.
        let (d, second) = (l.determinant(), -0.5 * (l * l).trace());
        prop_assume!(0.05 < d.abs() || 0.05 < second.abs());
        let motion = ExponentialMotion::new(l, Matrix3::identity()).expect("a motion");
        let found = viscometric_motion(&motion, 0.5).expect("a motion").expect("it flows");
        prop_assert!(1e-4 < found.residual, "{found:?}");
    }
}

#[test]
fn one_time_and_no_horizon_are_refused_and_rigid_motions_do_not_flow() -> Result<(), ContinuumError> {
    let observer = steady_turn(&Vector3::new(0.5, 1.0, -0.25))?;
    assert!(viscometric_motion(&observer, 1.0)?.is_none());
    let linear = LinearMotion::new(Matrix3::identity(), Matrix3::from_diagonal(&Vector3::new(0.5, 0.0, 0.0)))?;
    let refused = stretch_history(&linear, &[0.0], 1.0);
    assert!(matches!(refused, Err(ContinuumError::OutOfBounds { quantity: "number of times", .. })));
    let refused = stretch_history(&linear, &[0.0, 1.0], 0.0);
    assert!(matches!(refused, Err(ContinuumError::OutOfBounds { quantity: "horizon", .. })));
    assert!(stretch_history(&linear, &[0.0, f64::NAN], 1.0).is_err());
    assert!(steady_turn(&Vector3::new(f64::INFINITY, 0.0, 0.0)).is_err());
    Ok(())
}
