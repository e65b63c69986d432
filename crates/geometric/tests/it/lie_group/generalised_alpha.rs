//! Generalised-α: damping, energy, stiff systems, many degrees of freedom.

use core::convert::Infallible;
use core::ops::ControlFlow;

use piola_geometric::{DirectProduct, GeneralisedAlpha, GroupMotion, RigidMotions, Rotations, Translations};
use piola_integrators::{IntegratorsError, State, Step};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_order};

use super::{Top, cross, reference};

/// Uncoupled oscillators ẍ = −ω² x.
struct Oscillators {
    group: Translations,
    frequencies: Vec<f64>,
}

impl Oscillators {
    fn new(frequencies: &[f64]) -> Self {
        Self { group: Translations(frequencies.len()), frequencies: frequencies.to_vec() }
    }
}

impl<T: Real> GroupMotion<T> for Oscillators {
    type Error = Infallible;
    type Group = Translations;
    fn group(&self) -> &Translations {
        &self.group
    }
    fn residual(&mut self, _t: f64, x: &[T], _v: &[T], rate: &[T], residual: &mut [T]) -> Result<(), Infallible> {
        for (i, omega) in self.frequencies.iter().enumerate() {
            residual[i] = rate[i] + T::lit(omega * omega) * x[i];
        }
        Ok(())
    }
}

/// The positions of an oscillator with ω h = `part` in steps of length one.
fn positions(radius: f64, part: f64, steps: u32) -> Vec<f64> {
    let mut state = State::new(0.0, vec![1.0, 0.25 * part]).unwrap();
    let mut found = vec![1.0];
    let mut oscillator = Oscillators::new(&[part]);
    let mut method = GeneralisedAlpha::new(radius, 1.0).unwrap();
    let observe = |step: Step<'_>| {
        found.push(step.values[0]);
        ControlFlow::Continue(())
    };
    method.integrate(&mut oscillator, &mut state, f64::from(steps), observe).unwrap();
    found
}

/// How well yₙ₊₃ + 3ρ yₙ₊₂ + 3ρ² yₙ₊₁ + ρ³ yₙ = 0 holds, relative to the largest of the four. By the theorem of Cayley and Hamilton it
/// does where the three eigenvalues of a step are −ρ.
fn residual_of_recurrence(y: &[f64], rho: f64) -> f64 {
    let residuals = y.windows(4).map(|y| {
        let sum = y[3] + 3.0 * rho * y[2] + 3.0 * rho * rho * y[1] + rho * rho * rho * y[0];
        sum.abs() / y.iter().fold(0.0_f64, |largest, x| largest.max(x.abs()))
    });
    residuals.fold(0.0, f64::max)
}

#[test]
fn spectral_radius_at_infinity_equals_the_one_asked_for() {
    let part = 1e4;
    let tol = Tol::stated(20.0 / (part * part), "the eigenvalues differ from −ρ∞ by (ωh)⁻², roundings are (ωh)² ulp");
    for radius in [0.0, 0.25, 0.5, 0.8, 0.9, 1.0] {
        let y = positions(radius, part, 12);
        // The first position is given, not one that a step has led to.
        let residual = residual_of_recurrence(&y[1..], radius);
        assert!(residual <= tol.value(), "{radius}: {residual:e}");
        // No other radius would do. Without damping positions alternate for so long that they could not tell.
        for other in [radius - 0.01, radius + 0.01] {
            let residual = residual_of_recurrence(&y[1..], other);
            assert!(1.0 <= radius || 1e-4 < residual, "{radius}, {other}: {residual:e}");
        }
    }
}

#[test]
fn linear_vibrations_stay_bounded_at_any_step() {
    for radius in [0.0, 0.3, 0.5, 0.8, 0.95] {
        for part in [0.1, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0] {
            // The amplitude at the start is √(1 + ¼²) = 1.03. Fast vibrations decay until they are no numbers any more.
            let y = positions(radius, part, 1000);
            let largest = y[900..].iter().fold(0.0_f64, |largest, x| largest.max(x.abs()));
            assert!(largest < if part < 100.0 { 1.04 } else { 1e-3 }, "{radius}, {part}: {largest:e}");
        }
    }
}

