//! Identities of brackets and of the Legendre map, and their invariance under random canonical maps.

use piola_dynamics::hamiltonian::{
    Bracket, Composed, HamiltonianField, Inverse, LegendreTransform, PhaseFunction, PhaseMap, PulledBack,
    TransformedHamiltonian, canonical_test, poisson_bracket, rate_along, time_derivative,
};
use piola_dynamics::lagrangian::{Lagrangian, Workspace};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::{Lanes, Real};
use piola_testkit::{Tol, assert_close_at_scale, difference_quotient};
use proptest::prelude::*;

use super::systems::{AnyFunction, Relativistic, any_function, any_map, any_point};

/// The terms of the brackets below are sums of some tens of products of numbers up to a few units.
const SCALE: f64 = 30.0;

struct Product<'a>(&'a AnyFunction, &'a AnyFunction);

impl PhaseFunction for Product<'_> {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        self.0.value(q, p, t) * self.1.value(q, p, t)
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn the_bracket_is_skew_to_the_last_bit(k in any_function(), h in any_function(), (q, p) in any_point()) {
        let there = poisson_bracket(&k, &h, &q, &p, 0.3).unwrap();
        let back = poisson_bracket(&h, &k, &q, &p, 0.3).unwrap();
        prop_assert!((there + back).abs() <= 0.0);
        prop_assert!(poisson_bracket(&h, &h, &q, &p, 0.3).unwrap().abs() <= 0.0);
    }

    #[test]
    fn the_bracket_is_a_derivation(
        k in any_function(), l in any_function(), m in any_function(), (q, p) in any_point(),
    ) {
        let bracket = |a: &AnyFunction, b: &AnyFunction| poisson_bracket(a, b, &q, &p, 0.3).unwrap();
        let product = poisson_bracket(&Product(&k, &l), &m, &q, &p, 0.3).unwrap();
        let parts = k.value(&q, &p, 0.3) * bracket(&l, &m) + bracket(&k, &m) * l.value(&q, &p, 0.3);
        assert_close_at_scale("{K L, M}", &[product], &[parts], SCALE, Tol::ulps(20.0));
    }

    #[test]
    fn nested_brackets_obey_jacobis_identity(
        k in any_function(), l in any_function(), m in any_function(), (q, p) in any_point(),
    ) {
        let nested = |a: &AnyFunction, b: &AnyFunction, c: &AnyFunction| {
            poisson_bracket(a, &Bracket(b, c), &q, &p, 0.3).unwrap()
        };
        let sum = nested(&k, &l, &m) + nested(&l, &m, &k) + nested(&m, &k, &l);
        assert_close_at_scale("Jacobi", &[sum], &[0.0], 10.0 * SCALE, Tol::ulps(10.0));
    }

    #[test]
    fn brackets_through_a_canonical_map_are_brackets_at_the_image(
        k in any_function(),
        h in any_function(),
        q in prop::array::uniform2(-0.8..0.8_f64),
        p in prop::array::uniform2(-0.8..0.8_f64),
        map in any_map(),
    ) {
        let mut image = [0.0; 4];
        map.map(&q, &p, 0.3, &mut image).unwrap();
        let through = poisson_bracket(
            &PulledBack { function: &k, map }, &PulledBack { function: &h, map }, &q, &p, 0.3,
        ).unwrap();
        let at_image = poisson_bracket(&k, &h, &image[..2], &image[2..], 0.3).unwrap();
        // The image may be some times as far out, and the functions have cubic terms and an exponential.
        let size = 1.0 + image.iter().map(|x| x.abs()).fold(0.0, f64::max);
        assert_close_at_scale("{K, H}∘φ", &[through], &[at_image], SCALE * size.powi(5) * (0.25 * size * size).exp(), Tol::ulps(20.0));
    }

    #[test]
    fn random_canonical_maps_their_compositions_and_inverses_keep_the_symplectic_form(
        (q, p) in any_point(), first in any_map(), second in any_map(),
    ) {
        // Entries of a Jacobian that nearly vanish are rounding of what they are differences of.
        prop_assert!(canonical_test(&first, &q, &p, 0.0).unwrap().relative < 1e-9);
        let both = Composed(first, second);
        prop_assert!(canonical_test(&both, &q, &p, 0.0).unwrap().relative < 1e-9);
        prop_assert!(canonical_test(&Inverse(&both), &q, &p, 0.0).unwrap().relative < 1e-9);
        let (mut there, mut back) = ([0.0; 4], [0.0; 4]);
        both.map(&q, &p, 0.0, &mut there).unwrap();
        Inverse(&both).map(&there[..2], &there[2..], 0.0, &mut back).unwrap();
        let size = there.iter().map(|x| x.abs()).fold(1.0, f64::max);
        assert_close_at_scale("φ⁻¹∘φ", &back, &[q[0], q[1], p[0], p[1]], size * size * size, Tol::ulps(100.0));
    }

    #[test]
    fn lanes_give_the_brackets_of_each_lane(k in any_function(), h in any_function(), (q, p) in any_point()) {
        let spread = |x: f64| Lanes::<f64, 4>::load(&[x, x + 0.125, x + 0.25, x + 0.375], x);
        let t = Lanes::lit(0.3);
        let lanes = poisson_bracket(&k, &h, &q.map(spread), &p.map(spread), t).unwrap();
        for lane in 0..4 {
            let at = |x: [f64; 2]| x.map(|x| spread(x).primal(lane));
            let alone = poisson_bracket(&k, &h, &at(q), &at(p), 0.3).unwrap();
            assert_close_at_scale("lane", &[lanes.primal(lane)], &[alone], SCALE, Tol::ulps(20.0));
        }
    }

    #[test]
    fn velocities_of_the_momenta_of_velocities_are_the_velocities(
        q in prop::array::uniform2(-1.0..1.0_f64), v in prop::array::uniform2(-0.65..0.65_f64), t in 0.0..5.0_f64,
    ) {
        let particle = Lagrangian::from_function(Relativistic { wobble: 0.5 });
        let p = particle.momenta(&q, &v, t).unwrap();
        let mut back = [0.0; 2];
        particle.velocities_into(&mut Workspace::default(), &q, p.as_slice(), t, &mut back).unwrap();
        // ∂v/∂p is at most one.
        assert_close_at_scale("v", &back, &v, 1.0, Tol::ulps(20.0));
        let certificate = particle.legendre_certificate(&q, &back, p.as_slice(), t).unwrap();
        // Newton's iteration ends where its corrections are made of rounding.
        assert!(certificate.residual < 1e-14 && certificate.correction < 1e-14, "{certificate:?}");
        // H = γ (1 + γ² v v): the second pivot over its entry is (1 − v²)/((1 − v₁²)(1 − v₂²)), at least 0.46.
        let squares = v.map(|v| v * v);
        let pivot = (1.0 - squares[0] - squares[1]) / ((1.0 - squares[0]) * (1.0 - squares[1]));
        assert_close_at_scale("pivot", &[certificate.smallest_pivot], &[pivot], 1.0, Tol::ulps(64.0));
        let hamiltonian = LegendreTransform(&particle);
        let expected = (1.0 + p.norm_squared()).sqrt() + 0.5 * (1.0 + 0.5 * t.sin()) * (q[0] * q[0] + q[1] * q[1]);
        let value = hamiltonian.value(&q, p.as_slice(), t);
        assert_close_at_scale("H", &[value], &[expected], expected, Tol::ulps(8.0));
        let growth = time_derivative(&hamiltonian, &q, p.as_slice(), t).unwrap();
        let expected = 0.25 * t.cos() * (q[0] * q[0] + q[1] * q[1]);
        assert_close_at_scale("∂H/∂t", &[growth], &[expected], 1.0, Tol::ulps(20.0));
        let loss = particle.time_derivative(&q, &v, t).unwrap();
        assert_close_at_scale("∂H/∂t = −∂L/∂t", &[growth], &[-loss], 1.0, Tol::ulps(20.0));
    }

    #[test]
    fn the_rate_of_a_function_along_the_motion_is_its_difference_quotient(
        k in any_function(), h in any_function(), (q, p) in any_point(),
    ) {
        let rate = rate_along(&k, &h, &q, &p, 0.3).unwrap();
        let along = |time: f64| {
            let mut field = HamiltonianField::new(&h, 2);
            let mut state = State::new(0.3, [q, p].concat()).unwrap();
            DormandPrince853::new(Tolerance::relative(1e-13).unwrap())
                .integrate_to(&mut field, &mut state, 0.3 + time)
                .unwrap();
            let (q, p) = state.values.split_at(2);
            k.value(q, p, 0.3 + time)
        };
        let quotient = difference_quotient(|x| vec![along(x[0])], &[0.0], &[1.0]);
        assert_close_at_scale("dK/dt", &quotient, &[rate], SCALE, Tol::stated(1e-7, "a quotient of differences"));
    }
}

