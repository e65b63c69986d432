//! Generating functions of every kind, under identities, and contact transformations in time.

use piola_hamiltonian::{
    Composed, DegenerateGenerated, Generated, GeneratingFunction, GeneratingKind, HamiltonianField, Identities,
    Inverse, InvertedByNewton, PhaseFunction, PhaseMap, PointTransformation, RotatingFrame, TransformedHamiltonian,
    canonical_test, contact_test,
};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_lagrangian::ChangeOfCoordinates;
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::{AnyFunction, any_point};

/// a·b + ε g(a, b, t), a function that any kind can take: the mixed derivatives are near one.
#[derive(Clone, Copy, Debug)]
struct NearIdentity([f64; 4]);

impl GeneratingFunction for NearIdentity {
    fn value<T: Real>(&self, a: &[T], b: &[T], t: T) -> T {
        let c = self.0.map(T::lit);
        a[0] * b[0]
            + a[1] * b[1]
            + c[0] * (a[0] + b[1]).sin()
            + c[1] * a[0] * a[0] * b[0]
            + c[2] * (a[1] * b[0]).cos() * (T::one() + t)
            + c[3] * b[1] * b[1] * (a[1] + t)
    }
}

/// Entries of a Jacobian that are differences themselves may nearly vanish; what is left of their rounding then looms.
const DIFFERENCES: f64 = 1e-9;

const KINDS: [GeneratingKind; 5] = [
    GeneratingKind::Text,
    GeneratingKind::First,
    GeneratingKind::Second,
    GeneratingKind::Third,
    GeneratingKind::Fourth,
];

fn coefficients() -> impl Strategy<Value = [f64; 4]> {
    prop::array::uniform4(-0.06..0.06_f64)
}

