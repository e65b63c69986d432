//! Monge strips and characteristic strips.

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{CharacteristicStrip, Strip, StripResidual};
use piola_integrators::Field;
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close};
use proptest::prelude::*;

use super::systems::Particle;

/// A strip of the oscillator with m = ω = 1 over τ = 2t, whose momentum is p = a cos t + b t: it is the oscillator's
/// own where b = 0, and W(12.3) holds for any b.
#[derive(Debug)]
struct Driven {
    a: f64,
    b: f64,
    bend: f64,
}

impl Strip for Driven {
    fn freedom(&self) -> usize {
        1
    }
    fn at<T: Real>(&self, tau: T, element: &mut [T]) {
        let (half, a, b) = (T::lit(0.5), T::lit(self.a), T::lit(self.b));
        let t = half * tau;
        let (s, c) = t.sin_cos();
        let p = a * c + b * t;
        let q = a * s + half * b * t * t + T::lit(self.bend) * t;
        element[0] = q;
        element[1] = t;
        // U′ = (p² − q²)/2 with q = a s + b t²/2.
        let (t2, t3) = (t * t, t * t * t);
        let squares = a * a * (s * c) + b * b * (t3 / T::lit(3.0) - t3 * t2 / T::lit(20.0));
        // ∫ (2ab t cos t − ab t² sin t) dt = ab t² cos t.
        element[2] = half * (squares + a * b * t2 * c);
        element[3] = p;
        element[4] = -half * (p * p + q * q);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn strips_of_trajectories_are_characteristic_and_driven_ones_only_monge(
        a in -2.0..2.0_f64, b in 0.1..2.0_f64, tau in -3.0..3.0_f64,
    ) {
        let oscillator = Particle::oscillator(1.0, 1.0, 1);
        let of = |b: f64, bend: f64| StripResidual::of(&oscillator, &Driven { a, b, bend }, tau).unwrap();
        let rounding = 1e-13 * (1.0 + a * a + b * b) * 30.0;
        prop_assert!(of(0.0, 0.0).characteristic() <= rounding, "{:?}", of(0.0, 0.0));
        let driven = of(b, 0.0);
        prop_assert!(driven.monge() <= rounding, "{driven:?}");
        // p′ + q t′ = (b + b t²/2) t′ with t′ = 1/2.
        let t = 0.5 * tau;
        assert_close("p′ + H_q t′", &driven.momentum, &[0.5 * (b + 0.5 * b * t * t)], Tol::stated(1e-12, "rounding"));
        // A strip whose q does not move with H_p is not Monge.
        let bent = of(0.0, b);
        assert_close("q′ − H_p t′", &bent.direction, &[0.5 * b], Tol::stated(1e-12, "rounding"));
    }
}

/// H = p₁²/2 + 3p₂²/2 + t q₁ + t² q₂.
struct Pulled;

impl PhaseFunction for Pulled {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        T::lit(0.5) * (p[0] * p[0] + T::lit(3.0) * p[1] * p[1]) + t * q[0] + t * t * q[1]
    }
}

/// W(12.4) by hand: q′ = (p₁, 3p₂), t′ = 1, U′ = p₁² + 3p₂² + `p_t`, p′ = −(t, t²) and `p_t′` = −(q₁ + 2t q₂).
#[test]
fn rates_of_a_characteristic_strip_in_a_field_that_depends_on_time_equal_those_by_hand() {
    let (q, p, t) = ([0.75, -1.25], [2.0, 0.5], 0.25);
    let start = CharacteristicStrip::<_>::start(&Pulled, &q, &p, t, 7.0).unwrap();
    let energy = 2.0 + 0.375 + 0.25 * 0.75 - 0.0625 * 1.25;
    assert_close("strip", &start, &[0.75, -1.25, 0.25, 7.0, 2.0, 0.5, -energy], Tol::ulps(2.0));
    let mut rate = [0.0; 7];
    CharacteristicStrip::new(&Pulled, 2).rate(0.0, &start, &mut rate).unwrap();
    let expected = [2.0, 1.5, 1.0, 4.0 + 0.75 - energy, -0.25, -0.0625, -(0.75 - 2.0 * 0.25 * 1.25)];
    assert_close("rates", &rate, &expected, Tol::ulps(2.0));
}