#[test]
fn motions_of_a_hamiltonian_through_a_map_are_motions_of_the_new_hamiltonian() {
    let (q, p) = ([0.3, -0.7], [0.5, 0.2]);
    let hamiltonian = AnyFunction([0.3, -0.2, 0.5, 0.4, 0.1, 0.25, 0.3]);
    let map = super::systems::AnyMap([0.3, -0.2, 0.4, 0.1, 0.6, -0.3]);
    let run = |hamiltonian: &dyn Fn(&mut State), start: Vec<f64>| {
        let mut state = State::new(0.0, start).unwrap();
        hamiltonian(&mut state);
        state.values
    };
    let tolerance = || Tolerance::relative(1e-13).unwrap();
    let old = run(
        &|state| {
            let mut field = HamiltonianField::new(&hamiltonian, 2);
            DormandPrince853::new(tolerance()).integrate_to(&mut field, state, 2.0).map(|_| ()).unwrap();
        },
        [q, p].concat(),
    );
    let (mut start, mut expected) = ([0.0; 4], [0.0; 4]);
    map.map(&q, &p, 0.0, &mut start).unwrap();
    map.map(&old[..2], &old[2..], 2.0, &mut expected).unwrap();
    let new = run(
        &|state| {
            let seen = TransformedHamiltonian { hamiltonian: &hamiltonian, map };
            let mut field = HamiltonianField::new(&seen, 2);
            DormandPrince853::new(tolerance()).integrate_to(&mut field, state, 2.0).map(|_| ()).unwrap();
        },
        start.to_vec(),
    );
    assert_close_at_scale("φ(motion)", &new, &expected, 1.0, Tol::stated(1e-11, "two integrations at 1e-13"));
}
