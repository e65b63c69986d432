//! Motions: derivatives against those by hand, homogeneous and rigid motions.

use nalgebra::{Matrix3, Vector3};
use piola_fields::{AffineHistory, Homogeneous, Motion, Rigid, RigidHistory};
use piola_numerics::{Lanes, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::fixtures::{point, wave};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn exact_derivatives_of_a_motion_equal_those_by_hand(motion in wave(), x in point(), t in -2.0..2.0_f64) {
        let tol = Tol::ulps(16.0);
        let ((u, h), (v, rate), (a, second_rate)) =
            (motion.by_hand(&x, t, 0), motion.by_hand(&x, t, 1), motion.by_hand(&x, t, 2));
        let scale = motion.amplitude * (1.0 + motion.frequency * motion.frequency);
        let close = |what: &str, actual: &[f64], expected: &[f64]| {
            assert_close_at_scale(what, actual, expected, scale, tol);
        };
        close("u", motion.displacement(&x, t).as_slice(), u.as_slice());
        close("v", motion.velocity(&x, t)?.as_slice(), v.as_slice());
        close("a", motion.acceleration(&x, t)?.as_slice(), a.as_slice());
        close("∇u", motion.displacement_gradient(&x, t)?.matrix().as_slice(), h.as_slice());
        close("Ḟ", motion.deformation_rate(&x, t)?.as_slice(), rate.as_slice());
        close("F̈", motion.deformation_second_rate(&x, t)?.as_slice(), second_rate.as_slice());
        let f = Matrix3::identity() + h;
        assert_close("F", motion.deformation_gradient(&x, t)?.matrix().as_slice(), f.as_slice(), tol);
        let l = motion.velocity_gradient(&x, t)?;
        // L F = Ḟ, W(14.21).
        close("L F", (l * f).as_slice(), rate.as_slice());
    }

    #[test]
    fn second_gradient_equals_difference_of_gradients(motion in wave(), x in point(), t in -2.0..2.0_f64) {
        let second = motion.second_gradient(&x, t)?;
        let step = 1e-5;
        for b in 0..3 {
            let mut shift = Vector3::zeros();
            shift[b] = step;
            let (plus, minus) = (motion.by_hand(&(x + shift), t, 0).1, motion.by_hand(&(x - shift), t, 0).1);
            let difference = (plus - minus) / (2.0 * step);
            let exact = Matrix3::from_fn(|i, a| second[i][(a, b)]);
            let tol = Tol::stated(1e-9, "central differences: h² = 1e-10 and rounding 1e-16/h = 1e-11, with room");
            assert_close_at_scale("∂F/∂X", exact.as_slice(), difference.as_slice(), 1.0, tol);
        }
    }

    #[test]
    fn lanes_of_a_motion_equal_its_scalars(motion in wave(), x in point(), t in -2.0..2.0_f64) {
        type Pair = Lanes<f64, 4>;
        let lanes = motion.velocity_gradient(&x.map(Pair::lit), Pair::lit(t))?;
        let scalar = motion.velocity_gradient(&x, t)?;
        for lane in 0..4 {
            let tol = Tol::ulps(16.0);
            assert_close("L", lanes.map(|l| l.primal(lane)).as_slice(), scalar.as_slice(), tol);
        }
    }
}

/// F = exp(t N) for a nilpotent N and c = t² e, W(14.10).
struct Shearing {
    rate: f64,
}

impl AffineHistory for Shearing {
    fn gradient<T: Real>(&self, time: T) -> Matrix3<T> {
        let (o, l) = (T::lit(0.0), T::lit(1.0));
        Matrix3::new(l, T::lit(self.rate) * time, o, o, l, o, o, o, l)
    }
    fn displacement_gradient<T: Real>(&self, time: T) -> Matrix3<T> {
        let o = T::lit(0.0);
        Matrix3::new(o, T::lit(self.rate) * time, o, o, o, o, o, o, o)
    }
    fn translation<T: Real>(&self, time: T) -> Vector3<T> {
        Vector3::new(T::lit(0.0), T::lit(0.0), time * time)
    }
}

#[test]
fn homogeneous_motion_has_uniform_gradient_and_steady_rate() {
    let motion = Homogeneous(Shearing { rate: 1e-12 });
    for x in [Vector3::zeros(), Vector3::new(1.0, -2.0, 3.0)] {
        let gradient = motion.displacement_gradient(&x, 0.5).expect("∇u");
        assert_close("∇u", &[gradient.matrix()[(0, 1)]], &[0.5e-12], Tol::ulps(1.0));
        let l = motion.velocity_gradient(&x, 0.5).expect("L");
        assert_close("L", l.as_slice(), &[0.0, 0.0, 0.0, 1e-12, 0.0, 0.0, 0.0, 0.0, 0.0], Tol::ulps(1.0));
        assert_close("a", motion.acceleration(&x, 0.5).expect("a").as_slice(), &[0.0, 0.0, 2.0], Tol::ulps(1.0));
    }
}

/// A tumbling body: a quaternion that is not of unit length.
struct Tumble {
    direction: [f64; 3],
    rate: f64,
}

impl RigidHistory for Tumble {
    fn attitude<T: Real>(&self, time: T) -> [T; 4] {
        let angle = T::lit(self.rate) * time;
        let [x, y, z] = self.direction.map(T::lit);
        [T::lit(2.0) + angle.cos(), x * angle.sin(), y * angle, z + angle * angle]
    }
    fn translation<T: Real>(&self, time: T) -> Vector3<T> {
        Vector3::new(time, T::lit(0.0), time.sin())
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn rigid_motion_has_orthogonal_gradient_and_skew_velocity_gradient(
        direction in [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0], rate in -2.0..2.0_f64, x in point(), t in -2.0..2.0_f64
    ) {
        let motion = Rigid(Tumble { direction, rate });
        let f = *motion.deformation_gradient(&x, t)?.matrix();
        assert_close("FᵀF", (f.transpose() * f).as_slice(), Matrix3::identity().as_slice(), Tol::ulps(16.0));
        let l = motion.velocity_gradient(&x, t)?;
        // The rate of the quaternion is at most a few times its length.
        let tol = Tol::ulps(64.0);
        assert_close_at_scale("L + Lᵀ", (l + l.transpose()).as_slice(), &[0.0; 9], 1.0 + l.amax(), tol);
    }
}
