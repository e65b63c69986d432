//! One formula, any scalar: derivatives, lanes and single precision.

use piola_lagrangian::{Forces, Holonomic, Lagrangian, Potential};
use piola_numerics::{Dual, Lanes};
use piola_testkit::{Tol, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use crate::any::{Law, for_all_systems};

struct Scalars;
impl Law for Scalars {
    fn check<S: Holonomic, P: Potential, F: Forces>(
        &self,
        name: &str,
        lagrangian: &Lagrangian<S, P, F>,
        q: &[f64],
        v: &[f64],
        t: f64,
    ) {
        let n = q.len();
        let expected = lagrangian.acceleration(q, v, t).unwrap();
        let size = expected.amax().max(10.0);

        // Along a direction in (q, q̇, t).
        let direction: Vec<f64> = (0..=2 * n).map(|i| 0.125 / (1.0 + i as f64)).collect();
        let along = |x: &[f64], d: &[f64]| -> Vec<_> { x.iter().zip(d).map(|(&x, &d)| Dual::new(x, d)).collect() };
        let exact = lagrangian
            .acceleration(&along(q, &direction[..n]), &along(v, &direction[n..2 * n]), Dual::new(t, direction[2 * n]))
            .unwrap();
        let exact: Vec<f64> = exact.iter().map(|a| a.tangent).collect();
        let at = |y: &[f64]| lagrangian.acceleration(&y[..n], &y[n..2 * n], y[2 * n]).unwrap().as_slice().to_vec();
        let rough = difference_quotient(at, &[q, v, &[t]].concat(), &direction);
        let tol = Tol::stated(1e-8, "sixth-order differences of a quotient");
        assert_close_at_scale(name, &exact, &rough, size, tol);

        let spread = |x: &[f64]| -> Vec<_> {
            x.iter().map(|&x| Lanes::<f64, 4>(core::array::from_fn(|lane| x + 0.01 * lane as f64))).collect()
        };
        let together = lagrangian.acceleration(&spread(q), &spread(v), Lanes::splat(t)).unwrap();
        for lane in 0..4 {
            let one = |x: &[f64]| -> Vec<f64> { x.iter().map(|x| x + 0.01 * lane as f64).collect() };
            let alone = lagrangian.acceleration(&one(q), &one(v), t).unwrap();
            let lane: Vec<f64> = together.iter().map(|a| a.0[lane]).collect();
            assert_close_at_scale(name, &lane, alone.as_slice(), size, Tol::ulps(4096.0));
        }

        #[expect(clippy::cast_possible_truncation, reason = "rounding to single precision is the point")]
        let single = |x: &[f64]| -> Vec<f32> { x.iter().map(|&x| x as f32).collect() };
        let (q32, v32, t32) = (single(q), single(v), single(&[t])[0]);
        let rounded: Vec<f64> =
            lagrangian.acceleration(&q32, &v32, t32).unwrap().iter().map(|&a| f64::from(a)).collect();
        assert_close_at_scale(name, &rounded, expected.as_slice(), size, Tol::ulps32(8192.0));
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]
    #[test]
    fn acceleration_over_duals_lanes_and_singles_equals_acceleration(
        q in piola_testkit::strategies::vector(6, -1.0..1.0),
        v in piola_testkit::strategies::vector(6, -2.0..2.0),
        t in piola_testkit::strategies::finite(-1.0..2.0),
    ) {
        for_all_systems(&Scalars, &q, &v, t);
    }
}
