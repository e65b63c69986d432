//! Integrals and symmetries of Kepler's problem and others, each way; integrals among candidates; trajectories.

use piola_hamiltonian::HamiltonianError;
use piola_hamiltonian::{
    Generator, HamiltonianField, OneParameterGroup, PhaseFunction, PhaseFunctions, PhasePoint, integral_of_symmetry,
    integral_test, integrals_among, involution_test, rate_along, symmetry_flow, time_derivative,
    trajectory_from_integrals,
};
use piola_integrators::{DormandPrince853, State, Tolerance};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};
use proptest::prelude::*;

use super::systems::{Kepler, PlaneMoment};

const KEPLER: Kepler = Kepler { mass: 1.5, strength: 2.0 };

fn tolerance() -> Tolerance {
    Tolerance::relative(1e-12).expect("a tolerance")
}

/// A component of the vector of Laplace, Runge and Lenz in the plane.
#[derive(Clone, Copy)]
struct Runge(usize);

impl PhaseFunction for Runge {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        let moment = PlaneMoment.value(q, p, t);
        let radius = (q[0] * q[0] + q[1] * q[1]).sqrt();
        let across = if self.0 == 0 { p[1] * moment } else { -p[0] * moment };
        across - T::lit(KEPLER.mass * KEPLER.strength) * q[self.0] / radius
    }
}

/// One function of each kind for properties.
enum Any {
    Energy,
    Moment,
    Runge(usize),
    Momentum,
    Mixed(f64),
}

impl PhaseFunction for Any {
    fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
        match *self {
            Self::Energy => KEPLER.value(q, p, t),
            Self::Moment => PlaneMoment.value(q, p, t),
            Self::Runge(i) => Runge(i).value(q, p, t),
            Self::Momentum => p[0],
            Self::Mixed(c) => p[0] * q[1] + T::lit(c) * q[0] * q[0] * p[1],
        }
    }
}