#[test]
fn energy_of_the_linear_oscillator_is_kept_to_rounding_without_damping() {
    for part in [0.01, 1.0, 100.0] {
        let energy = |y: &[f64]| 0.5 * (y[1] * y[1] + part * part * y[0] * y[0]);
        let start = State::new(0.0, vec![1.0, 0.5 * part]).unwrap();
        for mut method in [GeneralisedAlpha::new(1.0, 1.0).unwrap(), GeneralisedAlpha::newmark(1.0).unwrap()] {
            let mut state = start.clone();
            method.integrate_to(&mut Oscillators::new(&[part]), &mut state, 1000.0).unwrap();
            // A step of a fast oscillator is a small difference of large terms.
            let tol = Tol::ulps_because(256.0, "a thousand steps, whose roundings walk at random").times(part.max(1.0));
            assert_close("energy", &[energy(&state.values)], &[energy(&start.values)], tol);
        }
    }
}

/// A slow and a fast oscillator: in a hundred steps the fast one has vanished, the slow one has kept its energy to the error of
/// the method.
#[test]
fn fast_vibrations_vanish_and_slow_ones_stay() {
    let (slow, fast) = (1.0, 1e6);
    let mut system = Oscillators::new(&[slow, fast]);
    let start = State::new(0.0, vec![1.0, 1e-6, 0.0, 0.0]).unwrap();
    let energies = |y: &[f64]| [(y[2] * y[2] + y[0] * y[0]), (y[3] * y[3] + fast * fast * y[1] * y[1])];
    let mut state = start.clone();
    GeneralisedAlpha::new(0.5, 0.01).unwrap().integrate_to(&mut system, &mut state, 1.0).unwrap();
    let after = energies(&state.values);
    assert!(after[1] < 1e-40, "{after:?}");
    assert_close("slow", &after[..1], &[1.0], Tol::order(0.01, 2));
    assert_close("slow", &state.values[..1], &[1.0_f64.cos()], Tol::order(0.01, 2));
    // Without damping the fast one rings on.
    let mut state = start;
    GeneralisedAlpha::new(1.0, 0.01).unwrap().integrate_to(&mut system, &mut state, 1.0).unwrap();
    let tol = Tol::ulps(1.0).times((0.01 * fast) * (0.01 * fast));
    assert_close("fast", &energies(&state.values)[1..], &[1.0], tol);
}

#[test]
fn newmark_equals_generalised_alpha_without_damping() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let (mut one, mut other) = (start.clone(), start);
    GeneralisedAlpha::newmark(0.05).unwrap().integrate_to(&mut top, &mut one, 5.0).unwrap();
    GeneralisedAlpha::new(1.0, 0.05).unwrap().integrate_to(&mut top, &mut other, 5.0).unwrap();
    assert_close("Newmark", &one.values, &other.values, Tol::ulps(64.0));
}

/// The energy of the heavy top swings and does not drift over ten thousand steps.
#[test]
fn energy_of_the_heavy_top_is_bounded_without_damping() {
    let (mut top, start, _) = reference("heavy top, asymmetric");
    let watched = top.clone();
    let before = top.energy(&start.values);
    let (mut first, mut last) = (0.0_f64, 0.0_f64);
    let step = 0.05;
    let observe = |step: Step<'_>| {
        let change = (watched.energy(step.values) - before).abs();
        if step.number <= 1000 {
            first = first.max(change);
        } else if 9000 < step.number {
            last = last.max(change);
        }
        ControlFlow::Continue(())
    };
    let mut state = start.clone();
    let report = GeneralisedAlpha::new(1.0, step).unwrap().integrate(&mut top, &mut state, 500.0, observe).unwrap();
    assert_eq!(report.steps, 10_000);
    assert!(0.0 < last && last <= 1.5 * first, "{first:e} {last:e}");
    assert!(first <= 2.0 * step * step, "{first:e}");
}

/// A top beside five oscillators, in one group of dimension eight: three evaluations make its matrix.
struct Both {
    group: DirectProduct<Rotations, Translations>,
    top: Top,
    oscillators: Oscillators,
}

