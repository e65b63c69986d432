//! Forces that are known in a turning frame, solved at rest: against the same equations with centrifugal and Coriolis' forces.

use core::convert::Infallible;

use piola_integrators::{GaussLegendre16, IntegratorsError, Nystrom1210, SecondOrder, State, Tolerance, TurningFrame};
use piola_numerics::Real;
use piola_testkit::{Tol, allocations_in, assert_close};

const RATE: f64 = 0.75;

/// Two points in space, each held by a spring to its place in the turning frame, and by one to the other.
#[derive(Clone, Copy)]
struct Springs {
    /// Whether the forces of the turning frame belong to the acceleration.
    is_turning: bool,
}

impl<T: Real> SecondOrder<T> for Springs {
    type Error = Infallible;
    fn is_velocity_dependent(&self) -> bool {
        self.is_turning
    }
    fn freedom(&self) -> usize {
        6
    }
    #[cfg_attr(not(debug_assertions), inline(always))]
    fn acceleration(&mut self, _t: T, q: &[T], v: &[T], out: &mut [T]) -> Result<(), Infallible> {
        const PLACES: [f64; 6] = [1.0, 0.0, 0.5, -1.0, 0.25, 0.0];
        for i in 0..6 {
            let other = q[(i + 3) % 6];
            out[i] = T::lit(-4.0) * (q[i] - T::lit(PLACES[i])) + (other - q[i]) * (other - q[i]) * T::lit(0.5);
        }
        if self.is_turning {
            let (rate, square) = (T::lit(RATE), T::lit(RATE * RATE));
            for k in [0, 3] {
                out[k] += square * q[k] + T::lit(2.0) * rate * v[k + 1];
                out[k + 1] += square * q[k + 1] - T::lit(2.0) * rate * v[k];
            }
        }
        Ok(())
    }
}

fn start(t: f64) -> State {
    State::new(t, vec![1.0, 0.25, 0.0, -0.5, 0.0, 0.25, 0.5, -0.25, 0.125, 0.0, 1.0, -0.5]).unwrap()
}

/// From a start at t = 2, where the axes have turned already.
#[test]
fn motions_at_rest_are_those_of_the_turning_frame() {
    let tolerance = Tolerance::relative(1e-15).unwrap();
    let mut expected = start(2.0);
    GaussLegendre16::new(tolerance).integrate_to(&mut Springs { is_turning: true }, &mut expected, 7.0).unwrap();
    let bound = Tol::ulps(2048.0);
    let mut found = start(2.0);
    let mut frame = TurningFrame::in_space(Springs { is_turning: false }, RATE).unwrap();
    frame.to_rest(&mut found).unwrap();
    GaussLegendre16::new(tolerance).integrate_to(&mut frame, &mut found, 7.0).unwrap();
    frame.to_turning(&mut found).unwrap();
    assert_close("Gauss–Legendre 16", &found.values, &expected.values, bound);
    let mut found = start(2.0);
    let mut frame = TurningFrame::in_space(Springs { is_turning: false }, RATE).unwrap();
    frame.to_rest(&mut found).unwrap();
    // Nyström pairs are for types whose forces never depend on velocities, or systems that say so: this frame does.
    assert!(!SecondOrder::<f64>::is_velocity_dependent(&frame));
    Nystrom1210::new(tolerance).integrate_to(&mut frame, &mut found, 7.0).unwrap();
    frame.to_turning(&mut found).unwrap();
    assert_close("Nyström 12(10)", &found.values, &expected.values, bound);
}

/// There and back is nothing, the carries too.
#[test]
fn states_turn_there_and_back() {
    let frame: TurningFrame<_, f64> = TurningFrame::in_space(Springs { is_turning: false }, RATE).unwrap();
    let mut state = start(3.0);
    frame.to_rest(&mut state).unwrap();
    // ṙ = R (q̇ + Ω × q) of the first point.
    let (sine, cosine) = (3.0 * RATE).sin_cos();
    let [x, y] = [0.5 - RATE * 0.25, -0.25 + RATE];
    assert_close("ṙ", &state.values[6..9], &[cosine * x - sine * y, sine * x + cosine * y, 0.125], Tol::ulps(8.0));
    frame.to_turning(&mut state).unwrap();
    assert_close("q, q̇", &state.values, &start(3.0).values, Tol::ulps(8.0));
}

#[test]
fn what_has_no_turning_frame_is_refused() {
    let turning: Result<TurningFrame<_, f64>, _> = TurningFrame::in_space(Springs { is_turning: true }, RATE);
    assert!(matches!(turning, Err(IntegratorsError::VelocityDependent)));
    let rate: Result<TurningFrame<_, f64>, _> = TurningFrame::in_plane(Springs { is_turning: false }, f64::NAN);
    assert!(matches!(rate, Err(IntegratorsError::NotFinite { .. })));
    let frame: TurningFrame<_, f64> = TurningFrame::in_space(Springs { is_turning: false }, RATE).unwrap();
    let mut state = State::new(0.0, vec![0.0; 8]).unwrap();
    let refused = frame.to_rest(&mut state);
    assert!(matches!(refused, Err(IntegratorsError::WrongLength { quantity: "state", expected: 12, found: 8 })));
}

#[test]
fn evaluations_do_not_allocate() {
    let mut frame = TurningFrame::in_space(Springs { is_turning: false }, RATE).unwrap();
    let (q, v, mut out) = ([0.5; 6], [0.0; 6], [0.0; 6]);
    frame.acceleration(0.0, &q, &v, &mut out).unwrap();
    let (count, ()) = allocations_in(|| {
        for step in 0..100 {
            frame.acceleration(f64::from(step), &q, &v, &mut out).unwrap();
        }
    });
    assert_eq!(count, 0);
}