fn bound() -> impl Strategy<Value = PhasePoint> {
    (0.6..1.5_f64, -3.0..3.0_f64, 0.7..1.1_f64, -0.4..0.4_f64).prop_map(|(r, angle, share, radial)| {
        let (s, c) = angle.sin_cos();
        let across = KEPLER.mass * share * (KEPLER.strength / (KEPLER.mass * r)).sqrt();
        PhasePoint::new(&[r * c, r * s], &[radial * c - across * s, radial * s + across * c], 0.0).expect("numbers")
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    #[test]
    fn a_function_commutes_with_the_hamiltonian_exactly_where_its_flow_keeps_it(
        start in bound(), which in 0..6_usize, c in 0.2..1.0_f64,
    ) {
        let function = match which {
            0 => Any::Energy,
            1 => Any::Moment,
            2 => Any::Runge(0),
            3 => Any::Runge(1),
            4 => Any::Momentum,
            _ => Any::Mixed(c),
        };
        let points = [start.clone()];
        let test = integral_test(&function, &KEPLER, &points).unwrap();
        let flow = symmetry_flow(&function, &KEPLER, &start, 0.1, tolerance()).unwrap();
        let drift = flow.change_of_hamiltonian / flow.hamiltonian.abs().max(1.0);
        if which < 4 {
            // Rounding of brackets; and what the integration of the flow leaves.
            prop_assert!(test.passes(1e-13) && drift < 1e-10, "{test:?} {drift}");
        } else {
            // The flow changes H at the rate of the bracket.
            prop_assert!(!test.passes(1e-3) || drift < 1e-2);
            let short = symmetry_flow(&function, &KEPLER, &start, 1e-5, tolerance()).unwrap();
            let change = KEPLER.value(short.end.q(), short.end.p(), 0.0) - flow.hamiltonian;
            assert_close_at_scale("−{K, H} τ", &[change], &[-1e-5 * test.rate], 1e-5, Tol::stated(1e-3, "second order"));
        }
    }

    #[test]
    fn the_rotations_of_the_plane_have_the_angular_momentum_for_integral(from in bound(), to in bound()) {
        struct Rotation;
        impl OneParameterGroup for Rotation {
            fn act<T: Real>(&self, angle: T, q: &[T], p: &[T], new: &mut [T]) {
                let (s, c) = angle.sin_cos();
                for (old, new) in [q, p].into_iter().zip(new.chunks_exact_mut(2)) {
                    new[0] = c * old[0] - s * old[1];
                    new[1] = s * old[0] + c * old[1];
                }
            }
        }
        let found = integral_of_symmetry(&Generator(Rotation), &from, &to, tolerance()).unwrap();
        let moment = |point: &PhasePoint| PlaneMoment.value(point.q(), point.p(), 0.0);
        assert_close_at_scale("K", &[found.value], &[moment(&to) - moment(&from)], 4.0, Tol::ulps(40.0));
    }

    #[test]
    fn three_integrals_make_keplers_trajectory(start in bound()) {
        // A component of Runge's vector, nearly zero, is independent of E and L: the length of the vector is theirs.
        struct Three([f64; 2]);
        impl PhaseFunctions for Three {
            fn count(&self) -> usize {
                3
            }
            fn values<T: Real>(&self, q: &[T], p: &[T], t: T, out: &mut [T]) {
                let [x, y] = self.0.map(T::lit);
                let across = x * Runge(1).value(q, p, t) - y * Runge(0).value(q, p, t);
                out.copy_from_slice(&[KEPLER.value(q, p, t), PlaneMoment.value(q, p, t), across]);
            }
        }
        // Circles have no direction of the pericentre.
        let size = |i: usize| Runge(i).value(start.q(), start.p(), 0.0);
        prop_assume!(0.2 < size(0).hypot(size(1)));
        let times = [0.5, 1.0, 4.0, 9.0];
        let points = trajectory_from_integrals(&Three([size(0), size(1)]), &KEPLER, &start, &times, tolerance()).unwrap();
        let mut field = HamiltonianField::new(&KEPLER, 2);
        let mut state = State::new(0.0, [start.q(), start.p()].concat()).unwrap();
        for (time, point) in times.into_iter().zip(points) {
            DormandPrince853::new(tolerance()).integrate_to(&mut field, &mut state, time).unwrap();
            let found = [point.q(), point.p()].concat();
            assert_close("z(t)", &found, &state.values, Tol::stated(1e-8, "two integrations at 1e-12, some orbits long"));
            let energy = KEPLER.value(point.q(), point.p(), 0.0);
            let expected = KEPLER.value(start.q(), start.p(), 0.0);
            assert_close_at_scale("E", &[energy], &[expected], 3.0, Tol::ulps(40.0));
        }
    }
}

#[test]
fn a_symmetry_that_is_not_canonical_has_no_integral() {
    struct Scaling; // of coordinates alone
    impl OneParameterGroup for Scaling {
        fn act<T: Real>(&self, parameter: T, q: &[T], p: &[T], new: &mut [T]) {
            new[0] = q[0] * parameter.exp();
            new[1] = p[0];
        }
    }
    let (from, to) = (PhasePoint::new(&[1.0], &[2.0], 0.0).unwrap(), PhasePoint::new(&[2.0], &[3.0], 0.0).unwrap());
    let refused = integral_of_symmetry(&Generator(Scaling), &from, &to, tolerance()).unwrap_err();
    assert_eq!(refused, HamiltonianError::NotLocallyHamiltonian { residual: 1.0, relative: 1.0, row: 1, column: 0 });
}

/// The terms that the known integrals of Kepler's problem are made of, and some that are in none.
struct Terms;

impl PhaseFunctions for Terms {
    fn count(&self) -> usize {
        10
    }
    fn values<T: Real>(&self, q: &[T], p: &[T], _t: T, out: &mut [T]) {
        let radius = (q[0] * q[0] + q[1] * q[1]).sqrt();
        let moment = q[0] * p[1] - q[1] * p[0];
        out.copy_from_slice(&[
            p[0] * p[0] + p[1] * p[1],
            radius.recip(),
            q[0] * p[1],
            q[1] * p[0],
            p[1] * moment,
            q[0] / radius,
            p[0] * moment,
            q[1] / radius,
            q[0] * p[0] + q[1] * p[1],
            T::lit(3.0),
        ]);
    }
}

#[test]
fn energy_moment_and_runges_vector_are_found_among_their_terms() {
    let points: Vec<PhasePoint> = (0..40_i32)
        .map(|i| {
            let x = |k: f64| (k * f64::from(i) + 0.3 * k).sin();
            PhasePoint::new(&[1.5 * x(1.0), 0.2 + 1.2 * x(2.3)], &[x(3.1), x(4.7)], 0.0).unwrap()
        })
        .collect();
    let found = integrals_among(&Terms, &KEPLER, &points, 1e-11).unwrap();
    assert_eq!((found.coefficients.len(), &found.constants[..]), (4, &[9][..]));
    // Between what is an integral and what is none there is a gulf.
    let values = &found.singular_values;
    assert!(values[5] < 1e-13 * values[0] && 1e-3 * values[0] < values[4], "{values:?}");
    let ratio = |row: &[f64], a: usize, b: usize| row[a] / row[b];
    let mut seen = [false; 4];
    for row in &found.coefficients {
        let used: Vec<usize> = (0..10).filter(|&c| row[c] != 0.0).collect();
        let (which, actual, expected) = match used[..] {
            [0, 1] => (0, ratio(row, 1, 0), -2.0 * KEPLER.mass * KEPLER.strength),
            [2, 3] => (1, ratio(row, 3, 2), -1.0),
            [4, 5] => (2, ratio(row, 5, 4), -KEPLER.mass * KEPLER.strength),
            [6, 7] => (3, ratio(row, 7, 6), KEPLER.mass * KEPLER.strength),
            _ => panic!("{row:?}"),
        };
        assert_close("coefficients", &[actual], &[expected], Tol::stated(1e-12, "the null space of forty rows"));
        // One of both has the larger share, and the coefficient one.
        assert!(used.iter().any(|&c| (row[c] - 1.0).abs() <= f64::EPSILON), "{row:?}");
        seen[which] = true;
    }
    assert_eq!(seen, [true; 4]);
}

#[test]
fn four_integrals_of_keplers_plane_have_rank_three() {
    struct Four;
    impl PhaseFunctions for Four {
        fn count(&self) -> usize {
            4
        }
        fn values<T: Real>(&self, q: &[T], p: &[T], t: T, out: &mut [T]) {
            let vector = [Runge(0).value(q, p, t), Runge(1).value(q, p, t)];
            out.copy_from_slice(&[KEPLER.value(q, p, t), PlaneMoment.value(q, p, t), vector[0], vector[1]]);
        }
    }
    let point = PhasePoint::new(&[1.0, 0.3], &[-0.2, 1.3], 0.0).unwrap();
    let test = involution_test(&Four, &point).unwrap();
    assert_eq!(test.rank(1e-12), 3);
    // {L, A_x} = A_y and {A_x, A_y} = −2mE L.
    let (energy, moment) = (KEPLER.value(point.q(), point.p(), 0.0), PlaneMoment.value(point.q(), point.p(), 0.0));
    let second = Runge(1).value(point.q(), point.p(), 0.0);
    assert_close("{L, A_x}", &[test.brackets[1][2]], &[second], Tol::ulps(40.0));
    assert_close("{A_x, A_y}", &[test.brackets[2][3]], &[-2.0 * KEPLER.mass * energy * moment], Tol::ulps(40.0));
    // Integrals commute with H: terms of a few units cancel.
    assert!(test.brackets[0].iter().all(|bracket| bracket.abs() < 1e-14));
}

/// {½(q² + p²), q p} = q² − p², of terms whose magnitudes are q² and p².
#[test]
fn brackets_are_compared_with_the_magnitudes_of_their_terms() {
    struct Two;
    impl PhaseFunctions for Two {
        fn count(&self) -> usize {
            2
        }
        fn values<T: Real>(&self, q: &[T], p: &[T], _t: T, out: &mut [T]) {
            out.copy_from_slice(&[T::lit(0.5) * (q[0] * q[0] + p[0] * p[0]), q[0] * p[0]]);
        }
    }
    let point = PhasePoint::new(&[1.0], &[2.0], 0.0).unwrap();
    let test = involution_test(&Two, &point).unwrap();
    assert_eq!(test.pair, [1, 0]);
    assert_close("{qp, E}, {E, qp}", &[test.brackets[1][0], test.brackets[0][1]], &[3.0, -3.0], Tol::ulps(2.0));
    assert_close("share", &[test.relative], &[3.0 / 5.0], Tol::ulps(4.0));
}

#[test]
fn the_flow_of_an_integral_in_time_changes_the_hamiltonian_as_both_change_themselves() {
    /// An oscillator that is pushed evenly: H = ½(p² + q²) − t q.
    struct Pushed;
    impl PhaseFunction for Pushed {
        fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
            T::lit(0.5) * (p[0] * p[0] + q[0] * q[0]) - t * q[0]
        }
    }
    /// q − t obeys the free equation: its square and that of its rate p − 1 are kept together.
    struct Kept;
    impl PhaseFunction for Kept {
        fn value<T: Real>(&self, q: &[T], p: &[T], t: T) -> T {
            let (x, v) = (q[0] - t, p[0] - T::one());
            T::lit(0.5) * (x * x + v * v)
        }
    }
    for (q, p, t) in [(0.5, 2.0, 0.25), (-1.5, 0.5, 3.0)] {
        let point = [PhasePoint::new(&[q], &[p], t).unwrap()];
        assert!(integral_test(&Kept, &Pushed, &point).unwrap().passes(1e-15));
        let along = rate_along(&Pushed, &Kept, &[q], &[p], t).unwrap();
        let own = time_derivative(&Pushed, &[q], &[p], t).unwrap() + time_derivative(&Kept, &[q], &[p], t).unwrap();
        assert_close_at_scale("L_k H", &[along], &[own], 4.0, Tol::ulps(4.0));
    }
}