impl<T: Real> GroupMotion<T> for Both {
    type Error = Infallible;
    type Group = DirectProduct<Rotations, Translations>;
    fn group(&self) -> &Self::Group {
        &self.group
    }
    fn residual(&mut self, t: f64, q: &[T], v: &[T], rate: &[T], residual: &mut [T]) -> Result<(), Infallible> {
        self.top.residual(t, &q[..4], &v[..3], &rate[..3], &mut residual[..3])?;
        self.oscillators.residual(t, &q[4..], &v[3..], &rate[3..], &mut residual[3..])
    }
}

#[test]
fn two_systems_in_one_group_move_as_each_alone() {
    let frequencies = [1.0, 2.0, 30.0, 0.5, 4.0];
    let (top, start, _) = reference("heavy top, asymmetric");
    let (x, v) = ([1.0, -0.5, 0.01, 2.0, 0.0], [0.0, 0.25, 0.5, 0.0, 1.0]);
    let oscillators = Oscillators::new(&frequencies);
    let mut both = Both { group: DirectProduct(Rotations, Translations(5)), top, oscillators };
    let values = [&start.values[..4], &x, &start.values[4..], &v].concat();
    let mut state = State::new(0.0, values).unwrap();
    let mut method = GeneralisedAlpha::new(0.6, 0.0625).unwrap();
    let report = method.integrate_to(&mut both, &mut state, 3.0).unwrap();
    assert!(report.evaluations.is_multiple_of(2) && 4 * report.steps <= report.evaluations, "{report:?}");
    let mut alone = start;
    method.integrate_to(&mut both.top, &mut alone, 3.0).unwrap();
    let found = [&state.values[..4], &state.values[9..12]].concat();
    assert_close("top", &found, &alone.values, Tol::ulps(64.0));
    let mut alone = State::new(0.0, [x, v].concat()).unwrap();
    method.integrate_to(&mut both.oscillators, &mut alone, 3.0).unwrap();
    let found = [&state.values[4..9], &state.values[12..]].concat();
    // The accelerations of the fastest are known to an ulp of ω² x alone.
    assert_close(
        "oscillators",
        &found,
        &alone.values,
        Tol::ulps_because(256.0, "an oscillator with ω h = 2 among them"),
    );
}

/// A free body on SE(3), about a point that is not its centre of mass: the mass matrix couples v̇ and ω̇.
struct Eccentric;

const MASS: f64 = 2.0;
/// The centre of mass in the body.
const CENTRE: [f64; 3] = [0.25, -0.5, 0.125];
/// The inertia about the centre of mass.
const INERTIA: [f64; 3] = [1.0, 2.0, 3.0];

impl<T: Real> GroupMotion<T> for Eccentric {
    type Error = Infallible;
    type Group = RigidMotions;
    fn group(&self) -> &RigidMotions {
        &RigidMotions
    }
    fn residual(&mut self, _t: f64, _g: &[T], v: &[T], rate: &[T], residual: &mut [T]) -> Result<(), Infallible> {
        let three = |x: &[T]| [x[0], x[1], x[2]];
        let (omega, v, alpha, a) = (three(v), three(&v[3..]), three(rate), three(&rate[3..]));
        let c = CENTRE.map(T::lit);
        // The acceleration of the centre of mass: v̇ + ω × v + ω̇ × c + ω × (ω × c) = 0.
        let (first, second, third) = (cross(omega, v), cross(alpha, c), cross(omega, cross(omega, c)));
        let force: [T; 3] = core::array::from_fn(|i| T::lit(MASS) * (a[i] + first[i] + second[i] + third[i]));
        // The moment about the reference point: J ω̇ + ω × J ω + c × m a_c = 0.
        let momentum: [T; 3] = core::array::from_fn(|i| T::lit(INERTIA[i]) * omega[i]);
        let (gyroscopic, arm) = (cross(omega, momentum), cross(c, force));
        for i in 0..3 {
            residual[i] = T::lit(INERTIA[i]) * alpha[i] + gyroscopic[i] + arm[i];
            residual[3 + i] = force[i];
        }
        Ok(())
    }
}