/// The argument that the kind seeks is near one of q, p, −q, −p.
fn guess(kind: GeneratingKind, q: [f64; 2], p: [f64; 2]) -> [f64; 2] {
    match kind {
        GeneratingKind::Text => p.map(|p| -p),
        GeneratingKind::First | GeneratingKind::Second => p,
        GeneratingKind::Third | GeneratingKind::Fourth => q.map(|q| -q),
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn generating_functions_of_every_kind_make_contact_transformations(
        c in coefficients(), (q, p) in any_point(), t in 0.0..1.0_f64,
    ) {
        for kind in KINDS {
            let map = Generated::new(NearIdentity(c), kind, &guess(kind, q, p));
            let test = contact_test(&map, &q, &p, t).unwrap();
            prop_assert!(test.relative < DIFFERENCES, "{kind:?}: {test:?}");
        }
    }

    #[test]
    fn the_way_back_of_every_kind_leads_back(c in coefficients(), (q, p) in any_point()) {
        for kind in KINDS {
            let mut new = [0.0; 4];
            Generated::new(NearIdentity(c), kind, &guess(kind, q, p)).map(&q, &p, 0.25, &mut new).unwrap();
            // Backwards the old argument is sought: from zero.
            let back = Generated::new(NearIdentity(c), kind, &[0.0; 2]);
            let mut old = [0.0; 4];
            Inverse(&back).map(&new[..2], &new[2..], 0.25, &mut old).unwrap();
            assert_close_at_scale(&format!("{kind:?}"), &old, &[q[0], q[1], p[0], p[1]], 1.0, Tol::ulps(30.0));
        }
    }

    #[test]
    fn the_texts_kind_is_the_first_with_the_other_sign(c in coefficients(), (q, p) in any_point()) {
        struct Opposite(NearIdentity);
        impl GeneratingFunction for Opposite {
            fn value<T: Real>(&self, a: &[T], b: &[T], t: T) -> T {
                -self.0.value(a, b, t)
            }
        }
        let first = Generated::new(NearIdentity(c), GeneratingKind::First, &p);
        let text = Generated::new(Opposite(NearIdentity(c)), GeneratingKind::Text, &p);
        let (mut one, mut other) = ([0.0; 4], [0.0; 4]);
        first.map(&q, &p, 0.25, &mut one).unwrap();
        text.map(&q, &p, 0.25, &mut other).unwrap();
        assert_close("(Q, P)", &one, &other, Tol::ulps(4.0));
        let excess = (first.excess(&q, &p, 0.25).unwrap(), text.excess(&q, &p, 0.25).unwrap());
        assert_close_at_scale("F", &[excess.0], &[excess.1], 1.0, Tol::ulps(4.0));
    }

    #[test]
    fn one_identity_of_two_leaves_a_transformation_of_the_rest(
        (q, p) in any_point(), angle in 0.4..2.5_f64,
    ) {
        // Q₁ = q₁ + ¼ t by an identity; the second pair turns by the function of a rotation.
        struct Turn(f64);
        impl GeneratingFunction for Turn {
            fn value<T: Real>(&self, q: &[T], new: &[T], _t: T) -> T {
                let (s, c) = T::lit(self.0).sin_cos();
                ((q[1] * q[1] + new[1] * new[1]) * c - T::lit(2.0) * q[1] * new[1]) / (T::lit(-2.0) * s)
            }
        }
        struct Drift;
        impl Identities for Drift {
            fn count(&self) -> usize {
                1
            }
            fn values<T: Real>(&self, q: &[T], new: &[T], t: T, out: &mut [T]) {
                out[0] = q[0] + T::lit(0.25) * t - new[0];
            }
        }
        let map = DegenerateGenerated::new(Turn(angle), Drift, &[0.0; 2], &[0.0]);
        let t = 0.5;
        let mut new = [0.0; 4];
        map.map(&q, &p, t, &mut new).unwrap();
        let (s, c) = angle.sin_cos();
        let expected = [q[0] + 0.25 * t, q[1] * c - p[1] * s, p[0], q[1] * s + p[1] * c];
        assert_close_at_scale("(Q, P)", &new, &expected, 1.0 + 1.0 / s.abs(), Tol::ulps(20.0));
        prop_assert!(contact_test(&map, &q, &p, t).unwrap().relative < DIFFERENCES);
        // F = −λ ∂Ω/∂t with λ = −p₁.
        assert_close("F", &[map.excess(&q, &p, t).unwrap()], &[0.25 * p[0]], Tol::ulps(8.0));
    }

    #[test]
    fn turning_frames_compositions_and_moving_coordinates_are_contact_transformations(
        (q, p) in any_point(), rate in -2.0..2.0_f64, t in 0.0..1.0_f64,
    ) {
        struct Lifted; // the coordinates themselves bend and move
        impl ChangeOfCoordinates<2> for Lifted {
            const TIME_DEPENDENT: bool = true;
            fn old_coordinates<T: Real>(&self, new: &[T], t: T) -> [T; 2] {
                [T::lit(2.0) * new[0] + new[1].sin() * t, T::lit(3.0) * new[1] + t * t + T::lit(0.2) * new[0]]
            }
        }
        let frame = RotatingFrame::new(rate).unwrap();
        let both = Composed(frame, PointTransformation::new(Lifted, [0.0; 2]));
        for test in [contact_test(&frame, &q, &p, t).unwrap(), contact_test(&both, &q, &p, t).unwrap()] {
            prop_assert!(test.relative < DIFFERENCES, "{test:?}");
        }
        prop_assert!(contact_test(&Inverse(&both), &q, &p, t).unwrap().relative < DIFFERENCES);
    }
}

#[test]
fn motions_through_a_contact_transformation_obey_the_new_hamiltonian() {
    let hamiltonian = AnyFunction([0.3, -0.2, 0.5, 0.4, 0.1, 0.25, 0.3]);
    let (q, p) = ([0.3, -0.7], [0.5, 0.2]);
    let generated = Generated::new(NearIdentity([0.05, -0.04, 0.06, 0.03]), GeneratingKind::Second, &[0.0; 2]);
    let tolerance = || Tolerance::relative(1e-12).unwrap();
    let follow = |start: Vec<f64>, field: &mut dyn FnMut(&mut State)| {
        let mut state = State::new(0.0, start).unwrap();
        field(&mut state);
        state.values
    };
    let old = follow([q, p].concat(), &mut |state| {
        let mut field = HamiltonianField::new(&hamiltonian, 2);
        DormandPrince853::new(tolerance()).integrate_to(&mut field, state, 1.0).map(drop).unwrap();
    });
    let (mut start, mut expected) = ([0.0; 4], [0.0; 4]);
    generated.map(&q, &p, 0.0, &mut start).unwrap();
    generated.map(&old[..2], &old[2..], 1.0, &mut expected).unwrap();
    let seen = TransformedHamiltonian { hamiltonian: &hamiltonian, map: &generated };
    let new = follow(start.to_vec(), &mut |state| {
        let mut field = HamiltonianField::new(&seen, 2);
        DormandPrince853::new(tolerance()).integrate_to(&mut field, state, 1.0).map(drop).unwrap();
    });
    assert_close("φ(motion)", &new, &expected, Tol::stated(1e-10, "two integrations at 1e-12"));
    // Without F the motion would be another: the transformation depends on time.
    let at = (&start[..2], &start[2..]);
    assert!(1e-3 < (seen.value(at.0, at.1, 0.0) - hamiltonian.value(&q, &p, 0.0)).abs());
}

#[test]
fn the_action_of_an_oscillator_generates_its_equilibrium() {
    // W = −U, U the action of the motion from Q to q in the time t: new variables are the initial ones and stay.
    struct Minus; // m = ω = 1; the text's kind
    impl GeneratingFunction for Minus {
        fn value<T: Real>(&self, q: &[T], new: &[T], t: T) -> T {
            let (s, c) = t.sin_cos();
            -((q[0] * q[0] + new[0] * new[0]) * c - T::lit(2.0) * q[0] * new[0]) / (T::lit(2.0) * s)
        }
    }
    struct Oscillator;
    impl PhaseFunction for Oscillator {
        fn value<T: Real>(&self, q: &[T], p: &[T], _t: T) -> T {
            T::lit(0.5) * (p[0] * p[0] + q[0] * q[0])
        }
    }
    let map = Generated::new(Minus, GeneratingKind::Text, &[0.0]);
    let (q0, p0) = (0.75, -1.25_f64);
    for time in [0.5, 1.0, 2.0] {
        let (s, c) = f64::sin_cos(time);
        let (q, p) = ([q0 * c + p0 * s], [p0 * c - q0 * s]);
        let mut new = [0.0; 2];
        map.map(&q, &p, time, &mut new).unwrap();
        // The text's P has the sign of ∂W/∂Q = −∂U/∂Q = p₀.
        assert_close("(Q, P)", &new, &[q0, p0], Tol::ulps(16.0));
        // H + F = 0: the new Hamiltonian vanishes, W(11.18).
        let balance = Oscillator.value(&q, &p, time) + map.excess(&q, &p, time).unwrap();
        assert_close_at_scale("H + F", &[balance], &[0.0], 1.0, Tol::ulps(16.0));
    }
}

#[test]
fn any_map_is_inverted_by_newton() {
    let map = super::systems::AnyMap([0.3, -0.2, 0.4, 0.1, 0.6, -0.3]);
    let inverted = InvertedByNewton { map, guess: vec![0.0; 4] };
    let (q, p) = ([0.3, -0.7], [0.5, 0.2]);
    let (mut new, mut old, mut by_hand) = ([0.0; 4], [0.0; 4], [0.0; 4]);
    map.map(&q, &p, 0.0, &mut new).unwrap();
    Inverse(&inverted).map(&new[..2], &new[2..], 0.0, &mut old).unwrap();
    Inverse(map).map(&new[..2], &new[2..], 0.0, &mut by_hand).unwrap();
    assert_close("φ⁻¹", &old, &by_hand, Tol::ulps(8.0));
    // Some fifty ulp of the entries of J, which four maps make.
    assert!(canonical_test(&Inverse(&inverted), &new[..2], &new[2..], 0.0).unwrap().relative < 1e-14);
}
