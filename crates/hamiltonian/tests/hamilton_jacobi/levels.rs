//! Levels of solutions in the space of events, and Huygens' principle where H depends on time.

use piola_hamiltonian::PhaseFunction;
use piola_hamiltonian::hamilton_jacobi::{Event, LevelPoint, PrincipalFunction, Transversals};
use piola_hamiltonian::{HamiltonJacobiError, HamiltonianError};
use piola_numerics::Real;
use piola_testkit::{Tol, assert_close, assert_close_at_scale};

use super::systems::{Bowl, ShakenPendulum};

/// H = |p|²/(2 (1 + t)²): the geodetic distance is |q − q₀|²/(2 A), A = 1/(1 + t₀) − 1/(1 + t).
#[derive(Debug)]
struct Slowing;

impl PhaseFunction for Slowing {
    fn value<T: Real>(&self, _q: &[T], p: &[T], t: T) -> T {
        let rate = (T::one() + t).recip();
        p.iter().fold(T::zero(), |sum, &p| sum + p * p) * T::lit(0.5) * rate * rate
    }
}

/// U = Σ (1 − i/4) qᵢ + 0.15 |q|² − 0.5 t + 0.1 t².
#[derive(Debug)]
struct Curved;

impl PrincipalFunction for Curved {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        let mut sum = (T::lit(0.1) * t - T::lit(0.5)) * t;
        for (i, &q) in (0_u8..).zip(q) {
            sum += T::lit(1.0 - 0.25 * f64::from(i)) * q + T::lit(0.15) * q * q;
        }
        sum
    }
}

/// The slopes of [`Curved`] by q and t, by hand.
fn slopes(q: &[f64], t: f64) -> (Vec<f64>, f64) {
    ((0_u8..).zip(q).map(|(i, q)| 1.0 - 0.25 * f64::from(i) + 0.3 * q).collect(), 0.2 * t - 0.5)
}

const TIGHT: Tol = Tol::stated(1e-10, "a hundred times the tolerance of the integration");

#[test]
fn events_of_the_envelope_touch_the_closed_geodetic_distance_of_a_hamiltonian_that_depends_on_time() {
    let mut compared = 0;
    for n in [1_u8, 2, 3, 5] {
        for t0 in [0.0, 0.3] {
            let q0: Vec<f64> = (0..n).map(|i| 0.4 - 0.3 * f64::from(i)).collect();
            let (u_q, u_t) = slopes(&q0, t0);
            let rate = (1.0 + t0).powi(-2);
            let square: f64 = u_q.iter().map(|u| u * u).sum();
            // −½ a λ² |U_q|² = λ U_t.
            let scale = -2.0 * u_t / (rate * square);
            let momenta: Vec<f64> = u_q.iter().map(|u| scale * u).collect();
            let whole = 0.5 * scale * scale * square / (1.0 + t0);
            for share in [0.1, 0.5] {
                let increment = share * whole;
                let transversals = Transversals::of_manifold(&Slowing, &Curved, 1.0);
                let foot = Event::new(&q0, t0);
                let start = transversals.start(&q0, t0).unwrap();
                assert_close("p₀", &start.momenta, &momenta, Tol::ulps(64.0));
                let level = transversals.level_point(&start, increment, 60.0).unwrap();
                // Longer momenta, and turned by a radian or so where there is room to turn.
                let mut guess: Vec<f64> = momenta.iter().map(|p| 1.4 * p).collect();
                if 1 < n {
                    let (x, y) = (guess[0], guess[1]);
                    (guess[0], guess[1]) = (x.mul_add(0.6, -0.8 * y), x.mul_add(0.8, 0.6 * y));
                }
                let touched = transversals.envelope_event(&foot, &guess, increment, 60.0).unwrap();
                for point in [&level, &touched] {
                    stationary(point, (&q0, t0), increment);
                    compared += 1;
                }
                assert_close("q", &touched.event.coordinates, &level.event.coordinates, TIGHT);
                assert_close("p", &touched.momenta, &level.momenta, TIGHT);
                assert_close("H", &[touched.energy], &[level.energy], TIGHT);
            }
        }
    }
    assert_eq!(compared, 32);
}

/// G = Δc, and its derivatives by (q₀, t₀) are along those of U: nothing of the code under test.
fn stationary(point: &LevelPoint, (q0, t0): (&[f64], f64), increment: f64) {
    let (q, t) = (&point.event.coordinates, point.event.time);
    let reach = 1.0 / (1.0 + t0) - 1.0 / (1.0 + t);
    let square: f64 = q.iter().zip(q0).map(|(q, q0)| (q - q0).powi(2)).sum();
    assert_close("G", &[0.5 * square / reach], &[increment], TIGHT);
    let by_time = 0.5 * square / (reach * (1.0 + t0)).powi(2);
    let (u_q, u_t) = slopes(q0, t0);
    let turned: Vec<f64> = q.iter().zip(q0).map(|(q, q0)| -(q - q0) / reach * u_t).collect();
    let expected: Vec<f64> = u_q.iter().map(|u| by_time * u).collect();
    assert_close("dG along dU", &turned, &expected, TIGHT);
}