#[test]
fn free_body_about_an_eccentric_point_tumbles_as_about_its_centre() {
    let (_, start, states) = reference("free asymmetric top");
    let (t, expected) = &states[1];
    let omega = [start.values[4], start.values[5], start.values[6]];
    // The centre of mass rests.
    let v = cross(CENTRE, omega);
    let steps = [0.05, 0.02, 0.01, 0.005];
    let errors = steps.map(|h| {
        let origin = CENTRE.map(|x| -x);
        let mut state = State::new(0.0, [&start.values[..4], &origin, &omega, &v].concat()).unwrap();
        GeneralisedAlpha::new(0.8, h).unwrap().integrate_to(&mut Eccentric, &mut state, *t).unwrap();
        let y = &state.values;
        // x + R c = 0.
        let u = [y[1], y[2], y[3]];
        let twice = cross(u, CENTRE).map(|x| 2.0 * x);
        let beside = cross(u, twice);
        let centre = (0..3).map(|i| y[4 + i] + CENTRE[i] + y[0] * twice[i] + beside[i]);
        let attitude = (0..4).map(|i| y[i] - expected[i]);
        centre.chain(attitude).fold(0.0_f64, |largest, x| largest.max(x.abs()))
    });
    assert_order("eccentric", &steps, &errors, 2.0, 0.1);
    assert!(errors[3] < 1e-4);
}

#[test]
fn singular_mass_and_wrong_radii_are_refused() {
    struct Massless;
    impl<T: Real> GroupMotion<T> for Massless {
        type Error = Infallible;
        type Group = Rotations;
        fn group(&self) -> &Rotations {
            &Rotations
        }
        fn residual(&mut self, _t: f64, _q: &[T], v: &[T], rate: &[T], out: &mut [T]) -> Result<(), Infallible> {
            out.copy_from_slice(&[rate[0] + v[0], rate[1] + v[1], v[2]]);
            Ok(())
        }
    }
    let start = State::new(0.5, vec![1.0, 0.0, 0.0, 0.0, 1.0, 2.0, 3.0]).unwrap();
    let mut state = start.clone();
    let error = GeneralisedAlpha::new(0.8, 0.1).unwrap().integrate_to(&mut Massless, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::SingularMatrix { pivot: 2, .. }), "{error:?}");
    assert_eq!(state, start);
    for radius in [-0.1, 1.1, f64::NAN, f64::INFINITY] {
        let refused = GeneralisedAlpha::<f64>::new(radius, 0.1);
        assert!(matches!(refused, Err(IntegratorsError::InvalidDamping { .. })), "{radius}");
    }
    for step in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(GeneralisedAlpha::<f64>::new(0.8, step), Err(IntegratorsError::InvalidStep { .. })));
        assert!(matches!(GeneralisedAlpha::<f64>::newmark(step), Err(IntegratorsError::InvalidStep { .. })));
    }
}

/// A step of (0.1 s)² 10⁵ s⁻² = 10³ has two solutions or none: the iteration says so where it finds none.
#[test]
fn iteration_without_a_solution_is_refused() {
    struct Quadratic;
    impl<T: Real> GroupMotion<T> for Quadratic {
        type Error = Infallible;
        type Group = Translations;
        fn group(&self) -> &Translations {
            &Translations(1)
        }
        fn residual(&mut self, _t: f64, x: &[T], _v: &[T], rate: &[T], out: &mut [T]) -> Result<(), Infallible> {
            out[0] = rate[0] - T::lit(1e5) * (x[0] * x[0] + T::one());
            Ok(())
        }
    }
    let start = State::new(0.0, vec![0.0, 0.0]).unwrap();
    let mut state = start.clone();
    let error = GeneralisedAlpha::new(0.8, 0.1).unwrap().integrate_to(&mut Quadratic, &mut state, 1.0).unwrap_err();
    assert!(matches!(error, IntegratorsError::StagesDiverged { iterations: 30, .. }), "{error:?}");
    assert_eq!(state, start);
}
