//! Relative deformations and the tensors of Rivlin–Ericksen and White–Metzner.

use nalgebra::Matrix3;
use piola_continuum::rates::{
    ExponentialMotion, HomogeneousMotion, LinearMotion, MotionRates, RelativeDeformation, RivlinEricksen,
    VelocityGradient, WhiteMetzner, gradients_of_rates, steady_gradients,
};
use piola_continuum::{Deformation, DeformationGradient, DisplacementGradient};
use piola_numerics::linear::matrix3::from_rows;
use piola_numerics::{Dual, Jet, Real};
use piola_testkit::Tol;
use piola_testkit::strategies::random_cases;
use proptest::prelude::*;

use super::super::cases::{Path, assert_same, lift, path};

impl HomogeneousMotion for Path {
    fn gradient<T: Real>(&self, time: T) -> Matrix3<T> {
        self.at(time)
    }
}

/// Cₜ(τ) and −Cₜ⁻¹(τ) of F(τ) and F(t)⁻¹, and their first three derivatives with respect to τ at τ = 0 = t.
fn derivatives(path: &Path) -> ([Matrix3<f64>; 3], [Matrix3<f64>; 3]) {
    // A dual of a jet: the third derivative is the tangent of the second.
    let time = Dual::new(Jet::<f64, 0>::time(0.0), Jet::constant(1.0));
    let now = path.gradient[0].try_inverse().expect("regular");
    let relative = path.at(time) * lift(&now);
    let right = relative.transpose() * relative;
    let inverse = piola_numerics::linear::matrix3::inverse(&relative).expect("regular");
    let left = -(inverse * inverse.transpose());
    let parts = |a: &Matrix3<Dual<Jet<f64, 0>>>| {
        [a.map(|x| x.value.rate), a.map(|x| x.value.second_rate), a.map(|x| x.tangent.second_rate)]
    };
    (parts(&right), parts(&left))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn relative_deformation_times_present_equals_past(path in path(), lapse in -0.05..0.05_f64) {
        let (now, then) = (path.deformation(), DeformationGradient::new(path.at(lapse)));
        prop_assume!(then.is_ok());
        let then = then.expect("0 < det F");
        let relative = RelativeDeformation::of(&now, &then).expect("0 < det Fₜ");
        let size = now.matrix().norm();
        let tol = Tol::ulps(16.0).times(path.condition());
        assert_same("Fₜ(τ) F(t) = F(τ)", &(relative.gradient() * now.matrix()), then.matrix(), size, tol);
        let by_motion = path.relative(0.0, lapse).expect("0 < det Fₜ");
        assert_same("Fₜ by the motion", &by_motion.gradient(), &relative.gradient(), 1.0, tol);
        let c = relative.right_cauchy_green().matrix();
        assert_same("Cₜ Cₜ⁻¹ = 1", &(c * relative.inverse_right_cauchy_green().matrix()), &Matrix3::identity(), 4.0, tol.times(4.0));
        let change = relative.right_cauchy_green_change().matrix();
        assert_same("Cₜ − 1", &(change + Matrix3::identity()), &c, 1.0, Tol::ulps(2.0));
        let back = RelativeDeformation::of(&relative, &DisplacementGradient::new(Matrix3::zeros()).expect("1")).expect("inverse");
        let product = from_rows(back.gradient_rows()) * relative.gradient();
        assert_same("from then to now and back", &product, &Matrix3::identity(), 1.0, tol.times(4.0));
    }

    #[test]
    fn rivlin_ericksen_and_white_metzner_tensors_equal_derivatives_of_histories(path in path()) {
        let (right, left) = derivatives(&path);
        let inverse = path.gradient[0].try_inverse().expect("regular");
        // F⁗ = 0 for this path: L₁ = Ḟ F⁻¹, L₂ = F̈ F⁻¹, L₃ = 0.
        let gradients = [path.gradient[1] * inverse, path.gradient[2] * inverse * 2.0, Matrix3::zeros()];
        let size = 1.0 + gradients[0].norm() + gradients[1].norm();
        let tol = Tol::ulps(64.0).times(path.condition());
        for (n, (a, expected)) in (1..).zip(RivlinEricksen::of_gradients(&gradients).into_iter().zip(right)) {
            assert_same(&format!("A{n}"), &a.matrix(), &expected, size.powi(n), tol);
        }
        for (n, (b, expected)) in (1..).zip(WhiteMetzner::of_gradients(&gradients).into_iter().zip(left)) {
            assert_same(&format!("B{n}"), &b.matrix(), &expected, 8.0 * size.powi(n), tol);
        }
    }

    #[test]
    fn recursions_of_rivlin_ericksen_and_white_metzner_equal_sums(path in path()) {
        // L and its rates along the path, by differentiable numbers in time.
        let time = Dual::new(Jet::<f64, 0>::time(0.0), Jet::constant(1.0));
        let at = |t: Dual<Jet<f64, 0>>| {
            let f = path.at(t);
            let rate = lift(&path.gradient[1]) + lift(&path.gradient[2]) * (t * Dual::lit(2.0));
            VelocityGradient(rate * piola_numerics::linear::matrix3::inverse(&f).expect("regular"))
        };
        let l = at(time);
        let rates = [l.0.map(|x| x.value.value), l.0.map(|x| x.value.rate), l.0.map(|x| x.value.second_rate)];
        let here = VelocityGradient(rates[0]);
        let gradients = gradients_of_rates(&rates);
        let size = 1.0 + rates[0].norm() + rates[1].norm() + rates[2].norm();
        let tol = Tol::ulps(64.0).times(path.condition().powi(2));
        // Ȧ₁ and Ȧ₂ from A₁ and A₂ as functions of time.
        let of_time = |k: usize| gradients_of_rates::<Jet<f64, 0>, 2>(&[l.0.map(|x| x.value), l.0.map(|x| x.tangent)])[k];
        let moving = RivlinEricksen::of_gradients(&[of_time(0), of_time(1)]);
        let [a1, a2, a3] = RivlinEricksen::of_gradients(&gradients);
        let rate_of = |k: usize| piola_continuum::Symmetric { components: moving[k].0.components.map(|x| x.rate) };
        assert_same("A₁", &RivlinEricksen::first(&here).matrix(), &a1.matrix(), size, tol);
        assert_same("A₂", &a1.next(&rate_of(0), &here).matrix(), &a2.matrix(), size.powi(2), tol);
        assert_same("A₃", &a2.next(&rate_of(1), &here).matrix(), &a3.matrix(), size.powi(3), tol);
        let moving = WhiteMetzner::of_gradients(&[of_time(0), of_time(1)]);
        let [b1, b2, b3] = WhiteMetzner::of_gradients(&gradients);
        let rate_of = |k: usize| piola_continuum::Symmetric { components: moving[k].0.components.map(|x| x.rate) };
        assert_same("B₁", &WhiteMetzner::first(&here).matrix(), &b1.matrix(), size, tol);
        assert_same("B₂", &b1.next(&rate_of(0), &here).matrix(), &b2.matrix(), 4.0 * size.powi(2), tol);
        assert_same("B₃", &b2.next(&rate_of(1), &here).matrix(), &b3.matrix(), 16.0 * size.powi(3), tol);
    }

    #[test]
    fn steady_motions_equal_their_definitions(path in path(), t in -1.0..1.0_f64, lapse in -1.0..1.0_f64) {
        let (f0, k) = (path.gradient[0], path.gradient[2]);
        let motion = ExponentialMotion::new(k, f0).expect("0 < det F");
        let tol = Tol::ulps(64.0).times(path.condition());
        // L by exact derivatives of F(t) is K, and so for the acceleration.
        let MotionRates { deformation, rate, second_rate: second } = motion.rates(t).expect("0 < det F");
        let size = rate.0.norm() * 4.0;
        assert_same("Ḟ = K F", &rate.0, &(k * deformation.matrix()), size, tol);
        assert_same("F̈ = K² F", &second.0, &(k * k * deformation.matrix()), 4.0 * size, tol);
        assert_same("L = K", &motion.velocity_gradient(t).expect("finite").0, &k, 0.0, Tol::ulps(0.0));
        let [first, square] = steady_gradients(&motion.velocity_gradient(t).expect("finite"));
        prop_assert_eq!(first, k);
        assert_same("grad a = K²", &motion.acceleration_gradient(t).expect("finite").0, &square, 0.0, Tol::ulps(0.0));
        let now = motion.deformation(t).expect("0 < det F");
        let then = motion.deformation(t + lapse).expect("0 < det F");
        let relative = motion.relative(t, lapse).expect("0 < det Fₜ");
        assert_same("Fₜ F(t) = F(τ)", &(relative.gradient() * now.matrix()), then.matrix(), 30.0 * then.matrix().norm(), tol);
        // A motion with constant Ḟ.
        let linear = LinearMotion::new(f0, path.gradient[1]).expect("0 < det F");
        let MotionRates { rate, second_rate: second, .. } = linear.rates(0.0).expect("0 < det F");
        prop_assert_eq!(rate.0, path.gradient[1]);
        prop_assert_eq!(second.0, Matrix3::zeros());
        let l = linear.velocity_gradient(0.0).expect("0 < det F");
        assert_same("grad a = 0", &linear.acceleration_gradient(0.0).expect("0 < det F").0, &Matrix3::zeros(), 1.0, Tol::ulps(0.0));
        assert_same("L", &l.0, &path.velocity_gradient().0, 0.0, Tol::ulps(0.0));
    }
}