/// U = x + 0.3 y² − 0.9 t − 0.1 t².
#[derive(Debug)]
struct Front;

impl PrincipalFunction for Front {
    fn value<T: Real>(&self, q: &[T], t: T) -> T {
        q[0] + T::lit(0.3) * q[1] * q[1] - T::lit(0.9) * t - T::lit(0.1) * t * t
    }
}

/// U = 2.5 q + q²/4.
#[derive(Debug)]
struct Values;

impl PrincipalFunction for Values {
    fn value<T: Real>(&self, q: &[T], _t: T) -> T {
        T::lit(2.5) * q[0] + T::lit(0.25) * q[0] * q[0]
    }
}

#[test]
fn envelopes_of_emitted_manifolds_are_levels_of_the_solution_in_potentials_and_in_driven_systems() {
    let transversals = Transversals::of_manifold(&Bowl, &Front, 1.0);
    for y in [-0.4, 0.0, 0.5] {
        let start = transversals.start(&[0.1, y], 0.0).unwrap();
        let [px, py] = [start.momenta[0], start.momenta[1]];
        for increment in [0.02, 0.1] {
            let level = transversals.level_point(&start, increment, 2.0).unwrap();
            let followed = transversals.follow(&start, level.event.time).unwrap();
            assert_close("U", &[followed.value - start.value], &[increment], TIGHT);
            let guess = [1.3 * (0.8 * px - 0.6 * py), 1.3 * (0.6 * px + 0.8 * py)];
            let touched = transversals.envelope_event(&start.foot, &guess, increment, 2.0).unwrap();
            assert_close_at_scale("q", &touched.event.coordinates, &level.event.coordinates, 1.0, TIGHT);
            assert_close_at_scale("t", &[touched.event.time], &[level.event.time], 1.0, TIGHT);
            assert_close_at_scale("p", &touched.momenta, &level.momenta, 1.0, TIGHT);
        }
    }
    let shaken = ShakenPendulum { amplitude: 1.5 };
    let transversals = Transversals::of_values(&shaken, &Values, 0.25);
    for q in [-0.5, 0.0, 0.75] {
        let start = transversals.start(&[q], 0.0).unwrap();
        let level = transversals.level_point(&start, 1.0, 3.0).unwrap();
        let touched = transversals.envelope_event(&start.foot, &[3.5], 1.0, 3.0).unwrap();
        assert_close_at_scale("q", &touched.event.coordinates, &level.event.coordinates, 1.0, TIGHT);
        assert_close_at_scale("p", &touched.momenta, &level.momenta, 1.0, TIGHT);
        // The solution there, found from another foot, has the value of the level.
        let near = Event::new(&[q + 0.05], 0.25);
        let solution = transversals.solution(&level.event, &near).unwrap();
        assert_close("U", &[solution.value], &[start.value + 1.0], TIGHT);
    }
}

/// Waves: H of the first degree in p, along whose rays the action stays zero.
#[derive(Debug)]
struct Waves;

impl PhaseFunction for Waves {
    fn value<T: Real>(&self, _q: &[T], p: &[T], _t: T) -> T {
        (p[0] * p[0] + p[1] * p[1]).sqrt()
    }
}

#[test]
fn levels_that_no_transversal_reaches_are_refused() {
    let not_found = |found: Result<LevelPoint, HamiltonianError>| {
        assert!(
            matches!(found, Err(HamiltonianError::HamiltonJacobi(HamiltonJacobiError::NotFound { .. }))),
            "{found:?}"
        );
    };
    let waves = Transversals::of_values(&Waves, &Front, 0.0);
    let start = waves.start(&[0.1, 0.2], 0.0).unwrap();
    not_found(waves.level_point(&start, 0.1, 5.0));
    // The whole action of a particle that slows down is finite.
    let slowing = Transversals::of_values(&Slowing, &Values, 0.0);
    let start = slowing.start(&[0.0], 0.0).unwrap();
    not_found(slowing.level_point(&start, 3.2, 1e4));
    not_found(slowing.envelope_event(&start.foot, &[2.0], 3.0, 1e4));
    let wrong = slowing.envelope_event(&start.foot, &[2.0, 1.0], 0.1, 1.0);
    assert!(matches!(wrong, Err(HamiltonianError::WrongLength { .. })));
    let nan = slowing.level_point(&start, f64::NAN, 1.0);
    assert!(matches!(nan, Err(HamiltonianError::NotFinite { quantity: "Δc", .. })));
    // No increment: the foot itself.
    let foot = slowing.level_point(&start, 0.0, 1.0).unwrap();
    assert_eq!(foot.event, start.foot);
}
