//! Compatibility: what comes from a deformation leaves nothing, what does not leaves its curvature.

use nalgebra::{Matrix3, Vector3};
use piola_continuum::Symmetric;
use piola_fields::compatibility::{Curvature, gradient_residual, incompatibility};
use piola_fields::{Field, Material, Motion};
use piola_numerics::{Gradient, Real};
use piola_testkit::strategies::random_cases;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::fixtures::{Tensor, Wave, point, tensor, wave};

/// F of a motion, by exact derivatives.
#[derive(Clone, Copy)]
struct GradientOf(Wave);

impl Field for GradientOf {
    type Value = Matrix3<f64>;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Matrix3<T> {
        let variables = Vector3::from_fn(|i, _| Gradient::<T, 3>::variable(place[i], i));
        let x = self.0.place(&variables, Gradient::constant(time));
        Matrix3::from_fn(|i, j| x[i].partials[j])
    }
}

/// The metric C of a motion.
struct MetricOf(GradientOf);

impl Field for MetricOf {
    type Value = Symmetric;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Symmetric<T> {
        let f = self.0.at(place, time);
        let c = f.transpose() * f;
        Symmetric::upper_triangle([0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| c[(i, j)])))
    }
}

/// ε = sym ∇u.
struct StrainOf(GradientOf);

impl Field for StrainOf {
    type Value = Symmetric;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Symmetric<T> {
        let f = self.0.at(place, time);
        let h = |i: usize, j: usize| if i == j { f[(i, j)] - T::one() } else { f[(i, j)] };
        Symmetric::symmetric_part([0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| h(i, j))))
    }
}

/// Any small symmetric field, and the metric 1 + 2 s ε.
struct Strain {
    tensor: Tensor,
    factor: f64,
    metric: bool,
}

impl Field for Strain {
    type Value = Symmetric;
    fn at<T: Real>(&self, place: &Vector3<T>, time: T) -> Symmetric<T> {
        let m = self.tensor.at(place, time) * T::lit(self.factor);
        let rows = [0, 1, 2].map(|i: usize| [0, 1, 2].map(|j: usize| m[(i, j)]));
        let strain = Symmetric::symmetric_part(rows);
        if self.metric { Symmetric::identity() + strain + strain } else { strain }
    }
}

/// The conformal metric (1 + ¼ K |X|²)⁻² 1, of constant curvature K.
struct SpaceForm(f64);

impl Field for SpaceForm {
    type Value = Symmetric;
    fn at<T: Real>(&self, place: &Vector3<T>, _time: T) -> Symmetric<T> {
        let square = place[0] * place[0] + place[1] * place[1] + place[2] * place[2];
        Symmetric::diagonal([(T::one() + T::lit(0.25 * self.0) * square).powi(-2); 3])
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(random_cases(10_000)))]

    #[test]
    fn gradient_metric_and_strain_of_a_motion_leave_nothing(motion in wave(), x in point(), t in -2.0..2.0_f64) {
        let f = GradientOf(motion);
        prop_assert!(gradient_residual(&Material(f), &x, t)?.relative() <= Tol::ulps(8.0).value());
        let curvature = Curvature::of_metric(&Material(MetricOf(f)), &x, t)?;
        prop_assert!(curvature.residual.relative() <= Tol::ulps(64.0).value(), "{:?}", curvature.residual);
        prop_assert!(incompatibility(&Material(StrainOf(f)), &x, t)?.relative() <= Tol::ulps(8.0).value());
    }

    #[test]
    fn curl_of_a_tensor_equals_differences_of_slopes_by_hand(f in tensor(), x in point(), t in -2.0..2.0_f64) {
        let residual = gradient_residual(&Material(f), &x, t)?;
        let expected = Matrix3::from_fn(|i, c| {
            let (b, a) = ((c + 1) % 3, (c + 2) % 3);
            f.slope(&x, t, i, a, b) - f.slope(&x, t, i, b, a)
        });
        assert_close_at_scale("Curl", residual.value.as_slice(), expected.as_slice(), residual.scale.amax(), Tol::ulps(8.0));
    }

    #[test]
    fn curvature_of_a_space_form_is_constant(k in -1.0..1.0_f64, x in point()) {
        let curvature = Curvature::of_metric(&Material(SpaceForm(k)), &x, 0.0)?;
        let g = curvature.metric;
        let size = curvature.residual.scale.components.iter().fold(0.0_f64, |a, b| a.max(b.abs()));
        let tol = Tol::ulps(64.0);
        let twice = (g * (2.0 * k)).components;
        assert_close_at_scale("Ric = 2 K g", &curvature.ricci().components, &twice, size, tol);
        assert_close_at_scale("R = 6 K", &[curvature.scalar()], &[6.0 * k], 10.0 * size, tol);
        for (a, b, c, d) in [(0, 1, 0, 1), (0, 1, 1, 0), (1, 2, 1, 2), (0, 1, 0, 2), (0, 0, 1, 2)] {
            let m = g.matrix();
            let expected = k * (m[(a, c)] * m[(b, d)] - m[(a, d)] * m[(b, c)]);
            assert_close_at_scale("R_ABCD", &[curvature.riemann(a, b, c, d)], &[expected], size, tol);
        }
    }

    #[test]
    fn curvature_of_a_small_strain_tends_to_its_incompatibility(f in tensor(), x in point(), t in -2.0..2.0_f64) {
        let factor = 1e-6;
        let linear = incompatibility(&Material(Strain { tensor: f, factor, metric: false }), &x, t)?;
        let metric = Material(Strain { tensor: f, factor, metric: true });
        let exact = Curvature::of_metric(&metric, &x, t)?;
        let size = 100.0 * factor;
        let tol = Tol::stated(10.0 * factor, "the difference is of second order in the strain");
        let value = exact.residual.value.components;
        assert_close_at_scale("N → inc ε", &value, &linear.value.components, size, tol);
        assert_close_at_scale("G → inc ε", &exact.einstein().components, &linear.value.components, size, tol);
    }
}

#[test]
fn metric_of_a_sphere_has_positive_ricci_and_trace() {
    let curvature = Curvature::of_metric(&Material(SpaceForm(1.0)), &Vector3::zeros(), 0.0).expect("curvature");
    assert_close("Ric", &curvature.ricci().components, &[2.0, 2.0, 2.0, 0.0, 0.0, 0.0], Tol::ulps(4.0));
}
